# SPDX-License-Identifier: BSD-3-Clause
"""Tests springs with and without a user's law, and drivers along splines."""

import ctypes
import math
import unittest

import numpy as np

import baum
from compiler import CC, Folder

PAIR = (0, 0, 0, 3, 4, 2)  # q of two bodies, which are 5 m and 2 rad apart


def pair():
    """Two bodies without gravity."""
    m = baum.Mechanism(gravity=(0, 0))
    m.planar_body("a")
    m.planar_body("b", position=(3, 4))
    return m


def force(m, v=np.zeros(6)):
    """Return the force vector of two bodies that are 5 m and 2 rad apart."""
    return baum.Workspace(m.freeze()).force(0, PAIR, v)


class Springs(unittest.TestCase):
    def test_a_torsion_spring_takes_all_its_fields(self):
        m = pair()
        m.torsion_spring("clock", "a", "b", stiffness=3, damping=0.5, free_angle=0.25)
        torque = 3 * (2 - 0.25) + 0.5 * 4
        np.testing.assert_allclose(force(m, (0, 0, -1, 0, 0, 3)), [0, 0, torque, 0, 0, -torque])
        self.assertEqual(m["clock"].definition["free_angle"], 0.25)
        self.assertEqual(m["clock"].definition["body_b"], m["b"])

    def test_a_law_gives_the_torque_of_a_torsion_spring(self):
        m = pair()
        m.torsion_spring("clock", "a", "b", law=lambda s, ds: (s**3 + ds, 3 * s * s, 1))
        np.testing.assert_allclose(force(m, (0, 0, 0, 0, 0, 1)), [0, 0, 9, 0, 0, -9])
        m.check_derivatives()

    def test_numbers_that_a_law_replaces_are_refused(self):
        def law(*given):
            return 0, 0, 0

        m = pair()
        pin = m.revolute("pin", "ground", "a", point=(0, 0))
        other = m.revolute("other", "a", "b", point=(1, 0))
        ends = {"point_a": (0, 0), "point_b": (0, 0)}
        bodies = {"bodies": ["a", "b"], "points": [(0, 0, 0)] * 2}
        for add, given, field in (
            (m.driver, {"joint": pin}, {"rate": 3}),
            (m.coupling, {"joint_a": pin, "joint_b": other}, {"ratio": 2}),
            (m.joint_spring, {"joint": pin}, {"stiffness": 1e3}),
            (m.spring, {"body_a": "a", "body_b": "b", **ends}, {"free_length": 0}),
            (m.torsion_spring, {"body_a": "a", "body_b": "b"}, {"damping": 1}),
            (m.cable, bodies, {"transition": 0.1}),
        ):
            name = next(iter(field))
            with self.assertRaisesRegex(baum.Error, f"{name} is .*, but law is given, which replaces {name}"):
                add("twice", law=law, **given, **field)
            add(add.__name__, law=law, **given)
        moved = m.copy(b={"position": (3, 5)})
        self.assertTrue(np.isnan(moved["joint_spring"].definition["free_value"]))

    def test_a_law_gives_the_tension_of_a_spring(self):
        seen = []

        def law(length, rate):
            seen.append((length, rate))
            return 10 * length, 10, 0

        m = pair()
        m.spring("rope", "a", "b", point_a=(0, 0), point_b=(0, 0), law=law)
        np.testing.assert_allclose(force(m), [30, 40, 0, -30, -40, 0], rtol=1e-14)
        self.assertIn((5.0, 0.0), seen)
        self.assertTrue(m.has_python)

    def test_a_law_returns_three_numbers(self):
        m = pair()
        m.spring("rope", "a", "b", point_a=(0, 0), point_b=(0, 0), law=lambda s, ds: s)
        with self.assertRaisesRegex(ValueError, r'force "rope": law must return .* shape \(3,\)'):
            force(m)

    def test_an_exception_in_a_law_comes_back(self):
        def law(s, ds):
            raise ZeroDivisionError("of mine")

        m = pair()
        m.torsion_spring("clock", "a", "b", law=law)
        with self.assertRaisesRegex(ZeroDivisionError, "of mine"):
            force(m)

    def test_a_wrong_derivative_is_found(self):
        m = pair()
        m.torsion_spring("clock", "a", "b", law=lambda s, ds: (s**3, s, 0))
        with self.assertRaisesRegex(baum.Error, "clock.*law"):
            m.freeze().simulation("rk4", step=1e-2)

    def test_a_copy_may_have_another_law(self):
        m = pair()
        m.torsion_spring("clock", "a", "b", law=lambda s, ds: (s, 1, 0))
        copy = m.copy(clock=dict(law=lambda s, ds: (2 * s, 2, 0)))
        self.assertEqual((force(m)[2], force(copy)[2]), (2.0, 4.0))


COMPILED = """
int law(double length, double rate, double *out, void *user);
int law(double length, double rate, double *out, void *user)
{
  (void)rate;
  out[0] = *(double *)user * length;
  out[1] = *(double *)user;
  return 0;
}
"""


@unittest.skipUnless(CC, "no C compiler")
class Compiled(unittest.TestCase):
    def test_a_compiled_law_is_taken_with_its_user(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        law = ctypes.CDLL(folder.shared_object(COMPILED)).law
        m = pair()
        m.torsion_spring("clock", "a", "b", law=law, user=ctypes.pointer(ctypes.c_double(7.0)))
        self.assertEqual(force(m)[2], 14.0)
        self.assertFalse(m.has_python)


def driven(times, values, **fields):
    """A crank that follows a spline."""
    m = baum.Mechanism()
    crank = m.planar_body("crank", position=(1, 0))
    pin = m.revolute("pin", m.ground, crank, point=(0, 0))
    m.spline_driver("motor", pin, times, values, **fields)
    return m


TIMES = np.linspace(0, 1, 21)


class Splines(unittest.TestCase):
    def angle(self, m, t):
        return m.freeze().simulate([t], "kinematics")["crank.pose"][0, 2]

    def test_a_driver_goes_through_the_values(self):
        m = driven(TIMES, np.sin(TIMES))
        for t in TIMES[::5]:
            self.assertAlmostEqual(self.angle(m, t), math.sin(t), 12)

    def test_a_natural_spline_goes_on_straight_and_a_periodic_one_repeats_itself(self):
        m = driven([0, 1, 2], [0, 1, 2])
        self.assertAlmostEqual(self.angle(m, 5.0), 5.0, 12)
        wave = driven(TIMES, np.sin(2 * np.pi * TIMES).round(12), periodic=True)
        self.assertAlmostEqual(self.angle(wave, 2.25), 1.0, 12)

    def test_the_points_come_back(self):
        said = driven([0, 1, 3], (0, 0.5, 0), periodic=True)["motor"].definition
        np.testing.assert_array_equal([said["times"], said["values"]], [[0, 1, 3], [0, 0.5, 0]])
        self.assertEqual((said["periodic"], said["joint"].name), (True, "pin"))
        self.assertNotIn("count", said)

    def test_what_was_given_is_copied(self):
        values = np.sin(TIMES)
        m = driven(TIMES, values)
        values[:] = 0
        self.assertAlmostEqual(self.angle(m, TIMES[5]), math.sin(TIMES[5]), 12)

    def test_points_can_be_changed(self):
        m = driven([0, 1, 2], [0, 1, 2])
        self.assertAlmostEqual(self.angle(m.copy(motor=dict(values=[0, -1, -2])), 1.0), -1.0, 12)
        longer = m.copy(motor=dict(times=[0, 1, 2, 3], values=[0, 2, 4, 6]))
        self.assertAlmostEqual(self.angle(longer, 3.0), 6.0, 12)
        self.assertAlmostEqual(self.angle(m, 1.0), 1.0, 12)

    def test_lengths_that_differ_are_refused(self):
        with self.assertRaisesRegex(ValueError, '"motor": values: 3 numbers are wanted, not 2'):
            driven([0, 1, 2], [0, 1])
        m = driven([0, 1, 2], [0, 1, 2])
        for fields in (dict(times=[0, 1, 2, 3]), dict(values=[0, 1])):
            with self.assertRaisesRegex(ValueError, "3 numbers are wanted"):
                m.copy(motor=fields)

    def test_refusals_keep_the_librarys_message(self):
        for times in ([0, 1], [0, 2, 1]):
            with self.assertRaisesRegex(baum.Error, '"motor"'):
                driven(times, np.zeros(len(times)))


if __name__ == "__main__":
    unittest.main()
