"""Friction that may be nothing, a guide at its dead centre, reactions that are not unique.

These scenes were once refused; they are numbered with those of test_found_contacts.py.
"""

from __future__ import annotations

import math
import random
from typing import Any

import pytest

import planemotion
from tests.mechanics.found_scenes import plate, ran
from tests.scenes import ROUTES, G, number
from tests.scenes.parts import beam_on_feet, rod_on_two_pins


# ---- 4: friction of nothing as a parameter ----
def test_4_friction_of_nothing_may_be_a_parameter() -> None:
    """100 smooth boxes, thrown from a height that keeps them above the floor."""
    rng = random.Random(4)
    for _ in range(100):
        size, start = (
            (rng.uniform(0.05, 0.5), rng.uniform(0.05, 0.5)),
            (rng.uniform(-2, 2), -rng.uniform(0.1, 2)),
        )
        tilt, slope = rng.choice([0, rng.uniform(-80, 80)]), rng.choice([0, rng.uniform(-40, 40)])
        more: dict[str, Any] = {"tilt": tilt, "slope": slope}
        e = rng.choice([0, rng.uniform(0, 1)])
        written = ran(plate(*size, 0, e, start, above=0.8, until="t = 0.5 s", **more))
        swept = ran(
            plate(
                *size, '"mu"', e, start, above=0.8, until="t = 0.5 s", more="[parameters]\nmu = 0\n", **more
            )
        )
        for key in ("x", "y", "vx", "vy", "omega"):
            assert swept[key] == pytest.approx(written[key], abs=1e-10)


# ---- 5: a slider-crank with friction in its guide ----
CRANK = """
until = "rest"
[parameters]
mu = 0.1
[ground]
lines = {{ guide = {{ through = [0, 0] }} }}
points = {{ O = [0, 0] }}
[bodies.crank]
rod = ["A", "B"]
length = "0.1 m"
mass = "0.1 kg"
at = {{ A = [0, 0] }}
angle = "{angle} deg"
[bodies.link]
rod = ["P", "Q"]
length = "0.3 m"
mass = "0.1 kg"
at = {{ P = ["{across} m", "0.0866025403784438647 m"] }}
angle = "~{link} deg"
[bodies.block]
mass = "5 kg"
at = ["{place!r} m", 0]
[joints]
a = {{ pin = ["ground.O", "crank.A"] }}
b = {{ pin = ["crank.B", "link.P"] }}
c = {{ pin = ["link.Q", "block"] }}
{guide}
[start]
crank.omega = "{omega} rad/s"
{start}
[events]
dead = "crank.turned = {turned} deg"
[ask]
time = {{ of = "t", at = "dead", unit = "s" }}
omega = {{ of = "crank.omega", at = "dead", unit = "rad/s" }}
end = {{ of = "crank.turned", unit = "deg" }}
"""
GUIDES = {
    "slider": 'd = { slider = ["block", "ground.guide"], friction = "mu" }',
    "contact": '[contacts]\nd = { touch = ["block", "ground.guide"], friction = "mu" }',
}


def crank(guide: str, mirror: int) -> str:
    lean = math.asin(math.sin(math.radians(60)) / 3)
    return CRANK.format(
        angle=60 if mirror > 0 else 120,
        across=mirror * 0.05,
        link=-math.degrees(lean) if mirror > 0 else 180 + math.degrees(lean),
        place=mirror * (0.05 + 0.3 * math.cos(lean)),
        guide=GUIDES[guide],
        start="block.velocity.y = 0" if guide == "contact" else "",
        omega=5 * mirror,
        turned=120.0001 * mirror,  # just behind it: at it the slip is zero, and which comes first is rounding
    )


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("guide", list(GUIDES))
@pytest.mark.parametrize("mirror", [1, -1])
def test_5_a_slider_crank_passes_its_dead_centre(mirror: int, guide: str, route: str) -> None:
    result = ran(crank(guide, mirror), route)
    assert result.time == pytest.approx(0.481153, abs=1e-6)
    assert result.omega == pytest.approx(mirror * 14.41, abs=5e-3)
    assert 60 + mirror * number(result.end) == pytest.approx(234.17, abs=5e-3)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("guide", list(GUIDES))
def test_5_so_it_does_where_friction_is_none_as_a_parameter(guide: str, route: str) -> None:
    """Without friction its energy stays, and at 180 degrees the block stands still."""
    text = crank(guide, 1).replace('until = "rest"', 'until = "dead"')
    result = planemotion.load_text(text).with_values({"solve.route": route}).run(mu=0)
    assert result.status == "ok", result.error
    assert result.omega == pytest.approx(speed_at_the_dead_centre(), rel=1e-6)


def speed_at_the_dead_centre() -> float:
    """T = J w^2 / 2 with the share of each body in the coordinate that is the crank's angle."""

    def inertia(angle: float) -> float:
        s, c = math.sin(angle), math.cos(angle)
        lean = math.asin(s / 3)  # of the link, downwards
        turn = -c / (3 * math.cos(lean))  # of the link by the crank
        block = -0.1 * s + 0.3 * math.sin(lean) * turn
        x, y = -0.1 * s + 0.15 * math.sin(lean) * turn, 0.1 * c + 0.15 * math.cos(lean) * turn
        return 0.1 * 0.1**2 / 3 + 5 * block**2 + 0.1 * (x * x + y * y + 0.3**2 / 12 * turn * turn)

    height = 0.1 * math.sin(math.radians(60))
    fall = 0.1 * G * (0.5 * height + 0.5 * height)  # of the mass centres of crank and link
    return math.sqrt((25 * inertia(math.radians(60)) + 2 * fall) / inertia(math.pi))


# ---- 6: reactions that are not unique ----
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("order", ["ABC", "BCA", "CAB", "CBA"])
@pytest.mark.parametrize("mirror", [1, -1])
def test_6_a_beam_on_three_smooth_feet(mirror: int, order: str, route: str) -> None:
    contacts = "\n".join(f'{x} = {{ touch = ["beam.{x}", "ground.floor"] }}' for x in order)
    text = beam_on_feet(contacts, (-2 * mirror, mirror, 2 * mirror))
    result = ran(text, route)
    for name in "ABC":
        assert result.asks[name].value is None
        assert "not unique" in result.asks[name].reason
    assert result["all"] == pytest.approx(98.1, rel=1e-12)
    assert result.moment == pytest.approx(0, abs=1e-9)
    least = ran(text + '[solve]\nshared = "least"\n', route)
    for name, share in zip("ABC", (11, 8, 7), strict=True):  # sums of 1, x and x^2: 3, 1, 9
        assert least[name] == pytest.approx(98.1 * share / 26, rel=1e-10)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(("mirror", "order"), [(1, "AB"), (1, "BA"), (-1, "AB"), (-1, "BA")])
def test_6_a_ladder_that_rubs_at_both_ends(mirror: int, order: str, route: str) -> None:
    """At rest its loads are not unique but for their sum."""
    lines = {
        "A": 'A = { touch = ["ladder.A", "ground.wall"], friction = 0.4 }',
        "B": 'B = { touch = ["ladder.B", "ground.floor"], friction = 0.5 }',
    }
    text = f"""
until = "t = 0.1 s"
[ground.lines]
floor = {{ through = [0, 0] }}
wall = {{ through = [0, 0], angle = "{-90 * mirror} deg" }}
[bodies.ladder]
rod = ["A", "B"]
length = "4 m"
mass = "10 kg"
angle = "{-60 if mirror > 0 else -120} deg"
at = {{ A = [0, "{4 * math.sin(math.pi / 3)!r} m"] }}
[contacts]
{lines[order[0]]}
{lines[order[1]]}
[ask]
A = "A.normal"
B = "B.normal"
up = "A.force.y on ladder + B.force.y on ladder"
across = "A.force.x on ladder + B.force.x on ladder"
"""
    result = ran(text, route)
    assert result.asks["A"].value is None
    assert result.asks["B"].value is None
    assert result.up == pytest.approx(98.1, rel=1e-11)
    assert result.across == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("order", ["AB", "BA"])
def test_6_a_rod_pinned_at_both_ends(order: str, route: str) -> None:
    lines = "\n".join(f'{x} = {{ pin = ["rod.{x}", "ground.{x}"] }}' for x in order)
    result = ran(rod_on_two_pins(lines), route)
    assert result.asks["Ax"].value is None
    assert result.Ay == pytest.approx(49.05, rel=1e-12)
    assert result.By == pytest.approx(49.05, rel=1e-12)
