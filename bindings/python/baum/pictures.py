# SPDX-License-Identifier: BSD-3-Clause
"""Draw the pictures of the library with Matplotlib, which writes PDF and PNG files and movies.

The library writes only a small part of SVG: paths with absolute commands, circles and one-line
texts. These elements have fill, stroke, stroke width and dashes, and may be in groups without
attributes. This module reads only this part of SVG.
"""

from __future__ import annotations

import io
import os
import re
import xml.etree.ElementTree as xml
from typing import TYPE_CHECKING, Any

from . import _files
from ._values import vector
from .typing import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INCH = 96  # [px]
POINTS = 72 / INCH  # [pt/px] typographic points per pixel
# Commands of SVG paths -> codes of Matplotlib.
COMMANDS = {"M": 1, "L": 2, "Q": 3, "C": 4, "Z": 79}


def _tag(element: xml.Element) -> str:
    return element.tag.rpartition("}")[2]


def size_of(svg: str) -> tuple[float, float]:
    """Return width and height of a picture [px]."""
    root = xml.fromstring(svg)
    return float(root.attrib["width"]), float(root.attrib["height"])


def pixels(size: Any, most: float) -> Array:
    """Check a width and a height."""
    given = vector(size, 2, "size")
    if not ((given >= 1) & (given <= most)).all():
        raise ValueError(
            f"size: width and height from 1 to {most:g} pixels are wanted, not {size!r}"
        )
    return given


def resized(svg: str, size: Any) -> str:
    """Return the picture in another size [px]. Its content is scaled to fit into the new size, and
    centred."""
    width, height = pixels(size, 1e5)
    return re.sub(
        r'width="\d+" height="\d+"', f'width="{width:g}" height="{height:g}"', svg, count=1
    )


def import_matplotlib(caller: str) -> None:
    """Import Matplotlib. If it is missing, raise an ImportError that says what needs it."""
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError as error:
        raise ImportError(f"{caller} needs Matplotlib: pip install matplotlib") from error


def save(svg: str, path: str | os.PathLike[str], suffix: str, dpi: float) -> None:
    """Write a picture to a PDF or PNG file."""
    if suffix not in (".pdf", ".png"):
        raise ValueError(f"{os.fspath(path)!r}: a name that ends in .svg, .pdf or .png is wanted")
    import_matplotlib(f"a drawing as {suffix}")
    import matplotlib
    from matplotlib.figure import Figure

    width, height = size_of(svg)
    size = width / INCH, height / INCH
    figure = Figure(figsize=size, facecolor="white", frameon=suffix == ".png")
    draw(svg, figure)
    picture = io.BytesIO()
    with matplotlib.rc_context({"pdf.fonttype": 42}):  # embed fonts: texts stay selectable
        figure.savefig(picture, format=suffix[1:], dpi=dpi)
    _files.write(path, picture.getvalue())


def draw(svg: str, figure: Figure) -> None:
    """Draw a picture into a figure. The picture replaces what the figure shows."""
    from matplotlib.transforms import Affine2D

    root = xml.fromstring(svg)
    _, _, width, height = map(float, root.attrib["viewBox"].split())
    room = figure.get_size_inches() * INCH
    zoom = min(room[0] / width, room[1] / height)
    inches = Affine2D().translate(-width / 2, -height / 2).scale(zoom, -zoom)
    place = inches.translate(*room / 2).scale(1 / INCH) + figure.dpi_scale_trans
    figure.clear()
    for element in root.iter():
        artist = _artist(element, {**root.attrib, **element.attrib}, zoom)
        if artist is not None:
            artist.set_transform(place)
            figure.add_artist(artist)


def _artist(element: xml.Element, given: dict[str, str], zoom: float) -> Any:
    """Make a patch or a text of Matplotlib from an element of SVG. Return None for elements that
    draw nothing. given: the attributes of the element, including those that it inherits."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path
    from matplotlib.text import Text

    tag = _tag(element)
    if tag in ("svg", "g", "title"):
        return None
    if tag == "text":
        size = float(given["font-size"]) * zoom * POINTS
        at = float(given["x"]), float(given["y"])
        return Text(*at, element.text or "", color=given["fill"], fontsize=size)
    if tag == "path":
        path = _path(given["d"])
    elif tag == "circle":
        path = Path.circle((float(given["cx"]), float(given["cy"])), float(given["r"]))
    else:
        raise ValueError(f"<{tag}> is not one of the elements that baum draws")
    width = float(given["stroke-width"]) * zoom * POINTS
    dashes = [float(x) * zoom * POINTS / width for x in given.get("stroke-dasharray", "").split()]
    return PathPatch(
        path,
        facecolor=given["fill"],
        edgecolor=given["stroke"],
        linewidth=width,
        linestyle=(0, dashes) if dashes else "solid",
        capstyle="round",
        joinstyle="round",
    )


def _path(text: str) -> Any:
    """Make a path of Matplotlib from the commands of an SVG path."""
    from matplotlib.path import Path

    points: list[tuple[float, float]] = []
    codes: list[int] = []
    for command, values in re.findall(r"([A-Za-z])([^A-Za-z]*)", text):
        if command not in COMMANDS:
            raise ValueError(f"{command} is not one of the commands of paths that baum draws")
        code = COMMANDS[command]
        numbers = [float(x) for x in values.replace(",", " ").split()]
        points += list(zip(numbers[::2], numbers[1::2])) or points[:1]
        codes += [code] * (len(numbers) // 2 or 1)
    return Path(points, codes)
