"""The kernel's programs run in Python: for values without measures, one case at a time.

The arithmetic is that of the kernel, bit for bit (tree.apply), so that a picture or a message shows the
numbers that a run uses.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .. import _layout as layout
from ..base.arrays import Floats
from ..compile.flatten import FlatScene
from ..language.arithmetic import apply
from ..language.tree import FUNCTIONS

# Operations whose name in tree.py is not that of the code in small letters.
_SYMBOLS = {
    "ADD": "+",
    "SUB": "-",
    "MUL": "*",
    "DIV": "/",
    "POW": "^",
    "NEG": "-",
    "HYPOT": "norm",
    "LT": "<",
    "LE": "<=",
    "GT": ">",
    "GE": ">=",
    "EQ": "=",
    "NE": "!=",
}
_PUSHES = ("PM_OP_CONSTANT", "PM_OP_PARAMETER", "PM_OP_VALUE", "PM_OP_MEASURE", "PM_OP_ANSWER")


def _operations() -> dict[int, tuple[str, int]]:
    """Code of an operation -> its name in tree.py and how many numbers it takes."""
    found: dict[int, tuple[str, int]] = {}
    for word, code in layout.pm_op.items():
        if word in _PUSHES or word == "PM_OPS":
            continue
        short = word.removeprefix("PM_OP_")
        name = _SYMBOLS.get(short, short.lower())
        operands = FUNCTIONS[name][0] if name in FUNCTIONS else 1 if short in ("NEG", "NOT") else 2
        found[code] = (name, operands)
    return found


_OPERATIONS = _operations()


def value_table(flat: FlatScene, param: Floats) -> Floats:
    """All values [values] of a case, SI; `param` [parameters]: in SI, in the order of `flat.parameters`."""
    rows = flat.rows(layout.PM_TABLE_VALUE)
    values = np.full(len(rows), np.nan)
    for index, program in enumerate(rows[:, layout.PM_VALUE_PROGRAM]):
        values[index] = run_program(flat, int(program), param, values)
    return values


def run_program(
    flat: FlatScene,
    program: int,
    param: Floats,
    values: Floats,
    measure: Callable[[int], float] | None = None,
) -> float:
    """The number of one program, SI, from `param` [parameters] and `values` [values], both in SI.

    `measure` gives what a measure reads; None: a program of values, which has none.
    """
    first, length = flat.rows(layout.PM_TABLE_PROGRAM)[program]
    code = flat.rows(layout.PM_TABLE_CODE)[first : first + length]
    stack: list[float] = []
    for op, arg in code.tolist():
        if op == layout.PM_OP_CONSTANT:
            stack.append(float(flat.constant[arg]))
        elif op == layout.PM_OP_PARAMETER:
            stack.append(float(param[arg]))
        elif op == layout.PM_OP_VALUE:
            stack.append(float(values[arg]))
        elif op == layout.PM_OP_MEASURE:
            if measure is None:
                raise ValueError("a program with measures needs a state")
            stack.append(measure(arg))
        else:
            name, operands = _OPERATIONS[op]
            taken = stack[len(stack) - operands :]
            del stack[len(stack) - operands :]
            stack.append(apply(name, taken))
    return stack[0]
