"""[find]: values, extremes and thresholds against closed forms, runs, sweeps, and what is said of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from planemotion import SceneError, SimulationError, load_text
from planemotion import _layout as layout
from planemotion.base.errors import SceneHint
from planemotion.compile.flatten import flatten
from planemotion.engine.call import trace
from planemotion.engine.result import RunResult
from planemotion.report.explain import explain
from tests.scenes import G, number
from tests.scenes.parts import rod_on_pin

# A particle thrown from the origin, until it comes down to the level below.
THROW = """
until = "P.y < -below"
parameters = { v = "7 m/s", theta = "40 deg", below = "3 m", wanted = "6 m" }
bodies.P = { mass = "1 kg", at = [0, 0] }
start.P.velocity = { polar = ["v", "theta"] }
[ask]
range = "P.x"
angle = { of = "theta", unit = "deg" }
speed = { of = "v", unit = "km/h" }
"""
# A rod on a pin, from rest below, which may go over the top.
ROD = f"""
until = ["over", "back"]
parameters = {{ L = "0.8 m", omega = "1 rad/s" }}
{rod_on_pin(length="L", mass="2 kg", angle="-90 deg")}
start.AB.omega = "omega"
events = {{ over = "AB.turned > 180 deg", back = "AB.omega < 0" }}
ask.omega = {{ of = "omega", unit = "rpm" }}
"""


def found(text: str, find: str, **parameters: Any) -> RunResult:
    return load_text(f"{text}\n[find]\n{find}").run(**parameters)


def speed_for(x: float, theta: float, below: float) -> float:
    return math.sqrt(G * x**2 / (2 * math.cos(theta) ** 2 * (below + x * math.tan(theta))))


def test_a_value() -> None:
    result = found(THROW, 'vary.v = ["1 m/s", "20 m/s"]\nwhere = "P.x = wanted"')
    v = speed_for(6, math.radians(40), 3)
    assert result.status == "ok"
    assert result.speed == pytest.approx(3.6 * v, rel=1e-10)
    assert result.range == pytest.approx(6, rel=1e-10)
    assert result.found["v"].value == pytest.approx(v, rel=1e-10)
    assert result.found["v"].unit == "m/s"
    assert result.counts["found"] == 1
    assert 34 < result.counts["runs"] < 60
    assert result.to_json()["found"]["v"]["value"] == result.found["v"].value
    assert result.to_json()["runs"] == result.counts["runs"]
    assert "found: v = " in result.explain()


def test_what_was_found_has_an_error_not_a_margin() -> None:
    text = THROW.replace('wanted = "6 m"', 'wanted = "6 m", twice = "2*v"') + 'twice = "twice"\n'
    result = found(text, 'vary.v = ["1 m/s", "20 m/s"]\nwhere = "P.x = wanted"')
    v = speed_for(6, math.radians(40), 3)
    for key, exact in (("speed", 3.6 * v), ("twice", 2 * v)):
        ask = result.asks[key]
        assert ask.margin is None
        assert abs(number(ask.value) - exact) <= number(ask.error) < 1e-9 * exact


def test_an_ask_in_a_condition_is_its_answer() -> None:
    text = THROW + 'top = { max = "P.y" }\n'
    result = found(text, 'vary.v = ["1 m/s", "20 m/s"]\nwhere = "top = 1.5 m"')
    assert result.found["v"].value == pytest.approx(math.sqrt(3 * G) / math.sin(math.radians(40)), rel=1e-9)
    assert result.top == pytest.approx(1.5, rel=1e-9)


def test_an_extreme() -> None:
    best = math.atan(7 / math.sqrt(49 + 6 * G))
    for goal in ('greatest = "P.x"', 'greatest = "range"', 'least = "-range"'):
        result = found(THROW, f'vary.theta = [0, "80 deg"]\n{goal}')
        assert result.status == "ok"
        assert result.angle == pytest.approx(math.degrees(best), rel=1e-9)
        assert result.range == pytest.approx(7 / G * math.sqrt(49 + 6 * G), rel=1e-11)


def test_a_threshold() -> None:
    """The rod just reaches the top: omega^2 = 6 g / L; just does not for the greatest that comes back."""
    wanted = math.sqrt(6 * G / 0.8) * 30 / math.pi
    for find in (
        'least = "omega"\nwhere = "over happens"',
        'greatest = "omega"\nwhere = "back happens"',
        'least = "omega"\nwhere = "over 1 happens"',
        'least = "omega"\nwhere = "over.count = 1"',
        'least = "omega"\nwhere = "not (AB.turned < 179.9 deg) and over.count > 0"',
    ):
        result = found(ROD, f'vary.omega = ["1 rad/s", "20 rad/s"]\n{find}')
        assert result.status == "ok"
        assert result.omega == pytest.approx(wanted, rel=1e-9)
        assert abs(number(result.omega) - wanted) <= number(result.asks["omega"].error) < 1e-10 * wanted


@pytest.mark.parametrize(("length", "greatest"), [(0.5, 20), (1.1, 22), (0.8, 20)])
def test_a_threshold_at_a_place_of_rest(length: float, greatest: float) -> None:
    """Runs beside it end their steps at rest but for rounding, with the place of rest a step behind."""
    find = f'vary.omega = ["1 rad/s", "{greatest} rad/s"]\nleast = "omega"\nwhere = "over happens"'
    rod = ROD.replace("180 deg", "190 deg") + '\n[solve]\nmax_time = "1e6 s"'
    result = found(rod, find, L=f"{length} m")
    assert result.omega == pytest.approx(math.sqrt(6 * G / length) * 30 / math.pi, rel=1e-9)


def test_a_threshold_with_a_size() -> None:
    find = 'vary.v = ["1 m/s", "20 m/s"]\nleast = "v"\nwhere = "P.x >= wanted"'
    result = found(THROW, find)
    assert result.speed == pytest.approx(3.6 * speed_for(6, math.radians(40), 3), rel=1e-10)
    assert result.counts["runs"] < 60


def test_two_parameters() -> None:
    text = THROW.replace('"P.y < -below"', '"t = 1.2 s"')
    vary = 'vary = { v = ["1 m/s", "30 m/s"], theta = ["3 deg", "85 deg"] }'
    result = found(text, f'{vary}\nwhere = ["P.x = 9 m", "P.y = 2 m"]')
    vx, vy = 9 / 1.2, 2 / 1.2 + 0.6 * G
    assert result.status == "ok"
    assert result.speed == pytest.approx(3.6 * math.hypot(vx, vy), rel=1e-10)
    assert result.angle == pytest.approx(math.degrees(math.atan2(vy, vx)), rel=1e-10)
    assert list(result.found) == ["v", "theta"]


def test_runs_have_their_own_finds_and_share_the_top_one() -> None:
    own = """
[runs]
near = { wanted = "5 m" }
far = { find = { vary.v = ["1 m/s", "20 m/s"], where = "P.x = 2*wanted" } }
[find]
vary = { v = ["1 m/s", "20 m/s"] }
where = "P.x = wanted"
"""
    text = THROW.replace("[ask]", "[ask]\nfar = { of = 'v', run = 'far' }")
    result = load_text(text + own).run()
    theta = math.radians(40)
    assert result.speed == pytest.approx(3.6 * speed_for(5, theta, 3), rel=1e-10)
    assert result.far == pytest.approx(speed_for(12, theta, 3), rel=1e-10)
    assert list(result.found) == ["near.v", "far.v"]


def test_each_case_of_a_sweep_has_its_find() -> None:
    find = '[find]\nvary.v = ["1 m/s", "20 m/s"]\nwhere = "P.x = wanted"\n'
    scene = load_text(THROW + find + '[sweep]\ntheta = { from = "20 deg", to = "60 deg", num = 5 }')
    swept = scene.sweep(workers=2)
    for i, theta in enumerate(np.radians([20, 30, 40, 50, 60])):
        assert swept["speed"].values[i] == pytest.approx(3.6 * speed_for(6, theta, 3), rel=1e-10)
    alone = load_text(THROW + find).run(theta="30 deg")
    assert alone.speed == swept["speed"].values[1]


def test_the_history_is_of_what_was_found() -> None:
    flat = flatten(load_text(THROW + '[find]\nvary.v = ["1 m/s", "20 m/s"]\nwhere = "P.x = wanted"'))
    history = trace(flat, flat.defaults)
    assert history.columns["P.x"][-1] == pytest.approx(6, rel=1e-9)
    nothing = flatten(load_text(THROW + '[find]\nvary.v = ["1 m/s", "2 m/s"]\nwhere = "P.x = wanted"'))
    with pytest.raises(SimulationError, match="is not met"):
        trace(nothing, nothing.defaults)


def test_bounds_may_depend_on_other_parameters() -> None:
    find = 'vary.v = ["sqrt(below*g)/9", "3*sqrt(below*g)"]\nwhere = "P.x = wanted"'
    assert found(THROW, find, below="5 m").speed == pytest.approx(
        3.6 * speed_for(6, math.radians(40), 5), rel=1e-10
    )


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
@pytest.mark.parametrize(
    ("find", "hits"),
    [
        ('where = "P.x = wanted"', 0),
        ('least = "v"\nwhere = "P.x >= wanted"', 1),
        ('greatest = "v"\nwhere = "wall.count = 0"', 0),
        ('least = "v"\nwhere = "wall happens"', 1),
    ],
)
def test_answers_that_differ_on_both_sides_are_those_of_the_side_that_is_told(
    route: str, find: str, hits: int
) -> None:
    """The particle comes down where an event is about to happen: rounding would decide what is counted."""
    events = 'events.wall = "P.x > wanted"\n[ask]\nhits = "wall.count"\nfar = "P.x + (2 m)*wall.count"\n'
    text = f'solve.route = "{route}"\n{THROW.replace("[ask]", events)}'
    result = found(text, f'vary.v = ["1 m/s", "20 m/s"]\n{find}')
    assert result.status == "ok"
    assert result.hits == hits
    assert result.far == pytest.approx(6 + 2 * hits, rel=1e-9)
    assert result.range == pytest.approx(6, rel=1e-9)
    assert {key for key, ask in result.asks.items() if "other side" in ask.reason} == {"hits", "far"}
    assert any("hits, far differ" in note for note in result.notes)


def test_answers_that_do_not_differ_are_not_told() -> None:
    """A root and a logarithm on one side of a threshold are no steps."""
    asks = 'ask.T = "t"\nask.last = "AB.omega"\nask.top = { of = "t", at = "over" }\nask.omega'
    find = 'vary.omega = ["1 rad/s", "20 rad/s"]\nleast = "omega"\nwhere = "over happens"'
    result = found(ROD.replace("ask.omega", asks), find)
    assert result.status == "ok"
    assert not any("sides" in note for note in result.notes)
    assert not any(ask.reason for ask in result.asks.values())


# ---- what is said -----------------------------------------------------------------------------------------


def said(text: str, find: str, **parameters: Any) -> str:
    with pytest.raises(SimulationError) as caught:
        found(text, find, **parameters)
    return str(caught.value)


def test_nothing_found() -> None:
    text = said(
        THROW.replace('v = "7 m/s"', 'v = "7 km/h"'), 'vary.v = ["1 km/h", "2 km/h"]\nwhere = "P.x = wanted"'
    )
    assert text.startswith('find.where: "P.x = wanted" is not met with v from 1 km/h to 2 km/h: the')
    assert "m at v = 1 km/h and -5.6" in text
    assert "widen find.vary.v, or take more find.samples" in text
    text = said(ROD, 'vary.omega = ["1 rad/s", "2 rad/s"]\nleast = "omega"\nwhere = "over happens"')
    assert text == (
        'find.where: no change of "over happens" with omega from 1 rad/s to 2 rad/s (it never holds); '
        "widen find.vary.omega"
    )
    text = said(THROW, 'vary.v = ["1 m/s", "2 m/s"]\ngreatest = "P.x"\nwhere = "P.x > wanted"')
    assert text == (
        'find.greatest = "P.x": it has no value, or the conditions hold nowhere, with v from 1 m/s to 2 m/s'
    )
    text = said(
        THROW, 'vary = { v = ["1 m/s", "2 m/s"], theta = [0, 1] }\nwhere = ["P.x = wanted", "t = 1 s"]'
    )
    assert "is not met with v from 1 m/s to 2 m/s and theta from 0 deg to 57.2958 deg" in text


def test_a_jump_is_no_root() -> None:
    text = said(THROW, 'vary.v = ["1 m/s", "20 m/s"]\nwhere = "floor(P.x/wanted) = 0.5"')
    assert text.endswith("the difference of its sides jumps from -0.5 to 0.5")


def test_several_found() -> None:
    find = 'vary.theta = ["1 deg", "89 deg"]\nwhere = "P.x = wanted"'
    result = found(THROW, find, below=0, v="9 m/s")
    flat = 0.5 * math.asin(6 * G / 81)
    assert result.status == "find_several"
    assert result.angle == pytest.approx(math.degrees(flat), rel=1e-10)
    assert result.error.startswith(
        'find: 2 places with "P.x = wanted", theta from 1 deg to 89 deg; the answers are those of the first, '
        f"another is at theta = {90 - math.degrees(flat):.6g} deg; narrow find.vary.theta"
    )
    steep = found(THROW, f'{find}\ngreatest = "theta"', below=0, v="9 m/s")
    assert steep.status == "ok"
    assert steep.angle == pytest.approx(90 - math.degrees(flat), rel=1e-10)


def test_at_the_bound() -> None:
    result = found(THROW, 'vary.theta = [0, "20 deg"]\ngreatest = "P.x"')
    assert result.status == "find_at_bound"
    assert result.angle == pytest.approx(20, rel=1e-15)
    assert result.error == ("find: what is sought lies at the bound theta = 20 deg of find.vary.theta")


def test_where_runs_begin_to_fail() -> None:
    text = THROW.replace('"1 kg"', '"(1 kg)*(v/(3 m/s) - 1)"')
    result = found(text, 'vary.v = ["1 m/s", "20 m/s"]\nleast = "P.x"')
    assert result.status == "find_at_bound"
    assert result.error == "find: what is sought lies at v = 3 m/s, beyond which runs fail"


def test_runs_that_all_fail_say_why() -> None:
    find = 'vary.v = ["4.5 m/s", "6 m/s"]\nwhere = "P.x = wanted"'
    text = said(THROW.replace('"1 kg"', '"(1 kg)*(4 - v/(1 m/s))"').replace("7 m/s", "3 m/s"), find)
    assert text.startswith("bodies.P.mass: it is -0.5 kg")
    assert found(THROW, find, g=0).status == "limit_time"


def test_a_sought_parameter_cannot_be_set() -> None:
    find = 'vary.v = ["1 m/s", "20 m/s"]\nwhere = "P.x = wanted"'
    with pytest.raises(SceneError, match=r"v: \[find\] looks for it; set find\.vary\.v"):
        found(THROW, find, v="3 m/s")
    scene = load_text(f"{THROW}\n[find]\n{find}").with_values({"find.vary.v": '["1 m/s", "2 m/s"]'})
    with pytest.raises(SimulationError, match="v from 1 m/s to 2 m/s"):
        scene.run()


def test_explain_tells_what_is_sought() -> None:
    find = 'vary.omega = [0, "20 rad/s"]\nleast = "omega"\nwhere = "over happens"'
    text = explain(load_text(f"{ROD}\n[find]\n{find}"))
    assert "find\n  omega  0 .. 20 rad/s  least omega  over happens" in text.text


def test_builder() -> None:
    scene = load_text(THROW).find(vary={"v": ["1 m/s", "20 m/s"]}, where="P.x = wanted")
    assert scene.run().range == pytest.approx(6, rel=1e-10)
    assert load_text(scene.to_toml()).run().asks == scene.run().asks


# ---- the nudge, and the parameter t -----------------------------------------------------------------------


def test_a_nudge_is_a_program_that_is_positive_on_its_side() -> None:
    text = ROD.replace("start.AB.omega", "# ")
    for sign, side in (("<", -1.0), (">", 1.0)):
        flat = flatten(load_text(f'{text}\n[start]\nnudge = "AB.omega {sign} 0"'))
        program = int(flat.rows(layout.PM_TABLE_SETTING)[0, layout.PM_SETTING_NUDGE])
        first, length = flat.rows(layout.PM_TABLE_PROGRAM)[program]
        code = flat.rows(layout.PM_TABLE_CODE)[first : first + length]
        assert code[0, 0] == layout.PM_OP_MEASURE
        assert (length == 2 and code[1, 0] == layout.PM_OP_NEG) == (side < 0)
    flat = flatten(load_text(ROD))
    assert flat.rows(layout.PM_TABLE_SETTING)[0, layout.PM_SETTING_NUDGE] == layout.PM_NONE


def test_a_parameter_called_t_is_not_the_time() -> None:
    body = 'bodies.P = { mass = "1 kg", at = [0, 0] }\nask.y = "P.y"'
    text = f'until = "time = t"\nparameters.t = "2 s"\n{body}'
    with pytest.warns(SceneHint, match="a parameter t hides the time"):
        scene = load_text(text)
    assert scene.run().y == pytest.approx(-2 * G, rel=1e-10)
    assert scene.run(t=3).y == pytest.approx(-4.5 * G, rel=1e-10)
    plain = text.replace('parameters.t = "2 s"\n', "").replace("time = t", "time = 2 s")
    assert load_text(plain).run().y == pytest.approx(-2 * G, rel=1e-10)


@pytest.mark.parametrize("bound", [0, 1])
@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_a_root_on_a_bound(route: str, bound: int) -> None:
    """The error of the run there may have either sign."""
    draw = np.random.default_rng(2)
    for _ in range(6):
        low, t = draw.uniform(0.1, 2), draw.uniform(0.2, 3)
        v = [low, low + draw.uniform(0.1, 3)]
        found = load_text(f"""
            until = "t = {t!r} s"
            parameters.v = "1 m/s"
            bodies.b.mass = "1 kg"
            start.b.velocity = ["v", 0]
            find = {{ vary.v = ["{v[0]!r} m/s", "{v[1]!r} m/s"], where = "b.x = {v[bound] * t!r} m" }}
            ask.x = "b.x"
            solve.route = "{route}"
            """).run()
        assert found.status == "ok"
        assert found["x"] == pytest.approx(v[bound] * t, rel=1e-8)
