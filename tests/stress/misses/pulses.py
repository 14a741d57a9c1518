"""Forces of time that act now and then: on a particle that is free, or on a spring.

Each pulse is a rectangle, a bell or a half sine, of a width from a millionth of the run to all of it.  The
truth is its integral with what an impulse at that time does to the end of the run.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import planemotion
from planemotion.engine.call import run_cases
from tests.stress.contacts.laws import Array
from tests.stress.misses.verdict import ROUNDING, Verdict, judge

SHAPES = {
    "rectangle": "(J{i}/w{i})*(t >= c{i} - w{i}/2)*(t < c{i} + w{i}/2)",
    "bell": "(J{i}/w{i})*exp(-((t - c{i})/w{i})^2)",
    "half sine": "(J{i}/w{i})*cos(pi*(t - c{i})/w{i})*(t > c{i} - w{i}/2)*(t < c{i} + w{i}/2)",
}
BELL = 6.5  # widths on both sides of its middle: beyond it is less than 1e-18
SPRING = 40.0  # N/m, on 1 kg
NODES, WEIGHTS = np.polynomial.legendre.leggauss(120)


@dataclass(frozen=True)
class Train:
    """Its pulses' shapes; whether a spring holds what they push; the route."""

    shapes: tuple[str, ...]
    spring: bool
    route: str

    def text(self) -> str:
        force = " + ".join(SHAPES[shape].format(i=i) for i, shape in enumerate(self.shapes))
        pulses = range(len(self.shapes))
        return "\n".join(
            [
                'until = "t = 1 s"\nplane = "horizontal"\n[parameters]',
                *(f'J{i} = "1 N*s"\nc{i} = "0.5 s"\nw{i} = "0.1 s"' for i in pulses),
                '[bodies.k]\nmass = "1 kg"\nat = [0, 0]\n[forces]',
                f'push = {{ force = "k", value = ["{force}", 0] }}',
                f'hold = {{ spring = ["k", "ground.O"], stiffness = "{SPRING} N/m" }}' if self.spring else "",
                '[ground.points]\nO = [0, 0]\n[ask]\nv = "k.velocity.x"\nx = "k.x"',
                f'[solve]\nroute = "{self.route}"' if self.route else "",
            ]
        )


def draw(rng: np.random.Generator) -> Train:
    return Train(
        shapes=tuple(str(one) for one in rng.choice(list(SHAPES), rng.integers(1, 4))),
        spring=bool(rng.uniform() < 0.5),
        route=str(rng.choice(["", "rk", "ida"], p=[0.5, 0.4, 0.1])),
    )


def _integral(shape: str, impulse: Array, middle: Array, width: Array, spring: bool) -> tuple[Array, Array]:
    """Velocity and place at t = 1 s by one pulse, [n] each."""
    half = BELL * width if shape == "bell" else width / 2
    low, high = np.maximum(middle - half, 0), np.minimum(middle + half, 1)
    t = 0.5 * (low + high)[:, None] + 0.5 * (high - low)[:, None] * NODES
    u = (t - middle[:, None]) / width[:, None]
    force = {"rectangle": np.ones_like(u), "bell": np.exp(-(u**2)), "half sine": np.cos(np.pi * u)}[shape]
    weight = 0.5 * (high - low)[:, None] * WEIGHTS * force * (impulse / width)[:, None]
    omega, left = np.sqrt(SPRING), 1 - t
    speed, place = (np.cos(omega * left), np.sin(omega * left) / omega) if spring else (np.ones_like(t), left)
    return (weight * speed).sum(axis=1), (weight * place).sum(axis=1)


def table(seed: int, n: int) -> tuple[Train, Verdict, Array]:
    """A train, what became of n cases of it, and their parameters [n, 3 pulses]: J, c, w of each."""
    rng = np.random.default_rng([18, seed])
    train = draw(rng)
    (flat,) = planemotion.load_text(train.text()).tables()
    k = len(train.shapes)
    columns = {"g": np.full(n, 9.81)}
    truth, size, rounding = np.zeros((n, 2)), np.zeros((n, 1)), np.full((n, 1), ROUNDING)
    for i, shape in enumerate(train.shapes):
        impulse = rng.choice([-1, 1], n) * rng.uniform(0.1, 1, n)
        width, middle = 10 ** rng.uniform(-6, 0, n), rng.uniform(0, 1, n)
        columns |= {f"J{i}": impulse, f"c{i}": middle, f"w{i}": width}
        truth += np.stack(_integral(shape, impulse, middle, width, train.spring), axis=1)
        size[:, 0] += np.abs(impulse)
        rounding[:, 0] += 4 * np.finfo(float).eps / width  # its ends are doubles near to each other
    given = np.stack([columns[name] for name in flat.parameters], axis=1)
    found = run_cases(flat, given)
    drawn = np.stack([columns[f"{name}{i}"] for i in range(k) for name in "Jcw"], axis=1)
    return train, judge(found, truth, size, rounding), drawn
