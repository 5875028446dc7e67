"""Shared by figures, films and pages of a run: colours, paths of the balls, walls in view, sampling times."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, SLIDING
from carom.scene.feature_builders import circle
from carom.scene.wall import WallShape
from carom.simulation.records import START
from carom.simulation.states import states
from carom.simulation.trajectory import Trajectory

__all__ = ["SEEN", "View", "colour", "last_time", "steps", "view", "walls_in", "way"]

Array = NDArray[np.float64]
# Okabe & Ito's colours, distinct for colour-blind people.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
# A white ball is drawn grey, to be visible on paper.
CALLED = {
    "white": "#8f887c", "yellow": "#dba800", "red": "#c23616", "blue": "#0072B2", "green": "#009E73", "black": "#222222",
    "orange": "#D55E00", "brown": "#8c5a2b", "pink": "#CC79A7",
}  # fmt: skip
# A hop lower than this fraction of the radius is invisible.
SEEN = 1e-3
# Above this number of events paths are drawn with fewer points.
MANY = 4000


def colour(run: Trajectory, ball: int) -> str:
    """Return the colour of a ball: that with which its name begins ("red 3"), if there is one, else by its number."""
    first = run.scene.ball_names[ball].lower().split(maxsplit=1)[:1]
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
