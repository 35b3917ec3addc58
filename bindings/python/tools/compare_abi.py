# SPDX-License-Identifier: BSD-3-Clause
"""List the changes between two versions of baum/_abi.py that break compiled programs.

usage: compare_abi.py OLD NEW

New functions, new values of enums, and new fields at the end of structs that begin with struct_size
break nothing. If a change breaks compiled programs, the exit status is 1, and the soname must
change (docs/versions.md).
"""

from __future__ import annotations

import ctypes
import enum
import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, Iterator


def load(path: str) -> ModuleType:
    """Load a version of _abi.py as a module."""
    spec = importlib.util.spec_from_file_location(f"abi_{abs(hash(path))}", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def describe(kind: Any) -> str:
    """Return a C type as text. Equal types in both versions give the same text."""
    if hasattr(kind, "_restype_"):
        arguments = ", ".join(describe(argument) for argument in kind._argtypes_)
        return f"{describe(kind._restype_)} (*)({arguments})"
    return "void" if kind is None else str(kind.__name__)


def layout(struct: type[ctypes.Structure]) -> list[tuple[Any, ...]]:
    """Return the name, type, offset and size of every field."""
    return [
        (field[0], describe(field[1]), getattr(struct, field[0]).offset, ctypes.sizeof(field[1]))
        for field in struct._fields_
    ]


def changed_structs(old: ModuleType, new: ModuleType) -> Iterator[str]:
    present = {struct.__name__: struct for struct in new.STRUCTS}
    for struct in old.STRUCTS:
        name = struct.__name__
        before = layout(struct)
        after = layout(present[name]) if name in present else []
        if before[0][0] == "struct_size":
            after = after[: len(before)]
        if name not in present:
            yield f"struct {name} is missing"
        elif before != after:
            yield f"struct {name}: fields have changed"


def changed_functions(old: ModuleType, new: ModuleType) -> Iterator[str]:
    for table in ("PROTOTYPES", "CATALOG_PROTOTYPES"):
        for name, (result, arguments) in getattr(old, table).items():
            if name not in getattr(new, table):
                yield f"function {name}() is missing"
                continue
            other_result, other_arguments = getattr(new, table)[name]
            before = [describe(kind) for kind in (result, *arguments)]
            if before != [describe(kind) for kind in (other_result, *other_arguments)]:
                yield f"function {name}(): arguments or result have changed"


def changed_values(old: ModuleType, new: ModuleType) -> Iterator[str]:
    for name, values in vars(old).items():
        if not (isinstance(values, type) and issubclass(values, enum.IntEnum)):
            continue
        after = {value.name: value.value for value in getattr(new, name, ())}
        for value in values:
            if after.get(value.name) != value.value:
                yield f"enum {name}: {value.name} is missing or has another value"


def changes(old: ModuleType, new: ModuleType) -> list[str]:
    """Return a line for each change that breaks programs compiled with the old version."""
    return [
        *changed_structs(old, new),
        *changed_functions(old, new),
        *changed_values(old, new),
    ]


def main() -> None:
    if len(sys.argv) != 3 or not all(Path(name).exists() for name in sys.argv[1:]):
        sys.exit(__doc__)
    found = changes(load(sys.argv[1]), load(sys.argv[2]))
    print("\n".join(found) if found else "nothing breaks")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
