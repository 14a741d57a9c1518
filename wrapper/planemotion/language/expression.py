"""Expressions: read from text, checked for dimensions, compiled to the kernel's postfix code.

The grammar is a whitelist of our own; no text is ever run by Python.  From weak to strong:

    or | and | not | = != < <= > >= (not chained) | + - | * / | - (sign) | ^ (to the right)

Operands are numbers, quantities, names, addresses, pi, `function(...)` and parentheses.  A quantity such as
10 in stands alone, in parentheses, as an argument or as a side of a comparison: "AB.angle = -90 deg",
"r + (3 in)".

The leaves are `Name` (a word without dots: a parameter, or t) and `Address` (a word with dots, an index, or
followed by in, on, about, along); callers say what a leaf means.  A direction behind `along` is text inside
its address: it is no leaf of the expression, so whoever resolves the address parses it.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import TypeAlias

from .. import _layout as layout
from ..base.errors import SceneError, nearest
from .address import Address, Scanner, read_address
from .tree import (
    COMPARISON_RANK,
    FUNCTIONS,
    RANK,
    Binary,
    Call,
    Name,
    Node,
    Number,
    Unary,
    apply,
    as_node,
    count_text,
)
from .units import DIMENSIONLESS, NUMBER, UNIT, Dimension, exact_exponent, factor, parse_quantity

Leaf: TypeAlias = Name | Address
Instruction: TypeAlias = tuple[int, int]

# Longest expression in characters and deepest nesting: both far above what is written by hand and below what
# the recursion of the parser and of the functions here can take.
MAX_TEXT = 4000
MAX_NESTING = 60
MAX_HEIGHT = 200

_OPERATOR_CODES: dict[str, int] = {
    "+": layout.PM_OP_ADD,
    "-": layout.PM_OP_SUB,
    "*": layout.PM_OP_MUL,
    "/": layout.PM_OP_DIV,
    "^": layout.PM_OP_POW,
    "<": layout.PM_OP_LT,
    "<=": layout.PM_OP_LE,
    ">": layout.PM_OP_GT,
    ">=": layout.PM_OP_GE,
    "=": layout.PM_OP_EQ,
    "!=": layout.PM_OP_NE,
    "and": layout.PM_OP_AND,
    "or": layout.PM_OP_OR,
}
_SIGN_CODES: dict[str, int] = {"-": layout.PM_OP_NEG, "not": layout.PM_OP_NOT}
_FUNCTION_CODES: dict[str, int] = {
    "sin": layout.PM_OP_SIN,
    "cos": layout.PM_OP_COS,
    "tan": layout.PM_OP_TAN,
    "asin": layout.PM_OP_ASIN,
    "acos": layout.PM_OP_ACOS,
    "atan": layout.PM_OP_ATAN,
    "atan2": layout.PM_OP_ATAN2,
    "sqrt": layout.PM_OP_SQRT,
    "abs": layout.PM_OP_ABS,
    "min": layout.PM_OP_MIN,
    "max": layout.PM_OP_MAX,
    "exp": layout.PM_OP_EXP,
    "log": layout.PM_OP_LOG,
    "norm": layout.PM_OP_HYPOT,
    "floor": layout.PM_OP_FLOOR,
    "select": layout.PM_OP_SELECT,
}
# How many numbers an operation takes off the stack; operations that are not here push one.
_OPERANDS: dict[int, int] = {
    **dict.fromkeys(_OPERATOR_CODES.values(), 2),
    **dict.fromkeys(_SIGN_CODES.values(), 1),
    **{code: FUNCTIONS[name][0] for name, code in _FUNCTION_CODES.items()},
}
# `select` is for composed nodes only.
_WRITTEN_FUNCTIONS = tuple(name for name in FUNCTIONS if name != "select")

_OPERATOR = r"<=|>=|!=|[-+*/^=<>]|(?:and|or)\b"
# A unit directly behind a number; "in" is one there, and "x > 0 and y > 0" has none.
_UNIT_HERE = rf"(?!(?:and|or|not)\b){UNIT}"


# ---- reading ---------------------------------------------------------------------------------------------


def parse(written: object, *, where: str | None = None) -> Node:
    """The expression written as a text, a number, true or false (1 or 0), or a quantity of pint.

    `where` is the key path for messages.  Raises SceneError with that path and the text as its value.
    """
    try:
        if isinstance(written, str):
            return _read(written)
        if isinstance(written, bool):
            return Number(float(written))
        return as_node(parse_quantity(written))
    except SceneError as error:
        raise SceneError(error.reason, path=where, value=written) from None


@lru_cache(maxsize=1024)
def _read(text: str) -> Node:
    """Nodes are frozen: a text that is read again, as in every sweep of a scene, is the same one."""
    return _Parser(text).parse()


class _Parser:
    """Precedence climbing over a scanner."""

    def __init__(self, text: str) -> None:
        if len(text) > MAX_TEXT:
            raise SceneError(f"an expression of {len(text)} characters; at most {MAX_TEXT} are read")
        self.scanner = Scanner(text)
        self.nesting = 0
        # Quantities without parentheses, by identity: they must not meet an arithmetic operator.
        self.bare: list[Node] = []

    def parse(self) -> Node:
        node = self.expression(1)
        if not self.scanner.at_end():
            raise self.scanner.unexpected("an operator or the end")
        if _height(node) > MAX_HEIGHT:
            raise SceneError(f"a chain of more than {MAX_HEIGHT} operations; split it into parameters")
        return node

    def expression(self, weakest: int) -> Node:
        """An expression of operators that bind at least as tightly as rank `weakest`."""
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            raise SceneError(f"nested more than {MAX_NESTING} levels deep; split it into parameters")
        left = self.operand()
        compared = False
        while (operator := self.scanner.peek(_OPERATOR)) and RANK[operator] >= weakest:
            start = self.scanner.position
            self.scanner.take(_OPERATOR)
            self.refuse_foreign(operator, start)
            rank = RANK[operator]
            right = self.expression(rank if operator == "^" else rank + 1)
            if rank > COMPARISON_RANK:
                self.refuse_bare(left, right)
            elif rank == COMPARISON_RANK:
                if compared:
                    raise SceneError('comparisons are not chained; write "a < b and b < c"')
                compared = True
            left = Binary(operator, left, right)
        self.nesting -= 1
        return left

    def operand(self) -> Node:
        """A number, quantity, name, address, call, group, or a sign or `not` and its operand."""
        scanner = self.scanner
        if scanner.take_keyword("not"):
            return Unary("not", self.expression(COMPARISON_RANK))
        if scanner.take(r"-"):
            return self.negated(self.expression(RANK["^"]))
        if scanner.take(r"\+"):
            return self.expression(RANK["^"])
        if scanner.take(r"\("):
            group = self.expression(1)
            self.close()
            # In parentheses a quantity may stand anywhere.
            self.bare = [node for node in self.bare if node is not group]
            return group
        number = scanner.take(NUMBER)
        if number is not None:
            return self.number(number)
        word = scanner.take_word()
        if word is None:
            raise scanner.unexpected("a number, a name or a parenthesis")
        if scanner.peek(r"\("):
            return self.call(word)
        if word == "pi":
            return Number(math.pi, text="pi")
        if "." in word or "[" in word or scanner.peek(r"(?:in|on|about|along)\b"):
            return read_address(scanner, word)
        return Name(word)

    def number(self, number: str) -> Node:
        """A number with or without a unit behind it."""
        value = float(number)
        if not math.isfinite(value):
            raise SceneError(f"{number} is too large for a number")
        unit = self.scanner.take(_UNIT_HERE)
        if unit is None:
            return Number(value, wild=value == 0, text=number)
        try:
            size, dimension = factor(unit)
        except SceneError as error:
            # What was meant as a product with a parameter has been read as a unit.
            hint = "; a number with a unit goes in parentheses: (2 s)*t" if "*" in unit or "/" in unit else ""
            raise SceneError(error.reason + hint) from None
        node = Number(value * size, dimension, text=f"{number} {unit}")
        self.bare.append(node)
        return node

    def negated(self, operand: Node) -> Node:
        """The sign of a literal belongs to it; of anything else it is an operation."""
        if not isinstance(operand, Number):
            return Unary("-", operand)
        node = Number(-operand.value_si, operand.dimension, operand.wild, text=f"-{operand.text}")
        if any(operand is bare for bare in self.bare):
            self.bare.append(node)
        return node

    def call(self, word: str) -> Node:
        """A function and its arguments; the scanner stands at the opening parenthesis."""
        if word not in _WRITTEN_FUNCTIONS:
            guess = nearest(word, _WRITTEN_FUNCTIONS)
            known = f'did you mean "{guess}"?' if guess else f"there are {', '.join(_WRITTEN_FUNCTIONS)}"
            raise SceneError(f'unknown function "{word}" ({known})')
        self.scanner.take(r"\(")
        arguments = [self.expression(1)]
        while self.scanner.take(r","):
            arguments.append(self.expression(1))
        self.close()
        least, most = FUNCTIONS[word]
        if len(arguments) < least or (most is not None and len(arguments) > most):
            raise SceneError(f"{word} takes {count_text(word)}, not {len(arguments)}")
        return Call(word, tuple(arguments))

    def close(self) -> None:
        if not self.scanner.take(r"\)"):
            raise self.scanner.unexpected("an operator or )")

    def refuse_bare(self, left: Node, right: Node) -> None:
        for node in (left, right):
            if any(node is bare for bare in self.bare):
                raise SceneError(f"a number with a unit inside an expression goes in parentheses: ({node})")

    def refuse_foreign(self, operator: str, start: int) -> None:
        """Operators of other languages, which would else be reported as a missing operand."""
        behind = self.scanner.text[start : start + 2]
        if operator == "*" and behind == "**":
            raise SceneError("write ^ for a power, not **")
        if operator == "=" and behind == "==":
            raise SceneError("write = for equality, not ==")


# ---- looking at ------------------------------------------------------------------------------------------


def _operands(node: Node) -> tuple[Node, ...]:
    match node:
        case Unary():
            return (node.operand,)
        case Binary():
            return (node.left, node.right)
        case Call():
            return node.arguments
    return ()


def _height(node: Node) -> int:
    """Operations on the longest way from the top to a leaf; without recursion, since it guards that."""
    height, level = 0, _operands(node)
    while level:
        height += 1
        level = tuple(operand for parent in level for operand in _operands(parent))
    return height


def _leaves(node: Node) -> Iterator[Leaf]:
    if isinstance(node, Name | Address):
        yield node
    for operand in _operands(node):
        yield from _leaves(operand)


def names(node: Node) -> set[Leaf]:
    """The leaves that are not numbers.  (A set: sort by `str` where an order matters.)"""
    return set(_leaves(node))


# ---- dimensions ------------------------------------------------------------------------------------------


def dimension(node: Node, resolve: Callable[[Leaf], Dimension | None]) -> Dimension | None:
    """The dimension of the expression; None if it fits any (0, and products with it).

    `resolve` gives the dimension of a leaf (None: any).  Raises SceneError naming the two parts that clash.
    """

    def of(part: Node) -> Dimension | None:
        match part:
            case Number():
                return None if part.wild else part.dimension
            case Name() | Address():
                return resolve(part)
            case Unary():
                if part.operator == "not":
                    _plain(part.operand, of(part.operand), '"not"')
                    return DIMENSIONLESS
                return of(part.operand)
            case Binary():
                return _of_binary(part, of(part.left), of(part.right))
            case Call():
                return _of_call(part, [of(argument) for argument in part.arguments])
        raise TypeError(f"no node of an expression: {part!r}")

    return of(node)


def require(node: Node, wanted: Dimension, resolve: Callable[[Leaf], Dimension | None]) -> None:
    """Raises SceneError unless the expression has the wanted dimension (0 fits any)."""
    found = dimension(node, resolve)
    if found is not None and found != wanted:
        raise SceneError(f"{wanted.phrase}{_such_as(wanted)} is wanted; this is {found.phrase}")


def _such_as(wanted: Dimension) -> str:
    """The formula of a dimension and a unit as an example, in parentheses."""
    if wanted == DIMENSIONLESS:
        return ""
    formula = f"{wanted.formula}, " if wanted.formula != wanted.name else ""
    return f" ({formula}such as {wanted.unit})"


# What operators and functions of dimensionless numbers take, where "a plain number" would be unclear.
_TAKES = {
    **dict.fromkeys(('"and"', '"or"', '"not"', "select"), "conditions, such as x > 0"),
    **dict.fromkeys(("sin", "cos", "tan"), "an angle or a plain number"),
}


def _of_binary(node: Binary, left: Dimension | None, right: Dimension | None) -> Dimension | None:
    match node.operator:
        case "*":
            return None if left is None or right is None else left * right
        case "/":
            return None if left is None or right is None else left / right
        case "^":
            return _of_power(node, left, right)
        case "and" | "or":
            _plain(node.left, left, f'"{node.operator}"')
            _plain(node.right, right, f'"{node.operator}"')
            return DIMENSIONLESS
    common = _common(node, [(node.left, left), (node.right, right)])
    return common if node.operator in "+-" else DIMENSIONLESS


def _of_power(node: Binary, base: Dimension | None, exponent: Dimension | None) -> Dimension | None:
    _plain(node.right, exponent, f'the power in "{node}"')
    if base is None or base == DIMENSIONLESS:
        return base
    if names(node.right):
        raise SceneError(
            f'in "{node}": {node.left} is {base.phrase}, so its power must be a constant, not {node.right}'
        )
    value = evaluate(node.right, _no_leaf)
    power = exact_exponent(value) if math.isfinite(value) else None
    if power is None or not math.isclose(power, value, rel_tol=1e-12):
        raise SceneError(f'in "{node}": {node.left} is {base.phrase}, so its power must be a simple fraction')
    return base**power


def _no_leaf(leaf: Leaf) -> float:
    raise TypeError(f"{leaf} in a constant")


def _of_call(node: Call, given: list[Dimension | None]) -> Dimension | None:
    arguments = list(zip(node.arguments, given, strict=True))
    match node.function:
        case "abs":
            return given[0]
        case "sqrt":
            return None if given[0] is None else given[0] ** exact_exponent(0.5)
        case "min" | "max" | "norm":
            return _common(node, arguments)
        case "atan2":
            _common(node, arguments)
            return DIMENSIONLESS
        case "select":
            _plain(*arguments[0], node.function)
            return _common(node, arguments[1:])
    for argument, found in arguments:
        _plain(argument, found, node.function)
    return DIMENSIONLESS


def _common(node: Node, parts: Sequence[tuple[Node, Dimension | None]]) -> Dimension | None:
    """The one dimension that all parts have; SceneError naming the first two that differ."""
    first: tuple[Node, Dimension] | None = None
    for part, found in parts:
        if found is None:
            continue
        if first is None:
            first = (part, found)
        elif found != first[1]:
            raise SceneError(
                f'in "{node}": {first[0]} is {first[1].phrase}, {part} is {found.phrase}; they cannot be '
                + ("added" if isinstance(node, Binary) and node.operator in "+-" else "compared")
            )
    return first[1] if first else None


def _plain(part: Node, found: Dimension | None, what: str) -> None:
    """SceneError unless the part, which `what` takes, is dimensionless."""
    if found is not None and found != DIMENSIONLESS:
        wanted = _TAKES.get(what, "a plain number")
        raise SceneError(f"{what} takes {wanted}; {part} is {found.phrase}")


# ---- values ----------------------------------------------------------------------------------------------


def evaluate(node: Node, values: Callable[[Leaf], float]) -> float:
    """The SI value, as the kernel would compute it; not-a-number where the expression has none.

    `values` gives the SI value of a leaf.
    """
    match node:
        case Number():
            return node.value_si
        case Name() | Address():
            return values(node)
        case Unary() | Binary():
            operation = node.operator
        case Call():
            operation = node.function
        case _:
            raise TypeError(f"no node of an expression: {node!r}")
    return apply(operation, [evaluate(operand, values) for operand in _operands(node)])


# ---- code ------------------------------------------------------------------------------------------------


class ConstantPool:
    """The constants of all programs of a scene, each kept once."""

    def __init__(self) -> None:
        self.values: list[float] = []
        self._index: dict[bytes, int] = {}

    def index(self, value: float) -> int:
        """The index of `value`, which is added if it is new; equal means the same bits."""
        key = struct.pack("<d", value)
        if key not in self._index:
            self._index[key] = len(self.values)
            self.values.append(value)
        return self._index[key]


def emit(
    node: Node,
    resolve_op: Callable[[Leaf], Instruction | list[Instruction]],
    pool: ConstantPool,
) -> list[Instruction]:
    """Postfix code (op, arg) of the expression, constants folded.

    `resolve_op` gives the instruction (or several, which push one number) of a leaf.  Raises SceneError if
    the code needs a deeper stack than the kernel has.
    """

    def push(part: float | list[Instruction]) -> list[Instruction]:
        return part if isinstance(part, list) else [(layout.PM_OP_CONSTANT, pool.index(part))]

    def compile_(part: Node) -> float | list[Instruction]:
        """A number if the part is constant, else its code."""
        if isinstance(part, Number):
            return float(part.value_si)
        if isinstance(part, Name | Address):
            found = resolve_op(part)
            return found if isinstance(found, list) else [found]
        operands = [compile_(operand) for operand in _operands(part)]
        constants = [operand for operand in operands if isinstance(operand, float)]
        if len(constants) == len(operands):
            return apply(part.function if isinstance(part, Call) else _operator(part), constants)
        code = push(operands[0])
        # min and max of several arguments are taken in turn; all others take their operands at once.
        operation = (_code(part), 0)
        folds = isinstance(part, Call) and part.function in ("min", "max")
        for operand in operands[1:]:
            code = code + push(operand) + ([operation] if folds else [])
        return code if folds else [*code, operation]

    code = push(compile_(node))
    depth = stack_depth(code)
    if depth > layout.PM_STACK:
        raise SceneError(
            f"the expression needs {depth} intermediate numbers at once, "
            f"at most {layout.PM_STACK} are possible; split it into parameters"
        )
    return code


def stack_depth(code: Sequence[Instruction]) -> int:
    """The greatest number of entries that the code has on the kernel's stack."""
    depth = greatest = 0
    for operation, _ in code:
        depth += 1 - _OPERANDS.get(operation, 0)
        greatest = max(greatest, depth)
    return greatest


def _operator(node: Node) -> str:
    assert isinstance(node, Unary | Binary)
    return node.operator


def _code(node: Node) -> int:
    match node:
        case Unary():
            return _SIGN_CODES[node.operator]
        case Binary():
            return _OPERATOR_CODES[node.operator]
        case Call():
            return _FUNCTION_CODES[node.function]
    raise TypeError(f"no operation: {node!r}")
