"""Several contacts with friction at once: crates that fall, are thrown, stand on slopes."""

import math
import random

import pytest

import planemotion
from tests.scenes import G


def crate(
    friction: str | float,
    restitution: float,
    start: tuple[float, float, float],
    *,
    size: tuple[float, float] = (0.2, 0.3),
    place: float = 0,
    tilt: float = 0,
    slope: float = 0,
    until: str = "start",
    more: str = "",
) -> str:
    """A plate whose corner A is `place` above the origin of a sloping floor; `start`: vx, vy, omega."""
    return f"""
until = "{until}"
{more}
[ground]
lines = {{ floor = {{ through = [0, 0], angle = "{slope} deg" }} }}
[bodies.crate]
plate = ["{size[0]} m", "{size[1]} m"]
corners = ["A", "B", "C", "D"]
mass = "1 kg"
at = {{ A = [0, "{place} m"] }}
angle = "{tilt + slope} deg"
[contacts]
feet = {{ touch = ["crate.corners", "ground.floor"], friction = {friction}, restitution = {restitution} }}
[start]
crate.velocity = ["{start[0]} m/s", "{start[1]} m/s"]
crate.omega = "{start[2]} rad/s"
[ask]
x = "crate.x"
vx = "crate.velocity.x"
vy = "crate.velocity.y"
omega = "crate.omega"
a = "crate.acceleration.norm"
"""


def answers(text: str) -> dict[str, float]:
    result = planemotion.load_text(text).run()
    assert result.status in ("ok", "undecided"), result.error
    return {key: float(ask.value) for key, ask in result.asks.items() if isinstance(ask.value, float)}


@pytest.mark.parametrize(
    ("friction", "restitution", "expected"),
    [(0.1, 0.3, (-0.461, 0.09)), (0.05, 0, (-0.485, 0)), (0.1, 0, (-0.47, 0)), (0, 0.5, (-0.5, 0.15))],
)
def test_a_plate_falls_flat(friction: float, restitution: float, expected: tuple[float, float]) -> None:
    """Both corners push: vx' = vx + mu (1 + e) |vy|, vy' = e |vy|, and it does not rotate."""
    found = answers(crate(friction, restitution, (-0.5, -0.3, 0)))
    assert (found["vx"], found["vy"]) == pytest.approx(expected, abs=1e-12)
    assert found["omega"] == pytest.approx(0, abs=1e-12)


def test_friction_of_nothing_may_be_a_parameter() -> None:
    written = answers(crate(0, 0.2, (0.3, -0.3, 1)))
    swept = answers(crate('"mu"', 0.2, (0.3, -0.3, 1), more="[parameters]\nmu = 0\n"))
    assert swept == pytest.approx(written, abs=1e-14)


@pytest.mark.parametrize("route", ["uniform", "rk", "ida"])
def test_a_tall_plate_slides_without_tipping(route: str) -> None:
    text = crate(0.2, 0, (0, 0, 0), size=(0.2, 0.4), slope=35, until="t = 0.1 s")
    found = answers(text + f'[solve]\nroute = "{route}"\n')
    slope = math.radians(35)
    assert found["a"] == pytest.approx(G * (math.sin(slope) - 0.2 * math.cos(slope)), rel=1e-9)
    assert found["omega"] == pytest.approx(0, abs=1e-9)


def test_crates_on_slopes_stay_or_slide() -> None:
    """Where they do not tip: at rest up to tan(slope) = mu, else with g (sin - mu cos)."""
    rng = random.Random(17)
    for _ in range(120):
        mu, degrees = rng.uniform(0, 1.2), rng.uniform(0, 60)
        size = rng.uniform(0.05, 0.5), rng.uniform(0.05, 0.5)
        slope = math.radians(degrees)
        if min(mu, math.tan(slope)) > 0.99 * size[0] / size[1]:
            continue
        found = answers(crate(mu, 0, (0, 0, 0), size=size, slope=degrees, until="t = 0.05 s"))
        expected = max(0.0, G * (math.sin(slope) - mu * math.cos(slope)))
        assert found["a"] == pytest.approx(expected, abs=1e-8), (mu, degrees, size)


LAWS = ["newton", "poisson", "stronge"]


def throw(rng: random.Random, until: str, *, mirrored: bool = False, law: str = "newton") -> str:
    """A crate thrown at random; mirrored: its mirror image, B for A, from the same numbers."""
    sign = -1 if mirrored else 1
    friction = rng.choice([0.05, 0.2, 0.5, 0.9, rng.uniform(0.02, 1)])
    restitution = rng.choice([0, 0.3, rng.uniform(0, 0.7)])
    start = sign * rng.uniform(-3, 3), rng.uniform(-3, 0), sign * rng.uniform(-10, 10)
    size = rng.uniform(0.05, 0.5), rng.uniform(0.05, 0.5)
    tilt = sign * rng.uniform(-180, 180)
    text = crate(friction, restitution, start, size=size, tilt=tilt, place=0.8, until=until)
    text = text.replace("restitution = ", f'law = "{law}", restitution = ')
    return text.replace("at = { A = ", "at = { B = ") if mirrored else text


@pytest.mark.parametrize("law", LAWS)
def test_thrown_crates_come_to_rest(law: str) -> None:
    rng = random.Random(3)
    for _ in range(60):
        text = throw(rng, "rest", law=law)
        result = planemotion.load_text(text).run()
        assert result.status in ("ok", "undecided", "not_unique", "painleve"), (text, result.error)


@pytest.mark.parametrize("law", LAWS)
def test_a_mirrored_throw_is_the_mirrored_motion(law: str) -> None:
    for seed in range(25):
        texts = [
            throw(random.Random(seed), "t = 0.6 s", mirrored=mirrored, law=law) for mirrored in (False, True)
        ]
        one, other = (planemotion.load_text(text).run() for text in texts)
        assert one.status == other.status
        for key, sign in (("vx", -1), ("vy", 1), ("omega", -1)):
            a, b = one.asks[key].value, other.asks[key].value
            assert isinstance(a, float)
            assert isinstance(b, float)
            assert a == pytest.approx(sign * b, abs=1e-6), texts[0]


def pair(rng: random.Random, law: str) -> str:
    """A crate on another at the foot of a wall, which they strike in one blow."""
    mass, width, height = rng.uniform(0.2, 5), rng.uniform(0.1, 0.4), rng.uniform(0.1, 0.4)
    friction, restitution = rng.uniform(0, 0.6), rng.uniform(0, 1)
    law = f'friction = {friction}, restitution = {restitution}, law = "{law}"'
    return f"""
until = "start"
[ground]
lines = {{ floor = {{ through = [0, 0] }}, wall = {{ through = [0, 0], angle = "-90 deg" }} }}
[bodies.low]
plate = ["0.5 m", "0.3 m"]
corners = ["A", "B", "C", "D"]
mass = "1 kg"
at = {{ A = [0, 0] }}
[bodies.high]
plate = ["{width} m", "{height} m"]
corners = ["A", "B", "C", "D"]
mass = "{mass} kg"
at = {{ A = ["0.05 m", "0.3 m"] }}
[contacts]
feet = {{ touch = ["low.A", "ground.floor"], {law} }}
toes = {{ touch = ["low.B", "ground.floor"], {law} }}
side = {{ touch = ["low.D", "ground.wall"], {law} }}
left = {{ touch = ["high.A", "low.top"], {law} }}
right = {{ touch = ["high.B", "low.top"], {law} }}
[start]
low.velocity = ["{-rng.uniform(0, 2)} m/s", "{-rng.uniform(0, 2)} m/s"]
low.omega = "{rng.uniform(-0.1, 0.1)} rad/s"
high.velocity = ["{rng.uniform(-1, 1)} m/s", "{-rng.uniform(2, 4)} m/s"]
high.omega = 0
[ask]
lost = "energy.lost"
x = "high.velocity.x"
y = "high.velocity.y"
turn = "low.omega"
"""


@pytest.mark.parametrize("law", LAWS)
def test_no_stack_at_a_wall_gains_energy_and_the_order_in_the_file_says_nothing(law: str) -> None:
    rng, seen = random.Random(5), 0
    for _ in range(40):
        text = pair(rng, law)
        lines = text.splitlines()
        first = lines.index("[contacts]") + 1
        turned = [*lines[:first], *reversed(lines[first : first + 5]), *lines[first + 5 :]]
        one, other = (planemotion.load_text(x).run() for x in (text, "\n".join(turned)))
        assert one.status == other.status
        if one.status not in ("ok", "undecided"):
            assert one.status == "not_unique"
            continue
        seen += 1
        lost = one.asks["lost"].value
        assert isinstance(lost, float)
        assert lost >= -1e-9
        for key in ("x", "y", "turn"):
            assert other.asks[key].value == pytest.approx(one.asks[key].value, abs=1e-8), text
    assert seen > 25


def rod(degrees: float, friction: str, slip: float, omega: float, until: str = "start") -> str:
    """A rod of 1 m on its lower end, which slips with this velocity and does not lift."""
    angle = math.radians(degrees)
    return f"""
until = "{until}"
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
[bodies.rod]
rod = ["A", "B"]
length = "1 m"
mass = "1 kg"
at = {{ A = [0, 0] }}
angle = "{degrees} deg"
[contacts]
foot = {{ touch = ["rod.A", "ground.floor"], friction = {friction} }}
[start]
rod.velocity = ["{slip - omega / 2 * math.sin(angle)} m/s", "{omega / 2 * math.cos(angle)} m/s"]
rod.omega = "{omega} rad/s"
[ask]
alpha = "rod.alpha"
"""


def test_painleves_rod_has_no_motion() -> None:
    """At 50 degrees with mu = 1.6 the sliding foot would have to pull: 1 + 3 cos (cos - mu sin) < 0."""
    result = planemotion.load_text(rod(50, "1.6", -1, 0)).run()
    assert result.status == "painleve"
    assert "contacts.foot: with friction 1.6 no motion" in result.error


def test_painleves_rod_has_two_motions() -> None:
    """Turning fast enough to lift, it may slide on, too."""
    result = planemotion.load_text(rod(50, "1.6", -1, 6)).run()
    assert result.status == "not_unique"
    assert "contacts.foot: with friction 1.6" in result.error


def test_a_rough_foot_that_cannot_push() -> None:
    """Where its normal force vanishes the foot neither keeps from slipping nor parts: no livelock."""
    result = planemotion.load_text(rod(89.9, '"rough"', 0, -2, until="t = 5 s")).run()
    assert result.status == "rough_impossible"
    assert result.stopped_at is not None
    assert 0.3 < result.stopped_at < 0.4


def test_sliding_is_found_where_sticking_and_parting_are_not() -> None:
    """One foot at rest: it would have to pull to stick, and approaches if it is let go."""
    angle, omega, mu = math.radians(37.5), -4.5425, 0.1
    result = planemotion.load_text(rod(37.5, "0.1", 0, omega)).run()
    # It slides forward, T = -mu N: m (a_A)_n = 0 at the foot.
    r = (-0.5 * math.cos(angle), -0.5 * math.sin(angle))
    normal = 1 + 12 * r[0] * (r[0] + mu * r[1])
    load = (G + omega**2 * r[1]) / normal
    assert load > 0
    assert result.alpha == pytest.approx(12 * (r[0] + mu * r[1]) * load, rel=1e-9)


def slider(route: str, gap: float, friction: float, restitution: float, start: tuple[float, ...]) -> str:
    """A block between two walls, `gap` mm narrower than their distance, pushed at a corner."""
    return f"""
until = "t = 0.6 s"
[ground]
lines.low = {{ through = [0, 0] }}
lines.high = {{ through = [0, "{20 + gap} mm"], angle = "180 deg" }}
[bodies.block]
plate = ["100 mm", "20 mm"]
corners = ["A", "B", "C", "D"]
mass = "1 kg"
at = {{ A = [0, "{gap / 2} mm"] }}
[contacts]
low = {{ touch = ["block.corners", "ground.low"], friction = {friction}, restitution = {restitution} }}
high = {{ touch = ["block.corners", "ground.high"], friction = {friction}, restitution = {restitution} }}
[forces]
push = {{ force = "block.D", value = ["{start[3]} N", 0] }}
[start]
block.velocity = ["{start[0]} m/s", "{start[1]} m/s"]
block.omega = "{start[2]} rad/s"
[ask]
x = "block.x"
y = "block.y"
fast = "block.velocity.y"
spin = "block.omega"
lost = "energy.lost"
[solve]
route = "{route}"
"""


def test_a_slider_with_clearance_clatters_to_rest() -> None:
    """Two corners come to rest on the walls after many blows; all routes agree, and none gains energy."""
    rng = random.Random(5)
    for _ in range(12):
        scene = (10 ** rng.uniform(-1, 0), rng.choice([0, 0.1, 0.3, 0.6]), rng.choice([0, 0.3, 0.5, 0.8]))
        start = (rng.uniform(-1, 1), rng.uniform(-0.5, 0.5), rng.uniform(-2, 2), rng.choice([0, 3, -5]))
        found = [answers(slider(route, *scene, start)) for route in ("auto", "rk", "ida")]
        for each in found:
            assert each["x"] == pytest.approx(found[0]["x"], abs=1e-6), (scene, start)
            assert each["fast"] == pytest.approx(0, abs=1e-7), (scene, start)
            assert each["spin"] == pytest.approx(0, abs=1e-6), (scene, start)
            assert each["lost"] > 0, (scene, start)
