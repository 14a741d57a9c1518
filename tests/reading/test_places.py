"""Where faults stand: lines of keys, all faults of a file at once, what is right and perhaps not meant."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

import planemotion
from planemotion.base.lines import place_of
from tests import CHAPTER

SCENES = sorted(CHAPTER.glob("*.toml"))


def paths(table: Mapping[str, Any], above: str = "") -> Iterator[str]:
    for key, value in table.items():
        path = f"{above}.{key}" if above else key
        yield path
        if isinstance(value, Mapping):
            yield from paths(value, path)


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_the_place_of_every_key_of_the_chapter(file: Path) -> None:
    """A key renamed where it is said to stand is another one when the text is read again."""
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines(keepends=True)
    for path in paths(tomllib.loads(text)):
        place = place_of(text, path)
        assert place is not None, path
        line, column = place
        key = path.rpartition(".")[2]
        before, after = lines[line - 1][: column - 1], lines[line - 1][column - 1 :]
        assert key in after, (path, place)
        assert before.strip(" \t")[-1:] in ("", "{", ","), (path, place)
        changed = [*lines[: line - 1], before + after.replace(key, f"{key}_x"), *lines[line:]]
        try:
            found = set(paths(tomllib.loads("".join(changed))))
        except tomllib.TOMLDecodeError:
            continue
        assert path not in found or text.count(key) > 1, path


TEXT = """
until = "t = 1 s"  # [bodies.no]
title = \'\'\'
[bodies.AB]
mass = 1
\'\'\'
[bodies]
AB = { rod = ["A", "B"], length = "1 m",
       mass = "2 kg" }
"C D".mass = "1 kg"
[joints.A]
pin = [
  "AB.A",
  "ground",
]
[ask]
"""


@pytest.mark.parametrize(
    ("path", "place"),
    [
        ("until", (2, 1)),
        ("bodies.AB", (8, 1)),
        ("bodies.AB.rod[1]", (8, 8)),
        ("bodies.AB.mass", (9, 8)),
        ("bodies.AB.inertia", (8, 1)),
        ("bodies.C D", (10, 1)),
        ("joints.A.pin[1]", (12, 1)),
        ("joints.B", None),
        ("ask.x", (16, 1)),
        ("solve.route", None),
    ],
)
def test_places_of_keys_in_tables_over_several_lines(path: str, place: tuple[int, int] | None) -> None:
    assert place_of(TEXT, path) == place


def test_an_empty_text_has_no_places() -> None:
    assert place_of("", "until") is None


FAULTY = """
until = "t = 1 s"
gravity = "9.81 m/s^2"
[bodies]
AB = { rod = ["A", "B"], lenght = "1 m", mass = "2 kg", at = [0, 0] }
C = { Disk = "1 m", mass = "2 kg" }
[joints]
A = { hinge = ["AB.A", "ground"] }
[forces]
push = { force = "AB.B", vaule = ["1 N", 0] }
[ask]
w = { off = "AB.omega" }
"""


def test_all_faults_of_a_file_are_told_at_once_with_their_places() -> None:
    with pytest.raises(planemotion.SceneError) as told:
        planemotion.load_text(FAULTY, file="x.toml")
    lines = str(told.value).splitlines()
    assert [line.split(": ")[:2] for line in lines] == [
        ["x.toml:3:1", "gravity"],
        ["x.toml:5:26", "bodies.AB.lenght"],
        ["x.toml:6:7", "bodies.C.Disk"],
        ["x.toml:8:1", "joints.A"],
        ["x.toml:10:26", "forces.push.vaule"],
        ["x.toml:12:7", "ask.w.off"],
    ]
    meant = ["parameters.g", "length", "disk", "pin", "value", "of"]
    assert all(f'did you mean "{word}"' in line for word, line in zip(meant, lines, strict=True))
    assert (told.value.line, told.value.column) == (3, 1)
    assert len(told.value.others) == 5


UNITS = FAULTY.replace("gravity", "title").replace("lenght", "length").replace("Disk", "disk")
UNITS = (
    UNITS.replace("hinge", "pin").replace("vaule", "value").replace("off", "of").replace('"1 m"', '"1 kg"')
)


def test_faults_of_values_too() -> None:
    with pytest.raises(planemotion.SceneError) as told:
        planemotion.load_text(UNITS, file="x.toml").run()
    assert [str(one).partition(" = ")[0] for one in (told.value, *told.value.others)][1:] == [
        "x.toml:6:7: bodies.C.disk"
    ]
    asks = UNITS.replace('"1 kg"', '"1 m"').replace('"AB.omega"', '"AB.omga"') + 'v = "AC.omega"\n'
    with pytest.raises(planemotion.SceneError) as told:
        planemotion.load_text(asks, file="x.toml").run()
    assert [one.line for one in (told.value, *told.value.others)] == [12, 13]


def test_a_scene_made_in_python_has_no_lines() -> None:
    scene = planemotion.Scene(until="t = 1 s").body("AB", rod=["A", "B"], lenght="1 m")
    with pytest.raises(planemotion.SceneError, match=r"^bodies\.AB\.lenght: unknown key"):
        scene.run()


ADVISED = """
until = "t = 1 s"
[parameters]
L = "1 m"
M = "2 kg"
N = "3 m"
[bodies]
AB = { rod = ["A", "B"], length = "L", mass = "M", at = [0, 0], angle = 30 }
"""


def test_what_is_perhaps_not_meant() -> None:
    advice = planemotion.load_text(ADVISED).data.advice
    assert [line.partition(":")[0] for line in advice] == [
        "parameters.N",
        "bodies.AB.angle = 30",
        "ask",
    ]
    better = (
        ADVISED.replace("30 }", "0.5 }").replace('"3 m"', '"3 m/s"')
        + 'start.AB.velocity = ["N", 0]\nask.w = "AB.omega"\n'
    )
    assert (
        planemotion.load_text(
            better.replace("start.AB", "[start]\nAB").replace("ask.w", "[ask]\nw")
        ).data.advice
        == ()
    )


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_no_scene_of_the_chapter_is_advised(file: Path) -> None:
    assert planemotion.load(file).data.advice == ()
