# SPDX-License-Identifier: BSD-3-Clause
"""Definitions: from keyword arguments to the library's structs and back.

A field that is None keeps its default, or in a change its present value. NaN is a value: "not
given".
"""

import ctypes
from dataclasses import dataclass

import numpy as np

from . import _abi, callbacks
from ._lib import default, lib
from ._values import address, integer, number, numbers, truth, vector


@dataclass(frozen=True)
class Kind:
    """A kind of body, joint or force: its struct, its family, and the sizes of a body's q and v."""

    name: str
    family: str
    nq: int = 0
    nv: int = 0

    @property
    def struct(self):
        return getattr(_abi, f"baum_{self.name}_def")

    @property
    def id_type(self):
        return getattr(_abi, f"baum_{self.family}_id")

    def function(self, verb):
        """The library's function to add, get or set a definition."""
        return getattr(lib, f"baum_mechanism_{verb}_{self.name}")


KINDS = {
    kind.name: kind
    for kind in (
        Kind("planar_body", "body", 3, 3),
        Kind("planar_particle", "body", 2, 2),
        Kind("coordinates", "body"),
        Kind("planar_revolute", "joint"),
        Kind("planar_translational", "joint"),
        Kind("planar_distance", "joint"),
        Kind("planar_fixed", "joint"),
        Kind("planar_pin_in_slot", "joint"),
        Kind("planar_rack_and_pinion", "joint"),
        Kind("planar_gear", "joint"),
        Kind("planar_curve", "joint"),
        Kind("coupling", "joint"),
        Kind("driver", "joint"),
        Kind("spline_driver", "joint"),
        Kind("user_constraint", "joint"),
        Kind("planar_spring", "force"),
        Kind("planar_torsion_spring", "force"),
        Kind("planar_load", "force"),
        Kind("user_force", "force"),
    )
}

HIDDEN = ("struct_size", "body_count", "count")
FAMILIES = {
    _abi.baum_body_id: "body",
    _abi.baum_joint_id: "joint",
    _abi.baum_input_id: "input",
}


class Definition:
    """One definition on its way to the library, with what it needs to stay alive.

    label names the element in messages; find(family, value) gives the handle for a handle or a
    name.
    """

    def __init__(self, kind, label, find, struct=None):
        self.kind = kind
        self.struct = default(kind.struct) if struct is None else struct
        self.keep = []
        self.has_python = False
        self._label = label
        self._find = find
        self._types = dict(kind.struct._fields_)
        self._names = [name for name in self._types if name not in HIDDEN]
        if _abi.baum_force_fn in self._types.values():
            self._names.append("inputs")

    def fill(self, fields):
        """Set the fields that are not None, functions last because their shapes follow from the
        others."""
        unknown = [name for name in fields if name not in self._names]
        if unknown:
            raise TypeError(
                f"{self._label} has no {unknown[0]}; there are: " + ", ".join(self._names)
            )
        given = {name: value for name, value in fields.items() if value is not None}
        inputs = self._places(given.pop("inputs", ()))
        functions = {
            name: given.pop(name) for name in list(given) if self._types[name] in callbacks.SHELLS
        }
        if inputs and not functions:
            raise TypeError(f"{self._label}: inputs are given together with the functions of them")
        user = given.pop("user", None)
        self._set_count(given)
        # Sizes first: lengths of arrays follow from them.
        for name in sorted(given, key=lambda name: self._types[name] is not ctypes.c_int32):
            self._set(name, given[name])
        for name, function in functions.items():
            self._set_function(name, function, inputs)
        if user is not None:
            self._set("user", user)
        return self

    def _places(self, inputs):
        """Where inputs are among those of the mechanism. The library does not see what functions
        take, so that strangers are refused here."""
        own = []
        for given in inputs:
            given = self._find("input", given)
            own.append(self._find("input", given.name))
            if own[-1] != given:
                raise ValueError(f"{self._label}: {given!r} is an input of another mechanism")
        return tuple(one.id.index1 - 1 for one in own)

    def _set_count(self, given):
        """The number of points of a spline follows from its times when both lists are new."""
        if "times" in given and "values" in given:
            self.struct.count = np.size(given["times"])

    def _set(self, name, value):
        label, kind = f"{self._label}: {name}", self._types[name]
        if name == "bodies":
            self._set_bodies(value)
        elif kind is ctypes.c_void_p:
            setattr(self.struct, name, self._pointer(name, value, label))
        elif kind is ctypes.c_double:
            setattr(self.struct, name, number(value, label))
        elif kind is ctypes.c_int32:
            setattr(self.struct, name, integer(value, label))
        elif kind is ctypes.c_bool:
            setattr(self.struct, name, truth(value, label))
        elif kind is ctypes.c_char_p:
            setattr(self.struct, name, str(value).encode())
        elif kind in FAMILIES:
            setattr(self.struct, name, self._find(FAMILIES[kind], value).id)
        else:
            setattr(self.struct, name, kind(*vector(value, kind._length_, label)))

    def _set_bodies(self, value):
        alone = isinstance(value, str) or hasattr(value, "family")
        handles = [self._find("body", body) for body in ([value] if alone else value)]
        self.struct.bodies = (_abi.baum_body_id * len(handles))(*(body.id for body in handles))
        self.struct.body_count = len(handles)

    def _pointer(self, name, value, label):
        """`user` is an address or something of ctypes; the others are arrays of numbers."""
        if name == "user":
            self.keep.append(value)
            try:
                return value if isinstance(value, int) else ctypes.cast(value, ctypes.c_void_p).value
            except ctypes.ArgumentError:
                raise TypeError(
                    f"{label}: an address or an object of ctypes is wanted, not {value!r}"
                ) from None
        array = vector(value, length(self.struct, name), label)
        self.keep.append(array)
        return address(array)

    def _set_function(self, name, function, inputs):
        nq, nv = self._sizes()
        rows = max(self.struct.row_count, 0) if self.kind.name == "user_constraint" else nv
        shape = {
            "mass": (nv, nv),
            "force_q": (nv, nv),
            "force_v": (nv, nv),
            "force": (nv,),
            "potential": (1,),
            "phi": (rows,),
            "nu": (rows,),
            "gamma": (rows,),
            "jacobian": (rows, nv),
            "law": (3,),
            "curve": (6,),
            "rate": (nq,),
            "move": (nq,),
            "difference": (nv,),
            "normalize": (nq,),
        }[name]
        label = f"{self._label}: {name}"
        wrapped = callbacks.wrap(self._types[name], function, label, shape, nq, nv, inputs)
        self.keep.append((wrapped, function))
        self.has_python |= callbacks.address_of(function) is None
        setattr(self.struct, name, wrapped)

    def _sizes(self):
        """Lengths of the q and v that this definition's functions are given."""
        if self.kind.name == "coordinates":
            # The library refuses what is less.
            return max(position_count(self.struct), 0), max(self.struct.size, 0)
        if "body_count" not in self._types:
            return 0, 0
        count = self.struct.body_count
        bodies = [self._find("body", self.struct.bodies[k]) for k in range(count)]
        return sum(body.nq for body in bodies), sum(body.nv for body in bodies)


def position_count(coordinates):
    """Number of positions of user coordinates."""
    return coordinates.position_count or coordinates.size


def sizes(kind, struct):
    """nq and nv of a body with that definition; zeros for others."""
    if kind.name == "coordinates":
        return position_count(struct), struct.size
    return kind.nq, kind.nv


def length(definition, name):
    """Number of entries of an array of a definition."""
    if not hasattr(definition, "size"):
        return definition.count
    return position_count(definition) if name in ("q", "position_scale") else definition.size


def as_dict(definition, find):
    """What a definition says, as Python values; functions and their `user` are left out."""
    values = {}
    for name, kind in definition._fields_:
        value = getattr(definition, name)
        if name in HIDDEN or kind in callbacks.SHELLS or name in ("bodies", "user"):
            continue
        if kind in FAMILIES:
            value = find(FAMILIES[kind], value)
        elif kind is ctypes.c_void_p:
            value = numbers(value, length(definition, name))
        elif kind is ctypes.c_char_p:
            value = None if value is None else value.decode()
        elif isinstance(value, ctypes.Array):
            value = tuple(value)
        values[name] = value
    return values
