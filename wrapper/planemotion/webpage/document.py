"""What a report tells, as the template takes it: a dict of texts, tables, plots and motions."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..animation import page as player
from ..base.versions import versions
from ..engine.answer import note_text, unit_text, value_text
from ..engine.kernel import status_text
from ..engine.result import counts_text, trust_text
from ..pictures.panels import read_panels
from .outcomes import LISTED, cases_not_ok, outcomes
from .plots import MAP_CELLS, plots

if TYPE_CHECKING:
    import xarray as xr

    from ..engine.answer import AskValue
    from ..engine.result import RunResult
    from ..reading.scene import SceneData

# Of a sweep, as its result has them, and what they are called in the report.
_OF_RESULT = {
    "created": "computed",
    "elapsed_seconds": "computing time [s]",
    "workers": "threads",
    "routes": "routes",
    "solve": "settings",
}


@dataclass(frozen=True)
class Replay:
    """A case in motion: where on each slider it is, its words, and its player, or why there is none."""

    place: Sequence[int]
    words: str
    motion: Mapping[str, Any] | None = None
    fault: str = ""


@dataclass(frozen=True)
class Slider:
    """A parameter along which cases are replayed: its name, and the texts of its values."""

    name: str
    values: Sequence[str]


@dataclass(frozen=True)
class Told:
    """What both kinds of report tell of a scene: its text, its pictures and how it is computed."""

    data: SceneData
    text: str
    pictures: Mapping[str, str]  # by theme
    explained: str
    replays: Sequence[Replay]
    sliders: Sequence[Slider] = ()


def scene_document(told: Told, result: RunResult) -> dict[str, Any]:
    """Of a scene that was run."""
    return {
        **_common(told),
        "status": {"word": result.status, "means": status_text(result.code), "ok": result.ok},
        "error": result.error,
        "answers": [_answer(key, ask) for key, ask in {**result.found, **result.asks}.items()],
        "audit": [{"name": name, "value": _residual(value)} for name, value in result.audit.items()],
        "trust": trust_text(result),
        "notes": result.notes,
        "counts": counts_text(result.counts),
        "provenance": {**_settings(told.data), **versions()},
    }


def study_document(told: Told, dataset: xr.Dataset) -> dict[str, Any]:
    """Of a sweep, as `xarray.open_dataset` gives it."""
    read = read_panels(dataset, MAP_CELLS)
    ended = outcomes(dataset)
    listed = cases_not_ok(dataset)
    bad = sum(one["count"] for one in ended if not one["ok"])
    return {
        **_common(told),
        "words": read.words,
        "plots": plots(read),
        "outcomes": ended,
        "cases_not_ok": listed,
        "not_listed": bad - len(listed) if bad > LISTED else 0,
        "provenance": {**_of_result(dataset), **json.loads(str(dataset.attrs["versions"]))},
    }


def _common(told: Told) -> dict[str, Any]:
    """What both have, and nothing of what only one has."""
    data = told.data
    return {
        "title": data.title or data.id,
        "id": data.id,
        "description": data.description or "",
        "scene": told.text,
        "pictures": {theme: text for theme, text in told.pictures.items() if text},
        "explained": told.explained,
        "sliders": [{"name": one.name, "values": list(one.values)} for one in told.sliders],
        "replays": {
            "player": player.page({"title": data.title or data.id, "motion": None}),
            "sliders": [list(one.values) for one in told.sliders],
            "cases": [
                {"place": list(one.place), "words": one.words, "motion": one.motion, "fault": one.fault}
                for one in told.replays
            ],
        },
        "status": None,
        "answers": [],
        "plots": [],
        "outcomes": [],
        "cases_not_ok": [],
    }


def _answer(key: str, ask: AskValue) -> dict[str, str]:
    return {"key": key, "value": value_text(ask), "unit": unit_text(ask), "note": note_text(ask)}


def _residual(value: float | None) -> str:
    return "-" if value is None else f"{value:.1e}"


def _settings(data: SceneData) -> dict[str, str]:
    return {"settings": _settings_text(data.solve.model_dump(exclude_none=True))}


def _settings_text(settings: Mapping[str, Any]) -> str:
    """accuracy = 1e-12, route = auto, ..."""
    return ", ".join(f"{name} = {value}" for name, value in settings.items())


def _of_result(dataset: xr.Dataset) -> dict[str, str]:
    told = {word: str(dataset.attrs[name]) for name, word in _OF_RESULT.items() if name in dataset.attrs}
    if "settings" in told:
        told["settings"] = _settings_text(json.loads(told["settings"]))
    return told
