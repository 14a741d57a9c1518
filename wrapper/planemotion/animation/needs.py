"""What an animation in some form needs beside the package itself."""

from __future__ import annotations

from importlib.util import find_spec

from ..base.errors import StudyError

# Form -> module, its name where it is installed from, the extra that brings it, what there is without.
_NEEDED = {
    "mp4": ("imageio_ffmpeg", "imageio-ffmpeg", "video", ".html needs nothing"),
    "gif": ("PIL", "pillow", "video", ".html needs nothing"),
    "widget": ("anywidget", "anywidget", "notebook", "without it a notebook shows the player in a frame"),
}
_FORMS = {"widget": "the player as a widget of a notebook"}


def require(form: str) -> None:
    """Raises StudyError, which says what to install, if a form cannot be had here."""
    if form not in _NEEDED:
        return
    module, name, extra, without = _NEEDED[form]
    if find_spec(module) is None:
        what = _FORMS.get(form, f"an animation as .{form}")
        raise StudyError(f'{what} needs {name}: pip install "planemotion[{extra}]"; {without}')
