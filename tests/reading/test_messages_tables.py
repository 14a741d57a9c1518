"""Faults of tables of values: what is wrong, in which file and line."""

from __future__ import annotations

from pathlib import Path

import pytest

import planemotion as pm

# ruff: noqa: E501 - faults beside what is told of them

SCENE = """
until = "t = 1 s"
bodies.b = {{ mass = "1 kg", at = [0, 0] }}
forces.f = {{ force = "b", value = ["{value}", 0] }}
ask.v = "b.velocity.x"
tables.{name} = {table}
"""


def fault(table: str, *, value: str = "k(t)", name: str = "k") -> str:
    with pytest.raises(pm.SceneError) as found:
        pm.load_text(SCENE.format(table=table, value=value, name=name)).run()
    return str(found.value)


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ('{ at = ["0 s", "1 s"], value = ["0 N"] }', "as many values are wanted as arguments: there are 2 and 1"),
        ('{ at = ["0 s", "2 s", "1 s"], value = ["0 N", "1 N", "2 N"] }',
         'line 6: tables.k.at[2] = "1 s": arguments must increase; the one before is 2 s'),
        ('{ at = ["0 s", "1 s"], value = ["1 N", "2 m"] }', 'tables.k.value[1] = "2 m": it is a length; 1 N is a force'),
        ('{ at = ["0 s"], value = ["1 N"] }', "tables.k: at least 2 rows are wanted, there is 1"),
        ('{ at = ["0 s", "1 s"] }', "a table is at = "),
        ('{ at = ["0 s", "1 s"], value = ["1 N", "nan N"] }', "tables.k.value[1]"),
        ('{ at = ["0 s", "1 s"], value = ["1 N", "2 N"], between = "straight" }', '"linear" or "cubic" is wanted'),
        ('{ at = ["0 s", "1 s"], value = ["1 N", "2 N"], outsid = "hold" }', 'did you mean "outside"'),
        ('{ file = "nowhere.csv" }', 'tables.k.file = "nowhere.csv": cannot be read: No such file'),
        ('{ at = ["0 m", "1 m"], value = ["1 N", "2 N"] }', "the table k is read at a length; t is a time"),
        ('{ at = ["0 s", "1 s"], value = ["1 J", "2 J"] }', "a force (mass*length/time^2, such as N) is wanted"),
        ('{ at = ["0 s", "1 s"], value = ["1 N", "2 N"], scale = "zz" }', 'unknown parameter "zz"'),
    ],
)  # fmt: skip
def test_faults_of_tables_in_the_scene(table: str, told: str) -> None:
    assert told in fault(table)


def test_names_of_tables() -> None:
    table = '{ at = ["0 s", "1 s"], value = ["1 N", "2 N"] }'
    assert "it is the name of a function" in fault(table, name="sin", value="1 N")
    assert 'unknown function "kk" (did you mean "k"?)' in fault(table, value="kk(t)")
    assert "the table k is read at 1 argument, not 2" in fault(table, value="k(t, t)")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("t [s],f [N]\n0,1\n1,2\n0.5,3\n", "m.csv:4: tables.k: t = 0.5: arguments must increase"),
        ("t [s],f [N]\n0,1\n\n# by hand\n1,nan\n", "m.csv:5: tables.k: f = nan: a finite number is wanted"),
        ("t [s],f [N]\n0,1\n1,\n", "m.csv:3: tables.k: f = nothing: a finite number is wanted"),
        ("t [s],f [N]\n0,1\n1,2,3\n", "m.csv:3: tables.k: 3 fields; the header has 2"),
        ("t [s],f\n0,1\n1,2\n", 'm.csv:1: tables.k: the column "f" has no unit: write "f [mm]"'),
        ("t [s],f [Nx]\n0,1\n1,2\n", "m.csv:1: tables.k: in the column"),
        ("t [s]\n0\n1\n", "m.csv:1: tables.k: two columns are wanted"),
        ("t [s],f [N]\n0,1\n", "m.csv:1: tables.k: at least 2 rows are wanted, there is 1"),
        ("", "m.csv:1: tables.k: the file is empty"),
        (
            "t [s],f [N]\n" + "".join(f"{i},0\n" for i in range(100_001)),
            "100001 rows; at most 100000 are read",
        ),
    ],
)
def test_faults_of_csv_files(tmp_path: Path, text: str, told: str) -> None:
    (tmp_path / "m.csv").write_text(text)
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.format(table='{ file = "m.csv" }', value="k(t)", name="k"))
    with pytest.raises(pm.SceneError) as found:
        pm.load(scene)
    assert told in str(found.value)


def test_columns_are_chosen_by_name(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_text("t [ms],f [kN],note\n0,0,a\n500,1,b\n1000,0,c\n")
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.format(table='{ file = "m.csv", value = "f" }', value="k(t)", name="k"))
    assert pm.load(scene).run().v == pytest.approx(500)
    scene.write_text(SCENE.format(table='{ file = "m.csv", value = "g" }', value="k(t)", name="k"))
    with pytest.raises(pm.SceneError, match=r"unknown column of .*; there is t, f, note"):
        pm.load(scene)


def test_a_result_holds_the_values_of_its_tables(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_text("t [ms],f [kN]\n0,0.1\n500,1\n1000,0\n")
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.format(table='{ file = "m.csv", outside = "hold" }', value="k(t)", name="k"))
    written = pm.load(scene)
    again = pm.load_text(written.whole_text)
    assert again.data.tables["k"].points == written.data.tables["k"].points
    assert again.data.tables["k"].outside == "hold"
    assert again.run().v == written.run().v
