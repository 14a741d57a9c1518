"""The themes of pictures: ink on light or on dark paper."""

from __future__ import annotations

from .errors import StudyError

THEMES = ("light", "dark")


def require_theme(theme: str) -> None:
    """Raises StudyError for a theme that there is not."""
    if theme not in THEMES:
        raise StudyError(f'theme = "{theme}": {" or ".join(THEMES)} is wanted')
