# SPDX-License-Identifier: BSD-3-Clause
"""Two shafts meet at an angle. In one mechanism Hooke's joint (a universal joint) connects them,
and in another mechanism a constant-velocity joint does. If the first shaft rotates steadily, the
second one does so only with the constant-velocity joint."""

import sys
from pathlib import Path

import baum
import numpy as np
from baum import inertia
from baum.typing import Array
from support.report import Report

BEND = np.radians(35)  # [rad] angle between the shafts
RATE = 2 * np.pi  # [rad/s] angular velocity of the first shaft
LENGTH = 0.3  # [m] of a shaft
INTO, OUT = np.array([1.0, 0, 0]), np.array([np.cos(BEND), np.sin(BEND), 0])  # unit vectors

COLUMNS = {
    "angle": ("first shaft [deg]", "9.1f"),
    "universal": ("Hooke's joint [-]", "9.6f"),
    "formula": ("formula [-]", "9.6f"),
    "constant": ("constant velocity [-]", "9.6f"),
}


def shafts(joint: str) -> baum.Mechanism:
    """Build both shafts. They meet at the origin. The second shaft is held only by the joint and by
    a support at its far end, so no row is redundant."""
    m = baum.Mechanism(gravity=(0, 0, 0))
    first_tensor = inertia.cylinder(2, radius=0.02, length=LENGTH, axis="x")
    first = m.spatial_body("first", mass=2, inertia=first_tensor, position=-LENGTH / 2 * INTO)
    turned = np.array([OUT, (-OUT[1], OUT[0], 0), (0, 0, 1)]).T  # columns: axes of the body
    second = m.spatial_body(
        "second",
        mass=2,
        inertia=first_tensor,
        position=LENGTH / 2 * OUT,
        orientation=turned,
    )
    bearing = m.spatial_revolute("bearing", m.ground, first, point=-LENGTH * INTO, axis=INTO)
    m.point_on_line("support", m.ground, second, point=LENGTH * OUT, axis=OUT)
    if joint == "universal":
        # The fork of the first shaft lies in the plane of the shafts at the start.
        m.universal("joint", first, second, point=(0, 0, 0), axis=(0, 1, 0), axis_b=(0, 0, 1))
    else:
        m.constant_velocity("joint", first, second, point=(0, 0, 0), axis=INTO, axis_b=OUT)
    m.driver("motor", bearing, rate=RATE)
    return m.freeze()


def ratio(m: baum.Mechanism, times: Array) -> tuple[baum.Run, Array]:
    """Simulate the shafts. Return the run, and the angular velocity of the second shaft divided by
    that of the first shaft."""
    run = m.simulate(times, "kinematics")
    speed: Array = run["second.velocity"][:, 3:] @ OUT / RATE
    return run, speed


def main() -> int:
    report = Report("hookes_joint", folder="write the page and the picture into this folder")
    times = np.linspace(0, 1, 361)
    m = shafts("universal")
    run, universal = ratio(m, times)
    _, constant = ratio(shafts("constant velocity"), times)
    page = Path(report.options.folder or ".") / "hookes_joint.html"
    plots = {"Hooke's joint [-]": universal, "constant velocity [-]": constant}
    m.page(times, run.q, page, title="Hooke's joint", plots=plots)
    m.draw(run.q[0]).save(page.with_suffix(".svg"))

    angle = RATE * times
    formula = np.cos(BEND) / (1 - np.sin(BEND) ** 2 * np.cos(angle) ** 2)
    rows = np.column_stack([np.degrees(angle), universal, formula, constant])
    report.table("ratio", COLUMNS, rows[::30].tolist())
    print(m.mobility().text)
    report.expect("Hooke's joint: ratio, off by", abs(universal - formula).max(), 1e-12)
    report.expect("constant velocity: ratio, off by", abs(constant - 1).max(), 1e-12)
    report.expect("redundant rows", m.mobility().redundant_rows, 0)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
