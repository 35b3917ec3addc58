# SPDX-License-Identifier: BSD-3-Clause
"""Types for annotations of your own functions and variables.

For example::

    from baum.typing import Array

    def drag(t: float, q: Array, v: Array) -> Array:
        return -0.1 * v
"""

from __future__ import annotations

from _ctypes import CFuncPtr
from typing import TYPE_CHECKING, Any, Callable, Literal, Mapping, Protocol, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike as ArrayLike
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .channels import Channel
    from .elements import Body, Input, Joint
    from .gains import Gains

Array = NDArray[np.float64]
Scalar = Union[float, "np.floating[Any]", "np.integer[Any]"]
BodyLike = Union[str, "Body"]
JointLike = Union[str, "Joint"]
InputLike = Union[str, "Input"]
ChannelLike = Union[str, "Channel"]


class HasAddress(Protocol):
    """A compiled function with an attribute `address`, such as Numba's cfunc."""

    @property
    def address(self) -> int: ...


class HasQuaternion(Protocol):
    """A rotation that has a quaternion, such as a Rotation of scipy.spatial.transform. as_quat()
    returns the quaternion in the order x, y, z, w."""

    def as_quat(self) -> Any: ...


# A unit quaternion (w, x, y, z), a rotation matrix (3 x 3), or a rotation of SciPy.
OrientationLike = Union[ArrayLike, HasQuaternion]
Axis = Literal["x", "y", "z"]

# A compiled function: its address, a function pointer of ctypes, or an object with `address`.
Compiled = Union[int, CFuncPtr, HasAddress]
FunctionOfQ = Union[Callable[[float, Array], ArrayLike], Compiled]
FunctionOfQV = Union[Callable[[float, Array, Array], ArrayLike], Compiled]
ForceFunction = Union[Callable[..., ArrayLike], Compiled]
LawOfTime = Union[Callable[[float], ArrayLike], Compiled]
LawOfLength = Union[Callable[[float, float], ArrayLike], Compiled]
CurveFunction = Union[Callable[[Array], ArrayLike], Compiled]
Manifold = Union[Callable[..., ArrayLike], Compiled]

Formulation = Literal[
    "default", "unstabilized", "baumgarte", "projection", "index2", "ggl", "index3"
]
Coordinate = Literal["first", "displacement", "angle", "angle_b", "x", "y"]
Start = Literal["assemble", "exact", "as_given"]
Solver = Literal["auto", "klu", "qr", "block"]
Cost = Literal["work", "cpu"]
Progress = Union[bool, Callable[[float], object], None]


class SettingOptions(TypedDict, total=False):
    """Options of a setting of a study; baum.Simulation describes them."""

    formulation: Formulation
    gains: Gains | None
    allow_unstable: bool
    step: Scalar | None
    rtol: Scalar | None
    atol: Scalar | None
    max_step: Scalar | None
    start_time: Scalar
    start: Start
    solver: Solver
    check_derivatives: bool
    max_steps: int
    tolerance_q: Scalar
    tolerance_v: Scalar
    tolerance_lambda: Scalar
    energy_account: bool
    error_check: bool


class SimulationOptions(SettingOptions, total=False):
    """All options of a run; baum.Simulation describes them."""

    progress: Progress
    row_gains: Mapping[Any, ArrayLike] | None
    progress_interval: Scalar
