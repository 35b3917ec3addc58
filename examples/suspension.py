# SPDX-License-Identifier: BSD-3-Clause
"""A quarter of a car on a test rig, seen from the front. Double wishbones and a strut connect the
wheel to the chassis. A plate under the tyre moves up and down, as if the wheel ran over a bump in
the road. The program writes a drawing, and a page that shows the motion."""

import sys
from pathlib import Path
from typing import Any

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

# Points in the design configuration [m]
CHASSIS, HUB = np.array([0.05, 0.6]), np.array([0.6, 0.33])
INNER_LOWER, OUTER_LOWER = np.array([0.12, 0.3]), np.array([0.52, 0.24])
INNER_UPPER, OUTER_UPPER = np.array([0.2, 0.54]), np.array([0.49, 0.52])
STRUT_TOP, STRUT_FOOT = np.array([0.27, 0.8]), np.array([0.37, 0.2625])
RADIUS, WIDTH, GREY = 0.33, 0.2, "#c3cad1"  # [m] of the tyre; its colour
MASSES = {
    "chassis": 350,
    "lower wishbone": 5,
    "upper wishbone": 3,
    "wheel": 35,
    "plate": 20,
}  # [kg]
TYRE = 2e5  # [N/m] stiffness of the tyre
BUMP, BEGIN, DURATION = 0.06, 0.5, 0.25  # [m] height, [s] start and duration of the bump


def road(t: float) -> tuple[float, float, float]:
    """Return the height of the plate [m], its velocity and its acceleration."""
    if not BEGIN < t < BEGIN + DURATION:
        return 0.0, 0.0, 0.0
    rate = np.pi / DURATION
    s, c = np.sin(rate * (t - BEGIN)), np.cos(rate * (t - BEGIN))
    velocity = 4 * BUMP * rate * s**3 * c
    return BUMP * s**4, velocity, 4 * BUMP * rate**2 * s**2 * (3 * c**2 - s**2)


def rectangle(width: float, height: float) -> Array:
    return np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (width / 2, height / 2)


def mechanism() -> baum.Mechanism:
    m = baum.Mechanism()

    def add(name: str, **given: Any) -> baum.Body:
        return m.planar_body(name, mass=MASSES[name], **given)

    middle_lower, middle_upper = (INNER_LOWER + OUTER_LOWER) / 2, (INNER_UPPER + OUTER_UPPER) / 2
    chassis = add("chassis", inertia=20, position=CHASSIS)
    lower = add("lower wishbone", inertia=0.07, position=middle_lower)
    upper = add("upper wishbone", inertia=0.02, position=middle_upper)
    wheel = add("wheel", inertia=1.2, position=HUB)
    plate = add("plate", inertia=1, position=HUB * (1, 0), outline=rectangle(0.4, 0.04))
    wheel.outline = [
        baum.Polygon(rectangle(WIDTH, 2 * RADIUS), color=GREY),
        baum.Polygon(np.array([OUTER_LOWER, OUTER_UPPER, HUB]) - HUB),
    ]
    m.translational("rig", m.ground, chassis, axis=(0, 1), point=CHASSIS)
    m.revolute("inner lower", chassis, lower, point=INNER_LOWER)
    m.revolute("inner upper", chassis, upper, point=INNER_UPPER)
    m.revolute("outer lower", lower, wheel, point=OUTER_LOWER)
    m.revolute("outer upper", upper, wheel, point=OUTER_UPPER)
    m.spring(
        "strut",
        chassis,
        lower,
        point_a=STRUT_TOP - CHASSIS,
        point_b=STRUT_FOOT - middle_lower,
        stiffness=5e4,
        damping=4e3,
        free_length=0.66,
    )
    m.spring(
        "tyre",
        plate,
        wheel,
        point_a=(0, 0),
        point_b=(0, 0),
        stiffness=TYRE,
        damping=500,
        free_length=RADIUS + 0.02,
    )
    piston = m.translational("piston", m.ground, plate, axis=(0, 1), point=HUB * (1, 0))
    m.driver("road", piston, law=road)
    return m.freeze()


def main() -> int:
    report = Report("suspension", folder="write the page and the picture into this folder")
    m = mechanism()
    page = Path(report.options.folder or ".") / "suspension.html"
    record = ["road.effort", *(f"{name}.acceleration" for name in MASSES)]
    run = m.simulate(np.linspace(0, 2.5, 601), "rk8", rtol=1e-8, record=record)
    heights, camber = run["chassis.pose"][:, 1], np.degrees(run["wheel.pose"][:, 2])
    m.page(
        run.t,
        run.q,
        page,
        title="Quarter car with double wishbones",
        traces=[m["wheel"]],
        plots={
            "chassis [m]": heights - heights[-1],
            "plate [m]": run["plate.pose"][:, 1],
            "camber [deg]": camber,
            "force of the road [N]": run["road.effort"][:, 0],
        },
        marks=[(BEGIN, "bump"), (BEGIN + DURATION, "end of the bump")],
    )
    m.draw(run.q[0]).save(page.with_suffix(".svg"))

    print(f"camber from {camber.min():.2f} to {camber.max():.2f} deg")
    print(f"chassis moved by {np.ptp(heights) * 1e3:.0f} mm, plate by {BUMP * 1e3:.0f} mm")
    # Apart from gravity, the only vertical force on the bodies is that of the driver "road" on the
    # plate. This force is therefore the sum of mass (acceleration + g) over all bodies.
    force = sum(mass * (run[f"{name}.acceleration"][:, 1] + 9.81) for name, mass in MASSES.items())
    report.expect(
        "force of the road, off by [N]", abs(run["road.effort"][:, 0] - force).max(), 1e-8
    )
    # At rest the tyre carries the weight of all bodies above the plate. An error of 1e-9 m in the
    # length of the tyre spring changes its force by 2e-4 N.
    rest = m.simulate([20], "rk8", rtol=1e-8)
    across, up = (rest["wheel.pose"] - rest["plate.pose"])[0, :2]
    tyre = TYRE * ((RADIUS + 0.02) / np.hypot(across, up) - 1) * up
    weight = 9.81 * (sum(MASSES.values()) - MASSES["plate"])
    report.expect("tyre force at rest minus weight [N]", abs(tyre - weight), 1e-3)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
