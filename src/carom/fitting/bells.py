"""Integrals of stretches: a piece of a bell, a little bent, and its moments; the least of its exponent.

In a stretch, t from 0 to 1, what a row misses is straight or a parabola, so its c is a parabola or bent by a little more; and so is
the logarithm of a normal prior. The moments are Gauss sums over the part that is not nothing.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.kernel import kernel

__all__ = ["COLUMNS", "HOPELESS", "MIDDLE", "lowest", "lowest_bent", "moments"]

# Of a stretch: its two places (0, 1); what its exponent surely is not above, and later its root (2); what was done to it (3); the
# least of its exponent (4); its moments (3 by 5, from 5); in its middle what the law says and slopes in v_n and v_t (from 20)
MIDDLE, COLUMNS = 20, 29
HOPELESS = 27.0  # a deviance so far above the least has no share: exp(-13.5)
NEWTON = 3  # steps
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
PIECES = np.array(
    [-math.inf, -80.0, -20.0, -6.0, -2.0, 2.0, 6.0, 20.0, 80.0, math.inf]
)  # of Student's t, in its widths


@kernel
def lowest(c2: float, c1: float, c0: float, low: float, high: float) -> float:
    """The least of c2 t^2 + 2 c1 t + c0 from low to high, c2 not negative."""
    t = -c1 / c2 if c2 > 0 else 0 * c2
    t = min(max(t, low), high)
    if not abs(t) < math.inf:
        return c0
    return (c2 * t + 2 * c1) * t + c0


@kernel
def _curved(b2: float, b1: float, b0: float, t: float) -> float:
    """What c has beside its parabola where what the law says is one: c of r0 + r1 t - 4 t (1 - t) g, b2 = g' S^-1 g, b1 = g' S^-1
    r1, b0 = g' S^-1 r0."""
    w = 4 * t * (1 - t)
    return w * (w * b2 - 2 * (b1 * t + b0))


@kernel
def lowest_bent(q2: float, q1: float, q0: float, b2: float, b1: float, b0: float, low: float, high: float) -> float:
    """The least of q2 t^2 + 2 q1 t + q0 and what is curved, from low to high: Gauss and Newton's, from that of the parabola."""
    if b2 == 0:
        return lowest(q2, q1, q0, low, high)
    t = min(max(-q1 / q2 if q2 > 0 else 0 * q2, low), high)
    least = (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t)
    for _ in range(NEWTON):
        w, slope = 4 * t * (1 - t), 4 - 8 * t
        steep = q2 - 2 * slope * b1 + slope * slope * b2
        if not steep > 0:
            break
        t -= (q2 * t + q1 - slope * (b1 * t + b0 - w * b2) - w * b1) / steep
        t = min(max(t, low), high)
        least = min(least, (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t))
    return least


@kernel
def moments(
    c2: float, c1: float, c0: float, b2: float, b1: float, b0: float, z0: float, z1: float, low: float, high: float, nu: float,
    d: int, row: Any,
) -> None:  # fmt: skip
    """The least of c(t) + (z0 + z1 t)^2 from low to high in row[4], and from there on the integrals of t^n tau^m exp(..) over
    exp of that least, n 0 to 4, m 0 to 2, where tau is the weight that Student's t gives c."""
    q2, q1, q0 = c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0
    base = lowest_bent(q2, q1, q0, b2, b1, b0, low, high)
    row[4] = base
    for n in range(5, 20):
        row[n] = 0
    if nu == 0:
        if q2 > 0:
            top, far = -q1 / q2, math.sqrt(base + HOPELESS) + math.sqrt(b2)
            far = math.sqrt(max(far * far - (q0 - q1 * q1 / q2), 0.0) / q2)
            low, high = max(low, top - far), min(high, top + far)
        # far off the fit the least that was sought may not be the least
        for n in range(NODES.shape[0] if b2 != 0 else 0):
            t = (low + high + (high - low) * NODES[n]) / 2
            base = min(base, (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t))
        row[4] = base
        for n in range(NODES.shape[0]):
            t = (low + high + (high - low) * NODES[n]) / 2
            c = (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t)
            w = WEIGHTS[n] * math.exp((base - c) / 2) * (high - low) / 2
            for m in range(5):
                row[5 + m] += w
                w *= t
        for m in range(5):
            row[10 + m] = row[15 + m] = row[5 + m]
        return
    # heavy tails: pieces about the place where c is least, as far as the prior goes
    if z1 != 0:
        top, far = -z0 / z1, math.sqrt(HOPELESS) / abs(z1)
        nearest = min(max(top, low), high)
        far = math.sqrt(far * far + (nearest - top) * (nearest - top))
        low, high = max(low, top - far), min(high, top + far)
    top = min(max(-c1 / c2, low), high) if c2 > 0 else low
    wide = 1 / math.sqrt(max(c2, 1e-12))
    c = max((c2 * top + 2 * c1) * top + c0 + _curved(b2, b1, b0, top), 0.0)
    base = (nu + d) * math.log(1 + c / nu) + (z0 + z1 * top) * (z0 + z1 * top)
    near = min(max(-z0 / z1, low), high) if z1 != 0 else top
    c = max((c2 * near + 2 * c1) * near + c0 + _curved(b2, b1, b0, near), 0.0)
    base = min(base, (nu + d) * math.log(1 + c / nu) + (z0 + z1 * near) * (z0 + z1 * near))
    row[4] = base
    for piece in range(PIECES.shape[0] - 1):
        left, right = max(low, top + wide * PIECES[piece]), min(high, top + wide * PIECES[piece + 1])
        if not left < right:
            continue
        for n in range(NODES.shape[0]):
            t = (left + right + (right - left) * NODES[n]) / 2
            c, z = max((c2 * t + 2 * c1) * t + c0 + _curved(b2, b1, b0, t), 0.0), z0 + z1 * t
            w = WEIGHTS[n] * math.exp((base - (nu + d) * math.log(1 + c / nu) - z * z) / 2) * (right - left) / 2
            tau = (nu + d) / (nu + c)
            for m in range(5):
                row[5 + m] += w
                row[10 + m] += w * tau
                row[15 + m] += w * tau * tau
                w *= t
