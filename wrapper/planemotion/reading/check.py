"""The check of every key before anything is read from a scene.

A key is known, known but not built yet, or unknown; the last two are errors, so that nothing written is
silently ignored.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ..base.errors import Faults, SceneError, nearest
from ..kinds import KINDS
from ..language.tree import WRITTEN_FUNCTIONS
from ..model import words
from ..model.curve import Curve
from ..model.element import Table
from ..model.readers import DISTRIBUTIONS, SWEEP_KEYS
from ..model.tables import (
    Action,
    Ask,
    At,
    Body,
    Circle,
    Design,
    Driven,
    Event,
    Find,
    Grid,
    Ground,
    Line,
    Refine,
    Retry,
    Row,
    Solve,
    Spin,
)
from ..model.tabulated import Tabulated
from .scene import SceneData

# Kinds of the language that are not built yet -> what they are.
# Tables of a sweep beside its grids, and what a message calls them.
_OF_SWEEP: Mapping[str, tuple[type[Table], str]] = {
    "design": (Design, "a design"),
    "refine": (Refine, "a refinement"),
    "retry": (Retry, "a retry"),
}

# Unknown keys whose hint is more than another word: by their owner, which `NAME` stands for.
_HINTS: Mapping[str, Mapping[str, str]] = {
    "a scene": {"gravity": '; where no weight acts in the plane write plane = "horizontal"'},
    "a pin": dict.fromkeys(
        ("omega", "speed", "rate", "velocity", "value", "rpm"),
        '; a motor drives it: couplings.motor = { motor = ["crank", "ground"], value = "10 rad/s" }',
    ),
    "a body": {
        "velocity": '; at the start it is given by start.NAME.velocity = ["1 m/s", 0]',
        "omega": '; at the start it is given by start.NAME.omega = "1 rad/s"',
        "restitution": "; contacts have it",
        "friction": "; contacts have it",
    },
}


def check(raw: Mapping[str, Any]) -> None:
    """Raises SceneError for keys that are unknown or not built yet, and for names that clash: all of them."""
    faults = Faults()
    _each(faults, _keys, raw, SceneData.file_keys(), "", "a scene", ("parameters.g",))
    for name, value in words.table(raw, "parameters").items():
        _each(faults, _parameter, name, value)
    _each(faults, _ground, words.table(raw, "ground"))
    _each(faults, _keys, words.table(raw, "spin"), Spin.file_keys(), "spin", "a spin")
    for name, one in words.table(raw, "tables").items():
        _each(faults, _table, name, one)
    for name, body in words.table(raw, "bodies").items():
        _each(faults, _body, body, f"bodies.{name}")
    for group in KINDS:
        for name, element in words.table(raw, group).items():
            _each(faults, _element, element, group, name)
    _each(faults, _unique, raw)
    _instants(raw, faults)
    _each(faults, _keys, words.table(raw, "solve"), Solve.file_keys(), "solve", "[solve]")
    for name, values in words.table(raw, "runs").items():
        _each(faults, _run, raw, name, values)
    if "find" in raw:
        _each(faults, _find, raw["find"], "find")
    faults.tell()


def _parameter(name: str, value: Any) -> None:
    if name != "t":  # a parameter may have that name: the time is then called time
        words.check_name(name, "parameters")
    if isinstance(value, Mapping):
        raise SceneError(_VALUE_TABLE, path=f"parameters.{name}")


def _table(name: str, table: Any) -> None:
    words.check_name(name, "tables")
    if name in WRITTEN_FUNCTIONS:
        raise SceneError("it is the name of a function; choose another name", path=f"tables.{name}")
    path = f"tables.{name}"
    _keys(words.mapping(table, path), Tabulated.file_keys(), path, "a table of values")


def _run(raw: Mapping[str, Any], name: str, values: Any) -> None:
    parameters = ("g", *words.table(raw, "parameters"))
    path = f"runs.{name}"
    _keys(words.mapping(values, path), (*parameters, "find"), path, "a run of this scene")
    if "find" in values:
        _find(values["find"], f"{path}.find")


_VALUE_TABLE = (
    'a table of values has a name of its own: tables.push = { at = ["0 s", "1 s"], value = ["0 N", "5 N"] }, '
    'then value = "push(t)"'
)


def kind_of(element: Mapping[str, Any], group: str, path: str) -> str:
    """The one kind key of an element.  Raises SceneError if there is none or more than one."""
    kinds = KINDS[group]
    given = [kind for kind in kinds if kind in element]
    if len(given) == 1:
        return given[0]
    wanted = f"which kind of {words.SINGULAR[group]}? one of {', '.join(kinds)} is wanted"
    if len(given) > 1:
        raise SceneError(f"{wanted}, not {' and '.join(given)}", path=path)
    for key in element:
        guess = nearest(key, kinds)
        if guess:
            wanted += f' ("{key}": did you mean "{guess}"?)'
            break
        owner = next((other for other in KINDS if key in KINDS[other]), None)
        if owner is not None:
            wanted += f"; {key} is a {words.SINGULAR[owner]}: write it in [{owner}]"
            break
    raise SceneError(wanted, path=path)


def _each(faults: Faults, one: Callable[..., None], *given: Any) -> None:
    """Looks at one thing by itself: its fault is noted."""
    with faults.noted():
        one(*given)


def _keys(
    given: Iterable[str],
    known: tuple[str, ...],
    path: str,
    owner: str,
    elsewhere: tuple[str, ...] = (),
) -> None:
    """`elsewhere`: what may be meant and stands in another table."""
    faults = Faults()
    for key in given:
        if key not in known:
            _each(faults, _unknown_key, key, known, path, owner, elsewhere)
    faults.tell()


def _unknown_key(
    key: str,
    known: tuple[str, ...],
    path: str,
    owner: str,
    elsewhere: tuple[str, ...],
) -> None:
    full = f"{path}.{key}" if path else key
    guess = nearest(key, [*known, *elsewhere])
    has = f"{owner} has {', '.join(known)}" if known else f"{owner} has no options"
    hint = f' (did you mean "{guess}"?)' if guess else ""
    more = _HINTS.get(owner, {}).get(key, "").replace("NAME", path.rpartition(".")[2])
    raise SceneError(f"unknown key{hint}{more}; {has}", path=full)


def _marks(owner: Mapping[str, Any], path: str) -> None:
    quantities = (*words.BODY_QUANTITIES, *words.POINT_QUANTITIES, words.DRIVEN)
    for group in ("points", "lines", "circles", "rows", "curves"):
        for name, mark in words.mapping(owner.get(group, {}), f"{path}.{group}").items():
            place = f"{path}.{group}.{name}"
            words.check_name(name, f"{path}.{group}")
            if name in quantities:
                raise SceneError(f'"{name}" is a quantity in addresses; choose another name', path=place)
            if not isinstance(mark, Mapping):
                continue
            match group:
                case "points":
                    _keys(mark, ("from", "by", "polar"), place, "a point")
                case "lines":
                    _keys(mark, Line.file_keys(), place, "a line")
                case "circles":
                    _keys(mark, Circle.file_keys(), place, "a circle")
                case "rows":
                    _keys(mark, Row.file_keys(), place, "a row")
                case "curves":
                    _keys(mark, Curve.file_keys(), place, "a curve")


def _ground(ground: Mapping[str, Any]) -> None:
    _keys(ground, Ground.file_keys(), "ground", "the ground")
    _marks(ground, "ground")


def _body(body: Any, path: str) -> None:
    _keys(words.mapping(body, path), Body.file_keys(), path, "a body")
    if "driven" in body:
        _keys(
            words.mapping(body["driven"], f"{path}.driven"),
            Driven.file_keys(),
            f"{path}.driven",
            "a driven body",
        )
    given = [shape for shape in words.SHAPES if shape in body]
    if len(given) > 1:
        raise SceneError(f"one shape is possible, not {' and '.join(given)}", path=path)
    for option, shape in (("length", "rod"), ("corners", "plate")):
        if option in body and shape not in body:
            raise SceneError(f"only a {shape} has {option}", path=f"{path}.{option}")
    _marks(body, path)


def _element(element: Any, group: str, name: str) -> None:
    path = f"{group}.{name}"
    if not isinstance(element, Mapping):
        kinds = ", ".join(KINDS[group])
        reason = (
            f"a table is wanted: {{ KIND = ..., and options }}; a {words.SINGULAR[group]} is one of {kinds}"
        )
        raise SceneError(reason, path=path, value=element)
    kind = kind_of(element, group, path)
    article = "an" if kind[0] in "aeiou" else "a"
    known = KINDS[group][kind]
    _keys([key for key in element if key != kind], known.options(), path, f"{article} {kind}")
    if isinstance(element.get("value"), Mapping) and "polar" not in element["value"]:
        raise SceneError(_VALUE_TABLE, path=f"{path}.value")


def _unique(raw: Mapping[str, Any]) -> None:
    """Elements need no prefix in addresses, so their names must differ."""
    owner: dict[str, str] = {}
    for group in ("bodies", "joints", "couplings", "contacts", "forces", "events"):
        for name in words.table(raw, group):
            words.check_name(name, group)
            if name in owner:
                raise SceneError(f"the name is taken by {owner[name]}.{name}", path=f"{group}.{name}")
            owner[name] = group


def _instants(raw: Mapping[str, Any], faults: Faults) -> None:
    for name, event in words.table(raw, "events").items():
        _each(faults, _event, event, f"events.{name}")
    for name, ask in words.table(raw, "ask").items():
        _each(faults, _ask, ask, f"ask.{name}")
    for name, grid in words.table(raw, "sweep").items():
        if name not in SWEEP_KEYS:
            _each(faults, _swept, grid, f"sweep.{name}")
    for key, (model, what) in _OF_SWEEP.items():
        if isinstance(words.table(raw, "sweep").get(key), Mapping):
            _keys(raw["sweep"][key], model.file_keys(), f"sweep.{key}", what)


def _event(event: Any, path: str) -> None:
    if isinstance(event, Mapping):
        _keys(event, Event.file_keys(), path, "an event")
        _actions(event.get("do", ()), f"{path}.do")


def _ask(ask: Any, path: str) -> None:
    if not isinstance(ask, Mapping):
        return
    _keys(ask, Ask.file_keys(), path, "an ask")
    at = ask.get("at")
    if isinstance(at, Mapping):
        _keys(at, At.file_keys(), f"{path}.at", "an instant")
        _grid(at.get("values"), f"{path}.at.values")


def _actions(actions: Any, path: str) -> None:
    if not isinstance(actions, list | tuple):
        raise SceneError(
            'a list of actions is wanted, such as [{ remove = "cord" }]', path=path, value=actions
        )
    for index, action in enumerate(actions):
        where = f"{path}[{index}]"
        given = [kind for kind in Action.kinds if kind in words.mapping(action, where)]
        if len(given) != 1:
            wanted = f"one of {', '.join(Action.kinds)} is wanted"
            raise SceneError(wanted + (f", not {' and '.join(given)}" if given else ""), path=where)
        _keys(action, (given[0], *Action.kinds[given[0]], "active"), where, f"an action {given[0]}")


def _find(find: Any, path: str) -> None:
    _keys(words.mapping(find, path), Find.file_keys(), path, "a find")
    if "vary" not in find:
        reason = 'what is sought is wanted, such as vary = { h = ["0 m", "2 m"] }'
        raise SceneError(reason, path=f"{path}.vary")
    if not isinstance(find["vary"], Mapping):
        reason = 'the ranges to look in are wanted, such as vary = { h = ["0 m", "2 m"] }'
        raise SceneError(reason, path=f"{path}.vary", value=find["vary"])


def _swept(swept: Any, path: str) -> None:
    if isinstance(swept, Mapping):
        drawn = set(DISTRIBUTIONS).intersection(swept)
        keys = (*DISTRIBUTIONS, "within") if drawn else Grid.file_keys()
        _keys(swept, keys, path, "a distribution" if drawn else "a grid")


def _grid(grid: Any, path: str) -> None:
    if isinstance(grid, Mapping):
        _keys(grid, Grid.file_keys(), path, "a grid")
