"""The schema of scenes: what the reader takes passes, what it refuses for its keys does not."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from planemotion.kinds import KINDS
from planemotion.model.tables import Ask, Body, Event, Find, Ground, Solve
from planemotion.reading.scene import SceneData
from planemotion.report.schema import schema
from tests.cli.calls import invoke
from tests.kinds.test_kinds import EXAMPLES
from tests.kinds.test_kinds import scene as example

MADE = schema()
CHECK = jsonschema.Draft202012Validator(MADE)
SHIPPED = sorted(
    path
    for folder in ("studies", "wrapper/planemotion/examples")
    for path in Path(folder).rglob("*.toml")
    if "bodies" in path.read_text("utf-8")
)


def faults(scene: Any) -> list[str]:
    return [f"{fault.json_path}: {fault.message}" for fault in CHECK.iter_errors(scene)]


def test_it_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(MADE)


def test_all_shipped_scenes_pass() -> None:
    assert len(SHIPPED) > 160
    found = {str(path): faults(tomllib.loads(path.read_text(encoding="utf-8"))) for path in SHIPPED}
    assert {path: told for path, told in found.items() if told} == {}


def test_the_words_are_those_that_the_reader_takes() -> None:
    assert set(MADE["properties"]) == set(SceneData.file_keys())
    for model in (Body, Ground, Ask, Event, Find, Solve):
        assert tuple(MADE["$defs"][model.__name__]["properties"]) == model.file_keys()
    for group, kinds in KINDS.items():
        choices = MADE["properties"][group]["additionalProperties"]["anyOf"]
        words = [tuple(choice["properties"]) for choice in choices]
        # Behind them stands what is repeated.
        assert words == [*((kind.word, *kind.options()) for kind in kinds.values()), ("for",)]


def test_no_inner_key_is_in_it() -> None:
    text = json.dumps(MADE)
    for word in ("run_finds", "hints", "from_", "partners", "for messages", "shape only", "`kinds`"):
        assert word not in text
    assert "file" not in MADE["properties"]


@pytest.mark.parametrize(
    ("keys", "wrong"),
    [
        (("unti",), "t = 1 s"),
        (("bodies", "AB", "lenght"), "1 m"),
        (("bodies", "AB", "rod"), ["A"]),
        (("bodies", "AB", "at"), [0, 0, 0]),
        (("bodies", "AB", "mass"), ["1 kg"]),
        (("joints", "A", "coils"), 3),
        (("joints", "A", "pin"), ["AB.A"]),
        (("joints", "A"), {"hinge": ["AB.A", "ground"]}),
        (("forces", "k"), {"spring": ["AB.A", "ground"], "rate": "1 N*s/m"}),
        (("contacts", "c"), {"touch": ["a", "b"], "capture": "glue"}),
        (("couplings", "g"), {"gears": ["a"]}),
        (("ask", "x"), {"of": "t", "at": {"each": "t", "values": {"form": 0}}}),
        (("events", "e"), {"when": "t = 1 s", "do": [{"throw": "AB"}]}),
        (("solve", "max_cases"), "many"),
        (("sweep", "L"), "1 m"),
        (("runs", "low"), "1 m"),
        (("ground", "lines", "f"), {"trough": [0, 0]}),
        (("plane",), "tilted"),
    ],
)
def test_what_the_reader_refuses_does_not_pass(keys: tuple[str, ...], wrong: Any) -> None:
    scene: dict[str, Any] = {
        "until": "t = 1 s",
        "bodies": {"AB": {"rod": ["A", "B"], "length": "1 m", "mass": "1 kg"}},
        "joints": {"A": {"pin": ["AB.A", "ground"]}},
    }
    assert faults(scene) == []
    changed = copy.deepcopy(scene)
    table = changed
    for key in keys[:-1]:
        table = table.setdefault(key, {})
    table[keys[-1]] = wrong
    assert faults(changed) != []


@pytest.mark.parametrize("word", EXAMPLES)
def test_an_example_of_each_kind_passes(word: str) -> None:
    assert faults(example(word, EXAMPLES[word]).table) == []


def test_the_command_writes_it(folder: Path) -> None:
    assert json.loads(invoke("schema").stdout) == MADE
    assert invoke("schema", "--out", "s.json").stdout.strip() == "s.json"
    assert json.loads((folder / "s.json").read_text(encoding="utf-8")) == MADE
