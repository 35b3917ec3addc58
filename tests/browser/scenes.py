# SPDX-License-Identifier: BSD-3-Clause
"""One small mechanism for each kind of element, both planar and spatial."""

import math

import numpy as np

import baum
from baum import inertia

PLANE, SPACE = {}, {}
BOX = inertia.box(1, 0.2, 0.15, 0.1)


def scene(scenes):
    def keep(make):
        scenes[make.__name__] = make
        return make

    return keep


def arm(m, name="arm", start=(0, 0), end=(2, 0.5)):
    """Add a body between two points. Its axes are parallel to the axes of the ground."""
    middle = (np.array(start, float) + end) / 2
    add = m.planar_body if len(start) == 2 else m.spatial_body
    return add(name, mass=1, inertia=0.1 if len(start) == 2 else BOX, position=middle)


def pair(m):
    """Add two arms that meet at (2, 0.5). Their other ends are pinned to the ground."""
    a, b = arm(m, "a"), arm(m, "b", (2, 0.5), (4, 0))
    m.revolute("left", m.ground, a, point=(0, 0))
    m.revolute("right", m.ground, b, point=(4, 0))
    return a, b


# ---- planar elements ----


@scene(PLANE)
def planar_body(m):
    m.planar_body("disc", mass=1, inertia=0.1, position=(0, 0))
    bar = arm(m, "bar", (1.2, 0), (3, 0))
    plate = m.planar_body("plate", mass=1, inertia=0.1, position=(4, 0.5))
    for point in ((1.2, 0), (3, 0)):
        m.revolute(None, m.ground, bar, point=point)
    for point in ((3.4, 0), (4.6, 0), (4.2, 1)):
        m.revolute(None, m.ground, plate, point=point)


@scene(PLANE)
def planar_particle(m):
    p = m.planar_particle("bob", mass=1, position=(1, -2))
    m.distance("string", m.ground, p, point_a=(0, 0), point_b=(0, 0), length=np.hypot(1, 2))


@scene(PLANE)
def planar_revolute(m):
    a, b = pair(m)
    m.revolute("pin", a, b, point=(2, 0.5))


@scene(PLANE)
def hanging_pin(m):
    m.revolute("pin", m.ground, arm(m, end=(0.4, -2)), point=(0, 0))


@scene(PLANE)
def planar_distance(m):
    a, b = arm(m, "a", (0, 0), (0.5, 1.5)), arm(m, "b", (3, 0), (3.5, 1.5))
    m.revolute("left", m.ground, a, point=(0, 0))
    m.revolute("right", m.ground, b, point=(3, 0))
    m.distance("rod", a, b, point_a=(0.25, 0.75), point_b=(0.25, 0.75))


@scene(PLANE)
def planar_translational(m):
    m.translational("guide", m.ground, m.planar_body("block", mass=1, inertia=0.1, position=(0, 0)), point=(0, 0))


@scene(PLANE)
def vertical_guide(m):
    block = m.planar_body("block", mass=1, inertia=0.1, position=(0, 0))
    link = arm(m, "link", (0, 0), (2, 0.5))
    m.revolute("pin", block, link, point=(0, 0))
    m.translational("guide", m.ground, block, point=(0, 0), axis=(0, 1))


@scene(PLANE)
def guide_on_a_body(m):
    a = arm(m, "a", (0, 0), (3, 1.5))
    block = m.planar_body("block", mass=1, inertia=0.1, position=(2, 1))
    m.revolute("pin", m.ground, a, point=(0, 0))
    m.translational("guide", a, block, point=(2, 1), axis=(2, 1))


@scene(PLANE)
def planar_fixed(m):
    a, b = arm(m, "a", (0, 0), (2, 0)), arm(m, "b", (2, 0), (2.5, 1.5))
    m.fixed("wall", m.ground, a, point=(0, 0))
    m.fixed("weld", a, b, point=(2, 0))


@scene(PLANE)
def planar_pin_in_slot(m):
    a, b = arm(m, "a", (0, 0), (3, 1)), arm(m, "b", (2, 2 / 3), (2.5, -1))
    m.revolute("pin", m.ground, a, point=(0, 0))
    m.revolute("base", m.ground, b, point=(2.5, -1))
    m.pin_in_slot("slot", a, b, point=(2, 2 / 3), axis=(3, 1))


@scene(PLANE)
def planar_rack_and_pinion(m):
    rack = m.planar_body("rack", mass=1, inertia=0.1, position=(0, 0))
    wheel = m.planar_body("pinion", mass=1, inertia=0.1, position=(0, 0.6))
    m.revolute("axle", m.ground, wheel, point=(0, 0.6))
    m.translational("guide", m.ground, rack, point=(0, 0))
    m.rack_and_pinion("teeth", rack, wheel, -0.6, point_a=(0, 0), point_b=(0, 0))


@scene(PLANE)
def planar_gear(m):
    a = m.planar_body("a", mass=1, inertia=0.1, position=(0, 0))
    b = m.planar_body("b", mass=1, inertia=0.1, position=(1.5, 0))
    m.revolute("left", m.ground, a, point=(0, 0))
    m.revolute("right", m.ground, b, point=(1.5, 0))
    m.gear("teeth", a, b, 1, 0.5)


@scene(PLANE)
def internal_gear(m):
    ring = m.planar_body("ring", mass=1, inertia=0.1, position=(0, 0))
    wheel = m.planar_body("wheel", mass=1, inertia=0.1, position=(0.6, 0))
    m.revolute("middle", m.ground, ring, point=(0, 0))
    m.revolute("axle", m.ground, wheel, point=(0.6, 0))
    m.gear("teeth", ring, wheel, -1, 0.4)


@scene(PLANE)
def planar_curve(m):
    cam = m.planar_body("cam", mass=1, inertia=0.1, position=(0, 0))
    rod = arm(m, "follower", (0, 0.7), (0, 2))
    m.revolute("shaft", m.ground, cam, point=(0.4, 0))
    m.translational("guide", m.ground, rod, point=(0, 2), axis=(0, 1))
    m.curve("track", cam, rod, lambda xy: (xy[0] ** 2 + 2 * xy[1] ** 2 - 0.98, 2 * xy[0], 4 * xy[1], 2, 0, 4),
            point_a=(0, 0), point_b=(0, -0.65))


@scene(PLANE)
def planar_knife_edge(m):
    sleigh = m.planar_body("sleigh", mass=1, inertia=0.1, position=(0, 0))
    m.knife_edge("blade", sleigh, point=(-0.6, 0.1), axis=(4, 1))


@scene(PLANE)
def coupling(m):
    a, b = arm(m, "a", (0, 0), (0.5, 1)), arm(m, "b", (2, 0), (2.5, 1))
    one = m.revolute("left", m.ground, a, point=(0, 0))
    other = m.revolute("right", m.ground, b, point=(2, 0))
    m.coupling("belt", one, other, ratio=2)


@scene(PLANE)
def driver(m):
    m.driver("motor", m.revolute("pin", m.ground, arm(m), point=(0, 0)), rate=1)


@scene(PLANE)
def spline_driver(m):
    block = m.planar_body("block", mass=1, inertia=0.1, position=(0, 0))
    guide = m.translational("guide", m.ground, block, point=(0, 0))
    m.spline_driver("cam", guide, [0, 1, 2, 3], [0, 0.1, 0.2, 0])


@scene(PLANE)
def user_constraint(m):
    a, b = arm(m, "a", (0, 0), (1, 0.5)), arm(m, "b", (2, 0), (3, 0.5))
    m.revolute("left", m.ground, a, point=(0, 0))
    m.revolute("right", m.ground, b, point=(2, 0))
    m.constraint("rule", [a, b], 1, lambda t, q: [q[2] - q[5]])


@scene(PLANE)
def planar_spring(m):
    for k, law in enumerate(({"stiffness": 9}, {"damping": 1}, {"stiffness": 9, "damping": 1})):
        p = m.planar_particle(None, mass=1, position=(k, 0))
        m.spring(None, m.ground, p, point_a=(k, 1.5), point_b=(0, 0), **law)


@scene(PLANE)
def planar_torsion_spring(m):
    a = arm(m)
    m.revolute("pin", m.ground, a, point=(0, 0))
    m.torsion_spring("spiral", m.ground, a, stiffness=1)


def block_with_arm(m):
    """Adds an arm that is pinned to a sliding block. Returns the guide and the pin."""
    block = m.planar_body("block", mass=1, inertia=0.1, position=(1, 0))
    guide = m.translational("guide", m.ground, block, point_a=(0, 0), point_b=(0, 0))
    return guide, m.revolute("pin", block, arm(m, start=(1, 0), end=(1.2, 1.5)), point=(1, 0))


@scene(PLANE)
def joint_spring(m):
    guide, pin = block_with_arm(m)
    m.joint_spring("coil", guide, stiffness=1)
    m.joint_spring("spiral", pin, stiffness=1)


@scene(PLANE)
def joint_load(m):
    guide, pin = block_with_arm(m)
    m.joint_load("force", guide, effort=1)
    m.joint_load("torque", pin, effort=-1)


@scene(PLANE)
def planar_load(m):
    a = arm(m)
    m.revolute("pin", m.ground, a, point=(0, 0))
    m.load("force", a, force=(0, -1), point=(1, 0.25))
    m.load("torque", a, torque=1, point=(-0.2, -0.05))


@scene(PLANE)
def user_force(m):
    a = arm(m)
    m.revolute("pin", m.ground, a, point=(0, 0))
    m.force("drag", [a], lambda t, q, v: -0.1 * v)


# ---- spatial elements ----


def spatial_pair(m, end=(2, 1, 0)):
    a, b = arm(m, "a", (0, 0, 0), (1, 0, 0)), arm(m, "b", (1, 0, 0), end)
    m.spherical("end", m.ground, b, point=end)
    return a, b


@scene(SPACE)
def spatial_body(m):
    m.spatial_body("box", mass=1, inertia=inertia.box(1, 0.6, 0.4, 0.2), position=(0, 0, 0))
    arm_ = arm(m, "bar", (1, 0, 0), (2, 0, 0))
    for x in (1, 2):
        m.spherical(None, m.ground, arm_, point=(x, 0, 0))


@scene(SPACE)
def spatial_particle(m):
    p = m.spatial_particle("bob", mass=1, position=(0.5, 0, -1))
    m.spatial_distance("string", m.ground, p, point_a=(0, 0, 0), point_b=(0, 0, 0), length=np.hypot(0.5, 1))


@scene(SPACE)
def spatial_spherical(m):
    a, b = spatial_pair(m)
    m.spherical("joint", a, b, point=(1, 0, 0))


@scene(SPACE)
def spatial_revolute(m):
    a, b = spatial_pair(m)
    m.spatial_revolute("base", m.ground, a, point=(0, 0, 0), axis=(0, 1, 0))
    m.spatial_revolute("joint", a, b, point=(1, 0, 0), axis=(0, 0, 1))


@scene(SPACE)
def spatial_universal(m):
    a, b = spatial_pair(m)
    m.universal("joint", a, b, point=(1, 0, 0), axis=(0, 0, 1), axis_b=(-1, 1, 0))


@scene(SPACE)
def spatial_cylindrical(m):
    a = arm(m, "a", (0, 0, 0), (0, 1, 0))
    m.cylindrical("joint", m.ground, a, point=(0, 0, 0), axis=(1, 0, 0))


@scene(SPACE)
def spatial_prismatic(m):
    a = arm(m, "a", (0, 0, 0), (0, 1, 0))
    m.prismatic("joint", m.ground, a, point=(0, 0, 0), axis=(1, 0, 0))


@scene(SPACE)
def spatial_planar(m):
    a = arm(m, "a", (0, 0, 0), (0, 0.5, 1))
    m.spatial_planar("joint", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1))


@scene(SPACE)
def spatial_fixed(m):
    a, b = spatial_pair(m)
    m.spatial_fixed("wall", m.ground, a, point=(0, 0, 0))
    m.spatial_fixed("joint", a, b, point=(1, 0, 0))


@scene(SPACE)
def spatial_distance(m):
    a, b = arm(m, "a", (0, 0, 0), (0, 0, 1)), arm(m, "b", (1, 0, 0), (1, 0, 1))
    m.spherical("left", m.ground, a, point=(0, 0, 0))
    m.spherical("right", m.ground, b, point=(1, 0, 0))
    m.spatial_distance("rod", a, b, point_a=(0, 0, 0.5), point_b=(0, 0, 0.5))


@scene(SPACE)
def spatial_point_on_line(m):
    a = arm(m, "a", (0, 0, 0), (0, 1, 0.5))
    m.point_on_line("joint", m.ground, a, point=(0, 0, 0), axis=(1, 0, 0))


@scene(SPACE)
def spatial_point_on_plane(m):
    a = arm(m, "a", (0, 0, 0), (0, 0.5, 1))
    m.point_on_plane("joint", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1))


@scene(SPACE)
def spatial_curve(m):
    def helix(p):
        x, y = 0.7 * math.cos(p[2] / 0.2), 0.7 * math.sin(p[2] / 0.2)
        return [p[0] - x, 1, 0, y / 0.2, 0, 0, 0, 0, 0, x / 0.04, p[1] - y, 0, 1, -x / 0.2, 0, 0, 0, 0, 0, y / 0.04]

    bead = m.spatial_particle("bead", position=(0.7, 0, 0))
    m.spatial_curve("wire", m.ground, bead, helix, point_a=(0, 0, 0), point_b=(0, 0, 0))
    m.spherical("frame", m.ground, arm(m, "a", (1, 1, 0), (1, 1, 1)), point=(1, 1, 0))


@scene(SPACE)
def spatial_knife_edge(m):
    a = arm(m, "a", (0, 0, 0), (1, -0.5, 0))
    m.point_on_plane("ice", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1))
    m.spatial_knife_edge("blade", a, point=(0, 0, 0), axis=(1, 2, 0))


@scene(SPACE)
def spatial_screw(m):
    a = arm(m, "a", (0, 0, 0), (1, 0, 0))
    m.screw("joint", m.ground, a, 0.2, point=(0, 0, 0), axis=(0, 0, 1))


@scene(SPACE)
def spatial_constant_velocity(m):
    a, b = arm(m, "a", (0, 0, 0), (1, 0, 0)), arm(m, "b", (1, 0, 0), (2, 0, 1))
    m.spatial_revolute("bearing", m.ground, a, point=(0, 0, 0), axis=(1, 0, 0))
    m.constant_velocity("joint", a, b, point=(1, 0, 0), axis=(1, 0, 0), axis_b=(1, 0, 1))


@scene(SPACE)
def spatial_rolling_disc(m):
    disc = m.spatial_body("disc", mass=1, inertia=(0.1, 0.1, 0.2), position=(0, 0.5, 0))
    m.rolling_disc("contact", disc, 0.5)


@scene(SPACE)
def spatial_drivers(m):
    a, b = arm(m, "a", (0, 0, 0), (1, 0, 0)), arm(m, "b", (0, 2, 0), (0, 2, 1))
    hinge = m.spatial_revolute("hinge", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1))
    slide = m.prismatic("slide", m.ground, b, point=(0, 2, 0), axis=(1, 0, 0))
    m.driver("motor", hinge, rate=1)
    m.driver("jack", slide, rate=0.1)


@scene(SPACE)
def spatial_joint_springs(m):
    a, b = arm(m, "a", (0, 0, 0), (1, 0, 0)), arm(m, "b", (1, 2, 0), (1, 2, 1))
    hinge = m.spatial_revolute("hinge", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1))
    slide = m.prismatic("slide", m.ground, b, point_a=(0, 2, 0), point_b=(0, 0, -0.5), axis=(1, 0, 0))
    m.joint_spring("spiral", hinge, stiffness=1)
    m.joint_spring("coil", slide, stiffness=1)


@scene(SPACE)
def spatial_joint_loads(m):
    a, b = arm(m, "a", (0, 0, 0), (1, 0, 0)), arm(m, "b", (1, 2, 0), (1, 2, 1))
    hinge = m.spatial_revolute("hinge", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1))
    slide = m.prismatic("slide", m.ground, b, point_a=(0, 2, 0), point_b=(0, 0, -0.5), axis=(1, 0, 0))
    m.joint_load("torque", hinge, effort=1)
    m.joint_load("force", slide, effort=-1)


@scene(SPACE)
def spatial_spring(m):
    for k, law in enumerate(({"stiffness": 9}, {"damping": 1}, {"stiffness": 9, "damping": 1})):
        p = m.spatial_particle(None, mass=1, position=(k, 0, 0))
        m.spatial_spring(None, m.ground, p, point_a=(k, 0, 1.5), point_b=(0, 0, 0), **law)


@scene(SPACE)
def spatial_cable(m):
    a = arm(m, "a", (0, 0, 0), (1, 1, 0))
    m.spherical("joint", m.ground, a, point=(0, 0, 0))
    p = m.spatial_particle("weight", position=(2, 0, 0))
    m.cable("rope", [m.ground, a, m.ground, p], [(0, 0, 1), (0.2, 0.2, 0), (2, 0, 1.5), (0, 0, 0)], stiffness=9)


@scene(SPACE)
def spatial_torsion_spring(m):
    a = arm(m, "a", (0, 0, 0), (1, 1, 0))
    m.spherical("joint", m.ground, a, point=(0, 0, 0))
    m.spatial_torsion_spring("spiral", m.ground, a, point=(0, 0, 0), axis=(0, 0, 1), stiffness=1)


@scene(SPACE)
def spatial_bushing(m):
    a = arm(m, "a", (0, 0, 0), (1, 1, 0))
    m.bushing("rubber", m.ground, a, point=(0, 0, 0), stiffness=(9, 9, 9, 1, 1, 1))


@scene(SPACE)
def spatial_load(m):
    a = arm(m, "a", (0, 0, 0), (1, 1, 0))
    m.spherical("joint", m.ground, a, point=(0, 0, 0))
    m.spatial_load("force", a, force=(0, 0, -1))
    m.spatial_load("moment", a, moment=(1, 0, 0), point=(0.5, 0.5, 0))


def build(scenes, name):
    m = baum.Mechanism(up="z") if scenes is SPACE else baum.Mechanism()
    scenes[name](m)
    return m
