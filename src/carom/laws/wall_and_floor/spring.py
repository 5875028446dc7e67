"""The wall's spring: impulse remaining until compression or restitution ends, and the gap under a lifted ball.

Stronge's restitution depends on the energy stored in the wall, not on time. Only the gap under a lifted ball depends on time:
the wall is a linear spring that unloads with 1/e^2 times its stiffness (Walton & Braun), and the stiffness cancels.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import kernel, root_of

__all__ = ["gap_growth", "remaining_impulse", "touch_down_impulse"]


@kernel
def remaining_impulse(un: float, rate: float, stored: float, peak: float, compressing: bool) -> float:
    """Return the impulse until compression or restitution ends at the present rate of u_n; infinite if it does not.

    Restitution also ends if the ball approaches again and has given back to the wall all the energy that it had returned
    (``peak``): the compression then exceeds its previous maximum.
    """
    if compressing:
        return -un / rate if rate > 0 else math.inf
    if un < 0 and stored < peak:
        left = un * un - 2 * rate * (peak - stored)
        if left > 0:
            return 2 * (peak - stored) / (math.sqrt(left) - un)
    left = un * un + 2 * rate * stored
    if left < 0:
        return math.inf
    left = un + math.sqrt(left)
    return 2 * stored / left if left > 0 else math.inf


@kernel
def gap_growth(un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool) -> float:
    """Return the growth of the gap under a lifted ball (v_z changes at the rate c) during the wall's impulse p."""
    # The wall's spring in its own time: q' = -u_n/k, u_n' = q/k with q^2/2 the stored energy, k = 1 or, unloading, e;
    # (u_n, q) moves on a circle. Differences of nearly equal numbers are expanded: c may be a large friction.
    k = 1 + 0 * e if compressing else e
    q0 = math.sqrt(2 * stored)
    left = stored - un * p - p * p / 2
    q1 = math.sqrt(2 * left) if left > 0 else 0 * e
    if not q0 + q1 > 0:
        return 0 * e
    fall = p * (2 * un + p) / (q0 + q1)  # q0 - q1
    turn = math.atan2(p * q0 + un * fall, q0 * q1 + un * (un + p))
    return k * (vz * turn + c * (fall - un * turn))


@kernel
def touch_down_impulse(
    un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool, gap: float
) -> float:
    """Return the impulse in (0, p] at which the gap closes, by bisection between its maximum and p, where it is negative."""
    low = -vz / c if vz > 0 else 0 * p
    high = p
    for _ in range(200):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        if gap + gap_growth(un, vz, c, stored, middle, e, compressing) > 0:
            low = middle
        else:
            high = middle
    left = stored - un * high - high * high / 2
    rate = (1 + 0 * e if compressing else e) * (vz + c * high) / math.sqrt(2 * left) if left > 0 else -1 + 0 * e
    return root_of(high, gap + gap_growth(un, vz, c, stored, high, e, compressing), rate)
