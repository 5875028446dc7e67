"""The gap between a ball and the object that it meets, as a kernel: its derivative gives the derivative of the event's time.

A wall may yield: contact, an impact at one instant, is where the ball is deeper than the wall's place by the yield time c times
the speed of approach. A linear spring with a dashpot, which a ball touches for the time T and leaves with the share e of its speed,
takes and returns it as if it had turned at once at the depth c v_n, c = e T / (1 + e): there the lines before and after meet.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.circles import rim_gap
from carom.core.geometry.curve_features import curve_depth
from carom.core.geometry.features import BEHIND, CURVE, LINE, OVER, POINT, RIM, contact_normal
from carom.core.jit.kernel import Vec, dot, kernel, vector

__all__ = [
    "contact_gap", "contact_gap_rate", "feature_gap", "feature_gap_rate", "impact_normal", "least_gap", "pair_gap",
]  # fmt: skip

MOST_ROUNDS = 7  # of Newton's steps, of second order
DEEPEST = 0.5  # of the radius: a ball gets no deeper into a wall that yields


@kernel
def feature_gap(f: Any, a: float, x: Vec) -> float:
    """Return the gap between feature f, continued over its ends, and a ball of radius a at x; of a gate, of its centre."""
    p, d = vector(f.p), vector(f.d)
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    if f.kind == RIM:
        return rim_gap(p, d, f.R, x) - a
    if f.kind == CURVE:
        return curve_depth(f, x) - a
    if f.kind < LINE and not (f.kind == OVER and f.R > 0):
        return dot(r, d) - (0.0 if f.kind == OVER else a)
    if f.kind != POINT:
        c = dot(r, d)
        r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
    return f.side * (math.sqrt(dot(r, r)) - f.R) - (0.0 if f.kind == OVER else a)  # type: ignore[no-any-return]


@kernel
def feature_gap_rate(f: Any, x: Vec, v: Vec) -> float:
    """Return the rate at which that gap changes."""
    if f.kind == OVER and f.R > 0:
        p, d = vector(f.p), vector(f.d)
        r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
        c = dot(r, d)
        r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
        return f.side * dot(r, v) / math.sqrt(dot(r, r))  # type: ignore[no-any-return]
    return dot(contact_normal(f, x, v), v)


@kernel
def contact_gap(f: Any, a: float, gap: float, rate: float) -> float:
    """Return how far a ball is from the contact with a feature that yields, by its gap and the rate at which that changes."""
    return float(gap + min(f.yield_time * max(-rate, 0 * rate), DEEPEST * a))


@kernel
def contact_gap_rate(f: Any, a: float, rate: float, bend: float) -> float:
    """Return the rate at which that changes, by the first and second derivative of the gap."""
    c = f.yield_time if rate < 0 and -f.yield_time * rate < DEEPEST * a else 0 * a
    return float(rate - c * bend)


@kernel
def least_gap(f: Any, a: float) -> float:
    """Return the least gap at which a ball is in front of a feature: a ball in a wall that yields is."""
    return -(BEHIND + DEEPEST) * a if f.yield_time > 0 else -BEHIND * a


@kernel
def impact_normal(f: Any, a: float, x: Vec, v: Vec) -> Vec:
    """Return the unit normal at which a ball of radius a at x strikes feature f.

    A wall that yields moves along the floor with the ball, so that they touch as they did at first: over a nose the normal is that
    of a ball moved back, level, to where it touches.
    """
    n = contact_normal(f, x, v)
    if f.yield_time > 0:
        for _ in range(MOST_ROUNDS):
            level = n[0] * n[0] + n[1] * n[1]
            if not level > 0:
                break
            c = -feature_gap(f, a, x) / level
            x = (x[0] + c * n[0], x[1] + c * n[1], x[2])
            n = contact_normal(f, x, v)
    return n


@kernel
def pair_gap(x: Vec, y: Vec, reach: float) -> float:
    """Return the gap between two balls whose radii add up to ``reach``."""
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    return math.sqrt(dot(r, r)) - reach
