"""Predictions of the laws for a rebound: kernels that map (v_n, v_t, spin) before the wall to the same after it.

The wall is x = 0 with the ball at x > 0; v_n is positive toward the wall before and away from it after, v_t runs along
it (y), spin is about z. A ball on a table rolls before the contact, or has a fraction ``roll`` of rolling. ``p`` is a record of
:data:`carom.fitting.parameters.LAW_NUMBERS`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import wall_contact
from carom.core.jit.kernel import Vec, kernel
from carom.core.motion.phases import ROUNDING
from carom.core.motion.restitution import restitution
from carom.core.motion.rolling import UP, rolls_at_last
from carom.fitting.parameters import LINE
from carom.laws.callbacks import call_user
from carom.laws.conventional import conventional_reflection
from carom.laws.two_step import UNDEFINED, first_impact
from carom.laws.wall_and_floor.solver import STALL

__all__ = [
    "AFTER_WALL", "CONTACT", "CONVENTIONAL", "ROLLING", "SMOOTH", "TOGETHER", "TURN", "planar", "table"
]  # fmt: skip

# Contact models that are compiled in. SMOOTH: wall and floor without friction; TURN: the wall and then the floor; TOGETHER: both
# at once. Any other code is the address of a law's kernel (carom.laws.callbacks); with a minus sign where the last number that
# the kernel takes is the stiffness ratio in place of the tangential restitution.
CONTACT, SMOOTH, CONVENTIONAL, TURN, TOGETHER = range(5)
# Stages at which the outgoing ball was measured
AFTER_WALL, ROLLING = 0, 1


@kernel
def speed_restitution(form: int, p: Vec, speed: float) -> float:
    """Return e at a speed of approach: a form of :mod:`carom.core.motion.restitution`, or the line v_out = p0 v + p1."""
    if form == LINE:
        e = p[0] + p[1] / speed
        return max(e, 0 * e)  # above 1 at speeds below offset / (1 - slope)
    return restitution(form, p, speed)


@kernel
def planar(code: int, form: int, _stage: int, x: Vec, a: float, p: Any) -> Vec:
    """Return v_n, v_t and spin of a planar bounce after the wall."""
    zero = 0 * x[0]
    e = speed_restitution(form, (p.restitution, p.restitution_1, p.restitution_2), x[0])
    v, w, n = (-x[0], x[1], zero), (zero, zero, x[2]), (1 + zero, zero, zero)
    if code < 0 or code > TOGETHER:
        last = p.stiffness_ratio if code < 0 else p.tangential_restitution
        v1, w1 = call_user(abs(code), v, w, n, a, p.kappa, e, p.friction, last)
    else:
        v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, p.kappa, e, p.friction, p.tangential_restitution)
    return v1[0], v1[1], w1[2]


@kernel
def table(code: int, form: int, stage: int, x: Vec, a: float, p: Any) -> Vec:
    """Return v_n, v_t and vertical spin of a ball on a table, after the wall or once it rolls again; NaN: undefined."""
    zero = 0 * x[0]
    up = 1 - p.contact_height
    n = (math.sqrt(1 - up * up), zero, up)
    v = (-x[0], x[1], zero)
    # (18), times the fraction of rolling
    w = (-p.roll * x[1] / a, -p.roll * x[0] / a, x[2])
    if code == CONVENTIONAL:
        v1, w1 = conventional_reflection(v, (-x[1] / a, -x[0] / a, x[2]), (1 + zero, zero, zero), a, p.kappa)
        return v1[0], v1[1], w1[2]
    e = speed_restitution(form, (p.restitution, p.restitution_1, p.restitution_2), x[0] * n[0])
    if code == SMOOTH:
        return e * x[0], x[1], x[2]
    if code < 0 or code > TOGETHER:
        last = p.stiffness_ratio if code < 0 else p.tangential_restitution
        v1, w1 = call_user(abs(code), v, w, n, a, p.kappa, e, p.friction, last)
    else:
        v1, w1, _j, _jf, _required, regime = first_impact(
            v,
            w,
            n,
            a,
            p.kappa,
            e,
            p.friction,
            p.tangential_restitution,
            p.floor_restitution,
            p.floor_friction,
            zero,
            zero,
            code == TOGETHER,
        )
        if regime in (UNDEFINED, STALL):
            return math.nan, math.nan, math.nan
    if stage == ROLLING:
        # (39)
        v1, w1 = rolls_at_last(v1, w1, a, p.kappa)
    elif v1[2] < -ROUNDING * x[0]:  # pushed onto the floor: it bounces off the floor at once
        v1, w1, _j, _required, _regime = wall_contact(
            v1, w1, UP, a, p.kappa, p.floor_restitution, p.floor_friction, zero
        )
    return v1[0], v1[1], w1[2]
