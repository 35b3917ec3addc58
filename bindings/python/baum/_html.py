# SPDX-License-Identifier: BSD-3-Clause
"""Small tables for notebooks."""

from __future__ import annotations

import html
from typing import Any, Iterable, Sequence

MOST = 30  # largest number of rows


def table(caption: str, header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Make an HTML table of at most MOST rows. Texts are escaped, and numbers have four significant
    digits."""
    rows = list(rows)
    lines = [_row("th", header), *(_row("td", row) for row in rows[:MOST])]
    if len(rows) > MOST:
        lines.append(_row("td", [f"and {len(rows) - MOST} more", *[""] * (len(header) - 1)]))
    body = "\n".join(lines)
    return f"<table>\n<caption>{html.escape(caption)}</caption>\n{body}\n</table>"


def _row(tag: str, values: Iterable[Any]) -> str:
    texts = (f"{value:.4g}" if isinstance(value, float) else str(value) for value in values)
    return "<tr>" + "".join(f"<{tag}>{html.escape(text)}</{tag}>" for text in texts) + "</tr>"
