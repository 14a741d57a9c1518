"""Joints, contacts and forces as tables."""

from __future__ import annotations

import math
from typing import Any

import pytest

from planemotion import _layout as layout
from planemotion.engine.evaluator import run_program
from tests.compile.tables import TWO_RODS, Tables


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
        ('["wheel.rim", "ground.bars"]', "PATTERN", 1),
        ('["ground.bars", "wheel.rim"]', "PATTERN", 1),
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
