"""The reader of expressions: from text to a tree.

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
from functools import lru_cache

from ..base.errors import SceneError, nearest
from .address import Scanner, read_address
from .leaves import height
from .lookup import NO_TABLES, Book
from .tree import (
    COMPARISON_RANK,
    RANK,
    WRITTEN_FUNCTIONS,
    ZERO,
    Binary,
    Call,
    Name,
    Node,
    Number,
    Unary,
    as_node,
    count_text,
)
from .units import NUMBER, UNIT, factor, is_unit, parse_quantity

# Longest expression in characters and deepest nesting: both far above what is written by hand and below what
# the recursion of the parser and of the functions here can take.
MAX_TEXT = 4000
MAX_NESTING = 60
MAX_HEIGHT = 200
_OPERATOR = r"<=|>=|!=|[-+*/^=<>]|(?:and|or)\b"
# A unit directly behind a number; "in" is one there, and "x > 0 and y > 0" has none.
_UNIT_HERE = rf"(?!(?:and|or|not)\b){UNIT}"


def parse(written: object, *, where: str | None = None, tables: Book = NO_TABLES) -> Node:
    """The expression written as a text, a number, true or false (1 or 0), or a quantity of pint.

    `where` is the key path for messages, `tables` what may be read besides functions.
    Raises SceneError with that path and the text as its value.
    """
    try:
        if isinstance(written, str):
            return _read(written, tables)
        if isinstance(written, bool):
            return Number(float(written))
        return as_node(parse_quantity(written))
    except SceneError as error:
        raise SceneError(error.reason, path=where, value=written) from None


@lru_cache(maxsize=1024)
def _read(text: str, tables: Book) -> Node:
    """Nodes are frozen: a text that is read again, as in every sweep of a scene, is the same one."""
    return _Parser(text, tables).parse()


def _sign(x: Node) -> Node:
    return Binary("-", Binary(">", x, ZERO), Binary("<", x, ZERO))


class _Parser:
    """Precedence climbing over a scanner."""

    def __init__(self, text: str, tables: Book) -> None:
        if len(text) > MAX_TEXT:
            raise SceneError(f"an expression of {len(text)} characters; at most {MAX_TEXT} are read")
        self.scanner = Scanner(text)
        self.tables = tables.tables
        self.names = tables.names
        self.nesting = 0
        # Quantities without parentheses, by identity: they must not meet an arithmetic operator.
        self.bare: list[Node] = []

    def parse(self) -> Node:
        node = self.expression(1)
        if not self.scanner.at_end():
            raise self.left_over()
        if height(node) > MAX_HEIGHT:
            raise SceneError(f"a chain of more than {MAX_HEIGHT} operations; split it into parameters")
        return node

    def left_over(self) -> SceneError:
        """The error of what stands behind a whole expression."""
        error = self.scanner.unexpected("an operator or the end")
        whole = self.scanner.text[: self.scanner.position].strip()
        hint = ""
        if self.scanner.take_keyword("at"):
            instant = self.scanner.text[self.scanner.position :] or "EVENT"
            hint = f'; an ask has its instant beside it: {{ of = "{whole}", at = "{instant}" }}'
        elif is_unit(self.scanner.peek(UNIT) or ""):
            joined = '; units are joined by * and /, such as "3 N*s/m"'
            hint = joined if self.bare else "; a unit stands only behind a number"
        return SceneError(error.reason + hint, value=error.value)

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
        joined = scanner.peek(r"(?:in|on|about|along)\b")
        if word in self.names and not joined:
            return Name(word)
        if "." in word or "[" in word or joined:
            return read_address(scanner, word, self.names)
        return Name(word)

    def number(self, number: str) -> Node:
        """A number with or without a unit behind it."""
        value = float(number)
        if not math.isfinite(value):
            raise SceneError(f"{number} is too large for a number")
        unit = self.scanner.take(_UNIT_HERE)
        if unit is None:
            return Number(value, wild=value == 0, text=number)
        if self.scanner.peek(r"\.") and "*" in unit:
            # What was meant as a product with an address has been read as a unit.
            own = unit.partition("*")[0].strip()
            raise SceneError(f"a number with a unit goes in parentheses: ({number} {own})*...")
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
        if word not in WRITTEN_FUNCTIONS and word not in self.tables:
            functions = (*WRITTEN_FUNCTIONS, *self.tables)
            guess = nearest(word, functions)
            known = f'did you mean "{guess}"?' if guess else f"there are {', '.join(functions)}"
            raise SceneError(f'unknown function "{word}" ({known})')
        self.scanner.take(r"\(")
        arguments = [self.expression(1)]
        while self.scanner.take(r","):
            arguments.append(self.expression(1))
        self.close()
        if word in self.tables:
            if len(arguments) != 1:
                raise SceneError(f"the table {word} is read at 1 argument, not {len(arguments)}")
            return self.tables[word].at(arguments[0])
        least, most = WRITTEN_FUNCTIONS[word]
        if len(arguments) < least or (most is not None and len(arguments) > most):
            raise SceneError(f"{word} takes {count_text(word)}, not {len(arguments)}")
        return _sign(arguments[0]) if word == "sign" else Call(word, tuple(arguments))

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
