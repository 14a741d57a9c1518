"""Rows of the kernel's tables as kinds write them: kind, indices of partners, values with key paths."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from .. import _layout as layout
from ..language.tree import Node


@dataclass(frozen=True)
class Span:
    """A strand: its row of the contact table, and which of the two it is of a cord over a rim, 0 or 1."""

    index: int
    member: int = layout.PM_NONE


@dataclass(frozen=True)
class CouplingRows:
    """Where the rows of a coupling are, and whose they are.

    `index`: its row of the joint table; None where its strands are the contacts `indices`.  `owners`: of its
    partners; of strands, those of each.  `spans`: of a cord, the contact of each strand and its number there.
    `forces`: rows of the force table that come and go with it; `rests_on`: joints without which it cannot be;
    `may_slip`: its joint has friction that is overcome.
    """

    index: int | None
    indices: tuple[int, ...]
    owners: tuple[tuple[str, str], ...]
    spans: tuple[Span, ...] = ()
    forces: tuple[int, ...] = ()
    rests_on: frozenset[int] = frozenset()
    may_slip: bool = False


@dataclass(frozen=True)
class ForceRow:
    """A row of the kernel's force table: enum pm_force_kind, partners, numbers and programs with key paths.

    `owners`: of its partners; `rotary`: whether it is a couple; `free`: length or angle
    from which its stretch counts, where the row has it not; `stores`: it has a potential.
    """

    kind: int
    a: int
    b: int
    owners: tuple[str, ...]
    values: tuple[tuple[Node, str], ...] = ()
    programs: tuple[tuple[Node, str], ...] = ()
    option: int = 0
    rotary: bool = False
    free: Node | None = None
    stores: bool = False


class JointRow(NamedTuple):
    """A row of the kernel's joint table: enum pm_joint_kind, both partners, number with its key path, what is
    prescribed of it over t."""

    kind: int
    a: int
    b: int
    value: tuple[Node, str] | None = None
    programs: tuple[Node, ...] = ()
