# SPDX-License-Identifier: BSD-3-Clause
"""Tests what a study shows while it runs, where it shows this, and which grid is run by default."""

import io
import sys
import types
import unittest
from unittest import mock

import baum
from baum import progress
from mechanisms import rod_pendulum


class Terminal(io.StringIO):
    def isatty(self):
        return True


def short_study(**options):
    return baum.study(rod_pendulum(), 0, 0.1, samples=2, repeats=1, threads=1, validate=False, **options)


class Grids(unittest.TestCase):
    def settings(self, **options):
        """Return the number of settings of a study. The study is stopped after its first entry."""
        study = short_study(progress=lambda done, total: True, **options)
        with self.assertWarnsRegex(baum.Warning, "cancelled"):
            study.run()
        return len(study)

    def test_the_quick_grid_is_the_default_and_the_full_one_has_a_name(self):
        full = self.settings(grid="full")
        self.assertEqual(len(short_study().add_standard()), full)
        quick = self.settings()
        self.assertEqual(self.settings(grid="quick"), quick)
        self.assertEqual(len(short_study().add_standard(quick=True)), quick)
        self.assertTrue(30 < quick < 100 < 300 < full, (quick, full))
        with self.assertRaisesRegex(ValueError, "no grid 'fine'; there are: quick, full"):
            short_study(grid="fine")


class Shown(unittest.TestCase):
    def output(self, **options):
        with mock.patch.object(sys, "stderr", Terminal()) as terminal:
            short_study(**options).add("rk4", step=0.01).add("rk4", step=0.005).run()
            return terminal.getvalue()

    def test_a_terminal_has_a_line_unless_it_is_silenced(self):
        shown = self.output()
        self.assertRegex(shown, r"^\rstudy of 2 settings: reference *\r.*\d s *\n$")
        self.assertEqual(self.output(progress=False), "")
        seen = []
        self.assertEqual(self.output(progress=lambda *now: seen.append(now)), "")
        self.assertEqual(seen, [(k, 4) for k in (1, 2, 3, 4)])
        with self.assertRaisesRegex(TypeError, "progress: a function or False is wanted, not 1"):
            short_study(progress=1)

    def test_a_run_has_a_bar_on_request(self):
        m = rod_pendulum()
        with mock.patch.object(sys, "stderr", Terminal()) as terminal:
            m.simulate([0.5, 1.0], "rk4", step=1e-3)
            self.assertEqual(terminal.getvalue(), "")
            m.simulate([0.5, 1.0], "rk4", step=1e-3, progress=True, progress_interval=0)
        self.assertRegex(terminal.getvalue(), r"^\rrun to t = 1 s: \[.*\d s *\n$")
        with mock.patch.object(sys, "stderr", Terminal()) as terminal:
            with m.simulation("rk4", step=1e-3) as s:
                s.advance_to(1, progress=True)
                s.step(1)
        self.assertEqual(terminal.getvalue().count("\n"), 1)
        with mock.patch.object(sys, "stderr", io.StringIO()) as file:
            m.simulate(1.0, "rk4", step=1e-2, progress=True, progress_interval=0)
        self.assertEqual(file.getvalue(), "")

    def test_a_notebook_shows_the_bar_of_a_run(self):
        notebook = types.SimpleNamespace(get_ipython=lambda: types.SimpleNamespace(kernel=1))
        with mock.patch.dict(sys.modules, IPython=notebook):
            with mock.patch.object(sys, "stdout", io.StringIO()) as out:
                rod_pendulum().simulate(1.0, "rk4", step=1e-2, progress=True, progress_interval=0)
        self.assertIn("run to t = 1 s", out.getvalue())

    def test_a_bar_is_filled_from_left_to_right(self):
        out, now = io.StringIO(), [0.0]
        with mock.patch.object(progress.time, "monotonic", lambda: now[0]):
            line = progress.RunLine(out, 2.0, 12.0)
            for t in (2.0, 4.5, 7.0):
                now[0] = t
                line(t)
        shown = out.getvalue().replace(" ", "").split("\r")[1:]
        self.assertEqual(shown, [
            "runtot=12s:[....................]0%",
            "runtot=12s:[#####...............]25%,about14sleft",
            "runtot=12s:[##########..........]50%,about7sleft",
        ])

    def test_nothing_is_shown_without_a_terminal(self):
        with mock.patch.object(sys, "stderr", io.StringIO()) as file:
            short_study().add("rk4", step=0.01).run()
        self.assertEqual(file.getvalue(), "")

    def test_a_notebook_is_written_to_its_output(self):
        notebook = types.SimpleNamespace(get_ipython=lambda: types.SimpleNamespace(kernel=1))
        shell = types.SimpleNamespace(get_ipython=lambda: types.SimpleNamespace())
        for ipython, out in ((notebook, sys.stdout), (shell, None)):
            with mock.patch.dict(sys.modules, IPython=ipython):
                with mock.patch.object(sys, "stderr", io.StringIO()):
                    self.assertIs(progress.stream(), out)

    def test_the_time_left_follows_from_costs_that_double(self):
        out, now = io.StringIO(), [0.0]
        with mock.patch.object(progress.time, "monotonic", lambda: now[0]):
            # The errors are computed from coarse to fine, at the costs 1 1 2 2 4 4. Then the times
            # are measured in the order in which the entries were added, at the costs 1 2 4 1 2 4.
            line = progress.StudyLine(out, [0, 0, 0, 1, 1, 1])
            for done, t in (1, 1.0), (2, 2.0), (6, 14.0), (12, 28.0):
                now[0] = t
                line(done, 12)
            line.close()
        shown = out.getvalue()
        self.assertRegex(shown, "4 %, about 27 s left .*7 %, about 26 s left .*50 %, about 14 s left .*validation")
        self.assertTrue(shown.endswith("\n") and shown.count("\n") == 1)

    def test_a_stream_that_is_closed_ends_the_line_and_not_the_study(self):
        out = io.StringIO()
        line = progress.StudyLine(out, [0, 0])
        out.close()
        line._next = 0.0
        line(1, 4)
        line.close()

    def test_times_have_the_digits_of_an_estimate(self):
        times = [progress.duration(seconds) for seconds in (3.4, 89, 130, 5000, 9000)]
        self.assertEqual(times, ["3 s", "89 s", "2 min", "83 min", "2.5 h"])


if __name__ == "__main__":
    unittest.main()
