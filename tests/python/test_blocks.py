# SPDX-License-Identifier: BSD-3-Clause
"""Executes the parts of programs that the pages show. A part needs objects that its page only describes, such as a
mechanism m; they are made here. Complete programs are executed by test_programs.py and test_cookbook.py."""

import importlib.util
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path
from unittest import mock

import numpy as np

import baum
from compiler import CC, ROOT
from mechanisms import slider_crank

PAGES = [
    ROOT / "README.md",
    ROOT / "bindings" / "python" / "README.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs" / "theory").glob("*.md")),
]
# test_recipes.py executes these parts of scenes.md.
RECIPES = (
    "least_squares",
    "differential_evolution",
    "SALib",
    "optuna",
    "UncertainSensitivityWarning",
)


def blocks(page, language):
    text = page.read_text(encoding="utf-8")
    return re.findall(rf"```{language}\n(.*?)```", text, flags=re.S)


def parts(page):
    return [
        block
        for block in blocks(page, "python")
        if "import baum" not in block and not any(word in block for word in RECIPES)
    ]


def possible():
    """Which words a part may contain, given the packages and the build."""
    matplotlib, pandas = (importlib.util.find_spec(p) for p in ("matplotlib", "pandas"))
    sundials = baum.has("sundials")
    return {"movie": matplotlib, "plot": matplotlib, "dataframe": pandas, "cvode": sundials}


def crank():
    m = slider_crank(omega=10)
    times = np.linspace(0, 0.5, 26)
    run = m.simulate(times, "rk8", rtol=1e-8, record=["B.phi"])
    return {"m": m, "times": times, "run": run}


def pendulum(span=0.1):
    m = baum.Mechanism()
    arm = m.planar_body("arm", mass=1, inertia=0.1, position=(0, -0.5), angular_velocity=1)
    m.revolute("pin", m.ground, arm, point=(0, 0))
    m.load("motor", arm, torque=1, input=m.input("torque"))
    return {"m": m.freeze(), "span": span, "times": np.linspace(0, 1, 11)}


def studied():
    names = pendulum()
    study = baum.study(names["m"], 0, 0.1, progress=False, validate=False)
    study.add("rk8", rtol=1e-6)
    return {**names, "study": study.run()}


def scenes():
    import pickle

    m = slider_crank()
    copy = {"other": m.copy(rod={"mass": 0.04}), "pickle": pickle}
    return {"m": m, **copy, "times": [0, 0.05], "drag": lambda t, q, v: -0.1 * v}


def space():
    m = baum.Mechanism(up="z")
    names = "bead frame bar arm plate weight nut wheel".split()
    bodies = {
        name: m.spatial_body(name, inertia=(1, 1, 1), position=(k, 0, 0))
        for k, name in enumerate(names)
    }
    hinge = m.spatial_revolute("hinge", m.ground, bodies["wheel"], point=(7, 0, 0))
    shaft = m.universal(
        "shaft", bodies["frame"], bodies["bar"], point=(1, 1, 0), axis=(1, 0, 0), axis_b=(0, 1, 0)
    )
    functions = {"r": 1.0, "c": 0.1, "cos": np.cos, "sin": np.sin}
    return {"m": m, **bodies, **functions, "hinge": hinge, "shaft": shaft}


NAMES = {
    "README.md": crank,
    "python/README.md": crank,
    "docs/drawings.md": crank,
    "docs/fmu.md": pendulum,
    "docs/mechanisms.md": crank,
    "docs/scenes.md": scenes,
    "docs/space.md": space,
    "docs/stress.md": lambda: pendulum(1e-3),
    "docs/study.md": studied,
}
# What stands before and after the C of a page.
C = {
    "docs/mechanisms.md": [("void part(void);\nvoid part(void)\n{\n", "}\n")],
    "docs/scenes.md": [
        ("void part(baum_mechanism *mechanism)\n{\n", "}\n"),
        ("void part(baum_mechanism *mechanism, baum_force_fn *drag, double air)\n{\n", "}\n"),
        ("typedef struct { baum_body_id rod; const double *masses; } rods;\n", ""),
    ],
}


def name(page):
    return "/".join(page.relative_to(ROOT).parts[-2:])


class Blocks(unittest.TestCase):
    def setUp(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder)
        # Nothing opens a browser, and no run waits for a button in one.
        self.enterContext(mock.patch.object(baum.Simulation, "view"))
        self.enterContext(mock.patch.object(baum.Run, "show"))
        if not shutil.which("ffmpeg"):
            self.enterContext(mock.patch.object(baum.Run, "movie"))
        self.enterContext(mock.patch("builtins.print"))

    def test_the_parts_of_programs_run(self):
        count = 0
        for page in PAGES:
            found = parts(page)
            if not found:
                continue
            names = {"baum": baum, "np": np, **NAMES[name(page)]()}
            for k, part in enumerate(found):
                if any(word in part and not can for word, can in possible().items()):
                    continue
                with self.subTest(name(page), part=k + 1), warnings.catch_warnings():
                    warnings.simplefilter("ignore", baum.Warning)
                    exec(compile(part, f"{name(page)}, part {k + 1}", "exec"), names)
                    count += 1
        self.assertGreater(count, 10)

    @unittest.skipUnless(CC, "no C compiler")
    def test_the_parts_in_c_compile(self):
        # check_tutorial.sh compares the C of README.md and of docs/tutorial.md with examples/.
        pages = [page for page in PAGES if name(page) in C]
        shown = [
            page for page in PAGES if blocks(page, "c") and page.stem not in ("README", "tutorial")
        ]
        self.assertEqual(shown, pages)
        for page in pages:
            for part, (before, after) in zip(blocks(page, "c"), C[name(page)], strict=True):
                source = (
                    "#include <baum/baum.h>\n#include <baum/catalog.h>\n" + before + part + after
                )
                Path("part.c").write_text(source, encoding="utf-8")
                flags = ["-std=c11", "-Wall", "-Wno-unused", "-Werror", f"-I{ROOT / 'include'}"]
                done = subprocess.run([CC, *flags, "-c", "part.c"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{name(page)}\n{source}\n{done.stderr}")


if __name__ == "__main__":
    unittest.main()
