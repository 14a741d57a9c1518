"""A note where the order of blows matters and the scene did not choose one."""

from __future__ import annotations

import itertools
import random

import pytest

import planemotion
from tests.mechanics.test_crates import crate

CHOOSE = 'choose by solve.impacts = "simultaneous" or "sequential"'


def balls(names: str, order: str, restitution: float = 1) -> str:
    """Balls from left to right; the first one comes with 1 m/s; contacts in the order given."""
    bodies = "\n".join(
        f'{name} = {{ sphere = "10 mm", mass = "1 kg", at = ["{20 * i} mm", "10 mm"] }}'
        for i, name in enumerate(names)
    )
    pairs = dict(zip(order, itertools.pairwise(f"{name}.rim" for name in names), strict=True))
    contacts = "\n".join(
        f"{name} = {{ touch = {list(pairs[name])}, restitution = {restitution} }}" for name in sorted(pairs)
    )
    return f"""
plane = "horizontal"
until = "t = 1 ms"
[bodies]
{bodies}
[contacts]
{contacts}
[start]
{names[0]}.velocity.x = "1 m/s"
[ask]
v = "{names[-1]}.velocity.x"
"""


@pytest.mark.parametrize("order", ["pq", "qp"])
def test_a_cradle_is_told(order: str) -> None:
    scene = planemotion.load_text(balls("ABC", order))
    result = scene.run()
    assert result.counts["ordered_blows"] == 1
    struck = f"contacts.{order[0]} and contacts.{order[1]}"
    assert result.notes == (
        f"a blow of several contacts (at t = 0 s of {struck}) was taken together; one by one it leaves "
        f"another motion: {CHOOSE}",
    )
    for chosen in ("simultaneous", "sequential"):
        other = scene.solve(impacts=chosen).run()
        assert other.counts["ordered_blows"] == 0
        assert other.notes == ()


def test_what_agrees_is_not_told() -> None:
    """Two balls alone, and three without restitution."""
    for text in (balls("AB", "p"), balls("ABC", "pq", 0)):
        result = planemotion.load_text(text).run()
        assert result.counts["jumps"] == 1
        assert result.notes == ()


def two_drops(law: str) -> str:
    """Two rods of their own that land at one instant on one end each."""
    return f"""
until = "start"
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
[bodies]
one = {{ rod = ["A", "B"], length = "1 m", mass = "1 kg", at = {{ A = [0, 0] }}, angle = "40 deg" }}
two = {{ rod = ["A", "B"], length = "1 m", mass = "2 kg", at = {{ A = ["3 m", 0] }}, angle = "70 deg" }}
[contacts]
a = {{ touch = ["one.A", "ground.floor"], friction = 0.3, restitution = 0.5, law = "{law}" }}
b = {{ touch = ["two.A", "ground.floor"], friction = 0.2, restitution = 0.7, law = "{law}" }}
[start]
one.velocity = ["1 m/s", "-2 m/s"]
one.omega = 0
two.velocity = ["-1 m/s", "-3 m/s"]
two.omega = 0
[ask]
v = "one.omega"
"""


@pytest.mark.parametrize("law", ["newton", "poisson", "stronge"])
def test_independent_blows_at_once_are_not_told(law: str) -> None:
    result = planemotion.load_text(two_drops(law)).run()
    assert result.counts["jumps"] == 1
    assert result.counts["ordered_blows"] == 0


def test_a_crate_that_falls_flat_is_told() -> None:
    result = planemotion.load_text(crate(0.3, 0, (0.5, -1, 0))).run()
    assert result.counts["ordered_blows"] == 1
    assert "contacts.feet[0] and contacts.feet[1]" in result.notes[0]


def test_mirror_images_tell_the_same() -> None:
    """Crates thrown on a floor, and their mirror images: the first blow is the same."""
    choose = random.Random(6)
    told = 0
    for _ in range(40):
        mu, e = choose.choice([0, 0.2, 0.6]), choose.choice([0, 0.3, 0.7])
        start = (choose.uniform(-1, 1), choose.uniform(-3, -1), choose.choice([0, choose.uniform(-1, 1)]))
        one, other = (
            planemotion.load_text(
                crate(
                    mu,
                    e,
                    (sign * start[0], start[1], sign * start[2]),
                    place=1,
                    until="t = 1.5 s",
                )
            ).run()
            for sign in (1, -1)
        )
        told += one.counts["ordered_blows"] > 0
        times = [
            note.split("at t = ")[1].split()[0]
            for result in (one, other)
            for note in result.notes
            if "together" in note
        ]
        assert times[:1] == times[1:]
    assert told > 10
