"""The words of the scene language, and the check of every key before anything is read from it.

Tables here say which keys a table has, which kinds an element, which options a kind.  A key is known, known
but not built yet, or unknown; the last two are errors, so that nothing written is silently ignored.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from .address import KEYWORDS
from .errors import SceneError, nearest

TOP_KEYS = (
    *("id", "title", "description", "plane", "until", "parameters", "ground", "bodies", "spin", "joints"),
    *("couplings", "contacts", "forces", "start", "events", "ask", "find", "runs", "sweep", "solve"),
)

SHAPES = ("rod", "disk", "cylinder", "hoop", "sphere", "half_ring", "plate")
EDGE_ON_SHAPES = ("disk", "hoop")
ROUND_SHAPES = ("disk", "cylinder", "hoop", "sphere", "half_ring")
BODY_KEYS = (
    *SHAPES,
    *("length", "corners", "mass", "weight", "inertia", "gyration", "mass_center"),
    *("points", "lines", "circles", "at", "angle", "driven", "depth", "edge_on", "active"),
)
GROUND_KEYS = ("points", "lines", "circles", "rows")
ROW_KEYS = ("from", "step", "count")
SPIN_KEYS = ("through", "angle", "inertia", "couple")
DRIVEN_KEYS = ("velocity", "omega")

# Element tables: kind -> options; `active` goes with every kind.
KINDS: dict[str, dict[str, tuple[str, ...]]] = {
    "joints": {
        "pin": ("friction",),
        "slider": ("turning", "friction"),
        "slot": ("friction",),
        "link": ("length",),
        "weld": (),
        "rolling": (),
    },
    "couplings": {
        "gears": (),
        "belt": ("crossed",),
        "cord": ("length", "slack", "restitution"),
        "rate": ("value",),
    },
    "contacts": {
        "touch": (*("restitution", "friction", "tangential", "normal", "law", "capture", "surface_speed"),)
    },
    "forces": {
        "spring": ("stiffness", "free_length", "only"),
        "torsion": ("stiffness", "free_angle"),
        "damper": ("rate",),
        "force": ("value", "power", "turns_with"),
        "couple": ("value", "power"),
    },
}
NOT_BUILT_KINDS: dict[str, dict[str, str]] = {
    "joints": {},
    "couplings": {"ratio": "linear relations"},
    "contacts": {"table": "spheres on a table"},
    "forces": {},
}
NOT_BUILT_OPTIONS: dict[str, dict[str, str]] = {
    "cord": {"slips": "cords that slip on a rim"},
}
SINGULAR = {"joints": "joint", "couplings": "coupling", "contacts": "contact", "forces": "force"}

EVENT_KEYS = ("when", "do", "nth")
# Actions of an event: kind -> options; `active` goes with every kind.
ACTIONS: dict[str, tuple[str, ...]] = {"add": (), "remove": (), "impulse": ("value", "work"), "nudge": ()}
ASK_KEYS = ("of", "max", "min", "at", "unit", "run")
AT_KEYS = ("max", "min", "each", "values")
FIND_KEYS = ("vary", "where", "greatest", "least", "samples")
GRID_KEYS = ("from", "to", "num", "step", "scale")
SOLVE_KEYS = (
    *("route", "accuracy", "estimate", "max_time", "max_events", "max_steps", "assembly", "simultaneous"),
)
SIMULTANEOUS = ("together", "one by one")
LAWS = ("newton", "poisson", "stronge")
ROUTES = ("auto", "state", "jump", "uniform", "path", "rk", "ida")

CONTACT_CHANGES = ("strikes", "opens", "slips", "sticks")
CORD_CHANGES = ("slackens", "tightens")
CAPTURE_CHANGES = ("strikes", "opens")

BODY_QUANTITIES = (
    *("angle", "turned", "omega", "alpha", "mass", "weight", "inertia", "kinetic_energy"),
    *("momentum", "angular_momentum", "pole"),
)
POINT_QUANTITIES = ("x", "y", "position", "moved", "path", "velocity", "speed", "acceleration")
JOINT_QUANTITIES = ("force", "couple", "impulse", "normal", "friction", "friction_needed")
GEAR_QUANTITIES = ("force", "impulse")
BELT_QUANTITIES = ("tension",)
CORD_QUANTITIES = ("tension", "impulse", "slack", "force")
RATE_QUANTITIES = ("couple",)
COUPLING_QUANTITIES = {
    "gears": GEAR_QUANTITIES,
    "belt": BELT_QUANTITIES,
    "cord": CORD_QUANTITIES,
    "rate": RATE_QUANTITIES,
}
CONTACT_QUANTITIES = (
    *("gap", "closed", "slip", "normal", "friction", "friction_needed", "force", "impulse"),
)
CAPTURE_QUANTITIES = ("gap", "closed", "force", "impulse")  # what holds has no normal and no friction
FORCE_QUANTITIES = ("force", "couple", "work", "power", "stretch", "energy")
EVENT_QUANTITIES = ("count", "time")
ENERGIES = ("kinetic", "potential", "total", "lost")
SPIN_QUANTITIES = ("omega", "angle", "momentum", "inertia")
SCENE_QUANTITIES = ("t", "time", "energy", "weight", "momentum", "angular_momentum", "spin")
PARTS = ("x", "y", "norm", "angle")

# What an element or parameter cannot be called: the words would mean two things.
RESERVED = frozenset({*SCENE_QUANTITIES, *KEYWORDS, "ground", "pi", "start", "end", "rest"})
_NAME = re.compile(r"[^\W\d]\w*")


def check(raw: Mapping[str, Any]) -> None:
    """Raises SceneError for the first key that is unknown or not built yet, and for names that clash."""
    _keys(raw, TOP_KEYS, "", "a scene")
    for name, value in table(raw, "parameters").items():
        if name != "t":  # a parameter may have that name: the time is then called time
            check_name(name, "parameters")
        if isinstance(value, Mapping):
            raise SceneError(_VALUE_TABLE, path=f"parameters.{name}")
    _ground(table(raw, "ground"))
    _keys(table(raw, "spin"), SPIN_KEYS, "spin", "a spin")
    for name, body in table(raw, "bodies").items():
        _body(body, f"bodies.{name}")
    for group in KINDS:
        for name, element in table(raw, group).items():
            _element(element, group, name)
    _unique(raw)
    _instants(raw)
    _keys(table(raw, "solve"), SOLVE_KEYS, "solve", "[solve]")
    for name, values in table(raw, "runs").items():
        parameters = ("g", *table(raw, "parameters"))
        _keys(_mapping(values, f"runs.{name}"), (*parameters, "find"), f"runs.{name}", "a run of this scene")
        if "find" in values:
            _find(values["find"], f"runs.{name}.find")
    if "find" in raw:
        _find(raw["find"], "find")


_VALUE_TABLE = "not built yet: values from a table over time or a measure"


def table(raw: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """The table of that name, empty if it is not written."""
    return _mapping(raw.get(key, {}), key)


def check_name(name: str, path: str) -> None:
    """Raises SceneError if `name` cannot be used in an address."""
    if not _NAME.fullmatch(name):
        raise SceneError("a name is letters, digits and _, and begins with a letter", path=f"{path}.{name}")
    if name in RESERVED:
        raise SceneError(f'"{name}" has a meaning of its own; choose another name', path=f"{path}.{name}")


def not_built(what: str, path: str | None = None, value: object = None) -> SceneError:
    """The error for a word that the language has and this version does not do."""
    return SceneError(f"not built yet: {what}", path=path, value=value)


def unknown(word: str, known: Collection[str], what: str) -> str:
    """The text that there is no such parameter, body, ..., with the nearest one that there is."""
    guess = nearest(word, known)
    there_is = f"there is {', '.join(known)}" if known else "there is none"
    return f'unknown {what} "{word}"; {there_is}' + (f' (did you mean "{guess}"?)' if guess else "")


def kind_of(element: Mapping[str, Any], group: str, path: str) -> str:
    """The one kind key of an element.  Raises SceneError if there is none or more than one."""
    kinds = KINDS[group]
    for kind, what in NOT_BUILT_KINDS[group].items():
        if kind in element:
            raise not_built(what, f"{path}.{kind}")
    given = [kind for kind in kinds if kind in element]
    if len(given) == 1:
        return given[0]
    wanted = f"which kind of {SINGULAR[group]}? one of {', '.join(kinds)} is wanted"
    if len(given) > 1:
        raise SceneError(f"{wanted}, not {' and '.join(given)}", path=path)
    for key in element:
        guess = nearest(key, kinds)
        if guess:
            wanted += f' ("{key}": did you mean "{guess}"?)'
            break
    raise SceneError(wanted, path=path)


def _mapping(value: Any, path: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise SceneError("a table is wanted", path=path, value=value)
    return value


def _keys(
    given: Iterable[str],
    known: tuple[str, ...],
    path: str,
    owner: str,
    unbuilt: Mapping[str, str] | None = None,
) -> None:
    unbuilt = unbuilt or {}
    for key in given:
        full = f"{path}.{key}" if path else key
        if key in known:
            continue
        if key in unbuilt:
            raise not_built(unbuilt[key], full)
        guess = nearest(key, [*known, *unbuilt])
        has = f"{owner} has {', '.join(known)}" if known else f"{owner} has no options"
        raise SceneError(f"unknown key; {has}" + (f' (did you mean "{guess}"?)' if guess else ""), path=full)


def _marks(owner: Mapping[str, Any], path: str) -> None:
    quantities = (*BODY_QUANTITIES, *POINT_QUANTITIES)
    for group in ("points", "lines", "circles", "rows"):
        for name, mark in _mapping(owner.get(group, {}), f"{path}.{group}").items():
            place = f"{path}.{group}.{name}"
            check_name(name, f"{path}.{group}")
            if name in quantities:
                raise SceneError(f'"{name}" is a quantity in addresses; choose another name', path=place)
            if not isinstance(mark, Mapping):
                continue
            match group:
                case "points":
                    _keys(mark, ("from", "by", "polar"), place, "a point")
                case "lines":
                    _keys(mark, ("through", "angle", "from", "to"), place, "a line")
                case "circles":
                    _keys(mark, ("center", "radius"), place, "a circle")
                case "rows":
                    _keys(mark, ROW_KEYS, place, "a row")


def _ground(ground: Mapping[str, Any]) -> None:
    _keys(ground, GROUND_KEYS, "ground", "the ground")
    _marks(ground, "ground")


def _body(body: Any, path: str) -> None:
    _keys(_mapping(body, path), BODY_KEYS, path, "a body")
    if "driven" in body:
        _keys(_mapping(body["driven"], f"{path}.driven"), DRIVEN_KEYS, f"{path}.driven", "a driven body")
    given = [shape for shape in SHAPES if shape in body]
    if len(given) > 1:
        raise SceneError(f"one shape is possible, not {' and '.join(given)}", path=path)
    for option, shape in (("length", "rod"), ("corners", "plate")):
        if option in body and shape not in body:
            raise SceneError(f"only a {shape} has {option}", path=f"{path}.{option}")
    _marks(body, path)


def _element(element: Any, group: str, name: str) -> None:
    path = f"{group}.{name}"
    kind = kind_of(_mapping(element, path), group, path)
    options = (*KINDS[group][kind], "active")
    article = "an" if kind[0] in "aeiou" else "a"
    _keys(
        [key for key in element if key != kind],
        options,
        path,
        f"{article} {kind}",
        NOT_BUILT_OPTIONS.get(kind),
    )
    if isinstance(element.get("value"), Mapping) and "polar" not in element["value"]:
        raise SceneError(_VALUE_TABLE, path=f"{path}.value")


def _unique(raw: Mapping[str, Any]) -> None:
    """Elements need no prefix in addresses, so their names must differ."""
    owner: dict[str, str] = {}
    for group in ("bodies", "joints", "couplings", "contacts", "forces", "events"):
        for name in table(raw, group):
            check_name(name, group)
            if name in owner:
                raise SceneError(f"the name is taken by {owner[name]}.{name}", path=f"{group}.{name}")
            owner[name] = group


def _instants(raw: Mapping[str, Any]) -> None:
    for name, event in table(raw, "events").items():
        if isinstance(event, Mapping):
            _keys(event, EVENT_KEYS, f"events.{name}", "an event")
            _actions(event.get("do", ()), f"events.{name}.do")
    for name, ask in table(raw, "ask").items():
        if not isinstance(ask, Mapping):
            continue
        _keys(ask, ASK_KEYS, f"ask.{name}", "an ask")
        at = ask.get("at")
        if isinstance(at, Mapping):
            _keys(at, AT_KEYS, f"ask.{name}.at", "an instant")
            _grid(at.get("values"), f"ask.{name}.at.values")
    for name, grid in table(raw, "sweep").items():
        if name != "zip":
            _grid(grid, f"sweep.{name}")


def _actions(actions: Any, path: str) -> None:
    if not isinstance(actions, list | tuple):
        raise SceneError(
            'a list of actions is wanted, such as [{ remove = "cord" }]', path=path, value=actions
        )
    for index, action in enumerate(actions):
        where = f"{path}[{index}]"
        given = [kind for kind in ACTIONS if kind in _mapping(action, where)]
        if len(given) != 1:
            wanted = f"one of {', '.join(ACTIONS)} is wanted"
            raise SceneError(wanted + (f", not {' and '.join(given)}" if given else ""), path=where)
        _keys(action, (given[0], *ACTIONS[given[0]], "active"), where, f"an action {given[0]}")


def _find(find: Any, path: str) -> None:
    _keys(_mapping(find, path), FIND_KEYS, path, "a find")
    if "vary" not in find:
        reason = 'what is sought is wanted, such as vary = { h = ["0 m", "2 m"] }'
        raise SceneError(reason, path=f"{path}.vary")
    _mapping(find["vary"], f"{path}.vary")


def _grid(grid: Any, path: str) -> None:
    if isinstance(grid, Mapping):
        _keys(grid, GRID_KEYS, path, "a grid")
