# SPDX-License-Identifier: BSD-3-Clause
"""Write docs/scene.schema.json, the JSON schema of scenes, from the public headers.

usage: generate_schema.py [--check] [INCLUDE_DIR [FILE]]

--check writes nothing and fails if the output would change.
"""

import argparse
import json
import re
import sys
from pathlib import Path

from generate_abi import ROOT, Writer, field_comments, read_headers, split, strip, translate

LISTS = {"body": "bodies", "joint": "joints", "force": "forces"}
COUNT = {"type": "integer", "minimum": 0}
NUMBER = {"type": ["number", "null"], "description": "null: not given."}
NAME = {"type": "string", "minLength": 1}
ELEMENT = {
    "type": ["string", "integer"],
    "minimum": 0,
    "description": 'The name of the element, or its number from 0. The body "ground" is fixed.',
}


def reference(name):
    return {"$ref": f"#/$defs/{name}"}


def numbers(count=None):
    """Return the schema of a list of `count` numbers, or of any length if no count is given."""
    size = {} if count is None else {"minItems": count, "maxItems": count}
    return {"type": "array", "items": reference("number"), **size}


def property_of(field, spelled):
    """Return the schema of a field. spelled: the ctypes type of the field, as text."""
    size = re.fullmatch(r"c_double \* (\d+)", spelled)
    if size:
        return numbers(int(size[1]))
    if field == "user" or spelled.endswith("_fn"):
        return dict(NAME)
    if field.startswith("coordinate"):
        return reference("coordinate")
    known = {
        "c_double": reference("number"),
        "c_void_p": numbers(),
        "c_bool": {"type": "boolean"},
        "c_int32": dict(COUNT),
        "baum_body_id": reference("element"),
        "baum_joint_id": reference("element"),
        "baum_input_id": dict(COUNT),
        "POINTER(baum_body_id)": {"type": "array", "items": reference("element")},
    }
    if spelled not in known:
        raise SystemExit(f"not understood: {field} of type {spelled}")
    return known[spelled]


def kind_of(text, name, family, fields):
    """Return the schema of the elements of one kind, such as spatial_spring."""
    comments = field_comments(text, f"baum_{name}_def")
    properties = {"kind": {"const": name}, "name": dict(NAME)}
    for field, spelled in fields:
        if field not in ("struct_size", "name"):
            said = {"description": comments[field]} if field in comments else {}
            properties[field] = {**property_of(field, spelled), **said}
    if family == "body":
        properties["outlines"] = reference("outlines")
    return closed(properties, ["kind"])


def closed(properties, required):
    """Return the schema of an object that has these keys and no others."""
    return {
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": False,
    }


def outlines():
    """Return the schema of a list of outlines."""
    corners = {"type": "array", "items": {"type": "integer"}, "minItems": 3, "maxItems": 3}
    properties = {
        "form": {"enum": ["polygon", "circle", "box", "cylinder", "sphere", "mesh"]},
        "points": {"type": "array", "items": numbers(3)},
        "triangles": {"type": "array", "items": corners},
        **{name: numbers(3) for name in ("center", "size", "start", "end")},
        "radius": reference("number"),
        "color": {"type": "string"},
    }
    return {"type": "array", "items": closed(properties, ["form"])}


def generate(include, kinds):
    """Return the schema for the headers in `include` and the list of kinds in kinds.h."""
    text = read_headers(include)
    writer = Writer()
    for declaration in split(strip(text)):
        translate(declaration, writer)
    names = re.findall(r"BAUM_COORDINATE_(\w+) =", text)
    made = {
        "number": NUMBER,
        "element": ELEMENT,
        "coordinate": {"enum": [name.lower() for name in names if name != "FIRST"]},
        "outlines": outlines(),
    }
    families = {family: [] for family in LISTS}
    for family, name in re.findall(r"KIND\((\w+), (\w+)\)", kinds.read_text(encoding="utf-8")):
        if family in families:
            made[name] = kind_of(text, name, family, writer.structs[f"baum_{name}_def"])
            families[family].append(reference(name))
    top = {
        "baum_scene": {"const": 1, "description": "The version of the format."},
        "units": {"type": "string", "description": "A note on the units, which baum ignores."},
        "gravity": numbers(3),
        "characteristic_length": reference("number"),
        "break_times": numbers(),
        "ground_outlines": reference("outlines"),
        "inputs": {
            "type": "array",
            "items": closed({"name": NAME, "initial": {"type": "number"}}, ["name", "initial"]),
        },
    }
    for family, key in LISTS.items():
        top[key] = {"type": "array", "items": {"oneOf": families[family]}}
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "A scene of baum"}
    return {**head, **closed(top, ["baum_scene"]), "$defs": made}


def lines(value, indent=0, width=100):
    """Return JSON text. Every list and object that fits into one line is written on one line."""
    text = json.dumps(value)
    if indent + len(text) <= width or not isinstance(value, (list, dict)):
        return text
    pad = "\n" + " " * (indent + 1)
    if isinstance(value, list):
        return "[" + ",".join(pad + lines(one, indent + 1) for one in value) + "]"
    keys = [json.dumps(key) + ": " + lines(one, indent + 1) for key, one in value.items()]
    return "{" + ",".join(pad + key for key in keys) + "}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("include", nargs="?", type=Path, default=ROOT / "include")
    parser.add_argument("file", nargs="?", type=Path, default=ROOT / "docs" / "scene.schema.json")
    parser.add_argument("--check", action="store_true", help="write nothing, fail on a change")
    options = parser.parse_args()
    schema = generate(options.include, ROOT / "src" / "mechanism" / "kinds.h")
    text = lines(schema) + "\n"
    if not options.check:
        options.file.write_text(text, encoding="utf-8")
    elif options.file.read_text(encoding="utf-8") != text:
        sys.exit(f"{options.file} is not what the headers give: run {Path(__file__).name}")


if __name__ == "__main__":
    main()
