"""Expressions at random, their values, and the kernel's stack machine by its definition."""

from __future__ import annotations

import ctypes
import ctypes.util
import math
import struct
from typing import Any

from hypothesis import strategies as st

from planemotion import _layout as layout
from planemotion.language import tree
from planemotion.language.arithmetic import apply
from planemotion.language.leaves import evaluate
from planemotion.language.parser import parse
from planemotion.language.tree import Binary, Call, Name, Number, Unary

PARAMETERS = {"a": 2.385, "b": -0.71, "c": 1.37, "t": 0.3}
LIBM = ctypes.CDLL(ctypes.util.find_library("m"))


def value(text: str, **parameters: Any) -> Any:
    return evaluate(parse(text), lambda leaf: {**PARAMETERS, **parameters}[str(leaf)])


def bits(number: float) -> bytes:
    return struct.pack("<d", number) if not math.isnan(number) else b"nan"


NUMBERS = st.floats(-1e3, 1e3).map(lambda number: Number(number))


def operations(children: Any) -> Any:
    return (
        st.builds(Binary, st.sampled_from(sorted(tree.RANK)), children, children)
        | st.builds(Unary, st.sampled_from(["-", "not"]), children)
        | st.builds(
            lambda name, x: Call(name, (x,)), st.sampled_from(["sin", "sqrt", "log", "floor"]), children
        )
        | st.builds(
            lambda name, x: Call(name, tuple(x)),
            st.sampled_from(["min", "max"]),
            st.lists(children, min_size=2, max_size=4),
        )
        | st.builds(lambda *x: Call("select", x), children, children, children)
    )


TREES = st.recursive(NUMBERS | st.sampled_from([Name("a"), Name("b"), Name("c")]), operations, max_leaves=12)


BINARY_CODES = {
    "ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "POW": "^", "LT": "<", "LE": "<=", "GT": ">", "GE": ">=",
    "EQ": "=", "NE": "!=", "AND": "and", "OR": "or",
}  # fmt: skip
UNARY_NAMES = (
    *("sin", "cos", "tan", "asin", "acos", "atan", "tanh", "sqrt", "abs", "exp", "log", "floor", "not"),
)


def run(code: Any, pool: Any, parameters: Any) -> float:
    """The stack machine of planemotion.h, by its definition."""
    operators = {
        **{getattr(layout, f"PM_OP_{name}"): (symbol, 2) for name, symbol in BINARY_CODES.items()},
        **{getattr(layout, f"PM_OP_{name.upper()}"): (name, 1) for name in UNARY_NAMES},
        layout.PM_OP_HYPOT: ("norm", 2),
        layout.PM_OP_ATAN2: ("atan2", 2),
        layout.PM_OP_MIN: ("min", 2),
        layout.PM_OP_MAX: ("max", 2),
        layout.PM_OP_NEG: ("-", 1),
        layout.PM_OP_SELECT: ("select", 3),
    }
    stack = []
    for operation, argument in code:
        if operation == layout.PM_OP_CONSTANT:
            stack.append(pool.values[argument])
        elif operation == layout.PM_OP_PARAMETER:
            stack.append(parameters[argument])
        else:
            symbol, count = operators[operation]
            operands = stack[-count:]
            del stack[-count:]
            stack.append(apply(symbol, operands))
    (result,) = stack
    return result


COLUMN = {name: index for index, name in enumerate(PARAMETERS)}


def parameter(leaf: Any) -> Any:
    return layout.PM_OP_PARAMETER, COLUMN[leaf.text]


def no_leaf(leaf: Any) -> None:
    raise AssertionError(leaf)
