# SPDX-License-Identifier: BSD-3-Clause
"""Tests threads, cancelling, progress and Ctrl-C."""

import contextvars
import os
import signal
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import baum
from baum import _calls, simulation
from mechanisms import circle, pendulum, rod_pendulum, slider_crank

HERE = os.path.dirname(os.path.abspath(__file__))
LONG = 1e9  # [s] duration of a run that is never completed


def long_run():
    return rod_pendulum().simulation("rk4", step=1e-3)


class ShortCalls(unittest.TestCase):
    """Calls that take less than AT_ONCE stay in the calling thread; longer calls are continued in a
    second thread."""

    def test_a_short_run_starts_no_thread(self):
        code = (
            "import threading; from mechanisms import slider_crank; m = slider_crank()\n"
            's = m.simulation("rk4", step=1e-3); s.advance_to(2e-3); m.simulate([1e-3], "rk4", '
            "step=1e-3)\nprint(threading.active_count())"
        )
        done = subprocess.run([sys.executable, "-c", code], cwd=HERE, capture_output=True, text=True)
        self.assertEqual((done.stdout.strip(), done.stderr), ("1", ""))

    def test_it_does_not_matter_where_a_call_is_continued(self):
        m = slider_crank()
        times = np.linspace(0, 0.2, 41)
        for method in ({"integrator": "rk4", "step": 1e-3}, {"integrator": "rk8", "rtol": 1e-7}):
            whole = m.simulate(times, **method)
            moved = m.simulation(**method)
            moved.advance_to(0.2)
            with unittest.mock.patch.object(simulation, "AT_ONCE", 1e-9):
                parts = m.simulate(times, **method)
                again = m.simulation(**method)
                self.assertEqual(again.advance_to(0.2), baum.Status.OK)
            np.testing.assert_array_equal(parts.q, whole.q)
            np.testing.assert_array_equal(again.q, moved.q)
            self.assertEqual(parts.status, baum.Status.OK)
            self.assertEqual(again.message, "")
            counters = (str(run.counters._replace(wall=0)) for run in (parts, whole))
            self.assertEqual(*counters)


class Pool(unittest.TestCase):
    VARIANTS = 1000

    def timed(self, title, make):
        """Return the result of make(), and print the time that each variant takes."""
        begun = time.perf_counter()
        made = make()
        each = (time.perf_counter() - begun) / self.VARIANTS
        print(f"{title}: {1e6 * each:.0f} us for each of {self.VARIANTS} variants", flush=True)
        return np.array(made)

    def test_variants_run_side_by_side(self):
        m = slider_crank()

        def variant(k):
            copy = m.copy(rod=dict(mass=0.038 * (1 + k * 1e-3)), slider=dict(position=(0.45, 0.05)))
            return copy.simulate([0.1], integrator="rk4", step=1e-3)["slider.pose"][-1]

        variants = range(self.VARIANTS)
        alone = self.timed("one after the other", lambda: list(map(variant, variants)))
        with ThreadPoolExecutor(4) as pool:
            together = self.timed("in 4 threads", lambda: list(pool.map(variant, variants)))
        np.testing.assert_array_equal(alone, together)
        self.assertEqual(len(np.unique(alone[:, 0])), self.VARIANTS)

    def test_runs_of_one_mechanism_have_inputs_of_their_own(self):
        m = slider_crank().thawed()
        m.load("motor", "crank", torque=1, input=m.input("torque"))
        m.freeze()

        def run(k):
            s = m.simulation("semi_implicit_euler", step=1e-3)
            for _ in range(20):
                s.set_input("torque", 1e-3 * k * s.get("A.coordinate")[0])
                s.step(5)
            return s.v

        alone = [run(k) for k in range(40)]
        with ThreadPoolExecutor(4) as pool:
            np.testing.assert_array_equal(alone, list(pool.map(run, range(40))))
        self.assertEqual(len(np.unique(alone, axis=0)), 40)

    def test_exceptions_stay_in_their_thread(self):
        def one(k):
            def phi(t, q):
                if k % 2 and t > 0.05:
                    raise KeyError(k)
                return circle(t, q)

            try:
                return (
                    pendulum(phi).simulate([0.1], "rk4", step=1e-2, check_derivatives=False).t[-1]
                )
            except KeyError as error:
                return error.args[0]

        with ThreadPoolExecutor(4) as pool:
            self.assertEqual(
                list(pool.map(one, range(20))), [k if k % 2 else 0.1 for k in range(20)]
            )

    def test_messages_belong_to_their_thread(self):
        def refused(k):
            try:
                rod_pendulum().simulate([1.0], "rk4", step=-k)
            except baum.Error as error:
                return str(error)

        with ThreadPoolExecutor(4) as pool:
            for k, said in zip(range(1, 40), pool.map(refused, range(1, 40))):
                self.assertIn(f"-{k} s", said)

    def test_python_goes_on_during_a_run(self):
        s, others = long_run(), []
        runner = threading.Thread(target=lambda: others.append(s.advance_to(LONG)))
        runner.start()
        for _ in range(100):
            others.append("worked")
        s.cancel()
        runner.join(10)
        self.assertEqual(others, 100 * ["worked"] + [baum.Status.STOP_CANCELLED])

    def test_one_call_at_a_time(self):
        s = long_run()
        runner = threading.Thread(target=s.advance_to, args=(LONG,))
        runner.start()
        try:
            while not s.time:
                time.sleep(0.001)
            with self.assertRaisesRegex(
                baum.Error, "this simulation is in use by another call"
            ) as caught:
                s.step()
            self.assertEqual(caught.exception.status, baum.Status.ERR_STATE)
        finally:
            s.cancel()
            runner.join(10)
        s.step()


class Cancelled(unittest.TestCase):
    def test_progress_receives_the_time_and_can_cancel(self):
        times = []

        def progress(t):
            times.append(t)
            return len(times) == 3

        s = rod_pendulum().simulation("rk4", step=1e-3, progress_interval=0)
        self.assertEqual(s.advance_to(1.0, progress=progress), baum.Status.STOP_CANCELLED)
        self.assertEqual(len(times), 3)
        self.assertAlmostEqual(s.time, times[-1])
        self.assertEqual(s.advance_to(1.0), baum.Status.OK)
        self.assertEqual(len(times), 3)

    def test_progress_may_be_an_option_and_comes_by_wall_time(self):
        times = []
        rod_pendulum().simulate(
            [0.5], "rk4", step=1e-4, progress=times.append, progress_interval=60
        )
        self.assertEqual(times, [])
        rod_pendulum().simulate([0.5], "rk4", step=1e-2, progress=times.append, progress_interval=0)
        self.assertGreaterEqual(len(times), 50)

    def test_a_cancelled_run_ends_early(self):
        run = rod_pendulum().simulate(
            np.linspace(0, 1, 11),
            "rk4",
            step=1e-3,
            progress=lambda t: t > 0.45,
            progress_interval=0,
        )
        self.assertEqual(run.status, baum.Status.STOP_CANCELLED)
        np.testing.assert_allclose(run.t, [0, 0.1, 0.2, 0.3, 0.4])
        self.assertEqual(run.q.shape, (5, 2))

    def test_exceptions_in_progress_are_raised(self):
        def progress(t):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            rod_pendulum().simulate([1.0], "rk4", step=1e-3, progress=progress, progress_interval=0)


class Tasks(unittest.TestCase):
    def test_a_call_withdrawn_before_its_worker_began_is_not_made(self):
        made = []
        task = _calls._Task(made.append, (1,))
        _calls._come_back(task, None)
        task.run()
        self.assertEqual(made, [])
        self.assertFalse(task.finished)

    def test_a_call_is_made_once(self):
        made = []
        task = _calls._Task(made.append, (1,))
        task.run()
        task.run()
        _calls._come_back(task, None)
        self.assertEqual(made, [1])


# Programs that a shell starts in the background ignore SIGINT. The program below therefore sets a
# handler.
INTERRUPTED = """
import signal, sys, threading, time
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.path.insert(0, {here!r})
import baum
from mechanisms import *

{setup}
try:
    print("ready", flush=True)
    {call}
    print("came to its end")
except KeyboardInterrupt:
    print("interrupted", {after})
"""


@unittest.skipUnless(hasattr(signal, "SIGINT") and os.name == "posix", "no signals")
class Interrupted(unittest.TestCase):
    def interrupt(self, setup, call, after="s.time > 0", times=1):
        """Return the output of a program. It receives SIGINT as soon as it has printed that it is
        ready."""
        program = INTERRUPTED.format(here=HERE, setup=setup, call=call, after=after)
        child = subprocess.Popen(
            [sys.executable, "-c", program],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            self.assertEqual(
                child.stdout.readline(), "ready\n", child.poll() and child.stderr.read()
            )
            for _ in range(times):
                time.sleep(0.3)
                child.send_signal(signal.SIGINT)
            said, errors = child.communicate(timeout=20)
        finally:
            child.kill()
            child.communicate()
        self.assertEqual((errors, child.returncode), ("", 0))
        return said.strip()

    def test_a_long_run_without_python_functions(self):
        self.assertEqual(
            "interrupted True",
            self.interrupt('s = rod_pendulum().simulation("rk4", step=1e-3)', "s.advance_to(1e9)"),
        )

    def test_many_steps(self):
        self.assertEqual(
            "interrupted True",
            self.interrupt(
                's = rod_pendulum().simulation("rk4", step=1e-3); s.step(10)', "s.step(10**10)"
            ),
        )

    def test_runs_that_ask_again_and_again(self):
        self.assertEqual(
            "interrupted True",
            self.interrupt(
                's = rod_pendulum().simulation("rk8", rtol=1e-6)',
                "while True: s.advance_to(s.time + 0.01)",
            ),
        )

    def test_few_steps_at_a_time(self):
        self.assertEqual(
            "interrupted True",
            self.interrupt(
                's = rod_pendulum().simulation("rk4", step=1e-3)', "while True: s.step(10)"
            ),
        )

    def test_sampling(self):
        self.assertEqual(
            "interrupted",
            self.interrupt("m = rod_pendulum()", 'm.simulate([1e9], "rk4", step=1e-3)', '""'),
        )

    def test_python_functions(self):
        self.assertEqual(
            "interrupted True",
            self.interrupt('s = pendulum().simulation("rk4", step=1e-3)', "s.advance_to(1e9)"),
        )

    def test_the_run_can_go_on(self):
        self.assertEqual(
            "interrupted Status OK",
            self.interrupt(
                's = rod_pendulum().simulation("rk4", step=1e-3)',
                "s.advance_to(1e9)",
                '"Status", s.advance_to(s.time + 1)',
            ),
        )

    def test_a_function_that_hangs_is_left_behind_by_the_second(self):
        setup = """
def phi(t, q):
    if armed:
        threading.Event().wait(1000)
    return circle(t, q)

armed = []
s = pendulum(phi).simulation("rk4", step=1e-3)
armed.append(True)"""
        after = 'rod_pendulum().simulate([1.0], "rk4", step=1e-3).t[-1], bool(s._owner._users)'
        self.assertEqual(
            "interrupted 1.0 True", self.interrupt(setup, "s.advance_to(1.0)", after, times=2)
        )


class SecondThread(unittest.TestCase):
    def test_functions_see_the_callers_context(self):
        variable = contextvars.ContextVar("variable", default="outside")
        seen = set()
        m = pendulum(lambda t, q: seen.add(variable.get()) or circle(t, q))
        seen.clear()
        variable.set("inside")
        m.simulate([0.1], "rk4", step=1e-2)
        self.assertEqual(seen, {"inside"})

    @unittest.skipUnless(hasattr(os, "fork"), "no fork")
    def test_a_forked_child_has_its_own(self):
        m = rod_pendulum()
        m.simulate([0.1], "rk4", step=1e-3)
        program = (
            "import os, sys; sys.path.insert(0, sys.argv[1])\nfrom mechanisms import rod_pendulum\n"
            "m = rod_pendulum()\nrun = lambda: m.simulate([0.1], 'rk4', step=1e-3)\nrun()\n"
            "child = os.fork()\nrun()\n"
            "if child: sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
        )
        subprocess.run(
            [sys.executable, "-W", "ignore::DeprecationWarning", "-c", program, HERE],
            check=True,
            timeout=30,
        )

    def test_results_and_exceptions_pass(self):
        self.assertEqual(_calls.interruptible(max, 1, 2), 2)
        with self.assertRaises(ZeroDivisionError):
            _calls.interruptible(lambda: 1 / 0)


if __name__ == "__main__":
    unittest.main()
