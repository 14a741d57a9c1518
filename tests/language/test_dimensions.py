"""Dimensions of expressions."""

from __future__ import annotations

from typing import Any

import pytest

from planemotion.base.errors import SceneError
from planemotion.language import dimensions
from planemotion.language.dimensions import Dimension
from planemotion.language.homogeneity import dimension, require
from planemotion.language.parser import parse
from tests.language.expressions import no_leaf

DIMENSIONS = {
    "r": dimensions.LENGTH,
    "t": dimensions.TIME,
    "W": dimensions.FORCE,
    "g": dimensions.ACCELERATION,
    "v": dimensions.VELOCITY,
    "n": dimensions.DIMENSIONLESS,
    "any": None,
}


def resolve(leaf: Any) -> Any:
    return DIMENSIONS[leaf.text]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("r + (3 in)", dimensions.LENGTH),
        ("W/g*v", dimensions.MOMENTUM),
        ("W/g*r^2", dimensions.INERTIA),
        ("sqrt(g*r)", dimensions.VELOCITY),
        ("(g*r)^(1/2)", dimensions.VELOCITY),
        ("r^-1.5", Dimension(length=dimensions.exact_exponent(-1.5))),
        ("r^(1/3)*r^(2/3)", dimensions.LENGTH),
        ("2^(r/(1 m))", dimensions.DIMENSIONLESS),
        ("atan2(r, 3 m)", dimensions.DIMENSIONLESS),
        ("norm(r, v*t)", dimensions.LENGTH),
        ("max(r, 0, 2 m)", dimensions.LENGTH),
        ("abs(-r)", dimensions.LENGTH),
        ("r < 3 in and not v > 2 m/s", dimensions.DIMENSIONLESS),
        ("r > 0", dimensions.DIMENSIONLESS),
        ("r + 0", dimensions.LENGTH),
        ("0*t + r", dimensions.LENGTH),
        ("any + r", dimensions.LENGTH),
        ("any*r", None),
        ("-0", None),
        ("asin(r/(3 m)) + (30 deg)", dimensions.DIMENSIONLESS),
    ],
)
def test_dimension(text: str, expected: Any) -> None:
    assert dimension(parse(text), resolve) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("r + (3 s)", 'in "r + (3 s)": r is a length, 3 s is a time; they cannot be added'),
        ("r - n", 'in "r - n": r is a length, n is a plain number; they cannot be added'),
        ("r < t", 'in "r < t": r is a length, t is a time; they cannot be compared'),
        ("2*(r = v)", 'in "r = v": r is a length, v is a velocity; they cannot be compared'),
        ("max(r, 0, t)", 'in "max(r, 0, t)": r is a length, t is a time; they cannot be compared'),
        ("atan2(r, t)", 'in "atan2(r, t)": r is a length, t is a time; they cannot be compared'),
        ("sin(r)", "sin takes an angle or a plain number; r is a length"),
        ("exp(r)", "exp takes a plain number; r is a length"),
        ("floor(t)", "floor takes a plain number; t is a time"),
        ("not r", '"not" takes conditions, such as x > 0; r is a length'),
        ("r > 0 and v", '"and" takes conditions, such as x > 0; v is a velocity'),
        ("r^n", 'in "r^n": r is a length, so its power must be a constant, not n'),
        ("r^0.3333", 'in "r^0.3333": r is a length, so its power must be a simple fraction'),
        ("r^(0/0)", "its power must be a simple fraction"),
        ("2^t", 'the power in "2^t" takes a plain number; t is a time'),
    ],
)
def test_clashing_dimensions(text: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        dimension(parse(text), resolve)
    assert message in str(caught.value)


def test_wanted_dimension() -> None:
    require(parse("0"), dimensions.INERTIA, no_leaf)
    require(parse("3 kg*m^2"), dimensions.INERTIA, no_leaf)
    with pytest.raises(SceneError) as caught:
        require(parse("10.5 lb*ft"), dimensions.INERTIA, no_leaf)
    assert str(caught.value).startswith(
        "a moment of inertia (mass*length^2, such as kg*m^2) is wanted; this is a moment"
    )
    bare = r'^a length \(such as m\) is wanted; this is a plain number; give it a unit: "3 m"$'
    with pytest.raises(SceneError, match=bare):
        require(parse("3"), dimensions.LENGTH, no_leaf)
    with pytest.raises(SceneError, match=r"^a length \(such as m\) is wanted; this is a plain number$"):
        require(parse("3*sin(2)"), dimensions.LENGTH, no_leaf)
