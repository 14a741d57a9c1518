"""Rigid bodies in plane motion: energy and momentum methods, impacts, sweeps.

    import planemotion

    planemotion.load("studies/sphere_over_bars.toml").run(d="2 in").omega_B

Names are imported when they are first used, so that the command line starts at once.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .animate import Animation
    from .base.errors import PlanemotionError, SceneError, SimulationError, StudyError
    from .engine.answer import AskValue
    from .engine.result import RunResult
    from .engine.words import words
    from .file import load, load_text
    from .fmu import export_fmu
    from .mapping import OutcomeMap
    from .pictures.picture import Picture
    from .reporting import Report
    from .scene import Scene
    from .sweep.frames import cases, statistics

__all__ = [
    "Animation",
    "AskValue",
    "OutcomeMap",
    "Picture",
    "PlanemotionError",
    "Report",
    "RunResult",
    "Scene",
    "SceneError",
    "SimulationError",
    "StudyError",
    "__version__",
    "cases",
    "export_fmu",
    "load",
    "load_text",
    "statistics",
    "words",
]

_HOME = {
    "Animation": "animate",
    "AskValue": "engine.answer",
    "OutcomeMap": "mapping",
    "Picture": "pictures.picture",
    "PlanemotionError": "base.errors",
    "Report": "reporting",
    "RunResult": "engine.result",
    "Scene": "scene",
    "SceneError": "base.errors",
    "SimulationError": "base.errors",
    "StudyError": "base.errors",
    "cases": "sweep.frames",
    "export_fmu": "fmu",
    "load": "file",
    "load_text": "file",
    "statistics": "sweep.frames",
    "words": "engine.words",
}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import PackageNotFoundError, version

        try:
            return version("planemotion")
        except PackageNotFoundError:
            return "0+unknown"
    if name in _HOME:
        return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
