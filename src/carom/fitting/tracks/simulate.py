"""Simulate thousands of short runs of one ball, and return positions at the times of frames, and their derivatives.

It is what :func:`carom.simulate`, :meth:`carom.Trajectory.at` and ``run.sensitivity`` do, in one call and without a trajectory for
each run; tests check that positions are bitwise identical.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FEATURES
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.core.jit.kernel import prange, vector
from carom.core.jit.pointers import caller_of, compiled_address
from carom.core.jit.slices import block_slices
from carom.core.jit.threads import call_in_threads, thread_count
from carom.core.motion.phases import HELD
from carom.simulation.compiled import ENGINE_RUN, compiled_engine
from carom.simulation.contacts.contact import DONE
from carom.simulation.event_rows import ALL
from carom.simulation.loop import QUIET
from carom.simulation.predict import begin_phase, move_by, write_vector
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.sensitivity.compiled import FOLLOW, SLOPES, STATES, compiled_follow, compiled_states
from carom.simulation.sensitivity.pass_kernels import PASSAGES
from carom.simulation.setup import SceneArrays

__all__ = ["START", "Slopes", "compile_tracks", "positions_and_slopes", "positions_at", "start_slopes"]

Array = NDArray[np.float64]
Slopes = dict[str, Array]
START = ("x", "y", "v_x", "v_y", "u_x", "u_y", "spin_z")
"""The numbers of a start: position (m), velocity (m/s), slip on the floor (m/s), sidespin (rad/s)."""
LOG_ROWS, MAX_EVENTS = 128, 400  # a segment with a few contacts has a dozen events
BLOCK = 1024  # runs in one call, whose logs are in memory at once
RUNS_A_THREAD = 16  # at least: fewer are done before another thread has begun
X = float_places(BALLS)["x"].start

# The compiled functions, called through their addresses, once there are any.
_call_run: Any = None
_call_follow: Any = None
_call_states: Any = None


def _run_all(
    functions: Any, worlds: Any, features: Any, balls: Any, logs: Any, users: Any, time: Any, count: Any, places: Any
) -> None:
    """Run every ball (N, 1), and write its position at the first ``count`` (N,) of its times (N, T)."""
    for n in prange(balls.shape[0]):
        log, until = logs[n], time[n, count[n] - 1]
        ended, _events, rows, _ball, _slow, last = _call_run(
            functions[0], (worlds, features, balls[n], log, -1.0, until, MAX_EVENTS, users, ALL)
        )
        known = until if ended in (DONE, QUIET) else last  # else the law is undefined, or events accumulate
        ball, row, world = balls[n, 0], 0, worlds[0]
        for i in range(count[n]):
            t = time[n, i]
            while row + 1 < rows and log[row + 1].t <= t:
                row += 1
            ball.phase = log[row].phase
            if t <= known and ball.phase < HELD:
                write_vector(ball.x, vector(log[row].x))
                write_vector(ball.v, vector(log[row].v))
                write_vector(ball.w, vector(log[row].w))
                begin_phase(world, ball)
                move_by(world, ball, t - log[row].t, t)
                places[n, i, 0], places[n, i, 1] = ball.x[0], ball.x[1]


def _follow_all(
    functions: Any, worlds: Any, world_d: Any, features: Any, features_d: Any, starts: Any, balls_d: Any,
    users: Any, laws: Any, time: Any, count: Any, log: Any, out: Any, out_d: Any, ball: Any, at: Any, places: Any, slopes: Any,
) -> None:  # fmt: skip
    """As :func:`_run_all`, one after the other, with derivatives ``slopes`` (N, T, 2, C LANES), 0 from a graze on.

    ``balls_d`` (N, C, 1, numbers, LANES): of the starts; they are written over. ``log`` and ``out`` (M,), ``out_d`` (C, M, numbers,
    LANES), ``ball`` and ``at`` (1,) are for one run at a time. ``functions`` (3,): addresses of what is called.
    """
    for n in range(starts.shape[0]):
        until, slope = time[n, count[n] - 1], balls_d[n]
        ball[0] = starts[n, 0]
        ended, _events, rows, _ball, _slow, last = _call_run(
            functions[0], (worlds, features, ball, log, -1.0, until, MAX_EVENTS, users, ALL)
        )
        known, rows_of = until if ended in (DONE, QUIET) else last, log[:rows]
        graze = _call_follow(
            functions[1],
            (worlds, world_d, features, features_d, starts[n], slope, ball, rows_of, laws, known, out, out_d),
        )
        row = 0
        for i in range(count[n]):
            t = time[n, i]
            while row + 1 < rows and log[row + 1].t <= t:
                row += 1
            if t <= known and log[row].phase < HELD:
                at[0] = row
                _call_states(functions[2], (worlds, world_d, starts[n], slope, rows_of, at, out, out_d, t, ball, slope))
                places[n, i, 0], places[n, i, 1] = ball[0].x[0], ball[0].x[1]
                if graze < 0 or row < graze:
                    for c in range(slope.shape[0]):
                        for k in range(2):
                            for lane in range(LANES):
                                slopes[n, i, k, c * LANES + lane] = slope[c, 0, X + k, lane]


@functools.cache
def _declare_calls() -> None:
    """Tell the compiler what the loops call by address."""
    global _call_run, _call_follow, _call_states
    _call_run, _call_follow, _call_states = caller_of(*ENGINE_RUN), caller_of(*FOLLOW), caller_of(*STATES)


@functools.cache
def _compiled() -> Callable[..., None]:
    """Return the compiled loop over runs, on all cores."""
    addresses = np.array([compiled_address(compiled_engine().run)])
    loop = signature(
        None, array_of(int), array_of(WORLD), array_of(FEATURES), array_of(BALLS, 2), array_of(LOG, 2), array_of(int),
        array_of(float, 2), array_of(int), array_of(float, 3),
    )  # fmt: skip
    return functools.partial(njit(_run_all, loop, (_declare_calls,), parallel=True), addresses)


@functools.cache
def _compiled_with_slopes() -> Callable[..., None]:
    """Return the compiled loop over runs with their derivatives, for one thread."""
    addresses = np.array(
        [compiled_address(one) for one in (compiled_engine().run, compiled_follow(), compiled_states())]
    )
    loop = signature(
        None, array_of(int), array_of(WORLD), SLOPES, array_of(FEATURES), SLOPES, array_of(BALLS, 2), array_of(float, 5),
        array_of(int), array_of(int), array_of(float, 2), array_of(int), array_of(LOG), array_of(PASSAGES), SLOPES, array_of(BALLS),
        array_of(int), array_of(float, 3), array_of(float, 4),
    )  # fmt: skip
    return functools.partial(njit(_follow_all, loop, (_declare_calls,), nogil=True), addresses)


def compile_tracks() -> None:
    """Compile both loops, or load them from the cache."""
    _compiled()
    _compiled_with_slopes()


def _balls(arrays: SceneArrays, start: Array) -> NDArray[np.void]:
    """Return the balls (N, 1) of starts (N, 7)."""
    n = len(start)
    balls = np.repeat(arrays.balls[:1], n)
    a = balls["radius"]
    x, v, u = start[:, :2], start[:, 2:4], start[:, 4:6]
    balls["x"] = np.column_stack([x, a])
    balls["v"] = np.column_stack([v, np.zeros(n)])
    # the slip is u = v + w x (-a z) = (v_x - a w_y, v_y + a w_x)
    balls["w"] = np.column_stack([(u[:, 1] - v[:, 1]) / a, (v[:, 0] - u[:, 0]) / a, start[:, 6]])
    return np.asarray(balls[:, None])


def start_slopes(radius: float) -> Array:
    """Return the derivatives (numbers of a ball, 7) of a ball with respect to its start."""
    found, x, v, w = np.zeros((float_count(BALLS), len(START))), *(float_places(BALLS)[name].start for name in "xvw")
    for k, name in enumerate(START):
        place = {"x": x, "y": x + 1, "v_x": v, "v_y": v + 1, "spin_z": w + 2}.get(name)
        if place is not None:
            found[place, k] = 1.0
    found[w, START.index("u_y")] = found[w + 1, START.index("v_x")] = 1 / radius
    found[w, START.index("v_y")] = found[w + 1, START.index("u_x")] = -1 / radius
    return found


def positions_at(arrays: SceneArrays, start: Array, time: Array, count: NDArray[np.int64]) -> Array:
    """Return positions (N, T, 2) of N runs of one ball each, m; NaN beyond a run's frames, and where its law is undefined.

    ``start`` (N, 7) as START says, ``time`` (N, T) are s since the start, of which ``count`` (N,) are evaluated.
    """
    balls, n = _balls(arrays, start), len(start)
    places = np.full((n, time.shape[1], 2), np.nan)
    logs = np.empty((min(n, BLOCK), LOG_ROWS), LOG)
    for some in block_slices(n, BLOCK):
        _compiled()(
            arrays.world, arrays.features, balls[some], logs[: some.stop - some.start], arrays.users, time[some], count[some],
            places[some],
        )  # fmt: skip
    return places


def positions_and_slopes(
    arrays: SceneArrays, duals: NDArray[np.int64], start: Array, time: Array, count: NDArray[np.int64], by_scene: Slopes,
    by_start: Array,
) -> tuple[Array, Array]:  # fmt: skip
    """Return positions as :func:`positions_at`, and their exact derivatives (N, T, 2, C LANES); 0 from a graze on.

    ``duals``: laws that are called by address, of dual numbers. ``by_scene``: derivatives of the world (C, 1, numbers, LANES) and
    of the features (C, F, numbers, LANES); ``by_start`` (N, C, 1, numbers, LANES): of the balls.
    """
    n, chunks, frames, numbers = len(start), by_start.shape[1], time.shape[1], float_count(PASSAGES)
    balls, by_start = _balls(arrays, start), by_start.copy()
    places, slopes = np.full((n, frames, 2), np.nan), np.zeros((n, frames, 2, chunks * LANES))
    loop = _compiled_with_slopes()

    def part(some: slice) -> None:
        loop(
            arrays.world, by_scene["world"], arrays.features, by_scene["features"], balls[some], by_start[some],
            arrays.users, duals, time[some], count[some], np.empty(LOG_ROWS, LOG), np.empty(LOG_ROWS, PASSAGES),
            np.empty((chunks, LOG_ROWS, numbers, LANES)), np.empty(1, BALLS), np.zeros(1, np.int64), places[some], slopes[some],
        )  # fmt: skip

    edges = np.linspace(0, n, min(1 + n // RUNS_A_THREAD, thread_count()) + 1).astype(int)
    parts = [slice(*pair) for pair in pairwise(edges.tolist())]
    call_in_threads(part, parts)
    return places, slopes
