"""Keys and SI units of the kernel's columns that have bounds: what messages call a number out of them."""

from __future__ import annotations

from collections.abc import Sequence

from .. import _layout as layout
from ..kinds import FORCES

_Named = tuple[str, str]
_COLUMNS: dict[tuple[int, int], _Named] = {
    (layout.PM_TABLE_BODY, layout.PM_BODY_MASS): ("mass", "kg"),
    (layout.PM_TABLE_BODY, layout.PM_BODY_INERTIA): ("inertia", "kg*m^2"),
    (layout.PM_TABLE_CIRCLE, layout.PM_CIRCLE_RADIUS): ("", "m"),
    (layout.PM_TABLE_JOINT, layout.PM_JOINT_VALUE): ("", "m"),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_RESTITUTION): ("restitution", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_TANGENTIAL): ("tangential", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_STATIC): ("friction", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_KINETIC): ("friction", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_SLACK): ("", "m"),
    (layout.PM_TABLE_SPIN, layout.PM_SPIN_INERTIA): ("inertia", "kg*m^2"),
    (layout.PM_TABLE_SPIN, layout.PM_SPIN_ANGLE): ("angle", "rad"),
    (layout.PM_TABLE_SETTING, layout.PM_SETTING_MAX_TIME): ("max_time", "s"),
}
# Of forces the kind tells.
_FORCES: dict[tuple[int, int], _Named] = {
    place: name for kind in FORCES.values() for place, name in kind.bounded.items()
}


def named(table: int, row: Sequence[int], column: int) -> _Named:
    """The key below the row's own key path, and the SI unit; both may be empty."""
    if table == layout.PM_TABLE_FORCE:
        return _FORCES.get((int(row[layout.PM_FORCE_KIND]), column), ("", ""))
    return _COLUMNS.get((table, column), ("", ""))


def with_unit(number: float, unit: str) -> str:
    """The number to six digits and its unit, if it has one."""
    return f"{number:.6g} {unit}".rstrip()
