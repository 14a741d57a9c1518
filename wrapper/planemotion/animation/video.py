"""Frames of a motion as GIF and MP4: the picture of `pictures`, drawn at even times.

Axes, ground and title are drawn once; each frame adds what moves, with its names as far from it as at first.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..pen import page
from ..pen.page import SOFT
from ..pen.sketch import Sketch
from ..pen.symbols import Pen, Place
from ..pictures.scene import SceneDrawing, plane_of, title_of
from .moving import Motion

_RATE = 20  # frames per second
# Seconds of a viewer: a run between the first two is shown as fast as it is, others in the last.
_SHORTEST, _LONGEST, _USUAL = 3.0, 12.0, 6.0
_MOST = 240  # frames
_RESOLUTION = 100  # dots per inch
_COLOURS = 64  # of a GIF
_NAME = 8.5  # size of names, in points

Frame = npt.NDArray[np.uint8]


def write(motion: Motion, path: Path, kind: str) -> None:
    """Writes the frames as `kind`, gif or mp4.  Raises OSError if the file cannot be written."""
    (_write_gif if kind == "gif" else _write_mp4)(path, frames(motion))


def frames(motion: Motion, most: int | None = None) -> Iterator[Frame]:
    """The frames [height, width, 3], _RATE of them for each second of a viewer, or so many at most."""
    end = float(motion.recorded.time[-1])
    seconds = end if _SHORTEST <= end <= _LONGEST else _USUAL
    paper = _Paper(motion, end / seconds)
    for time in np.linspace(0.0, end, min(max(2, round(seconds * _RATE)), most or _MOST)):
        yield paper.frame(float(time))


class _SameSketch(Sketch):
    """A sketch of other poses on the same paper."""

    def __init__(self, first: Sketch, poses: dict[str, tuple[float, float, float]]) -> None:
        self._first = first
        super().__init__(first.drawing, poses, first.unit, (first.low, first.high))

    def canvas(self) -> tuple[Figure, Pen]:
        self.low, self.high = self._first.low, self._first.high
        pen = self._first.pen
        return self._first.figure, Pen(pen.axes, pen.canvas, pen.inch)


class _Paper:
    """What stays from frame to frame."""

    def __init__(self, motion: Motion, speed: float) -> None:
        self.motion = motion
        self.slow = "" if 0.99 < speed < 1.01 else f", {speed:.2g} times as fast as it is"
        with page.style():
            self.sketch = Sketch(motion.drawing, motion.poses(0), motion.unit, motion.room)
            figure = self.sketch.figure
            figure.set_dpi(_RESOLUTION)
            self.offsets = self._name_offsets()
            SceneDrawing(motion.data, self.sketch).draw_ground()
            self._write_names(self.sketch.pen)
            page.head(figure, title_of(motion.data), "")
            width, height = figure.get_size_inches()
            self.clock = figure.text(
                0.12 / width, 1 - 0.37 / height, "", va="top", color=SOFT, size=8.5, animated=True
            )
            self.canvas = FigureCanvasAgg(figure)
            self.canvas.draw()
            self.background = self.canvas.copy_from_bbox(figure.bbox)

    def frame(self, time: float) -> Frame:
        """The picture [height, width, 3] at a time."""
        axes, figure = self.sketch.pen.axes, self.sketch.figure
        before = set(axes.get_children())
        with page.style():
            sketch = _SameSketch(self.sketch, self.motion.poses_at(time))
            SceneDrawing(self.motion.data, sketch).draw_moving()
            self._write_names(sketch.pen)
            self.canvas.restore_region(self.background)
            new = [artist for artist in axes.get_children() if artist not in before]
            for artist in sorted(new, key=lambda one: one.get_zorder()):
                axes.draw_artist(artist)
                artist.remove()
            self.clock.set_text(f"{plane_of(self.motion.data)}; t = {time:.3f} s{self.slow}")
            figure.draw_artist(self.clock)
        return np.asarray(self.canvas.buffer_rgba())[:, :, :3].copy()

    def _write_names(self, pen: Pen) -> None:
        """The names of a pen, each as far from what it names as at the start."""
        for name in pen.names:
            dx, dy = self.offsets.get(name.text, (0.0, 0.0))
            weight = "bold" if name.bold else "normal"
            place = (name.place[0] + dx, name.place[1] + dy)
            pen.axes.text(*place, name.text, color=name.colour, size=_NAME, weight=weight, zorder=8)

    def _name_offsets(self) -> dict[str, Place]:
        """How far each name stands from what it names, at the start; the names are taken off again."""
        axes = self.sketch.pen.axes
        before = set(axes.get_children())
        first = _SameSketch(self.sketch, self.motion.poses(0))
        SceneDrawing(self.motion.data, first).draw()
        places = {name.text: name.place for name in first.pen.names}
        first.pen.write_names()
        offsets = {}
        for text in axes.texts:
            x, y = text.get_position()
            at = places.get(text.get_text(), (x, y))
            offsets[text.get_text()] = (x - at[0], y - at[1])
        for artist in axes.get_children():
            if artist not in before:
                artist.remove()
        return offsets


def _write_gif(path: Path, shown: Iterator[Frame]) -> None:
    from PIL import Image

    pictures = [Image.fromarray(frame) for frame in shown]
    # With one palette what stands still has the same numbers in all frames, and is stored once.
    some = [pictures[i] for i in (0, len(pictures) // 2, -1)]
    palette = Image.fromarray(np.vstack([np.asarray(one) for one in some])).quantize(
        _COLOURS, Image.Quantize.MAXCOVERAGE
    )
    images = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in pictures]
    images[0].save(
        path, format="GIF", save_all=True, append_images=images[1:], duration=1000 // _RATE, loop=0
    )


def _write_mp4(path: Path, shown: Iterator[Frame]) -> None:
    import imageio_ffmpeg

    writer = None
    for frame in shown:
        even = np.ascontiguousarray(frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2])
        if writer is None:
            size = (even.shape[1], even.shape[0])
            writer = imageio_ffmpeg.write_frames(
                str(path), size, fps=_RATE, macro_block_size=2, output_params=["-f", "mp4"]
            )
            writer.send(None)
        writer.send(even)
    if writer is not None:
        writer.close()
