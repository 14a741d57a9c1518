"""What acts on each body at an instant of a run: forces and couples with their places, impulses of blows.

Everything is as the kernel recorded it (compile/acts.py), in SI; places are found as they are drawn.  For a
body the forces and their couples about G give m a and I alpha (and what a plane that turns adds to them), and
the impulses of a blow give the change of momentum.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .. import _layout as layout
from ..base.arrays import Floats
from ..base.errors import SceneError
from ..compile.acts import Act, Acts
from ..compile.flatten import FlatScene, flatten
from ..engine import call, recording
from ..engine.history import AFTER, BEFORE
from ..engine.outcome import History
from ..geometry.push import Place, Push
from ..model.tables import Action
from ..pen.sketch import Sketch
from ..reading.scene import HasData
from .instants import is_before, row_at
from .scene import Start, contact_pushes, drawing_of

# How a vector is best shown: as one arrow, by its parts along x and y, or across and along a surface.
WHOLE, BY_AXES, BY_SURFACE = "whole", "axes", "surface"
# What has a vector of any direction, at least if there is no surface.
_ANY_DIRECTION = ("pin", "weld", "contacts", "bodies")
# Of the greatest momentum of the run: what changes by less at an instant was not struck.
_STRUCK = 1e-9
# The name of what was struck at an instant before what is shown.
BLOW_BEFORE = "blow before"


@dataclass(frozen=True)
class Wrench:
    """A vector [2] and a couple (counterclockwise): of forces, of impulses, of m a and I alpha, of momentum.

    Not a number where nothing is known; `couple` is None of a particle.
    """

    vector: Floats
    couple: float | None = None


@dataclass(frozen=True)
class Acting:
    """What one element does to a body: at `place` (m) the vector, and a pure couple.

    `vector`, `couple`: None if it has none, not a number if it has one that nothing tells.  `turn`: direction
    of the surface there (rad), where the vector is a normal force and friction.  `parts`: how to show it.
    `by_balance`: the couple is what the balance of the body wants.
    """

    label: str
    place: Place
    vector: Floats | None
    couple: float | None
    turn: float | None = None
    parts: str = WHOLE
    by_balance: bool = False


@dataclass(frozen=True)
class Balance:
    """What acts on a body, and what that makes: `after` - `before` of its momentum, or its rate."""

    body: str
    center: Place
    acts: tuple[Acting, ...]
    before: Wrench
    after: Wrench

    def missing(self) -> tuple[Floats, float | None]:
        """What is wanted beside `acts` to make `after` of `before`: 0 if all is there.  The couple is about
        the centre, None of a particle; not a number where something is not known."""
        vector = self.after.vector - self.before.vector
        couple = (self.after.couple or 0.0) - (self.before.couple or 0.0)
        for act in self.acts:
            couple -= act.couple or 0.0
            if act.vector is not None:
                x, y = np.subtract(act.place, self.center)
                vector = vector - act.vector
                # What is not known has no couple about its own place.
                couple -= float(x * act.vector[1] - y * act.vector[0]) if x or y else 0.0
        return vector, None if self.after.couple is None else couple


@dataclass(frozen=True)
class Instant:
    """A recorded run and the row of an instant; `start`: the scene in its pose there."""

    start: Start
    flat: FlatScene
    acts: tuple[Act, ...]
    recorded: History
    row: int

    def value(self, name: str, row: int | None = None) -> float:
        """A recorded number; not a number if it is none that can be known."""
        column = self.recorded.columns.get(name)
        return math.nan if column is None else float(column[self.row if row is None else row])

    def vector(self, thing: str, row: int | None = None) -> Floats:
        return np.array([self.value(f"{thing}.{part}", row) for part in ("x", "y")])

    def pose(self, body: str, row: int | None = None) -> tuple[float, float, float]:
        angle = self.value(f"{body}.angle", row)
        x, y = self.vector(body, row)
        return float(x), float(y), 0.0 if math.isnan(angle) else angle

    def flat_values(self) -> Floats:
        """The values of the case that was run [values], SI."""
        found = call.found(self.flat)
        pairs = zip(self.flat.parameters, self.flat.defaults, strict=True)
        return call.values(self.flat, [found.get(name, float(one)) for name, one in pairs])

    @property
    def bodies(self) -> tuple[str, ...]:
        return tuple(self.start.drawing.bodies)


def instant(
    scene: HasData, at: str | None = None, run: str | None = None, *, blow: bool = False, last: bool = False
) -> Instant:
    """A run (default: the first) at an instant as of `instants.instant_of`.

    Without `at`: the start, or (`blow`) the first blow, or (`last`) the end.  Raises SceneError for a fault
    in the scene, for an instant that the run does not come to, and if nothing is struck at it but shall be.
    """
    acts = Acts()
    flat = flatten(scene, run, history=acts.columns)
    if at is None and blow:
        recorded = recording.record(flat, bends={})
        row = next(_blows_of(recorded), 0)
        if not row:
            reason = 'nothing is struck in the run: there is no impulse to draw; "kinetic" draws forces'
            raise SceneError(reason, path="impulse-momentum")
    elif at is None and last:
        recorded = recording.record(flat, bends={})
        row = len(recorded.time) - 1
    else:
        recorded, row = row_at(flat, "0 s" if at is None else at)
        if recorded.mark[row] == BEFORE and (blow or at is None or not is_before(at)):
            row += 1
        if blow and not _struck(recorded, row):
            times = [f"{recorded.time[one]:.6g} s" for one in _blows_of(recorded)]
            known = f"blows of the run are at {', '.join(times)}" if times else "the run has no blow"
            raise SceneError(f"nothing is struck there; {known}", path="at", value=at)
    drawing = drawing_of(scene.data, flat.run, call.found(flat))
    here = Instant(Start(scene.data, drawing, {}), flat, tuple(acts.acts), recorded, row)
    when = f"t = {recorded.time[row]:.6g} s"
    if recorded.events[row]:
        side = "before " if recorded.mark[row] == BEFORE else ""
        when = f"{side}{recorded.events[row]}, {when}"
    poses = {name: here.pose(name) for name in drawing.bodies}
    return replace(here, start=replace(here.start, poses=poses, when=when))


def _blows_of(recorded: History) -> Iterator[int]:
    """The rows right after blows."""
    return (int(row) for row in np.flatnonzero(recorded.mark == AFTER) if _struck(recorded, int(row)))


def _struck(recorded: History, row: int) -> bool:
    """Whether velocities jump between the row before an event and the one after it."""
    if not row or recorded.mark[row] != AFTER or recorded.mark[row - 1] != BEFORE:
        return False
    speeds = {
        name: values
        for name, values in recorded.columns.items()
        if name.endswith((".omega", ".velocity.x", ".velocity.y"))
    }
    return any(
        abs(values[row] - values[row - 1]) > _STRUCK * float(np.nanmax(np.abs(values)))
        for name, values in speeds.items()
        if not name.startswith("spin.")
    )


def forces(at: Instant, bodies: tuple[str, ...] = ()) -> list[Balance]:
    """Of each body (default: all) what acts on it, weights first, and m a and I alpha."""
    pushes = _Pushes(at)
    return [_forces_on(at, pushes, body) for body in bodies or at.bodies]


def _forces_on(at: Instant, pushes: _Pushes, body: str) -> Balance:
    center = at.pose(body)[:2]
    acts: list[Acting] = []
    weight = at.value(f"{body}.weight")
    if at.start.data.plane == "vertical" and not math.isnan(weight):
        acts.append(Acting("weight", center, np.array([0.0, -weight]), None))
    for act in at.acts:
        if act.body != body or act.table == "events":
            continue
        place, along, turn = pushes.of(act)
        vector = _pair(at, act.force) if act.force else None
        if act.tension:
            vector = at.value(act.tension) * along
        couple = act.sign * at.value(act.couple) if act.couple and _acts(at, act) else None
        acts.append(Acting(act.label, place, vector, couple, turn, pushes.parts(act, turn)))
    mass, inertia = at.value(f"{body}.mass"), at.value(f"{body}.inertia")
    rotates = at.start.drawing.bodies[body].rotates
    rate = mass * at.vector(f"{body}.acceleration")
    couple = inertia * at.value(f"{body}.alpha") if rotates else None
    added = _of_turning_plane(at, body, mass)
    after = Wrench(rate + added.vector, None if couple is None else couple + (added.couple or 0.0))
    return _filled(Balance(body, center, tuple(acts), Wrench(np.zeros(2), 0.0), after))


def _acts(at: Instant, act: Act) -> bool:
    """Whether it is there: contacts may be open."""
    return act.closed is None or at.value(act.closed) != 0


def blows(at: Instant, bodies: tuple[str, ...] = ()) -> list[Balance]:
    """Of each body (default: all) the impulses of the blow, and its momenta before and after."""
    pushes = _Pushes(at)
    return [_blow_on(at, pushes, body) for body in bodies or at.bodies]


def _blow_on(at: Instant, pushes: _Pushes, body: str) -> Balance:
    fired = at.recorded.events[at.row].split(", ")
    acts = []
    for act in at.acts:
        if act.body != body or (act.table == "events" and act.name not in fired):
            continue
        place, along, turn = pushes.of(act)
        row = at.row - 1 if act.table == "events" else at.row
        vector = _pair(at, act.impulse, row) if act.impulse else None
        if act.pull:
            vector = at.value(act.pull) * along
        couple = at.value(act.turn, row) if act.turn and _acts(at, act) else None
        if vector is not None or couple is not None:
            acts.append(Acting(act.label, place, vector, couple, turn, pushes.parts(act, turn)))
    center = at.pose(body)[:2]
    if any(_holds(at, action) for name in fired for action in _does(at, name)):
        # Held anew, the bodies strike once more at the same instant; the kernel keeps the last blow only.
        rotates = at.start.drawing.bodies[body].rotates
        acts.append(Acting(BLOW_BEFORE, center, np.full(2, math.nan), math.nan if rotates else None))
    before, after = (_momentum(at, body, row) for row in (at.row - 1, at.row))
    return _filled(Balance(body, center, tuple(acts), before, after))


def _filled(one: Balance) -> Balance:
    """With the couple that the balance gives where it is the only one that nothing tells."""
    unknown = [act for act in one.acts if act.couple is not None and math.isnan(act.couple)]
    if len(unknown) != 1:
        return one
    rest = replace(unknown[0], couple=0.0)
    acts = tuple(rest if act is unknown[0] else act for act in one.acts)
    _, couple = replace(one, acts=acts).missing()
    if couple is None or math.isnan(couple):
        return one
    found = replace(rest, couple=couple, by_balance=True)
    return replace(one, acts=tuple(found if act is rest else act for act in acts))


def _does(at: Instant, name: str) -> tuple[Action, ...]:
    """What the event of that name does; nothing if it is none."""
    event = at.start.data.events.get(name)
    return event.do if event is not None else ()


def _holds(at: Instant, action: Action) -> bool:
    """Whether it adds what bodies are held by."""
    return action.add is not None and action.add not in at.start.data.forces


def _momentum(at: Instant, body: str, row: int) -> Wrench:
    rotates = at.start.drawing.bodies[body].rotates
    spin = at.value(f"{body}.inertia") * at.value(f"{body}.omega", row) if rotates else None
    return Wrench(at.value(f"{body}.mass") * at.vector(f"{body}.velocity", row), spin)


def _pair(at: Instant, names: tuple[str, str], row: int | None = None) -> Floats:
    return np.array([at.value(name, row) for name in names])


def _of_turning_plane(at: Instant, body: str, mass: float) -> Wrench:
    """What m a and I alpha have beside what one sees on a plane that turns with omega about an axis in it.

    -m omega^2 d towards the axis; and the couple of this over the body, -omega^2 (Sx - Sy) sin(2 b) / 2: Sx
    and Sy are the integrals of x^2 and y^2 over its mass in its own axes, b the angle from the axis to its x.
    """
    spins = at.flat.rows(layout.PM_TABLE_SPIN)
    if not len(spins):
        return Wrench(np.zeros(2))
    value = at.flat_values()
    angle = value[spins[0][layout.PM_SPIN_ANGLE]]
    through = np.array([value[spins[0][column]] for column in (layout.PM_SPIN_X, layout.PM_SPIN_Y)])
    x, y, own = at.pose(body)
    across = np.array([-math.sin(angle), math.cos(angle)])
    square = at.value("spin.omega") ** 2
    second = at.flat.rows(layout.PM_TABLE_SECOND)[at.bodies.index(body)]
    apart = value[second[layout.PM_SECOND_X]] - value[second[layout.PM_SECOND_Y]]
    couple = -0.5 * square * apart * math.sin(2 * (own - angle))
    return Wrench(-mass * square * float((np.array([x, y]) - through) @ across) * across, couple)


class _Pushes:
    """Where elements act at an instant."""

    def __init__(self, at: Instant) -> None:
        self.at = at
        self.data = at.start.data
        poses = {name: at.pose(name) for name in at.bodies}
        self.sketch = Sketch(at.start.drawing, poses, "m")
        self._found: dict[tuple[str, str], list[Push]] = {}

    def of(self, act: Act) -> tuple[Place, Floats, float | None]:
        """The place of what acts, the direction of a strand's pull (1), and the surface it touches at."""
        center = self.at.pose(act.body)[:2]
        if act.table == "events":
            return self._applied(act), np.zeros(2), None
        pushes = self._pushes(act)
        if not pushes:
            return center, np.zeros(2), None
        push = pushes[min(act.part or 0, len(pushes) - 1)]
        place, other = push.places[act.side], push.places[1 - act.side]
        along = np.subtract(other, place)
        length = float(np.hypot(*along))
        return place, along / length if length else along, push.turn

    def parts(self, act: Act, turn: float | None) -> str:
        """How its vector is best shown."""
        kind = self.data.joints[act.name].kind if act.table == "joints" else act.table
        return BY_SURFACE if turn is not None else BY_AXES if kind in _ANY_DIRECTION else WHOLE

    def _applied(self, act: Act) -> Place:
        """Where an event applies its impulse."""
        text = self.data.events[act.name].do[act.part or 0].impulse
        assert text is not None
        if "." not in text:
            return self.at.pose(act.body)[:2]
        (point,) = self.sketch.read((text,), f"events.{act.name}", "point")
        return self.sketch.of_partner(point, point)

    def _pushes(self, act: Act) -> list[Push]:
        key = act.table, act.name
        if key not in self._found:
            self._found[key] = list(self._made(act))
        return self._found[key]

    def _made(self, act: Act) -> Iterator[Push]:
        where = f"{act.table}.{act.name}"
        if act.table == "joints":
            joint = self.data.joints[act.name]
            (a,), (b,) = (
                self.sketch.read((text,), where, *wanted)
                for text, wanted in zip(joint.partners, joint.marks, strict=True)
            )
            yield joint.pushes(self.sketch, a, b)
        elif act.table == "couplings":
            yield from self.data.couplings[act.name].pushes(self.sketch, where)
        elif act.table == "contacts":
            yield from contact_pushes(self.sketch, act.name, self.data.contacts[act.name])
        elif act.table == "forces":
            yield self.data.forces[act.name].pushes(self.sketch, where)
