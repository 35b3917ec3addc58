# SPDX-License-Identifier: BSD-3-Clause
"""How the C library is called: statuses, exceptions of callbacks, Ctrl-C, one thread at a time.

Python handles signals in the main thread, between two of its instructions. A long call made there
would delay Ctrl-C until its end, and if the call runs Python callbacks, KeyboardInterrupt could be
raised where nothing can catch it. Such calls are therefore handed to a second thread, while the
main thread waits where it can be interrupted. Calls from other threads are made directly, and so
are calls that take at most about 10 ms: handing over a call takes about as long as a short run.
"""

from __future__ import annotations

import contextvars
import ctypes
import os
import queue
import threading
import weakref
from typing import Any, Callable, NoReturn, TypeVar

from . import errors
from ._lib import lib, text

Self = TypeVar("Self", bound="Closing")
Call = Callable[..., Any]

_here = threading.local()

# Statuses of calls that a callback has stopped.
STOPPED = (errors.Status.ERR_CALLBACK, errors.Status.STOP_CANCELLED)


# ---- one call ------------------------------------------------------------------------------------


def raise_later(error: BaseException | None) -> None:
    """Keep the exception of a callback until the call that it stopped has returned."""
    _here.error = error


def make(function: Call, *arguments: Any) -> errors.Status:
    """Call a function that returns a status. Raise the exception of a callback that has stopped it,
    or baum.Error for a status below 0.

    A call may succeed although a callback failed, for example where the library evaluates a
    mechanism at times that the run will not reach. In this case the exception is discarded.
    """
    _here.error = None
    status = function(*arguments)
    error, _here.error = _here.error, None
    if error is not None and (status in STOPPED or not isinstance(error, Exception)):
        if status < 0 and hasattr(error, "add_note"):
            error.add_note(f"baum: {message()}")
        raise error
    if status < 0:
        raise errors.Error(status, message()) from error
    return errors.as_status(status)


def made(out: ctypes.c_void_p) -> int:
    """The address of the object that a function of the library has created."""
    assert out.value is not None
    return out.value


def message() -> str:
    """This thread's last message."""
    return text(lib.baum_message())


# ---- the second thread ---------------------------------------------------------------------------


class _Task:
    """A call for the second thread, and its result."""

    def __init__(self, function: Call, arguments: tuple[Any, ...]) -> None:
        self._call = (contextvars.copy_context().run, function, *arguments)
        self._done = threading.Lock()
        self._done.acquire()
        self._claims: dict[str, object] = {}
        self.finished = False
        self._result: Any = None
        self._error: BaseException | None = None

    def claim(self) -> bool:
        """Whether the caller is the first to claim this call. The worker claims a call before
        making it. The main thread claims a call to discard it, if Ctrl-C has come before the worker
        received it."""
        me = object()
        return self._claims.setdefault("first", me) is me

    def run(self) -> None:
        if not self.claim():
            return
        try:
            call, *arguments = self._call
            self._result = call(*arguments)
        except BaseException as error:
            self._error = error
        self.finished = True
        self._done.release()

    def wait(self, seconds: float = -1) -> None:
        self._done.acquire(timeout=seconds)

    def result(self) -> Any:
        error, self._error = self._error, None
        if error is not None:
            try:
                raise error
            finally:
                del error
        return self._result


class _Worker:
    """The thread that makes calls for the main thread, one after the other."""

    def __init__(self) -> None:
        self._tasks: queue.SimpleQueue[_Task | None] = queue.SimpleQueue()
        threading.Thread(target=self._work, name="baum", daemon=True).start()

    def _work(self) -> None:
        while True:
            task = self._tasks.get()
            if task is None:
                return
            task.run()
            del task

    def put(self, task: _Task | None) -> None:
        self._tasks.put(task)


_worker: _Worker | None = None


def _forget_worker() -> None:
    global _worker
    _worker = None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_worker)


def in_main_thread() -> bool:
    return threading.get_ident() == threading.main_thread().ident


def interruptible(function: Call, *arguments: Any, cancel: Callable[[], None] | None = None) -> Any:
    """Make a call that Ctrl-C can stop: KeyboardInterrupt cancels it, waits until it returns, and
    is then raised. A second Ctrl-C raises it without waiting; the objects that the call uses then
    stay alive and busy until the call returns."""
    global _worker
    if not in_main_thread():
        return function(*arguments)
    if _worker is None:
        _worker = _Worker()
    task = _Task(function, arguments)
    try:
        _worker.put(task)
        task.wait()
    except BaseException:
        _come_back(task, cancel)
        raise
    return task.result()


def _come_back(task: _Task, cancel: Callable[[], None] | None) -> None:
    """Ask a call to stop and wait until it has stopped. A call that has not begun is discarded."""
    try:
        if task.claim():
            return
        if cancel is not None and not task.finished:
            cancel()
        while not task.finished:
            task.wait(0.02)
    except BaseException:
        if _worker is not None:
            _worker.put(None)
        _forget_worker()
        raise


# ---- objects of the library ----------------------------------------------------------------------


class _Glance:
    """A short use of an object by another thread. Calls wait for its end."""

    def __init__(self) -> None:
        self.done = threading.Event()


class Handle:
    """Owns an object of the library and lets one thread at a time use it."""

    def __init__(self, address: int, destroy: Call, what: str) -> None:
        self._address: int | None = address
        self._what = what
        self._users: dict[str, object] = {}
        self._destroy = weakref.finalize(self, destroy, address)
        # Not destroyed at exit: a call that still runs in another thread may use the object.
        self._destroy.atexit = False

    def __reduce__(self) -> NoReturn:
        raise TypeError(
            f"a {self._what}, or an object that contains one, cannot be pickled; build it in each "
            "process, and send arrays, such as run.q"
        )

    @property
    def address(self) -> int:
        """The address of the object; raises baum.Error after close()."""
        if self._address is None:
            raise errors.Error(errors.Status.ERR_STATE, f"this {self._what} is closed")
        return self._address

    @property
    def busy(self) -> bool:
        """Whether a call is using the object."""
        return bool(self._users)

    @property
    def closed(self) -> bool:
        """Whether the object is destroyed."""
        return self._address is None

    def call(self, function: Call, *arguments: Any) -> errors.Status:
        """Like make(), with this object as the first argument."""
        # dict.setdefault() is atomic. Unlike the acquisition of a lock it can be undone safely if
        # Ctrl-C interrupts it.
        me = object()
        try:
            while self._users.setdefault("now", me) is not me:
                self._give_way()
            return make(function, self.address, *arguments)
        finally:
            if self._users.get("now") is me:
                del self._users["now"]

    def close(self) -> None:
        """Destroy the object unless it is already destroyed."""
        me = object()
        try:
            while self._users.setdefault("now", me) is not me:
                self._give_way()
            self._address = None
            self._destroy()
        finally:
            if self._users.get("now") is me:
                del self._users["now"]

    def glance(self, function: Callable[[int], None]) -> None:
        """Let another thread read the object, unless a call is using it or it is destroyed."""
        me = _Glance()
        try:
            if self._users.setdefault("now", me) is me and self._address is not None:
                function(self._address)
        finally:
            if self._users.get("now") is me:
                del self._users["now"]
            me.done.set()

    def _give_way(self) -> None:
        """Wait for a glance; refuse to wait for another call."""
        other = self._users.get("now")
        if isinstance(other, _Glance):
            other.done.wait()
        elif other is not None:
            raise errors.Error(errors.Status.ERR_STATE, self._in_use())

    def _in_use(self) -> str:
        instead = (
            "; its functions can use their arguments t, q and v, and for multipliers "
            "acceleration(t, q, v) of a baum.Workspace"
        )
        return f"this {self._what} is in use by another call" + instead * (
            self._what == "simulation"
        )


class Closing:
    """An object that close() or the end of a `with` block closes."""

    _owner: Handle

    def close(self) -> None:
        """Free memory and files of the object now, not only when Python collects it. Arrays and
        runs that it has returned remain valid; any other use of it raises baum.Error."""
        self._owner.close()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        # After a second Ctrl-C a call may still run in another thread and use the object.
        if not self._owner.busy:
            self.close()
