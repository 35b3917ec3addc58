# SPDX-License-Identifier: BSD-3-Clause
"""Definitions: from keyword arguments to the library's structs and back.

A field that is None keeps its default, or in a change its present value. NaN is a value: "not
given".
"""

import ctypes
from dataclasses import dataclass

from . import _abi, callbacks
from ._lib import default, lib
from ._values import address, integer, number, vector


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
        Kind("user_constraint", "joint"),
        Kind("planar_spring", "force"),
        Kind("planar_load", "force"),
        Kind("user_force", "force"),
    )
}

HIDDEN = ("struct_size", "body_count")


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

    def fill(self, fields):
        """Set the fields that are not None, functions last because their shapes follow from the
        others."""
        unknown = [name for name in fields if name not in self._types or name in HIDDEN]
        if unknown:
            raise TypeError(
                f"{self._label} has no {unknown[0]}; there are: "
                + ", ".join(name for name in self._types if name not in HIDDEN)
            )
        given = {name: value for name, value in fields.items() if value is not None}
        functions = {
            name: given.pop(name) for name in list(given) if self._types[name] in callbacks.SHELLS
        }
        for name, value in given.items():
            self._set(name, value)
        for name, function in functions.items():
            self._set_function(name, function)
        return self

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
            setattr(self.struct, name, bool(value))
        elif kind is ctypes.c_char_p:
            setattr(self.struct, name, str(value).encode())
        elif kind in (_abi.baum_body_id, _abi.baum_joint_id):
            family = "body" if kind is _abi.baum_body_id else "joint"
            setattr(self.struct, name, self._find(family, value).id)
        else:
            setattr(self.struct, name, kind(*vector(value, kind._length_, label)))

    def _set_bodies(self, value):
        handles = [self._find("body", body) for body in value]
        self.struct.bodies = (_abi.baum_body_id * len(handles))(*(body.id for body in handles))
        self.struct.body_count = len(handles)

    def _pointer(self, name, value, label):
        """`user` is an address or something of ctypes; the others are arrays of `size` numbers."""
        if name == "user":
            self.keep.append(value)
            return value if isinstance(value, int) else ctypes.cast(value, ctypes.c_void_p).value
        array = vector(value, self.struct.size, label)
        self.keep.append(array)
        return address(array)

    def _set_function(self, name, function):
        nq, nv = self._sizes()
        rows = self.struct.row_count if self.kind.name == "user_constraint" else nv
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
        }[name]
        label = f"{self._label}: {name}"
        wrapped = callbacks.wrap(self._types[name], function, label, shape, nq, nv)
        self.keep.append((wrapped, function))
        self.has_python |= callbacks.address_of(function) is None
        setattr(self.struct, name, wrapped)

    def _sizes(self):
        """Lengths of the q and v that this definition's functions are given."""
        if self.kind.name == "coordinates":
            return self.struct.size, self.struct.size
        if "body_count" not in self._types:
            return 0, 0
        count = self.struct.body_count
        bodies = [self._find("body", self.struct.bodies[k]) for k in range(count)]
        return sum(body.nq for body in bodies), sum(body.nv for body in bodies)


def as_dict(definition, find):
    """What a definition says, as Python values; functions and their pointers are left out."""
    values = {}
    for name, kind in definition._fields_:
        value = getattr(definition, name)
        if (
            name in HIDDEN
            or kind in callbacks.SHELLS
            or kind is ctypes.c_void_p
            or name == "bodies"
        ):
            continue
        if kind in (_abi.baum_body_id, _abi.baum_joint_id):
            value = find("body" if kind is _abi.baum_body_id else "joint", value)
        elif kind is ctypes.c_char_p:
            value = None if value is None else value.decode()
        elif isinstance(value, ctypes.Array):
            value = tuple(value)
        values[name] = value
    return values
