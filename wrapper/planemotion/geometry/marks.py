"""What a body or the ground is in its own axes: mass, inertia, points, lines, circles, curves; expressions.

A body's own axes have their origin at its geometric centre; a rod's x axis runs from its first end to its
second.  The ground's own axes are the scene's.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ..base.errors import SceneError
from ..language.dimensions import ACCELERATION, DIMENSIONLESS, FORCE, INERTIA, LENGTH, MASS
from ..language.tree import ZERO, Node, Number, atan2, norm
from ..model import words
from ..model.readers import Offset, Value, Vector
from ..model.tables import Body, Circle, Ground, Line, Row
from .curves import CurveMark, Pair, curve_mark
from .parameters import Reader

# Centroidal moment of inertia over mass*size^2: a rod by its length, the others by their radius.
_SHAPE_INERTIA = {
    "rod": 1 / 12,
    "disk": 1 / 2,
    "cylinder": 1 / 2,
    "hoop": 1.0,
    "sphere": 2 / 5,
    "half_ring": 1 - 4 / math.pi**2,
}
# The same of shapes that stand across the plane, about an axis at right angles to the plane.
_EDGE_ON_INERTIA = {"disk": 1 / 4, "hoop": 1 / 2}
# The points that every body has.
_EVERY_BODY = ("G", "center")
# The corners of a plate where the file gives them no names, counterclockwise.
_CORNERS = ("lower_left", "lower_right", "upper_right", "upper_left")
# Distance of a half ring's mass centre from the centre of its arc, over the radius.
_HALF_RING_CENTRE = 2 / math.pi


@dataclass(frozen=True)
class LineMark:
    """A line through a point (own axes) at an angle from the own x axis.

    `extent`: where it begins and ends, along it from that point; None if it is endless.
    """

    through: Pair
    angle: Node
    extent: Pair | None = None


@dataclass(frozen=True)
class CircleMark:
    center: Pair
    radius: Node


@dataclass(frozen=True)
class RowMark:
    """Points `start` + k `step`; count -1: endless."""

    start: Pair
    step: Pair
    count: Node


@dataclass
class Marks:
    """The marks of one body, or of the ground (name "ground")."""

    name: str
    path: str
    points: dict[str, Pair] = field(default_factory=dict)
    lines: dict[str, LineMark] = field(default_factory=dict)
    circles: dict[str, CircleMark] = field(default_factory=dict)
    rows: dict[str, RowMark] = field(default_factory=dict)
    curves: dict[str, CurveMark] = field(default_factory=dict)
    sets: dict[str, tuple[str, ...]] = field(default_factory=dict)
    # Corners to which the file gives no names: they are no part of a picture or history.
    unnamed: tuple[str, ...] = ()

    @property
    def names(self) -> Iterator[str]:
        """Of all marks."""
        groups = (self.points, self.lines, self.circles, self.rows, self.curves, self.sets)
        return (name for group in groups for name in group)

    def point(self, name: str) -> Pair:
        """A point by name.  Raises SceneError naming those that there are."""
        if name not in self.points:
            raise SceneError(self.has_no("point", name, self.points))
        return self.points[name]

    @property
    def named_points(self) -> list[str]:
        """The points that the file names."""
        return [name for name in self.points if name not in (*_EVERY_BODY, *self.unnamed)]

    def has_no(self, what: str, name: str, known: Mapping[str, object]) -> str:
        """The text that there is no such mark."""
        owner = "the ground" if self.name == words.GROUND else f'body "{self.name}"'
        last = (*_EVERY_BODY, *self.unnamed)
        all_marks = [mark for mark in known if mark not in last] + [mark for mark in last if mark in known]
        return f'{owner} has no {what} "{name}"; it has {", ".join(all_marks) or "none"}'


@dataclass(frozen=True)
class Mass:
    """Mass and centroidal moment of inertia; `known` is False if the mass was left out."""

    mass: Node
    inertia: Node
    known: bool


def ground_marks(reader: Reader, ground: Ground) -> Marks:
    """The marks of the ground, in scene coordinates."""
    marks = Marks(words.GROUND, words.GROUND)
    _add_written(reader, marks, ground)
    for name, row in ground.rows.items():
        marks.rows[name] = _row(reader, row, f"ground.rows.{name}")
    return marks


def body_marks(reader: Reader, name: str, body: Body, length: Node | None) -> Marks:
    """The marks of a body in its own axes; `length` is that of a rod."""
    path = f"bodies.{name}"
    marks = Marks(name, path)
    marks.points["center"] = (ZERO, ZERO)
    marks.points["G"] = mass_center(reader, name, body)
    if body.rod is not None:
        assert length is not None
        _add_rod(marks, body.rod, length)
    if body.plate is not None:
        _add_plate(marks, body.corners, reader.vector(body.plate, f"{path}.plate", LENGTH))
    if body.edge_on:
        _add_edge(marks, radius(reader, name, body))
    elif body.shape in words.ROUND_SHAPES:
        marks.circles["rim"] = CircleMark((ZERO, ZERO), radius(reader, name, body))
    if not body.rotates and (body.points or body.lines or body.circles or body.curves):
        raise SceneError(
            "a particle has no marks; give the body a shape, an inertia or a gyration", path=path
        )
    _add_written(reader, marks, body)
    return marks


def _add_written(reader: Reader, marks: Marks, owner: Ground | Body) -> None:
    """The marks that a body or the ground gives by name."""
    _add_points(reader, marks, owner.points)
    for name, line in owner.lines.items():
        marks.lines[name] = _line(reader, line, f"{marks.path}.lines.{name}")
    for name, circle in owner.circles.items():
        marks.circles[name] = _circle(reader, circle, f"{marks.path}.circles.{name}")
    for name, curve in owner.curves.items():
        marks.curves[name] = curve_mark(reader, curve, f"{marks.path}.curves.{name}")


def radius(reader: Reader, name: str, body: Body) -> Node:
    """The radius of a round shape."""
    assert body.shape is not None
    return reader.number(getattr(body, body.shape), f"bodies.{name}.{body.shape}", LENGTH)


def mass_center(reader: Reader, name: str, body: Body) -> Pair:
    """The mass centre from the geometric centre."""
    written = reader.vector(body.mass_center, f"bodies.{name}.mass_center", LENGTH)
    if body.shape == "half_ring" and "mass_center" not in body.model_fields_set:
        return radius(reader, name, body) * _HALF_RING_CENTRE, ZERO
    return written


def mass_of(reader: Reader, name: str, body: Body, length: Node | None) -> Mass:
    """Mass and inertia of a body, from its shape where they are not given."""
    path = f"bodies.{name}"
    if body.mass is not None and body.weight is not None:
        raise SceneError("give mass or weight, not both", path=path)
    if body.inertia is not None and body.gyration is not None:
        raise SceneError("give inertia or gyration, not both", path=path)
    mass = _mass(reader, path, body)
    if mass is None and body.inertia is None and body.driven is None:
        raise SceneError("mass or weight is wanted", path=f"{path}.mass")
    # Without a mass no force moves the mass centre (checked by the caller): any mass gives the same motion.
    known = mass is not None
    mass = mass if mass is not None else Number(1.0, MASS)
    if body.inertia is not None:
        inertia = reader.number(body.inertia, f"{path}.inertia", INERTIA)
    elif body.gyration is not None:
        gyration = reader.number(body.gyration, f"{path}.gyration", LENGTH)
        inertia = mass * gyration * gyration
    elif body.plate is not None:
        width, height = reader.vector(body.plate, f"{path}.plate", LENGTH)
        inertia = mass * (width * width + height * height) / 12
    elif body.shape is not None:
        size = length if length is not None else radius(reader, name, body)
        inertia = mass * size * size * (_EDGE_ON_INERTIA if body.edge_on else _SHAPE_INERTIA)[body.shape]
    else:
        inertia = ZERO
    return Mass(mass, inertia, known)


def _mass(reader: Reader, path: str, body: Body) -> Node | None:
    if body.mass is not None:
        try:
            return reader.number(body.mass, f"{path}.mass", MASS)
        except SceneError as error:
            hint = _force_for_mass(body.mass, error, "a mass in kg, slug or lbm")
            raise hint or error from None
    if body.weight is not None:
        try:
            weight = reader.number(body.weight, f"{path}.weight", FORCE)
        except SceneError as error:
            hint = _mass_for_weight(body.weight, error)
            raise hint or error from None
        gravity = reader.number("g", "parameters.g", ACCELERATION)
        return weight / gravity
    return None


def _force_for_mass(written: Value, error: SceneError, right: str) -> SceneError | None:
    if "this is a force" not in error.reason:
        return None
    unit = str(written).split()[-1]
    return SceneError(
        f'{unit} is a force; write weight = "{written}", or {right}', path=error.path, value=written
    )


def _mass_for_weight(written: Value, error: SceneError) -> SceneError | None:
    if "this is a mass" not in error.reason:
        return None
    unit = str(written).split()[-1]
    return SceneError(
        f'{unit} is a mass; write mass = "{written}", or a weight in N, lb or kip',
        path=error.path,
        value=written,
    )


def _add_rod(marks: Marks, ends: tuple[str, ...], length: Node) -> None:
    half = length / 2
    first, second = ends
    if first == second:
        raise SceneError("the two ends need two names", path=f"{marks.path}.rod")
    _check_mark_names(marks, ends, "rod")
    marks.points[first] = (-half, ZERO)
    marks.points[second] = (half, ZERO)
    marks.sets["ends"] = (first, second)
    marks.lines["axis"] = LineMark((ZERO, ZERO), ZERO)
    marks.lines["top"] = LineMark((ZERO, ZERO), ZERO, (-half, half))
    marks.lines["bottom"] = LineMark((ZERO, ZERO), Number(math.pi), (-half, half))


def _add_edge(marks: Marks, size: Node) -> None:
    """A disk that stands across the plane shows a diameter: its x axis."""
    marks.lines["axis"] = LineMark((ZERO, ZERO), ZERO)
    marks.lines["top"] = LineMark((ZERO, ZERO), ZERO, (-size, size))
    marks.lines["bottom"] = LineMark((ZERO, ZERO), Number(math.pi), (-size, size))


def _add_plate(marks: Marks, corners: tuple[str, ...] | None, size: Pair) -> None:
    x, y = size[0] / 2, size[1] / 2
    at = ((-x, -y), (x, -y), (x, y), (-x, y))
    if corners is None:
        marks.unnamed = _CORNERS
    else:
        _check_mark_names(marks, corners, "corners")
        if len(set(corners)) < len(corners):
            raise SceneError("the corners need four names", path=f"{marks.path}.corners")
    marks.sets["corners"] = corners or _CORNERS
    marks.points.update(zip(marks.sets["corners"], at, strict=True))
    # A line's free side is on its left; edges face outward: each ends at the corner it is given through.
    sides = ("bottom", "right", "top", "left")
    directions = (math.pi, -math.pi / 2, 0.0, math.pi / 2)
    lengths = (size[0], size[1], size[0], size[1])
    for side, end, direction, length in zip(sides, at, directions, lengths, strict=True):
        marks.lines[side] = LineMark(end, Number(direction), (-length, ZERO))


def _check_mark_names(marks: Marks, given: tuple[str, ...], key: str) -> None:
    quantities = (*words.BODY_QUANTITIES, *words.POINT_QUANTITIES, words.DRIVEN)
    for name in given:
        words.check_name(name, f"{marks.path}.{key}")
        if name in marks.points or name in quantities:
            raise SceneError(
                f'"{name}" has a meaning of its own; choose another name', path=f"{marks.path}.{key}"
            )


def _add_points(reader: Reader, marks: Marks, points: Mapping[str, Vector | Offset]) -> None:
    """Points by coordinates and from each other, in any order but not in a circle."""

    def add(name: str, path: tuple[str, ...]) -> None:
        where = f"{marks.path}.points.{name}"
        if name in path:
            circle = " -> ".join([*path, name])
            raise SceneError(f"points that are placed from each other in a circle: {circle}", path=where)
        written = points[name]
        if isinstance(written, Vector):
            marks.points[name] = reader.vector(written, where, LENGTH)
            return
        if written.start not in marks.points:
            if written.start not in points:
                known = {**marks.points, **points}
                raise SceneError(
                    marks.has_no("point", written.start, known), path=f"{where}.from", value=written.start
                )
            add(written.start, (*path, name))
        start = marks.points[written.start]
        by = reader.vector(written.by, f"{where}.by", LENGTH)
        marks.points[name] = (start[0] + by[0], start[1] + by[1])

    for name in points:
        if name in marks.points:
            raise SceneError("the body has this point already", path=f"{marks.path}.points.{name}")
    for name in points:
        if name not in marks.points:
            add(name, ())


def _line(reader: Reader, line: Line, where: str) -> LineMark:
    if line.through is not None and line.start is None and line.to is None:
        angle = ZERO if line.angle is None else reader.number(line.angle, f"{where}.angle", DIMENSIONLESS)
        return LineMark(reader.vector(line.through, f"{where}.through", LENGTH), angle)
    if line.start is not None and line.to is not None and line.through is None and line.angle is None:
        a = reader.vector(line.start, f"{where}.from", LENGTH)
        b = reader.vector(line.to, f"{where}.to", LENGTH)
        return LineMark(a, atan2(b[1] - a[1], b[0] - a[0]), (ZERO, distance(a, b)))
    raise SceneError("a line is { through, angle } or { from, to }", path=where)


def _circle(reader: Reader, circle: Circle, where: str) -> CircleMark:
    center = reader.vector(circle.center, f"{where}.center", LENGTH)
    return CircleMark(center, reader.number(circle.radius, f"{where}.radius", LENGTH))


def _row(reader: Reader, row: Row, where: str) -> RowMark:
    start = reader.vector(row.start, f"{where}.from", LENGTH)
    step = reader.vector(row.step, f"{where}.step", LENGTH)
    count = Number(-1.0) if row.count is None else reader.number(row.count, f"{where}.count", DIMENSIONLESS)
    return RowMark(start, step, count)


def rod_length(reader: Reader, name: str, body: Body) -> Node | None:
    """The written length of a rod; None if it is no rod or its length follows from where its ends are."""
    if body.length is None:
        return None
    return reader.number(body.length, f"bodies.{name}.length", LENGTH)


def distance(a: Pair, b: Pair) -> Node:
    """The distance of two points."""
    return norm(a[0] - b[0], a[1] - b[1])
