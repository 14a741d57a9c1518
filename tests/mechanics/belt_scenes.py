"""Two wheels on axles and their belt: the scene, and its motion in closed form."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]

WHEELS = """
until = "t = {time!r} s"
plane = "horizontal"
bodies.a = {{ mass = "3 kg", inertia = "{i1!r} kg*m^2", circles = {{ rim = "{r1!r} m" }}, at = [0, 0] }}
ground.points.P = ["{d[0]!r} m", "{d[1]!r} m"]
bodies.b = {{ mass = "5 kg", inertia = "{i2!r} kg*m^2", circles = {{ rim = "{r2!r} m" }}, at = "ground.P" }}
joints.A = {{ pin = ["a.center", "ground"] }}
joints.B = {{ pin = ["b", "ground"] }}
events.slips = "belt slips"
events.sticks = "belt sticks"
[couplings.belt]
belt = ["a.rim", "b.rim"]
crossed = {crossed}
pretension = "{tension!r} N"
friction = {mu!r}
[start]
a.omega = "{w1!r} rad/s"
b.omega = "{w2!r} rad/s"
[ask]
wa = "a.omega"
wb = "b.omega"
T1 = "belt.tension[1]"
T2 = "belt.tension[2]"
slip = "belt.slip"
heat = {{ integral = "(belt.tension[2] - belt.tension[1])*belt.slip", unit = "J" }}
Ax = "A.force.x on a"
Ay = "A.force.y on a"
Bx = "B.force.x on b"
By = "B.force.y on b"
sticks = "sticks.count"
"""


@dataclass(frozen=True)
class Wheels:
    """Two wheels on axles in the ground, and their belt."""

    i1: float = 0.3
    i2: float = 0.8
    r1: float = 0.1
    r2: float = 0.25
    d: tuple[float, float] = (0.9, 0.0)
    crossed: bool = False
    mu: float = 0.3
    tension: float = 50.0
    w1: float = 40.0
    w2: float = 0.0
    time: float = 2.0

    @property
    def text(self) -> str:
        written = vars(self) | {"crossed": str(self.crossed).lower()}
        return WHEELS.format(**written)

    @property
    def sense(self) -> float:
        return -1.0 if self.crossed else 1.0

    def strands(self) -> list[Vector]:
        """Directions from a to b: of the one that leaves a counterclockwise, and of the other."""
        return [strand(np.array(self.d), k * self.r1, k * self.sense * self.r2) for k in (1.0, -1.0)]

    def most(self) -> float:
        """Where it slips, T_1/T_2 is e^(mu wrap) on the circle that it wraps less."""
        one, other = self.strands()
        angle = math.atan2(one[0] * other[1] - one[1] * other[0], float(one @ other))
        wraps = (math.pi - angle, math.pi + angle) if not self.crossed else (math.pi - angle,) * 2
        factor = math.exp(self.mu * min(wraps))
        return 2 * self.tension * (factor - 1) / (factor + 1)

    def load(self, force: float) -> Vector:
        """What both strands do to a, where the belt drives with T_1 - T_2."""
        one, other = self.strands()
        return (self.tension + force / 2) * one + (self.tension - force / 2) * other

    def after(self) -> dict[str, float]:
        """What is asked, by constant accelerations until the slip ends."""
        r = np.array([self.r1, -self.sense * self.r2])
        inertia, w = np.array([self.i1, self.i2]), np.array([self.w1, self.w2])
        slip, most = float(r @ w), self.most()
        force = -math.copysign(most, slip)
        rate = force * float(r @ (r / inertia))
        end = -slip / rate
        time = min(end, self.time)
        heat = most * abs(slip * time + rate * time**2 / 2)
        w = w + force * r / inertia * time
        slips = self.time < end
        force = force if slips else 0.0
        pull = (self.tension + force / 2, self.tension - force / 2)
        load = self.load(force)
        return {
            "wa": w[0], "wb": w[1], "T1": pull[0], "T2": pull[1], "slip": float(r @ w) if slips else 0.0,
            "heat": heat, "Ax": -load[0], "Ay": -load[1], "Bx": load[0], "By": load[1],
            "sticks": int(not slips),
        }  # fmt: skip


def strand(d: Vector, r_a: float, r_b: float) -> Vector:
    """The direction u from a to b, which leave both on their right by r_a and r_b: d.n = r_b - r_a."""
    across = (r_b - r_a) / math.hypot(*d)
    turned = math.atan2(d[1], d[0]) - math.asin(across)
    return np.array([math.cos(turned), math.sin(turned)])
