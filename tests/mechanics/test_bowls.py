"""Balls and disks that roll in elliptic and parabolic bowls, beside an integration of their own."""

# ruff: noqa: E501

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.mechanics.curve_scenes import ROLLS
from tests.scenes import ROUTES, G, asked, close, number, on_route


@dataclass(frozen=True)
class Bowl:
    """An ellipse about the origin, or a parabola; the free side is on its left as s grows."""

    a: float
    b: float
    is_round: bool

    def at(self, s: float) -> np.ndarray:
        if self.is_round:
            return np.array([self.a * math.cos(s), self.b * math.sin(s)])
        return np.array([s, s * s / (4 * self.a)])

    def rates(self, s: float) -> tuple[float, np.ndarray, float]:
        """The length by s, the tangent, the curvature."""
        if self.is_round:
            first, second = (-self.a * math.sin(s), self.b * math.cos(s)), -self.at(s)
        else:
            first, second = (1, s / (2 * self.a)), np.array([0, 1 / (2 * self.a)])
        size = math.hypot(*first)
        return size, np.array(first) / size, (first[0] * second[1] - first[1] * second[0]) / size**3

    @property
    def written(self) -> str:
        if self.is_round:
            return f'{{ ellipse = ["{self.a!r} m", "{self.b!r} m"] }}'
        return f'{{ parabola = "{self.a!r} m", from = "-6 m", to = "6 m" }}'


def rolled(
    bowl: Bowl, radius: float, share: float, start: tuple[float, float], end: float
) -> tuple[np.ndarray, float]:
    """(s, speed of the centre) at the end, and the load for each kg; `share`: inertia over m r^2."""

    def rate(_: float, y: np.ndarray) -> list[float]:
        size, along, bend = bowl.rates(y[0])
        return [y[1] / (1 - radius * bend) / size, -G / (1 + share) * along[1]]

    y = solve_ivp(rate, (0, end), start, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    _, along, bend = bowl.rates(y[0])
    return y, G * along[0] + y[1] ** 2 * bend / (1 - radius * bend)


@pytest.mark.parametrize("how", sorted(ROLLS))
@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(6))
def test_a_ball_rolls_in_a_bowl_as_integrated(seed: int, route: str, how: str) -> None:
    """u' = -g t_y / (1 + I/(m r^2)), the centre goes (1 - r b) along the bowl; N/m = g t_x + u^2 b/(1 - r b)."""
    rng = np.random.default_rng(seed)
    bowl = Bowl(float(rng.uniform(0.8, 2)), float(rng.uniform(0.7, 1.2)), seed % 2 == 0)
    begin = -math.pi / 2 + float(rng.uniform(0.3, 1)) if bowl.is_round else float(rng.uniform(0.5, 1.5))
    radius, speed, end = float(rng.uniform(0.05, 0.15)), float(rng.uniform(-1, 0.5)), 2.0
    shape, share = ("sphere", 0.4) if seed % 3 else ("disk", 0.5)
    _, along, _ = bowl.rates(begin)
    x, y = (bowl.at(begin) + radius * np.array([-along[1], along[0]])).tolist()
    vx, vy = (speed * along).tolist()
    result = on_route(
        f"""
        until = "t = {end} s"
        ground.curves.bowl = {bowl.written}
        bodies.p = {{ {shape} = "{radius!r} m", mass = "2 kg", at = ["{x!r} m", "{y!r} m"] }}
        {ROLLS[how]}
        start.p.velocity = ["{vx!r} m/s", "{vy!r} m/s"]
        start.p.omega = "{-speed / radius!r} rad/s"
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.y = {{ of = "p.y", unit = "m" }}
        ask.w = {{ of = "p.omega", unit = "rad/s" }}
        ask.N = {{ of = "c.normal", unit = "N" }}
        """,
        route,
    )
    (s, u), load = rolled(bowl, radius, share, (begin, speed), end)
    _, along, _ = bowl.rates(s)
    exact = bowl.at(s) + radius * np.array([-along[1], along[0]])
    near = 2 * close(route)
    assert [asked(result, "x"), asked(result, "y")] == pytest.approx(exact.tolist(), abs=near)
    assert asked(result, "w") * radius == pytest.approx(-u, abs=2 * near)
    assert asked(result, "N") == pytest.approx(2 * load, rel=10 * near)
    for ask, value in (("x", exact[0]), ("y", exact[1]), ("w", -u / radius), ("N", 2 * load)):
        assert abs(asked(result, ask) - value) <= 3 * number(result.asks[ask].error) + 1e-11
