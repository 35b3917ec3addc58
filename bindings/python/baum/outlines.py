# SPDX-License-Identifier: BSD-3-Clause
"""Outlines of bodies. Outlines replace the shapes that the library chooses for drawings."""

from __future__ import annotations

import ctypes
import os
from typing import TYPE_CHECKING, Any, Callable, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _abi, _calls, _mesh_files, _svg_path
from ._lib import default, lib
from ._values import address, number, numbers, point
from .typing import Array, ArrayLike, Scalar

if TYPE_CHECKING:
    from .elements import Body

Form = _abi.baum_outline_form
ZERO = (0.0, 0.0, 0.0)


def _numbers(value: Any) -> Array:
    """Convert a value to a new array of any shape. Text is refused, even if it looks like
    numbers."""
    if np.asarray(value).dtype.kind not in "biufO":
        raise TypeError
    return np.array(value, dtype=np.float64, order="C")


def _table(value: Any, widths: Sequence[int], label: str) -> Array:
    """Convert a value to a new array (n, 3). If z is missing, it is 0."""
    try:
        array = _numbers(value)
    except (TypeError, ValueError):
        raise TypeError(f"{label}: numbers are wanted, not {value!r}") from None
    if array.ndim != 2 or array.shape[1] not in widths:
        shapes = " or ".join(f"(n, {width})" for width in widths)
        raise ValueError(f"{label}: the shape {shapes} is wanted, not {array.shape}")
    return np.ascontiguousarray(np.pad(array, ((0, 0), (0, 3 - array.shape[1]))))


def _triples(value: Any, count: int) -> NDArray[np.int32]:
    """Convert a value to a new array (m, 3) of indices below count."""
    given = np.asarray(value)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"triangles: the shape (m, 3) is wanted, not {given.shape}")
    if given.dtype.kind not in "iu":
        raise TypeError(f"triangles: whole numbers are wanted, not {given.dtype}")
    if given.size and not (0 <= given.min() and given.max() < count):
        raise ValueError(f"triangles: numbers must be from 0 to {count - 1}")
    return np.array(given, dtype=np.int32, order="C")


class Outline:
    """Base class of the outlines Polygon, Circle, Box, Cylinder, Sphere and Mesh. All lengths are
    in metres, in the axes of the body.

    color: "#rrggbb"; None lets the library choose a colour for each body.
    """

    color: str | None

    def __repr__(self) -> str:
        shown = (f"{name}={value!r}" for name, value in vars(self).items())
        return f"{type(self).__name__}({', '.join(shown)})"

    def _fill(self, struct: Any) -> list[Any]:
        """Set the fields of the struct for the library. Return the objects that must stay alive
        with it."""
        raise NotImplementedError


class Polygon(Outline):
    """A polygon in the x-y plane of the body, or parallel to it. It may be concave.

    points: its corners (n, 2), or (n, 3) with equal z.
    """

    def __init__(self, points: ArrayLike, color: str | None = None) -> None:
        self.points = _table(points, (2, 3), "points")
        self.color = color

    def _fill(self, struct: Any) -> list[Any]:
        points = _table(self.points, (2, 3), "points")
        struct.form, struct.points = Form.BAUM_OUTLINE_POLYGON, address(points)
        struct.point_count = len(points)
        return [points]


class Circle(Outline):
    """A disc parallel to the x-y plane of the body.

    radius: positive.
    center: x, y or x, y, z.
    """

    def __init__(self, radius: Scalar, center: ArrayLike = ZERO, color: str | None = None) -> None:
        self.radius = number(radius, "radius")
        self.center = point(center, "center")
        self.color = color

    def _fill(self, struct: Any) -> list[Any]:
        struct.form, struct.radius = Form.BAUM_OUTLINE_CIRCLE, number(self.radius, "radius")
        struct.center = (ctypes.c_double * 3)(*point(self.center, "center"))
        return []


class Sphere(Circle):
    """A sphere.

    radius: positive.
    center: x, y or x, y, z.
    """

    def _fill(self, struct: Any) -> list[Any]:
        super()._fill(struct)
        struct.form = Form.BAUM_OUTLINE_SPHERE
        return []


class Box(Outline):
    """A box whose edges are parallel to the axes of the body.

    size: lengths of its edges in x, y, z; one of them may be 0.
    center: x, y or x, y, z.
    """

    def __init__(self, size: ArrayLike, center: ArrayLike = ZERO, color: str | None = None) -> None:
        self.size = point(size, "size")
        self.center = point(center, "center")
        self.color = color

    def _fill(self, struct: Any) -> list[Any]:
        struct.form = Form.BAUM_OUTLINE_BOX
        struct.size = (ctypes.c_double * 3)(*point(self.size, "size"))
        struct.center = (ctypes.c_double * 3)(*point(self.center, "center"))
        return []


class Cylinder(Outline):
    """A circular cylinder.

    radius: positive.
    start, end: x, y, z of the centres of its two ends.
    """

    def __init__(
        self, radius: Scalar, start: ArrayLike, end: ArrayLike, color: str | None = None
    ) -> None:
        self.radius = number(radius, "radius")
        self.start = point(start, "start")
        self.end = point(end, "end")
        self.color = color

    def _fill(self, struct: Any) -> list[Any]:
        struct.form, struct.radius = Form.BAUM_OUTLINE_CYLINDER, number(self.radius, "radius")
        struct.start = (ctypes.c_double * 3)(*point(self.start, "start"))
        struct.end = (ctypes.c_double * 3)(*point(self.end, "end"))
        return []


class Mesh(Outline):
    """A mesh of at most 200 000 triangles.

    vertices: (n, 3).
    triangles: (m, 3) the three vertices of each triangle, as indices of rows of `vertices`, counted
        from 0.
    """

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, color: str | None = None) -> None:
        self.vertices = _table(vertices, (3,), "vertices")
        self.triangles = _triples(triangles, len(self.vertices))
        self.color = color

    @classmethod
    def load(
        cls, path: str | os.PathLike[str], scale: Scalar = 1.0, color: str | None = None
    ) -> Mesh:
        """Read an STL file (binary or text) or an OBJ file.

        scale: a factor for all lengths, such as 0.001 for a file in millimetres.

        The origin of the file becomes the origin of the body, which is its centre of mass. If the
        origin of the file is another point, move or rotate `vertices` afterwards. In an STL file,
        equal corners become one vertex. In an OBJ file, faces with more than three corners must be
        convex. Materials are ignored. Raises ValueError for a file that cannot be read; the message
        names the line or the byte.
        """
        vertices, triangles = _mesh_files.load(path)
        return cls(vertices * number(scale, "scale"), triangles, color)

    def __repr__(self) -> str:
        return f"<mesh of {len(self.vertices)} vertices and {len(self.triangles)} triangles>"

    def _fill(self, struct: Any) -> list[Any]:
        vertices = _table(self.vertices, (3,), "vertices")
        triangles = _triples(self.triangles, len(vertices))
        struct.form, struct.points = Form.BAUM_OUTLINE_MESH, address(vertices)
        struct.point_count, struct.triangle_count = len(vertices), len(triangles)
        struct.triangles = triangles.ctypes.data_as(ctypes.POINTER(ctypes.c_int32))
        return [vertices, triangles]


# A shape, the corners of a polygon (n, 2), an SVG path, or a list of these.
OutlineLike = Union[Outline, ArrayLike, Sequence[Any], None]


def _is_table(value: Any) -> bool:
    """Whether a value contains the corners of one polygon. Otherwise it is a list of outlines."""
    try:
        return _numbers(value).ndim == 2
    except (TypeError, ValueError):
        return False


def shapes(value: Any, nested: bool = False) -> list[Outline]:
    """Convert a value that a user gave to a list of outlines."""
    if value is None:
        return []
    if isinstance(value, Outline):
        return [value]
    if isinstance(value, str):
        return [Polygon(points) for points in _svg_path.polygons(value)]
    if _is_table(value):
        return [Polygon(value)]
    if nested or not isinstance(value, (Sequence, np.ndarray)):
        raise TypeError(
            "outline: a shape, a list of points, an SVG path or a list of these is wanted, not "
            f"{value!r}"
        )
    return [shape for part in value for shape in shapes(part, nested=True)]


class Structs:
    """Outlines as an array of structs for the library."""

    def __init__(self, value: OutlineLike) -> None:
        outlines = shapes(value)
        self.count = len(outlines)
        self.array = (_abi.baum_outline * self.count)()
        self._keep: list[Any] = []
        for k, outline in enumerate(outlines):
            struct = default(_abi.baum_outline)
            if outline.color is not None and not isinstance(outline.color, str):
                raise TypeError(f'color: text such as "#1f77b4" is wanted, not {outline.color!r}')
            struct.color = None if outline.color is None else outline.color.encode()
            self._keep += outline._fill(struct)
            self.array[k] = struct

    def check(self) -> None:
        """Raise the error of the library if it refuses these outlines. Their body is not added yet,
        so this method gives the outlines to the ground of a temporary mechanism."""
        if self.count == 0:
            return
        mechanism = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_create, ctypes.byref(mechanism))
        try:
            self.set(mechanism, _abi.BAUM_GROUND)
        finally:
            lib.baum_mechanism_destroy(mechanism)

    def set(self, mechanism: Any, body: Any) -> None:
        _calls.make(lib.baum_mechanism_set_outlines, mechanism, body, self.array, self.count)


# ---- back from the library -----------------------------------------------------------------------


def _points(struct: Any) -> Array:
    found = numbers(struct.points, 3 * struct.point_count)
    assert found is not None  # polygons and meshes have points
    return found.reshape(-1, 3)


def _triangles(struct: Any) -> NDArray[np.int32]:
    return np.ctypeslib.as_array(struct.triangles, (struct.triangle_count, 3))


OF: dict[int, Callable[[Any, Any], Outline]] = {
    Form.BAUM_OUTLINE_POLYGON: lambda s, color: Polygon(_points(s), color),
    Form.BAUM_OUTLINE_CIRCLE: lambda s, color: Circle(s.radius, tuple(s.center), color),
    Form.BAUM_OUTLINE_BOX: lambda s, color: Box(tuple(s.size), tuple(s.center), color),
    Form.BAUM_OUTLINE_CYLINDER: lambda s, color: Cylinder(
        s.radius, tuple(s.start), tuple(s.end), color
    ),
    Form.BAUM_OUTLINE_SPHERE: lambda s, color: Sphere(s.radius, tuple(s.center), color),
    Form.BAUM_OUTLINE_MESH: lambda s, color: Mesh(_points(s), _triangles(s), color),
}


def read(body: Body) -> list[Outline]:
    """Return the outlines of a body."""
    handle, found = body.mechanism.handle, []
    for k in range(lib.baum_mechanism_outline_count(handle, body.id)):
        struct = _abi.baum_outline()
        out, size = ctypes.byref(struct), ctypes.sizeof(struct)
        _calls.make(lib.baum_mechanism_get_outline, handle, body.id, k, out, size)
        color = None if struct.color is None else struct.color.decode()
        found.append(OF[struct.form](struct, color))
    return found
