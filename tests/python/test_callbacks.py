# SPDX-License-Identifier: BSD-3-Clause
"""Tests user functions: their values, shapes and exceptions, and compiled functions."""

import ctypes
import sys
import unittest

import numpy as np

import baum
from compiler import CC, Folder
from mechanisms import circle, pendulum

SUNDIALS = baum.has("sundials")


def evaluate(phi, rows=1):
    """Return Phi of a particle at (3, 4), computed by the given function."""
    m = baum.Mechanism()
    bob = m.planar_particle("bob", position=(3, 4))
    m.constraint("c", [bob], rows=rows, phi=phi)
    return baum.Workspace(m.freeze()).phi(0.5, (3, 4))


class Values(unittest.TestCase):
    def test_numbers_of_all_sorts_are_taken(self):
        for value in (
            7,
            7.0,
            np.float64(7),
            np.float32(7),
            np.array(7.0),
            np.array([7]),
            [7],
            (7.0,),
            [[7]],
        ):
            np.testing.assert_array_equal(evaluate(lambda t, q: value), [7.0])

    def test_several_rows_are_taken(self):
        for value in (
            (1, 2),
            [1.0, 2.0],
            np.array([1.0, 2.0]),
            np.array([1, 2]),
            np.array([[1.0], [2.0]]),
            np.array([1.0, 9.0, 2.0, 9.0])[::2],
        ):
            np.testing.assert_array_equal(evaluate(lambda t, q: value, rows=2), [1.0, 2.0])

    def test_time_and_positions_arrive(self):
        seen = []
        evaluate(lambda t, q: seen.append((t, q.tolist())) or 0.0)
        self.assertIn((0.5, [3.0, 4.0]), seen)

    def test_arguments_cannot_be_written_to(self):
        def phi(t, q):
            q[0] = 1
            return 0.0

        with self.assertRaisesRegex(ValueError, "read-only"):
            evaluate(phi)

    def test_wrong_shapes_are_refused_by_name(self):
        for value, rows, words in (
            (
                (1, 2, 3),
                2,
                r'joint "c": phi must return an array of shape \(2,\), not one of shape \(3,\)',
            ),
            (1.0, 2, r"phi must return an array of shape \(2,\), not one of shape \(\)"),
            ([[1, 2], [3, 4]], 2, r"not one of shape \(2, 2\)"),
            ((1, 2), 1, r"phi must return a number, not one of shape \(2,\)"),
            ([1, [2, 3]], 2, r"must return an array of shape \(2,\), not \[1, \[2, 3\]\]"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                evaluate(lambda t, q: value, rows)

    def test_what_is_no_number_is_refused_by_name(self):
        for value in (None, "7", 1j, [None], {}):
            with self.assertRaisesRegex(TypeError, 'joint "c": phi must return a number, not '):
                evaluate(lambda t, q: value)

    def test_matrices_have_their_shape(self):
        def body(mass):
            m = baum.Mechanism()
            m.coordinates("x", 2, mass=mass, force=lambda t, q, v: (0, 0))
            return baum.Workspace(m.freeze()).mass(0, (0, 0))

        np.testing.assert_array_equal(body(lambda t, q: [[2, 1], [1, 3]]), [[2, 1], [1, 3]])
        with self.assertRaisesRegex(
            ValueError, r'body "x": mass must return an array of shape \(2, 2\)'
        ):
            body(lambda t, q: [1, 1])

    @staticmethod
    def swing(**changed):
        """A pendulum whose angle is represented by (cos, sin)."""

        def move(h, v, q):
            c, s = np.cos(h * v[0]), np.sin(h * v[0])
            return q[0] * c - q[1] * s, q[1] * c + q[0] * s

        functions = dict(
            mass=lambda t, q: 2.0,
            force=lambda t, q, v: -9.81 * q[0],
            rate=lambda q, v: (-q[1] * v[0], q[0] * v[0]),
            move=move,
            difference=lambda a, b: np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b),
            normalize=lambda q: q / np.hypot(*q),
        )
        m = baum.Mechanism()
        m.coordinates(
            "swing", 1, position_count=2, q=(1.0, 0.0), v=[-1.0], **{**functions, **changed}
        )
        return m.freeze()

    def test_positions_need_not_be_a_vector(self):
        m = self.swing()
        self.assertEqual((m["swing"].nq, m["swing"].nv), (2, 1))
        run = m.simulate([0.0, 1.0], "rk8", step=0.01)
        plain = baum.Mechanism()
        plain.coordinates(
            "swing",
            1,
            v=[-1.0],
            mass=lambda t, q: 2.0,
            force=lambda t, q, v: -9.81 * np.cos(q[0]),
        )
        angle = plain.freeze().simulate([0.0, 1.0], "rk8", step=0.01).q[:, 0]
        np.testing.assert_allclose(run.q, np.c_[np.cos(angle), np.sin(angle)], atol=1e-12)
        workspace = baum.Workspace(m)
        np.testing.assert_array_equal(workspace.rate((0.6, 0.8), [2.0]), (-1.6, 1.2))
        moved = workspace.move([0.3], (1.0, 0.0))
        np.testing.assert_allclose(moved, (np.cos(0.3), np.sin(0.3)), atol=1e-15)
        np.testing.assert_allclose(workspace.difference((1.0, 0.0), moved), [0.3], atol=1e-15)

    def test_functions_of_a_manifold_get_arrays_of_their_sizes(self):
        seen = {}

        def record(name, function):
            def call(*arguments):
                seen[name] = [np.shape(one) for one in arguments]
                return function(*arguments)

            return call

        plain = dict(
            rate=lambda q, v: (-q[1] * v[0], q[0] * v[0]),
            move=lambda h, v, q: (
                q[0] * np.cos(h * v[0]) - q[1] * np.sin(h * v[0]),
                q[1] * np.cos(h * v[0]) + q[0] * np.sin(h * v[0]),
            ),
            difference=lambda a, b: np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b),
            normalize=lambda q: q / np.hypot(*q),
        )
        m = self.swing(**{name: record(name, function) for name, function in plain.items()})
        m.simulate([1.0], "rk4", step=0.1)
        sizes = dict(rate=[(2,), (1,)], move=[(), (1,), (2,)], difference=[(2,), (2,)])
        self.assertEqual(seen, {**sizes, "normalize": [(2,)]})

    def test_an_exception_of_a_manifold_is_the_cause(self):
        def rate(q, v):
            raise LookupError("lost")

        m = self.swing(rate=rate)
        with self.assertRaises(baum.Error) as caught:
            m.simulate([1.0], "rk4", step=0.01)
        self.assertIsInstance(caught.exception.__cause__, LookupError)

    def test_a_single_row_of_a_jacobian_may_be_flat(self):
        m = pendulum(jacobian=lambda t, q: 2 * q)
        np.testing.assert_array_equal(baum.Workspace(m).jacobian(0, (3, 4)), [[6, 8]])

    def test_a_driver_follows_a_python_law(self):
        m = baum.Mechanism()
        crank = m.planar_body("crank", position=(1, 0))
        pin = m.revolute("pin", m.ground, crank, point=(0, 0))
        m.driver("motor", pin, law=lambda t: (np.sin(t), np.cos(t), -np.sin(t)))
        run = m.freeze().simulate([1.0], "rk4", step=1e-3)
        self.assertAlmostEqual(run["crank.pose"][0, 2], np.sin(1.0), 9)

    def test_forces_get_positions_and_velocities_of_their_bodies(self):
        m = baum.Mechanism(gravity=(0, 0))
        m.planar_body("first")
        second = m.planar_particle("second", mass=1, position=(1, 0), velocity=(0, 0))
        m.force("spring", [second], lambda t, q, v: -q - 0 * v)
        run = m.freeze().simulate([np.pi], "rk4", step=np.pi / 1000)
        np.testing.assert_allclose(run["second.pose"][0], [-1, 0], atol=1e-9)

    def test_arguments_that_are_stored_change_in_later_calls(self):
        seen = []
        m = pendulum(lambda t, q: seen.append((q, q.copy())) or q @ q - 1)
        m.simulate([0.5], "rk4", step=1e-3)
        self.assertTrue(any((view != copy).any() for view, copy in seen))


class Costs(unittest.TestCase):
    def calls(self, **functions):
        """Return how often a step of rk4 calls the given functions of a pendulum."""
        calls = []

        def counted(function):
            return lambda *arguments: calls.append(0) or function(*arguments)

        m = pendulum(**{name: counted(function) for name, function in functions.items()})
        s = m.simulation("rk4", step=1e-3)
        s.step(10)
        calls.clear()
        s.step(10)
        return len(calls) / 10

    def test_given_derivatives_avoid_most_calls(self):
        """The numbers of this test are in the documentation. tests/bench/bench_python.py prints
        them."""
        plain = self.calls(phi=circle)
        given = self.calls(
            phi=circle, jacobian=lambda t, q: 2 * q, gamma=lambda t, q, v: -2 * (v @ v)
        )
        self.assertTrue(120 <= plain <= 160, plain)
        self.assertTrue(40 <= given <= 60, given)


class Exceptions(unittest.TestCase):
    def failing(self, error, after):
        """A pendulum whose function raises an exception at times after `after`, as soon as the list
        `armed` is not empty."""
        calls, armed = [], []

        def phi(t, q):
            if armed and t > after:
                calls.append(t)
                raise error
            return q @ q - 1

        return pendulum(phi), calls, armed

    def run_until_it_fails(self, error, method="rk4", **options):
        m, calls, armed = self.failing(error, 0.105)
        s = m.simulation(method, **options)
        armed.append(True)
        with self.assertRaises(type(error)) as caught:
            s.advance_to(1.0)
        self.assertIs(caught.exception, error)
        return s, calls

    def test_the_original_exception_is_raised(self):
        error = ZeroDivisionError("of mine")
        _, calls = self.run_until_it_fails(error, step=1e-2)
        self.assertEqual(len(calls), 1, "the run goes on after an exception")
        if sys.version_info >= (3, 11):
            self.assertRegex("".join(error.__notes__), 'baum: .*"circle".*phi')

    def test_it_is_also_raised_when_a_run_is_created(self):
        m, calls, armed = self.failing(ZeroDivisionError(), -1)
        armed.append(True)
        with self.assertRaises(ZeroDivisionError):
            m.simulation("rk4", step=1e-2)

    def test_failures_at_times_that_the_run_never_reaches_are_ignored(self):
        m, calls, armed = self.failing(ZeroDivisionError(), 1.2)
        armed.append(True)
        m.simulate([1.0], "rk4", step=1e-2)

    def test_every_integrator_stops_at_an_exception(self):
        for name, method in baum.integrators().items():
            if name == "kinematics" or not SUNDIALS and not method.fixed_step:
                continue  # kinematics needs a mechanism without degrees of freedom
            with self.subTest(name):
                options = dict(step=1e-2) if method.fixed_step else dict(rtol=1e-6)
                self.run_until_it_fails(ZeroDivisionError(), name, **options)

    def test_the_run_keeps_its_last_good_step(self):
        s, _ = self.run_until_it_fails(KeyError("mine"), step=1e-2)
        # Finite differences in time evaluate the function a little later. The run may therefore
        # fail one step earlier.
        self.assertTrue(0.085 < s.time < 0.105, s.time)
        self.assertAlmostEqual(np.hypot(*s.q), 1, 6)

    def test_a_call_succeeds_after_an_earlier_exception(self):
        fail = [True]

        def phi(t, q):
            if fail[0]:
                raise KeyError("mine")
            return circle(t, q)

        w = baum.Workspace(pendulum(circle).copy(circle=dict(phi=phi)))
        with self.assertRaises(KeyError):
            w.phi(0, (1, 0))
        fail[0] = False
        np.testing.assert_array_equal(w.phi(0, (1, 0)), [0])

    def test_retry_requests_a_smaller_step(self):
        m = pendulum(self.retrying([]))
        with self.assertRaises(baum.Error) as caught:
            m.simulate([1.0], "euler", step=1e-2)
        self.assertEqual(caught.exception.status, baum.Status.ERR_CALLBACK)

    @unittest.skipUnless(SUNDIALS, "no SUNDIALS")
    def test_a_run_continues_after_retries(self):
        refused = []
        m = pendulum(self.retrying(refused, until=3))
        run = m.simulate([1.0], "cvode_bdf", rtol=1e-6)
        self.assertEqual(len(refused), 3)
        self.assertEqual(run.t[-1], 1.0)

    @staticmethod
    def retrying(refused, until=1 << 60):
        def phi(t, q):
            if t > 0.1 and len(refused) < until:
                refused.append(t)
                raise baum.Retry
            return circle(t, q)

        return phi

    def test_a_nan_is_named(self):
        with self.assertRaises(baum.Error) as caught:
            evaluate(lambda t, q: float("nan"))
        self.assertEqual(caught.exception.status, baum.Status.ERR_NOT_FINITE)
        self.assertRegex(str(caught.exception), '"c": phi')

    def test_wrong_derivatives_are_named(self):
        m = pendulum(jacobian=lambda t, q: 3 * q)
        with self.assertRaisesRegex(baum.Error, "circle.*jacobian"):
            m.check_derivatives()
        with self.assertRaisesRegex(baum.Error, "circle.*jacobian"):
            m.simulation("rk4", step=1e-3)
        pendulum(jacobian=lambda t, q: 2 * q, gamma=lambda t, q, v: -2 * v @ v).check_derivatives()

    def test_functions_may_use_the_library(self):
        inner = baum.Workspace(pendulum())
        m = pendulum(lambda t, q: inner.phi(t, q))
        run = m.simulate([0.1], "rk4", step=1e-2)
        self.assertAlmostEqual(np.hypot(*run.q[0]), 1, 6)


COMPILED = """
int circle(double t, const double *q, double *out, void *user);
int circle(double t, const double *q, double *out, void *user)
{
  (void)t;
  out[0] = q[0] * q[0] + q[1] * q[1] - (user ? *(double *)user : 1.0);
  return 0;
}
"""


@unittest.skipUnless(CC, "no C compiler")
class Compiled(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Folder()
        cls.addClassCleanup(folder.cleanup)
        cls.circle = ctypes.CDLL(folder.shared_object(COMPILED)).circle

    def test_function_pointers_and_addresses_are_taken(self):
        class Jitted:
            address = ctypes.cast(self.circle, ctypes.c_void_p).value

            def __call__(self):
                raise AssertionError

        for function in (self.circle, Jitted.address, Jitted()):
            m = pendulum(function)
            self.assertFalse(m.has_python)
            self.assertAlmostEqual(np.hypot(*m.simulate([1.0], "rk4", step=1e-3).q[0]), 1, 9)

    def test_user_is_passed_on_and_kept(self):
        m = pendulum(self.circle, user=ctypes.pointer(ctypes.c_double(25.0)))
        np.testing.assert_array_equal(baum.Workspace(m).phi(0, (3, 4)), [0])

    def test_they_mix_with_python_functions(self):
        m = pendulum(self.circle, jacobian=lambda t, q: 2 * q)
        self.assertTrue(m.has_python)
        m.check_derivatives()

    def test_what_is_no_function_is_refused(self):
        with self.assertRaisesRegex(
            TypeError, "phi: a function or the address of one is wanted, not 'x'"
        ):
            pendulum("x")
        for number in (-1, 0, 3, 4095):  # no addresses of functions: calling them would crash
            with self.assertRaisesRegex(TypeError, f"the address of one is wanted, not {number}$"):
                pendulum(number)


if __name__ == "__main__":
    unittest.main()
