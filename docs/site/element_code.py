# SPDX-License-Identifier: BSD-3-Clause
"""Makes the code that the pages of the elements show: Python statements from tests/browser/scenes.py, and C code that adds the
same element. A compiler checks the C code."""

import ast
import ctypes
import inspect
import math
import re
import subprocess
import sys
import textwrap

import baum
from baum import adding, adding_space
from baum.definitions import KINDS


def methods():
    """Return, for each kind of element, the name of the method of Mechanism that adds it."""
    found = {}
    for module in (adding, adding_space):
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.FunctionDef):
                text = ast.unparse(node).replace("'", '"')
                for kind in re.findall(r'self\._add\w*\([^"]*"(\w+)"', text):
                    if kind in KINDS:
                        found[kind] = node.name
    return found


def python_code(scene, method):
    """Return the statements of a scene that add the element."""
    source = textwrap.dedent(inspect.getsource(scene))
    body = ast.parse(source).body[0].body
    chosen = [
        ast.get_source_segment(source, node, padded=True)
        for node in body
        if f"m.{method}(" in ast.unparse(node) or isinstance(node, ast.FunctionDef)
    ]
    return "\n".join(textwrap.dedent(text) for text in chosen) + "\n"


def number(value):
    text = f"{value:.6g}"
    return text if "." in text or "e" in text else f"{text}.0"


def c_name(name):
    return re.sub(r"\W", "_", name)


def assignment(m, kind, field, type_, value, default):
    """Return the C lines that set a field, and the ids in these lines. If the value is the default, both are empty."""
    family = type_.__name__.removeprefix("baum_").removesuffix("_id")
    if bytes(value) == bytes(default) if hasattr(value, "_type_") else value == default:
        return [], []
    if family in ("body", "joint", "input", "force"):
        if bytes(value) == bytes(default):
            return [], []
        name = "BAUM_GROUND" if value.index1 == -1 else c_name(m.find(family, value).name)
        return [f"def.{field} = {name};"], [(family, name)] if value.index1 != -1 else []
    if isinstance(value, ctypes.Array) and all(isinstance(one, float) for one in value):
        pairs = [(k, x) for k, x in enumerate(value) if not math.isnan(x)]
        return [f"def.{field}[{k}] = {number(x)};" for k, x in pairs if x != default[k]], []
    if isinstance(value, float) and not math.isnan(value):
        return [f"def.{field} = {number(value)};"], []
    if isinstance(value, (bool, int)) and type_ is not ctypes.c_void_p:
        return [f"def.{field} = {str(value).lower()};"], []
    return [], []


def c_code(m, element):
    """Return C code that adds the same element as the given one, and the ids that this code uses."""
    kind = KINDS[element.kind.name]
    struct, plain = kind.struct(), kind.struct()
    kind.function("get")(m.handle, element.id, ctypes.byref(struct), ctypes.sizeof(struct))
    getattr(baum._lib.lib, f"baum_{kind.name}_def_init")(ctypes.byref(plain), ctypes.sizeof(plain))
    lines = [f"baum_{kind.name}_def def = baum_{kind.name}_def_default();"]
    lines.append(f'def.name = "{element.name}";')
    used = []
    for field, type_, *_ in struct._fields_[2:]:
        value, default = getattr(struct, field), getattr(plain, field)
        new, ids = assignment(m, kind, field, type_, value, default)
        lines += new
        used += ids
    lines.append(f"baum_{kind.family}_id id;")
    lines.append(f"status = baum_mechanism_add_{kind.name}(mechanism, &def, &id);")
    return "\n".join(lines) + "\n", used


def as_function(name, block, used):
    """Return the text of a C function that contains the statements `block`."""
    ids = "".join(f", baum_{family}_id {id}" for family, id in dict.fromkeys(used))
    return (
        f"static baum_status {name}(baum_mechanism *mechanism{ids})\n{{\n"
        f"baum_status status;\n{block}return status;\n}}\n"
    )


def check_c(texts):
    """Check that each text compiles with the public headers."""
    command = ["cc", "-std=c11", "-Wall", "-Werror", "-Wno-unused-function", "-fsyntax-only"]
    command += ["-Iinclude", "-x", "c", "-"]
    for text in texts:
        text = f"#include <math.h>\n#include <baum/baum.h>\n{text}"
        done = subprocess.run(command, input=text, text=True, capture_output=True)
        if done.returncode:
            sys.exit(f"C code of an element does not compile\n{text}\n{done.stderr}")
