# SPDX-License-Identifier: BSD-3-Clause
"""This program computes the motion of the quick-return mechanism of a shaper by kinematics. The
motor leaves no degree of freedom, so every configuration follows from the constraints alone. The
torque of the motor follows from the accelerations.

A pin of the crank slides in a slot of the rocker. A pin of the ram slides in the same slot, and a
guide lets the ram move only horizontally. With the lengths R, D and H that are defined below, and
with the crank at angle p, the ram is at x = H R cos(p) / (D + R sin(p)).
"""

import sys

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

# [m] length of the crank; heights of its shaft and of the ram above the rocker's pivot
R, D, H = 0.1, 0.25, 0.6
OMEGA = 4 * np.pi  # [rad/s] two revolutions per second
DAMPING = 200.0  # [N s/m] of the guide
SAMPLES = 360  # per revolution

COLUMNS = {
    "p": ("crank [deg]", "9.1f"),
    "x": ("ram [m]", "9.5f"),
    "v": ("[m/s]", "9.4f"),
    "a": ("[m/s^2]", "9.3f"),
    "effort": ("motor [N m]", "9.3f"),
    "tip": ("rocker on ram [N]", "9.2f"),
}


def shaper() -> baum.Mechanism:
    """Build the mechanism of three bodies. The crank is at angle 0. The other poses are only
    approximate; assembly moves the bodies to their places."""
    m = baum.Mechanism()
    crank = m.planar_body("crank", mass=3, inertia=0.02, position=(0, D))
    rocker = m.planar_body("rocker", mass=4, inertia=0.1, position=(0.1, 0.3), angle=1.2)
    ram = m.planar_body("ram", mass=12, inertia=0.2, position=(0.25, H))
    shaft = m.revolute("shaft", m.ground, crank, point_a=(0, D), point_b=(0, 0))
    m.revolute("pivot", m.ground, rocker, point_a=(0, 0), point_b=(-0.3, 0))
    m.pin_in_slot("slot", rocker, crank, point_a=(0, 0), point_b=(R, 0))
    m.pin_in_slot("tip", rocker, ram, point_a=(0, 0), point_b=(0, 0))
    m.translational("guide", m.ground, ram, axis=(1, 0), point_a=(0, H), point_b=(0, 0))
    m.force("oil", [ram], lambda t, q, v: (-DAMPING * v[0], 0, 0))
    m.driver("motor", shaft, value=0, rate=OMEGA)
    return m.freeze()


def ram_at(t: Array) -> Array:
    """Return x [m], x' and x'' of the ram, computed in closed form."""
    sine, cosine = np.sin(OMEGA * t), np.cos(OMEGA * t)
    height = D + R * sine
    x = H * R * cosine / height
    v = -OMEGA * H * R * (D * sine + R) / height**2
    a = -(OMEGA**2) * H * R * cosine * (D * height - 2 * R * (D * sine + R)) / height**3
    return np.stack([x, v, a])


def turning_times() -> Array:
    """Return the two times [s] at which the ram reverses its direction, where sin(p) = -R / D.
    Between these times the ram moves back."""
    more = np.arcsin(R / D)
    times: Array = np.array([np.pi + more, 2 * np.pi - more]) / OMEGA
    return times


def main() -> int:
    report = Report("kinematics")
    m = shaper()
    times = np.linspace(0, 2 * np.pi / OMEGA, SAMPLES + 1)
    record = ["ram.acceleration", "motor.effort", "tip.reaction", "energy"]
    run = m.simulate(times, "kinematics", record=record)
    print(f"{m}: {m.mobility()}\n{run.explain}\n")

    ram = np.stack([run[f"ram.{what}"][:, 0] for what in ("pose", "velocity", "acceleration")])
    effort, push = run["motor.effort"][:, 0], run["tip.reaction"][:, 0]
    rows = np.stack([360 * times * OMEGA / (2 * np.pi), *ram, effort, push], axis=1)
    report.table("turn", COLUMNS, rows[:: SAMPLES // 12].tolist())
    report.counters(run.counters)
    back = np.diff(turning_times())[0]
    print(f"the ram goes out in {times[-1] - back:.3f} s and back in {back:.3f} s\n")

    error = abs(ram - ram_at(times)).max(axis=1)
    report.expect("ram against the closed form, off by [m]", error[0], 1e-12)
    report.expect("its velocity, off by [m/s]", error[1], 1e-11)
    report.expect("its acceleration, off by [m/s^2]", error[2], 1e-9)
    turned = m.simulate(turning_times(), "kinematics")["ram.velocity"][:, 0]
    report.expect("velocity where the ram reverses [m/s]", abs(turned).max(), 1e-11)
    # The torque of the motor and the velocity of the ram are periodic. The trapezoidal rule gives
    # the mean torque and the mean square of this velocity exactly, up to rounding errors.
    work = OMEGA * effort[1:].mean() * times[-1]
    lost = DAMPING * (ram[1, 1:] ** 2).mean() * times[-1]
    report.expect("work of the motor minus loss in oil [J]", abs(work - lost), 1e-9 * lost)
    energy = run["energy"].sum(axis=1)
    report.expect("energy after a turn, off by [J]", abs(energy[-1] - energy[0]), 1e-9)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
