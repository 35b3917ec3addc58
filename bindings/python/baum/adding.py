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

    Each method returns a handle of the new element. To refer to a body, joint or input, pass its
    handle or its name. All methods have the argument `name`. Messages contain this name, and
    m["crank"] returns the handle of the element named "crank". If the name is None, the element
    gets a name with a number, for example "body1". If any other argument is None, its default
    applies, which the docstring of the method states.

    Errors: TypeError for a value of a wrong type; ValueError for a wrong size and for a name that
        is already taken; KeyError for a name that does not exist; baum.Error for a value that the
        library refuses, and for every call after freeze().
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

        mass: [kg], positive.
        inertia: moment of inertia about the centre of mass [kg m^2], positive. It has no influence
            if the body cannot rotate; otherwise always give it.
        position: x and y of the centre of mass in the design configuration [m].
        angle: angle of the body in the design configuration [rad].
        velocity: velocity of the centre of mass at the start [m/s]. With None or NaN, assembly
            determines it.
        angular_velocity: angular velocity at the start [rad/s]. With None or NaN, assembly
            determines it.
        held: True if assembly must not move the body.
        outline: how the body is drawn, see Body.outline.
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

        mass: [kg], positive.
        position: x and y in the design configuration [m].
        velocity: velocity at the start [m/s]. With None or NaN, assembly determines it.
        held: True if assembly must not move the particle.
        outline: how the particle is drawn, see Body.outline.
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
        """Add `size` generalized coordinates. Functions of yours compute the mass matrix and the
        forces of these coordinates.

        mass(t, q): the mass matrix M (size x size).
        force(t, q, v): the force vector g (size).
        force_q, force_v: derivatives of the force with respect to q and v (size x size). By default
            the library computes them by finite differences.
        potential(t, q): potential energy of the force [J].
        q: (size) positions in the design configuration, by default 0.
        v: (size) velocities at the start. By default assembly determines them.
        scale: (size) typical change of each position. Tolerances are relative to this change.
        constant_mass: True if M is constant.
        held: True if assembly must not move these coordinates.
        inputs: inputs whose values are passed to force, force_q and force_v as further arguments
            after v.
        depends_on_velocity: False if force() does not read v. The integrator "rattle" requires
            False.
        user: passed to compiled functions as the last argument: an address or an object of ctypes.

        If the positions do not form a vector space, for example if they are a unit quaternion, also
        give the arguments below. The positions q and their displacements (small changes of
        position) then have different numbers of entries: q has `position_count` entries, and a
        displacement has `size` entries, like v. Derivatives with respect to q, such as force_q, are
        then derivatives along displacements, so they have `size` columns.

        position_count: number of positions, which is then the length of q.
        rate(q, v): the time derivative of q, N(q) v.
        move(h, v, q): the position that is reached from q after the time h with the constant
            velocity v.
        difference(a, b): the displacement v from a to b, for which move(1, v, a) is b.
        normalize(q): the point of the configuration manifold that is nearest to q.
        position_scale: (position_count) typical change of each position, by default 1. The argument
            `scale` then gives the typical change of each entry of a displacement.
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
        """Add a revolute joint (pin): a point of body_a and a point of body_b coincide.

        The joint has two rows [m]. Its coordinate is the angle of body_b minus the angle of body_a,
        angle_b - angle_a [rad]. Give either `point`, or both point_a and point_b.

        point: the common point in the design configuration, in ground axes [m].
        point_a, point_b: the points in the axes of body_a and body_b [m].
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
        """Add a translational joint (slider): body_b slides along an axis of body_a and does not
        rotate relative to body_a.

        The joint has two rows: one in [m] and one in [rad]. Its coordinate is the displacement from
        body_a's point to body_b's point along the axis [m]. Give either `point`, or both point_a
        and point_b.

        point: the common point in the design configuration, in ground axes [m].
        point_a, point_b: the points in the axes of body_a and body_b [m].
        axis: direction of the axis. It is in ground axes if `point` is given, otherwise in the axes
            of body_a.
        angle: the constant value of angle_b - angle_a [rad], by default the value in the design
            configuration.
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
        """Add a massless rod between two points. The joint has one row, with the unit m.

        point_a, point_b: the ends of the rod in the axes of body_a and body_b [m].
        length: length of the rod [m], positive; by default the distance between the two points in
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
        """Add a weld: two bodies do not move relative to each other.

        The joint has three rows: two in [m] and one in [rad]. Give either `point`, or both point_a
        and point_b.

        point: the common point in the design configuration, in ground axes [m].
        point_a, point_b: the points in the axes of body_a and body_b [m].
        angle: the constant value of angle_b - angle_a [rad], by default the value in the design
            configuration.
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
        """Add a pin of body_b that slides and rotates in a straight slot of body_a.

        The joint has one row [m]. Its coordinate is the displacement from body_a's point to
        body_b's point along the axis of the slot [m]. Give either `point`, or both point_a and
        point_b.

        point: the common point in the design configuration, in ground axes [m].
        point_a, point_b: the points in the axes of body_a and body_b [m].
        axis: direction of the slot. It is in ground axes if `point` is given, otherwise in the axes
            of body_a.
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
        """Add a pinion of body_b that rolls on a rack of body_a without slipping.

        The axis is the direction of the rack, and body_b's point is the centre of the pinion. The
        joint has one row [m]: displacement - radius (angle_b - angle_a) - offset. The displacement
        is measured from body_a's point to body_b's point along the axis.

        axis, point, point_a, point_b: as in translational().
        radius: radius of the pitch circle [m]. It is positive if the rack is to the left of the
            pinion, seen in the direction of the axis, and negative if the rack is to the right. For
            the axis (1, 0), right means below.
        offset: the offset in the row [m]. By default it makes the row 0 in the design
            configuration.
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
        """Add a pair of gears: two wheels, body_a and body_b, roll on each other. A carrier holds
        their axles.

        The joint has one row [m]: radius_a (angle_a - angle_c) + radius_b (angle_b - angle_c) -
        offset. angle_c is the angle of the carrier.

        radius_a, radius_b: radii of the pitch circles [m]; negative for a ring with internal teeth.
        carrier: the body that carries both wheels, by default ground.
        offset: the offset in the row [m]. By default it makes the row 0 in the design
            configuration.
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
        """Keep a point of body_b on a curve F(x, y) = 0 that is fixed in body_a. The joint has one
        row.

        Choose F such that the length of its gradient is about 1 near the curve. F is then
        approximately the distance from the curve. Give either `point`, or both point_a and point_b.

        curve(xy): F [m] and its partial derivatives F_x, F_y, F_xx, F_xy, F_yy at the point xy [m].
            The coordinates xy are in the axes of body_a, with body_a's point as origin.
        point: the origin of the curve in the design configuration, in ground axes [m].
        point_a, point_b: the origin of the curve in the axes of body_a, and the point of body_b in
            the axes of body_b [m].
        user: passed to a compiled function as its last argument.
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
        """Allow a point of body_a to move only in the direction of a blade that is fixed in body_a.
        Examples are a skate, and a wheel seen from above.

        The joint has one row at velocity level [m/s]: the velocity of the point across the blade is
        zero. Give either `point` or point_a.

        axis: direction of the blade. It is in ground axes if `point` is given, otherwise in the
            axes of body_a.
        point: the point of the blade in the design configuration, in ground axes [m].
        point_a: the point of the blade in the axes of body_a [m].
        body_b: the body on which the blade slides, by default ground.
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
        """Couple two joints: their coordinates a and b satisfy b = ratio a + offset, or b = f(a).

        The joint has one row. A coupling of the two coordinates of one cylindrical joint makes this
        joint a screw. A coupling with a law can describe a cam.

        ratio: change of b divided by change of a, in the unit of b per unit of a.
        offset: in the unit of b, [rad] or [m]. By default the offset is such that the design
            configuration satisfies the row.
        law(a): f(a), its first and its second derivative. The law replaces ratio and offset, which
            must then have their defaults.
        user: passed to a compiled function as its last argument.
        coordinate_a, coordinate_b: which coordinate of each joint, as in driver().
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
        """Prescribe a coordinate of a joint as a function of time.

        The driver has one row: the coordinate [rad] or [m] equals value + rate t + acceleration t^2
        / 2, or the first of the three numbers that law(t) returns.

        value: value of the coordinate at t = 0 [rad] or [m]. If the design configuration has
            another value, assembly moves the bodies. To start a crank at its angle in the design
            configuration, let `value` be this angle.
        rate: first derivative of the coordinate at t = 0 [rad/s] or [m/s].
        acceleration: second derivative of the coordinate, constant [rad/s^2] or [m/s^2].
        law(t): the value of the coordinate, its first and its second derivative at the time t [s].
            The law replaces value, rate and acceleration, which must then be 0.
        user: passed to a compiled function as its last argument.
        coordinate: which coordinate of the joint the driver prescribes. The list below gives the
            names for each type of joint, and "first" stands for the first of these names.

        - Revolute joints have "angle".
        - Translational joints, pins in a slot, prismatic joints and points on a line have
          "displacement".
        - A cylindrical joint and a screw have "displacement" and "angle".
        - A universal joint has "angle" and "angle_b".
        - A planar joint in space has "x", "y" and "angle".
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
        """Prescribe a coordinate of a joint by a cubic spline through given values.

        The driver has one row. Before the first and after the last time, the spline continues as a
        straight line, unless it is periodic.

        times: (n) at least 3 times in rising order [s].
        values: (n) values of the coordinate at these times [rad] or [m].
        periodic: True if the spline repeats. The first and the last value must then be equal.
        coordinate: which coordinate of the joint, as in driver().
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
        """Add constraints Phi(t, q) = 0 on the coordinates q of one body or of several bodies.

        rows: number of constraints.
        phi(t, q): Phi (rows).
        jacobian(t, q): the Jacobian J (rows x nv).
        nu(t, q): minus the partial derivative of Phi with respect to t (rows).
        gamma(t, q, v): gamma, the right-hand side of the equation J a = gamma for the accelerations
            a (rows).
        user: passed to compiled functions as the last argument.

        Only `phi` is required. If you do not give the other functions, the library computes them by
        differences, for which it calls `phi` often: for two coordinates, about 150 times in a step
        of "rk4". If you also give `jacobian` and `gamma`, a step calls the three functions 50 times
        in total. A call of a short Python function takes one to two microseconds. If this time
        matters, give the derivatives, or give compiled functions, which can be addresses, ctypes
        function pointers, or Numba's cfunc.

        velocity_level: True if the constraints are non-holonomic: they are J v = nu, and there is
            no Phi. Examples are a skate, and a wheel that does not slip. `jacobian` is then
            required, and `phi` must be None:

        >>> import math, baum
        >>> m = baum.Mechanism(gravity=(0, 0, 0))
        >>> skate = m.planar_body(
        ...     "skate", mass=1, inertia=0.1, velocity=(1, 0), angular_velocity=0.5
        ... )
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
        """Add a spring and a damper between two points. Their force is linear, or a law computes
        it.

        point_a, point_b: the points in the axes of body_a and body_b [m].
        stiffness: [N/m].
        damping: [N s/m].
        free_length: length at which the spring exerts no force [m], by default the distance between
            the two points in the design configuration.
        law(length, rate): the tension [N] and its derivatives with respect to length and rate,
            where rate is the time derivative of the length. The law replaces stiffness, damping and
            free_length, which must then have their defaults. A spring with a law has no potential
            energy.
        depends_on_velocity: False if the law does not read rate. The integrator "rattle" requires
            False.
        user: passed to a compiled function as its last argument.
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
        """Add a torsion spring and a damper on the angle of body_b relative to body_a, angle_b -
        angle_a. This angle is continuous over several revolutions.

        stiffness: [N m/rad].
        damping: [N m s/rad].
        free_angle: angle at which the spring exerts no torque [rad], by default the angle in the
            design configuration.
        law(angle, rate): the restoring torque [N m] and its derivatives with respect to angle and
            rate, where rate is the time derivative of the angle. The law replaces stiffness,
            damping and free_angle, which must then have their defaults. A spring with a law has no
            potential energy.
        depends_on_velocity, user: as in spring().
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
        """Add a spring and a damper on a coordinate of a joint, in the plane or in space.

        coordinate: which coordinate of the joint, as in driver(). During a run, angles are
            continuous over several revolutions.
        stiffness: [N m/rad] or [N/m].
        damping: [N m s/rad] or [N s/m].
        free_value: value of the coordinate at which the spring exerts no force or torque [rad] or
            [m], by default the value in the design configuration.
        law(coordinate, rate): the restoring torque [N m] or force [N] and its derivatives with
            respect to both arguments; rate is the time derivative of the coordinate. The law
            replaces stiffness, damping and free_value, which must then have their defaults. A
            spring with a law has no potential energy.
        depends_on_velocity, user: as in spring().
        """
        return self._add(Force, "joint_spring", locals())

    def joint_load(
        self,
        name: str | None,
        joint: JointLike,
        *,
        coordinate: Coordinate = "first",
        effort: Scalar = 0.0,
        input: InputLike | None = None,
    ) -> Force:
        """Add a force or a torque on a coordinate of a joint, in the plane or in space, such as the
        torque of a motor. It acts on body_b of the joint, and with the opposite sign on body_a.

        coordinate: which coordinate of the joint, as in driver().
        effort: torque on an angle [N m] or force on a displacement [N]. It drives the coordinate in
            its positive direction if it is positive.
        input: an input of the mechanism, see input(). Its value multiplies the effort.
        """
        return self._add(Force, "joint_load", locals())

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
        """Add a force at a point of a body, and a torque on the body.

        force: [N].
        point: where the force acts, in body axes [m].
        torque: [N m].
        follows_body: True if the force rotates with the body, False if it keeps its direction in
            ground axes.
        input: an input of the mechanism, see input(). Its value multiplies force and torque.
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
        """Add a generalized force on one body or on several bodies.

        The arguments q and v of the functions are the positions and velocities of these bodies. nv
        is the number of these velocities.

        force(t, q, v): the generalized force (nv). For a planar body it consists of a force x, y
            [N] and a moment [N m]. For a spatial body it consists of a force x, y, z in ground axes
            and a moment x, y, z in body axes. The force acts at the centre of mass.
        force_q, force_v: derivatives of the force with respect to q and v (nv x nv). By default the
            library computes them by finite differences.
        potential(t, q): potential energy of the force [J].
        inputs: inputs of the mechanism, see input(). The functions receive their values as further
            arguments after v. With inputs=["torque"] the library calls force(t, q, v, torque).
        depends_on_velocity: False if force() does not read v. The integrator "rattle" requires
            False.
        user: passed to compiled functions as the last argument.
        """
        return self._add(Force, "user_force", locals())

    # ---- inputs ----------------------------------------------------------------------------------

    def input(self, name: str | None = None, initial: Scalar = 0.0) -> Input:
        """Add an input: a number that your program sets during a run, such as the torque of a
        motor.

        To use an input, name it in the argument `input` of a load, or in the argument `inputs` of a
        force function. Every run and every workspace starts with the value `initial` of the input,
        and keeps this value until you call set_input() of the run or the workspace.
        """
        name = self._new_name(name, "input")
        initial = number(initial, f'input "{name}": initial')
        id = _abi.baum_input_id()
        self._owner.call(lib.baum_mechanism_add_input, name.encode(), initial, ctypes.byref(id))
        self._entries[name] = Entry("input", None, id, 0, 0)
        handle: Input = self[name]
        return handle

    # ---- common code -----------------------------------------------------------------------------

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
