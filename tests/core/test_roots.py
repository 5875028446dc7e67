"""The first hit of a gap polynomial, held against exact integers (Sturm) and mpmath.

An answer is judged for the polynomial with exactly the float coefficients that were handed in: Sturm's chain, in integers,
counts its roots before the answer, and mpmath's Newton says how far the answer is from the root.
"""

import math
import sys
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from reference.exact_roots import (
    INF,
    KINDS,
    PARABOLAS,
    WITHIN,
    _rows_next,
    answers,
    chain,
    compiled,
    count,
    expand,
    integers,
    interpreted,
    make,
    make_parabolas,
    relative_error,
    sign_at,
    worst,
)
from reference.exploring import tried

from carom.core.roots import accurate_value, hit4, hit8, next_hit4, two_prod, two_sum, value_at_turn

ROWS_JUDGED = tried(200, 500)  # of each kind; campaigns/first_roots.py judges 10,000


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("degree", [4, 8])
def test_first_hit(kind, degree):
    c, T = make(kind, degree, np.random.default_rng(KINDS.index(kind)), ROWS_JUDGED)
    error, hits = worst(c, T)
    sys.stdout.write(f"{kind}, degree {degree}: worst relative error {error:.1e}, {hits} hits of {len(c)}\n")
    assert error <= 1e-12
    assert hits > ROWS_JUDGED / 30


@pytest.mark.parametrize("kind", PARABOLAS)
def test_first_hit_of_a_parabola(kind):
    c, T = make_parabolas(kind, np.random.default_rng(7), ROWS_JUDGED)
    error, hits = worst(c, T)
    sys.stdout.write(f"{kind}, degree 2: worst relative error {error:.1e}, {hits} hits of {len(c)}\n")
    assert error <= 1e-15
    assert hits > ROWS_JUDGED / 30


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
    c = rng.normal(size=(tried(120, 240) if degree < 8 else tried(60, 80), degree + 1))
    c[:, 1] *= 3
    T = rng.choice([0.7, 2.0, INF], len(c))
    got = answers(c, T)
    expected = [oracle(c[i], T[i]) for i in range(len(c))]
    np.testing.assert_allclose(got, expected, rtol=1e-12)
    assert 20 < np.isfinite(got).sum() < len(c) - 20


def test_next_hit_comes_after_a_rise():
    rng = np.random.default_rng(12)
    c, T = make("random roots", 4, rng, 3000)
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
    p, turn = value_at_turn((1.0, -2.0, 1.0, 0.0, 0.0), (0.0,) * 5, x)  # (s - 1)^2
    assert (p, turn) == (2.0**-90, 0.0)
    p, turn = value_at_turn(
        (2.0**40 - 2.0**-13, -(2.0**41), 2.0**40, 0.0, 0.0), (0.0,) * 5, x
    )  # two roots 2^-26 beside 1
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
        p, d = accurate_value(k, (0.0,) * (degree + 1), x)
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
