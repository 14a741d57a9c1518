"""A cord over rims that it does not slip on: each straight strand is a contact that pulls only.

Its gap is its slack.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.marks import distance
from ..geometry.partners import Partner, different, drawn_pair, kernel_circle, partner
from ..geometry.push import Push
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, FORCE, IMPULSE, LENGTH
from ..language.tree import ZERO, Node
from ..model.element import Number, Quantity
from ..model.readers import read_stops
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
        "tension": Quantity((layout.PM_MEASURE_CONTACT_NORMAL,), FORCE),
        "impulse": Quantity((layout.PM_MEASURE_CONTACT_IMPULSE,), IMPULSE, part=layout.PM_PART_NORM),
        "slack": Quantity((layout.PM_MEASURE_CONTACT_GAP,), LENGTH),
        "force": Quantity((layout.PM_MEASURE_CONTACT_FORCE,), FORCE, vector=True),
    }
    columns = ("tension", "slack")
    partners: Annotated[tuple[str, ...], BeforeValidator(read_stops)]
    length: Number | None = None
    slack: Number | None = None
    restitution: Number = 0

    def rows(self, to: Writer, path: str) -> CouplingRows:
        stops = [_stop(to, text, f"{path}.cord[{index}]") for index, text in enumerate(self.partners)]
        for text, (one, _) in list(zip(self.partners, stops, strict=True))[1:-1]:
            _check_between(to, text.strip(), one)
        spans = list(itertools.pairwise(stops))
        for (a, _), (b, _) in spans:
            different(a, b)
        key = "length" if self.length is not None else "slack"
        slack = self._slack(to, [one for one, _ in stops], path)
        restitution = to.reader.number(self.restitution, f"{path}.restitution", DIMENSIONLESS)
        indices = []
        for number, ((a, sense_a), (b, sense_b)) in enumerate(spans):
            row = dict.fromkeys(range(layout.PM_CONTACT_COLUMNS), layout.PM_NONE)
            row[layout.PM_CONTACT_KIND] = layout.PM_CONTACT_CORD
            row[layout.PM_CONTACT_A] = _end(to, a)
            row[layout.PM_CONTACT_B] = _end(to, b)
            row[layout.PM_CONTACT_RESTITUTION] = to.tables.value(restitution, f"{path}.restitution")
            row[layout.PM_CONTACT_FRICTION] = layout.PM_FRICTION_SMOOTH
            row[layout.PM_CONTACT_SLACK] = to.tables.value(slack, f"{path}.{key}")
            row[layout.PM_CONTACT_LAW] = layout.PM_LAW_NEWTON
            row[layout.PM_CONTACT_PAINLEVE] = layout.PM_PAINLEVE_STOPS
            row[layout.PM_CONTACT_SENSE_A] = sense_a
            row[layout.PM_CONTACT_SENSE_B] = sense_b
            row[layout.PM_CONTACT_CAPTURE] = layout.PM_CAPTURE_NONE
            label = path if len(spans) == 1 else f"{path}[{number + 1}]"
            indices.append(to.tables.add(layout.PM_TABLE_CONTACT, row, label))
        owners = tuple((a.owner, b.owner) for (a, _), (b, _) in spans)
        return CouplingRows(None, tuple(indices), owners)

    def _slack(self, to: Writer, stops: Sequence[Partner], path: str) -> Node:
        """How much longer the cord is than drawn."""
        if self.length is None and self.slack is None:
            return ZERO
        if self.length is not None and self.slack is not None:
            raise SceneError("give length or slack, not both", path=path)
        key = "length" if self.length is not None else "slack"
        if len(stops) > 2:
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
