"""Ball, Disc, Surface, State, rolling, slip, kinetic energy."""

import math

import numpy as np
import pytest
from reference.identities import ROUNDING, contact_velocity

import carom
from carom import gas
from carom.errors import CaromError


def test_ball():
    ball = carom.Ball(radius=0.03, mass=0.2)
    assert (ball.radius, ball.mass, ball.kappa) == (0.03, 0.2, 2 / 5)
    # I = 2/5 m a^2
    assert ball.moment == pytest.approx(0.4 * 0.2 * 0.03**2, rel=ROUNDING)
    assert carom.Ball(inertia="hollow").kappa == 2 / 3
    assert carom.Ball(inertia=0.3).kappa == 0.3
    many = carom.Ball([0.02, 0.03], 0.1, [0.4, 0.5])
    np.testing.assert_allclose(many.moment, [0.4 * 0.1 * 0.0004, 0.5 * 0.1 * 0.0009], rtol=ROUNDING)
    with pytest.raises(AttributeError):
        ball.mass = 3.0


def test_disc():
    assert carom.Disc().kappa == 1 / 2
    assert carom.Disc(inertia="ring").kappa == 1
    assert carom.Disc(inertia=0.9).planar
    assert carom.Disc(inertia=3.0).kappa == 3  # a hoop with weights outside its rim
    with pytest.raises(CaromError, match=r"^Species: inertia: expected kappa = .* in \(0, 1\]"):
        gas.Gas([gas.Species(carom.Disc(0.1, 1.0, 3.0), 2, "hoops")], (9.0, 9.0), contacts=carom.Surface())
    assert not carom.Ball().planar


def test_surface():
    surface = carom.Surface()
    assert (surface.restitution, surface.friction, surface.tangential_restitution) == (1, math.inf, 0)
    assert carom.Surface(0, 0, -1).tangential_restitution == -1


def test_state():
    state = carom.State((1, 2, 3), [(4, 5, 6)] * 7)
    assert state.shape == (7,)
    assert state.velocity.shape == state.spin.shape == (7, 3)
    assert state[2] == carom.State((1, 2, 3), (4, 5, 6))
    assert state[2] != carom.State((1, 2, 3), (4, 5, 7))
    assert carom.State((1, 2, 3)).spin.tolist() == [0, 0, 0]
    with_place = carom.State((1, 2, 3), position=(0, 0, 1))
    assert with_place.position.tolist() == [0, 0, 1]
    assert carom.State((0, 0, 0)) != 3
    # a state is its own: what it was made from may change
    v = np.ones(3)
    state = carom.State(v)
    v[0] = 5
    assert state.velocity[0] == 1


def test_rolling():
    """(27): x' - a omega_y = 0, y' + a omega_x = 0: no slip on the floor."""
    ball = carom.Ball(0.03)
    state = carom.rolling(ball, (-1.0, 0.5), 7.0)
    assert state.velocity.tolist() == [-1, 0.5, 0]
    np.testing.assert_allclose(state.spin, [-0.5 / 0.03, -1 / 0.03, 7], rtol=ROUNDING)
    np.testing.assert_allclose(carom.slip(ball, state), 0, atol=ROUNDING)
    assert carom.rolling(ball, (-1.0, 0.5, 0.0)) == carom.rolling(ball, (-1.0, 0.5))
    many = carom.rolling(carom.Ball([0.02, 0.03]), [(1, 2)] * 2, [[0], [1], [2]])
    assert many.shape == (3, 2)
    assert carom.rolling(carom.Ball([0.02, 0.03]), (1, 2)).shape == (2,)


def test_kinetic_energy():
    """(20)"""
    ball = carom.Ball(0.03, 0.2)
    energy = carom.kinetic_energy(ball, carom.State((1, 2, 2), (0, 30, 40)))
    assert isinstance(energy, float)
    assert energy == pytest.approx(0.2 * 9 / 2 + 0.4 * 0.2 * 0.0009 * 2500 / 2, rel=ROUNDING)
    # rolling: (1 + kappa) m v^2/2
    assert carom.kinetic_energy(ball, carom.rolling(ball, (3, 4))) == pytest.approx(1.4 * 0.2 * 25 / 2, rel=ROUNDING)
    assert carom.kinetic_energy(carom.Ball(mass=[1, 2]), carom.State((1, 0, 0))).tolist() == [0.5, 1]


def test_slip_is_the_contact_points_velocity():
    """(24), and for random normals the tests' own formula."""
    ball = carom.Ball(0.03)
    state = carom.rolling(ball, (-1.0, 0.5))
    # V_B0 = (x', y', x'), its normal part left out
    np.testing.assert_allclose(carom.slip(ball, state, (1, 0, 0)), [0, 0.5, -1], atol=ROUNDING)
    rng = np.random.default_rng(60)
    v, w, n = rng.normal(size=(3, 50, 3))
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    np.testing.assert_allclose(
        carom.slip(ball, carom.State(v, w), n), contact_velocity(v, w, n, 0.03)[1], atol=ROUNDING
    )


def test_names():
    assert {"Ball", "State", "Surface", "impact", "two_step", "conventional", "kinetic_energy"} <= set(dir(carom))
    for name in carom.__all__:
        if name not in ("plot", "datasets", "derive"):  # rooms with libraries of their own
            assert getattr(carom, name) is not None
    with pytest.raises(AttributeError, match="carom has no imapct; did you mean impact"):
        carom.imapct  # noqa: B018


def test_a_mass_whose_square_is_no_float_is_refused():
    with pytest.raises(
        carom.CaromError, match=r"mass: expected a mass in kg, > 0, at least 1e-100 in size, got 1e-320"
    ):
        carom.Ball(0.03, 1e-320)


def test_numbers_that_are_hardly_in_si_units_are_noted() -> None:
    with pytest.warns(
        UserWarning, match='Ball: 163 kg with a radius of 28.575 m: lighter than air; .* write "28.575 mm"'
    ) as said:
        carom.Ball(28.575, 163)
    assert said[0].filename == __file__
    with pytest.warns(UserWarning, match="denser than any metal; is the mass in g"):
        carom.Ball("28 mm", 163)
    for ball in (carom.Ball(1.0, 1.0), carom.Ball(0.01, 1.0), carom.Ball(0.11, 7.26), carom.Ball(100.0, 1e10)):
        assert ball.planar is False  # no warning: a ball in other units, one of bowling, a rock


def test_states_at_different_places_differ() -> None:
    one, other = (carom.State((1, 0, 0), position=(x, 0, 0)) for x in (0.0, 5.0))
    assert one != other
    assert one == carom.State((1, 0, 0), position=(0, 0, 0)) == carom.State((1, 0, 0))
    assert one != "a state"
