"""Curves through points: what slides, rolls and bounces on the same spline as scipy has, knot by knot, on every route."""

# ruff: noqa: E501

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline, PPoly
from scipy.optimize import brentq

import planemotion
from planemotion import SceneError
from tests.mechanics.curve_scenes import ROLLS
from tests.scenes import ROUTES, G, answers, asked, close, on_route

BOWL = (
    (-1.5, 1.0),
    (-1.1, 0.62),
    (-0.7, 0.3),
    (-0.2, 0.05),
    (0.3, 0.02),
    (0.6, 0.2),
    (1.1, 0.55),
    (1.6, 1.2),
)
LOOP = ((1.0, 0.1), (0.4, 0.7), (-0.5, 0.6), (-1.1, -0.1), (-0.3, -0.6), (0.6, -0.5))

Places = tuple[tuple[float, float], ...]


class Wire:
    """The spline of scipy through the same points: each piece goes on beyond its knots."""

    def __init__(self, places: Places, closed: bool = False) -> None:
        points = np.array([*places, places[0]] if closed else places)
        chords = np.hypot(*np.diff(points, axis=0).T)
        self.knots = np.concatenate([[0], np.cumsum(chords)])
        self.closed = closed
        self.spline = CubicSpline(self.knots, points, bc_type="periodic" if closed else "not-a-knot")

    def at(self, s: float, order: int = 0) -> np.ndarray:
        return np.array(self.spline(s, order))

    def piece(self, k: int, s: float, order: int = 0) -> np.ndarray:
        """Piece k, of a closed one counted on over its laps."""
        laps, i = divmod(k, len(self.knots) - 1)
        one = PPoly(self.spline.c[:, i : i + 1], self.knots[i : i + 2], extrapolate=True)
        return np.array(one(s - laps * self.knots[-1], order))

    def ends(self, k: int) -> tuple[float, float]:
        laps, i = divmod(k, len(self.knots) - 1)
        return self.knots[i] + laps * self.knots[-1], self.knots[i + 1] + laps * self.knots[-1]

    def integrated(self, rate: Callable[[Any], Any], y: list[float], end: float) -> np.ndarray:
        """y = (s, speed) at the end: `rate(piece)` is the motion on a piece, which ends where s leaves it."""
        k, t, state = int(np.searchsorted(self.knots, y[0])) - 1, 0.0, np.array(y)
        while True:
            low, high = self.ends(k)
            ways = [lambda t, y, at=low: y[0] - at, lambda t, y, at=high: y[0] - at]
            for way, direction in zip(ways, (-1, 1), strict=True):
                way.terminal, way.direction = True, direction  # type: ignore[attr-defined]
            found = solve_ivp(rate(k), (t, end), state, method="DOP853", rtol=1e-13, atol=1e-14, events=ways)
            t, state = found.t[-1], found.y[:, -1]
            if found.status == 0:
                return state
            k += 1 if len(found.t_events[1]) else -1


def written(places: Places) -> str:
    return str([[f"{x!r} m", f"{y!r} m"] for x, y in places])


def bead_on(wire: Wire, mu: float = 0) -> Callable[[int], Callable[[float, Any], list[float]]]:
    """s'' of what slides along the wire, which presses it to either side; with friction to the left of s."""

    def rate_on(k: int) -> Callable[[float, Any], list[float]]:
        def rate(t: float, y: Any) -> list[float]:
            s, v = y
            first, second = wire.piece(k, s, 1), wire.piece(k, s, 2)
            size = math.hypot(*first)
            across = (first[0] * second[1] - first[1] * second[0]) / size * v * v + G * first[0] / size
            along = (
                -G * first[1] - v * v * float(first @ second) - mu * abs(across) * size * math.copysign(1, v)
            )
            return [v, along / size**2]

        return rate

    return rate_on


@pytest.mark.parametrize("route", ROUTES)
def test_a_bead_slides_to_and_fro_as_integrated(route: str) -> None:
    wire = Wire(BOWL)
    begin = 0.4 * wire.knots[1]
    x, y = wire.at(begin).tolist()
    got = answers(
        f"""
        until = "t = 3 s"
        ground.curves.wire = {{ points = {written(BOWL)} }}
        bodies.p = {{ mass = "2 kg", at = ["{x!r} m", "{y!r} m"] }}
        joints.j = {{ slot = ["p", "ground.wire"] }}
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.v = {{ of = "p.velocity.x", unit = "m/s" }}
        """,
        route,
    )
    s, v = wire.integrated(bead_on(wire), [begin, 0], 3)
    assert got["x"] == pytest.approx(wire.at(s)[0], abs=close(route))
    assert got["v"] == pytest.approx(wire.at(s, 1)[0] * v, abs=close(route))


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("route", ROUTES)
def test_a_bead_goes_round_a_closed_wire_as_integrated(route: str, way: int) -> None:
    """More than a lap, either way: over its seam as over every other knot."""
    wire = Wire(LOOP, closed=True)
    begin = 0.3 * wire.knots[1]
    x, y = wire.at(begin).tolist()
    v = (6 * way * wire.at(begin, 1)).tolist()
    got = answers(
        f"""
        until = "t = 1.5 s"
        ground.curves.wire = {{ points = {written(LOOP)}, closed = true }}
        bodies.p = {{ mass = "2 kg", at = ["{x!r} m", "{y!r} m"] }}
        joints.j = {{ slot = ["p", "ground.wire"] }}
        start."p.velocity" = ["{v[0]!r} m/s", "{v[1]!r} m/s"]
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.y = {{ of = "p.y", unit = "m" }}
        """,
        route,
    )
    s, _ = wire.integrated(bead_on(wire), [begin, 6 * way], 1.5)
    assert abs(s) > wire.knots[-1]
    assert [got["x"], got["y"]] == pytest.approx(wire.at(s % wire.knots[-1]).tolist(), abs=2 * close(route))


@pytest.mark.parametrize("route", ROUTES)
def test_a_point_slides_with_friction_on_a_bowl(route: str) -> None:
    wire = Wire(BOWL)
    begin = 0.4 * wire.knots[1]
    x, y = wire.at(begin).tolist()
    got = answers(
        f"""
        until = "t = 0.8 s"
        ground.curves.bowl = {{ points = {written(BOWL)} }}
        bodies.p = {{ mass = "2 kg", at = ["{x!r} m", "{y!r} m"] }}
        contacts.c = {{ touch = ["p", "ground.bowl"], friction = 0.2 }}
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.v = {{ of = "p.velocity.x", unit = "m/s" }}
        """,
        route,
    )
    s, v = wire.integrated(bead_on(wire, 0.2), [begin, 0], 0.8)
    assert s > wire.knots[3]
    assert got["x"] == pytest.approx(wire.at(s)[0], abs=close(route))
    assert got["v"] == pytest.approx(wire.at(s, 1)[0] * v, abs=close(route))


@pytest.mark.parametrize("how", sorted(ROLLS))
@pytest.mark.parametrize("route", ROUTES)
def test_a_disk_rolls_in_a_bowl_as_integrated(route: str, how: str) -> None:
    """Its centre goes (1 - R b) along the curve with u' = -(2/3) g t_y; it turns by -u / R."""
    wire, radius = Wire(BOWL), 0.12
    begin = 0.6 * wire.knots[1]
    first = wire.at(begin, 1) / math.hypot(*wire.at(begin, 1))
    x, y = (wire.at(begin) + radius * np.array([-first[1], first[0]])).tolist()
    got = answers(
        f"""
        until = "t = 2 s"
        ground.curves.bowl = {{ points = {written(BOWL)} }}
        bodies.p = {{ disk = "{radius} m", mass = "2 kg", at = ["{x!r} m", "{y!r} m"] }}
        {ROLLS[how]}
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.y = {{ of = "p.y", unit = "m" }}
        ask.w = {{ of = "p.omega", unit = "rad/s" }}
        """,
        route,
    )

    def rate_on(k: int) -> Callable[[float, Any], list[float]]:
        def rate(t: float, y: Any) -> list[float]:
            first, second = wire.piece(k, y[0], 1), wire.piece(k, y[0], 2)
            size = math.hypot(*first)
            bend = (first[0] * second[1] - first[1] * second[0]) / size**3
            return [y[1] / (1 - radius * bend) / size, -G / 1.5 * first[1] / size]

        return rate

    s, u = wire.integrated(rate_on, [begin, 0], 2)
    along = wire.at(s, 1) / math.hypot(*wire.at(s, 1))
    centre = wire.at(s) + radius * np.array([-along[1], along[0]])
    assert [got["x"], got["y"]] == pytest.approx(centre.tolist(), abs=2 * close(route))
    assert got["w"] == pytest.approx(-u / radius, abs=2e-8 if route != "ida" else 2e-7)


# ---- bounces ----


def flights(wire: Wire, at: np.ndarray, v: np.ndarray, e: float, end: float) -> tuple[np.ndarray, int]:
    """Where a point is that bounces on the wire, by sampling its height over y(x) finely, and its blows."""
    t, blows = 0.0, 0
    xs = wire.at(np.linspace(0, wire.knots[-1], 4001))[:, 0]  # type: ignore[arg-type]

    def foot(x: float) -> float:
        k = int(np.clip(np.searchsorted(xs, x), 1, len(xs) - 1))
        low, high = wire.knots[-1] * (k - 1) / 4000, wire.knots[-1] * k / 4000
        return float(brentq(lambda s: wire.at(s)[0] - x, low, high, xtol=1e-15, rtol=1e-15))

    def place(h: float) -> np.ndarray:
        return at + v * h + np.array([0, -G * h * h / 2])

    def height(h: float) -> float:
        x, y = place(h)
        return float(y - wire.at(foot(x))[1])

    while True:
        times = np.arange(1e-4, end - t, 1e-3)
        hit = next((h for h in times if height(h) < 0), None)
        if hit is None:
            return place(end - t), blows
        h = brentq(height, max(hit - 1e-3, 1e-5), hit, xtol=1e-15, rtol=1e-15)
        at, v = place(h), v + np.array([0, -G * h])
        first = wire.at(foot(at[0]), 1)
        n = np.array([-first[1], first[0]]) / math.hypot(*first)
        v = v - (1 + e) * (n @ v) * n
        t, blows = t + h, blows + 1


@pytest.mark.parametrize("seed", range(6))
def test_a_point_bounces_on_a_random_spline_blow_by_blow(seed: int) -> None:
    rng = np.random.default_rng(seed)
    x = np.linspace(-3, 3, 13) + rng.uniform(-0.1, 0.1, 13)
    places = tuple(zip(x.tolist(), (0.25 * x**2 + rng.uniform(-0.06, 0.06, 13)).tolist(), strict=True))
    wire, at = Wire(places), np.array([rng.uniform(-0.6, 0.6), 1.2])
    v, e = np.array([rng.uniform(-0.5, 0.5), 0.0]), 0.8
    end, blows = flights(wire, at, v, e, 1.2)
    result = on_route(
        f"""
        until = "t = 1.2 s"
        ground.curves.hills = {{ points = {written(places)} }}
        bodies.p = {{ mass = "1 kg", at = ["{float(at[0])!r} m", "1.2 m"] }}
        contacts.c = {{ touch = ["p", "ground.hills"], restitution = {e}, friction = 0 }}
        start."p.velocity" = ["{float(v[0])!r} m/s", 0]
        events.blow = "c strikes"
        ask.x = {{ of = "p.x", unit = "m" }}
        ask.y = {{ of = "p.y", unit = "m" }}
        ask.n = "blow.count"
        """
    )
    assert asked(result, "n") == blows >= 1
    assert [asked(result, "x"), asked(result, "y")] == pytest.approx(end.tolist(), abs=1e-9)


# ---- the spline beside what its points are taken from ----


@pytest.mark.parametrize("closed", [True, False])
def test_points_of_an_ellipse_come_near_it_with_the_fourth_order(closed: bool) -> None:
    def height(curve: str) -> float:
        return answers(
            f"""
            until = "t = 0.7 s"
            ground.curves.wire = {curve}
            bodies.p = {{ mass = "2 kg", at = ["2 m", "0 m"] }}
            joints.j = {{ slot = ["p", "ground.wire"] }}
            ask.x = {{ of = "p.x", unit = "m" }}
            """
        )["x"]

    def of(n: int) -> float:
        angles = np.linspace(0, 2 * math.pi, n, endpoint=False) if closed else np.linspace(-3, 0.5, n + 1)
        angles = angles if closed else np.sort(np.append(angles, 0.0))
        places = tuple((2 * math.cos(a), math.sin(a)) for a in angles.tolist())
        return height(f"{{ points = {written(places)}, closed = {str(closed).lower()} }}")

    exact = height('{ ellipse = ["2 m", "1 m"] }')
    coarse, fine, finer = (abs(of(n) - exact) for n in (24, 48, 96))
    assert coarse < 1e-2
    assert finer < 1e-5
    assert 3 < math.log2(coarse / finer) / 2 < 5
    assert finer < fine < coarse


def test_a_scale_enlarges_all_points() -> None:
    def ends(scale: str, size: float) -> dict[str, Any]:
        places = tuple((size * x, size * y) for x, y in BOWL)
        return answers(
            f"""
            until = "t = 1 s"
            ground.curves.wire = {{ points = {written(places)}, scale = {scale} }}
            parameters.k = 2
            bodies.p = {{ mass = "2 kg", at = ["{2 * BOWL[1][0]!r} m", "{2 * BOWL[1][1]!r} m"] }}
            joints.j = {{ slot = ["p", "ground.wire"] }}
            ask.x = {{ of = "p.x", unit = "m" }}
            """
        )

    assert ends('"k"', 1)["x"] == pytest.approx(ends("1", 2)["x"], abs=1e-10)


# ---- files and messages ----

SCENE = """
until = "t = 1 s"
ground.curves.wire = {{ {} }}
bodies.p = {{ mass = "2 kg", at = ["-1.1 m", "0.62 m"] }}
joints.j = {{ slot = ["p", "ground.wire"] }}
ask.x = {{ of = "p.x", unit = "m" }}
"""


def _in_file(folder: Path, rows: str, keys: str = 'file = "wire.csv"') -> planemotion.Scene:
    (folder / "wire.csv").write_text(rows)
    (folder / "scene.toml").write_text(SCENE.format(keys))
    return planemotion.load(folder / "scene.toml")


def test_points_stand_in_a_file_beside_the_scene(tmp_path: Path) -> None:
    rows = "x [mm],y (m),note [1]\n# a wire\n" + "".join(f"{1000 * x!r},{y!r},1\n" for x, y in BOWL)
    scene = _in_file(tmp_path, rows)
    x = scene.run().asks["x"].value
    assert x == pytest.approx(answers(SCENE.format(f"points = {written(BOWL)}"))["x"], abs=1e-12)
    whole = planemotion.load_text(scene.whole_text)
    assert whole.run().asks["x"].value == x


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ("", "wire.csv:1: ground.curves.wire: the file is empty"),
        ("x,y [m]\n0,0\n", 'the column "x" has no unit: write "x [mm]"'),
        ("x [s],y [m]\n0,0\n", 'the column "x [s]": a length is wanted; it is a time'),
        ("x [m]\n0\n", "two columns are wanted, such as: x [m],y [m]"),
        ("x [m],y [m]\n0,0\n1,a\n", "wire.csv:3: ground.curves.wire: y = a: a finite number is wanted"),
        ("x [m],y [m]\n0,0\n1\n", "wire.csv:3: ground.curves.wire: 1 fields; the header has 2"),
        ("x [m],y [m]\n", "points are wanted, there is none"),
    ],
)
def test_a_fault_of_a_file_names_its_line(tmp_path: Path, rows: str, message: str) -> None:
    with pytest.raises(SceneError) as error:
        _in_file(tmp_path, rows).run()
    assert message in str(error.value)
    assert "ground.curves.wire" in str(error.value)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("points = []", "points are wanted, there is none"),
        ('points = "wire"', "a list of points is wanted"),
        ("points = [[0, 0], [1, 1]]", "ground.curves.wire.points[1][0]"),
        ('points = [["0 s", 0]]', "a length is wanted; it is a time"),
        ('points = [["0 m"]]', "a point is wanted: [x, y]"),
        (f"points = {written(BOWL[:3])}", "3 points; an open curve needs at least 4"),
        (f"points = {written(LOOP[:2])}, closed = true", "2 points; a closed curve needs at least 3"),
        (
            f"points = {written((*BOWL[:3], BOWL[2], *BOWL[3:]))}",
            "points 3 and 4 are one: [-0.7 m, 0.3 m]; neighbours stand apart",
        ),
        (f'points = {written(BOWL)}, x = "(1 m)*s"', "a curve by points has no x"),
        (f"points = {written(BOWL)}, from = 0", "a curve by points has no from"),
        (f'points = {written(BOWL)}, file = "wire.csv"', "give points or file, not both"),
        ('file = "none.csv"', 'ground.curves.wire.file = "none.csv": cannot be read'),
        ('ellipse = ["1 m", "1 m"], scale = 2', "a scale is that of a curve by points"),
    ],
)
def test_a_fault_of_points_is_told(keys: str, message: str) -> None:
    with pytest.raises(SceneError) as error:
        planemotion.load_text(SCENE.format(keys)).run()
    assert message in str(error.value)


def test_contacts_want_a_curve_that_does_not_cross_itself() -> None:
    places = ((-1.0, 0.0), (0.0, 0.2), (1.0, 1.0), (0.0, 1.6), (-0.6, 0.8), (0.0, 0.0), (1.0, -0.4))
    text = SCENE.format(f"points = {written(places)}").replace(
        'joints.j = { slot = ["p", "ground.wire"] }', 'contacts.c = { touch = ["p", "ground.wire"] }'
    )
    with pytest.raises(planemotion.SimulationError) as error:
        planemotion.load_text(text).run()
    assert "crosses itself" in str(error.value)
