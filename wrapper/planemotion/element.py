"""What the models of a scene begin with, and what every kind of joint, coupling and force says of itself.

A kind is a class in a file of its own in kinds/: its fields are its options, its methods write its rows and
draw it.  kinds/__init__.py has the table of all of them.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from pydantic import BaseModel, BeforeValidator, ConfigDict

from . import _layout as layout
from .units import Dimension
from .written import Value, Vector, read_joint_friction, read_names, read_text, read_value, read_vector

if TYPE_CHECKING:
    from .couplings import CouplingRows
    from .forces import ForceRow
    from .joints import JointRow
    from .partners import Partner
    from .sketch import Sketch
    from .symbols import Place
    from .writer import Writer

Number = Annotated[Value, BeforeValidator(read_value)]
Text = Annotated[str, BeforeValidator(read_text)]
Pair = Annotated[Vector, BeforeValidator(read_vector)]
Partners = Annotated[tuple[str, ...], BeforeValidator(read_names(2, "two partners"))]


class Table(BaseModel):
    """Base of all models: no other keys, no changes."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, strict=True)


class Element(Table):
    """What joints, couplings, contacts and forces share."""

    active: Number = True


@dataclass(frozen=True)
class Quantity:
    """What the word of a quantity reads: kinds of measures of the kernel, one for each strand of a belt.

    `vector`: it has parts; `part`: the one that is meant; `on`: its sign goes with the body that it acts on.
    """

    kinds: tuple[int, ...]
    dimension: Dimension
    vector: bool = False
    part: int = layout.PM_PART_NONE
    on: bool = False


class Kind(Element):
    """A joint, coupling or force of one kind; `word` is its key in a file, `partners` what stands behind it.

    Its other fields are its options: the keys beside that of the kind, with what is taken without them.
    """

    word: ClassVar[str]
    unbuilt: ClassVar[
        Mapping[str, str]
    ] = {}  # options of the language that are not built yet -> what they are
    partners: Any

    @property
    def kind(self) -> str:
        return self.word

    @classmethod
    def options(cls) -> tuple[str, ...]:
        """Its options, those of every element last."""
        common = tuple(Element.model_fields)
        return (*(key for key in cls.model_fields if key not in (*common, "partners")), *common)

    @property
    def written(self) -> tuple[str, ...]:
        """The options that the file gives."""
        given = self.model_fields_set - {"partners"}
        return tuple(key for key in type(self).model_fields if key in given)

    @property
    def between(self) -> str:
        """The partners as one reads them."""
        return " - ".join(self.partners)


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


class Bearing(Table):
    """Friction of a pin by its load: the coefficient and the radius where it rubs."""

    mu: Number
    radius: Number


class RubbingJoint(Joint):
    """A joint that may have friction: of a bearing a couple, by itself or by its load, else a coefficient."""

    bearing: ClassVar[bool] = False
    friction: Annotated[Value | Bearing, BeforeValidator(read_joint_friction)] = 0


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
