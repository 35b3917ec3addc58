# SPDX-License-Identifier: BSD-3-Clause
"""A planetary gear with two inputs: one motor drives the sun, and another motor drives the ring.
The output is the arm that carries three planets. At first the ring is at rest. Then it accelerates
backwards until the arm stands still. The angular velocities are compared with Willis' equation, and
the torques with the equilibrium of the planets."""

import sys
import warnings
from pathlib import Path

import baum
import numpy as np
from support.report import Report

SUN, PLANET = 0.03, 0.02  # [m] radii of the pitch circles
ARM, RING = SUN + PLANET, SUN + 2 * PLANET
SPEED, LOAD = 10.0, 6.0  # [rad/s] of the sun, [N m] torque on the arm, against its motion
BEGIN, END, SPAN = 1.0, 2.0, 3.0  # [s] the ring accelerates from BEGIN to END
BACK = -SPEED * SUN / RING  # [rad/s] of the ring at the end


def ring_law(t: float) -> tuple[float, float, float]:
    """Return the angle of the ring [rad], its velocity and its acceleration."""
    duration = END - BEGIN
    phase = np.pi * min(max((t - BEGIN) / duration, 0.0), 1.0)
    angle = BACK / 2 * duration / np.pi * (phase - np.sin(phase)) + BACK * max(t - END, 0.0)
    acceleration = BACK / 2 * np.pi / duration * np.sin(phase)
    return angle, BACK / 2 * (1 - np.cos(phase)), acceleration


def mechanism() -> baum.Mechanism:
    m = baum.Mechanism(gravity=(0, 0))
    axles = {}
    for name, inertia in (("ring", 8e-3), ("sun", 1e-3), ("arm", 2e-3)):
        body = m.planar_body(name, mass=1, inertia=inertia, position=(0, 0))
        axles[name] = m.revolute(f"{name} bearing", m.ground, body, point=(0, 0))
    for k in range(3):
        at = ARM * np.array([np.cos(2 * np.pi * k / 3), np.sin(2 * np.pi * k / 3)])
        planet = m.planar_body(f"planet {k}", mass=0.2, inertia=4e-5, position=at)
        m.revolute(f"pin {k}", "arm", planet, point=at)
        m.gear(f"inner {k}", "sun", planet, SUN, PLANET, carrier="arm")
        m.gear(f"outer {k}", planet, "ring", PLANET, -RING, carrier="arm")
    m.load("load", "arm", torque=-LOAD)
    m.driver("sun motor", axles["sun"], rate=SPEED)
    m.driver("ring motor", axles["ring"], law=ring_law)
    return m.freeze()


def main() -> int:
    report = Report("planetary_gear", folder="write the page and the picture into this folder")
    m = mechanism()
    print(m.mobility().text)
    times = np.linspace(0, SPAN, 301)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", baum.RedundantRowsWarning)  # two planets are redundant
        run = m.simulate(times, "kinematics", record=["sun motor.effort", "ring motor.effort"])
    page = Path(report.options.folder or ".") / "planetary_gear.html"
    sun, ring, arm, planet = (
        run[f"{name}.velocity"][:, 2] for name in ("sun", "ring", "arm", "planet 0")
    )
    efforts = {name: run[f"{name} motor.effort"][:, 0] for name in ("sun", "ring")}
    m.page(
        times,
        run.q,
        page,
        title="Planetary gear",
        plots={
            "sun [rad/s]": sun,
            "ring [rad/s]": ring,
            "arm [rad/s]": arm,
            "sun motor [N m]": efforts["sun"],
            "ring motor [N m]": efforts["ring"],
        },
        marks=[(BEGIN, "the ring starts"), (END, "the arm stands still")],
    )
    m.draw(run.q[0]).save(page.with_suffix(".svg"))

    for t in (0.0, SPAN):
        k = np.searchsorted(times, t)
        print(f"at {t:g} s: arm {abs(arm[k]):.4f} rad/s, motors", end=" ")
        print(f"{efforts['sun'][k]:.4f} and {efforts['ring'][k]:.4f} N m")
    # Willis' equation: seen from the arm, the wheels roll on each other without slipping.
    willis = (SUN * sun + RING * ring) / (SUN + RING)
    report.expect("arm against Willis' equation [rad/s]", abs(arm - willis).max(), 1e-12)
    rolling = arm - (sun - arm) * SUN / PLANET
    report.expect("planet against the sun [rad/s]", abs(planet - rolling).max(), 1e-12)
    steady = (times < BEGIN) | (times > END)
    for name, radius in ("sun", SUN), ("ring", RING):
        off = abs(efforts[name][steady] - LOAD * radius / (SUN + RING)).max()
        report.expect(f"{name} motor, steady, off by [N m]", off, 1e-12)
    report.expect("redundant rows minus two", abs(m.mobility().redundant_rows - 2), 0)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
