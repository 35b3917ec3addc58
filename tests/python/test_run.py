# SPDX-License-Identifier: BSD-3-Clause
"""Tests the results of a run: that they can be pickled for other processes, and that they can be
used as tables."""

import copy
import pickle
import sys
import unittest
import warnings
from unittest import mock

import numpy as np

import baum
from mechanisms import slider_crank


def near_singular():
    """Run a slider-crank with links of equal length. It passes a singular configuration."""
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
        self.assertEqual(back.scene, run.scene)
        self.assertEqual(back.mechanism, self.m)
        self.assertEqual((list(back), back.status, back.explain), (list(run), run.status, run.explain))
        self.assertEqual([str(w) for w in back.warnings], [str(w) for w in run.warnings])
        for key in (*run, "slider.pose", "crank.velocity", self.m["B"].phi):
            np.testing.assert_array_equal(back[key], run[key])
        for key in "nobody.pose", "ground.pose", "B.pose", "energy_account":
            self.assertNotIn(key, back)
            self.assertNotIn(key, run)


class Units(unittest.TestCase):
    """Tests that each column has the right unit."""

    def units(self, m, *channels, **options):
        """Return the units of channels, as lists."""
        options = options or {"step": 1e-3}
        run = m.simulate([0, 1e-3], "rk4", record=channels, **options)
        columns = run.columns
        self.assertEqual(list(columns), list(run.to_dict()))
        self.assertEqual(pickle.loads(pickle.dumps(run)).columns, columns)
        return [[columns[name] for name in run._names(channel)] for channel in channels]

    def test_of_planar_mechanisms(self):
        m = slider_crank(omega=10.0)
        force = ["N", "N", "N m"]
        rates = ["m/s", "m/s", "rad/s"]
        for channel, units in (
            ("slider.acceleration", ["m/s^2", "m/s^2", "rad/s^2"]),
            ("B.phi", ["m", "m"]),
            ("guide.phi", ["m", "rad"]),
            ("guide.phi_rate", ["m/s", "rad/s"]),
            ("guide.multipliers", ["N", "N m"]),
            ("guide.coordinate", ["m", "m/s"]),
            ("A.coordinate", ["rad", "rad/s"]),
            ("B.reaction", force),
            ("motor.phi", ["rad"]),
            ("motor.effort", ["N m"]),
            ("energy", ["J", "J"]),
            ("energy_account", ["J"] * 12),
            ("a", ["m/s^2", "m/s^2", "rad/s^2"] * 3),
            ("phi", ["m", "m"] * 3 + ["m", "rad", "rad"]),
            ("lambda", ["N", "N"] * 3 + ["N", "N m", "N m"]),
            ("phi_rate", ["m/s", "m/s"] * 3 + ["m/s", "rad/s", "rad/s"]),
        ):
            with self.subTest(channel):
                found = self.units(m, channel, step=1e-3, energy_account=True)
                self.assertEqual(found, [units])
        run = m.simulate([0], "rk4", step=1e-3)
        self.assertEqual(list(run.columns.values()), ["s", *["m", "m", "rad"] * 3, *rates * 3])

    def test_where_functions_decide_there_are_none(self):
        m = baum.Mechanism()
        m.coordinates("free", 1, mass=lambda t, q: 1, force=lambda t, q, v: 0)
        bob = m.planar_particle("bob", position=(1, 0))
        m.constraint("circle", bob, 1, lambda t, q: q @ q - 1)
        m.freeze()
        found = self.units(m, "free.pose", "circle.phi", "circle.reaction")
        self.assertEqual(found, [[""], [""], ["", ""]])
        self.assertEqual(self.units(m, "bob.acceleration", "lambda"), [["m/s^2"] * 2, [""]])


class Tables(unittest.TestCase):
    def test_columns_have_names(self):
        m = slider_crank(omega=10.0)
        run = m.simulate([0, 0.1], "rk4", step=1e-2, record=["motor.effort", "B.phi"])
        table = run.to_dict()
        self.assertEqual(list(table)[:2], ["t", "q[0]"])
        self.assertEqual(list(table)[-3:], ["motor.effort", "B.phi[0]", "B.phi[1]"])
        self.assertEqual(len(table), 1 + 9 + 9 + 3)
        np.testing.assert_array_equal(table["B.phi[1]"], run["B.phi"][:, 1])

    def test_a_data_frame_has_time_and_units(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas")
        run = slider_crank().simulate([0, 0.1], "rk4", step=1e-2, record="energy")
        frame = run.to_dataframe()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual((frame.index.name, list(frame.index)), ("t", [0, 0.1]))
        self.assertEqual(frame.attrs["units"]["energy[1]"], "J")
        np.testing.assert_array_equal(frame["q[4]"], run.q[:, 4])
        self.assertEqual(set(frame.columns) | {"t"}, set(run.columns))

    def test_without_pandas_the_error_says_what_is_missing(self):
        run = slider_crank().simulate([0], "rk4", step=1e-2)
        with mock.patch.dict(sys.modules, {"pandas": None}):
            self.assertEqual(len(run.to_dict()), 1 + 9 + 9)
            with self.assertRaisesRegex(ImportError, "pip install pandas"):
                run.to_dataframe()

    def test_a_run_is_not_taken_for_one_array(self):
        run = slider_crank().simulate([0], "rk4", step=1e-2)
        with self.assertRaisesRegex(TypeError, r"pandas.DataFrame\(run.to_dict\(\)\)"):
            np.asarray(run)  # pandas.DataFrame(run) makes this call


class Plots(unittest.TestCase):
    def setUp(self):
        self.run_ = slider_crank(omega=10.0).simulate(
            [0, 0.1, 0.2], "rk4", step=1e-2, record=["motor.effort", "energy"]
        )

    def axes(self, *channels, **options):
        """Return the axes that plot() draws, as pairs of the y axis' label and the names of the
        curves."""
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no Matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        self.addCleanup(plt.close, "all")
        places = self.run_.plot(*channels, **options)
        self.assertEqual(places[-1].get_xlabel(), "t [s]")
        return [(one.get_ylabel(), [line.get_label() for line in one.lines]) for one in places]

    def test_each_unit_has_its_axes(self):
        self.assertEqual(self.axes("slider.velocity"), [
            ("slider.velocity [m/s]", ["slider.velocity[0]", "slider.velocity[1]"]),
            ("slider.velocity[2] [rad/s]", ["slider.velocity[2]"]),
        ])
        both = ["crank.pose[0]", "crank.pose[1]", "rod.pose[0]", "rod.pose[1]"]
        m = self.run_.mechanism
        self.assertEqual(self.axes("crank.pose", m["rod"].pose)[0], ("[m]", both))

    def test_what_was_recorded_is_drawn_by_default(self):
        self.assertEqual(self.axes(), [
            ("motor.effort [N m]", ["motor.effort"]), ("energy [J]", ["energy[0]", "energy[1]"]),
        ])
        self.run_ = slider_crank().simulate([0], "rk4", step=1e-2)
        self.assertEqual([label for label, _ in self.axes()], ["q [m]", "q [rad]"])

    def test_axes_can_be_given(self):
        drawn = self.axes("energy")
        import matplotlib.pyplot as plt

        _, axes = plt.subplots()
        self.assertEqual(self.axes("energy", axes=axes), drawn)
        with self.assertRaisesRegex(ValueError, "axes: 2 are wanted, one for each unit, not 1"):
            self.run_.plot("crank.pose", axes=axes)
        with self.assertRaisesRegex(KeyError, "'B.phi' was not recorded"):
            self.run_.plot("B.phi")

    def test_without_matplotlib_the_error_says_what_is_missing(self):
        with mock.patch.dict(sys.modules, {"matplotlib": None, "matplotlib.pyplot": None}):
            with self.assertRaisesRegex(ImportError, "pip install matplotlib"):
                self.run_.plot("energy")


class Notebooks(unittest.TestCase):
    """Tests the representations that notebooks request from objects."""

    def test_tables_are_small_and_escaped(self):
        m = baum.Mechanism()
        name = "<b>&\"rod\""
        m.planar_particle(name, position=(1, 0))
        for _ in range(40):
            m.planar_particle()
        shown = m.freeze()._repr_html_()
        self.assertIn("<td>&lt;b&gt;&amp;&quot;rod&quot;</td><td>planar_particle</td>", shown)
        self.assertIn("and 11 more", shown)
        self.assertEqual(shown.count("<tr>"), 1 + 30 + 1)
        self.assertNotIn("<b>", shown)
        run = m.simulate([0, 0.1], "rk4", step=0.1, record=[m[name].acceleration])
        shown = run._repr_html_()
        self.assertIn("<td>&lt;b&gt;&amp;&quot;rod&quot;.acceleration</td><td>2</td>", shown)
        self.assertIn("<td>m/s^2, m/s^2</td><td>0, -9.81</td>", shown)
        self.assertLess(len(shown), 2000)
        self.assertIn("<table>", run.mechanism.simulate([], "rk4", step=1)._repr_html_())

    def test_a_study_shows_its_front(self):
        m = slider_crank()
        options = dict(samples=2, repeats=1, threads=1, validate=False, progress=False)
        study = baum.study(m, 0, 0.01, **options).add("rk4", step=1e-3)
        self.assertIn("study of 1 entries", study._repr_html_())
        study.run()
        self.assertRegex(study._repr_html_(), "<td>rk4 projection, step 0.001 s</td><td>.*e-")

    def test_keys_are_completed(self):
        m = slider_crank()
        self.assertEqual(m._ipython_key_completions_()[:3], ["ground", "crank", "rod"])
        run = m.simulate([0], "rk4", step=1e-2, record="energy")
        for one in run, pickle.loads(pickle.dumps(run)):
            keys = one._ipython_key_completions_()
            self.assertTrue({"q", "v", "energy", "slider.pose", "rod.velocity"} <= set(keys))
            self.assertTrue(all(key in one for key in keys), keys)

    def test_names_of_the_module_are_listed(self):
        names = dir(baum)
        self.assertTrue({"catalog", "Mechanism", "AccuracyWarning"} <= set(names))
        self.assertTrue(all(hasattr(baum, name) for name in names))


if __name__ == "__main__":
    unittest.main()
