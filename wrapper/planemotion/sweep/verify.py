"""Whether results on a disk are still what was written: files of sweeps and of recorded runs, and parts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..base.bounded import require_file
from ..base.checksums import faults_of
from ..base.errors import StudyError
from ..engine.history import is_history
from .parts import part_faults
from .table import is_table_of
from .zarr_file import SUFFIX, zarr_faults

# What every HDF5 file begins with.
_SIGNATURE = b"\x89HDF\r\n\x1a\n"


@dataclass(frozen=True)
class Verified:
    """A file, or a folder of parts, and what is wrong with it, one sentence each."""

    path: Path
    faults: tuple[str, ...]


def is_result(path: Path) -> bool:
    """Whether the path leads to a folder or to an HDF5 file, and so to no scene."""
    if path.is_dir() or path.suffix in (".h5", SUFFIX):
        return True
    try:
        require_file(path)
        with open(path, "rb") as file:
            return file.read(len(_SIGNATURE)) == _SIGNATURE
    except OSError:
        return False


def verify(path: Path) -> list[Verified]:
    """Every result in a folder, or that of one file with its table.  Raises StudyError if there is none."""
    if path.suffix == SUFFIX:
        return [Verified(path, tuple(zarr_faults(path)))]
    results = sorted(path.glob("*.h5")) if path.is_dir() else [path]
    found = [one for result in results for one in _verify_file(result)]
    if path.is_dir():
        found += [Verified(parts, tuple(part_faults(parts))) for parts in sorted(path.glob("*.parts"))]
        found += [Verified(store, tuple(zarr_faults(store))) for store in sorted(path.glob(f"*{SUFFIX}"))]
    if not found:
        raise StudyError(f"{path}: there is no result (*.h5, *.zarr) in this folder")
    return found


def _verify_file(result: Path) -> list[Verified]:
    verified = [Verified(result, tuple(faults_of(result)))]
    table = result.with_suffix(".csv")
    if table.exists() and not verified[0].faults and not is_history(result):
        right = is_table_of(result, table)
        verified.append(Verified(table, () if right else (f"it is not the table of {result.name}",)))
    return verified
