"""Where bodies are drawn at the start, as expressions over the parameters.

A body is placed by `at` (a vector, or the point of something else, which is drawn first) and `angle`.  Its
drawn pose is that of its mass centre G = P + R(angle) (G - P), P the placed point.  A body without `at` is
drawn where pins hold it to something placed, else at the origin.

Exact is what is written without `~`; the angle of a body that numbers place is exact too, 0 if left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from .. import _layout as layout
from ..base.arrays import Floats
from ..base.errors import SceneError
from ..language.dimensions import DIMENSIONLESS, LENGTH
from ..language.names import Names
from ..language.tree import ZERO, Node, atan2, cos, sin
from ..model.readers import Vector
from ..model.tables import Body
from ..model.words import GROUND, unknown
from .curves import CurveMark
from .held import Drawn, pinned_points, prescribed_angles
from .marks import Marks, Pair, body_marks, distance, ground_marks, rod_length
from .packing import Tables, at_start
from .parameters import Reader, is_guess

# Relative error up to which two written points may disagree with the body's own size.
_FITS = 1e-6


@dataclass(frozen=True)
class PointRef:
    """A point of a body or of the ground; `name` is as in the file ("" for "where the other is drawn")."""

    owner: str
    name: str

    def __str__(self) -> str:
        return f"{self.owner}.{self.name}" if self.name else self.owner


@dataclass(frozen=True)
class Placed:
    """A point whose place is written: exact in x, in y, or only as a guess."""

    point: str
    position: Pair
    exact: tuple[bool, bool]


@dataclass(frozen=True)
class Pose:
    """The drawn pose of G, the cosine and sine of its angle, and which of it is written as exact."""

    x: Node
    y: Node
    angle: Node
    cos: Node
    sin: Node
    placed: tuple[Placed, ...]
    angle_exact: bool


class Drawing:
    """Names, marks and drawn poses of the bodies of one run and of the ground."""

    def __init__(self, data: Drawn, bodies: Mapping[str, Body], reader: Reader, tables: Tables) -> None:
        self.bodies = dict(bodies)
        self.inactive = {name for name in data.bodies if name not in bodies}
        self.reader = reader
        self.tables = tables
        self.index = {name: index for index, name in enumerate(bodies)}
        self.places: dict[tuple[str, CurveMark], Floats] = {}  # of curves, for pictures
        self._marks: dict[str, Marks] = {GROUND: ground_marks(reader, data.ground)}
        self._lengths: dict[str, Node] = {}
        self._poses: dict[str, Pose] = {}
        self._drawing: list[str] = []
        self._guesses = pinned_points(data, bodies, self.names)
        self._turned = prescribed_angles(data, bodies, self.names)

    # ---- names ----

    @property
    def names(self) -> Names:
        """The names that are no plain words."""
        return self.reader.parameters.tables.names

    def body_of(self, name: str) -> Body:
        """A body by name.  Raises SceneError with the nearest one."""
        if name in self.bodies:
            return self.bodies[name]
        if name in self.inactive:
            raise SceneError(f'body "{name}" is not active in this run')
        raise SceneError(unknown(name, [*self.bodies, GROUND], "body") + self._whose(name))

    def _whose(self, name: str) -> str:
        """Of a word that is no body, but a mark of one or of the ground, how it is written."""
        names: dict[str, set[str]] = {GROUND: set(self.marks(GROUND).names)}
        for owner, body in self.bodies.items():
            names[owner] = {*(body.rod or ()), *body.points, *body.lines, *body.circles, *body.curves}
        whole = [f'"{owner}.{name}"' for owner, known in names.items() if name in known]
        return f"; did you mean {' or '.join(whole)}?" if whole else ""

    def body_index(self, name: str) -> int:
        """The kernel's index of a body or the ground."""
        if name == GROUND:
            return layout.PM_GROUND
        self.body_of(name)
        return self.index[name]

    def marks(self, owner: str) -> Marks:
        """The marks of a body or the ground."""
        if owner not in self._marks:
            body = self.body_of(owner)
            self._marks[owner] = body_marks(self.reader, owner, body, self.length(owner))
        return self._marks[owner]

    def point_ref(self, text: str) -> PointRef:
        """The point that a partner names: "BODY.POINT", "ground.POINT", "BODY" (its G) or "ground"."""
        owner, point = self.names.owner(text)
        if owner == GROUND:
            if point:
                self.marks(GROUND).point(point)
            return PointRef(GROUND, point)
        self.body_of(owner)
        point = point or "G"
        self.marks(owner).point(point)
        return PointRef(owner, point)

    # ---- geometry ----

    def length(self, name: str) -> Node | None:
        """The length of a rod, written or from where its two ends are; None for other bodies."""
        body = self.bodies[name]
        if body.rod is None:
            return None
        if name not in self._lengths:
            self._lengths[name] = self._rod_length(name, body)
        return self._lengths[name]

    def pose(self, name: str) -> Pose:
        """The drawn pose of a body.  Raises SceneError if bodies are placed at each other in a circle."""
        if name not in self._poses:
            self._enter(name)
            self._poses[name] = self._pose(name, self.body_of(name))
            self._drawing.pop()
        return self._poses[name]

    def local(self, ref: PointRef) -> Pair:
        """A point in its body's axes from G; of the ground: scene coordinates."""
        point = self.marks(ref.owner).point(ref.name)
        return point if ref.owner == GROUND else self.from_mass_center(ref.owner, point)

    def from_mass_center(self, owner: str, point: Pair) -> Pair:
        """A point of the body's own axes, from G instead of from the geometric centre."""
        if owner == GROUND:
            return point
        g = self.marks(owner).points["G"]
        return point[0] - g[0], point[1] - g[1]

    def position(self, ref: PointRef) -> Pair:
        """Where a point is drawn."""
        return self.to_scene(ref.owner, self.local(ref))

    def to_scene(self, owner: str, local: Pair) -> Pair:
        """Scene coordinates of a place given in a body's axes from G."""
        if owner == GROUND:
            return local
        pose = self.pose(owner)
        x = pose.x + (pose.cos * local[0] - pose.sin * local[1])
        y = pose.y + (pose.sin * local[0] + pose.cos * local[1])
        return x, y

    def to_body(self, owner: str, position: Pair) -> Pair:
        """A place of the scene in a body's axes from G."""
        if owner == GROUND:
            return position
        pose = self.pose(owner)
        dx, dy = position[0] - pose.x, position[1] - pose.y
        return pose.cos * dx + pose.sin * dy, pose.cos * dy - pose.sin * dx

    def angle(self, owner: str) -> Node:
        """The drawn angle of a body; 0 of the ground."""
        return ZERO if owner == GROUND else self.pose(owner).angle

    # ---- how bodies are placed ----

    def _enter(self, name: str) -> None:
        if name in self._drawing:
            circle = " -> ".join([*self._drawing[self._drawing.index(name) :], name])
            raise SceneError(
                f"bodies that are placed at each other in a circle: {circle}", path=f"bodies.{name}.at"
            )
        self._drawing.append(name)

    def _rod_length(self, name: str, body: Body) -> Node:
        assert body.rod is not None
        written = rod_length(self.reader, name, body)
        if written is not None:
            return self.tables.leaf(written, f"bodies.{name}.length")
        at = dict(body.at.points) if body.at is not None else {}
        if set(at) != set(body.rod):
            reason = "the length of a rod is wanted, or at with both its ends"
            raise SceneError(reason, path=f"bodies.{name}.length")
        self._enter(f"{name}.length")
        ends = [self._place(name, end, at[end]).position for end in body.rod]
        self._drawing.pop()
        return self.tables.leaf(distance(*ends), f"bodies.{name}.length")

    def _place(self, name: str, point: str, written: Vector | str) -> Placed:
        """Where a point of a body is written to be."""
        where = f"bodies.{name}.at" if point == "center" else f"bodies.{name}.at.{point}"
        if isinstance(written, Vector):
            parts = (written.first, written.second)
            guess = is_guess(parts[0]), is_guess(parts[1])
            exact = (not any(guess), not any(guess)) if written.polar else (not guess[0], not guess[1])
            return Placed(point, self.reader.vector(written, where, LENGTH), exact)
        try:
            ref = self.point_ref(written.strip().removeprefix("~"))
            if not ref.name:
                raise SceneError("a point is wanted, such as ground.O")
            exact_there = self.is_exact(ref) and not is_guess(written)
            return Placed(point, self.position(ref), (exact_there, exact_there))
        except SceneError as error:
            raise error.at(path=where, value=written) from None

    def is_exact(self, ref: PointRef) -> bool:
        """Whether a point is where it is written, whatever the assembly does."""
        if ref.owner == GROUND:
            return True
        pose = self.pose(ref.owner)
        if not pose.placed or not all(pose.placed[0].exact):
            return False
        return pose.angle_exact or self.marks(ref.owner).points[pose.placed[0].point] == self.marks(
            ref.owner
        ).point(ref.name)

    def _pose(self, name: str, body: Body) -> Pose:
        marks = self.marks(name)
        path = f"bodies.{name}"
        placed = [self._place(name, point, written) for point, written in body.at.points] if body.at else []
        if not placed and body.driven is not None and body.driven.at is not None:
            placed = [self._driven(name, *body.driven.at.points[0])]
        for point, _ in body.at.points if body.at else ():
            if point not in marks.points:
                raise SceneError(marks.has_no("point", point, marks.points), path=f"{path}.at.{point}")
        if not placed:
            guesses = self._guesses.get(name, ())[: 1 if body.angle is not None else 2]
            placed = [self._guess(point, partner) for point, partner in guesses if point in marks.points]
        first = placed[0] if placed else Placed("center", (ZERO, ZERO), (False, False))
        angle, exact = self._angle(name, body, placed)
        angle = self.tables.leaf(angle, f"{path}.angle")
        c, s = (self.tables.leaf(part, f"{path}.angle") for part in (cos(angle), sin(angle)))
        g, p = marks.points["G"], marks.points[first.point]
        dx, dy = g[0] - p[0], g[1] - p[1]
        x = self.tables.leaf(first.position[0] + (c * dx - s * dy), f"{path}.at")
        y = self.tables.leaf(first.position[1] + (s * dx + c * dy), f"{path}.at")
        return Pose(x, y, angle, c, s, tuple(placed), exact)

    def _driven(self, name: str, point: str, written: Vector) -> Placed:
        """A point drawn where its drive holds it at t = 0; the drive itself holds it there, too."""
        read = partial(at_start, self.reader)
        where = f"bodies.{name}.driven.at"
        return Placed(point, self.reader.vector(written, where, LENGTH, read), (False, False))

    def _guess(self, point: str, partner: str) -> Placed:
        """A point drawn where a pin holds it."""
        return Placed(point, self.position(self.point_ref(partner)), (False, False))

    def _angle(self, name: str, body: Body, placed: list[Placed]) -> tuple[Node, bool]:
        """The drawn angle, and whether it is written as exact."""
        path = f"bodies.{name}.angle"
        if not body.rotates:
            if body.angle is not None:
                raise SceneError("a particle does not rotate; leave out angle", path=path, value=body.angle)
            return ZERO, True
        if len(placed) == 2:
            if body.angle is not None:
                raise SceneError(
                    "the two points of at give the angle; leave it out", path=path, value=body.angle
                )
            self._check_fit(name, placed)
            a, b = (self.marks(name).points[one.point] for one in placed)
            own = atan2(b[1] - a[1], b[0] - a[0])
            p, q = (one.position for one in placed)
            exact = all(placed[0].exact) and all(placed[1].exact)
            return atan2(q[1] - p[1], q[0] - p[0]) - own, exact
        if body.angle is None and name in self._turned:
            written, where, sign = self._turned[name]
            return sign * at_start(self.reader, written, where, DIMENSIONLESS), False
        if body.angle is None:
            # A body that numbers place is drawn at angle 0; one at another's point is found from the joints.
            at = body.at.points if body.at is not None else ()
            return ZERO, any(isinstance(written, Vector) for _, written in at)
        return self.reader.number(body.angle, path, DIMENSIONLESS), not is_guess(body.angle)

    def _check_fit(self, name: str, placed: list[Placed]) -> None:
        """Two points written with `at` must be as far apart as they are on the body."""
        if not all(one.exact == (True, True) for one in placed):
            return
        own = distance(*(self.marks(name).points[one.point] for one in placed))
        drawn = distance(*(one.position for one in placed))
        off, allowed = own - drawn, own * _FITS
        if not self.tables.is_positive(allowed * allowed - off * off):
            a, b = (one.point for one in placed)
            here, there = (self.tables.default(length) for length in (drawn, own))
            reason = f"{a} and {b} are {here:.6g} m apart here and {there:.6g} m on the body; they must fit"
            raise SceneError(reason, path=f"bodies.{name}.at")
