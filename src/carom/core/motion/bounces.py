"""Sum infinitely many bounces in a finite time (Zeno), to the last bit.

A ball on a floor of restitution e < 1 bounces ever lower: its bounces last 2 v_z/g, 2 e v_z/g, ... and end after
2 v_z/(g (1 - e)). Each landing rubs, so velocity and spin change with every one, from slip to stick and, with tangential
restitution, perhaps back. The series is followed hop by hop, without events, until what is left is below the rounding of
the sums, and that is added as a geometric series: nothing is cut off, and e may depend on the speed (its limit closes the
series).
"""

from __future__ import annotations

import math

from carom.core.contact import one_contact
from carom.core.jit.kernel import Vec, kernel
from carom.core.motion.restitution import VISCOELASTIC, restitution
from carom.core.motion.rolling import UP

__all__ = ["bounces", "series_lasts"]

# Hops below this share of the first are closed by the geometric series: their sums are below rounding.
LAST_HOP = 1e-18
# Where e is so near 1 that the hops do not shrink to that: the geometric series of what is left.
MOST_HOPS = 10_000_000


@kernel
def series_lasts(vz: float, g: float, form: int, p: Vec) -> float:
    """Return an upper bound of the time for which a ball that leaves the floor with v_z bounces; infinite if it has no end."""
    # every form is monotone: the largest e on the way is at one of the ends
    e = restitution(form, p, vz)
    most = max(e, restitution(form, p, 0 * vz))
    if most < 1:
        return 2 * vz / (g * (1 - most))
    # e tends to 1 as the ball comes to rest, and yet the hops end where 1 - e falls no faster than v^1/5: the sum of the
    # speeds is at most the integral of dv / (1 - e), and one hop more
    return 2 * (vz + 5 * vz / (4 * (1 - e))) / g if form == VISCOELASTIC and e < 1 else math.inf


@kernel
def bounces(
    x: Vec, v: Vec, w: Vec, a: float, kappa: float, g: float, form: int, p: Vec, mu: float, beta: float, until: float
) -> tuple[Vec, Vec, Vec, float]:
    """Follow a ball that leaves the floor (its lowest point there, v_z > 0) for a time ``until``, or to its last bounce.

    Returns position, velocity, spin and the time that passed: ``until``, or the time at which it stays on the floor.
    """
    t = 0 * g
    first = v[2]
    for _ in range(MOST_HOPS):
        hop = 2 * v[2] / g
        if t + hop > until:
            s = until - t
            return (
                (x[0] + v[0] * s, x[1] + v[1] * s, x[2] + v[2] * s - g * s * s / 2),
                (v[0], v[1], v[2] - g * s),
                w,
                until,
            )
        if v[2] <= LAST_HOP * first:
            break
        t += hop
        x = (x[0] + v[0] * hop, x[1] + v[1] * hop, x[2])
        e = restitution(form, p, v[2])
        v, w, _j, _required, _regime = one_contact((v[0], v[1], -v[2]), w, UP, a, kappa, e, mu, beta)
    if v[2] > 0:
        e = restitution(form, p, v[2])
        rest = 2 * v[2] / (g * (1 - e))
        t += rest
        x = (x[0] + v[0] * rest, x[1] + v[1] * rest, x[2])
    return x, (v[0], v[1], 0 * g), w, t
