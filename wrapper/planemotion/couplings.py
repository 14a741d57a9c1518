"""Couplings: gears, belts, cords and motors, to rows of the kernel's joint and contact tables.

Gears and belts hold both ways: they are joints of the kernel.  A cord pulls only: each of its straight
strands is a contact whose gap is its slack.  Driven bodies are held to the ground by what is prescribed.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass

from . import _layout as layout
from .drawing import GROUND, Drawing, PointRef
from .errors import SceneError
from .joints import side
from .marks import distance
from .node import ZERO, Node, Number
from .parameters import Reader
from .partners import Partner, different, drawn_pair, kernel_circle, pairs, partner
from .scene import Body, Coupling, Value
from .tables import Tables
from .timed import over_time
from .units import ANGULAR_VELOCITY, DIMENSIONLESS, LENGTH, VELOCITY, Dimension

_RIM = re.compile(r"(\S+)\s+(cw|ccw)")
_SENSES = {"ccw": 1, "cw": -1}


@dataclass(frozen=True)
class CouplingInfo:
    """What measures and events need to know of a coupling.

    `index`: its row of the joint table; None for a cord, whose strands are the contacts `indices`.  `owners`:
    of its partners; of a cord, those of each strand.
    """

    kind: str
    index: int | None
    indices: tuple[int, ...]
    owners: tuple[tuple[str, str], ...]

    @property
    def bodies(self) -> tuple[str, ...]:
        """All partners, each once."""
        return tuple(dict.fromkeys(owner for pair in self.owners for owner in pair))


class Couplings:
    """Adds couplings to the tables, one method for each kind."""

    def __init__(self, drawing: Drawing, reader: Reader, tables: Tables) -> None:
        self.drawing = drawing
        self.reader = reader
        self.tables = tables

    def add(self, name: str, coupling: Coupling) -> CouplingInfo:
        """Adds the rows of one coupling.  Raises SceneError for partners and options that do not fit."""
        path = f"couplings.{name}"
        try:
            info: CouplingInfo = getattr(self, f"_{coupling.kind}")(coupling, path)
        except SceneError as error:
            raise error.at(path=path) from None
        return info

    def drive(self, name: str, body: Body) -> None:
        """Holds a driven body to what is prescribed: the velocity of its mass centre, and its spin."""
        driven = body.driven
        assert driven is not None
        path = f"bodies.{name}.driven"
        x, y = self.reader.vector(driven.velocity, f"{path}.velocity", VELOCITY, self._over_time)
        origin = self.drawing.point_at(GROUND, (ZERO, ZERO), path)
        centre = self.drawing.point(PointRef(name, "G"))
        self._joint(layout.PM_JOINT_DRIVE, centre, origin, path, programs=(x, y))
        if body.turns:
            omega = self._over_time(driven.omega, f"{path}.omega", ANGULAR_VELOCITY)
            index = self.drawing.body_index(name)
            self._joint(layout.PM_JOINT_RATE, index, layout.PM_GROUND, path, programs=(omega,))
        elif driven.omega != 0:
            raise SceneError("a particle does not turn; leave out omega", path=f"{path}.omega")

    def _gears(self, coupling: Coupling, path: str) -> CouplingInfo:
        assert coupling.gears is not None
        a, b = self._circles(coupling.gears, f"{path}.gears")
        value = self.tables.value(side(self.drawing, a, b), f"{path}.gears")
        circles = kernel_circle(self.drawing, a), kernel_circle(self.drawing, b)
        index = self._joint(layout.PM_JOINT_GEARS, *circles, path, value)
        return CouplingInfo("gears", index, (), ((a.owner, b.owner),))

    def _belt(self, coupling: Coupling, path: str) -> CouplingInfo:
        assert coupling.belt is not None
        a, b = self._circles(coupling.belt, f"{path}.belt")
        value = self.tables.value(Number(-1.0 if coupling.crossed else 1.0), f"{path}.crossed")
        circles = kernel_circle(self.drawing, a), kernel_circle(self.drawing, b)
        index = self._joint(layout.PM_JOINT_BELT, *circles, path, value)
        return CouplingInfo("belt", index, (), ((a.owner, b.owner),))

    def _rate(self, coupling: Coupling, path: str) -> CouplingInfo:
        assert coupling.rate is not None
        if coupling.value is None:
            raise SceneError(
                "the spin of the first body relative to the second is wanted", path=f"{path}.value"
            )
        first, second = coupling.rate
        if first == second:
            raise SceneError("two different bodies are wanted", path=f"{path}.rate")
        bodies = [self._turning(name, f"{path}.rate[{index}]") for index, name in enumerate((first, second))]
        value = self._over_time(coupling.value, f"{path}.value", ANGULAR_VELOCITY)
        index = self._joint(layout.PM_JOINT_RATE, bodies[0], bodies[1], path, programs=(value,))
        return CouplingInfo("rate", index, (), ((first, second),))

    def _cord(self, coupling: Coupling, path: str) -> CouplingInfo:
        assert coupling.cord is not None
        stops = [self._stop(text, f"{path}.cord[{index}]") for index, text in enumerate(coupling.cord)]
        spans = list(itertools.pairwise(stops))
        for (a, _), (b, _) in spans:
            different(a, b)
        slack = self._slack(coupling, [one for one, _ in stops], path)
        restitution = self.reader.number(coupling.restitution, f"{path}.restitution", DIMENSIONLESS)
        indices = []
        for number, ((a, sense_a), (b, sense_b)) in enumerate(spans):
            row = dict.fromkeys(range(layout.PM_CONTACT_COLUMNS), layout.PM_NONE)
            row[layout.PM_CONTACT_KIND] = layout.PM_CONTACT_CORD
            row[layout.PM_CONTACT_A] = self._end(a)
            row[layout.PM_CONTACT_B] = self._end(b)
            row[layout.PM_CONTACT_RESTITUTION] = self.tables.value(restitution, f"{path}.restitution")
            row[layout.PM_CONTACT_FRICTION] = layout.PM_FRICTION_SMOOTH
            row[layout.PM_CONTACT_SLACK] = self.tables.value(
                slack, f"{path}.{'length' if coupling.length is not None else 'slack'}"
            )
            row[layout.PM_CONTACT_LAW] = layout.PM_LAW_NEWTON
            row[layout.PM_CONTACT_SENSE_A] = sense_a
            row[layout.PM_CONTACT_SENSE_B] = sense_b
            row[layout.PM_CONTACT_CAPTURE] = layout.PM_CAPTURE_NONE
            label = path if len(spans) == 1 else f"{path}[{number + 1}]"
            indices.append(self.tables.add(layout.PM_TABLE_CONTACT, row, label))
        owners = tuple((a.owner, b.owner) for (a, _), (b, _) in spans)
        return CouplingInfo("cord", None, tuple(indices), owners)

    # ---- reading ----

    def _circles(self, names: tuple[str, ...], path: str) -> tuple[Partner, Partner]:
        return pairs(names, path, lambda text, where, _index: partner(self.drawing, text, where, "circle"))

    def _stop(self, text: str, where: str) -> tuple[Partner, int]:
        """A point, or a rim with the sense in which it is passed."""
        match = _RIM.fullmatch(text.strip())
        if match is not None:
            return partner(self.drawing, match[1], where, "circle"), _SENSES[match[2]]
        found = partner(self.drawing, text.strip(), where, "point", "circle")
        if found.kind == "circle":
            reason = f'in which sense is it passed, going down the list? "{text} cw" or "{text} ccw"'
            raise SceneError(reason, path=where, value=text)
        return found, 1

    def _slack(self, coupling: Coupling, stops: Sequence[Partner], path: str) -> Node:
        """How much longer the cord is than drawn."""
        if coupling.length is None and coupling.slack is None:
            return ZERO
        if coupling.length is not None and coupling.slack is not None:
            raise SceneError("give length or slack, not both", path=path)
        key = "length" if coupling.length is not None else "slack"
        if len(stops) > 2:
            reason = "a cord that grips a rim between its ends is taut as drawn"
            raise SceneError(reason, path=f"{path}.{key}")
        if coupling.slack is not None:
            return self.reader.number(coupling.slack, f"{path}.slack", LENGTH)
        assert coupling.length is not None
        if any(one.kind == "circle" for one in stops):
            reason = "a cord that is wound on a rim has no length; give its slack"
            raise SceneError(reason, path=f"{path}.length")
        length = self.reader.number(coupling.length, f"{path}.length", LENGTH)
        return length - distance(*drawn_pair(self.drawing, *stops))

    def _end(self, one: Partner) -> int:
        """The kernel circle of a stop."""
        if not one.anywhere:
            return kernel_circle(self.drawing, one)
        reason = "a point of the ground is wanted, such as ground.S"
        raise SceneError(reason, path=one.where, value=GROUND)

    def _turning(self, name: str, where: str) -> int:
        """The kernel's index of a body that turns, or of the ground."""
        try:
            if name != GROUND and not self.drawing.body_of(name).turns:
                raise SceneError("a particle does not turn; a body with an inertia is wanted")
        except SceneError as error:
            raise error.at(path=where, value=name) from None
        return self.drawing.body_index(name)

    def _over_time(self, written: Value, where: str, wanted: Dimension) -> Node:
        return over_time(self.reader, self.tables, written, where, wanted)

    def _joint(
        self,
        kind: int,
        a: int,
        b: int,
        path: str,
        value: int = layout.PM_NONE,
        programs: Sequence[Node] = (),
    ) -> int:
        columns = (layout.PM_JOINT_PROGRAM_X, layout.PM_JOINT_PROGRAM_Y)
        row = {layout.PM_JOINT_KIND: kind, layout.PM_JOINT_A: a, layout.PM_JOINT_B: b}
        row |= {layout.PM_JOINT_VALUE: value} | dict.fromkeys(columns, layout.PM_NONE)
        for column, program in zip(columns, programs, strict=False):
            row[column] = self.tables.program(program, path)
        return self.tables.add(layout.PM_TABLE_JOINT, row, path)
