"""Animate a run: a film (.mp4, .gif) or the explorer's page (.html). Spots on the balls make their spin visible."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from carom.errors import CaromError, FaultList
from carom.explorer.player import player_page
from carom.files import atomic_path, import_optional, install_command, require_library, require_writable, write_text
from carom.plot.scene_view import last_time
from carom.plot.style import style
from carom.plot.video import Film
from carom.simulation.trajectory import Trajectory

__all__ = ["FASTEST_GIF", "MOST_FRAMES", "WIDE", "animate", "ffmpeg", "write_gif", "write_mp4"]

Progress = Callable[[int, int], None]
KINDS = (".mp4", ".gif", ".html")
# Width in pixels. A GIF stores every pixel that changes, so it is smaller than a film.
WIDE = {".mp4": 1280, ".gif": 800}
# The highest frame rate at which browsers play a GIF.
FASTEST_GIF = 50
MOST_FRAMES = 100_000


class Frames(Protocol):
    """Frames of a film, in pixels."""

    times: Any
    size: tuple[int, int]

    def frame(self, n: int) -> Any:
        """Return the n-th frame, (high, wide, 4) bytes."""

    def frames(self, tell: Progress) -> Iterator[Any]:
        """Yield all frames in order."""


def animate(
    run: Trajectory,
    path: str | os.PathLike[str],
    *,
    fps: float = 30,
    speed: float = 1.0,
    start: float = 0.0,
    end: float | None = None,
    progress: Progress | None = None,
) -> Path:
    """Write an animation of a run, by the name's ending: a film (.mp4, .gif), or a self-contained page (.html).

    The page is the explorer with this run: see :func:`carom.explore`. One of more than 2,000 events or 100 balls, or under a law of
    your own, is recorded in it.

    Parameters
    ----------
    run : Trajectory
        From :func:`carom.simulate`.
    path : str or path
        File to write, .mp4, .gif or .html; it is written atomically.
    fps : float
        Frames per second of a film; a page is drawn at the refresh rate of the screen.
    speed : float
        Playback speed: 0.1 is ten times slower than real time. It can be changed on a page.
    start, end : float
        s. Default: the whole run.
    progress : callable(done, total), optional
        Called after each frame of a film.

    Returns
    -------
    pathlib.Path
        The file written.

    Raises
    ------
    CaromError
        For times outside the run, another ending, a missing library (Matplotlib; for .mp4 also ffmpeg), or a file that cannot
        be written.

    Examples
    --------
    >>> import carom, tempfile
    >>> from carom import plot
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0))
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
    >>> run = carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(law="mirror", duration=2)))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     plot.animate(run, f"{folder}/run.html").name
    'run.html'
    """
    path = Path(path)
    require_writable(path, KINDS)
    kind = path.suffix.lower()
    span = _checked(run, kind, fps, speed, start, end)
    tell = progress or (lambda _done, _total: None)
    if kind == ".html":
        tell(0, 1)
        text = player_page(run, *span, float(speed))
        write_text(path, text)
        tell(1, 1)
        return path
    require_library("matplotlib", "animate")
    count = max(2, 1 + math.floor((span[1] - span[0]) * fps / speed + 1e-9))
    if count > MOST_FRAMES:
        raise CaromError(
            f"animate: expected at most {MOST_FRAMES} frames, got {count}; take a shorter time, or a greater speed"
        )
    program = ffmpeg() if kind == ".mp4" else ""
    times = np.minimum(span[0] + np.arange(count) * speed / fps, span[1])
    with style():
        write_film(Film(run, times, span, WIDE[kind]), path, program, fps, tell)
    return path


def write_film(film: Any, path: Path, program: str, fps: float, tell: Callable[[int, int], None]) -> None:
    """Write frames to a film, .mp4 (by ``program``, :func:`ffmpeg`) or .gif, whole or not at all."""
    with atomic_path(path) as part:
        if path.suffix.lower() == ".mp4":
            write_mp4(film, part, program, fps, tell)
        else:
            write_gif(film, part, fps, tell)


def _checked(run: Trajectory, kind: str, fps: Any, speed: Any, start: Any, end: Any) -> tuple[float, float]:
    """Return start and end; CaromError with all problems."""
    faults, last = FaultList("animate"), last_time(run)
    fastest = FASTEST_GIF if kind == ".gif" else 1000
    if not (_is_number(fps) and 0 < fps <= fastest):
        faults.add("fps", f"a number above 0, at most {fastest}", repr(fps))
    if not (_is_number(speed) and 0 < speed < math.inf):
        faults.add("speed", "a number above 0", repr(speed))
    end = last if end is None else end
    if not (_is_number(start) and 0 <= start < last):
        faults.add("start", f"a time from 0 to before {last:.9g} s, the end of the run", repr(start))
    elif not (_is_number(end) and start < end <= max(last, run.end)):
        faults.add("end", f"a time after {start:.9g} s, at most {last:.9g} s, the end of the run", repr(end))
    faults.raise_if_any()
    return float(start), float(end)


def _is_number(x: Any) -> bool:
    return isinstance(x, (int, float, np.integer, np.floating)) and not isinstance(x, bool)


def ffmpeg() -> str:
    """Return the program that writes .mp4: the system's ffmpeg, or the ffmpeg of the package imageio-ffmpeg."""
    found = shutil.which("ffmpeg")
    if found is None:
        try:
            found = str(import_optional("imageio_ffmpeg", "ffmpeg").get_ffmpeg_exe())
        except (ImportError, RuntimeError):
            raise CaromError(
                "animate: .mp4: expected the program ffmpeg, found none; write .gif or .html, or run:"
                f" {install_command('film')}"
            ) from None
    return found


def write_mp4(film: Frames, path: Path, program: str, fps: float, tell: Progress) -> None:
    """Write a film by ffmpeg."""
    wide, high = film.size
    # frames are sent through a pipe: Matplotlib's own writer would redraw the whole figure for each of them
    command = [
        program, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{wide}x{high}", "-r", f"{fps:.9g}",
        "-i", "-", "-an", "-pix_fmt", "yuv420p", "-movflags", "+faststart", str(path),
    ]  # fmt: skip
    with tempfile.TemporaryFile() as said, subprocess.Popen(command, stdin=subprocess.PIPE, stderr=said) as process:
        assert process.stdin is not None
        try:
            for frame in film.frames(tell):
                process.stdin.write(frame.tobytes())
            process.stdin.close()
            code = process.wait()
        except BrokenPipeError:
            code = process.wait() or 1
        except BaseException:
            process.kill()
            raise
        if code:
            said.seek(0)
            words = " ".join(said.read().decode(errors="replace").split())
            raise CaromError(
                f"animate: .mp4: expected ffmpeg to write the film, got: {words[-300:]}; write .gif or .html instead"
            )


def write_gif(film: Frames, path: Path, fps: float, tell: Progress) -> None:
    """Write a film as GIF."""
    from PIL import Image

    # one palette for all frames, so that colours do not flicker; it is taken from a frame in the middle, which has all colours
    palette = Image.fromarray(film.frame(len(film.times) // 2)).convert("RGB").quantize(96)

    def pictures() -> Iterator[Any]:
        for frame in film.frames(tell):
            yield Image.fromarray(frame).convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE)

    # a GIF has a time resolution of 10 ms: frame ends are rounded to it, so that errors do not accumulate
    ends = np.round(np.arange(1, len(film.times) + 1) * 100 / fps).astype(int)
    durations = (10 * np.diff(ends, prepend=0)).tolist()
    images = pictures()
    with path.open("wb") as file:
        next(images).save(
            file, format="GIF", save_all=True, append_images=images, duration=durations, loop=0, disposal=1
        )
