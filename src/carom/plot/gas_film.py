"""Films of gases: a picture that moves (.svg), small and sharp at every size, or pixels (.gif, .mp4)."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList
from carom.files import require_library, require_writable, write_text
from carom.gas.containers import Container
from carom.gas.gas import Gas
from carom.gas.results import EndedEarlyError
from carom.gas.session import Session
from carom.plot.animation import DISC, FASTEST_GIF, MOST_FRAMES, WIDE, Frames, ffmpeg, is_number, write_film
from carom.plot.gas import LEAST_SHOWN, draw_outline
from carom.plot.style import COLOURS, INK, new_figure, style

Array = NDArray[np.float64]
KINDS = (".svg", ".gif", ".mp4")
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
    require_writable(path, KINDS)
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
    if isinstance(frames, bool) or not isinstance(frames, int | np.integer) or not 2 <= frames <= MOST_FRAMES:
        faults.add("frames", f"a whole number from 2 to {MOST_FRAMES}", f"{frames!r}")
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
