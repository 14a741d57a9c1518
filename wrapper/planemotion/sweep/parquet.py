"""The result of a sweep as a Parquet table: the columns of the CSV table, numbers as numbers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..base.errors import StudyError
from ..base.files import appearing
from .netcdf import opened
from .table import Columns


def _pyarrow() -> Any:
    try:
        import pyarrow.parquet
    except ImportError:
        reason = 'Parquet needs pyarrow: pip install "planemotion[stores]"'
        raise StudyError(reason) from None
    return pyarrow


def write_parquet(result: Path, table: Path) -> None:
    """Writes the result of a sweep as a table, one row per case; it appears whole or not at all.

    Columns as those of `write_csv`: names with units, such as "d [in]"; words are texts, all else numbers.
    Memory does not grow with the cases.  Raises StudyError likewise.
    """
    arrow = _pyarrow()
    with opened(result) as file, appearing(table) as temporary:
        columns = Columns(file)
        writer = None
        for first, count in columns.slices():
            arrays = [arrow.array(list(values)) for values in columns.values(first, count)]
            piece = arrow.table(arrays, names=columns.header)
            if writer is None:
                writer = arrow.parquet.ParquetWriter(temporary, piece.schema)
            writer.write_table(piece)
        assert writer is not None
        writer.close()


def is_parquet_of(result: Path, table: Path) -> bool:
    """Whether a table is, row for row, what `write_parquet` makes of a result that is sound."""
    arrow = _pyarrow()
    try:
        with opened(result) as file, arrow.parquet.ParquetFile(table) as read:
            columns = Columns(file)
            if read.schema_arrow.names != columns.header or read.metadata.num_rows != columns.cases:
                return False
            for (first, count), group in zip(columns.slices(), range(read.num_row_groups), strict=True):
                there = read.read_row_group(group).columns
                for values, stored in zip(columns.values(first, count), there, strict=True):
                    if not stored.equals(arrow.chunked_array([arrow.array(list(values))])):
                        return False
    except (arrow.ArrowException, OSError, ValueError):
        return False
    return True
