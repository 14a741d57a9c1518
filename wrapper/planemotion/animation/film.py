"""Frames become a file, one after the other: none is kept."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from PIL.Image import Image

Frame = npt.NDArray[np.uint8]

# Of a GIF: 2**_BITS, the last of which is no colour but lets what was there before stay.
_BITS = 6
_CLEAR = 2**_BITS - 1
_LOOP = b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00"  # again and again
_END = b"\x3b"
_SAME = 10  # of 255: colours that differ less in each channel are one
_HOLD = 1000  # ms for which the last frame stays


def write_gif(path: Path, samples: Sequence[Frame], frames: Iterable[Frame], rate: int) -> None:
    """Writes a GIF of `rate` frames per second whose colours are those of the samples.

    With one palette what stands still has the same numbers in all frames: only what changed is stored."""
    palette = _palette(samples)
    with path.open("wb") as file:
        shown = before = None
        for frame in frames:
            if shown is not None:
                before = _write_image(file, shown, before, 1000 // rate)
            else:
                _write_head(file, frame, palette)
            shown = _numbers(frame, palette)
        if shown is not None:
            _write_image(file, shown, before, _HOLD)
        file.write(_END)


def _palette(samples: Sequence[Frame]) -> Image:
    """The commonest colours that are not nearly the same: those of the drawing, and mixtures at edges."""
    from PIL import Image

    dots = np.concatenate([sample.reshape(-1, 3) for sample in samples]).astype(np.int32)
    codes, counts = np.unique(dots @ (65536, 256, 1), return_counts=True)
    common = codes[np.argsort(-counts, kind="stable")]
    colours = np.stack([common >> 16, common >> 8 & 255, common & 255], axis=1)
    chosen: list[npt.NDArray[np.int32]] = []
    while len(colours) and len(chosen) < _CLEAR:
        chosen.append(colours[0])
        colours = colours[np.abs(colours - colours[0]).max(axis=1) > _SAME]
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.array(chosen, np.uint8).tobytes())
    return palette


def _numbers(frame: Frame, palette: Image) -> Frame:
    """The number of each dot's colour."""
    from PIL import Image

    return np.asarray(Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE))


def _write_head(file: BinaryIO, frame: Frame, palette: Image) -> None:
    height, width = frame.shape[:2]
    colours = bytes(palette.getpalette() or [])[: 3 * _CLEAR].ljust(3 * 2**_BITS, b"\0")
    file.write(b"GIF89a" + struct.pack("<HHBBB", width, height, 0x80 | 0x70 | (_BITS - 1), 0, 0))
    file.write(colours + _LOOP)


def _write_image(file: BinaryIO, shown: Frame, before: Frame | None, ms: int) -> Frame:
    """What changed since the image before, which is all at first; the image that is seen then."""
    from PIL import Image
    from PIL.GifImagePlugin import getdata

    left, top, part = 0, 0, shown
    if before is not None:
        changed = shown != before
        rows, columns = (np.flatnonzero(changed.any(axis=axis)) for axis in (1, 0))
        top, bottom = (rows[0], rows[-1] + 1) if len(rows) else (0, 1)
        left, right = (columns[0], columns[-1] + 1) if len(columns) else (0, 1)
        part = np.where(changed, shown, np.uint8(_CLEAR))[top:bottom, left:right]
    image: Any = Image.fromarray(np.ascontiguousarray(part))
    for block in getdata(image, (int(left), int(top)), duration=ms, transparency=_CLEAR, disposal=1):
        file.write(block)
    return shown


def write_mp4(path: Path, frames: Iterable[Frame], rate: int) -> None:
    """Writes an MP4 of `rate` frames per second."""
    import imageio_ffmpeg

    writer = None
    for frame in frames:
        even = np.ascontiguousarray(frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2])
        if writer is None:
            size = (even.shape[1], even.shape[0])
            writer = imageio_ffmpeg.write_frames(
                str(path), size, fps=rate, macro_block_size=2, output_params=["-f", "mp4"]
            )
            writer.send(None)
        writer.send(even)
    if writer is not None:
        writer.close()
