"""Units: from "10 in" to SI and back, with the dimension of every number.

A number with a unit is `value * factor(unit)` in SI.  Dimensions are exponents of mass, length and time;
angles are dimensionless (rad = 1), deg and rev are plain factors.  lb, kip and oz are forces; masses are kg,
g, slug, lbm.

Unit expressions are words joined by `*` and `/`, with integer powers and parentheses: "lb*ft*s^2", "1/s".
The common words stand in a static table; only other words import pint, which takes a good part of a second.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache, lru_cache
from numbers import Real
from typing import TYPE_CHECKING, Any

from ..base.errors import SceneError, nearest
from .dimensions import (
    ANGULAR_VELOCITY,
    DIMENSIONLESS,
    ENERGY,
    FORCE,
    LENGTH,
    MASS,
    POWER,
    PRESSURE,
    TIME,
    VELOCITY,
    Dimension,
    exact_exponent,
)

if TYPE_CHECKING:
    import pint


# Longest text of a unit, in characters; bounds the recursion of the unit parser.
_MAX_UNIT_TEXT = 120
# By definition: the international foot and pound, and the pound's weight under standard gravity.
_FOOT = 0.3048
_POUND_MASS = 0.45359237
_POUND = 4.4482216152605
_WORDS: dict[str, tuple[float, Dimension]] = {
    "m": (1.0, LENGTH),
    "mm": (1e-3, LENGTH),
    "cm": (1e-2, LENGTH),
    "km": (1e3, LENGTH),
    "in": (0.0254, LENGTH),
    "ft": (_FOOT, LENGTH),
    "yd": (0.9144, LENGTH),
    "mi": (1609.344, LENGTH),
    "s": (1.0, TIME),
    "ms": (1e-3, TIME),
    "min": (60.0, TIME),
    "h": (3600.0, TIME),
    "mph": (0.44704, VELOCITY),
    "kg": (1.0, MASS),
    "g": (1e-3, MASS),
    "lbm": (_POUND_MASS, MASS),
    "slug": (_POUND / _FOOT, MASS),
    "N": (1.0, FORCE),
    "kN": (1e3, FORCE),
    "MN": (1e6, FORCE),
    "lb": (_POUND, FORCE),
    "lbf": (_POUND, FORCE),
    "oz": (_POUND / 16, FORCE),
    "kip": (_POUND * 1e3, FORCE),
    "J": (1.0, ENERGY),
    "kJ": (1e3, ENERGY),
    "MJ": (1e6, ENERGY),
    "W": (1.0, POWER),
    "kW": (1e3, POWER),
    "MW": (1e6, POWER),
    "hp": (550 * _FOOT * _POUND, POWER),
    "Pa": (1.0, PRESSURE),
    "kPa": (1e3, PRESSURE),
    "MPa": (1e6, PRESSURE),
    "psi": (_POUND / 0.0254**2, PRESSURE),
    "rad": (1.0, DIMENSIONLESS),
    "deg": (math.pi / 180, DIMENSIONLESS),
    "rev": (2 * math.pi, DIMENSIONLESS),
    "rpm": (2 * math.pi / 60, ANGULAR_VELOCITY),
}
# Words that mean a force to one reader and a mass to another.
_AMBIGUOUS = {
    "pound": "write lb for a force, lbm for a mass",
    "pounds": "write lb for a force, lbm for a mass",
    "lbs": "write lb for a force, lbm for a mass",
    "ounce": "write oz for a force, g or lbm for a mass",
    "ounces": "write oz for a force, g or lbm for a mass",
    "ton": "write kip or kN for a force, kg or slug for a mass",
    "tons": "write kip or kN for a force, kg or slug for a mass",
    "kgf": "write N for a force",
}
NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_WORD = r"[^\W\d_]\w*"
_POWER = r"(?:\s*(?:\^|\*\*)\s*-?\d+|[²³])?"
_FLAT = rf"(?:1|{_WORD}){_POWER}(?:\s*[*/·]\s*{_WORD}{_POWER})*"
_FACTOR = rf"(?:{_WORD}|\(\s*{_FLAT}\s*\)){_POWER}"
# A unit expression as it may follow a number (parentheses one level deep, as in "N/(m*s)").
UNIT = rf"(?:1\s*/\s*{_FACTOR}|{_FACTOR})(?:\s*[*/·]\s*{_FACTOR})*"
_WANTED = 'a number with a unit is wanted, such as "10 in"'
_QUANTITY = re.compile(rf"([+-]?\s*{NUMBER})\s*(.*)", re.DOTALL)
_UNIT_TOKEN = re.compile(rf"\s*(?:({_WORD})|(\d+)|(\*\*|[-*/^()]))")


@dataclass(frozen=True)
class Quantity:
    """A number as written and in SI: value_si = value * factor(unit_text)."""

    value_si: float
    dimension: Dimension
    unit_text: str
    value: float


def is_common(word: str) -> bool:
    """Whether the word is a unit that is known without pint."""
    return word in _WORDS


@lru_cache(maxsize=1024)
def factor(unit: str) -> tuple[float, Dimension]:
    """SI value of one `unit`, and its dimension; ("", "1": dimensionless).

    Raises SceneError for an unknown, ambiguous or non-mechanical unit (temperatures, currents, decibels) and
    for a text that is no unit expression.
    """
    text = unit.strip()
    if text in ("", "1"):
        return 1.0, DIMENSIONLESS
    if len(text) > _MAX_UNIT_TEXT:
        raise SceneError(f"a unit of {len(text)} characters; at most {_MAX_UNIT_TEXT} are read", value=unit)
    return _UnitParser(text).parse()


def parse_quantity(text: object) -> Quantity:
    """A quantity from "10 in", "-1.5 rad/s", a bare number (dimensionless) or a quantity of pint.

    Raises SceneError for anything else, for numbers that are not finite, and for units that `factor` refuses.
    """
    if isinstance(text, str):
        match = _QUANTITY.fullmatch(text.strip())
        if not match:
            raise SceneError(_WANTED, value=text)
        value, unit = float("".join(match[1].split())), match[2]
        try:
            size, dimension = factor(unit)
        except SceneError as error:
            raise SceneError(error.reason, value=text) from None
        return _finite(Quantity(value * size, dimension, unit, value), text)
    if isinstance(text, bool):
        raise SceneError(_WANTED, value=text)
    if isinstance(text, Real):
        value = number(text)
        return _finite(Quantity(value, DIMENSIONLESS, "", value), text)
    if hasattr(text, "to_base_units") and hasattr(text, "dimensionality"):
        return _finite(_from_pint(text), text)
    raise SceneError(_WANTED, value=text)


def number(real: Real) -> float:
    """The nearest double; infinite beyond all of them."""
    try:
        return float(real)
    except OverflowError:
        return math.inf


def seconds_of(written: object, path: str, wanted: str) -> float:
    """A time in s, from a text with its unit or a quantity of pint; 0 needs no unit.

    Raises SceneError for anything else, with the key `path`, the value and what is `wanted`.
    """
    try:
        quantity = parse_quantity(written)
    except SceneError as error:
        reason = wanted if error.reason == _WANTED else f"{error.reason}; {wanted}"
        raise SceneError(reason, path=path, value=written) from None
    if quantity.dimension != TIME and quantity.value_si != 0:
        raise SceneError(f"{quantity.dimension.phrase}; {wanted}", path=path, value=written)
    return quantity.value_si


def is_unit(text: str) -> bool:
    """Whether the text is a unit of mechanics."""
    try:
        factor(text)
    except SceneError:
        return False
    return bool(text.strip())


def to_unit(si: float, unit: str) -> float:
    """The SI value `si` expressed in `unit`.  Raises SceneError as `factor` does."""
    return si / factor(unit)[0]


@cache
def registry() -> pint.UnitRegistry[Any]:
    """The registry of pint with this package's words: lb and oz are forces, lbm and slug masses.

    Quantities of any registry are accepted; this one means by a word what a scene file does.
    """
    import pint

    units: pint.UnitRegistry[Any] = pint.UnitRegistry(on_redefinition="ignore", cache_folder=None)
    for line in ("lb = force_pound", "oz = force_pound / 16", "lbm = pound"):
        units.define(line)
    return units


def _finite(quantity: Quantity, written: object) -> Quantity:
    if not math.isfinite(quantity.value_si):
        raise SceneError("the number must be finite", value=written)
    return quantity


def _from_pint(quantity: Any) -> Quantity:
    """A scalar quantity of any pint registry, in the unit it has if that means the same here, else in SI."""
    base = quantity.to_base_units()
    dimension = _dimension_of(base.dimensionality, str(quantity))
    try:
        value_si, value = float(base.m_as(dimension.unit or "")), float(quantity.magnitude)
    except TypeError:
        raise SceneError("a single number is wanted, not an array", value=str(quantity)) from None
    unit = f"{quantity.units:~C}"
    try:
        size, same = factor(unit)
    except SceneError:
        return Quantity(value_si, dimension, dimension.unit, value_si)
    if same == dimension and math.isclose(value * size, value_si, rel_tol=1e-14):
        return Quantity(value * size, dimension, unit, value)
    return Quantity(value_si, dimension, dimension.unit, value_si)


def _dimension_of(dimensionality: Any, word: str) -> Dimension:
    """The dimension from pint's mapping of base dimensions; SceneError if it is not one of mechanics."""
    exponents = {base: exact_exponent(power) for base, power in dimensionality.items()}
    dimension = Dimension(*(exponents.pop(base, 0) for base in ("[mass]", "[length]", "[time]")))
    if exponents:
        kinds = ", ".join(base.strip("[]") for base in exponents)
        raise SceneError(f'"{word}" is not a unit of mechanics (it has the dimension {kinds})')
    return dimension


def _word(word: str) -> tuple[float, Dimension]:
    """Factor and dimension of a single unit word."""
    known = _WORDS.get(word)
    if known:
        return known
    if word in _AMBIGUOUS:
        raise SceneError(f'"{word}" is ambiguous; {_AMBIGUOUS[word]}')
    return _word_of_pint(word)


def _word_of_pint(word: str) -> tuple[float, Dimension]:
    import pint

    units = registry()
    try:
        unit = units.Unit(word)
        one, two = (units.Quantity(number, unit).to_base_units().magnitude for number in (1.0, 2.0))
    except (pint.UndefinedUnitError, ValueError):
        guess = nearest(word, _WORDS)
        hint = f' (did you mean "{guess}"?)' if guess else ""
        raise SceneError(f'unknown unit "{word}"{hint}') from None
    dimension = _dimension_of(unit.dimensionality, word)
    if two != 2 * one:
        raise SceneError(f'"{word}" is not a unit with a constant factor')
    return float(one), dimension


class _UnitParser:
    """Recursive descent over `product := power (("*" | "/") power)*`; the text's length bounds its depth."""

    def __init__(self, text: str) -> None:
        self.text = text
        plain = text.replace("²", "^2").replace("³", "^3").replace("·", "*")
        self.tokens: list[str] = []
        position = 0
        while position < len(plain):
            match = _UNIT_TOKEN.match(plain, position)
            if not match:
                raise self.error()
            self.tokens.append(match[0].strip().replace("**", "^"))
            position = match.end()
        self.next = 0

    def parse(self) -> tuple[float, Dimension]:
        try:
            size, dimension = self.product()
        except (OverflowError, ZeroDivisionError):
            raise self.error("its factor to SI is beyond the range of numbers") from None
        if self.next < len(self.tokens):
            raise self.error()
        if not 0 < size < math.inf:
            raise self.error("its factor to SI is beyond the range of numbers")
        return size, dimension

    def take(self, *wanted: str) -> str | None:
        """The next token if it is one of those wanted."""
        if self.next < len(self.tokens) and self.tokens[self.next] in wanted:
            self.next += 1
            return self.tokens[self.next - 1]
        return None

    def product(self) -> tuple[float, Dimension]:
        size, dimension = self.power()
        while operator := self.take("*", "/"):
            other, other_dimension = self.power()
            if operator == "*":
                size, dimension = size * other, dimension * other_dimension
            else:
                size, dimension = size / other, dimension / other_dimension
        return size, dimension

    def power(self) -> tuple[float, Dimension]:
        size, dimension = self.atom()
        if not self.take("^"):
            return size, dimension
        sign = -1 if self.take("-") else 1
        exponent = self.tokens[self.next] if self.next < len(self.tokens) else ""
        # Two digits are far beyond physics; more would only make dimensions of absurd size.
        if not exponent.isdecimal() or len(exponent) > 2:
            raise self.error("a power must be a whole number below 100")
        self.next += 1
        return size ** (sign * int(exponent)), dimension ** (sign * int(exponent))

    def atom(self) -> tuple[float, Dimension]:
        if self.take("("):
            inner = self.product()
            if not self.take(")"):
                raise self.error()
            return inner
        if self.take("1"):
            return 1.0, DIMENSIONLESS
        word = self.tokens[self.next] if self.next < len(self.tokens) else ""
        if not word[:1].isalpha():
            raise self.error()
        self.next += 1
        return _word(word)

    def error(self, reason: str = "units are words joined by * and /, such as kg*m^2 or rad/s") -> SceneError:
        return SceneError(f'"{self.text}" is not a unit: {reason}')


def declared_unit(written: str | float) -> str:
    """The unit of a parameter as the file gives it; "" where it is an expression."""
    try:
        return parse_quantity(written).unit_text
    except SceneError:
        return ""
