"""Cases that are listed: what a scene writes of them, and the column that each parameter has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from pydantic import BeforeValidator

from ..base.arrays import Floats
from .element import Table, Text
from .readers import read_named


class Cases(Table):
    """Cases that are listed: the rows of a file, or of columns that are written here."""

    file: Text | None = None
    columns: Annotated[tuple[str, ...], BeforeValidator(read_named)] | None = None


@dataclass(frozen=True, eq=False)
class Listed:
    """A column: its `unit`, None where that of the parameter is meant; numbers in it that a file holds, and
    the file with the line of its header."""

    unit: str | None = None
    numbers: Floats | None = None
    file: str | None = None
    line: int | None = None
