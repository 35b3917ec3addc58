# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_page.py FOLDER

Writes the pages of studies, with a title that contains a script. Operates them in headless Chromium
as a reader would: on desktop and telephone screens and on paper, in light and dark. Also breaks a
page in several ways, and checks that the other checks then fail. Saves pages and screenshots in
FOLDER, and lists the checks that fail.
"""

import json
import os
import re
import sys

import baum
from chromium import Chromium

TITLE = "</title><script>window.taken = 1</script> <img src=x onerror=\"window.taken = 1\"> & 曲柄"
NAME = '<b onclick="window.taken = 1">A</b> & \'B\' Ä曲柄 ' + "long" * 30
SIZES = [(1280, 900, False), (420, 800, True)]
PAPER = (718, 1000)  # [px] an A4 page without its margins
CHARTS, MAPS = 4, 4
TEXT, GRAPHICS = 4.5, 3.0  # smallest contrasts that WCAG 2.1 requires for level AA
# [px] smallest height of a chart's letters, including the space above and below them
LEAST_TEXT = 9.0
LEAST_GAP = 6.0  # [px] smallest distance between marks of one kind in a map
SABOTAGE = {  # parts of the page, each with a replacement that breaks the page
    "  texts();\n": "  texts(); undefinedFunction();\n",
    "max-width: 1320px": "min-width: 1400px",
    "#picture { float: right;": "#picture { position: absolute;",
    ".scroll { overflow-x: auto;": ".scroll { min-width: 1300px;",
    "find('rows').append(head(columns), make('tbody', null, ...rows));":
        "find('rows').append(head(columns), make('tbody', null, ...rows.slice(1)));",
    "element.append(...inside)": "element.innerHTML = inside.map(x => x.outerHTML || x).join('')",
    "const NEAR = 9": "const NEAR = 1",
    "const TICKS = 7": "const TICKS = 40",
    "    ['cpu', 'CPU [ms]', ms],": "    ['cpu', 'CPU [ms]', x => x + ' ms or a little more than that, but not much'],",
    "const share = a === b ? 1 :": "const share = a === b ? 1 : 2 *",
}


def slider_crank():
    m = baum.Mechanism(gravity=(0, -9.81))
    crank = m.planar_body("crank", mass=0.038, inertia=7.4e-5, position=(0.0765, 0), held=True,
                          angular_velocity=150)
    rod = m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(0.306, 0))
    slider = m.planar_body("slider", mass=0.076, inertia=2.7e-6, position=(0.459, 0.05))
    m.revolute(NAME, m.ground, crank, point_a=(0, 0), point_b=(-0.0765, 0))
    m.revolute("B", crank, rod, point_a=(0.0765, 0), point_b=(-0.153, 0))
    m.revolute("C", rod, slider, point_a=(0.153, 0), point_b=(0, 0))
    m.translational("guide", m.ground, slider, axis=(1, 0), point_a=(0, 0.05), point_b=(0, 0))
    return m.freeze()


def make_studies(mechanism):
    """Return four studies. One has more methods than colours, one is a stress test, one has a
    single entry, and one has not been run."""
    grid, stress, single, waiting = (
        baum.study(mechanism, 0, 0.1, repeats=1, entry_limit=0.05, validate=False) for _ in range(4))
    for name in ("euler", "rk4", "ab3", "rk8"):
        grid.add_standard(name, settings=4, constants=2)
    stress.add_stress("rk4")
    single.add("rk4", step=1e-3)
    waiting.add("rk4", step=1e-3)
    return {"grid": grid.run(), "stress": stress.run(), "single": single.run(), "waiting": waiting}


class Checks:
    def __init__(self, quiet=False):
        self.wrong = []
        self.where = ""
        self._quiet = quiet

    def expect(self, fine, what):
        if not fine:
            self.wrong.append(what)
            if not self._quiet:
                print(f"wrong: {self.where}: {what}")


def luminance(colour):
    """Return the relative luminance of "#rrggbb" (WCAG 2.1)."""
    channels = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    light, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def check_quiet(browser, checks):
    checks.expect(browser.complaints() == [], f"the console shows {browser.complaints()}")
    checks.expect(browser.requests() == [], f"the page requested {browser.requests()}")
    checks.expect(browser.run("window.taken") is None, "a name was executed as a script")
    checks.expect(browser.run("document.title") == TITLE, "the title is not the given title")
    checks.expect(count(browser, "main b, main img, header img") == 0, "a name was parsed as markup")


# Returns, for each chart or map, [left, top, right, bottom] of the elements that match a selector.
BOXES = """(selector => Array.from(document.querySelectorAll('svg.chart, svg.map'), svg =>
  Array.from(svg.querySelectorAll(selector), element => {
    const at = element.getBoundingClientRect();
    return [at.left, at.top, at.right, at.bottom]; })))"""

# Returns the width of the picture, the number of its visible shapes, and the number of text lines
# of the header that the picture covers.
PICTURE = """(() => {
  const at = document.querySelector('#picture svg').getBoundingClientRect();
  const texts = document.createRange();
  const covered = Array.from(document.querySelectorAll('header > :not(figure)'), element => {
    texts.selectNodeContents(element);
    return Array.from(texts.getClientRects()).filter(line => line.left < at.right && at.left < line.right &&
      line.top < at.bottom && at.top < line.bottom).length; });
  const drawn = Array.from(document.querySelectorAll('#picture svg > *'), shape => shape.getBoundingClientRect())
    .filter(shape => shape.left >= 0 && shape.right <= innerWidth && shape.width + shape.height > 1);
  return [at.width, drawn.length, covered.reduce((sum, lines) => sum + lines, 0)];
})()"""

# Lists texts that are wider than their table cells, and numbers that need more than one line.
BAD_CELLS = """Array.from(document.querySelectorAll('th, td')).filter(cell => {
  const lines = document.createRange();
  lines.selectNodeContents(cell);
  const tops = new Set(Array.from(lines.getClientRects(), line => Math.round(line.top)));
  return cell.scrollWidth > cell.clientWidth + 1 || ('v' in cell.dataset && tops.size > 1);
}).map(cell => cell.textContent)"""


def check_layout(browser, checks):
    """Check that the page fits the window. Cells must show all their text, with numbers on one
    line, and no texts may overlap."""
    width, room = browser.run(
        "[document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    checks.expect(width <= room, f"the page is {width} px wide in a window of {room} px")
    wide = browser.run("Array.from(document.querySelectorAll('.scroll'))"
                       ".filter(box => box.scrollWidth > box.clientWidth).map(box => box.ariaLabel)")
    checks.expect(wide == [], f"tables of {wide} are too wide")
    wide, drawn, covered = browser.run(PICTURE)
    checks.expect(wide >= 200 and drawn >= 8, f"the picture is {wide} px wide and shows {drawn} shapes")
    checks.expect(covered == 0, f"the picture covers {covered} lines of the header")
    bad = browser.run(BAD_CELLS)
    checks.expect(bad == [], f"{len(bad)} cells cut or wrap their text: {bad[:3]}")
    for boxes in browser.run(f"{BOXES}('text')"):
        heights = [bottom - top for _, top, _, bottom in boxes]
        checks.expect(min(heights) >= LEAST_TEXT, f"letters in a chart are {min(heights)} px high")
        overlaps = sum(a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
                       for k, a in enumerate(boxes) for b in boxes[:k])
        checks.expect(overlaps == 0, f"{overlaps} texts of a chart overlap")
    for kind in ("good", "off", "bad"):
        for boxes in browser.run(f"{BOXES}('use.{kind}')"):
            gap = min((abs(complex(a[0] - b[0], a[1] - b[1])) for k, a in enumerate(boxes) for b in boxes[:k]),
                      default=LEAST_GAP)
            checks.expect(gap >= LEAST_GAP, f"marks in a map are only {gap} px apart")


def check_entries(browser, study, checks):
    """Check that the table has one row with the right name for each entry, and that it has all
    messages of failed entries."""
    names = browser.run("Array.from(document.querySelectorAll('#rows tbody tr'), row =>"
                        " `${row.cells[0].textContent}, ${row.cells[1].textContent}`)")
    wanted = [entry.name for entry in study.entries]
    checks.expect(names == wanted, f"{len(names)} rows for {len(wanted)} entries, or wrong names")
    said = browser.run("document.getElementById('said').textContent")
    failures = [entry for entry in study.entries if entry.state in ("failed", "refused", "timed_out")]
    for entry in failures:
        checks.expect(entry.name in said and entry.message in said, f"the page has no message of {entry.name}")
    pills = count(browser, "#rows tr:not([data-kinds~=done]):not([data-kinds~=waiting]) .remark.bad")
    checks.expect(pills >= len(failures), f"{pills} remarks for {len(failures)} failures")


def check_advice(browser, checks):
    """Check that the page shows each recommended setting with the error, the work and the CPU time
    that the library states. The numbers may differ slightly, because the setting is rounded."""
    advice = json.loads(browser.run("document.getElementById('data').textContent"))["report"]["recommendations"]
    why = {each["setting"]: each["why"] for each in advice if each["setting"]}
    rows = browser.run("Array.from(document.querySelectorAll('#advice tbody tr:has(summary)'), row =>"
                       " [row.querySelector('summary').textContent,"
                       "  ...Array.from(row.querySelectorAll('[data-v]'), cell => cell.dataset.v)])")
    checks.expect({row[0] for row in rows} == set(why), "the recommended settings are not those of the report")
    for name, *figures in rows:
        said = re.search(r"error (\S+) for a work of (\S+) and (\S+) ms", why[name]).groups()
        for got, wanted, factor in zip(figures, said, (1, 1, 1e3)):
            checks.expect(got and abs(float(got) * factor / float(wanted) - 1) < 0.1,
                          f"{name}: {got} instead of {wanted}")


def check_charts(browser, study, checks):
    checks.expect(count(browser, "svg.chart") == CHARTS, "the number of charts is wrong")
    checks.expect(count(browser, "svg.map") == MAPS, "the number of maps is wrong")
    drawn = sum(entry.state == "done" and entry.error <= 10 for entry in study.entries)
    for k in range(CHARTS):
        chart = f"document.querySelectorAll('svg.chart')[{k}]"
        marks, lines, outside = browser.run(
            f"(() => {{ const frame = {chart}.getBoundingClientRect();"
            f" const marks = Array.from({chart}.querySelectorAll('g.line > use'));"
            " const outside = marks.filter(mark => { const at = mark.getBoundingClientRect();"
            "   return at.width < 1 || at.left < frame.left || at.right > frame.right + 8 ||"
            "     at.top < frame.top - 8 || at.bottom > frame.bottom; });"
            f" const lines = Array.from({chart}.querySelectorAll('g.line > path'))"
            ".filter(line => line.getTotalLength() > 10);"
            " return [marks.length, lines.length, outside.length]; })()"
        )
        checks.expect(marks == drawn, f"chart {k}: {marks} marks for {drawn} entries")
        checks.expect(lines >= 8, f"chart {k}: only {lines} lines")
        checks.expect(outside == 0, f"chart {k}: {outside} marks are outside the chart")


def count(browser, selector):
    return browser.run(f"document.querySelectorAll({selector!r}).length")


def check_maps(browser, study, checks):
    """Check that the maps show the gains of every run. A refused run reports
    no gains, but a map may show the gains that its gain rule would give."""
    candidates = [entry for entry in study.entries if entry.formulation == "baumgarte" and entry.step > 0]
    known = [entry for entry in candidates if entry.alpha >= 0]
    titles = browser.run("Array.from(document.querySelectorAll('svg.map use')).map(u => u.textContent)")
    drawn = sum(title.count("αh") for title in titles)
    checks.expect(len(known) <= drawn <= len(candidates), f"{drawn} gains are drawn, not {len(known)} to {len(candidates)}")
    for entry in known:
        drawn = any(f"{entry.name}\nαh" in title for title in titles)
        checks.expect(drawn, f"the gains of {entry.name} are not drawn")


def check_parts(browser, study, checks):
    """Check how many elements of other kinds the page has."""
    wanted = {"#legend li": 10, ".floor": CHARTS, "path.front": 3, "#environment dd": 6,
              "#methods tbody tr": len(study.methods), "#methods svg": 8}
    for selector, number in wanted.items():
        got = count(browser, selector)
        checks.expect(got == number, f"{got} elements match {selector}, not {number}")
    remarks = count(browser, "#rows .remark.good")
    front = len(study.front("work")) + len(study.front("cpu"))
    checks.expect(remarks == front, f"{remarks} remarks about the fronts, not {front}")


def cells(browser, column):
    """Return the values of a column in all visible rows. Unknown values are None."""
    return browser.run(
        "Array.from(document.querySelectorAll('#rows tbody tr')).filter(row => !row.hidden)"
        f".map(row => row.cells[{column}].dataset.v === '' ? null"
        f" : Number(row.cells[{column}].dataset.v))"
    )


def is_sorted(values, reverse):
    known = [value for value in values if value is not None]
    return known == sorted(known, reverse=reverse) and None not in values[: len(known)]


def check_table(browser, study, checks):
    column = 2  # the column of errors
    button = f"#rows thead th:nth-child({column + 1}) button"
    expected = [entry.error for entry in study.entries if entry.state == "done"]
    before = cells(browser, column)
    checks.expect(len(before) == len(study) and not is_sorted(before, False), "the entries are not in the order in which they were added")
    for presses, reverse, word in ((1, False, "ascending"), (2, True, "descending")):
        browser.click(button)
        values = cells(browser, column)
        checks.expect(is_sorted(values, reverse), f"the errors are not {word} after {presses} clicks")
        checks.expect(sum(v is not None for v in values) == len(expected), "the number of errors in the table is wrong")
        sort = browser.run(f"document.querySelector('{button}').parentNode.ariaSort")
        checks.expect(sort == word, f"aria-sort is {sort}, not {word}")
    browser.run(f"document.querySelector('{button}').focus()")
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, key="Enter", code="Enter", text="\r",
                     windowsVirtualKeyCode=13)
    checks.expect(is_sorted(cells(browser, column), False), "Enter does not sort")


def select(browser, kind):
    browser.run(f"(() => {{ const menu = document.getElementById('kind'); menu.value = {kind!r};"
                " menu.dispatchEvent(new Event('input', {bubbles: true})); })()")
    return len(cells(browser, 2))


def check_filters(browser, study, checks):
    front = set(study.front("work")) | set(study.front("cpu"))
    shown = select(browser, "front")
    checks.expect(shown == len(front), f"the filter shows {shown} entries on a front, not {len(front)}")
    for state in ("done", "failed", "refused", "timed_out"):
        wanted = sum(entry.state == state for entry in study.entries)
        checks.expect(select(browser, state) == wanted, f"the filter does not show the {wanted} entries that are {state}")
    select(browser, "all")
    browser.click("#integrators input")
    shown = browser.run(
        "Array.from(document.querySelectorAll('svg.chart g.line[data-i=euler]'))"
        ".filter(line => getComputedStyle(line).display !== 'none').length"
    )
    checks.expect(shown == 0, f"{shown} lines of euler are visible although it is not selected")
    others = sum(entry.integrator != "euler" for entry in study.entries)
    checks.expect(len(cells(browser, 2)) == others, "the number of entries without euler is wrong")
    browser.click("#integrators input")
    checks.expect(len(cells(browser, 2)) == len(study), "selecting euler again does not show all entries")
    browser.click("#all")
    hidden = browser.run("Array.from(document.querySelectorAll('#rows th, #rows td'))"
                         ".filter(cell => getComputedStyle(cell).display === 'none').length")
    checks.expect(hidden == 0, f"{hidden} cells are hidden although all columns are selected")
    browser.click("#all")


def check_colours(browser, checks):
    names = ["paper", "shade", "ink", "faint", "good", "bad"] + [f"c{k}" for k in range(8)]
    colours = browser.run(
        "(names => Object.fromEntries(names.map(name => [name,"
        " getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim()])))"
        f"({names})"
    )
    for name in names[2:]:
        least = GRAPHICS if name[0] == "c" else TEXT
        for ground in ("paper", "shade") if least == TEXT else ("paper",):
            got = contrast(colours[name], colours[ground])
            checks.expect(got >= least, f"contrast of {name} on {ground} is {got:.1f}")


def check_everywhere(browser, page, study, checks):
    """Check the page of any study for each window size and colour scheme, and on paper. Yields
    after each size and scheme, so that the caller can add checks."""
    for width, height, phone in SIZES:
        for scheme in ("light", "dark"):
            checks.where = f"{os.path.basename(page)}, {width} px, {scheme}"
            browser.size(width, height, phone, scheme)
            browser.open(page)
            browser.screenshot(page.replace(".html", f"_{width}_{scheme}.png"))
            check_layout(browser, checks)
            check_entries(browser, study, checks)
            check_advice(browser, checks)
            check_quiet(browser, checks)
            yield
    checks.where = f"{os.path.basename(page)}, paper"
    browser.size(*PAPER, media="print")
    browser.open(page)
    check_layout(browser, checks)


def check_grid(browser, study, checks):
    check_charts(browser, study, checks)
    check_maps(browser, study, checks)
    check_parts(browser, study, checks)
    check_colours(browser, checks)
    check_table(browser, study, checks)
    check_filters(browser, study, checks)
    check_quiet(browser, checks)


def check_sabotage(browser, page, study, checks):
    """Check that each way of breaking the page makes a check fail."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    broken = page.replace(".html", "_broken.html")
    for part, other in SABOTAGE.items():
        checks.where = "sabotage"
        checks.expect(text.count(part) == 1, f"the page contains {part!r} {text.count(part)} times")
        with open(broken, "w", encoding="utf-8") as file:
            file.write(text.replace(part, other))
        found = Checks(quiet=True)
        try:
            for _ in check_everywhere(browser, broken, study, found):
                pass
        except (RuntimeError, ValueError):  # the page lacks an element that the checks need
            found.wrong.append("the page lacks an element that the checks need")
        checks.expect(found.wrong, f"no check notices {other!r}")
        print(f"noticed: {found.wrong[0] if found.wrong else 'nothing'}"[:150])


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    checks = Checks()
    studies = make_studies(slider_crank())
    with Chromium() as browser:
        for name, study in studies.items():
            page = os.path.join(folder, f"{name}.html")
            study.write(page, TITLE)
            print(f"{name}, {len(study)} entries")
            for _ in check_everywhere(browser, page, study, checks):
                if name == "grid":
                    check_grid(browser, study, checks)
        check_sabotage(browser, os.path.join(folder, "grid.html"), studies["grid"], checks)
    print(f"pictures are in {folder}; {len(checks.wrong)} wrong")
    return 1 if checks.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
