"""What is said of couplings, drives, finds, nudges, planes that turn and actions."""

from __future__ import annotations

import pytest

from tests.reading.changed import message

SPIN = 'spin = { through = [0, 0], angle = "90 deg" }\n'


def doing(action: str) -> str:
    """An event that does one thing."""
    return f'events.e = {{ when = "start", do = [{{ {action} }}] }}'


FAULTS = [
    # couplings and drives
    (
        'couplings.c = { gear = ["disk.rim", "AB.A"] }',
        "couplings.c: which kind of coupling? one of gears, belt, cord, motor, ratio is wanted "
        '("gear": did you mean "gears"?)',
    ),
    (
        'couplings.c = { gears = ["disk.rim", "AB.A"] }',
        'couplings.c.gears[1] = "AB.A": AB.A is a point; a circle or line is wanted',
    ),
    ('couplings.c = { cord = ["P"] }', 'couplings.c.cord = ["P"]: at least two points or rims are wanted'),
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
        'couplings.c.ratio = ["disk", "AB"]: two bodies are wanted',
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
        'couplings.c.ratio.P.turned = "P": a particle does not rotate; a body with an inertia is wanted',
    ),
    (
        "couplings.c = { ratio = { disk.turned = 1, ground.turned = 2 } }",
        "couplings.c.ratio.ground.turned: the ground does not rotate; a body is wanted",
    ),
    (
        'couplings.c = { motor = ["disk", "AB"] }',
        "couplings.c.value: the spin of the first body relative to the second is wanted",
    ),
    (
        'couplings.c = { motor = ["disk", "P"], value = "3 rad/s" }',
        'couplings.c.motor[1] = "P": a particle does not rotate; a body with an inertia is wanted',
    ),
    (
        'couplings.c = { motor = ["disk", "AB"], value = "3 m/s" }',
        'couplings.c.value = "3 m/s": an angular velocity (1/time, such as rad/s) is wanted',
    ),
    ("bodies.AB.driven = { speed = 3 }", 'bodies.AB.driven.speed: unknown key (did you mean "velocity"?)'),
    (
        'bodies.P.driven = { omega = "3 rad/s" }',
        "bodies.P.driven.omega: a particle does not rotate; leave out omega",
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
    ("find = { vari = {} }", 'find.vari: unknown key (did you mean "vary"?); a find has vary, where,'),
    ("runs.a.find = { vary = 3 }", "runs.a.find.vary = 3: the ranges to look in are wanted, such as"),
    ('find.vary.L = "1 m"', 'find.vary.L = "1 m": two bounds are wanted: [lowest, greatest]'),
    ('runs.a.find.vary.L = ["1 m"]', 'runs.a.find.vary.L = ["1 m"]: two bounds are wanted'),
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
    # planes that turn
    ("spin = {}", "spin.through: it is wanted and left out"),
    (
        "spin = { throuhg = [0, 0] }",
        'spin.throuhg: unknown key (did you mean "through"?); a spin has through, angle,',
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
    (doing('impulse = "P", work = "1 J"'), 'events.e.do[0].impulse = "P": a body that rotates is wanted'),
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
    ('events.e = { when = "start", nth = "2" }', 'events.e.nth = "2": a whole number is wanted'),
    ("events.e = { do = [] }", "events.e: an event needs a condition: when = ..."),
]


@pytest.mark.parametrize(("change", "expected"), FAULTS)
def test_fault_of_what_moves(change: str, expected: str) -> None:
    text = message(change)
    assert text.startswith("x.toml: ")
    assert expected in text
