# SPDX-License-Identifier: BSD-3-Clause
"""usage: gallery.py SOURCE EXTRA

Runs the Python examples, the mechanisms of the catalogue and the programs of the cookbook. Writes the pages of the
gallery into SOURCE/gallery and replaces the marks <!-- motion --> in the cookbook by pages that show the motion of the
program above. The pages themselves go into EXTRA/motion. Fails if a program fails."""

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
# Variants of other mechanisms, and mechanisms of user coordinates, which have no drawing.
OMITTED = {"pendulum_sundials", "pendulum_mebdf", "slider_crank_simeon", "slider_crank_sundials"}
OMITTED |= {"andrews_angles", "andrews_a03", "car_axis", "flyball_stiff"}
TITLES = {
    "eight_gains": "Slider-crank with eight sets of gains",
    "events": "Pendulum at a stop, and with a torque in intervals",
    "gyroscope": "Heavy top with steady precession",
    "hookes_joint": "Hooke's joint between two shafts",
    "jansen_leg": "Jansen's leg",
    "kinematics": "Quick-return mechanism of a shaper",
    "mistakes": "Three mistakes, drawn",
    "peaucellier": "Peaucellier's linkage",
    "pendulum": "Pendulum by a constraint function",
    "rssr": "Spatial four-bar with a motor",
    "slider_crank": "Slider-crank from lengths",
    "stewart": "Stewart platform",
    "suspension": "Double wishbone suspension",
    "tradeoff": "Error against cost of a slider-crank",
    "trebuchet": "Trebuchet in three phases",
    "wire": "Bead on a wire, as a study of Python functions",
}
NOT_SHOWN = {"animation"}  # examples that only show mechanisms of the catalogue

CATALOGUE_PROGRAM = """import baum
import numpy as np
from baum import catalog

m = catalog.build("{name}")
times = np.linspace(0, catalog.entry("{name}").end_time, {samples})
run = m.simulate(times, "rk8", rtol=1e-9{record})
known = catalog.times("{name}")
error = catalog.compare(m.simulate(known, "rk8", rtol=1e-9), "{name}")
print(f"largest error of positions at {{len(known)}} samples: {{error.q:.0e}}")
print(f"largest constraint violation: {{run.counters.max_phi:.0e}}")
"""


def run(program, name, title, arguments=()):
    """Run a program in a folder of its own. Return the folder, its text output and the time [s]."""
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
        f'<p><a href="{up}motion/{page.name}">Open this page alone</a></p>\n```\n\n'
    )


class Gallery:
    def __init__(self, source, extra):
        self.pages, self.motion = source / "gallery", extra / "motion"
        for folder in (self.pages, self.motion):
            folder.mkdir(parents=True, exist_ok=True)
        self.source, self.cards = source, {"examples": [], "catalogue": [], "cookbook": []}
        self.times = {}

    def take(self, folder, prefix):
        """Move the pages and drawings of a program. Return them."""
        pages, drawings = [], []
        for path in sorted(folder.glob("*.html")):
            pages.append(Path(shutil.move(path, self.motion / f"{prefix}{path.name}")))
        for path in sorted(folder.glob("*.svg")):
            drawings.append(Path(shutil.move(path, self.pages / f"{prefix}{path.name}")))
        shutil.rmtree(folder)
        return pages, drawings

    def write(self, kind, name, title, body, drawings):
        text = f"# {title}\n\n{body}"
        (self.pages / f"{name}.md").write_text(text, encoding="utf-8")
        picture = drawings[0].name if drawings else None
        self.cards[kind].append((name, title, picture))

    def example(self, path):
        name, text = path.stem, path.read_text(encoding="utf-8")
        arguments = ["--folder", "."] if "options.folder" in text else []
        title = TITLES.get(name, name.replace("_", " ").capitalize())
        folder, printed, seconds = run(path, name, title, arguments)
        pages, drawings = self.take(folder, f"example_{name}_" if arguments else "example_")
        about = ast.get_docstring(ast.parse(text))
        body = f"{about}\n\n" + "".join(
            motion(page, "../") for page in pages if "study" not in page.name
        )
        body += "".join(f"![{title}]({drawing.name})\n\n" for drawing in drawings if not pages)
        body += f"## Results\n\n```text\n{printed}```\n\n## Program\n\n`examples/{path.name}`:\n\n```python\n{text}```\n"
        twin = path.with_suffix(".c")
        if twin.exists():
            body += f"\n## The same in C\n\n`examples/{twin.name}`:\n\n```c\n{twin.read_text(encoding='utf-8')}```\n"
        self.write("examples", name, title, body, drawings)
        return f"example {name}", seconds

    def known(self, entry):
        m = catalog.build(entry.name)
        joints = [element.name for element in m if type(element).__name__ == "Joint"]
        record = f", record={[f'{joint}.reaction' for joint in joints[:12]]!r}".replace("'", '"')
        text = CATALOGUE_PROGRAM.format(name=entry.name, samples=401, record=record)
        title = re.split("[;,]", entry.title[0].upper() + entry.title[1:])[0]
        folder, printed, seconds = run_text(text, entry.name, title)
        pages, drawings = self.take(folder, "")
        body = "".join(motion(page, "../") for page in pages)
        body += f"```python\n{text}```\n\n```text\n{printed}```\n\n"
        body += f"Source of the data: {entry.source}.\n\n"
        body += f"Reference motion: {entry.provenance}.\n\n"
        body += f"Note: {entry.note}.\n\n" if entry.note else ""
        if entry.parameters:
            body += "| parameter | default | meaning |\n|---|---|---|\n"
            for p in entry.parameters.values():
                body += f"| `{p.name}` | {p.value:g} {p.unit} | {p.meaning} |\n"
        body += f'\nBuild variants with `catalog.build("{entry.name}", name=value)`. [The table of all mechanisms]'
        body += "(../docs/mechanisms.md) has the sources of the data.\n"
        self.write("catalogue", f"known_{entry.name}", title, body, drawings)
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
            pages, drawings = self.take(folder, "cookbook_")
            shown += above + "".join(motion(page, "../../") for page in pages[:1])
            if drawings and count == 1:
                self.cards["cookbook"].append(
                    (f"../docs/cookbook/{path.stem}", title, drawings[0].name)
                )
        path.write_text(shown + text, encoding="utf-8")
        return f"cookbook {path.stem}", seconds

    def cards_of(self, kind):
        text = '```{raw} html\n<div class="cards">\n'
        for name, title, picture in sorted(self.cards[kind]):
            image = f'<img src="../motion/{picture}" alt="">' if picture else ""
            if picture:
                shutil.copy(self.pages / picture, self.motion / picture)
            text += f'<a href="{name}.html">{image}{title}</a>\n'
        return text + "</div>\n```\n\n"

    def index(self):
        names = [
            name for kind in ("examples", "catalogue") for name, _, _ in sorted(self.cards[kind])
        ]
        text = "# Gallery\n\nEvery page shows a motion, the program that computed it, and its check against a known "
        text += (
            "value. The programs run when this site is built; the build fails if a check fails.\n\n"
        )
        text += "## Examples\n\nThese programs are in `examples/`. The tests of the project run them.\n\n"
        text += self.cards_of("examples")
        text += "## Mechanisms whose motion is known\n\nThe library `baum_catalog` builds these mechanisms "
        text += "([Catalogue of reference mechanisms](../docs/mechanisms.md)).\n\n" + self.cards_of(
            "catalogue"
        )
        text += (
            "## Cookbook\n\nPages of the [cookbook](../docs/cookbook/index.md) with a motion.\n\n"
        )
        text += self.cards_of("cookbook")
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
