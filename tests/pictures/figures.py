"""What pictures show, read back from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.collections import Collection
from matplotlib.figure import Figure
from matplotlib.text import Text


def texts(figure: Figure) -> str:
    return " | ".join(item.get_text() for item in figure.findobj(Text) if isinstance(item, Text))


def values_of(drawn: Collection) -> np.ma.MaskedArray[Any, Any]:
    """What a map of colours shows, with what is left out masked."""
    return np.ma.asarray(drawn.get_array())


def png_size(path: Path) -> tuple[int, int]:
    head = path.read_bytes()[:24]
    assert head.startswith(b"\x89PNG\r\n\x1a\n")
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")
