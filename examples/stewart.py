# SPDX-License-Identifier: BSD-3-Clause
"""A Stewart platform: six legs of variable length move a platform in all six degrees of freedom.

The inverse kinematics is a formula: the lengths of the legs follow from the pose of the platform.
The program computes these lengths for a circular motion, and drives the legs by splines through
them. The forward kinematics has no simple formula. The library finds the pose of the platform from
the lengths of the legs by assembly, even from rough guesses."""

import sys

import baum
import numpy as np
from baum import inertia
from baum.typing import Array
from support.report import Report

FEET = np.radians([-15, 15, 105, 135, 225, 255])  # directions of the feet of the legs on the ground
BALLS = np.radians([-45, 45, 75, 165, 195, 285])  # directions of the ball joints on the platform
FOOT_RADIUS, BALL_RADIUS, HEIGHT = 1.0, 0.6, 1.0  # [m]
CIRCLE, TILT, PERIOD = 0.15, 0.12, 2.0  # [m] radius, [rad] tilt, [s] period of the motion
COMMANDS = 200  # number of prescribed values of each length in a period
PLATFORM, LOWER, UPPER = 50.0, 4.0, 2.0  # [kg] masses of the platform and of the parts of a leg
STARTS = 100  # number of guesses for the forward kinematics

COLUMNS = {
    "t": ("t [s]", "5.2f"),
    "x": ("x [m]", "8.4f"),
    "y": ("y [m]", "8.4f"),
    **{f"leg{k}": (f"leg {k} [m]", "8.4f") for k in range(1, 7)},
    "effort": ("leg 1 [N]", "8.2f"),
}


def on_circle(radius: float, angles: Array) -> Array:
    """Return points (n x 3) on a horizontal circle."""
    return radius * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)


def wanted_pose(t: float) -> tuple[Array, Array]:
    """Return position [m] and orientation (3 x 3) of the platform. Its centre moves on a circle,
    and it leans about the x axis with the same period."""
    phase = 2 * np.pi * t / PERIOD
    a = TILT * np.sin(phase)
    lean = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    return np.array([CIRCLE * np.cos(phase), CIRCLE * np.sin(phase), HEIGHT]), lean


def legs(position: Array, axes: Array) -> Array:
    """Return the vectors (6 x 3) from the feet to the ball joints. This is the inverse kinematics,
    because the norms of these vectors are the lengths of the legs."""
    ends: Array = position + on_circle(BALL_RADIUS, BALLS) @ axes.T
    return ends - on_circle(FOOT_RADIUS, FEET)


def matrix(pose: Array) -> Array:
    """Return the orientation (3 x 3) of a pose."""
    w, x, y, z = pose[3:]
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def lengths(pose: Array) -> Array:
    """Return the lengths of the legs (6) for a pose of the platform."""
    norms: Array = np.linalg.norm(legs(pose[:3], matrix(pose)), axis=1)
    return norms


def add_leg(m: baum.Mechanism, k: int, foot: Array, leg: Array) -> baum.Joint:
    """Add leg k as two bodies, and return the joint between them. leg: the vector from its foot to
    its ball joint."""
    along: Array = leg / np.linalg.norm(leg)
    across: Array = np.cross(np.array([1.0, 0, 0]), along)  # second axis of the universal joint
    across = across / np.linalg.norm(across)
    axes = np.stack([along, np.cross(across, along), across], axis=1)
    for name, mass, centre in (
        ("lower", LOWER, foot + 0.35 * along),
        ("upper", UPPER, foot + leg - 0.35 * along),
    ):
        m.spatial_body(
            f"{name} {k}",
            mass=mass,
            inertia=inertia.cylinder(mass, 0.03, 0.7, axis="x"),
            position=centre,
            orientation=axes,
        )
    m.universal(None, m.ground, f"lower {k}", point=foot, axis=(1, 0, 0), axis_b=across)
    m.spherical(None, f"upper {k}", "platform", point=foot + leg)
    return m.prismatic(f"leg {k}", f"lower {k}", f"upper {k}", point=foot, axis=along)


def mechanism(times: Array, commands: Array) -> baum.Mechanism:
    """Build the platform with driven legs. commands: the lengths of the legs (n x 6)."""
    m = baum.Mechanism(up="z")
    position, axes = wanted_pose(0)
    m.spatial_body(
        "platform",
        mass=PLATFORM,
        inertia=inertia.cylinder(PLATFORM, BALL_RADIUS, 0.05, axis="z"),
        position=position,
        orientation=axes,
    )
    feet = on_circle(FOOT_RADIUS, FEET)
    for k, leg in enumerate(legs(position, axes)):
        slide = add_leg(m, k + 1, feet[k], leg)
        change = commands[:, k] - commands[0, k]  # the coordinate is 0 at the start
        m.spline_driver(f"actuator {k + 1}", slide, times, change, periodic=True)
    return m.freeze()


def forward(m: baum.Mechanism, t: float, guess: Array) -> Array:
    """Return the pose of the platform (7) for the lengths that the legs have at time t. Assembly
    starts from the design configuration, moved by the displacement `guess`."""
    workspace = baum.Workspace(m)
    q, v = workspace.design()
    nothing = np.full(len(v), np.nan)  # assembly computes these velocities
    found, _ = workspace.assemble(t, workspace.move(guess, q), nothing)
    pose: Array = found[m["platform"].columns[0]]
    return pose


def main() -> int:
    report = Report("stewart")
    times = np.linspace(0, PERIOD, COMMANDS + 1)
    commands = np.array([np.linalg.norm(legs(*wanted_pose(t)), axis=1) for t in times])
    commands[-1] = commands[0]  # a periodic spline ends exactly where it begins
    m = mechanism(times, commands)
    names = [f"actuator {k}" for k in range(1, 7)]
    record = [*(f"{name}.effort" for name in names), *(f"leg {k}.coordinate" for k in range(1, 7))]
    run = m.simulate(times, "kinematics", record=[*record, "energy"])
    print(f"{m}: {m.mobility()}\n{run.explain}\n")

    poses = run["platform.pose"]
    efforts = np.stack([run[f"{name}.effort"][:, 0] for name in names], axis=1)
    rates = np.stack([run[f"leg {k}.coordinate"][:, 1] for k in range(1, 7)], axis=1)
    rows = np.column_stack([times, poses[:, :2], commands, efforts[:, 0]])
    report.table("motion", COLUMNS, rows[:: COMMANDS // 10].tolist())

    wanted = np.array([wanted_pose(t)[0] for t in times])
    report.expect("platform at the commands, off by [m]", abs(poses[:, :3] - wanted).max(), 1e-12)
    length = abs(np.array([lengths(pose) for pose in poses]) - commands).max()
    report.expect("leg lengths of these poses, off by [m]", length, 1e-12)
    between = times[:-1] + np.diff(times) / 2
    off = m.simulate(between, "kinematics", start_time=between[0])["platform.pose"][:, :3]
    off -= np.array([wanted_pose(t)[0] for t in between])
    report.expect("platform between commands, off by [m]", abs(off).max(), 1e-8)
    # There is no friction, so the actuators do no work in a period. The power is periodic, so the
    # trapezoidal rule gives the work very accurately.
    work = (efforts * rates).sum(axis=1)[1:].mean() * PERIOD
    report.expect("work of the actuators [J]", abs(work), 1e-10)

    # Forward kinematics from guesses: each body is out of place by up to 0.1 m along every axis and
    # up to 0.2 rad about it.
    random = np.random.default_rng(1)
    most = np.tile([0.1, 0.1, 0.1, 0.2, 0.2, 0.2], 13)
    errors = []
    for k in random.integers(0, COMMANDS, STARTS):
        pose = forward(m, float(times[k]), random.uniform(-most, most))
        errors.append([abs(lengths(pose) - commands[k]).max(), abs(pose[:3] - wanted[k]).max()])
    report.expect(f"lengths from {STARTS} guesses, off by [m]", np.max(errors, axis=0)[0], 1e-12)
    report.expect(f"poses from {STARTS} guesses, off by [m]", np.max(errors, axis=0)[1], 1e-11)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
