"""Moving pictures as files: GIF with Pillow, MP4 with FFmpeg."""

from __future__ import annotations

import io
from itertools import chain, pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.base.outputs import as_a_whole
from beardyn_core.record.run import Run
from beardyn_core.study.animation import SUBJECTS
from beardyn_core.study.animation.crossing_picture import crossing_picture
from beardyn_core.study.animation.load_zone_picture import load_zone_picture
from beardyn_core.study.animation.moving_figure import MovingFigure
from beardyn_core.study.animation.spall_passages import ring_spalls

PICTURES = dict(zip(SUBJECTS, (load_zone_picture, crossing_picture), strict=True))
SECONDS = 5.0
GIF_RATE, MP4_RATE = 12.5, 30  # frames a second; a GIF counts in hundredths of a second
COLOURS = 63  # of a GIF, and one that shows the frame before
_SAMPLED = 8  # frames from which the colours of a GIF are chosen
_MP4_QUALITY = 7.0  # of 10


def usual_subject(run: Run) -> str:
    """Choose what to show: ``crossing`` where a ring has a spall, else ``load_zone``."""
    return "crossing" if ring_spalls(run.described()) else "load_zone"


def moving_picture(run: Run, of: str | None = None, at: float | None = None) -> MovingFigure:
    """Draw a moving picture of a recording.

    Parameters
    ----------
    run : Run
    of : str, optional
        ``load_zone`` or ``crossing``; by default that of `usual_subject`.
    at : float, optional
        Simulated time from which on, [s].

    Raises
    ------
    InputError
        The recording does not hold what is to be shown.
    """
    return PICTURES[of or usual_subject(run)](run, at, SECONDS)


def write_gif(picture: MovingFigure, path: Path, *, replace: bool = True) -> int:
    """Write a GIF that goes on for ever; give its number of frames.

    Raises
    ------
    InputError
        The file is there, and `replace` is not set.
    """
    count = round(SECONDS * GIF_RATE)
    images = [Image.fromarray(frame) for frame in picture.frames(count)]
    palette = _common_palette(images)
    shown = [np.asarray(image.quantize(palette=palette, dither=Image.Dither.NONE)) for image in images]
    changes = [shown[0], *(np.where(new == old, COLOURS, new) for old, new in pairwise(shown))]
    small = [_in_palette(each, palette) for each in changes]
    held = io.BytesIO()
    small[0].save(
        held, format="GIF", save_all=True, append_images=small[1:], duration=round(1000 / GIF_RATE), loop=0,
        optimize=False, transparency=COLOURS, disposal=1,
    )  # fmt: skip
    with as_a_whole(path, replace=replace) as fresh:
        try:
            fresh.write_bytes(held.getvalue())
        except OSError as error:
            raise InputError(_unwritten(path, error.strerror)) from error
    return count


def _in_palette(index: NDArray[np.uint8], palette: Image.Image) -> Image.Image:
    """Make an image of palette numbers; number `COLOURS` is what shows the frame before."""
    image = Image.fromarray(index.astype(np.uint8), "P")
    image.putpalette([*(palette.getpalette() or [])[: 3 * COLOURS], 255, 255, 255])
    return image


def _common_palette(images: list[Image.Image]) -> Image.Image:
    """Choose the colours of all frames at once, so that what stands still stays the same."""
    some = images[:: max(len(images) // _SAMPLED, 1)]
    sheet = Image.new("RGB", (some[0].width, len(some) * some[0].height))
    for number, image in enumerate(some):
        sheet.paste(image, (0, number * image.height))
    return sheet.quantize(COLOURS, Image.Quantize.MEDIANCUT)


def write_mp4(picture: MovingFigure, path: Path, *, replace: bool = True) -> int:
    """Write an MP4 file (H.264) that every browser plays; give its number of frames.

    Raises
    ------
    InputError
        `imageio-ffmpeg` is not installed, the file is there and `replace` is not set, or FFmpeg failed.
    """
    ffmpeg = library("imageio_ffmpeg", "an MP4 file", "mp4")
    count = round(SECONDS * MP4_RATE)
    frames = picture.frames(count)
    first = next(frames)
    height, width = first.shape[:2]
    with as_a_whole(path, replace=replace) as fresh:
        writer = ffmpeg.write_frames(
            str(fresh), (width, height), fps=MP4_RATE, codec="libx264", pix_fmt_out="yuv420p",
            quality=_MP4_QUALITY, macro_block_size=2, output_params=["-f", "mp4", "-movflags", "+faststart"],
        )  # fmt: skip
        try:
            writer.send(None)
            for frame in chain([first], frames):
                writer.send(np.ascontiguousarray(frame))
            writer.close()
            written, _ = ffmpeg.count_frames_and_secs(str(fresh))
        except (OSError, RuntimeError) as error:  # of a pipe to a program that has ended, or of no film
            raise InputError(_unwritten(path, "FFmpeg ended early")) from error
        finally:
            writer.close()
        if written != count:
            raise InputError(_unwritten(path, f"{written} of {count} frames are in it"))
    return count


def _unwritten(path: Path, reason: str | None) -> str:
    return f"{path}: cannot be written ({reason}); is the disk full? Free space, or choose another disk"
