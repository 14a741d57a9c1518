"""Huygens's pendulum: the bob on a cycloid takes the same time from anywhere, unlike that on a circle."""

from __future__ import annotations

import math

import pytest
from scipy.special import ellipk

import planemotion
from tests import STUDIES
from tests.scenes import ROUTES, G, number, within

STUDY = planemotion.load(STUDIES / "cycloid_pendulum.toml")


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("swing", [0.02, 0.3, 0.9, 1.3, 1.5])
def test_the_period_of_a_bob_on_a_cycloid_is_that_of_any_swing(swing: float, route: str) -> None:
    """2 pi sqrt(4 a / g), to ten digits; on the circle 4 sqrt(L / g) K(sin(swing / 2))."""
    asks = STUDY.run(**{"solve.route": route, "swing": f"{swing!r} rad"}).asks
    for key, exact in (
        ("period", 2 * math.pi / math.sqrt(G)),
        ("common_period", 4 / math.sqrt(G) * ellipk(math.sin(swing / 2) ** 2)),
    ):
        found = asks[key]
        assert number(found.value) == pytest.approx(exact, rel=within(route, ida=2e-9, others=1e-10))
        assert abs(number(found.value) - exact) <= 3 * number(found.error) + 1e-14
    # twice the weight along the cord at the lowest place from a swing of 90 degrees
    assert number(asks["most_load"].value) == pytest.approx(G * (1 + math.sin(swing) ** 2), rel=1e-8)
