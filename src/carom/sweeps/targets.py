"""Targets of a shot: a place, a pocket, balls to be hit after so many cushions; found in the logs of many runs, and in one run.

What a shot misses by is a number that varies smoothly with its start while the sequence of events stays: for a ball that is to be
hit, the impact parameter (offset of the balls' centres across their relative motion); for a pocket, that of the ball and the
pocket's centre; for a place, the distance along x and y. The speed with which a ball comes there may be a second one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from carom.errors import CaromError, did_you_mean
from carom.scene.paths import ball_index
from carom.scene.scene import Scene
from carom.scene.schema import Model
from carom.simulation.records import BALL, POCKETED_EVENT, WALL

__all__ = ["EVENTS", "Target", "TargetEvent", "find", "misses", "residual", "targets_of"]

Array = NDArray[np.float64]
WHERE = "aim: reach"
# Kinds of events among which targets are looked for.
EVENTS = (WALL, BALL, POCKETED_EVENT)


class Target(Model):
    """What a ball is to reach: one of ``point``, ``pocket`` and ``hit``.

    Parameters
    ----------
    ball : number or name of the ball; default: 0
    point : (x, y), m, where it is to end
    within : m: how far from there it may end; default: its radius
    pocket : name of a pocket, or "any"
    hit : number or name of a ball that it is to touch, or several of them, in any order
    cushions : number of cushions that it touches before the last of them, at least; default: 0
    speed : m/s, with which it comes to the ball or the pocket; default: any
    speed_within : m/s: by how much the speed may be another; default: a tenth of it
    """

    ball: int | str = 0
    point: tuple[float, float] | None = None
    within: float | None = None
    pocket: str | None = None
    hit: int | str | tuple[int | str, ...] | None = None
    cushions: int = 0
    speed: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    speed_within: float | None = Field(default=None, gt=0, allow_inf_nan=False)

    @model_validator(mode="after")
    def _one_aim(self) -> Target:
        if sum(one is not None for one in (self.point, self.pocket, self.hit)) != 1:
            raise ValueError("expected one of point, pocket and hit")
        if self.cushions and self.hit is None:
            raise ValueError("expected cushions with hit only")
        if self.speed is not None and self.point is not None:
            raise ValueError("expected speed with hit or pocket: at its place the ball ends at rest")
        if self.speed_within is not None and self.speed is None:
            raise ValueError("expected speed_within with speed only")
        return self


class TargetEvent(NamedTuple):
    """A target in numbers of a scene."""

    kind: Literal["point", "pocket", "hit"]
    ball: int
    others: tuple[int, ...]
    """Balls to be hit; or pockets that will do."""
    cushions: int
    point: tuple[float, float]
    windows: tuple[float, ...]
    """What each number of the residual may be, at most."""
    centers: Array
    """Of all pockets, (P, 2)."""
    speed: float | None = None
    """With which the ball comes there, m/s."""

    @property
    def units(self) -> tuple[str, ...]:
        """Of each number of the residual."""
        return ("m", "m") if self.kind == "point" else ("m", "m/s")[: len(self.windows)]


def targets_of(scene: Scene, reach: Any) -> list[TargetEvent]:
    """Return targets in numbers. CaromError for balls and pockets that are not there, all at once."""
    found: list[TargetEvent] = []
    faults: list[str] = []
    given = [reach] if isinstance(reach, Mapping | Target) else list(reach)
    for k, one in enumerate(given):
        where = WHERE if len(given) == 1 else f"{WHERE}[{k}]"
        try:
            target = one if isinstance(one, Target) else Target(**dict(one))
            found.append(_event_of(scene, target, where))
        except CaromError as error:
            faults += [fault.replace("Target:", f"{where}:", 1) for fault in error.faults]
    if not given:
        faults.append(f"{WHERE}: expected a target such as {{'ball': 0, 'hit': 1}}, got none")
    if faults:
        raise CaromError(*faults)
    return found


def _event_of(scene: Scene, target: Target, where: str) -> TargetEvent:
    ball = ball_index(scene, target.ball, f"{where}: ball")
    radius = scene.balls[ball].radius
    pockets = [pocket for wall in scene.walls for pocket in wall.pockets]
    centers = np.array([pocket.center for pocket in pockets]).reshape(-1, 2)
    point, none, speed = target.point or (0.0, 0.0), np.zeros((0, 2)), target.speed
    more = () if speed is None else (target.speed_within or speed / 10,)
    if target.point is not None:
        return TargetEvent("point", ball, (), 0, point, (target.within or radius,) * 2, none)
    if target.pocket is not None:
        wanted = [k for k, pocket in enumerate(pockets) if target.pocket in ("any", pocket.name)]
        if not wanted:
            if not pockets:
                raise CaromError(
                    f"{where}: pocket: expected a table with pockets, got a scene without; aim at a ball or a place"
                )
            names = ["any", *(pocket.name for pocket in pockets)]
            near = did_you_mean(target.pocket, names)
            raise CaromError(f"{where}: pocket: expected one of {', '.join(names)}, got {target.pocket!r:.60}{near}")
        width = min(pockets[k].radius for k in wanted)
        return TargetEvent("pocket", ball, tuple(wanted), 0, point, (width, *more), centers, speed)
    assert target.hit is not None
    hits = target.hit if isinstance(target.hit, tuple) else (target.hit,)
    others = tuple(ball_index(scene, one, f"{where}: hit") for one in hits)
    if ball in others:
        raise CaromError(
            f"{where}: hit: expected balls other than the one that hits them, got {scene.ball_names[ball]} itself"
        )
    width = radius + min(scene.balls[k].radius for k in others)
    return TargetEvent("hit", ball, others, target.cushions, point, (width, *more), none, speed)


# --- in logs ----------------------------------------------------------------------------------------------------------


def find(target: TargetEvent, log: NDArray[np.void]) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return which of N runs reach a target, and the row of the event at which they do, for logs (N, M).

    Rows are of walls, balls and pockets; a meeting of two balls has two rows, one for each, one after the other. A place has no
    event: all runs reach it somewhere.
    """
    count, width = log.shape
    if target.kind == "point" or width == 0:
        return np.full(count, target.kind == "point"), np.full(count, -1)
    mine = log["ball"] == target.ball
    far = width + 1
    if target.kind == "pocket":
        there = (log["kind"] == POCKETED_EVENT) & mine & np.isin(log["other"], target.others)
        row = np.where(there.any(axis=1), there.argmax(axis=1), far)
    else:
        row = np.zeros(count, np.int64)
        for other in target.others:
            there = (log["kind"] == BALL) & mine & (log["other"] == other)
            row = np.maximum(row, np.where(there.any(axis=1), there.argmax(axis=1), far))
        cushions = ((log["kind"] == WALL) & mine).cumsum(axis=1)
        before = cushions[np.arange(count), np.minimum(row, width - 1)]
        row = np.where(before >= target.cushions, row, far)
    return row < far, np.where(row < far, row, -1)


def misses(target: TargetEvent, log: NDArray[np.void], rows: NDArray[np.int64], final: Array) -> Array:
    """Return by what N runs miss a target, as shares of what is allowed: (N,); infinite where it is not reached.

    ``final`` (N, 3): the ball's final places.
    """
    if target.kind == "point":
        apart = final[:, :2] - np.array(target.point)
        return np.asarray(np.linalg.norm(apart, axis=1) / target.windows[0])
    found = np.full(len(log), np.inf)
    n = np.flatnonzero(rows >= 0)
    own = log[n, rows[n]]
    if target.kind == "pocket":
        r, u = target.centers[own["other"]] - own["x"][:, :2], own["v_before"][:, :2]
    else:
        after = np.minimum(rows[n] + 1, log.shape[1] - 1)
        other = np.where((log[n, after]["ball"] == own["other"]) & (log[n, after]["t"] == own["t"]), after, rows[n] - 1)
        met = log[n, other]
        r, u = (met["x"] - own["x"])[:, :2], (own["v_before"] - met["v_before"])[:, :2]
    found[n] = np.abs(r[:, 0] * u[:, 1] - r[:, 1] * u[:, 0]) / np.hypot(u[:, 0], u[:, 1]) / target.windows[0]
    if target.speed is not None:
        off = np.abs(np.hypot(own["v_before"][:, 0], own["v_before"][:, 1]) - target.speed)
        found[n] = np.maximum(found[n], off / target.windows[1])
    return found


# --- in one run -------------------------------------------------------------------------------------------------------


def residual(target: TargetEvent, run: Any, row: int, derivatives: Any) -> tuple[Array, Array]:
    """Return by what a run misses a target, as shares of what is allowed (R,), and its derivatives (R, p).

    ``row``: of the target's event among the log's rows of walls, balls and pockets; ``derivatives``: the run's sensitivity.
    """
    if target.kind == "point":
        at = run.final.position[target.ball, :2]
        return (at - np.array(target.point)) / target.windows[0], derivatives.final.position[
            target.ball, :2
        ] / target.windows[0]
    log = run.log
    k = int(np.flatnonzero(np.isin(log["kind"], EVENTS))[row])
    x, dx, v, dv = _arrival(run, k, derivatives)
    if target.kind == "pocket":
        r, u, dr, du = target.centers[int(log["other"][k])] - x, v, -dx, dv
    else:
        # (a meeting of two balls has two rows, one after the other)
        after = k + 1 < len(log) and log["ball"][k + 1] == log["other"][k] and log["t"][k + 1] == log["t"][k]
        y, dy, w, dw = _arrival(run, k + 1 if after else k - 1, derivatives)
        r, u, dr, du = y - x, v - w, dy - dx, dv - dw
    size = math.hypot(*u)
    b = (r[0] * u[1] - r[1] * u[0]) / size
    cross = dr[0] * u[1] - dr[1] * u[0] + r[0] * du[1] - r[1] * du[0]
    db = cross / size - b * (u[0] * du[0] + u[1] * du[1]) / size**2
    miss, slopes = [b], [db]
    if target.speed is not None:
        speed = math.hypot(*v)
        miss, slopes = [b, speed - target.speed], [db, (v[0] * dv[0] + v[1] * dv[1]) / speed]
    windows = np.array(target.windows)
    return np.array(miss) / windows, np.stack(slopes) / windows[:, None]


def _arrival(run: Any, k: int, derivatives: Any) -> tuple[Array, Array, Array, Array]:
    """Return place and velocity (2,) with which the ball of a row comes to its event, and their derivatives (2, p) there."""
    row, event = run.log[k], derivatives.events[k - len(run.scene.balls)]
    return row["x"][:2], event.position[:2], row["v_before"][:2], event.velocity_before[:2]
