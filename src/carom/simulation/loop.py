"""The event loop: take the earliest event, resolve it, predict what comes next. There is no time step.

Each ball has its own clock, the time of its last event, and one predicted event. Where that has become invalid (the other ball of
the pair met something first) it is predicted anew. Of events at one instant, the ball that has had the fewest at its place comes
first, then the one with the lower number, so that the same input gives the same bits on every run.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import dot, kernel, vector
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, PIVOTING
from carom.simulation.contacts.contact import DONE
from carom.simulation.contacts.kinds import met_at, resolve_event
from carom.simulation.event_rows import ALL, motion_of, note_event, note_starts, rows_of_an_event
from carom.simulation.motion import begin_phase, move_by, on_floor_with, write_vector
from carom.simulation.predict import predict
from carom.simulation.records import BALL, HELD_EVENT, NOTHING, WALL
from carom.simulation.resting_contact import stays_clear

__all__ = ["FULL", "LIMIT", "QUIET", "finish", "run"]

# How a call of ``run`` ends, apart from the refusals of contacts: DONE (no more events before the end), the log is full (call
# again), the number of events is reached, or no event will ever follow and nothing moves.
FULL, LIMIT, QUIET = 10, 11, 12
# A ball with so many events at one place is caught between things that send it to and fro without end.
PINNED = 10_000
# Below this share of the speeds a ball in contact is not approaching. It is far above rounding, and no distance in any run.
SLOW = 1e-14


@kernel
def _start(world: Any, features: Any, balls: Any) -> float:
    """Set phases, clocks and first events; return the speed below which a ball in contact is not approaching."""
    force = vector(world.force)
    pull = math.sqrt(dot(force, force))
    fastest = 0.0
    for i in range(balls.shape[0]):
        ball = balls[i]
        v, w, a = vector(ball.v), vector(ball.w), ball.radius
        speed = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w)) + math.sqrt(pull * a)
        fastest = max(fastest, speed)
        phase = FLIGHT
        if world.floor != 0 and abs(ball.x[2] - a) <= 1e-9 * a:
            ball.x[2] = a
            if abs(v[2]) <= 1e-12 * speed:
                phase, v, w = on_floor_with(world, ball, v, w)
        ball.phase = phase
        write_vector(ball.v, v)
        write_vector(ball.w, w)
        ball.clock, ball.repeats, ball.energy = 0.0, 0, math.nan
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
def _look_ahead(world: Any, features: Any, balls: Any, i: int, k: int, t: float, slow: float) -> None:
    """Predict what comes next after balls i and k (the same, or a pair) have changed their phases at time t."""
    begin_phase(world, balls[i])
    if k != i:
        begin_phase(world, balls[k])
        balls[k].next_at = math.inf  # it has no event yet: its path is valid for ever
    for m in range(balls.shape[0]):
        ball = balls[m]
        if ball.phase == BOUNCING and m not in (i, k) and not stays_clear(features, balls, m, ball.lasts):
            # something may reach it before its bounces end, which are followed one by one from here on
            move_by(world, ball, t - ball.clock, t)
            ball.phase = FLIGHT
            begin_phase(world, ball)
            predict(world, features, balls, m, slow)
    predict(world, features, balls, i, slow)
    if k != i:
        predict(world, features, balls, k, slow)
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
    events = rows = 0
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
        if balls[i].phase < HELD and t > balls[i].clock:
            move_by(world, balls[i], t - balls[i].clock, t)
