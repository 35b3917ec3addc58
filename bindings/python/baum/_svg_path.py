# SPDX-License-Identifier: BSD-3-Clause
"""Reads SVG paths (SVG 1.1, section 8.3) as polygons. Curves become short straight lines."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np

from .typing import Array

CURVE = 16  # number of line segments that replace a Bezier curve
ARC = math.radians(5)  # [rad] largest angle that one line segment of an arc spans
LIMIT = 100_000  # largest number of points of a path

_NUMBER = re.compile(r"[\s,]*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)", re.ASCII)
_FLAG = re.compile(r"[\s,]*([01])")
_COMMAND = re.compile(r"[\s,]*([MmLlHhVvCcSsQqTtAaZz])")
_REST = re.compile(r"[\s,]*")
SIZES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


class _Reader:
    """Reads the commands and numbers of a path one after the other."""

    def __init__(self, text: str) -> None:
        self._text = text
        self.place = 0

    def error(self, why: str) -> ValueError:
        return ValueError(f"SVG path, character {self.place + 1}: {why}")

    def take(self, pattern: re.Pattern[str]) -> str | None:
        """Return the next word if it matches a pattern, otherwise None."""
        found = pattern.match(self._text, self.place)
        if found is None:
            return None
        self.place = found.end()
        return found[1]

    def at_end(self) -> bool:
        rest = _REST.match(self._text, self.place)
        return rest is not None and rest.end() == len(self._text)

    def numbers(self, command: str) -> list[float]:
        """Return the numbers of one command. The fourth and fifth number of an arc are flags, which
        may be written without a space between them."""
        values: list[float] = []
        for k in range(SIZES[command]):
            word = self.take(_FLAG if command == "A" and k in (3, 4) else _NUMBER)
            if word is None or not math.isfinite(float(word)):
                raise self.error(f"{command} needs {SIZES[command]} finite numbers")
            values.append(float(word))
        return values


def _bezier(points: list[complex]) -> list[complex]:
    """Return points on a quadratic or cubic Bezier curve, without the first point."""
    out = []
    for k in range(1, CURVE + 1):
        level, t = points, k / CURVE
        while len(level) > 1:  # de Casteljau
            level = [(1 - t) * a + t * b for a, b in zip(level, level[1:])]
        out.append(level[0])
    return out


def _arc(a: complex, numbers: list[float], b: complex) -> list[complex]:
    """Return points on an elliptic arc from a to b, without a (SVG 1.1, appendix F.6)."""
    rx, ry, degrees, large, sweep = abs(numbers[0]), abs(numbers[1]), *numbers[2:5]
    if rx == 0 or ry == 0 or a == b:
        return [b]
    turn = cmath.exp(1j * math.radians(degrees))

    def to_circle(z: complex) -> complex:
        z /= turn
        return complex(z.real / rx, z.imag / ry)

    def from_circle(z: complex) -> complex:
        return complex(z.real * rx, z.imag * ry) * turn

    half = to_circle((b - a) / 2)
    grown = max(abs(half), 1.0)  # if the ellipse is too small to reach b, it is enlarged
    rx, ry, half = rx * grown, ry * grown, half / grown
    side = math.sqrt(max(1 - abs(half) ** 2, 0.0)) * (1 if large == sweep else -1)
    # `half` and `centre` are relative to a, and scaled and rotated such that the ellipse becomes a
    # unit circle.
    centre = half - side * 1j * half / abs(half)
    if not cmath.isfinite(centre):
        raise OverflowError
    start, end = cmath.phase(-centre), cmath.phase(2 * half - centre)
    angle = (end - start) % math.tau
    if not sweep and angle > 0:
        angle -= math.tau
    count = max(math.ceil(abs(angle) / ARC), 1)
    between = [start + angle * k / count for k in range(1, count)]
    return [a + from_circle(centre + cmath.exp(1j * s)) for s in between] + [b]


class _Pen:
    """Converts the commands of a path to polygons."""

    def __init__(self) -> None:
        self.polygons: list[list[complex]] = []
        self._before = 0  # number of points in all polygons except the last one
        self._here = self._start = 0j
        self._closed = False
        # Kind and last control point of the last curve.
        self._control: tuple[str, complex] | None = None

    @property
    def count(self) -> int:
        return self._before + len(self.polygons[-1]) if self.polygons else 0

    def draw(self, command: str, relative: bool, numbers: list[float]) -> None:
        control, self._control = self._control, None
        base = self._here if relative else 0j
        points = [complex(x, y) + base for x, y in zip(numbers[::2], numbers[1::2])]
        if command == "Z":
            self._here, self._closed = self._start, True
            return
        if (
            command == "M" or self._closed
        ):  # begin a subpath; without M, it begins where the preceding subpath began
            self._start = points[0] if command == "M" else self._start
            self._here, self._closed = self._start, False
            self._before = self.count
            self.polygons.append([self._start])
            if command == "M":
                return
        if command == "H":
            line = [complex(numbers[0] + base.real, self._here.imag)]
        elif command == "V":
            line = [complex(self._here.real, numbers[0] + base.imag)]
        elif command == "A":
            line = _arc(self._here, numbers, complex(numbers[5], numbers[6]) + base)
        elif command == "L":
            line = points
        else:
            line = self._curve(command, points, control)
        self.polygons[-1].extend(line)
        self._here = line[-1]

    def _curve(
        self, command: str, points: list[complex], control: tuple[str, complex] | None
    ) -> list[complex]:
        kind = "cubic" if command in "CS" else "quadratic"
        # The first control point of S and T is the mirror image of the last control point of the
        # preceding curve.
        if command in "ST":
            known = control is not None and control[0] == kind
            points = [2 * self._here - control[1] if known and control else self._here, *points]
        self._control = kind, points[-2]
        return _bezier([self._here, *points])


def polygons(text: str) -> list[Array]:
    """Return the polygons (n, 2) of a path, one for each subpath. A subpath that is open is
    closed."""
    reader, pen, command = _Reader(text), _Pen(), ""
    while not reader.at_end():
        word = reader.take(_COMMAND)
        if word is None and command in ("", "Z", "z"):
            raise reader.error("a command is wanted, such as M or L")
        if (
            word is None
        ):  # numbers alone repeat the last command; after M, they are end points of lines
            word = {"M": "L", "m": "l"}.get(command, command)
        if not command and word not in "Mm":
            raise reader.error("a path begins with M")
        command = word
        try:
            pen.draw(word.upper(), word.islower(), reader.numbers(word.upper()))
        except (OverflowError, ZeroDivisionError):
            raise reader.error("numbers are too large or too small") from None
        if pen.count > LIMIT:
            raise reader.error(f"more than {LIMIT} points")
    return [_loop(points, k) for k, points in enumerate(pen.polygons)]


def _loop(points: list[complex], k: int) -> Array:
    """Return the corners of a subpath. If the last corner repeats the first one, remove it."""
    corners = [z for z, before in zip(points, [None, *points]) if z != before]
    corners = corners[:-1] if len(corners) > 1 and corners[-1] == corners[0] else corners
    if len(corners) < 3:
        raise ValueError(f"SVG path, subpath {k + 1}: a polygon needs 3 points, not {len(corners)}")
    found = np.array([(z.real, z.imag) for z in corners])
    if not np.isfinite(found).all():
        raise ValueError(f"SVG path, subpath {k + 1}: numbers are too large")
    return found
