# SPDX-License-Identifier: BSD-3-Clause
"""usage: reference.py XML FOLDER

Prepares the XML of Doxygen in the folder XML for Breathe. Writes the pages of the reference into FOLDER: one page for
each header of the library, and pages for the Python package. Sphinx fills these pages with the comments of the headers and with
the docstrings."""

import inspect
import re
import sys
from copy import deepcopy
from pathlib import Path
from xml.etree import ElementTree

import baum

ROOT = Path(__file__).resolve().parents[2]
# The order of the headers; headers that are not listed come last.
HEADERS = (
    "mechanism planar planar_joints spatial spatial_joints spatial_points spline breaks dynamics simulation events"
    " stabilization study sweep report draw scene catalog elements status version export baum"
)

# The macros that list statuses or fields, and what their columns contain. Doxygen does not expand them.
LISTS = {
    "BAUM_STATUS_LIST": ["status", "value", "meaning"],
    "BAUM_STUDY_ENTRY_LIST": ["type", "field", "known", "unit", "meaning"],
}

CLASSES = (
    "Mechanism Simulation Run Workspace Study Sweep Body Joint Force Input Channel View".split()
)
MODULES = ["inertia", "catalog", "typing"]


def about(header):
    """Return the comment at the beginning of a header, up to the first full stop."""
    text = (ROOT / "include" / "baum" / f"{header}.h").read_text(encoding="utf-8")
    found = re.search(r"@file\s*\n \*\s+(.*?)(?:\n \*\s*\n|\*/)", text, flags=re.S)
    first = re.sub(r"\s*\n \*\s*", " ", found[1]).strip() if found else ""
    return re.split(r"(?<=\.) (?=[A-Z]|\w+\.h)", first)[0]


def lists(header):
    """Return a section with a table for each macro of the header that is in LISTS."""
    text = (ROOT / "include" / "baum" / f"{header}.h").read_text(encoding="utf-8")
    out = ""
    for name, columns in LISTS.items():
        found = re.search(rf"#define {name}\(X\)(.*?[^\\])\n", text, flags=re.S)
        rows = re.findall(r"X\(([^\n]*)\)", found[1]) if found else []
        if found:
            out += f"\n## {name}\n\n| {' | '.join(columns)} |\n" + "|---" * len(columns) + "|\n"
        for row in rows:
            cells = [cell.strip().strip('"') for cell in row.split(",", len(columns) - 1)]
            cells = [f"`{c}`" if k in ("status", "type", "field") else c.replace("|", "\\|") for k, c in zip(columns, cells)]
            out += f"| {' | '.join(cells)} |\n"
    return out


def found_headers():
    return {path.stem for path in (ROOT / "include" / "baum").glob("*.h")}


def c_pages(folder):
    names = [name for name in HEADERS.split() if name in found_headers()]
    names += sorted(found_headers() - set(names))
    text = (
        "# C reference\n\nEach header of `include/baum` has a page with its comments, which give units and defaults. "
    )
    text += "`#include <baum/baum.h>` includes all of them except `catalog.h`.\n\n| header | contents |\n|---|---|\n"
    for name in names:
        text += f"| [{name}.h]({name}.md) | {about(name)} |\n"
        page = f"# {name}.h\n\n```{{doxygenfile}} {name}.h\n:project: baum\n```\n" + lists(name)
        (folder / f"{name}.md").write_text(page, encoding="utf-8")
    text += "\n```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n"
    (folder / "index.md").write_text(text, encoding="utf-8")


def directive(kind, name, *options):
    return (
        f"```{{eval-rst}}\n.. auto{kind}:: {name}\n"
        + "".join(f"   :{o}:\n" for o in options)
        + "```\n\n"
    )


def first_line(thing):
    return (inspect.getdoc(thing) or "").split("\n\n")[0].replace("\n", " ")


def python_pages(folder):
    text = "# Python reference\n\nIf you are new to the package, read the [introduction](../../bindings/python/README.md) first. "
    text += "These pages contain the docstrings, which `help()` also shows in Python.\n\n| page | contents |\n|---|---|\n"
    pages = []
    for name in CLASSES:
        one = getattr(baum, name)
        options = ("members", "inherited-members", "special-members: __getitem__")
        body = f"# {name}\n\n" + directive("class", f"baum.{name}", *options)
        pages.append((name, body, first_line(one)))
    others = [name for name in baum.__all__ if name not in CLASSES]
    functions = [name for name in others if inspect.isfunction(getattr(baum, name))]
    warned = [
        n
        for n in others
        if inspect.isclass(getattr(baum, n)) and issubclass(getattr(baum, n), BaseException)
    ]
    results = [n for n in others if inspect.isclass(getattr(baum, n)) and n not in warned]
    body = "# Functions\n\n" + "".join(directive("function", f"baum.{name}") for name in functions)
    pages.append(("functions", body, "Functions for gains, stability, studies, sweeps and scenes."))
    body = "# Results and outlines\n\n" + "".join(
        directive("class", f"baum.{name}") for name in results
    )
    pages.append(("results", body, "Named tuples that contain results, and classes for outlines of bodies."))
    body = "# Errors and warnings\n\n" + "".join(
        directive("class", f"baum.{name}") for name in warned
    )
    pages.append(("errors", body, "Exceptions, and one class for each kind of warning."))
    for name in MODULES:
        body = f"# baum.{name}\n\n" + directive("module", f"baum.{name}", "members")
        pages.append((name, body, first_line(__import__(f"baum.{name}", fromlist=["x"]))))
    for name, body, line in pages:
        text += f"| [{name}]({name}.md) | {line} |\n"
        (folder / f"{name}.md").write_text(body, encoding="utf-8")
    text += "\n```{toctree}\n:hidden:\n\n" + "\n".join(name for name, _, _ in pages) + "\n```\n"
    (folder / "index.md").write_text(text, encoding="utf-8")


def prepare(path):
    """Change an XML file for Breathe. Breathe cannot show two parameters with one description, so each parameter gets a copy
    of the description. Macros that a header undefines at its end are omitted."""
    tree = ElementTree.parse(path)
    for found in tree.iterfind(".//parameterlist"):
        items = list(found)
        for item in items:
            found.remove(item)
            for names in item.findall("parameternamelist"):
                for name in names.findall("parametername"):
                    one = deepcopy(item)
                    for other in one.findall("parameternamelist")[1:]:
                        one.remove(other)
                    kept = one.find("parameternamelist")
                    for other in list(kept):
                        kept.remove(other)
                    kept.append(deepcopy(name))
                    found.append(one)
    for section in tree.iterfind(".//sectiondef"):
        for member in section.findall("memberdef"):
            if member.findtext("name") == "BAUM_X":
                section.remove(member)
    tree.write(path, encoding="utf-8", xml_declaration=True)


def main():
    for path in Path(sys.argv[1]).glob("*_8h.xml"):
        prepare(path)
    for name, write in (("c", c_pages), ("python", python_pages)):
        folder = Path(sys.argv[2]) / name
        folder.mkdir(parents=True, exist_ok=True)
        write(folder)


if __name__ == "__main__":
    main()
