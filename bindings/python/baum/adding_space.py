# SPDX-License-Identifier: BSD-3-Clause
"""Adding bodies, joints and forces in space to a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence, TypeVar

from .elements import Body, Element, Force, Joint
from .outlines import OutlineLike
from .typing import (
    ArrayLike,
    BodyLike,
    CurveFunction,
    InputLike,
    LawOfLength,
    OrientationLike,
    Scalar,
)

Added = TypeVar("Added", bound=Element)


class AddingInSpace:
    """The methods of a Mechanism that add an element in space. The class Adding describes what all
    methods that add elements have in common.

    A point is given by its coordinates x, y, z [m]. The place of a joint is given either by
    `point`, in ground axes and in the design configuration, or by `point_a` and `point_b`, in the
    axes of the bodies. `axis` is a direction on body_a, and `axis_b` is the corresponding direction
    on body_b. These two vectors may have any length except 0. They are in ground axes if `point` is
    given, otherwise in the axes of the bodies. By default, `axis_b` coincides with `axis` in the
    design configuration. Spatial joints and springs can also connect planar bodies and planar
    particles, which stay in the plane z = 0.
    """

    if TYPE_CHECKING:

        def _add(self, made: type[Added], kind_name: str, given: dict[str, Any]) -> Added: ...

    # ---- bodies ----------------------------------------------------------------------------------

    def spatial_body(
        self,
        name: str | None = None,
        *,
        mass: Scalar = 1.0,
        inertia: ArrayLike = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0),
        position: ArrayLike = (0.0, 0.0, 0.0),
        orientation: OrientationLike = (1.0, 0.0, 0.0, 0.0),
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        held: bool = False,
        outline: OutlineLike = None,
    ) -> Body:
        """Add a rigid body in space.

        mass: [kg], positive.
        inertia: inertia about the centre of mass in body axes [kg m^2]: the six numbers xx, yy, zz,
            xy, xz, yz of the tensor, the three principal moments, or a 3 x 3 matrix. baum.inertia
            computes tensors of solids.
        position: x, y, z of the centre of mass in the design configuration [m].
        orientation: orientation in the design configuration: a unit quaternion w, x, y, z, a 3 x 3
            rotation matrix whose columns are the body axes, or a Rotation of
            scipy.spatial.transform.
        velocity: velocity of the centre of mass at the start, in ground axes [m/s]. With None or
            NaN, assembly determines it.
        angular_velocity: angular velocity at the start, in body axes [rad/s]. With None or NaN,
            assembly determines it.
        held: True if assembly must not move the body.
        outline: how the body is drawn, see Body.outline.
        """
        return self._add(Body, "spatial_body", locals())

    def spatial_particle(
        self,
        name: str | None = None,
        *,
        mass: Scalar = 1.0,
        position: ArrayLike = (0.0, 0.0, 0.0),
        velocity: ArrayLike | None = None,
        held: bool = False,
        outline: OutlineLike = None,
    ) -> Body:
        """Add a point mass in space.

        mass: [kg], positive.
        position: x, y, z in the design configuration [m].
        velocity: velocity at the start [m/s]. With None or NaN, assembly determines it.
        held: True if assembly must not move the particle.
        outline: how the particle is drawn, see Body.outline.
        """
        return self._add(Body, "spatial_particle", locals())

    # ---- joints ----------------------------------------------------------------------------------

    def spherical(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a spherical joint (ball joint): a point of body_a and a point of body_b coincide.

        The joint has three rows [m]. Give either `point`, or both point_a and point_b.

        point: the common point in the design configuration, in ground axes [m].
        point_a, point_b: the points in the axes of body_a and body_b [m].
        """
        return self._add(Joint, "spatial_spherical", locals())

    def spatial_revolute(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a revolute joint (hinge) in space: body_b rotates about an axis of body_a.

        The joint has five rows: three let the points of both bodies coincide [m], and two make
        their axes parallel [-]. The coordinate of the joint is the angle of body_b relative to
        body_a about the axis [rad]. It is 0 in the design configuration. During a run it is
        continuous over several revolutions. Give either `point`, or both point_a and point_b.

        point: the common point in the design configuration, in ground axes [m].
        point_a, point_b: the points in the axes of body_a and body_b [m].
        axis, axis_b: the directions of the axis on body_a and on body_b. They are in ground axes if
            `point` is given, otherwise in the axes of the bodies. By default, axis_b coincides with
            axis in the design configuration.
        """
        return self._add(Joint, "spatial_revolute", locals())

    def universal(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a universal joint (Hooke's joint): a cross connects two bodies.

        The cross rotates about `axis` on body_a, and body_b rotates relative to the cross about
        `axis_b`. The joint has four rows: three let the points of both bodies coincide [m], and one
        keeps the two axes perpendicular [-]. The joint has two coordinates [rad], which are 0 in
        the design configuration: "angle" is the angle of the cross relative to body_a about `axis`,
        and "angle_b" is the angle of body_b relative to the cross about `axis_b`.

        point, point_a, point_b: as in spatial_revolute().
        axis, axis_b: the directions of the two axes. They are in ground axes if `point` is given,
            otherwise in the axes of body_a and body_b.
        """
        return self._add(Joint, "spatial_universal", locals())

    def cylindrical(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a cylindrical joint: body_b slides along an axis of body_a and rotates about this
        axis.

        The joint has four rows: two make the axes of both bodies parallel [-], and two keep
        body_b's point on the axis through body_a's point [m]. The joint has two coordinates:
        "displacement" is the displacement from body_a's point to body_b's point along the axis [m],
        and "angle" is the angle about the axis [rad], which is 0 in the design configuration.

        point, point_a, point_b, axis, axis_b: as in spatial_revolute().
        """
        return self._add(Joint, "spatial_cylindrical", locals())

    def prismatic(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a prismatic joint: body_b slides along an axis of body_a and does not rotate relative
        to body_a.

        The joint has five rows: two make the axes of both bodies parallel [-], two keep body_b's
        point on the axis through body_a's point [m], and one prevents a rotation about the axis
        [-]. The coordinate of the joint is the displacement from body_a's point to body_b's point
        along the axis [m].

        point, point_a, point_b, axis, axis_b: as in spatial_revolute().
        """
        return self._add(Joint, "spatial_prismatic", locals())

    def spatial_planar(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
        x_axis: ArrayLike | None = None,
    ) -> Joint:
        """Add a planar joint: body_b moves in a plane of body_a. The axis is the normal of the
        plane.

        The joint has three rows: two make the normals of both bodies parallel [-], and one keeps
        body_b's point in the plane [m]. The joint has three coordinates: "x" and "y" are the
        displacements from body_a's point to body_b's point in the plane [m], and "angle" is the
        angle about the normal [rad], which is 0 in the design configuration.

        point, point_a, point_b, axis, axis_b: as in spatial_revolute().
        x_axis: direction of x. It is in ground axes if `point` is given, otherwise in the axes of
            body_a. By default it is the ground x axis, or the ground y axis if the normal is along
            the ground x axis.
        """
        return self._add(Joint, "spatial_planar", locals())

    def spatial_fixed(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
    ) -> Joint:
        """Add a weld in space: two bodies do not move relative to each other. They keep the
        relative orientation that they have in the design configuration.

        The joint has six rows: three for the points [m] and three for the orientation [-].

        point, point_a, point_b: as in spherical().
        """
        return self._add(Joint, "spatial_fixed", locals())

    def spatial_distance(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        length: Scalar | None = None,
    ) -> Joint:
        """Add a massless rod between two points in space. The joint has one row, with the unit m.

        point_a, point_b: the ends of the rod in the axes of body_a and body_b [m].
        length: length of the rod [m], positive; by default the distance between the two points in
            the design configuration.
        """
        return self._add(Joint, "spatial_distance", locals())

    def point_on_line(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
    ) -> Joint:
        """Keep a point of body_b on a line of body_a.

        The line passes through body_a's point. The joint has two rows [m]. Its coordinate is the
        displacement from body_a's point to body_b's point along the line [m]. body_b may be a
        particle.

        axis: direction of the line, as in spatial_revolute().
        point, point_a, point_b: as in spatial_revolute().
        """
        return self._add(Joint, "spatial_point_on_line", locals())

    def point_on_plane(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
    ) -> Joint:
        """Keep a point of body_b in a plane of body_a.

        The plane contains body_a's point. The joint has one row [m]. body_b may be a particle.

        axis: normal of the plane, as in spatial_revolute().
        point, point_a, point_b: as in spatial_revolute().
        """
        return self._add(Joint, "spatial_point_on_plane", locals())

    def spatial_curve(
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
        """Keep a point of body_b on a curve that is fixed in body_a, like a bead on a wire.

        Two surfaces F(x, y, z) = 0 and G(x, y, z) = 0 intersect in the curve. The joint has two
        rows, F and G [m]. Choose F and G such that the lengths of their gradients are about 1 near
        the curve. For a helix with the radius r and the rise c per radian, F = x - r cos(z / c) and
        G = y - r sin(z / c). Give either `point`, or both point_a and point_b.

        curve(xyz): F [m] and its partial derivatives F_x, F_y, F_z, F_xx, F_xy, F_xz, F_yy, F_yz,
            F_zz at the point xyz [m], then the same ten numbers of G. The coordinates xyz are in
            the axes of body_a, with body_a's point as origin.
        point: the origin of the curve in the design configuration, in ground axes [m].
        point_a, point_b: the origin of the curve in the axes of body_a, and the point of body_b in
            the axes of body_b [m].
        user: passed to a compiled function as its last argument.
        """
        return self._add(Joint, "spatial_curve", locals())

    def rolling_disc(
        self,
        name: str | None,
        body_b: BodyLike,
        radius: Scalar,
        *,
        rim_radius: Scalar = 0.0,
        centre: ArrayLike = (0.0, 0.0, 0.0),
        axis_b: ArrayLike = (0.0, 0.0, 1.0),
        body_a: BodyLike | None = None,
        point_a: ArrayLike = (0.0, 0.0, 0.0),
        normal: ArrayLike = (0.0, 1.0, 0.0),
    ) -> Joint:
        """Let a disc, wheel or sphere of body_b roll without slipping on a plane of body_a.

        The joint has three rows: one keeps the lowest point of the disc in the plane [m], and two
        at velocity level make the velocity of the contact point zero in two directions of the plane
        [m/s]. The reaction of the joint is the force and the moment on body_b at the contact point.

        radius: largest radius of the disc [m], positive.
        body_a: the body in which the plane is fixed, by default ground.
        point_a: a point of the plane in the axes of body_a [m].
        normal: normal of the plane in the axes of body_a. It points towards the disc.
        centre: centre of the disc in the axes of body_b [m].
        axis_b: direction of the disc's axis, in the axes of body_b.
        rim_radius: radius of the circular cross-section of the rim [m], from 0 to `radius`. If
            rim_radius is 0, the disc is thin; if it equals `radius`, the disc is a sphere.
        """
        return self._add(Joint, "spatial_rolling_disc", locals())

    def spatial_knife_edge(
        self,
        name: str | None,
        body_a: BodyLike,
        *,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        body_b: BodyLike | None = None,
    ) -> Joint:
        """Prevent a point of body_a from moving relative to body_b along an axis that is fixed in
        body_a. For a skate, the axis is perpendicular to the sides of the blade.

        The joint has one row at velocity level [m/s]: the velocity of the point along the axis is
        zero. The joint does not keep the point on a surface. Give either `point` or point_a.

        axis: direction in which the point does not move. It is in ground axes if `point` is given,
            otherwise in the axes of body_a. In the planar knife_edge(), `axis` is the direction of
            the blade instead.
        point: the point in the design configuration, in ground axes [m].
        point_a: the point in the axes of body_a [m].
        body_b: the body on which the blade slides, by default ground.
        """
        return self._add(Joint, "spatial_knife_edge", locals())

    def screw(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        pitch: Scalar,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
        offset: Scalar | None = None,
    ) -> Joint:
        """Add a screw joint: body_b rotates about an axis of body_a, and moves along this axis by
        the pitch per revolution. The joint has five rows: two make the axes of both bodies parallel
        [-], two keep body_b's point on the axis of body_a [m], and one describes the thread [m].

        pitch: displacement of body_b per revolution [m]; positive for a right-handed thread.
        offset: displacement at which the angle is 0 [m]; by default the displacement in the design
            configuration.

        All other arguments are as in cylindrical(), and so are the coordinates "displacement" and
        "angle".
        """
        return self._add(Joint, "spatial_screw", locals())

    def constant_velocity(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
    ) -> Joint:
        """Connect two shafts that meet at a point, so that they rotate with equal angular
        velocities about their axes. The angle between the axes may have any value. A motion may
        pass 180 degrees. The joint has four rows: three for the points [m] and one for the
        rotation [-].

        axis, axis_b: directions of the shafts. All arguments are given as in spatial_revolute().
        """
        return self._add(Joint, "spatial_constant_velocity", locals())

    # ---- forces ----------------------------------------------------------------------------------

    def spatial_spring(
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
        """Add a spring and a damper between two points in space. Their force is linear, or a law
        computes it.

        point_a and point_b are the points x, y, z in the axes of body_a and body_b [m]. All other
        arguments are as in spring(). The force is zero when the points coincide.
        """
        return self._add(Force, "spatial_spring", locals())

    def cable(
        self,
        name: str | None,
        bodies: Sequence[BodyLike],
        points: ArrayLike,
        *,
        stiffness: Scalar = 0.0,
        damping: Scalar = 0.0,
        free_length: Scalar | None = None,
        law: LawOfLength | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
        transition: Scalar | None = None,
    ) -> Force:
        """Add a cable, rope or tendon, which can only pull. It runs in straight lines through
        points that are fixed in bodies. It is attached to the first and the last point, and slides
        over the other points without friction.

        With the stretch s = length - free_length, the tension is the sum of stiffness s and damping
        w(s / transition) (d/dt length) if s and this sum are positive, otherwise 0. The function
        w(x) = x^2 (3 - 2 x) grows from 0 at x = 0 to 1 at x = 1, and w(x) = 1 for x > 1. The
        tension is therefore continuous when the cable becomes taut. Between two points that
        coincide, the cable exerts no force.

        bodies: the body of each point, in the order of the path. The same body may occur several
            times.
        points: x, y, z of each point in the axes of its body [m].
        stiffness: [N/m].
        damping: [N s/m].
        free_length: length up to which the cable is slack [m], by default the length in the design
            configuration.
        law(length, rate): the tension [N] and its derivatives with respect to length and rate,
            where rate is the time derivative of the length. The law replaces stiffness, damping,
            free_length and transition, which must then have their defaults. The law must return
            zeros where the cable is slack. A cable with a law has no potential energy.
        depends_on_velocity, user: as in spring().
        transition: stretch at which the damper reaches its full strength [m], by default 1e-4 times
            free_length.
        """
        return self._add(Force, "spatial_cable", locals())

    def spatial_torsion_spring(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
        stiffness: Scalar = 0.0,
        damping: Scalar = 0.0,
        free_angle: Scalar | None = None,
        law: LawOfLength | None = None,
        depends_on_velocity: bool = True,
        user: Any = None,
    ) -> Force:
        """Add a torsion spring and a damper between two bodies in space, about an axis. Their
        torque is linear, or a law computes it.

        Points and axes are given as for joints. The angle is the twist of body_b relative to body_a
        about the axis, as in the swing-twist decomposition: the smallest rotation that makes axis_b
        parallel to axis is removed, and a rotation about the axis remains. The angle of this
        rotation is 0 in the design configuration. During a run it is continuous over several
        revolutions. All other arguments are as in torsion_spring(). If the spring should act on a
        coordinate of a joint, use joint_spring() instead.
        """
        return self._add(Force, "spatial_torsion_spring", locals())

    def bushing(
        self,
        name: str | None,
        body_a: BodyLike,
        body_b: BodyLike,
        *,
        point: ArrayLike | None = None,
        point_a: ArrayLike | None = None,
        point_b: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        axis_b: ArrayLike | None = None,
        x_axis: ArrayLike | None = None,
        stiffness: ArrayLike = (0.0,) * 36,
        damping: ArrayLike = (0.0,) * 36,
    ) -> Force:
        """Add an elastic connection of two bodies in space, with stiffness and damping in all six
        directions.

        Points and axes are given as for joints. `axis` is the z axis of the bushing, and `x_axis`
        is its x axis, given as in spatial_planar().

        stiffness, damping: symmetric 6 x 6 matrices, or the six numbers of their diagonals. The
            first three rows belong to the vector between the points [m], in the axes of the bushing
            on body_a. The last three rows belong to the rotation vector of body_b relative to
            body_a [rad]. The length of the rotation vector must stay below pi.
        """
        return self._add(Force, "spatial_bushing", locals())

    def spatial_load(
        self,
        name: str | None,
        body: BodyLike,
        *,
        point: ArrayLike = (0.0, 0.0, 0.0),
        force: ArrayLike = (0.0, 0.0, 0.0),
        moment: ArrayLike = (0.0, 0.0, 0.0),
        follows_body: bool = False,
        input: InputLike | None = None,
    ) -> Force:
        """Add a force at a point of a body in space, and a moment on the body.

        point: where the force acts, in body axes [m].
        force: [N].
        moment: [N m].
        follows_body: True if force and moment rotate with the body, False if they keep their
            directions in ground axes.
        input: an input of the mechanism, see Mechanism.input(). Its value multiplies force and
            moment.
        """
        return self._add(Force, "spatial_load", locals())
