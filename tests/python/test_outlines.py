# SPDX-License-Identifier: BSD-3-Clause
"""Tests outlines of bodies: the forms that Python accepts, SVG paths, and files of meshes,
including hostile files. tests/api/test_body_outlines.c tests the library's part."""

import os
import re
import struct
import tempfile
import unittest

import numpy as np

import baum
from baum import _mesh_files, _svg_path
from test_drawings import data_of

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
CORNERS = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
FORMS = {
    "area": SQUARE,
    "disc": baum.Circle(0.5, (1, 2)),
    "box": baum.Box((3, 1, 2), (1, 2, 3), color="#ff8800"),
    "cylinder": baum.Cylinder(0.5, (0, 0, 0), (3, 4, 0)),
    "ball": baum.Sphere(2),
    "mesh": baum.Mesh(CORNERS, FACES),
}


def body_of(outline, spatial=False):
    m = baum.Mechanism()
    body = (m.spatial_body if spatial else m.planar_body)("b", position=(5, 5, 0)[: 2 + spatial])
    body.outline = outline
    return body


def area(points):
    x, y = points.T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


class Forms(unittest.TestCase):
    def test_all_forms_are_drawn_within_the_picture(self):
        for spatial in False, True:
            for name, outline in FORMS.items():
                with self.subTest(name, spatial=spatial):
                    svg = str(body_of(outline, spatial).mechanism.draw())
                    _, _, width, height = map(float, re.search('viewBox="(.*?)"', svg)[1].split())
                    points = re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", svg)
                    points += re.findall(r'cx="(.*?)" cy="(.*?)"', svg)
                    low, high = np.min(np.float64(points), 0), np.max(np.float64(points), 0)
                    self.assertTrue((low >= 11).all() and (high <= [width - 11, height - 11]).all())
                    if name in ("area", "mesh"):  # these fill their box, except for a margin
                        np.testing.assert_allclose([low, high], [[12, 12], [width - 12, height - 12]], atol=1)

    def test_a_cylinder_is_drawn_as_its_silhouette_and_its_near_end(self):
        svg = str(body_of(baum.Cylinder(0.5, (3, 0, 4), (0, 0, 0))).mechanism.draw())
        paths = [np.float64(re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", p)) for p in re.findall(r' d="(.*?)"', svg)]
        silhouette, end = (abs(area(points)) for points in paths)
        ellipse = 12 * np.sin(np.pi / 12) * 0.5 * 0.4  # area of an ellipse drawn with 24 corners
        self.assertAlmostEqual(silhouette / end, (3 * 1 + ellipse) / ellipse, places=2)

    def test_pages_contain_them(self):
        m = baum.Mechanism()
        m.ground.outline = [(-1, -1), (9, -1), (9, -2)]
        for k, (form, outline) in enumerate(FORMS.items()):
            m.spatial_body(form, position=(k, 0, 0), outline=outline)
        run = m.freeze().simulate([0, 0.1], "rk4", step=0.05)
        with tempfile.TemporaryDirectory() as folder:
            run.page(os.path.join(folder, "x.html"))
            with open(os.path.join(folder, "x.html"), encoding="utf-8") as file:
                drawing = data_of(file.read())["drawing"]
        shapes = {shape["element"]: shape for shape in drawing["shapes"]}
        self.assertEqual({name: shapes[name]["form"] for name in FORMS}, {name: name for name in FORMS})
        self.assertEqual(shapes["ground"]["style"], "base")
        self.assertEqual(shapes["box"]["color"], "#ff8800")
        self.assertEqual(shapes["box"]["points"], [[1, 2, 3], [1.5, 0.5, 1]])
        self.assertEqual(shapes["cylinder"]["points"], [[0, 0, 0], [3, 4, 0]])
        self.assertEqual(shapes["mesh"]["points"], CORNERS.tolist())
        self.assertEqual(shapes["mesh"]["triangles"], FACES.ravel().tolist())

    def test_they_are_read_back_and_copied(self):
        body = body_of(list(FORMS.values()))
        for owner in body, body.mechanism.copy()["b"], body.mechanism.freeze().copy()["b"]:
            found = owner.outline
            self.assertEqual([type(o).__name__ for o in found], "Polygon Circle Box Cylinder Sphere Mesh".split())
            np.testing.assert_array_equal(found[0].points[:, :2], SQUARE)
            self.assertEqual(repr(found[1:4]), repr(list(FORMS.values())[1:4]))
            np.testing.assert_array_equal(found[5].vertices[found[5].triangles], CORNERS[FACES])
        body.outline = None
        self.assertEqual(body.outline, [])

    def test_several_outlines_are_given_in_many_ways(self):
        triangle = np.array([(0, 0, 2), (1, 0, 2), (0, 1, 2)])
        path = "M0 0 1 0 1 1z M5 5h1v1z"
        for outline, count in (
            ([], 0),
            (triangle, 1),
            ([SQUARE, triangle], 2),
            ([SQUARE, SQUARE], 2),
            (path, 2),
            ([path, baum.Circle(1), SQUARE], 4),
            ((baum.Circle(1), baum.Circle(2)), 2),
        ):
            self.assertEqual(len(body_of(outline).outline), count)

    def test_wrong_outlines_are_refused_before_the_body_is_added(self):
        m = baum.Mechanism()
        for outline, error, text in (
            (baum.Circle(-1), baum.Error, "radius is -1 m, must be > 0"),
            (baum.Box((1, 0, 0)), baum.Error, "two edges"),
            ([(0, 0), (1, 0)], baum.Error, "number of points is 2, must be at least 3"),
            ([(0, 0), (1, 0), (np.nan, 1)], baum.Error, "x of point 2 is nan m"),
            ([FORMS["disc"], baum.Cylinder(1, (1, 0), (1, 0))], baum.Error, r"outlines\[1\]: start and end"),
            (baum.Circle(1, color="red"), baum.Error, "#rrggbb"),
            (baum.Circle(1, color=7), TypeError, "color"),
            ("circle", ValueError, "character 2: a path begins with M"),
            (5, TypeError, "an SVG path"),
            ([1, 2, 3], TypeError, "an SVG path"),
            ([("0", "0"), ("1", "0"), ("1", "1")], TypeError, ""),
            (np.zeros((3, 4)), ValueError, r"\(n, 2\) or \(n, 3\)"),
        ):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                m.planar_body("b", outline=outline)
        self.assertNotIn("b", m)
        with self.assertRaisesRegex(baum.Error, "user coordinates"):
            m.coordinates("c", 1, mass=lambda t, q: 1, force=lambda t, q, v: 0).outline = SQUARE

    def test_meshes_check_their_triangles(self):
        for triangles, error in (
            ([(0, 1, 4)], ValueError),
            ([(0, 1, -1)], ValueError),
            ([(0.0, 1.0, 2.0)], TypeError),
            ([0, 1, 2], ValueError),
            ([(0, 1, 1 << 40)], ValueError),
        ):
            with self.subTest(triangles), self.assertRaises(error):
                baum.Mesh(CORNERS, triangles)
        with self.assertRaisesRegex(baum.Error, "triangle_count is 0"):
            body_of(baum.Mesh(CORNERS, np.empty((0, 3), int)))

    def test_arrays_that_are_assigned_are_converted_and_checked(self):
        mesh = baum.Mesh(CORNERS, [(0, 1, 2)])
        mesh.vertices = (np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]) @ mesh.vertices.T).T.astype(np.float32)
        mesh.triangles = mesh.triangles[:, ::-1].astype(np.int64)
        found = body_of(mesh).outline[0]
        np.testing.assert_array_equal(found.vertices, mesh.vertices)
        np.testing.assert_array_equal(found.triangles, mesh.triangles)
        mesh.triangles = np.array([(0, 1, 4)])
        with self.assertRaisesRegex(ValueError, "from 0 to 3"):
            body_of(mesh)

    def test_limits_are_those_of_the_library(self):
        many = np.zeros((_mesh_files.LIMIT + 1, 3), int)
        body_of(baum.Mesh(CORNERS, many[1:]))
        with self.assertRaisesRegex(baum.Error, f"to {_mesh_files.LIMIT}"):
            body_of(baum.Mesh(CORNERS, many))


class Paths(unittest.TestCase):
    def one(self, text):
        (points,) = _svg_path.polygons(text)
        return points

    def test_lines(self):
        wanted = [(1, 1), (3, 1), (3, 2), (0, 4)]
        for text in "M1,1L3,1 3,2 0,4Z", "M1 1H3V2L0 4", "m1 1 2 0 0 1-3 2z", " m1 1h2v1l-3,2 1 -3":
            np.testing.assert_allclose(self.one(text), wanted, atol=1e-15)

    def test_subpaths(self):
        first, second, third = _svg_path.polygons("M1 1h1v1z l-1 0 0 -1 m5 5 1 0 0 1e0")
        np.testing.assert_array_equal(first, [(1, 1), (2, 1), (2, 2)])
        np.testing.assert_array_equal(second, [(1, 1), (0, 1), (0, 0)])
        np.testing.assert_array_equal(third, [(5, 5), (6, 5), (6, 6)])

    def test_curves_pass_through_their_points(self):
        n = _svg_path.CURVE
        for text, middle in (
            ("M0 0 C0 4 8 4 8 0", (4, 3)),
            ("m0 0c0 4 8 4 8 0", (4, 3)),
            ("M0 0 Q4 4 8 0", (4, 2)),
            # there is no curve before, so the first control point is the start
            ("M0 0 S8 4 8 0", (4, 1.5)),
        ):
            points = self.one(text + "l0 -1z")
            np.testing.assert_allclose(points[n // 2], middle)
            np.testing.assert_allclose(points[n], (8, 0))
        smooth = self.one("M0 0 C0 4 8 4 8 0 s8 -4 8 0 z")
        np.testing.assert_allclose(smooth, self.one("M0 0 C0 4 8 4 8 0 C8 -4 16 -4 16 0z"))
        smooth = self.one("M0 0 Q4 4 8 0 T 16 0 24 0z")
        np.testing.assert_allclose(smooth, self.one("M0 0 Q4 4 8 0 Q12 -4 16 0 Q20 4 24 0z"))

    def test_arcs_lie_on_their_circles(self):
        # Arcs from (1, 0) to (0, 1): their flags, centre and angle. The angle is positive if
        # counter-clockwise.
        for flags, centre, angle in (("0 1", 0, 90), ("0 0", 1, -90), ("1 1", 1, 270), ("1 0", 0, -270)):
            points = self.one(f"M1 0 A1 1 0 {flags} 0 1 z")
            np.testing.assert_allclose(np.hypot(*(points - centre).T), 1, rtol=1e-14)
            turned = np.degrees(np.unwrap(np.angle((points - centre) @ (1, 1j))))
            self.assertAlmostEqual(turned[-1] - turned[0], angle)
            np.testing.assert_array_equal(points[[0, -1]], [(1, 0), (0, 1)])

    def test_a_circle_of_two_arcs(self):
        points = self.one("m-3 2a2 2 0 0 1 4 0 2 2 0 0 1-4 0z")
        np.testing.assert_allclose(np.hypot(*(points - (-1, 2)).T), 2)
        self.assertAlmostEqual(area(points) / (4 * np.pi), 1, delta=2e-3)
        self.assertLess(np.max(np.hypot(*np.diff(points, axis=0).T)), 2 * np.radians(5.01))

    def test_ellipses_are_rotated_and_enlarged(self):
        points = self.one("M0 0 A 3 1 30 1 1 1 1 z")
        along, across = points @ (np.sqrt(0.75), 0.5), points @ (-0.5, np.sqrt(0.75))
        # the equation is (x - a)^2 / 9 + (y - b)^2 = 1
        rows = np.stack([along**2 / 9 + across**2, along, across], axis=1)
        fit, residue, *_ = np.linalg.lstsq(rows[1:, 1:], rows[1:, 0], rcond=None)
        self.assertLess(residue[0], 1e-20)
        a, b = fit[0] * 9 / 2, fit[1] / 2
        self.assertAlmostEqual(a * a / 9 + b * b, 1)
        # the radii are too small, so this becomes a half circle between the points
        half = self.one("M0 0 A .1 .1 0 0 1 2 0 z")
        np.testing.assert_allclose(np.hypot(*(half - (1, 0)).T), 1)
        # it is counter-clockwise if y points upward
        self.assertAlmostEqual(half[:, 1].min(), -1, delta=2e-3)
        flat = self.one("M0 0 A 0 1 0 0 1 2 0 L 2 2 z")
        self.assertEqual(len(flat), 3)

    def test_flags_need_no_gap(self):
        np.testing.assert_array_equal(self.one("M0 0a1 1 0 011.5.5z"), self.one("M0 0 a 1 1 0 0 1 1.5 .5 z"))

    def test_wrong_paths_are_refused_at_their_place(self):
        for text, where in (
            ("L 1 1", "character 2: a path begins with M"),
            ("0 0", "character 1: a command"),
            ("M 0 0 L 1", "character 10: L needs 2"),
            ("M 0 0 L 1 x", "character 10"),
            ("M 0 0 1 0 1 1 z 5", "character 16: a command"),
            ("M 0 0 A 1 1 0 2 0 1 1", "character 14: A needs 7"),
            ("M 0 0 L 1e999 0", "L needs 2 finite"),
            ("M 0 0 B 1 1", "character 6"),
            ("M 0 0 1 1", "subpath 1: a polygon needs 3 points, not 2"),
            ("M 0 0 1 0 1 1 z M 3 3", "subpath 2"),
            ("M0 0 A 1e-300 1e300 0 0 1 1e300 1 L 5 5 6 6z", "too large"),
            ("M1e308 0 c1e308 1e308 1e308 1e308 1e308 0z", "too large"),
            ("M0 0" + " 1 2 3 4" * 60000, "more than 100000 points"),
            ("M0 0 \u0661 1", "character 5: L needs|character 5: a"),
        ):
            with self.subTest(text[:40]), self.assertRaisesRegex(ValueError, where):
                _svg_path.polygons(text)
        self.assertEqual(_svg_path.polygons(""), [])


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def load(self, name, data, **options):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode())
        return baum.Mesh.load(path, **options)

    def binary(self, count=None, head=b"\0" * 80):
        records = b"".join(
            struct.pack("<12fH", 0, 0, 0, *CORNERS[face].ravel(), 0) for face in FACES
        )
        return head + struct.pack("<I", len(FACES) if count is None else count) + records

    def text(self):
        lines = ["solid part of mine"]
        for face in FACES:
            lines += ["  facet normal 0 0 0", "    outer loop"]
            lines += ["      vertex {:.6e} {:g} {:g}".format(*CORNERS[k]) for k in face]
            lines += ["    endloop", "  endfacet"]
        return "\r\n".join([*lines, "endsolid part of mine", ""])

    def assert_tetrahedron(self, mesh, scale=1):
        self.assertEqual(mesh.vertices.shape, (4, 3))
        np.testing.assert_allclose(mesh.vertices[mesh.triangles], scale * CORNERS[FACES])

    def test_stl(self):
        self.assert_tetrahedron(self.load("a.stl", self.binary()))
        self.assert_tetrahedron(self.load("b.STL", self.binary(head=b"solid is no text".ljust(80)), scale=1e-3), 1e-3)
        self.assert_tetrahedron(self.load("c.stl", self.text()))
        self.assert_tetrahedron(self.load("d.stl", self.text().upper()))

    def test_obj(self):
        points = "".join("v {} {} {}\n".format(*corner) for corner in CORNERS)
        faces = "".join("f {} {}/1 {}//2\n".format(*(face + 1)) for face in FACES)
        negative = "".join("f {} {} {}\n".format(*(face - 4)) for face in FACES)
        self.assert_tetrahedron(self.load("a.obj", f"# part\nmtllib x.mtl\n{points}vn 0 0 1\no x\n{faces}"))
        # contains a vertex that is not used
        self.assert_tetrahedron(self.load("b.obj", points + "v 9 9 9\n" + faces))
        self.assert_tetrahedron(self.load("c.obj", points + negative))
        mesh = self.load("d.obj", "v 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n 3 4\n")
        np.testing.assert_array_equal(mesh.triangles, [(0, 1, 2), (0, 2, 3)])

    def test_only_regular_files_are_read(self):
        for name in ("zero.stl", "pipe.obj"):
            path = os.path.join(self.folder, name)
            os.symlink("/dev/zero", path) if name == "zero.stl" else os.mkfifo(path)
            with self.assertRaisesRegex(ValueError, "regular file"):
                baum.Mesh.load(path)

    def test_broken_files_are_refused_at_their_place(self):
        good, text = self.binary(), self.text()
        nan = good[:96] + struct.pack("<f", np.inf) + good[100:]
        for name, data, where in (
            ("a.stl", good[:-1], r"a\.stl: byte 283: the file ends, but 4 triangles need 284 bytes"),
            ("a.stl", good[:50], "byte 50: the file ends in its head"),
            ("a.stl", b"", "byte 0: the file ends in its head"),
            ("a.stl", self.binary(2**32 - 1), "byte 80: more than 200000 triangles"),
            ("a.stl", self.binary(100000), "need 5000084 bytes"),
            ("a.stl", self.binary(0)[:84], "no triangles"),
            ("a.stl", nan, "byte 96: numbers must be finite"),
            ("a.stl", text.replace("vertex 0.000000e+00", "vertex nan", 1), "line 4: numbers must be finite"),
            ("a.stl", text.replace("1.000000e+00", "x", 1), "line 6: three numbers"),
            ("a.stl", text.replace("endsolid", "end"), "line 30: 'end' is not a keyword"),
            ("a.stl", text[: text.index("endsolid")], "line 29: the file ends without endsolid"),
            ("a.stl", text[: text.index("endloop")], "line 6: the file ends without endsolid"),
            ("a.stl", text.replace("    endloop", "vertex 0 0 0\nendloop", 1), "line 8: a triangle needs 3 vertices, not 1"),
            ("a.stl", "solid x\nendsolid x", "no triangles"),
            ("a.obj", "v 0 0\n", "line 1: three numbers"),
            ("a.obj", "v 0 0 1e999\n", "line 1: numbers must be finite"),
            ("a.obj", "v 0 0 0\nf 1 1 2\n", "line 2: there is no vertex 2 among the 1"),
            ("a.obj", "v 0 0 0\n\nf 1 1 0\n", "line 3: there is no vertex 0"),
            ("a.obj", "v 0 0 0\nf 1 1 -2\n", "line 2: there is no vertex -2"),
            ("a.obj", "v 0 0 0\nf 1 1 x\n", "line 2: the number of a vertex"),
            ("a.obj", "v 0 0 0\nf 1 1\n", "line 2: a face needs 3 corners, not 2"),
            ("a.obj", "v 0 0 0\nf" + " 1" * 200003, "line 2: more than 200000 triangles"),
            ("a.obj", "v 0 0 0\n" * 600001, "line 600001: more than 600000 vertices"),
            ("a.obj", "\\\n" * 100000 + "f 1", "line 100001: a face needs 3 corners, not 1"),
            ("a.obj", b"\xff\xfe\x00garbage", "no triangles"),
            ("a.ply", "", "ending .stl or .obj"),
        ):
            with self.subTest(where), self.assertRaisesRegex(ValueError, where):
                self.load(name, data)
        with self.assertRaises(FileNotFoundError):
            baum.Mesh.load(os.path.join(self.folder, "none.stl"))


if __name__ == "__main__":
    unittest.main()
