"""How much a sweep leaves is known before: beside what it does leave."""

from __future__ import annotations

from pathlib import Path

import pytest

from planemotion import load_text
from planemotion.sweep.run import sweep_files
from planemotion.sweep.size import readable
from tests.scenes.pendulum import RELEASED, THROWN


@pytest.mark.parametrize("text", [RELEASED, THROWN])
def test_what_is_told_is_about_what_comes(text: str, tmp_path: Path) -> None:
    """Within a factor of 1.5 where the grid is large enough for the frame of the file not to count."""
    grid = 'sweep.L = { from = "0.5 m", to = "1 m", num = 3000 }'
    kept = "\n".join(line for line in text.splitlines() if not line.startswith("sweep"))
    said: list[str] = []
    files = sweep_files(load_text(f"{kept}\n".replace("[ask]", f"{grid}\n[ask]")), tmp_path, tell=said.append)
    (line,) = said
    assert line.startswith("3000 cases, about ")
    told = [float(size) * {"kB": 1e3, "MB": 1e6}[unit] for size, unit in _sizes(line)]
    for size, path in zip(told, (files.result, files.table), strict=True):
        assert 0.5 < path.stat().st_size / size < 1.5


def _sizes(line: str) -> list[tuple[str, str]]:
    words = line.split()
    return [(words[words.index("about") + 1], words[words.index("about") + 2]), (words[-4], words[-3])]


def test_sizes_are_readable() -> None:
    assert [readable(size) for size in (0, 999, 1000, 3.21e9, 1e21)] == [
        *("0 bytes", "999 bytes", "1 kB", "3.21 GB", "1e+03 EB")
    ]
