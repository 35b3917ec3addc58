# SPDX-License-Identifier: BSD-3-Clause
"""Tests joints other than pin, slider, rod and weld. Every argument must reach the library."""

import math
import unittest

import numpy as np

import baum


def phi(m, q, t=0.0):
    """Return Phi of a mechanism at positions q."""
    return baum.Workspace(m.freeze()).phi(t, q)


class Rows(unittest.TestCase):
    def test_a_pin_in_a_slot_keeps_to_its_axis_and_can_be_driven(self):
        m = baum.Mechanism()
        ball = m.planar_particle("ball", position=(0.3, 0.0))
        slot = m.pin_in_slot("slot", m.ground, ball, axis=(0, 2), point_a=(1, 0), point_b=(0, 0))
        m.driver("push", slot, value=0.25)
        np.testing.assert_allclose(phi(m, (4, 3)), (-3, 2.75), atol=1e-15)

    def test_a_rack_and_pinion_rolls(self):
        m = baum.Mechanism()
        wheel = m.planar_body("wheel", position=(0, 0.5))
        m.rack_and_pinion(
            "rack", "ground", wheel, -0.5, axis=(1, 0), point_a=(0, 0), point_b=(0, 0), offset=0.1
        )
        np.testing.assert_allclose(phi(m, (2, 0.5, 3)), [2 + 0.5 * 3 - 0.1], rtol=1e-15)

    def test_a_gear_turns_wheels_on_a_carrier(self):
        m = baum.Mechanism()
        for name in ("sun", "planet", "arm"):
            m.planar_body(name)
        m.gear("free", "sun", "planet", 1, 2, carrier="arm", offset=0.5)
        m.gear("fixed", "sun", "planet", 1, -2)
        q = np.zeros(9)
        q[2::3] = 1.0, 10.0, 100.0
        np.testing.assert_allclose(phi(m, q), [-99 - 180 - 0.5, 1 - 20], rtol=1e-15)
        self.assertEqual(m["free"].definition["carrier"], m["arm"])
        self.assertEqual(m["fixed"].definition["carrier"], m.ground)

    def test_a_point_stays_on_a_curve(self):
        seen = []

        def parabola(xy):
            seen.append(xy.tolist())
            x, y = xy
            return y - x * x, -2 * x, 1, -2, 0, 0

        m = baum.Mechanism()
        ball = m.planar_particle("ball", position=(1, 1))
        m.curve("wire", m.ground, ball, parabola, point_a=(0.5, 0), point_b=(0, 0))
        np.testing.assert_allclose(phi(m, (2.5, 5)), [1.0])
        self.assertIn([2.0, 5.0], seen)

    def test_a_knife_edge_restricts_velocities_only(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        sleigh = m.planar_body("sleigh", mass=2, inertia=0.15, velocity=(0.5, 0.39), angular_velocity=1.3)
        m.knife_edge("blade", sleigh, point_a=(-0.3, 0))
        mobility = m.freeze().mobility()
        self.assertEqual((mobility.degrees_of_freedom, mobility.position_degrees_of_freedom), (2, 3))
        self.assertEqual(m.report().velocity_rows, 1)
        np.testing.assert_allclose(phi(m, (4, 3, 2)), [0])
        run = baum.Simulation(m, "rk8", rtol=1e-10)
        run.advance_to(4)
        # The velocity u along the blade and the angular velocity w satisfy u' = 0.3 w^2, and u^2 +
        # k2 w^2 is constant.
        u0, w0, k2 = 0.5, 1.3, 0.15 / 2 + 0.09
        u = math.sqrt(u0**2 + k2 * w0**2)
        k = 0.3 * u / k2
        np.testing.assert_allclose(run.v[2], math.sqrt(u * k / 0.3) / math.cosh(4 * k + math.atanh(u0 / u)), rtol=1e-8)
        with self.assertRaisesRegex(baum.Error, "rows of velocity level"):
            baum.Simulation(m, "rattle", step=1e-3)

    def test_a_constraint_on_velocities_needs_its_jacobian(self):
        m = baum.Mechanism()
        ball = m.planar_particle("ball", velocity=(1, None))
        with self.assertRaisesRegex(baum.Error, r"jacobian\(\) is None, must be given"):
            m.constraint("track", ball, 1, velocity_level=True)
        m.constraint("track", ball, 1, velocity_level=True, jacobian=lambda t, q: [[-0.5, 1]])
        run = baum.Simulation(m.freeze(), "rk4", step=1e-2)
        np.testing.assert_allclose(run.v, (1, 0.5))

    def test_a_disc_rolls(self):
        m = baum.Mechanism()
        wheel = m.spatial_body("wheel", position=(0, 0.5, 0), velocity=(2, 0, 0))
        m.rolling_disc("contact", wheel, 0.5, rim_radius=0.1)
        self.assertEqual(m.freeze().mobility().position_degrees_of_freedom, 5)
        run = baum.Simulation(m, "rk4", step=1e-2)
        np.testing.assert_allclose(run.v[3:], (0, 0, -4), atol=1e-14)
        run.advance_to(1)
        np.testing.assert_allclose(run.q[:3], (2, 0.5, 0), atol=1e-12)

    def test_a_skate_in_space(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        skate = m.spatial_body("skate", position=(1, 0, 0), velocity=(2, 3, None), angular_velocity=(0, 0, 0))
        m.spatial_knife_edge("blade", skate, point_a=(0, 0, 0), axis=(0, 0, 2))
        mobility = m.freeze().mobility()
        self.assertEqual((mobility.degrees_of_freedom, mobility.position_degrees_of_freedom), (5, 6))
        run = baum.Simulation(m, "rk4", step=1e-2)
        np.testing.assert_allclose(run.v, (2, 3, 0, 0, 0, 0), atol=1e-14)
        run.advance_to(1)
        np.testing.assert_allclose(run.q[:3], (3, 3, 0), atol=1e-12)

    def test_a_point_stays_on_a_curve_in_space(self):
        seen = []

        def line(xyz):
            seen.append(xyz.tolist())
            return [xyz[0], 1, *[0] * 8, xyz[1] - 2 * xyz[2], 0, 1, -2, *[0] * 6]

        m = baum.Mechanism()
        ball = m.spatial_particle("ball", position=(0.5, 4, 2))
        m.spatial_curve("wire", m.ground, ball, line, point_a=(0.5, 0, 0), point_b=(0, 0, 0))
        np.testing.assert_allclose(phi(m, (2.5, 5, 1)), [2.0, 3.0])
        self.assertIn([2.0, 5.0, 1.0], seen)
        m = baum.Mechanism()
        m.spatial_particle("ball")
        m.spatial_curve("wire", "ground", "ball", lambda xyz: 6 * [0.0], point=(0, 0, 0))
        with self.assertRaisesRegex(ValueError, r"wire.*curve must return an array of shape \(20,\)"):
            phi(m, (0, 0, 0))

    def test_a_cable_lifts_a_weight(self):
        m = baum.Mechanism(up="z")
        m.spatial_particle("light", position=(0, 0, 0))
        m.spatial_particle("heavy", mass=3, position=(1, 0, 0))
        path = [(0, 0, 0), (0, 0, 2), (1, 0, 2), (0, 0, 0)]
        rope = m.cable("rope", ["light", m.ground, m.ground, "heavy"], path, stiffness=1e4, free_length=5.0 - 1.5e-4 * 9.81)
        self.assertEqual([one.name for one in rope.definition["bodies"]], ["light", "ground", "ground", "heavy"])
        np.testing.assert_allclose(rope.definition["points"], path)
        # The initial stretch gives the cable the tension of Atwood's machine, 2 m M g / (m + M).
        run = m.freeze().simulation("rk8", step=1e-3)
        run.advance_to(0.5)
        np.testing.assert_allclose(run.q[[2, 5]], (0.125 * 9.81 / 2, -0.125 * 9.81 / 2), atol=1e-9)

    def test_wrong_cables_are_refused(self):
        for bodies, points, error, said in (
            (["bob"], [(0, 0, 0)], baum.Error, r"len\(bodies\) is 1, must be at least 2"),
            ([], [], baum.Error, r"len\(bodies\) is 0, must be at least 2"),
            (["bob", "ground"], [(0, 0, 0)], ValueError, "points: 6 numbers are wanted, not 3"),
            (["bob", "ground"], [(0, 0), (0, 0, 0)], ValueError, "points: 3 numbers are wanted, not 2"),
            (["bob", "ground"], 3, TypeError, "points are wanted, not 3"),
            (["bob", "ground"], [(0, 0, 0), (0, math.inf, 0)], baum.Error, r"points\[1\]\[1\] is inf m, must be finite"),
            (["ground", "bob"], [(0, 0, 0), (0, 1, 0)], baum.Error, r"points\[1\] is \(0, 1, 0\) m, must be \(0, 0, 0\)"),
            (["bob", "nobody"], [(0, 0, 0), (0, 1, 0)], KeyError, "nobody"),
        ):
            m = baum.Mechanism()
            m.spatial_particle("bob")
            with self.subTest(points), self.assertRaisesRegex(error, said):
                m.cable("rope", bodies, points)

    def test_stability_of_rows_of_velocity_level(self):
        self.assertEqual(baum.stability_limit("euler", velocity_level=True), 2)
        self.assertAlmostEqual(baum.stability("rk2", 1.0).spectral_radius, 0.5, 14)
        self.assertEqual(baum.stability("semi_implicit_euler", 1.5).roots[0], -0.5)

    def test_a_curve_returns_six_numbers(self):
        m = baum.Mechanism()
        m.planar_particle("ball")
        m.curve("wire", "ground", "ball", lambda xy: 1.0, point=(0, 0))
        with self.assertRaisesRegex(ValueError, "wire.*curve must return an array of shape"):
            phi(m, (0, 0))


class Couplings(unittest.TestCase):
    def mechanism(self, **fields):
        """A crank and a weight on the ground, and a coupling of both."""
        m = baum.Mechanism()
        crank = m.planar_body("crank", angle=0.5)
        weight = m.planar_body("weight", position=(1, 0.2))
        pin = m.revolute("pin", m.ground, crank, point=(0, 0))
        guide = m.translational(
            "guide", m.ground, weight, axis=(0, 1), point_a=(1, 0), point_b=(0, 0)
        )
        m.coupling("rope", pin, guide, **fields)
        return m

    def last(self, m, angle, height):
        return phi(m, (0, 0, angle, 1, height, 0))[-1]

    def test_a_line(self):
        self.assertAlmostEqual(self.last(self.mechanism(), 0.5, 0.2), 0.0, places=15)
        m = self.mechanism(ratio=3, offset=0.25)
        self.assertAlmostEqual(self.last(m, 2.0, 1.0), 1 - 6.25, places=14)
        self.assertEqual(m["rope"].definition["joint_b"], m["guide"])

    def test_a_law(self):
        m = self.mechanism(law=lambda x: (math.sin(x), math.cos(x), -math.sin(x)))
        self.assertAlmostEqual(self.last(m, 2.0, 1.0), 1 - math.sin(2.0), places=15)

    def test_a_wrong_slope_is_found(self):
        m = self.mechanism(law=lambda x: (math.sin(x), math.sin(x), -math.sin(x))).freeze()
        with self.assertRaisesRegex(baum.Error, r"rope.*law\(\)\[1\]"):
            m.simulate([0, 0.1], "rk4", step=1e-2)

    def test_an_exception_in_a_law_comes_back(self):
        def law(x):
            raise KeyError("no such cam")

        with self.assertRaises(KeyError):
            self.last(self.mechanism(law=law), 0.0, 0.0)


if __name__ == "__main__":
    unittest.main()
