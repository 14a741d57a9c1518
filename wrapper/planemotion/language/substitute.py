"""Replacing the leaves of an expression by other expressions."""

from __future__ import annotations

from collections.abc import Callable

from .address import Address
from .expression import Leaf
from .tree import Binary, Call, Name, Node, Number, Unary, binary, call, negative


def substitute(node: Node, leaf: Callable[[Leaf], Node]) -> Node:
    """The expression with every name and address replaced by what `leaf` gives for it."""
    match node:
        case Number():
            return node
        case Name() | Address():
            return leaf(node)
        case Unary(operator="-"):
            return negative(substitute(node.operand, leaf))
        case Unary():
            return Unary(node.operator, substitute(node.operand, leaf))
        case Binary():
            return binary(node.operator, substitute(node.left, leaf), substitute(node.right, leaf))
        case Call():
            return call(node.function, *(substitute(argument, leaf) for argument in node.arguments))
    raise TypeError(f"no node of an expression: {node!r}")
