"""What the result of a sweep holds: names, dimensions, types and attributes of its variables.

There is one dimension per swept parameter (those of a zip share the first one's), on which stand

    the swept parameters     coordinates, in the unit of the grid: `units` has it as CF and UDUNITS do, and
                             `unit`, where that is another word, as scenes do (degree, deg)
    each ask                 float, in its unit, NaN without an answer; a list has one more dimension,
                             KEY_at (the values of its grid) or KEY_number.  An answer which events happened
                             is a whole number; its attribute `letters` names them, and `words` spells it
    KEY_error                its estimated absolute error, likewise (not with solve.estimate = false)
    margin                   least distance of a decision on the way from its threshold, over its error: below
                             1 counts and outcomes are not certain; infinite if there was none (likewise)
    error_over_accuracy      greatest estimated error over what solve.accuracy allows (likewise)
    status                   int, enum pm_status: 0 ok, > 0 an early stop, < 0 a failure
    reason                   int per ask, enum pm_reason: why it is NaN
    message                  text of what was wrong, "" where all is well
    route, audit_energy, ... how each case was computed, and the evidence for it
    solves                   systems of equations solved for it, as far as they are counted: its cost

In a scene with [runs], route, audit and run_status have one more dimension, run.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from .._layout import PM_OK, PM_TRUST_EXCESS, PM_TRUST_MARGIN, pm_audit, pm_reason, pm_route, pm_status
from ..base.arrays import Floats
from ..base.errors import StudyError
from ..compile.asks import Asked
from ..language.cf import cf_units
from .block import Block


def _words(enumeration: Mapping[str, int], prefix: str, count: str = "") -> dict[int, str]:
    """Values of an enumeration of the kernel as words; its entry `count` is no value."""
    return {value: name.removeprefix(prefix).lower() for name, value in enumeration.items() if name != count}


STATUS_WORDS = _words(pm_status, "PM_")
REASON_WORDS = _words(pm_reason, "PM_REASON_")
ROUTE_WORDS = _words(pm_route, "PM_ROUTE_", "PM_ROUTES")
AUDIT_WORDS = _words(pm_audit, "PM_AUDIT_", "PM_AUDITS")
TRUST_WORDS = {PM_TRUST_MARGIN: "margin", PM_TRUST_EXCESS: "error_over_accuracy"}
_TRUST_TEXTS = {
    PM_TRUST_MARGIN: "least distance of a decision from its threshold over its error",
    PM_TRUST_EXCESS: "greatest estimated error over what solve.accuracy allows",
}
MESSAGE = "message"

# Names in the result besides those of parameters and asks.
RESERVED_NAMES = frozenset(
    {
        "case",
        "status",
        "reason",
        "message",
        "route",
        "run",
        "run_status",
        "solves",
        "ask",
        *TRUST_WORDS.values(),
    }
    | {f"audit_{word}" for word in AUDIT_WORDS.values()}
)


def error_name(key: str) -> str:
    """The variable of the errors of the ask `key`."""
    return f"{key}_error"


@dataclass(frozen=True)
class Coordinate:
    """The values of one swept parameter, in `unit`, along the dimension `dim`; of an option its words."""

    name: str
    dim: str
    unit: str
    values: Floats
    words: tuple[str, ...] = ()


def list_dims(ask: Asked) -> tuple[str, ...]:
    """The dimension of a list: its grid's values, or else the numbers 1, 2, ...; none of a single number."""
    if not ask.is_list:
        return ()
    return (f"{ask.key}_at" if ask.at else f"{ask.key}_number",)


def names_of(ask: Asked) -> tuple[str, ...]:
    """The names that an ask takes in a result."""
    return ask.key, error_name(ask.key), *list_dims(ask)


@dataclass(frozen=True)
class Variable:
    """A variable of the result; `dtype` None: texts.  `data`: what stands in it before any case does."""

    name: str
    dims: tuple[str, ...]
    dtype: type[np.generic] | None
    attributes: Mapping[str, Any]
    data: npt.NDArray[Any] | None = None


@dataclass(frozen=True)
class Layout:
    """Names and sizes of everything in a result; `runs` are the named runs, empty if the scene has none;
    `estimate`: whether there are errors."""

    dims: tuple[tuple[str, int], ...]
    coordinates: tuple[Coordinate, ...]
    asks: tuple[Asked, ...]
    runs: tuple[str, ...] = ()
    estimate: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(size for _, size in self.dims)

    @property
    def cases(self) -> int:
        return math.prod(self.shape)

    @property
    def dimensions(self) -> dict[str, int]:
        """Name and size of every dimension of the result."""
        lists = {dim: ask.count for ask in self.asks for dim in list_dims(ask)}
        return {
            **dict(self.dims),
            "ask": len(self.asks),
            **lists,
            **({"run": len(self.runs)} if self.runs else {}),
        }

    def variables(self) -> Iterator[Variable]:
        """All variables of the result, in order: what is known before any case, then what cases fill."""
        yield from self._known()
        # CF: coordinates that are not dimensions (the other columns of a zip) are named by the variables.
        zipped = " ".join(item.name for item in self.coordinates if item.name != item.dim)
        for one in self._filled():
            yield replace(one, attributes={**one.attributes, "coordinates": zipped}) if zipped else one

    def _known(self) -> Iterator[Variable]:
        """The coordinates."""
        for item in self.coordinates:
            if item.words:
                texts = np.array(item.words, dtype=object)
                yield Variable(item.name, (item.dim,), None, {"long_name": f"option {item.name}"}, texts)
                continue
            attributes = {**cf_units(item.unit), "long_name": f"parameter {item.name}"}
            yield Variable(item.name, (item.dim,), np.float64, attributes, item.values)
        yield _texts("ask", [ask.key for ask in self.asks])
        for ask in self.asks:
            unit, values = ask.at or ("", np.arange(1.0, ask.count + 1))
            for dim in list_dims(ask):
                yield Variable(dim, (dim,), np.float64, cf_units(unit), values)
        if self.runs:
            yield _texts("run", self.runs)

    def _filled(self) -> Iterator[Variable]:
        """What `case_values` gives for each case, and the messages."""
        grid = tuple(name for name, _ in self.dims)
        of_run = (*grid, "run") if self.runs else grid
        for ask in self.asks:
            attributes = {**cf_units(ask.unit), "long_name": ask.text}
            if ask.letters:
                attributes["letters"] = " ".join(ask.letters)
            if self.estimate:
                attributes["ancillary_variables"] = error_name(ask.key)
            yield Variable(ask.key, (*grid, *list_dims(ask)), np.float64, attributes)
        for ask in self.asks if self.estimate else ():
            attributes = {**cf_units(ask.unit), "long_name": f"estimated absolute error of {ask.key}"}
            yield Variable(error_name(ask.key), (*grid, *list_dims(ask)), np.float32, attributes)
        for column, word in TRUST_WORDS.items() if self.estimate else ():
            yield Variable(word, grid, np.float32, {"units": "1", "long_name": _TRUST_TEXTS[column]})
        yield _flagged("status", grid, np.int32, "how the case ended", STATUS_WORDS)
        yield _flagged("reason", (*grid, "ask"), np.int8, "why there is no number", REASON_WORDS)
        yield _flagged("route", of_run, np.int8, "route that was taken", ROUTE_WORDS)
        yield Variable("solves", grid, np.int32, {"units": "1", "long_name": "systems of equations solved"})
        for word in AUDIT_WORDS.values():
            attributes = {"units": "1", "long_name": f"relative residual of the {word}"}
            yield Variable(f"audit_{word}", of_run, np.float64, attributes)
        if self.runs:
            yield _flagged("run_status", of_run, np.int32, "how each run ended", STATUS_WORDS)
        yield Variable(MESSAGE, grid, None, {"long_name": "what was wrong with the case"})

    def case_values(self, block: Block) -> Iterator[tuple[str, npt.NDArray[Any]]]:
        """The variables of the cases of a block, all but their messages: name and values [case, ...]."""
        column = 0
        for ask in self.asks:
            columns = slice(column, column + ask.count) if ask.is_list else column
            yield ask.key, block.value[:, columns]
            if self.estimate:
                yield error_name(ask.key), block.error[:, columns]
            column += ask.count
        for index, word in TRUST_WORDS.items() if self.estimate else ():
            yield word, block.trust[:, index]
        per_run = slice(None) if self.runs else 0
        yield "status", block.status
        yield "reason", block.reason
        yield "route", block.route[:, per_run]
        yield "solves", block.solves
        for index, word in AUDIT_WORDS.items():
            yield f"audit_{word}", block.audit[:, per_run, index]
        if self.runs:
            yield "run_status", block.run_status


class Tally:
    """What follows from all cases of a result, counted block by block."""

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._cases, self._failed, self._mended, self._seconds = 0, 0, 0, 0.0
        self._routes: set[int] = set()

    def add(self, block: Block) -> int:
        """Counts a block; gives its first case."""
        first = self._cases
        self._cases += len(block)
        self._failed += int(np.count_nonzero(block.status))
        self._mended += sum(int(block.status[row] == PM_OK) for row in block.message)
        self._seconds += block.seconds
        self._routes.update(np.unique(block.route).tolist())
        return first

    def attributes(self) -> dict[str, Any]:
        """Attributes of the result.  Raises StudyError if cases are missing."""
        if self._cases != self._layout.cases:
            raise StudyError(f"{self._cases} of {self._layout.cases} cases are stored; the result needs all")
        return {
            "cases": np.int64(self._cases),
            "cases_not_ok": np.int64(self._failed),
            "cases_mended": np.int64(self._mended),
            "routes": " ".join(ROUTE_WORDS[route] for route in sorted(self._routes)),
            "elapsed_seconds": self._seconds,
            "parameters": " ".join(coordinate.name for coordinate in self._layout.coordinates),
        }


def _texts(name: str, values: Sequence[str]) -> Variable:
    return Variable(name, (name,), None, {}, np.array(values, dtype=object))


def _flagged(
    name: str, dims: tuple[str, ...], dtype: type[np.generic], text: str, meaning: Mapping[int, str]
) -> Variable:
    """An integer variable whose values are words, by the attributes that CF has for them."""
    flags = {"flag_values": np.array(list(meaning), dtype), "flag_meanings": " ".join(meaning.values())}
    return Variable(name, dims, dtype, {"long_name": text, **flags})
