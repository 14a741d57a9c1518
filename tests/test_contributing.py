"""CONTRIBUTING.md is true: its map has the rooms in their order, one case walks through what it names."""

from __future__ import annotations

import re
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

import planemotion
from planemotion import _layout as layout
from tests import ROOT
from tests.test_kernel_rooms import KERNEL, definers
from tests.test_kernel_rooms import house as kernel_house
from tests.test_rooms import PACKAGE, WRAPPER
from tests.test_rooms import house as wrapper_house

TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
MAP, WALK = re.findall(
    r"## The house on one page\n(.*?)### One case of the sphere over bars\n(.*?)\n## ", TEXT, re.DOTALL
)[0]
CODE = re.compile(r"`([^`\n]+)`")
FILE = re.compile(r"[\w./]*\w\.(?:py|c|h|toml|md|f2py|pyf)")


def files(text: str) -> list[str]:
    """The files that a text names in code type."""
    return [name for name in CODE.findall(text) if FILE.fullmatch(name)]


def found(name: str) -> Path | None:
    """A file by its path in the repository, in the kernel or in the package."""
    places = (ROOT / name, KERNEL / name, WRAPPER / PACKAGE / name)
    return next((path for path in places if path.is_file()), None)


@contextmanager
def modules_called() -> Iterator[list[str]]:
    """The files of the package of which functions are called, by the order of the first calls."""
    called: dict[str, None] = {}
    home = f"{Path(planemotion.__file__).parent}/"

    def note(frame: FrameType, event: str, _: Any) -> None:
        if event == "call" and frame.f_code.co_filename.startswith(home):
            called[frame.f_code.co_filename] = None

    files: list[str] = []
    _profile(note)
    try:
        yield files
    finally:
        _profile(None)
        files.extend(name.removeprefix(home) for name in called)


def _profile(function: Callable[[FrameType, str, Any], None] | None) -> None:
    sys.setprofile(function)
    threading.setprofile(function)


def test_every_file_that_it_names_is_there() -> None:
    named = [
        name for name in files(TEXT) if "/" in name and not re.search(r"\b(x|word|name)\.|_name\.", name)
    ]
    assert len(named) > 20
    assert [name for name in named if found(name) is None] == []


def test_every_target_that_it_names_is_in_the_makefile() -> None:
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    named = set(re.findall(r"`make ([\w-]+)`", TEXT))
    assert len(named) > 10
    assert named <= targets


def shown(part: str) -> list[str]:
    """The rooms of a part of the map, from the top; what they are stands beside them after three blanks."""
    cells = (re.split(r"\s{3,}", line[14:].strip())[0].split() for line in part.splitlines())
    return [word.removesuffix("/*") for cell in cells for word in cell if re.fullmatch(r"\w+(/\*)?", word)]


def test_the_map_shows_the_rooms_in_their_order() -> None:
    wrapper, kernel = (shown(part) for part in re.split(r"\n *─ ─ .*\n", MAP.split("```")[1]))
    folders = wrapper_house().folders
    assert [room for room in wrapper if room in folders] == folders[::-1]
    assert kernel == list(dict.fromkeys(room.partition("/")[0] for room in kernel_house().rooms[::-1]))
    for room in (name for name in kernel_house().rooms if "/" in name):
        assert room.partition("/")[2] in MAP


def test_the_functions_of_the_walk_are_there() -> None:
    named = set(re.findall(r"\bpm_\w+", WALK))
    assert {"pm_batch", "pm_run", "pm_start"} <= named
    assert named - set(definers(KERNEL)) == set()


def swept(out: Path) -> Any:
    return planemotion.load(ROOT / "studies/sphere_over_bars.toml").sweep(
        out=out, grids={"d": ["1 in", "2 in"]}
    )


def test_the_walk_goes_through_the_files_that_it_names(tmp_path: Path) -> None:
    parts = [
        [name for name in files(part) if name.endswith(".py")]
        for part in re.split(r"^\d\. ", WALK, flags=re.MULTILINE)
    ]
    named = [name for part in parts for name in part]
    swept(tmp_path / "once").close()  # all that is imported has been
    with modules_called() as called:
        swept(tmp_path / "again").close()
    assert [name for name in named if name not in called] == []
    order = [index for part in parts for index in sorted(called.index(name) for name in part)]
    assert order == sorted(order), called


def test_the_walk_tells_what_happens(tmp_path: Path) -> None:
    with swept(tmp_path / "out") as table:
        assert table["omega_B"].dims == ("d",)
        assert table["omega_B"].attrs["units"] == "rad/s"
        assert (table["route"] == layout.PM_ROUTE_PATH).all()
    result = planemotion.load(ROOT / "studies/sphere_over_bars.toml").run(d="2 in")
    computed = result.counts["jumps"] - result.counts["repeated_segments"]
    assert 0 < computed <= 3 < result.counts["repeated_segments"]
