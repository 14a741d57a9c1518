"""Where elements act on bodies, in a picture."""

from __future__ import annotations

from dataclasses import dataclass

Place = tuple[float, float]


@dataclass(frozen=True)
class Push:
    """Where a force acts on the first and on the second partner; `turn`: direction of the surface that the
    partners touch at, rad, where a normal force and a friction mean something."""

    places: tuple[Place, Place]
    turn: float | None = None
