"""One scene as a picture: as it stands at an instant, or a figure of the book."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .base.errors import SceneError
from .base.themes import require_theme
from .pen import page
from .pen.theme import on_paper
from .pictures import diagrams
from .pictures.instants import instant_of
from .pictures.picture import Picture
from .pictures.scene import figure, start_of

if TYPE_CHECKING:
    from .scene import Scene


def draw(
    scene: Scene,
    at: str | None = None,
    as_: str | None = None,
    bodies: str | Sequence[str] = (),
    run: str | None = None,
    theme: str = "light",
) -> Picture:
    """Draws a scene: see Scene.draw."""
    chosen = (bodies,) if isinstance(bodies, str) else tuple(bodies)
    if as_ is None and chosen:
        raise SceneError('bodies are chosen of a figure: give as_ too, such as "free-body"', path="bodies")
    require_theme(theme)
    with page.style(theme):
        if as_ is not None:
            made = diagrams.figure(scene, as_, at, run, chosen)
            fault = ""
        else:
            start = start_of(scene, run) if at is None else instant_of(scene, at, run)
            made, fault = figure(start), start.fault
        return Picture(on_paper(made, theme), fault, theme)
