"""What acts on each body - forces, couples and the impulses of blows - as columns of a history.

One `Act` is what one element does to one of its bodies.  The names of its columns are addresses where there
is one for them; what cannot be read (the couple's impulse of a weld, a reaction that needs a mass that was
left out) has no column.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from .. import _layout as layout
from ..language.address import Address
from ..model.words import GROUND
from .elements import CouplingInfo
from .histories import Columns, HistoryColumns

# Of a body: what its momenta and their rates are made of.
_OF_BODY = ("x", "y", "velocity.x", "velocity.y", "acceleration.x", "acceleration.y", "mass", "weight")
_OF_TURNING_BODY = ("angle", "omega", "alpha", "inertia")
_ENERGIES = ("energy.kinetic", "energy.potential", "energy.lost", "spin.omega")
_ACTION_KINDS = (layout.PM_ACTION_IMPULSE, layout.PM_ACTION_ANGULAR, layout.PM_ACTION_WORK)


@dataclass(frozen=True)
class Act:
    """What an element does to a body: names of columns; None where it does no such thing.

    `table`: joints, couplings, contacts, forces, bodies (what drives one) or events (an impulse of what it
    does).  `side`: which of its two partners the body is.  `part`: number of the strand or of the member,
    from 0.  `tension`, `pull`: of a strand, along it: force and impulse.
    """

    body: str
    table: str
    name: str
    side: int = 0
    part: int | None = None
    force: tuple[str, str] | None = None
    couple: str | None = None
    tension: str | None = None
    impulse: tuple[str, str] | None = None
    turn: str | None = None
    pull: str | None = None
    sign: float = 1.0  # of its couple
    closed: str | None = None  # whether it acts at all

    @property
    def label(self) -> str:
        """Its name for people: strands are numbered from 1, as in addresses."""
        number = None if self.part is None else self.part + (self.table == "couplings")
        return self.name if number is None else f"{self.name}[{number}]"


@dataclass
class Acts:
    """Chooses the columns of a history (`columns`), and then knows what acts (`acts`)."""

    acts: list[Act] = field(default_factory=list)

    def columns(self, made: HistoryColumns) -> Columns:
        """The columns of all acts and of the bodies' motion; those that need an unknown mass are left out."""
        self.acts = [
            *_joints(made),
            *_couplings(made),
            *_contacts(made),
            *_forces(made),
        ]
        wanted = [name for act in self.acts for name in _named(act)]
        for name, body in made.drawing.bodies.items():
            wanted += [f"{name}.{one}" for one in (*_OF_BODY, *(_OF_TURNING_BODY if body.rotates else ()))]
        wanted += [f"{name}.work" for name in made.scope.forces]
        found = made.there((*wanted, *_ENERGIES))
        self._add_drives(made, found)
        self._add_impulses(made, found)
        return found

    def _add_drives(self, made: HistoryColumns, found: Columns) -> None:
        """What holds driven bodies to their motion: rows of joints without a name of their own."""
        for index, path in enumerate(made.tables.names[layout.PM_TABLE_JOINT]):
            name = path.removeprefix("bodies.").removesuffix(".driven")
            if path != f"bodies.{name}.driven" or f"{name}.mass" not in found:
                continue
            kind = made.tables.rows[layout.PM_TABLE_JOINT][index][layout.PM_JOINT_KIND]
            if kind in (layout.PM_JOINT_DRIVE, layout.PM_JOINT_PLACED):
                force = tuple(
                    _leaf(made, found, f"{path}.{part}", layout.PM_MEASURE_JOINT_FORCE, index, code)
                    for part, code in (("x", layout.PM_PART_X), ("y", layout.PM_PART_Y))
                )
                self.acts.append(Act(name, "bodies", name, force=(force[0], force[1])))
            else:
                couple = _leaf(made, found, f"{path}.couple", layout.PM_MEASURE_JOINT_COUPLE, index)
                self.acts.append(Act(name, "bodies", name, couple=couple))

    def _add_impulses(self, made: HistoryColumns, found: Columns) -> None:
        """The impulses that events apply: their own programs, read when they act."""
        paths = made.tables.names[layout.PM_TABLE_ACTION]
        for row, path in zip(made.tables.rows[layout.PM_TABLE_ACTION], paths, strict=True):
            kind = row[layout.PM_ACTION_KIND]
            if kind not in _ACTION_KINDS:
                continue
            event = path.removeprefix("events.").rpartition(".do[")[0]
            number = int(path.rpartition("[")[2].rstrip("]"))
            part = number if f"events.{event}.do[1]" in paths else None
            names = [f"{path}.{part}" for part in ("x", "y")]
            programs = row[layout.PM_ACTION_PROGRAM_X], row[layout.PM_ACTION_PROGRAM_Y]
            if kind == layout.PM_ACTION_IMPULSE:
                body = made.tables.rows[layout.PM_TABLE_POINT][row[layout.PM_ACTION_A]][layout.PM_POINT_BODY]
                found |= {name: (program, "N*s") for name, program in zip(names, programs, strict=True)}
                act = Act("", "events", event, part=part, impulse=(names[0], names[1]))
            else:
                body = row[layout.PM_ACTION_A]
                if kind == layout.PM_ACTION_ANGULAR:
                    found[path] = programs[0], "N*m*s"
                act = Act("", "events", event, part=part, turn=path)
            self.acts.append(replace(act, body=list(made.drawing.bodies)[body]))


def _named(act: Act) -> Iterator[str]:
    """The columns of an act."""
    for pair in (act.force, act.impulse):
        yield from pair or ()
    yield from (name for name in (act.couple, act.tension, act.turn, act.pull, act.closed) if name)


def _leaf(
    made: HistoryColumns, found: Columns, name: str, kind: int, index: int, part: int = layout.PM_PART_NONE
) -> str:
    """A column of a row that has no address."""
    leaf = made.measures.rows.leaf(kind, index, Address("bodies"), part=part)
    unit = "N*m" if kind == layout.PM_MEASURE_JOINT_COUPLE else "N"
    found[name] = made.tables.program(leaf, name), unit
    return name


def _pair(thing: str, word: str, body: str) -> tuple[str, str]:
    return f"{thing}.{word}.x on {body}", f"{thing}.{word}.y on {body}"


def _sides(owners: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    """The partners that are bodies, with their sides."""
    return ((side, owner) for side, owner in enumerate(owners) if owner != GROUND)


def _joints(made: HistoryColumns) -> Iterator[Act]:
    for name, joint in made.scope.joints.items():
        for side, body in _sides(joint.owners):
            turns = made.drawing.bodies[body].rotates
            yield Act(
                body,
                "joints",
                name,
                side,
                force=_pair(name, "force", body),
                couple=f"{name}.couple on {body}" if turns else None,
                impulse=_pair(name, "impulse", body),
                # The kernel keeps no impulse of a couple: "?" where there may be one.
                turn=f"{name}.?" if turns and joint.joint.holds_direction else None,
            )


def _couplings(made: HistoryColumns) -> Iterator[Act]:
    for name, info in made.scope.couplings.items():
        words = info.coupling.quantities
        if "tension" in words:
            yield from _strands(name, info)
            continue
        for side, body in _sides(info.owners[0]):
            vector = "force" in words
            yield Act(
                body,
                "couplings",
                name,
                side,
                force=_pair(name, "force", body) if vector else None,
                couple=f"{name}.couple on {body}" if info.coupling.acts_by_couple else None,
                impulse=_pair(name, "impulse", body) if vector else None,
                turn=None if vector else f"{name}.?",
            )


def _strands(name: str, info: CouplingInfo) -> Iterator[Act]:
    """What pulls along strands."""
    count = len(info.coupling.quantities["tension"].kinds) if info.index is not None else len(info.spans)
    owners = info.owners if len(info.owners) == count else info.owners * count
    for part in range(count):
        number = f"[{part + 1}]" if count > 1 else ""
        for side, body in _sides(owners[part]):
            yield Act(
                body,
                "couplings",
                name,
                side,
                part if count > 1 else None,
                tension=f"{name}.tension{number}",
                pull=f"{name}.impulse{number}",
            )


def _contacts(made: HistoryColumns) -> Iterator[Act]:
    for name, contact in made.scope.contacts.items():
        for part in range(len(contact.indices)) if contact.is_set else (None,):
            thing = name if part is None else f"{name}[{part}]"
            for side, body in _sides(contact.owners):
                forces, impulses = _pair(thing, "force", body), _pair(thing, "impulse", body)
                unread = f"{thing}.?" if contact.holds_direction else None
                couple = f"{thing}.couple on {body}" if contact.holds_direction else None
                yield Act(
                    body,
                    "contacts",
                    name,
                    side,
                    part,
                    forces,
                    couple,
                    impulse=impulses,
                    turn=unread,
                    closed=f"{thing}.closed",
                )


def _forces(made: HistoryColumns) -> Iterator[Act]:
    for name, force in made.scope.forces.items():
        for side, body in _sides(force.owners):
            if force.rotary:
                yield Act(body, "forces", name, side, couple=f"{name}.couple", sign=-1.0 if side else 1.0)
            else:
                yield Act(body, "forces", name, side, force=_pair(name, "force", body))
