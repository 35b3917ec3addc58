# SPDX-License-Identifier: BSD-3-Clause
"""Statuses, and how they become exceptions and warnings."""

import enum
import os
import sys
import warnings

from . import _abi


class _Named(enum.IntEnum):
    def __str__(self):
        return self.name


Status = _Named(
    "Status", {status.name[len("BAUM_") :]: status.value for status in _abi.baum_status}
)
Status.__doc__ = """What a call came to: 0 done, 1 to 9 stopped as asked, 10 and up reached the end
with warnings, below 0 failed (then it is raised as baum.Error)."""
Status.__module__ = __name__

PACKAGE = os.path.dirname(os.path.abspath(__file__))


def as_status(value):
    """The Status of a number; a number that this package does not know stays one."""
    try:
        return Status(value)
    except ValueError:
        return value


class Error(Exception):
    """A call failed. `status` says how, str() is the library's sentence; `run` holds what a failed
    simulate() or sample() had recorded, else None."""

    def __init__(self, status, sentence):
        super().__init__(sentence)
        self.status = as_status(status)
        self.run = None

    def __reduce__(self):
        return Error, (self.status, str(self))


class Warning(UserWarning):
    """A run reached its end, but something deserves a look."""


class Retry(Exception):
    """Raise it in a function of the mechanism to ask for a smaller step."""


def warn(text):
    """Warn at the line outside of this package from which the call came."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(text, Warning, stacklevel=level)
