# SPDX-License-Identifier: BSD-3-Clause
"""Read the triangles of STL and OBJ files. These files may be damaged. If a file cannot be read, a
ValueError names the file and the line or byte."""

from __future__ import annotations

import io
import math
import os
from pathlib import Path
from typing import Iterator

import numpy as np
from numpy.typing import NDArray

from .typing import Array

Triangles = NDArray[np.int32]
LARGEST = 1 << 27  # [byte] largest size of a file
LIMIT = 200_000  # largest number of triangles, equal to BAUM_OUTLINE_MAX_TRIANGLES
HEAD, RECORD = 84, 50  # [byte] sizes of the header of a binary STL file and of one triangle
RECORDS = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def load(path: str | os.PathLike[str]) -> tuple[Array, Triangles]:
    """Return the vertices (n, 3) and the triangles (m, 3) of a file. The suffix of the file
    determines its format."""
    file = Path(path)
    readers = {".stl": _stl, ".obj": _obj}
    if file.suffix.lower() not in readers:
        raise ValueError(f"{file}: an STL or OBJ file is wanted, with the ending .stl or .obj")
    if file.exists() and not file.is_file():
        raise ValueError(f"{file}: a regular file is wanted")
    if file.stat().st_size > LARGEST:
        raise ValueError(f"{file}: the file is larger than {LARGEST >> 20} MB")
    vertices, triangles = readers[file.suffix.lower()](file, file.read_bytes())
    if len(triangles) == 0:
        raise ValueError(f"{file}: the file has no triangles")
    if not np.isfinite(vertices).all():
        k = int(np.argmin(np.isfinite(vertices).all(axis=1)))
        raise ValueError(f"{file}: vertex {k} is {vertices[k]}, must be finite")
    used, numbers = np.unique(triangles, return_inverse=True)
    return vertices[used], numbers.reshape(-1, 3).astype(np.int32)


def _check_count(count: int, where: str) -> None:
    if count > LIMIT:
        raise ValueError(f"{where}: more than {LIMIT} triangles; simplify the mesh")


def _numbers(words: list[str], where: str) -> tuple[float, float, float]:
    """Convert words to three finite numbers."""
    try:
        x, y, z = (float(word) for word in words)
    except ValueError:
        raise ValueError(f"{where}: three numbers are wanted, not {' '.join(words)!r}") from None
    if not all(map(math.isfinite, (x, y, z))):
        raise ValueError(f"{where}: numbers must be finite, not {' '.join(words)!r}")
    return x, y, z


def _lines(data: bytes) -> Iterator[tuple[int, list[str]]]:
    """Yield the line number and the words of each line that is not empty. A backslash at the end of
    a line joins it with the next line."""
    words: list[str] = []
    for number, line in enumerate(io.StringIO(data.decode("utf-8", "replace")), 1):
        line = line.strip()
        words += line.rstrip("\\").split()
        if words and not line.endswith("\\"):
            yield number, words
            words = []


# ---- STL -----------------------------------------------------------------------------------------


def _merged(corners: Array) -> tuple[Array, Triangles]:
    """Return vertices and triangles from the corners (3 m, 3) of m triangles. Equal corners become
    one vertex."""
    vertices, numbers = np.unique(corners + 0.0, axis=0, return_inverse=True)
    return vertices, numbers.reshape(-1, 3).astype(np.int32)


def _stl(file: Path, data: bytes) -> tuple[Array, Triangles]:
    count = int.from_bytes(data[80:84], "little")
    size = HEAD + RECORD * count
    text = data.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:HEAD]
    if text and len(data) != size:
        return _stl_text(file, data)
    if len(data) < HEAD:
        raise ValueError(f"{file}: byte {len(data)}: the file ends in its head of {HEAD} bytes")
    _check_count(count, f"{file}: byte 80")
    if len(data) < size:
        raise ValueError(
            f"{file}: byte {len(data)}: the file ends, but {count} triangles need {size} bytes"
        )
    corners = np.frombuffer(data, RECORDS, count, HEAD)["corners"].reshape(-1, 3)
    bad = np.flatnonzero(~np.isfinite(corners).all(axis=1))
    if len(bad):
        byte = HEAD + RECORD * (bad[0] // 3) + 12 * (1 + bad[0] % 3)
        raise ValueError(f"{file}: byte {byte}: numbers must be finite, not {corners[bad[0]]}")
    return _merged(corners.astype(np.float64))


def _stl_text(file: Path, data: bytes) -> tuple[Array, Triangles]:
    corners: list[tuple[float, float, float]] = []
    number, word = 0, ""
    for number, words in _lines(data):
        where, word = f"{file}: line {number}", words[0].lower()
        if word == "vertex":
            corners.append(_numbers(words[1:], where))
            _check_count(len(corners) // 3, where)
        elif word not in ("solid", "facet", "outer", "endloop", "endfacet", "endsolid"):
            raise ValueError(f"{where}: {words[0]!r} is not a keyword of STL files")
        elif len(corners) % 3:
            raise ValueError(f"{where}: a triangle needs 3 vertices, not {len(corners) % 3}")
    if word != "endsolid":
        raise ValueError(f"{file}: line {number}: the file ends without endsolid")
    return _merged(np.array(corners).reshape(-1, 3))


# ---- OBJ -----------------------------------------------------------------------------------------


def _obj(file: Path, data: bytes) -> tuple[Array, Triangles]:
    """Read the lines v and f of an OBJ file, and skip the others. A polygon with more than three
    corners is cut into triangles that share its first corner."""
    vertices: list[tuple[float, float, float]] = []
    triangles: list[tuple[int, int, int]] = []
    for number, words in _lines(data):
        where = f"{file}: line {number}"
        if words[0] == "v":
            if len(vertices) == 3 * LIMIT:
                raise ValueError(f"{where}: more than {3 * LIMIT} vertices")
            vertices.append(_numbers(words[1:4], where))
        elif words[0] == "f":
            if len(words) < 4:
                raise ValueError(f"{where}: a face needs 3 corners, not {len(words) - 1}")
            _check_count(len(triangles) + len(words) - 3, where)
            first, *others = (_corner(word, len(vertices), where) for word in words[1:])
            triangles += [(first, a, b) for a, b in zip(others, others[1:])]
    return np.array(vertices).reshape(-1, 3), np.array(triangles, np.int32).reshape(-1, 3)


def _corner(word: str, count: int, where: str) -> int:
    """Return the index, counted from 0, of the vertex that a text such as 3, -1 or 3/1/2 refers
    to."""
    try:
        given = int(word.split("/")[0])
    except ValueError:
        raise ValueError(f"{where}: the number of a vertex is wanted, not {word!r}") from None
    if not (1 <= given <= count or -count <= given <= -1):
        raise ValueError(f"{where}: there is no vertex {given} among the {count} before this line")
    return given - 1 if given > 0 else count + given
