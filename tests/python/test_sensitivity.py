# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of results with respect to parameters, and the warnings about their errors."""

import unittest
import warnings

import numpy as np

import baum


def falling(velocity=(3.0, 0.0)):
    m = baum.Mechanism()
    m.planar_particle("stone", mass=2.0, position=(0.0, 0.0), velocity=velocity)
    return m.freeze()


def pendulum():
    m = baum.Mechanism()
    m.planar_body("arm", mass=1.0, inertia=0.02, position=(0.5, 0), angular_velocity=1.0)
    m.revolute("pin", "ground", "arm", point=(0, 0))
    return m.freeze()


class Sensitivity(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("error")
        self.addCleanup(warnings.resetwarnings)

    def test_a_free_fall_has_the_derivatives_of_its_formula(self):
        times = [0.0, 0.5, 2.0]
        found = baum.sensitivities(
            falling(), {"stone.mass": 2.0, "stone.velocity": [3.0, 0.0]}, times, "rk4", step=0.1,
            record="stone.pose")  # fmt: skip
        self.assertEqual(
            found.parameters, ("stone.mass", "stone.velocity[0]", "stone.velocity[1]"))
        value = found["stone.pose"]
        self.assertEqual(value.shape, (3, found["stone.pose"].shape[1], 3))
        wanted = np.zeros((3, 2, 3))  # x = vx t, y = vy t - g t^2 / 2; the mass has no influence
        wanted[:, 0, 1] = wanted[:, 1, 2] = times
        np.testing.assert_allclose(value[:, :2], wanted, atol=1e-11)
        self.assertLess(found.error("stone.pose").max(), 1e-10)

    def test_a_pendulum_agrees_with_smaller_differences(self):
        def end(inertia):
            m = pendulum().copy(arm={"inertia": inertia})
            return m.simulate([0, 1.0], "rk8", step=5e-3, record="pin.coordinate")["pin.coordinate"][-1, 0]

        h = 2e-5
        wanted = (8 * (end(0.02 + h) - end(0.02 - h)) - end(0.02 + 2 * h) + end(0.02 - 2 * h)) / (12 * h)
        found = baum.sensitivities(
            pendulum(), {"arm.inertia": 0.02}, [0, 1.0], "rk8", step=5e-3, record="pin.coordinate",
            reduce=lambda run: run["pin.coordinate"][-1, 0])  # fmt: skip
        self.assertEqual(found["value"].shape, (1,))
        self.assertAlmostEqual(found["value"][0] / wanted, 1.0, delta=1e-8)
        self.assertLess(abs(found["value"][0] - wanted), found.error("value")[0])

    def test_results_that_jump_are_told(self):
        with self.assertWarnsRegex(baum.UncertainSensitivityWarning, "value with respect to arm.mass"):
            baum.sensitivities(
                pendulum(), {"arm.inertia": 0.02, "arm.mass": 1.0}, [0, 3.0], "rk4", step=0.01,
                reduce=lambda run: np.round(run.q[-1], 4))  # fmt: skip

    def test_warnings_of_runs_are_repeated(self):
        with self.assertWarnsRegex(baum.GainsWarning, "of 4 runs"):
            baum.sensitivities(
                pendulum(), {"arm.mass": 1.0}, [0, 0.1], "euler", step=1e-3,
                gains=baum.fixed(0.0, 0.0), reduce=lambda run: run.q[-1])  # fmt: skip

    def test_wrong_calls_are_refused(self):
        given = {"times": [0, 0.1], "method": "rk4", "step": 0.01}
        with self.assertRaisesRegex(ValueError, "arm.angular_velocity: its step is 0, must be > 0"):
            baum.sensitivities(pendulum(), {"arm.angular_velocity": 0.0}, **given)
        with self.assertRaisesRegex(ValueError, "its step is -1"):
            baum.sensitivities(pendulum(), {"arm.mass": 1.0}, steps={"arm.mass": -1}, **given)
        with self.assertRaisesRegex(ValueError, "its step is nan"):
            baum.sensitivities(pendulum(), {"arm.mass": float("nan")}, **given)
        with self.assertRaisesRegex(baum.Error, "mass"):
            baum.sensitivities(pendulum(), {"arm.mass": -1.0}, **given)
        found = baum.sensitivities(
            pendulum(), {"arm.angular_velocity": 0.0}, steps={"arm.angular_velocity": 1e-3}, **given)
        with self.assertRaisesRegex(KeyError, "there are: "):
            found["nonsense"]
        with self.assertRaisesRegex(KeyError, "there are: "):
            found.error("nonsense")


if __name__ == "__main__":
    unittest.main()
