"""The one entrance to a validated scene: words first (words.py), then types, then what no type says.

Every fault becomes a SceneError with its key path.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from .._layout import PM_FIND_MOST_PAIR_SAMPLES, PM_FIND_MOST_SAMPLES
from ..base.bounded import check_table
from ..base.errors import Faults, SceneError
from ..base.lines import Written
from ..kinds import KINDS
from ..model import words
from ..model.element import Kind, Table
from ..model.tables import (
    DEFAULT_G,
    DESIGNS,
    Contact,
    Find,
    Sweep,
)
from .advice import advice
from .asked import check_ask
from .cases import with_cases
from .check import check, kind_of
from .measured import add_points
from .places import with_places
from .renamed import renewed
from .scene import SceneData, Source
from .whole import whole_scene


def validate(
    raw: Mapping[str, Any], *, file: str | None = None, name: str = "", text: str | None = None
) -> SceneData:
    """The validated scene of a table as TOML gives it.

    `file` is named in messages, with lines of the `text` that it holds; `name` is the id where the table has
    none.  Raises SceneError for the first fault found, with those that are independent of it.
    """
    written = Written(text)
    try:
        check_table(raw)
        raw = _with_start(raw)
        whole = whole_scene(raw, file, text)
        written = whole.written
        raw, hints = renewed(whole.table)
        check(raw)
        if "until" not in raw:
            raise SceneError('what ends the run is wanted, such as until = "t = 2 s"', path="until")
        if not words.table(raw, "bodies"):
            raise SceneError("a scene needs at least one body", path="bodies")
        parameters = {
            **({} if "g" in words.table(raw, "parameters") else {"g": DEFAULT_G}),
            **raw.get("parameters", {}),
        }
        told = {
            "file": file,
            "source": Source(written),
            "hints": hints,
            "advice": advice(raw, whole.joined | whole.counted),
            "joined": whole.joined,
            "counted": whole.counted,
            "whole": whole.table if whole.from_files else None,
        }
        content = {**raw, "id": raw.get("id", name), "parameters": parameters, **told}
        measured = {"tables": add_points(raw, file)} if "tables" in raw else {}
        measured.update(with_cases({**raw, "parameters": parameters}, file))
        content = with_places(content, file)
        data = _construct({**content, **_taken_apart(raw), **_elements(raw), **measured})
        _check_more(data)
    except SceneError as error:
        raise error.at(file=file, text=written) from None
    return data


def _with_start(raw: Mapping[str, Any]) -> Mapping[str, Any]:
    """The same with a table in place of `start = "equilibrium"`."""
    start = raw.get("start")
    if not isinstance(start, str):
        return raw
    if start != "equilibrium":
        raise SceneError('a table is wanted, or start = "equilibrium"', path="start", value=start)
    return {**raw, "start": {"equilibrium": True}}


def _taken_apart(raw: Mapping[str, Any]) -> dict[str, Any]:
    """What stands beside other things in a table of the file and has a place of its own in the scene."""
    apart: dict[str, Any] = {}
    start = words.table(raw, "start")
    told = {"nudge": str, "equilibrium": bool}
    found = {key for key, kind in told.items() if isinstance(start.get(key), kind)}
    if found:
        apart |= {key: start[key] for key in found}
        apart["start"] = {key: value for key, value in start.items() if key not in found}
    runs = words.table(raw, "runs")
    if any("find" in run for run in runs.values()):
        apart["runs"] = {
            name: {key: value for key, value in run.items() if key != "find"} for name, run in runs.items()
        }
        apart["run_finds"] = {name: run["find"] for name, run in runs.items() if "find" in run}
    return apart


def _elements(raw: Mapping[str, Any]) -> dict[str, dict[str, Kind]]:
    """Joints, couplings, contacts and forces, each as the model of its kind."""
    faults = Faults()
    made: dict[str, dict[str, Kind]] = {group: {} for group in KINDS}
    for group in KINDS:
        for name, element in words.table(raw, group).items():
            with faults.noted():
                made[group][name] = _element(element, group, f"{group}.{name}")
    faults.tell()
    return made


def _element(element: Mapping[str, Any], group: str, path: str) -> Kind:
    kind = kind_of(element, group, path)
    content = {"partners" if key == kind else key: value for key, value in element.items()}
    try:
        return KINDS[group][kind].model_validate(content)
    except ValidationError as fault:
        raise _translate(fault, path, {"partners": kind}) from None


def _construct(content: Mapping[str, Any]) -> SceneData:
    try:
        return SceneData.model_validate(content)
    except ValidationError as fault:
        raise _translate(fault) from None


def _translate(fault: ValidationError, path: str = "", called: Mapping[str, str] | None = None) -> SceneError:
    """Pydantic's complaints in the manner of this package: one for each key, the first with the others.

    `path`: what was constructed; `called`: how a file calls fields that have another name in the model.
    """
    told: dict[str | None, SceneError] = {}
    for complaint in fault.errors():
        error = _complaint(complaint, path, called)
        told.setdefault(error.path, error)
    first, *others = told.values()
    first.others = tuple(others)
    return first


def _complaint(first: Any, path: str, called: Mapping[str, str] | None) -> SceneError:
    # Parts of a location that are names of types or models are no keys.
    keys = [part for part in first["loc"] if not (isinstance(part, str) and _is_type(part))]
    for key in keys:
        part = called.get(key, key) if called and isinstance(key, str) else key
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    path = path.replace("sweep.grids.", "sweep.")
    path = re.sub(r"^run_finds\.(\w+)", r"runs.\1.find", path)
    path = f"start.{path}" if path in ("nudge", "equilibrium") else path
    written = first.get("input")
    shown = written if isinstance(written, str | int | float | bool | list) else None
    if first["type"] == "missing":
        return SceneError("it is wanted and left out", path=path)
    if first["type"] == "value_error":
        return SceneError(str(first["ctx"]["error"]), path=path, value=shown)
    if first["type"] in ("dict_type", "model_type", "model_attributes_type"):
        return SceneError(
            "a table with words of its own is wanted: { KEY = ..., ... }", path=path, value=shown
        )
    wanted = (
        first["msg"]
        .removeprefix("Input should be ")
        .replace("a valid boolean", "true or false")
        .replace("a valid integer", "a whole number")
        .replace("'", '"')
    )
    return SceneError(f"{wanted} is wanted", path=path, value=shown)


def _is_type(part: str) -> bool:
    return (
        (part[:1].isupper() and part in _MODELS)
        or "-" in part
        or "[" in part
        or part in ("str", "int", "float", "bool")
    )


_MODELS = {model.__name__ for model in Table.__subclasses__()}


def _check_more(data: SceneData) -> None:
    """Faults between keys that no type says."""
    _check_spin(data)
    solve = data.solve
    if solve.route not in words.ROUTES:
        raise SceneError(words.unknown(solve.route, words.ROUTES, "route"), path="solve.route")
    if solve.impacts is not None and solve.impacts not in words.IMPACTS:
        reason = words.unknown(solve.impacts, words.IMPACTS, "order of impacts")
        raise SceneError(reason, path="solve.impacts")
    if solve.shared not in words.SHARED:
        reason = words.unknown(solve.shared, words.SHARED, "way to share a load")
        raise SceneError(reason, path="solve.shared")
    for key in ("max_events", "max_steps"):
        if getattr(solve, key) < 1:
            raise SceneError("at least 1 is wanted", path=f"solve.{key}", value=getattr(solve, key))
    for name, contact in data.contacts.items():
        _check_law(contact, f"contacts.{name}")
        if contact.stiffness is not None and solve.impacts == "sequential":
            reason = 'stiffnesses share one blow; with solve.impacts = "sequential" there is nothing to share'
            raise SceneError(reason, path=f"contacts.{name}.stiffness", value=contact.stiffness)
        if contact.capture != "none":
            _check_capture(contact, f"contacts.{name}")
    for name, event in data.events.items():
        if event.nth is not None and event.nth < 1:
            raise SceneError("firings are counted from 1", path=f"events.{name}.nth", value=event.nth)
    for name, ask in data.ask.items():
        check_ask(data, ask, f"ask.{name}")
    _check_counted(data)
    for run in data.runs or (None,):
        found = data.find_of(run)
        if found is not None:
            _check_find(data, *found, run)
    zipped = [name for group in data.sweep.zip for name in group]
    for name in (*data.sweep.grids, *zipped):
        if name not in data.parameters and not words.is_option(name):
            reason = words.unknown(name, tuple(data.parameters), "parameter")
            raise SceneError(reason + '; or an option such as "contacts.floor.law"', path=f"sweep.{name}")
        if name in data.sweep.grids and name not in data.parameters and data.sweep.grids[name].values is None:
            reason = 'a list of what the option may be is wanted, such as ["newton", "poisson"]'
            raise SceneError(reason, path=f"sweep.{name}")
    for name in zipped:
        if name not in data.sweep.grids:
            raise SceneError("zipped, but it has no grid", path=f"sweep.{name}")
        if zipped.count(name) > 1:
            raise SceneError(f'"{name}" is zipped twice', path="sweep.zip")
        if data.sweep.grids[name].is_drawn:
            raise SceneError(f'"{name}" has a distribution; what is drawn moves together', path="sweep.zip")
        if data.sweep.grids[name].listed:
            raise SceneError(f'"{name}" is listed in cases; a row of them moves together', path="sweep.zip")
    _check_design(data.sweep)
    if data.sweep.retry is not None and not data.sweep.retry.model_fields_set:
        raise SceneError("settings are wanted, such as { accuracy = 1e-12 }", path="sweep.retry")
    for index, name in enumerate((data.sweep.refine and data.sweep.refine.of) or ()):
        if name not in data.ask:
            raise SceneError(words.unknown(name, data.ask, "ask"), path=f"sweep.refine.of[{index}]")


def _check_counted(data: SceneData) -> None:
    """One scene serves all its runs and all that a find tries: they cannot change what there is."""
    finds = [found for run in data.runs or (None,) if (found := data.find_of(run)) is not None]
    places = [(f"runs.{run}", set(values)) for run, values in data.runs.items()]
    for path, given in [*places, *((f"{path}.vary", set(find.vary)) for find, path in finds)]:
        for name in sorted(data.counted.intersection(given)):
            reason = f"{name} says what there is in the scene; a sweep or --set can change it"
            raise SceneError(reason, path=f"{path}.{name}")
    for name in sorted(data.counted.intersection(data.sweep.grids)):
        if data.sweep.grids[name].is_drawn:
            reason = f"{name} says what there is in the scene; it takes a grid, no distribution"
            raise SceneError(reason, path=f"sweep.{name}")


def _check_design(sweep: Sweep) -> None:
    drawn = [name for name, one in sweep.grids.items() if one.is_drawn]
    if drawn and sweep.design is None:
        reason = "a distribution needs a design that draws from it, such as sweep.design = { latin = 200 }"
        raise SceneError(reason, path=f"sweep.{drawn[0]}")
    if sweep.design is None:
        return
    given = [word for word in DESIGNS if getattr(sweep.design, word) is not None]
    if len(given) != 1:
        reason = f"one of {', '.join(DESIGNS)} is wanted" + (f", not {' and '.join(given)}" if given else "")
        raise SceneError(reason, path="sweep.design")
    if not drawn:
        reason = 'no parameter has a distribution, such as sweep.m = { uniform = ["1 kg", "2 kg"] }'
        raise SceneError(reason, path="sweep.design")


def _check_spin(data: SceneData) -> None:
    """Raises SceneError for words of a spin where there is none, or that do not fit the shape."""
    for name, body in data.bodies.items():
        path = f"bodies.{name}"
        given = "depth" if body.depth is not None else "edge_on" if body.edge_on else None
        if given is not None and data.spin is None:
            reason = "what is across the plane matters only where the plane turns: [spin] is wanted"
            raise SceneError(reason, path=f"{path}.{given}")
        if body.edge_on and body.shape not in words.EDGE_ON_SHAPES:
            raise SceneError(
                f"only a {' or a '.join(words.EDGE_ON_SHAPES)} has edge_on", path=f"{path}.edge_on"
            )
        if body.depth is not None and not body.rotates:
            raise SceneError("a particle has no depth", path=f"{path}.depth", value=body.depth)


def _check_capture(contact: Contact, path: str) -> None:
    """What arrives stays: no other law of contact is left to say."""
    for key, none in (("restitution", (0,)), ("friction", (0, "smooth")), ("law", ("newton",))):
        if getattr(contact, key) not in none:
            raise SceneError(f"what is captured stays; it has no {key}", path=f"{path}.{key}")
    if contact.surface_speed is not None:
        reason = "what is captured stays at its place; the surface cannot run on below it"
        raise SceneError(reason, path=f"{path}.surface_speed", value=contact.surface_speed)


def _check_law(contact: Contact, path: str) -> None:
    """The law of a contact's blows; a restitution along it goes with friction and the law newton."""
    if contact.law not in words.LAWS:
        raise SceneError(words.unknown(contact.law, words.LAWS, "impact law"), path=f"{path}.law")
    if contact.stiffness is not None and contact.law != "stronge":
        reason = f'a stiffness shares a blow by its work: write law = "stronge", not "{contact.law}"'
        raise SceneError(reason, path=f"{path}.stiffness", value=contact.stiffness)
    if contact.tangential is None:
        return
    where = f"{path}.tangential"
    if contact.friction in (0, "smooth"):
        reason = 'a restitution along the contact needs friction, such as friction = "rough"'
        raise SceneError(reason, path=where, value=contact.tangential)
    if contact.law != "newton":
        reason = f"it belongs to the law newton; the law {contact.law} says itself how the slip ends"
        raise SceneError(reason, path=where, value=contact.tangential)


def _check_find(data: SceneData, find: Find, path: str, run: str | None) -> None:
    if not 1 <= len(find.vary) <= 2:
        reason = f"one or two parameters can be sought, not {len(find.vary)}"
        raise SceneError(reason, path=f"{path}.vary")
    for name in find.vary:
        if name not in data.parameters:
            raise SceneError(
                words.unknown(name, tuple(data.parameters), "parameter"), path=f"{path}.vary.{name}"
            )
        if name in data.sweep.grids:
            raise SceneError("it is swept; it cannot be sought, too", path=f"{path}.vary.{name}")
        if run is not None and name in data.runs[run]:
            raise SceneError(f"runs.{run} gives it; it cannot be sought, too", path=f"{path}.vary.{name}")
    if find.greatest is not None and find.least is not None:
        raise SceneError("greatest or least, not both", path=path)
    if not find.where and find.goal is None:
        raise SceneError("what makes a value the right one is wanted: where, greatest or least", path=path)
    most = PM_FIND_MOST_SAMPLES if len(find.vary) == 1 else PM_FIND_MOST_PAIR_SAMPLES
    if not 2 <= find.intervals <= most:
        raise SceneError(f"2 to {most} are possible", path=f"{path}.samples", value=find.samples)
