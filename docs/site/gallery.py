# SPDX-License-Identifier: BSD-3-Clause
"""usage: gallery.py SOURCE EXTRA

Runs the Python examples, the mechanisms of the catalogue and the programs of the cookbook. Writes the pages of the
gallery into SOURCE/gallery. In the cookbook, replaces each mark <!-- motion --> by a frame that shows the motion of the
program above the mark. The HTML pages of the motions go into EXTRA/motion. Fails if a program or one of its checks fails,
if two pages have the same title, or if the page of a moving mechanism has no figure or no check."""

import ast
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from baum import catalog

SITE = Path(__file__).parent
ROOT = SITE.parents[1]
PROGRAM = re.compile(r"```python\n(.*?)```\n", flags=re.S)
MOTION = "<!-- motion -->\n"
# The gallery omits variants of other mechanisms, and mechanisms of user coordinates, which have no drawing.
OMITTED = {"pendulum_sundials", "pendulum_mebdf", "slider_crank_simeon", "slider_crank_sundials"}
OMITTED |= {"andrews_angles", "andrews_a03", "car_axis", "flyball_stiff"}
TITLES = {
    "cart_pole": "Cart and pole: swing-up and balance by control",
    "eight_gains": "Slider-crank with eight sets of gains, in motion",
    "events": "Pendulum at a stop, and with a torque in intervals",
    "gyroscope": "Heavy top in steady precession",
    "hookes_joint": "Hooke's joint between two shafts",
    "jansen_leg": "Jansen's leg",
    "kinematics": "Quick-return mechanism of a shaper",
    "mistakes": "Three mistakes, drawn",
    "peaucellier": "Peaucellier's linkage",
    "pendulum": "Pendulum by a constraint function",
    "planetary_gear": "Planetary gear with two inputs",
    "rssr": "Spatial four-bar (RSSR) with a coupler or a massless rod",
    "slider_crank": "Slider-crank with eight sets of gains, as a table",
    "spatial_slider_crank": "Spatial slider-crank beside and above its crank",
    "stewart": "Stewart platform: inverse and forward kinematics",
    "suspension": "Quarter car with double wishbones",
    "tradeoff": "Error against cost of a slider-crank",
    "trebuchet": "Trebuchet in three phases",
    "wire": "Bead on a wire, as a study of Python functions",
}
NOT_SHOWN = {"animation"}  # examples that only show mechanisms of the catalogue
STUDIES = {"mistakes", "tradeoff", "wire"}  # examples about methods rather than about a mechanism
SECTIONS = {
    "plane": ("In the plane", ""),
    "space": ("In space", ""),
    "studies": ("Studies and mistakes", ""),
    "cookbook": (
        "Cookbook",
        "These pages of the [cookbook](../docs/cookbook/index.md) show a motion.\n\n",
    ),
}
# The C programs that a page shows, with a text about each. A page that is not listed shows the C program with the name
# of its Python example, if there is one.
IN_C = {
    "cart_pole": {
        "control_loop": "A controller in C keeps a crank at constant speed, and measures how long each interval takes",
        "predictive_control": "A controller in C tries torques by simulating ahead, and restores the saved run after each trial",
    },
    "eight_gains": {"slider_crank": "The same gains in C, with a prediction of the violations"},
    "known_rolling_disc": {"rolling_disc": "Two discs in C, one of which rolls steadily"},
}
# Channels that the figures show. The figures also show the efforts of drivers or, without drivers, the energy.
MEASURED = {
    "andrews_bodies": ["O.coordinate"],
    "bricard": ["joint1.coordinate"],
    "chain_3": ["body3.pose"],
    "chaplygin_sleigh": ["sleigh.velocity"],
    "differential": ["left shaft.coordinate", "right shaft.coordinate"],
    "double_wishbone": ["lower pivots.coordinate"],
    "flyball": ["guide.coordinate"],
    "four_bar": ["D.coordinate"],
    "gimbals": ["post.coordinate", "trunnion.coordinate"],
    "heavy_top": ["top.velocity"],
    "n_four_bar": ["joint1.coordinate"],
    "pendulum": ["bob.pose"],
    "rolling_disc": ["disc.velocity"],
    "rssr": ["pivot.coordinate"],
    "slider_crank": ["guide.coordinate"],
    "slider_crank_driven": ["guide.coordinate"],
    "slider_crank_eccentric": ["guide.coordinate"],
    "spatial_slider_crank": ["guide.coordinate"],
}

CATALOGUE_PROGRAM = """import baum
import numpy as np
from baum import catalog

m = catalog.build("{name}")
times = np.linspace(0, catalog.entry("{name}").end_time, 401)
reactions = [element.reaction for element in m if isinstance(element, baum.Joint)][:12]
measured = [{channels}]
run = m.simulate(times, "rk8", rtol=1e-9, record=[*reactions, *measured])

known = catalog.times("{name}")
errors = []
for rtol in (1e-9, 1e-11):
    error = catalog.compare(m.simulate(known, "rk8", rtol=rtol), "{name}")
    print(f"rtol {{rtol:.0e}}: positions at {{len(known)}} samples, off by {{error.q:.1e}}")
    errors.append(error.q)
# The error must follow the tolerance, down to the uncertainty of the reference.
limit = max(error.q_floor, errors[0] / 10)
print(f"check  error at rtol {{rtol:.0e}}  {{error.q:.1e}} <= {{limit:.1e}}")
assert error.q <= limit
"""


def run(program, name, title, arguments=()):
    """Run a program in a new folder. Return the folder, the text that the program printed, and the time [s] it took."""
    folder = Path(tempfile.mkdtemp())
    command = [sys.executable, SITE / "capture.py", folder, name, title, program, *arguments]
    begun = time.monotonic()
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{program} failed:\n{done.stdout}{done.stderr}")
    return folder, done.stdout, time.monotonic() - begun


def run_text(text, name, title):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.py"
        path.write_text(text, encoding="utf-8")
        return run(path, name, title)


def motion(page, up):
    """Return HTML that embeds a page. up: the path from the page to the top folder of the site."""
    title = page.stem.replace("_", " ")
    return (
        f'```{{raw}} html\n<iframe class="motion" loading="lazy" title="{title}" src="{up}motion/{page.name}"></iframe>\n'
        f'<p><a href="{up}motion/{page.name}">Open the motion on a page of its own</a></p>\n```\n\n'
    )


def c_program(path, text, folded=False):
    """Return the section of a page that shows a C program."""
    name = path.relative_to(ROOT)
    code = f"```c\n{path.read_text(encoding='utf-8')}```\n"
    if not folded:
        return f"\n## In C\n\n{text}: `{name}`.\n\n{code}"
    summary = f"<details><summary>{text}: <code>{name}</code></summary>"
    return f"\n```{{raw}} html\n{summary}\n```\n\n{code}\n```{{raw}} html\n</details>\n```\n"


def c_programs(name):
    shown = IN_C.get(name, {})
    if not shown and (ROOT / "examples" / f"{name}.c").exists():
        shown = {name: "The same example in C"}
    paths = [(ROOT / "examples" / f"{program}.c", text) for program, text in shown.items()]
    return "".join(c_program(path, text) for path, text in paths)


def source_of(entry):
    """Return the C file that builds a mechanism of the catalogue."""
    files = sorted((ROOT / "src" / "catalog").glob("*.c"))
    mark = f'.name = "{entry.name}"'
    return next(path for path in files if mark in path.read_text(encoding="utf-8"))


def about(path):
    """Return the comment at the head of a C file, with its equations as blocks of code."""
    comment = re.search(r"\*/\n/\* (.*?)\n? \*/", path.read_text(encoding="utf-8"), flags=re.S)[1]
    lines = [re.sub(r"^ \* ?", "", line) for line in comment.split("\n")]
    return "\n".join(f"  {line}" if line.startswith("  ") else line for line in lines) + "\n\n"


def measured(entry, m):
    """Return the channels that a figure shows."""
    kinds = {element.name: element.kind.name for element in m}
    efforts = [f"{name}.effort" for name, kind in kinds.items() if kind == "driver"]
    return [*MEASURED.get(entry.name, []), *(efforts or ["energy"])]


class Gallery:
    def __init__(self, source, extra):
        self.pages, self.motion = source / "gallery", extra / "motion"
        for folder in (self.pages, self.motion):
            folder.mkdir(parents=True, exist_ok=True)
        self.source, self.cards = source, {section: [] for section in SECTIONS}

    def take(self, folder, prefix):
        """Move the pages, figures and drawings of a program into the gallery. Return their new paths."""
        pages, figures, drawings = [], [], []
        for path in sorted(folder.glob("*.html")):
            pages.append(Path(shutil.move(path, self.motion / f"{prefix}{path.name}")))
        for path in sorted(folder.glob("*.svg")):
            kind = figures if path.stem.endswith("_figure") else drawings
            kind.append(Path(shutil.move(path, self.pages / f"{prefix}{path.name}")))
        shutil.rmtree(folder)
        return pages, figures, drawings

    def write(self, section, name, title, printed, body, taken):
        """Write a page. body: its text before the motion and the figure, and its text after them."""
        pages, figures, drawings = taken
        if section != "studies" and pages and not (figures and "check" in printed):
            sys.exit(f"gallery page {name}: no figure or no check")
        text = f"# {title}\n\n" + body[0] + "".join(motion(page, "../") for page in pages)
        pictures = [(title, path) for path in drawings if not pages]
        pictures += [(f"{title}: measured quantities over time", path) for path in figures]
        text += "".join(f"![{label}]({path.name})\n\n" for label, path in pictures) + body[1]
        (self.pages / f"{name}.md").write_text(text, encoding="utf-8")
        picture = [*drawings, *figures, None][0]
        self.cards[section].append((title, name, picture))

    def example(self, path):
        name, text = path.stem, path.read_text(encoding="utf-8")
        arguments = ["--folder", "."] if "options.folder" in text else []
        title = TITLES.get(name, name.replace("_", " ").capitalize())
        folder, printed, seconds = run(path, name, title, arguments)
        taken = self.take(folder, f"example_{name}_" if arguments else "example_")
        pages = [page for page in taken[0] if "study" not in page.name]
        section = "studies" if name in STUDIES else "space" if "spatial_body(" in text else "plane"
        body = f"## Results\n\n```text\n{printed}```\n\n"
        body += f"## Program\n\n`examples/{path.name}`:\n\n```python\n{text}```\n"
        head = f"{ast.get_docstring(ast.parse(text))}\n\n"
        body += c_programs(name)
        self.write(section, name, title, printed, (head, body), (pages, *taken[1:]))
        return f"example {name}", seconds

    def known(self, entry):
        m = catalog.build(entry.name)
        channels = [f'"{channel}"' for channel in measured(entry, m)]
        channels = (
            ", ".join(channels)
            if len(channels) < 4
            else "\n    " + ",\n    ".join(channels) + ",\n"
        )
        text = CATALOGUE_PROGRAM.format(name=entry.name, channels=channels)
        title = entry.title[0].upper() + entry.title[1:].replace(";", ":")
        folder, printed, seconds = run_text(text, entry.name, title)
        taken = self.take(folder, "")
        body = f"## Program\n\n```python\n{text}```\n\n## Results\n\n```text\n{printed}```\n\n"
        body += f"Source of the data: {entry.source}.\n\n"
        body += f"Reference motion: {entry.provenance}.\n\n"
        body += f"Note: {entry.note}.\n\n" if entry.note else ""
        if entry.parameters:
            body += "| parameter | default | meaning |\n|---|---|---|\n"
            for p in entry.parameters.values():
                body += f"| `{p.name}` | {p.value:g} {p.unit} | {p.meaning} |\n"
            first = next(iter(entry.parameters))
            body += f'\nTo build a variant, set parameters by name, as in `baum.catalog.build("{entry.name}", {first}=...)`.'
        body += "\nThe page [Mechanisms whose motion is known](../docs/mechanisms.md) compares references with published values.\n"
        source = source_of(entry)
        body += c_program(source, "How the catalogue builds it, in C", folded=True)
        name = f"known_{entry.name}"
        spatial = any(element.kind.name.startswith("spatial") for element in m)
        section = "space" if spatial else "plane"
        self.write(section, name, title, printed, (about(source), body + c_programs(name)), taken)
        return f"catalogue {entry.name}", seconds

    def cookbook(self, path):
        """Run the programs of a page of the cookbook that have a mark below them."""
        text, seconds, count = path.read_text(encoding="utf-8"), 0.0, 0
        title, shown = text.split("\n")[0].lstrip("# "), ""
        while MOTION in text:
            above, text = text.split(MOTION, 1)
            count += 1
            heading = [title, *re.findall(r"^## (.*)", shown + above, flags=re.M)][-1]
            folder, _, spent = run_text(PROGRAM.findall(above)[-1], f"{path.stem}_{count}", heading)
            seconds += spent
            pages, _, drawings = self.take(folder, "cookbook_")
            shown += above + "".join(motion(page, "../../") for page in pages[:1])
            if drawings and count == 1:
                self.cards["cookbook"].append((title, f"../docs/cookbook/{path.stem}", drawings[0]))
        path.write_text(shown + text, encoding="utf-8")
        return f"cookbook {path.stem}", seconds

    def cards_of(self, section):
        text = '```{raw} html\n<div class="cards">\n'
        for title, name, picture in sorted(self.cards[section]):
            image = f'<img src="../motion/{picture.name}" alt="">' if picture else ""
            if picture:
                shutil.copy(picture, self.motion)
            text += f'<a href="{name}.html">{image}{title}</a>\n'
        return text + "</div>\n```\n\n"

    def index(self):
        cards = [card for section in SECTIONS for card in sorted(self.cards[section])]
        titles = [title for title, _, _ in cards]
        for title in titles:
            if titles.count(title) > 1:
                sys.exit(f"gallery: two pages have the title {title}")
        text = "# Gallery\n\nEvery page about a mechanism shows its motion, measured quantities, the program that "
        text += "computed them, and a check against a known value. The programs run when this site is built; the "
        text += "build fails if a check fails. Each program is in `examples/`, where the tests of the project run it, "
        text += "or it builds a mechanism of the library `baum_catalog` "
        text += "(see [Mechanisms whose motion is known](../docs/mechanisms.md)).\n\n"
        for section, (heading, about) in SECTIONS.items():
            text += f"## {heading}\n\n{about}{self.cards_of(section)}"
        names = [name for _, name, _ in cards if "/" not in name]
        text += "```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n"
        (self.pages / "index.md").write_text(text, encoding="utf-8")


def main():
    gallery = Gallery(Path(sys.argv[1]), Path(sys.argv[2]))
    examples = [
        path for path in sorted((ROOT / "examples").glob("*.py")) if path.stem not in NOT_SHOWN
    ]
    entries = [
        entry for entry in catalog.entries() if entry.sample_count and entry.name not in OMITTED
    ]
    recipes = sorted((gallery.source / "docs" / "cookbook").glob("*.md"))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tasks = [pool.submit(gallery.example, path) for path in examples]
        tasks += [pool.submit(gallery.known, entry) for entry in entries]
        tasks += [pool.submit(gallery.cookbook, path) for path in recipes]
        done = [task.result() for task in tasks]
    gallery.index()
    slow = sorted(done, key=lambda one: -one[1])[:5]
    print(f"{len(done)} programs and pages of programs; the slowest:")
    for name, seconds in slow:
        print(f"  {name:30} {seconds:6.1f} s")


if __name__ == "__main__":
    main()
