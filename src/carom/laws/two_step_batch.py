"""The two-step law for many balls in existing arrays; pressed balls take their integration steps in lockstep.

The steps are the same as in :mod:`carom.laws.wall_and_floor.integrators`, in vector registers.

The balls of a block that slide at both contacts occupy lanes; all lanes take one step at a time, and finished balls are
replaced by others. A ball whose slip vanishes is integrated on its own (:func:`carom.laws.wall_and_floor.solver.integrate_impact`)
until both contacts slide again. Lanes are independent, so a ball's result is bitwise the same whatever balls surround it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, State, Surface
from carom.core.jit.kernel import Vec, kernel, prange
from carom.core.jit.threads import thread_count
from carom.errors import CaromError
from carom.laws.arrays import loop_for, one_normal, reason_array, state_arrays
from carom.laws.landing import PAPER_FLOOR, PAPER_WALL, FloorContact, landing_settings, rolling_after
from carom.laws.two_step import two_step_final, two_step_plain
from carom.laws.wall_and_floor.integrators import DONE, GOES, REACH, sliding_step
from carom.laws.wall_and_floor.rates import Couplings, Pair, Slips, from_wall_frame, to_wall_frame
from carom.laws.wall_and_floor.solver import (
    AGAIN,
    LEAST_SLIP,
    STALL,
    error_allowed,
    integrate_impact,
    pressed_down,
    slides_at_both,
)
from carom.public.defaults import GRAVITY

Array = NDArray[Any]

LANES, TOGETHER = 64, 8
# Contents of a lane: six numbers of the state, both directions, compressed or not, energy to return, reach, error, speed,
# least slip, continuation code, index of the ball, impulse on entry.
_DW, _DF, _COMPRESSED, _PEAK, _REACH, _ERROR = (k * LANES for k in (6, 8, 10, 11, 12, 13))
_SPEED, _LEAST, _GOES, _BALL, _CAME = (k * LANES for k in (14, 15, 16, 17, 18))
HELD = 19
ROOM = HELD * LANES


@kernel
def _step_lanes(s: Array, lanes: int, q: Couplings, e: float) -> None:
    """Take one step in each lane. In one flat array with fixed strides the compiler can see that lanes do not overlap.

    Steps are taken in whole groups of lanes. The lanes that fill the last group are copies of the first lane: what they held
    before, memory that nobody wrote or a ball that is done, need not be a state from which a step can be taken.
    """
    whole = (lanes + TOGETHER - 1) // TOGETHER * TOGETHER
    for i in range(lanes, whole):
        for r in range(HELD):
            s[i + r * LANES] = s[r * LANES]
    for i in range(whole):
        state = (s[i], s[i + LANES], s[i + 2 * LANES], s[i + 3 * LANES], s[i + 4 * LANES], s[i + 5 * LANES])
        dw, df = (s[i + _DW], s[i + _DW + LANES]), (s[i + _DF], s[i + _DF + LANES])
        y, compressed, peak, reach, goes = sliding_step(
            state, dw, df, s[i + _COMPRESSED] > 0, s[i + _PEAK], s[i + _REACH], s[i + _ERROR], s[i + _SPEED], s[i + _LEAST],
            q, e,
        )  # fmt: skip
        s[i], s[i + LANES], s[i + 2 * LANES] = y[0], y[1], y[2]
        s[i + 3 * LANES], s[i + 4 * LANES], s[i + 5 * LANES] = y[3], y[4], y[5]
        s[i + _COMPRESSED] = 1.0 if compressed else 0.0
        s[i + _PEAK] = peak
        s[i + _REACH] = reach
        s[i + _GOES] = goes


@kernel
def _store_state(s: Array, i: int, y: Slips, p: float, dw: Pair, df: Pair, compressed: bool, peak: float) -> None:
    """Store a state in a lane."""
    s[i], s[i + LANES], s[i + 2 * LANES], s[i + 3 * LANES], s[i + 4 * LANES], s[i + 5 * LANES] = (
        y[0],
        y[1],
        y[2],
        y[3],
        y[4],
        p,
    )
    s[i + _DW], s[i + _DW + LANES] = dw
    s[i + _DF], s[i + _DF + LANES] = df
    s[i + _COMPRESSED] = 1.0 if compressed else 0.0
    s[i + _PEAK] = peak
    s[i + _REACH] = REACH
    s[i + _CAME] = p


@kernel
def _enter_lane(
    s: Array, i: int, ball: int, v: Vec, w: Vec, n: Vec, a: float, kappa: float, mu: float, ef: float, muf: float, betaf: float
) -> bool:  # fmt: skip
    """Put a ball into a lane; False if it does not slide at both contacts."""
    v1, _s, _j, _frame, q, slips, speed, scale = to_wall_frame(v, w, n, a, kappa, mu, ef, muf, betaf)
    if not speed > 0:
        return False
    slides, y, dw, df = slides_at_both(slips, v1[2], q, scale)
    if slides:
        _store_state(s, i, y, 0 * scale, dw, df, True, 0 * scale)
        s[i + _CAME] = -1.0
        s[i + _ERROR] = error_allowed(speed, scale)
        s[i + _SPEED] = speed
        s[i + _LEAST] = LEAST_SLIP * scale
        s[i + _BALL] = ball
    return slides


@kernel
def _load_vector(x: Array, ball: int) -> Vec:
    return x[3 * ball], x[3 * ball + 1], x[3 * ball + 2]


@kernel
def _store_vector(x: Array, ball: int, to: Vec) -> None:
    x[3 * ball], x[3 * ball + 1], x[3 * ball + 2] = to


@kernel
def pressed_block(
    v: Array, w: Array, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, h: float, together: bool,
    v3: Array, w3: Array, why: Array, s: Array,
) -> None:  # fmt: skip
    """:func:`carom.laws.two_step.two_step_final` of the undecided balls of a block (``why`` < 0); s: ROOM numbers."""
    smooth = beta == -1 or mu == 0
    muw = 0 * e if smooth else mu
    _v, _s, _j, _frame, q, _slips, _speed, _scale = to_wall_frame(n, n, n, a, kappa, muw, ef, muf, betaf)
    lanes, ball = 0, 0
    left = together and (smooth or beta == 0)
    while left:
        while lanes < LANES and ball < why.shape[0]:
            if why[ball] < 0:
                x, y = _load_vector(v, ball), _load_vector(w, ball)
                if pressed_down(x, y, n, a, mu, h) and _enter_lane(
                    s, lanes, ball, x, y, n, a, kappa, muw, ef, muf, betaf
                ):
                    lanes += 1
            ball += 1
        _step_lanes(s, lanes, q, e)
        i = 0
        while i < lanes:
            if s[i + _GOES] == GOES:
                i += 1
                continue
            k = int(s[i + _BALL])
            x, y = _load_vector(v, k), _load_vector(w, k)
            met = to_wall_frame(x, y, n, a, kappa, muw, ef, muf, betaf)
            slips = (s[i], s[i + LANES], s[i + 2 * LANES], s[i + 3 * LANES], s[i + 4 * LANES])
            p, up = s[i + 5 * LANES], 0 * a
            found = s[i + _GOES] == DONE
            if (
                not found
            ):  # on its own for a while, or to the end; a ball that made no progress is not put back in a lane
                slips, up, p, regime, compressed, peak, dw, df, _way = integrate_impact(
                    slips, up, q, e, kappa, ef, muf, betaf, met[6], met[7],
                    p, s[i + _COMPRESSED] > 0, s[i + _PEAK], p > s[i + _CAME], 0,
                )  # fmt: skip
                if regime == AGAIN:
                    _store_state(s, i, slips, p, dw, df, compressed, peak)
                    i += 1
                    continue
                found = regime != STALL
            if found:
                x, y, _wall, _floor = from_wall_frame(x, y, a, kappa, met, slips, up, p)
                x, y, why[k] = rolling_after(x, y, n, a, kappa, ef, muf, betaf, g, h)
                _store_vector(v3, k, x)
                _store_vector(w3, k, y)
            lanes -= 1
            for r in range(HELD):
                s[i + r * LANES] = s[lanes + r * LANES]
        left = lanes > 0 or ball < why.shape[0]
    for k in range(why.shape[0]):
        if why[k] < 0:
            x, y = _load_vector(v, k), _load_vector(w, k)
            x, y, why[k] = two_step_final(x, y, n, a, kappa, e, mu, beta, ef, muf, betaf, g, h, together)
            _store_vector(v3, k, x)
            _store_vector(w3, k, y)


BLOCK = 1024  # balls


@kernel
def _two_step_block(
    v: Array, w: Array, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, together: bool,
    v3: Array, w3: Array, why: Any,
) -> None:  # fmt: skip
    for i in range(v.shape[0] // 3):
        k = 3 * i
        x, y, plain = two_step_plain(
            (v[k], v[k + 1], v[k + 2]), (w[k], w[k + 1], w[k + 2]), n,
            a, kappa, e, mu, beta, ef, muf, betaf, g, together,
        )  # fmt: skip
        v3[k], v3[k + 1], v3[k + 2] = x[0], x[1], x[2]
        w3[k], w3[k + 1], w3[k + 2] = y[0], y[1], y[2]
        why[i] = 0 if plain else -1


def two_step_final_rows(
    v: Array, w: Array, n: Array, p: Array, together: bool, v3: Array, w3: Array, why: Any, rooms: Array
) -> None:  # fmt: skip
    """Compute the rolling state of the two-step law per row: first the simple balls of a block, then the others in full.

    Parameters a, kappa, e, mu, beta, the floor's e, mu, beta, gravity, height. ``rooms``: ROOM numbers to work in for each thread,
    which takes every so many-th block.
    """
    normal, count = (n[0], n[1], n[2]), v.shape[0]
    a, kappa, e, mu, beta = p[0], p[1], p[2], p[3], p[4]
    ef, muf, betaf, g, h = p[5], p[6], p[7], p[8], p[9]
    stride = 3 * BLOCK * rooms.shape[0]
    for room in prange(rooms.shape[0]):
        for i in range(3 * BLOCK * room, count, stride):
            k = min(i + 3 * BLOCK, count)
            _two_step_block(
                v[i:k], w[i:k], normal, a, kappa, e, mu, beta, ef, muf, betaf, g, together,
                v3[i:k], w3[i:k], why[i // 3 : k // 3],
            )  # fmt: skip
            pressed_block(
                v[i:k], w[i:k], normal, a, kappa, e, mu, beta, ef, muf, betaf, g, h, together,
                v3[i:k], w3[i:k], why[i // 3 : k // 3], rooms[room],
            )  # fmt: skip


def two_step_into(
    out: State, why: NDArray[np.int8], ball: Ball, state: State, wall: Surface = PAPER_WALL, floor: Surface = PAPER_FLOOR,
    normal: ArrayLike = (1.0, 0.0, 0.0), gravity: float = GRAVITY, height: float = 0.0, floor_contact: FloorContact = "with",
) -> None:  # fmt: skip
    """Write the rolling states of :func:`two_step` into existing arrays; one normal, ball, wall and floor for all N balls.

    The states are not validated. Source: the paper, (27)-(41).

    Parameters
    ----------
    out : State
        Receives velocities (m/s) and spins (rad/s), contiguous arrays of shape (N, 3); NaN where the ball never rolls. Begin with
        zeros: a State is not made of what ``np.empty`` leaves, which need not be a finite number.
    why : array (N,) of int8
        Receives 0 where the ball rolls; elsewhere ``carom.laws.landing.REASONS[why]`` is the reason.
    ball : Ball
        The same for all; its numbers are scalars.
    state : State
        Velocities and spins before the wall, shape (N, 3).
    wall, floor : Surface
        The same for all; their numbers are scalars.
    normal : array (3,)
        From the wall to the ball; any length.
    gravity : float
        m/s^2.
    height : float
        Of the centre above its position when the ball rests on the floor, m.
    floor_contact : "with" or "after"
        As in :func:`two_step`.

    Returns
    -------
    None
        The results are in ``out`` and ``why``.

    Raises
    ------
    CaromError
        If ``why`` or an array of ``out`` has another shape or type, is not contiguous, or shares its memory with ``state``; for
        several normals; for an invalid normal, gravity or height.

    Examples
    --------
    >>> import carom, numpy as np
    >>> ball = carom.Ball()
    >>> before = carom.rolling(ball, [(-1.0, 1.0), (-2.0, 1.0)])
    >>> after, why = carom.State(np.zeros((2, 3)), np.zeros((2, 3))), np.zeros(2, np.int8)
    >>> carom.two_step_into(after, why, ball, before)
    >>> after.velocity.round(4).tolist(), why.tolist()
    ([[0.6327, 0.7959, 0.0], [1.2653, 0.7959, 0.0]], [0, 0])
    """
    g, h, together = landing_settings(gravity, height, floor_contact)
    parameters = (
        ball.radius, ball.kappa, wall.restitution, wall.friction, wall.tangential_restitution,
        floor.restitution, floor.friction, floor.tangential_restitution, g, h,
    )  # fmt: skip
    v, w, v3, w3 = state_arrays(state, out)
    # (pressed balls are computed when the other balls of their block have been written)
    if any(np.may_share_memory(x, y) for x in (v, w) for y in (v3, w3)):
        raise CaromError(
            "out: expected arrays apart from the state's own, got the same memory; write into a State of zeros"
        )
    count = len(v) // 3
    rooms = np.empty((min(thread_count(), (count + BLOCK - 1) // BLOCK), ROOM))
    loop = loop_for(two_step_final_rows, count)
    loop(v, w, one_normal(normal), np.array(parameters), together, v3, w3, reason_array(state, why), rooms)
