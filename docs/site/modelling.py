# SPDX-License-Identifier: BSD-3-Clause
"""usage: modelling.py XML FOLDER PICTURES

Writes the pages of the part Modelling into FOLDER, one for each kind of element, and copies their pictures into PICTURES. A page
takes its picture and its Python code from tests/browser/scenes.py, its equation from docs/catalogue.md, its fields from the
comments of the headers (XML is the output of Doxygen), and its section on mistakes from elements.md."""

import ast
import inspect
import re
import sys
import warnings
import xml.etree.ElementTree as ET
from pathlib import Path

import baum
import numpy as np
from baum.definitions import KINDS
from element_code import as_function, c_code, check_c, methods, python_code

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "browser"))
import scenes  # noqa: E402


def kinds(family, start=""):
    return [n for n, k in KINDS.items() if k.family == family and n.startswith(start)]


GROUPS = {
    "Bodies": kinds("body"),
    "Joints in the plane": kinds("joint", "planar"),
    "Joints in space": kinds("joint", "spatial"),
    "Couplings, drivers and constraints of your own": "coupling driver spline_driver user_constraint".split(),
    "Forces": kinds("force"),
}
# For kinds whose row in docs/catalogue.md does not begin with their name: the beginning of this row.
ROWS = {
    "planar_revolute": "revolute (pin)",
    "planar_translational": "translational",
    "planar_distance": "distance (massless",
    "planar_fixed": "fixed (weld)",
    "planar_pin_in_slot": "pin in a slot",
    "planar_gear": "gear pair",
    "planar_curve": "point on a curve",
    "spatial_curve": "point on a curve",
    "driver": "driver, mechanism.h",
    "spline_driver": "spline driver, spline.h",
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
PAIRS = "revolute translational fixed spherical universal cylindrical prismatic planar screw constant_velocity distance"
NAMED_JOINT = {f"{where}_{pair}" for where in ("planar", "spatial") for pair in PAIRS.split()}
# The beginnings of the texts of docs/catalogue.md that explain symbols, and patterns of the equations that need them.
BODIES = r"\b(angle|p|r|[xyz])_[ab]\b|\bd\b"
SYMBOLS = {
    "In the equations": BODIES,
    "The index c": r"_c\b",
    "One of the bodies": BODIES,
    "p is": r"\bp_[ab]\b|\bd\b",
    "e is": r"\be\b",
    "n is": r"\bn\b",
    "A dot": r"\w\.\w",
    "l is": r"\bl\^2",
    "r is": r"\br\b",
    "r_a and": r"\br_a\b",
    "A joint in space": r"\b[xyz]_[ab]\b",
    "z_a is": r"^(?!d; x_a\.y_b).*\b[xyz]_[ab]\b",  # all except welds
    "z_b is": r"^(?!d; x_a\.y_b).*\b[xyz]_b\b",
    "The directions": r"\b[xy]_[ab]\.[xyz]_b",
}
VELOCITY_LEVEL = ("planar_knife_edge", "spatial_knife_edge", "spatial_rolling_disc", "user_constraint")
CHANNELS = """pose velocity acceleration coordinate displacement angle angle_b x y reaction effort multipliers phi
 phi_rate""".split()
# What the channels are called in C. All other channels are BAUM_JOINT_COORDINATE.
QUANTITIES = {"pose": "BAUM_BODY_POSE", "velocity": "BAUM_BODY_VELOCITY", "acceleration": "BAUM_BODY_ACCELERATION"}
QUANTITIES |= {"reaction": "BAUM_JOINT_REACTION", "effort": "BAUM_DRIVE_EFFORT", "multipliers": "BAUM_LAMBDA"}
QUANTITIES |= {"phi": "BAUM_PHI", "phi_rate": "BAUM_PHI_RATE"}


def equations():
    """Return all rows of the tables of the catalogue: the first cell of a row is the key, its other cells are the value."""
    text = (ROOT / "docs" / "catalogue.md").read_text(encoding="utf-8")
    rows = [
        [cell.strip() for cell in line.strip("|").split(" | ")]
        for line in text.splitlines()
        if line.startswith("|")
    ]
    return {cells[0]: cells[1:] for cells in rows}


def symbols(cells):
    """Return the parts of the catalogue that explain the symbols of an equation."""
    text = (ROOT / "docs" / "catalogue.md").read_text(encoding="utf-8")
    found = re.findall(r"^(?:In the equations|A joint in space).*?\n\n", text, flags=re.M | re.S)
    parts = re.split(r"(?<=\.) ", re.sub(r"\s+", " ", "".join(found)).strip())
    equation = " ".join(cells)
    kept = [
        one
        for one in parts
        for start, pattern in SYMBOLS.items()
        if one.startswith(start) and re.search(pattern, equation)
    ]
    return " ".join(kept).replace("](space.md", "](../docs/space.md") + ("\n\n" if kept else "")


def row_of(name, rows):
    plain = re.sub("^(spatial|planar)_", "", name).replace("_", " ")
    start = f"`baum_{name}_def`" if KINDS[name].family == "body" else ROWS.get(name, plain)
    found = [cells for first, cells in rows.items() if first.startswith(start)]
    if not found:
        sys.exit(f"modelling.py: docs/catalogue.md has no row for {name}")
    return found[-1 if name.startswith("spatial") else 0]


def written():
    """Return the sections of elements.md: for each kind its text, and its code by language (python, c)."""
    sections = (ROOT / "docs" / "site" / "elements.md").read_text(encoding="utf-8").split("\n## ")[1:]
    found = {}
    for section in sections:
        name, text = section.split("\n", 1)
        code = {language: block for language, block in re.findall(r"```(\w+)\n(.*?)```", text, flags=re.S)}
        found[name] = re.sub(r"```.*?```\n", "", text, flags=re.S).strip(), code
    return found


def text_of(part):
    """Return the text of a comment, with names in backticks, so that the site does not typeset them as mathematics."""
    for code in part.iter("computeroutput"):
        code.text = f"`{''.join(code.itertext())}`"
        for child in list(code):
            code.remove(child)
    return "".join(part.itertext()).strip()


def fields(xml, name):
    """Return the table of the fields of a definition, from the comments of the header."""
    root = ET.parse(xml / f"structbaum__{name.replace('_', '__')}__def.xml").getroot()
    text = "| field | type | unit, default, meaning |\n|---|---|---|\n"
    for member in root.iter("memberdef"):
        field = member.findtext("name")
        if field in ("struct_size", "name"):
            continue
        type_ = "".join(member.find("type").itertext()) + (member.findtext("argsstring") or "")
        about = " ".join(text_of(member.find(part)) for part in ("briefdescription", "detaileddescription"))
        about = re.sub(r"\s+", " ", about).replace("|", "\\|").strip()
        type_ = type_.strip()
        type_ = f"{{c:type}}`{type_[:-2]}` \\*" if type_.endswith("_fn *") else f"`{type_}`"
        text += f"| `{field}` | {type_} | {about} |\n"
    return text


def channels(m, element):
    """Return the channels of an element that a run can record, with their sizes."""
    m.freeze()
    found = []
    for channel in CHANNELS:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                run = m.simulate([0.0], "rk4", step=1e-3, record=[f"{element.name}.{channel}"])
        except (baum.Error, KeyError):
            continue
        found.append(f"`{channel}` ({np.size(run[f'{element.name}.{channel}'][0])})")
    return found


def uses(method):
    """Return links to the recipes and examples that call a method of Mechanism."""
    pages = [(path, f"../docs/cookbook/{path.name}") for path in sorted((ROOT / "docs" / "cookbook").glob("*.md"))]
    pages += [(path, f"../gallery/{path.stem}.md") for path in sorted((ROOT / "examples").glob("*.py"))]
    links = []
    for path, link in pages:
        text = path.read_text(encoding="utf-8")
        if f".{method}(" in text and path.stem not in ("warnings", "animation"):
            title = text.split("\n")[0].lstrip("# ") if path.suffix == ".md" else f"examples/{path.name}"
            links.append(f"[{title}]({link})")
    return links[:8]


def about_of(method):
    return inspect.getdoc(getattr(baum.Mechanism, method)).split("\n\n")[0].replace("\n", " ")


def about_channels(name, found):
    """Return the explanations of the channels of an element."""
    if KINDS[name].family == "body":
        rotates = name in ("planar_body", "spatial_body")
        turn = {"planar_body": " and the angle", "spatial_body": " and the quaternion"}.get(name, "")
        return (
            f" `pose` contains the position of the centre of mass{turn}. `velocity` contains the velocity of the centre of mass"
            f"{' and the angular velocity' if rotates else ''}{', both in ground axes' if name == 'spatial_body' else ''}."
            " `acceleration` contains the time derivative of `velocity`."
        )
    text = ""
    if "`coordinate` (2)" in found:
        first = KINDS[name].coordinates[0]
        text = f" `coordinate` and `{first}` are two names of the same quantity. Each coordinate is recorded with its time"
        text += " derivative."
    if name in ("planar_gear", "coupling", "user_constraint"):
        text += " `reaction` contains the generalized force of the rows, with one number for each velocity of the bodies."
    elif "driver" in name:
        text += " `reaction` contains the force and the moment that the driver exerts on body_b of its joint."
    else:
        text += " `reaction` contains the force and the moment on body_b."
    text += " `effort` is the force or torque of the driver." if "`effort` (1)" in found else ""
    return text + (
        " `multipliers` contains the Lagrange multipliers of the rows, `phi` the violations of the rows, and `phi_rate` the time"
        " derivatives of these violations."
    ) + (" A row of velocity level has `phi` = 0; its violation is `phi_rate`." if name in VELOCITY_LEVEL else "")


class Page:
    def __init__(self, name, method, cells, section):
        self.name, self.method, self.cells = name, method, cells
        self.kind = KINDS[name]
        self.mistake, self.code = section
        self.title = name.replace("_", " ").capitalize() + (" joint" if name in NAMED_JOINT else "")
        group = scenes.SPACE if name in scenes.SPACE else scenes.PLANE
        self.scene = group.get(name)
        self.m = scenes.build(group, name) if self.scene else None
        if self.m:
            self.element = [one for one in self.m if one.kind and one.kind.name == name][-1]

    def programs(self):
        """Return the Python and the C code."""
        python = self.code.get("python") or python_code(self.scene, self.method)
        if "python" in self.code:
            m = baum.Mechanism()
            exec(python, {"m": m, "np": np})
            m.freeze()
        if "c" in self.code:
            check_c([self.code["c"]])
            return python, self.code["c"]
        block, used = c_code(self.m, self.element)
        check_c([as_function("add", block, used)])
        return python, block

    def text(self, folder, xml):
        about = about_of(self.method)
        text = f"# {self.title}\n\n"
        if self.m:
            self.m.draw().save(folder / f"{self.name}.svg")
            text += f"![{self.title}]({self.name}.svg)\n\n"
        text += (about.replace("Add a", "A", 1) if about.startswith("Add a") else about) + "\n\n"
        text += self.equations()
        python, c = self.programs()
        text += f"## Code\n\n```python\n{python}```\n\n```c\n{c}```\n\n"
        text += "In this code, `m` in Python and `mechanism` in C is the mechanism. Bodies and joints that the code names but "
        text += "does not add were added before.\n\n"
        text += f"## What goes wrong\n\n{self.mistake}\n\n"
        table = fields(xml, self.name)
        text += f"## Fields\n\nThe table lists the fields of the C struct `baum_{self.name}_def`. {self.arguments(table)}"
        text += " Fields that are not set keep their defaults. Units are in brackets, where [-] means a pure number."
        shape = re.search(r"\| (\([a-z_]+\)) ", table)
        if shape:
            text += f" An entry that begins with a name in parentheses, such as {shape[1]}, is an array with that number of"
            text += " elements."
        text += f"\n\n{table}\n"
        found = channels(self.m, self.element) if self.m and self.kind.family != "force" else []
        if found:
            first = f'record=["{self.element.name}.{found[0][1:].split("`")[0]}"]'
            text += "## What a run can record\n\nThe argument `record` of {py:meth}`baum.Mechanism.simulate` names the "
            text += f"quantities that a run records, as in `{first}`. After the dot stands one of the following names. "
            text += f"The number in parentheses is the number of values of this quantity: {', '.join(found)}."
            text += about_channels(self.name, found) + "\n\n"
            text += self.in_c(found)
        links = uses(self.method)
        text += f"Used in: {'; '.join(links)}.\n\n" if links else ""
        return text + f"Reference: {{py:meth}}`baum.Mechanism.{self.method}`, {{c:struct}}`baum_{self.name}_def`.\n"

    def arguments(self, table):
        """Return what the arguments of the Python method are called."""
        known = inspect.signature(getattr(baum.Mechanism, self.method)).parameters
        absent = [name for name in re.findall(r"^\| `(\w+)`", table, flags=re.M) if name not in known]
        text = "The arguments of the Python method have the same names as these fields."
        for name in absent:
            if name == "row_count":
                text += " The argument for `row_count` is `rows`."
            elif name == "point":
                text += " The method has no argument `point`."
            elif name.endswith("count"):
                text += f" The method has no argument `{name}`, because it takes this number from the lengths of its lists."
            else:
                sys.exit(f"modelling.py: Mechanism.{self.method} has no argument {name}")
        return text

    def in_c(self, found):
        """Return how C names the channels of the element."""
        quantities = [QUANTITIES.get(one[1:].split("`")[0], "BAUM_JOINT_COORDINATE") for one in found]
        names = ", ".join(f"`{name}`" for name in dict.fromkeys(quantities))
        of = "body" if self.kind.family == "body" else "joint"
        text = f"In C, {{c:func}}`baum_channel_of_{of}` makes a channel of one of these quantities: {names}."
        if any(f"`{one}`" in " ".join(found) for one in ("angle_b", "x", "displacement")):
            text += " The field `coordinate` of the channel selects the coordinate."
        return text + "\n\n"

    def equations(self):
        what = {"body": "Coordinates", "joint": "Rows Φ = 0", "force": "Acts with"}[self.kind.family]
        what = "Prescribed coordinate s(t)" if "driver" in self.name else what
        text = f"**{what}:** {self.cells[0]}\n\n"
        if self.kind.family == "joint" and len(self.cells) > 2:
            coordinate = "none" if self.cells[1] == "-" else self.cells[1]
            text += f"**Coordinate:** {coordinate}. **Degrees of freedom removed:** {self.cells[2]}.\n\n"
        explained = self.kind.family == "joint" or self.name in ("planar_spring", "spatial_spring")
        return text + symbols(self.cells) if explained else text


def main():
    xml, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    pictures = Path(sys.argv[3])
    pictures.mkdir(parents=True, exist_ok=True)
    added, rows, sections = methods(), equations(), written()
    if sections.keys() != KINDS.keys():
        sys.exit(f"modelling.py: elements.md and the kinds of elements differ: {sections.keys() ^ KINDS.keys()}")
    index = "# Elements\n\nEvery kind of element has a page with its equation, code in Python and C, and its fields. "
    index += "Every page except that of the user coordinates has a picture.\n"
    names = []
    for group, members in GROUPS.items():
        index += f'\n## {group}\n\n```{{raw}} html\n<div class="cards">\n'
        for name in members:
            page = Page(name, added[name], row_of(name, rows), sections[name])
            (folder / f"{name}.md").write_text(page.text(folder, xml), encoding="utf-8")
            image = ""
            if page.m:
                (pictures / f"{name}.svg").write_bytes((folder / f"{name}.svg").read_bytes())
                image = f'<img src="pictures/{name}.svg" alt="">'
            index += f'<a href="{name}.html">{image}{page.title}</a>\n'
        index += "</div>\n```\n"
        names += members
    index += "\n```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n"
    (folder / "index.md").write_text(index, encoding="utf-8")
    print(f"{len(names)} pages of elements, with C code that compiles")


if __name__ == "__main__":
    main()
