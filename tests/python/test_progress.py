# SPDX-License-Identifier: BSD-3-Clause
"""What is shown of a study while it runs, where, and which grid runs by default."""

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
        """Number of settings of a study that is stopped after the first."""
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

    def test_nothing_is_shown_where_nobody_watches(self):
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
            line = progress.Line(out, [0, 0, 0, 1, 1, 1])  # 1 1 2 2 4 4, then 1 2 4 1 2 4
            for done, t in (1, 1.0), (2, 2.0), (6, 14.0), (12, 28.0):
                now[0] = t
                line(done, 12)
            line.close()
        shown = out.getvalue()
        self.assertRegex(shown, "4 %, about 27 s left .*7 %, about 26 s left .*50 %, about 14 s left .*validation")
        self.assertTrue(shown.endswith("\n") and shown.count("\n") == 1)

    def test_a_stream_that_is_closed_ends_the_line_and_not_the_study(self):
        out = io.StringIO()
        line = progress.Line(out, [0, 0])
        out.close()
        line._next = 0.0
        line(1, 4)
        line.close()

    def test_times_have_the_digits_of_an_estimate(self):
        times = [progress.duration(seconds) for seconds in (3.4, 89, 130, 5000, 9000)]
        self.assertEqual(times, ["3 s", "89 s", "2 min", "83 min", "2.5 h"])


if __name__ == "__main__":
    unittest.main()
