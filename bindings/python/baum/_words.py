# SPDX-License-Identifier: BSD-3-Clause
"""Replaces C names in messages of the library by the names of this package."""

from __future__ import annotations

import re
from typing import Callable, Union

_INTEGRATORS = (
    "euler|semi_implicit_euler|rk2|rk3|rk4|dp5|rk8|ab2|ab3|ab4|rattle|generalized_alpha|"
    "cvode_adams|cvode_bdf|ida|kinematics"
)

# Patterns in the library's texts and their replacements in Python, applied in this order.
TABLE: list[tuple[str, Union[str, Callable[[re.Match[str]], str]]]] = [
    (r"^baum_\w+: ", ""),
    (rf"\bbaum_({_INTEGRATORS})\b(?:\(\))?", r'"\1"'),
    (r"\bbaum_catalog_(\w+)\(\)", r"baum.catalog.\1()"),
    (r"\bbaum_gains_(\w+)\(\)", r"baum.\1()"),
    (r"\bbaum_simulation_(near_singular|counters|energy_account)\(\)", r"\1"),
    (
        r"\bbaum_(?:simulation|study)_(event|warning|method|entry)(?:_at)?\(\)",
        lambda found: {"entry": "entries"}.get(found[1], f"{found[1]}s"),
    ),
    (r"\bbaum_study_set_(error|reference|solution)\(\)", r"\1"),
    (r"\bbaum_mechanism_svg\(\)", "draw()"),
    (r"\bbaum_mechanism_add_input\(\)", "Mechanism.input()"),
    (r"\bbaum_(?:mechanism|simulation|workspace|study)_(\w+)\(\)", r"\1()"),
    (r"\bbaum_channel_of\(\)", "baum.Channel"),
    (r"\bbaum_(\w+)\(\)", r"baum.\1()"),
    (r"\bbaum_(counters|energy_account|mobility|report|near_singular)\b", r"\1"),
    (r"\bbaum_(?:study_)?(\w+)\b", r"\1"),
    (r"\bBAUM_GROUND\b", "ground"),
    (r"\bBAUM_JOINT_REACTION, BAUM_LAMBDA\b", "reaction, multipliers"),
    (r"\bBAUM_((?:OK|WARNED|STOP|ERR)\w*)", r"Status.\1"),
    (
        r"\bBAUM_(?:FORMULATION|START|SOLVER|GAINS|STUDY|BRANCH)_(\w+)",
        lambda found: f'"{found[1].lower()}"',
    ),
    (r"\bBAUM_(\w+)", lambda found: found[1].lower()),
    (
        r"\b(UNSTABILIZED|BAUMGARTE|PROJECTION|INDEX[123]|GGL|DEFAULT)\b",
        lambda found: f'"{found[1].lower()}"',
    ),
    (r"^: count is\b", ": len(times) is"),
    (r"^: s is\b", ": value is"),
    (r"^: ds is\b", ": rate is"),
    (r"^: dds is\b", ": acceleration is"),
    (r"\bbody_count\b", "len(bodies)"),
    (r"\bpoint_count(?= is -?\d+, must be at least 3)", "number of points"),
    (r"\bpoint_count(?= is -?\d+, must be)", "len(bodies)"),
    (r"\brow_count\b", "rows"),
    (r"\bNULL\b", "None"),
]
_RULES = [(re.compile(pattern), instead) for pattern, instead in TABLE]


def in_python(text: str) -> str:
    """Replace the C names in a text of the library by those of Python. Quoted parts, such as names
    of elements, stay as they are."""
    parts = re.split(r'("[^"]*")', text)
    for pattern, instead in _RULES:
        parts[::2] = [pattern.sub(instead, part) for part in parts[::2]]
    return "".join(parts)
