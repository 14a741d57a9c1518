"""The table of statuses: the kernel's list, its sentence for each, and what to do (docs/statuses.toml)."""

from __future__ import annotations

import tomllib
from pathlib import Path

from planemotion._layout import pm_status
from planemotion.engine.kernel import status_name, status_text

HEAD = "| status | meaning | what to do |\n|---|---|---|\n"
TITLES = {
    "ended": "The run has its answers, or those before the place where it ended:",
    "failed": "The run failed:",
}


def advice() -> dict[str, dict[str, str]]:
    """What to do, by group and word."""
    return tomllib.loads(Path(__file__).with_name("statuses.toml").read_text(encoding="utf-8"))


def status_table() -> str:
    """Two tables in Markdown.  Raises ValueError if a status has no line, or a line no status."""
    told, known = advice(), sorted(pm_status.values(), key=lambda number: (number < 0, abs(number)))
    groups = {
        "ended": [number for number in known if number >= 0],
        "failed": [number for number in known if number < 0],
    }
    texts = []
    for group, numbers in groups.items():
        words = {status_name(number) for number in numbers}
        if words != set(told[group]):
            raise ValueError(f"statuses.toml: [{group}]: missing or too many: {words ^ set(told[group])}")
        rows = (_row(number, told[group][status_name(number)]) for number in numbers)
        texts.append(f"{TITLES[group]}\n\n{HEAD}{''.join(rows)}")
    return "\n".join(texts)


def _row(number: int, what: str) -> str:
    return f"| `{status_name(number)}` ({number}) | {status_text(number)} | {' '.join(what.split())} |\n"
