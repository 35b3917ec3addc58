# SPDX-License-Identifier: BSD-3-Clause
"""A study of a mechanism that is given entirely by Python functions: a bead moves in oil on a wire
y = x^2 - x^4 / 4. Most of the time is spent in these functions, so for a given error, the method
that needs the fewest evaluations is usually the fastest."""

import sys

import baum
import numpy as np
from support.report import Report

MASS, GRAVITY, DRAG = 0.2, 9.81, 0.05  # [kg], [m/s^2], [N s/m]
SPAN = 3.0  # [s]
METHODS = {"rk4": "step", "rk8": "rtol", "cvode_adams": "rtol"}
COLUMNS = {
    "name": ("setting", "42s"),
    "error": ("error [-]", "9.1e"),
    "work": ("evaluations", "11.0f"),
    "cpu": ("CPU [ms]", "8.1f"),
    "max_phi": ("max|Phi| [m]", "9.1e"),
}


def wire() -> baum.Mechanism:
    """Build the mechanism: two coordinates, x and y, with a mass matrix, a force and one
    constraint."""
    m = baum.Mechanism(gravity=(0, 0))
    bead = m.coordinates(
        "bead",
        2,
        q=(0.9, 0.9**2 - 0.9**4 / 4),
        v=(0, 0),
        scale=(1, 1),
        mass=lambda t, q: MASS * np.eye(2),
        force=lambda t, q, v: np.array([-DRAG * v[0], -DRAG * v[1] - MASS * GRAVITY]),
        potential=lambda t, q: MASS * GRAVITY * q[1],
        constant_mass=True,
    )
    m.constraint(
        "wire",
        [bead],
        rows=1,
        phi=lambda t, q: q[1] - q[0] ** 2 + q[0] ** 4 / 4,
        jacobian=lambda t, q: np.array([[q[0] ** 3 - 2 * q[0], 1.0]]),
        gamma=lambda t, q, v: (2 - 3 * q[0] ** 2) * v[0] ** 2,
    )
    return m.freeze()


def main() -> int:
    report = Report("wire")
    m = wire()
    study = baum.study(m, 0, SPAN, samples=30, repeats=1, entry_limit=2.0, energy_account=False)
    for name, option in METHODS.items():
        if name not in baum.integrators() or name == "cvode_adams" and not baum.has("sundials"):
            continue
        if option == "step":
            for step in (4e-2, 2e-2, 1e-2, 5e-3):
                study.add(name, step=step)
        else:
            for rtol in (1e-4, 1e-6, 1e-8, 1e-10):
                study.add(name, rtol=rtol)
    study.run()
    entries = [
        (entry.name, entry.error, entry.work, 1e3 * entry.cpu, entry.max_phi)
        for entry in study.entries
    ]
    report.table("entries", COLUMNS, entries)
    best = study.recommend(1e-6)
    print(f"for an error of 1e-06: {best.why}\n")

    times, q, _, _ = study.reference_samples()
    error = abs(m.simulate(times, **best).q - q).max()
    report.expect("uncertainty of the reference", study.reference.uncertainty, 1e-9)
    report.expect("error with the setting for 1e-06", error, 1e-6)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
