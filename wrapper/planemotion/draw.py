"""One scene as a picture: as it stands at an instant, or a figure of the book."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from .base.errors import SceneError, StudyError
from .base.themes import require_theme
from .pen import page
from .pen.theme import on_paper
from .pictures import diagrams
from .pictures.instants import instant_of
from .pictures.measured import shown_with
from .pictures.picture import Picture
from .pictures.scene import figure, start_of
from .reading.plain import plain_text

if TYPE_CHECKING:
    from .scene import Scene


def draw(
    scene: Scene,
    at: Any = None,
    as_: str | None = None,
    bodies: str | Sequence[str] = (),
    run: str | None = None,
    theme: str = "light",
    show: str | Iterable[str] = (),
) -> Picture:
    """Draws a scene: see Scene.draw.

    Values in figures are in lb, ft and s where the scene has feet or inches, else in N, m, s and J; vectors
    by their parts along x and y, or across (N) and along (F) a surface.  "?" is what nothing tells, such as
    the reaction at a body whose mass was left out.
    """
    chosen = (bodies,) if isinstance(bodies, str) else tuple(bodies)
    more = shown_with(show)
    if as_ is not None and more:
        raise SceneError("a diagram has its own values: give show or as_, not both", path="show")
    if as_ is None and chosen:
        raise SceneError('bodies are chosen of a figure: give as_ too, such as "free-body"', path="bodies")
    require_theme(theme)
    with page.style(theme):
        try:
            when = None if at is None else plain_text(at, "at")
            if as_ is not None:
                made = diagrams.figure(scene, as_, when, run, chosen)
                fault = ""
            else:
                start = start_of(scene, run) if when is None else instant_of(scene, when, run)
                made, fault = figure(start, more), start.fault
        except (SceneError, StudyError) as error:
            raise error.at(file=scene.file) from None
        return Picture(on_paper(made, theme), fault, theme)
