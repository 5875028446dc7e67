"""Ball against ball: the identities of one contact for a pair, and Doménech's description derived again."""

import math
from fractions import Fraction

import numpy as np
import pytest
from reference.identities import ROUNDING, rotation, surfaces, units, with_zeros

import carom
from carom.laws.pair import pair_contact

COUNT = 5000


@pytest.fixture(scope="module")
def many():
    rng = np.random.default_rng(30)
    n = units(rng, COUNT)
    v1, w1, v2, w2 = (with_zeros(rng, rng.normal(size=(COUNT, 3))) for _ in range(4))
    away = ((v1 - v2) * n).sum(axis=-1) > 0
    v1[away], v2[away] = v2[away].copy(), v1[away].copy()
    balls = [
        carom.Ball(rng.uniform(0.5, 2, COUNT), 10 ** rng.uniform(-1, 1, COUNT), rng.choice([2 / 5, 2 / 3, 0.1], COUNT))
        for _ in range(2)
    ]
    surface = carom.Surface(*surfaces(rng, COUNT))
    states = carom.State(v1, w1), carom.State(v2, w2)
    return balls, states, n, surface, carom.collide(balls[0], states[0], balls[1], states[1], n, surface)


def column(x):
    return np.asarray(x)[..., None]


def relative(balls, states, n):
    """Normal size and tangential part of the velocity of ball 1's contact point seen from ball 2's."""
    points = [
        s.velocity + np.cross(s.spin, sign * column(b.radius) * n)
        for b, s, sign in zip(balls, states, (-1, 1), strict=True)
    ]
    u = points[0] - points[1]
    un = (u * n).sum(axis=-1)
    return un, u - un[:, None] * n


SCALE = 100  # of the velocities times masses, radii: of order 10 each


def test_what_is_conserved(many):
    balls, before, n, _surface, hit = many
    momentum = [sum(column(b.mass) * s.velocity for b, s in zip(balls, x, strict=True)) for x in (before, hit.after)]
    np.testing.assert_allclose(momentum[1], momentum[0], atol=SCALE * ROUNDING)
    # angular momentum of each ball about the contact: r x m v + I omega
    for ball, sign, old, new in zip(balls, (1, -1), before, hit.after, strict=True):
        arm = sign * column(ball.radius) * n
        both = [np.cross(arm, column(ball.mass) * s.velocity) + column(ball.moment) * s.spin for s in (old, new)]
        np.testing.assert_allclose(both[1], both[0], atol=10 * SCALE * ROUNDING)


def test_energy(many):
    balls, before, _n, surface, hit = many
    t0, t1 = (sum(carom.kinetic_energy(b, s) for b, s in zip(balls, x, strict=True)) for x in (before, hit.after))
    assert (t1 <= t0 * (1 + 10 * ROUNDING)).all()
    np.testing.assert_allclose(hit.energy_lost, t0 - t1, atol=SCALE * ROUNDING)
    returns = (surface.tangential_restitution == 1) & (hit.regime != "slide")
    kept = (surface.restitution == 1) & ((surface.friction == 0) | (surface.tangential_restitution == -1) | returns)
    assert kept.sum() > 200
    np.testing.assert_allclose(t1[kept], t0[kept], rtol=10 * ROUNDING)


def test_restitution_cone_and_slip(many):
    balls, before, n, surface, hit = many
    (un, ut), (un1, ut1) = relative(balls, before, n), relative(balls, hit.after, n)
    np.testing.assert_allclose(un1, -surface.restitution * un, atol=SCALE * ROUNDING)
    jn = (hit.impulse * n).sum(axis=-1)
    f = hit.impulse - jn[:, None] * n
    size = np.sqrt((f * f).sum(axis=-1))
    finite = np.isfinite(surface.friction)
    assert (size[finite] <= surface.friction[finite] * jn[finite] + SCALE * ROUNDING).all()
    assert ((f * ut).sum(axis=-1) <= SCALE * ROUNDING).all()
    sticks = hit.regime == "stick"
    beta = column(surface.tangential_restitution)
    np.testing.assert_allclose(ut1[sticks], (-beta * ut)[sticks], atol=SCALE * ROUNDING)


def test_galilean_invariance(many):
    balls, before, n, surface, hit = many
    v = np.array([0.3, -1.0, 0.6])
    firm = ((before[0].velocity - before[1].velocity) * n).sum(axis=-1) < -1e-9
    parts = [carom.Surface(*(x[firm] for x in vars(surface).values()))]
    cut = [carom.Ball(b.radius[firm], b.mass[firm], b.kappa[firm]) for b in balls]
    moved = [carom.State(s.velocity[firm] + v, s.spin[firm]) for s in before]
    got = carom.collide(cut[0], moved[0], cut[1], moved[1], n[firm], *parts)
    for new, old in zip(got.after, hit.after, strict=True):
        np.testing.assert_allclose(new.velocity - v, old.velocity[firm], atol=SCALE * ROUNDING)
        np.testing.assert_allclose(new.spin, old.spin[firm], atol=SCALE * ROUNDING)
    # and the frame may be turned
    r = rotation((3, 1, -2), 0.7).T
    moved = [carom.State(s.velocity[firm] @ r, s.spin[firm] @ r) for s in before]
    got = carom.collide(cut[0], moved[0], cut[1], moved[1], n[firm] @ r, *parts)
    for new, old in zip(got.after, hit.after, strict=True):
        np.testing.assert_allclose(new.velocity, old.velocity[firm] @ r, atol=SCALE * ROUNDING)


def test_neither_ball_is_the_first(many):
    balls, before, n, surface, hit = many
    got = carom.collide(balls[1], before[1], balls[0], before[0], -n, surface)
    for new, old in zip(got.after, hit.after[::-1], strict=True):
        np.testing.assert_allclose(new.velocity, old.velocity, atol=SCALE * ROUNDING)
        np.testing.assert_allclose(new.spin, old.spin, atol=SCALE * ROUNDING)
    np.testing.assert_allclose(got.impulse, -hit.impulse, atol=SCALE * ROUNDING)


def test_a_heavy_ball_is_a_wall():
    ball, state = carom.Ball(0.03, 0.2), carom.State((-1.0, 0.4, -0.2), (3.0, 11.0, -7.0))
    for surface in (carom.Surface(0.8, 0.1), carom.Surface(0.8, 0.4, 0.5), carom.Surface(1, math.inf, 1)):
        wall = carom.impact(ball, state, (0.6, 0.8, 0), surface)
        hit = carom.collide(ball, state, carom.Ball(50.0, 1e30), carom.State((0, 0, 0)), (0.6, 0.8, 0), surface)
        np.testing.assert_allclose(hit.after[0].velocity, wall.after.velocity, atol=10 * ROUNDING)
        np.testing.assert_allclose(hit.after[0].spin, wall.after.spin, atol=1000 * ROUNDING)
        np.testing.assert_allclose(hit.impulse, wall.impulse, atol=ROUNDING)


def test_kernel_is_exact_in_rationals():
    """Equal smooth balls, head on, e = 1: they exchange velocities."""
    n, zero = (Fraction(1), Fraction(0), Fraction(0)), (Fraction(0), Fraction(0), Fraction(0))
    ball = (Fraction(1), Fraction(1), Fraction(2, 5))
    v1, _w1, v2, _w2, _j, _required, _regime = pair_contact(
        (Fraction(-1), Fraction(1, 3), Fraction(0)), zero, zero, zero, n, *ball, *ball, 1, 0, 0
    )
    assert (v1[0], v2[0]) == (0, -1)


# --- Doménech: impulse and momentum, written again from scratch -----------------------------------------------------


def by_hand(speed, angle, e, mu, kappa, ratio=1.0):
    """A rolling ball (mass 1, along +x) strikes a resting one (mass `ratio`, same radius), centres `angle` to the left.

    The slip between the balls is as fast as the ball itself, sin(angle) along the floor and cos(angle) up and down (the
    front of a rolling ball moves down): per unit of normal impulse friction gives mu times its opposite. Returns regime
    and velocities, and spins times a, of both balls.
    """
    c, s = math.cos(angle), math.sin(angle)
    line, across = np.array([c, s, 0]), np.array([-s, c, 0])
    normal = (1 + e) * speed * c * ratio / (1 + ratio)  # reduced mass ratio/(1 + ratio)
    # contact point of the first ball less that of the second: v + omega x a line = speed (-s across - c k)
    direction = -s * across - c * np.array([0, 0, 1])
    hold = speed * kappa / (1 + kappa) * ratio / (1 + ratio)  # both balls give way in (1 + 1/kappa)
    friction = min(hold, mu * normal)
    on_first = -normal * line - friction * direction
    v1, v2 = np.array([speed, 0, 0]) + on_first, -on_first / ratio
    w1 = np.array([0, speed, 0]) + np.cross(line, on_first) / kappa
    w2 = np.cross(-line, -on_first) / (kappa * ratio)
    return "slip-stick" if hold <= mu * normal else "gross slip", v1, v2, w1, w2


@pytest.mark.parametrize("ratio", [1.0, 0.5, 3.0])
@pytest.mark.parametrize("kappa", [2 / 5, 2 / 3])
def test_domenech_by_hand(ratio, kappa):
    a = 0.0286
    ball, other = carom.Ball(a, 0.17, kappa), carom.Ball(a, 0.17 * ratio, kappa)
    seen = set()
    for e, mu in ((0.95, 0.06), (0.8, 0.3), (1.0, 1.0), (0.5, 0.0)):
        for angle in (-1.2, -0.3, 0.0, 0.5, 1.0, 1.5):
            got = carom.domenech(ball, carom.rolling(ball, (1.7, 0)), other, angle, carom.Surface(e, mu))
            regime, v1, v2, w1, w2 = by_hand(1.7, angle, e, mu, kappa, ratio)
            seen.add(got.regime)
            assert got.regime == regime
            for state, v, w in zip(got.collision.after, (v1, v2), (w1, w2), strict=True):
                np.testing.assert_allclose(state.velocity, v, atol=100 * ROUNDING)
                np.testing.assert_allclose(state.spin * a, w, atol=100 * ROUNDING)
            # the angles along the floor, from the incoming path
            for i, v in enumerate((v1, v2)):
                if math.hypot(v[0], v[1]) > 1e-9:  # a ball at rest has no heading
                    assert got.post_collision_angles[i] == pytest.approx(math.atan2(v[1], v[0]), abs=1e-11)
            # transition: 5/7 v + 2/7 of what the spin rolls like, for a solid ball
            for i, (v, w) in enumerate(((v1, w1), (v2, w2))):
                rolls = (v + kappa * np.array([w[1], -w[0], 0])) / (1 + kappa)
                np.testing.assert_allclose(got.rolling[i].velocity[:2], rolls[:2], atol=100 * ROUNDING)
                assert got.rolling[i].velocity[2] == 0
                if math.hypot(rolls[0], rolls[1]) > 1e-9:
                    expected = math.atan2(rolls[1], rolls[0])
                    assert got.post_transition_angles[i] == pytest.approx(expected, abs=1e-9)
    assert seen == {"gross slip", "slip-stick"}


def test_domenech_edge_between_regimes():
    """Equal balls: slip-stick for mu (1 + e) cos(angle) >= kappa/(1 + kappa), 2/7 for solid balls."""
    ball = carom.Ball()
    for e, mu in ((0.95, 0.2), (0.5, 0.4)):
        edge = math.acos(2 / 7 / (mu * (1 + e)))
        assert carom.domenech(ball, impact_angle=edge - 1e-9, surface=carom.Surface(e, mu)).regime == "slip-stick"
        assert carom.domenech(ball, impact_angle=edge + 1e-9, surface=carom.Surface(e, mu)).regime == "gross slip"


def test_smooth_equal_balls_part_at_right_angles():
    """e = 1, no friction: 90 degrees just after; once rolling, the well-known bend of the cue ball (Coriolis 1835)."""
    ball = carom.Ball()
    for angle in (0.2, 0.7, 1.3):
        got = carom.domenech(ball, impact_angle=angle, surface=carom.Surface(1, 0))
        first, second = got.post_collision_angles
        assert second == pytest.approx(angle, abs=1e-14)
        assert second - first == pytest.approx(math.pi / 2, abs=1e-14)
        # tan(theta) = sin cos/(sin^2 + 2/5)
        expected = -math.atan(math.sin(angle) * math.cos(angle) / (math.sin(angle) ** 2 + 0.4))
        assert got.post_transition_angles[0] == pytest.approx(expected, abs=1e-14)
        assert got.post_transition_angles[1] == pytest.approx(angle, abs=1e-14)


def test_domenech_many_and_any_heading():
    ball = carom.Ball()
    angles = np.linspace(-1.4, 1.4, 501)
    many = carom.domenech(ball, impact_angle=angles)
    for i in (0, 250, 400):
        one = carom.domenech(ball, impact_angle=angles[i])
        np.testing.assert_array_equal(many.rolling[0].velocity[i], one.rolling[0].velocity)
        assert many.regime[i] == one.regime
    turned = carom.domenech(ball, carom.rolling(ball, (-0.6, 0.8)), impact_angle=angles)
    for got, expected in zip(turned.post_transition_angles, many.post_transition_angles, strict=True):
        np.testing.assert_allclose(np.sin(got - expected), 0, atol=1e-13)  # head on, +-pi are the same
    left, right = (carom.domenech(ball, impact_angle=s * 0.4).post_transition_angles for s in (1, -1))
    assert left == pytest.approx([-x for x in right], abs=ROUNDING)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"impact_angle": 1.6}, "impact_angle"),
        ({"impact_angle": math.nan}, "impact_angle"),
        ({"surface": carom.Surface(1, 1, 0.5)}, "tangential_restitution 0"),
        ({"state": carom.State((0, 0, 0))}, "moves along the floor"),
    ],
)
def test_domenech_refuses(options, words):
    with pytest.raises(carom.CaromError, match=words):
        carom.domenech(carom.Ball(), **options)


def test_collide_refuses_balls_that_part():
    ball = carom.Ball()
    with pytest.raises(carom.CaromError, match=r"move apart at index \(1,\)"):
        carom.collide(ball, carom.State([(-1, 0, 0), (1, 0, 0)]), ball, carom.State((0, 0, 0)), (1, 0, 0))


def test_collide_takes_the_rounding_of_a_graze():
    """One row of many moves apart by the rounding of its normal, as :func:`carom.impact` accepts it."""
    ball, n = carom.Ball(), np.array([0.6, 0.8, 0.0])
    along = np.array([-0.8, 0.6, 0.0])
    rows = np.array([-n, along * (1 + 1e-15) + 1e-16 * n])
    assert rows[1] @ n > 0
    hit = carom.collide(ball, carom.State(rows), ball, carom.State((0, 0, 0)), n, carom.Surface(0.9, math.inf))
    assert list(hit.regime) == ["stick", "graze"]
    np.testing.assert_array_equal(hit.after[0].velocity[1], rows[1])
    single = carom.impact(ball, carom.State(rows), n, carom.Surface(0.9, math.inf))
    assert list(single.regime) == ["stick", "graze"]


def test_balls_of_micrometres_collide_like_large_ones():
    """Whether a contact presses is a matter of velocities: of a mass of 1e-18 kg as of one of 1 kg."""
    state, rest, surface = (
        carom.State((-1.0, 0.7, 0.2), (3.0, 2.0, 1.0)),
        carom.State((0, 0, 0)),
        carom.Surface(0.9, 0.05),
    )
    large, small = (carom.collide(ball, state, ball, rest, (1, 0, 0), surface)
                    for ball in (carom.Ball(1e-3, 1.0), carom.Ball(1e-3, 1e-18)))  # fmt: skip
    assert small.regime == large.regime == "slide"
    np.testing.assert_allclose(small.after[0].velocity, large.after[0].velocity, rtol=1e-14)
    np.testing.assert_allclose(small.after[0].spin, large.after[0].spin, rtol=1e-14)
