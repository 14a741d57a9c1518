"""One scene as a picture that moves."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .animation.beside import Beside
from .animation.document import document
from .animation.moving import Motion, record
from .animation.needs import require
from .animation.page import page
from .animation.shows import USUAL, shows_of
from .base.errors import SceneError, StudyError
from .base.files import ANIMATIONS, appearing, ending
from .engine.kernel import status_name
from .pictures.scene import title_of
from .reading.scene import HasData


@dataclass(frozen=True, repr=False)
class Animation:
    """A run that moves: a notebook shows it, `save` writes it."""

    beside: Beside

    @property
    def motion(self) -> Motion:
        """The recorded run."""
        return self.beside.motion

    @property
    def fault(self) -> str:
        """Why the run ended early; "" if it came to its end."""
        status = self.motion.recorded.status
        return f"{self.motion.data.id}: the run ended early ({status_name(status)})" if status else ""

    def __repr__(self) -> str:
        end = float(self.motion.recorded.time[-1])
        return f"Animation of {title_of(self.motion.data)}, {end:.6g} s" + (
            f" - {self.fault}" if self.fault else ""
        )

    def html(self) -> str:
        """One page with everything in it: the player, the signs, the motion."""
        return page(document(self.beside))

    def widget(self) -> Any:
        """The same player as a widget, for live notebooks: Python reads and sets what it shows.

            player = scene.animate().widget()
            player.time = 0.25

        `time` (s), `playing` and `speed` are traits, which can be observed and linked with those of other
        widgets.  Raises StudyError if anywidget is not installed (the extra `notebook`).
        """
        from .animation.widget import widget

        return widget(document(self.beside))

    def save(self, out: str | os.PathLike[str]) -> Path:
        """Writes the animation in the format that the ending says; it appears whole or not at all.

        Raises StudyError if the ending says none, or it cannot be written."""
        path = Path(out)
        kind = ending(path, ANIMATIONS, "an animation")
        require(kind)
        if not path.parent.is_dir():
            raise StudyError(f"{path}: cannot be written: there is no folder {path.parent}")
        with appearing(path) as temporary:
            if kind == "html":
                temporary.write_text(self.html(), encoding="utf-8")
            else:
                from .animation.video import write

                write(self.beside, temporary, kind)
        return path

    def _repr_html_(self) -> str:
        """The page in a frame of its own."""
        from html import escape

        return (
            f'<iframe srcdoc="{escape(self.html())}" style="width: 100%; height: 720px; border: 0"></iframe>'
        )


def animate(
    scene: HasData,
    run: str | None = None,
    show: str | Iterable[str] = USUAL,
    trace: str | Iterable[str] = (),
    theme: str | None = None,
) -> Animation:
    """Runs a scene (one of its [runs]; default: the first): see Scene.animate."""
    shows = shows_of(show, trace, theme)
    try:
        return Animation(Beside(record(scene, run), shows))
    except SceneError as error:
        raise error.at(file=scene.data.file) from None
