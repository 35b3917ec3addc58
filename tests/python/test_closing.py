# SPDX-License-Identifier: BSD-3-Clause
"""Tests that runs, workspaces and studies are closed at the end of their `with` block. Their
results must remain valid."""

import tempfile
import threading
import unittest
from pathlib import Path

import baum
from mechanisms import rod_pendulum


class Closing(unittest.TestCase):
    def test_a_run_ends_with_its_block(self):
        m = rod_pendulum()
        with m.simulation("rk4", step=0.1) as s:
            s.advance_to(0.5)
            run, q = s.sample([0.6], "rod.phi"), s.q
        self.assertEqual(repr(s), "<simulation, closed>")
        for use in (
            lambda: s.time, lambda: s.q, lambda: s.counters, lambda: s.advance_to(1), s.cancel,
            lambda: s.get("rod.phi"), s.save, lambda: s.explain, lambda: s.inputs and 0 or s.events,
            lambda: m.simulation("rk4", step=0.1).continue_from(s),
        ):
            with self.assertRaisesRegex(baum.Error, "this simulation is closed") as caught:
                use()
            self.assertEqual(caught.exception.status, baum.Status.ERR_STATE)
        s.close()
        self.assertEqual((run["rod.phi"].shape, q.shape), ((1, 1), (2,)))
        self.assertEqual(set(run.columns), {"t", "q[0]", "q[1]", "v[0]", "v[1]", "rod.phi"})

    def test_an_exception_also_closes_the_run(self):
        with self.assertRaisesRegex(KeyError, "none"):
            with rod_pendulum().simulation("rk4", step=0.1) as s:
                s.get("none")
        self.assertEqual(repr(s), "<simulation, closed>")

    def test_workspaces_and_studies_are_closed_too(self):
        m = rod_pendulum()
        with baum.Workspace(m) as w:
            w.phi(0, [1, 0])
        with self.assertRaisesRegex(baum.Error, "this workspace is closed"):
            w.phi(0, [1, 0])
        with tempfile.TemporaryDirectory() as folder:
            options = dict(repeats=1, threads=1, validate=False, samples=2, progress=False)
            with baum.study(m, 0, 0.1, file=Path(folder) / "study", **options) as study:
                study.add("rk4", step=0.01).run()
            self.assertEqual(repr(study), "<study, closed>")
            with self.assertRaisesRegex(baum.Error, "this study is closed"):
                len(study)

    def test_what_a_thread_uses_is_not_closed(self):
        s = rod_pendulum().simulation("rk4", step=1e-3, progress=lambda t: at(), progress_interval=0)
        begun, ended, said = threading.Event(), threading.Event(), []

        def at():
            begun.set()
            ended.wait(10)

        thread = threading.Thread(target=lambda: said.append(s.advance_to(1)))
        thread.start()
        begun.wait(10)
        with self.assertRaisesRegex(baum.Error, "in use by another call"):
            s.close()
        with s:
            pass
        ended.set()
        thread.join()
        self.assertEqual((said, s.time), ([baum.Status.OK], 1))


if __name__ == "__main__":
    unittest.main()
