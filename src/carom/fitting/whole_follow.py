"""Whole tracks simulated: the event loop itself, from many starts under many laws, and the places at the frames.

It is what :func:`carom.simulate` and :meth:`carom.Trajectory.at` do, for thousands of short runs in one call, without a
trajectory for each; a test holds the two to the same places.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.compiled import njit
from carom.engine.arrays import BALLS, LOG, WORLD
from carom.engine.loop import ALL, QUIET, move_by, run
from carom.engine.predict import begin, put
from carom.engine.resolve import DONE
from carom.engine.run import compiled_engine
from carom.engine.setup import set_up
from carom.kernel import vector
from carom.motion.phases import HELD
from carom.scene.features import FEATURES
from carom.scene.model import Scene

__all__ = ["START", "follow"]

Array = NDArray[np.float64]
START = ("x", "y", "v_x", "v_y", "u_x", "u_y", "spin_z")
"""A start: place (m), velocity (m/s), slip on the floor (m/s), sidespin (rad/s)."""
ROWS, MOST = 128, 400  # of a log; events: a leg of a few contacts has a dozen
BLOCK = 1024  # runs in one call, whose logs are kept the while

# What ``_follow`` calls: the compiled loop, once there is one (a closure over it would not be cached).
_run: Any = run
_prange: Any = range


def _follow(
    worlds: Any, features: Any, which: Any, balls: Any, logs: Any, users: Any, time: Any, count: Any, places: Any
) -> None:
    """Run every ball (N, 1) in its world, and write where it is at the first ``count`` (N,) of its times (N, T)."""
    for n in _prange(balls.shape[0]):
        k, log = which[n], logs[n]
        world = worlds[k]
        until = time[n, count[n] - 1]
        ended, _events, rows, _ball, _slow, last = _run(
            worlds[k : k + 1], features[k], balls[n], log, -1.0, until, MOST, users, ALL
        )
        known = until if ended in (DONE, QUIET) else last  # else a law has no answer, or there is no end of events
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
    """The loop over runs, on all cores."""
    import numba
    from numba import from_dtype, types

    global _run, _prange
    _run, _prange = compiled_engine().run, numba.prange
    world, feature, ball, log = (from_dtype(kind) for kind in (WORLD, FEATURES, BALLS, LOG))
    number, whole = types.float64, types.int64

    def array(kind: Any, d: int) -> Any:
        return types.Array(kind, d, "C")

    signature = types.none(
        array(world, 1), array(feature, 2), array(whole, 1), array(ball, 2), array(log, 2), array(whole, 1), array(number, 2),
        array(whole, 1), array(number, 3),
    )  # fmt: skip
    return njit(_follow, signature=signature, parallel=True)


def follow(
    scenes: Sequence[Scene], which: NDArray[np.int64], start: Array, time: Array, count: NDArray[np.int64]
) -> Array:
    """Places (N, T, 2) of N runs of one ball each, m; NaN beyond a run's frames, and where its law has no answer.

    ``scenes`` (K) differ in numbers only, not in how many features they have; ``which`` (N,) is the scene of each run, ``start``
    (N, 7) is as START says, ``time`` (N, T) are s since the start, of which ``count`` (N,) are looked at.
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
    logs = np.empty((min(n, BLOCK), ROWS), LOG)
    for low in range(0, n, BLOCK):
        some = slice(low, min(low + BLOCK, n))
        _compiled()(
            worlds, features, which[some], balls[some, None], logs[: some.stop - low], made[0].users, time[some], count[some],
            places[some],
        )  # fmt: skip
    return places
