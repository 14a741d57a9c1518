"""Scenes: files, the builder, overrides; both ways of writing make the same validated scene."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import planemotion
from planemotion import Scene, SceneError, load, load_text
from planemotion.compile.flatten import flatten
from planemotion.examples import text_of
from planemotion.language.units import registry
from planemotion.model.readers import Place, Vector
from planemotion.model.tables import Ask, Swept
from planemotion.report.schema import schema
from tests import STUDIES

FILES = sorted(STUDIES.glob("*.toml"))

FILE = """
id = "pendulum"
until = ["t = 2 s", "low"]
parameters = { L = "1 m", m = "2 kg", n = 3, wide = "2*L", up = true }
start.AB.omega = "1 rad/s"
start."AB.B.velocity in AB" = ["0 m/s", 0]
events = { low = ["AB.angle < -90 deg", "AB.angle > 3"] }
[bodies.AB]
rod = ["A", "B"]
length = "L"
mass = "m"
at = { A = [0, 0] }
points.C = { from = "B", by = [0, "1 in"] }
[joints]
A = { pin = ["AB.A", "ground"] }
[ask]
omega = "AB.omega"
top = { max = "AB.B.y", unit = "in" }
[sweep]
L = ["1 m", "2 m"]
m = { from = "1 kg", to = "2 kg", num = 3 }
zip = [["L"]]
[solve]
route = "rk"
"""


def built() -> Scene:
    scene = Scene("pendulum", until=["t = 2 s", "low"])
    scene.parameters(L="1 m", m="2 kg", n=3, wide="2*L", up=True)
    scene.start({"AB.omega": "1 rad/s", "AB.B.velocity in AB": ("0 m/s", 0)})
    scene.event("low", ["AB.angle < -90 deg", "AB.angle > 3"])
    scene.body(
        "AB",
        rod=["A", "B"],
        length="L",
        mass="m",
        at={"A": [0, 0]},
        points={"C": {"from": "B", "by": [0, "1 in"]}},
    )
    scene.joint("A", pin=["AB.A", "ground"])
    scene.ask("omega", "AB.omega").ask("top", max="AB.B.y", unit="in")
    scene.solve(route="rk")
    return scene.grids({"zip": [["L"]]}, L=["1 m", "2 m"], m={"from": "1 kg", "to": "2 kg", "num": 3})


def test_file_and_builder_make_the_same_scene() -> None:
    assert built().data == load_text(FILE).data


def test_the_builder_writes_every_word_of_a_file() -> None:
    scene = Scene("all", title="All", description="Every word", plane="vertical", until="t = 1 s")
    scene.parameters(h="1 m").measured("push", at=["0 s", "1 s"], value=["0 N", "50 N"], outside="hold")
    scene.ground(points={"O": [0, 0]}).body("block", mass="1 kg").spin(through=[0, 0])
    scene.joint("A", pin=["block", "ground"]).coupling("m", motor=["block", "ground"])
    scene.contact("floor", touch=["block", "ground.O"]).force("f", force="block", value=["push(t)", 0])
    scene.template("bar", Scene("bar")).part("left", "bar").start({"block.velocity.x": "1 m/s"})
    scene.event("low", "block.y < 0").ask("x", "block.x").runs(one={"h": "2 m"}).find(vary="h")
    scene.grids(h=["1 m"]).solve(route="rk")
    assert set(scene.table) == set(schema()["properties"])


def test_a_table_of_measured_values_is_read_by_a_force_of_the_builder() -> None:
    scene = Scene("pushed", until="t = 0.2 s", plane="horizontal")
    scene.measured("push", at=["0 s", "0.1 s", "0.2 s"], value=["0 N", "50 N", "0 N"])
    scene.body("block", mass="2 kg", at=[0, 0]).force("f", force="block", value=["push(t)", 0])
    scene.ask("v", "block.velocity.x", unit="m/s")
    assert scene.run()["v"] == pytest.approx(0.5 * 0.2 * 50 / 2, rel=1e-9)


def test_what_is_written_comes_back() -> None:
    scene = load_text(FILE)
    assert load_text(scene.to_toml()).data == scene.data
    assert scene.text == FILE
    assert built().text == built().to_toml()


def test_values_are_brought_into_one_form() -> None:
    data = load_text(FILE).data
    assert data.parameters["g"] == "9.81 m/s^2"
    assert data.until == (("t = 2 s",), ("low",))
    assert data.start == {"AB.omega": "1 rad/s", "AB.B.velocity in AB": Vector("0 m/s", 0)}
    assert data.ask["omega"] == Ask(of="AB.omega")
    assert data.bodies["AB"].at == Place((("A", Vector(0, 0)),))
    assert data.sweep.grids["L"] == Swept.model_validate({"values": ("1 m", "2 m")})
    assert data.sweep.zip == (("L",),)


def test_the_id_is_the_name_of_the_file_if_there_is_none() -> None:
    assert load_text(FILE.replace('id = "pendulum"', ""), file="a/b/swing.toml").id == "swing"


def test_quantities_of_pint_and_numbers_of_numpy_are_taken() -> None:
    units = registry()
    scene = Scene("x", until="start")
    scene.parameters(L=units.Quantity(10, "inch"), n=np.float64(2.5), k=np.int64(3))
    scene.body("P", mass=units.Quantity(1.5, "kg"), at=np.array([0.0, 0.0]))
    assert scene.table["parameters"]["n"] == 2.5
    assert type(scene.table["parameters"]["n"]) is float
    flat = flatten(scene)
    assert dict(zip(flat.parameters, flat.defaults, strict=True)) == pytest.approx(
        {"g": 9.81, "L": 0.254, "n": 2.5, "k": 3}
    )


@pytest.mark.parametrize(
    ("name", "value", "written"),
    [
        ("L", "2", "2 m"),
        ("L", 2, "2 m"),
        ("L", 0.1, "0.1 m"),
        ("L", "3 ft", "3 ft"),
        ("L", "n*(2 m)", "n*(2 m)"),
        ("n", "4", "4"),
        ("wide", "7 in", "7 in"),
        ("g", "32.2 ft/s^2", "32.2 ft/s^2"),
        ("up", False, False),
        ("parameters.L", "2", "2 m"),
    ],
)
def test_a_bare_number_takes_the_unit_of_the_file(name: str, value: object, written: object) -> None:
    scene = load_text(FILE).with_values({name: value})
    assert scene.data.parameters[name.removeprefix("parameters.")] == written


def test_settings_are_set_by_their_dotted_names() -> None:
    scene = load_text(FILE).with_values({"sweep.m.num": "200", "solve.route": "ida", "solve.max_events": 7})
    assert scene.data.sweep.grids["m"].num == 200
    assert scene.data.solve.route == "ida"
    assert scene.data.solve.max_events == 7


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"K": 1}, 'K: unknown parameter "K"; there is g, L, m, n, wide, up'),
        ({"L": "2 kg"}, 'parameters.L = "2 kg": a length (such as m) is wanted; this is a mass'),
        ({"wide": 2}, "parameters.wide = 2: a unit is wanted (such as m); the file gives an expression"),
        ({"ground.points.P": "1 m"}, "forces and events can be set, not ground"),
        ({"L": "q"}, 'parameters.L = "q": unknown parameter "q"'),
    ],
)
def test_overrides_that_are_refused(values: dict[str, object], expected: str) -> None:
    with pytest.raises(SceneError) as caught:
        load_text(FILE, file="x.toml").with_values(values)
    assert expected in str(caught.value)
    assert str(caught.value).startswith("x.toml: ")


def test_a_copy_with_values_leaves_the_scene_alone() -> None:
    scene = load_text(FILE)
    scene.with_values({"L": 3, "sweep.m.num": 9})
    assert scene.table == load_text(FILE).table


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_study_is_valid_and_survives_writing(path: Path) -> None:
    scene = load(path)
    flatten(scene)
    again = load_text(scene.to_toml(), file=str(path))
    assert again.data == scene.data
    assert np.array_equal(flatten(again).table, flatten(scene).table)


def test_the_package_starts_without_heavy_imports() -> None:
    heavy = ("pydantic", "pint", "numpy", "xarray")
    code = f"import sys, planemotion; print([name for name in {heavy} if name in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"


def test_a_scene_with_common_units_does_not_import_pint() -> None:
    code = (
        "import sys, planemotion; from planemotion.compile.flatten import flatten;"
        f"flatten(planemotion.load({str(FILES[0])!r})); print('pint' in sys.modules)"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "False"


def test_names_of_the_package() -> None:
    assert set(dir(planemotion)) == set(planemotion.__all__)
    for name in planemotion.__all__:
        assert getattr(planemotion, name) is not None
    with pytest.raises(AttributeError):
        planemotion.nothing  # noqa: B018


def test_a_scene_that_stays_the_same_makes_its_tables_once() -> None:
    scene = load_text(FILE)
    first = scene.tables()
    scene.run()
    assert scene.tables()[0] is first[0]
    other = scene.with_values({"L": "2 m"})
    assert other.tables()[0] is not first[0]
    assert scene.tables()[0] is first[0]
    before = scene.run().top
    scene.start({"AB.omega": "4 rad/s"})
    assert scene.tables()[0] is not first[0]
    assert scene.run().top != before


def test_every_name_of_the_package_is_there() -> None:
    for name in planemotion.__all__:
        assert getattr(planemotion, name) is not None, name
    assert isinstance(load_text(FILE).with_values({"L": 2}).run(), planemotion.RunResult)


def test_a_parameter_may_have_the_name_of_an_option() -> None:
    scene = load_text(FILE.replace("n = 3", "workers = 3")).ask("n", "workers")
    with pytest.raises(
        SceneError, match=r'workers: a number of threads is wanted.*grids={"workers": \.\.\.}'
    ):
        scene.sweep(workers=[1, 2])
    assert scene.sweep(grids={"workers": [1, 2]}, L=["1 m"]).n.values.tolist() == [[1], [2]]


def test_the_table_of_a_scene_is_a_copy() -> None:
    scene = load_text(FILE)
    scene.table["parameters"]["L"] = "9 m"
    assert scene.table == load_text(FILE).table
    assert Scene.from_table(scene.table).data.parameters == scene.data.parameters


def test_a_grid_is_an_array_of_quantities_and_a_run_takes_one_value() -> None:
    unit = registry()
    scene = load_text(text_of("pin"))
    grid = np.array([1.0, 5.0, 9.0])
    wanted = np.array([scene.run(g=f"{value} m/s^2")["reaction"] for value in grid], float)
    for given in (
        grid * unit.m / unit.s**2,
        100 * grid * unit.cm / unit.s**2,
        [f"{one} m/s^2" for one in grid],
    ):
        found = scene.sweep(g=given)["reaction"]
        np.testing.assert_allclose(found.values, wanted, rtol=1e-13)
    for several in (grid, [1, 2], grid * unit.m / unit.s**2):
        with pytest.raises(
            SceneError, match=r"one value is wanted; sweep\(g=\[...\]\) computes a case for each"
        ):
            scene.run(g=several)


def test_check_and_explain_tell_what_the_commands_tell() -> None:
    scene = load_text(text_of("pin"), file="pin.toml")
    assert scene.check().faults == ()
    assert "1 degree of freedom" in repr(scene.check())
    assert "rod" in scene.explain().text
    open_start = Scene(until="t = 1 s").body("b", rod=["A", "B"], length="1 m", mass="1 kg")
    open_start.joint("A", pin=["b.A", "ground"]).joint("B", slider=["b.B", "ground.far"])
    open_start.ground(lines={"far": {"through": [0, "3 m"]}})
    assert open_start.check().faults
    assert "error: " in repr(open_start.check())


def test_grids_may_be_ranges_and_histories_lists() -> None:
    drop = (
        Scene("drop", until="ball.y = 0")
        .parameters(h="1 m")
        .body("ball", mass="1 kg", at=[0, "h"])
        .ask("v", of="ball.speed", unit="m/s")
    )
    swept = drop.sweep(h=range(1, 4))["v"].values
    assert swept == pytest.approx(np.sqrt(2 * 9.81 * np.arange(1, 4)))
    names = ["ball.y", "ball.velocity.y"]
    assert drop.history(names, every="0.1 s").equals(drop.history(*names, every="0.1 s"))
    with pytest.raises(SceneError, match="more than 1000000 entries"):
        drop.sweep(h=range(10**9))
