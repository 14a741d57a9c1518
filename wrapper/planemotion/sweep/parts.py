"""Part files of an unfinished sweep: consecutive cases, with their checksum in the name."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ..base.bounded import require_file
from ..base.errors import StudyError
from ..base.files import appearing
from .block import Block

# Hexadecimal digits of the SHA-256 of a part in its name: 64 bits against accidental damage.
_CHECKSUM_DIGITS = 16
_PART = re.compile(rf"part-(\d+)-(\d+)-([0-9a-f]{{{_CHECKSUM_DIGITS}}})\.npy")


@dataclass(frozen=True, order=True)
class Part:
    first: int
    count: int
    checksum: str
    path: Path

    @property
    def end(self) -> int:
        return self.first + self.count

    def meets(self, first: int, end: int) -> bool:
        """Whether some of its cases are among first .. end-1."""
        return self.first < end and first < self.end


def part_at(folder: Path, first: int, block: Block) -> tuple[Part, bytes]:
    """Where a block that begins with case `first` is stored, and its bytes."""
    data = block.to_bytes()
    checksum = _checksum(first, len(block), data)
    path = folder / f"part-{first:012d}-{len(block):08d}-{checksum}.npy"
    return Part(first, len(block), checksum, path), data


def write_part(part: Part, data: bytes) -> None:
    """When this returns the part is on the disk.  Raises StudyError if it cannot be written."""
    with appearing(part.path) as temporary:
        temporary.write_bytes(data)


def _checksum(first: int, count: int, data: bytes) -> str:
    """Of a part: its cases and its bytes, so that it cannot pass for another one."""
    return hashlib.sha256(b"%d %d\n" % (first, count) + data).hexdigest()[:_CHECKSUM_DIGITS]


def part_faults(folder: Path) -> Iterator[str]:
    """What is wrong with the parts of an unfinished sweep, one sentence each."""
    for part in sorted(parts_in(folder)):
        try:
            read_part(part)
        except StudyError as error:
            yield str(error)


def parts_in(folder: Path) -> Iterator[Part]:
    for path in folder.glob("part-*.npy"):
        match = _PART.fullmatch(path.name)
        if match:
            yield Part(int(match[1]), int(match[2]), match[3], path)


def read_part(part: Part) -> Block:
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
