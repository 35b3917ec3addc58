# SPDX-License-Identifier: BSD-3-Clause
"""Peaucellier's linkage, which draws an exactly straight line with rods and pins only. Two equal
rods connect two opposite corners of a rhombus to a fixed point. If one of the other two corners
moves on a circle through this point, the last corner moves on a straight line."""

import sys
from pathlib import Path

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

LONG, SIDE, CRANK = 1.0, 0.5, 0.35  # [m] long rods, sides of the rhombus, crank
SWING, RATE = 1.0, 2 * np.pi  # [rad] amplitude, [rad/s] angular frequency of the crank
LINE = (LONG**2 - SIDE**2) / (2 * CRANK)  # [m] x of the straight line
RODS = {
    "crank": ("Q", "C"),
    "upper arm": ("O", "A"),
    "lower arm": ("O", "B"),
    "side 1": ("A", "C"),
    "side 2": ("C", "B"),
    "side 3": ("B", "D"),
    "side 4": ("D", "A"),
}


def points(angle: float) -> dict[str, Array]:
    """Return the points of the linkage [m] for an angle of the crank. The fixed point O is the
    origin, and the axle Q of the crank is at (CRANK, 0)."""
    along = np.array([np.cos(angle / 2), np.sin(angle / 2)])
    across = np.array([-along[1], along[0]])
    c, d = 2 * CRANK * along[0] * along, LINE / along[0] * along
    middle, half = (c + d) / 2, np.hypot(*(d - c)) / 2
    height = np.sqrt(SIDE**2 - half**2)
    a, b = middle + height * across, middle - height * across
    return {"O": np.zeros(2), "Q": np.array([CRANK, 0.0]), "A": a, "B": b, "C": c, "D": d}


def crank_law(t: float) -> tuple[float, float, float]:
    s, c = np.sin(RATE * t), np.cos(RATE * t)
    return SWING * s, SWING * RATE * c, -SWING * RATE**2 * s


def mechanism() -> baum.Mechanism:
    m = baum.Mechanism()
    at = points(0.0)
    owners: dict[str, list[baum.Body]] = {"O": [m.ground], "Q": [m.ground]}
    for name, (start, end) in RODS.items():
        length = np.hypot(*(at[end] - at[start]))
        angle = np.arctan2(*(at[end] - at[start])[::-1])
        middle = (at[start] + at[end]) / 2
        rod = m.planar_body(name, mass=length, inertia=length**3 / 12, position=middle, angle=angle)
        for point in (start, end):
            owners.setdefault(point, []).append(rod)
    for point, bodies in owners.items():
        for k, pair in enumerate(zip(bodies, bodies[1:])):
            # At O, both arms are pinned to the ground.
            pair = (bodies[0], bodies[k + 1]) if point == "O" else pair
            m.revolute(f"{point}{k + 1}", *pair, point=at[point])
    m.driver("motor", "Q1", law=crank_law)
    return m.freeze()


def main() -> int:
    report = Report("peaucellier", folder="write the page and the picture into this folder")
    m = mechanism()
    times = np.linspace(0, 1, 401)
    corner = m["side 4"].pose_of((-SIDE / 2, 0))  # the point D
    run = m.simulate(times, "kinematics", record=[corner, "motor.effort"])
    page = Path(report.options.folder or ".") / "peaucellier.html"
    run.page(page, title="Peaucellier's linkage", traces=[corner], plots=["motor.effort"])
    m.draw(run.q[30]).save(page.with_suffix(".svg"))

    x, y = run[corner][:, :2].T
    angle = SWING * np.sin(RATE * times)
    print(f"the point D moves from y = {y.min():.3f} m to y = {y.max():.3f} m")
    report.expect("off the straight line [m]", abs(x - LINE).max(), 1e-12)
    report.expect("off its place on the line [m]", abs(y - LINE * np.tan(angle / 2)).max(), 1e-12)
    report.expect("0.5 m / length of the line", 0.5 / np.ptp(y), 1)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
