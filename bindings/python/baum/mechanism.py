# SPDX-License-Identifier: BSD-3-Clause
"""What is simulated: bodies, joints and forces."""
import ctypes
from collections import namedtuple

import numpy as np

from . import _abi, _calls
from .channels import WHOLE, Channel
from .definitions import KINDS, Definition
from .elements import CLASSES, GROUND, Element, Entry
from ._lib import lib
from ._values import number

Sizes = namedtuple("Sizes", "nq nv nc")
Sizes.__doc__ = "Numbers of positions, velocities and constraint rows."


class Mobility(namedtuple("Mobility", [name for name, _ in _abi.baum_mobility._fields_[1:]])):
    """What a mechanism can do at its assembled start pose. str() says it in sentences, by name."""

    __slots__ = ()

    def __str__(self):
        return self.text


class Mechanism:
    """Bodies, joints and forces: added, then frozen, then constant and shared between threads.

    gravity: (x, y) or (x, y, z) [m/s^2], default (0, -9.81); scale: length [m] that tolerances refer to, default
    the size of the drawing. Any consistent set of units will do; angles are in radians.

    Points: a joint is placed by `point` (ground axes, drawn pose) or by `point_a` and `point_b` (body axes).
    Bodies and joints may be given as handles or by name. Fields left out keep the library's defaults.
    Functions are called with (t, q) or (t, q, v) of the named bodies and return their value; see callbacks.py.
    """

    def __init__(self, gravity=None, scale=None):
        out = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_create, ctypes.byref(out))
        self._adopt(out.value)
        if gravity is not None:
            self.gravity = gravity
        if scale is not None:
            self.scale = scale

    def _adopt(self, address, like=None):
        """Become the owner of a mechanism of the library, with the elements of another one."""
        self._owner = _calls.Handle(address, lib.baum_mechanism_destroy, "mechanism")
        self.handle = address
        self.has_python = like is not None and like.has_python
        self._keep = [] if like is None else list(like._keep)
        self._entries = {"ground": GROUND} if like is None else dict(like._entries)

    def __repr__(self):
        counts = [self._count(family) for family in CLASSES]
        state = "frozen" if self.frozen else "not frozen"
        return "<mechanism: {} bodies, {} joints, {} forces, {}>".format(*counts, state)

    def _count(self, family):
        return sum(entry.family == family and entry is not GROUND for entry in self._entries.values())

    # ---- bodies -------------------------------------------------------------------------------------

    def planar_body(self, name=None, *, mass=None, inertia=None, position=None, angle=None,
                    velocity=None, angular_velocity=None, held=None):
        """Add a rigid body in the plane: mass [kg], inertia [kg m^2] about the centre of mass, drawn position
        [m] and angle [rad], velocities at start [m/s], [rad/s] (free when left out), held: assembly keeps the
        drawn pose."""
        return self._add("planar_body", name, mass=mass, inertia=inertia, position=position, angle=angle,
                         velocity=velocity, angular_velocity=angular_velocity, held=held)

    def planar_particle(self, name=None, *, mass=None, position=None, velocity=None, held=None):
        """Add a point mass [kg] at a drawn position [m], with a velocity at start [m/s]."""
        return self._add("planar_particle", name, mass=mass, position=position, velocity=velocity,
                         held=held)

    def coordinates(self, name=None, size=None, *, mass=None, force=None, q=None, v=None, scale=None,
                    force_q=None, force_v=None, potential=None, constant_mass=None, held=None,
                    user=None):
        """Add `size` generalized coordinates: mass(t, q) gives M (size x size), force(t, q, v) the force vector g
        (size), force_q and force_v its derivatives (size x size), potential(t, q) an energy [J]. q, v, scale:
        (size) drawn positions, velocities at start, a relevant change of each."""
        return self._add("coordinates", name, size=size, mass=mass, force=force, q=q, v=v, scale=scale,
                         force_q=force_q, force_v=force_v, potential=potential,
                         constant_mass=constant_mass, held=held, user=user)

    # ---- joints -------------------------------------------------------------------------------------

    def revolute(self, name, body_a, body_b, *, point=None, point_a=None, point_b=None):
        """Add a pin: two points coincide. Two rows [m]."""
        return self._add("planar_revolute", name, body_a=body_a, body_b=body_b, point=point,
                         point_a=point_a, point_b=point_b)

    def translational(self, name, body_a, body_b, *, axis=None, point=None, point_a=None, point_b=None,
                      angle=None):
        """Add a slider: body_b moves along an axis of body_a without turning. Two rows [m], [rad].
        angle: angle_b - angle_a that is kept [rad], default that of the drawing."""
        return self._add("planar_translational", name, body_a=body_a, body_b=body_b, axis=axis,
                         point=point, point_a=point_a, point_b=point_b, angle=angle)

    def distance(self, name, body_a, body_b, *, point_a=None, point_b=None, length=None):
        """Add a rod without mass between two points. One row [m]. length [m], default that of the drawing."""
        return self._add("planar_distance", name, body_a=body_a, body_b=body_b, point_a=point_a,
                         point_b=point_b, length=length)

    def fixed(self, name, body_a, body_b, *, point=None, point_a=None, point_b=None, angle=None):
        """Add a weld. Three rows [m], [m], [rad]. angle: angle_b - angle_a [rad], default that of the drawing."""
        return self._add("planar_fixed", name, body_a=body_a, body_b=body_b, point=point,
                         point_a=point_a, point_b=point_b, angle=angle)

    def driver(self, name, joint, *, value=None, rate=None, acceleration=None, law=None, user=None):
        """Prescribe the coordinate of a revolute [rad] or translational [m] joint: value + rate t + acceleration
        t^2 / 2, or law(t) that returns value, rate and acceleration. One row."""
        return self._add("driver", name, joint=joint, value=value, rate=rate,
                         acceleration=acceleration, law=law, user=user)

    def constraint(self, name, bodies, rows, phi, *, jacobian=None, nu=None, gamma=None, user=None):
        """Add constraints Phi(t, q) = 0 over the coordinates of `bodies`: phi(t, q) gives Phi (rows),
        jacobian(t, q) J (rows x nv), nu(t, q) -dPhi/dt (rows), gamma(t, q, v) the right side of J a = gamma
        (rows). Only phi is needed; the others are found by differences."""
        return self._add("user_constraint", name, bodies=bodies, row_count=rows, phi=phi,
                         jacobian=jacobian, nu=nu, gamma=gamma, user=user)

    # ---- forces -------------------------------------------------------------------------------------

    def spring(self, name, body_a, body_b, *, point_a=None, point_b=None, stiffness=None, damping=None,
               free_length=None):
        """Add a spring [N/m] and damper [N s/m] between two points; free_length [m], default that of the
        drawing."""
        return self._add("planar_spring", name, body_a=body_a, body_b=body_b, point_a=point_a,
                         point_b=point_b, stiffness=stiffness, damping=damping,
                         free_length=free_length)

    def load(self, name, body, *, force=None, point=None, torque=None, follows_body=None):
        """Add a force [N] at a point of a body (body axes [m]) and a torque [N m]. follows_body: the force turns
        with the body, else it keeps to ground axes."""
        return self._add("planar_load", name, body=body, force=force, point=point, torque=torque,
                         follows_body=follows_body)

    def force(self, name, bodies, force, *, force_q=None, force_v=None, potential=None, user=None):
        """Add a generalized force on `bodies`: force(t, q, v) gives it (nv), force_q and force_v its derivatives
        (nv x nv), potential(t, q) an energy [J]."""
        return self._add("user_force", name, bodies=bodies, force=force, force_q=force_q,
                         force_v=force_v, potential=potential, user=user)

    # ---- adding, finding, changing --------------------------------------------------------------------

    def _add(self, kind, name, **fields):
        kind = KINDS[kind]
        name = self._new_name(name, kind.family)
        definition = Definition(kind, f'{kind.family} "{name}"', self.find)
        definition.fill({"name": name, **fields})
        id = kind.id_type()
        self._hold(definition)
        self._owner.call(kind.function("add"), ctypes.byref(definition.struct), ctypes.byref(id))
        size = kind.nq or getattr(definition.struct, "size", 0)
        self._entries[name] = Entry(kind.family, kind, id, size, kind.nv or size)
        return self[name]

    def _new_name(self, name, family):
        if name is None:
            name = f"{family}{1 + self._count(family)}"
        if not isinstance(name, str):
            raise TypeError(f"the name of a {family} is a string, not {name!r}")
        if name in self._entries:
            raise ValueError(f'there is already a {self._entries[name].family} "{name}"')
        return name

    def _hold(self, definition):
        """Keep a definition's functions as long as this mechanism and its copies."""
        self._keep.extend(definition.keep)
        self.has_python |= definition.has_python

    def __getitem__(self, name):
        """The body, joint or force of that name."""
        try:
            entry = self._entries[name]
        except KeyError:
            raise KeyError(f"no {name!r} in this mechanism; there are: "
                           + ", ".join(self._entries)) from None
        return CLASSES[entry.family](self, name, entry)

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
        """The body or joint for a handle, a name or an id of the library; None for the id "none"."""
        if isinstance(value, ctypes.Structure):
            return self._of_id(family, value)
        element = self[value] if isinstance(value, str) else value
        if not isinstance(element, Element) or element.family != family:
            raise TypeError(f"a {family} or its name is wanted, not {value!r}")
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
        _calls.make(element.kind.function("get"), self.handle, element.id, ctypes.byref(struct),
                    ctypes.sizeof(struct))
        return struct

    def change(self, element, fields):
        """Replace some fields of a definition, before freezing. None changes nothing."""
        if "name" in fields:
            raise TypeError(f'{element.family} "{element.name}": names stay')
        definition = Definition(element.kind, f'{element.family} "{element.name}"', self.find,
                                self.read(element))
        definition.fill(fields)
        self._hold(definition)
        self._owner.call(element.kind.function("set"), element.id, ctypes.byref(definition.struct))

    # ---- the whole ------------------------------------------------------------------------------------

    @property
    def gravity(self):
        """(x, y, z) [m/s^2], of particles and rigid bodies."""
        values = np.empty(3)
        _calls.make(lib.baum_mechanism_get_gravity, self.handle, values.ctypes.data)
        return tuple(values.tolist())

    @gravity.setter
    def gravity(self, value):
        given = [number(part, "gravity") for part in value]
        if len(given) not in (2, 3):
            raise ValueError(f"gravity: 2 or 3 numbers are wanted, not {len(given)}")
        _calls.make(lib.baum_mechanism_set_gravity, self.handle, *(given + [0.0])[:3])

    @property
    def scale(self):
        """Length scale [m]; NaN when it was not set and the mechanism is not frozen."""
        value = ctypes.c_double()
        _calls.make(lib.baum_mechanism_get_scale, self.handle, ctypes.byref(value))
        return value.value

    @scale.setter
    def scale(self, value):
        _calls.make(lib.baum_mechanism_set_scale, self.handle, number(value, "scale"))

    def freeze(self):
        """Check everything and make the mechanism constant. Returns it."""
        self._long(lib.baum_mechanism_freeze)
        return self

    @property
    def frozen(self):
        """Whether it is constant."""
        return lib.baum_mechanism_is_frozen(self.handle)

    def copy(self, **changes):
        """A copy with some definitions changed, for example m.copy(rod=dict(mass=0.04)). It is frozen when this one
        is. Handles of one are good for the other as long as nothing is added."""
        out = ctypes.c_void_p()
        _calls.make(lib.baum_mechanism_copy, self.handle, ctypes.byref(out))
        copy = Mechanism.__new__(Mechanism)
        copy._adopt(out.value, self)
        for name, fields in changes.items():
            copy.change(copy[name], fields)
        return copy.freeze() if self.frozen else copy

    @property
    def sizes(self):
        """Numbers nq, nv, nc of a frozen mechanism."""
        counts = [ctypes.c_int32() for _ in range(3)]
        _calls.make(lib.baum_mechanism_sizes, self.handle, *map(ctypes.byref, counts))
        return Sizes(*(count.value for count in counts))

    def rows(self, joint):
        """Rows of a joint in Phi and lambda of a frozen mechanism, a slice."""
        first, count = ctypes.c_int32(), ctypes.c_int32()
        _calls.make(lib.baum_mechanism_rows, self.handle, self.find("joint", joint).id,
                    ctypes.byref(first), ctypes.byref(count))
        return slice(first.value, first.value + count.value)

    def columns(self, body):
        """Places of a body in q and v of a frozen mechanism, two slices."""
        body = self.find("body", body)
        q, v = ctypes.c_int32(), ctypes.c_int32()
        _calls.make(lib.baum_mechanism_columns, self.handle, body.id, ctypes.byref(q),
                    ctypes.byref(v))
        return slice(q.value, q.value + body.nq), slice(v.value, v.value + body.nv)

    def mobility(self):
        """Freedoms, redundant and conflicting rows, bodies without a joint, at the assembled start pose."""
        struct = _abi.baum_mobility()
        self._long(lib.baum_mechanism_mobility, ctypes.byref(struct), ctypes.sizeof(struct))
        values = {name: getattr(struct, name) for name in Mobility._fields}
        values["worst_joint"] = self.find("joint", struct.worst_joint)
        values["text"] = struct.text.decode(errors="replace")
        return Mobility(**values)

    def check_derivatives(self):
        """Compare the derivatives that functions give with differences; baum.Error names the wrong entry."""
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
            raise KeyError(f"no channel {value!r}; there are {', '.join(WHOLE)} and those of bodies "
                           'and joints, such as "B.phi"')
        return channel

    # ---- runs -----------------------------------------------------------------------------------------

    def simulation(self, integrator=None, **options):
        """Start a run that goes step by step; see Simulation for the options."""
        from .simulation import Simulation
        return Simulation(self, integrator, **options)

    def simulate(self, times, integrator=None, *, record=(), **options):
        """Run through `times` [s] and return a Run: q, v and the channels in `record`, at each of them. The run
        begins at the option start_time, 0 when left out. See Simulation for the options."""
        from .simulation import Simulation
        return Simulation(self, integrator, **options).sample(times, record)
