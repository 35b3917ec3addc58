# SPDX-License-Identifier: BSD-3-Clause
"""A spatial four-bar (RSSR). A driven crank rotates about the z axis. It moves a rocker through a
coupler with a spherical joint at each end. The axis of the rocker has another direction. The
coupler can rotate about its own axis without moving the other bodies. If a massless rod replaces
the coupler, no degree of freedom remains, and the motion follows from the constraints alone."""

import sys

import baum
import numpy as np
from baum import catalog, inertia
from baum.typing import Array
from support.report import Report

CRANK, COUPLER, ROCKER = 0.10, 0.40, 0.25  # [m]
PIVOT = np.array([0.20, 0.30, 0.05])  # [m] pivot of the rocker
AXIS = np.array([1.0, 0.0, 0.0])  # axis of the rocker; at angle 0 the rocker is along y
OMEGA = 4 * np.pi  # [rad/s] of the crank

COLUMNS = {
    "crank": ("crank [deg]", "9.1f"),
    "rocker": ("rocker [deg]", "10.5f"),
    "effort": ("motor [N m]", "9.4f"),
    "rod": ("with a rod [N m]", "9.4f"),
}


def crank_end(angle: Array) -> Array:
    """Return the points (n x 3) at which the coupler is attached to the crank [m]."""
    return CRANK * np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)


def rocker_end(angle: Array) -> Array:
    """Return the points (n x 3) at which the coupler is attached to the rocker [m]."""
    return PIVOT + ROCKER * np.stack([np.zeros_like(angle), np.cos(angle), np.sin(angle)], axis=-1)


def rocker_angle(t: Array) -> Array:
    """Return the exact angle of the rocker [rad]. The catalogue contains this mechanism with a
    coupler that does not rotate about its own axis. The motion of that mechanism is known in closed
    form, and its rocker has the same angle."""
    q = catalog.reference("rssr", t).q
    # q[:, 17] and q[:, 18] are w and x of the rocker's quaternion.
    found: Array = np.unwrap(2 * np.arctan2(q[:, 18], q[:, 17]))
    return found


def axes_along(x: Array) -> Array:
    """Return three perpendicular axes as columns. The first axis points along the vector x."""
    first = x / np.linalg.norm(x)
    second = np.cross((0, 0, 1), first)
    second = second / np.linalg.norm(second)
    return np.stack([first, second, np.cross(first, second)], axis=1)


def mechanism(with_coupler: bool) -> baum.Mechanism:
    """Build the mechanism, with the coupler or with a massless rod. At the start the crank points
    along x."""
    start = np.zeros(1)
    a, b = crank_end(start)[0], rocker_end(rocker_angle(start))[0]
    m = baum.Mechanism(up="z")
    for name, mass, length, from_, to in (
        ("crank", 0.3, CRANK, np.zeros(3), a),
        ("coupler", 0.5, COUPLER, a, b),
        ("rocker", 0.6, ROCKER, PIVOT, b),
    ):
        if name != "coupler" or with_coupler:
            m.spatial_body(
                name,
                mass=mass,
                inertia=inertia.cylinder(mass, 0.01, length, axis="x"),
                position=(from_ + to) / 2,
                orientation=axes_along(to - from_),
            )
    shaft = m.spatial_revolute("shaft", m.ground, "crank", point=(0, 0, 0))
    m.spatial_revolute("pivot", m.ground, "rocker", point=PIVOT, axis=AXIS)
    if with_coupler:
        m.spherical("ball_a", "crank", "coupler", point=a)
        m.spherical("ball_b", "coupler", "rocker", point=b)
    else:
        ends = (CRANK / 2, 0, 0), (ROCKER / 2, 0, 0)
        m.spatial_distance("rod", "crank", "rocker", point_a=ends[0], point_b=ends[1])
    m.driver("motor", shaft, rate=OMEGA)
    return m.freeze()


def main() -> int:
    report = Report("rssr")
    times = np.linspace(0, 2 * np.pi / OMEGA, 181)
    record = ["pivot.coordinate", "motor.effort", "energy"]
    whole, light = mechanism(True), mechanism(False)
    run = whole.simulate(times, "rk8", rtol=1e-10, record=record)
    rod = light.simulate(times, "kinematics", record=record)
    print(f"{whole}: {whole.mobility()}\n{light}: {light.mobility()}\n{run.explain}\n")

    exact = rocker_angle(times)
    angles = [one["pivot.coordinate"][:, 0] + exact[0] for one in (run, rod)]
    efforts = [one["motor.effort"][:, 0] for one in (run, rod)]
    rows = np.stack([np.degrees(OMEGA * times), np.degrees(angles[0]), *efforts], axis=1)
    report.table("turn", COLUMNS, rows[::15].tolist())
    report.counters(run.counters)

    report.expect("rocker against the closed form [rad]", abs(angles[0] - exact).max(), 1e-9)
    report.expect("with a rod: rocker, off by [rad]", abs(angles[1] - exact).max(), 1e-11)
    # There is no friction, so the mean power of the motor over a revolution is 0.
    for name, one, effort in ("coupler", run, efforts[0]), ("rod", rod, efforts[1]):
        work = OMEGA * effort[1:].mean() * times[-1]
        report.expect(f"{name}: work in a revolution [J]", abs(work), 1e-8)
        energy = one["energy"].sum(axis=1)
        change = abs(energy[-1] - energy[0])
        report.expect(f"{name}: energy change in a revolution [J]", change, 1e-8)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
