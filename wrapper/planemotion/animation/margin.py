"""Beside and below the scene in a frame: energies over time with their values, the time axis with events."""

from __future__ import annotations

from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..pen.page import BLUE, EDGE, ENERGIES, HEAD_HEIGHT, IMPULSE, SOFT
from .beside import Beside

_BESIDE, _BELOW = 2.5, 0.62  # inches that the energies and the time axis have
_LINE = 0.19  # of a line of text, inches
_PLOT = (0.8, 1.8)  # height of the plot of the energies, inches, at least and at most
_SMALL = 8.0  # size of texts, points
_CROWD = 0.25  # inches: events that are closer to each other on the whole are strokes without names
_APART = 8  # dots between two names


def margins(figure: Figure, scene: Axes, beside: Beside) -> tuple[Energies | None, TimeAxis]:
    """Makes room around the scene and draws there what stays."""
    shows = "energies" in beside.shows.words and bool(beside.energies)
    _make_room(figure, scene, _BESIDE if shows else 0.0, _BELOW)
    return Energies(figure, beside) if shows else None, TimeAxis(figure, beside)


def _make_room(figure: Figure, scene: Axes, right: float, below: float) -> None:
    """Makes the paper larger; the scene stays as large as it is, at the upper left."""
    width, height = figure.get_size_inches()
    box = scene.get_position()
    figure.set_size_inches(width + right, height + below)
    across, up = width / (width + right), height / (height + below)
    lift = below / (height + below)
    scene.set_position((box.x0 * across, box.y0 * up + lift, box.width * across, box.height * up))


class Energies:
    """Kinetic, potential and total energy: curves over the whole run, and their values at a time."""

    def __init__(self, figure: Figure, beside: Beside) -> None:
        self.beside = beside
        width, height = figure.get_size_inches()
        top, lines = HEAD_HEIGHT + 0.12, len(beside.energies) + 1
        tall = min(max(height - top - _BELOW - _LINE * lines, _PLOT[0]), _PLOT[1])
        left, low = width - _BESIDE + 0.62, height - top - tall
        axes = figure.add_axes((left / width, low / height, (_BESIDE - 0.62 - 0.15) / width, tall / height))
        axes.set_title("Energies [J]", size=_SMALL)
        axes.tick_params(labelsize=7, labelbottom=False, length=0)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
        axes.set_xlim(0.0, beside.timing.end or 1.0)
        self.range = self._curves(axes)
        self.now = axes.axvline(0.0, color=SOFT, linewidth=0.8)
        self.dots = {
            kind: axes.plot([], [], "o", color=ENERGIES[kind], markersize=4)[0] for kind in beside.energies
        }
        self.values = {}
        for i, kind in enumerate(beside.energies, start=1):
            y = (low - 0.05 - _LINE * i) / height
            figure.text(left / width, y, f"● {kind}", color=ENERGIES[kind], size=_SMALL)
            self.values[kind] = figure.text(1 - 0.15 / width, y, "", ha="right", size=_SMALL)

    def _curves(self, axes: Axes) -> float:
        """Draws the curves; how far they go in all, J."""
        times = self.beside.motion.recorded.time
        for kind, values in self.beside.energies.items():
            axes.plot(times, values, color=ENERGIES[kind], linewidth=1.1)
        low, high = axes.dataLim.intervaly
        if not high - low > 1e-6 * max(abs(high), abs(low)):
            axes.set_ylim(low - 1, high + 1)
        return float(high - low)

    @property
    def artists(self) -> list[Artist]:
        return [self.now, *self.dots.values(), *self.values.values()]

    def move(self, time: float) -> None:
        """To a time."""
        self.now.set_xdata([time, time])
        for kind, values in self.beside.energies.items():
            value = self.beside.motion.value_at(values, time)
            self.dots[kind].set_data([time], [value])
            self.values[kind].set_text(f"{0.0 if abs(value) < 1e-6 * self.range else value:.4g}")


class TimeAxis:
    """The time of the whole run with its events by name, and how far it is."""

    def __init__(self, figure: Figure, beside: Beside) -> None:
        width, height = figure.get_size_inches()
        end = beside.timing.end or 1.0
        axes = figure.add_axes((0.35 / width, 0.3 / height, 1 - 0.7 / width, 0.22 / height))
        axes.set_xlim(0.0, end)
        axes.set_ylim(0.0, 1.0)
        axes.set_yticks([])
        axes.grid(False)
        axes.patch.set_visible(False)
        axes.spines["left"].set_visible(False)
        axes.spines["bottom"].set(linewidth=3.0, edgecolor=EDGE, capstyle="round")
        axes.tick_params(labelsize=7, length=2, pad=3)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=max(3, int(width / 0.9))))
        figure.text(1 - 0.12 / width, 0.3 / height, "s", ha="right", va="center", color=SOFT, size=7)
        self._events(figure, axes, beside)
        look: dict[str, Any] = {"color": BLUE, "clip_on": False, "zorder": 6}
        (self.gone,) = axes.plot([0.0], [0.0], linewidth=3.0, **look)
        (self.here,) = axes.plot([0.0], [0.0], "o", markersize=7, **look)

    def _events(self, figure: Figure, axes: Axes, beside: Beside) -> None:
        times = beside.timing.events
        if len(times) > float(figure.get_figwidth()) / _CROWD:
            axes.plot(times, 0.45 + 0 * times, "|", color=IMPULSE, markersize=5, clip_on=False)
            return
        axes.plot(times, 0.5 + 0 * times, "v", color=IMPULSE, markersize=4.5, clip_on=False)
        free, canvas = float("-inf"), FigureCanvasAgg(figure)
        for time, (_, name) in zip(times, beside.events, strict=True):
            text = axes.text(time, 0.85, name, color=IMPULSE, size=7, ha="center", clip_on=False)
            box = text.get_window_extent(canvas.get_renderer())
            if box.x0 < free or box.x0 < 0 or box.x1 > figure.bbox.x1:
                text.remove()
            else:
                free = box.x1 + _APART

    @property
    def artists(self) -> list[Artist]:
        return [self.gone, self.here]

    def move(self, time: float) -> None:
        """To a time."""
        self.gone.set_data([0.0, time], [0.0, 0.0])
        self.here.set_data([time], [0.0])
