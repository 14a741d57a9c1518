"""The plane that turns about an axis in it: the axis and the bodies' second moments, as rows of tables.

What an observer on the plane draws is the scene.  Across the plane everything moves with the spin, so that
a body's inertia about the axis takes the integrals of x^2 and y^2 (its own axes) and of z^2 (across the
plane) over its mass, which only a shape tells.
"""

from __future__ import annotations

import math

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.drawn_rows import DrawnRows
from ..geometry.marks import radius
from ..geometry.packing import Tables, over_time
from ..geometry.parameters import Reader
from ..language.dimensions import ANGULAR_VELOCITY, DIMENSIONLESS, INERTIA, LENGTH, MOMENT
from ..language.tree import ZERO, Node
from ..model.readers import Value, Vector
from ..model.tables import Body, Spin
from ..reading.scene import SceneData

# Integrals of x^2, y^2 and z^2 about G over mass*size^2: a rod by its length, the others by their radius.
# Flat shapes have no z^2 of their own; `depth` gives them depth^2/12.
_SECOND = {
    "rod": (1 / 12, 0.0, 0.0),
    "disk": (1 / 4, 1 / 4, 0.0),
    "cylinder": (1 / 4, 1 / 4, 0.0),
    "hoop": (1 / 2, 1 / 2, 0.0),
    "sphere": (1 / 5, 1 / 5, 1 / 5),
    "half_ring": (1 / 2 - 4 / math.pi**2, 1 / 2, 0.0),
}
# The same of shapes that stand across the plane.
_EDGE_ON = {"disk": (1 / 4, 0.0, 1 / 4), "hoop": (1 / 2, 0.0, 1 / 2)}
# Where the rate of the plane at the start is written.
START_OMEGA = "spin.omega"


class Spins:
    """Adds the spin of a scene to the tables."""

    def __init__(self, drawn: DrawnRows, reader: Reader, tables: Tables) -> None:
        self.drawn = drawn
        self.drawing = drawn.drawing
        self.reader = reader
        self.tables = tables

    def add(self, data: SceneData) -> None:
        """Adds the axis and the second moments of all bodies; nothing if the plane is at rest.

        Raises SceneError for a body whose inertia about the axis is not known.
        """
        if data.spin is None:
            if START_OMEGA in data.start:
                raise SceneError("the scene has no [spin]", path=f"start.{START_OMEGA}")
            return
        self._axis(data.spin, data.start.get(START_OMEGA, 0))
        for name, body in self.drawing.bodies.items():
            self._body(name, body)

    def _axis(self, spin: Spin, omega: Value | Vector) -> None:
        if isinstance(omega, Vector):
            raise SceneError("a number is wanted", path=f"start.{START_OMEGA}")
        value, number = self.tables.value, self.reader.number
        x, y = self.reader.vector(spin.through, "spin.through", LENGTH)
        angle = number(spin.angle, "spin.angle", DIMENSIONLESS)
        couple = layout.PM_NONE
        if spin.couple is not None:
            node = over_time(self.reader, self.tables, spin.couple, "spin.couple", MOMENT)
            couple = self.tables.program(node, "spin.couple")
        where = f"start.{START_OMEGA}"
        row = {
            layout.PM_SPIN_X: value(x, "spin.through"),
            layout.PM_SPIN_Y: value(y, "spin.through"),
            layout.PM_SPIN_ANGLE: value(angle, "spin.angle"),
            layout.PM_SPIN_INERTIA: value(number(spin.inertia, "spin.inertia", INERTIA), "spin.inertia"),
            layout.PM_SPIN_OMEGA: value(number(omega, where, ANGULAR_VELOCITY), where),
            layout.PM_SPIN_COUPLE: couple,
        }
        self.tables.add(layout.PM_TABLE_SPIN, row, "spin")

    def _body(self, name: str, body: Body) -> None:
        path = f"bodies.{name}"
        mass = self.drawn.masses[name]
        if not mass.known:
            raise SceneError("mass or weight is wanted: the body turns with the plane", path=f"{path}.mass")
        second = self._second(name, body, path)
        if body.depth is not None:
            if body.shape == "sphere" or body.edge_on:
                reason = "a sphere has its depth" if body.shape == "sphere" else "edge_on says its depth"
                raise SceneError(f"{reason}; leave it out", path=f"{path}.depth", value=body.depth)
            depth = self.reader.number(body.depth, f"{path}.depth", LENGTH)
            if self.tables.default(depth) < 0:
                raise SceneError("must not be negative", path=f"{path}.depth", value=body.depth)
            second = (second[0], second[1], depth * depth / 12)
        columns = (layout.PM_SECOND_X, layout.PM_SECOND_Y, layout.PM_SECOND_Z)
        row = {
            column: self.tables.value(mass.mass * part, path)
            for column, part in zip(columns, second, strict=True)
        }
        self.tables.add(layout.PM_TABLE_SECOND, row, path)

    def _second(self, name: str, body: Body, path: str) -> tuple[Node, Node, Node]:
        """Second moments over the mass, without the depth."""
        for key in ("inertia", "gyration"):
            if getattr(body, key) is not None:
                reason = (
                    f"about the axis of the spin {key} says too little: a shape is wanted instead "
                    "(what turns along without moving in the plane belongs to spin.inertia)"
                )
                raise SceneError(reason, path=f"{path}.{key}", value=getattr(body, key))
        if body.plate is not None:
            width, height = self.reader.vector(body.plate, f"{path}.plate", LENGTH)
            return width * width / 12, height * height / 12, ZERO
        if body.shape is None:
            return ZERO, ZERO, ZERO
        length = self.drawing.length(name)
        size = length if length is not None else radius(self.reader, name, body)
        x, y, z = (_EDGE_ON if body.edge_on else _SECOND)[body.shape]
        return size * size * x, size * size * y, size * size * z
