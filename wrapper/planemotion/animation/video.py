"""Frames of a motion for GIF and MP4: the picture of `pictures` with what is shown beside it.

Axes, ground, title, energies and the time axis are drawn once; each frame adds what moves, with its names as
far from it as at first.  A view that follows a far motion has new paper for each frame.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..pen import page
from ..pen.names import LINE, Name
from ..pen.page import IMPULSE, SOFT
from ..pen.sketch import Sketch
from ..pen.symbols import Pen, Place
from ..pen.theme import recolour
from ..pictures.scene import SceneDrawing, title_of
from .beside import Beside
from .document import note_of
from .drawn import draw_above, draw_below
from .film import write_gif, write_mp4
from .margin import Energies, TimeAxis, margins
from .moving import Motion, Room

_RATE = 20  # frames per second
_MOST = 480  # frames
_RESOLUTION = 100  # dots per inch
_NAME = 8.5  # size of names, in points
# Frames from which the colours of a GIF are taken: over the run, and at its first events.
_SPREAD, _EVENTS = 6, 4

Frame = npt.NDArray[np.uint8]


def write(beside: Beside, path: Path, kind: str) -> None:
    """Writes the frames as `kind`, gif or mp4.  Raises OSError if the file cannot be written."""
    film = Film(beside)
    if kind == "gif":
        write_gif(path, film.samples(), film, _RATE)
    else:
        write_mp4(path, film, _RATE)


class Film:
    """The frames [height, width, 3] of a motion: _RATE for each second of a viewer, or `most` at most."""

    def __init__(self, beside: Beside, most: int | None = None) -> None:
        self.beside = beside
        self.times, self.speed = beside.timing.frames(_RATE, most or _MOST)
        self.paper = _Paper(beside, self.speed, beside.room_at(0.0))

    def __iter__(self) -> Iterator[Frame]:
        return map(self.frame, self.times)

    def frame(self, time: float) -> Frame:
        """The picture at a time."""
        if self.beside.motion.follows:
            offsets = self.paper.offsets
            return _Paper(self.beside, self.speed, self.beside.room_at(time), offsets).frame(time)
        return self.paper.frame(time)

    def samples(self) -> list[Frame]:
        """Frames that have all colours: some of the run, and of its events."""
        spread = self.times[np.linspace(0, len(self.times) - 1, _SPREAD).astype(int)]
        return [self.frame(float(time)) for time in (*spread, *self.beside.timing.events[:_EVENTS])]


# From what has a name to the lower left of its text, and to where the line leaves that, if there is one.
Offset: TypeAlias = tuple[Place, Place | None]
_Key: TypeAlias = tuple[str, str, bool]  # text, colour, bold: what tells a name from others in all frames


class _SameSketch(Sketch):
    """A sketch of other poses on the same paper."""

    def __init__(self, first: Sketch, motion: Motion, time: float) -> None:
        self._first = first
        room = (first.low, first.high)
        super().__init__(first.drawing, motion.poses_at(time), first.unit, room, motion.known_at(time))

    def canvas(self) -> tuple[Figure, Pen]:
        self.low, self.high = self._first.low, self._first.high
        pen = self._first.pen
        return self._first.figure, Pen(pen.axes, pen.canvas, pen.inch)


class _Paper:
    """What stays from frame to frame.  `room`: what is seen; `offsets`: of names, None: as fits the start."""

    def __init__(
        self, beside: Beside, speed: float, room: Room, offsets: dict[_Key, Offset] | None = None
    ) -> None:
        self.beside = beside
        self.theme = beside.shows.theme or "light"
        motion = beside.motion
        with page.style(self.theme):
            self.sketch = Sketch(motion.drawing, motion.poses(0), motion.unit, room)
            figure = self.sketch.figure
            figure.set_dpi(_RESOLUTION)
            self.offsets = self._name_offsets() if offsets is None else offsets
            SceneDrawing(motion.data, self.sketch).draw_ground()
            self._write_names(self.sketch.pen)
            self._write_margins(figure, speed)
            page.head(figure, title_of(motion.data), "")
            self._begin(figure)

    def _write_margins(self, figure: Figure, speed: float) -> None:
        """The energies, the time axis, and the line below the title."""
        axes = self.sketch.pen.axes
        energies, below = margins(figure, axes, self.beside)
        self.moving: list[Energies | TimeAxis] = [*([energies] if energies else []), below]
        width, height = figure.get_size_inches()
        y = 1 - 0.37 / height
        self.clock = figure.text(0.12 / width, y, "", va="top", color=SOFT, size=8.5)
        self.what = figure.text(
            1 - 0.12 / width, y, "", va="top", ha="right", color=IMPULSE, size=8.5, weight="bold"
        )
        slower = "slow" in self.beside.shows.words and self.beside.events
        slow = ", slower at events" if slower else ""
        as_it_is = 0.99 < speed < 1.01
        times = "" if as_it_is and not slow else f", {speed:.3g} times as fast as it is{slow}"
        self.note = f"{note_of(self.beside.motion)}; t = %.{_decimals(self.beside.timing.end)}f s{times}"

    def _begin(self, figure: Figure) -> None:
        """Draws what stays."""
        moving = [self.clock, self.what, *(artist for part in self.moving for artist in part.artists)]
        if self.theme == "dark":
            for artist in figure.findobj():
                recolour(artist)
        for artist in moving:
            artist.set_animated(True)
        self.canvas = FigureCanvasAgg(figure)
        self.canvas.draw()
        self.background = self.canvas.copy_from_bbox(figure.bbox)

    def frame(self, time: float) -> Frame:
        """The picture [height, width, 3] at a time."""
        axes, figure, beside = self.sketch.pen.axes, self.sketch.figure, self.beside
        before = set(axes.get_children())
        with page.style(self.theme):
            sketch = _SameSketch(self.sketch, beside.motion, time)
            draw_below(sketch, beside, time)
            SceneDrawing(beside.motion.data, sketch).draw_moving()
            self._write_names(sketch.pen)
            draw_above(sketch, beside, time)
            self.canvas.restore_region(self.background)
            self._ink([artist for artist in axes.get_children() if artist not in before])
            self.clock.set_text(self.note % time)
            seen = beside.timing.fresh(time)
            self.what.set_text(beside.events[seen[0]][1] if seen else "")
            for part in self.moving:
                part.move(time)
            for artist in (self.clock, self.what, *(one for part in self.moving for one in part.artists)):
                figure.draw_artist(artist)
        return np.asarray(self.canvas.buffer_rgba())[:, :, :3].copy()

    def _ink(self, artists: Iterable[Artist]) -> None:
        """Draws what is new on the axes, and takes it off again."""
        for artist in sorted(artists, key=lambda one: one.get_zorder()):
            if self.theme == "dark":
                recolour(artist)
            self.sketch.pen.axes.draw_artist(artist)
            artist.remove()

    def _write_names(self, pen: Pen) -> None:
        """The names of a pen, each as far from what it names as at the start."""
        for name in pen.names:
            (dx, dy), line = self.offsets.get(_key(name), ((0.0, 0.0), None))
            weight = "bold" if name.bold else "normal"
            place = (name.place[0] + dx, name.place[1] + dy)
            if line is not None:
                x, y = name.place
                ends = (x, x + line[0]), (y, y + line[1])
                pen.axes.plot(*ends, color=name.colour, linewidth=LINE, zorder=7.5)
            pen.axes.text(
                *place, name.text, color=name.colour, size=_NAME, weight=weight, zorder=8, clip_on=True
            )

    def _name_offsets(self) -> dict[_Key, Offset]:
        """How far each name stands from what it names, at the start; the names are taken off again."""
        axes, motion = self.sketch.pen.axes, self.beside.motion
        before = set(axes.get_children())
        first = _SameSketch(self.sketch, motion, 0.0)
        SceneDrawing(motion.data, first).draw()
        offsets: dict[_Key, Offset] = {}
        for one in first.pen.write_names():
            x, y = one.name.place
            line = None if one.line is None else (one.line[0] - x, one.line[1] - y)
            offsets[_key(one.name)] = (one.at[0] - x, one.at[1] - y), line
        for artist in axes.get_children():
            if artist not in before:
                artist.remove()
        return offsets


def _key(name: Name) -> _Key:
    return name.text, name.colour, name.bold


def _decimals(end: float) -> int:
    """Of times of a run that takes so long."""
    return max(0, 3 - int(np.floor(np.log10(end or 1.0))))
