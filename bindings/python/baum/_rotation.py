# SPDX-License-Identifier: BSD-3-Clause
"""Convert orientations and inertia tensors from the forms in which users may give them to the forms
that the library uses."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._values import vector
from .typing import Array

# Largest deviation from a rotation that a matrix may have. Numbers that were typed by hand are
# often rounded.
ROUNDING = 1e-6


def _matrix(value: Any, label: str) -> Array:
    """Convert a value to a 3 x 3 array of numbers."""
    return vector(np.ravel(np.asarray(value)), 9, label).reshape(3, 3)


def _is_matrix(value: Any) -> bool:
    return np.ndim(value) == 2


def tensor(value: Any, label: str) -> Array:
    """Return the six numbers xx, yy, zz, xy, xz, yz of an inertia tensor. value: these numbers,
    three principal moments or a 3 x 3 matrix."""
    if _is_matrix(value):
        i = _matrix(value, label)
        if not np.allclose(i, i.T, rtol=0.0, atol=1e-9 * abs(i).max()):
            raise ValueError(f"{label}: the matrix is not symmetric")
        return np.array([i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])
    given = vector(np.atleast_1d(value), None, label)
    if given.size not in (3, 6):
        raise ValueError(
            f"{label}: 6 numbers (xx, yy, zz, xy, xz, yz), 3 principal moments or a 3 x 3 matrix "
            f"are wanted, not {given.size} numbers"
        )
    return np.concatenate([given, np.zeros(6 - given.size)])


def six_by_six(value: Any, label: str) -> Array:
    """Return the 36 numbers of a 6 x 6 matrix, row-major. value: the matrix, or the six numbers of
    its diagonal."""
    if _is_matrix(value) or np.size(value) == 36:
        return vector(np.ravel(np.asarray(value)), 36, label)
    return np.ravel(np.diag(vector(value, 6, label)))


def quaternion(value: Any, label: str) -> Array:
    """Return the quaternion w, x, y, z of an orientation. value: this quaternion, a 3 x 3 rotation
    matrix or a Rotation of SciPy."""
    if hasattr(value, "as_quat"):  # x, y, z, w
        return np.roll(vector(value.as_quat(), 4, label), 1)
    if not _is_matrix(value):
        p = vector(value, None, label)
        if p.size != 4:
            raise ValueError(
                f"{label}: a quaternion w, x, y, z or a 3 x 3 rotation matrix is wanted, not "
                f"{p.size} numbers"
            )
        return p
    r = _matrix(value, label)
    off = abs(r.T @ r - np.eye(3)).max()
    if not off <= ROUNDING:
        raise ValueError(
            f"{label}: the matrix is not a rotation: its columns deviate by {off:.2g} from "
            f"orthogonal unit vectors, at most {ROUNDING:g} is allowed"
        )
    if np.linalg.det(r) < 0:
        raise ValueError(f"{label}: the matrix is not a rotation: its columns are left-handed axes")
    return _of_matrix(r)


def _of_matrix(r: Array) -> Array:
    """Return the quaternion p of a rotation matrix, with w >= 0 (Shepperd 1978). The matrix
    determines p p^T. Every row of p p^T is a multiple of p. The row with the largest diagonal entry
    is normalized."""
    turned = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    outer = np.empty((4, 4))
    outer[0, 0] = 1.0 + np.trace(r)
    outer[0, 1:] = outer[1:, 0] = turned
    outer[1:, 1:] = r + r.T + (1.0 - np.trace(r)) * np.eye(3)
    row: Array = outer[np.argmax(np.diag(outer))]
    found: Array = row / np.copysign(np.linalg.norm(row), row[0])
    return found


def matrix(quaternions: Array) -> Array:
    """Return the rotation matrices (... x 3 x 3) of unit quaternions (... x 4), w first."""
    w, x, y, z = np.moveaxis(quaternions, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
