"""Results as pictures: the file of a sweep, of a map of outcomes or of a recorded run becomes a picture.

Everything is drawn with matplotlib's Agg canvas alone: no window, no global state.
"""

from __future__ import annotations

import os
from pathlib import Path

from ..base.checksums import require_sound
from ..base.themes import require_theme
from ..engine.history import is_history
from ..engine.history import read as read_history
from ..maps.file import is_map
from ..maps.file import read as read_map
from ..pen.page import save, style
from ..pen.theme import on_paper
from .history import plot_history
from .outcome_map import plot_outcome_map
from .panels import open_sweep
from .sweep import plot_sweep


def plot(
    result: str | os.PathLike[str], out: str | os.PathLike[str] | None = None, theme: str = "light"
) -> Path:
    """Draws the HDF5 file of a sweep, a map or a history; returns the path of the picture, PNG, SVG or PDF by
    its ending (default: a PNG beside it), on "light" or "dark" paper.

    Raises StudyError if `result` is none of them, the ending says no format, or the picture cannot be
    written; nothing half-written stays.
    """
    source = Path(result)
    target = source.with_suffix(".png") if out is None else Path(out)
    is_zarr = source.suffix == ".zarr"
    if not is_zarr:
        require_sound(source)
    require_theme(theme)
    with style(theme):
        if is_zarr:
            with open_sweep(source) as dataset:
                figure = plot_sweep(dataset)
        elif is_history(source):
            runs, attributes = read_history(source)
            figure = plot_history(runs, str(attributes.get("title") or attributes.get("id") or "History"))
        elif is_map(source):
            figure = plot_outcome_map(read_map(source))
        else:
            with open_sweep(source) as dataset:
                figure = plot_sweep(dataset)
        save(on_paper(figure, theme), target)
    return target
