# SPDX-License-Identifier: BSD-3-Clause
"""Functions that the Python examples share: tables, checks, and a JSON file that contains both. An
example fails if one of its checks fails.

The JSON file has the same form as the files that the C examples write: "name": {"columns": {key:
title}, "rows": [{key: value}]}, "checks", "ok".
"""

import argparse
import json
import math
from typing import Any, Iterable, Sequence

from baum import Counters, library_version


class Report:
    """The command line of an example, its tables and its checks."""

    def __init__(self, name: str, **options: str) -> None:
        parser = argparse.ArgumentParser(prog=name)
        for option, explanation in {"json": "file for tables and checks", **options}.items():
            parser.add_argument(f"--{option}", metavar="FILE", help=explanation)
        self.options = parser.parse_args()
        self._tables: dict[str, Any] = {"example": name, "version": library_version}
        self._checks: list[dict[str, Any]] = []

    def table(
        self, name: str, columns: dict[str, tuple[str, str]], rows: Iterable[Sequence[Any]]
    ) -> None:
        """Print a table, and store it for the JSON file. columns: key -> (title, format); rows:
        lists of values."""
        widths = {
            key: max(len(title), len(self._text(form, -1.0 if "s" not in form else "")))
            for key, (title, form) in columns.items()
        }
        left = {key: "<" if "s" in form else ">" for key, (_, form) in columns.items()}
        print("  ".join(f"{title:{left[key]}{widths[key]}}" for key, (title, _) in columns.items()))
        for row in rows:
            print(
                "  ".join(
                    f"{self._text(form, value):{left[key]}{widths[key]}}"
                    for (key, (_, form)), value in zip(columns.items(), row)
                )
            )
        print()
        self._tables[name] = {
            "columns": {key: title for key, (title, _) in columns.items()},
            "rows": [dict(zip(columns, map(self._number, row))) for row in rows],
        }

    @staticmethod
    def _text(form: str, value: Any) -> str:
        return "-" if isinstance(value, float) and math.isnan(value) else format(value, form)

    @staticmethod
    def _number(value: Any) -> Any:
        """Return a value for JSON. NaN becomes None, because JSON has no NaN."""
        return (
            value
            if isinstance(value, (str, int))
            else float(value)
            if math.isfinite(value)
            else None
        )

    def counters(self, counters: Counters) -> None:
        """Print the cost of a run, and store it for the JSON file."""
        kept = {
            key: getattr(counters, key)
            for key in ("steps", "evaluations", "rejected", "factorizations")
        }
        print("   ".join(f"{key} {value}" for key, value in kept.items()))
        self._tables["counters"] = kept

    def expect(self, name: str, value: Any, limit: float) -> None:
        """Check that value <= limit. The check fails for NaN."""
        ok = bool(value <= limit)
        print(f"check  {name:40}  {value:8.1e} <= {limit:<7.1e}  {'ok' if ok else 'FAILED'}")
        self._checks.append({"name": name, "value": self._number(value), "limit": limit, "ok": ok})

    def end(self) -> int:
        """Write the JSON file, and return the exit code."""
        ok = all(check["ok"] for check in self._checks)
        if self.options.json:
            with open(self.options.json, "w", encoding="utf-8") as file:
                json.dump({**self._tables, "checks": self._checks, "ok": ok}, file, indent=1)
        return 0 if ok else 1
