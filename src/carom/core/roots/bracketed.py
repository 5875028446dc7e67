"""The first root of a function that is known with its rate at single times, and whose second derivative is bounded.

G'' <= pull on a stretch of time L. Where G is positive at both ends of the stretch, it is at least the chord less
pull t (L - t)/2 in between; where it changes its sign and falls throughout, it has one root, which Newton's steps within the
bracket, or halving, find; every other stretch is halved. So no root is missed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from carom.core.jit.kernel import hot_kernel, kernel

NEVER = math.inf
MOST_STEPS = 200


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


def searches(gap: Callable[[Any, float], tuple[float, float]]) -> tuple[Callable[..., float], Callable[..., Any]]:
    """Return two kernels that ask ``gap(path, s)`` for G and G' at times s.

    ``first_fall(path, s0, g0, u0, right, end, pull, bend, tiny)``: when G, which is g0 > 0 at s0 with the rate u0, falls to zero
    before the end, or infinity; first up to ``right``. ``bend`` bounds the size of G'': infinity where only ``pull`` is known. A
    stretch below ``tiny`` is not halved.

    ``leave(path, begin, end, step, near, sign)``: of what touches, when ``sign`` G is more than ``near``, which is rounding, with G
    and G' then, and True; or False: at the time at which it falls before, at infinity where it does neither. The rate is known
    better than the gap.
    """

    @kernel
    def fall_in(path: Any, low: float, high: float, g: float, u: float, bend: float) -> float:
        s = high
        for _ in range(MOST_STEPS):
            if u < 0.0 and bend < NEVER:
                new = s - g / u
                # Newton's step is wrong by bend step^2/(2 |u|) at most
                if low <= new <= high and bend * ((new - s) * (new - s)) <= 4e-16 * high * -u:
                    return new
            new = newton_or_half(s, g, u, low, high)
            if abs(new - s) <= 4e-16 * high or not low < new < high:
                return new
            s = new
            g, u = gap(path, s)
            if g > 0.0:
                low = s
            else:
                high = s
        return s

    @kernel
    def first_fall(
        path: Any, s0: float, g0: float, u0: float, right: float, end: float, pull: float, bend: float, tiny: float
    ) -> float:
        while s0 < end:
            g1, u1 = gap(path, right)
            length = right - s0
            short = length <= max(tiny, 4e-16 * right)
            if g1 > 0.0:
                if short or least_of_chord(g0, g1, length, pull) >= 0.0:
                    s0, g0, u0 = right, g1, u1
                    right = min(right + 2.0 * max(length, tiny, 4e-16 * right), end)
                    continue
            elif u0 + pull * length < 0.0 or pull == 0.0:
                return fall_in(path, s0, right, g1, u1, bend)
            elif short:
                return right
            right = s0 + length / 2.0
        return NEVER

    @kernel
    def leave(
        path: Any, begin: float, end: float, step: float, near: float, sign: float
    ) -> tuple[float, float, float, bool]:
        s = begin
        while s < end:
            s = min(begin + step, end)
            g, u = gap(path, s)
            if sign * g > near:
                return s, g, u, True
            if sign * u < 0.0:
                return s, g, u, False
            step = step + step
        return NEVER, 0.0, 0.0, False

    return first_fall, leave
