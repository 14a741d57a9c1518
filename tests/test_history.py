"""Histories: true at each time, by closed forms and by asks, on every route."""

from __future__ import annotations

import math

import numpy as np
import pytest

import planemotion
from planemotion.base.errors import SceneError, StudyError
from planemotion.compile.flatten import flatten
from planemotion.engine import call, history, recording
from tests.scenes import G
from tests.scenes.parts import FLOOR, rod_on_pin

BALL = f"""
id = "ball"
until = "t = 2 s"
{FLOOR}
bodies.b = {{ sphere = "0.1 m", mass = "2 kg", at = [0, "1 m"] }}
start.b.velocity = ["2 m/s", "3 m/s"]
contacts.floor = {{ touch = ["b.rim", "ground.floor"], restitution = 0.8 }}
events.top = "b.velocity.y < 0"
ask.h = "b.y"
"""
SWING = (
    'id = "swing"\nuntil = "t = 1 s"\n'
    + rod_on_pin(length="1 m", mass="2 kg", angle="-20 deg")
    + 'ask.a = { of = "AB.angle", at = { each = "t", values = { from = 0, to = "1 s", step = "0.1 s" } } }\n'
    + 'ask.f = { max = "A.force.norm" }\n'
)
CLOSE = {"uniform": 1e-12, "path": 1e-12, "rk": 1e-9, "ida": 1e-7}


def scene_of(text: str, route: str = "auto") -> planemotion.Scene:
    return planemotion.load_text(text).solve(route=route)


@pytest.mark.parametrize("route", ["uniform", "rk", "ida"])
def test_a_thrown_ball_is_a_parabola_until_it_strikes(route: str) -> None:
    found = scene_of(BALL, route).history(every="7 ms")
    strike = (3 + math.sqrt(9 + 2 * G * 0.9)) / G
    t = found.t.values[found.t.values < strike]
    close = 1e-12 if route != "ida" else 1e-8
    np.testing.assert_allclose(found["b.y"].values[: len(t)], 1 + 3 * t - G / 2 * t * t, atol=close)
    np.testing.assert_allclose(found["b.x"].values, 2 * found.t.values, atol=close)
    between = found.t.values[found.mark.values == history.STEP]
    np.testing.assert_allclose(between, 0.007 * np.arange(1, len(between) + 1), rtol=1e-15)
    kinetic = found["b.velocity.x"] ** 2 + found["b.velocity.y"] ** 2
    np.testing.assert_allclose(found["energy.kinetic"], kinetic, atol=100 * close)
    np.testing.assert_allclose(
        found["energy.kinetic"] + found["energy.potential"], found["energy.total"], atol=1e-12
    )


@pytest.mark.parametrize("every", [None, "30 ms"])
def test_both_sides_of_a_blow_have_its_name(every: str | None) -> None:
    found = scene_of(BALL).history(every=every)
    assert [name for name in found.event.values[found.mark.values == history.AFTER] if name] == [
        "top",
        "floor",
        "top",
        "floor",
    ]
    at = found.isel(t=found.event.values == "floor").isel(t=slice(0, 2))
    before, after = at["b.velocity.y"].values
    assert at.t.values[0] == at.t.values[1]
    assert at.mark.values.tolist() == [history.BEFORE, history.AFTER]
    assert after == pytest.approx(-0.8 * before, rel=1e-12)
    assert at["energy.total"].values[1] < at["energy.total"].values[0]


def test_what_opens_and_closes_without_a_blow_is_named() -> None:
    lifted = scene_of(
        f"""
id = "lifted"
until = "t = 2 s"
{FLOOR}
bodies.b = {{ sphere = "0.1 m", mass = "1 kg", at = [0, "0.1 m"] }}
contacts.floor = {{ touch = ["b.rim", "ground.floor"] }}
forces.up = {{ force = "b.center", value = [0, "(20 N/s)*t"] }}
"""
    ).history()
    assert "floor opens" in lifted.event.values


@pytest.mark.parametrize("route", ["path", "rk", "ida"])
def test_a_swing_is_where_asks_say_and_keeps_its_energy(route: str) -> None:
    scene = scene_of(SWING, route)
    found = scene.history(every="0.1 s")
    asked = scene.run().asks["a"].value
    on_grid = found.drop_duplicates("t").sel(t=np.linspace(0, 1, 11), method="nearest")
    np.testing.assert_allclose(on_grid.t, np.linspace(0, 1, 11), atol=1e-12)
    np.testing.assert_allclose(on_grid["AB.angle"], np.array(asked), atol=CLOSE[route])
    for every in (None, "0.013 s"):
        total = scene.history(every=every)["energy.total"].values
        np.testing.assert_allclose(total, total[0], atol=20 * CLOSE[route])


def test_what_is_recorded_changes_nothing() -> None:
    for text in (BALL, SWING):
        scene = scene_of(text)
        ends = [scene.history(every=every).isel(t=-1) for every in (None, "3 ms", "0.4 s")]
        for one in ends[1:]:
            assert all(float(one[name]) == float(ends[0][name]) for name in one.data_vars)
    last = float(scene_of(BALL).history()["b.y"][-1])  # a run leaves out what no ask needs
    assert last == pytest.approx(scene_of(BALL).run().h, rel=1e-13)


@pytest.mark.parametrize("file", ["slider_crank", "double_pendulum", "bouncing_ball", "rolling_collar"])
def test_straight_lines_are_true_to_a_finer_grid(file: str) -> None:
    flat = flatten(planemotion.load(f"studies/{file}.toml"), history=())
    coarse = recording.record(flat)
    fine = recording.record(flat, every=float(coarse.time[-1]) / 1009)
    between = (fine.mark == history.STEP) & (fine.time < coarse.time[-1])
    t = fine.time[between]
    left = np.searchsorted(coarse.time, t, side="right") - 1
    part = (t - coarse.time[left]) / (coarse.time[left + 1] - coarse.time[left])
    for unit in set(fine.units.values()):
        names = [name for name in fine.columns if fine.units[name] == unit]
        wide = max(float(np.ptp(fine.columns[name])) for name in names)
        for name in names:
            values = coarse.columns[name]
            line = values[left] + part * (values[left + 1] - values[left])
            off = np.abs(line - fine.columns[name][between]).max()
            assert off <= recording.PIXEL * wide + 1e-9, name


def test_reactions_are_there_where_they_are_asked_for() -> None:
    found = scene_of(SWING).history()
    assert {"A.force.x", "A.force.y"} <= set(found.data_vars)
    silent = scene_of(SWING.replace('ask.f = { max = "A.force.norm" }', "")).history()
    assert not any("force" in str(name) for name in silent.data_vars)
    chosen = scene_of(SWING).history("A.force.norm", "AB.B.y + 2*(1 m)", every="0.5 s", of_run=None)
    assert list(chosen.data_vars) == ["A.force.norm", "AB.B.y + 2*(1 m)"]
    assert [chosen[name].attrs["units"] for name in chosen.data_vars] == ["N", "m"]


def test_parameters_and_runs_are_chosen() -> None:
    text = 'parameters.v = "3 m/s"\n' + BALL.replace('"2 m/s", "3 m/s"', '"2 m/s", "v"')
    assert float(planemotion.load_text(text).history(v="1 m/s")["b.velocity.y"][0]) == 1
    runs = planemotion.load_text(text + '\n[runs]\nslow = { v = "1 m/s" }\nfast = { v = "5 m/s" }\n')
    assert float(runs.history()["b.velocity.y"][0]) == 1
    fast = runs.history(of_run="fast", every="0.5 s")
    assert float(fast["b.velocity.y"][0]) == 5
    assert fast.attrs["run"] == "fast"


def test_a_run_that_ends_early_is_recorded_up_to_there() -> None:
    found = scene_of(BALL.replace('"t = 2 s"', '"b.y > 9 m"')).solve(max_time="0.25 s").history(every="0.1 s")
    assert found.attrs["status"] == "limit_time"
    assert found.t.values.tolist() == pytest.approx([0, 0.1, 0.2, 0.25])


WANTED = 'a time such as "10 ms" is wanted'


@pytest.mark.parametrize(
    ("every", "reason"),
    [
        ("0.1", f'every = "0.1": a plain number; {WANTED}'),
        (0.1, f"every = 0.1: a plain number; {WANTED}"),
        ("10 kg", f'every = "10 kg": a mass; {WANTED}'),
        ("10 sek", f'every = "10 sek": unknown unit "sek"; {WANTED}'),
        ("soon", f'every = "soon": {WANTED}'),
        ([1], f"every = [1]: {WANTED}"),
        ("0 s", 'every = "0 s": a time above zero is wanted'),
        ("-1 s", 'every = "-1 s": a time above zero is wanted'),
        (0, "every = 0: a time above zero is wanted"),
        (math.inf, f"every = inf: the number must be finite; {WANTED}"),
    ],
)
def test_what_is_no_time_is_refused(every: object, reason: str) -> None:
    scene = planemotion.load_text(BALL, file="ball.toml")
    with pytest.raises(SceneError) as caught:
        scene.history(every=every)
    assert str(caught.value) == f"ball.toml: {reason}"


def test_a_quantity_that_the_scene_does_not_have_is_named() -> None:
    with pytest.raises(SceneError, match=r'^ball\.toml: history\.b\.z = "b.z": .*no point or quantity "z"'):
        planemotion.load_text(BALL, file="ball.toml").history("b.z")


def test_too_much_is_refused_before_it_is_computed() -> None:
    with pytest.raises(StudyError, match=r"^ball\.toml: .* is too large"):
        planemotion.load_text(BALL, file="ball.toml").history(every="1e-12 s")


def test_what_is_only_rounding_has_no_rows_of_its_own() -> None:
    """A wheel on its axle: its mass centre moves by rounding, and turning is a line."""
    wheel = scene_of(
        'id = "wheel"\nuntil = "t = 100 s"\nplane = "horizontal"\n'
        'bodies.w = { disk = "1 m", mass = "1 kg", at = [3, 0] }\nstart.w.omega = "50 rad/s"\n'
        'ground.points.O = [3, 0]\njoints.axle = { pin = ["w.center", "ground.O"] }\n'.replace(
            "[3, 0]", '["3 m", 0]'
        )
    )
    assert wheel.history().sizes["t"] < 200


def test_a_row_for_each_bend_needs_one_for_each_column() -> None:
    flat = flatten(scene_of(BALL))
    with pytest.raises(ValueError, match="bends has the shape"):
        call.trace(flat, flat.defaults, bends=[1.0])
