# SPDX-License-Identifier: BSD-3-Clause
"""What joints and forces take from the design configuration, as numbers of their definitions.

Points of the plane are complex numbers here.
"""

import cmath
import math
from collections import namedtuple

NOT_GIVEN = (math.nan, math.nan)


class Frame(namedtuple("Frame", "place angle has_angle")):
    """Where a body is in the design configuration."""

    @classmethod
    def of(cls, body):
        if body.kind is None:
            return cls(0j, 0.0, True)
        values = body.definition
        return cls(complex(*values["position"]), values.get("angle", 0.0), "angle" in values)

    @property
    def turned(self):
        return cmath.exp(1j * self.angle)

    def local(self, point):
        """A point in ground axes, in body axes; on a particle there is only the origin."""
        point = complex(*point)
        s = (point - self.place) / self.turned
        at_origin = not self.has_angle and abs(s) <= 1e-9 * (abs(point) + abs(self.place))
        return 0j if at_origin else s


def _pair(z):
    return z.real, z.imag


def _offset(values, a, b):
    return b.place + complex(*values["point_b"]) * b.turned - (
        a.place + complex(*values["point_a"]) * a.turned
    )


def _along(values, a, b):
    """Displacement of body_b's point along the axis."""
    axis = complex(*values["axis"]) * a.turned
    return (_offset(values, a, b) * axis.conjugate()).real / abs(axis)


def _placed(values, a, b):
    """Points and axis in body axes for a joint that is placed by `point`."""
    if math.isnan(values.get("point", NOT_GIVEN)[0]):
        return {}
    point = values["point"]
    fields = {"point": NOT_GIVEN, "point_a": _pair(a.local(point)), "point_b": _pair(b.local(point))}
    if "axis" in values:
        fields["axis"] = _pair(complex(*values["axis"]) / a.turned)
    return fields


def _coordinate(joint):
    values = joint.definition
    a, b = Frame.of(values["body_a"]), Frame.of(values["body_b"])
    values.update(_placed(values, a, b))
    return _along(values, a, b) if "axis" in values else b.angle - a.angle


def _gear_offset(values, a, b):
    c = Frame.of(values["carrier"])
    return values["radius_a"] * (a.angle - c.angle) + values["radius_b"] * (b.angle - c.angle)


def _measured(name, values, a, b):
    if name in ("length", "free_length"):
        return abs(_offset(values, a, b))
    if name in ("angle", "free_angle"):
        return b.angle - a.angle
    if "carrier" in values:
        return _gear_offset(values, a, b)
    return _along(values, a, b) - values["radius"] * (b.angle - a.angle)


def taken(element, moved):
    """Fields that give a joint or force as numbers what it takes from the design configuration, if
    it is at one of the bodies named in `moved`."""
    values = element.definition
    if "joint_a" in values:
        a, b = values["joint_a"], values["joint_b"]
        if math.isnan(values["offset"]) and (_is_at(a.definition, moved) or _is_at(b.definition, moved)):
            return {"offset": _coordinate(b) - values["ratio"] * _coordinate(a)}
        return {}
    if not _is_at(values, moved):
        return {}
    a, b = Frame.of(values["body_a"]), Frame.of(values["body_b"])
    fields = _placed(values, a, b)
    values.update(fields)
    for name in ("length", "free_length", "angle", "free_angle", "offset"):
        if math.isnan(values.get(name, 0.0)):
            fields[name] = _measured(name, values, a, b)
    return fields


def _is_at(values, moved):
    """Whether a joint or force that takes something from the design is at one of these bodies."""
    bodies = [values.get(end) for end in ("body_a", "body_b", "carrier")]
    return "body_a" in values and any(body.name in moved for body in bodies if body is not None)
