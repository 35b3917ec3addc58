# SPDX-License-Identifier: BSD-3-Clause
"""Drawings of mechanisms, and pages that show a run."""

from __future__ import annotations

import html
import os
import sys
import tempfile
import warnings
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING

from . import _files, _motion, pictures
from ._lib import lib
from ._values import address, vector
from .typing import ArrayLike

if TYPE_CHECKING:
    from .mechanism import Mechanism

HEIGHT = 720  # [px] height of a page that a notebook shows


class Drawing:
    """A picture of a mechanism. A notebook shows it. str(drawing) is its text in SVG."""

    def __init__(self, svg: str) -> None:
        self._svg = svg

    def __str__(self) -> str:
        return self._svg

    def __repr__(self) -> str:
        return f"<drawing of {len(self._svg)} bytes; save() it, or show it in a notebook>"

    def _repr_svg_(self) -> str:
        return self._svg

    def save(self, path: str | os.PathLike[str], *, dpi: float = 192) -> None:
        """Write the picture to a file.

        The suffix of the file determines its format. .svg and .pdf are vector graphics. .png has
        `dpi` pixels per inch, and 96 units of the picture are one inch. PDF and PNG need
        Matplotlib. Raises ImportError if it is missing, and ValueError for other suffixes.
        """
        suffix = Path(path).suffix.lower()
        if suffix == ".svg":
            _files.write(path, self._svg)
        else:
            pictures.save(self._svg, path, suffix, dpi)


class Page:
    """A page that shows a run. A notebook shows it in a frame. str(page) is its text in HTML."""

    def __init__(self, page: str) -> None:
        self._page = page

    def __str__(self) -> str:
        return self._page

    def __repr__(self) -> str:
        return f"<page of {len(self._page.encode())} bytes; save() or open() it>"

    def _repr_html_(self) -> str:
        frame = f'<iframe srcdoc="{html.escape(self._page)}" width="100%" height="{HEIGHT}"'
        return f'{frame} style="border: 0"></iframe>'

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the page to an HTML file."""
        _files.write(path, self._page)

    def open(self) -> None:
        """Open the page in the browser. The page is written to a temporary file, which is not
        deleted. If there is no browser, a warning says so."""
        handle, path = tempfile.mkstemp(prefix="baum-", suffix=".html")
        os.close(handle)
        self.save(path)
        if not webbrowser.open(Path(path).as_uri()):
            warnings.warn(f"no browser was found; the page is {path}", stacklevel=3)


def is_notebook() -> bool:
    """Tell whether Python runs in a notebook, which shows results as HTML."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return shell is not None and hasattr(shell, "kernel")


def draw(mechanism: Mechanism, q: ArrayLike | str | None) -> Drawing:
    if isinstance(q, str):
        if q != "assembled":
            raise ValueError(f'q is {q!r}, must be positions, "assembled" or None')
        return Drawing(_motion.print_text(lib.baum_mechanism_svg_assembled, mechanism))
    given = None if q is None else vector(q, mechanism.sizes.nq, "q")
    return Drawing(_motion.print_text(lib.baum_mechanism_svg, mechanism, address(given)))


def page(motion: _motion.Motion) -> Page:
    return Page(motion.print(lib.baum_page_print))


def figure(motion: _motion.Motion, sample: int, size: tuple[float, float] | None = None) -> Drawing:
    """Make the picture of one sample. size: width and height [px]; by default the library chooses
    them."""
    svg = motion.print(lib.baum_page_svg, sample)
    return Drawing(svg if size is None else pictures.resized(svg, size))
