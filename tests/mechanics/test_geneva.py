"""A Geneva drive of edges and an arc, beside its closed form and flights of its wheel between edges."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq

import planemotion
from tests import STUDIES
from tests.scenes import ROUTES, close, number

STUDY = planemotion.load(STUDIES / "geneva_drive.toml")
SPEED = 2 * math.pi  # rad/s
INERTIA = 4e-4  # kg*m^2, of the wheel


@dataclass(frozen=True)
class Drive:
    """Parameters of studies/geneva_drive.toml in SI units; `a`: of the pin from the line of centres."""

    n: int
    r: float = 0.04
    pin: float = 4e-3
    play: float = 5e-5
    lock: float = 0.03
    clear: float = 1e-4
    load: float = 0.5
    d: float = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "d", self.r / math.sin(math.pi / self.n))

    @property
    def engaged(self) -> float:
        return math.pi / 2 - math.pi / self.n

    @property
    def parameters(self) -> dict[str, Any]:
        lengths = {key: f"{getattr(self, key)!r} m" for key in ("r", "pin", "play", "lock", "clear")}
        return {"n": self.n, "load": f"{self.load!r} N*m", **lengths}

    def distance(self, a: float) -> float:
        """Of the pin from the axle."""
        return mpmath.hypot(self.d - self.r * mpmath.cos(a), self.r * mpmath.sin(a))  # type: ignore[no-any-return]

    def driven(self, a: float, edge: int = 1) -> float:
        """The angle of the wheel with the pin on an edge of its slot: 1 the pushed one, -1 the other."""
        along = -mpmath.atan2(self.r * mpmath.sin(a), self.d - self.r * mpmath.cos(a))
        return along + edge * mpmath.asin(self.play / self.distance(a)) - math.pi / self.n  # type: ignore[no-any-return]

    def rate(self, a: float, order: int = 1, edge: int = 1) -> float:
        return float(mpmath.diff(lambda x: self.driven(x, edge), a, order) * SPEED**order)

    def push(self, a: float) -> float:
        """Of the pin on its edge: its arm is the way of the pin along the slot."""
        arm = math.sqrt(float(self.distance(a)) ** 2 - self.play**2)
        return (self.load - INERTIA * self.rate(a, 2)) / arm

    def corner(self, angle: float, lower: bool, slots: int = 0) -> tuple[float, float]:
        """Of a hollow, as the driver sees it: its distance and direction."""
        side = self.corner_of * (-1 if lower else 1)
        far = self.lock + self.clear
        at = complex(far * math.cos(side) - self.d, far * math.sin(side))
        turned = (
            at * complex(math.cos(angle), math.sin(angle)) * np.exp(2j * math.pi * slots / self.n) + self.d
        )
        return abs(turned), math.atan2(turned.imag, turned.real)

    @property
    def corner_of(self) -> float:
        return 0.45 * self.engaged

    def held(self) -> float:
        """The angle at which the load turns a corner onto the locking disk."""
        most = 0.2 * math.pi / self.n
        return float(brentq(lambda x: self.corner(x, lower=False)[0] - self.lock, 0, most, xtol=1e-16))

    def is_free(self) -> bool:
        """No corner meets the locking disk while the wheel turns, and the load keeps it on the pin."""
        gap = self.engaged - self.corner_of
        for a in np.linspace(-self.engaged, self.engaged, 401):
            angle = float(self.driven(a))
            for far, way in (self.corner(angle, lower, i) for lower in (False, True) for i in (0, 1)):
                if far < self.lock and abs(way - a) > gap - 0.01:
                    return False
        steepest = max(self.rate(a, 2) for a in np.linspace(0, self.engaged, 41))
        return self.load > 1.2 * INERTIA * steepest and self.held() > 1.2 * self.play / self.d

    def expected(self, t: float) -> float | None:
        """The angle at a time; None where the wheel passes from the disk to the pin or back."""
        turns, a = divmod(SPEED * t, 2 * math.pi)
        a -= math.pi
        done = -turns * 2 * math.pi / self.n
        if abs(a) < self.engaged - 0.05:
            return done + float(self.driven(a))
        if abs(a) > self.engaged + 0.2 and t > 0.02:
            return done + self.held() - (2 * math.pi / self.n if a > 0 else 0)
        return None


def follows(drive: Drive, route: str) -> None:
    run = {"solve.route": route, **drive.parameters}
    found = STUDY.history("wheel.angle", every="10 ms", **run)
    pairs = [
        (x, drive.expected(float(t)))
        for t, x in zip(found["t"].values, found["wheel.angle"].values, strict=True)
    ]
    checked = [(float(x), exact) for x, exact in pairs if exact is not None]
    assert len(checked) > 0.6 * len(pairs)
    assert [x for x, _ in checked] == pytest.approx([exact for _, exact in checked], abs=close(route))
    asks = STUDY.run(**run).asks
    degrees = 180 / math.pi
    for key, exact in (
        ("indexed", (4 * math.pi / drive.n - drive.held()) * degrees),
        ("angle", -float(drive.driven(0)) * degrees),
        ("push", drive.push(0)),
    ):
        assert number(asks[key].value) == pytest.approx(exact, rel=close(route))
        assert abs(number(asks[key].value) - exact) <= 3 * number(asks[key].error) + 1e-12 * abs(exact)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("n", [3, 4, 6])
def test_the_wheel_goes_on_by_one_slot_a_turn(n: int, route: str) -> None:
    follows(Drive(n), route)


@pytest.mark.parametrize("n", [4, 6])
def test_without_play_it_is_fastest_as_the_closed_form_says(n: int) -> None:
    """tan(angle) = sin(a)/(d/r - cos(a)): at most 1/(d/r - 1) of the speed; the play adds next to nothing."""
    drive = Drive(n)
    asks = STUDY.run(**drive.parameters).asks
    fastest = max(-drive.rate(a) for a in np.linspace(-0.01, 0.01, 2001))
    assert number(asks["fastest"].value) == pytest.approx(fastest, rel=1e-9)
    assert number(asks["fastest"].value) == pytest.approx(SPEED / (drive.d / drive.r - 1), rel=1e-5)


def drawn(seed: int) -> Drive:
    rng = np.random.default_rng(seed)
    while True:
        r = rng.uniform(0.02, 0.1)
        play = rng.uniform(2e-4, 2e-3) * r
        pin, lock, clear = rng.uniform(0.05, 0.12) * r, rng.uniform(0.6, 0.8) * r, rng.uniform(2, 5) * play
        drive = Drive(int(rng.integers(3, 9)), r, pin, play, lock, clear, rng.uniform(0.1, 2))
        if drive.d - r > 1.2 * pin and drive.is_free():
            return drive


@pytest.mark.parametrize("seed", range(8))
def test_drives_of_any_size_follow_the_closed_form(seed: int) -> None:
    follows(drawn(seed), "auto")


# ---- a load that does not hold the wheel on the pin ----


def flown(drive: Drive, load: float, begin: float, times: list[float]) -> list[float]:
    """The angle of the wheel between both edges of its slot, without restitution.

    It stays on an edge as long as it presses, and flies over to the other edge."""
    way, slack, edge, t = load / INERTIA, 1e-12, 1, begin
    at = rate = 0.0
    grid = np.arange(begin, times[-1] + 1e-3, 2e-4)
    on: list[tuple[float, int, float, float]] = [(begin, 1, 0, 0)]

    def turned(t: float) -> float:
        return SPEED * t - math.pi

    def presses(t: float, edge: int) -> float:
        return edge * (way - drive.rate(turned(t), 2, edge))

    def fall(t: float, edge: int) -> float:
        """How far the wheel that flies is from an edge."""
        start, _, x, v = on[-1]
        h = t - start
        return edge * (float(drive.driven(turned(t), edge)) - (x + v * h + way * h * h / 2))

    while True:
        later = [t + 1e-7, *(x for x in grid if x > t + 1e-7)]
        if edge:
            off = next((k for k, x in enumerate(later) if presses(x, edge) < 0), None)
            if off is None:
                break
            t = (
                later[0]
                if off == 0
                else brentq(presses, later[off - 1], later[off], args=(edge,), xtol=1e-15)
            )
            at, rate, edge = float(drive.driven(turned(t), edge)), drive.rate(turned(t), 1, edge), 0
        else:
            hit = next(
                ((k, e) for k, x in enumerate(later) if k for e in (1, -1) if fall(x, e) < -slack), None
            )
            if hit is None:
                break
            k, edge = hit
            t = brentq(fall, later[k - 1], later[k], args=(edge,), xtol=1e-15)
        on.append((t, edge, at, rate))

    assert {one[1] for one in on} == {1, 0, -1}

    def angle(t: float) -> float:
        start, edge, x, v = next(one for one in reversed(on) if one[0] <= t)
        h = t - start
        return float(drive.driven(turned(t), edge)) if edge else x + v * h + way * h * h / 2

    return [angle(t) for t in times]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("seed", range(4))
def test_a_light_load_lets_the_wheel_fly_from_edge_to_edge(seed: int, route: str) -> None:
    rng = np.random.default_rng(seed)
    play = float(rng.uniform(5e-5, 2e-4))
    drive = Drive(int(rng.integers(4, 7)), play=play, clear=2 * play)
    load = float(rng.uniform(-0.5, 0.5)) * INERTIA * max(drive.rate(a, 2) for a in np.linspace(0, 1, 41))
    begin = 0.5 - 0.85 * drive.engaged / SPEED
    text = STUDY.whole_text.replace(
        'value = "load"', f'value = "load*(t < ({begin!r} s)) + ({load!r} N*m)*(t >= ({begin!r} s))"'
    )
    scene = planemotion.load_text(text.replace("t = 2*turn", f"t = {1 - begin!r} s"))
    found = scene.history("wheel.angle", every="5 ms", **{"solve.route": route, **drive.parameters})
    probes = [
        (float(t), float(x)) for t, x in zip(found["t"], found["wheel.angle"], strict=True) if t > begin
    ]
    exact = flown(drive, load, begin, [t for t, _ in probes])
    assert [x for _, x in probes] == pytest.approx(exact, abs=10 * close(route))
