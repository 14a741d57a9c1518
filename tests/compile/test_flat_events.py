"""Parameters, runs, events and asks as tables."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from planemotion import SceneError, load_text
from planemotion import _layout as layout
from planemotion.compile.flatten import flatten
from planemotion.engine.evaluator import run_program, value_table
from tests.compile.tables import TWO_RODS, Tables
from tests.scenes import G

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


def test_what_decides_on_activity_is_swept_by_tables_of_its_own() -> None:
    made = load_text(RUNS.replace("runs = { kept", "runs = { other = {}, kept") + "sweep.keep = [1, 0]\n")
    assert flatten(made, "kept").bodies == ("P", "Q")
    scene = load_text(SWITCHED)
    swept = scene.sweep()
    assert swept["x"].values.tolist() == [scene.run(keep=keep)["x"] for keep in (2, 0)]
    assert swept["x"].values.tolist() == pytest.approx([0.25, 0.0], abs=1e-12)


SWITCHED = """
until = "t = 0.5 s"
plane = "horizontal"
parameters = { keep = 0, half = "keep/2" }
bodies.P = { mass = "1 kg", at = [0, 0] }
forces.push = { force = "P", value = ["2 N", 0], active = "half > 0.5" }
ask = { x = "P.x" }
sweep.keep = [2, 0]
"""


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
        ('"energy.total"', "J", 1),
        ('"energy.lost - 2*P.mass*P.speed^2"', "J", 1),
        ('{ integral = "energy.kinetic" }', "N*m*s", 1),
        ('"P.mass*g*(1 m)"', "N*m", 1),
        ('{ max = "energy.kinetic" }', "J", 1),
        ('"blow.count"', "1", 1),
        ('{ of = "P.y", unit = "in" }', "in", 0.0254),
        ('{ of = "t", unit = "ms" }', "ms", 1e-3),
        ('"P.x/P.y"', "1", 1),
    ],
)
def test_units_of_answers(text: str, unit: str, factor: float) -> None:
    column = ask(text)[2]
    assert (column.unit, column.factor) == (unit, factor)


def test_what_is_made_of_energies_is_an_energy() -> None:
    text = EVENTFUL + 'a = "energy.kinetic"\nb = "a/2"\nc = "b/(1 s)"'
    assert [ask.unit for ask in flatten(load_text(text)).asks] == ["J", "J", "W"]


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
