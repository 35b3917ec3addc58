# SPDX-License-Identifier: BSD-3-Clause
"""Tests sweeps: samples of parameters, executors, failures, cancelling and continuing."""

import concurrent.futures
import os
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np

import baum
from test_scenes import pendulum

TIMES = np.linspace(0, 0.2, 5)
METHOD = {"method": "rk8", "rtol": 1e-8}


def crank():
    m = baum.Mechanism()
    m.planar_body("crank", mass=1, inertia=0.1, position=(0.1, 0))
    m.revolute("A", "ground", "crank", point=(0, 0))
    return m


def last_angle(run):
    return run["crank.pose"][-1, 2]


class Serial:
    """An executor whose only method is map()."""

    def map(self, function, *lists):
        return map(function, *lists)


class Fixed:
    """A sampler whose points lie on a line, at equal distances."""

    def random(self, count):
        return np.linspace(0, 1, 2 * count).reshape(count, 2)


class SweepTest(unittest.TestCase):
    def test_each_run_equals_the_run_alone(self):
        m = crank()
        masses = np.linspace(1, 2, 20)
        swept = baum.sweep(m, {"crank.mass": masses}, TIMES, **METHOD, record="energy")
        self.assertEqual(len(swept), 20)
        self.assertEqual(swept["q"].shape, (20, 5, 3))
        for k, mass in enumerate(masses):
            alone = m.copy(crank=dict(mass=mass)).freeze().simulate(
                TIMES, "rk8", rtol=1e-8, record="energy"
            )
            np.testing.assert_array_equal(swept["q"][k], alone.q)
            np.testing.assert_array_equal(swept["energy"][k], alone["energy"])

    def test_all_executors_give_the_same_bits(self):
        parameters = {"crank.mass": np.linspace(1, 2, 40)}
        given = dict(METHOD, reduce=last_angle)
        found = [baum.sweep(crank(), parameters, TIMES, **given)["value"]]
        found.append(baum.sweep(crank(), parameters, TIMES, **given, executor=Serial())["value"])
        with concurrent.futures.ProcessPoolExecutor(2) as executor:
            found.append(
                baum.sweep(crank(), parameters, TIMES, **given, executor=executor)["value"]
            )
        for values in found:
            np.testing.assert_array_equal(values, found[0])
        self.assertEqual(len(np.unique(found[0])), 40)

    def test_a_mechanism_with_python_functions_goes_to_other_processes(self):
        with concurrent.futures.ProcessPoolExecutor(1) as executor:
            swept = baum.sweep(
                pendulum(), {"throttle.initial": [0.0, 1.0]}, TIMES, **METHOD, executor=executor
            )
        self.assertEqual(swept.messages, {})
        self.assertGreater(np.abs(swept["q"][0] - swept["q"][1]).max(), 1e-3)

    def test_a_grid_has_all_combinations(self):
        swept = baum.sweep(
            crank(),
            {"crank.mass": [1, 2, 3], "A.point": [(0, 0), (0, 0.1)]},
            TIMES,
            **METHOD,
            samples="grid",
        )
        self.assertEqual(swept.parameters["crank.mass"].tolist(), [1, 1, 2, 2, 3, 3])
        self.assertEqual(swept.parameters["A.point"].shape, (6, 2))

    def test_a_sampler_draws_between_bounds(self):
        bounds = {"crank.mass": (1, 2), "crank.inertia": (0.1, 0.3)}
        swept = baum.sweep(crank(), bounds, TIMES, **METHOD, samples=Fixed(), count=3)
        np.testing.assert_allclose(swept.parameters["crank.mass"], [1.0, 1.4, 1.8])
        np.testing.assert_allclose(swept.parameters["crank.inertia"], [0.14, 0.22, 0.3])

    def test_failed_runs_are_nan_with_their_message(self):
        swept = baum.sweep(crank(), {"crank.mass": [-1, 1, 2]}, TIMES, **METHOD)
        self.assertEqual(list(swept.messages), [0])
        self.assertIn("mass is -1 kg", swept.messages[0])
        self.assertEqual(swept.status[0], baum.Status.ERR_ARGUMENT)
        self.assertTrue(np.isnan(swept["q"][0]).all())
        self.assertTrue(np.isfinite(swept["q"][1:]).all())

    def test_the_file_of_another_sweep_is_refused(self):
        m = baum.Mechanism()
        m.planar_body("rod", position=(0.5, 0))
        pin = m.revolute("pin", "ground", "rod", point=(0, 0))
        m.load("motor", "rod", torque=1)
        m.force("drag", "rod", lambda t, q, v: -0.1 * v)
        stiffer = m.copy()
        stiffer["drag"].set(force=lambda t, q, v: -0.2 * v)
        places = np.array([[0.5, 0.0], [0.5, 0.1]])
        usual = dict(integrator="rk4", step=0.1, executor=Serial(), record=[pin.angle],
                     formulation="baumgarte", gains=baum.fixed(1, 1))
        changes = [
            dict(reduce=lambda run: run["rod.pose"].min()),
            dict(reduce=lambda run: run["rod.pose"].max()),
            dict(reduce=lambda run: run["rod.pose"][0].max()),
            dict(record=["pin.phi"]),
            dict(gains=baum.fixed(1 + 1e-9, 1)),
            dict(row_gains={"pin": [1, 1 + 1e-12]}),
            dict(mechanism=stiffer),
            dict(places=places + 4e-9),
        ]
        with tempfile.TemporaryDirectory() as folder:
            def run(mechanism=m, places=places, integrator="rk4", **given):
                return baum.sweep(mechanism, {"rod.position": places}, [0, 0.1], integrator,
                                  file=Path(folder) / "sweep.pickle", **given)

            first = run(**usual)
            np.testing.assert_array_equal(run(**dict(usual, record="pin.angle"))["pin.angle"],
                                          first["pin.angle"])
            for other in changes:
                with self.assertRaisesRegex(ValueError, "is of another sweep"):
                    run(**dict(usual, **other))
            (Path(folder) / "sweep.pickle").unlink()
            run(**dict(usual, **changes[0]))
            for other in changes[1:3]:
                with self.assertRaisesRegex(ValueError, "is of another sweep"):
                    run(**dict(usual, **other))

    def test_a_cancelled_sweep_continues_from_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "sweep.pickle"
            parameters = {"crank.mass": np.linspace(1, 2, 30)}
            given = dict(METHOD, reduce=last_angle, file=file, executor=Serial())
            part = baum.sweep(
                crank(), parameters, TIMES, **given, progress=lambda done, all: done >= 10
            )
            cancelled = [one is baum.Status.STOP_CANCELLED for one in part.status]
            self.assertEqual(cancelled, [k >= 10 for k in range(30)])
            counts = []
            whole = baum.sweep(
                crank(), parameters, TIMES, **given, progress=lambda done, all: counts.append(done)
            )
            self.assertEqual(counts[0], 11)
            alone = baum.sweep(crank(), parameters, TIMES, **METHOD, reduce=last_angle)
            np.testing.assert_array_equal(whole["value"], alone["value"])
            with self.assertRaisesRegex(ValueError, "of another sweep"):
                baum.sweep(crank(), {"crank.mass": [1, 2]}, TIMES, **given)

    def test_a_sweep_that_ends_early_stops_its_runs(self):
        # The first run fails at once. The other runs would take 1e9 steps each.
        m = crank()
        m.force("f", "crank", lambda t, q, v, u: (0, 0, 0 / (1 - u)), inputs=[m.input("fails")])
        inputs = {"fails.initial": [1.0] + [0.0] * (300 * (os.cpu_count() or 1))}
        with self.assertRaises(ZeroDivisionError):
            baum.sweep(m, inputs, [1e6], "rk4", step=1e-3)

    def test_wrong_arguments_are_refused(self):
        def refuses(kind, text, parameters, **given):
            with self.assertRaisesRegex(kind, text):
                baum.sweep(crank(), parameters, TIMES, **{**METHOD, **given})

        refuses(KeyError, "no 'rod'", {"rod.mass": [1]})
        refuses(TypeError, 'body "crank" has no masss', {"crank.masss": [1]})
        refuses(ValueError, '"element.field" is wanted', {"mass": [1]})
        refuses(ValueError, "a list of values is wanted", {"crank.mass": 1})
        refuses(TypeError, "parameters: a dict .* not a list", ["crank.mass"])
        refuses(TypeError, "crank.mass: numbers are wanted, not .'a'", {"crank.mass": ["a"]})
        refuses(ValueError, "different numbers", {"crank.mass": [1], "crank.inertia": [1, 2]})
        refuses(ValueError, "count is missing", {"crank.mass": [1, 2]}, samples=Fixed())
        refuses(ValueError, "lower and upper", {"crank.mass": [1]}, samples=Fixed(), count=1)
        refuses(ValueError, "shape .2, 2.; .* .2, 1.", {"crank.mass": [1, 2]}, samples=Fixed(), count=2)
        refuses(ValueError, "sampler is wanted, not 'gird'", {"crank.mass": [1, 2]}, samples="gird")
        refuses(TypeError, r"reduce\(\) returned None", {"crank.mass": [1]}, reduce=lambda run: None)
        refuses(TypeError, r"submit\(\) or map\(\)", {"crank.mass": [1]}, executor=3)

    def test_a_file_with_other_content_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "sweep.pickle"
            for content in (b"", b"garbage", pickle.dumps([1, 2, 3])):
                file.write_bytes(content)
                with self.assertRaisesRegex(ValueError, "sweep.pickle: this is not the file of a sweep"):
                    baum.sweep(crank(), {"crank.mass": [1]}, TIMES, **METHOD, file=file)
                self.assertEqual(file.read_bytes(), content)

    @unittest.skipUnless(hasattr(Exception, "add_note"), "needs Python 3.11")
    def test_an_exception_names_its_run(self):
        def fails(run):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError) as caught:
            baum.sweep(crank(), {"crank.mass": [2.5]}, TIMES, **METHOD, reduce=fails)
        self.assertIn("sweep with crank.mass = 2.5", caught.exception.__notes__[0])

    def test_results_become_a_table(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is missing")
        swept = baum.sweep(crank(), {"crank.mass": [1, 2]}, TIMES, **METHOD, reduce=last_angle)
        table = swept.to_dataframe()
        self.assertEqual(list(table), ["crank.mass", "value", "status"])


if __name__ == "__main__":
    unittest.main()
