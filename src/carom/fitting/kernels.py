"""What each law says of a measured rebound: kernels from (v_n, v_t, spin) before to the same after.

The wall is x = 0 with the ball at x > 0; v_n is positive toward the wall before and away from it after, v_t runs along
it (y), spin is about z. A ball on a table rolls before the contact, or does a share of it.
"""

from __future__ import annotations

import math
from typing import Any

from carom.kernel import Vec, kernel
from carom.laws.contact import wall_contact
from carom.laws.conventional import conventional_reflection
from carom.laws.landing import ROUNDING, UP, rolls_at_last
from carom.laws.maw import maw_contact
from carom.laws.simultaneous import STALL
from carom.laws.two_step import UNDEFINED, first_impact
from carom.motion.restitution import restitution

__all__ = [
    "AFTER_WALL", "CONTACT", "CONVENTIONAL", "MAW", "ROLLING", "SMOOTH", "TOGETHER", "TURN", "planar", "table"
]  # fmt: skip

# What computes the contact; SMOOTH is a wall and a floor without friction, TURN one contact and then the floor, TOGETHER both.
CONTACT, MAW, SMOOTH, CONVENTIONAL, TURN, TOGETHER = range(6)
# When the ball was measured after the contact
AFTER_WALL, ROLLING = 0, 1
LINE = 5


@kernel
def speed_restitution(form: int, p: Vec, speed: float) -> float:
    """e at a speed of approach: a form of :mod:`carom.motion.restitution`, or the line v_out = p0 v + p1."""
    if form == LINE:
        e = p[0] + p[1] / speed
        return max(e, 0 * e)  # as drawn: below offset / (1 - slope) it gives speed
    return restitution(form, p, speed)


@kernel
def planar(code: int, form: int, _stage: int, x: Vec, a: float, p: Any) -> Vec:
    """A planar bounce after the wall: v_n, v_t, spin. ``p`` as in :data:`carom.fitting.parameters.PARAMETERS`."""
    zero = 0 * x[0]
    e = speed_restitution(form, (p[0], p[1], p[2]), x[0])
    v, w, n = (-x[0], x[1], zero), (zero, zero, x[2]), (1 + zero, zero, zero)
    if code == MAW:
        v1, w1 = maw_contact(v, w, n, a, p[5], e, p[3], p[6])
    else:
        v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, p[5], e, p[3], p[4])
    return v1[0], v1[1], w1[2]


@kernel
def table(code: int, form: int, stage: int, x: Vec, a: float, p: Any) -> Vec:
    """A ball on a table, as it leaves the wall or once it rolls again: v_n, v_t, spin about the vertical; NaN: no answer."""
    zero = 0 * x[0]
    up = 1 - p[7]
    n = (math.sqrt(1 - up * up), zero, up)
    v = (-x[0], x[1], zero)
    # (18), as much of it as there is
    w = (-p[11] * x[1] / a, -p[11] * x[0] / a, x[2])
    if code == CONVENTIONAL:
        v1, w1 = conventional_reflection(v, (-x[1] / a, -x[0] / a, x[2]), (1 + zero, zero, zero), a, p[5])
        return v1[0], v1[1], w1[2]
    e = speed_restitution(form, (p[0], p[1], p[2]), x[0] * n[0])
    if code == SMOOTH:
        return e * x[0], x[1], x[2]
    if code == MAW:
        v1, w1 = maw_contact(v, w, n, a, p[5], e, p[3], p[6])
    else:
        v1, w1, _j, _jf, _required, regime = first_impact(
            v, w, n, a, p[5], e, p[3], p[4], p[9], p[8], zero, zero, code == TOGETHER
        )
        if regime in (UNDEFINED, STALL):
            return math.nan, math.nan, math.nan
    if stage == ROLLING:
        # (39)
        v1, w1 = rolls_at_last(v1, w1, a, p[5])
    elif v1[2] < -ROUNDING * x[0]:  # pushed on the floor: it lands in the same instant, and leaves as the floor lets it
        v1, w1, _j, _required, _regime = wall_contact(v1, w1, UP, a, p[5], p[9], p[8], zero)
    return v1[0], v1[1], w1[2]
