# SPDX-License-Identifier: BSD-3-Clause
"""This example shows events and break times. In the first part a pendulum bounces at a stop, and
the run finds the times of the bounces. In the second part a torque acts on a pendulum during short
intervals, whose times are known in advance."""

import sys
from pathlib import Path

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

LENGTH = 1.0  # [m] of a uniform rod of 1 kg
ANGLE = 1.0  # [rad] initial angle
STOP = 0.0  # [rad] angle of the stop, straight below the pin
RESTITUTION = 0.9  # speed after a bounce / speed before it
BOUNCES = 8
# Times [s], and the torque [N m] from each of them on.
KICKS = (1.0, 10.0), (1.05, 0.0), (2.0, 10.0), (2.05, 0.0), (3.0, 10.0), (3.05, 0.0)


def pendulum() -> baum.Mechanism:
    m = baum.Mechanism()
    place = LENGTH / 2 * np.sin(ANGLE), -LENGTH / 2 * np.cos(ANGLE)
    rod = m.planar_body(
        "rod", mass=1, inertia=LENGTH**2 / 12, position=place, angle=ANGLE, angular_velocity=0
    )
    m.revolute("pin", m.ground, rod, point=(0, 0))
    m.load("motor", rod, torque=1, input=m.input("kick"))
    return m.freeze()


def quarter(angle: float) -> float:
    """Return the duration [s] of a quarter of a swing of the given amplitude. It is K(sin(angle /
    2)) sqrt(2 l / (3 g)) for a uniform rod of length l. The arithmetic-geometric mean gives the
    complete elliptic integral K."""
    a, b = 1.0, np.cos(angle / 2)
    for _ in range(8):
        a, b = (a + b) / 2, np.sqrt(a * b)
    return float(np.pi / (2 * a) * np.sqrt(2 * LENGTH / (3 * 9.81)))


def exact_times() -> Array:
    """Return the exact times of the bounces. A bounce multiplies the kinetic energy by
    RESTITUTION^2. In the next swing this energy becomes potential energy. The potential energy is
    proportional to 1 - cos(angle), so it gives the amplitude."""
    left = RESTITUTION ** (2 * np.arange(1, BOUNCES)) * (1 - np.cos(ANGLE))
    between = [2 * quarter(angle) for angle in np.arccos(1 - left)]
    times: Array = quarter(ANGLE) + np.concatenate([[0], np.cumsum(between)])
    return times


def bounces(m: baum.Mechanism) -> tuple[Array, list[baum.Run]]:
    """Simulate the pendulum. Return the times of the bounces [s] with the angular velocities before
    them [rad/s], and the samples until each bounce."""
    s = m.simulation("rk8", rtol=1e-10)
    s.event("pin", STOP, direction=-1, name="stop")
    rows: list[tuple[float, float]] = []
    runs = []
    while len(rows) < BOUNCES:
        runs.append(s.sample(np.arange(s.time, s.time + 10, 0.02)))
        rows.append((s.time, s.v[2]))
        s.set_state(s.time, s.q, -RESTITUTION * s.v)
    return np.array(rows).T, runs


def main() -> int:
    report = Report("events", folder="write the page into this folder")
    m = pendulum()
    (times, rates), runs = bounces(m)
    error = times - exact_times()
    columns = {
        "t": ("t [s]", "12.9f"),
        "rate": ("rate before [rad/s]", "12.9f"),
        "error": ("error of t [s]", "9.1e"),
    }
    report.table("bounces", columns, np.stack([times, rates, error], axis=1).tolist())

    t, q, v = (np.concatenate([getattr(run, key) for run in runs]) for key in ("t", "q", "v"))
    m.page(
        t,
        q,
        Path(report.options.folder or ".") / "events.html",
        title="Pendulum at a stop",
        plots={"angle [rad]": q[:, 2], "angular velocity [rad/s]": v[:, 2]},
        marks=[(time, "bounce") for time in times],
    )

    s = m.simulation("rk8", rtol=1e-10, energy_account=True)
    s.schedule_input("kick", *np.transpose(KICKS))
    kicked = s.sample([t for t, _ in KICKS], record=["energy_account"])
    names = [f"{name} [J]" for name in ("kinetic", "potential", "work of kicks", "residual")]
    columns = {name: (name, "12.4e") for name in ("t [s]", *names)}
    account = kicked["energy_account"][:, [0, 1, 2, -1]]
    report.table("kicks", columns, np.column_stack([kicked.t, account]).tolist())
    report.counters(kicked.counters)

    report.expect("times of bounces, off by [s]", abs(error).max(), 1e-8)
    report.expect("residual of the energy [J]", abs(account[:, -1]).max(), 1e-8)
    report.expect("rejected steps where kicks are known", kicked.counters.rejected, 5)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
