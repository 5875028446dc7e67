"""Euler angles of the rolling ball: (1) to (6) against each other and SymPy, the integrals (8) to (11) followed in time."""

import math

import numpy as np
import pytest
from reference.identities import ROUNDING
from scipy.integrate import solve_ivp

import carom
from carom.derive import euler

# The paper's attitude at the moment of collision: theta = pi/2, phi = psi = 0.
PAPER = np.array([math.pi / 2, 0.0, 0.0])
BALL = carom.Ball(0.03, 0.2)


def attitudes(count=2000):
    rng = np.random.default_rng(70)
    angles = rng.uniform(-math.pi, math.pi, size=(count, 3))
    angles[:, 0] = rng.uniform(0.05, math.pi - 0.05, count)  # away from sin theta = 0, where 1/sin multiplies rounding
    return angles, rng.normal(size=(count, 3))


def test_there_and_back():
    angles, rates = attitudes()
    spin = euler.angular_velocity(angles, rates)
    # 1/sin(theta) up to 20, twice
    np.testing.assert_allclose(euler.euler_rates(angles, spin), rates, atol=400 * ROUNDING)
    back = euler.angular_velocity(angles, euler.euler_rates(angles, rates))
    np.testing.assert_allclose(back, rates, atol=400 * ROUNDING)


def test_angular_velocity_from_rotation_matrices():
    """(1) from R' R^T with R = Rz(psi) Rx(theta) Rz(phi): psi turns the node line, phi the body."""
    sp = pytest.importorskip("sympy")
    t = sp.symbols("t")
    th, ph, ps = (sp.Function(name)(t) for name in ("theta", "phi", "psi"))

    def rz(x):
        return sp.Matrix([[sp.cos(x), -sp.sin(x), 0], [sp.sin(x), sp.cos(x), 0], [0, 0, 1]])

    def rx(x):
        return sp.Matrix([[1, 0, 0], [0, sp.cos(x), -sp.sin(x)], [0, sp.sin(x), sp.cos(x)]])

    r = rz(ps) * rx(th) * rz(ph)
    big = r.diff(t) * r.T
    spin = [big[2, 1], big[0, 2], big[1, 0]]
    rng = np.random.default_rng(71)
    for angles, rates in zip(rng.normal(size=(5, 3)), rng.normal(size=(5, 3)), strict=True):
        point = {f.diff(t): x for f, x in zip((th, ph, ps), rates, strict=True)}
        values = dict(zip((th, ph, ps), angles, strict=True))
        expected = [float(x.subs(point).subs(values)) for x in spin]
        np.testing.assert_allclose(euler.angular_velocity(angles, rates), expected, atol=10 * ROUNDING)


def test_at_the_papers_attitude():
    """omega = (theta', -phi', psi')."""
    np.testing.assert_allclose(euler.angular_velocity(PAPER, (1.0, 2.0, 3.0)), (1, -2, 3), atol=ROUNDING)
    np.testing.assert_allclose(euler.euler_rates(PAPER, (1.0, -2.0, 3.0)), (1, 2, 3), atol=ROUNDING)


def test_rolling_constraints():
    """(2) is (27): a rolling ball's velocity from its spin; then (20) is (3)."""
    angles, rates = attitudes()
    v, w = euler.rolling_velocity(BALL, angles, rates), euler.angular_velocity(angles, rates)
    state = carom.State(v, w / BALL.radius * BALL.radius)
    np.testing.assert_allclose(carom.slip(BALL, state), 0, atol=ROUNDING)
    rolls = carom.rolling(BALL, v[:, :2], w[:, 2])
    np.testing.assert_allclose(rolls.spin, w, atol=100 * ROUNDING)
    energy = euler.kinetic_energy_rolling(BALL, angles, rates)
    np.testing.assert_allclose(energy, carom.kinetic_energy(BALL, carom.State(v, w)), rtol=100 * ROUNDING)
    # (2) in its own letters
    th, _ph, ps = angles.T
    dth, dph, _dps = rates.T
    a = BALL.radius
    np.testing.assert_allclose(v[:, 0], a * (dth * np.sin(ps) - dph * np.sin(th) * np.cos(ps)), atol=ROUNDING)
    np.testing.assert_allclose(v[:, 1], -a * (dth * np.cos(ps) + dph * np.sin(th) * np.sin(ps)), atol=ROUNDING)


def test_wall_constraint_is_no_slip_at_the_wall():
    """(5) from (4): V_B = V_C + omega x CB with CB = (-a, 0, 0), divided by a; all three parts vanish with these two."""
    angles, rates = attitudes()
    v, w = euler.rolling_velocity(BALL, angles, rates), euler.angular_velocity(angles, rates)
    a = BALL.radius
    vb = v + np.cross(w, [-a, 0, 0])
    left = euler.wall_constraint(angles, rates)
    np.testing.assert_allclose(vb[:, 0], a * left[:, 0], atol=ROUNDING)
    np.testing.assert_allclose(vb[:, 1], -a * left[:, 1], atol=ROUNDING)
    np.testing.assert_allclose(vb[:, 2], vb[:, 0], atol=ROUNDING)


def test_wall_rates_solve_the_constraints():
    angles, _rates = attitudes()
    angles[:100, 2] = 0.0  # the singular attitude of (6), which is the paper's own
    angles[100:200, 2] = math.pi
    angles[200] = PAPER
    rates = euler.wall_rates(angles, 3.0)
    np.testing.assert_allclose(euler.wall_constraint(angles, rates), 0, atol=400 * ROUNDING)
    spin = euler.angular_velocity(angles, rates)
    # a turn about the line through both contact points, (1, 0, -1)
    np.testing.assert_allclose(spin, 3 / math.sqrt(2) * np.array([[1, 0, -1]] * len(angles)), atol=400 * ROUNDING)
    # (6), where it can be divided by sin psi
    plain = np.abs(np.sin(angles[:, 2])) > 0.1
    th, _ph, ps = angles[plain].T
    dth, dph, dps = rates[plain].T
    np.testing.assert_allclose(dps, -dph * (np.sin(th) / np.sin(ps) + np.cos(th)), atol=1e-11)
    np.testing.assert_allclose(dth, dph * np.sin(th) / np.tan(ps), atol=1e-11)
    # and at psi = 0 it stands still in phi, as (6) read backwards says
    assert euler.wall_rates(PAPER)[1] == pytest.approx(0, abs=ROUNDING)
    assert euler.wall_rates(PAPER)[0] == pytest.approx(1 / math.sqrt(2), rel=ROUNDING)


def follow(start, until, speed=1.0):
    """Angles at 200 times, by SciPy; its tolerance of 1e-12 a step leaves 1e-9 after some hundred."""
    times = np.linspace(0, until, 200)
    out = solve_ivp(
        lambda _t, y: euler.wall_rates(y, speed),
        (0, until),
        start,
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
        method="DOP853",
    )
    assert out.success
    return out.y.T


def test_first_integral():
    """(8): sin psi sin theta - cos theta is kept, from any attitude, through psi = 0 too."""
    rng = np.random.default_rng(72)
    for _ in range(10):
        start = np.array([rng.uniform(0.7, 2.4), rng.uniform(-3, 3), rng.uniform(-0.6, 0.6)])
        for until in (0.5, -0.5):
            path = follow(start, until)
            c = euler.psi_integral(path)
            np.testing.assert_allclose(c, c[0], atol=1e-9)


def test_integrals_through_the_papers_attitude():
    """(9) and (11) followed back and forth through psi = 0: c = 0 and d = pi/4 stay, where 2 sin^2 theta > 1."""
    assert euler.psi_integral(PAPER) == pytest.approx(0, abs=ROUNDING)
    assert euler.phi_integral(PAPER) == pytest.approx(math.pi / 4, rel=ROUNDING)
    for until in (0.9, -0.9):
        path = follow(PAPER, until)
        theta, phi, psi = path.T
        inside = 2 * np.sin(theta) ** 2 > 1
        assert inside.all()
        np.testing.assert_allclose(np.sin(psi), np.cos(theta) / np.sin(theta), atol=1e-9)  # (9)
        np.testing.assert_allclose(euler.phi_integral(path), math.pi / 4, atol=1e-9)
        root = 1 / np.sqrt(2 * np.sin(theta) ** 2 - 1)
        np.testing.assert_allclose(np.tan(phi - math.pi / 4) + root, 0, atol=1e-8)  # (11) itself
        assert abs(psi).max() > 0.5  # it went somewhere


def test_the_body_turns_about_the_line_of_contacts():
    """The same motion as a rotation: all points of the ball turn about (1, 0, -1) by speed times time."""

    def matrix(angles):
        th, ph, ps = angles

        def rz(x):
            return np.array([[math.cos(x), -math.sin(x), 0], [math.sin(x), math.cos(x), 0], [0, 0, 1]])

        rx = np.array([[1, 0, 0], [0, math.cos(th), -math.sin(th)], [0, math.sin(th), math.cos(th)]])
        return rz(ps) @ rx @ rz(ph)

    path = follow(PAPER, 0.9)
    turned = matrix(path[-1]) @ matrix(path[0]).T
    axis = np.array([1, 0, -1]) / math.sqrt(2)
    np.testing.assert_allclose(turned @ axis, axis, atol=1e-9)
    assert (np.trace(turned) - 1) / 2 == pytest.approx(math.cos(0.9), abs=1e-9)


def test_singular_attitude():
    """At sin theta = 0 phi and psi turn about one axis: some spins have rates, others none."""
    for theta in (0.0, math.pi):
        for psi in (0.0, 0.7):
            angles = (theta, 0.4, psi)
            spin = np.array([math.cos(psi), math.sin(psi), 2.0])  # along the node line, and about the vertical
            rates = euler.euler_rates(angles, spin)
            np.testing.assert_allclose(euler.angular_velocity(angles, rates), spin, atol=10 * ROUNDING)
            assert abs(rates[1]) == pytest.approx(1.0, rel=ROUNDING)  # the smallest: half each
            with pytest.raises(carom.CaromError, match="singular"):
                euler.euler_rates(angles, (-math.sin(psi), math.cos(psi), 0.0))
    with pytest.raises(carom.CaromError, match="singular"):
        euler.wall_rates((0.0, 0.0, 1.0))
    # psi = +-pi/2: the node line lies along (0, 1, 0) and the turn about (1, 0, -1) is across it
    with pytest.raises(carom.CaromError):
        euler.wall_rates((math.pi, 0.0, math.pi / 2))


def test_shapes_and_bad_input():
    angles, rates = attitudes(6)
    grid = euler.angular_velocity(angles.reshape(2, 3, 3), rates.reshape(2, 3, 3))
    np.testing.assert_array_equal(grid.reshape(6, 3), euler.angular_velocity(angles, rates))
    assert euler.angular_velocity(angles, rates[0]).shape == (6, 3)
    assert euler.wall_rates(angles, np.ones(6)).shape == (6, 3)
    assert euler.wall_rates(PAPER, [1.0, 2.0]).shape == (2, 3)
    assert np.ndim(euler.psi_integral(PAPER)) == 0
    for bad in ((1.0, 2.0), 1.0, (math.nan, 0, 0)):
        with pytest.raises(carom.CaromError, match=r"angles: expected .* got"):
            euler.angular_velocity(bad, (0, 0, 0))
        with pytest.raises(carom.CaromError, match=r"rates: expected .* got"):
            euler.angular_velocity((1, 0, 0), bad)


def test_angles_of_an_orientation():
    """R_z(psi) R_x(theta) R_z(phi) as a product of quaternions, and back; and the rates of a turning body obey (1)."""
    from carom.core.motion.rotation import compose, orientation_after, rotation

    def about(axis, angle):
        return rotation(tuple(angle * c for c in axis))

    rng = np.random.default_rng(5)
    for th, ph, ps in [*rng.uniform((0, -3, -3), (3.1, 3, 3), (50, 3)), (0.0, 0.7, 0.0), (math.pi, 0.7, 0.0)]:
        q = compose(about((0, 0, 1), ps), compose(about((1, 0, 0), th), about((0, 0, 1), ph)))
        np.testing.assert_allclose(euler.euler_angles(q), (th, ph, ps), atol=1e-12)
    w, q, h = (1.0, -2.0, 0.7), compose(about((0, 0, 1), 0.3), about((1, 0, 0), 1.1)), 1e-5
    before, after = (euler.euler_angles(orientation_after(q, w, (0.0, 0.0, 0.0), s)) for s in (-h, h))
    np.testing.assert_allclose(euler.angular_velocity(euler.euler_angles(q), (after - before) / (2 * h)), w, rtol=1e-8)
    with pytest.raises(carom.CaromError, match="unit quaternions"):
        euler.euler_angles((1, 1, 0, 0))
    with pytest.raises(carom.CaromError, match="shape"):
        euler.euler_angles((1, 0, 0))
