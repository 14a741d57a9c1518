"""Every fault in a scene is told with file, key path, value and the nearest right word."""

from __future__ import annotations

from pathlib import Path

import pytest

from planemotion import SceneError, load, load_text
from planemotion.compile.flatten import flatten
from planemotion.reading.advice import advice
from tests.reading.changed import BASE, assert_told, merged, message

# What is added to (or put over) the base, and the message after "x.toml: ".
FAULTS = [
    # words
    (
        'joints.A = { pin = ["AB.A", "ground"], frictoin = 0.1 }',
        'joints.A.frictoin: unknown key (did you mean "friction"?); a pin has friction, '
        "friction_couple, angle, active",
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
        'ask.a.att: unknown key (did you mean "at"?); an ask has of, max, min, integral, mean, rms, median, ',
    ),
    (
        "sweep.L = { from = 1, to = 2, nun = 3 }",
        'sweep.L.nun: unknown key (did you mean "num"?); a grid has from, to, num, step, scale',
    ),
    (
        'bodies.start = { mass = "1 kg" }',
        'bodies.start: "start" has a meaning of its own; choose another name',
    ),
    ('contacts.AB = { touch = ["disk.rim", "ground.floor"] }', "contacts.AB: the name is taken by bodies.AB"),
    ("ground.points.x = [0, 0]", 'ground.points.x: "x" is a quantity in addresses; choose another name'),
    # types
    ("bodies = 3", "bodies = 3: a table is wanted"),
    ("id = 3", "id = 3: a text is wanted"),
    ('plane = "tilted"', 'plane = "tilted": "vertical" or "horizontal" is wanted'),
    ('joints.A = { pin = ["AB.A"] }', 'joints.A.pin = ["AB.A"]: two partners are wanted'),
    (
        "ground.points.Q = [0]",
        "ground.points.Q = [0]: a vector is wanted: [x, y] or { polar = [size, angle] }",
    ),
    ("bodies.AB.mass = nan", "bodies.AB.mass = nan: the number must be finite"),
    ("bodies.AB.mass = [1]", "bodies.AB.mass = [1]: a number, a quantity"),
    ('until = ["start", 3]', 'until = ["start", 3]: a condition or a list of conditions is wanted'),
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
    (
        'ask.a = { of = "AB.omega", at = "start" }',
        'there is end; a condition gets a name: events.NAME = "start", then at = "NAME"',
    ),
    (
        'ask.a = { of = "AB.omega", at = "before t = 0.1 s" }',
        'a condition gets a name: events.NAME = "t = 0.1 s", then at = "before NAME"',
    ),
    (
        'events.hit = "AB.omega < 0"\nask.a = { of = "AB.omega", at = "after hit" }',
        'ask.a.at = "after hit": write "hit": that is just after the event, "before hit" just before it',
    ),
    ('until = "2 s"', 'until = "2 s": a time is no condition: write "t = 2 s"'),
    (
        'parameters.L = "1,2 m"',
        'not "," (character 2); a number has a decimal point, no comma',
    ),
    ('ask.a = "2*b"\nask.b = "2*a"', "ask.a: it reads itself: a reads b reads a"),
    ('ask.a = { max = "AB.omega" }\nask.b = { min = "a" }', 'ask.b.min = "a": "a" is an ask'),
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
    ('bodies.Q = { mass = "1 kg", angle = "3 deg" }', "a particle does not rotate; leave out angle"),
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
        'contacts.c = { touch = ["P", "ground.O"], capture = "disc" }',
        'contacts.c.capture = "disc": "none", "pin" or "body" is wanted',
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "pin", restitution = 0.5 }',
        "contacts.c.restitution: what is captured stays; it has no restitution",
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "pin", friction = "rough" }',
        "contacts.c.friction: what is captured stays; it has no friction",
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "pin", law = "stronge" }',
        "contacts.c.law: what is captured stays; it has no law",
    ),
    (
        'contacts.c = { touch = ["P", "ground.floor"], capture = "pin", surface_speed = "1 m/s" }',
        'contacts.c.surface_speed = "1 m/s": what is captured stays at its place',
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "pin" }\nask.a = "c.normal"',
        'unknown quantity of a contact that captures "normal"; there is gap, closed, force, couple, impulse',
    ),
    (
        'contacts.c = { touch = ["P", "ground.O"], capture = "pin" }\nevents.e = "c slips"',
        'what "c" captures stays at its place; it strikes or opens',
    ),
]

NOT_BUILT = [
    ('start.AB.omega = "~3 rad/s"', 'start.AB.omega = "~3 rad/s"'),
]


def test_the_base_is_right() -> None:
    flatten(load_text(BASE))


@pytest.mark.parametrize(("change", "expected"), FAULTS)
def test_fault(change: str, expected: str) -> None:
    assert_told(change, expected)


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
        ("a = 1\na = 2", "2:6: this is not TOML: a is given twice: a table or key that stands above"),
        ("b.c = { a = 1 }\nb.c = { a = 1 }", "2:16: this is not TOML: b.c is given twice"),
        ("b = { a = 1, c = { a = 1, a = 2 } }", "1:32: this is not TOML: a is given twice"),
        ("b = { a = { x = 1 }, a.x = 2 }", "1:29: this is not TOML: given twice"),
        (
            "until = ",
            "1:9: this is not TOML: a number, true, false, a text, a list or a table is wanted; a text",
        ),
        (
            "until = strike",
            "1:9: this is not TOML: a number, true, false, a text, a list or a table is wanted, not `strike`",
        ),
        ("[a]\n[a]", "2:3: this is not TOML: [a] is given twice"),
        ("[a\n", '1:3: this is not TOML: "]" is wanted behind the name of a table'),
        (
            "L = 1.2 m",
            "1:9: this is not TOML: the end of the line is wanted, not `m`; a text stands in quotation marks",
        ),
        ("a = { L = 1.2 m }", '1:15: this is not TOML: "," or "}" is wanted, not `m }`; a text'),
        ("a = [1, 2", '1:10: this is not TOML: "," or "]" is wanted; a text'),
        ("a = { b = 1 }\n[a.c]", "2:5: this is not TOML: [a.c] is given twice"),
        ('a = "b\nc = 2', "1:7: this is not TOML: the quotation mark at the end of a text is missing"),
        ('a = "\\q"', '1:8: this is not TOML: a text in "" has "\\\\" for a backslash'),
        ("until: 3", '1:6: this is not TOML: "=" is wanted behind the key, not `: 3`'),
        (
            "import planemotion as pm",
            '1:8: this is not TOML: "=" is wanted behind the key, not `planemotion as pm`',
        ),
        ("{}", '1:1: this is not TOML: a line is [a.table], key = value, or a comment behind "#"'),
    ],
)
def test_toml_faults_name_file_and_place(text: str, expected: str) -> None:
    with pytest.raises(SceneError) as caught:
        load_text(text, file="x.toml")
    assert str(caught.value).startswith(f"x.toml:{expected}")


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


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (
            "bodies.AB.angle = 30",
            'bodies.AB.angle = 30: without a unit it is in radians; "30 deg" are degrees',
        ),
        (
            'bodies.AB.angle = "~-30"',
            'bodies.AB.angle = ~-30: without a unit it is in radians; "~-30 deg" are',
        ),
        (
            'until = "AB.turned = -90"',
            'until = "AB.turned = -90": without a unit it is in radians; "AB.turned = -90 deg" are degrees',
        ),
        ('events.e = ["AB.angle > 90", "start"]', 'events.e = "AB.angle > 90": without a unit it is in'),
        ('events.e = { when = "AB.angle<(90)" }', '"AB.angle< 90 deg" are degrees'),
        ("bodies.AB.angle = 3", ""),
        ('until = "AB.turned = -90 deg"', ""),
        ('until = "AB.turned = 6.28"', ""),
        ('until = "AB.omega = 30/(1 s)"', ""),
    ],
)
def test_angles_without_a_unit_are_hinted_at(change: str, told: str) -> None:
    found = [one for one in advice(merged(change)) if "radians" in one]
    assert len(found) == bool(told)
    assert told in "".join(found)
