# SPDX-License-Identifier: BSD-3-Clause
"""Tests programs as users write them. They are the programs in the documentation, word for word,
and the examples."""

import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import baum
from compiler import ROOT
from mechanisms import pendulum, slider_crank


def programs(text):
    """Return the Python programs in a page. These are the code blocks that import baum."""
    return [
        code
        for code in re.findall(r"```python\n(.*?)```", text, flags=re.S)
        if "import baum" in code
    ]


def run(arguments, **more):
    done = subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        timeout=250,
        env={**os.environ, "MPLBACKEND": "agg"},
        **more,
    )
    return done.returncode, done.stdout + done.stderr


class Documentation(unittest.TestCase):
    def test_the_programs_of_the_pages_run(self):
        pages = [
            ROOT / "README.md",
            ROOT / "bindings" / "python" / "README.md",
            *sorted((ROOT / "docs").glob("**/*.md")),
        ]
        # test_cookbook.py executes the programs of the cookbook.
        pages = [page for page in pages if page.parent.name != "cookbook"]
        for page in pages:
            text = page.read_text(encoding="utf-8") if page.exists() else ""
            for k, program in enumerate(programs(text)):
                if "matplotlib" in program and not importlib.util.find_spec("matplotlib"):
                    continue
                with (
                    self.subTest(f"{page.name}, program {k + 1}"),
                    tempfile.TemporaryDirectory() as folder,
                ):
                    code, said = run(["-c", program], cwd=folder)
                    self.assertEqual(code, 0, said)

    def test_the_program_of_the_package_runs(self):
        code, said = run(
            ["-c", re.sub(r"(?m)^    ", "", baum.__doc__.split("\n\n", 1)[1].rsplit("\n\n", 1)[0])]
        )
        self.assertEqual(code, 0, said)


class Examples(unittest.TestCase):
    def test_every_example_passes_and_writes_its_table(self):
        for program in sorted((ROOT / "examples").glob("*.py")):
            with self.subTest(program.name), tempfile.TemporaryDirectory() as folder:
                table = Path(folder) / "table.json"
                code, said = run([str(program), "--json", str(table)], cwd=folder)
                self.assertEqual(code, 0, said)
                self.assertIn("check", said)
                self.assertTrue(json.loads(table.read_text(encoding="utf-8"))["checks"])


class Styles(unittest.TestCase):
    """Tests typical uses, for which the interface was designed."""

    def test_several_gains_on_one_mechanism(self):
        m = slider_crank(omega=150)
        t = np.linspace(0, 0.1, 21)
        worst = {}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", baum.Warning)
            for gains in (baum.fixed(0, 0), baum.fixed(5, 5), baum.taylor()):
                run = m.simulate(
                    t,
                    integrator="euler",
                    step=1e-4,
                    formulation="baumgarte",
                    gains=gains,
                    allow_unstable=True,
                    record=[m["B"].phi, m["A"].reaction, m["slider"].pose],
                )
                worst[str(gains)] = abs(run["B.phi"][:, 0]).max()
        self.assertEqual(
            list(worst), ["fixed(alpha=0, beta=0)", "fixed(alpha=5, beta=5)", "taylor()"]
        )
        self.assertGreater(worst["fixed(alpha=0, beta=0)"], worst["taylor()"])

    @unittest.skipUnless(baum.has("sundials"), "no SUNDIALS")
    def test_a_pendulum_in_five_lines(self):
        p = baum.Mechanism()
        bob = p.planar_particle("bob", mass=1, position=(1, 0))
        p.constraint("circle", [bob], rows=1, phi=lambda t, q: q @ q - 1)
        run = p.freeze().simulate([10.0], integrator="cvode_adams", rtol=1e-6)
        self.assertAlmostEqual(np.hypot(*run.q[0]), 1, 4)

    @unittest.skipUnless(baum.has("sundials"), "no SUNDIALS")
    def test_a_thousand_variants_in_a_pool(self):
        m = slider_crank()
        with ThreadPoolExecutor() as pool:
            x = list(
                pool.map(
                    lambda k: m.copy(rod=dict(mass=0.038 * (1 + k * 1e-3))).simulate(
                        [0.1], integrator="cvode_adams", rtol=1e-6
                    )["slider.pose"][-1],
                    range(1000),
                )
            )
        self.assertEqual(np.shape(x), (1000, 3))
        self.assertEqual(len(np.unique(np.array(x)[:, 0])), 1000)

    def test_a_control_loop(self):
        m = baum.Mechanism()
        bar = m.planar_body("bar", mass=1, inertia=0.1, position=(0, -0.5))
        pin = m.revolute("pin", m.ground, bar, point=(0, 0))
        torque = m.input("torque")
        m.load("motor", bar, torque=1, input=torque)
        s = m.freeze().simulation("semi_implicit_euler", step=1e-3)
        for _ in range(400):
            angle, rate = s.get(pin.coordinate)
            s.set_input(torque, 40 * (0.5 - angle) - 8 * rate)
            s.step(10)
        balance = 40 * (0.5 - s.get(pin.coordinate)[0])
        self.assertAlmostEqual(balance, 9.81 * 0.5 * np.sin(s.get(pin.coordinate)[0]), 2)

    def test_what_makes_no_sense_says_so(self):
        with self.assertRaises(baum.Error) as caught:
            pendulum().simulate([1.0], integrator="euler", step=1e-3, rtol=1e-6)
        self.assertEqual(caught.exception.status, baum.Status.ERR_ARGUMENT)
        self.assertIn("rtol", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
