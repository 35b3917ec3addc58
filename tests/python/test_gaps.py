# SPDX-License-Identifier: BSD-3-Clause
"""Tests red lines in drawings. They must show where a joint is open, and must not appear anywhere
else."""

import math
import sys
import unittest

import baum
from compiler import ROOT

sys.path.append(str(ROOT / "examples"))
from mistakes import open_joints, wrong_axis, wrong_length, wrong_point

FIGURES = ROOT / "docs" / "figures"
COS, SIN = math.cos(0.15), math.sin(0.15)


def gaps(m, q=None):
    return open_joints(str(m.draw(q)))


def plane(add):
    """Make a body with its centre at (1, 0). The joint between it and the ground is called "joint".
    A pin at a distance of 2 m determines the size of the picture."""
    m = baum.Mechanism()
    body = m.planar_body("body", position=(1, 0))
    add(m, body)
    m.revolute("far", m.ground, m.planar_body("other", position=(2, 0)), point=(2, 0))
    return m.freeze()


def space(add):
    m = baum.Mechanism()
    body = m.spatial_body("body", position=(1, 0, 0))
    add(m, body)
    m.spherical("far", m.ground, m.spatial_body("other", position=(2, 0, 0)), point=(2, 0, 0))
    return m.freeze()


def circle(xy):
    return xy[0] ** 2 + xy[1] ** 2 - 0.25, 2 * xy[0], 2 * xy[1], 2, 0, 2


def helix(xyz):
    x, y, z = xyz
    c, s = 0.5 * math.cos(z / 0.2), 0.5 * math.sin(z / 0.2)
    return [x - c, 1, 0, s / 0.2, 0, 0, 0, 0, 0, c / 0.04, y - s, 0, 1, -c / 0.2, 0, 0, 0, 0, 0, s / 0.04]


ALONG = {"point": (1, 0, 0), "axis": (1, 0, 0)}
# For each kind of joint, two lists of displacements of the body (x, y, angle). Those in the first
# list keep the joint closed, and those in the second list open it.
PLANE = {
    "revolute": (lambda m, b: m.revolute("joint", m.ground, b, point=(1, 0)), [(0, 0, 1)], [(0.1, 0, 0)]),
    "translational": (lambda m, b: m.translational("joint", m.ground, b, point=(0, 0)),
                      [(0.3, 0, 0)], [(0, 0.1, 0), (0, 0, 0.1)]),
    "fixed": (lambda m, b: m.fixed("joint", m.ground, b, point=(1, 0)), [], [(0.1, 0, 0), (0, 0, 0.2)]),
    "pin_in_slot": (lambda m, b: m.pin_in_slot("joint", m.ground, b, point=(1, 0)),
                    [(0.3, 0, 0), (0, 0, 1)], [(0, 0.1, 0)]),
    "distance": (lambda m, b: m.distance("joint", m.ground, b, point_a=(0, 0), point_b=(0, 0), length=1),
                 [(-1, 1, 0)], [(0.1, 0, 0), (-0.1, 0, 0)]),
    "curve": (lambda m, b: m.curve("joint", m.ground, b, circle, point_a=(0.5, 0), point_b=(0, 0)),
              [(-0.5, 0.5, 0), (-0.5, -0.5, 1)], [(0.1, 0, 0), (-0.2, 0.5, 0)]),
}
# The same for joints in space. Three numbers are a displacement (x, y, z), and a letter is a
# rotation of 0.3 rad about this axis.
SPACE = {
    "spherical": (lambda m, b: m.spherical("joint", m.ground, b, point=(1, 0, 0)), ["x", "y", "z"], [(0.1, 0, 0)]),
    "revolute": (lambda m, b: m.spatial_revolute("joint", m.ground, b, point=(1, 0, 0), axis=(1, 0, 0)),
                 ["x"], ["y", "z", (0, 0, 0.1)]),
    "universal": (lambda m, b: m.universal("joint", m.ground, b, point=(1, 0, 0), axis=(1, 0, 0), axis_b=(0, 1, 0)),
                  ["x", "y"], ["z", (0, 0.1, 0)]),
    "cylindrical": (lambda m, b: m.cylindrical("joint", m.ground, b, **ALONG),
                    ["x", (0.2, 0, 0)], ["y", "z", (0, 0.1, 0)]),
    "prismatic": (lambda m, b: m.prismatic("joint", m.ground, b, **ALONG),
                  [(0.2, 0, 0)], ["x", "y", "z", (0, 0, 0.1)]),
    "planar": (lambda m, b: m.spatial_planar("joint", m.ground, b, **ALONG),
               [(0, 0.1, 0.2), "x"], ["y", "z", (0.1, 0, 0)]),
    "fixed": (lambda m, b: m.spatial_fixed("joint", m.ground, b, point=(1, 0, 0)),
              [], ["x", "y", "z", (0.1, 0, 0)]),
    "distance": (lambda m, b: m.spatial_distance("joint", m.ground, b, point_a=(0, 0, 0), point_b=(0, 0, 0), length=1),
                 [(-1, 0, 1), "y"], [(0.1, 0, 0)]),
    "point_on_line": (lambda m, b: m.point_on_line("joint", m.ground, b, **ALONG), [(0.2, 0, 0), "x"], [(0, 0.1, 0)]),
    "point_on_plane": (lambda m, b: m.point_on_plane("joint", m.ground, b, **ALONG),
                       [(0, 0.1, 0.1), "x"], [(0.1, 0, 0)]),
    "spatial_curve": (lambda m, b: m.spatial_curve("joint", m.ground, b, helix, point_a=(0.5, 0, 0), point_b=(0, 0, 0)),
                      [(-1, 0, 0.2 * math.pi), "x"], [(0.1, 0, 0), (0, 0, 0.2)]),
}


def moved(m, step):
    q = baum.Workspace(m).design()[0]
    if isinstance(step, str):
        q[3:7] = COS, *(SIN * (axis == step) for axis in "xyz")
    else:
        q[:3] += step
    return q


class Kinds(unittest.TestCase):
    def check(self, build, kinds):
        for name, (add, closed, opened) in kinds.items():
            m = build(add)
            self.assertEqual(gaps(m), [], name)
            for step in closed:
                self.assertEqual(gaps(m, moved(m, step)), [], (name, step))
            for step in opened:
                self.assertEqual(gaps(m, moved(m, step)), ["joint"], (name, step))

    def test_joints_in_the_plane(self):
        self.check(plane, PLANE)

    def test_joints_in_space(self):
        self.check(space, SPACE)

    def test_a_given_angle_is_shown(self):
        for add in (
            lambda m, b: m.fixed("joint", m.ground, b, point=(1, 0), angle=0.3),
            lambda m, b: m.translational("joint", m.ground, b, point=(1, 0), angle=0.3),
        ):
            m = plane(add)
            self.assertEqual(gaps(m), ["joint"])
            self.assertEqual(gaps(m, moved(m, (0, 0, 0.3))), [])

    def test_axes_that_are_given_apart_are_shown(self):
        for axis_b, wanted in (((1, 0, 0), []), ((1, 0.3, 0), ["joint"])):
            for kind in ("spatial_revolute", "cylindrical", "prismatic", "spatial_planar"):
                m = space(lambda m, b: getattr(m, kind)("joint", m.ground, b, point=(1, 0, 0),
                                                        axis=(1, 0, 0), axis_b=axis_b))
                self.assertEqual(gaps(m), wanted, kind)


class Mistakes(unittest.TestCase):
    """Tests three typical mistakes. The picture of the design configuration must show only the
    wrong joint. The picture of assembly's last configuration must show all joints that contradict
    each other."""

    def check(self, make, wrong, contradicting):
        m = make()
        self.assertEqual(gaps(m), [wrong])  # before the mechanism is frozen
        self.assertEqual(gaps(m, "assembled"), contradicting)
        with self.assertRaises(baum.Error) as caught:
            m.freeze().simulate([0.1], "rk4", step=1e-2)
        self.assertEqual(caught.exception.status, baum.Status.ERR_INCONSISTENT)
        self.assertIn(f'"{wrong}"', str(caught.exception))
        self.assertIn("see draw()", str(caught.exception))
        self.assertEqual(gaps(m), [wrong])  # after assembly has failed
        self.assertEqual(gaps(m, "assembled"), contradicting)
        figure = (FIGURES / f"{make.__name__}.svg").read_text(encoding="utf-8")
        self.assertEqual(open_joints(figure), [wrong])

    def test_a_wrong_point(self):
        self.check(wrong_point, "A", [])

    def test_a_wrong_axis(self):
        self.check(wrong_axis, "C", ["A", "B", "C", "O"])

    def test_a_wrong_length(self):
        self.check(wrong_length, "B", ["A", "B", "C", "O"])

    def test_a_point_away_from_its_particle_is_shown_although_freezing_fails(self):
        m = baum.Mechanism()
        arm = m.planar_body("arm", position=(0.5, 0))
        bob = m.planar_particle("bob", position=(1.2, 0))
        m.revolute("O", m.ground, arm, point=(0, 0))
        m.revolute("A", arm, bob, point=(1, 0))
        with self.assertRaisesRegex(baum.Error, '"A": point is'):
            m.freeze()
        self.assertEqual(gaps(m), ["A"])

    def test_only_positions_and_assembled_are_drawn(self):
        with self.assertRaisesRegex(ValueError, "assembled"):
            wrong_length().draw("assembly")


if __name__ == "__main__":
    unittest.main()
