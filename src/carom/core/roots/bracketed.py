"""The first root of a function whose second derivative is bounded: what its steps have in common.

The function G is known with its rate at single times, and G'' <= pull on a stretch of time L. Where it is positive at both ends of
the stretch, it is at least the chord less pull t (L - t)/2 in between; where it changes its sign, Newton's steps within the
bracket, or halving, find the root.
"""

from __future__ import annotations

from carom.core.jit.kernel import hot_kernel

__all__ = ["least_of_chord", "newton_or_half"]


@hot_kernel
def least_of_chord(g0: float, g1: float, length: float, pull: float) -> float:
    """Return the least value of the chord from g0 to g1 less pull t (length - t)/2."""
    t = length / 2.0
    if pull > 0.0:
        t = t - (g1 - g0) / (length * pull)
    if 0.0 < t < length:
        return g0 + (g1 - g0) * (t / length) - pull * t * (length - t) / 2.0
    return min(g0, g1)


@hot_kernel
def newton_or_half(s: float, g: float, rate: float, low: float, high: float) -> float:
    """Return the next place after s, where a falling function is g and has a rate: Newton's, or the middle of the bracket."""
    new = s - g / rate if rate < 0.0 else low
    if not low < new < high:
        new = low + (high - low) / 2.0
    return new
