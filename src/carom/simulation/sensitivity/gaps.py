"""The gap between a ball and the object that it meets, as a kernel: its derivative gives the derivative of the event's time."""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.circles import rim_gap
from carom.core.geometry.features import LINE, OVER, POINT, RIM, contact_normal
from carom.core.jit.kernel import Vec, dot, kernel, vector

__all__ = ["feature_gap", "feature_gap_rate", "pair_gap"]


@kernel
def feature_gap(f: Any, a: float, x: Vec) -> float:
    """Return the gap between feature f, continued over its ends, and a ball of radius a at x; of a gate, of its centre."""
    p, d = vector(f.p), vector(f.d)
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    if f.kind == RIM:
        return rim_gap(p, d, f.R, x) - a
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
def pair_gap(x: Vec, y: Vec, reach: float) -> float:
    """Return the gap between two balls whose radii add up to ``reach``."""
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    return math.sqrt(dot(r, r)) - reach
