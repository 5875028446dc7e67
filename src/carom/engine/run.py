"""The event loop compiled, and called: one run with its record, or many runs on all cores."""

from __future__ import annotations

import contextlib
import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.beside import beside
from carom.engine.arrays import BALLS, LOG, WORLD
from carom.engine.loop import QUIET, finish, run
from carom.engine.pressed import PART, register_pressed
from carom.engine.resolve import DONE
from carom.engine.users import register_calls
from carom.scene.features import FEATURES, RIM
from carom.scene.model import Scene

__all__ = ["Engine", "compiled_before", "compiled_engine", "compiled_many"]


class Engine(NamedTuple):
    """The compiled loop."""

    run: Callable[..., Any]
    finish: Callable[..., Any]


def _types() -> tuple[Any, ...]:
    """What the compiler calls a world, features, balls, a log; a float, a whole number, a list of those."""
    from numba import from_dtype, types

    world, feature, ball, log = (from_dtype(kind) for kind in (WORLD, FEATURES, BALLS, LOG))
    return world, types.Array(feature, 1, "C"), ball, log, types.float64, types.int64, types.Array(types.int64, 1, "C")


@functools.cache
def compiled_engine() -> Engine:
    """The event loop compiled; from the second time on, loaded."""
    from numba import types

    from carom.compiled import njit

    register_calls()
    register_pressed()
    world, features, ball, log, number, whole, users = _types()
    worlds, balls, rows = (types.Array(kind, 1, "C") for kind in (world, ball, log))
    answer = types.Tuple([whole] * 4 + [number] * 2)
    loop = answer(worlds, features, balls, rows, number, number, whole, users, whole)
    with contextlib.nullcontext() if compiled_before() else beside(PART):
        # (nothing is made in the loop: no counting of who holds an array)
        return Engine(
            njit(_one_run, signature=loop, _nrt=False),
            njit(_one_end, signature=types.none(worlds, balls, number), _nrt=False),
        )


def compiled_before(scene: Scene | None = None) -> bool:
    """Whether the loop lies compiled in the cache (what is compiled last is there), and rims, if the scene has any."""
    from carom.compiled import cache_folder

    rims = scene is not None and any(feature.kind == RIM for wall in scene.walls for feature in wall.features())
    wanted = ["run._one_end", "rims._entry"] if rims else ["run._one_end"]
    return all(any(cache_folder().glob(f"*/{name}-*.nbi")) for name in wanted)


# Entries, and nothing else: what is called from Python is compiled with other flags, and so would be all that it calls, which
# its kernels call too.
# (One world, in an array: a single record takes 1.5 us to hand over, an array 0.1.)
def _one_run(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    return run(worlds[0], features, balls, log, slow, until, most, users, keep)


def _one_end(worlds: Any, balls: Any, t: float) -> None:
    finish(worlds[0], balls, t)


@functools.cache
def compiled_many() -> Callable[..., Any]:
    """The loop over many runs, on all cores; compiled for those who ask for it."""
    import numba
    from numba import types

    from carom.compiled import njit

    global _run, _finish, _prange  # noqa: PLW0603
    _run, _finish = compiled_engine()
    _prange = numba.prange
    world, features, ball, log, number, whole, users = _types()
    worlds, balls, logs, ended = (
        types.Array(kind, d, "C") for kind, d in ((world, 1), (ball, 2), (log, 2), (whole, 2))
    )
    signature = types.none(worlds, features, balls, logs, number, whole, users, whole, ended)
    return njit(_many, signature=signature, parallel=True)


# What ``_many`` calls: the compiled functions, once there are any (a closure over them would not be cached).
_run, _finish = _one_run, _one_end
_prange: Any = range


def _many(
    worlds: Any, features: Any, balls: Any, logs: Any, until: float, most: int, users: Any, keep: int, ended: Any
) -> None:
    """Run every row of ``balls`` (N, B) by itself; ``logs`` (N, M), ``ended`` (N, 3): status, events, rows or ball."""
    for n in _prange(balls.shape[0]):
        status, events, rows, ball, _slow, last = _run(
            worlds, features, balls[n], logs[n], -1.0, until, most, users, keep
        )
        ended[n, 0], ended[n, 1], ended[n, 2] = status, events, rows if ball < 0 else ball
        # (no end was given, or it was not reached: the last event's time)
        _finish(worlds, balls[n], until if until < math.inf and status in (DONE, QUIET) else last)
