# SPDX-License-Identifier: BSD-3-Clause
"""One driven crank moves two legs of Theo Jansen's beach animals. Jansen chose thirteen lengths:
those of the crank and of the rods, and two distances from the crank to the hip. With these lengths,
a foot moves along a nearly straight line while it is on the ground. The program writes a drawing,
and a page that shows the motion."""

import sys
from pathlib import Path
from types import SimpleNamespace

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

# Jansen's thirteen lengths [m]. The letter m stands for the length of the crank. Relative to the
# axle of the crank, the hip is at (-a, -l).
LENGTH = SimpleNamespace(
    **{"a": 0.38, "b": 0.415, "c": 0.393, "d": 0.401, "e": 0.558, "f": 0.394, "g": 0.367},
    **{"h": 0.657, "i": 0.49, "j": 0.5, "k": 0.619, "l": 0.078, "m": 0.15},
)
OMEGA = 2 * np.pi  # [rad/s] of the crank
MASS = 0.1  # [kg] lumped at each point of a body

LEG = {  # the bodies of a leg, and their points
    "upper rod": ("wrist", "knee"),
    "lower rod": ("wrist", "ankle"),
    "thigh": ("hip", "knee", "back"),
    "front rod": ("hip", "ankle"),
    "back rod": ("back", "heel"),
    "shin": ("ankle", "heel", "foot"),
}


def meet(a: Array, from_a: float, b: Array, from_b: float) -> Array:
    """Return the points (n x 2) that have given distances from points a and b and are to the left
    of the line from a to b."""
    x = b - a
    apart = np.hypot(x[:, :1], x[:, 1:])
    along = (apart**2 + from_a**2 - from_b**2) / (2 * apart)
    y = x[:, ::-1] * (-1, 1)
    found: Array = a + (along * x + np.sqrt(from_a**2 - along**2) * y) / apart
    return found


def leg_at(angle: Array, side: int) -> dict[str, Array]:
    """Return the points of a leg (n x 2) [m], computed in closed form. side: 1 for the left leg, -1
    for the right leg, which is its mirror image."""
    mirror, n = np.array([side, 1]), LENGTH
    wrist = n.m * np.stack([np.cos(angle), np.sin(angle)], axis=1) * mirror
    hip = np.full_like(wrist, (-n.a, -n.l))
    knee = meet(hip, n.b, wrist, n.j)
    ankle = meet(wrist, n.k, hip, n.c)
    back = meet(hip, n.d, knee, n.e)
    heel = meet(ankle, n.g, back, n.f)
    foot = meet(ankle, n.i, heel, n.h)
    found = dict(wrist=wrist, hip=hip, knee=knee, ankle=ankle, back=back, heel=heel, foot=foot)
    return {name: point * mirror for name, point in found.items()}


def add_body(m: baum.Mechanism, name: str, points: Array) -> baum.Body:
    centre = points.mean(axis=0)
    inertia = MASS * ((points - centre) ** 2).sum()
    return m.planar_body(name, mass=MASS * len(points), inertia=inertia, position=centre)


def add_leg(m: baum.Mechanism, which: str, side: int) -> None:
    at = {name: points[0] for name, points in leg_at(np.zeros(1), side).items()}
    foot = m.planar_particle(f"{which} foot", mass=MASS, position=at["foot"])
    owners: dict[str, list[baum.Body]] = {"wrist": [m["crank"]], "hip": [m.ground], "foot": [foot]}
    for name, corners in LEG.items():
        body = add_body(m, f"{which} {name}", np.array([at[corner] for corner in corners]))
        for corner in corners:
            owners.setdefault(corner, []).append(body)
    for corner, bodies in owners.items():
        for k, pair in enumerate(zip(bodies, bodies[1:])):
            m.revolute(f"{which} {corner} {k + 1}", *pair, point=at[corner])


def mechanism() -> baum.Mechanism:
    m = baum.Mechanism()
    crank = add_body(m, "crank", np.array([(0, 0), (LENGTH.m, 0)]))
    axle = m.revolute("axle", m.ground, crank, point=(0, 0))
    m.driver("motor", axle, rate=OMEGA)
    add_leg(m, "left", 1)
    add_leg(m, "right", -1)
    return m.freeze()


def main() -> int:
    report = Report("jansen_leg", folder="write the page and the picture into this folder")
    page = Path(report.options.folder or ".") / "jansen_leg.html"
    m = mechanism()
    turn = 200  # samples per revolution
    times = np.arange(3 * turn) * 2 * np.pi / OMEGA / turn
    run = m.simulate(times, "kinematics", record=["motor.effort"])
    feet = [m["left foot"], m["right foot"]]
    run.page(page, title="Jansen's leg", traces=feet)
    m.draw(run.q[0]).save(page.with_suffix(".svg"))

    for foot, side in zip(feet, (1, -1)):
        path = run[foot.pose][:, :2]
        exact = leg_at(OMEGA * times, side)["foot"]
        report.expect(f"{foot.name}: off the closed form [m]", abs(path - exact).max(), 1e-10)
        report.expect(
            f"{foot.name}: gap after a turn [m]", abs(path[turn:] - path[:-turn]).max(), 1e-12
        )
        down = path[:, 1] < path[:, 1].min() + 0.02
        print(f"{foot.name}: down for {down.mean():.0%} of a turn, {np.ptp(path[down, 0]):.2f} m")
        report.expect(f"{foot.name}: a turn / the part on the ground", 1 / down.mean(), 2)
    # No energy is dissipated, so the mean torque over whole revolutions is 0.
    report.expect("mean torque of the motor [N m]", abs(run["motor.effort"].mean()), 1e-9)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
