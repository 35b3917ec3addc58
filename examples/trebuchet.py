# SPDX-License-Identifier: BSD-3-Clause
"""A trebuchet throws a stone in three phases. First the sling drags the stone along a trough. The
stone lifts off when the force of the trough on the stone becomes zero, and an event finds this
time. Then the stone swings in the sling, until it moves upward at 45 degrees and the sling opens.
Finally the stone flies. Each phase has a mechanism of its own, with the same bodies but other
joints, and begins in the last state of the previous phase."""

import sys
from pathlib import Path
from typing import Optional

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

HEIGHT, SHORT, LONG, HANGER, SLING = 1.5, 0.4, 1.6, 0.3, 1.4  # [m]
BEAM, WEIGHT, STONE = 12.0, 120.0, 1.0  # [kg]
GRAVITY = 9.81  # [m/s^2]
START = np.arcsin(HEIGHT / LONG)  # [rad] angle of the beam when its long end is on the ground
RELEASE = np.tan(np.radians(45))  # slope of the velocity at the release
SAMPLE = 0.01  # [s] time between two samples


def bodies() -> baum.Mechanism:
    """Build the bodies, and the joints that every phase has."""
    m = baum.Mechanism(gravity=(0, -GRAVITY))
    along = np.array([np.cos(START), np.sin(START)])  # from the long end to the short end
    pivot, middle = np.array([0, HEIGHT]), (SHORT - LONG) / 2
    beam = m.planar_body(
        "beam",
        mass=BEAM,
        inertia=BEAM * (SHORT + LONG) ** 2 / 12,
        position=pivot + middle * along,
        angle=START,
        angular_velocity=0,
    )
    beam.outline = baum.Box((SHORT + LONG, 0.06, 0))
    hanging = pivot + SHORT * along - (0, HANGER)
    weight = m.planar_particle("weight", mass=WEIGHT, position=hanging, velocity=(0, 0))
    weight.outline = baum.Circle(0.14)
    tip = pivot - LONG * along
    stone = m.planar_particle("stone", mass=STONE, position=tip + (SLING, 0), velocity=(0, 0))
    stone.outline = baum.Circle(0.06, color="#555555")
    m.revolute("pivot", m.ground, beam, point_a=pivot, point_b=(-middle, 0))
    m.distance("hanger", beam, weight, point_a=(SHORT - middle, 0), point_b=(0, 0), length=HANGER)
    return m


def add_sling(m: baum.Mechanism) -> None:
    end = (-(SHORT + LONG) / 2, 0)
    m.distance("sling", "beam", "stone", point_a=end, point_b=(0, 0), length=SLING)


def phase(m: baum.Mechanism, before: Optional[baum.Simulation]) -> baum.Simulation:
    """Start a phase in the last state of the previous phase, if there is one."""
    s = m.simulation("rk8", rtol=1e-10)
    if before is not None:
        s.set_state(before.time, before.q, before.v)
    return s


def throw() -> tuple[baum.Mechanism, list[baum.Run], baum.Simulation, baum.Simulation]:
    """Run all phases. Return the mechanism of the flight, the samples of each phase, and the runs
    at the release and at the end."""
    dragged, swinging, flying = bodies(), bodies(), bodies()
    add_sling(dragged)
    add_sling(swinging)
    trough = dragged.pin_in_slot("trough", dragged.ground, "stone", point_a=(0, 0), point_b=(0, 0))
    workspace = baum.Workspace(dragged.freeze())
    at = dragged["stone"].columns[0]

    def support(t: float, q: Array, v: Array) -> float:
        _, multipliers = workspace.acceleration(t, q, v)
        return float(workspace.reaction(t, q, multipliers, trough)[1])

    one = phase(dragged, None)
    one.event(function=support, direction=-1)
    first = one.sample(np.arange(0, 2, SAMPLE), record=["energy", "sling.multipliers"])
    two = phase(swinging.freeze(), one)
    two.event(function=lambda t, q, v: v[at][1] - RELEASE * v[at][0], direction=-1)
    second = two.sample(np.arange(one.time, 3, SAMPLE), record=["energy", "sling.multipliers"])
    three = phase(flying.freeze(), two)
    three.event(function=lambda t, q, v: q[at][1], direction=-1)
    third = three.sample(np.arange(two.time, 9, SAMPLE), record=["energy"])
    return flying, [first, second, third], two, three


def main() -> int:
    report = Report("trebuchet", folder="write the page and the picture into this folder")
    m, runs, release, landing = throw()
    at = m["stone"].columns[0]
    times, q = np.concatenate([run.t for run in runs]), np.concatenate([run.q for run in runs])
    page = Path(report.options.folder or ".") / "trebuchet.html"
    shown = times < release.time + 0.15
    sling = [run["sling.multipliers"][:, 0] for run in runs[:2]]
    tension = np.concatenate([*sling, np.zeros(len(runs[2].t))])
    plots = {
        "height of the stone [m]": q[shown][:, at][:, 1],
        "tension of the sling [N]": tension[shown],
    }
    m.page(times[shown], q[shown], page, title="Trebuchet", traces=["stone"], plots=plots)
    m.draw(q[0]).save(page.with_suffix(".svg"))

    x, y = release.q[at]
    vx, vy = release.v[at]
    lift_off, released = runs[1].t[0], release.time
    distance = landing.q[at][0]
    print(
        f"lift-off at {lift_off:.3f} s, release at {released:.3f} s with {np.hypot(vx, vy):.2f} m/s"
    )
    print(f"the stone lands at x = {distance:.2f} m")
    energy = np.concatenate([run["energy"].sum(axis=1) for run in runs])
    exact = x + vx * (vy + np.sqrt(vy**2 + 2 * GRAVITY * y)) / GRAVITY
    report.expect("landing, off the parabola [m]", abs(distance - exact), 1e-7)
    report.expect("energy of all phases, change [J]", np.ptp(energy), 1e-5)
    report.expect("release: slope of the velocity, off by", abs(vy / vx - RELEASE), 1e-9)
    drop = (
        WEIGHT * GRAVITY * (q[0][m["weight"].columns[0]][1] - release.q[m["weight"].columns[0]][1])
    )
    kinetic = STONE * (vx**2 + vy**2) / 2
    report.expect("sling: largest compression [N]", -np.concatenate(sling).min(), 0)
    report.expect("energy of the stone / that of the weight", kinetic / drop, 1.0)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
