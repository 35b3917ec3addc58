# SPDX-License-Identifier: BSD-3-Clause
"""Measures what short runs and user functions cost in Python. The short runs are runs of the
slider-crank over 2 s. The user functions are those of the pendulum of the README. For user
functions, the program prints the number of calls in a step of rk4, and the overhead of a call. The
overhead is the time of a call without the time of the function itself.

    PYTHONPATH=bindings/python python3 tests/bench/bench_python.py [quick] [full]

With `quick` or `full`, the program also measures a study of the pendulum over 2 s. The study uses
the grid of this name.

To find the overhead, the program also makes a run whose functions compute the same values in C, and
compares the times of both runs. This needs a C compiler. Times of short runs are wall times, and
all other times are CPU times. Each time is the smallest one of several runs.
"""
import ctypes
import sys
import time
import timeit
from functools import partial
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))

import baum
from baum import catalog
from compiler import CC, Folder

STEPS, REPEATS = 1000, 7
SHORT_RUNS = 300

C = """
int phi(double t, const double *q, double *out, void *user)
{ (void)t; (void)user; out[0] = q[0] * q[0] + q[1] * q[1] - 1.0; return 0; }
int jacobian(double t, const double *q, double *out, void *user)
{ (void)t; (void)user; out[0] = 2.0 * q[0]; out[1] = 2.0 * q[1]; return 0; }
int gamma(double t, const double *q, const double *v, double *out, void *user)
{ (void)t; (void)q; (void)user; out[0] = -2.0 * (v[0] * v[0] + v[1] * v[1]); return 0; }
"""

PYTHON = {
    "phi": lambda t, q: q @ q - 1,
    "jacobian": lambda t, q: 2 * q,
    "gamma": lambda t, q, v: -2 * (v @ v),
}


def pendulum(functions):
    m = baum.Mechanism()
    bob = m.planar_particle("bob", mass=1, position=(1, 0))
    m.constraint("rod", [bob], rows=1, **functions)
    return m.freeze()


def seconds_of(functions):
    """Return the smallest CPU time that the steps take."""
    times = []
    for _ in range(REPEATS):
        s = pendulum(functions).simulation("rk4", step=1e-3)
        begun = time.process_time()
        s.step(STEPS)
        times.append(time.process_time() - begun)
    return min(times)


def calls_of(functions):
    """Return how often each function is called in a step."""
    calls = dict.fromkeys(functions, 0)

    def counted(name):
        def call(*arguments):
            calls[name] += 1
            return functions[name](*arguments)

        return call

    s = pendulum({name: counted(name) for name in functions}).simulation("rk4", step=1e-3)
    s.step(100)
    before = dict(calls)
    s.step(100)
    return {name: (calls[name] - before[name]) / 100 for name in calls}


def own_seconds(name):
    """Return the time that the function itself takes."""
    q = np.array([0.6, 0.8])
    arguments = (0.0, q, q) if name == "gamma" else (0.0, q)
    timer = timeit.Timer(partial(PYTHON[name], *arguments), timer=time.process_time)
    return min(timer.repeat(number=20000, repeat=REPEATS)) / 20000


def report(names, library):
    functions = {name: PYTHON[name] for name in names}
    calls = calls_of(functions)
    step = seconds_of(functions) / STEPS
    print(f"{', '.join(names)}: {sum(calls.values()):.0f} calls a step, {1e6 * step:.0f} us a step")
    if library is not None:
        compiled = seconds_of({name: getattr(library, name) for name in names}) / STEPS
        own = sum(calls[name] * own_seconds(name) for name in names)
        beyond = (step - compiled - own) / sum(calls.values())
        print(f"    {1e6 * compiled:.1f} us a step with the same functions in C")
        print(f"    {1e6 * beyond:.2f} us a call beyond what the function itself takes")


def report_study(grid, language, phi):
    begun = time.process_time()
    study = baum.study(pendulum({"phi": phi}), 0, 2, grid=grid).run()
    seconds = time.process_time() - begun
    print(f"study with the {grid} grid, phi in {language}: {len(study)} settings, {seconds:.1f} s")


def short_run(m, options):
    """Return the wall times of creating a run, of advancing it and of reading q, and then the
    counters of the run."""
    clock = time.perf_counter
    times = [clock()]
    s = m.simulation("rk8", rtol=1e-5, **options)
    times.append(clock())
    s.advance_to(2.0)
    times.append(clock())
    _ = s.q
    times.append(clock())
    return np.diff(times), s.counters


def report_short_run(**options):
    m = catalog.build("slider_crank", speed=10.0)
    runs = [short_run(m, options) for _ in range(SHORT_RUNS)]
    create, advance, read = 1e6 * np.min([times for times, _ in runs], axis=0)
    done = runs[0][1]
    what = ", ".join(options.values()) or "default formulation"
    print(
        f"short run, {what}: create {create:.0f} us, advance {advance:.0f} us, read q {read:.1f} us; "
        f"{done.steps} steps, {done.rejected} rejected, {done.evaluations} evaluations"
    )


report_short_run()
report_short_run(formulation="baumgarte")
folder = Folder()
compiled = ctypes.CDLL(folder.shared_object(C)) if CC else None
report(["phi"], compiled)
report(["phi", "jacobian", "gamma"], compiled)
for grid in sys.argv[1:]:
    report_study(grid, "Python", PYTHON["phi"])
    if compiled is not None:
        report_study(grid, "C", compiled.phi)
