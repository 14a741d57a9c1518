"""Every word that a scene may have says what it means, and no other; units are those of the program."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import pytest

import planemotion
from planemotion.base.errors import SceneError
from planemotion.compile.flatten import flatten
from planemotion.kinds import KINDS
from planemotion.kinds.base import Bearing
from planemotion.language.address import KEYWORDS
from planemotion.language.tree import WRITTEN_FUNCTIONS
from planemotion.language.units import factor
from planemotion.model import tables, words
from planemotion.model.element import Element, Table
from planemotion.model.readers import SWEEP_KEYS
from planemotion.model.tabulated import Tabulated
from planemotion.reading.scene import SceneData
from planemotion.report.meaning import Meaning, meaning_of, meanings
from planemotion.report.schema import schema

# Tables whose keys are those of other tables.
BASES = (tables.Kind, tables.Contact, Table)
TABLES: list[type[Table]] = [
    *(SceneData, Bearing, Element, Tabulated),
    *(
        model
        for model in vars(tables).values()
        if isinstance(model, type) and issubclass(model, Table) and model not in BASES
    ),
]


def _inherited(model: type[Table]) -> set[str]:
    """The keys that a table has from another one, where they have their meaning."""
    return {key for base in model.__mro__[1:] if base in TABLES for key in base.file_keys()}


COUPLING_QUANTITIES = {quantity for kind in KINDS["couplings"].values() for quantity in kind.quantities}  # type: ignore[attr-defined]
WORDS: Mapping[str, Mapping[str, set[str]]] = {
    "tables": {
        **{model.__name__: set(model.file_keys()) - _inherited(model) for model in TABLES},
        "Sweep": set(SWEEP_KEYS),  # beside it stand parameters
    },
    "kinds": {
        kind.word: {kind.word, *kind.options()} - set(Element.model_fields)
        for kinds in KINDS.values()
        for kind in kinds.values()
    },
    "measures": {
        "body": set(words.BODY_QUANTITIES),
        "point": set(words.POINT_QUANTITIES),
        "driven": set(words.DRIVE_QUANTITIES),
        "joint": set(words.JOINT_QUANTITIES),
        "coupling": COUPLING_QUANTITIES,
        "contact": {*words.CONTACT_QUANTITIES, *words.CAPTURE_QUANTITIES},
        "force": set(words.FORCE_QUANTITIES),
        "event": set(words.EVENT_QUANTITIES),
        "energy": set(words.ENERGIES),
        "spin": set(words.SPIN_QUANTITIES),
        "modes": {*words.MODE_QUANTITIES, *words.MODES_QUANTITIES},
        "scene": set(words.SCENE_QUANTITIES),
    },
    "words": {
        "parts": set(words.PARTS),
        "keywords": set(KEYWORDS),
        "changes": {*words.CONTACT_CHANGES, *words.CORD_CHANGES},
        "functions": set(WRITTEN_FUNCTIONS),
        "many": {"for", "index"},
        "laws": set(words.LAWS),
        "routes": set(words.ROUTES),
    },
}
# A scene that has one of each thing that is measured.
SCENE = """
until = "t = 0.1 s"
spin = { through = [0, 0], angle = 0, inertia = "1 kg*m^2" }
ground.points.O = [0, 0]
ground.lines.floor = { through = [0, "-0.5 m"] }
ground.circles.peg = { radius = "0.1 m", center = [0, "5 m"] }
bodies.body = { disk = "0.5 m", mass = "2 kg", at = [0, 0] }
bodies.other = { disk = "0.5 m", mass = "2 kg", at = ["3 m", 0] }
joints.joint = { slider = ["body.center", "ground.floor"] }
joints.rolls = { rolling = ["other.rim", "ground.floor"] }
bodies.moved = { disk = "0.5 m", mass = "2 kg", driven.at = ["(9 m) + t*(1 m/s)", 0] }
bodies.turned = { disk = "0.5 m", mass = "2 kg", at = ["20 m", 0] }
joints.turned_by = { pin = ["turned.center", "ground"], angle = "t*(1 rad/s)" }
couplings.cord = { cord = ["body.center", "other.center"] }
couplings.rope = { cord = ["body.center", "ground.peg ccw", "other.center"], friction = 0.3 }
couplings.gears = { gears = ["body.rim", "other.rim"] }
couplings.motor = { motor = ["body", "ground"], value = "1 rad/s" }
contacts.contact = { touch = ["other.rim", "ground.floor"] }
contacts.caught = { touch = ["turned.rim", "ground.floor"], capture = "body" }
forces.force = { spring = ["body.center", "ground.O"], stiffness = "1 N/m" }
events.event = "t = 0.05 s"
"""


def test_every_word_has_its_meaning_and_no_other() -> None:
    found = {
        chapter: {group: set(said) for group, said in groups.items()}
        for chapter, groups in meanings().items()
    }
    assert found == WORDS


def test_a_word_without_a_meaning_is_an_error() -> None:
    with pytest.raises(KeyError):
        meaning_of(tables.Body, "colour")


def every() -> Iterator[tuple[str, Meaning]]:
    for chapter, groups in meanings().items():
        for group, said in groups.items():
            for word, meaning in said.items():
                yield f"{chapter}.{group}.{word}", meaning


@pytest.mark.parametrize(("where", "meaning"), [pytest.param(*one, id=one[0]) for one in every()])
def test_a_meaning_is_a_sentence_and_its_unit_a_unit_of_si(where: str, meaning: Meaning) -> None:
    assert meaning.says.endswith((".", "?"))
    assert not meaning.without.endswith(".")
    assert factor(meaning.unit)[0] == 1


# Group of measures -> what stands before the word.
PREFIX = {
    "point": "body.center.",
    "scene": "",
    "driven": "moved.driven.",
    **{group: f"{group}." for group in ("body", "joint", "contact")},
}
# Measures of elements of a certain kind, and those whose own words follow.
ELSEWHERE = {
    "joint.friction_needed": "rolls.friction_needed",
    "joint.power": "turned_by.power",
    "contact.couple": "caught.couple",
    "coupling.power": "motor.power",
    "coupling.tension": "cord.tension",
    "coupling.slack": "cord.slack",
    "coupling.slip": "rope.slip",
    "coupling.force": "gears.force.x",
    "coupling.impulse": "cord.impulse",
    "coupling.couple": "motor.couple",
    "scene.energy": "energy.total",
    "scene.spin": "spin.omega / (1 rad/s)",
    "scene.modes": "modes.count",
    **{f"modes.{word}": f"modes[1].{word}" for word in words.MODE_QUANTITIES},
}


@pytest.mark.parametrize(
    ("group", "word"), [(group, word) for group, said in WORDS["measures"].items() for word in sorted(said)]
)
def test_the_unit_of_a_measure_is_that_of_its_dimension(group: str, word: str) -> None:
    meaning = meanings()["measures"][group][word]
    part = ".x" if meaning.says.endswith("a vector.") else ""
    address = ELSEWHERE.get(f"{group}.{word}", f"{PREFIX.get(group, group + '.')}{word}{part}")
    made = planemotion.load_text(SCENE).ask("x", of=address, unit=meaning.unit or "1")
    flatten(made)  # it refuses a unit of another dimension
    with pytest.raises(SceneError, match="unit"):
        flatten(planemotion.load_text(SCENE).ask("x", of=address, unit="Pa"))


def descriptions(part: Any) -> Iterator[tuple[str, bool]]:
    """Keys of all tables in a part of a schema, and whether they say what they are."""
    if isinstance(part, dict):
        for key, one in part.get("properties", {}).items():
            yield key, bool(one.get("description"))
        part = list(part.values())
    for inner in part if isinstance(part, list) else ():
        yield from descriptions(inner)


def test_the_schema_says_what_each_key_means() -> None:
    said = list(descriptions(schema()))
    inner = {"polar", "from", "by", "all", "find"}  # of vectors, places, ends and runs
    assert len(said) > 150
    assert {key for key, has in said if not has} <= inner
