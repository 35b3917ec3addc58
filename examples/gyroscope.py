# SPDX-License-Identifier: BSD-3-Clause
"""A heavy top: a disc on a light axle. A spherical joint holds the lower end of the axle. At a
certain angular velocity about its axle, the top precesses steadily. If the top spins slightly more
slowly, its tilt oscillates."""

import sys

import baum
import numpy as np
from baum import inertia
from baum.typing import Array
from support.report import Report

MASS, RADIUS, THICKNESS = 0.5, 0.08, 0.02  # [kg], [m], [m] of the disc
ARM = 0.1  # [m] from the joint to the centre of mass
TILT = np.radians(50)  # of the axle from the vertical
PRECESSION = 2.0  # [rad/s] about the vertical
GRAVITY = 9.81  # [m/s^2]
SPAN = 3.0  # [s]

DISC = inertia.cylinder(MASS, RADIUS, THICKNESS, axis="z")
AXIAL = DISC[2, 2]  # [kg m^2] moment of inertia about the axle
ACROSS = inertia.shift(DISC, MASS, (0, 0, ARM))[0, 0]  # [kg m^2] across the axle, about the joint

COLUMNS = {
    "t": ("t [s]", "5.2f"),
    "azimuth": ("azimuth [rad]", "12.8f"),
    "tilt": ("tilt [deg]", "12.8f"),
    "nodding": ("with less spin [deg]", "12.4f"),
    "support": ("vertical support [N]", "12.6f"),
}


def steady_spin() -> float:
    """Return the angular velocity about the axle [rad/s] at which the top precesses steadily. With
    p = PRECESSION and n = TILT, the result `spin` satisfies AXIAL spin p - ACROSS p^2 cos(n) = MASS
    GRAVITY ARM."""
    weight = MASS * GRAVITY * ARM
    return float((weight + ACROSS * PRECESSION**2 * np.cos(TILT)) / (AXIAL * PRECESSION))


def top(spin: float) -> baum.Mechanism:
    """Build the top. Its axle is the z axis of the body. At the start its centre of mass is in the
    plane of x and z."""
    m = baum.Mechanism(up="z")
    sine, cosine = np.sin(TILT), np.cos(TILT)
    axes = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])  # columns: axes of the body
    m.spatial_body(
        "top",
        mass=MASS,
        inertia=DISC,
        position=ARM * axes[:, 2],
        orientation=axes,
        angular_velocity=(-PRECESSION * sine, 0, spin),
    )
    m.spherical("foot", m.ground, "top", point=(0, 0, 0))
    return m.freeze()


def simulate(spin: float, times: Array) -> tuple[baum.Run, Array]:
    """Simulate the top. Return the run, and the azimuth and the tilt [rad] of the axle (2 x n)."""
    record = ["foot.reaction", "top.velocity", "energy"]
    run = top(spin).simulate(times, "rk8", rtol=1e-10, record=record)
    x, y, z = run["top.pose"][:, :3].T
    return run, np.stack([np.unwrap(np.arctan2(y, x)), np.arctan2(np.hypot(x, y), z)])


def vertical_momentum(run: baum.Run) -> Array:
    """Return the angular momentum [N m s] about the vertical through the joint. Gravity does not
    change it."""
    r, velocity = run["top.pose"][:, :3], run["top.velocity"]  # both in ground axes
    v, w = velocity[:, :3], velocity[:, 3:]
    spin = (w * r).sum(axis=1, keepdims=True) * r / ARM**2
    own = AXIAL * spin + DISC[0, 0] * (w - spin)
    total: Array = (own + MASS * np.cross(r, v))[:, 2]
    return total


def main() -> int:
    report = Report("gyroscope")
    times = np.linspace(0, SPAN, 61)
    spin = steady_spin()
    run, (azimuth, tilt) = simulate(spin, times)
    less, (_, nodding) = simulate(0.9 * spin, times)
    print(f"{run.mechanism}\nspin {spin:.3f} rad/s\n{run.explain}\n")
    support = run["foot.reaction"][:, 2]
    rows = np.stack([times, azimuth, np.degrees(tilt), np.degrees(nodding), support], axis=1)
    report.table("motion", COLUMNS, rows[::6].tolist())
    report.counters(run.counters)

    report.expect("azimuth, off by [rad]", abs(azimuth - PRECESSION * times).max(), 1e-7)
    report.expect("tilt, off by [rad]", abs(tilt - TILT).max(), 1e-7)
    report.expect("support minus the weight [N]", abs(support - MASS * GRAVITY).max(), 1e-6)
    report.expect("with less spin: 0.5 deg / nutation [-]", np.radians(0.5) / np.ptp(nodding), 1.0)
    for name, one in ("steady", run), ("with less spin", less):
        energy = one["energy"].sum(axis=1)
        report.expect(f"{name}: energy change [J]", abs(energy - energy[0]).max(), 1e-8)
        momentum = vertical_momentum(one)
        change = abs(momentum / momentum[0] - 1).max()
        report.expect(f"{name}: vertical momentum, off by", change, 1e-7)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
