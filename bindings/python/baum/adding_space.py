# SPDX-License-Identifier: BSD-3-Clause
"""Adding bodies, joints and forces in space to a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from .elements import Body, Element, Force, Joint
from .outlines import OutlineLike
from .typing import ArrayLike, BodyLike, InputLike, LawOfLength, OrientationLike, Scalar

Added = TypeVar("Added", bound=Element)


class AddingInSpace:
    """The methods of a Mechanism that add an element in space. The class Adding describes what all
    methods that add elements have in common.

    Points are x, y, z [m]. A joint is placed by `point` (ground axes, design configuration) or by
    `point_a` and `point_b` (body axes). `axis` is a direction of any length on body_a, and `axis_b`
    the corresponding direction on body_b: both in ground axes if `point` is given, otherwise in
    body axes. By default, `axis_b` coincides with `axis` in the design configuration. Spatial
    joints and springs also connect planar bodies and particles, which stay in the plane z = 0.
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

        mass: [kg] > 0. inertia: about the centre of mass in body axes [kg m^2]: xx, yy, zz, xy, xz,
        yz of the tensor, or the three principal moments, or a 3 x 3 matrix; baum.inertia computes
        tensors of solids. position: of the centre of mass in the design configuration, x, y, z [m].
        orientation: in the design configuration: a unit quaternion w, x, y, z, or a rotation matrix
        3 x 3 whose columns are the body axes, or a Rotation of scipy.spatial.transform. velocity:
        of the centre of mass at the start, ground axes [m/s]. angular_velocity: at the start, body
        axes [rad/s]. Velocities None or NaN: assembly chooses them. held: assembly does not move
        the body. outline: how it is drawn, as Body.outline.
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

        mass: [kg] > 0. position: in the design configuration, x, y, z [m]. velocity: at the start
        [m/s]; None or NaN: assembly chooses it. held: assembly does not move the particle. outline:
        how it is drawn, as Body.outline.
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
        """Add a spherical joint (ball joint): a point of body_a and one of body_b coincide. Three
        rows [m].

        point: in ground axes in the design configuration [m]; or point_a, point_b: in the axes of
        body_a and body_b [m].
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
        """Add a revolute joint (hinge) in space: points coincide, axes are parallel. Five rows:
        three [m], two [-].

        Its coordinate is the angle of body_b relative to body_a about the axis [rad], 0 in the
        design configuration; runs count its revolutions. point: in ground axes in the design
        configuration [m]; or point_a, point_b: in the axes of the bodies [m]. axis, axis_b:
        directions, in ground axes if `point` is given, otherwise in the axes of body_a and body_b;
        by default, axis_b coincides with axis in the design configuration.
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
        """Add a universal joint (Hooke's joint): points coincide, and `axis` of body_a and `axis_b`
        of body_b stay perpendicular. Four rows: three [m], one [-].

        Its coordinates are the "angle" of the cross about the axis of body_a, and "angle_b" of
        body_b relative to the cross about axis_b [rad], both 0 in the design configuration. axis,
        axis_b: directions, in ground axes if `point` is given, otherwise in the axes of body_a and
        body_b. point, point_a, point_b: as in spatial_revolute().
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
        """Add a cylindrical joint: body_b slides along an axis of body_a and rotates about it. Four
        rows: two [-], two [m].

        Its coordinates are the "displacement" of body_b's point along the axis [m] and the "angle"
        about it [rad], 0 in the design configuration. point, point_a, point_b, axis, axis_b: as in
        spatial_revolute().
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
        to it. Five rows: two [-], two [m], one [-].

        Its coordinate is the displacement of body_b's point along the axis [m]. point, point_a,
        point_b, axis, axis_b: as in spatial_revolute().
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
        """Add a planar joint: body_b moves in a plane of body_a, whose normal is the axis. Three
        rows: two [-], one [m].

        Its coordinates are the displacements "x" and "y" of body_b's point in the plane [m], and
        the "angle" about the normal [rad], 0 in the design configuration. point, point_a, point_b,
        axis, axis_b: as in spatial_revolute(). x_axis: direction of x, in ground axes if `point` is
        given, otherwise in the axes of body_a; by default the ground x axis, or the ground y axis
        if the normal is along x.
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
        """Add a weld in space: points coincide, and the relative orientation is that of the design
        configuration. Six rows: three [m], three [-].

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
        """Add a massless rod between two points in space. One row [m].

        point_a, point_b: in the axes of body_a and body_b [m]. length: [m] > 0, by default the
        distance in the design configuration.
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
        """Keep a point of body_b on a line that is fixed in body_a and passes through body_a's
        point. Two rows [m].

        Its coordinate is the displacement along the line [m]. body_b may be a particle. axis:
        direction of the line. axis, point, point_a and point_b are given as in
        spatial_revolute().
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
        """Keep a point of body_b in a plane that is fixed in body_a and contains body_a's point.
        One row [m].

        body_b may be a particle. axis: normal of the plane. axis, point, point_a and point_b
        are given as in spatial_revolute().
        """
        return self._add(Joint, "spatial_point_on_plane", locals())

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
        """Let a disc, wheel or sphere of body_b roll without slipping on a plane of body_a. Three
        rows: the height over the plane [m], and two of velocity level [m/s].

        radius: [m] > 0. rim_radius: of the cross-section of the rim [m]; 0 is a thin disc, radius a
        sphere. centre, axis_b: of the disc, in the axes of body_b [m], [-]. body_a: by default
        ground. point_a, normal: of the plane, in the axes of body_a [m], [-]; the normal points to
        the disc.
        """
        return self._add(Joint, "spatial_rolling_disc", locals())

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
        """Add a spring and damper between two points in space: linear, or with a law of your own.

        Points are x, y, z in body axes [m]; everything else is as in spring(). The force is zero
        where the length is 0.
        """
        return self._add(Force, "spatial_spring", locals())

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
        """Add a force at a point of a body in space and a moment on the body.

        point: in body axes [m]. force: [N]. moment: [N m]. follows_body: force and moment rotate
        with the body; otherwise they keep their directions in ground axes. input: an input
        whose value multiplies force and moment.
        """
        return self._add(Force, "spatial_load", locals())
