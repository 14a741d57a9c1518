"""The validated scene as a whole, and what holds one.  `validate.validate` is the one way to make it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Annotated, Any, Literal, Protocol

from pydantic import BeforeValidator, SerializeAsAny

from ..base.lines import Written
from ..kinds.base import Coupling, Force, Joint
from ..language.lookup import Book
from ..language.names import Names
from ..model.element import Number, Table, Text
from ..model.readers import (
    Value,
    Vector,
    read_ask,
    read_event,
    read_start,
    read_sweep,
    read_templates,
    read_until,
)
from ..model.tables import Ask, Body, Contact, Event, Find, Ground, Part, Solve, Spin, Sweep
from ..model.tabulated import Tabulated, book_of


@dataclass(frozen=True)
class Source:
    """The TOML that a scene was read from, None if there is none: it makes no difference between scenes."""

    text: Written | None = field(default=None, compare=False)


class SceneData(Table):
    """Bodies in a plane, what holds and moves them, how they start, and what is asked.

    Its words and types are right.  `file` and `source` are where it came from, for messages.

    `hints`: old words in it; `advice`: what is right and may not be meant; one sentence each.  `joined`:
    names that are no plain words; `counted`: parameters on which it depends what there is; `whole`: its
    table with all that other files say of its parts, None where there are none.
    """

    unwritten = (
        "file",
        "source",
        "hints",
        "advice",
        "nudge",
        "equilibrium",
        "run_finds",
        "joined",
        "counted",
        "whole",
    )
    file: str | None = None
    source: Source = Source()
    advice: tuple[str, ...] = ()
    hints: tuple[str, ...] = ()
    joined: frozenset[str] = frozenset()
    counted: frozenset[str] = frozenset()
    whole: Any = None
    id: Text = ""
    title: Text = ""
    description: Text = ""
    plane: Literal["vertical", "horizontal"] = "vertical"
    until: Annotated[tuple[tuple[str, ...], ...], BeforeValidator(read_until)]
    parameters: dict[str, Number] = {}
    tables: dict[str, Tabulated] = {}
    ground: Ground = Ground()
    bodies: dict[str, Body] = {}
    spin: Spin | None = None
    joints: dict[str, SerializeAsAny[Joint]] = {}
    couplings: dict[str, SerializeAsAny[Coupling]] = {}
    contacts: dict[str, Contact] = {}
    forces: dict[str, SerializeAsAny[Force]] = {}
    parts: dict[str, Part] = {}
    templates: Annotated[dict[str, Any], BeforeValidator(read_templates)] = {}
    start: Annotated[dict[str, Value | Vector], BeforeValidator(read_start)] = {}
    nudge: Text | None = None
    equilibrium: bool = False
    events: dict[str, Annotated[Event, BeforeValidator(read_event)]] = {}
    ask: dict[str, Annotated[Ask, BeforeValidator(read_ask)]] = {}
    find: Find | None = None
    runs: dict[str, dict[str, Number]] = {}
    run_finds: dict[str, Find] = {}
    sweep: Annotated[Sweep, BeforeValidator(read_sweep)] = Sweep()
    solve: Solve = Solve()

    @cached_property
    def names(self) -> Names:
        """The names that are no plain words: of parts, and with an index."""
        return Names(self.joined)

    @cached_property
    def book(self) -> Book:
        """The tables of values, as expressions read them, and the names that are no plain words."""
        return book_of(self.tables, self.names)

    def find_of(self, run: str | None) -> tuple[Find, str] | None:
        """What a run looks for - its own find, or that of the scene - and its key path."""
        if run is not None and run in self.run_finds:
            return self.run_finds[run], f"runs.{run}.find"
        return (self.find, "find") if self.find is not None else None


class HasData(Protocol):
    """What holds a validated scene."""

    @property
    def data(self) -> SceneData: ...


class WrittenScene(HasData, Protocol):
    """A scene with what is written: its table as TOML gives it, its file and its text."""

    file: str | None

    @property
    def table(self) -> dict[str, Any]: ...

    @property
    def text(self) -> str: ...

    @property
    def whole_text(self) -> str: ...

    @property
    def run_names(self) -> tuple[str, ...]: ...

    def to_toml(self) -> str: ...

    def with_values(self, values: Mapping[str, Any]) -> WrittenScene: ...
