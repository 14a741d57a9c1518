"""Starts in an equilibrium: beside closed forms, a minimum of the potential, and what is told."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

import numpy as np
import pytest
from scipy.optimize import brentq

import planemotion
from planemotion import SceneError
from tests.scenes import ROUTES, G, answers, fault
from tests.scenes.equilibria import STARTS, kind, pendulum

# ---- closed forms ----


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("drawn", [-60, 0, 5, 80, 100])
def test_a_rod_on_a_torsion_spring(drawn: float, route: str) -> None:
    """It stays where the couples of weight and spring balance, from wherever it is drawn."""
    found = answers(STARTS + pendulum(drawn, f'[solve]\nroute = "{route}"'))
    true = brentq(lambda x: -3 * G * math.cos(x) - 10 * x, -2, 0, xtol=1e-15)
    assert found["angle"] == pytest.approx(true, abs=1e-13)
    assert found["couple"] == pytest.approx(-10 * true, rel=1e-12)
    assert abs(found["omega"]) < 1e-12


def test_the_estimate_covers_the_error() -> None:
    result = planemotion.load_text(STARTS + pendulum(10)).run()
    true = brentq(lambda x: -3 * G * math.cos(x) - 10 * x, -2, 0, xtol=1e-15)
    ask = result.asks["angle"]
    assert isinstance(ask.value, float)
    assert isinstance(ask.error, float)
    assert abs(ask.value - true) <= ask.error < 1e-11


def test_stable_unstable_neutral() -> None:
    free = pendulum(-80).replace('stiffness = "10 N*m/rad"', 'stiffness = "1e-9 N*m/rad"')
    assert kind(STARTS + free) == "in a stable equilibrium"
    upright = free.replace("-80 deg", "85 deg")
    assert kind(STARTS + upright) == "in an unstable equilibrium"
    result = planemotion.load_text(STARTS + upright.replace("1e-9", "1e-30")).run()
    assert result.asks["angle"].value == pytest.approx(math.pi / 2, abs=1e-13)
    assert result.counts["unstable_starts"] == 1
    assert any("unstable" in note for note in result.notes)
    lying = free.replace("until", 'plane = "horizontal"\nuntil', 1).replace("1e-9", "0")
    assert kind(STARTS + lying) == "in a neutral equilibrium"


def test_an_unstable_one_is_left_by_a_nudge() -> None:
    text = pendulum(85, "", "AB.angle = 0 deg").replace("10 N*m/rad", "0 N*m/rad")
    found = answers(
        text.replace("[bodies", '[start]\nequilibrium = true\nnudge = "AB.omega < 0"\n[bodies', 1)
    )
    assert found["omega"] == pytest.approx(-math.sqrt(3 * G / 2), rel=1e-9)


FOUR_BAR = """
[bodies.AB]
rod = ["A", "B"]
length = "0.4 m"
mass = "1 kg"
at = { A = [0, 0] }
angle = "~ANGLE deg"
[bodies.BC]
rod = ["B", "C"]
length = "1 m"
mass = "2 kg"
at = { B = "AB.B" }
angle = "~20 deg"
[bodies.DC]
rod = ["D", "C"]
length = "0.7 m"
mass = "1.5 kg"
at = { D = ["0.9 m", 0] }
angle = "~70 deg"
[joints]
A = { pin = ["AB.A", "ground"] }
B = { pin = ["AB.B", "BC.B"] }
C = { pin = ["BC.C", "DC.C"] }
D = { pin = ["DC.D", "ground.D"] }
[ground.points]
D = ["0.9 m", 0]
H = ["0.3 m", "1.2 m"]
[forces.spring]
spring = ["BC.G", "ground.H"]
stiffness = "60 N/m"
free_length = "0.2 m"
"""


def four_bar_energy(angle: float) -> float:
    """Potential of the linkage on the branch that is drawn."""
    a, c, d = 0.4, 1.0, 0.7
    b = np.array([a * math.cos(angle), a * math.sin(angle)])
    ground = np.array([0.9, 0])
    between = ground - b
    size = float(np.hypot(*between))
    along = (size**2 + c**2 - d**2) / (2 * size)
    across = math.sqrt(c**2 - along**2)
    end = b + along * between / size + across * np.array([-between[1], between[0]]) / size
    g = (b + end) / 2
    stretch = float(np.hypot(*(g - [0.3, 1.2]))) - 0.2
    return G * (1 * b[1] / 2 + 2 * g[1] + 1.5 * end[1] / 2) + 0.5 * 60 * stretch**2


@pytest.mark.parametrize("drawn", [40, 95, 200])
def test_a_four_bar_linkage(drawn: float) -> None:
    """A closed loop: where the slope of the potential over its angle is zero."""
    found = answers(
        STARTS
        + 'until = "t = 0.3 s"\n'
        + FOUR_BAR.replace("ANGLE", str(drawn))
        + '[ask]\na = "AB.angle"\ngrowth = "modes.growth"\n'
    )
    h = 1e-4
    slope = (
        8 * (four_bar_energy(found["a"] + h) - four_bar_energy(found["a"] - h))
        - four_bar_energy(found["a"] + 2 * h)
        + four_bar_energy(found["a"] - 2 * h)
    ) / (12 * h)
    bend = (
        four_bar_energy(found["a"] + h) - 2 * four_bar_energy(found["a"]) + four_bar_energy(found["a"] - h)
    ) / h**2
    assert abs(slope) < 1e-9 * abs(bend)
    assert (found["growth"] > 0) == (bend < 0)


def chain_of(
    n: int, seed: int
) -> tuple[str, np.ndarray, np.ndarray, list[tuple[int, float, float, float, float]]]:
    """Rods on pins from the origin, drawn anyhow; springs from their ends to the ground."""
    rng = random.Random(seed)
    length = np.array([rng.uniform(0.3, 1) for _ in range(n)])
    mass = np.array([rng.uniform(0.5, 3) for _ in range(n)])
    springs = [
        (i, rng.uniform(20, 200), rng.uniform(0.1, 0.5), rng.uniform(-2, 2), rng.uniform(-2, 2))
        for i in rng.sample(range(n), 2)
    ]
    lines = ['until = "start"', STARTS]
    for i in range(n):
        at = "[0, 0]" if i == 0 else f'"b{i - 1}.Q"'
        mark = "" if i == 0 else "~"
        lines.append(
            f'[bodies.b{i}]\nrod = ["P", "Q"]\nlength = "{length[i]} m"\nmass = "{mass[i]} kg"\n'
            f'at = {{ P = {at} }}\nangle = "{mark}{rng.uniform(-150, -30)} deg"'
        )
    for i in range(n):
        partner = "ground" if i == 0 else f"b{i - 1}.Q"
        lines.append(f'[joints.j{i}]\npin = ["b{i}.P", "{partner}"]')
    for k, (i, stiffness, free, x, y) in enumerate(springs):
        lines.append(f'[ground.points]\nS{k} = ["{x} m", "{y} m"]' if k == 0 else "")
        lines.append(
            f'[forces.s{k}]\nspring = ["b{i}.Q", "ground.S{k}"]\nstiffness = "{stiffness} N/m"\n'
            f'free_length = "{free} m"'
        )
    x1, y1 = springs[1][3], springs[1][4]
    text = "\n".join(lines).replace("[forces.s0]", f'S1 = ["{x1} m", "{y1} m"]\n[forces.s0]', 1)
    text += "\n[ask]\n" + "\n".join(f'a{i} = "b{i}.angle"' for i in range(n)) + '\ngrowth = "modes.growth"\n'
    return text, length, mass, springs


def gradient(
    angles: Sequence[float] | np.ndarray,
    length: np.ndarray,
    mass: np.ndarray,
    springs: list[tuple[int, float, float, float, float]],
) -> np.ndarray:
    """Of the potential, by the angles."""
    angles = np.asarray(angles)
    n = len(angles)
    along = length[:, None] * np.stack([np.cos(angles), np.sin(angles)], 1)
    across = length[:, None] * np.stack([-np.sin(angles), np.cos(angles)], 1)
    ends = np.cumsum(along, 0)
    slope = np.zeros(n)
    for i in range(n):
        slope[: i + 1] += mass[i] * G * across[: i + 1, 1]
        slope[i] -= mass[i] * G * across[i, 1] / 2
    for i, stiffness, free, x, y in springs:
        d = ends[i] - [x, y]
        size = float(np.hypot(*d))
        slope[: i + 1] += stiffness * (size - free) / size * (across[: i + 1] @ d)
    return slope


@pytest.mark.parametrize("seed", range(12))
def test_random_chains(seed: int) -> None:
    """All forces balance, and it is stable if the potential has a minimum there."""
    text, length, mass, springs = chain_of(2 + seed % 4, seed)
    found = answers(text)
    angles = np.array([found[f"a{i}"] for i in range(len(length))])
    slope = gradient(angles, length, mass, springs)
    h = 1e-5
    bend = np.array(
        [
            (
                gradient(angles + h * e, length, mass, springs)
                - gradient(angles - h * e, length, mass, springs)
            )
            / (2 * h)
            for e in np.eye(len(length))
        ]
    )
    assert np.abs(np.linalg.solve(bend, slope)).max() < 1e-12
    assert (found["growth"] > 0) == (np.linalg.eigvalsh((bend + bend.T) / 2)[0] < 0)


# ---- contacts and friction ----


def test_a_governor() -> None:
    """In a plane that turns: the rate of the start is given, and the masses stand where it balances them."""
    text = """
start = { equilibrium = true, "spin.omega" = "4 rad/s" }
until = "t = 0.5 s"
[spin]
through = [0, 0]
angle = "90 deg"
inertia = "100 kg*m^2"
[bodies.arm]
rod = ["A", "B"]
length = "1.5 m"
mass = "2 kg"
at = { A = [0, 0] }
angle = "-60 deg"
[joints.A]
pin = ["arm.A", "ground"]
[ask]
angle = "arm.angle"
rate = "spin.omega"
"""
    found = answers(text)
    # m g l/2 sin = w^2 m l^2/3 sin cos, from below
    assert math.cos(found["angle"] + math.pi / 2) == pytest.approx(1.5 * G / (16 * 1.5), rel=1e-10)
    assert found["rate"] == pytest.approx(4, rel=1e-12)


# ---- what is none ----


def test_no_equilibrium() -> None:
    text = STARTS + 'until = "t = 1 s"\n[bodies.ball]\nmass = "1 kg"\nat = [0, 0]\n'
    message = fault(text)
    assert "bodies.ball" in message
    assert "9.81 m/s^2" in message


def test_what_is_driven_moves() -> None:
    text = pendulum(0).replace(
        'pin = ["AB.A", "ground"]', 'pin = ["AB.A", "ground"]\nangle = "(2 rad/s) * t"'
    )
    assert "bodies.AB" in fault(STARTS + text.replace('angle = "0 deg"', 'angle = "~0 deg"'))


def test_a_velocity_contradicts_it() -> None:
    with pytest.raises(SceneError, match="at rest") as error:
        planemotion.load_text(pendulum(0) + '[start]\nequilibrium = true\nAB.omega = "1 rad/s"\n').run()
    assert error.value.path == "start.AB.omega"
    with pytest.raises(SceneError, match='start = "equilibrium"'):
        planemotion.load_text('start = "rest"\n' + pendulum(0))


def test_sweeps_start_each_case_in_its_own() -> None:
    scene = planemotion.load_text(
        STARTS + pendulum(-45).replace('"10 N*m/rad"', '"k"') + '[parameters]\nk = "10 N*m/rad"\n'
    )
    for k in (3, 30, 300):
        true = brentq(lambda x, k=k: -3 * G * math.cos(x) - k * x, -2, 0, xtol=1e-15)
        assert scene.run(k=f"{k} N*m/rad").asks["angle"].value == pytest.approx(true, abs=1e-12)
