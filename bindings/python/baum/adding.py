# SPDX-License-Identifier: BSD-3-Clause
"""Adding bodies, joints, forces and inputs to a mechanism."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Sequence, TypeVar, Union

from . import _abi
from ._lib import lib
from ._values import number
from .definitions import KINDS, Definition, sizes
from .elements import Body, Element, Entry, Force, Input, Joint, one
from .outlines import OutlineLike, Structs
from .typing import (
    ArrayLike,
    BodyLike,
    Coordinate,
    CurveFunction,
    ForceFunction,
    FunctionOfQ,
    FunctionOfQV,
    InputLike,
    JointLike,
    LawOfLength,
    LawOfTime,
    Manifold,
    Scalar,
)

if TYPE_CHECKING:
    from ._calls import Handle

Added = TypeVar("Added", bound=Element)
Bodies = Union[BodyLike, Sequence[BodyLike]]


class Adding:
    """The methods of a Mechanism that add an element.

    Each method returns a handle. name: a label for messages and lookups; None numbers the element,
    for example "body1". An argument that is None has the default that the method describes. Bodies,
    joints and inputs are given as handles or names.

    Errors: TypeError for values of a wrong type, ValueError for wrong sizes and names that are
    taken, KeyError for names that do not exist, and baum.Error for values that the library refuses,
    and after freeze().
    """

    _owner: Handle
    _entries: dict[str, Entry]
    _keep: list[Any]
    has_python: bool

    if TYPE_CHECKING:

        def __getitem__(self, name: str) -> Any: ...
        def find(self, family: str, value: Any) -> Any: ...
        def _count(self, family: str) -> int: ...

    # ---- bodies ----------------------------------------------------------------------------------

    def planar_body(
        self,
        name: str | None = None,
        *,
        mass: Scalar = 1.0,
        inertia: Scalar = 1.0,
        position: ArrayLike = (0.0, 0.0),
        angle: Scalar = 0.0,
        velocity: ArrayLike | None = None,
        angular_velocity: Scalar | None = None,
        held: bool = False,
        outline: OutlineLike = None,
    ) -> Body:
        """Add a rigid body in the plane.

        mass: [kg] > 0. inertia: about the centre of mass [kg m^2] > 0. position: of the centre of
        mass in the design configuration, x and y [m]. angle: in the design configuration [rad].
        velocity, angular_velocity: at the start [m/s], [rad/s]; None or NaN: free, so that assembly
        chooses them. held: assembly does not move the body. outline: how it is drawn, as
        Body.outline.
        """
        return self._add(Body, "planar_body", locals())

    def planar_particle(
        self,
        name: str | None = None,
        *,
        mass: Scalar = 1.0,
        position: ArrayLike = (0.0, 0.0),
        velocity: ArrayLike | None = None,
        held: bool = False,
        outline: OutlineLike = None,
    ) -> Body:
        """Add a point mass in the plane.

        mass: [kg] > 0. position: in the design configuration, x and y [m]. velocity: at the start
        [m/s]; None or NaN: free, so that assembly chooses it. held: assembly does not move it.
        outline: how it is drawn, as Body.outline.
        """
        return self._add(Body, "planar_particle", locals())

    def coordinates(
        self,
        name: str | None = None,
        size: int | None = None,
        *,
        mass: FunctionOfQ | None = None,
        force: ForceFunction | None = None,
        q: ArrayLike | None = None,
        v: ArrayLike | None = None,
        scale: ArrayLike | None = None,
        force_q: ForceFunction | None = None,
        force_v: ForceFunction | None = None,
        potential: FunctionOfQ | None = None,
        constant_mass: bool = False,
        held: bool = False,
        position_count: int | None = None,
        position_scale: ArrayLike | None = None,
        rate: Manifold | None = None,
        move: Manifold | None = None,
        difference: Manifold | None = None,
        normalize: Manifold | None = None,
        inputs: Sequence[InputLike] | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
    ) -> Body:
        """Add `size` generalized coordinates with a mass matrix and forces of your own.

        mass(t, q): mass matrix M (size x size). force(t, q, v): force vector g (size). force_q,
        force_v: its derivatives (size x size), by default from differences. potential(t, q): energy
        [J]. q, v: (size) design positions, default 0, and velocities at the start, default free.
        scale: (size) a typical change of each position. constant_mass: M is constant. held:
        assembly does not move them. inputs: force, force_q and force_v receive their values after
        v. depends_on_velocity: False if force() does not read v, which "rattle" requires. user: the
        last argument of compiled functions, an address or an object of ctypes.

        For positions that are not a vector, such as a unit quaternion, also give: position_count;
        rate(q, v): q' = N(q) v; move(h, v, q): q after the time h at constant v; difference(a, b):
        the v for which move(1, v, a) is b; normalize(q): the nearest q on the configuration
        manifold; position_scale: a typical change of each position. Derivatives with respect to q
        are then derivatives along displacements (size).
        """
        return self._add(Body, "coordinates", locals())

    # ---- joints ----------------------------------------------------------------------------------

    def revolute(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a revolute joint (pin): a point of body_a and one of body_b coincide. Two rows [m].

        Its coordinate is angle_b - angle_a [rad]. point: in ground axes in the design configuration
        [m]; or point_a, point_b: in the axes of body_a and body_b [m].
        """
        return self._add(Joint, "planar_revolute", locals())

    def translational(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        axis: ArrayLike = (1.0, 0.0),
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        angle: Scalar | None = None,
    ) -> Joint:
        """Add a translational joint (slider): body_b moves along an axis of body_a and does not
        rotate relative to it. Two rows [m], [rad].

        Its coordinate is the displacement of body_b's point along the axis [m]. axis: direction, in
        ground axes with `point`, else in the axes of body_a. point: in ground axes in the design
        configuration [m]; or point_a, point_b: in the axes of the bodies [m]. angle: the constant
        value of angle_b - angle_a [rad], by default taken from the design configuration.
        """
        return self._add(Joint, "planar_translational", locals())

    def distance(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        length: Scalar | None = None,
    ) -> Joint:
        """Add a massless rod between two points. One row [m].

        point_a, point_b: in the axes of body_a and body_b [m]. length: [m] > 0, by default as in
        the design configuration.
        """
        return self._add(Joint, "planar_distance", locals())

    def fixed(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        angle: Scalar | None = None,
    ) -> Joint:
        """Add a weld: two bodies do not move relative to each other. Three rows [m], [m], [rad].

        point: in ground axes in the design configuration [m]; or point_a, point_b: in the axes of
        the bodies [m]. angle: angle_b - angle_a [rad], by default as in the design configuration.
        """
        return self._add(Joint, "planar_fixed", locals())

    def pin_in_slot(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        axis: ArrayLike = (1.0, 0.0),
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a pin of body_b that slides and rotates in a straight slot of body_a. One row [m].

        Its coordinate is the displacement of body_b's point along the axis [m]. axis: direction, in
        ground axes with `point`, else in the axes of body_a. point: in ground axes in the design
        configuration [m]; or point_a, point_b: in the axes of the bodies [m].
        """
        return self._add(Joint, "planar_pin_in_slot", locals())

    def rack_and_pinion(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        radius: Scalar,
        *,
        axis: ArrayLike = (1.0, 0.0),
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        offset: Scalar | None = None,
    ) -> Joint:
        """Add a pinion of body_b that rolls on a rack of body_a. body_b's point is its centre, and
        the axis is the direction of the rack. One row [m]: displacement - radius (angle_b -
        angle_a) = offset.

        radius: [m]; positive if the rack is on the left of the centre, looking along the axis;
        negative if it is on the right, which is below for the axis (1, 0). axis, point, point_a,
        point_b: as in translational(). offset: [m], by default as in the design configuration.
        """
        return self._add(Joint, "planar_rack_and_pinion", locals())

    def gear(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        radius_a: Scalar,
        radius_b: Scalar,
        *,
        carrier: BodyLike | None = None,
        offset: Scalar | None = None,
    ) -> Joint:
        """Add a gear of two wheels on a carrier. One row [m]:
        radius_a (angle_a - angle_c) + radius_b (angle_b - angle_c) = offset.

        radius_a, radius_b: [m]; negative for a ring with internal teeth. carrier: default ground.
        offset: [m], by default as in the design configuration.
        """
        return self._add(Joint, "planar_gear", locals())

    def curve(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        curve: CurveFunction,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        user: Any = None,
    ) -> Joint:
        """Keep a point of body_b on a curve F(x, y) = 0 that is fixed in body_a. One row.

        curve(xy): F [m], F_x, F_y, F_xx, F_xy, F_yy at x and y [m] from body_a's point, in the axes
        of body_a. Choose F with a gradient of about 1 near the curve, so that F is about the
        distance from it. point: in ground axes in the design configuration [m]; or point_a,
        point_b: in the axes of the bodies [m]. user: what a compiled function receives.
        """
        return self._add(Joint, "planar_curve", locals())

    def knife_edge(
        self,
        name: str | None,
        body_a: BodyLike,
        *,
        axis: ArrayLike = (1.0, 0.0),
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        body_b: BodyLike | None = None,
    ) -> Joint:
        """Let a point of body_a move only along a blade that is fixed in body_a, such as a skate or
        a wheel seen from above. One row of velocity level [m/s]: the velocity across the blade.

        axis: direction of the blade, in ground axes if point is given, otherwise in the axes of
        body_a. point: of the blade, in ground axes in the design configuration [m]; or point_a: in
        the axes of body_a [m]. body_b: the surface on which the blade slides, by default ground.
        """
        return self._add(Joint, "planar_knife_edge", locals())

    def coupling(
        self,
        name: str | None,
        joint_a: JointLike,
        joint_b: JointLike,
        *,
        ratio: Scalar = 1.0,
        offset: Scalar | None = None,
        law: LawOfTime | None = None,
        user: Any = None,
        coordinate_a: Coordinate = "first",
        coordinate_b: Coordinate = "first",
    ) -> Joint:
        """Couple the coordinates a and b of two joints. One row: b = ratio a + offset, or b = f(a).

        ratio: unit of b per unit of a. offset: in the unit of b, [rad] or [m], by default taken
        from the design configuration. law(a): f(a) and its first and second derivative, for example
        of a cam. user: what a compiled function receives. coordinate_a, coordinate_b: as in
        driver(); the two coordinates of one cylindrical joint make it a screw.
        """
        return self._add(Joint, "coupling", locals())

    def driver(
        self,
        name: str | None,
        joint: JointLike,
        *,
        value: Scalar = 0.0,
        rate: Scalar = 0.0,
        acceleration: Scalar = 0.0,
        law: LawOfTime | None = None,
        user: Any = None,
        coordinate: Coordinate = "first",
    ) -> Joint:
        """Prescribe a coordinate of a joint [rad] or [m]. One row: coordinate = value + rate t +
        acceleration t^2 / 2, or law(t).

        value: [rad] or [m]. rate: [rad/s] or [m/s]. acceleration: [rad/s^2] or [m/s^2]. law(t):
        value, rate and acceleration at the time t [s]. user: what a compiled function receives.
        coordinate: "angle" of revolute joints, "displacement" of translational joints, pins in a
        slot, prismatic joints and points on a line; of a cylindrical joint "displacement" or
        "angle", of a universal joint "angle" or "angle_b", of a planar joint in space "x", "y" or
        "angle". "first" is the first of these.
        """
        return self._add(Joint, "driver", locals())

    def spline_driver(
        self,
        name: str | None,
        joint: JointLike,
        times: ArrayLike,
        values: ArrayLike,
        *,
        periodic: bool = False,
        coordinate: Coordinate = "first",
    ) -> Joint:
        """Prescribe a coordinate as driver() does, by a cubic spline. One row.

        times: (n) rising [s], n >= 3. values: (n) [rad] or [m]. Before the first and after the last
        time the spline continues in a straight line. periodic: the spline repeats; the first and
        the last value must then be equal. coordinate: as in driver().
        """
        return self._add(Joint, "spline_driver", locals())

    def constraint(
        self,
        name: str | None,
        bodies: Bodies,
        rows: int,
        phi: FunctionOfQ | None = None,
        *,
        jacobian: FunctionOfQ | None = None,
        nu: FunctionOfQ | None = None,
        gamma: FunctionOfQV | None = None,
        user: Any = None,
        velocity_level: bool = False,
    ) -> Joint:
        """Add constraints Phi(t, q) = 0 over the coordinates q of one body or several bodies.

        rows: number of rows. phi(t, q): Phi (rows). jacobian(t, q): J (rows x nv). nu(t, q):
        -dPhi/dt (rows). gamma(t, q, v): the right side of J a = gamma (rows). user: what compiled
        functions receive.

        Only phi is required. The others are replaced by differences, which call phi often: about
        140 times in a step of "rk4" for two coordinates, compared with 50 calls in total if
        jacobian and gamma are given. A call takes one to two microseconds even for a short Python
        function. If that matters, give the derivatives, or compiled functions: addresses, ctypes
        function pointers, or Numba's cfunc.

        velocity_level: the constraints are J v = nu without a Phi (non-holonomic), such as a wheel
        that does not slip. jacobian is then required, and phi must be None:

        >>> import math, baum
        >>> m = baum.Mechanism(gravity=(0, 0, 0))
        >>> skate = m.planar_body("skate", mass=1, inertia=0.1, velocity=(1, 0, 0.5))
        >>> across = m.constraint(
        ...     "blade", skate, 1, velocity_level=True,
        ...     jacobian=lambda t, q: [[-math.sin(q[2]), math.cos(q[2]), 0]],
        ... )
        >>> mobility = m.mobility()
        >>> mobility.degrees_of_freedom, mobility.position_degrees_of_freedom
        (2, 3)
        """
        return self._add(Joint, "user_constraint", locals())

    # ---- forces ----------------------------------------------------------------------------------

    def spring(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        stiffness: Scalar = 0.0,
        damping: Scalar = 0.0,
        free_length: Scalar | None = None,
        law: LawOfLength | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
    ) -> Force:
        """Add a spring and damper between two points, linear or by a law.

        point_a, point_b: in the axes of body_a and body_b [m]. stiffness: [N/m]. damping: [N s/m].
        free_length: [m], by default as in the design configuration. law(length, rate): tension [N]
        and its derivatives with respect to length and rate; the spring then has no potential
        energy. depends_on_velocity: False if the law does not read the rate, which "rattle"
        requires. user: what a compiled function receives.
        """
        return self._add(Force, "planar_spring", locals())

    def torsion_spring(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        stiffness: Scalar = 0.0,
        damping: Scalar = 0.0,
        free_angle: Scalar | None = None,
        law: LawOfLength | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
    ) -> Force:
        """Add a torsion spring and damper on angle_b - angle_a, which counts whole revolutions.

        stiffness: [N m/rad]. damping: [N m s/rad]. free_angle: [rad], by default as in the design
        configuration. law(angle, rate): restoring torque [N m] and its derivatives with respect to
        angle and rate; the spring then has no potential energy. depends_on_velocity, user: as in
        spring().
        """
        return self._add(Force, "planar_torsion_spring", locals())

    def joint_spring(
        self,
        name: str | None,
        joint: JointLike,
        *,
        coordinate: Coordinate = "first",
        stiffness: Scalar = 0.0,
        damping: Scalar = 0.0,
        free_value: Scalar | None = None,
        law: LawOfLength | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
    ) -> Force:
        """Add a spring and damper on a coordinate of a joint, in the plane or in space.

        coordinate: as in driver(); runs count revolutions of angles. stiffness: [N m/rad] or [N/m].
        damping: [N m s/rad] or [N s/m]. free_value: [rad] or [m], by default as in the design
        configuration. law(coordinate, rate): restoring torque [N m] or force [N] and its
        derivatives with respect to both; the spring then has no potential energy.
        depends_on_velocity, user: as in spring().
        """
        return self._add(Force, "joint_spring", locals())

    def load(
        self,
        name: str | None,
        body: BodyLike,
        *,
        force: ArrayLike = (0.0, 0.0),
        point: ArrayLike = (0.0, 0.0),
        torque: Scalar = 0.0,
        follows_body: bool = False,
        input: InputLike | None = None,
    ) -> Force:
        """Add a force at a point of a body, and a torque.

        force: [N]. point: in body axes [m]. torque: [N m]. follows_body: the force rotates with the
        body; otherwise it keeps its direction in ground axes. input: its value multiplies force and
        torque.
        """
        return self._add(Force, "planar_load", locals())

    def force(
        self,
        name: str | None,
        bodies: Bodies,
        force: ForceFunction,
        *,
        force_q: ForceFunction | None = None,
        force_v: ForceFunction | None = None,
        potential: FunctionOfQ | None = None,
        inputs: Sequence[InputLike] | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
    ) -> Force:
        """Add a generalized force on one body or several bodies.

        force(t, q, v): the force (nv) of the coordinates q and v of these bodies: x, y [N] and a
        moment [N m] on a planar body, x, y, z in ground axes and a moment in body axes on a spatial
        body, both about the centre of mass. force_q, force_v: its derivatives (nv x nv), by default
        from differences. potential(t, q): energy [J]. inputs: the functions receive their values
        after v; with inputs=["torque"] they are called as force(t, q, v, torque).
        depends_on_velocity: False if force() does not read v, which "rattle" requires. user: what
        compiled functions receive.
        """
        return self._add(Force, "user_force", locals())

    # ---- inputs ----------------------------------------------------------------------------------

    def input(self, name: str | None = None, initial: Scalar = 0.0) -> Input:
        """Add an input: a number that acts from outside, such as the torque of a motor.

        Loads and force functions refer to inputs. Every run and workspace starts with the value
        `initial`, and keeps it until set_input() of the run or workspace changes it.
        """
        name = self._new_name(name, "input")
        initial = number(initial, f'input "{name}": initial')
        id = _abi.baum_input_id()
        self._owner.call(lib.baum_mechanism_add_input, name.encode(), initial, ctypes.byref(id))
        self._entries[name] = Entry("input", None, id, 0, 0)
        handle: Input = self[name]
        return handle

    # ---- how -------------------------------------------------------------------------------------

    def _add(self, made: type[Added], kind_name: str, given: dict[str, Any]) -> Added:
        """Add an element. given: the arguments of one of the methods above, by name."""
        kind = KINDS[kind_name]
        fields = {field: value for field, value in given.items() if field != "self"}
        outline = Structs(fields.pop("outline", None))
        name = fields["name"] = self._new_name(fields["name"], kind.family)
        definition = Definition(kind, f'{kind.family} "{name}"', self.find)
        definition.fill(fields)
        id = kind.id_type()
        outline.check()
        self._hold(definition)
        self._owner.call(kind.function("add"), ctypes.byref(definition.struct), ctypes.byref(id))
        if outline.count:
            outline.set(self._owner.address, id)
        self._entries[name] = Entry(kind.family, kind, id, *sizes(kind, definition.struct))
        handle: Added = self[name]
        return handle

    def _new_name(self, name: Any, family: str) -> str:
        if name is None:
            name = f"{family}{1 + self._count(family)}"
        if not isinstance(name, str):
            raise TypeError(f"the name of {one(family)} is a string, not {name!r}")
        if not name or any(ord(c) < 32 or ord(c) == 127 for c in name):
            raise ValueError(
                f"the name of {one(family)} is {name!r}, must have letters, but no control "
                "characters"
            )
        if name in self._entries:
            raise ValueError(f'there is already {one(self._entries[name].family)} "{name}"')
        return name

    def _hold(self, definition: Definition) -> None:
        """Keep a definition's functions alive as long as this mechanism and its copies exist."""
        self._keep.extend(definition.keep)
        self.has_python |= definition.has_python
