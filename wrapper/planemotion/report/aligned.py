"""Tables of text, aligned by rich: as wide as they need to be, or fitted to a terminal."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

# Wider than any table of words: rich then breaks nothing.
_ENDLESS = 1_000_000
_SPACE = 2  # between columns


@dataclass(frozen=True)
class Column:
    """Cells below each other; `right`: numbers, never broken; `style`: as rich calls it; `least`: width."""

    right: bool = False
    style: str = ""
    least: int | None = None


def aligned(
    rows: Iterable[Sequence[str]],
    columns: Sequence[Column] | None = None,
    *,
    header: Sequence[Sequence[str]] = (),
    width: int | None = None,
) -> list[str]:
    """The rows as lines of aligned cells, with the rows of a bold `header` before them; a row may end early.

    `width`: of the terminal, in characters; longer words are broken to fit into it, numbers are not.  Without
    it the lines are as long as they have to be.
    """
    cells = [list(row) for row in rows]
    if not cells and not header:
        return []
    looks = columns or [Column()] * max(map(len, [*cells, *header]))
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, _SPACE, 0, 0))
    for look in looks:
        justify: Literal["left", "right"] = "right" if look.right else "left"
        table.add_column(justify=justify, no_wrap=look.right, min_width=look.least)
    for row in header:
        table.add_row(*(Text.assemble((cell, "bold")) for cell in row))
    for row in cells:
        table.add_row(*(Text.assemble((cell, look.style)) for cell, look in zip(row, looks, strict=False)))
    console = Console(file=io.StringIO(), width=_ENDLESS, color_system="standard", force_terminal=True)
    if width is not None:
        needed = Measurement.get(console, console.options, table).minimum + _SPACE * len(looks)
        console.width = max(needed, width)
    with console.capture() as lines:
        console.print(table)
    return [line.rstrip() for line in lines.get().splitlines()]
