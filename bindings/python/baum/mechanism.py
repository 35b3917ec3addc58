# SPDX-License-Identifier: BSD-3-Clause
"""What is simulated: bodies, joints, forces and inputs."""

import ctypes
import weakref
from collections import namedtuple

import numpy as np

from . import _abi, _calls, design
from .adding import Adding
from .channels import WHOLE, Channel
from .definitions import KINDS, Definition, sizes
from .elements import CLASSES, GROUND, Element, Entry, one
from ._lib import lib
from ._values import number, numbers, vector

LISTED = 30  # names in a message

Sizes = namedtuple("Sizes", "nq nv nc")
Sizes.__doc__ = "Numbers of positions, velocities and constraint rows."


class Mobility(namedtuple("Mobility", [name for name, _ in _abi.baum_mobility._fields_[1:]])):
    """What a mechanism can do at its assembled start pose. str() says it in messages, by name."""

    __slots__ = ()

    def __str__(self):
        return self.text


class Report(namedtuple("Report", [name for name, _ in _abi.baum_report._fields_[1:]])):
    """What an evaluation of the accelerations costs in a run, and which work it skips. str() says it
    in lines, by name, with the reasons."""

    __slots__ = ()

    def __str__(self):
        return self.text


def _entry_of(address, family, id):
    """What there is to know about an element: the library gives the definition to those alone that
    ask for its kind."""
    if family == "input":
        return Entry(family, None, id, 0, 0)
    for kind in KINDS.values():
        if kind.family == family:
            struct = kind.struct()
            asked = kind.function("get")
            if asked(address, id, ctypes.byref(struct), ctypes.sizeof(struct)) == 0:
                return Entry(family, kind, id, *sizes(kind, struct))
    raise TypeError(f"{one(family)} of a kind that this package does not know")


class Mechanism(Adding):
    """Bodies, joints, forces and inputs: added, then frozen, then constant and shared between
    threads.

    gravity: (x, y) or (x, y, z) [m/s^2], default (0, -9.81); characteristic_length: length [m]
    that tolerances refer to, default the size of the design configuration. Any consistent set of
    units will do; angles are in radians.

    Points: a joint is placed by `point` (ground axes, design configuration) or by `point_a`
    and `point_b` (body axes). Bodies and joints may be given as handles or by name. Fields left out keep the
    library's defaults. Functions are called with (t, q) or (t, q, v) of the named bodies and return
    their value; see callbacks.py.
    """

    def __init__(self, gravity=None, characteristic_length=None):
        out = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_create, ctypes.byref(out))
        self._adopt(out.value)
        if gravity is not None:
            self.gravity = gravity
        if characteristic_length is not None:
            self.characteristic_length = characteristic_length

    def _adopt(self, address, like=None):
        """Become the owner of a mechanism of the library, with the elements of another one."""
        self._owner = _calls.Handle(address, lib.baum_mechanism_destroy, "mechanism")
        self.handle = address
        self.has_python = like is not None and like.has_python
        self._keep = [] if like is None else list(like._keep)
        self._entries = {"ground": GROUND} if like is None else dict(like._entries)
        self._handles = weakref.WeakValueDictionary()

    @classmethod
    def of_library(cls, address):
        """The owner of a mechanism that a function of the library has put together."""
        made = cls.__new__(cls)
        made._adopt(address)
        for family in CLASSES:
            count = getattr(lib, f"baum_mechanism_{family}_count")(address)
            for k in range(count):
                id = getattr(lib, f"baum_mechanism_{family}_at")(address, k)
                name = getattr(lib, f"baum_mechanism_{family}_name")(address, id).decode()
                made._entries[name] = _entry_of(address, family, id)
        return made

    def __repr__(self):
        counts = [self._count(family) for family in CLASSES]
        state = "frozen" if self.frozen else "not frozen"
        return "<mechanism: {} bodies, {} joints, {} forces, {} inputs, {}>".format(*counts, state)

    def _count(self, family):
        return sum(
            entry.family == family and entry is not GROUND for entry in self._entries.values()
        )

    # ---- finding and changing --------------------------------------------------------------------

    def __getitem__(self, name):
        """The body, joint, force or input of that name."""
        return self._handle(name, CLASSES)

    def _handle(self, name, families):
        """The handle of an element of one of these families. As long as somebody keeps it, it is the
        same one."""
        entry = self._entries.get(name)
        if entry is None:
            known = [known for known, entry in self._entries.items() if entry.family in families]
            more = f" and {len(known) - LISTED} more" if len(known) > LISTED else ""
            what = families[0] + " " if len(families) == 1 else ""
            raise KeyError(
                f"no {what}{name!r} in this mechanism; there are: {', '.join(known[:LISTED])}{more}"
            )
        handle = self._handles.get(name)
        if handle is None:
            handle = self._handles[name] = CLASSES[entry.family](self, name, entry)
        return handle

    def __contains__(self, name):
        return name in self._entries

    def __iter__(self):
        """Handles of everything that was added."""
        return (self[name] for name, entry in self._entries.items() if entry is not GROUND)

    @property
    def ground(self):
        """The body that does not move."""
        return self["ground"]

    def find(self, family, value):
        """The body, joint or input for a handle, a name or an id of the library; None for the id
        "none"."""
        if isinstance(value, ctypes.Structure):
            return self._of_id(family, value)
        element = self._handle(value, [family]) if isinstance(value, str) else value
        if not isinstance(element, Element) or element.family != family:
            raise TypeError(f"{one(family)} or its name is wanted, not {value!r}")
        return element

    def _of_id(self, family, id):
        for name, entry in self._entries.items():
            if entry.family == family and entry.id.index1 == id.index1:
                return self[name]
        return None

    def read(self, element):
        """The library's definition of an element."""
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

    def change(self, element, fields):
        """Replace some fields of a definition, before freezing. None changes nothing."""
        if not isinstance(fields, dict):
            raise TypeError(f'{element.family} "{element.name}": a dict is wanted, not {fields!r}')
        if "name" in fields:
            raise TypeError(f'{element.family} "{element.name}": names stay')
        if element.family == "input":
            self._change_input(element, fields)
            return
        definition = Definition(
            element.kind, f'{element.family} "{element.name}"', self.find, self.read(element)
        )
        definition.fill(fields)
        self._hold(definition)
        self._owner.call(element.kind.function("set"), element.id, ctypes.byref(definition.struct))

    def _change_input(self, element, fields):
        label = f'input "{element.name}"'
        unknown = [name for name in fields if name != "initial"]
        if unknown:
            raise TypeError(f"{label} has no {unknown[0]}; there are: name, initial")
        if fields.get("initial") is not None:
            initial = number(fields["initial"], f"{label}: initial")
            self._owner.call(lib.baum_mechanism_set_input, element.id, initial)

    def initial(self, input):
        """Initial value of an input."""
        value = ctypes.c_double()
        _calls.make(
            lib.baum_mechanism_get_input,
            self.handle,
            self.find("input", input).id,
            ctypes.byref(value),
        )
        return value.value

    @property
    def inputs(self):
        """All inputs, in the order of adding."""
        return [self[name] for name, entry in self._entries.items() if entry.family == "input"]

    # ---- the whole -------------------------------------------------------------------------------

    @property
    def gravity(self):
        """(x, y, z) [m/s^2], of particles and rigid bodies."""
        values = np.empty(3)
        _calls.make(lib.baum_mechanism_get_gravity, self.handle, values.ctypes.data)
        return tuple(values.tolist())

    @gravity.setter
    def gravity(self, value):
        given = vector(value, None, "gravity").tolist()
        if len(given) not in (2, 3):
            raise ValueError(f"gravity: 2 or 3 numbers are wanted, not {len(given)}")
        _calls.make(lib.baum_mechanism_set_gravity, self.handle, *(given + [0.0])[:3])

    @property
    def characteristic_length(self):
        """Characteristic length [m]; NaN when it was not set and the mechanism is not frozen."""
        value = ctypes.c_double()
        _calls.make(lib.baum_mechanism_get_characteristic_length, self.handle, ctypes.byref(value))
        return value.value

    @characteristic_length.setter
    def characteristic_length(self, value):
        _calls.make(
            lib.baum_mechanism_set_characteristic_length, self.handle, number(value, "characteristic_length")
        )

    def add_break_times(self, times):
        """Declare times [s] at which functions of time jump: no step passes one. Before freezing."""
        times = vector(np.atleast_1d(times), None, "break times")
        self._owner.call(lib.baum_mechanism_add_break_times, times.ctypes.data, len(times))

    @property
    def break_times(self):
        """The break times [s], rising."""
        count = ctypes.c_int32()
        place = lib.baum_mechanism_break_times(self.handle, ctypes.byref(count))
        return np.empty(0) if place is None else numbers(place, count.value)

    def freeze(self):
        """Check everything and make the mechanism constant. Returns it."""
        self._long(lib.baum_mechanism_freeze)
        return self

    @property
    def frozen(self):
        """Whether it is constant."""
        return lib.baum_mechanism_is_frozen(self.handle)

    def copy(self, **changes):
        """A copy with some definitions changed, for example m.copy(rod=dict(mass=0.04)). It is
        frozen when this one is. Handles of one are good for the other as long as nothing is
        added.

        With another position or angle of a body the copy is the same mechanism in another initial
        configuration: joints and forces keep their points in body axes, and the lengths, angles and
        offsets that they took from the design configuration. Their definitions in the copy have the
        numbers. Assembly closes the joints, which may move the changed body too: give position and
        angle that fit, or held=True. A joint or force that is itself changed in `point`, `point_a`
        or `point_b` is placed in the new design configuration."""
        copy = self.thawed(**changes)
        return copy.freeze() if self.frozen else copy

    def thawed(self, **changes):
        """As copy(), but not frozen, so that something can be added."""
        out = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_copy, self.handle, ctypes.byref(out))
        copy = Mechanism.__new__(Mechanism)
        copy._adopt(out.value, self)
        for name, fields in [*self._kept_when_moved(changes), *changes.items()]:
            copy.change(copy[name], fields)
        return copy

    def _kept_when_moved(self, changes):
        """What joints and forces must be given so that bodies of other positions do not alter them."""
        given = {name: set(fields) for name, fields in changes.items() if isinstance(fields, dict)}
        moved = {name for name in given if self[name].family == "body"}
        moved = {name for name in moved if given[name] & {"position", "angle"}}
        for element in self if moved else ():
            placed_anew = given.get(element.name, set()) & {"point", "point_a", "point_b"}
            if element.family in ("joint", "force") and not placed_anew:
                yield element.name, design.taken(element, moved)

    @property
    def sizes(self):
        """Numbers nq, nv, nc of a frozen mechanism."""
        counts = [ctypes.c_int32() for _ in range(3)]
        _calls.make(lib.baum_mechanism_sizes, self.handle, *map(ctypes.byref, counts))
        return Sizes(*(count.value for count in counts))

    def rows(self, joint):
        """Rows of a joint in Phi and lambda of a frozen mechanism, a slice."""
        first, count = ctypes.c_int32(), ctypes.c_int32()
        _calls.make(
            lib.baum_mechanism_rows,
            self.handle,
            self.find("joint", joint).id,
            ctypes.byref(first),
            ctypes.byref(count),
        )
        return slice(first.value, first.value + count.value)

    def columns(self, body):
        """Places of a body in q and v of a frozen mechanism, two slices."""
        body = self.find("body", body)
        q, v = ctypes.c_int32(), ctypes.c_int32()
        _calls.make(
            lib.baum_mechanism_columns, self.handle, body.id, ctypes.byref(q), ctypes.byref(v)
        )
        return slice(q.value, q.value + body.nq), slice(v.value, v.value + body.nv)

    def mobility(self):
        """Freedoms, redundant and conflicting rows, bodies without a joint, at the assembled start
        pose."""
        values = self._survey(lib.baum_mechanism_mobility, _abi.baum_mobility())
        values["worst_joint"] = self.find("joint", values["worst_joint"])
        return Mobility(**values)

    def report(self):
        """What an evaluation of the accelerations costs: nodes, couplings and islands; and what it
        does not compute, such as bodies that cannot move."""
        values = self._survey(lib.baum_mechanism_report, _abi.baum_report())
        values["most_joined"] = self.find("body", values["most_joined"])
        return Report(**values)

    def _survey(self, function, struct):
        """The fields of a struct that a function of the library fills."""
        self._long(function, ctypes.byref(struct), ctypes.sizeof(struct))
        values = {name: getattr(struct, name) for name, _ in struct._fields_[1:]}
        values["text"] = struct.text.decode(errors="replace")
        return values

    def check_derivatives(self):
        """Compare the derivatives that functions give with differences; baum.Error names the wrong
        entry."""
        self._long(lib.baum_mechanism_check_derivatives)

    def _long(self, function, *arguments):
        _calls.interruptible(_calls.make, function, self.handle, *arguments)

    def channel(self, value):
        """The channel for a channel or its name, such as "energy" or "B.phi"."""
        if isinstance(value, Channel):
            return value
        if not isinstance(value, str):
            raise TypeError(f"a channel or its name is wanted, not {value!r}")
        if value in WHOLE:
            return WHOLE[value]
        name, _, attribute = value.rpartition(".")
        channel = getattr(self[name], attribute, None) if name else None
        if not isinstance(channel, Channel):
            raise KeyError(
                f"no channel {value!r}; there are {', '.join(WHOLE)} and those of bodies "
                'and joints, such as "B.phi"'
            )
        return channel

    # ---- runs ------------------------------------------------------------------------------------

    def simulation(self, integrator=None, **options):
        """Start a run that goes step by step; see Simulation for the options."""
        from .simulation import Simulation

        return Simulation(self, integrator, **options)

    def simulate(self, times, integrator=None, *, record=(), **options):
        """Run through `times` [s] and return a Run: q, v and the channels in `record`, at each of
        them. The run begins at the option start_time, 0 when left out. See Simulation for the
        options."""
        from .simulation import Simulation

        return Simulation(self, integrator, **options).sample(times, record)
