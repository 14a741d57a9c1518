"""Units: round trips, the static table against pint, dimensions, and messages."""

from __future__ import annotations

import math
import pickle
import subprocess
import sys
from contextlib import suppress
from typing import Any

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planemotion.base.errors import PlanemotionError, SceneError, SimulationError, nearest
from planemotion.language import dimensions, units
from planemotion.language.dimensions import Dimension
from planemotion.language.units import factor, parse_quantity, to_unit

WORDS = sorted(units._WORDS)
BASES = ("mass", "length", "time")
# What pint calls the words that mean something else there, or nothing.
WORDS_OF_PINT = {"lb": "force_pound", "oz": "force_ounce", "lbm": "pound", "rev": "revolution"}


@pytest.fixture(scope="module")
def plain_pint() -> Any:
    return pint.UnitRegistry()


# Factors found by hand from the definitions of the units.
BY_HAND = {
    "ft/s^2": (0.3048, dimensions.ACCELERATION),
    "lb*ft*s^2": (1.3558179483314004, dimensions.INERTIA),
    "ft*lb*s^2": (1.3558179483314004, dimensions.INERTIA),
    "slug*ft^2": (1.3558179483314004, dimensions.INERTIA),
    "lb/in": (175.12683524647636, dimensions.STIFFNESS),
    "N/(m*s)": (1.0, dimensions.STIFFNESS / dimensions.TIME),
    "kg*m²": (1.0, dimensions.INERTIA),
    "kg·m**2": (1.0, dimensions.INERTIA),
    "1/s": (1.0, dimensions.ANGULAR_VELOCITY),
    "rev/min": (math.pi / 30, dimensions.ANGULAR_VELOCITY),
    "(mm)^-2": (1e6, dimensions.DIMENSIONLESS / dimensions.LENGTH**2),
    "": (1.0, dimensions.DIMENSIONLESS),
    "1": (1.0, dimensions.DIMENSIONLESS),
}


@pytest.mark.parametrize("word", WORDS)
def test_static_table_is_pint_s(word: str, plain_pint: Any) -> None:
    base = plain_pint.Quantity(1.0, WORDS_OF_PINT.get(word, word)).to_base_units()
    size, dimension = factor(word)
    assert dimension == Dimension(*(base.dimensionality.get(f"[{name}]", 0) for name in BASES))
    assert size == pytest.approx(base.magnitude, rel=4e-16)


@pytest.mark.parametrize(("text", "expected"), BY_HAND.items())
def test_factor_of_compound_units(text: str, expected: Any) -> None:
    size, dimension = factor(text)
    assert size == pytest.approx(expected[0], rel=1e-15)
    assert dimension == expected[1]


@given(st.floats(-1e12, 1e12, allow_subnormal=False), st.sampled_from(WORDS))
def test_round_trip(value: float, word: str) -> None:
    quantity = parse_quantity(f"{value!r} {word}")
    assert quantity.value == value
    assert to_unit(quantity.value_si, word) == pytest.approx(value, rel=3e-16)


@given(st.sampled_from(WORDS), st.sampled_from(WORDS), st.integers(1, 4))
def test_products_of_units_multiply(first: str, second: str, power: int) -> None:
    size, dimension = factor(f"{first}/{second}^{power}")
    assert size == pytest.approx(factor(first)[0] / factor(second)[0] ** power, rel=1e-15)
    assert dimension == factor(first)[1] / factor(second)[1] ** power


@pytest.mark.parametrize(
    ("text", "value_si", "dimension", "unit"),
    [
        ("10 in", 0.254, dimensions.LENGTH, "in"),
        ("-1.5 rad/s", -1.5, dimensions.ANGULAR_VELOCITY, "rad/s"),
        (" +3kW ", 3000.0, dimensions.POWER, "kW"),
        ("1e-3 m", 1e-3, dimensions.LENGTH, "m"),
        ("- 90 deg", -math.pi / 2, dimensions.DIMENSIONLESS, "deg"),
        ("30 lb", 133.446648457815, dimensions.FORCE, "lb"),
        ("30 lbm", 13.6077711, dimensions.MASS, "lbm"),
        ("5 1/s", 5.0, dimensions.ANGULAR_VELOCITY, "1/s"),
        ("2.5", 2.5, dimensions.DIMENSIONLESS, ""),
        (2, 2.0, dimensions.DIMENSIONLESS, ""),
    ],
)
def test_quantity(text: str | float, value_si: float, dimension: Dimension, unit: str) -> None:
    quantity = parse_quantity(text)
    assert quantity.value_si == pytest.approx(value_si, rel=1e-15)
    assert (quantity.dimension, quantity.unit_text) == (dimension, unit)
    assert quantity.value_si == quantity.value * factor(quantity.unit_text)[0]


def test_words_outside_the_table_come_from_pint() -> None:
    assert factor("furlong") == (pytest.approx(201.168, rel=1e-5), dimensions.LENGTH)
    assert factor("klb") == (pytest.approx(4448.2216152605), dimensions.FORCE)


def test_quantities_of_pint_keep_their_own_meaning(plain_pint: Any) -> None:
    theirs, ours = plain_pint, units.registry()
    assert parse_quantity(theirs.Quantity(3, "inch")) == parse_quantity("3 in")
    # lb is a mass in their registry and a force in ours.
    mass = parse_quantity(theirs.Quantity(2, "lb"))
    assert (mass.value_si, mass.dimension, mass.unit_text) == (
        pytest.approx(0.90718474),
        dimensions.MASS,
        "kg",
    )
    force = parse_quantity(ours.Quantity(2, "lb"))
    assert (force.dimension, force.unit_text) == (dimensions.FORCE, "lb")
    assert parse_quantity(theirs.Quantity(2, "m/s**2")).dimension == dimensions.ACCELERATION
    with pytest.raises(SceneError, match="a single number is wanted"):
        parse_quantity(theirs.Quantity([1, 2], "m"))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("3 inn", '"3 inn": unknown unit "inn" (did you mean "in"?)'),
        ("3 pounds", '"3 pounds": "pounds" is ambiguous; write lb for a force, lbm for a mass'),
        ("20 degC", '"20 degC": "degC" is not a unit of mechanics (it has the dimension temperature)'),
        ("3 dB", '"3 dB": "dB" is not a unit with a constant factor'),
        (
            "3 kg m",
            '"3 kg m": "kg m" is not a unit: units are words joined by * and /, such as kg*m^2 or rad/s',
        ),
        ("3 m^1.5", '"3 m^1.5": "m^1.5" is not a unit: units are words joined by * and /'),
        ("3 m^x", '"3 m^x": "m^x" is not a unit: a power must be a whole number below 100'),
        ("3 (km^99)^99", "its factor to SI is beyond the range of numbers"),
        ("3 1/((mm^99)^99)", "its factor to SI is beyond the range of numbers"),
        ("3 (m", '"(m" is not a unit'),
        ("3 m)", '"m)" is not a unit'),
        ("3 m*", '"m*" is not a unit'),
        ("3 " + "m*" * 100 + "m", "a unit of 201 characters; at most 120 are read"),
        ("3 nan", '"3 nan": unknown unit "nan"'),
        ("50 %", '"50 %": "%" is not a unit'),
        ("in", '"in": a number with a unit is wanted, such as "10 in"'),
        ("nan", '"nan": a number with a unit is wanted'),
        (float("nan"), "nan: the number must be finite"),
        ("1e400 m", '"1e400 m": the number must be finite'),
        (True, "true: a number with a unit is wanted"),
        (None, "a number with a unit is wanted"),
    ],
)
def test_messages(text: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        parse_quantity(text)
    assert message in str(caught.value)


@given(st.text(max_size=20))
def test_any_text_is_a_quantity_or_an_error(text: str) -> None:
    with suppress(SceneError):
        assert math.isfinite(parse_quantity(text).value_si)


@pytest.mark.parametrize("dimension", list(dimensions._KNOWN_DIMENSIONS))
def test_the_unit_of_a_dimension_is_si(dimension: Dimension) -> None:
    assert factor(dimension.unit) == (1.0, dimension)


def test_dimension_names() -> None:
    assert dimensions.INERTIA.name == "moment of inertia"
    assert dimensions.INERTIA.formula == "mass*length^2"
    assert dimensions.ANGULAR_VELOCITY.phrase == "an angular velocity"
    assert dimensions.MOMENT.name.startswith("moment")
    odd = dimensions.FORCE * dimensions.FORCE
    assert odd.name == "quantity of mass^2*length^2/time^4"
    assert odd.unit == "kg^2*m^2/s^4"
    assert (dimensions.LENGTH**2) ** dimensions.exact_exponent(0.5) == dimensions.LENGTH
    assert (
        dimensions.DIMENSIONLESS / dimensions.INERTIA / dimensions.TIME
    ).formula == "1/(mass*length^2*time)"


def test_common_units_do_not_import_pint() -> None:
    """Start-up time: pint takes longer to import than everything else."""
    script = (
        "import sys; from planemotion.language.units import parse_quantity; parse_quantity('10 lb*ft/s^2'); "
        "sys.exit('pint' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_scene_error_text() -> None:
    error = SceneError("it must be positive", value="-3 kg")
    assert str(error) == '"-3 kg": it must be positive'
    placed = error.at(file="rod.toml", path="bodies.AB.mass")
    assert str(placed) == 'rod.toml: bodies.AB.mass = "-3 kg": it must be positive'
    assert placed.at(path="other").path == "bodies.AB.mass"
    assert str(SceneError("an empty sweep", path="sweep.d.num", value=0)) == "sweep.d.num = 0: an empty sweep"
    assert str(SceneError("no bodies")) == "no bodies"
    assert isinstance(placed, ValueError)
    assert isinstance(placed, PlanemotionError)


def test_errors_cross_processes() -> None:
    error = pickle.loads(pickle.dumps(SceneError("bad", file="a.toml", path="g", value=1)))
    assert str(error) == "a.toml: g = 1: bad"
    failed = pickle.loads(pickle.dumps(SimulationError("singular", status=-7, time=0.5)))
    assert (str(failed), failed.status, failed.time, failed.result) == ("singular", -7, 0.5, None)


def test_nearest() -> None:
    assert nearest("frictoin", ["friction", "mass"]) == "friction"
    assert nearest("Mass", ["friction", "mass"]) == "mass"
    assert nearest("zzz", ["friction", "mass"]) is None
