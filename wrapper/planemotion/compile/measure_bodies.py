"""What an address reads of a body, of one of its points, or of a point of the ground."""

from __future__ import annotations

from .. import _layout as layout
from ..base.errors import SceneError, nearest
from ..geometry.drawing import PointRef
from ..language.address import Address
from ..language.dimensions import (
    ACCELERATION,
    ANGULAR_ACCELERATION,
    ANGULAR_MOMENTUM,
    ANGULAR_VELOCITY,
    DIMENSIONLESS,
    ENERGY,
    FORCE,
    IMPULSE,
    INERTIA,
    LENGTH,
    MASS,
    MOMENT,
    POWER,
    VELOCITY,
    Dimension,
)
from ..model import words
from ..model.words import GROUND
from .elements import DriveInfo
from .measure_rows import MeasureRows, Reading

# Scalar of a body: measure kind, dimension, words that may follow.
_BODY: dict[str, tuple[int, Dimension, tuple[str, ...]]] = {
    "angle": (layout.PM_MEASURE_ANGLE, DIMENSIONLESS, ("in",)),
    "turned": (layout.PM_MEASURE_TURNED, DIMENSIONLESS, ()),
    "omega": (layout.PM_MEASURE_OMEGA, ANGULAR_VELOCITY, ("in",)),
    "alpha": (layout.PM_MEASURE_ALPHA, ANGULAR_ACCELERATION, ()),
    "mass": (layout.PM_MEASURE_MASS, MASS, ()),
    "inertia": (layout.PM_MEASURE_INERTIA, INERTIA, ("about",)),
    "kinetic_energy": (layout.PM_MEASURE_KINETIC, ENERGY, ()),
    "angular_momentum": (layout.PM_MEASURE_ANGULAR_MOMENTUM, ANGULAR_MOMENTUM, ("about",)),
}
_POINT_VECTOR: dict[str, tuple[int, Dimension, tuple[str, ...]]] = {
    "position": (layout.PM_MEASURE_POSITION, LENGTH, ("in", "along")),
    "moved": (layout.PM_MEASURE_MOVED, LENGTH, ("along",)),
    "velocity": (layout.PM_MEASURE_VELOCITY, VELOCITY, ("in", "along")),
    "acceleration": (layout.PM_MEASURE_ACCELERATION, ACCELERATION, ("along",)),
}


class BodyMeasures:
    """Makes measures of addresses such as "AB.omega" and "AB.B.velocity.x"."""

    def __init__(self, rows: MeasureRows) -> None:
        self.rows = rows

    def read(self, address: Address) -> Reading:
        owner, path = address.thing, address.path
        if not path:
            raise SceneError(f'"{address}": a quantity is wanted, such as {owner}.x')
        if path[0] in words.BODY_QUANTITIES and owner != GROUND:
            return self._of_body(address, owner)
        if path[0] == words.DRIVEN and owner in self.rows.scope.driven:
            return self._of_drive(address, self.rows.scope.driven[owner])
        if path[0] in words.POINT_QUANTITIES:
            if owner == GROUND:
                raise SceneError(f'"{address}": a point of the ground is wanted before {path[0]}')
            return self._of_point(address, PointRef(owner, "G"), path)
        marks = self.rows.drawing.marks(owner)
        if path[0] not in marks.points:
            quantities = (*words.POINT_QUANTITIES, *(words.BODY_QUANTITIES if owner != GROUND else ()))
            guess = nearest(path[0], [*marks.points, *quantities])
            hint = f' (did you mean "{guess}"?)' if guess else f"; quantities are {', '.join(quantities)}"
            raise SceneError(marks.has_no("point or quantity", path[0], marks.points) + hint)
        if len(path) < 2 or path[1] not in words.POINT_QUANTITIES:
            word = path[1] if len(path) > 1 else ""
            wanted = ", ".join(words.POINT_QUANTITIES)
            reason = (
                words.unknown(word, words.POINT_QUANTITIES, "quantity of a point")
                if word
                else f"{wanted} is wanted"
            )
            raise SceneError(f'"{address}": {reason}')
        return self._of_point(address, PointRef(owner, path[0]), path[1:])

    def _of_body(self, address: Address, owner: str) -> Reading:
        quantity = address.path[0]
        index = self.rows.drawing.body_index(owner)
        if quantity in ("mass", "weight", "momentum"):
            self.rows.need_masses((owner,))
        if quantity == "weight":
            self.rows.ends(address, 1)
            self.rows.plain(address, ())
            return self.rows.weight(index, address)
        if quantity in ("momentum", "pole"):
            kind = layout.PM_MEASURE_MOMENTUM if quantity == "momentum" else layout.PM_MEASURE_POLE
            found = IMPULSE if quantity == "momentum" else LENGTH
            return self.rows.vector(address, address.path[1:], [(kind, index)], found, ("along",))
        kind, found, allowed = _BODY[quantity]
        self.rows.ends(address, 1)
        self.rows.plain(address, allowed)
        return Reading(self.rows.leaf(kind, index, address), found)

    def _of_drive(self, address: Address, drive: DriveInfo) -> Reading:
        """What drives a body: the force at its point or mass centre, the couple, the power of both."""
        what = f"what drives {address.thing}"
        if len(address.path) < 2 or address.path[1] not in words.DRIVE_QUANTITIES:
            wanted = ", ".join(words.DRIVE_QUANTITIES)
            raise SceneError(f'"{address}": a quantity of {what} is wanted: {wanted}')
        quantity, rest = address.path[1], address.path[2:]
        self.rows.need_masses((address.thing,))
        if quantity == "force":
            sources = [(layout.PM_MEASURE_JOINT_FORCE, drive.place)]
            return self.rows.vector(address, rest, sources, FORCE, ("in", "along"))
        self.rows.ends(address, 2)
        self.rows.plain(address, ())
        if quantity == "couple":
            if drive.angle is None:
                raise SceneError(f'"{address}": a particle does not rotate: no couple acts on it')
            return Reading(self.rows.leaf(layout.PM_MEASURE_JOINT_COUPLE, drive.angle, address), MOMENT)
        rows = [drive.place] if drive.angle is None else [drive.place, drive.angle]
        leaves = [self.rows.leaf(layout.PM_MEASURE_JOINT_POWER, row, address) for row in rows]
        return Reading(sum(leaves[1:], leaves[0]), POWER)

    def _of_point(self, address: Address, ref: PointRef, path: tuple[str, ...]) -> Reading:
        """A quantity of a point; `path` begins with its word."""
        index = self.rows.drawn.point(ref)
        quantity = path[0]
        if quantity in ("x", "y"):
            return self.rows.vector(address, path, [(layout.PM_MEASURE_POSITION, index)], LENGTH, ("in",))
        if quantity == "speed":
            kind = layout.PM_MEASURE_VELOCITY
            return self.rows.vector(address, ("norm", *path[1:]), [(kind, index)], VELOCITY, ("in",))
        if quantity == "path":
            self.rows.ends(address, len(address.path) - len(path) + 1)
            self.rows.plain(address, ())
            return Reading(self.rows.leaf(layout.PM_MEASURE_PATH, index, address), LENGTH)
        kind, found, allowed = _POINT_VECTOR[quantity]
        return self.rows.vector(address, path[1:], [(kind, index)], found, allowed)
