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
    """A call failed. `status` says how, str() is the library's message; `run` holds what a failed
    simulate() or sample() had recorded, else None."""

    def __init__(self, status, message):
        super().__init__(message)
        self.status = as_status(status)
        self.run = None

    def __reduce__(self):
        return Error, (self.status, str(self))


class Warning(UserWarning):
    """All warnings of one kind of a run. str() is the message of the first one. `code` is a number
    that never changes, `joint` the name of the joint or None, `first` and `last` [s] when it came,
    `count` how often; `doubts_motion`: the result may be wrong by far more than its tolerance, which
    is so for every DoubtWarning."""

    code = 0
    joint = None
    first = last = float("nan")
    count = 1
    doubts_motion = False


class DoubtWarning(Warning):
    """The motion of a run may be wrong by far more than its tolerance."""

    doubts_motion = True


def _kinds():
    """A class per baum_warning_code: BAUM_WARNING_REDUNDANT_ROWS gives RedundantRowsWarning."""
    kinds = {}
    for code in _abi.baum_warning_code:
        words = code.name[len("BAUM_WARNING_") :].split("_")
        name = "".join(word.capitalize() for word in words) + "Warning"
        base = DoubtWarning if code >= _abi.baum_warning_code.BAUM_WARNING_BRANCH else Warning
        doc = f"Warning {code.name} of simulation.h."
        inside = {"code": int(code), "__doc__": doc, "__module__": __name__}
        kinds[int(code)] = type(name, (base,), inside)
    return kinds


KINDS = _kinds()
WARNINGS = {kind.__name__: kind for kind in KINDS.values()}
globals().update(WARNINGS)


def as_warning(struct, joint):
    """The baum.Warning of a baum_warning about a joint."""
    base = DoubtWarning if struct.doubts_motion else Warning
    warning = KINDS.get(struct.code, base)(struct.text.decode(errors="replace"))
    warning.code, warning.joint = struct.code, joint and joint.name
    warning.first, warning.last, warning.count = struct.first, struct.last, struct.count
    return warning


class Retry(Exception):
    """Raise it in a function of the mechanism to ask for a smaller step."""


def warn(warning):
    """Warn at the line outside of this package from which the call came."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(warning, stacklevel=level)
