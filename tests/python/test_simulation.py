# SPDX-License-Identifier: BSD-3-Clause
"""Tests runs: options, samples, channels, counters, warnings, and single steps."""

import os
import subprocess
import sys
import unittest
import warnings

import numpy as np

import baum
from mechanisms import rod_pendulum, slider_crank

SUNDIALS = baum.has("sundials")


class Samples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.m = slider_crank(omega=150)
        cls.t = np.linspace(0, 0.01, 11)
        cls.run_ = cls.m.simulate(
            cls.t,
            "rk4",
            step=1e-4,
            record=[
                "B.phi",
                cls.m["A"].reaction,
                "motor.multipliers",
                "A.coordinate",
                "energy",
                "lambda",
                "phi_rate",
                baum.a,
                cls.m["rod"].pose_of((0.153, 0)),
                cls.m["rod"].velocity_of((0.153, 0)),
                cls.m["slider"].velocity,
                cls.m["rod"].acceleration_of((0.153, 0)),
                "slider.acceleration",
                "motor.effort",
            ],
        )

    def test_shapes_are_those_of_the_channels(self):
        r = self.run_
        self.assertEqual((r.t.shape, r.q.shape, r.v.shape), ((11,), (11, 9), (11, 9)))
        for key, columns in {
            "B.phi": 2,
            "A.reaction": 3,
            "motor.multipliers": 1,
            "A.coordinate": 2,
            "energy": 2,
            "lambda": 9,
            "phi_rate": 9,
            "a": 9,
            "rod.pose(0.153, 0.0)": 3,
            "slider.velocity": 3,
            "rod.acceleration(0.153, 0.0)": 3,
            "motor.effort": 1,
        }.items():
            with self.subTest(key):
                self.assertEqual(r[key].shape, (11, columns))
                self.assertTrue(np.isfinite(r[key]).all())

    def test_channels_are_found_by_themselves_and_by_name(self):
        r, m = self.run_, self.m
        np.testing.assert_array_equal(r[m["A"].reaction], r["A.reaction"])
        np.testing.assert_array_equal(r[baum.lambda_], r["lambda"])
        np.testing.assert_array_equal(r[baum.q], r.q)
        self.assertIn("B.phi", r.keys())

    def test_poses_and_velocities_need_no_recording(self):
        r = self.run_
        np.testing.assert_array_equal(r["slider.pose"], r.q[:, 6:9])
        np.testing.assert_array_equal(r["crank.velocity"], r.v[:, 0:3])

    def test_channels_are_consistent(self):
        r = self.run_
        np.testing.assert_allclose(
            r["A.coordinate"], np.stack([150 * self.t, 0 * self.t + 150], axis=1), atol=1e-9
        )
        np.testing.assert_allclose(r["slider.velocity"], r.v[:, 6:9])
        np.testing.assert_allclose(
            r["rod.pose(0.153, 0.0)"][:, :2], r["slider.pose"][:, :2], atol=1e-9
        )
        np.testing.assert_allclose(
            r[self.m["rod"].velocity_of((0.153, 0))][:, :2], r["slider.velocity"][:, :2], atol=1e-6
        )

    def test_accelerations_and_efforts_belong_to_the_other_channels(self):
        r = self.run_
        np.testing.assert_allclose(r["slider.acceleration"], r["a"][:, 6:9])
        # The same point belongs to both bodies. Its acceleration reaches 5e3 m/s^2, and the
        # rounding error is 1e-12 times this value.
        np.testing.assert_allclose(
            r["rod.acceleration(0.153, 0.0)"][:, :2], r["slider.acceleration"][:, :2], atol=1e-8
        )
        # The row of a driver is its coordinate minus the value of its law. The torque of the driver
        # is therefore -lambda.
        np.testing.assert_allclose(r["motor.effort"], -r["motor.multipliers"])

    def test_what_was_not_recorded_is_named(self):
        with self.assertRaisesRegex(KeyError, "'C.phi' was not recorded; there are q, v, B.phi"):
            self.run_["C.phi"]
        for key, message in (
            ("nobody.pose", "no 'nobody' in this mechanism"),
            ("B.pose", "no channel 'B.pose' of 'B'"),
            ("slider.pos", "no channel 'slider.pos' .* did you mean 'pose'"),
            ("energi", "no channel 'energi'; .* did you mean 'energy'"),
        ):
            with self.assertRaisesRegex(KeyError, message):
                self.run_[key]

    def test_unknown_channels_are_refused(self):
        for name in ("B.phy", "x.phi", "nothing"):
            with self.assertRaises(KeyError):
                self.m.simulate([0.001], "rk4", step=1e-4, record=[name])
        for name, text in (
            ("B.phy", "'B', which is a planar_revolute; there are: angle, .*mean 'phi'"),
            ("C.value", "'C', which is a planar_.*; there are: .*multipliers, phi, phi_rate, reac"),
            ("ground.pose", "'ground', which is a body; there are none"),
            ("B", "no channel 'B' of 'B', which is a planar_revolute; there are: angle"),
            ("enrgy", "there are: q, v, .*; did you mean 'energy'"),
        ):
            with self.assertRaisesRegex(KeyError, text):
                self.m.channel(name)
        open_ = self.m.thawed()  # before freezing, no channel of a joint is excluded
        self.assertEqual(open_.channel("A.effort").key, "A.effort")
        with self.assertRaisesRegex(TypeError, "not <planar_revolute 'B'>; it has angle"):
            self.m.channel(self.m["B"])
        with self.assertRaises(TypeError):
            self.m.simulate([0.001], "rk4", step=1e-4, record=[3])
        for names in (["B.coordinate", "motor.coordinate"], ["A.effort"]):
            with self.assertRaisesRegex(KeyError, "which is a .*; there are: .*phi_rate"):
                self.m.simulate([0.001], "rk4", step=1e-4, record=names)

    def test_counters_and_account_are_python_values(self):
        r = self.run_
        self.assertEqual(
            (r.status, r.counters.steps, r.counters.max_phi_joint.family),
            (baum.Status.OK, 100, "joint"),
        )
        self.assertIn("rk4", r.explain)
        self.assertEqual(r.warnings, [])
        self.assertEqual(repr(r), "<run of 11 samples, 100 steps, OK>")

    def test_times_may_be_one_number_and_must_be_numbers(self):
        self.assertEqual(self.m.simulate(0.001, "rk4", step=1e-4).t.tolist(), [0.001])
        with self.assertRaisesRegex(ValueError, "times: an array of one dimension"):
            self.m.simulate([[1, 2]], "rk4", step=1e-4)
        with self.assertRaisesRegex(TypeError, "times: numbers are wanted"):
            self.m.simulate(["soon"], "rk4", step=1e-4)
        with self.assertRaises(baum.Error):
            self.m.simulate([0, 0.002, 0.001], "rk4", step=1e-4)

    def test_runs_begin_at_start_time_and_go_backward(self):
        run = rod_pendulum().simulate([2.0, 1.99], "rk4", step=1e-4, start_time=2.0)
        self.assertEqual(run.t.tolist(), [2.0, 1.99])
        np.testing.assert_allclose(run["bob.velocity"][:, 1], [0, 0.0981], rtol=1e-6)


class Options(unittest.TestCase):
    def test_every_integrator_runs_by_name(self):
        m = rod_pendulum()
        for name, method in baum.integrators().items():
            with self.subTest(name):
                if name == "kinematics":
                    with self.assertRaisesRegex(baum.Error, "1 degree of freedom is left"):
                        m.simulate([0.1], name)
                    continue
                if not SUNDIALS and not method.fixed_step:
                    self.assertRaises(baum.Error, m.simulate, [0.1], name, rtol=1e-8)
                    continue
                options = dict(step=1e-4) if method.fixed_step else dict(rtol=1e-8)
                run = m.simulate([0.1], name, **options)
                self.assertAlmostEqual(run.q[0, 1], -0.5 * 9.81 * 0.01, 2)

    def test_every_formulation_runs_by_name(self):
        m = rod_pendulum()
        for method in baum.integrators().values():
            if not SUNDIALS and not method.fixed_step:
                continue
            options = dict(step=1e-3) if method.fixed_step else dict(rtol=1e-6)
            for formulation in method.formulations:
                with self.subTest(f"{method.name} {formulation}"), warnings.catch_warnings():
                    warnings.simplefilter("ignore", baum.Warning)
                    run = m.simulate([0.1], method.name, formulation=formulation, **options)
                    self.assertIn(formulation, run.explain)

    def test_kinematics_needs_output_times_alone(self):
        m = slider_crank(omega=150)
        t = np.linspace(0, 0.4, 30)
        run = m.simulate(t, "kinematics")
        x = 0.153 * np.cos(150 * t) + np.sqrt(0.306**2 - (0.05 - 0.153 * np.sin(150 * t)) ** 2)
        np.testing.assert_allclose(run["slider.pose"][:, 0], x, rtol=0, atol=1e-12)
        self.assertIn("kinematics", run.explain)
        with self.assertRaisesRegex(baum.Error, "rtol is 1e-06, but kinematics solves"):
            m.simulate(t, "kinematics", rtol=1e-6)

    def test_words_that_mean_nothing_are_refused_with_the_list(self):
        m = rod_pendulum()
        for fields, words in (
            (
                dict(integrator="eulr"),
                "no integrator 'eulr'; there are: euler, semi_implicit_euler",
            ),
            (
                dict(formulation="x"),
                "no formulation 'x'; there are: default, unstabilized, baumgarte",
            ),
            (dict(start="x"), "no start 'x'; there are: assemble, exact, as_given"),
            (dict(solver="x"), "no solver 'x'; there are: auto, klu, qr"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                m.simulate([1.0], **{"integrator": "euler", "step": 1e-3, **fields})
        for fields, words in (
            (dict(steps=1), "no option 'steps'; there are: integrator, progress, formulation"),
            (dict(gains=5), r"gains: something like baum.fixed\(5, 5\) is wanted, not 5"),
            (dict(step="small"), "step: a number is wanted, not 'small'"),
            (dict(integrator=3), "integrator: a name is wanted, not 3"),
            (dict(record=None), "a channel or its name is wanted, not None"),
            (dict(record=m["bob"]), "a channel or its name is wanted, not <.*; it has acceleration"),
        ):
            with self.assertRaisesRegex(TypeError, words):
                m.simulate([1.0], **{"integrator": "euler", "step": 1e-3, **fields})

    def test_what_the_library_refuses_keeps_its_status(self):
        m = rod_pendulum()
        for fields, status in (
            (dict(), "ERR_ARGUMENT"),
            (dict(integrator="euler", rtol=1e-6), "ERR_ARGUMENT"),
            (dict(integrator="euler", step=1e-3, rtol=1e-6), "ERR_ARGUMENT"),
            (dict(integrator="euler", step=-1), "ERR_ARGUMENT"),
            (dict(integrator="euler", step=1e-3, formulation="index3"), "ERR_UNSUPPORTED"),
            (
                dict(integrator="semi_implicit_euler", step=1e-3, gains=baum.taylor()),
                "ERR_UNSTABLE",
            ),
        ):
            with self.assertRaises(baum.Error) as caught:
                m.simulate([1.0], **fields)
            self.assertEqual(str(caught.exception.status), status)
            self.assertTrue(str(caught.exception))
            self.assertIsNone(caught.exception.run)

    def test_unstable_gains_run_when_allowed(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", baum.Warning)
            run = rod_pendulum().simulate(
                [0.005], "semi_implicit_euler", step=1e-3, gains=baum.taylor(), allow_unstable=True
            )
        self.assertEqual(run.counters.alpha, 1e3)

    def test_a_mechanism_must_be_frozen(self):
        m = baum.Mechanism()
        m.planar_particle("bob")
        with self.assertRaises(baum.Error) as caught:
            m.simulate([1.0], "rk4", step=1e-3)
        self.assertEqual(caught.exception.status, baum.Status.ERR_STATE)


class Warned(unittest.TestCase):
    def marginal(self):
        return rod_pendulum().simulation("euler", step=1e-3, gains=baum.taylor())

    def test_warnings_of_a_run_are_python_warnings_at_the_callers_line(self):
        with self.assertWarnsRegex(baum.Warning, "marginal") as caught:
            run = rod_pendulum().simulate([0.01], "euler", step=1e-3, gains=baum.taylor())
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(run.status, baum.Status.WARNED)
        # The message ends with the heading of the entry in docs/cookbook/warnings.md.
        self.assertRegex(str(run.warnings[0]), r"marginal.* \[warning 2 gains\]$")
        self.assertIsInstance(run.warnings[0], baum.GainsWarning)
        self.assertFalse(run.warnings[0].doubts_motion)

    def test_each_comes_once(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            s = self.marginal()
            s.step(3)
            s.advance_to(0.01)
        self.assertEqual(len(caught), len(s.warnings))

    def test_a_second_integration_that_fails_is_reported(self):
        """The force is defined only at the times of rk4, not at those of the second integration."""

        def force(t, q, v):
            if abs(20 * t - round(20 * t)) > 1e-6:
                raise baum.Retry
            return 0, 0, 0

        m = baum.Mechanism()
        m.planar_body("rod", mass=1, inertia=0.1, position=(0.5, 0))
        m.revolute("pin", "ground", "rod", point=(0, 0))
        m.force("never", "rod", force)
        m.freeze()
        for requested in (False, True):
            with self.assertWarnsRegex(baum.ErrorUnknownWarning, "estimates it has failed"):
                run = m.simulate([1.0], "rk4", step=0.1, error_check=requested)
            self.assertTrue(np.isnan(run.counters.error_estimate))

    def test_they_can_be_made_errors(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", baum.Warning)
            self.assertRaises(baum.Warning, self.marginal)


class StepByStep(unittest.TestCase):
    def test_steps_are_the_same_as_advancing(self):
        m = slider_crank()
        one, two, three = (m.simulation("rk4", step=1e-4) for _ in range(3))
        self.assertEqual(one.advance_to(0.01), baum.Status.OK)
        for _ in range(20):
            self.assertEqual(two.step(5), baum.Status.OK)
        three.step(100)
        np.testing.assert_array_equal(two.q, three.q)
        np.testing.assert_allclose(one.q, two.q, atol=1e-13)
        self.assertAlmostEqual(two.time, 0.01, 12)
        self.assertEqual(two.counters.steps, 100)

    def test_arrays_are_copies(self):
        s = rod_pendulum().simulation("rk4", step=1e-3)
        q, v = s.q, s.v
        s.step(100)
        self.assertEqual(q.tolist(), [1, 0])
        self.assertNotEqual(s.v.tolist(), v.tolist())

    def test_get_gives_one_array_or_several(self):
        m = slider_crank(omega=150)
        s = m.simulation("rk4", step=1e-4)
        s.advance_to(0.01)
        np.testing.assert_allclose(s.get(m["A"].coordinate), [1.5, 150], rtol=1e-9)
        pose, energy = s.get("slider.pose", baum.energy)
        self.assertEqual((pose.shape, energy.shape), ((3,), (2,)))
        np.testing.assert_array_equal(pose, s.q[6:9])
        np.testing.assert_array_equal(*s.get("slider.pose", "slider.pose"))

    def test_the_state_can_be_set(self):
        s = rod_pendulum().simulation("rk4", step=1e-3)
        s.set_state(2.0, (0, -1), (1, 0))
        self.assertEqual((s.time, s.q.tolist(), s.v.tolist()), (2.0, [0, -1], [1, 0]))
        s.set_state(0.0, (0, -1))
        self.assertEqual(s.v.tolist(), [0, 0])
        with self.assertRaisesRegex(ValueError, "q: 2 numbers are wanted, not 3"):
            s.set_state(0.0, (0, 0, 1))
        with self.assertRaises(baum.Error):
            s.set_state(0.0, (0, float("nan")))
        self.assertEqual(s.q.tolist(), [0, -1])

    def test_saved_runs_go_on_alike_in_another_process(self):
        method = "cvode_adams" if SUNDIALS else "rk8"
        program = (
            "import sys, mechanisms\n"
            f"run = mechanisms.slider_crank(omega=20).simulation('{method}', rtol=1e-8)\n"
            "run.restore(sys.stdin.buffer.read())\n"
            "run.advance_to(0.3)\n"
            "sys.stdout.write(' '.join(x.hex() for x in (*run.q, *run.v)))\n"
        )
        run = slider_crank(omega=20).simulation(method, rtol=1e-8)
        run.advance_to(0.1)
        saved = run.save()
        self.assertIsInstance(saved, bytes)
        run.advance_to(0.3)
        other = subprocess.run(
            [sys.executable, "-c", program],
            input=saved,
            stdout=subprocess.PIPE,
            cwd=os.path.dirname(__file__),
            check=True,
        )
        self.assertEqual(
            other.stdout.decode(), " ".join(float(x).hex() for x in (*run.q, *run.v))
        )
        run.restore(bytearray(saved))
        self.assertEqual(run.time, 0.1)

    def test_another_method_goes_on(self):
        mechanism = slider_crank(omega=20)
        run = mechanism.simulation("euler", step=1e-3)
        run.advance_to(0.1)
        other = mechanism.simulation("rk8", rtol=1e-8)
        other.continue_from(run)
        self.assertEqual(other.time, run.time)
        # projection removes the violation that Euler's method has caused
        np.testing.assert_allclose(other.q, run.q, atol=1e-2)

    def test_a_run_may_continue_from_itself(self):
        run = slider_crank(omega=20).simulation("rk4", step=1e-3)
        run.advance_to(0.01)
        q = run.q.copy()
        run.continue_from(run)
        np.testing.assert_allclose(run.q, q, rtol=0, atol=1e-12)
        self.assertEqual(run.time, 0.01)

    def test_a_run_in_the_middle_of_a_call_is_not_continued(self):
        m, found = baum.Mechanism(), []
        bob = m.planar_particle("bob", mass=1)

        def force(t, q, v):
            if t > 0.05 and not found:
                found.append(None)
                with self.assertRaisesRegex(baum.Error, "in use by another call"):
                    other.continue_from(run)
                found.append(other.time)
            return 0, 0

        m.force("none", bob, force)
        m.freeze()
        found.append("the checks at the start of a run call the force, too")
        run, other = (m.simulation("rk4", step=1e-2) for _ in range(2))
        found.clear()
        run.advance_to(0.1)
        self.assertEqual(found, [None, 0.0])

    def test_bytes_of_something_else_are_refused(self):
        run = slider_crank(omega=20).simulation("rk4", step=1e-3)
        saved = run.save()
        for wrong in (b"", b"abc" * 99, saved[:-1], slider_crank().simulation("rk4", step=1e-3).save()):
            with self.assertRaises(baum.Error) as caught:
                run.restore(wrong)
            self.assertEqual(caught.exception.status, baum.Status.ERR_BUFFER)
            self.assertIn("the buffer", str(caught.exception))
        with self.assertRaises(TypeError):
            run.restore("text")

    def test_sampling_goes_on_where_the_run_stands(self):
        s = rod_pendulum().simulation("rk4", step=1e-3)
        first, second = s.sample([0, 0.1]), s.sample([0.1, 0.2], record=["rod.reaction"])
        np.testing.assert_array_equal(first.q[1], second.q[0])
        self.assertEqual(second["rod.reaction"].shape, (2, 3))

    def test_multipliers_that_are_not_unique_are_marked(self):
        m = baum.Mechanism()
        m.planar_particle("bob", mass=1.0, position=(1, 0))
        m.planar_particle("tail", mass=1.0, position=(2, 0))
        for name, a, b in [("rod", "ground", "bob"), ("again", "ground", "bob"), ("end", "bob", "tail")]:
            m.distance(name, a, b, point_a=(0, 0), point_b=(0, 0))
        with warnings.catch_warnings(record=True):
            s = m.freeze().simulation("rk4", step=1e-3)
        self.assertEqual(s.unique_multipliers.tolist(), [False, False, True])

    def test_bad_counts_are_refused(self):
        s = rod_pendulum().simulation("rk4", step=1e-3)
        self.assertRaises(TypeError, s.step, 1.5)
        self.assertRaises(baum.Error, s.step, 0)
        self.assertRaises(baum.Error, s.advance_to, float("nan"))

    def test_a_failed_sampling_keeps_what_it_has(self):
        armed = []

        def force(t, q, v):
            if armed and t > 0.055:
                raise baum.Retry
            return -q

        m = baum.Mechanism()
        m.coordinates("x", 1, mass=lambda t, q: 1.0, force=force, q=[1.0])
        s = m.freeze().simulation("euler", step=1e-2)
        armed.append(True)
        with self.assertRaises(baum.Error) as caught:
            s.sample(np.linspace(0, 0.1, 11))
        kept = caught.exception.run
        self.assertEqual(kept.status, baum.Status.ERR_CALLBACK)
        np.testing.assert_allclose(kept.t, np.linspace(0, kept.t[-1], len(kept.t)))
        self.assertGreaterEqual(len(kept.t), 5)
        self.assertEqual(kept["x.pose"].shape, (len(kept.t), 1))
        self.assertIn("x", s.message)


if __name__ == "__main__":
    unittest.main()
