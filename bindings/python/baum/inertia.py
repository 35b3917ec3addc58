# SPDX-License-Identifier: BSD-3-Clause
"""Inertia tensors of solids, 3 x 3 arrays [kg m^2] for Mechanism.spatial_body().

    from baum import inertia

    plate = inertia.box(2.0, 0.3, 0.2, 0.01)
    shaft = inertia.cylinder(0.5, radius=0.02, length=0.4, axis="x")

Solids are uniform. Tensors are about the centre of mass and in axes along the edges or the axis.
The tensor of a body of several parts is the sum of theirs, each turned by rotate() into the axes of
the body and moved by shift() to its centre of mass.
"""

from __future__ import annotations

import numpy as np

from ._rotation import matrix, quaternion, tensor
from ._values import number, vector
from .typing import Array, ArrayLike, Axis, OrientationLike, Scalar

__all__ = ["box", "cylinder", "rod", "rotate", "shift", "sphere"]


def _about(axis: Axis, along: float, across: float) -> Array:
    """The tensor with one moment about an axis and another about those perpendicular to it."""
    if axis not in ("x", "y", "z"):
        raise ValueError(f'axis: "x", "y" or "z" is wanted, not {axis!r}')
    return np.diag([along if axis == name else across for name in "xyz"])


def box(mass: Scalar, x: Scalar, y: Scalar, z: Scalar) -> Array:
    """A cuboid. mass: [kg]. x, y, z: lengths of its edges [m]."""
    m = number(mass, "mass")
    squares = np.array([number(x, "x"), number(y, "y"), number(z, "z")]) ** 2
    return np.diag(m / 12.0 * (squares.sum() - squares))


def cylinder(mass: Scalar, radius: Scalar, length: Scalar, axis: Axis = "z") -> Array:
    """A circular cylinder. mass: [kg]. radius, length: [m]. axis: "x", "y" or "z"."""
    m, r, h = number(mass, "mass"), number(radius, "radius"), number(length, "length")
    return _about(axis, m * r * r / 2.0, m * (3.0 * r * r + h * h) / 12.0)


def sphere(mass: Scalar, radius: Scalar) -> Array:
    """A ball. mass: [kg]. radius: [m]."""
    return np.eye(3) * (0.4 * number(mass, "mass") * number(radius, "radius") ** 2)


def rod(mass: Scalar, length: Scalar, axis: Axis = "z") -> Array:
    """A thin rod. mass: [kg]. length: [m]. axis: "x", "y" or "z".

    Its moment about its own axis is 0.
    """
    return _about(axis, 0.0, number(mass, "mass") * number(length, "length") ** 2 / 12.0)


def shift(inertia: ArrayLike, mass: Scalar, offset: ArrayLike) -> Array:
    """The tensor about a point that is `offset` away from the centre of mass (parallel axes).

    inertia: about the centre of mass, in any form that spatial_body() takes. mass: [kg]. offset: x,
    y, z [m] from the one to the other, in the axes of the tensor.
    """
    d = vector(offset, 3, "offset")
    steiner = number(mass, "mass") * (d @ d * np.eye(3) - np.outer(d, d))
    return _square(inertia) + steiner


def rotate(inertia: ArrayLike, orientation: OrientationLike) -> Array:
    """The tensor R I R^T of a part in the axes of the body.

    inertia: in axes of the part, in any form that spatial_body() takes. orientation: of the part in
    the axes of the body, in any form that spatial_body() takes.
    """
    p = quaternion(orientation, "orientation")
    r = matrix(p / np.linalg.norm(p))
    turned: Array = r @ _square(inertia) @ r.T
    return turned


def _square(inertia: ArrayLike) -> Array:
    xx, yy, zz, xy, xz, yz = tensor(inertia, "inertia")
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
