"""Faults of first scenes: each is told in one sentence with file, line, key, value and what was expected."""

from __future__ import annotations

import pytest

from planemotion import SceneError, load_text

GOOD = """until = "t = 1 s"
[parameters]
L = "1 m"
[bodies]
AB = { rod = ["A", "B"], length = "L", mass = "2 kg", at = { A = [0, 0] } }
[ground]
points = { stop = ["0.5 m", "-0.5 m"] }
lines = { floor = { through = [0, "-2 m"] } }
[joints]
A = { pin = ["AB.A", "ground"] }
[contacts]
c = { touch = ["AB.B", "ground.floor"], restitution = 0.5 }
[forces]
F = { force = "AB.B", value = ["3 N", 0] }
[events]
low = "AB.angle < -60 deg"
[ask]
omega = { of = "AB.omega", unit = "rad/s", at = "low" }
"""

# What is changed into what; of the message: the line, the key, the value ("": none to show), what is wanted.
FAULTS = [
    # bodies
    ('"2 kg"', '"2"', 5, "bodies.AB.mass", '"2"', "a mass (such as kg) is wanted; this is a plain number"),
    ('"2 kg"', "2", 5, "bodies.AB.mass", "2", "a mass (such as kg) is wanted; this is a plain number"),
    ('"2 kg"', '"2 m"', 5, "bodies.AB.mass", '"2 m"', "a mass (such as kg) is wanted; this is a length"),
    ('"2 kg"', '"-2 kg"', 5, "bodies.AB.mass", '"-2 kg"', "it is -2 kg and must not be negative"),
    ("mass", "mas", 5, "bodies.AB.mas", "", 'did you mean "mass"?'),
    ('mass = "2 kg", ', "", 5, "bodies.AB.mass", "", "mass or weight is wanted"),
    ('length = "L"', 'length = "K"', 5, "bodies.AB.length", '"K"', 'unknown parameter "K"; there is g, L'),
    ('length = "L"', 'length = "1 metr"', 5, "bodies.AB.length", '"1 metr"', 'unknown unit "metr"'),
    ('L = "1 m"', 'L = "0 m"', 5, "bodies.AB.length", '"L"', "it is 0 m; a size must be positive"),
    ('rod = ["A", "B"]', 'rod = ["A"]', 5, "bodies.AB.rod", '["A"]', "the names of two ends are wanted"),
    ('["A", "B"], length', '"L", length', 5, "bodies.AB.rod", '"L"', 'such as rod = ["A", "B"], and length'),
    ("length", 'ends = ["A", "B"], length', 5, "bodies.AB.ends", "", 'did you mean "rod"?'),
    ("rod =", "beam =", 5, "bodies.AB.beam", "", 'did you mean "rod"?'),
    ("[0, 0] }", "[0, 0, 0] }", 5, "bodies.AB.at", "", "a vector is wanted: [x, y]"),
    # joints
    ("pin", "hinge", 10, "joints.A", "", '"hinge": did you mean "pin"?'),
    ('"AB.A", "ground"', '"AC.A", "ground"', 10, "joints.A.pin[0]", '"AC.A"', "there is AB, ground"),
    ('"AB.A", "ground"', '"AB.C", "ground"', 10, "joints.A.pin[0]", '"AB.C"', "it has A, B, G, center"),
    ('"AB.A", "ground"', '"A", "ground"', 10, "joints.A.pin[0]", '"A"', 'did you mean "AB.A"?'),
    ('["AB.A", "ground"]', '["AB.A"]', 10, "joints.A.pin", '["AB.A"]', "two partners are wanted"),
    ('["AB.A", "ground"]', '"AB.A"', 10, "joints.A.pin", '"AB.A"', "two partners are wanted"),
    (
        '[forces]', '[couplings.m]\nmotor = ["AB", "ground"]\nspeed = "60 rpm"\n[forces]', 15,
        "couplings.m.speed", "", 'did you mean "value"?',
    ),
    # contacts
    ("ground.floor", "ground.flor", 12, "contacts.c.touch[1]", '"ground.flor"', "it has stop, floor"),
    ('"ground.floor"', '"floor"', 12, "contacts.c.touch[1]", '"floor"', 'did you mean "ground.floor"?'),
    ("0.5 }", "1.5 }", 12, "contacts.c.restitution", "1.5", "it must lie between 0 and 1"),
    ("0.5 }", '"0.5 m" }', 12, "contacts.c.restitution", '"0.5 m"', "a plain number is wanted"),
    ("restitution", "e", 12, "contacts.c.e", "", 'did you mean "restitution"?'),
    (
        '"AB.B", "ground.floor"', '"AB", "ground.stop"', 12, "contacts.c.touch[0]", '"AB"',
        "the body alone touches only an endless line: did you mean AB.top or AB.bottom?",
    ),
    ("{ through = ", "{ trough = ", 8, "ground.lines.floor.trough", "", 'did you mean "through"?'),
    ('{ through = [0, "-2 m"] }', '[0, "-2 m"]', 8, "ground.lines.floor", '[0, "-2 m"]', "a table with"),
    # forces
    ('["3 N", 0]', '"3 N"', 14, "forces.F.value", '"3 N"', "a vector is wanted: [x, y]"),
    ('"3 N"', '"3 kg"', 14, "forces.F.value[0]", '"3 kg"', "a force (mass*length/time^2, such as N)"),
    ("force =", "push =", 14, "forces.F", "", '"push": did you mean "force"?'),
    # events, asks, the end
    ("angle <", "theta <", 16, "events.low", '"AB.theta < -60 deg"', 'did you mean "angle"?'),
    ('"AB.angle < -60 deg"', '"-60 deg"', 16, "events.low", '"-60 deg"', 'a condition is wanted: "A = B"'),
    ("< -60 deg", "<", 16, "events.low", '"AB.angle <"', "it ends where a number, a name"),
    ('at = "low"', 'at = "high"', 18, "ask.omega.at", '"high"', "there is low, end"),
    ('at = "low"', 'at = "c"', 18, "ask.omega.at", '"c"', 'events.NAME = "c strikes", then at = "NAME"'),
    ('"low" }', '"before c strikes" }', 18, "ask.omega.at", '"before c strikes"', 'then at = "before NAME"'),
    ('"AB.omega"', '"AB.v"', 18, "ask.omega", '"AB.v"', 'did you mean "velocity"?'),
    ('"AB.omega"', '"AB.qq"', 18, "ask.omega", '"AB.qq"', "quantities are x, y, position"),
    ('"AB.omega"', '"A.force on AB"', 18, "ask.omega", '"A.force on AB"', 'such as "A.force.norm on AB"'),
    ('"low" }', '"AB.angle = 1" }', 18, "ask.omega.at", '"AB.angle = 1"', "a condition gets a name: events."),
    ('"rad/s"', '"m"', 18, "ask.omega.unit", '"m"', "this is a length; the answer is an angular velocity"),
    ('of = "AB.omega", ', "", 18, "ask.omega", "", "amplitude, phase, events is wanted"),
    ('until = "t = 1 s"\n', "", None, "until", "", 'what ends the run is wanted, such as until = "t = 2 s"'),
    ("t = 1 s", "1 s", 1, "until", '"1 s"', 'write "t = 1 s"'),
    ("t = 1 s", "t = 1", 1, "until", '"t = 1"', "t is a time, 1 is a plain number; they cannot be compared"),
    # the file
    ("[joints]", "[joint]", 9, "joint", "", 'did you mean "joints"?'),
    ("[forces]", "[Forces]", 13, "Forces", "", 'did you mean "forces"?'),
    ("[bodies]", "[body]", 4, "body", "", 'did you mean "bodies"?'),
    ('L = "1 m"', 'L = "1 m', 3, "", "", "the quotation mark at the end of a text is missing"),
]  # fmt: skip


def test_the_scene_without_a_fault_runs() -> None:
    assert load_text(GOOD, file="new.toml").run().ok


@pytest.mark.parametrize(("old", "new", "line", "key", "value", "wanted"), FAULTS)
def test_a_fault_is_told_in_one_sentence(
    old: str, new: str, line: int | None, key: str, value: str, wanted: str
) -> None:
    assert old in GOOD
    with pytest.raises(SceneError) as caught:
        load_text(GOOD.replace(old, new, 1), file="new.toml").run()
    told = str(caught.value)
    place = "new.toml: " if line is None else f"new.toml:{line}:"
    assert told.startswith(place)
    assert f" {key} = {value}: " in told if value else f" {key}: " in told or not key
    assert wanted in told
    assert "\n" not in told
    for python in ("NoneType", "dict", "Input should", "object", "'", "Traceback"):
        assert python not in told.replace("body's", "").replace("one's", ""), python


def test_there_are_enough_of_them() -> None:
    """One for each of the thirty messages that a new user meets, and some more."""
    assert len({wanted for *_, wanted in FAULTS}) >= 30
