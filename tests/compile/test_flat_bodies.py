"""Bodies and starts as tables: masses, poses, what is given exactly."""

from __future__ import annotations

import math

import pytest

from planemotion import _layout as layout
from tests.compile.tables import PARTICLE, Tables, body_of
from tests.scenes import G


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
    assert row["ROTATES"] == (inertia > 0)


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
