# SPDX-License-Identifier: BSD-3-Clause
"""Makes reStructuredText of the docstrings of the Python package, which are plain text.

A docstring consists of paragraphs. A paragraph may be a list of entries such as `mass: [kg], positive.`, whose further
lines are indented. An indented paragraph is code."""

import inspect
import re
from itertools import groupby

ENTRY = re.compile(r"([A-Za-z_*][\w*]*(?:\([^)]*\))?(?:, [A-Za-z_*][\w*]*(?:\([^)]*\))?)*): (.*)")


def escaped(text):
    """Return the text with all marks of reStructuredText escaped, except ``code`` in backquotes."""
    parts = re.split(r"`([^`]+)`", text)
    plain = [re.sub(r"([\\*`|_])", r"\\\1", part) for part in parts[::2]]
    code = [f"``{part}``" for part in parts[1::2]]
    return "".join(x for pair in zip(plain, [*code, ""]) for x in pair)


def split(paragraph):
    """Return the lines of a paragraph before its first entry, and its entries (name, text)."""
    prose, found = [], []
    for line in paragraph:
        match = ENTRY.fullmatch(line)
        if match:
            found.append([match[1], match[2]])
        elif found and line.startswith("    "):
            found[-1][1] += " " + line.strip()
        elif found:
            return paragraph, []
        else:
            prose.append(line)
    return prose, found


def restructured(lines):
    """Return the lines of a docstring as lines of reStructuredText."""
    out = []
    for empty, group in groupby(lines, lambda line: not line.strip()):
        if empty:
            continue
        prose, listed = split(list(group))
        if prose and prose[0].startswith(">>> "):
            out += [*prose, ""]
        elif prose and all(line.startswith("    ") for line in prose):
            out += ["::", "", *prose, ""]
        elif prose:
            out += [*map(escaped, prose), ""]
        for name, text in listed:
            out += [f"* ``{name}``: {escaped(text)}"]
        out.append("")
    return out


def convert(app, what, name, obj, options, lines):
    lines[:] = restructured(lines)


def skip(app, what, name, obj, skipped, options):
    """Omit the fields of named tuples, which the docstring of their class describes."""
    return True if (inspect.getdoc(obj) or "").startswith("Alias for field") else None


def setup(app):
    app.connect("autodoc-process-docstring", convert)
    app.connect("autodoc-skip-member", skip)
    return {"version": "1", "parallel_read_safe": True}
