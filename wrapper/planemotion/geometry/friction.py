"""The law of friction of a contact, or of a cord on a rim, as it is written."""

from __future__ import annotations

from typing import NamedTuple

from .. import _layout as layout
from ..base.errors import SceneError
from ..language.dimensions import DIMENSIONLESS
from ..language.tree import ZERO, Node
from ..model.readers import Value
from ..model.tables import Friction
from .packing import Tables
from .parameters import Reader, is_zero


class FrictionLaw(NamedTuple):
    """enum pm_friction, and both coefficients."""

    law: int
    static: Node = ZERO
    kinetic: Node = ZERO

    def columns(self, tables: Tables, where: str) -> dict[int, int]:
        """What stands in the row of a contact."""
        coulomb = self.law == layout.PM_FRICTION_COULOMB
        return {
            layout.PM_CONTACT_FRICTION: self.law,
            layout.PM_CONTACT_STATIC: tables.value(self.static, where) if coulomb else layout.PM_NONE,
            layout.PM_CONTACT_KINETIC: tables.value(self.kinetic, where) if coulomb else layout.PM_NONE,
        }


def friction_law(reader: Reader, written: Value | Friction, where: str) -> FrictionLaw:
    """One number for both coefficients, each by itself, "smooth" or "rough".  Raises SceneError."""
    if written == "rough":
        return FrictionLaw(layout.PM_FRICTION_ROUGH)
    if written == "smooth":
        return FrictionLaw(layout.PM_FRICTION_SMOOTH)
    if isinstance(written, Friction):
        static = reader.number(written.static, f"{where}.static", DIMENSIONLESS)
        kinetic = reader.number(written.kinetic, f"{where}.kinetic", DIMENSIONLESS)
    else:
        static = kinetic = _coefficient(reader, written, where)
    if is_zero(static) and is_zero(kinetic):
        return FrictionLaw(layout.PM_FRICTION_SMOOTH)
    return FrictionLaw(layout.PM_FRICTION_COULOMB, static, kinetic)


def _coefficient(reader: Reader, written: Value, where: str) -> Node:
    """A single word that is no parameter was meant for a law."""
    if isinstance(written, str) and written.isidentifier() and written not in reader.parameters.defaults:
        raise SceneError(
            'a number, "smooth", "rough", { static = ..., kinetic = ... } or a parameter is wanted',
            path=where,
            value=written,
        )
    return reader.number(written, where, DIMENSIONLESS)
