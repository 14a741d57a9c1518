"""What is carried by friction: on slopes, belts, driven tables and walls, for hours and through reversals."""

from __future__ import annotations

import itertools
import math
import random

import pytest
from scipy.optimize import brentq

import planemotion
from tests.scenes import ROUTES, G, answers, within

STATIC, KINETIC = 0.6, 0.5

CRATE = f"""
[bodies.crate]
plate = ["0.4 m", "0.2 m"]
corners = ["A", "B", "C", "D"]
mass = "10 kg"
at = {{ A = [0, 0] }}
angle = "tilt"
[contacts]
feet = {{ touch = ["crate.corners", "FLOOR"], friction = {{ static = {STATIC}, kinetic = {KINETIC} }} }}
[ask]
x = "crate.x"
y = "crate.y"
v = "crate.velocity.norm"
angle = "crate.angle"
moved = "crate.moved.norm"
"""


@pytest.mark.parametrize("route", ROUTES)
def test_a_crate_rests_for_hours_on_a_slope(route: str) -> None:
    head = 'until = "t = 1e4 s"\nsolve.max_time = "1e4 s"\nparameters.tilt = "30 deg"\n'
    head += 'ground.lines.slope = { through = [0, 0], angle = "tilt" }\n'
    values = answers(head + CRATE.replace("FLOOR", "ground.slope"), route)
    assert math.tan(math.radians(30)) < STATIC
    assert values["moved"] == pytest.approx(0, abs=1e-12)
    assert values["v"] == pytest.approx(0, abs=1e-12)
    assert values["angle"] == pytest.approx(math.radians(30), abs=1e-12)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("speed", [0.3, -0.3])
def test_a_belt_takes_a_crate_along_for_hours(route: str, speed: float) -> None:
    """It slips until it runs with the belt, and then it is carried, 1 km and more, without another slip."""
    head = 'until = "t = 1e4 s"\nsolve.max_time = "1e4 s"\nparameters.tilt = "10 deg"\n'
    head += 'ground.lines.belt = { through = [0, 0], angle = "tilt" }\n'
    text = head + CRATE.replace("FLOOR", "ground.belt")
    text = text.replace("} }\n[ask]", f'}}, surface_speed = "{speed} m/s" }}\n[ask]')
    values = answers(text, route)
    tilt = math.radians(10)
    gain = math.copysign(KINETIC * math.cos(tilt), speed) - math.sin(tilt)
    time = speed / (gain * G)
    way = speed * (1e4 - time / 2)
    assert values["v"] == pytest.approx(abs(speed), rel=1e-12)
    assert values["moved"] == pytest.approx(abs(way), rel=within(route, ida=1e-9, others=1e-12))


@pytest.mark.parametrize("route", ROUTES)
def test_a_crate_is_held_against_a_wall_that_runs_up_and_down(route: str) -> None:
    """Pressed by a force of 200 N it sticks while m (g + a) <= 0.6 N of both corners."""
    text = CRATE.replace("FLOOR", "wall.face").replace('angle = "tilt"', 'angle = "-90 deg"')
    head = """
until = "t = 1e3 s"
bodies.wall.mass = "1 kg"
bodies.wall.inertia = "1 kg*m^2"
bodies.wall.at = [0, 0]
bodies.wall.lines.face = { through = [0, 0], angle = "-90 deg" }
bodies.wall.driven.velocity = [0, "(0.2 m/s)*sin(t*(1.5 rad/s))"]
forces.press = { force = "crate", value = ["-200 N", 0] }
"""
    text += 'behind = "crate.y - wall.y"\nnormal = "feet.normal"\nfriction = "feet.friction"\n'
    values = answers(head + text, route)
    assert values["behind"] == pytest.approx(-0.2, abs=within(route, ida=1e-10, others=1e-12))
    assert values["normal"] == pytest.approx(200, rel=1e-9)
    shake = 0.2 * 1.5 * math.cos(1.5 * 1e3)
    assert abs(values["friction"]) == pytest.approx(10 * (G + shake), rel=1e-7)


TABLE = """
until = "t = 20 s"
parameters = { tilt = "0 deg", rate = "1 rad/s" }
[bodies.table]
plate = ["4 m", "0.1 m"]
mass = "20 kg"
at = [0, "-0.05 m"]
lines = { top = { through = [0, "0.05 m"] } }
driven = { velocity = ["(0.5 m/s)*sin(t*rate)", 0] }
[events]
slip = "feet slips"
hold = "feet sticks"
"""


class Table:
    """A crate on a table that runs with 0.5 m/s sin(w t), followed from slip to hold to slip."""

    def __init__(self, rate: float) -> None:
        self.rate, self.t, self.x, self.v, self.slips, self.holds = rate, 0.0, 0.0, 0.0, 0, 0

    def speed(self, t: float) -> float:
        return 0.5 * math.sin(self.rate * t)

    def pull(self, t: float) -> float:
        return 0.5 * self.rate * math.cos(self.rate * t)

    def way(self, t: float) -> float:
        return 0.5 / self.rate * (1 - math.cos(self.rate * t))

    def next_zero(self, of: object, end: float) -> float:
        assert callable(of)
        t, step = self.t + 1e-9, 1e-3 / self.rate
        while t + step < end:
            if of(t) * of(t + step) < 0:
                return float(brentq(of, t, t + step, xtol=1e-15))
            t += step
        return end

    def hold(self, end: float) -> None:
        until = self.next_zero(lambda t: abs(self.pull(t)) - STATIC * G, end)
        self.x += self.way(until) - self.way(self.t)
        self.t, self.v = until, self.speed(until)
        self.slips += until < end

    def slide(self, end: float) -> None:
        gain, t0, v0 = math.copysign(KINETIC * G, self.pull(self.t)), self.t, self.v
        until = self.next_zero(lambda t: v0 + gain * (t - t0) - self.speed(t), end)
        self.x += v0 * (until - t0) + 0.5 * gain * (until - t0) ** 2
        self.t, self.v = until, v0 + gain * (until - t0)
        self.holds += until < end and abs(self.pull(until)) <= STATIC * G

    def run(self, end: float) -> Table:
        while self.t < end:
            if abs(self.pull(self.t)) <= STATIC * G * (1 - 1e-12) and self.v == self.speed(self.t):
                self.hold(end)
            self.slide(end)
            self.v = self.speed(self.t) if self.t < end else self.v
        return self


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("rate", [13, 15, 20])
def test_a_crate_slips_and_holds_on_a_table_that_reverses(route: str, rate: float) -> None:
    """At 20 rad/s it never sticks after a while; at 13 it slips and holds again in each half period."""
    end = 2 if route == "ida" else 20
    known = Table(rate).run(end)
    text = (
        TABLE.replace("t = 20 s", f"t = {end} s")
        + CRATE.replace("FLOOR", "table.top")
        + 'slips = "slip.count"\nholds = "hold.count"\n'
    )
    result = planemotion.load_text(text).run(**{"solve.route": route, "rate": f"{rate} rad/s"})
    assert result.status == "ok", result.error
    close = within(route, ida=1e-8, others=1e-11)
    assert result.asks["x"].value == pytest.approx(0.2 + known.x, abs=close)
    assert result.asks["v"].value == pytest.approx(abs(known.v), abs=close)
    assert result.asks["slips"].value == known.slips
    assert result.asks["holds"].value == known.holds


def stepped(position: float, tilt: float, mu: float, steps: list[tuple[float, float]], end: float) -> float:
    """Where a belt whose speed jumps carries a particle: it slips until it has caught up."""
    x, v, now = position, 0.0, 0.0
    for k, (begin, speed) in enumerate(steps):
        x, v, now = x + v * (begin - now), v, begin
        until = steps[k + 1][0] if k + 1 < len(steps) else end
        gain = G * (math.copysign(mu * math.cos(tilt), speed - v) - math.sin(tilt))
        slips = min((speed - v) / gain, until - now)
        x, now = x + v * slips + 0.5 * gain * slips**2, now + slips
        v = speed if slips < until - begin else v + gain * slips
    return x + v * (end - now)


@pytest.mark.parametrize("route", ROUTES)
def test_a_belt_whose_speed_jumps_takes_along_by_friction_alone(route: str) -> None:
    """No blow presses, so that friction has no impulse: the mass does not jump, whatever its slip."""
    rng = random.Random(4)
    for _ in range(4 if route == "ida" else 12):
        tilt, mu = rng.uniform(0, 0.1), rng.uniform(0.2, 0.8)
        steps = [(0.2, rng.uniform(-2, 2))]
        while len(steps) < 4:
            steps.append((steps[-1][0] + rng.uniform(0.05, 0.6), rng.uniform(-2, 2)))
        jumps = "".join(
            f" + ({now - before!r} m/s)*(t > ({begin!r} s))"
            for (_, before), (begin, now) in itertools.pairwise([(0, 0.0), *steps])
        )
        text = f"""
until = "t = 3 s"
ground.lines.belt = {{ through = [0, 0], angle = "{tilt!r} rad" }}
bodies.m = {{ mass = "2 kg", at = [0, 0] }}
contacts.c = {{ touch = ["m", "ground.belt"], friction = {mu!r}, surface_speed = "(0 m/s){jumps}" }}
start.m.velocity = [0, 0]
events.slips = "c slips"
[ask]
x = "m.x"
slipped = "slips.count"
first = {{ of = "t", at = "slips" }}
lost = "energy.lost"
"""
        found = answers(text, route)
        way = stepped(0, tilt, mu, steps, 3)
        assert found["x"] == pytest.approx(way * math.cos(tilt), rel=within(route), abs=1e-9)
        assert found["slipped"] > 0
        assert found["first"] == pytest.approx(steps[0][0], abs=1e-12)
        assert found["lost"] == 0


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("friction", ["0.3", '"rough"'])
def test_a_disk_on_a_belt_whose_speed_jumps(friction: str, route: str) -> None:
    """It gets a third of that speed: by friction in v / (3 mu g), or at once by an impulse m v / 3."""
    text = f"""
until = "t = 1 s"
ground.lines.belt = {{ through = [0, 0] }}
bodies.d = {{ disk = "0.1 m", mass = "2 kg", at = [0, "0.1 m"] }}
[contacts.c]
touch = ["d.rim", "ground.belt"]
friction = {friction}
surface_speed = "(1.5 m/s)*(t > (0.2 s))"
[start.d]
velocity = [0, 0]
omega = 0
[events]
jump = "t = 0.2 s"
[ask]
v = "d.velocity.x"
x = "d.x"
omega = "d.omega"
impulse = {{ of = "c.impulse.x on d", at = "jump" }}
"""
    found = answers(text, route)
    slips = 0 if friction == '"rough"' else 1.5 / (3 * 0.3 * G)
    assert found["v"] == pytest.approx(0.5, rel=within(route))
    assert found["omega"] == pytest.approx(10, rel=within(route))
    assert found["x"] == pytest.approx(0.5 * (0.8 - 0.5 * slips), rel=within(route))
    assert found["impulse"] == pytest.approx(0 if slips else 1, abs=1e-12)
