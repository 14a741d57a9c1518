"""Where the results of a sweep live while it runs: part files, their manifest, and the lock on the folder.

    OUT/                                the folder that the user names; it may hold results of several studies
      ID.h5, ID.csv                     the result; each appears whole, by a rename
      ID.parts/                         only while the sweep is unfinished
        manifest.json                   what is being computed; a resumed sweep must be the same
        part-FIRST-COUNT-CHECKSUM.npy   cases FIRST .. FIRST+COUNT-1
      sweep.lock                        held by the sweep that runs

A part is written under a temporary name, flushed to the disk and renamed, so a killed sweep leaves whole
parts only.  Its name carries the checksum of its bytes: damage is found before anything is read from it.
A part is arrays of numpy one after the other: as HDF5 it would take ten times as long to write and to read.
Cases are numbered in C order over the dimensions of the sweep, in 64 bits.
"""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import re
import shutil
import socket
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import h5py

from ..base.bounded import read_bytes, require_file
from ..base.checksums import require_sound
from ..base.errors import StudyError
from ..base.files import appearing, disk_errors, sync_folder
from .block import Block

# Key of the manifest under which numbers stand that say only that something differs, not what.
CHECKSUMS = "checksums"
# Hexadecimal digits of the SHA-256 of a part in its name: 64 bits against accidental damage.
_CHECKSUM_DIGITS = 16
_PART = re.compile(rf"part-(\d+)-(\d+)-([0-9a-f]{{{_CHECKSUM_DIGITS}}})\.npy")
# Cases, and bytes of their answers, that are read at once for the final file: few large writes.
_SLAB_CASES = 65536
_MOST_MANIFEST = 100_000_000  # bytes
_SLAB_BYTES = 1 << 25


class OutputLock:
    """Keeps a second sweep out of a folder.

    The lock itself is the system's (flock), so it ends with the process however that ends; the text in the
    file only tells a second sweep whom it meets.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / "sweep.lock"
        self._descriptor: int | None = None

    def acquire(self) -> None:
        """Raises StudyError if another sweep holds the lock."""
        while self._descriptor is None:
            descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                owner = os.read(descriptor, 1000).decode(errors="replace").strip()
                os.close(descriptor)
                raise StudyError(
                    f"{self.path.parent}: another sweep writes into this folder ({owner or 'just started'}); "
                    "wait until it ends, or give another --out"
                ) from None
            except OSError:
                os.close(descriptor)
                raise
            if self._is_current(descriptor):
                self._descriptor = descriptor
            else:  # its owner removed the file between our open and our lock
                os.close(descriptor)
        os.ftruncate(self._descriptor, 0)
        os.write(self._descriptor, _owner().encode())

    def release(self) -> None:
        if self._descriptor is not None:
            self.path.unlink(missing_ok=True)
            os.close(self._descriptor)
            self._descriptor = None

    def _is_current(self, descriptor: int) -> bool:
        try:
            return os.path.samestat(os.fstat(descriptor), os.stat(self.path))
        except FileNotFoundError:
            return False


def _owner() -> str:
    return f"process {os.getpid()} on {socket.gethostname()}, since {time.strftime('%Y-%m-%d %H:%M:%S')}"


@dataclass(frozen=True, order=True)
class _Part:
    first: int
    count: int
    checksum: str
    path: Path

    @property
    def end(self) -> int:
        return self.first + self.count


class SweepStore:
    """The files of one sweep, locked between entering and leaving it as a context.

    `result`, `table`: paths of the HDF5 and of the CSV file; `finished`: the result is there already;
    `done`: cases stored.
    """

    def __init__(
        self, folder: Path, name: str, cases: int, manifest: Mapping[str, Any], *, resume: bool
    ) -> None:
        self.folder = folder
        self.result = folder / f"{name}.h5"
        self.table = folder / f"{name}.csv"
        self.parts_folder = folder / f"{name}.parts"
        self.cases = cases
        self.manifest = json.loads(json.dumps(manifest))  # as it is when read back
        self.resume = resume
        self.finished = False
        self._parts: list[_Part] = []
        self._lock = OutputLock(folder)
        self._made_folder = False
        self._began = False

    def __enter__(self) -> Self:
        """Takes the lock, looks at what is there and begins or goes on.

        Raises StudyError if the folder cannot be written, another sweep runs there, results are there
        already and may not be touched, they belong to something else, or a part is damaged; then nothing
        has been changed.
        """
        if self.folder.exists() and not self.folder.is_dir():
            raise StudyError(f"{self.folder}: is a file; --out wants a folder")
        try:
            with disk_errors(self.folder):
                self._made_folder = not self.folder.exists()
                self.folder.mkdir(parents=True, exist_ok=True)
                self._lock.acquire()
            self._open()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *exception: object) -> None:
        if self._began and not any(self.parts_folder.glob("part-*")):  # nothing worth keeping
            shutil.rmtree(self.parts_folder, ignore_errors=True)
        self._lock.release()
        if self._made_folder:
            with suppress(OSError):  # holds results
                self.folder.rmdir()

    def _open(self) -> None:
        if not self.resume:
            self._refuse_old_results()
        if self.result.exists():
            self._compare(_manifest_of_result(self.result), self.result)
            require_sound(self.result)
            self.finished = True
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
        found = list(_parts_in(self.parts_folder))
        if found:
            stored = sum(part.count for part in found)
            raise StudyError(
                f"{self.parts_folder}: an unfinished sweep is there ({stored} cases stored); go on with "
                "--resume, give another --out, or remove that folder"
            )
        if self.table.exists():
            raise StudyError(f"{self.table}: is there already; give another --out, or remove it")

    def _begin(self) -> None:
        self._began = True
        with disk_errors(self.parts_folder):
            self.parts_folder.mkdir(exist_ok=True)
            sync_folder(self.folder)
        with appearing(self._manifest_path) as temporary:
            temporary.write_text(json.dumps(self.manifest, indent=1), encoding="utf-8")

    def _open_parts(self) -> None:
        found = sorted(_parts_in(self.parts_folder))
        if not self._manifest_path.exists() and not found:  # killed before the first part
            return self._begin()
        try:
            stored = json.loads(read_bytes(self._manifest_path, _MOST_MANIFEST))
        except (OSError, ValueError) as error:
            raise StudyError(
                f"{self._manifest_path}: cannot be read ({error}), so it is not known what the parts beside "
                f"it belong to; remove {self.parts_folder} to start again"
            ) from None
        self._compare(stored, self.parts_folder)
        for before, part in zip([None, *found], found, strict=False):
            if part.end > self.cases or (before and part.first < before.end):
                raise StudyError(f"{part.path}: its cases are not wanted or are there twice; remove it")
            _read_part(part)
        for leftover in self.parts_folder.glob(".*.tmp"):
            leftover.unlink(missing_ok=True)
        self._parts = found

    def _compare(self, stored: Mapping[str, Any], place: Path) -> None:
        """Raises StudyError naming what differs between the stored manifest and this sweep's."""
        formats = [one.get("format") if isinstance(one, dict) else None for one in (stored, self.manifest)]
        if formats[0] != formats[1]:
            raise StudyError(
                f"{place}: was written by another version of planemotion, in another format "
                f"({_shown(formats[0])}, now {_shown(formats[1])}), so this one cannot go on there. "
                "Finish it with that version, or give another --out"
            )
        differences = list(_differences(stored, self.manifest))
        if differences:
            named = [text for text in differences if not text.startswith(f"{CHECKSUMS}.")]
            raise StudyError(
                f"{place}: belongs to another sweep, so this one cannot go on there. Different: "
                f"{'; '.join(named or differences)}. Give another --out, or undo the change"
            )

    @property
    def _manifest_path(self) -> Path:
        return self.parts_folder / "manifest.json"

    @property
    def done(self) -> int:
        return self.cases if self.finished else sum(part.count for part in self._parts)

    def gaps(self) -> list[tuple[int, int]]:
        """First case and number of cases of each range that is not stored yet, in order."""
        if self.finished:
            return []
        edges = [0, *(edge for part in self._parts for edge in (part.first, part.end)), self.cases]
        return [(a, b - a) for a, b in zip(edges[::2], edges[1::2], strict=True) if b > a]

    def add(self, first: int, block: Block) -> None:
        """Stores the results of cases first .. first+len(block)-1; when this returns they are on the disk.

        Raises StudyError if they cannot be written; the parts stored before stay.
        """
        data = block.to_bytes()
        checksum = _checksum(first, len(block), data)
        path = self.parts_folder / f"part-{first:012d}-{len(block):08d}-{checksum}.npy"
        try:
            with appearing(path) as temporary:
                temporary.write_bytes(data)
        finally:
            if path.exists():  # it counts even if Ctrl-C came just after the rename
                self._parts.append(_Part(first, len(block), checksum, path))
                self._parts.sort()

    def blocks(self) -> Iterator[Block]:
        """All stored cases in order, small parts joined to larger blocks."""
        waiting: list[Block] = []
        cases = size = 0
        for part in self._parts:
            block = _read_part(part)
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
        self._parts = []


def _checksum(first: int, count: int, data: bytes) -> str:
    """Of a part: its cases and its bytes, so that it cannot pass for another one."""
    return hashlib.sha256(b"%d %d\n" % (first, count) + data).hexdigest()[:_CHECKSUM_DIGITS]


def part_faults(folder: Path) -> Iterator[str]:
    """What is wrong with the parts of an unfinished sweep, one sentence each."""
    for part in sorted(_parts_in(folder)):
        try:
            _read_part(part)
        except StudyError as error:
            yield str(error)


def _parts_in(folder: Path) -> Iterator[_Part]:
    for path in folder.glob("part-*.npy"):
        match = _PART.fullmatch(path.name)
        if match:
            yield _Part(int(match[1]), int(match[2]), match[3], path)


def _read_part(part: _Part) -> Block:
    """Raises StudyError if the file is not what was written."""
    try:
        require_file(part.path)
        data = part.path.read_bytes()
    except OSError as error:
        raise StudyError(f"{part.path}: cannot be read: {error.strerror}") from error
    found = _checksum(part.first, part.count, data)
    if found != part.checksum:
        raise StudyError(
            f"{part.path}: this part file is damaged, or is one of other cases (checksum {found}, "
            f"{part.checksum} when it was written). Remove it and go on with --resume: its {part.count} "
            f"cases, {part.first} to {part.end - 1}, are then computed again"
        )
    return Block.from_bytes(data)


def _manifest_of_result(path: Path) -> dict[str, Any]:
    try:
        require_file(path)
        with h5py.File(path, "r") as file:
            manifest: dict[str, Any] = json.loads(file.attrs["manifest"])
            return manifest
    except Exception as error:  # there is nothing that HDF5 does not say of a damaged file
        raise StudyError(
            f"{path}: is not a whole result of a sweep ({error}); give another --out, or remove it"
        ) from None


def _differences(old: object, new: object, name: str = "") -> Iterator[str]:
    """What differs between two values made of dicts, lists, texts and numbers, as "name: old, now new"."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in [*old, *(key for key in new if key not in old)]:
            place = f"{name}.{key}" if name else str(key)
            yield from _differences(old.get(key), new.get(key), place)
    elif isinstance(old, str) and isinstance(new, str) and ("\n" in old or "\n" in new):
        yield from _different_lines(old.splitlines(), new.splitlines(), name)
    elif old != new:
        yield f"{name} ({_shown(old)}, now {_shown(new)})"


def _different_lines(old: Sequence[str], new: Sequence[str], name: str) -> Iterator[str]:
    for line in [*old, *new]:
        if line not in new:
            yield f"{name} without the line `{line}`"
        elif line not in old:
            yield f"{name} with the line `{line}`"
    if sorted(old) == sorted(new) and old != new:
        yield f"{name} in another order"


def _shown(value: object) -> str:
    return "missing" if value is None else json.dumps(value, ensure_ascii=False)
