"""What no type says of an ask: which keys go together."""

from __future__ import annotations

from ..base.errors import SceneError
from ..model import words
from ..model.tables import Ask, At
from ..model.words import ASK_EXTREMES, ASK_INTEGRALS, ASK_PERIODS, ASK_SWINGS, ASK_WAVES, ASK_WORDS
from .scene import SceneData

# Keys of an ask that say more of some words.
_GO_WITH = {
    "during": (*ASK_INTEGRALS, *ASK_WAVES),
    "about": ASK_PERIODS,
    "nth": ASK_PERIODS,
    "omega": ASK_WAVES,
    "percent": ("percentile",),
}


def check_ask(data: SceneData, ask: Ask, path: str) -> None:
    """Raises SceneError for the first fault of an ask."""
    known = (*ASK_WORDS, "events")
    given = [key for key in known if getattr(ask, key) is not None]
    if len(given) != 1:
        wanted = f"one of {', '.join(known)} is wanted"
        raise SceneError(wanted + (f", not {' and '.join(given)}" if given else ""), path=path)
    if ask.events is not None:
        _check_word(data, ask, path)
    if given[0] in ASK_EXTREMES and ask.at is not None:
        raise SceneError(
            f"an extreme over the run has no instant; write of = ..., at = {{ {given[0]} = ... }}",
            path=f"{path}.at",
        )
    if given[0] in (*ASK_INTEGRALS, *ASK_SWINGS) and ask.at is not None:
        part = '; during = "t < (2 s)" takes a part of that' if given[0] not in ASK_PERIODS else ""
        reason = f'"{given[0]}" is over the time of the whole run{part}'
        raise SceneError(reason, path=f"{path}.at")
    if given[0] in ASK_WAVES and ask.omega is None:
        raise SceneError(f"the circular frequency of the {given[0]} is wanted", path=f"{path}.omega")
    if given[0] == "percentile" and ask.percent is None:
        raise SceneError("the percentage of the time is wanted, such as percent = 95", path=f"{path}.percent")
    for key, goes_with in _GO_WITH.items():
        if key in ask.model_fields_set and given[0] not in goes_with:
            reason = f"it goes with {', '.join(goes_with)}, not with {given[0]}"
            raise SceneError(reason, path=f"{path}.{key}", value=getattr(ask, key))
    if isinstance(ask.at, At):
        kinds = [key for key in ("max", "min", "each") if getattr(ask.at, key) is not None]
        if len(kinds) != 1 or (kinds == ["each"]) != (ask.at.values is not None):
            raise SceneError(
                "an instant is { max = ... }, { min = ... } or { each = ..., values = grid }",
                path=f"{path}.at",
            )
    if ask.run is not None and ask.run not in data.runs:
        raise SceneError(words.unknown(ask.run, tuple(data.runs), "run"), path=f"{path}.run")


def _check_word(data: SceneData, ask: Ask, path: str) -> None:
    """Of an ask which events happened."""
    for key in ("at", "unit"):
        if getattr(ask, key) is not None:
            reason = "an ask which events happened is about the whole run, and has no unit"
            raise SceneError(reason, path=f"{path}.{key}", value=getattr(ask, key))
    assert ask.events is not None
    for index, name in enumerate(ask.events):
        if name not in data.events:
            raise SceneError(words.unknown(name, data.events, "event"), path=f"{path}.events[{index}]")
        if name in ask.events[:index]:
            raise SceneError(f'"{name}" stands there twice', path=f"{path}.events[{index}]")
