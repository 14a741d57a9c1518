"""Parameters of a scene: their order, dimensions and default values, and the reading of written numbers.

A parameter whose value is a constant, or that a sweep varies, is *independent*: a column of the kernel's
parameter array.  One whose value is an expression of others is *dependent*: a value program, so that it
follows them in every case.  Overriding a dependent parameter makes it independent.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from functools import lru_cache
from numbers import Real

from ..base.errors import SceneError
from ..language.address import Address
from ..language.dimensions import DIMENSIONLESS, Dimension
from ..language.homogeneity import dimension, require
from ..language.leaves import Leaf, evaluate, names
from ..language.lookup import NO_TABLES, Book
from ..language.parser import parse
from ..language.tree import Name, Node, Number, cos, sin
from ..language.units import NUMBER, Quantity, factor, parse_quantity
from ..model.readers import Value, Vector
from ..model.words import unknown

# Parameters of a circle that a message names.
_SHOWN_OF_CIRCLE = 12


class Parameters:
    """The parameters of one run.

    Attributes: `nodes` (expression of each), `order` (all names, each after those it needs), `independent`
    (names, in the order of the file), `dimensions` (None: fits any), `units` (text as in the file),
    `defaults` (SI), `decided` (independent ones by whose default something was decided or checked, which a
    table does not say: with another value it is to be looked at anew), `tables` (what expressions may read).
    """

    def __init__(
        self, declared: Mapping[str, Value], swept: Collection[str] = (), tables: Book = NO_TABLES
    ) -> None:
        self.tables = tables
        self.nodes = {name: self.parse(value, f"parameters.{name}") for name, value in declared.items()}
        for name, node in self.nodes.items():
            for leaf in sorted(names(node), key=str):
                self._check_leaf(leaf, f"parameters.{name}", declared[name])
        self.order = self._sorted()
        self.decided: set[str] = set()
        self.independent = tuple(
            name for name, node in self.nodes.items() if name in swept or not names(node)
        )
        self.dimensions: dict[str, Dimension | None] = {}
        self.defaults: dict[str, float] = {}
        for name in self.order:
            try:
                self.dimensions[name] = dimension(self.nodes[name], self.dimension_of)
            except SceneError as error:
                raise error.at(path=f"parameters.{name}", value=declared[name]) from None
            self.defaults[name] = evaluate(self.nodes[name], lambda leaf: self.defaults[str(leaf)])
        self.units = {name: self._unit(name, value) for name, value in declared.items()}

    def parse(self, written: object, where: str | None = None) -> Node:
        """An expression that may read the scene's tables.  Raises SceneError with the key path `where`."""
        return parse(written, where=where, tables=self.tables)

    def find(self, found: Mapping[str, float]) -> None:
        """Other defaults (SI) for some independent ones, and for what depends on them."""
        for name in self.order if found else ():
            self.defaults[name] = (
                found[name]
                if name in found
                else evaluate(self.nodes[name], lambda leaf: self.defaults[str(leaf)])
            )

    def dimension_of(self, leaf: Leaf) -> Dimension | None:
        """The dimension of a parameter in an expression.  Raises SceneError for anything else."""
        self._check_leaf(leaf, None, None)
        return self.dimensions[str(leaf)]

    def _check_leaf(self, leaf: Leaf, path: str | None, value: object) -> None:
        if isinstance(leaf, Address):
            raise SceneError(
                f'"{leaf}" is a measure of the motion; only parameters can stand here', path=path, value=value
            )
        if leaf.text not in self.nodes:
            raise SceneError(unknown(str(leaf), self.nodes, "parameter"), path=path, value=value)

    def _sorted(self) -> tuple[str, ...]:
        """Each name after those that its expression needs; SceneError naming a circle."""
        order: dict[str, None] = {}
        for first in self.nodes:
            # Without recursion: a chain may be as long as the scene.
            # Each name on the way with what it needs and has not yet.
            path: dict[str, list[str]] = {}
            following = [first]
            while following or path:
                if not following:
                    name, _ = path.popitem()
                    order[name] = None
                elif (name := following.pop()) in path:
                    circle = list(path)[list(path).index(name) :]
                    raise SceneError(_circle([*circle, name]), path=f"parameters.{name}")
                elif name not in order:
                    path[name] = sorted(map(str, names(self.nodes[name])), reverse=True)
                following = next(reversed(path.values()), [])
        return tuple(order)

    def _unit(self, name: str, declared: Value) -> str:
        """The unit that a bare number for this parameter has."""
        unit = _literal_unit(declared)
        if unit:
            return unit
        found = self.dimensions[name]
        return found.unit if found is not None else ""


def _circle(names_on_it: list[str]) -> str:
    shown = names_on_it
    if len(shown) > _SHOWN_OF_CIRCLE:
        shown = [*shown[: _SHOWN_OF_CIRCLE - 1], f"... {len(shown) - _SHOWN_OF_CIRCLE} more ...", shown[-1]]
    return f"parameters that need each other in a circle: {' -> '.join(shown)}"


def override(declared: Mapping[str, Value], name: str, value: Value, tables: Book = NO_TABLES) -> Value:
    """What to write for the parameter when `value` is given for it: a bare number gets the declared unit.

    Raises SceneError for an unknown parameter, another dimension than declared, or a bare number where the
    file gives an expression of a dimension.
    """
    path = f"parameters.{name}"
    if name not in declared:
        raise SceneError(unknown(name, declared, "parameter"), path=path)
    parameters = Parameters(declared, tables=tables)
    wanted = parameters.dimensions[name]
    text = value.strip() if isinstance(value, str) else value
    if _is_bare(text) and text not in declared:
        if not math.isfinite(float(str(text))):
            raise SceneError("the number must be finite", path=path, value=value)
        unit = _literal_unit(declared[name])
        if unit:
            return f"{text if isinstance(text, str) else repr(text)} {unit}"
        if wanted not in (None, DIMENSIONLESS) and float(text) != 0:
            reason = f"a unit is wanted (such as {wanted.unit}); the file gives an expression, which has none"
            raise SceneError(reason, path=path, value=value)
    if wanted is not None:
        try:
            require(parameters.parse(text), wanted, parameters.dimension_of)
        except SceneError as error:
            raise error.at(path=path, value=value) from None
    return text


def like_declared(declared: Value, given: Value) -> float | None:
    """The value (SI) of what is given for a parameter, if it says nothing new but its size; else None.

    Both are quantities in one unit; a bare number has that of the file.  (A bare 0 has any dimension.)
    """
    if any(isinstance(one, bool) or not isinstance(one, str | Real) for one in (declared, given)):
        return None
    old = _literal(declared)
    if old is None:
        return None
    unit = old.unit_text
    if unit and isinstance(given, float) and math.isfinite(given):
        return given * factor(unit)[0]
    text = f"{given if isinstance(given, str) else repr(given)} {unit}" if unit and _is_bare(given) else given
    new = _literal(text)
    if new is None or new.unit_text != unit or (not unit and 0 in (old.value_si, new.value_si)):
        return None
    return new.value_si


@lru_cache(maxsize=1024, typed=True)
def _literal(written: Value) -> Quantity | None:
    """What is written as a quantity; None for an expression."""
    try:
        return parse_quantity(written)
    except SceneError:
        return None


def _literal_unit(written: Value) -> str:
    """The unit of a quantity; "" for a bare number or an expression."""
    quantity = _literal(written)
    return quantity.unit_text if quantity is not None else ""


def _is_bare(value: object) -> bool:
    """Whether it is a number without a unit."""
    if isinstance(value, bool):
        return False
    if isinstance(value, Real):
        return True
    try:
        float(str(value))
    except ValueError:
        return False
    return True


# A number with the name of what may be a parameter right behind it.
_TIMES_NAME = re.compile(rf"(?<![\w.])({NUMBER})\s?([^\W\d]\w*)")


class Reader:
    """Reads written numbers of a scene into expressions over its parameters, with their dimension checked."""

    def __init__(self, parameters: Parameters) -> None:
        self.parameters = parameters

    def number(self, written: Value, where: str, wanted: Dimension) -> Node:
        """An expression of that dimension; the `~` of a guess is left out."""
        return self.number_of(written, where, wanted, self.parameters.dimension_of)

    def number_of(
        self,
        written: Value,
        where: str,
        wanted: Dimension,
        resolve: Callable[[Leaf], Dimension | None],
    ) -> Node:
        """The same with other leaves than parameters, whose dimensions `resolve` gives."""
        text = written.strip().removeprefix("~") if isinstance(written, str) else written
        try:
            node = self.parameters.parse(text, where)
            require(node, wanted, resolve)
        except SceneError as error:
            reason = error.reason + self._product_hint(text)
            raise SceneError(reason).at(path=where, value=written) from None
        return node

    def _product_hint(self, text: object) -> str:
        """For "2L", which is two litres: how the product with a parameter is written."""
        for number, name in _TIMES_NAME.findall(text) if isinstance(text, str) else ():
            if name in self.parameters.nodes:
                return f'; "{number}{name}" has {name} as its unit: a product is written {number}*{name}'
        return ""

    def vector(
        self,
        written: Vector,
        where: str,
        wanted: Dimension,
        read: Callable[[Value, str, Dimension], Node] | None = None,
    ) -> tuple[Node, Node]:
        """The two components of a vector, polar ones resolved; `read` (default `number`) reads each."""
        read = read or self.number
        if not written.polar:
            return read(written.first, f"{where}[0]", wanted), read(written.second, f"{where}[1]", wanted)
        size = read(written.first, f"{where}.polar[0]", wanted)
        angle = read(written.second, f"{where}.polar[1]", DIMENSIONLESS)
        return size * cos(angle), size * sin(angle)

    def constant(self, written: Value, where: str, wanted: Dimension) -> float:
        """The value at the defaults of the parameters, SI."""
        return self.default(self.number(written, where, wanted))

    def default(self, node: Node) -> float:
        """The value of an expression of parameters at their defaults, SI, for a decision."""
        self.parameters.decided |= self.depends_on(node)
        return evaluate(node, lambda leaf: self.parameters.defaults[str(leaf)])

    def depends_on(self, node: Node) -> set[str]:
        """The independent parameters that an expression depends on, directly or through others."""
        found: set[str] = set()
        waiting, seen = names(node), set(names(node))
        while waiting:
            leaf = waiting.pop()
            assert isinstance(leaf, Name)
            if leaf.text in self.parameters.independent:
                found.add(leaf.text)
            else:
                further = names(self.parameters.nodes[leaf.text]) - seen
                waiting |= further
                seen |= further
        return found


def is_guess(written: object) -> bool:
    """Whether a start value is marked as one that the assembly may change."""
    return isinstance(written, str) and written.lstrip().startswith("~")


def is_zero(node: Node) -> bool:
    """Whether it is the number 0 and no expression."""
    return isinstance(node, Number) and node.value_si == 0
