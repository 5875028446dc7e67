"""The no-slip law against the published maps for discs and superballs; the mirror."""

import math

import numpy as np
import pytest
from hypothesis import given
from reference.identities import ROUNDING, approaching, directions, energy, inertias, mirrored, numbers, vectors

import carom
from carom.laws.mirror import mirror_reflection
from carom.laws.no_slip import no_slip_reflection


@pytest.mark.parametrize("kappa", [1 / 2, 1.0, 0.2])
def test_discs_as_cox_and_feres_have_them(kappa):
    """No-slip billiards in dimension two: with x0 = gamma a omega (gamma^2 = kappa), x1 along and x2 across the wall,

    the collision is [[-cos b, -sin b, 0], [-sin b, cos b, 0], [0, 0, -1]], cos b = (1 - gamma^2)/(1 + gamma^2),
    sin b = 2 gamma/(1 + gamma^2); the sign of sin b goes with the sense in which omega and x1 are counted.
    """
    gamma = math.sqrt(kappa)
    cos, sin = (1 - kappa) / (1 + kappa), 2 * gamma / (1 + kappa)
    table = np.array([[-cos, -sin, 0], [-sin, cos, 0], [0, 0, -1]])
    np.testing.assert_allclose(table @ table, np.eye(3), atol=ROUNDING)  # an involution, so reversible
    disc = carom.Disc(0.5, 2.0, kappa)
    rng = np.random.default_rng(4)
    for _ in range(50):
        angle = rng.uniform(0, 2 * math.pi)
        n, t = np.array([math.cos(angle), math.sin(angle), 0]), np.array([math.sin(angle), -math.cos(angle), 0])
        omega, along, across = rng.normal(), rng.normal(), -abs(rng.normal())
        # at -a n the spin omega gives the contact point the velocity a omega t
        state = carom.State(along * t + across * n, (0, 0, omega / 0.5))
        after = carom.no_slip(disc, state, n)
        x0, x1, x2 = table @ [gamma * omega, along, across]
        np.testing.assert_allclose(after.velocity, x1 * t + x2 * n, atol=10 * ROUNDING)
        assert after.spin[2] * 0.5 == pytest.approx(x0 / gamma, abs=10 * ROUNDING)
        assert (after.spin[:2] == 0).all()


def test_uniform_disc():
    """gamma = 1/sqrt 2: cos b = 1/3 (a disc that drops straight on a floor with spin leaves with a third of it)."""
    after = carom.no_slip(carom.Disc(1.0, 1.0), carom.State((0, -1, 0), (0, 0, 1)), (0, 1, 0))
    assert after.spin[2] == pytest.approx(-1 / 3, rel=ROUNDING)
    assert after.velocity[0] == pytest.approx(-2 / 3, rel=ROUNDING)


def test_superball_as_garwin_has_it():
    """Solid sphere, velocity V along the floor and peripheral speed C = a omega, counted so that V + C is the slip:

    V' = 3/7 V - 4/7 C, C' = -10/7 V - 3/7 C (Garwin, Am. J. Phys. 37, 88 (1969)).
    """
    ball = carom.Ball(0.025, 0.05)
    for v, c in [(1.0, 0.0), (0.0, 1.0), (0.3, -2.0)]:
        # the lowest point moves with v_x - a omega_y and v_y + a omega_x
        state = carom.State((v, -v, -1.0), (-c / 0.025, -c / 0.025, 0.3))
        after = carom.no_slip(ball, state, (0, 0, 1))
        v1, c1 = 3 / 7 * v - 4 / 7 * c, -10 / 7 * v - 3 / 7 * c
        np.testing.assert_allclose(after.velocity, [v1, -v1, 1.0], atol=10 * ROUNDING)
        np.testing.assert_allclose(after.spin * 0.025, [-c1, -c1, 0.3 * 0.025], atol=10 * ROUNDING)


@given(vectors(), vectors(), directions(), inertias)
def test_no_slip_conserves_reverses_and_returns(v, w, n, kappa):
    if sum(p * q for p, q in zip(v, n, strict=True)) > 0:
        v = tuple(-c for c in v)
    v1, w1, _j, _required = no_slip_reflection(v, w, n, 1.0, kappa)
    old, new = (np.array(v), np.array(w)), (np.array(v1), np.array(w1))
    size = 1 + np.abs([*v, *w]).sum()
    assert energy(*new, 1.0, kappa) == pytest.approx(energy(*old, 1.0, kappa), rel=10 * ROUNDING, abs=1e-300)
    if new[0] @ n > 1e-6:
        # all of the contact point's velocity comes back
        slip = [x[0] - np.cross(x[1], n) for x in (old, new)]
        np.testing.assert_allclose(slip[1], -slip[0], atol=10 * ROUNDING * size / min(kappa, 1) ** 0.5)
        back = no_slip_reflection(tuple(-new[0]), tuple(-new[1]), n, 1.0, kappa)
        np.testing.assert_allclose(back[0], -old[0], atol=10 * ROUNDING * size)
        np.testing.assert_allclose(back[1], -old[1], atol=10 * ROUNDING * size / kappa)  # 1/kappa times an impulse


def test_no_slip_is_the_limit_of_one_contact():
    rng = np.random.default_rng(5)
    v, w, n = approaching(rng, 500)
    ball, state = carom.Ball(1.0, 1.0), carom.State(v, w)
    assert carom.no_slip(ball, state, n) == carom.impact(ball, state, n, carom.Surface(1, math.inf, 1)).after


def test_mirror_is_one_smooth_contact():
    rng = np.random.default_rng(6)
    v, w, n = approaching(rng, 500)
    ball, state = carom.Ball(1.0, 1.0), carom.State(v, w)
    for e in (0.0, 0.3, 1.0):
        after = carom.mirror(ball, state, n, carom.Surface(e))
        smooth = carom.impact(ball, state, n, carom.Surface(e, 0.0)).after
        np.testing.assert_array_equal(after.velocity, smooth.velocity)
        np.testing.assert_array_equal(after.spin, w)
        rough = carom.impact(ball, state, n, carom.Surface(e, math.inf, -1.0)).after
        np.testing.assert_allclose(after.velocity, rough.velocity, atol=ROUNDING)


@given(vectors(), vectors(), directions(), numbers())
def test_mirror_knows_no_spin(v, w, n, wz):
    v1, w1, _j = mirror_reflection(v, w, n, 1.0, 1.0)
    v2, w2, _j = mirror_reflection(v, (w[0], w[1], wz), n, 1.0, 1.0)
    assert w1 == w
    assert w2[2] == wz
    np.testing.assert_allclose(v1, v2, atol=0)
    # speed kept; and twice through the looking-glass is where it came from
    assert math.hypot(*v1) == pytest.approx(math.hypot(*v), rel=10 * ROUNDING)
    back, _w, _j = mirror_reflection(tuple(-c for c in v1), w, n, 1.0, 1.0)
    if sum(p * q for p, q in zip(v, n, strict=True)) < -1e-6:
        np.testing.assert_allclose(back, [-c for c in v], atol=10 * ROUNDING * (1 + math.hypot(*v)))


def test_many_as_few():
    """Every law answers for many balls (compiled) what it answers for few (Python), and a law of a user's own too."""
    ball = carom.Ball()
    rng = np.random.default_rng(7)
    velocity = rng.normal(size=(1000, 2))
    velocity[:, 0] = -np.abs(velocity[:, 0])
    states = carom.rolling(ball, velocity, rng.normal(size=1000))
    for law in (carom.mirror, carom.no_slip, carom.conventional):
        assert law(ball, states)[:300] == law(ball, states[:300])

    def half(v, w, n, a, kappa, e, mu, beta):
        return (-v[0] / 2, v[1], v[2]), w

    own = carom.wall_law(carom.Card("half", "", (), "", "", ""), half)
    after = own.answer(carom.Meeting(ball, states)).after_wall
    np.testing.assert_array_equal(after.velocity[:, 0], -states.velocity[:, 0] / 2)
    v, w = mirrored(after.velocity, after.spin, (0, 1, 0))
    assert own.answer(
        carom.Meeting(ball, carom.State(*mirrored(states.velocity, states.spin, (0, 1, 0))))
    ).after_wall == (carom.State(v, w))
