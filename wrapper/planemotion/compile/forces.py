"""Forces: from partners and options to rows of the kernel's force table; the kinds are in kinds/."""

from __future__ import annotations

from dataclasses import dataclass

from ..base.errors import SceneError
from ..geometry.writer import Writer
from ..kinds.base import Force


@dataclass(frozen=True)
class ForceInfo:
    """What measures need to know of a force: its row, the owners of its partners, whether it is a couple."""

    index: int
    owners: tuple[str, ...]
    rotary: bool


def add_force(to: Writer, name: str, force: Force) -> ForceInfo:
    """Adds the row of one force.  Raises SceneError for partners and options that do not fit."""
    path = f"forces.{name}"
    try:
        row = force.row(to, path)
        index = to.force(
            row.kind, row.a, row.b, path, values=row.values, programs=row.programs, option=row.option
        )
    except SceneError as error:
        raise error.at(path=path) from None
    return ForceInfo(index, row.owners, row.rotary)
