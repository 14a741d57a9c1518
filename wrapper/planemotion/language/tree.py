"""The nodes of an expression, and how to compose them from Python.

Nodes are frozen: `Number`, `Name`, `Address` (in address.py), `Unary`, `Binary` and `Call`.  Python's
operators and the functions below build new nodes and drop what is trivial (0*x, x + 0, 1*x, arithmetic of
two numbers), so that a composed pose stays short.  Composition does not check dimensions: compose what has
been checked.

The arithmetic of `apply` is that of the kernel's program.c, bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from .arithmetic import apply
from .dimensions import DIMENSIONLESS, Dimension
from .units import Quantity


class Node:
    """Base of all nodes: the operators that compose them; a plain number beside a node is dimensionless."""

    def __add__(self, other: Node | float) -> Node:
        return binary("+", self, other)

    def __radd__(self, other: float) -> Node:
        return binary("+", other, self)

    def __sub__(self, other: Node | float) -> Node:
        return binary("-", self, other)

    def __rsub__(self, other: float) -> Node:
        return binary("-", other, self)

    def __mul__(self, other: Node | float) -> Node:
        return binary("*", self, other)

    def __rmul__(self, other: float) -> Node:
        return binary("*", other, self)

    def __truediv__(self, other: Node | float) -> Node:
        return binary("/", self, other)

    def __rtruediv__(self, other: float) -> Node:
        return binary("/", other, self)

    def __pow__(self, other: Node | float) -> Node:
        return binary("^", self, other)

    def __neg__(self) -> Node:
        return negative(self)

    def __abs__(self) -> Node:
        return call("abs", self)


@dataclass(frozen=True)
class Number(Node):
    """A constant in SI; `wild`: a literal 0, which fits any dimension.  `text`: as written, for messages."""

    value_si: float
    dimension: Dimension = DIMENSIONLESS
    wild: bool = False
    text: str = field(default="", compare=False)

    def __str__(self) -> str:
        if not self.text:
            return f"{self.value_si:g} {self.dimension.unit}".strip()
        return self.text


@dataclass(frozen=True)
class Name(Node):
    """A word without dots: a parameter, or a quantity of the whole scene such as t."""

    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Unary(Node):
    """`operator` is "-" or "not"."""

    operator: str
    operand: Node

    def __str__(self) -> str:
        space = " " if self.operator == "not" else ""
        return f"{self.operator}{space}{_inside(self.operand, _UNARY_RANK[self.operator])}"


@dataclass(frozen=True)
class Binary(Node):
    """`operator` is one of + - * / ^ = != < <= > >= and or."""

    operator: str
    left: Node
    right: Node

    def __str__(self) -> str:
        rank = RANK[self.operator]
        # Equal ranks group to the left, powers to the right, comparisons not at all.
        left = rank + 1 if self.operator == "^" or rank == COMPARISON_RANK else rank
        right = rank if self.operator == "^" else rank + 1
        space = "" if self.operator in "*/^" else " "
        return f"{_inside(self.left, left)}{space}{self.operator}{space}{_inside(self.right, right)}"


@dataclass(frozen=True)
class Call(Node):
    """One of the `FUNCTIONS` of its arguments."""

    function: str
    arguments: tuple[Node, ...]

    def __str__(self) -> str:
        return f"{self.function}({', '.join(map(str, self.arguments))})"


# How tightly an operator binds; greater binds first.
RANK = {
    "or": 1,
    "and": 2,
    **dict.fromkeys(("=", "!=", "<", "<=", ">", ">="), 4),
    **dict.fromkeys(("+", "-"), 6),
    **dict.fromkeys(("*", "/"), 7),
    "^": 9,
}
COMPARISON_RANK = RANK["="]
_UNARY_RANK = {"not": 3, "-": 8}
# A quantity or a negative number needs parentheses beside arithmetic, none beside a comparison.
_QUANTITY_RANK = 5
_LEAF_RANK = 10
# Function: least and greatest number of arguments (None: any number).
FUNCTIONS: dict[str, tuple[int, int | None]] = {
    **dict.fromkeys(("sin", "cos", "tan", "asin", "acos", "atan"), (1, 1)),
    **dict.fromkeys(("sqrt", "abs", "exp", "log", "tanh", "floor"), (1, 1)),
    **dict.fromkeys(("atan2", "norm"), (2, 2)),
    **dict.fromkeys(("min", "max"), (2, None)),
    "select": (3, 3),
}
# What may be written: `select` is for composed nodes only, sign(x) is (x > 0) - (x < 0).
WRITTEN_FUNCTIONS = {name: n for name, n in FUNCTIONS.items() if name != "select"} | {"sign": (1, 1)}
ZERO = Number(0.0, wild=True, text="0")
ONE = Number(1.0, text="1")


def as_node(value: Node | Quantity | float) -> Node:
    """A node as it is, a quantity or a plain number as a Number (0: wild)."""
    if isinstance(value, Node):
        return value
    if isinstance(value, Quantity):
        literal = f"{value.value:g} {value.unit_text}".strip()
        return Number(value.value_si, value.dimension, wild=literal == "0", text=literal)
    return Number(float(value), wild=value == 0)


def binary(operator: str, left: Node | float, right: Node | float) -> Node:
    """`left operator right`, simplified where that is trivial."""
    a, b = as_node(left), as_node(right)
    simple = _SIMPLIFY[operator](a, b) if operator in _SIMPLIFY else None
    return simple if simple is not None else Binary(operator, a, b)


def negative(operand: Node) -> Node:
    """`-operand`, simplified where that is trivial."""
    if isinstance(operand, Number):
        return ZERO if operand.wild else Number(-operand.value_si, operand.dimension)
    if isinstance(operand, Unary) and operand.operator == "-":
        return operand.operand
    return Unary("-", operand)


def call(function: str, *arguments: Node | float) -> Node:
    """One of the `FUNCTIONS` of its arguments; of dimensionless numbers alone: its value."""
    least, most = FUNCTIONS[function]
    if len(arguments) < least or (most is not None and len(arguments) > most):
        raise TypeError(f"{function} takes {count_text(function)}, not {len(arguments)}")
    nodes = tuple(as_node(argument) for argument in arguments)
    values = [node.value_si for node in nodes if isinstance(node, Number) and node.dimension == DIMENSIONLESS]
    return Number(apply(function, values)) if len(values) == len(nodes) else Call(function, nodes)


def count_text(function: str) -> str:
    """How many arguments a function takes, in words."""
    least, most = (FUNCTIONS | WRITTEN_FUNCTIONS)[function]
    if most is None:
        return f"at least {least} arguments"
    return f"{most} argument{'s' if most > 1 else ''}"


def sin(x: Node | float) -> Node:
    """Sine of an angle in rad."""
    return call("sin", x)


def cos(x: Node | float) -> Node:
    """Cosine of an angle in rad."""
    return call("cos", x)


def atan2(y: Node | float, x: Node | float) -> Node:
    """Direction of (x, y) in (-pi, pi]."""
    return call("atan2", y, x)


def sqrt(x: Node | float) -> Node:
    """Square root."""
    return call("sqrt", x)


def norm(x: Node | float, y: Node | float) -> Node:
    """sqrt(x^2 + y^2)."""
    return call("norm", x, y)


def is_condition(node: Node) -> bool:
    """Whether it is 1 or 0 as a comparison holds, or several of them together."""
    if isinstance(node, Unary):
        return node.operator == "not"
    return isinstance(node, Binary) and RANK[node.operator] <= COMPARISON_RANK


def select(condition: Node | float, then: Node | float, otherwise: Node | float) -> Node:
    """`then` where the condition is not 0, else `otherwise` (no word of the scene language: for
    composing)."""
    return call("select", condition, then, otherwise)


def _inside(node: Node, rank: int) -> str:
    """The text of an operand, in parentheses where it binds less tightly than `rank`."""
    if isinstance(node, Binary):
        own = RANK[node.operator]
    elif isinstance(node, Unary):
        own = _UNARY_RANK[node.operator]
    elif isinstance(node, Number) and (" " in str(node) or str(node).startswith("-")):
        own = _QUANTITY_RANK
    else:
        own = _LEAF_RANK
    return f"({node})" if own < rank else str(node)


def _is(node: Node, value: float) -> bool:
    """Whether the node is this dimensionless constant (0: of any dimension)."""
    if not isinstance(node, Number) or node.value_si != value:
        return False
    return value == 0 or node.dimension == DIMENSIONLESS


def _add(a: Node, b: Node) -> Node | None:
    if _is(a, 0):
        return b
    if _is(b, 0):
        return a
    if isinstance(a, Number) and isinstance(b, Number) and a.dimension == b.dimension:
        return Number(a.value_si + b.value_si, a.dimension)
    return None


def _subtract(a: Node, b: Node) -> Node | None:
    if _is(b, 0):
        return a
    if _is(a, 0):
        return negative(b)
    if isinstance(a, Number) and isinstance(b, Number) and a.dimension == b.dimension:
        return Number(a.value_si - b.value_si, a.dimension)
    return None


def _multiply(a: Node, b: Node) -> Node | None:
    if _is(a, 0) or _is(b, 0):
        return ZERO
    if _is(a, 1):
        return b
    if _is(b, 1):
        return a
    if isinstance(a, Number) and isinstance(b, Number):
        return Number(a.value_si * b.value_si, a.dimension * b.dimension)
    return None


def _divide(a: Node, b: Node) -> Node | None:
    if _is(b, 1):
        return a
    if isinstance(a, Number) and isinstance(b, Number) and not _is(b, 0) and not a.wild:
        return Number(a.value_si / b.value_si, a.dimension / b.dimension)
    return None


_SIMPLIFY: dict[str, Callable[[Node, Node], Node | None]] = {
    "+": _add,
    "-": _subtract,
    "*": _multiply,
    "/": _divide,
}
