"""The one compiled loop over many runs of which states are kept: at the end, at the times of frames, with derivatives or without.

It is what :func:`carom.simulate`, :meth:`carom.Trajectory.at` and ``run.sensitivity`` do, in one call, without a scene or a
trajectory for each run; tests check that states are bitwise identical. (Events are counted and kept by
:mod:`carom.simulation.run_many`, which has no log of a whole run.)
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
from carom.core.jit.compile import array_of, named_tuple_type, njit, signature
from carom.core.jit.dual.dual_records import float_count
from carom.core.jit.dual.numbers import LANES
from carom.core.jit.kernel import kernel, vector
from carom.core.jit.pointers import caller_of, compiled_address
from carom.core.jit.slices import block_slices
from carom.core.jit.threads import call_in_threads, thread_count
from carom.core.motion.phases import HELD
from carom.simulation.compiled import ENGINE_END, ENGINE_RUN, compiled_engine
from carom.simulation.contacts.contact import DONE
from carom.simulation.event_rows import ALL
from carom.simulation.loop import FULL, LIMIT, QUIET
from carom.simulation.motion import begin_phase, move_by, write_vector
from carom.simulation.records import BALLS, LOG, WORLD
from carom.simulation.sensitivity.compiled import FOLLOW, SLOPES, STATES, X, compiled_follow, compiled_states
from carom.simulation.sensitivity.pass_kernels import PASSAGES
from carom.simulation.setup import SceneArrays

__all__ = [
    "ENDED", "KeptStates", "Limits", "RunSlopes", "Slopes", "StatesAndSlopes", "compiled_runs", "kept_states",
    "states_and_slopes", "states_at",
]  # fmt: skip

Array = NDArray[np.float64]
Slopes = dict[str, Array]
BLOCK = 4096  # runs in one call of the compiled loop: Python sees Ctrl-C between two of them
# States that a thread takes at least, with derivatives and without: fewer are known before another thread has begun.
DERIVATIVES_A_THREAD, STATES_A_THREAD = 1000, 2000
NUMBERS = 9  # of a state: position, velocity and spin
ENDED = (DONE, QUIET, LIMIT)  # how a run ends that is followed to its end

# The compiled functions, called through their addresses, once there are any.
_call_run: Any = None
_call_finish: Any = None
_call_follow: Any = None
_call_states: Any = None


class Limits(NamedTuple):
    """How long a run may be."""

    rows: int = 128
    """Of its log; a run that writes more is known until then."""
    events: int = 400
    until: float = math.inf
    """s"""
    most_rows: int = 0
    """A run that writes more rows is run again with eight times as many, while these are at most so many."""


SEGMENT = Limits()


class StatesAndSlopes(NamedTuple):
    """States of N runs of B balls at T times, and their derivatives."""

    states: Array
    """(N, T, B, 9): position, velocity, spin; NaN beyond a run's times, and where it is not known."""
    slopes: Array
    """(N, C, T, B, K, LANES): of the first K numbers of a state."""


class RunSlopes(NamedTuple):
    """Derivatives of the scene and of the starts, LANES parameters in each of C chunks; with C = 0 none are computed."""

    world: Array
    """(C, 1, numbers of the world, LANES)"""
    features: Array
    """(C, F, numbers of a feature, LANES)"""
    starts: Array
    """(1 or N, C, B, numbers of a ball, LANES): the same for all runs, or those of each."""
    users: NDArray[np.int64]
    """Laws that are called by address, of dual numbers."""


class RunScene(NamedTuple):
    """A scene as the loop takes it, or those of all runs."""

    worlds: Any
    """(1,) or (N,)"""
    features: Any
    """(F,) or (N F,), those of one run after the other's."""
    users: Any


class Room(NamedTuple):
    """Arrays for one run at a time."""

    log: Any
    """(M,)"""
    passages: Any
    """(M,), or (1,) where no times are asked for."""
    passages_d: Any
    balls: Any
    """(B,)"""
    balls_d: Any
    """(C, B, numbers, LANES)"""
    rows: Any
    """(T, B): the row of the log that each ball follows at each time."""


class KeptStates(NamedTuple):
    """States of N runs, and how they ended."""

    finals: NDArray[np.void]
    """(N, B): the balls at the end; (0, B) if only times are asked for."""
    finals_d: Array
    """(N, C, B, 9, LANES): derivatives of their positions, velocities and spins; 0 where the run has no end."""
    states: Array
    """(N, T, B, K): the first K numbers of each ball at each time; NaN beyond a run's times, and where it is not known."""
    slopes: Array
    """(N, C, T, B, K, LANES): their derivatives; ``undefined`` from a graze on."""
    ends: Array
    """(N,): times, s."""
    ended: NDArray[np.int64]
    """(N, 3): status, events, and -1 or the row of a graze."""


@kernel
def _copy(numbers: Any, into: Any, first: int) -> None:
    """Copy the derivatives (C, B, numbers, LANES) of numbers from the first on. (Numba takes 3 s to compile a[:] = b.)"""
    for c in range(into.shape[0]):
        for k in range(into.shape[1]):
            for number in range(into.shape[2]):
                for lane in range(LANES):
                    into[c, k, number, lane] = numbers[c, k, first + number, lane]


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


@kernel
def _keep_states(world: Any, log: Any, rows_at: Any, time: Any, many: int, balls: Any, states: Any) -> None:
    """Write the first K numbers of the balls at so many times: ``states`` (T, B, K)."""
    for k in range(balls.shape[0]):
        ball = balls[k]
        for i in range(many):
            t, row = time[i], log[rows_at[i, k]]
            ball.phase = row.phase
            if ball.phase < HELD:
                write_vector(ball.x, vector(row.x))
                write_vector(ball.v, vector(row.v))
                write_vector(ball.w, vector(row.w))
                begin_phase(world, ball)
                move_by(world, ball, t - row.t, t)
                for j in range(min(states.shape[2], 3)):
                    states[i, k, j] = ball.x[j]
                for j in range(3, states.shape[2]):
                    states[i, k, j] = ball.v[j - 3] if j < 6 else ball.w[j - 6]


@kernel
def _leave_out(
    log: Any, rows_at: Any, time: Any, many: int, graze: int, undefined: float, states: Any, slopes: Any
) -> None:
    """Leave out what is not known: states of balls that are held, and derivatives from a graze on."""
    for i in range(many):
        for k in range(states.shape[1]):
            row = rows_at[i, k]
            if log[row].phase >= HELD:
                for j in range(states.shape[2]):
                    states[i, k, j] = math.nan
            if log[row].phase >= HELD or (graze >= 0 and (row >= graze or time[i] >= log[graze].t)):
                for c in range(slopes.shape[0]):
                    for j in range(slopes.shape[3]):
                        for lane in range(LANES):
                            slopes[c, i, k, j, lane] = undefined


def _many(
    functions: Any, scene: Any, slopes: Any, starts: Any, which: Any, time: Any, count: Any, until: float, most: int,
    undefined: float, room: Any, kept: Any,
) -> None:  # fmt: skip
    """Run the starts (N, B) whose numbers are in ``which``: to the end, if it is kept, else to the last of their times.

    ``time`` (N, T), or (1, T) for all, of which the first ``count`` (N,) are evaluated. ``functions`` (4,): addresses of what is
    called.
    """
    log, balls, tables = room.log, room.balls, scene.worlds.shape[0]
    walls = scene.features.shape[0] // tables
    to_end = kept.finals.shape[0] > 0
    for m in range(which.shape[0]):
        n = which[m]
        table = n if tables > 1 else 0
        worlds, features = scene.worlds[table : table + 1], scene.features[table * walls : (table + 1) * walls]
        own = time[n if time.shape[0] > 1 else 0]
        stop = until if to_end else min(until, own[count[n] - 1])
        for k in range(balls.shape[0]):
            balls[k] = starts[n, k]
        status, events, rows, _ball, _slow, last = _call_run(
            functions[0], (worlds, features, balls, log, -1.0, stop, most, scene.users, ALL)
        )
        # (else the law is undefined, or events accumulate)
        end = stop if stop < math.inf and status in (DONE, QUIET) else last
        graze = -1
        kept.ended[n, 0], kept.ended[n, 1], kept.ended[n, 2] = status, events, graze
        if status in (DONE, QUIET, LIMIT):
            kept.ends[n] = end
        if to_end:
            for k in range(balls.shape[0]):
                kept.finals[n, k] = balls[k]
            if status == FULL:  # (run again with more rows)
                continue
            if status in (DONE, QUIET, LIMIT):
                _call_finish(functions[1], (worlds, kept.finals[n], end))
        followed = room.balls_d.shape[0] > 0 and (count[n] > 0 or status in (DONE, QUIET, LIMIT))
        first = slopes.starts[n if slopes.starts.shape[0] > 1 else 0]
        if followed:
            _copy(first, room.balls_d, 0)
            graze = _call_follow(
                functions[2],
                (
                    worlds, slopes.world, features, slopes.features, starts[n], room.balls_d, balls, log[:rows], slopes.users,
                    end, room.passages, room.passages_d,
                ),
            )  # fmt: skip
            kept.ended[n, 2] = graze
            if to_end and status in (DONE, QUIET, LIMIT):
                _copy(room.balls_d, kept.finals_d[n], X)
        many = count[n]
        while many > 0 and own[many - 1] > end:
            many -= 1
        for k in range(balls.shape[0]):
            _rows_at(log, rows, k, own, many, room.rows)
        if followed and many > 0:
            _call_states(
                functions[3],
                (
                    worlds, slopes.world, starts[n], first, log[:rows], room.rows[:many], room.passages, room.passages_d,
                    own[:many], balls, room.balls_d, kept.states[n], kept.slopes[n],
                ),
            )  # fmt: skip
            _leave_out(log, room.rows, own, many, graze, undefined, kept.states[n], kept.slopes[n])
        else:
            _keep_states(worlds[0], log, room.rows, own, many, balls, kept.states[n])


@functools.cache
def _declare_calls() -> None:
    """Tell the compiler what the loop calls by address."""
    global _call_run, _call_finish, _call_follow, _call_states
    _call_run, _call_finish = caller_of(*ENGINE_RUN), caller_of(*ENGINE_END)
    _call_follow, _call_states = caller_of(*FOLLOW), caller_of(*STATES)


@functools.cache
def compiled_runs() -> Callable[..., None]:
    """Return the compiled loop, for one thread."""
    called = (*compiled_engine(), compiled_follow(), compiled_states())
    addresses, whole = np.array([compiled_address(one) for one in called]), array_of(int)
    loop = signature(
        None, whole, named_tuple_type(RunScene, array_of(WORLD), array_of(FEATURES), whole),
        named_tuple_type(RunSlopes, SLOPES, SLOPES, array_of(float, 5), whole),
        array_of(BALLS, 2), whole, array_of(float, 2), whole, float, int, float,
        named_tuple_type(Room, array_of(LOG), array_of(PASSAGES), SLOPES, array_of(BALLS), SLOPES, array_of(int, 2)),
        named_tuple_type(
            KeptStates, array_of(BALLS, 2), array_of(float, 5), array_of(float, 4), array_of(float, 6), array_of(float),
            array_of(int, 2),
        ),
    )  # fmt: skip
    return functools.partial(njit(_many, loop, (_declare_calls,), nogil=True), addresses)


@functools.cache
def _no_slopes() -> RunSlopes:
    """Return the derivatives with respect to no parameter."""
    world, features, balls = (np.empty((0, 1, float_count(kind), LANES)) for kind in (WORLD, FEATURES, BALLS))
    return RunSlopes(world, features, balls[None], np.empty(0, np.int64))


def kept_states(
    arrays: SceneArrays,
    starts: NDArray[np.void],
    slopes: RunSlopes | None = None,
    time: Array | None = None,
    count: NDArray[np.int64] | None = None,
    *,
    to_end: bool = False,
    numbers: int = NUMBERS,
    undefined: float = 0.0,
    limits: Limits = SEGMENT,
) -> KeptStates:
    """Run starts (N, B) on all cores, each by the thread that has its arrays; return what is kept of them.

    Parameters
    ----------
    arrays : SceneArrays
        Of one scene, or of N: worlds (N,) and features (N F,), those of one run after the other's.
    starts : array (N, B) of BALLS
        They are kept as they are.
    slopes : RunSlopes, optional
    time : array (N, T) or (1, T), optional
        Increasing times from the start, s, of which the first ``count`` (N,) are evaluated.
    to_end : bool
        Whether each run goes on to its end, which is kept; else it ends at the last of its times.
    numbers : int
        How many numbers of each ball are kept at the times, of position, velocity and spin; of states with derivatives all.
    undefined : float
        In the place of derivatives from a graze on.
    limits : Limits

    Returns
    -------
    KeptStates
        Bitwise identical whatever the number of cores.
    """
    (total, size), given = starts.shape, _no_slopes() if slopes is None else slopes
    chunks = len(given.world)
    times = np.empty((1, 0)) if time is None else time
    counts = np.zeros(total, np.int64) if count is None else count
    width, at_end = times.shape[1], total if to_end else 0
    kept = KeptStates(
        np.empty((at_end, size), BALLS), np.zeros((at_end, chunks, size, NUMBERS, LANES)),
        np.full((total, width, size, NUMBERS if chunks else numbers), math.nan),
        np.full((total, chunks, width, size, numbers, LANES), undefined), np.zeros(total), np.zeros((total, 3), np.int64),
    )  # fmt: skip
    loop, scene = compiled_runs(), RunScene(arrays.world, arrays.features, arrays.users)
    each = max(width * size, 1) * max(chunks, 1)
    least = 1 if to_end else -(-(DERIVATIVES_A_THREAD if chunks else STATES_A_THREAD) // each)

    def part(some: NDArray[np.int64], rows: int) -> None:
        passages = rows if chunks and width else 1
        room = Room(
            np.empty(rows, LOG), np.empty(passages, PASSAGES), np.empty((chunks, passages, float_count(PASSAGES), LANES)),
            np.empty(size, BALLS), np.empty((chunks, size, float_count(BALLS), LANES)), np.empty((width, size), np.int64),
        )  # fmt: skip
        loop(scene, given, starts, some, times, counts, limits.until, limits.events, undefined, room, kept)

    for block in block_slices(total, BLOCK):
        which, rows = np.arange(block.start, block.stop), limits.rows
        while len(which):
            threads = min(len(which), 1 + len(which) // least, thread_count())
            edges = [len(which) * k // threads for k in range(threads + 1)]
            call_in_threads(functools.partial(part, rows=rows), [which[low:high] for low, high in pairwise(edges)])
            rows *= 8
            which = which[kept.ended[which, 0] == FULL] if rows <= limits.most_rows else which[:0]
    return kept


def states_at(
    arrays: SceneArrays, balls: NDArray[np.void], time: Array, count: NDArray[np.int64], numbers: int = NUMBERS,
    limits: Limits = SEGMENT,
) -> Array:  # fmt: skip
    """Return the first numbers of the states (N, T, B, numbers) of N runs; NaN beyond a run's times, and where it is not known.

    ``balls`` (N, B): the starts, which are kept; ``time`` (N, T) or (1, T): s since the start, of which ``count`` (N,) are
    evaluated.
    """
    return kept_states(arrays, balls, None, time, count, numbers=numbers, limits=limits).states


def states_and_slopes(
    arrays: SceneArrays, duals: NDArray[np.int64], balls: NDArray[np.void], time: Array, count: NDArray[np.int64], by_scene: Slopes,
    by_start: Array, numbers: int = NUMBERS, undefined: float = 0.0, limits: Limits = SEGMENT,
) -> StatesAndSlopes:  # fmt: skip
    """Return states as :func:`states_at`, and the exact derivatives of their first ``numbers``; ``undefined`` from a graze on.

    ``duals``: laws that are called by address, of dual numbers. ``by_scene``: derivatives of the world (C, 1, numbers, LANES) and
    of the features (C, F, numbers, LANES); ``by_start`` (N, C, B, numbers, LANES): of the balls.
    """
    slopes = RunSlopes(by_scene["world"], by_scene["features"], by_start, duals)
    kept = kept_states(arrays, balls, slopes, time, count, numbers=numbers, undefined=undefined, limits=limits)
    return StatesAndSlopes(kept.states, kept.slopes)
