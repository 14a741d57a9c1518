"""The sign of a force lies along the force, as far as it is known: at the start, at an instant, in motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

import planemotion
from planemotion.animation.signs import SignSketch
from planemotion.examples import text_of
from planemotion.pen.symbols import Pen, Place
from planemotion.pictures import instants, scene
from tests.pictures.figures import texts

ROOM = (np.array([-1.0, -1.0]), np.array([1.0, 1.0]))
PUSHED = """
until = "t = 2 s"
plane = "horizontal"
bodies.P = { mass = "1 kg", at = [0, 0] }
forces.push = { force = "P", value = VALUE }
"""


def signs_of(start: scene.Start) -> dict[str, tuple[float, float] | None]:
    """Of each force the direction of its arrow; None if it is dotted."""
    sketch = _Arrows(start.drawing, start.poses, "m", ROOM, known=start.known)
    found = {}
    for name, force in start.data.forces.items():
        sketch.arrows.clear()
        force.draw(sketch, f"forces.{name}")
        [(tail, tip, dotted)] = sketch.arrows
        along = np.subtract(tip, tail) / math.dist(tip, tail)
        found[name] = None if dotted else (float(along[0]), float(along[1]))
    return found


class _Arrows(SignSketch):
    """Keeps what its pen is asked to draw as arrows, and whether they are dotted."""

    def canvas(self) -> tuple[Figure, Pen]:
        made, pen = super().canvas()
        self.arrows: list[tuple[Place, Place, bool]] = []
        setattr(pen, "arrow", self._arrow)  # noqa: B010 - a method
        return made, pen

    def _arrow(self, tail: Place, tip: Place, **look: Any) -> None:
        self.arrows.append((tail, tip, look["linestyle"] == ":"))


def at_start(text: str) -> Mapping[str, tuple[float, float] | None]:
    return signs_of(scene.start_of(planemotion.load_text(text)))


def test_drag_points_against_the_motion() -> None:
    """It was drawn upwards, dotted, at the start and at every instant."""
    thrown = planemotion.load_text(text_of("drag"))
    elevation = math.radians(35)
    against = (-math.cos(elevation), -math.sin(elevation))
    assert signs_of(scene.start_of(thrown))["drag"] == pytest.approx(against)
    motion = thrown.history("ball.velocity.x", "ball.velocity.y", every="1 s")
    x, y = (float(motion[f"ball.velocity.{part}"].sel(t=1.0)) for part in "xy")
    there = signs_of(instants.instant_of(thrown, "1 s"))["drag"]
    assert there == pytest.approx((-x / math.hypot(x, y), -y / math.hypot(x, y)))


def test_a_force_that_is_nothing_yet_lies_along_the_part_that_will_be() -> None:
    assert at_start(text_of("table"))["push"] == (1.0, 0.0)
    assert at_start(PUSHED.replace("VALUE", '[0, "(2 N/s)*t"]'))["push"] == (0.0, 1.0)
    turned = at_start(PUSHED.replace("VALUE", '{ polar = ["(2 N/s)*t", "30 deg"] }'))["push"]
    assert turned == pytest.approx((math.cos(math.pi / 6), 0.5))


def test_a_force_of_two_parts_that_the_motion_has_yet_to_tell_is_dotted() -> None:
    assert at_start(PUSHED.replace("VALUE", '["(2 N/s)*t", "(1 N/s)*t"]'))["push"] is None
    assert (
        at_start(PUSHED.replace("VALUE", '["-(1 kg/s)*P.velocity.x", "-(1 kg/s)*P.velocity.y"]'))["push"]
        is None
    )
    assert at_start(PUSHED.replace("VALUE", "[0, 0]"))["push"] is None


def test_at_an_instant_a_force_of_time_is_that_of_the_instant() -> None:
    swinging = planemotion.load_text(PUSHED.replace("VALUE", '["(1 N)*cos(pi*t/(1 s))", "(1 N/s)*t"]'))
    assert signs_of(scene.start_of(swinging))["push"] == (1.0, 0.0)
    assert signs_of(instants.instant_of(swinging, "1 s"))["push"] == pytest.approx(
        (-math.sqrt(0.5), math.sqrt(0.5))
    )


def test_the_rounding_of_places_is_no_size() -> None:
    """A sled that keeps to its track within 1e-17 m was drawn on axes of that size."""
    start = instants.instant_of(planemotion.load_text(text_of("table")), "0.1 s")
    figure = scene.figure(start)
    low, high = figure.axes[0].get_ylim()
    assert high - low > 0.5, "m"
    assert "e-" not in texts(figure)
