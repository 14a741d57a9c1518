"""Scenes as newcomers wrote them from README.md and docs/ alone: each attempt that failed, in order, what the
message said, and what was changed for it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.scenes import G


@dataclass(frozen=True)
class Stumble:
    """The message, and what was changed for it: pairs of old and new."""

    told: str
    changes: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Story:
    """A scene as it was first written, the stumbles, and the answers."""

    first: str
    stumbles: tuple[Stumble, ...]
    answers: dict[str, float]


def slider_crank(r: float, length: float, rate: float) -> float:
    """The greatest speed of the piston."""
    a = np.linspace(0, 2 * np.pi, 2_000_001)
    slope = r * np.sin(a) * np.cos(a) / np.sqrt(length**2 - (r * np.sin(a)) ** 2)
    return float(np.abs(r * rate * (np.sin(a) + slope)).max())


HINGED = Story(
    """\
until = "stop strikes"
[bodies]
rod = { rod = "1 m", ends = ["A", "B"], mass = "2 kg", at = { A = [0, 0] } }
[joints]
A = { pin = ["rod.A", "ground"] }
[ground]
points = { peg = { polar = ["0.8 m", "-60 deg"] } }
[contacts]
stop = { touch = ["ground.peg", "rod.bottom"], restitution = 0.5 }
[ask]
speed_before = { of = "rod.omega", at = "before stop strikes" }
speed_after = "rod.omega"
impulse = "stop.impulse"
""",
    (
        Stumble('bodies.rod.ends: unknown key (did you mean "rod"?)', (('ends = ["A", "B"], ', ""),)),
        Stumble(
            'bodies.rod.rod = "1 m": the names of two ends are wanted, such as rod = ["A", "B"], and length',
            (('rod = "1 m"', 'rod = ["A", "B"], length = "1 m"'),),
        ),
        Stumble(
            'events.NAME = "stop strikes", then at = "before NAME"',
            (
                ('until = "stop strikes"', 'until = "strike"\nevents.strike = "stop strikes"'),
                ('"before stop strikes"', '"before strike"'),
            ),
        ),
        Stumble('such as "stop.impulse.norm"', (('"stop.impulse"', '"stop.impulse.norm"'),)),
    ),
    {
        "speed_before": -np.sqrt(3 * G * np.sin(np.pi / 3)),
        "speed_after": 0.5 * np.sqrt(3 * G * np.sin(np.pi / 3)),
        "impulse": (2 / 3) * 1.5 * np.sqrt(3 * G * np.sin(np.pi / 3)) / 0.8,
    },
)

CRANK = Story(
    """\
until = "crank.turned = 1 rev"
[parameters]
r = "50 mm"
l = "150 mm"
[bodies]
crank = { rod = ["O", "A"], length = "r", mass = "1 kg", at = { O = [0, 0] } }
rod = { rod = ["A", "B"], length = "l", mass = "2 kg", at = { A = "crank.A" } }
piston = { mass = "3 kg", at = "rod.B" }
[ground]
lines = { bore = { through = [0, 0], angle = "0 deg" } }
[joints]
O = { pin = ["crank.O", "ground"], angle = "(100 rad/s)*t" }
A = { pin = ["crank.A", "rod.A"] }
B = { pin = ["rod.B", "piston"] }
guide = { slider = ["piston", "ground.bore"] }
[ask]
top_speed = { max = "piston.v", unit = "m/s" }
work = { integral = "O.couple*crank.omega", unit = "N m" }
""",
    (
        Stumble(
            'body "piston" has no point or quantity "v"; it has G, center (did you mean "velocity"?)',
            (("piston.v", "piston.velocity"),),
        ),
        Stumble('such as "piston.velocity.norm"', (("piston.velocity", "piston.velocity.norm"),)),
        Stumble('"N m" is not a unit: units are words joined by * and /', (("N m", "N*m"),)),
    ),
    {"top_speed": slider_crank(0.05, 0.15, 100), "work": 0},
)

INCLINE = Story(
    """\
until = "disk.x = 2 m"
[bodies]
disk = { disk = "0.1 m", mass = "5 kg", at = { polar = ["0.1 m", "60 deg"] } }
[ground]
lines = { slope = { through = [0, 0], angle = "-30 deg" } }
[contacts]
floor = { touch = ["disk.rim", "ground.slope"], friction = 0.1 }
[ask]
v = "disk.velocity"
slips = "floor.slips"
""",
    (
        Stumble('such as "disk.velocity.norm"', (("disk.velocity", "disk.velocity.norm"),)),
        Stumble('unknown quantity of a contact "slips"', (("floor.slips", "floor.slip"),)),
    ),
    # it slips: a = g (sin - f cos), alpha r = 2 f g cos
    {
        "v": np.sqrt(2 * G * (0.5 - 0.1 * np.cos(np.pi / 6)) * (2 - 0.05) / np.cos(np.pi / 6)),
        "slips": np.sqrt(2 * G * (0.5 - 0.1 * np.cos(np.pi / 6)) * (2 - 0.05) / np.cos(np.pi / 6))
        * (1 - 0.2 * np.cos(np.pi / 6) / (0.5 - 0.1 * np.cos(np.pi / 6))),
    },
)  # fmt: skip

MOTOR = Story(
    """\
until = "crank.turned = 1 rev"
[bodies]
crank = { rod = ["O", "P"], length = "50 mm", mass = "0.5 kg", at = { O = [0, 0] }, angle = "90 deg - 0 deg" }
conrod = { rod = ["P", "Q"], length = "150 mm", mass = "0.4 kg", at = { P = "crank.P" }, angle = "~-20 deg" }
piston = { mass = "0.3 kg", at = "conrod.Q" }
[ground.lines]
bore = { through = [0, 0], angle = 0 }
[joints]
O = { pin = ["crank.O", "ground"] }
P = { pin = ["crank.P", "conrod.P"] }
Q = { pin = ["conrod.Q", "piston"] }
bore = { slider = ["piston", "ground.bore"] }
[couplings]
motor = { motor = ["crank"], omega = "100 rad/s" }
[ask]
top_speed = { max = "piston.speed", unit = "m/s" }
""",
    (
        Stumble(
            'couplings.motor.omega: unknown key (did you mean "value"?)', (('omega = "100', 'value = "100'),)
        ),
        Stumble(
            'two partners are wanted, such as ["rod.A", "ground"]', (('["crank"]', '["crank", "ground"]'),)
        ),
        Stumble(
            "a number with a unit inside an expression goes in parentheses: (90 deg)",
            (('"90 deg - 0 deg"', '"(90 deg) - (0 deg)"'),),
        ),
    ),
    {"top_speed": slider_crank(0.05, 0.15, 100)},
)

BALLS = Story(
    """\
until = "t = 1 s"
plane = "horizontal"
[bodies]
a = { disk = "0.1 m", mass = "1 kg", at = [0, 0] }
b = { disk = "0.1 m", mass = "2 kg", at = ["1 m", "0.05 m"] }
[start]
a.velocity = ["3 m/s", 0]
[contacts]
hit = { touch = ["a", "b"], restitution = 0.8 }
[ask]
J = { of = "hit.impulse.norm", at = "hit", unit = "N*s" }
""",
    (
        Stumble(
            'events.NAME = "hit strikes", then at = "NAME"',
            (('at = "hit"', 'at = "h"'), ("[ask]", '[events]\nh = "hit strikes"\n[ask]')),
        ),
    ),
    {"J": 1.8 * (2 / 3) * 3 * np.sqrt(1 - 0.25**2)},
)

BOUNCES = Story(
    """\
until = "t = 3 s"
[parameters]
e = 0.7
[ground.lines.floor]
through = [0, 0]
[bodies.ball]
sphere = "5 cm"
mass = "0.2 kg"
at = [0, "2 m"]
[contacts.floor]
touch = ["ball", "ground.floor"]
restitution = "e"
[ask]
hits = "floor.strikes.count"
[sweep]
e = { from = 0.1, to = 0.9, steps = 9 }
""",
    (
        Stumble('sweep.e.steps: unknown key (did you mean "num"?)', (("steps", "num"),)),
        Stumble(
            'events.NAME = "floor strikes", then NAME.count',
            (("floor.strikes.count", "hit.count"), ("[ask]", '[events]\nhit = "floor strikes"\n[ask]')),
        ),
    ),
    # blows at T (1 + 2 e + 2 e^2 + ...) with T = sqrt(2 h/g): the fifth at 2.84 s, the sixth at 3.15 s
    {"hits": 5},
)

FOUND = Story(
    """\
until = "box.x = 1 m"
[parameters]
mu = 0.3
[ground.lines]
slope = { through = [0, 0], angle = "-30 deg" }
[bodies]
box = { mass = "5 kg", at = [0, 0] }
[contacts]
slope = { touch = ["box", "ground.slope"], friction = "mu" }
[ask]
v = { of = "box.speed", unit = "m/s" }
[find]
vary = "mu"
from = 0.01
to = 0.5
where = "v = 2 m/s"
""",
    (
        Stumble(
            'find.from: unknown key (did you mean "vary"?)',
            (('vary = "mu"\nfrom = 0.01\nto = 0.5\n', "vary = { mu = { from = 0.01, to = 0.5 } }\n"),),
        ),
        Stumble("two bounds are wanted: [lowest, greatest]", (("{ from = 0.01, to = 0.5 }", "[0.01, 0.5]"),)),
    ),
    {"v": 2},
)

BOWLING = Story(
    """\
until = "ball rolls"
[ground.lines]
lane = { through = [0, 0] }
[bodies]
ball = { sphere = "10.8 cm", mass = "7 kg", at = [0, "10.8 cm"] }
[start]
ball.velocity = "8 m/s"
[contacts]
lane = { touch = ["ball", "ground.lane"], friction = 0.12 }
[ask]
distance = "ball.x"
v = "ball.speed"
""",
    (
        Stumble(
            'a part is wanted: x, y, norm, angle, or along a direction, such as "ball.velocity.norm"',
            (('"8 m/s"', '["8 m/s", 0]'),),
        ),
        Stumble(
            'a body only rests: "ball rests"; a contact strikes, opens, slips, sticks, such as "lane sticks"',
            (("ball rolls", "lane sticks"),),
        ),
    ),
    {"v": 8 * 5 / 7, "distance": 8**2 * (1 - (5 / 7) ** 2) / (2 * 0.12 * G)},
)

ATWOOD = Story(
    """\
until = "A.y = 0"
[bodies]
pulley = { disk = "0.2 m", mass = "3 kg", at = [0, "3 m"] }
A = { mass = "5 kg", at = ["-0.2 m", "1 m"] }
B = { mass = "4 kg", at = ["0.2 m", "1 m"] }
[joints]
axle = { pin = ["pulley", "ground"] }
[couplings]
rope = { cord = ["A", "pulley", "B"] }
[ask]
v = "A.speed"
T = "rope.tension[1]"
""",
    (
        Stumble(
            'the cord is tied to its mass centre: did you mean "pulley.rim cw" or "pulley.rim ccw"?',
            (('"pulley", "B"', '"pulley.rim cw", "B"'),),
        ),
    ),
    {"v": np.sqrt(2 * G / 10.5), "T": 5 * (G - G / 10.5)},
)

SPRING = Story(
    """\
until = "t = 5 s"
[ground.points]
wall = [0, 0]
[ground.lines]
track = { through = [0, 0] }
[bodies]
block = { mass = "2 kg", at = ["0.6 m", 0], velocity = [0, 0] }
[joints]
track = { slider = ["block", "ground.track"] }
[forces]
spring = { spring = ["block", "ground.wall"], k = "200 N/m", length = "0.5 m" }
damper = { damper = ["block", "ground.wall"], c = "3 N s/m" }
[ask]
period = { period = "block.x", about = "0.5 m" }
""",
    (
        Stumble(
            'velocity: unknown key; at the start it is given by start.block.velocity = ["1 m/s", 0]',
            ((", velocity = [0, 0]", ""),),
        ),
        Stumble(
            'forces.spring.k: unknown key (did you mean "stiffness"?)', (('k = "200', 'stiffness = "200'),)
        ),
        Stumble(
            'forces.spring.length: unknown key (did you mean "free_length"?)', (("length", "free_length"),)
        ),
        Stumble('forces.damper.c: unknown key (did you mean "rate"?)', (('c = "3', 'rate = "3'),)),
        Stumble('units are joined by * and /, such as "3 N*s/m"', (("N s/m", "N*s/m"),)),
    ),
    {"period": 2 * np.pi / np.sqrt(100 - 0.75**2)},
)

RANGE = Story(
    """\
until = "ball.y < 0"
[parameters]
angle = "30 deg"
[bodies]
ball = { mass = "1 kg", at = [0, "1.8 m"] }
[start]
ball.velocity = { polar = ["20 m/s", "angle"] }
[ask]
range = "ball.x"
[find]
vary = { angle = ["10 deg", "80 deg"] }
maximize = "range"
""",
    (Stumble('find.maximize: unknown key (did you mean "greatest"?)', (("maximize", "greatest"),)),),
    {"range": 20 * np.sqrt(20**2 + 2 * G * 1.8) / G},
)

DRIVEN = Story(
    """\
until = "wheel.turned = 1 rev"
[bodies]
wheel = { disk = "0.2 m", mass = "3 kg", at = [0, 0] }
[joints]
axle = { pin = ["wheel", "ground"], omega = "10 rad/s" }
[ask]
t = "t"
""",
    (
        Stumble(
            'a motor drives it: couplings.motor = { motor = ["crank", "ground"], value = "10 rad/s" }',
            (
                (', omega = "10 rad/s"', ""),
                ("[ask]", '[couplings]\nmotor = { motor = ["wheel", "ground"], value = "10 rad/s" }\n[ask]'),
            ),
        ),
    ),
    {"t": 2 * np.pi / 10},
)

STORIES = {
    "hinged rod": HINGED,
    "slider-crank": CRANK,
    "slider-crank with a motor": MOTOR,
    "incline": INCLINE,
    "two disks": BALLS,
    "bounces": BOUNCES,
    "find": FOUND,
    "bowling": BOWLING,
    "Atwood": ATWOOD,
    "spring": SPRING,
    "range": RANGE,
    "driven wheel": DRIVEN,
}
