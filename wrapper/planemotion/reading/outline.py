"""What a scene is called and what stands in it, as the table says; one with a fault has an outline, too."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

_SHOWN = ("parameters", "bodies", "joints", "couplings", "contacts", "forces", "events", "runs", "ask")


def name_of(raw: Mapping[str, Any], file: str | None) -> str:
    """Its title or id, or the file, as it is written."""
    given = raw.get("title") or raw.get("id")
    return str(given or (Path(file).name if file else "without a title"))


def outline(raw: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Its tables with the names of what stands in them."""
    tables = ((name, raw.get(name)) for name in _SHOWN)
    return [(name, ", ".join(map(str, table))) for name, table in tables if isinstance(table, dict) and table]
