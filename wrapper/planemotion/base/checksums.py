"""Checksums inside an HDF5 file: of each variable with its shape and attributes, and of what the file says.

They stand as JSON in the attribute `checksums` of the file: path of the variable ("": the file) -> SHA-256.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .bounded import require_file
from .errors import StudyError

CHECKSUMS = "checksums"
# Faults that a message names.
_SHOWN = 5
_WITHOUT = "it has no checksums: an earlier version wrote it, or it is no result"
# Numbers that are read at once.
_PIECE = 1 << 20
# How HDF5 files hold together, and not what was written into them.
_INTERNAL = {"CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates"}
_INTERNAL |= {"_NCProperties", "_nc3_strict", CHECKSUMS}


def seal(file: h5py.File) -> None:
    """Writes the checksums of all that stands in an open file."""
    file.attrs[CHECKSUMS] = json.dumps(dict(_checksums(file)))


def faults_of(path: Path) -> list[str]:
    """What is wrong with a file that `seal` has sealed, one sentence each; nothing if all is as written."""
    try:
        require_file(path)
        with h5py.File(path, "r") as file:
            if CHECKSUMS not in file.attrs:
                return [_WITHOUT]
            wanted = json.loads(file.attrs[CHECKSUMS])
            found = dict(_checksums(file))
    except Exception as error:  # there is nothing that HDF5 does not say of a damaged file
        return [f"it cannot be read: {error}"]
    if not isinstance(wanted, dict):
        return ["its checksums are damaged"]
    return [
        f"{name or 'its attributes'}: not what was written"
        for name in [*wanted, *(name for name in found if name not in wanted)]
        if wanted.get(name) != found.get(name)
    ]


def require_sound(path: Path) -> None:
    """Raises StudyError for an HDF5 file that is not what was written; one without checksums passes."""
    with suppress(OSError):  # whoever opens what is no such file says so
        require_file(path)
        if not h5py.is_hdf5(path):
            return
        faults = faults_of(path)
        if faults and faults != [_WITHOUT]:
            raise StudyError(
                f"{path}: this result is damaged: {in_short(faults)}. Remove it to compute it again"
            )


def in_short(faults: Sequence[str]) -> str:
    """The first faults of several, for a message."""
    more = [f"and {len(faults) - _SHOWN} more"] if len(faults) > _SHOWN else []
    return "; ".join([*faults[:_SHOWN], *more])


def _checksums(file: h5py.File) -> Iterator[tuple[str, str]]:
    things: list[tuple[str, Any]] = [("", file)]
    file.visititems(lambda name, thing: things.append((name, thing)))
    for name, thing in things:
        total = hashlib.sha256(
            json.dumps(_attributes(thing), sort_keys=True).encode("utf-8", "backslashreplace")
        )
        if isinstance(thing, h5py.Dataset):
            total.update(f"{thing.dtype.str}{thing.shape}".encode())
            for piece in _pieces(thing):
                total.update(piece)
        yield name, total.hexdigest()


def _attributes(thing: Any) -> dict[str, str]:
    return {name: repr(_plain(thing.attrs[name])) for name in thing.attrs if name not in _INTERNAL}


def _plain(value: Any) -> Any:
    """A value of an attribute, the same whether it has been written or read."""
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def _pieces(variable: h5py.Dataset) -> Iterator[bytes]:
    """The values of a variable in order, as bytes; texts with their lengths."""
    if variable.shape == ():
        yield _bytes(np.asarray(variable[()]))
        return
    rows = max(1, _PIECE // max(1, math.prod(variable.shape[1:])))
    for first in range(0, variable.shape[0], rows):
        yield _bytes(variable[first : first + rows])


def _bytes(values: Any) -> bytes:
    if values.dtype != object:
        return np.ascontiguousarray(values).tobytes()
    texts = [text if isinstance(text, bytes) else str(text).encode() for text in values.ravel().tolist()]
    return b"".join(b"%d:%b" % (len(text), text) for text in texts)
