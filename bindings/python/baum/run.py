# SPDX-License-Identifier: BSD-3-Clause
"""The results of a run."""

from __future__ import annotations

import copy
import os
from typing import TYPE_CHECKING, Any, Iterator, NamedTuple, NoReturn, Sequence

import numpy as np

from . import _html, _motion, _records, drawings, movies, scenes, units
from ._motion import Forces, TraceLike
from ._rotation import matrix
from ._strict import Strict
from ._values import number
from .channels import Channel, Layout
from .drawings import Drawing, Page
from .elements import Body, Element
from .errors import Status, Warning
from .typing import Array, ChannelLike, Progress, Scalar

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from .mechanism import Mechanism

EnergyAccount = _records.EnergyAccount


class _ByName:
    # Base class of named tuples that contain handles. Pickling replaces handles by their names.
    __slots__ = ()

    def __reduce__(self) -> Any:
        values: Any = self
        named = [value.name if isinstance(value, Element) else value for value in values]
        return values._make, (named,)

    def __deepcopy__(self, memo: Any) -> Any:
        return self


class Counters(_ByName, _records.Counters):
    __doc__ = f"{_records.Counters.__doc__}"  # help() shows no docstring of a base class
    __slots__ = ()


class NearSingular(_ByName, _records.NearSingular):
    __doc__ = f"{_records.NearSingular.__doc__}"  # help() shows no docstring of a base class
    __slots__ = ()


class _Event(NamedTuple):
    t: float
    event: int
    direction: int


class Event(_Event):
    """An event that has happened. It is a tuple (t, event, direction) with the additional attribute
    `name`.

    t: its time [s].
    event: its number, which Simulation.event() has returned.
    direction: 1 if the event function or the coordinate rises in time, -1 if it falls.
    name: the name that Simulation.event() was given, by default "event 0", "event 1", ...
    """

    name: str

    def __new__(cls, t: float, event: int, direction: int, name: str | None = None) -> Event:
        made = super().__new__(cls, t, event, direction)
        made.name = f"event {event}" if name is None else name
        return made

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]}, name={self.name!r})"


class Place(NamedTuple):
    """The slices of q and v that belong to a body. in_body_axes: True if v contains the angular
    velocity in body axes, although the channel of the body has it in ground axes."""

    q: slice
    v: slice
    in_body_axes: bool


class Account(NamedTuple):
    """What a simulation reports at the end of a run."""

    counters: Counters
    explain: str
    warnings: list[Warning]
    near_singular: list[NearSingular]
    events: list[Event]
    energy_account: EnergyAccount | None


class _Pickled(NamedTuple):
    """What a pickled run contains of its mechanism: the scene (a JSON text), whether the mechanism
    has functions, and the structs of the recorded channels as bytes."""

    scene: str
    has_functions: bool
    channels: dict[str, bytes]


class Run(Strict):
    """The samples of a run.

    t: times (n) [s].
    q: positions (n x nq).
    v: velocities (n x nv).
    status: Status.OK, or Status.WARNED if there are warnings; Status.STOP_CANCELLED or
        Status.STOP_EVENT if the samples end early; for a failed run, the status of the error.
    failure: the message of the error if the run has failed, otherwise None. The baum.Error that a
        failed run raises has this Run as its attribute `run`.
    counters: numbers of steps and evaluations, the wall time, and the largest constraint violations
        of the run.
    explain: a text that explains the methods of the run.
    warnings: a list with one baum.Warning for each kind of warning.
    near_singular, events: lists of the intervals in which the run was near a singular
        configuration, and of the events. Both lists cover the whole simulation up to the last
        sample.
    energy_account: the energies and the work of all forces up to the last sample; None without the
        option energy_account.

    To read a recorded channel (n x columns), write run["B.phi"] or `run[m["B"].phi]`, where "B" is
    the name of an element of the mechanism m. Poses and velocities of bodies need not be recorded,
    because they follow from q and v: run["slider.pose"] is always available.
    """

    t: Array
    q: Array
    v: Array
    status: Status
    failure: str | None
    counters: Counters
    explain: str
    warnings: list[Warning]
    near_singular: list[NearSingular]
    events: list[Event]
    energy_account: EnergyAccount | None

    def __init__(
        self,
        mechanism: Mechanism,
        layout: Layout,
        times: Array,
        rows: Array,
        status: Status,
        account: Account,
    ) -> None:
        self._mechanism: Mechanism | None = mechanism
        self._pickled: _Pickled | None = None
        self.t = times
        self.status = status
        self.failure = None
        self.counters, self.explain, self.warnings = account[:3]
        self.near_singular, self.events, self.energy_account = account[3:]
        self._slices = layout.slices
        self._channels = layout.channels
        self._rows = rows
        self._bodies: dict[str, Place] | None = None
        self._units: dict[str, units.Units] = {}
        self.q = self["q"]
        self.v = self["v"]

    def __getstate__(self) -> dict[str, Any]:
        bodies, pickled, mechanism = self._bodies, self._pickled, self._mechanism
        if bodies is None and mechanism is not None:
            bodies = {one.name: _place(one) for one in mechanism if one.family == "body"}
        if pickled is None and mechanism is not None:
            structs = {key: bytes(channel.struct) for key, channel in self._channels.items()}
            pickled = _Pickled(mechanism.scene(), bool(mechanism.function_names()), structs)
        known = {key: self._units_of(key) for key in self}
        own: dict[str, Any] = dict(_mechanism=None, _pickled=pickled, _channels={})
        return dict(vars(self), **own, _bodies=bodies, _units=known, q=None, v=None)

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self.q = self["q"]
        self.v = self["v"]

    def __deepcopy__(self, memo: Any) -> Run:
        copied = type(self).__new__(type(self))
        own = {name: copy.deepcopy(value, memo) for name, value in self.__getstate__().items()}
        kept = dict(_mechanism=self._mechanism, _channels=self._channels, _bodies=self._bodies)
        copied.__setstate__(dict(own, **kept))
        return copied

    @property
    def mechanism(self) -> Mechanism | None:
        """The mechanism. It is None in an unpickled run whose mechanism has functions, because
        functions are not pickled."""
        if self._mechanism is None and self._pickled and not self._pickled.has_functions:
            self._mechanism = scenes.parse(self._pickled.scene).freeze()
            first = next(one for one in self._mechanism if one.family == "body")
            for key, struct in self._pickled.channels.items():
                self._channels[key] = Channel.of_bytes(key, struct, first.id.tag)
        return self._mechanism

    @property
    def scene(self) -> str:
        """The mechanism as a JSON text, also after pickling; see Mechanism.scene()."""
        if self._pickled is not None:
            return self._pickled.scene
        assert self._mechanism is not None  # a run without its mechanism was pickled
        return self._mechanism.scene()

    def __array__(self, *how: Any, **also: Any) -> NoReturn:
        raise TypeError(
            "a run is several arrays: take one of them, such as run.q, or run.to_dict(); a table "
            "is run.to_dataframe() or pandas.DataFrame(run.to_dict())"
        )

    def __repr__(self) -> str:
        name = self.status.name if isinstance(self.status, Status) else self.status
        return f"<run of {len(self.t)} samples, {self.counters.steps} steps, {name}>"

    def _repr_html_(self) -> str:
        """Show a table of the channels in notebooks."""
        rows = []
        for key in self:
            values = self[key]
            end = ", ".join(f"{value:.4g}" for value in values[-1, :6]) if len(values) else ""
            more = ", ..." if len(values) and values.shape[1] > 6 else ""
            rows.append(
                (key, values.shape[1], ", ".join(self._units_of(key)[:6]) + more, end + more)
            )
        return _html.table(repr(self)[1:-1], ("channel", "columns", "units", "at the end"), rows)

    # ---- channels --------------------------------------------------------------------------------

    def keys(self) -> list[str]:
        """Names of the recorded channels."""
        return list(self._slices)

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def __contains__(self, key: object) -> bool:
        name = key.key if isinstance(key, Channel) else key
        return name in self._slices or self._of_body(name) is not None

    def __getitem__(self, key: ChannelLike) -> Array:
        """Return the columns (n x columns) of a channel, which is given as a channel or by its
        name. Raises KeyError for a channel that was not recorded."""
        name = key.key if isinstance(key, Channel) else key
        recorded = self._slices.get(name)
        if recorded is not None:
            return self._rows[:, recorded]
        found = self._of_body(name)
        if found is None:
            if self._mechanism is not None and isinstance(key, str):
                self._mechanism.channel(key)  # raises KeyError if there is no such channel
            raise KeyError(
                f"{name!r} was not recorded; there are {', '.join(self.keys())} and poses and "
                "velocities of bodies; name others in record=[...]"
            )
        whole, columns, place = found
        values = np.ascontiguousarray(self[whole][:, columns])
        if whole == "v" and place.in_body_axes:
            axes = matrix(self.q[:, place.q][:, 3:])
            values[:, 3:] = np.einsum("nij,nj->ni", axes, values[:, 3:])
        return values

    def _ipython_key_completions_(self) -> list[str]:
        bodies = list(self._bodies or ())
        if self._bodies is None and self._mechanism is not None:
            bodies = [one.name for one in self._mechanism if one.family == "body"]
        return [*self, *(f"{name}.{end}" for name in bodies for end in ("pose", "velocity"))]

    def _of_body(self, name: object) -> tuple[str, slice, Place] | None:
        """Find the pose or the velocity of a body: return "q" or "v", the slice of the body in q or
        v, and the Place of the body. Return None for other names."""
        body, _, what = str(name).rpartition(".")
        place = self._place_of(body) if what in ("pose", "velocity") else None
        if place is None:
            return None
        return ("q", place.q, place) if what == "pose" else ("v", place.v, place)

    def _place_of(self, body: str) -> Place | None:
        """Return the slices of q and v that belong to a body, or None if there is no such body."""
        if self._bodies is not None:
            return self._bodies.get(body)
        if self._mechanism is None or body not in self._mechanism:
            return None
        element = self._mechanism[body]
        return None if element.family != "body" or element.kind is None else _place(element)

    # ---- tables and plots ------------------------------------------------------------------------

    @property
    def columns(self) -> dict[str, str]:
        """A dict from the name of each column of to_dict() to the unit of this column. The unit is
        "-" for pure numbers, and "" if the unit depends on your functions."""
        named = {"t": "s"}
        for key in self:
            named.update(zip(self._names(key), self._units_of(key)))
        return named

    def _names(self, key: str) -> list[str]:
        count = self[key].shape[1]
        return [key] if count == 1 else [f"{key}[{k}]" for k in range(count)]

    def _units_of(self, key: str) -> units.Units:
        """Return the unit of each column of a channel."""
        if key not in self._units:
            found = self._of_body(key)
            if found is not None:
                return self._units_of(found[0])[found[1]]
            assert self._mechanism is not None  # a pickled run contains its units
            self._units[key] = units.of_channel(self._mechanism, self._channels[key])
        return self._units[key]

    def to_dict(self) -> dict[str, Array]:
        """Return a dict from names to columns (n). The names are "t" and the names of the recorded
        channels. If a channel has several columns, the name of each column ends with its index,
        such as "energy[1]"."""
        named = {"t": self.t}
        for key in self:
            named.update(zip(self._names(key), self[key].T))
        return named

    def to_dataframe(self) -> pandas.DataFrame:
        """Return all columns as a pandas.DataFrame with the time [s] as its index. The attribute
        attrs["units"] of the DataFrame contains the unit of each column. Raises ImportError without
        pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("Run.to_dataframe() needs pandas: pip install pandas") from error
        frame = pandas.DataFrame(self.to_dict()).set_index("t")
        frame.attrs["units"] = self.columns
        return frame

    def plot(self, *channels: ChannelLike, axes: Any = None) -> list[Axes]:
        """Plot channels over time with Matplotlib, for example by run.plot("slider.velocity").

        channels: by default all recorded channels except q and v.
        axes: Matplotlib axes to draw into, one for each unit; by default new axes in a new figure.

        Returns the axes, one for each unit. Raises KeyError for a channel that was not recorded,
        and ImportError without Matplotlib.
        """
        keys = [one.key if isinstance(one, Channel) else one for one in channels]
        curves: dict[str, list[tuple[str, Array]]] = {}
        for key in keys or [key for key in self if key not in ("q", "v")] or ["q"]:
            for name, unit, values in zip(self._names(key), self._units_of(key), self[key].T):
                curves.setdefault(unit, []).append((name, values))
        places = _axes(len(curves), axes)
        for place, (unit, drawn) in zip(places, curves.items()):
            for name, values in drawn:
                place.plot(self.t, values, label=name)
            title = drawn[0][0] if len(drawn) == 1 else _common([name for name, _ in drawn])
            place.set_ylabel(f"{title} [{unit}]".lstrip() if unit else title)
            if len(drawn) > 1:
                place.legend()
        places[-1].set_xlabel("t [s]")
        return places

    # ---- pages, pictures and movies --------------------------------------------------------------

    def page(
        self,
        path: str | os.PathLike[str],
        *,
        title: str | None = None,
        traces: Sequence[TraceLike] = (),
        forces: Forces = None,
        plots: Sequence[ChannelLike] | None = None,
    ) -> None:
        """Write a page that shows the motion in any browser: one HTML file, which loads no other
        file.

        traces: points whose paths are drawn. A body stands for its centre of mass; a channel such
            as m["rod"].pose_of((0.1, 0)) gives another point.
        forces: which recorded reactions are shown as arrows. None, the default, shows all. True
            also shows all, but raises ValueError if no reaction was recorded. A list such as
            ["A.reaction"] chooses some, and False shows none.
        plots: channels to plot next to the picture, by default all recorded channels except q, v
            and reactions.

        Warnings and events are marks on the time axis. A page keeps at most 600 samples. The
        samples at which a plotted column has its largest or its smallest value are among them.
        Raises ValueError if the attribute `mechanism` is None, and KeyError for a channel that was
        not recorded.
        """
        self._page(title, traces, forces, plots).save(path)

    def show(
        self,
        *,
        title: str | None = None,
        traces: Sequence[TraceLike] = (),
        forces: Forces = None,
        plots: Sequence[ChannelLike] | None = None,
    ) -> Page:
        """Show the page that page() would write. A notebook shows it in a frame; otherwise the
        browser opens it."""
        made = self._page(title, traces, forces, plots)
        if not drawings.is_notebook():
            made.open()
        return made

    def _recorded(self) -> list[Channel]:
        """Return the recorded channels. The list is empty if the run has no mechanism."""
        return list(self._channels.values()) if self.mechanism is not None else []

    def _page(
        self,
        title: str | None,
        traces: Sequence[TraceLike],
        forces: Forces,
        plots: Sequence[ChannelLike] | None,
    ) -> Page:
        known = self._recorded()
        if plots is None:
            others = [channel.key for channel in known if not _motion.is_reaction(channel)]
            plots = [key for key in others if key not in ("q", "v")]
        columns = []
        for plot in _motion.listed(plots):
            key = plot.key if isinstance(plot, Channel) else plot
            for name, unit, values in zip(self._names(key), self._units_of(key), self[key].T):
                columns.append((f"{name} [{unit}]" if unit else name, values))
        return drawings.page(_motion.of_run(self, known, traces, forces, title, columns))

    def figure(
        self,
        t: Scalar,
        *,
        traces: Sequence[TraceLike] = (),
        forces: Forces = None,
        size: tuple[float, float] | None = None,
    ) -> Drawing:
        """Draw the run at the time t [s], for example for a paper: figure(t).save("x.pdf").

        traces: paths to draw, from the start to t; given as in page().
        forces: reactions to draw, as in page().
        size: width and height [px]; 96 pixels are one inch.

        Between two samples, positions are interpolated by cubic polynomials that have the recorded
        velocities at both samples, and reactions are interpolated linearly. The frame of the
        picture is large enough for the whole motion, so that pictures at several times have the
        same scale; run.mechanism.draw(run.q[k]) instead fits the frame to one configuration. Raises
        ValueError for a time outside of the run, and if the attribute `mechanism` is None.
        """
        motion = _motion.of_run(self, self._recorded(), traces, forces)
        time = number(t, "t")
        first, last = sorted(self.t[[0, -1]])
        if not first <= time <= last:
            raise ValueError(f"t: {time:g} s is not between {first:g} s and {last:g} s")
        whole, samples = _motion.refined(motion, self, np.array([time]))
        return drawings.figure(whole, samples[0], size)

    def movie(
        self,
        path: str | os.PathLike[str],
        fps: Scalar = 30,
        speed: Scalar = 1.0,
        *,
        size: tuple[float, float] = (640, 480),
        traces: Sequence[TraceLike] = (),
        forces: Forces = None,
        progress: Progress = True,
    ) -> None:
        """Write a movie of the run. The program ffmpeg writes .mp4 files, and Pillow writes .gif
        files.

        fps: frames per second of the movie. In a GIF the time between frames is rounded to a
            multiple of 1/100 s.
        speed: seconds of the run per second of the movie.
        size: width and height [px].
        traces, forces: as in figure(), which also describes the interpolation between samples.
        progress: True shows a bar in a terminal or a notebook. If you give a function, progress(t)
            is called after each frame, with the time t [s] of the frame.

        Raises ImportError without Matplotlib, RuntimeError for .mp4 without ffmpeg, ValueError for
        suffixes other than .mp4 and .gif, and ValueError if the attribute `mechanism` is None.
        """
        motion = _motion.of_run(self, self._recorded(), traces, forces)
        movies.write(self, motion, path, fps, speed, size, progress)


def _place(body: Body) -> Place:
    return Place(*body.columns, body.kind is not None and body.kind.name == "spatial_body")


def _common(names: list[str]) -> str:
    """Return the name of the channel to which all these columns belong, or "" if there is none."""
    channels = {name.rpartition("[")[0] or name for name in names}
    return channels.pop() if len(channels) == 1 else ""


def _axes(count: int, given: Any) -> list[Axes]:
    """Return Matplotlib axes, one for each unit: the given axes, or those of a new figure."""
    if given is not None:
        found = list(np.ravel(given))
        if len(found) != count:
            raise ValueError(f"axes: {count} are wanted, one for each unit, not {len(found)}")
        return found
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("Run.plot() needs Matplotlib: pip install matplotlib") from error
    figure, frames = plt.subplots(count, sharex=True, squeeze=False, layout="constrained")
    return list(frames[:, 0])
