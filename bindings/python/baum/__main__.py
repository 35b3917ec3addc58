# SPDX-License-Identifier: BSD-3-Clause
"""Commands for scenes: python -m baum run|study|mobility|draw|check SCENE."""

from __future__ import annotations

import argparse
import csv
import io
import runpy
import sys
from typing import Any

import numpy as np

from . import _files
from .errors import Error
from .mechanism import Mechanism
from .run import Run
from .scenes import load
from .studies import study


def _scene(options: argparse.Namespace) -> Mechanism:
    functions = runpy.run_path(options.functions) if options.functions else {}
    return load(options.scene, functions)


def _write_csv(run: Run, path: str) -> None:
    columns = run.to_dict()
    table = np.column_stack(list(columns.values()))
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(columns)  # names can contain commas
    np.savetxt(text, table, fmt="%.17g", delimiter=",")
    _files.write(path, text.getvalue())


def _run(options: argparse.Namespace) -> None:
    chosen: dict[str, Any] = {name: getattr(options, name) for name in ("rtol", "step")}
    given = {name: value for name, value in chosen.items() if value is not None}
    if options.samples < 2:
        raise ValueError(f"--samples is {options.samples}, must be at least 2")
    times = np.linspace(0.0, options.until, options.samples)
    mechanism = _scene(options).freeze()
    failure = None
    try:
        run = mechanism.simulate(times, options.method, record=options.record, **given)
    except Error as error:
        if error.run is None or not len(error.run.t):
            raise
        failure, run = error, error.run  # write the samples before the failure
    print(run.explain)
    if options.out:
        _write_csv(run, options.out)
    if options.page:
        run.page(options.page, title=options.scene)
    if failure:
        raise failure


def _study(options: argparse.Namespace) -> None:
    result = study(_scene(options).freeze(), 0.0, options.until, grid=options.grid).run()
    print(result.report())
    if options.page:
        result.write(options.page)


def _mobility(options: argparse.Namespace) -> None:
    print(_scene(options).freeze().mobility())


def _draw(options: argparse.Namespace) -> None:
    picture = _scene(options).draw("assembled" if options.assembled else None)
    if options.out:
        picture.save(options.out)
    else:
        print(picture)


def _check(options: argparse.Namespace) -> None:
    mechanism = _scene(options).freeze()
    mechanism.check_derivatives()
    print(f"{options.scene}: {repr(mechanism)[1:-1]}; its derivatives are correct")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m baum", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def add(name: str, call: Any, what: str) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=what, description=what)
        command.set_defaults(call=call)
        command.add_argument("scene", help="a JSON file written by Mechanism.save()")
        command.add_argument("--functions", help="a Python file with the functions of the scene")
        return command

    run = add("run", _run, "Simulate a scene and explain the run.")
    run.add_argument("--method", required=True, help="the integrator, such as rk8")
    run.add_argument("--rtol", type=float, help="tolerance of methods with variable steps")
    run.add_argument("--step", type=float, help="step [s] of methods with fixed steps")
    channel = "a channel, such as energy; this option may be repeated"
    run.add_argument("--record", action="append", default=[], help=channel)
    run.add_argument("--out", help="a CSV file for the samples")
    run.add_argument("--page", help="an HTML file that shows the motion")
    compare = add("study", _study, "Compare methods on a scene: errors, costs, recommendations.")
    compare.add_argument("--page", help="an HTML, CSV, JSON or text file for the report")
    compare.add_argument("--grid", default="quick", help="quick (the default) or full")
    for command in (run, compare):
        command.add_argument("--until", type=float, default=1.0, help="end time [s], default 1")
    run.add_argument("--samples", type=int, default=201, help="number of samples, default 201")
    add("mobility", _mobility, "Count degrees of freedom and find redundant rows.")
    draw = add("draw", _draw, "Draw the design configuration.")
    draw.add_argument("--assembled", action="store_true", help="draw the assembled configuration")
    draw.add_argument("--out", help="an SVG, PDF or PNG file; default: print the SVG text")
    add("check", _check, "Check a scene and the derivatives of its functions.")
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Run a command and return 0. If an error occurs, print its message and return 1."""
    options = _parser().parse_args(arguments)
    try:
        options.call(options)
    except BrokenPipeError:  # the program that reads the output has closed it, for example `head`
        sys.stderr.close()
    except (Error, OSError, KeyError, TypeError, ValueError) as error:
        text = error.args[0] if isinstance(error, KeyError) else error
        print(f"python -m baum: {text}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
