"""Curves as marks: (x(s), y(s)) by expressions, by name or by points, in the axes of their owner.

Named curves and those by points become expressions of s as well, so that there is one kind of curve behind
all words.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..base.errors import SceneError
from ..language.dimensions import DIMENSIONLESS, LENGTH, Dimension
from ..language.homogeneity import dimension
from ..language.leaves import Leaf, names, operands, substitute
from ..language.lookup import Lookup, Piecewise
from ..language.parser import parse
from ..language.tree import ZERO, Binary, Call, Name, Node, Number, Unary, cos, sin
from ..model.curve import CURVES, Curve
from ..model.readers import Value
from .parameters import Reader
from .spline import spline

Pair = tuple[Node, Node]

# The parameter along a curve, as written and in a mark: a parameter of the scene may be called s.
_WRITTEN = Name("s")
PLACE = Name("s along the curve")
_ROUND = Number(6.283185307179586)
# What has a corner or a jump where its operands change sides.
_CORNERS = ("abs", "min", "max", "floor", "sign", "select")
_COMPARISONS = ("=", "!=", "<", "<=", ">", ">=", "and", "or")


_A_CURVE = f"a curve is {{ x, y, from, to }}, {{ points }}, {{ file }}, or one of {', '.join(CURVES)}"
_FIELDS = {"from": "start"}


@dataclass(frozen=True)
class CurveMark:
    """The places (x, y) of `PLACE` between two bounds; `side` 1: the free side is on the left as s grows.

    `endless`: a straight line, that goes on beyond both.
    """

    x: Node
    y: Node
    bounds: Pair
    closed: bool
    side: int
    knots: Piecewise | None = None  # of a curve by points: its third derivative jumps there
    endless: bool = False

    def at(self, s: Node) -> Pair:
        """The place at one s."""

        def put(leaf: Leaf) -> Node:
            return s if leaf == PLACE else leaf

        return substitute(self.x, put), substitute(self.y, put)


def curve_mark(reader: Reader, curve: Curve, where: str) -> CurveMark:
    """The mark that a table says.  Raises SceneError for a table that says no curve, or two."""
    given = [word for word in CURVES if getattr(curve, word) is not None]
    knots = None
    if curve.places is not None:
        x, y, bounds, closed, knots = _through(reader, curve, where)
    elif not given and curve.x is not None and curve.y is not None:
        x, y, bounds, closed = _written(reader, curve, where)
    elif len(given) == 1 and curve.x is None and curve.y is None:
        x, y, bounds, closed = _NAMED[given[0]](reader, curve, where)
    else:
        raise SceneError(_A_CURVE, path=where)
    if curve.places is None and "scale" in curve.model_fields_set:
        raise SceneError("a scale is that of a curve by points; it has none", path=f"{where}.scale")
    place = reader.vector(curve.at, f"{where}.at", LENGTH)
    turn = reader.number(curve.angle, f"{where}.angle", DIMENSIONLESS)
    c, s = cos(turn), sin(turn)
    return CurveMark(
        place[0] + (c * x - s * y),
        place[1] + (s * x + c * y),
        bounds,
        closed,
        1 if curve.side == "left" else -1,
        knots,
    )


_Read = tuple[Node, Node, Pair, bool]


def _through(reader: Reader, curve: Curve, where: str) -> tuple[Node, Node, Pair, bool, Piecewise]:
    """A spline through points, whose s is the length of the chords between them."""
    assert curve.places is not None
    words = (*CURVES, "x", "y", "from", "to")
    others = [word for word in words if getattr(curve, _FIELDS.get(word, word)) is not None]
    if others:
        raise SceneError(f"a curve by points has no {others[0]}; {_A_CURVE}", path=f"{where}.{others[0]}")
    scale = reader.number(curve.scale, f"{where}.scale", DIMENSIONLESS)
    x, y = spline(curve.places, curve.closed, where)
    bounds = (Number(x.knots[0], LENGTH), Number(x.knots[-1], LENGTH))
    return scale * Lookup(x, (PLACE,)), scale * Lookup(y, (PLACE,)), bounds, curve.closed, x


def _written(reader: Reader, curve: Curve, where: str) -> _Read:
    """Two expressions of s, whose dimension is that of its bounds."""
    if "s" in reader.parameters.nodes:
        raise SceneError("in a curve s runs along it; call the parameter s otherwise", path="parameters.s")
    bounds, of_s = _bounds(reader, curve, where)
    assert curve.x is not None
    assert curve.y is not None

    def resolve(leaf: Leaf) -> Dimension | None:
        return of_s if leaf == _WRITTEN else reader.parameters.dimension_of(leaf)

    parts = []
    for key, written in (("x", curve.x), ("y", curve.y)):
        node = reader.number_of(written, f"{where}.{key}", LENGTH, resolve)
        corner = _corner(node)
        if corner:
            raise SceneError(
                f"a curve is smooth, and {corner} has a corner; write its parts as curves of their own",
                path=f"{where}.{key}",
                value=written,
            )
        parts.append(substitute(node, lambda leaf: PLACE if leaf == _WRITTEN else leaf))
    return parts[0], parts[1], bounds, curve.closed


def _corner(node: Node) -> str:
    """A function of s in the expression that is not smooth; "" if there is none."""
    reads = _WRITTEN in names(node)
    if reads and isinstance(node, Call) and node.function in _CORNERS:
        return node.function
    if reads and isinstance(node, Lookup):
        return f"the table {node.table.name}"
    if reads and isinstance(node, Binary) and node.operator in _COMPARISONS:
        return f'"{node.operator}"'
    if reads and isinstance(node, Unary) and node.operator == "not":
        return '"not"'
    return next(filter(None, map(_corner, operands(node))), "")


def _bounds(reader: Reader, curve: Curve, where: str) -> tuple[Pair, Dimension | None]:
    """Where s begins and ends, and its dimension."""
    ends: list[Node] = []
    found: Dimension | None = None
    for key, written in (("from", curve.start), ("to", curve.to)):
        if written is None:
            raise SceneError("where s begins and ends is wanted: from and to", path=f"{where}.{key}")
        node = _parameter(reader, written, f"{where}.{key}")
        of_node = dimension(node, reader.parameters.dimension_of)
        if found is not None and of_node is not None and of_node != found:
            reason = f"from is {found.phrase}, and to is {of_node.phrase}"
            raise SceneError(reason, path=f"{where}.{key}", value=written)
        found = found if of_node is None else of_node
        ends.append(node)
    return (ends[0], ends[1]), found


def _parameter(reader: Reader, written: Value, where: str) -> Node:
    node = parse(written, where=where)
    try:
        dimension(node, reader.parameters.dimension_of)
    except SceneError as error:
        raise error.at(path=where, value=written) from None
    return node


# ---- curves by name ----


def _interval(
    reader: Reader, curve: Curve, where: str, wanted: Dimension, usual: Pair | None
) -> tuple[Pair, bool]:
    """The bounds of s, and whether they are the usual ones."""
    if usual is not None and curve.start is None and curve.to is None:
        return usual, True
    if curve.start is None or curve.to is None:
        key = "from" if curve.start is None else "to"
        raise SceneError("where s begins and ends is wanted: from and to", path=f"{where}.{key}")
    first = reader.number(curve.start, f"{where}.from", wanted)
    return (first, reader.number(curve.to, f"{where}.to", wanted)), False


def _size(reader: Reader, curve: Curve, where: str, word: str) -> Node:
    return reader.number(getattr(curve, word), f"{where}.{word}", LENGTH)


def _ellipse(reader: Reader, curve: Curve, where: str) -> _Read:
    assert curve.ellipse is not None
    a, b = reader.vector(curve.ellipse, f"{where}.ellipse", LENGTH)
    bounds, whole = _interval(reader, curve, where, DIMENSIONLESS, (ZERO, _ROUND))
    return a * cos(PLACE), b * sin(PLACE), bounds, whole or curve.closed


def _arc(reader: Reader, curve: Curve, where: str) -> _Read:
    radius = _size(reader, curve, where, "arc")
    bounds, _ = _interval(reader, curve, where, DIMENSIONLESS, None)
    return radius * cos(PLACE), radius * sin(PLACE), bounds, curve.closed


def _parabola(reader: Reader, curve: Curve, where: str) -> _Read:
    focal = _size(reader, curve, where, "parabola")
    bounds, _ = _interval(reader, curve, where, LENGTH, None)
    return PLACE, PLACE * PLACE / (4 * focal), bounds, False


def _cycloid(reader: Reader, curve: Curve, where: str) -> _Read:
    radius = _size(reader, curve, where, "cycloid")
    bounds, _ = _interval(reader, curve, where, DIMENSIONLESS, None)
    return radius * (PLACE - sin(PLACE)), radius * (1 - cos(PLACE)), bounds, False


def _involute(reader: Reader, curve: Curve, where: str) -> _Read:
    radius = _size(reader, curve, where, "involute")
    bounds, _ = _interval(reader, curve, where, DIMENSIONLESS, None)
    x = radius * (cos(PLACE) + PLACE * sin(PLACE))
    return x, radius * (sin(PLACE) - PLACE * cos(PLACE)), bounds, False


_NAMED: dict[str, Callable[[Reader, Curve, str], _Read]] = {
    "ellipse": _ellipse,
    "arc": _arc,
    "parabola": _parabola,
    "cycloid": _cycloid,
    "involute": _involute,
}
