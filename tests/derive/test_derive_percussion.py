"""One contact followed through its impact, against an independent integration and what bodies can do."""

from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from examples import bodies
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from carom.derive import EnergyGain
from carom.derive.percussion import integrate
from carom.errors import CaromError

R = sp.Rational
COUPLED = sp.Matrix([[4, -3], [-3, 4]])
SPACE = sp.Matrix([[4, -1, R(1, 2)], [-1, 3, R(1, 3)], [R(1, 2), R(1, 3), 2]])


def by_force(g, start, e, mu, rule):
    """The same impact with Coulomb's sign smoothed, in the normal impulse, by an integrator that knows no phases."""
    g = np.array(g, dtype=float)
    eps = 1e-6 * np.abs(start).max()

    def flow(_p, y):
        slip = y[1:-1]
        push = np.concatenate([[1.0], -mu * slip / np.sqrt(slip @ slip + eps * eps)])
        return np.concatenate([g @ push, [y[0]]])

    def stop(_p, y):
        return y[0]

    stop.terminal, stop.direction = True, 1
    first = solve_ivp(flow, (0, 1e3), [*start, 0.0], events=stop, method="LSODA", rtol=1e-10, atol=1e-12)
    p_c, y_c = first.t[-1], first.y[:, -1]

    def over(p, y):
        if rule == "newton":
            return y[0] + e * start[0]
        if rule == "poisson":
            return p - (1 + e) * p_c
        return y[-1] - y_c[-1] * (1 - e * e)

    over.terminal, over.direction = True, 1
    rest = solve_ivp(flow, (p_c, 1e3), y_c, events=over, method="LSODA", rtol=1e-10, atol=1e-12)
    return rest.t[-1], rest.y[:-1, -1]


@pytest.mark.parametrize("rule", ["newton", "poisson", "stronge"])
@pytest.mark.parametrize("mu", [R(3, 10), R(6, 10), R(8, 10), 2])
@pytest.mark.parametrize("slip", [R(-1, 5), R(2, 5)])
def test_plane_against_integration(rule, mu, slip):
    found = integrate(COUPLED, [-1, slip], R(7, 10), mu, rule)
    p, velocity = by_force(COUPLED, [-1.0, float(slip)], 0.7, float(mu), rule)
    assert float(found.impulse[0]) == pytest.approx(p, rel=2e-5)
    assert [float(v) for v in found.velocity] == pytest.approx(list(velocity), abs=2e-5)
    # impulse and momentum
    assert sp.Matrix(found.velocity) - sp.Matrix([-1, slip]) - COUPLED * sp.Matrix(found.impulse) == sp.zeros(2, 1)


@pytest.mark.parametrize("rule", ["newton", "poisson", "stronge"])
@pytest.mark.parametrize("mu", [R(1, 10), R(2, 10), R(6, 10)])
def test_space_against_integration(rule, mu):
    start = [-1, R(1, 4), -R(2, 5)]
    found = integrate(SPACE, start, R(7, 10), mu, rule)
    p, velocity = by_force(SPACE, [float(s) for s in start], 0.7, float(mu), rule)
    assert float(found.impulse[0]) == pytest.approx(p, rel=2e-5)
    assert [float(v) for v in found.velocity] == pytest.approx(list(velocity), abs=2e-5)


def test_space_contains_the_plane():
    wide = sp.Matrix([[4, -3, 0], [-3, 4, 0], [0, 0, 2]])
    for mu in (R(3, 10), R(8, 10), 2):
        flat = integrate(COUPLED, [-1, -R(1, 5)], R(1, 2), mu, "stronge")
        deep = integrate(wide, [-1, -R(1, 5), 0], R(1, 2), mu, "stronge")
        assert [float(v) for v in flat.velocity] == pytest.approx(deep.velocity[:2], abs=1e-10)
        assert [p.kind for p in flat.phases] == [p.kind for p in deep.phases]


def test_exact_numbers_stay_exact():
    found = integrate(COUPLED, [-1, -R(1, 5)], R(1, 2), R(1, 2), "poisson")
    assert found.velocity == (R(1, 2), -R(4, 5))
    assert found.impulse == (R(3, 5), R(3, 10))
    assert all(isinstance(v, sp.Rational) for v in (*found.velocity, *found.impulse, found.energy_change))


def test_jam_is_found_where_friction_beats_the_normal():
    assert integrate(COUPLED, [-1, -R(1, 5)], 0, R(134, 100), "stronge").jams
    assert not integrate(COUPLED, [-1, -R(1, 5)], 0, R(133, 100), "stronge").jams  # 4/3 lies between
    assert not integrate(COUPLED, [-1, R(1, 5)], 0, 2, "stronge").jams  # the other way it does not


numbers = st.integers(-20, 20).map(lambda k: Fraction(k, 7))
positive = st.integers(1, 30).map(lambda k: R(k, 7))


@settings(max_examples=60)
@given(
    positive,
    positive,
    st.integers(-9, 9),
    st.integers(1, 20),
    st.integers(-20, 20),
    st.integers(0, 10),
    st.integers(0, 30),
)
def test_stronge_and_poisson_never_gain(nn, tt, share, approach, slip, e, mu):
    cross = R(share, 10) * sp.sqrt(nn * tt).evalf(30)
    g = sp.Matrix([[sp.Float(nn, 30), cross], [cross, sp.Float(tt, 30)]])
    start = [-R(approach, 5), R(slip, 5)]
    for rule in ("stronge", "poisson"):
        found = integrate(g, start, R(e, 10), R(mu, 10), rule)
        if rule == "stronge":
            assert found.energy_change <= 1e-20
        assert found.velocity[0] >= -1e-20
        assert found.impulse[0] >= 0
        assert abs(found.impulse[1]) <= R(mu, 10) * found.impulse[0] + sp.Float("1e-20", 30)


def test_newton_gain_is_warned_of_and_the_others_are_silent():
    steep = sp.Matrix([[4, R(39, 10)], [R(39, 10), 4]])
    with pytest.warns(EnergyGain, match="newton's restitution"):
        newton = integrate(steep, [-1, -R(9, 10)], 1, 1, "newton")
    assert newton.energy_change > 0
    assert integrate(steep, [-1, -R(9, 10)], 1, 1, "stronge").energy_change <= 0


def test_infinite_friction_stops_the_slip_first():
    ball = bodies.ball_on_wall()
    values = {bodies.kappa: R(2, 5), bodies.a: 1, bodies.m: 1, bodies.e: R(1, 2)}
    names = dict(zip(ball.speeds.before, (-1, 2, 0, 0, 1, 3), strict=True))
    found = ball.percussion("wall", values | names, "stronge")
    jump = ball.solve().subs(values | names)
    assert [float(v) for v in found.impulse] == pytest.approx([float(v) for v in jump.impulses.values()], abs=1e-12)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: integrate(COUPLED, [1, 0], 0, 0), "separates"),
        (lambda: integrate(sp.Matrix([[1, 1], [1, 1]]), [-1, 0], 0, 0), "not positive definite"),
        (lambda: integrate(COUPLED, [-1, 0], 0, 0, "hertz"), "hypothesis: expected 'newton'"),
        (lambda: integrate(COUPLED, [-1, 0, 0], 0, 0), "expected a normal and one or two tangents"),
    ],
)
def test_bad_input(build, message):
    with pytest.raises(CaromError, match=message):
        build()
