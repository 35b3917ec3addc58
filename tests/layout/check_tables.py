# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the tables of the documents contain what the programs print.

usage: check_tables.py [--write] PROJECT FORMULATIONS BENCH_FORMULATIONS

The program compares the tables in docs/measured.md (examples/formulations) and
docs/theory/formulations.md (tests/bench/bench_formulations) with what these programs print. Times
are not compared. Counts must agree within 12 %, and other numbers within a factor of 3, because
rounding may decide about single steps: between builds with and without optimization, the counts of
IDA differ by up to 9 %. Numbers below 1e-12 are rounding errors and are not compared. With --write,
everything except times is copied into the documents.
"""

import re
import subprocess
import sys

COUNT, FACTOR, ROUNDING = 0.12, 3.0, 1e-12
NUMBER = re.compile(r"(?<![\w.-])\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])")
WALL = 3  # the column of docs/measured.md that contains times
PROBLEMS = {"pendulum A01, 10 s": "pendulum, 10 s", "free slider-crank, 0.2 s: 5 turns": "free slider-crank, 0.2 s",
            "Grashof four-bar, 5 s": "four-bar, 5 s", "Andrews' mechanism, 7 bodies, 0.03 s": "Andrews, 0.03 s"}
FORMS = "ida/index3", "ida/index2", "ida/ggl", "ida/baumgarte"


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def with_short_exponents(text):
    return re.sub(r"e([-+])0*(\d)", lambda m: "e" + m[1].strip("+") + m[2], text)


def formulations(program, present):
    """Return the rows for docs/measured.md. Their times are copied from the present document,
    because times are not compared."""
    printed = run(program)
    first = next(k for k, line in enumerate(printed) if line.startswith("integrator "))
    rows = printed[first + 1:printed.index("", first)]
    for k, old in enumerate(present[:len(rows)]):
        new, column = rows[k], [m.span() for m in re.finditer(r"\S+", rows[k])][WALL]
        wall = old.split()[WALL].rjust(column[1] - column[0])
        rows[k] = new[:column[1] - len(wall)] + wall + new[column[1]:]
    return rows


def bench(program, *methods):
    """Return {(problem, method, k): cells}, where k is the number of the tolerance or step."""
    found, rung = {}, {}
    for line in run(program, *methods)[2:]:
        problem, method, _, *cells = (cell.strip() for cell in line.strip("| ").split("|"))
        if problem in PROBLEMS:
            key = PROBLEMS[problem], method
            rung[key] = rung.get(key, -1) + 1
            found[(*key, rung[key])] = [with_short_exponents(cell) for cell in cells]
    return found


ERROR, PHI, PHI_RATE, STEPS, EVALUATIONS = range(5)


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def tables(project, formulations_program, bench_program):
    """Return a list of all tables. Each entry contains the document, the beginning of the
    table's first line, the number of lines of the table above its first row of data, and a function
    that returns the rows of data."""
    ida, fixed = bench(bench_program), bench(bench_program, "generalized_alpha/index3", "rk4/projection")

    def cells(found, problem, method, rung, *which):
        return ", ".join(found[problem, method, rung][k] for k in which)

    def costs(_):
        return [row(problem if k == 0 else "", rtol, *(cells(ida, problem, f, k, ERROR, STEPS, EVALUATIONS) for f in FORMS))
                for problem in PROBLEMS.values() for k, rtol in enumerate(("1e-4", "1e-6", "1e-8"))]

    def kept(_):
        return [row(title, *(cells(ida, "four-bar, 5 s", f, 1, k) for f in FORMS))
                for title, k in (("largest Phi [m]", PHI), ("largest Phi' [m/s]", PHI_RATE))]

    def rivals(_):
        return [row(problem, *("; ".join(cells(fixed, problem, method, k, ERROR, EVALUATIONS) for k in (1, 2))
                               for method in ("generalized_alpha/index3", "rk4/projection")))
                for problem in PROBLEMS.values()]

    theory = project + "/docs/theory/formulations.md"
    return [(project + "/docs/measured.md", "integrator           formulation", 1, lambda old: formulations(formulations_program, old)),
            (theory, "| | rtol | INDEX3 | INDEX2 | GGL | BAUMGARTE |", 2, costs),
            (theory, "| | INDEX3 | INDEX2 | GGL | BAUMGARTE |", 2, kept),
            (theory, "| | generalized-alpha | rk4, projection |", 2, rivals)]


def agree(a, b):
    if a.isdigit() and b.isdigit():
        return abs(int(a) - int(b)) <= COUNT * max(int(a), int(b))
    low, high = sorted((float(a), float(b)))
    return high < ROUNDING or high <= FACTOR * low


def same(old, new):
    """Return whether two cells agree. Their texts must be equal, and their numbers must agree."""
    return (NUMBER.sub("#", old).split() == NUMBER.sub("#", new).split()
            and all(map(agree, NUMBER.findall(old), NUMBER.findall(new))))


def main(arguments):
    write = "--write" in arguments
    failures = 0
    for document, head, skip, make in tables(*(a for a in arguments if a != "--write")):
        with open(document, encoding="utf-8") as file:
            lines = file.read().split("\n")
        first = skip + next(k for k, line in enumerate(lines) if line.startswith(head))
        rows = make(lines[first:])
        for old, new in zip(lines[first:first + len(rows)], rows):
            if not same(old, new):
                failures += 1
                print(f"{document}:\n- {old}\n+ {new}")
        print(f"{document}: {len(rows)} rows")
        if write:
            lines[first:first + len(rows)] = rows
            with open(document, "w", encoding="utf-8") as file:
                file.write("\n".join(lines))
    return 1 if failures and not write else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
