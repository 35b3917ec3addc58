# SPDX-License-Identifier: BSD-3-Clause
"""Drawings of mechanisms, and pages that show a run."""

from __future__ import annotations

import ctypes
import html
import os
import sys
import tempfile
import warnings
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Sequence, Union

import numpy as np

from . import _abi, _calls
from ._lib import default, lib
from ._values import address, number, vector
from .channels import WHOLE, Channel
from .elements import Body
from .typing import Array, ArrayLike, ChannelLike, Scalar

if TYPE_CHECKING:
    from .mechanism import Mechanism
    from .run import Run

TraceLike = Union[ChannelLike, Body]
HEIGHT = 720  # [px] of a page in a notebook
ROOM = 1 << 18  # [byte] first size of the buffer, enough for most pages


class Drawing:
    """A picture of a mechanism. Notebooks show it. str(drawing) is its SVG text."""

    def __init__(self, svg: str) -> None:
        self._svg = svg

    def __str__(self) -> str:
        return self._svg

    def __repr__(self) -> str:
        return f"<drawing of {len(self._svg)} bytes; save() it, or show it in a notebook>"

    def _repr_svg_(self) -> str:
        return self._svg

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture to an SVG file."""
        Path(path).write_text(self._svg, encoding="utf-8")


class Page:
    """A page that shows a run. Notebooks show it in a frame. str(page) is its HTML text."""

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
        Path(path).write_text(self._page, encoding="utf-8")

    def open(self) -> None:
        """Open the page in the browser, from a temporary file that is not deleted. Warns if there
        is no browser."""
        handle, path = tempfile.mkstemp(prefix="baum-", suffix=".html")
        os.close(handle)
        self.save(path)
        if not webbrowser.open(Path(path).as_uri()):
            warnings.warn(f"no browser was found; the page is {path}", stacklevel=3)


def is_notebook() -> bool:
    """Tell whether Python runs in a notebook, which shows results as HTML."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return shell is not None and hasattr(shell, "kernel")


def _print(mechanism: Mechanism, function: Any, *arguments: Any) -> str:
    """Return the text that a function of the library writes into a buffer."""
    size = ctypes.c_size_t(ROOM)
    room: Any = b""
    while len(room) <= size.value:
        room = ctypes.create_string_buffer(size.value + 1)
        _calls.make(function, mechanism.handle, *arguments, room, len(room), ctypes.byref(size))
    return str(room.value, "utf-8")


def mechanism_of(run: Run) -> Mechanism:
    """The mechanism of a run. Raises ValueError if the run was pickled."""
    if run.mechanism is None:
        raise ValueError("this run was pickled; only a run with its mechanism can be shown")
    return run.mechanism


def draw(mechanism: Mechanism, q: ArrayLike | str | None) -> Drawing:
    if isinstance(q, str):
        if q != "assembled":
            raise ValueError(f'q is {q!r}, must be positions, "assembled" or None')
        return Drawing(_print(mechanism, lib.baum_mechanism_svg_assembled))
    given = None if q is None else vector(q, mechanism.sizes.nq, "q")
    return Drawing(_print(mechanism, lib.baum_mechanism_svg, address(given)))


# ---- pages ---------------------------------------------------------------------------------------


def _structs(channels: Sequence[Channel]) -> Any:
    return (_abi.baum_channel * len(channels))(*(channel.struct for channel in channels))


def _texts(texts: Sequence[str]) -> Any:
    return (ctypes.c_char_p * len(texts))(*(text.encode(errors="replace") for text in texts))


def _trace(mechanism: Mechanism, trace: TraceLike) -> Channel:
    return trace.pose if isinstance(trace, Body) else mechanism.channel(trace)


def _marks(run: Run) -> list[tuple[float, str, int]]:
    """Return times, texts and kinds of warnings, near-singular intervals and events, sorted by
    time."""
    kinds = _abi.baum_mark_kind
    marks = [(warning.first, str(warning), kinds.BAUM_MARK_WARNING) for warning in run.warnings]
    for x in run.near_singular:
        text = f"near a singular configuration, {x.branch}"
        marks.append((x.t, text, kinds.BAUM_MARK_SINGULAR))
    marks += [(event.t, f"event {event.event}", kinds.BAUM_MARK_EVENT) for event in run.events]
    return sorted(marks, key=lambda mark: mark[0])


def is_reaction(channel: Channel) -> bool:
    return bool(channel.struct.quantity == _abi.baum_quantity.BAUM_JOINT_REACTION)


def of_run(
    run: Run,
    title: str | None,
    traces: Sequence[TraceLike],
    shown: Sequence[Channel],
    plots: Sequence[tuple[str, Array]],
) -> Page:
    """Make the page of a run. shown: channels q and reactions. plots: label and column (n) of each
    curve."""
    rows = np.ascontiguousarray(np.hstack([run[channel] for channel in shown]))
    return _make(mechanism_of(run), run.t, shown, rows, title, traces, plots, _marks(run))


def of_arrays(
    mechanism: Mechanism,
    t: ArrayLike,
    q: ArrayLike,
    title: str | None,
    traces: Sequence[TraceLike],
    plots: Mapping[str, ArrayLike],
    marks: Sequence[tuple[Scalar, str]],
) -> Page:
    """Make the page of a motion that is given as arrays."""
    times = vector(t, None, "t")
    rows = np.ascontiguousarray(q, dtype=np.float64)
    wanted = (len(times), mechanism.sizes.nq)
    if rows.shape != wanted:
        raise ValueError(f"q: an array of shape {wanted} is wanted, not {rows.shape}")
    steps = np.diff(times)
    if not (np.isfinite(times).all() and ((steps > 0).all() or (steps < 0).all())):
        raise ValueError("t: finite times are wanted that only rise or only fall")
    columns = [(label, vector(values, len(times), label)) for label, values in plots.items()]
    kind = _abi.baum_mark_kind.BAUM_MARK_EVENT
    events = [(number(when, "time of a mark"), str(text), kind) for when, text in marks]
    return _make(mechanism, times, [WHOLE["q"]], rows, title, traces, columns, events)


def _make(
    mechanism: Mechanism,
    t: Array,
    shown: Sequence[Channel],
    rows: Array,
    title: str | None,
    traces: Sequence[TraceLike],
    plots: Sequence[tuple[str, Array]],
    marks: Sequence[tuple[float, str, int]],
) -> Page:
    times = np.ascontiguousarray(t)
    values = np.array([column for _, column in plots]).T.copy()
    mark_times = np.array([t for t, _, _ in marks])
    paths = [_trace(mechanism, trace) for trace in traces]
    struct = default(_abi.baum_page)
    struct.title = None if title is None else title.encode(errors="replace")
    struct.times, struct.count = address(times), len(times)
    struct.channels, struct.channel_count = _structs(shown), len(shown)
    struct.rows = address(rows)
    struct.plots, struct.plot_count = address(values), len(plots)
    struct.plot_labels = _texts([label for label, _ in plots])
    struct.traces, struct.trace_count = _structs(paths), len(paths)
    struct.mark_times, struct.mark_count = address(mark_times), len(marks)
    struct.mark_texts = _texts([text for _, text, _ in marks])
    struct.mark_kinds = (ctypes.c_int32 * len(marks))(*(kind for _, _, kind in marks))
    return Page(_print(mechanism, lib.baum_page_print, ctypes.byref(struct)))
