# SPDX-License-Identifier: BSD-3-Clause
"""Movies of runs, by the animation writers of Matplotlib."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _files, _motion, pictures
from ._lib import lib
from ._values import number
from .progress import Line, stream
from .typing import Array, Progress, Scalar

if TYPE_CHECKING:
    from .run import Run

MOST = 100_000  # largest number of frames
MOST_PIXELS = 8192  # largest width and height
TICK = 100  # [Hz] the time between two frames of a GIF is a multiple of 1/TICK


def write(
    run: Run,
    motion: _motion.Motion,
    path: str | os.PathLike[str],
    fps: Scalar,
    speed: Scalar,
    size: Any,
    progress: Progress,
) -> None:
    suffix = Path(path).suffix.lower()
    if suffix not in (".mp4", ".gif"):
        raise ValueError(f"{os.fspath(path)!r}: a name that ends in .mp4 or .gif is wanted")
    rate = _positive(fps, "fps")
    if suffix == ".gif":
        rate = TICK / max(round(TICK / rate), 2)
    times = _times(motion.t, _positive(speed, "speed") / rate)
    writer = _writer(suffix, rate)
    whole, samples = _motion.refined(motion, run, times)
    out = stream() if progress is True else None
    line = None if out is None else Line(out, f"movie of {len(times)} frames")
    try:
        with _files.part(path) as part:
            _draw(whole, samples, writer, part, pictures.pixels(size, MOST_PIXELS), line, progress)
    finally:
        if line is not None:
            line.close()


def _positive(value: Scalar, label: str) -> float:
    given = number(value, label)
    if not 1e-9 <= given <= 1e9:
        raise ValueError(f"{label}: a number from 1e-9 to 1e9 is wanted, not {given:g}")
    return given


def _times(t: Array, step: float) -> Array:
    """Return the times of the frames."""
    low, high = min(t[0], t[-1]), max(t[0], t[-1])
    count = int((high - low) / step * (1 + 1e-9)) + 1
    if count > MOST:
        raise ValueError(f"the movie would have {count} frames; give a larger speed")
    times: Array = np.minimum(low + step * np.arange(count), high)
    return times


def _writer(suffix: str, rate: Any) -> Any:
    """Make a writer of Matplotlib. The type hints of Matplotlib demand an int for the frame rate,
    although a float is allowed."""
    pictures.import_matplotlib("Run.movie()")
    from matplotlib import animation

    if suffix == ".gif":
        return animation.PillowWriter(fps=rate * (1 - 1e-9))  # Pillow rounds the delay down
    if not animation.FFMpegWriter.isAvailable():
        raise RuntimeError(
            "Run.movie() of .mp4 needs the program ffmpeg, which was not found: install it, name "
            'it in matplotlib.rcParams["animation.ffmpeg_path"], or write a .gif'
        )
    return animation.FFMpegWriter(fps=rate, codec="h264")


def _draw(
    motion: _motion.Motion,
    samples: list[int],
    writer: Any,
    path: str | os.PathLike[str],
    size: Array,
    line: Line | None,
    progress: Progress,
) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=tuple(size / pictures.INCH), facecolor="white")
    with writer.saving(figure, os.fspath(path), dpi=pictures.INCH):
        for k, sample in enumerate(samples):
            pictures.draw(motion.print(lib.baum_page_svg, sample), figure)
            writer.grab_frame()
            if line is not None:
                line.update((k + 1) / len(samples))
            elif callable(progress):
                progress(float(motion.t[sample]))
