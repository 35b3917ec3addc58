# SPDX-License-Identifier: BSD-3-Clause
"""Tests derivatives of results with respect to parameters, and the warnings about their errors."""

import time
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
        raised = warnings.catch_warnings()
        raised.__enter__()
        self.addCleanup(raised.__exit__, None, None, None)
        warnings.simplefilter("error")

    def test_a_free_fall_has_the_derivatives_of_its_formula(self):
        times = [0.0, 0.5, 2.0]
        found = baum.sensitivities(
            falling(), {"stone.mass": 2.0, "stone.velocity": [3.0, 0.0]}, times, "rk4", step=0.1,
            record="stone.pose")  # fmt: skip
        self.assertEqual(
            found.parameters, ("stone.mass", "stone.velocity[0]", "stone.velocity[1]"))
        value = found["stone.pose"]
        self.assertEqual(value.shape, (3, 2, 3))
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

    def uncertain(self, reduce, **options):
        given = {"times": [0, 3.0], "method": "rk4", "step": 0.01, **options}
        pattern = "the derivative of value with respect to arm.inertia is uncertain"
        with self.assertWarnsRegex(baum.UncertainSensitivityWarning, pattern):
            return baum.sensitivities(pendulum(), {"arm.inertia": 0.02}, reduce=reduce, **given)

    def test_results_that_jump_cause_a_warning(self):
        def jump(run):
            return np.round(run.q[-1, 0], 4)

        self.uncertain(jump)
        self.uncertain(lambda run: [float("nan"), jump(run)])
        self.uncertain(lambda run: [1e5, jump(run)])
        self.uncertain(lambda run: [[jump(run)], [jump(run)]])
        self.uncertain(lambda run: float("nan"))

    def test_named_results_and_vectors_of_steps(self):
        found = baum.sensitivities(
            falling(), {"stone.velocity": [3.0, 2.0]}, [0.0, 1.0], "rk4", step=0.1,
            steps={"stone.velocity": [0.1, 0.2]},
            reduce=lambda run: {"x": run.q[-1, 0], "all": run.q})  # fmt: skip
        self.assertEqual(found.keys(), ["x", "all"])
        np.testing.assert_allclose(found["x"], [1, 0], atol=1e-12)
        self.assertEqual(found["all"].shape, (2, 2, 2))
        with self.assertRaisesRegex(ValueError, "different names"):
            baum.sensitivities(
                falling(), {"stone.mass": 2.0}, [0.0, 1.0], "rk4", step=0.1,
                reduce=lambda run: {str(time.perf_counter()): 1.0})  # fmt: skip

    def test_an_influence_of_rounding_is_no_reason_to_warn(self):
        found = baum.sensitivities(
            pendulum(), {"arm.mass": 1.0}, [0, 3.0], "rk4", step=0.01,
            reduce=lambda run: 100 + 1e-14 * run.q[-1])  # fmt: skip
        self.assertLess(np.abs(found["value"]).max(), 1e-9)

    def test_warnings_of_runs_are_repeated(self):
        with self.assertWarnsRegex(baum.GainsWarning, "GainsWarning in 4 of 4 runs"):
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
        with self.assertRaisesRegex(ValueError, "is 1e-19, which is below 1e-08 of 1"):
            baum.sensitivities(pendulum(), {"arm.mass": 1.0}, steps={"arm.mass": 1e-19}, **given)
        with self.assertRaisesRegex(baum.Error, "the run with arm.mass = -0.999: .*mass"):
            baum.sensitivities(pendulum(), {"arm.mass": -1.0}, **given)
        with self.assertRaisesRegex(KeyError, "'arm.mas' is not one of the parameters"):
            baum.sensitivities(pendulum(), {"arm.mass": 1.0}, steps={"arm.mas": 1.0}, **given)
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'samples'"):
            baum.sensitivities(pendulum(), {"arm.mass": 1.0}, samples="grid", **given)
        with self.assertRaisesRegex(ValueError, "no parameters"):
            baum.sensitivities(pendulum(), {}, **given)
        found = baum.sensitivities(
            pendulum(), {"arm.angular_velocity": 0.0}, steps={"arm.angular_velocity": 1e-3}, **given)
        with self.assertRaisesRegex(KeyError, "there are: "):
            found["nonsense"]
        with self.assertRaisesRegex(KeyError, "there are: "):
            found.error("nonsense")


if __name__ == "__main__":
    unittest.main()
