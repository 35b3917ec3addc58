# SPDX-License-Identifier: BSD-3-Clause
"""Find and load the C library, and check that it has the version this package was made for."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import sys
from pathlib import Path
from typing import Any, Iterator, TypeVar

from . import _abi
from ._words import in_python

Struct = TypeVar("Struct", bound=ctypes.Structure)

if sys.platform == "darwin":
    NAMES = ["libbaum.dylib", "libbaum.0.dylib"]
elif os.name == "nt":
    NAMES = ["baum.dll", "libbaum.dll"]
else:
    NAMES = ["libbaum.so", "libbaum.so.0"]

PACKAGE = Path(__file__).resolve().parent


def _folders() -> Iterator[Path]:
    """Return the folders where the library may be: this package, the build tree, the virtual
    environment."""
    yield PACKAGE
    tree = PACKAGE.parents[2]
    if (tree / "include" / "baum" / "baum.h").exists():
        yield from (tree / "build" / "dev", tree / "build" / "release")
    if sys.prefix != sys.base_prefix:
        yield Path(sys.prefix) / "lib"


def _candidates() -> Iterator[str]:
    """Return the paths and names to try, in order. If BAUM_LIBRARY is set, only the file that it
    names is tried."""
    named = os.environ.get("BAUM_LIBRARY")
    if named:
        yield named
        return
    for folder in _folders():
        for name in NAMES:
            if (folder / name).exists():
                yield str(folder / name)
    yield from reversed(NAMES)
    found = ctypes.util.find_library("baum")
    if found:
        yield found


def _open() -> tuple[ctypes.CDLL, str]:
    """Load the first candidate that can be loaded. Return the library and its path."""
    failures = []
    for candidate in _candidates():
        try:
            return ctypes.CDLL(candidate), candidate
        except OSError as error:
            failures.append(f"  {candidate}: {error}")
    raise ImportError(
        "baum: the C library could not be loaded; install it (and run ldconfig), or name its file "
        "in BAUM_LIBRARY. "
        "Tried:\n" + "\n".join(failures)
    )


def _check_version(library: Any, path: str) -> str:
    """Refuse a library whose major or minor version differs from that of this package."""
    try:
        library.baum_version.restype = ctypes.c_char_p
        version: str = library.baum_version().decode()
    except AttributeError:
        raise ImportError(f"baum: {path} is not the library baum") from None
    if version.split(".")[:2] != _abi.VERSION.split(".")[:2]:
        raise ImportError(
            f"baum: the library {path} has version {version}, "
            f"this Python package has version {_abi.VERSION}"
        )
    return version


def _declare(library: ctypes.CDLL, path: str, prototypes: dict[str, tuple[Any, Any]]) -> None:
    """Declare the result and argument types of every function."""
    for name, (result, arguments) in prototypes.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise ImportError(f"baum: the library {path} has no function {name}") from None
        function.restype = result
        function.argtypes = arguments


def _check_structs(library: ctypes.CDLL, path: str) -> None:
    """Compare the size of every struct that has defaults with the size in the library. The structs
    of a newer library may have more fields, which keep their defaults."""
    for struct, name in _abi.DEFAULTS.items():
        room = (ctypes.c_char * (4 * ctypes.sizeof(struct)))()
        getattr(library, name)(ctypes.cast(room, ctypes.POINTER(struct)), len(room))
        size = struct.from_buffer(room).struct_size
        if size < ctypes.sizeof(struct):
            raise ImportError(
                f"baum: {struct.__name__} has {size} bytes in the library {path} "
                f"and {ctypes.sizeof(struct)} in this Python package"
            )


lib, path = _open()
version = _check_version(lib, path)
_declare(lib, path, _abi.PROTOTYPES)
_check_structs(lib, path)


_defaults: dict[type[ctypes.Structure], bytes] = {}


def default(struct: type[Struct]) -> Struct:
    """Make a struct with the defaults of the library."""
    if struct not in _defaults:
        filled = struct()
        getattr(lib, _abi.DEFAULTS[struct])(ctypes.byref(filled), ctypes.sizeof(struct))
        _defaults[struct] = bytes(filled)
    return struct.from_buffer_copy(_defaults[struct])


def text(value: bytes) -> str:
    """Convert a text of the library to a string, and replace C names by names of this package."""
    return in_python(value.decode(errors="replace"))


def open_catalog() -> ctypes.CDLL:
    """Load the library of the catalogue, which is in the same folder as the main library."""
    folder, name = os.path.split(path)
    beside = os.path.join(folder, name.replace("baum", "baum_catalog", 1))
    try:
        library = ctypes.CDLL(beside)
    except OSError as error:
        raise ImportError(
            f"baum.catalog: the library {beside} could not be loaded: {error}"
        ) from None
    _declare(library, beside, _abi.CATALOG_PROTOTYPES)
    return library
