"""Motion whose acceleration decays exponentially: its integrals, and the times at which they reach a value, to rounding.

A resistance that grows with the speed, v' = -(A + B v), makes the acceleration decay as exp(-B s); a torque that grows with the
spin does the same to the angular acceleration. All is + - * / alone, so that Python, compiled code and the page have the same bits.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import kernel, root_of, without_slopes

__all__ = ["decay_integrals", "time_of_integral", "time_of_path"]

LARGEST_SERIES = 0.5  # of k s: beyond, the integrals of a half are doubled
TERMS = 14  # of the series: the next one is below 1e-18
FADED = 700.0  # of k s: nothing is left
MOST_STEPS = 200


@kernel
def decay_integrals(k: float, s: float) -> tuple[float, float, float]:
    """Return exp(-k s), its integral from 0 to s, and the integral of that; 1, s and s^2/2 where k = 0."""
    z = k * s
    if not z <= FADED:
        return 0 * k, 1 / k, (s - 1 / k) / k
    halvings = 0
    while z > LARGEST_SERIES:
        z, s, halvings = z / 2, s / 2, halvings + 1
    # (exp(-z) - 1 + z) / z^2 = 1/2 (1 - z/3 (1 - z/4 (1 - ...)))
    p = 1 - z / (TERMS + 3)
    for i in range(TERMS):
        p = 1 - z * p / (TERMS + 2 - i)
    p = p / 2
    once = 1 - z * p
    rest, once, twice = 1 - z * once, s * once, s * s * p
    for _ in range(halvings):
        # over 2 s, from s on all is exp(-k s) of what it was: the terms are positive, and nothing cancels
        twice = twice + once * s + rest * twice
        once = once + rest * once
        rest, s = rest * rest, 2 * s
    return rest, once, twice


@kernel
def time_of_integral(k: float, y: float) -> float:
    """Return the time at which the integral of exp(-k s) is y >= 0, where a speed that falls so is gone; or infinity."""
    rate, value = without_slopes(k), without_slopes(y)
    if not rate * value < 1:
        return math.inf + 0 * y
    # the integral is concave: Newton's steps from the left stay there
    s = value
    for _ in range(MOST_STEPS):
        rest, once, _twice = decay_integrals(rate, s)
        step = (value - once) / rest
        if not step > 1e-16 * s:
            break
        s = s + step
    rest, once, _twice = decay_integrals(k, s + 0 * y)
    found: float = root_of(s, once - y, rest)
    return found


@kernel
def time_of_path(k: float, c: float, path: float, until: float) -> float:
    """Return the time in [0, until] at which a ball has come as far as it would in the time ``path`` with its first speed.

    Its speed is 1 - c (integral of exp(-k s)) of the first one: c is its first deceleration over that. At most ``until``.
    """
    s = path
    for _ in range(MOST_STEPS):
        _rest, once, twice = decay_integrals(k, s)
        speed = 1 - c * once
        if not speed > 0:
            return until
        step = (path - (s - c * twice)) / speed
        if not step > 1e-16 * s:
            break
        s = s + step
        if not s < until:
            return until
    return min(s, until)
