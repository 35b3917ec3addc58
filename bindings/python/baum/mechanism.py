# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms, which consist of bodies, joints, forces and inputs."""

from __future__ import annotations

import ctypes
import inspect
import os
import re
import types
import weakref
from typing import TYPE_CHECKING, Any, Iterator, Literal, Mapping, NamedTuple, Sequence

import numpy as np

from . import _abi, _calls, _html, _motion, _records, design, design_space, drawings, fmu
from ._lib import lib, text
from ._motion import TraceLike
from ._strict import Strict
from ._values import number, numbers, point, there_are, unused, vector
from .adding import Adding
from .adding_space import AddingInSpace
from .channels import WHOLE, Channel, has
from .definitions import KINDS, Definition, sizes
from .drawings import Drawing, Page
from .elements import CLASSES, GROUND, Body, Element, Entry, Input, Joint, one
from .run import Run
from .scenes import Scenes
from .simulation import Simulation, takes_options
from .typing import Array, ArrayLike, Axis, BodyLike, ChannelLike, InputLike, JointLike, Scalar

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .integrators import Integrator
    from .typing import SimulationOptions

MANY = 1000  # from this number of elements on, an evaluation may take longer than a few ms


GRAVITY = (0.0, -9.81)  # [m/s^2]


class Sizes(NamedTuple):
    """The sizes of a mechanism: numbers of positions nq, velocities nv and constraint rows nc."""

    nq: int
    nv: int
    nc: int


class Mobility(_records.Mobility):
    __doc__ = f"{_records.Mobility.__doc__}"
    __slots__ = ()

    def __str__(self) -> str:
        return self.text


class Report(_records.Report):
    __doc__ = f"{_records.Report.__doc__}"
    __slots__ = ()

    def __str__(self) -> str:
        return self.text


def _against(up: str, gravity: Any) -> list[float]:
    """Return the default gravity in the direction opposite to an axis."""
    if up not in ("x", "y", "z"):
        raise ValueError(f'up: "x", "y" or "z" is wanted, not {up!r}')
    if gravity is not GRAVITY:
        raise ValueError("gravity and up are both given; give one of them")
    return [GRAVITY[1] if axis == up else 0.0 for axis in "xyz"]


def _entry_of(address: int, family: str, id: ctypes.Structure) -> Entry:
    """Make the entry of an element. The library returns a definition only to a caller that names
    the right kind, so this function tries all kinds."""
    if family == "input":
        return Entry(family, None, id, 0, 0)
    for kind in KINDS.values():
        if kind.family == family:
            struct = kind.struct()
            asked = kind.function("get")
            if asked(address, id, ctypes.byref(struct), ctypes.sizeof(struct)) == 0:
                return Entry(family, kind, id, *sizes(kind, struct))
    raise TypeError(f"{one(family)} of a kind that this package does not know")


REPLACED = re.compile("offset|free_(length|angle|value)")
ADD_INPUT = "add one by Mechanism.input() before freezing"


class Mechanism(Adding, AddingInSpace, Scenes, Strict):
    """A mechanism: bodies, joints, forces and inputs.

    First add elements. Then freeze() makes the mechanism constant, so that it can be simulated and
    shared between threads.

    gravity: (x, y) or (x, y, z) [m/s^2].
    up: the axis that points upward, "x", "y" or "z"; give it instead of gravity. Gravity is then
        9.81 m/s^2 in the direction opposite to this axis.
    characteristic_length: the length [m] to which tolerances are relative, by default the size of
        the mechanism in the design configuration, which is given by the positions in the
        definitions of the bodies.

    You may use any consistent set of units. Angles are in radians.

    The place of a joint is given either by `point`, in ground axes and in the design configuration,
    or by `point_a` and `point_b`, in the axes of the bodies. Most joints in space also have `axis`
    and `axis_b`. m["A"] is the handle of the element with the name "A". Functions that you give for
    an element receive arguments such as (t, q) or (t, q, v), and return their result. Here t is the
    time, and q and v are the positions and velocities of the bodies on which the element acts.
    """

    handle: int

    def __init__(
        self,
        gravity: ArrayLike = GRAVITY,
        characteristic_length: Scalar | None = None,
        up: Axis | None = None,
    ) -> None:
        out = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_create, ctypes.byref(out))
        self._adopt(out.value)
        self.gravity = gravity if up is None else _against(up, gravity)
        if characteristic_length is not None:
            self.characteristic_length = characteristic_length

    def _adopt(self, address: Any, like: Mechanism | None = None) -> None:
        """Take over a mechanism of the library. If it is a copy of the Mechanism `like`, take over
        the elements and functions of `like`, too."""
        self._owner = _calls.Handle(address, lib.baum_mechanism_destroy, "mechanism")
        self.handle = address
        self._sizes: Sizes | None = None  # None until they are read after freezing
        self.has_python = like is not None and like.has_python
        self._keep = [] if like is None else list(like._keep)
        self._entries = {"ground": GROUND} if like is None else dict(like._entries)
        self._handles: weakref.WeakValueDictionary[str, Element] = weakref.WeakValueDictionary()

    @classmethod
    def of_library(cls, address: Any) -> Mechanism:
        """Make a Mechanism from the address of a mechanism that a C function has built. From then
        on, the Mechanism frees the memory at this address."""
        made = cls.__new__(cls)
        made._adopt(address)
        counts: dict[str, int] = {}
        for family in CLASSES:
            count = getattr(lib, f"baum_mechanism_{family}_count")(address)
            for k in range(count):
                id = getattr(lib, f"baum_mechanism_{family}_at")(address, k)
                name = getattr(lib, f"baum_mechanism_{family}_name")(address, id).decode()
                made._entries[unused(name, made._entries, counts)] = _entry_of(address, family, id)
        return made

    def __repr__(self) -> str:
        counts = [self._count(family) for family in CLASSES]
        state = "frozen" if self.frozen else "not frozen"
        return "<mechanism: {} bodies, {} joints, {} forces, {} inputs, {}>".format(*counts, state)

    def _repr_html_(self) -> str:
        """Show a drawing and a table of the elements in notebooks."""
        rows = [(one.name, one.kind.name if one.kind else one.family) for one in self]
        table = _html.table(repr(self)[1:-1], ("name", "kind"), rows)
        drawing = str(self.draw())
        return drawing + table if "<title>" in drawing else table  # no title: nothing to draw

    def _count(self, family: str) -> int:
        return sum(
            entry.family == family and entry is not GROUND for entry in self._entries.values()
        )

    # ---- finding and changing --------------------------------------------------------------------

    def __getitem__(self, name: str) -> Any:
        """Return the Body, Joint, Force or Input of that name. Raises KeyError if there is
        none."""
        return self._handle(name, list(CLASSES))

    def _ipython_key_completions_(self) -> list[str]:
        return list(self._entries)

    def _handle(self, name: str, families: Sequence[str]) -> Element:
        """Return the handle of an element of one of these families. As long as a reference to the
        handle exists, this is always the same object."""
        entry = self._entries.get(name)
        if entry is None:
            known = [known for known, entry in self._entries.items() if entry.family in families]
            if families == ["input"] and not known:
                raise KeyError(f"no input {name!r}: the mechanism has no inputs; {ADD_INPUT}")
            what = families[0] + " " if len(families) == 1 else ""
            raise KeyError(f"no {what}{name!r} in this mechanism; {there_are(known, name)}")
        handle = self._handles.get(name)
        if handle is None:
            handle = self._handles[name] = CLASSES[entry.family](self, name, entry)
        return handle

    def __contains__(self, name: object) -> bool:
        return name in self._entries

    def __iter__(self) -> Iterator[Any]:
        """Return the handles of all added elements, in the order in which they were added."""
        return (self[name] for name, entry in self._entries.items() if entry is not GROUND)

    @property
    def ground(self) -> Body:
        """The body that does not move."""
        found: Body = self["ground"]
        return found

    def find(self, family: str, value: Any) -> Any:
        """Return the element of a family ("body", "joint" or "input") for a handle, a name or an
        id of the library, and None for an id that stands for no element. Raises KeyError or
        TypeError for other values."""
        if isinstance(value, ctypes.Structure):
            return self._of_id(family, value)
        element = self._handle(value, [family]) if isinstance(value, str) else value
        if not isinstance(element, Element) or element.family != family:
            is_other = isinstance(value, str) and isinstance(element, Element)
            other = f", {one(element.family)}" if is_other else ""
            raise TypeError(f"{one(family)} or its name is wanted, not {value!r}{other}")
        return element

    def _of_id(self, family: str, id: Any) -> Any:
        for name, entry in self._entries.items():
            if entry.family == family and entry.id.index1 == id.index1:
                return self[name]
        return None

    def read(self, element: Element) -> ctypes.Structure:
        """Read the definition of an element from the library."""
        if element.kind is None:
            raise TypeError("ground has no definition")
        struct = element.kind.struct()
        _calls.make(
            element.kind.function("get"),
            self.handle,
            element.id,
            ctypes.byref(struct),
            ctypes.sizeof(struct),
        )
        return struct

    def kept_objects(self) -> Iterator[tuple[int, tuple[Any, tuple[int, ...]]]]:
        """Return the functions and `user` objects of all definitions, each with its address. For
        each function, also return the indices of the inputs whose values it receives."""
        for kept in self._keep:
            wrapped, value, inputs = kept if isinstance(kept, tuple) else (kept, kept, ())
            try:
                address = ctypes.cast(wrapped, ctypes.c_void_p).value
            except ctypes.ArgumentError:
                continue  # an array
            if address:
                yield address, (value, inputs)

    def change(self, element: Element, fields: Mapping[str, Any]) -> None:
        """Replace some fields of a definition, before freezing. Fields that are None do not
        change."""
        if not isinstance(fields, dict):
            raise TypeError(f'{element.family} "{element.name}": a dict is wanted, not {fields!r}')
        if "name" in fields:
            raise TypeError(f'{element.family} "{element.name}": names cannot change')
        if element.family == "input":
            self._change_input(element, fields)
            return
        struct, label = self.read(element), f'{element.family} "{element.name}"'
        assert element.kind is not None  # read() refuses ground
        definition = Definition(element.kind, label, self.find, struct)
        definition.fill(fields)
        self._hold(definition)
        self._owner.call(element.kind.function("set"), element.id, ctypes.byref(definition.struct))

    def _change_input(self, element: Element, fields: Mapping[str, Any]) -> None:
        label = f'input "{element.name}"'
        unknown = [name for name in fields if name != "initial"]
        if unknown:
            known = there_are(("name", "initial"), unknown[0])
            raise TypeError(f"{label} has no {unknown[0]}; {known}")
        if fields.get("initial") is not None:
            initial = number(fields["initial"], f"{label}: initial")
            self._owner.call(lib.baum_mechanism_set_input, element.id, initial)

    def initial(self, input: InputLike) -> float:
        """Return the initial value of an input."""
        value = ctypes.c_double()
        _calls.make(
            lib.baum_mechanism_get_input,
            self.handle,
            self.find("input", input).id,
            ctypes.byref(value),
        )
        return value.value

    @property
    def inputs(self) -> list[Input]:
        """All inputs, in the order in which they were added."""
        return [self[name] for name, entry in self._entries.items() if entry.family == "input"]

    # ---- properties of the whole mechanism -------------------------------------------------------

    @property
    def gravity(self) -> tuple[float, float, float]:
        """Gravity (x, y, z) [m/s^2], which acts on particles and rigid bodies. Before freezing, you
        can set it to (x, y, z) or (x, y)."""
        values = np.empty(3)
        _calls.make(lib.baum_mechanism_get_gravity, self.handle, values.ctypes.data)
        x, y, z = values.tolist()
        return x, y, z

    @gravity.setter
    def gravity(self, value: ArrayLike) -> None:
        _calls.make(lib.baum_mechanism_set_gravity, self.handle, *point(value, "gravity"))

    @property
    def characteristic_length(self) -> float:
        """The length [m] to which tolerances are relative. You can set it before freezing. If you
        do not, it is NaN until the mechanism is frozen."""
        value = ctypes.c_double()
        _calls.make(lib.baum_mechanism_get_characteristic_length, self.handle, ctypes.byref(value))
        return value.value

    @characteristic_length.setter
    def characteristic_length(self, value: Scalar) -> None:
        length = number(value, "characteristic_length")
        _calls.make(lib.baum_mechanism_set_characteristic_length, self.handle, length)

    def add_break_times(self, times: ArrayLike) -> None:
        """Declare times [s] at which functions of time jump. Steps then end at these times. Call
        this before freezing."""
        given = vector(np.atleast_1d(times), None, "break times")
        self._owner.call(lib.baum_mechanism_add_break_times, given.ctypes.data, len(given))

    @property
    def break_times(self) -> Array:
        """A copy of the break times (n) in rising order [s]. It is read-only."""
        count = ctypes.c_int32()
        place = lib.baum_mechanism_break_times(self.handle, ctypes.byref(count))
        found = numbers(place, count.value)
        found = np.empty(0) if found is None else found
        found.flags.writeable = False
        return found

    def freeze(self) -> Mechanism:
        """Check all definitions, and make the mechanism constant, so that it can be simulated.

        Returns the mechanism. Raises baum.Error if the mechanism cannot be simulated, for example
        if it has no body.
        """
        self._long(lib.baum_mechanism_freeze)
        return self

    @property
    def frozen(self) -> bool:
        """Whether freeze() has made the mechanism constant."""
        return bool(lib.baum_mechanism_is_frozen(self.handle))

    def copy(self, **changes: Mapping[str, Any]) -> Mechanism:
        """Copy the mechanism, with changes of some definitions: m.copy(rod=dict(mass=0.04)) changes
        one mass.

        The copy is frozen if this mechanism is frozen. A handle of one of the two mechanisms
        is also valid in the other one, until elements are added to one of the two.

        If you change the position, angle or orientation of a body, the copy has another design
        configuration, but is otherwise the same mechanism. Joints and forces keep their points and
        axes on the bodies. They also keep the lengths, angles and offsets that they took from the
        design configuration of this mechanism. The definitions of the copy contain all these values
        as numbers. In the new design configuration the joints may be open. Assembly then closes
        them, and may move the body that you changed. To avoid this, give a position and an angle at
        which the joints are closed, or held=True.

        If you also change the `point`, `point_a` or `point_b` of a joint or a force, this element
        is placed in the new design configuration. Angles of spatial joints are 0 in the new design
        configuration. Therefore some changes raise ValueError: those that alter an angle of a
        spatial joint if a driver, a coupling or a spring uses this angle, and those that alter the
        relative orientation of the bodies of a spatial weld or prismatic joint.
        """
        copy = self.thawed(**changes)
        return copy.freeze() if self.frozen else copy

    def thawed(self, **changes: Mapping[str, Any]) -> Mechanism:
        """Copy the mechanism like copy(). The copy is not frozen, so you can add elements to
        it."""
        out = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_copy, self.handle, ctypes.byref(out))
        copy = Mechanism.__new__(Mechanism)
        copy._adopt(out.value, self)
        for name, fields in [*self._kept_when_moved(changes), *changes.items()]:
            copy.change(copy[name], fields)
        return copy

    def _kept_when_moved(
        self, changes: Mapping[str, Any]
    ) -> Iterator[tuple[str, Mapping[str, Any]]]:
        """For each joint and each force, return its name and the numbers that it takes from the
        present design configuration. The element must keep these numbers when bodies are moved."""
        given = {name: set(fields) for name, fields in changes.items() if isinstance(fields, dict)}
        moved = {name for name in given if self[name].family == "body"}
        moved = {name for name in moved if given[name] & {"position", "angle", "orientation"}}
        angles = list(self._used_angles()) if moved else []
        for element in self if moved else ():
            new_place = given.get(element.name, set()) & {"point", "point_a", "point_b"}
            if element.family in ("joint", "force") and not new_place:
                design_space.check_turned(element, angles, changes)
                taken = design.taken(element, moved)
                if getattr(self.read(element), "law", None):  # the law replaces these numbers
                    taken = {key: x for key, x in taken.items() if not REPLACED.fullmatch(key)}
                yield element.name, taken

    def _used_angles(self) -> Iterator[Joint]:
        """Return the joints whose angles are used by drivers, couplings or springs. The effort of a
        joint load does not depend on the angle."""
        for element in self:
            uses = element.family in ("joint", "force") and element.kind.name != "joint_load"
            values = element.definition if uses else {}
            for end in ("", "_a", "_b"):
                joint = values.get(f"joint{end}")
                if joint and joint.kind.coordinate(values[f"coordinate{end}"]).startswith("angle"):
                    yield joint

    @property
    def is_quick(self) -> bool:
        """Whether calls that only evaluate this mechanism, such as the start of a run, take at most
        a few ms and call no Python function."""
        return len(self._entries) < MANY and not self.has_python

    @property
    def sizes(self) -> Sizes:
        """The numbers of positions (nq), velocities (nv) and constraint rows (nc) of a frozen
        mechanism."""
        if self._sizes is None:
            counts = [ctypes.c_int32() for _ in range(3)]
            _calls.make(lib.baum_mechanism_sizes, self.handle, *map(ctypes.byref, counts))
            self._sizes = Sizes(*(count.value for count in counts))
        return self._sizes

    def rows(self, joint: JointLike) -> slice:
        """Return the slice of Phi and lambda that belongs to a joint of a frozen mechanism."""
        first, count = ctypes.c_int32(), ctypes.c_int32()
        _calls.make(
            lib.baum_mechanism_rows,
            self.handle,
            self.find("joint", joint).id,
            ctypes.byref(first),
            ctypes.byref(count),
        )
        return slice(first.value, first.value + count.value)

    def columns(self, body: BodyLike) -> tuple[slice, slice]:
        """Return the slices of q and v that belong to a body of a frozen mechanism."""
        found = self.find("body", body)
        q, v = ctypes.c_int32(), ctypes.c_int32()
        _calls.make(
            lib.baum_mechanism_columns, self.handle, found.id, ctypes.byref(q), ctypes.byref(v)
        )
        return slice(q.value, q.value + found.nq), slice(v.value, v.value + found.nv)

    def mobility(self) -> Mobility:
        """Count degrees of freedom, redundant rows, conflicting rows, and bodies without a joint,
        in the assembled initial configuration. str() of the result explains it."""
        values = self._snapshot(lib.baum_mechanism_mobility, _abi.baum_mobility())
        values["worst_joint"] = self.find("joint", values["worst_joint"])
        return Mobility(**values)

    def report(self) -> Report:
        """Report what an evaluation of the accelerations costs, and which work it skips because the
        mechanism does not need it. str() of the result explains it."""
        values = self._snapshot(lib.baum_mechanism_report, _abi.baum_report())
        values["most_joined"] = self.find("body", values["most_joined"])
        return Report(**values)

    def _snapshot(self, function: Any, struct: Any) -> dict[str, Any]:
        """Return the fields of a struct that a function of the library fills."""
        self._long(function, ctypes.byref(struct), ctypes.sizeof(struct))
        values = {field[0]: getattr(struct, field[0]) for field in struct._fields_[1:]}
        values["text"] = text(struct.text)
        return values

    def check_derivatives(self) -> None:
        """Check the derivatives that your functions return, by finite differences. Raises
        baum.Error if a derivative is wrong; the message names this derivative."""
        self._long(lib.baum_mechanism_check_derivatives)

    def _long(self, function: Any, *arguments: Any) -> None:
        if self.is_quick:
            _calls.make(function, self.handle, *arguments)
        else:
            _calls.interruptible(_calls.make, function, self.handle, *arguments)

    def channel(self, value: ChannelLike) -> Channel:
        """Return the channel of the given name, such as "energy" or "B.phi". Raises KeyError if
        there is no such channel. If the value is a Channel already, return it unchanged."""
        if isinstance(value, Channel):
            return value
        if not isinstance(value, str):
            known = self._channels(value) if isinstance(value, Element) else []
            more = f"; it has {', '.join(known)}" if known else ""
            raise TypeError(f"a channel or its name is wanted, not {value!r}{more}")
        if value in WHOLE:
            return WHOLE[value]
        name, _, attribute = value.rpartition(".")
        if not name and value not in self:
            raise KeyError(
                f"no channel {value!r}; those of bodies and joints are written like 'B.phi', and "
                f"of the whole mechanism {there_are(WHOLE, value)}"
            )
        name = name or value  # the value is the name of an element alone
        element = self[name]
        channels = self._channels(element)
        if attribute not in channels:
            kind = element.kind.name if element.kind else element.family
            others = there_are(channels, attribute) if channels else "there are none"
            raise KeyError(f"no channel {value!r} of {name!r}, which is a {kind}; {others}")
        channel: Channel = getattr(element, attribute)
        return channel

    def _channels(self, element: Element) -> list[str]:
        """Return the names of the channels of an element. Whether a joint has a coordinate is known
        only after freezing."""
        found = []
        for name, p in inspect.getmembers(type(element), lambda p: isinstance(p, property)):
            is_channel = p.fget.__annotations__.get("return") == "Channel"
            if is_channel and (not self.frozen or has(self, getattr(element, name))):
                found.append(name)
        return found

    def draw(self, q: ArrayLike | Literal["assembled"] | None = None) -> Drawing:
        """Draw the mechanism.

        q: None for the design configuration, "assembled" for the assembled
            configuration at t = 0, or positions q (nq) of a frozen mechanism [m], [rad].

        A notebook shows the returned picture. The method save("x.svg") of the picture writes it to
        a file. The suffixes .pdf and .png need Matplotlib.

        Red lines show where the constraints of a joint are violated. A red line connects two points
        that should coincide, a point with the line, plane or curve on which it should be, or the
        tips of two axes that should be parallel. If the mechanism cannot be assembled, "assembled"
        shows the configuration in which assembly stopped.
        """
        return drawings.draw(self, q)

    def page(
        self,
        t: ArrayLike,
        q: ArrayLike,
        path: str | os.PathLike[str] | None = None,
        *,
        title: str | None = None,
        traces: Sequence[TraceLike] = (),
        plots: Mapping[str, ArrayLike] = types.MappingProxyType({}),
        marks: Sequence[tuple[Scalar, str]] = (),
    ) -> Page:
        """Make an HTML page that shows any motion of a frozen mechanism, for example a motion that
        was computed elsewhere, or several runs joined together. To show one run, use Run.page().

        t: times (n) [s], rising or falling.
        q: positions (n x nq). The page shows them unchanged, including their constraint violations.
        path: file to write. None writes no file; the returned page has a method save().
        traces: paths to draw, as in Run.page().
        plots: curves, as a dict from a label to n values, such as {"height [m]": q[:, 1]}.
            Consecutive curves whose labels end with the same unit are drawn in the same plot.
        marks: marks on the time axis, each as a pair (time [s], text).
        """
        motion = _motion.of_arrays(self, t, q, title, traces, plots, marks)
        made = drawings.page(motion)
        if path is not None:
            made.save(path)
        return made

    # ---- runs ------------------------------------------------------------------------------------

    @takes_options
    def simulation(
        self, integrator: str | Integrator | None = None, **options: Unpack[SimulationOptions]
    ) -> Simulation:
        """Start a run that you advance step by step. baum.Simulation describes the options."""
        return Simulation(self, integrator, **options)

    @takes_options
    def simulate(
        self,
        times: ArrayLike,
        integrator: str | Integrator | None = None,
        *,
        record: ChannelLike | Sequence[ChannelLike] = (),
        **options: Unpack[SimulationOptions],
    ) -> Run:
        """Run through times (n) [s]. Return a Run with q, v and the channels in `record` at each
        time. A channel is a quantity such as "energy" or "slider.velocity".

        The run starts at the time that the option start_time gives. baum.Simulation describes the
        options and the errors. Exceptions that this method raises have the attribute `run` with the
        samples recorded so far.
        """
        return Simulation(self, integrator, **options).sample(times, record)

    @takes_options
    def export_fmu(
        self,
        path: str | os.PathLike[str],
        integrator: str | Integrator | None = None,
        *,
        outputs: ChannelLike | Sequence[ChannelLike],
        inputs: InputLike | Sequence[InputLike] | None = None,
        parameters: str | Sequence[str] = (),
        **options: Unpack[SimulationOptions],
    ) -> None:
        """Write the mechanism as an FMU for co-simulation according to FMI 3.0. No compiler is
        needed.

        outputs: one channel or several channels, such as "slider.pose"; each of their columns is an
            output of the FMU.
        inputs: inputs of the mechanism that become inputs of the FMU, by default all.
        parameters: numbers that users of the FMU can change, written as "element.field", such as
            "rod.mass". They may also be positions and velocities of bodies at the start.
        integrator, options: as for simulation(), without progress, row_gains, max_steps and
            start_time. If the FMU is part of a control loop, choose a fixed step.

        Raises ValueError if the mechanism contains functions of yours, which an FMU cannot contain.
        """
        fmu.export(self, path, integrator, outputs, inputs, parameters, options)


# Python's own messages, for example about a misspelt keyword, shall name the public class.
for _methods in (Adding, AddingInSpace, Scenes):
    for _method in filter(inspect.isfunction, vars(_methods).values()):
        _method.__qualname__ = f"Mechanism.{_method.__name__}"
