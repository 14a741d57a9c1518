"""What a scene is made of and how it will be computed, in words; and how its start was assembled.

`check` assembles the start and counts coordinates, rows and degrees of freedom; `explain` also lists what the
scene has, with its masses in SI; `explain_run` tells what happened in a run.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from .. import _layout as layout
from ..compile.flatten import FlatScene
from ..engine import call
from ..engine.outcome import Start
from ..model.element import Kind
from ..model.readers import Vector
from ..model.tables import Action, Event, Friction, Spin
from ..reading.scene import HasData, SceneData
from .aligned import aligned
from .plan import plan, ran, shared_lines

if TYPE_CHECKING:
    from ..engine.result import RunResult

# A start that the assembly moved by more than this part of the scene's size is worth a warning.
_FAR = 0.05
_EQUILIBRIA = {
    layout.PM_EQUILIBRIUM_STABLE: "in a stable equilibrium",
    layout.PM_EQUILIBRIUM_NEUTRAL: "in a neutral equilibrium (nothing draws back what moves on)",
    layout.PM_EQUILIBRIUM_UNSTABLE: "in an unstable equilibrium",
    layout.PM_EQUILIBRIUM_NOT_TOLD: "in an equilibrium (its forces are not smooth: stable or not)",
}


class Tabled(HasData, Protocol):
    """A scene that keeps its tables, so that what is told of it one after the other makes them once."""

    def tables(self, *, history: bool = False) -> list[FlatScene]: ...


@dataclass(frozen=True, repr=False)
class Told:
    """A text for people, and what is wrong, one message each; Python shows both."""

    text: str
    faults: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return "\n".join([self.text, *(f"error: {fault}" for fault in self.faults)])


def check(scene: Tabled) -> Told:
    """The assembled start of a scene, of each of its [runs].  Raises SceneError for a fault in the scene."""
    texts, faults = [], []
    for flat in scene.tables(history=True):
        start = call.check(flat)
        texts.append("\n".join([_title(flat, start.message), *_indented(_assembly(start))]))
        if start.message:
            faults.append(start.message)
    return Told("\n".join(texts), tuple(faults))


def explain(scene: Tabled) -> Told:
    """The whole scene in words.  Raises SceneError for a fault in it."""
    data = scene.data
    flats = scene.tables(history=True)
    starts = [call.check(flat) for flat in flats]
    blocks = [
        [data.id + (f": {data.title}" if data.title else "")],
        [
            (f"{data.plane} plane" if data.spin is None else "plane that turns about an axis in it")
            + (", weight acts along -y" if data.plane == "vertical" else ", weight does not act in it")
        ],
        _section("parameters", ((name, _written(value)) for name, value in data.parameters.items())),
        _section("spin", _spin(data)),
        *(_bodies(data, flat, start) for flat, start in zip(flats, starts, strict=True)),
        _section(
            "joints",
            ((name, joint.kind, joint.between, _options(joint)) for name, joint in data.joints.items()),
        ),
        _section(
            "couplings",
            (
                (name, coupling.kind, coupling.between, _options(coupling), *_most(name, flats))
                for name, coupling in data.couplings.items()
            ),
        ),
        _section(
            "contacts",
            ((name, contact.between, _laws(contact)) for name, contact in data.contacts.items()),
        ),
        _section(
            "forces",
            ((name, force.kind, force.between, _options(force)) for name, force in data.forces.items()),
        ),
        _section(
            "start",
            (
                *([("in an equilibrium near the positions given",)] if data.equilibrium else []),
                *((address, _written(value)) for address, value in data.start.items()),
            ),
        ),
        _section("events", (_event(name, event) for name, event in data.events.items())),
        _section("until", ((" and ".join(group),) for group in data.until)),
        _section(
            "asks",
            ((key, ask.text, f"[{ask.unit}]" if ask.unit else "") for key, ask in data.ask.items()),
        ),
        *(_finds(data)),
        *(_motion(flat, start) for flat, start in zip(flats, starts, strict=True)),
        *(plan(flat, start) for flat, start in zip(flats, starts, strict=True)),
    ]
    faults = tuple(start.message for start in starts if start.message)
    return Told("\n\n".join("\n".join(block) for block in blocks if block), faults)


def explain_run(scene: Tabled, result: RunResult) -> str:
    """The phases of a run, and the evidence for its answers."""
    blocks = [ran(flat) for flat in scene.tables(history=True)]
    return "\n" + "\n\n".join([*("\n".join(block) for block in blocks if block), result.explain()])


def _event(name: str, event: Event) -> tuple[str, ...]:
    """An event, when it fires and what it does."""
    when = " or ".join(event.when) + (f", time {event.nth}" if event.nth is not None else "")
    return (name, when, *([", then ".join(_action(one) for one in event.do)] if event.do else ()))


def _action(action: Action) -> str:
    if action.add is not None:
        text = f"add {action.add}"
    elif action.remove is not None:
        text = f"remove {action.remove}"
    elif action.nudge is not None:
        text = f"nudge {action.nudge}"
    elif action.work is not None:
        text = f"work {action.work} on {action.impulse}"
    else:
        text = f"impulse {_written(action.value)} on {action.impulse}"
    return text if action.active is True else f"{text} if {action.active}"


def _title(flat: FlatScene, fault: str) -> str:
    run = f", run {flat.run}" if flat.run is not None else ""
    return f"{flat.id}{run}: {'the start cannot be assembled' if fault else 'ok'}"


def _finds(data: SceneData) -> list[list[str]]:
    """What is sought, of each run."""
    found = {}
    for run in data.runs or (None,):
        sought = data.find_of(run)
        if sought is not None:
            find, path = sought
            vary = [f"{name}  {low} .. {high}" for name, (low, high) in find.vary.items()]
            goal = [f"{find.goal} {getattr(find, find.goal)}"] if find.goal else []
            found[path] = [(*vary, *goal, " and ".join(find.where))]
    return [_section(path, rows) for path, rows in found.items()]


# ---- the start ------------------------------------------------------------------------------------------


def _assembly(start: Start) -> list[str]:
    """Freedom of the motion, and how far the assembly had to move what is drawn."""
    info, number = start.info, start.number
    lines = []
    if not start.message:
        lines += [
            f"{_count(info['freedom'], 'degree')} of freedom: {_count(info['coordinates'], 'coordinate')}, "
            f"{_count(info['constraints'], 'constraint')} of joints and closed contacts, "
            f"{info['redundant']} of them redundant",
            f"{_count(info['closed'], 'contact')} closed at the start",
        ]
    size, moved = number["size"], number["moved"]
    share = moved / size if size > 0 else 0.0
    if not start.message or moved > 0:
        lines.append(
            f"the assembly moved the drawing by {moved:.3g} m at most ({share:.2%} of the scene's size)"
        )
    if not start.message and share > _FAR:
        lines.append(f"warning: that is far (more than {_FAR:.0%}): look at it with `planemotion draw`")
    if not start.message and info["equilibrium"]:
        lines.append(
            f"{_EQUILIBRIA[info['equilibrium']]}, {number['settled']:.3g} m at most from where it was drawn"
        )
    if info["redundant"] and not start.message:
        lines += shared_lines(start.shared)
    return lines


def _motion(flat: FlatScene, start: Start) -> list[str]:
    run = f" of run {flat.run}" if flat.run is not None else ""
    return [f"motion{run}", *_indented(_assembly(start))] if not start.message else []


def _bodies(data: SceneData, flat: FlatScene, start: Start) -> list[str]:
    """Shape, mass, inertia and assembled place of each body."""
    values = call.values(flat)
    rows = flat.rows(layout.PM_TABLE_BODY)
    lines = []
    for index, name in enumerate(flat.bodies):
        body, row = data.bodies[name], rows[index]
        mass, inertia = (
            float(values[row[column]]) for column in (layout.PM_BODY_MASS, layout.PM_BODY_INERTIA)
        )
        x, y, angle = (float(part) for part in start.pose[index])
        kind = body.shape or ("body" if body.rotates else "particle")
        place = f"G at ({_short(x)}, {_short(y)}) m" + (
            f", angle {_short(angle)} rad" if body.rotates else ""
        )
        turning = f"{inertia:.6g} kg*m^2" if body.rotates else ""
        lines.append((name, kind, f"{mass:.6g} kg", turning, place if not start.message else ""))
    return _section(f"bodies of run {flat.run}" if flat.run is not None else "bodies", lines)


def _short(number: float) -> str:
    return f"{number:.6g}" if abs(number) > 1e-12 else "0"


def _spin(data: SceneData) -> list[tuple[str, str]]:
    """The axis of the plane, and what turns along."""
    if data.spin is None:
        return []
    given = [key for key in Spin.file_keys() if key in data.spin.model_fields_set]
    return [(key, _written(getattr(data.spin, key))) for key in given]


# ---- words ----------------------------------------------------------------------------------------------


def _section(title: str, rows: Iterable[Sequence[str]]) -> list[str]:
    """A title and aligned rows below it; nothing if there are none."""
    lines = aligned(rows)
    return [title, *_indented(lines)] if lines else []


def _indented(lines: Iterable[str]) -> list[str]:
    return [f"  {line}".rstrip() for line in lines]


def _options(element: Kind) -> str:
    """The options that were written."""
    return ", ".join(f"{key} = {_written(getattr(element, key))}" for key in element.written)


def _most(coupling: str, flats: Sequence[FlatScene]) -> list[str]:
    """What a belt that may slip drives with at most, in each run where it is another force."""
    found = []
    for flat in flats:
        names = flat.names[layout.PM_TABLE_FORCE]
        for name, row in zip(names, flat.rows(layout.PM_TABLE_FORCE), strict=True):
            rubs = row[layout.PM_FORCE_KIND] == layout.PM_FORCE_FRICTION
            most = float(call.values(flat)[row[layout.PM_FORCE_VALUE_1]]) if rubs else 0.0
            if name == f"couplings.{coupling}.friction" and most > 0:
                found.append(f"{most:.6g} N")
    return [f"drives with {', '.join(dict.fromkeys(found))} at most"] if found else []


def _laws(contact: Any) -> str:
    if contact.capture != "none":
        return f"captures as a {contact.capture}"
    friction = contact.friction
    if isinstance(friction, Friction):
        text = f"friction {_written(friction.static)} static, {_written(friction.kinetic)} kinetic"
    elif friction in (0, "smooth"):
        text = "smooth"
    else:
        text = "rough" if friction == "rough" else f"friction {_written(friction)}"
    text = f"restitution {_written(contact.restitution)}, {text}"
    if contact.tangential is not None:
        text += f", {_written(contact.tangential)} along it"
    if contact.law != "newton":
        text += f", law {contact.law}"
    if contact.stiffness is not None:
        text += f", stiffness {_written(contact.stiffness)}"
    return (
        text if contact.painleve == "stop" else f"{text}, where no motion exists an impact without collision"
    )


def _written(value: object) -> str:
    if isinstance(value, Vector):
        pair = f"[{_written(value.first)}, {_written(value.second)}]"
        return f"polar {pair}" if value.polar else pair
    return ("true" if value else "false") if isinstance(value, bool) else str(value)


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
