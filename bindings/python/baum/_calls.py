# SPDX-License-Identifier: BSD-3-Clause
"""Call the C library. This module converts statuses, raises the exceptions of callbacks, lets
Ctrl-C stop a call, and allows only one thread at a time to use an object.

Python handles signals in the main thread, between two Python instructions. If the main thread made
a long call of the library, Ctrl-C would have no effect before the end of this call. If the call
runs Python callbacks, KeyboardInterrupt could even be raised where nothing can catch it. The main
thread therefore hands such calls to a second thread, and waits in a way that Ctrl-C can interrupt.
Other threads make their calls directly, and so does the main thread if a call takes at most about
10 ms, because handing over a call takes about as long as a short run.
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
from ._strict import Strict

Self = TypeVar("Self", bound="Closing")
Call = Callable[..., Any]

_here = threading.local()

# A call returns one of these statuses if a callback has stopped it.
STOPPED = (errors.Status.ERR_CALLBACK, errors.Status.STOP_CANCELLED)


# ---- one call ------------------------------------------------------------------------------------


def raise_later(error: BaseException | None) -> None:
    """Store the exception of a callback. The exception stops the present call of the library, and
    is raised when this call has returned."""
    _here.error = error


def make(function: Call, *arguments: Any) -> errors.Status:
    """Call a function of the library that returns a status.

    If a callback has stopped the call, raise the exception of the callback. If the status is below
    0, raise baum.Error. A call may also succeed although a callback has failed, for example if the
    library evaluates a mechanism at times that the run will not reach. In this case the exception
    is discarded.
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
    """Return the address of an object that a function of the library has created."""
    assert out.value is not None
    return out.value


def message() -> str:
    """Return the last message of this thread."""
    return text(lib.baum_message())


# ---- the second thread ---------------------------------------------------------------------------


class _Task:
    """A call that the second thread makes, and its result."""

    def __init__(self, function: Call, arguments: tuple[Any, ...]) -> None:
        self._call = (contextvars.copy_context().run, function, *arguments)
        self._done = threading.Lock()
        self._done.acquire()
        self._claims: dict[str, object] = {}
        self.finished = False
        self._result: Any = None
        self._error: BaseException | None = None

    def claim(self) -> bool:
        """Claim this call. Return whether the caller is the first one to claim it.

        The worker claims a call before it makes the call. If Ctrl-C comes before the worker has
        claimed the call, the main thread claims the call in order to discard it.
        """
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

    def wait(self, seconds: float) -> None:
        """Wait until the call has returned, for at most this time [s]."""
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
    """The second thread. It makes calls for the main thread, one after the other."""

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
    """Make a call that Ctrl-C can stop.

    When KeyboardInterrupt comes, cancel the call, wait until it returns, and then raise the
    exception. When a second KeyboardInterrupt comes, raise it without waiting. The objects that the
    call uses then stay alive and busy until the call returns.
    """
    global _worker
    if not in_main_thread():
        return function(*arguments)
    if _worker is None:
        _worker = _Worker()
    task = _Task(function, arguments)
    try:
        _worker.put(task)
        # A signal that arrives immediately before a wait does not end this wait. Each wait is
        # therefore short.
        while not task.finished:
            task.wait(0.2)
    except BaseException:
        _come_back(task, cancel)
        raise
    return task.result()


def _come_back(task: _Task, cancel: Callable[[], None] | None) -> None:
    """If the call has not begun, discard it. Otherwise ask it to stop, and wait until it has
    stopped."""
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
    """A short use of an object by Handle.glance(). Calls wait for the end of this use."""

    def __init__(self) -> None:
        self.done = threading.Event()


class Handle:
    """Owns an object of the library, and lets only one thread at a time use it."""

    def __init__(self, address: int, destroy: Call, what: str) -> None:
        self._address: int | None = address
        self._what = what
        self._users: dict[str, object] = {}
        self._destroy = weakref.finalize(self, destroy, address)
        # The object is not destroyed when the interpreter exits, because a call that still runs in
        # another thread may use it.
        self._destroy.atexit = False

    def __reduce__(self) -> NoReturn:
        raise TypeError(
            f"a {self._what}, or an object that contains one, cannot be pickled; build it in each "
            "process, and send arrays, such as run.q"
        )

    @property
    def address(self) -> int:
        """The address of the object. Raises baum.Error after close()."""
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
        """Call a function with this object as its first argument. Everything else is as in
        make()."""
        # dict.setdefault() marks the object as used, and is atomic. If Ctrl-C interrupts this code,
        # the mark tells whether this call owns the object, and can be removed safely. A lock would
        # not tell this if Ctrl-C came while the lock was being acquired.
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
        """Call a short function with the address of the object, from any thread. Do nothing if a
        call is using the object, or if the object is destroyed."""
        me = _Glance()
        try:
            if self._users.setdefault("now", me) is me and self._address is not None:
                function(self._address)
        finally:
            if self._users.get("now") is me:
                del self._users["now"]
            me.done.set()

    def _give_way(self) -> None:
        """Wait while another thread uses the object by glance(). If another call is using the
        object, raise baum.Error."""
        other = self._users.get("now")
        if isinstance(other, _Glance):
            other.done.wait()
        elif other is not None:
            raise errors.Error(errors.Status.ERR_STATE, self._in_use())

    def _in_use(self) -> str:
        instead = (
            "; functions must use their arguments t, q and v instead, and "
            "acceleration(t, q, v) of a baum.Workspace for multipliers"
        )
        user = "another call, of another thread or of one of your functions"
        return f"this {self._what} is in use by {user}" + instead * (self._what == "simulation")


class Closing(Strict):
    """Base class of objects that are closed by close(), or at the end of a `with` block."""

    _owner: Handle

    def close(self) -> None:
        """Free the memory and the files of the object now. Otherwise Python frees them when it
        collects the object.

        Arrays and runs that the object has returned remain valid. The other methods of a closed
        object raise baum.Error.
        """
        self._owner.close()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        # After a second Ctrl-C a call may still run in another thread and use the object.
        if not self._owner.busy:
            self.close()
