# SPDX-License-Identifier: BSD-3-Clause
"""Tests what Python passes on for drawings of mechanisms and pages of runs. tests/unit/test_draw.c
tests what is drawn, and tests/browser tests how pages work."""

import json
import os
import pickle
import tempfile
import unittest
import xml.etree.ElementTree
from unittest import mock

import numpy as np

import baum
from mechanisms import slider_crank


def data_of(page):
    """Return the data that a page contains."""
    text = str(page).split('<script type="application/json" id="data">')[1].split("</script>")[0]
    return json.loads(text)


class Drawings(unittest.TestCase):
    def test_a_design_is_drawn_before_freezing_and_after(self):
        m = baum.Mechanism()
        rod = m.planar_body('<rod> & "co"', mass=1, inertia=0.1, position=(0.5, 0))
        m.revolute("pin", m.ground, rod, point=(0, 0))
        before = str(m.draw())
        titles = [e.text for e in xml.etree.ElementTree.fromstring(before).iter() if "title" in e.tag]
        self.assertIn('<rod> & "co"', titles)
        self.assertIn("pin", titles)
        self.assertEqual(str(m.freeze().draw()), before)
        self.assertEqual(m.draw()._repr_svg_(), before)

    def test_notebooks_show_a_mechanism_with_its_drawing(self):
        m = slider_crank()
        self.assertTrue(m._repr_html_().startswith(str(m.draw()) + "<table>"))
        self.assertTrue(baum.Mechanism()._repr_html_().startswith("<table>"))

    def test_positions_are_drawn(self):
        m = slider_crank()
        q = m.simulate([0, 0.1], "rk4", step=1e-3).q
        self.assertNotEqual(str(m.draw(q[0])), str(m.draw(q[1])))
        with self.assertRaises(ValueError):
            m.draw([1.0])

    def test_it_is_saved(self):
        drawing = slider_crank().draw()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.svg")
            drawing.save(path)
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), str(drawing))


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.m = slider_crank()
        record = ["B.reaction", "slider.velocity", "energy"]
        cls.run_ = cls.m.simulate(np.linspace(0, 0.5, 51), "rk4", step=1e-3, record=record)

    def page(self, run=None, **options):
        with mock.patch("webbrowser.open") as opened:
            page = (run or self.run_).show(**options)
            address = opened.call_args[0][0]
        os.remove(address[len("file://") :])
        return page

    def test_by_default_it_plots_what_is_recorded_and_shows_reactions(self):
        data = data_of(self.page(title="T </script>"))
        self.assertEqual(data["title"], "T </script>")
        self.assertEqual(data["frames"], 51)
        self.assertEqual([r["joint"] for r in data["reactions"]], ["B"])
        labels = [plot["label"] for plot in data["plots"]]
        self.assertEqual(labels[0], "slider.velocity[0] [m/s]")
        self.assertEqual(labels[-1], "energy[1] [J]")
        self.assertEqual(len(labels), 5)

    def test_traces_forces_and_plots_are_chosen(self):
        rod = self.m["rod"]
        traces = [rod, rod.pose_of((0.1, 0)), "slider.pose"]
        data = data_of(self.page(traces=traces, forces=False, plots=["slider.pose"]))
        self.assertEqual([trace["point"] for trace in data["traces"]], [[0, 0, 0], [0.1, 0, 0], [0, 0, 0]])
        self.assertEqual(data["reactions"], [])
        self.assertEqual(len(data["plots"]), 3)
        values = data["ranges"][data["plots"][0]["column"]]
        x = self.run_["slider.pose"][:, 0]
        np.testing.assert_allclose(values, [x.min(), x.max()], rtol=1e-8)

    def test_keys_of_the_description_stay(self):
        drawing = data_of(self.page())["drawing"]
        self.assertEqual(drawing["version"], 1)
        self.assertLessEqual({"unit", "spatial", "gravity", "bodies", "shapes"}, set(drawing))
        self.assertLessEqual({"name", "kind", "q"}, set(drawing["bodies"][0]))
        shape = {"style", "form", "body", "other", "element", "radius", "points"}
        self.assertLessEqual(shape, set(drawing["shapes"][0]))

    def test_one_name_need_not_be_in_a_list(self):
        data = data_of(self.page(traces="rod", forces="B.reaction", plots="slider.pose", title=5))
        self.assertEqual([len(data[key]) for key in ("traces", "reactions", "plots")], [1, 1, 3])
        self.assertEqual(data["title"], "5")

    def test_wrong_choices_are_refused(self):
        with self.assertRaisesRegex(ValueError, "no samples"):
            self.m.simulate([], "rk4", step=1e-3).show()
        with self.assertRaises(KeyError):
            self.run_.show(plots=["A.phi"])
        with self.assertRaises(KeyError):
            self.run_.show(traces=["nobody.pose"])
        with self.assertRaises(baum.Error):
            self.run_.show(traces=["energy"])

    def test_a_pickled_run_has_the_same_page(self):
        back = pickle.loads(pickle.dumps(self.run_))
        pages = [data_of(self.page(run, traces="rod")) for run in (back, self.run_)]
        self.assertEqual(*pages)

    def test_warnings_are_marked(self):
        with self.assertWarns(baum.Warning):
            run = slider_crank(l=0.153, e=0.0).simulate(np.linspace(0, 2, 21), "rk8", rtol=1e-8)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.html")
            run.page(path)
            with open(path, encoding="utf-8") as file:
                marks = data_of(file.read())["marks"]
        self.assertEqual({mark["kind"] for mark in marks}, {"warning", "singular"})
        for mark in marks:
            self.assertEqual(mark["kind"] == "singular", mark["text"].startswith("near a singular configuration"))

    def test_a_failure_is_marked_where_the_run_stopped(self):
        m = baum.Mechanism()
        body = m.planar_body("body", mass=1, inertia=1)
        m.force("push", [body], lambda t, q, v: [float("nan") if t > 0.3 else 0.0, 0, 0])
        with self.assertRaises(baum.Error) as caught:
            m.freeze().simulate(np.linspace(0, 1, 11), "rk4", step=1e-2)
        run = caught.exception.run
        with mock.patch("webbrowser.open", return_value=True) as opened:
            marks = data_of(run.show())["marks"]
        os.remove(opened.call_args[0][0].removeprefix("file://"))
        self.assertEqual((marks[-1]["t"], marks[-1]["kind"]), (run.t[-1], "warning"))
        self.assertIn("push", marks[-1]["text"])

    def test_notebooks_show_it_in_a_frame(self):
        with mock.patch("baum.drawings.is_notebook", return_value=True):
            frame = self.run_.show()._repr_html_()
        self.assertTrue(frame.startswith('<iframe srcdoc="&lt;!DOCTYPE html&gt;'))
        self.assertEqual(frame.count("<"), 2)

    def test_it_says_where_the_page_is_without_a_browser(self):
        with mock.patch("webbrowser.open", return_value=False) as opened:
            with self.assertWarnsRegex(UserWarning, r"the page is .*\.html") as caught:
                self.run_.show()
        self.assertEqual(caught.filename, __file__)
        os.remove(opened.call_args[0][0].removeprefix("file://"))


class Motions(unittest.TestCase):
    """Pages of motions that are given as arrays."""

    def setUp(self):
        self.m = slider_crank()
        self.t = np.linspace(0, 1, 11)
        self.q = np.tile(self.m.simulate([0], "rk4", step=1e-3).q[0], (11, 1))
        self.q[:, 0] = 3 * self.t

    def test_it_shows_them(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.html")
            page = self.m.page(self.t, self.q, path, title="T", traces=["rod.pose"],
                               plots={"x [m]": self.q[:, 0]}, marks=[(0.5, "half")])
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), str(page))
        data = data_of(page)
        self.assertEqual((data["title"], data["frames"], len(data["traces"])), ("T", 11, 1))
        self.assertEqual([plot["label"] for plot in data["plots"]], ["x [m]"])
        self.assertEqual(data["ranges"][data["plots"][0]["column"]], [0, 3])
        self.assertEqual(data["marks"], [{"t": 0.5, "kind": "event", "text": "half"}])

    def test_small_motions_far_away_keep_their_digits(self):
        self.q[:, 0] = 5.4e6 + 1e-3 * self.t
        t = 1.7e9 + self.t
        ranges = data_of(self.m.page(t, self.q))["ranges"]
        self.assertEqual(ranges[0], [t[0], t[-1]])
        self.assertEqual(ranges[1], [self.q[0, 0], self.q[-1, 0]])

    def test_a_long_motion_keeps_600_samples(self):
        t = np.linspace(0, 1, 5001)
        self.assertEqual(data_of(self.m.page(t, np.tile(self.q[0], (5001, 1))))["frames"], 600)

    def test_wrong_arrays_are_refused(self):
        for t, q in ((self.t[1:], self.q), (self.t, self.q[:, 1:]), (0 * self.t, self.q)):
            with self.assertRaises(ValueError):
                self.m.page(t, q)
        with self.assertRaises(ValueError):
            self.m.page(self.t, self.q, plots={"x": [1]})
        with self.assertRaises(TypeError):
            self.m.page(self.t, self.q, marks=[("now", "text")])


if __name__ == "__main__":
    unittest.main()
