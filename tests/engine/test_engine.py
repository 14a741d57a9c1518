"""The boundary to the kernel, and measures that are composed of several, against the kernel's own motion."""

from __future__ import annotations

import json
import math
import threading
from typing import Any

import numpy as np
import pytest

from planemotion import SceneError, SimulationError, load, load_text
from planemotion import _layout as layout
from planemotion.compile.flatten import flatten
from planemotion.engine.call import check, run_cases, trace, values
from planemotion.engine.kernel import status_name, status_text
from planemotion.engine.messages import message
from planemotion.run import simulate
from tests import STUDIES
from tests.scenes import number, numbers

PENDULUM = """
until = "AB.turned = -60 deg"
parameters = { L = "1.2 m", m = "3 kg", phi = "20 deg" }
ground.lines.slope = { through = [0, 0], angle = "phi" }
bodies.AB = { rod = ["A", "B"], length = "L", mass = "m", at = { A = [0, 0] }, angle = "-10 deg", lines.own = { through = [0, 0], angle = "phi" } }
bodies.C = { disk = "0.2 m", mass = "1 kg", at = "AB.B" }
joints = { A = { pin = ["AB.A", "ground"] }, B = { pin = ["C.center", "AB.B"] } }
start = { C.omega = "3 rad/s", AB.omega = "-1 rad/s" }
"""  # noqa: E501


def answers(asks: dict[str, str], text: str = PENDULUM) -> dict[str, float]:
    scene = load_text(text)
    for key, ask in asks.items():
        scene.ask(key, ask)
    return {key: value.value for key, value in scene.run().asks.items()}  # type: ignore[misc]


def test_directions_and_moving_axes_agree_with_their_components() -> None:
    a = answers(
        {
            "angle": "AB.angle",
            "spin": "AB.omega",
            "x": "AB.B.velocity.x",
            "y": "AB.B.velocity.y",
            "norm": "AB.B.speed",
            "heading": "AB.B.velocity.angle",
            "along": "AB.B.velocity along 25 deg",
            "along_slope": "AB.B.velocity along ground.slope",
            "along_own": "AB.B.velocity along AB.own",
            "seen": "AB.B.velocity.y in C",
            "seen_along": "AB.A.velocity along AB.own in AB",
            "fx": "A.force.x",
            "fy": "A.force.y",
            "fx_own": "A.force.x in AB",
            "f_norm_own": "A.force.norm in AB",
            "f_along": "A.force along AB.own",
            "fx_ground": "A.force.x on ground",
            "relative": "C.omega in AB",
            "C_spin": "C.omega",
        }
    )
    c, s = math.cos(a["angle"]), math.sin(a["angle"])
    phi = math.radians(20)
    assert a["norm"] == pytest.approx(math.hypot(a["x"], a["y"]))
    assert a["heading"] == pytest.approx(math.atan2(a["y"], a["x"]))
    assert a["along"] == pytest.approx(
        a["x"] * math.cos(math.radians(25)) + a["y"] * math.sin(math.radians(25))
    )
    assert a["along_slope"] == pytest.approx(a["x"] * math.cos(phi) + a["y"] * math.sin(phi))
    turned = a["angle"] + phi
    assert a["along_own"] == pytest.approx(a["x"] * math.cos(turned) + a["y"] * math.sin(turned))
    assert a["seen"] == pytest.approx(0, abs=1e-12)
    assert a["seen_along"] == pytest.approx(0, abs=1e-12)
    assert a["fx_own"] == pytest.approx(a["fx"] * c + a["fy"] * s)
    assert a["f_norm_own"] == pytest.approx(math.hypot(a["fx"], a["fy"]))
    assert a["f_along"] == pytest.approx(a["fx"] * math.cos(turned) + a["fy"] * math.sin(turned))
    assert a["fx_ground"] == -a["fx"]
    assert a["relative"] == pytest.approx(a["C_spin"] - a["spin"])
    assert a["C_spin"] == pytest.approx(3)


def test_sums_of_the_scene() -> None:
    a = answers(
        {
            "weight": "weight",
            "weights": "AB.weight + C.weight",
            "px": "momentum.x",
            "own_px": "AB.momentum.x + C.momentum.x",
            "kinetic": "energy.kinetic",
            "own_kinetic": "AB.kinetic_energy + C.kinetic_energy",
            "total": "energy.total",
            "parts": "energy.kinetic + energy.potential",
            "spin": "angular_momentum about ground.O",
            "own_spin": "AB.angular_momentum about ground.O + C.angular_momentum about ground.O",
            "inertia": "AB.inertia about AB.A",
        },
        PENDULUM + "ground.points.O = [0, 0]\n",
    )
    assert a["weight"] == pytest.approx(4 * 9.81)
    for one, other in (
        ("weight", "weights"),
        ("px", "own_px"),
        ("kinetic", "own_kinetic"),
        ("total", "parts"),
    ):
        assert a[one] == pytest.approx(a[other])
    assert a["spin"] == pytest.approx(a["own_spin"])
    assert a["inertia"] == pytest.approx(3 * 1.44 / 3)


SLIDING_BOX = """
until = "t = 0.1 s"
ground.lines.floor = { through = [0, 0], angle = "-30 deg" }
[bodies.box]
plate = ["2 m", "1 m"]
corners = ["A", "B", "C", "D"]
mass = "4 kg"
at = { A = [0, 0] }
angle = "-30 deg"
[contacts]
floor = { touch = ["ground.floor", "box.corners"], friction = 0.1 }
"""


def test_the_members_of_a_set_add_up_and_signs_follow_the_first_partner() -> None:
    scene = load_text(SLIDING_BOX)
    for key, ask in {
        "normal": "floor.normal",
        "first": "floor[0].normal",
        "second": "floor[1].normal",
        "closed": "floor.closed",
        "force_y": "floor.force.y",
        "on_box": "floor.force.y on box",
        "gap": "floor.gap",
        "gap_3": "floor[2].gap",
        "friction": "floor.friction",
        "needed": "floor.friction_needed",
        "acceleration": "box.acceleration along -30 deg",
    }.items():
        scene.ask(key, ask)
    a: dict[str, Any] = {key: ask.value for key, ask in scene.run().asks.items()}
    weight, c, s = 4 * 9.81, math.cos(math.pi / 6), math.sin(math.pi / 6)
    assert a["normal"] == pytest.approx(weight * c)
    assert a["first"] + a["second"] == pytest.approx(a["normal"])
    assert a["closed"] == 2
    # The first partner is the ground, which the box presses down.
    assert a["force_y"] == -a["on_box"]
    assert a["on_box"] == pytest.approx(weight * c * (c + 0.1 * s))
    assert abs(a["friction"]) == pytest.approx(0.1 * weight * c)
    assert a["needed"] == pytest.approx(0.1)
    assert a["gap"] == pytest.approx(0, abs=1e-9)
    assert a["gap_3"] == pytest.approx(1)
    assert a["acceleration"] == pytest.approx(9.81 * (s - 0.1 * c))


def test_the_normal_force_of_a_slider_is_on_the_left_of_its_line() -> None:
    text = """
until = "t = 0.1 s"
ground.lines.slope = { through = [0, 0], angle = "30 deg" }
bodies.P = { mass = "2 kg", at = [0, 0] }
joints.j = { slider = ["P", "ground.slope"] }
ask.normal = "j.normal"
"""
    assert load_text(text).run().normal == pytest.approx(2 * 9.81 * math.cos(math.pi / 6))


def test_a_mass_may_be_left_out_where_it_cannot_matter() -> None:
    text = """
until = "t = 1 s"
bodies.wheel = { inertia = "2 kg*m^2", at = [0, 0] }
joints.axle = { pin = ["wheel.center", "ground"] }
forces.motor = { couple = "wheel", value = "4 N*m" }
ask.omega = "wheel.omega"
"""
    scene = load_text(text)
    assert scene.run().omega == pytest.approx(2)
    for measure in ("wheel.mass", "axle.force.y", "weight", "momentum.x"):
        with pytest.raises(
            SceneError, match=r"the mass of wheel is needed for this; give bodies\.wheel\.mass"
        ):
            flatten(load_text(text + f'ask.a = "{measure}"\n'))


# ---- results --------------------------------------------------------------------------------------------


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


BROKEN = """
until = "t = 1 s"
bodies.a = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = "0 deg" }
joints.p = { pin = ["a.A", "ground"] }
ground.lines.high = { through = [0, "0.3 m"] }
"""
FAILURES = [
    ('joints.q = { slider = ["a.B", "ground.high"] }', "assembly", "joints.q is open by 0.3 m"),
    (
        'start = { a.omega = "1 rad/s", "a.B.velocity.y" = "3 m/s" }',
        "start_conflict",
        "start.a.B.velocity.y: 3 m/s is given",
    ),
    (
        'bodies.b = { disk = "1 m", mass = "1 kg", at = [0, 0] }\n'
        'contacts.c = { touch = ["b.rim", "ground.high"] }',
        "penetration",
        "contacts.c: the two overlap by 1.3 m at the start",
    ),
    (
        'bodies.b = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = "a.B" } }\n'
        'joints.q = { pin = ["a.B", "b.A"] }\nstart.a.omega = "1 rad/s"',
        "start_open",
        "leaves the motion of bodies.b undetermined",
    ),
]


@pytest.mark.parametrize(("change", "status", "expected"), FAILURES)
def test_failures_are_told_in_the_words_of_the_scene(change: str, status: str, expected: str) -> None:
    scene = load_text(BROKEN + change, file="x.toml")
    with pytest.raises(SimulationError) as caught:
        scene.run()
    assert str(caught.value).startswith("x.toml: ")
    assert expected in str(caught.value)
    assert status_name(caught.value.status) == status
    entry = simulate(scene).to_json()
    assert (entry["status"], entry["error"]) == (status, str(caught.value))


def test_a_limit_is_an_early_stop_and_no_failure() -> None:
    result = load_text(BROKEN.replace("t = 1 s", "a.omega > 99 rad/s") + 'solve.max_time = "0.5 s"').run()
    assert (result.status, result.ok) == ("limit_time", False)
    assert result.error.startswith("until: not reached within solve.max_time (0.5 s); does it happen at all?")


# ---- arrays ---------------------------------------------------------------------------------------------


def test_a_case_does_not_depend_on_its_neighbours() -> None:
    flat = flatten(load_text(PENDULUM + 'ask = { omega = "AB.omega", force = { max = "A.force.norm" } }\n'))
    param = np.tile(flat.defaults, (12, 1))
    param[:, flat.parameters.index("L")] = np.linspace(0.5, 2, 12)
    together = run_cases(flat, param, workers=2)
    for i in range(12):
        alone = run_cases(flat, param[i : i + 1])
        assert np.array_equal(alone.out[0], together.out[i])
        assert np.array_equal(alone.audit[0], together.audit[i])


def test_a_bad_case_leaves_the_others_alone() -> None:
    flat = flatten(load_text(PENDULUM + 'ask.omega = "AB.omega"\n'))
    param = np.tile(flat.defaults, (3, 1))
    param[1, flat.parameters.index("m")] = -1
    results = run_cases(flat, param)
    assert results.status.tolist() == [layout.PM_OK, layout.PM_BAD_VALUE, layout.PM_OK]
    assert np.isnan(results.out[1, 0])
    assert results.out[0, 0] == results.out[2, 0]
    assert "bodies.AB.mass: it is -1 kg; the bound is 0" in message(flat, results, 1)
    assert message(flat, results, 0) == ""


def test_what_f2py_would_convert_silently_is_refused() -> None:
    flat = flatten(load_text(PENDULUM))
    good = flat.defaults[None, :]
    with pytest.raises(ValueError, match=r"\(cases, 4\) is wanted"):
        run_cases(flat, good[:, :2])
    with pytest.raises(TypeError, match="real numbers are wanted"):
        run_cases(flat, good + 1j)
    with pytest.raises(ValueError, match="stop has the type int64"):
        run_cases(flat, good, stop=np.zeros(1, np.int64))
    with pytest.raises(ValueError, match="workers is 0"):
        run_cases(flat, good, workers=0)
    assert run_cases(flat, np.zeros((0, 4))).out.shape == (0, 0)
    assert run_cases(flat, np.asfortranarray(np.tile(good, (3, 1)))).status.tolist() == [0, 0, 0]


def test_another_thread_sees_progress_and_can_stop() -> None:
    flat = flatten(load_text(PENDULUM.replace('"AB.turned = -60 deg"', '"t = 20 s"')))
    stop, progress = np.zeros(1, np.int32), np.zeros(1, np.int64)
    param = np.tile(flat.defaults, (4000, 1))
    results = []
    worker = threading.Thread(
        target=lambda: results.append(run_cases(flat, param, workers=2, stop=stop, progress=progress))
    )
    worker.start()
    while progress[0] == 0 and worker.is_alive():
        pass
    stop[0] = 1
    worker.join(5)
    assert not worker.is_alive()
    status = results[0].status
    assert layout.PM_CANCELLED in status
    assert layout.PM_OK in status


def test_a_history_has_the_run_from_start_to_end() -> None:
    flat = flatten(load_text(PENDULUM))
    history = trace(flat, flat.defaults)
    assert history.status == layout.PM_OK
    assert history.time[0] == 0
    assert np.all(np.diff(history.time) >= 0)
    assert history.columns["AB.angle"][0] == pytest.approx(math.radians(-10))
    assert history.columns["AB.angle"][-1] == pytest.approx(math.radians(-70))
    total = history.columns["energy.total"]
    assert np.ptp(total) < 1e-8 * abs(total[0])
    assert set(history.mark) <= {0, 1, 2}


def test_a_long_history_gets_the_room_that_it_needs() -> None:
    flat = flatten(load_text(PENDULUM.replace('"AB.turned = -60 deg"', '"t = 300 s"')))
    history = trace(flat, flat.defaults)
    assert len(history.time) > 4096
    assert history.time[-1] == pytest.approx(300)
    assert not np.isnan(history.columns["AB.angle"]).any()


def test_check_assembles_the_start() -> None:
    flat = flatten(load_text(PENDULUM))
    start = check(flat)
    assert (start.status, start.message) == (layout.PM_OK, "")
    assert start.info["coordinates"] == 6
    assert (start.info["rows"], start.info["redundant"], start.info["freedom"]) == (4, 0, 2)
    assert start.pose[0] == pytest.approx(
        [0.6 * math.cos(-math.pi / 18), 0.6 * math.sin(-math.pi / 18), -math.pi / 18]
    )
    assert start.velocity[:, 2] == pytest.approx([-1, 3])
    assert start.number["opening"] < 1e-12
    broken = check(flatten(load_text(BROKEN + FAILURES[0][0], file="x.toml")))
    assert broken.status == layout.PM_ASSEMBLY
    assert "joints.q is open by" in broken.message


def test_values_in_python_are_those_of_the_kernel() -> None:
    flat = flatten(
        load_text(PENDULUM + 'bodies.P = { mass = "1 kg", at = ["L*sin(phi)^3", "exp(phi)*L"] }\n')
    )
    start = check(flat)
    value = values(flat)
    row = flat.rows(layout.PM_TABLE_BODY)[2]
    assert start.pose[2, 0] == value[row[layout.PM_BODY_X]]
    assert start.pose[2, 1] == value[row[layout.PM_BODY_Y]]


def test_every_status_has_a_text() -> None:
    for name, status in layout.pm_status.items():
        assert len(status_text(status)) > 1, name


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
    assert result.error.startswith("thrown.toml: the run came to its end, but a decision on the way")
    assert math.isfinite(number(result.v))  # the numbers stand
    assert scene.run(more=1e-9).ok


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
    "uniform": "it takes constant forces, and joints and contacts that do not turn with the motion",
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
    """Here a companion of ida fails where it stands, right after its step has."""
    scene = load(STUDIES / "chapter17" / "17-C5.toml")
    assert scene.run(**{"solve.route": "ida", "solve.accuracy": 1e-7}).status == "ends_singular"


def test_what_was_answered_before_a_singular_position_stands() -> None:
    """In time nothing tells how the bars of 17.C5 go on where they hang; the path goes on through it."""
    scene = load(STUDIES / "chapter17" / "17-C5.toml")
    steps = scene.run(**{"solve.route": "ida", "solve.accuracy": 1e-8})
    path = scene.run()
    assert (steps.status, path.status) == ("ends_singular", "ok")
    assert "joints.D: a singular position was reached before the end of the run" in str(steps.error)
    early, all_of_it = numbers(steps.omega_AB), numbers(path.omega_AB)
    assert early[-1] is None
    assert early[:-1] == pytest.approx(all_of_it[:-1], rel=1e-7)
