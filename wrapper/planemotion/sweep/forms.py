"""The forms that a sweep leaves: its result as HDF5 or Zarr, a table as CSV or Parquet; how they are made."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from ..base.errors import StudyError
from ..base.words import counted
from .cases import Study
from .netcdf import write_result
from .parquet import is_parquet_of, write_parquet
from .shard import Shard
from .size import Size, readable
from .store import SweepStore
from .table import is_table_of, write_csv
from .zarr_file import SUFFIX
from .zarr_store import ZarrStore, chunk_of

RESULTS = ("hdf5", "zarr")
TABLES = ("csv", "parquet", "none")
FileStore: TypeAlias = SweepStore | ZarrStore


@dataclass(frozen=True)
class Form:
    """What a sweep into files leaves: its `result` as one of RESULTS, its `table` as one of TABLES.

    `chunk`: cases of a chunk of Zarr; None: as many as suit the number of all.
    """

    result: str = "hdf5"
    table: str = "csv"
    chunk: int | None = None

    def __post_init__(self) -> None:
        for name, value, known in (("format", self.result, RESULTS), ("table", self.table, TABLES)):
            if value not in known:
                raise StudyError(f'{name} = "{value}": one of {", ".join(known)} is wanted')
        if self.chunk is not None and self.chunk < 1:
            raise StudyError(f"chunk = {self.chunk}: at least 1 case is wanted")

    def told(self, size: Size) -> str:
        """How much it will be, for people; what Zarr and Parquet hold is packed, and so may be less."""
        if self == Form(chunk=self.chunk):
            return size.text
        result = "HDF5" if self.result == "hdf5" else "Zarr"
        table = "" if self.table == "none" else f", and its table as {self.table}"
        return f"{counted(size.cases, 'case')}, at most about {readable(size.result)} of {result}{table}"

    @classmethod
    def in_folder(cls, folder: Path, name: str, table: str) -> Form:
        """That of what shards have left in a folder."""
        result = folder / f"{name}{SUFFIX}"
        return cls("zarr", table, chunk_of(result)) if result.exists() else cls("hdf5", table)

    def store(self, folder: Path, study: Study, *, resume: bool, shard: Shard | None = None) -> FileStore:
        """Where the sweep is stored."""
        name, manifest = file_name(study.data.id), study.manifest()
        if self.result == "hdf5":
            return SweepStore(folder, name, study.plan.cases, manifest, resume=resume, shard=shard)
        attributes = study.attributes()
        return ZarrStore(
            folder, name, study.layout, manifest, attributes, resume=resume, shard=shard, chunk=self.chunk
        )

    def table_of(self, result: Path) -> Path:
        """Where the table of a result is, or would be."""
        return result.with_suffix(".csv" if self.table == "none" else f".{self.table}")


def file_name(identity: str) -> str:
    """A scene's id as the name of a file."""
    return re.sub(r"[^\w.+-]", "_", identity).lstrip(".") or "sweep"


def finish(store: FileStore, study: Study, form: Form, missing: int, tell: Callable[[str], None]) -> Path:
    """Makes the result and its table; `missing`: the cases that were not there before.

    Gives where the table is, or would be.
    """
    if isinstance(store, ZarrStore):
        store.complete()
    elif not store.finished:
        with store.finish() as path:
            attributes = {**study.attributes(), "manifest": json.dumps(store.manifest)}
            write_result(path, study.layout, store.blocks(), attributes)
    table = form.table_of(store.result)
    if form.table != "none" and (missing or not _is_whole(store.result, table, tell)):
        (write_csv if form.table == "csv" else write_parquet)(store.result, table)
    store.remove_parts()
    return table


def _is_whole(result: Path, table: Path, tell: Callable[[str], None]) -> bool:
    """Whether the table of a result that was there before is whole."""
    if not table.exists():
        return False
    if (is_parquet_of if table.suffix == ".parquet" else is_table_of)(result, table):
        return True
    tell(f"{table}: was damaged, or changed; it is written anew from {result.name}")
    return False
