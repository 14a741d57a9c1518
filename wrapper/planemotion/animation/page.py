"""The page that plays a motion: one file without anything outside of it."""

from __future__ import annotations

import html
import json
from collections.abc import Mapping
from importlib.resources import files
from string import Template
from typing import Any

# The player, in the order in which a browser reads it.
_SCRIPTS = ("player.js", "player_controls.js")


def page(document: Mapping[str, Any]) -> str:
    """The page of what `moving.document` gives."""
    motion = json.dumps(document, separators=(",", ":"), allow_nan=False, ensure_ascii=False)
    return Template(_resource("player.html")).substitute(
        title=html.escape(str(document["title"])),
        style=_resource("player.css"),
        motion=motion.replace("</", "<\\/"),  # nothing in it ends the element
        script="\n".join(map(_resource, _SCRIPTS)),
    )


def _resource(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")
