# SPDX-License-Identifier: BSD-3-Clause
"""Tests conversions and names of gains and stability. The mathematics is tested in C."""

import math
import unittest

import baum
from mechanisms import slider_crank


class Gains(unittest.TestCase):
    def test_gains_print_as_they_are_written(self):
        for text in (
            "fixed(alpha=5, beta=0.5)",
            "scaled(alpha_h=0.5, beta2_h2=0.25)",
            "taylor()",
            "frequency(hertz=100, damping_ratio=0.2)",
            "deadbeat()",
            "auto()",
            "best_damping()",
        ):
            gains = eval(f"baum.{text}")
            self.assertEqual(str(gains), text)
            self.assertEqual(gains, eval(f"baum.{text}"))
        self.assertNotEqual(baum.fixed(1, 2), baum.scaled(1, 2))
        self.assertEqual(len({baum.fixed(1, 2), baum.fixed(1, 2), baum.taylor()}), 2)

    def test_gains_must_be_numbers(self):
        with self.assertRaisesRegex(TypeError, "gains fixed: beta: a number is wanted, not 'x'"):
            baum.fixed(1, "x")


class RowGains(unittest.TestCase):
    def test_factors_of_joints(self):
        m = slider_crank()
        with self.assertRaisesRegex(baum.Error, 'row_gains.*"B".*alpha = 4000 1/s'):
            m.simulation("rk4", step=1e-3, formulation="baumgarte", gains=baum.fixed(10, 10),
                         row_gains={"B": 400})
        run = m.simulation("rk4", step=1e-3, formulation="baumgarte", gains=baum.fixed(10, 10),
                           row_gains={m["B"]: (2, 3)})
        self.assertIn("times the factors of row_gains", run.explain)
        self.assertAlmostEqual(run.counters.spectral_radius, math.exp(-0.01), 10)
        self.assertAlmostEqual(run.counters.damping, 10, 6)

    def test_what_is_no_factor_is_named(self):
        m = slider_crank()
        for factors, why in (
            ([1, 2], "row_gains: {joint: factor} is wanted"),
            ({"B": (1, 2, 3)}, 'row_gains of "B": 2 numbers are wanted, not 3'),
            ({"B": "x"}, 'row_gains of "B": a number is wanted'),
        ):
            with self.assertRaisesRegex((TypeError, ValueError), why):
                m.simulation("rk4", step=1e-3, formulation="baumgarte", row_gains=factors)


class Stability(unittest.TestCase):
    def test_points_of_the_plane(self):
        taylor = baum.stability("euler", 1, 2)
        self.assertEqual(taylor.stability, "marginal")
        self.assertEqual(
            {(round(z.real, 12), round(abs(z.imag), 12)) for z in taylor.roots}, {(0, 1)}
        )
        self.assertEqual(baum.stability(baum.integrators()["euler"], 1, 1).spectral_radius, 0)
        self.assertEqual(baum.stability("semi_implicit_euler", 1, 1).stability, "unstable")
        self.assertEqual(baum.stability("cvode_bdf", 1, 1).stability, "variable_step")

    def test_limits_and_points(self):
        self.assertAlmostEqual(baum.stability_limit("euler"), 2)
        self.assertEqual(baum.stability_deadbeat("semi_implicit_euler"), (0.5, 1))
        nearest = baum.stability_nearest("euler", 1, 2)
        self.assertLessEqual(baum.stability("euler", *nearest).spectral_radius, 0.9 + 1e-9)

    def test_regions_are_arrays(self):
        intervals = baum.stability_intervals("ab4")
        self.assertEqual(intervals.shape, (1, 2))
        self.assertAlmostEqual(intervals[0, 1], 0.3)
        best = baum.stability_best("ab2")
        self.assertAlmostEqual(best[0], 2 / 3)
        self.assertAlmostEqual(baum.stability_best_on_ray("ab2"), best[0])
        with self.assertRaisesRegex(ValueError, "alpha_h: 2 numbers are wanted, not 3"):
            baum.stability_grid("rk4", (0, 1, 2), (0, 3))
        radius = baum.stability_grid("rk4", (0, 2), (0, 3), (4, 3))
        self.assertEqual(radius.shape, (4, 3))
        for row, column in ((0, 0), (1, 2), (3, 1)):
            point = baum.stability("rk4", column, row)
            self.assertAlmostEqual(radius[row, column], point.spectral_radius)
            self.assertAlmostEqual(1 - point.damping, point.spectral_radius)
        outline = baum.stability_outline("euler")
        self.assertEqual(outline.shape[1], 2)
        self.assertAlmostEqual(outline[:, 1].max(), 4)
        self.assertEqual(tuple(outline[0]), tuple(outline[-1]))
        self.assertEqual(baum.stability_outline("ab4", 0.5).shape, (0, 2))

    def test_every_method_has_a_statement_about_stability(self):
        self.assertIn("0.618", baum.stability_statement("ida"))
        for method in baum.integrators():
            self.assertGreater(len(baum.stability_statement(method)), 40)

    def test_what_makes_no_sense_is_refused(self):
        with self.assertRaises(baum.Error) as caught:
            baum.stability_limit("ida")
        self.assertEqual(caught.exception.status, baum.Status.ERR_UNSUPPORTED)
        self.assertRaises(baum.Error, baum.stability, "euler", math.nan, 1)
        self.assertRaisesRegex(
            ValueError, "no integrator 'x'; there are: euler", baum.stability, "x", 1, 1
        )

    def test_integrators_describe_themselves(self):
        methods = baum.integrators()
        self.assertEqual((methods["rk4"].order, methods["rk4"].fixed_step), (4, True))
        kinds = {n: (methods[n].fixed_step, methods[n].variable_step) for n in methods}
        self.assertEqual(kinds["rk4"], (True, False))
        self.assertEqual(kinds["rk8"], (True, True))
        self.assertEqual(kinds["ida"], (False, baum.has("sundials")))
        self.assertEqual(kinds["kinematics"], (False, False))
        self.assertFalse(methods["ida"].fixed_step)
        self.assertIn("index3", methods["ida"].formulations)
        self.assertNotIn("index3", methods["euler"].formulations)
        self.assertEqual(methods["kinematics"].formulations, ())


if __name__ == "__main__":
    unittest.main()
