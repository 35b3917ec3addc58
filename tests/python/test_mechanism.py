# SPDX-License-Identifier: BSD-3-Clause
"""Tests mechanisms: the conversion of arguments, names, copies, ownership, and messages."""

import ctypes
import gc
import inspect
import math
import unittest
import weakref

import numpy as np

import baum
from baum import _abi, callbacks
from baum.adding import Adding
from baum.adding_space import AddingInSpace
from baum.definitions import FIELDS, HIDDEN, KINDS
from mechanisms import pendulum, rod_pendulum, slider_crank


class Building(unittest.TestCase):
    def test_definitions_come_back_as_they_were_given(self):
        m = baum.Mechanism()
        body = m.planar_body(
            "body",
            mass=2,
            inertia=np.float64(3),
            position=np.array([1, 2]),
            angle=0.5,
            velocity=(math.nan, 4),
            held=True,
        )
        said = body.definition
        self.assertEqual(
            (
                said["name"],
                said["mass"],
                said["inertia"],
                said["position"],
                said["angle"],
                said["held"],
            ),
            ("body", 2.0, 3.0, (1.0, 2.0), 0.5, True),
        )
        self.assertTrue(math.isnan(said["velocity"][0]))
        self.assertEqual(said["velocity"][1], 4.0)
        self.assertTrue(math.isnan(said["angular_velocity"]))
        pin = m.revolute("pin", m.ground, "body", point=(0, 0))
        self.assertEqual((pin.definition["body_a"], pin.definition["body_b"]), (m.ground, body))
        load = m.load("load", body, force=(1, 0), torque=2, follows_body=True)
        self.assertEqual(
            (load.definition["body"], load.definition["torque"], load.definition["follows_body"]),
            (body, 2.0, True),
        )

    def test_every_kind_can_be_added_and_changed(self):
        m = baum.Mechanism(gravity=(0, -1, 0), characteristic_length=2)
        a = m.planar_body("a")
        b = m.planar_body("b", position=(1, 0))
        m.planar_particle("c", position=(2, 0))
        m.coordinates(
            "d", 2, mass=lambda t, q: np.eye(2), force=lambda t, q, v: -q, q=(1, 2), scale=(1, 1)
        )
        slider = m.translational("slider", "ground", a, axis=(0, 1), point=(0, 0))
        m.fixed("weld", a, b, point=(0.5, 0))
        m.distance("rod", b, "c", point_a=(0, 0), point_b=(0, 0), length=1)
        m.driver("motor", slider, law=lambda t: (t, 1, 0))
        m.spring("spring", a, "ground", point_a=(0, 0), point_b=(1, 1), stiffness=5).set(
            damping=0.5
        )
        m.torsion_spring("clock", a, b, stiffness=2)
        m.force("push", [a, "d"], lambda t, q, v: np.zeros(5), potential=lambda t, q: 0.0)
        m.input("torque", 0.5)
        self.assertEqual(m["d"].definition["q"].tolist(), [1, 2])
        self.assertEqual(m["spring"].definition["stiffness"], 5.0)
        self.assertEqual(m["spring"].definition["damping"], 0.5)
        self.assertEqual(
            [element.name for element in m],
            "a b c d slider weld rod motor spring clock push torque".split(),
        )
        self.assertEqual(m.freeze().sizes, (10, 10, 7))
        self.assertEqual((m.gravity, m.characteristic_length), ((0.0, -1.0, 0.0), 2.0))

    def test_places_are_slices(self):
        m = slider_crank(omega=150)
        self.assertEqual(m["C"].rows, slice(4, 6))
        self.assertEqual(m["rod"].columns, (slice(3, 6), slice(3, 6)))
        self.assertEqual(m.rows("motor"), slice(8, 9))

    def test_bodies_without_a_name_are_numbered(self):
        m = baum.Mechanism()
        first, second = m.planar_particle(), m.planar_body()
        self.assertEqual((first.name, second.name), ("body1", "body2"))
        self.assertIn("body2", m)
        self.assertNotIn("body3", m)

    def test_mobility_has_named_fields(self):
        mobility = slider_crank().mobility()
        self.assertEqual((mobility.degrees_of_freedom, mobility.redundant_rows), (1, 0))
        self.assertIsInstance(mobility.worst_phi, float)
        self.assertEqual(str(mobility), mobility.text)
        self.assertIn("1 degree of freedom", str(mobility))

    def test_report_tells_what_it_costs(self):
        report = slider_crank().report()
        self.assertEqual((report.rows, report.degrees_of_freedom, report.nodes), (8, 1, 4))
        self.assertIs(report.blocks, True)
        self.assertEqual(report.most_joined.name, "crank")
        self.assertEqual(str(report), report.text)
        self.assertIn("\nsolver        blocks, 4 nodes", str(report))

    def test_no_body_is_most_joined_without_joints(self):
        m = baum.Mechanism()
        m.planar_body()
        m.freeze()
        self.assertIsNone(m.report().most_joined)

    def test_printing_tells_what_it_is(self):
        m = slider_crank()
        self.assertEqual(repr(m), "<mechanism: 3 bodies, 4 joints, 0 forces, 0 inputs, frozen>")
        self.assertEqual(repr(m["B"]), "<planar_revolute 'B'>")
        self.assertEqual(repr(m.ground), "<body 'ground'>")


class Recorder(Adding, AddingInSpace):
    """Records which arguments are passed on by the methods that add elements."""

    def _add(self, made, kind, given):
        return kind, {FIELDS.get(name, name) for name in given.keys() - {"self"}}


class Arguments(unittest.TestCase):
    """Tests that every field of every definition has an argument."""

    # These elements need two different points, so they have no argument for a common point.
    EXCEPTED = {
        "planar_distance": {"point"},
        "planar_spring": {"point"},
        "spatial_distance": {"point"},
        "spatial_spring": {"point"},
    }

    def added(self):
        """Yield the names of the fields that a user can set, for each kind."""
        for name, method in [*vars(Adding).items(), *vars(AddingInSpace).items()]:
            if name.startswith("_") or name == "input":
                continue
            needed = {
                parameter.name: None
                for parameter in inspect.signature(method).parameters.values()
                if parameter.default is parameter.empty and parameter.name != "self"
            }
            yield method(Recorder(), **needed)

    def test_methods_take_all_fields(self):
        added = dict(self.added())
        self.assertEqual(set(added), set(KINDS))
        for name, fields in added.items():
            with self.subTest(name):
                own = {field for field, _ in KINDS[name].struct._fields_} - set(HIDDEN)
                self.assertEqual(fields - {"inputs", "outline"}, own - self.EXCEPTED.get(name, set()))

    def test_there_is_a_kind_for_every_definition(self):
        ends = {name for name in _abi.PROTOTYPES if name.startswith("baum_mechanism_add_")}
        kinds = {f"baum_mechanism_add_{name}" for name in [*KINDS, "input", "break_times"]}
        self.assertEqual(ends, kinds)

    def test_there_is_a_shell_for_every_function(self):
        functions = {
            kind
            for kinds in KINDS.values()
            for _, kind in kinds.struct._fields_
            if issubclass(kind, ctypes._CFuncPtr)
        }
        self.assertEqual(functions, set(callbacks.SHELLS))


class BadInput(unittest.TestCase):
    def setUp(self):
        self.m = baum.Mechanism()
        self.body = self.m.planar_body("body")

    def says(self, error, words, function, *arguments, **fields):
        with self.assertRaisesRegex(error, words):
            function(*arguments, **fields)

    def test_wrong_numbers_name_element_and_field(self):
        self.says(
            ValueError,
            'body "x": position: 2 numbers are wanted, not 3',
            self.m.planar_body,
            "x",
            position=(1, 2, 3),
        )
        self.says(
            TypeError,
            "body \"x\": mass: a number is wanted, not 'heavy'",
            self.m.planar_body,
            "x",
            mass="heavy",
        )
        self.says(
            TypeError, "size: a whole number is wanted, not 2.5", self.m.coordinates, "x", 2.5
        )
        self.says(
            ValueError, "gravity: 2 or 3 numbers are wanted, not 1", baum.Mechanism, gravity=(1,)
        )
        self.assertNotIn("x", self.m)

    def test_refusals_are_errors_with_the_librarys_message(self):
        with self.assertRaises(baum.Error) as caught:
            self.m.planar_body("x", mass=-2)
        self.assertEqual(caught.exception.status, baum.Status.ERR_ARGUMENT)
        self.assertEqual(str(caught.exception.status), "ERR_ARGUMENT")
        self.assertRegex(str(caught.exception), '"x".*mass is -2 kg')
        self.assertNotIn("x", self.m)

    def test_a_name_is_used_once(self):
        self.says(ValueError, 'there is already a body "body"', self.m.planar_particle, "body")
        self.says(ValueError, 'there is already a body "ground"', self.m.planar_particle, "ground")
        self.says(TypeError, "name of a body is a string", self.m.planar_particle, 3)

    def test_unknown_names_and_fields_are_refused(self):
        self.says(
            KeyError,
            "no 'bodi' in this mechanism; there are: ground, body",
            self.m.__getitem__,
            "bodi",
        )
        self.says(KeyError, "no body 'x'", self.m.revolute, "pin", "ground", "x", point=(0, 0))
        self.says(
            TypeError, "a body or its name is wanted, not 3", self.m.revolute, "pin", 3, "body"
        )
        self.says(
            TypeError,
            'body "body" has no weight; there are: name, mass',
            self.m.copy,
            body=dict(weight=1),
        )
        self.says(TypeError, r"^Mechanism.planar_body\(\) got an unexpected", self.m.planar_body, "x", weight=1)
        self.says(TypeError, "names cannot change", self.m.copy, body=dict(name="x"))

    def test_a_joint_is_no_body(self):
        pin = self.m.revolute("pin", "ground", "body", point=(0, 0))
        self.says(TypeError, "a body or its name is wanted", self.m.load, "load", pin)
        self.says(TypeError, "a joint or its name is wanted", self.m.driver, "motor", "body")

    def test_a_body_of_another_mechanism_is_refused(self):
        stranger = baum.Mechanism().planar_body("stranger")
        self.says(baum.Error, "", self.m.revolute, "pin", "ground", stranger, point=(0, 0))

    def test_a_frozen_mechanism_cannot_be_changed(self):
        m = slider_crank()
        self.says(baum.Error, "frozen", m.planar_body, "x")
        self.says(baum.Error, "frozen", m["rod"].set, mass=1)
        self.assertNotIn("x", m)

    def test_errors_can_be_pickled(self):
        import pickle

        error = pickle.loads(pickle.dumps(baum.Error(baum.Status.ERR_STEP, "too small")))
        self.assertEqual((error.status, str(error)), (baum.Status.ERR_STEP, "too small"))


class Copies(unittest.TestCase):
    def test_a_copy_with_changes_leaves_the_original(self):
        m = slider_crank()
        heavy = m.copy(rod=dict(mass=0.5), crank=dict(position=(0.07, 0)))
        self.assertTrue(heavy.frozen)
        self.assertEqual(heavy["rod"].definition["mass"], 0.5)
        self.assertEqual(heavy["rod"].definition["inertia"], 5.9e-4)
        self.assertEqual(m["rod"].definition["mass"], 0.038)

    def test_a_copy_is_frozen_when_the_original_is(self):
        m = baum.Mechanism()
        m.planar_particle("bob")
        self.assertFalse(m.copy().frozen)
        self.assertTrue(m.freeze().copy().frozen)

    def test_a_thawed_copy_takes_more(self):
        m = slider_crank()
        more = m.thawed(rod=dict(mass=0.5))
        more.load("push", "slider", force=(1, 0))
        self.assertEqual((more.frozen, m.frozen), (False, True))
        self.assertEqual(more["rod"].definition["mass"], 0.5)
        self.assertNotIn("push", m)
        more.freeze().simulate([0.001], "rk4", step=1e-4)

    def test_handles_of_one_are_good_for_the_other(self):
        m = slider_crank()
        copy = m.copy()
        self.assertEqual(m["B"], copy["B"])
        self.assertNotEqual(m["B"], copy["A"])
        self.assertEqual(len({m["B"], copy["B"], m["A"]}), 2)
        run = copy.simulate([0.001], "rk4", step=1e-4, record=[m["B"].phi])
        self.assertEqual(run[m["B"].phi].shape, (1, 2))

    def test_functions_can_be_changed_in_a_copy(self):
        m = pendulum()
        longer = m.copy(circle=dict(phi=lambda t, q: q @ q - 4), bob=dict(position=(2, 0)))
        self.assertAlmostEqual(baum.Workspace(longer).phi(0, (2, 0))[0], 0)
        self.assertAlmostEqual(baum.Workspace(m).phi(0, (2, 0))[0], 3)


class Drafts(unittest.TestCase):
    def test_a_draft_can_be_examined(self):
        m = baum.Mechanism()
        arm = m.planar_body("arm", mass=1, inertia=1)
        m.revolute("pin", m.ground, arm, point=(0, 0))
        self.assertEqual((m.mobility().degrees_of_freedom, m.report().rows, m.frozen), (1, 2, False))
        m.fixed("weld", m.ground, arm, point=(0, 0))
        self.assertEqual((m.mobility().degrees_of_freedom, m.mobility().redundant_rows), (0, 2))

    def test_a_handle_is_the_same_while_it_is_kept(self):
        m = slider_crank()
        self.assertIs(m.ground, m.ground)
        b = m["B"]
        self.assertIs(m["B"], b)
        self.assertIs(m.simulation("rk4", step=1e-3).mechanism["B"], b)


class MovedCopies(unittest.TestCase):
    """A copy with another position or angle of a body must be the same mechanism in another
    configuration."""

    def everything(self):
        m = baum.Mechanism()
        a = m.planar_body("a", mass=1, inertia=1, position=(1, 0.5), angle=0.3)
        b = m.planar_body("b", mass=1, inertia=1, position=(2, 0.7), angle=-0.4)
        c = m.planar_body("c", mass=1, inertia=1, position=(3, -0.2), angle=0.1)
        p = m.planar_particle("p", mass=1, position=(2.5, 1))
        pin = m.revolute("pin", a, b, point=(1.5, 0.6))
        slide = m.translational("slide", b, c, point=(2.5, 0.2), axis=(1, 2))
        m.revolute("bead", b, p, point=(2.5, 1))
        m.pin_in_slot("slot", a, c, point=(0.2, 0.1), axis=(-1, 1))
        m.rack_and_pinion("rack", a, b, 0.3, point=(1.1, 0.4))
        m.gear("gear", a, b, 0.2, 0.3, carrier=c)
        m.curve("curve", a, b, lambda xy: (xy[1], 0, 1, 0, 0, 0), point=(1.2, 0))
        m.fixed("weld", b, c, point_a=(0.1, 0), point_b=(0, 0.2))
        m.distance("rod", a, c, point_a=(0.1, 0), point_b=(0, 0.2))
        m.coupling("cam", pin, slide, ratio=2)
        m.spring("spring", a, c, point_a=(0.1, 0), point_b=(0, 0.3), stiffness=1)
        m.torsion_spring("torsion", a, c, stiffness=1)
        m.knife_edge("blade", a, point=(0.7, -0.2), axis=(1, 3), body_b=c)
        return m

    def test_joints_and_forces_stay_as_they_were(self):
        m = self.everything().freeze()
        place = dict(position=(5, -3), angle=1.0)
        moved = baum.Workspace(m.copy(a=place, b=place, c=place))
        there = baum.Workspace(m)
        q, v = there.design()
        q = q + 0.1 * np.sin(np.arange(len(q)))
        v = np.cos(np.arange(len(v)))
        np.testing.assert_allclose(moved.phi(0, q), there.phi(0, q), atol=1e-14)
        np.testing.assert_allclose(moved.jacobian(0, q), there.jacobian(0, q), atol=1e-14)
        np.testing.assert_allclose(moved.force(0, q, v), there.force(0, q, v), atol=1e-14)

    def test_an_arm_keeps_its_pin(self):
        m = baum.Mechanism()
        arm = m.planar_body("arm", mass=1, inertia=0.1, position=(0, -0.5))
        m.revolute("pin", m.ground, arm, point=(0, 0))
        turned = m.freeze().copy(arm=dict(angle=0.5))
        self.assertEqual(turned["pin"].definition["point_b"], (0.0, 0.5))
        s = turned.simulation("rk4", step=1e-3)
        np.testing.assert_allclose(np.hypot(*s.q[:2]), 0.5)
        fits = m.copy(arm=dict(position=(0.5, 0), angle=np.pi / 2)).simulation("rk4", step=1e-3)
        np.testing.assert_allclose(fits.q, (0.5, 0, np.pi / 2), atol=1e-15)

    def test_points_and_lengths_given_to_a_copy_are_used(self):
        m = self.everything()
        copy = m.copy(b=dict(angle=1.0), pin=dict(point=(1.4, 0.6)), rod=dict(length=2))
        self.assertEqual(copy["pin"].definition["point"], (1.4, 0.6))
        self.assertEqual(copy["rod"].definition["length"], 2.0)

    def test_moving_a_particle_does_not_change_other_joints(self):
        m = self.everything()
        copy = m.copy(p=dict(position=(2.5, 1.5)))
        for joint in ("pin", "slide", "cam"):
            np.testing.assert_equal(copy[joint].definition, m[joint].definition)
        self.assertEqual(copy["bead"].definition["point_b"], (0.0, 0.0))


class Ownership(unittest.TestCase):
    def test_a_simulation_keeps_its_mechanism(self):
        s = pendulum().simulation("rk4", step=1e-3)
        gc.collect()
        s.advance_to(0.1)
        self.assertAlmostEqual(np.hypot(*s.q), 1, 9)

    def test_handles_and_runs_keep_their_mechanism(self):
        rod = slider_crank()["rod"]
        run = slider_crank().simulate([0.001], "rk4", step=1e-4)
        gc.collect()
        self.assertEqual(rod.definition["mass"], 0.038)
        self.assertEqual(run["rod.pose"].shape, (1, 3))

    def test_functions_live_as_long_as_a_copy(self):
        class Circle:
            def __call__(self, t, q):
                return q @ q - 1

        circle = Circle()
        alive = weakref.ref(circle)
        m = pendulum(circle)
        copy = m.copy()
        del m, circle
        gc.collect()
        self.assertIsNotNone(alive())
        copy.simulate([0.01], "rk4", step=1e-3)
        del copy
        gc.collect()
        self.assertIsNone(alive())

    def test_mechanisms_and_runs_go_without_the_collector(self):
        gc.disable()
        try:
            m = rod_pendulum()
            s = m.simulation("rk4", step=1e-3)
            s.advance_to(0.01)
            gone = [weakref.ref(m), weakref.ref(s)]
            del m, s
            self.assertEqual([ref() for ref in gone], [None, None])
        finally:
            gc.enable()


if __name__ == "__main__":
    unittest.main()
