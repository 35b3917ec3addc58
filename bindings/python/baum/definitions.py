# SPDX-License-Identifier: BSD-3-Clause
"""Convert definitions of elements from keyword arguments to structs of the library, and back.

An argument that is None leaves its field at the default. When an existing definition is changed,
None leaves the field at its present value. NaN is different from None: it is passed to the library,
where it means "not given".
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Mapping

import numpy as np

from . import _abi, _rotation, callbacks
from ._lib import default, lib
from ._values import address, integer, number, numbers, there_are, truth, vector, word


@dataclass(frozen=True)
class Kind:
    """A kind of body, joint or force.

    name: the name of its struct, without "baum_" and "_def".
    family: "body", "joint" or "force".
    nq, nv: numbers of positions and velocities of a body.
    units: units of the positions of a body or of the rows of a joint; empty if they depend on
        functions of the user.
    displacements: units of the displacements (nv) of a body whose velocities are not the
        derivatives of its positions.
    coordinates: names of the coordinates of a joint.
    """

    name: str
    family: str
    nq: int = 0
    nv: int = 0
    units: tuple[str, ...] = ()
    displacements: tuple[str, ...] = ()
    coordinates: tuple[str, ...] = ()

    @property
    def is_spatial(self) -> bool:
        """Whether the element is spatial, not planar."""
        return self.name.startswith("spatial_")

    @property
    def struct(self) -> type[ctypes.Structure]:
        found: type[ctypes.Structure] = getattr(_abi, f"baum_{self.name}_def")
        return found

    @property
    def id_type(self) -> type[ctypes.Structure]:
        found: type[ctypes.Structure] = getattr(_abi, f"baum_{self.family}_id")
        return found

    def coordinate(self, name: str) -> str:
        """Return the name of a coordinate of a joint; "first" gives the name of the first one."""
        return self.coordinates[0] if name == "first" else name

    def function(self, verb: str) -> Any:
        """Return the library's function that adds, gets or sets a definition."""
        return getattr(lib, f"baum_mechanism_{verb}_{self.name}")


_DISPLACEMENT = ("displacement",)
_ANGLE = ("angle",)

KINDS = {
    kind.name: kind
    for kind in (
        Kind("planar_body", "body", 3, 3, ("m", "m", "rad")),
        Kind("planar_particle", "body", 2, 2, ("m", "m")),
        Kind("spatial_body", "body", 7, 6, ("m",) * 3 + ("-",) * 4, ("m",) * 3 + ("rad",) * 3),
        Kind("spatial_particle", "body", 3, 3, ("m",) * 3),
        Kind("coordinates", "body"),
        Kind("planar_revolute", "joint", units=("m", "m"), coordinates=_ANGLE),
        Kind("planar_translational", "joint", units=("m", "rad"), coordinates=_DISPLACEMENT),
        Kind("planar_distance", "joint", units=("m",)),
        Kind("planar_fixed", "joint", units=("m", "m", "rad")),
        Kind("planar_pin_in_slot", "joint", units=("m",), coordinates=_DISPLACEMENT),
        Kind("planar_rack_and_pinion", "joint", units=("m",)),
        Kind("planar_gear", "joint", units=("m",)),
        Kind("planar_curve", "joint", units=("m",)),
        Kind("planar_knife_edge", "joint", units=("m",)),
        Kind("spatial_spherical", "joint", units=("m",) * 3),
        Kind("spatial_revolute", "joint", units=("m",) * 3 + ("-",) * 2, coordinates=_ANGLE),
        Kind(
            "spatial_universal",
            "joint",
            units=("m",) * 3 + ("-",),
            coordinates=("angle", "angle_b"),
        ),
        Kind(
            "spatial_cylindrical",
            "joint",
            units=("-",) * 2 + ("m",) * 2,
            coordinates=_DISPLACEMENT + _ANGLE,
        ),
        Kind(
            "spatial_prismatic",
            "joint",
            units=("-", "-", "m", "m", "-"),
            coordinates=_DISPLACEMENT,
        ),
        Kind("spatial_planar", "joint", units=("-", "-", "m"), coordinates=("x", "y", *_ANGLE)),
        Kind("spatial_fixed", "joint", units=("m",) * 3 + ("-",) * 3),
        Kind("spatial_distance", "joint", units=("m",)),
        Kind("spatial_point_on_line", "joint", units=("m", "m"), coordinates=_DISPLACEMENT),
        Kind("spatial_point_on_plane", "joint", units=("m",)),
        Kind("spatial_curve", "joint", units=("m", "m")),
        Kind("spatial_rolling_disc", "joint", units=("m",) * 3),
        Kind("spatial_knife_edge", "joint", units=("m",)),
        Kind(
            "spatial_screw",
            "joint",
            units=("-", "-", "m", "m", "m"),
            coordinates=("displacement", "angle"),
        ),
        Kind("spatial_constant_velocity", "joint", units=("m", "m", "m", "-")),
        Kind("coupling", "joint"),
        Kind("driver", "joint"),
        Kind("spline_driver", "joint"),
        Kind("user_constraint", "joint"),
        Kind("planar_spring", "force"),
        Kind("planar_torsion_spring", "force"),
        Kind("planar_load", "force"),
        Kind("spatial_spring", "force"),
        Kind("spatial_cable", "force"),
        Kind("spatial_load", "force"),
        Kind("spatial_torsion_spring", "force"),
        Kind("spatial_bushing", "force"),
        Kind("joint_spring", "force"),
        Kind("joint_load", "force"),
        Kind("user_force", "force"),
    )
}

# Names of joint coordinates -> their values in the library.
COORDINATES = {
    one.name.removeprefix("BAUM_COORDINATE_").lower(): int(one)
    for one in _abi.baum_joint_coordinate
}

Find = Callable[[str, Any], Any]

# Arguments whose names differ from the names of their fields: argument -> field.
FIELDS = {"rows": "row_count"}
ARGUMENTS = {field: argument for argument, field in FIELDS.items()}
HIDDEN = ("struct_size", "body_count", "point_count", "count")
# Fields that accept several forms, and the functions that convert them.
FORMS = {
    ("spatial_body", "inertia"): _rotation.tensor,
    ("spatial_body", "orientation"): _rotation.quaternion,
    ("spatial_bushing", "stiffness"): _rotation.six_by_six,
    ("spatial_bushing", "damping"): _rotation.six_by_six,
}
FAMILIES: dict[Any, str] = {
    _abi.baum_body_id: "body",
    _abi.baum_joint_id: "joint",
    _abi.baum_input_id: "input",
}


class Definition:
    """The definition of one element, with the objects that must stay alive as long as the
    definition is used.

    label: names the element in messages.
    find: the function find(family, value), which returns the handle for a handle or a name.
    """

    def __init__(self, kind: Kind, label: str, find: Find, struct: Any = None) -> None:
        self.kind = kind
        self.struct: Any = default(kind.struct) if struct is None else struct
        self.keep: list[Any] = []
        self.has_python = False
        self._label = label
        self._find = find
        self._types: dict[str, Any] = {field[0]: field[1] for field in kind.struct._fields_}
        self.names = [ARGUMENTS.get(name, name) for name in self._types if name not in HIDDEN]
        if _abi.baum_force_fn in self._types.values():
            self.names.append("inputs")

    def fill(self, fields: Mapping[str, Any]) -> Definition:
        """Set the fields that are not None. Functions are set last, because the shapes of their
        results follow from the other fields. Returns the definition."""
        unknown = [name for name in fields if name not in self.names]
        if unknown:
            known = there_are(self.names, unknown[0])
            raise TypeError(f"{self._label} has no {unknown[0]}; {known}")
        given = {
            FIELDS.get(name, name): fields[name] for name in fields if fields[name] is not None
        }
        inputs = self._places(given.pop("inputs", ()))
        functions = {
            name: given.pop(name) for name in list(given) if self._types[name] in callbacks.SHELLS
        }
        if inputs and not functions:
            raise TypeError(
                f"{self._label}: inputs are given without the functions that receive them"
            )
        user = given.pop("user", None)
        self._set_count(given)
        # Sizes and bodies are set first, because they determine the lengths of arrays.
        for name in sorted(
            given, key=lambda name: name != "bodies" and self._types[name] is not ctypes.c_int32
        ):
            self._set(name, given[name])
        for name, function in functions.items():
            self._set_function(name, function, inputs)
        if user is not None:
            self._set("user", user)
        return self

    def _places(self, inputs: Iterable[Any]) -> tuple[int, ...]:
        """Return the indices of inputs in the mechanism. Refuse an input of another mechanism here:
        the library does not know which inputs a Python function receives, so it cannot check
        them."""
        own = []
        for given in inputs:
            given = self._find("input", given)
            own.append(self._find("input", given.name))
            if own[-1] != given:
                raise ValueError(f"{self._label}: {given!r} is an input of another mechanism")
        return tuple(one.id.index1 - 1 for one in own)

    def _set_count(self, given: Mapping[str, Any]) -> None:
        """Set the number of points of a spline if both its times and its values are given."""
        if "times" in given and "values" in given:
            self.struct.count = np.size(given["times"])

    def _set(self, name: str, value: Any) -> None:
        label, kind = f"{self._label}: {name}", self._types[name]
        if name == "bodies":
            self._set_bodies(value)
        elif name.startswith("coordinate"):
            setattr(self.struct, name, word(COORDINATES, value, name))
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
        elif (self.kind.name, name) in FORMS:
            setattr(self.struct, name, kind(*FORMS[self.kind.name, name](value, label)))
        else:
            setattr(self.struct, name, kind(*vector(value, kind._length_, label)))

    def _set_bodies(self, value: Any) -> None:
        alone = isinstance(value, str) or hasattr(value, "family")
        try:
            listed = [value] if alone else list(value)
        except TypeError:
            raise TypeError(
                f"{self._label}: bodies: a body or a list of bodies is wanted, not {value!r}"
            ) from None
        handles = [self._find("body", body) for body in listed]
        self.struct.bodies = (_abi.baum_body_id * len(handles))(*(body.id for body in handles))
        counter = "point_count" if "points" in self._types else "body_count"
        setattr(self.struct, counter, len(handles))

    def _pointer(self, name: str, value: Any, label: str) -> Any:
        """Return the address for a pointer field. The field `user` holds an address or a ctypes
        object; all other pointer fields hold arrays."""
        if name == "user":
            self.keep.append(value)
            if isinstance(value, int):
                return value
            try:
                return ctypes.cast(value, ctypes.c_void_p).value
            except ctypes.ArgumentError:
                raise TypeError(
                    f"{label}: an address or an object of ctypes is wanted, not {value!r}"
                ) from None
        if name == "points":
            try:
                rows = list(value)
            except TypeError:
                raise TypeError(f"{label}: points are wanted, not {value!r}") from None
            value = [x for row in rows for x in vector(row, 3, label)]
        array = vector(value, length(self.struct, name), label)
        self.keep.append(array)
        return address(array)

    def _set_function(self, name: str, function: Any, inputs: tuple[int, ...]) -> None:
        nq, nv = self._sizes()
        rows = max(self.struct.row_count, 0) if self.kind.name == "user_constraint" else nv
        shapes: dict[str, tuple[int, ...]] = {
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
            "curve": (20 if self.kind.is_spatial else 6,),
            "rate": (nq,),
            "move": (nq,),
            "difference": (nv,),
            "normalize": (nq,),
        }
        label = f"{self._label}: {name}"
        kind, shape = self._types[name], shapes[name]
        wrapped = callbacks.wrap(kind, name, function, label, shape, nq, nv, inputs)
        self.keep.append((wrapped, function, inputs))
        self.has_python |= callbacks.address_of(function) is None
        setattr(self.struct, name, wrapped)

    def _sizes(self) -> tuple[int, int]:
        """Return the lengths of the q and v that the functions of this definition receive."""
        if self.kind.name == "coordinates":
            # The library refuses negative sizes.
            return max(position_count(self.struct), 0), max(self.struct.size, 0)
        if self.kind.name.endswith("_curve"):
            return (3 if self.kind.is_spatial else 2), 0
        if "body_count" not in self._types:
            return 0, 0
        count = self.struct.body_count
        bodies = [self._find("body", self.struct.bodies[k]) for k in range(count)]
        return sum(body.nq for body in bodies), sum(body.nv for body in bodies)


def position_count(coordinates: Any) -> int:
    """Return the number of positions of user coordinates."""
    count: int = coordinates.position_count or coordinates.size
    return count


def sizes(kind: Kind, struct: Any) -> tuple[int, int]:
    """Return nq and nv of a body with that definition; zeros for joints and forces."""
    if kind.name == "coordinates":
        return position_count(struct), struct.size
    return kind.nq, kind.nv


def length(definition: Any, name: str) -> int:
    """Return the number of entries of an array of a definition."""
    if name in ("q", "position_scale"):
        return position_count(definition)
    if name == "points":
        return 3 * int(definition.point_count)
    count: int = definition.size if hasattr(definition, "size") else definition.count
    return count


def as_dict(definition: Any, find: Find) -> dict[str, Any]:
    """Convert a definition to Python values. Functions and their `user` are omitted."""
    values = {}
    for name, kind in definition._fields_:
        value = getattr(definition, name)
        if name in HIDDEN or kind in callbacks.SHELLS or name == "user":
            continue
        if name == "bodies":
            if not hasattr(definition, "points"):
                continue
            value = tuple(find("body", value[k]) for k in range(definition.point_count))
        elif name == "points":
            array = numbers(value, length(definition, name))
            value = None if array is None else array.reshape(-1, 3)
        elif kind in FAMILIES:
            value = find(FAMILIES[kind], value)
        elif name.startswith("coordinate"):
            value = list(COORDINATES)[value]
        elif kind is ctypes.c_void_p:
            value = numbers(value, length(definition, name))
        elif kind is ctypes.c_char_p:
            value = None if value is None else value.decode()
        elif isinstance(value, ctypes.Array):
            value = tuple(value)
        values[ARGUMENTS.get(name, name)] = value
    return values
