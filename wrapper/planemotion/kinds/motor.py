"""A motor: the spin of one body relative to another is given."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import ANGULAR_VELOCITY, MOMENT
from ..model.element import Number, Partners, Quantity
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Motor(Coupling):
    word = "motor"
    quantities = {"couple": Quantity((layout.PM_MEASURE_JOINT_COUPLE,), MOMENT, on=True)}
    columns = ("couple",)
    partners: Partners
    value: Number | None = None

    def rows(self, to: Writer, path: str) -> CouplingRows:
        where = f"{path}.value"
        if self.value is None:
            raise SceneError("the spin of the first body relative to the second is wanted", path=where)
        owners = to.bodies(self.partners, f"{path}.motor")
        a, b = (to.drawing.body_index(owner) for owner in owners)
        value = to.over_time(self.value, where, ANGULAR_VELOCITY)
        index = to.joint(layout.PM_JOINT_RATE, a, b, path, programs=(value,))
        return CouplingRows(index, (), (owners,))

    def draw(self, sketch: Sketch, where: str) -> Place:
        at = sketch.center(self.partners)
        sketch.pen.couple(at, True)
        return at
