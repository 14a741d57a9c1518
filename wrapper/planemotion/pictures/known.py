"""What is known of the motion at an instant, in SI, by address: it tells where signs of forces point to."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..engine.outcome import History

# Of the greatest velocity, of places that turn too: what is slower stands still.
STILL = 1e-9
_OF_PLACE, _OF_VELOCITY = ("x", "y", "angle"), ("velocity.x", "velocity.y", "omega")


def at_start(
    poses: Mapping[str, tuple[float, float, float]], velocities: Mapping[str, tuple[float, float, float]]
) -> dict[str, float]:
    """Of the mass centres of bodies."""
    known = {"t": 0.0}
    for name, place in poses.items():
        velocity = velocities[name]
        known |= {f"{name}.{word}": value for word, value in zip(_OF_PLACE, place, strict=True)}
        known |= {f"{name}.{word}": value for word, value in zip(_OF_VELOCITY, velocity, strict=True)}
        known |= dict.fromkeys((f"{name}.velocity.norm", f"{name}.speed"), math.hypot(*velocity[:2]))
    return known


def at_row(recorded: History, row: int) -> dict[str, float]:
    """All that was recorded at an instant of a run."""
    return {"t": float(recorded.time[row])} | {
        name: float(values[row]) for name, values in recorded.columns.items()
    }
