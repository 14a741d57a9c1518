"""Names on crowded pictures: none covers another one, and each can be told from what it names."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

import planemotion
from planemotion.pen import page
from planemotion.pen.names import LINE
from planemotion.pen.symbols import Pen, Place
from planemotion.pictures import scene as pictures
from tests import ROOT

DPI = 100
# Pixels of 100 to an inch: what boxes of letters may overlap by, and what ends of a line may be apart by.
SLIVER = 0.5
# Pixels (28 are 20 points): nearer to its place a name needs no line, farther away it does, and between the
# two where another place is nearer.
NEAR, FAR = 15, 28.5


def written(names: list[tuple[Place, str]]) -> tuple[Figure, Any]:
    """A picture of 6 by 5 inches with names of points [in]."""
    figure = Figure(figsize=(6, 5), dpi=DPI)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, 6)
    axes.set_ylim(0, 5)
    pen = Pen(axes, canvas, 1.0)
    for at, text in names:
        pen.dot(at)
        pen.name(at, text)
    pen.write_names()
    return figure, axes


def boxes_of(figure: Figure, found: list[Text]) -> list[Any]:
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    return [text.get_window_extent(renderer).padded(-SLIVER) for text in found]


def lines_of(axes: Any) -> list[np.ndarray]:
    """The thin lines that lead to places: both ends [2, 2] in pixels."""
    return [
        axes.transData.transform(line.get_xydata())
        for line in axes.get_lines()
        if line.get_linewidth() == LINE
    ]


def crosses(box: Any, line: np.ndarray) -> bool:
    return any(box.contains(*(line[0] + share * (line[1] - line[0]))) for share in np.linspace(0, 1, 101))


@pytest.mark.parametrize("seed", range(12))
def test_names_of_a_crowd(seed: int) -> None:
    """Twenty names of places in a square of an inch and a half: together a quarter of it and more."""
    rng = np.random.default_rng(seed)
    places: list[Place] = []
    while len(places) < 20:
        x, y = rng.uniform((2.2, 1.8), (3.7, 3.3))
        if all(math.dist((x, y), other) > 0.08 for other in places):
            places.append((float(x), float(y)))
    names = [(at, "n" * int(rng.integers(1, 9)) + str(i)) for i, at in enumerate(places)]
    figure, axes = written(names)
    boxes = boxes_of(figure, list(axes.texts))
    shown = {text.get_text(): box for text, box in zip(axes.texts, boxes, strict=True)}
    assert set(shown) == {text for _, text in names}
    for one, other in combinations(boxes, 2):
        assert not one.overlaps(other)
    lines = lines_of(axes)
    for line in lines:
        assert sum(crosses(box, line) for box in boxes) == 0
    spots = {text: axes.transData.transform(at) for at, text in names}
    for name, box in shown.items():
        ways = {other: _way(box, spot) for other, spot in spots.items()}
        has_line = any(
            math.dist(line[1], spots[name]) < SLIVER and _way(box, line[0]) < 2 * SLIVER + 1 for line in lines
        )
        is_beside = ways[name] < NEAR or (ways[name] < FAR and min(ways.values()) > 0.75 * ways[name])
        assert has_line or is_beside, (name, ways)


def _way(box: Any, place: np.ndarray) -> float:
    """How far a place is from a box."""
    return math.hypot(
        max(box.x0 - place[0], 0, place[0] - box.x1), max(box.y0 - place[1], 0, place[1] - box.y1)
    )


@pytest.mark.parametrize("study", ["gear_train", "cam_and_follower", "falling_chain"])
def test_names_of_crowded_studies(study: str) -> None:
    with page.style():
        start = pictures.start_of(planemotion.load(ROOT / f"studies/{study}.toml"))
        figure = pictures.figure(start)
    [axes] = figure.axes
    boxes = boxes_of(figure, list(axes.texts))
    for one, other in combinations(boxes, 2):
        assert not one.overlaps(other)
    for line in lines_of(axes):
        assert not any(crosses(box, line) for box in boxes)


def test_numbers_below_a_narrow_picture_keep_apart() -> None:
    with page.style():
        figure = pictures.figure(pictures.start_of(planemotion.load(ROOT / "studies/gear_train.toml")))
    figure.canvas.draw()
    labels = [label for label in figure.axes[0].get_xticklabels() if label.get_text()]
    boxes = boxes_of(figure, labels)
    assert len(boxes) >= 3
    for one, other in combinations(boxes, 2):
        assert not one.padded(3).overlaps(other)


@pytest.mark.parametrize("dots", [100, 160])
@pytest.mark.parametrize("width", [2.0, 4.2, 6.7, 9.0])
def test_a_long_title_is_neither_cut_nor_too_small(dots: int, width: float) -> None:
    """On the 100 dots of an animation it left the paper; on a narrow picture it had letters of 4 points."""
    figure = Figure(figsize=(width, 3), dpi=dots)
    canvas = FigureCanvasAgg(figure)
    long = "A hinged rod that hangs on a torsion spring in the equilibrium of both and is then let go there"
    page.head(figure, long, "vertical plane; at the start")
    title, note = figure.texts
    assert title.get_window_extent(canvas.get_renderer()).x1 <= width * dots  # type: ignore[no-untyped-call]
    assert float(title.get_fontsize()) >= 6.5
    assert title.get_text() == long or title.get_text().endswith(" ...")
    assert (width < 6) == title.get_text().endswith(" ...")
    assert note.get_text() == "vertical plane; at the start"
