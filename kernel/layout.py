"""Writes the constants of planemotion.h as a Python module, so that C and Python cannot disagree.

    python layout.py planemotion.h _layout.py

Every enumeration becomes its constants and one dict from constant to value with the enumeration's name; every
macro PM_X that stands for an integer becomes a constant:

    #define PM_GROUND (-1)                         PM_GROUND = -1
    enum pm_side { PM_LEFT, PM_RIGHT = 3 };        PM_LEFT = 0
                                                   PM_RIGHT = 3
                                                   pm_side: dict[str, int] = {"PM_LEFT": 0, "PM_RIGHT": 3}

Enumerations keep their small letters: PM_JOINT_KIND is a column, pm_joint_kind the kinds that stand in it.

Headers beside it that it includes are read in their places.

A value may be an integer or integer arithmetic on constants above it. Macros with arguments and macros that
stand for anything else (a real number, an attribute) have no place in integer tables and are left out.
What looks like a constant and cannot be read is an error, not an omission.
"""

import ast
import operator
import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

BINARY: dict[type[ast.operator], Callable[[int, int], int]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
}
UNARY: dict[type[ast.unaryop], Callable[[int], int]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Invert: operator.invert,
}

INCLUDE = re.compile(r'^#include "(?P<name>\w+\.h)"$', re.MULTILINE)
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
ENUM = re.compile(r"\benum\b\s*(?P<tag>\w*)\s*\{(?P<body>[^}]*)\}")
MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(?P<macro>PM_\w+)(?P<value>[( \t][^\n]*|)$", re.MULTILINE)
ENTRY = re.compile(r"(?P<name>[A-Za-z_]\w*)\s*(?:=\s*(?P<value>.+))?", re.DOTALL)
INTEGER = re.compile(r"\b(0[xX][0-9a-fA-F]+|[0-9]+)[uUlL]*\b")
# Numbers, names of constants, operators: what an integer constant may consist of.
ARITHMETIC = re.compile(r"(?:\b(?:0[xX][0-9a-fA-F]+|[0-9]+)[uUlL]*\b|\bPM_\w+|[-+*&|^~()<>\s])+")


class LayoutError(ValueError):
    """The header holds a constant that this script cannot read."""


class Layout:
    """The constants of a header: `constant[name]`, and `enum[tag]`, the names of each enumeration."""

    def __init__(self) -> None:
        self.constant: dict[str, int] = {}
        self.enum: dict[str, list[str]] = {}


def whole(header: Path) -> str:
    """The text of a header, with the headers beside it that it includes in their places."""

    def beside(include: re.Match[str]) -> str:
        path = header.parent / include["name"]
        return whole(path) if path.exists() else include[0]

    return INCLUDE.sub(beside, header.read_text(encoding="utf-8"))


def read(header: str) -> Layout:
    """Reads the text of a header. Raises LayoutError, which names the constant or enumeration at fault."""
    text = COMMENT.sub(" ", header.replace("\\\n", " "))
    layout = Layout()
    # In the order of the file, because a value may use what stands above it.
    for found in sorted([*ENUM.finditer(text), *MACRO.finditer(text)], key=lambda match: match.start()):
        if found.re is ENUM:
            _read_enum(layout, found["tag"], found["body"])
        else:
            _read_macro(layout, found["macro"], found["value"])
    return layout


def _read_enum(layout: Layout, tag: str, body: str) -> None:
    if not re.fullmatch(r"pm_\w+", tag):
        raise LayoutError(f"enum {tag or '{...}'}: an enumeration needs a name that begins with pm_")
    if tag in layout.enum:
        raise LayoutError(f"enum {tag} is defined twice")
    entries = [entry.strip() for entry in body.split(",")]
    if entries[-1] == "":
        entries.pop()
    if not entries:
        raise LayoutError(f"enum {tag} is empty")
    names: list[str] = []
    following = 0
    for entry in entries:
        parts = ENTRY.fullmatch(entry)
        if not parts:
            raise LayoutError(f"enum {tag}: cannot read the entry {entry!r}")
        name, value = parts["name"], parts["value"]
        if not name.startswith("PM_"):
            raise LayoutError(f"enum {tag}: {name} does not begin with PM_")
        number = following if value is None else _evaluate(value, name, layout.constant)
        _add(layout, name, number)
        names.append(name)
        following = number + 1
    layout.enum[tag] = names


def _read_macro(layout: Layout, name: str, value: str) -> None:
    has_arguments = value.startswith("(")
    if has_arguments or not ARITHMETIC.fullmatch(value.strip()):
        return
    _add(layout, name, _evaluate(value, name, layout.constant))


def _add(layout: Layout, name: str, number: int) -> None:
    if name in layout.constant:
        raise LayoutError(f"{name} is defined twice")
    layout.constant[name] = number


def _evaluate(value: str, name: str, constant: Mapping[str, int]) -> int:
    """Integer arithmetic on literals and the constants above."""
    text = " ".join(value.split())
    problem = LayoutError(f"{name}: cannot read the value {text!r}")

    def number(node: ast.expr) -> int:
        match node:
            case ast.Constant(value=int(literal)):
                return literal
            case ast.Name(id=other) if other in constant:
                return constant[other]
            case ast.UnaryOp(op=op, operand=operand) if type(op) in UNARY:
                return UNARY[type(op)](number(operand))
            case ast.BinOp(left=left, op=op, right=right) if type(op) in BINARY:
                return BINARY[type(op)](number(left), number(right))
        raise problem

    try:  # a leading zero, octal in C, is a syntax error in Python and so never misread
        return number(ast.parse(INTEGER.sub(r"\1", text), mode="eval").body)
    except (SyntaxError, ValueError):
        raise problem from None


def write(layout: Layout, source: str) -> str:
    """The text of the Python module; `source` names the header in its docstring."""
    lines = [f'"""The constants of {source}. Written by layout.py: edit the header, not this file."""', ""]
    lines += [f"{name} = {number}" for name, number in layout.constant.items()]
    for tag, names in layout.enum.items():
        entries = [f'    "{name}": {name},' for name in names]
        lines += ["", f"{tag}: dict[str, int] = {{", *entries, "}"]
    return "\n".join(lines) + "\n"


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit("use: layout.py HEADER OUTPUT")
    header, output = map(Path, sys.argv[1:])
    try:
        module = write(read(whole(header)), header.name)
    except LayoutError as error:
        sys.exit(f"{header}: {error}")
    output.write_text(module, encoding="utf-8")


if __name__ == "__main__":
    main()
