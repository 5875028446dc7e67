"""Compile the event loop: for one run with its log, and for many runs on all cores."""

from __future__ import annotations

import contextlib
import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.core.geometry.circles import rim_hit
from carom.core.geometry.features import FEATURES, RIM
from carom.core.jit.background import compile_in_background
from carom.core.jit.compile import array_of, cache_folder, njit, parallel_range, signature
from carom.laws.callbacks import register_calls
from carom.scene.scene import Scene
from carom.simulation.loop import LIMIT, QUIET, finish, run
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.resolve import DONE
from carom.simulation.wall_and_floor import PART, register_joint_impact

__all__ = [
    "ENGINE_RUN",
    "Engine",
    "compiled_before",
    "compiled_engine",
    "compiled_many",
    "is_loaded",
    "loops_of",
    "plain_engine",
]


class Engine(NamedTuple):
    """The compiled loop."""

    run: Callable[..., Any]
    finish: Callable[..., Any]


# What the loop and its end return, and what they take.
ENGINE_END = (None, array_of(WORLD), array_of(BALLS), float)
ENGINE_RUN = (
    (int, int, int, int, float, float),
    *(array_of(kind) for kind in (WORLD, FEATURES, BALLS, LOG)), float, float, int, array_of(int), int,
)  # fmt: skip


@functools.cache
def compiled_engine() -> Engine:
    """Return the compiled event loop; from the second time on it is loaded from the cache."""
    register_calls()
    register_joint_impact()
    with contextlib.nullcontext() if compiled_before() else compile_in_background(PART):
        # (nothing is made in the loop: no counting of who holds an array)
        return Engine(
            njit(_one_run, signature=signature(*ENGINE_RUN), _nrt=False),
            njit(_one_end, signature=signature(*ENGINE_END), _nrt=False),
        )


def plain_engine() -> Engine:
    """Return the entries of the event loop as functions that are not compiled."""
    return Engine(_one_run, _one_end)


def is_loaded() -> bool:
    """Return whether this process has the compiled loop at hand."""
    return compiled_engine.cache_info().currsize > 0


def loops_of(scene: Scene) -> tuple[Callable[..., Any], ...]:
    """Return the functions that are compiled for a scene: their names tell how much there is to compile."""
    return (run, finish, *((rim_hit,) if _has_rims(scene) else ()))


def _has_rims(scene: Scene) -> bool:
    return any(feature.kind == RIM for wall in scene.walls for feature in wall.features())


def compiled_before(scene: Scene | None = None) -> bool:
    """Return whether the compiled loop is in the cache (what is compiled last is), and rims, if the scene has any."""
    rims = scene is not None and _has_rims(scene)
    wanted = ["compiled._one_end", "circles.rim_entry"] if rims else ["compiled._one_end"]
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
    """Return the compiled loop over many runs, which uses all cores."""
    global _run, _finish, _prange  # noqa: PLW0603
    _run, _finish = compiled_engine()
    _prange = parallel_range()
    features, users, ended = array_of(FEATURES), array_of(int), array_of(int, 2)
    many = signature(
        None,
        array_of(WORLD),
        features,
        array_of(BALLS, 2),
        array_of(LOG, 2),
        array_of(float),
        float,
        int,
        int,
        users,
        int,
        ended,
    )
    return njit(_many, signature=many, parallel=True)


# What ``_many`` calls: the compiled functions, once there are any (a closure over them would not be cached).
_run, _finish = _one_run, _one_end
_prange: Any = range


def _many(
    worlds: Any, features: Any, balls: Any, logs: Any, slow: Any, until: float, most: int, share: int, users: Any, keep: int,
    ended: Any,
) -> None:  # fmt: skip
    """Run every row of ``balls`` (N, B) by itself, for at most ``share`` more events; ``logs`` (N, M), ``slow`` (N,) as in run.

    ``ended`` (N, 3): status, events, rows so far. A run goes on while its status is LIMIT, with fewer than ``most`` events.
    """
    for n in _prange(balls.shape[0]):
        before, written = ended[n, 1], ended[n, 2]
        if ended[n, 0] == LIMIT and before < most:
            status, events, rows, _ball, slow[n], last = _run(
                worlds, features, balls[n], logs[n][written:], slow[n], until, min(share, most - before), users, keep
            )
            ended[n, 0], ended[n, 1], ended[n, 2] = status, before + events, written + rows
            if status != LIMIT or before + events >= most:
                # (no end was given, or it was not reached: the last event's time)
                _finish(worlds, balls[n], until if until < math.inf and status in (DONE, QUIET) else last)
