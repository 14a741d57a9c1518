"""The columns of a history - positions, velocities, energies, reactions, or what is asked for - and the
programs that tell what happened at its instants."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawing import Drawing
from ..geometry.packing import Tables
from ..language.address import Address
from ..language.leaves import names
from ..model.tables import Ask
from ..model.words import ASK_WORDS
from .elements import CouplingInfo
from .measure_rows import Scope
from .measures import Measures

_OF_BODY = ("x", "y", "velocity.x", "velocity.y")
_OF_TURNING_BODY = ("angle", "omega")
_OF_FORCE = ("force.x", "force.y")
_OF_BLOW = ("impulse.x", "impulse.y")
_OF_CONTACT = ("gap", "normal", "friction")
_OF_SPIN = ("spin.omega", "spin.inertia")
_ENERGIES = ("kinetic", "potential", "total")
# What tells of an instant which events fired, and which contacts were struck, closed or opened.
_OF_EVENT_AT_INSTANT = ("count",)
_OF_CONTACT_AT_INSTANT = ("closed", "impulse.x", "impulse.y")

Columns = dict[str, tuple[int, str]]


class HistoryColumns:
    """Makes programs of what is recorded; a column is its name -> program and SI unit."""

    def __init__(self, measures: Measures, tables: Tables, scope: Scope, drawing: Drawing) -> None:
        self.measures = measures
        self.tables = tables
        self.scope = scope
        self.drawing = drawing

    def everything(self) -> Columns:
        """Motion, energies and all reactions."""
        return self.there((*self._motion(), *self._reactions(), *self._energies()))

    def of_asks(self, asks: Mapping[str, Ask]) -> Columns:
        """Motion and energies; reactions of that of which an ask reads something."""
        read = {leaf.thing for ask in asks.values() for leaf in self._addresses(ask)}
        reactions = (one for one in self._reactions() if self.drawing.names.owner(one)[0] in read)
        return self.there((*self._motion(), *reactions, *self._energies()))

    def shown(self) -> Columns:
        """Motion, energies, and forces and impulses by their parts: what a picture that moves shows."""
        joints, contacts, forces = self.scope.joints, self.scope.contacts, self.scope.forces
        pushes = [f"{name}.{part}" for name in (*joints, *contacts, *forces) for part in _OF_FORCE]
        blows = [f"{name}.{part}" for name in (*joints, *contacts) for part in _OF_BLOW]
        return self.there((*self._motion(), *pushes, *blows, *self._energies()))

    def chosen(self, written: Sequence[str]) -> Columns:
        """Expressions, each a column by its text.  Raises SceneError for one that cannot be read."""
        return {text: self._column(text) for text in written}

    def instants(self) -> Columns:
        """What `engine.history` tells instants by; velocities to see whether there was a blow."""
        counts = [f"{name}.{word}" for name in self.scope.events for word in _OF_EVENT_AT_INSTANT]
        blows = [f"{name}.{word}" for name in self.scope.contacts for word in _OF_CONTACT_AT_INSTANT]
        return self.there((*counts, *blows, *(one for one in self._motion() if _is_velocity(one))))

    def _motion(self) -> Iterator[str]:
        for name, body in self.drawing.bodies.items():
            for quantity in (*_OF_BODY, *(_OF_TURNING_BODY if body.rotates else ())):
                yield f"{name}.{quantity}"

    def _reactions(self) -> Iterator[str]:
        for name, joint in self.scope.joints.items():
            yield from (f"{name}.{quantity}" for quantity in joint.joint.columns)
        for name, coupling in self.scope.couplings.items():
            yield from (f"{name}.{quantity}" for quantity in _coupling_quantities(coupling))
        for name in self.scope.contacts:
            yield from (f"{name}.{quantity}" for quantity in _OF_CONTACT)
        for name, force in self.scope.forces.items():
            yield from (f"{name}.{quantity}" for quantity in (("couple",) if force.rotary else _OF_FORCE))

    def _energies(self) -> Iterator[str]:
        yield from (f"energy.{kind}" for kind in _ENERGIES)
        if self.tables.rows[layout.PM_TABLE_SPIN]:
            yield from _OF_SPIN

    def there(self, addresses: Iterable[str]) -> Columns:
        """Those that have a value: one that needs a mass which was left out is left out with it."""
        columns = {}
        for address in addresses:
            try:
                columns[address] = self._column(address)
            except SceneError:
                continue
        return columns

    def _addresses(self, ask: Ask) -> Iterator[Address]:
        """What an ask reads."""
        for written in (*(getattr(ask, word) for word in ASK_WORDS), ask.during):
            if isinstance(written, str):
                node = self.measures.reader.parameters.parse(written, "ask")
                yield from (leaf for leaf in names(node) if isinstance(leaf, Address))

    def _column(self, written: str) -> tuple[int, str]:
        where = f"history.{written}"
        reading = self.measures.lower(written, where)
        return self.tables.program(reading.node, where), reading.dimension.unit or "1"


def _is_velocity(address: str) -> bool:
    return address.endswith((".velocity.x", ".velocity.y", ".omega"))


def _coupling_quantities(coupling: CouplingInfo) -> tuple[str, ...]:
    """Its columns; of strands, those of each."""
    count = len(coupling.spans)
    spans = [f"[{span}]" for span in range(1, count + 1)] if count > 1 else [""]
    return tuple(
        f"{quantity}{span}"
        for quantity in coupling.coupling.columns
        for span in (spans if "." not in quantity else [""])
    )
