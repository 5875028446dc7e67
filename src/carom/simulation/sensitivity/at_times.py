"""Many runs from given starts, each with its states at the times of frames, and with the exact derivatives of these.

It is what :func:`carom.simulate`, :meth:`carom.Trajectory.at` and ``run.sensitivity`` do, in one call, without a scene or a
trajectory for each run; tests check that states are bitwise identical.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FEATURES
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.dual.dual_records import float_count
from carom.core.jit.dual.numbers import LANES
from carom.core.jit.kernel import kernel, prange, vector
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

__all__ = ["Limits", "Slopes", "StatesAndSlopes", "compile_at_times", "states_and_slopes", "states_at"]

Array = NDArray[np.float64]
Slopes = dict[str, Array]
BLOCK = 1024  # runs in one call, whose logs are in memory at once
RUNS_A_THREAD = 16  # at least: fewer are done before another thread has begun

# The compiled functions, called through their addresses, once there are any.
_call_run: Any = None
_call_follow: Any = None
_call_states: Any = None


class Limits(NamedTuple):
    """How long a run may be."""

    rows: int = 128
    """Of its log; a run that writes more is known until then."""
    events: int = 400


SEGMENT = Limits()


class StatesAndSlopes(NamedTuple):
    """States of N runs of B balls at T times, and their derivatives."""

    states: Array
    """(N, T, B, 9): position, velocity, spin; NaN beyond a run's times, and where it is not known."""
    slopes: Array
    """(N, C, T, B, K, LANES): of the first K numbers of a state."""


@kernel
def _rows_at(log: Any, rows: int, k: int, time: Any, count: int, which: Any) -> None:
    """Write for each of the times the row of the log that ball k follows then: ``which`` (T, B)."""
    row, later = k, k + 1
    for i in range(count):
        while later < rows and log[later].t <= time[i]:
            if log[later].ball == k:
                row = later
            later += 1
        which[i, k] = row


def _run_all(
    functions: Any, worlds: Any, features: Any, balls: Any, logs: Any, users: Any, time: Any, count: Any, most: int, which: Any,
    states: Any,
) -> None:  # fmt: skip
    """Run every start (N, B), and write the first K numbers of its states (N, T, B, K) at the first ``count`` (N,) of its times.

    ``time`` (N, T), or (1, T) for all; ``which`` (N, T, B) is work memory.
    """
    for n in prange(balls.shape[0]):
        log = logs[n]
        own = time[0]
        if time.shape[0] > 1:
            own = time[n]
        rows_at = which[n]
        until = own[count[n] - 1]
        ended, _events, rows, _ball, _slow, last = _call_run(
            functions[0], (worlds, features, balls[n], log, -1.0, until, most, users, ALL)
        )
        known = until if ended in (DONE, QUIET) else last  # else the law is undefined, or events accumulate
        world = worlds[0]
        for k in range(balls.shape[1]):
            ball = balls[n, k]
            _rows_at(log, rows, k, own, count[n], rows_at)
            for i in range(count[n]):
                t = own[i]
                row = log[rows_at[i, k]]
                ball.phase = row.phase
                if t <= known and ball.phase < HELD:
                    write_vector(ball.x, vector(row.x))
                    write_vector(ball.v, vector(row.v))
                    write_vector(ball.w, vector(row.w))
                    begin_phase(world, ball)
                    move_by(world, ball, t - row.t, t)
                    for j in range(min(states.shape[3], 3)):
                        states[n, i, k, j] = ball.x[j]
                    for j in range(3, states.shape[3]):
                        states[n, i, k, j] = ball.v[j - 3] if j < 6 else ball.w[j - 6]


def _follow_all(
    functions: Any, worlds: Any, world_d: Any, features: Any, features_d: Any, starts: Any, balls_d: Any, users: Any, laws: Any,
    time: Any, count: Any, most: int, log: Any, out: Any, out_d: Any, balls: Any, which: Any, states: Any, slopes: Any,
    undefined: float,
) -> None:  # fmt: skip
    """As :func:`_run_all`, one after the other, with derivatives ``slopes`` (N, C, T, B, K, LANES), ``undefined`` from a graze on.

    ``balls_d`` (N, C, B, numbers, LANES): of the starts; they are written over. ``log`` and ``out`` (M,), ``out_d`` (C, M, numbers,
    LANES), ``balls`` (B,), ``which`` (T, B) are for one run at a time. ``functions`` (3,): addresses of what is called.
    """
    for n in range(starts.shape[0]):
        own = time[n if time.shape[0] > 1 else 0]
        until, slope = own[count[n] - 1], balls_d[n]
        for k in range(starts.shape[1]):
            balls[k] = starts[n, k]
        ended, _events, rows, _ball, _slow, last = _call_run(
            functions[0], (worlds, features, balls, log, -1.0, until, most, users, ALL)
        )
        known, rows_of = until if ended in (DONE, QUIET) else last, log[:rows]
        graze = _call_follow(
            functions[1],
            (worlds, world_d, features, features_d, starts[n], slope, balls, rows_of, laws, known, out, out_d),
        )
        for k in range(starts.shape[1]):
            _rows_at(log, rows, k, own, count[n], which)
        many = count[n]
        while many > 0 and own[many - 1] > known:
            many -= 1
        _call_states(
            functions[2],
            (
                worlds, world_d, starts[n], slope, rows_of, which[:many], out, out_d, own[:many], balls, slope, states[n],
                slopes[n],
            ),
        )  # fmt: skip
        for i in range(many):
            for k in range(starts.shape[1]):
                row = which[i, k]
                if log[row].phase >= HELD:
                    for j in range(states.shape[3]):
                        states[n, i, k, j] = math.nan
                if log[row].phase >= HELD or (graze >= 0 and (row >= graze or own[i] >= log[graze].t)):
                    for c in range(slopes.shape[1]):
                        for j in range(slopes.shape[4]):
                            for lane in range(LANES):
                                slopes[n, c, i, k, j, lane] = undefined


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
        array_of(float, 2), array_of(int), int, array_of(int, 3), array_of(float, 4),
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
        array_of(int), array_of(int), array_of(float, 2), array_of(int), int, array_of(LOG), array_of(PASSAGES), SLOPES,
        array_of(BALLS), array_of(int, 2), array_of(float, 4), array_of(float, 6), float,
    )  # fmt: skip
    return functools.partial(njit(_follow_all, loop, (_declare_calls,), nogil=True), addresses)


def compile_at_times() -> None:
    """Compile both loops, or load them from the cache."""
    _compiled()
    _compiled_with_slopes()


def states_at(
    arrays: SceneArrays, balls: NDArray[np.void], time: Array, count: NDArray[np.int64], numbers: int = 9,
    limits: Limits = SEGMENT,
) -> Array:  # fmt: skip
    """Return the first numbers of the states (N, T, B, numbers) of N runs; NaN beyond a run's times, and where it is not known.

    ``balls`` (N, B): the starts, which are kept; ``time`` (N, T) or (1, T): s since the start, of which ``count`` (N,) are
    evaluated.
    """
    (n, b), width = balls.shape, time.shape[1]
    balls, states = balls.copy(), np.full((n, width, b, numbers), np.nan)
    logs, which = np.empty((min(n, BLOCK), limits.rows), LOG), np.empty((min(n, BLOCK), width, b), np.int64)
    for some in block_slices(n, BLOCK):
        size = some.stop - some.start
        own = time[some] if len(time) > 1 else time
        _compiled()(
            arrays.world, arrays.features, balls[some], logs[:size], arrays.users, own, count[some], limits.events, which[:size],
            states[some],
        )  # fmt: skip
    return states


def states_and_slopes(
    arrays: SceneArrays, duals: NDArray[np.int64], balls: NDArray[np.void], time: Array, count: NDArray[np.int64], by_scene: Slopes,
    by_start: Array, numbers: int = 9, undefined: float = 0.0, limits: Limits = SEGMENT,
) -> StatesAndSlopes:  # fmt: skip
    """Return states as :func:`states_at`, and the exact derivatives of their first ``numbers``; ``undefined`` from a graze on.

    ``duals``: laws that are called by address, of dual numbers. ``by_scene``: derivatives of the world (C, 1, numbers, LANES) and
    of the features (C, F, numbers, LANES); ``by_start`` (N, C, B, numbers, LANES): of the balls.
    """
    (n, b), width, chunks = balls.shape, time.shape[1], by_start.shape[1]
    by_start = by_start.copy()
    states, slopes = np.full((n, width, b, 9), np.nan), np.full((n, chunks, width, b, numbers, LANES), undefined)
    loop = _compiled_with_slopes()

    def part(some: slice) -> None:
        loop(
            arrays.world, by_scene["world"], arrays.features, by_scene["features"], balls[some], by_start[some],
            arrays.users, duals, time[some] if len(time) > 1 else time, count[some], limits.events, np.empty(limits.rows, LOG),
            np.empty(limits.rows, PASSAGES), np.empty((chunks, limits.rows, float_count(PASSAGES), LANES)),
            np.empty(b, BALLS), np.empty((width, b), np.int64), states[some], slopes[some], undefined,
        )  # fmt: skip

    edges = np.linspace(0, n, min(1 + n // RUNS_A_THREAD, thread_count()) + 1).astype(int)
    call_in_threads(part, [slice(*pair) for pair in pairwise(edges.tolist())])
    return StatesAndSlopes(states, slopes)
