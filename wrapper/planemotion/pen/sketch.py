"""The drawn scene on paper: where its marks are at given poses, and the signs between partners.

Kinds of elements draw themselves with a `Sketch`: it knows the places of points, lines and circles, in the
unit of the picture, and its `pen` has the signs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..geometry.curves import CurveMark
from ..geometry.drawing import Drawing
from ..geometry.marks import CircleMark, LineMark, Pair, RowMark
from ..geometry.pairs import is_pair
from ..geometry.partners import Partner, partner
from ..language.dimensions import LENGTH
from ..language.leaves import evaluate, names
from ..language.tree import Node
from ..language.units import factor
from ..model.readers import Value, Vector
from ..model.words import GROUND
from .beside import along_curve, between_curves, places_of
from .page import INK, RESOLUTION
from .symbols import Pen, Place

# Greatest size of the drawing, and the room left around what is drawn, in inches.
_WIDTH, _HEIGHT, _ROOM = 7.6, 5.6, 0.55
_TICK = 0.7  # an inch of axis for each number below it, so that they keep apart, in
# A scene of no size (one particle) is drawn as if it were so large, in m.
_NO_SIZE = 1.0
# What is smaller is the rounding of places: of the greatest coordinate, and in m.
_ROUNDED, _LEAST = 1e-9, 1e-12


# A point or circle at an end of a strand, and whether it is passed counterclockwise.
Stop = tuple[Partner, bool]
Strand = tuple[Stop, Stop]


class Sketch:
    """Axes as large as the drawing needs, and where everything is on them.

    `poses`: x, y (m) and angle (rad) of the mass centre of each body; `unit`: of lengths on the axes;
    `room`: lower left [2] and upper right [2] of what is to be seen, in that unit; None: what the poses need.
    `known`: what is known of the motion, by address in SI: velocities, forces.
    """

    def __init__(
        self,
        drawing: Drawing,
        poses: Mapping[str, tuple[float, float, float]],
        unit: str,
        room: tuple[np.ndarray, np.ndarray] | None = None,
        known: Mapping[str, float] | None = None,
    ) -> None:
        self.drawing = drawing
        self.known = known or {}
        self.poses = poses
        self.unit = unit
        self.factor = factor(unit)[0]
        self.low, self.high = room if room is not None else self.extent()
        self.figure, self.pen = self.canvas()

    def number(self, node: Node) -> float:
        return self.drawing.tables.default(node)

    def length(self, node: Node) -> float:
        return self.number(node) / self.factor

    def own_place(self, owner: str, own: Pair) -> Place:
        """A place of a body from its mass centre along its own axes: the same number in all poses."""
        x, y = self.drawing.from_mass_center(owner, own)
        return self.length(x), self.length(y)

    def place(self, owner: str, own: Pair) -> Place:
        """Where a place given in the own axes of a body (or of the ground) is."""
        if owner == GROUND:
            return self.length(own[0]), self.length(own[1])
        x, y = self.own_place(owner, own)
        gx, gy, angle = self.poses[owner]
        c, s = math.cos(angle), math.sin(angle)
        return gx / self.factor + c * x - s * y, gy / self.factor + s * x + c * y

    def angle(self, owner: str) -> float:
        return 0.0 if owner == GROUND else self.poses[owner][2]

    def rotates(self, one: Partner) -> bool:
        return one.is_ground or self.drawing.bodies[one.owner].rotates

    def point(self, owner: str, name: str) -> Place:
        return self.place(owner, self.drawing.marks(owner).points[name])

    def curve(self, owner: str, mark: CurveMark) -> np.ndarray:
        """Places [n, 2] of a curve, in the order of s."""
        return places_of(self, owner, mark)

    def along_curve(self, owner: str, mark: CurveMark, at: Place) -> tuple[Place, float]:
        """The place of a curve next to a place, and its direction there."""
        return along_curve(self, owner, mark, at)

    def of_partner(self, one: Partner, other: Partner) -> Place:
        """The place of a partner that is a point or a circle (its centre)."""
        if one.anywhere:
            return self.of_partner(other, one)
        if isinstance(one.mark, CircleMark):
            return self.place(one.owner, one.mark.center)
        return self.point(one.owner, one.name)

    def both(self, a: Partner, b: Partner) -> tuple[Place, Place]:
        """The places of two partners that are points or circles."""
        return self.of_partner(a, b), self.of_partner(b, a)

    def radius(self, one: Partner) -> float:
        """Of a circle; a point has none."""
        return self.length(one.mark.radius) if isinstance(one.mark, CircleMark) else 0.0

    def middle(self, a: Place, b: Place) -> Place:
        return _middle(a, b)

    def center(self, bodies: tuple[str, ...]) -> Place:
        """The centre of the first of some bodies that is not the ground."""
        return self.point(next(body for body in bodies if body != GROUND), "center")

    def at_start(self, written: Value) -> float | None:
        """A number of a force, which may depend on t, at t = 0; None if what it reads is not known."""
        parameters = self.drawing.reader.parameters
        values = {"t": 0.0, **self.known, **parameters.defaults}
        node = parameters.parse(written)
        if any(str(leaf) not in values for leaf in names(node)):
            return None
        value = evaluate(node, lambda leaf: values[str(leaf)])
        return value if math.isfinite(value) else None

    def is_constant(self, written: Value) -> bool:
        """Whether a number of a force reads parameters alone."""
        parameters = self.drawing.reader.parameters
        return all(str(leaf) in parameters.defaults for leaf in names(parameters.parse(written)))

    def read(self, texts: tuple[str, ...], where: str, *wanted: str) -> list[Partner]:
        """The partners of an element."""
        return [partner(self.drawing, text, where, *wanted) for text in texts]

    def extent(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower left [2] and upper right [2] of all that has a size, in the unit of the picture."""
        places: list[Place] = []
        for owner in (*self.drawing.bodies, GROUND):
            places += self.outer(owner)
            places += [self.place(owner, row.start) for row in self.drawing.marks(owner).rows.values()]
        places += [at for line in self.drawing.marks(GROUND).lines.values() for at in self.seen_of(line)]
        xy = np.array(places)
        low, high = xy.min(axis=0), xy.max(axis=0)
        size = float((high - low).max())
        if size <= max(_ROUNDED * float(np.abs(xy).max()), _LEAST / self.factor):
            size = _NO_SIZE / self.factor
            low, high = low - 0.5 * size, high + 0.5 * size
        return low, high

    def seen_of(self, line: LineMark) -> list[Place]:
        """What must be seen of a line of the ground: its ends, or where the nearest body stands before it."""
        if line.extent is not None:
            return list(self.ends(GROUND, line))
        through, angle = np.array(self.place(GROUND, line.through)), self.number(line.angle)
        along = np.array([math.cos(angle), math.sin(angle)])
        centers = [np.array(self.point(name, "center")) for name in self.drawing.bodies] or [through]
        feet = [through + float((center - through) @ along) * along for center in centers]
        x, y = min(zip(feet, centers, strict=True), key=lambda pair: float(np.hypot(*(pair[1] - pair[0]))))[0]
        return [(float(x), float(y))]

    def outer(self, owner: str) -> list[Place]:
        """Places that a body, or the ground, lies between."""
        marks = self.drawing.marks(owner)
        places = [self.place(owner, point) for point in marks.points.values()]
        for circle in marks.circles.values():
            (x, y), radius = self.place(owner, circle.center), self.length(circle.radius)
            places += [(x - radius, y - radius), (x + radius, y + radius)]
        for curve in marks.curves.values():
            places += [(float(x), float(y)) for x, y in self.curve(owner, curve)]
        body = None if owner == GROUND else self.drawing.bodies[owner]
        places += self.corners(owner, body.plate) if body and body.plate is not None else []
        places += self.diameter(owner) if body and body.edge_on else []
        return places

    def fit(self) -> tuple[float, np.ndarray]:
        """The length that is an inch on paper, and the size [2] of the paper in inches.

        `low` and `high` become its corners."""
        size = np.maximum(self.high - self.low, 0.12 * float((self.high - self.low).max()))
        inch = inch_of(size)
        paper = np.maximum(size / inch + 2 * _ROOM, (3.2, 1.6))
        middle = 0.5 * (self.low + self.high)
        self.low, self.high = middle - 0.5 * paper * inch, middle + 0.5 * paper * inch
        return inch, paper

    def canvas(self) -> tuple[Figure, Pen]:
        """Axes of equal scales, as large as the drawing needs."""
        inch, paper = self.fit()
        left, right, below, above = 0.85, 0.15, 0.5, 0.66
        width, height = paper[0] + left + right, paper[1] + below + above
        made = Figure(figsize=(width, height), dpi=RESOLUTION)
        canvas = FigureCanvasAgg(made)
        axes = made.add_axes((left / width, below / height, paper[0] / width, paper[1] / height))
        axes.set_xlim(self.low[0], self.high[0])
        axes.set_ylim(self.low[1], self.high[1])
        axes.set_xlabel(f"x [{self.unit}]")
        axes.set_ylabel(f"y [{self.unit}]")
        axes.yaxis.set_label_coords(-0.62 / paper[0], 0.5)
        axes.grid(True, color="#f0f0f0", linewidth=0.5)
        axes.xaxis.set_major_locator(MaxNLocator(max(2, int(paper[0] / _TICK)), steps=[1, 2, 2.5, 5, 10]))
        return made, Pen(axes, canvas, inch)

    def ends(self, owner: str, line: LineMark) -> tuple[Place, Place]:
        """Two places of a line: its ends, or where it leaves the picture, or as long as its body is."""
        at = np.array(self.place(owner, line.through))
        angle = self.number(line.angle) + self.angle(owner)
        along = np.array([math.cos(angle), math.sin(angle)])
        if line.extent is not None:
            a, b = (at + self.length(end) * along for end in line.extent)
        elif owner != GROUND:
            reach = self.reach(owner)
            a, b = at - reach * along, at + reach * along
        else:
            a, b = _clip(at, along, self.low, self.high)
        return (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))

    def members(self, row: RowMark, apart: float) -> list[Place]:
        """The members of a row of points that lie in the picture, `apart` inches from each other or more."""
        start = np.array(self.place(GROUND, row.start))
        step = np.array([self.length(part) for part in row.step])
        size = float(np.hypot(*step))
        if not size:
            return []
        count = round(self.number(row.count))
        first, last = _inside(start, step, self.low, self.high)
        if count >= 0:
            first, last = max(first, 0.0), min(last, count - 1.0)
        if not first <= last:
            return []
        every = max(1, math.ceil(apart * self.pen.inch / size))
        numbers = every * np.arange(math.ceil(first / every), math.floor(last / every) + 1)
        return [(float(x), float(y)) for x, y in start + numbers[:, None] * step]

    def reach(self, owner: str) -> float:
        """How far a body extends from its geometric centre; the same in all its poses."""
        marks = self.drawing.marks(owner)
        center = self.own_place(owner, marks.points["center"])
        reaches = [math.dist(center, self.own_place(owner, point)) for point in marks.points.values()]
        reaches += [
            math.dist(center, self.own_place(owner, circle.center)) + self.length(circle.radius)
            for circle in marks.circles.values()
        ]
        middle = self.point(owner, "center")
        reaches += [
            float(np.hypot(*(self.curve(owner, curve) - np.asarray(middle)).T).max())
            for curve in marks.curves.values()
        ]
        return max([*reaches, 0.3 * self.pen.inch])

    def corners(self, name: str, size: Vector) -> list[Place]:
        width, height = self.drawing.reader.vector(size, f"bodies.{name}.plate", LENGTH)
        x, y = width / 2, height / 2
        return [self.place(name, corner) for corner in ((-x, -y), (x, -y), (x, y), (-x, y))]

    def diameter(self, name: str) -> tuple[Place, Place]:
        """The ends of the diameter that a disk across the plane shows."""
        return self.ends(name, self.drawing.marks(name).lines["top"])

    def across(self, texts: tuple[str, ...], where: str, sign: Callable[[Place, Place], None]) -> Place:
        """A sign between two points, held where they belong to the ground; gives its middle."""
        a, b = self.read(texts, where, "point")
        places = self.both(a, b)
        sign(*places)
        for end, one in zip(places, (a, b), strict=True):
            if one.is_ground:
                self.pen.support(end)
        return _middle(*places)

    def spiral(self, texts: tuple[str, ...], where: str) -> Place:
        """The sign of what turns the first of two bodies against the other."""
        a, b = self.read(texts, where, "point")
        at = self.of_partner(a, b) if a.is_ground else self.point(a.owner, "center")
        self.pen.spiral(at)
        return at

    def strand(self, first: Stop, second: Stop) -> Place:
        """A straight strand between its tangent points; gives its middle."""
        ends = self.strand_ends(first, second)
        self.pen.line(ends, INK, 1.0)
        for end, (one, _) in zip(ends, (first, second), strict=True):
            if one.owner == GROUND and one.kind == "point":
                self.pen.support(end)
        return _middle(*ends)

    def strand_ends(self, first: Stop, second: Stop) -> tuple[Place, Place]:
        """The tangent points of a straight strand; both at the first centre if the centres are one."""
        a, b = first[0], second[0]
        (ax, ay), (bx, by) = self.of_partner(a, b), self.of_partner(b, a)
        radius_a, radius_b = ((1.0 if ccw else -1.0) * self.radius(one) for one, ccw in (first, second))
        dx, dy, offset = bx - ax, by - ay, radius_b - radius_a
        square = dx * dx + dy * dy
        along = math.sqrt(max(square - offset * offset, 0.0))
        if square == 0:
            return (ax, ay), (ax, ay)
        ux, uy = (along * dx + offset * dy) / square, (along * dy - offset * dx) / square
        return (ax + radius_a * uy, ay - radius_a * ux), (bx + radius_b * uy, by - radius_b * ux)

    def between_circles(self, a: Partner, b: Partner) -> tuple[Place, Place]:
        """The places of two circles that are nearest to each other, on the line through their centres."""
        (ax, ay), (bx, by) = self.of_partner(a, b), self.of_partner(b, a)
        radius_a, radius_b = self.radius(a), self.radius(b)
        apart = math.hypot(bx - ax, by - ay)
        x, y = ((bx - ax) / apart, (by - ay) / apart) if apart else (1.0, 0.0)
        side_a, side_b = 1.0, -1.0
        if apart < max(radius_a, radius_b):  # one inside the other
            side_a, side_b = (-1.0, -1.0) if radius_a < radius_b else (1.0, 1.0)
        return (
            (ax + side_a * radius_a * x, ay + side_a * radius_a * y),
            (bx + side_b * radius_b * x, by + side_b * radius_b * y),
        )

    def touching(self, a: Partner, b: Partner, ends: bool = False) -> tuple[Place, Place]:
        """The nearest places of two marks that may touch; `ends`: a line goes no further than its body."""
        if is_pair(a, b):
            return between_curves(self, a, b)
        center = self.of_partner(a, b)
        radius = self.radius(a)
        if isinstance(b.mark, LineMark):
            turn = self.number(b.mark.angle) + self.angle(b.owner)
            foot = self.place(b.owner, b.mark.through)
            x, y = -math.sin(turn), math.cos(turn)  # towards the free side
            gap = (center[0] - foot[0]) * x + (center[1] - foot[1]) * y
            if ends and b.mark.extent is not None:
                reach = (center[0] - foot[0]) * y - (center[1] - foot[1]) * x
                first, last = (self.length(end) for end in b.mark.extent)
                if not first <= reach <= last:  # round the corner at its end
                    part = min(max(reach, first), last)
                    return _towards(center, radius, (foot[0] + part * y, foot[1] - part * x))
            near = (center[0] - radius * x, center[1] - radius * y)
            return near, (center[0] - gap * x, center[1] - gap * y)
        if isinstance(b.mark, CurveMark):
            return _towards(center, radius, self.along_curve(b.owner, b.mark, center)[0])
        if isinstance(b.mark, RowMark):
            start = np.array(self.place(b.owner, b.mark.start))
            step = np.array([self.length(part) for part in b.mark.step])
            k = round(float((np.array(center) - start) @ step / (step @ step))) if np.any(step) else 0
            count = round(self.number(b.mark.count))
            k = k if count < 0 else min(max(k, 0), count - 1)
            at = start + k * step
            return _towards(center, radius, (float(at[0]), float(at[1])))
        return self.between_circles(a, b)


def inch_of(size: np.ndarray) -> float:
    """The length that is an inch on paper, for a drawing of a size [2]."""
    return float(max(size[0] / (_WIDTH - 2 * _ROOM), size[1] / (_HEIGHT - 2 * _ROOM)))


def _towards(center: Place, radius: float, at: Place) -> tuple[Place, Place]:
    """The place of a circle nearest to a point, and the point."""
    away = at[0] - center[0], at[1] - center[1]
    distance = math.hypot(*away) or 1.0
    return (center[0] + radius * away[0] / distance, center[1] + radius * away[1] / distance), at


def _middle(a: Place, b: Place) -> Place:
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def _clip(
    at: np.ndarray, along: np.ndarray, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where the line through `at` along a unit vector enters and leaves a box (all [2]).

    A short piece at `at` if it misses the box.
    """
    first, last = _inside(at, along, low, high)
    first, last = (first, last) if first < last else (0.0, 0.0)
    return at + first * along, at + last * along


def _inside(at: np.ndarray, along: np.ndarray, low: np.ndarray, high: np.ndarray) -> tuple[float, float]:
    """Between which k the place `at + k along` is in a box (all [2]); (greater, smaller): it never is."""
    first, last = -math.inf, math.inf
    for i in range(2):
        if along[i]:
            near, far = sorted(((low[i] - at[i]) / along[i], (high[i] - at[i]) / along[i]))
            first, last = max(first, near), min(last, far)
        elif not low[i] <= at[i] <= high[i]:
            last = -math.inf
    return first, last
