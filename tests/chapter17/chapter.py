"""The chapter's scenes for tests and for the gallery: each is run once on a route, and errors are relative.

What a time route cannot say of a scene is told by the engine (`why_not`); the list below holds only what no
status can tell.
"""

from __future__ import annotations

import functools
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import planemotion
from planemotion.engine.answer import AskValue
from planemotion.engine.result import RunResult
from planemotion.run import simulate
from planemotion.scene import Scene
from tests import CHAPTER

SCENES = sorted(CHAPTER.glob("*.toml"))
REFERENCE: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("reference.toml").read_text(encoding="utf-8")
)
TIME_ROUTES = ("rk", "ida")
# Below this part of the greatest figure of its unit an answer is a sum that cancels: it is compared with that
# figure.  A root of the machine's precision: what is left of a sum of terms known to 1e-10 is far below.
CANCELS = 1e-8

# Scenes that a route takes but is not asked to here: reason by stem and route.
LEFT_OUT: dict[tuple[str, str], str] = {
    (
        "17-076",
        "ida",
    ): "one run of its find, where it was found, is compared",
}
NO_TIME = "no time passes"
# Massless hooks, and friction that goes with the load of a joint.
DECLINED = [("17-062", "ida"), ("17-071", "ida"), ("17-121", "ida"), ("17-122", "ida")]
# Runs that end in a singular position, where time stops being a coordinate of the motion, and how they
# may end (whether a step just meets its end, or comes over it, is a matter of rounding; where two passes
# differ in that the run is undecided): what they answer before is compared.
ENDS_EARLY = {("17-C5", "rk"): {"ends_singular", "undecided", "ok"}, ("17-C5", "ida"): {"ends_singular"}}


def as_list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


@functools.cache
def load(path: Path) -> Scene:
    """The scene of a file; not to be changed."""
    return planemotion.load(path)


def on_route(scene: Scene, route: str) -> Scene:
    """The same scene, told to take one route."""
    raw = scene.table
    raw["solve"] = {**raw.get("solve", {}), "route": route}
    return Scene.from_table(raw, file=scene.file)


@functools.cache
def run(path: Path, route: str = "auto") -> RunResult:
    """The result of a scene on a route, computed once for all who ask."""
    scene = load(path)
    return simulate(scene if route == "auto" else on_route(scene, route))


def why_not(path: Path, route: str) -> str:
    """Why a scene says nothing about a time route; empty where it does."""
    if (path.stem, route) in LEFT_OUT:
        return LEFT_OUT[path.stem, route]
    if (path.stem, route) in DECLINED:
        return "not for this route: that it says so is tested"
    if (path.stem, route) in ENDS_EARLY:
        return "it ends in a singular position: only what is answered before is compared"
    return NO_TIME if run(path, route).status == "no_time_route" else ""


def scales(asks: Mapping[str, AskValue]) -> dict[str, float]:
    """For each unit the greatest figure."""
    greatest: dict[str, float] = {}
    for ask in asks.values():
        for value in as_list(ask.value):
            greatest[ask.unit] = max(greatest.get(ask.unit, 0), abs(value or 0))
    return greatest


def errors(result: RunResult, wanted: Mapping[str, AskValue]) -> Iterator[tuple[str, float]]:
    """Each ask's greatest relative error; infinite where figures are missing, or there that should not be."""
    units = scales(wanted)
    for key, ask in wanted.items():
        answers, figures = as_list(result.asks[key].value), as_list(ask.value)
        if len(answers) != len(figures):
            yield key, float("inf")
            continue
        least = CANCELS * units[ask.unit]
        yield (
            key,
            max(
                (_error(*pair, least, units[ask.unit]) for pair in zip(answers, figures, strict=True)),
                default=0,
            ),
        )


def _error(answer: float | None, figure: float | None, least: float, scale: float) -> float:
    if answer is None or figure is None:
        return 0 if answer is figure else float("inf")
    difference = abs(answer - figure)
    return difference / (abs(figure) if abs(figure) > least else scale or 1)


def reference(result: RunResult) -> dict[str, AskValue]:
    """The reference figures of a scene, where there are any."""
    asks = REFERENCE.get(result.id, {})
    return {
        key: AskValue(ask["value"], ask["unit"])
        for key, ask in asks.items()
        if key != "instances" and "value" in ask
    }


def residual(result: RunResult) -> float:
    """The greatest residual of the audit; 0 where there is none."""
    return max((one for one in result.audit.values() if one is not None), default=0)
