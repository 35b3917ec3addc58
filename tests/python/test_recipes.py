# SPDX-License-Identifier: BSD-3-Clause
"""Executes the programs in docs/scenes.md that use SciPy, SALib and Optuna."""

import contextlib
import importlib.util
import io
import re
import unittest
import warnings
from pathlib import Path

import numpy as np

import baum

PAGE = Path(__file__).parents[2] / "docs" / "scenes.md"


def slider_crank():
    m = baum.Mechanism()
    m.planar_body("crank", mass=0.038, inertia=7.4e-5, position=(0.0765, 0), angular_velocity=150)
    m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(0.306, 0))
    m.planar_body("slider", mass=0.076, position=(0.459, 0))
    m.revolute("A", "ground", "crank", point_a=(0, 0), point_b=(-0.0765, 0))
    m.revolute("B", "crank", "rod", point_a=(0.0765, 0), point_b=(-0.153, 0))
    m.revolute("C", "rod", "slider", point_a=(0.153, 0), point_b=(0, 0))
    m.translational("guide", "ground", "slider", axis=(1, 0), point_a=(0, 0), point_b=(0, 0))
    return m.freeze()


class Recipes(unittest.TestCase):
    def run_block(self, text, *packages, **names):
        """Execute the block of the page that contains this text, and return its variables. `names`
        are variables of earlier blocks."""
        for package in packages:
            if importlib.util.find_spec(package) is None:
                self.skipTest(f"{package} is missing")
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.S)
        (block,) = [block for block in blocks if text in block]
        names = {"baum": baum, "m": slider_crank(), **names}
        with contextlib.redirect_stdout(io.StringIO()) as out, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the other packages
            exec(block, names)
        return names, out.getvalue()

    def test_scipy_finds_the_masses(self):
        names, _ = self.run_block("import least_squares", "scipy")
        np.testing.assert_allclose(names["fit"].x, [0.038, 0.076], rtol=1e-6)
        found, _ = self.run_block("differential_evolution", **names)
        np.testing.assert_allclose(found["found"].x, [0.038, 0.076], rtol=1e-3)
        iterations = names.pop("fit").njev
        names, _ = self.run_block("def jacobian", **names)
        np.testing.assert_allclose(names["fit"].x, [0.038, 0.076], rtol=1e-6)
        self.assertLessEqual(names["fit"].njev, iterations)

    def test_salib_finds_the_most_important_mass(self):
        names, _ = self.run_block("SALib", "SALib")
        self.assertTrue(np.isfinite(names["indices"]["ST"]).all())
        self.assertEqual(names["swept"].messages, {})

    def test_optuna_finds_a_mass_that_is_at_least_as_good_as_both_ends(self):
        names, _ = self.run_block("optuna", "optuna")
        m, best = slider_crank(), names["search"].best_value
        for mass in (0.05, 0.1):
            run = m.copy(slider={"mass": mass}).simulate([0, 0.05], "rk8", step=2e-4)
            self.assertGreater(best, run["slider.pose"][-1, 0] - 1e-4)

    @unittest.skipUnless(baum.has("sundials"), "no SUNDIALS")
    def test_the_errors_of_derivatives_are_estimated(self):
        _, out = self.run_block("def derivative")
        rows = re.findall(r"^(\w+) +(\S+) (\S+)  (\d) warnings", out, flags=re.M)
        found = {row[0]: [float(x) for x in row[1:]] for row in rows}
        self.assertEqual(list(found), ["rk8", "cvode_bdf", "ida"])
        # The values of ida are noise, so only their magnitude is known.
        self.assertLess(found["rk8"][1], 1e-8)
        self.assertGreater(found["ida"][1], 1e-6)
        self.assertEqual([found["rk8"][2], found["ida"][2]], [0, 1])


if __name__ == "__main__":
    unittest.main()
