# SPDX-License-Identifier: BSD-3-Clause
"""This program shows the effect of Baumgarte's gains. Eight driven slider-cranks move side by side.
They are integrated by explicit Euler, each with one of the eight sets of gains of slider_crank.py.
The page that this program writes shows the violations enlarged, as gaps in the joints. It also
plots the logarithms of the true violations."""

import sys
import warnings
from pathlib import Path

import baum
import numpy as np
from baum.typing import Array
from slider_crank import GAINS, OMEGA, E, L, R, slider_crank
from support.report import Report

H = 2e-4  # [s]
TIMES = H * np.arange(round(8 * np.pi / OMEGA / H) + 1.0)  # [s] four revolutions
ENLARGED = 10  # factor by which the violations are enlarged
# [m] positions of the cranks' axles
PLACES = [(x, y) for y in (0, -0.4, -0.8, -1.2) for x in (0, 0.95)]


def simulate(m: baum.Mechanism, gains: baum.Gains) -> tuple[Array, Array]:
    """Simulates one slider-crank. Returns its positions and its largest violation at each sample
    [m]."""
    joints = [element for element in m if isinstance(element, baum.Joint)]
    record = [joint.phi for joint in joints]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", baum.Warning)  # some gains are marginally stable
        run = m.simulate(
            TIMES, "euler", step=H, formulation="baumgarte", gains=gains, record=record
        )
    return run.q, abs(np.hstack([run[channel] for channel in record])).max(axis=1)


def eight_slider_cranks() -> baum.Mechanism:
    """Makes a mechanism of eight slider-cranks, which is only drawn and not simulated. Bodies and
    curves with the same index have the same colour. The eight cranks are added first, so that each
    crank has the colour of its curve."""
    m = baum.Mechanism()
    for name, (x, y) in zip(GAINS, PLACES):
        m.planar_body(f"crank, {name}", position=(x + R / 2, y))
    for name, (x, y) in zip(GAINS, PLACES):
        m.planar_body(f"rod, {name}", position=(x + R + L / 2, y))
    for name, (x, y) in zip(GAINS, PLACES):
        crank, rod = m[f"crank, {name}"], m[f"rod, {name}"]
        slider = m.planar_body(f"slider, {name}", position=(x + R + L, y + E))
        m.revolute(f"A, {name}", m.ground, crank, point_a=(x, y), point_b=(-R / 2, 0))
        m.revolute(f"B, {name}", crank, rod, point_a=(R / 2, 0), point_b=(-L / 2, 0))
        m.revolute(f"C, {name}", rod, slider, point_a=(L / 2, 0), point_b=(0, 0))
        m.translational(f"guide, {name}", m.ground, slider, point_a=(x, y + E), point_b=(0, 0))
    return m.freeze()


def main() -> int:
    report = Report("eight_gains", folder="write the page into this folder")
    driven, shown = slider_crank(), eight_slider_cranks()
    runs = {name: simulate(driven, gains) for name, gains in GAINS.items()}
    exact = driven.simulate(TIMES, "kinematics").q
    # The indices of q are time, body, slider-crank and coordinate. This is the order of the
    # positions in `shown`.
    q = np.stack([(exact + ENLARGED * (q - exact)).reshape(-1, 3, 3) for q, _ in runs.values()], 2)
    q[..., :2] += PLACES
    q = q.reshape(len(TIMES), -1)
    shown.page(
        TIMES,
        q,
        Path(report.options.folder or ".") / "eight_gains.html",
        title=f"Slider-crank, explicit Euler, step {H:g} s: gaps {ENLARGED} times enlarged",
        plots={name: np.log10(np.maximum(phi, 1e-6)) for name, (_, phi) in runs.items()},
        marks=[
            (
                np.nan,
                "Curves: log10 of the largest violation [m] of the slider-crank of the same colour",
            )
        ],
    )

    gaps = abs(baum.Workspace(shown).phi(0, q[-1])).reshape(len(GAINS), -1).max(axis=1)
    for (name, (_, phi)), gap in zip(runs.items(), gaps):
        print(f"{name:26}  largest violation {phi.max():.1e} m, at the end {phi[-1]:.1e} m")
        if gap < 0.1 * R:  # larger gaps are not proportional to the violation
            report.expect("  the gap shown, off by", abs(gap / (ENLARGED * phi[-1]) - 1), 0.1)
        if name != "none":
            ratio = phi[-len(phi) // 4 :].max() / runs["none"][1].max()
            report.expect("  last revolution / without gains", ratio, 0.7)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
