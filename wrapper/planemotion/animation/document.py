"""A motion and what is shown beside it as the player reads it: signs on carriers, and packed numbers."""

from __future__ import annotations

from typing import Any

from ..engine.kernel import status_name
from ..pictures.scene import plane_of, title_of
from .beside import Arrow, Beside
from .carried import Followed
from .moving import Motion
from .pack import packed, packed_coarsely

# Names of one kind that are so near at the start, in inches of what is seen then, are written as one.
_NEAR = 0.04


def document(beside: Beside) -> dict[str, Any]:
    """What the player is given, as JSON has it."""
    motion = beside.motion
    recorded, sketch = motion.recorded, motion.sketch(0)
    low, high = sketch.low, sketch.high
    return {
        "title": title_of(motion.data),
        "note": note_of(motion),
        "unit": motion.unit,
        "box": [*map(float, low), *map(float, high)],
        "inch": sketch.page_inch,
        "near": _NEAR * sketch.pen.inch,
        "t": packed(recorded.time),
        "bodies": [_body(motion, one, sketch.factor) for one in beside.arrows["velocity"]],
        "signs": beside.signs,
        "followed": _packed_ways(beside.followed),
        "shows": beside.shows.told(),
        "timing": beside.timing.told(),
        "traces": [{"name": name, "at": anchor} for name, anchor in beside.traces],
        "events": [{"row": row, "name": name} for row, name in beside.events],
        "energies": {kind: packed_coarsely(values) for kind, values in beside.energies.items()},
        **beside.told(),
        "forces": [_packed_arrow(one) for one in beside.arrows["force"]],
        "impulses": [_packed_arrow(one) for one in beside.arrows["impulse"]],
    }


def note_of(motion: Motion) -> str:
    """What stands below the title."""
    status = status_name(motion.recorded.status)
    notes = [plane_of(motion.data), *([f"run {motion.flat.run}"] if motion.flat.run else [])]
    return ", ".join([*notes, *([f"ended early: {status}"] if status != "ok" else [])])


def _body(motion: Motion, velocity: Arrow, metre: float) -> dict[str, Any]:
    columns, name = motion.recorded.columns, velocity.name
    turns = f"{name}.angle" in columns
    return {
        "name": name,
        "x": packed_coarsely(columns[f"{name}.x"] / metre),
        "y": packed_coarsely(columns[f"{name}.y"] / metre),
        "angle": packed(columns[f"{name}.angle"]) if turns else None,
        "vx": packed_coarsely(velocity.x),
        "vy": packed_coarsely(velocity.y),
    }


def _packed_arrow(one: Arrow) -> dict[str, Any]:
    return {"name": one.name, "at": one.at, "x": packed_coarsely(one.x), "y": packed_coarsely(one.y)}


def _packed_ways(followed: Followed) -> dict[str, Any] | None:
    if not followed.places:
        return None
    return {
        "t": packed(followed.times),
        "x": [packed_coarsely(way[:, 0]) for way in followed.ways],
        "y": [packed_coarsely(way[:, 1]) for way in followed.ways],
    }
