"""A weld: two bodies are rigid as drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.partners import Partner
from ..geometry.push import Push
from ..geometry.rows import JointRow
from ..geometry.writer import Writer
from .base import Joint

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Weld(Joint):
    word = "weld"
    columns = ("force.x", "force.y", "couple")

    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        for one in (a, b):
            if one.name not in ("", "G"):
                reason = "bodies are welded as drawn; name the body only"
                raise SceneError(reason, path=one.where, value=str(one.ref))
        rotating = [to.rotates(one.owner) for one in (a, b)]
        if not any(rotating):
            raise SceneError(
                "two particles would have to rotate; give one of the bodies an inertia", path=path
            )
        # The place where both are held: the mass centre of the one that does not rotate, else of the first.
        held = b if (rotating[0] and not rotating[1]) or a.is_ground else a
        position = to.drawing.position(held.ref)
        points = [
            to.drawn.point_at(one.owner, to.drawing.to_body(one.owner, position), path) for one in (a, b)
        ]
        if not all(rotating):
            return JointRow(layout.PM_JOINT_PIN, points[0], points[1])
        angle = to.drawing.angle(a.owner) - to.drawing.angle(b.owner)
        return JointRow(layout.PM_JOINT_WELD, points[0], points[1], (angle, path))

    @property
    def holds_direction(self) -> bool:
        return True

    def pushes(self, sketch: Sketch, a: Partner, b: Partner) -> Push:
        # Held as row() says: the kernel's reaction acts there.
        held = b if (sketch.rotates(a) and not sketch.rotates(b)) or a.is_ground else a
        at = sketch.of_partner(held, a if held is b else b)
        return Push((at, at))

    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        at = sketch.of_partner(a, b)
        sketch.pen.weld(at)
        return at
