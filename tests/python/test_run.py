# SPDX-License-Identifier: BSD-3-Clause
"""What a run came to, on its way to other processes and into tables."""

import copy
import pickle
import unittest
import warnings

import numpy as np

import baum
from mechanisms import slider_crank


def near_singular():
    """A slider-crank with equal links, through its singular configuration."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return slider_crank(l=0.153, e=0.0).simulate(
            np.linspace(0, 2, 21), "rk8", rtol=1e-8, energy_account=True, record=["B.phi", "energy"]
        )


class Pickled(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = near_singular()
        cls.m = cls.run_.mechanism

    def test_parts_carry_the_names_of_joints(self):
        run = self.run_
        parts = [run.counters, *run.near_singular, run.energy_account, baum.Event(1.0, 0, -1)]
        self.assertTrue(run.near_singular)
        for part in parts:
            with self.subTest(type(part).__name__):
                back = pickle.loads(pickle.dumps(part))
                self.assertIs(type(back), type(part))
                for name, value, mine in zip(part._fields, back, part):
                    if isinstance(mine, baum.Joint):
                        self.assertEqual(self.m[value], mine, name)
                    else:
                        np.testing.assert_equal(value, mine, name)

    def test_deep_copies_keep_handles(self):
        counters = copy.deepcopy(self.run_.counters)
        self.assertEqual(counters, self.run_.counters)
        again = copy.deepcopy(self.run_)
        self.assertIs(again.mechanism, self.m)
        again.q[:] = 0
        self.assertEqual(abs(again["q"]).max(), 0)
        self.assertGreater(abs(self.run_.q).max(), 0)

    def test_a_run_comes_back_whole(self):
        run, back = self.run_, pickle.loads(pickle.dumps(self.run_))
        back = pickle.loads(pickle.dumps(back))
        self.assertIsNone(back.mechanism)
        self.assertEqual((list(back), back.status, back.explain), (list(run), run.status, run.explain))
        self.assertEqual([str(w) for w in back.warnings], [str(w) for w in run.warnings])
        for key in (*run, "slider.pose", "crank.velocity", self.m["B"].phi):
            np.testing.assert_array_equal(back[key], run[key])
        for key in "nobody.pose", "ground.pose", "B.pose", "energy_account":
            self.assertNotIn(key, back)
            self.assertNotIn(key, run)


class Tables(unittest.TestCase):
    def test_columns_have_names(self):
        m = slider_crank(omega=10.0)
        run = m.simulate([0, 0.1], "rk4", step=1e-2, record=["motor.effort", "B.phi"])
        table = run.to_dict()
        self.assertEqual(list(table)[:2], ["t", "q[0]"])
        self.assertEqual(list(table)[-3:], ["motor.effort", "B.phi[0]", "B.phi[1]"])
        self.assertEqual(len(table), 1 + 9 + 9 + 3)
        np.testing.assert_array_equal(table["B.phi[1]"], run["B.phi"][:, 1])

    def test_a_run_is_not_taken_for_one_array(self):
        run = slider_crank().simulate([0], "rk4", step=1e-2)
        with self.assertRaisesRegex(TypeError, r"pandas.DataFrame\(run.to_dict\(\)\)"):
            np.asarray(run)  # what pandas.DataFrame(run) does


if __name__ == "__main__":
    unittest.main()
