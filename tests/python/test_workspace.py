# SPDX-License-Identifier: BSD-3-Clause
"""Tests evaluations at a state: the shapes of results, and that results are consistent."""

import unittest

import numpy as np

import baum
from mechanisms import pendulum, slider_crank


class Workspaces(unittest.TestCase):
    def setUp(self):
        self.m = slider_crank(omega=150)
        self.w = baum.Workspace(self.m)
        self.q, self.v = self.w.assemble()

    def test_assembling_fulfils_the_constraints(self):
        np.testing.assert_allclose(self.w.phi(0, self.q), 0, atol=1e-12)
        np.testing.assert_allclose(
            self.w.jacobian(0, self.q) @ self.v, self.w.nu(0, self.q), atol=1e-9
        )
        self.assertAlmostEqual(self.v[2], 150)

    def test_equations_of_motion_hold(self):
        w, q, v = self.w, self.q, self.v
        a, lambda_ = w.acceleration(0, q, v)
        jacobian = w.jacobian(0, q)
        np.testing.assert_allclose(
            w.mass(0, q) @ a + jacobian.T @ lambda_, w.force(0, q, v), atol=1e-8
        )
        np.testing.assert_allclose(jacobian @ a, w.gamma(0, q, v), rtol=1e-9, atol=1e-6)
        stabilized, _ = w.acceleration(0, q + 1e-6, v, alpha=10, beta=10)
        self.assertTrue(np.isfinite(stabilized).all())
        self.assertEqual(w.reaction(0, q, lambda_, "B").shape, (3,))

    def test_drawing_energy_and_projection(self):
        q, v = self.w.design()
        self.assertEqual(q[:3].tolist(), [0.0765, 0, 0])
        self.assertTrue(np.isnan(v).all())
        kinetic, potential = self.w.energy(0, self.q, self.v)
        np.testing.assert_allclose(kinetic, 0.5 * self.v @ self.w.mass(0, self.q) @ self.v)
        self.assertIsInstance(potential, float)
        moved, velocity = self.w.project(0, self.q + 1e-4, self.v)
        np.testing.assert_allclose(self.w.phi(0, moved), 0, atol=1e-11)
        np.testing.assert_allclose(
            self.w.jacobian(0, moved) @ velocity, self.w.nu(0, moved), atol=1e-8
        )

    def test_held_values_stay(self):
        m = slider_crank()
        w = baum.Workspace(m)
        q, v = w.assemble(v=[np.nan, np.nan, 150] + 6 * [np.nan], held=["crank"])
        self.assertEqual((q[:3].tolist(), v[2]), ([0.0765, 0, 0], 150))
        np.testing.assert_allclose(w.jacobian(0, q) @ v, 0, atol=1e-9)

    def test_arguments_are_not_changed(self):
        q, v = self.q + 1e-4, self.v.copy()
        before = q.copy()
        self.w.project(0, q, v)
        np.testing.assert_array_equal(q, before)

    def test_wrong_arguments_are_named(self):
        with self.assertRaisesRegex(ValueError, "q: 9 numbers are wanted, not 2"):
            self.w.phi(0, (1, 2))
        with self.assertRaisesRegex(TypeError, "t: a number is wanted"):
            self.w.phi("now", self.q)
        with self.assertRaisesRegex(TypeError, "a joint or its name is wanted"):
            self.w.reaction(0, self.q, np.zeros(9), "rod")
        with self.assertRaises(baum.Error):
            self.w.phi(0, self.q * np.nan)

    def test_user_constraints_have_reactions_too(self):
        w = baum.Workspace(pendulum())
        np.testing.assert_allclose(w.reaction(0, (1, 0), [2.0], "circle"), [-4, 0], atol=1e-8)


class Revolutions(unittest.TestCase):
    def test_angles_are_given(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        wheel = m.spatial_body("wheel", mass=1, inertia=(1, 1, 1))
        pin = m.spatial_revolute("pin", m.ground, wheel, point=(0, 0, 0), axis=(0, 0, 1))
        m.joint_spring("spiral", pin, stiffness=2.0)
        with baum.Workspace(m.freeze()) as w:
            q, v = w.design()[0], np.zeros(6)
            for angle, wanted in ((0.0, 0.0), (13.0, 4 * np.pi), (-6.0, -2 * np.pi)):
                w.set_angle("pin", angle)
                self.assertAlmostEqual(w.energy(0, q, v)[1], wanted**2)
            with self.assertRaisesRegex(ValueError, "coordinate"):
                w.set_angle(pin, 1.0, "nonsense")
            with self.assertRaisesRegex(baum.Error, "nan rad, must be finite"):
                w.set_angle(pin, float("nan"))

    def test_a_run_is_given_angles(self):
        m = baum.Mechanism(gravity=(0, 0, 0))
        wheel = m.spatial_body("wheel", mass=1, inertia=(1, 1, 1))
        m.spatial_revolute("pin", m.ground, wheel, point=(0, 0, 0), axis=(0, 0, 1))
        m.joint_spring("spiral", "pin", stiffness=2.0)
        s = m.freeze().simulation("rk4", step=0.01)
        s.set_angle("pin", 13.0)
        self.assertAlmostEqual(s.get("pin.coordinate")[0], 4 * np.pi)
        self.assertAlmostEqual(s.get("energy")[1], (4 * np.pi) ** 2)
        with self.assertRaisesRegex(ValueError, "coordinate"):
            s.set_angle("pin", 1.0, "nonsense")
        with self.assertRaisesRegex(baum.Error, "nan rad, must be finite"):
            s.set_angle("pin", float("nan"))


if __name__ == "__main__":
    unittest.main()
