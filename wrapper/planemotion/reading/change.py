"""Other values in the table of a scene: parameters by name, settings such as "sweep.d.num", options."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..base.errors import SceneError
from ..geometry.parameters import override
from ..model.tables import DEFAULT_G
from ..model.words import ELEMENTS, OPTIONS, unknown
from .plain import literal, plain
from .scene import SceneData

# Tables that may be set beside parameters, as in "sweep.d.num".
_SETTABLE = ("parameters", "find", "sweep", *OPTIONS)


def set_value(raw: dict[str, Any], name: str, value: Any, data: Callable[[], SceneData]) -> None:
    """Changes the table `raw`; `data`: the scene as it was, for its parameters and tables of measured values.

    Raises SceneError for an unknown name or a value of another dimension.
    """
    first, _, rest = name.partition(".")
    declared = _declared(raw, name, data)
    if not rest or first == "parameters" or name in declared:
        key = rest if first == "parameters" else name
        _set_parameter(raw, declared, key, name, value, data)
    elif first in _SETTABLE:
        _set_option(raw, name, value)
    else:
        reason = f"only {', '.join(_SETTABLE[:-1])} and {_SETTABLE[-1]} can be set, not {first}"
        raise SceneError(reason, path=name)


def _declared(raw: dict[str, Any], name: str, data: Callable[[], SceneData]) -> dict[str, Any]:
    """The parameters, also those that parts bring where the name may be one of these."""
    declared = {"g": DEFAULT_G, **raw.get("parameters", {})}
    if name in declared or name.partition(".")[0] in ("find", "sweep", "solve"):
        return declared
    return {**data().parameters, **declared} if "parts" in raw or "." in name else declared


def _set_parameter(
    raw: dict[str, Any],
    declared: dict[str, Any],
    key: str,
    name: str,
    value: Any,
    data: Callable[[], SceneData],
) -> None:
    if isinstance(value, list):
        reason = f"one value is wanted; sweep({key}=[...]) computes a case for each of a list"
        raise SceneError(reason, path=key, value=value)
    if key not in declared and "." not in name:
        reason = unknown(name, declared, "parameter") + "; or set sweep.PARAMETER..., solve.KEY"
        raise SceneError(reason, path=name)
    _check_not_sought(raw, key)
    changed = override(declared, key, value, data().book)
    raw.setdefault("parameters", {})[key] = plain(changed)


def _set_option(raw: dict[str, Any], name: str, value: Any) -> None:
    first, _, rest = name.partition(".")
    table, key = _element(raw, first, rest, name) if first in ELEMENTS else (raw, name)
    while "." in key:
        word, _, key = key.partition(".")
        below = table.setdefault(word, {})
        if not isinstance(below, dict):
            raise SceneError(f"{word} is no table", path=name)
        table = below
    table[key] = literal(value)


def _element(raw: dict[str, Any], group: str, rest: str, path: str) -> tuple[dict[str, Any], str]:
    """The element whose option `rest` is ("floor.law"), and what is left of it ("law")."""
    elements = raw.get(group, {})
    named = [name for name in elements if rest.startswith(f"{name}.")]
    if not named:
        raise SceneError(unknown(rest.rpartition(".")[0], elements, f"entry of {group}"), path=path)
    name = max(named, key=len)
    if not isinstance(elements[name], dict):
        raise SceneError(f"{name} is no table", path=path)
    return elements[name], rest[len(name) + 1 :]


def _check_not_sought(raw: dict[str, Any], name: str) -> None:
    """Raises SceneError for a parameter that every run looks for: setting it would do nothing."""
    top = raw.get("find")
    own = [run.get("find", top) for run in raw.get("runs", {}).values()] or [top]
    if all(find and name in find.get("vary", {}) for find in own):
        raise SceneError(f"[find] looks for it; set find.vary.{name}", path=f"parameters.{name}")
