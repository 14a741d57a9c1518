"""A table as Markdown, as CSV and in a terminal."""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import rich.box
import rich.table
from rich.console import Console

Cell = str | int | float | None
PAGE_WIDTH = 160  # characters of a line where nobody looks on: in a file or a pipe


@dataclass
class Table:
    """`name`: of its CSV file; `header` and `rows` of the same width; `text`: what stands above it."""

    name: str
    title: str
    header: Sequence[str]
    rows: list[Sequence[Cell]] = field(default_factory=list)
    text: str = ""

    def markdown(self) -> str:
        lines = [f"## {self.title}", ""]
        if self.text:
            lines += [self.text, ""]
        lines += [_line(self.header), _line(["---"] * len(self.header))]
        lines += [_line([shown(cell) for cell in row]) for row in self.rows]
        return "\n".join([*lines, ""])

    def show(self) -> None:
        """Prints it in full width, numbers to the right."""
        width = None if sys.stdout.isatty() else PAGE_WIDTH
        table = rich.table.Table(title=self.title, box=rich.box.SIMPLE, title_justify="left")
        for i, word in enumerate(self.header):
            is_text = all(isinstance(row[i], str) for row in self.rows)
            table.add_column(word, justify="left" if is_text else "right", overflow="fold")
        for row in self.rows:
            table.add_row(*(shown(cell) for cell in row))
        Console(width=width, markup=False, highlight=False).print(table)

    def write_csv(self, folder: Path) -> None:
        with (folder / f"{self.name}.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.header)
            writer.writerows(["" if _nothing(cell) else cell for cell in row] for row in self.rows)


def shown(cell: Cell) -> str:
    """Three digits of a number, a bar for none."""
    if _nothing(cell):
        return "-"
    if isinstance(cell, float):
        if cell and not 1e-3 <= abs(cell) < 1e6:
            return f"{cell:.1e}"
        return f"{cell:.0f}" if abs(cell) >= 1000 else f"{cell:.3g}"
    return str(cell).replace("|", "\\|")


def _nothing(cell: Cell) -> bool:
    return cell is None or cell == "" or (isinstance(cell, float) and math.isnan(cell))


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
