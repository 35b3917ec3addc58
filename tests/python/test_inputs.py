# SPDX-License-Identifier: BSD-3-Clause
"""Tests how a program can act on a run: by inputs, and by setting the law of a driver."""

import ctypes
import gc
import math
import unittest
import weakref

import numpy as np

import baum
from compiler import CC, Folder
from mechanisms import slider_crank


def disk(initial=0.0, **load):
    """A free disk of 0.5 kg m^2 without gravity. An input sets its torque [N m]."""
    m = baum.Mechanism(gravity=(0, 0))
    body = m.planar_body("disk", mass=2, inertia=0.5, velocity=(0, 0), angular_velocity=0)
    torque = m.input("torque", initial)
    m.load("motor", body, **{"torque": 1, "input": torque, **load})
    return m


def force(w):
    """Return the force vector that a workspace computes if all positions and velocities are 0."""
    zeros = np.zeros(w.mechanism.sizes.nq)
    return w.force(0, zeros, zeros)


class Adding(unittest.TestCase):
    def test_an_input_is_a_handle_with_a_name_and_an_initial_value(self):
        m = baum.Mechanism()
        first, second = m.input(), m.input("torque", np.float32(0.5))
        self.assertEqual((first.name, first.initial, second.initial), ("input1", 0.0, 0.5))
        self.assertEqual(second.definition, {"name": "torque", "initial": 0.5})
        self.assertEqual(m["torque"], second)
        self.assertNotEqual(first, second)
        self.assertEqual((m.inputs, list(m)), ([first, second], [first, second]))
        self.assertEqual(repr(second), "<input 'torque'>")
        self.assertEqual(repr(m), "<mechanism: 0 bodies, 0 joints, 0 forces, 2 inputs, not frozen>")

    def test_a_load_names_its_input(self):
        m = disk()
        self.assertEqual(m["motor"].definition["input"], m["torque"])
        m.load("weight", "disk", force=(0, -1))
        self.assertIsNone(m["weight"].definition["input"])
        m["weight"].set(input="torque")
        self.assertEqual(m["weight"].definition["input"], m["torque"])

    def test_the_initial_value_can_be_changed_until_it_is_frozen(self):
        m = disk()
        self.assertEqual(m["torque"].set(initial=2).initial, 2.0)
        m.freeze()
        with self.assertRaisesRegex(baum.Error, "frozen"):
            m["torque"].set(initial=3)
        with self.assertRaisesRegex(baum.Error, "frozen"):
            m.input("late")
        self.assertNotIn("late", m)
        copy = m.copy(torque=dict(initial=3))
        self.assertEqual((m["torque"].initial, copy["torque"].initial), (2.0, 3.0))

    def test_what_makes_no_sense_is_refused_by_name(self):
        m = disk()
        for error, words, call in (
            (TypeError, "input \"x\": initial: a number is", lambda: m.input("x", "much")),
            (baum.Error, '"x".*inf', lambda: m.input("x", math.inf)),
            (TypeError, "the name of an input is a string", lambda: m.input(3)),
            (ValueError, 'there is already an input "torque"', lambda: m.planar_body("torque")),
            (TypeError, "an input or its name", lambda: m.load("l", "disk", input="disk")),
            (TypeError, "has no value; there are: name, init", lambda: m["torque"].set(value=1)),
            (TypeError, "names cannot change", lambda: m.copy(torque=dict(name="x"))),
        ):
            with self.assertRaisesRegex(error, words):
                call()
        self.assertNotIn("x", m)


class Runs(unittest.TestCase):
    def test_a_run_begins_with_the_initial_value_and_holds_what_it_is_given(self):
        m = disk(0.5).freeze()
        s, other = (m.simulation("rk4", step=1e-2) for _ in range(2))
        self.assertEqual(s.inputs, {"torque": 0.5})
        s.step(100)
        s.set_input("torque", -1)
        s.step(100)
        other.step(200)
        np.testing.assert_allclose([s.v[2], other.v[2]], [1 - 2, 2], rtol=1e-12)
        self.assertEqual((s.inputs, other.inputs), ({"torque": -1.0}, {"torque": 0.5}))

    def test_a_handle_of_the_original_is_good_for_a_run_of_a_copy(self):
        m = disk().freeze()
        s = m.copy(disk=dict(inertia=1)).simulation("rk4", step=1e-2)
        s.set_input(m["torque"], 2)
        s.step(100)
        self.assertAlmostEqual(s.v[2], 2, 12)

    def test_refused_values_change_nothing(self):
        s = disk(0.5).freeze().simulation("rk4", step=1e-2)
        with self.assertRaisesRegex(TypeError, "torque: a number is wanted, not 'full'"):
            s.set_input("torque", "full")
        with self.assertRaisesRegex(baum.Error, "torque.*nan"):
            s.set_input("torque", math.nan)
        with self.assertRaisesRegex(TypeError, "an input or its name is wanted"):
            s.set_input("disk", 1)
        with self.assertRaises(baum.Error):
            s.set_input(disk()["torque"], 1)
        self.assertEqual(s.inputs, {"torque": 0.5})

    @unittest.skipUnless(baum.has("sundials"), "no SUNDIALS")
    def test_variable_steps_restart_at_a_jump(self):
        s = disk().freeze().simulation("cvode_adams", rtol=1e-9)
        s.advance_to(1)
        s.set_input("torque", 0.5)
        s.advance_to(2)
        self.assertAlmostEqual(s.v[2], 1, 7)
        self.assertEqual(s.counters.restarts, 1)

    def test_a_workspace_has_its_own(self):
        m = disk(0.5, force=(3, 0), torque=2).freeze()
        w = baum.Workspace(m)
        np.testing.assert_array_equal(force(w), [1.5, 0, 1])
        w.set_input("torque", 2)
        np.testing.assert_array_equal(force(w), [6, 0, 4])
        self.assertEqual((w.inputs, baum.Workspace(m).inputs), ({"torque": 2.0}, {"torque": 0.5}))
        with self.assertRaises(baum.Error):
            w.set_input("torque", math.inf)


def several(**functions):
    """A mechanism with two coordinates and the inputs a, b and c. `functions` are fields of the
    coordinates, such as a force that receives some of the inputs."""
    m = baum.Mechanism()
    for k, name in enumerate("abc"):
        m.input(name, 10.0**k)
    fields = {"force": lambda t, q, v: (0, 0), **functions}
    m.coordinates("x", 2, mass=lambda t, q: np.eye(2), **fields)
    return m


class ForceFunctions(unittest.TestCase):
    def test_they_are_given_the_inputs_they_name_in_that_order(self):
        m = several(force=lambda t, q, v, c, a: (c, a), inputs=["c", "a"])
        w = baum.Workspace(m.freeze())
        np.testing.assert_array_equal(force(w), [100, 1])
        w.set_input("a", 5)
        np.testing.assert_array_equal(force(w), [100, 5])

    def test_values_are_floats(self):
        seen = set()

        def push(t, q, v, *values):
            seen.update(map(type, values))
            return (0, 0)

        force(baum.Workspace(several(force=push, inputs=["b"]).freeze()))
        self.assertEqual(seen, {float})

    def test_user_forces_take_them_too(self):
        m = several()
        given = dict(force_q=lambda t, q, v, b: b * np.eye(2), inputs=[m["b"]])
        m.force("push", ["x"], lambda t, q, v, b: b * q, potential=lambda t, q: 0.0, **given)
        w = baum.Workspace(m.freeze())
        np.testing.assert_array_equal(w.force(0, (1, 2), (0, 0)), [10, 20])
        m.check_derivatives()

    def test_functions_that_name_none_get_none(self):
        m = several(force=lambda t, q, v: (1, 2)).freeze()
        np.testing.assert_array_equal(force(baum.Workspace(m)), [1, 2])

    def test_in_a_copy_inputs_come_with_their_functions(self):
        m = several(force=lambda t, q, v, a: (a, 0), inputs=["a"]).freeze()
        plain = m.copy(x=dict(force=lambda t, q, v: (7, 7)))
        other = m.copy(x=dict(force=lambda t, q, v, b: (b, b), inputs=["b"]))
        np.testing.assert_array_equal(force(baum.Workspace(plain)), [7, 7])
        np.testing.assert_array_equal(force(baum.Workspace(other)), [10, 10])
        np.testing.assert_array_equal(force(baum.Workspace(m)), [1, 0])
        with self.assertRaisesRegex(TypeError, 'body "x": inputs are given without the func'):
            m.copy(x=dict(inputs=["b"]))

    def test_a_copy_may_have_more_inputs(self):
        copy = several(force=lambda t, q, v, c: (c, c), inputs=["c"]).copy()
        copy.input("d", 1000)
        np.testing.assert_array_equal(force(baum.Workspace(copy.freeze())), [100, 100])

    def test_what_takes_no_inputs_says_so(self):
        m = several()
        with self.assertRaisesRegex(TypeError, "has no inputs; there are"):
            m.copy(x=dict(mass=None), a=dict(inputs=["b"]))
        with self.assertRaisesRegex(TypeError, "an input or its name is wanted"):
            m.force("push", ["x"], lambda t, q, v, x: x, inputs=["x"])

    def test_an_input_of_another_mechanism_is_refused(self):
        m, other = several(), baum.Mechanism()
        stranger, namesake = other.input("d"), other.input("c")
        with self.assertRaisesRegex(KeyError, "no input 'd'"):
            m.force("push", ["x"], lambda t, q, v, d: q, inputs=[stranger])
        with self.assertRaisesRegex(ValueError, '"push": <input \'c\'> is an input of another'):
            m.force("push", ["x"], lambda t, q, v, c: q, inputs=[namesake])

    def test_an_exception_keeps_an_input_as_it_was(self):
        def push(t, q, v, a):
            if a > 1:
                raise ZeroDivisionError(a)
            return (0, 0)

        s = several(force=push, inputs=["a"]).freeze().simulation("rk4", step=1e-2)
        s.set_input("a", 2)
        with self.assertRaises(ZeroDivisionError):
            s.step()
        s.set_input("a", 0)
        s.step()
        self.assertEqual(s.inputs["a"], 0.0)

    def test_functions_live_as_long_as_a_run(self):
        class Push:
            def __call__(self, t, q, v, a):
                return (a, a)

        push = Push()
        alive = weakref.ref(push)
        s = several(force=push, inputs=["a"]).freeze().simulation("rk4", step=1e-2)
        del push
        gc.collect()
        self.assertIsNotNone(alive())
        s.step()
        del s
        gc.collect()
        self.assertIsNone(alive())


COMPILED = """
int push(double t, const double *q, const double *v, const double *inputs, double *out, void *user);
int push(double t, const double *q, const double *v, const double *inputs, double *out, void *user)
{
  (void)t, (void)q, (void)v, (void)user;
  out[0] = inputs[1];
  out[1] = inputs[2];
  return 0;
}
"""


@unittest.skipUnless(CC, "no C compiler")
class Compiled(unittest.TestCase):
    def test_a_compiled_force_is_given_all_inputs(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        push = ctypes.CDLL(folder.shared_object(COMPILED)).push
        m = several(force=push).freeze()
        np.testing.assert_array_equal(force(baum.Workspace(m)), [10, 100])


class Drivers(unittest.TestCase):
    def test_a_driver_follows_the_law_of_the_run(self):
        m = slider_crank(omega=150)
        s, other = (m.simulation("kinematics") for _ in range(2))
        s.advance_to(0.01)
        s.set_driver("motor", 1.5, rate=150, acceleration=-1000)
        s.advance_to(0.03)
        other.advance_to(0.03)
        np.testing.assert_allclose(s.get("A.coordinate"), [1.5 + 3 - 0.2, 130], rtol=1e-12)
        np.testing.assert_allclose(other.get("A.coordinate"), [4.5, 150], rtol=1e-12)

    def test_a_driver_without_new_rates_stops(self):
        s = slider_crank(omega=150).simulation("kinematics")
        s.advance_to(0.01)
        s.set_driver(s.mechanism["motor"], 1.5)
        s.advance_to(0.03)
        np.testing.assert_allclose(s.get("A.coordinate"), [1.5, 0], atol=1e-12)

    def test_what_makes_no_sense_is_refused_by_name(self):
        s = slider_crank(omega=150).simulation("rk4", step=1e-4)
        with self.assertRaisesRegex(TypeError, "motor: rate: a number is wanted, not 'fast'"):
            s.set_driver("motor", 0, rate="fast")
        with self.assertRaisesRegex(TypeError, "a joint or its name is wanted"):
            s.set_driver("crank", 0)
        with self.assertRaisesRegex(baum.Error, "not a driver"):
            s.set_driver("A", 0)
        with self.assertRaises(baum.Error):
            s.set_driver("motor", 0, acceleration=math.nan)


if __name__ == "__main__":
    unittest.main()
