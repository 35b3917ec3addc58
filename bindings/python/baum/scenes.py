# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: mechanisms in the form of a JSON text, which can be saved, sent, compared and pickled.

A text cannot contain functions. A scene contains only their names, and the program that reads the
scene provides the functions. A force function that receives inputs is written as "name(0, 2)",
where 0 and 2 are the indices of the inputs.
"""

from __future__ import annotations

import ctypes
import json
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping

from . import _abi, _calls, _files, callbacks, errors
from ._lib import lib
from ._motion import ROOM
from ._values import unused
from .definitions import ARGUMENTS, KINDS

if TYPE_CHECKING:
    from .elements import Element
    from .mechanism import Mechanism

Functions = Mapping[str, Any]
LISTS = {"bodies": "body", "joints": "joint", "forces": "force"}


def _used(element: Element, struct: Any) -> Iterator[tuple[str, int]]:
    """For each field of a definition that holds a function or a `user` object, return the name of
    the field and the address in it."""
    for name, kind in struct._fields_:
        if kind in callbacks.SHELLS:
            address = ctypes.cast(getattr(struct, name), ctypes.c_void_p).value
        else:
            address = getattr(struct, name) if name == "user" else None
        if address:
            yield name, address


def _name_of(function: Any, usual: str, taken: Mapping[str, Any], given: Functions) -> str:
    """Choose a name for a function: the name that the user has given, otherwise the function's own
    name. If another function already has this name, choose `usual`, which names the element and the
    field."""
    for name, value in given.items():
        if value is function:
            return name
    own = getattr(function, "__name__", "")
    return own if own.isidentifier() and taken.get(own, function) is function else usual


class _Hooks:
    """The hooks of a mechanism, and the Python objects that belong to them. A hook pairs the
    address of a function or of a `user` object with the name that the library writes for it."""

    def __init__(self, mechanism: Mechanism, given: Functions) -> None:
        self.objects: dict[str, Any] = {}
        self.hooks: list[_abi.baum_hook] = []
        self._addresses: set[int] = set()
        known = dict(mechanism.kept_objects())
        for element in mechanism:
            if element.kind is not None:
                for field, address in _used(element, mechanism.read(element)):
                    usual = f"{element.name}.{field}"
                    function, inputs = known.get(address, (address, ()))
                    self._add(field, address, function, inputs, usual, given)

    def _add(
        self,
        field: str,
        address: int,
        function: Any,
        inputs: tuple[int, ...],
        usual: str,
        given: Functions,
    ) -> None:
        if address in self._addresses:
            return
        self._addresses.add(address)
        name = _name_of(function, usual, self.objects, given)
        self.objects[name] = function
        hook = _abi.baum_hook()
        if inputs:
            name = f"{name}({', '.join(map(str, inputs))})"
        hook.name = name.encode()
        if field == "user":
            hook.user = address
        else:
            hook.function = ctypes.cast(address, _abi.baum_hook_fn)
        self.hooks.append(hook)

    @property
    def array(self) -> Any:
        return (_abi.baum_hook * len(self.hooks))(*self.hooks)


def _print(mechanism: Mechanism, hooks: _Hooks) -> str:
    size = ctypes.c_size_t(ROOM)
    room: Any = b""
    while len(room) <= size.value:
        room = ctypes.create_string_buffer(size.value + 1)
        _calls.make(
            lib.baum_mechanism_print,
            mechanism.handle,
            hooks.array,
            len(hooks.hooks),
            room,
            len(room),
            ctypes.byref(size),
        )
    return str(room.value, "utf-8")


class Scenes:
    """The methods of a Mechanism that write and compare scenes."""

    if TYPE_CHECKING:

        @property
        def frozen(self) -> bool: ...

    def scene(self: Any, functions: Functions | None = None, units: str | None = None) -> str:
        """Return the mechanism as a JSON text, which baum.parse() can read.

        functions: a dict from names to functions and `user` objects of the mechanism, such as
            {"drag": drag}. The text contains these names. For a function that is not in the dict,
            the text contains the name of the function in Python, or "element.field" if the function
            has no name or if another function has the same name.
        units: a note on the units, such as "mm, t, s". baum ignores this note and does not keep it
            when it reads the scene.
        """
        if units is not None:
            if not isinstance(units, str):
                raise TypeError(f"units: a text is wanted, not {units!r}")
            if not units.isprintable():
                raise ValueError(f"units: {units!r} contains characters that cannot be printed")
        text = _print(self, _Hooks(self, functions or {}))
        first, rest = text.split(",\n", 1)
        note = f',\n  "units": {json.dumps(units)}' if units is not None else ""
        return f"{first}{note},\n{rest}"

    def save(
        self,
        path: str | os.PathLike[str],
        functions: Functions | None = None,
        units: str | None = None,
    ) -> None:
        """Write the mechanism into a JSON file (a scene), which baum.load() can read. The other
        arguments are those of scene()."""
        _files.write(path, self.scene(functions, units))

    def function_names(self: Any) -> list[str]:
        """Return the names that scene() writes for the functions and `user` objects of the
        mechanism."""
        return list(_Hooks(self, {}).objects)

    def _comparable(self: Any) -> tuple[str, dict[str, Any]]:
        hooks = _Hooks(self, {})
        return _print(self, hooks), hooks.objects

    def __eq__(self, other: object) -> bool:
        """Whether both mechanisms have the same elements with the same names, numbers and
        functions."""
        if not isinstance(other, Scenes):
            return NotImplemented
        return self is other or self._comparable() == other._comparable()

    __hash__ = object.__hash__

    def difference(self: Any, other: Mechanism) -> str:
        """Describe how this mechanism differs from another one: a line for each setting, element
        and field that differs, with both values. The text is empty if the mechanisms are equal."""
        return "\n".join(_differences(json.loads(self.scene()), json.loads(other.scene())))

    def __reduce__(self: Any) -> Any:
        hooks = _Hooks(self, {})
        addresses = [name for name, value in hooks.objects.items() if isinstance(value, int)]
        if addresses:
            raise TypeError(
                f"{addresses[0]}: a function given by its address cannot be pickled; an address is "
                "valid in one process only"
            )
        return _unpickled, (_print(self, hooks), hooks.objects, self.frozen)


def _unpickled(text: str, functions: Functions, frozen: bool) -> Mechanism:
    mechanism = parse(text, functions)
    return mechanism.freeze() if frozen else mechanism


# ---- differences -----------------------------------------------------------------------------


def _elements(scene: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return everything that a scene contains, by name: settings, inputs and elements."""
    counts: dict[str, int] = {}
    found = {"mechanism": {key: scene[key] for key in scene if key not in (*LISTS, "inputs")}}
    for key in ("inputs", *LISTS):
        for number, element in enumerate(scene.get(key, ())):
            name = element.get("name", f"{key}[{number}]")
            found[unused(name, found, counts)] = element
    return found


def _differences(a: Mapping[str, Any], b: Mapping[str, Any]) -> Iterator[str]:
    first, second = _elements(a), _elements(b)
    for name in [*first, *(name for name in second if name not in first)]:
        if name not in second:
            yield f"{name}: only in the first"
        elif name not in first:
            yield f"{name}: only in the second"
        else:
            x, y = first[name], second[name]
            for field in [*x, *(field for field in y if field not in x)]:
                left, right = x.get(field, "default"), y.get(field, "default")
                if left != right:
                    yield f"{name}: {field} {left} -> {right}"


# ---- reading ---------------------------------------------------------------------------------


def _hook_fields(element: Any) -> Iterator[tuple[str, str]]:
    """Find the fields that contain the name of a function or of a `user` object. Return each such
    field with this name. `element` is a part of a scene."""
    kind = KINDS.get(str(element.get("kind"))) if isinstance(element, dict) else None
    for name, of, *_ in kind.struct._fields_ if kind else ():
        if of in callbacks.SHELLS or name == "user":
            if element.get(name) and isinstance(element[name], str):
                yield name, element[name]


def _placeholders(scene: Any) -> list[_abi.baum_hook]:
    """Make a hook for every name of a function in a scene, so that the library can read the scene.
    The functions of these hooks are replaced before they are called."""
    hooks = []
    place: Any = ctypes.cast(lib.baum_version, ctypes.c_void_p).value
    lists = [scene.get(key) for key in LISTS] if isinstance(scene, dict) else []
    for element in [e for found in lists if isinstance(found, list) for e in found]:
        for field, name in _hook_fields(element):
            hook = _abi.baum_hook(name=name.encode())
            if field == "user":
                hook.user = place
            else:
                hook.function = ctypes.cast(place, _abi.baum_hook_fn)
            hooks.append(hook)
    return hooks


def _object(name: str, functions: Functions, label: str) -> tuple[Any, list[int]]:
    """Return the object with that name, and the indices of the inputs that it receives."""
    parts = re.fullmatch(r"(.*?)\(([\d, ]+)\)", name)
    bare = parts[1] if parts else name
    if bare not in functions:
        raise KeyError(
            f"{label} is {bare!r}, which is not in `functions`; give functions={{{bare!r}: ...}}"
        )
    return functions[bare], [int(k) for k in parts[2].split(",")] if parts else []


def _set_functions(mechanism: Mechanism, own: Element, element: Any, functions: Functions) -> None:
    """Replace the placeholders of an element by functions. element: its entry in the scene."""
    changes: dict[str, Any] = {}
    for field, name in _hook_fields(element):
        label = f"{own.name}: {field}"
        value, inputs = _object(name, functions, label)
        changes[ARGUMENTS.get(field, field)] = value
        if inputs:
            changes["inputs"] = [mechanism.inputs[k] for k in inputs]
    if changes:
        mechanism.change(own, changes)


def parse(text: str, functions: Functions | None = None) -> Mechanism:
    """Create a mechanism from the text of a scene. The mechanism is not frozen.

    functions: a dict from each name of a function or `user` object in the scene to this function or
        object, such as {"drag": drag} or globals().

    Raises baum.Error if the text is not a scene; the message names the line. Raises KeyError if a
    function is missing.
    """
    from .mechanism import Mechanism

    scene: Any = None
    try:
        scene = json.loads(text.removeprefix("\ufeff"))
    except (ValueError, RecursionError):
        pass  # the message of the library names the line
    hooks = _placeholders(scene)
    array = (_abi.baum_hook * len(hooks))(*hooks)
    data, out = text.encode(), ctypes.c_void_p()
    _calls.make(lib.baum_mechanism_parse, data, len(data), array, len(hooks), ctypes.byref(out))
    mechanism = Mechanism.of_library(out.value)
    for key, family in LISTS.items() if hooks else ():
        own = (one for one in mechanism if one.family == family)
        for added, element in zip(own, scene.get(key, ())):
            _set_functions(mechanism, added, element, functions or {})
    return mechanism


def load(path: str | os.PathLike[str], functions: Functions | None = None) -> Mechanism:
    """Create a mechanism from a file that Mechanism.save() or a C program has written. The argument
    `functions` and the exceptions are the same as in baum.parse(), but the messages of baum.Error
    begin with the path."""
    try:
        return parse(Path(path).read_text(encoding="utf-8"), functions)
    except UnicodeDecodeError as error:
        raise ValueError(f"{os.fspath(path)}: {error}") from None
    except errors.Error as error:
        where = str(error).removeprefix("scene: ")
        raise errors.Error(error.status, f"{os.fspath(path)}: {where}") from None
