# SPDX-License-Identifier: BSD-3-Clause
"""Export of mechanisms as FMUs for co-simulation by FMI 3.0. Every FMU contains the same compiled
binary, which reads the scene, so no compiler is needed."""

from __future__ import annotations

import ctypes
import hashlib
import importlib.metadata
import io
import json
import math
import os
import platform
import re
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping, NamedTuple, Sequence

from . import _abi, _files
from ._lib import default, lib
from ._lib import path as library
from ._lib import version as library_version
from ._values import there_are
from .channels import Channel, Layout, several
from .integrators import lookup

if TYPE_CHECKING:
    from .elements import Input
    from .mechanism import Mechanism

MODEL = "baum_fmu"  # the name of the binary in every FMU
SYSTEMS = {"darwin": ("darwin", ".dylib"), "win32": ("windows", ".dll")}
MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
NOT_IN_XML = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
# Options that an FMU does not support. The program that runs the FMU sets the start time.
REFUSED = ("progress", "progress_interval", "row_gains", "max_steps", "start_time")


class _Variable(NamedTuple):
    """A scalar variable of an FMU. start is its start value, or None for an output."""

    name: str
    causality: str
    variability: str
    start: float | None = None


# ---- the binary --------------------------------------------------------------------------------


class _Place(ctypes.Structure):
    _fields_ = [(name, ctypes.c_void_p) for name in ("file", "base", "symbol", "address")]


def _library_file() -> Path:
    """Return the file of the loaded library. If the path of the library has no folder, the dynamic
    loader has searched for the file, and this function asks the loader where the file is."""
    if os.path.dirname(library) or sys.platform == "win32":
        return Path(library)
    found = _Place()
    ctypes.CDLL(None).dladdr(ctypes.cast(lib.baum_version, ctypes.c_void_p), ctypes.byref(found))
    return Path(os.fsdecode(ctypes.string_at(found.file)))


def _binary() -> tuple[str, Path]:
    """Return the path of the binary in an FMU, and the file of the binary on this system. This file
    is in the folder of the library, or in its subfolder baum."""
    system, suffix = SYSTEMS.get(sys.platform, ("linux", ".so"))
    machine = platform.machine().lower()
    inside = f"binaries/{MACHINES.get(machine, machine)}-{system}/{MODEL}{suffix}"
    folder = _library_file().parent
    for file in (folder / (MODEL + suffix), folder / "baum" / (MODEL + suffix)):
        if file.exists():
            return inside, file
    raise FileNotFoundError(f"{MODEL}{suffix} is neither in {folder} nor in {folder / 'baum'}")


def _licenses() -> Iterator[tuple[str, bytes]]:
    """Return the licenses of the installed package, which apply to the binary, too."""
    try:
        files = importlib.metadata.files("baum") or []
    except importlib.metadata.PackageNotFoundError:
        return
    for file in files:
        if "licenses" in file.parts:
            place = Path(str(file.locate()))
            if place.is_file():
                below = "/".join(file.parts[file.parts.index("licenses") + 1 :])
                yield f"documentation/licenses/{below}", place.read_bytes()


# ---- resources/fmu.json ------------------------------------------------------------------------


def _options(method: Any, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options that differ from their defaults, in the form that fmu.json needs."""
    from .simulation import make_options

    for name in REFUSED:
        if given.get(name) is not None:
            raise TypeError(f"export_fmu: an FMU cannot have the option {name}")
    struct, usual = make_options(method, given), default(_abi.baum_simulation_options)
    changed: dict[str, Any] = {}
    for name in given:
        value = getattr(struct, name)
        if name == "gains":
            if given[name] is not None:
                changed["gains.rule"] = value.rule
                changed["gains.value"] = list(value.value)
        elif value != getattr(usual, name) and value == value:
            if math.isinf(value):
                raise ValueError(f"export_fmu: {name} is {value}, must be finite")
            changed[name] = value
    return changed


def _channel(channel: Channel) -> dict[str, Any]:
    """Return a channel in the form that fmu.json needs. Bodies and joints are given by their
    indices."""
    struct = channel.struct
    found: dict[str, Any] = {"quantity": struct.quantity, "point": list(struct.point)}
    for family in ("body", "joint"):
        if getattr(struct, family).index1 > 0:
            found[family] = getattr(struct, family).index1 - 1
    if struct.coordinate:
        found["coordinate"] = struct.coordinate
    return found


# ---- variables ---------------------------------------------------------------------------------


def _numbered(name: str, count: int) -> list[str]:
    """Return names for the numbers of a parameter or for the columns of a channel, as Run.to_dict()
    does."""
    return [name] if count == 1 else [f"{name}[{k}]" for k in range(count)]


def _parameter(mechanism: Mechanism, name: str) -> Iterator[_Variable]:
    element, _, field = name.rpartition(".")
    found = mechanism[element] if element in mechanism else None
    struct: Any = mechanism.read(found) if found is not None and found.kind is not None else None
    kinds: dict[str, Any] = dict(pair[:2] for pair in struct._fields_) if struct else {}
    known = [k for k, c in kinds.items() if ctypes.c_double in (c, getattr(c, "_type_", None))]
    if field not in known:
        more = f"; {there_are(known, field)}" if known else ", such as 'rod.mass'"
        raise ValueError(f'{name!r} is not "element.field" with a field of numbers{more}')
    name_of = getattr(lib, f"baum_mechanism_{mechanism[element].family}_name")
    if name_of(mechanism.handle, mechanism[element].id).decode() != element:
        raise ValueError(f"{name!r}: several elements of the scene have the name of {element!r}")
    value = getattr(struct, field)
    numbers = [value] if kinds[field] is ctypes.c_double else list(value)
    for one, start in zip(_numbered(name, len(numbers)), numbers):
        yield _Variable(one, "parameter", "fixed", start)


def _description(
    name: str, token: str, variables: Sequence[_Variable], rtol: float | None
) -> bytes:
    """Return the contents of modelDescription.xml."""
    root = ElementTree.Element(
        "fmiModelDescription",
        fmiVersion="3.0",
        modelName=name,
        instantiationToken=token,
        generationTool=f"baum {library_version}",
        variableNamingConvention="flat",
    )
    ElementTree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=MODEL,
        canHandleVariableCommunicationStepSize="true",
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
    )
    logs = ElementTree.SubElement(root, "LogCategories")
    for category in ("warning", "error"):
        ElementTree.SubElement(logs, "Category", name=category)
    if rtol is not None:
        ElementTree.SubElement(root, "DefaultExperiment", tolerance=repr(rtol))
    listed = ElementTree.SubElement(root, "ModelVariables")
    structure = ElementTree.SubElement(root, "ModelStructure")
    for k, one in enumerate(variables):
        place = {"name": one.name, "valueReference": str(k)}
        place.update(causality=one.causality, variability=one.variability)
        if one.start is not None:
            place["start"] = "NaN" if one.start != one.start else repr(one.start)
        ElementTree.SubElement(listed, "Float64", place)
    outputs = [str(k) for k, one in enumerate(variables) if one.causality == "output"]
    for kind in ("Output", "InitialUnknown"):
        for reference in outputs:
            ElementTree.SubElement(structure, kind, valueReference=reference)
    text: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return text


# ---- export ------------------------------------------------------------------------------------


def _with_fixed_joints(mechanism: Mechanism, parameters: Sequence[str]) -> Mechanism:
    """Copy a mechanism. If a parameter can move a body, the copy gives the points of joints on this
    body in body axes, as Mechanism.copy() does. The joints thus keep their places on the body."""
    changes: dict[str, dict[str, Any]] = {}
    for name in parameters:
        element, _, field = name.rpartition(".")
        if field in ("position", "angle", "orientation"):
            present = mechanism[element].definition[field]
            changes.setdefault(element, {})[field] = present
            if field == "orientation":
                w, x, y, z = present
                rotated = {element: {field: (-x, w, z, -y)}}
                # Raise ValueError if an element needs the present orientation of the body.
                list(mechanism._kept_when_moved(rotated))
    return mechanism.thawed(**changes)


def _inputs(mechanism: Mechanism, copy: Mechanism, wanted: Any) -> list[Input]:
    """Find inputs in the copy by their names, or by elements of the mechanism."""
    names = []
    for one in mechanism.inputs if wanted is None else several(wanted):
        own = mechanism.find("input", one if isinstance(one, str) else one.name)
        if not isinstance(one, str) and bytes(own.id) != bytes(one.id):
            raise ValueError(f'export_fmu: the input "{own.name}" belongs to another mechanism')
        names.append(own.name)
    return [copy.find("input", name) for name in names]


def _check_names(path: Path, names: Sequence[str]) -> None:
    for name, count in Counter(names).items():
        if count > 1:
            raise ValueError(f'export_fmu: two variables have the name "{name}"')
    for name in (path.stem, *names):
        if NOT_IN_XML.search(name):
            raise ValueError(f"export_fmu: {name!r} has a character that XML does not allow")


def export(
    mechanism: Mechanism,
    path: str | os.PathLike[str],
    method: Any,
    outputs: Any,
    inputs: Any,
    parameters: str | Sequence[str],
    options: Mapping[str, Any],
) -> None:
    """Write an FMU; see Mechanism.export_fmu()."""
    inside, binary = _binary()
    chosen = _options(method, options)
    parameters = several(parameters)
    for name in parameters:
        list(_parameter(mechanism, name))  # refuse wrong names
    copy = _with_fixed_joints(mechanism, parameters)
    functions = copy.function_names()
    if functions:
        raise ValueError(f"export_fmu: an FMU cannot contain functions: {', '.join(functions)}")
    scene = copy.scene()
    copy.freeze()
    layout = Layout(copy, [copy.channel(one) for one in several(outputs)])
    with copy.simulation(method, **options) as run:
        run.get(*layout.channels.values())  # raises an error if the FMU could not run
    read = _inputs(mechanism, copy, inputs)
    variables = [_Variable("time", "independent", "continuous")]
    variables += [_Variable(one.name, "input", "continuous", one.initial) for one in read]
    for name in parameters:
        variables += _parameter(copy, name)
    for key, columns in layout.slices.items():
        names = _numbered(key, columns.stop - columns.start)
        variables += [_Variable(name, "output", "continuous") for name in names]
    pairs = [name.rpartition(".") for name in parameters]
    interface: dict[str, Any] = {
        "integrator": lookup(method).name,
        "options": chosen,
        "inputs": [one.id.index1 - 1 for one in read],
        "parameters": [{"element": pair[0], "field": pair[2]} for pair in pairs],
        "outputs": [_channel(channel) for channel in layout.channels.values()],
    }
    names = [one.name for one in variables]
    _check_names(Path(path), names)
    token = hashlib.sha256(json.dumps([scene, interface, names]).encode()).hexdigest()
    interface["token"] = token
    description = _description(Path(path).stem, token, variables, chosen.get("rtol"))
    files = [
        ("modelDescription.xml", description),
        ("resources/scene.json", scene.encode()),
        ("resources/fmu.json", json.dumps(interface, indent=1).encode()),
        (inside, binary.read_bytes()),
    ]
    _write(Path(path), [*files, *_licenses()])


def _write(path: Path, files: Sequence[tuple[str, bytes]]) -> None:
    """Write the archive. It contains no file times, so equal mechanisms give equal archives."""
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w") as archive:
        for name, data in files:
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    _files.write(path, whole.getvalue())
