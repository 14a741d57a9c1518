"""Edges and corners of plates and rods: where they begin, end and face."""

from __future__ import annotations

import math

import pytest

from tests.scenes import ROUTES, G
from tests.scenes import answers_at_ties as run
from tests.scenes.parts import plate

CRATE = (
    'until = "rear opens"\n'
    + plate("crate", "w", "0.4 m", "7 kg", at={"A": ["0.3 m", "1 m"]})
    + """
[parameters]
w = "0.6 m"
v = "1.5 m/s"
[ground]
lines = { table = { from = [0, "1 m"], to = ["2 m", "1 m"] } }
points = { edge = ["2 m", "1 m"] }
[contacts]
rear = { touch = ["crate.A", "ground.table"] }
front = { touch = ["crate.B", "ground.table"] }
under = { touch = ["ground.edge", "crate.bottom"] }
[start]
crate.velocity.x = "v"
[events]
off = "front opens"
hit = "under strikes"
[ask]
t_off = { of = "t", at = "off" }
t = "t"
omega = "crate.omega"
normal_rear = { of = "rear.normal", at = "off" }
share = { of = "under.normal", at = { each = "crate.x", values = ["1.85 m"] } }
strikes = "hit.count"
"""
)


@pytest.mark.parametrize("route", ROUTES)
def test_a_crate_is_pushed_over_the_end_of_a_table(route: str) -> None:
    """The front corner runs off, the table's end carries on; past it the crate tips about that end."""
    values = run(CRATE, route)
    assert values["t_off"] == pytest.approx((2 - 0.9) / 1.5, rel=1e-8)
    assert values["t"] == pytest.approx((2 - 0.6) / 1.5, rel=1e-8)
    assert values["omega"] == pytest.approx(0, abs=1e-8)
    assert values["normal_rear"] == pytest.approx(0.5 * 7 * G, rel=1e-8)
    assert values["share"] == [pytest.approx(7 * G * 0.3 / 0.45, rel=1e-7)]
    assert values["strikes"] == 0


def test_corners_are_a_set_and_fall_off_one_by_one() -> None:
    values = run(
        CRATE.replace('rear = { touch = ["crate.A", "ground.table"] }', "")
        .replace(
            'front = { touch = ["crate.B", "ground.table"] }',
            'feet = { touch = ["crate.corners", "ground.table"] }',
        )
        .replace("rear opens", "off 2")
        .replace("front opens", "feet opens")
        .replace("rear.normal", "feet.normal")
    )
    assert values["t_off"] == pytest.approx((2 - 0.9) / 1.5, rel=1e-8)
    assert values["t"] == pytest.approx((2 - 0.6) / 1.5, rel=1e-8)


@pytest.mark.parametrize(("edge", "angle"), [("top", 0), ("left", -90), ("bottom", 180), ("right", 90)])
@pytest.mark.parametrize("offset", [-0.31, -0.29, 0.29, 0.31])
def test_every_edge_of_a_plate_faces_outward_and_ends_at_its_corners(
    edge: str, angle: float, offset: float
) -> None:
    """A plate turned so that the edge is on top: what falls beside it falls past."""
    size = (0.6, 0.2) if edge in ("top", "bottom") else (0.2, 0.6)
    values = run(
        f"""
until = ["plate strikes", "floor strikes"]
[ground]
lines = {{ floor = {{ through = [0, "-3 m"] }} }}
[bodies.slab]
plate = ["{size[0]} m", "{size[1]} m"]
mass = "5 kg"
at = [0, 0]
angle = "{angle} deg"
[bodies.P]
mass = "1 kg"
at = ["{offset} m", "1 m"]
[joints]
held = {{ weld = ["slab", "ground"] }}
[contacts]
plate = {{ touch = ["P", "slab.{edge}"] }}
floor = {{ touch = ["P", "ground.floor"] }}
[ask]
y = "P.y"
"""
    )
    assert values["y"] == pytest.approx(0.1 if abs(offset) < 0.3 else -3, abs=1e-9)


@pytest.mark.parametrize("side", ["top", "bottom"])
def test_a_ball_rolls_over_the_end_of_a_rod(side: str) -> None:
    """Round the corner without slip: (10 + 7 v^2/gR)/17 = cos of where it leaves."""
    angle = 0 if side == "top" else 180
    values = run(
        f"""
until = "roll opens"
[parameters]
r = "0.1 m"
v = "0.5 m/s"
[bodies]
AB = {{ rod = ["A", "B"], length = "1 m", mass = "2 kg", at = [0, 0], angle = "{angle} deg" }}
ball = {{ sphere = "r", mass = "1 kg", at = ["0.2 m", "r"] }}
[joints]
held = {{ weld = ["AB", "ground"] }}
[contacts]
roll = {{ touch = ["ball.rim", "AB.{side}"], friction = "rough" }}
[start]
ball.velocity = ["v", 0]
ball.omega = "-v/r"
[events]
struck = "roll strikes"
[ask]
x = "ball.x"
y = "ball.y"
strikes = "struck.count"
"""
    )
    cosine = (10 + 7 * 0.25 / (G * 0.1)) / 17
    assert values["y"] == pytest.approx(0.1 * cosine, rel=1e-8)
    assert values["x"] == pytest.approx(0.5 + 0.1 * math.sqrt(1 - cosine**2), rel=1e-8)
    assert values["strikes"] == 0


# ---- blows ----
