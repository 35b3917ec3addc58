# SPDX-License-Identifier: BSD-3-Clause
"""Tests reports of a study by reading them back. They must contain the entries of the study,
whatever names users give."""

import csv
import html.parser
import io
import json
import math
import os
import tempfile
import unittest
import warnings

import baum
from baum import library_version
from mechanisms import pendulum

TITLE = "</title><script>taken()</script> \"q\" \\ 'é'"
JOINT = '<img src=x onerror="taken()">'
VOID = {"meta", "input", "br", "img", "link"}


def make_study():
    """A study with entries that are done and an entry that is refused. One of the entries that are
    done has a warning that names a joint."""
    m = baum.Mechanism()
    bob = m.planar_particle("bob", mass=1, position=(1, 0))
    m.constraint(JOINT, [bob], rows=1, phi=lambda t, q: q @ q - 1)
    study = baum.study(m.freeze(), 0, 1, repeats=1)
    for step in (0.04, 0.02):
        study.add("rk4", formulation="projection", step=step)
    study.add("dp5", formulation="unstabilized", rtol=0.1)
    study.add("rk2", formulation="baumgarte", gains=baum.fixed(1e3, 1e3), step=0.01)
    return study.run()


class Page(html.parser.HTMLParser):
    """Parses a page. Counts its elements, checks that they are nested correctly, and collects the
    texts of cells."""

    def __init__(self):
        super().__init__()
        self.count = {}
        self.handlers = []
        self.wrong = []
        self._open = []

    def handle_starttag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1
        self.handlers += [name for name, _ in attributes if name.startswith("on")]
        if tag not in VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1
        self.handlers += [name for name, _ in attributes if name.startswith("on")]

    def handle_endtag(self, tag):
        if not self._open or self._open.pop() != tag:
            self.wrong.append(tag)

    def close(self):
        super().close()
        self.wrong += self._open


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.study = make_study()

    def test_entries_are_what_this_test_wants(self):
        states = [entry.state for entry in self.study.entries]
        self.assertEqual(states, ["done", "done", "done", "refused"])
        self.assertIn(JOINT, self.study.entries[2].message)

    def check_entry(self, entry, cells, number):
        """Check that every number that both the entry and the cells contain is the same to the last
        bit."""
        compared = 0
        for name in entry._fields:
            value = getattr(entry, name)
            if name not in cells or isinstance(value, (str, bool)) or not isinstance(value, float):
                continue
            if math.isnan(value) or entry.state != "done" and name not in ("step", "rtol"):
                self.assertIn(cells[name], ("", None), name)
            else:
                self.assertEqual(number(cells[name]), value, name)
                compared += 1
        self.assertGreater(compared, 15 if entry.state == "done" else 0)

    def test_csv_is_read_back(self):
        lines = list(csv.DictReader(io.StringIO(self.study.report("csv"))))
        self.assertEqual(len(lines), len(self.study))
        for entry, cells in zip(self.study.entries, lines):
            self.assertNotIn(None, cells)  # there are as many cells as titles
            self.assertEqual(cells["name"], entry.name)
            self.assertEqual(cells["message"], entry.message)
            self.check_entry(entry, cells, float)

    def test_json_is_read_back(self):
        def refuse(constant):
            raise ValueError(constant)

        report = json.loads(self.study.report("json", TITLE), parse_constant=refuse)
        self.assertEqual(report["study"]["title"], TITLE)
        self.assertEqual(report["environment"]["baum"], library_version)
        self.assertEqual(report["front"]["work"], self.study.front())
        self.assertEqual(len(report["recommendations"]), 10)
        self.assertEqual([m["name"] for m in report["methods"]], [m.name for m in self.study.methods])
        self.assertEqual(report["units"]["cpu"], "s")
        for entry, cells in zip(self.study.entries, report["entries"], strict=True):
            self.assertEqual(cells["message"] or "", entry.message)
            self.assertIs(cells["unstable"], entry.unstable)
            self.check_entry(entry, cells, float)

    def test_keys_of_json_stay(self):
        report = json.loads(self.study.report("json"))
        keys = ["report", "version", "environment", "study", "reference", "units", "meanings",
                "recommendations", "front", "methods", "entries"]
        self.assertEqual(list(report), keys)
        self.assertEqual(report["version"], 2)
        entry = {"name", "state", "integrator", "formulation", "gains", "gain_1", "gain_2", "method",
               "step", "rtol", "error", "error_final", "error_half", "work", "cpu", "cpu_spread",
               "repeats", "evaluations", "factorizations", "steps", "rejected",
               "nonlinear_iterations", "forced_steps", "error_q", "error_q_final", "error_v",
               "error_v_final", "error_lambda", "error_lambda_final", "max_phi", "max_phi_rate",
               "energy_error", "energy_error_final", "gains_work", "violation_work",
               "projection_work", "warnings", "near_singular_intervals", "branch_warnings",
               "at_floor", "untrusted", "off", "unstable", "on_front_work", "on_front_cpu",
               "status", "message"}
        self.assertLessEqual(entry, set(report["entries"][0]))

    def test_page_is_well_formed_and_has_no_markup_of_users(self):
        page = Page()
        page.feed(self.study.report("page", TITLE))
        page.close()
        self.assertEqual(page.wrong, [])
        self.assertEqual(page.handlers, [])
        self.assertEqual(page.count["script"], 2)  # one for the data and one for the program
        self.assertNotIn("img", page.count)
        self.assertNotIn("link", page.count)

    def test_files_go_by_their_names(self):
        with tempfile.TemporaryDirectory() as folder:
            for suffix in ("txt", "csv", "json", "html"):
                path = os.path.join(folder, f"study.{suffix}")
                self.study.write(path, TITLE)
                self.assertGreater(os.path.getsize(path), 500)
            self.assertEqual(len(os.listdir(folder)), 4)
            with self.assertRaisesRegex(ValueError, "ends with .txt"):
                self.study.write(os.path.join(folder, "study.xls"))
            with self.assertRaises(baum.Error) as raised:
                self.study.write(os.path.join(folder, "none", "study.csv"))
            self.assertEqual(raised.exception.status, baum.Status.ERR_FILE)

    @unittest.skipUnless(os.path.exists("/dev/full"), "no device that is always full")
    def test_a_full_disk_is_reported(self):
        full = "/dev/full"
        with tempfile.TemporaryDirectory() as folder:
            for suffix in ("txt", "csv", "json", "html"):
                path = os.path.join(folder, f"study.{suffix}")
                os.symlink(full, path)
                with self.assertRaisesRegex(baum.Error, "written: No space left") as raised:
                    self.study.write(path)
                self.assertEqual(raised.exception.status, baum.Status.ERR_FILE)
                self.assertIn(path, str(raised.exception))
                self.assertTrue(os.path.islink(path))

    def test_unknown_forms_are_refused(self):
        with self.assertRaisesRegex(ValueError, "there are: text, csv, json, page"):
            self.study.report("pdf")

    def test_the_reference_is_the_motion(self):
        times, q, v, lambda_ = self.study.reference_samples()
        run = pendulum().simulate(times, "rk8", rtol=1e-10)
        # Over 1 s, errors are at most about a hundred times rtol.
        self.assertLess(abs(run.q - q).max(), 1e-8)
        self.assertLess(abs(run.v - v).max(), 1e-7)
        self.assertEqual(lambda_.shape, (len(times), 1))

    def test_a_study_that_was_not_run_is_reported(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            study = baum.study(pendulum(), 0, 1).add("rk4", step=0.01)
            self.assertIn("1 waiting", study.report())
            self.assertEqual(json.loads(study.report("json"))["entries"][0]["error"], None)


if __name__ == "__main__":
    unittest.main()
