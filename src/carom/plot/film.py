"""Films and moving pages of a run (.mp4, .gif, .html), whose balls have spots that show how they turn, and of a gas."""

from __future__ import annotations

import io
import math
import os
import shutil
import subprocess
import tempfile
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, require_count
from carom.explorer.page import player_page
from carom.files import atomic_path, import_optional, install_command, require_library, require_writable, write_text
from carom.formatting import format_length
from carom.plot.style import COLOURS, GREY, INK, PALE, literal, new_figure, style
from carom.plot.trajectory import colour, draw_walls, last_time, steps, view, way
from carom.simulation.records import MEETINGS, WALLS
from carom.simulation.trajectory import Trajectory

if TYPE_CHECKING:
    from carom.gas.containers import Container
    from carom.gas.session import Session

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

    def __init__(
        self, run: Trajectory, times: Array, span: tuple[float, float], wide: int, points: Array | None = None
    ) -> None:
        from matplotlib.collections import LineCollection, PolyCollection
        from matplotlib.figure import Figure

        self.run, self.times, self.span = run, times, span
        self.places, self.turned, self.phases = (
            np.asarray(run.at(times).position),
            run.orientation(times),
            run.phase(times),
        )
        # (without weight nothing is in the air: a puck, a disc of a billiard)
        self.words = WORDS if any(run.scene.gravity) else WORDS | {"flight": "moving"}
        self.radii = np.array([ball.radius for ball in run.scene.balls])
        ways = [way(run, i, span[1]) for i in range(len(self.radii))]
        self.trails = [
            (
                np.concatenate([[], *(t for _, t, _ in pieces)]),
                np.concatenate([np.zeros((0, 3)), *(x for *_, x in pieces)]),
            )
            for pieces in ways
        ]
        everywhere = np.concatenate([*(x for _t, x in self.trails), np.array(run.start.position)])
        shown = view(run, everywhere if points is None else points)
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
            text.set_text(f"{literal(self.run.scene.ball_names[k])}: {self.words[str(self.phases[n][k])]}{up}")

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


def picture(run: Trajectory, reach: Array) -> NDArray[np.uint8]:
    """Return the end of a run with its paths on a region that ``reach`` (2,), m, is half of: (high, 640, 3) bytes."""
    require_library("matplotlib", "rgb_array")
    until = last_time(run)
    with style():
        film = Film(run, np.array([until]), (0.0, until), 640, np.array([reach, -reach]))
        return np.array(film.frame(0)[..., :3])


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


# ----------------------------------------------------------------------------------------------------
# Films of gases: a picture that moves (.svg), small and sharp at every size, or pixels (.gif, .mp4).

GAS_KINDS = (".svg", ".gif", ".mp4")
MOST_BALLS = {".svg": 1000, ".gif": 20_000, ".mp4": 20_000}
MOST_SPOKES = 1000  # balls of which a film in pixels shows how they turn
PALEST = 0.75  # share of white in the colour of the spheres at the back
STEP = 0.25  # radii of the smallest ball that it moves between two frames, at the mean square speed
SHARE_OF_PERIOD = 1 / 16  # of a wall that oscillates, between two frames
UNITS = 1000  # along the longer side of a moving picture
POINTS = 4.0  # inches of the longer side


def animate_gas(
    session: Session,
    path: str | os.PathLike[str],
    *,
    frames: int = 150,
    interval: float | None = None,
    fps: float = 25,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Write a film of a gas that goes on from where it is; the gas itself stays as it is.

    Parameters
    ----------
    session : Session
        Of discs or, for .gif and .mp4, of spheres, which are seen from the side (x and z).
    path : str or path
        File to write: .svg (a picture that moves, for pages), .gif or .mp4.
    frames : int
        Number of frames.
    interval : float, optional
        Simulated time between two frames. Default: in which a ball moves by a quarter of the smallest radius.
    fps : float
        Frames per second.
    progress : callable(done, total), optional
        Called after each frame.

    Returns
    -------
    pathlib.Path
        The file written.

    Raises
    ------
    CaromError
        For another ending, too many balls, numbers out of range, a missing library (Matplotlib; for .mp4 also ffmpeg), or a file
        that cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from carom.gas import GasScene, Session
    >>> from carom.plot import animate_gas
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (8, 8)}, species=[{"count": 20, "radius": 0.5}], contacts=[contact],
    ...     run={"max_events": 100},
    ... )
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     animate_gas(Session(scene), f"{folder}/gas.svg", frames=10).name
    'gas.svg'
    """
    path = Path(path)
    require_writable(path, GAS_KINDS)
    kind = path.suffix.lower()
    require_library("matplotlib", "animate_gas")
    _check(session, kind, frames, interval, fps)
    program = ffmpeg() if kind == ".mp4" else ""
    tell = progress or (lambda _done, _total: None)
    reel = _filmed(session, frames, interval, (lambda k, n: tell(k // 2, n)) if kind != ".svg" else tell)
    with style():
        if kind == ".svg":
            write_text(path, _svg(reel, fps))
            return path
        write_film(_GasFilm(reel, WIDE[kind]), path, program, fps, lambda k, n: tell((n + k) // 2, n))
    return path


def _check(session: Session, kind: str, frames: Any, interval: Any, fps: Any) -> None:
    faults, scene = FaultList("animate_gas"), session.scene
    if kind == ".svg" and scene.container.dimensions == 3:
        faults.add("path", ".gif or .mp4 for spheres, whose order from front to back changes", ".svg")
    if scene.count > MOST_BALLS[kind]:
        faults.add("session", f"at most {MOST_BALLS[kind]:,} balls in a film ({kind})", f"{scene.count:,}")
    faults.attempt(require_count, "animate_gas", "frames", frames, 2, MOST_FRAMES)
    for name, value, most in (("interval", interval, math.inf), ("fps", fps, FASTEST_GIF if kind == ".gif" else 1000)):
        if value is not None and not (is_number(value) and 0 < value <= most):
            faults.add(name, "a number > 0" + (f", at most {most:g}" if most < math.inf else ""), f"{value!r}")
    faults.raise_if_any()


@dataclass(frozen=True)
class _Reel:
    """Content of a film: places (F, N, 2), which do not jump at periodic borders, angles (F, N), and walls that move."""

    container: Container
    pair: list[int]
    times: Array
    x: Array
    angle: Array
    radius: Array
    species: NDArray[np.int64]
    depth: Array
    """(F, N) of spheres behind the middle of the container, in its depth; of discs 0."""
    walls: list[tuple[int, float, Array]]
    """Of each wall that moves: the axis of the picture along which it does, its place at rest, and its displacements (F,)."""

    @property
    def window(self) -> tuple[Array, Array]:
        """The lower and the upper corner of what is seen."""
        size = np.array(self.container.size)[self.pair]
        low, high = np.zeros(2), size.copy()
        for axis, rest, moved in self.walls:
            low[axis], high[axis] = min(low[axis], rest + moved.min()), max(high[axis], rest + moved.max())
        return low - 0.004 * size.max(), high + 0.004 * size.max()

    @property
    def around(self) -> list[bool]:
        """Along which axes of the picture the gas is periodic."""
        return [self.container.periodic[k] for k in self.pair]

    @property
    def clip(self) -> tuple[Array, Array]:
        """The lower corner and the sides of where balls are seen: not beyond periodic borders."""
        low, high = self.window
        corner = np.where(self.around, 0.0, low)
        return corner, np.where(self.around, np.array(self.container.size)[self.pair], high) - corner

    @property
    def shifts(self) -> list[tuple[float, float]]:
        """Of the images that reach into the picture; the first is none."""
        size = np.array(self.container.size)[self.pair]
        steps = [(0, -1, 1) if around else (0,) for around in self.around]
        return [(i * float(size[0]), j * float(size[1])) for i in steps[0] for j in steps[1]]


def _filmed(session: Session, frames: int, interval: float | None, tell: Callable[[int, int], None]) -> _Reel:
    """Film a copy of the gas; a gas that ends early is filmed until then."""
    from carom.gas.gas import Gas
    from carom.gas.results import EndedEarlyError
    from carom.plot.gas import LEAST_SHOWN

    gas, box = Gas.restore(session.gas.state()), session.scene.container.geometry
    flat = len(box.size) == 2
    pair, size = [0, 1] if flat else [0, 2], np.array(box.size)
    first = gas.balls()
    radius = np.maximum(gas.arrays.materials.species["radius"][first.species], LEAST_SHOWN * size[pair].max())
    step = interval or _interval(session, first.velocity, float(radius.min()))
    names = list(gas.wall_motion(oscillating=True))
    times, places, depths, spins, moved = [], [], [], [], []
    begin = gas.time
    for k in range(frames):
        if k:
            try:
                gas.advance(until=begin + k * step)
            except EndedEarlyError:
                break
        now = gas.balls()
        times.append(gas.time - begin)
        places.append((now.position[:, : len(size)] + now.images[:, : len(size)] * size)[:, pair])
        depths.append(now.position[:, 1] / size[1] - 0.5 if not flat else np.zeros(len(radius)))
        spins.append(now.spin[:, 2] if flat else np.zeros(len(radius)))
        motion = gas.wall_motion(oscillating=True)
        moved.append([motion[name].displacement for name in names])
        tell(k + 1, frames)
    if len(times) < 2:
        raise CaromError("animate_gas: expected a gas that goes on for two frames, got one that ends; film it earlier")
    t = np.array(times)
    walls = [
        (pair.index(axis), float(face.centre[axis]), float(face.vector[axis]) * np.array(moved)[:, k])
        for k, name in enumerate(names)
        for face in box.faces[[one.name for one in box.faces].index(name) :][:1]
        if (axis := int(np.argmax(np.abs(face.vector)))) in pair and np.array(moved)[:, k].any()
    ]
    species = gas.groups[first.species]
    return _Reel(box, pair, t, np.array(places), _angles(spins, t), radius, species, np.array(depths), walls)


def _angles(spins: Any, t: Array) -> Array:
    """Return angles (F, ...) of what turns with these spins, from 0."""
    w = np.array(spins)
    steps = (w[1:] + w[:-1]) / 2 * np.diff(t)[:, None]
    return np.concatenate([np.zeros((1, w.shape[1])), np.cumsum(steps, axis=0)])


def _interval(session: Session, velocity: Array, radius: float) -> float:
    """Return the default time between two frames."""
    speed = math.sqrt(float((velocity**2).sum(axis=1).mean()))
    speed = speed or max((one.greatest_speed for one in session.scene.drives), default=0.0)
    step = STEP * radius / speed if speed > 0 else 1.0
    return min([step, *(SHARE_OF_PERIOD / one.frequency for one in session.scene.drives if one.frequency)])


def _still(reel: _Reel, inches: tuple[float, float]) -> tuple[Any, Any]:
    """Return a figure with the walls, and its axes, which fill it."""
    from carom.plot.gas import draw_outline

    low, high = reel.window
    figure = new_figure(*inches)
    axes = figure.add_axes((0, 0, 1, 1))
    draw_outline(axes, reel.container, reel.pair, np.zeros(2), np.array(reel.container.size)[reel.pair])
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.set_axis_off()
    return figure, axes


# --- a picture that moves ---------------------------------------------------------------------------------------------


def _svg(reel: _Reel, fps: float) -> str:
    """Return the film as SVG: Matplotlib's picture of the walls, and a group for each ball whose place and angle are animated."""
    low, high = reel.window
    span = high - low
    scale = UNITS / span.max()
    figure, _axes = _still(reel, tuple((POINTS * span / span.max()).tolist()))
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    still = text.getvalue()
    points = 72 * POINTS / UNITS
    seconds = f'dur="{len(reel.times) / fps:.6g}s" repeatCount="indefinite"'
    wrapped = np.array(reel.container.size)[reel.pair] * scale
    groups = []
    for i in range(len(reel.radius)):
        r, ink = reel.radius[i] * scale, COLOURS[reel.species[i] % len(COLOURS)]
        path, keys = _path_of(reel.x[:, i] * scale, wrapped, reel.around)
        spoke = _spoke(r, reel.angle[:, i], "#fff", seconds) if reel.angle[:, i].any() else ""
        groups.append(
            f'<g transform="translate({path.split(";")[0]})"><circle r="{r:.1f}" fill="{ink}"/>{spoke}'
            f'<animateTransform attributeName="transform" type="translate" values="{path}"{keys} {seconds}/></g>'
        )
    images = "".join(f'<use href="#balls" x="{dx * scale:.1f}" y="{dy * scale:.1f}"/>' for dx, dy in reel.shifts[1:])
    corner, across = reel.clip
    box = " ".join(
        f'{name}="{value * scale:.1f}"'
        for name, value in zip(("x", "y", "width", "height"), (*corner, *across), strict=True)
    )
    lines = "".join(_moving_line(reel, wall, scale, seconds) for wall in reel.walls)
    moving = (
        f'<clipPath id="seen"><rect {box}/></clipPath><g transform="translate({-low[0] * scale * points:.4f},'
        f'{high[1] * scale * points:.4f}) scale({points:.6f},{-points:.6f})"><g clip-path="url(#seen)"><g id="balls">'
        f"{''.join(groups)}</g>{images}</g>{lines}</g>"
    )
    end = still.rindex("</svg>")
    return f"{still[:end]}{moving}\n{still[end:]}"


def _spoke(r: float, angle: Array, ink: str, seconds: str) -> str:
    """Return a radius that turns."""
    angles = ";".join(f"{a:.0f}" for a in np.degrees(angle))
    return (
        f'<path d="M0 0H{0.86 * r:.1f}" stroke="{ink}" stroke-width="{0.22 * min(r, 60.0):.1f}"><animateTransform'
        f' attributeName="transform" type="rotate" values="{angles}" {seconds}/></path>'
    )


def _path_of(x: Array, size: Array, around: list[bool]) -> tuple[str, str]:
    """Return the places of a ball as values of an animation, within a periodic box, and its times if it jumps."""
    turns = np.where(around, np.floor(x / size), 0.0)
    keys: list[float] = []
    values: list[str] = []
    for k in range(len(x)):
        t = k / (len(x) - 1)
        if k and (turns[k] != turns[k - 1]).any():  # (it leaves the box, and at once is where its image is)
            here = x[k] - turns[k - 1] * size
            keys.append(t)
            values.append(f"{here[0]:.0f},{here[1]:.0f}")
        here = x[k] - turns[k] * size
        keys.append(t)
        values.append(f"{here[0]:.0f},{here[1]:.0f}")
    times = ";".join(f"{t:.4f}".rstrip("0").rstrip(".") for t in keys)
    return ";".join(values), f' keyTimes="{times}"' if len(keys) > len(x) else ""


def _moving_line(reel: _Reel, wall: tuple[int, float, Array], scale: float, seconds: str) -> str:
    """Return a wall that moves, as a line."""
    axis, rest, moved = wall
    low, high = reel.window * np.array(scale)
    values = ";".join(f"{d * scale:.0f},0" if axis == 0 else f"0,{d * scale:.0f}" for d in moved)
    at = f"{rest * scale:.1f}"
    ends = f"M{at} {low[1]:.1f}V{high[1]:.1f}" if axis == 0 else f"M{low[0]:.1f} {at}H{high[0]:.1f}"
    return (
        f'<path d="{ends}" stroke="{INK}" stroke-width="6"><animateTransform attributeName="transform" type="translate"'
        f' values="{values}" {seconds}/></path>'
    )


# --- pixels -----------------------------------------------------------------------------------------------------------


class _GasFilm(Frames):
    """Frames of a gas in pixels: the walls are drawn once, balls over them."""

    def __init__(self, reel: _Reel, wide: int) -> None:
        from matplotlib.collections import LineCollection, PolyCollection
        from matplotlib.colors import to_rgba_array
        from matplotlib.patches import Rectangle

        self.reel = reel
        low, high = reel.window
        span = (high - low) * (wide / (high - low).max())
        wide, high_ = 2 * round(span[0] / 2), 2 * round(span[1] / 2)
        figure, _axes = _still(reel, (wide / 100, high_ / 100))
        figure.set_dpi(100)
        super().__init__(figure, reel.times, (wide, high_))
        corner, across = reel.clip
        border = Rectangle(tuple(corner), *across, transform=self.axes.transData)
        count = len(reel.shifts)
        inks = to_rgba_array([COLOURS[k % len(COLOURS)] for k in reel.species.tolist()])[:, :3]
        self.radii, self.inks = np.tile(reel.radius, count), np.tile(inks, (count, 1))
        self.balls = PolyCollection([], edgecolors="white", linewidths=0.3)
        self.spokes = LineCollection([], colors="white", lw=1.2)
        self.walls = LineCollection([], colors=INK, lw=2.5)
        self.moving = [self.balls, self.spokes, self.walls]
        for one in self.moving:
            self.axes.add_collection(one, autolim=False)
        for one in (self.balls, self.spokes):
            one.set_clip_path(border)

    def move(self, n: int) -> None:
        """Bring the balls and walls to the n-th frame."""
        reel, size = self.reel, np.array(self.reel.container.size)[self.reel.pair]
        x = np.where(reel.around, np.mod(reel.x[n], size), reel.x[n])
        x = np.concatenate([x + np.array(shift) for shift in reel.shifts])
        low, high = reel.window
        seen = np.flatnonzero(((x > low - self.radii[:, None]) & (x < high + self.radii[:, None])).all(axis=1))
        depth = np.tile(reel.depth[n], len(reel.shifts))
        order = seen[np.argsort(-depth[seen], kind="stable")]  # (those behind first)
        pale = PALEST * (depth[order, None] + 0.5) * float(reel.depth.any())
        inks = self.inks[order] * (1 - pale) + pale
        self.balls.set(verts=x[order, None] + self.radii[order, None, None] * DISC[::2], facecolors=inks)
        if reel.angle.any() and len(reel.radius) <= MOST_SPOKES:
            angle = np.tile(reel.angle[n], len(reel.shifts))
            tips = x + 0.86 * self.radii[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
            self.spokes.set_segments(list(np.stack([x, tips], axis=1)[seen]))
        lines = []
        for axis, rest, moved in reel.walls:
            ends = np.array([low, high])
            ends[:, axis] = rest + moved[n]
            lines.append(ends)
        self.walls.set_segments(lines)
