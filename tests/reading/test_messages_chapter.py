"""Scenes of the chapter, broken on purpose."""

from __future__ import annotations

import re

import pytest

from planemotion import PlanemotionError, load_text
from tests import CHAPTER


def said_of(text: str) -> str:
    """What a scene that does not run says: as an exception, or as the error of its result."""
    try:
        return load_text(text, file="x.toml").run().error or ""
    except PlanemotionError as error:
        return str(error)


# Scenes of the chapter, broken: what is replaced by what, and what is said of it.
BROKEN = [
    (
        "17-C5",
        'D = { slider = ["BD.D", "ground.level"] }',
        'D = { rolling = ["BD.D", "ground.level"] }',
        'joints.D.rolling[0] = "BD.D": BD.D is a point; a circle or curve is wanted',
    ),
    ("17-C5", '"BD.B"]', '"BE.B"]', 'joints.B.pin[1] = "BE.B": unknown body "BE"; there is AB, BD, ground'),
    (
        "17-C5",
        'L = "30 in"',
        'L = "30 lb"',
        'bodies.AB.length = "L": a length (such as m) is wanted; this is a force',
    ),
    (
        "17-086",
        'm_disk = "4 kg"',
        'm_disk = "-4 kg"',
        'bodies.disk.mass = "m_disk": it is -4 kg and must not be',
    ),
    ("17-086", ', mass = "m_disk"', "", "bodies.disk.mass: mass or weight is wanted"),
    ("17-086", '"90 mm"', '"90 mmm"', 'unknown unit "mmm" (did you mean "mm"?)'),
    (
        "17-042",
        'nudge = "BD.D.velocity.x < 0"',
        'AB.omega = "2 rad/s"\nBD.omega = "5 rad/s"',
        "start.AB.omega: 2 rad/s is given, but the other start values and the joints give 0; leave one",
    ),
    (
        "17-042",
        'nudge = "BD.D.velocity.x < 0"',
        "",
        "everything is at rest from the start and stays: give a velocity",
    ),
    ("17-042", '[0, "-L"]', '[0, "-3*L"]', "joints.D is open by 1.28 m (allowed"),
    ("17-079", "edge_on = true", 'edge_on = "yes"', 'bodies.disk.edge_on = "yes": true or false is wanted'),
    (
        "17-079",
        'W_yoke = "1.5 lb"',
        'W_yoke = "-1.5 lb"',
        "it is -0.00394745 kg*m^2 and must not be negative",
    ),
    (
        "17-106",
        "restitution = 1 }",
        "restitution = 1.5 }",
        "contacts.A.restitution = 1.5: it must lie between 0 and 1",
    ),
    (
        "17-106",
        '"A_strikes 2"',
        '"A_strikes 2.5"',
        'until = "A_strikes 2.5": an operator or the end is wanted',
    ),
    (
        "17-076",
        'L_rod = "8 in"',
        'L_rod = "9 in"',
        "couplings.mesh_A: the pitch circles are drawn 0.0127 m from",
    ),
    ("17-076", "= omega_rod", "= 100*omega_rod", "is not met with M from 0 ft*lb to 10 ft*lb"),
    ("17-076", "vary = { M", "vary = { N", 'find.vary.N: unknown parameter "N"; there is g, W_gear'),
    ("17-138", "AB.axis on AB", "AB.axis on AC", "B acts on AB and ground, not on AC"),
    (
        "17-138",
        '"AB.omega < 0"',
        '"AB.omega"',
        'start.nudge = "AB.omega": a side is wanted: a velocity < 0 or > 0',
    ),
    ("17-SP04", '"k_spring"', '"-k_spring"', "it is -315228 N/m and must not be negative"),
    ("17-SP04", '"push"', '"pushes"', 'forces.spring.only = "pushes": "push" or "pull" is wanted'),
    (
        "17-SP04",
        '["rod.A", "ground.S"]',
        '["rod.A"]',
        'forces.spring.spring = ["rod.A"]: two partners are wanted',
    ),
    ("17-123", "turning = false", "turning = 0", "joints.floor.turning = 0: true or false is wanted"),
    (
        "17-123",
        '"before blow"',
        '"before blows"',
        'unknown instant "blows"; there is blow, end (did you mean',
    ),
    ("17-123", 'of = "CD.velocity.x"', 'of = "CD.velocity"', "a part is wanted: x, y, norm, angle, or along"),
    (
        "17-119",
        '"crate.omega > 0"',
        '"crate.omega >"',
        "it ends where a number, a name or a parenthesis is wanted",
    ),
    (
        "17-119",
        '"B strikes"',
        '"E strikes"',
        'events.strike = "E strikes": unknown contact "E"; there is A, B',
    ),
    ("17-119", '"D", "C"]', '"D"]', 'bodies.crate.corners = ["A", "B", "D"]: four names are wanted'),
]


@pytest.mark.parametrize(("stem", "old", "new", "expected"), BROKEN)
def test_scenes_of_the_chapter_broken_on_purpose(stem: str, old: str, new: str, expected: str) -> None:
    text = (CHAPTER / f"{stem}.toml").read_text(encoding="utf-8")
    assert old in text
    said = said_of(text.replace(old, new, 1))
    assert re.match(r"x\.toml(:\d+:\d+)?: ", said)
    assert expected in said
