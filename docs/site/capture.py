# SPDX-License-Identifier: BSD-3-Clause
"""usage: capture.py FOLDER NAME TITLE PROGRAM [ARGUMENT...]

Runs a Python program in a folder. If the program has written no page of a motion, writes FOLDER/NAME.html, with this
title, for the run with the most samples among the first runs of the program. If it has written no drawing, writes
FOLDER/NAME.svg, which shows the mechanism of this run, or the first frozen mechanism."""

import runpy
import sys
import warnings
from pathlib import Path

import baum

SHOWN = 400  # samples that are enough for a page
KEPT = 4  # runs that are considered


def remember(cls, name, found, choose):
    method = getattr(cls, name)

    def call(self, *arguments, **options):
        result = method(self, *arguments, **options)
        found.append(choose(self, result))
        return result

    setattr(cls, name, call)


def main():
    folder, name, title, program, *arguments = sys.argv[1:]
    runs, mechanisms = [], []
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
    return 0


if __name__ == "__main__":
    sys.exit(main())
