"""Bounds of the numbers in the tables, checked at the defaults of the parameters.

The kernel checks the same in every case; here the message can name what is written.  Numbers that a sweep
changes are left to the kernel.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.packing import Tables
from ..kinds import FORCES
from ..reading.scene import SceneData


@dataclass(frozen=True)
class _Bound:
    """A column of value indices, and what its values must be."""

    table: int
    column: int
    least: float
    most: float = math.inf
    above: bool = False  # `least` itself is not allowed
    only: tuple[int, int] | None = None  # column and entry of the rows that have this bound

    @property
    def text(self) -> str:
        if self.most < math.inf:
            return f"must lie between {self.least:g} and {self.most:g}"
        return "must be positive" if self.above else "must not be negative"

    def allows(self, value: float) -> bool:
        return (value > self.least if self.above else value >= self.least) and value <= self.most


# Of these the second number is a tension, of the others an angle.
_BELTS = (layout.PM_JOINT_BELT_GRIPS, layout.PM_JOINT_BELT_SLIPS)
_BOUNDS = (
    _Bound(layout.PM_TABLE_BODY, layout.PM_BODY_MASS, 0),
    _Bound(layout.PM_TABLE_BODY, layout.PM_BODY_INERTIA, 0, only=(layout.PM_BODY_ROTATES, 1)),
    _Bound(layout.PM_TABLE_CIRCLE, layout.PM_CIRCLE_RADIUS, 0),
    _Bound(
        layout.PM_TABLE_JOINT,
        layout.PM_JOINT_VALUE,
        0,
        above=True,
        only=(layout.PM_JOINT_KIND, layout.PM_JOINT_LINK),
    ),
    *(
        _Bound(
            layout.PM_TABLE_JOINT, layout.PM_JOINT_VALUE_2, 0, math.pi / 3, only=(layout.PM_JOINT_KIND, kind)
        )
        for kind in (layout.PM_JOINT_TEETH, layout.PM_JOINT_RACK)
    ),
    *(
        _Bound(layout.PM_TABLE_JOINT, layout.PM_JOINT_VALUE_2, 0, only=(layout.PM_JOINT_KIND, kind))
        for kind in _BELTS
    ),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_RESTITUTION, 0, 1),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_TANGENTIAL, 0, 1),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_STATIC, 0),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_KINETIC, 0),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_SLACK, 0),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_LEVER, 0),
    *(
        _Bound(
            layout.PM_TABLE_CONTACT,
            layout.PM_CONTACT_SLACK,
            0,
            above=True,
            only=(layout.PM_CONTACT_KIND, kind),
        )
        for kind in (layout.PM_CONTACT_TEETH, layout.PM_CONTACT_RACK)
    ),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_STIFFNESS, 0, above=True),
    _Bound(layout.PM_TABLE_CONTACT, layout.PM_CONTACT_PRESSURE, 0, math.pi / 3),
    *(
        _Bound(layout.PM_TABLE_FORCE, layout.PM_FORCE_VALUE_1, 0, only=(layout.PM_FORCE_KIND, kind))
        for kind in (
            layout.PM_FORCE_SPRING,
            layout.PM_FORCE_TORSION,
            layout.PM_FORCE_DAMPER,
            layout.PM_FORCE_ROTARY_DAMPER,
        )
    ),
    _Bound(
        layout.PM_TABLE_FORCE,
        layout.PM_FORCE_VALUE_2,
        0,
        only=(layout.PM_FORCE_KIND, layout.PM_FORCE_FRICTION),
    ),
    _Bound(layout.PM_TABLE_SPIN, layout.PM_SPIN_INERTIA, 0),
    _Bound(layout.PM_TABLE_SETTING, layout.PM_SETTING_ACCURACY, 1e-14, 1e-2),
    _Bound(layout.PM_TABLE_SETTING, layout.PM_SETTING_MAX_TIME, 0, above=True),
    _Bound(layout.PM_TABLE_SETTING, layout.PM_SETTING_MAX_CPU, 0, above=True),
    _Bound(layout.PM_TABLE_SETTING, layout.PM_SETTING_ASSEMBLY, 0, above=True),
    _Bound(layout.PM_TABLE_SETTING, layout.PM_SETTING_EXPONENT, 1, 10),
)


def check_bounds(tables: Tables, data: SceneData) -> None:
    """Raises SceneError for the first value out of its bound, or that is not a finite number."""
    swept = set(data.sweep.grids)
    for index, path in enumerate(tables.names[layout.PM_TABLE_VALUE]):
        if tables.depends_on(index) & swept:
            continue
        value = tables.default_value(index)
        if not math.isfinite(value):
            raise SceneError(
                f"it is {value} and must be a finite number", path=path, value=written(data, path)
            )
    for bound in _BOUNDS:
        for row in tables.rows[bound.table]:
            if bound.only is not None and row[bound.only[0]] != bound.only[1]:
                continue
            index = row[bound.column]
            if index == layout.PM_NONE or tables.depends_on(index) & swept:
                continue
            value = tables.default_value(index)
            if not bound.allows(value):
                path = tables.names[layout.PM_TABLE_VALUE][index]
                shown = written(data, path)
                # A bare number says it already; a quantity or an expression does not.
                _, unit = named(bound.table, row, bound.column)
                found = "it " if isinstance(shown, int | float) else f"it is {with_unit(value, unit)} and "
                raise SceneError(found + bound.text, path=path, value=shown)


def written(data: SceneData, path: str) -> object:
    """What stands in the file at a key path; None where it is left out or is more than a number."""
    place: object = data
    for key in data.names.split(path):
        if isinstance(place, dict):
            place = place.get(key)
        else:
            place = getattr(place, key, None)
    return place if isinstance(place, str | int | float) else None


_Named = tuple[str, str]


_COLUMNS: dict[tuple[int, int], _Named] = {
    (layout.PM_TABLE_CONTACT, layout.PM_NONE): ("", "steps along its row"),
    (layout.PM_TABLE_BODY, layout.PM_BODY_MASS): ("mass", "kg"),
    (layout.PM_TABLE_BODY, layout.PM_BODY_INERTIA): ("inertia", "kg*m^2"),
    (layout.PM_TABLE_CIRCLE, layout.PM_CIRCLE_RADIUS): ("", "m"),
    (layout.PM_TABLE_JOINT, layout.PM_JOINT_VALUE): ("", "m"),
    (layout.PM_TABLE_JOINT, layout.PM_JOINT_VALUE_2): ("", "rad"),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_RESTITUTION): ("restitution", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_TANGENTIAL): ("tangential", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_STATIC): ("friction", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_KINETIC): ("friction", ""),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_SLACK): ("", "m"),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_STIFFNESS): ("stiffness", "N/m"),
    (layout.PM_TABLE_CONTACT, layout.PM_CONTACT_PRESSURE): ("", "rad"),
    (layout.PM_TABLE_SPIN, layout.PM_SPIN_INERTIA): ("inertia", "kg*m^2"),
    (layout.PM_TABLE_SPIN, layout.PM_SPIN_ANGLE): ("angle", "rad"),
    (layout.PM_TABLE_SETTING, layout.PM_SETTING_MAX_TIME): ("max_time", "s"),
    (layout.PM_TABLE_SETTING, layout.PM_SETTING_MAX_CPU): ("max_cpu", "s"),
}


# Of forces the kind tells.
_FORCES: dict[tuple[int, int], _Named] = {
    place: name for kind in FORCES.values() for place, name in kind.bounded.items()
}


def named(table: int, row: Sequence[int], column: int) -> _Named:
    """The key below the row's own key path, and the SI unit; both may be empty."""
    if (table, column) == (layout.PM_TABLE_JOINT, layout.PM_JOINT_VALUE_2) and row[
        layout.PM_JOINT_KIND
    ] in _BELTS:
        return "pretension", "N"
    if table == layout.PM_TABLE_FORCE:
        return _FORCES.get((int(row[layout.PM_FORCE_KIND]), column), ("", ""))
    return _COLUMNS.get((table, column), ("", ""))


def with_unit(number: float, unit: str) -> str:
    """The number to six digits and its unit, if it has one."""
    return f"{number:.6g} {unit}".rstrip()
