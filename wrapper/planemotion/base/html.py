"""A table as a notebook shows it."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape


def html_table(title: str, rows: Sequence[Sequence[str]]) -> str:
    """HTML of a table under a title; the first row is its head."""
    lines = [
        "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row) + "</tr>"
        for tag, some in (("th", rows[:1]), ("td", rows[1:]))
        for row in some
    ]
    return f"<div><b>{escape(title)}</b><table>{''.join(lines)}</table></div>"
