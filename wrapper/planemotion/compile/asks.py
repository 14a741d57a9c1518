"""Asks: from [ask] to rows of the kernel's ask table and columns of its results."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from .. import _layout as layout
from ..base.arrays import Floats
from ..base.errors import SceneError, nearest
from ..geometry.packing import Tables
from ..geometry.parameters import Reader
from ..language.dimensions import ANGULAR_VELOCITY, DIMENSIONLESS, ENERGY, TIME, Dimension
from ..language.tree import ONE, ZERO, Node, is_condition, select
from ..language.units import factor, parse_quantity
from ..model.readers import Value
from ..model.tables import Ask, At, Grid
from ..model.words import ASK_INTEGRALS, ASK_SWINGS, unknown
from .events import firing
from .grids import grid_nodes, read_grid
from .measures import Measures, Reading
from .swings import Hidden, dimension_of, period, wave

# Columns of an answer "each EVENT" where nothing says how often the event fires, and the most of them.
EACH_FIRINGS = 64
MOST_FIRINGS = 100_000

# A word of events is a whole number, exact as a double.
_WORD_BITS = 53

_OVER_TIME = {
    "integral": layout.PM_ASK_INTEGRAL,
    "mean": layout.PM_ASK_MEAN,
    "rms": layout.PM_ASK_RMS,
    "median": layout.PM_ASK_PERCENTILE,
    "percentile": layout.PM_ASK_PERCENTILE,
}


@dataclass(frozen=True)
class Asked:
    """One ask: what was asked, where its numbers stand in the results, and its unit: value = SI / factor.

    `first`, `count`: columns of out of its run; `is_list`: the answer is a list; `text`: for people; `at`:
    unit and values [count] of the grid of a list, where they are plain quantities; `open_ended`: as long as
    the event fired, so that not-a-number at its end means nothing.  `row`: the one in the kernel's table of
    asks that people see; `hidden`: rows, of a column each, before it.  `letters`: of a word of events their
    names, one row of the table each, from `row` on, and one for their sum at the end; `longest`: the
    letters of the longest word.
    """

    key: str
    unit: str
    factor: float
    first: int
    count: int
    is_list: bool
    text: str = ""
    at: tuple[str, Floats] | None = None
    open_ended: bool = False
    row: int = 0
    letters: tuple[str, ...] = ()
    longest: int = 0
    hidden: int = 0

    @property
    def rows(self) -> int:
        """How many rows of the kernel's table of asks it has."""
        return len(self.letters) + bool(self.letters) or 1 + self.hidden

    @property
    def columns(self) -> int:
        """How many columns of out it has."""
        return len(self.letters) * self.longest + bool(self.letters) or self.count + self.hidden


class Asks:
    """Adds asks to the tables."""

    def __init__(
        self,
        events: Mapping[str, int],
        bounds: Mapping[int, int],
        measures: Measures,
        reader: Reader,
        tables: Tables,
        watched: Callable[[Node, str], Node],
        firings: int = EACH_FIRINGS,
    ) -> None:
        """`bounds`: how often an event can fire before the run ends, where that is known.

        `watched`: what is looked at of an expression all along.

        `firings`: how long an answer "each EVENT" may be of any other event."""
        self.firings = firings
        self.watched = watched
        self.events = events
        self.bounds = bounds
        self.measures = measures
        self.reader = reader
        self.tables = tables
        self.columns: list[Asked] = []
        self.dimensions: dict[str, Dimension] = {}
        self._energies: set[str] = set()
        self._width = 0
        self._rows = 0

    def add(self, key: str, ask: Ask) -> None:
        """Adds the row of one ask, behind those that it reads, and its column.

        Raises SceneError for a wrong unit or instant.
        """
        path = f"ask.{key}"
        if ask.events is not None:
            self._add_word(key, ask, ask.events)
            return
        word = ask.word
        if word in ASK_SWINGS:
            self._add_swing(key, ask)
            return
        at_instant = word == "of" and not isinstance(ask.at, At)
        with self.measures.of_instant(at_instant):
            reading = self._read(getattr(ask, word), f"{path}.{word}" if ask.of is None else path)
        if word in ASK_INTEGRALS:
            reading, row, count = *self._over_time(ask, reading, path), 1
        else:
            row, count = self._instant(word, ask.at, f"{path}.at")
        unit, size = _unit(ask.unit, reading, path)
        node = reading.node if word == "of" else self.watched(reading.node, path)
        row[layout.PM_ASK_PROGRAM] = self.tables.program(node, path)
        kind = row[layout.PM_ASK_KIND]
        is_each = kind == layout.PM_ASK_EACH
        is_list = is_each or kind == layout.PM_ASK_GRID
        at = _plain_values(ask.at, count)
        asked = Asked(key, unit, size, self._width, count, is_list, ask.text, at, is_each, self._rows)
        self.columns.append(asked)
        self._add_row(row, count, path)
        self.dimensions[key] = reading.dimension
        if reading.energy:
            self._energies.add(key)

    def _add_row(self, row: dict[int, int], count: int, path: str) -> int:
        """Its first column."""
        first = row[layout.PM_ASK_OUT] = self._width
        row[layout.PM_ASK_COUNT] = count
        self.tables.add(layout.PM_TABLE_ASK, row, path)
        self._width += count
        self._rows += 1
        return first

    def _add_swing(self, key: str, ask: Ask) -> None:
        """Adds what is asked of an expression that swings, behind the rows that it combines."""
        path = f"ask.{key}"
        where = f"{path}.{ask.word}"
        reading = self._read(getattr(ask, ask.word), where)
        rows, hidden = self._rows, Hidden(self.tables, self.watched, self._add_row, where)
        if ask.word in ("period", "frequency"):
            about = self.reader.number(ask.about, f"{path}.about", reading.dimension)
            found = period(hidden, reading.node - about, ask.nth)
            found = ONE / found if ask.word == "frequency" else found
        else:
            assert ask.omega is not None
            omega = self.reader.number(ask.omega, f"{path}.omega", ANGULAR_VELOCITY)
            found = wave(hidden, reading.node, omega, self._condition(ask, f"{path}.during"), ask.word)
        dimension = dimension_of(ask.word, reading.dimension)
        unit, size = _unit(ask.unit, Reading(found, dimension), path)
        row = {**_row(layout.PM_ASK_END), layout.PM_ASK_PROGRAM: self.tables.program(found, path)}
        column = Asked(
            key, unit, size, self._width, 1, False, ask.text, row=self._rows, hidden=self._rows - rows
        )
        self.columns.append(column)
        self._add_row(row, 1, path)
        self.dimensions[key] = dimension

    def _condition(self, ask: Ask, where: str) -> Node | None:
        """The condition `during` of an ask."""
        if ask.during is None:
            return None
        if not is_condition(self.reader.parameters.parse(ask.during, where)):
            reason = 'a condition is wanted, such as "t < (2 s)"'
            raise SceneError(reason, path=where, value=ask.during)
        return self._read(ask.during, where).node

    def _add_word(self, key: str, ask: Ask, events: tuple[str, ...]) -> None:
        """Adds which events happened: at each firing of one, how many of all have fired so far."""
        path = f"ask.{key}.events"
        longest = longest_word(len(events))
        asked = Asked(
            key, "", 1.0, self._width, 1, False, ask.text, row=self._rows, letters=events, longest=longest
        )
        so_far = self.measures.lower(" + ".join(f"{name}.count" for name in events), path)
        program = self.tables.program(so_far.node, path)
        for name in events:
            row = _row(layout.PM_ASK_EACH)
            row[layout.PM_ASK_EVENT_INDEX] = self.events[name]
            row[layout.PM_ASK_NTH] = 1
            row[layout.PM_ASK_PROGRAM] = program
            self._add_row(row, longest, path)
        self._add_row({**_row(layout.PM_ASK_END), layout.PM_ASK_PROGRAM: program}, 1, path)
        self.columns.append(asked)

    def answers(self) -> dict[str, Reading]:
        """What names of asks stand for in asks behind them: answers; a parameter of that name goes first."""
        return {
            column.key: Reading(
                self.tables.answer_leaf(column.first),
                self.dimensions[column.key],
                column.key in self._energies,
            )
            for column in self.columns
            if not column.is_list and not column.letters and not self.measures.knows(column.key)
        }

    def _read(self, written: Value, where: str) -> Reading:
        """The expression of an ask."""
        with self.measures.answered(self.answers()):
            return self.measures.lower(written, where)

    def _over_time(self, ask: Ask, reading: Reading, path: str) -> tuple[Reading, dict[int, int]]:
        """What is asked of an expression all along, and its row: 0 where its condition does not hold."""
        row = _row(_OVER_TIME[ask.word])
        if row[layout.PM_ASK_KIND] == layout.PM_ASK_PERCENTILE:
            row[layout.PM_ASK_FIRST_VALUE] = self._part(ask, path)
        dimension = reading.dimension * TIME if ask.word == "integral" else reading.dimension
        where = f"{path}.during"
        condition = self._condition(ask, where)
        if condition is None:
            return Reading(reading.node, dimension, reading.energy), row
        row[layout.PM_ASK_PROGRAM_2] = self.tables.program(
            self.watched(select(condition, ONE, ZERO), where), where
        )
        return Reading(select(condition, reading.node, ZERO), dimension, reading.energy), row

    def _part(self, ask: Ask, path: str) -> int:
        """The part of the time in which an expression is below the answer."""
        where = f"{path}.percent"
        percent = self.reader.number(50 if ask.percent is None else ask.percent, where, DIMENSIONLESS)
        found = self.tables.default(percent)
        if not 0 < found < 100:
            reason = f"it is {found:.6g}; a percentage of the time lies between 0 and 100"
            raise SceneError(reason, path=where, value=ask.percent)
        return self.tables.new_value(percent / 100, where)

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
        row[layout.PM_ASK_PROGRAM_2] = self.tables.program(
            self.watched(extreme.node, f"{where}.{word}"), f"{where}.{word}"
        )
        return row, 1

    def _grid(self, each: Value, grid: Grid, where: str) -> tuple[dict[int, int], int]:
        reading = self.measures.lower(each, f"{where}.each")
        nodes = grid_nodes(self.reader, grid, f"{where}.values", reading)
        row = _row(layout.PM_ASK_GRID)
        row[layout.PM_ASK_PROGRAM_2] = self.tables.program(
            self.watched(reading.node, f"{where}.each"), f"{where}.each"
        )
        indices = [self.tables.new_value(node, f"{where}.values[{i}]") for i, node in enumerate(nodes)]
        row[layout.PM_ASK_FIRST_VALUE] = indices[0]
        return row, len(nodes)

    def _no_instant(self, name: str, then: str) -> str:
        """What is wrong with an instant that is no event, and how it is written; `at` becomes `then`."""
        known = [*self.events, "end"]
        when, what, word = name, "a condition", (name.split() or [""])[0]
        if word == "after" and " " in name:
            return just_after(name.partition(" ")[2].strip())
        if _is_time(name):
            when, what, word = f"t = {name}", "a time", name
        elif nearest(word, known):
            return unknown(word, known, "instant")
        elif name in self.measures.scope.contacts:
            when = f"{name} strikes"
        example = f'{what} gets a name: events.NAME = "{when}", then at = "{then}"'
        return f"{unknown(word, known, 'instant')}; {example}"

    def _at_event(self, at: str, where: str) -> tuple[dict[int, int], int]:
        first, _, rest = at.strip().partition(" ")
        before, each = (first == "before" and bool(rest)), (first == "each" and bool(rest))
        name = rest if before or each else at
        found = firing(name, self.events, where)
        if found is None:
            then = f"{first} NAME" if before or each else "NAME"
            raise SceneError(self._no_instant(name, then), path=where, value=at)
        event, nth = found
        if nth == 0:
            raise SceneError("firings are counted from 1", path=where, value=at)
        if each and nth is not None:
            raise SceneError(f'write "each {name.split()[0]}", without a number', path=where, value=at)
        row = _row(layout.PM_ASK_EACH if each else layout.PM_ASK_EVENT)
        row[layout.PM_ASK_EVENT_INDEX] = event
        row[layout.PM_ASK_NTH] = nth or 1
        row[layout.PM_ASK_BEFORE] = int(before)
        return row, self.bounds.get(event, self.firings) if each else 1


def just_after(event: str) -> str:
    """That no "after" is written."""
    return f'write "{event}": that is just after the event, "before {event}" just before it'


def _is_time(text: str) -> bool:
    try:
        return parse_quantity(text).dimension == TIME
    except SceneError:
        return False


def longest_word(letters: int) -> int:
    """Letters of the longest word of events that one number tells: digits of the base letters + 1."""
    return int(_WORD_BITS / math.log2(letters + 1))


def _plain_values(at: str | At | None, count: int) -> tuple[str, Floats] | None:
    """Unit and values [count] of the grid at which a list is asked, if they are plain quantities."""
    if not isinstance(at, At) or at.values is None:
        return None
    try:
        unit, values = read_grid(at.values, path="at.values")
    except SceneError:  # expressions, which may differ from case to case
        return None
    return (unit, values) if len(values) == count else None


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


def _unit(written: str | None, reading: Reading, path: str) -> tuple[str, float]:
    """Unit text and factor of an answer; by default the SI unit."""
    found = reading.dimension
    if written is None:
        return ("J" if reading.energy and found == ENERGY else found.unit or "1"), 1.0
    try:
        size, dimension = factor(written)
        if dimension != found:
            such_as = f", such as {found.unit}" if found != DIMENSIONLESS else ', such as "1", "rad" or "deg"'
            raise SceneError(f"this is {dimension.phrase}; the answer is {found.phrase}{such_as}")
    except SceneError as error:
        raise SceneError(error.reason, path=f"{path}.unit", value=written) from None
    return written, size
