"""The numbers of a grid that a sweep goes through: lists, even steps, even logarithms; ends included."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..geometry.parameters import Reader
from ..language.dimensions import Dimension
from ..language.tree import Node, binary
from ..language.units import Quantity, factor, parse_quantity
from ..model.readers import Value
from ..model.tables import Grid
from .measure_rows import Reading

# Values of one grid: ten million are meant to be possible, more is a slip of the pen.
_MAX_GRID = 10_000_000
# Values at which an ask is answered: each is a number of the scene and a column of the answers.
_MAX_ASKED = 100_000
# Part of a step by which the last one may miss the end of its range (units are converted on the way).
_STEP_FITS = 1e-9


def read_grid(grid: Grid, *, path: str, unit: str = "") -> tuple[str, Floats]:
    """Unit and values [n] of a grid in that unit, ends included.

    `unit` is that of bare numbers.  The values are in the unit of the first value that has one.  Raises
    SceneError with a key path that begins with `path`.
    """
    if grid.values is not None:
        if not grid.values:
            raise SceneError("an empty sweep; at least 1 value is needed", path=path, value="[]")
        places = [f"{path}[{i}]" for i in range(len(grid.values))]
        items = [_quantity(item, place, unit) for item, place in zip(grid.values, places, strict=True)]
        return _in_one_unit(items, places)
    written = {f"{path}.from": grid.from_, f"{path}.to": grid.to, f"{path}.step": grid.step}
    given = {place: value for place, value in written.items() if value is not None}
    items = [_quantity(value, place, unit) for place, value in given.items()]
    unit, ends = _in_one_unit(items, list(given))
    first, last = float(ends[0]), float(ends[1])
    if grid.num is not None:
        num = _checked_count(grid.num, f"{path}.num")
    elif grid.scale == "log":
        raise SceneError('a logarithmic grid needs "num", not "step"', path=f"{path}.step", value=grid.step)
    else:
        num, last = _steps(first, last, float(ends[2]), f"{path}.step", grid.step)
    if grid.scale == "linear":
        return unit, _linear(first, last, num)
    if first * last > 0:
        return unit, _logarithmic(first, last, num)
    raise SceneError(
        "a logarithmic grid needs ends of one sign, not 0", path=f"{path}.scale", value=grid.scale
    )


def quantities_in_one_unit(written: Sequence[Value], path: str, unit: str) -> tuple[str, Floats]:
    """Unit and values [n] of quantities of one kind; `unit` is that of bare numbers."""
    items = [_quantity(item, path, unit) for item in written]
    return _in_one_unit(items, [path] * len(items))


def _linear(first: float, last: float, num: int) -> Floats:
    """Evenly spaced decimals: the doubles nearest to first + i (last - first)/(num - 1).

    Exact arithmetic on the decimals of both ends, so that steps of 0.01 give 1.01, not 1.0100000000000002:
    the numbers that one would write after --set.
    """
    if num == 1:
        return np.array([first])
    a, b = Fraction(repr(first)), Fraction(repr(last))
    common = math.lcm(a.denominator, b.denominator)
    start, rise = int(a * common) * (num - 1), int((b - a) * common)
    below = common * (num - 1)
    return np.fromiter(((start + rise * i) / below for i in range(num)), np.float64, num)


def _logarithmic(first: float, last: float, num: int) -> Floats:
    """Evenly spaced logarithms; both ends exact."""
    if num == 1:
        return np.array([first])
    sign = math.copysign(1.0, first)
    low, high = math.log10(abs(first)), math.log10(abs(last))
    inner = [sign * 10.0 ** (low + (high - low) * (i / (num - 1))) for i in range(1, num - 1)]
    return np.array([first, *inner, last])


def _quantity(raw: Value, path: str, unit: str) -> Quantity:
    """A value of a grid; a bare number (true and false are 1 and 0) is taken in `unit`, as --set takes it."""
    try:
        quantity = parse_quantity(float(raw) if isinstance(raw, bool) else raw)
        if quantity.unit_text == "" and unit:
            size, dimension = factor(unit)
            quantity = Quantity(quantity.value * size, dimension, unit, quantity.value)
    except SceneError as error:
        raise error.at(path=path, value=raw) from None
    return quantity


def _in_one_unit(quantities: Sequence[Quantity], paths: Sequence[str]) -> tuple[str, Floats]:
    """All values in the unit of the first that is not a bare zero (a bare zero fits any unit)."""
    main = next((item for item in quantities if item.unit_text or item.value), quantities[0])
    values = []
    for item, path in zip(quantities, paths, strict=True):
        bare_zero = item.value == 0 and item.unit_text == ""
        written = f"{item.value!r} {item.unit_text}".strip()
        if item.dimension != main.dimension and not bare_zero:
            raise SceneError(
                f"{item.dimension.phrase}, but this grid is of {main.dimension.name}",
                path=path,
                value=written,
            )
        same = bare_zero or item.unit_text == main.unit_text
        value = item.value if same else item.value_si / factor(main.unit_text)[0]
        if not math.isfinite(value):
            reason = f'no finite number in "{main.unit_text}", the unit of this grid'
            raise SceneError(reason, path=path, value=written)
        values.append(value)
    return main.unit_text, np.array(values, np.float64)


def _checked_count(num: int, path: str) -> int:
    if num < 1:
        raise SceneError("an empty sweep; at least 1 value is needed", path=path, value=num)
    if num > _MAX_GRID:
        raise SceneError(f"at most {_MAX_GRID} values are possible", path=path, value=num)
    return num


def _too_many(count: float, most: int) -> str:
    these = f"these are {count:.3g} values" if count < math.inf else "the steps are too small to be counted"
    return f"{these}; at most {most} values are possible"


def _steps(first: float, last: float, step: float, path: str, written: object) -> tuple[int, float]:
    """Number of values, and the last one: `last`, or where the steps do not reach it the last before it."""
    if step == 0 or (last - first) / step < 0:
        raise SceneError('the step must lead from "from" to "to"', path=path, value=written)
    steps = (last - first) / step
    if not steps < _MAX_GRID:  # also where the steps are too small for the number of them
        raise SceneError(_too_many(steps, _MAX_GRID), path=path, value=written)
    whole = math.floor(steps + _STEP_FITS)
    if abs(steps - whole) > _STEP_FITS:
        last = float(Fraction(repr(first)) + whole * Fraction(repr(step)))
    return whole + 1, last


# A grid by steps ends at the last value that is not beyond `to` by more than this part of a step.
_STEP_ROUNDING = 1e-9


def grid_nodes(reader: Reader, grid: Grid, where: str, reading: Reading) -> list[Node]:
    """The values of a grid, which have the dimension of `reading`."""
    wanted = reading.dimension
    if grid.values is not None:
        if not grid.values:
            raise SceneError("at least 1 value is needed", path=where)
        if len(grid.values) > _MAX_ASKED:
            raise SceneError(_too_many(len(grid.values), _MAX_ASKED), path=where)
        return [reader.number(value, f"{where}[{i}]", wanted) for i, value in enumerate(grid.values)]
    assert grid.from_ is not None
    assert grid.to is not None
    start = reader.number(grid.from_, f"{where}.from", wanted)
    stop = reader.number(grid.to, f"{where}.to", wanted)
    if grid.step is not None and grid.scale == "log":
        raise SceneError("a logarithmic grid has num, not step", path=f"{where}.step", value=grid.step)
    if grid.step is not None:
        return _node_steps(reader, grid.step, start, stop, where, wanted)
    assert grid.num is not None
    if grid.num < 1:
        raise SceneError("at least 1 value is needed", path=f"{where}.num", value=grid.num)
    if grid.num > _MAX_ASKED:
        raise SceneError(_too_many(grid.num, _MAX_ASKED), path=f"{where}.num", value=grid.num)
    if grid.num == 1:
        return [start]
    parts = [i / (grid.num - 1) for i in range(1, grid.num - 1)]
    if grid.scale == "log":
        between = [start * binary("^", stop / start, part) for part in parts]
    else:
        between = [start + (stop - start) * part for part in parts]
    return [start, *between, stop]


def _node_steps(
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
    steps = (last - first) / size + _STEP_ROUNDING
    if not steps < _MAX_ASKED:
        raise SceneError(_too_many(steps, _MAX_ASKED), path=f"{where}.step", value=written)
    count = int(steps) + 1
    return [start + step * i for i in range(count)]
