"""Reactions that redundant constraints share: when contacts give way, and what is told of their loads."""

import itertools
import math
import random

import pytest

import planemotion
from planemotion.engine import call
from tests.scenes import G
from tests.scenes.parts import beam_on_feet, rod_on_two_pins

FEET = """
until = "go"
[solve]
route = "{route}"
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
[bodies.beam]
mass = "{mass} kg"
inertia = "1 kg*m^2"
at = ["{place} m", 0]
points = {{ Q = [0, "{height} m"], {points} }}
[contacts]
{contacts}
[forces]
push = {{ force = "beam.Q", value = ["({rate} N/s)*t", 0] }}
[events]
go = [{changes}]
[ask]
t = "t"
"""


def feet(case: dict, order: list[int], mirror: int, route: str) -> str:
    """A body on feet in a row, pushed by a force that grows at a height above them."""
    count = range(len(case["x"]))
    return FEET.format(
        route=route,
        mass=case["mass"],
        place=0.3 * mirror,
        height=case["height"],
        rate=mirror * case["rate"],
        points=", ".join(f'P{i} = ["{mirror * case["x"][i]} m", 0]' for i in count),
        contacts="\n".join(
            f'f{i} = {{ touch = ["beam.P{i}", "ground.floor"], friction = {case["mu"][i]} }}' for i in order
        ),
        changes=", ".join(f'"f{i} {change}"' for i in count for change in ("slips", "opens")),
    )


def greatest_push(case: dict) -> float:
    """F with N >= 0, sum N = m g, sum x N = F h, F <= sum mu N: where it is greatest two feet carry all."""
    x, mu, h, weight = case["x"], case["mu"], case["height"], case["mass"] * G
    greatest = 0.0
    for i, k in itertools.combinations(range(len(x)), 2):
        slope = (mu[k] - mu[i]) / (x[k] - x[i])
        tried = [(mu[i] * weight - slope * x[i] * weight) / (1 - slope * h)] if slope * h != 1 else []
        tried += [x[i] * weight / h, x[k] * weight / h] if h else []
        for force in tried:
            second = (force * h - x[i] * weight) / (x[k] - x[i])
            first = weight - second
            slack = 1e-9 * weight
            if min(first, second) >= -slack and force <= mu[i] * first + mu[k] * second + slack:
                greatest = max(greatest, force)
    return greatest


def random_feet(seed: int) -> dict:
    rng = random.Random(seed)
    n = rng.randint(2, 5)
    x = [-rng.uniform(0.1, 1), *(rng.uniform(-0.1, 0.1) + 0.3 * i for i in range(n - 2)), rng.uniform(1, 2)]
    mu = rng.uniform(0.05, 1)
    alike = rng.random() < 0.5
    mass = rng.uniform(0.5, 20)
    return {
        "x": x,
        "mu": [mu if alike else rng.uniform(0.05, 1) for _ in x],
        "height": rng.choice([0, rng.uniform(0.05, 2)]),
        "mass": mass,
        "rate": mass * G * rng.uniform(0.2, 2),
        "order": rng.sample(range(n), n),
        "mirror": rng.choice([1, -1]),
    }


@pytest.mark.parametrize("route", ["auto", "ida"])
@pytest.mark.parametrize("seed", range(30))
def test_feet_give_way_when_no_distribution_of_the_load_is_left(seed: int, route: str) -> None:
    """Whatever the order in the file.  Feet that rub differently leave the motion open when they slide."""
    case = random_feet(seed)
    text = feet(case, case["order"], case["mirror"], route)
    result = planemotion.load_text(text).run()
    expected = greatest_push(case) / case["rate"]
    if result.status == "not_unique":
        assert len(set(case["mu"])) > 1
        assert len(case["x"]) > 2
        assert result.error.endswith(f"at t = {expected:.6g} s")
    else:
        assert result.status == "ok"
        assert result.asks["t"].value == pytest.approx(expected, rel=1e-10)


CRATE = """
until = "t = 2 s"
[solve]
route = "{route}"
[ground]
lines = {{ floor = {{ through = [0, 0] }} }}
[bodies.crate]
plate = ["1 m", "0.5 m"]
corners = ["A", "B", "C", "D"]
mass = "10 kg"
at = {{ A = [0, 0] }}
[contacts]
feet = {{ touch = ["crate.corners", "ground.floor"], friction = 0.3 }}
[forces]
push = {{ force = "crate", value = ["(30 N/s)*t", 0] }}
[events]
go = "feet slips"
[ask]
way = "crate.x - (0.5 m)"
begins = {{ of = "t", at = "go" }}
friction = "feet.friction"
"""


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
def test_a_pushed_crate_begins_to_slide_when_both_feet_do(route: str) -> None:
    """F = c t = mu m g; then m x'' = c t - mu m g."""
    result = planemotion.load_text(CRATE.format(route=route)).run()
    begins = 0.3 * 10 * G / 30
    way = (
        3 * (8 - begins**3) / 6
        - 0.3 * G * (4 - begins**2) / 2
        - (1.5 * begins**2 - 0.3 * G * begins) * (2 - begins)
    )
    assert result.asks["begins"].value == pytest.approx(begins, rel=1e-10)
    assert result.asks["way"].value == pytest.approx(way, rel=1e-8)
    assert result.asks["friction"].value == pytest.approx(-0.3 * 10 * G, rel=1e-9)


SMOOTH = [f'{name} = {{ touch = ["beam.{name}", "ground.floor"] }}' for name in "ABC"]


def beam(contacts: str, shared: str = "none", route: str = "auto", at: str = "[0, 0]") -> str:
    solve = f'solve = {{ route = "{route}", shared = "{shared}" }}'
    return beam_on_feet(contacts, at=at, solve=solve) + 'least = { min = "A.normal" }\ny = "beam.y"\n'


@pytest.mark.parametrize("route", ["auto", "rk", "ida"])
@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_what_is_not_unique_has_no_number_whatever_the_order(order: tuple[int, ...], route: str) -> None:
    contacts = "\n".join(SMOOTH[i] for i in order)
    asks = planemotion.load_text(beam(contacts, route=route)).run().asks
    for name in ("A", "B", "C", "least"):
        assert asks[name].value is None
        assert "not unique" in asks[name].reason
    assert asks["all"].value == pytest.approx(98.1, rel=1e-12)
    assert asks["moment"].value == pytest.approx(0, abs=1e-10)


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_the_least_share_is_that_of_the_normal_equations(order: tuple[int, ...]) -> None:
    """min sum N^2 with sum N = m g and sum x N = 0: N = a + b x, and all push."""
    contacts = "\n".join(SMOOTH[i] for i in order)
    asks = planemotion.load_text(beam(contacts, "least")).run().asks
    sums = (3, 1, 9)  # of 1, x and x^2
    a = 98.1 * sums[2] / (sums[0] * sums[2] - sums[1] ** 2)
    b = -98.1 * sums[1] / (sums[0] * sums[2] - sums[1] ** 2)
    for name, x in zip("ABC", (-2, 1, 2), strict=True):
        assert asks[name].value == pytest.approx(a + b * x, rel=1e-11)


def test_a_least_share_that_would_pull_is_none() -> None:
    """The mass centre near A: least squares alone would have C pull; then A and B carry all."""
    contacts = "\n".join(SMOOTH)
    text = beam(contacts, "least", at='[0, 0]\nmass_center = ["-1.5 m", 0]')
    asks = planemotion.load_text(text).run().asks
    assert asks["C"].value == pytest.approx(0, abs=1e-6)
    assert asks["all"].value == pytest.approx(98.1, rel=1e-9)


def test_a_rod_that_is_pinned_at_both_ends_has_loads_across_it() -> None:
    pins = """
A = { pin = ["rod.A", "ground.A"] }
B = { pin = ["rod.B", "ground.B"] }
"""
    both = 'both = "A.force.x on rod + B.force.x on rod"'
    scene = planemotion.load_text(rod_on_two_pins(pins, "start") + both)
    asks = scene.run().asks
    assert asks["Ax"].value is None
    assert asks["Ay"].value == pytest.approx(49.05, rel=1e-12)
    assert asks["By"].value == pytest.approx(49.05, rel=1e-12)
    assert asks["both"].value == pytest.approx(0, abs=1e-12)


def test_a_ladder_that_rubs_at_both_ends_slips_when_both_do() -> None:
    """N_A = m g L cos / 2 / (L sin + mu_A L cos), N_B = m g - mu_A N_A, push = mu_B N_B - N_A."""
    text = """
until = "go"
[ground]
lines = { floor = { through = [0, 0] }, wall = { through = [0, 0], angle = "-90 deg" } }
[bodies.ladder]
rod = ["A", "B"]
length = "4 m"
mass = "10 kg"
angle = "-60 deg"
at = { A = [0, "3.46410161513775458 m"] }
[contacts]
A = { touch = ["ladder.A", "ground.wall"], friction = 0.4 }
B = { touch = ["ladder.B", "ground.floor"], friction = 0.5 }
[forces]
push = { force = "ladder.B", value = ["(20 N/s)*t", 0] }
[events]
go = "B slips"
[ask]
t = "t"
N = { of = "A.normal", at = "go" }
lift = { of = "A.force.y on ladder + B.force.y on ladder", at = { each = "t", values = ["0.5 s"] } }
part = { of = "A.normal", at = { each = "t", values = ["0.5 s"] } }
"""
    asks = planemotion.load_text(text).run().asks
    up, along = 4 * math.sin(math.pi / 3), 2.0
    wall = 98.1 * along / 2 / (up + 0.4 * along)
    assert asks["t"].value == pytest.approx((0.5 * (98.1 - 0.4 * wall) - wall) / 20, rel=1e-10)
    assert asks["lift"].value == [pytest.approx(98.1, rel=1e-12)]
    assert asks["part"].value == [None]


def test_an_impulse_that_is_shared_has_no_number() -> None:
    """Three feet meet the floor at once: the sum is m v, the parts are anything."""
    text = beam("\n".join(SMOOTH), at='[0, "1 m"]').split("[ask]")[0]
    text += """[events]
lands = "A strikes"
[ask]
one = { of = "A.impulse.y on beam", at = "lands" }
all = { of = "A.impulse.y on beam + B.impulse.y on beam + C.impulse.y on beam", at = "lands" }
"""
    asks = planemotion.load_text(text).run().asks
    assert asks["one"].value is None
    assert "not unique" in asks["one"].reason
    assert asks["all"].value == pytest.approx(10 * math.sqrt(2 * G), rel=1e-9)
    least = planemotion.load_text(text.replace('shared = "none"', 'shared = "least"')).run().asks
    assert least["one"].value == pytest.approx(10 * math.sqrt(2 * G) * 11 / 26, rel=1e-8)


def test_an_event_cannot_wait_for_a_load_that_is_not_unique() -> None:
    text = beam("\n".join(SMOOTH)) + 'n = "high.count"\n[events]\n'
    result = planemotion.load_text(text + 'high = "A.normal > (60 N)"\n').run()
    assert result.status == "not_unique"
    assert "events.high: it waits for a load that is not unique" in result.error
    told = planemotion.load_text(text + 'high = "A.normal + B.normal + C.normal > (60 N)"\n').run()
    assert told.status == "ok"


BARS = {
    "ab": '["A", "B"]',
    "ca": '["ground.C", "A"]',
    "db": '["ground.D", "B"]',
    "cb": '["ground.C", "B"]',
    "da": '["ground.D", "A"]',
}


@pytest.mark.parametrize("order", list(itertools.permutations(BARS))[::13])
def test_a_truss_with_a_bar_too_many(order: tuple[str, ...]) -> None:
    """Two joints that five bars hold: one force is free, and the sums at each joint are weights."""
    text = """
until = "start"
[ground]
points = { C = [0, 0], D = [0, "1 m"] }
[bodies]
A = { mass = "10 kg", at = ["1 m", 0] }
B = { mass = "1 kg", at = ["1 m", "1 m"] }
[ask]
bar = "cb.force.norm"
across = "ca.force.x on A + da.force.x on A"
up = "ca.force.y on A + da.force.y on A + ab.force.y on A"
[joints]
"""
    scene = planemotion.load_text(text + "\n".join(f"{bar} = {{ link = {BARS[bar]} }}" for bar in order))
    asks = scene.run().asks
    assert asks["bar"].value is None
    assert asks["across"].value == pytest.approx(0, abs=1e-10)
    assert asks["up"].value == pytest.approx(98.1, rel=1e-12)
    (group,) = call.check(scene.tables()[0]).shared
    assert sorted(group) == sorted(f"joints.{bar}" for bar in BARS)
