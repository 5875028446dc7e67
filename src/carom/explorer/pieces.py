"""The motion of a ball between its events as pieces that a page draws: parabolas, with spins that change at a constant rate."""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import Vec, kernel, vector
from carom.core.motion.phases import BOUNCING, HELD
from carom.simulation.motion import begin_phase, is_in_air, move_by, set_to_row

PIECE = 0.05  # s: a ball whose acceleration decays is drawn by parabolas so short, 1e-7 m from its path
IN_AIR_PIECE = 0.01  # s: so is one in air, 1e-5 m from its path
ZERO: Vec = (0.0, 0.0, 0.0)


def piece_rows(worlds: Any, balls: Any, log: Any, number: int, end: float, until: float, final: Any, out: Any) -> Any:
    """Write the pieces of ball ``number``, and its position, velocity and spin at the time ``until``; return the pieces' number.

    ``balls`` is a record of the ball to work in, ``end`` the end of its last motion (inf: nothing more happens).
    """
    world, ball = worlds[0], balls[0]
    count, last = 0, -1
    for i in range(log.shape[0]):
        if log[i].ball != number:
            continue
        if last >= 0:
            count = _put_motion(world, ball, log[last], log[i].t, False, count, out)
        last = i
    count = _put_motion(world, ball, log[last], end, True, count, out)
    _begin(world, ball, log[last])
    if ball.phase < HELD:
        move_by(world, ball, until - log[last].t, 0.0)
    for k in range(3):
        final[k], final[3 + k], final[6 + k] = ball.x[k], ball.v[k], ball.w[k]
    return count


@kernel
def _begin(world: Any, ball: Any, row: Any) -> None:
    """Bring the ball into the state of a row of the log."""
    set_to_row(ball, row)
    ball.clock = 0.0
    begin_phase(world, ball)


@kernel
def _put_motion(world: Any, ball: Any, row: Any, end: float, is_last: bool, i: int, out: Any) -> int:
    """Write the pieces from a row of the log to a time; return the number of the next one."""
    lasts = end - row.t
    if not lasts > 0 and not is_last:
        return i
    _begin(world, ball, row)
    x, w, turn = vector(row.x), vector(row.w), vector(ball.turn)
    if ball.phase >= HELD:
        return _put(row.t, lasts, x, ZERO, w, ZERO, ZERO, row.phase, i, out)
    if ball.phase == BOUNCING:
        # bounces too low to see, as the straight line from the first to the last
        v = ZERO
        if lasts > 0:
            move_by(world, ball, lasts, 0.0)
            v = ((ball.x[0] - x[0]) / lasts, (ball.x[1] - x[1]) / lasts, 0.0)
        return _put(row.t, lasts, x, v, w, ZERO, turn, row.phase, i, out)
    piece = IN_AIR_PIECE if is_in_air(ball) else PIECE
    parts = math.ceil(lasts / piece) if ball.decays != 0 and piece < lasts < math.inf else 1
    for k in range(parts):
        begin = k * piece
        if k > 0:
            _begin(world, ball, row)
            move_by(world, ball, begin, 0.0)
            begin_phase(world, ball)
        long = lasts - begin if k == parts - 1 else piece
        i = _put_until_spin_ends(
            row.t + begin,
            long,
            vector(ball.x),
            vector(ball.v),
            vector(ball.w),
            vector(ball.acc),
            vector(ball.turn),
            row.phase,
            i,
            out,
        )
    return i


@kernel
def _put_until_spin_ends(
    t: float, lasts: float, x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, phase: int, i: int, out: Any
) -> int:
    """Write a piece; one in which the spin about the vertical fades to zero, where it stays, is two."""
    s = -w[2] / turn[2] if turn[2] != 0 else 0.0
    if not 0 < s < lasts:
        return _put(t, lasts, x, v, w, acc, turn, phase, i, out)
    i = _put(t, s, x, v, w, acc, turn, phase, i, out)
    half = s * s / 2
    x1 = (x[0] + v[0] * s + acc[0] * half, x[1] + v[1] * s + acc[1] * half, x[2] + v[2] * s + acc[2] * half)
    v1 = (v[0] + acc[0] * s, v[1] + acc[1] * s, v[2] + acc[2] * s)
    w1 = (w[0] + turn[0] * s, w[1] + turn[1] * s, 0.0)
    return _put(t + s, lasts - s, x1, v1, w1, acc, (turn[0], turn[1], 0.0), phase, i, out)


@kernel
def _put(t: float, lasts: float, x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, phase: int, i: int, out: Any) -> int:
    """Write a piece; return the number of the next one."""
    if i < out.shape[0]:
        out[i, 0], out[i, 1], out[i, 17] = t, lasts, phase
        for k in range(3):
            out[i, 2 + k], out[i, 5 + k], out[i, 8 + k], out[i, 11 + k], out[i, 14 + k] = (
                x[k],
                v[k],
                w[k],
                acc[k],
                turn[k],
            )
    return i + 1
