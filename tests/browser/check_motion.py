# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_motion.py FOLDER

Writes pages of planar and spatial runs, with names that contain scripts, and operates them in
headless Chromium. Pages must load without console messages, must play, step, zoom and rotate, and
must fit desktop and telephone screens in light and dark. The time bar and the plots must change the
time, and nearer solids must cover farther ones. Saves pages and screenshots in FOLDER, and lists
the checks that fail.
"""

import base64
import json
import os
import re
import sys
import time

import numpy as np

import baum
import moving
from baum import inertia
from chromium import Chromium

NAME = '<b onclick="window.taken = 1">A</b> </script><script>window.taken = 1</script> \u05d0\u05d1' + "long" * 9
SIZES = [(1280, 900, False), (420, 800, True)]
FRAME = 4.0  # [ms] longest time that the script may take to draw 50 bodies
INK = "(draw(), stage.toDataURL())"


def plane():
    m = moving.plane(NAME)
    m.spring("spring", m.ground, m["slider"], stiffness=10, damping=1, point_a=(5, 0), point_b=(0, 0.1))
    record = ["A.reaction", "guide.reaction", "slider.velocity", "energy"]
    run = m.freeze().simulate(np.linspace(0, 4, 401), "rk8", rtol=1e-8, record=record)
    return run, [m["rod"].pose_of((0, 0.2))]


def space():
    m = moving.space(NAME)
    record = ["hinge.reaction", "ball.reaction", "hinge.coordinate"]
    run = m.freeze().simulate(np.linspace(0, 3, 301), "rk8", rtol=1e-8, record=record)
    return run, [m["other"]]


def many():
    m = baum.Mechanism()
    before, corner = m.ground, np.zeros(2)
    for k in range(50):
        body = m.planar_body(f"body {k}", mass=1, inertia=0.1, position=corner + (0.5, 0))
        m.revolute(f"joint {k}", before, body, point=corner)
        before, corner = body, corner + (1, 0)
    return m.freeze().simulate(np.linspace(0, 1, 51), "rk4", step=1e-2)


def many_in_space():
    m = baum.Mechanism(up="z")
    before, corner = m.ground, np.zeros(3)
    for k in range(50):
        body = m.spatial_body(f"body {k}", mass=1, inertia=inertia.rod(1, 1, axis="x"), position=corner + (0.5, 0, 0))
        m.spatial_revolute(f"joint {k}", before, body, point=corner, axis=(0, k % 2, 1 - k % 2))
        before, corner = body, corner + (1, 0, 0)
    return m.freeze().simulate(np.linspace(0, 1, 51), "rk4", step=1e-2)


# ---- a scene of solids for which sorting by depth would give a wrong picture ----

HIGH = 0.3


def shape(body, form, points, radius=0.0, **more):
    """Return a fixed shape in the colour of its body."""
    return {"style": "body", "form": form, "body": body, "other": body, "element": f"{form} {body}",
            "radius": radius, "points": points, **more}


def bar_over(angle, body):
    """Return a side of a triangle, which passes over the next side and under the previous side."""
    c, s = np.cos(angle), np.sin(angle)
    ends = [(x * c + 0.5 * s, x * s - 0.5 * c, HIGH * np.sign(x)) for x in (-1.6, 1.6)]
    return shape(body, "line", ends, 0.12)


def solids():
    """Return the data of a page and a list of points in space. Each point comes with the number of
    the body that is visible there, or 0 if there is none."""
    thirds = 2 * np.pi / 3 * np.arange(3)
    corner = np.sqrt(3) / 2  # distance from the middle of a side to the crossing with another side
    shapes = [bar_over(angle, k + 1) for k, angle in enumerate(thirds)]
    seen = []
    for k, angle in enumerate(thirds):
        c, s = np.cos(angle), np.sin(angle)
        height = HIGH * corner / 1.6
        seen.append(((corner * c + 0.5 * s, corner * s - 0.5 * c, height), k + 1))
    shapes += [  # a ring around a bar, which passes above and below the bar
        shape(4, "line", [(4, -1.5, 0), (4, 1.5, 0)], 0.12),
        shape(5, "line", [(3.5, 0, -0.6), (4.5, 0, -0.6), (4.5, 0, 0.6), (3.5, 0, 0.6), (3.5, 0, -0.6)], 0.12),
        shape(6, "box", [(8, 0, 0), (0.5, 0.5, 0.5)]),  # a bar that passes through a box
        shape(7, "cylinder", [(6.5, 0, 0), (9.5, 0, 0)], 0.2),
        shape(1, "area", [(11, -1, 0), (13, -1, 0), (13, 1, 0), (12, 0, 0), (11, 1, 0)]),  # concave
        shape(2, "mesh", [(15, -1, 0), (17, -1, 0), (16, 1, 0), (16, -0.3, 1)],
              triangles=[0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3]),
        shape(3, "ball", [(19, 0, 0)], 0.6),
        shape(4, "disc", [(21, 0, 0), (0, 0, 1)], 0.7),
    ]
    seen += [((4, 0, 0.6), 5), ((4, 1, 0), 4), ((8, -0.2, 0.5), 6), ((6.7, 0, 0.2), 7), ((9.3, 0, 0.2), 7),
             ((11.4, -0.6, 0), 1), ((12, 0.7, 0), 0), ((12.8, 0.5, 0), 1), ((16, -0.5, 0.3), 2), ((19, 0, 0.6), 3),
             ((21, 0, 0), 4), ((10, 0, 0), 0)]
    bodies = [{"name": f"body {k}", "kind": "none" if k else "ground", "q": 0} for k in range(9)]
    drawing = {"version": 1, "spatial": True, "unit": 0.1, "gravity": [0, 0, -9.81], "bodies": bodies, "shapes": shapes}
    kinds = ("warning", "singular", "event")
    return {
        "title": NAME, "drawing": drawing, "reactions": [], "plots": [], "traces": [], "frames": 2, "ranges": [[0, 1]],
        "marks": [{"t": (k + 1) / 4, "kind": kind, "text": f"a {kind}"} for k, kind in enumerate(kinds)],
        "values": base64.b64encode(np.array([0, 65534], "<u2").tobytes()).decode(),
    }, seen


def write_solids(template, path):
    """Write a copy of the page `template`, which the library has written, with the scene of solids
    as its data. Return the points of the scene and the bodies that are visible there."""
    data, seen = solids()
    text = json.dumps(data).replace("<", "\\u003c")
    with open(template, encoding="utf-8") as file:
        page = re.sub(r'(?s)(id="data">).*?(</script>)', lambda found: found[1] + text + found[2], file.read(), count=1)
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)
    return seen


# For each given point, returns the number of the visible body, or 0 for the paper and the floor.
# The ratio of the pixel's red, green and blue identifies the body, whatever the light.
BODIES_AT = """(points => {
  const copy = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  [copy.canvas.width, copy.canvas.height] = [stage.width, stage.height];
  draw();
  copy.drawImage(stage, 0, 0);
  return points.map(point => {
    const [x, y] = project(point), ratio = stage.width / wide;
    const pixel = Array.from(copy.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data.slice(0, 3));
    const apart = (a, b) => Math.hypot(...normal(a).map((e, i) => e - normal(b)[i]));
    const bodies = [1, 2, 3, 4, 5, 6, 7], all = [...bodies.map(k => 'fill' + (k - 1)), 'paper', 'shadow', 'rule'].map(name => rgb(colours[name]));
    const found = all.map(tone => apart(pixel, tone));
    const best = found.indexOf(Math.min(...found));
    return best < bodies.length ? bodies[best] : 0;
  });
})"""


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


def wait(browser, until_not="asked"):
    """Wait until the page has drawn the requested frame, or until the condition `until_not` is
    false."""
    for _ in range(500):
        if not browser.run(f"Boolean({until_not})"):
            return
        time.sleep(0.02)


def mouse(browser, *steps, **more):
    """Send mouse events at positions (x, y), as fractions of the width and the height of the
    stage."""
    left, top, width, height = browser.run(
        "(() => { stage.scrollIntoView({block: 'center'}); const r = stage.getBoundingClientRect();"
        " return [r.left, r.top, r.width, r.height]; })()"
    )
    for kind, x, y in steps:
        browser.call("Input.dispatchMouseEvent", type=kind, x=left + x * width, y=top + y * height,
                     button="left", buttons=1, clickCount=1, **more)
    wait(browser)


def check_quiet(browser, checks):
    checks.expect(browser.complaints() == [], f"the console shows {browser.complaints()}")
    checks.expect(browser.requests() == [], f"the page requested {browser.requests()}")
    checks.expect(browser.run("window.taken") is None, "a name was executed as a script")
    checks.expect(browser.run("document.querySelectorAll('main b:not(#marks b), h1 b').length") == 0, "a name was parsed as markup")
    checks.expect(browser.run("document.title") == NAME, "the title is not the given name")


def check_layout(browser, checks):
    wide, room = browser.run("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    checks.expect(wide <= room, f"the page is {wide} px wide in a window of {room} px")
    overlaps = browser.run(
        "(() => { const b = Array.from(document.querySelectorAll('.bar > *, h1, .help, figcaption')).filter(e => e.offsetParent)"
        ".map(e => e.getBoundingClientRect()); let n = 0; b.forEach((p, i) => b.forEach((q, j) => {"
        " if (i < j && p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1) n++; }));"
        " return n; })()"
    )
    checks.expect(overlaps == 0, f"{overlaps} texts overlap")


def check_time(browser, checks):
    """Check that playing, steps, the time bar and clicks on plots change the time and the picture."""
    checks.expect(not browser.run("playing"), "a page with #t= in its address plays")
    checks.expect(abs(browser.run("now") - 0.5) < 1e-6, "the page does not show the time after #t=")
    before = browser.run(INK)
    key(browser, "ArrowRight")
    wait(browser)
    checks.expect(browser.run("now") > 0.5 and browser.run(INK) != before, "the right arrow key makes no step")
    key(browser, "Home")
    wait(browser)
    checks.expect(browser.run("now === first"), "Home does not show the first frame")
    key(browser, " ")
    time.sleep(0.6)
    checks.expect(browser.run("playing && now > first"), "the space bar does not play")
    key(browser, " ")
    checks.expect(not browser.run("playing"), "the space bar does not pause")
    browser.run("(() => { const bar = find('time'); bar.value = 0.75;"
                " bar.dispatchEvent(new Event('input', {bubbles: true})); })()")
    wait(browser)
    checks.expect(abs(browser.run("(now - first) / span") - 0.75) < 1e-6, "the time bar does not change the time")
    browser.click("#plots canvas")
    wait(browser)
    checks.expect(abs(browser.run("(now - first) / span") - 0.5) < 0.1, "a click on a plot does not change the time")
    browser.click("#play")
    time.sleep(0.2)
    checks.expect(browser.run("playing"), "the play button does not play")
    browser.click("#play")


# Rotates a body by TURN [rad] between the first two samples, and returns which fraction of this
# rotation the page shows after 0.4 of the interval. The page interpolates only small rotations.
SHARE_SHOWN = """(() => {
  const column = table[3 + bodies.find(body => body.kind === 'body').q], kept = column[1];
  column[1] = column[0] + TURN;
  const share = at(times[0] + .4 * (times[1] - times[0]))[2];
  column[1] = kept;
  return share;
})()"""


def check_coarse(browser, checks):
    for turn, shown in ((0.1, 0.4), (0.5, 0), (2 * np.pi + 0.1, 0.4)):
        share = browser.run(SHARE_SHOWN.replace("TURN", str(turn)))
        checks.expect(abs(share - shown) < 1e-9, f"the page shows {share} of a rotation of {turn:.1f} rad")


def check_view(browser, spatial, checks):
    before = browser.run("[view.scale, view.azimuth, view.shift[0]]")
    mouse(browser, ("mouseWheel", 0.5, 0.5), deltaX=0, deltaY=-300)
    checks.expect(browser.run("view.scale") > before[0], "the wheel does not zoom")
    mouse(browser, ("mousePressed", 0.4, 0.5), ("mouseMoved", 0.6, 0.6), ("mouseReleased", 0.6, 0.6))
    after = browser.run("[view.scale, view.azimuth, view.shift[0]]")
    moved = 1 if spatial else 2
    checks.expect(after[moved] != before[moved], "dragging does not rotate the view" if spatial else "dragging does not move the view")
    if spatial:  # points near the eye must follow the pointer
        browser.run("window.near = view.centre.map((x, i) => x + 50 / view.scale * view.axes[6 + i])")
        x, y, _ = browser.run("project(near)")
        mouse(browser, ("mousePressed", 0.5, 0.5), ("mouseMoved", 0.52, 0.52), ("mouseReleased", 0.52, 0.52))
        moved_x, moved_y, _ = browser.run("project(near)")
        checks.expect(moved_x > x and moved_y > y, "a point near the eye does not follow the pointer")
        before = browser.run("[...view.axes, ...view.shift]")
        mouse(browser, ("mousePressed", 0.5, 0.5), ("mouseMoved", 0.6, 0.5), ("mouseReleased", 0.6, 0.5), modifiers=8)
        after = browser.run("[...view.axes, ...view.shift]")
        checks.expect(after[:9] == before[:9] and after[9] > before[9], "dragging with Shift does not move the picture")
    key(browser, "0")
    wait(browser)
    checks.expect(abs(browser.run("view.shift[0]")) < 1e-9, "the key 0 does not reset the view")
    for name in ("n", "c", "r", "t"):
        before = browser.run(INK)
        key(browser, name)
        wait(browser)
        checks.expect(browser.run(INK) != before, f"the key {name} changes nothing")
        key(browser, name)
        wait(browser)
        checks.expect(browser.run(INK) == before, f"pressing the key {name} again does not restore the picture")


def check_names(browser, checks):
    """Check that names are written inside the stage and do not overlap."""
    browser.run("find('names').checked = true")
    for share in (0, 0.3, 0.6, 1):
        rooms, wide, high = browser.run(
            f"(now = first + {share} * span, draw(), [drawNames(framesAt(at(now))), wide, high])")
        checks.expect(len(rooms) > 3, f"only {len(rooms)} names are shown")
        inside = all(a[0] >= 0 and a[1] >= 0 and a[2] <= wide and a[3] <= high for a in rooms)
        checks.expect(inside, "a name is outside the picture")
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
    checks.expect(browser.run("window.saved") == "mechanism.webm", "no video is saved")


def check_solids(browser, seen, checks):
    checks.expect(browser.run("solids !== null"), "the page does not use WebGL")
    for tilt in (1.2, 0.9):
        browser.run(f"view.azimuth = 0, view.tilt = {tilt}, fit()")
        all_found = browser.run(f"{BODIES_AT}({json.dumps([point for point, _ in seen])})")
        for (point, body), found in zip(seen, all_found):
            checks.expect(found == body, f"body {found} is visible at {np.round(point, 2)} instead of body {body}")


def check_lost_context(browser, seen, checks):
    before = browser.run(INK)
    browser.run("window.lost = solids.gl.getExtension('WEBGL_lose_context'), lost.loseContext()")
    wait(browser, "solids")
    checks.expect(browser.run("solids === null") and browser.run(INK) != before, "the page ignores the loss of the WebGL context")
    browser.run("lost.restoreContext()")
    wait(browser, "!solids")
    check_solids(browser, seen, checks)


def check_marks(browser, checks):
    looks = browser.run("Array.from(document.querySelectorAll('#ticks button')).map(e => {"
                        " const s = getComputedStyle(e, '::before'); return [s.backgroundColor, s.clipPath]; })")
    for what, values in zip(("colour", "shape"), zip(*looks)):
        checks.expect(len(set(values)) == 3, f"marks of different kinds have the same {what}: {values}")


def touch(browser, *moments):
    """Move two fingers through the positions `moments`, which are fractions of the width and the
    height of the stage."""
    left, top, width, height = browser.run("(() => { stage.scrollIntoView({block: 'center'});"
                                           " const r = stage.getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })()")
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True)
    for k, fingers in enumerate(moments):
        points = [{"x": left + x * width, "y": top + y * height, "id": i} for i, (x, y) in enumerate(fingers)]
        browser.call("Input.dispatchTouchEvent", type="touchMove" if k else "touchStart", touchPoints=points)
    browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    wait(browser)


def check_two_fingers(browser, spatial, checks):
    """Check that two fingers move and zoom the picture and, in space, rotate it. The points below
    the fingers must stay there."""
    place = "[view.scale, view.azimuth, view.tilt, ...view.shift]"
    key(browser, "0")
    wait(browser)
    before = browser.run(place)
    touch(browser, [(0.4, 0.5), (0.6, 0.5)], [(0.3, 0.5), (0.7, 0.5)])
    after = browser.run(place)
    checks.expect(abs(after[0] / before[0] - 2) < 0.02 and abs(after[1] - before[1]) < 1e-6, "two fingers do not zoom")
    checks.expect(np.hypot(*np.subtract(after[3:], before[3:])) < 2, "zooming about the middle moves the picture")
    touch(browser, [(0.4, 0.5), (0.6, 0.5)], [(0.4, 0.6), (0.6, 0.6)])
    moved = browser.run(place)
    height = browser.run("high")
    checks.expect(abs(moved[4] - after[4] - 0.1 * height) < 2, "two fingers do not move the picture")
    touch(browser, [(0.4, 0.5), (0.6, 0.5)], [(0.45, 0.42), (0.55, 0.58)])
    turned = browser.run(place)[1] - moved[1]
    checks.expect(turned > 0.5 if spatial else turned == 0, f"two fingers rotate the picture by {turned} rad")
    key(browser, "0")
    wait(browser)


def check_speed(browser, page, checks):
    """Measure how long it takes to draw a frame. In space this includes a wait for WebGL, which is
    slow here because software replaces a graphics card. The limit therefore applies to the time
    without this wait."""
    browser.size(1280, 900)
    browser.open(page)
    took, script = browser.run(
        "(() => { play(false); const copy = pen.drawImage.bind(pen); let waited = 0, least = [Infinity, Infinity];"
        " pen.drawImage = (...a) => { const begin = performance.now(); copy(...a); waited += performance.now() - begin; };"
        # the shortest batch counts, because other programs disturb the measurement
        " for (let batch = 0; batch < 20; batch++) { const begin = performance.now(); waited = 0;"
        " for (let k = 0; k < 5; k++) { now = first + span * k / 5; draw(); }"
        " const took = performance.now() - begin;"
        " least = [Math.min(least[0], took / 5), Math.min(least[1], (took - waited) / 5)]; } return least; })()")
    print(f"{checks.where}, 50 bodies: {took:.2f} ms a frame, script {script:.2f} ms")
    checks.expect(script <= FRAME, f"the script takes {script:.2f} ms for a frame of 50 bodies")


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
                    if name == "plane":
                        check_coarse(browser, checks)
                    check_view(browser, name == "space", checks)
                    check_two_fingers(browser, name == "space", checks)
                    browser.run("find('names').click(), find('centres').click()")
                    wait(browser)
                    browser.screenshot(os.path.join(folder, f"{name}_{width}_{scheme}.png"), not phone)
                    check_names(browser, checks)
                    check_quiet(browser, checks)
            check_video(browser, checks)
        page = os.path.join(folder, "solids.html")
        seen = write_solids(os.path.join(folder, "space.html"), page)
        for width, height, phone in SIZES:
            for scheme in ("light", "dark"):
                checks.where = f"solids {width} {scheme}"
                browser.size(width, height, phone, scheme)
                browser.open(f"{page}?{width}{scheme}#t=0")
                check_solids(browser, seen, checks)
                check_lost_context(browser, seen, checks)
                check_marks(browser, checks)
                browser.screenshot(os.path.join(folder, f"solids_{width}_{scheme}.png"), not phone)
                check_quiet(browser, checks)
        for checks.where, make in (("plane", many), ("space", many_in_space)):
            page = os.path.join(folder, f"many_in_{checks.where}.html")
            make().page(page)
            check_speed(browser, page, checks)
    print(f"pictures are in {folder}; {len(checks.wrong)} wrong")
    return 1 if checks.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
