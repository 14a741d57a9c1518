"""What an animation in some format needs beside the package itself."""

from __future__ import annotations

from importlib.util import find_spec

from ..base.errors import StudyError

# Format -> module, what it is called where it is installed from, and the extra that brings it.
_NEEDED = {"mp4": ("imageio_ffmpeg", "imageio-ffmpeg"), "gif": ("PIL", "pillow")}


def require(kind: str) -> None:
    """Raises StudyError, which says what to install, if a format cannot be written here."""
    module, name = _NEEDED.get(kind, ("", ""))
    if module and find_spec(module) is None:
        raise StudyError(
            f'an animation as .{kind} needs {name}: pip install "planemotion[video]"; .html needs nothing'
        )
