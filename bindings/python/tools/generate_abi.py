# SPDX-License-Identifier: BSD-3-Clause
"""Write baum/_abi.py and baum/_records.py: the public headers as ctypes and as named tuples.

usage: generate_abi.py [--check] [INCLUDE_DIR [FOLDER]]

Reads baum/baum.h and baum/catalog.h and the headers that they include. It parses only the C
constructs that these headers use, and fails on any other construct, so no declaration is omitted
silently.
--check writes nothing and fails if the output would change.
"""

import argparse
import csv
import importlib.util
import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
FOLDER = Path(__file__).resolve().parents[1] / "baum"
WIDTH = 100


def load_words():
    """Load baum/_words.py alone, because importing the package needs the compiled library."""
    spec = importlib.util.spec_from_file_location("_words", FOLDER / "_words.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


in_python = load_words().in_python

HEAD = '''\
# SPDX-License-Identifier: BSD-3-Clause
"""The C interface of baum {version}. Made by tools/generate_abi.py from the headers; do not edit.

Addresses of numbers (double *) and handles are c_void_p; strings are c_char_p.
"""
import enum
from ctypes import (
    CFUNCTYPE, POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_int, c_int32, c_int64,
    c_size_t, c_uint32, c_void_p,
)
'''

RECORDS_HEAD = '''\
# SPDX-License-Identifier: BSD-3-Clause
"""Results of the library as named tuples. Made by tools/generate_abi.py from the headers; do not
edit. Units are in brackets, and [-] means a pure number."""
from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from .elements import Body, Joint
    from .errors import Status
    from .gains import Gains
'''

# The structs that become named tuples, and the docstrings of these tuples.
RECORDS = {
    "baum_mobility": "What a mechanism can do at its assembled initial configuration. "
    "nv is the number of velocities, and J is the velocity Jacobian of the constraints.",
    "baum_report": "What an evaluation of the accelerations costs, and which work it skips. nv "
    "and nc are the numbers of velocities and of constraint rows, and J is the velocity Jacobian "
    "of the constraints.",
    "baum_counters": "What a run has cost since it was created, and how well it has kept the "
    "constraints. max_phi_joint and max_phi_rate_joint are handles of joints or None; after "
    "unpickling, they are the names of the joints. Phi are the values of the constraints, and Phi' "
    "is their time derivative.",
    "baum_energy_account": "Where the energy of a run has come from. The page docs/notation.md "
    "explains the symbols.",
    "baum_near_singular": "An interval in which a run was near a singular configuration. branch is "
    '"continued", "left" or "unknown". The joint is a handle or None; after unpickling it is the '
    "name of the joint.",
    "baum_study_entry": "What a setting costs and how accurate it is. Unknown values are NaN. The "
    "scale of a length is the characteristic length, and the scale of an angle is 1 rad. For "
    "error_lambda, the multiplier of row i is multiplied by the norm of row i of the Jacobian. For "
    "this norm, each column of the Jacobian is first multiplied by the scale of its coordinate.",
    "baum_study_method": "Entries of a study with the same integrator, formulation and gains.",
    "baum_study_reference": "How far the reference of a study can be trusted. The uncertainties "
    "below are those of the fields error, error_q, error_v, error_lambda and energy_error of "
    "StudyEntry.",
    "baum_catalog_parameter": "A number that a mechanism of the catalogue depends on.",
    "baum_catalog_entry": "A mechanism of the catalogue.",
    "baum_catalog_error": "How far a run is from the reference of the catalogue.",
}

# Fields that exist only in Python: name, type, comment.
ADDED = {
    "baum_catalog_entry": [
        ("parameters", "dict[str, CatalogParameter]", "Its parameters by name."),
    ],
}

# Python types of fields, by ctypes type in PYTHON and by field name in WORDS, which has priority.
PYTHON = {
    "c_double": "float",
    "c_bool": "bool",
    "c_int32": "int",
    "c_int64": "int",
    "c_char_p": "str",
    "c_char": "str",
    "baum_joint_id": "Joint | None",
    "baum_body_id": "Body | None",
    "baum_gains": "Gains | None",
}
WORDS = {
    "integrator": "str",
    "formulation": "str",
    "state": "str",
    "origin": "str",
    "branch": "str",
    "status": "Status | int",
}

NUMBERS = {
    "int": "c_int",
    "int32_t": "c_int32",
    "int64_t": "c_int64",
    "uint32_t": "c_uint32",
    "size_t": "c_size_t",
    "double": "c_double",
    "bool": "c_bool",
    "char": "c_char",
}


# ---- from files to declarations ------------------------------------------------------------------


def read_headers(include, name="baum/baum.h", seen=None):
    """Return the text of a header, preceded by the texts of the headers that it includes. Each
    header occurs once."""
    seen = set() if seen is None else seen
    seen.add(name)
    text = (include / name).read_text(encoding="utf-8")
    parts = [
        read_headers(include, wanted, seen)
        for wanted in re.findall(r"#include <(baum/\w+\.h)>", text)
        if wanted not in seen
    ]
    return "\n".join([*parts, text])


def strip(text):
    """Remove comments, preprocessor lines, extern "C" and inline functions."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r"//[^\n]*", " ", text)
    text = re.sub(r"#ifdef __cplusplus\n.*?#endif", " ", text, flags=re.S)
    text = expand_lists(text)
    text = re.sub(r"^[ \t]*#.*$", " ", text, flags=re.M)
    return re.sub(r"static inline [^{;]*\{.*?\n\}", " ", text, flags=re.S)


def expand_lists(text):
    """Expand the X-macros of the interface: apply the definition of BAUM_X to each line of a
    list."""
    text = text.replace("\\\n", " ")
    lists = {}
    for name, body in re.findall(r"#define (\w+_LIST)\(X\) *(.*)", text):
        lines = re.findall(r'X\(((?:[^()"]|"[^"]*")*)\)', body)
        lists[name] = [next(csv.reader([line], skipinitialspace=True)) for line in lines]

    def expand(match):
        arguments, body, name = re.split(r", *", match[1]), match[2], match[3]
        return " ".join(
            re.sub(r"\w+", lambda word: dict(zip(arguments, line)).get(word[0], word[0]), body)
            for line in lists[name]
        )

    return re.sub(r"#define BAUM_X\((.*?)\) *(.*)\n\s*(\w+_LIST)\(BAUM_X\)", expand, text)


def split(text):
    """Yield the declarations, which end at a semicolon outside braces, each as one line."""
    depth, start = 0, 0
    for at, char in enumerate(text):
        depth += (char == "{") - (char == "}")
        if char == ";" and depth == 0:
            yield " ".join(text[start:at].split())
            start = at + 1
    if text[start:].strip():
        raise SystemExit(f"not understood: {text[start:].strip()[:80]}")


# ---- comments of fields -------------------------------------------------------------------------


def field_comments(text, struct):
    """Return the comments in a header on the fields of a struct, by name of the field."""
    body = re.search(rf"typedef struct {struct} \{{(.*?)\n\}} {struct};", text, flags=re.S)[1]
    body = re.sub(r"\n\s*\*(?!/)", "\n", body)
    name = r"(\w+)(?:\[\w+\])*;"
    said = dict(re.findall(name + r"\s*/\*\*<(.*?)\*/", body, flags=re.S))
    before = re.findall(r"/\*\*(?!<)((?:(?!\*/).)*)\*/[^;#/]*?" + name, body, flags=re.S)
    said.update((field, comment) for comment, field in before)
    for entries in re.findall(r"(\w+_LIST)\(BAUM_X\)", body):
        lines = re.search(rf"#define {entries}\(X\)(.*?)\n\n", text, flags=re.S)[1]
        for line in re.findall(r'X\(((?:[^()"]|"[^"]*")*)\)', lines):
            _, field, _, unit, meaning = next(csv.reader([line], skipinitialspace=True))
            said[field] = f"[{'-' if unit == '1' else unit}] {meaning}" if unit else meaning
    return {field: in_python(" ".join(comment.split())) for field, comment in said.items()}


def record(text, struct, fields):
    """Write a struct as a NamedTuple class; `fields` does not contain struct_size."""
    comments = field_comments(text, struct)
    types = {
        field: WORDS.get(field) or PYTHON[re.match(r"[a-z_0-9]+", spelled)[0]]
        for field, spelled in fields
    }
    for field, kind, comment in ADDED.get(struct, ()):
        types[field], comments[field] = kind, comment
    missing = types.keys() - comments.keys()
    if missing:
        raise SystemExit(f"not understood: no comment on {', '.join(sorted(missing))} of {struct}")
    name = "".join(word.capitalize() for word in struct.split("_")[1:])
    said = textwrap.wrap(f'"""{RECORDS[struct]}', WIDTH - 4)
    lines = [f"\n\nclass {name}(NamedTuple):", *(f"    {line}" for line in said), ""]
    for field in types:
        lines += textwrap.wrap(
            f"{field}: {comments[field]}",
            WIDTH - 4,
            initial_indent="    ",
            subsequent_indent="        ",
        )
    lines += ['    """', ""]
    lines += [f"    {field}: {kind}" for field, kind in types.items()]
    return "\n".join([*lines, ""])


# ---- types ---------------------------------------------------------------------------------------


class Types:
    """Knows the names declared so far and translates C types to ctypes."""

    def __init__(self):
        self.structs, self.enums, self.functions, self.handles = set(), set(), set(), set()

    def spell(self, base, stars):
        """Return the ctypes name of a C type. The type is spelled as `base` and this number of
        stars."""
        if stars == 0:
            return self._value(base)
        if base == "char" and stars == 1:
            return "c_char_p"
        if base == "char" and stars == 2:
            return "POINTER(c_char_p)"
        if base in self.functions and stars == 1:
            return base
        if base in ("void", "double") and stars == 1 or base in self.handles and stars == 1:
            return "c_void_p"
        if base in self.handles and stars == 2:
            return "POINTER(c_void_p)"
        if stars == 1 and (base in self.structs or base in NUMBERS):
            return f"POINTER({self._value(base)})"
        raise SystemExit(f"not understood: type {base} {'*' * stars}")

    def _value(self, base):
        if base in NUMBERS:
            return NUMBERS[base]
        if base in self.enums:
            return "c_int"
        if base in self.structs:
            return base
        if base == "void":
            return "None"
        raise SystemExit(f"not understood: type {base}")


def declarators(types, text, in_struct=False):
    """Yield names and ctypes of declarators such as `const double *a, b[2]`."""
    match = re.fullmatch(r"(?:const )?(\w+) ?(.*)", text.replace("*const *", "**"))
    base = match[1]
    for part in match[2].split(","):
        name = re.fullmatch(r"\s*(\**)\s*(\w+)((?:\s*\[\w+\])*)\s*", part)
        if not name:
            raise SystemExit(f"not understood: {text}")
        sizes = re.findall(r"\[(\w+)\]", name[3])
        if sizes and not in_struct:
            yield name[2], types.spell(base, len(name[1]) + 1)
            continue
        spelled = types.spell(base, len(name[1]))
        for size in reversed(sizes):
            spelled = f"{spelled} * {size}" if " " not in spelled else f"({spelled}) * {size}"
        yield name[2], spelled


def arguments(types, text):
    """Return the ctypes of an argument list."""
    if text.strip() == "void":
        return []
    return [spelled for part in text.split(",") for _, spelled in declarators(types, part.strip())]


# ---- declarations to Python ----------------------------------------------------------------------


def wrap(opening, items, closing, indent="    "):
    """Join the parts on one line. If this line is too long, wrap the items on indented lines."""
    line = opening + ", ".join(items) + closing
    if len(line) <= WIDTH:
        return line
    lines, row = [], indent
    for item in items:
        if len(row) + len(item) + 1 > WIDTH and row.strip():
            lines.append(row.rstrip())
            row = indent
        row += item + ", "
    lines.append(row.rstrip())
    return "\n".join([opening, *lines, indent[4:] + closing])


class Writer:
    """Collects the parts of _abi.py, with one method per kind of declaration."""

    def __init__(self):
        self.types = Types()
        self.parts, self.structs, self.initialised = [], {}, []
        self.prototypes = {"BAUM_API": [], "BAUM_CATALOG_API": []}

    def opaque(self, name):
        self.types.handles.add(name)

    def struct(self, name, body):
        fields = [
            field
            for part in body.split(";")
            if part.strip()
            for field in declarators(self.types, part.strip(), in_struct=True)
        ]
        self.types.structs.add(name)
        self.structs[name] = fields
        lines = "\n".join(f'        ("{field}", {spelled}),' for field, spelled in fields)
        self.parts.append(f"\n\nclass {name}(Structure):\n    _fields_ = [\n{lines}\n    ]\n")

    def enumeration(self, name, body):
        self.types.enums.add(name)
        rows = [
            re.fullmatch(r"(\w+) = \(?(-?\d+)\)?", item.strip())
            for item in body.split(",")
            if item.strip()
        ]
        if not all(rows):
            raise SystemExit(f"not understood: values of {name}")
        lines = "\n".join(f"    {row[1]} = {row[2]}" for row in rows)
        self.parts.append(f"\n\nclass {name}(enum.IntEnum):\n{lines}\n")

    def callback(self, result, name, text):
        self.types.functions.add(name)
        spelled = [self.types.spell(result, 0), *arguments(self.types, text)]
        self._line(wrap(f"{name} = CFUNCTYPE(", spelled, ")"))

    def function(self, library, result, name, text):
        match = re.fullmatch(r"(?:const )?(\w+) ?(\**)", result.strip())
        if not match:
            raise SystemExit(f"not understood: result of {name}")
        spelled = self.types.spell(match[1], len(match[2]))
        self.prototypes[library].append(
            wrap(f'    "{name}": ({spelled}, [', arguments(self.types, text), "]),", " " * 8)
        )
        if name.endswith("_init"):
            self.initialised.append(name[: -len("_init")])

    def constant(self, kind, name, values):
        self._line(f"{name} = {kind}({values})")

    def _line(self, text):
        """Append a statement, after two empty lines if a class precedes it."""
        after_class = self.parts and "class " in self.parts[-1]
        self.parts.append(("\n\n" if after_class else "") + text + "\n")

    def module(self, version):
        """Return the whole text of _abi.py."""
        defaults = [f'    {name}: "{name}_init",' for name in self.initialised]
        structs = [f"    {name}," for name in self.structs]
        return "".join(
            [
                HEAD.format(version=version),
                f'\nVERSION = "{version}"\n',
                *self.parts,
                "\n\n# Result and argument types of every function.\nPROTOTYPES = {\n",
                "\n".join(self.prototypes["BAUM_API"]),
                "\n}\n",
                "\n# The same for the library of the catalogue.\nCATALOG_PROTOTYPES = {\n",
                "\n".join(self.prototypes["BAUM_CATALOG_API"]),
                "\n}\n",
                "\n# Structs that the caller fills, and the functions that set their defaults.\n",
                "DEFAULTS = {\n",
                "\n".join(defaults),
                "\n}\n",
                "\nSTRUCTS = [\n",
                "\n".join(structs),
                "\n]\n",
            ]
        )


RULES = [
    (r"typedef struct (\w+) \1", "opaque"),
    (r"typedef struct (\w+) \{(.*)\} \1", "struct"),
    (r"typedef enum (\w+) \{(.*)\} \1", "enumeration"),
    (r"typedef (\w+) (\w+)\((.*)\)", "callback"),
    (r"(BAUM_API|BAUM_CATALOG_API) (.*?)(\w+)\((.*)\)", "function"),
    (r"static const (\w+) (\w+) = \{(.*)\}", "constant"),
]


def translate(declaration, writer):
    """Call the method of the writer that matches a declaration."""
    for pattern, method in RULES:
        match = re.fullmatch(pattern, declaration)
        if match:
            getattr(writer, method)(*match.groups())
            return
    raise SystemExit(f"not understood: {declaration}")


def generate(include):
    """Return the texts of _abi.py and _records.py for the headers in `include`, by file name."""
    seen = set()
    text = "\n".join(
        read_headers(Path(include), f"baum/{name}.h", seen) for name in ("baum", "catalog")
    )
    version = re.search(r'#define BAUM_VERSION +"([^"]+)"', text)[1]
    writer = Writer()
    for declaration in split(strip(text)):
        translate(declaration, writer)
    records = [record(text, name, writer.structs[name][1:]) for name in RECORDS]
    return {"_abi.py": writer.module(version), "_records.py": "".join([RECORDS_HEAD, *records])}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("include", nargs="?", type=Path, default=ROOT / "include")
    parser.add_argument("folder", nargs="?", type=Path, default=FOLDER)
    parser.add_argument("--check", action="store_true", help="write nothing, fail on a change")
    options = parser.parse_args()
    for name, text in generate(options.include).items():
        output = options.folder / name
        if not options.check:
            output.write_text(text, encoding="utf-8")
        elif output.read_text(encoding="utf-8") != text:
            sys.exit(f"{output} is not what the headers give: run {Path(__file__).name}")


if __name__ == "__main__":
    main()
