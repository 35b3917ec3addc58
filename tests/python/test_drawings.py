# SPDX-License-Identifier: BSD-3-Clause
"""Drawings of mechanisms and pages of runs: what Python hands over. tests/unit/test_draw.c tests what
is drawn, tests/browser how pages work."""

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
    """The data of a page."""
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

    def page(self, **options):
        with mock.patch("webbrowser.open") as opened:
            page = self.run_.show(**options)
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

    def test_wrong_choices_are_refused(self):
        with self.assertRaises(KeyError):
            self.run_.show(plots=["A.phi"])
        with self.assertRaises(KeyError):
            self.run_.show(traces=["nobody.pose"])
        with self.assertRaises(baum.Error):
            self.run_.show(traces=["energy"])
        with self.assertRaises(ValueError):
            pickle.loads(pickle.dumps(self.run_)).show()

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

    def test_notebooks_show_it_in_a_frame(self):
        with mock.patch("baum.drawings.is_notebook", return_value=True):
            frame = self.run_.show()._repr_html_()
        self.assertTrue(frame.startswith('<iframe srcdoc="&lt;!DOCTYPE html&gt;'))
        self.assertEqual(frame.count("<"), 2)


if __name__ == "__main__":
    unittest.main()
