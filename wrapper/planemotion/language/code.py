"""Expressions compiled to the kernel's postfix code."""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from typing import TypeAlias

from .. import _layout as layout
from ..base.errors import SceneError
from .address import Address
from .arithmetic import apply
from .leaves import Leaf, operands
from .lookup import Lookup, Piecewise
from .tree import FUNCTIONS, Binary, Call, Name, Node, Number, Unary

Instruction: TypeAlias = tuple[int, int]
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
    "tanh": layout.PM_OP_TANH,
    "norm": layout.PM_OP_HYPOT,
    "floor": layout.PM_OP_FLOOR,
    "select": layout.PM_OP_SELECT,
}
_READ_CODES: dict[str, int] = {
    "value": layout.PM_OP_PIECEWISE,
    "piece": layout.PM_OP_PIECE,
    "knot": layout.PM_OP_KNOT,
}
# How many numbers an operation takes off the stack; operations that are not here push one.
_OPERANDS: dict[int, int] = {
    **dict.fromkeys(_OPERATOR_CODES.values(), 2),
    **dict.fromkeys(_SIGN_CODES.values(), 1),
    **{code: FUNCTIONS[name][0] for name, code in _FUNCTION_CODES.items()},
    layout.PM_OP_PIECEWISE: 1,
    layout.PM_OP_PIECE: 2,
    layout.PM_OP_KNOT: 1,
}


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

    def block(self, values: Sequence[float]) -> int:
        """The index of the first of these, which stand one behind the other."""
        self.values.extend(values)
        return len(self.values) - len(values)


def emit(
    node: Node,
    resolve_op: Callable[[Leaf], Instruction | list[Instruction]],
    pool: ConstantPool,
    row_of: Callable[[Piecewise], int] | None = None,
) -> list[Instruction]:
    """Postfix code (op, arg) of the expression, constants folded.

    `resolve_op` gives the instruction (or several, which push one number) of a leaf, `row_of` the row of a
    table that is read.  Raises SceneError if the code needs a deeper stack than the kernel has.
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
        parts = [compile_(operand) for operand in operands(part)]
        constants = [operand for operand in parts if isinstance(operand, float)]
        if isinstance(part, Lookup):
            if part.read == "value" and len(constants) == len(parts):
                return part.value_of(constants)
            assert row_of is not None
            code = [instruction for operand in parts for instruction in push(operand)]
            return [*code, (_READ_CODES[part.read], row_of(part.table))]
        if len(constants) == len(parts):
            return apply(part.function if isinstance(part, Call) else _operator(part), constants)
        code = push(parts[0])
        # min and max of several arguments are taken in turn; all others take their operands at once.
        operation = (_code(part), 0)
        folds = isinstance(part, Call) and part.function in ("min", "max")
        for operand in parts[1:]:
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
