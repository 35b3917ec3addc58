# SPDX-License-Identifier: BSD-3-Clause
"""usage: check_live.py FOLDER

Operates live views of planar and spatial runs in headless Chromium. Checks that frames arrive, that
buttons and keys pause, step and resume the run, and that the page shows the past and the end of the
run. Saves screenshots in FOLDER, and lists the checks that fail.
"""

import os
import sys
import threading
import time

import moving
from check_motion import NAME, SIZES, Checks, check_layout, key, wait
from chromium import Chromium

STEP = 1e-3  # [s]
STEPS = 10  # number of steps in each call


def plane():
    m = moving.plane(NAME)
    return m.freeze(), [m["rod"]]


def space():
    m = moving.space(NAME)
    return m.freeze(), [m["other"]]


class Loop:
    """Advances a run in real time, in a thread."""

    def __init__(self, simulation):
        self.simulation = simulation
        self.going = True
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        while self.going:
            self.simulation.step(STEPS)
            time.sleep(STEP * STEPS)

    def steps(self):
        """Return the number of steps made so far. The time of a run can be read while the thread
        makes steps."""
        return round(self.simulation.time / STEP)

    def end(self):
        self.going = False
        self._thread.join(10)


def until(browser, expression):
    """Wait until an expression is true. Return False if this takes too long."""
    for _ in range(400):
        if browser.run(expression):
            return True
        time.sleep(0.02)
    return False


def is_held(loop):
    before = loop.steps()
    time.sleep(0.3)
    return loop.steps() == before


def check_frames(browser, loop, checks):
    checks.expect(until(browser, "times.length > 20"), "no frames arrive")
    checks.expect(browser.run("now === last && following_now()"), "the page does not show the newest frame")
    checks.expect(browser.run("times.every((t, k) => k === 0 || t > times[k - 1])"), "times do not increase")
    checks.expect(browser.run("table.every(column => column.length === times.length)"), "the columns differ in length")
    checks.expect(browser.run("traces[0].points.length === times.length"), "the path does not grow")
    begin, since = browser.run("times.length"), time.monotonic()
    time.sleep(1)
    rate = (browser.run("times.length") - begin) / (time.monotonic() - since)
    checks.expect(rate > 20, f"{rate:.0f} frames a second")
    # The mean counts from the opening of the page, because a busy browser may handle several
    # waiting frames at once.
    mean = browser.run("1000 * times.length / performance.now()")
    checks.expect(mean <= 61, f"{mean:.0f} frames a second on average")
    inside = ("framesAt(at(last)).every(({r}) => { const [x, y] = project(r); "
              "return x >= 0 && x <= wide && y >= 0 && y <= high; })")
    checks.expect(browser.run(inside), "a body is outside the picture")
    return rate


def check_buttons(browser, loop, checks):
    checks.expect(browser.run("find('play').textContent") == "Pause", "the button is not named Pause")
    browser.click("#play")
    checks.expect(until(browser, "find('play').textContent === 'Run'") and is_held(loop), "Pause does not pause the run")
    before = loop.steps()
    browser.click("#play + button")  # the button Step
    time.sleep(0.3)
    checks.expect(loop.steps() == before + 1, f"Step makes {loop.steps() - before} steps")
    browser.run("document.activeElement.blur()")
    key(browser, "ArrowRight")
    time.sleep(0.3)
    checks.expect(loop.steps() == before + 2, f"the arrow key makes {loop.steps() - before - 1} steps")
    checks.expect(until(browser, f"Math.abs(now - {loop.simulation.time}) < 1e-9"), "the page does not show the last step")
    key(browser, "ArrowLeft")
    wait(browser)
    checks.expect(browser.run("now < last && !following_now()"), "the arrow key does not show the past")
    key(browser, " ")
    time.sleep(0.3)
    checks.expect(not is_held(loop), "the space bar does not resume the run")
    checks.expect(browser.run("now < last"), "new frames replace the view of the past")
    key(browser, "End")
    time.sleep(0.2)
    checks.expect(browser.run("now === last && following_now()"), "the key End does not show the newest frames again")
    browser.run("(() => { const bar = find('time'); bar.value = 0.25;"
                " bar.dispatchEvent(new Event('input', {bubbles: true})); })()")
    checks.expect(browser.run("now < last && !following_now()"), "the time bar does not show the past")
    key(browser, "End")


def check_quiet(browser, checks):
    checks.expect(browser.complaints() == [], f"the console shows {browser.complaints()}")
    foreign = [url for url in browser.requests() if not url.startswith("http://127.0.0.1:")]
    checks.expect(foreign == [], f"the page requested {foreign}")
    checks.expect(browser.run("window.taken") is None, "a name was executed as a script")


def check_page(browser, name, make, folder, checks):
    m, traces = make()
    with m.simulation("rk4", step=STEP) as s, s.view(title=NAME, traces=traces, browser=False) as view:
        loop = Loop(s)
        for width, height, phone in SIZES:
            for scheme in ("light", "dark"):
                checks.where = f"live {name} {width} {scheme}"
                browser.size(width, height, phone, scheme)
                browser.open(f"{view.url}?{width}{scheme}")
                browser.run("window.following_now = () => Array.from(document.querySelectorAll('.bar button'))"
                            ".find(b => b.textContent === 'Newest').hidden")
                rate = check_frames(browser, loop, checks)
                check_buttons(browser, loop, checks)
                check_layout(browser, checks)
                browser.screenshot(os.path.join(folder, f"live_{name}_{width}_{scheme}.png"), not phone)
                check_quiet(browser, checks)
        loop.end()
        view.close()
        checks.expect(until(browser, "find('play').textContent === 'Ended'"), "the page does not show that the run has ended")
        print(f"{name}: {rate:.0f} frames a second")


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    checks = Checks()
    with Chromium() as browser:
        for name, make in (("plane", plane), ("space", space)):
            check_page(browser, name, make, folder, checks)
    print(f"pictures are in {folder}; {len(checks.wrong)} wrong")
    return 1 if checks.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
