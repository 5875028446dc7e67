"""Cosine and sine of an angle in degrees, and the angle of a tangent, with the same bits on every machine.

math.cos, math.sin and math.atan come from the platform's libm, and differ in the last digit; a wall at an angle would stand
elsewhere in a browser. Here there are + - * / and an exact remainder only, and multiples of 90 degrees are exact.

The polynomials are fdlibm's __kernel_sin and __kernel_cos, for |x| <= pi/4, and its atan, with errors below 1 in the last digit.
"""

# fdlibm: Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft, a Sun Microsystems, Inc. business.
# Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice is preserved.

from __future__ import annotations

import math

from carom.core.jit.kernel import kernel
from carom.core.roots.first_root import two_prod

# pi/180, in two parts
DEGREE, DEGREE_REST = 0.017453292519943295, 2.9486522708701687e-19
S1, S2, S3 = -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04
S4, S5, S6 = 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10
C1, C2, C3 = 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05
C4, C5, C6 = -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11
# fdlibm's atan: of 1/2 and 1 in two parts each, and the polynomial
ATAN_HALF, ATAN_HALF_REST = 4.63647609000806093515e-01, 2.26987774529616870924e-17
ATAN_ONE, ATAN_ONE_REST = 7.85398163397448278999e-01, 3.06161699786838301793e-17
A0, A1, A2 = 3.33333333333329318027e-01, -1.99999999998764832476e-01, 1.42857142725034663711e-01
A3, A4, A5 = -1.11111104054623557880e-01, 9.09088713343650656196e-02, -7.69187620504482999495e-02
A6, A7, A8 = 6.66107313738753120669e-02, -5.83357013379057348645e-02, 4.97687799461593236017e-02
A9, A10 = -3.65315727442169155270e-02, 1.62858201153657823623e-02


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


@kernel
def angle_of_tangent(x: float) -> float:
    """Return the angle in radians, from 0 to pi/4, whose tangent is x, from 0 to 1.

    >>> angle_of_tangent(1.0) == math.pi / 4, angle_of_tangent(1e-300)
    (True, 1e-300)
    """
    whole, rest = 0.0, 0.0
    if x >= 0.6875:
        whole, rest, x = ATAN_ONE, ATAN_ONE_REST, (x - 1.0) / (x + 1.0)
    elif x >= 0.4375:
        whole, rest, x = ATAN_HALF, ATAN_HALF_REST, (2.0 * x - 1.0) / (2.0 + x)
    z = x * x
    w = z * z
    even = z * (A0 + w * (A2 + w * (A4 + w * (A6 + w * (A8 + w * A10)))))
    odd = w * (A1 + w * (A3 + w * (A5 + w * (A7 + w * A9))))
    return whole - ((x * (even + odd) - rest) - x)
