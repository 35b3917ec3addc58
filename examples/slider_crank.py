# SPDX-License-Identifier: BSD-3-Clause
"""This program reproduces Fig. 3 of Flores et al. (EuCoMeS 2008) qualitatively. The crank of the
eccentric slider-crank is driven at constant speed. The integrator is explicit Euler, with eight
sets of Baumgarte's gains.

Lengths, masses and inertias are those of Flores, Leine, Glocker, Multibody System Dynamics 23
(2010) 165, Table 1. The eccentricity and the other numbers are chosen here, because Flores et al.
2008 does not give them. The motion is known in closed form, so the table also shows the error of
each run.
"""

import sys
import warnings
from typing import Any

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

R, L, E = 0.153, 0.306, 0.05  # [m] lengths of crank and rod, height of the guide
OMEGA = 150.0  # [rad/s]
H = 1e-4  # [s]

GAINS = {
    "none": baum.fixed(0, 0),
    "alpha = beta = 5": baum.fixed(5, 5),
    "alpha = beta = 50": baum.fixed(50, 50),
    "alpha = beta = 500": baum.fixed(500, 500),
    "100 Hz, damping ratio 0.2": baum.frequency(100, 0.2),
    "10 Hz, damping ratio 3": baum.frequency(10, 3),
    "Taylor (10, 11)": baum.taylor(),
    "stiff, alpha = beta = 1/h": baum.scaled(1, 1),
}

Row = dict[str, Any]
COLUMNS = {
    "gains": ("gains", "25s"),
    "alpha": ("alpha [1/s]", "9.1f"),
    "beta": ("beta [1/s]", "9.1f"),
    "spectral_radius": ("largest |z|", "9.5f"),
    "stability": ("class", "8s"),
    "max_phi3": ("max|Phi_3| [m]", "9.2e"),
    "final_phi3": ("at the end [m]", "9.2e"),
    "max_phi": ("max|Phi|", "9.2e"),
    "slider_error": ("slider off by [m]", "9.1e"),
}


def slider_crank() -> baum.Mechanism:
    """Build the mechanism of three bodies. The crank is at angle 0. The other poses are only
    approximate; assembly moves the bodies to their places."""
    m = baum.Mechanism(gravity=(0, -9.81))
    crank = m.planar_body("crank", mass=0.038, inertia=7.4e-5, position=(R / 2, 0))
    rod = m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(R + L / 2, 0))
    slider = m.planar_body("slider", mass=0.076, inertia=2.7e-6, position=(R + L, E))
    pin = m.revolute("A", m.ground, crank, point_a=(0, 0), point_b=(-R / 2, 0))
    m.revolute("B", crank, rod, point_a=(R / 2, 0), point_b=(-L / 2, 0))
    m.revolute("C", rod, slider, point_a=(L / 2, 0), point_b=(0, 0))
    m.translational("guide", m.ground, slider, axis=(1, 0), point_a=(0, E), point_b=(0, 0))
    m.driver("motor", pin, value=0, rate=OMEGA)
    return m.freeze()


def slider_at(t: Array) -> Array:
    """Return x of the slider [m], computed in closed form."""
    x: Array = R * np.cos(OMEGA * t) + np.sqrt(L**2 - (E - R * np.sin(OMEGA * t)) ** 2)
    return x


def simulate(m: baum.Mechanism, gains: baum.Gains, times: Array) -> tuple[baum.Run, Row]:
    """Simulate with one set of gains. Return the run and its row of the table. Phi_3 is the first
    constraint row of pin B."""
    run = m.simulate(times, "euler", step=H, formulation="baumgarte", gains=gains, record=["B.phi"])
    phi3, c = abs(run["B.phi"][:, 0]), run.counters
    z = baum.stability("euler", c.alpha * H, (c.beta * H) ** 2)
    error = abs(run["slider.pose"][:, 0] - slider_at(times)).max()
    row = (c.alpha, c.beta, z.spectral_radius, z.stability, phi3.max(), phi3[-1], c.max_phi, error)
    return run, dict(zip(list(COLUMNS)[1:], row))


def check(report: Report, runs: dict[str, baum.Run], said: dict[str, Row]) -> None:
    """Check what Flores et al. 2008 says about these eight sets of gains."""
    quarters = {name: np.split(abs(run["B.phi"][1:, 0]), 4) for name, run in runs.items()}
    growth = {name: last.max() / third.max() for name, (_, _, third, last) in quarters.items()}
    report.expect("none: Phi_3 grows, 3rd / last quarter", 1 / growth["none"], 0.9)
    for name, row in said.items():
        if row["spectral_radius"] ** 5000 < 0.01:  # violations decay within half of the run
            report.expect(f"{name}: last / 3rd", growth[name], 1.05)
    largest = max(row["max_phi3"] for name, row in said.items() if name != "none")
    report.expect("largest Phi_3 with / without gains", largest / said["none"]["max_phi3"], 0.1)
    name = "stiff, alpha = beta = 1/h"
    off = said[name]["max_phi"] / runs[name].counters.predicted_phi - 1
    report.expect("stiff: violation against its prediction", abs(off), 0.02)
    report.expect("stiff: slider off by [m]", said[name]["slider_error"], 1e-4)


def plot(path: str, runs: dict[str, baum.Run]) -> None:
    """Plot Phi_3 over time, in one diagram for each set of gains."""
    import matplotlib.pyplot as plt

    figure, frames = plt.subplots(4, 2, sharex=True, figsize=(9, 9), layout="constrained")
    for frame, (name, run) in zip(frames.flat, runs.items()):
        frame.plot(run.t, run["B.phi"][:, 0], linewidth=0.5)
        frame.set_title(name, fontsize="small")
    figure.supxlabel("t [s]")
    figure.supylabel("Phi_3 [m]")
    figure.savefig(path)


def main() -> int:
    report = Report("slider_crank", plot="plot Phi_3 into this file; needs Matplotlib")
    m, times = slider_crank(), H * np.arange(10001.0)
    print(f"{m}: {m.mobility()}\nexplicit Euler, h = {H:g} s, crank at {OMEGA:g} rad/s for 1 s\n")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", baum.Warning)  # the table shows which gains are marginal
        results = {name: simulate(m, gains, times) for name, gains in GAINS.items()}
    runs = {name: run for name, (run, _) in results.items()}
    said = {name: row for name, (_, row) in results.items()}
    report.table("gain_sets", COLUMNS, [[name, *row.values()] for name, row in said.items()])
    check(report, runs, said)
    if report.options.plot:
        plot(report.options.plot, runs)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
