"""Dimensional homogeneity: the dimension of an expression, and what cannot be added or compared."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from ..base.errors import SceneError
from .address import Address
from .dimensions import DIMENSIONLESS, Dimension, exact_exponent
from .leaves import Leaf, evaluate, names
from .lookup import Lookup
from .tree import Binary, Call, Name, Node, Number, Unary


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
            case Lookup():
                return _of_lookup(part, of(part.arguments[0]))
        raise TypeError(f"no node of an expression: {part!r}")

    return of(node)


def require(node: Node, wanted: Dimension, resolve: Callable[[Leaf], Dimension | None]) -> None:
    """Raises SceneError unless the expression has the wanted dimension (0 fits any)."""
    found = dimension(node, resolve)
    if found is not None and found != wanted:
        reason = f"{wanted.phrase}{_such_as(wanted)} is wanted; this is {found.phrase}"
        raise SceneError(reason + _with_unit(node, found, wanted))


def _such_as(wanted: Dimension) -> str:
    """The formula of a dimension and a unit as an example, in parentheses."""
    if wanted == DIMENSIONLESS:
        return ""
    formula = f"{wanted.formula}, " if wanted.formula != wanted.name else ""
    return f" ({formula}such as {wanted.unit})"


def _with_unit(node: Node, found: Dimension, wanted: Dimension) -> str:
    """How a bare number is written with a unit."""
    if not isinstance(node, Number) or found != DIMENSIONLESS or not wanted.unit:
        return ""
    return f'; give it a unit: "{node.value_si:g} {wanted.unit}"'


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


def _of_lookup(node: Lookup, found: Dimension | None) -> Dimension:
    wanted, argument = node.table.argument, node.arguments[0]
    if found is not None and found != wanted:
        raise SceneError(
            f"the table {node.table.name} is read at {wanted.phrase}; {argument} is {found.phrase}"
        )
    return node.table.value


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
