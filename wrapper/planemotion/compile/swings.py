"""Asks about what swings: its period and frequency, its amplitude and phase at a given frequency.

Each becomes rows of the table of asks that nobody sees, and a last one that combines them at the end:

period     by upward crossings of a value, whose times an event of its own locates: the mean
           (last - first)/(count - 1) of the whole swings of a run, or the nth of them;
amplitude  of m + a cos(w t) + b sin(w t), the least square fit by integrals of x, x cos, x sin and of the
phase      waves alone: a = A cos(phase), b = -A sin(phase).  Over whole periods these are Fourier integrals.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .. import _layout as layout
from ..geometry.packing import Tables, empty_measure
from ..language.dimensions import DIMENSIONLESS, TIME, Dimension
from ..language.tree import ONE, ZERO, Binary, Node, Number, atan2, call, cos, norm, select, sin
from .events import add_event

# Of a period: what rounding may take off the time in which a wave is fitted.
_WHOLE = 1 - 1e-9
_TURN = 6.283185307179586


@dataclass(frozen=True)
class Hidden:
    """Adds rows that nobody sees, and gives how their answers are read at the end."""

    tables: Tables
    watched: Callable[[Node, str], Node]
    add_row: Callable[[dict[int, int], int, str], int]
    path: str

    def _row(self, kind: int, program: Node, **more: int) -> Node:
        row = {
            layout.PM_ASK_KIND: kind,
            layout.PM_ASK_PROGRAM: self.tables.program(program, self.path),
            layout.PM_ASK_EVENT_INDEX: more.get("event", layout.PM_NONE),
            layout.PM_ASK_NTH: more.get("nth", 1),
            layout.PM_ASK_BEFORE: 0,
            layout.PM_ASK_PROGRAM_2: more.get("condition", layout.PM_NONE),
            layout.PM_ASK_FIRST_VALUE: layout.PM_NONE,
            layout.PM_ASK_OUT: 0,
            layout.PM_ASK_COUNT: 1,
        }
        return self.tables.answer_leaf(self.add_row(row, 1, self.path))

    def firing(self, event: int, nth: int) -> Node:
        """The time of a firing."""
        return self._row(layout.PM_ASK_EVENT, self.time, event=event, nth=nth)

    def integral(self, node: Node, condition: Node | None) -> Node:
        """By the time in which a condition, if there is one, holds."""
        if condition is None:
            return self._row(layout.PM_ASK_INTEGRAL, self.watched(node, self.path))
        holds = self.tables.program(self.watched(select(condition, ONE, ZERO), self.path), self.path)
        part = select(condition, node, ZERO)
        return self._row(layout.PM_ASK_INTEGRAL, self.watched(part, self.path), condition=holds)

    @property
    def time(self) -> Node:
        """The time along the run."""
        return self.tables.measure_leaf(empty_measure(layout.PM_MEASURE_TIME), self.path)

    def of_event(self, kind: int, event: int) -> Node:
        """Count or last time of an event."""
        return self.tables.measure_leaf({**empty_measure(kind), layout.PM_MEASURE_A: event}, self.path)


def period(hidden: Hidden, above: Node, nth: int | None) -> Node:
    """From one rise of `above` through 0 to the next: the mean, or that of the nth swing."""
    tables, path = hidden.tables, hidden.path
    event = add_event(tables, path)
    trigger = {
        layout.PM_TRIGGER_KIND: layout.PM_TRIGGER_RISE,
        layout.PM_TRIGGER_EVENT: event,
        layout.PM_TRIGGER_PROGRAM: tables.program(hidden.watched(above, path), path),
        layout.PM_TRIGGER_A: layout.PM_NONE,
    }
    tables.add(layout.PM_TABLE_TRIGGER, trigger, path)
    if nth is not None:
        return hidden.firing(event, nth + 1) - hidden.firing(event, nth)
    first, second = hidden.firing(event, 1), hidden.firing(event, 2)
    last = call(
        "max", hidden.of_event(layout.PM_MEASURE_EVENT_TIME, event), second
    )  # with no second: no answer
    swings = hidden.of_event(layout.PM_MEASURE_EVENT_COUNT, event) - 1
    endless = Binary("-", swings, swings)  # 0; as many as a series of bounces has: none
    return (last - first + endless) / swings


def wave(hidden: Hidden, value: Node, omega: Node, condition: Node | None, word: str) -> Node:
    """Amplitude or phase of the wave cos(omega t + phase) in a value."""
    c, s = cos(omega * hidden.time), sin(omega * hidden.time)

    def over(node: Node) -> Node:
        return hidden.integral(node, condition)

    span, sum_c, sum_s = over(ONE), over(c), over(s)
    x, x_c, x_s = over(value), over(value * c), over(value * s)
    c_c, c_s = over(c * c), over(c * s)
    # without the mean
    cc, ss = c_c - sum_c * sum_c / span, span - c_c - sum_s * sum_s / span
    cs = c_s - sum_c * sum_s / span
    xc, xs = x_c - x * sum_c / span, x_s - x * sum_s / span
    size = cc * ss - cs * cs
    a, b = (xc * ss - xs * cs) / size, (xs * cc - xc * cs) / size
    found = norm(a, b) if word == "amplitude" else atan2(-b, a)
    enough = Binary(">=", call("abs", omega) * span, Number(_WHOLE * _TURN))
    return select(enough, found, Binary("/", ZERO, Binary("-", span, span)))


def dimension_of(word: str, value: Dimension) -> Dimension:
    """Of the answer."""
    match word:
        case "period":
            return TIME
        case "frequency":
            return DIMENSIONLESS / TIME
        case "amplitude":
            return value
        case _:
            return DIMENSIONLESS
