# SPDX-License-Identifier: BSD-3-Clause
"""Tests studies: entries, the reference, recommendations as keywords, and mechanisms with Python
functions."""

import os
import tempfile
import threading
import unittest
import warnings

import numpy as np

import baum
from mechanisms import circle, pendulum, rod_pendulum, slider_crank


def small(mechanism, **options):
    """Return a study that uses only RK8."""
    made = baum.study(mechanism, 0, 1, samples=20, repeats=1, **options)
    return made.add_standard("rk8", settings=5)


class Studies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.m = slider_crank()
        cls.study = small(cls.m).run()

    def test_entries_have_names_errors_and_costs(self):
        entries = self.study.entries
        self.assertEqual(len(entries), len(self.study))
        done = [entry for entry in entries if entry.state == "done"]
        self.assertGreater(len(done), len(entries) // 2)
        for entry in done:
            self.assertEqual(entry.integrator, "rk8")
            self.assertIn(entry.formulation, entry.name)
            self.assertTrue(entry.error >= self.study.reference.uncertainty)
            self.assertTrue(entry.work > 0 and entry.cpu > 0)

    def test_the_reference_tells_its_digits(self):
        self.assertTrue(self.study.reference.trusted)
        self.assertGreater(self.study.reference.digits, 10)
        self.assertEqual(self.study.reference.origin, "own")
        self.assertIn("agree to", self.study.reference.text)

    def test_a_recommendation_is_ready_to_run_and_keeps_its_error(self):
        t = np.linspace(0, 1, 21)
        exact = self.m.simulate(t, "rk8", rtol=1e-13, formulation="projection").q
        for error in (1e-3, 1e-6, 1e-9):
            best = self.study.recommend(error)
            self.assertIn("rk8", best.why)
            run = self.m.simulate(t, **best)
            # The error of the study is relative to the characteristic length, 0.46 m. In metres it
            # is therefore smaller.
            self.assertLess(np.abs(run.q - exact).max(), error)

    def test_the_reference_sees_a_force_that_acts_for_a_short_time(self):
        # A body at rest is pushed at 1.3 s: v = 20 N * 5 ms * sqrt(pi) / 1 kg. Steps without a limit
        # would grow so long at rest that they miss the force.
        m = baum.Mechanism(gravity=(0, 0))
        bob = m.planar_particle("bob", mass=1)
        m.force("push", bob, lambda t, q, v: (20 * np.exp(-(((t - 1.3) / 5e-3) ** 2)), 0))
        study = baum.study(m.freeze(), 0, 2, samples=20, repeats=1, validate=False, progress=False)
        study.add("rk4", step=1e-3).run()
        self.assertAlmostEqual(study.reference_samples().v[-1, 0], 0.1 * np.sqrt(np.pi), 9)
        self.assertLess(study.entries[0].error, 1e-3)

    def test_texts_of_an_unfinished_study_name_what_is_missing(self):
        study = small(self.m)
        self.assertIn("no entry is finished; call run()", study.report())
        m = baum.Mechanism(gravity=(0, -9.81))
        for name, x in (("upper", 0.5), ("lower", 1.5)):
            m.planar_body(name, mass=1, inertia=0.1, position=(x, 0))
        m.revolute("A", "ground", "upper", point=(0, 0))
        m.revolute("B", "upper", "lower", point=(1, 0))
        chaotic = baum.study(m.freeze(), 0, 60, samples=20, repeats=1, validate=False)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            chaotic.add("rk4", step=0.05).add("kinematics").run()
        self.assertIn("reference  0 digits, NOT TRUSTED", chaotic.report())
        self.assertRegex(chaotic.reference.text, r"differ by .*; not trusted: .* shorter span")
        with self.assertRaisesRegex(baum.Error, "no entry can be judged without a trusted reference: rk8"):
            chaotic.recommend(1e-3)
        self.assertNotIn("baum_", study.report() + chaotic.report())

    def test_stress_settings_are_entries_that_work_or_say_why(self):
        study = baum.study(self.m, 0, 1, samples=20, repeats=1, entry_limit=0.02, validate=False)
        entries = study.add_stress("rk4").run().entries
        self.assertEqual(len(entries), 9 + 20)
        for entry in entries:
            self.assertTrue(entry.state == "done" or entry.message, entry.name)

    def test_the_front_goes_from_cheap_to_exact(self):
        entries = self.study.entries
        front = [entries[k] for k in self.study.front()]
        self.assertGreater(len(front), 2)
        for a, b in zip(front, front[1:]):
            self.assertTrue(a.work < b.work and a.error > b.error)

    def test_a_budget_is_kept(self):
        best = self.study.recommend_budget(10.0)
        self.assertEqual(best["integrator"], "rk8")
        with self.assertRaises(baum.Error) as caught:
            self.study.recommend_budget(1e-9)
        self.assertIn("the fastest takes", str(caught.exception))

    def test_methods_have_a_price_and_can_be_compared(self):
        methods = self.study.methods
        known = [k for k, method in enumerate(methods) if method.work_per_digit > 1]
        self.assertGreater(len(known), 2)
        a, b = known[:2]
        error = 10 * max(methods[a].least_error, methods[b].least_error)
        ratio = self.study.compare(a, b, error)
        self.assertAlmostEqual(ratio * self.study.compare(b, a, error), 1)

    def test_what_cannot_be_reached_is_refused(self):
        with self.assertRaises(baum.Error) as caught:
            self.study.recommend(1e-30)
        self.assertIn("the smallest is", str(caught.exception))
        with self.assertRaises(ValueError):
            self.study.recommend(1e-3, cost="euro")


class Meaning(unittest.TestCase):
    def test_error_is_what_the_user_says(self):
        m = slider_crank()
        study = baum.study(m, 0, 0.5, error=["slider.pose"], unit=1e-3, samples=20, repeats=1)
        study.add("rk4", step=1e-2).run()
        entry = study.entries[0]
        # entry.error is the error of the slider, in millimetres and milliradians. entry.error_q is
        # the scaled error of all bodies.
        self.assertLess(entry.error, 1e3 * entry.error_q * max(m.characteristic_length, 1) * 1.001)
        self.assertNotAlmostEqual(entry.error, entry.error_q)

    def test_a_solution_by_formulas_is_a_reference(self):
        m = baum.Mechanism(gravity=(0, 0))
        m.planar_particle("bob", position=(1, 0), velocity=(0, 1))
        m.distance("rod", "ground", "bob", point_a=(0, 0), point_b=(0, 0))
        m.freeze()

        def turn(t):
            return (np.cos(t), np.sin(t)), (-np.sin(t), np.cos(t))

        study = baum.study(m, 0, 3, solution=turn, digits=12, repeats=1)
        study.add("rk8", rtol=1e-13).run()
        self.assertEqual(study.entries[0].error, 1e-12)
        self.assertTrue(study.entries[0].at_floor)
        t = np.array([1.0, 3.0])
        q = np.column_stack([np.cos(t), np.sin(t)])
        given = baum.study(m, 0, 3, reference=(t, q), digits=9, repeats=1)
        given.add("rk8", rtol=1e-13).run()
        self.assertEqual(given.entries[0].error, 1e-9)
        self.assertTrue(np.isnan(given.entries[0].error_v))

    def test_exceptions_in_a_solution_are_raised(self):
        def broken(t):
            raise KeyError("gone")

        study = baum.study(rod_pendulum(), 0, 1, solution=broken, digits=9)
        study.add("rk4", step=0.01)
        with self.assertRaises(KeyError):
            study.run()


class Running(unittest.TestCase):
    def test_a_mechanism_of_python_functions_is_studied(self):
        m = pendulum(circle)
        for threads in (1, 2):
            study = baum.study(m, 0, 0.3, samples=5, repeats=1, threads=threads)
            study.add("rk4", step=0.03).add("rk4", step=0.01)
            study.add("rk8", rtol=1e-4).add("rk8", rtol=1e-8).run()
            self.assertTrue(all(entry.state == "done" for entry in study.entries))
            # the second derivatives are computed by differences
            self.assertGreater(study.reference.digits, 7)
            best = study.recommend(1e-3)
            m.simulate([0.3], **best)

    def test_progress_is_called_and_can_cancel(self):
        seen = []

        def stop(done, total):
            seen.append((done, total))
            return done == 3

        study = small(rod_pendulum(), progress=stop, threads=1)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            study.run()
        self.assertEqual(seen, [(k, 2 * len(study)) for k in (1, 2, 3)])
        self.assertIn("cancelled", str(caught[0].message))
        self.assertEqual(sum(entry.state == "waiting" for entry in study.entries), len(study) - 3)
        study.run()
        self.assertFalse(any(entry.state == "waiting" for entry in study.entries))

    def test_exceptions_in_progress_are_raised(self):
        def broken(done, total):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            small(rod_pendulum(), progress=broken).run()

    def test_the_warning_tells_what_a_function_of_the_mechanism_raised(self):
        def broken(t, q):
            if t > 0.1:
                raise NameError("lenght")
            return circle(t, q)

        study = baum.study(pendulum(broken), 0, 0.3, samples=5, repeats=1)
        study.add("rk4", step=0.03)
        with self.assertWarnsRegex(baum.Warning, "returned -1.*NameError.*lenght"):
            study.run()
        self.assertEqual(study.entries[0].state, "failed")
        self.assertRegex(study.entries[0].message, r"returned -1 \(stop\): NameError\('lenght'\)")

    def test_a_recommendation_without_stabilization_says_what_that_means(self):
        whys = []
        for formulation in ("unstabilized", "projection"):
            study = baum.study(rod_pendulum(), 0, 1, samples=5, repeats=1)
            study.add("rk4", formulation=formulation, step=0.01).run()
            whys.append(study.recommend(1e-2).why)
        self.assertIn("violation grows with the span", whys[0])
        self.assertNotIn("violation grows", whys[1])

    def test_tolerances_of_the_grid_end_where_differences_do(self):
        for mechanism, least in ((rod_pendulum(), 1e-13), (pendulum(circle), 1e-11)):
            study = baum.study(mechanism, 0, 1).add_standard("rk8", settings=3)
            found = min(entry.rtol for entry in study.entries if entry.rtol == entry.rtol)
            self.assertAlmostEqual(found / least, 1)

    def test_entries_hold_the_gains_in_use(self):
        study = baum.study(pendulum(circle), 0, 0.3, samples=5, repeats=1)
        for gains in (baum.auto(), baum.fixed(3, 4)):
            study.add("rk4", formulation="baumgarte", gains=gains, step=0.01)
        auto, fixed, none = study.add("rk4", formulation="projection", step=0.01).run().entries
        self.assertTrue(0 < auto.alpha * 0.01 < 1 and auto.alpha == auto.beta)
        self.assertEqual((fixed.alpha, fixed.beta, none.alpha, none.beta), (3, 4, 0, 0))

    def test_a_reference_goes_with_its_digits(self):
        m = rod_pendulum()
        known = ([0.5, 1.0], [[1.0, 0.0], [0.0, -1.0]])
        for options in ({"reference": known}, {"solution": lambda t: None}, {"digits": 9}):
            with self.assertRaisesRegex(TypeError, "together with digits"):
                baum.study(m, 0, 1, **options)
        with self.assertRaisesRegex(baum.Error, "file is empty"):
            baum.study(m, 0, 1, file="")

    def test_a_study_goes_on_from_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.study")
            first = small(rod_pendulum(), file=path).run()
            seen = []
            again = small(rod_pendulum(), file=path, progress=lambda *now: seen.append(now)).run()
            self.assertEqual(seen[0][0], len(first) + 1)
            for a, b in zip(first.entries, again.entries):
                self.assertEqual((a.name, a.state), (b.name, b.state))
                np.testing.assert_array_equal([a.error, a.cpu], [b.error, b.cpu])

    def test_a_file_of_another_motion_is_refused(self):
        def made(velocity=1.0, held=False, initial=0.0, driven=0):
            m = baum.Mechanism()
            m.planar_particle("free", velocity=(velocity, 0), held=held)
            m.load("jet", "free", force=(1, 0), input=m.input("u", initial))
            body = m.planar_body("a")
            slots = [m.pin_in_slot(None, "ground", body, point=(x, 0)) for x in (0, 1)]
            m.driver("push", slots[driven], rate=1)
            return m.freeze()

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.study")
            small(made(), file=path).run()
            for change in {"velocity": 2.0}, {"held": True}, {"initial": 1.0}:
                with self.assertRaisesRegex(baum.Error, "initial positions, velocities, inputs or held"):
                    small(made(**change), file=path).run()
            with self.assertRaisesRegex(baum.Error, "the numbers of the mechanism differ"):
                small(made(driven=1), file=path).run()

    def test_row_gains_come_back_as_keywords(self):
        m = slider_crank()
        study = baum.study(m, 0, 0.2, samples=10, repeats=1, validate=False)
        study.add("rk4", formulation="baumgarte", gains=baum.fixed(20, 20), step=1e-3,
                  row_gains={"B": 2.0}).run()
        best = study.recommend(1e-2)
        self.assertEqual(best["gains"], baum.fixed(20, 20))
        np.testing.assert_array_equal(best["row_gains"]["B"], [2, 2])
        m.simulate([0.2], **best)

    def test_a_study_is_run_by_one_thread_at_a_time(self):
        begun, go_on = threading.Event(), threading.Event()
        other = small(rod_pendulum(), threads=1,
                      progress=lambda *now: (begun.set(), go_on.wait(10), False)[2])
        worker = threading.Thread(target=other.run)
        worker.start()
        self.assertTrue(begun.wait(10))
        with self.assertRaises(baum.Error) as caught:
            other.run()
        self.assertEqual(caught.exception.status, baum.Status.ERR_STATE)
        go_on.set()
        worker.join()


if __name__ == "__main__":
    unittest.main()
