"""A bare relation of how two bodies rotate, kept as at the start: a gear box whose inside is not known.

The couples on the two bodies are not opposite: the ground takes the rest, as the housing of a gear box does.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BeforeValidator

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.parameters import is_zero
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import DIMENSIONLESS, MOMENT
from ..language.tree import Node
from ..model.element import Quantity
from ..model.readers import Value, read_value
from ..model.words import GROUND, not_built
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


def _read(written: Any) -> dict[str, Value]:
    """Numbers by address; keys with dots that are not quoted arrive as tables."""
    flat: dict[str, Value] = {}
    for key, value in written.items() if isinstance(written, Mapping) else ():
        nested = value if isinstance(value, Mapping) else {"": value}
        flat |= {f"{key}.{rest}".rstrip("."): read_value(number) for rest, number in nested.items()}
    if len(flat) != 2:
        raise ValueError('two bodies are wanted, such as { "A.turned" = 1, "B.turned" = 2 }')
    return flat


class Ratio(Coupling):
    word = "ratio"
    quantities = {"couple": Quantity((layout.PM_MEASURE_JOINT_COUPLE,), MOMENT, on=True)}
    columns = ("couple",)
    partners: Annotated[dict[str, Value], BeforeValidator(_read)]

    @property
    def between(self) -> str:
        return ", ".join(f"{number} {address}" for address, number in self.partners.items())

    def rows(self, to: Writer, path: str) -> CouplingRows:
        terms = [self._term(to, address, f"{path}.ratio.{address}") for address in self.partners]
        (first, of_first), (second, of_second) = terms
        value = -of_second / of_first, f"{path}.ratio"
        a, b = to.drawing.body_index(first), to.drawing.body_index(second)
        index = to.joint(layout.PM_JOINT_RATIO, a, b, path, value=value)
        return CouplingRows(index, (), ((first, second),))

    def _term(self, to: Writer, address: str, where: str) -> tuple[str, Node]:
        """A body, and the number of its turns."""
        name, quantity = to.drawing.names.owner(address)
        if quantity != "turned":
            raise not_built("relations of anything but BODY.turned", where)
        if name == GROUND:
            raise SceneError("the ground does not rotate; a body is wanted", path=where)
        body = to.body(name, where)
        number = to.reader.number(self.partners[address], where, DIMENSIONLESS)
        if is_zero(number):
            reason = "a body that takes part has a number that is not 0"
            raise SceneError(reason, path=where, value=self.partners[address])
        return body, number

    def draw(self, sketch: Sketch, where: str) -> Place:
        a, b = (sketch.point(address.removesuffix(".turned"), "center") for address in self.partners)
        sketch.pen.line([a, b], width=0.8, linestyle=":")
        return sketch.middle(a, b)
