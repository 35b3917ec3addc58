# SPDX-License-Identifier: BSD-3-Clause
"""Collect the motions that pages, pictures and movies show: samples of positions and of
reactions."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Iterable, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _abi, _calls
from ._lib import default
from ._values import address, number, vector
from .channels import WHOLE, Channel
from .elements import Body
from .typing import Array, ArrayLike, ChannelLike, Scalar
from .workspace import Workspace

if TYPE_CHECKING:
    from .mechanism import Mechanism
    from .run import Run

TraceLike = Union[ChannelLike, Body]
Forces = Union[bool, Sequence[ChannelLike], None]
Curve = tuple[str, Array]  # label, column (n)
Mark = tuple[float, str, int]  # time, text, kind
ROOM = 1 << 18  # [byte] initial size of the buffer, enough for most pages


class Motion(NamedTuple):
    """The samples of a motion, and what is shown with them. `rows` (n x columns) contains the
    columns of the channels in `shown`: q, and the reactions that are drawn as arrows."""

    mechanism: Mechanism
    t: Array
    shown: Sequence[Channel]
    rows: Array
    traces: Sequence[Channel]
    title: str | None = None
    plots: Sequence[Curve] = ()
    marks: Sequence[Mark] = ()

    def print(self, function: Any, *arguments: Any) -> str:
        """Return the text that a function of the library writes for a page of this motion."""
        values = np.array([column for _, column in self.plots]).T.copy()
        mark_times = np.array([t for t, _, _ in self.marks])
        struct = default(_abi.baum_page)
        struct.title = None if self.title is None else str(self.title).encode(errors="replace")
        struct.times, struct.count = address(self.t), len(self.t)
        struct.channels, struct.channel_count = _structs(self.shown), len(self.shown)
        struct.rows = address(self.rows)
        struct.plots, struct.plot_count = address(values), len(self.plots)
        struct.plot_labels = _texts([label for label, _ in self.plots])
        struct.traces, struct.trace_count = _structs(self.traces), len(self.traces)
        struct.mark_times, struct.mark_count = address(mark_times), len(self.marks)
        struct.mark_texts = _texts([text for _, text, _ in self.marks])
        struct.mark_kinds = (ctypes.c_int32 * len(self.marks))(*(kind for _, _, kind in self.marks))
        return print_text(function, self.mechanism, ctypes.byref(struct), *arguments)


def print_text(function: Any, mechanism: Mechanism, *arguments: Any) -> str:
    """Return the text that a function of the library writes into a buffer."""
    size = ctypes.c_size_t(ROOM)
    room: Any = b""
    while len(room) <= size.value:
        room = ctypes.create_string_buffer(size.value + 1)
        _calls.make(function, mechanism.handle, *arguments, room, len(room), ctypes.byref(size))
    return str(room.value, "utf-8")


def _structs(channels: Sequence[Channel]) -> Any:
    return (_abi.baum_channel * len(channels))(*(channel.struct for channel in channels))


def _texts(texts: Sequence[str]) -> Any:
    return (ctypes.c_char_p * len(texts))(*(str(text).encode(errors="replace") for text in texts))


def listed(value: Any) -> Any:
    """Put a single name, channel or body into a list; return anything else unchanged."""
    return [value] if isinstance(value, (str, Channel, Body)) else value


def _trace(mechanism: Mechanism, trace: TraceLike) -> Channel:
    """Return the channel of a path. `trace` is a body, the name of a body, or a channel."""
    if isinstance(trace, str) and trace in mechanism and isinstance(mechanism[trace], Body):
        trace = mechanism[trace]
    return trace.pose if isinstance(trace, Body) else mechanism.channel(trace)


# ---- motions of runs and of arrays ---------------------------------------------------------------


def is_reaction(channel: Channel) -> bool:
    return bool(channel.struct.quantity == _abi.baum_quantity.BAUM_JOINT_REACTION)


def _chosen(mechanism: Mechanism, recorded: Iterable[Channel], forces: Forces) -> list[Channel]:
    """Return the reactions that the argument `forces` selects."""
    reactions = [channel for channel in recorded if is_reaction(channel)]
    if forces is None or forces is False:
        return [] if forces is False else reactions
    if forces is True:
        if not reactions:
            raise ValueError('forces: no reaction was recorded; name some in record=["A.reaction"]')
        return reactions
    chosen = [mechanism.channel(channel) for channel in listed(forces)]
    for channel in chosen:
        if not is_reaction(channel):
            raise ValueError(f"forces: {channel.key} is not the reaction of a joint")
    return chosen


def _marks(run: Run) -> list[Mark]:
    """Return the marks of a run, sorted by time: its warnings, near-singular intervals and events,
    and its failure if it has failed."""
    kinds = _abi.baum_mark_kind
    marks = [(warning.first, str(warning), kinds.BAUM_MARK_WARNING) for warning in run.warnings]
    for x in run.near_singular:
        text = f"near a singular configuration, {x.branch}"
        marks.append((x.t, text, kinds.BAUM_MARK_SINGULAR))
    marks += [(event.t, event.name, kinds.BAUM_MARK_EVENT) for event in run.events]
    if run.failure is not None and len(run.t):
        marks.append((float(run.t[-1]), run.failure, kinds.BAUM_MARK_WARNING))
    return sorted(marks, key=lambda mark: mark[0])


def of_run(
    run: Run,
    recorded: Iterable[Channel],
    traces: Sequence[TraceLike],
    forces: Forces,
    title: str | None = None,
    plots: Sequence[Curve] = (),
) -> Motion:
    """Make the motion of a run."""
    mechanism = run.mechanism
    if mechanism is None:
        raise ValueError(
            "this run was pickled with a mechanism that has functions; only a run with its "
            "mechanism can be shown"
        )
    if len(run.t) == 0:
        raise ValueError("this run has no samples to show")
    shown = [WHOLE["q"], *_chosen(mechanism, recorded, forces)]
    rows = np.ascontiguousarray(np.hstack([run[channel] for channel in shown]))
    paths = [_trace(mechanism, trace) for trace in listed(traces)]
    t = np.ascontiguousarray(run.t)
    return Motion(mechanism, t, shown, rows, paths, title, plots, _marks(run))


def of_arrays(
    mechanism: Mechanism,
    t: ArrayLike,
    q: ArrayLike,
    title: str | None,
    traces: Sequence[TraceLike],
    plots: Mapping[str, ArrayLike],
    marks: Sequence[tuple[Scalar, str]],
) -> Motion:
    """Make a motion from arrays of times and positions."""
    times = vector(t, None, "t")
    rows = np.ascontiguousarray(q, dtype=np.float64)
    wanted = (len(times), mechanism.sizes.nq)
    if rows.shape != wanted:
        raise ValueError(f"q: an array of shape {wanted} is wanted, not {rows.shape}")
    steps = np.diff(times)
    if not (np.isfinite(times).all() and ((steps > 0).all() or (steps < 0).all())):
        raise ValueError("t: times must be finite, and either only rise or only fall")
    curves = [(label, vector(values, len(times), label)) for label, values in plots.items()]
    kind = _abi.baum_mark_kind.BAUM_MARK_EVENT
    events = [(number(when, "time of a mark"), str(text), kind) for when, text in marks]
    paths = [_trace(mechanism, trace) for trace in listed(traces)]
    return Motion(mechanism, times, [WHOLE["q"]], rows, paths, title, curves, events)


# ---- between samples -----------------------------------------------------------------------------


def refined(motion: Motion, run: Run, times: Array) -> tuple[Motion, list[int]]:
    """Add samples at these times to the motion of a run. Return the motion, with its times in
    rising order, and the indices of the samples at these times. Positions of added samples are
    interpolated by cubic polynomials that have the recorded velocities at the neighbouring samples.
    Reactions are interpolated linearly."""
    order = slice(None, None, -1 if run.t[-1] < run.t[0] else 1)
    t, rows, v = motion.t[order], motion.rows[order], run.v[order]
    added = np.setdiff1d(times, t)
    if len(added):
        with Workspace(motion.mechanism) as workspace:
            new = np.array([_between(workspace, t, rows, v, time) for time in added])
        places = np.searchsorted(t, added)
        t, rows = np.insert(t, places, added), np.insert(rows, places, new, axis=0)
    whole = motion._replace(t=np.ascontiguousarray(t), rows=np.ascontiguousarray(rows))
    return whole, np.searchsorted(t, times).tolist()


def _between(workspace: Workspace, t: Array, rows: Array, v: Array, time: float) -> Array:
    """Interpolate a row between two samples."""
    nq = workspace.mechanism.sizes.nq
    k = int(np.searchsorted(t, time)) - 1
    step = t[k + 1] - t[k]
    s = (time - t[k]) / step
    row: Array = (1 - s) * rows[k] + s * rows[k + 1]
    chord = rows[k + 1, :nq] - rows[k, :nq]
    bend = [step * workspace.rate(rows[i, :nq], v[i]) - chord for i in (k, k + 1)]
    row[:nq] += s * (1 - s) * ((1 - s) * bend[0] - s * bend[1])
    return row
