"""From a validated scene to the kernel's tables.

`flatten` goes through the scene once: parameters, drawing (bodies and marks), joints, contacts, forces,
measures in start values, events, the end of the run and asks, settings.  Every number becomes a value
program over the parameters, so that one `FlatScene` serves all cases of a sweep.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from .. import _layout as layout
from ..base.errors import Faults, SceneError
from ..base.lines import Written
from ..geometry.checks import Checks
from ..geometry.drawing import Drawing
from ..geometry.drawn_rows import DrawnRows
from ..geometry.packing import Tables
from ..geometry.parameters import Parameters, Reader, is_zero, override
from ..geometry.writer import Writer
from ..kinds.base import Coupling, Force, Joint
from ..language.dimensions import DIMENSIONLESS, LENGTH, TIME
from ..language.tree import ZERO, Name, negative
from ..model.readers import Value
from ..model.tables import Action, Body, Contact
from ..model.words import GROUND, IMPACTS, ROUND_SHAPES, SHARED, unknown
from ..reading.scene import HasData, SceneData
from .actions import Actions, add_nudge
from .ask_order import in_order
from .asks import EACH_FIRINGS, Asked, Asks
from .bounds import check_bounds
from .contacts import Contacts
from .elements import JointInfo, add_coupling, add_force, add_joint, drive
from .ends import check_ends
from .events import Instants, add_event, firing
from .finds import Finds, FlatFind
from .histories import Columns, HistoryColumns
from .measure_rows import Scope
from .measures import Measures
from .spin import Spins
from .starts import Starts
from .switches import Switches

# Whether a history can be made, and of what: all, nothing, or these expressions; none: the usual.
History: TypeAlias = bool | Sequence[str] | Callable[[HistoryColumns], Columns]
_E = TypeVar("_E", Body, Joint, Coupling, Contact, Force)
_COLUMNS = {
    number: getattr(layout, f"{name.replace('_TABLE_', '_')}_COLUMNS")
    for name, number in layout.pm_table.items()
    if name != "PM_TABLES"
}
_SHARED = dict(zip(SHARED, layout.pm_shared_setting.values(), strict=False))
_IMPACTS = dict(zip((*IMPACTS, None), layout.pm_simultaneous.values(), strict=False))


@dataclass(frozen=True)
class FlatScene:
    """The tables of one run of a scene, and what turns their numbers back into words.

    `table`, `constant`: as planemotion.h says.  `parameters`: names of the columns of param, with `defaults`
    (SI) and `units` as in the file.  `asks`: columns of out.  `names[table][row]`: key paths.  `trace`:
    column name -> (program, unit) of a history.  `bodies`, `points`: names by kernel index.  `find`: what is
    sought, if anything.  `instants`: likewise, what tells which events fired at an instant of a history.
    `decided`: parameters by whose defaults more was decided than the tables say; `checks`: what their
    values must satisfy.  `source`: the text of the
    file, for lines in messages.
    """

    id: str
    run: str | None
    file: str | None
    table: npt.NDArray[np.int32]
    constant: npt.NDArray[np.float64]
    parameters: tuple[str, ...]
    defaults: npt.NDArray[np.float64]
    units: tuple[str, ...]
    asks: tuple[Asked, ...]
    names: Mapping[int, tuple[str, ...]]
    trace: Mapping[str, tuple[int, str]]
    bodies: tuple[str, ...]
    find: FlatFind | None = None
    instants: Mapping[str, tuple[int, str]] = field(default_factory=dict)
    decided: frozenset[str] = frozenset()
    checks: Checks = field(default_factory=Checks)
    source: Written | None = None

    @cached_property
    def out_columns(self) -> int:
        """Columns of the results' `out`."""
        return sum(ask.columns for ask in self.asks)

    @cached_property
    def ask_rows(self) -> int:
        """Rows of the table of asks, and so columns of the results' `reason`."""
        return sum(ask.rows for ask in self.asks)

    def rows(self, table: int) -> npt.NDArray[np.int32]:
        """One table [rows, its columns], integers as planemotion.h says."""
        first, count = self.table[2 * table : 2 * table + 2]
        columns = _COLUMNS[table]
        return self.table[first : first + count * columns].reshape(count, columns)


def flatten(
    scene: SceneData | HasData,
    run_name: str | None = None,
    *,
    history: History = True,
    firings: int = EACH_FIRINGS,
) -> FlatScene:
    """The tables of a scene.

    `run_name` chooses one of [runs]; without it the first is taken if there are any.  An ask that names no
    run is answered in the first.  Swept parameters are columns of `param` even where the file gives an
    expression.  `history`: with the columns of one, which a sweep does not need: all there are, or those of
    motion, energies and what the asks read (empty), or these expressions, or what a function chooses.
    `firings`: how long an answer "each EVENT" may be.  Raises SceneError with file and key path.
    """
    data = scene if isinstance(scene, SceneData) else scene.data
    try:
        return _Flattener(data, run_name).flat(history, firings)
    except SceneError as error:
        raise error.at(file=data.file, text=data.source.text) from None


class _Flattener:
    """One pass over the scene; each step adds to the same tables."""

    def __init__(self, data: SceneData, run_name: str | None) -> None:
        self.data = data
        self.run = _run(data, run_name)
        declared = run_parameters(data, self.run)
        self.find = data.find_of(self.run)
        self.varied = self.find[0].vary if self.find is not None else {}
        self.parameters = Parameters(declared, {*data.sweep.grids, *self.varied}, data.book)
        self.reader = Reader(self.parameters)
        self.tables = Tables(self.parameters)
        self.actions = self._active_actions()
        self.absent: dict[str, str] = {}
        bodies = self._active("bodies", data.bodies)
        self.drawing = Drawing(data, bodies, self.reader, self.tables)
        self.drawn = DrawnRows(self.drawing, self.tables)
        self.writer = Writer(self.drawn, self.reader, self.tables)
        self.scope = self._elements()
        self.measures = Measures(self.drawn, self.reader, self.tables, self.scope)
        self.switches = Switches(self.measures, self.tables)
        self.writer.motion.finish(self.switches.read, self.switches.program)

    def flat(self, history: History, firings: int) -> FlatScene:
        data, tables = self.data, self.tables
        self._check_masses()
        Spins(self.drawn, self.reader, tables).add(data)
        Starts(self.drawn, self.reader, self.measures, tables, at_rest=data.equilibrium).add(
            data.start, self._fastened()
        )
        nudge = layout.PM_NONE
        if data.nudge is not None:
            nudge = add_nudge(data.nudge, self.measures, tables, "start.nudge")
        instants = Instants(self.scope.events, self.measures, tables, self.switches.watched)
        instants.add_events(data.events)
        actions = Actions(self.measures, tables)
        actions.absent(self.absent)
        for name, done in self.actions.items():
            actions.add(self.scope.events[name], done)
        instants.add_until(data.until)
        watched = self.switches.watched
        bounds = self._bounds()
        asks = Asks(self.scope.events, bounds, self.measures, self.reader, tables, watched, firings)
        first_run = next(iter(data.runs), None)
        asked = {key: ask for key, ask in data.ask.items() if (ask.run or first_run) == self.run}
        order = in_order(asked, data.ask, self.measures.knows, self.parameters.parse)
        Faults().make({key: asked[key] for key in order}, asks.add)
        found = None
        if self.find is not None:
            finds = Finds(self.scope.events, asks, self.measures, self.reader, tables)
            found = finds.add(*self.find)
        self._settings(nudge)
        trace, told = self._recorded(history)
        self._check_sizes()
        check_bounds(tables, data)
        check_ends(tables, data, {*data.sweep.grids, *self.varied})
        table, constant = tables.pack()
        independent = self.parameters.independent
        return FlatScene(
            id=data.id,
            run=self.run,
            file=data.file,
            table=table,
            constant=constant,
            parameters=independent,
            defaults=np.array([self.parameters.defaults[name] for name in independent], dtype=np.float64),
            units=tuple(self.parameters.units[name] for name in independent),
            asks=tuple(asks.columns),
            names={index: tuple(paths) for index, paths in tables.names.items()},
            trace=trace,
            bodies=tuple(self.drawing.bodies),
            find=found,
            instants=told,
            decided=frozenset(self.parameters.decided) | data.counted,
            checks=tables.checks(),
            source=data.source.text,
        )

    def _recorded(self, history: History) -> tuple[Columns, Columns]:
        """The columns of a history, and what tells of its instants."""
        columns = HistoryColumns(self.measures, self.tables, self.scope, self.drawing)
        if history is False:
            return {}, {}
        if callable(history):
            return history(columns), columns.instants()
        if history is True:
            return columns.everything(), columns.instants()
        chosen = columns.chosen(history) if history else columns.of_asks(self.data.ask)
        return chosen, columns.instants()

    # ---- elements ----

    def _active(self, group: str, elements: Mapping[str, _E]) -> dict[str, _E]:
        """The elements whose `active` holds at the parameters of this run."""
        return {
            name: one
            for name, one in elements.items()
            if self._is_active(one.active, f"{group}.{name}.active")
        }

    def _present(self, group: str, elements: Mapping[str, _E]) -> dict[str, _E]:
        """The elements that are active, or become so by what some event does: those are absent at first."""
        active = self._active(group, elements)
        added = {action.add for done in self.actions.values() for _, action in done}
        later = {name for name in elements if name in added and name not in active}
        self.absent |= {name: f"{group}.{name}.active" for name in elements if name in later}
        return {name: one for name, one in elements.items() if name in active or name in later}

    def _active_actions(self) -> dict[str, list[tuple[str, Action]]]:
        """What each event does in this run, with the key paths."""
        found: dict[str, list[tuple[str, Action]]] = {}
        for name, event in self.data.events.items():
            written = [(f"events.{name}.do[{index}]", action) for index, action in enumerate(event.do)]
            found[name] = [one for one in written if self._is_active(one[1].active, f"{one[0]}.active")]
        return found

    def _is_active(self, written: Value, where: str) -> bool:
        node = self.reader.number(written, where, DIMENSIONLESS)
        depends = self.reader.depends_on(node)
        sought = sorted(depends & set(self.varied))
        if sought:
            reason = f"what is active cannot depend on {sought[0]}, which is sought"
            raise SceneError(reason, path=where, value=written)
        return self.reader.default(node) != 0

    def _elements(self) -> Scope:
        data = self.data
        joints = self._present("joints", data.joints)
        couplings = self._present("couplings", data.couplings)
        contacts = self._present("contacts", data.contacts)
        forces = self._present("forces", data.forces)
        groups = (
            (data.bodies, self.drawing.bodies),
            (data.joints, joints),
            (data.couplings, couplings),
            (data.contacts, contacts),
            (data.forces, forces),
        )
        inactive = {name for written, active in groups for name in written if name not in active}
        to = self.writer
        add_contact = Contacts(self.drawn, self.reader, self.tables).add
        driven = {name: body for name, body in self.drawing.bodies.items() if body.driven is not None}
        drives = {name: drive(to, name, body) for name, body in driven.items()}
        return Scope(
            driven=drives,
            joints=Faults().make(joints, partial(add_joint, to)),
            couplings=Faults().make(couplings, partial(add_coupling, to)),
            contacts=Faults().make(contacts, add_contact),
            forces=Faults().make(forces, partial(add_force, to)),
            events={
                name: add_event(self.tables, f"events.{name}", event.nth)
                for name, event in data.events.items()
            },
            inactive=frozenset(inactive),
        )

    def _fastened(self) -> set[str]:
        """Bodies that some joint holds: the assembly may move them."""
        joints = {name: joint for name, joint in self.scope.joints.items() if name not in self.absent}
        held = {owner for joint in joints.values() for owner in joint.owners}
        return held | {name for name, body in self.drawing.bodies.items() if body.driven is not None}

    def _check_sizes(self) -> None:
        """Lengths, widths and radii of shapes are positive (their inertia alone would not tell)."""
        for name, body in self.drawing.bodies.items():
            sizes = {key: getattr(body, key) for key in ("length", *ROUND_SHAPES)}
            if body.plate is not None:
                sizes |= {"plate[0]": body.plate.first, "plate[1]": body.plate.second}
            for key, size in sizes.items():
                if size is None:
                    continue
                where = f"bodies.{name}.{key}"
                node = self.reader.number(size, where, LENGTH)
                if not self.tables.is_positive(node):
                    found = self.tables.default(node)
                    raise SceneError(f"it is {found:.6g} m; a size must be positive", path=where, value=size)

    def _check_masses(self) -> None:
        """A mass may be left out only if the mass centre cannot move: it is pinned to the ground."""
        removed = {action.remove for done in self.actions.values() for _, action in done}
        stay = [
            joint
            for name, joint in self.scope.joints.items()
            if name not in self.absent and name not in removed
        ]
        for name, mass in self.drawn.masses.items():
            if (
                self.drawing.bodies[name].driven is None
                and not mass.known
                and not any(_holds(joint, name, self.drawing) for joint in stay)
            ):
                reason = "mass or weight is wanted (unless the mass centre is pinned to the ground)"
                raise SceneError(reason, path=f"bodies.{name}.mass")

    def _bounds(self) -> dict[int, int]:
        """How often an event can fire, where the end of the run is a firing of it alone."""
        bounds: dict[int, int] = {}
        for group in self.data.until:
            found = firing(group[0], self.scope.events, "until") if len(group) == 1 else None
            if found is not None:
                event, nth = found
                bounds[event] = min(nth or 1, bounds.get(event, nth or 1))
        return bounds

    # ---- settings ----

    def _settings(self, nudge: int) -> None:
        solve, value = self.data.solve, self.tables.value
        down = negative(Name("g")) if self.data.plane == "vertical" else ZERO
        accuracy = self.reader.number(solve.accuracy, "solve.accuracy", DIMENSIONLESS)
        assembly = self.reader.number(solve.assembly_tolerance, "solve.assembly_tolerance", DIMENSIONLESS)
        exponent = self.reader.number(solve.stiffness_exponent, "solve.stiffness_exponent", DIMENSIONLESS)
        row = {
            layout.PM_SETTING_GRAVITY_X: value(ZERO, "plane"),
            layout.PM_SETTING_GRAVITY_Y: value(down, "parameters.g"),
            layout.PM_SETTING_ACCURACY: value(accuracy, "solve.accuracy"),
            layout.PM_SETTING_MAX_TIME: self._limit(solve.max_time, "solve.max_time"),
            layout.PM_SETTING_ASSEMBLY: value(assembly, "solve.assembly_tolerance"),
            layout.PM_SETTING_ROUTE: layout.pm_route[f"PM_ROUTE_{solve.route.upper()}"],
            layout.PM_SETTING_MAX_EVENTS: solve.max_events,
            layout.PM_SETTING_MAX_STEPS: solve.max_steps,
            layout.PM_SETTING_NUDGE: nudge,
            layout.PM_SETTING_ESTIMATE: int(solve.estimate),
            layout.PM_SETTING_SIMULTANEOUS: _IMPACTS[solve.impacts],
            layout.PM_SETTING_MAX_CPU: self._limit(solve.max_cpu, "solve.max_cpu"),
            layout.PM_SETTING_SHARED: _SHARED[solve.shared],
            layout.PM_SETTING_EXPONENT: value(exponent, "solve.stiffness_exponent"),
            layout.PM_SETTING_EQUILIBRIUM: int(self.data.equilibrium),
        }
        self.tables.add(layout.PM_TABLE_SETTING, row, "solve")

    def _limit(self, written: Value | None, where: str) -> int:
        """The value of a time that ends a run; none if it is left out."""
        if written is None:
            return layout.PM_NONE
        return self.tables.value(self.reader.number(written, where, TIME), where)

    # ---- for people ----


def _run(data: SceneData, name: str | None) -> str | None:
    """The run to be flattened: the one named, else the first, else none."""
    if name is None:
        return next(iter(data.runs), None)
    if name not in data.runs:
        raise SceneError(unknown(name, data.runs, "run"), path="runs")
    return name


def run_parameters(data: SceneData, run: str | None) -> dict[str, Value]:
    """The parameters as declared, with what the run gives for them."""
    declared = dict(data.parameters)
    for name, value in (data.runs[run] if run is not None else {}).items():
        try:
            declared[name] = override(data.parameters, name, value, data.book)
        except SceneError as error:
            raise SceneError(error.reason, path=f"runs.{run}.{name}", value=value) from None
    return declared


def _holds(joint: JointInfo, name: str, drawing: Drawing) -> bool:
    """Whether a joint pins the mass centre of a body to the ground."""
    if joint.kind != "pin" or set(joint.owners) != {name, GROUND}:
        return False
    own = next(partner for partner in joint.partners if partner.owner == name)
    x, y = drawing.local(own.ref)
    return is_zero(x) and is_zero(y)
