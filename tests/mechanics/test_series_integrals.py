"""Integrals and means over all bounces of a ball, which no run follows to the last, beside closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import planemotion
from tests.stress.kinds.flights import BOUNCING, SERIES, G, series

ROUTES = ["auto", "rk", "ida"]


def scene(h: float, e: float, vx: float, until: str, accuracy: float, route: str) -> str:
    return f"""{BOUNCING.format(until=until, h=h, e=e, aside=vx)}
{SERIES}
[solve]
accuracy = {accuracy!r}
route = "{route}"
"""


def check(h: float, e: float, vx: float, after: float, accuracy: float, route: str) -> None:
    _, rest = series(h, e, vx, None)
    end = None if vx == 0 else float(f"{after * rest:.7g}")
    until = "b rests" if end is None else f"t = {end!r} s"
    result = planemotion.load_text(scene(h, e, vx, until, accuracy, route)).run()
    assert result.status == "ok"
    sizes = {"aside": (abs(vx) + 1) * rest**2, "pressed": G * rest}
    for name, value in series(h, e, vx, end)[0].items():
        told = result.asks[name].error
        assert isinstance(told, float)
        assert result[name] == pytest.approx(value, rel=2e-15, abs=10 * told + 1e-15 * sizes.get(name, 0)), (
            name
        )
        size = max(abs(value), sizes.get(name, 0))
        assert told <= (1e3 if route == "ida" else 1) * max(accuracy, 1e-11) * size, name


@pytest.mark.parametrize("route", ROUTES)
def test_what_is_left_of_a_series_is_in_its_integrals(route: str) -> None:
    rng = np.random.default_rng(20261130)
    for i in range(8 if route == "ida" else 25):
        for accuracy in (1e-4, 1e-6, 1e-8, 1e-10, 1e-12):
            check(
                float(f"{10 ** rng.uniform(-2, 2):.4g}"),
                float(f"{rng.uniform(0.03, 0.2 if i % 2 else 0.9):.4g}"),
                float(f"{rng.uniform(-3, 3):.4g}") if i % 3 else 0.0,
                rng.uniform(1.001, 1.3),
                accuracy,
                route,
            )
