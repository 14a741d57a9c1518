"""The look of all pictures: colours, style, title, and how they are saved."""

from __future__ import annotations

from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.textpath import TextPath

from ..base.errors import StudyError
from ..base.files import PICTURES, appearing, ending
from .theme import themed

INK = "#222222"
SOFT = "#6b6b6b"
BLUE = "#1f4e79"
RED = "#b5362b"
VELOCITY, IMPULSE, TRACE, EDGE = "#2f6fb0", "#a02c6f", "#8a9bab", "#d9dde1"  # of what moves, as in the player
ENERGIES = {"kinetic": "#c8741a", "potential": "#3b7d5e", "total": BLUE}
# A picture of one scene is the same file each time it is drawn.
_WITHOUT_DATE: dict[str, Any] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
RESOLUTION = 160  # dots per inch
# A family of curves or the parts of a vector: well apart for the colour-blind, too.
CURVES = (BLUE, "#c8741a", "#2f8a4f", "#9440d8", "#bfb0de", "#7a1010", "#52cb8c", "#d978ec")
STYLE: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": SOFT,
    "axes.formatter.useoffset": False,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.6,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 9.0,
    "axes.titleweight": "bold",
    "font.size": 9.0,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "lines.linewidth": 1.4,
    "svg.hashsalt": "planemotion",
    "text.color": INK,
    "text.parse_math": False,  # names and units as written
    "xtick.color": SOFT,
    "xtick.labelcolor": INK,
    "ytick.color": SOFT,
    "ytick.labelcolor": INK,
}
# A parameter of at most so many values makes a family of curves instead of the second axis of a map.
FAMILY = 6
_LEAST = 6.5  # points: smaller letters cannot be read
_ON_DOTS = 1.06  # times as wide may a line be on 100 dots to an inch
ROW_HEIGHT = 1.75  # inches
_PAD = 0.09  # inches between panels
HEAD_HEIGHT = 0.62  # inches above the panels for title and subtitle


def style(theme: str = "light") -> AbstractContextManager[None]:
    """The look of all pictures, for the time of a `with` block; `theme`: one of THEMES."""
    return matplotlib.rc_context(themed(STYLE, theme))


def save(figure: Figure, path: Path) -> None:
    """Writes the picture in the format that its ending says; it appears whole or not at all.

    Raises StudyError if the ending says none, or it cannot be written.
    """
    kind = ending(path, PICTURES, "a picture")
    if not path.parent.is_dir():
        raise StudyError(f"{path}: cannot be written: there is no folder {path.parent}")
    FigureCanvasAgg(figure)
    with appearing(path) as temporary:
        figure.savefig(temporary, format=kind, dpi=RESOLUTION, metadata=_WITHOUT_DATE.get(kind))


def _fitting(text: str, most: float, width: float) -> tuple[str, float]:
    """A bold line that is no wider than that [in], and the size of its letters in points, at most `most`.

    Letters get smaller as far as they can be read; then the last words are left out.
    """
    kept = text
    while _width(kept, _LEAST) > width and " " in text:
        text = text.rpartition(" ")[0]
        kept = f"{text} ..."
    needed = _width(kept, most)
    return kept, most * min(1.0, width / needed) if needed else most


def _width(text: str, size: float) -> float:
    """Of a bold line, in inches; on few dots letters are wider than drawn."""
    bold = FontProperties(weight="bold", size=size)
    return _ON_DOTS * TextPath((0, 0), text, prop=bold).get_extents().width / 72 if text else 0.0


def head(figure: Figure, title: str, subtitle: str) -> None:
    """Title and subtitle at the upper left, with room kept for them."""
    height, width = figure.get_figheight(), figure.get_figwidth()
    lines = ((title, 11.0), (subtitle, 8.5))
    (title, size), (subtitle, small) = (_fitting(text, most, width - 0.24) for text, most in lines)
    figure.text(0.12 / width, 1 - 0.12 / height, title, va="top", weight="bold", size=size)
    figure.text(0.12 / width, 1 - 0.37 / height, subtitle, va="top", color=SOFT, size=small)
    engine = figure.get_layout_engine()
    if isinstance(engine, ConstrainedLayoutEngine):
        engine.set(rect=(0, 0, 1, 1 - HEAD_HEIGHT / height), w_pad=_PAD, h_pad=_PAD)
