"""Contacts with stiffnesses and friction in one blow: beside what scipy integrates, from all sides."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import planemotion
from tests.scenes import number

ROUTES = ["auto", "rk", "ida"]


@dataclass(frozen=True)
class Plate:
    """A plate that falls on a floor, on points of its lower edge."""

    feet: Sequence[float]  # m, along its lower edge from the middle
    stiffness: Sequence[float]
    friction: Sequence[float]
    e: Sequence[float]
    velocity: tuple[float, float, float]
    exponent: float = 1
    mirror: int = 1
    mass: float = 2
    inertia: float = 0.05
    height: float = 0.2  # m, of its centre over the floor

    def text(self, route: str = "auto", *, backwards: bool = False) -> str:
        contacts = [
            f'c{i} = {{ touch = ["plate.P{i}", "ground.floor"], law = "stronge", restitution = {e}, '
            f'friction = {mu}, stiffness = "{k} N/m" }}'
            for i, (k, mu, e) in enumerate(zip(self.stiffness, self.friction, self.e, strict=True))
        ]
        points = ", ".join(
            f'P{i} = ["{self.mirror * x} m", "{-self.height} m"]' for i, x in enumerate(self.feet)
        )
        vx, vy, omega = self.velocity
        impulses = [f'{d}{i} = "c{i}.impulse.{d}"' for i in range(len(self.feet)) for d in "xy"]
        return "\n".join(
            [
                'until = "start"',
                "[ground]",
                "lines = { floor = { through = [0, 0] } }",
                "[bodies.plate]",
                f'mass = "{self.mass} kg"',
                f'inertia = "{self.inertia} kg*m^2"',
                f'at = [0, "{self.height} m"]',
                f"points = {{ {points} }}",
                "[contacts]",
                *(contacts[::-1] if backwards else contacts),
                "[start]",
                f'plate.velocity = ["{self.mirror * vx} m/s", "{vy} m/s"]',
                f'plate.omega = "{self.mirror * omega} rad/s"',
                "[ask]",
                'vx = "plate.velocity.x"',
                'vy = "plate.velocity.y"',
                'omega = "plate.omega"',
                'lost = "energy.lost"',
                *impulses,
                "[solve]",
                f"stiffness_exponent = {self.exponent}",
                f'route = "{route}"',
            ]
        )

    def solved(self, route: str = "auto", *, backwards: bool = False) -> dict[str, float]:
        result = planemotion.load_text(self.text(route, backwards=backwards)).run()
        return {name: number(ask.value) for name, ask in result.asks.items()}

    def rows(self) -> tuple[np.ndarray, np.ndarray]:
        x = np.array(self.feet)
        one, none = np.ones_like(x), np.zeros_like(x)
        return np.stack([none, one, x], 1), np.stack([one, none, self.height * one], 1)

    def integrated(self) -> np.ndarray:
        """Velocities after the blow, by springs in a time of their own and steep friction."""
        normal, along = self.rows()
        inverse = np.array([1 / self.mass, 1 / self.mass, 1 / self.inertia])
        k, mu, e, n = np.array(self.stiffness), np.array(self.friction), np.array(self.e), len(self.feet)

        def slopes(_: float, y: np.ndarray) -> np.ndarray:
            u, s, x = normal @ y[:3], along @ y[:3], np.maximum(y[3:], 0)
            push = k * x**self.exponent
            drag = -mu * push * np.tanh(s / 1e-4)
            rate = np.where(u > 0, -u / e**2, -u) * ((y[3:] > 0) | (u < 0))
            return np.concatenate([inverse * (push @ normal + drag @ along), rate])

        y = np.concatenate([self.velocity, np.zeros(n)])
        for _ in range(400):
            y = solve_ivp(slopes, (0, 0.2), y, method="BDF", rtol=1e-7, atol=1e-9).y[:, -1]
            y[3:] = np.maximum(y[3:], 0)
            if (y[3:] < 1e-7).all() and (normal @ y[:3] > -1e-4).all():
                return y[:3]
        raise AssertionError("it does not end")


def falling(rng: np.random.Generator, feet: int) -> Plate:
    return Plate(
        feet=[float(x) for x in np.round(np.sort(rng.uniform(-0.3, 0.3, feet)), 3)],
        stiffness=[float(k) for k in np.round(3 ** rng.uniform(-1, 1, feet), 3)],
        friction=[float(mu) for mu in np.round(rng.uniform(0, 0.8, feet), 3)],
        e=[float(e) for e in np.round(rng.uniform(0.4, 1, feet), 3)],
        velocity=(
            round(rng.uniform(-1, 1), 3),
            round(rng.uniform(-2, -0.5), 3),
            round(rng.uniform(-1, 1), 3),
        ),
    )


@pytest.mark.parametrize("seed", range(6))
def test_a_plate_rebounds_as_from_springs_that_rub(seed: int) -> None:
    plate = falling(np.random.default_rng(seed), 2 + seed % 2)
    found = plate.solved()
    assert [found[name] for name in ("vx", "vy", "omega")] == pytest.approx(plate.integrated(), abs=1e-3)


@pytest.mark.parametrize("seed", range(10, 30))
def test_laws_hold_on_all_sides(seed: int) -> None:
    """Impulses push, stay in their cones and give the motion; energy closes; all sides agree."""
    plate = falling(np.random.default_rng(seed), 2 + seed % 3)
    found = plate.solved(ROUTES[seed % 3])
    n = len(plate.feet)
    push, drag = (np.array([found[f"{d}{i}"] for i in range(n)]) for d in "yx")
    assert (push >= 0).all()
    assert (np.abs(drag) <= np.array(plate.friction) * push + 1e-9).all()
    normal, along = plate.rows()
    masses = np.array([plate.mass, plate.mass, plate.inertia])
    after, before = np.array([found["vx"], found["vy"], found["omega"]]), np.array(plate.velocity)
    assert masses * (after - before) == pytest.approx(push @ normal + drag @ along, abs=1e-9)
    assert (normal @ after > -1e-9).all()
    assert found["lost"] == pytest.approx(masses @ (before**2 - after**2) / 2, abs=1e-9)
    assert found["lost"] > -1e-12
    back = plate.solved(backwards=True)
    assert back == pytest.approx(found, abs=1e-8)
    other = replace(plate, mirror=-1).solved()
    turned = {name: -value if name[0] in "xo" or name == "vx" else value for name, value in found.items()}
    assert other == pytest.approx(turned, abs=1e-8)


@pytest.mark.parametrize("exponent", [1, 1.5])
def test_without_friction_it_is_the_law_without_friction(exponent: float) -> None:
    plate = falling(np.random.default_rng(1), 3)
    plate = replace(plate, exponent=exponent, friction=[0, 0, 0])
    found = plate.solved()
    smooth = planemotion.load_text(plate.text().replace("friction = 0, ", "")).run()
    assert {name: ask.value for name, ask in smooth.asks.items()} == pytest.approx(found, abs=1e-11)


def test_one_contact_is_struck_by_the_law_of_stronge() -> None:
    """It is the course of one contact, whatever its stiffness."""
    plate = replace(falling(np.random.default_rng(3), 1), velocity=(0.3, -1, 0.2))
    without = planemotion.load_text(
        plate.text().replace(f', stiffness = "{plate.stiffness[0]} N/m"', "")
    ).run()
    assert plate.solved() == pytest.approx({name: ask.value for name, ask in without.asks.items()}, abs=1e-11)


GROOVE = """
until = "start"
[ground.lines]
left = { through = [0, 0], angle = "DOWN deg" }
right = { through = [0, 0], angle = "UP deg" }
[bodies.ball]
sphere = "10 mm"
mass = "3 kg"
at = [0, "RISE mm"]
[contacts]
a = { touch = ["ball.rim", "ground.left"], restitution = 0.9, friction = MU, WITH }
b = { touch = ["ball.rim", "ground.right"], restitution = 0.9, friction = MU, WITH }
[start]
ball.velocity = [0, "-2 m/s"]
ball.omega = 0
[ask]
vy = "ball.velocity.y"
omega = "ball.omega"
lost = "energy.lost"
"""


@pytest.mark.parametrize("mu", [0.2, 0.6])
def test_a_ball_in_a_groove_stays_where_friction_wedges_it(mu: float) -> None:
    """Walls of 20 degrees to its way: it stays where tan 20 deg = 0.364 < mu, and comes out else."""
    angle = np.radians(20)
    text = (
        GROOVE.replace("WITH", 'law = "stronge", stiffness = "1 N/m"')
        .replace("DOWN", "-70")
        .replace("UP", "70")
        .replace("MU", str(mu))
    )
    result = planemotion.load_text(text.replace("RISE", str(10 / np.sin(angle)))).run()
    vy, lost = result.asks["vy"].value, result.asks["lost"].value
    into, out = np.sin(angle) + mu * np.cos(angle), np.sin(angle) - mu * np.cos(angle)
    expected = 0.9 * 2 * np.sqrt(out / into) if out > 0 else 0
    assert vy == pytest.approx(expected, abs=1e-9)
    assert result.asks["omega"].value == pytest.approx(0, abs=1e-9)
    assert lost == pytest.approx(1.5 * (4 - expected**2), abs=1e-8)
    assert result.status == "ok"
