"""What stands behind a key, brought into one form: the readers that the models of tables.py begin with.

A reader takes what TOML gives and returns what the model stores; it raises ValueError, whose text says what
is wanted.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

Value: TypeAlias = str | int | float | bool
# What a distribution is given by.
# What a sweep has beside its grids.
SWEEP_KEYS = ("zip", "design", "refine", "cases", "retry")
DISTRIBUTIONS: Mapping[str, tuple[str, ...]] = {
    "uniform": ("least", "greatest"),
    "normal": ("mean", "standard deviation"),
    "lognormal": ("median", "standard deviation of the logarithm"),
    "triangular": ("least", "most frequent", "greatest"),
}


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


def read_value(written: Any) -> Value:
    """A number, true or false, or the text of a quantity or an expression."""
    # An integer beyond the range of doubles is no number either.
    if isinstance(written, int | float) and not abs(written) <= sys.float_info.max:
        raise ValueError("the number must be finite")
    if not isinstance(written, str | int | float | bool):
        raise ValueError('a number, a quantity such as "10 in" or an expression is wanted')
    return written


def read_text(written: Any) -> str:
    """A text."""
    if not isinstance(written, str):
        raise ValueError("a text is wanted")
    return written


def read_vector(written: Any) -> Vector:
    """[x, y] or { polar = [size, angle] }."""
    if isinstance(written, Mapping) and set(written) == {"polar"}:
        return _pair(written["polar"], True)
    return _pair(written, False)


def _pair(written: Any, polar: bool) -> Vector:
    if not isinstance(written, list | tuple) or len(written) != 2:
        raise ValueError("a vector is wanted: [x, y] or { polar = [size, angle] }")
    return Vector(read_value(written[0]), read_value(written[1]), polar)


def read_names(count: int, what: str, example: str = "") -> Callable[[Any], tuple[str, ...]]:
    """A reader of `count` names; `what` they are, and how they are written, for the message."""

    def read(written: Any) -> tuple[str, ...]:
        is_list = isinstance(written, list | tuple)
        if not is_list or len(written) != count or not all(isinstance(name, str) for name in written):
            raise ValueError(f"{what} are wanted" + (f", such as {example}" if example else ""))
        return tuple(written)

    return read


def read_point(written: Any) -> Vector | Offset:
    """The place of a point on its body."""
    if isinstance(written, Mapping) and "polar" not in written:
        if set(written) != {"from", "by"} or not isinstance(written["from"], str):
            raise ValueError("a point is [x, y] or { from = point, by = [x, y] }")
        return Offset(written["from"], read_vector(written["by"]))
    return read_vector(written)


def read_place(written: Any) -> Place:
    """What `at` may be: a place for the centre, or for one or two named points."""
    if isinstance(written, str):
        return Place((("center", written),))
    if not isinstance(written, Mapping) or "polar" in written:
        return Place((("center", read_vector(written)),))
    if not 1 <= len(written) <= 2:
        raise ValueError("one or two points of the body are wanted")
    places = {name: at if isinstance(at, str) else read_vector(at) for name, at in written.items()}
    return Place(tuple(places.items()))


@dataclass(frozen=True)
class DrivenPlace:
    """Where one named point of a body is held, over t."""

    points: tuple[tuple[str, Vector]]


def read_driven_place(written: Any) -> DrivenPlace:
    """What `at` of `driven` may be: a place of the centre, or of one named point."""
    place = read_place(written)
    if len(place.points) != 1:
        raise ValueError("one point is wanted; angle gives the rest")
    point, at = place.points[0]
    if isinstance(at, str):
        raise ValueError('a place over t is wanted, such as ["(1 m/s)*t", 0]')
    return DrivenPlace(((point, at),))


def read_sequence(written: Any) -> tuple[str, ...]:
    """A condition, or a list of conditions."""
    texts = [written] if isinstance(written, str) else written
    if not isinstance(texts, list | tuple) or not texts or not all(isinstance(text, str) for text in texts):
        raise ValueError("a condition or a list of conditions is wanted")
    return tuple(texts)


def read_named(written: Any) -> tuple[str, ...]:
    """A name, or a list of names."""
    names = [written] if isinstance(written, str) else written
    if not isinstance(names, list | tuple) or not names or not all(isinstance(name, str) for name in names):
        raise ValueError('names are wanted, such as ["strike", "tip"]')
    return tuple(names)


def read_correlation(written: Any) -> tuple[tuple[str, str, float], ...]:
    """Pairs of parameters with their correlation."""
    if not isinstance(written, list | tuple) or not all(map(_is_correlation, written)):
        raise ValueError('pairs with their correlation are wanted, such as [["m", "r", 0.8]]')
    return tuple((first, second, float(size)) for first, second, size in written)


def _is_correlation(one: Any) -> bool:
    if not isinstance(one, list | tuple) or len(one) != 3:
        return False
    *names, size = one
    is_number = isinstance(size, int | float) and not isinstance(size, bool)
    return all(isinstance(name, str) for name in names) and is_number


def read_stops(written: Any) -> tuple[str, ...]:
    """Points and rims that a cord goes to, in order."""
    if not isinstance(written, list | tuple) or not all(isinstance(text, str) for text in written):
        raise ValueError('points and rims in order are wanted, such as ["drum.rim cw", "block"]')
    if len(written) < 2:
        raise ValueError("at least two points or rims are wanted")
    return tuple(written)


def read_until(written: Any) -> tuple[tuple[str, ...], ...]:
    """Groups of instants: the run ends when all of one group have come."""
    if isinstance(written, Mapping):
        if set(written) != {"all"}:
            raise ValueError("an instant, a list (the first that comes) or { all = [...] } is wanted")
        return (read_sequence(written["all"]),)
    return tuple((one,) for one in read_sequence(written))


def read_bounds(written: Any) -> tuple[Value, Value]:
    """The bounds of a sought parameter."""
    if not isinstance(written, list | tuple) or len(written) != 2:
        raise ValueError("two bounds are wanted: [lowest, greatest]")
    return read_value(written[0]), read_value(written[1])


def read_circle(written: Any) -> Any:
    """A bare radius, or a table."""
    return written if isinstance(written, Mapping) else {"radius": written}


def read_templates(written: Any) -> Any:
    """Scenes by name, of which parts are made: they are read where they are used."""
    if not isinstance(written, Mapping):
        raise ValueError("a table of scenes is wanted")
    return written


def read_grid(written: Any) -> Any:
    """A list, or a table with from, to and num or step."""
    if isinstance(written, list | tuple):
        return {"values": tuple(read_value(one) for one in written)}
    if not isinstance(written, Mapping):
        raise ValueError("a grid is wanted: a list, or { from, to, num } or { from, to, step }")
    if "from" not in written or "to" not in written or ("num" in written) == ("step" in written):
        raise ValueError("a grid has from, to and either num or step")
    return written


def read_column(written: Any) -> str | tuple[Value, ...]:
    """The name of a column of a file, or its values."""
    if isinstance(written, str):
        return written
    if not isinstance(written, list | tuple):
        raise ValueError('a list of values is wanted, such as ["0 s", "1 s"], or the name of a column')
    return tuple(read_value(one) for one in written)


def read_numbers(written: Any) -> tuple[Value, ...]:
    """A list of values."""
    if not isinstance(written, list | tuple):
        raise ValueError("a list of values is wanted")
    return tuple(read_value(one) for one in written)


def read_swept(written: Any) -> Any:
    """A grid, or a table with a distribution."""
    if isinstance(written, Mapping) and "listed" in written:
        values = written.get("values")
        return written if values is None else {**written, "values": tuple(map(read_value, values))}
    given = [word for word in DISTRIBUTIONS if isinstance(written, Mapping) and word in written]
    if not given:
        return read_grid(written)
    if len(given) > 1 or not {*written} <= {*given, "within"}:
        raise ValueError(
            "one distribution is wanted, such as { normal = [mean, deviation] }, and at most within"
        )
    return written


def read_sweep(written: Any) -> Any:
    """Grids by parameter, and apart from them what else a sweep has."""
    groups = written.get("zip", [])
    lists = isinstance(groups, list | tuple) and all(isinstance(group, list | tuple) for group in groups)
    if not lists or not all(isinstance(name, str) for group in groups for name in group):
        raise ValueError('zip is a list of lists of parameters, such as [["m", "r"]]')
    return {
        "grids": {name: grid for name, grid in written.items() if name not in SWEEP_KEYS},
        "zip": tuple(tuple(group) for group in groups),
        "design": written.get("design"),
        "refine": written.get("refine"),
        "cases": written.get("cases"),
        "retry": written.get("retry"),
    }


def read_friction(written: Any) -> Any:
    """A number, "smooth", "rough", or a table of both coefficients."""
    if isinstance(written, Mapping):
        if set(written) != {"static", "kinetic"}:
            raise ValueError('friction is a number, "smooth", "rough" or { static = ..., kinetic = ... }')
        return written
    return read_value(written)


def read_cord_friction(written: Any) -> Any:
    """The friction of a rim, or a list of those of all rims between the ends."""
    return tuple(map(read_friction, written)) if isinstance(written, list | tuple) else read_friction(written)


def read_joint_friction(written: Any) -> Any:
    """A number, or the coefficient and the radius of a bearing."""
    if isinstance(written, Mapping):
        if set(written) != {"mu", "radius"}:
            raise ValueError("friction is a number, or { mu = ..., radius = ... } of a bearing")
        return written
    return read_value(written)


def read_tooth_friction(written: Any) -> Any:
    """The coefficient of teeth, and how far from where the pitch circles touch they slide on an average."""
    if not isinstance(written, Mapping) or set(written) != {"mu", "radius"}:
        raise ValueError("friction of teeth is { mu = ..., radius = ... }; or give their efficiency")
    return written


def read_value_or_vector(written: Any) -> Value | Vector:
    """A number, or a vector."""
    return read_vector(written) if isinstance(written, list | tuple | Mapping) else read_value(written)


def read_point_or_two(written: Any) -> tuple[str, ...]:
    """A point, or the two points that a force draws together."""
    if isinstance(written, str):
        return (written,)
    return read_names(2, "a point, or two points that are drawn together,")(written)


def read_body_or_two(written: Any) -> tuple[str, ...]:
    """A body, or a body and the one that takes the reaction."""
    if isinstance(written, str):
        return (written,)
    return read_names(2, "a body, or a body and its reaction body,")(written)


def read_at(written: Any) -> Any:
    """The name of an instant, or a table."""
    return written if isinstance(written, Mapping) else read_text(written)


def read_ask(written: Any) -> Any:
    """A bare expression, or a table."""
    return written if isinstance(written, Mapping) else {"of": written}


def read_event(written: Any) -> Any:
    """A condition, a list of conditions, or a table with when."""
    if not isinstance(written, Mapping):
        return {"when": written}
    if "when" not in written:
        raise ValueError("an event needs a condition: when = ...")
    return written


def read_actions(written: Any) -> Any:
    """The actions of an event."""
    return tuple(written) if isinstance(written, list | tuple) else written


def read_start(written: Any) -> dict[str, Value | Vector]:
    """Tables nested by dotted keys become addresses again."""
    flat: dict[str, Value | Vector] = {}

    def walk(table: Mapping[str, Any], prefix: str) -> None:
        for key, value in table.items():
            address = f"{prefix}.{key}" if prefix else key
            if isinstance(value, Mapping) and "polar" not in value:
                walk(value, address)
            else:
                flat[address] = read_value_or_vector(value)

    walk(written, "")
    return flat
