# SPDX-License-Identifier: BSD-3-Clause
"""Handles of bodies, joints, forces and inputs.

If one mechanism is a copy of another one, the handles of the same element in both mechanisms are
equal.
"""

from __future__ import annotations

import ctypes
import operator
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from . import _abi, outlines
from ._strict import Strict, properties
from ._values import there_are, vector
from .channels import Channel
from .definitions import COORDINATES, Definition, Kind, as_dict
from .outlines import Outline, OutlineLike
from .typing import ArrayLike

if TYPE_CHECKING:
    from .mechanism import Mechanism

Self = TypeVar("Self", bound="Element")

_Q = _abi.baum_quantity


class Entry(NamedTuple):
    """What a mechanism knows about an element. kind is None for ground and inputs, id is the id in
    the library, and nq and nv are the numbers of positions and velocities of a body. Copies of a
    mechanism share entries. Handles are created when they are needed."""

    family: str
    kind: Kind | None
    id: ctypes.Structure
    nq: int
    nv: int


GROUND = Entry("body", None, _abi.BAUM_GROUND, 0, 0)


def one(family: str) -> str:
    """Return the name of a family with its article, such as "a body" or "an input"."""
    return f"an {family}" if family[0] in "aeiou" else f"a {family}"


class Element(Strict):
    """Base class of bodies, joints, forces and inputs.

    mechanism: the mechanism that the element belongs to.
    name: the name of the element.
    """

    family = ""

    if TYPE_CHECKING:  # an annotation outside of this block would let users set the attribute
        mechanism: Mechanism
        name: str
        kind: Kind | None
        id: Any
        nq: int
        nv: int

    def __init__(self, mechanism: Mechanism, name: str, entry: Entry) -> None:
        same = {field: getattr(entry, field) for field in ("kind", "id", "nq", "nv")}
        vars(self).update(same, mechanism=mechanism, name=name)

    def __repr__(self) -> str:
        return f"<{self.kind.name if self.kind else self.family} {self.name!r}>"

    if not TYPE_CHECKING:  # type checkers would otherwise accept every attribute

        def __getattr__(self, name: str) -> Any:
            # Python calls this method only for attributes that do not exist.
            what = f"{type(self).__name__!r} object has no attribute {name!r}"
            if not name.startswith("_") and name in self._fields():
                what += f"; definition[{name!r}] of {self.family} {self.name!r} has this value"
            raise AttributeError(what)

    def _fields(self) -> list[str]:
        """Return the names of the fields of the definition, without the name of the element."""
        if self.kind is None:
            return ["initial"] if self.family == "input" else []
        names = Definition(self.kind, "", self.mechanism.find).names
        return [field for field in names if field != "name"]

    def _refusal(self, name: str) -> str:
        fields = self._fields()
        what = f'{self.family} "{self.name}" has no attribute {name!r} that can be set'
        if fields:
            known = f"{name if name in fields else 'field'}=..."
            what += (
                f"; set({known}) changes the definition before freezing, and "
                f"m.copy({self.name}=dict({known})) changes it in a copy of the mechanism"
            )
        others = [*fields, *properties(type(self))]
        return what if name in fields else f"{what}; {there_are(others, name)}"

    def _identity(self) -> tuple[str, int, int]:
        return self.family, self.id.index1, self.id.tag

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Element) and self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def __reduce__(self) -> Any:
        # Pickle the name, because an id is valid in one process only.
        return operator.getitem, (self.mechanism, self.name)

    @property
    def definition(self) -> dict[str, Any]:
        """The definition of the element as a dict. The keys are the names of the arguments of the
        method that adds the element. The values are numbers, tuples, arrays and handles of
        elements. Functions are omitted."""
        return as_dict(self.mechanism.read(self), self.mechanism.find)

    def set(self: Self, **fields: Any) -> Self:
        """Change fields of the definition before the mechanism is frozen. Fields that are None do
        not change.

        Returns the element. Raises TypeError for unknown fields, and baum.Error for values that the
        library refuses, or if the mechanism is frozen.
        """
        self.mechanism.change(self, fields)
        return self


class Body(Element):
    """A body, which is anything that has coordinates.

    nq: number of its positions.
    nv: number of its velocities.
    """

    family = "body"

    @property
    def columns(self) -> tuple[slice, slice]:
        """The slices of q and v that belong to the body. The mechanism must be frozen."""
        return self.mechanism.columns(self)

    @property
    def pose(self) -> Channel:
        """Channel of the position of the body.

        - Planar body: x, y of the centre of mass [m] and the angle [rad].
        - Spatial body: x, y, z of the centre of mass [m] and the quaternion w, x, y, z [-].
        - Particle: x, y, or in space x, y, z [m].
        - User coordinates: their part of q.
        """
        return self._channel("pose", _Q.BAUM_BODY_POSE)

    @property
    def velocity(self) -> Channel:
        """Channel: the velocities that belong to `pose` [m/s], [rad/s]. The angular velocity of a
        spatial body is in ground axes in this channel, although v contains it in body axes."""
        return self._channel("velocity", _Q.BAUM_BODY_VELOCITY)

    @property
    def acceleration(self) -> Channel:
        """Channel: accelerations [m/s^2], [rad/s^2], which are the time derivatives of
        `velocity`."""
        return self._channel("acceleration", _Q.BAUM_BODY_ACCELERATION)

    def pose_of(self, point: ArrayLike) -> Channel:
        """Channel: like `pose`, with the position of another point instead of the centre of mass.
        The point is given in body axes [m]."""
        return self._channel("pose", _Q.BAUM_BODY_POSE, point)

    def velocity_of(self, point: ArrayLike) -> Channel:
        """Channel: like `velocity`, for a point that is not the centre of mass. The point is given
        in body axes [m]."""
        return self._channel("velocity", _Q.BAUM_BODY_VELOCITY, point)

    def acceleration_of(self, point: ArrayLike) -> Channel:
        """Channel: like `acceleration`, for a point that is not the centre of mass. The point is
        given in body axes [m]."""
        return self._channel("acceleration", _Q.BAUM_BODY_ACCELERATION, point)

    @property
    def outline(self) -> list[Outline]:
        """The outlines of the body, as a list. Drawings show the outlines as the shape of the body.
        The list is empty if the library chooses the shape.

        You can set this property for ground and for every body except user coordinates. Set it to
        a shape (baum.Polygon, Circle, Box, Cylinder, Sphere or Mesh), the corners (n, 2) of a
        polygon, an SVG path as a string (with y upward), a list of these, or None. The mechanism
        may be frozen or not. Do not set the outline while another thread draws the mechanism.
        """
        return outlines.read(self)

    @outline.setter
    def outline(self, value: OutlineLike) -> None:
        outlines.Structs(value).set(self.mechanism.handle, self.id)

    def _channel(self, attribute: str, quantity: int, point: ArrayLike | None = None) -> Channel:
        key, at = f"{self.name}.{attribute}", [0.0, 0.0, 0.0]
        if point is not None:
            size = 3 if self.kind is not None and self.kind.is_spatial else 2
            given = vector(point, size, f"point of {self.name!r}").tolist()
            at[:size] = given
            key += f"({', '.join(map(repr, given))})"
        return Channel(key, quantity, body=self.id, point=tuple(at))


class Joint(Element):
    """A joint, which is anything that adds constraint rows."""

    family = "joint"

    @property
    def rows(self) -> slice:
        """The slice of the constraints Phi and of the multipliers lambda that belongs to the joint.
        The mechanism must be frozen."""
        return self.mechanism.rows(self)

    @property
    def phi(self) -> Channel:
        """Channel of the constraint violation Phi [m], [rad], with one column for each row."""
        return self._channel("phi", _Q.BAUM_PHI)

    @property
    def phi_rate(self) -> Channel:
        """Channel: time derivative of the violation, J v - nu [m/s], [rad/s]. J is the Jacobian of
        the constraints, and nu is minus the partial derivative of Phi with respect to time."""
        return self._channel("phi_rate", _Q.BAUM_PHI_RATE)

    @property
    def multipliers(self) -> Channel:
        """Channel of the Lagrange multipliers [N], [N m], with one column for each row."""
        return self._channel("multipliers", _Q.BAUM_LAMBDA)

    @property
    def reaction(self) -> Channel:
        """Channel: the force [N] and the moment [N m] that the joint exerts on body_b, in ground
        axes. The moment is about the joint's point on body_b. For joints in space, force and moment
        have three components each. For a gear, a coupling or a user constraint, the channel has the
        generalized force -J^T lambda, with one number for each velocity of the bodies. J is the
        Jacobian of the joint's rows, and lambda are the multipliers of these rows."""
        return self._channel("reaction", _Q.BAUM_JOINT_REACTION)

    @property
    def coordinate(self) -> Channel:
        """Channel: the coordinate of the joint and the time derivative of this coordinate. They are
        in [rad], [rad/s] for a revolute joint, and in [m], [m/s] for a joint along an axis.

        If a joint has several coordinates, the channel has the first one: the displacement of a
        cylindrical joint, the angle of a universal joint, or x of a planar joint in space.
        """
        return self._channel("coordinate", _Q.BAUM_JOINT_COORDINATE)

    @property
    def displacement(self) -> Channel:
        """Channel of the displacement [m] and of the velocity [m/s] along the axis."""
        return self._coordinate("displacement")

    @property
    def angle(self) -> Channel:
        """Channel of the angle [rad] and of the angular velocity [rad/s] about the axis."""
        return self._coordinate("angle")

    @property
    def angle_b(self) -> Channel:
        """Channel of the angle [rad] and of the angular velocity [rad/s] about axis_b of a
        universal joint."""
        return self._coordinate("angle_b")

    @property
    def x(self) -> Channel:
        """Channel of the displacement [m] and of the velocity [m/s] along x of a planar joint in
        space."""
        return self._coordinate("x")

    @property
    def y(self) -> Channel:
        """Channel of the displacement [m] and of the velocity [m/s] along y of a planar joint in
        space."""
        return self._coordinate("y")

    @property
    def effort(self) -> Channel:
        """Channel: force [N] or torque [N m] that a driver exerts on the coordinate it prescribes.
        The effort times the velocity of the coordinate is the power that the driver supplies."""
        return self._channel("effort", _Q.BAUM_DRIVE_EFFORT)

    def _coordinate(self, name: str) -> Channel:
        channel = self._channel(name, _Q.BAUM_JOINT_COORDINATE)
        channel.struct.coordinate = COORDINATES[name]
        return channel

    def _channel(self, attribute: str, quantity: int) -> Channel:
        return Channel(f"{self.name}.{attribute}", quantity, joint=self.id)


class Force(Element):
    """A spring, a load or a user force."""

    family = "force"


class Input(Element):
    """An input: a number that your program sets during a run. Mechanism.input() adds one."""

    family = "input"

    @property
    def initial(self) -> float:
        """The value with which every run and every workspace starts."""
        return self.mechanism.initial(self)

    @property
    def definition(self) -> dict[str, Any]:
        """The name and the initial value as a dict."""
        return {"name": self.name, "initial": self.initial}


CLASSES: dict[str, type[Element]] = {"body": Body, "joint": Joint, "force": Force, "input": Input}
