"""The wall's spring: what is left until it has turned the ball and let it go, and the gap that its clock gives.

Stronge's restitution needs the energy that the wall stores, not a time. Only the gap under a lifted ball does: the wall is a
linear spring that unloads e^2 times as stiffly (Walton & Braun), whose stiffness drops out.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import kernel

__all__ = ["gap_growth", "remaining", "touch_down"]


@kernel
def remaining(un: float, rate: float, stored: float, peak: float, compressing: bool) -> float:
    """Impulse until the compression, or the restitution, ends at the present rate of u_n; infinite if it does not.

    A restitution also ends where the ball comes in again and has given back to the wall all that it had returned
    (``peak``): what follows is compression that the wall has not seen yet.
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
    """How the gap under a lifted ball grows (v_z changes at the rate c) while the wall gives the impulse p."""
    # The wall's spring in its own time: q' = -u_n/k, u_n' = q/k with q^2/2 the stored energy, k = 1 or, unloading, e;
    # (u_n, q) turns on a circle. Differences of nearly equal numbers are written out: c may be a large friction.
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
def touch_down(
    un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool, gap: float
) -> float:
    """Impulse in (0, p] at which the gap closes: bisection between its largest value and p, where it is below zero."""
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
    return high
