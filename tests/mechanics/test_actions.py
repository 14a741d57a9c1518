"""Actions of events from scenes: what is written means what the kernel does; what cannot be is told."""

from __future__ import annotations

import math
import random

import pytest

import planemotion
from tests import CHAPTER
from tests.scenes import ROUTES, G, answers, fault, number, within
from tests.scenes.parts import FLOOR, body, on_axle, rod_on_pin, touching

SLING = """
plane = "horizontal"
until = "t = 2 s"
[parameters]
lets_go = true
[bodies]
stone = { mass = "1 kg", at = ["0.5 m", 0] }
[couplings]
cord = { cord = ["stone", "ground.O"] }
[ground.points]
O = [0, 0]
[start]
stone.velocity.y = "3 m/s"
[events]
half = { when = "stone.x < -0.3 m", do = [{ remove = "cord", active = "lets_go" }] }
[ask]
x = { of = "stone.velocity.x" }
y = { of = "stone.velocity.y" }
tension = "cord.tension"
before = { of = "cord.tension", at = "before half" }
after = { of = "cord.tension", at = "half" }
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_cord_lets_go_and_the_stone_flies_off_along_the_tangent(route: str) -> None:
    values = answers(SLING, route)
    angle, close = math.acos(-0.3 / 0.5), within(route)
    assert values["x"] == pytest.approx(-3 * math.sin(angle), rel=close)
    assert values["y"] == pytest.approx(3 * math.cos(angle), rel=close)
    assert values["before"] == pytest.approx(18, rel=close)
    assert values["after"] == values["tension"] == 0


def test_an_action_that_is_not_active_is_not_done() -> None:
    assert answers(SLING, lets_go=False)["tension"] == pytest.approx(18)


PUNCH = f"""
until = "t = 1 s"
{on_axle(inertia="2 kg*m^2")}
joints.brake = {{ weld = ["wheel", "ground"], active = false }}
[start]
wheel.omega = "3 rad/s"
[events]
punch = {{ when = "start", do = [{{ impulse = "wheel", work = "-5 J" }}] }}
[ask]
omega = "wheel.omega"
"""


def test_work_of_a_punch() -> None:
    assert answers(PUNCH)["omega"] == pytest.approx(2, rel=1e-12)


def test_work_that_no_impulse_does() -> None:
    text = fault(PUNCH.replace("-5 J", "-50 J"))
    assert "events.punch.do[0]: no impulse on this body does the work -50 J" in text
    assert "-9 J would stop it" in text
    text = fault(PUNCH.replace("3 rad/s", "0 rad/s"))
    assert "it does not rotate" in text


def test_a_joint_that_does_not_fit_where_it_is_added() -> None:
    text = fault(
        PUNCH.replace(
            '"start", do = [{ impulse = "wheel", work = "-5 J" }]', '"t = 0.5 s", do = [{ add = "brake" }]'
        )
    )
    assert "events.punch.do[0].add: the joint does not fit there: it is open by 1.5 m" in text
    assert "at t = 0.5 s" in text


def test_a_weld_stops_what_turns_as_drawn() -> None:
    text = PUNCH.replace('"start", do', '"wheel.turned = 360 deg", do').replace("1 s", "4 s")
    assert answers(
        text.replace('{ impulse = "wheel", work = "-5 J" }', '{ impulse = "wheel", value = "-1 N*m*s" }')
    )["omega"] == pytest.approx(2.5, rel=1e-10)


def test_a_contact_that_is_added_where_two_overlap() -> None:
    text = fault(f"""
until = "t = 1 s"
{FLOOR}
{body("ball", disk="0.1 m", mass="1 kg", at=[0, "0.2 m"])}
{touching("floor", "ball.rim", active=False)}
[events]
late = {{ when = "t = 0.5 s", do = [{{ add = "floor" }}] }}
[ask]
y = "ball.y"
""")
    assert "events.late.do[0].add: the two overlap by 1.126 m where it is added" in text


def test_a_braking_force_comes_with_the_second_blow() -> None:
    """A puck between two walls; the drag comes when it strikes the left one for the second time."""
    values = answers("""
plane = "horizontal"
until = "t = 6.9 s"
[ground.lines]
left = { through = [0, 0], angle = "-90 deg" }
right = { through = ["1 m", 0], angle = "90 deg" }
[bodies]
puck = { mass = "2 kg", at = ["0.5 m", 0] }
[contacts]
left = { touch = ["puck", "ground.left"], restitution = 1 }
right = { touch = ["puck", "ground.right"], restitution = 1 }
[forces]
drag = { damper = ["puck", "ground.O"], rate = "0.6 kg/s", active = false }
[ground.points]
O = [0, 0]
[start]
puck.velocity.x = "-1 m/s"
[events]
second = { when = "left strikes", nth = 2, do = [{ add = "drag" }] }
[ask]
time = "second.time"
count = "second.count"
speed = { of = "puck.speed", at = "end" }
""")
    assert values["time"] == pytest.approx(2.5, rel=1e-9)
    assert values["count"] == 1
    assert values["speed"] == pytest.approx(math.exp(-0.3 * 4.4), rel=1e-8)


def test_explain_tells_what_events_do() -> None:
    from planemotion.report.explain import explain

    text = str(explain(planemotion.load_text(SLING)).text)
    assert "remove cord if lets_go" in text
    text = str(explain(planemotion.load_text(PUNCH)).text)
    assert "work -5 J on wheel" in text


@pytest.mark.parametrize("route", ROUTES)
def test_a_bearing_that_is_let_go_rubs_no_more(route: str) -> None:
    text = f"""
plane = "horizontal"
until = "t = 2 s"
{on_axle(mass="1 kg", inertia="2 kg*m^2", friction="1 N*m")}
[start]
wheel.omega = "3 rad/s"
[events]
off = {{ when = "t = 1 s", do = [{{ remove = "axle" }}] }}
[ask]
omega = "wheel.omega"
couple = "axle.couple"
"""
    values = answers(text, route)
    assert values["omega"] == pytest.approx(2.5, rel=within(route))
    assert values["couple"] == 0


# ---- nudges ---------------------------------------------------------------------------------------------

TUBE = CHAPTER / "17-082.toml"


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize(
    ("half_length", "ball", "tube", "omega"),
    [(1.5, 0.8, 4.0, 8.0), (1.0, 3.0, 2.0, -2.5), (2.5, 0.01, 5.0, 30.0)],
)
def test_balls_leave_a_tube_with_its_angular_momentum(
    route: str, half_length: float, ball: float, tube: float, omega: float
) -> None:
    """No couple acts about the axis: each ball takes m r^2/(I + m r^2) of what there is (ft, lb, rad/s)."""
    scene = planemotion.Scene.load(TUBE).with_values({"solve.route": route})
    result = scene.run(
        half_length=f"{half_length} ft",
        W_ball=f"{ball} lb",
        W_tube=f"{tube} lb",
        omega_initial=f"{omega} rad/s",
    )
    left = 1 / (1 + 3 * ball / tube)
    close = within(route, ida=1e-7)
    assert result.status == "ok", result.error
    assert result.a_omega == pytest.approx(omega * left, rel=close)
    assert result.b_omega == pytest.approx(omega * left**2, rel=close)


def nudged(side: str, do: str = "") -> str:
    start = f'nudge = "{side}"' if not do else ""
    return f"""
until = "rod.y < 0"
{rod_on_pin("rod", mass="2 kg", angle="90 deg")}
{body("block", mass="1 kg", at=["2 m", 0])}
joints.guide = {{ slider = ["block", "ground.guide"] }}
[ground]
lines = {{ guide = {{ through = [0, 0] }} }}
[start]
{start}
[events]
go = {{ when = "start", do = [{do}] }}
[ask]
omega = "rod.omega"
"""


def test_nudges_are_told_where_they_lead_nowhere() -> None:
    assert answers(nudged("rod.omega < 0"))["omega"] == pytest.approx(-math.sqrt(3 * G), rel=1e-9)
    assert answers(nudged("", '{ nudge = "rod.omega > 0" }'))["omega"] == pytest.approx(
        math.sqrt(3 * G), rel=1e-9
    )
    told = fault(nudged("block.velocity.x < 0"))
    assert "start.nudge: nothing that it could begin grows: " in told
    told = fault(nudged("", '{ nudge = "block.velocity.x < 0" }'))
    assert "events.go.do[0].nudge: nothing that it could begin grows: " in told
    told = fault(nudged("", '{ nudge = "rod.omega < 0" }, { nudge = "rod.omega > 0" }'))
    assert "events.go.do[1].nudge: another nudge acts at the same instant" in told
    told = fault(nudged("rod.omega < 0").replace('"90 deg"', '"95 deg"', 1))
    assert "start.nudge: it acts where there is neither rest nor a steady motion" in told


def test_the_time_that_a_nudge_takes_is_not_known() -> None:
    text = nudged("rod.omega < 0") + 'start_of_fall = "t"'
    answer = planemotion.load_text(text).run().asks["start_of_fall"]
    assert number(answer.error) > 0.01


@pytest.mark.parametrize("route", ROUTES)
def test_kicks_at_even_times_are_no_doubt(route: str) -> None:
    """An oscillator that is struck again and again: rotations of (x, v/omega), steps of v between."""
    draw, rate = random.Random(4), 3.0
    for _ in range(12):
        period, way = math.exp(draw.uniform(math.log(0.02), math.log(3))), draw.uniform(-0.3, 0.3)
        x, v, end = 0.3, 0.0, 7.0
        kicks = math.floor(end / period)
        for duration in [period] * kicks + [end - kicks * period]:
            c, s = math.cos(rate * duration), math.sin(rate * duration)
            x, v = c * x + s * v / rate, c * v - rate * s * x + way
        found = planemotion.load_text(
            f"""
            until = "t = {end} s"
            ground = {{ lines.rail = {{ through = [0, 0] }}, points.O = [0, 0] }}
            bodies.b = {{ mass = "1 kg", at = ["0.3 m", 0] }}
            joints.s = {{ slider = ["b", "ground.rail"] }}
            forces.f = {{ spring = ["b", "ground.O"], stiffness = "9 N/m", free_length = 0 }}
            events.k.when = "t every {period!r} s"
            events.k.do = [{{ impulse = "b", value = ["{way!r} N*s", 0] }}]
            ask.x = {{ of = "b.x", unit = "m" }}
            ask.n = "k.count"
            solve.route = "{route}"
            """
        ).run()
        assert (found.status, found["n"]) == ("ok", kicks)
        assert found["x"] == pytest.approx(x, abs=1e-9 if route != "ida" else 1e-6)
