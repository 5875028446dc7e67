"""Evaluate polynomials to their last digits: error-free sums and products, values, derivatives, one root.

Coefficients are tuples, lowest first; rounding errors of the coefficients may be given beside them. The building blocks of
:mod:`carom.core.roots.first_root`.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import hot_kernel, kernel

__all__ = [
    "Numbers", "accurate_value", "bracketed_root", "compensated_value", "root_bound", "taylor_value", "two_prod", "two_sum",
    "value_at_turn",
]  # fmt: skip

Numbers = tuple[float, ...]

ROUNDING = 2.5e-16  # times the number of coefficients: above 2 n u, which bounds plain Horner of degree n (u = 2^-53)
ENOUGH = 1e-13  # a root whose plain residual moves it by less than this, relatively, is not evaluated again


@hot_kernel
def two_sum(a: float, b: float) -> tuple[float, float]:
    """The sum and its rounding error: a + b exactly (Knuth)."""
    s = a + b
    v = s - a
    return (s, (a - (s - v)) + (b - v))


@hot_kernel
def two_prod(a: float, b: float) -> tuple[float, float]:
    """The product and its rounding error: a b exactly (Dekker, with Veltkamp's splitting; no fma, the same everywhere)."""
    p = a * b
    w = 134217729.0 * a
    a1 = w - (w - a)
    a2 = a - a1
    w = 134217729.0 * b
    b1 = w - (w - b)
    b2 = b - b1
    return (p, a2 * b2 - (((p - a1 * b1) - a2 * b1) - a1 * b2))


@kernel
def accurate_value(c: Numbers, t: Numbers, x: float) -> tuple[float, float]:
    """Value and slope at x of the polynomial with coefficients c + t, lowest first, as if computed in twice the precision.

    Compensated Horner: the rounding errors of Horner's steps, exact by two_sum and two_prod, are the coefficients of a
    polynomial that corrects the result. |error| <= u |g(x)| + (2 n u)^2 sum |c_i| |x|^i, up to higher order (Graillat,
    Langlois & Louvet 2009, theorem 4); the slope likewise, with g' and a factor that grows as n (Jiang et al. 2013). t are
    what rounding took from the coefficients: zeros where they are exact.
    """
    n = len(c)
    p = c[n - 1]
    ep = t[n - 1]
    d = 0.0
    ed = 0.0
    for i in range(1, n):
        w, w1 = two_prod(d, x)
        d, w2 = two_sum(w, p)
        ed = ed * x + (ep + (w1 + w2))
        w, w1 = two_prod(p, x)
        p, w2 = two_sum(w, c[n - 1 - i])
        ep = ep * x + ((w1 + w2) + t[n - 1 - i])
    return (p + ep, d + ed)


@hot_kernel
def taylor_value(c: Numbers, x: float) -> tuple[float, float, float, float]:
    """Plain Horner at x >= 0: g, g', g''/2, and what their rounding is measured by, the sum of |c_i| x^i."""
    n = len(c)
    p = c[n - 1]
    d = 0.0
    q = 0.0
    e = abs(p)
    for i in range(1, n):
        q = q * x + d
        d = d * x + p
        p = p * x + c[n - 1 - i]
        e = e * x + abs(c[n - 1 - i])
    return (p, d, q, e)


@kernel
def compensated_value(c: Numbers, t: Numbers, x: float) -> float:
    """The value at x >= 0, compensated where plain Horner leaves its sign open."""
    p, _, _, e = taylor_value(c, x)
    if abs(p) > ROUNDING * len(c) * e:
        return p
    return accurate_value(c, t, x)[0]


@kernel
def value_at_turn(c: Numbers, t: Numbers, x: float) -> tuple[float, float]:
    """The value at x, next to a turn, and the value at the turn itself, which may lie between two floats.

    Where that is less than the bound of the compensated value it is zero: g touches.
    """
    p, d, q, e = taylor_value(c, x)
    doubt = ROUNDING * len(c)
    if abs(p) > doubt * e:
        return (p, p)
    p, d = accurate_value(c, t, x)
    turn = p
    # the parabola through x, where x is near enough to the turn for it
    if q != 0.0 and abs(d) <= 1e-11 * x * abs(q):
        turn = p - d * d / (4.0 * q)
    return (p, turn if abs(turn) > doubt * doubt * e else 0.0)


@kernel
def bracketed_root(  # noqa: PLR0911  (one return a way to be done)
    c: Numbers, t: Numbers, a: float, fa: float, b: float, fb: float
) -> float:
    """The root between a and b, 0 <= a <= b, where the values fa and fb have different signs; one root is there.

    Steps to the root of the Taylor parabola (Euler): of third order, and right away good next to a turn, where Newton
    starts badly. Schröder's step where the parabola has no root (three roots close by); halving where neither helps.
    """
    if fa == 0.0:
        return a
    if fb == 0.0:
        return b
    up = fb > 0.0
    x = a if abs(fa) <= abs(fb) else b
    last = b - a
    before = last
    for _ in range(120):
        p, d, q, e = taylor_value(c, x)
        doubt = ROUNDING * len(c) * e
        if abs(p) <= doubt:
            if doubt <= ENOUGH * abs(d) * x:
                y = x - p / d
                return a if y < a else (b if y > b else y)
            p, d = accurate_value(c, t, x)
            if p == 0.0:
                return x
        if (p > 0.0) == up:
            b = x
        else:
            a = x
        below = d * d - 2.0 * p * q
        inside = below - 2.0 * p * q
        over = 0.0
        under = 0.0
        if inside >= 0.0:
            # of the parabola's two roots the one where it goes the way that g goes
            over = -2.0 * p
            under = d + math.sqrt(inside) if up else d - math.sqrt(inside)
        elif below > 0.0:
            over = -p * d
            under = below
        y = x + over / under if under != 0.0 else a
        step = abs(y - x)
        # outside, or no faster than halving
        if not (a < y < b) or 2.0 * step > before:
            # a step that is below the last digit: x is an end of the bracket, and the root
            if under != 0.0 and abs(over) <= 1e-16 * x * abs(under):
                return x
            y = 0.5 * (a + b)
            if y in (a, b):
                return x
            step = abs(y - x)
        elif step <= 1e-15 * x:
            return y
        before = last
        last = step
        x = y
    return x


@kernel
def root_bound(c: Numbers, most: float) -> float:
    """A power of 4 beyond every positive root of g, and of its derivatives (Cauchy's bound, with the signs); at most most."""
    n = len(c)
    x = 1.0
    growing = False
    shrinking = False
    for _ in range(130):
        lead = 0.0
        h = 0.0
        for i in range(n):
            k = c[n - 1 - i]
            if lead == 0.0:
                lead = k
                h = 0.99 * abs(k)
            elif (k < 0.0) != (lead < 0.0):
                h = h * x - abs(k)
            else:
                h = h * x
        if h > 0.0:
            if growing:
                return x
            shrinking = True
            x = 0.25 * x
        else:
            x = 4.0 * x
            if shrinking or x > most:
                return x if x < most else most
            growing = True
    return x
