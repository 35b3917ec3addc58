# SPDX-License-Identifier: BSD-3-Clause
"""Inertia tensors of solids, 3 x 3 arrays [kg m^2] for Mechanism.spatial_body().

    from baum import inertia

    plate = inertia.box(2.0, 0.3, 0.2, 0.01)
    shaft = inertia.cylinder(0.5, radius=0.02, length=0.4, axis="x")

The density of each solid is uniform. The tensor of a solid is about its centre of mass. For a box,
the axes of the tensor are parallel to the edges. For a cylinder or a rod, the argument `axis` says
which axis of the tensor is the axis of the solid.

To compute the tensor of a body that consists of several parts, add the tensors of the parts. Before
that, use rotate() to rotate the tensor of each part into the axes of the body, and shift() to move
it to the centre of mass of the body.
"""

from __future__ import annotations

import numpy as np

from ._rotation import matrix, quaternion, tensor
from ._values import number, vector
from .typing import Array, ArrayLike, Axis, OrientationLike, Scalar

__all__ = ["box", "cylinder", "rod", "rotate", "shift", "sphere"]


def _positive(value: Scalar, label: str) -> float:
    given = number(value, label)
    if not (given > 0 and np.isfinite(given)):
        raise ValueError(f"{label}: a finite number > 0 is wanted, not {given!r}")
    return given


def _about(axis: Axis, along: float, across: float) -> Array:
    """Return the tensor with one moment about an axis and another moment about the two
    perpendicular axes."""
    if axis not in ("x", "y", "z"):
        raise ValueError(f'axis: "x", "y" or "z" is wanted, not {axis!r}')
    return np.diag([along if axis == name else across for name in "xyz"])


def box(mass: Scalar, x: Scalar, y: Scalar, z: Scalar) -> Array:
    """Return the tensor of a cuboid.

    mass: [kg].
    x, y, z: lengths of its edges [m].
    """
    m = _positive(mass, "mass")
    squares = np.array([_positive(x, "x"), _positive(y, "y"), _positive(z, "z")]) ** 2
    return np.diag(m / 12.0 * (squares.sum() - squares))


def cylinder(mass: Scalar, radius: Scalar, length: Scalar, axis: Axis = "z") -> Array:
    """Return the tensor of a circular cylinder.

    mass: [kg].
    radius, length: [m].
    axis: "x", "y" or "z".
    """
    m, r, h = _positive(mass, "mass"), _positive(radius, "radius"), _positive(length, "length")
    return _about(axis, m * r * r / 2.0, m * (3.0 * r * r + h * h) / 12.0)


def sphere(mass: Scalar, radius: Scalar) -> Array:
    """Return the tensor of a solid ball.

    mass: [kg].
    radius: [m].
    """
    return np.eye(3) * (0.4 * _positive(mass, "mass") * _positive(radius, "radius") ** 2)


def rod(mass: Scalar, length: Scalar, axis: Axis = "z") -> Array:
    """Return the tensor of a thin rod. Its moment about its own axis is 0.

    mass: [kg].
    length: [m].
    axis: "x", "y" or "z".
    """
    return _about(axis, 0.0, _positive(mass, "mass") * _positive(length, "length") ** 2 / 12.0)


def shift(inertia: ArrayLike, mass: Scalar, offset: ArrayLike) -> Array:
    """Return the tensor about a point other than the centre of mass (parallel axis theorem).

    inertia: tensor about the centre of mass, in any form that spatial_body() accepts.
    mass: [kg].
    offset: x, y, z of the other point relative to the centre of mass, in the axes of the tensor
        [m].
    """
    d = vector(offset, 3, "offset")
    steiner = number(mass, "mass") * (d @ d * np.eye(3) - np.outer(d, d))
    return _square(inertia) + steiner


def rotate(inertia: ArrayLike, orientation: OrientationLike) -> Array:
    """Rotate the inertia tensor of a part into the axes of the body: return R I R^T.

    inertia: tensor I in the axes of the part, in any form that spatial_body() accepts.
    orientation: orientation R of the part in the axes of the body, in any form that spatial_body()
        accepts.
    """
    p = quaternion(orientation, "orientation")
    r = matrix(p / np.linalg.norm(p))
    turned: Array = r @ _square(inertia) @ r.T
    return turned


def _square(inertia: ArrayLike) -> Array:
    xx, yy, zz, xy, xz, yz = tensor(inertia, "inertia")
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
