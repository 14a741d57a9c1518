"""What a sweep computes, as it is stored beside its results, and how two of these differ."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py

from ..base.bounded import require_file
from ..base.errors import StudyError

# Key of the manifest under which numbers stand that say only that something differs, not what.
CHECKSUMS = "checksums"


def manifest_of_result(path: Path) -> dict[str, Any]:
    try:
        require_file(path)
        with h5py.File(path, "r") as file:
            manifest: dict[str, Any] = json.loads(file.attrs["manifest"])
            return manifest
    except Exception as error:  # there is nothing that HDF5 does not say of a damaged file
        raise StudyError(
            f"{path}: is not a whole result of a sweep ({error}); give another --out, or remove it"
        ) from None


def check_same(stored: Any, wanted: Mapping[str, Any], place: Path) -> None:
    """Raises StudyError naming what differs between the manifest stored at `place` and this sweep's."""
    formats = [one.get("format") if isinstance(one, dict) else None for one in (stored, wanted)]
    if formats[0] != formats[1]:
        raise StudyError(
            f"{place}: was written by another version of planemotion, in another format "
            f"({_shown(formats[0])}, now {_shown(formats[1])}), so this one cannot go on there. "
            "Finish it with that version, or give another --out"
        )
    differences = list(_differences(stored, wanted))
    if differences:
        named = [text for text in differences if not text.startswith(f"{CHECKSUMS}.")]
        raise StudyError(
            f"{place}: belongs to another sweep, so this one cannot go on there. Different: "
            f"{'; '.join(named or differences)}. Give another --out, or undo the change"
        )


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
