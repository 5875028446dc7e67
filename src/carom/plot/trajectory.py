"""Draw a run: view from above, heights of the balls, and energy over time."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, REST, ROLLING, SLIDING
from carom.errors import CaromError
from carom.formatting import format_number, format_time
from carom.plot.style import COLOURS, GREY, INK, PALE, drawn, literal, new_figure, spread_apart
from carom.scene.feature_builders import circle
from carom.scene.toml import ball_index
from carom.scene.wall import WallShape
from carom.simulation.motion import states
from carom.simulation.records import (
    BALL,
    FLOOR,
    HELD_EVENT,
    IN_CLUSTER,
    LEFT_EVENT,
    MEETINGS,
    POCKETED_EVENT,
    START,
    WALL,
    WALL_IN_CLUSTER,
    WALLS,
    event_numbers,
)
from carom.simulation.trajectory import Trajectory
from carom.sweeps.aiming import UNITS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from carom.sweeps.aiming import Aim, Aims

Array = NDArray[np.float64]
# A white ball is drawn grey, to be visible on paper.
CALLED = {
    "white": "#8f887c", "cue": "#8f887c", "yellow": "#dba800", "red": "#c23616", "blue": "#0072B2", "green": "#009E73",
    "black": "#222222", "orange": "#D55E00", "brown": "#8c5a2b", "pink": "#CC79A7", "purple": "#6a3d9a", "maroon": "#7b2d26",
}  # fmt: skip
# Of pool, by number; 9 to 15 are striped in the colours of 1 to 7.
OF_POOL = ("yellow", "blue", "red", "purple", "orange", "green", "maroon", "black")
CALLED |= {str(1 + k + 8 * half): CALLED[name] for half in (0, 1) for k, name in enumerate(OF_POOL)}
# A hop lower than this fraction of the radius is invisible.
SEEN = 1e-3
# Above this number of events paths are drawn with fewer points.
MANY = 4000


def colour(run: Trajectory, ball: int) -> str:
    """Return the colour of a ball: that with which its name begins ("red 3", "8-ball"), if there is one, else by its number."""
    first = run.scene.ball_names[ball].lower().replace("-", " ").split(maxsplit=1)[:1]
    return CALLED.get(first[0] if first else "", COLOURS[ball % len(COLOURS)])


def last_time(run: Trajectory) -> float:
    """Return the time at which a figure of a run ends, s: somewhat after the run's end if a ball then moves on for ever."""
    speed = np.linalg.norm(run.final.velocity, axis=1)
    goes_on = run.ended == "nothing more happens" and any(
        s > 0 and phase in ("flight", "sliding", "rolling") for s, phase in zip(speed, run.final_phase, strict=True)
    )
    if not goes_on:  # one second for balls at rest from the start
        return run.end if run.end > 0 or run.ended != "nothing more happens" else 1.0
    return 1.15 * run.end if run.end > 0 else 20 * max(ball.radius for ball in run.scene.balls) / float(speed.max())


def way(run: Trajectory, ball: int, until: float) -> list[tuple[int, Array, Array]]:
    """Return the path of a ball: (phase's number, times (N,), centres (N, 3)) of each phase, sampled on its closed form."""
    rows = run.log[run.log["ball"] == ball]
    ends = np.minimum(np.append(rows["t"][1:], until), until)
    keep = (ends > rows["t"]) & (rows["phase"] < HELD)
    rows, lasts = rows[keep], (ends - rows["t"])[keep]
    # of straight pieces only the ends are needed; a run with very many events is drawn more coarsely
    fine = 33 if len(rows) < MANY else 5
    bent = np.isin(rows["phase"], (FLIGHT, SLIDING, BOUNCING))
    counts = np.where(rows["phase"] == BOUNCING, 400, np.where(bent, fine, 3))
    which = np.repeat(np.arange(len(rows)), counts)
    place = np.concatenate([np.linspace(0, 1, n) for n in counts]) if len(counts) else np.zeros(0)
    after = place * lasts[which]
    x, _v, _w, _phase = states(run.arrays.world, run.arrays.balls, rows[which], after)
    t = rows["t"][which] + after
    found: list[tuple[int, Array, Array]] = []
    for phase, a, b in zip(rows["phase"], np.cumsum(counts) - counts, np.cumsum(counts), strict=True):
        if found and found[-1][0] == phase:
            _, t0, x0 = found[-1]
            found[-1] = (int(phase), np.append(t0, t[a:b]), np.append(x0, x[a:b], axis=0))
        else:
            found.append((int(phase), t[a:b], x[a:b]))
    return found


def steps(run: Trajectory, until: float, grid: int = 400) -> Array:
    """Return times from 0 to ``until`` that resolve changes at events: an even grid, each event, and the instant before it."""
    events = run.log["t"][(run.log["kind"] != START) & (run.log["t"] <= until)]
    return np.unique(np.concatenate((np.linspace(0, until, grid), events, np.nextafter(events[events > 0], 0))))


@dataclass(frozen=True)
class View:
    """The region shown in a figure, m: left, right, bottom, top."""

    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, m."""
        return self.x[1] - self.x[0], self.y[1] - self.y[0]


def view(run: Trajectory, points: Array) -> View:
    """Return the region that contains all bounded walls and all points (N, 3) of the paths, with a margin."""
    a = max(ball.radius for ball in run.scene.balls)
    seen = [line for wall in run.scene.walls if wall.bounded for line in wall.outline()]
    seen += [circle(pocket.center, pocket.radius) for wall in run.scene.walls for pocket in wall.pockets]
    low = np.min([points[:, :2].min(axis=0) - 1.4 * a, *(line.min(axis=0) for line in seen)], axis=0)
    high = np.max([points[:, :2].max(axis=0) + 1.4 * a, *(line.max(axis=0) for line in seen)], axis=0)
    air = 0.03 * float((high - low).max())
    # a straight path would give a figure without height
    thin = np.maximum(0.3 * float((high - low).max()) - (high - low), 0) / 2
    low, high = low - air - thin, high + air + thin
    return View((float(low[0]), float(high[0])), (float(low[1]), float(high[1])))


def walls_in(run: Trajectory, shown: View) -> list[tuple[Array, str]]:
    """Return the visible parts of the walls: polylines or polygons (N, 2), each a "line", "felt", "solid" or "pocket"."""
    found: list[tuple[Array, str]] = []
    z = float(run.start.position[0, 2]) if run.start.position is not None else 0.0
    for wall in run.scene.walls:
        found += [] if wall.bed is None else [(wall.bed, "felt")]
        found += [(circle(pocket.center, pocket.radius), "pocket") for pocket in wall.pockets]
        for line in wall.outline():
            if not wall.bounded:
                for piece in _clipped(line, shown):
                    band = _behind(wall, piece, z, 0.018 * max(shown.size))
                    found += [(band, "solid")] if band is not None else []
                    found.append((piece, "line"))
                continue
            if len(line) > 3 and np.allclose(line[0], line[-1]):
                x, y = line[:-1].mean(axis=0)
                found.append((line, "solid" if wall.blocked((float(x), float(y), z)) else "felt"))
            found.append((line, "line"))
    order = ("felt", "solid", "pocket", "line")
    return sorted(found, key=lambda one: order.index(one[1]))


def _clipped(line: Array, shown: View) -> list[Array]:
    """Return the visible parts of a polyline (Liang & Barsky 1984, vectorised), so that files hold no lines of 2 km."""
    found: list[Array] = []
    for p, q in pairwise(line):
        first, last, d = 0.0, 1.0, q - p
        for step, low, high in (
            (d[0], shown.x[0] - p[0], shown.x[1] - p[0]),
            (d[1], shown.y[0] - p[1], shown.y[1] - p[1]),
        ):
            if step == 0:
                first, last = (first, last) if low <= 0 <= high else (1.0, 0.0)
            else:
                first, last = max(first, min(low / step, high / step)), min(last, max(low / step, high / step))
        if first < last:
            found.append(np.array([p + first * d, p + last * d]))
    return found


def _behind(wall: WallShape, line: Array, z: float, depth: float) -> Array | None:
    """Return a band along a straight wall, on the side that is inaccessible to balls; None if both sides are accessible."""
    d = line[1] - line[0]
    normal = np.array([-d[1], d[0]]) / np.hypot(*d)
    x, y = line.mean(axis=0)
    for n in (normal, -normal):
        if wall.blocked((float(x + depth * n[0]), float(y + depth * n[1]), z)):
            return np.array([line[0], line[1], line[1] + depth * n, line[0] + depth * n])
    return None


# ----------------------------------------------------------------------------------------------------
# Draw a run: view from above, heights of the balls, and energy over time.


FILLS, CUSHION = {"felt": "#f4f2ec", "solid": "#d9d5ca", "pocket": "#2b2926"}, "#55504a"
AIR, SLIDES, ROLLS = "in the air", "slides", "rolls"
STYLES: dict[str, Any] = {ROLLS: "solid", SLIDES: (0, (4.5, 1.8)), AIR: (0, (0.6, 1.5))}
MOTION = {FLIGHT: AIR, BOUNCING: AIR, SLIDING: SLIDES, ROLLING: ROLLS}
# Above these numbers of events marks would hide the paths, and numbers would overlap.
MOST_MARKS, MOST_NUMBERS = 400, 24
MOST_LEGEND = 6  # balls that the legend names; of more, short names stand on the balls


def plot_trajectory(
    run: Trajectory,
    file: str | os.PathLike[str] | None = None,
    *,
    ball: int | str | Sequence[int | str] | None = None,
    title: str | None = None,
) -> Figure:
    """Draw a run: paths from above, heights of the balls (if they leave the floor), and the energy over time.

    Parameters
    ----------
    run : Trajectory
        From :func:`carom.simulate`.
    file : str or path, optional
        File to write, .svg, .pdf or .png.
    ball : int or str, or several
        Number or name of the ball to draw. Default: all balls.
    title : str, optional
        Default: a description of the scene.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    CaromError
        For an unknown ball, a file that cannot be written, or if Matplotlib is missing.

    Examples
    --------
    >>> import carom
    >>> from carom import plot
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0))
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-1, 0, 0))
    >>> run = carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(law="mirror", duration=2)))
    >>> figure = plot.plot_trajectory(run)
    >>> figure.axes[0].get_xlabel()
    'x, m'
    """
    balls = _chosen(run, ball)
    return drawn(lambda: _draw(run, balls, title), file)


def _chosen(run: Trajectory, ball: Any) -> list[int]:
    if ball is None:
        return list(range(len(run.scene.balls)))
    several: list[Any] = [ball] if isinstance(ball, (int, np.integer, str)) else list(ball)
    return [ball_index(run.scene, one, "plot: ball") for one in several]


def _draw(run: Trajectory, balls: list[int], title: str | None) -> Any:
    until = last_time(run)
    ways = {i: way(run, i, until) for i in balls}
    all_points = [x for i in balls for _phase, _t, x in ways[i]] + [np.array(run.start.position)[balls]]
    shown = view(run, np.concatenate(all_points))
    high = _hops(run, ways)
    tall = shown.size[1] / shown.size[0]
    # inches; a tall table is drawn beside its curves, a wide one above them
    lanes = 2 if high else 1
    beside = tall > 0.72
    w = 4.4 if beside else 6.4
    w, h = (w, w * tall) if w * tall < 5.2 else (5.2 / tall, 5.2)
    lane, gap, left, top = 1.25, 0.55, 0.62, 0.78
    if beside:
        h = max(h, lanes * 1.1 + (lanes - 1) * gap)
        lane = (h - (lanes - 1) * gap) / lanes
        width, height = left + w + 0.85 + 3.1 + 0.2, h + top + 0.5
        places = [(left + w + 0.85, height - top - k * (lane + gap) - lane, 3.1, lane) for k in range(lanes)]
    else:
        width = left + max(w, 5.4) + 0.25
        height = top + h + lanes * (lane + gap) + 0.55
        places = [
            (left, height - top - h - 0.1 - (k + 1) * (lane + gap), width - left - 0.25, lane) for k in range(lanes)
        ]
    figure = new_figure(width, height)

    def panel(x: float, y: float, across: float, up: float) -> Any:
        return figure.add_axes((x / width, y / height, across / width, up / height))

    above = panel(left if beside else left + (width - left - 0.25 - w) / 2, height - top - h, w, h)
    _above(above, run, shown, ways, balls)
    panels = [panel(*place) for place in places]
    if high:
        _height(panels[0], run, ways)
        # a few short hops in a long run are enlarged
        air = 0.15 * (high[1] - high[0])
        panels[0].set_xlim((high[0] - air, high[1] + air) if high[1] - high[0] < 0.3 * until else (0, until or 1.0))
    _energy(panels[-1], run, balls, until)
    panels[-1].set_xlim(0, until or 1.0)
    numbers = _numbers(run, balls)
    for axes in panels:
        axes.set_xlabel("time, s", labelpad=1.5)
        low, high = axes.get_xlim()
        inside = [(float(row["t"]), number) for row, number in numbers if low < row["t"] < high]
        labels = spread_apart([t for t, _number in inside], 0.012 * (high - low) * 6.4 / (width - left), low, high)
        for (t, number), x in zip(inside, labels, strict=True):
            axes.axvline(t, color=GREY, lw=0.4, ls=(0, (1, 2)), zorder=0)
            axes.text(
                x, 1.01, str(number), transform=axes.get_xaxis_transform(), fontsize=6.5, ha="center", va="bottom",
                color=GREY,
            )  # fmt: skip
    took = "" if run.ended == "duration" else f" in {format_time(run.end)}"  # (the scene's words have its duration)
    said = f"{run.scene.describe()}; {len(run.events)} events{took}" if title is None else title
    # (a letter of this size takes a fifteenth of an inch)
    size = 9.5 * min(1.0, 15 * (width - left - 0.1) / max(len(said), 1))
    figure.text(left / width, 1 - 0.16 / height, literal(said[:1].upper() + said[1:]), va="top", fontsize=size)
    _legend(figure, run, ways, balls, (left / width, 1 - 0.34 / height))
    return figure


def draw_walls(
    axes: Any, run: Trajectory, shown: View, width: float, place: Callable[[Array], Array] = np.array
) -> None:
    """Draw the walls, lines of this width; ``place`` brings positions (N, 2) to the coordinates of the axes."""
    for line, what in walls_in(run, shown):
        x, y = place(line).T
        if what == "line":
            axes.plot(x, y, color=CUSHION, lw=width, zorder=2, solid_joinstyle="miter", solid_capstyle="butt")
        else:
            axes.fill(x, y, color=FILLS[what], lw=0, zorder=0 if what == "felt" else 1)


def _above(axes: Any, run: Trajectory, shown: View, ways: dict[int, list[Any]], balls: list[int]) -> None:
    from matplotlib.patches import Circle

    draw_walls(axes, run, shown, 1.8)
    one = len({MOTION.get(phase) for i in balls for phase, _t, _x in ways[i]} - {None}) < 2
    thin = 1.4 if len(run.log) < 50 else 0.8 if len(run.log) < 1500 else 0.3
    last = run.final.position
    assert last is not None
    start = np.array(run.start.position)
    # a ball that fell is drawn in its pocket
    pockets = [pocket.center for wall in run.scene.walls for pocket in wall.pockets]
    fallen = {int(row["ball"]): pockets[row["other"]] for row in run.log if row["kind"] == POCKETED_EVENT}
    for i in balls:
        a, ink = run.scene.balls[i].radius, colour(run, i)
        for phase, _t, x in ways[i]:
            if phase in MOTION:
                dashes = "solid" if one else STYLES[MOTION[phase]]
                axes.plot(x[:, 0], x[:, 1], color=ink, ls=dashes, lw=thin, zorder=4, solid_joinstyle="round")
        end = fallen.get(i, ways[i][-1][2][-1] if ways[i] else last[i])
        axes.add_patch(Circle((start[i, 0], start[i, 1]), a, fc="white", ec=ink, lw=0.9, zorder=5))
        axes.add_patch(Circle((end[0], end[1]), a, fc=ink, ec="white", lw=0.6, zorder=7, alpha=0.9))
        name = run.scene.ball_names[i]
        if len(balls) > MOST_LEGEND and len(name) <= 2:  # (as on the balls of a pool table)
            points = 72 * axes.get_position().width * axes.figure.get_size_inches()[0] / shown.size[0]
            size = min(7.0, 1.1 * a * points)
            axes.text(
                *end[:2], literal(name), fontsize=size, color="white", ha="center", va="center_baseline", zorder=7.5
            )
    _marks(axes, run, balls)
    axes.set(xlim=shown.x, ylim=shown.y, aspect="equal")
    axes.set_xlabel("x, m", labelpad=1.5)
    axes.set_ylabel("y, m", labelpad=1.5)
    axes.tick_params(length=2)
    axes.spines[:].set_visible(False)


MARKS: dict[int, tuple[str, str, float]] = {
    WALL: ("meets a wall", "o", 3.6),
    BALL: ("meets a ball", "*", 6.5),
    FLOOR: ("lands", "v", 3.4),
    LEFT_EVENT: ("leaves the table", "x", 5.0),
    HELD_EVENT: ("is held", "s", 3.6),
    POCKETED_EVENT: ("falls", "D", 3.4),
}


def _marked(run: Trajectory, balls: list[int]) -> Any:
    """Return the rows of the log that are marked."""
    rows = run.log[np.isin(run.log["kind"], [*MARKS, IN_CLUSTER, WALL_IN_CLUSTER]) & np.isin(run.log["ball"], balls)]
    return rows if len(rows) <= MOST_MARKS else rows[:0]


def _marks(axes: Any, run: Trajectory, balls: list[int]) -> None:
    rows = _marked(run, balls)
    for kind, (_label, mark, size) in MARKS.items():
        for i in balls:
            kinds = {BALL: MEETINGS, WALL: WALLS}.get(kind, (kind,))
            x = rows["x"][np.isin(rows["kind"], kinds) & (rows["ball"] == i)]
            ink, large = colour(run, i), size * min(1.0, max(0.6, 30 / max(len(rows), 1)))
            face = "white" if kind == FLOOR else ink
            axes.plot(x[:, 0], x[:, 1], mark, ms=large, mfc=face, mec=ink, mew=0.7, zorder=6, ls="none")
    for hit, number in _numbers(run, balls):
        size = math.hypot(hit["impulse"][0], hit["impulse"][1]) or 1.0
        away = (8 * hit["impulse"][0] / size, 8 * hit["impulse"][1] / size)
        axes.annotate(
            str(number), hit["x"][:2], away, textcoords="offset points", fontsize=6.5, color=INK, ha="center", va="center",
            zorder=8, bbox={"boxstyle": "circle,pad=0.12", "fc": "white", "ec": "none", "alpha": 0.75},
        )  # fmt: skip


def _numbers(run: Trajectory, balls: list[int]) -> list[tuple[Any, int]]:
    """Return the rows of the log of contacts with walls and balls, and their numbers in the figure; empty if too many."""
    rows = np.flatnonzero(np.isin(run.log["kind"], (*WALLS, *MEETINGS)) & np.isin(run.log["ball"], balls))
    # a contact of balls has several rows and one number, at the ball of the lowest number
    rows = rows[np.lexsort((run.log["ball"][rows], event_numbers(run.log)[rows]))]
    _events, first = np.unique(event_numbers(run.log)[rows], return_index=True)
    return [(run.log[row], k) for k, row in enumerate(rows[first], 1)] if len(first) <= MOST_NUMBERS else []


def _upwards(run: Trajectory, ways: dict[int, list[Any]]) -> int:
    """Return the axis of heights: z; of balls that fall along one line as seen from above, in a scene on its side, x or y."""
    pull = np.asarray(run.scene.gravity)
    axis = int(np.argmax(np.abs(pull)))
    if run.scene.floor is not None or axis == 2 or np.count_nonzero(pull) != 1:
        return 2
    wide = max(
        np.ptp(x[:, 1 - axis]) / run.scene.balls[i].radius for i, pieces in ways.items() for _phase, _t, x in pieces
    )
    return axis if wide < SEEN else 2


def _hops(run: Trajectory, ways: dict[int, list[Any]]) -> tuple[float, float] | None:
    """Return the period during which heights change visibly, s; None if they do not."""
    times: list[float] = []
    axis = _upwards(run, ways)
    for i, pieces in ways.items():
        for _phase, t, x in pieces:
            if np.ptp(x[:, axis]) > SEEN * run.scene.balls[i].radius:
                times += [t[0], t[-1]]
    return (min(times), max(times)) if times else None


def _scaled(most: float, unit: str) -> tuple[float, str]:
    """Return the factor by which a quantity is multiplied to give short axis labels, and its unit then."""
    for size, prefix in ((1.0, ""), (1e-3, "m"), (1e-6, "µ")):
        if most >= size:
            return 1 / size, prefix + unit
    return 1e9, "n" + unit


def _height(axes: Any, run: Trajectory, ways: dict[int, list[Any]]) -> None:
    floor, axis = run.scene.floor is not None, _upwards(run, ways)
    sign = 1.0 if floor or axis == 2 else -float(np.sign(np.asarray(run.scene.gravity)[axis]))
    base = {i: run.scene.balls[i].radius if floor else 0.0 for i in ways}
    lifts = {i: [(t, sign * x[:, axis] - base[i]) for _phase, t, x in pieces] for i, pieces in ways.items()}
    most = max(float(np.abs(z).max()) for pieces in lifts.values() for _t, z in pieces)
    factor, unit = (1.0, "m") if most >= 1 else (1e3, "mm")
    said = f"height {'−' if sign < 0 else ''}{'xyz'[axis]}"
    for i, pieces in lifts.items():
        axes.plot(
            np.concatenate([t for t, _z in pieces]), factor * np.concatenate([z for _t, z in pieces]),
            color=colour(run, i), lw=1.0,
        )  # fmt: skip
    axes.set_ylabel(f"{'height above the floor' if floor else said}, {unit}")
    if floor:
        axes.set_ylim(0, 1.12 * factor * most)


def _energy(axes: Any, run: Trajectory, balls: list[int], until: float) -> None:
    t = steps(run, until)
    each = np.asarray(run.energy(t, each=True))[:, balls]
    # (what happens at t = 0, as the landing of a ball that is struck downwards, is seen as a step)
    first = run.log[(run.log["t"] == 0) & (run.log["kind"] != START)]
    if len(first):
        lost = np.asarray(run.kinetic_energy(first["ball"], first["v_before"], first["w_before"]))
        lost -= run.kinetic_energy(first["ball"], first["v"], first["w"])
        start = each[:1] + np.array([lost[first["ball"] == i].sum() for i in balls])
        t, each = np.concatenate([[0.0], t]), np.concatenate([start, each])
    total = np.nansum(each, axis=1)
    factor, unit = _scaled(float(np.abs(total).max()), "J")
    if len(balls) > 1:
        for k, i in enumerate(balls):
            axes.plot(t, factor * each[:, k], color=colour(run, i), lw=1.0, zorder=3)
    axes.plot(t, factor * total, color=INK, lw=1.3, zorder=4, label="all balls")
    if len(balls) > 1:
        axes.legend(handles=axes.lines[-1:], frameon=False, fontsize=8, loc="upper right")
    axes.fill_between(t, factor * total, color=PALE, lw=0, zorder=-1)
    low, high = min(0.0, float(total.min())), max(0.0, float(total.max()))
    if high > low:
        axes.set_ylim(1.1 * factor * low, 1.1 * factor * high)
    axes.set_ylabel(f"energy, {unit}")


def _legend(
    figure: Any, run: Trajectory, ways: dict[int, list[Any]], balls: list[int], at: tuple[float, float]
) -> None:
    from matplotlib.lines import Line2D

    entries: list[Any] = []
    if 1 < len(balls) <= MOST_LEGEND:
        names = run.scene.ball_names
        entries += [
            Line2D([], [], color=colour(run, i), marker="o", ms=5, lw=1.5, label=literal(names[i])) for i in balls
        ]
    moved = {MOTION[phase] for pieces in ways.values() for phase, _t, _x in pieces if phase in MOTION}
    if len(moved) > 1:
        entries += [Line2D([], [], color=INK, ls=STYLES[m], lw=1.4, label=m) for m in STYLES if m in moved]
    rows = _marked(run, balls)
    for kind, (label, mark, size) in MARKS.items():
        if (rows["kind"] == kind).any():
            face = "white" if kind == FLOOR else INK
            entries.append(Line2D([], [], ls="none", marker=mark, ms=size, mfc=face, mec=INK, mew=0.7, label=label))
    ends = run.log["phase"][np.isin(run.log["ball"], balls)]
    entries.append(Line2D([], [], ls="none", marker="o", ms=5.5, mfc="white", mec=INK, mew=0.9, label="start"))
    label = "comes to rest" if (ends == REST).any() and set(run.final_phase) <= {"rest"} else "end"
    entries.append(Line2D([], [], ls="none", marker="o", ms=5.5, mfc=INK, mec=INK, label=label))
    figure.legend(
        handles=entries, loc="upper left", bbox_to_anchor=at, ncols=min(len(entries), 7), frameon=False, fontsize=7.5,
        handlelength=1.9, columnspacing=1.2, handletextpad=0.5, borderaxespad=0.0,
    )  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# Shots that reach a target, side by side: paths up to the target, and where a player's errors bring the ball.


WIDTH, COLUMNS = 4.2, 2  # inches, of a panel; panels side by side
DRAWN = 4  # solutions, if not said otherwise


def plot_aims(aims: Aims, file: str | os.PathLike[str] | None = None, *, solutions: int = DRAWN) -> Figure:
    """Draw solutions of :func:`carom.aim`, a panel each: the balls' paths, and the target's error ellipse.

    Parameters
    ----------
    aims : Aims
    file : str or path, optional
        File to write, .svg, .pdf or .png.
    solutions : int
        How many, the most robust first.

    Returns
    -------
    matplotlib.figure.Figure
        The ellipse, or for a ball to be hit and a pocket the bar across the ball's path, is twice the standard deviation that
        the player's errors give, by the gradients; none where the miss is not linear within them (``Aim.linear``).

    Raises CaromError: no solution, a file that cannot be written, or Matplotlib is missing.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> balls = [carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, y), velocity=(0, 0), rolling=True) for y in (0, 0.6)]
    >>> scene = carom.Scene(floor=carom.Floor(friction=0.2, rolling_resistance=0.01), walls=[wall], balls=balls)
    >>> best = carom.aim(scene, ["balls.0.velocity"], {"hit": 1, "cushions": 1}, starts=512)
    >>> len(carom.plot.plot_aims(best).axes) == min(len(best), 4)
    True
    """
    shown = list(aims)[:solutions]
    if not shown:
        raise CaromError("plot_aims: aims: expected at least one solution, got none")
    runs = [one.run for one in shown]
    ways = [[way(run, i, one.time) for i in range(len(run.scene.balls))] for run, one in zip(runs, shown, strict=True)]
    points = [x for run in ways for ball in run for _phase, _t, x in ball] + [np.asarray(runs[0].start.position)]
    seen = view(runs[0], np.concatenate(points))
    columns = min(COLUMNS, len(shown))
    rows = math.ceil(len(shown) / columns)

    def draw() -> Figure:
        panel, below = WIDTH * seen.size[1] / seen.size[0] + 0.45, 0.5 if columns == 1 else 0.3
        height = panel * rows + below
        figure = new_figure(WIDTH * columns, height)
        for k, one in enumerate(shown):
            axes = figure.add_subplot(rows, columns, k + 1)
            _panel(axes, aims, one, runs[k], ways[k], seen)
        figure.subplots_adjust(
            left=0.01, right=0.99, bottom=below / height, top=1 - 0.32 / height, wspace=0.04, hspace=0.16
        )
        figure.legend(
            handles=_aim_marks(any(one.linear for one in shown)), loc="lower center", ncols=2 if columns == 1 else 4, fontsize=7.5,
            frameon=False, handletextpad=0.5, columnspacing=1.4,
        )  # fmt: skip
        return figure

    return drawn(draw, file)


def _aim_marks(with_spread: bool) -> list[Any]:
    """Return what the marks are, for a legend."""
    from matplotlib.lines import Line2D

    spread = Line2D(
        [], [], color=INK, lw=1.4, marker="|", ms=4, label="spread by the player's errors (2 standard deviations)"
    )
    return [
        Line2D([], [], color=GREY, ls="none", marker="o", ms=5, label="start"),
        Line2D([], [], color=GREY, ls="none", marker="o", ms=5, mfc="none", label="when the target is reached"),
        *([spread] if with_spread else []),
        Line2D([], [], ls="none", label="%: chance of success"),
    ]


def _panel(axes: Any, aims: Aims, one: Aim, run: Any, ways: list[Any], seen: View) -> None:
    from matplotlib.patches import Circle

    draw_walls(axes, run, seen, 1.6)
    at = run.at(one.time)
    for i, ball in enumerate(run.scene.balls):
        ink = colour(run, i)
        for _phase, _t, x in ways[i]:
            axes.plot(x[:, 0], x[:, 1], color=ink, lw=1.2, zorder=4, solid_joinstyle="round")
        axes.add_patch(Circle(run.start.position[i, :2], ball.radius, fc=ink, ec="white", lw=0.6, zorder=5))
        if np.linalg.norm(at.position[i] - run.start.position[i]) > ball.radius:
            axes.add_patch(Circle(at.position[i, :2], ball.radius, fc="none", ec=ink, lw=1.0, zorder=5))
    first = 0
    for target in aims.targets:
        place = slice(first, first + len(target.windows))
        first += len(target.windows)
        if target.kind == "point":
            axes.add_patch(Circle(target.point, target.windows[0], fc="none", ec=INK, lw=0.8, ls=(0, (2, 2)), zorder=6))
        if not one.linear:
            continue
        if target.kind == "point":
            axes.plot(*_ellipse(target.point, one.covariance[place, place]), color=INK, lw=1.0, zorder=6)
        else:
            before = run.at(math.nextafter(one.time, 0.0))
            v = before.velocity[target.ball, :2]
            across = np.array([-v[1], v[0]]) / (np.hypot(*v) or 1.0) * 2 * float(one.spread[place.start])
            center = before.position[target.ball, :2]
            axes.plot(*np.array([center - across, center + across]).T, color=INK, lw=1.4, zorder=6, marker="|", ms=4)
    numbers = ", ".join(
        f"{name} {format_number(x, 4)} {UNITS[name.rpartition('.')[2]]}" for name, x in one.values.items()
    )
    axes.set_title(f"{literal(numbers.replace(' °', '°'))}: {one.chance:.0%}", fontsize=8, color=INK, pad=3)
    axes.set(xlim=seen.x, ylim=seen.y, aspect="equal")
    axes.axis("off")


def _ellipse(center: tuple[float, float], covariance: Any) -> Any:
    """Return the ellipse of two standard deviations, (2, N)."""
    values, axes = np.linalg.eigh(covariance)
    turn = np.linspace(0, 2 * np.pi, 73)
    circle = np.stack([np.cos(turn), np.sin(turn)])
    return np.asarray(center)[:, None] + 2 * axes @ (np.sqrt(np.maximum(values, 0))[:, None] * circle)
