# SPDX-License-Identifier: BSD-3-Clause
"""Writes HTML pages into build/ that show mechanisms in motion, in any browser and without a
network: a slider-crank, Andrews' squeezing mechanism, and a spatial four-bar."""

import sys
from pathlib import Path

import baum
import numpy as np
from baum import catalog
from rssr import OMEGA, mechanism
from support.report import Report

FOLDER = Path(__file__).resolve().parents[1] / "build"
LARGEST = 250e3  # [byte] of a page


def slider_crank(path: Path) -> baum.Run:
    m = catalog.build("slider_crank")
    bodies = [element for element in m if element.family == "body"]
    joints = [element for element in m if element.family == "joint"]
    record = [*(joint.reaction for joint in joints), bodies[-1].velocity, "energy"]
    run = m.simulate(np.linspace(0, 0.1, 401), "rk8", rtol=1e-8, record=record)
    run.page(path, title="Slider-crank", traces=[bodies[1]])
    return run


def andrews(path: Path) -> baum.Run:
    m = catalog.build("andrews_bodies")
    bodies = [element for element in m if element.family == "body"]
    joints = [element for element in m if element.family == "joint"]
    record = [joint.reaction for joint in joints]
    run = m.simulate(np.linspace(0, 0.03, 301), "rk8", rtol=1e-8, record=record)
    run.page(path, title="Andrews' squeezing mechanism", traces=bodies[2:4])
    return run


def four_bar(path: Path) -> baum.Run:
    m = mechanism(with_coupler=True)
    times = np.linspace(0, 2 * np.pi / OMEGA, 201)
    record = ["pivot.coordinate", "motor.effort", "ball_a.reaction", "ball_b.reaction"]
    run = m.simulate(times, "rk8", rtol=1e-8, record=record)
    run.page(path, title="Spatial four-bar", traces=["coupler.pose"])
    return run


def main() -> int:
    report = Report("animation")
    FOLDER.mkdir(exist_ok=True)
    for write in (slider_crank, andrews, four_bar):
        path = FOLDER / f"{write.__name__}.html"
        run = write(path)
        assert run.mechanism is not None
        run.mechanism.draw().save(path.with_suffix(".svg"))
        print(f"{path}: {len(run.t)} samples")
        report.expect(f"{write.__name__}: size of the page [byte]", path.stat().st_size, LARGEST)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
