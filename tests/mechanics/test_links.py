"""Bodies on links: their own coordinates beside all constraints at once, and beside closed forms."""

from __future__ import annotations

import math
import random

import pytest
from scipy.special import ellipk

import planemotion
from planemotion import _layout as layout
from planemotion.engine import call
from tests.scenes import G, answers


def hung(chosen: random.Random) -> str:
    """A random tree of particles and rods that hang on links, from the ground and from each other."""
    bodies, joints, asks = [], [], []
    marks = [("ground.O", 0.0, 0.0)]
    for i in range(chosen.randint(1, 5)):
        mark, x, y = chosen.choice(marks)
        length, angle = chosen.uniform(0.3, 1), chosen.uniform(-math.pi, math.pi)
        x, y = x + length * math.cos(angle), y + length * math.sin(angle)
        name, mass = f"b{i}", f'mass = "{chosen.uniform(0.2, 2)!r} kg"'
        if chosen.random() < 0.5:
            bodies.append(
                f'{name} = {{ mass = "{chosen.uniform(0.2, 2)!r} kg", at = ["{x!r} m", "{y!r} m"] }}'
            )
            own, tips = name, [(name, x, y)]
        else:
            turn, size = chosen.uniform(-3, 3), chosen.uniform(0.3, 1)
            bodies.append(
                f'{name} = {{ rod = ["A", "B"], length = "{size!r} m", {mass}, '
                f'at = {{ A = ["{x!r} m", "{y!r} m"] }}, angle = "{turn!r} rad" }}'
            )
            own, tips = f"{name}.A", [(f"{name}.B", x + size * math.cos(turn), y + size * math.sin(turn))]
        pair = [mark, own]
        chosen.shuffle(pair)
        joints.append(f'j{i} = {{ link = ["{pair[0]}", "{pair[1]}"] }}')
        asks.append(
            f'x{i} = {{ of = "{name}.x", unit = "m" }}\nN{i} = {{ of = "j{i}.force.norm", unit = "N" }}'
        )
        marks += tips
    spring = ""
    if chosen.random() < 0.5:
        ends = f'spring = ["{marks[-1][0]}", "ground.W"]'
        spring = f'[forces.k]\n{ends}\nstiffness = "20 N/m"\nfree_length = "0.5 m"\n'
    return "\n".join(
        [
            'until = "t = 0.7 s"',
            '[ground]\npoints = { O = [0, 0], W = ["1.5 m", "0.4 m"] }',
            "[bodies]",
            *bodies,
            "[joints]",
            *joints,
            spring,
            "[ask]",
            *asks,
        ]
    )


@pytest.mark.parametrize("seed", range(12))
def test_trees_on_links_go_as_all_constraints_make_them(seed: int) -> None:
    text = hung(random.Random(seed))
    found = answers(text, "auto")
    for name, value in answers(text, "ida").items():
        assert found[name] == pytest.approx(value, rel=1e-6, abs=1e-6), (name, text)


LEVEL = """
until = "t = END s"
[solve]
estimate = false
[ground]
points.O = [0, 0]
[bodies]
P = { mass = "2 kg", at = ["-1 m", 0] }
[joints]
rod = { link = PARTNERS }
[ask]
x = { of = "P.x", unit = "m" }
lowest = { max = "rod.force.norm", unit = "N" }
T = { period = "P.x", about = "0 m" }
"""


@pytest.mark.parametrize("partners", ['["P", "ground.O"]', '["ground.O", "P"]'])
def test_a_particle_on_a_link_swings_by_the_elliptic_integral(partners: str) -> None:
    """From level: T = 4 K(1/2) sqrt(L/g), and 3 m g at the bottom; swings like the last are passed over."""
    period = float(4 * ellipk(0.5) / math.sqrt(G))
    text = LEVEL.replace("PARTNERS", partners).replace("END", repr(100.25 * period))
    found = answers(text, "auto")
    assert found["x"] == pytest.approx(0, abs=1e-11)
    assert found["lowest"] == pytest.approx(3 * 2 * G, rel=1e-13)
    assert found["T"] == pytest.approx(period, rel=1e-12)


def test_a_link_needs_few_steps_and_no_swing_twice() -> None:
    """Rounding makes no two places of one place of rest: the ends of its swing are level with O."""
    period = float(4 * ellipk(0.5) / math.sqrt(G))
    text = LEVEL.replace("PARTNERS", '["P", "ground.O"]').replace("END", repr(50.2 * period))
    (flat,) = planemotion.load_text(text.split("lowest")[0]).tables()
    (counts,) = call.run_cases(flat, [flat.defaults]).count
    assert counts[layout.PM_COUNT_STEPS] <= 12
    assert counts[layout.PM_COUNT_REPEATED_SEGMENTS] >= 15
