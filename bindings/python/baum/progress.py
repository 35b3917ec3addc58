# SPDX-License-Identifier: BSD-3-Clause
"""Progress of a study, for people who wait for it."""

import collections
import itertools
import sys
import time

INTERVAL = 0.2  # [s] between two messages


def stream():
    """Where somebody watches: standard output of a notebook, standard error of a terminal; or None."""
    ipython = sys.modules.get("IPython")
    shell = ipython and ipython.get_ipython()
    if shell is not None and hasattr(shell, "kernel"):
        return sys.stdout
    return sys.stderr if sys.stderr is not None and sys.stderr.isatty() else None


class Line:
    """One line that is written over and over: how far a study is, and an estimate of the time left.

    methods: the number of the method of each row. Every setting of a method is taken to cost twice as
    much as the coarser one before it. The study goes through all rows from coarse to fine, and then,
    to time them, in their own order.
    """

    def __init__(self, out, methods):
        self._out = out
        coarser = collections.Counter()
        ranks = []
        for method in methods:
            ranks.append(coarser[method])
            coarser[method] += 1
        costs = [2.0 ** min(rank, 50) for rank in [*sorted(ranks), *ranks]]
        self._spent = [0.0, *itertools.accumulate(costs)]
        self._settings = len(methods)
        self._begun = self._next = time.monotonic()
        self._first = None
        self._show("reference")

    def __call__(self, done, total):
        now = time.monotonic()
        if self._first is None:
            self._first = self._spent[done - 1]
        if now < self._next:
            return
        self._next = now + INTERVAL
        if done == total:
            self._show("validation")
            return
        spent, whole = self._spent[done], self._spent[-1]
        left = (now - self._begun) * (whole - spent) / (spent - self._first)
        self._show(f"{100 * spent / whole:.0f} %, about {duration(left)} left")

    def close(self):
        """End the line."""
        self._show(duration(time.monotonic() - self._begun), end="\n")

    def _show(self, text, end=""):
        try:
            self._out.write(f"\rstudy of {self._settings} settings: {text:<28}{end}")
            self._out.flush()
        except (OSError, ValueError):  # nobody watches any more
            self._next = float("inf")


def duration(seconds):
    """In words, with no more digits than an estimate has."""
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
