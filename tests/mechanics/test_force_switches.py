"""Forces at their switches: thin air, thin regions, motions that a force turns back at once, roots and powers
that begin at zero; random draws beside closed forms, on each route."""

from __future__ import annotations

import math

import numpy as np
import pytest

from planemotion import SimulationError, load_text
from tests.scenes import ROUTES, G, answers, number
from tests.stress.kinds.flights import DRAGS, THROWN
from tests.stress.kinds.forces import DEPTHS, PRESSED, REGION, pressed


def close(text: str, route: str, true: dict[str, float], rel: float = 1e-8) -> None:
    found = answers(text, route)
    for key, value in true.items():
        assert number(found[key]) == pytest.approx(value, rel=rel), (key, text)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("law", DRAGS)
def test_thrown_fast_and_falling_back(law: str, route: str) -> None:
    """It falls back with v/sqrt(1 + v^2/u^2), u = sqrt(m g/c): however fast, at the top the drag turns."""
    rng = np.random.default_rng(5)
    for _ in range(8):
        c, ratio = 10 ** rng.uniform(-2, 1), 10 ** rng.uniform(-1, 1.6)
        speed = ratio * math.sqrt(G / c)
        text = THROWN.format(c=c, law=law, speed=speed)
        text += 'ask = { v = "b.velocity.y", y = { max = "b.y" } }\n'
        true = {"v": -speed / math.sqrt(1 + ratio**2), "y": math.log1p(ratio**2) / (2 * c)}
        close(text, route, true, 1e-7)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(3))
def test_a_thin_region_does_its_work(seed: int, route: str) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(10):
        end = 1 + 10 ** rng.uniform(-7 if route == "ida" else -10, -1)
        width, speed, gain = end - 1, 10 ** rng.uniform(-1, 3), rng.uniform(-0.7, 3)
        text = REGION.format(
            time=2.5 / speed,
            speed=speed,
            force=gain * speed**2 / 2 / width,
            where=f"(b.x > (1 m))*(b.x < ({end!r} m))",
        )
        close(text, route, {"v": speed * math.sqrt(1 + gain)}, 1e-7 + 1e-15 / width)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(3))
def test_a_force_that_turns_a_body_back_at_once(seed: int, route: str) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(10):
        depth, speed = 10 ** rng.uniform(-7 if route == "ida" else -11, -1), 10 ** rng.uniform(-1, 2)
        text = REGION.format(
            time=2.5 / speed, speed=speed, force=-(speed**2) / 2 / depth, where="(b.x > (1 m))"
        )
        close(text, route, {"v": -speed}, 1e-7 + 1e-15 / depth)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("width", [1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 1e-13])
def test_a_table_that_is_nearly_a_step(width: float, route: str) -> None:
    """Energy tells the speed at 4 m: the ramp from 0 to 2 N counts half."""
    knot = 1 + width
    text = f"""
    until = "b.x = 4 m"
    plane = "horizontal"
    tables.f = {{ at = ["0 m", "1 m", "{knot!r} m", "9 m"], value = ["0 N", "0 N", "2 N", "2 N"] }}
    bodies.b = {{ mass = "1 kg", at = [0, 0] }}
    start.b.velocity = ["1 m/s", 0]
    forces.d = {{ force = "b", value = ["f(b.x)", 0] }}
    ask.v = "b.velocity.x"
    """
    close(text, route, {"v": math.sqrt(1 + 2 * ((knot - 1) + 2 * (4 - knot)))}, 1e-9)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("power", [0.5, 1.25, 1.5, 2, 2.5, 3.5])
def test_a_power_of_the_depth(power: float, route: str) -> None:
    """m v^2/2 = k d^(p+1)/(p+1); it lasts 2 d/v times the integral of 1/sqrt(1 - s^(p+1)) over (0, 1)."""
    rng = np.random.default_rng(3)
    for depth in DEPTHS:
        k, speed = 10 ** rng.uniform(0, 6), 10 ** rng.uniform(-1, 1)
        deepest, lasts = pressed(power, k, speed)
        text = PRESSED.format(end=0.3 / speed + lasts, k=k, depth=depth, power=power, speed=speed)
        text += 'ask = { v = "b.velocity.y", y = "b.y", d = { min = "b.y" } }\n'
        close(text, route, {"v": speed, "y": 0.2, "d": -deepest}, 1e-6 if power < 1 else 1e-7)


SPRINGS = (
    "-k*sign(b.x)*(abs(b.x)/(1 m))^p",
    "k*max(-b.x/(1 m), 0)^p - k*max(b.x/(1 m), 0)^p",
    "-k*b.x*sqrt(abs(b.x)/(1 m))/(1 m)",
)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("law", SPRINGS)
def test_a_spring_with_a_fractional_power(law: str, route: str) -> None:
    """A quarter lasts a/v times the integral of 1/sqrt(1 - s^2.5) over (0, 1), v^2 = 2 k a^2.5/(2.5 m)."""
    rng = np.random.default_rng(4)
    part = math.gamma(1 + 1 / 2.5) * math.gamma(0.5) / math.gamma(1 / 2.5 + 0.5)
    for _ in range(4):
        a, k = 10 ** rng.uniform(-2, 1), 10 ** rng.uniform(-1, 4)
        text = f"""
        until = "middle 3"
        plane = "horizontal"
        parameters = {{ k = "{k!r} N", p = 1.5 }}
        bodies.b = {{ mass = "1 kg", at = ["{a!r} m", 0] }}
        forces.s = {{ force = "b", value = ["{law}", 0] }}
        events.middle = "b.x = 0"
        ask.t = "t"
        ask.v = "abs(b.velocity.x)"
        """
        speed = math.sqrt(2 * k * a**2.5 / 2.5)
        close(text, route, {"t": 5 * a / speed * part, "v": speed}, 1e-7)


@pytest.mark.parametrize("force", ["(max(b.x/(1 m), 0) - 1)^1.5", "sqrt(abs(b.x)/(1 m) - 1)"])
def test_what_has_no_value_as_it_is_written_has_none_at_the_start(force: str) -> None:
    with pytest.raises(SimulationError, match="it is nan at the start"):
        load_text(REGION.format(time=2.0, speed=1.0, force=1.0, where=force)).run()


@pytest.mark.parametrize("force", ["(1 - max(b.x/(1 m), 0))^1.5", "sqrt(1 - abs(b.x)/(1 m))"])
def test_what_has_no_value_as_it_is_written_has_none_later(force: str) -> None:
    with pytest.raises(SimulationError, match="the integrator cannot go on"):
        load_text(REGION.format(time=2.0, speed=1.0, force=1.0, where=force)).run()
