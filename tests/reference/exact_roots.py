"""The first root of a gap polynomial, held against exact integers (Sturm) and mpmath.

An answer is judged for the polynomial with exactly the float coefficients that were handed in: Sturm's chain, in integers,
counts its roots before the answer, and mpmath's Newton says how far the answer is from the root.
"""

import math
from fractions import Fraction
from functools import cache
from itertools import pairwise

import mpmath
import numpy as np

from carom.core.jit.compile import njit
from carom.core.roots import hit2, hit4, hit8, next_hit4

WITHIN = Fraction(1, 10**12)
INF = math.inf


# --- compiled loops -----------------------------------------------------------------------------------------------


def _rows2(c, T, tol, out):
    for i in range(len(out)):
        out[i] = hit2(c[i, 0], c[i, 1], c[i, 2], T[i], tol)


def _rows4(c, T, tol, out):
    for i in range(len(out)):
        out[i] = hit4(c[i, 0], c[i, 1], c[i, 2], c[i, 3], c[i, 4], T[i], tol)


def _rows8(c, T, tol, out):
    for i in range(len(out)):
        k = c[i]
        out[i] = hit8((k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7], k[8]), T[i], tol)


def _rows_next(c, after, T, out):
    for i in range(len(out)):
        out[i] = next_hit4(c[i, 0], c[i, 1], c[i, 2], c[i, 3], c[i, 4], after[i], T[i])


ROWS = {2: _rows2, 4: _rows4, 8: _rows8}
compiled = cache(njit)


def answers(c, T, tol=0.0, degree=None):
    c = np.ascontiguousarray(c)
    out = np.empty(len(c))
    T = np.ascontiguousarray(np.broadcast_to(np.asarray(T, float), len(c)))
    compiled(ROWS[degree or c.shape[1] - 1])(c, T, tol, out)
    return out


def interpreted(c, T, tol=0.0):
    c = tuple(float(k) for k in c)
    return hit8(c, T, tol) if len(c) == 9 else hit4(*c, T, tol) if len(c) == 5 else hit2(*c, T, tol)


# --- exact --------------------------------------------------------------------------------------------------------


def integers(c):
    """The polynomial times a positive number, in integers, without leading zeros."""
    exact = [Fraction(float(k)) for k in c]
    common = math.lcm(*(k.denominator for k in exact))
    p = [int(k * common) for k in exact]
    while p and p[-1] == 0:
        p.pop()
    return p


def derivative(p):
    return [i * k for i, k in enumerate(p)][1:]


def sign_at(p, x):
    """Sign at a fraction, or at infinity."""
    if not p:
        return 0
    if x == INF:
        return (p[-1] > 0) - (p[-1] < 0)
    over, under = x.numerator, x.denominator
    value, power = 0, 1
    for k in reversed(p):
        value = value * over + k * power
        power *= under
    return (value > 0) - (value < 0)


def chain(p):
    links = [p, derivative(p)]
    while len(links[-1]) > 1:
        a, b = list(links[-2]), links[-1]
        while len(a) >= len(b):
            lead, shift = a[-1], len(a) - len(b)
            # times a positive number: |leading coefficient of b|
            a = [abs(b[-1]) * k for k in a]
            for i, k in enumerate(b):
                a[i + shift] -= (lead if b[-1] > 0 else -lead) * k
            while a and a[-1] == 0:
                a.pop()
        if not a:
            break
        content = math.gcd(*a)
        links.append([-k // content for k in a])
    return links


def changes(links, x):
    signs = [s for s in (sign_at(p, x) for p in links) if s]
    return sum(s != t for s, t in pairwise(signs))


def count(p, a, b):
    """Different roots of p in (a, b]."""
    if len(p) < 2:
        return 0
    links = chain(p)
    return changes(links, Fraction(a)) - changes(links, b if b == INF else Fraction(b))


def relative_error(c, s):
    """How far s is from the root next to it: Newton in 80 digits."""
    with mpmath.workdps(80):
        k = [mpmath.mpf(x if isinstance(x, int) else float(x)) for x in c[::-1]]
        x = mpmath.mpf(s)
        for _ in range(60):
            p, d = mpmath.polyval(k, x, derivative=True)
            if p == 0 or d == 0:
                break
            x -= p / d
            if abs(p) < abs(d * x) * mpmath.mpf("1e-40"):
                break
        return float(abs(s - x) / x)


def judge(c, s, T):
    """Relative error of an answer, after every claim that it makes has been checked."""
    g = integers(c)
    turn = derivative(g)
    end = Fraction(T) if T != INF else INF
    odd = 0 if c[0] >= 0 else 1  # crossings upwards, from below
    if c[0] == 0.0:
        g = g[1:]
    if s == INF:
        before = count(g, 0, end)
        # no crossing; or up and not down; and a turn below zero is a hit
        assert before <= odd
        assert c[0] > 0 or before == odd or count(turn, 0, end) == 0
        return 0.0
    assert s <= T
    near, far = Fraction(s) * (1 - WITHIN), Fraction(s) * (1 + WITHIN)
    if c[0] <= 0 and count(g, 0, far) == 0 and sign_at(g, near) < 0:
        assert (sign_at(turn, near), sign_at(turn, far)) == (1, -1)
        assert count(turn, 0, near) == 0
        return relative_error(turn, s)
    assert sign_at(g, near) > 0
    assert count(g, 0, near) == odd
    if sign_at(g, far) >= 0:  # two roots nearer to each other than what is asked for: the first is there
        assert count(g, near, far) >= 1
    return relative_error(c, s)


def worst(c, T, degree=None):
    c = np.asarray(c, float)
    got = answers(c, T, degree=degree)
    T = np.broadcast_to(np.asarray(T, float), len(c))
    errors = [judge(c[i], float(got[i]), float(T[i])) for i in range(len(c))]
    hits = int(np.isfinite(got).sum())
    for i in range(0, len(c), 15):
        k = c[i] if degree is None else c[i, : degree + 1]
        assert interpreted(k, float(T[i])) == got[i]  # the same bits
    return max(errors), hits


# --- polynomials --------------------------------------------------------------------------------------------------


def expand(roots):
    """Coefficients from rows of roots (conjugates complete), positive at zero."""
    c = np.ones((len(roots), 1), complex)
    for i in range(roots.shape[1]):
        longer = np.zeros((len(roots), c.shape[1] + 1), complex)
        longer[:, 1:] = c
        longer[:, :-1] -= roots[:, i : i + 1] * c
        c = longer
    c = c.real
    return c * np.where(c[:, :1] < 0, -1, 1)


def gaps(rng, least, rows):
    return 10.0 ** rng.uniform(least, -2, rows)


def pair(rng, roots, i=0):
    """Make two of the roots a conjugate pair."""
    z = roots[:, i] + 1j * np.abs(rng.normal(size=len(roots)))
    roots[:, i], roots[:, i + 1] = z, z.conj()
    return roots


def make(kind, degree, rng, rows):
    """Coefficients of so many polynomials of a kind, and the ends of their intervals."""
    T = np.full(rows, 3.0)
    roots = rng.uniform(-0.5, 2.5, (rows, degree)).astype(complex)
    if kind == "random coefficients":
        c = rng.normal(size=(rows, degree + 1)) * 10.0 ** rng.integers(-2, 3, (rows, degree + 1))
        c[:, 0] = abs(c[:, 0])
        return c, T
    if kind == "random roots":
        roots[::2] = pair(rng, roots[::2])
    elif kind == "clustered":
        roots[:, : degree - 1] = roots[:, :1] + rng.normal(size=(rows, degree - 1)) * gaps(rng, -4, rows)[:, None]
    elif kind == "near-double":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -14, rows))
    elif kind == "cut in a pair":
        near = gaps(rng, -9, rows)
        roots[:, 0] = abs(roots[:, 0])
        roots[:, 1] = roots[:, 0] * (1 + near)
        T = roots[:, 0].real * (1 + near * rng.uniform(-0.5, 1.5, rows))
    elif kind == "almost a pair":
        z = roots[:, 0] * (1 + 1j * gaps(rng, -14, rows))
        roots[:, 0], roots[:, 1] = z, z.conj()
    elif kind == "near-triple":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -7, rows))
        roots[:, 2] = roots[:, 0] * (1 - gaps(rng, -7, rows))
    elif kind == "two near-doubles":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -10, rows))
        roots[:, 3] = roots[:, 2] * (1 + gaps(rng, -10, rows))
    c = expand(roots)
    if kind == "cut":
        real = np.sort(np.where(roots.real > 0, roots.real, 3.0), axis=1)
        T = real[np.arange(rows), rng.integers(0, degree, rows)] * (
            1 + rng.choice([-1, 1], rows) * gaps(rng, -11, rows)
        )
    elif kind == "infinity":
        roots = pair(rng, roots)
        c, T = expand(roots), np.full(rows, INF)
    elif kind == "scales":
        scale = 10.0 ** rng.uniform(-12, 12, rows)
        c = c * scale[:, None] ** -np.arange(degree + 1) * 10.0 ** rng.uniform(-12, 12, (rows, 1))
        T = np.where(rng.random(rows) < 0.5, 3.0 * scale, INF)
    elif kind == "no leading coefficient":
        zeros = rng.integers(1, degree, rows)
        small = rng.choice([0.0, 1e-20, -1e-20], rows)
        c = np.where(np.arange(degree + 1) > degree - zeros[:, None], c * small[:, None], c)
        T = rng.choice([3.0, INF], rows)
    elif kind == "almost touching":
        roots[:, 1] = roots[:, 0]
        c = expand(roots)
        c[:, 0] += 1e-14 * abs(c).sum(axis=1) * rng.choice([-1, 0, 1], rows)
    elif kind == "from touch":
        c[:, 0] = rng.choice([0.0, 1e-17, -1e-17, -1e-3, -0.1], rows)
        c[:, 1] = abs(c[:, 1]) * 10.0 ** rng.uniform(-8, 0, rows)
    elif kind == "turning below zero":  # two turns close by: the rounding of 3 c3 would count
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -10, rows))
        c[:, 1:] = expand(roots[:, :-1]) / np.arange(1, degree + 1)
        c[:, 0] = -1e3 * abs(c).sum(axis=1) * 3**degree
    return c, T


KINDS = [
    "random coefficients",
    "random roots",
    "clustered",
    "near-double",
    "almost a pair",
    "almost touching",
    "near-triple",
    "two near-doubles",
    "cut",
    "infinity",
    "scales",
    "no leading coefficient",
    "from touch",
    "cut in a pair",
    "turning below zero",
]
PARABOLAS = ["random", "near-double", "almost touching", "scales", "from touch", "linear"]


def make_parabolas(kind, rng, rows):
    """The same of degree 2."""
    roots = rng.uniform(0, 2.5, (rows, 2)).astype(complex)
    if kind == "near-double":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -14, rows))
    elif kind == "almost touching":
        roots[:, 1] = roots[:, 0]
    c, T = expand(roots), rng.choice([2.0, INF], rows)
    if kind == "random":
        c = rng.normal(size=(rows, 3)) * np.where(rng.random(rows) < 0.2, -1, 1)[:, None]
        c[:, 0] = abs(c[:, 0])
    elif kind == "almost touching":
        c[:, 0] += 1e-14 * rng.choice([-1, 0, 1], rows)
    elif kind == "scales":
        c *= (10.0 ** rng.uniform(-12, 12, (rows, 1))) ** np.arange(3) * 10.0 ** rng.uniform(-12, 12, (rows, 1))
    elif kind == "from touch":
        c[:, 0] = rng.choice([0.0, -1e-17, -1e-3], rows)
        c[:, 1], c[:, 2] = abs(c[:, 1]), -abs(c[:, 2])
    elif kind == "linear":
        c[:, 2] = rng.choice([0.0, 1e-20, -1e-20], rows)
    return c, T
