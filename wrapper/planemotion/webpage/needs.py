"""What a report needs beside the package itself."""

from __future__ import annotations

from importlib.util import find_spec

from ..base.errors import StudyError


def require(*modules: str) -> None:
    """Raises StudyError, which says what to install, if one of the modules is not there."""
    missing = [module for module in modules if find_spec(module) is None]
    if missing:
        raise StudyError(f'a report needs {" and ".join(missing)}: pip install "planemotion[report]"')
