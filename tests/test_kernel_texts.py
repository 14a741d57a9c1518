"""What the kernel says of itself: rooms name their files, comments files that exist, numbers their effect."""

from __future__ import annotations

import re
from pathlib import Path

from tests.test_kernel_rooms import COMMENT, KERNEL, built, house, line_of, sources, unit

# A small number, as one that decides what is nothing; a named number in a header of tolerances, and its text.
SMALL = re.compile(r"(?<![\w.])[\d.]+[eE]-\d+")
TOLERANCE = re.compile(r"^#define (PM_\w+)[ \\\n]+[^\s/]+[^/\n]*?(?:/\*(.*?)\*/)?$", re.MULTILINE)
EFFECT = re.compile(r"\b(more|larger|longer|less|fewer|likewise|the same|as above)\b")
# Coefficients of formulas, which decide nothing.
FORMULAS = {"routes/rk/dop853"}


def named(readme: str) -> set[str]:
    """The files that the table or list of a room's README names, without their endings."""
    heads = re.findall(r"^(?:\| (`.*?`) \||- (`.*?`):)", readme, re.MULTILINE)
    return {name.partition(".")[0] for head in heads for name in re.findall(r"`(.*?)`", "".join(head))}


def bare_numbers(kernel: Path) -> list[str]:
    """Small numbers that stand where they are used, and not in the headers of tolerances."""
    return [
        f"{unit(kernel, path)}: {m[0]} (line {line_of(text, m)})"
        for path, text in sources(kernel).items()
        if not path.stem.startswith("tolerances") and unit(kernel, path) not in FORMULAS
        for m in SMALL.finditer(text)
    ]


def silent_tolerances(kernel: Path) -> list[str]:
    """Names of the headers of tolerances that do not say what another value would do."""
    found = []
    for path in sorted((kernel / "numerics").glob("tolerances*.h")):
        for name, said in TOLERANCE.findall(path.read_text(encoding="utf-8")):
            if not name.endswith("_H") and not EFFECT.search(said):
                found.append(name)
    return found


def lost_files(kernel: Path) -> list[str]:
    """Sources that comments name and that are not there; `name.c` stands for any."""
    there = {path.name for path in kernel.rglob("*.[ch]")}
    return sorted(
        f"{unit(kernel, path)}: {name}"
        for path in kernel.rglob("*.[ch]")
        for comment in COMMENT.findall(path.read_text(encoding="utf-8"))
        for name in re.findall(r"(?<![\w*])\w+\.[ch]\b", comment)
        if name not in there and not name.endswith("_name.c")
    )


# ---- the kernel -----------------------------------------------------------------------------------------


def test_every_room_says_what_it_is() -> None:
    for room in house().rooms:
        said = (KERNEL / room / "README.md").read_text(encoding="utf-8")
        assert len(re.findall(r"\.\s", said)) >= 3, room


def test_a_room_names_all_its_files_and_no_other() -> None:
    for room in house().rooms:
        there = {path.stem for path in (KERNEL / room).glob("*.[ch]")}
        assert named((KERNEL / room / "README.md").read_text(encoding="utf-8")) == there, room


def test_comments_name_files_that_are_there() -> None:
    assert lost_files(KERNEL) == []


def test_small_numbers_stand_in_the_headers_of_tolerances() -> None:
    assert bare_numbers(KERNEL) == []


def test_every_tolerance_says_what_another_value_would_do() -> None:
    names = [
        name
        for path in sorted((KERNEL / "numerics").glob("tolerances*.h"))
        for name in TOLERANCE.findall(path.read_text("utf-8"))
    ]
    assert len(names) > 400
    assert silent_tolerances(KERNEL) == []


# ---- the checks themselves ------------------------------------------------------------------------------


def test_the_files_of_a_table_and_of_a_list_are_read() -> None:
    assert named("Uses `sand`.\n| `stone`, `lime.h` | of `clay` |\n- `wall.c`: of `roof`\n") == {
        "stone",
        "lime",
        "wall",
    }


def test_a_file_that_is_gone_is_found(tmp_path: Path) -> None:
    kernel = built(tmp_path, low__stone_c="/* See wall.h, clay.c. */\nint pm_stone(void) { return 1; }")
    assert lost_files(kernel) == ["low/stone: clay.c"]


def test_a_bare_number_and_a_silent_tolerance_are_found(tmp_path: Path) -> None:
    kernel = built(
        tmp_path,
        low__stone_c="int pm_stone(double x)\n{\n    return x < 1.5e-9 * pm_size1e;\n}",
        numerics__tolerances_h="#define PM_A 1e-9 /* m: none; larger: blind */\n"
        "#define PM_B 2\n#define PM_C \\\n    3 /* m */\n",
    )
    assert bare_numbers(kernel) == ["low/stone: 1.5e-9 (line 3)"]
    assert silent_tolerances(kernel) == ["PM_B", "PM_C"]
