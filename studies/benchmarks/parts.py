"""What is measured beside the scenes: each part gives tables, from the rows so far where it needs them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from . import agreement, executors, growth, memory, motion_forces, named_studies, stock, summary
from .rows import Row
from .tables import Table

Part = Callable[[Sequence[Row], bool, Path], list[Table]]

PARTS: dict[str, Part] = {
    "named_studies": named_studies.tables,
    "agreement": agreement.tables,
    "ida_stock": stock.tables,
    "growth": growth.tables,
    "memory": memory.tables,
    "motion_forces": motion_forces.tables,
    "summary": summary.tables,
}
# By name only: they take long.
LONG_PARTS: dict[str, Part] = {"memory_long": memory.long_tables, "executors_long": executors.tables}
