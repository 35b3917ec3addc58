# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_motion.py FOLDER

Writes pages of planar and spatial runs, with names that contain scripts, and uses them in headless
Chromium. Checks that pages load without console messages, play, step, scrub, zoom and rotate, fit
desktop and telephone screens in light and dark, and that the plots follow the time. Leaves pages
and screenshots in FOLDER. On failure, lists the errors.
"""

import os
import sys
import time

import numpy as np

import baum
from baum import inertia
from chromium import Chromium

NAME = '<b onclick="window.taken = 1">A</b> </script><script>window.taken = 1</script> \u05d0\u05d1' + "long" * 9
SIZES = [(1280, 900, False), (420, 800, True)]
FRAME = 4.0  # [ms] longest time to draw 50 bodies
INK = "(draw(), stage.toDataURL())"


def plane():
    m = baum.Mechanism()
    crank = m.planar_body(NAME, mass=1, inertia=0.1, position=(0.5, 0), angular_velocity=5, held=True)
    rod = m.planar_body("rod", mass=1, inertia=0.4, position=(2, 0))
    slider = m.planar_body("slider", mass=1, inertia=0.1, position=(3, 0))
    m.revolute("O", m.ground, crank, point=(0, 0))
    m.revolute("A", crank, rod, point=(1, 0))
    m.revolute("B", rod, slider, point=(3, 0))
    m.translational("guide", m.ground, slider, point=(3, 0))
    m.spring("spring", m.ground, slider, stiffness=10, damping=1, point_a=(5, 0), point_b=(0, 0))
    record = ["A.reaction", "guide.reaction", "slider.velocity", "energy"]
    run = m.freeze().simulate(np.linspace(0, 4, 401), "rk8", rtol=1e-8, record=record)
    return run, [rod.pose_of((0, 0.2))]


def space():
    m = baum.Mechanism(up="z")
    body = m.spatial_body(NAME, mass=2, inertia=inertia.box(2, 0.3, 0.4, 0.05), position=(0, 0.5, 0),
                          angular_velocity=(1, 0, 0))
    other = m.spatial_body("other", mass=1, inertia=inertia.rod(1, 0.5, axis="y"), position=(0, 1.2, 0))
    m.spatial_revolute("hinge", m.ground, body, point=(0, 0, 0), axis=(1, 0, 0))
    m.spherical("ball", body, other, point=(0, 0.9, 0))
    record = ["hinge.reaction", "ball.reaction", "hinge.coordinate"]
    run = m.freeze().simulate(np.linspace(0, 3, 301), "rk8", rtol=1e-8, record=record)
    return run, [other]


def many():
    m = baum.Mechanism()
    before, corner = m.ground, np.zeros(2)
    for k in range(50):
        body = m.planar_body(f"body {k}", mass=1, inertia=0.1, position=corner + (0.5, 0))
        m.revolute(f"joint {k}", before, body, point=corner)
        before, corner = body, corner + (1, 0)
    return m.freeze().simulate(np.linspace(0, 1, 51), "rk4", step=1e-2), []


class Checks:
    def __init__(self):
        self.wrong = []
        self.where = ""

    def expect(self, fine, what):
        if not fine:
            self.wrong.append(what)
            print(f"wrong: {self.where}: {what}")


def key(browser, name):
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, key=name)


def wait(browser):
    """Wait until the page has drawn the requested frame."""
    for _ in range(100):
        if not browser.run("asked"):
            return
        time.sleep(0.02)


def mouse(browser, *steps, **more):
    """Send mouse events at positions (x, y) in units of the stage's width and height."""
    left, top, width, height = browser.run(
        "(() => { stage.scrollIntoView({block: 'center'}); const r = stage.getBoundingClientRect();"
        " return [r.left, r.top, r.width, r.height]; })()"
    )
    for kind, x, y in steps:
        browser.call("Input.dispatchMouseEvent", type=kind, x=left + x * width, y=top + y * height,
                     button="left", buttons=1, clickCount=1, **more)
    wait(browser)


def check_quiet(browser, checks):
    checks.expect(browser.complaints() == [], f"the console has {browser.complaints()}")
    checks.expect(browser.requests() == [], f"the page asked for {browser.requests()}")
    checks.expect(browser.run("window.taken") is None, "a name was run as a program")
    checks.expect(browser.run("document.querySelectorAll('main b:not(#marks b), h1 b').length") == 0, "a name is markup")
    checks.expect(browser.run("document.title") == NAME, "the title")


def check_layout(browser, checks):
    wide, room = browser.run("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    checks.expect(wide <= room, f"{wide} px wide in a window of {room} px")
    overlaps = browser.run(
        "(() => { const b = Array.from(document.querySelectorAll('.bar > *, h1, .help, figcaption')).filter(e => e.offsetParent)"
        ".map(e => e.getBoundingClientRect()); let n = 0; b.forEach((p, i) => b.forEach((q, j) => {"
        " if (i < j && p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1) n++; }));"
        " return n; })()"
    )
    checks.expect(overlaps == 0, f"{overlaps} texts overlap")


def check_time(browser, checks):
    """Check that playing, steps, the time bar and clicks on plots change time and picture."""
    checks.expect(not browser.run("playing"), "a page with #t= plays")
    checks.expect(abs(browser.run("now") - 0.5) < 1e-6, "#t= is not shown")
    before = browser.run(INK)
    key(browser, "ArrowRight")
    wait(browser)
    checks.expect(browser.run("now") > 0.5 and browser.run(INK) != before, "a step to the right")
    key(browser, "Home")
    wait(browser)
    checks.expect(browser.run("now === first"), "Home")
    key(browser, " ")
    time.sleep(0.6)
    checks.expect(browser.run("playing && now > first"), "the space bar does not play")
    key(browser, " ")
    checks.expect(not browser.run("playing"), "the space bar does not pause")
    browser.run("(() => { const bar = find('time'); bar.value = 0.75;"
                " bar.dispatchEvent(new Event('input', {bubbles: true})); })()")
    wait(browser)
    checks.expect(abs(browser.run("(now - first) / span") - 0.75) < 1e-6, "the bar does not scrub")
    browser.click("#plots canvas")
    wait(browser)
    checks.expect(abs(browser.run("(now - first) / span") - 0.5) < 0.1, "a plot does not move the time")
    browser.click("#play")
    time.sleep(0.2)
    checks.expect(browser.run("playing"), "the button does not play")
    browser.click("#play")


def check_view(browser, spatial, checks):
    before = browser.run("[view.scale, view.azimuth, view.shift[0]]")
    mouse(browser, ("mouseWheel", 0.5, 0.5), deltaX=0, deltaY=-300)
    checks.expect(browser.run("view.scale") > before[0], "the wheel does not zoom")
    mouse(browser, ("mousePressed", 0.4, 0.5), ("mouseMoved", 0.6, 0.6), ("mouseReleased", 0.6, 0.6))
    after = browser.run("[view.scale, view.azimuth, view.shift[0]]")
    moved = 1 if spatial else 2
    checks.expect(after[moved] != before[moved], "dragging does not turn" if spatial else "dragging does not move")
    key(browser, "0")
    wait(browser)
    checks.expect(abs(browser.run("view.shift[0]")) < 1e-9, "0 does not fit")
    for name in ("n", "c", "r", "t"):
        before = browser.run(INK)
        key(browser, name)
        wait(browser)
        checks.expect(browser.run(INK) != before, f"{name} changes nothing")
        key(browser, name)
        wait(browser)
        checks.expect(browser.run(INK) == before, f"{name} is not undone")


def check_names(browser, checks):
    """Check that names are written inside the stage and do not overlap."""
    browser.run("find('names').checked = true")
    for share in (0, 0.3, 0.6, 1):
        rooms, wide, high = browser.run(
            f"(now = first + {share} * span, draw(), [drawNames(framesAt(at(now))), wide, high])")
        checks.expect(len(rooms) > 3, f"only {len(rooms)} names are shown")
        inside = all(a[0] >= 0 and a[1] >= 0 and a[2] <= wide and a[3] <= high for a in rooms)
        checks.expect(inside, "a name is outside of the picture")
        overlaps = [1 for k, a in enumerate(rooms) for b in rooms[:k]
                    if a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]]
        checks.expect(not overlaps, f"{len(overlaps)} names overlap")
    browser.run("find('names').checked = false, seek(first + span / 2)")
    wait(browser)


def check_video(browser, checks):
    browser.run("HTMLAnchorElement.prototype.click = function () { window.saved = this.download; }")
    browser.click("#video")
    time.sleep(0.5)
    browser.click("#video")
    for _ in range(50):
        if browser.run("window.saved"):
            break
        time.sleep(0.1)
    checks.expect(browser.run("window.saved") == "mechanism.webm", "no video")


def check_speed(browser, page, checks):
    checks.where = "many"
    browser.size(1280, 900)
    browser.open(page)
    took = browser.run("(() => { play(false); let least = Infinity;"  # others use the machine, too
                       " for (let batch = 0; batch < 20; batch++) { const begin = performance.now();"
                       " for (let k = 0; k < 20; k++) { now = first + span * k / 20; draw(); }"
                       " least = Math.min(least, (performance.now() - begin) / 20); } return least; })()")
    print(f"50 bodies: {took:.2f} ms a frame")
    checks.expect(took <= FRAME, f"50 bodies take {took:.2f} ms a frame")


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    checks = Checks()
    with Chromium() as browser:
        for name, make in (("plane", plane), ("space", space)):
            run, traces = make()
            page = os.path.join(folder, f"{name}.html")
            run.page(page, title=NAME, traces=traces)
            run.mechanism.draw().save(os.path.join(folder, f"{name}.svg"))
            for width, height, phone in SIZES:
                for scheme in ("light", "dark"):
                    checks.where = f"{name} {width} {scheme}"
                    browser.size(width, height, phone, scheme)
                    browser.open(f"{page}?{width}{scheme}#t=0.5")
                    check_layout(browser, checks)
                    check_time(browser, checks)
                    check_view(browser, name == "space", checks)
                    browser.run("find('names').click(), find('centres').click()")
                    wait(browser)
                    browser.screenshot(os.path.join(folder, f"{name}_{width}_{scheme}.png"), not phone)
                    check_names(browser, checks)
                    check_quiet(browser, checks)
            check_video(browser, checks)
        page = os.path.join(folder, "many.html")
        many()[0].page(page)
        check_speed(browser, page, checks)
    print(f"pictures are in {folder}; {len(checks.wrong)} wrong")
    return 1 if checks.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
