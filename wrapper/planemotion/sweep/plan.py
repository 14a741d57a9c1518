"""The cases of a sweep: a grid over parameters, numbered in C order (the last parameter changes fastest)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..compile.designs import draw
from ..compile.grids import read_grid
from ..geometry.parameters import Parameters
from ..language.units import declared_unit, factor
from ..model.readers import Value
from ..model.tables import Swept
from ..reading.scene import SceneData

if TYPE_CHECKING:
    from ..reading.scene import WrittenScene


# The dimension of cases that a design has drawn, or that are listed.
CASE = "case"


@dataclass(frozen=True)
class Axis:
    """The values of one swept parameter, as written, in `unit`; of an option numbers, and `options` as many.

    Options that are the same have the same number: they may come again where cases are listed.
    """

    name: str
    unit: str
    values: Floats
    options: tuple[Value, ...] = ()

    @property
    def labels(self) -> tuple[str, ...]:
        """Its options as they are written; none where it has numbers."""
        return tuple(str(one).lower() if isinstance(one, bool) else str(one) for one in self.options)

    def text(self, i: int) -> str:
        """A value as one would write it after --set: "1.01 in"."""
        return self.labels[i] if self.options else f"{float(self.values[i])!r} {self.unit}".rstrip()

    @cached_property
    def si(self) -> Floats:
        """The values [n] in SI, each with the bits that `parse_quantity` gives for its text."""
        return self.in_si(self.values)

    def in_si(self, values: Floats) -> Floats:
        """Other values [n] likewise."""
        return values * factor(self.unit)[0]


@dataclass(frozen=True)
class SweepPlan:
    """The cases of a sweep; `groups` are its dimensions, each with the parameters that move along it.

    `listed`: the group whose values a design has drawn, or which are listed; its dimension is called `case`.
    """

    groups: tuple[tuple[Axis, ...], ...]
    listed: int | None = None

    @property
    def axes(self) -> tuple[Axis, ...]:
        return tuple(axis for group in self.groups for axis in group)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(axis.name for axis in self.axes)

    @property
    def dims(self) -> tuple[tuple[str, int], ...]:
        """Name (of its first parameter, or CASE) and length of each dimension."""
        return tuple(
            (CASE if i == self.listed else group[0].name, len(group[0].values))
            for i, group in enumerate(self.groups)
        )

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(size for _, size in self.dims)

    @property
    def cases(self) -> int:
        return math.prod(self.shape)

    def case(self, index: int) -> dict[str, str]:
        """The parameters of one case as one would write them after --set: "1.01 in"."""
        place = np.unravel_index(index, self.shape)
        return {
            axis.name: axis.text(int(i))
            for group, i in zip(self.groups, place, strict=True)
            for axis in group
        }

    def block(self, first: int, count: int) -> Floats:
        """SI values [count, len(names)] of cases first .. first+count-1."""
        return self.rows(np.arange(first, first + count, dtype=np.int64))

    def rows(self, cases: npt.NDArray[np.int64]) -> Floats:
        """SI values [n, len(names)] of cases [n] by number."""
        place = np.unravel_index(cases, self.shape)
        columns = [axis.si[i] for group, i in zip(self.groups, place, strict=True) for axis in group]
        return np.stack(columns, axis=1)


def plan_sweep(scene: WrittenScene) -> SweepPlan:
    """The cases of the scene's [sweep].  Raises SceneError with file and key path."""
    try:
        return _plan(scene.data)
    except SceneError as error:
        raise error.at(file=scene.data.file) from None


def _example(data: SceneData) -> str:
    """A grid of a parameter of the scene, as it must be written."""
    name = next(reversed(data.parameters), "d")
    unit = declared_unit(data.parameters.get(name, 0))
    last = "1" if unit in ("", "1") else f'"1 {unit}"'
    return f"sweep.{name} = {{ from = 0, to = {last}, num = 11 }}"


def _plan(data: SceneData) -> SweepPlan:
    if not data.sweep.grids:
        raise SceneError(f"nothing to sweep; write for example {_example(data)}", path="sweep")
    dimensions = Parameters(data.parameters, tables=data.book).dimensions
    options = [name for name in data.sweep.grids if name not in data.parameters]
    units = {name: declared_unit(data.parameters.get(name, 0)) for name in data.sweep.grids}
    drawn = {name: one for name, one in data.sweep.grids.items() if one.is_drawn}
    values = draw(data.sweep.design, drawn, units) if data.sweep.design else {}
    for name, grid in data.sweep.grids.items():
        if name not in drawn and name not in options:
            values[name] = _numbers(name, grid, units[name])
    axes: dict[str, Axis] = {}
    for name, grid in data.sweep.grids.items():
        if name in options:
            axes[name] = _option(name, grid.values or (), again=grid.listed is not None)
            continue
        unit, numbers = values[name]
        wanted, given = dimensions[name], factor(unit)[1]
        if wanted not in (None, given):
            raise _misfit(name, grid, f"of {given.name}, but the parameter is {wanted.phrase}")
        axes[name] = Axis(name, unit, numbers)
    listed = tuple(drawn) or tuple(name for name, grid in data.sweep.grids.items() if grid.listed)
    groups = tuple(_grouped(axes, [*data.sweep.zip, *([listed] if listed else [])]))
    at = next((i for i, group in enumerate(groups) if group[0].name in listed), None)
    return SweepPlan(groups, at)


def _numbers(name: str, grid: Swept, unit: str) -> tuple[str, Floats]:
    """Unit and values of a grid, or of a column of listed cases; `unit` is that of bare numbers."""
    listed = grid.listed
    if listed is not None and listed.numbers is not None:
        return listed.unit or "", listed.numbers
    if listed is None:
        return read_grid(grid, path=f"sweep.{name}", unit=unit)
    return read_grid(grid, path=f"sweep.cases.{name}", unit=unit if listed.unit is None else listed.unit)


def _misfit(name: str, grid: Swept, what: str) -> SceneError:
    """The error that values are of another kind than the parameter."""
    if grid.listed is None:
        return SceneError(f"the grid is {what}", path=f"sweep.{name}")
    reason = f"the column {name} is {what}"
    return SceneError(reason, file=grid.listed.file, line=grid.listed.line, path="sweep.cases")


def _option(name: str, values: Sequence[Value], *, again: bool) -> Axis:
    """An axis of options: each has its number; the same may come `again`."""
    if not values:
        raise SceneError("an empty sweep; at least 1 value is needed", path=f"sweep.{name}", value="[]")
    numbers: dict[tuple[bool, Value], float] = {}  # 1 and true are two options
    for value in values:
        key = isinstance(value, bool), value
        if not again and key in numbers:
            raise SceneError("it is there twice", path=f"sweep.{name}", value=value)
        numbers.setdefault(key, float(len(numbers)))
    codes = np.array([numbers[isinstance(value, bool), value] for value in values])
    return Axis(name, "", codes, tuple(values))


def _grouped(axes: Mapping[str, Axis], zips: Sequence[Sequence[str]]) -> Iterator[tuple[Axis, ...]]:
    """The dimensions in the order of the file; a zip stands where its first parameter does."""
    together: dict[str, tuple[Axis, ...]] = {}
    for i, names in enumerate(zips):
        group = tuple(axes[name] for name in names)
        if len({len(axis.values) for axis in group}) > 1:
            sizes = ", ".join(f"{axis.name} has {len(axis.values)}" for axis in group)
            raise SceneError(f"zipped grids need equal numbers of values: {sizes}", path=f"sweep.zip[{i}]")
        together.update(dict.fromkeys(names, group))
    seen: set[str] = set()
    for name, axis in axes.items():
        if name not in seen:
            group = together.get(name, (axis,))
            seen.update(member.name for member in group)
            yield group
