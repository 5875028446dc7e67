"""Simulate thousands of short runs of one ball, and return positions at the times of frames.

It is what :func:`carom.simulate` and :meth:`carom.Trajectory.at` do, in one call and without a trajectory for each run; a test
checks that positions are bitwise identical.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FEATURES
from carom.core.jit.compile import array_of, njit, parallel_range, signature
from carom.core.jit.kernel import vector
from carom.core.motion.phases import HELD
from carom.scene.scene import Scene
from carom.simulation.compiled import compiled_engine
from carom.simulation.loop import ALL, QUIET, move_by, run
from carom.simulation.predict import begin, put
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.resolve import DONE
from carom.simulation.setup import set_up

__all__ = ["START", "positions_at"]

Array = NDArray[np.float64]
START = ("x", "y", "v_x", "v_y", "u_x", "u_y", "spin_z")
"""The numbers of a start: position (m), velocity (m/s), slip on the floor (m/s), sidespin (rad/s)."""
LOG_ROWS, MAX_EVENTS = 128, 400  # a segment with a few contacts has a dozen events
BLOCK = 1024  # runs in one call, whose logs are in memory at once

# What ``_run_all`` calls: the compiled loop, once there is one (a closure over it would not be cached).
_run: Any = run
_prange: Any = range


def _run_all(
    worlds: Any, features: Any, which: Any, balls: Any, logs: Any, users: Any, time: Any, count: Any, places: Any
) -> None:
    """Run every ball (N, 1) in its world, and write its position at the first ``count`` (N,) of its times (N, T)."""
    for n in _prange(balls.shape[0]):
        k, log = which[n], logs[n]
        world = worlds[k]
        until = time[n, count[n] - 1]
        ended, _events, rows, _ball, _slow, last = _run(
            worlds[k : k + 1], features[k], balls[n], log, -1.0, until, MAX_EVENTS, users, ALL
        )
        known = until if ended in (DONE, QUIET) else last  # else the law is undefined, or events accumulate
        ball, row = balls[n, 0], 0
        for i in range(count[n]):
            t = time[n, i]
            while row + 1 < rows and log[row + 1].t <= t:
                row += 1
            ball.phase = log[row].phase
            if t <= known and ball.phase < HELD:
                put(ball.x, vector(log[row].x))
                put(ball.v, vector(log[row].v))
                put(ball.w, vector(log[row].w))
                begin(world, ball)
                move_by(world, ball, t - log[row].t, t)
                places[n, i, 0], places[n, i, 1] = ball.x[0], ball.x[1]


@functools.cache
def _compiled() -> Callable[..., None]:
    """Return the compiled loop over runs, on all cores."""
    global _run, _prange
    _run, _prange = compiled_engine().run, parallel_range()
    loop = signature(
        None, array_of(WORLD), array_of(FEATURES, 2), array_of(int), array_of(BALLS, 2), array_of(LOG, 2), array_of(int),
        array_of(float, 2), array_of(int), array_of(float, 3),
    )  # fmt: skip
    return njit(_run_all, signature=loop, parallel=True)


def positions_at(
    scenes: Sequence[Scene], which: NDArray[np.int64], start: Array, time: Array, count: NDArray[np.int64]
) -> Array:
    """Return positions (N, T, 2) of N runs of one ball each, m; NaN beyond a run's frames, and where its law is undefined.

    ``scenes`` (K) differ in numbers only, not in their features; ``which`` (N,) is the scene of each run, ``start`` (N, 7) as START
    says, ``time`` (N, T) are s since the start, of which ``count`` (N,) are evaluated.
    """
    made = [set_up(scene) for scene in scenes]
    n = len(start)
    balls = np.repeat(made[0].balls[:1], n)
    a = balls["radius"]
    x, v, u = start[:, :2], start[:, 2:4], start[:, 4:6]
    balls["x"] = np.column_stack([x, a])
    balls["v"] = np.column_stack([v, np.zeros(n)])
    # the slip is u = v + w x (-a z) = (v_x - a w_y, v_y + a w_x)
    balls["w"] = np.column_stack([(u[:, 1] - v[:, 1]) / a, (v[:, 0] - u[:, 0]) / a, start[:, 6]])
    places = np.full((n, time.shape[1], 2), np.nan)
    worlds, features = np.concatenate([one.world for one in made]), np.stack([one.features for one in made])
    logs = np.empty((min(n, BLOCK), LOG_ROWS), LOG)
    for low in range(0, n, BLOCK):
        some = slice(low, min(low + BLOCK, n))
        _compiled()(
            worlds, features, which[some], balls[some, None], logs[: some.stop - low], made[0].users, time[some], count[some],
            places[some],
        )  # fmt: skip
    return places
