"""What every kind of joint, coupling and force must have: a file, a line; and what it declares works."""

from __future__ import annotations

import math
from typing import Any

import pytest

import planemotion
from planemotion.compile.flatten import flatten
from planemotion.engine import call as engine
from planemotion.kinds import KINDS
from planemotion.pictures import scene as sketch
from planemotion.report.explain import explain

# Two disks side by side that touch at the origin, and a particle.
BODIES = """
until = "t = 0.1 s"
plane = "horizontal"
[ground]
points = { O = [0, 0], S = ["-3 m", 0] }
lines = { floor = { through = [0, "-0.5 m"] }, axis = { through = [0, 0] } }
circles = { ring = "0.5 m" }
[bodies]
a = { disk = "0.5 m", mass = "2 kg", points = { E = ["0.1 m", 0] }, at = ["-0.5 m", 0] }
b = { disk = "0.5 m", mass = "3 kg", at = ["0.5 m", 0] }
P = { mass = "1 kg", at = ["0.7 m", "2 m"] }
"""
# One element of each kind, called e; what holds beside it.
EXAMPLES = {
    "pin": 'e = { pin = ["a.E", "ground"], friction = { mu = 0.1, radius = "1 cm" } }',
    "slider": 'e = { slider = ["a.center", "ground.axis"], turning = false, friction = 0.1 }',
    "slot": 'e = { slot = ["a.center", "ground.ring"], friction = 0.2 }',
    "link": 'e = { link = ["a.E", "b.center"], length = "0.9 m" }',
    "weld": 'e = { weld = ["a", "b"] }',
    "rolling": 'e = { rolling = ["a.rim", "ground.floor"] }',
    "gears": 'e = { gears = ["a.rim", "b.rim"] }',
    "belt": 'e = { belt = ["a.rim", "b.rim"], pretension = "9 N", friction = 0.3 }\n'
    + '[joints]\nA = { pin = ["a", "ground"] }\nB = { pin = ["b", "ground"] }\n[bodies.b]\nat = ["0.7 m", 0]',
    "cord": 'e = { cord = ["ground.S", "a.rim cw", "P"], friction = 0.3, restitution = 0.5 }',
    "motor": 'e = { motor = ["a", "b"], value = "2 rad/s" }',
    "ratio": 'e = { ratio = { "a.turned" = 1, b.turned = -2 } }',
    "spring": 'e = { spring = ["a.E", "ground.S"], stiffness = "20 N/m", only = "pull" }',
    "torsion": 'e = { torsion = ["a", "b"], stiffness = "3 N*m", free_angle = 1 }',
    "damper": 'e = { damper = ["a", "b"], rate = "0.1 N*m*s" }',
    "force": 'e = { force = "a.E", value = [1, "2 N"], turns_with = "a" }',
    "couple": 'e = { couple = ["a", "b"], value = "(2 N*m)*t/(1 s)" }',
}
# What a force can do in more than one way.
VARIANTS = {
    "force of given power": (
        "force",
        'e = { force = "a.E", power = "3 W" }\n[start]\na.velocity.x = "1 m/s"',
    ),
    "couple of given power": ("couple", 'e = { couple = "a", power = "3 W" }\n[start]\na.omega = "1 rad/s"'),
    "rolling on a curve": (
        "rolling",
        'e = { rolling = ["a.rim", "ground.bowl"] }\n[ground.curves]\n'
        'bowl = { x = "(1 m)*s", y = "(0.1 m)*(s + 0.5)^2 - (0.5 m)", from = -2, to = 2 }',
    ),
    "pin of given angle": ("pin", 'e = { pin = ["a.E", "ground"], angle = "t*(2 rad/s)" }'),
    "slider of given position": (
        "slider",
        'e = { slider = ["a.center", "ground.axis"], position = "(-0.5 m) + (1 m)*sin(t/(1 s))" }',
    ),
    "link of given length": ("link", 'e = { link = ["a.E", "b.center"], length = "(0.9 m) + t*(1 m/s)" }'),
    "motor of given angle": ("motor", 'e = { motor = ["a", "b"], angle = "sin(t/(1 s))" }'),
    "gears by teeth": (
        "gears",
        'e = { gears = ["a.rim", "b.rim"], pressure_angle = "20 deg", efficiency = 0.9 }',
    ),
    "gears with backlash": ("gears", 'e = { gears = ["a.rim", "b.rim"], backlash = "1 mm" }'),
    "rack": ("gears", 'e = { gears = ["a.rim", "ground.floor"], pressure_angle = "20 deg" }'),
    "belt that grips": ("belt", 'e = { belt = ["a.rim", "b.rim"] }\n[bodies.b]\nat = ["0.7 m", 0]'),
    "damper of points": ("damper", 'e = { damper = ["a.E", "ground.S"], rate = "3 N*s/m" }'),
}
GROUP = {word: group for group, kinds in KINDS.items() if group != "contacts" for word in kinds}


def scene(word: str, element: str) -> planemotion.Scene:
    element = element.replace("value = [1,", 'value = ["1 N",')
    text = BODIES
    if "[bodies.b]" in element:  # not where it stands otherwise
        element, _, moved = element.partition("\n[bodies.b]\n")
        text = text.replace('at = ["0.5 m", 0]', moved)
    return planemotion.load_text(f"{text}[{GROUP[word]}]\n{element}\n")


def pushed(made: planemotion.Scene) -> planemotion.Scene:
    """The same scene with forces on all its bodies, so that what an element does is not nothing."""
    made.force("push_a", force="a.E", value=["3 N", "-14 N"])
    made.force("turn_a", couple="a", value="0.7 N*m")
    made.force("push_b", force="b.center", value=["-2 N", "5 N"])
    return made.force("push_P", force="P", value=["1 N", "6 N"])


def declared(word: str) -> dict[str, None]:
    """Addresses of all quantities that the kind declares."""
    quantities = getattr(KINDS[GROUP[word]][word], "quantities", {})
    strand = {
        name: "[2]"
        if len(source.kinds) > 1 or (word == "cord" and not source.vector and not source.of_rims)
        else ""
        for name, source in quantities.items()
    }
    return dict.fromkeys(
        f"e.{name}{strand[name]}{'.x' if source.vector else ''}" for name, source in quantities.items()
    )


def test_every_kind_has_an_example_here() -> None:
    assert set(EXAMPLES) == set(GROUP)


@pytest.mark.parametrize("word", EXAMPLES)
def test_a_kind_has_a_file_of_its_name(word: str) -> None:
    kind = KINDS[GROUP[word]][word]
    assert kind.word == word
    assert kind.__module__ == f"planemotion.kinds.{word}"


@pytest.mark.parametrize(
    ("word", "element"), [*EXAMPLES.items(), *VARIANTS.values()], ids=[*EXAMPLES, *VARIANTS]
)
def test_a_kind_runs_and_is_drawn_and_told(word: str, element: str) -> None:
    made = scene(word, element)
    result = made.run()
    assert result.status == "ok", result.error
    told = next(line for line in explain(made).text.splitlines() if line.startswith("  e "))
    assert told.split()[1] == word
    texts = sketch.figure(sketch.start_of(made)).axes[0].texts
    assert "e" in [name for text in texts for name in text.get_text().split(", ")]


@pytest.mark.parametrize("word", EXAMPLES)
def test_what_a_kind_declares_can_be_asked(word: str) -> None:
    """Its quantities, and the columns of a history: asked for the end, both are the same numbers."""
    made = pushed(scene(word, EXAMPLES[word]))
    shown = [column for column in flatten(made, history=True).trace if column.startswith("e.")]
    assert shown, "a history shows it"
    asked = {column: f"ask_{i}" for i, column in enumerate({**dict.fromkeys(shown), **declared(word)})}
    for address, key in asked.items():
        made.ask(key, address)
    result = made.run()
    assert result.status == "ok", result.error
    values: dict[str, Any] = {address: result.asks[key].value for address, key in asked.items()}
    flat = flatten(made, history=True)
    history = engine.trace(flat, flat.defaults)
    assert {column: values[column] for column in shown} == pytest.approx(
        {column: history.columns[column][-1] for column in shown}, rel=1e-9, abs=1e-9
    )
    assert all(math.isfinite(value) for value in values.values())
    assert any(value != 0 for value in values.values())
