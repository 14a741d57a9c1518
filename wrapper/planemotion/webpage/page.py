"""The document of a report as a page: one file without anything outside of it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from importlib.resources import files
from typing import Any

from ..pen.page import CURVES, RED
from ..pen.theme import dark_of
from .needs import require

_INKS = (*CURVES, RED)  # colours that plots have


def page(document: Mapping[str, Any]) -> str:
    """The page of what `document.scene_document` or `document.study_document` gives.

    Raises StudyError if what it is built with is not installed."""
    require("jinja2", *(["plotly"] if document["plots"] else []))
    from jinja2 import Environment
    from markupsafe import Markup

    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(
        _resource("report.html")
    )
    return template.render(
        **document,
        style=Markup(_resource("report.css")),
        script=Markup(_resource("report.js")),
        plotly=Markup(_plotly()) if document["plots"] else "",
        data=Markup(
            _inlined({key: document[key] for key in ("plots", "replays")} | {"dark": dark_of(_INKS)})
        ),
    )


def _inlined(data: Mapping[str, Any]) -> str:
    """JSON as the text of an element of a page: nothing in it ends the element."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _plotly() -> str:
    from plotly.offline import get_plotlyjs

    return str(get_plotlyjs())


def _resource(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")
