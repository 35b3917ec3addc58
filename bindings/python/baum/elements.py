# SPDX-License-Identifier: BSD-3-Clause
"""Bodies, joints, forces and inputs of a mechanism, as handles. Those of a mechanism and its copies
are equal."""

from collections import namedtuple

from . import _abi
from .channels import Channel
from .definitions import as_dict
from ._values import vector

_Q = _abi.baum_quantity


# What a mechanism knows about an element: its Kind (None for ground and inputs), the library's id,
# and of a body the sizes of q and v. Copies of a mechanism share it; a handle is made when it is
# asked for.
Entry = namedtuple("Entry", "family kind id nq nv")

GROUND = Entry("body", None, _abi.BAUM_GROUND, 0, 0)


def one(family):
    """The name of a family with its article: a body, an input."""
    return f"an {family}" if family[0] in "aeiou" else f"a {family}"


class Element:
    """What bodies, joints, forces and inputs have in common."""

    def __init__(self, mechanism, name, entry):
        self.mechanism = mechanism
        self.name = name
        self.kind = entry.kind
        self.id = entry.id
        self.nq = entry.nq
        self.nv = entry.nv

    def __repr__(self):
        return f"<{self.kind.name if self.kind else self.family} {self.name!r}>"

    def _identity(self):
        return self.family, self.id.index1, self.id.tag

    def __eq__(self, other):
        return isinstance(other, Element) and self._identity() == other._identity()

    def __hash__(self):
        return hash(self._identity())

    @property
    def definition(self):
        """The definition as a dict: numbers, points, bodies; functions are left out."""
        return as_dict(self.mechanism.read(self), self.mechanism.find)

    def set(self, **fields):
        """Change fields of the definition, before the mechanism is frozen. None changes nothing."""
        self.mechanism.change(self, fields)
        return self


class Body(Element):
    """Anything with coordinates: nq positions and nv velocities."""

    family = "body"

    @property
    def columns(self):
        """Its places in q and v of a frozen mechanism, two slices."""
        return self.mechanism.columns(self)

    @property
    def pose(self):
        """Channel: x, y [m] of the centre of mass and angle [rad]; x, y of a particle; else its
        q."""
        return self._channel("pose", _Q.BAUM_BODY_POSE)

    @property
    def velocity(self):
        """Channel: velocities [m/s], [rad/s] that belong to `pose`."""
        return self._channel("velocity", _Q.BAUM_BODY_VELOCITY)

    @property
    def acceleration(self):
        """Channel: accelerations [m/s^2], [rad/s^2] that belong to `pose`."""
        return self._channel("acceleration", _Q.BAUM_BODY_ACCELERATION)

    def pose_of(self, point):
        """Channel: `pose` with x, y of a point, given in body axes [m]."""
        return self._channel("pose", _Q.BAUM_BODY_POSE, point)

    def velocity_of(self, point):
        """Channel: `velocity` of a point, given in body axes [m]."""
        return self._channel("velocity", _Q.BAUM_BODY_VELOCITY, point)

    def acceleration_of(self, point):
        """Channel: `acceleration` of a point, given in body axes [m]."""
        return self._channel("acceleration", _Q.BAUM_BODY_ACCELERATION, point)

    def _channel(self, attribute, quantity, point=None):
        key, at = f"{self.name}.{attribute}", (0.0, 0.0)
        if point is not None:
            at = vector(point, 2, f"point of {self.name!r}").tolist()
            key += f"({at[0]!r}, {at[1]!r})"
        return Channel(key, quantity, body=self.id, point=(*at, 0.0))


class Joint(Element):
    """Anything with constraint rows."""

    family = "joint"

    @property
    def rows(self):
        """Its rows in Phi and lambda of a frozen mechanism, a slice."""
        return self.mechanism.rows(self)

    @property
    def phi(self):
        """Channel: constraint violation, one column per row [m], [rad]."""
        return self._channel("phi", _Q.BAUM_PHI)

    @property
    def phi_rate(self):
        """Channel: rate of the violation J v - nu."""
        return self._channel("phi_rate", _Q.BAUM_PHI_RATE)

    @property
    def multipliers(self):
        """Channel: Lagrange multipliers of the rows."""
        return self._channel("multipliers", _Q.BAUM_LAMBDA)

    @property
    def reaction(self):
        """Channel: force [N] and moment [N m] on body_b, ground axes, about the joint's point on
        body_b; for a gear, a coupling or a user constraint -J^T lambda over its bodies."""
        return self._channel("reaction", _Q.BAUM_JOINT_REACTION)

    @property
    def coordinate(self):
        """Channel: coordinate and its rate of a revolute [rad] or translational [m] joint or a pin
        in a slot [m]."""
        return self._channel("coordinate", _Q.BAUM_JOINT_COORDINATE)

    @property
    def effort(self):
        """Channel: force [N] or torque [N m] of a driver on the coordinate that it drives; times
        the coordinate's rate the power that it puts in."""
        return self._channel("effort", _Q.BAUM_DRIVE_EFFORT)

    def _channel(self, attribute, quantity):
        return Channel(f"{self.name}.{attribute}", quantity, joint=self.id)


class Force(Element):
    """A spring, a load or a user force."""

    family = "force"


class Input(Element):
    """A number that acts from outside and that runs and workspaces set; see Mechanism.input()."""

    family = "input"

    @property
    def initial(self):
        """What every run and workspace begins with."""
        return self.mechanism.initial(self)

    @property
    def definition(self):
        """Name and initial value as a dict."""
        return {"name": self.name, "initial": self.initial}


CLASSES = {"body": Body, "joint": Joint, "force": Force, "input": Input}
