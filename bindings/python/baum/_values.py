# SPDX-License-Identifier: BSD-3-Clause
"""Convert numbers, points and arrays to the types of the library, and back. These functions check
the values, because they know the names of the arguments and can put them into messages."""

from __future__ import annotations

import ctypes
import difflib
import operator
from typing import Any, Container, Iterable, Mapping

import numpy as np

from .typing import Array

LISTED = 30  # largest number of names in a message


def number(value: Any, label: str) -> float:
    """Convert a value to a float. Text is refused, even if it looks like a number, and so are True
    and False."""
    try:
        if isinstance(value, (str, bytes, bytearray, bool, np.bool_)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{label}: a number is wanted, not {value!r}") from None
    except OverflowError:
        raise ValueError(f"{label}: the number is too large") from None


def integer(value: Any, label: str, bits: int = 32) -> int:
    """Convert a value to an int that fits the integer type of the library. Nothing is rounded or
    truncated."""
    try:
        whole = operator.index(value)
    except TypeError:
        raise TypeError(f"{label}: a whole number is wanted, not {value!r}") from None
    if not -(2 ** (bits - 1)) <= whole < 2 ** (bits - 1):
        raise ValueError(f"{label}: {whole} does not fit into {bits} bits")
    return whole


def truth(value: Any, label: str) -> bool:
    """Convert a bool or an int to a bool. Text is refused, because "no" would be true."""
    if not isinstance(value, (bool, np.bool_, int)):
        raise TypeError(f"{label}: True or False is wanted, not {value!r}")
    return bool(value)


def unused(name: str, taken: Container[str], counts: dict[str, int]) -> str:
    """Return a name that is not taken: "rod", or "rod (2)" if there is already a "rod". `counts` is
    empty at first. It makes the search for the next number quick."""
    found = name
    while found in taken:
        counts[name] = counts.get(name, 1) + 1
        found = f"{name} ({counts[name]})"
    return found


def there_are(names: Iterable[str], given: Any) -> str:
    """Return the part of a message that lists the known names, and suggests the one that is most
    similar to the given name."""
    known = list(names)
    more = f" and {len(known) - LISTED} more" if len(known) > LISTED else ""
    same = {name.lower(): name for name in known}
    near = difflib.get_close_matches(str(given).lower(), same, 1)
    meant = f"; did you mean {same[near[0]]!r}?" if near else ""
    return f"there are: {', '.join(known[:LISTED])}{more}{meant}"


def word(words: Mapping[str, int], value: Any, label: str) -> int:
    """Return the number of a named constant."""
    if not isinstance(value, str) or value not in words:
        raise ValueError(f"no {label} {value!r}; {there_are(words, value)}")
    return words[value]


def vector(value: Any, size: int | None, label: str) -> Array:
    """Copy a value into a new array of `size` doubles. If size is None, any length is allowed."""
    try:
        if np.asarray(value).dtype.kind not in "iufO":
            raise TypeError
        array = np.array(value, dtype=np.float64, order="C")
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{label}: numbers are wanted, not {value!r}") from None
    if array.ndim == 0:
        raise ValueError(f"{label}: {size or 'several'} numbers are wanted, not one number")
    if array.ndim != 1:
        raise ValueError(
            f"{label}: an array of one dimension is wanted, not of shape {array.shape}"
        )
    if size is not None and array.size != size:
        raise ValueError(f"{label}: {size} numbers are wanted, not {array.size}")
    return array


def point(value: Any, label: str) -> tuple[float, float, float]:
    """Convert two or three numbers to x, y, z. If z is missing, it is 0."""
    given = vector(value, None, label).tolist()
    if len(given) not in (2, 3):
        raise ValueError(f"{label}: 2 or 3 numbers are wanted, not {len(given)}")
    x, y, z = (given + [0.0])[:3]
    return x, y, z


def address(array: Any) -> Any:
    """Return the address of the numbers of an array; None for None."""
    return None if array is None else array.ctypes.data


def numbers(place: int | None, size: int) -> Array | None:
    """Copy the numbers at an address into a new array; return None for NULL."""
    if place is None:
        return None
    return np.frombuffer(ctypes.string_at(place, 8 * size)).copy()
