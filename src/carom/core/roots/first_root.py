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

# ruff: noqa: RUF005  (tuples are joined with +: Numba does not compile a star in a loop)
from __future__ import annotations

import math

from carom.core.jit.kernel import hot_kernel, kernel
from carom.core.roots.polynomial import Numbers, bracketed_root, compensated_value, root_bound, two_prod, value_at_turn

__all__ = ["hit2", "hit4", "hit8", "next_hit4", "next_hit8"]

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
