"""The files of a sweep whose result is a Zarr store: every block goes to its place in it at once.

    OUT/
      ID.zarr/              the result, complete when no block of it is missing
      ID.csv, ID.parquet    its table
      sweep.lock            as with HDF5: whole sweeps do not meet, and a shard is computed once

Blocks are whole chunks (zarr_file.py), so processes that compute different shards write beside each other.
What a killed process has not finished is computed again.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import tempfile
import time
import warnings
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from ..base.errors import StudyError
from ..base.files import disk_errors
from .block import Block
from .chunking import Chunking
from .layout import MESSAGE, ROUTE_WORDS, Layout
from .locks import LOOK_EVERY, OutputFolder
from .manifest import check_same
from .shard import Shard
from .zarr_file import SECONDS, SUFFIX, declare, write_block, zarr

# Cases of a chunk: a part of all, within these bounds.  To write one takes some ms for each variable.
_PARTS = 32
_LEAST, _MOST = 64, 16384


def usual_chunk(cases: int) -> int:
    """Cases of a chunk where nothing else is asked for."""
    return max(_LEAST, min(_MOST, cases // _PARTS))


def chunk_of(result: Path) -> int:
    """Cases of a chunk of a result that is there."""
    return math.prod(zarr().open_group(result, mode="r")["status"].chunks)


class ZarrStore:
    """As SweepStore.  `attributes`: of the result, known before it is computed; `chunk`: cases of a chunk."""

    def __init__(
        self,
        folder: Path,
        name: str,
        layout: Layout,
        manifest: Mapping[str, Any],
        attributes: Mapping[str, Any],
        *,
        resume: bool,
        shard: Shard | None = None,
        chunk: int | None = None,
    ) -> None:
        self.folder = folder
        self.result = folder / f"{name}{SUFFIX}"
        self.name = name
        self.cases = layout.cases
        self.manifest = json.loads(json.dumps(manifest))
        self._layout = layout
        self._chunking = Chunking.of(layout.shape, chunk or usual_chunk(layout.cases))
        self._attributes = attributes
        self._resume = resume
        self._shard = shard
        self._place = OutputFolder(folder, shard)
        self._group: Any = None
        self._seconds: npt.NDArray[np.float64] = np.empty(0)
        self._looked = 0.0
        blocks = self._chunking.count
        self._sizes = np.diff([self._chunking.start(chunk) for chunk in range(blocks + 1)])
        first, end = shard.range(blocks) if shard else (0, blocks)
        self._first, self._end = self._chunking.start(first), self._chunking.start(end)

    def __enter__(self) -> Self:
        """As SweepStore.  Raises StudyError likewise."""
        try:
            self._place.enter()
            with disk_errors(self.folder):
                self._open()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *exception: object) -> None:
        self._place.leave()

    def _open(self) -> None:
        if self.result.exists() and not (self._resume or self._shard):
            raise StudyError(
                f"{self.result}: the result of a sweep is there already and is never overwritten; "
                "go on with --resume, give another --out, or remove it"
            )
        if not self.result.exists():
            self._make()
        self._group = zarr().open_group(self.result, mode="r+", use_consolidated=False)
        self._check_chunks()
        stored = self._group.attrs.get("manifest")
        check_same(json.loads(stored) if stored else None, self.manifest, self.result)
        self._look()

    def _make(self) -> None:
        """An empty result; of several shards that make one the first counts."""
        temporary = Path(tempfile.mkdtemp(prefix=f".{self.name}", dir=self.folder))
        try:
            attributes = {**self._attributes, "manifest": json.dumps(self.manifest)}
            declare(temporary / "new", self._layout, self._chunking, attributes)
            with suppress(OSError):
                os.rename(temporary / "new", self.result)
        finally:
            shutil.rmtree(temporary, ignore_errors=True)

    def _check_chunks(self) -> None:
        """Raises StudyError where the result was begun with other chunks: no block would be whole."""
        there = self._group["status"].chunks
        if there != self._chunking.box:
            raise StudyError(
                f"{self.result}: was begun with chunks of {math.prod(there)} cases, not of "
                f"{math.prod(self._chunking.box)}; give the same, or another --out"
            )

    def _look(self) -> None:
        self._seconds = np.asarray(self._group[SECONDS][...])
        self._looked = time.monotonic()

    @property
    def finished(self) -> bool:
        """Whether no block is missing."""
        return not np.isnan(self._seconds).any()

    @property
    def done(self) -> int:
        """Cases stored; beside other shards those of all, as of some seconds ago."""
        if self._shard and time.monotonic() - self._looked > LOOK_EVERY:
            self._look()
        return int(self._sizes[~np.isnan(self._seconds)].sum())

    def count(self) -> int:
        """Cases stored now, by whatever process."""
        self._look()
        return self.done

    @property
    def wanted(self) -> int:
        """Cases that are to be stored, with those that are."""
        return self._end - self._first

    @property
    def missing(self) -> int:
        """Cases that are to be stored and are not."""
        return sum(count for _, count in self.gaps())

    def gaps(self) -> list[tuple[int, int]]:
        """First case and number of cases of each range that is not stored yet, in order; whole chunks."""
        gaps: list[tuple[int, int]] = []
        start = self._chunking.start
        low, high = self._chunking.at(self._first), self._chunking.at(max(self._end - 1, 0)) + 1
        for chunk in range(low, high if self._end > self._first else low):
            if not np.isnan(self._seconds[chunk]):
                continue
            first, count = start(chunk), start(chunk + 1) - start(chunk)
            if gaps and sum(gaps[-1]) == first:
                gaps[-1] = gaps[-1][0], gaps[-1][1] + count
            else:
                gaps.append((first, count))
        return gaps

    def fit(self, first: int, count: int, end: int) -> int:
        """How many cases from `first` on, about `count` and at most up to `end`, are one block."""
        return self._chunking.end_near(first, count, end) - first

    def add(self, first: int, block: Block) -> None:
        """Stores the results of cases first .. first+len(block)-1, which are whole chunks."""
        with disk_errors(self.result):
            write_block(self._group, self._layout, self._chunking, first, block)
        for chunk, count, _ in self._chunking.boxes(first, first + len(block)):
            self._seconds[chunk] = block.seconds * count / len(block)

    def complete(self) -> None:
        """Writes the attributes that follow from all cases."""
        status, routes, mended = self._group["status"], set(), 0
        failed = 0
        for _, _, box in self._chunking.boxes(0, self.cases):
            codes = status[box]
            routes.update(np.unique(self._group["route"][box]).tolist())
            failed += int(np.count_nonzero(codes))
            if (codes == 0).any():
                mended += int(np.count_nonzero((codes == 0) & (np.asarray(self._group[MESSAGE][box]) != "")))
        self._group.attrs.update(
            {
                "cases": self.cases,
                "cases_not_ok": failed,
                "cases_mended": mended,
                "routes": " ".join(ROUTE_WORDS[route] for route in sorted(routes)),
                "elapsed_seconds": float(np.sum(self._seconds)),
                "parameters": " ".join(one.name for one in self._layout.coordinates),
            }
        )
        with warnings.catch_warnings():  # that other programs need not know of it
            warnings.simplefilter("ignore")
            zarr().consolidate_metadata(self.result)

    def remove_parts(self) -> None:
        """What only an unfinished sweep needs."""
        self._place.remove_shard_locks()
