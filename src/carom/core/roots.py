"""Find the first hit of a gap polynomial, to the last digits.

``g(s) = c0 + c1 s + ...`` is the gap between a ball and what it may hit, s the time since the ball's last event. A hit is
the smallest s in [0, T] at which g <= 0 while g decreases:

- g comes from above zero and crosses it (touching it without crossing is no hit);
- g(0) <= 0 and g'(0) < -tol: s = 0;
- g(0) <= 0 and not approaching: nothing, until g has been above zero and comes down; or until g, never having been above
  zero, turns down again (the stable rule of Bannerman, Strobl, Formella and Poeschel, arXiv:1211.6718).

The way: Bernstein coefficients settle most cases (no root, or one). The others are walked from turn to turn of g, which
are the roots of g' on the monotone pieces between the roots of g'', and so on. A sign that plain arithmetic leaves open is
decided in compensated arithmetic, so that a pair of roots that is there is found, and one that is not is not.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from carom.core.jit.kernel import hot_kernel, kernel

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


# ----------------------------------------------------------------------------------------------------
# Find the first hit of a gap polynomial, to the last digits.


# ruff: noqa: RUF005  (tuples are joined with +: Numba does not compile a star in a loop)


NEVER = math.inf
MARGIN = 4e-15  # what rounding does to a Bernstein coefficient, against the sum of |c_i| T^i
ZERO5 = (0.0, 0.0, 0.0, 0.0, 0.0)
ZERO9 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
BINOMIALS = tuple(tuple(float(math.comb(j + k, k)) for j in range(9)) for k in range(9))


# --- the walk -----------------------------------------------------------------------------------------------------


@kernel
def _breaks(c: Numbers, t: Numbers, old: Numbers, start: float) -> Numbers:
    """The root in each piece between old breaks, or the piece's end where it has none: breaks for the integral of c + t."""
    left = start
    before = compensated_value(c, t, left)
    new = old
    for i in range(len(old)):
        right = old[i]
        found = right
        if right > left:
            after = compensated_value(c, t, right)
            if (before > 0.0) != (after > 0.0):
                found = bracketed_root(c, t, left, before, right, after)
            left = right
            before = after
        # one goes, one comes: after the loop all are new
        new = new[1:] + (found,)
    return new


@kernel
def _first_hit_in_pieces(  # noqa: PLR0911  (one return per outcome)
    c: Numbers, zero: Numbers, d: Numbers, t: Numbers, breaks: Numbers, start: float, state: int
) -> float:
    """The hit after start; d + t are the coefficients of g', which is monotone between breaks (the last is where to stop).

    state: 1 above zero, 0 in touch and not approaching, -1 after a hit (turning down below zero does not count).
    """
    left = start
    slope = compensated_value(d, t, left)
    way = slope
    x = start
    fx = c[0]
    for i in range(len(breaks)):
        right = breaks[i]
        if right > left:
            after = compensated_value(d, t, right)
            if (way > 0.0 and after < 0.0) or (way < 0.0 and after > 0.0):
                m = bracketed_root(d, t, left, slope, right, after)
                p, turn = value_at_turn(c, zero, m)
                if way > 0.0:
                    if state != 1:
                        if turn > 0.0:
                            if p <= 0.0:
                                return m  # up and down again between two floats
                            state = 1
                        elif state == 0:
                            return m
                elif state == 1 and turn < 0.0:
                    return m if p >= 0.0 else bracketed_root(c, zero, x, fx, m, p)
                x = m
                fx = p
                way = after
            elif state == 0 and way <= 0.0 and after < 0.0 and after < slope:
                return left  # what tol let pass does not slow down
            elif way == 0.0:
                way = after
            left = right
            slope = after
    if state == 1 and way < 0.0:
        p = compensated_value(c, zero, left)
        if p < 0.0:
            return bracketed_root(c, zero, x, fx, left, p)
        if p == 0.0 and slope < 0.0:
            return left
    return NEVER


@kernel
def _hit_by_derivatives(c: Numbers, zero: Numbers, start: float, stop: float, state: int) -> float:
    """From the linear derivative down to g': each one's roots part the next one into monotone pieces; then the walk."""
    n = len(c) - 1
    breaks = zero[2:]
    for _ in range(n - 1):
        breaks = breaks[1:] + (stop,)
    shifted = (c[n],) + zero[1:]
    d = zero
    t = zero
    for i in range(1, n):
        k = n - i
        shifted = (c[k],) + shifted[:-1]
        # the k-th derivative over k!, with what its coefficients lose in rounding
        for j in range(n + 1):
            p, e = two_prod(BINOMIALS[k][j], shifted[j])
            d = d[1:] + (p,)
            t = t[1:] + (e,)
        if k > 1:
            breaks = _breaks(d, t, breaks, start)
    return _first_hit_in_pieces(c, zero, d, t, breaks, start, state)


@kernel
def _bernstein(c: Numbers, zero: Numbers, T: float) -> tuple[int, float]:
    """0: g has no root in [0, T]; 1: one, where it comes down through zero; 2: not known. And g(T), roughly."""
    n = len(c) - 1
    row = zero
    power = 1.0
    size = 0.0
    for i in range(n + 1):
        u = c[i] * power
        size = size + abs(u)
        row = row[1:] + (u / BINOMIALS[i][n - i],)
        power = power * T
    margin = MARGIN * size
    plus = True
    minus = True
    b = 0.0
    for _ in range(n + 1):
        b = row[0]
        # once a coefficient is not surely positive, all others have to be surely negative
        if not plus and not b < -margin:
            minus = False
        if not b > margin:
            plus = False
        # Pascal's triangle
        rest = zero[1:]
        for j in range(n):
            rest = rest[1:] + (row[j] + row[j + 1],)
        row = rest + (0.0,)
    if plus:
        return (0, b)
    return (1 if minus and b < -margin else 2, b)


@kernel
def _search(c: Numbers, zero: Numbers, T: float, most: float) -> float:
    """The first hit, where s = 0 is none."""
    stop = T
    if c[0] > 0.0 and most > T:
        kind, last = _bernstein(c, zero, T)
        if kind < 2:
            return NEVER if kind == 0 else bracketed_root(c, zero, 0.0, c[0], T, last)
    far = root_bound(c, most)
    if far < T:
        stop = far
        if c[0] > 0.0:
            kind, last = _bernstein(c, zero, far)
            if kind < 2:
                return NEVER if kind == 0 else bracketed_root(c, zero, 0.0, c[0], far, last)
    return _hit_by_derivatives(c, zero, 0.0, stop, 1 if c[0] > 0.0 else 0)


# --- hits ---------------------------------------------------------------------------------------------------------


@hot_kernel
def hit2(c0: float, c1: float, c2: float, T: float, tol: float) -> float:
    """First hit of c0 + c1 s + c2 s^2 in [0, T], or infinity."""
    square = c1 * c1
    product = 4.0 * c0 * c2
    inside = square - product
    # where the two cancel, what rounding took from them counts (Kahan)
    if 4.0 * abs(inside) < square + abs(product):
        inside = inside + (two_prod(c1, c1)[1] - two_prod(4.0 * c0, c2)[1])
    if c0 > 0.0:
        if c1 <= 0.0:
            if inside <= 0.0:
                return NEVER
            s = 2.0 * c0 / (math.sqrt(inside) - c1)
            return s if s <= T else NEVER
    elif c1 < -tol or (c1 <= 0.0 and c2 < 0.0):
        return 0.0
    elif c1 <= 0.0:
        return NEVER
    if c2 >= 0.0:
        return NEVER
    # up first; where zero is not reached, the turn
    s = (c1 + math.sqrt(inside)) / (-2.0 * c2) if inside > 0.0 else c1 / (-2.0 * c2)
    return s if s <= T else NEVER


@hot_kernel
def hit4(c0: float, c1: float, c2: float, c3: float, c4: float, T: float, tol: float) -> float:
    """First hit of c0 + c1 s + ... + c4 s^4 in [0, T], or infinity. Hits after s = 1e60 are none."""
    if c0 > 0.0:
        if c1 >= 0.0 and c2 >= 0.0 and c3 >= 0.0 and c4 >= 0.0:
            return NEVER
        # T = inf gives inf or nan, which settle nothing
        u1 = c1 * T
        u2 = c2 * T * T
        u3 = c3 * T * T * T
        u4 = c4 * T * T * T * T
        low = (u1 if u1 < 0.0 else 0.0) + (u2 if u2 < 0.0 else 0.0)
        low = low + (u3 if u3 < 0.0 else 0.0) + (u4 if u4 < 0.0 else 0.0)
        if c0 + low > 1e-15 * (c0 - low):
            return NEVER
    elif c1 < -tol:
        return 0.0
    if c3 == 0.0 and c4 == 0.0:
        return hit2(c0, c1, c2, T, tol)
    return _hit4(c0, c1, c2, c3, c4, T)


@kernel
def _hit4(c0: float, c1: float, c2: float, c3: float, c4: float, T: float) -> float:
    """hit4 without its quick answers."""
    if c0 <= 0.0 and c1 <= 0.0 and (c2 < 0.0 or (c2 == 0.0 and (c3 < 0.0 or (c3 == 0.0 and c4 < 0.0)))):
        return 0.0
    return _search((c0, c1, c2, c3, c4), ZERO5, T, 1e60)


@kernel
def next_hit4(c0: float, c1: float, c2: float, c3: float, c4: float, after: float, T: float) -> float:
    """The next down-crossing in (after, T], g having been above zero since the down-crossing at after; or infinity."""
    # past what after may be wrong by: no second down-crossing lies so near, and up-crossings are not missed
    start = after * (1.0 + 4e-12)
    c = (c0, c1, c2, c3, c4)
    far = root_bound(c, 1e60)
    stop = far if far < T else T
    return _hit_by_derivatives(c, ZERO5, start, stop, -1) if start < stop else NEVER


@kernel
def hit8(c: Numbers, T: float, tol: float) -> float:
    """First hit of c[0] + c[1] s + ... + c[8] s^8 in [0, T], or infinity. Hits after s = 1e30 are none."""
    if c[0] <= 0.0:
        if c[1] < -tol:
            return 0.0
        if c[1] <= 0.0:
            for i in range(2, 9):
                if c[i] < 0.0:
                    return 0.0
                if c[i] > 0.0:
                    break
    return _search(c, ZERO9, T, 1e30)


@kernel
def next_hit8(c: Numbers, after: float, T: float) -> float:
    """As next_hit4, of degree 8."""
    start = after * (1.0 + 4e-12)
    far = root_bound(c, 1e30)
    stop = far if far < T else T
    return _hit_by_derivatives(c, ZERO9, start, stop, -1) if start < stop else NEVER


# ----------------------------------------------------------------------------------------------------
# The first root of a function that is known with its rate at single times, and whose second derivative is bounded.
#
# G'' <= pull on a stretch of time L. Where G is positive at both ends of the stretch, it is at least the chord less
# pull t (L - t)/2 in between; where it changes its sign and falls throughout, it has one root, which Newton's steps within the
# bracket, or halving, find; every other stretch is halved. So no root is missed.


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
