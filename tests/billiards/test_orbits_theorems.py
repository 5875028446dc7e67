"""What is proved of no-slip billiards, with numbers: docs/theory/no_slip.md has the theorems and their sources."""

import math

import numpy as np
import pytest
from scipy.stats import kstest, kstwo

import carom
from carom import billiards
from carom.billiards.analysis import _ks_distance, _ks_p_value

KAPPAS = (0.2, 0.5, 1.0)


def disc(kappa, radius=1.0):
    return carom.Disc(radius, 1.0, kappa)


# --- the collision ------------------------------------------------------------------------------------------------------------


def test_mirror_and_no_slip_alone_conserve_energy_in_the_plane_not_in_space():
    """A tangential impulse J changes the energy by J u + J^2/2 m_t: two roots in the plane, a circle of them in space."""
    ball, wall = carom.Ball(1.0, 1.0), (1.0, 0.0, 0.0)
    state = carom.State((-1.0, 0.6, 0.3), (0.2, -0.5, 0.4))
    slip, m_t = carom.slip(ball, state, wall)[1:], ball.kappa / (1 + ball.kappa)

    def energy_after(push):
        """What the wall's impulse (2, *push) at the contact point leaves; its normal part reverses the normal velocity."""
        impulse = np.array([2.0, *push])
        spin = np.add(state.spin, np.cross([-1.0, 0.0, 0.0], impulse) / ball.kappa)
        return carom.kinetic_energy(ball, carom.State(np.add(state.velocity, impulse), spin))

    before, along = carom.kinetic_energy(ball, state), slip / np.hypot(*slip)
    # along the slip, as in the plane: one parabola in J, so at most two roots
    pushes = np.linspace(-3.0, 1.0, 9) * m_t * np.hypot(*slip)
    changes = [energy_after(push * along) - before for push in pushes]
    curve = np.polyfit(pushes, changes, 2)
    np.testing.assert_allclose(np.polyval(curve, pushes), changes, atol=1e-14)
    np.testing.assert_allclose(np.sort(np.roots(curve)), [-2 * m_t * np.hypot(*slip), 0.0], atol=1e-13)
    # in space also a wall that is rough in one direction only
    for angle in np.linspace(0, math.pi, 7):
        rough = np.array([math.cos(angle), math.sin(angle)])
        assert energy_after(-2 * m_t * (slip @ rough) * rough) == pytest.approx(before, abs=1e-14)
    both = carom.no_slip(ball, state, wall)
    np.testing.assert_allclose(both.velocity[1:] - np.array(state.velocity[1:]), -2 * m_t * slip, atol=1e-14)


# --- strip and plates ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("g", [0.0, 0.7])
def test_strip_is_bounded_and_by_how_much(kappa, g):
    """Broomhead & Gutkin; with a force along it Chumley, Cook, Cox & Feres. The extent of the bounces is ours, and sharp:

    tau sqrt((1+kappa)/kappa) |(v + g tau/2, sqrt(kappa) (a omega + g tau/(2 kappa)))| just after a bounce below.
    """
    rng = np.random.default_rng(1)
    for width in (1.0, 3.0):
        v, spin = rng.normal(size=(20, 2)), rng.normal(size=20)
        found = billiards.orbit(
            billiards.strip(width, acceleration=g, bounds="surface"),
            (np.zeros(2), v, spin),
            20_000,
            ball=disc(kappa, 0.3),
        )
        low = np.argmax(found.piece == 0, axis=1)  # the first bounce below
        row = np.arange(20)
        u, w = found.velocity[row, low], 0.3 * found.spin[row, low]
        tau = (width - 0.6) / np.abs(u[:, 1])
        size = np.hypot(u[:, 0] + g * tau / 2, math.sqrt(kappa) * (w + g * tau / (2 * kappa)))
        bound = tau * math.sqrt((1 + kappa) / kappa) * size
        drift = billiards.drift(found)
        assert (drift.extent <= bound * (1 + 1e-9)).all()
        # it is taken, up to how densely an orbit fills its ellipse; with kappa = 1 all have period 4
        assert kappa == 1 or (drift.extent >= bound * (1 - 2e-3)).mean() > 0.8
        assert kappa < 1 or g or set(billiards.period(found)) == {4}


def test_plates_are_bounded_both_ways():
    """Two strips in one: x with omega_z, z with omega_x; in any dimension (Chumley, Cook, Cox & Feres, Theorem on plates)."""
    table = billiards.plates(1.0, acceleration=(0.3, -1.0))
    begin = ((0, 0, 0), (0.4, 1.1, -0.2), (0.5, 0.3, -0.6))
    found = billiards.orbit(table, begin, 40_000)
    kappa = 0.4
    low = int(np.argmax(found.piece == 0))
    v, w, tau = found.velocity[low], found.spin[low], 1.0 / 1.1
    for axis, g, turn in ((0, 0.3, w[2]), (2, -1.0, -w[0])):
        size = math.hypot(v[axis] + g * tau / 2, math.sqrt(kappa) * (turn + g * tau / (2 * kappa)))
        bound = tau * math.sqrt((1 + kappa) / kappa) * size
        extent = billiards.drift(found, axis).extent
        assert bound * (1 - 2e-3) < extent <= bound * (1 + 1e-9)
    # the mirror falls instead
    assert billiards.drift(billiards.orbit(table, begin, 2000, law="mirror"), 2).acceleration == pytest.approx(
        -1.0, rel=1e-6
    )


# --- wedge --------------------------------------------------------------------------------------------------------------------


def rotation(angle, kappa):
    """Of the velocity phase by two bounces in a wedge: each is half a turn about an axis, and these lie so far apart."""
    return 2 * math.acos((kappa - math.cos(angle)) / (1 + kappa))


def there_and_back(angle, kappa):
    """The wedge's orbit of period two: straight across, with the spin that turns round at each wall."""
    return (1.0, 0.0), (0.0, 1.0), -math.sin(angle / 2) / kappa


@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("angle", [0.3, 1.0, 2.0, 3.0])
def test_wedge_has_an_elliptic_orbit_of_period_two(angle, kappa):
    """Cox, Feres & Zhang: every corner below pi has one. Its multipliers are 1, 1 and exp(+-i rotation)."""
    table, begin, ball = billiards.wedge(math.degrees(angle)), there_and_back(angle, kappa), disc(kappa)
    assert billiards.period(billiards.orbit(table, begin, 200, ball=ball)) == 2
    found = billiards.tangent_map(table, begin, 2, ball=ball)
    assert found.gap < 1e-12
    np.testing.assert_allclose(np.abs(found.eigenvalues), 1.0, atol=1e-7)
    turn = rotation(angle, kappa)
    np.testing.assert_allclose(
        np.sort(np.cos(np.angle(found.eigenvalues))), np.sort([1, 1, *[math.cos(turn)] * 2]), atol=1e-7
    )
    # and what starts near it stays near, for good
    rng = np.random.default_rng(2)
    near = (np.add(begin[0], 1e-4 * rng.normal(size=(20, 2))), begin[1] + 1e-4 * rng.normal(size=(20, 2)), begin[2])
    many = billiards.orbit(table, near, 20_000, ball=ball)
    assert (many.count == 20_000).all()
    assert np.abs(many.position[:, 2:, 0] - 1).max() < 0.02
    # that half is not all: seen from the first bounces it is as wide as it ever gets
    assert (np.ptp(many.position[..., 0], axis=1) < 1.2 * np.ptp(many.position[:, :2000, 0], axis=1) + 1e-12).all()


@pytest.mark.parametrize("n", [2, 3, 4, 5])
def test_wedge_periods(n):
    """Ahmed, Cox & Wang: for a wedge of angle 2 phi, phi <= pi/8, some kappa makes all that stays periodic, 2n bounces.

    From the rotation: kappa = (cos angle + cos(pi m/n))/(1 - cos(pi m/n)).
    """
    angle = 0.5
    m = {2: 1, 3: 2, 4: 3, 5: 3}[n]
    cos = math.cos(math.pi * m / n)
    kappa = (math.cos(angle) + cos) / (1 - cos)
    assert 0 < kappa <= 1
    begin = there_and_back(angle, kappa)
    rng = np.random.default_rng(3)
    start = (begin[0], begin[1] + 0.1 * rng.normal(size=(50, 2)), begin[2] + 0.1 * rng.normal(size=50))
    found = billiards.orbit(billiards.wedge(math.degrees(angle)), start, 400, ball=disc(kappa))
    stays = found.count == 400
    assert stays.sum() > 25
    periods = billiards.period(
        billiards.orbit(
            billiards.wedge(math.degrees(angle)), (start[0], start[1][stays], start[2][stays]), 400, ball=disc(kappa)
        )
    )
    assert set(periods) == {2 * n}


@pytest.mark.parametrize("angle", [0.6, 0.75])
def test_least_period_12_needs_a_narrower_wedge(angle):
    """For pi/6 < angle <= pi/4 the least period 12 needs kappa > 1; up to 1, what comes back after 12 bounces has 4 or 6."""
    least = {}
    for m in range(1, 6):
        cos = math.cos(math.pi * m / 6)
        kappa = (math.cos(angle) + cos) / (1 - cos)
        if kappa <= 0:
            continue
        begin = there_and_back(angle, kappa)
        start = (begin[0], np.add(begin[1], [[0.01, 0.02]]), [begin[2] + 0.01])
        least[m] = billiards.period(
            billiards.orbit(billiards.wedge(math.degrees(angle)), start, 400, ball=disc(kappa))
        )[0]
    assert least == {1: 12, 2: 6, 3: 4, 4: 6}


@pytest.mark.parametrize("kappa", KAPPAS)
def test_only_the_orbit_straight_across_a_wedge_is_periodic_where_the_rotation_is_irrational(kappa):
    """r |x_2| is conserved, so the distance from the corner returns with the velocity, and not otherwise."""
    angle = 1.0
    begin = there_and_back(angle, kappa)
    start = (begin[0], np.add(begin[1], [[0, 0], [0.01, 0.02]]), np.add(begin[2], [0, 0.01]))
    found = billiards.orbit(billiards.wedge(math.degrees(angle)), start, 5_000, ball=disc(kappa))
    assert billiards.period(found).tolist() == [2, 0]
    p, v = found.position[1, 1:], found.velocity[1, 1:]
    momentum = np.abs(p[:, 0] * v[:, 1] - p[:, 1] * v[:, 0])
    assert np.ptp(momentum) < 1e-10 * momentum[0]


# --- circle -------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kappa", KAPPAS)
@pytest.mark.parametrize("bounds", ["centre", "surface"])
def test_circle_has_two_caustics(kappa, bounds):
    """Flights touch two concentric circles in turn; with x0, x1 the velocity phase after a bounce, R the centre's circle, the

    radii are R |x1|/sqrt(1 - x0^2) for x1 and for x1' = -sin b x0 + cos b x1, cos b = (1 - kappa)/(1 + kappa).
    """
    table = billiards.circle(1.5, bounds=bounds)
    begin = billiards.starts(table, 200, 6, ball=disc(kappa, 0.2))
    found = billiards.orbit(table, begin, 1000, ball=disc(kappa, 0.2))
    caustics = billiards.caustics(found)
    assert caustics.scatter.max() < 1e-11
    big = 1.3 if bounds == "surface" else 1.5
    x0, x1 = found.phase[:, 0, 0], found.phase[:, 0, 1]
    cos, sin = (1 - kappa) / (1 + kappa), 2 * math.sqrt(kappa) / (1 + kappa)
    # (spin and velocity along the wall are counted so that the slip is v - a omega where the ball is on the left)
    sign = -1 if abs(-cos * x0[0] - sin * x1[0] - found.phase[0, 1, 0]) < 1e-9 else 1
    y0, y1 = -cos * x0 + sign * sin * x1, sign * sin * x0 + cos * x1
    np.testing.assert_allclose(found.phase[:, 1], np.stack([y0, y1], axis=-1), atol=1e-12)
    expected = big * np.abs(np.stack([x1 / np.sqrt(1 - x0**2), y1 / np.sqrt(1 - y0**2)], axis=-1))
    np.testing.assert_allclose(caustics.radii, expected, atol=1e-12)
    # the phase comes back after two bounces, and no exponent is there
    np.testing.assert_allclose(found.phase[:, 2:], found.phase[:, :-2], atol=1e-11)


# --- polygons -----------------------------------------------------------------------------------------------------------------

PUBLISHED = {  # arXiv:2111.07397 and its first author's page: kappa for which all orbits of a regular polygon are periodic
    3: (0.5, {4, 6}),
    4: (1.0, {4, 6, 8, 10, 12}),
    5: ((3 - math.sqrt(5)) / 2, {6, 8, 10, 14, 20, 30, 40}),
}


@pytest.mark.parametrize("sides", PUBLISHED)
def test_regular_polygons_with_periodic_orbits_only(sides):
    kappa, periods = PUBLISHED[sides]
    table, ball = billiards.regular(sides), disc(kappa)
    found = billiards.orbit(table, billiards.starts(table, 2000, 3, ball=ball), 240, ball=ball)
    seen = set(np.unique(billiards.period(found)).tolist())
    # (the pentagon has one more period than the list: 18)
    assert seen == periods | ({18} if sides == 5 else set())
    # with another moment of inertia hardly any is periodic
    other = disc(0.9 * kappa)
    found = billiards.orbit(table, billiards.starts(table, 200, 3, ball=other), 240, ball=other)
    assert (billiards.period(found) == 0).mean() > 0.9


@pytest.mark.parametrize(("sides", "elements"), [(3, 4), (4, 24), (5, 60)])
def test_velocities_of_these_polygons_are_finitely_many(sides, elements):
    """The half turns of their sides generate Klein's four-group, the rotations of an octahedron and of an icosahedron."""
    kappa, _ = PUBLISHED[sides]
    b = math.acos((1 - kappa) / (1 + kappa))
    turns = 2 * np.pi * np.arange(sides) / sides
    axes = np.stack(
        [np.full(sides, -math.sin(b / 2)), math.cos(b / 2) * np.cos(turns), math.cos(b / 2) * np.sin(turns)], axis=1
    )
    half_turns = [2 * np.outer(a, a) - np.eye(3) for a in axes]
    group, new = [np.eye(3)], [np.eye(3)]
    while new and len(group) <= elements:
        products = [h @ g for g in new for h in half_turns]
        new = []
        for m in products:
            if np.min(np.abs(np.array(group) - m).max(axis=(1, 2))) > 1e-9:
                group.append(m)
                new.append(m)
    assert len(group) == elements
    # so an orbit has at most so many velocities with spins, and some orbits of the triangle have them all
    table, ball = billiards.regular(sides), disc(kappa)
    found = billiards.orbit(table, billiards.starts(table, 20, 5, ball=ball), 240, ball=ball)
    states = np.concatenate([found.velocity, found.spin[..., None]], axis=2).round(9)
    counts = [len(np.unique(one, axis=0)) for one in states]
    assert max(counts) <= elements
    assert sides != 3 or max(counts) == elements


def test_the_pentagons_period_18_is_no_accident():
    """All neighbours of such an orbit have the period too: 18 bounces are the identity, to first order and beyond."""
    kappa, _ = PUBLISHED[5]
    table, ball = billiards.regular(5), disc(kappa)
    begin = billiards.starts(table, 2000, 3, ball=ball)
    found = billiards.orbit(table, begin, 240, ball=ball)
    k = int(np.argmax(billiards.period(found) == 18))
    one = tuple(np.asarray(a)[k] for a in (begin.position, begin.velocity, begin.spin))
    np.testing.assert_allclose(billiards.tangent_map(table, one, 18, ball=ball).matrix, np.eye(4), atol=1e-12)
    rng = np.random.default_rng(4)
    inward = one[1] / np.linalg.norm(one[1])
    near = (one[0] + 1e-3 * inward, one[1] + 1e-4 * rng.normal(size=(30, 2)), one[2] + 1e-4 * rng.normal(size=30))
    assert set(billiards.period(billiards.orbit(table, near, 240, ball=ball))) == {18}


@pytest.mark.parametrize("vertices", [[(0, 0), (2, 0), (0.4, 1.1)], [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]])
def test_polygons_are_not_ergodic(vertices):
    """Cox, Feres & Zhang: about the orbits of period two in their corners they have open sets that stay as they are."""
    table = billiards.polygon(vertices)
    p = np.array(vertices, float)
    before, after = p[-1] - p[0], p[1] - p[0]
    before, after = before / np.linalg.norm(before), after / np.linalg.norm(after)
    angle = math.acos(before @ after)
    bisector = (before + after) / np.linalg.norm(before + after)
    across = np.array([-bisector[1], bisector[0]])
    begin = (p[0] + 0.3 * bisector, across, -math.sin(angle / 2) / 0.5)
    assert billiards.period(billiards.orbit(table, begin, 100)) == 2
    rng = np.random.default_rng(5)
    near = (begin[0] + 0.005 * rng.normal(size=(50, 2)), begin[1] + 0.005 * rng.normal(size=(50, 2)), begin[2])
    state, _t, count, _ending = billiards.final(table, near, 100_000)
    assert (count == 100_000).all()
    found = billiards.orbit(table, near, 2000)
    assert len(np.unique(found.piece[:, 100:])) == 2  # never another side
    assert np.linalg.norm(state.position - p[0], axis=-1).max() < 0.6


# --- Sinai --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kappa", [*KAPPAS, 1e-3])
def test_sinai_threshold(kappa):
    """The orbit to and fro between two neighbouring scatterers, a gap L apart, is elliptic where L/R < 2 kappa (ours; that

    there is a threshold: Wojtkowski; Cox, Feres & Zhang). In the unit torus: R > 1/(2 + 2 kappa). One bounce has the
    multipliers -1 and a pair whose sum is -2 cos b - (1 + cos b) L/R.
    """
    edge = 1 / (2 + 2 * kappa)
    for factor in (0.99, 1.0 - 1e-4, 1.0 + 1e-4, 1.01):
        radius = factor * edge
        if radius >= 0.5:
            continue
        one = billiards.tangent_map(billiards.sinai(radius), ((0.5, 0.0), (1.0, 0.0), 0.0), 1, ball=disc(kappa))
        two = billiards.tangent_map(billiards.sinai(radius), ((0.5, 0.0), (1.0, 0.0), 0.0), 2, ball=disc(kappa))
        cos = (1 - kappa) / (1 + kappa)
        pair = -2 * cos - (1 + cos) * (1 - 2 * radius) / radius
        # the energy's own direction scales with it: 1
        assert np.trace(one.matrix) == pytest.approx(pair - 1 + 1, rel=1e-12)
        largest = np.abs(two.eigenvalues).max()
        assert (largest > 1 + 1e-3) == (factor < 1)
        if factor > 1:
            assert largest == pytest.approx(1.0, abs=1e-6)


# --- cylinders ----------------------------------------------------------------------------------------------------------------


def longitudinal(kappa, found):
    """The maps of (v_z, spin along the wall, spin across) by a bounce, from the angles and times of an orbit's flights."""
    cos, sin = (1 - kappa) / (1 + kappa), 2 * math.sqrt(kappa) / (1 + kappa)
    bounce = np.array([[cos, -sin, 0], [-sin, -cos, 0], [0, 0, 1]])
    angle = np.diff(np.unwrap(np.arctan2(found.position[:, 1], found.position[:, 0])))
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.zeros_like(c), np.ones_like(c)
    turns = np.moveaxis(np.array([[one, zero, zero], [zero, c, -s], [zero, s, c]]), -1, 0)
    return bounce @ turns, bounce[:, 0], np.diff(found.t), angle


def test_fall_in_a_cylinder_is_bounded_for_transversal_rolling_impact():
    """Chumley, Cook, Cox & Feres: if the contact point does not slip across the axis the ball does not fall; else it does.

    And how: with transversal rolling all chords have one angle alpha, and the height swings by psi a bounce,
    sin(psi/2) = sqrt(kappa/(1 + kappa)) sin(alpha/2): for small alpha the rolling ball's sqrt(2/7) swings a turn.
    """
    g, kappa, radius = 9.81, 0.4, 0.5
    table = billiards.cylinder(2.0, acceleration=-g)
    ball = carom.Ball(radius, 1.0)
    for angle in (0.05, 1.0, 2.0):
        # from (2, 0) along a chord; rolling: v_t = a omega_z where the ball has the wall on its right
        v = 3.0 * np.array([-math.sin(angle / 2), math.cos(angle / 2), 0.0])
        spin = (0.3, -0.2, -v[1] / radius)
        found = billiards.orbit(table, ((2.0, 0.0, 0.0), v, spin), 20_000, ball=ball)
        drift = billiards.drift(found)
        assert drift.growth == pytest.approx(1.0, abs=1e-3)
        assert abs(drift.acceleration) < 1e-4
        maps, _first, times, angles = longitudinal(kappa, found)
        np.testing.assert_allclose(angles, angle, rtol=1e-9)
        turn = 2 * math.asin(math.sqrt(kappa / (1 + kappa)) * math.sin(angle / 2))
        np.testing.assert_allclose(
            np.sort_complex(np.linalg.eigvals(maps[0])),
            np.sort_complex([-1, np.exp(1j * turn), np.exp(-1j * turn)]), atol=1e-9,
        )  # fmt: skip
        # heights: a constant, (-1)^n and cos(n psi + phase) say it all
        n = np.arange(20_000)
        basis = np.stack([np.ones(20_000), (-1.0) ** n, np.cos(n * turn), np.sin(n * turn)], axis=1)
        z = found.position[:, 2]
        left = z - basis @ np.linalg.lstsq(basis, z, rcond=None)[0]
        assert np.abs(left).max() < 1e-6 * np.ptp(z)
        assert times == pytest.approx(times[0], rel=1e-9)
    assert math.sqrt(kappa / (1 + kappa)) == pytest.approx(math.sqrt(2 / 7))

    # slip across the axis: it falls, with the acceleration that the two bounces' axis leaves over
    for slip in (0.3, -0.8):
        v = np.array([-1.0, 1.5, 0.0])
        found = billiards.orbit(table, ((2.0, 0.0, 0.0), v, (0.3, -0.2, -(v[1] + slip) / radius)), 40_000, ball=ball)
        maps, first, times, _angles = longitudinal(kappa, found)
        two = maps[1] @ maps[0]
        push = -g * (maps[1] @ first * times[0] + first * times[1])
        values, axes = np.linalg.eig(two)
        axis = np.real(axes[:, np.argmin(np.abs(values - 1))])
        # what the axis gains in two bounces, times what it carries along z over the two flights
        expected = (axis @ push) * (axis[0] * times[0] + (maps[0] @ axis)[0] * times[1]) / (times[0] + times[1]) ** 2
        assert expected < -1e-3 * g
        assert billiards.drift(found).acceleration == pytest.approx(expected, rel=1e-4)
        assert billiards.drift(found).growth == pytest.approx(4.0, rel=0.05)


def test_drift_along_a_cylinder():
    """Chumley, Cook, Cox & Feres: over a transverse orbit of period two the ball drifts, without any force.

    The linear drift from the axis of its two bounces, for the wedge's orbit in a triangle.
    """
    kappa = 0.4
    section = billiards.regular(3)
    table, ball = billiards.cylinder(section), carom.Ball(1.0, 1.0)
    angle = math.pi / 3
    spin = -math.sin(angle / 2) / kappa
    # across the corner at the top, 0.3 below it
    begin = ((0.0, 0.7, 0.0), (1.0, 0.0, 0.2), (0.4, -0.3, spin))
    flat = billiards.orbit(section, (begin[0][:2], begin[1][:2], spin), 40, ball=disc(kappa))
    if billiards.period(flat) != 2:
        spin = -spin
        begin = (begin[0], begin[1], (0.4, -0.3, spin))
        flat = billiards.orbit(section, (begin[0][:2], begin[1][:2], spin), 40, ball=disc(kappa))
    assert billiards.period(flat) == 2
    found = billiards.orbit(table, begin, 40_000, ball=ball)
    cos, sin = (1 - kappa) / (1 + kappa), 2 * math.sqrt(kappa) / (1 + kappa)
    maps = []
    for k in (1, 2):  # (v_z, spin_x, spin_y): a reflection in the plane of v_z and the spin along the wall
        n = found.normal[k]
        e = np.array([[1, 0, 0], [0, -n[1], n[0]], [0, n[0], n[1]]])
        maps.append(e.T @ np.array([[cos, -sin, 0], [-sin, -cos, 0], [0, 0, 1]]) @ e)
    state = np.array([found.velocity[0, 2], *(math.sqrt(kappa) * found.spin[0, :2])])
    values, axes = np.linalg.eig(maps[1] @ maps[0])
    axis = np.real(axes[:, np.argmin(np.abs(values - 1))])
    kept = axis * (axis @ state)
    times = np.diff(found.t)[:2]
    expected = (kept[0] * times[0] + (maps[0] @ kept)[0] * times[1]) / times.sum()
    assert abs(expected) > 1e-2
    assert billiards.drift(found).velocity == pytest.approx(expected, rel=1e-3)
    assert billiards.drift(found).growth == pytest.approx(2.0, rel=1e-2)


# --- measure and reversal -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", ["no-slip", "mirror", "rolling"])
@pytest.mark.slow(keep=1)
def test_the_measure_is_kept(law):
    ball = carom.Ball(0.1, 1.0)
    for table in (billiards.stadium(), billiards.ellipse(bounds="surface"), billiards.regular(5), billiards.sinai()):
        found = billiards.uniformity(table, 20_000, 30, seed=2, ball=ball, law=law)
        assert found.orbits == 20_000
        assert min(found.p.values()) > 1e-3
        assert max(found.distance.values()) < 0.015
    if law != "rolling":
        for table in (billiards.sphere(), billiards.box((1, 2, 3)), billiards.cylinder(billiards.stadium(), 2.0)):
            found = billiards.uniformity(table, 20_000, 30, seed=2, law=law)
            assert min(found.p.values()) > 1e-3
            assert max(found.distance.values()) < 0.02
    # a law that does not keep it is found out
    rough = billiards.uniformity(
        billiards.stadium(), 20_000, 30, law="contact", surface=carom.Surface(1.0, math.inf, 0.5)
    )
    assert rough.p["radius"] < 1e-9


@pytest.mark.parametrize("n", [10, 30, 100, 1000])
def test_chances_of_a_distance_from_uniform_are_those_of_kolmogorov_and_smirnov(n):
    # Stephens's correction is good to 4 % at worst
    for chance in (0.5, 0.1, 0.01):
        assert _ks_p_value(float(kstwo.isf(chance, n)), n) == pytest.approx(chance, rel=0.045)
    assert _ks_p_value(0.0, n) == 1.0
    sample = np.sort(np.random.default_rng(n).random(n))
    assert _ks_distance(sample) == pytest.approx(kstest(sample, "uniform").statistic, rel=1e-14)


def test_reversal_where_nothing_is_chaotic():
    """A thousand bounces back through a circle, a triangle, a strip: the error grows as their number, not faster."""
    for table in (
        billiards.circle(),
        billiards.regular(3),
        billiards.strip(acceleration=0.5),
        billiards.cylinder(acceleration=-1.0),
    ):
        d = table.dimension
        begin = ((0.1, 0.2, 0.0)[:d], (0.7, 0.4, 0.2)[:d], 0.9 if d == 2 else (0.1, 0.2, 0.9))
        found = billiards.orbit(table, begin, 1000)
        _back, error = billiards.reverse(found)
        assert error.max() < 1e-11 * (1 + np.abs(found.position).max())


# --- the rolling ball's billiard --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "table", [billiards.circle(), billiards.ellipse(1.0, 0.9), billiards.regular(3), billiards.strip()]
)
def test_rolling_reflection_is_a_no_slip_billiard(table):
    """Ours: a ball that rolls on the floor and is reflected nonholonomically goes where a no-slip disc in flight goes whose

    kappa is kappa/(1 + kappa), with the same spin: 2/7 for a solid ball.
    """
    for kappa in (0.4, 2 / 3, 0.1):
        begin = ((0.1, 0.2), (0.7, -0.4), 0.9)
        rolls = billiards.orbit(table, begin, 200, law="rolling", ball=carom.Ball(1.0, 1.0, kappa))
        flies = billiards.orbit(table, begin, 200, ball=disc(kappa / (1 + kappa)))
        np.testing.assert_allclose(rolls.position, flies.position, atol=1e-9)
        np.testing.assert_allclose(rolls.spin, flies.spin, atol=1e-9)


def test_nonholonomic_billiard_in_an_ellipse_is_not_integrable():
    """Borisov, Kilin & Mamaev (2011): some orbits part exponentially; in the circle none does."""
    ball = carom.Ball(1.0, 1.0)
    table = billiards.ellipse(1.0, 0.6)
    found = billiards.lyapunov(
        table, billiards.starts(table, 40, 1, ball=ball, law="rolling"), 20_000, law="rolling", ball=ball
    )
    assert found.per_bounce[:, 0].max() > 0.03
    assert found.per_bounce[:, 0].max() > 10 * found.error[found.per_bounce[:, 0].argmax(), 0]
    circle = billiards.circle()
    still = billiards.lyapunov(
        circle, billiards.starts(circle, 40, 1, ball=ball, law="rolling"), 20_000, law="rolling", ball=ball
    )
    assert still.per_bounce[:, 0].max() < 2e-3
