# SPDX-License-Identifier: BSD-3-Clause
"""Tests events, schedules of inputs and saved states in Python. C tests cover everything else about
events, schedules and saved states."""

import math
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np

import baum
from mechanisms import pendulum


def wheel(inertia=1.0):
    """A body on a pin without gravity. The input "torque" accelerates it."""
    m = baum.Mechanism(gravity=(0, 0))
    body = m.planar_body("wheel", mass=1, inertia=inertia, position=(0, 0))
    m.revolute("pin", m.ground, body, point=(0, 0))
    m.load("motor", body, torque=1, input=m.input("torque"))
    return m.freeze()


def turning(rate=2.0):
    """A wheel that rotates at a constant angular velocity."""
    return wheel().copy(wheel=dict(angular_velocity=rate))


class Events(unittest.TestCase):
    def test_a_run_stops_at_a_coordinate_and_goes_on(self):
        for method in ({"step": 1e-2}, {"rtol": 1e-8}):
            s = turning().simulation("rk8", **method)
            self.assertEqual(s.event("pin", 1.0, name="one"), 0)
            self.assertEqual(s.advance_to(2), baum.Status.STOP_EVENT)
            # the angle is a linear function of time, so only rounding errors remain
            self.assertAlmostEqual(s.time, 0.5, 13)
            self.assertIn('event 0 "one", rising', s.message)
            self.assertEqual(s.advance_to(2), baum.Status.OK)
            (event,) = s.events
            self.assertEqual((event.event, event.direction, event.name), (0, 1, "one"))
            t, number, direction = event
            self.assertEqual((t, number, direction), (event.t, 0, 1))
            back = pickle.loads(pickle.dumps(event))
            self.assertEqual((back, back.name), (event, "one"))
            self.assertRegex(repr(event), r"^Event\(t=0.*, event=0, direction=1, name='one'\)$")
            self.assertAlmostEqual(event.t, 0.5, 13)

    def test_a_pendulum_bounces(self):
        s = pendulum().simulation("rk8", rtol=1e-10)
        s.event(function=lambda t, q, v: q[0], direction=-1)
        times = []
        for _ in range(3):
            self.assertEqual(s.advance_to(9), baum.Status.STOP_EVENT)
            times.append(s.time)
            s.set_state(s.time, s.q, -s.v)
        # The pendulum needs a quarter of the period from the horizontal to the bottom. This time is
        # K(1/sqrt 2) sqrt(l/g). After each bounce it needs half of the period to return to the
        # bottom.
        quarter = 1.8540746773013719 / math.sqrt(9.81)
        np.testing.assert_allclose(times, [quarter, 3 * quarter, 5 * quarter], rtol=1e-7)
        self.assertEqual([event.direction for event in s.events], [-1, -1, -1])

    def test_those_that_do_not_stop_are_in_the_run(self):
        s = turning().simulation("rk4", step=1e-2)
        s.event("pin", 0.5, terminal=False)
        s.event(function=lambda t, q, v: t - 0.75, terminal=False, name="rest")
        run = s.sample([0, 1])
        self.assertEqual([event.event for event in run.events], [0, 1])
        self.assertEqual([event.name for event in run.events], ["event 0", "rest"])
        self.assertEqual([event.name for event in pickle.loads(pickle.dumps(run)).events][1], "rest")
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "run.html"
            run.page(page)
            self.assertTrue('"rest"' in page.read_text(encoding="utf-8"))
        np.testing.assert_allclose([event.t for event in run.events], [0.25, 0.75], rtol=1e-12)
        self.assertEqual(run.near_singular, [])

    def test_samples_end_where_it_stops(self):
        s = turning().simulation("rk8", rtol=1e-8)
        s.event("pin", 1.0)
        run = s.sample(np.linspace(0, 1, 11))
        self.assertEqual(run.status, baum.Status.STOP_EVENT)
        self.assertEqual(len(run.t), 5)
        self.assertLess(abs(s.time - 0.5), 1e-12)

    def test_exceptions_are_raised_and_the_run_continues(self):
        armed = [True]

        def record(t, q, v):
            if armed and t > 0.3:
                raise KeyError("record")
            return 1.0

        s = turning().simulation("rk8", rtol=1e-8)
        s.event(function=record)
        with self.assertRaisesRegex(KeyError, "record"):
            s.advance_to(1)
        self.assertLess(s.time, 1)
        armed.clear()
        s.advance_to(1)
        self.assertAlmostEqual(s.q[2], 2.0, 12)

    def test_what_makes_no_sense_is_refused(self):
        s = turning().simulation("rk4", step=1e-2)
        with self.assertRaisesRegex(baum.Error, "neither function"):
            s.event()
        with self.assertRaisesRegex(TypeError, "name: a string is wanted, not 3"):
            s.event("pin", name=3)
        with self.assertRaisesRegex(baum.Error, "direction"):
            s.event("pin", direction=2)
        with self.assertRaisesRegex(TypeError, "value: a number is wanted"):
            s.event("pin", "high")


class Schedules(unittest.TestCase):
    def test_an_input_jumps_at_its_times(self):
        for method in ({"step": 1e-2}, {"rtol": 1e-8}):
            s = wheel().simulation("rk8", energy_account=True, **method)
            s.schedule_input("torque", [0.25, 0.753], [4, -1])
            self.assertEqual(s.inputs, {"torque": 0.0})
            s.advance_to(1)
            self.assertEqual(s.inputs, {"torque": -1.0})
            rate = 4 * 0.503 - 0.247
            self.assertAlmostEqual(s.v[2], rate, 12)
            self.assertAlmostEqual(s.energy_account.loads, rate**2 / 2, 11)
            s.advance_to(0.1)
            self.assertAlmostEqual(s.v[2], 0.0, 11)

    def test_it_goes_with_the_run(self):
        m = wheel()
        s = m.simulation("rk8", rtol=1e-8)
        s.schedule_input(m["torque"], 0.5, 1.0)
        saved = s.save()
        s.set_input("torque", 7)
        s.advance_to(1)
        s.restore(saved)
        self.assertEqual((s.time, s.inputs["torque"]), (0.0, 0.0))
        other = m.simulation("rk4", step=1e-2)
        other.continue_from(s)
        for run in (s, other):
            run.advance_to(1)
            self.assertAlmostEqual(run.v[2], 0.5, 12)

    def test_what_makes_no_sense_is_refused_by_name(self):
        s = wheel().simulation("rk4", step=1e-2)
        with self.assertRaisesRegex(ValueError, "torque: values: 2 numbers are wanted, not 1"):
            s.schedule_input("torque", [1, 2], [1])
        with self.assertRaisesRegex(baum.Error, r'"torque": times\[1\] is 1 s, must be above'):
            s.schedule_input("torque", [2, 1], [1, 2])
        with self.assertRaisesRegex(baum.Error, r"values\[0\] is nan, must be finite"):
            s.schedule_input("torque", [2], [math.nan])
        self.assertEqual(s.inputs, {"torque": 0.0})


class GoingBack(unittest.TestCase):
    def test_a_controller_tries_and_goes_back(self):
        """Find the angular velocity of the wheel after ten steps of 0.1 s for each of three
        torques. The run goes back to the start after each torque."""
        s = wheel(inertia=0.5).simulation("rk4", step=0.1)
        found = {}
        saved = s.save()
        for torque in (0.5, 1.0, 2.0):
            s.set_input("torque", torque)
            s.step(10)
            found[torque] = s.v[2]
            s.restore(saved)
            self.assertEqual((s.time, s.inputs["torque"]), (0.0, 0.0))
        np.testing.assert_allclose(list(found.values()), [1, 2, 4], rtol=1e-12)

    def test_a_run_that_failed_is_read_and_another_goes_on(self):
        m = baum.Mechanism(gravity=(0, 0))
        ball = m.planar_particle("ball", mass=1, position=(0, 0), velocity=(1, 0))

        def wall(t, q, v):
            if q[0] > 0.5:
                raise baum.Retry
            return (0.0, 0.0)

        m.force("wall", [ball], wall)
        m.freeze()
        s = m.simulation("rk8", rtol=1e-8, energy_account=True)
        with self.assertRaises(baum.Error) as caught:
            s.advance_to(1)
        self.assertLess(caught.exception.status, 0)
        self.assertIn("wall", str(caught.exception))
        self.assertTrue(0 <= s.time <= 0.5)
        self.assertAlmostEqual(s.q[0], s.time, 12)
        self.assertAlmostEqual(s.energy_account.kinetic, 0.5, 12)
        self.assertEqual(s.get("ball.pose").shape, (2,))
        other = m.simulation("rk4", step=1e-2)
        other.continue_from(s)
        other.set_state(other.time, other.q, (-1, 0))
        other.advance_to(1)
        self.assertAlmostEqual(other.q[0], s.time - (1 - s.time), 12)


if __name__ == "__main__":
    unittest.main()
