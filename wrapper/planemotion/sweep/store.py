"""Where the results of a sweep live while it runs: part files, their manifest, and the lock on the folder.

    OUT/                                the folder that the user names; it may hold results of several studies
      ID.h5, ID.csv                     the result; each appears whole, by a rename
      ID.parts/                         only while the sweep is unfinished
        manifest.json                   what is being computed; a resumed sweep must be the same
        part-FIRST-COUNT-CHECKSUM.npy   cases FIRST .. FIRST+COUNT-1
      sweep.lock                        held by the sweep that runs, or by its shards together
      shard-I-of-N.lock                 held by the shard that runs

A part is written under a temporary name, flushed to the disk and renamed, so a killed sweep leaves whole
parts only.  Its name carries the checksum of its bytes: damage is found before anything is read from it.
A part is arrays of numpy one after the other: as HDF5 it would take ten times as long to write and to read.
Cases are numbered in C order over the dimensions of the sweep, in 64 bits.
"""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Self

from ..base.bounded import read_bytes
from ..base.checksums import require_sound
from ..base.errors import StudyError
from ..base.files import appearing, disk_errors, sync_folder
from ..base.words import counted
from .block import Block
from .locks import LOOK_EVERY, OutputFolder, wait_until_free
from .manifest import check_same, manifest_of_result
from .parts import Part, part_at, parts_in, read_part, write_part
from .shard import Shard

# Cases, and bytes of their answers, that are read at once for the final file: few large writes.
_SLAB_CASES = 65536
_MOST_MANIFEST = 100_000_000  # bytes
_SLAB_BYTES = 1 << 25


class SweepStore:
    """The files of one sweep, locked between entering and leaving it as a context.

    `result`, `table`: paths of the HDF5 and of the CSV file; `finished`: the result is there already;
    `done`: cases stored.  `shard`: only these cases are to be stored, and other processes may store other
    shards meanwhile; to go on where one was ended is then always right.
    """

    def __init__(
        self,
        folder: Path,
        name: str,
        cases: int,
        manifest: Mapping[str, Any],
        *,
        resume: bool,
        shard: Shard | None = None,
    ) -> None:
        self.folder = folder
        self.result = folder / f"{name}.h5"
        self.table = folder / f"{name}.csv"
        self.parts_folder = folder / f"{name}.parts"
        self.cases = cases
        self.manifest = json.loads(json.dumps(manifest))  # as it is when read back
        self.resume = resume
        self.shard = shard
        self.finished = False
        self._range = shard.range(cases) if shard else (0, cases)
        self._parts: list[Part] = []
        self._place = OutputFolder(folder, shard)
        self._began = False
        self._others = (0.0, 0)  # when they were looked at, and the cases that other shards had stored

    def __enter__(self) -> Self:
        """Takes the lock, looks at what is there and begins or goes on.

        Raises StudyError if the folder cannot be written, another sweep runs there, results are there
        already and may not be touched, they belong to something else, or a part is damaged; then nothing
        has been changed.
        """
        try:
            self._place.enter()
            self._open()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *exception: object) -> None:
        if self._began and not any(self.parts_folder.glob("part-*")):  # nothing worth keeping
            shutil.rmtree(self.parts_folder, ignore_errors=True)
        self._place.leave()

    def _open(self) -> None:
        if not self.resume and not self.shard:
            self._refuse_old_results()
        if self.result.exists():
            check_same(manifest_of_result(self.result), self.manifest, self.result)
            if not self.shard:
                require_sound(self.result)
            self.finished = True
        elif self.shard:
            self._join(self.shard)
        elif self.parts_folder.exists():
            self._open_parts()
        else:
            self._begin()

    def _refuse_old_results(self) -> None:
        if self.result.exists():
            raise StudyError(
                f"{self.result}: the result of a sweep is there already and is never overwritten; "
                "give another --out, or remove it"
            )
        found = list(parts_in(self.parts_folder))
        if found:
            stored = counted(sum(part.count for part in found), "case")
            raise StudyError(
                f"{self.parts_folder}: an unfinished sweep is there ({stored} stored); go on with "
                "--resume, give another --out, or remove that folder"
            )
        if self.table.exists():
            raise StudyError(f"{self.table}: is there already; give another --out, or remove it")

    def _begin(self) -> None:
        self._began = True
        with disk_errors(self.parts_folder):
            self.parts_folder.mkdir(exist_ok=True)
            sync_folder(self.folder)
        self._write_manifest()

    def _write_manifest(self, mark: str = "") -> None:
        with appearing(self._manifest_path, mark) as temporary:
            temporary.write_text(json.dumps(self.manifest, indent=1), encoding="utf-8")

    def _join(self, shard: Shard) -> None:
        """Begins the sweep, or goes on beside other shards of it."""
        with disk_errors(self.parts_folder):
            self.parts_folder.mkdir(exist_ok=True)
        if self._manifest_path.exists():
            self._check_manifest()
        else:  # all shards write the same
            self._write_manifest(f".{shard.mark}")
        self._take(part for part in parts_in(self.parts_folder) if part.meets(*self._range))

    def _open_parts(self) -> None:
        found = list(parts_in(self.parts_folder))
        if not self._manifest_path.exists() and not found:  # killed before the first part
            return self._begin()
        self._check_manifest()
        self._take(found)
        for leftover in self.parts_folder.glob(".*.tmp"):
            leftover.unlink(missing_ok=True)

    def _check_manifest(self) -> None:
        try:
            stored = json.loads(read_bytes(self._manifest_path, _MOST_MANIFEST))
        except (OSError, ValueError) as error:
            raise StudyError(
                f"{self._manifest_path}: cannot be read ({error}), so it is not known what the parts beside "
                f"it belong to; remove {self.parts_folder} to start again"
            ) from None
        check_same(stored, self.manifest, self.parts_folder)

    def _take(self, parts: Iterable[Part]) -> None:
        """Parts that were stored before, each checked."""
        found = sorted(parts)
        for before, part in zip([None, *found], found, strict=False):
            if part.end > self.cases or (before and part.first < before.end):
                raise StudyError(f"{part.path}: its cases are not wanted or are there twice; remove it")
            read_part(part)
        self._parts = found

    @property
    def _manifest_path(self) -> Path:
        return self.parts_folder / "manifest.json"

    @property
    def done(self) -> int:
        """Cases stored; beside other shards those of all, as of some seconds ago."""
        if self.finished:
            return self.cases
        own = sum(part.count for part in self._parts)
        return own + self._stored_by_others() if self.shard else own

    def _stored_by_others(self) -> int:
        now = time.monotonic()
        if now - self._others[0] > LOOK_EVERY or not self._others[0]:
            others = (part for part in parts_in(self.parts_folder) if not part.meets(*self._range))
            self._others = now, sum(part.count for part in others)
        return self._others[1]

    def count(self) -> int:
        """Cases stored now, by whatever process."""
        return self.cases if self.finished else sum(part.count for part in parts_in(self.parts_folder))

    @property
    def wanted(self) -> int:
        """Cases that are to be stored, with those that are."""
        first, end = self._range
        return end - first

    @property
    def missing(self) -> int:
        """Cases that are to be stored and are not."""
        return sum(count for _, count in self.gaps())

    def gaps(self) -> list[tuple[int, int]]:
        """First case and number of cases of each range that is not stored yet, in order."""
        if self.finished:
            return []
        found, (place, end) = [], self._range
        for part in self._parts:
            if part.first > place:
                found.append((place, part.first - place))
            place = max(place, part.end)
        return [*found, (place, end - place)] if place < end else found

    def fit(self, first: int, count: int, end: int) -> int:
        """How many cases from `first` on, `count` and at most up to `end`, are one block."""
        return min(count, end - first)

    def add(self, first: int, block: Block) -> None:
        """Stores the results of cases first .. first+len(block)-1; when this returns they are on the disk.

        Raises StudyError if they cannot be written; the parts stored before stay.
        """
        part, data = part_at(self.parts_folder, first, block)
        try:
            write_part(part, data)
        finally:
            if part.path.exists():  # it counts even if Ctrl-C came just after the rename
                self._parts.append(part)
                self._parts.sort()

    def blocks(self) -> Iterator[Block]:
        """All stored cases in order, small parts joined to larger blocks."""
        waiting: list[Block] = []
        cases = size = 0
        for part in self._parts:
            block = read_part(part)
            waiting.append(block)
            cases += len(block)
            size += block.value.nbytes
            if cases >= _SLAB_CASES or size >= _SLAB_BYTES:
                yield Block.join(waiting)
                waiting, cases, size = [], 0, 0
        if waiting:
            yield Block.join(waiting)

    @contextmanager
    def finish(self) -> Iterator[Path]:
        """The path at which to write the merged result, which appears as `result` when the context ends.

        Raises StudyError if it cannot be written; then the parts are still there.
        """
        with appearing(self.result) as temporary:
            yield temporary
        self.finished = True

    def remove_parts(self) -> None:
        """To be called when nothing of the result is missing any more."""
        shutil.rmtree(self.parts_folder, ignore_errors=True)
        self._place.remove_shard_locks()
        self._parts = []


def wait_for_cases(folder: Path, name: str, cases: int, progress: Callable[[int, int], None]) -> None:
    """Waits until the shards of the sweep have stored all cases, and none of them is at work any more."""
    done = 0
    while done < cases and not (folder / f"{name}.h5").exists():
        if done:
            time.sleep(LOOK_EVERY)
        done = sum(part.count for part in parts_in(folder / f"{name}.parts"))
        progress(done, cases)
    wait_until_free(folder)
