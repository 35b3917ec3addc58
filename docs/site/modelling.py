# SPDX-License-Identifier: BSD-3-Clause
"""usage: modelling.py FOLDER

Writes the pages of the part Modelling: every kind of element with its picture, its equation, and code in Python and C.
The pictures and the Python code are those of tests/browser/scenes.py, the equations those of docs/catalogue.md. The C
code sets the fields in which the definition of the scene differs from the default; a compiler checks it."""

import ast
import ctypes
import inspect
import math
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import baum
from baum import adding, adding_space
from baum.definitions import KINDS

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "browser"))
import scenes  # noqa: E402

PAGES = {
    "bodies": (
        "Bodies",
        [name for name, kind in KINDS.items() if kind.family == "body" and name != "coordinates"],
    ),
    "planar": (
        "Joints in the plane",
        [n for n, k in KINDS.items() if k.family == "joint" and n.startswith("planar")],
    ),
    "spatial": (
        "Joints in space",
        [n for n, k in KINDS.items() if k.family == "joint" and n.startswith("spatial")],
    ),
    "general": (
        "Couplings, drivers and constraints of your own",
        "coupling driver spline_driver user_constraint".split(),
    ),
    "forces": ("Forces", [name for name, kind in KINDS.items() if kind.family == "force"]),
}
# The beginning of the row in docs/catalogue.md, for kinds whose name does not give it.
ROWS = {
    "planar_revolute": "revolute (pin)",
    "planar_translational": "translational",
    "planar_distance": "distance (massless",
    "planar_fixed": "fixed (weld)",
    "planar_pin_in_slot": "pin in a slot",
    "planar_gear": "gear pair",
    "planar_curve": "point on a curve",
    "spatial_curve": "point on a curve",
    "spatial_point_on_line": "point on a line",
    "spatial_point_on_plane": "point on a plane",
    "planar_spring": "spring-damper, planar.h",
    "planar_torsion_spring": "torsion spring-damper, planar.h",
    "planar_load": "load, planar.h",
    "spatial_spring": "spring-damper, spatial.h",
    "spatial_torsion_spring": "torsion spring-damper, spatial.h",
    "spatial_load": "load, spatial.h",
    "joint_spring": "joint spring-damper",
}
MISTAKES = {
    "planar_body": "The origin of a body is its centre of mass. Points of joints on the body count from there. A body whose joints "
    "are given by `point_a` and `point_b` needs a design position and an angle near the assembled ones.",
    "planar_particle": "A particle does not rotate, so it has no points besides itself: `point_b` must be (0, 0).",
    "spatial_body": "`inertia` is about the centre of mass and in body axes; [Space](../docs/space.md#conventions) lists all "
    "conventions. Three equal placeholders such as (1, 1, 1) make a small body far too hard to rotate.",
    "planar_revolute": "A joint that is given by `point_a` and `point_b` is open in the design configuration if the positions of the "
    "bodies do not fit. [Drawings](../docs/drawings.md#find-a-mistake) show this by a red line.",
    "planar_translational": "The coordinate is the displacement from body_a's point to body_b's point. It is not 0 in the design "
    "configuration unless both points coincide there.",
    "planar_distance": "The length must not be 0. Two points that coincide are a revolute joint. A distance is a rod: it also "
    "pushes. A rope that can hang loose is a spring with a law.",
    "planar_fixed": "A weld of two moving bodies costs six rows and three coordinates. One body with the combined mass is cheaper.",
    "planar_pin_in_slot": "The slot has no ends. For ends, see [One-sided stop](../docs/cookbook/stop.md).",
    "planar_gear": "Gears do not hold their centres; revolute joints must do this. With a moving carrier, name it.",
    "planar_rack_and_pinion": "The sign of the radius determines the side on which the rack touches the pinion.",
    "planar_curve": "The gradient of F should have a length of about 1 near the curve, because tolerances treat F as a distance.",
    "spatial_revolute": "Two hinges on one door are redundant ([Warnings](../docs/cookbook/warnings.md#1-redundant_rows)).",
    "spatial_universal": "`axis_b` has no default, and must be perpendicular to `axis`. The joint has no constant transmission ratio; "
    "a constant-velocity joint has.",
    "spatial_spherical": "A spherical joint has no coordinates, so it takes neither drivers nor joint springs. Use a universal joint "
    "and a revolute joint in series.",
    "spatial_fixed": "As in the plane, one body with the combined mass is cheaper than a weld.",
    "spatial_rolling_disc": "The contact never slips or lifts off. Look at the sign of the normal force.",
    "coupling": "`offset` is by default the value in the design configuration. A law must give its exact derivatives.",
    "driver": "A driver and initial velocities that contradict each other are refused. Leave the velocities free.",
    "planar_spring": "`free_length` is by default the length in the design configuration, so the spring has no force there.",
    "planar_load": "`force` keeps its direction in ground axes, unless `follows_body` is true. `point` is in body axes in any case.",
    "joint_spring": "`free_value` is by default the value in the design configuration. Hard dampers and stops are stiff: use "
    "`cvode_bdf` ([Friction](../docs/cookbook/friction.md)).",
    "user_force": "A function that returns a force in another order than the velocities of its bodies gives a wrong motion without "
    "any warning.",
}


def methods():
    """Return the name of the method of Mechanism that adds each kind."""
    found = {}
    for module in (adding, adding_space):
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.FunctionDef):
                for kind in re.findall(
                    r'self\._add\w*\([^"]*"(\w+)"', ast.unparse(node).replace("'", '"')
                ):
                    if kind in KINDS:
                        found[kind] = node.name
    return found


def equations():
    """Return the cells of all tables of the catalogue, by their first cell."""
    text = (ROOT / "docs" / "catalogue.md").read_text(encoding="utf-8")
    rows = [
        [cell.strip() for cell in line.strip("|").split(" | ")]
        for line in text.splitlines()
        if line.startswith("|")
    ]
    return {cells[0]: cells[1:] for cells in rows}


def row_of(name, rows):
    plain = re.sub("^(spatial|planar)_", "", name).replace("_", " ")
    start = f"`baum_{name}_def`" if KINDS[name].family == "body" else ROWS.get(name, plain)
    found = [cells for first, cells in rows.items() if first.startswith(start)]
    if not found:
        sys.exit(f"modelling.py: docs/catalogue.md has no row for {name}")
    return found[-1 if name.startswith("spatial") else 0]


def python_code(scene, method):
    """Return the statements of a scene that add the element."""
    source = textwrap.dedent(inspect.getsource(scene))
    body = ast.parse(source).body[0].body
    chosen = [
        ast.get_source_segment(source, node, padded=True)
        for node in body
        if f"m.{method}(" in ast.unparse(node)
    ]
    return "\n".join(textwrap.dedent(text) for text in chosen) + "\n"


def number(value):
    return f"{value:.6g}" if "." in f"{value:.6g}" or "e" in f"{value:.6g}" else f"{value:.6g}.0"


def c_name(name):
    return re.sub(r"\W", "_", name)


def c_code(m, element):
    """Return C that adds an element of a mechanism, and the ids that it uses."""
    kind = KINDS[element.kind.name]
    struct, plain = kind.struct(), kind.struct()
    kind.function("get")(m.handle, element.id, ctypes.byref(struct), ctypes.sizeof(struct))
    getattr(baum._lib.lib, f"baum_{kind.name}_def_init")(ctypes.byref(plain), ctypes.sizeof(plain))
    lines, used = (
        [
            f"baum_{kind.name}_def def = baum_{kind.name}_def_default();",
            f'def.name = "{element.name}";',
        ],
        [],
    )
    for field, type_, *_ in struct._fields_[2:]:
        value, default = getattr(struct, field), getattr(plain, field)
        family = type_.__name__.removeprefix("baum_").removesuffix("_id")
        if family in ("body", "joint", "input", "force") and bytes(value) != bytes(default):
            name = "BAUM_GROUND" if value.index1 == -1 else c_name(m.find(family, value).name)
            used += [] if value.index1 == -1 else [(family, name)]
            lines.append(f"def.{field} = {name};")
        elif isinstance(value, ctypes.Array) and bytes(value) != bytes(default):
            if all(isinstance(one, float) for one in value):
                pairs = [(k, x) for k, x in enumerate(value) if not math.isnan(x)]
                lines += [f"def.{field}[{k}] = {number(x)};" for k, x in pairs if x != default[k]]
        elif isinstance(value, float) and value != default and not math.isnan(value):
            lines.append(f"def.{field} = {number(value)};")
        elif isinstance(value, (bool, int)) and value != default and type_ is not ctypes.c_void_p:
            lines.append(f"def.{field} = {str(value).lower()};")
    receiver = {"body": "body", "joint": "joint", "force": "force"}[kind.family]
    lines += [
        f"baum_{receiver}_id id;",
        f"status = baum_mechanism_add_{kind.name}(mechanism, &def, &id);",
    ]
    return "\n".join(lines) + "\n", used


# Kinds whose definitions contain functions or arrays: the tutorial and the cookbook have complete programs.
NO_C = {"planar_curve", "spatial_curve", "user_constraint", "user_force", "spline_driver"}


def compiles(blocks):
    """Check that the C blocks compile with the public headers."""
    text = "#include <baum/baum.h>\n"
    for k, (block, used) in enumerate(blocks):
        ids = "".join(f", baum_{family}_id {name}" for family, name in dict.fromkeys(used))
        text += f"baum_status f{k}(baum_mechanism *mechanism{ids});\n"
        text += f"baum_status f{k}(baum_mechanism *mechanism{ids})\n{{\nbaum_status status;\n{block}return status;\n}}\n"
    command = [
        "cc",
        "-std=c11",
        "-Wall",
        "-Werror",
        "-fsyntax-only",
        f"-I{ROOT / 'include'}",
        "-x",
        "c",
        "-",
    ]
    done = subprocess.run(command, input=text, text=True, capture_output=True)
    if done.returncode:
        sys.exit(f"modelling.py: C code does not compile\n{done.stderr}")


def entry(folder, name, method, cells, blocks):
    kind = KINDS[name]
    if name not in {**scenes.PLANE, **scenes.SPACE}:
        sys.exit(f"modelling.py: tests/browser/scenes.py has no scene for {name}")
    group = scenes.SPACE if name in scenes.SPACE else scenes.PLANE
    m = scenes.build(group, name)
    m.draw().save(folder / f"{name}.svg")
    element = [one for one in m if one.kind and one.kind.name == name][-1]
    about = inspect.getdoc(getattr(baum.Mechanism, method)).split("\n\n")[0].replace("\n", " ")
    what = {"body": "Coordinates", "joint": "Rows Phi = 0", "force": "Acts with"}[kind.family]
    what = "s(t)" if "driver" in name else what
    text = f"## {method}\n\n![{name}]({name}.svg)\n\n{about.replace('Add a', 'A', 1) if about.startswith('Add a') else about}\n\n"
    text += f"**{what}:** {cells[0]}\n\n"
    if kind.family == "joint" and len(cells) > 2:
        coordinate = "none" if cells[1] == "-" else cells[1]
        text += f"**Coordinate:** {coordinate}. **Degrees of freedom removed:** {cells[2]}.\n\n"
    text += f"```python\n{python_code(group[name], method)}```\n\n"
    if name not in NO_C:
        block, used = c_code(m, element)
        blocks.append((block, used))
        text += f"```c\n{block}```\n\n"
    if name in MISTAKES:
        text += f"**What goes wrong.** {MISTAKES[name]}\n\n"
    text += f"Reference: {{py:meth}}`baum.Mechanism.{method}`, {{c:struct}}`baum_{name}_def`.\n\n"
    return text


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    added, rows, blocks = methods(), equations(), []
    index = "# Elements with pictures\n\nEvery kind of element with its picture, its equation, and code in Python and C. "
    index += "[The catalogue](../docs/catalogue.md) explains the symbols of the equations. In the code, `a`, `b` and `arm` are bodies, "
    index += "and the numbers are those of the picture.\n\n"
    for page, (title, kinds) in PAGES.items():
        body = "".join(
            entry(folder, name, added[name], row_of(name, rows), blocks) for name in kinds
        )
        (folder / f"{page}.md").write_text(f"# {title}\n\n{body}", encoding="utf-8")
        index += (
            f"- [{title}]({page}.md): "
            + ", ".join(f"[{added[n]}]({page}.md#{added[n]})" for n in kinds)
            + "\n"
        )
    compiles(blocks)
    index += "\n```{toctree}\n:hidden:\n\n" + "\n".join(PAGES) + "\n```\n"
    (folder / "index.md").write_text(index, encoding="utf-8")
    print(
        f"{sum(len(kinds) for _, kinds in PAGES.values())} kinds of elements, {len(blocks)} blocks of C compiled"
    )


if __name__ == "__main__":
    main()
