"""Kinds of bodies that are pushed from rest, ever harder, at something small that is far away."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from tests.scenes import G
from tests.stress.kinds.drawn import Drawn


@dataclass(frozen=True)
class Thrust:
    """Along x from rest at 0: the acceleration is c t^p, or k^2 (x + near) where `near` is not 0."""

    c: float
    p: int
    k: float
    near: float

    def force(self, mass: float) -> str:
        if self.near:
            return f"{mass * self.k**2!r}*(a.x + ({self.near!r} m))*(1 N/m)"
        return f"{mass * self.c!r}*(1 N)*(t/(1 s))^{self.p}"

    def arrives(self, way: float) -> float:
        if self.near:
            return math.acosh(1 + way / self.near) / self.k
        return float((way * (self.p + 1) * (self.p + 2) / self.c) ** (1 / (self.p + 2)))

    def acceleration(self, t: float) -> float:
        return self.k**2 * self.near * math.cosh(self.k * t) if self.near else float(self.c * t**self.p)

    def speed(self, t: float) -> float:
        if self.near:
            return self.k * self.near * math.sinh(self.k * t)
        return float(self.c * t ** (self.p + 1) / (self.p + 1))

    def place(self, t: float) -> float:
        if self.near:
            return self.near * (math.cosh(self.k * t) - 1)
        return float(self.c * t ** (self.p + 2) / ((self.p + 1) * (self.p + 2)))

    def after(self, t: float, late: float, lost: float) -> tuple[float, float]:
        """Place and speed at t + late, where a blow at t took the speed `lost`."""
        if self.near:
            c, s = math.cosh(self.k * late), math.sinh(self.k * late)
            y, v = self.place(t) + self.near, self.speed(t) - lost
            return y * c + v / self.k * s - self.near, self.k * y * s + v * c
        return self.place(t + late) - lost * late, self.speed(t + late) - lost


def _thrust(draw: random.Random, way: float) -> Thrust:
    if draw.randrange(3):
        p = draw.choice([0, 1, 2, 3, 5])
        return Thrust(way * 10 ** draw.uniform(-2, 2), p, 0, 0)
    return Thrust(0, 0, 10 ** draw.uniform(-1, 1), way * 10 ** draw.uniform(-4, -0.5))


def _scene(
    until: str,
    thrust: Thrust,
    mass: float,
    radius: float,
    target: str,
    contact: str,
    asks: str,
    mark: str = "",
) -> str:
    return f"""
until = "{until}"
plane = "horizontal"
bodies.a = {{ disk = "{radius!r} m", mass = "{mass!r} kg", at = [0, 0]{mark} }}
{target}
forces.f = {{ force = "a", value = ["{thrust.force(mass)}", 0] }}
contacts.c = {{ {contact} }}
events.hit = "c strikes"
[ask]
x = "a.x"
v = "a.velocity.x"
w = "a.velocity.y"
n = "hit.count"
{asks}
"""


def at_a_small_disk(draw: random.Random) -> Drawn:
    """A fixed peg or a free disk, struck head-on or aside: only what is normal to it changes."""
    way, e = 10 ** draw.uniform(0, 2.5), draw.uniform(0.3, 1)
    radii = way * 10 ** draw.uniform(-4, -0.5)
    a, b = draw.uniform(0.2, 0.8) * radii, draw.uniform(-0.97, 0.97) * radii
    mass, other = (10 ** draw.uniform(-1, 1) for _ in range(2))
    fixed = draw.randrange(2)
    nx, ny = math.sqrt(1 - (b / radii) ** 2), b / radii
    thrust = _thrust(draw, way)
    far = way + radii * nx
    t = thrust.arrives(way)
    fast = thrust.speed(t) * nx
    push = (1 + e) * fast / (1 / mass + (0 if fixed else 1 / other))
    shape = f'"{radii - a!r} m"'
    target = f'ground.circles.b = {{ radius = {shape}, center = ["{far!r} m", "{b!r} m"] }}'
    asks = 'push = { of = "c.impulse.norm", at = "hit" }\n'
    if not fixed:
        target = f'bodies.b = {{ disk = {shape}, mass = "{other!r} kg", at = ["{far!r} m", "{b!r} m"] }}'
        asks += 'u = { of = "b.velocity.norm", at = "hit" }'
    touch = f'touch = ["a.rim", "{"ground.b" if fixed else "b.rim"}"], restitution = {e!r}'
    truth, mark = {"push": push, "w": -push * ny / mass}, ""
    if draw.randrange(2):  # a large scene, in which a step could go far beyond
        mark = f', points.P = [0, "{way * 10 ** draw.uniform(-1.5, 0)!r} m"]'
        end = thrust.arrives(way * 10 ** draw.uniform(0.2, 1.8))
        text = _scene(f"t = {end!r} s", thrust, mass, a, target, touch, asks, mark)
        for name, of in (("x", "a.x"), ("v", "a.velocity.x"), ("w", "a.velocity.y")):
            text = text.replace(f'{name} = "{of}"', f'{name} = {{ of = "{of}", at = "hit" }}')
        truth |= {"x": way, "v": thrust.speed(t) - push * nx / mass}
    else:
        late = draw.uniform(0.05, 0.3) * e * fast / thrust.acceleration(t)
        text = _scene(f"t = {t + late!r} s", thrust, mass, a, target, touch, asks)
        x, v = thrust.after(t, late, push * nx / mass)
        truth |= {"x": x, "v": v, "n": 1}
    if not fixed:
        truth["u"] = push / other
    return Drawn(text, truth, {"x": far, "v": fast / nx, "w": fast / nx, "push": push, "u": fast})


def at_a_rod(draw: random.Random) -> Drawn:
    """A free rod that stands across is struck on its side, or on its end.

    With n from the disk to the rod, and r to the place that is struck:
    P = (1 + e) v.n / (1/m + 1/M + (r x n)^2/I).
    """
    way = 10 ** draw.uniform(0, 2.5)
    a, e = way * 10 ** draw.uniform(-4, -1), draw.uniform(0.3, 1)
    m, mass = (10 ** draw.uniform(-1, 1) for _ in range(2))
    length = a * 10 ** draw.uniform(-0.5, 2.5)
    inertia = mass * length**2 / 12
    nx, ny, arm = 1.0, 0.0, draw.uniform(-0.48, 0.48) * length
    middle = -arm
    if draw.randrange(2):
        beyond, end = draw.uniform(0.02, 0.95) * a, draw.choice([-1, 1])
        nx, ny, arm = math.sqrt(1 - (beyond / a) ** 2), -end * beyond / a, end * length / 2
        middle = -end * (length / 2 + beyond)
    thrust = _thrust(draw, way)
    v = thrust.speed(thrust.arrives(way))
    push = (1 + e) * v * nx / (1 / m + 1 / mass + (arm * nx) ** 2 / inertia)
    shape = f'rod = ["A", "B"], length = "{length!r} m", angle = "90 deg"'
    target = f'bodies.r = {{ {shape}, mass = "{mass!r} kg", at = ["{way + a * nx!r} m", "{middle!r} m"] }}'
    touch = f'touch = ["a.rim", "r.top"], restitution = {e!r}'
    text = _scene("hit", thrust, m, a, target, touch, 'u = "r.velocity.x"\nomega = "r.omega"')
    truth = {
        "x": way,
        "v": v - push * nx / m,
        "w": -push * ny / m,
        "u": push * nx / mass,
        "omega": -push * nx * arm / inertia,
        "n": 1,
    }
    # A rounding of the way turns n by so much of a radius.
    sizes = {"x": way, "v": v, "w": v, "u": v * m / mass, "omega": push * length / inertia}
    return Drawn(text, truth, {name: size * (1 + 0.01 * way / a) for name, size in sizes.items()})


def at_marks(draw: random.Random) -> Drawn:
    """A row of points or an ellipse of the ground, or a disk that catches it by its centre."""
    way = 10 ** draw.uniform(0, 2.5)
    a, e = way * 10 ** draw.uniform(-4, -1), draw.uniform(0.3, 1)
    m, mass = (10 ** draw.uniform(-1, 1) for _ in range(2))
    thrust = _thrust(draw, way)
    v = thrust.speed(thrust.arrives(way))
    (target, nx, ny), touch, asks = _mark(draw, way, a, mass, e)
    caught = asks != ""
    push = v / (1 / m + 1 / mass) if caught else (1 + e) * v * nx * m
    text = _scene("hit", thrust, m, a, target, touch, asks)
    truth = {"x": way, "v": v - push * nx / m, "w": -push * ny / m, "n": 1}
    size = {"x": way, "v": v * (1 + 0.01 * way / a), "w": v * (1 + 0.01 * way / a)}
    if caught:
        truth["u"], size["u"] = push / mass, v
    return Drawn(text, truth, size)


def _mark(
    draw: random.Random, way: float, a: float, mass: float, e: float
) -> tuple[tuple[str, float, float], str, str]:
    """The target with its normal, the contact, what else is asked."""
    kind = draw.choice(["row", "ellipse", "catches"])
    struck = f'touch = ["a.rim", "ground.r"], restitution = {e!r}'
    if kind == "row":
        step, aside = a * draw.uniform(2.2, 20), draw.uniform(-0.95, 0.95) * a
        nx, first = math.sqrt(1 - (aside / a) ** 2), aside - draw.randint(0, 3) * step
        row = f'ground.rows.r = {{ from = ["{way + a * nx!r} m", "{first!r} m"], step = [0, "{step!r} m"] }}'
        return (row, nx, aside / a), struck, ""
    if kind == "ellipse":
        half, other = (a * 10 ** draw.uniform(-1, 1) for _ in range(2))
        shape = f'ellipse = ["{half!r} m", "{other!r} m"], at = ["{way + a + half!r} m", 0], side = "right"'
        return (f"ground.curves.r = {{ {shape} }}", 1.0, 0.0), struck, ""
    disk = f'bodies.r = {{ disk = "{a!r} m", mass = "{mass!r} kg", at = ["{way!r} m", 0] }}'
    return (disk, 1.0, 0.0), 'touch = ["a.G", "r.G"], capture = "pin"', 'u = "r.velocity.x"'


def at_a_peg_on_its_way_round(draw: random.Random) -> Drawn:
    """A small disk on an arm that swings, or is turned by a growing couple: omega' = -e omega."""
    arm = 10 ** draw.uniform(-1, 1)
    radii = arm * 10 ** draw.uniform(-2.5, -0.7)
    a, aside, k = radii * draw.uniform(0.1, 0.9), draw.uniform(-0.95, 0.95) * radii, 10 ** draw.uniform(-6, 0)
    start = math.radians(draw.uniform(40, 170)) * draw.choice([-1, 1])
    peg, way = draw.uniform(-0.8, 0.8) * abs(start), -math.copysign(1, start)
    out, e, m = arm + aside, draw.uniform(0, 1), 10 ** draw.uniform(-1, 1)
    at = peg - way * 2 * math.asin(math.sqrt((radii - aside) * (radii + aside) / (4 * arm * out)))
    inertia = m * (arm**2 + (k * a) ** 2)
    plane = couple = ""
    omega = math.sqrt(max(0.0, 2 * m * G * arm / inertia * (math.cos(at) - math.cos(start))))
    if draw.randrange(2):
        thrust = _thrust(draw, 1.0)
        thrust = Thrust(thrust.c or 1.0, thrust.p, 0, 0)
        omega = thrust.speed(thrust.arrives(abs(at - start)))
        plane, growth = 'plane = "horizontal"', f"{way * inertia * thrust.c!r}*(1 N*m)*(t/(1 s))^{thrust.p}"
        couple = f'forces.q = {{ couple = "b", value = "{growth}" }}'
    x, y, px, py = (
        size * of for size, angle in ((arm, start), (out, peg)) for of in (math.sin(angle), -math.cos(angle))
    )
    marks = f'at = ["{x!r} m", "{y!r} m"], points.P = ["{-x!r} m", "{-y!r} m"]'
    text = f"""
until = "hit"
{plane}
bodies.b = {{ disk = "{a!r} m", mass = "{m!r} kg", gyration = "{k * a!r} m", {marks} }}
joints.o = {{ pin = ["b.P", "ground"] }}
ground.circles.peg = {{ radius = "{radii - a!r} m", center = ["{px!r} m", "{py!r} m"] }}
contacts.c = {{ touch = ["b.rim", "ground.peg"], restitution = {e!r} }}
events.hit = "c strikes"
{couple}
[ask]
omega = "b.omega"
x = "b.x"
n = "hit.count"
"""
    conditioned = 1 + 0.03 * arm / radii
    size = {"omega": omega * conditioned, "x": arm * conditioned}
    return Drawn(text, {"omega": -e * way * omega, "x": arm * math.sin(at), "n": 1}, size)
