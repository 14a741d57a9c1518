"""Two contacts struck by turns without a loss: blows passed over beside the same run blow by blow."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import pytest

import planemotion
from planemotion.engine.result import RunResult

END = """
[events]
knock = "wall strikes"
clack = "meet strikes"
either = ["wall strikes", "meet strikes"]
[solve]
estimate = ESTIMATE
max_events = 10_000_000
max_steps = 100_000_000
[ask]
knocks = "knock.count"
clacks = "clack.count"
all = "either.count"
last = { of = "clack.time", unit = "s" }
x = { of = "light.x", unit = "m" }
y = { of = "light.y", unit = "m" }
vx = { of = "light.velocity.x", unit = "m/s" }
vy = { of = "light.velocity.y", unit = "m/s" }
"""
#: An extreme is watched all the way: no blow can be passed over.
WATCHED = 'fastest = { max = "light.speed", unit = "m/s" }\n'

BLOCKS = """
until = "t = 30 s"
plane = "horizontal"
[ground]
lines = { wall = { through = [0, 0], angle = "WALL deg" }, track = { through = [0, 0], angle = 0 } }
[bodies]
light = { sphere = "0.1 m", mass = "1 kg", at = ["SIGN*(AT m)", 0] }
heavy = { sphere = "0.2 m", mass = "RATIO kg", at = ["SIGN*(FAR m)", 0] }
GUIDES
[contacts]
wall = { touch = ["light.rim", "ground.wall"], restitution = 1 }
meet = { touch = ["light.rim", "heavy.rim"], restitution = 1, friction = 0 }
[start]
light = { velocity = ["SIGN*(SLOW m/s)", 0], omega = "SPIN rad/s" }
heavy = { velocity = ["SIGN*(-1 m/s)", 0], omega = 0 }
"""
GUIDES = """[joints]
a = { slider = ["light", "ground.track"] }
b = { slider = ["heavy", "ground.track"] }"""

CORNER = """
until = "t = 30 s"
plane = "horizontal"
[ground]
lines = { wall = { through = [0, 0], angle = "TILT deg" }, other = { through = [0, 0], angle = "OTHER deg" } }
[bodies]
light = { disk = "0.1 m", mass = "1 kg", at = ["AT_X m", "AT_Y m"] }
[contacts]
wall = { touch = ["light.rim", "ground.wall"], restitution = 1 }
meet = { touch = ["light.rim", "ground.other"], restitution = 1 }
[start]
light = { velocity = ["BY_X m/s", "BY_Y m/s"], omega = "SPIN rad/s" }
"""


def filled(text: str, **numbers: object) -> str:
    for name, value in numbers.items():
        text = text.replace(name, str(value))
    return text


def value(result: RunResult, name: str) -> float:
    found = result[name]
    assert isinstance(found, float), name
    return found


def blocks(chosen: random.Random) -> str:
    """A light sphere between a heavy one and a wall; on guides, which may hold their weights, or free."""
    sign, guides = chosen.choice((1, -1)), chosen.choice((GUIDES, ""))
    weighs = bool(guides) and chosen.choice((True, False))
    return filled(
        BLOCKS.replace('plane = "horizontal"\n', "" if weighs else 'plane = "horizontal"\n'),
        WALL=-90 if sign > 0 else 90,
        SIGN=sign,
        RATIO=10 ** chosen.uniform(2, 6),
        AT=chosen.uniform(0.2, 2),
        FAR=chosen.uniform(2.5, 4),
        SLOW=chosen.uniform(-0.5, 0.5),
        SPIN=chosen.choice((0, 3)),
        GUIDES=guides,
    )


def corner(chosen: random.Random) -> str:
    """A disk between two lines that meet at a small angle, or at none."""
    turn, between = math.radians(chosen.uniform(0, 360)), math.radians(chosen.choice((0.05, 0.5, 3)))
    along, off = chosen.uniform(3, 5) / math.sin(between), chosen.uniform(1, 1.5)
    speed, off_speed = chosen.uniform(5, 20) / math.sin(between), chosen.uniform(-1, 1)

    def turned(x: float, y: float) -> tuple[float, float]:
        return x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)

    (x, y), (vx, vy) = turned(along, off), turned(-speed, off_speed)
    return filled(
        CORNER,
        TILT=math.degrees(turn),
        OTHER=math.degrees(turn + between) + 180,
        AT_X=x,
        AT_Y=y,
        BY_X=vx,
        BY_Y=vy,
        SPIN=chosen.choice((0, 2)),
    )


def both(scene: str, estimate: bool = False) -> tuple[RunResult, RunResult]:
    text = scene + END.replace("ESTIMATE", str(estimate).lower())
    return planemotion.load_text(text).run(), planemotion.load_text(text + WATCHED).run()


@pytest.mark.parametrize("make", [blocks, corner])
@pytest.mark.parametrize("seed", range(40))
def test_what_is_passed_over_is_as_blow_by_blow(make: Callable[[random.Random], str], seed: int) -> None:
    passed, followed = both(make(random.Random(seed)))
    assert passed.status == followed.status == "ok"
    for name in ("knocks", "clacks", "all"):
        assert value(passed, name) == value(followed, name), name
    if value(passed, "all") > 60:
        assert passed.counts["jumps"] < 0.5 * followed.counts["jumps"]
    fastest = value(followed, "fastest")
    for name in ("x", "y", "last"):
        assert value(passed, name) == pytest.approx(value(followed, name), abs=1e-9 * max(1, fastest))
    for name in ("vx", "vy"):
        assert value(passed, name) == pytest.approx(value(followed, name), abs=1e-9 * fastest)


STRIP = CORNER.replace('through = [0, 0], angle = "OTHER', 'through = ["FAR m", "UP m"], angle = "OTHER')


def test_a_ball_between_parallel_walls() -> None:
    turn = 0.4
    scene = filled(
        STRIP,
        TILT=math.degrees(turn),
        OTHER=math.degrees(turn) + 180,
        FAR=-math.sin(turn),
        UP=math.cos(turn),
        AT_X=-0.5 * math.sin(turn),
        AT_Y=0.5 * math.cos(turn),
        BY_X=0.3 * math.cos(turn) - 40 * math.sin(turn),
        BY_Y=0.3 * math.sin(turn) + 40 * math.cos(turn),
        SPIN=1,
    )
    passed, followed = both(scene)
    assert value(passed, "all") == value(followed, "all") == 1500
    assert passed.counts["jumps"] < 100
    for name in ("x", "y", "vx", "vy", "last"):
        assert value(passed, name) == pytest.approx(value(followed, name), abs=1e-9)


PI = filled(
    BLOCKS.replace('"t = 30 s"', "UNTIL"), WALL=-90, SIGN=1, RATIO=1e6, AT=1, FAR=2, SLOW=0, SPIN=0, GUIDES=""
)


@pytest.mark.parametrize(
    ("until", "event", "ask"),
    [
        ('"late"', 'late = { when = "wall strikes", nth = 1001 }', ""),
        ('"late"', 'late = { when = ["meet strikes", "wall strikes"], nth = 2001 }', ""),
        ('"t = 1.7 s"', "", ""),
        ('"t = 30 s"', "", 'at = { of = "heavy.velocity.x", at = "clack 800", unit = "m/s" }'),
        ('"t = 30 s"', "", 'at = { of = "light.x", at = "either 2500", unit = "m" }'),
        ('"t = 30 s"', "", 'at = { of = "heavy.velocity.x", at = "before knock 41", unit = "m/s" }'),
        ('"t = 30 s"', 'late = "t = 1.69 s"', 'at = { of = "heavy.x", at = "late", unit = "m" }'),
    ],
)
def test_what_is_waited_for_is_not_passed_over(until: str, event: str, ask: str) -> None:
    end = END.replace("ESTIMATE", "true").replace("[solve]", event + "\n[solve]")
    text = PI.replace("UNTIL", until) + end + ask + "\n"
    passed = planemotion.load_text(text).run()
    followed = planemotion.load_text(text + WATCHED).run()
    assert passed.status == followed.status == "ok"
    assert value(passed, "all") == value(followed, "all")
    assert passed.counts["jumps"] < 0.5 * followed.counts["jumps"]
    for name in passed.asks:
        assert value(passed, name) == pytest.approx(value(followed, name), rel=1e-9, abs=1e-8), name


def test_what_is_in_the_way_is_struck() -> None:
    """A third body meets the heavy one in the midst of the blows."""
    third = 'third = { sphere = "0.1 m", mass = "100 kg", at = ["5.498 m", 0] }'
    other = 'stop = { touch = ["heavy.rim", "third.rim"], restitution = 1 }\n'
    text = PI.replace("UNTIL", '"bump"').replace("[contacts]", "[contacts]\n" + other)
    text = text.replace("heavy = { sphere", third + "\nheavy = { sphere", 1)
    text = text.replace(
        "heavy = { velocity", 'third = { velocity = ["-3 m/s", 0], omega = 0 }\nheavy = { velocity'
    )
    end = END.replace("ESTIMATE", "false").replace("[solve]", 'bump = "stop strikes"\n[solve]')
    passed = planemotion.load_text(text + end).run()
    followed = planemotion.load_text(text + end + WATCHED).run()
    assert passed.status == followed.status == "ok"
    assert passed.counts["jumps"] < followed.counts["jumps"]
    assert 100 < value(passed, "all") == value(followed, "all") < 1500
    assert value(passed, "last") == pytest.approx(value(followed, "last"), abs=1e-12)
    assert value(passed, "vx") == pytest.approx(value(followed, "vx"), abs=1e-8)


@pytest.mark.parametrize("seed", range(6))
def test_errors_hold(seed: int) -> None:
    passed, _ = both(blocks(random.Random(seed)), estimate=True)
    followed, _ = both(blocks(random.Random(seed)))
    assert passed.status == "ok"
    for name in ("x", "vx", "last"):
        error = passed.asks[name].error
        assert isinstance(error, float)
        assert abs(value(passed, name) - value(followed, name)) <= 10 * error + 1e-13, name
