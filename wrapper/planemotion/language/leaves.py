"""Going through an expression: its leaves, other expressions in their place, its height and its value."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from .address import Address
from .arithmetic import apply
from .lookup import Lookup
from .tree import Binary, Call, Name, Node, Number, Unary, binary, call, negative

Leaf: TypeAlias = Name | Address


def operands(node: Node) -> tuple[Node, ...]:
    match node:
        case Unary():
            return (node.operand,)
        case Binary():
            return (node.left, node.right)
        case Call() | Lookup():
            return node.arguments
    return ()


def with_operands(node: Node, others: Sequence[Node]) -> Node:
    """The same operation on other operands."""
    match node:
        case Unary(operator="-"):
            return negative(others[0])
        case Unary():
            return Unary(node.operator, others[0])
        case Binary():
            return binary(node.operator, others[0], others[1])
        case Call():
            return call(node.function, *others)
        case Lookup():
            return Lookup(node.table, tuple(others), node.read)
    return node


def height(node: Node) -> int:
    """Operations on the longest way from the top to a leaf; without recursion, since it guards that."""
    height, level = 0, operands(node)
    while level:
        height += 1
        level = tuple(operand for parent in level for operand in operands(parent))
    return height


def _leaves(node: Node) -> Iterator[Leaf]:
    if isinstance(node, Name | Address):
        yield node
    for operand in operands(node):
        yield from _leaves(operand)


def names(node: Node) -> set[Leaf]:
    """The leaves that are not numbers.  (A set: sort by `str` where an order matters.)"""
    return set(_leaves(node))


def substitute(node: Node, leaf: Callable[[Leaf], Node]) -> Node:
    """The expression with every name and address replaced by what `leaf` gives for it."""
    if isinstance(node, Name | Address):
        return leaf(node)
    return with_operands(node, [substitute(one, leaf) for one in operands(node)])


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
        case Lookup():
            return node.value_of([evaluate(operand, values) for operand in node.arguments])
        case _:
            raise TypeError(f"no node of an expression: {node!r}")
    return apply(operation, [evaluate(operand, values) for operand in operands(node)])
