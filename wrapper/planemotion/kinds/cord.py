"""A cord over rims: each straight strand is a contact that pulls only, and its gap is its slack.

Where the cord may slip on a rim both strands beside it are one contact, with the friction of the rim.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.friction import FrictionLaw, friction_law
from ..geometry.marks import distance
from ..geometry.partners import Partner, different, drawn_pair, kernel_circle, partner
from ..geometry.push import Push
from ..geometry.rows import CouplingRows, Span
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, FORCE, IMPULSE, LENGTH, VELOCITY
from ..language.tree import ZERO, Node
from ..model.element import Number, Quantity
from ..model.readers import Value, read_cord_friction, read_stops
from ..model.tables import Friction
from ..model.words import GROUND
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch, Strand
    from ..pen.symbols import Place

_RIM = re.compile(r"(\S+)\s+(cw|ccw)")
_SENSES = {"ccw": 1, "cw": -1}


class Cord(Coupling):
    word = "cord"
    quantities = {
        "tension": Quantity(
            (layout.PM_MEASURE_CONTACT_NORMAL,), FORCE, rim=layout.PM_MEASURE_CONTACT_TENSION
        ),
        "impulse": Quantity(
            (layout.PM_MEASURE_CONTACT_IMPULSE,),
            IMPULSE,
            part=layout.PM_PART_NORM,
            rim=layout.PM_MEASURE_CONTACT_TENSION_IMPULSE,
        ),
        "slip": Quantity((layout.PM_MEASURE_CONTACT_SLIP,), VELOCITY, of_rims=True),
        "slack": Quantity((layout.PM_MEASURE_CONTACT_GAP,), LENGTH),
        "force": Quantity((layout.PM_MEASURE_CONTACT_FORCE,), FORCE, vector=True),
    }
    columns = ("tension", "slack")
    partners: Annotated[tuple[str, ...], BeforeValidator(read_stops)]
    length: Number | None = None
    slack: Number | None = None
    restitution: Number = 0
    friction: Annotated[
        Value | Friction | tuple[Value | Friction, ...], BeforeValidator(read_cord_friction)
    ] = "rough"
    turns: Number = 0

    def rows(self, to: Writer, path: str) -> CouplingRows:
        stops = [_stop(to, text, f"{path}.cord[{index}]") for index, text in enumerate(self.partners)]
        for text, (one, _) in list(zip(self.partners, stops, strict=True))[1:-1]:
            _check_between(to, text.strip(), one)
        frictions = self._frictions(to, [one.kind == "circle" for one, _ in stops[1:-1]], path)
        for (a, _), (b, _) in itertools.pairwise(stops):
            different(a, b)
        key = "length" if self.length is not None else "slack"
        slack = to.tables.value(self._slack(to, [one for one, _ in stops], frictions, path), f"{path}.{key}")
        spans: list[Span] = []
        while len(spans) < len(stops) - 1:
            first = len(spans)
            friction = frictions[first] if first < len(frictions) else None
            last = first + (1 if friction is None else 2)
            label = path if last - first == len(stops) - 1 else f"{path}[{first + 1}]"
            row = self._row(to, stops[first : last + 1], friction, slack, path)
            index = to.tables.add(layout.PM_TABLE_CONTACT, row, label)
            spans += [Span(index)] if friction is None else [Span(index, 0), Span(index, 1)]
        owners = tuple((a.owner, b.owner) for (a, _), (b, _) in itertools.pairwise(stops))
        return CouplingRows(None, tuple(dict.fromkeys(span.index for span in spans)), owners, tuple(spans))

    def _row(
        self,
        to: Writer,
        stops: Sequence[tuple[Partner, int]],
        friction: FrictionLaw | None,
        slack: int,
        path: str,
    ) -> dict[int, int]:
        """The row of one strand, or of both beside a rim that the cord may slip on."""
        (a, sense_a), (b, sense_b) = stops[0], stops[-1]
        restitution = to.reader.number(self.restitution, f"{path}.restitution", DIMENSIONLESS)
        row = dict.fromkeys(range(layout.PM_CONTACT_COLUMNS), layout.PM_NONE)
        row |= {
            layout.PM_CONTACT_KIND: layout.PM_CONTACT_CORD,
            layout.PM_CONTACT_A: _end(to, a),
            layout.PM_CONTACT_B: _end(to, b),
            layout.PM_CONTACT_RESTITUTION: to.tables.value(restitution, f"{path}.restitution"),
            layout.PM_CONTACT_FRICTION: layout.PM_FRICTION_SMOOTH,
            layout.PM_CONTACT_SLACK: slack,
            layout.PM_CONTACT_LAW: layout.PM_LAW_NEWTON,
            layout.PM_CONTACT_PAINLEVE: layout.PM_PAINLEVE_STOPS,
            layout.PM_CONTACT_SENSE_A: sense_a,
            layout.PM_CONTACT_SENSE_B: sense_b,
            layout.PM_CONTACT_CAPTURE: layout.PM_CAPTURE_NONE,
        }
        if friction is None:
            return row
        rim, sense = stops[1]
        where = f"{path}.turns"
        turns = to.tables.value(to.reader.number(self.turns, where, DIMENSIONLESS), where)
        if to.tables.default_value(turns) % 1 or to.tables.default_value(turns) < 0:
            raise SceneError("full turns are counted: 0, 1, 2, ...", path=where, value=self.turns)
        return row | {
            **friction.columns(to.tables, f"{path}.friction"),
            layout.PM_CONTACT_RIM: _end(to, rim),
            layout.PM_CONTACT_SENSE_RIM: sense,
            layout.PM_CONTACT_TURNS: turns,
        }

    def _frictions(self, to: Writer, are_rims: Sequence[bool], path: str) -> tuple[FrictionLaw | None, ...]:
        """What the cord has on each stop between its ends; None: it grips."""
        where = f"{path}.friction"
        listed = isinstance(self.friction, tuple)
        given = self.friction if isinstance(self.friction, tuple) else (self.friction,) * len(are_rims)
        if len(given) != len(are_rims):
            reason = f"between its ends the cord passes {len(are_rims)} rims: give one friction for each"
            raise SceneError(reason, path=where)
        laws = [
            friction_law(to.reader, written, f"{where}[{index}]" if listed else where)
            for index, written in enumerate(given)
        ]
        for is_rim, law in zip(are_rims, laws, strict=True):
            if not is_rim and law.law == layout.PM_FRICTION_COULOMB:
                reason = 'a cord lies along no part of a point: there it is tied ("rough") or runs ("smooth")'
                raise SceneError(reason, path=where)
        slips = tuple(None if one.law == layout.PM_FRICTION_ROUGH else one for one in laws)
        if "friction" in self.model_fields_set and not are_rims:
            reason = "the cord passes no rim between its ends; on one at an end it is wound"
            raise SceneError(reason, path=where)
        for one, other in itertools.pairwise(slips):
            if one is not None and other is not None:
                reason = (
                    "not built yet: a cord that may slip on two rims one after the other; "
                    'give a list in which one of them is "rough"'
                )
                raise SceneError(reason, path=where)
        if "turns" in self.model_fields_set and not any(slips):
            raise SceneError(
                "turns are of a rim that the cord may slip on; give its friction", path=f"{path}.turns"
            )
        return slips

    def _slack(
        self, to: Writer, stops: Sequence[Partner], frictions: Sequence[FrictionLaw | None], path: str
    ) -> Node:
        """How much longer the cord is than drawn."""
        if self.length is None and self.slack is None:
            return ZERO
        if self.length is not None and self.slack is not None:
            raise SceneError("give length or slack, not both", path=path)
        key = "length" if self.length is not None else "slack"
        if any(one is None for one in frictions):
            reason = "a cord that grips a rim between its ends is taut as drawn"
            raise SceneError(reason, path=f"{path}.{key}")
        if self.slack is not None:
            return to.reader.number(self.slack, f"{path}.slack", LENGTH)
        assert self.length is not None
        if any(one.kind == "circle" for one in stops):
            reason = "a cord that is wound on a rim has no length; give its slack"
            raise SceneError(reason, path=f"{path}.length")
        length = to.reader.number(self.length, f"{path}.length", LENGTH)
        return length - distance(*drawn_pair(to.drawing, *stops))

    def draw(self, sketch: Sketch, where: str) -> Place:
        middles = [sketch.strand(a, b) for a, b in self._spans(sketch, where)]
        return middles[0]

    def pushes(self, sketch: Sketch, where: str) -> tuple[Push, ...]:
        return tuple(Push(sketch.strand_ends(a, b)) for a, b in self._spans(sketch, where))

    def _spans(self, sketch: Sketch, where: str) -> Iterator[Strand]:
        """The straight strands, each from stop to stop."""
        names = tuple(text.split()[0] for text in self.partners)
        stops = zip(
            sketch.read(names, where, "point", "circle"),
            (text.endswith(" ccw") for text in self.partners),
            strict=True,
        )
        return itertools.pairwise(stops)


def _stop(to: Writer, text: str, where: str) -> tuple[Partner, int]:
    """A point, or a rim with the sense in which it is passed."""
    match = _RIM.fullmatch(text.strip())
    if match is not None:
        return partner(to.drawing, match[1], where, "circle"), _SENSES[match[2]]
    found = partner(to.drawing, text.strip(), where, "point", "circle")
    if found.kind == "circle":
        reason = f'in which sense is it passed, going down the list? "{text} cw" or "{text} ccw"'
        raise SceneError(reason, path=where, value=text)
    return found, 1


def _check_between(to: Writer, text: str, one: Partner) -> None:
    """A round body that is named alone between the ends was not meant as the point in its middle."""
    if not one.is_ground and text == one.owner and "rim" in to.drawing.marks(one.owner).circles:
        reason = f'the cord is tied to its mass centre: did you mean "{text}.rim cw" or "{text}.rim ccw"?'
        raise SceneError(reason, path=one.where, value=text)


def _end(to: Writer, one: Partner) -> int:
    """The kernel circle of a stop."""
    if not one.anywhere:
        return kernel_circle(to.drawn, one)
    reason = "a point of the ground is wanted, such as ground.S"
    raise SceneError(reason, path=one.where, value=GROUND)
