"""What a run that did not come to its end waited for, and which values that took on the way."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .. import _layout as layout
from ..base.arrays import Floats
from ..base.errors import PlanemotionError, SceneError
from ..compile.flatten import flatten
from ..engine import call
from ..engine.outcome import History
from ..language.address import DOTTED
from ..language.units import factor, parse_quantity
from ..reading.scene import SceneData

# Statuses of runs that go well and do not come to their end.
ENDLESS = frozenset(
    {layout.PM_LIMIT_TIME, layout.PM_LIMIT_STEPS, layout.PM_LIMIT_EVENTS, layout.PM_STAYS_AT_REST}
)
# Steps of the run that is recorded to see the values, and instants at which it is looked at.
_STEPS = 20_000
_LOOKS = 1000
# Of the range of the values: so near to a bound is at it.
_AT = 1e-9
_COMPARISON = re.compile(r"([^=<>]+)([=<>])([^=<>]+)")
_EVERY = re.compile(r"(.+?)\s+every\s+.+")
_STRIKES = re.compile(r"(\S+)\s+strikes")
_FIRING = re.compile(rf"({DOTTED})(?:\s+\d+)?")
_TIME = ("t", "time")
_SIDES = {"<": "below", ">": "above"}


@dataclass(frozen=True)
class _Condition:
    """A condition as it is written, the event it belongs to, what it watches, and the comparison."""

    text: str
    event: str
    watched: str
    operator: str = ""
    bound: str = ""


def waited_for(data: SceneData, run: str | None) -> str:
    """What `until` watches in a run: the range of its values, and why its condition did not come.

    The values are those of a run of at most some ten thousand steps.  "" where nothing tells.
    """
    told = []
    for condition in _conditions(data):
        columns = [condition.watched, *([condition.bound] if condition.bound else [])]
        try:
            recorded = _recorded(data, run, columns)
        except PlanemotionError:
            continue
        if recorded.time.size:
            told.append(_told(condition, recorded))
    return "; ".join(told)


def _conditions(data: SceneData) -> Iterator[_Condition]:
    """Those of `until`, also of the events that it names."""
    for text in (text.strip() for group in data.until for text in group):
        event = _FIRING.fullmatch(text)
        named = data.events.get(event[1]) if event else None
        for one in named.when if named is not None else (text,):
            found = _condition(one.strip(), event[1] if event and named is not None else "")
            if found is not None and found.watched not in _TIME:
                yield found


def _condition(text: str, event: str) -> _Condition | None:
    if compared := _COMPARISON.fullmatch(text):
        watched, operator, bound = (part.strip() for part in compared.groups())
        return _Condition(text, event, watched, operator, bound)
    if every := _EVERY.fullmatch(text):
        return _Condition(text, event, every[1])
    if strikes := _STRIKES.fullmatch(text):
        return _Condition(text, event, f"{strikes[1]}.gap")
    return None


def _recorded(data: SceneData, run: str | None, columns: list[str]) -> History:
    """The run over time: at the ends of its steps, then at equal distances of time, too."""
    steps = {"max_steps": min(_STEPS, data.solve.max_steps), "estimate": False}
    limited = data.model_copy(update={"solve": data.solve.model_copy(update=steps)})
    flat = flatten(limited, run, history=tuple(columns))
    recorded = call.trace(flat, flat.defaults)
    duration = recorded.time[-1] if recorded.time.size else 0.0
    return call.trace(flat, flat.defaults, every=duration / _LOOKS) if duration > 0 else recorded


def _told(condition: _Condition, recorded: History) -> str:
    values = recorded.columns[condition.watched]
    least, most = float(np.nanmin(values)), float(np.nanmax(values))
    small = _AT * max(abs(least), abs(most))
    unit, size = _unit(condition, recorded)
    ends = [0.0 if abs(end) <= small else end / size for end in (least, most)]
    low, high = (f"{end:.4g} {unit}".rstrip() for end in ends)
    lay = f"lay between {low} and {high}" if low != high else f"was {low}"
    during = f" up to t = {recorded.time[-1]:.4g} s" if recorded.time[-1] > 0 else ""
    text = f"{condition.watched} {lay}{during}"
    if condition.event:
        text += f' (the event {condition.event} waits for "{condition.text}")'
    return text + _side(condition, recorded, small)


def _side(condition: _Condition, recorded: History, small: float) -> str:
    """That the condition held from the start on, so that nothing came."""
    if not condition.bound:
        return ""
    over: Floats = recorded.columns[condition.watched] - recorded.columns[condition.bound]
    side = _SIDES.get(condition.operator)
    if (
        side is not None
        and np.all(over <= small if side == "below" else over >= -small)
        and np.any(over != 0)
    ):
        falls = "falls" if side == "below" else "rises"
        return (
            f": it is {side} that from the start on, and an event fires when a value {falls} {side} its bound"
        )
    if side is None and abs(over[0]) <= small:
        return ": it is so at the start, and an event fires when the value comes to it later"
    return ""


def _unit(condition: _Condition, recorded: History) -> tuple[str, float]:
    """The unit in which the condition is written, and its size in SI."""
    try:
        quantity = parse_quantity(condition.bound)
        if quantity.unit_text:
            return quantity.unit_text, factor(quantity.unit_text)[0]
    except SceneError:
        pass
    unit = recorded.units[condition.watched]
    return ("" if unit == "1" else unit), 1.0
