"""The answers of one scene: values with units, evidence, and what happened."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .. import _layout as layout
from ..base.html import html_table
from ..compile.asks import Asked
from ..compile.flatten import FlatScene
from ..language.units import factor
from .answer import Answer, AskValue, Estimate, note_text, unit_text, value_text
from .kernel import AUDITS, REASONS, route_name, status_name
from .messages import message
from .notes import first_ordered, notes_of, two_sided
from .outcome import CaseResults
from .words import read_words, spelled

_COUNTS = {
    name.removeprefix("PM_COUNT_").lower(): index
    for name, index in layout.pm_count_column.items()
    if name not in ("PM_COUNT_ROUTE", "PM_COUNT_COLUMNS")
}
# Counts that say something only where a parameter is sought.
_OF_FINDS = ("runs", "found")


@dataclass(frozen=True, repr=False)
class RunResult:
    """The answers of a scene, of all its [runs]: result["omega_B"], in the unit of the ask.

    An ask can be read as an attribute, too (result.omega_B), where its name is none of those below; what
    else is known of it (unit, error, margin, reason) is in result.asks["omega_B"].

    >>> from planemotion import load_text
    >>> from planemotion.examples import text_of
    >>> result = load_text(text_of("pin")).run()
    >>> result.ok, round(result.omega, 4), result.asks["omega"].unit
    (True, -4.9523, 'rad/s')
    >>> list(result), "theta" in result
    (['omega', 'reaction'], False)

    `status`: "ok", or the word of the first run that is not; `code`: its number (enum pm_status);
    `error`: its message, `stopped_at` when it stopped [s] (None where all is ok).  `route`: the routes taken.
    `asks`: answers by key, in the order of the file.
    `audit`: greatest residuals of energy, momentum and constraints (None where there is none).  `counts`:
    phases, events, jumps, steps, solves and passes of all runs; with a find also whole runs and brackets.
    `found`: what was sought, by parameter ("h"), or by run and parameter ("kept.h") where the scene has runs.
    `margin`: the least of the runs, infinite if no decision was taken, None where nothing was estimated;
    `excess`: the greatest estimated error over what solve.accuracy allows.
    """

    id: str
    file: str | None
    status: str
    code: int
    error: str
    route: tuple[str, ...]
    asks: Mapping[str, AskValue]
    audit: Mapping[str, float | None]
    counts: Mapping[str, int]
    stopped_at: float | None = None
    notes: tuple[str, ...] = field(default=())
    found: Mapping[str, AskValue] = field(default_factory=dict)
    margin: float | None = None
    excess: float | None = None

    def __getitem__(self, name: str) -> Answer:
        """The answer to an ask, also to one with the name of a field.  Raises KeyError if there is none."""
        if name not in self.asks:
            sought = f"; what was found is in found[{name!r}]" if name in self.found else ""
            raise KeyError(f"no ask {name!r}; there are {', '.join(self.asks) or 'none'}{sought}")
        return self.asks[name].value

    def __contains__(self, name: object) -> bool:
        return name in self.asks

    def __iter__(self) -> Iterator[str]:
        return iter(self.asks)

    def __len__(self) -> int:
        return len(self.asks)

    def __bool__(self) -> bool:
        """A result is there, also one of a scene that asks nothing."""
        return True

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(name for name in self.asks if name.isidentifier())})

    def _ipython_key_completions_(self) -> list[str]:
        return list(self.asks)

    def __repr__(self) -> str:
        lines = [f"RunResult {self.id}: {self.status}" + (f" - {self.error}" if self.error else "")]
        return "\n".join([*lines, *(f"  {key} = {_shown(ask)}" for key, ask in shown_answers(self).items())])

    def _repr_html_(self) -> str:
        """A table of the answers for a notebook."""
        return html_table(repr(self).partition("\n")[0], answer_rows(self))

    def __getattr__(self, name: str) -> Answer:
        # Only for names that are no field; the fields may not be there yet while a copy is made.
        asks = self.__dict__.get("asks", {})
        if name not in asks:
            raise AttributeError(f"no ask {name!r}; there are {', '.join(asks) or 'none'}")
        answer: Answer = asks[name].value
        return answer

    @property
    def ok(self) -> bool:
        """Whether every run came to its end."""
        return self.code == layout.PM_OK

    def to_json(self) -> dict[str, Any]:
        """The entry of this scene in the output of `planemotion run --json`: no not-a-number in it."""
        entry: dict[str, Any] = {"id": self.id, "file": self.file, "status": self.status}
        if self.error:
            entry["error"] = self.error
        entry["route"] = list(self.route)
        entry["asks"] = {key: ask.to_json() for key, ask in self.asks.items()}
        entry["audit"] = dict(self.audit)
        if self.found:
            entry["found"] = {name: value.to_json() for name, value in self.found.items()}
            entry["runs"] = self.counts["runs"]
        for name, number in (("margin", self.margin), ("error_over_accuracy", self.excess)):
            if number is not None and math.isfinite(number):
                entry[name] = number
        return entry

    def explain(self) -> str:
        """What was done and how far it can be trusted, for people."""
        audit = ", ".join(f"{name} {_number(value)}" for name, value in self.audit.items())
        lines = [
            f"{self.id}: {self.status}" + (f" - {self.error}" if self.error else ""),
            f"  route: {', '.join(self.route) or 'none'}",
            f"  {counts_text(self.counts)}",
            f"  audit (relative residuals): {audit}",
            *([f"  errors: {trust_text(self)}"] if self.excess is not None else []),
            *(f"  {note}" for note in self.notes),
        ]
        lines += [f"  found: {name} = {_shown(value)}" for name, value in self.found.items()]
        lines += [f"  {key} = {_shown(ask)}" for key, ask in self.asks.items()]
        return "\n".join(lines)


def shown_answers(result: RunResult) -> dict[str, AskValue]:
    """What is shown of a result: what was found, where no ask of that name tells it, and the answers."""
    found = {f"found {name}": value for name, value in result.found.items() if name not in result.asks}
    return {**found, **result.asks}


def answer_rows(result: RunResult) -> list[tuple[str, str, str, str]]:
    """A table of the answers in words, its head first."""
    rows = [("ask", "value", "unit", "estimated error or margin")]
    shown = shown_answers(result)
    rows += [(key, value_text(ask), unit_text(ask), note_text(ask)) for key, ask in shown.items()]
    return rows


def answers(flat: FlatScene, results: CaseResults, i: int) -> dict[str, AskValue]:
    """The answers of case i in the units of the asks."""
    out, reason, error, margin = (
        row[i].tolist() for row in (results.out, results.reason, results.error, results.margin)
    )
    status = int(results.status[i])
    return {
        column.key: _word(column, results, i)
        if column.letters
        else answer(column, out, reason[column.row], status, error, margin[column.row])
        for column in flat.asks
    }


def _word(column: Asked, results: CaseResults, i: int) -> AskValue:
    """Which events happened, as text."""
    words, reasons = read_words(column, results)
    value, reason = float(words[i]), int(reasons[i])
    rows = slice(column.row, column.row + column.rows)
    text = REASONS.get(reason, f"reason {reason}") if reason else ""
    if reason == layout.PM_REASON_CUT:
        text = f"more events fired than a word has letters, which are {column.longest}"
    known = [one for one in results.margin[i, rows].tolist() if not math.isnan(one)]
    spelt = None if math.isnan(value) else spelled(value, column.letters)
    return AskValue(spelt, column.unit, text, None, _finite(min(known, default=math.nan)))


def answer(
    column: Asked,
    out: Sequence[float],
    reason: int,
    status: int,
    error: Sequence[float],
    margin: float = math.nan,
) -> AskValue:
    """One answer from a row of `out` and one of `error` [out columns], SI; the rest belongs to its case."""
    columns = slice(column.first, column.first + column.count)
    values = [_finite(value / column.factor) for value in out[columns]]
    errors = [_finite(value / column.factor) for value in error[columns]]
    if column.open_ended:
        while values and values[-1] is None:
            values.pop()
    missing = any(value is None for value in values) or (column.open_ended and not values)
    if missing and reason == layout.PM_REASON_NONE:
        reason = layout.PM_REASON_FAILED if status < layout.PM_OK else layout.PM_REASON_NOT_REACHED
    cut, sided = reason == layout.PM_REASON_CUT, reason == layout.PM_REASON_TWO_SIDED
    text = REASONS.get(reason, f"reason {reason}") if missing or cut or sided else ""
    if cut:
        text += f", which is {column.count}"
    return AskValue(
        values if column.is_list else values[0],
        column.unit,
        text,
        _error(errors[: len(values)], column.is_list),
        _finite(margin),
    )


def _error(errors: list[float | None], is_list: bool) -> Estimate:
    """The errors as the values are given; None where nothing was estimated."""
    if all(error is None for error in errors):
        return None
    return errors if is_list else errors[0]


def collect(
    scene_id: str, file: str | None, order: Sequence[str], runs: Sequence[tuple[FlatScene, CaseResults]]
) -> RunResult:
    """One result of all runs of a scene (one case each); `order`: the asks' keys as in the file."""
    codes = [int(results.status[0]) for _, results in runs]
    worst = next((code for code in codes if code < layout.PM_OK), next((code for code in codes if code), 0))
    first = codes.index(worst)
    flat, results = runs[first]
    found = {key: ask for one, result in runs for key, ask in answers(one, result, 0).items()}
    error = message(flat, results, 0)
    if error and flat.run is not None:
        error = f"run {flat.run}: {error}"
    time = float(results.detail[0, layout.PM_DETAIL_TIME])
    sought = any(one.find is not None for one, _ in runs)
    excess = _known(max, (result.trust[0, layout.PM_TRUST_EXCESS] for _, result in runs))
    routes = [route_name(int(result.count[0, layout.PM_COUNT_ROUTE])) for _, result in runs]
    sums = [sum(numbers) for numbers in zip(*(result.count[0].tolist() for _, result in runs), strict=True)]
    counts = {word: sums[index] for word, index in _COUNTS.items() if sought or word not in _OF_FINDS}
    if error and counts["stiff_phases"] and "ida" not in routes:
        error += '; the motion is stiff: try solve.route = "ida"'
    return RunResult(
        id=scene_id,
        file=file,
        status=status_name(worst),
        code=worst,
        error=error,
        route=tuple(dict.fromkeys(routes)),
        asks={key: found[key] for key in order if key in found},
        audit={
            name: _worst(result.audit[0, index] for _, result in runs) for index, name in enumerate(AUDITS)
        },
        counts=counts,
        found={name: value for one, result in runs for name, value in _found(one, result)},
        stopped_at=time if worst != layout.PM_OK and math.isfinite(time) else None,
        notes=notes_of(excess, counts, routes, first_ordered(runs), two_sided(runs)),
        margin=_known(min, (result.trust[0, layout.PM_TRUST_MARGIN] for _, result in runs)),
        excess=excess,
    )


def _found(flat: FlatScene, results: CaseResults) -> Iterator[tuple[str, AskValue]]:
    """What was sought in a run, by name, in the units of the scene."""
    for number, name in enumerate(flat.find.vary if flat.find is not None else ()):
        unit = flat.units[flat.parameters.index(name)]
        size = factor(unit)[0] if unit else 1.0
        value = _finite(float(results.found[0, number]) / size)
        error = _finite(float(results.found[0, layout.PM_FOUND_FIRST_ERROR + number]) / size)
        key = name if flat.run is None else f"{flat.run}.{name}"
        yield key, AskValue(value, unit or "1", "" if value is not None else "not found", error)


def _known(choose: Callable[[list[float]], float], numbers: Iterable[float]) -> float | None:
    """The least or greatest number; None if any is not known."""
    found = [float(number) for number in numbers]
    return None if not found or any(math.isnan(number) for number in found) else choose(found)


def counts_text(counts: Mapping[str, int]) -> str:
    """What a run needed and met, without what it did not: "1 phase, 2 events"."""
    return ", ".join(
        f"{count} {_one(name) if count == 1 else name}".replace("_", " ")
        for name, count in counts.items()
        if count and name != "routes"
    )


def _one(counted: str) -> str:
    return counted.removesuffix("es") if counted.endswith("passes") else counted.removesuffix("s")


def trust_text(result: RunResult) -> str:
    """Margin and kept accuracy in words."""
    if result.excess is None or result.margin is None:
        return "not estimated"
    margin = "no decision" if math.isinf(result.margin) else f"margin of decisions {result.margin:.2g}"
    return f"at most {result.excess:.2g} of what solve.accuracy allows; {margin}"


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _worst(residuals: Any) -> float | None:
    numbers = [float(residual) for residual in residuals]
    return max(numbers) if all(math.isfinite(number) for number in numbers) else None


def _number(value: float | None) -> str:
    return "none" if value is None else f"{value:.1e}"


def _shown(ask: AskValue) -> str:
    reason = f"({ask.reason})" if ask.reason else ""
    return " ".join(text for text in (value_text(ask), unit_text(ask), reason) if text)
