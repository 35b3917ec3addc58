# SPDX-License-Identifier: BSD-3-Clause
"""usage: capture.py FOLDER NAME TITLE PROGRAM [ARGUMENT...]

Runs a Python program in a folder. If the program has written no page of a motion, writes FOLDER/NAME.html with the title
TITLE. This page shows the run that has the most samples among the first runs of the program. If the program has written
no drawing, writes FOLDER/NAME.svg, which shows the mechanism of this run or, without a run, the first frozen mechanism.
Also writes the figure FOLDER/NAME_figure.svg with the curves of the first page that has curves. If the mechanism has no
drawing, the figure plots the run."""

import runpy
import sys
import warnings
from pathlib import Path

import baum
import matplotlib.pyplot as plt
from baum import drawings

SHOWN = 400  # more samples than this do not make a run better for a page
KEPT = 4  # only the first KEPT runs of the program are considered


def remember(cls, name, found, choose):
    method = getattr(cls, name)

    def call(self, *arguments, **options):
        result = method(self, *arguments, **options)
        found.append(choose(self, result))
        return result

    setattr(cls, name, call)


def remember_motions(found):
    page = drawings.page

    def call(motion):
        found.append(motion)
        return page(motion)

    drawings.page = call


def write_figure(motion, path):
    """Plot the curves of a page over time, curves of the same unit in the same frame."""
    groups = {}
    for label, values in motion.plots:
        name, _, unit = label.partition(" [")
        groups.setdefault(unit and f"[{unit}", []).append((name, values))
    count = len(groups)
    plt.rcParams["svg.hashsalt"] = path.stem  # the same file in each build
    figure, frames = plt.subplots(
        count, sharex=True, squeeze=False, figsize=(6.4, 1 + 1.6 * count), layout="constrained"
    )
    for frame, (unit, curves) in zip(frames.flat, groups.items()):
        for name, values in curves:
            frame.plot(motion.t, values, label=name)
        frame.set_ylabel(unit)
        frame.grid(alpha=0.3)
        frame.legend(fontsize="small", loc="lower left", bbox_to_anchor=(0, 1), ncols=3)
    frames[-1, 0].set_xlabel("t [s]")
    figure.savefig(path, metadata={"Date": None})


def main():
    folder, name, title, program, *arguments = sys.argv[1:]
    runs, mechanisms, motions = [], [], []
    remember_motions(motions)
    remember(baum.Mechanism, "simulate", runs, lambda m, run: run)
    remember(baum.Mechanism, "freeze", mechanisms, lambda m, same: m)
    sys.argv = [program, *arguments]
    sys.path.insert(0, str(Path(program).parent))
    code = 0
    try:
        runpy.run_path(program, run_name="__main__")
    except SystemExit as exit:
        code = exit.code
    if code:
        return code
    folder = Path(folder)
    run = max(runs[:KEPT], key=lambda run: min(len(run.t), SHOWN), default=None)
    m = run.mechanism if run is not None else mechanisms[0] if mechanisms else None
    drawable = m is not None and "<title>" in str(m.draw())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if drawable and run is not None and len(run.t) > 20 and not list(folder.glob("*.html")):
            run.page(folder / f"{name}.html", title=title)
        if drawable and not list(folder.glob("*.svg")):
            m.draw(*([] if run is None else [run.q[0]])).save(folder / f"{name}.svg")
    for motion in [motion for motion in motions if motion.plots][:1]:
        write_figure(motion, folder / f"{name}_figure.svg")
    if run is not None and not drawable:
        run.plot()[0].figure.savefig(folder / f"{name}_figure.svg", metadata={"Date": None})
    return 0


if __name__ == "__main__":
    sys.exit(main())
