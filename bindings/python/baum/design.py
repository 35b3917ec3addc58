# SPDX-License-Identifier: BSD-3-Clause
"""Compute the numbers that planar joints and forces take from the design configuration.

In this module, points of the plane are complex numbers.
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any, Collection, NamedTuple

from . import design_space

if TYPE_CHECKING:
    from .elements import Body, Element, Joint

NOT_GIVEN = (math.nan, math.nan)
Values = dict[str, Any]


class Frame(NamedTuple):
    """Position and orientation of a body in the design configuration."""

    place: complex
    angle: float
    has_angle: bool

    @classmethod
    def of(cls, body: Body) -> Frame:
        if body.kind is None:
            return cls(0j, 0.0, True)
        values = body.definition
        return cls(complex(*values["position"]), values.get("angle", 0.0), "angle" in values)

    @property
    def turned(self) -> complex:
        return cmath.exp(1j * self.angle)

    def local(self, axes: tuple[float, float]) -> complex:
        """Convert a point from ground axes to body axes. A particle has only one point, which is
        its origin."""
        point = complex(*axes)
        s = (point - self.place) / self.turned
        at_origin = not self.has_angle and abs(s) <= 1e-9 * (abs(point) + abs(self.place))
        return 0j if at_origin else s


def _pair(z: complex) -> tuple[float, float]:
    return z.real, z.imag


def _offset(values: Values, a: Frame, b: Frame) -> complex:
    return (
        b.place
        + complex(*values["point_b"]) * b.turned
        - (a.place + complex(*values["point_a"]) * a.turned)
    )


def _along(values: Values, a: Frame, b: Frame) -> float:
    """Return the displacement from body_a's point to body_b's point along the axis."""
    axis = complex(*values["axis"]) * a.turned
    return (_offset(values, a, b) * axis.conjugate()).real / abs(axis)


def _placed(values: Values, a: Frame, b: Frame) -> Values:
    """Return the points and the axis in body axes for a joint whose place is given by `point`."""
    if math.isnan(values.get("point", NOT_GIVEN)[0]):
        return {}
    point = values["point"]
    fields = {"point": NOT_GIVEN}
    fields["point_a"] = _pair(a.local(point))
    if "point_b" in values:
        fields["point_b"] = _pair(b.local(point))
    if "axis" in values:
        fields["axis"] = _pair(complex(*values["axis"]) / a.turned)
    return fields


def _coordinate(joint: Joint, name: str) -> float:
    values = joint.definition
    if joint.kind is not None and joint.kind.is_spatial:
        return design_space.coordinate(values, joint.kind.coordinate(name))
    a, b = Frame.of(values["body_a"]), Frame.of(values["body_b"])
    values.update(_placed(values, a, b))
    return _along(values, a, b) if "axis" in values else b.angle - a.angle


def _gear_offset(values: Values, a: Frame, b: Frame) -> float:
    c = Frame.of(values["carrier"])
    radius_a, radius_b = values["radius_a"], values["radius_b"]
    return float(radius_a * (a.angle - c.angle) + radius_b * (b.angle - c.angle))


def _measured(name: str, values: Values, a: Frame, b: Frame) -> float:
    if name in ("length", "free_length"):
        return abs(_offset(values, a, b))
    if name in ("angle", "free_angle"):
        return b.angle - a.angle
    if "carrier" in values:
        return _gear_offset(values, a, b)
    return _along(values, a, b) - float(values["radius"]) * (b.angle - a.angle)


def taken(element: Element, moved: Collection[str]) -> Values:
    """Return the numbers that a joint or force takes from the design configuration, as a dict from
    field names to numbers. The result is empty if the element acts on no body named in `moved`."""
    values = element.definition
    if "joint_a" in values:
        a, b = values["joint_a"], values["joint_b"]
        is_moved = _is_at(a.definition, moved) or _is_at(b.definition, moved)
        if math.isnan(values["offset"]) and is_moved:
            value = _coordinate(a, values["coordinate_a"])
            return {"offset": _coordinate(b, values["coordinate_b"]) - values["ratio"] * value}
        return {}
    if "free_value" in values:
        joint = values["joint"]
        if math.isnan(values["free_value"]) and _is_at(joint.definition, moved):
            return {"free_value": _coordinate(joint, values["coordinate"])}
        return {}
    if "points" in values:
        is_moved = any(body.name in moved for body in values["bodies"])
        if math.isnan(values["free_length"]) and is_moved:
            return {"free_length": design_space.cable_length(values)}
        return {}
    if not _is_at(values, moved):
        return {}
    if element.kind is not None and element.kind.is_spatial:
        return design_space.taken(values)
    a, b = Frame.of(values["body_a"]), Frame.of(values["body_b"])
    fields = _placed(values, a, b)
    values.update(fields)
    for name in ("length", "free_length", "angle", "free_angle", "offset"):
        if math.isnan(values.get(name, 0.0)):
            fields[name] = _measured(name, values, a, b)
    return fields


def _is_at(values: Values, moved: Collection[str]) -> bool:
    """Whether the element with these values acts on a body named in `moved`."""
    bodies = [values.get(end) for end in ("body_a", "body_b", "carrier")]
    return "body_a" in values and any(body.name in moved for body in bodies if body is not None)
