"""Asks: from [ask] to rows of the kernel's ask table and columns of its results."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from .. import _layout as layout
from ..base.errors import SceneError
from ..geometry.packing import Tables
from ..geometry.parameters import Reader
from ..language.tree import Node, binary
from ..language.units import DIMENSIONLESS, Dimension, factor
from ..model.readers import Value
from ..model.tables import Ask, At, Grid
from ..model.words import unknown
from .events import firing
from .measure_rows import Reading
from .measures import Measures

# Columns of an answer "each EVENT" where nothing says how often the event fires.
EACH_FIRINGS = 64
# A grid by steps ends at the last value that is not beyond `to` by more than this part of a step.
_STEP_ROUNDING = 1e-9


@dataclass(frozen=True)
class AskColumn:
    """Where the answer to an ask stands in the results, and its unit: value = SI / factor.

    `first`, `count`: columns of out; `is_list`: the answer is a list; `open_ended`: as long as the event
    fired, so that not-a-number at its end means nothing; `run`: the run that it belongs to, or None.
    """

    key: str
    unit: str
    factor: float
    first: int
    count: int
    is_list: bool
    run: str | None
    open_ended: bool = False


class Asks:
    """Adds asks to the tables."""

    def __init__(
        self,
        events: Mapping[str, int],
        bounds: Mapping[int, int],
        measures: Measures,
        reader: Reader,
        tables: Tables,
    ) -> None:
        """`bounds`: how often an event can fire before the run ends, where that is known."""
        self.events = events
        self.bounds = bounds
        self.measures = measures
        self.reader = reader
        self.tables = tables
        self.columns: list[AskColumn] = []
        self.dimensions: dict[str, Dimension] = {}
        self._width = 0

    def add(self, key: str, ask: Ask) -> None:
        """Adds the row of one ask and its column.  Raises SceneError for a wrong unit or instant."""
        path = f"ask.{key}"
        word = next(one for one in ("of", "max", "min") if getattr(ask, one) is not None)
        reading = self.measures.lower(getattr(ask, word), f"{path}.{word}" if ask.of is None else path)
        unit, size = _unit(ask.unit, reading.dimension, path)
        row, count = self._instant(word, ask.at, f"{path}.at")
        row[layout.PM_ASK_PROGRAM] = self.tables.program(reading.node, path)
        row[layout.PM_ASK_OUT] = self._width
        row[layout.PM_ASK_COUNT] = count
        self.tables.add(layout.PM_TABLE_ASK, row, path)
        kind = row[layout.PM_ASK_KIND]
        is_each = kind == layout.PM_ASK_EACH
        is_list = is_each or kind == layout.PM_ASK_GRID
        self.columns.append(AskColumn(key, unit, size, self._width, count, is_list, ask.run, is_each))
        self.dimensions[key] = reading.dimension
        self._width += count

    def _instant(self, word: str, at: str | At | None, where: str) -> tuple[dict[int, int], int]:
        """The row's kind and instant, and the number of values."""
        if word == "max":
            return _row(layout.PM_ASK_MAX), 1
        if word == "min":
            return _row(layout.PM_ASK_MIN), 1
        if isinstance(at, At):
            return self._at_measure(at, where)
        if at is None or at.strip() == "end":
            return _row(layout.PM_ASK_END), 1
        return self._at_event(at, where)

    def _at_measure(self, at: At, where: str) -> tuple[dict[int, int], int]:
        if at.each is not None:
            assert at.values is not None
            return self._grid(at.each, at.values, where)
        kind = layout.PM_ASK_AT_MAX if at.max is not None else layout.PM_ASK_AT_MIN
        word = "max" if at.max is not None else "min"
        row = _row(kind)
        extreme = self.measures.lower(getattr(at, word), f"{where}.{word}")
        row[layout.PM_ASK_PROGRAM_2] = self.tables.program(extreme.node, f"{where}.{word}")
        return row, 1

    def _grid(self, each: Value, grid: Grid, where: str) -> tuple[dict[int, int], int]:
        reading = self.measures.lower(each, f"{where}.each")
        nodes = grid_nodes(self.reader, grid, f"{where}.values", reading)
        row = _row(layout.PM_ASK_GRID)
        row[layout.PM_ASK_PROGRAM_2] = self.tables.program(reading.node, f"{where}.each")
        indices = [self.tables.new_value(node, f"{where}.values[{i}]") for i, node in enumerate(nodes)]
        row[layout.PM_ASK_FIRST_VALUE] = indices[0]
        return row, len(nodes)

    def _at_event(self, at: str, where: str) -> tuple[dict[int, int], int]:
        first, _, rest = at.strip().partition(" ")
        before, each = (first == "before" and bool(rest)), (first == "each" and bool(rest))
        name = rest if before or each else at
        found = firing(name, self.events)
        if found is None:
            word = (name.split() or [""])[0]
            raise SceneError(unknown(word, [*self.events, "end"], "instant"), path=where, value=at)
        event, nth = found
        if nth == 0:
            raise SceneError("firings are counted from 1", path=where, value=at)
        if each and nth is not None:
            raise SceneError(f'write "each {name.split()[0]}", without a number', path=where, value=at)
        row = _row(layout.PM_ASK_EACH if each else layout.PM_ASK_EVENT)
        row[layout.PM_ASK_EVENT_INDEX] = event
        row[layout.PM_ASK_NTH] = nth or 1
        row[layout.PM_ASK_BEFORE] = int(before)
        return row, self.bounds.get(event, EACH_FIRINGS) if each else 1


def _row(kind: int) -> dict[int, int]:
    """A row with nothing but its kind."""
    return {
        layout.PM_ASK_KIND: kind,
        layout.PM_ASK_PROGRAM: layout.PM_NONE,
        layout.PM_ASK_EVENT_INDEX: layout.PM_NONE,
        layout.PM_ASK_NTH: 1,
        layout.PM_ASK_BEFORE: 0,
        layout.PM_ASK_PROGRAM_2: layout.PM_NONE,
        layout.PM_ASK_FIRST_VALUE: layout.PM_NONE,
        layout.PM_ASK_OUT: 0,
        layout.PM_ASK_COUNT: 1,
    }


def _unit(written: str | None, found: Dimension, path: str) -> tuple[str, float]:
    """Unit text and factor of an answer; by default the SI unit."""
    if written is None:
        return found.unit or "1", 1.0
    try:
        size, dimension = factor(written)
        if dimension != found:
            such_as = f", such as {found.unit}" if found != DIMENSIONLESS else ', such as "1", "rad" or "deg"'
            raise SceneError(f"this is {dimension.phrase}; the answer is {found.phrase}{such_as}")
    except SceneError as error:
        raise SceneError(error.reason, path=f"{path}.unit", value=written) from None
    return written, size


def grid_nodes(reader: Reader, grid: Grid, where: str, reading: Reading) -> list[Node]:
    """The values of a grid, which have the dimension of `reading`."""
    wanted = reading.dimension
    if grid.values is not None:
        if not grid.values:
            raise SceneError("at least 1 value is needed", path=where)
        return [reader.number(value, f"{where}[{i}]", wanted) for i, value in enumerate(grid.values)]
    assert grid.from_ is not None
    assert grid.to is not None
    start = reader.number(grid.from_, f"{where}.from", wanted)
    stop = reader.number(grid.to, f"{where}.to", wanted)
    if grid.step is not None and grid.scale == "log":
        raise SceneError("a logarithmic grid has num, not step", path=f"{where}.step", value=grid.step)
    if grid.step is not None:
        return _steps(reader, grid.step, start, stop, where, wanted)
    assert grid.num is not None
    if grid.num < 1:
        raise SceneError("at least 1 value is needed", path=f"{where}.num", value=grid.num)
    if grid.num == 1:
        return [start]
    parts = [i / (grid.num - 1) for i in range(1, grid.num - 1)]
    if grid.scale == "log":
        between = [start * binary("^", stop / start, part) for part in parts]
    else:
        between = [start + (stop - start) * part for part in parts]
    return [start, *between, stop]


def _steps(
    reader: Reader, written: Value, start: Node, stop: Node, where: str, wanted: Dimension
) -> list[Node]:
    step = reader.number(written, f"{where}.step", wanted)
    if any(reader.depends_on(node) for node in (start, stop, step)):
        reason = "the number of steps would depend on parameters; give num instead"
        raise SceneError(reason, path=f"{where}.step", value=written)
    first, last, size = (reader.default(node) for node in (start, stop, step))
    if size == 0 or (last - first) / size < 0:
        raise SceneError(
            "the steps do not lead from the first value to the last", path=f"{where}.step", value=written
        )
    count = int((last - first) / size + _STEP_ROUNDING) + 1
    return [start + step * i for i in range(count)]
