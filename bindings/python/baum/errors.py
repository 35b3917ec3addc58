# SPDX-License-Identifier: BSD-3-Clause
"""Statuses of the library, and the exceptions and warnings that they become."""

from __future__ import annotations

import enum
import os
import sys
import warnings
from typing import TYPE_CHECKING, Any

from . import _abi
from ._lib import text

if TYPE_CHECKING:
    from .elements import Joint
    from .run import Run

PACKAGE = os.path.dirname(os.path.abspath(__file__))


class Status(enum.IntEnum):
    """The result of a call. OK (0) means that the call has succeeded. A value from 1 to 9 means
    that a run has stopped because the program asked for it. A value of 10 or more means that a run
    has reached its end with warnings. A negative value is a failure, which is raised as
    baum.Error."""

    OK = 0
    STOP_CANCELLED = 1
    STOP_EVENT = 2
    STOP_TIME = 3
    WARNED = 10
    ERR_ARGUMENT = -1
    ERR_STATE = -2
    ERR_MEMORY = -3
    ERR_STRUCT = -4
    ERR_UNSUPPORTED = -5
    ERR_BUFFER = -6
    ERR_FILE = -7
    ERR_INCONSISTENT = -10
    ERR_SINGULAR = -11
    ERR_UNSTABLE = -12
    ERR_STEP = -20
    ERR_CONVERGENCE = -21
    ERR_INTEGRATOR = -22
    ERR_NOT_FINITE = -23
    ERR_CALLBACK = -30

    def __str__(self) -> str:
        return self.name


STATUSES = {status.value: status for status in Status}


def as_status(value: int) -> Status:
    """Convert a number to a Status. Return the number itself if this package does not know it."""
    return STATUSES.get(value, value)  # type: ignore[arg-type]


class Error(Exception):
    """A call of the library has failed.

    status: the Status.
    run: if simulate() or sample() has failed, a Run with the samples recorded before the failure;
        otherwise None.

    str(error) is the message of the library, in which names of this package replace C names.
    """

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = as_status(status)
        self.run: Run | None = None

    def __reduce__(self) -> tuple[Any, ...]:
        return Error, (self.status, str(self))


class Retry(Exception):
    """Raise this in a function of the mechanism to ask the integrator for a smaller step."""


# ---- warnings of runs ----------------------------------------------------------------------------


class Warning(UserWarning):
    """All warnings of one kind in a run. str(warning) is the message of the first one. This message
    ends with the code and the name of the warning, such as "[warning 104 singular_start]". On the
    page docs/cookbook/warnings.md, the section with this code explains the warning and what to do.

    code: the number of this kind of warning, which stays the same in later versions.
    doubts_motion: whether the result may be wrong by far more than its tolerance. This is true for
        every DoubtWarning.
    joint: the name of the joint that the first warning names, or None.
    first, last: times of the first and the last warning [s].
    count: number of warnings.
    """

    code = 0
    joint: str | None = None
    first = last = float("nan")
    count = 1
    doubts_motion = False


class DoubtWarning(Warning):
    """The motion of a run may be wrong by far more than its tolerance."""

    doubts_motion = True


class RedundantRowsWarning(Warning):
    """Some multipliers and reactions are not unique, because constraint rows are redundant."""

    code = 1


class GainsWarning(Warning):
    """With the gains of the run, constraint violations may grow, or not decay, or decay slowly."""

    code = 2


class NoisyDerivativesWarning(Warning):
    """The option rtol is below the error of derivatives that are computed by finite differences."""

    code = 3


class Index3Warning(Warning):
    """The run uses "ida" with the formulation "index3", which is offered for comparison only."""

    code = 4


class LooseVelocitiesWarning(Warning):
    """Ill-conditioned constraint rows determine the velocities only inaccurately."""

    code = 5


class EnergyAccountWarning(Warning):
    """An evaluation for the energy account has failed. The run continues, but the work terms and
    the residual of the account are NaN from then on."""

    code = 6


class IllConditionedWarning(Warning):
    """The equations of motion are close to singular."""

    code = 7


class SingularityCrossedWarning(Warning):
    """The motion continues smoothly through a singular configuration."""

    code = 8


class ErrorUnknownWarning(Warning):
    """The error of the motion is unknown, because the second integration that estimates this error
    has failed or was too expensive. The run itself is not affected."""

    code = 9


class BranchWarning(DoubtWarning):
    """The motion may have left its branch at a singular configuration."""

    code = 100


class ViolationWarning(DoubtWarning):
    """The constraint violation is too large."""

    code = 101


class ContradictionWarning(DoubtWarning):
    """Rows that the run omits as redundant have become independent of the other rows."""

    code = 102


class AccuracyWarning(DoubtWarning):
    """The estimated error of the motion is large."""

    code = 103


class SingularStartWarning(DoubtWarning):
    """The initial configuration is singular, and several motions may start from it."""

    code = 104


class BushingWarning(DoubtWarning):
    """The rotation of a bushing has passed pi, where its moment jumps. The run also warns if a
    step was too long to follow the angle of a spatial torsion spring whose axes nearly pointed in
    opposite directions."""

    code = 105


class WrongDerivativeWarning(DoubtWarning):
    """One of your functions returned a wrong derivative at a state of the run."""

    code = 106


class UncertainSensitivityWarning(Warning):
    """baum.sensitivities() has computed a derivative with two difference steps, and the two values
    differ too much. This warning does not belong to a run."""


KINDS = {
    kind.code: kind
    for base in (Warning, DoubtWarning)
    for kind in base.__subclasses__()
    if kind.code != 0
}


def as_warning(struct: _abi.baum_warning, joint: Joint | None) -> Warning:
    """Convert a warning of the library to a baum.Warning."""
    base = DoubtWarning if struct.doubts_motion else Warning
    warning = KINDS.get(struct.code, base)(text(struct.text))
    warning.code, warning.joint = struct.code, joint.name if joint else None
    warning.first, warning.last, warning.count = struct.first, struct.last, struct.count
    return warning


def warn(warning: Warning) -> None:
    """Issue a warning. Python then shows the line of the user's program that made the call."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(warning, stacklevel=level)
