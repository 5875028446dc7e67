"""The event loop: take the earliest event, resolve it, predict what comes next. There is no time step.

Each ball has its own clock, the time of its last event, and one predicted event. Where that has become invalid (the other ball of
the pair met something first) it is predicted anew. Of events at one instant, the ball that has had the fewest at its place comes
first, then the one with the lower number, so that the same input gives the same bits on every run.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.contact import NO_REGIME
from carom.core.geometry.circles import rim_entry
from carom.core.geometry.curve_arcs import arc_entry
from carom.core.geometry.features import CURVE, FEATURES, RIM
from carom.core.jit.compile import array_of, is_at_hand, is_cached, njit, signature
from carom.core.jit.kernel import Vec, as_objects, dot, kernel, vector, write_back
from carom.core.jit.native import fixed
from carom.core.jit.threads import Pace
from carom.core.motion.air import LOST
from carom.core.motion.phases import BOUNCING, CONSTANT, FLIGHT, HELD, PIVOTING
from carom.core.motion.tilt import is_tilted
from carom.errors import CaromError
from carom.laws.callbacks import register_calls
from carom.scene.scene import Scene
from carom.simulation.cluster_steps import MOST_WALLS, has_hit, wall_impulse, wall_of
from carom.simulation.contact_kinds import (
    ALL_REFUSALS,
    DONE,
    NO_IMPULSE,
    REFUSED_ENDLESS,
    REFUSED_ON_FLOOR,
    Outcome,
    met_at,
    register_joint_impact,
    resolve_event,
    without_impulse,
)
from carom.simulation.motion import (
    begin_next_piece,
    begin_phase,
    is_in_air,
    is_slow,
    move_by,
    set_on_floor,
    write_vector,
)
from carom.simulation.predict import predict
from carom.simulation.records import (
    BALL,
    BALLS,
    HELD_EVENT,
    IN_CLUSTER,
    LOG,
    MEETINGS,
    NOTHING,
    PHASE,
    PIECE,
    POCKETED_EVENT,
    START,
    WALL,
    WALL_IN_CLUSTER,
    WORLD,
    SceneArrays,
    set_up,
)
from carom.simulation.resting_contact import CALM, IN_TOUCH, is_calm, is_lying, stays_clear

# Which events are logged: bit ``kind``; for the end of a phase, bit PHASES_FROM + the phase that begins.
ALL, PHASES_FROM = -1, 16
# Rows that one event can write, clusters aside: both balls, and that both are held.
ROWS = 4

# Velocity, spin and phase.
Motion = tuple[Vec, Vec, int]


@kernel
def rows_of_an_event(balls: int, features: int, keep: int, room: int) -> int:
    """Return how many rows one event can write to a log of so many: where contacts overlap, one for each ball and for its walls."""
    rows = balls if (keep >> IN_CLUSTER) & 1 != 0 else 0
    rows += balls * min(features, MOST_WALLS) if (keep >> WALL) & 1 != 0 else 0
    return min(max(ROWS, rows), room)


@kernel
def motion_of(ball: Any) -> Motion:
    """Return how a ball moves before an event."""
    return vector(ball.v), vector(ball.w), ball.phase


@kernel
def _note(log: Any, ball: Any, kind: int, i: int, met: int, other: int, before: Motion, outcome: Outcome) -> None:
    """Write a row of the log: ball i as it is now, its motion before, and what it was given."""
    log.t, log.kind, log.ball, log.met, log.other = ball.clock, kind, i, met, other
    write_vector(log.x, vector(ball.x))
    write_vector(log.v_before, before[0])
    write_vector(log.w_before, before[1])
    write_vector(log.v, vector(ball.v))
    write_vector(log.w, vector(ball.w))
    log.phase_before, log.phase = before[2], ball.phase
    write_vector(log.impulse, outcome[0])
    write_vector(log.floor_impulse, outcome[1])
    log.required, log.regime = outcome[2], outcome[3]
    log.borne_by = ball.borne_by
    for k in range(4):
        log.borne[k] = ball.borne[k]


@kernel
def note_starts(log: Any, balls: Any) -> None:
    """Write the rows of the initial states."""
    for i in range(balls.shape[0]):
        _note(log[i], balls[i], START, i, NOTHING, -1, motion_of(balls[i]), without_impulse())


@kernel
def _note_held(log: Any, rows: int, ball: Any, i: int, met: int, other: int, before: int) -> int:
    """Write that a ball is held, if it is; return how many rows there are then."""
    if ball.phase != HELD:
        return rows
    _note(log[rows], ball, HELD_EVENT, i, met, other, (vector(ball.v), vector(ball.w), before), without_impulse())
    return rows + 1


@kernel
def _note_touch(
    log: Any, rows: int, balls: Any, i: int, kind: int, other: int, j: Vec, first: bool, keep: int
) -> int:  # fmt: skip
    """Write that ball i has touched a ball or a wall in a cluster, with its impulse; return how many rows there are then.

    A ball's first row has its velocities before and after the whole event.
    """
    if (keep >> (WALL if kind == WALL_IN_CLUSTER else kind)) & 1 == 0 or rows == log.shape[0]:
        return rows
    ball, met = balls[i], BALL if kind in MEETINGS else WALL
    before = motion_of(ball)
    if first:
        before = (vector(ball.dv), vector(ball.dw), ball.was)
    _note(log[rows], ball, kind, i, met, other, before, (j, NO_IMPULSE, 0.0, NO_REGIME, DONE, 0))
    return rows + 1


@kernel
def _note_cluster(log: Any, rows: int, features: Any, balls: Any, many: int, k: int, keep: int) -> int:
    """Write the rows of a cluster that began with a meeting of balls, or at feature k >= 0; return how many rows there are then."""
    for p in range(many):
        i = balls[p].touched
        ball = balls[i]
        m, v, u = ball.mass, ball.v, ball.dv
        j = (m * (v[0] - u[0]), m * (v[1] - u[1]), m * (v[2] - u[2]))
        for s in range(ball.walls):
            if has_hit(ball, s):
                push = wall_impulse(ball, s)
                j = (j[0] - push[0], j[1] - push[1], j[2] - push[2])
        if k >= 0 and p == 0:
            rows = _note_touch(log, rows, balls, i, WALL, features[k].wall, wall_impulse(ball, 0), True, keep)
        if ball.met >= 0:
            kind = BALL if k < 0 and p < 2 else IN_CLUSTER
            rows = _note_touch(log, rows, balls, i, kind, ball.met, j, k < 0 or p > 0, keep)
    for p in range(many):
        i = balls[p].touched
        ball = balls[i]
        for s in range(1 if k >= 0 and p == 0 else 0, ball.walls):
            if has_hit(ball, s):
                wall = features[wall_of(ball, s)].wall
                rows = _note_touch(log, rows, balls, i, WALL_IN_CLUSTER, wall, wall_impulse(ball, s), False, keep)
    return rows


@kernel
def note_event(
    log: Any, rows: int, features: Any, balls: Any, i: int, k: int, kind: int, before: Motion, before_k: Motion,
    outcome: Outcome, keep: int,
) -> int:  # fmt: skip
    """Write the rows of an event of ball i, and of k if it is another, that are to be kept; return how many rows there are then."""
    ball, other = balls[i], balls[k]
    if outcome[5] > 0:
        return _note_cluster(log, rows, features, balls, outcome[5], ball.next_who if kind == WALL else -1, keep)
    # (what is held is held by what it was to meet)
    met, who = met_at(ball.next_kind), ball.next_who
    if met == WALL:
        who = features[who].wall
    elif met == POCKETED_EVENT:
        who = features[who].at
    if (keep >> (PHASES_FROM + ball.phase if kind == PHASE else kind)) & 1 != 0:
        _note(log[rows], ball, kind, i, met, who, before, outcome)
        rows += 1
        if kind == BALL:
            j, jf, required, regime, refusal, many = outcome
            given = ((-j[0], -j[1], -j[2]), jf, required, regime, refusal, many)
            _note(log[rows], other, kind, k, met, i, before_k, given)
            rows += 1
    if (keep >> HELD_EVENT) & 1 != 0:
        if kind != HELD_EVENT:
            rows = _note_held(log, rows, ball, i, met, who, before[2])
        if k != i:
            rows = _note_held(log, rows, other, k, met, i, before_k[2])
    return rows


# ----------------------------------------------------------------------------------------------------
# The event loop: take the earliest event, resolve it, predict what comes next.


# How a call of ``run`` ends, apart from the refusals of contacts: DONE (no more events before the end), the log is full (call
# again), the number of events is reached, or no event will ever follow and nothing moves.
FULL, LIMIT, QUIET = 10, 11, 12
# Pieces of paths in air, without any event
MOST_PIECES = 20_000
# A ball with so many events at one place is caught between things that send it to and fro without end.
PINNED = 10_000
# Below this share of the speeds a ball in contact is not approaching. It is far above rounding, and no distance in any run.
SLOW = 1e-14


@kernel
def _start(world: Any, features: Any, balls: Any) -> float:
    """Set phases, clocks and first events; return the speed below which a ball in contact is not approaching."""
    force = vector(world.force)
    pull, wind = math.sqrt(dot(force, force)), vector(world.wind)
    fastest = 0.0
    for i in range(balls.shape[0]):
        ball = balls[i]
        v, w, a = vector(ball.v), vector(ball.w), ball.radius
        speed = math.sqrt(dot(v, v)) + math.sqrt(dot(wind, wind)) + a * math.sqrt(dot(w, w)) + math.sqrt(pull * a)
        fastest = max(fastest, speed)
        ball.phase, ball.clock, ball.repeats, ball.energy, ball.borne_by = FLIGHT, 0.0, 0, math.nan, 0
        if world.floor != 0 and abs(ball.x[2] - a) <= 1e-9 * a:
            ball.x[2] = a
            if abs(v[2]) <= 1e-12 * speed:
                set_on_floor(world, ball, v, w)
        begin_phase(world, ball)
        ball.next_at = ball.next_in = ball.lasts
        ball.next_kind, ball.next_who = NOTHING, -1
    for i in range(balls.shape[0]):
        predict(world, features, balls, i, SLOW * fastest)
    return SLOW * fastest


@kernel
def _overtaken(balls: Any, i: int) -> bool:
    """Return whether ball i was to meet a ball that now meets something else first."""
    ball = balls[i]
    if ball.next_kind != BALL:
        return False
    other = balls[ball.next_who]
    return bool(other.next_kind != BALL or other.next_who != i or other.next_at != ball.next_at)


@kernel
def _earliest(balls: Any) -> int:
    """Return the ball whose event comes next; of several, the one with the fewest events at its place, then the lowest number.

    So all contacts of a cluster take turns: by number alone the first few would repeat their events before any other.
    """
    i = 0
    for k in range(1, balls.shape[0]):
        soon, sooner = balls[k].next_at, balls[i].next_at
        if soon < sooner or (soon == sooner and balls[k].repeats < balls[i].repeats):
            i = k
    return i


@kernel
def _wake(world: Any, balls: Any, i: int, t: float) -> None:
    """If ball i has set off, let go the balls that lie still on a tilted floor and touch it, by an event of theirs at once."""
    ball = balls[i]
    sets_off = ball.repeats <= 0 or not is_slow(world, vector(ball.v), vector(ball.w), ball.radius)
    if is_lying(world, ball) or not sets_off:
        return
    for k in range(balls.shape[0]):
        other = balls[k]
        r = (ball.x[0] - other.x[0], ball.x[1] - other.x[1], ball.x[2] - other.x[2])
        if is_lying(world, other) and math.sqrt(dot(r, r)) <= (1 + IN_TOUCH) * (ball.radius + other.radius):
            other.next_at, other.next_in, other.next_kind, other.next_who = t, t - other.clock, PHASE, -1
            other.repeats = -100  # (less than that event counts: carom.simulation.motion.move_by)


@kernel
def _look_ahead(world: Any, features: Any, balls: Any, i: int, k: int, t: float, slow: float) -> None:
    """Predict what comes next after balls i and k (the same, or a pair) have changed their phases at time t."""
    begin_phase(world, balls[i])
    if k != i:
        begin_phase(world, balls[k])
        balls[k].next_at = math.inf  # it has no event yet: its path is valid for ever
    for m in range(balls.shape[0]):
        ball = balls[m]
        if ball.phase == BOUNCING and m not in (i, k) and not stays_clear(world, features, balls, m, ball.lasts):
            # something may reach it before its bounces end, which are followed one by one from here on
            move_by(world, ball, t - ball.clock, t)
            ball.phase = FLIGHT
            begin_phase(world, ball)
            predict(world, features, balls, m, slow)
    if is_tilted(vector(world.force)):
        _wake(world, balls, i, t)
        _wake(world, balls, k, t)
    predict(world, features, balls, i, slow)
    if k != i:
        predict(world, features, balls, k, slow)
    for m in range(balls.shape[0]):
        if _overtaken(balls, m):
            predict(world, features, balls, m, slow)


@kernel
def _go_on_in_air(world: Any, features: Any, balls: Any, i: int, slow: float) -> None:
    """Begin the next piece of the path of ball i, and predict what comes next; this is no event."""
    ball = balls[i]
    begin_next_piece(world, ball)
    ball.clock = ball.next_at
    predict(world, features, balls, i, slow)
    for m in range(balls.shape[0]):
        if _overtaken(balls, m):
            predict(world, features, balls, m, slow)


@kernel
def _look_ahead_of(world: Any, features: Any, balls: Any, many: int, t: float, slow: float) -> None:
    """Predict what comes next after the balls of a cluster have changed their phases at time t."""
    for p in range(many):
        ball = balls[balls[p].touched]
        begin_phase(world, ball)
        ball.energy = math.nan
        ball.next_kind, ball.next_at = NOTHING, math.inf  # it has no event yet: its path is valid for ever
    for p in range(many):
        i = balls[p].touched
        _look_ahead(world, features, balls, i, i, t, slow)


@kernel
def _quiet(balls: Any) -> bool:
    """Return whether no event will follow, and no ball moves."""
    for i in range(balls.shape[0]):
        ball = balls[i]
        v, acc = ball.v, ball.acc
        moves = (
            v[0] != 0 or v[1] != 0 or v[2] != 0 or acc[0] != 0 or acc[1] != 0 or acc[2] != 0 or ball.phase == PIVOTING
        )
        if ball.next_at < math.inf or (moves and ball.phase < HELD):
            return False
    return True


@kernel
def _last(balls: Any) -> float:
    """Return the time of the last event."""
    t = balls[0].clock
    for i in range(1, balls.shape[0]):
        t = max(t, balls[i].clock)
    return float(t)


@kernel
def run(
    world: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> tuple[int, int, int, int, float, float]:
    """Run events until the time ``until``, or ``most`` of them, or until the log is full, or no event follows.

    A run begins with ``slow`` < 0, and is continued with the ``slow`` that it returned. With ``keep`` = ALL everything is logged,
    the initial states first; otherwise only the kinds whose bits are set, and a full log does not stop the run.

    Returns the status, how many events happened, how many rows were written, the ball for which a law has no answer (or -1),
    ``slow``, and the time of the last event.
    """
    events = rows = pieces = 0
    if slow < 0:
        slow = _start(world, features, balls)
        if keep == ALL:
            note_starts(log, balls)
            rows = balls.shape[0]
    while True:
        i = _earliest(balls)
        ball = balls[i]
        t = ball.next_at
        if not t <= until or t == math.inf:
            return QUIET if _quiet(balls) else DONE, events, rows, -1, slow, _last(balls)
        if _overtaken(balls, i):
            predict(world, features, balls, i, slow)
            continue
        if ball.next_kind == PIECE:
            pieces += 1
            if pieces > MOST_PIECES or ball.ends == LOST:
                code = REFUSED_ON_FLOOR if ball.ends == LOST else REFUSED_ENDLESS
                return code, events, rows, i, slow, _last(balls)
            _go_on_in_air(world, features, balls, i, slow)
            continue
        pieces = 0
        if events >= most:
            return LIMIT, events, rows, -1, slow, _last(balls)
        room = rows + rows_of_an_event(balls.shape[0], features.shape[0], keep, log.shape[0]) <= log.shape[0]
        if keep == ALL and not room:
            return FULL, events, rows, -1, slow, _last(balls)
        events += 1
        k = ball.next_who if ball.next_kind == BALL else i
        other = balls[k]
        move_by(world, ball, ball.next_in, t)
        if k != i:
            move_by(world, other, t - other.clock, t)
        before, before_k = motion_of(ball), motion_of(other)
        kind = HELD_EVENT if ball.repeats > PINNED else ball.next_kind
        if is_tilted(vector(world.force)) and (kind == HELD_EVENT or ball.repeats > CALM):
            # what it meets may move
            kind = PHASE if is_calm(world, ball) and is_calm(world, other) else ball.next_kind
        if met_at(ball.next_kind) != WALL:
            ball.energy = other.energy = math.nan
        outcome = resolve_event(kind, world, features, balls, i, ball.next_who, users)
        if outcome[4] != DONE:
            return outcome[4], events, rows, i, slow, _last(balls)
        rows = note_event(log, rows, features, balls, i, k, kind, before, before_k, outcome, keep if room else 0)
        if outcome[5] > 0:
            _look_ahead_of(world, features, balls, outcome[5], t, slow)
        else:
            _look_ahead(world, features, balls, i, k, t, slow)


@kernel
def finish(world: Any, balls: Any, t: float) -> None:
    """Advance every ball that is still followed to the time t."""
    for i in range(balls.shape[0]):
        ball = balls[i]
        if ball.phase < HELD and t > ball.clock:
            # (in air as from the last event on, with the bits of who begins there)
            move_by(world, ball, (t - ball.since) - ball.begun if is_in_air(ball) else t - ball.clock, t)


# ----------------------------------------------------------------------------------------------------
# Compile the event loop.


# What the loop returns and takes.
ENGINE_RUN = (
    (int, int, int, int, float, float),
    *(array_of(kind) for kind in (WORLD, FEATURES, BALLS, LOG)), float, float, int, array_of(int), int,
)  # fmt: skip
# In place of the most events: none, but every ball is advanced to the time ``until``.
ADVANCE = -1


@functools.cache
def compiled_engine() -> Callable[..., Any]:
    """Return the compiled event loop; from the second time on it is loaded from the cache."""
    needs = (register_calls, register_joint_impact)
    # (nothing is made in the loop: no counting of who holds an array)
    return njit(_one_run, signature(*ENGINE_RUN), needs, _nrt=False)


def is_loaded() -> bool:
    """Return whether this process has the compiled loop at hand."""
    return compiled_engine.cache_info().currsize > 0


# What the loop calls by its address at features of a kind.
_CALLED: dict[int, Callable[..., Any]] = {RIM: rim_entry, CURVE: arc_entry}


def compiled_before(scene: Scene | None = None) -> bool:
    """Return whether the compiled loop is at hand (what is compiled last is), with what it calls at the features of a scene."""
    kinds = set() if scene is None else {feature.kind for wall in scene.walls for feature in wall.features()}
    return is_cached(_one_run) and all(is_cached(entry) for kind, entry in _CALLED.items() if kind in kinds)


# An entry, and nothing else: what is called from Python is compiled with other flags, and so would be all that it calls, which
# its kernels call too.
# (One world, in an array: a single record takes 1.5 us to hand over, an array 0.1.)
def _one_run(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    if most == ADVANCE:
        finish(worlds[0], balls, until)
        return DONE, 0, 0, -1, slow, until
    return run(worlds[0], features, balls, log, slow, until, most, users, keep)


# ----------------------------------------------------------------------------------------------------
# Run the event loop as plain Python: for short runs while the compiled loop would have to be compiled, or loaded, first.
#
# A kernel gives the same bits as Python and compiled, so a run may begin here and go on in the compiled loop
# (:mod:`carom.simulation.loop`). Python is some 500 times as slow: a shot of a few balls takes tens of milliseconds; compiling
# takes ten seconds or more, loading half a second.


# Rows of a log that Python may write in a process, at about a millisecond each, until the loop is brought to machine code, or
# compiled, where it does not lie ready.
BEFORE_LOADING, BEFORE_COMPILING = 300, 2000
# In a larger scene one event takes Python too long.
MOST_BALLS, MOST_FEATURES = 24, 200
# A floor that returns more than this of the speed makes a ball bounce so often that Python takes seconds for one event.
MOST_RESTITUTION = 0.99

_written = 0


def worth_interpreting(scene: Scene) -> bool:
    """Return whether the next events of a scene should be run as Python: few balls, and no compiled loop at hand."""
    if is_loaded() or len(scene.balls) > MOST_BALLS or is_at_hand(_one_run):
        return False
    if scene.floor is not None:
        form, numbers, *_ = scene.floor.contact
        # (nor where the floor is tilted: one touch of a curved path takes thousands of integrals)
        if form != CONSTANT or MOST_RESTITUTION < numbers[0] < 1 or any(scene.floor.slope):
            return False
    return _written < (BEFORE_LOADING if compiled_before(scene) else BEFORE_COMPILING)


def run_interpreted(
    worlds: Any, features: Any, balls: Any, log: Any, slow: float, until: float, most: int, users: Any, keep: int
) -> Any:
    """Run :func:`carom.simulation.loop.run` as Python, with the arguments and the answer of the compiled one.

    None where Python refuses what compiled code has a number for, such as a division by zero; ``balls`` are as they were.
    """
    global _written  # noqa: PLW0603
    world, ours, rows = as_objects(worlds)[0], as_objects(balls), as_objects(log)
    try:
        with np.errstate(all="ignore"):  # (laws with tables bring numbers of NumPy's in)
            answer = run(world, as_objects(features), ours, rows, slow, until, most, users, keep)
    except (ArithmeticError, ValueError):
        _written += len(log)
        return None
    _written += answer[2]
    write_back(ours, balls)
    write_back(rows, log, answer[2])
    return answer


# ----------------------------------------------------------------------------------------------------
# The event loop of one scene, as Python or compiled with the same bits, which goes on where it stopped.


# Rows of the log that the loop fills before it is called again: enough for a shot, then more each time.
FIRST_ROWS, MOST_ROWS = 128, 65_536
ENDS = ("nothing more happens", "duration", "max_events")
# One run: the scene, rows of the balls' starts and of the events (carom.simulation.records.LOG), the time up to which the balls
# were followed, s, why it ended (one of ENDS), and the scene as the loop read it.
RunLog = tuple[Scene, NDArray[np.void], float, str, SceneArrays]


class SceneLoop:
    """A scene's balls, which the loop moves from event to event, and a log: made once for all runs of a scene, one at a time."""

    def __init__(self, scene: Scene) -> None:
        self.until, self.most = run_limits(scene)
        self.interpreted = worth_interpreting(scene)
        self.arrays = set_up(scene, compiled=not self.interpreted)
        """The scene as the loop reads it."""
        if self.interpreted and len(self.arrays.features) > MOST_FEATURES:
            self.interpreted, self.arrays = False, set_up(scene)
        # (as bytes: NumPy copies the fields of records one by one)
        self._starts = self.arrays.balls.tobytes()
        self._balls = bytearray(self._starts)
        self._log = bytearray((FIRST_ROWS + len(scene.balls)) * LOG.itemsize)
        self.balls = np.frombuffer(self._balls, BALLS)
        """(B,) of BALLS, each at its last event."""
        self._begin = self._call(np.frombuffer(self._log, LOG), -1.0, self.most)

    def _call(self, log: NDArray[np.void], slow: float, most: int) -> Callable[[], Any]:
        """Return a call that runs at most so many events, until the log is full, in Python or compiled."""
        world, features, _balls, users = self.arrays
        arguments = (world, features, self.balls, log, slow, self.until, most, users, ALL)
        if self.interpreted:
            return functools.partial(run_interpreted, *arguments)
        return fixed(compiled_engine(), arguments)

    def run(self, scene: Scene, progress: Callable[[int, float], None] | None) -> RunLog:
        """Run the scene from its start (:func:`run_scene`)."""
        self._balls[:] = self._starts
        answer = self._begin()
        if answer is None or answer[0] == FULL:
            answer, log = self._go_on(answer, scene, progress)
        else:
            log = self._log[: answer[2] * LOG.itemsize]
        status, _events, _rows, at_fault, _slow, last = answer
        if status not in (DONE, QUIET, LIMIT):
            raise _refusal(status, scene, self.balls[at_fault], at_fault)
        end, ended = last, ENDS[2 if status == LIMIT else 0]
        if status == DONE and self.until < math.inf:
            end, ended = self.until, ENDS[1]
        return scene, np.frombuffer(log, LOG), end, ended, self.arrays

    def _go_on(self, answer: Any, scene: Scene, progress: Callable[[int, float], None] | None) -> tuple[Any, bytearray]:
        """Run on from an answer of the loop whose log was full, or of Python's that was none; return the last one, and all rows."""
        log, found, least = np.frombuffer(self._log, LOG), bytearray(), FIRST_ROWS + len(scene.balls)
        events, slow, pace = 0, -1.0, Pace(4 * least)
        while True:
            if answer is not None:
                found += log[: answer[2]].tobytes()
                events, slow = events + answer[1], answer[4]
                if answer[0] != FULL:
                    return answer, found
                if progress is not None:
                    progress(events, answer[5])
            if self.interpreted and (answer is None or not worth_interpreting(scene)):
                self.interpreted, self.arrays = False, set_up(scene)
            rows = least if self.interpreted else min(max(pace.begin(), least), MOST_ROWS + len(scene.balls))
            log = np.frombuffer(np.empty(rows * LOG.itemsize, np.uint8), LOG)  # (a bytearray is filled with zeros)
            answer = self._call(log, slow, self.most - events)()
            if answer is not None:
                pace.done(answer[2])


def _refusal(code: int, scene: Scene, ball: Any, i: int) -> CaromError:
    return CaromError(
        f"simulate: {scene.ball_names[i]}: expected an event that its law has an answer for, got one at"
        f" t = {float(ball['clock']):.6g} s, x = ({', '.join(f'{x:.4g}' for x in ball['x'])}): {ALL_REFUSALS[code]}"
    )


# ----------------------------------------------------------------------------------------------------
# Run a scene once: the log of its events, and when and why it ends (:func:`carom.simulate` makes a Trajectory of it).


# Where a scene names no end: a ball between elastic walls would never stop.
MOST_EVENTS = 100_000


def run_limits(scene: Scene) -> tuple[float, int]:
    """Return until when, and for how many events at most, a scene is run."""
    run = scene.run
    most = run.max_events if run.max_events is not None else MOST_EVENTS if run.duration is None else 2**62
    return math.inf if run.duration is None else run.duration, most


def run_scene(scene: Scene, progress: Callable[[int, float], None] | None = None) -> RunLog:
    """Run a scene event by event, as Python or compiled, with the same bits.

    ``progress`` is called with the events so far and the simulated time, s. Raises CaromError for an event for which a law has no
    answer.
    """
    try:  # (of two threads, each has its own)
        loop: SceneLoop = scene.kept["loops"].pop()
    except (KeyError, IndexError):
        loop = SceneLoop(scene)
    kept = not loop.interpreted
    found = loop.run(scene, progress)
    if kept:
        scene.kept.setdefault("loops", []).append(loop)
    return found
