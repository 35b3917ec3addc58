# SPDX-License-Identifier: BSD-3-Clause
"""How the C library is called: statuses, exceptions out of callbacks, Ctrl-C, one thread at a time.

Python handles signals in the main thread, between two of its own instructions. A long call made
there would make Ctrl-C wait for its end, and one that comes back through callbacks could see
KeyboardInterrupt arise where nothing can catch it. So these calls are handed to a second thread,
while the main thread waits where it can be interrupted. Calls from other threads are made where
they are.
"""

import contextvars
import os
import queue
import re
import threading
import weakref

from . import errors
from ._lib import lib

_here = threading.local()

# What a call returns when a callback stopped it.
STOPPED = (errors.Status.ERR_CALLBACK, errors.Status.STOP_CANCELLED)


# ---- one call ------------------------------------------------------------------------------------


def raise_later(error):
    """Keep what a callback raised until the call that it stopped is back."""
    _here.error = error


def make(function, *arguments):
    """Call a function that returns a status; raise what a callback raised, or baum.Error below 0.

    A call may get over a function that fails: where the library looks around to judge a mechanism,
    for example at times that the run will not reach. Then the exception is dropped.
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


def message():
    """This thread's last message, without the name of the C function that it begins with."""
    return re.sub(r"^baum_\w+: ", "", lib.baum_message().decode(errors="replace"))


# ---- the second thread ---------------------------------------------------------------------------


class _Task:
    """A call on its way: what to do, and what came of it."""

    def __init__(self, function, arguments):
        self._call = (contextvars.copy_context().run, function, *arguments)
        self._done = threading.Lock()
        self._done.acquire()
        self._claims = {}
        self.finished = False
        self._result = self._error = None

    def claim(self):
        """Whether the caller is the first to ask: it alone may make the call, or let it be. Ctrl-C
        may strike before the call has reached the worker."""
        me = object()
        return self._claims.setdefault("first", me) is me

    def run(self):
        if not self.claim():
            return
        try:
            call, *arguments = self._call
            self._result = call(*arguments)
        except BaseException as error:
            self._error = error
        self.finished = True
        self._done.release()

    def wait(self, seconds=-1):
        self._done.acquire(timeout=seconds)

    def result(self):
        error, self._error = self._error, None
        if error is not None:
            try:
                raise error
            finally:
                del error
        return self._result


class _Worker:
    """The thread that makes calls for the main thread, one after the other."""

    def __init__(self):
        self._tasks = queue.SimpleQueue()
        threading.Thread(target=self._work, name="baum", daemon=True).start()

    def _work(self):
        while True:
            task = self._tasks.get()
            if task is None:
                return
            task.run()
            del task

    def put(self, task):
        self._tasks.put(task)


_worker = None


def _forget_worker():
    global _worker
    _worker = None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_worker)


def in_main_thread():
    return threading.get_ident() == threading.main_thread().ident


def interruptible(function, *arguments, cancel=None):
    """Call so that Ctrl-C works: it cancels, waits for the call to come back, and is then raised. A
    second one does not wait; what the call uses stays alive and busy until it is back."""
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


def _come_back(task, cancel):
    """Ask a call to stop and wait until it has; one that has not begun never will."""
    try:
        if task.claim():
            return
        if cancel is not None and not task.finished:
            cancel()
        while not task.finished:
            task.wait(0.02)
    except BaseException:
        _worker.put(None)
        _forget_worker()
        raise


# ---- objects of the library ----------------------------------------------------------------------


class Handle:
    """Owns an object of the library and lets one thread at a time use it."""

    def __init__(self, address, destroy, what):
        self._address = address
        self._what = what
        self._users = {}
        # Not at exit: a call that was left behind may still be using it.
        weakref.finalize(self, destroy, address).atexit = False

    def __reduce__(self):
        raise TypeError(
            f"a {self._what}, and what holds one, cannot be pickled; build it in each process, and send "
            "arrays, such as run.q"
        )

    @property
    def busy(self):
        """Whether a call uses it."""
        return bool(self._users)

    def call(self, function, *arguments):
        """make() with this object as the first argument."""
        # Setting a default in a dict is atomic, and unlike a lock it can be undone wherever Ctrl-C
        # strikes.
        me = object()
        try:
            if self._users.setdefault("now", me) is not me:
                raise errors.Error(errors.Status.ERR_STATE, self._in_use())
            return make(function, self._address, *arguments)
        finally:
            if self._users.get("now") is me:
                del self._users["now"]

    def _in_use(self):
        instead = (
            "; its functions have the t, q and v that they are given, and for multipliers "
            "acceleration(t, q, v) of a baum.Workspace"
        )
        return f"this {self._what} is in use by another call" + instead * (self._what == "simulation")
