"""The event loop compiled, and called: one run with its record, or many runs on all cores."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.engine.arrays import BALLS, LOG, WORLD
from carom.engine.loop import finish, run, start
from carom.engine.resolve import DONE
from carom.engine.users import register_calls
from carom.scene.features import FEATURES

__all__ = ["Engine", "compiled_engine"]


class Engine(NamedTuple):
    """The compiled loop."""

    start: Callable[..., Any]
    run: Callable[..., Any]
    finish: Callable[..., Any]
    many: Callable[..., Any]


@functools.cache
def compiled_engine() -> Engine:
    """The event loop compiled; from the second time on, loaded."""
    import numba
    from numba import from_dtype, types

    from carom.compiled import njit

    world, feature, ball, log = (from_dtype(kind) for kind in (WORLD, FEATURES, BALLS, LOG))
    features, balls, rows = (types.Array(kind, 1, "C") for kind in (feature, ball, log))
    number, whole = types.float64, types.int64
    users = types.Array(whole, 1, "C")
    register_calls()
    answer = types.UniTuple(whole, 4)
    global _start, _run, _finish, _prange  # noqa: PLW0603
    _start = njit(start, signature=number(world, features, balls))
    _run = njit(run, signature=answer(world, features, balls, rows, number, number, whole, users, whole))
    _finish = njit(finish, signature=types.none(world, balls, number))
    _prange = numba.prange
    worlds, many_balls, logs = types.Array(world, 1, "C"), types.Array(ball, 2, "C"), types.Array(log, 2, "C")
    ended = types.Array(whole, 2, "C")
    many = njit(
        _many,
        signature=types.none(worlds, features, many_balls, logs, number, whole, users, whole, ended),
        parallel=True,
    )
    return Engine(_start, _run, _finish, many)


# What ``_many`` calls: the compiled functions, once there are any (a closure over them would not be cached).
_start, _run, _finish = start, run, finish
_prange: Any = range


def _many(
    worlds: Any, features: Any, balls: Any, logs: Any, until: float, most: int, users: Any, keep: int, ended: Any
) -> None:
    """Run every row of ``balls`` (N, B) by itself; ``logs`` (N, M), ``ended`` (N, 3): status, events, rows or ball.

    One world, in an array: a parallel loop takes no single record.
    """
    for n in _prange(balls.shape[0]):
        world = worlds[0]
        slow = _start(world, features, balls[n])
        status, events, rows, ball = _run(world, features, balls[n], logs[n], slow, until, most, users, keep)
        ended[n, 0], ended[n, 1], ended[n, 2] = status, events, rows if ball < 0 else ball
        last = until
        if until == math.inf or status != DONE:  # no end was given, or it was not reached: the last event's time
            last = 0.0
            for k in range(balls.shape[1]):
                last = max(last, balls[n, k].clock)
        _finish(world, balls[n], last)
