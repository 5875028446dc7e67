"""The log of a run: which events are written, and their rows."""

from __future__ import annotations

from typing import Any

from carom.core.jit.kernel import Vec, kernel, vector
from carom.core.motion.phases import HELD
from carom.simulation.cluster_walls import MOST_WALLS, has_hit, wall_impulse, wall_of
from carom.simulation.contacts.contact import DONE, NO_IMPULSE, Outcome, without_impulse
from carom.simulation.contacts.kinds import met_at
from carom.simulation.motion import write_vector
from carom.simulation.records import (
    BALL,
    HELD_EVENT,
    IN_CLUSTER,
    MEETINGS,
    NO_REGIME,
    NOTHING,
    PHASE,
    POCKETED_EVENT,
    START,
    WALL,
    WALL_IN_CLUSTER,
)  # fmt: skip

__all__ = ["ALL", "PHASES_FROM", "ROWS", "motion_of", "note_event", "note_starts", "rows_of_an_event"]

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
