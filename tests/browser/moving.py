# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms for the checks of moving pictures: a slider-crank, and a spatial double pendulum."""

import baum
from baum import inertia


def plane(name):
    """Return the mechanism, which is not frozen. Its crank has the given name."""
    m = baum.Mechanism()
    crank = m.planar_body(name, mass=1, inertia=0.1, position=(0.5, 0), angular_velocity=5, held=True)
    rod = m.planar_body("rod", mass=1, inertia=0.4, position=(2, 0))
    slider = m.planar_body("slider", mass=1, inertia=0.1, position=(3, 0))
    m.revolute("O", m.ground, crank, point=(0, 0))
    m.revolute("A", crank, rod, point=(1, 0))
    m.revolute("B", rod, slider, point=(3, 0))
    m.translational("guide", m.ground, slider, point=(3, 0))
    return m


def space(name):
    """Return the mechanism, which is not frozen. Its upper body has the given name."""
    m = baum.Mechanism(up="z")
    body = m.spatial_body(name, mass=2, inertia=inertia.box(2, 0.3, 0.4, 0.05), position=(0, 0.5, 0),
                          angular_velocity=(1, 0, 0))
    other = m.spatial_body("other", mass=1, inertia=inertia.rod(1, 0.5, axis="y"), position=(0, 1.2, 0))
    m.spatial_revolute("hinge", m.ground, body, point=(0, 0, 0), axis=(1, 0, 0))
    m.spherical("ball", body, other, point=(0, 0.9, 0))
    return m
