"""Colours of ink that all pictures share, and their resolution."""

from __future__ import annotations

INK = "#222222"
SOFT = "#6b6b6b"
BLUE = "#1f4e79"
RED = "#b5362b"
RESOLUTION = 160  # dots per inch
