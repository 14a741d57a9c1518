"""Curves of bodies that move: what must be kept is kept."""

# ruff: noqa: E501

from __future__ import annotations

import pytest

from tests.scenes import ROUTES, G, asked, on_route


@pytest.mark.parametrize("route", ROUTES)
def test_a_bowl_that_moves_keeps_energy_and_momentum(route: str) -> None:
    """A bead in a bowl on a smooth rail: what it slides with, what it strikes with, and the bowl."""
    result = on_route(
        """
        until = "t = 2 s"
        bodies.bowl = { mass = "3 kg", inertia = "1 kg*m^2", at = [0, 0], curves.inside = { x = "(1 m)*s", y = "(0.5 m)*s^2", from = -3, to = 3 } }
        bodies.bead = { mass = "1 kg", at = ["1 m", "0.9 m"] }
        ground.lines.rail = { through = [0, 0], angle = 0 }
        joints.rail = { slider = ["bowl", "ground.rail"], turning = false }
        contacts.c = { touch = ["bead", "bowl.inside"], restitution = 1 }
        events.hit = "c strikes"
        ask.E = { of = "energy.total", unit = "J" }
        ask.p = { of = "momentum.x", unit = "N*s" }
        ask.n = "hit.count"
        """,
        route,
    )
    assert asked(result, "n") > 2
    assert asked(result, "E") == pytest.approx(0.9 * G, rel=1e-9)
    assert asked(result, "p") == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("route", ROUTES)
def test_a_free_body_in_a_free_ring_keeps_what_must_be_kept(route: str) -> None:
    result = on_route(
        """
        plane = "horizontal"
        until = "t = 3 s"
        bodies.ring = { mass = "2 kg", inertia = "3 kg*m^2", at = [0, 0], curves.inside = { ellipse = ["2 m", "1 m"] } }
        bodies.disk = { disk = "0.3 m", mass = "1 kg", at = ["0.4 m", 0] }
        contacts.c = { touch = ["disk.rim", "ring.inside"], restitution = 1 }
        start.disk.velocity = ["1 m/s", "2 m/s"]
        start.ring.omega = "0.5 rad/s"
        events.hit = "c strikes"
        ask.E = { of = "energy.kinetic", unit = "J" }
        ask.H = { of = "angular_momentum", unit = "kg*m^2/s" }
        ask.n = "hit.count"
        """,
        route,
    )
    assert asked(result, "n") > 1
    assert asked(result, "E") == pytest.approx(2.5 + 0.375, rel=1e-9)
    assert asked(result, "H") == pytest.approx(0.8 + 1.5, rel=1e-9)
