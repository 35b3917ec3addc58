# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms that several tests use."""

import baum


def slider_crank(omega=None, r=0.153, l=0.306, e=0.05):
    """The eccentric slider-crank of the first example. If omega [rad/s] is given, a driver rotates
    the crank at this angular velocity."""
    m = baum.Mechanism(gravity=(0, -9.81))
    crank = m.planar_body("crank", mass=0.038, inertia=7.4e-5, position=(r / 2, 0))
    rod = m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(r + l / 2, 0))
    slider = m.planar_body("slider", mass=0.076, position=(r + l, e))
    pin = m.revolute("A", m.ground, crank, point_a=(0, 0), point_b=(-r / 2, 0))
    m.revolute("B", crank, rod, point_a=(r / 2, 0), point_b=(-l / 2, 0))
    m.revolute("C", rod, slider, point_a=(l / 2, 0), point_b=(0, 0))
    m.translational("guide", m.ground, slider, axis=(1, 0), point_a=(0, e), point_b=(0, 0))
    if omega:
        m.driver("motor", pin, value=0, rate=omega)
    return m.freeze()


def circle(t, q):
    return q @ q - 1


def pendulum(phi=circle, **functions):
    """A particle on a circle. Python functions define the circle."""
    m = baum.Mechanism()
    bob = m.planar_particle("bob", mass=1, position=(1, 0))
    m.constraint("circle", [bob], rows=1, phi=phi, **functions)
    return m.freeze()


def rod_pendulum():
    """The pendulum of pendulum(), with a distance joint instead of Python functions."""
    m = baum.Mechanism()
    m.planar_particle("bob", mass=1, position=(1, 0))
    m.distance("rod", "ground", "bob", point_a=(0, 0), point_b=(0, 0))
    return m.freeze()
