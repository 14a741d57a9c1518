"""The partners of joints, contacts and forces: from the text "BODY.MARK" to the mark that is meant."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from ..base.errors import SceneError
from ..language.tree import ZERO, Node, binary, call, select
from ..model.words import GROUND
from .curves import CurveMark
from .drawing import Drawing, PointRef
from .drawn_rows import DrawnRows
from .marks import CircleMark, LineMark, Pair, RowMark, distance

# Part of the radius from which on a point counts as drawn on a circle.
_ON_CIRCLE = 1 - 1e-6
# What may stand for what: the groups of marks of an owner, in the order in which they are searched.
_GROUPS = {
    "point": "points",
    "line": "lines",
    "circle": "circles",
    "curve": "curves",
    "row": "rows",
    "set": "sets",
}
# What may touch, in the order in which a name is searched.
_TOUCHES = ("circle", "point", "line", "curve", "row", "set")


@dataclass(frozen=True)
class Partner:
    """A mark of a body or of the ground; `kind` is point, line, circle, curve, row or set.

    `mark` is a LineMark, CircleMark, CurveMark, RowMark or (set) a tuple of point names; None for points,
    whose `name` says it.  A bare "ground" is the point with the name "".
    """

    owner: str
    kind: str
    name: str
    where: str
    mark: LineMark | CircleMark | CurveMark | RowMark | tuple[str, ...] | None = None

    @property
    def ref(self) -> PointRef:
        return PointRef(self.owner, self.name)

    @property
    def is_ground(self) -> bool:
        return self.owner == GROUND

    @property
    def mark_path(self) -> str:
        """The key path of the mark itself."""
        owner = self.owner if self.is_ground else f"bodies.{self.owner}"
        return f"{owner}.{_GROUPS[self.kind]}.{self.name}"

    @property
    def anywhere(self) -> bool:
        """Whether it is the bare ground: the place where the other partner is drawn."""
        return self.is_ground and not self.name


def partner(drawing: Drawing, text: str, where: str, *wanted: str) -> Partner:
    """The mark that `text` names, one of the `wanted` kinds.  Raises SceneError with what there is."""
    try:
        return _partner(drawing, text, where, wanted)
    except SceneError as error:
        raise error.at(path=where, value=text) from None


def _partner(drawing: Drawing, text: str, where: str, wanted: tuple[str, ...]) -> Partner:
    owner, name = drawing.names.owner(text)
    marks = drawing.marks(owner)
    if not name:
        if "point" not in wanted:
            raise SceneError(f"{_a(wanted)} is wanted, such as {owner}.{_example(drawing, owner, wanted)}")
        return Partner(owner, "point", "" if owner == GROUND else "G", where)
    for kind in wanted:
        group = getattr(marks, _GROUPS[kind])
        if name in group:
            return Partner(owner, kind, name, where, None if kind == "point" else group[name])
    for kind, attribute in _GROUPS.items():
        if name in getattr(marks, attribute):
            raise SceneError(f"{text} is a {kind}; {_a(wanted)} is wanted")
    known = {mark: None for kind in wanted for mark in getattr(marks, _GROUPS[kind])}
    what = "mark" if set(wanted) == set(_TOUCHES) else " or ".join(wanted)
    raise SceneError(marks.has_no(what, name, known))


def touching(drawing: Drawing, texts: tuple[str, ...], path: str) -> tuple[Partner, Partner]:
    """The two marks of a contact; a body that is named alone touches with its shape."""
    first, second = pairs(texts, path, lambda text, where, _: partner(drawing, text, where, *_TOUCHES))
    return _with_shape(drawing, texts[0], first, second), _with_shape(drawing, texts[1], second, first)


def _with_shape(drawing: Drawing, text: str, one: Partner, other: Partner) -> Partner:
    """The rim of a round body that is named alone; before an endless line the corners or ends of another.

    What is beyond an endless line is all of a plate or rod, or nothing: no corner, nothing else either.
    """
    if one.is_ground or drawing.names.owner(text)[1] or drawing.bodies[one.owner].shape is None:
        return one
    marks = drawing.marks(one.owner)
    if "rim" in marks.circles and drawing.bodies[one.owner].shape != "half_ring":
        return replace(one, kind="circle", name="rim", mark=marks.circles["rim"])
    if marks.sets and isinstance(other.mark, LineMark) and other.mark.extent is None:
        ((name, points),) = marks.sets.items()
        return replace(one, kind="set", name=name, mark=points)
    sides = " or ".join(f"{one.owner}.{side}" for side in (*marks.lines, *marks.circles) if side != "axis")
    alone = "touches only an endless line" if marks.sets else "does not say what touches"
    raise SceneError(f"the body alone {alone}: did you mean {sides}?", path=one.where, value=text)


def _a(wanted: tuple[str, ...]) -> str:
    return "a " + " or ".join(wanted)


def _example(drawing: Drawing, owner: str, wanted: tuple[str, ...]) -> str:
    for kind in wanted:
        for name in getattr(drawing.marks(owner), _GROUPS[kind]):
            return str(name)
    return wanted[0].upper()


def different(a: Partner, b: Partner) -> None:
    """Raises SceneError if both partners belong to the same body."""
    if a.owner == b.owner:
        owner = "the ground" if a.owner == GROUND else f'body "{a.owner}"'
        raise SceneError(f"both partners belong to {owner}", path=a.where.rpartition("[")[0])


def point_pair(drawn: DrawnRows, a: Partner, b: Partner) -> tuple[int, int]:
    """Kernel points of two partners; the bare ground is a point where the other one is drawn."""
    return _point(drawn, a, b), _point(drawn, b, a)


def one_point(drawn: DrawnRows, at: Partner) -> int:
    """The kernel point of a partner; the bare ground is none."""
    if at.anywhere:
        raise SceneError("a point of a body or of the ground is wanted", path=at.where, value=GROUND)
    return drawn.point(at.ref)


def drawn_pair(drawing: Drawing, a: Partner, b: Partner) -> tuple[Pair, Pair]:
    """Where the points of two partners are drawn."""
    if a.anywhere:
        there = drawing.position(b.ref)
        return there, there
    here = drawing.position(a.ref)
    return here, here if b.anywhere else drawing.position(b.ref)


def _point(drawn: DrawnRows, mine: Partner, other: Partner) -> int:
    if mine.anywhere:
        return drawn.point_at(GROUND, drawn.drawing.position(other.ref), mine.where)
    return drawn.point(mine.ref)


def circle_place(drawing: Drawing, at: Partner) -> Pair:
    """Where the centre of a circle, or a point, is drawn."""
    if at.kind == "point":
        return drawing.position(at.ref)
    assert isinstance(at.mark, CircleMark)
    return drawing.to_scene(at.owner, drawing.from_mass_center(at.owner, at.mark.center))


def kernel_circle(drawn: DrawnRows, at: Partner) -> int:
    """The kernel circle of a circle; of a point: with radius 0."""
    if at.kind == "point":
        return drawn.circle_at(drawn.point(at.ref), ZERO, at.where)
    assert isinstance(at.mark, CircleMark)
    return drawn.circle(at.owner, at.mark, at.where)


def side(drawing: Drawing, a: Partner, b: Partner) -> Node:
    """1 if two circles are drawn outside each other, -1 if a is inside b, -2 if b is inside a.

    The distance of the centres tells: tangent circles have Ra + Rb outside and |Ra - Rb| inside, so that the
    greater radius lies in the middle of both.  A point is outside a circle that it is drawn on.
    """
    radius_a, radius_b = _radius(a), _radius(b)
    greater = call("max", radius_a, radius_b)
    if "point" in (a.kind, b.kind):
        greater = _ON_CIRCLE * greater
    apart = distance(circle_place(drawing, a), circle_place(drawing, b))
    inside = select(binary("<", radius_a, radius_b), -1.0, -2.0)
    return select(binary("<", apart, greater), inside, 1.0)


def _radius(one: Partner) -> Node:
    if one.kind == "point":
        return ZERO
    assert isinstance(one.mark, CircleMark)
    return one.mark.radius


def pairs(
    text: tuple[str, ...], path: str, read: Callable[[str, str, int], Partner]
) -> tuple[Partner, Partner]:
    """Both partners of an element, read with their key paths; they must belong to different bodies."""
    first, second = (read(one, f"{path}[{index}]", index) for index, one in enumerate(text))
    different(first, second)
    return first, second
