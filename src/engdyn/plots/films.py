"""Animations as files: GIF by Pillow, a page that plays by itself, MP4 where there is ffmpeg."""

from __future__ import annotations

import base64
import contextlib
import html
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from importlib import resources
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from engdyn.errors import EngdynError

if TYPE_CHECKING:
    from engdyn.plots.animation import Animation

__all__ = ["save"]

COLORS = 128
"""Colors of a GIF and of the pictures in a page: drawings have few, their edges are smoothed."""

ALIKE = 12
"""Colors closer than this in red, green and blue are one."""

UNSEEN = 1.0
"""Seconds of work that need no sign of progress."""


def save(animation: Animation, path: Path, ends: NDArray[np.float64], overwrite: bool = False) -> Path:
    """Write an animation to a file, see :meth:`engdyn.plots.animation.Animation.save`.

    Parameters
    ----------
    animation : Animation
    path : Path
        Its ending says which kind of file.
    ends : ndarray, shape (N + 1,)
        When each frame of the film ends [s], beginning with 0.
    overwrite : bool
        Replace a file that exists.

    Notes
    -----
    Nothing is left half-written: the file appears when it is complete.
    """
    writers: dict[str, Callable[..., bytes]] = {".gif": _gif, ".html": _page, ".mp4": _mp4}
    writer = writers.get(path.suffix.lower())
    if writer is None:
        raise EngdynError(f"{path.name}: an animation is saved as .gif, .html or .mp4; name the file so.")
    folder = path.absolute().parent
    if not folder.is_dir():
        raise EngdynError(f"the folder {folder} does not exist: make it, or write elsewhere.")
    if path.is_dir() or (path.exists() and not overwrite):
        raise EngdynError(f"{path} exists and was not touched: name another file, or give overwrite=True.")
    content = writer(animation, ends, path.name)
    with tempfile.TemporaryDirectory(prefix=".film-", dir=folder) as scratch:
        complete = Path(scratch) / path.name
        complete.write_bytes(content)
        os.replace(complete, path)
    return path


def _frames(animation: Animation, name: str) -> Iterator[Image.Image]:
    """Yield all frames; tell how far it got, but only a person who watches a terminal and has to wait."""
    begun, watched = time.monotonic(), sys.stderr.isatty()
    for k in range(len(animation)):
        if watched and time.monotonic() - begun > UNSEEN:
            print(f"\r{name}: frame {k + 1} of {len(animation)}", end="", file=sys.stderr, flush=True)
        yield Image.fromarray(animation.frame(k))
    if watched and time.monotonic() - begun > UNSEEN:
        print(f"\r{name}: {len(animation)} frames. ", file=sys.stderr)


def _indexed(animation: Animation, name: str) -> Iterator[Image.Image]:
    """Yield all frames with one palette."""
    palette = Image.new("P", (1, 1))
    for k, frame in enumerate(_frames(animation, name)):
        if k == 0:
            palette.putpalette(_palette(frame))
        yield frame.quantize(palette=palette, dither=Image.Dither.NONE)


def _palette(picture: Image.Image) -> list[int]:
    """Return the most frequent colors of a picture that can be told apart: paper stays white.

    Pillow looks colors up by their six higher bits, so of two close ones it might take the wrong one.
    """
    colors = sorted(picture.getcolors(picture.width * picture.height), reverse=True)
    chosen = np.array([colors[0][1]], int)
    for _, color in colors:
        if len(chosen) < COLORS and np.min(np.max(abs(chosen - color), axis=1)) >= ALIKE:
            chosen = np.vstack([chosen, [color]])
    return [int(part) for part in chosen.ravel()]


def _gif(animation: Animation, ends: NDArray[np.float64], name: str) -> bytes:
    # A GIF counts in hundredths of a second; rounding when frames end keeps the whole film in time.
    durations = [10 * int(steps) for steps in np.diff(np.round(100.0 * ends))]
    first, *others = _indexed(animation, name)
    stream = io.BytesIO()
    first.save(
        stream,
        "gif",
        save_all=True,
        append_images=others,
        duration=durations,
        loop=0,
        comment=animation.words.encode("utf-8"),
    )
    return stream.getvalue()


def _page(animation: Animation, ends: NDArray[np.float64], name: str) -> bytes:
    pictures = []
    for frame in _indexed(animation, name):
        stream = io.BytesIO()
        frame.save(stream, "png")
        pictures.append(base64.b64encode(stream.getvalue()).decode("ascii"))
    template = Template(resources.files("engdyn.plots").joinpath("film.html").read_text("utf-8"))
    width, height = frame.size
    page = template.substitute(
        title=html.escape(f"{animation.system.title} in motion"),
        words=html.escape(animation.words),
        first=pictures[0],
        width=width,
        height=height,
        last=len(pictures) - 1,
        # No "<" can occur in these, so they cannot end the script.
        pictures=json.dumps(pictures),
        ends=json.dumps(ends.tolist()),
        times=json.dumps([round(float(t), 9) for t in animation.time]),
    )
    return page.encode("utf-8")


def _mp4(animation: Animation, ends: NDArray[np.float64], name: str) -> bytes:
    program = shutil.which("ffmpeg")
    if program is None:
        raise EngdynError(
            f"{name}: MP4 needs the program ffmpeg, which was not found. Install it (on Debian: apt install ffmpeg), "
            "or save the animation as .html or .gif, which need nothing."
        )
    height, width, _ = animation.frame(0).shape
    pace = f"{len(animation) / ends[-1]:.9g}"
    source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-framerate", pace, "-i", "-"]
    # Most players want even numbers of pixels and this format.
    even = ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p"]
    plain = ["-an", "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"]
    with tempfile.TemporaryDirectory(prefix="film-") as scratch:
        target, complaints = Path(scratch) / "film.mp4", Path(scratch) / "complaints"
        with complaints.open("wb") as told:
            process = subprocess.Popen(
                [program, "-v", "error", "-y", *source, *even, *plain, str(target)],
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=told,
            )
            try:
                # A broken pipe: ffmpeg gave up; what it says follows.
                with contextlib.suppress(BrokenPipeError), process.stdin as pipe:
                    for frame in _frames(animation, name):
                        pipe.write(frame.tobytes())
            except BaseException:
                process.kill()
                raise
            finally:
                process.wait()
        if process.returncode != 0 or not target.is_file():
            raise EngdynError(
                f"{name}: ffmpeg could not write it: {complaints.read_text('utf-8', 'replace').strip()}"
            )
        return target.read_bytes()
