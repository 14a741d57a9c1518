"""The kernel's tables: what scenes become, by reading the tables and running their programs in Python."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from planemotion import SceneError, load_text
from planemotion import _layout as layout
from planemotion.compile.flatten import FlatScene, flatten
from planemotion.engine.evaluator import run_program, value_table

G = 9.81
PARTICLE = 'until = "start"\nbodies.P = { mass = "1 kg", at = ["1 m", "2 m"] }\n'


class Tables:
    """The tables of a scene with the values of one case."""

    def __init__(self, text: str, run: str | None = None, **param: float) -> None:
        self.flat: FlatScene = flatten(load_text(text), run)
        case = dict(zip(self.flat.parameters, self.flat.defaults, strict=True)) | param
        self.param = np.array([case[name] for name in self.flat.parameters])
        self.value = value_table(self.flat, self.param)

    def row(self, table: str, path: str) -> dict[str, int]:
        """The first row with that key path, by column name."""
        index = self.flat.names[layout.pm_table[f"PM_TABLE_{table}"]].index(path)
        return self.rows(table)[index]

    def rows(self, table: str) -> list[dict[str, int]]:
        columns: dict[str, int] = getattr(layout, f"pm_{table.lower()}_column")
        prefix = f"PM_{table}_"
        names = {
            number: name.removeprefix(prefix)
            for name, number in columns.items()
            if not name.endswith("_COLUMNS")
        }
        table_rows = self.flat.rows(layout.pm_table[f"PM_TABLE_{table}"])
        return [{names[i]: int(entry) for i, entry in enumerate(row)} for row in table_rows]

    def pose(self, body: str) -> tuple[float, float, float]:
        row = self.row("BODY", f"bodies.{body}")
        x, y, angle = (float(self.value[row[column]]) for column in ("X", "Y", "ANGLE"))
        return x, y, angle

    def point(self, index: int) -> tuple[int, float, float]:
        row = self.rows("POINT")[index]
        return row["BODY"], float(self.value[row["X"]]), float(self.value[row["Y"]])

    def program(self, index: int) -> float:
        return run_program(self.flat, index, self.param, self.value)


def body_of(keys: str) -> Tables:
    return Tables(f'until = "start"\nbodies.Q = {{ {keys} }}')


# ---- bodies ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("keys", "mass", "inertia"),
    [
        ('rod = ["A", "B"], length = "3 m", mass = "2 kg"', 2, 2 * 9 / 12),
        ('disk = "3 m", mass = "2 kg"', 2, 9),
        ('cylinder = "3 m", mass = "2 kg"', 2, 9),
        ('hoop = "3 m", mass = "2 kg"', 2, 18),
        ('sphere = "3 m", mass = "2 kg"', 2, 7.2),
        ('half_ring = "3 m", mass = "2 kg"', 2, 18 * (1 - 4 / math.pi**2)),
        ('plate = ["3 m", "4 m"], mass = "2 kg"', 2, 2 * 25 / 12),
        ('mass = "2 kg", gyration = "3 m"', 2, 18),
        ('mass = "2 kg", inertia = "5 kg*m^2"', 2, 5),
        ('disk = "3 m", mass = "2 kg", inertia = "5 kg*m^2"', 2, 5),
        ('disk = "3 m", weight = "2 N"', 2 / G, 9 / G),
        ('mass = "2 kg"', 2, 0),
    ],
)
def test_mass_and_inertia(keys: str, mass: float, inertia: float) -> None:
    tables = body_of(keys)
    row = tables.row("BODY", "bodies.Q")
    assert tables.value[row["MASS"]] == pytest.approx(mass, rel=1e-15)
    assert tables.value[row["INERTIA"]] == pytest.approx(inertia, rel=1e-15)
    assert row["TURNS"] == (inertia > 0)


def test_weight_is_divided_by_g_also_in_a_horizontal_plane() -> None:
    tables = Tables(
        'plane = "horizontal"\nuntil = "start"\nparameters.g = "10 m/s^2"\nbodies.Q = { weight = "30 N" }'
    )
    assert tables.value[tables.row("BODY", "bodies.Q")["MASS"]] == 3
    setting = tables.rows("SETTING")[0]
    assert tables.value[setting["GRAVITY_Y"]] == 0
    assert Tables(PARTICLE).value[Tables(PARTICLE).rows("SETTING")[0]["GRAVITY_Y"]] == -G


ROD = 'rod = ["A", "B"], mass = "1 kg", '
DISK = 'disk = "1 m", mass = "1 kg", '
PLATE = 'plate = ["2 m", "2 m"], corners = ["A", "B", "C", "D"], mass = "1 kg", '
POINTS = 'points = { P = { from = "Q", by = ["1 m", 0] }, Q = [0, "1 m"] }, '


@pytest.mark.parametrize(
    ("keys", "pose"),
    [
        (DISK + 'at = ["2 m", "3 m"], angle = "30 deg"', (2, 3, math.pi / 6)),
        (DISK + 'at = { polar = ["2 m", "90 deg"] }', (0, 2, 0)),
        (DISK + 'mass_center = ["0.5 m", 0], at = [0, 0], angle = "90 deg"', (0, 0.5, math.pi / 2)),
        (DISK + POINTS + "at = { P = [0, 0] }", (-1, -1, 0)),
        ('disk = "1 m", mass = "1 kg"', (0, 0, 0)),
        ('half_ring = "1 m", mass = "1 kg", at = [0, 0]', (2 / math.pi, 0, 0)),
        (ROD + 'length = "2 m", at = { A = [0, 0] }, angle = "90 deg"', (0, 1, math.pi / 2)),
        (ROD + 'length = "2 m", at = { B = ["1 m", 0] }, angle = "~180 deg"', (2, 0, math.pi)),
        (ROD + 'at = { A = ["1 m", 0], B = ["1 m", "2 m"] }', (1, 1, math.pi / 2)),
        (PLATE + 'at = { A = [0, 0], C = [0, "8^0.5*(1 m)"] }', (0, math.sqrt(2), math.pi / 4)),
    ],
)
def test_drawn_pose_of_the_mass_centre(keys: str, pose: tuple[float, float, float]) -> None:
    assert body_of(keys).pose("Q") == pytest.approx(pose, abs=1e-15)


CHAIN = """
until = "start"
parameters = { L = "1 m", a = "90 deg" }
ground.points.O = ["1 m", 0]
bodies.third = { mass = "1 kg", at = "second.D" }
bodies.second = { rod = ["C", "D"], length = "L", mass = "1 kg", at = { C = "first.B" }, angle = "0 deg" }
bodies.first = { rod = ["A", "B"], length = "L", mass = "1 kg", at = { A = "ground.O" }, angle = "a" }
"""


def test_bodies_are_placed_at_each_others_points_in_any_order() -> None:
    assert Tables(CHAIN).pose("third") == pytest.approx((2, 1, 0))
    assert Tables(CHAIN, L=2.0, a=0.0).pose("third") == pytest.approx((5, 0, 0))


def test_a_body_without_at_is_drawn_where_pins_hold_it() -> None:
    text = """
until = "start"
ground.points.O = ["2 m", "1 m"]
bodies.a = { rod = ["A", "B"], length = "1 m", mass = "1 kg", angle = "90 deg" }
bodies.b = { rod = ["A", "B"], length = "1 m", mass = "1 kg" }
bodies.c = { mass = "1 kg" }
[joints]
one = { pin = ["a.A", "ground.O"] }
two = { pin = ["b.A", "a.B"] }
three = { pin = ["c", "b.B"] }
"""
    tables = Tables(text)
    assert tables.pose("a") == pytest.approx((2, 1.5, math.pi / 2))
    assert tables.pose("b") == pytest.approx((2.5, 2, 0))
    assert tables.pose("c") == pytest.approx((3, 2, 0))
    # None of it was written, but the angle.
    assert [row["LEVEL"] for row in tables.rows("START")] == [layout.PM_START_POSITION]


# ---- start ----------------------------------------------------------------------------------------------


def starts(tables: Tables) -> list[tuple[str, str, float]]:
    """Start rows as (measure kind, part, value)."""
    kinds = {value: name.removeprefix("PM_MEASURE_") for name, value in layout.pm_measure_kind.items()}
    parts = {value: name.removeprefix("PM_PART_") for name, value in layout.pm_part.items()}
    found = []
    for row in tables.rows("START"):
        measure = tables.rows("MEASURE")[row["MEASURE"]]
        found.append((kinds[measure["KIND"]], parts[measure["PART"]], float(tables.value[row["VALUE"]])))
    return found


def fastened(keys: str) -> list[tuple[str, str, float]]:
    text = f"""
until = "start"
ground.lines.track = {{ through = [0, 0] }}
bodies.AB = {{ rod = ["A", "B"], length = "2 m", mass = "1 kg", {keys} }}
joints.A = {{ slider = ["AB.A", "ground.track"] }}
"""
    return starts(Tables(text))


def test_what_is_written_exactly_binds_fastened_bodies() -> None:
    x, y, angle = ("POSITION", "X", 1.0), ("POSITION", "Y", 0.0), ("ANGLE", "NONE", math.pi / 2)
    assert fastened('at = { A = ["1 m", 0] }, angle = "90 deg"') == [x, y, angle]
    assert fastened('at = { A = ["1 m", 0] }, angle = "~90 deg"') == [x, y]
    assert fastened('at = { A = ["~1 m", 0] }, angle = "90 deg"') == [y, angle]
    assert fastened('at = { A = ["~1 m", "~0 m"] }, angle = "~90 deg"') == []
    assert fastened('at = { A = ["1 m", 0], B = ["1 m", "2 m"] }') == [x, y, angle]
    # Placed by numbers and no angle: drawn at 0 and meant so.
    assert fastened('at = { A = ["1 m", 0] }') == [x, y, ("ANGLE", "NONE", 0.0)]


def test_a_free_body_needs_no_start_rows() -> None:
    assert starts(Tables(PARTICLE)) == []


def test_a_place_on_another_body_binds_only_if_that_is_exact() -> None:
    text = """
until = "start"
bodies.a = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = [0, 0] }, angle = "ANGLE" }
bodies.b = { rod = ["A", "B"], length = "1 m", mass = "1 kg", at = { A = "a.B" } }
joints = { one = { pin = ["a.A", "ground"] }, two = { pin = ["a.B", "b.A"] } }
"""
    assert len(starts(Tables(text.replace("ANGLE", "10 deg")))) == 5
    assert len(starts(Tables(text.replace("ANGLE", "~10 deg")))) == 2


def test_start_values_by_address() -> None:
    text = PARTICLE + (
        'bodies.Q = { disk = "1 m", mass = "1 kg", at = [0, 0] }\n'
        'start.P.velocity = { polar = ["2 m/s", "90 deg"] }\n'
        'start.Q = { omega = "3 rad/s", angle = "1 rad" }\n'
        'start."P.velocity along 30 deg" = "1 m/s"\n'
    )
    tables = Tables(text)
    expected = [
        ("VELOCITY", "X", pytest.approx(0, abs=1e-15)),
        ("VELOCITY", "Y", 2.0),
        ("OMEGA", "NONE", 3.0),
        ("ANGLE", "NONE", 1.0),
        ("VELOCITY", "ALONG", 1.0),
    ]
    assert starts(tables) == expected
    levels = [row["LEVEL"] for row in tables.rows("START")]
    assert levels == [layout.PM_START_VELOCITY] * 3 + [layout.PM_START_POSITION, layout.PM_START_VELOCITY]


# ---- joints, contacts, forces ---------------------------------------------------------------------------

TWO_RODS = """
until = "start"
ground.points.O = ["3 m", 0]
ground.lines.guide = { through = [0, "1 m"], angle = "30 deg" }
ground.circles.arc = { center = [0, 0], radius = "5 m" }
ground.rows.bars = { from = [0, 0], step = ["1 m", 0] }
bodies.a = { rod = ["A", "B"], length = "2 m", mass = "1 kg", at = { A = [0, 0] }, angle = "90 deg" }
bodies.b = { rod = ["A", "B"], length = "2 m", mass = "1 kg", at = { A = ["1 m", 0] }, angle = "30 deg" }
bodies.p = { mass = "1 kg", at = ["3 m", "4 m"] }
bodies.wheel = { disk = "1 m", mass = "1 kg", at = ["6 m", 0] }
bodies.rim = { hoop = "3 m", mass = "1 kg", at = ["6 m", "2 m"] }
"""


def joint(text: str) -> tuple[str, dict[str, int], Tables]:
    tables = Tables(TWO_RODS + f"joints.j = {{ {text} }}")
    row = tables.row("JOINT", "joints.j")
    kinds = {value: name.removeprefix("PM_JOINT_") for name, value in layout.pm_joint_kind.items()}
    return kinds[row["KIND"]], row, tables


def test_lengths_are_as_drawn_or_as_written() -> None:
    kind, row, tables = joint('link = ["a.B", "b.A"]')
    assert kind == "LINK"
    assert tables.value[row["VALUE"]] == pytest.approx(math.sqrt(5))
    _, row, tables = joint('link = ["a.B", "b.A"], length = "7 m"')
    assert tables.value[row["VALUE"]] == 7
    kind, row, tables = joint('slot = ["a.B", "ground.arc"]')
    assert kind == "LINK"
    assert tables.value[row["VALUE"]] == 5


def test_the_ground_is_where_the_other_partner_is_drawn() -> None:
    kind, row, tables = joint('pin = ["a.B", "ground"]')
    assert kind == "PIN"
    assert tables.point(row["A"]) == pytest.approx((0, 1, 0))
    assert tables.point(row["B"]) == pytest.approx((layout.PM_GROUND, 0, 2))


def test_a_weld_keeps_the_drawn_place_and_angle() -> None:
    kind, row, tables = joint('weld = ["a", "b"]')
    assert kind == "WELD"
    assert tables.value[row["VALUE"]] == pytest.approx(math.pi / 3)
    body, x, y = tables.point(row["B"])
    bx, by, angle = tables.pose("b")
    assert body == 1
    assert (
        bx + math.cos(angle) * x - math.sin(angle) * y,
        by + math.sin(angle) * x + math.cos(angle) * y,
    ) == (
        pytest.approx(tables.pose("a")[0], abs=1e-15),
        pytest.approx(tables.pose("a")[1]),
    )


@pytest.mark.parametrize("order", ['"p", "a"', '"a", "p"'])
def test_the_weld_of_a_particle_is_a_pin_at_its_place(order: str) -> None:
    kind, row, tables = joint(f"weld = [{order}]")
    assert kind == "PIN"
    points = {tables.point(row[column])[0]: tables.point(row[column])[1:] for column in ("A", "B")}
    assert points == {
        2: (0, 0),
        0: pytest.approx((3, -3)),
    }  # (3, 4) from G of a = (0, 1), in axes turned by 90 deg


def test_sliders_turn_unless_they_must_not() -> None:
    assert joint('slider = ["a.B", "ground.guide"]')[0] == "SLIDER"
    kind, row, tables = joint('slider = ["a.B", "ground.guide"], turning = false')
    assert kind == "SLIDER_FIXED"
    assert tables.value[row["VALUE"]] == pytest.approx(math.pi / 2)
    assert joint('slider = ["p", "ground.guide"], turning = false')[0] == "SLIDER"
    line = tables.rows("LINE")[row["B"]]
    assert tables.value[line["ANGLE"]] == pytest.approx(math.pi / 6)


@pytest.mark.parametrize(
    ("circles", "place", "expected"),
    [(("a", "b"), "4 m", 1), (("a", "b"), "2 m", -1), (("b", "a"), "2 m", -2), (("b", "a"), "4 m", 1)],
)
def test_circles_roll_inside_or_outside_as_drawn(
    circles: tuple[str, str], place: str, expected: float
) -> None:
    text = f"""
until = "start"
parameters.y = "{place}"
bodies.a = {{ disk = "1 m", mass = "1 kg", at = [0, "y"] }}
bodies.b = {{ hoop = "3 m", mass = "1 kg", at = [0, 0] }}
joints.j = {{ rolling = ["{circles[0]}.rim", "{circles[1]}.rim"] }}
"""
    tables = Tables(text)
    row = tables.row("JOINT", "joints.j")
    assert row["KIND"] == layout.PM_JOINT_ROLLING_CIRCLE
    assert tables.value[row["VALUE"]] == expected


BOX = """
[bodies.box]
plate = ["1 m", "1 m"]
corners = ["K", "L", "M", "N"]
mass = "1 kg"
at = [0, 0]
[contacts]
"""


def contacts(text: str) -> list[dict[str, Any]]:
    """Contact rows with the numbers of their columns."""
    tables = Tables(f"{TWO_RODS}{BOX}c = {{ {text} }}")
    kinds = {value: name.removeprefix("PM_CONTACT_") for name, value in layout.pm_contact_kind.items()}
    found = []
    for row in tables.rows("CONTACT"):
        circle = tables.rows("CIRCLE")[row["A"]]
        numbers = ("RESTITUTION", "STATIC", "KINETIC", "SIDE")
        values: dict[str, Any] = {key: float(tables.value[row[key]]) for key in numbers if row[key] >= 0}
        values |= {"kind": kinds[row["KIND"]], "law": row["FRICTION"]}
        found.append(values | {"radius": float(tables.value[circle["RADIUS"]]), "row": row, "tables": tables})
    return found


@pytest.mark.parametrize(
    ("touch", "kind", "radius"),
    [
        ('["wheel.rim", "ground.guide"]', "LINE", 1),
        ('["ground.guide", "wheel.rim"]', "LINE", 1),
        ('["a.B", "ground.guide"]', "LINE", 0),
        ('["p", "ground.guide"]', "LINE", 0),
        ('["wheel.rim", "rim.rim"]', "CIRCLE", 1),
        ('["wheel.rim", "ground.O"]', "CIRCLE", 1),
        ('["ground.O", "wheel.rim"]', "CIRCLE", 0),
        ('["wheel.rim", "ground.bars"]', "ROW", 1),
        ('["ground.bars", "wheel.rim"]', "ROW", 1),
    ],
)
def test_marks_that_touch(touch: str, kind: str, radius: float) -> None:
    (found,) = contacts(f"touch = {touch}")
    assert (found["kind"], found["radius"]) == (kind, radius)


def test_a_set_touches_with_each_of_its_points() -> None:
    found = contacts('touch = ["box.corners", "ground.guide"]')
    assert [one["kind"] for one in found] == ["LINE"] * 4
    names = found[0]["tables"].flat.names[layout.PM_TABLE_CONTACT]
    assert names == tuple(f"contacts.c[{i}]" for i in range(4))


def test_two_points_touch_along_a_normal() -> None:
    (found,) = contacts('touch = ["a.A", "b.A"], normal = "90 deg"')
    line = found["tables"].rows("LINE")[found["row"]["B"]]
    # The free side is on the left of the line, which is given in the axes of b (at 30 deg).
    assert found["tables"].value[line["ANGLE"]] == pytest.approx(math.radians(90 - 90 - 30))


@pytest.mark.parametrize(
    ("options", "law", "static", "kinetic"),
    [
        ("", "SMOOTH", None, None),
        ("friction = 0", "SMOOTH", None, None),
        ('friction = "smooth"', "SMOOTH", None, None),
        ('friction = "rough"', "ROUGH", None, None),
        ("friction = 0.3", "COULOMB", 0.3, 0.3),
        ("friction = { static = 0.4, kinetic = 0.3 }", "COULOMB", 0.4, 0.3),
    ],
)
def test_friction(options: str, law: str, static: float | None, kinetic: float | None) -> None:
    more = f", {options}" if options else ""
    (found,) = contacts(f'touch = ["wheel.rim", "ground.guide"], restitution = 0.5{more}')
    assert found["law"] == layout.pm_friction[f"PM_FRICTION_{law}"]
    assert (found.get("STATIC"), found.get("KINETIC")) == (static, kinetic)
    assert found["RESTITUTION"] == 0.5


def force(text: str) -> tuple[str, dict[str, int], Tables]:
    tables = Tables(TWO_RODS + f"forces.f = {{ {text} }}")
    row = tables.row("FORCE", "forces.f")
    kinds = {value: name.removeprefix("PM_FORCE_") for name, value in layout.pm_force_kind.items()}
    return kinds[row["KIND"]], row, tables


def test_springs() -> None:
    kind, row, tables = force('spring = ["a.B", "ground.O"], stiffness = "2 N/m", only = "push"')
    assert (kind, row["OPTION"]) == ("SPRING", layout.PM_SPRING_PUSH)
    assert tables.value[row["VALUE_1"]] == 2
    assert tables.value[row["VALUE_2"]] == pytest.approx(math.sqrt(13))
    kind, row, tables = force('torsion = ["a", "ground"], stiffness = "2 N*m"')
    assert (kind, row["A"], row["B"]) == ("TORSION", 0, layout.PM_GROUND)
    assert tables.value[row["VALUE_2"]] == pytest.approx(math.pi / 2)


def test_the_unit_of_the_rate_tells_dampers_apart() -> None:
    assert force('damper = ["a", "b"], rate = "2 N*s/m"')[0] == "DAMPER"
    assert force('damper = ["a", "b"], rate = "2 N*m*s"')[0] == "ROTARY_DAMPER"
    assert force('damper = ["a.B", "b.B"], rate = "2 N*s/m"')[0] == "DAMPER"


def test_applied_forces_and_couples() -> None:
    kind, row, tables = force('force = "a.B", value = { polar = ["2 N", "30 deg"] }, turns_with = "b"')
    assert (kind, row["B"]) == ("APPLIED", 1)
    assert tables.program(row["PROGRAM_X"]) == pytest.approx(math.sqrt(3))
    assert tables.program(row["PROGRAM_Y"]) == pytest.approx(1)
    kind, row, tables = force('couple = ["a", "b"], value = "(2 N*m/s)*t"')
    assert (kind, row["A"], row["B"]) == ("COUPLE", 0, 1)
    value = run_program(tables.flat, row["PROGRAM_X"], tables.param, tables.value, lambda _measure: 3.0)
    assert value == 6
    assert tables.rows("MEASURE")[0]["KIND"] == layout.PM_MEASURE_TIME


# ---- parameters and runs --------------------------------------------------------------------------------

DEPENDENT = """
until = "start"
parameters = { b = "2*a", c = "b + (1 m)", a = "3 m" }
bodies.P = { mass = "1 kg", at = ["c", 0] }
"""


def test_dependent_parameters_follow_the_others() -> None:
    assert Tables(DEPENDENT).flat.parameters == ("g", "a")
    assert Tables(DEPENDENT).pose("P")[0] == 7
    assert Tables(DEPENDENT, a=1.0).pose("P")[0] == 3


def test_an_overridden_parameter_is_independent_and_others_follow_it() -> None:
    scene = load_text(DEPENDENT).with_values({"b": "10 m"})
    assert flatten(scene).parameters == ("g", "b", "a")
    swept = load_text(DEPENDENT + 'sweep.b = ["1 m"]\n')
    flat = flatten(swept)
    assert flat.parameters == ("g", "b", "a")
    assert flat.defaults.tolist() == [G, 6, 3]
    values = value_table(flat, np.array([G, 10.0, 3.0]))
    (row,) = flat.rows(layout.PM_TABLE_BODY)
    assert values[row[layout.PM_BODY_X]] == 11


def test_a_swept_case_has_the_tables_of_the_set_case() -> None:
    swept = flatten(load_text(DEPENDENT + 'sweep.b = ["1 m"]\n'))
    fixed = flatten(load_text(DEPENDENT).with_values({"b": "10 m"}))
    assert np.array_equal(swept.table, fixed.table)
    assert np.array_equal(swept.constant, fixed.constant)


RUNS = """
until = "start"
parameters = { keep = true, x = "1 m" }
runs = { kept = { keep = true }, left = { keep = false, x = 2 } }
bodies.P = { mass = "1 kg", at = ["x", 0] }
bodies.Q = { mass = "1 kg", at = ["3 m", 0], active = "keep" }
ask = { first = "P.x", both = { of = "P.x + Q.x", run = "kept" }, other = { of = "P.x", run = "left" } }
"""


def test_runs_have_their_own_values_bodies_and_asks() -> None:
    kept, left = Tables(RUNS), Tables(RUNS, "left")
    assert kept.flat.run == "kept"
    assert (kept.flat.bodies, left.flat.bodies) == (("P", "Q"), ("P",))
    assert [ask.key for ask in kept.flat.asks] == ["first", "both"]
    assert [ask.key for ask in left.flat.asks] == ["other"]
    assert left.pose("P")[0] == 2
    with pytest.raises(SceneError, match='"Q" is not active in this run'):
        flatten(load_text(RUNS.replace('run = "kept"', 'run = "left"')), "left")


def test_sweeping_what_decides_on_activity_is_refused() -> None:
    with pytest.raises(SceneError, match="not built yet: sweeping keep"):
        flatten(load_text(RUNS + "sweep.keep = [0, 1]\n"))


# ---- events and asks ------------------------------------------------------------------------------------

EVENTFUL = """
until = ["t = 9 s", "blow 3"]
ground.lines.floor = { through = [0, 0] }
bodies.P = { mass = "1 kg", at = [0, "1 m"] }
contacts.floor = { touch = ["P", "ground.floor"] }
[events]
blow = "floor strikes"
high = ["P.y > 2 m", "P.y < 0.5 m", "P.x = 3 m"]
step = "P.x every 20 cm"
calm = ["rest", "P rests"]
begin = "start"
[ask]
"""


def test_triggers() -> None:
    tables = Tables(EVENTFUL)
    kinds = {value: name.removeprefix("PM_TRIGGER_") for name, value in layout.pm_trigger_kind.items()}
    found = [(kinds[row["KIND"]], row["EVENT"], row["A"]) for row in tables.rows("TRIGGER")]
    assert found == [
        ("STRIKE", 0, 0),
        ("RISE", 1, -2),
        ("FALL", 1, -2),
        ("CROSS", 1, -2),
        ("EVERY", 2, -2),
        ("REST", 3, -2),
        ("REST", 3, 0),
        ("START", 4, -2),
        ("CROSS", 5, -2),
    ]
    program = tables.rows("TRIGGER")[4]["PROGRAM"]
    assert run_program(tables.flat, program, tables.param, tables.value, lambda _measure: 1.0) == 5


def test_until_ends_at_the_first_group_that_is_complete() -> None:
    until = [(row["GROUP"], row["EVENT"], row["NTH"]) for row in Tables(EVENTFUL).rows("UNTIL")]
    assert until == [(0, 5, 1), (1, 0, 3)]
    text = EVENTFUL.replace('until = ["t = 9 s", "blow 3"]', 'until = { all = ["high", "blow 2"] }')
    assert [(row["GROUP"], row["EVENT"], row["NTH"]) for row in Tables(text).rows("UNTIL")] == [
        (0, 1, 1),
        (0, 0, 2),
    ]


def ask(text: str) -> tuple[str, dict[str, int], Any, Tables]:
    tables = Tables(EVENTFUL + f"a = {text}")
    kinds = {value: name.removeprefix("PM_ASK_") for name, value in layout.pm_ask_kind.items()}
    (row,) = tables.rows("ASK")
    return kinds[row["KIND"]], row, tables.flat.asks[0], tables


@pytest.mark.parametrize(
    ("text", "kind", "nth", "before"),
    [
        ('"P.y"', "END", 1, 0),
        ('{ of = "P.y", at = "end" }', "END", 1, 0),
        ('{ of = "P.y", at = "blow" }', "EVENT", 1, 0),
        ('{ of = "P.y", at = "blow 2" }', "EVENT", 2, 0),
        ('{ of = "P.y", at = "before blow 2" }', "EVENT", 2, 1),
        ('{ max = "P.y" }', "MAX", 1, 0),
        ('{ min = "P.y" }', "MIN", 1, 0),
        ('{ of = "P.y", at = { max = "P.x" } }', "AT_MAX", 1, 0),
        ('{ of = "P.y", at = { min = "P.x" } }', "AT_MIN", 1, 0),
        ('{ of = "P.y", at = "each blow" }', "EACH", 1, 0),
        ('{ of = "P.y", at = { each = "P.x", values = [0, "1 m"] } }', "GRID", 1, 0),
    ],
)
def test_instants_of_asks(text: str, kind: str, nth: int, before: int) -> None:
    found, row, _, _ = ask(text)
    assert (found, row["NTH"], row["BEFORE"]) == (kind, nth, before)


def test_each_has_as_many_columns_as_the_event_can_fire() -> None:
    assert ask('{ of = "P.y", at = "each blow" }')[2].count == 3
    column = ask('{ of = "P.y", at = "each step" }')[2]
    assert (column.count, column.is_list, column.open_ended) == (64, True, True)


@pytest.mark.parametrize(
    ("grid", "expected"),
    [
        ('{ from = "1 m", to = "4 m", num = 4 }', [1, 2, 3, 4]),
        ('{ from = "4 m", to = "1 m", step = "-1 m" }', [4, 3, 2, 1]),
        ('{ from = 0, to = "1 m", step = "0.1 m" }', [i / 10 for i in range(11)]),
        ('{ from = "1 m", to = "8 m", num = 4, scale = "log" }', [1, 2, 4, 8]),
        ('["50 cm", "g*(1 s^2)"]', [0.5, G]),
    ],
)
def test_grids_of_asks(grid: str, expected: list[float]) -> None:
    _, row, column, tables = ask(f'{{ of = "P.y", at = {{ each = "P.x", values = {grid} }} }}')
    first = row["FIRST_VALUE"]
    assert column.count == len(expected)
    assert tables.value[first : first + len(expected)].tolist() == pytest.approx(expected)


@pytest.mark.parametrize(
    ("text", "unit", "factor"),
    [
        ('"P.speed"', "m/s", 1),
        ('"P.mass"', "kg", 1),
        ('"energy.total"', "N*m", 1),
        ('"blow.count"', "1", 1),
        ('{ of = "P.y", unit = "in" }', "in", 0.0254),
        ('{ of = "t", unit = "ms" }', "ms", 1e-3),
        ('"P.x/P.y"', "1", 1),
    ],
)
def test_units_of_answers(text: str, unit: str, factor: float) -> None:
    column = ask(text)[2]
    assert (column.unit, column.factor) == (unit, factor)


def test_asks_stand_side_by_side_in_out() -> None:
    text = EVENTFUL + 'a = "P.x"\nb = { of = "P.y", at = "each blow" }\nc = "t"'
    assert [(ask.key, ask.first, ask.count) for ask in flatten(load_text(text)).asks] == [
        ("a", 0, 1),
        ("b", 1, 3),
        ("c", 4, 1),
    ]


def test_every_row_has_a_key_path() -> None:
    flat = flatten(load_text(EVENTFUL))
    for table in range(layout.PM_TABLES):
        assert len(flat.names[table]) == flat.table[2 * table + 1]


def test_a_history_records_bodies_reactions_and_energies() -> None:
    flat = flatten(load_text(TWO_RODS + 'joints.A = { pin = ["a.A", "ground"] }'))
    for name in ("a.x", "a.omega", "p.velocity.y", "A.force.x", "energy.total"):
        assert name in flat.trace
    assert "p.omega" not in flat.trace
    assert flat.trace["a.omega"][1] == "rad/s"
