# SPDX-License-Identifier: BSD-3-Clause
"""Progress bars of runs and studies, in a terminal or a notebook."""

from __future__ import annotations

import collections
import itertools
import sys
import time
from typing import Sequence, TextIO

from . import drawings

INTERVAL = 0.2  # [s] between two updates
BAR = 20  # characters


def stream() -> TextIO | None:
    """Return the stream on which to show progress: standard output in a notebook, standard error in
    a terminal, otherwise None."""
    if drawings.is_notebook():
        return sys.stdout
    return sys.stderr if sys.stderr is not None and sys.stderr.isatty() else None


class Line:
    """A line of text that is overwritten again and again. It shows a bar, the percentage and the
    time left."""

    def __init__(self, out: TextIO, title: str) -> None:
        self._out = out
        self._title = title
        self._begun = self._next = time.monotonic()
        self._first: float | None = None

    def update(self, fraction: float) -> None:
        """Show the fraction that is done, 0 to 1, and an estimate of the time left."""
        now = time.monotonic()
        if self._first is None:
            self._first = fraction
        if now < self._next:
            return
        self._next = now + INTERVAL
        left = ""
        if fraction > self._first:
            seconds = (now - self._begun) * (1 - fraction) / (fraction - self._first)
            left = f", about {duration(seconds)} left"
        self.show(f"{bar(fraction)} {100 * fraction:.0f} %{left}")

    def show(self, text: str, end: str = "") -> None:
        """Replace the text of the line."""
        try:
            self._out.write(f"\r{self._title}: {text:<{BAR + 28}}{end}")
            self._out.flush()
        except (OSError, ValueError):  # the stream was closed
            self._next = float("inf")

    def close(self) -> None:
        """End the line with the time spent."""
        self.show(duration(time.monotonic() - self._begun), end="\n")


class RunLine(Line):
    """The progress line of a run between two times [s]."""

    def __init__(self, out: TextIO, start: float, end: float) -> None:
        super().__init__(out, f"run to t = {end:g} s")
        self._start, self._span = start, end - start
        self._first = 0.0

    def __call__(self, t: float) -> None:
        if self._span:
            self.update(min(max((t - self._start) / self._span, 0.0), 1.0))


class StudyLine(Line):
    """The progress line of a study.

    methods: the index of the method of each entry.

    The estimate of the time left assumes that each setting of a method costs twice as much as the
    next coarser one. The study first computes the errors of all entries, from coarse to fine. It
    then measures their times in the order of adding.
    """

    def __init__(self, out: TextIO, methods: Sequence[int]) -> None:
        super().__init__(out, f"study of {len(methods)} settings")
        coarser: collections.Counter[int] = collections.Counter()
        ranks = []
        for method in methods:
            ranks.append(coarser[method])
            coarser[method] += 1
        costs = [2.0 ** min(rank, 50) for rank in [*sorted(ranks), *ranks]]
        self._spent = [0.0, *itertools.accumulate(costs)]
        self.show("reference")

    def __call__(self, done: int, total: int) -> None:
        if self._first is None:
            self._first = self._spent[done - 1] / self._spent[-1]
        if done < total:
            self.update(self._spent[done] / self._spent[-1])
        elif time.monotonic() >= self._next:
            self.show("validation")


def bar(fraction: float) -> str:
    """Return a bar that is filled to this fraction."""
    filled = int(BAR * fraction)
    return f"[{'#' * filled}{'.' * (BAR - filled)}]"


def duration(seconds: float) -> str:
    """Return a duration as text, rounded as is appropriate for an estimate."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
