"""The player as a widget of a notebook, whose time Python reads and sets."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from .needs import require
from .page import module, style


def widget(document: Mapping[str, Any]) -> Any:
    """The widget of what `document.document` gives; see `Animation.widget`.

    Raises StudyError if anywidget is not installed."""
    require("widget")
    return _player()(motion=dict(document))


@cache
def _player() -> Any:
    """The class; anywidget is imported when the first widget is made."""
    import anywidget
    import traitlets

    class Player(anywidget.AnyWidget):
        """A motion that a notebook plays."""

        _esm = module()
        _css = style()
        motion = traitlets.Dict(help="what is played").tag(sync=True)
        time = traitlets.Float(0.0, help="the time shown, in s").tag(sync=True)
        playing = traitlets.Bool(False, help="whether it runs").tag(sync=True)
        speed = traitlets.Float(0.0, help="seconds of the run in one; 0: what suits it").tag(sync=True)

        def __repr__(self) -> str:
            return f"Player of {self.motion.get('title', '')} at t = {self.time:g} s"

    return Player
