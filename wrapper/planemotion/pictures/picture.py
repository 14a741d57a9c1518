"""A picture that is shown in a notebook, or saved."""

from __future__ import annotations

import os
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from ..pen import page

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, repr=False)
class Picture:
    """A picture: a notebook shows it, `save` writes it; `figure` is that of matplotlib.

    `fault`: why the scene is drawn only as it is written; "" if it could be assembled.
    """

    figure: Figure
    fault: str = ""
    theme: str = "light"

    def __repr__(self) -> str:
        wide, tall = self.figure.get_size_inches()
        return f"Picture, {wide:.1f} x {tall:.1f} in" + (f" - {self.fault}" if self.fault else "")

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
