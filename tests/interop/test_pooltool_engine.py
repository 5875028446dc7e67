"""carom's laws in pooltool, in numbers alone; whole shots: campaigns/in_pooltool."""

from __future__ import annotations

import importlib.util
import math
import sys
from typing import Any

import numpy as np
import pytest

import carom
import carom.interop.pooltool as interop
from carom.interop.pooltool.physics import after_collision, after_cushion, landed, nose_normal, off_cushion, off_floor

POOLTOOL = importlib.util.find_spec("pooltool") is not None

BALL = carom.Ball(0.028575, 0.170097)
WALL, FLOOR, GRAVITY = carom.Surface(0.85, 0.2), carom.Surface(0.0, 0.2), 9.81
NOSE = 0.036576
RESTING = carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def states(count: int) -> list[carom.State]:
    """Balls on the table, of all directions, speeds and spins."""
    random = np.random.default_rng(7)
    found = []
    for _ in range(count):
        speed, angle = 10 ** random.uniform(-2, 1), random.uniform(0, 2 * math.pi)
        v = np.array([speed * math.cos(angle), speed * math.sin(angle), 0.0])
        found.append(carom.State(v, random.normal(size=3) * speed / BALL.radius))
    return found


@pytest.mark.parametrize("side", [1, -1])
def test_the_normal_points_from_the_nose_to_the_ball(side: int) -> None:
    n = nose_normal((0.0, side), (1.0, 2.0, 0.0), NOSE, BALL.radius)
    # the ball comes along +y, so the cushion lies beyond it; its nose is 8.001 mm above the centre
    assert n[0] == 0
    assert n[1] == pytest.approx(-math.sqrt(1 - (8.001 / 28.575) ** 2), rel=1e-12)
    assert n[2] == pytest.approx(-8.001 / 28.575, rel=1e-12)


@pytest.mark.parametrize("height", [0.0, -0.01, 2 * 0.028575, 1.0])
def test_a_nose_beside_the_ball_is_refused_in_one_line(height: float) -> None:
    with pytest.raises(carom.CaromError, match=r"^pooltool: cushion: expected a nose between 0 and 0\.05715 m.* got"):
        nose_normal((1.0, 0.0), (1.0, 0.0, 0.0), height, BALL.radius)


@pytest.mark.parametrize("nose", [NOSE, BALL.radius])
def test_a_cushion_leaves_the_state_of_two_step_after_the_landing_bit_for_bit(nose: float) -> None:
    lifted = 0
    for state in states(100):
        n = nose_normal((0.6, 0.8), state.velocity, nose, BALL.radius)
        after, flight = after_cushion(carom.LAWS["two-step"], BALL, state, n, WALL, FLOOR, GRAVITY)
        two = carom.two_step(BALL, state, WALL, FLOOR, n, GRAVITY)
        if np.isfinite(two.after_floor.velocity).all():
            assert after == two.after_floor
            assert (flight.height, flight.duration, flight.distance) == (
                two.flight.height, two.flight.duration, two.flight.distance,
            )  # fmt: skip
            lifted += flight.height > 0
        assert abs(after.velocity[2]) <= 1e-15 * np.abs(after.velocity).sum()
    assert lifted > 30 if nose == BALL.radius else lifted < 30


def test_a_ball_that_is_thrown_up_lands_with_the_friction_of_that_impulse() -> None:
    after, flight = landed(BALL, carom.State((1.0, 0.0, 0.5), (0.0, 0.0, 0.0)), FLOOR, GRAVITY)
    # Coulomb: mu times the impulse that stops 0.5 m/s; 2/7 of the slip would end it
    assert after.velocity == pytest.approx((1 - 0.2 * 0.5, 0.0, 0.0))
    assert after.spin == pytest.approx((0.0, 0.2 * 0.5 / (0.4 * BALL.radius), 0.0))
    assert flight.duration == pytest.approx(2 * 0.5 / GRAVITY)
    assert flight.height == pytest.approx(0.5**2 / (2 * GRAVITY))
    assert flight.distance == pytest.approx(flight.duration)


def test_a_ball_that_is_driven_down_lands_without_a_flight() -> None:
    after, flight = landed(BALL, carom.State((1.0, 0.0, -0.5), (0.0, 0.0, 0.0)), FLOOR, GRAVITY)
    assert after.velocity == pytest.approx((0.9, 0.0, 0.0))
    assert (flight.duration, flight.height, flight.distance) == (0, 0, 0)


def test_two_balls_meet_as_in_collide_and_land() -> None:
    surface = carom.Surface(0.95, 0.06)
    striking = carom.State((1.0, 0.2, 0.0), (0.0, 40.0, 30.0))
    (one, two), flights = after_collision(
        BALL, (striking, RESTING), np.array([-1.0, 0.0, 0.0]), surface, FLOOR, GRAVITY
    )
    hit = carom.collide(BALL, striking, BALL, RESTING, (-1.0, 0.0, 0.0), surface)
    for after, before_landing in zip((one, two), hit.after, strict=True):
        down = carom.State((*before_landing.velocity[:2], -abs(before_landing.velocity[2])), before_landing.spin)
        assert after == carom.impact(BALL, down, (0.0, 0.0, 1.0), FLOOR).after
    assert sorted(flight.height > 0 for flight in flights) == [False, True]


def test_balls_that_move_apart_are_left_alone() -> None:
    pair = (carom.State((-1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), RESTING)
    assert after_collision(BALL, pair, np.array([-1.0, 0.0, 0.0]), WALL, FLOOR, GRAVITY)[0] is pair


def test_a_law_that_does_not_hold_says_so_in_one_line() -> None:
    state = carom.State((-1.0, 0.5, 0.0), (0.0, 0.0, 0.0))  # slides, which the conventional law excludes
    with pytest.raises(carom.CaromError, match="needs, got velocity") as caught:
        after_cushion(carom.LAWS["conventional"], BALL, state, np.array([1.0, 0.0, 0.0]), WALL, FLOOR, GRAVITY)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"cushion": "two-stp"}, "law: expected one of .*did you mean 'two-step'"),
        ({"cushion": 3}, "engine: cushion: expected a str, got int 3"),
        ({"wall": (0.8, 0.2)}, "engine: wall: expected a Surface, got tuple"),
        ({"wall": carom.Surface([0.8, 0.9], 0.2)}, "engine: wall: expected one surface, got arrays"),
        ({"ball_ball": "pooltool"}, "engine: ball_ball: expected 'carom' or None"),
        ({"is_3d": "yes"}, "engine: is_3d: expected a bool, got str 'yes'"),
    ],
)
def test_wrong_arguments_are_one_line_each(options: dict[str, Any], said: str) -> None:
    with pytest.raises(carom.CaromError, match=said) as caught:
        interop.engine(**options)
    assert len(caught.value.faults) == 1


@pytest.mark.parametrize("nose", [NOSE, BALL.radius])
def test_where_balls_fly_a_cushion_leaves_the_state_of_two_step_after_the_wall_bit_for_bit(nose: float) -> None:
    floor = carom.Surface(0.5, 0.2)
    rising = 0
    for state in states(100):
        n = nose_normal((0.6, 0.8), state.velocity, nose, BALL.radius)
        after = off_cushion(carom.LAWS["two-step"], BALL, state, n, WALL, floor, GRAVITY)
        two = carom.two_step(BALL, state, WALL, floor, n, GRAVITY)
        if two.after_wall.velocity[2] >= 0:
            assert after == two.after_wall
        assert after.velocity[2] >= 0
        rising += after.velocity[2] > 0
    assert rising > 30 if nose == BALL.radius else rising == 0  # a nose above the centre presses the ball on the cloth


def test_a_law_that_drives_the_ball_down_leaves_the_floor_at_once() -> None:
    down = carom.State((1.0, 0.0, -0.5), (0.0, 0.0, 0.0))
    after = off_floor(BALL, down, carom.Surface(0.5, 0.2))
    # Coulomb: the impulse stops 0.5 m/s and gives 0.25 m/s back
    assert after.velocity == pytest.approx((1 - 0.2 * 0.75, 0.0, 0.25))
    up = carom.State((1.0, 0.0, 0.5), (0.0, 0.0, 0.0))
    assert off_floor(BALL, up, FLOOR) is up


@pytest.mark.skipif(POOLTOOL, reason="pooltool is installed")
@pytest.mark.parametrize("function", [interop.engine, interop.register])
def test_without_pooltool_one_line_says_what_is_needed(function: Any) -> None:
    assert "pooltool" not in sys.modules
    with pytest.raises(carom.CaromError, match=r"needs pooltool 0\.6, which is not installed; .* two commands"):
        function()
