"""The sensitivity of a run: derivatives of its events and states with respect to numbers of its scene, and how far they hold."""

from __future__ import annotations

import functools
import math
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import State
from carom.core.geometry.features import FEATURES
from carom.core.jit.calls import caller_of, compiled_address
from carom.core.jit.compile import array_of, named_tuple_type, njit, signature
from carom.core.jit.dual import LANES, float_count
from carom.core.jit.kernel import kernel
from carom.core.jit.threads import block_slices, call_in_threads, thread_count
from carom.core.motion.phases import HELD, PHASES
from carom.errors import CaromError, require_type
from carom.formatting import Listing, format_number
from carom.scene.scene import Scene
from carom.scene.toml import replaced
from carom.simulation.contact_kinds import ALL_REFUSALS, DONE
from carom.simulation.loop import (
    ADVANCE,
    ALL,
    ENGINE_RUN,
    FULL,
    LIMIT,
    QUIET,
    compiled_engine,
    run_limits,
    run_scene,
)
from carom.simulation.motion import begin_phase, move_by, set_to_row
from carom.simulation.records import BALL, BALLS, LOG, START, WALL, WORLD, SceneArrays, set_up, starts_of
from carom.simulation.sensitivity.follow import (
    ARRAYS,
    FOLLOW,
    SLOPES,
    STATES,
    Parameters,
    X,
    compiled_follow,
    compiled_states,
    dual_users,
    follow,
    parameters_of,
)
from carom.simulation.sensitivity.margins import EXACT, Margin, NearMiss, impacts_at_once, margins, near_misses
from carom.simulation.sensitivity.passages import PASSAGES, PLACES, Passages, StateSensitivity

Array = NDArray[np.float64]


class EventSensitivity(NamedTuple):
    """Derivatives of one event: of its time (p,), and of the ball's state there, each (3, p), at the time that changes with it."""

    time: Array
    position: Array
    velocity: Array
    spin: Array
    velocity_before: Array
    spin_before: Array


class Sensitivity:
    """Derivatives of a run; made by :meth:`carom.Trajectory.sensitivity`."""

    def __init__(self, run: Any, parameters: Parameters, passages: Passages) -> None:
        self._run, self._passages, self._parameters = run, passages, parameters
        self.parameters = columns = parameters.columns
        self.columns: list[str] = [one.name for one in columns]
        """Names of the p parameters."""
        self.values = np.array([one.value for one in columns])
        """Their values in the scene (p,)."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the run and the parameters: the derivatives are computed again, with the same bits."""
        return sensitivity, (self._run, self._parameters.wrt)

    @property
    def events(self) -> list[EventSensitivity]:
        """Derivatives of each event, in the order of ``run.events``."""
        d = self._passages.derivatives[len(self._run.scene.balls) :]
        time, *motion = (d[:, PLACES[name]] for name in ("time", "x", "v", "w", "v_before", "w_before"))
        return [EventSensitivity(t[0], *rest) for t, *rest in zip(time, *motion, strict=True)]

    def at(self, t: ArrayLike) -> StateSensitivity:
        """Return the derivatives of all states at a fixed time, s, or at times (...): each (B, 3, p), or (..., B, 3, p)."""
        times = np.asarray(t, dtype=float)
        self._run.at(times if times.size else 0.0)  # (which refuses times before and after the run)
        return self._passages.at(times)

    @property
    def final(self) -> StateSensitivity:
        """Derivatives of the final states, at the fixed time ``run.end``."""
        return self._passages.at(self._run.end)

    @functools.cached_property
    def margin(self) -> list[Margin]:
        """For each event the nearest switch: graze, stick or slip, roll or slide, or the order of two events of one ball."""
        return margins(self._run, self._parameters, self._passages)

    @functools.cached_property
    def near_misses(self) -> list[NearMiss]:
        """Objects that balls pass without touching; first the object that the smallest change of the parameters makes a contact."""
        return near_misses(self._run, self._parameters, self._passages)

    @property
    def radius(self) -> float:
        """Length of the shortest change of the parameters (in their units) that changes the sequence of events, to first order."""
        radii = [one.radius for one in self.margin] + [one.radius for one in self.near_misses]
        return min(radii, default=np.inf)

    def what_matters(self) -> Array:
        """Return how far each ball's final place moves when a parameter changes by 1 %, an angle by 1 degree: (B, p), m."""
        changes = np.where([is_angle(name) for name in self.columns], 1.0, np.abs(self.values) / 100)
        return np.asarray(np.linalg.norm(self.final.position, axis=1) * changes)

    def table(self) -> Listing:
        """Return the displacements of final places, mm, for a change of each parameter by 1 % or 1 degree; the largest first."""
        moved = 1e3 * self.what_matters()
        order = np.argsort(-moved.max(axis=0), kind="stable")
        rows = [
            [self.columns[c], format_number(self.values[c]), *map(format_number, moved[:, c])] for c in order.tolist()
        ]
        return Listing(["mm per cent", "value", *self._run.scene.ball_names], rows)

    def __repr__(self) -> str:
        """One line."""
        return f"<Sensitivity: {len(self.columns)} parameters, {len(self.events)} events>"


def is_angle(parameter: str) -> bool:
    """Return whether a number of a scene is an angle in degrees, of which a per cent means nothing."""
    return parameter.endswith((".azimuth", ".elevation"))


def sensitivity(run: Any, wrt: str | Iterable[str]) -> Sensitivity:
    """Compute the derivatives of a run with respect to numbers of its scene, by a second pass over its log."""
    scene, log = run.scene, run.log
    first = log[: len(scene.balls)]
    if len(log) and (len(first) < len(scene.balls) or (first["kind"] != START).any()):
        raise CaromError("sensitivity: expected a run with a complete log")
    parameters = parameters_of(scene, run.arrays, wrt, first["phase"].tolist())
    passages = follow(scene, parameters, log, run.end)
    _warn_of_switches(run, passages)
    return Sensitivity(run, parameters, passages)


def _warn_of_switches(run: Any, passages: Passages) -> None:
    """Warn of events that are exactly at a switch, where derivatives are one-sided."""
    log, first = run.log, len(run.scene.balls)
    required, friction = passages.values["required"], passages.values["friction"]
    border = np.flatnonzero((required >= (1 - EXACT) * friction) & (required <= (1 + EXACT) * friction))
    found = {k: "at the border of sticking and slipping" for k in border.tolist() if _sticks_just(log[k], friction[k])}
    found |= dict.fromkeys(_ties(log), "at the same time as another impact of this ball")
    if found:
        k = min(found)
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        warnings.warn(
            f"sensitivity: events[{k - first}] ({log['t'][k]:.9g} s, ball {int(log['ball'][k])}): {found[k]}{more}: derivatives are"
            " those of one side",
            stacklevel=4,
        )


def _sticks_just(row: Any, friction: float) -> bool:
    """Return whether the required friction is the border's (a pressed ball that slides requires all there is)."""
    return bool(0 < friction < np.inf and not np.any(row["floor_impulse"]))


def _ties(log: Any) -> list[int]:
    """Return the rows of impacts at the same time as another impact of their ball."""
    t, kind = log["t"], log["kind"]
    hits = (kind == WALL) | (kind == BALL)
    soon = np.flatnonzero(hits[1:] & hits[:-1] & (t[1:] - t[:-1] <= EXACT * t[1:]))
    # (of most there is nothing to look at: the two rows of one meeting of two balls)
    ball, other = log["ball"], log["other"]
    met = (kind[soon + 1] == BALL) & (other[soon] == ball[soon + 1]) & (ball[soon] == other[soon + 1])
    return [k for k in (soon[~met] + 1).tolist() if impacts_at_once(log, k, [ball[k]])[:k].any()]


# ----------------------------------------------------------------------------------------------------
# The one compiled loop over many runs of which states are kept: at the end, at the times of frames, with derivatives or without.
#
# It is what :func:`carom.simulate`, :meth:`carom.Trajectory.at` and ``run.sensitivity`` do, in one call, without a scene or a
# trajectory for each run; tests check that states are bitwise identical. (Events are counted and kept by
# :mod:`carom.simulation.simulate`, which has no log of a whole run.)


Slopes = dict[str, Array]
BLOCK = 4096  # runs in one call of the compiled loop: Python sees Ctrl-C between two of them
# States that a thread takes at least, with derivatives and without: fewer are known before another thread has begun.
DERIVATIVES_A_THREAD, STATES_A_THREAD = 1000, 2000
NUMBERS = 9  # of a state: position, velocity and spin
ENDED = (DONE, QUIET, LIMIT)  # how a run ends that is followed to its end

# The compiled functions, called through their addresses, once there are any.
_call_run: Any = None
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
            set_to_row(ball, row)
            if ball.phase < HELD:
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

    ``time`` (N, T), or (1, T) for all, of which the first ``count`` (N,) are evaluated. ``functions`` (3,): addresses of what is
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
                _call_run(functions[0], (worlds, features, kept.finals[n], log, -1.0, end, ADVANCE, scene.users, ALL))
        followed = room.balls_d.shape[0] > 0 and (count[n] > 0 or status in (DONE, QUIET, LIMIT))
        first = slopes.starts[n if slopes.starts.shape[0] > 1 else 0]
        if followed:
            _copy(first, room.balls_d, 0)
            graze = _call_follow(
                functions[1],
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
                functions[2],
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
    global _call_run, _call_follow, _call_states
    _call_run, _call_follow, _call_states = caller_of(*ENGINE_RUN), caller_of(*FOLLOW), caller_of(*STATES)


@functools.cache
def compiled_runs() -> Callable[..., None]:
    """Return the compiled loop, for one thread."""
    called = (compiled_engine(), compiled_follow(), compiled_states())
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


# ----------------------------------------------------------------------------------------------------
# Derivatives of many runs of a scene, on all cores: each is run, and its log is followed, by the thread that has its arrays.


# Rows of a log at first; a run that needs more is run again.
ROWS_AT_FIRST, MOST_ROWS = 512, 1 << 18
NO_DERIVATIVE = "a graze, or nearly one: no derivative exists"


@dataclass(frozen=True, eq=False)
class ManySensitivities:
    """Final states of N runs of B balls, and their derivatives with respect to p parameters."""

    columns: list[str]
    """Names of the p parameters."""
    final: State
    """(N, B, 3)."""
    derivatives: StateSensitivity
    """Derivatives of the final states at the fixed time ``end``, each (N, B, 3, p); NaN where a run has none (``why``)."""
    code: NDArray[np.int64]
    """(N, B): final phases as numbers; ``phase`` has their names."""
    end: Array
    """(N,), s."""
    count: NDArray[np.int64]
    """(N,): number of events."""
    why: NDArray[np.str_]
    """(N,): empty, or why a run ended at an event for which a law has no answer, or has no derivative."""
    states: State | None = None
    """(N, T, B, 3): the states at the ``times``, if these were given; NaN where a run has ended before at such an event."""
    slopes: StateSensitivity | None = None
    """Derivatives of these states, each (N, T, B, 3, p); NaN from an event without a derivative on."""

    @property
    def phase(self) -> NDArray[np.str_]:
        """(N, B): flight, sliding, rolling, pivoting, rest, bouncing, held, left, pocketed."""
        return np.array(PHASES)[self.code]


def sensitivities(
    scene: Scene,
    wrt: str | Iterable[str],
    velocity: ArrayLike | None = None,
    spin: ArrayLike | None = None,
    position: ArrayLike | None = None,
    *,
    times: ArrayLike | None = None,
) -> ManySensitivities:
    """Simulate a scene from many initial states, on all cores, with exact derivatives of the final states.

    As :func:`carom.simulate_many`, with what ``run.sensitivity`` computes of each run. How an initial state depends on a parameter
    (the spin of a ball with ``rolling`` on its velocity) is taken from the scene.

    Parameters
    ----------
    scene : Scene
    wrt : list of str
        Paths such as ``balls.0.velocity`` and ``walls.*.friction``, as for ``run.sensitivity``.
    velocity, spin, position : array (N, B, 3), or (N, 3) for a scene of one ball only, optional
        Initial velocities (m/s), spins (rad/s) and positions (m); default: the scene's. One run's, (1, B, 3), are those of all.
        A ball that is to roll at another velocity than the scene's needs its spin too: that of :func:`carom.rolling`.
    times : array (T,) or (N, T), optional
        Increasing times, s, of all runs or of each, at which states and derivatives are wanted as well, as ``run.at`` and
        ``run.sensitivity(...).at`` return them.

    Returns
    -------
    ManySensitivities
        Bitwise identical whatever the number of cores.

    Raises
    ------
    CaromError
        For paths as ``run.sensitivity`` does, for initial states as ``simulate_many`` does, for runs of more than 262,144 rows
        of the log, and for a law that takes no dual numbers.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.5, friction=0)
    >>> ball = carom.SceneBall(radius=0.1, mass=0.2, position=(1.1, 0, 0), velocity=(-2, 1, 0))
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=1))
    >>> many = carom.sensitivities(scene, "walls.0.restitution", velocity=[[-2, 1, 0], [-4, 1, 0]])
    >>> many.derivatives.position[:, 0, 0, 0].round(6).tolist()
    [1.0, 3.0]
    >>> many = carom.sensitivities(scene, "walls.0.restitution", velocity=[[-2, 1, 0], [-4, 1, 0]], times=[0.25, 0.75])
    >>> many.states.position[:, :, 0, 0].round(6).tolist(), many.slopes.position[:, :, 0, 0, 0].round(6).tolist()
    ([[0.6, 0.35], [0.1, 1.1]], [[0.0, 0.5], [0.0, 2.0]])
    """
    require_type("sensitivities", "scene", scene, Scene)
    arrays = set_up(scene)
    starts = starts_of("sensitivities", scene, arrays, velocity, spin, position)
    wanted = None if times is None else _times(times, len(starts), scene)
    return run_all(scene, arrays, parameters_of(scene, arrays, wrt, first_phases(scene)), starts, wanted)


def _times(times: ArrayLike, runs: int, scene: Scene) -> Array:
    """Return the times (1 or N, T) of frames; CaromError for times that no run has."""
    where, until = "sensitivities", run_limits(scene)[0]
    try:
        found = np.atleast_2d(np.asarray(times, dtype=float))
    except (TypeError, ValueError):
        found = np.full((1, 1), math.nan)
    if found.ndim != 2 or not found.size or len(found) not in (1, runs) or np.isnan(found).any():
        got = f"shape {found.shape}" if not np.isnan(found).any() else f"{times!r:.60}"
        raise CaromError(f"{where}: times: expected times in s, (T,) or ({runs}, T), got {got}")
    bad = ~((found >= 0) & (found <= until) & np.isfinite(found))
    if bad.any():
        span = "from 0 on" if until == math.inf else f"from 0 to {until:g} s, the end of the run"
        raise CaromError(f"{where}: times: expected times {span}, got {float(found[bad][0])!r}")
    if (np.diff(found, axis=1) < 0).any():
        raise CaromError(f"{where}: times: expected increasing times, got a smaller one after a larger one; sort them")
    return np.ascontiguousarray(found)


def first_phases(scene: Scene) -> list[int]:
    """Return the phases in which the balls of a scene begin."""
    _scene, log, *_end = run_scene(replaced(scene, {"run.max_events": 1}))
    return [int(phase) for phase in log["phase"][: len(scene.balls)]]


def run_all(
    scene: Scene,
    arrays: SceneArrays,
    parameters: Parameters | None,
    starts: NDArray[np.void],
    times: Array | None = None,
) -> ManySensitivities:
    """Run starts (N, B) in the arrays of the scene, or in those of N scenes, with derivatives by the parameters, if any."""
    (total, count), (until, most) = starts.shape, run_limits(scene)
    columns, slopes = [] if parameters is None else parameters.columns, None
    p = len(columns)
    if parameters is not None:
        world, features, balls = (parameters.packed[name] for name in ARRAYS)
        slopes = RunSlopes(world, features, balls[None], dual_users(scene.called_laws))
    places = None if times is None else np.full(total, times.shape[1])
    limits = Limits(ROWS_AT_FIRST, most, until, MOST_ROWS)
    kept = kept_states(arrays, starts, slopes, times, places, to_end=True, undefined=math.nan, limits=limits)
    status, events, grazes = kept.ended.T
    if (status == FULL).any():
        raise CaromError(
            f"sensitivities: expected runs of at most {MOST_ROWS:,} rows of the log, got a longer one at index"
            f" {int(np.argmax(status == FULL))}; set run.duration or run.max_events"
        )
    found = np.moveaxis(kept.finals_d, 1, 3).reshape(total, count, 9, -1)[..., :p]
    found[~(np.isin(status, ENDED) & (grazes < 0))] = math.nan
    why = np.array(
        [ALL_REFUSALS.get(int(code), NO_DERIVATIVE if graze >= 0 else "") for code, _count, graze in kept.ended]
    )
    made = ManySensitivities(
        [one.name for one in columns], _states(kept.finals), _slopes(found), np.array(kept.finals["phase"]), kept.ends,
        events.copy(), why,
    )  # fmt: skip
    if times is None:
        return made
    x, v, w = (kept.states[..., k : k + 3] for k in (0, 3, 6))
    at_times = np.moveaxis(kept.slopes, 1, 4).reshape(*kept.states.shape, -1)[..., :p]
    return replace(made, states=State.of(v, w, x), slopes=_slopes(at_times))


def _states(balls: NDArray[np.void]) -> State:
    return State.of(*(np.array(balls[name]) for name in ("v", "w", "x")))


def _slopes(numbers: Array) -> StateSensitivity:
    """Return the derivatives (..., 9, p) of positions, velocities and spins."""
    return StateSensitivity(*(numbers[..., k : k + 3, :] for k in (0, 3, 6)))
