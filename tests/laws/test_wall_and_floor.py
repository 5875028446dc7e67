"""Wall and floor at once: closed forms by hand, and every identity on 70,000 random pressed states."""

import math

import numpy as np
import pytest
from reference.exploring import tried
from reference.identities import floor_invariants, mirrored, rotation

import carom
from carom.core.contact import GRAZE, SLIDE, STICK
from carom.laws.arrays import loop_for
from carom.laws.two_step import first_rows
from carom.laws.wall_and_floor.solver import JAM, STALL, wall_and_floor

COUNT = 50_000
# Of the speeds. A slip counts as ended at 3e-9 of them, and a step's error is kept below 1e-10 over some hundred steps.
STEPS = 1e-8


def answers(v, w, n, p):
    """Columns of the first impact of pressed balls; p: kappa, the wall's e and mu, the floor's e and mu; radius and mass 1."""
    count, zero = len(v), np.zeros(len(v))
    numbers = np.stack([zero + 1, *p.T[:3], zero, *p.T[3:], zero, zero], axis=-1)
    v1, w1, j, jf = (np.empty((count, 3)) for _ in range(4))
    regime = np.empty(count, dtype=np.int8)
    loop_for(first_rows, count)(v, w, n, numbers, True, v1, w1, j, jf, np.empty(count), regime)
    return v1, w1, j, jf, regime


def is_pressed(v, w, n, mu):
    """Whether the wall pushes a ball of radius 1 down: the ball comes down already, the wall leans over it, or rubs it down."""
    u = v - np.cross(w, n)  # of the point that touches
    ut = u - (u * n).sum(axis=-1)[:, None] * n
    size = np.sqrt((ut * ut).sum(axis=-1))
    with np.errstate(invalid="ignore"):  # an endless friction of no slip
        rubbed = np.where(n[:, 2] == 0, mu > 0, mu * ut[:, 2] > n[:, 2] * size)
    return (v[:, 2] <= 0) & ((v[:, 2] < 0) | (n[:, 2] < 0) | ((ut[:, 2] > 0) & rubbed))


def pressed(rng, count):
    """Balls on the floor (some on their way down) that a wall pushes down: every kind of friction at both."""
    angle = rng.uniform(0, 2 * np.pi, count)
    nz = np.where(rng.random(count) < 0.4, 0.0, rng.uniform(-0.9, 0.5, count))
    level = np.sqrt(1 - nz**2)
    n = np.stack([level * np.cos(angle), level * np.sin(angle), nz], axis=-1)
    v, w = rng.normal(size=(count, 3)), rng.normal(size=(count, 3))
    v[:, 2] = np.where(rng.random(count) < 0.7, 0.0, -np.abs(v[:, 2]))
    away = (v * n).sum(axis=-1) > 0
    v[away, :2] *= -1
    some = rng.random(count)
    w[some < 0.1, 2] = 0  # no vertical spin
    rolls = (some > 0.8) & (v[:, 2] == 0)
    w[rolls, 0], w[rolls, 1] = -v[rolls, 1], v[rolls, 0]
    planar = (some > 0.1) & (some < 0.2)  # all in the plane of the wall's normal and the vertical
    t = np.stack([-n[:, 1], n[:, 0], 0 * angle], axis=-1) / level[:, None]
    v[planar] -= (v * t).sum(axis=-1)[planar, None] * t[planar]
    w[planar] = (w * t).sum(axis=-1)[planar, None] * t[planar]
    frictions = np.array([0.0, 1e-3, 0.2, 1.0, 10.0, np.inf])
    p = np.stack(
        [
            rng.choice([2 / 5, 2 / 3, 1 / 2, 0.1], count),
            rng.choice([0.0, 0.3, 0.5, 1.0], count),
            rng.choice(frictions, count),
            rng.choice([0.0, 0.5, 0.9, 1.0], count),
            rng.choice(frictions, count),
        ],
        axis=-1,
    )
    found = is_pressed(v, w, n, p[:, 2]) & ((v * n).sum(axis=-1) < -1e-6)
    return v[found], w[found], n[found], p[found]


def wide(rng, count):
    """Pressed balls of every kind: hollow ones and heavy in the middle, much spin and little, frictions without end."""
    angle = rng.uniform(0, 2 * np.pi, count)
    nz = np.where(rng.random(count) < 0.3, 0.0, rng.uniform(-0.95, 0.6, count))
    level = np.sqrt(1 - nz**2)
    n = np.stack([level * np.cos(angle), level * np.sin(angle), nz], axis=-1)
    v, w = rng.normal(size=(count, 3)), rng.normal(size=(count, 3)) * np.exp(rng.uniform(-2, 3, count))[:, None]
    v[:, 2] = np.where(rng.random(count) < 0.8, 0.0, -np.abs(v[:, 2]))
    v[(v * n).sum(axis=-1) > 0, :2] *= -1
    some = rng.random(count)
    w[some < 0.1, 2] = 0
    rolls = (some > 0.7) & (v[:, 2] == 0)
    w[rolls, 0], w[rolls, 1] = -v[rolls, 1], v[rolls, 0]

    def friction():
        x = rng.random(count)
        return np.choose(rng.integers(0, 6, count), [0 * x, x, x, 10 + 0 * x, 100 + 0 * x, math.inf + 0 * x])

    def restitution():
        x, kind = rng.random(count), rng.random(count)
        return np.where(kind < 0.2, 0.0, np.where(kind < 0.4, 1.0, x))

    kappa = np.where(rng.random(count) < 0.3, 0.4, np.exp(rng.uniform(math.log(1e-3), math.log(2 / 3), count)))
    p = np.stack([kappa, restitution(), friction(), restitution(), friction()], axis=-1)
    found = is_pressed(v, w, n, p[:, 2]) & ((v * n).sum(axis=-1) < -1e-9)
    return v[found], w[found], n[found], p[found]


@pytest.fixture(scope="module", params=[(pressed, COUNT), (wide, tried(20_000, COUNT))], ids=["pressed", "wide"])
def many(request):
    make, count = request.param  # (a state of the wide ones takes ten times as long)
    v, w, n, p = make(np.random.default_rng(40), 2 * count)
    v, w, n, p = (x[:count] for x in (v, w, n, p))
    assert len(v) == count
    return v, w, n, p, *answers(v, w, n, p)


def speeds(v, w):
    return np.sqrt((v * v).sum(axis=-1)) + np.sqrt((w * w).sum(axis=-1))


def where(bad, many):
    """The first states at fault, for whoever has to look."""
    v, w, n, p, *_ = many
    return [(int(i), v[i].tolist(), w[i].tolist(), n[i].tolist(), p[i].tolist()) for i in np.flatnonzero(bad)[:3]]


@pytest.mark.slow(keep=1)
def test_never_lost(many):
    """Every course is followed to its end, whatever the frictions."""
    regime = many[-1]
    assert not (regime == STALL).any(), where(regime == STALL, many)
    for code in (STICK, SLIDE, JAM, GRAZE):
        assert (regime == code).sum() > 100
    assert np.isin(regime, [GRAZE, STICK, SLIDE, JAM]).all()


@pytest.mark.parametrize("nz", [-0.3, 0.0])
@pytest.mark.parametrize("mu", [0.2, 1.0, 10.0, math.inf])
def test_a_course_that_was_once_lost(mu, nz):
    """Strong side spin under a cushion, an endlessly rough floor: modes whose margin is negative at once."""
    n = (math.sqrt(1 - nz * nz), 0.0, nz)
    v, w, j, jf, regime = wall_and_floor(
        (-1.4417, -2.0678, 0.0), (15.251, 14.866, -47.941), n, 1.0, 0.4, 0.7383, mu, 0.0, math.inf, 0.0
    )
    assert regime in (STICK, SLIDE, JAM)
    assert v[0] * n[0] + v[2] * n[2] > -1e-9
    np.testing.assert_allclose(np.array(v) - (-1.4417, -2.0678, 0.0), np.array(j) + jf, atol=1e-12)
    assert (np.array(v) @ v) + 0.4 * (np.array(w) @ w) < 1.4417**2 + 2.0678**2 + 0.4 * (
        15.251**2 + 14.866**2 + 47.941**2
    )


def test_finite(many):
    for x in many[4:8]:
        assert np.isfinite(x).all()


def test_energy_never_grows(many):
    v, w, _n, p, v1, w1, *_ = many
    kappa = p[:, 0]
    t0, t1 = ((x * x).sum(axis=-1) + kappa * (y * y).sum(axis=-1) for x, y in ((v, w), (v1, w1)))
    bad = t1 > t0 * (1 + STEPS)
    assert not bad.any(), where(bad, many)


def test_leaves_the_wall(many):
    """Afterwards it does not go into the wall, but for a ball wedged between wall and floor.

    It may well come down on the floor: one that was lifted while the wall acted and is on its way back. Where the wall's
    friction is too small to lift it, it stays on the floor.
    """
    v, w, n, p, v1, _w1, _j, _jf, regime = many
    size = speeds(v, w)
    into = ((v1 * n).sum(axis=-1) < -STEPS * size) & (regime != JAM) & (regime != STALL)
    assert not into.any(), where(into, many)
    held = (p[:, 2] == 0) & (n[:, 2] < 0) & ((v[:, 2] == 0) | (p[:, 3] == 0)) & (regime != GRAZE)
    assert held.sum() > 1000
    assert (v1[held, 2] == 0).all(), where(held & (v1[:, 2] != 0), many)


def test_impulses_push_and_stay_in_the_cones(many):
    """The cone at each instant makes the cone of the whole: |G| <= mu N. (Infinite frictions count as none to check.)"""
    v, w, n, p, _v1, _w1, j, jf, _regime = many
    size = speeds(v, w)
    jn = (j * n).sum(axis=-1)
    f = j - jn[:, None] * n
    assert (jn >= -STEPS * size).all(), where(jn < -STEPS * size, many)
    assert (jf[:, 2] >= -STEPS * size).all(), where(jf[:, 2] < -STEPS * size, many)
    for mu, load, push in ((p[:, 2], f, jn), (p[:, 4], jf * [1, 1, 0], jf[:, 2])):
        finite = np.isfinite(mu)
        limit = np.where(finite, mu, 0) * push + STEPS * size * (1 + np.where(finite, mu, 0))
        bad = finite & (np.sqrt((load * load).sum(axis=-1)) > limit)
        assert not bad.any(), where(bad, many)


def test_momentum(many):
    """Impulses at two points: each turns the ball as its own lever says."""
    v, w, n, p, v1, w1, j, jf, _regime = many
    size = speeds(v, w) + np.sqrt((j * j).sum(axis=-1)) + np.sqrt((jf * jf).sum(axis=-1))
    bad = np.abs(v1 - v - j - jf).max(axis=-1) > 1e-12 * size
    assert not bad.any(), where(bad, many)
    turned = np.cross(-n, j) + np.cross([0, 0, -1.0], jf)
    bad = np.abs(p[:, :1] * (w1 - w) - turned).max(axis=-1) > STEPS * size
    assert not bad.any(), where(bad, many)


def test_what_neither_contact_can_change(many):
    """The spin about the line through both contact points: no impulse at either has a lever about it.

    Angular momentum about that line: (k - n) . (r x v + kappa omega) with r from the floor's contact, r = k.
    """
    v, w, n, p, v1, w1, j, jf, _regime = many
    line = np.array([0, 0, 1.0]) - n
    size = speeds(v, w) + np.sqrt((j * j).sum(axis=-1)) + np.sqrt((jf * jf).sum(axis=-1))
    both = [(line * (np.cross([0, 0, 1.0], x) + p[:, :1] * y)).sum(axis=-1) for x, y in ((v, w), (v1, w1))]
    bad = np.abs(both[1] - both[0]) > STEPS * size
    assert not bad.any(), where(bad, many)


def test_smooth_floor_keeps_its_own(many):
    """mu = 0 at the floor: only the wall turns the ball, so what one contact at the wall keeps is kept."""
    v, w, n, p, v1, w1, _j, _jf, _regime = many
    smooth = p[:, 4] == 0
    size = speeds(v, w)
    both = [((x * y).sum(axis=-1) / size)[smooth] for x, y in ((w, n), (w1, n))]
    np.testing.assert_allclose(both[1], both[0], atol=STEPS)  # spin about the wall's normal
    smooth = p[:, 2] == 0
    both = [(floor_invariants(x, y, 1.0, p[:, 0])[:, 2] / size)[smooth] for x, y in ((v, w), (v1, w1))]
    np.testing.assert_allclose(both[1], both[0], atol=STEPS)  # the wall smooth: spin about the vertical


# --- closed forms, by hand: everything in the plane of the wall's normal and the vertical ---------------------------
# n = (c, 0, n_z), v = (-u, 0, 0), spin (0, S, 0) with S > 0 backspin; mass and radius 1. P is the wall's impulse.


def one(u, spin, nz, kappa, e, muw, muf, ef=0.0):
    n = (math.sqrt(1 - nz * nz), 0.0, nz)
    return wall_and_floor((-u, 0.0, 0.0), (0.0, spin, 0.0), n, 1.0, kappa, e, muw, ef, muf, 0.0)


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("kappa", [2 / 5, 2 / 3])
def test_smooth_wall_above_the_centre_smooth_floor(kappa, e):
    """The floor bears n_z: v_x' = e u, and Stronge's e on the energy of the wall's work is Newton's here."""
    v, w, j, jf, _regime = one(1.3, 4.0, -0.28, kappa, e, 0.0, 0.0)
    c, p = 0.96, 1.3 * (1 + e) / 0.96
    np.testing.assert_allclose(v, (e * 1.3, 0, 0), atol=STEPS)
    np.testing.assert_allclose(w, (0, 4.0, 0), atol=STEPS)
    np.testing.assert_allclose(j, (c * p, 0, -0.28 * p), atol=STEPS)
    np.testing.assert_allclose(jf, (0, 0, 0.28 * p), atol=STEPS)


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_smooth_wall_above_the_centre_rough_floor(e):
    """Backspin so large that the floor slides throughout: v_x grows by k = c + mu |n_z| per P, so P = (1 + e) u/k."""
    kappa, u, spin, nz, mu = 2 / 5, 1.0, 20.0, -0.28, 0.3
    k = 0.96 + mu * 0.28
    p = (1 + e) * u / k
    v, w, _j, jf, _regime = one(u, spin, nz, kappa, e, 0.0, mu)
    np.testing.assert_allclose(v, (e * u, 0, 0), atol=STEPS)
    np.testing.assert_allclose(w, (0, spin - mu * 0.28 * p / kappa, 0), atol=STEPS * spin)
    np.testing.assert_allclose(jf, (mu * 0.28 * p, 0, 0.28 * p), atol=STEPS)


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_backspin_on_rough_wall_and_rough_floor(e):
    """Vertical wall, both slide throughout: the wall presses with mu_w P, the floor pushes off with mu_f mu_w P."""
    kappa, u, spin, muw, muf = 2 / 5, 1.0, 30.0, 0.2, 0.4
    p = (1 + e) * u / (1 + muf * muw)
    v, w, j, jf, regime = one(u, spin, 0.0, kappa, e, muw, muf)
    np.testing.assert_allclose(v, (e * u, 0, 0), atol=STEPS)
    np.testing.assert_allclose(w, (0, spin - muw * (1 + muf) * p / kappa, 0), atol=STEPS * spin)
    np.testing.assert_allclose(j, (p, 0, -muw * p), atol=STEPS)
    np.testing.assert_allclose(jf, (muf * muw * p, 0, muw * p), atol=STEPS)
    assert regime == SLIDE


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_sticking_wall_on_a_smooth_floor(e):
    """Backspin dies at a wall that sticks, which presses the floor with all of its momentum; then e u as ever."""
    kappa, u, spin = 2 / 5, 1.0, 3.0
    v, w, j, jf, regime = one(u, spin, 0.0, kappa, e, math.inf, 0.0)
    np.testing.assert_allclose(v, (e * u, 0, 0), atol=STEPS)
    np.testing.assert_allclose(w, (0, 0, 0), atol=STEPS)
    np.testing.assert_allclose(j, ((1 + e) * u, 0, -kappa * spin), atol=STEPS)
    np.testing.assert_allclose(jf, (0, 0, kappa * spin), atol=STEPS)
    assert regime == STICK


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_slip_stick_on_a_smooth_floor(e):
    """Backspin that dies on the way, at P = kappa S/mu; from there on the wall holds and the floor bears nothing."""
    kappa, u, spin, mu = 2 / 5, 1.0, 0.5, 0.8
    v, w, j, jf, regime = one(u, spin, 0.0, kappa, e, mu, 0.0)
    np.testing.assert_allclose(v, (e * u, 0, 0), atol=STEPS)
    np.testing.assert_allclose(w, (0, 0, 0), atol=STEPS)
    np.testing.assert_allclose(j, ((1 + e) * u, 0, -kappa * spin), atol=STEPS)
    np.testing.assert_allclose(jf, (0, 0, kappa * spin), atol=STEPS)
    assert regime == STICK


def test_falling_ball_with_nothing_else():
    """Smooth everything, a vertical wall: the floor's restitution below, the wall's aside, each for itself."""
    v, w, _j, _jf, _regime = wall_and_floor(
        (-1.0, 0.3, -0.5), (1.0, 2.0, 3.0), (1.0, 0.0, 0.0), 1.0, 0.4, 0.7, 0.0, 0.6, 0.0, 0.0
    )
    np.testing.assert_allclose(v, (0.7, 0.3, 0.3), atol=STEPS)
    assert w == (1, 2, 3)


def test_along_the_wall_is_no_impact():
    """u_n = 0: nothing presses, whatever slips and however rough."""
    v, w, j, jf, regime = wall_and_floor(
        (0.0, 1.0, 0.0), (3.0, 2.0, 1.0), (0.8, 0.0, -0.6), 1.0, 0.4, 0.7, math.inf, 0.6, math.inf, 0.0
    )
    assert (v, w, regime) == ((0, 1, 0), (3, 2, 1), GRAZE)
    assert j == jf == (0, 0, 0)


@pytest.mark.parametrize("size", [1e-100, 1e-20, 1e20, 1e100])
def test_no_speed_is_special(size):
    """The same course, rounding apart, from the slowest to the fastest."""
    n, rest = (0.96, 0.0, -0.28), (1.0, 0.4, 0.8, 0.3, 0.5, 0.2, 0.0)
    v, w = (-1.0, 0.5, 0.0), (2.0, 3.0, -1.0)
    plain = wall_and_floor(v, w, n, *rest)
    got = wall_and_floor(tuple(c * size for c in v), tuple(c * size for c in w), n, *rest)
    for x, y in zip(got[:4], plain[:4], strict=True):
        np.testing.assert_allclose(np.array(x) / size, y, atol=1e-7)
    assert got[4] == plain[4]


# --- continuity, symmetry -------------------------------------------------------------------------------------------


def test_symmetries(many):
    """Mirrors that leave the floor, turns about the vertical, scaling: to 1e-6, for states that do not sit on an edge."""
    v, w, n, p, v1, w1, *_, regime = (x[:4000] for x in many)
    size = speeds(v, w)
    r = rotation((0, 0, 1), 0.8).T
    tries = [
        (v @ r, w @ r, n @ r, v1 @ r, w1 @ r),
        (*mirrored(v, w, (0.6, 0.8, 0)), mirrored(n, n, (0.6, 0.8, 0))[0], *mirrored(v1, w1, (0.6, 0.8, 0))),
        (4 * v, 4 * w, n, 4 * v1, 4 * w1),
    ]
    for i, (a, b, m, c, d) in enumerate(tries):
        got_v, got_w, _j, _jf, got = answers(*(np.ascontiguousarray(x) for x in (a, b, m)), p)
        off = np.maximum(np.abs(got_v - c).max(axis=-1), np.abs(got_w - d).max(axis=-1)) / size
        # the few others stand on an edge between two ways to go on (exactly planar scenes, wedges)
        assert (off < (1e-6 if i < 2 else 1e-9)).mean() > 0.99
        assert (got == regime).mean() > 0.99


def test_continuous_where_the_wall_begins_to_press():
    """n_z -> 0 and backspin -> 0 from the pressed side meet the one contact of the two-step law."""
    ball = carom.Ball(1.0, 1.0)
    for surface in (carom.Surface(0.8, 0.3), carom.Surface(0.8, 0.05)):
        lifted = carom.two_step(ball, carom.State((-1, 0.5, 0), (0, -1e-9, 2.0)), surface, carom.Surface(0, 0.2))
        pressed_one = carom.two_step(ball, carom.State((-1, 0.5, 0), (0, 1e-9, 2.0)), surface, carom.Surface(0, 0.2))
        np.testing.assert_allclose(pressed_one.after_wall.velocity, lifted.after_wall.velocity, atol=1e-6)
        np.testing.assert_allclose(pressed_one.after_wall.spin, lifted.after_wall.spin, atol=1e-6)


def test_two_step_of_pressed_balls_says_what_it_is():
    """Through the public verb: impulses of wall and floor, the rolling state by (39), energy."""
    ball = carom.Ball(0.03, 0.2)
    rng = np.random.default_rng(41)
    v = np.stack([-np.abs(rng.normal(size=500)), rng.normal(size=500), np.zeros(500)], axis=-1)
    w = rng.normal(size=(500, 3)) * 40
    states = carom.State(v, w)
    two = carom.two_step(ball, states, carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2), normal=(0.95, 0, -0.3))
    assert (two.wall.regime != "stall").mean() > 0.99
    seen = ~np.isnan(two.after_wall.velocity[:, 0])
    change = 0.2 * (two.after_wall.velocity - v)
    np.testing.assert_allclose((two.wall.impulse + two.floor_impulse)[seen], change[seen], atol=1e-9)
    assert (two.floor_impulse[seen, 2] > 0).all()
    assert (two.wall.energy_lost[seen] > -1e-9).all()
    rolls = two.rolls
    kept = [floor_invariants(s.velocity, s.spin, 0.03, 2 / 5)[rolls] for s in (two.after_wall, two.rolling)]
    np.testing.assert_allclose(kept[1], kept[0], atol=1e-12)


def test_infinite_friction_at_the_floor_is_the_limit_of_large():
    """Strong backspin: the floor throws the ball off the wall before the wall has pushed at all.

    The limit is the velocity at which the floor's slip is gone, (v_x + kappa a omega_y)/(1 + kappa).
    """
    ball = carom.Ball()
    state = carom.State((-1.0, 0.5, 0.0), (-0.5 / ball.radius, 200.0, 0.0))
    limit = (-1 + 0.4 * 200 * ball.radius) / 1.4
    for mu, off in ((1e3, 2e-3), (1e5, 2e-5), (1e7, 2e-7), (math.inf, 1e-9)):
        two = carom.two_step(ball, state, carom.Surface(1.0), carom.Surface(0.0, mu))
        assert abs(two.after_wall.velocity[0] - limit) < off
        assert two.rolls


def test_infinite_frictions_are_the_limit_of_large_ones():
    """Of all courses with an infinite friction: the larger the friction that stands for it, the nearer.

    A few stay apart: they stand where two ways to go on part, or wait longer at an unloaded floor than the limit does.
    """
    v, w, n, p = (x[:COUNT] for x in pressed(np.random.default_rng(43), 2 * COUNT))
    rough = np.isinf(p[:, 2:]).any(axis=1)
    v, w, n, p = v[rough], w[rough], n[rough], p[rough]
    limit = answers(v, w, n, p)
    far = []
    for mu in (1e4, 1e6, 1e8):
        got = answers(v, w, n, np.where(np.isinf(p), mu, p))
        off = np.maximum(np.abs(got[0] - limit[0]).max(axis=-1), np.abs(got[1] - limit[1]).max(axis=-1)) / speeds(v, w)
        far.append([(off > x).mean() for x in (1e-5, 1e-3)])
    assert far[0][0] > 5 * far[2][0]
    assert far[2][0] < 0.015
    assert far[0][1] > 3 * far[1][1] > 6 * far[2][1]
    assert far[2][1] < 1e-3
