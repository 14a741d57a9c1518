"""Measures: from addresses to the kernel's measure table.

An address becomes an expression over measures: most are one row of the table; what the kernel has no row for
(a force in the axes of a body, a direction that turns, the sum over the members of a set) is composed of
several.  `Measures.lower` does so for every leaf of an expression and checks its dimensions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from math import pi

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawn_rows import DrawnRows
from ..geometry.packing import Tables
from ..geometry.parameters import Reader
from ..language.address import Address, is_energy
from ..language.dimensions import (
    ANGULAR_MOMENTUM,
    ANGULAR_VELOCITY,
    DIMENSIONLESS,
    ENERGY,
    IMPULSE,
    INERTIA,
    TIME,
    Dimension,
)
from ..language.homogeneity import dimension
from ..language.leaves import Leaf, names, substitute
from ..language.tree import Name, Node, sqrt
from ..model import words
from ..model.readers import Value
from ..model.words import GROUND
from .measure_bodies import BodyMeasures
from .measure_elements import ElementMeasures
from .measure_rows import MeasureRows, Reading, Scope

_ENERGY: dict[str, int] = {
    "kinetic": layout.PM_MEASURE_KINETIC,
    "potential": layout.PM_MEASURE_POTENTIAL,
    "total": layout.PM_MEASURE_TOTAL,
    "lost": layout.PM_MEASURE_LOST,
}
_SPIN: dict[str, tuple[int, Dimension]] = {
    "omega": (layout.PM_MEASURE_SPIN_OMEGA, ANGULAR_VELOCITY),
    "angle": (layout.PM_MEASURE_SPIN_ANGLE, DIMENSIONLESS),
    "momentum": (layout.PM_MEASURE_SPIN_MOMENTUM, ANGULAR_MOMENTUM),
    "inertia": (layout.PM_MEASURE_SPIN_INERTIA, INERTIA),
}
_MODES: dict[str, tuple[int, Dimension]] = {
    "omega": (layout.PM_MEASURE_MODE_OMEGA, ANGULAR_VELOCITY),
    "damping": (layout.PM_MEASURE_MODE_DAMPING, DIMENSIONLESS),
    "count": (layout.PM_MEASURE_MODES_COUNT, DIMENSIONLESS),
    "growth": (layout.PM_MEASURE_MODES_GROWTH, ANGULAR_VELOCITY),
}


class Measures:
    """The measures of a run; `scope` says what has a name."""

    def __init__(self, drawn: DrawnRows, reader: Reader, tables: Tables, scope: Scope) -> None:
        self.drawn = drawn
        self.drawing = drawn.drawing
        self.reader = reader
        self.tables = tables
        self.scope = scope
        self.rows = MeasureRows(drawn, reader, tables, scope)
        self._bodies = BodyMeasures(self.rows)
        self._elements = ElementMeasures(self.rows)
        self._readings: dict[Leaf, Reading] = {}
        self._answers: Mapping[str, Reading] = {}
        self._of_instant = False

    @contextmanager
    def answered(self, answers: Mapping[str, Reading]) -> Iterator[None]:
        """Meanwhile names of asks stand for their answers."""
        self._answers = answers
        try:
            yield
        finally:
            self._answers = {}

    @contextmanager
    def of_instant(self, at_instant: bool) -> Iterator[None]:
        """Meanwhile expressions are read at the end or at events alone, or all along."""
        self._of_instant = at_instant
        try:
            yield
        finally:
            self._of_instant = False

    def lower(self, written: Value | Node, where: str) -> Reading:
        """An expression over measures and parameters, made one over the kernel's leaves.

        The dimension of a plain 0, which fits any, is given as dimensionless.
        """
        node = written if isinstance(written, Node) else self.reader.parameters.parse(written, where)
        try:
            found = dimension(node, self.dimension_of)
            lowered = substitute(
                node, lambda leaf: self.reading(leaf).node if self._is_measure(leaf) else leaf
            )
        except SceneError as error:
            # The address at fault is named in the reason, which is needless where it is all that is written.
            reason = error.reason.removeprefix(f'"{written}": ')
            shown = None if isinstance(written, Node) else written
            raise SceneError(reason, path=error.path or where, value=error.value or shown) from None
        return Reading(lowered, found if found is not None else DIMENSIONLESS, self._is_energy(node, found))

    def _is_energy(self, node: Node, found: Dimension | None) -> bool:
        """Whether an expression is an energy by what it reads: a couple has the same dimension."""
        if found != ENERGY:
            return False
        read = [leaf for leaf in names(node) if self._is_measure(leaf) and self.dimension_of(leaf) == ENERGY]
        return bool(read) and all(self._names_energy(leaf) for leaf in read)

    def _names_energy(self, leaf: Leaf) -> bool:
        if isinstance(leaf, Name) and leaf.text in self._answers:
            return self._answers[leaf.text].energy
        return is_energy(str(leaf))

    def dimension_of(self, leaf: Leaf) -> Dimension | None:
        """The dimension of a parameter or of a measure."""
        return (
            self.reading(leaf).dimension
            if self._is_measure(leaf)
            else self.reader.parameters.dimension_of(leaf)
        )

    def knows(self, name: str) -> bool:
        """Whether `name` alone is a parameter, or a measure of the scene."""
        return name in self.reader.parameters.nodes or self._is_measure(Name(name))

    def _is_measure(self, leaf: Leaf) -> bool:
        if isinstance(leaf, Address):
            return True
        if leaf.text in self.reader.parameters.nodes:
            return False  # also a parameter called t: the time is then called time
        return leaf.text in words.SCENE_QUANTITIES or leaf.text in self._answers

    def reading(self, leaf: Leaf) -> Reading:
        """What an address stands for.  Raises SceneError naming the word that is wrong."""
        if isinstance(leaf, Name) and leaf.text in self._answers:
            return self._answers[leaf.text]
        if isinstance(leaf, Address) and leaf.thing == "modes" and not self._of_instant:
            reason = "modes are those of an instant: ask for them at the end or at an event"
            raise SceneError(f'"{leaf}": {reason}')
        if leaf not in self._readings:
            address = leaf if isinstance(leaf, Address) else Address(leaf.text)
            self._readings[leaf] = self._read(address)
        return self._readings[leaf]

    def _read(self, address: Address) -> Reading:
        thing = address.thing
        if thing in words.SCENE_QUANTITIES:
            return self._scene(address)
        if thing in self.drawing.bodies or thing == GROUND:
            return self._bodies.read(address)
        if thing in self.scope.joints:
            return self._elements.joint(address, self.scope.joints[thing])
        if thing in self.scope.couplings:
            return self._elements.coupling(address, self.scope.couplings[thing])
        if thing in self.scope.contacts:
            return self._elements.contact(address, self.scope.contacts[thing])
        if thing in self.scope.forces:
            return self._elements.force(address, self.scope.forces[thing])
        if thing in self.scope.events:
            return self._elements.event(address, self.scope.events[thing])
        if thing in self.scope.inactive:
            raise SceneError(f'"{thing}" is not active in this run')
        known = (
            *self.drawing.bodies,
            *self.scope.joints,
            *self.scope.couplings,
            *self.scope.contacts,
        )
        known = (*known, *self.scope.forces)
        known = (*known, *self.scope.events, GROUND, *words.SCENE_QUANTITIES)
        raise SceneError(words.unknown(thing, known, "name"))

    def _scene(self, address: Address) -> Reading:
        match address.thing:
            case "t" | "time":
                self.rows.ends(address, 0)
                self.rows.plain(address, ())
                return Reading(self.rows.leaf(layout.PM_MEASURE_TIME, layout.PM_NONE, address), TIME)
            case "energy":
                quantity = self.rows.quantity(address, words.ENERGIES, "the scene's energy")
                return Reading(self.rows.leaf(_ENERGY[quantity], layout.PM_NONE, address), ENERGY)
            case "spin":
                if not self.tables.rows[layout.PM_TABLE_SPIN]:
                    raise SceneError(f'"{address}": the scene has no [spin]')
                kind, found = _SPIN[self.rows.quantity(address, words.SPIN_QUANTITIES, "the spin")]
                return Reading(self.rows.leaf(kind, layout.PM_NONE, address), found)
            case "modes":
                return self._modes(address)
            case "weight":
                self.rows.ends(address, 0)
                self.rows.plain(address, ())
                self.rows.need_masses(self.drawing.bodies)
                return self.rows.weight(layout.PM_NONE, address)
            case "momentum":
                self.rows.need_masses(self.drawing.bodies)
                kind = layout.PM_MEASURE_MOMENTUM
                return self.rows.vector(address, address.path, [(kind, layout.PM_NONE)], IMPULSE, ("along",))
        self.rows.ends(address, 0)
        self.rows.plain(address, ("about",))
        self.rows.need_masses(self.drawing.bodies)
        leaf = self.rows.leaf(layout.PM_MEASURE_ANGULAR_MOMENTUM, layout.PM_NONE, address)
        return Reading(leaf, ANGULAR_MOMENTUM)

    def _modes(self, address: Address) -> Reading:
        """Of one mode of small motion, or of all of them."""
        self.rows.ends(address, 1)
        known = words.MODES_QUANTITIES if address.member is None else words.MODE_QUANTITIES
        word = address.path[0] if address.path else ""
        if address.member is None and word in words.MODE_QUANTITIES:
            raise SceneError(f'"{address}": which mode? The slowest is modes[1].{word}')
        if address.member is not None and address.member < 1:
            raise SceneError(f'"{address}": modes are counted from 1')
        self.rows.need_masses(self.drawing.bodies)
        if word == "period":
            omega, damping = (self._of_mode(address, one)[0] for one in ("omega", "damping"))
            return Reading(2 * pi / (omega * sqrt(1 - damping * damping)), TIME)
        leaf, found = self._of_mode(address, self.rows.word(address, known, "a mode"))
        return Reading(leaf, found)

    def _of_mode(self, address: Address, word: str) -> tuple[Node, Dimension]:
        kind, found = _MODES[word]
        member = layout.PM_NONE if address.member is None else address.member
        return self.rows.leaf(kind, layout.PM_NONE, address, member=member), found
