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
CHANNELS = """pose velocity acceleration coordinate displacement angle angle_b x y reaction effort multipliers phi
 phi_rate""".split()


def equations():
    """Return all rows of the tables of the catalogue: the first cell of a row is the key, its other cells are the value."""
    text = (ROOT / "docs" / "catalogue.md").read_text(encoding="utf-8")
    rows = [
        [cell.strip() for cell in line.strip("|").split(" | ")]
        for line in text.splitlines()
        if line.startswith("|")
    ]
    return {cells[0]: cells[1:] for cells in rows}


def symbols(name):
    """Return the paragraph of the catalogue that explains the symbols of an equation."""
    text = (ROOT / "docs" / "catalogue.md").read_text(encoding="utf-8")
    start = r"A joint in space" if name in kinds("joint", "spatial") else r"In the equations, the indices"
    found = re.search(rf"^{start}.*?\n\n", text, flags=re.M | re.S)[0]
    found = found if name == "planar_gear" else found.replace(", and c to the carrier", "").replace(" One of these bodies", " One of them")
    return re.sub(r" The last column .*?\n\n", "\n\n", found, flags=re.S).replace("](space.md", "](../docs/space.md").replace(
        "In the table, ", ""
    )


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


def fields(xml, name):
    """Return the table of the fields of a definition, from the comments of the header."""
    root = ET.parse(xml / f"structbaum__{name.replace('_', '__')}__def.xml").getroot()
    text = "| field | type | unit, default, meaning |\n|---|---|---|\n"
    for member in root.iter("memberdef"):
        field = member.findtext("name")
        if field in ("struct_size", "name"):
            continue
        type_ = "".join(member.find("type").itertext()) + (member.findtext("argsstring") or "")
        about = " ".join(
            "".join(part.itertext()).strip()
            for part in (member.find("briefdescription"), member.find("detaileddescription"))
        )
        about = re.sub(r"\s+", " ", about).replace("|", "\\|").strip()
        text += f"| `{field}` | `{type_.strip()}` | {about} |\n"
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
        text += "In this code, `m` or `mechanism` is the mechanism; the other names stand for bodies and joints that were added "
        text += "before.\n\n"
        text += f"## What goes wrong\n\n{self.mistake}\n\n"
        text += f"## Fields\n\nThe arguments of the Python method have the same names. Fields that are not set keep their defaults.\n\n"
        text += f"{fields(xml, self.name)}\n"
        found = channels(self.m, self.element) if self.m and self.kind.family != "force" else []
        if found:
            first = f'record=["{self.element.name}.{found[0][1:].split("`")[0]}"]'
            text += f"## What a run can record\n\nFor example, `{first}`. The following names can follow the dot; the number in "
            text += f"parentheses is the number of values: {', '.join(found)}.\n\n"
        links = uses(self.method)
        text += f"Used in: {', '.join(links)}.\n\n" if links else ""
        return text + f"Reference: {{py:meth}}`baum.Mechanism.{self.method}`, {{c:struct}}`baum_{self.name}_def`.\n"

    def equations(self):
        what = {"body": "Coordinates", "joint": "Rows Phi = 0", "force": "Acts with"}[self.kind.family]
        what = "s(t)" if "driver" in self.name else what
        text = f"**{what}:** {self.cells[0]}\n\n"
        if self.kind.family == "joint" and len(self.cells) > 2:
            coordinate = "none" if self.cells[1] == "-" else self.cells[1]
            text += f"**Coordinate:** {coordinate}. **Degrees of freedom removed:** {self.cells[2]}.\n\n"
        explained = self.kind.family == "joint" or self.name.endswith("al_spring") or self.name == "planar_spring"
        return text + symbols(self.name) if explained else text


def main():
    xml, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    pictures = Path(sys.argv[3])
    pictures.mkdir(parents=True, exist_ok=True)
    added, rows, sections = methods(), equations(), written()
    if sections.keys() != KINDS.keys():
        sys.exit(f"modelling.py: elements.md and the kinds of elements differ: {sections.keys() ^ KINDS.keys()}")
    index = "# Elements\n\nEvery kind of element has a page with its picture, its equation, code in Python and C, and its fields.\n"
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
