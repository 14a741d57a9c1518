"""Results as they are handed out: JSON, runs, failures, errors, margins, routes."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from xml.etree import ElementTree

import pytest

from planemotion import Scene, SimulationError, load, load_text
from planemotion.engine.kernel import status_name
from planemotion.engine.result import RunResult, counts_text
from planemotion.examples import text_of
from planemotion.run import simulate
from tests import STUDIES
from tests.engine.scenes import BROKEN, FAILURES, PENDULUM
from tests.scenes import number, numbers


def test_the_result_as_json_has_no_nan() -> None:
    text = (
        PENDULUM
        + """
[events]
never = "AB.angle > 3"
step = "AB.angle every 20 deg"
[ask]
omega = { of = "C.omega", unit = "rpm" }
none = { of = "AB.omega", at = "never" }
undefined = { max = "log(-1 - AB.omega^2*(1 s^2))" }
list = { of = "AB.angle", at = "each step", unit = "deg" }
grid = { of = "t", at = { each = "AB.angle", values = ["-20 deg", "50 deg"] } }
"""
    )
    result = load_text(text, file="p.toml").run()
    entry = json.loads(json.dumps(result.to_json(), allow_nan=False))
    assert (entry["id"], entry["file"], entry["status"], entry["route"]) == ("p", "p.toml", "ok", ["rk"])
    assert set(entry["audit"]) == {"energy", "momentum", "constraint"}
    asks = entry["asks"]
    assert (asks["omega"]["value"], asks["omega"]["unit"]) == (pytest.approx(90 / math.pi), "rpm")
    assert len(asks["list"]["error"]) == len(asks["list"]["value"])
    assert asks["none"] == {"value": None, "unit": "rad/s", "reason": "not reached"}
    assert asks["undefined"]["value"] is None
    assert asks["undefined"]["reason"].startswith("undefined")
    assert asks["list"]["value"] == pytest.approx([-20, -40, -60])
    assert asks["grid"]["value"][0] > 0
    assert asks["grid"]["value"][1] is None
    assert asks["grid"]["reason"] == "not reached"
    assert result.omega == pytest.approx(90 / math.pi)
    assert "omega = 28.6478" in result.explain()
    with pytest.raises(AttributeError, match="no ask 'nothing'; there are omega, none"):
        result.nothing  # noqa: B018


def test_runs_are_answered_together() -> None:
    text = """
until = "t = 1 s"
parameters.v = "1 m/s"
runs = { slow = {}, fast = { v = 3 } }
bodies.P = { mass = "1 kg", at = [0, 0] }
start.P.velocity.x = "v"
[ask]
fast_x = { of = "P.x", run = "fast" }
x = "P.x"
"""
    result = load_text(text).run()
    assert list(result.asks) == ["fast_x", "x"]
    assert [result.fast_x, result.x] == pytest.approx([3, 1])


@pytest.mark.parametrize(("change", "status", "expected"), FAILURES)
def test_failures_are_told_in_the_words_of_the_scene(change: str, status: str, expected: str) -> None:
    scene = load_text(BROKEN + change, file="x.toml")
    with pytest.raises(SimulationError) as caught:
        scene.run()
    assert str(caught.value).startswith("x.toml:")
    assert expected in str(caught.value)
    assert status_name(caught.value.status) == status
    entry = simulate(scene).to_json()
    assert (entry["status"], entry["error"]) == (status, str(caught.value))


def test_a_limit_is_an_early_stop_and_no_failure() -> None:
    result = load_text(BROKEN.replace("t = 1 s", "a.omega > 99 rad/s") + 'solve.max_time = "0.5 s"').run()
    assert (result.status, result.ok) == ("limit_time", False)
    assert result.error.startswith("until: not reached within solve.max_time (0.5 s); a.omega lay between ")


SWINGS = """
until = "stop strikes"
ground.points.stop = [0, "-1.3 m"]
bodies.rod = { rod = ["A", "B"], length = "1.2 m", mass = "3 kg", at = { A = [0, 0] } }
joints.A = { pin = ["rod.A", "ground"] }
contacts.stop = { touch = ["rod.bottom", "ground.stop"] }
solve.max_steps = 20000
"""


def test_a_swing_without_end_whose_time_nobody_asks_is_seen_to_repeat() -> None:
    """Its turning points are instants at one time only for who keeps none."""
    result = load_text(SWINGS).run()
    assert result.status == "limit_time"
    assert "the motion repeats itself, and nothing ends it" in result.error


# A ball that is thrown up to just where it touches nothing: whether it gets there is a matter of rounding.
THROWN = """
until = "t = 2 s"
parameters = { h = "1.5 m", more = 0 }
bodies.ball = { mass = "1 kg", at = [0, 0] }
start = { ball.velocity = [0, "sqrt(2*g*h*(1 + more))"] }
events.up = "ball.y > h"
ask = { ups = "up.count", y = "ball.y", v = "ball.velocity.y" }
"""


def test_answers_have_errors_and_counts_a_margin() -> None:
    result = load_text(THROWN).run(more=0.25)
    true = math.sqrt(2 * 9.81 * 1.5 * 1.25) - 9.81 * 2
    assert abs(number(result.v) - true) <= number(result.asks["v"].error) < 1e-12
    assert result.asks["v"].margin is None
    assert (result.ups, result.asks["ups"].error) == (1, 0)
    assert result.asks["ups"].margin == number(result.margin) > 1e6
    assert 0 < number(result.excess) < 1
    assert "margin of decisions" in result.explain()
    assert "error" in result.to_json()["asks"]["y"]


def test_what_the_errors_might_change_is_undecided() -> None:
    scene = load_text(THROWN, file="thrown.toml")
    result = scene.run()
    assert (result.status, result.ok) == ("undecided", False)
    assert number(result.margin) < 1
    decision = "whether its threshold is passed or the motion turns back there"
    assert result.error.startswith(
        f"thrown.toml:6:1: events.up: {decision} lies within the errors of the run"
    )
    assert math.isfinite(number(result.v))  # the numbers stand
    assert scene.run(more=1e-9).ok


# sin 2u - 2 sin u cos u, and next to nothing: all that is watched is rounding.
LEVEL = """
until = "w.turned = 6"
bodies.w = { disk = "0.3 m", mass = "2 kg", at = [0, 0] }
joints.O = { pin = ["w.center", "ground"] }
start.w.omega = "1 rad/s"
events.low = "sin(2*w.turned) - 2*sin(w.turned)*cos(w.turned) + 1e-13*(w.turned - 1.5)^2 + 2e-15 < 0"
ask.n = "low.count"
"""


@pytest.mark.parametrize("estimate", [True, False])
def test_an_event_that_was_not_seen_is_told_with_what_to_do(estimate: bool) -> None:
    result = load_text(LEVEL + f"solve.estimate = {str(estimate).lower()}", file="level.toml").run()
    assert result.status == "undecided"
    assert result.stopped_at is not None
    assert result.error.startswith(
        "level.toml:6:1: events.low: it is not told whether it fires at about t = "
    )
    told = re.search(r"at about t = ([\d.]+) s: ", result.error)
    assert told is not None
    assert float(told[1]) < 6
    for advice in ("solve.accuracy", "a simpler expression", "another solve.route"):
        assert advice in result.error
    assert "margin" not in result.error


def test_estimates_can_be_switched_off() -> None:
    with_errors = load_text(PENDULUM + 'ask.omega = "AB.omega"')
    without = with_errors.with_values({"solve.estimate": False}).run()
    assert without.omega == with_errors.run().omega
    assert without.asks["omega"].error is None
    assert without.margin is without.excess is None
    assert without.to_json()["asks"]["omega"].keys() == {"value", "unit"}
    assert (without.counts["passes"], with_errors.run().counts["passes"]) == (1, 2)


def test_an_accuracy_that_cannot_be_kept_is_told() -> None:
    result = load_text(PENDULUM + 'ask.omega = "AB.omega"\nsolve = { route = "ida", accuracy = 1e-13 }').run()
    assert result.ok
    assert number(result.excess) > 1
    assert result.notes[0].startswith("solve.accuracy was not reached")


FORCED = {
    "state": "it takes what is answered at the start; here time passes",
    "jump": "it takes what is answered before and after a blow at the start; here time passes",
    "uniform": "it takes constant forces, and joints and contacts that do not rotate with the motion",
    "path": "it takes one degree of freedom, and work that depends on position only",
}


@pytest.mark.parametrize("route", FORCED)
def test_a_route_that_is_asked_for_and_declines_says_what_it_takes(route: str) -> None:
    scene = load_text(PENDULUM + 'ask.omega = "AB.omega"', file="p.toml")
    with pytest.raises(SimulationError) as raised:
        scene.run(**{"solve.route": route})
    said = f'p.toml: solve.route = "{route}": this route does not compute the motion; {FORCED[route]}'
    assert str(raised.value).startswith(said)


@pytest.mark.parametrize("route", ["rk", "ida"])
def test_a_route_in_time_where_no_time_passes_says_so(route: str) -> None:
    """At the start, by state or after a blow; the answers stand, as they do without a route."""
    blow = 'events.blow = { when = "start", do = [{ impulse = "AB.B", value = [0, "2 N*s"] }] }\n'
    for ask in ('ask.a = "AB.alpha"', blow + 'ask.a = "AB.omega"'):
        scene = load_text(PENDULUM.replace("AB.turned = -60 deg", "start") + ask)
        forced, free = scene.run(**{"solve.route": route}), scene.run()
        assert (forced.status, free.status) == ("no_time_route", "ok"), free.error
        assert forced.a == free.a
        assert f'solve.route = "{route}": no time passes' in forced.error


def test_a_route_in_time_that_has_only_begun_is_ok() -> None:
    result = load_text(PENDULUM + 'ask.omega = "AB.omega"').run(**{"solve.route": "rk"})
    assert (result.status, result.route) == ("ok", ("rk",))


def test_a_route_that_is_left_is_not_left_for_ever() -> None:
    """Here a coarse run of ida fails where it stands, right after its step has."""
    scene = load(STUDIES / "chapter17" / "17-C5.toml")
    assert scene.run(**{"solve.route": "ida", "solve.accuracy": 1e-7}).status == "ends_singular"


def test_what_was_answered_before_a_singular_position_stands() -> None:
    """In time nothing tells how the bars of 17.C5 go on where they hang; the path goes on through it."""
    scene = load(STUDIES / "chapter17" / "17-C5.toml")
    steps = scene.run(**{"solve.route": "ida", "solve.accuracy": 1e-7})
    path = scene.run()
    assert (steps.status, path.status) == ("ends_singular", "ok")
    assert "a singular position was reached before the end of the run" in str(steps.error)
    early, all_of_it = numbers(steps.omega_AB), numbers(path.omega_AB)
    assert early[-1] is None
    assert early[:-1] == pytest.approx(all_of_it[:-1], rel=1e-7)


FIELDS = """
until = "t = 2 s"
bodies.P = { mass = "1 kg", at = [0, 0] }
start.P.velocity.x = "1.5 m/s"
plane = "horizontal"
[ask]
time = { of = "t", unit = "ms" }
asks = { of = "P.x" }
"a-b" = { of = "P.velocity.x" }
none = { max = "log(-1 - P.velocity.x^2*(1 s^2/m^2))" }
"""


def test_an_answer_is_had_by_its_name_whatever_it_is() -> None:
    """Fields of a result do not hide what is asked, and nothing asked hides a field."""
    result = load_text(FIELDS).run()
    assert list(result) == ["time", "asks", "a-b", "none"]
    assert [result[name] for name in result] == [
        pytest.approx(2000.0),
        pytest.approx(3.0),
        pytest.approx(1.5),
        None,
    ]
    assert result.stopped_at is None
    assert result.asks["time"].unit == "ms"
    assert ("time" in result, "status" in result, len(result)) == (True, False, 4)
    with pytest.raises(KeyError, match="no ask 'status'; there are time, asks, a-b, none"):
        result["status"]


def test_every_field_can_be_the_name_of_an_ask() -> None:
    names = [one.name for one in dataclasses.fields(RunResult)] + ["ok", "explain", "to_json"]
    asks = "\n".join(f'{name} = {{ of = "{number} + 0*t/(1 s)" }}' for number, name in enumerate(names))
    text = FIELDS.partition("[ask]")[0] + "[ask]\n" + asks
    result = load_text(text).run()
    assert [result[name] for name in names] == list(range(len(names)))
    assert result.ok


def test_names_are_completed() -> None:
    result = load_text(FIELDS).run()
    assert result._ipython_key_completions_() == ["time", "asks", "a-b", "none"]
    assert {"time", "status", "none", "explain"} <= set(dir(result))
    assert "a-b" not in dir(result)


def test_a_result_says_what_it_holds() -> None:
    result = load_text(FIELDS, file="p.toml").run()
    lines = repr(result).splitlines()
    assert lines[:3] == ["RunResult p: ok", "  time = 2000 ms", "  asks = 3 m"]
    assert "undefined" in lines[4]
    page = ElementTree.fromstring(result._repr_html_())
    cells = [[cell.text or "" for cell in row] for row in page.iter("tr")]
    assert cells[0] == ["ask", "value", "unit", "estimated error or margin"]
    assert cells[1][:3] == ["time", "2000", "ms"]
    assert cells[4][:2] == ["none", "-"]
    assert "undefined" in cells[4][3]


def test_a_scene_says_what_is_in_it() -> None:
    scene = load_text('title = "A < B"\n' + FIELDS)
    assert repr(scene).splitlines() == ["Scene A < B", "  bodies: P", "  ask: time, asks, a-b, none"]
    page = ElementTree.fromstring(scene._repr_html_())
    assert page.findtext("b") == "Scene A < B"
    assert [cell.text for cell in page.iter("td")] == ["bodies", "P", "ask", "time, asks, a-b, none"]
    assert repr(Scene.from_table({"bodies": 3})) == "Scene without a title"


def test_what_was_counted_is_told_as_people_say_it() -> None:
    counts = {"phases": 1, "events": 2, "passes": 1, "jumps": 0, "limited_blows": 1, "routes": 3}
    assert counts_text(counts) == "1 phase, 2 events, 1 pass, 1 limited blow"
    assert counts_text({"passes": 2, "repeated_segments": 7}) == "2 passes, 7 repeated segments"


def test_what_is_asked_reads_as_it_is_written() -> None:
    """Plots said "rod.omega at before strike"."""
    scene = load_text(text_of("pendulum"))
    assert scene.data.ask["omega_before"].text == "rod.omega before strike"
    assert scene.data.ask["omega_after"].text == "rod.omega at strike"
