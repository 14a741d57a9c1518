"""Contacts that have stiffnesses in one blow: beside springs, from all sides; messages."""

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import planemotion
from planemotion.report.explain import explain

ROUTES = ["auto", "rk", "ida"]


def chain(
    velocities: Sequence[float],
    stiffness: Sequence[float],
    *,
    e: float = 1,
    exponent: float = 1.5,
    masses: Sequence[float] | None = None,
    turned: int = 1,
    order: Callable[[list[str]], list[str]] = list,
) -> str:
    """Balls in a row that touch; the row goes to the right or (turned = -1) to the left."""
    masses = masses or [1] * len(velocities)
    bodies = [
        f'b{i} = {{ sphere = "10 mm", mass = "{m} kg", at = ["{turned * 20 * i} mm", 0] }}'
        for i, m in enumerate(masses)
    ]
    contacts = [
        f'c{i} = {{ touch = ["b{i}.rim", "b{i + 1}.rim"], restitution = {e}, law = "stronge", '
        f'stiffness = "{k} N/m" }}'
        for i, k in enumerate(stiffness)
    ]
    start = [f'b{i}.velocity.x = "{turned * v} m/s"' for i, v in enumerate(velocities)]
    asks = [f'v{i} = "{turned}*b{i}.velocity.x"' for i in range(len(velocities))]
    parts = ['plane = "horizontal"', 'until = "t = 1 ms"', "[bodies]", *order(bodies)]
    parts += ["[contacts]", *order(contacts), "[start]", *start, "[ask]", *asks, 'lost = "energy.lost"']
    return "\n".join([*parts, "[solve]", f"stiffness_exponent = {exponent}"])


def answers(text: str) -> dict[str, float]:
    """All that is asked."""
    values = {name: ask.value for name, ask in planemotion.load_text(text).run().asks.items()}
    return {name: value for name, value in values.items() if isinstance(value, float)}


def after(text: str) -> list[float]:
    return [value for name, value in answers(text).items() if name.startswith("v")]


def springs(
    velocities: Sequence[float], stiffness: Sequence[float], exponent: float, masses: Sequence[float]
) -> np.ndarray:
    """Balls with springs between them that push while they are compressed, until all have parted."""
    n = len(velocities)
    k, m = np.array(stiffness), np.array(masses)

    def slopes(_: float, y: np.ndarray) -> np.ndarray:
        force = k * np.maximum(y[: n - 1] - y[1:n], 0) ** exponent
        return np.concatenate([y[n:], (np.append(0, force) - np.append(force, 0)) / m])

    y = np.concatenate([np.zeros(n), velocities])
    for _ in range(4000):
        y = solve_ivp(slopes, (0, 0.01), y, method="DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        if (np.diff(y[:n]) > 0).all() and (np.diff(y[n:]) > -1e-9).all():
            return y[n:]
    raise AssertionError("they have not parted")


@pytest.mark.parametrize("exponent", [1, 1.5])
@pytest.mark.parametrize("ratio", [1, 2, 7])
def test_three_balls_part_as_from_springs(exponent: float, ratio: float) -> None:
    """Where no gap that has opened closes again during the blow."""
    masses = [1, 0.7, 1.2]
    stiff = [1, ratio]
    found = after(chain([1, 0, 0], stiff, exponent=exponent, masses=masses))
    assert found == pytest.approx(springs([1, 0, 0], stiff, exponent, masses), abs=1e-8)


@pytest.mark.parametrize("route", ROUTES)
def test_cradle_of_spheres(route: str) -> None:
    """Nearly all goes to the last ball, the first comes back a little."""
    text = chain([1, 0, 0], [1, 1]).replace('\nlost = "energy.lost"', "") + f'\nroute = "{route}"'
    result = planemotion.load_text(text).run()
    expected = springs([1, 0, 0], [1, 1], 1.5, [1, 1, 1])
    for i, value in enumerate(expected):
        answer = result.asks[f"v{i}"]
        assert answer.value == pytest.approx(value, abs=1e-8)
        assert answer.error == pytest.approx(0, abs=1e-11)
    assert expected == pytest.approx([-0.070952, 0.076403, 0.994549], abs=1e-6)
    assert np.linalg.norm(after(text)) == pytest.approx(1, abs=1e-12)
    assert result.notes == ()
    assert result.counts["shared_blows"] == result.counts["ordered_blows"] == 0


def test_two_bodies_part_by_their_restitution() -> None:
    for e in (0, 0.3, 0.8, 1):
        assert after(chain([1, -0.5], [40], e=e, masses=[2, 1])) == pytest.approx(
            [0.5 - 0.5 * e, 0.5 + e], abs=1e-12
        )


@pytest.mark.parametrize("e", [0, 0.4, 0.9, 1])
def test_order_side_and_units_change_nothing(e: float) -> None:
    velocities, stiff, masses = [1, 0.2, 0, -0.4], [1, 3, 0.5], [1, 2, 0.5, 1]
    text = chain(velocities, stiff, e=e, masses=masses)
    found, lost = after(text), answers(text)["lost"]
    others = [
        chain(velocities, stiff, e=e, masses=masses, turned=-1),
        chain(velocities, stiff, e=e, masses=masses, order=lambda lines: lines[::-1]),
        chain(velocities, [1000 * k for k in stiff], e=e, masses=masses),
    ]
    for other in others:
        assert after(other) == pytest.approx(found, abs=1e-10)
    assert np.dot(masses, found) == pytest.approx(np.dot(masses, velocities), abs=1e-12)
    assert lost == pytest.approx(0, abs=1e-10) if e == 1 else lost > 0


def test_one_stiff_contact_is_struck_before_the_other() -> None:
    assert after(chain([1, 0, 0], [1e6, 1], exponent=1)) == pytest.approx([0, 0, 1], abs=1e-5)
    assert after(chain([1, 0, 0], [1, 1e6], exponent=1)) == pytest.approx([-1 / 3, 2 / 3, 2 / 3], abs=1e-3)


BEAM = """
until = "start"
[ground]
lines = { floor = { through = [0, 0] } }
[bodies.beam]
rod = ["A", "C"]
length = "2 m"
mass = "3 kg"
at = { A = [0, 0] }
points = { B = ["STEP m", 0] }
[contacts]
a = { touch = ["beam.A", "ground.floor"], law = "stronge", restitution = 1, stiffness = "1 N/m" }
b = { touch = ["beam.B", "ground.floor"], law = "stronge", restitution = 1, stiffness = "KB N/m" }
c = { touch = ["beam.C", "ground.floor"], law = "stronge", restitution = 1, stiffness = "1 N/m" }
[start]
beam.velocity = [0, "-1 m/s"]
beam.omega = 0
[ask]
a = "a.impulse.y"
b = "b.impulse.y"
c = "c.impulse.y"
omega = "beam.omega"
vy = "beam.velocity.y"
"""


def test_stiffnesses_tell_what_rigid_feet_do_not() -> None:
    """A beam falls flat on three feet: alike on both sides, the impulses go by the stiffnesses."""
    values = answers(BEAM.replace("STEP", "0").replace("KB", "2"))
    assert values == pytest.approx({"a": 1.5, "b": 3, "c": 1.5, "omega": 0, "vy": 1}, abs=1e-11)
    moved = answers(BEAM.replace("STEP", "0.3").replace("KB", "2"))
    assert abs(moved["omega"]) > 0.1
    assert moved["vy"] ** 2 + moved["omega"] ** 2 / 3 == pytest.approx(1, abs=1e-11)
    assert moved["a"] + moved["b"] + moved["c"] == pytest.approx(3 * (moved["vy"] + 1), abs=1e-11)


def test_where_one_has_no_stiffness_the_run_says_what_is_assumed() -> None:
    text = chain([1, 0, 0], [1, 1]).replace(', stiffness = "1 N/m"', "", 1)
    result = planemotion.load_text(text).run()
    assert result.counts["shared_blows"] == 1
    assert "a stiffness share it by that" in result.notes[0]


def test_explain_tells_stiffnesses() -> None:
    assert "law stronge, stiffness 7 N/m" in explain(planemotion.load_text(chain([1, 0], [7]))).text


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            'law = "stronge", ',
            "",
            r'contacts\.c0\.stiffness = "7 N/m": a stiffness shares a blow by its work',
        ),
        (
            "stiffness_exponent",
            'impacts = "sequential"\nstiffness_exponent',
            r"contacts\.c0\.stiffness.*one blow",
        ),
        ("7 N/m", "0 N/m", r"contacts\.c0\.stiffness.*must be positive"),
        ("7 N/m", "7 N", r"contacts\.c0\.stiffness.*stiffness"),
        ("stiffness_exponent = 1.5", "stiffness_exponent = 0.5", r"solve\.stiffness_exponent = 0\.5"),
    ],
)
def test_what_does_not_go_with_a_stiffness_is_refused(old: str, new: str, message: str) -> None:
    with pytest.raises(planemotion.SceneError, match=message):
        planemotion.load_text(chain([1, 0], [7]).replace(old, new)).run()


def test_a_blow_that_does_not_end_is_told() -> None:
    refused = r"contacts\.c1\.stiffness: the blow did not end in .* 1e\+12 times as stiff"
    with pytest.raises(planemotion.SimulationError, match=refused):
        planemotion.load_text(chain([1, 0, 0], [1, 1e12], exponent=1)).run()
