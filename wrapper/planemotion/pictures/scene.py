"""The picture of a scene at its start: bodies with their shapes and names, joints, contacts, forces, ground.

It is drawn from the same expressions that the kernel's tables are made of (geometry/drawing.py), at the pose
that the assembly found, or, where the assembly failed, as written: most modelling errors show at once.  Signs
are those of pen/symbols.py; lengths stand on the axes in the unit that the file uses most.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..compile.flatten import flatten, run_parameters
from ..engine import call
from ..geometry.drawing import Drawing
from ..geometry.marks import LineMark, RowMark
from ..geometry.packing import Tables
from ..geometry.pairs import as_curve, is_pair, is_swapped
from ..geometry.parameters import Parameters, Reader
from ..geometry.partners import Partner, touching
from ..geometry.push import Push
from ..kinds.base import Coupling, Force, Joint
from ..language.dimensions import DIMENSIONLESS, LENGTH
from ..model.tables import Body, Contact
from ..model.words import GROUND
from ..pen import page
from ..pen.page import BLUE, INK, RED, SOFT
from ..pen.sketch import Sketch
from ..pen.symbols import BODY_FILL, SPRING, TOUCH, Place
from ..reading.scene import HasData, SceneData
from . import known

_ROD = 0.1  # width of a rod, in
_PARTICLE = 0.06  # radius of a particle, in
_CENTRE_LINE = (0, (7, 2, 1.5, 2))  # dashes of a line on a body
# Below so many inches a direction between two places means nothing.
_CLOSE = 1e-6
# Radius of a member of a row of points, in; members that are closer than that to each other make a band.
_MEMBER = 0.035
_IMPERIAL = ("in", "ft", "yd", "mi")
_LENGTHS = ("mm", "cm", "m", "km", *_IMPERIAL)
_WITH_UNIT = re.compile(r"[\d.]\s*([a-z]+)\b(?![*/^\w])")

Pose = tuple[float, float, float]


@dataclass(frozen=True)
class Start:
    """What is drawn: the scene, its marks as expressions, pose and velocity (of x, y, angle; SI) of bodies.

    `fault`: why the pose is only the written one, "" if the start could be assembled.  `when`: for people.
    `known`: of the motion, as of known.py.
    """

    data: SceneData
    drawing: Drawing
    poses: Mapping[str, Pose]
    fault: str = ""
    when: str = "at the start"
    velocities: Mapping[str, Pose] = field(default_factory=dict)
    known: Mapping[str, float] = field(default_factory=dict)


def drawing_of(data: SceneData, run: str | None, found: Mapping[str, float] | None = None) -> Drawing:
    """The drawn scene of a run, at the parameters of the file, or at what was `found` for them (SI).

    Raises SceneError."""
    parameters = Parameters(run_parameters(data, run), data.sweep.grids, data.book)
    parameters.find(found or {})
    reader = Reader(parameters)
    bodies = {
        name: body
        for name, body in data.bodies.items()
        if reader.constant(body.active, f"bodies.{name}.active", DIMENSIONLESS)
    }
    return Drawing(data, bodies, reader, Tables(parameters))


def start_of(scene: HasData, run: str | None = None) -> Start:
    """The start of a run (default: the first).  Raises SceneError for a fault in the scene."""
    flat = flatten(scene, run)
    drawing = drawing_of(scene.data, flat.run)
    found = call.check(flat)
    poses, velocities = (
        {name: (float(x), float(y), float(turn)) for name, (x, y, turn) in zip(flat.bodies, of, strict=True)}
        for of in (found.pose, found.velocity)
    )
    if found.message:
        default = drawing.tables.default
        poses = {
            name: (default(pose.x), default(pose.y), default(pose.angle))
            for name in drawing.bodies
            for pose in [drawing.pose(name)]
        }
    if found.message:
        return Start(scene.data, drawing, poses, found.message)
    return Start(scene.data, drawing, poses, velocities=velocities, known=known.at_start(poses, velocities))


def figure(start: Start, more: Iterable[Callable[[Start, Sketch], None]] = ()) -> Figure:
    """The picture of a start; `more` draw on it what is shown on request."""
    sketch = Sketch(start.drawing, start.poses, usual_length(start.data), known=start.known)
    SceneDrawing(start.data, sketch).draw()
    for one in more:
        one(start, sketch)
    note = f"{plane_of(start.data)}; {start.when}"
    if start.fault:
        note = "as written, not assembled (see the message)"
    page.head(sketch.figure, title_of(start.data), note)
    if start.data.plane == "vertical":
        _gravity(sketch)
    sketch.pen.write_names()
    return sketch.figure


def title_of(data: SceneData) -> str:
    """What stands above a picture."""
    return data.title or data.id or "Scene"


def plane_of(data: SceneData) -> str:
    """Which plane one sees, in words."""
    if data.spin is not None:
        return "plane that turns about an axis in it"
    return "vertical plane" if data.plane == "vertical" else "horizontal plane, seen from above"


def _gravity(sketch: Sketch) -> None:
    """The direction of weight, in the emptiest corner."""
    inch = sketch.pen.inch
    ink = np.array([*sketch.pen.ink, *(name.place for name in sketch.pen.names)])
    corners = [
        (x, y)
        for y in (sketch.high[1] - 0.12 * inch, sketch.low[1] + 0.5 * inch)
        for x in (sketch.high[0] - 0.22 * inch, sketch.low[0] + 0.3 * inch)
    ]

    def crowd(corner: Place) -> int:
        x, y = corner
        near = (np.abs(ink[:, 0] - x) < 0.35 * inch) & (np.abs(ink[:, 1] - y + 0.2 * inch) < 0.4 * inch)
        return int(np.count_nonzero(near))

    x, y = min(corners, key=crowd)
    sketch.pen.arrow((x, y), (x, y - 0.38 * inch), SOFT, linewidth=1.0)
    at = np.array([x - 0.07 * inch, y - 0.19 * inch])
    sketch.pen.axes.text(at[0], at[1], "g", color=SOFT, ha="right", va="center", style="italic")
    across, up = np.array([0.16 * inch, 0]), np.array([0, 0.05 * inch])
    sketch.pen.remember(np.array([at - up, at - up - across, at + up - across, at + up]))


class SceneDrawing:
    """Draws a scene on a sketch: all signs and names, in the poses of the sketch."""

    def __init__(self, data: SceneData, sketch: Sketch) -> None:
        self.data = data
        self.sketch = sketch

    def draw(self) -> None:
        """All that the scene has."""
        self.draw_ground()
        self.draw_moving()

    def draw_ground(self) -> None:
        """What is the same in all poses."""
        self._ground()
        self._spin()

    def draw_moving(self) -> None:
        """Bodies, small ones on top, and what is between them."""
        for name in sorted(self.sketch.drawing.bodies, key=self.sketch.reach, reverse=True):
            self.draw_body(name, self.sketch.drawing.bodies[name])
        for name, joint in self._active("joints"):
            self._joint(name, joint)
        for name, coupling in self._active("couplings"):
            self._coupling(name, coupling)
        for name, contact in self._active("contacts"):
            self._contact(name, contact)
        for name, force in self._active("forces"):
            self._force(name, force)
        self._points()

    def _spin(self) -> None:
        """The axis about which the plane turns."""
        if self.data.spin is None:
            return
        reader = self.sketch.drawing.reader
        through = reader.vector(self.data.spin.through, "spin.through", LENGTH)
        angle = reader.number(self.data.spin.angle, "spin.angle", DIMENSIONLESS)
        a, b = self.sketch.ends(GROUND, LineMark(through, angle))
        self.sketch.pen.line([a, b], SOFT, 1.0, linestyle=_CENTRE_LINE)
        self.sketch.pen.name((b[0] + 0.06 * (a[0] - b[0]), b[1] + 0.06 * (a[1] - b[1])), "spin", SOFT)

    def _ground(self) -> None:
        marks = self.sketch.drawing.marks(GROUND)
        for name, line in marks.lines.items():
            a, b = self.sketch.ends(GROUND, line)
            self.sketch.pen.ground_line(a, b)
            self.sketch.pen.name((a[0] + 0.06 * (b[0] - a[0]), a[1] + 0.06 * (b[1] - a[1])), name, SOFT)
        for name, circle in marks.circles.items():
            center, radius = self.sketch.place(GROUND, circle.center), self.sketch.length(circle.radius)
            self.sketch.pen.circle(center, radius, edge=INK, linewidth=1.2)
            turn = 0.8 * math.pi
            at = center[0] + radius * math.cos(turn), center[1] + radius * math.sin(turn)
            self.sketch.pen.name(at, name, SOFT)
        for name, curve in marks.curves.items():
            places = self.sketch.curve(GROUND, curve)
            self.sketch.pen.line(places, INK, 1.2, zorder=1.5)
            self.sketch.pen.name((float(places[0, 0]), float(places[0, 1])), name, SOFT)
        for name, row in marks.rows.items():
            self._row(name, row)

    def _row(self, name: str, row: RowMark) -> None:
        for at in self.sketch.members(row, _MEMBER):
            self.sketch.pen.dot(at, INK, _MEMBER)
        self.sketch.pen.name(self.sketch.place(GROUND, row.start), f"{name}[0]", SOFT)

    def draw_body(self, name: str, body: Body) -> None:
        """A body with its circles and lines, and its name."""
        pen, center = self.sketch.pen, self.sketch.point(name, "center")
        marks = self.sketch.drawing.marks(name)
        if not body.rotates:
            pen.dot(center, BLUE, _PARTICLE)
            pen.name(center, name, BLUE, bold=True)
            return
        first = len(pen.ink)
        self._shape(name, body, center)
        for key in body.circles:
            circle = marks.circles[key]
            at, radius = self.sketch.place(name, circle.center), self.sketch.length(circle.radius)
            pen.circle(at, radius, fill="none" if body.shape else BODY_FILL, linewidth=0.9)
            if not body.shape:
                self._radius_line(name, at, radius)
        for key in body.curves:
            places = self.sketch.curve(name, marks.curves[key])
            if marks.curves[key].closed and not body.shape:
                pen.polygon(places, linewidth=0.9)
            else:
                pen.line(places, BLUE, 0.9, zorder=2.6)
        for key in body.lines:
            pen.line(self.sketch.ends(name, marks.lines[key]), BLUE, 0.8, linestyle=_CENTRE_LINE, zorder=3)
        mass_centre = self.sketch.point(name, "G")
        pen.mass_centre(mass_centre)
        pen.name(mass_centre, name, BLUE, bold=True, around=pen.ink[first:])

    def _shape(self, name: str, body: Body, center: Place) -> None:
        """The outline of a body that rotates."""
        pen, marks = self.sketch.pen, self.sketch.drawing.marks(name)
        if body.rod is not None:
            pen.bar(self.sketch.point(name, body.rod[0]), self.sketch.point(name, body.rod[1]), _ROD)
        elif body.plate is not None:
            pen.polygon(self.sketch.corners(name, body.plate))
        elif body.edge_on:
            first, last = self.sketch.diameter(name)
            pen.bar(first, last, _ROD)
        elif body.shape == "hoop":
            pen.ring(center, self.sketch.length(marks.circles["rim"].radius))
        elif body.shape == "half_ring":
            pen.half_ring(center, self.sketch.length(marks.circles["rim"].radius), self.sketch.angle(name))
        elif body.shape is not None:
            radius = self.sketch.length(marks.circles["rim"].radius)
            pen.circle(center, radius, fill=BODY_FILL)
            self._radius_line(name, center, radius)
        else:
            self._plain_body(name)

    def _radius_line(self, name: str, center: Place, radius: float) -> None:
        """A thin line along the body's x axis, so that one sees how it is turned."""
        turn = self.sketch.angle(name)
        rim = (center[0] + radius * math.cos(turn), center[1] + radius * math.sin(turn))
        self.sketch.pen.line([center, rim], BLUE, 0.5, zorder=2.3)

    def _plain_body(self, name: str) -> None:
        """A body without a shape: the outline of its points."""
        points = self.sketch.drawing.marks(name).points
        own = {self.sketch.own_place(name, point): key for key, point in points.items()}
        outline = [self.sketch.point(name, own[place]) for place in _outline(list(own))]
        if len(outline) > 2:
            self.sketch.pen.polygon(outline, linestyle=(0, (5, 2)))
        elif len(outline) == 2:
            self.sketch.pen.bar(outline[0], outline[1], 0.7 * _ROD)
        else:
            self.sketch.pen.circle(outline[0], 0.12 * self.sketch.pen.inch, fill=BODY_FILL)

    def _points(self) -> None:
        """Dots and names of the points that the file names."""
        for owner in (*self.sketch.drawing.bodies, GROUND):
            for key in self.sketch.drawing.marks(owner).named_points:
                at = self.sketch.point(owner, key)
                self.sketch.pen.dot(at)
                self.sketch.pen.name(at, key)

    def _joint(self, name: str, joint: Joint) -> None:
        where = f"joints.{name}"
        (a,), (b,) = (
            self.sketch.read((text,), where, *wanted)
            for text, wanted in zip(joint.partners, joint.marks, strict=True)
        )
        self.sketch.pen.name(joint.draw(self.sketch, a, b), name)

    def _coupling(self, name: str, coupling: Coupling) -> None:
        self.sketch.pen.name(coupling.draw(self.sketch, f"couplings.{name}"), name)

    def _force(self, name: str, force: Force) -> None:
        pen = self.sketch.pen
        first = len(pen.ink)
        at = force.draw(self.sketch, f"forces.{name}")
        pen.name(at, name, SPRING if force.resists else RED, around=pen.ink[first:])

    def _contact(self, name: str, contact: Contact) -> None:
        pairs = [push.places for push in contact_pushes(self.sketch, name, contact)]
        self.sketch.pen.touches(pairs)
        nearest = min(pairs, key=lambda places: math.dist(*places))
        self.sketch.pen.name(self.sketch.middle(*nearest), name, TOUCH)

    def _active(self, table: str) -> Iterator[tuple[str, Any]]:
        """The elements of a table that take part at these parameters."""
        reader = self.sketch.drawing.reader
        for name, element in getattr(self.data, table).items():
            if reader.constant(element.active, f"{table}.{name}.active", DIMENSIONLESS):
                yield name, element


def contact_pushes(sketch: Sketch, name: str, contact: Contact) -> list[Push]:
    """Where a contact acts on its partners as written: once, or for each member of a set."""
    a, b = touching(sketch.drawing, contact.partners, f"contacts.{name}.touch")
    swapped = is_swapped(a, b)
    if swapped:
        a, b = b, a
    members = [a]
    if a.kind == "set":
        assert isinstance(a.mark, tuple)
        members = [Partner(a.owner, "point", key, a.where) for key in a.mark]
    return [
        _contact_push(sketch, one, b, swapped, _written_turn(sketch, name, contact, b)) for one in members
    ]


def _written_turn(sketch: Sketch, name: str, contact: Contact, b: Partner) -> float | None:
    """Direction of the surface that a normal stands for: it turns with the second of two points."""
    if contact.normal is None:
        return None
    drawing = sketch.drawing
    normal = drawing.reader.number(contact.normal, f"contacts.{name}.normal", DIMENSIONLESS)
    return sketch.number(normal - drawing.angle(b.owner)) + sketch.angle(b.owner) - math.pi / 2


def _contact_push(sketch: Sketch, a: Partner, b: Partner, swapped: bool, written: float | None) -> Push:
    places = sketch.touching(a, b, ends=True)
    if is_pair(a, b):
        turn = sketch.along_curve(b.owner, as_curve(b), places[1])[1]
        return Push(places[::-1] if swapped else places, turn)
    center = sketch.of_partner(a, b)
    away = center[0] - places[1][0], center[1] - places[1][1]
    turn = math.atan2(away[1], away[0]) - math.pi / 2
    if isinstance(b.mark, LineMark) and math.hypot(*away) < _CLOSE * sketch.pen.inch:
        turn = sketch.number(b.mark.angle) + sketch.angle(b.owner)
    if a.kind == b.kind == "point":
        return Push(places[::-1] if swapped else places, written)
    return Push(places[::-1] if swapped else places, turn)


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


def usual_length(data: SceneData) -> str:
    """The unit of length that the file uses most."""
    found = Counter(_WITH_UNIT.findall(repr(data.model_dump(exclude={"title", "description", "ask"}))))
    used = [unit for unit in _LENGTHS if found[unit]]
    return max(used, key=lambda unit: found[unit]) if used else "m"


def is_imperial(data: SceneData) -> bool:
    """Whether lengths of the file are feet and inches: its forces are then pounds."""
    return usual_length(data) in _IMPERIAL
