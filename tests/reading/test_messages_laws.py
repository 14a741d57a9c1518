"""Faults of contacts, finds, forces and friction: what is wrong, with key path and value."""

from __future__ import annotations

import pytest

from tests.reading.changed import assert_told

# What is added to (or put over) the base, and what is said of it.
FAULTS = [
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
        'solve.impacts = "one after one"',
        'solve.impacts: unknown order of impacts "one after one"; there is simultaneous, sequential',
    ),
    ('events.e = "3 > 2"', 'events.e = "3 > 2": nothing in this condition changes with the motion'),
    ('events.e = "AB.angle >= 3"', 'events.e = "AB.angle >= 3": an event fires on a crossing; write >'),
    ('ask.a = { max = "AB.omega", at = "end" }', "ask.a.at: an extreme over the run has no instant"),
    (
        "ask.a = {}",
        "ask.a: one of of, max, min, integral, mean, rms, median, percentile, period, ",
    ),
    (
        'start.AB.speed = "3 m/s"',
        "it cannot be given at the start; what can: angle, omega, and of a point x, y,",
    ),
    (
        'ask.a = "AB.speed.x"',
        '"AB.speed" is one number and has no part "x"; a vector has parts, such as velocity.x',
    ),
    ('ask.a = "AB.velocity.x.y"', '"AB.velocity.x" is one number and has no part "y"'),
    (
        'ask.a = { of = "AB.omega", at = "before 0.2 s" }',
        'unknown instant "0.2 s"; there is end; a time gets a name: events.NAME = "t = 0.2 s", '
        'then at = "before NAME"',
    ),
    ('ask.a = "AB.omega at strike"', 'an ask has its instant beside it: { of = "AB.omega", at = "strike" }'),
    ('ask.a = "AB.omega at"', '{ of = "AB.omega", at = "EVENT" }'),
    ('bodies.Q = { disk = "L m", mass = "1 kg", at = [0, 0] }', "; a unit stands only behind a number"),
    (
        'bodies.Q = { disk = "2L", mass = "1 kg", at = [0, 0] }',
        'this is a volume; "2L" has L as its unit: a product is written 2*L',
    ),
    (
        'forces.weight = "9.81 m/s^2"',
        "a table is wanted: { KIND = ..., and options }; a force is one of spring, ",
    ),
    (
        'find.vary = "L"',
        'find.vary = "L": the ranges to look in are wanted, such as vary = { h = ["0 m", "2 m"] }',
    ),
    (
        'bodies.Q = { plate = ["1 m", "1 m"], mass = "1 kg", at = [0, "3 m"] }\n'
        'contacts.c = { touch = ["Q.P", "ground.floor"] }',
        'body "Q" has no mark "P"; it has bottom, right, top, left, corners, G, center, lower_left, '
        "lower_right, upper_right, upper_left",
    ),
    (
        'forces.f = { force = "AB.B", value = ["(3 kg)*AB.acceleration.x", 0] }',
        '"AB.acceleration.x" is known only when all forces are',
    ),
    (
        'forces.f = { force = "AB.B", value = ["(3 N/m)*AB.u", 0] }',
        'forces.f.value[0] = "(3 N/m)*AB.u": body "AB" has no point or quantity "u"',
    ),
    (
        'forces.f = { force = "AB.B", value = ["(3 kg)*AB.x", 0] }',
        "a force (mass*length/time^2, such as N) is wanted; this is a quantity of mass*length",
    ),
    (
        'forces.f = { force = ["AB.B", "ground.O"], value = [0, "1 N"] }',
        "a number is wanted: the force that draws the two points together",
    ),
    (
        'forces.f = { couple = "ground", power = "3 W" }',
        "forces.f.power: the ground does not turn: a power needs a body that does",
    ),
    (
        'joints.A = { pin = ["AB.A", "ground"], friction_couple = 0.3 }',
        "joints.A.friction_couple = 0.3: a moment",
    ),
    (
        'joints.A = { pin = ["AB.A", "ground"], friction = { mu = 0.3 } }',
        "joints.A.friction: friction is a number, or { mu = ..., radius = ... } of a bearing",
    ),
    (
        'joints.S = { slider = ["AB.A", "ground.floor"], friction = { mu = 0.3, radius = "1 m" } }',
        "joints.S.friction: a slider has no radius",
    ),
    (
        'joints.S = { pin = ["P", "ground"], friction_couple = "1 N*m" }',
        "joints.S.friction_couple: a particle does not rotate: its pin has no friction",
    ),
    ('forces.f = { couple = "AB", power = "3 N" }', 'forces.f.power = "3 N": a power (mass*length^2/time^3'),
    (
        'forces.f = { couple = "AB", power = "3 W", value = "1 N*m" }',
        "forces.f.power: give power or value, not both",
    ),
    (
        'forces.f = { couple = "AB", value = { over = "t", at = [0], values = [0] } }',
        "forces.f.value: a table of values has a name of its own",
    ),
]


@pytest.mark.parametrize(("change", "expected"), FAULTS)
def test_fault(change: str, expected: str) -> None:
    assert_told(change, expected)
