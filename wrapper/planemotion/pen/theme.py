"""A picture on dark paper: each colour of the house has its counterpart there, and no other changes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgba, to_rgba_array

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.collections import Collection
    from matplotlib.figure import Figure

# Light and dark; the dark ones are as strong, and are those of the player and the report.
_DARK = {
    "#ffffff": "#14181c",
    "#222222": "#e6e8ea",
    "#000000": "#e6e8ea",
    "#6b6b6b": "#98a2ab",
    "#1f4e79": "#8fbce6",
    "#b5362b": "#ff8a75",
    "#c8741a": "#f0a95a",
    "#3b7d5e": "#7fcfa6",
    "#2f8a4f": "#5cf2c4",
    "#9440d8": "#a866f4",
    "#bfb0de": "#f2ec5a",
    "#7a1010": "#c86653",
    "#52cb8c": "#9a6280",
    "#d978ec": "#6262ba",
    "#e3e3e3": "#2c353d",
    "#f0f0f0": "#20262c",
    "#ebebeb": "#2a3138",
    "#cccccc": "#38424b",
    "#dbe5ef": "#25384a",
    "#dd9c95": "#8c463e",
    "#2f6fb0": "#6fb4ff",
    "#a02c6f": "#f07fc0",
    "#8a9bab": "#6d7d8c",
    "#d9dde1": "#38424b",
}
_TABLE = [(np.array(to_rgba(light)[:3]), np.array(to_rgba(dark)[:3])) for light, dark in _DARK.items()]
_SAME = 1 / 512  # of a channel: half a step of eight bits
_PARTS = ("color", "facecolor", "edgecolor", "markerfacecolor", "markeredgecolor")


def themed(settings: Any, theme: str) -> Any:
    """Settings of matplotlib on paper of that theme."""
    paper = {"figure.facecolor": "#ffffff", "axes.facecolor": "#ffffff"}
    settings = {**paper, **settings}
    if theme == "light":
        return settings
    return {
        key: _DARK.get(value, value) if isinstance(value, str) else value for key, value in settings.items()
    }


def on_paper(figure: Figure, theme: str) -> Figure:
    """The finished picture, everything in it in its colour on that paper; colour maps keep theirs."""
    if theme != "light":
        for artist in figure.findobj():
            recolour(artist)
    return figure


def recolour(artist: Artist) -> None:
    """Gives what is drawn in a colour of the house its counterpart on dark paper."""
    from matplotlib.collections import Collection

    if isinstance(artist, Collection) and artist.get_array() is not None:
        _recolour_map(artist)
        return
    behind = getattr(artist, "get_bbox_patch", lambda: None)()  # of a text
    if behind is not None:
        recolour(behind)
    for part in _PARTS:
        getter, setter = (getattr(artist, f"{verb}_{part}", None) for verb in ("get", "set"))
        if getter is None or setter is None or (part == "color" and hasattr(artist, "set_edgecolor")):
            continue
        _recolour(getter(), setter)


def _recolour_map(mapped: Collection) -> None:
    """A colour map of categories; others have no colour of the house, and stay."""
    from matplotlib.colors import ListedColormap

    colours = mapped.get_cmap()
    if not isinstance(colours, ListedColormap):
        return
    shown = to_rgba_array(colours.colors)
    changed = np.array([_counterpart(one) for one in shown])
    if not np.array_equal(changed, shown):  # a bar beside a map forgets its ticks when the colours are set
        mapped.set_cmap(ListedColormap(changed))


def _recolour(colours: Any, setter: Any) -> None:
    """Sets the counterparts of one colour or of several; "none" and others stay."""
    if isinstance(colours, str) and colours in ("none", "auto"):
        return
    several = to_rgba_array(colours)
    changed = np.array([_counterpart(one) for one in several]).reshape(-1, 4)
    if changed.size and not np.array_equal(changed, several):
        setter(changed if len(changed) > 1 else tuple(changed[0]))


def dark_of(colours: Iterable[str]) -> dict[str, str]:
    """The counterparts on dark paper of colours of the house."""
    return {colour: _DARK[colour] for colour in colours}


def _counterpart(colour: Any) -> Any:
    for light, dark in _TABLE:
        if np.all(np.abs(colour[:3] - light) < _SAME):
            return np.append(dark, colour[3])
    return colour
