"""The drawn scene as rows of the kernel's tables: bodies, points, lines, circles, curves and rows, each mark
once.

Lengths, offsets and angles "as drawn" are composed from the expressions of drawing.py, so that a sweep of a
parameter moves the drawing.
"""

from __future__ import annotations

from .. import _layout as layout
from ..base.errors import Faults, SceneError
from ..language.leaves import names, operands, with_operands
from ..language.tree import ZERO, Node
from ..model.tables import Body
from ..model.words import GROUND
from .curves import PLACE, CurveMark
from .drawing import Drawing, PointRef
from .marks import CircleMark, LineMark, Mass, Pair, RowMark, mass_of
from .packing import Tables, empty_measure


def _closing(mark: CurveMark) -> int:
    if mark.endless:
        return layout.PM_CURVE_ENDLESS
    return layout.PM_CURVE_ROUND if mark.closed else layout.PM_CURVE_WITH_ENDS


class DrawnRows:
    """The rows of a drawing in the tables: bodies, named points, and further marks when they are asked for.

    `masses`: mass and inertia of each body.
    """

    def __init__(self, drawing: Drawing, tables: Tables) -> None:
        self.drawing = drawing
        self.tables = tables
        self.masses: dict[str, Mass] = {}
        self._curves: dict[str, int] = {}
        self._points: dict[tuple[int, Node, Node], int] = {}
        Faults().make(drawing.bodies, self._add_body)
        self._add_all_points()

    def point(self, ref: PointRef) -> int:
        """The kernel's index of a point."""
        return self.point_at(
            ref.owner, self.drawing.local(ref), f"{self.drawing.marks(ref.owner).path}.points.{ref.name}"
        )

    def point_at(self, owner: str, local: Pair, where: str) -> int:
        """The kernel's index of a place of a body, given in its axes from G."""
        body = self.drawing.body_index(owner)
        x, y = (self.tables.leaf(part, where) for part in local)
        key = (body, x, y)
        if key not in self._points:
            row = {
                layout.PM_POINT_BODY: body,
                layout.PM_POINT_X: self.tables.value(x, where),
                layout.PM_POINT_Y: self.tables.value(y, where),
            }
            self._points[key] = self.tables.add(layout.PM_TABLE_POINT, row, where)
        return self._points[key]

    def place(self, point: int) -> tuple[int, Pair]:
        """The body of a kernel point, and its place there from G."""
        body, x, y = next(key for key, index in self._points.items() if index == point)
        return body, (x, y)

    def line(self, owner: str, mark: LineMark, where: str) -> int:
        """A kernel line of that mark."""
        row = {
            layout.PM_LINE_POINT: self.point_at(
                owner, self.drawing.from_mass_center(owner, mark.through), where
            ),
            layout.PM_LINE_ANGLE: self.tables.value(mark.angle, where),
        }
        return self.tables.add(layout.PM_TABLE_LINE, row, where)

    def circle(self, owner: str, mark: CircleMark, where: str) -> int:
        """A kernel circle of that mark."""
        return self.circle_at(
            self.point_at(owner, self.drawing.from_mass_center(owner, mark.center), where), mark.radius, where
        )

    def circle_at(self, point: int, radius: Node, where: str) -> int:
        """A kernel circle round a kernel point; radius 0 makes it the point itself."""
        row = {layout.PM_CIRCLE_POINT: point, layout.PM_CIRCLE_RADIUS: self.tables.value(radius, where)}
        return self.tables.add(layout.PM_TABLE_CIRCLE, row, where)

    def row(self, mark: RowMark, where: str) -> int:
        """A kernel row of ground points."""
        row = {
            layout.PM_PATTERN_POINT: self.point_at(GROUND, mark.start, where),
            layout.PM_PATTERN_STEP_X: self.tables.value(mark.step[0], where),
            layout.PM_PATTERN_STEP_Y: self.tables.value(mark.step[1], where),
            layout.PM_PATTERN_COUNT: self.tables.value(mark.count, where),
        }
        return self.tables.add(layout.PM_TABLE_PATTERN, row, where)

    def curve(self, owner: str, mark: CurveMark, where: str) -> int:
        """A kernel curve of that mark, once for each."""
        if where not in self._curves:
            self._curves[where] = self._new_curve(owner, mark, where)
        return self._curves[where]

    def _new_curve(self, owner: str, mark: CurveMark, where: str) -> int:
        place = self.tables.measure_leaf(empty_measure(layout.PM_MEASURE_PLACE), where)

        def along(node: Node) -> Node:
            """With numbers of the case for what does not change along the curve."""
            if PLACE not in names(node):
                return self.tables.leaf(node, where)
            return place if node == PLACE else with_operands(node, [along(one) for one in operands(node)])

        programs = (self.tables.program(along(part), where) for part in (mark.x, mark.y))
        origin = self.drawing.from_mass_center(owner, (ZERO, ZERO))
        row = {layout.PM_CURVE_POINT: self.point_at(owner, origin, where)}
        row |= dict(zip((layout.PM_CURVE_X, layout.PM_CURVE_Y), programs, strict=True))
        for column, key, bound in zip(
            (layout.PM_CURVE_FROM, layout.PM_CURVE_TO), ("from", "to"), mark.bounds, strict=True
        ):
            row[column] = self.tables.value(bound, f"{where}.{key}")
        row |= {layout.PM_CURVE_CLOSED: _closing(mark), layout.PM_CURVE_SIDE: mark.side}
        knots = layout.PM_NONE if mark.knots is None else self.tables.piecewise(mark.knots)
        row[layout.PM_CURVE_KNOTS] = knots
        return self.tables.add(layout.PM_TABLE_CURVE, row, where)

    def _add_body(self, name: str, body: Body) -> None:
        path = f"bodies.{name}"
        try:
            pose = self.drawing.pose(name)
            mass = mass_of(self.drawing.reader, name, body, self.drawing.length(name))
        except SceneError as error:
            raise error.at(path=path) from None
        self.masses[name] = mass
        value = self.tables.value
        row = {
            layout.PM_BODY_ROTATES: int(body.rotates),
            layout.PM_BODY_MASS: value(
                mass.mass, f"{path}.{'weight' if body.weight is not None else 'mass'}"
            ),
            layout.PM_BODY_INERTIA: value(
                mass.inertia, f"{path}.{'gyration' if body.gyration is not None else 'inertia'}"
            ),
            layout.PM_BODY_X: value(pose.x, f"{path}.at"),
            layout.PM_BODY_Y: value(pose.y, f"{path}.at"),
            layout.PM_BODY_ANGLE: value(pose.angle, f"{path}.angle"),
        }
        self.tables.add(layout.PM_TABLE_BODY, row, path)

    def _add_all_points(self) -> None:
        """Every named point, so that pictures and histories know them all."""
        for owner in (*self.drawing.bodies, GROUND):
            marks = self.drawing.marks(owner)
            for name in marks.points:
                if name not in marks.unnamed:
                    self.point(PointRef(owner, name))
