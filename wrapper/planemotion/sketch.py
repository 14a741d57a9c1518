"""The picture of a scene at its start: bodies with their shapes and names, joints, contacts, forces, ground.

It is drawn from the same expressions that the kernel's tables are made of (drawing.py), at the pose that the
assembly found, or, where the assembly failed, as written: most modelling errors show at once.  Signs are
those of symbols.py; lengths stand on the axes in the unit that the file uses most.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import engine, picture
from .drawing import GROUND, Drawing
from .expression import evaluate, parse
from .flatten import flatten, run_parameters
from .marks import CircleMark, LineMark, Pair, RowMark
from .node import Node
from .parameters import Parameters, Reader
from .partners import Partner, partner
from .picture import BLUE, INK, RED, SOFT
from .scene import Body, Coupling, Force, Joint, SceneData, Value, Vector
from .symbols import BODY_FILL, SPRING, TOUCH, Pen, Place
from .tables import Tables
from .units import DIMENSIONLESS, LENGTH, factor

if TYPE_CHECKING:
    from .builder import Scene
    from .scene import Contact, Force, Joint

# Greatest size of the drawing, and the room left around what is drawn, in inches.
_WIDTH, _HEIGHT, _ROOM = 7.6, 5.6, 0.55
_ROD = 0.1  # width of a rod, in
_PARTICLE = 0.06  # radius of a particle, in
_CENTRE_LINE = (0, (7, 2, 1.5, 2))  # dashes of a line on a body
# A scene of no size (one particle) is drawn as if it were so large, in m.
_NO_SIZE = 1.0
# Members of an endless row that are drawn at most.
_MAX_MEMBERS = 200
_LENGTHS = ("mm", "cm", "m", "km", "in", "ft", "yd", "mi")
_WITH_UNIT = re.compile(r"[\d.]\s*([a-z]+)\b(?![*/^\w])")


@dataclass(frozen=True)
class Start:
    """What is drawn: the scene, its marks as expressions, the pose (x, y, angle of G, SI) of each body.

    `fault`: why the pose is only the written one, "" if the start could be assembled.
    """

    data: SceneData
    drawing: Drawing
    poses: Mapping[str, tuple[float, float, float]]
    fault: str = ""


def drawing_of(data: SceneData, run: str | None) -> Drawing:
    """The drawn scene of a run, at the parameters of the file.  Raises SceneError."""
    parameters = Parameters(run_parameters(data, run), data.sweep.grids)
    reader = Reader(parameters)
    bodies = {
        name: body
        for name, body in data.bodies.items()
        if reader.constant(body.active, f"bodies.{name}.active", DIMENSIONLESS)
    }
    return Drawing(data, bodies, reader, Tables(parameters))


def start_of(scene: Scene, run: str | None = None) -> Start:
    """The start of a run (default: the first).  Raises SceneError for a fault in the scene."""
    flat = flatten(scene, run)
    drawing = drawing_of(scene.data, flat.run)
    found = engine.check(flat)
    poses = {
        name: (float(x), float(y), float(angle))
        for name, (x, y, angle) in zip(flat.bodies, found.pose, strict=True)
    }
    if found.message:
        default = drawing.tables.default
        poses = {
            name: (default(pose.x), default(pose.y), default(pose.angle))
            for name in drawing.bodies
            for pose in [drawing.pose(name)]
        }
    return Start(scene.data, drawing, poses, found.message)


def draw(start: Start, out: Path) -> None:
    """Writes the picture as a PNG; StudyError if it cannot be written."""
    with picture.style():
        picture.save(figure(start), out)


def figure(start: Start) -> Figure:
    """The picture of a start."""
    return Sketch(start).figure


class Sketch:
    """A picture under construction: what kinds of elements draw themselves with."""

    def __init__(self, start: Start) -> None:
        self.start = start
        self.data = start.data
        self.drawing = start.drawing
        self.unit = _usual_length(start.data)
        self.factor = factor(self.unit)[0]
        self.low, self.high = self._extent()
        self.figure, self.pen = self._canvas()
        self._draw_all()

    # ---- geometry, in the unit of the picture ----

    def number(self, node: Node) -> float:
        return self.drawing.tables.default(node)

    def length(self, node: Node) -> float:
        return self.number(node) / self.factor

    def place(self, owner: str, own: Pair) -> Place:
        """Where a place given in the own axes of a body (or of the ground) is."""
        if owner == GROUND:
            return self.length(own[0]), self.length(own[1])
        x, y = (self.length(part) for part in self.drawing.from_mass_center(owner, own))
        gx, gy, angle = self.start.poses[owner]
        c, s = math.cos(angle), math.sin(angle)
        return gx / self.factor + c * x - s * y, gy / self.factor + s * x + c * y

    def angle(self, owner: str) -> float:
        return 0.0 if owner == GROUND else self.start.poses[owner][2]

    def point(self, owner: str, name: str) -> Place:
        return self.place(owner, self.drawing.marks(owner).points[name])

    def of_partner(self, one: Partner, other: Partner) -> Place:
        """The place of a partner that is a point or a circle (its centre)."""
        if one.anywhere:
            return self.of_partner(other, one)
        if isinstance(one.mark, CircleMark):
            return self.place(one.owner, one.mark.center)
        return self.point(one.owner, one.name)

    def _extent(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower left and upper right of all that has a size."""
        places: list[Place] = []
        for owner in (*self.drawing.bodies, GROUND):
            marks = self.drawing.marks(owner)
            places += [self.place(owner, point) for point in marks.points.values()]
            for circle in marks.circles.values():
                (x, y), radius = self.place(owner, circle.center), self.length(circle.radius)
                places += [(x - radius, y - radius), (x + radius, y + radius)]
            places += [self.place(owner, row.start) for row in marks.rows.values()]
        for name, body in self.drawing.bodies.items():
            places += self._plate(name, body.plate) if body.plate is not None else []
            places += self._edge(name) if body.edge_on else []
        xy = np.array(places)
        low, high = xy.min(axis=0), xy.max(axis=0)
        size = max(float((high - low).max()), 0.0)
        if size == 0.0:
            size = _NO_SIZE / self.factor
            low, high = low - 0.5 * size, high + 0.5 * size
        return low, high

    def _canvas(self) -> tuple[Figure, Pen]:
        """Axes of equal scales, as large as the drawing needs."""
        size = np.maximum(self.high - self.low, 0.12 * float((self.high - self.low).max()))
        room = 2 * _ROOM
        inch = max(size[0] / (_WIDTH - room), size[1] / (_HEIGHT - room))
        paper = np.maximum(size / inch + room, (3.2, 1.6))
        left, right, below, above = 0.85, 0.15, 0.5, 0.66
        width, height = paper[0] + left + right, paper[1] + below + above
        made = Figure(figsize=(width, height), dpi=picture.RESOLUTION)
        canvas = FigureCanvasAgg(made)
        axes = made.add_axes((left / width, below / height, paper[0] / width, paper[1] / height))
        middle = 0.5 * (self.low + self.high)
        self.low, self.high = middle - 0.5 * paper * inch, middle + 0.5 * paper * inch
        axes.set_xlim(self.low[0], self.high[0])
        axes.set_ylim(self.low[1], self.high[1])
        axes.set_xlabel(f"x [{self.unit}]")
        axes.set_ylabel(f"y [{self.unit}]")
        axes.yaxis.set_label_coords(-0.62 / paper[0], 0.5)
        axes.grid(True, color="#f0f0f0", linewidth=0.5)
        return made, Pen(axes, canvas, float(inch))

    # ---- what is drawn ----

    def _draw_all(self) -> None:
        self._ground()
        self._spin()
        for name in sorted(self.drawing.bodies, key=self._reach, reverse=True):  # small ones on top
            self._body(name, self.drawing.bodies[name])
        for name, joint in self._active("joints"):
            self._joint(name, joint)
        for name, coupling in self._active("couplings"):
            self._coupling(name, coupling)
        for name, contact in self._active("contacts"):
            self._contact(name, contact)
        for name, force in self._active("forces"):
            self._force(name, force)
        self._points()
        plane = "vertical plane" if self.data.plane == "vertical" else "horizontal plane, seen from above"
        if self.data.spin is not None:
            plane = "plane that turns about an axis in it"
        note = f"{plane}; at the start"
        if self.start.fault:
            note = "as written, not assembled (see the message)"
        picture.head(self.figure, self.data.title or self.data.id or "Scene", note)
        if self.data.plane == "vertical":
            self._gravity()
        self.pen.write_names()

    def _gravity(self) -> None:
        """The direction of weight, in the emptiest corner."""
        inch = self.pen.inch
        ink = np.array([*self.pen.ink, *(name.place for name in self.pen.names)])
        corners = [
            (x, y)
            for y in (self.high[1] - 0.12 * inch, self.low[1] + 0.5 * inch)
            for x in (self.high[0] - 0.22 * inch, self.low[0] + 0.3 * inch)
        ]

        def crowd(corner: Place) -> int:
            x, y = corner
            near = (np.abs(ink[:, 0] - x) < 0.35 * inch) & (np.abs(ink[:, 1] - y + 0.2 * inch) < 0.4 * inch)
            return int(np.count_nonzero(near))

        x, y = min(corners, key=crowd)
        self.pen.arrow((x, y), (x, y - 0.38 * inch), SOFT, linewidth=1.0)
        self.pen.axes.text(
            x - 0.07 * inch, y - 0.19 * inch, "g", color=SOFT, ha="right", va="center", style="italic"
        )

    def _spin(self) -> None:
        """The axis about which the plane turns."""
        if self.data.spin is None:
            return
        reader = self.drawing.reader
        through = reader.vector(self.data.spin.through, "spin.through", LENGTH)
        angle = reader.number(self.data.spin.angle, "spin.angle", DIMENSIONLESS)
        a, b = self._ends(GROUND, LineMark(through, angle))
        self.pen.line([a, b], SOFT, 1.0, linestyle=_CENTRE_LINE)
        self.pen.name((b[0] + 0.06 * (a[0] - b[0]), b[1] + 0.06 * (a[1] - b[1])), "spin", SOFT)

    def _ground(self) -> None:
        marks = self.drawing.marks(GROUND)
        for name, line in marks.lines.items():
            a, b = self._ends(GROUND, line)
            self.pen.ground_line(a, b)
            self.pen.name((a[0] + 0.06 * (b[0] - a[0]), a[1] + 0.06 * (b[1] - a[1])), name, SOFT)
        for name, circle in marks.circles.items():
            center, radius = self.place(GROUND, circle.center), self.length(circle.radius)
            self.pen.circle(center, radius, edge=INK, linewidth=1.2)
            turn = 0.8 * math.pi
            self.pen.name(
                (center[0] + radius * math.cos(turn), center[1] + radius * math.sin(turn)), name, SOFT
            )
        for name, row in marks.rows.items():
            self._row(name, row)

    def _row(self, name: str, row: RowMark) -> None:
        start = np.array(self.place(GROUND, row.start))
        step = np.array([self.length(part) for part in row.step])
        if not np.any(step):
            return
        count = round(self.number(row.count))
        reach = float(np.hypot(*(self.high - self.low)) / np.hypot(*step))
        members = range(-int(reach), int(reach) + 1) if count < 0 else range(count)
        for k in list(members)[:_MAX_MEMBERS]:
            at = start + k * step
            if np.all(at >= self.low) and np.all(at <= self.high):
                self.pen.dot((float(at[0]), float(at[1])), INK, 0.035)
        self.pen.name((float(start[0]), float(start[1])), f"{name}[0]", SOFT)

    def _ends(self, owner: str, line: LineMark) -> tuple[Place, Place]:
        """Two places of a line: its ends, or where it leaves the picture, or as long as its body is."""
        at = np.array(self.place(owner, line.through))
        angle = self.number(line.angle) + self.angle(owner)
        along = np.array([math.cos(angle), math.sin(angle)])
        if line.extent is not None:
            a, b = (at + self.length(end) * along for end in line.extent)
        elif owner != GROUND:
            reach = self._reach(owner)
            a, b = at - reach * along, at + reach * along
        else:
            a, b = _clip(at, along, self.low, self.high)
        return (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))

    def _reach(self, owner: str) -> float:
        """How far a body extends from its geometric centre."""
        marks = self.drawing.marks(owner)
        center = self.point(owner, "center")
        reaches = [math.dist(center, self.place(owner, point)) for point in marks.points.values()]
        reaches += [
            math.dist(center, self.place(owner, circle.center)) + self.length(circle.radius)
            for circle in marks.circles.values()
        ]
        return max([*reaches, 0.3 * self.pen.inch])

    # ---- bodies ----

    def _body(self, name: str, body: Body) -> None:
        pen, center = self.pen, self.point(name, "center")
        marks = self.drawing.marks(name)
        if not body.turns:
            pen.dot(center, BLUE, _PARTICLE)
            pen.name(center, name, BLUE, bold=True)
            return
        self._shape(name, body, center)
        for key in body.circles:
            at, radius = self.place(name, marks.circles[key].center), self.length(marks.circles[key].radius)
            pen.circle(at, radius, fill="none" if body.shape else BODY_FILL, linewidth=0.9)
        for key in body.lines:
            pen.line(self._ends(name, marks.lines[key]), BLUE, 0.8, linestyle=_CENTRE_LINE, zorder=3)
        mass_centre = self.point(name, "G")
        pen.mass_centre(mass_centre)
        pen.name(mass_centre, name, BLUE, bold=True)

    def _shape(self, name: str, body: Body, center: Place) -> None:
        """The outline of a body that turns."""
        pen, marks = self.pen, self.drawing.marks(name)
        if body.rod is not None:
            pen.bar(self.point(name, body.rod[0]), self.point(name, body.rod[1]), _ROD)
        elif body.plate is not None:
            pen.polygon(self._plate(name, body.plate))
        elif body.edge_on:
            first, last = self._edge(name)
            pen.bar(first, last, _ROD)
        elif body.shape == "hoop":
            pen.ring(center, self.length(marks.circles["rim"].radius))
        elif body.shape == "half_ring":
            pen.half_ring(center, self.length(marks.circles["rim"].radius), self.angle(name))
        elif body.shape is not None:
            radius = self.length(marks.circles["rim"].radius)
            pen.circle(center, radius, fill=BODY_FILL)
            self._radius_line(name, center, radius)
        else:
            self._plain_body(name)

    def _radius_line(self, name: str, center: Place, radius: float) -> None:
        """A thin line along the body's x axis, so that one sees how it is turned."""
        turn = self.angle(name)
        rim = (center[0] + radius * math.cos(turn), center[1] + radius * math.sin(turn))
        self.pen.line([center, rim], BLUE, 0.5, zorder=2.3)

    def _plate(self, name: str, size: Vector) -> list[Place]:
        width, height = self.drawing.reader.vector(size, f"bodies.{name}.plate", LENGTH)
        x, y = width / 2, height / 2
        return [self.place(name, corner) for corner in ((-x, -y), (x, -y), (x, y), (-x, y))]

    def _edge(self, name: str) -> tuple[Place, Place]:
        """The ends of the diameter that a disk across the plane shows."""
        return self._ends(name, self.drawing.marks(name).lines["top"])

    def _plain_body(self, name: str) -> None:
        """A body without a shape: the outline of its points."""
        places = [self.point(name, key) for key in self.drawing.marks(name).points]
        outline = _outline(places)
        if len(outline) > 2:
            self.pen.polygon(outline, linestyle=(0, (5, 2)))
        elif len(outline) == 2:
            self.pen.bar(outline[0], outline[1], 0.7 * _ROD)
        else:
            self.pen.circle(outline[0], 0.12 * self.pen.inch, fill=BODY_FILL)

    def _points(self) -> None:
        """Dots and names of the points that the file names."""
        for owner in (*self.drawing.bodies, GROUND):
            for key in self.drawing.marks(owner).points:
                if key not in ("center", "G"):
                    at = self.point(owner, key)
                    self.pen.dot(at)
                    self.pen.name(at, key)

    # ---- joints, contacts, forces ----

    def read(self, texts: tuple[str, ...], where: str, *wanted: str) -> list[Partner]:
        """The partners of an element."""
        return [partner(self.drawing, text, where, *wanted) for text in texts]

    def _joint(self, name: str, joint: Joint) -> None:
        where = f"joints.{name}"
        (a,), (b,) = (
            self.read((text,), where, *wanted)
            for text, wanted in zip(joint.partners, joint.marks, strict=True)
        )
        self.pen.name(joint.draw(self, a, b), name)

    def _coupling(self, name: str, coupling: Coupling) -> None:
        self.pen.name(coupling.draw(self, f"couplings.{name}"), name)

    def _force(self, name: str, force: Force) -> None:
        self.pen.name(force.draw(self, f"forces.{name}"), name, SPRING if force.resists else RED)

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

    def strand(self, first: tuple[Partner, bool], second: tuple[Partner, bool]) -> Place:
        """A straight strand between its tangent points; gives its middle."""
        a, b = first[0], second[0]
        (ax, ay), (bx, by) = self.of_partner(a, b), self.of_partner(b, a)
        radius_a, radius_b = ((1.0 if ccw else -1.0) * self.radius(one) for one, ccw in (first, second))
        dx, dy, offset = bx - ax, by - ay, radius_b - radius_a
        square = dx * dx + dy * dy
        along = math.sqrt(max(square - offset * offset, 0.0))
        if square == 0:
            return ax, ay
        ux, uy = (along * dx + offset * dy) / square, (along * dy - offset * dx) / square
        ends = [
            (ax + radius_a * uy, ay - radius_a * ux),
            (bx + radius_b * uy, by - radius_b * ux),
        ]
        self.pen.line(ends, INK, 1.0)
        for end, one in zip(ends, (a, b), strict=True):
            if one.owner == GROUND and one.kind == "point":
                self.pen.support(end)
        return _middle(*ends)

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

    def _contact(self, name: str, contact: Contact) -> None:
        any_mark = ("circle", "point", "line", "row", "set")
        a, b = self.read(contact.partners, f"contacts.{name}", *any_mark)
        if a.kind in ("line", "row") or b.kind == "set":
            a, b = b, a
        members = [a]
        if a.kind == "set":
            assert isinstance(a.mark, tuple)
            members = [Partner(a.owner, "point", key, a.where) for key in a.mark]
        pairs = [self.touching(one, b) for one in members]
        for places in pairs:
            self.pen.touch(*places)
        self.pen.name(_middle(*min(pairs, key=lambda places: math.dist(*places))), name, TOUCH)

    def touching(self, a: Partner, b: Partner) -> tuple[Place, Place]:
        """The nearest places of two marks that may touch."""
        center = self.of_partner(a, b)
        radius = self.radius(a)
        if isinstance(b.mark, LineMark):
            turn = self.number(b.mark.angle) + self.angle(b.owner)
            foot = self.place(b.owner, b.mark.through)
            x, y = -math.sin(turn), math.cos(turn)  # towards the free side
            gap = (center[0] - foot[0]) * x + (center[1] - foot[1]) * y
            near = (center[0] - radius * x, center[1] - radius * y)
            return near, (center[0] - gap * x, center[1] - gap * y)
        if isinstance(b.mark, RowMark):
            start = np.array(self.place(b.owner, b.mark.start))
            step = np.array([self.length(part) for part in b.mark.step])
            k = round(float((np.array(center) - start) @ step / (step @ step))) if np.any(step) else 0
            count = round(self.number(b.mark.count))
            k = k if count < 0 else min(max(k, 0), count - 1)
            at = start + k * step
            away = at - np.array(center)
            distance = float(np.hypot(*away)) or 1.0
            near = (center[0] + radius * away[0] / distance, center[1] + radius * away[1] / distance)
            return (float(near[0]), float(near[1])), (float(at[0]), float(at[1]))
        return self.between_circles(a, b)

    def at_start(self, written: Value) -> float:
        """A number of a force, which may depend on t, at t = 0."""
        defaults = self.drawing.reader.parameters.defaults
        return evaluate(parse(written), lambda leaf: 0.0 if str(leaf) == "t" else defaults[str(leaf)])

    def _active(self, table: str) -> Iterator[tuple[str, Any]]:
        """The elements of a table that take part at these parameters."""
        reader = self.drawing.reader
        for name, element in getattr(self.data, table).items():
            if reader.constant(element.active, f"{table}.{name}.active", DIMENSIONLESS):
                yield name, element


def _middle(a: Place, b: Place) -> Place:
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def _clip(
    at: np.ndarray, along: np.ndarray, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where the line through `at` enters and leaves a box; a short piece at `at` if it misses it."""
    first, last = -math.inf, math.inf
    for i in range(2):
        if along[i]:
            ends = sorted(((low[i] - at[i]) / along[i], (high[i] - at[i]) / along[i]))
            first, last = max(first, ends[0]), min(last, ends[1])
        elif not low[i] <= at[i] <= high[i]:
            last = -math.inf
    if not first < last:
        first, last = 0.0, 0.0
    return at + first * along, at + last * along


def _outline(places: list[Place]) -> list[Place]:
    """The corners of the convex hull, counterclockwise (monotone chain)."""
    points = sorted(set(places))
    if len(points) < 3:
        return points

    def half(ordered: list[Place]) -> list[Place]:
        chain: list[Place] = []
        for p in ordered:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return half(points) + half(points[::-1])


def _turn(a: Place, b: Place, c: Place) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _usual_length(data: SceneData) -> str:
    """The unit of length that the file uses most."""
    found = Counter(_WITH_UNIT.findall(repr(data.model_dump(exclude={"title", "description", "ask"}))))
    used = [unit for unit in _LENGTHS if found[unit]]
    return max(used, key=lambda unit: found[unit]) if used else "m"
