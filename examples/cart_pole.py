# SPDX-License-Identifier: BSD-3-Clause
"""A cart swings a hanging pole up and balances it. A controller reads the coordinates of the joints
and sets the force on the cart every millisecond. At first, the force increases the energy of the
pole until the pole can reach the upright position. Near the upright position, state feedback takes
over. The feedback is designed for the linear model, with given decay rates. At the end, the motion
must therefore decay at the slowest of these rates. The energy changes only by the work of the
force."""

import sys
from pathlib import Path

import baum
import numpy as np
from baum.typing import Array
from support.report import Report

CART, POLE, LENGTH, GRAVITY = 1.0, 0.2, 0.6, 9.81  # [kg], [kg], [m], [m/s^2]
HALF, INERTIA = LENGTH / 2, POLE * LENGTH**2 / 3  # [m], [kg m^2] about the pin
PERIOD, STEPS, COUNT = 1e-3, 2, 9000  # [s]; steps per period; number of periods
DECAY = (1.5, 6, 7, 8)  # [1/s] decay rates of the closed loop, in the linear model
NEAR = 0.35  # [rad] tilt at which the state feedback takes over


def mechanism() -> baum.Mechanism:
    m = baum.Mechanism(gravity=(0, -GRAVITY))
    cart = m.planar_body("cart", mass=CART, inertia=0.01, outline=[baum.Box((0.3, 0.1, 0))])
    pole = m.planar_body(
        "pole",
        mass=POLE,
        inertia=POLE * LENGTH**2 / 12,
        position=(0, -HALF),
        angle=-np.pi / 2,
        angular_velocity=0.2,
        outline=[baum.Box((LENGTH, 0.02, 0))],
    )
    m.translational("rail", m.ground, cart, point=(0, 0))
    m.revolute("pin", cart, pole, point=(0, 0))
    m.load("motor", cart, force=(1, 0), input=m.input("force"))
    return m.freeze()


def one_period() -> tuple[Array, Array]:
    """Return A and b of one period of the linear model, x_next = A x + b u. The state x consists of
    the position of the cart, the tilt of the pole to the right, and their velocities. The input u
    is the force on the cart."""
    mass = np.array([[CART + POLE, POLE * HALF], [POLE * HALF, INERTIA]])
    # The columns of slope belong to the position of the cart, the tilt and u.
    slope = np.array([[0, 0, 0], [0, POLE * GRAVITY * HALF, 0]])  # derivatives of the forces
    slope[0, 2] = 1
    rates = np.zeros((5, 5))  # d/dt (x, u) = rates @ (x, u), with constant u
    rates[:2, 2:4] = np.eye(2)
    rates[2:4, [0, 1, 4]] = np.linalg.solve(mass, slope)
    whole: Array = np.eye(5)
    for k in range(8, 0, -1):  # Taylor series of exp(rates PERIOD)
        whole = np.eye(5) + PERIOD / k * rates @ whole
    return whole[:4, :4], whole[:4, 4]


def feedback_gains() -> Array:
    """Return the gains with which the closed loop has the decay rates DECAY (Ackermann's
    formula)."""
    a, b = one_period()
    reach = np.stack([np.linalg.matrix_power(a, k) @ b for k in range(4)], axis=1)
    factors = [a - np.exp(-decay * PERIOD) * np.eye(4) for decay in DECAY]
    gains: Array = np.linalg.solve(reach.T, [0, 0, 0, 1]) @ np.linalg.multi_dot(factors)
    return gains


def swing_up(x: Array) -> float:
    """Return the force [N] that gives the cart an acceleration at which the energy of the pole
    approaches its value in the upright position."""
    place, tilt, speed, rate = x
    s, c, moment = np.sin(tilt), np.cos(tilt), POLE * HALF
    energy = INERTIA * rate**2 / 2 + moment * GRAVITY * (c - 1)  # [J] 0 if upright and at rest
    wanted = np.clip(10 * energy * rate * c - 8 * place - 3 * speed, -4, 4)
    tilting = moment * (GRAVITY * s - wanted * c) / INERTIA
    return float((CART + POLE) * wanted + moment * (tilting * c - rate**2 * s))


def main() -> int:
    report = Report("cart_pole", folder="write the page and the picture into this folder")
    m, gains = mechanism(), feedback_gains()
    s = m.simulation("rk4", step=PERIOD / STEPS)
    q, states, forces, caught = [], [], [], 0
    before = s.get("energy").sum()
    for k in range(COUNT):
        (place, speed), (angle, rate) = s.get("rail.coordinate", "pin.coordinate")
        tilt = (3 * np.pi / 2 - angle) % (2 * np.pi) - np.pi  # from -pi to pi
        states.append([place, tilt, speed, -rate])
        q.append(s.q)
        if not caught and abs(tilt) < NEAR:
            caught = k
        forces.append(float(-gains @ states[k]) if caught else swing_up(np.array(states[k])))
        s.set_input("force", forces[k])
        s.step(STEPS)

    times, x, u = PERIOD * np.arange(COUNT), np.array(states), np.array(forces)
    page = Path(report.options.folder or ".") / "cart_pole.html"
    m.page(
        times[::15],
        q[::15],
        page,
        title="Cart and pole",
        plots={
            "cart [m]": x[::15, 0],
            "tilt of the pole [rad]": np.unwrap(x[::15, 1]),
            "force [N]": u[::15],
        },
        marks=[(times[caught], "state feedback takes over")],
    )
    m.draw(q[caught]).save(page.with_suffix(".svg"))

    print(f"the state feedback takes over at {times[caught]:.3f} s")
    print(f"farthest {abs(x[:, 0]).max():.2f} m, largest force {abs(u).max():.1f} N")
    late = caught + round(4 / PERIOD)  # the faster modes of the motion have decayed
    decay = np.log(x[late, :2] / x[-1, :2]) / (times[-1] - times[late])
    report.expect("decay of cart and tilt, off by [1/s]", abs(decay - DECAY[0]).max(), 1e-5)
    # The force is constant during a period, so its work is force times displacement.
    work = u[:-1] @ np.diff(x[:, 0]) + u[-1] * (s.get("rail.coordinate")[0] - x[-1, 0])
    change = s.get("energy").sum() - before
    print(f"work of the force {work:.4f} J")
    report.expect("energy change minus this work [J]", abs(change - work), 1e-8)
    return report.end()


if __name__ == "__main__":
    sys.exit(main())
