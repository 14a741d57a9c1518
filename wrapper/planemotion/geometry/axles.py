"""Axles of wheels: what keeps the distance of two centres as it is."""

from __future__ import annotations

from typing import NamedTuple

from .. import _layout as layout
from ..base.errors import SceneError
from ..language.tree import Node
from ..model.words import GROUND
from .drawing import PointRef
from .marks import CircleMark, Pair, distance
from .parameters import is_zero
from .partners import Partner
from .writer import Writer

_PINS = (layout.PM_JOINT_PIN, layout.PM_JOINT_PIN_ANGLE)
_DRIVES = (layout.PM_JOINT_DRIVE, layout.PM_JOINT_PLACED)


class Axles(NamedTuple):
    """The distance of two centres, and the rows of the joint table that keep it."""

    distance: Node
    joints: frozenset[int]


class _Held(NamedTuple):
    """Where the centre of a wheel stays in a body, from G, and the joint that holds it there."""

    at: Pair
    joint: int | None = None


def axles(to: Writer, a: Partner, b: Partner, path: str) -> Axles:
    """Both centres stay in one body, or in the ground.  Raises SceneError where nothing holds them so."""
    first, second = _places(to, a), _places(to, b)
    for body, held in first.items():
        if body in second:
            joints = frozenset(one.joint for one in (held, second[body]) if one.joint is not None)
            return Axles(distance(held.at, second[body].at), joints)
    loose = next((one for one in (a, b) if len(_places(to, one)) == 1 and not one.is_ground), b)
    reason = (
        "a belt with a pretension runs round wheels on fixed axles: "
        f'pin the centre of "{loose.owner}" and that of the other one to the ground, or to one body'
    )
    raise SceneError(reason, path=path)


def _places(to: Writer, wheel: Partner) -> dict[int, _Held]:
    """Where the centre of a wheel stays, by the index of the body."""
    assert isinstance(wheel.mark, CircleMark)
    centre = to.drawing.from_mass_center(wheel.owner, wheel.mark.center)
    hub = to.drawn.point_at(wheel.owner, centre, wheel.where)
    found = {to.drawing.body_index(wheel.owner): _Held(centre)}
    for joint, row in enumerate(to.tables.rows[layout.PM_TABLE_JOINT]):
        ends = row[layout.PM_JOINT_A], row[layout.PM_JOINT_B]
        if row[layout.PM_JOINT_KIND] in _PINS and hub in ends:
            body, at = to.drawn.place(ends[ends[0] == hub])
            found.setdefault(body, _Held(at, joint))
        elif row[layout.PM_JOINT_KIND] in _DRIVES and hub == ends[0]:
            driven = _driven(to, wheel.owner, row)
            if driven is not None:
                found.setdefault(to.drawing.body_index(GROUND), _Held(driven, joint))
    return found


def _driven(to: Writer, owner: str, row: tuple[int, ...]) -> Pair | None:
    """Where a drive holds the centre for good; None where it moves, or is not exactly drawn."""
    x, y = (
        to.tables.node_of(row[column]) for column in (layout.PM_JOINT_PROGRAM_X, layout.PM_JOINT_PROGRAM_Y)
    )
    if row[layout.PM_JOINT_KIND] == layout.PM_JOINT_PLACED:
        return (x, y) if to.is_steady(x, y) else None
    centre = PointRef(owner, "G")
    stands = is_zero(x) and is_zero(y) and to.drawing.is_exact(centre)
    return to.drawing.position(centre) if stands else None
