"""One body on up to four contacts: blows, and starts from rest, as rows of parameters of one scene."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, fields

import numpy as np

import planemotion
from planemotion.compile.flatten import FlatScene
from planemotion.engine.call import run_cases
from planemotion.engine.outcome import CaseResults
from tests.stress.contacts.laws import CLOSE, Array, Problem
from tests.stress.contacts.verdict import verdict

LAWS = ("newton", "poisson", "stronge")


@dataclass
class Drawn:
    """n cases of k contacts: mass, before [n, 3], place [n, k, 2], angle, friction, restitution [n, k]."""

    mass: Array
    place: Array
    angle: Array
    friction: Array
    restitution: Array
    before: Array

    def case(self, i: int) -> Drawn:
        """This one alone."""
        return Drawn(*(getattr(self, field.name)[i : i + 1] for field in fields(self)))

    def mirrored(self) -> Drawn:
        flip = np.array([-1, 1])
        return Drawn(
            self.mass,
            self.place * flip,
            -self.angle,
            self.friction,
            self.restitution,
            self.before * np.array([-1, 1, -1]),
        )

    def problem(self, i: int) -> Problem:
        s, c = np.sin(self.angle[i]), np.cos(self.angle[i])
        x, y = self.place[i].T
        normal = np.stack([-s, c, x * c + y * s], axis=1)
        tangent = np.stack([c, s, x * s - y * c], axis=1)
        return Problem(
            self.mass[i],
            np.stack([normal, tangent], axis=1),
            self.friction[i],
            self.restitution[i],
            self.before[i],
        )


def draw(rng: np.random.Generator, n: int, k: int, *, blow: bool) -> Drawn:
    """Contacts all around a body, each tilted from the direction of its centre; some smooth, some plastic."""
    around = rng.uniform(0, 2 * np.pi, (n, 1)) + rng.uniform(0.3, 2.2, (n, k)).cumsum(axis=1)
    place = (rng.uniform(0.1, 0.5, (n, k)) * np.array([np.cos(around), np.sin(around)])).transpose(1, 2, 0)
    some = rng.uniform(size=(n, k))
    smooth = rng.uniform(size=(n, 1)) < 0.1
    restitution = np.where(rng.uniform(size=(n, k)) < 0.3, 0, rng.uniform(0, 1, (n, k)))
    angle, before = (
        around + np.pi / 2 + rng.uniform(-1, 1, (n, k)),
        rng.normal(size=(n, 3)) * np.array([1, 1, 4]),
    )
    if blow:  # what parts takes no part: seen from its other side it approaches
        towards = -np.sin(angle), np.cos(angle)
        lever = place[..., 0] * towards[1] - place[..., 1] * towards[0]
        rate = before[:, :1] * towards[0] + before[:, 1:2] * towards[1] + before[:, 2:] * lever
        angle = np.where(rate > 0, angle + np.pi, angle)
    return Drawn(
        mass=np.array([1, 1, 0.04]) * rng.uniform(0.3, 3, (n, 1)) * rng.uniform(0.5, 2, (n, 3))[:, [0, 0, 2]],
        place=place,
        angle=angle,
        friction=np.where(smooth | (some < 0.2), 0, 1.2 * some),
        restitution=np.where(smooth, restitution[:, :1], restitution) * blow,
        before=before,
    )


def scene(k: int, law: str, *, blow: bool, turned: bool = False) -> FlatScene:
    """By the parameters of Drawn; in a start `before` are forces by mass.  turned: the last contact first."""
    contacts = [
        f'c{i} = {{ touch = ["b.p{i}", "ground.l{i}"], friction = "f{i}", restitution = "e{i}", '
        f'law = "{law}" }}'
        for i in range(k)
    ]
    names = range(k)
    text = f"""
until = "start"
plane = "horizontal"
[parameters]
m = "1 kg"
j = "1 kg*m^2"
{"".join(f'x{i} = "0 m"; y{i} = "0 m"; a{i} = "0 rad"; f{i} = 0; e{i} = 0; ' for i in names)}
{"u = '0 m/s'; v = '0 m/s'; w = '0 rad/s'" if blow else "u = '0 N'; v = '0 N'; w = '0 N*m'"}
[ground]
lines = {{ {", ".join(f'l{i} = {{ through = ["x{i}", "y{i}"], angle = "a{i}" }}' for i in names)} }}
[bodies.b]
mass = "m"
inertia = "j"
at = [0, 0]
points = {{ {", ".join(f'p{i} = ["x{i}", "y{i}"]' for i in names)} }}
[contacts]
{chr(10).join(reversed(contacts) if turned else contacts)}
{BLOW if blow else START}
[solve]
estimate = false
""".replace("; ", "\n")
    (flat,) = planemotion.load_text(text).tables()
    return flat


BLOW = """
[start]
b = { velocity = ["u", "v"], omega = "w" }
[ask]
x = "b.velocity.x"
y = "b.velocity.y"
r = "b.omega"
"""
START = """
[forces]
push = { force = "b", value = ["u", "v"] }
turn = { couple = "b", value = "w" }
[ask]
x = "b.acceleration.x"
y = "b.acceleration.y"
r = "b.alpha"
"""


def run(flat: FlatScene, x: Drawn, *, blow: bool) -> CaseResults:
    k = x.friction.shape[1]
    size = np.ones(3) if blow else x.mass
    columns = {"m": x.mass[:, 0], "j": x.mass[:, 2]}
    for i in range(k):
        columns |= {f"x{i}": x.place[:, i, 0], f"y{i}": x.place[:, i, 1], f"a{i}": x.angle[:, i]}
        columns |= {f"f{i}": x.friction[:, i], f"e{i}": x.restitution[:, i]}
    columns |= {"g": np.zeros(len(x.mass))} | dict(zip("uvw", (x.before * size).T, strict=True))
    return run_cases(flat, np.stack([columns[name] for name in flat.parameters], axis=1))


# ---- what became of the cases ----
def _same(a: CaseResults, b: CaseResults, i: int, flip: Array, scale: float) -> bool:
    if a.status[i] != b.status[i]:
        return False
    if np.isnan(a.out[i]).any() or np.isnan(b.out[i]).any():
        return bool((np.isnan(a.out[i]) == np.isnan(b.out[i])).all())
    return bool(np.abs(a.out[i] - flip * b.out[i]).max() <= 1e3 * CLOSE * scale)


def table(seed: int, n: int, k: int, law: str, *, blow: bool) -> Counter[str]:
    """n cases of k contacts: how many are right, open by theory, wrong or failed."""
    return Counter(judged(seeded(seed, n, k, law, blow=blow), law, blow=blow))


def seeded(seed: int, n: int, k: int, law: str, *, blow: bool) -> Drawn:
    """The cases of the table that has this seed."""
    return draw(np.random.default_rng([seed, k, LAWS.index(law), blow]), n, k, blow=blow)


def judged(drawn: Drawn, law: str, *, blow: bool) -> list[str]:
    """What became of these cases, as they are, mirrored, and with their contacts in another order."""
    k = drawn.friction.shape[1]
    flat = scene(k, law, blow=blow)
    found = run(flat, drawn, blow=blow)
    mirror = run(flat, drawn.mirrored(), blow=blow)
    turned = run(scene(k, law, blow=blow, turned=True), drawn, blow=blow)
    words = []
    for i in range(len(drawn.mass)):
        x = drawn.problem(i)
        word = verdict(x, found.out[i], int(found.status[i]), found.count[i], law, blow=blow)
        if not _same(found, mirror, i, np.array([-1, 1, -1]), x.scale):
            word = "wrong: mirror image"
        elif not _same(found, turned, i, np.ones(3), x.scale):
            word = "wrong: order in the file"
        words.append(word)
    return words
