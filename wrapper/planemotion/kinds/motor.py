"""A motor: the spin of one body relative to another is given, or its angle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.rows import CouplingRows
from ..geometry.writer import Writer
from ..language.dimensions import ANGULAR_VELOCITY, DIMENSIONLESS, MOMENT, POWER
from ..model.element import Number, Partners, Quantity
from .base import Coupling

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Motor(Coupling):
    word = "motor"
    quantities = {
        "couple": Quantity((layout.PM_MEASURE_JOINT_COUPLE,), MOMENT, on=True),
        "power": Quantity((layout.PM_MEASURE_JOINT_POWER,), POWER),
    }
    columns = ("couple",)
    partners: Partners
    value: Number | None = None
    angle: Number | None = None

    def rows(self, to: Writer, path: str) -> CouplingRows:
        if (self.value is None) == (self.angle is None):
            reason = "the spin of the first body relative to the second is wanted, or angle, and not both"
            raise SceneError(reason, path=f"{path}.value")
        owners = to.bodies(self.partners, f"{path}.motor")
        a, b = (to.drawing.body_index(owner) for owner in owners)
        if self.value is not None:
            kind, program = layout.PM_JOINT_RATE, to.over_time(self.value, f"{path}.value", ANGULAR_VELOCITY)
        else:
            assert self.angle is not None
            kind, program = layout.PM_JOINT_ANGLE, to.over_time(self.angle, f"{path}.angle", DIMENSIONLESS)
        index = to.joint(kind, a, b, path, programs=(program,))
        return CouplingRows(index, (), (owners,))

    def draw(self, sketch: Sketch, where: str) -> Place:
        at = sketch.center(self.partners)
        sketch.pen.couple(at, True)
        return at
