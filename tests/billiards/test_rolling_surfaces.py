"""A ball that rolls on surfaces: closed forms, integrals, small steps apart from carom, leaving and landing, flat limits."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from reference import rolling_small_steps
from scipy.optimize import minimize, minimize_scalar

import carom
from carom import billiards
from carom.billiards import surfaces
from carom.billiards.rolling import spin_vector

BALL = carom.Ball(0.02, 0.1)
GOLF = carom.Ball(0.02135, 0.0459)
G = 9.81


@pytest.mark.parametrize(("kappa", "swings"), [(2 / 5, 0.534522), (1 / 3, 0.5), (2 / 7, math.sqrt(2 / 9))])
def test_height_in_a_pipe_swings_as_theory_says(kappa, swings):
    eta, speed, ring = math.sqrt(kappa / (1 + kappa)), 3.0, 0.08
    assert eta == pytest.approx(swings, abs=1e-6)
    ball = carom.Ball(0.02, 0.1, kappa)
    run = billiards.roll(
        surfaces.pipe(0.1), (ring, 0, 0), (0, speed, 0), ball=ball, duration=2 * math.tau * ring / speed
    )
    rate = speed / ring
    times = np.linspace(0, run.duration, 9)
    expected = -G / ((1 + kappa) * (eta * rate) ** 2) * (1 - np.cos(eta * rate * times))
    states = run.at(times)
    assert np.abs(states.place[:, -1] - expected).max() < 1e-12 * 0.1
    assert np.abs(states.place[:, 0] - ring * np.cos(rate * times)).max() < 1e-12


def test_a_cylinder_over_a_circle_is_a_pipe_and_over_an_ellipse_an_ellipsoid_without_end():
    ball, start = carom.Ball(0.02, 0.1), ((0.08, 0, 0), (0, 3.0, 0))
    eta, rate = math.sqrt(2 / 7), 3.0 / 0.08
    run = billiards.roll(surfaces.cylinder("circle:radius=0.1", 0.02), *start, ball=ball, duration=0.2)
    times = np.linspace(0, 0.2, 7)
    assert (
        np.abs(run.at(times).place[:, 2] + G / (1.4 * (eta * rate) ** 2) * (1 - np.cos(eta * rate * times))).max()
        < 1e-13
    )
    for inside in (True, False):
        place = (0.1 if inside else 0.14, 0, 0)
        pair = (
            surfaces.cylinder("ellipse", 0.02, inside, half_axes=(0.12, 0.09)),
            surfaces.ellipsoid((0.12, 0.09, math.inf), inside),
        )
        one, two = (
            billiards.roll(x, place, (0, 2.0, 0), 5.0, ball=ball, duration=0.1, held=True).at(0.1) for x in pair
        )
        assert np.abs(one.place - two.place).max() < 1e-13
        assert np.abs(one.spin - two.spin).max() < 1e-10


def test_a_cylinder_over_any_curve_agrees_with_small_steps():
    # r = 0.1 + 0.01 cos(3 theta): the distance by minimising over theta
    def level(x):
        def off(a):
            r = 0.1 + 0.01 * math.cos(3 * a)
            return math.hypot(r * math.cos(a) - x[0], r * math.sin(a) - x[1])

        return minimize_scalar(off, bracket=(near := math.atan2(x[1], x[0]), near + 0.01), tol=1e-15).fun

    place = np.array([0.11 - 0.02, 0.0, 0.0])
    surface = surfaces.cylinder("curve:r=0.1+0.01*cos(3*theta)", 0.02)
    run = billiards.roll(surface, place, (0.0, 1.2, 0.4), 9.0, ball=BALL, duration=0.05)
    begin = run.at(0.0)
    state = np.concatenate([begin.place[0], begin.velocity[0], spin_vector(begin.spin)[0]])
    after = rolling_small_steps.follow(level, state, 0.02, 0.4, np.array([0, 0, -G]), 0.05, 25)
    end = run.at(0.05)
    assert np.abs(after[:3] - end.place[0]).max() < 1e-6
    assert np.abs(after[3:6] - end.velocity[0]).max() < 3e-5


def test_a_stadium_is_a_section_and_figures_with_corners_are_none():
    surface = surfaces.cylinder("stadium:straight=0.2,radius=0.1", 0.02)
    run = billiards.roll(surface, (0.0, -0.08, 0.0), (2.0, 0.0, 0.0), 3.0, ball=BALL, duration=0.2, accuracy=1e-10)
    motion = run.phases[0].motion
    energies = [motion.energy(phase.state(phase.end)) for phase in run.phases]
    assert run.end == "duration"
    assert np.ptp(energies) < 1e-7 * energies[0]
    # along z only the spin about the normal acts, by -kappa r T phi'/(1 + kappa), and straight walls do not turn
    rows = run.at(np.linspace(0.0, 0.049, 5))
    assert np.allclose(rows.velocity[:, 2], -G / 1.4 * rows.time, atol=1e-9)
    for words, arguments in (
        ("which has corners", ("rectangle:size=[1,1]", 0.02)), ("one closed curve", ("strip", 0.02)),
        ("below the least one of curvature, 0.1 m", ("circle:radius=0.1", 0.1)),
    ):  # fmt: skip
        with pytest.raises(carom.CaromError, match=words):
            surfaces.cylinder(*arguments)


def test_energy_and_distance_do_not_drift():
    ring, speed = 0.08, 3.0
    run = billiards.roll(
        surfaces.pipe(0.1), (ring, 0, 0), (0, speed, 0), 7.0, ball=BALL, duration=20 * math.tau * ring / speed
    )
    motion = run.phases[0].motion
    energies = np.array([motion.energy(phase.state(phase.end)) for phase in run.phases])
    assert np.ptp(energies) < 1e-13 * energies[0]
    assert abs(run.setting.surface.distance(run.at(run.duration).place[0]) - 0.02) < 1e-15


def test_the_spin_about_the_normal_of_a_bowl_is_constant():
    x = 0.08 * np.array([0.6, 0.0, -0.8])
    run = billiards.roll(surfaces.bowl(0.1), x, (0.0, 0.9, 0.0), 11.0, ball=BALL, duration=3.0)
    states = run.at(np.linspace(0, 3, 20))
    about = np.einsum("ij,ij->i", spin_vector(states.spin), -states.place / 0.08)
    assert np.abs(about - 11.0).max() < 1e-11


# Distances of a place from a surface, written apart from carom's.
def _to_ellipsoid(x, half_axes):
    """The distance to an ellipsoid from inside, by minimising over two angles."""
    a, b, c = half_axes

    def square(u):
        y = np.array([a * math.sin(u[0]) * math.cos(u[1]), b * math.sin(u[0]) * math.sin(u[1]), c * math.cos(u[0])])
        return float((x - y) @ (x - y))

    near = min(((u, w) for u in np.linspace(0.1, 3, 12) for w in np.linspace(-3, 3, 24)), key=square)
    return math.sqrt(
        minimize(square, near, method="Nelder-Mead", options={"xatol": 1e-12, "fatol": 1e-24, "maxiter": 4000}).fun
    )


@pytest.mark.parametrize("half_axes", [(0.3, 0.2, 0.1), (0.3, 0.2, math.inf)])
def test_the_distance_to_an_ellipsoid_is_the_least_one(half_axes):
    surface = surfaces.ellipsoid(half_axes)
    flat = (*half_axes[:2], 1e6) if math.isinf(half_axes[2]) else half_axes
    for x in np.random.default_rng(3).uniform(-1, 1, (20, 3)) * (0.12, 0.08, 0.04):
        near = x.copy()
        if math.isinf(half_axes[2]):
            near[2] = 0.0
        foot = near - surface.distance(near) * surface.normal(near)
        assert np.sum((foot / flat) ** 2) == pytest.approx(1.0, abs=1e-12)
        if not math.isinf(half_axes[2]):
            assert surface.distance(x) == pytest.approx(_to_ellipsoid(x, half_axes), abs=1e-9)


def test_pieces_turn_as_differences_of_their_normals_say():
    rng = np.random.default_rng(5)
    for surface in (
        surfaces.pipe(0.3), surfaces.bowl(0.3), surfaces.torus(0.4, 0.1), surfaces.ellipsoid((0.3, 0.2, 0.15)),
        surfaces.ellipsoid((0.3, 0.2, 0.15), inside=False), surfaces.hole(0.3),
    ):  # fmt: skip
        for piece in surface.pieces:
            x, v = rng.uniform(0.05, 0.1, 3), rng.normal(size=3)
            n = piece.normal(x)
            assert n @ n == pytest.approx(1, abs=1e-14)
            difference = (piece.normal(x + 1e-6 * v) - piece.normal(x - 1e-6 * v)) / 2e-6
            assert np.allclose(piece.turn(x, n, v), difference, atol=2e-8 * max(1, np.abs(difference).max()))
            slope = (piece.distance(x + 1e-6 * v) - piece.distance(x - 1e-6 * v)) / 2e-6
            assert slope == pytest.approx(float(n @ v), abs=1e-8)


CASES = {
    "bowl": (surfaces.bowl(0.1), lambda x: -float(x @ x), 0.08 * np.array([0.6, 0, -0.8]), (0.0, 0.9, 0.0)),
    "torus": (
        surfaces.torus(0.3, 0.1, inside=True),
        lambda x: -float((math.hypot(x[0], x[1]) - 0.3) ** 2 + x[2] ** 2),
        np.array([0.3, 0.0, -0.08]),
        (0.5, 0.6, 0.0),
    ),
    "edge of a hole": (
        surfaces.hole(0.2),
        lambda x: float((math.hypot(x[0], x[1]) - 0.2) ** 2 + x[2] ** 2),
        np.array([0.2 - 0.02 * math.sin(0.1), 0.0, 0.02 * math.cos(0.1)]),
        (0.0, 0.2, 0.0),
    ),
    "ellipsoid": (
        surfaces.ellipsoid((0.3, 0.2, 0.1)),
        # the level set of the centres is not an ellipsoid: a distance by Newton's method from a start of its own
        lambda x: _distance_inside(x, np.array([0.3, 0.2, 0.1])),
        np.array([0.0, 0.0, -0.08]),
        (0.7, 0.4, 0.0),
    ),
}


def _distance_inside(x, a):
    """The nearest point is x a^2 / (a^2 + t): Newton's method in t from below, where the left side falls and is convex."""
    pairs = list(zip(x.tolist(), (a**2).tolist(), strict=True))
    t = max(abs(q) * math.sqrt(c) - c for q, c in pairs)
    for _ in range(60):
        excess = sum(q * q * c / (c + t) ** 2 for q, c in pairs) - 1
        step = excess / sum(2 * q * q * c / (c + t) ** 3 for q, c in pairs)
        t += step
        if abs(step) < 1e-17:
            break
    return math.hypot(*(q - q * c / (c + t) for q, c in pairs))


@pytest.mark.parametrize("name", CASES)
def test_rolling_agrees_with_small_steps(name):
    surface, level, place, velocity = CASES[name]
    spin, duration = 9.0, 0.15
    run = billiards.roll(surface, place, velocity, spin, ball=BALL, duration=duration)
    assert run.end == "duration"
    begin = run.at(0.0)
    state = np.concatenate([begin.place[0], begin.velocity[0], spin_vector(begin.spin)[0]])
    after = rolling_small_steps.follow(level, state, 0.02, 0.4, np.array([0, 0, -G]), duration, 150)
    end = run.at(duration)
    assert np.abs(after[:3] - end.place[0]).max() < 3e-7
    assert np.abs(after[3:6] - end.velocity[0]).max() < 3e-6
    assert np.abs(after[6:] - spin_vector(end.spin)[0]).max() < 2e-4


def test_a_ball_leaves_a_dome_where_the_textbook_says():
    run = billiards.roll(
        surfaces.dome(1.0), (1e-7 * 1.02, 0, math.sqrt(1 - 1e-14) * 1.02), (1e-7, 0, 0), ball=BALL, duration=60
    )
    leaves = next(event for event in run.events if event.kind == "leaves")
    assert leaves.place[2] / 1.02 == pytest.approx(10 / 17, abs=1e-9)


def test_a_finite_friction_ends_the_roll_before_it_leaves():
    start = ((1e-3 * 1.02, 0, math.sqrt(1 - 1e-6) * 1.02), (1e-3 * math.sqrt(1 - 1e-6), 0, -1e-6))
    run = billiards.roll(surfaces.dome(1.0), *start, ball=BALL, duration=60, friction=0.3)
    last = run.at(run.duration)
    assert run.end == "slips"
    assert last.friction[0] / last.pressure[0] == pytest.approx(0.3, abs=1e-9)


def test_a_free_ball_is_caught_by_golfs_hole_below_the_known_speed():
    # (2R - r) sqrt(g / 2r): the centre has fallen by the ball's radius at the far side (Holmes, Am. J. Phys. 59, 129 (1991))
    known = (2 * 0.054 - 0.02135) * math.sqrt(G / (2 * 0.02135))
    assert known == pytest.approx(1.3134, abs=5e-5)

    def height(speed):
        run = billiards.roll(surfaces.hole(), (-0.055, 0, 0.02135), (speed, 0, 0), ball=GOLF, duration=1.0)
        return next(event for event in run.events if event.kind == "lands").place[2]

    assert height(known * (1 - 1e-9)) < 0 < height(known * (1 + 1e-9))


def test_a_ball_goes_around_the_rim_at_a_constant_height():
    # steady rolling on the rim, from (R1) to (R5) with d(height)/dt = 0 ("golf balls of death", Hogan & Antali 2025)
    ring, r, kappa, angle, rate = 0.054, 0.02135, 0.4, 0.6, 9.0
    rho = ring - r * math.sin(angle)
    spin = (G * math.sin(angle) - (1 + kappa) * rho * rate**2 * math.cos(angle)) / (kappa * r * rate * math.sin(angle))
    start = (rho, 0, r * math.cos(angle)), (0, rho * rate, 0)
    run = billiards.roll(surfaces.hole(), *start, spin, ball=GOLF, duration=0.25)
    if run.at(0.25).place[0, 2] != pytest.approx(r * math.cos(angle), abs=1e-9):
        run = billiards.roll(surfaces.hole(), *start, -spin, ball=GOLF, duration=0.25)
    assert run.at(0.25).place[0, 2] == pytest.approx(r * math.cos(angle), abs=1e-9)


def edge_map(surface, ball, start, slip_rate=0.6):
    """Velocity and spin after the edge, as (outwards, along, eta r spin), less the limit: a rotation by pi eta."""
    eta = math.sqrt(ball.kappa / (1 + ball.kappa))
    velocity = np.array([math.cos(0.7), math.sin(0.7), 0.0])
    run = billiards.roll(
        surface,
        start - 0.3 * velocity,
        velocity,
        slip_rate / (eta * ball.radius),
        ball=ball,
        gravity=(0, 0, 0),
        duration=0.36,
        held=True,
    )
    back = [event for event in run.events if event.kind == "crosses"][2]
    after = run.at(back.time)
    out = np.append(after.place[0, :2], 0.0) / np.linalg.norm(after.place[0, :2])
    along = np.array([-out[1], out[0], 0.0])
    normal = surface.normal(after.place[0] - 1e-9 * out)
    spin = eta * ball.radius * float(spin_vector(after.spin)[0] @ normal)
    v = after.velocity[0]
    angle = math.pi * eta
    expected = [-math.cos(0.7), math.sin(0.7) * math.cos(angle) + slip_rate * math.sin(angle),
                slip_rate * math.cos(angle) - math.sin(0.7) * math.sin(angle)]  # fmt: skip
    return np.array([v @ out, v @ along, spin]) - expected


def test_rolling_around_an_edge_becomes_a_no_slip_bounce_with_error_of_order_one():
    errors = {}
    for size in (0.01, 0.001):
        ball = carom.Ball(size, 1.0)
        plate = np.abs(edge_map(surfaces.plate(1.0), ball, np.array([1.0, 0, size]))).max()
        between = edge_map(surfaces.sheets(1.0, size, 0.05), carom.Ball(0.05, 1.0), np.array([1.0, 0, size]))
        assert np.abs(between).max() == pytest.approx(plate, rel=1e-6)  # the centre moves on the same surface
        errors[size] = plate
    assert errors[0.001] < 1.2e-3
    assert math.log10(errors[0.01] / errors[0.001]) == pytest.approx(1.0, abs=0.01)


def test_bad_starts_are_one_line_each():
    with pytest.raises(carom.CaromError) as refused:
        billiards.roll(surfaces.pipe(0.1), (0.09, 0, 0), (0, 1, 0), ball=BALL, duration=-1, friction=0.0, accuracy=1.0)
    assert [line.split(":")[1].strip() for line in refused.value.faults] == [
        "duration",
        "friction",
        "accuracy",
        "place",
    ]
    with pytest.raises(
        carom.CaromError, match="velocity: expected a velocity along the surface, got -1 m/s along its normal"
    ):
        billiards.roll(surfaces.pipe(0.1), (0.08, 0, 0), (1, 0, 0), ball=BALL)
    with pytest.raises(carom.CaromError, match="torus: tube: expected a radius below that of the ring"):
        surfaces.torus(0.1, 0.2)
    with pytest.raises(carom.CaromError, match=r"half_axes: expected three lengths"):
        surfaces.ellipsoid((1, 1))
    with pytest.raises(carom.CaromError, match=r"half_axes\[1\]: expected a length > 0, got -1"):
        surfaces.ellipsoid((1, -1, 1))
    run = billiards.roll(surfaces.pipe(0.1), (0.08, 0, 0), (0, 1, 0), ball=BALL, duration=0.1)
    with pytest.raises(carom.CaromError, match=r"at: times: expected times from 0 to 0\.1 s"):
        run.at(0.2)


def test_runs_are_pickled():
    run = billiards.roll(surfaces.hole(), (-0.06, 0.01, 0.02135), (0.6, 0, 0), ball=GOLF, duration=0.5, accuracy=1e-9)
    again = pickle.loads(pickle.dumps(run))
    assert np.array_equal(again.at(0.1).place, run.at(0.1).place)
