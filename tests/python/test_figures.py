# SPDX-License-Identifier: BSD-3-Clause
"""Tests figures and movies of runs: what they show, positions between samples, and the formats that
Matplotlib writes."""

import io
import os
import pickle
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from unittest import mock

import numpy as np

import baum
from baum import _motion
from mechanisms import pendulum, slider_crank
from test_outlines import FORMS, body_of

try:
    import matplotlib
    from matplotlib import animation
    from PIL import Image
except ImportError:
    matplotlib = None


def saved(drawing, name, **options):
    """Save a drawing, and return the bytes of the file."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name)
        drawing.save(path, **options)
        with open(path, "rb") as file:
            return file.read()


def paths_of(pdf):
    """Return how many lines and how many filled or stroked paths a PDF file has, and its patterns
    of dashes."""
    pages = [zlib.decompress(part) for part in re.findall(rb"stream\r?\n(.*?)endstream", pdf, re.DOTALL)
             if part[:1] == b"x"]
    page = max(pages, key=lambda text: len(re.findall(rb"^[BSf]$", text, re.MULTILINE)))
    found = [re.findall(part, page, re.MULTILINE) for part in (rb"^[\d.-]+ [\d.-]+ l$", rb"^[bBsSf]\*?$")]
    return len(found[0]), len(found[1]), re.findall(rb"\[ ([\d. ]+) \] 0 d", page)


class Figures(unittest.TestCase):
    """Pictures of a run."""

    @classmethod
    def setUpClass(cls):
        cls.m = slider_crank(3)
        cls.run_ = cls.m.simulate(np.linspace(0, 2, 21), "kinematics", record=["B.reaction", "energy"])

    def titles(self, drawing):
        root = xml.etree.ElementTree.fromstring(str(drawing))
        return [e.text for e in root.iter() if e.tag.endswith("title")]

    def test_it_shows_paths_and_reactions_that_are_asked_for(self):
        drawn = self.titles(self.run_.figure(1, traces=["rod.pose"]))
        self.assertIn("path of rod", drawn)
        self.assertIn("reaction of B", drawn)
        drawn = self.titles(self.run_.figure(1, forces=False))
        self.assertFalse([t for t in drawn if t.startswith(("path", "reaction"))])
        self.assertIn("reaction of B", self.titles(self.run_.figure(1, forces=["B.reaction"])))

    def test_reactions_that_were_not_recorded_are_refused(self):
        with self.assertRaises(KeyError):
            self.run_.figure(1, forces=["A.reaction"])
        with self.assertRaisesRegex(ValueError, "not the reaction"):
            self.run_.figure(1, forces=["energy"])
        without = self.m.simulate([0, 1], "kinematics")
        with self.assertRaisesRegex(ValueError, "record="):
            without.figure(1, forces=True)
        without.figure(1)

    def test_positions_between_samples_are_accurate(self):
        fine = self.m.simulate(np.linspace(0, 2, 2001), "kinematics", record=["B.reaction"])
        times = np.array([0.0, 0.512, 0.55, 1.999, 2.0])
        motion = _motion.of_run(self.run_, [], [], None)
        whole, samples = _motion.refined(motion, self.run_, times)
        wanted = fine.q[(1000 * times).round().astype(int)]
        # linear interpolation would have an error of 8e-4
        np.testing.assert_allclose(whole.rows[samples], wanted, atol=2e-5)
        np.testing.assert_array_equal(whole.rows[samples[0]], self.run_.q[0])
        back = self.m.simulate(np.linspace(0, -1, 11), "kinematics")
        whole, samples = _motion.refined(_motion.of_run(back, [], [], None), back, np.array([-0.55]))
        wanted = self.m.simulate([-0.55], "kinematics").q[0]
        np.testing.assert_allclose(whole.rows[samples[0]], wanted, atol=1e-4)

    def test_all_times_have_one_view(self):
        heads = {str(self.run_.figure(t)).split("\n")[0] for t in (0, 0.77, 2)}
        self.assertEqual(len(heads), 1)
        self.assertIn('width="300" height="200" viewBox="0 0 6', str(self.run_.figure(1, size=(300, 200))))

    def test_wrong_times_and_sizes_are_refused(self):
        for t in (-0.1, 2.1, float("nan")):
            with self.assertRaises(ValueError):
                self.run_.figure(t)
        for size in ((0, 100), (100,), (100, float("nan"))):
            with self.assertRaises(ValueError):
                self.run_.figure(1, size=size)

    def test_a_pickled_run_has_the_same_figures(self):
        back = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(self.run_))))
        self.assertEqual(str(back.figure(1, forces=True)), str(self.run_.figure(1, forces=True)))

    def test_other_formats_are_refused(self):
        with self.assertRaisesRegex(ValueError, ".svg, .pdf or .png"):
            self.run_.figure(1).save("x.jpg")

    @unittest.skipUnless(matplotlib, "Matplotlib is missing")
    def test_pdf_has_the_paths_of_the_svg(self):
        drawing = self.run_.figure(1.5, traces=["rod.pose"])
        pdf = saved(drawing, "x.pdf")
        self.assertTrue(pdf.startswith(b"%PDF"))
        text = str(drawing)
        lines, paths, _ = paths_of(pdf)
        self.assertEqual(lines, sum(d.count("L") for d in re.findall(r' d="([^"]*)"', text)))
        self.assertEqual(paths, len(re.findall("<path|<circle", text)))
        self.assertIn(b"/Subtype /Type0", pdf)  # the label of the scale is text

    @unittest.skipUnless(matplotlib, "Matplotlib is missing")
    def test_dashes_stay_dashes(self):
        m = baum.Mechanism()
        wheels = [m.planar_body(f"w{k}", mass=1, inertia=1, position=(k, 0)) for k in (0, 1)]
        pins = [m.revolute(f"p{k}", m.ground, wheel, point=(k, 0)) for k, wheel in enumerate(wheels)]
        m.coupling("gear", *pins, ratio=-1)
        drawing = m.draw()
        self.assertIn('stroke-dasharray="5 4"', str(drawing))
        self.assertEqual(paths_of(saved(drawing, "x.pdf"))[2], [b"3.75 3"])  # [pt]

    @unittest.skipUnless(matplotlib, "Matplotlib is missing")
    def test_outlines_of_all_forms_are_in_the_pdf(self):
        for spatial in (False, True):
            for name, outline in FORMS.items():
                with self.subTest(name, spatial=spatial):
                    drawing = body_of(outline, spatial).mechanism.draw()
                    paths = paths_of(saved(drawing, "x.pdf"))[1]
                    self.assertEqual(paths, len(re.findall("<path|<circle", str(drawing))))

    @unittest.skipUnless(matplotlib, "Matplotlib is missing")
    def test_png_has_the_size_of_the_picture(self):
        drawing = self.run_.figure(1, size=(300, 200))
        with Image.open(io.BytesIO(saved(drawing, "x.png", dpi=48))) as image:
            self.assertEqual(image.size, (150, 100))
            colours = {colour for _, colour in image.convert("RGB").getcolors(10000)}
        self.assertIn((255, 255, 255), colours)
        self.assertIn((0xA9, 0xC9, 0xEC), colours)  # the colour of the crank

    def test_a_missing_matplotlib_is_named(self):
        with mock.patch.dict(sys.modules, {"matplotlib": None, "matplotlib.figure": None}):
            with self.assertRaisesRegex(ImportError, "pip install matplotlib"):
                self.run_.figure(1).save("x.pdf")
            with self.assertRaisesRegex(ImportError, "pip install matplotlib"):
                self.run_.movie("x.gif")


@unittest.skipUnless(matplotlib, "Matplotlib is missing")
class Movies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = slider_crank(3).simulate(np.linspace(0, 1, 11), "kinematics")

    def test_a_gif_shows_the_motion_in_its_time(self):
        seen = []
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.gif")
            self.run_.movie(path, fps=10, speed=0.5, size=(160, 120), progress=seen.append)
            with Image.open(path) as gif:
                self.assertEqual((gif.n_frames, gif.size, gif.info["duration"]), (21, (160, 120), 100))
                first = np.asarray(gif.convert("RGB"), float)
                gif.seek(20)
                moved = np.abs(np.asarray(gif.convert("RGB"), float) - first)
        self.assertGreater(np.mean(moved > 50), 0.01)
        np.testing.assert_allclose(seen, np.linspace(0, 1, 21), atol=1e-12)

    def test_rates_that_a_gif_cannot_have_are_rounded(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.gif")
            seen = []
            self.run_.movie(path, fps=30, size=(80, 60), progress=seen.append)
            with Image.open(path) as gif:
                self.assertEqual(gif.info["duration"], 30)
        np.testing.assert_allclose(np.diff(seen), 0.03, atol=1e-12)

    def test_an_interrupted_movie_leaves_the_old_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.gif")
            with open(path, "w") as file:
                file.write("old")

            def stop(t):
                if t > 0.3:
                    raise KeyboardInterrupt

            with self.assertRaises(KeyboardInterrupt):
                self.run_.movie(path, fps=10, size=(80, 60), progress=stop)
            with open(path) as file:
                self.assertEqual(file.read(), "old")
            self.assertEqual(os.listdir(folder), ["x.gif"])

    @unittest.skipUnless(matplotlib and animation.FFMpegWriter.isAvailable(), "ffmpeg is missing")
    def test_a_film_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.mp4")
            self.run_.movie(path, fps=10, size=(160, 120), progress=False)
            with open(path, "rb") as file:
                self.assertEqual(file.read(12)[4:8], b"ftyp")

    def test_a_missing_ffmpeg_is_named(self):
        with matplotlib.rc_context({"animation.ffmpeg_path": "no-such-program"}):
            with self.assertRaisesRegex(RuntimeError, "ffmpeg"):
                self.run_.movie("x.mp4")

    def test_wrong_values_are_refused(self):
        for path, options in (("x.avi", {}), ("x.gif", {"fps": 0}), ("x.gif", {"speed": -1}),
                              ("x.gif", {"speed": 1e-9}), ("x.gif", {"size": (1, 2, 3)}),
                              ("x.gif", {"size": (0, 0)}), ("x.gif", {"size": (1e7, 1e7)}),
                              ("x.gif", {"fps": 1e-300})):
            with self.assertRaises(ValueError):
                self.run_.movie(path, **options)

    def test_runs_that_python_functions_define_have_movies(self):
        run = pendulum().simulate([0, 0.1, 0.2], "rk4", step=1e-3)
        with tempfile.TemporaryDirectory() as folder:
            run.movie(os.path.join(folder, "x.gif"), fps=20, size=(80, 60))


if __name__ == "__main__":
    unittest.main()
