"""The first hit of a gap polynomial, held against exact integers (Sturm) and mpmath.

An answer is judged for the polynomial with exactly the float coefficients that were handed in: Sturm's chain, in integers,
counts its roots before the answer, and mpmath's Newton says how far the answer is from the root.
"""

import math
import sys
from fractions import Fraction
from functools import cache
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from carom.compiled import njit
from carom.motion.polynomial import accurate, turning, two_prod, two_sum
from carom.motion.roots import hit2, hit4, hit8, next_hit4

COUNT = 3000
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


def gaps(rng, least):
    return 10.0 ** rng.uniform(least, -2, COUNT)


def pair(rng, roots, i=0):
    """Make two of the roots a conjugate pair."""
    z = roots[:, i] + 1j * np.abs(rng.normal(size=len(roots)))
    roots[:, i], roots[:, i + 1] = z, z.conj()
    return roots


def make(kind, degree, rng):
    T = np.full(COUNT, 3.0)
    roots = rng.uniform(-0.5, 2.5, (COUNT, degree)).astype(complex)
    if kind == "random coefficients":
        c = rng.normal(size=(COUNT, degree + 1)) * 10.0 ** rng.integers(-2, 3, (COUNT, degree + 1))
        c[:, 0] = abs(c[:, 0])
        return c, T
    if kind == "random roots":
        roots[::2] = pair(rng, roots[::2])
    elif kind == "clustered":
        roots[:, : degree - 1] = roots[:, :1] + rng.normal(size=(COUNT, degree - 1)) * gaps(rng, -4)[:, None]
    elif kind == "near-double":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -14))
    elif kind == "cut in a pair":
        near = gaps(rng, -9)
        roots[:, 0] = abs(roots[:, 0])
        roots[:, 1] = roots[:, 0] * (1 + near)
        T = roots[:, 0].real * (1 + near * rng.uniform(-0.5, 1.5, COUNT))
    elif kind == "almost a pair":
        z = roots[:, 0] * (1 + 1j * gaps(rng, -14))
        roots[:, 0], roots[:, 1] = z, z.conj()
    elif kind == "near-triple":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -7))
        roots[:, 2] = roots[:, 0] * (1 - gaps(rng, -7))
    elif kind == "two near-doubles":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -10))
        roots[:, 3] = roots[:, 2] * (1 + gaps(rng, -10))
    c = expand(roots)
    if kind == "cut":
        real = np.sort(np.where(roots.real > 0, roots.real, 3.0), axis=1)
        T = real[np.arange(COUNT), rng.integers(0, degree, COUNT)] * (1 + rng.choice([-1, 1], COUNT) * gaps(rng, -11))
    elif kind == "infinity":
        roots = pair(rng, roots)
        c, T = expand(roots), np.full(COUNT, INF)
    elif kind == "scales":
        scale = 10.0 ** rng.uniform(-12, 12, COUNT)
        c = c * scale[:, None] ** -np.arange(degree + 1) * 10.0 ** rng.uniform(-12, 12, (COUNT, 1))
        T = np.where(rng.random(COUNT) < 0.5, 3.0 * scale, INF)
    elif kind == "no leading coefficient":
        zeros = rng.integers(1, degree, COUNT)
        small = rng.choice([0.0, 1e-20, -1e-20], COUNT)
        c = np.where(np.arange(degree + 1) > degree - zeros[:, None], c * small[:, None], c)
        T = rng.choice([3.0, INF], COUNT)
    elif kind == "almost touching":
        roots[:, 1] = roots[:, 0]
        c = expand(roots)
        c[:, 0] += 1e-14 * abs(c).sum(axis=1) * rng.choice([-1, 0, 1], COUNT)
    elif kind == "from touch":
        c[:, 0] = rng.choice([0.0, 1e-17, -1e-17, -1e-3, -0.1], COUNT)
        c[:, 1] = abs(c[:, 1]) * 10.0 ** rng.uniform(-8, 0, COUNT)
    elif kind == "turning below zero":  # two turns close by: the rounding of 3 c3 would count
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -10))
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


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("degree", [4, 8])
def test_first_hit(kind, degree):
    c, T = make(kind, degree, np.random.default_rng(KINDS.index(kind)))
    error, hits = worst(c, T)
    sys.stdout.write(f"{kind}, degree {degree}: worst relative error {error:.1e}, {hits} hits of {len(c)}\n")
    assert error <= 1e-12
    assert hits > 100


@pytest.mark.parametrize("kind", ["random", "near-double", "almost touching", "scales", "from touch", "linear"])
def test_first_hit_of_a_parabola(kind):
    rng = np.random.default_rng(7)
    roots = rng.uniform(0, 2.5, (COUNT, 2)).astype(complex)
    if kind == "near-double":
        roots[:, 1] = roots[:, 0] * (1 + gaps(rng, -14))
    elif kind == "almost touching":
        roots[:, 1] = roots[:, 0]
    c, T = expand(roots), rng.choice([2.0, INF], COUNT)
    if kind == "random":
        c = rng.normal(size=(COUNT, 3)) * np.where(rng.random(COUNT) < 0.2, -1, 1)[:, None]
        c[:, 0] = abs(c[:, 0])
    elif kind == "almost touching":
        c[:, 0] += 1e-14 * rng.choice([-1, 0, 1], COUNT)
    elif kind == "scales":
        c *= (10.0 ** rng.uniform(-12, 12, (COUNT, 1))) ** np.arange(3) * 10.0 ** rng.uniform(-12, 12, (COUNT, 1))
    elif kind == "from touch":
        c[:, 0] = rng.choice([0.0, -1e-17, -1e-3], COUNT)
        c[:, 1], c[:, 2] = abs(c[:, 1]), -abs(c[:, 2])
    elif kind == "linear":
        c[:, 2] = rng.choice([0.0, 1e-20, -1e-20], COUNT)
    error, hits = worst(c, T)
    sys.stdout.write(f"{kind}, degree 2: worst relative error {error:.1e}, {hits} hits of {len(c)}\n")
    assert error <= 1e-15
    assert hits > 100


@pytest.mark.parametrize(("degree", "most"), [(2, 75), (4, 71), (8, 60)])
def test_two_roots_and_no_root_a_few_last_digits_apart(degree, most):
    # F(n)^2 - F(n-1) F(n+1) = +-1: two roots, 2 / F(n) apart, and none, in turn
    fibonacci = [1, 1]
    while len(fibonacci) < most + 2:
        fibonacci.append(fibonacci[-1] + fibonacci[-2])
    seen = []
    for n in range(4, most):
        low, middle, high = fibonacci[n - 1 : n + 2]
        k = [high, -2 * middle, low]
        for _ in range((degree - 2) // 2):  # times s^2 + 1: no root more
            k = [a + b for a, b in zip([*k, 0, 0], [0, 0, *k], strict=True)]
        assert all(int(float(x)) == x for x in k)
        s = interpreted(k, INF)
        assert answers(np.array([k], float), INF)[0] == s
        two = middle**2 - low * high == 1
        assert (s < INF) == two
        if two:
            assert abs(Fraction(s) * low / (middle - 1) - 1) < WITHIN
        seen.append(two)
    assert 0.4 < np.mean(seen) < 0.6


def oracle(c, T):
    """The rule with all roots from mpmath, for g(0) and g'(0) away from zero."""
    with mpmath.workdps(60):

        def roots(k):
            found = mpmath.polyroots([mpmath.mpf(float(x)) for x in k[::-1]], maxsteps=1000, extraprec=100)
            real = [mpmath.re(r) for r in found if abs(mpmath.im(r)) < mpmath.mpf("1e-25") * abs(r)]
            return sorted(r for r in real if r > 0)

        def g(x):
            return mpmath.polyval([mpmath.mpf(float(k)) for k in c[::-1]], x)

        if c[0] < 0 and c[1] < 0:
            return 0.0
        at = [mpmath.mpf(0), *roots(c)]
        between = [(a + b) / 2 for a, b in zip(at, [*at[1:], at[-1] + 2], strict=True)]
        downs = [r for r, a, b in zip(at[1:], between, between[1:], strict=False) if g(a) > 0 > g(b)]
        turns = roots([i * float(k) for i, k in enumerate(c)][1:])
        if c[0] < 0 and turns and g(turns[0]) <= 0:
            downs = turns
        return float(downs[0]) if downs and downs[0] <= T else INF


@pytest.mark.parametrize("degree", [2, 4, 8])
def test_against_all_roots_from_mpmath(degree):
    rng = np.random.default_rng(11)
    c = rng.normal(size=(240 if degree < 8 else 80, degree + 1))
    c[:, 1] *= 3
    T = rng.choice([0.7, 2.0, INF], len(c))
    got = answers(c, T)
    expected = [oracle(c[i], T[i]) for i in range(len(c))]
    np.testing.assert_allclose(got, expected, rtol=1e-12)
    assert 20 < np.isfinite(got).sum() < len(c) - 20


def test_next_hit_comes_after_a_rise():
    rng = np.random.default_rng(12)
    c, T = make("random roots", 4, rng)
    c *= -np.sign(c[:, 4:])  # it ends below zero
    first = answers(c, T)
    use = np.isfinite(first) & (first > 0) & (c[:, 0] > 0)
    c, T, first = c[use], T[use], first[use]
    got = np.empty(len(c))
    compiled(_rows_next)(c, first, T, got)
    for i in range(len(c)):
        g, s = integers(c[i]), float(got[i])
        past = Fraction(float(first[i])) * (1 + WITHIN)
        if s < INF:
            near, far = Fraction(s) * (1 - WITHIN), Fraction(s) * (1 + WITHIN)
            assert sign_at(g, near) > 0 > sign_at(g, far)
            assert count(g, past, near) == 1  # the rise
            assert relative_error(c[i], s) < 1e-12
        else:
            assert count(g, past, Fraction(T[i])) <= 1
        assert s == next_hit4(*(float(k) for k in c[i]), float(first[i]), float(T[i]))
    assert 100 < np.isfinite(got).sum() < len(c) - 100


@pytest.mark.parametrize(
    ("c", "T", "tol", "expected"),
    [
        ((4, -4, 1), 9, 0, INF),  # a tangency from above
        ((4, -4, 0.5), 9, 0, 8 / (4 + math.sqrt(8))),
        ((1, -1, 0), 1, 0, 1),  # at T
        ((1, -1, 0), 1 - 2**-53, 0, INF),
        ((0, -1, 0), 9, 0, 0),  # in touch, approaching
        ((-1e-17, -1e-9, 1), 9, 1e-8, INF),  # approaching within tol, and slowing down
        ((-1e-17, -1e-9, 1), 9, 1e-10, 0),
        ((-1e-17, -1e-9, -1), 9, 1e-8, 0),  # and not slowing down
        ((0, 0, -1), 9, 0, 0),  # pressed on
        ((0, 1, -1), 9, 0, 1),  # up and down
        ((-1, 1, -0.25), 9, 0, 2),  # up to zero, not above it: the turn
        ((-2, 1, -0.25), 9, 0, 2),
        ((-2, 1, -0.25), 1, 0, INF),
        ((-1, 1, 1), INF, 0, INF),
        ((4, -12, 13, -6, 1), 9, 0, INF),  # (s - 1)^2 (s - 2)^2
        ((1, -3, 3, -1, 0), 9, 0, 1),  # a triple root is a crossing
        ((1, -4, 6, -4, 1), INF, 0, INF),  # a fourfold one is not
        ((3, -7, 5, -1, 0), INF, 0, 3),  # (1 - s)^2 (3 - s)
        ((3, -7, 5, -1, 0), 3, 0, 3),
        ((0, 0, 0, 0, -1), 1, 0, 0),
        ((0, 0, 0, 1, -1), 9, 0, 1),
        ((-1, -1e-16, 1, -1, 0), 9, 1e-8, 2 / 3),  # let pass, rises, and turns below zero
        ((-1, -1, 2, -2, 0), 9, 2, 1 / 3),  # let pass, slows down, and then no more: g'' = 0
        ((1, 0, 0, 0, 0), INF, 0, INF),
        ((1, 1e-3, 0, 0, 2), INF, 0, INF),
    ],
)
def test_the_rule(c, T, tol, expected):
    for degree in (2, 4, 8):
        if len(c) <= degree + 1:
            k = [float(x) for x in c] + [0.0] * (degree + 1 - len(c))
            s = interpreted(k, T, tol)
            assert s == answers(np.array([k]), T, tol)[0]
            assert s == expected or abs(s - expected) < 1e-12 * expected


def test_the_extreme_value_is_taken_at_the_turn_not_beside_it():
    x = 1 + 2.0**-45
    p, turn = turning((1.0, -2.0, 1.0, 0.0, 0.0), (0.0,) * 5, x)  # (s - 1)^2
    assert (p, turn) == (2.0**-90, 0.0)
    p, turn = turning((2.0**40 - 2.0**-13, -(2.0**41), 2.0**40, 0.0, 0.0), (0.0,) * 5, x)  # two roots 2^-26 beside 1
    assert turn == -(2.0**-13)
    assert p == 2.0**-50 - 2.0**-13


numbers = st.one_of(
    st.integers(-4, 4).map(float),
    st.floats(-8, 8).filter(lambda x: x == 0 or abs(x) > 1e-20),
    st.sampled_from([1e-20, -1e-20, 1e-14, -1e-14]),
)


@given(st.lists(numbers, min_size=4, max_size=4), st.sampled_from([0.5, 2.0, 1e3, INF]))
@example([-2.0, 1.0, 1e-14, 0.0], INF)
def test_any_polynomial_from_above_zero(higher, T):
    c = [1.0, *higher]
    s = hit4(*c, T, 0.0)
    eight = hit8((*c, 0.0, 0.0, 0.0, 0.0), T, 0.0)
    assert s == eight or abs(s - eight) <= 1e-12 * s
    g = integers(c)
    near = Fraction(s) * (1 - WITHIN) if s < INF else INF
    if s < INF:
        assert sign_at(g, near) > 0 or count(g, near, Fraction(s) * (1 + WITHIN)) > 0
    if len(g) > 1 and len(chain(g)[-1]) == 1:  # no multiple root: every root is a crossing
        assert count(g, 0, near if s < INF or T == INF else Fraction(T)) == 0


@given(st.floats(-1e100, 1e100), st.floats(-1e100, 1e100))
def test_sums_and_products_are_exact(a, b):
    s, e = two_sum(a, b)
    assert Fraction(s) + Fraction(e) == Fraction(a) + Fraction(b)
    if a == 0 or b == 0 or abs(a * b) > 1e-200:
        p, e = two_prod(a, b)
        assert Fraction(p) + Fraction(e) == Fraction(a) * Fraction(b)


@pytest.mark.parametrize("degree", [4, 8])
def test_compensated_horner_keeps_its_bound(degree):
    rng = np.random.default_rng(13)
    c = expand((1 + 0.01 * rng.normal(size=(500, degree))).astype(complex))
    plain = 0
    for k in map(tuple, c.tolist()):
        x = float(1 + 0.01 * rng.normal())
        p, d = accurate(k, (0.0,) * (degree + 1), x)
        X, u = Fraction(x), Fraction(1, 2**53)
        exact = sum(Fraction(a) * X**i for i, a in enumerate(k))
        slope = sum(i * Fraction(a) * X ** (i - 1) for i, a in enumerate(k) if i)
        size = sum(abs(Fraction(a)) * X**i for i, a in enumerate(k))
        assert abs(Fraction(p) - exact) <= u * abs(exact) + (2 * degree * u) ** 2 * size
        assert abs(Fraction(d) - slope) <= u * abs(slope) + degree * (2 * degree * u) ** 2 * size
        horner = 0.0
        for a in k[::-1]:
            horner = horner * x + a
        plain += abs(Fraction(horner) - exact) > 2 * u * abs(exact)
    assert plain > 400  # what compensation is for
