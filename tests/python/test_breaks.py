# SPDX-License-Identifier: BSD-3-Clause
"""Tests break times, and a run's messages about singular configurations. C tests cover everything
else about break times and singular configurations."""

import math
import unittest

import baum


class Breaks(unittest.TestCase):
    def test_times_are_kept_in_order(self):
        m = baum.Mechanism()
        self.assertEqual(m.break_times.tolist(), [])
        m.add_break_times([2, 0.5])
        m.add_break_times(1)
        self.assertEqual(m.break_times.tolist(), [0.5, 1, 2])
        with self.assertRaisesRegex(baum.Error, "finite"):
            m.add_break_times([math.nan])

    def test_a_run_restarts_at_a_jump(self):
        m = baum.Mechanism(gravity=(0, 0))
        ball = m.planar_particle("ball", mass=1, position=(0, 0), velocity=(0, 0))
        m.force("push", [ball], lambda t, q, v: (1.0 if t >= 0.7 else 0.0, 0.0))
        m.add_break_times([0.7])
        run = m.freeze().simulate([2], "rk8", rtol=1e-10)
        # After the break the force is constant. The method is therefore exact, except for rounding.
        self.assertAlmostEqual(run.q[-1, 0], 1.3**2 / 2, 12)
        self.assertEqual(run.counters.restarts, 1)


class NearSingular(unittest.TestCase):
    def test_a_singular_configuration_is_reported(self):
        m = baum.Mechanism()
        a, b, c = (
            m.planar_body(name, mass=1, inertia=0.1, position=place, angle=angle)
            for name, place, angle in (
                ("a", (0, 0.5), math.pi / 2),
                ("b", (1, 1), 0),
                ("c", (2, 0.5), math.pi / 2),
            )
        )
        m.revolute("A", m.ground, a, point=(0, 0))
        m.revolute("B", a, b, point=(0, 1))
        m.revolute("C", b, c, point=(2, 1))
        m.revolute("D", m.ground, c, point=(2, 0))
        s = m.copy(a=dict(angular_velocity=2)).freeze().simulation("rk8", rtol=1e-8)
        self.assertEqual(s.near_singular, [])
        with self.assertWarnsRegex(baum.Warning, "near a singular configuration"):
            s.advance_to(1)
        crossings = s.near_singular
        self.assertEqual(len(crossings), s.counters.near_singular_intervals)
        first = crossings[0]
        self.assertTrue(first.begin < first.t < first.end)
        self.assertLess(first.pivot, 1e-3)
        self.assertEqual(first.branch, "continued")
        self.assertIn(first.joint.name, "ABCD")


if __name__ == "__main__":
    unittest.main()
