"""Forces: springs, dampers, applied forces and couples, to rows of the kernel's force table."""

from __future__ import annotations

from dataclasses import dataclass

from . import _layout as layout
from .drawing import GROUND, Drawing
from .errors import SceneError
from .expression import dimension, parse
from .marks import distance
from .node import Node
from .parameters import Reader
from .partners import Partner, drawn_pair, pairs, partner, point_pair
from .scene import Force, Value, Vector
from .tables import Tables
from .timed import empty_measure, over_time
from .units import DAMPING, DIMENSIONLESS, FORCE, LENGTH, MOMENT, POWER, STIFFNESS, TIME, Dimension

ROTARY_DAMPING = MOMENT * TIME
_ROTARY = (layout.PM_FORCE_TORSION, layout.PM_FORCE_ROTARY_DAMPER, layout.PM_FORCE_COUPLE)
_SPRING_ONLY = {None: layout.PM_SPRING_BOTH, "pull": layout.PM_SPRING_PULL, "push": layout.PM_SPRING_PUSH}


@dataclass(frozen=True)
class ForceInfo:
    """What measures need to know of a force: its row, the owners of its partners, whether it is a couple."""

    index: int
    owners: tuple[str, ...]
    rotary: bool


class Forces:
    """Adds forces to the tables, one method for each kind."""

    def __init__(self, drawing: Drawing, reader: Reader, tables: Tables) -> None:
        self.drawing = drawing
        self.reader = reader
        self.tables = tables

    def add(self, name: str, force: Force) -> ForceInfo:
        """Adds the row of one force.  Raises SceneError for partners and options that do not fit."""
        path = f"forces.{name}"
        row = dict.fromkeys(range(layout.PM_FORCE_COLUMNS), layout.PM_NONE)
        row[layout.PM_FORCE_OPTION] = 0
        try:
            owners = getattr(self, f"_{force.kind}")(force, path, row)
        except SceneError as error:
            raise error.at(path=path) from None
        rotary = row[layout.PM_FORCE_KIND] in _ROTARY
        return ForceInfo(self.tables.add(layout.PM_TABLE_FORCE, row, path), owners, rotary)

    def _spring(self, force: Force, path: str, row: dict[int, int]) -> tuple[str, ...]:
        assert force.spring is not None
        a, b = self._points(force.spring, f"{path}.spring")
        stiffness = self._wanted(force.stiffness, f"{path}.stiffness", STIFFNESS)
        if force.free_length is not None:
            free = self.reader.number(force.free_length, f"{path}.free_length", LENGTH)
        else:
            free = distance(*drawn_pair(self.drawing, a, b))
        row[layout.PM_FORCE_KIND] = layout.PM_FORCE_SPRING
        row[layout.PM_FORCE_A], row[layout.PM_FORCE_B] = point_pair(self.drawing, a, b)
        row[layout.PM_FORCE_VALUE_1] = self.tables.value(stiffness, f"{path}.stiffness")
        row[layout.PM_FORCE_VALUE_2] = self.tables.value(free, f"{path}.free_length")
        row[layout.PM_FORCE_OPTION] = _SPRING_ONLY[force.only]
        return a.owner, b.owner

    def _torsion(self, force: Force, path: str, row: dict[int, int]) -> tuple[str, ...]:
        assert force.torsion is not None
        a, b = self._bodies(force.torsion, f"{path}.torsion")
        # N*m for each radian: a moment.
        stiffness = self._wanted(force.stiffness, f"{path}.stiffness", MOMENT)
        if force.free_angle is not None:
            free = self.reader.number(force.free_angle, f"{path}.free_angle", DIMENSIONLESS)
        else:
            free = self.drawing.angle(a) - self.drawing.angle(b)
        row[layout.PM_FORCE_KIND] = layout.PM_FORCE_TORSION
        row[layout.PM_FORCE_A], row[layout.PM_FORCE_B] = (self.drawing.body_index(one) for one in (a, b))
        row[layout.PM_FORCE_VALUE_1] = self.tables.value(stiffness, f"{path}.stiffness")
        row[layout.PM_FORCE_VALUE_2] = self.tables.value(free, f"{path}.free_angle")
        return a, b

    def _damper(self, force: Force, path: str, row: dict[int, int]) -> tuple[str, ...]:
        assert force.damper is not None
        where = f"{path}.rate"
        if force.rate is None:
            raise SceneError("a rate is wanted", path=where)
        # Bare names are bodies or their mass centres: the unit of the rate tells.
        bare = not any("." in one for one in force.damper)
        found = dimension(parse(force.rate, where=where), self.reader.parameters.dimension_of)
        if bare and found == ROTARY_DAMPING:
            first, second = self._bodies(force.damper, f"{path}.damper")
            rate = self.reader.number(force.rate, where, ROTARY_DAMPING)
            row[layout.PM_FORCE_KIND] = layout.PM_FORCE_ROTARY_DAMPER
            row[layout.PM_FORCE_A], row[layout.PM_FORCE_B] = (
                self.drawing.body_index(one) for one in (first, second)
            )
            owners = first, second
        else:
            a, b = self._points(force.damper, f"{path}.damper")
            rate = self.reader.number(force.rate, where, DAMPING)
            row[layout.PM_FORCE_KIND] = layout.PM_FORCE_DAMPER
            row[layout.PM_FORCE_A], row[layout.PM_FORCE_B] = point_pair(self.drawing, a, b)
            owners = a.owner, b.owner
        row[layout.PM_FORCE_VALUE_1] = self.tables.value(rate, where)
        return owners

    def _force(self, force: Force, path: str, row: dict[int, int]) -> tuple[str, ...]:
        assert force.force is not None
        point = partner(self.drawing, force.force, f"{path}.force", "point")
        if point.owner == GROUND:
            raise SceneError("a point of a body is wanted", path=point.where, value=force.force)
        row[layout.PM_FORCE_KIND] = layout.PM_FORCE_APPLIED
        row[layout.PM_FORCE_A] = self.drawing.point(point.ref)
        axes = GROUND
        if force.power is not None:
            key = "power"
            x, y = self._along_the_motion(force, path, row[layout.PM_FORCE_A])
        else:
            key = "value"
            if not isinstance(force.value, Vector):
                reason = "a vector is wanted: [x, y] or { polar = [size, angle] }"
                raise SceneError(reason, path=f"{path}.value")
            if force.turns_with is not None:
                axes = self._body(force.turns_with, f"{path}.turns_with")
            x, y = self.reader.vector(force.value, f"{path}.value", FORCE, self._over_time)
        row[layout.PM_FORCE_B] = self.drawing.body_index(axes)
        row[layout.PM_FORCE_PROGRAM_X] = self.tables.program(x, f"{path}.{key}")
        row[layout.PM_FORCE_PROGRAM_Y] = self.tables.program(y, f"{path}.{key}")
        return (point.owner,)

    def _couple(self, force: Force, path: str, row: dict[int, int]) -> tuple[str, ...]:
        assert force.couple is not None
        where = f"{path}.couple"
        if isinstance(force.couple, str):
            owners: tuple[str, ...] = (self._body(force.couple, where),)
        else:
            owners = self._bodies(force.couple, where)
        if force.power is not None:
            key = "power"
            value = self._power(force, path) / self._spin(owners, f"{path}.power")
        elif force.value is None or isinstance(force.value, Vector):
            reason = "a number is wanted: the couple, counterclockwise positive"
            raise SceneError(reason, path=f"{path}.value")
        else:
            key = "value"
            value = self._over_time(force.value, f"{path}.value", MOMENT)
        row[layout.PM_FORCE_KIND] = layout.PM_FORCE_COUPLE
        row[layout.PM_FORCE_A] = self.drawing.body_index(owners[0])
        row[layout.PM_FORCE_B] = self.drawing.body_index(owners[1] if len(owners) > 1 else GROUND)
        row[layout.PM_FORCE_PROGRAM_X] = self.tables.program(value, f"{path}.{key}")
        return owners

    # ---- of given power ----

    def _power(self, force: Force, path: str) -> Node:
        """What does this work in each second: it goes the way of the motion, or against it (power < 0)."""
        assert force.power is not None
        for key in ("value", "turns_with"):
            if getattr(force, key) is not None:
                raise SceneError(f"give power or {key}, not both", path=f"{path}.power")
        return self._over_time(force.power, f"{path}.power", POWER)

    def _along_the_motion(self, force: Force, path: str, point: int) -> tuple[Node, Node]:
        """P v / v^2."""
        power, where = self._power(force, path), f"{path}.power"
        parts = (layout.PM_PART_X, layout.PM_PART_Y)
        x, y = (self._measure(layout.PM_MEASURE_VELOCITY, point, where, part) for part in parts)
        size = x * x + y * y
        return power * x / size, power * y / size

    def _spin(self, owners: tuple[str, ...], where: str) -> Node:
        """The spin of the first body relative to the second."""
        spins = [
            self._measure(layout.PM_MEASURE_OMEGA, self.drawing.body_index(owner), where)
            for owner in owners
            if owner != GROUND
        ]
        if owners[0] == GROUND:
            return -spins[0]
        return spins[0] if len(spins) == 1 else spins[0] - spins[1]

    def _measure(self, kind: int, a: int, where: str, part: int = layout.PM_PART_NONE) -> Node:
        row = empty_measure(kind) | {layout.PM_MEASURE_A: a, layout.PM_MEASURE_PART: part}
        return self.tables.measure_leaf(row, where)

    # ---- reading ----

    def _points(self, names_: tuple[str, ...], path: str) -> tuple[Partner, Partner]:
        return pairs(names_, path, lambda text, where, _index: partner(self.drawing, text, where, "point"))

    def _bodies(self, names_: tuple[str, ...], path: str) -> tuple[str, str]:
        first, second = (self._body(name, f"{path}[{index}]") for index, name in enumerate(names_))
        if first == second:
            raise SceneError("two different bodies are wanted", path=path)
        return first, second

    def _body(self, name: str, where: str) -> str:
        """A body that turns, or the ground."""
        try:
            if name != GROUND and not self.drawing.body_of(name).turns:
                raise SceneError("a particle does not turn; a body with an inertia is wanted")
        except SceneError as error:
            raise error.at(path=where, value=name) from None
        return name

    def _wanted(self, written: Value | None, where: str, wanted: Dimension) -> Node:
        if written is None:
            raise SceneError("it is wanted and left out", path=where)
        return self.reader.number(written, where, wanted)

    def _over_time(self, written: Value, where: str, wanted: Dimension) -> Node:
        return over_time(self.reader, self.tables, written, where, wanted)
