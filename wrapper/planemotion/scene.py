"""The validated scene: frozen pydantic models of what a file or the builder says.

Numbers stay as written ("10 in", "r + (3 in)", 0.5); units and expressions are read when the scene is made
into tables.  `validate` is the one entrance: it checks the words first (words.py), then types, and turns
every fault into a SceneError with its key path.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from . import words
from .errors import SceneError, nearest

Value: TypeAlias = str | int | float | bool
DEFAULT_G = "9.81 m/s^2"
# Columns that "each EVENT" gets where nothing bounds how often the event fires.
DEFAULT_MAX_EVENTS = 1_000_000
DEFAULT_MAX_STEPS = 1_000_000


@dataclass(frozen=True)
class Vector:
    """Two components, or with `polar` a size and a direction, as written."""

    first: Value
    second: Value
    polar: bool = False


@dataclass(frozen=True)
class Offset:
    """A point `by` from another point of the same body."""

    start: str
    by: Vector


@dataclass(frozen=True)
class Place:
    """Where named points of a body are drawn: a vector or the name of a point of something else."""

    points: tuple[tuple[str, Vector | str], ...]


def _value(written: Any) -> Value:
    if isinstance(written, float) and not math.isfinite(written):
        raise ValueError("the number must be finite")
    if not isinstance(written, str | int | float | bool):
        raise ValueError('a number, a quantity such as "10 in" or an expression is wanted')
    return written


def _text(written: Any) -> str:
    if not isinstance(written, str):
        raise ValueError("a text is wanted")
    return written


def _vector(written: Any) -> Vector:
    if isinstance(written, Mapping) and set(written) == {"polar"}:
        return _pair(written["polar"], True)
    return _pair(written, False)


def _pair(written: Any, polar: bool) -> Vector:
    if not isinstance(written, list | tuple) or len(written) != 2:
        raise ValueError("a vector is wanted: [x, y] or { polar = [size, angle] }")
    return Vector(_value(written[0]), _value(written[1]), polar)


def _names(count: int, what: str) -> Callable[[Any], tuple[str, ...]]:
    def read(written: Any) -> tuple[str, ...]:
        is_list = isinstance(written, list | tuple)
        if not is_list or len(written) != count or not all(isinstance(name, str) for name in written):
            raise ValueError(f"{what} are wanted")
        return tuple(written)

    return read


def _point(written: Any) -> Vector | Offset:
    if isinstance(written, Mapping) and "polar" not in written:
        if set(written) != {"from", "by"} or not isinstance(written["from"], str):
            raise ValueError("a point is [x, y] or { from = point, by = [x, y] }")
        return Offset(written["from"], _vector(written["by"]))
    return _vector(written)


def _place(written: Any) -> Place:
    if isinstance(written, str):
        return Place((("center", written),))
    if not isinstance(written, Mapping) or "polar" in written:
        return Place((("center", _vector(written)),))
    if not 1 <= len(written) <= 2:
        raise ValueError("one or two points of the body are wanted")
    return Place(tuple((name, at if isinstance(at, str) else _vector(at)) for name, at in written.items()))


def _sequence(written: Any) -> tuple[str, ...]:
    texts = [written] if isinstance(written, str) else written
    if not isinstance(texts, list | tuple) or not texts or not all(isinstance(text, str) for text in texts):
        raise ValueError("a condition or a list of conditions is wanted")
    return tuple(texts)


def _until(written: Any) -> tuple[tuple[str, ...], ...]:
    if isinstance(written, Mapping):
        if set(written) != {"all"}:
            raise ValueError("an instant, a list (the first that comes) or { all = [...] } is wanted")
        return (_sequence(written["all"]),)
    return tuple((one,) for one in _sequence(written))


def _circle(written: Any) -> Any:
    return written if isinstance(written, Mapping) else {"radius": written}


def _grid(written: Any) -> Any:
    if isinstance(written, list | tuple):
        return {"values": tuple(_value(one) for one in written)}
    if not isinstance(written, Mapping):
        raise ValueError('a grid is wanted: a list, or { from, to, num } or { from, to, step }')
    if "from" not in written or "to" not in written or ("num" in written) == ("step" in written):
        raise ValueError("a grid has from, to and either num or step")
    return written


Number = Annotated[Value, BeforeValidator(_value)]
Text = Annotated[str, BeforeValidator(_text)]
Pair = Annotated[Vector, BeforeValidator(_vector)]
Partners = Annotated[tuple[str, ...], BeforeValidator(_names(2, "two partners"))]


class Table(BaseModel):
    """Base of all models: no other keys, no changes."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, strict=True)


class Line(Table):
    """A straight line: through a point at an angle, or from one point to another."""

    through: Pair | None = None
    angle: Number | None = None
    start: Pair | None = Field(None, alias="from")
    to: Pair | None = None


class Circle(Table):
    center: Pair = Vector(0, 0)
    radius: Number


class Row(Table):
    """Points one `step` apart; endless without `count`."""

    start: Pair = Field(alias="from")
    step: Pair
    count: Number | None = None


Points = dict[str, Annotated[Vector | Offset, BeforeValidator(_point)]]
Circles = dict[str, Annotated[Circle, BeforeValidator(_circle)]]


class Ground(Table):
    points: Points = {}
    lines: dict[str, Line] = {}
    circles: Circles = {}
    rows: dict[str, Row] = {}


class Body(Table):
    rod: Annotated[tuple[str, ...], BeforeValidator(_names(2, "the names of two ends"))] | None = None
    length: Number | None = None
    disk: Number | None = None
    cylinder: Number | None = None
    hoop: Number | None = None
    sphere: Number | None = None
    half_ring: Number | None = None
    plate: Pair | None = None
    corners: Annotated[tuple[str, ...], BeforeValidator(_names(4, "four names"))] | None = None
    mass: Number | None = None
    weight: Number | None = None
    inertia: Number | None = None
    gyration: Number | None = None
    mass_center: Pair = Vector(0, 0)
    points: Points = {}
    lines: dict[str, Line] = {}
    circles: Circles = {}
    at: Annotated[Place, BeforeValidator(_place)] | None = None
    angle: Number | None = None
    active: Number = True

    @property
    def shape(self) -> str | None:
        """The key of its shape, None for a body of given inertia and for a particle."""
        return next((shape for shape in words.SHAPES if getattr(self, shape) is not None), None)

    @property
    def turns(self) -> bool:
        """Whether it is more than a particle."""
        return self.shape is not None or self.inertia is not None or self.gyration is not None


class Element(Table):
    """What joints, contacts and forces share: one kind key with its partners."""

    active: Number = True


class Joint(Element):
    pin: Partners | None = None
    slider: Partners | None = None
    slot: Partners | None = None
    link: Partners | None = None
    weld: Partners | None = None
    rolling: Partners | None = None
    length: Number | None = None
    turning: bool = True

    @property
    def kind(self) -> str:
        return next(kind for kind in words.KINDS["joints"] if getattr(self, kind) is not None)

    @property
    def partners(self) -> tuple[str, ...]:
        partners: tuple[str, ...] = getattr(self, self.kind)
        return partners


class Friction(Table):
    static: Number
    kinetic: Number


class Contact(Element):
    touch: Partners
    restitution: Number = 0
    friction: Number | Friction = 0
    normal: Number | None = None
    law: Text = "newton"
    capture: Text = "none"


class Force(Element):
    spring: Partners | None = None
    torsion: Partners | None = None
    damper: Partners | None = None
    force: Text | None = None
    couple: Text | Partners | None = None
    stiffness: Number | None = None
    free_length: Number | None = None
    free_angle: Number | None = None
    only: Literal["push", "pull"] | None = None
    rate: Number | None = None
    value: Number | Pair | None = None
    turns_with: Text | None = None

    @property
    def kind(self) -> str:
        return next(kind for kind in words.KINDS["forces"] if getattr(self, kind) is not None)


class Grid(Table):
    """A list of values, or from .. to in `num` values or steps of `step`, ends included; shape only."""

    values: tuple[Value, ...] | None = None
    from_: Number | None = Field(None, alias="from")
    to: Number | None = None
    num: Annotated[int, Field(strict=True)] | None = None
    step: Number | None = None
    scale: Literal["linear", "log"] = "linear"


GridOf = Annotated[Grid, BeforeValidator(_grid)]


class At(Table):
    """An instant that is not an event: where an expression is extreme, or takes given values."""

    max: Number | None = None
    min: Number | None = None
    each: Number | None = None
    values: GridOf | None = None


class Ask(Table):
    """`of` an expression `at` an instant, or the extreme `max` or `min` of one over the run."""

    of: Number | None = None
    max: Number | None = None
    min: Number | None = None
    at: Text | At | None = None
    unit: Text | None = None
    run: Text | None = None


class Solve(Table):
    route: Text = "auto"
    accuracy: Number = 1e-10
    max_time: Number = "1000 s"
    max_events: int = DEFAULT_MAX_EVENTS
    max_steps: int = DEFAULT_MAX_STEPS
    assembly: Number = 1e-12


class Sweep(Table):
    """What a study varies: grids by parameter, in their order, and parameters that move together."""

    grids: dict[str, GridOf] = {}
    zip: tuple[tuple[str, ...], ...] = ()


def _sweep(written: Any) -> Any:
    groups = written.get("zip", [])
    lists = isinstance(groups, list | tuple) and all(isinstance(group, list | tuple) for group in groups)
    if not lists or not all(isinstance(name, str) for group in groups for name in group):
        raise ValueError('zip is a list of lists of parameters, such as [["m", "r"]]')
    return {
        "grids": {name: grid for name, grid in written.items() if name != "zip"},
        "zip": tuple(tuple(group) for group in groups),
    }


def _ask(written: Any) -> Any:
    return written if isinstance(written, Mapping) else {"of": written}


def _event(written: Any) -> tuple[str, ...]:
    if isinstance(written, Mapping):
        if "when" not in written:
            raise ValueError("an event needs a condition: when = ...")
        return _sequence(written["when"])
    return _sequence(written)


def _start(written: Any) -> dict[str, Value | Vector]:
    """Tables nested by dotted keys become addresses again."""
    flat: dict[str, Value | Vector] = {}

    def walk(table: Mapping[str, Any], prefix: str) -> None:
        for key, value in table.items():
            address = f"{prefix}.{key}" if prefix else key
            if isinstance(value, Mapping) and "polar" not in value:
                walk(value, address)
            else:
                flat[address] = _vector(value) if isinstance(value, list | tuple | Mapping) else _value(value)

    walk(written, "")
    return flat


class SceneData(Table):
    """A scene whose words and types are right.  `file` is where it came from, for messages."""

    file: str | None = None
    id: Text = ""
    title: Text = ""
    description: Text = ""
    plane: Literal["vertical", "horizontal"] = "vertical"
    until: Annotated[tuple[tuple[str, ...], ...], BeforeValidator(_until)]
    parameters: dict[str, Number] = {}
    ground: Ground = Ground()
    bodies: dict[str, Body] = {}
    joints: dict[str, Joint] = {}
    contacts: dict[str, Contact] = {}
    forces: dict[str, Force] = {}
    start: Annotated[dict[str, Value | Vector], BeforeValidator(_start)] = {}
    events: dict[str, Annotated[tuple[str, ...], BeforeValidator(_event)]] = {}
    ask: dict[str, Annotated[Ask, BeforeValidator(_ask)]] = {}
    runs: dict[str, dict[str, Number]] = {}
    sweep: Annotated[Sweep, BeforeValidator(_sweep)] = Sweep()
    solve: Solve = Solve()


def validate(raw: Mapping[str, Any], *, file: str | None = None, name: str = "") -> SceneData:
    """The validated scene of a table as TOML gives it.

    `file` is named in messages; `name` is the id where the table has none.  Raises SceneError for the first
    fault found.
    """
    try:
        words.check(raw)
        if "until" not in raw:
            raise SceneError('what ends the run is wanted, such as until = "t = 2 s"', path="until")
        if not words.table(raw, "bodies"):
            raise SceneError("a scene needs at least one body", path="bodies")
        parameters = {**({} if "g" in words.table(raw, "parameters") else {"g": DEFAULT_G}), **raw.get("parameters", {})}
        data = _construct({**raw, "id": raw.get("id", name), "parameters": parameters, "file": file})
        _check_more(data)
    except SceneError as error:
        raise error.at(file=file) from None
    return data


def _construct(content: Mapping[str, Any]) -> SceneData:
    try:
        return SceneData.model_validate(content)
    except ValidationError as fault:
        raise _translate(fault) from None


def _translate(fault: ValidationError) -> SceneError:
    """Pydantic's first complaint in the manner of this package."""
    first = fault.errors()[0]
    # Parts of a location that are names of types or models are no keys.
    keys = [part for part in first["loc"] if not (isinstance(part, str) and _is_type(part))]
    path = ""
    for part in keys:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    path = path.replace("sweep.grids.", "sweep.")
    written = first.get("input")
    shown = written if isinstance(written, str | int | float | bool) else None
    if first["type"] == "missing":
        return SceneError("is wanted and left out", path=path)
    if first["type"] == "value_error":
        return SceneError(str(first["ctx"]["error"]), path=path, value=shown)
    return SceneError(first["msg"][0].lower() + first["msg"][1:].replace("Input should", "it should"), path=path, value=shown)


def _is_type(part: str) -> bool:
    return part[:1].isupper() and part in _MODELS or "-" in part or "[" in part or part in ("str", "int", "float", "bool")


_MODELS = {model.__name__ for model in Table.__subclasses__()}


def _check_more(data: SceneData) -> None:
    """Faults between keys that no type says."""
    solve = data.solve
    if solve.route in words.NOT_BUILT_ROUTES:
        raise words.not_built(f"the route {solve.route}", "solve.route", solve.route)
    if solve.route not in words.ROUTES:
        _unknown(solve.route, words.ROUTES, "route", "solve.route")
    for key in ("max_events", "max_steps"):
        if getattr(solve, key) < 1:
            raise SceneError("at least 1 is wanted", path=f"solve.{key}", value=getattr(solve, key))
    for name, contact in data.contacts.items():
        if contact.law != "newton":
            raise words.not_built("other impact laws than newton", f"contacts.{name}.law", contact.law)
        if contact.capture != "none":
            raise words.not_built("contacts that capture", f"contacts.{name}.capture", contact.capture)
    for name, ask in data.ask.items():
        _check_ask(data, ask, f"ask.{name}")
    zipped = [name for group in data.sweep.zip for name in group]
    for name in (*data.sweep.grids, *zipped):
        if name not in data.parameters:
            _unknown(name, tuple(data.parameters), "parameter", f"sweep.{name}")
    for name in zipped:
        if name not in data.sweep.grids:
            raise SceneError("zipped, but it has no grid", path=f"sweep.{name}")
        if zipped.count(name) > 1:
            raise SceneError(f'"{name}" is zipped twice', path="sweep.zip")


def _check_ask(data: SceneData, ask: Ask, path: str) -> None:
    given = [key for key in ("of", "max", "min") if getattr(ask, key) is not None]
    if len(given) != 1:
        raise SceneError("one of of, max, min is wanted" + (f", not {' and '.join(given)}" if given else ""), path=path)
    if given[0] != "of" and ask.at is not None:
        raise SceneError(f"an extreme over the run has no instant; write of = ..., at = {{ {given[0]} = ... }}", path=f"{path}.at")
    if isinstance(ask.at, At):
        kinds = [key for key in ("max", "min", "each") if getattr(ask.at, key) is not None]
        if len(kinds) != 1 or (kinds == ["each"]) != (ask.at.values is not None):
            raise SceneError("an instant is { max = ... }, { min = ... } or { each = ..., values = grid }", path=f"{path}.at")
    if ask.run is not None and ask.run not in data.runs:
        _unknown(ask.run, tuple(data.runs), "run", f"{path}.run")


def _unknown(word: str, known: tuple[str, ...], what: str, path: str) -> None:
    guess = nearest(word, known)
    there_is = f"there is {', '.join(known)}" if known else "there is none"
    raise SceneError(f'unknown {what} "{word}"; {there_is}' + (f' (did you mean "{guess}"?)' if guess else ""), path=path)
