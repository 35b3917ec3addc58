# SPDX-License-Identifier: BSD-3-Clause
"""Measures how much a live view slows a run. The same work is done alternately without and with a
view.

usage: bench_view.py [PAIRS]

Two processes read the frames, in the same way as browsers. The times are CPU times, because other
programs may be using the machine. The table shows the relative cost of calls. It also shows what a
frame costs the thread of the run, and what it costs the threads that serve the pages. The last
column is the sum of these costs at 60 frames per second. It is the largest slowdown of a run, which
occurs on a machine with a single core.
"""

import contextlib
import subprocess
import sys
import threading
import time

import numpy as np

import baum
from baum import live

WORK = 0.25  # [s] duration of each piece of work
READ = "import sys, urllib.request as r\nfor line in r.urlopen(sys.argv[1] + 'events'): pass"


def crank():
    m = baum.Mechanism()
    crank = m.planar_body("crank", mass=1, inertia=0.1, position=(0.5, 0), angular_velocity=5, held=True)
    rod = m.planar_body("rod", mass=1, inertia=0.4, position=(2, 0))
    slider = m.planar_body("slider", mass=1, inertia=0.1, position=(3, 0))
    m.revolute("O", m.ground, crank, point=(0, 0))
    m.revolute("A", crank, rod, point=(1, 0))
    m.revolute("B", rod, slider, point=(3, 0))
    m.translational("guide", m.ground, slider, point=(3, 0))
    return m.freeze()


def chain(count):
    m = baum.Mechanism()
    before = m.ground
    for k in range(count):
        body = m.planar_body(f"body {k}", mass=1, inertia=0.1, position=(k + 0.5, 0))
        m.revolute(f"joint {k}", before, body, point=(k, 0))
        before = body
    return m.freeze()


def loop(s, steps):
    for _ in range(steps):
        s.step()


def call(s, steps):
    s.step(steps)


@contextlib.contextmanager
def pages(view, count=2):
    readers = [subprocess.Popen([sys.executable, "-c", READ, view.url]) for _ in range(count)]
    time.sleep(0.5)
    yield
    for reader in readers:
        reader.terminate()
        reader.wait()


def spend(work, s, steps):
    """Return the CPU time of the thread that advances the run, the CPU time of all other threads,
    and the wall time [s]."""
    begin = time.thread_time(), time.process_time(), time.perf_counter()
    work(s, steps)
    end = time.thread_time(), time.process_time(), time.perf_counter()
    own, all_threads, wall = (b - a for a, b in zip(begin, end))
    return np.array([own, all_threads - own, wall])


def measure(label, mechanism, work, pairs):
    """Print the costs of a view. Two runs are used, because access to the memory of one of them may
    be faster. Each run is measured both with and without the view."""
    runs = [mechanism.simulation("rk4", step=1e-5) for _ in range(2)]
    work(runs[0], 1000)
    steps = max(int(1000 * WORK / spend(work, runs[0], 1000)[0]), 1)
    halves = [compare(work, steps, runs[k], runs[1 - k], pairs // 2) for k in (0, 1)]
    call, frame, other = np.mean(halves, axis=0)
    total = 100 * (call + 60 * (frame + other))
    print(f"{label:<40}{100 * call:9.1f} %{1e6 * frame:9.0f} us{1e6 * other:9.0f} us{total:9.1f} %")


def compare(work, steps, plain, seen, pairs):
    """Return the median of the relative cost of calls, and the medians of the CPU times [s] that a
    frame costs the thread of the run and the other threads."""
    found = []
    with seen.view(browser=False) as view, pages(view):
        for k in range(pairs):
            costs = []
            # with a frame every 10 s there are practically no frames, and only calls cost time
            for frame in (10.0, 1 / 60):
                live.FRAME = frame
                spent = {s: spend(work, s, steps) for s in ((plain, seen) if k % 2 else (seen, plain))}
                costs.append(((spent[seen] - spent[plain])[0] / spent[plain][0], *spent[seen]))
            (call, *_), (both, own, others, wall) = costs
            found.append((call, (both - call) * own / (60 * wall), others / (60 * wall)))
    return np.median(found, axis=0)


def main():
    pairs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    print(f"medians of {pairs} pairs with two pages")
    print(f"{'':<40}{'calls':>11}{'a frame':>12}{'pages':>12}{'at most':>11}")
    # Baum runs every call of the main thread in a second thread, so that Ctrl-C can stop it. The
    # measurements are made outside of the main thread, where calls are made directly.
    thread = threading.Thread(target=measure_all, args=[pairs])
    thread.start()
    thread.join()


def measure_all(pairs):
    for label, mechanism in (("slider-crank", crank()), ("chain of 50", chain(50)), ("chain of 500", chain(500))):
        measure(f"{label}, one call", mechanism, call, pairs)
        measure(f"{label}, one call for each step", mechanism, loop, pairs)


if __name__ == "__main__":
    main()
