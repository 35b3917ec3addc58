# SPDX-License-Identifier: BSD-3-Clause
"""Executes every program of the cookbook, and compares what it prints with the page."""

import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest

import baum
from compiler import CC, ROOT

COOKBOOK = ROOT / "docs" / "cookbook"
THEORY = ROOT / "docs" / "theory"
HEADER = ROOT / "include" / "baum" / "simulation.h"
BLOCK = re.compile(r"```(python|text)\n(.*?)```", flags=re.S)
NUMBER = re.compile(r"(?<![\w.])[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
ROUNDING = 1e-12  # numbers below this one are rounding errors, which differ between processors


def unit(number):
    """Return one unit of the last printed digit of a number, or 0 for a whole number."""
    mantissa, _, exponent = number.partition("e")
    _, point, decimals = mantissa.partition(".")
    return 10.0 ** (int(exponent or 0) - len(decimals)) if point or exponent else 0.0


def same(printed, shown):
    """Tell whether two texts have the same words, and numbers that differ by at most one unit of
    their last digit."""
    if NUMBER.sub("#", printed).split() != NUMBER.sub("#", shown).split():
        return False
    pairs = zip(NUMBER.findall(printed), NUMBER.findall(shown))
    return all(abs(float(a) - float(b)) <= max(1.001 * unit(b), ROUNDING) for a, b in pairs)


def programs(text):
    """Return the programs of a page, each with the text that it should print."""
    blocks = BLOCK.findall(text)
    pairs = zip(blocks, [*blocks[1:], ("", "")])
    return [
        (program, after if kind == "text" else None)
        for (language, program), (kind, after) in pairs
        if language == "python"
    ]


def missing(program):
    """Return what the program needs and this machine does not have, or "" if nothing is missing."""
    for package in re.findall(r"^(?:import|from) (\w+)", program, flags=re.M):
        if importlib.util.find_spec(package) is None:
            return package
    if not baum.has("sundials") and re.search(r'"(cvode_\w+|ida)"', program):
        return "SUNDIALS"
    return "a C compiler" if '"cc"' in program and not CC else ""


class Cookbook(unittest.TestCase):
    def test_every_program_prints_what_its_page_shows(self):
        count = 0
        for page in [*sorted(COOKBOOK.glob("*.md")), THEORY / "computation.md"]:
            for k, (program, shown) in enumerate(programs(page.read_text(encoding="utf-8"))):
                with (
                    self.subTest(page.name, program=k + 1),
                    tempfile.TemporaryDirectory() as folder,
                ):
                    self.assertIsNotNone(shown, "the page does not show what the program prints")
                    if missing(program):
                        continue
                    done = subprocess.run(
                        [sys.executable, "-c", program],
                        cwd=folder,
                        capture_output=True,
                        text=True,
                        timeout=250,
                        env={**os.environ, "MPLBACKEND": "agg"},
                    )
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertTrue(same(done.stdout, shown), f"{done.stdout}\nis not\n{shown}")
                    count += 1
        self.assertGreater(count, 20)

    def test_every_program_has_a_page_in_the_index(self):
        index = (COOKBOOK / "index.md").read_text(encoding="utf-8")
        for page in COOKBOOK.glob("*.md"):
            if page.stem != "index":
                self.assertIn(f"]({page.name})", index)
                self.assertIn(f"\n{page.stem}\n", index)

    def test_every_warning_has_an_entry_and_its_program_causes_it(self):
        codes = re.findall(r"BAUM_WARNING_(\w+) = (\d+)", HEADER.read_text(encoding="utf-8"))
        self.assertGreater(len(codes), 10)
        page = (COOKBOOK / "warnings.md").read_text(encoding="utf-8")
        entries = dict(re.findall(r"(?ms)^## (.*?)$(.*?)(?=^## |\Z)", page))
        self.assertEqual(list(entries), [f"{code} {name.lower()}" for name, code in codes])
        for title, entry in entries.items():
            name = "".join(map(str.capitalize, title.split()[1].split("_"))) + "Warning"
            self.assertTrue(issubclass(getattr(baum, name), baum.Warning))
            shown = [text for _, text in programs(entry)]
            self.assertIn(name, shown[0] if shown else page)

    def test_the_comparison_of_texts_finds_differences(self):
        self.assertTrue(same("a 1.001 b 12", "a 1.002 b 12"))
        self.assertTrue(same("error 3e-16", "error 1e-15"))
        for printed in ("a 1.004 b 12", "a 1.002 b 13", "a 1.002 c 12", "a 1.002 b"):
            self.assertFalse(same(printed, "a 1.002 b 12"), printed)


if __name__ == "__main__":
    unittest.main()
