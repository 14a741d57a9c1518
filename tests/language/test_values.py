"""Values of expressions against Python's and C's; code against values."""

from __future__ import annotations

import ctypes
import ctypes.util
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planemotion.language import tree
from planemotion.language.arithmetic import apply
from planemotion.language.code import ConstantPool, emit
from planemotion.language.leaves import evaluate
from planemotion.language.tree import Binary, Call, Node, Number, Unary
from tests.language.expressions import LIBM, PARAMETERS, TREES, bits, parameter, run, value

SAME_IN_PYTHON = [
    "a + b*c",
    "a - b - c",
    "a/b/c",
    "-a^2",
    "a^c^b",
    "2^-a",
    "-(a - b)*c",
    "a - -b",
    "+a",
    "(a + b)*(c - a)/(b*c)",
    "1.5e-3*a + .5 - 2.",
    "(a < b) + (b <= c) + (a > b) + (c >= a) + (a != b)",
    "a > b and b > c or not a < c",
    "not a < b and c > 0",
    "sin(a) + cos(b)*tan(c) - atan(a)",
    "asin(b) + acos(b) + atan2(a, b)",
    "sqrt(a) + abs(b) + exp(c) + log(a) + floor(b)",
    "min(a, b, c) + max(b, a)",
    "2*pi*a",
]


@pytest.mark.parametrize("text", SAME_IN_PYTHON)
def test_value_is_python_s(text: str) -> None:
    functions = {name: getattr(math, name) for name in tree.FUNCTIONS if hasattr(math, name)}
    scope = {**PARAMETERS, **functions, "abs": abs, "min": min, "max": max, "pi": math.pi}
    assert value(text) == eval(text.replace("^", "**"), scope)


@given(TREES)
def test_code_computes_the_value(tree: Node) -> None:
    pool = ConstantPool()
    code = emit(tree, parameter, pool)
    expected = evaluate(tree, lambda leaf: PARAMETERS[str(leaf)])
    assert bits(run(code, pool, list(PARAMETERS.values()))) == bits(expected)


@given(TREES)
def test_written_again_it_is_the_same_expression(tree: Node) -> None:
    """Grouping survives: the text of a node evaluates to the same bits."""
    if "select" in str(tree):
        return
    exact = substitute_exact(tree)
    text = str(exact)
    assert bits(value(text)) == bits(evaluate(exact, lambda leaf: PARAMETERS[str(leaf)]))


def substitute_exact(tree: Node) -> Any:
    """Numbers with all their digits as their text."""
    match tree:
        case Number():
            return Number(tree.value_si, text=repr(tree.value_si))
        case Unary():
            return Unary(tree.operator, substitute_exact(tree.operand))
        case Binary():
            return Binary(tree.operator, substitute_exact(tree.left), substitute_exact(tree.right))
        case Call():
            return Call(tree.function, tuple(map(substitute_exact, tree.arguments)))
    return tree


ANY_NUMBER = st.floats() | st.sampled_from([0.0, -0.0, 1.0, -1.0, 0.5, 3.0, -3.0])


@given(ANY_NUMBER, ANY_NUMBER)
def test_arithmetic_is_that_of_c(x: float, y: float) -> None:
    for name, function in {"^": LIBM.pow, "norm": LIBM.hypot, "atan2": LIBM.atan2}.items():
        function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double, ctypes.c_double]
        assert bits(apply(name, [x, y])) == bits(function(x, y)), name
    for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "tanh", "exp", "log", "floor"):
        function = getattr(LIBM, name)
        function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double]
        assert bits(apply(name, [x])) == bits(function(x)), name


def test_not_a_number_stays_visible() -> None:
    for operation in ("min", "max", "+", "*", "/"):
        assert math.isnan(apply(operation, [math.nan, 1.0]))
        assert math.isnan(apply(operation, [1.0, math.nan]))
    assert apply("<", [math.nan, 1.0]) == 0.0
    assert apply("/", [1.0, -0.0]) == -math.inf
    assert math.isnan(apply("/", [0.0, 0.0]))
