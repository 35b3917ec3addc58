# SPDX-License-Identifier: BSD-3-Clause
"""Shows mechanisms of the catalogue in motion. For each mechanism, the program writes a page and a
drawing of the initial configuration. Any browser can show the page without a network."""

import sys
import warnings
from pathlib import Path
from typing import NamedTuple

import baum
import numpy as np
from baum import catalog
from support.report import Report


class Scene(NamedTuple):
    title: str
    traces: list[str]  # poses of bodies
    plots: list[str]


SCENES = {
    "slider_crank": Scene("Slider-crank", ["rod.pose"], ["guide.coordinate", "energy"]),
    "andrews_bodies": Scene(
        "Andrews' squeezing mechanism", ["K3.pose", "K6.pose"], ["O.coordinate"]
    ),
    "rssr": Scene("Spatial four-bar", ["coupler.pose"], ["motor.effort"]),
    "bricard": Scene("Bricard's mechanism", ["body3.pose"], ["energy"]),
    "flyball": Scene("Flyball governor", ["right arm.pose"], ["guide.coordinate"]),
    "robot_arm": Scene("Robot arm", ["body6.pose"], [f"joint{k}.effort" for k in range(2, 14, 2)]),
}
LARGEST = 300e3  # [byte] largest size of a page


def simulate(name: str, plots: list[str]) -> baum.Run:
    """Simulates a mechanism over the time span of the catalogue, and records the reactions of all
    joints."""
    m = catalog.build(name)
    reactions = [element.reaction for element in m if isinstance(element, baum.Joint)]
    times = np.linspace(0, catalog.entry(name).end_time, 401)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", baum.Warning)  # the page shows them
        return m.simulate(times, "rk8", rtol=1e-8, record=[*reactions, *plots])


def main() -> int:
    report = Report("animation", folder="write pages and drawings into this folder")
    folder = Path(report.options.folder or ".")
    for name, scene in SCENES.items():
        run = simulate(name, scene.plots)
        assert run.mechanism is not None
        page = folder / f"{name}.html"
        run.page(page, title=scene.title, traces=scene.traces)
        run.mechanism.draw(run.q[0]).save(page.with_suffix(".svg"))
        error = catalog.compare((run.t[-1:], run.q[-1], run.v[-1]), name)
        report.expect(f"{name}: error at the end", error.q, 1e-5)
        report.expect(f"{name}: size of the page [byte]", page.stat().st_size, LARGEST)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
