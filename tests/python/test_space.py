# SPDX-License-Identifier: BSD-3-Clause
"""Tests bodies, joints and forces in space."""

import copy
import math
import pickle
import unittest

import numpy as np

import baum
from baum import inertia
from baum._rotation import matrix, quaternion

HALF = math.sqrt(0.5)
TILTED = np.array([0.5, 0.1, -0.7, 0.5])  # a quaternion
TILTED /= np.linalg.norm(TILTED)


class Rotation:
    """A rotation with the interface of SciPy, whose quaternions have w last."""

    def __init__(self, p):
        self.p = p

    def as_quat(self):
        return np.roll(self.p, -1)


def saddle(xyz):
    """The curve in which z = x y and x + 0.5 z = 0 intersect."""
    x, y, z = xyz
    return [z - x * y, -y, -x, 1, 0, -1, 0, 0, 0, 0, x + 0.5 * z, 1, 0, 0.5, 0, 0, 0, 0, 0, 0]


def add_every_joint(m, a, b, p):
    """Add one joint of each kind between two bodies and a particle. Some have a common point in
    ground axes, others have points and axes in the axes of both bodies."""
    point = (0.3, 0.1, -0.2)
    m.spherical("spherical", a, b, point=point)
    m.spatial_revolute("revolute", a, b, point=point, axis=(1, 2, 0))
    m.universal("universal", a, b, point=point, axis=(1, 0, 0), axis_b=(0, 0, 2))
    m.cylindrical("cylindrical", a, b, point_a=point, point_b=(0, 1, 0), axis=(1, 1, 1))
    m.prismatic("prismatic", a, b, point_a=point, point_b=(0, 1, 0), axis=(0, 1, 1))
    m.spatial_planar("planar", a, b, point=point, axis=(1, 0, 1), axis_b=(1, 0.1, 1))
    m.spatial_fixed("fixed", a, b, point=point)
    m.spatial_distance("distance", a, b, point_a=(0, 0, 0), point_b=(0.1, 0, 0))
    m.screw("screw", a, b, 0.3, point=point, axis=(1, 1, 0))
    m.constant_velocity("cage", a, b, point=point, axis=(1, 0, 0), axis_b=(1, 1, 0))
    m.point_on_line("line", a, p, point_a=point, point_b=(0, 0, 0), axis=(1, 0, 2))
    m.point_on_plane("plane", a, p, point=(1, 2, 3), axis=(0, 1, 0))
    m.spatial_curve("curve", a, p, saddle, point=(1, 2, 3))
    m.spatial_knife_edge("edge", a, point=point, axis=(1, 0, 2), body_b=b)
    m.cable("cable", [a, m.ground, b], [point, (1, 1, 1), (0, 0, 0.2)], stiffness=2, damping=0.1)
    m.spatial_spring(
        "spring", a, b, point_a=(0, 0, 0), point_b=(0.1, 0, 0), stiffness=3, damping=0.1
    )
    m.spatial_load("load", a, force=(1, 2, 3), moment=(0, 1, 0), point=(0.1, 0, 0))
    m.spatial_torsion_spring(
        "twist", a, b, point=point, axis=(1, 0, 1), stiffness=2, damping=0.1, free_angle=0.2
    )
    m.bushing(
        "bushing",
        a,
        b,
        point_a=point,
        point_b=(0, 0.5, 0),
        axis=(1, 0, 1),
        axis_b=(1, 0.2, 1),
        x_axis=(0, 1, 0),
        stiffness=(1, 2, 3, 0.1, 0.2, 0.3),
        damping=0.1 * np.eye(6),
    )


def everything():
    m = baum.Mechanism(up="z")
    a = m.spatial_body("a", position=(1, 0.5, 0.2), orientation=TILTED)
    b = m.spatial_body("b", position=(0.2, 0.7, -1), orientation=(HALF, 0, HALF, 0))
    p = m.spatial_particle("p", position=(1, 2, 3))
    add_every_joint(m, a, b, p)
    return m


class Given(unittest.TestCase):
    """Tests which values the library receives for the values that users give."""

    def body(self, **fields):
        return baum.Mechanism().spatial_body("body", **fields).definition

    def test_inertia_is_taken_in_three_forms(self):
        for given in (2, 3, 4, 0.1, 0, 0.2), [[2, 0.1, 0], [0.1, 3, 0.2], [0, 0.2, 4]]:
            self.assertEqual(self.body(inertia=given)["inertia"], (2, 3, 4, 0.1, 0, 0.2))
        self.assertEqual(self.body(inertia=(2, 3, 4))["inertia"], (2, 3, 4, 0, 0, 0))

    def test_orientation_is_taken_in_three_forms(self):
        for given in TILTED, matrix(TILTED), Rotation(TILTED):
            np.testing.assert_allclose(self.body(orientation=given)["orientation"], TILTED)
        self.assertEqual(self.body()["orientation"], (1, 0, 0, 0))

    def test_a_matrix_of_half_a_revolution_has_a_quaternion(self):
        for axis in np.eye(3):
            for angle in (np.pi, 3.0, -2.5, 1e-9):
                p = np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)])
                found = quaternion(matrix(p), "")
                np.testing.assert_allclose(matrix(found), matrix(p), atol=1e-15)

    def test_definitions_can_be_given_again(self):
        m = baum.Mechanism()
        body = m.spatial_body("body", inertia=(2, 3, 4), orientation=TILTED)
        values = {key: value for key, value in body.definition.items() if key != "name"}
        np.testing.assert_equal(body.set(**values).definition, dict(values, name="body"))

    def test_wrong_values_are_named(self):
        mirror = np.diag([1.0, 1.0, -1.0])
        for words, fields in (
            ('body "body": inertia: 6 numbers', dict(inertia=(1, 2))),
            ("inertia: the matrix is not symmetric", dict(inertia=np.eye(3) + np.eye(3, k=1))),
            ("inertia: 9 numbers are wanted, not 4", dict(inertia=np.eye(2))),
            ("inertia: .* are wanted, not 1 numbers", dict(inertia=2.0)),
            ("not a rotation: its columns are left-handed", dict(orientation=mirror)),
            ("not a rotation: .* deviate by 3 from", dict(orientation=2 * np.eye(3))),
            ("orientation: a quaternion w, .* not 3 numbers", dict(orientation=(1, 0, 0))),
            ("orientation: an array of one dimension", dict(orientation=Rotation(np.eye(4)))),
            ("position: 3 numbers are wanted, not 2", dict(position=(0, 0))),
        ):
            with self.subTest(words), self.assertRaisesRegex(ValueError, words):
                self.body(**fields)
        for fields in dict(inertia="heavy"), dict(orientation="up"), dict(inertia=[["x"] * 3] * 3):
            with self.subTest(fields), self.assertRaisesRegex(TypeError, "numbers are wanted"):
                self.body(**fields)
        with self.assertRaisesRegex(baum.Error, '"body": orientation has the length 2'):
            self.body(orientation=(2, 0, 0, 0))
        with self.assertRaisesRegex(baum.Error, "principal moments"):
            self.body(inertia=(1, 1, -1))
        self.assertEqual(self.body(inertia=inertia.rod(12, 1))["inertia"], (1, 1, 0, 0, 0, 0))

    def test_up_is_where_gravity_comes_from(self):
        self.assertEqual(baum.Mechanism(up="z").gravity, (0, 0, -9.81))
        self.assertEqual(baum.Mechanism(up="x").gravity, (-9.81, 0, 0))
        self.assertEqual(baum.Mechanism(up="y").gravity, baum.Mechanism().gravity)
        with self.assertRaisesRegex(ValueError, "gravity and up are both given"):
            baum.Mechanism(gravity=(0, -9.81), up="z")
        with self.assertRaisesRegex(ValueError, 'up: "x", "y" or "z" is wanted'):
            baum.Mechanism(up="w")


    def test_gains_do_not_depend_on_the_direction_of_gravity(self):
        def gains(up, along):
            m = baum.Mechanism(up=up)
            m.spatial_body("bob", inertia=(0.1, 0.1, 0.1), position=along)
            m.spherical("S", "ground", "bob", point=(0, 0, 0))
            m.freeze()
            s = m.simulation("rk4", formulation="baumgarte", step=1e-3)
            return s.counters.alpha, s.counters.beta

        np.testing.assert_allclose(gains("z", (1, 0, 0)), gains("y", (0, 0, 1)), rtol=1e-9)


class Solids(unittest.TestCase):
    def test_of_known_shapes(self):
        np.testing.assert_allclose(inertia.box(12, 1, 2, 3), np.diag([13, 10, 5]))
        np.testing.assert_allclose(inertia.sphere(5, 2), 8 * np.eye(3))
        np.testing.assert_allclose(inertia.cylinder(12, 1, 2, axis="x"), np.diag([6, 7, 7]))
        np.testing.assert_allclose(inertia.rod(12, 2, axis="y"), np.diag([4, 0, 4]))
        with self.assertRaisesRegex(ValueError, "axis: "):
            inertia.rod(1, 1, axis="w")
        for solid, values in (
            (inertia.box, (1, -1, 1, 1)),
            (inertia.sphere, (-1, 1)),
            (inertia.cylinder, (1, 1, 0)),
            (inertia.rod, (np.nan, 1)),
        ):
            with self.subTest(solid), self.assertRaisesRegex(ValueError, "finite number > 0"):
                solid(*values)

    def test_two_halves_make_a_whole(self):
        half = inertia.box(3, 1, 2, 3)
        sides = [inertia.shift(half, 3, (x, 0, 0)) for x in (0.5, -0.5)]
        np.testing.assert_allclose(sum(sides), inertia.box(6, 2, 2, 3))
        away = inertia.shift((1, 2, 3), 2, (1, 2, 0))
        np.testing.assert_allclose(away, [[9, -4, 0], [-4, 4, 0], [0, 0, 13]])

    def test_a_turned_cylinder(self):
        turned = inertia.rotate(inertia.cylinder(1, 0.3, 2, axis="z"), (HALF, 0, HALF, 0))
        np.testing.assert_allclose(turned, inertia.cylinder(1, 0.3, 2, axis="x"), atol=1e-15)
        r = matrix(TILTED)
        np.testing.assert_allclose(
            inertia.rotate((1, 2, 3), TILTED), r @ np.diag([1, 2, 3]) @ r.T, atol=1e-15
        )


class FreeBody(unittest.TestCase):
    """A body without forces rotates about the axis of its intermediate principal moment of inertia.
    This rotation is unstable."""

    @classmethod
    def setUpClass(cls):
        m = baum.Mechanism(gravity=(0, 0, 0))
        cls.inertia = inertia.rotate(np.diag([1.0, 2.0, 2.5]), (0.8, 0.6, 0, 0))
        m.spatial_body(
            "brick",
            mass=2,
            inertia=cls.inertia,
            orientation=Rotation(TILTED),
            velocity=(1, 2, 3),
            angular_velocity=(0.01, 2 * 0.8, 2 * 0.6),  # almost along the second principal axis
        )
        record = ["energy", "brick.velocity", "brick.acceleration", m["brick"].pose_of((1, 2, 3))]
        times = np.linspace(0, 10, 401)
        cls.recorded = m.freeze().simulate(times, "rk8", rtol=1e-11, record=record)
        cls.run_ = m.simulate(times, "rk8", rtol=1e-11)

    def momentum(self, run):
        """Return the angular momentum in ground axes."""
        axes = matrix(run.q[:, 3:])
        return np.einsum("nij,jk,nk->ni", axes, self.inertia, run.v[:, 3:])

    def test_energy_and_momentum_stay(self):
        run = self.recorded
        energy, momentum = run["energy"].sum(axis=1), self.momentum(run)
        np.testing.assert_allclose(energy, energy[0], rtol=1e-9)
        np.testing.assert_allclose(momentum, momentum[:1].repeat(len(run.t), 0), atol=1e-8)
        self.assertGreater(np.ptp(run.v[:, 3]), 2)  # the body has tumbled

    def test_velocities_are_in_ground_axes_recorded_or_not(self):
        recorded, run = self.recorded, self.run_
        np.testing.assert_allclose(run["brick.velocity"], recorded["brick.velocity"], atol=1e-14)
        self.assertGreater(abs(run["brick.velocity"] - run.v).max(), 1)
        for back in pickle.loads(pickle.dumps(run)), copy.deepcopy(run):
            np.testing.assert_array_equal(back["brick.velocity"], run["brick.velocity"])
            np.testing.assert_array_equal(back["brick.pose"], run.q)

    def test_velocities_turn_the_orientation(self):
        axes, w = matrix(self.run_.q[:, 3:]), self.run_["brick.velocity"][:, 3:]
        h = self.run_.t[1] - self.run_.t[0]
        slope = (axes[2:] - axes[:-2]) / (2 * h)
        turned = np.cross(w[1:-1, :, None], axes[1:-1], axisa=1, axisb=1, axisc=1)
        np.testing.assert_allclose(slope, turned, atol=2e-2)

    def test_points_move_with_the_body(self):
        run, key = self.recorded, "brick.pose(1.0, 2.0, 3.0)"
        at = run.q[:, :3] + matrix(run.q[:, 3:]) @ (1, 2, 3)
        np.testing.assert_allclose(run[key][:, :3], at, atol=1e-13)
        np.testing.assert_allclose(run[key][:, 3:], run.q[:, 3:], atol=1e-15)
        with self.assertRaisesRegex(ValueError, "point of 'brick': 3 numbers are wanted"):
            run.mechanism["brick"].pose_of((1, 2))


class Joints(unittest.TestCase):
    ROWS = {
        "spherical": 3,
        "revolute": 5,
        "universal": 4,
        "cylindrical": 4,
        "prismatic": 5,
        "planar": 3,
        "fixed": 6,
        "distance": 1,
        "line": 2,
        "plane": 1,
    }

    def test_each_assembles_and_moves(self):
        for name, rows in self.ROWS.items():
            with self.subTest(name):
                full = everything()
                m = baum.Mechanism(up="z")
                a = m.spatial_body("a", inertia=(1, 1.2, 0.9), angular_velocity=(1, 2, 3))
                b = m.spatial_body("b", position=(0.2, 0.7, -1), orientation=TILTED)
                p = m.spatial_particle("p", position=(1.1, 2, 3))
                ends = {"a": a, "b": b, "p": p}
                said = full[name].definition
                fields = {
                    key: value
                    for key, value in said.items()
                    if isinstance(value, tuple) and not math.isnan(value[0])
                }
                add = "spatial_" + name if hasattr(m, "spatial_" + name) else name
                add = {"line": "point_on_line", "plane": "point_on_plane"}.get(name, add)
                if name == "plane":  # the joint's point is the place of the particle
                    fields["point"] = (1.1, 2, 3)
                getattr(m, add)("J", a, ends[said["body_b"].name], **fields)
                self.assertEqual(m.freeze().mobility().degrees_of_freedom, 15 - rows)
                run = m.simulate([0, 0.2, 0.5], "rk8", rtol=1e-9, record=["J.phi", "J.reaction"])
                self.assertEqual(run["J.phi"].shape, (3, rows))
                self.assertLess(abs(run["J.phi"]).max(), 1e-12)
                self.assertEqual(run["J.reaction"].shape, (3, 6))
                self.assertEqual(run.counters.doubts, 0)

    def test_they_have_units(self):
        m = baum.Mechanism(up="z")
        body = m.spatial_body("body")
        hinge = m.spatial_revolute("hinge", "ground", body, point=(0, 0, 1), axis=(1, 0, 0))
        slider = m.spatial_particle("slider")
        rail = m.point_on_line("rail", "ground", slider, point=(0, 0, 0))
        m.driver("motor", hinge, rate=1)
        m.driver("push", rail, rate=1)
        force = ["N"] * 3 + ["N m"] * 3
        for channel, units in (
            ("body.pose", ["m"] * 3 + ["-"] * 4),
            ("body.velocity", ["m/s"] * 3 + ["rad/s"] * 3),
            ("body.acceleration", ["m/s^2"] * 3 + ["rad/s^2"] * 3),
            ("slider.pose", ["m"] * 3),
            ("hinge.coordinate", ["rad", "rad/s"]),
            ("rail.coordinate", ["m", "m/s"]),
            ("hinge.phi", ["m"] * 3 + ["-"] * 2),
            ("hinge.phi_rate", ["m/s"] * 3 + ["1/s"] * 2),
            ("hinge.multipliers", ["N"] * 3 + ["N m"] * 2),
            ("hinge.reaction", force),
            ("motor.reaction", force),
            ("motor.effort", ["N m"]),
            ("push.effort", ["N"]),
            ("q", ["m"] * 3 + ["-"] * 4 + ["m"] * 3),
            ("a", ["m/s^2"] * 3 + ["rad/s^2"] * 3 + ["m/s^2"] * 3),
        ):
            with self.subTest(channel):
                run = m.freeze().simulate([0], "rk4", step=1e-3, record=[channel])
                names = run._names(channel)
                self.assertEqual([run.columns[name] for name in names], units)
                self.assertEqual(pickle.loads(pickle.dumps(run)).columns, run.columns)
                self.assertEqual(list(run.to_dict()), list(run.columns))

    def test_a_hinge_carries_its_body(self):
        m = baum.Mechanism(up="z")
        m.spatial_body("arm", mass=2, position=(0.5, 0, 0), velocity=(0, 0, 0))
        m.spatial_fixed("weld", m.ground, "arm", point=(0, 0, 0))
        run = m.freeze().simulate([0], "rk4", step=1e-3, record=["weld.reaction"])
        np.testing.assert_allclose(run["weld.reaction"], [[0, 0, 19.62, 0, -9.81, 0]], atol=1e-14)

    def test_which_rows_have_a_length(self):
        """If bodies are moved, rows in metres change, but rows that are pure numbers must not."""
        m = everything().freeze()
        w = baum.Workspace(m)
        q = w.move(0.1 * np.sin(np.arange(15)), w.design()[0])
        moved = w.move([1, 2, 3, 0, 0, 0, 2, -1, 5, 0, 0, 0, 0, 1, 1], q)
        units = [unit for one in m if one.family == "joint" for unit in one.kind.units]
        units[m.rows("edge").start] = "-"  # a row of velocity level, whose Phi is 0
        for before, after, unit in zip(w.phi(0, q), w.phi(0, moved), units):
            if unit == "-":
                self.assertAlmostEqual(before, after, 13)
            else:
                self.assertGreater(abs(before - after), 1e-3)

    def test_angles_count_revolutions_in_long_steps(self):
        """Tests steps of half a revolution and more. Times inside the steps are tested as well."""
        m = baum.Mechanism(gravity=(0, 0, 0))
        m.spatial_body("wheel", angular_velocity=(0, 0, 1))
        m.spatial_revolute("hinge", m.ground, "wheel", point=(0, 0, 0))
        m.freeze()
        times = np.linspace(0, 15, 61)
        for method, options, bound in (
            # the allowed error is that of the method, which makes only 5 steps
            ("rk8", dict(rtol=1e-2), 0.05),
            ("rk8", dict(rtol=1e-9), 1e-8),
            ("euler", dict(step=4.0), 1e-12),
        ):
            with self.subTest(method, **options):
                run = m.simulate(times, method, record=["hinge.coordinate"], **options)
                self.assertLess(abs(run["hinge.coordinate"][:, 0] - times).max(), bound)
                s = m.simulation(method, **options)
                for value in (0.0, 0.5, -2.0, math.pi, 7.0, 10.0):
                    s.event("hinge", value, terminal=False)
                s.advance_to(15)
                self.assertEqual([event for _, event, _ in s.events], [1, 3, 4, 5])
                found = [t for t, _, _ in s.events]
                np.testing.assert_allclose(found, (0.5, math.pi, 7, 10), atol=bound)

    def test_a_study_of_an_angle_has_no_jumps(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        m.spatial_body("wheel", angular_velocity=(0, 0, 1))
        m.spatial_revolute("hinge", m.ground, "wheel", point=(0, 0, 0))
        study = baum.study(
            m.freeze(), 0, 2 * math.pi, samples=3, error=["hinge.coordinate"], progress=False
        )
        for step in (0.1, 0.03, 0.01):  # a sample is at pi
            study.add("rk4", step=step)
            study.add("euler", step=step)
        errors = [entry.error for entry in study.run().entries]
        self.assertEqual(len(errors), 6)
        self.assertLess(max(errors), 1e-5)  # the error of rk4 with a step of 0.1 s


class Forces(unittest.TestCase):
    def test_a_spring_and_a_load_hold_a_particle(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        bob = m.spatial_particle("bob", mass=1, position=(1, 2, 3), velocity=(0, 0, 0))
        apart = np.array((1, 2, 3)) / math.sqrt(14)
        m.spatial_spring(
            "spring", m.ground, bob, point_a=(0, 0, 0), point_b=(0, 0, 0), stiffness=5,
            free_length=math.sqrt(14) - 0.2,
        )  # fmt: skip
        m.spatial_load("load", bob, force=apart, input=m.input("push", 1.0))
        s = m.freeze().simulation("rk8", rtol=1e-9)
        s.advance_to(1)
        np.testing.assert_allclose(s.q, (1, 2, 3), rtol=1e-14)
        s.set_input("push", 0)
        s.advance_to(2)
        self.assertLess(np.linalg.norm(s.q), math.sqrt(14) - 0.1)

    def test_a_law_replaces_the_stiffness(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        m.spatial_particle("bob", position=(0, 0, 2))
        law = lambda length, rate: (length**2, 2 * length, 0)  # noqa: E731
        m.spatial_spring("s", "ground", "bob", point_a=(0, 0, 0), point_b=(0, 0, 0), law=law)
        g = baum.Workspace(m.freeze()).force(0, (0, 0, 2), (0, 0, 0))
        np.testing.assert_allclose(g, (0, 0, -4))

    def test_the_drag_of_a_plate(self):
        """The function gives only the force. Implicit methods use derivatives by differences."""

        def drag(t, q, v):
            normal = matrix(q[3:7])[:, 2]
            speed = normal @ v[:3]
            return [*(-0.8 * abs(speed) * speed * normal), *(-0.3 * v[3:])]

        def plate(orientation):
            m = baum.Mechanism(gravity=(0, 0, 0))
            body = m.spatial_body(
                "plate", mass=2, inertia=(1, 1, 2), orientation=orientation, velocity=(0.5, -1, 6),
                angular_velocity=(0, 0, 3),
            )  # fmt: skip
            m.force("air", body, drag)
            return m.freeze()

        methods = [("rk8", 1e-8), ("generalized_alpha", 1e-5)]
        if baum.has("sundials"):
            methods += [("cvode_bdf", 1e-5), ("ida", 1e-5)]
        for method, accuracy in methods:
            options = {"rtol": 1e-9, "check_derivatives": True}
            if method == "generalized_alpha":
                options = {"step": 1e-3, "check_derivatives": True}
            s = plate((1, 0, 0, 0)).simulation(method, **options)
            s.advance_to(1)
            # The speed v along the normal and the spin w obey 2 v' = -0.8 v^2 and 2 w' = -0.3 w.
            want = (0.5, -1, 6 / (1 + 0.4 * 6), 0, 0, 3 * math.exp(-0.15))
            np.testing.assert_allclose(s.v, want, rtol=accuracy, atol=accuracy)
            s = plate(TILTED).simulation(method, **options)
            s.advance_to(1)
            if method == "rk8":
                tilted = s.v
            np.testing.assert_allclose(s.v, tilted, rtol=accuracy, atol=accuracy)

    def test_a_moment_turns_a_body(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        body = m.spatial_body("body", inertia=(1, 2, 2.5), orientation=(HALF, HALF, 0, 0))
        m.spatial_load("torque", body, moment=(0, 0, 4))  # along the y axis of the body
        m.spatial_load("jet", body, moment=(0, 0, 5), follows_body=True)
        g = baum.Workspace(m.freeze()).force(0, baum.Workspace(m).design()[0], np.zeros(6))
        np.testing.assert_allclose(g, (0, 0, 0, 0, 4, 5), atol=1e-15)


class Coordinates(unittest.TestCase):
    """Tests drivers, couplings, springs, channels and events that select a coordinate by its name."""

    def nut(self):
        m = baum.Mechanism(up="z")
        nut = m.spatial_body("nut", mass=2, inertia=(1, 1, 1))
        return m, m.cylindrical("sleeve", m.ground, nut, point=(0, 0, 0))

    def test_a_screw(self):
        m, sleeve = self.nut()
        m.coupling("thread", sleeve, sleeve, coordinate_a="angle", ratio=0.5)
        keys = ["sleeve.angle", "sleeve.displacement", "sleeve.coordinate"]
        run = m.freeze().simulate([0, 1, 3], "rk8", rtol=1e-10, record=keys)
        fall = -0.5 * 2 * 9.81 / (2 + 1 / 0.5**2) * run.t**2
        np.testing.assert_allclose(run["sleeve.displacement"][:, 0], fall, atol=1e-8)
        np.testing.assert_allclose(run["sleeve.angle"][:, 0], 2 * fall, atol=1e-8)
        self.assertGreater(abs(2 * fall[-1]), 4 * np.pi)
        np.testing.assert_array_equal(run["sleeve.coordinate"], run["sleeve.displacement"])
        columns = run.columns
        self.assertEqual(columns["sleeve.angle[0]"], "rad")
        self.assertEqual(columns["sleeve.angle[1]"], "rad/s")
        self.assertEqual(columns["sleeve.displacement[0]"], "m")

    def test_a_motor_a_spring_and_an_event(self):
        m, sleeve = self.nut()
        m.driver("motor", sleeve, coordinate="angle", rate=2.0)
        m.joint_spring("coil", sleeve, coordinate="displacement", stiffness=100)
        self.assertEqual(m["motor"].definition["coordinate"], "angle")
        self.assertEqual(m["coil"].definition["coordinate"], "displacement")
        run = m.freeze().simulation("rk8", rtol=1e-9)
        run.event(sleeve, 3.0, coordinate="angle")
        run.advance_to(5)
        self.assertAlmostEqual(run.time, 1.5)
        height = -2 * 9.81 / 100 * (1 - np.cos(50**0.5 * 1.5))
        self.assertAlmostEqual(run.get("sleeve.displacement")[0], height, places=6)

    def test_loads(self):
        m, sleeve = self.nut()
        m.joint_load("thrust", sleeve, effort=2 * 9.81)
        u = m.input("u", 0.5)
        motor = m.joint_load("motor", "sleeve", coordinate="angle", effort=2, input=u)
        self.assertEqual(motor.definition["coordinate"], "angle")
        self.assertEqual(motor.definition["joint"], sleeve)
        self.assertEqual(motor.definition["effort"], 2)
        run = m.freeze().simulation("rk8", rtol=1e-10, energy_account=True)
        run.advance_to(1)
        run.set_input("u", -1)
        run.advance_to(2)
        self.assertAlmostEqual(run.get("sleeve.displacement")[0], 0)
        self.assertAlmostEqual(run.get("sleeve.angle")[0], 0.5 + 1 - 1)
        self.assertAlmostEqual(run.energy_account.loads, 1 * 0.5 - 2 * 0)
        again = baum.parse(m.scene())
        self.assertEqual(m, again)
        self.assertEqual(again["motor"].definition["input"].name, "u")
        self.assertEqual(m.copy(motor=dict(effort=3))["motor"].definition["effort"], 3)

    def test_a_load_does_not_keep_the_orientation(self):
        m, sleeve = self.nut()
        m.joint_load("motor", sleeve, coordinate="angle", effort=2)
        turned = m.freeze().copy(nut=dict(orientation=(HALF, 0, 0, HALF)))
        self.assertEqual(turned["motor"].definition["effort"], 2)

    def test_names(self):
        m, sleeve = self.nut()
        with self.assertRaisesRegex(ValueError, "no coordinate 'turn'; there are: first, disp"):
            m.driver("motor", sleeve, coordinate="turn")
        with self.assertRaisesRegex(baum.Error, 'is "x", but .* has "displacement", "angle"'):
            m.driver("motor", sleeve, coordinate="x")
        with self.assertRaisesRegex(baum.Error, 'coordinate is "angle_b", but'):
            m.freeze().simulate([0, 1], "rk8", rtol=1e-6, record=sleeve.angle_b)


class PlanarBodies(unittest.TestCase):
    """A planar crank carries a spatial bob, and a spatial spring acts on a planar particle."""

    def setUp(self):
        m = baum.Mechanism()
        crank = m.planar_body("crank", inertia=0.01, position=(0.1, 0), angular_velocity=8)
        bead = m.planar_particle("bead", position=(1, 0))
        m.revolute("pin", m.ground, crank, point=(0, 0))
        bob = m.spatial_body("bob", mass=0.5, inertia=(0.02, 0.02, 0.02), position=(0.2, -0.3, 0.1))
        m.spherical("ball", crank, bob, point=(0.2, 0, 0))
        m.spatial_spring("spring", bead, bob, point_a=(0, 0, 0), point_b=(0, 0, 0), stiffness=9)
        self.m = m

    def run_to(self, m, record, rtol=1e-10):
        return m.freeze().simulate(np.linspace(0, 1, 5), "rk8", rtol=rtol, record=record)

    def test_scenes_and_saved_runs_continue_identically(self):
        again = baum.parse(self.m.scene())
        want = self.run_to(self.m, ["ball.reaction", "energy"])
        got = self.run_to(again, ["ball.reaction", "energy"])
        np.testing.assert_array_equal(got["q"], want["q"])
        np.testing.assert_array_equal(got["ball.reaction"], want["ball.reaction"])
        np.testing.assert_allclose(want["energy"].sum(1), want["energy"][0].sum(), rtol=1e-8)
        runs = [again.simulation("rk8", rtol=1e-10) for _ in range(2)]
        runs[0].advance_to(0.5)
        runs[1].restore(runs[0].save())
        for run in runs:
            run.advance_to(1)
        np.testing.assert_array_equal(runs[0].q, runs[1].q)

    def test_the_plane_supports_planar_bodies(self):
        run = self.run_to(self.m, ["ball.reaction", "pin.reaction", "ball.phi"])
        self.assertEqual(run["pin.reaction"].shape[1], 3)
        self.assertGreater(abs(run["ball.reaction"][:, 2]).min(), 1e-3)
        self.assertLess(abs(run["ball.phi"]).max(), 1e-9)

    def test_user_functions_see_both_kinds(self):
        self.m.constraint("tie", ["bead", "bob"], 1, lambda t, q: [q[0] - q[2] - 0.8])
        self.m.force("wind", ["crank", "bob"], lambda t, q, v: [0, 1, 0, 0, 0, 2, 0, 0, 0])
        # The derivatives of "tie" are differences, whose errors are too large for a smaller rtol.
        run = self.run_to(self.m, ["bead.pose", "bob.pose"], rtol=1e-8)
        apart = run["bead.pose"][:, 0] - run["bob.pose"][:, 0]
        np.testing.assert_allclose(apart, 0.8, atol=1e-9)

    def test_pages_show_the_plane_in_space(self):
        drawing = str(self.m.draw())
        self.assertIn("crank", drawing)
        self.assertIn("bob", drawing)
        run = self.run_to(self.m, [])
        page = str(self.m.page([0, 1], run["q"][[0, -1]]))
        self.assertTrue('"spatial":true' in page)
        self.assertTrue('{"name":"crank","kind":"body"' in page)

    def test_rows_across_the_plane_are_redundant_or_violated(self):
        m = baum.Mechanism()
        arm = m.planar_body("arm", inertia=0.1)
        m.spatial_revolute("hinge", m.ground, arm, point=(0, 0, 0.3))
        self.assertEqual(m.freeze().mobility().redundant_rows, 3)
        tilted = m.copy(hinge=dict(axis_b=(0, 0.1, 1)))
        with self.assertRaisesRegex(baum.Error, 'joint 1 "hinge".*contradict each other'):
            tilted.simulation("rk8", rtol=1e-6)

    def test_planar_elements_name_the_remedy(self):
        with self.assertRaisesRegex(baum.Error, "no position in the plane; take the spatial"):
            self.m.revolute("no", "crank", "bob", point=(0, 0))
        with self.assertRaisesRegex(baum.Error, "which has no orientation"):
            self.m.spatial_revolute("no", "bead", "bob", point=(1, 0, 0))


class MovedCopies(unittest.TestCase):
    """A copy with other positions and orientations must be the same mechanism in another
    configuration."""

    def compare(self, m, moved):
        there, here = baum.Workspace(m), baum.Workspace(moved)
        q, v = there.design()
        dx = 0.1 * np.sin(np.arange(len(v)))
        q, v = there.move(dx, q), np.cos(np.arange(len(v)))
        np.testing.assert_allclose(here.phi(0, q), there.phi(0, q), atol=1e-14)
        np.testing.assert_allclose(here.jacobian(0, q), there.jacobian(0, q), atol=1e-14)
        np.testing.assert_allclose(here.force(0, q, v), there.force(0, q, v), atol=1e-13)

    def test_other_positions(self):
        m = everything().freeze()
        self.compare(m, m.copy(a=dict(position=(5, -3, 1)), p=dict(position=(0, 0, 0))))

    def test_springs_and_couplings_of_coordinates(self):
        m = everything()
        for name in "cylindrical", "planar", "universal", "prismatic":
            joint = m[name]
            for coordinate in joint.kind.coordinates:
                m.joint_spring(None, joint, coordinate=coordinate, stiffness=2.0)
        m.coupling("thread", "cylindrical", "planar", coordinate_b="y", ratio=0.7)
        m.freeze()
        self.compare(m, m.copy(a=dict(position=(5, -3, 1)), p=dict(position=(0, 0, 0))))
        with self.assertRaisesRegex(ValueError, "keeps the relative orientation"):
            m.copy(a=dict(orientation=(1, 0, 0, 0)))

    def test_another_orientation_of_both(self):
        m = everything().freeze()
        r = matrix(np.array([0.6, 0, 0, 0.8]))
        a, b = (r @ matrix(np.array(m[name].definition["orientation"])) for name in "ab")
        moved = m.copy(a=dict(orientation=a), b=dict(orientation=b, position=(1, 1, 1)))
        np.testing.assert_allclose(moved["b"].definition["orientation"], quaternion(b, ""))
        # The two axes perpendicular to a joint's axis may differ. Therefore only the spaces spanned
        # by the rows are compared.
        there, here = (baum.Workspace(one) for one in (m, moved))
        q, _ = there.design()
        q = there.move(0.1 * np.sin(np.arange(15)), q)
        for joint in (one for one in m if one.family == "joint"):
            rows = m.rows(joint)
            first, second = (w.jacobian(0, there.design()[0])[rows] for w in (there, here))
            both = np.linalg.matrix_rank(np.concatenate([first, second]), tol=1e-9)
            self.assertEqual(both, len(first), joint.name)

    def test_what_has_no_field_is_refused(self):
        for name in "fixed", "prismatic":
            one = baum.Mechanism(up="z")
            a, b = one.spatial_body("a"), one.spatial_body("b")
            add = one.spatial_fixed if name == "fixed" else one.prismatic
            add("J", a, b, point=(0, 0, 0))
            with self.assertRaisesRegex(ValueError, 'joint "J" keeps the relative orientation'):
                one.copy(b=dict(orientation=TILTED))
            again = one.copy(b=dict(orientation=TILTED), J=dict(point=(1, 0, 0)))
            self.assertEqual(again["J"].definition["point"], (1, 0, 0))
            one.copy(a=dict(orientation=TILTED), b=dict(orientation=TILTED))
        hinge = baum.Mechanism()
        hinge.spatial_body("a")
        hinge.spatial_revolute("J", "ground", "a", point=(0, 0, 0))
        hinge.copy(a=dict(orientation=TILTED))
        hinge.driver("motor", "J")
        with self.assertRaisesRegex(ValueError, 'joint "J" keeps'):
            hinge.copy(a=dict(orientation=TILTED))

    def test_a_cable_keeps_its_free_length(self):
        m = everything().freeze()
        moved = m.copy(b=dict(position=(1, 1, 1)))
        length = moved["cable"].definition["free_length"]
        w, there = baum.Workspace(m), baum.Workspace(m.copy(cable=dict(free_length=length)))
        q = w.design()[0]
        np.testing.assert_allclose(w.force(0, q, np.zeros(15)), there.force(0, q, np.zeros(15)), atol=1e-14)
        self.assertTrue(math.isnan(m.copy(p=dict(position=(1, 2, 3)))["cable"].definition["free_length"]))

    def test_planar_bodies_take_part(self):
        m = baum.Mechanism()
        arm = m.planar_body("arm", position=(0.5, 0), angle=0.3)
        m.spherical("ball", m.ground, arm, point=(0, 0, 0))
        moved = m.freeze().copy(arm=dict(angle=1.0))
        self.compare(m, moved)


if __name__ == "__main__":
    unittest.main()
