"""The cases of a sweep: a grid over parameters, numbered in C order (the last parameter changes fastest)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..base.arrays import Floats
from ..base.errors import SceneError
from ..compile.designs import draw
from ..compile.grids import read_grid
from ..geometry.parameters import Parameters
from ..language.units import declared_unit, factor
from ..model.readers import Value
from ..reading.scene import SceneData

if TYPE_CHECKING:
    from ..reading.scene import WrittenScene


# The dimension of cases that a design has drawn.
CASE = "case"


@dataclass(frozen=True)
class Axis:
    """The values of one swept parameter, as written, in `unit`; of an option their numbers, and `options`."""

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

    `drawn`: the group whose values a design has drawn; its dimension is called `case`.
    """

    groups: tuple[tuple[Axis, ...], ...]
    drawn: int | None = None

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
            (CASE if i == self.drawn else group[0].name, len(group[0].values))
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
        place = np.unravel_index(np.arange(first, first + count, dtype=np.int64), self.shape)
        columns = [axis.si[i] for group, i in zip(self.groups, place, strict=True) for axis in group]
        return np.stack(columns, axis=1)


def plan_sweep(scene: WrittenScene) -> SweepPlan:
    """The cases of the scene's [sweep].  Raises SceneError with file and key path."""
    try:
        return _plan(scene.data)
    except SceneError as error:
        raise error.at(file=scene.data.file) from None


def _plan(data: SceneData) -> SweepPlan:
    if not data.sweep.grids:
        raise SceneError("nothing to sweep; write for example sweep.d = { from, to, num }", path="sweep")
    dimensions = Parameters(data.parameters, tables=data.book).dimensions
    options = [name for name in data.sweep.grids if name not in data.parameters]
    units = {name: declared_unit(data.parameters.get(name, 0)) for name in data.sweep.grids}
    drawn = {name: one for name, one in data.sweep.grids.items() if one.is_drawn}
    values = draw(data.sweep.design, drawn, units) if data.sweep.design else {}
    for name, grid in data.sweep.grids.items():
        if name not in drawn and name not in options:
            values[name] = read_grid(grid, path=f"sweep.{name}", unit=units[name])
    axes: dict[str, Axis] = {}
    for name, grid in data.sweep.grids.items():
        if name in options:
            axes[name] = _option(name, grid.values or ())
            continue
        unit, numbers = values[name]
        wanted, given = dimensions[name], factor(unit)[1]
        if wanted not in (None, given):
            raise SceneError(
                f"the grid is of {given.name}, but the parameter is {wanted.phrase}", path=f"sweep.{name}"
            )
        axes[name] = Axis(name, unit, numbers)
    groups = tuple(_grouped(axes, [*data.sweep.zip, *([tuple(drawn)] if drawn else [])]))
    at = next((i for i, group in enumerate(groups) if group[0].name in drawn), None)
    return SweepPlan(groups, at)


def _option(name: str, values: Sequence[Value]) -> Axis:
    """An axis of options: each has its number."""
    if not values:
        raise SceneError("an empty sweep; at least 1 value is needed", path=f"sweep.{name}", value="[]")
    for value in values:
        if values.count(value) > 1:
            raise SceneError("it is there twice", path=f"sweep.{name}", value=value)
    return Axis(name, "", np.arange(float(len(values))), tuple(values))


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
