# SPDX-License-Identifier: BSD-3-Clause
"""Tests that no text that reaches Python contains a C name."""

import re
import unittest

import baum
from baum._words import in_python
from compiler import ROOT
from mechanisms import rod_pendulum

FOREIGN = r"baum_\w|BAUM_\w|\bNULL\b|row_count|body_count"


class Table(unittest.TestCase):
    def test_texts_of_the_library_say_what_python_says(self):
        for text, said in (
            ("baum_simulation_step: count is 0", "count is 0"),
            ("must be one such as baum_euler()", 'must be one such as "euler"'),
            ("such as baum_rk4 or baum_cvode_adams", 'such as "rk4" or "cvode_adams"'),
            ("was not written by baum_simulation_save()", "was not written by save()"),
            ("baum_stability_best() returns the point", "baum.stability_best() returns the point"),
            ("make gains with baum_gains_fixed()", "make gains with baum.fixed()"),
            ("baum_catalog_times() gives those", "baum.catalog.times() gives those"),
            ('constraint "c": row_count is 0', 'constraint "c": rows is 0'),
            ('joint "m": ds is inf rad/s', 'joint "m": rate is inf rad/s'),
            ('joint "m": count is 2', 'joint "m": len(times) is 2'),
            ("status is BAUM_ERR_STEP", "status is Status.ERR_STEP"),
            ("take BAUM_FORMULATION_INDEX3", 'take "index3"'),
            ("body_a is BAUM_GROUND", "body_a is ground"),
        ):
            self.assertEqual(in_python(text), said)

    def test_all_integrators_are_known(self):
        for name in baum.integrators():
            self.assertEqual(in_python(f"use baum_{name}()"), f'use "{name}"')

    def test_names_of_the_user_are_kept(self):
        text = 'body "baum_rk4": mass of "NULL" and "row_count"'
        self.assertEqual(in_python(text), text)

    @unittest.skipUnless((ROOT / "src").is_dir(), "no sources")
    def test_all_texts_in_the_sources_are_covered(self):
        covered = 0
        for path in (ROOT / "src").rglob("*.c"):
            if path.parent.name == "data":
                continue
            for line in path.read_text(encoding="utf-8").splitlines():
                for text in re.findall(r'"((?:[^"\\]|\\.)*)"', line.split("//")[0]):
                    if re.search(r"baum_|BAUM_\w|NULL", text) and not line.startswith("#include"):
                        covered += 1
                        said = in_python(text + ": " if text.startswith("baum_") else text)
                        self.assertNotRegex(said, FOREIGN, path.name)
        self.assertGreater(covered, 20)


class Errors(unittest.TestCase):
    """Errors whose messages contain C names until the binding translates them."""

    def refused(self, call, *arguments, **fields):
        with self.assertRaises(baum.Error) as caught:
            call(*arguments, **fields)
        self.assertNotRegex(str(caught.exception), FOREIGN)
        return str(caught.exception)

    def test_arguments_have_their_names_in_python(self):
        m = baum.Mechanism()
        arm = m.planar_body("arm")
        pin = m.revolute("pin", m.ground, arm, point=(0, 0))
        self.assertIn("rows is 0", self.refused(m.constraint, "c", arm, 0, lambda t, q: 0))
        said = self.refused(m.spline_driver, "spline", pin, [0, 1], [0, 1])
        self.assertIn("len(times) is 2", said)
        self.assertIn("len(bodies) is 0", self.refused(m.force, "f", [], lambda t, q, v: 0))
        m.driver("motor", pin)
        s = m.freeze().simulation("rk4", step=0.1)
        for name, law in (("value", (1e400,)), ("rate", (0, 1e400)), ("acceleration", (0, 0, 1e400))):
            self.assertIn(f"{name} is inf", self.refused(s.set_driver, "motor", *law))

    def test_other_objects_have_their_names_in_python(self):
        m = rod_pendulum()
        s = m.simulation("rk4", step=0.1)
        self.assertIn("not written by save()", self.refused(s.restore, bytes(400)))
        self.refused(s.restore, b"")
        self.refused(m.simulate, 1, "kinematics")
        self.refused(baum.stability_deadbeat, "ab4")
        self.refused(baum.stability, "cvode_adams", float("nan"), 1)
        said = self.refused(m.simulate, 1, "rk8", rtol=1e-6, record=[m["rod"].effort])
        self.assertRegex(said, "^channel 'rod.effort': joint .* is a planar distance joint, but only")
        said = self.refused(m.simulate, 1, "rk8", rtol=1e-6, record=[m["rod"].coordinate])
        self.assertRegex(said, "all joints have reaction, multipliers, phi and phi_rate$")
        self.refused(baum.Mechanism().freeze)
        self.refused(baum.study, m, 0, float("inf"))


if __name__ == "__main__":
    unittest.main()
