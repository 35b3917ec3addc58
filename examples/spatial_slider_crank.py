# SPDX-License-Identifier: BSD-3-Clause
"""A slider-crank in space. The crank rotates about the z axis. The slider moves parallel to the x
axis, on the line y = BESIDE, z = ABOVE. The crank is released at 20 rad/s. The position of the
slider follows from the angle of the crank in closed form, and the energy must stay constant."""

import sys

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

CRANK, ROD = 0.1, 0.35  # [m]
BESIDE, ABOVE = 0.05, 0.08  # [m] y and z of the slider
SPEED = 20.0  # [rad/s] of the crank at the start

COLUMNS = {
    "t": ("t [s]", "6.2f"),
    "angle": ("crank [rad]", "11.6f"),
    "x": ("slider [m]", "10.6f"),
    "force": ("guide on slider [N]", "19.3f"),
}


def slider_at(angle: Array) -> Array:
    """Return x of the slider [m] in closed form."""
    y = BESIDE - CRANK * np.sin(angle)
    x: Array = CRANK * np.cos(angle) + np.sqrt(ROD**2 - y**2 - ABOVE**2)
    return x


def axes_along(x: Array) -> Array:
    """Return three perpendicular axes as columns. The first axis points along the vector x."""
    first = x / np.linalg.norm(x)
    second = np.cross((0, 0, 1), first)
    second = second / np.linalg.norm(second)
    return np.stack([first, second, np.cross(first, second)], axis=1)


def bar_inertia(mass: float, length: float) -> tuple[float, float, float]:
    """Return the principal moments of inertia [kg m^2] of a bar along x. The radius of gyration
    about x is 1 cm."""
    across = mass * length**2 / 12
    return 1e-4 * mass, across, across


def mechanism() -> baum.Mechanism:
    a = np.array([CRANK, 0, 0])
    b = np.array([float(slider_at(np.zeros(1))[0]), BESIDE, ABOVE])
    m = baum.Mechanism(up="z")
    crank = m.spatial_body(
        "crank",
        mass=0.2,
        inertia=bar_inertia(0.2, CRANK),
        position=a / 2,
        angular_velocity=(0, 0, SPEED),
    )
    rod = m.spatial_body(
        "rod",
        mass=0.3,
        inertia=bar_inertia(0.3, ROD),
        position=(a + b) / 2,
        orientation=axes_along(b - a),
    )
    slider = m.spatial_body("slider", mass=0.4, inertia=(1e-4, 1e-4, 1e-4), position=b)
    m.spatial_revolute("shaft", m.ground, crank, point=(0, 0, 0), axis=(0, 0, 1))
    m.spherical("ball", crank, rod, point=a)
    across = np.cross((b - a), (0, 0, 1))  # horizontal and perpendicular to the rod
    m.universal("cross", slider, rod, point=b, axis=(0, 0, 1), axis_b=across)
    m.prismatic("guide", m.ground, slider, point=b, axis=(1, 0, 0))
    return m.freeze()


def main() -> int:
    report = Report("spatial_slider_crank")
    m = mechanism()
    times = np.linspace(0, 1, 401)
    run = m.simulate(times, "rk8", rtol=1e-10, record=["shaft.angle", "guide.reaction", "energy"])
    angle, x = run["shaft.angle"][:, 0], run["slider.pose"][:, 0]
    force = np.linalg.norm(run["guide.reaction"][:, 1:3], axis=1)
    report.table("motion", COLUMNS, np.stack([run.t, angle, x, force], axis=1)[::20].tolist())
    energy = run["energy"].sum(axis=1)
    report.expect("degrees of freedom minus 1", abs(m.mobility().degrees_of_freedom - 1), 0)
    report.expect("slider against the closed form [m]", abs(x - slider_at(angle)).max(), 1e-12)
    report.expect("energy change [J]", abs(energy - energy[0]).max(), 1e-8)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
