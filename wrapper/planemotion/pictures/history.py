"""A recorded run as curves over time, with its events as vertical lines."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure

from ..engine.history import event_times
from ..pen.page import CURVES, FAMILY, HEAD_HEIGHT, ROW_HEIGHT, SOFT, head

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..engine.outcome import History


# What is measured in a unit, in the order of the panels.
_KINDS = {
    "J": "energies",
    "m": "positions",
    "rad": "angles",
    "m/s": "velocities",
    "rad/s": "angular velocities",
    "N": "forces",
    "N*m": "couples",
}
_MAX_SOURCES = 8  # colours in a panel
_LONG_LEGEND = 7  # curves whose names fill two columns
_DASHES: dict[str, Any] = {"x": "-", "y": (0, (4, 1.5))}


def plot_history(runs: Mapping[str, History], title: str) -> Figure:
    """The figure of a history: a panel for each kind of quantity, a column for each of its runs."""
    columns = dict(list(runs.items())[:FAMILY])
    units = {unit for recorded in columns.values() for unit in recorded.units.values()}
    kinds = [*(unit for unit in _KINDS if unit in units), *sorted(units - set(_KINDS))]
    rows = max(1, len(kinds))
    width = 8.2 * len(columns) if len(columns) == 1 else 6.6 * len(columns)
    figure = Figure(figsize=(width, rows * ROW_HEIGHT + HEAD_HEIGHT + 0.4), layout="constrained")
    places = figure.subplots(rows, len(columns), squeeze=False, sharex="col")
    for column, (run, recorded) in enumerate(columns.items()):
        for row, unit in enumerate(kinds):
            _history_panel(places[row, column], recorded, unit)
            if run and row == 0:
                places[row, column].set_title(f"run {run}", loc="right", weight="normal", color=SOFT)
        places[-1, column].set_xlabel("t [s]")
    events = sum(len(event_times(recorded)) for recorded in columns.values())
    notes = [f"{sum(len(recorded.time) for recorded in columns.values())} instants"]
    notes.append(f"{events} event{'s' if events != 1 else ''}" + (" (vertical lines)" if events else ""))
    head(figure, title, ", ".join(notes))
    return figure


def _history_panel(place: Axes, recorded: History, unit: str) -> None:
    """All columns of one unit over time, or the first of them where there are too many to tell apart."""
    names = [name for name, own in recorded.units.items() if own == unit]
    sources = list(dict.fromkeys(_source(name)[0] for name in names))[:_MAX_SOURCES]
    shown = [name for name in names if _source(name)[0] in sources]
    for instant in event_times(recorded):
        place.axvline(instant, color=SOFT, linewidth=0.5, alpha=0.6, zorder=1)
    for name in shown:
        source, part = _source(name)
        colour = CURVES[sources.index(source)]
        dashes = _DASHES.get(part, "-")
        place.plot(
            recorded.time, recorded.columns[name], color=colour, linestyle=dashes, linewidth=1.1, label=name
        )
    kind = _KINDS.get(unit, "")
    place.set_title(f"{kind} [{unit}]" if unit != "1" else kind or "numbers")
    if len(shown) < len(names):
        place.set_title(f"{len(shown)} of {len(names)}", loc="right", size=8, weight="normal", color=SOFT)
    columns = 1 + (len(shown) > _LONG_LEGEND)
    options = {"handlelength": 1.2, "labelspacing": 0.25, "columnspacing": 0.8, "fontsize": 7.5}
    place.legend(loc="upper left", bbox_to_anchor=(1.0, 1.05), ncols=columns, **options)


def _source(address: str) -> tuple[str, str]:
    """What a column is a part of, and which part: "A.force", "x"."""
    source, _, part = address.rpartition(".")
    return (source, part) if part in _DASHES else (address, "")
