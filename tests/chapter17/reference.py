"""Writes reference.toml: python -m tests.chapter17.reference CATALOGUE.toml

Copies the parameter sets and the reference figures of the entries with a scene in
studies/chapter17 from the chapter's catalogue, which is not part of the project.
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests import CHAPTER

STORED = Path(__file__).with_name("reference.toml")


def parameter(name: str, value: float, units: dict[str, str]) -> str:
    """One parameter with its unit; without one it is in the unit that the scene declares."""
    unit = units.get(name, "1")
    return f"{name} = " + (str(value) if unit == "1" else f'"{value} {unit}"')


def lines(entry: dict[str, Any]) -> Iterator[str]:
    yield f'["{entry["id"]}"]'
    instances = entry.get("instances", [])
    units = entry.get("instance_units", {})
    if instances:
        yield "instances = ["
        for values in instances:
            written = [parameter(name, value, units) for name, value in values.items()]
            yield f"    {{ {', '.join(written)} }},"
        yield "]"
    for ask in entry["ask"]:
        value = ask.get("value")
        if instances and value is not None:
            (value,) = value  # of the first set
        figure = "" if value is None else f"value = {value}, "
        yield f'{ask["key"]} = {{ {figure}unit = "{ask["unit"]}" }}'
    yield ""


def main() -> None:
    catalogue = tomllib.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    there = {tomllib.loads(path.read_text(encoding="utf-8"))["id"] for path in CHAPTER.glob("*.toml")}
    written = [
        "# Reference figures of the chapter's entries; of several parameter sets they are of the first.",
        "",
    ]
    for entry in catalogue["problem"]:
        if entry["id"] in there:
            written += lines(entry)
    STORED.write_text("\n".join(written), encoding="utf-8")


if __name__ == "__main__":
    main()
