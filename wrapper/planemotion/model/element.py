"""What the models of a scene begin with: tables, elements, and kinds of elements with their options."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

from pydantic import BaseModel, BeforeValidator, ConfigDict

from .. import _layout as layout
from ..language.dimensions import Dimension
from .readers import Value, Vector, read_names, read_text, read_value, read_vector

Number = Annotated[Value, BeforeValidator(read_value)]
Text = Annotated[str, BeforeValidator(read_text)]
Pair = Annotated[Vector, BeforeValidator(read_vector)]
Partners = Annotated[tuple[str, ...], BeforeValidator(read_names(2, "two partners", '["rod.A", "ground"]'))]


class Table(BaseModel):
    """Base of all models: no other keys, no changes."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, strict=True)
    unwritten: ClassVar[tuple[str, ...]] = ()  # fields that are no keys of a file

    @classmethod
    def file_keys(cls) -> tuple[str, ...]:
        """The keys that a file may give, in the order of messages."""
        fields = cls.model_fields.items()
        return tuple(field.alias or name for name, field in fields if name not in cls.unwritten)


class Element(Table):
    """What joints, couplings, contacts and forces share."""

    active: Number = True


@dataclass(frozen=True)
class Quantity:
    """What the word of a quantity reads: kinds of measures of the kernel, one for each strand of a belt.

    `strand`: what it reads of the contacts that a coupling is made of, where these are no `kinds`;
    `rim`: what it reads of a strand of a cord over a rim that it may slip on; `of_rims`: it is read alone of
    what may slip on rims; `vector`: it has parts; `part`: the one that is meant; `on`: its sign goes with the
    body that it acts on.
    """

    kinds: tuple[int, ...]
    dimension: Dimension
    vector: bool = False
    part: int = layout.PM_PART_NONE
    on: bool = False
    strand: int | None = None
    rim: int | None = None
    of_rims: bool = False


class Kind(Element):
    """A joint, coupling or force of one kind; `word` is its key in a file, `partners` what stands behind it.

    Its other fields are its options: the keys beside that of the kind, with what is taken without them.
    """

    word: ClassVar[str]
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
