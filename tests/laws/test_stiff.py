"""The laws against contacts of finite stiffness, integrated in time (``stiff.py``, which knows none of the laws).

Tolerances are the references' own errors, as observed: springs with a friction creep of 1e-7 err by about 20 creeps
where a contact grazes its cone, else by 1e-8; a floor r times as stiff as the wall errs by 5/r while it is pressed
throughout, by 1/sqrt(r) once it gives back what it stored; the rigid floor, extrapolated, by what its last halving of
the step moved.
"""

import functools
import math

import numpy as np
import pytest
from reference.rigid_floor import rigid_floor, rigid_limit
from reference.stiff_springs import Spring, advance, ball_between, equations, speed, spring_contact, stiff_limit
from scipy.integrate import solve_ivp

import carom

KAPPA = 0.4
UPRIGHT = (1.0, 0.0, 0.0)
CUSHION = (math.sqrt(0.84), 0.0, -0.4)  # touches at 7/5 of the radius above the floor
BACKSPIN = ((-1.0, 0.5, 0.0), (-0.5, 2.0, 0.3), UPRIGHT)
ROLLING = ((-1.0, 1.0, 0.0), (-1.0, -1.0, 0.0), CUSHION)
STUNNED = ((-1.0, 0.5, 0.0), (0.0, 0.0, 1.0), CUSHION)
LIFTED = ((-1.0, 1.0, 0.0), (-1.0, -1.0, 0.0), UPRIGHT)

# shot, wall's e, wall's mu, floor's mu
PRESSED = [
    (BACKSPIN, 0.85, 0.2, 0.2),
    (BACKSPIN, 0.85, 0.2, 1.0),
    (BACKSPIN, 1.0, 0.2, 0.2),
    (BACKSPIN, 0.5, 0.2, 0.2),
    (ROLLING, 0.85, 0.1, 0.1),
    (ROLLING, 0.85, 0.2, 0.2),
    (ROLLING, 0.85, 0.3, 0.6),
    (ROLLING, 0.85, 0.43, 0.2),
    (STUNNED, 0.85, 0.1, 0.1),
    (STUNNED, 0.85, 0.2, 0.2),  # the wall's contact slips, sticks, and slips again
    (STUNNED, 0.85, 0.5, 0.2),
    (STUNNED, 0.85, 0.2, 0.8),
]
# once the wall sticks it no longer presses the ball down: the floor lets go what it has stored
RELEASED = [(BACKSPIN, 0.85, 1.0, 0.2), (BACKSPIN, 0.85, 5.0, 0.1)]


def two_step(shot, e, wall_mu, floor_mu, floor_e=0.0, kappa=KAPPA, **options):
    velocity, spin, normal = shot
    return carom.two_step(
        carom.Ball(radius=1.0, mass=1.0, inertia=kappa),
        carom.State(velocity=velocity, spin=spin),
        wall=carom.Surface(restitution=e, friction=wall_mu),
        floor=carom.Surface(restitution=floor_e, friction=floor_mu),
        normal=normal,
        **options,
    )


def off_wall(*args, **options):
    after = two_step(*args, **options).after_wall
    return np.concatenate([after.velocity, after.spin])


def springs(shot, e, wall_mu, floor_mu, **options):
    return spring_contact(KAPPA, *shot, wall_e=e, wall_mu=wall_mu, floor_mu=floor_mu, **options)


def rigid(shot, e, wall_mu, floor_mu, **options):
    return rigid_floor(KAPPA, *shot, wall_e=e, wall_mu=wall_mu, floor_mu=floor_mu, **options)


@functools.cache
def limit_of(shot, e, wall_mu, floor_mu):
    """Return the rigid floor's outcome and its error."""
    return rigid_limit(KAPPA, *shot, wall_e=e, wall_mu=wall_mu, floor_mu=floor_mu, steps=1000)


@functools.cache
def springs_limit_of(shot, e, wall_mu, floor_mu):
    """Return what springs tend to as the floor grows stiffer."""
    return stiff_limit(KAPPA, *shot, wall_e=e, wall_mu=wall_mu, floor_mu=floor_mu, floor_damping=3.0)


def apart(p, q):
    return float(np.max(np.abs(np.asarray(p) - np.asarray(q))))


# ------------------------------------------------------------------------------- the references themselves


def test_the_springs_error_falls_with_the_creep_even_where_a_contact_grazes_its_cone():
    case = (STUNNED, 0.85, 0.2, 0.2)
    best = springs(*case, ratio=1e4, floor_damping=1.0, creep=1e-8).state
    errors = [apart(springs(*case, ratio=1e4, floor_damping=1.0, creep=c).state, best) for c in (1e-4, 1e-5, 1e-6)]
    assert errors[0] > 5 * errors[1] > 25 * errors[2]
    assert errors[2] < 3e-5


@pytest.mark.parametrize("damping", [None, 1.0])
def test_the_springs_are_integrated_as_by_scipy(damping):
    """Up to the wall's greatest compression: a stunned ball, whose contact with the wall slips and comes to stick."""
    velocity, spin, n = STUNNED
    ball = ball_between(KAPPA, n, Spring(1.0, 0.85), Spring(100.0, 1.0, damping), 0.5, 0.2, 1e-5)

    def rates(_t, y):
        found = np.empty(8)
        equations(y, ball, found, found, False)
        return found

    def jacobian(_t, y):
        found, table = np.empty(8), np.empty((8, 8))
        equations(y, ball, found, table, True)
        return table

    def turns(_t, y):
        return y[:3] @ n

    turns.terminal = True
    start = np.array([*velocity, *spin, 0.0, 0.0])
    by_scipy = solve_ivp(rates, (0.0, 5.0), start, "Radau", jac=jacobian, events=turns, rtol=1e-8, atol=1e-11)
    y = start.copy()
    t, happened = advance(y, 0.0, 5.0, [speed(n)], ball, 1e-8, 1e-11)
    assert happened.all()
    assert t == pytest.approx(by_scipy.t_events[0][0], abs=1e-7)
    assert apart(y, by_scipy.y_events[0][0]) < 1e-7
    at, difference = by_scipy.y[:, 20], 1e-7
    by_differences = [(rates(0, at + d) - rates(0, at - d)) / (2 * difference) for d in np.eye(8) * difference]
    np.testing.assert_allclose(jacobian(0, at).T, by_differences, rtol=1e-5, atol=1e-5 * np.abs(by_differences).max())


def test_the_springs_do_not_depend_on_the_integrators_tolerance():
    for case in (PRESSED[1], RELEASED[0]):
        loose, tight = (springs(*case, ratio=100.0, floor_e=0.5, rtol=tol).state for tol in (1e-7, 1e-10))
        assert apart(loose, tight) < 1e-6


@pytest.mark.parametrize("case", PRESSED)
def test_a_pressed_ball_on_springs_tends_to_the_rigid_floor_as_one_over_the_ratio(case):
    limit, error = limit_of(*case)
    assert error < 3e-6
    coarse, fine = (apart(springs(*case, ratio=r, floor_damping=1.0).state, limit) for r in (1e2, 1e4))
    assert fine < 2e-4
    assert coarse > 30 * fine
    assert apart(springs_limit_of(*case), limit) < 5e-6


@pytest.mark.parametrize("case", RELEASED)
def test_a_ball_the_floor_lets_go_tends_to_it_as_one_over_the_root_of_the_ratio(case):
    limit, _ = limit_of(*case)
    coarse, fine = (springs(*case, ratio=r, floor_damping=1.0) for r in (1e4, 1e6))
    assert fine.lifted
    assert fine.velocity[2] > 0.0
    assert apart(coarse.state, limit) == pytest.approx(10 * apart(fine.state, limit), rel=0.05)


@pytest.mark.parametrize("floor_e", [0.5, 1.0])
@pytest.mark.parametrize("case", [PRESSED[0], PRESSED[5], PRESSED[9]])
def test_the_floors_restitution_does_not_matter_to_a_ball_that_is_pressed_throughout(case, floor_e):
    limit = off_wall(*case)
    assert apart(off_wall(*case, floor_e=floor_e), limit) == 0.0
    # an undamped floor rings: its phase at the end decides between 1/r and 1/sqrt(r)
    assert apart(springs(*case, ratio=1e4, floor_e=floor_e, creep=1e-6).state, limit) < 2e-3


def test_the_walls_law_of_force_does_not_matter_until_the_ball_comes_down_again():
    for case in (PRESSED[1], PRESSED[5], RELEASED[0]):
        assert apart(rigid(*case, steps=4000).state, rigid(*case, steps=4000, power=1.5).state) < 1e-4
    again = (ROLLING, 0.85, 2.0, 0.2)
    linear, hertz = rigid(*again, steps=4000), rigid(*again, steps=4000, power=1.5)
    assert linear.touchdowns
    assert hertz.touchdowns
    assert apart(linear.state, hertz.state) > 0.01


# ------------------------------------------------------------------------------- the laws


@pytest.mark.parametrize("e", [0.5, 0.85, 1.0])
@pytest.mark.parametrize("wall_mu", [0.05, 0.2, 0.5, 1.0, 5.0])
def test_a_lifted_ball_does_what_the_first_impact_says_whatever_the_floor(wall_mu, e):
    law = off_wall(LIFTED, e, wall_mu, 0.2)
    for ratio in (0.01, 1.0, 1e4):
        # (looser, the integrator places the turn of the wall's spring only to 4e-7 in some cases)
        out = springs(LIFTED, e, wall_mu, 0.2, ratio=ratio, floor_e=0.5, rtol=1e-10, atol=1e-13)
        assert apart(out.state, law) < 1e-7
        assert out.lifted


@pytest.mark.parametrize("case", PRESSED + RELEASED)
def test_a_pressed_ball_does_what_the_rigid_floor_says(case):
    limit, error = limit_of(*case)
    assert error < 3e-6
    assert apart(off_wall(*case), limit) < error + 1e-7


@pytest.mark.parametrize("case", PRESSED)
def test_a_pressed_ball_does_what_springs_tend_to(case):
    assert apart(off_wall(*case), springs_limit_of(*case)) < 5e-6


def test_a_wall_that_returns_nothing_stops_at_the_greatest_compression():
    case = (BACKSPIN, 0.0, 0.2, 0.2)
    assert apart(off_wall(*case), springs(*case, ratio=1e6, floor_damping=1.0).state) < 1e-6


@pytest.mark.parametrize("mu", [1.2, 5.0, 20.0])
def test_backspin_against_a_rough_upright_wall_is_braked_but_not_jammed(mu):
    case = (BACKSPIN, 0.85, mu, mu)
    law = off_wall(*case)
    assert law[0] > 0.2
    assert apart(law, springs(*case, ratio=1e8, floor_damping=1.0, creep=1e-8).state) < 1e-4


@pytest.mark.parametrize("e", [0.85, 1.0])
@pytest.mark.parametrize("wall_mu", [0.7, 1.0, 2.0, 5.0, 20.0])
def test_a_ball_that_is_lifted_then_pressed_down_lands_during_the_contact(wall_mu, e):
    # the moment at which the gap closes lies anywhere in a step: the rigid floor errs by its step, 2e-4 here
    case = (ROLLING, e, wall_mu, 0.2)
    assert apart(off_wall(*case), rigid(*case, steps=8000).state) < 4e-4
    # springs land by a dashpot of 3 times critical damping (nearly e = 0), soft enough to integrate: 1/sqrt(r)
    assert apart(off_wall(*case), springs(*case, ratio=1e6, floor_damping=3.0).state) < 2e-4


@pytest.mark.parametrize("e", [0.5, 0.85, 1.0])
def test_a_second_compression_goes_back_along_the_line_of_unloading(e):
    """The ball lands when the wall unloads already, and the landing turns it back into the wall."""
    shot = ((-1.0, -0.1760889, 0.0), (-0.2747408, -0.1810320, 0.5817657), (0.8, 0.0, -0.6))
    known = {"wall_e": e, "wall_mu": 2.278347249, "floor_mu": 0.139254426}
    limit, error = rigid_limit(2 / 3, *shot, steps=1000, **known)
    law = off_wall(shot, e, known["wall_mu"], known["floor_mu"], kappa=2 / 3)
    assert error < 5e-4  # without the rule the law is 4e-3 (e = 0.85) and 2e-2 (e = 0.5) off
    assert apart(law, limit) < 2 * error + 1e-6


@pytest.mark.parametrize("floor_e", [0.5, 0.8])
def test_after_such_a_landing_the_floors_restitution_matters(floor_e):
    case = (ROLLING, 0.85, 5.0, 0.2)
    law = off_wall(*case, floor_e=floor_e)
    assert apart(law, off_wall(*case)) > 0.1
    assert apart(law, rigid(*case, floor_e=floor_e, steps=8000).state) < 4e-4
    coarse, fine = (apart(springs(*case, ratio=r, floor_e=floor_e).state, law) for r in (1e4, 1e6))
    assert fine < 2e-3
    assert coarse > 5 * fine


@pytest.mark.parametrize("shot", [BACKSPIN, ROLLING, STUNNED])
def test_a_floor_softer_than_the_wall_acts_after_it(shot):
    case = (shot, 0.85, 0.2, 0.2)
    law = two_step(*case, floor_e=0.5, floor_contact="after")
    off = np.concatenate([law.after_wall.velocity, law.after_wall.spin])
    landed = np.concatenate([law.after_floor.velocity, law.after_floor.spin])
    for ratio in (1e-3, 1e-5):
        out = springs(*case, ratio=ratio, floor_e=0.5, follow_floor=True, longest=40.0 / math.sqrt(ratio))
        assert apart(out.state, off) < 0.6 * ratio
        assert apart(out.after_floor, landed) < 0.3 * ratio


@pytest.mark.parametrize("mu", [0.6, 0.7, 1.2])
@pytest.mark.parametrize("shot", [STUNNED, ((-1.0, 0.0, 0.0), (0.0, 0.0, 0.0), CUSHION)])
def test_a_ball_jams_under_the_cushion_where_both_cones_hold_the_line_between_the_contacts(shot, mu):
    case = (shot, 0.85, mu, mu)
    threshold = math.sqrt((1.0 + CUSHION[2]) / (1.0 - CUSHION[2]))  # 0.6547: half the angle between the normals
    out = springs(*case, ratio=1e4, floor_damping=3.0, longest=15.0)
    law = off_wall(*case)
    assert out.jammed == (mu > threshold)
    assert apart(law, out.state) < 5e-4
    assert (abs(law[0]) < 1e-6) == out.jammed


def test_random_shots():
    rng = np.random.default_rng(20)
    worst = 0.0
    for _ in range(50):
        kappa = float(rng.choice([0.1, 0.4, 2 / 3]))
        nz = float(rng.choice([0.0, -0.2, -0.4, -0.6, 0.2]))
        velocity = (-1.0, float(rng.normal()), 0.0)
        spin = tuple(rng.normal(size=3) * rng.choice([0.3, 1.0, 3.0]))
        if rng.random() < 0.3:
            spin = (-velocity[1], velocity[0], float(rng.normal()))
        e = float(rng.choice([0.3, 0.85, 1.0]))
        wall_mu, floor_mu = np.exp(rng.uniform(np.log(0.05), np.log(3.0), 2)).tolist()
        shot = (velocity, spin, (math.sqrt(1.0 - nz * nz), 0.0, nz))
        known = {"wall_e": e, "wall_mu": wall_mu, "floor_mu": floor_mu}
        coarse, fine = (rigid_floor(kappa, *shot, steps=s, longest=20.0, **known).state for s in (500, 1000))
        law = off_wall(shot, e, wall_mu, floor_mu, kappa=kappa)
        # first order: what is left is what the last halving moved; a landing in mid-step is less regular
        assert apart(law, fine) < 2.0 * apart(coarse, fine) + 2e-3
        worst = max(worst, apart(law, 2 * fine - coarse))
    assert worst < 2e-3
