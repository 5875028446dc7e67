"""Animate a run: a film (.mp4, .gif) or the explorer's page (.html). Spots on the balls make their spin visible."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import tempfile
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList
from carom.explorer.page import player_page
from carom.files import atomic_path, import_optional, install_command, require_library, require_writable, write_text
from carom.formatting import format_length
from carom.plot.style import GREY, INK, PALE, literal, style
from carom.plot.trajectory import colour, draw_walls, last_time, steps, view, way
from carom.simulation.records import MEETINGS, WALLS
from carom.simulation.trajectory import Trajectory

WORDS = {
    "flight": "in the air", "bouncing": "bouncing", "sliding": "sliding", "rolling": "rolling",
    "pivoting": "spinning on the spot", "rest": "at rest", "held": "held", "left": "gone", "pocketed": "in a pocket",
}  # fmt: skip

Array = NDArray[np.float64]
# Duration of the dark part of a trail, s.
TRAIL = 0.5
# Spots at the ends of three axes of the ball; the third axis has paler ones, to distinguish it from the others.
SPOTS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
SPOT, RIM = 0.36, np.linspace(0, 2 * math.pi, 28, endpoint=False)
DISC = np.stack([np.cos(np.linspace(0, 2 * math.pi, 56)), np.sin(np.linspace(0, 2 * math.pi, 56))], axis=1)
# The floor in a close-up, in radii of the ball.
GROUND = np.array([[-1.15, -1.06], [1.15, -1.06], [1.15, -1], [-1.15, -1]])


def _spots(q: Array, side: bool) -> Array:
    """Return outlines (6, 28, 3) of the spots on a unit ball rotated by q: across, up, towards the observer."""
    w, u = q[0], q[1:]
    t = 2 * np.cross(u, SPOTS)
    d = SPOTS + w * t + np.cross(u, t)
    if side:
        d = np.stack((d[:, 0], d[:, 2], -d[:, 1]), axis=1)
    helper = np.where(np.abs(d[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
    e = np.cross(helper, d)
    e /= np.linalg.norm(e, axis=1, keepdims=True)
    f = np.cross(d, e)
    c, s = math.sin(SPOT) * np.cos(RIM), math.sin(SPOT) * np.sin(RIM)
    rim: Array = math.cos(SPOT) * d[:, None] + c[None, :, None] * e[:, None] + s[None, :, None] * f[:, None]
    # the hidden part of a spot is projected on the rim of the ball
    far = np.hypot(rim[..., 0], rim[..., 1])[..., None]
    rim[..., :2] = np.where(rim[..., 2:] < 0, rim[..., :2] / np.where(far > 0, far, 1), rim[..., :2])
    return rim


class Frames(ABC):
    """Frames of a film, in pixels: what stands still is drawn once, what moves over it."""

    def __init__(self, figure: Any, times: Array, size: tuple[int, int]) -> None:
        """Draw what is in the figure by now; ``moving`` is filled after that."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        self.times, self.size = times, size
        self.axes = figure.axes[0]
        self.canvas = FigureCanvasAgg(figure)
        self.canvas.draw()
        self.background = self.canvas.copy_from_bbox(figure.bbox)
        self.moving: list[Any] = []

    @abstractmethod
    def move(self, n: int) -> None:
        """Bring what moves to the n-th frame."""

    def frame(self, n: int) -> Array:
        """Return the n-th frame, (high, wide, 4) bytes."""
        self.move(n)
        self.canvas.restore_region(self.background)
        for artist in self.moving:
            self.axes.draw_artist(artist)
        return np.asarray(self.canvas.buffer_rgba())

    def frames(self, tell: Callable[[int, int], None]) -> Iterator[Array]:
        """Yield all frames in order."""
        total = len(self.times)
        tell(0, total)
        for n in range(total):
            yield self.frame(n)
            tell(n + 1, total)


class Film(Frames):
    """Frames of a run: balls, trails and clock over the table."""

    def __init__(self, run: Trajectory, times: Array, span: tuple[float, float], wide: int) -> None:
        from matplotlib.collections import LineCollection, PolyCollection
        from matplotlib.figure import Figure

        self.run, self.times, self.span = run, times, span
        self.places, self.turned, self.phases = (
            np.asarray(run.at(times).position),
            run.orientation(times),
            run.phase(times),
        )
        self.radii = np.array([ball.radius for ball in run.scene.balls])
        ways = [way(run, i, span[1]) for i in range(len(self.radii))]
        self.trails = [
            (
                np.concatenate([[], *(t for _, t, _ in pieces)]),
                np.concatenate([np.zeros((0, 3)), *(x for *_, x in pieces)]),
            )
            for pieces in ways
        ]
        shown = view(run, np.concatenate([*(x for _t, x in self.trails), np.array(run.start.position)]))
        # pixels: the table at the left, close-ups at the right, energy below
        self.column = 0.2 * wide
        room = wide - self.column - 0.03 * wide
        self.k = min(room / shown.size[0], 0.5 * wide / shown.size[1])
        inside = max(self.k * shown.size[1], 0.3 * wide)
        self.lane = 0.075 * wide
        high = int(inside + self.lane + 0.065 * wide)
        self.size = (wide, high + high % 2)
        left, low = 0.015 * wide, self.lane + 0.045 * wide
        x, y = left + (room - self.k * shown.size[0]) / 2, low + (inside - self.k * shown.size[1]) / 2
        self.origin = np.array([x - self.k * shown.x[0], y - self.k * shown.y[0]])
        figure = Figure(figsize=(self.size[0] / 100, self.size[1] / 100), dpi=100)
        self.axes = figure.add_axes((0, 0, 1, 1))
        self.axes.set(xlim=(0, self.size[0]), ylim=(0, self.size[1]))
        self.axes.axis("off")
        self.points = wide / 112  # the size of small letters
        self._still(shown)
        super().__init__(figure, times, self.size)
        self.faint = LineCollection([], lw=wide / 1100, alpha=0.4)
        self.strong = LineCollection([], lw=wide / 600)
        self.balls = PolyCollection([], lw=0)
        (self.head,) = self.axes.plot([], [], color=INK, lw=wide / 800)
        self.said = [
            self.axes.text(x, y, "", fontsize=self.points, va="top", ha=ha) for x, y, ha in self._places_of_words()
        ]
        for one in (self.faint, self.strong, self.balls):
            self.axes.add_collection(one, autolim=False)
        self.moving = [self.faint, self.strong, self.balls, self.head, *self.said]

    def _place(self, x: Array) -> Array:
        """Return the pixels of positions (..., 3) on the table."""
        return np.asarray(self.origin + self.k * x[..., :2])

    def _still(self, shown: Any) -> None:
        wide = self.size[0]
        draw_walls(self.axes, self.run, shown, wide / 500, self._place)
        t = steps(self.run, self.span[1])
        t = t[t >= self.span[0]]
        energy = np.nansum(self.run.energy(t, each=True), axis=1)
        energy = energy - min(0.0, float(energy.min()))
        x0, across = 0.015 * wide, 0.97 * wide
        x = x0 + across * (t - self.span[0]) / (self.span[1] - self.span[0])
        y = 0.012 * wide + self.lane * energy / (float(energy.max()) or 1.0)
        self.axes.fill_between(x, 0.012 * wide, y, color=PALE, lw=0)
        self.axes.plot(x, y, color=GREY, lw=wide / 1000)
        met = np.unique(self.run.log["t"][np.isin(self.run.log["kind"], (*WALLS, *MEETINGS))])
        met = met[(met >= self.span[0]) & (met <= self.span[1])]
        if len(met) <= 200:
            at = x0 + across * (met - self.span[0]) / (self.span[1] - self.span[0])
            self.axes.vlines(at, 0.012 * wide, 0.012 * wide + self.lane, color=GREY, lw=0.5, alpha=0.6)
        self.axes.text(
            x0 + across, 0.016 * wide + self.lane, "energy of all balls", fontsize=self.points, ha="right", color=GREY
        )

    def _cards(self) -> list[tuple[int, float, float, float]]:
        """Return the close-ups: ball, centre (x, y) of the view from above, radius in pixels."""
        wide, high = self.size
        shown = min(len(self.radii), 4)
        tall = min((high - self.lane - 0.06 * wide) / shown, 0.135 * wide)
        r = min(0.3 * tall, 0.19 * self.column)
        x = wide - self.column - 0.01 * wide
        return [(i, x + 0.25 * self.column, high - 0.03 * wide - i * tall - 0.45 * tall, r) for i in range(shown)]

    def _places_of_words(self) -> list[tuple[float, float, str]]:
        """Return the positions of the texts: the clock, then one line per close-up."""
        wide = self.size[0]
        cards = [(x + 0.25 * self.column, y - 1.2 * r, "center") for _i, x, y, r in self._cards()]
        return [(0.015 * wide, 0.03 * wide + self.lane, "left"), *cards]

    def move(self, n: int) -> None:
        """Bring balls, trails and clock to the n-th frame."""
        t = float(self.times[n])
        places = self.places[n]
        there = np.flatnonzero(np.isfinite(places[:, 0]))
        faint, strong, inks = [], [], []
        for i in there:
            times, points = self.trails[i]
            past = np.searchsorted(times, t)
            first = np.searchsorted(times, self.span[0])
            line = np.append(points[first:past], places[i][None], axis=0)
            faint.append(self._place(line))
            strong.append(self._place(line[max(0, int(np.searchsorted(times[first:past], t - TRAIL)) - 1) :]))
            inks.append(colour(self.run, int(i)))
        self.faint.set(segments=faint, color=inks)
        self.strong.set(segments=strong, color=inks)
        shapes, faces = self._shapes(n, there)
        self.balls.set(verts=shapes, facecolors=faces)
        wide = self.size[0]
        x = 0.015 * wide + 0.97 * wide * (t - self.span[0]) / (self.span[1] - self.span[0])
        self.head.set_data([x, x], [0.012 * wide, 0.012 * wide + self.lane])
        self.said[0].set_text(f"{t:.2f} s")
        for text, (k, *_rest) in zip(self.said[1:], self._cards(), strict=True):
            lift = float(places[k, 2] - self.radii[k]) if self.run.scene.floor is not None else 0.0
            up = f", {format_length(lift, 2)} up" if lift > 1e-5 else ""
            text.set_text(f"{literal(self.run.scene.ball_names[k])}: {WORDS[str(self.phases[n][k])]}{up}")

    def _shapes(self, n: int, there: Any) -> tuple[list[Array], list[Any]]:
        """Return polygons and their colours: shadows, then balls from the lowest up, then the close-ups."""
        shapes: list[Array] = []
        faces: list[Any] = []

        def ball(i: int, at: Array, r: float, side: bool) -> None:
            from matplotlib.colors import to_rgba

            shapes.append(at + r * DISC)
            faces.append(to_rgba(colour(self.run, i)))
            for k, rim in enumerate(_spots(self.turned[n, i], side)):
                if (rim[:, 2] > 0).any():
                    shapes.append(at + r * rim[:, :2])
                    faces.append((1, 1, 1, 0.95 if k < 4 else 0.55))
            # a rim drawn over spots at the edge; and a highlight at the upper left
            shapes.append(at + r * np.concatenate((DISC, 0.93 * DISC[::-1])))
            faces.append(to_rgba(colour(self.run, i)))
            for size in (0.55, 0.36):
                shapes.append(at + r * np.array([-0.3, 0.3]) + size * r * DISC)
                faces.append((1, 1, 1, 0.09))

        places = self._place(self.places[n])
        if self.run.scene.floor is not None:
            for i in there:
                r, lift = self.k * self.radii[i], self.k * max(self.places[n, i, 2] - self.radii[i], 0.0)
                below = places[i] + np.array([0.16 * r + 0.7 * lift, -0.2 * r - 0.7 * lift])
                shapes += [below + soft * r * DISC for soft in (1.12, 1.0, 0.88)]
                faces += [(0, 0, 0, 0.11)] * 3
        for one in sorted(there.tolist(), key=lambda i: float(self.places[n, i, 2])):
            ball(one, places[one], max(self.k * self.radii[one], 2.0), False)
        for i, x, y, r in self._cards():
            if i not in there:
                continue
            ball(i, np.array([x, y]), r, False)
            lift = 0.0
            if self.run.scene.floor is not None:
                lift = min((self.places[n, i, 2] - self.radii[i]) / self.radii[i] * r, 0.5 * r)
                shapes.append(np.array([x, y]) + 0.5 * self.column * np.array([1, 0]) + r * GROUND)
                faces.append((0.5, 0.5, 0.5, 1))
            ball(i, np.array([x + 0.5 * self.column, y + lift]), r, True)
        return shapes, faces


# ----------------------------------------------------------------------------------------------------
# Animate a run: a film (.mp4, .gif) or the explorer's page (.html). Spots on the balls make their spin visible.


Progress = Callable[[int, int], None]
KINDS = (".mp4", ".gif", ".html")
# Width in pixels. A GIF stores every pixel that changes, so it is smaller than a film.
WIDE = {".mp4": 1280, ".gif": 800}
# The highest frame rate at which browsers play a GIF.
FASTEST_GIF = 50
MOST_FRAMES = 100_000


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
    if not (is_number(fps) and 0 < fps <= fastest):
        faults.add("fps", f"a number above 0, at most {fastest}", repr(fps))
    if not (is_number(speed) and 0 < speed < math.inf):
        faults.add("speed", "a number above 0", repr(speed))
    end = last if end is None else end
    if not (is_number(start) and 0 <= start < last):
        faults.add("start", f"a time from 0 to before {last:.9g} s, the end of the run", repr(start))
    elif not (is_number(end) and start < end <= max(last, run.end)):
        faults.add("end", f"a time after {start:.9g} s, at most {last:.9g} s, the end of the run", repr(end))
    faults.raise_if_any()
    return float(start), float(end)


def is_number(x: Any) -> bool:
    """Return whether an argument is a number."""
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
