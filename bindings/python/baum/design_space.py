# SPDX-License-Identifier: BSD-3-Clause
"""Compute the numbers that joints and forces in space take from the design configuration."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Collection, Mapping, NamedTuple

import numpy as np

from ._rotation import matrix, quaternion
from .typing import Array

if TYPE_CHECKING:
    from .elements import Body, Element

NOT_GIVEN = (math.nan,) * 3
Values = dict[str, Any]


class Frame(NamedTuple):
    """Position and axes (columns) of a body in the design configuration."""

    place: Array
    axes: Array
    has_axes: bool

    @classmethod
    def of(cls, body: Body, changes: Mapping[str, Any] | None = None) -> Frame:
        """Return the frame of a body after these changes of its definition."""
        if body.kind is None:
            return cls(np.zeros(3), np.eye(3), True)
        values = {**body.definition, **(changes or {})}
        place = np.zeros(3)
        place[: len(values["position"])] = values["position"]
        half = 0.5 * values.get("angle", 0.0)
        given = values.get("orientation", (math.cos(half), 0.0, 0.0, math.sin(half)))
        p = quaternion(given, f'body "{body.name}": orientation')
        has_axes = "orientation" in values or "angle" in values
        return cls(place, matrix(p / np.linalg.norm(p)), has_axes)

    def local(self, point: Any) -> Array:
        """Convert a point from ground axes to body axes. A particle has only one point, which is
        its origin."""
        return (np.asarray(point) - self.place) @ self.axes if self.has_axes else np.zeros(3)


def _tuple(vector: Array) -> tuple[float, ...]:
    return tuple(vector.tolist())


def _is_given(values: Values, name: str) -> bool:
    return name in values and not math.isnan(values[name][0])


def taken(values: Values) -> Values:
    """Return the numbers that a joint or force with these values takes from the design
    configuration, as a dict from field names to numbers."""
    a, b = Frame.of(values["body_a"]), Frame.of(values["body_b"])
    fields: Values = {}
    axis_a = a.axes
    axis_b = b.axes
    if _is_given(values, "point"):
        axis_a = axis_b = np.eye(3)
        fields["point"] = NOT_GIVEN
        fields["point_a"] = _tuple(a.local(values["point"]))
        if "point_b" in values:
            fields["point_b"] = _tuple(b.local(values["point"]))
    if "axis" in values:
        axis = axis_a @ values["axis"]
        fields["axis"] = _tuple(axis @ a.axes)
        if "x_axis" in values:
            fields["x_axis"] = _tuple(_x_axis(values, a) @ a.axes)
        if "axis_b" in values:
            other = axis_b @ values["axis_b"] if _is_given(values, "axis_b") else axis
            fields["axis_b"] = _tuple(other @ b.axes)
    for name in ("length", "free_length"):
        if math.isnan(values.get(name, 0.0)):
            apart = b.place + b.axes @ values["point_b"] - a.place - a.axes @ values["point_a"]
            fields[name] = float(np.linalg.norm(apart))
    if math.isnan(values.get("offset", 0.0)):  # of a screw
        fields["offset"] = coordinate(values, "displacement")
    return fields


def cable_length(values: Values) -> float:
    """Return the length of a cable in the design configuration."""
    frames = [Frame.of(body) for body in values["bodies"]]
    places = [f.place + f.axes @ p for f, p in zip(frames, values["points"])]
    return float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())


def _x_axis(values: Values, a: Frame) -> Array:
    """Return the direction of x of a planar joint in ground axes."""
    axes = np.eye(3) if _is_given(values, "point") else a.axes
    if _is_given(values, "x_axis"):
        return np.array(axes @ values["x_axis"])
    axis = axes @ np.asarray(values["axis"])
    away = np.linalg.norm(axis[1:]) > 1e-6 * np.linalg.norm(axis)
    return np.array([1.0, 0.0, 0.0] if away else [0.0, 1.0, 0.0])


def coordinate(values: Values, name: str) -> float:
    """Return a coordinate of a joint in the design configuration. Angles are 0 there."""
    if name.startswith("angle") or _is_given(values, "point"):
        return 0.0
    a, b = Frame.of(values["body_a"]), Frame.of(values["body_b"])
    apart = b.place + b.axes @ values["point_b"] - a.place - a.axes @ values["point_a"]
    along = a.axes @ values["axis"]
    if name in ("x", "y"):
        x = _x_axis(values, a)
        y = np.cross(along, x)
        along = y if name == "y" else np.cross(y, along)
    return float(apart @ along / np.linalg.norm(along))


# Elements that always take the relative orientation of their bodies from the design configuration.
DESIGNED = (
    "spatial_fixed",
    "spatial_prismatic",
    "spatial_screw",
    "spatial_constant_velocity",
    "spatial_torsion_spring",
    "spatial_bushing",
)


def check_turned(
    element: Element, used_angles: Collection[Element], changes: Mapping[str, Mapping[str, Any]]
) -> None:
    """Refuse changes that rotate the bodies of an element relative to each other, if the element
    takes their relative orientation from the design configuration. The kinds of elements in
    DESIGNED do so, and also spatial joints whose angle a driver, a coupling or a spring uses."""
    kind = element.kind.name if element.kind else ""
    is_spatial = element.kind is not None and element.kind.is_spatial
    has_used_angle = is_spatial and element in used_angles
    if kind not in DESIGNED and not has_used_angle:
        return
    values = element.definition
    ends = [values["body_a"], values["body_b"]]
    before = [Frame.of(body).axes for body in ends]
    after = [Frame.of(body, changes.get(body.name)).axes for body in ends]
    if not np.allclose(before[0].T @ before[1], after[0].T @ after[1], rtol=0.0, atol=1e-9):
        raise ValueError(
            f'{element.family} "{element.name}" keeps the relative orientation of the design '
            "configuration, which these changes alter; rotate both of its bodies, or also change "
            f"the points of the {element.family}"
        )
