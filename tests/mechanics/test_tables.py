"""Tables of measured values: beside scipy on all routes, at knots, beyond their ends, and in a study."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import PchipInterpolator

import planemotion as pm
from tests.scenes import ROUTES

STUDIES = Path(__file__).parents[2] / "studies"
# A pulse of a millisecond in time, and a spike of a centimetre along the way.
PUSH = ([0, 1, 1.001, 1.002, 5], [0, 1, 100, 1, -2])
GRIP = ([-10, 0, 0.3, 0.305, 0.31, 4, 20], [0, 0, -1, -5, -1, 2, 0])


def written(numbers: Sequence[float], unit: str) -> str:
    return "[" + ", ".join(f'"{one} {unit}"' for one in numbers) + "]"


def slides(
    tables: str, value: str, *, until: str = "t = 4 s", speed: str = "0 m/s", more: str = ""
) -> pm.Scene:
    """A body of 2 kg that is pushed along x; its work, place and speed are asked."""
    return pm.load_text(f"""
until = "{until}"
plane = "horizontal"
parameters.h = 1
bodies.b = {{ mass = "2 kg", at = [0, 0] }}
start.b.velocity.x = "{speed}"
forces.f = {{ force = "b", value = ["{value}", 0] }}
ask = {{ x = "b.x", v = "b.velocity.x", w = "f.work"{more} }}
[tables]
{tables}
""")


def piece_by_piece(f, y: np.ndarray, end: float, times: list[float], places: list[float]) -> np.ndarray:  # type: ignore[no-untyped-def]
    """y' = f(t, y) by scipy, begun anew at each of the times and where y[0] is one of the places."""
    t = 0.0
    while t < end - 1e-13:
        until = min(one for one in [*times, end] if one > t + 1e-12)
        events = [lambda _, y, k=k: y[0] - k for k in places if abs(y[0] - k) > 1e-9]
        for event in events:
            event.terminal = True  # type: ignore[attr-defined]
        r = solve_ivp(
            f, (t, until), y, method="DOP853", rtol=1e-13, atol=1e-15, max_step=0.02, events=events or None
        )
        t, y = r.t[-1], r.y[:, -1]
    return y


@pytest.mark.parametrize("between", ["linear", "cubic"])
def test_tables_of_time_and_place_are_as_scipy_has_them(between: str) -> None:
    push = (lambda t: np.interp(t, *PUSH)) if between == "linear" else PchipInterpolator(*PUSH)
    grip = (lambda x: np.interp(x, *GRIP)) if between == "linear" else PchipInterpolator(*GRIP)

    def f(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (float(push(t)) + float(grip(y[0]))) / 2, float(grip(y[0]))]

    x, v, passed = piece_by_piece(f, np.zeros(3), 4.0, [1, 1.001, 1.002], GRIP[0])
    tables = f"""
push = {{ at = {written(PUSH[0], "s")}, value = {written(PUSH[1], "N")}, between = "{between}" }}
grip = {{ at = {written(GRIP[0], "m")}, value = {written(GRIP[1], "N")}, between = "{between}" }}
"""
    asks = ', least = { min = "grip(b.x)" }, passed = { integral = "grip(b.x)" }'
    for route in ROUTES:
        run = slides(tables, "push(t) + grip(b.x)", more=asks).solve(route=route).run()
        assert run.status == "ok"
        assert [run.x, run.v, run.passed] == pytest.approx([x, v, passed], abs=1e-9), route
        if between == "linear":  # it passes the spike; the least is at its knot
            assert run["least"] == pytest.approx(-5, abs=1e-9)
        assert run.w == pytest.approx(np.square(v), abs=1e-9)  # the ledger of a body of 2 kg that was at rest
        assert (run.audit["energy"] or 0) < 1e-9


BEYOND = 'k = {{ at = ["-1 m", "0.5 m", "1 m"], value = ["0 N", "1 N", "0 N"], outside = "{}" }}'


def test_beyond_its_ends_a_table_is_what_the_scene_says() -> None:
    at, value = [-1, 0.5, 1], [0, 1, 0]

    def extended(x: float) -> float:
        return float(np.interp(x, at, value)) if x < 1 else 2 - 2 * x

    beyond = {
        "hold": lambda x: float(np.interp(x, at, value)),
        "extend": extended,
        "repeat": lambda x: float(np.interp((x + 1) % 2 - 1, at, value)),
    }
    for word, k in beyond.items():
        x, v = piece_by_piece(
            lambda _, y, k=k: [y[1], k(y[0]) / 2], np.array([0.0, 1.0]), 3.0, [], [0.5, 1, 2.5, 3]
        )
        for route in (*ROUTES, "path"):
            scene = slides(BEYOND.format(word), "k(b.x)", until="t = 3 s", speed="1 m/s")
            scene.joint("s", slider=["b.G", "ground.l"]).ground(lines={"l": {"through": [0, 0], "angle": 0}})
            run = scene.solve(route=route).run()
            assert run.status == "ok", (word, route)
            assert [run.x, run.v] == pytest.approx([x, v], abs=1e-9), (word, route)


@pytest.mark.parametrize("route", ROUTES)
def test_a_run_ends_where_a_table_ends_and_not_before(route: str) -> None:
    place = slides(BEYOND.format("stop"), "k(b.x)", until="t = 3 s", speed="1 m/s")
    run = place.solve(route=route).run()
    assert run.status == "table_ends"
    assert run.stopped_at == pytest.approx(0.856941, abs=1e-5)
    assert "tables.k: it ends at 1 " in run.error
    over = 'k = { at = ["0 s", "1 s", "2 s"], value = ["0 N", "1 N", "0 N"], scale = "h" }'
    whole = slides(over, "k(t)", until="t = 2 s").solve(route=route)
    assert whole.run().v == pytest.approx(0.5, abs=1e-12)
    assert whole.run(h=3).v == pytest.approx(1.5, abs=1e-12)
    assert slides(over, "k(t)", until="t = 2.1 s").run().status == "table_ends"


def test_a_spring_out_of_a_table_swings_for_long() -> None:
    scene = slides(
        'k = { at = ["-3 m", "0 m", "3 m"], value = ["9 N", "0 N", "-9 N"] }',
        "k(b.x)",
        until="t = 100 s",
        speed="1 m/s",
        more=', most = { max = "b.x" }, slope = { mean = "k.slope(b.x)" }',
    )
    run = scene.run()
    w = np.sqrt(1.5)
    assert run.status == "ok"
    assert [run.x, run.most] == pytest.approx([np.sin(100 * w) / w, 1 / w], abs=1e-9)
    assert run.slope == pytest.approx(-3, abs=1e-12)


def test_random_tables_of_place_and_speed_close_the_ledger_and_agree() -> None:
    rng = np.random.default_rng(7)
    gained = ', gained = "f.work - b.kinetic_energy + (0.49 J)"'
    for i in range(6):
        at = np.cumsum(0.02 + rng.exponential(0.3, 12)) - 1.5
        speeds = np.cumsum(0.02 + rng.exponential(0.3, 12)) - 1.5
        k, c = (written(rng.normal(0, 2, 12).tolist(), "N") for _ in range(2))
        tables = f"""
k = {{ at = {written(at.tolist(), "m")}, value = {k}, outside = "repeat" }}
c = {{ at = {written(speeds.tolist(), "m/s")}, value = {c}, between = "cubic", outside = "hold" }}
"""
        scene = slides(tables, "k(b.x) + c(b.velocity.x) - (3 N/m)*b.x", speed="0.7 m/s", more=gained)
        runs = [scene.solve(route=route).run() for route in ROUTES]
        for run in runs:
            assert run["gained"] == pytest.approx(0, abs=1e-8), i
            assert [run.x, run.v] == pytest.approx([runs[0].x, runs[0].v], abs=1e-8), i


def test_no_case_knows_the_piece_in_which_another_ended() -> None:
    scene = pm.load_text("""
until = "t = 2 s"
plane = "horizontal"
parameters.x0 = "0.5 m"
bodies.b = { mass = "2 kg", at = ["x0", 0] }
forces.f = { force = "b", value = ["k(b.x)", 0] }
ask = { x = "b.x", v = "b.velocity.x" }
tables.k = { at = ["0 m", "1 m", "2 m"], value = ["5 N", "1 N", "-900 N"], outside = "hold" }
""")
    first, second = scene.sweep(x0=["0.1 m", "1.9 m"]), scene.sweep(x0=["1.9 m", "0.1 m"])
    for name in ("x", "v", "x_error"):
        assert first[name].values.tolist() == second[name].values[::-1].tolist()


def test_drives_conditions_and_parameters_read_tables() -> None:
    scene = pm.load_text("""
until = "speed(t) < (0.5 m/s)"
parameters = { first = "speed(2 s)" }
bodies.b = { mass = "1 kg", at = [0, 0], driven = { velocity = ["speed(t)", 0] } }
ask = { x = "b.x", t = "t", first = "first" }
tables.speed = { at = ["0 s", "1 s", "4 s"], value = ["0 m/s", "3 m/s", "0 m/s"] }
events.none = "t = 10 s"
""")
    run = scene.run()
    assert run.first == pytest.approx(2)
    assert run.t == pytest.approx(3.5, abs=1e-12)
    assert run.x == pytest.approx(1.5 + 4.5 - 0.125, abs=1e-9)


def test_the_car_over_a_measured_road_is_as_scipy_integrates_it() -> None:
    road = np.loadtxt(STUDIES / "measured_road.csv", delimiter=",", skiprows=2)
    at, height = road[:, 0], road[:, 1] / 1000
    m, body, tyre, c, k, d, g, v = 40, 320, 180e3, 120, 22e3, 1600, 9.81, 8

    def f(t: float, y: np.ndarray) -> list[float]:
        x, w, z, vw, vz, _ = y
        i = min(np.searchsorted(at, x + 1e-9, side="right") - 1, len(at) - 2)
        slope = (height[i + 1] - height[i]) / (at[i + 1] - at[i])
        load = (m + body) * g + tyre * (height[i] + slope * (x - at[i]) - w) + c * (slope * v - vw)
        strut = body * g + k * (w - z) + d * (vw - vz)
        return [v, vw, vz, (load - strut) / m - g, strut / body - g, (strut / body - g) ** 2]

    y = piece_by_piece(f, np.zeros(6), 25 / v, (at[(at > 0) & (at < 25)] / v).tolist(), [])
    scene = pm.load(STUDIES / "measured_road.toml")
    for route in ROUTES:
        run = scene.solve(route=route).run()
        assert run.status == "ok"
        assert run.height == pytest.approx(1000 * y[2], abs=1e-6)
        assert run.comfort == pytest.approx(np.sqrt(y[5] / (25 / v)), abs=1e-9)
        assert run.time == pytest.approx(25 / v, abs=1e-12)
