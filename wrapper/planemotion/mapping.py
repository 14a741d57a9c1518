"""A map of outcomes over two parameters: what `Scene.map` gives."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from .base.html import html_table
from .base.themes import require_theme
from .maps import file
from .maps.run import make_map
from .pen import page
from .pen.theme import on_paper
from .pictures.outcome_map import plot_outcome_map
from .pictures.picture import Picture

if TYPE_CHECKING:
    import xarray as xr

    from .reading.scene import WrittenScene


@dataclass(frozen=True, repr=False)
class OutcomeMap:
    """Which outcome a study has over two parameters, and the boundaries between them.

    `dataset`: all of it; what stands in it says maps/run.py.  A notebook shows the picture.
    """

    dataset: xr.Dataset

    @property
    def outcomes(self) -> dict[str, float]:
        """The outcomes in words, with their parts of the area of the map."""
        names, shares = self.dataset["outcome"].values, self.dataset["share"].values
        return {str(name): float(share) for name, share in zip(names, shares, strict=True)}

    @property
    def cases(self) -> int:
        """How many runs it took."""
        return int(self.dataset.attrs["cases"])

    def draw(self, theme: str = "light") -> Picture:
        """Its picture, on "light" or "dark" paper."""
        require_theme(theme)
        with page.style(theme):
            return Picture(on_paper(plot_outcome_map(self.dataset), theme), "", theme)

    def save(self, out: str | os.PathLike[str]) -> Path:
        """Writes it as HDF5 (.h5, .nc), or its picture as PNG, SVG or PDF, by the ending.

        Raises StudyError if it cannot be written."""
        path = Path(out)
        if path.suffix not in (".h5", ".nc"):
            return self.draw().save(path)
        file.write(self.dataset, path)
        return path

    def _rows(self) -> list[tuple[str, str]]:
        parts = sorted(self.outcomes.items(), key=lambda one: -one[1])
        return [("outcome", "part of the area"), *((name, f"{share:.4g}") for name, share in parts)]

    def _line(self) -> str:
        curves = self.dataset.sizes["curve"]
        return f"OutcomeMap {self.dataset.attrs['id']}: {self.cases} cases, {curves} boundaries"

    def __repr__(self) -> str:
        return "\n".join([self._line(), *(f"  {name}  {share}" for name, share in self._rows())])

    def _repr_html_(self) -> str:
        return html_table(self._line(), self._rows())

    def _repr_png_(self) -> bytes:
        return self.draw()._repr_png_()


def outcome_map(
    scene: WrittenScene, workers: int | None = None, progress: Callable[[int], None] | None = None
) -> OutcomeMap:
    """The map of a study: see Scene.map."""
    return OutcomeMap(make_map(scene, workers=workers, **({"progress": progress} if progress else {})))
