# SPDX-License-Identifier: BSD-3-Clause
"""Numbers, points and arrays on their way to the library and back: checked here, so that messages
name them."""

import ctypes
import operator

import numpy as np


def number(value, label):
    """A float."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{label}: a number is wanted, not {value!r}") from None


def integer(value, label):
    """An int; nothing is rounded."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{label}: a whole number is wanted, not {value!r}") from None


def vector(value, size, label):
    """A new array of `size` doubles; of any length when size is None."""
    try:
        array = np.array(value, dtype=np.float64, order="C")
    except (TypeError, ValueError):
        raise TypeError(f"{label}: numbers are wanted, not {value!r}") from None
    if array.ndim != 1:
        raise ValueError(
            f"{label}: an array of one dimension is wanted, not of shape {array.shape}"
        )
    if size is not None and array.size != size:
        raise ValueError(f"{label}: {size} numbers are wanted, not {array.size}")
    return array


def address(array):
    """Where the numbers of an array are; None stays None."""
    return None if array is None else array.ctypes.data


def numbers(place, size):
    """A copy of the numbers at an address; None for NULL."""
    return None if place is None else np.array((ctypes.c_double * size).from_address(place))
