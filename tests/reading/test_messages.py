"""Every fault in a scene is told with file, key path, value and the nearest right word."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from planemotion import PlanemotionError, SceneError, load, load_text
from planemotion.compile.flatten import flatten
from planemotion.scene import Scene
from tests import CHAPTER

BASE = """
until = "t = 1 s"
parameters = { L = "1 m", m = "2 kg" }
ground = { points = { O = [0, 0] }, lines = { floor = { through = [0, 0] } } }
[bodies]
AB = { rod = ["A", "B"], length = "L", mass = "m", at = { A = [0, 0] }, angle = "0 deg" }
disk = { disk = "0.1 m", mass = "1 kg", at = [0, "0.1 m"] }
P = { mass = "1 kg", at = ["1 m", "2 m"] }
"""

SPIN = 'spin = { through = [0, 0], angle = "90 deg" }\n'


def doing(action: str) -> str:
    """An event that does one thing."""
    return f'events.e = {{ when = "start", do = [{{ {action} }}] }}'


# What is added to (or put over) the base, and the message after "x.toml: ".
FAULTS = [
    # words
    (
        'joints.A = { pin = ["AB.A", "ground"], frictoin = 0.1 }',
        'joints.A.frictoin: unknown key; a pin has friction, active (did you mean "friction"?)',
    ),
    ('untill = "start"', 'did you mean "until"?'),
    ('bodies.AB.colour = "red"', "bodies.AB.colour: unknown key; a body has rod, disk, "),
    (
        'joints.A = { pinn = ["AB.A", "ground"] }',
        "joints.A: which kind of joint? one of pin, slider, slot, link, weld, rolling is wanted "
        '("pinn": did you mean "pin"?)',
    ),
    ('joints.A = { pin = ["AB.A", "ground"], link = ["AB.A", "ground"] }', "is wanted, not pin and link"),
    ('bodies.Q = { rod = ["A", "B"], disk = "1 m" }', "bodies.Q: one shape is possible, not rod and disk"),
    ('bodies.Q = { disk = "1 m", length = "1 m" }', "bodies.Q.length: only a rod has length"),
    (
        'ask.a = { of = "AB.omega", att = "end" }',
        "ask.a.att: unknown key; an ask has of, max, min, at, unit, run",
    ),
    (
        "sweep.L = { from = 1, to = 2, nun = 3 }",
        "sweep.L.nun: unknown key; a grid has from, to, num, step, scale",
    ),
    (
        'bodies.start = { mass = "1 kg" }',
        'bodies.start: "start" has a meaning of its own; choose another name',
    ),
    ('contacts.AB = { touch = ["disk.rim", "ground.floor"] }', "contacts.AB: the name is taken by bodies.AB"),
    ("ground.points.x = [0, 0]", 'ground.points.x: "x" is a quantity in addresses; choose another name'),
    # couplings and drives
    (
        'couplings.c = { gear = ["disk.rim", "AB.A"] }',
        "couplings.c: which kind of coupling? one of gears, belt, cord, rate, ratio is wanted "
        '("gear": did you mean "gears"?)',
    ),
    (
        'couplings.c = { gears = ["disk.rim", "AB.A"] }',
        'couplings.c.gears[1] = "AB.A": AB.A is a point; a circle is wanted',
    ),
    ('couplings.c = { cord = ["P"] }', "couplings.c.cord: at least two points or rims are wanted"),
    ('couplings.c = { cord = "P" }', 'couplings.c.cord = "P": points and rims in order are wanted, such as'),
    (
        'couplings.c = { cord = ["disk.rim", "P"] }',
        'couplings.c.cord[0] = "disk.rim": in which sense is it passed, going down the list? "disk.rim cw"',
    ),
    (
        'couplings.c = { cord = ["disk.rim cw", "ground"] }',
        'couplings.c.cord[1] = "ground": a point of the ground is wanted, such as ground.S',
    ),
    (
        'couplings.c = { cord = ["disk.rim cw", "P"], length = "1 m" }',
        "couplings.c.length: a cord that is wound on a rim has no length; give its slack",
    ),
    (
        'couplings.c = { cord = ["AB.A", "disk.rim cw", "P"], slack = "1 m" }',
        "couplings.c.slack: a cord that grips a rim between its ends is taut as drawn",
    ),
    (
        'couplings.c = { cord = ["AB.A", "P"], length = "1 m", slack = "1 m" }',
        "couplings.c: give length or slack, not both",
    ),
    (
        'couplings.c = { cord = ["AB.A", "P"], length = "1 m" }',
        'couplings.c.length = "1 m": it is -1.23607 m and must not be negative',
    ),
    (
        'couplings.c = { ratio = { "disk.turned" = 1 } }',
        'couplings.c.ratio: two bodies are wanted, such as { "A.turned" = 1, "B.turned" = 2 }',
    ),
    (
        'couplings.c = { ratio = ["disk", "AB"] }',
        "couplings.c.ratio: two bodies are wanted",
    ),
    (
        'couplings.c = { ratio = { disk.turned = 1, AB.turned = "2 m" } }',
        'couplings.c.ratio.AB.turned = "2 m": ',
    ),
    (
        "couplings.c = { ratio = { disk.turned = 1, AB.turned = 0 } }",
        "couplings.c.ratio.AB.turned = 0: a body that takes part has a number that is not 0",
    ),
    (
        "couplings.c = { ratio = { disk.turned = 1, AB.x = 2 } }",
        "couplings.c.ratio.AB.x: not built yet: relations of anything but BODY.turned",
    ),
    (
        "couplings.c = { ratio = { disk.turned = 1, P.turned = 2 } }",
        'couplings.c.ratio.P.turned = "P": a particle does not turn; a body with an inertia is wanted',
    ),
    (
        "couplings.c = { ratio = { disk.turned = 1, ground.turned = 2 } }",
        "couplings.c.ratio.ground.turned: the ground does not turn; a body is wanted",
    ),
    (
        'couplings.c = { rate = ["disk", "AB"] }',
        "couplings.c.value: the spin of the first body relative to the second is wanted",
    ),
    (
        'couplings.c = { rate = ["disk", "P"], value = "3 rad/s" }',
        'couplings.c.rate[1] = "P": a particle does not turn; a body with an inertia is wanted',
    ),
    (
        'couplings.c = { rate = ["disk", "AB"], value = "3 m/s" }',
        'couplings.c.value = "3 m/s": an angular velocity (1/time, such as rad/s) is wanted',
    ),
    ("bodies.AB.driven = { speed = 3 }", "bodies.AB.driven.speed: unknown key; a driven body has velocity"),
    (
        'bodies.P.driven = { omega = "3 rad/s" }',
        "bodies.P.driven.omega: a particle does not turn; leave out omega",
    ),
    (
        'bodies.AB.driven = { velocity = ["3 rad/s", 0] }',
        'bodies.AB.driven.velocity[0] = "3 rad/s": a velocity (length/time, such as m/s) is wanted',
    ),
    (
        'contacts.c = { touch = ["ground.floor", "disk.rim"], surface_speed = "3 m/s" }',
        'contacts.c.surface_speed = "3 m/s": the second mark must be a line',
    ),
    (
        'couplings.c = { cord = ["AB.A", "P", "disk.rim cw"] }\nask.a = "c.tension"',
        "which strand? there are c.tension[1] to [2]",
    ),
    (
        'couplings.c = { cord = ["AB.A", "P"] }\nask.a = "c.tension[2]"',
        "the strands are [1] to [1]",
    ),
    ('events.e = "c slackens"', 'unknown cord "c"; there is none'),
    (
        'joints.J = { pin = ["AB.A", "ground"] }\nevents.e = "J slips"',
        'the joint "J" has no friction: it neither sticks nor stops slipping',
    ),
    (
        'joints.J = { pin = ["AB.A", "ground"] }\nevents.e = "J strikes"',
        "a joint is always closed; it slips or sticks",
    ),
    # finds and nudges
    ("find = {}", "find.vary: what is sought is wanted, such as"),
    ("find = { vari = {} }", "find.vari: unknown key; a find has vary, where, greatest, least, samples (did"),
    ("runs.a.find = { vary = 3 }", "runs.a.find.vary = 3: a table is wanted"),
    ('find.vary.L = "1 m"', 'find.vary.L = "1 m": two bounds are wanted: [lowest, greatest]'),
    ('runs.a.find.vary.L = ["1 m"]', "runs.a.find.vary.L: two bounds are wanted"),
    ('find.vary.L = ["1 m", "2 m"]', "find: what makes a value the right one is wanted: where, greatest or"),
    (
        'find = { vary.l = ["1 m", "2 m"], least = "L" }',
        'find.vary.l: unknown parameter "l"; there is g, L, m (did you mean "L"?)',
    ),
    (
        'find = { vary = { L = [0, 1], m = [0, 1], g = [0, 1] }, least = "t" }',
        "find.vary: one or two parameters can be sought, not 3",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], least = "t", greatest = "t" }',
        "find: greatest or least, not both",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], least = "t", samples = 1 }',
        "find.samples = 1: 2 to 4096 are possible",
    ),
    (
        'find = { vary = { L = [0, 1], m = [0, 1] }, where = ["AB.x = 0", "AB.y = 0"], samples = 65 }',
        "find.samples = 65: 2 to 64 are possible",
    ),
    (
        'find = { vary.L = ["2 m", "1 m"], where = "AB.x = 0" }',
        "find.vary.L: the lower bound 2 m must be less than the upper bound 1 m",
    ),
    (
        'find = { vary.L = ["1 kg", "2 m"], where = "AB.x = 0" }',
        'find.vary.L[0] = "1 kg": a length (such as m) is wanted; this is a mass',
    ),
    (
        'find = { vary.L = ["1 m", "2*L"], where = "AB.x = 0" }',
        'find.vary.L[1] = "2*L": a bound cannot depend on what is sought',
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], where = "AB.x" }',
        'find.where = "AB.x": a condition is wanted: "A = B"',
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], where = "AB.x = 3 s" }',
        'find.where = "AB.x = 3 s": ',
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], where = ["AB.x = 0", "m > (1 kg)"] }',
        'find.where[1] = "m > (1 kg)": nothing in this condition changes with what is varied',
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], where = "over happens" }',
        'find.where = "over happens": unknown event "over"; there is none',
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], where = "AB.x > 0" }',
        "find.where: many values may do that; add greatest or least",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], where = ["AB.x = 0", "AB.y = 0"] }',
        "find.where: one parameter can meet one condition A = B",
    ),
    (
        'find = { vary = { L = ["1 m", "2 m"], m = ["1 kg", "2 kg"] }, where = "AB.x = 0" }',
        "find: two parameters need two conditions A = B in where",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], least = "L" }',
        "find.least: the least value is its bound; say under which condition: where",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], least = "t" }\nsweep.L = ["1 m"]',
        "find.vary.L: it is swept; it cannot be sought, too",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], least = "t" }\nruns.a.L = "1 m"',
        "find.vary.L: runs.a gives it; it cannot be sought, too",
    ),
    (
        'find = { vary.L = ["1 m", "2 m"], least = "t" }\nbodies.AB.active = "L > (1 m)"',
        'bodies.AB.active = "L > (1 m)": what is active cannot depend on L, which is sought',
    ),
    ('events.e = "AB happens"', '"happens" is a condition of [find]'),
    ('start.nudge = "AB.omega"', 'start.nudge = "AB.omega": a side is wanted: a velocity < 0 or > 0'),
    ('start.nudge = "AB.omega > 1 rad/s"', "a side is wanted"),
    ('start.nudge = "AB.angle > 0"', "only a velocity can have a side"),
    ('start.nudge = "AB.B.speed > 0"', "only a velocity can have a side"),
    (
        'events.e = { when = "start", do = [{ nudge = "AB.angle > 0" }] }',
        'events.e.do[0].nudge = "AB.angle > 0": only a velocity can have a side',
    ),
    (
        'events.e = { when = "start", do = [{ nudge = "AB.omega > 0", value = 3 }] }',
        "events.e.do[0].value: unknown key; an action nudge has nudge, active",
    ),
    (
        'parameters.t = "2 s"\nuntil = "t = 2 s"',
        'changes with the motion; t is a parameter of this scene, the time is called "time"',
    ),
    # types
    ("bodies = 3", "bodies = 3: a table is wanted"),
    ("id = 3", "id = 3: a text is wanted"),
    ('plane = "tilted"', "plane = \"tilted\": 'vertical' or 'horizontal' is wanted"),
    ('joints.A = { pin = ["AB.A"] }', "joints.A.pin: two partners are wanted"),
    ("ground.points.Q = [0]", "ground.points.Q: a vector is wanted: [x, y] or { polar = [size, angle] }"),
    ("bodies.AB.mass = nan", "bodies.AB.mass = nan: the number must be finite"),
    ("bodies.AB.mass = [1]", "bodies.AB.mass: a number, a quantity"),
    ('until = ["start", 3]', "until: a condition or a list of conditions is wanted"),
    (
        'contacts.c = { touch = ["disk.rim", "ground.floor"], friction = { static = 0.2 } }',
        "contacts.c.friction: friction is",
    ),
    ("solve.max_events = 0", "solve.max_events = 0: at least 1 is wanted"),
    ("sweep.L = { from = 1, to = 2 }", "sweep.L: a grid has from, to and either num or step"),
    # units and dimensions
    (
        'bodies.AB.mass = "240 lb"',
        'bodies.AB.mass = "240 lb": lb is a force; write weight = "240 lb", or a mass in kg, slug or lbm',
    ),
    ('bodies.Q = { weight = "3 kg" }', 'bodies.Q.weight = "3 kg": kg is a mass; write mass = "3 kg"'),
    (
        'bodies.AB.inertia = "10.5 lb*ft"',
        'bodies.AB.inertia = "10.5 lb*ft": a moment of inertia (mass*length^2, such as kg*m^2) is wanted; '
        "this is a moment or energy",
    ),
    ("bodies.AB.mass = 3", "bodies.AB.mass = 3: a mass (such as kg) is wanted; this is a plain number"),
    ('bodies.AB.mass = "k*m"', 'bodies.AB.mass = "k*m": unknown parameter "k"; there is g, L, m'),
    (
        'parameters.x = "L + m"',
        'parameters.x = "L + m": in "L + m": L is a length, m is a mass; they cannot be added',
    ),
    (
        'ask.a = { of = "AB.omega", unit = "m/s" }',
        'ask.a.unit = "m/s": this is a velocity; the answer is an angular velocity',
    ),
    ('ask.a = { of = "AB.omega", unit = "parsnip" }', 'ask.a.unit = "parsnip": unknown unit "parsnip"'),
    ('start.AB.omega = "3 m/s"', 'start.AB.omega = "3 m/s": an angular velocity'),
    ('events.e = "AB.angle > 3 m"', "AB.angle is a plain number, 3 m is a length; they cannot be compared"),
    ('events.e = "AB.x every 3 s"', "AB.x is a length, 3 s is a time; they must be of one kind"),
    ('forces.f = { force = "AB.B", value = ["3 N", "2 kg"] }', 'forces.f.value[1] = "2 kg": a force'),
    ('runs = { a = { L = "3 kg" } }', 'runs.a.L = "3 kg": a length (such as m) is wanted; this is a mass'),
    # bounds
    # numbers out of their bounds: key, value and unit
    (
        'forces.s = { spring = ["AB.B", "ground.O"], stiffness = "-2 N/mm", free_length = "1 m" }',
        'forces.s.stiffness = "-2 N/mm": it is -2000 N/m and must not be negative',
    ),
    (
        'forces.d = { damper = ["AB.B", "ground.O"], rate = "-2 N*s/m" }',
        'forces.d.rate = "-2 N*s/m": it is -2 N*s/m and must not be negative',
    ),
    ('bodies.Q = { disk = "0 mm", mass = "1 kg" }', "it is 0 m; a size must be positive"),
    # words of a choice
    (
        'contacts.c = { touch = ["disk.rim", "ground.floor"], friction = "ruff" }',
        'contacts.c.friction = "ruff": a number, "smooth", "rough", { static = ..., kinetic = ... } or a ',
    ),
    (
        'joints.s = { slider = ["P", "ground.floor"], turning = "yes" }',
        'joints.s.turning = "yes": true or false is wanted',
    ),
    ('bodies.AB.mass = "-3 kg"', 'bodies.AB.mass = "-3 kg": it is -3 kg and must not be negative'),
    (
        'contacts.c = { touch = ["disk.rim", "ground.floor"], restitution = 1.2 }',
        "contacts.c.restitution = 1.2: it must lie between 0 and 1",
    ),
    (
        'contacts.c = { touch = ["disk.rim", "ground.floor"], friction = -1 }',
        "contacts.c.friction = -1: it must not be negative",
    ),
    ("solve.accuracy = 1", "solve.accuracy = 1: it must lie between 1e-14 and 0.01"),
    ('bodies.AB.mass = "m/0"', 'bodies.AB.mass = "m/0": it is inf and must be a finite number'),
    # names
    (
        'joints.A = { pin = ["AB.A", "disk.D"] }',
        'joints.A.pin[1] = "disk.D": body "disk" has no point "D"; it has G, center',
    ),
    (
        'joints.A = { pin = ["AB.A", "dsk.G"] }',
        'joints.A.pin[1] = "dsk.G": unknown body "dsk"; there is AB, disk, P, ground (did you mean "disk"?)',
    ),
    (
        'joints.A = { slider = ["AB.A", "ground.O"] }',
        'joints.A.slider[1] = "ground.O": ground.O is a point; a line is wanted',
    ),
    (
        'joints.A = { slider = ["AB.A", "ground"] }',
        'joints.A.slider[1] = "ground": a line is wanted, such as ground.floor',
    ),
    ('joints.A = { pin = ["AB.A", "AB.B"] }', 'joints.A.pin: both partners belong to body "AB"'),
    (
        'ask.a = "AB.velocity"',
        'ask.a = "AB.velocity": a part is wanted: x, y, norm, angle, or along a direction',
    ),
    (
        'ask.a = "AB.omga"',
        'body "AB" has no point or quantity "omga"; it has A, B, G, center (did you mean "omega"?)',
    ),
    ('ask.a = "t.x"', 'ask.a = "t.x": t has no parts'),
    ('ask.a = "AB.omega about disk.G"', '"about" does not go with this quantity'),
    ('ask.a = "AC.omega"', 'unknown name "AC"; there is AB, disk, P, ground, t,'),
    (
        'ask.a = { of = "AB.omega", at = "strike" }',
        'ask.a.at = "strike": unknown instant "strike"; there is end',
    ),
    ('ask.a = { of = "AB.omega", run = "b" }', 'ask.a.run: unknown run "b"; there is none'),
    (
        'until = "blow 3"',
        'until = "blow 3": unknown event "blow"; there is none; a condition is, say, "t = 2 s"',
    ),
    ('events.e = "flor strikes"', 'events.e = "flor strikes": unknown contact "flor"; there is none'),
    ("sweep.d = { from = 1, to = 2, num = 3 }", 'sweep.d: unknown parameter "d"; there is g, L, m'),
    (
        'solve.route = "fast"',
        'solve.route: unknown route "fast"; there is auto, state, jump, uniform, path, rk, ida',
    ),
    # sense
    ('parameters = { x = "y", y = "x" }', "parameters that need each other in a circle: x -> y -> x"),
    (
        'bodies.Q = { mass = "1 kg", at = "R" }\nbodies.R = { mass = "1 kg", at = "Q" }',
        'bodies.Q.at = "Q": bodies that are placed at each other in a circle: Q -> R -> Q',
    ),
    ('bodies.Q = { mass = "1 kg", angle = "3 deg" }', "a particle does not turn; leave out angle"),
    ('bodies.Q = { disk = "1 m" }', "bodies.Q.mass: mass or weight is wanted"),
    (
        'bodies.Q = { inertia = "1 kg*m^2" }',
        "bodies.Q.mass: mass or weight is wanted (unless the mass centre is pinned",
    ),
    ('bodies.Q = { rod = ["A", "B"], mass = "1 kg" }', "bodies.Q.length: the length of a rod is wanted"),
    (
        'bodies.Q = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0], B = ["2 m", 0] } }',
        "bodies.Q.at: A and B are 2 m apart here and 1 m on the body; they must fit",
    ),
    ('contacts.c = { touch = ["P", "ground.O"] }', "contacts.c.normal: two points need a normal"),
    ('contacts.c = { touch = ["AB.axis", "ground.floor"] }', "a line and a line do not touch"),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "pin" }',
        "contacts.c.capture = \"pin\": 'none', 'point' or 'body' is wanted",
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "point", restitution = 0.5 }',
        "contacts.c.restitution: what is captured stays; it has no restitution",
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "point", friction = "rough" }',
        "contacts.c.friction: what is captured stays; it has no friction",
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "point", law = "stronge" }',
        "contacts.c.law: what is captured stays; it has no law",
    ),
    (
        'contacts.c = { touch = ["P", "ground.floor"], capture = "point", surface_speed = "1 m/s" }',
        'contacts.c.surface_speed = "1 m/s": what is captured stays at its place',
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "point" }\nask.a = "c.normal"',
        'unknown quantity of a contact that captures "normal"; there is gap, closed, force, impulse',
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "point" }\nevents.e = "c slips"',
        'what "c" captures stays at its place; it strikes or opens',
    ),
    # laws of blows
    (
        'contacts.c = { touch = ["P", "ground.floor"], law = "strong" }',
        'contacts.c.law: unknown impact law "strong"; there is newton, poisson, stronge',
    ),
    (
        'contacts.c = { touch = ["P", "ground.floor"], tangential = 1 }',
        "contacts.c.tangential = 1: a restitution along the contact needs friction",
    ),
    (
        'contacts.c = { touch = ["P", "ground.floor"], tangential = 1, friction = 0.2, law = "poisson" }',
        "contacts.c.tangential = 1: it belongs to the law newton",
    ),
    (
        'contacts.c = { touch = ["disk.rim", "ground.floor"], tangential = 1.5, friction = "rough" }',
        "contacts.c.tangential = 1.5: it must lie between 0 and 1",
    ),
    (
        'solve.simultaneous = "one after one"',
        'solve.simultaneous: unknown order of blows "one after one"; there is together, one by one',
    ),
    ('events.e = "3 > 2"', 'events.e = "3 > 2": nothing in this condition changes with the motion'),
    ('events.e = "AB.angle >= 3"', 'events.e = "AB.angle >= 3": an event fires on a crossing; write >'),
    ('ask.a = { max = "AB.omega", at = "end" }', "ask.a.at: an extreme over the run has no instant"),
    ("ask.a = {}", "ask.a: one of of, max, min is wanted"),
    ('start.AB.speed = "3 m/s"', 'start.AB.speed = "3 m/s": it cannot be given at the start'),
    ('forces.f = { force = "AB.B", value = ["(3 N/m)*AB.x", 0] }', "only parameters can stand here"),
    ('joints.A = { pin = ["AB.A", "ground"], friction = 0.3 }', "joints.A.friction = 0.3: a moment"),
    (
        'joints.A = { pin = ["AB.A", "ground"], friction = { mu = 0.3 } }',
        "joints.A.friction: friction is a number, or { mu = ..., radius = ... } of a bearing",
    ),
    (
        'joints.S = { slider = ["AB.A", "ground.floor"], friction = { mu = 0.3, radius = "1 m" } }',
        "joints.S.friction: a slider has no radius",
    ),
    (
        'joints.S = { pin = ["P", "ground"], friction = "1 N*m" }',
        "joints.S.friction: a particle does not turn: its pin has no friction",
    ),
    ('forces.f = { couple = "AB", power = "3 N" }', 'forces.f.power = "3 N": a power (mass*length^2/time^3'),
    (
        'forces.f = { couple = "AB", power = "3 W", value = "1 N*m" }',
        "forces.f.power: give power or value, not both",
    ),
    # planes that turn
    ("spin = {}", "spin.through: it is wanted and left out"),
    (
        "spin = { throuhg = [0, 0] }",
        "spin.throuhg: unknown key; a spin has through, angle, inertia, couple (did",
    ),
    (
        'spin = { through = [0, 0], angle = "90 deg", inertia = "-1 kg*m^2" }',
        'spin.inertia = "-1 kg*m^2": it is -1 kg*m^2 and must not be negative',
    ),
    ('ask.a = "spin.omega"', 'ask.a = "spin.omega": the scene has no [spin]'),
    ('start.spin.omega = "1 rad/s"', "start.spin.omega: the scene has no [spin]"),
    (
        'bodies.AB.depth = "0.1 m"',
        "bodies.AB.depth: what is across the plane matters only where the plane turns: [spin]",
    ),
    (SPIN + "bodies.AB.edge_on = true", "bodies.AB.edge_on: only a disk or a hoop has edge_on"),
    (SPIN + 'bodies.P.depth = "0.1 m"', 'bodies.P.depth = "0.1 m": a particle has no depth'),
    (
        SPIN + 'bodies.S = { sphere = "0.1 m", mass = "1 kg", depth = "0.1 m" }',
        'bodies.S.depth = "0.1 m": a sphere has its depth; leave it out',
    ),
    (
        SPIN + 'bodies.disk.edge_on = true\nbodies.disk.depth = "0.1 m"',
        'bodies.disk.depth = "0.1 m": edge_on says its depth; leave it out',
    ),
    (
        SPIN + 'bodies.AB.depth = "-0.1 m"',
        'bodies.AB.depth = "-0.1 m": must not be negative',
    ),
    (
        SPIN + 'bodies.AB.gyration = "0.4 m"',
        'bodies.AB.gyration = "0.4 m": about the axis of the spin gyration says too little',
    ),
    (
        SPIN + 'bodies.Q = { inertia = "1 kg*m^2" }\njoints.J = { pin = ["Q.G", "ground"] }',
        "bodies.Q.mass: mass or weight is wanted: the body turns with the plane",
    ),
    (
        SPIN + 'ask.a = "spin.speed"',
        'ask.a = "spin.speed": unknown quantity of the spin "speed"; there is omega, angle, momentum',
    ),
    # actions
    (doing('remove = "AB.A"'), 'events.e.do[0].remove = "AB.A": unknown element "AB.A"; there is none'),
    (
        'joints.A = { pin = ["AB.A", "ground"] }\n' + doing('add = "B"'),
        'events.e.do[0].add = "B": unknown element "B"; there is A',
    ),
    (
        'joints.A = { pin = ["AB.A", "ground"], active = false }\n' + doing('remove = "A"'),
        'events.e.do[0].remove = "A": "A" is not active in this run',
    ),
    ('events.e = { when = "start", do = "AB" }', 'events.e.do = "AB": a list of actions is wanted'),
    (doing('push = "AB"'), "events.e.do[0]: one of add, remove, impulse, nudge is wanted"),
    (
        doing('add = "A", remove = "A"'),
        "events.e.do[0]: one of add, remove, impulse, nudge is wanted, not add and remove",
    ),
    (
        doing('add = "A", value = 1'),
        "events.e.do[0].value: unknown key; an action add has add, active",
    ),
    (doing('impulse = "AB"'), "events.e.do[0]: either value or work is wanted"),
    (
        doing('impulse = "AB", value = "1 N*m*s", work = "1 J"'),
        "events.e.do[0]: either value or work is wanted",
    ),
    (
        doing('impulse = "AB.A", value = "1 N*m*s"'),
        'events.e.do[0].impulse = "AB.A": a number is an angular impulse, on a body',
    ),
    (doing('impulse = "P", work = "1 J"'), 'events.e.do[0].impulse = "P": a body that turns is wanted'),
    (
        doing('impulse = "ground", value = ["1 N*s", 0]'),
        'events.e.do[0].impulse = "ground": a point of a body is wanted',
    ),
    (
        doing('impulse = "P", value = ["1 N", 0]'),
        'events.e.do[0].value[0] = "1 N": an impulse or momentum (mass*length/time, such as N*s) is wanted',
    ),
    (
        doing('impulse = "P", value = ["P.mass*P.acceleration.x*(1 s)", 0]'),
        "an impulse cannot depend on forces and accelerations: they follow from it",
    ),
    ('events.e = { when = "start", nth = 0 }', "events.e.nth = 0: firings are counted from 1"),
    ('events.e = { when = "start", nth = "2" }', 'events.e.nth = "2": a valid integer is wanted'),
    ("events.e = { do = [] }", "events.e: an event needs a condition: when = ..."),
]

NOT_BUILT = [
    ('couplings.c = { cord = ["disk.rim cw", "P"], slips = ["disk.rim"] }', "couplings.c.slips"),
    ('contacts.c = { table = ["P"] }', "contacts.c.table"),
    ('forces.f = { couple = "AB", value = { over = "t", at = [0], values = [0] } }', "forces.f.value"),
    ('start.AB.omega = "~3 rad/s"', 'start.AB.omega = "~3 rad/s"'),
]


def merged(change: str) -> dict[str, Any]:
    """The base scene with the change put over it."""

    def merge(table: dict[str, Any], other: dict[str, Any]) -> None:
        for key, value in other.items():
            if isinstance(value, dict) and isinstance(table.get(key), dict):
                merge(table[key], value)
            else:
                table[key] = value

    raw = tomllib.loads(BASE)
    merge(raw, tomllib.loads(change))
    return raw


def message(change: str) -> str:
    with pytest.raises(SceneError) as caught:
        flatten(Scene.from_raw(merged(change), file="x.toml"))
    assert caught.value.file == "x.toml"
    return str(caught.value)


def test_the_base_is_right() -> None:
    flatten(load_text(BASE))


@pytest.mark.parametrize(("change", "expected"), FAULTS)
def test_fault(change: str, expected: str) -> None:
    text = message(change)
    assert text.startswith("x.toml: ")
    assert expected in text


@pytest.mark.parametrize(("change", "place"), NOT_BUILT)
def test_words_that_are_known_and_not_built(change: str, place: str) -> None:
    text = message(change)
    assert text.startswith(f"x.toml: {place}: ")
    assert "not built yet" in text


def test_left_out_end_and_bodies() -> None:
    with pytest.raises(SceneError, match="until: what ends the run is wanted"):
        load_text('bodies.P = { mass = "1 kg" }')
    with pytest.raises(SceneError, match="bodies: a scene needs at least one body"):
        load_text('until = "start"')


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a = 1\na = 2", "no TOML: line 2: Cannot overwrite a value"),
        ("until = ", "no TOML: line 1: Invalid value"),
        ("[a]\n[a]", "no TOML: line 2"),
    ],
)
def test_toml_faults_name_file_and_line(text: str, expected: str) -> None:
    with pytest.raises(SceneError) as caught:
        load_text(text, file="x.toml")
    assert str(caught.value).startswith(f"x.toml: {expected}")


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"none\.toml: cannot be read: No such file"):
        load(tmp_path / "none.toml")
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneError, match="not text in UTF-8"):
        load(tmp_path / "binary.toml")


@pytest.mark.parametrize(
    ("shape", "place"),
    [
        ('rod = ["A", "B"], length = "-1 m"', "length"),
        ('rod = ["A", "B"], length = 0', "length"),
        ('disk = "-3 in"', "disk"),
        ('plate = ["1 m", "-2 m"]', r"plate\[1\]"),
    ],
)
def test_sizes_of_shapes_are_positive(shape: str, place: str) -> None:
    text = f'until = "t = 1 s"\nask.x = "a.x"\nbodies.a = {{ {shape}, mass = "1 kg", at = [0, 0] }}'
    with pytest.raises(SceneError, match=rf"bodies\.a\.{place} = .*must be positive"):
        load_text(text).run()


def said_of(text: str) -> str:
    """What a scene that does not run says: as an exception, or as the error of its result."""
    try:
        return load_text(text, file="x.toml").run().error or ""
    except PlanemotionError as error:
        return str(error)


# Scenes of the chapter, broken: what is replaced by what, and what is said of it.
BROKEN = [
    (
        "17-C5",
        'D = { slider = ["BD.D", "ground.level"] }',
        'D = { rolling = ["BD.D", "ground.level"] }',
        'joints.D.rolling[0] = "BD.D": BD.D is a point; a circle is wanted',
    ),
    ("17-C5", '"BD.B"]', '"BE.B"]', 'joints.B.pin[1] = "BE.B": unknown body "BE"; there is AB, BD, ground'),
    (
        "17-C5",
        'L = "30 in"',
        'L = "30 lb"',
        'bodies.AB.length = "L": a length (such as m) is wanted; this is a force',
    ),
    (
        "17-086",
        'm_disk = "4 kg"',
        'm_disk = "-4 kg"',
        'bodies.disk.mass = "m_disk": it is -4 kg and must not be',
    ),
    ("17-086", ', mass = "m_disk"', "", "bodies.disk.mass: mass or weight is wanted"),
    ("17-086", '"90 mm"', '"90 mmm"', 'unknown unit "mmm" (did you mean "mm"?)'),
    (
        "17-042",
        'nudge = "BD.D.velocity.x < 0"',
        'AB.omega = "2 rad/s"\nBD.omega = "5 rad/s"',
        "start.AB.omega: 2 rad/s is given, but the other start values and the joints give 0; leave one",
    ),
    (
        "17-042",
        'nudge = "BD.D.velocity.x < 0"',
        "",
        "everything is at rest from the start and stays: give a velocity",
    ),
    ("17-042", '[0, "-L"]', '[0, "-3*L"]', "joints.D is open by 1.28 m (allowed"),
    ("17-079", "edge_on = true", 'edge_on = "yes"', 'bodies.disk.edge_on = "yes": true or false is wanted'),
    (
        "17-079",
        'W_yoke = "1.5 lb"',
        'W_yoke = "-1.5 lb"',
        "it is -0.00394745 kg*m^2 and must not be negative",
    ),
    (
        "17-106",
        "restitution = 1 }",
        "restitution = 1.5 }",
        "contacts.A.restitution = 1.5: it must lie between 0 and 1",
    ),
    (
        "17-106",
        '"A_strikes 2"',
        '"A_strikes 2.5"',
        'until = "A_strikes 2.5": an operator or the end is wanted',
    ),
    (
        "17-076",
        'L_rod = "8 in"',
        'L_rod = "9 in"',
        "couplings.mesh_A: the pitch circles are drawn 0.0127 m from",
    ),
    ("17-076", "= omega_rod", "= 100*omega_rod", "is not met with M from 0 ft*lb to 10 ft*lb"),
    ("17-076", "vary = { M", "vary = { N", 'find.vary.N: unknown parameter "N"; there is g, W_gear'),
    ("17-138", "AB.axis on AB", "AB.axis on AC", "B acts on AB and ground, not on AC"),
    (
        "17-138",
        '"AB.omega < 0"',
        '"AB.omega"',
        'start.nudge = "AB.omega": a side is wanted: a velocity < 0 or > 0',
    ),
    ("17-SP04", '"k_spring"', '"-k_spring"', "it is -315228 N/m and must not be negative"),
    ("17-SP04", '"push"', '"pushes"', "forces.spring.only = \"pushes\": 'push' or 'pull' is wanted"),
    ("17-SP04", '["rod.A", "ground.S"]', '["rod.A"]', "forces.spring.spring: two partners are wanted"),
    ("17-123", "turning = false", "turning = 0", "joints.floor.turning = 0: true or false is wanted"),
    (
        "17-123",
        '"before blow"',
        '"before blows"',
        'unknown instant "blows"; there is blow, end (did you mean',
    ),
    ("17-123", 'of = "CD.velocity.x"', 'of = "CD.velocity"', "a part is wanted: x, y, norm, angle, or along"),
    (
        "17-119",
        '"crate.omega > 0"',
        '"crate.omega >"',
        "it ends where a number, a name or a parenthesis is wanted",
    ),
    (
        "17-119",
        '"B strikes"',
        '"E strikes"',
        'events.strike = "E strikes": unknown contact "E"; there is A, B',
    ),
    ("17-119", '"D", "C"]', '"D"]', "bodies.crate.corners: four names are wanted"),
]


@pytest.mark.parametrize(("stem", "old", "new", "expected"), BROKEN)
def test_scenes_of_the_chapter_broken_on_purpose(stem: str, old: str, new: str, expected: str) -> None:
    text = (CHAPTER / f"{stem}.toml").read_text(encoding="utf-8")
    assert old in text
    said = said_of(text.replace(old, new, 1))
    assert said.startswith("x.toml: ")
    assert expected in said
