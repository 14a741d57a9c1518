"""Chains of equal links by an index: beside their equations in the angles, integrated by scipy."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.integrate import solve_ivp

import planemotion as pm
from tests.scenes import ROUTES, G
from tests.scenes.chain import chain

STUDIES = Path(__file__).parents[2] / "studies"
Floats = npt.NDArray[np.float64]


def motion(n: int, length: float, mass: float) -> Callable[[float, Floats], Floats]:
    """The equations of n rods in their angles: sum_j A_ij (cos(i-j) a_j + sin(i-j) w_j^2) = -g b_i cos i."""
    arm = np.tril(np.full((n, n), length), -1) + np.diag(np.full(n, length / 2))
    inertia = mass * arm.T @ arm + np.eye(n) * mass * length**2 / 12
    weight = mass * G * arm.sum(axis=0)

    def slope(_: float, state: Floats) -> Floats:
        angle, omega = np.split(state, 2)
        apart = angle[:, None] - angle
        right = -weight * np.cos(angle) - inertia * np.sin(apart) @ omega**2
        return np.concatenate([omega, np.linalg.solve(inertia * np.cos(apart), right)])

    return slope


def angles(n: int, end: float) -> Floats:
    begin = np.concatenate([np.radians(-20.0) * np.arange(1, n + 1), 0.3 * np.arange(1, n + 1)])
    made = solve_ivp(motion(n, 0.5, 0.8), (0, end), begin, method="DOP853", rtol=1e-13, atol=1e-13)
    return np.asarray(made.y[:n, -1])


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("n", [1, 2, 5])
def test_a_chain_of_n_links_moves_as_its_equations_say(n: int, route: str) -> None:
    found: Any = pm.load_text(chain("0.6 s")).with_values({"n": n, "solve.route": route}).run()
    wanted = angles(n, 0.6)
    for i in range(n):
        assert found[f"angle[{i + 1}]"] == pytest.approx(wanted[i], abs=1e-9 if route != "ida" else 1e-7)
        error = found.asks[f"angle[{i + 1}]"].error
        assert abs(found[f"angle[{i + 1}]"] - wanted[i]) <= 3 * error + 1e-11
    assert found["tip"] == pytest.approx(0.5 * np.sin(wanted).sum(), abs=1e-9 if route != "ida" else 1e-7)


@pytest.mark.parametrize("n", [50, 80])
def test_a_chain_of_many_links_moves_as_its_equations_say(n: int) -> None:
    """In its own coordinates, and by all its constraints together: the longer one."""
    found: Any = pm.load_text(chain("0.02 s")).with_values({"n": n, "solve.route": "rk"}).run()
    wanted = angles(n, 0.02)
    for i in range(n):
        assert found[f"angle[{i + 1}]"] == pytest.approx(wanted[i], abs=1e-9)
        error = found.asks[f"angle[{i + 1}]"].error
        assert abs(found[f"angle[{i + 1}]"] - wanted[i]) <= 3 * error + 1e-11


def test_the_study_of_a_falling_chain_begins_with_the_rod_of_the_textbooks() -> None:
    found = pm.load(STUDIES / "falling_chain.toml").sweep()
    assert found["n"].values.tolist() == [1, 2, 3, 4, 5, 6, 8]
    assert (found["status"] == 0).all()
    assert float(found["v"][0]) == pytest.approx(np.sqrt(3 * G), abs=1e-9)
    assert float(found["pull"][0]) == pytest.approx(2.5 * G, abs=1e-8)
    for row, n in enumerate(found["n"].values.astype(int)):
        begin = np.zeros(2 * n)
        end = solve_ivp(
            motion(n, 1 / n, 1 / n), (0, 2), begin, method="DOP853", rtol=1e-13, atol=1e-13, events=hangs
        )
        angle, omega = np.split(end.y_events[0][0], 2)
        speed = np.hypot(*(omega @ np.column_stack([-np.sin(angle), np.cos(angle)]))) / n
        assert float(found["time"][row]) == pytest.approx(end.t_events[0][0], abs=1e-9)
        assert float(found["v"][row]) == pytest.approx(speed, abs=1e-8)


def hangs(_: float, state: Floats) -> float:
    return float(state[0] + np.pi / 2)


hangs.terminal = True  # type: ignore[attr-defined]


def test_two_levels_of_parts_move_as_the_scene_written_out() -> None:
    """Legs of a table of templates, with links by an index, whose number each leg chooses."""
    text = """
until = "t = 0.4 s"
[parameters]
apart = "2 m"
[templates.leg]
parameters = { k = 2, r = "0.4 m", x = "0 m" }
ground.points.O = ["x", 0]
bodies."rod[j]" = { for = "j in 1..k", rod = ["A", "B"], length = "r", mass = "(1 kg)*j", angle = "-30 deg" }
joints.A = { pin = ["rod[1].A", "ground.O"] }
joints."A[j]" = { for = "j in 2..k", pin = ["rod[j-1].B", "rod[j].A"] }
ask.y = "rod[k].B.y"
ask.pull = "A.force.y on rod[1]"
[templates.pair]
parameters.k = 1
parts."leg[i]" = { for = "i in 1..2", use = "leg", with = { x = "i*apart", k = "k*i" } }
ask.difference = "leg[2].rod[k].B.y - leg[1].rod[k].B.y"
[parts.front]
use = "pair"
[ask]
higher = "front.leg[1].y - front.leg[2].y"
"""
    plain = """
until = "t = 0.4 s"
[ground.points]
O1 = ["2 m", 0]
O2 = ["4 m", 0]
[bodies]
a = { rod = ["A", "B"], length = "0.4 m", mass = "1 kg", angle = "-30 deg" }
b = { rod = ["A", "B"], length = "0.4 m", mass = "1 kg", angle = "-30 deg" }
c = { rod = ["A", "B"], length = "0.4 m", mass = "2 kg", angle = "-30 deg" }
[joints]
A = { pin = ["a.A", "ground.O1"] }
B = { pin = ["b.A", "ground.O2"] }
C = { pin = ["b.B", "c.A"] }
[ask]
y1 = "a.B.y"
y2 = "c.B.y"
pull1 = "A.force.y on a"
pull2 = "B.force.y on b"
difference = "b.B.y - a.B.y"
"""
    wanted: Any
    made, wanted = pm.load_text(text).run(), pm.load_text(plain).run()
    assert made["front.leg[1].y"] == wanted["y1"]
    assert made["front.leg[2].y"] == wanted["y2"]
    assert made["front.leg[1].pull"] == wanted["pull1"]
    assert made["front.leg[2].pull"] == wanted["pull2"]
    assert made["front.difference"] == wanted["difference"]
    assert made["higher"] == pytest.approx(wanted["y1"] - wanted["y2"], abs=1e-14)


def test_a_chain_of_500_links_is_read_in_time_that_grows_with_it() -> None:
    """Counted in steps of the interpreter's own work, not in seconds: names that are split are what grew."""
    from planemotion.compile.flatten import flatten
    from planemotion.language.names import Names

    counts = []
    split = Names.split
    for n in (50, 500):
        calls = 0

        def counted(self: Names, dotted: str) -> list[str]:
            nonlocal calls
            calls += 1
            return split(self, dotted)

        scene = pm.load_text(chain("0.6 s")).with_values({"n": n})
        Names.split = counted  # type: ignore[method-assign]
        try:
            flat = flatten(scene, history=False)
        finally:
            Names.split = split  # type: ignore[method-assign]
        assert len(flat.bodies) == n
        counts.append(calls)
    assert counts[1] < 11 * counts[0]
