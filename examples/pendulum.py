# SPDX-License-Identifier: BSD-3-Clause
"""A pendulum modelled by one constraint function: 1 kg on a massless rod of 1 m, released from the
horizontal."""

import sys
from typing import Any

import baum
import numpy as np
from support.report import Report

METHOD: dict[str, Any] = (
    dict(integrator="cvode_adams", rtol=1e-9)
    if baum.has("sundials")
    else dict(integrator="rk4", step=2e-3)
)
COLUMNS = {
    "t": ("t [s]", "5.1f"),
    "x": ("x [m]", "12.9f"),
    "y": ("y [m]", "12.9f"),
    "phi": ("Phi [m^2]", "9.1e"),
    "energy_change": ("energy change [J]", "9.1e"),
}


def pendulum() -> baum.Mechanism:
    """Build the mechanism. The function Phi(q) = x^2 + y^2 - 1 is the only thing that the library
    needs to know about the rod."""
    m = baum.Mechanism()
    bob = m.planar_particle("bob", mass=1, position=(1, 0))
    m.constraint("rod", [bob], rows=1, phi=lambda t, q: q @ q - 1)
    return m.freeze()


def period() -> float:
    """Return the period [s] of swings from -90 to 90 degrees. It is 4 K(k) sqrt(l/g) with k^2 = 1/2
    and the length l. The arithmetic-geometric mean gives the complete elliptic integral K."""
    a, b = 1.0, np.sqrt(0.5)
    for _ in range(6):
        a, b = (a + b) / 2, np.sqrt(a * b)
    return float(2 * np.pi / a * np.sqrt(1 / 9.81))


def main() -> int:
    report = Report("pendulum")
    m = pendulum()
    lowest = period() * (0.25 + 0.5 * np.arange(8))
    times = np.sort(np.concatenate([np.arange(0, 10.5, 0.5), lowest]))
    run = m.simulate(times, record=["rod.phi", "energy"], **METHOD)
    print(f"{m}\n{run.explain}\n")

    energy = run["energy"].sum(axis=1)
    every = ~np.isin(run.t, lowest)
    columns = (run.t, *run["bob.pose"].T, run["rod.phi"][:, 0], energy - energy[0])
    report.table("motion", COLUMNS, np.stack(columns, axis=1)[every].tolist())
    report.counters(run.counters)

    error = np.abs(run["bob.pose"][~every] - (0, -1)).max()
    report.expect("lowest point at its times, off by [m]", error, 1e-6)
    report.expect("largest violation max|Phi| [m^2]", run.counters.max_phi, 1e-7)
    report.expect("energy change [J]", abs(energy - energy[0]).max(), 1e-6)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
