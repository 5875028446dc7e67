"""Cosine and sine of an angle in degrees, with the same bits on every machine.

math.cos and math.sin come from the platform's libm, and differ in the last digit; a wall at an angle would stand elsewhere in
a browser. Here there are + - * and an exact remainder only, and multiples of 90 degrees are exact.

The polynomials are fdlibm's __kernel_sin and __kernel_cos, for |x| <= pi/4, with an error below 1 in the last digit.
"""

# fdlibm: Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft, a Sun Microsystems, Inc. business.
# Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice is preserved.

from __future__ import annotations

import math

from carom.core.jit.kernel import kernel
from carom.core.roots.polynomial import two_prod

__all__ = ["direction"]

# pi/180, in two parts
DEGREE, DEGREE_REST = 0.017453292519943295, 2.9486522708701687e-19
S1, S2, S3 = -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04
S4, S5, S6 = 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10
C1, C2, C3 = 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05
C4, C5, C6 = -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11


@kernel
def _whole_turns_less(degrees: float) -> float:
    """Return the remainder of degrees by 360, exact and with its sign, as ``math.fmod`` (which Numba does not have)."""
    rest, step = abs(degrees), 360.0
    while 2 * step <= rest:
        step = 2 * step
    while step >= 360:
        if rest >= step:
            rest = rest - step
        step = step / 2
    return rest if degrees >= 0 else -rest


@kernel
def direction(degrees: float) -> tuple[float, float]:
    """Return (cos, sin) of an angle in degrees.

    >>> direction(90.0), direction(-180.0), direction(30.0)[1]
    ((0.0, 1.0), (-1.0, 0.0), 0.5)
    """
    turn = _whole_turns_less(degrees)
    quarters = math.floor(turn / 90 + 0.5)
    rest = turn - 90 * quarters
    x, y = two_prod(rest, DEGREE)
    y += rest * DEGREE_REST
    z = x * x
    w = z * z
    v = z * x
    r = S2 + z * (S3 + z * S4) + z * w * (S5 + z * S6)
    s = x - ((z * (0.5 * y - v * r) - y) - v * S1)
    r = z * (C1 + z * (C2 + z * C3)) + w * w * (C4 + z * (C5 + z * C6))
    half = 0.5 * z
    w = 1.0 - half
    c = w + (((1.0 - w) - half) + (z * r - x * y))
    k = quarters % 4
    if k == 0:
        return (c, s)
    if k == 1:
        return (0.0 - s, c)
    return (0.0 - c, 0.0 - s) if k == 2 else (s, 0.0 - c)
