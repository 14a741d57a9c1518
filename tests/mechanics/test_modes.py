"""Modes of small motion: beside the linearised equations written down by hand, and as laws."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

import planemotion
from planemotion import SceneError
from tests.scenes import G, answers, number

TWO = """
[ask]
w = { of = "modes[1].omega" }
d = { of = "modes[1].damping" }
n = { of = "modes.count" }
growth = { of = "modes.growth" }
"""


def modes(text: str, count: int) -> list[tuple[float, float]]:
    """Frequency, rad/s, and damping of all modes of a scene that ends at its start."""
    asks = [f'w{k} = "modes[{k}].omega"\nd{k} = "modes[{k}].damping"' for k in range(1, count + 1)]
    found = answers(text + "\n[ask]\nn = 'modes.count'\n" + "\n".join(asks))
    assert found["n"] == count
    return [(found[f"w{k}"], found[f"d{k}"]) for k in range(1, count + 1)]


def eigenvalues(mass: np.ndarray, rate: np.ndarray, stiffness: np.ndarray) -> list[tuple[float, float]]:
    """The same of M x'' + C x' + K x = 0."""
    n = len(mass)
    block = np.zeros((2 * n, 2 * n))
    block[:n, n:] = np.eye(n)
    block[n:, :n] = -np.linalg.solve(mass, stiffness)
    block[n:, n:] = -np.linalg.solve(mass, rate)
    roots = [x for x in np.linalg.eigvals(block) if x.imag >= 0]
    return sorted((abs(x), -x.real / abs(x)) for x in roots)


def same(found: list[tuple[float, float]], true: list[tuple[float, float]], rel: float = 1e-9) -> None:
    fastest = max(w for w, _ in true)
    assert len(found) == len(true)
    for one, other in zip(sorted(found), sorted(true), strict=True):
        assert one[0] == pytest.approx(other[0], rel=rel, abs=rel * fastest)
        assert one[1] == pytest.approx(other[1], abs=rel)


# ---- closed forms ----


@pytest.mark.parametrize("length", [0.01, 1.2, 300])
def test_a_pendulum(length: float) -> None:
    rod = f'rod = ["A", "B"], length = "{length} m", mass = "3 kg", at = {{ A = [0, 0] }}, angle = "-90 deg"'
    text = f'until = "start"\nbodies.rod = {{ {rod} }}\njoints.A = {{ pin = ["rod.A", "ground"] }}\n'
    same(modes(text, 1), [(math.sqrt(1.5 * G / length), 0)])
    found = answers(text + 'ask = { T = "modes[1].period", growth = "modes.growth" }')
    assert found["T"] == pytest.approx(2 * math.pi / math.sqrt(1.5 * G / length), rel=1e-10)
    assert found["growth"] == 0


def test_an_upright_rod_falls() -> None:
    rod = '{ rod = ["A", "B"], length = "2 m", mass = "3 kg", at = { A = [0, 0] }, angle = "90 deg" }'
    text = f'until = "start"\nbodies.rod = {rod}\njoints.A = {{ pin = ["rod.A", "ground"] }}\n'
    found = answers(text + TWO)
    rate = math.sqrt(1.5 * G / 2)
    assert found["growth"] == pytest.approx(rate, rel=1e-10)
    assert [found["n"], abs(found["d"])] == [2, 1]  # of the two one grows, the other dies away


@pytest.mark.parametrize("c", [0.5, 20])
def test_a_rolling_disk_on_a_spring_and_a_damper(c: float) -> None:
    """M = 3/2 m; with the stiff damper nothing swings."""
    text = f"""
until = "start"
bodies.disk = {{ disk = "0.2 m", mass = "2 kg", at = [0, "0.2 m"] }}
ground.lines.floor = {{ through = [0, 0], angle = 0 }}
ground.points.W = ["1 m", "0.2 m"]
joints.rolls = {{ rolling = ["disk.rim", "ground.floor"] }}
[forces]
k = {{ spring = ["disk.center", "ground.W"], stiffness = "30 N/m", free_length = "1 m" }}
c = {{ damper = ["disk.center", "ground.W"], rate = "{c} N*s/m" }}
"""
    true = eigenvalues(np.array([[3.0]]), np.array([[c]]), np.array([[30.0]]))
    same(modes(text, len(true)), true)


def test_a_parallelogram_hangs_like_a_point() -> None:
    """A loop: coupler of mass M, two rods of mass m and length l: (2 m / 3 + M) l w^2 = (m + M) g."""
    text = """
until = "start"
[bodies]
a = { rod = ["A", "B"], length = "0.8 m", mass = "1 kg", at = { A = [0, 0] }, angle = "-90 deg" }
b = { rod = ["A", "B"], length = "0.8 m", mass = "1 kg", at = { A = ["1.5 m", 0] }, angle = "-90 deg" }
c = { rod = ["A", "B"], length = "1.5 m", mass = "4 kg", at = { A = [0, "-0.8 m"] } }
[joints]
A = { pin = ["a.A", "ground"] }
B = { pin = ["b.A", "ground"] }
C = { pin = ["a.B", "c.A"] }
D = { pin = ["b.B", "c.B"] }
"""
    same(modes(text, 1), [(math.sqrt((1 + 4) * G / ((2 / 3 + 4) * 0.8)), 0)])


def test_a_steady_motion() -> None:
    """A pendulum on the rim of a table that a motor turns: l w^2 = r W^2 (3/2 for a rod)."""
    text = """
until = "start"
plane = "horizontal"
[bodies]
table = { disk = "0.5 m", mass = "2 kg", at = [0, 0], points = { P = ["0.5 m", 0] } }
rod = { rod = ["A", "B"], length = "0.3 m", mass = "1 kg", at = { A = ["0.5 m", 0] } }
[joints]
O = { pin = ["table.center", "ground"] }
P = { pin = ["rod.A", "table.P"] }
[couplings]
motor = { motor = ["table", "ground"], value = "4 rad/s" }
[start]
rod.omega = "4 rad/s"
"""
    same(modes(text, 1), [(4 * math.sqrt(1.5 * 0.5 / 0.3), 0)])


def test_a_free_plate_between_springs_and_one_that_nothing_holds() -> None:
    text = """
until = "start"
plane = "horizontal"
bodies.plate = { plate = ["0.4 m", "0.2 m"], mass = "2 kg", at = [0, 0] }
"""
    assert modes(text, 3) == [(0, 0)] * 3
    grips = ["left", "right"]
    springs = "".join(
        f'k{i} = {{ spring = ["plate.{grip}", "ground.{grip}"], stiffness = "50 N/m", '
        'free_length = "0.3 m" }\n'
        for i, grip in enumerate(grips)
    )
    held = text.replace(
        "at = [0, 0] }",
        'at = [0, 0], points = { left = ["-0.2 m", 0], right = ["0.2 m", 0] } }\n'
        'ground.points = { left = ["-0.6 m", 0], right = ["0.6 m", 0] }',
    )
    tension = 50 * 0.1
    across = 2 * tension / 0.4
    turning = 2 * 0.2 * tension * (0.2 / 0.4 + 1)
    inertia = 2 * (0.4**2 + 0.2**2) / 12
    true = [(math.sqrt(k), 0.0) for k in (100 / 2, across / 2, turning / inertia)]
    same(modes(held + "[forces]\n" + springs, 3), true)


def test_a_bead_in_a_plane_that_turns() -> None:
    """On the axis k - m W^2 draws it back; that the plane slows down farther out is of second order."""
    text = """
until = "start"
plane = "horizontal"
ground.lines.slot = { through = [0, 0], angle = 0 }
ground.points.O = ["-1 m", 0]
bodies.bead = { mass = "0.5 kg", at = [0, 0] }
joints.slot = { slider = ["bead", "ground.slot"] }
spin = { through = [0, 0], angle = "90 deg", inertia = "2 kg*m^2" }
forces.k = { spring = ["bead", "ground.O"], stiffness = "40 N/m", free_length = "1 m" }
start.spin.omega = "5 rad/s"
"""
    same(modes(text, 1), [(math.sqrt(40 / 0.5 - 25), 0)])


# ---- random chains ----


def chain(n: int, seed: int) -> tuple[str, list[tuple[float, float]]]:
    """Hanging rods with torsion springs and dampers, and M, C, K of small angles."""
    draw = random.Random(seed)
    length, mass = ([draw.uniform(0.3, 2) for _ in range(n)] for _ in range(2))
    spring, rate = ([draw.uniform(0, 5) * draw.randint(0, 1) for _ in range(n)] for _ in range(2))
    bodies, joints, forces, y = [], [], [], 0.0
    for i in range(n):
        at = f'{{ A = [0, "{-y!r} m"] }}'
        bodies.append(
            f'b{i} = {{ rod = ["A", "B"], length = "{length[i]!r} m", mass = "{mass[i]!r} kg", at = {at}, '
            'angle = "-90 deg" }'
        )
        y += length[i]
        upper = f"b{i - 1}.B" if i else "ground"
        other = f"b{i - 1}" if i else "ground"
        joints.append(f'p{i} = {{ pin = ["b{i}.A", "{upper}"] }}')
        if spring[i]:
            rest = ', free_angle = "-90 deg"' if not i else ""
            forces.append(
                f'k{i} = {{ torsion = ["b{i}", "{other}"], stiffness = "{spring[i]!r} N*m"{rest} }}'
            )
        if rate[i]:
            forces.append(
                f'c{i} = {{ couple = ["b{i}", "{other}"], value = '
                f'"-({rate[i]!r} N*m*s)*(b{i}.omega{f" - b{i - 1}.omega" if i else ""})" }}'
            )
    order = list(range(n))
    draw.shuffle(order)
    parts = [[part[i] for i in order] for part in (bodies, joints)]
    text = "\n".join(['until = "start"', "[bodies]", *parts[0], "[joints]", *parts[1], "[forces]", *forces])
    m, c, k = (np.zeros((n, n)) for _ in range(3))
    for i in range(n):
        arm = np.array([length[j] if j < i else (length[i] / 2 if j == i else 0) for j in range(n)])
        m += mass[i] * np.outer(arm, arm)
        m[i, i] += mass[i] * length[i] ** 2 / 12
        k += np.diag(mass[i] * G * arm)
        twist = np.array([1.0 if j == i else (-1.0 if j == i - 1 else 0) for j in range(n)])
        k += spring[i] * np.outer(twist, twist)
        c += rate[i] * np.outer(twist, twist)
    return text, eigenvalues(m, c, k)


@pytest.mark.parametrize("seed", range(40))
def test_random_hanging_chains(seed: int) -> None:
    text, true = chain(1 + seed % 6, seed)
    same(modes(text, len(true)), true)


# ---- laws ----


def test_asking_changes_nothing() -> None:
    """A double pendulum that is asked for its modes on its way answers the rest to the same bits."""
    text = """
until = "t = 2 s"
[bodies]
a = { rod = ["A", "B"], length = "1 m", mass = "3 kg", at = { A = [0, 0] }, angle = "-20 deg" }
b = { rod = ["A", "B"], length = "0.7 m", mass = "1 kg", at = { A = "a.B" }, angle = "30 deg" }
[joints]
A = { pin = ["a.A", "ground"] }
B = { pin = ["b.A", "a.B"] }
[events]
down = "a.angle < (-60 deg)"
[ask]
w = "a.omega"
x = "b.B.x"
"""
    plain = planemotion.load_text(text).run()
    asked = planemotion.load_text(text + 'm = { of = "modes[1].omega", at = "down" }\n').run()
    assert number(asked["m"]) > 0
    for key in ("w", "x"):
        assert plain[key] == asked[key]


def test_what_slides_slides_on_and_what_sticks_sticks() -> None:
    """A block on a rough floor, held by a spring: no freedom where it sticks, sqrt(k/m) where it slides."""
    text = """
until = "start"
[bodies.block]
plate = ["0.2 m", "0.1 m"]
mass = "2 kg"
at = [0, "0.05 m"]
corners = ["A", "B", "C", "D"]
[ground]
lines.floor = { through = [0, 0], angle = 0 }
points.W = ["1 m", "0.05 m"]
[contacts]
c = { touch = ["block.corners", "ground.floor"], friction = 0.3 }
[forces]
k = { spring = ["block.center", "ground.W"], stiffness = "50 N/m", free_length = "1 m" }
"""
    assert answers(text + '[ask]\nn = "modes.count"')["n"] == 0
    sliding = text + '[start]\nblock.velocity.x = "1 m/s"\n'
    same(modes(sliding, 1), [(5, 0)])


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        ('x = { max = "modes[1].omega" }', "modes are those of an instant"),
        ('x = "modes.omega"', "which mode? The slowest is modes[1].omega"),
        ('x = "modes[0].omega"', "counted from 1"),
        ('x = "modes[1].count"', "count"),
        ('x = "modes.grows"', "growth"),
    ],
)
def test_messages(ask: str, said: str) -> None:
    text = f'until = "start"\nbodies.m = {{ mass = "1 kg", at = [0, 0] }}\n[ask]\n{ask}\n'
    with pytest.raises(SceneError, match=said.replace("[", r"\[").replace("?", r"\?")):
        planemotion.load_text(text).run()


def test_modes_are_not_watched() -> None:
    text = 'until = "modes[1].omega < (1 rad/s)"\nbodies.m = { mass = "1 kg", at = [0, 0] }\nask.x = "m.x"\n'
    with pytest.raises(SceneError, match="those of an instant"):
        planemotion.load_text(text).run()
