"""What a find has to say, in the scene's own words: nothing found, several, at a bound."""

from __future__ import annotations

import math
from collections.abc import Callable

from .. import _layout as layout
from ..base.arrays import Floats, Ints
from ..compile.finds import FindCondition, FlatFind
from ..compile.flatten import FlatScene
from ..language.units import factor
from .evaluator import value_table


def describe_find(flat: FlatScene, status: int, where: Ints, detail: Floats, param: Floats) -> str:
    """The sentence for a status of a find; `where` [3], `detail` [3], `param` [parameters]: of the case."""
    assert flat.find is not None
    return _TEXTS[status](_Said(flat, flat.find, where, detail, param))


class _Said:
    """The numbers of one case's find, with units."""

    def __init__(self, flat: FlatScene, find: FlatFind, where: Ints, detail: Floats, param: Floats) -> None:
        self.flat = flat
        self.find = find
        self.table, self.row = int(where[layout.PM_WHERE_TABLE]), int(where[layout.PM_WHERE_ROW])
        self.first, self.second = float(detail[layout.PM_DETAIL_VALUE]), float(detail[layout.PM_DETAIL_BOUND])
        values = value_table(flat, param)
        self.bounds = [(float(values[low]), float(values[high])) for low, high in find.bounds]

    @property
    def condition(self) -> FindCondition | None:
        is_condition = self.table == layout.PM_TABLE_CONDITION and 0 <= self.row < len(self.find.conditions)
        return self.find.conditions[self.row] if is_condition else None

    @property
    def widen(self) -> str:
        return "widen " + " or ".join(f"{self.find.path}.vary.{name}" for name in self.find.vary)

    def parameter(self, number: int, si: float) -> str:
        """A value of a sought parameter in its own unit."""
        unit = self.flat.units[self.flat.parameters.index(self.find.vary[number])]
        return f"{si / factor(unit)[0]:.6g} {unit}".rstrip() if unit else f"{si:.6g}"

    def range(self) -> str:
        """h from 0 in to 29 in."""
        return " and ".join(
            f"{name} from {self.parameter(i, low)} to {self.parameter(i, high)}"
            for i, (name, (low, high)) in enumerate(zip(self.find.vary, self.bounds, strict=True))
        )

    def ends(self, unit: str) -> str:
        """What is seen at both ends of the (first) range."""
        name, (low, high) = self.find.vary[0], self.bounds[0]
        at = [f"{name} = {self.parameter(0, end)}" for end in (low, high)]
        if len(self.find.vary) == 2:
            at = ["the lower bounds", "the upper bounds"]
        seen = [_reading(value, unit) for value in (self.first, self.second)]
        return f"{seen[0]} at {at[0]} and {seen[1]} at {at[1]}"


def _reading(value: float, unit: str) -> str:
    if not math.isfinite(value):
        return "without a value"
    return f"{value:.4g}" + (f" {unit}" if unit != "1" else "")


def _none(said: _Said) -> str:
    condition = said.condition
    if condition is None:
        goal = f"{said.find.path}.{said.find.goal}"
        nowhere = "it has no value, or the conditions hold nowhere"
        return f'{goal} = "{said.find.of}": {nowhere}, with {said.range()}'
    if condition.unit is None:
        never = f'no change of "{condition.text}" with {said.range()} (it never holds)'
        return f"{condition.path}: {never}; {said.widen}"
    return (
        f"{_unmet(said, condition)} is {said.ends(condition.unit)}; {said.widen}, or take more "
        f"{said.find.path}.samples"
    )


def _unmet(said: _Said, condition: FindCondition) -> str:
    not_met = f'{condition.path}: "{condition.text}" is not met with {said.range()}'
    return f"{not_met}: the difference of its sides"


def _jump(said: _Said) -> str:
    condition = said.condition
    assert condition is not None
    unit = condition.unit or "1"
    step = f"jumps from {_reading(said.first, unit)} to {_reading(said.second, unit)}"
    return f"{_unmet(said, condition)} {step}"


def _several(said: _Said) -> str:
    what = f'"{said.condition.text}"' if said.condition else f'{said.find.goal} "{said.find.of}"'
    name = said.find.vary[0]
    return (
        f"{said.find.path}: {said.second:.0f} places with {what}, {said.range()}; the answers are those of "
        f"the first, another is at {name} = {said.parameter(0, said.first)}; narrow "
        f"{said.find.path}.vary.{name}, or say greatest or least"
    )


def _at_bound(said: _Said) -> str:
    name = said.find.vary[0]
    place = f"{name} = {said.parameter(0, said.first)}"
    if said.first not in said.bounds[0]:
        return f"{said.find.path}: what is sought lies at {place}, beyond which runs fail"
    return f"{said.find.path}: what is sought lies at the bound {place} of {said.find.path}.vary.{name}"


_TEXTS: dict[int, Callable[[_Said], str]] = {
    layout.PM_FIND_NONE: _none,
    layout.PM_FIND_JUMP: _jump,
    layout.PM_FIND_SEVERAL: _several,
    layout.PM_FIND_AT_BOUND: _at_bound,
}
FIND_STATUSES = tuple(_TEXTS)
