"""Pairs of marks that touch: which the kernel has first; curves that touch or roll on each other.

An edge is a straight curve that ends, a line one without ends.
"""

from __future__ import annotations

from ..base.errors import SceneError
from ..language.dimensions import LENGTH
from ..language.tree import Number, cos, sin
from .curves import PLACE, CurveMark
from .drawn_rows import DrawnRows
from .marks import LineMark
from .partners import Partner

# Two places of a line, from the point that it goes through: they tell where it is.
_OF_A_LINE = (Number(-1.0, LENGTH), Number(1.0, LENGTH))


def is_pair(a: Partner, b: Partner) -> bool:
    """Whether both are curves, or one of them and the other an edge."""
    return sorted((a.kind, b.kind)) in (["curve", "curve"], ["curve", "line"])


def is_swapped(a: Partner, b: Partner) -> bool:
    """Whether the kernel has two marks that touch the other way round."""
    if is_pair(a, b):
        return _first_of_curves(b, a)
    return a.kind in ("line", "curve", "row") or b.kind == "set"


def _first_of_curves(a: Partner, b: Partner) -> bool:
    """Whether the kernel must have `a` first: of its ends it knows, and of its knots it does not."""
    return _rank(a) > _rank(b)


def _rank(one: Partner) -> int:
    if isinstance(one.mark, LineMark):
        return 3
    assert isinstance(one.mark, CurveMark)
    return 0 if one.mark.knots is not None else 1 if one.mark.closed else 2


def kernel_curve(drawn: DrawnRows, one: Partner, whole: bool = False) -> int:
    """The kernel curve of a curve, an edge or a line; `whole`: it must have no knots.

    Raises SceneError for knots.
    """
    mark = as_curve(one)
    if whole and mark.knots is not None:
        reason = "of two curves that touch one goes through points at most; write this one by expressions"
        raise SceneError(reason, path=one.where, value=f"{one.owner}.{one.name}")
    return drawn.curve(one.owner, mark, one.mark_path)


def as_curve(one: Partner) -> CurveMark:
    """The mark of a curve, or of an edge or a line as a straight curve."""
    if isinstance(one.mark, CurveMark):
        return one.mark
    assert isinstance(one.mark, LineMark)
    line = one.mark
    x, y = line.through
    along = x + PLACE * cos(line.angle), y + PLACE * sin(line.angle)
    if line.extent is None:
        return CurveMark(*along, _OF_A_LINE, closed=False, side=1, endless=True)
    return CurveMark(*along, line.extent, closed=False, side=1)
