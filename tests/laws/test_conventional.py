"""The conventional law (16)-(26): the printed numbers, both roots against SymPy, its identities and its refusals."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.identities import ROUNDING, directions, energy, inertias, mirrored, numbers, rotation

import carom
from carom.laws.conventional import conventional_reflection, mirror_root

BALL = carom.Ball(radius=0.03, mass=0.2)


def test_example_exactly():
    u0, v0, a = Fraction(3, 7), Fraction(11, 5), Fraction(1, 40)
    v1, w1 = conventional_reflection(
        (-u0, v0, Fraction(0)),
        (-v0 / a, -u0 / a, Fraction(0)),
        (Fraction(1), Fraction(0), Fraction(0)),
        a,
        Fraction(2, 5),
    )
    # the numbers of section 4: x' = u0, y' = 5/9 v0, omega_z = 14/9 v0/a
    assert v1 == (u0, Fraction(5, 9) * v0, 0)
    assert w1 == (-v1[1] / a, v1[0] / a, Fraction(14, 9) * v0 / a)


def test_example_angle():
    after = carom.conventional(BALL, carom.rolling(BALL, (-1.0, 1.0)))
    angle = math.degrees(math.atan2(after.velocity[1], after.velocity[0]))
    assert angle == pytest.approx(math.degrees(math.atan(5 / 9)), rel=ROUNDING)
    assert round(angle, 1) == 29.1


def test_both_roots_against_sympy():
    """(17), (18), (20), (21) solved for y1 and omega_z1: exactly two roots, equal to ours at rational points."""
    sp = pytest.importorskip("sympy")
    m, a, i = sp.symbols("m a I", positive=True)
    x0, y0, wz0, y1, wz1 = sp.symbols("x0 y0 wz0 y1 wz1", real=True)

    def twice_energy(x, y, wz):  # (20) with (18)
        return m * (x**2 + y**2) + i * ((y / a) ** 2 + (x / a) ** 2 + wz**2)

    roots = sp.solve(
        [
            (m * a**2 + i) * (-y1 / a + y0 / a) - i * (wz1 - wz0),  # (17) with (18)
            twice_energy(-x0, y1, wz1) - twice_energy(x0, y0, wz0),  # (19) with e = 1, (21)
        ],
        [y1, wz1], dict=True,
    )  # fmt: skip
    assert len(roots) == 2
    (printed,) = (r for r in roots if sp.simplify(r[y1] - y0) != 0)
    (trivial,) = (r for r in roots if sp.simplify(r[y1] - y0) == 0)
    assert sp.simplify(trivial[wz1] - wz0) == 0
    # (22) as printed
    assert sp.simplify(printed[y1] - (m * a**2 * y0 / 2 + i * a * wz0) / (i + m * a**2 / 2)) == 0
    assert sp.simplify(printed[wz1] - ((i + m * a**2) * y0 / a - m * a**2 * wz0 / 2) / (i + m * a**2 / 2)) == 0
    rng = random.Random(2)

    def rational():
        return Fraction(rng.randint(1, 30), rng.randint(1, 30))

    for _ in range(10):
        kappa, av = rational() / 45, rational()
        xv, yv, wv = -rational(), rational() - rational(), rational() - rational()
        point = {m: 1, a: av, i: kappa * av * av, x0: xv, y0: yv, wz0: wv}
        point = {k: sp.Rational(Fraction(q).numerator, Fraction(q).denominator) for k, q in point.items()}
        for law, root in ((conventional_reflection, printed), (mirror_root, trivial)):
            v1, w1 = law(
                (xv, yv, Fraction(0)), (-yv / av, xv / av, wv), (Fraction(1), Fraction(0), Fraction(0)), av, kappa
            )
            expected = [Fraction(int(q.p), int(q.q)) for q in (root[s].subs(point) for s in (y1, wz1))]
            assert [v1[1], w1[2]] == expected
            assert v1[0] == -xv


def test_restitution_below_one_would_have_to_choose_a_side():
    """Hypothesis 3 with e < 1, square on and without spin: two roots, one the mirror image of the other, no third."""
    sp = pytest.importorskip("sympy")
    y1, wz1 = sp.symbols("y1 wz1", real=True)
    k, e = sp.Rational(2, 5), sp.Rational(1, 2)
    roots = sp.solve([(1 + k) * -y1 - k * wz1, (1 + k) * (e**2 + y1**2) + k * wz1**2 - (1 + k)], [y1, wz1], dict=True)
    assert len(roots) == 2
    assert roots[0][y1] == -roots[1][y1] != 0


@given(numbers(), numbers(), numbers(), inertias, directions(level=True))
def test_identities(x, y, wz, kappa, n):
    p = (-n[1], n[0])  # along the wall, k x n
    v = (-abs(x) * n[0] + y * p[0], -abs(x) * n[1] + y * p[1], 0.0)
    w = (-v[1], v[0], wz)
    v1, w1 = conventional_reflection(v, w, n, 1.0, kappa)
    first, after = (np.array(v), np.array(w)), (np.array(v1), np.array(w1))
    size = 1 + math.sqrt(sum(c * c for c in (*v, *w)))
    # hypotheses 1, 2, 3
    assert (w1[0], w1[1], v1[2]) == pytest.approx((-v1[1], v1[0], 0), abs=ROUNDING * size)
    assert after[0] @ n == pytest.approx(abs(x), abs=ROUNDING * size)
    assert energy(*after, 1.0, kappa) == pytest.approx(energy(*first, 1.0, kappa), rel=10 * ROUNDING, abs=1e-300)
    # (17) along n: (m a^2 + I) omega_n - I omega_z is kept (the conjugate of a turn about the line of both contacts)
    kept = [(1 + kappa) * (s[1] @ n) - kappa * s[1][2] for s in (first, after)]
    assert kept[1] == pytest.approx(kept[0], abs=ROUNDING * size)
    # (26): all three parts of the wall contact's velocity are reversed
    slip = [s[0] - np.cross(s[1], n) for s in (first, after)]
    np.testing.assert_allclose(slip[1], -slip[0], atol=ROUNDING * size)
    # reversible: run backwards it comes to where it came from
    back = conventional_reflection(tuple(-after[0]), tuple(-after[1]), n, 1.0, kappa)
    np.testing.assert_allclose(back, (-first[0], -first[1]), atol=10 * ROUNDING * size)


def test_symmetries():
    rng = np.random.default_rng(3)
    n = np.array([0.6, 0.8, 0.0])
    velocity = rng.normal(size=(500, 2))
    velocity[velocity @ n[:2] > 0] *= -1
    before = carom.rolling(BALL, velocity, rng.normal(size=500) / BALL.radius)
    after = carom.conventional(BALL, before, n)
    a = BALL.radius
    for m in ([1, 0, 0], [0, 1, 0], [0.8, -0.6, 0]):  # mirrors that leave the floor where it is
        v, w = mirrored(before.velocity, before.spin, m)
        got = carom.conventional(BALL, carom.State(v, w), mirrored(n, n, m)[0])
        v, w = mirrored(after.velocity, after.spin, m)
        np.testing.assert_allclose(got.velocity, v, atol=100 * ROUNDING)
        np.testing.assert_allclose(got.spin * a, w * a, atol=100 * ROUNDING)
    r = rotation((0, 0, 1), 1.1).T
    got = carom.conventional(BALL, carom.State(before.velocity @ r, before.spin @ r), n @ r)
    np.testing.assert_allclose(got.velocity, after.velocity @ r, atol=100 * ROUNDING)
    np.testing.assert_allclose(got.spin * a, after.spin @ r * a, atol=100 * ROUNDING)
    got = carom.conventional(BALL, carom.State(before.velocity * 4, before.spin * 4), n)
    np.testing.assert_array_equal(got.velocity, after.velocity * 4)
    larger = carom.Ball(BALL.radius * 2, 3.0)
    got = carom.conventional(larger, carom.State(before.velocity, before.spin / 2), n)
    np.testing.assert_array_equal(got.velocity, after.velocity)
    np.testing.assert_array_equal(got.spin * 2, after.spin)


@given(
    st.sampled_from([0.0, 1e-150, 1.0, 1e90]), st.sampled_from([0.0, -1e-150, 1.0, 1e90]), st.sampled_from([0.0, 1e90])
)
def test_finite(x, y, wz):
    v1, w1 = conventional_reflection((-x, y, 0.0), (-y, -x, wz), (1.0, 0.0, 0.0), 1.0, 1e-9)
    assert np.isfinite([*v1, *w1]).all()


def test_printed_22_coincides_with_reversed_slip():
    """(24), (25) for no vertical spin: V_B0 = (x, y, x), V_B1 = -V_B0."""
    for kappa in (2 / 5, 2 / 3):
        ball = carom.Ball(0.03, 0.2, kappa)
        before = carom.rolling(ball, (-1.3, 0.4))
        after = carom.conventional(ball, before)

        def at_wall(state):
            return state.velocity + np.cross(state.spin, [-0.03, 0, 0])

        np.testing.assert_allclose(at_wall(before), [-1.3, 0.4, -1.3], rtol=ROUNDING)
        np.testing.assert_allclose(at_wall(after), [1.3, -0.4, 1.3], rtol=10 * ROUNDING)


@pytest.mark.parametrize(
    ("state", "normal", "restitution", "words"),
    [
        (carom.State((-1, 1, 0), (0, 0, 0)), (1, 0, 0), 1.0, "hypothesis 1: a ball that rolls"),
        (carom.State((-1, 1, 0.1), (-1 / 0.03, -1 / 0.03, 0)), (1, 0, 0), 1.0, "hypothesis 1: a ball that rolls"),
        (carom.rolling(BALL, (-1, 1)), (1, 0, -0.1), 1.0, "vertical wall"),
        (carom.rolling(BALL, (-1, 1)), (1, 0, 0), 0.9, "expected 1 .*got 0.9"),
        (carom.rolling(BALL, (1, 1)), (1, 0, 0), 1.0, "moves towards the wall"),
    ],
)
def test_refused_with_the_reason(state, normal, restitution, words):
    with pytest.raises(carom.CaromError, match=words):
        carom.conventional(BALL, state, normal, restitution)


def test_one_bad_state_of_many_is_named():
    states = carom.rolling(BALL, [(-1, 1)] * 5)
    states.spin[3] = 0
    with pytest.raises(carom.CaromError, match=r"index \(3,\)"):
        carom.conventional(BALL, states)
