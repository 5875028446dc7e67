"""Write a run as a self-contained HTML page that plays it; the motion is stored as parabolas, so it is exact."""

from __future__ import annotations

import html
import json
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, PHASES, REST
from carom.errors import CaromError
from carom.plot.scene_view import colour, steps, view, walls_in, way
from carom.simulation.records import BALL, START, WALL, kind_names
from carom.simulation.setup import set_up
from carom.simulation.states import states
from carom.simulation.trajectory import Trajectory

__all__ = ["page", "page_data"]

Array = NDArray[np.float64]
# Orientations are stored at this rate and at least once per this angle (radians); the page interpolates between them.
RATE, TURN = 120.0, 0.5
# Number of rows above which a browser no longer plays a page smoothly.
MOST_ROWS, MOST_EVENTS = 200_000, 2000
WORDS = {
    "flight": "in the air", "bouncing": "bouncing", "sliding": "sliding", "rolling": "rolling",
    "pivoting": "spinning on the spot", "rest": "at rest", "held": "held", "left": "gone",
}  # fmt: skip
HAPPENS = {
    "wall": "meets {}", "ball": "meets {}", "floor": "lands", "rolling": "rolls", "sliding": "slides",
    "pivoting": "spins on the spot", "rest": "comes to rest", "settled": "bounces no more", "left": "clears {}",
    "held": "is held", "flight": "flies", "bouncing": "bounces",
}  # fmt: skip


def page(run: Trajectory, start: float, end: float, speed: float) -> str:
    """Return the page's HTML; CaromError if a run has more events than a browser can play."""
    data = page_data(run, start, end, speed)
    # a name must not close the script element that contains it
    text = json.dumps(data, separators=(",", ":"), allow_nan=False, ensure_ascii=True).replace("<", "\\u003c")
    template = (files("carom.plot") / "page.html").read_text(encoding="utf-8")
    return template.replace("@TITLE@", html.escape(data["title"])).replace("@DATA@", text)


def page_data(run: Trajectory, start: float, end: float, speed: float) -> dict[str, Any]:
    """Return the page's data of a run from ``start`` to ``end``, with nine significant digits, times with twelve.

    ``balls``: ``pieces`` are rows t, x, y, z, velocity, acceleration, number of the phase: between two rows the centre is
    on that parabola; ``turns`` are rows t and a quaternion (w, x, y, z).
    """
    inside = (run.log["t"] >= start) & (run.log["t"] <= end)
    if inside.sum() > MOST_ROWS:
        raise CaromError(
            f"animate: expected at most {MOST_ROWS} events in a page, got {int(inside.sum())}; take a shorter time: start=, end="
        )
    names, scene = run.scene.ball_names, run.scene
    balls: list[dict[str, Any]] = []
    for i, ball in enumerate(scene.balls):
        pieces = _pieces(run, i, start, end)
        turns = _turns(run, i, start, end)
        balls.append(
            {
                "name": names[i],
                "colour": colour(run, i),
                "radius": ball.radius,
                "pieces": _rows(pieces),
                "turns": _rows(turns, 7),
            }
        )
        for row in balls[-1]["pieces"]:
            row[-1] = int(row[-1])
    ways = [x for i in range(len(names)) for _phase, _t, x in way(run, i, end)]
    points = np.concatenate([*ways, np.array(run.start.position)])
    shown = view(run, points)
    radius = min(ball.radius for ball in scene.balls) if scene.floor is not None else 0.0
    lowest = radius if scene.floor is not None else float(points[:, 2].min())
    return {
        "title": _title(scene.describe()),
        "span": [start, end],
        "speed": speed,
        "floor": scene.floor is not None,
        "lowest": lowest,
        "highest": float(points[:, 2].max()) - lowest,
        "view": [*shown.x, *shown.y],
        "walls": [
            [what, [[float(f"{x:.6g}") for x in point] for point in line.tolist()]]
            for line, what in walls_in(run, shown)
        ],
        "phases": list(PHASES),
        "words": WORDS,
        "balls": balls,
        "events": _events(run, start, end),
        "energy": _rows(_energy(run, start, end), 6),
    }


def _title(said: str) -> str:
    return said[:1].upper() + said[1:]


def _rows(array: Array, digits: int = 9) -> list[list[Any]]:
    """Return rows of numbers with ``digits`` significant digits; times, in the first column, keep twelve."""
    return [[float(f"{x:.{12 if k == 0 else digits}g}") for k, x in enumerate(row)] for row in array.tolist()]


def _spans(run: Trajectory, ball: int, start: float, end: float) -> tuple[Any, Array]:
    """Return the log's rows of a ball that concern the time from start to end, and the duration of each."""
    rows = run.log[run.log["ball"] == ball]
    ends = np.append(rows["t"][1:], np.inf)
    keep = (ends > start) & (rows["t"] <= end) & (ends > rows["t"])
    return rows[keep], np.maximum(np.minimum(ends, end) - rows["t"], 0)[keep]


def _pieces(run: Trajectory, ball: int, start: float, end: float) -> Array:
    """Return parabolas (N, 11): t, x, y, z, velocity, acceleration, phase; last bounces are split into short pieces."""
    rows, lasts = _spans(run, ball, start, end)
    counts = np.where(rows["phase"] == BOUNCING, np.clip(4 * RATE * lasts, 64, 2000).astype(int), 1)
    which = np.repeat(np.arange(len(rows)), counts)
    number = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    h = (lasts / counts)[which]
    setup, log = set_up(run.scene), rows[which]
    x, v, _w, _phase = states(setup.world, setup.balls, log, number * h)
    middle, _v, _w, _phase = states(setup.world, setup.balls, log, (number + 0.5) * h)
    last, _v, _w, _phase = states(setup.world, setup.balls, log, (number + 1) * h)
    # Newton: the second difference of a parabola is its acceleration
    with np.errstate(invalid="ignore", divide="ignore"):
        acceleration = np.where(h[:, None] > 0, 4 * (x - 2 * middle + last) / (h * h)[:, None], 0.0)
    # rounding error of a second difference that is zero
    acceleration[np.abs(acceleration) * (h * h)[:, None] < 1e-12 * (np.abs(x) + np.abs(v) * h[:, None])] = 0.0
    still = np.isin(log["phase"], (REST,)) | (log["phase"] >= HELD)
    v, acceleration = np.where(still[:, None], 0.0, v), np.where(still[:, None], 0.0, acceleration)
    x = np.where(still[:, None], log["x"], x)
    if (log["phase"] == BOUNCING).any():  # adjoining chords instead of parabolas
        chord = (log["phase"] == BOUNCING)[:, None] & (h > 0)[:, None]
        v = np.where(chord, (last - x) / np.where(h > 0, h, 1.0)[:, None], v)
        acceleration = np.where(chord, 0.0, acceleration)
    return np.column_stack((log["t"] + number * h, x, v, acceleration, log["phase"]))


def _turns(run: Trajectory, ball: int, start: float, end: float) -> Array:
    """Return orientations (N, 5): t, quaternion; at constant spin only as many as make the direction of rotation unambiguous."""
    rows, lasts = _spans(run, ball, start, end)
    size = np.linalg.norm(rows["w"], axis=1)
    later = np.append(np.linalg.norm(rows["w_before"], axis=1)[1:], 0.0)
    changes = ~np.isin(rows["phase"], (FLIGHT, REST)) & (rows["phase"] < HELD)
    often = np.maximum(np.maximum(size, later) / TURN, np.where(changes, RATE, 0.0))
    counts = 1 + (often * lasts).astype(int)
    which = np.repeat(np.arange(len(rows)), counts)
    number = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    times = np.append(rows["t"][which] + number * (lasts / counts)[which], end)
    times = np.unique(np.clip(times, 0, end))
    return np.column_stack((times, run.orientation(times)[:, ball]))


def _energy(run: Trajectory, start: float, end: float) -> Array:
    """Return energies of all balls (N, 4): t, translational, rotational and potential energy, J."""
    t = steps(run, end)
    t = np.unique(np.append(t[t >= start], start))
    state = run.at(t)
    balls = set_up(run.scene).balls
    moving = np.nansum(balls["mass"] * (state.velocity**2).sum(axis=-1), axis=1) / 2
    moment = balls["kappa"] * balls["mass"] * balls["radius"] ** 2
    turning = np.nansum(moment * (state.spin**2).sum(axis=-1), axis=1) / 2
    height = np.nansum(run.energy(t, each=True), axis=1) - moving - turning
    if run.scene.floor is None:  # the zero of the potential energy is arbitrary
        height -= height.min()
    height[np.abs(height) < 1e-12 * (moving + turning).max()] = 0.0
    return np.column_stack((t, moving, turning, height))


def _events(run: Trajectory, start: float, end: float) -> list[list[Any]]:
    """Return the list of events: t, words, ball, x, y, and whether it is a contact; contacts of two balls are listed once."""
    log = run.log
    rows = log[(log["kind"] != START) & (log["t"] >= start) & (log["t"] <= end)]
    rows = rows[~((rows["kind"] == BALL) & (rows["other"] < rows["ball"]))]
    if len(rows) > MOST_EVENTS:
        met = rows[np.isin(rows["kind"], (WALL, BALL))]
        rows = met[:MOST_EVENTS] if len(met) else rows[:MOST_EVENTS]
    names, walls = run.scene.ball_names, run.scene.wall_names
    found = []
    for row, kind in zip(rows, kind_names(rows), strict=True):
        met = row["kind"] in (WALL, BALL)
        other = (
            names[row["other"]] if row["kind"] == BALL else walls[row["other"]] if row["other"] >= 0 and walls else ""
        )
        said = f"{names[row['ball']]} {HAPPENS.get(kind, kind).format(other)}"
        x, y = (float(f"{value:.6g}") for value in row["x"][:2])
        found.append([float(f"{row['t']:.12g}"), said.rstrip(), int(row["ball"]), x, y, int(met)])
    return found
