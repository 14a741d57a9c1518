"""The player around a motion: a page of one file that needs nothing else, or a module for notebooks."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from importlib.resources import files
from string import Template
from typing import Any

# The player, in the order in which a browser reads it; what opens it comes behind.
_PLAYER = ("player_motion.js", "player.js", "player_signs.js", "player_controls.js")


def page(document: Mapping[str, Any]) -> str:
    """The page of what `document.document` gives."""
    motion = json.dumps(document, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    return Template(_resource("player.html")).substitute(
        title=html.escape(str(document["title"])),
        style=style(),
        motion=motion.replace("</", "<\\/"),  # nothing in it ends the element
        script=_script("player_page.js"),
    )


def module() -> str:
    """The player as an ECMAScript module whose default export has `render`, as anywidget wants it."""
    return _script("player_widget.js")


def style() -> str:
    """The look of the player."""
    return _resource("player.css")


def _script(opener: str) -> str:
    return "\n".join(map(_resource, (*_PLAYER, opener)))


def _resource(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")
