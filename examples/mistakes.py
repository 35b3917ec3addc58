# SPDX-License-Identifier: BSD-3-Clause
"""Three typical modelling mistakes: a wrong point, a wrong axis and a wrong length, each in a
four-bar linkage. The program writes pictures of the design configuration, in which red lines mark
the joints that are open, that is, violated."""

from __future__ import annotations

import math
import sys
import xml.etree.ElementTree
from pathlib import Path

import baum
from support.report import Report

FOLDER = Path(__file__).resolve().parents[1] / "build"
RED = "#e11d48"


def linkage(coupler: float = 2.5, point: float | None = None) -> baum.Mechanism:
    """Build a four-bar linkage: crank and rocker have a length of 1 m, their pins on the ground are
    2.5 m apart, and a coupler connects their ends.

    coupler: its length [m]. point: x of pin A on the coupler [m], by default its left end.
    """
    half = coupler / 2
    m = baum.Mechanism()
    crank = m.planar_body("crank", mass=1, inertia=0.1, position=(0, 0.5), angle=math.pi / 2)
    rod = m.planar_body("coupler", mass=1, inertia=0.1, position=(half, 1))
    rocker = m.planar_body("rocker", mass=1, inertia=0.1, position=(2.5, 0.5), angle=math.pi / 2)
    m.revolute("O", m.ground, crank, point_a=(0, 0), point_b=(-0.5, 0))
    m.revolute("A", crank, rod, point_a=(0.5, 0), point_b=(-half if point is None else point, 0))
    m.revolute("B", rod, rocker, point_a=(half, 0), point_b=(0.5, 0))
    m.revolute("C", m.ground, rocker, point_a=(2.5, 0), point_b=(-0.5, 0))
    return m


def wrong_point() -> baum.Mechanism:
    """Build the linkage with a wrong point: the point of joint A on the coupler is given with the
    value for the crank."""
    return linkage(point=0.5)


def wrong_length() -> baum.Mechanism:
    """Build the linkage with a wrong length: the coupler is too short to reach from the crank to
    the rocker."""
    return linkage(coupler=0.4)


def wrong_axis() -> baum.Mechanism:
    """Build a spatial four-bar with a wrong axis. The axes of joint C must be given in body axes,
    and the rocker is rotated by 40 degrees about z. The mistake is that the axis on the rocker is
    given in ground axes."""
    turn = math.radians(40)
    y = (0, 1, 0)
    m = baum.Mechanism(up="z")
    crank = m.spatial_body("crank", position=(0, 0, 0.5))
    rod = m.spatial_body("coupler", position=(1, 0, 1.25))
    rocker = m.spatial_body(
        "rocker", position=(2, 0, 0.75), orientation=(math.cos(turn / 2), 0, 0, math.sin(turn / 2))
    )
    m.spatial_revolute("O", m.ground, crank, point=(0, 0, 0), axis=y)
    m.spatial_revolute("A", crank, rod, point=(0, 0, 1), axis=y)
    m.spatial_revolute("B", rod, rocker, point=(2, 0, 1.5), axis=y)
    m.spatial_revolute(
        "C", m.ground, rocker, point_a=(2, 0, 0), point_b=(0, 0, -0.75), axis=y, axis_b=y
    )
    return m


def open_joints(svg: str) -> list[str]:
    """Return the names of the joints for which a picture shows red lines."""
    groups = xml.etree.ElementTree.fromstring(svg)
    return sorted({group[0].text or "" for group in groups if group[1].get("stroke") == RED})


def main() -> int:
    report = Report("mistakes", figures="write the pictures into this folder; default: build")
    folder = Path(report.options.figures or FOLDER)
    folder.mkdir(exist_ok=True)
    for make, joint in ((wrong_point, "A"), (wrong_axis, "C"), (wrong_length, "B")):
        m = make()
        m.draw().save(folder / f"{make.__name__}.svg")
        m.draw("assembled").save(folder / f"{make.__name__}_assembled.svg")
        try:
            m.freeze().simulate([0.1], "rk4", step=1e-2)
        except baum.Error as error:
            print(f"{make.__name__}: {error}\n")
            named = f'"{joint}" is violated most' in str(error) or f'"{joint}" most' in str(error)
            report.expect(f"{make.__name__}: the message does not name {joint}", not named, 0)
        wrong = open_joints(str(m.draw())) != [joint]
        report.expect(f"{make.__name__}: the picture does not show {joint} open", wrong, 0)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
