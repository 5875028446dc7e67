"""The two-step law (27)-(41): the printed numbers, SymPy, brute force in time, identities, every reason not to roll."""

import math
import random
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from reference import brute_force as brute
from reference.identities import ROUNDING, floor_invariants, mirrored, rotation, size

import carom
from carom.core.motion.phases import rolls_at_last
from carom.laws.landing import second_impact
from carom.laws.two_step import first_impact, two_step_final

BALL = carom.Ball(radius=0.02625, mass=0.1406)
STICKS = (math.inf, 0)


# --- the paper ------------------------------------------------------------------------------------------------------


def test_why_a_ball_comes_back_at_52_degrees():
    """Topspin turns it on the cloth, and the wall's friction takes most of that topspin: docs/faq.md says it with numbers."""
    before = carom.rolling(BALL, (-1.0, 1.0))
    smooth = carom.two_step(BALL, before, wall=carom.Surface(1.0, 0.0))
    rough = carom.two_step(BALL, before, wall=carom.Surface(1.0, math.inf))
    # without friction at the wall: 45 degrees and all the topspin, which the cloth turns into 66.8 degrees
    assert smooth.after_wall.velocity == pytest.approx([1, 1, 0])
    assert smooth.after_wall.spin == pytest.approx(before.spin)
    assert smooth.rolling.velocity[0] == pytest.approx(3 / 7)
    # with a friction that stops the slip 5/7 of the topspin and 2/7 of the velocity along the wall are gone
    assert rough.after_wall.spin[1] == pytest.approx(2 / 7 * before.spin[1])
    assert rough.after_wall.velocity[1] == pytest.approx(5 / 7)
    angles = [math.degrees(two.reflection_angle) for two in (smooth, rough)]
    just_after = math.degrees(math.atan2(*rough.after_wall.velocity[1::-1]))
    page = Path(__file__).parents[2] / "docs" / "faq.md"
    if page.exists():  # (the tests may be run without the docs)
        said = " ".join(page.read_text(encoding="utf-8").split())
        assert f"slow the normal velocity to 3/7 until the ball rolls, at {angles[0]:.1f} degrees" in said
        assert "takes 5/7 of that topspin and 2/7 of the velocity along the wall" in said
        assert f"from {just_after:.1f} degrees just after the wall to {angles[1]:.1f}" in said


@pytest.mark.parametrize(("u0", "v0"), [(Fraction(1), Fraction(1)), (Fraction(3, 7), Fraction(-11, 5))])
def test_example_exactly(u0, v0):
    a, zero, n = Fraction(21, 800), Fraction(0), (Fraction(1), Fraction(0), Fraction(0))
    v, w = (-u0, v0, zero), (-v0 / a, -u0 / a, zero)
    v1, w1, _j, jf, _required, _regime = first_impact(v, w, n, a, Fraction(2, 5), 1, *STICKS, 0, *STICKS, 0, True)
    # (40)
    assert v1 == (u0, Fraction(5, 7) * v0, Fraction(2, 7) * u0)
    assert w1 == (-v0 / a, Fraction(-2, 7) * u0 / a, Fraction(5, 7) * v0 / a)
    assert jf == (0, 0, 0)
    _t, _rise, _far, v2, w2, _j, _required, _regime, v3, w3, why = second_impact(
        v1, w1, n, a, Fraction(2, 5), 0, *STICKS, Fraction(981, 100), 0
    )
    # (41)
    v41 = (Fraction(31, 49) * u0, Fraction(39, 49) * v0, 0)
    w41 = (Fraction(-39, 49) * v0 / a, Fraction(25, 49) * u0 / a, Fraction(5, 7) * v0 / a)
    assert (v3[:2], v3[2], w3[0], w3[2]) == (v41[:2], 0, w41[0], w41[2])
    # The printed 25/49 of omega_y2 contradicts x'_2 = 31/49 u0 and (38); what rolls has 31/49. The misprint:
    assert w3[1] != w41[1]
    assert w3[1] == v3[0] / a == Fraction(31, 49) * u0 / a
    # e = 0 and sticking: it rolls at once (the landing's kernel knows the vertical in floats)
    assert v2 == pytest.approx(tuple(map(float, v3)), rel=ROUNDING)
    assert w2 == pytest.approx(tuple(map(float, w3)), rel=ROUNDING)
    assert why == 0
    assert two_step_final(v, w, n, a, Fraction(2, 5), 1, *STICKS, 0, *STICKS, Fraction(981, 100), 0, True) == (
        v3,
        w3,
        0,
    )


def test_second_impact_for_any_moment_against_sympy():
    """(37) and (38) solved as linear equations; equal at random rational points, as rationals; (39) as printed."""
    sp = pytest.importorskip("sympy")
    m, a, i, x1, y1, wx1, wy1, wz1 = sp.symbols("m a I x1 y1 wx1 wy1 wz1")
    x2, y2, wx2, wy2, wz2 = unknowns = sp.symbols("x2 y2 wx2 wy2 wz2")
    solution = sp.solve(
        [
            i * (wx2 - wx1) - m * a * (y2 - y1), i * (wy2 - wy1) + m * a * (x2 - x1), wz2 - wz1,  # (37)
            x2 - a * wy2, y2 + a * wx2,  # (38)
        ],
        unknowns, dict=True,
    )[0]  # fmt: skip
    assert sp.simplify(solution[x2] - a * (i * wy1 + m * a * x1) / (i + m * a**2)) == 0  # (39)
    assert sp.simplify(solution[y2] - a * (m * a * y1 - i * wx1) / (i + m * a**2)) == 0
    rng = random.Random(3)

    def rational():
        return Fraction(rng.randint(1, 30), rng.randint(1, 30))

    for _ in range(20):
        kappa, av = rational() / 45, rational()
        v1 = (rational(), rational() - rational(), rational())
        w1 = tuple(rational() - rational() for _ in range(3))
        point = dict(zip((m, a, i, x1, y1, wx1, wy1, wz1), (1, av, kappa * av * av, v1[0], v1[1], *w1), strict=True))
        point = {k: sp.Rational(Fraction(q).numerator, Fraction(q).denominator) for k, q in point.items()}
        expected = [Fraction(int(q.p), int(q.q)) for q in (solution[s].subs(point) for s in unknowns)]
        found = second_impact(v1, w1, (1, 0, 0), av, kappa, 0, *STICKS, 10, 0)
        v2, w2 = found[3:5]
        assert [*v2[:2], *w2] == pytest.approx([float(x) for x in expected], rel=10 * ROUNDING)
        assert v2[2] == 0
        v3, w3 = rolls_at_last(v1, w1, av, kappa)
        assert [*v3[:2], *w3] == expected


def test_printed_angle_and_energies():
    hit = carom.two_step(BALL, carom.rolling(BALL, (-1.0, 1.0)))
    assert hit.rolls
    assert hit.why == ""
    assert math.degrees(hit.reflection_angle) == pytest.approx(math.degrees(math.atan(39 / 31)), rel=ROUNDING)
    assert round(math.degrees(hit.reflection_angle), 1) == 51.5
    states = (hit.wall.before, hit.after_wall, hit.after_floor)
    energies = [carom.kinetic_energy(BALL, s) for s in states]
    assert energies == sorted(energies, reverse=True)
    assert hit.wall.energy_lost == pytest.approx(energies[0] - energies[1], rel=1e-13)
    # the vertical energy of 2/7 u0 and the landing's friction; the flight itself loses nothing
    assert hit.floor.energy_lost == pytest.approx(energies[1] - energies[2], rel=1e-12)


@pytest.mark.parametrize("kappa", [2 / 5, 2 / 3, 0.1])
def test_flight(kappa):
    """z'_1 = kappa/(1 + kappa) u0 (31): up and down under gravity."""
    ball = carom.Ball(0.03, 0.2, kappa)
    hit = carom.two_step(ball, carom.rolling(ball, (-2.0, 0.7), 3.0), gravity=1.6)
    up = kappa / (1 + kappa) * 2.0
    assert hit.flight.duration == pytest.approx(2 * up / 1.6, rel=ROUNDING)
    assert hit.flight.height == pytest.approx(up**2 / 3.2, rel=ROUNDING)
    speed = math.hypot(*hit.after_wall.velocity[:2])
    assert hit.flight.distance == pytest.approx(speed * 2 * up / 1.6, rel=ROUNDING)
    # it comes down with -z'_1 and everything else as it was
    np.testing.assert_allclose(hit.floor.before.velocity, hit.after_wall.velocity * [1, 1, -1], rtol=ROUNDING)
    np.testing.assert_array_equal(hit.floor.before.spin, hit.after_wall.spin)


def test_flight_from_a_height():
    state = carom.State((-1.0, 0.0, -0.5), (0, 0, 0))
    hit = carom.two_step(BALL, state, wall=carom.Surface(1, 0), height=0.2, gravity=10.0)
    t = (-0.5 + math.sqrt(0.25 + 4)) / 10
    assert hit.flight.duration == pytest.approx(t, rel=ROUNDING)
    assert hit.flight.height == 0.2
    assert hit.flight.distance == pytest.approx(t, rel=ROUNDING)
    assert hit.floor.before.velocity[2] == pytest.approx(-math.sqrt(0.25 + 4), rel=ROUNDING)


# --- random scenes in which the wall does not press the ball down ---------------------------------------------------


def lifted(rng, count, *, tilted=True):
    """Balls that roll, slide or fly towards a wall that lifts them, or does not push them down (test_simultaneous)."""
    a = 0.03
    angle = rng.uniform(0, 2 * np.pi, count)
    nz = np.where(rng.random(count) < 0.5, 0.0, rng.uniform(0, 0.5, count)) if tilted else np.zeros(count)
    level = np.sqrt(1 - nz**2)
    n = np.stack([level * np.cos(angle), level * np.sin(angle), nz], axis=-1)
    height = np.where(rng.random(count) < 0.6, 0.0, rng.uniform(0, 0.1, count))
    v, w = rng.normal(size=(count, 3)), rng.normal(size=(count, 3)) / a
    v[:, 2] = np.where(height == 0, np.where(rng.random(count) < 0.7, 0.0, np.abs(v[:, 2])), v[:, 2])
    v[(v * n).sum(axis=-1) > 0] *= [-1, -1, 1]
    rolls = (rng.random(count) < 0.5) & (height == 0) & (v[:, 2] == 0)
    w[rolls, 0], w[rolls, 1] = -v[rolls, 1] / a, v[rolls, 0] / a
    slip_z = v[:, 2] - (v * n).sum(axis=-1) * n[:, 2] - a * np.cross(w, n)[:, 2]
    keep = ((v * n).sum(axis=-1) < -1e-3) & ((height > 0) | (v[:, 2] > 0) | (slip_z <= 0))
    return a, v[keep], w[keep], n[keep], height[keep]


def scenes(seed=10, count=4000, *, tilted=True):
    rng = np.random.default_rng(seed)
    a, v, w, n, height = lifted(rng, count, tilted=tilted)
    count = len(v)
    ball = carom.Ball(a, 0.2, rng.choice([2 / 5, 2 / 3, 0.1], count))
    wall = carom.Surface(
        rng.choice([0.02, 0.1, 0.5, 1.0], count),
        rng.choice([0.0, 0.2, 1.0, np.inf], count),
        rng.choice([-1, 0, 0.5, 1], count),
    )
    floor = carom.Surface(
        rng.choice([0.0, 0.5, 0.9], count),
        rng.choice([0.05, 0.2, 1.0, np.inf], count),
        rng.choice([-0.5, 0, 0.6, 1], count),
    )
    return ball, carom.State(v, w), wall, floor, n, height


def part(surface, keep):
    return carom.Surface(*(np.asarray(x)[keep] for x in vars(surface).values()))


@pytest.mark.slow
def test_brute_force_agrees_on_what_happens_and_where_it_ends():
    """Some hundred random scenes stepped in time by 2 us, in code that shares nothing with carom's.

    Near ties are left out: balls that come nearer than 1e-5 m to the wall without passing it by as much. The brute
    force drops the last hops of a few steps of time; what that changes is below 1e-5 of the speeds.
    """
    ball, state, wall, floor, n, height = scenes(count=500)
    firm = np.isfinite(floor.friction)  # infinite friction takes no time: not a thing to step
    ball = carom.Ball(0.03, 0.2, ball.kappa[firm])
    state, wall, floor, n, height = state[firm], part(wall, firm), part(floor, firm), n[firm], height[firm]
    two = carom.two_step(ball, state, wall, floor, n, 9.81, height)
    fill = np.full(len(n), 0.03), ball.kappa
    numbers = (floor.restitution, floor.friction, floor.tangential_restitution, np.full(len(n), 9.81), height)
    rolls, found, v, w = brute.run(two.after_wall.velocity, two.after_wall.spin, n, [*fill, *numbers])
    assert rolls.all()  # through the wall or not
    deepest, in_flight, nearest = found.T
    margin = 1e-5
    meets, clear = deepest < -margin, (deepest > -1e-9) & (nearest > margin)
    assert meets.sum() > 30
    assert clear.sum() > 120
    assert (meets | clear).mean() > 0.97
    assert not two.rolls[meets].any()
    toward = (v[:, :2] * n[:, :2]).sum(axis=-1) / size(v, w, 0.03)
    assert two.rolls[clear & (toward > 1e-5)].all()
    back = np.char.find(two.why, "rolls back to the wall") >= 0
    assert back[clear & (toward < -1e-5)].all()
    assert not back[toward > 1e-5].any()
    assert (clear & (toward < -1e-5)).sum() > 5
    said = np.char.startswith(two.why, "the ball meets the wall again in flight")
    assert said[in_flight < -margin].all()
    assert not said[in_flight > -1e-9].any()
    assert (in_flight < -margin).sum() > 2
    speed = size(state.velocity, state.spin, 0.03)
    assert (np.abs(v - two.rolling.velocity).max(axis=-1) <= 1e-5 * speed)[two.rolls].all()
    assert (np.abs(w - two.rolling.spin).max(axis=-1) * 0.03 <= 1e-5 * speed)[two.rolls].all()


def test_flight_agrees_with_brute_force_on_the_landing():
    """The first landing itself: position by the flight's own numbers, velocity by the floor's impulse."""
    ball, state, wall, floor, n, height = scenes(count=300)
    two = carom.two_step(ball, state, wall, floor, n, 9.81, height)
    flies = np.isfinite(two.flight.duration) & (two.flight.duration > 0)
    assert flies.sum() > 100
    v, t = two.after_wall.velocity[flies], two.flight.duration[flies]
    h = height[flies]
    np.testing.assert_allclose(h + v[:, 2] * t - 9.81 * t**2 / 2, 0, atol=1e-14)
    np.testing.assert_allclose(two.floor.before.velocity[flies, 2], v[:, 2] - 9.81 * t, atol=1e-14)
    np.testing.assert_allclose(two.flight.distance[flies], np.hypot(v[:, 0], v[:, 1]) * t, atol=1e-14)
    top = h + np.maximum(v[:, 2], 0) ** 2 / (2 * 9.81)
    np.testing.assert_allclose(two.flight.height[flies], top, atol=1e-14)
    change = two.floor.after.velocity[flies] - two.floor.before.velocity[flies]
    np.testing.assert_allclose(two.floor.impulse[flies], 0.2 * change, atol=1e-13)


def test_floor_keeps_what_it_must():
    """(37): no impulse at the floor's contact point changes I omega_x - m a y', I omega_y + m a x', I omega_z."""
    ball, state, wall, floor, n, height = scenes()
    two = carom.two_step(ball, state, wall, floor, n, 9.81, height)
    a, kappa = ball.radius, ball.kappa
    kept = floor_invariants(two.after_wall.velocity, two.after_wall.spin, a, kappa)
    for later in (two.after_floor, two.rolling):
        seen = ~np.isnan(later.velocity[:, 0])
        now = floor_invariants(later.velocity, later.spin, a, kappa)
        np.testing.assert_allclose(now[seen], kept[seen], atol=100 * ROUNDING)
    # (38)
    v, w = two.rolling.velocity[two.rolls], two.rolling.spin[two.rolls]
    np.testing.assert_allclose(v, np.stack([a * w[:, 1], -a * w[:, 0], 0 * w[:, 0]], axis=-1), atol=100 * ROUNDING)


def test_energy_goes_down_step_by_step():
    ball, state, wall, floor, n, height = scenes()
    two = carom.two_step(ball, state, wall, floor, n, 9.81, height)
    potential = ball.mass * 9.81 * height
    before, wall_after = (carom.kinetic_energy(ball, s) for s in (state, two.after_wall))
    landed, rolls = (carom.kinetic_energy(ball, s) for s in (two.after_floor, two.rolling))
    assert (wall_after <= before * (1 + ROUNDING)).all()
    seen = ~np.isnan(landed)
    assert (landed <= (wall_after + potential) * (1 + ROUNDING))[seen].all()
    assert (rolls <= landed * (1 + ROUNDING))[two.rolls].all()
    assert (two.wall.energy_lost >= -ROUNDING * before).all()
    assert (two.floor.energy_lost >= -ROUNDING * (before + potential))[seen].all()


def test_rolling_state_does_not_depend_on_how():
    """Exactly: whatever the floor's restitution, friction and tangential restitution, if it rolls it rolls with (39)

    of the state in which it left the wall. Conditions: the floor acts at its contact point only, it has friction, it
    does not return everything (e < 1 where the ball flies), there is gravity, and the wall is not met before.
    """
    ball, state, wall, _floor, n, height = scenes()
    floors = [
        carom.Surface(e, mu, b) for e in (0.0, 0.3, 0.9, 0.99) for mu in (0.01, 0.2, np.inf) for b in (-1.0, 0.0, 0.7)
    ]
    floors += [carom.Surface(0.0, np.inf, 0.0)]
    answers = [carom.two_step(ball, state, wall, f, n, 9.81, height) for f in floors]
    first = answers[-1]
    for two in answers[:-1]:
        both = two.rolls & first.rolls
        assert both.sum() > 1000
        np.testing.assert_array_equal(two.rolling.velocity[both], first.rolling.velocity[both])
        np.testing.assert_array_equal(two.rolling.spin[both], first.rolling.spin[both])
    # gravity neither
    slow = carom.two_step(ball, state, wall, floors[-1], n, 0.5, height)
    both = slow.rolls & first.rolls
    np.testing.assert_array_equal(slow.rolling.velocity[both], first.rolling.velocity[both])


@pytest.mark.parametrize("seed", [11, 12])
def test_symmetries(seed):
    ball, state, wall, floor, n, height = scenes(seed)
    two = carom.two_step(ball, state, wall, floor, n, 9.81, height)
    a = 0.03

    def close(got, v, w):
        # whether it rolls may hang on the last digit: not where friction is infinite and contacts sit at an edge
        same = got.rolls == two.rolls
        assert same.mean() > 0.998
        both = got.rolls & two.rolls
        np.testing.assert_allclose(got.rolling.velocity[both], v[both], atol=1000 * ROUNDING)
        np.testing.assert_allclose(got.rolling.spin[both] * a, w[both] * a, atol=1000 * ROUNDING)

    for m in ([1, 0, 0], [0.6, -0.8, 0]):
        moved = carom.State(*mirrored(state.velocity, state.spin, m))
        got = carom.two_step(ball, moved, wall, floor, mirrored(n, n, m)[0], 9.81, height)
        close(got, *mirrored(two.rolling.velocity, two.rolling.spin, m))
    r = rotation((0, 0, 1), 2.0).T
    got = carom.two_step(ball, carom.State(state.velocity @ r, state.spin @ r), wall, floor, n @ r, 9.81, height)
    close(got, two.rolling.velocity @ r, two.rolling.spin @ r)
    # speeds by 4, so gravity by 16 over the same lengths
    got = carom.two_step(ball, carom.State(state.velocity * 4, state.spin * 4), wall, floor, n, 16 * 9.81, height)
    np.testing.assert_array_equal(got.why, two.why)
    np.testing.assert_array_equal(got.rolling.velocity, two.rolling.velocity * 4)
    np.testing.assert_array_equal(got.flight.duration * 4, two.flight.duration)
    # lengths by 4 at the same velocities, so gravity by 1/4
    larger = carom.Ball(4 * a, 0.2, ball.kappa)
    got = carom.two_step(larger, carom.State(state.velocity, state.spin / 4), wall, floor, n, 9.81 / 4, 4 * height)
    np.testing.assert_array_equal(got.why, two.why)
    np.testing.assert_array_equal(got.rolling.velocity, two.rolling.velocity)
    np.testing.assert_array_equal(got.flight.distance, two.flight.distance * 4)
    # masses by 8
    got = carom.two_step(carom.Ball(a, 1.6, ball.kappa), state, wall, floor, n, 9.81, height)
    np.testing.assert_array_equal(got.rolling.velocity, two.rolling.velocity)
    np.testing.assert_array_equal(got.wall.impulse, two.wall.impulse * 8)
    np.testing.assert_array_equal(got.floor.impulse, two.floor.impulse * 8)


# --- why it does not roll -------------------------------------------------------------------------------------------


ROLLING = carom.rolling(BALL, (-1.0, 1.0))


@pytest.mark.parametrize(
    ("state", "options", "words"),
    [
        (ROLLING, {"gravity": 0.0}, "without gravity"),
        (ROLLING, {"floor": carom.Surface(0, 0)}, "no friction"),
        (ROLLING, {"wall": carom.Surface(1, 0), "floor": carom.Surface(0, 0)}, "no friction"),
        (ROLLING, {"floor": carom.Surface(1, 0.2)}, "bounces for ever"),
        (ROLLING, {"wall": carom.Surface(0.0)}, "before it rolls"),
        (ROLLING, {"wall": carom.Surface(0.05, 0), "floor": carom.Surface(0, 0.1)}, "before it rolls"),
        # a wall that hangs over, below which the ball rises
        (carom.State((-1, 0, 2.0)), {"normal": (1, 0, -0.5), "height": 1.0, "wall": carom.Surface(0.5, 0)}, ""),
        # a wall that leans back, on which the ball hops down
        (carom.State((-1, 0, 0.0)), {"normal": (1, 0, 1), "height": 1.0, "wall": carom.Surface(0.1, 0)}, "in flight"),
    ],
)
def test_reasons(state, options, words):
    two = carom.two_step(BALL, state, **options)
    assert words in two.why
    assert two.rolls == (two.why == "") == (words == "")
    for x in (two.rolling.velocity, two.rolling.spin):
        assert np.isnan(x).all() if words else np.isfinite(x).all()


@pytest.mark.parametrize("mu", [0.05, 1.0])
def test_soft_wall_turns_it_round(mu):
    """A smooth wall gives back e u0, the forward spin brakes that on the floor to (e - kappa)/(1 + kappa) u0 < 0.

    The ball is back at the wall before it rolls if it slows down from e u0 to less than -e u0: e < kappa/(2 + kappa); from
    there to e = kappa it rolls first, and back into the wall.
    """
    edge = 0.4 / 2.4
    for e, words in (
        (0.01, "before it rolls"),
        (edge * 0.999, "before it rolls"),
        (edge * 1.001, "rolls back"),
        (0.399, "rolls back"),
        (0.401, ""),
        (0.5, ""),
    ):
        two = carom.two_step(
            BALL, carom.rolling(BALL, (-1.0, 0.3)), wall=carom.Surface(e, 0), floor=carom.Surface(0, mu)
        )
        assert two.flight.duration == 0
        assert words in two.why
        assert two.rolls == (words == "")
        if two.rolls:
            assert two.rolling.velocity[0] == pytest.approx((e - 0.4) / 1.4, rel=1e-13)


def test_soft_sticking_wall():
    """It hops, lands and rolls at once; a soft wall's ball rolls back: e < kappa^2/(1 + kappa). With e = 0 it never left."""
    edge = 0.4 * 0.4 / 1.4
    for e in (0.05, edge * (1 - 1e-9)):
        two = carom.two_step(BALL, carom.rolling(BALL, (-1.0, 0.3)), wall=carom.Surface(e))
        assert not two.rolls
        assert "rolls back to the wall" in two.why
    for e in (edge * (1 + 1e-9), 0.5, 1.0):
        two = carom.two_step(BALL, carom.rolling(BALL, (-1.0, 0.3)), wall=carom.Surface(e))
        assert two.rolls
        # (31) and (39): x'_2 (1 + kappa) = e u0 - kappa * kappa/(1 + kappa) u0
        assert two.rolling.velocity[0] == pytest.approx((e - 0.4 * 2 / 7) / 1.4, rel=1e-13)
    assert not carom.two_step(BALL, carom.rolling(BALL, (-1.0, 0.3)), wall=carom.Surface(0.0)).rolls


def test_finite_with_each_parameter_at_its_ends():
    """Where it rolls, numbers; where it does not, NaN and a reason; never anything between."""
    rng = np.random.default_rng(13)
    values = {
        "e": [0.0, 1.0], "mu": [0.0, 1e-12, 1e12, np.inf], "beta": [-1.0, 0.0, 1.0],
        "ef": [0.0, 1e-12, 1 - 1e-12, 1.0], "muf": [0.0, 1e-12, 1e12, np.inf], "betaf": [-1.0, 0.0, 1.0],
        "g": [0.0, 1e-100, 9.81, 1e50], "h": [0.0, 1e-100, 1.0, 1e50], "kappa": [1e-9, 2 / 5, 2 / 3],
        "a": [1e-9, 0.03, 1e9],
    }  # fmt: skip
    normals = [(1.0, 0, 0), (0.6, 0.8, 0), (0.6, 0, 0.8), (1e-9, 0, 1.0), (0, 0, 1.0), (1.0, 0, 1e-12)]
    speeds = [0.0, 1e-150, 1e-20, 1.0, 1e50]
    decided = 0
    for _ in range(3000):
        q = {k: float(rng.choice(x)) for k, x in values.items()}
        n = normals[rng.integers(len(normals))]
        x, y, z, p, r, s = rng.choice([-1, 1], 6) * rng.choice(speeds, 6)
        v = (float(x), float(y), float(abs(z) if q["h"] == 0 else z))
        if sum(c * d for c, d in zip(v, n, strict=True)) > 0:
            continue
        # topspin, so that a wall with friction does not press it down (that is another law's test)
        w = (float(p) / q["a"], float(r) / q["a"], float(s) / q["a"])
        un = sum(c * d for c, d in zip(v, n, strict=True))
        slip_z = v[2] - un * n[2] - q["a"] * (w[0] * n[1] - w[1] * n[0])
        if q["h"] == 0 and v[2] <= 0 and slip_z > 0:
            continue
        surfaces = [q[k] for k in ("e", "mu", "beta", "ef", "muf", "betaf")]
        v1, w1, j, jf, required, _regime = first_impact(v, w, n, q["a"], q["kappa"], *surfaces, q["h"], True)
        assert np.isfinite([*v1, *w1, *j, *jf]).all()
        assert required >= 0
        if not 0 < q["ef"] < 1 - 1e-6 and q["ef"] not in (0.0, 1.0):
            continue  # some million bounces in plain Python
        *_t, v3, w3, why = second_impact(v1, w1, n, q["a"], q["kappa"], *surfaces[3:], q["g"], q["h"])
        decided += 1
        assert np.isfinite([*v3, *w3]).all() == (why == 0)
        assert why != 6
    assert decided > 500


def test_turning_the_scene_changes_no_verdict():
    """A wall that returns nothing leaves a ball that moves along it: the sign of a rounding error must not decide."""
    for height in (0.0, 0.1):
        for angle in np.linspace(0, 2 * np.pi, 101):
            c, s = np.cos(angle), np.sin(angle)
            state = carom.State((-c - 0.3 * s, -s + 0.3 * c, 0.0))
            two = carom.two_step(BALL, state, carom.Surface(0, 0), carom.Surface(0.5, 0.2), (c, s, 0), height=height)
            assert two.rolls, (angle, two.why)
            along = carom.impact(BALL, carom.State((-0.3 * s, 0.3 * c, 0.0)), (c, s, 0))
            assert np.abs(along.impulse).max() < 1e-15


def test_a_smooth_wall_without_a_friction_limit_presses_the_ball_on_the_floor():
    """Tangential restitution -1 turns friction off, whatever its coefficient: infinite is as none."""
    ball, state = carom.Ball(), carom.State((-1.0, 0.4, 0.0), (2.0, 3.0, 1.0))
    nose = (0.9, 0.0, -0.3)
    answers = [carom.two_step(ball, state, carom.Surface(0.9, mu, beta), carom.Surface(0.5, 0.2), nose)
               for mu, beta in ((math.inf, -1.0), (0.3, -1.0), (0.0, 0.0))]  # fmt: skip
    for other in answers[:2]:
        np.testing.assert_array_equal(other.after_wall.velocity, answers[2].after_wall.velocity)
        np.testing.assert_array_equal(other.rolling.velocity, answers[2].rolling.velocity)
    many = carom.State(np.tile(state.velocity, (500, 1)), np.tile(state.spin, (500, 1)))
    out = carom.State(np.zeros((500, 3)), np.zeros((500, 3)))
    carom.two_step_into(
        out, np.zeros(500, np.int8), ball, many, carom.Surface(0.9, math.inf, -1.0), carom.Surface(0.5, 0.2), nose
    )
    np.testing.assert_allclose(out.velocity, np.tile(answers[2].rolling.velocity, (500, 1)), rtol=2e-9)
