"""What operators and functions do with numbers: IEEE arithmetic as the kernel has it, bit for bit."""

from __future__ import annotations

import math
from collections.abc import Callable


def apply(operation: str, values: list[float]) -> float:
    """The value of an operator or function as the kernel computes it; not-a-number where it has none.

    A single value with "-" is negation; min and max may have more than two values.
    """
    if operation == "-" and len(values) == 1:
        return -values[0]
    function = _ARITHMETIC[operation]
    if operation not in ("min", "max"):
        return function(*values)
    result = values[0]
    for value in values[1:]:
        result = function(result, value)
    return result


def _quotient(a: float, b: float) -> float:
    if b != 0:
        return a / b
    if a == 0 or math.isnan(a):
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def _power(a: float, b: float) -> float:
    """pow of C, whose infinities Python turns into exceptions."""
    odd = b % 2 == 1
    try:
        return math.pow(a, b)
    except OverflowError:
        return -math.inf if a < 0 and odd else math.inf
    except ValueError:
        if a != 0:
            return math.nan
        return math.copysign(math.inf, a) if odd else math.inf


def _exponential(a: float) -> float:
    try:
        return math.exp(a)
    except OverflowError:
        return math.inf


def _logarithm(a: float) -> float:
    if a == 0:
        return -math.inf
    return math.nan if a < 0 else math.log(a)


def _hypotenuse(a: float, b: float) -> float:
    """hypot of C, which abs of a complex number calls (math.hypot rounds differently)."""
    try:
        return abs(complex(a, b))
    except OverflowError:
        return math.inf


def _floor(a: float) -> float:
    # Keeps the sign of -0.0, infinities and not-a-number.
    return float(math.floor(a)) if a != 0 and math.isfinite(a) else a


def _or_nan(function: Callable[[float], float]) -> Callable[[float], float]:
    """A function of the math module that gives not-a-number outside its domain, as in C."""

    def wrapped(a: float) -> float:
        try:
            return function(a)
        except ValueError:
            return math.nan

    return wrapped


_ARITHMETIC: dict[str, Callable[..., float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": _quotient,
    "^": _power,
    "<": lambda a, b: float(a < b),
    "<=": lambda a, b: float(a <= b),
    ">": lambda a, b: float(a > b),
    ">=": lambda a, b: float(a >= b),
    "=": lambda a, b: float(a == b),
    "!=": lambda a, b: float(a != b),
    "and": lambda a, b: float(a != 0 and b != 0),
    "or": lambda a, b: float(a != 0 or b != 0),
    "not": lambda a: float(a == 0),
    **{name: _or_nan(getattr(math, name)) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt")},
    "tanh": math.tanh,
    "atan2": math.atan2,
    "abs": math.fabs,
    "exp": _exponential,
    "log": _logarithm,
    "norm": _hypotenuse,
    "floor": _floor,
    # Not-a-number stays visible, as in the kernel.
    "min": lambda a, b: a if math.isnan(a) or a < b else b,
    "max": lambda a, b: a if math.isnan(a) or a > b else b,
    "select": lambda condition, a, b: a if condition != 0 else b,
}
