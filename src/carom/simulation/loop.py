"""The event loop: take the earliest event, resolve it, predict what comes next. There is no time step.

Each ball has its own clock, the time of its last event, and one predicted event. Where that has become invalid (the other ball of
the pair met something first) it is predicted anew. Of events at one instant, the ball that has had the fewest at its place comes
first, then the one with the lower number, so that the same input gives the same bits on every run.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import FALLS, GOES_ON, OVER
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, LEFT, PIVOTING, POCKETED, grounded, next_phase
from carom.simulation.predict import begin_phase, move_by, predict, write_vector
from carom.simulation.records import (
    BALL,
    FLOOR,
    HELD_EVENT,
    IN_CLUSTER,
    LEFT_EVENT,
    NO_REGIME,
    NOTHING,
    PHASE,
    POCKETED_EVENT,
    SETTLED,
    START,
    WALL,
)
from carom.simulation.resolve import DONE, meet_ball, meet_floor, meet_wall
from carom.simulation.resting_contact import stays_clear

__all__ = ["ALL", "FULL", "LIMIT", "PHASES_FROM", "QUIET", "ROWS", "finish", "rows_of_an_event", "run"]

# How a call of ``run`` ends, apart from the errors of resolve: DONE (no more events before the end), the log is full (call again),
# the number of events is reached, or no event will ever follow and nothing moves.
FULL, LIMIT, QUIET = 10, 11, 12
# A ball with so many events at one place is caught between things that send it to and fro without end.
PINNED = 10_000
# Below this share of the speeds a ball in contact is not approaching. It is far above rounding, and no distance in any run.
SLOW = 1e-14
# Rows that one event can write, IN_CLUSTER aside: both balls, and that both are held.
ROWS = 4
# Which events are logged: bit ``kind``; for the end of a phase, bit PHASES_FROM + the phase that begins.
ALL, PHASES_FROM = -1, 16


@kernel
def rows_of_an_event(balls: int, keep: int) -> int:
    """Return how many rows one event of a scene of so many balls can write at most: where contacts overlap, one for each ball."""
    return max(ROWS, balls) if (keep >> IN_CLUSTER) & 1 != 0 else ROWS


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
                phase, v, w = grounded(v, w, a, ball.kappa, world.g, world.floor_mu)
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
def _note(log: Any, ball: Any, kind: int, i: int, met: int, other: int, v: Vec, w: Vec, phase: int) -> None:
    """Write a row of the log: ball i as it is now, and (v, w) and its phase before."""
    log.t, log.kind, log.ball, log.met, log.other = ball.clock, kind, i, met, other
    write_vector(log.x, vector(ball.x))
    write_vector(log.v_before, v)
    write_vector(log.w_before, w)
    write_vector(log.v, vector(ball.v))
    write_vector(log.w, vector(ball.w))
    log.phase_before, log.phase = phase, ball.phase
    none = (0.0, 0.0, 0.0)
    write_vector(log.impulse, none)
    write_vector(log.floor_impulse, none)
    log.required, log.regime = 0.0, NO_REGIME


@kernel
def _note_impulse(log: Any, j: Vec, jf: Vec, required: float, regime: int) -> None:
    write_vector(log.impulse, j)
    write_vector(log.floor_impulse, jf)
    log.required, log.regime = required, regime


@kernel
def _note_held(log: Any, rows: int, ball: Any, i: int, met: int, other: int, before: int) -> int:
    """Write that a ball is held, if it is; return how many rows there are then."""
    if ball.phase != HELD:
        return rows
    _note(log[rows], ball, HELD_EVENT, i, met, other, vector(ball.v), vector(ball.w), before)
    return rows + 1


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
def _happen(
    world: Any, features: Any, balls: Any, i: int, users: Any
) -> tuple[int, int, Vec, Vec, float, int, int, int]:
    """Resolve the event of ball i, which is at its place: return kind, partner, impulses, required friction, regime, error code.

    And how many balls were touched where contacts overlap in time, else 0.
    """
    ball = balls[i]
    kind, who = ball.next_kind, ball.next_who
    none = (0.0, 0.0, 0.0)
    if kind != WALL:
        ball.energy = balls[who if kind == BALL else i].energy = math.nan
    j, jf, required, regime, refusal, many = none, none, 0.0, NO_REGIME, DONE, 0
    if ball.repeats > PINNED:
        if kind == BALL and balls[who].repeats > 0:  # the other one has not moved either
            balls[who].phase = HELD
        who = features[who].wall if kind == WALL else who
        kind, ball.phase = HELD_EVENT, HELD
    elif kind == FLOOR:
        j, required, regime = meet_floor(world, features, balls, i)
    elif kind == BALL:
        j, required, regime, many = meet_ball(world, balls, i, who, users)
    elif kind == WALL:
        f = features[who]
        who = f.wall
        if f.kind != OVER:
            j, jf, required, regime, refusal = meet_wall(world, f, ball, users)
        elif f.ends == FALLS:
            kind, who, ball.phase = POCKETED_EVENT, f.at, POCKETED
        else:
            kind = LEFT_EVENT
            if f.ends != GOES_ON:
                ball.phase = LEFT
    else:
        v, w = vector(ball.v), vector(ball.w)
        if kind == SETTLED:
            ball.phase, v, w = grounded(v, w, ball.radius, ball.kappa, world.g, world.floor_mu)
        else:
            ball.phase, v, w = next_phase(ball.phase, v, w, ball.radius, ball.kappa)
        write_vector(ball.v, v)
        write_vector(ball.w, w)
    return kind, who, j, jf, required, regime, refusal, many


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
def _note_cluster(log: Any, rows: int, balls: Any, many: int, keep: int) -> int:
    """Write the rows of the balls of a cluster; return how many rows there are then."""
    for p in range(many):
        i = balls[p].touched
        ball, kind = balls[i], BALL if p < 2 else IN_CLUSTER
        if (keep >> kind) & 1 != 0:
            m, v, u = ball.mass, ball.v, ball.dv
            _note(log[rows], ball, kind, i, BALL, ball.met, vector(u), vector(ball.dw), ball.was)
            write_vector(log[rows].impulse, (m * (v[0] - u[0]), m * (v[1] - u[1]), m * (v[2] - u[2])))
            rows += 1
    return rows


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
            for k in range(balls.shape[0]):
                one = balls[k]
                _note(log[k], one, START, k, NOTHING, -1, vector(one.v), vector(one.w), one.phase)
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
        room = rows + rows_of_an_event(balls.shape[0], keep) <= log.shape[0]
        if keep == ALL and not room:
            return FULL, events, rows, -1, slow, _last(balls)
        events += 1
        k = ball.next_who if ball.next_kind == BALL else i
        other = balls[k]
        before, before_k = ball.phase, other.phase
        met = ball.next_kind if ball.next_kind in (WALL, BALL) else NOTHING
        move_by(world, ball, ball.next_in, t)
        if k != i:
            move_by(world, other, t - other.clock, t)
        v, w, vk, wk = vector(ball.v), vector(ball.w), vector(other.v), vector(other.w)
        kind, who, j, jf, required, regime, refusal, many = _happen(world, features, balls, i, users)
        if refusal != DONE:
            return refusal, events, rows, i, slow, _last(balls)
        if many > 0:
            rows = _note_cluster(log, rows, balls, many, keep if room else 0)
            _look_ahead_of(world, features, balls, many, t, slow)
            continue
        if room and (keep >> (PHASES_FROM + ball.phase if kind == PHASE else kind)) & 1 != 0:
            _note(log[rows], ball, kind, i, kind if kind == POCKETED_EVENT else met, who, v, w, before)
            _note_impulse(log[rows], j, jf, required, regime)
            rows += 1
            if kind == BALL:
                _note(log[rows], other, kind, k, met, i, vk, wk, before_k)
                _note_impulse(log[rows], (-j[0], -j[1], -j[2]), jf, required, regime)
                rows += 1
        if room and (keep >> HELD_EVENT) & 1 != 0:  # what is held now is held by what it met
            if kind != HELD_EVENT:
                rows = _note_held(log, rows, ball, i, met, who, before)
            if k != i:
                rows = _note_held(log, rows, other, k, met, i, before_k)
        _look_ahead(world, features, balls, i, k, t, slow)


@kernel
def finish(world: Any, balls: Any, t: float) -> None:
    """Advance every ball that is still followed to the time t."""
    for i in range(balls.shape[0]):
        if balls[i].phase < HELD and t > balls[i].clock:
            move_by(world, balls[i], t - balls[i].clock, t)
