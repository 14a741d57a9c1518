"""A scene, a study or the result of a sweep as a report: one page of HTML that needs nothing else."""

from __future__ import annotations

import os
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .animation.beside import Beside
from .animation.document import document
from .animation.moving import record
from .base.checksums import require_sound
from .base.errors import PlanemotionError, SceneError, SimulationError, StudyError
from .base.files import REPORTS, appearing, ending
from .base.themes import THEMES
from .engine.history import is_history
from .file import load, load_text
from .pen import page as pen
from .pen.theme import on_paper
from .pictures.condensed import evenly
from .pictures.panels import drawn_dims, open_sweep
from .pictures.scene import figure, start_of
from .report import explain as explanations
from .run import simulate
from .sweep.run import run_sweep
from .sweep.verify import is_result
from .webpage.document import Replay, Slider, Told, scene_document, study_document
from .webpage.needs import require
from .webpage.outcomes import case_values
from .webpage.page import page

if TYPE_CHECKING:
    import xarray as xr

    from .scene import Scene

# Cases of a study that are replayed; along two parameters so many in all.
REPLAYS = 9


@dataclass(frozen=True)
class Report:
    """A report: a notebook shows it, `save` writes it; `html` is the page.

    `fault`: why the run, or cases of the sweep, did not end well; "" where all did."""

    html: str
    fault: str = ""

    def save(self, out: str | os.PathLike[str]) -> Path:
        """Writes the page; it appears whole or not at all.  Raises StudyError if it cannot be written."""
        path = Path(out)
        ending(path, REPORTS, "a report")
        if not path.parent.is_dir():
            raise StudyError(f"{path}: cannot be written: there is no folder {path.parent}")
        with appearing(path) as temporary:
            temporary.write_text(self.html, encoding="utf-8")
        return path

    def _repr_html_(self) -> str:
        """The page in a frame of its own."""
        from html import escape

        return f'<iframe srcdoc="{escape(self.html)}" style="width: 100%; height: 900px; border: 0"></iframe>'


def report(scene: Scene, replays: int = REPLAYS) -> Report:
    """Runs a scene, or all cases of its [sweep], and tells of it: see Scene.report."""
    require("jinja2", *(["plotly"] if scene.data.sweep.grids else []))
    if scene.data.sweep.grids:
        return _of_sweep(scene, run_sweep(scene), replays)
    result = simulate(scene)
    explained = explanations.explain(scene).text + explanations.explain_run(scene, result)
    told = _told(scene, explained, [_replay(scene, (), "")])
    return Report(page(scene_document(told, result)), result.error)


def report_of(path: Path, values: dict[str, Any], replays: int = REPLAYS) -> Report:
    """Of the file of a scene or a study, with other values for some parameters, or of the result of a sweep.

    Raises StudyError for a file that is neither or is damaged, SceneError for a fault in the scene."""
    if not is_result(path):
        return report(load(path).with_values(values), replays)
    if values:
        raise StudyError(f"{path}: a result has the values that it was computed with; none can be set")
    require("jinja2", "plotly")
    require_sound(path)
    if is_history(path):
        raise StudyError(
            f"{path}: is a recorded history; report wants a scene, a study or the .h5 of a sweep"
        )
    with open_sweep(path) as dataset:
        return _of_sweep(load_text(str(dataset.attrs["scene"]), file=f"{path}: scene"), dataset, replays)


def _of_sweep(scene: Scene, dataset: xr.Dataset, most: int) -> Report:
    sliders, places = _chosen(dataset, most)
    replays = []
    for place, case in places:
        values = case_values(dataset, case)
        words = ", ".join(f"{name} = {_short(text)}" for name, text in values.items())
        replays.append(_replay(scene.with_values(values), place, words))
    told = _told(scene, explanations.explain(scene).text, replays, sliders)
    bad = int(np.count_nonzero(dataset["status"].values))
    fault = f"{scene.id}: {bad} of {dataset['status'].size} cases did not end well" if bad else ""
    return Report(page(study_document(told, dataset)), fault)


def _chosen(
    dataset: xr.Dataset, most: int
) -> tuple[list[Slider], list[tuple[tuple[int, ...], dict[Any, int]]]]:
    """Sliders along the parameters that the plots show, and at most so many cases in all: where each is on
    the sliders, and where in the dataset (of further parameters at their first value)."""
    dims = drawn_dims(dataset)
    along = max(1, round(most ** (1 / len(dims))))
    index = {dim: evenly(dataset.sizes[dim], along).tolist() for dim in dims}
    held = dict.fromkeys((str(dim) for dim in dataset["status"].dims), 0)
    sliders = [
        Slider(dim, [case_values(dataset, {**held, dim: i}).get(dim, str(i + 1)) for i in index[dim]])
        for dim in dims
    ]
    places = [
        (place, {**held, **{dim: index[dim][at] for dim, at in zip(dims, place, strict=True)}})
        for place in product(*(range(len(index[dim])) for dim in dims))
    ]
    return sliders, places


def _short(text: str) -> str:
    """A quantity as it was written, with no more digits than one reads."""
    number, _, unit = text.partition(" ")
    try:
        return f"{float(number):.6g} {unit}".rstrip()
    except ValueError:
        return text


def _replay(scene: Scene, place: Sequence[int], words: str) -> Replay:
    """A case in motion; one that cannot be recorded says why."""
    try:
        return Replay(place, words, document(Beside(record(scene))))
    except (SceneError, SimulationError) as error:
        return Replay(place, words, fault=str(error))


def _told(scene: Scene, explained: str, replays: Sequence[Replay], sliders: Sequence[Slider] = ()) -> Told:
    pictures = {theme: _picture(scene, theme) for theme in THEMES}
    return Told(scene.data, scene.text, pictures, explained, replays, sliders)


def _picture(scene: Scene, theme: str) -> str:
    """The start as an SVG in base64; "" where it cannot be drawn."""
    made = BytesIO()
    try:
        with pen.style(theme):
            on_paper(figure(start_of(scene, None)), theme).savefig(made, format="svg")
    except PlanemotionError:
        return ""
    return b64encode(made.getvalue()).decode("ascii")
