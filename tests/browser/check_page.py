# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_page.py FOLDER

Makes the page of a study, under a title that tries to be a program, and uses it in headless
Chromium as a reader would: on a desk and on a telephone, by day and by night. Leaves the page and
pictures of it in FOLDER. Fails with a list of what is wrong.
"""

import os
import sys

import baum
from chromium import Chromium

TITLE = "</title><script>window.taken = 1</script> <img src=x onerror=\"window.taken = 1\">"
SIZES = [(1280, 900, False), (400, 800, True)]
CHARTS, MAPS = 4, 4
TEXT, GRAPHICS = 4.5, 3.0  # least contrasts, WCAG 2.1 level AA
LEAST_TEXT = 9.0  # [px] height of the letters of a chart with what is above and below them


def slider_crank():
    m = baum.Mechanism(gravity=(0, -9.81))
    crank = m.planar_body("crank", mass=0.038, inertia=7.4e-5, position=(0.0765, 0), held=True,
                          angular_velocity=150)
    rod = m.planar_body("rod", mass=0.038, inertia=5.9e-4, position=(0.306, 0))
    slider = m.planar_body("slider", mass=0.076, inertia=2.7e-6, position=(0.459, 0.05))
    m.revolute('<b onclick="window.taken = 1">A</b>', m.ground, crank, point_a=(0, 0),
               point_b=(-0.0765, 0))
    m.revolute("B", crank, rod, point_a=(0.0765, 0), point_b=(-0.153, 0))
    m.revolute("C", rod, slider, point_a=(0.153, 0), point_b=(0, 0))
    m.translational("guide", m.ground, slider, axis=(1, 0), point_a=(0, 0.05), point_b=(0, 0))
    return m.freeze()


def make_study():
    """Nine methods and more, so that some are grey; entries that are refused or fail are among them."""
    study = baum.study(slider_crank(), 0, 0.1, repeats=1, entry_limit=0.05, validate=False)
    for name in ("euler", "rk4", "ab3", "rk8"):
        study.add_standard(name, settings=4, constants=2)
    return study.run()


class Checks:
    def __init__(self):
        self.wrong = []

    def expect(self, fine, what):
        if not fine:
            self.wrong.append(what)
            print(f"wrong: {what}")


def luminance(colour):
    """Relative luminance of "#rrggbb", WCAG 2.1."""
    channels = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    light, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def check_quiet(browser, checks):
    checks.expect(browser.complaints() == [], f"the console has {browser.complaints()}")
    checks.expect(browser.requests() == [], f"the page asked for {browser.requests()}")
    checks.expect(browser.run("window.taken") is None, "a name was run as a program")
    checks.expect(browser.run("document.title") == TITLE, "the title is not what was given")


def check_layout(browser, checks):
    width, room = browser.run(
        "[document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    checks.expect(width <= room, f"{width} px wide in a window of {room} px")
    heights = browser.run(
        "Array.from(document.querySelectorAll('svg.chart > text, svg.map > text'))"
        ".map(text => text.getBoundingClientRect().height)"
    )
    checks.expect(min(heights) >= LEAST_TEXT, f"letters of {min(heights)} px in a chart")


def check_charts(browser, study, checks):
    checks.expect(count(browser, "svg.chart") == CHARTS, "charts")
    checks.expect(count(browser, "svg.map") == MAPS, "maps")
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
        checks.expect(marks == drawn, f"chart {k}: {marks} marks of {drawn} entries")
        checks.expect(lines >= 8, f"chart {k}: {lines} lines")
        checks.expect(outside == 0, f"chart {k}: {outside} marks lie outside")


def count(browser, selector):
    return browser.run(f"document.querySelectorAll({selector!r}).length")


def check_maps(browser, study, checks):
    """Gains in use are drawn, and those of refused runs whose rule tells them."""
    candidates = [entry for entry in study.entries if entry.formulation == "baumgarte" and entry.step > 0]
    known = [entry for entry in candidates if entry.alpha >= 0]
    titles = browser.run("Array.from(document.querySelectorAll('svg.map use')).map(u => u.textContent)")
    checks.expect(len(known) <= len(titles) <= len(candidates), f"{len(titles)} gains are drawn")
    for entry in known:
        drawn = any(title.startswith(f"{entry.name}\nαh") for title in titles)
        checks.expect(drawn, f"the gains of {entry.name} are not drawn")


def check_parts(browser, study, checks):
    """Everything else that the page shows is there, as often as the study has it."""
    said = {entry.message for entry in study.entries if entry.message}
    wanted = {"#legend li": 10, ".floor": CHARTS, "path.front": 3, "#advice tbody": 5,
              "#methods tbody tr": len(study.methods), "#methods svg": 8, "#rows tbody tr": len(study),
              "#said tbody tr": len(said), "#environment dd": 6}
    for selector, number in wanted.items():
        got = count(browser, selector)
        checks.expect(got == number, f"{got} of {selector}, not {number}")
    remarks = count(browser, "#rows .remark.good")
    front = len(study.front("work")) + len(study.front("cpu"))
    checks.expect(remarks == front, f"{remarks} remarks on the fronts, not {front}")


def cells(browser, column):
    """Numbers of the entries that are shown, None where not known."""
    return browser.run(
        "Array.from(document.querySelectorAll('#rows tbody tr')).filter(row => !row.hidden)"
        f".map(row => row.cells[{column}].dataset.v === '' ? null"
        f" : Number(row.cells[{column}].dataset.v))"
    )


def is_sorted(values, reverse):
    known = [value for value in values if value is not None]
    return known == sorted(known, reverse=reverse) and None not in values[: len(known)]


def check_table(browser, study, checks):
    column = 2  # the error
    button = f"#rows thead th:nth-child({column + 1}) button"
    expected = [entry.error for entry in study.entries if entry.state == "done"]
    before = cells(browser, column)
    checks.expect(len(before) == len(study) and not is_sorted(before, False), "the order of adding")
    for presses, reverse, word in ((1, False, "ascending"), (2, True, "descending")):
        browser.click(button)
        values = cells(browser, column)
        checks.expect(is_sorted(values, reverse), f"error is not {word} after {presses} presses")
        checks.expect(sum(v is not None for v in values) == len(expected), "errors in the table")
        sort = browser.run(f"document.querySelector('{button}').parentNode.ariaSort")
        checks.expect(sort == word, f"aria-sort is {sort}, not {word}")
    browser.run(f"document.querySelector('{button}').focus()")
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, key="Enter", code="Enter", text="\r",
                     windowsVirtualKeyCode=13)
    checks.expect(is_sorted(cells(browser, column), False), "Enter does not sort")


def check_filters(browser, study, checks):
    front = set(study.front("work")) | set(study.front("cpu"))
    browser.click("#front")
    shown = len(cells(browser, 2))
    checks.expect(shown == len(front), f"{shown} entries on a front, not {len(front)}")
    browser.click("#front")
    browser.click(".chips button:nth-child(1)")
    shown = browser.run(
        "Array.from(document.querySelectorAll('svg.chart g.line[data-i=euler]'))"
        ".filter(line => getComputedStyle(line).display !== 'none').length"
    )
    checks.expect(shown == 0, f"{shown} lines of euler are shown without it")
    others = sum(entry.integrator != "euler" for entry in study.entries)
    checks.expect(len(cells(browser, 2)) == others, "entries without euler")
    browser.click(".chips button:nth-child(1)")
    checks.expect(len(cells(browser, 2)) == len(study), "all entries again")


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


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    page = os.path.join(folder, "study.html")
    study = make_study()
    study.write(page, TITLE)
    checks = Checks()
    with Chromium() as browser:
        for width, height, phone in SIZES:
            for scheme in ("light", "dark"):
                print(f"{width} px, {scheme}")
                browser.size(width, height, phone, scheme)
                browser.open(page)
                browser.screenshot(os.path.join(folder, f"study_{width}_{scheme}.png"))
                check_layout(browser, checks)
                check_charts(browser, study, checks)
                check_maps(browser, study, checks)
                check_parts(browser, study, checks)
                check_colours(browser, checks)
                check_table(browser, study, checks)
                check_filters(browser, study, checks)
                check_quiet(browser, checks)
    print(f"pictures are in {folder}; {len(checks.wrong)} wrong")
    return 1 if checks.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
