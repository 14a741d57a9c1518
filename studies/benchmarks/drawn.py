"""Scenes drawn at random whose answers are known in 30 digits, for the calibration of error estimates.

Numbers are drawn as doubles, which the texts of a scene keep.  Closed forms, quadratures, exponentials of
matrices, motions blow by blow and an extrapolated integration share nothing with the engine.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Any

import mpmath as mp

import planemotion
from studies.benchmarks.gas import Disk, Gas
from studies.benchmarks.known import STUDIES, Known, Truth
from studies.benchmarks.truths import G_SI, crank_inertia, double_pendulum, midpoint_extrapolated

IN_TIME = ("auto", "rk")
WITH_UNIFORM = ("auto", "rk", "uniform")

Numbers = dict[str, Any]


def quantity(value: float, unit: str) -> str:
    return f"{value!r} {unit}"


def known(name: str, raw: Numbers, truth: Truth, routes: tuple[str, ...], draw: random.Random) -> Known:
    """With an accuracy that is drawn, too."""
    power = round(draw.uniform(5, 12), 2)
    scene = planemotion.Scene.from_table({"id": name.replace(" ", "_"), **raw})
    return Known(name, scene, truth, dict.fromkeys(routes, (power,)))


# ---- one body ----


def pendulum(draw: random.Random) -> Known:
    """A rod on a pin, let go at rest: Jacobi's functions."""
    size, mass, time = draw.uniform(0.3, 3), draw.uniform(0.5, 5), 10 ** draw.uniform(0, 3)
    angle = draw.uniform(-1.4, 1.0)
    length, g, end = mp.mpf(size), mp.mpf(G_SI), mp.mpf(time)
    first = mp.mpf(angle) + mp.pi / 2  # from where it hangs
    k, rate = mp.sin(first / 2), mp.sqrt(3 * g / (2 * length))
    u, m = mp.ellipk(k**2) - rate * end, k**2
    phi, omega = 2 * mp.asin(k * mp.ellipfun("sn", u, m=m)), -2 * k * rate * mp.ellipfun("cn", u, m=m)
    alpha = -(rate**2) * mp.sin(phi)
    outward = (mp.sin(phi), -mp.cos(phi))
    along = (mp.cos(phi), mp.sin(phi))
    force = [mass * length / 2 * (alpha * along[i] - omega**2 * outward[i]) + i * mass * g for i in (0, 1)]
    truth: Truth = {
        "angle": float(phi - mp.pi / 2),
        "omega": float(omega),
        "force_x": float(force[0]),
        "force_y": float(force[1]),
        "energy": float(mass * g * length / 2 * mp.sin(angle)),
    }
    rod = {"rod": ["A", "B"], "length": quantity(size, "m"), "mass": quantity(mass, "kg")}
    raw = {
        "until": f"t = {time!r} s",
        "bodies": {"AB": {**rod, "at": {"A": [0, 0]}, "angle": quantity(angle, "rad")}},
        "joints": {"A": {"pin": ["AB.A", "ground"]}},
        "ask": {
            "angle": {"of": "AB.angle", "unit": "rad"},
            "omega": {"of": "AB.omega", "unit": "rad/s"},
            "force_x": {"of": "A.force.x on AB", "unit": "N"},
            "force_y": {"of": "A.force.y on AB", "unit": "N"},
            "energy": {"of": "energy.total", "unit": "J"},
        },
    }
    return known("drawn pendulum", raw, truth, IN_TIME, draw)


def ball(draw: random.Random) -> Known:
    """A ball that bounces and drifts: a geometric series of flights."""
    height, e, drift = draw.uniform(0.1, 5), draw.choice([1.0, draw.uniform(0.3, 0.99)]), draw.uniform(-3, 3)
    blows = draw.randint(2, 30 if e < 1 else 300)
    h, q, g = mp.mpf(height), mp.mpf(e), mp.mpf(G_SI)
    speed = mp.sqrt(2 * g * h)
    end = speed / g * (1 + 2 * sum((q**k for k in range(1, blows)), mp.mpf(0)))
    before = speed * q ** (blows - 1)
    truth: Truth = {
        "time": float(end),
        "x": float(mp.mpf(drift) * end),
        "speed": float(before),
        "lost_in_last": float(before**2 * (1 - q**2) / 2),
        "impulse": float(before * (1 + q)),
    }
    raw = {
        "until": f"blow {blows}",
        "ground": {"lines": {"floor": {"through": [0, 0]}}},
        "bodies": {"ball": {"mass": "1 kg", "at": [0, quantity(height, "m")]}},
        "contacts": {"floor": {"touch": ["ball", "ground.floor"], "restitution": e}},
        "start": {"ball.velocity": [quantity(drift, "m/s"), "0 m/s"]},
        "events": {"blow": "floor strikes"},
        "ask": {
            "time": {"of": "t", "unit": "s"},
            "x": {"of": "ball.x", "unit": "m"},
            "speed": {"of": "-ball.velocity.y", "at": f"before blow {blows}", "unit": "m/s"},
            "lost_in_last": {"of": "energy.lost", "unit": "J"},
            "impulse": {"of": "floor.impulse.y on ball", "unit": "N*s"},
        },
    }
    return known("drawn ball", raw, truth, WITH_UNIFORM, draw)


def ball_to_rest(draw: random.Random) -> Known:
    """All of its blows: the limits of the series."""
    height, e = draw.uniform(0.1, 5), draw.uniform(0.2, 0.9)
    h, q, g = mp.mpf(height), mp.mpf(e), mp.mpf(G_SI)
    speed = mp.sqrt(2 * g * h)
    truth: Truth = {"time": float(speed / g * (1 + q) / (1 - q)), "energy": 0.0}
    raw = {
        "until": "rest",
        "ground": {"lines": {"floor": {"through": [0, 0]}}},
        "bodies": {"ball": {"mass": "1 kg", "at": [0, quantity(height, "m")]}},
        "contacts": {"floor": {"touch": ["ball", "ground.floor"], "restitution": e}},
        "ask": {"time": {"of": "t", "unit": "s"}, "energy": {"of": "energy.total", "unit": "J"}},
    }
    return known("drawn ball to rest", raw, truth, WITH_UNIFORM, draw)


# ---- several bodies ----


def gas(draw: random.Random) -> Known:
    """Disks in a box, blow by blow; not so many blows that chaos leaves nothing of the doubles."""
    n, e, g = draw.randint(2, 5), draw.choice([1.0, draw.uniform(0.85, 1)]), draw.choice([0.0, G_SI])
    width, time = 2.0, draw.uniform(0.5, 2.5)
    disks = [
        Disk(
            draw.uniform(0.05, 0.15),
            draw.uniform(0.5, 3),
            [(i % 3 + 0.5) * width / 3 + draw.uniform(-0.1, 0.1), (i // 3 + 0.5) * width / 2],
            [draw.uniform(-2, 2), draw.uniform(-2, 2)],
        )
        for i in range(n)
    ]
    box = Gas(disks, width, e, g)
    if not box.run(time):
        return gas(draw)
    truth: Truth = {"energy": float(box.energy())}
    asks: Numbers = {"energy": {"of": "energy.total", "unit": "J"}}
    contacts: Numbers = {}
    walls = {
        "left": {"through": [0, 0], "angle": "-90 deg"},
        "right": {"through": [quantity(width, "m"), 0], "angle": "90 deg"},
        "floor": {"through": [0, 0]},
        "roof": {"through": [0, quantity(width, "m")], "angle": "180 deg"},
    }
    for i, disk in enumerate(disks):
        partners = [*(f"ground.{wall}" for wall in walls), *(f"d{k}.rim" for k in range(i))]
        for k, partner in enumerate(partners):
            contacts[f"c{i}_{k}"] = {"touch": [f"d{i}.rim", partner], "restitution": e}
        for axis, word in enumerate("xy"):
            asks[f"{word}{i}"] = {"of": f"d{i}.{word}", "unit": "m"}
            truth[f"{word}{i}"] = float(disk.place[axis])
    bodies = {
        f"d{i}": {
            "disk": quantity(disk.radius, "m"),
            "mass": quantity(disk.mass, "kg"),
            "at": [quantity(u, "m") for u in disk.at],
        }
        for i, disk in enumerate(disks)
    }
    raw = {
        "until": f"t = {time!r} s",
        "parameters": {"g": quantity(g, "m/s^2")},
        "ground": {"lines": walls},
        "bodies": bodies,
        "contacts": contacts,
        "start": {f"d{i}.velocity": [quantity(u, "m/s") for u in x.velocity] for i, x in enumerate(disks)},
        "ask": asks,
    }
    return known("drawn gas", raw, truth, WITH_UNIFORM, draw)


def dampers(draw: random.Random) -> Known:
    """Two masses on a line between springs and dampers: the exponential of a matrix."""
    stiffness, rates = [draw.uniform(5, 500) for _ in "ab"], [10 ** draw.uniform(-2, 1) for _ in "ab"]
    masses, free = [draw.uniform(0.3, 3) for _ in "ab"], [draw.uniform(0.5, 1) for _ in "ab"]
    time = draw.uniform(0.5, 10)
    places = [free[0] + draw.uniform(-0.1, 0.1), free[0] + free[1] + draw.uniform(-0.1, 0.1)]
    k, c, m = ([mp.mpf(u) for u in values] for values in (stiffness, rates, masses))
    motion = mp.matrix(
        [
            [0, 0, 1, 0],
            [0, 0, 0, 1],
            [-(k[0] + k[1]) / m[0], k[1] / m[0], -(c[0] + c[1]) / m[0], c[1] / m[0]],
            [k[1] / m[1], -k[1] / m[1], c[1] / m[1], -c[1] / m[1]],
        ]
    )
    rest = [mp.mpf(free[0]), mp.mpf(free[0]) + mp.mpf(free[1])]
    end = mp.expm(motion * mp.mpf(time)) * mp.matrix([places[0] - rest[0], places[1] - rest[1], 0, 0])
    x, v = [rest[i] + end[i] for i in (0, 1)], [end[2], end[3]]
    truth: Truth = {
        "xa": float(x[0]),
        "xb": float(x[1]),
        "va": float(v[0]),
        "vb": float(v[1]),
        "tension": float(k[1] * (x[1] - x[0] - free[1])),
        "momentum": float(m[0] * v[0] + m[1] * v[1]),
    }
    ends = (["ground.O", "a"], ["a", "b"])
    raw = {
        "until": f"t = {time!r} s",
        "parameters": {"g": "0 m/s^2"},
        "ground": {"points": {"O": [0, 0]}},
        "bodies": {
            name: {"mass": quantity(masses[i], "kg"), "at": [quantity(places[i], "m"), 0]}
            for i, name in enumerate("ab")
        },
        "forces": {
            f"{word}{i}": values
            for i in (0, 1)
            for word, values in (
                (
                    "spring",
                    {
                        "spring": ends[i],
                        "stiffness": quantity(stiffness[i], "N/m"),
                        "free_length": quantity(free[i], "m"),
                    },
                ),
                ("damper", {"damper": ends[i], "rate": quantity(rates[i], "N*s/m")}),
            )
        },
        "ask": {
            "xa": {"of": "a.x", "unit": "m"},
            "xb": {"of": "b.x", "unit": "m"},
            "va": {"of": "a.velocity.x", "unit": "m/s"},
            "vb": {"of": "b.velocity.x", "unit": "m/s"},
            "tension": {"of": "spring1.force.x on a", "unit": "N"},
            "momentum": {"of": "momentum.x", "unit": "N*s"},
        },
    }
    return known("drawn dampers", raw, truth, IN_TIME, draw)


def crank(draw: random.Random) -> Known:
    """The slider-crank of the studies, fast enough to go round: energy, and the time as a quadrature."""
    omega, turns = draw.uniform(9, 25), draw.randint(1, 40)
    a, length, g = mp.mpf("0.1"), mp.mpf("0.3"), mp.mpf(G_SI)
    first, rest = mp.pi / 4, mp.mpf(draw.uniform(0.3, 6))

    def square(th: mp.mpf) -> mp.mpf:
        work = g * a / 2 * mp.mpf("0.4") * (mp.sin(first) - mp.sin(th))
        return (crank_inertia(first) * mp.mpf(omega) ** 2 + 2 * work) / crank_inertia(th)

    def time(low: mp.mpf, high: mp.mpf) -> mp.mpf:
        return mp.quad(lambda th: 1 / mp.sqrt(square(th)), mp.linspace(low, high, 13))

    last = first + rest
    end = turns * time(first, first + 2 * mp.pi) + time(first, last)
    root = mp.sqrt(length**2 - (a * mp.sin(last)) ** 2)
    rate = -a * mp.sin(last) - a**2 * mp.sin(last) * mp.cos(last) / root
    truth: Truth = {
        "time": float(end),
        "omega": float(mp.sqrt(square(last))),
        "piston": float(a * mp.cos(last) + root),
        "speed": float(rate * mp.sqrt(square(last))),
    }
    study = planemotion.load(STUDIES / "slider_crank.toml").table
    raw = {
        **{key: study[key] for key in ("ground", "bodies", "joints", "parameters")},
        "until": f"crank.turned = {float(2 * mp.pi * turns + rest)!r} rad",
        "start": {"crank.omega": quantity(omega, "rad/s")},
        "ask": {
            "time": {"of": "t", "unit": "s"},
            "omega": {"of": "crank.omega", "unit": "rad/s"},
            "piston": {"of": "piston.x", "unit": "m"},
            "speed": {"of": "piston.velocity.x", "unit": "m/s"},
        },
    }
    return known("drawn slider-crank", raw, truth, IN_TIME, draw)


def two_rods(draw: random.Random) -> Known:
    """Two rods in series from any angles, an extrapolated integration."""
    angles, time = [draw.uniform(-3, 1) for _ in "ab"], draw.uniform(0.2, 0.8)
    a, b, wa, wb = midpoint_extrapolated(
        double_pendulum, [*map(mp.mpf, angles), mp.mpf(0), mp.mpf(0)], mp.mpf(time), 30
    )
    truth: Truth = {
        "upper": float(a),
        "lower": float(b),
        "tip_x": float(mp.cos(a) + mp.cos(b)),
        "tip_y": float(mp.sin(a) + mp.sin(b)),
        "turns_apart": float(wa - wb),
    }  # fmt: skip
    study = planemotion.load(STUDIES / "double_pendulum.toml").table
    bodies = {
        name: {**study["bodies"][name], "angle": quantity(angles[i], "rad")}
        for i, name in enumerate(("upper", "lower"))
    }
    raw = {
        **{key: study[key] for key in ("joints", "parameters")},
        "until": f"t = {time!r} s",
        "bodies": bodies,
        "ask": {
            "upper": {"of": "upper.angle", "unit": "rad"},
            "lower": {"of": "lower.angle", "unit": "rad"},
            "tip_x": {"of": "lower.C.x", "unit": "m"},
            "tip_y": {"of": "lower.C.y", "unit": "m"},
            "turns_apart": {"of": "upper.omega - lower.omega", "unit": "rad/s"},
        },
    }
    return known("drawn rods", raw, truth, IN_TIME, draw)


KINDS = (pendulum, ball, ball_to_rest, gas, dampers, crank, two_rods)


def drawn(number: int, seed: int = 17) -> Iterator[Known]:
    """So many scenes of each kind."""
    draw = random.Random(seed)
    with mp.workdps(40):
        for kind in KINDS:
            for _ in range(number):
                yield kind(draw)
