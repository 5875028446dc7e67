"""One contact against every identity it should meet, and against the paper's (28)-(33), (40)."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference.identities import (
    ROUNDING,
    angular_momentum,
    approaching,
    contact_velocity,
    directions,
    energy,
    frictions,
    inertias,
    kappas,
    mirrored,
    numbers,
    restitutions,
    rotation,
    size,
    surfaces,
    tangentials,
    vectors,
)

import carom
from carom.core.contact import GRAZE, SLIDE, STICK, wall_contact

X = (1, 0, 0)
MANY = 20_000


# --- the paper ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("u0", "v0"), [(Fraction(1), Fraction(1)), (Fraction(3, 7), Fraction(-11, 5)), (Fraction(2), Fraction(0))]
)
def test_first_impact_of_the_example_exactly(u0, v0):
    a = Fraction(21, 800)
    v1, w1, j, required, regime = wall_contact(
        (-u0, v0, Fraction(0)),
        (-v0 / a, -u0 / a, Fraction(0)),
        (Fraction(1), Fraction(0), Fraction(0)),
        a,
        Fraction(2, 5),
        1,
        math.inf,
        0,
    )
    # (40)
    assert v1 == (u0, Fraction(5, 7) * v0, Fraction(2, 7) * u0)
    assert w1 == (-v0 / a, -Fraction(2, 7) * u0 / a, Fraction(5, 7) * v0 / a)
    # (31)
    assert j == (2 * u0, -Fraction(2, 7) * v0, Fraction(2, 7) * u0)
    assert regime == STICK
    # (29): sqrt(R_y^2 + R_z^2)/R_x, a float because of its root
    assert required == pytest.approx(math.sqrt(v0 * v0 + u0 * u0) / (7 * u0), rel=1e-15)


@pytest.mark.slow
def test_first_impact_for_any_moment_against_sympy():
    """(28), (19), (30) solved as nine linear equations; equal at random rational points, as rationals."""
    sp = pytest.importorskip("sympy")
    m, a, i, e, x0, y0, wz0 = sp.symbols("m a I e x0 y0 wz0")
    x1, y1, z1, wx1, wy1, wz1, rx, ry, rz = unknowns = sp.symbols("x1 y1 z1 wx1 wy1 wz1 Rx Ry Rz")
    solution = sp.solve(
        [
            # (28); before it, (27): omega_x = -y/a, omega_y = x/a
            m * (x1 - x0) - rx, m * (y1 - y0) - ry, m * z1 - rz,
            i * (wx1 + y0 / a), i * (wy1 - x0 / a) - a * rz, i * (wz1 - wz0) + a * ry,
            x1 + e * x0,  # (19)
            y1 - a * wz1, z1 + a * wy1,  # (30)
        ],
        unknowns, dict=True,
    )[0]  # fmt: skip
    rng = random.Random(1)

    def rational():
        return Fraction(rng.randint(1, 40), rng.randint(1, 40))

    for _ in range(20):
        kappa, ev, av, mv = rational() / 40, Fraction(rng.randint(0, 8), 8), rational(), rational()
        xv, yv, wv = -rational(), rational() - rational(), rational() - rational()
        point = {m: mv, a: av, i: kappa * mv * av * av, e: ev, x0: xv, y0: yv, wz0: wv}
        point = {k: sp.Rational(q.numerator, q.denominator) for k, q in point.items()}
        v1, w1, j, _required, regime = wall_contact(
            (xv, yv, Fraction(0)),
            (-yv / av, xv / av, wv),
            (Fraction(1), Fraction(0), Fraction(0)),
            av,
            kappa,
            ev,
            math.inf,
            0,
        )
        expected = [Fraction(int(q.p), int(q.q)) for q in (solution[s].subs(point) for s in unknowns)]
        assert [*v1, *w1, *(c * mv for c in j)] == expected
        assert regime == STICK


def test_energies_of_the_first_impact():
    """(32), (33) for e = 1 without vertical spin, and T1 < T0."""
    ball = carom.Ball(radius=0.03, mass=0.17, inertia=0.37)
    m, a, moment = ball.mass, ball.radius, ball.moment
    for x0, y0 in [(-1.3, 0.4), (-0.2, -2.0), (-1.0, 0.0)]:
        hit = carom.impact(ball, carom.rolling(ball, (x0, y0)))
        t0 = (m * x0**2 + m * y0**2 + moment * y0**2 / a**2 + moment * x0**2 / a**2) / 2
        t1 = (
            m * x0**2
            + m**2 * a**2 * y0**2 / (moment + m * a**2)
            + moment * y0**2 / a**2
            + moment**2 * x0**2 / (a**2 * (moment + m * a**2))
        ) / 2
        assert carom.kinetic_energy(ball, hit.before) == pytest.approx(t0, rel=ROUNDING)
        assert carom.kinetic_energy(ball, hit.after) == pytest.approx(t1, rel=ROUNDING)
        assert t1 < t0
        assert hit.energy_lost == pytest.approx(t0 - t1, rel=1e-13)  # a difference: some digits go


# --- identities, on many random states with special values ----------------------------------------------------------


@pytest.fixture(scope="module")
def many():
    """Random balls, states, normals and surfaces, and what the contact made of them."""
    rng = np.random.default_rng(20)
    a = 10.0 ** rng.uniform(-3, 2, MANY)
    v, w, n = approaching(rng, MANY, a[:, None])
    kappa = kappas(rng, MANY)
    e, mu, beta = surfaces(rng, MANY)
    ball = carom.Ball(a, 1.0, kappa)
    surface = carom.Surface(e, mu, beta)
    return ball, surface, carom.State(v, w), n, carom.impact(ball, carom.State(v, w), n, surface)


def energies(many):
    ball, _surface, before, _n, hit = many
    a, kappa = ball.radius, ball.kappa
    return [_energy(x, a, kappa) for x in (before, hit.after)]


def _energy(state, a, kappa):
    v, w = state.velocity, state.spin
    return ((v * v).sum(axis=-1) + kappa * a * a * (w * w).sum(axis=-1)) / 2


def scale(many):
    ball, _surface, before, _n, _hit = many
    return size(before.velocity, before.spin * ball.radius[:, None], 1.0)


def test_energy_never_grows(many):
    _ball, surface, _before, _n, hit = many
    t0, t1 = energies(many)
    assert (t1 <= t0 * (1 + ROUNDING)).all()
    # conserved: nothing lost along the normal, and along the wall nothing rubs, or all of the slip comes back
    returns = (surface.tangential_restitution == 1) & (hit.code != SLIDE)
    kept = (surface.restitution == 1) & ((surface.friction == 0) | (surface.tangential_restitution == -1) | returns)
    assert kept.sum() > 1000
    np.testing.assert_allclose(t1[kept], t0[kept], rtol=ROUNDING)


def test_energy_lost_is_the_textbook_sum(many):
    """Loss = (1 - e^2) u_n^2/2 + what the tangential impulse f takes: f.(u_t + u_t')/2, per mass."""
    ball, surface, before, n, hit = many
    t0, t1 = energies(many)
    un, ut = contact_velocity(before.velocity, before.spin * ball.radius[:, None], n, 1.0)
    _un1, ut1 = contact_velocity(hit.after.velocity, hit.after.spin * ball.radius[:, None], n, 1.0)
    f = hit.impulse - (hit.impulse * n).sum(axis=-1, keepdims=True) * n
    lost = (1 - surface.restitution**2) * un**2 / 2 - (f * (ut + ut1)).sum(axis=-1) / 2
    np.testing.assert_allclose(t0 - t1, lost, atol=ROUNDING * scale(many).max() ** 2)


def test_normal_velocity_comes_back_e_times(many):
    """(19)"""
    _ball, surface, before, n, hit = many
    un, un1 = ((s.velocity * n).sum(axis=-1) for s in (before, hit.after))
    np.testing.assert_allclose(un1, -surface.restitution * un, atol=ROUNDING * scale(many).max())


def test_impulse_is_in_the_cone_and_against_the_slip(many):
    ball, surface, before, n, hit = many
    spin, a = before.spin * ball.radius[:, None], scale(many).max()
    _un, ut = contact_velocity(before.velocity, spin, n, 1.0)
    _un, ut1 = contact_velocity(hit.after.velocity, hit.after.spin * ball.radius[:, None], n, 1.0)
    jn = (hit.impulse * n).sum(axis=-1)
    f = hit.impulse - jn[:, None] * n
    sizes = np.sqrt((f * f).sum(axis=-1))
    assert (jn >= -ROUNDING * a).all()
    finite = np.isfinite(surface.friction)
    assert (sizes[finite] <= surface.friction[finite] * jn[finite] + ROUNDING * a).all()
    # against the slip: parallel, and never with it
    assert ((f * ut).sum(axis=-1) <= ROUNDING * a**2).all()
    np.testing.assert_allclose(np.cross(f, ut), 0, atol=10 * ROUNDING * a**2)
    slides, sticks, grazes = (hit.code == code for code in (SLIDE, STICK, GRAZE))
    np.testing.assert_allclose(sizes[slides], surface.friction[slides] * jn[slides], atol=ROUNDING * a)
    # a contact that holds turns the slip into -beta times itself; friction that slides to the end never reverses more
    beta = surface.tangential_restitution[:, None]
    np.testing.assert_allclose(ut1[sticks], (-beta * ut)[sticks], atol=ROUNDING * a)
    kept = (ut1 * ut).sum(axis=-1)[slides], (-beta[:, 0] * (ut * ut).sum(axis=-1))[slides]
    assert (kept[0] >= kept[1] - ROUNDING * a**2).all()
    assert (hit.impulse[grazes] == 0).all()
    assert slides.sum() > 1000
    assert sticks.sum() > 1000
    assert grazes.any()


def test_required_friction_says_whether_it_holds(many):
    _ball, surface, _before, _n, hit = many
    holds = hit.required_friction <= surface.friction * (1 + 4e-16)  # quotient and product round differently
    pressed = hit.code != GRAZE
    assert (holds == (hit.code == STICK))[pressed].mean() > 0.9999
    assert np.isfinite(hit.required_friction).all()
    assert (hit.required_friction >= 0).all()


def test_angular_momentum_about_the_contact(many):
    ball, _surface, before, n, hit = many
    a = ball.radius[:, None]
    l0, l1 = (angular_momentum(s.velocity, s.spin * a, n, 1.0, ball.kappa) for s in (before, hit.after))
    np.testing.assert_allclose(l1, l0, atol=ROUNDING * scale(many).max())


def test_impulse_is_the_change_of_momentum(many):
    _ball, _surface, before, _n, hit = many
    np.testing.assert_allclose(hit.after.velocity - before.velocity, hit.impulse, atol=ROUNDING * scale(many).max())


def test_spin_about_the_normal_stays(many):
    """Nothing pivots: the contact is a point."""
    ball, _surface, before, n, hit = many
    change = ((hit.after.spin - before.spin) * n).sum(axis=-1) * ball.radius
    np.testing.assert_allclose(change, 0, atol=ROUNDING * scale(many).max())


def changed(many, state, n, factor=1.0, ball=None):
    was, surface, _before, _n, _hit = many
    return carom.impact(ball or was, carom.State(state[0] * factor, state[1] * factor), n, surface)


def close_states(many, got, v, w, factor=1.0):
    """Equal to rounding; a state that a rounding moves across the edge of the cone moves on without a jump.

    The transformed input is rounded already, and kappa >= 0.1 multiplies the rounding of an impulse in a spin by 10.
    """
    a = many[0].radius[:, None]
    tolerance = 10 * ROUNDING * scale(many).max() * factor
    np.testing.assert_allclose(got.velocity, v, atol=tolerance)
    np.testing.assert_allclose(got.spin * a, w * a, atol=tolerance)


@pytest.fixture(scope="module")
def plain(many):
    """The same, without two things that a rounded input may answer quite differently.

    kappa = 1e-6 multiplies the rounding of a spin by a million; and at u_n = 0 the law jumps where friction is infinite
    (a graze has no friction at all, the slightest approach all of it).
    """
    ball, surface, before, n, _hit = many
    keep = (ball.kappa > 0.05) & ((before.velocity * n).sum(axis=-1) < -1e-9)
    smaller = carom.Ball(ball.radius[keep], 1.0, ball.kappa[keep])
    parts = (surface.restitution, surface.friction, surface.tangential_restitution)
    state = before[keep]
    cut = carom.Surface(*(x[keep] for x in parts))
    return smaller, cut, state, n[keep], carom.impact(smaller, state, n[keep], cut)


def test_mirror_symmetry(plain):
    _ball, _surface, before, n, hit = plain
    for m in ([1, 0, 0], [0.6, 0, -0.8], [2 / 3, -1 / 3, 2 / 3]):
        v, w = mirrored(before.velocity, before.spin, m)
        n1, _ = mirrored(n, n, m)
        got = changed(plain, (v, w), n1).after
        close_states(plain, got, *mirrored(hit.after.velocity, hit.after.spin, m))


def test_rotation_invariance(plain):
    """About any axis: one contact knows no vertical."""
    _ball, _surface, before, n, hit = plain
    for axis, angle in (((0, 0, 1), 1.0), ((1, 2, 3), 2.5)):
        r = rotation(axis, angle).T
        v, w, n1 = before.velocity @ r, before.spin @ r, n @ r
        got = changed(plain, (v, w), n1).after
        close_states(plain, got, hit.after.velocity @ r, hit.after.spin @ r)


@pytest.mark.parametrize("factor", [2.0, 1e-6, 2.0**200, 2.0**-200])
def test_scaling_of_speeds(plain, factor):
    """No speed is special; a power of two does not even round."""
    _ball, _surface, before, n, hit = plain
    got = changed(plain, (before.velocity, before.spin), n, factor).after
    if factor == 1e-6:
        close_states(plain, got, hit.after.velocity * factor, hit.after.spin * factor, factor)
    else:
        np.testing.assert_array_equal(got.velocity, hit.after.velocity * factor)
        np.testing.assert_array_equal(got.spin, hit.after.spin * factor)


def test_scaling_of_lengths_and_masses(plain):
    ball, surface, before, n, hit = plain
    larger = carom.Ball(ball.radius * 4, 8.0, ball.kappa)
    got = carom.impact(larger, carom.State(before.velocity, before.spin / 4), n, surface)
    np.testing.assert_array_equal(got.after.velocity, hit.after.velocity)
    np.testing.assert_array_equal(got.after.spin * 4, hit.after.spin)
    np.testing.assert_array_equal(got.impulse, hit.impulse * 8)


def test_galilean_invariance(plain):
    """A wall that moves: a ball of 1e30 times the mass, seen from a frame in which it does not rest."""
    ball, surface, before, n, hit = plain
    shift = np.array([0.3, -0.7, 0.2])
    wall = carom.Ball(1.0, 1e30, "solid")
    state = carom.State(before.velocity + shift, before.spin)
    got = carom.collide(ball, state, wall, carom.State(shift), n, surface)
    tolerance = 20 * ROUNDING * scale(plain).max()
    np.testing.assert_allclose(got.after[0].velocity - shift, hit.after.velocity, atol=tolerance)
    np.testing.assert_allclose(got.impulse, hit.impulse, atol=tolerance)
    np.testing.assert_allclose(got.after[1].velocity, np.broadcast_to(shift, got.after[1].velocity.shape), atol=1e-28)


def test_reversible_where_it_conserves(plain):
    """Run backwards (reverse velocity and spin) an elastic contact that returns its slip gives the state before."""
    ball, _surface, before, n, _hit = plain
    for surface in (carom.Surface(1, math.inf, 1), carom.Surface(1, 0), carom.Surface(1, math.inf, -1)):
        after = carom.impact(ball, before, n, surface).after
        firm = (after.velocity * n).sum(axis=-1) > 1e-12
        one = carom.Ball(ball.radius[firm], 1.0, ball.kappa[firm])
        back = carom.impact(one, carom.State(-after.velocity[firm], -after.spin[firm]), n[firm], surface).after
        cut = (one, None, before[firm], None, None)
        close_states(cut, back, -before.velocity[firm], -before.spin[firm])


def test_continuous_at_the_edge_of_the_cone():
    """Stick and slide meet: a friction just below and just above the required one differ by as little."""
    ball, state = carom.Ball(), carom.State((-1.0, 0.7, -0.3), (3.0, -20.0, 11.0))
    for beta in (-0.5, 0.0, 0.4, 1.0):
        hit = carom.impact(ball, state, surface=carom.Surface(0.8, math.inf, beta))
        mu = hit.required_friction
        below, above = (
            carom.impact(ball, state, surface=carom.Surface(0.8, mu * f, beta)) for f in (1 - 1e-9, 1 + 1e-9)
        )
        assert (below.regime, above.regime) == ("slide", "stick")
        np.testing.assert_allclose(below.after.velocity, above.after.velocity, atol=1e-8)
        np.testing.assert_allclose(above.after.velocity, hit.after.velocity, atol=0)


# --- Hypothesis: any state, any surface, each parameter at its ends -------------------------------------------------


@given(vectors(), vectors(), directions(), inertias, restitutions, frictions, tangentials)
def test_every_identity_on_every_state(v, w, n, kappa, e, mu, beta):
    un = sum(p * q for p, q in zip(v, n, strict=True))
    v = v if un <= 0 else tuple(-c for c in v)
    v1, w1, j, required, _regime = wall_contact(v, w, n, 1.0, kappa, e, mu, beta)
    v, w, n, v1, w1, j = map(np.array, (v, w, n, v1, w1, j))
    a = size(v, w, 1.0)
    # kappa multiplies w: its smallness is no excuse here
    assert energy(v1, w1, 1.0, kappa) <= energy(v, w, 1.0, kappa) * (1 + ROUNDING) + 1e-300
    assert abs(v1 @ n + e * (v @ n)) <= ROUNDING * a + 1e-320
    np.testing.assert_allclose(
        angular_momentum(v1, w1, n, 1.0, kappa), angular_momentum(v, w, n, 1.0, kappa), atol=ROUNDING * a
    )
    jn = j @ n
    f = j - jn * n
    assert jn >= -ROUNDING * a
    if mu < math.inf:
        assert math.sqrt(f @ f) <= mu * max(jn, 0) + ROUNDING * a * (1 + mu)
    assert required >= 0
    assert np.isfinite([*v1, *w1, *j, required]).all()


EXTREMES = [0.0, 1e-150, -1e-150, 1e-60, 1.0, -1.0, 1e60, -1e100, 1e100]


@given(
    st.tuples(*[st.sampled_from(EXTREMES)] * 6), directions(), inertias, restitutions, frictions, tangentials,
    st.sampled_from([1e-9, 1.0, 1e9]),
)  # fmt: skip
def test_finite_on_every_finite_input(vw, n, kappa, e, mu, beta, a):
    v, w = vw[:3], vw[3:]
    if sum(p * q for p, q in zip(v, n, strict=True)) > 0:
        v = tuple(-c for c in v)
    v1, w1, j, required, _regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    assert all(math.isfinite(c) for c in (*v1, *w1, *j))
    assert required >= 0  # not NaN; infinite where a graze presses by less than the slip by 1e308


@given(vectors(), vectors(), directions(), inertias, restitutions, frictions, tangentials)
def test_a_ball_that_moves_away_is_left_as_it_is(v, w, n, kappa, e, mu, beta):
    un = sum(p * q for p, q in zip(v, n, strict=True))
    v = v if un >= 0 else tuple(-c for c in v)
    v1, w1, j, required, regime = wall_contact(v, w, n, 1.0, kappa, e, mu, beta)
    assert (v1, w1, regime, required) == (v, w, GRAZE, 0)
    assert j == (0, 0, 0)


@given(numbers(), numbers(), restitutions, tangentials)
def test_disc_stays_in_its_plane(y, wz, e, beta):
    v1, w1, _j, _required, _regime = wall_contact(
        (-1.0, y, 0.0), (0.0, 0.0, wz), (1.0, 0.0, 0.0), 1.0, 0.5, e, 0.3, beta
    )
    assert v1[2] == 0
    assert w1[:2] == (0, 0)


def test_a_motion_whose_square_is_no_float_is_refused():
    """Below 1e-160 m/s squares underflow: friction would act without a slip. Zero is at rest, and one small component is fine."""
    ball = carom.Ball()
    for velocity, spin in (((-1e-161, -1e-165, 0), (0, 0, 0)), ((0, 0, 0), (0, 1e-200, 0))):
        with pytest.raises(
            carom.CaromError,
            match=r"state: expected a ball at rest, or a component of velocity or spin of at least 1e-100",
        ):
            carom.impact(ball, carom.State(velocity, spin))
        with pytest.raises(carom.CaromError, match=r"collide: state: expected a ball at rest"):
            carom.collide(ball, carom.State(velocity, spin), ball, carom.State((0, 0, 0)))
    with pytest.raises(carom.CaromError, match=r"got 1e-170 at index \(1,\) \(1 "):
        carom.two_step(ball, carom.State([(-1, 0, 0), (-1e-170, 0, 0)]))
    assert carom.impact(ball, carom.State((-1, 1e-200, 0))).after.velocity[0] == 1
    assert carom.impact(ball, carom.State((0, 0, 0))).regime == "graze"
    assert carom.State(np.full((2, 3), 6.9e-310)).shape == (2,)  # (an array to be written into)
