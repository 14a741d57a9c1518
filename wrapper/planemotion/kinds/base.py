"""What every kind of joint, coupling and force says of itself.

A kind is a class in a file of its own beside this one: its fields are its options, its methods write its rows
and draw it.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import BeforeValidator

from ..geometry.partners import Partner
from ..geometry.push import Push
from ..geometry.rows import CouplingRows, ForceRow, JointRow
from ..geometry.writer import Writer
from ..model.element import Kind, Number, Partners, Quantity, Table
from ..model.readers import Value, read_joint_friction

if TYPE_CHECKING:
    from ..pen.sketch import Sketch
    from ..pen.symbols import Place


class Joint(Kind):
    """What is held both ways, by one row of the kernel's joint table."""

    marks: ClassVar[tuple[tuple[str, ...], tuple[str, ...]]] = (
        ("point",),
        ("point",),
    )  # that partners may be
    quantities: ClassVar[Mapping[str, Quantity]] = {}  # numbers that this kind has beside force and couple
    columns: ClassVar[tuple[str, ...]] = ("force.x", "force.y")  # of a history
    partners: Partners

    @abstractmethod
    def row(self, to: Writer, a: Partner, b: Partner, path: str) -> JointRow:
        """Kind, partners and number of its row.  Raises SceneError for partners that do not fit."""

    @abstractmethod
    def draw(self, sketch: Sketch, a: Partner, b: Partner) -> Place:
        """Draws it; gives the place that its name belongs to."""

    @property
    def holds_direction(self) -> bool:
        """Whether it keeps one body from turning against the other: a blow has a couple there."""
        return False

    def pushes(self, sketch: Sketch, a: Partner, b: Partner) -> Push:
        """Where it acts on its partners."""
        return Push(sketch.both(a, b))


class Bearing(Table):
    """Friction of a pin by its load: the coefficient and the radius where it rubs."""

    mu: Number
    radius: Number


class RubbingJoint(Joint):
    """A joint that may have friction: its coefficient, of a bearing with the radius where it rubs."""

    friction: Annotated[Value | Bearing, BeforeValidator(read_joint_friction)] = 0


class BearingJoint(RubbingJoint):
    """A joint that rubs at the radius of a bearing, also without a load: by a couple of given size."""

    friction_couple: Number = 0


class Coupling(Kind):
    """What relates the motions of bodies: rows of the kernel's joint or contact table."""

    quantities: ClassVar[Mapping[str, Quantity]]
    columns: ClassVar[tuple[str, ...]]  # of a history; of what has strands: for each strand

    @abstractmethod
    def rows(self, to: Writer, path: str) -> CouplingRows:
        """Adds its rows.  Raises SceneError for partners and options that do not fit."""

    @abstractmethod
    def draw(self, sketch: Sketch, where: str) -> Place:
        """Draws it; gives the place that its name belongs to."""

    @property
    def acts_by_couple(self) -> bool:
        """Whether a couple acts on its partners."""
        return "couple" in self.quantities

    def pushes(self, sketch: Sketch, where: str) -> tuple[Push, ...]:
        """Where it acts on its partners: once, or by strands that pull from one end to the other."""
        return ()


class Force(Kind):
    """A force or couple: one row of the kernel's force table."""

    resists: ClassVar[bool] = True  # it answers to the motion, and is not given
    # Numbers that have bounds, (kind, column) of the row -> key and SI unit, for messages.
    bounded: ClassVar[Mapping[tuple[int, int], tuple[str, str]]] = {}
    partners: Partners

    @abstractmethod
    def row(self, to: Writer, path: str) -> ForceRow:
        """What stands in its row.  Raises SceneError for partners and options that do not fit."""

    @abstractmethod
    def draw(self, sketch: Sketch, where: str) -> Place:
        """Draws it; gives the place that its name belongs to."""

    def pushes(self, sketch: Sketch, where: str) -> Push:
        """Where it acts on its partners."""
        partners = sketch.read(self.partners, where, "point")
        return Push(sketch.both(partners[0], partners[-1]))
