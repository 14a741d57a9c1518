"""Springs that only push or only pull: when they begin and cease to act, however far a body comes from."""

from __future__ import annotations

import math

import numpy as np
import pytest

from planemotion import Scene, load_text

ROUTES = ("auto", "rk", "ida")
GRAVITY = 9.81  # m/s^2

# A particle of 1 kg flies past a soft disc, beside its centre by b.
SOFT_DISC = """
plane = "horizontal"
until = "p.x^2 + p.y^2 > d^2"
parameters = { d = "10 m", b = "0.05 m", v = "1 m/s", k = "100 kN/m", r = "0.1 m" }
ground.points.O = [0, 0]
bodies.p = { mass = "1 kg", at = ["-sqrt(d^2 - b^2)", "b"] }
start.p.velocity = ["v", 0]
forces.f = { spring = ["p", "ground.O"], stiffness = "k", free_length = "r", only = "push" }
[ask]
x = { of = "p.velocity.x", unit = "m/s" }
y = { of = "p.velocity.y", unit = "m/s" }
deepest = { min = "f.stretch", unit = "m" }
[solve]
max_time = "1e6 s"
"""

# A particle falls on a vertical spring and is thrown back, again and again.
BUMPER = """
until = "t = T"
parameters = { T = "9 s", h = "1.4 m", k = "900 kN/m", D = "0.3 m" }
ground.points.O = [0, "-D"]
bodies.m = { mass = "0.7 kg", at = [0, "h"] }
forces.s = { spring = ["m", "ground.O"], stiffness = "k", free_length = "D", only = "push" }
ask.y = { of = "m.y", unit = "m" }
"""


def _run(scene: Scene, route: str, **values: str) -> dict[str, tuple[float, float]]:
    result = scene.with_values({"solve.route": route, **values}).run()
    assert result.status == "ok"
    told: dict[str, tuple[float, float]] = {}
    for key, ask in result.asks.items():
        assert isinstance(ask.value, float)
        told[key] = ask.value, ask.error if isinstance(ask.error, float) else 0.0
    return told


def _draws(seed: int, n: int) -> list[dict[str, str]]:
    random = np.random.default_rng(seed)
    out = []
    for _ in range(n):
        radius = 10 ** random.uniform(-2, 0)
        out.append(
            {
                "r": f"{radius} m",
                "b": f"{radius * random.uniform(-0.95, 0.95)} m",
                "v": f"{10 ** random.uniform(-1, 1)} m/s",
                "k": f"{10 ** random.uniform(2, 6)} N/m",
                "beyond": str(radius),
            }
        )
    return out


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("push", ["k", "k*(1 + 0*t/(1 s))"])
def test_the_way_before_a_soft_disc_does_not_matter(route: str, push: str) -> None:
    """Speeds after it are those before, and their direction that of a start right beside it."""
    scene = load_text(SOFT_DISC.replace('stiffness = "k"', f'stiffness = "{push}"'))
    for values in _draws(1, 3 if route == "ida" else 12):
        radius = float(values.pop("beyond"))
        near = _run(scene, route, d=f"{1.01 * radius} m", **values)
        for times in (30, 300 if route == "ida" else 3000):
            far = _run(scene, route, d=f"{times * radius} m", **values)
            for key in ("x", "y", "deepest"):
                allowed = 5 * (far[key][1] + near[key][1]) + 1e-12 * abs(near[key][0])
                assert abs(far[key][0] - near[key][0]) <= allowed
            speed = float(values["v"].split()[0])
            assert math.hypot(far["x"][0], far["y"][0]) == pytest.approx(speed, rel=1e-8)


def _height(h: float, k: float, mass: float, at: float) -> float:
    """Of the bumper: it falls, and is on the spring for a part of a harmonic period."""
    w, fall = math.sqrt(k / mass), math.sqrt(2 * h / GRAVITY)
    speed, rest = GRAVITY * fall, GRAVITY / w**2
    amplitude = math.hypot(rest, speed / w)
    on = 2 * (math.pi - math.atan2(speed / w, rest)) / w
    late = (at + fall) % (2 * fall + on)  # since it left the spring
    if late <= 2 * fall:
        return speed * late - 0.5 * GRAVITY * late**2
    return amplitude * math.cos(w * (late - 2 * fall - 0.5 * on) + math.pi) - rest


@pytest.mark.parametrize("route", ROUTES)
def test_a_stiff_bumper_throws_back(route: str) -> None:
    scene, random = load_text(BUMPER), np.random.default_rng(2)
    for _ in range(8 if route == "ida" else 60):
        h, k, at = random.uniform(0.01, 3), 10 ** random.uniform(3, 7), random.uniform(3, 10)
        depth = GRAVITY * 0.7 / k + math.sqrt((GRAVITY * 0.7 / k) ** 2 + 2 * 0.7 * GRAVITY * h / k)
        values = {"h": f"{h} m", "k": f"{k} N/m", "T": f"{at} s", "D": f"{1.2 * depth + 0.1} m"}
        told, error = _run(scene, route, **values)["y"]
        assert abs(told - _height(h, k, 0.7, at)) <= 3 * error + 1e-13


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("far", [1.0, 10.0, 100.0, 1000.0])
def test_a_stretch_that_is_small_for_a_moment_is_seen(route: str, far: float) -> None:
    """Nothing acts; the event alone looks at the distance."""
    watched = SOFT_DISC.replace("[ask]", 'events.inside = "f.stretch < 0"\n[ask]\nn = "inside.count"')
    scene = load_text(watched.replace('"100 kN/m"', '"0 N/m"'))
    told = _run(scene, route, d=f"{far} m", b="0.0999 m")
    assert told["n"][0] == 1


@pytest.mark.parametrize("only", ["push", "pull"])
def test_a_spring_at_its_free_length_stays_there(only: str) -> None:
    """At rest nothing acts, and nothing happens."""
    text = f"""
plane = "horizontal"
until = "t = 2 s"
ground.points.O = [0, 0]
bodies.p = {{ mass = "1 kg", at = ["1 m", 0] }}
forces.f = {{ spring = ["p", "ground.O"], stiffness = "50 N/m", free_length = "1 m", only = "{only}" }}
ask.x = {{ of = "p.x", unit = "m" }}
"""
    assert load_text(text).run()["x"] == 1
