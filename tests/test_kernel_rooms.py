"""The rooms of the kernel: a file needs only its own room and those below, as kernel/rooms.toml orders them.

What a file includes counts, and what it names: a function or table of another file can be used through a
declaration written by hand, or through a header that stands lower than the code behind it.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from tests import ROOT
from tests.circles import circles as circles_of

KERNEL = ROOT / "kernel"

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
STRING = re.compile(r'"(?:\\.|[^"\\\n])*"')
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
NAME = re.compile(r"\bpm_\w+")
# What a source defines for others: a function or a table that begins a line and is not static.
FUNCTION = re.compile(
    r"^(?!static\b|typedef\b|extern\b|return\b|else\b|#)[A-Za-z_][\w \t*]*?\b(pm_\w+)\s*\([^;{}]*\)\s*\{",
    re.M,
)
TABLE = re.compile(r"^(?!static\b|typedef\b|extern\b)(?:const )?\w[\w ]*\b(pm_\w+)(?:\[[^\]]*\])*\s*=", re.M)
# A whole function, static or not; a struct and its members.
BODY = re.compile(r"^[A-Za-z_][^\n;#]*?\b(?P<name>\w+)\([^;{}]*\)\n\{\n.*?^\}\n", re.MULTILINE | re.DOTALL)
ONE_LINE = re.compile(r"^[A-Za-z_][^\n;#={}]*?\b(?P<name>\w+)\([^;{}]*\) ?\{[^\n]*\}$", re.MULTILINE)
STRUCT = re.compile(r"^(?:typedef )?struct (?P<name>\w+) \{(?P<members>.*?)^\}", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class Use:
    """`user` uses `used` in `line`; both are files without their endings below kernel/."""

    user: str
    used: str
    line: int
    what: str


@dataclass(frozen=True)
class House:
    rooms: tuple[str, ...]
    largest_circle: int
    longest_file: int
    half_of_functions: int
    most_functions: int
    longest_function: int
    largest_struct: int
    verbs: tuple[str, ...] = ()

    def floor(self, unit: str) -> int | None:
        """How high a file stands; None if it is in no room."""
        room = unit.rpartition("/")[0]
        return self.rooms.index(room) if room in self.rooms else None


def house() -> House:
    table = tomllib.loads((KERNEL / "rooms.toml").read_text(encoding="utf-8"))
    rooms = tuple(table.pop("rooms"))
    return House(rooms, verbs=tuple(table.pop("verbs")), **table)


@cache
def sources(kernel: Path) -> dict[Path, str]:
    """The sources and headers that stand in rooms, without comments; lines keep their numbers."""
    found = {}
    for path in sorted([*kernel.rglob("*.c"), *kernel.rglob("*.h")]):
        if path.parent != kernel:
            text = COMMENT.sub(lambda m: "\n" * m.group().count("\n"), path.read_text(encoding="utf-8"))
            found[path] = text
    return found


def unit(kernel: Path, path: Path) -> str:
    return path.relative_to(kernel).with_suffix("").as_posix()


def definers(kernel: Path) -> dict[str, set[str]]:
    """Name -> the files that define it for others."""
    found: dict[str, set[str]] = {}
    for path, text in sources(kernel).items():
        if path.suffix == ".c":
            for name in (*FUNCTION.findall(text), *TABLE.findall(text)):
                found.setdefault(name, set()).add(unit(kernel, path))
    return found


@cache
def uses(kernel: Path) -> list[Use]:
    """What uses what: by includes of sources and headers, by names in sources."""
    known = {unit(kernel, path) for path in sources(kernel)}
    defined = definers(kernel)
    found = []
    for path, text in sources(kernel).items():
        here = unit(kernel, path)
        for m in INCLUDE.finditer(text):
            there = m[1].removesuffix(".h")
            if there in known and there != here:
                found.append(Use(here, there, line_of(text, m), f'"{m[1]}"'))
        if path.suffix == ".c":
            plain = STRING.sub('""', text)
            for m in NAME.finditer(plain):
                for there in defined.get(m[0], ()):
                    if here not in defined[m[0]]:
                        found.append(Use(here, there, line_of(plain, m), m[0]))
    return found


def line_of(text: str, m: re.Match[str]) -> int:
    return text.count("\n", 0, m.start()) + 1


def homeless(kernel: Path, plan: House) -> list[str]:
    """Files that stand in no room; the public headers stand before all of them."""
    files = sorted([*kernel.rglob("*.c"), *kernel.rglob("*.h")])
    return [
        path.relative_to(kernel).as_posix()
        for path in files
        if plan.floor(unit(kernel, path)) is None and not path.name.startswith("planemotion")
    ]


def strange_names(kernel: Path, plan: House) -> list[str]:
    """Functions and tables for others that begin neither with the first word of their file nor with a struct.

    A reader does not find them.  What the public headers declare is called as users are to call it.
    """
    public = "".join(path.read_text("utf-8") for path in kernel.glob("*.h"))
    begins = tuple(f"{struct}_" for struct in structs(kernel)) + plan.verbs
    return sorted(
        f"{file}: {name}"
        for name, files in definers(kernel).items()
        for file in files
        if not name.startswith((f"pm_{file.rpartition('/')[2].partition('_')[0]}", *begins))
        and not re.search(rf"\b{name}\b", public)
    )


def upward(kernel: Path, plan: House) -> list[str]:
    """Uses of a later room by an earlier one, one for each pair of files and name."""
    found: dict[str, int] = {}
    for one in uses(kernel):
        here, there = plan.floor(one.user), plan.floor(one.used)
        if here is not None and there is not None and there > here:
            found.setdefault(f"{one.user} -> {one.used}: {one.what}", one.line)
    return [f"{edge} (line {line})" for edge, line in sorted(found.items())]


def circles(kernel: Path) -> list[list[str]]:
    """Groups of files that need each other in a circle."""
    needs: dict[str, set[str]] = {unit(kernel, path): set() for path in sources(kernel)}
    for one in uses(kernel):
        needs[one.user].add(one.used)
    return circles_of(needs)


def misplaced_circles(kernel: Path, plan: House) -> list[list[str]]:
    """Circles that go through several rooms, or are too large."""
    return [
        group
        for group in circles(kernel)
        if len(group) > plan.largest_circle or len({name.rpartition("/")[0] for name in group}) > 1
    ]


def long_files(folder: Path, most: int) -> dict[str, int]:
    """The sources and headers that have too many lines."""
    lengths = {
        path.relative_to(folder).as_posix(): path.read_text("utf-8").count("\n")
        for path in folder.rglob("*.[ch]")
    }
    return {name: n for name, n in lengths.items() if n > most}


def functions(kernel: Path) -> dict[str, int]:
    """The lines of each function that are not blank, those of its head and braces included."""
    return {
        f"{unit(kernel, path)}: {m['name']}": sum(bool(line.strip()) for line in m[0].splitlines())
        for path, text in sources(kernel).items()
        for pattern in (BODY, ONE_LINE)
        for m in pattern.finditer(text)
    }


def structs(kernel: Path) -> dict[str, int]:
    """How many members each struct has; those of a struct inside count as one."""
    return {
        m["name"]: sum(len(member.split(",")) for member in _outermost(m["members"]).split(";")[:-1])
        for text in sources(kernel).values()
        for m in STRUCT.finditer(text)
    }


def _outermost(members: str) -> str:
    """The text without what stands in braces or brackets."""
    while (shorter := re.sub(r"\{[^{}]*\}|\[[^\[\]]*\]|\([^()]*\)", "", members)) != members:
        members = shorter
    return members


# ---- the kernel -----------------------------------------------------------------------------------------


def test_every_file_stands_in_a_room() -> None:
    assert homeless(KERNEL, house()) == []


def test_functions_are_called_after_their_files() -> None:
    assert strange_names(KERNEL, house()) == []


def test_nothing_uses_a_later_room() -> None:
    assert upward(KERNEL, house()) == []


def test_circles_are_small_and_inside_one_room() -> None:
    assert misplaced_circles(KERNEL, house()) == []


@pytest.mark.parametrize("folder", ["kernel", "tests", "wrapper", "studies"])
def test_no_file_is_too_long(folder: str) -> None:
    assert long_files(ROOT / folder, house().longest_file) == {}


def test_no_function_is_too_long() -> None:
    most = house().longest_function
    assert {name: n for name, n in functions(KERNEL).items() if n > most} == {}


def test_functions_are_short() -> None:
    """Half of them, and nine of ten."""
    lengths = sorted(functions(KERNEL).values())
    assert lengths[len(lengths) // 2] <= house().half_of_functions
    assert lengths[len(lengths) * 9 // 10] <= house().most_functions


def test_no_struct_is_too_large() -> None:
    most = house().largest_struct
    assert {name: n for name, n in structs(KERNEL).items() if n > most} == {}


# ---- the check itself -----------------------------------------------------------------------------------

PLAN = House(("low", "mid/left", "high"), 2, 400, 8, 20, 60, 40)
SOUND = {
    "low/stone.h": "int pm_stone(void);",
    "low/stone.c": '#include "low/stone.h"\nint pm_stone(void) { return 1; }\nconst int pm_hue[2] = {1, 2};',
    "mid/left/wall.h": "int pm_wall(void); /* pm_roof */",
    "mid/left/wall.c": '#include "low/stone.h"\nint pm_wall(void)\n{\n    return pm_stone();\n}',
    "high/roof.c": '#include "mid/left/wall.h"\nint pm_roof(void) { return pm_wall(); }',
}


def built(folder: Path, **changed: str) -> Path:
    """A small kernel, with other texts for some of its files (`low__stone_c` is low/stone.c)."""
    files = SOUND | {
        re.sub(r"_([ch])$", r".\1", name).replace("__", "/"): text for name, text in changed.items()
    }
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def test_a_sound_kernel_has_no_faults(tmp_path: Path) -> None:
    kernel = built(tmp_path)
    assert (homeless(kernel, PLAN), upward(kernel, PLAN), circles(kernel)) == ([], [], [])
    assert [(one.user, one.used) for one in uses(kernel) if one.what == "pm_stone"] == [
        ("mid/left/wall", "low/stone")
    ]


def test_an_include_of_a_later_room_is_named_with_itsline_of(tmp_path: Path) -> None:
    kernel = built(tmp_path, low__stone_h='int pm_stone(void);\n#include "mid/left/wall.h"')
    assert upward(kernel, PLAN) == ['low/stone -> mid/left/wall: "mid/left/wall.h" (line 2)']


def test_a_call_of_a_later_room_is_found_behind_a_declaration(tmp_path: Path) -> None:
    kernel = built(tmp_path, low__stone_c="int pm_roof(void);\nint pm_stone(void) { return pm_roof(); }")
    assert upward(kernel, PLAN) == ["low/stone -> high/roof: pm_roof (line 1)"]


def test_a_table_of_a_later_room_is_found(tmp_path: Path) -> None:
    kernel = built(
        tmp_path,
        high__tiles_c="const int pm_tiles[2] = {1, 2};",
        low__stone_c="extern const int pm_tiles[2];\nint pm_stone(void)\n{\n    return pm_tiles[0];\n}",
    )
    assert upward(kernel, PLAN) == ["low/stone -> high/tiles: pm_tiles (line 1)"]


def test_long_files_are_found(tmp_path: Path) -> None:
    kernel = built(tmp_path, low__stone_c="\n" * 6, low__stone_h="\n" * 5)
    assert long_files(kernel, 5) == {"low/stone.c": 6}


def test_a_file_without_a_room_is_found(tmp_path: Path) -> None:
    assert homeless(built(tmp_path, shed_c="", mid__door_h=""), PLAN) == ["mid/door.h", "shed.c"]


def test_a_function_with_a_strange_name_is_found(tmp_path: Path) -> None:
    kernel = built(
        tmp_path,
        planemotion_h="int pm_public(void);",
        high__roof_c="int pm_roof_tile(void) { return 1; }\nint pm_tile(void) { return 1; }",
        low__stone_c="int pm_block_cut(void) { return 1; }\nint pm_public(void) { return 1; }",
        low__stone_h="typedef struct pm_block {\n    int a;\n} pm_block;\n",
    )
    assert strange_names(kernel, PLAN) == ["high/roof: pm_tile"]


def test_circles_are_found_in_one_room_and_through_several(tmp_path: Path) -> None:
    kernel = built(
        tmp_path,
        low__sand_c='#include "low/stone.h"\nint pm_sand(void) { return pm_stone(); }',
        low__stone_c="int pm_sand(void), pm_roof(void);\nint pm_stone(void) { return pm_sand(); }",
    )
    assert ["low/sand", "low/stone"] in [[n for n in g if n.startswith("low")] for g in circles(kernel)]
    assert misplaced_circles(kernel, PLAN) == [["high/roof", "low/sand", "low/stone", "mid/left/wall"]]


def test_lines_of_functions_and_members_of_structs_are_counted(tmp_path: Path) -> None:
    stone = "typedef struct pm_stone {\n    int a, *b[2]; /* c, d; */\n    struct { int x, y; } at;\n"
    cut = "static int cut(int a,\n               int b)\n{\n    if (a) {\n        return b;\n    }\n"
    kernel = built(
        tmp_path,
        low__stone_h=stone + "    int (*cut)(int, int);\n} pm_stone;",
        low__stone_c=cut + "\n    return a;\n}\nint pm_one(int a) { return a; }\n",
    )
    assert structs(kernel) == {"pm_stone": 4}
    assert functions(kernel)["low/stone: cut"] == 8
    assert functions(kernel)["low/stone: pm_one"] == 1
