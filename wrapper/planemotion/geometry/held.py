"""What holds bodies before they are drawn: pins to something that is placed, and prescribed angles."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Protocol

from ..language.names import Names
from ..model.element import Kind
from ..model.readers import Value
from ..model.tables import Body, Ground
from ..model.words import GROUND


class Drawn(Protocol):
    """What is drawn of a scene."""

    @property
    def bodies(self) -> Mapping[str, Body]: ...

    @property
    def ground(self) -> Ground: ...

    @property
    def joints(self) -> Mapping[str, Kind]: ...

    @property
    def couplings(self) -> Mapping[str, Kind]: ...


def prescribed_angles(
    data: Drawn, bodies: Mapping[str, Body], names: Names
) -> dict[str, tuple[Value, str, float]]:
    """Bodies whose angle is prescribed against the ground: what is written, its key path, and the sign."""
    found: dict[str, tuple[Value, str, float]] = {}
    for group, kinds in (("joints", data.joints), ("couplings", data.couplings)):
        for name, one in kinds.items():
            angle: Value | None = getattr(one, "angle", None)
            if angle is None:
                continue
            owners = [names.owner(partner)[0] for partner in one.partners]
            if GROUND not in owners:
                continue
            turned, sign = (owners[0], 1.0) if owners[1] == GROUND else (owners[1], -1.0)
            found[turned] = angle, f"{group}.{name}.angle", sign
    for name, body in bodies.items():
        if body.driven is not None and body.driven.angle is not None:
            found[name] = body.driven.angle, f"bodies.{name}.driven.angle", 1.0
    return found


def is_driven_to(body: Body) -> bool:
    return body.driven is not None and body.driven.at is not None


def pinned_points(
    data: Drawn, bodies: Mapping[str, Body], names: Names
) -> dict[str, tuple[tuple[str, str], ...]]:
    """For bodies without `at`: up to two of their points that a pin holds to something placed before."""
    pinned = _pinned(data, names)
    free = {name: i for i, (name, body) in enumerate(bodies.items()) if body.at is None}
    placed = {name for name, body in bodies.items() if name not in free or is_driven_to(body)}
    guesses: dict[str, tuple[tuple[str, str], ...]] = {}
    looked_at: Collection[str] = free
    while True:
        found = {
            name: held
            for name in sorted(looked_at, key=free.__getitem__)
            if name not in placed and (held := _held(pinned.get(name, ()), placed))
        }
        if not found:
            return guesses
        guesses.update(found)
        placed.update(found)
        # Only what is pinned to these can be placed now.
        looked_at = {pin.partner for name in found for pin in pinned[name] if pin.partner in free}


@dataclass(frozen=True)
class _Pinned:
    """A point of a body that a pin holds to a mark of its partner, `other` as written."""

    point: str
    partner: str
    mark: str
    other: str


def _pinned(data: Drawn, names: Names) -> dict[str, list[_Pinned]]:
    """What pins hold of each body, in the order of the scene."""
    pinned: dict[str, list[_Pinned]] = {}
    for joint in data.joints.values():
        if joint.kind != "pin":
            continue
        for mine, other in (joint.partners, joint.partners[::-1]):
            owner, point = names.owner(mine)
            pinned.setdefault(owner, []).append(_Pinned(point or "G", *names.owner(other), other))
    return pinned


def _held(pins: Collection[_Pinned], placed: Collection[str]) -> tuple[tuple[str, str], ...]:
    """Points of a body that pins hold to what is placed, with that point."""
    held = [
        (pin.point, pin.other)
        for pin in pins
        if pin.partner in placed or (pin.partner == GROUND and pin.mark)
    ]
    return tuple(held[:2])
