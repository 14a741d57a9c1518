"""Frames of a motion as GIF and MP4: the picture of `pictures`, drawn at even times."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.backends.backend_agg import FigureCanvasAgg

from ..pen import page
from ..pen.sketch import Sketch
from ..pictures.scene import SceneDrawing, plane_of, title_of
from .moving import Motion

_RATE = 20  # frames per second
# Seconds of a viewer: a run between the first two is shown as fast as it is, others in the last.
_SHORTEST, _LONGEST, _USUAL = 3.0, 12.0, 6.0
_MOST = 240  # frames
_RESOLUTION = 100  # dots per inch
_COLOURS = 128  # of a GIF

Frame = npt.NDArray[np.uint8]


def write(motion: Motion, path: Path, kind: str) -> None:
    """Writes the frames as `kind`, gif or mp4.  Raises OSError if the file cannot be written."""
    (_write_gif if kind == "gif" else _write_mp4)(path, frames(motion))


def frames(motion: Motion, most: int | None = None) -> Iterator[Frame]:
    """The frames [height, width, 3], _RATE of them for each second of a viewer, or so many at most."""
    end = float(motion.recorded.time[-1])
    seconds = end if _SHORTEST <= end <= _LONGEST else _USUAL
    speed = end / seconds
    for time in np.linspace(0.0, end, min(max(2, round(seconds * _RATE)), most or _MOST)):
        yield _frame(motion, float(time), speed)


def _frame(motion: Motion, time: float, speed: float) -> Frame:
    with page.style():
        sketch = Sketch(motion.drawing, motion.poses_at(time), motion.unit, motion.room)
        SceneDrawing(motion.data, sketch).draw()
        slow = "" if 0.99 < speed < 1.01 else f", {speed:.2g} times as fast as it is"
        page.head(sketch.figure, title_of(motion.data), f"{plane_of(motion.data)}; t = {time:.3f} s{slow}")
        sketch.figure.set_dpi(_RESOLUTION)
        canvas = FigureCanvasAgg(sketch.figure)
        canvas.draw()
    return np.asarray(canvas.buffer_rgba())[:, :, :3].copy()


def _write_gif(path: Path, shown: Iterator[Frame]) -> None:
    from PIL import Image

    images = [Image.fromarray(frame).quantize(_COLOURS) for frame in shown]
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
