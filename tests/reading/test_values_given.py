"""Values given in Python: numbers of every kind are taken, and what is none is refused by its name."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest

from planemotion import Scene, load_text
from planemotion.base.errors import SceneError
from planemotion.language.units import registry

FALL = """
until = "t = 1 s"
parameters = { L = "2 m", e = 0.5 }
bodies.P = { mass = "1 kg", at = [0, "L"] }
ask.y = { of = "P.y + e*L", unit = "m" }
"""
FILE = "fall.toml"


def given(name: str, value: object) -> Scene:
    return load_text(FALL, file=FILE).with_values({name: value})


@pytest.mark.parametrize(
    "half",
    [
        *(np.float64(0.5), np.float32(0.5), np.float16(0.5), np.longdouble("0.5")),
        *(np.array(0.5), np.array("0.5"), np.str_("0.5"), Fraction(1, 2), registry().Quantity(0.5, "")),
    ],
    ids=lambda half: type(half).__name__,
)
@pytest.mark.parametrize("name", ["L", "e"])
def test_a_number_of_any_kind_is_one(name: str, half: object) -> None:
    if name == "L" and not hasattr(half, "dimensionality"):
        assert load_text(FALL).run(L=half).y == load_text(FALL).run(L="0.5 m").y
    assert load_text(FALL).run(e=half).y == load_text(FALL).run().y


def test_integers_and_lists_of_numpy_are_those_of_the_file() -> None:
    assert load_text(FALL).run(L=np.int64(3)).y == load_text(FALL).run(L="3 m").y
    long = np.array([0.5, 1.5], np.longdouble)
    assert Scene("s").body("P", mass=1, at=long).table["bodies"]["P"]["at"] == [0.5, 1.5]


@pytest.mark.parametrize("name", ["L", "e", "parameters.L"])
@pytest.mark.parametrize(
    ("value", "reason"),
    [
        (None, ": None is no value; leave it out for what is taken without it"),
        (np.array(None), ": None is no value"),
        (math.nan, " = nan: the number must be finite"),
        (-math.inf, " = -inf: the number must be finite"),
        (np.array(math.nan), " = nan: the number must be finite"),
        (np.float32("inf"), " = inf: the number must be finite"),
        ("nan", ' = "nan": the number must be finite'),
        (2**1024 - 1, " = 17976931348623159"),
        (Fraction(10**400), " = inf: the number must be finite"),
        (10**400, ": an integer of about 401 digits; at most 309 are read"),
        ("soon", ' = "soon": unknown parameter "soon"; there is g, L, e'),
        ("", ' = "": it ends where a number'),
        ([1, 2], " = [1, 2]: one value is wanted"),
        (np.array([0.5]), " = [0.5]: one value is wanted"),
        ({"a": 1}, " = { a = 1 }: a number with a unit is wanted"),
        ({"a": [None]}, ".a[0]: None is no value"),
        (b"1 m", " = b'1 m': a scene has no values of type bytes"),
        (1j, " = 1j: a scene has no values of type complex"),
        (np.clongdouble(1), " = (1+0j): a scene has no values of type clongdouble"),
        (registry().Quantity(math.nan, "m"), " = nan meter: the number must be finite"),
    ],
    ids=repr,
)
def test_what_is_no_number_is_refused_with_its_name(name: str, value: object, reason: str) -> None:
    for call in (given, lambda name, value: load_text(FALL, file=FILE).run(**{name: value})):
        with pytest.raises(SceneError) as caught:
            call(name, value)
        place = str(caught.value).removeprefix(f"{FILE}: ").removeprefix("parameters.")
        assert place.startswith(name.removeprefix("parameters.") + reason)
        assert str(caught.value).startswith(f"{FILE}: ")


def test_a_parameter_may_have_the_name_of_no_number() -> None:
    scene = load_text(FALL.replace("e = 0.5", 'e = 0.5, inf = "3 m"'))
    assert scene.run(L="inf").y == scene.run(L="3 m").y


@pytest.mark.parametrize(
    ("path", "write"),
    [
        ("bodies.P.mass", lambda scene: scene.body("P", mass=None)),
        ("ground.points.A[1]", lambda scene: scene.ground(points={"A": [0, None]})),
        ("parameters.L", lambda scene: scene.parameters(L=None)),
        ("until", lambda scene: scene.until(None)),
        ("sweep.L[1]", lambda scene: scene.sweep(L=["1 m", None])),
        ("sweep.L", lambda scene: scene.map(L=None)),
        ("at", lambda scene: scene.draw(at=["0.1 s"])),
    ],
)
def test_what_is_no_value_is_told_with_its_key(path: str, write: Callable[[Scene], object]) -> None:
    with pytest.raises(SceneError) as caught:
        write(load_text(FALL))
    assert caught.value.path == path
