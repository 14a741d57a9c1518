"""How scenes with several contacts are run: on all routes, in both orders, mirrored; a plate on corners."""

from __future__ import annotations

import itertools
import re

import planemotion
from tests.scenes import ROUTES

WAYS = list(itertools.product(ROUTES, (1, -1), (1, -1)))  # route, mirror image, order in the file
LAWS = ("newton", "poisson", "stronge")


def ran(text: str, route: str = "auto") -> planemotion.RunResult:
    """The same scene on another route; status ok."""
    result = planemotion.load_text(text).with_values({"solve.route": route}).run()
    assert result.status == "ok", (text, result.error)
    return result


def told(text: str, route: str = "auto") -> planemotion.RunResult:
    return planemotion.load_text(text).with_values({"solve.route": route}).run()


def struck(text: str, route: str = "auto") -> planemotion.RunResult:
    """What the blow at the start leaves; a route that goes on in time answers for the instant of it."""
    if route == "auto":
        return ran(text)
    head, asks = text.split("[ask]\n")
    at_start = re.sub(r'^(\w+) = (".*")$', r'\1 = { of = \2, at = "blow" }', asks, flags=re.MULTILINE)
    events = '[events]\nblow = { when = "A strikes", nth = 1 }\n[ask]\n'
    return ran(head.replace('until = "start"', 'until = "t = 1 ms"') + events + at_start, route)


def plate(
    width: float,
    height: float,
    friction: float | str,
    restitution: float,
    velocity: tuple[float, float],
    *,
    law: str = "newton",
    mirror: int = 1,
    order: int = 1,
    above: float = 0,
    tilt: float = 0,
    slope: float = 0,
    until: str = "start",
    more: str = "",
) -> str:
    """A plate of 1 kg, in degrees; its left corner (mirrored: its right one) is `above` the floor."""
    rest = f'friction = {friction}, restitution = {restitution}, law = "{law}"'
    feet = [f'{name} = {{ touch = ["k.{name}", "ground.floor"], {rest} }}' for name in "ABCD"[::order]]
    return f"""
until = "{until}"
{more}
[ground]
lines = {{ floor = {{ through = [0, 0], angle = "{mirror * slope} deg" }} }}
[bodies.k]
plate = ["{width} m", "{height} m"]
corners = ["A", "B", "C", "D"]
mass = "1 kg"
at = {{ {"A" if mirror > 0 else "B"} = [0, "{above} m"] }}
angle = "{mirror * (slope + tilt)} deg"
[contacts]
{chr(10).join(feet)}
[start]
k.velocity = ["{mirror * velocity[0]!r} m/s", "{velocity[1]!r} m/s"]
k.omega = 0
[ask]
x = "k.x"
y = "k.y"
vx = "k.velocity.x"
vy = "k.velocity.y"
omega = "k.omega"
a = "k.acceleration.norm"
alpha = "k.alpha"
lost = "energy.lost"
"""
