"""One scene as a picture: as it stands at an instant, or a figure of the book."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from .base.errors import SceneError
from .base.themes import require_theme
from .pen import page
from .pen.theme import on_paper
from .pictures import diagrams
from .pictures.instants import instant_of
from .pictures.scene import figure, start_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .scene import Scene


@dataclass(frozen=True)
class Picture:
    """A picture: a notebook shows it, `save` writes it; `figure` is that of matplotlib.

    `fault`: why the scene is drawn only as it is written; "" if it could be assembled.
    """

    figure: Figure
    fault: str = ""
    theme: str = "light"

    def save(self, out: str | os.PathLike[str]) -> Path:
        """Writes it as PNG, SVG or PDF, by the ending.  Raises StudyError if it cannot be written."""
        path = Path(out)
        with page.style(self.theme):
            page.save(self.figure, path)
        return path

    def _repr_png_(self) -> bytes:
        made = BytesIO()
        with page.style(self.theme):
            self.figure.savefig(made, format="png", dpi=page.RESOLUTION)
        return made.getvalue()


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
