"""A couple on a body, of a given size over time or of given power; another body may take the reaction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.rows import ForceRow
from ..geometry.writer import Writer
from ..language.dimensions import MOMENT
from ..language.tree import Node
from ..model.element import Number
from ..model.readers import Value, Vector, read_body_or_two, read_value_or_vector
from ..model.words import GROUND
from .base import Force

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Couple(Force):
    word = "couple"
    resists = False
    partners: Annotated[tuple[str, ...], BeforeValidator(read_body_or_two)]
    value: Annotated[Value | Vector, BeforeValidator(read_value_or_vector)] | None = None
    power: Number | None = None

    def row(self, to: Writer, path: str) -> ForceRow:
        where = f"{path}.couple"
        if len(self.partners) == 1:
            owners: tuple[str, ...] = (to.body(self.partners[0], where),)
        else:
            owners = to.bodies(self.partners, where)
        if self.power is not None:
            key = f"{path}.power"
            value = to.power(self.power, key, value=self.value) / _spin(to, owners, key)
        elif self.value is None or isinstance(self.value, Vector):
            reason = "a number is wanted: the couple, counterclockwise positive"
            raise SceneError(reason, path=f"{path}.value")
        else:
            key = f"{path}.value"
            value = to.over_motion(self.value, key, MOMENT)
        a, b = (to.drawing.body_index(owner) for owner in (*owners, GROUND)[:2])
        return ForceRow(layout.PM_FORCE_COUPLE, a, b, owners=owners, programs=((value, key),), rotary=True)

    def draw(self, sketch: Sketch, where: str) -> Place:
        first = sketch.read(self.partners, where, "point")
        at = sketch.of_partner(first[0], first[-1])
        sketch.pen.couple(at, not str(self.value).lstrip().startswith("-"))
        return at


def _spin(to: Writer, owners: tuple[str, ...], where: str) -> Node:
    """The spin of the first body relative to the second."""
    spins = [
        to.measured(layout.PM_MEASURE_OMEGA, to.drawing.body_index(owner), where)
        for owner in owners
        if owner != GROUND
    ]
    if not spins:
        reason = "the ground does not turn: a power needs a body that does"
        raise SceneError(reason, path=where)
    if owners[0] == GROUND:
        return -spins[0]
    return spins[0] if len(spins) == 1 else spins[0] - spins[1]
