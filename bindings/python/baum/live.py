# SPDX-License-Identifier: BSD-3-Clause
"""Pages that follow a run in progress.

A View is a small web server with a thread of its own. It serves only programs on this computer. The
run leaves its newest frame in a Live object, at most 60 times a second. For each page, the server
has a thread that sends the newest frame to the page. A slow page misses frames. A run therefore
never waits for a page, with one exception: while a page pauses the run, the thread that advances
the run waits.
"""

from __future__ import annotations

import contextlib
import html
import queue
import threading
import time
import warnings
import weakref
import webbrowser
from typing import TYPE_CHECKING, Callable, NamedTuple, Sequence, Union

import numpy as np

from . import drawings
from ._lib import lib
from ._values import numbers
from .typing import Array

if TYPE_CHECKING:
    from ._calls import Handle
    from ._motion import TraceLike
    from ._server import Server
    from .simulation import Simulation

Watcher = Union[Callable[[float], object], None]

FRAME = 1 / 60  # [s] shortest time between two frames
AWAY = 2.0  # [s] a paused run continues if no page is connected for this time


class Frame(NamedTuple):
    """The state of a run at one time.

    t: time [s].
    q: positions (nq).
    """

    t: float
    q: Array


NO_FRAME = Frame(0.0, np.empty(0))


class Live:
    """What a run and its views share: the newest frame, and whether the run is paused.

    The method call() is the progress function that the library calls. The user's progress function
    is `function`, which call() calls every `interval` seconds.
    """

    def __init__(self, interval: float) -> None:
        self.function: Watcher = None
        self.servers: list[Server] = []
        self.pages = 0
        self.paused = False
        self.frame = NO_FRAME
        self.cancelled = False
        self._interval = self._interval_now = interval
        self._due = self._function_due = 0.0
        self._held_at = float("nan")
        self._left_at: float | None = None
        self._steps: queue.SimpleQueue[None] = queue.SimpleQueue()
        self._lock = threading.Lock()

    # ---- in the thread that advances the run -----------------------------------------------------

    def call(self, address: int, t: float) -> bool:
        """Handle one call of the library's progress function. Return whether the user cancels the
        run."""
        if not self.servers:
            self.set_interval(address)
            return self.function is not None and bool(self.function(t))
        now = time.perf_counter()
        if now >= self._due or self.paused:
            self._follow(address)
        if self.function is None or now < self._function_due:
            return False
        self._function_due = now + self._interval
        return bool(self.function(t))

    def is_silent(self, seconds: float) -> bool:
        """Whether the library will not run call() before this time [s] has passed."""
        return self.function is None and not self.servers and self._interval_now > seconds

    def begin(self, address: int) -> None:
        """Prepare for a call that advances the run, if the run is paused or has a progress
        function."""
        self._function_due = time.perf_counter() + self._interval
        self.set_interval(address)

    def returned(self, owner: Handle) -> None:
        """Update the views at the end of a call. This function must be fast, because programs may
        advance a run in a loop of many short calls."""
        if time.perf_counter() >= self._due or self.paused:
            self._follow(owner.address)

    def _follow(self, address: int) -> None:
        """Show the present state, and wait while a page has paused the run."""
        self._due = time.perf_counter() + FRAME
        self.show(address)
        self.set_interval(address)
        if self.paused:
            self._hold()
            self.set_interval(address)

    def show(self, address: int) -> None:
        """Make the present state the newest frame."""
        t = float(lib.baum_simulation_time(address))
        q = numbers(lib.baum_simulation_q(address), len(self.frame.q))
        if q is not None and np.isfinite(q).all():
            if t != self.frame.t or (q != self.frame.q).any():
                self.frame = Frame(t, q)

    def _hold(self) -> None:
        """Wait until a page steps or resumes the run. If the run has not moved since the last wait,
        do not wait again."""
        if self.frame.t == self._held_at:
            return
        self._held_at = self.frame.t
        while self.paused and self.servers and not self.cancelled:
            try:
                return self._steps.get(timeout=0.05)
            except queue.Empty:
                left = self._left_at
            if self.pages == 0 and left is not None and time.monotonic() > left + AWAY:
                self.paused = False

    def set_interval(self, address: int) -> None:
        """Set how often the library calls the progress function: at every step while the run is
        paused, once for each frame if a view is open, otherwise at the interval of the user."""
        wanted = self._interval
        if self.servers:
            wanted = 0.0 if self.paused else min(FRAME, wanted)
        if wanted != self._interval_now:
            lib.baum_simulation_set_progress_interval(address, wanted)
            self._interval_now = wanted

    def end(self) -> None:
        """End all views."""
        for server in list(self.servers):
            server.end()

    # ---- in the threads of pages -----------------------------------------------------------------

    def pause(self) -> None:
        with contextlib.suppress(queue.Empty):
            while True:
                self._steps.get_nowait()
        self._held_at = float("nan")
        self.paused = True

    def resume(self) -> None:
        self.paused = False

    def step(self) -> None:
        self._steps.put(None)

    def enter(self) -> None:
        with self._lock:
            self.pages += 1

    def leave(self) -> None:
        with self._lock:
            self.pages -= 1
            self._left_at = time.monotonic()


# ---- views ---------------------------------------------------------------------------------------


class View:
    """A view of a run in the browser. Simulation.view() makes it.

    url: the address of the page that shows the run. The address contains a secret, and only
        programs on this computer can open the page.

    A view ends with close(), at the end of a `with` block, or when the simulation ends.
    """

    def __init__(self, server: Server) -> None:
        self._server = server
        self.url = server.url

    def __repr__(self) -> str:
        return f"<view, {'closed' if self.closed else self.url}>"

    def _repr_html_(self) -> str:
        if self.closed:
            return html.escape(repr(self))
        frame = f'<iframe src="{self.url}" width="100%" height="{drawings.HEIGHT}"'
        return f'{frame} style="border: 0"></iframe>'

    def __enter__(self) -> View:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    @property
    def closed(self) -> bool:
        """Whether the view has ended."""
        return self._server.ended.is_set()

    def close(self) -> None:
        """End the view. Open pages of the view continue to show the last frame. If the run is
        paused and has no other view, the run continues."""
        self._server.end()
        self._server.thread.join(5)


def open_view(
    simulation: Simulation,
    live: Live,
    owner: Handle,
    title: str | None,
    traces: Sequence[TraceLike],
    paused: bool,
    browser: bool,
) -> View:
    from ._server import Server  # imported late, because it imports large modules

    live.frame = Frame(simulation.time, simulation.q)
    server = Server(live, owner, simulation.mechanism, title, traces)
    live.servers.append(server)
    if paused:
        live.pause()
    weakref.finalize(simulation, server.end).atexit = False
    owner.glance(live.set_interval)
    server.thread.start()
    if browser and not drawings.is_notebook() and not webbrowser.open(server.url):
        warnings.warn(f"no browser was found; the page is {server.url}", stacklevel=3)
    return View(server)
