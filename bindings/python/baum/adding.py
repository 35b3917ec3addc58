# SPDX-License-Identifier: BSD-3-Clause
"""Adding bodies, joints, forces and inputs to a mechanism."""
import ctypes

from . import _abi
from .definitions import KINDS, Definition, sizes
from .elements import Entry, one
from ._lib import lib
from ._values import number


class Adding:
    """The part of a Mechanism that adds. Each method returns a handle.

    Fields left out keep the library's defaults, which the C headers state.
    """

    # ---- bodies ----------------------------------------------------------------------------------

    def planar_body(
        self,
        name=None,
        *,
        mass=None,
        inertia=None,
        position=None,
        angle=None,
        velocity=None,
        angular_velocity=None,
        held=None,
    ):
        """Add a rigid body in the plane: mass [kg], inertia [kg m^2] about the centre of mass,
        design position [m] and angle [rad], velocities at start [m/s], [rad/s] (free when left out),
        held: assembly keeps the design configuration."""
        return self._add("planar_body", locals())

    def planar_particle(self, name=None, *, mass=None, position=None, velocity=None, held=None):
        """Add a point mass [kg] at a design position [m], with a velocity at start [m/s]."""
        return self._add("planar_particle", locals())

    def coordinates(
        self,
        name=None,
        size=None,
        *,
        mass=None,
        force=None,
        q=None,
        v=None,
        scale=None,
        force_q=None,
        force_v=None,
        potential=None,
        constant_mass=None,
        held=None,
        position_count=None,
        position_scale=None,
        rate=None,
        move=None,
        difference=None,
        normalize=None,
        inputs=None,
        depends_on_velocity=None,
        user=None,
    ):
        """Add `size` generalized coordinates: mass(t, q) gives M (size x size), force(t, q, v) the
        force vector g (size), force_q and force_v its derivatives (size x size), potential(t, q) an
        energy [J]. q, v, scale: (size) design positions, velocities at start, a relevant change of
        each. inputs: those that force, force_q and force_v are given after v.
        depends_on_velocity: False where force() does not read v (rattle needs that).

        Positions that are not a vector, such as a unit quaternion: position_count of them, with
        rate(q, v) their rate N(q) v; move(h, v, q) where q is after the time h at constant v;
        difference(a, b) the v by which move(1, v, a) is b; normalize(q) the nearest q on the
        manifold; position_scale a relevant change of each. Derivatives by q are then along
        displacements of velocity size."""
        return self._add("coordinates", locals())

    # ---- joints ----------------------------------------------------------------------------------

    def revolute(self, name, body_a, body_b, *, point=None, point_a=None, point_b=None):
        """Add a pin: two points coincide. Two rows [m]."""
        return self._add("planar_revolute", locals())

    def translational(
        self, name, body_a, body_b, *, axis=None, point=None, point_a=None, point_b=None, angle=None
    ):
        """Add a slider: body_b moves along an axis of body_a without turning. Two rows [m], [rad].
        angle: angle_b - angle_a that is kept [rad], default that of the design configuration."""
        return self._add("planar_translational", locals())

    def distance(self, name, body_a, body_b, *, point_a=None, point_b=None, length=None):
        """Add a rod without mass between two points. One row [m]. length [m], default that of the
        design configuration."""
        return self._add("planar_distance", locals())

    def fixed(self, name, body_a, body_b, *, point=None, point_a=None, point_b=None, angle=None):
        """Add a weld. Three rows [m], [m], [rad]. angle: angle_b - angle_a [rad], default that of
        the design configuration."""
        return self._add("planar_fixed", locals())

    def pin_in_slot(
        self, name, body_a, body_b, *, axis=None, point=None, point_a=None, point_b=None
    ):
        """Add a pin of body_b in a straight slot of body_a, where it may turn. One row [m]. Its
        coordinate is the displacement of body_b's point along the axis [m]."""
        return self._add("planar_pin_in_slot", locals())

    def rack_and_pinion(
        self,
        name,
        body_a,
        body_b,
        radius,
        *,
        axis=None,
        point=None,
        point_a=None,
        point_b=None,
        offset=None,
    ):
        """Add a pinion of body_b, about its point, that rolls on a rack of body_a along an axis:
        displacement - radius (angle_b - angle_a) = offset. One row [m]. radius [m] > 0: the rack is
        on the left of the axis; < 0: on the right, which is below for the axis (1, 0). offset [m],
        default that of the design configuration."""
        return self._add("planar_rack_and_pinion", locals())

    def gear(self, name, body_a, body_b, radius_a, radius_b, *, carrier=None, offset=None):
        """Add a gear of two wheels on a carrier (default: ground): radius_a (angle_a - angle_c) +
        radius_b (angle_b - angle_c) = offset. One row [m]. A negative radius [m] is a ring with
        internal teeth. offset [m], default that of the design configuration."""
        return self._add("planar_gear", locals())

    def curve(
        self,
        name,
        body_a,
        body_b,
        curve,
        *,
        point=None,
        point_a=None,
        point_b=None,
        user=None,
    ):
        """Keep a point of body_b on a curve F(x, y) = 0 that is fixed in body_a, x and y from its
        point: curve(xy) returns F [m], F_x, F_y, F_xx, F_xy, F_yy. One row. F with a gradient of
        about 1 near the curve behaves best."""
        return self._add("planar_curve", locals())

    def coupling(self, name, joint_a, joint_b, *, ratio=None, offset=None, law=None, user=None):
        """Tie the coordinates of two joints: b = ratio a + offset (default offset: that of the
        design configuration), or b = f(a), a cam: law(a) returns f, its slope and its curvature.
        One row."""
        return self._add("coupling", locals())

    def driver(self, name, joint, *, value=None, rate=None, acceleration=None, law=None, user=None):
        """Prescribe the coordinate of a revolute [rad] or translational [m] joint or of a pin in a
        slot [m]: value + rate t + acceleration t^2 / 2, or law(t) that returns value, rate and
        acceleration. One row."""
        return self._add("driver", locals())

    def spline_driver(self, name, joint, times, values, *, periodic=None):
        """Prescribe a coordinate as driver() does, by a cubic spline through `values` [rad] or [m]
        at rising `times` [s], at least 3. It goes on straight before the first and after the last
        time; periodic: it repeats itself, and first and last value are the same. One row."""
        return self._add("spline_driver", locals())

    def constraint(self, name, bodies, rows, phi, *, jacobian=None, nu=None, gamma=None, user=None):
        """Add constraints Phi(t, q) = 0 over the coordinates of `bodies`, one or several:
        phi(t, q) gives Phi (rows), jacobian(t, q) J (rows x nv), nu(t, q) -dPhi/dt (rows),
        gamma(t, q, v) the right side of J a = gamma (rows). Only phi is needed; the others are
        found by differences, which calls phi often: about 140 times in a step of "rk4" for two
        coordinates, against 50 calls in all with jacobian and gamma. A call takes one to two
        microseconds even for a short Python function. Where that matters give the derivatives, or
        compiled functions: addresses, ctypes function pointers, Numba's cfunc."""
        fields = locals()
        fields["row_count"] = fields.pop("rows")
        return self._add("user_constraint", fields)

    # ---- forces ----------------------------------------------------------------------------------

    def spring(
        self,
        name,
        body_a,
        body_b,
        *,
        point_a=None,
        point_b=None,
        stiffness=None,
        damping=None,
        free_length=None,
        law=None,
        depends_on_velocity=None,
        user=None,
    ):
        """Add a spring [N/m] and damper [N s/m] between two points; free_length [m], default that
        of the design configuration. Or law(length, rate), which returns the tension [N] and its
        derivatives by length and by rate, and has no potential energy; depends_on_velocity: False where it does not
        read the rate (rattle needs that)."""
        return self._add("planar_spring", locals())

    def torsion_spring(
        self,
        name,
        body_a,
        body_b,
        *,
        stiffness=None,
        damping=None,
        free_angle=None,
        law=None,
        depends_on_velocity=None,
        user=None,
    ):
        """Add a spring [N m/rad] and damper [N m s/rad] on angle_b - angle_a, which goes on over
        turns; free_angle [rad], default that of the design configuration. Or law(angle, rate),
        which returns the torque that turns the angle back [N m] and its derivatives by angle and by rate, and has no
        potential energy; depends_on_velocity as of springs."""
        return self._add("planar_torsion_spring", locals())

    def load(
        self, name, body, *, force=None, point=None, torque=None, follows_body=None, input=None
    ):
        """Add a force [N] at a point of a body (body axes [m]) and a torque [N m]. follows_body:
        the force turns with the body, else it keeps to ground axes. input: its value multiplies
        both."""
        return self._add("planar_load", locals())

    def force(
        self,
        name,
        bodies,
        force,
        *,
        force_q=None,
        force_v=None,
        potential=None,
        inputs=None,
        depends_on_velocity=None,
        user=None,
    ):
        """Add a generalized force on `bodies`: force(t, q, v) gives it (nv), force_q and force_v
        its derivatives (nv x nv), potential(t, q) an energy [J]. inputs: those that force, force_q
        and force_v are given after v: with inputs=["torque"] they are called as force(t, q, v,
        torque). depends_on_velocity: False where force() does not read v (rattle needs that)."""
        return self._add("user_force", locals())

    # ---- inputs ----------------------------------------------------------------------------------

    def input(self, name=None, initial=0.0):
        """Add an input: a number that acts from outside, such as the torque of a motor. Loads and
        force functions name it. Every run and workspace begins with the initial value and holds it
        until set_input() there."""
        name = self._new_name(name, "input")
        initial = number(initial, f'input "{name}": initial')
        id = _abi.baum_input_id()
        self._owner.call(lib.baum_mechanism_add_input, name.encode(), initial, ctypes.byref(id))
        self._entries[name] = Entry("input", None, id, 0, 0)
        return self[name]

    # ---- how -------------------------------------------------------------------------------------

    def _add(self, kind, given):
        """Add an element; given: the arguments of a method above, by name."""
        kind = KINDS[kind]
        fields = {field: value for field, value in given.items() if field != "self"}
        name = fields["name"] = self._new_name(fields["name"], kind.family)
        definition = Definition(kind, f'{kind.family} "{name}"', self.find)
        definition.fill(fields)
        id = kind.id_type()
        self._hold(definition)
        self._owner.call(kind.function("add"), ctypes.byref(definition.struct), ctypes.byref(id))
        self._entries[name] = Entry(kind.family, kind, id, *sizes(kind, definition.struct))
        return self[name]

    def _new_name(self, name, family):
        if name is None:
            name = f"{family}{1 + self._count(family)}"
        if not isinstance(name, str):
            raise TypeError(f"the name of {one(family)} is a string, not {name!r}")
        if not name or any(ord(c) < 32 or ord(c) == 127 for c in name):
            raise ValueError(f"the name of {one(family)} is {name!r}, must have letters, but no control characters")
        if name in self._entries:
            raise ValueError(f'there is already {one(self._entries[name].family)} "{name}"')
        return name

    def _hold(self, definition):
        """Keep a definition's functions as long as this mechanism and its copies."""
        self._keep.extend(definition.keep)
        self.has_python |= definition.has_python

