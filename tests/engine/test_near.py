"""Another size of a parameter: what the tables that are there answer is what the changed scene answers."""

from __future__ import annotations

import cProfile
import pstats
from pathlib import Path

import numpy as np
import pytest

import planemotion
from planemotion import SceneError, load_text
from planemotion.geometry.parameters import like_declared
from planemotion.language.parser import parse
from planemotion.language.tree import Number
from planemotion.language.units import factor
from planemotion.run import run_near, simulate
from tests import CHAPTER, STUDIES

FILES = [*sorted(STUDIES.glob("*.toml")), *sorted(CHAPTER.glob("*.toml"))]
# Every so many files are in the quick tests.
QUICK = 12
# A find takes a hundred runs: so many of its parameters are enough.
OF_A_FIND = 3
TWO_RUNS = """
until = "t = 1 s"
parameters = { v = "1 m/s", e = 0, L = "1 m", long = "2*L", there = 1 }
runs = { slow = {}, fast = { v = 3 } }
bodies.P = { mass = "1 kg", at = [0, 0] }
bodies.Q = { rod = ["A", "B"], length = "L", mass = "1 kg", at = [0, "long"], active = "there" }
plane = "horizontal"
start.P.velocity.x = "v"
ask.slow = { of = "P.x", run = "slow" }
ask.fast = { of = "P.x*(1 + e)", run = "fast" }
"""

WEIGHED = """
until = "t = 1 s"
parameters = { m = "1 kg", g = "9.81 m/s^2" }
bodies.P = { mass = "m", at = [0, 0] }
ask.W = { of = "P.weight", unit = "N" }
"""


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, id=path.stem, marks=() if number % QUICK == 0 else pytest.mark.slow)
        for number, path in enumerate(FILES)
    ],
)
def test_each_parameter_of_each_scene_gives_the_same_bits(path: Path) -> None:
    scene = planemotion.load(path)
    flat = scene.tables()[0]
    declared = list(zip(flat.parameters, flat.defaults, flat.units, strict=True))
    for name, value, unit in declared if flat.find is None else declared[:OF_A_FIND]:
        if name not in scene.table.get("parameters", {}) or isinstance(scene.table["parameters"][name], bool):
            continue
        size = float(1.013 * value / (factor(unit)[0] if unit else 1.0))
        near = run_near(scene, {name: f"{size!r} {unit}".strip()})
        looked_at_anew = {*flat.decided, *(flat.find.vary if flat.find is not None else ())}
        if near is not None:
            assert near == simulate(scene.with_values({name: size})), name
        elif name not in looked_at_anew and not scene.data.runs:
            other = simulate(scene.with_values({name: size}))
            assert not other.ok or other.notes or scene.table["parameters"][name] == 0, name


def test_what_a_parameter_is_near_to() -> None:
    """Sizes in the unit of the file; a run that has its own keeps it; what decides more is looked at anew."""
    scene = load_text(TWO_RUNS)
    near = run_near(scene, {"v": "2 m/s"})
    assert near is not None
    assert (near["slow"], near["fast"]) == (pytest.approx(2.0), pytest.approx(3.0))
    assert run_near(scene, {"v": 2}) == near
    for name, value in (
        ("v", "2 ft/s"),  # a bare number of a run would take this unit
        ("v", "2 kg"),
        ("v", True),
        ("v", [1]),
        ("e", 0.5),  # 0 has any dimension
        ("L", "-3 m"),  # must be positive
        ("long", "3 m"),  # depends on another
        ("there", 0),
        ("none", 1),
        ("solve.route", "rk"),
    ):
        assert run_near(scene, {name: value}) is None, name


@pytest.mark.parametrize(
    ("values", "error", "text"),
    [
        ({"m": "-1 kg"}, SceneError, "must not be negative"),
        ({"m": 1e400}, SceneError, "inf"),
        ({"m": "2 m"}, SceneError, "mass"),
        ({"k": 3}, SceneError, 'unknown parameter "k"'),
    ],
)
def test_a_fault_is_told_as_ever(values: dict[str, object], error: type[Exception], text: str) -> None:
    scene = load_text(WEIGHED)
    assert scene.run(m="2 kg")["W"] == pytest.approx(2 * 9.81)
    with pytest.raises(error, match=text) as near:
        scene.run(**values)
    with pytest.raises(error) as anew:
        scene.with_values(values).run()
    assert str(near.value) == str(anew.value)


@pytest.mark.parametrize("end", ["1 m", "L"])
def test_points_that_must_fit_are_checked_at_each_size(end: str) -> None:
    text = 'until = "t = 1 s"\nparameters = { L = "1 m" }\nask.y = "AB.B.y"\n'
    text += 'joints.A = { pin = ["AB.A", "ground"] }\n'
    at = f'at = {{ A = [0, 0], B = ["{end}", 0] }}'
    scene = load_text(text + f'bodies.AB = {{ rod = ["A", "B"], length = "L", mass = "1 kg", {at} }}')
    assert run_near(scene, {"L": "1 m"}) == simulate(scene)
    if end == "L":
        assert run_near(scene, {"L": "2 m"}) == simulate(scene.with_values({"L": "2 m"}))
    else:
        assert run_near(scene, {"L": "2 m"}) is None
        with pytest.raises(SceneError, match="are 1 m apart here and 2 m on the body; they must fit"):
            scene.run(L="2 m")
    assert run_near(scene, {"L": "-1 m"}) is None
    with pytest.raises(SceneError, match="it is -1 m; a size must be positive"):
        scene.run(L="-1 m")


@pytest.mark.parametrize("unit", ["", "m", "in", "ft/s", "rpm", "lb*ft", "deg", "kg*m^2"])
def test_a_size_has_the_bits_of_what_is_written(unit: str) -> None:
    """A number, the number with its unit and a text of the number are what an expression of it is."""
    rng = np.random.default_rng(3)
    for size in [*(rng.normal(size=20) * 10.0 ** rng.integers(-20, 20, 20)).tolist(), 3, -7]:
        written = parse(f"({size!r} {unit})".replace(" )", ")"))
        wanted = written.value_si if isinstance(written, Number) else None
        assert wanted is not None
        for given in (size, f"{size!r}", f" {size!r} {unit}".rstrip()):
            assert like_declared(f"2 {unit}".rstrip(), given) == wanted, given


def test_what_is_true_is_no_size() -> None:
    assert like_declared("1 m", 1) == 1.0
    assert like_declared("1 m", True) is None
    assert like_declared(True, 1) is None
    assert like_declared("1 m", 10**309) is None


def test_another_size_costs_few_calls() -> None:
    """0.2 ms above the kernel are some 500 calls of Python; a clock would tell how loaded the machine is."""
    scene = planemotion.load(STUDIES / "rolling_collar.toml")
    scene.run(d=0.1)
    with cProfile.Profile() as profile:
        scene.run(d=0.11)
    calls = sum(calls for _, calls, *_ in pstats.Stats(profile).stats.values())  # type: ignore[attr-defined]
    assert 100 < calls < 360
