"""What carom does with a ball at a cushion of pooltool's, or with two balls, in numbers alone: pooltool is not imported here.

pooltool 0.6, and its main branch unless it is asked for three dimensions, has no gravity: a ball that a cushion lifts would rise
for ever, and its own laws of cushions set the vertical velocity to zero. There the ball lands at once, with the impulse that the
floor gives it at the end of its flight, and the flight is reported. In three dimensions it flies.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, State, Surface
from carom.core.motion.phases import ROUNDING
from carom.errors import CaromError
from carom.laws.contact import impact
from carom.laws.law import Law, Meeting
from carom.laws.pair import collide
from carom.laws.results import Flight

__all__ = ["after_collision", "after_cushion", "bounced", "landed", "lifted_by_cushion", "nose_normal"]

Array = NDArray[np.float64]
UP = (0.0, 0.0, 1.0)


def nose_normal(level: ArrayLike, velocity: ArrayLike, nose_height: float, radius: float) -> Array:
    """Return the normal (3,) from the nose of a cushion to the centre of a ball on the table.

    Parameters
    ----------
    level : array (2,) or (3,)
        Horizontal direction at right angles to the cushion, of unit length, on either side: the ball comes against the normal.
    velocity : array (3,)
        Of the ball, m/s.
    nose_height, radius : float
        m, above the table.

    Raises CaromError for a nose above or below the ball.
    """
    c = (radius - nose_height) / radius
    if not abs(c) < 1:
        raise CaromError(
            f"pooltool: cushion: expected a nose between 0 and {2 * radius:g} m, where it meets the ball, got"
            f" {nose_height:g} m; give the table cushions of another height"
        )
    x, y = np.asarray(level, dtype=float)[:2].tolist()
    vx, vy = np.asarray(velocity, dtype=float)[:2].tolist()
    s = math.sqrt(1 - c * c) * (1 if x * vx + y * vy <= 0 else -1)
    return np.array([s * x, s * y, c])


def landed(ball: Ball, state: State, floor: Surface, gravity: float) -> tuple[State, Flight]:
    """Return the state after the landing of a ball that leaves the floor with (v, w), or is pressed into it; and the flight."""
    x, y, z = state.velocity.tolist()
    if z == 0:
        return state, Flight(0.0, 0.0, 0.0)
    after = impact(ball, State((x, y, -abs(z)), state.spin), UP, floor).after
    t = 2 * z / gravity if z > 0 else 0.0
    return after, Flight(t, z * z / (2 * gravity) if z > 0 else 0.0, t * math.hypot(x, y))


def after_cushion(
    law: Law, ball: Ball, state: State, normal: Array, wall: Surface, floor: Surface, gravity: float
) -> tuple[State, Flight]:
    """Return the state after a cushion and the first landing, and the flight between them.

    Of the two-step law it is :attr:`carom.TwoStep.after_floor`, to the last bit. A ball that would meet the cushion again before
    it lands is landed where it is.

    Raises CaromError where the law does not hold for this ball and cushion, or has no answer.
    """
    meeting = Meeting(ball, state, normal, wall, floor, gravity)
    for condition in law.conditions(meeting):
        if not np.all(condition.holds):
            raise CaromError(
                f"pooltool: cushion: expected {condition.expected}, which the law {law.name} needs, got velocity"
                f" {state.velocity.tolist()}, spin {state.spin.tolist()}, normal {normal.tolist()}; two-step needs no such thing"
            )
    answer = law.answer(meeting)
    if answer.steps is not None and np.isfinite(answer.steps.after_floor.velocity).all():
        return answer.steps.after_floor, answer.steps.flight
    if not np.isfinite(answer.after_wall.velocity).all():
        raise CaromError(
            f"pooltool: cushion: expected an answer of the law {law.name}, got none for velocity {state.velocity.tolist()},"
            f" spin {state.spin.tolist()}, normal {normal.tolist()}; use another law for this shot"
        )
    return landed(ball, answer.after_wall, floor, gravity)


def lifted_by_cushion(
    law: Law, ball: Ball, state: State, normal: Array, wall: Surface, floor: Surface, gravity: float, height: float
) -> State:
    """Return the state just after a cushion, in three dimensions: a ball that it lifts is in the air.

    ``height`` is that of the ball above the table, m. Raises CaromError where the law has no answer.
    """
    answer = law.answer(Meeting(ball, state, normal, wall, floor, gravity, height))
    if not np.isfinite(answer.after_wall.velocity).all():
        raise CaromError(
            f"pooltool: cushion: expected an answer of the law {law.name}, got none for velocity {state.velocity.tolist()},"
            f" spin {state.spin.tolist()}, normal {normal.tolist()}; use another law for this shot"
        )
    return answer.after_wall


def bounced(ball: Ball, state: State, floor: Surface, least_hop: float, gravity: float) -> State:
    """Return the state after a ball has met the table; a hop of less than ``least_hop`` (m) is none."""
    after = impact(ball, state, UP, floor).after
    x, y, z = after.velocity.tolist()
    return State((x, y, 0.0 if z * z < 2 * gravity * least_hop else z), after.spin)


def after_collision(
    ball: Ball, states: tuple[State, State], normal: Array, surface: Surface, floor: Surface, gravity: float
) -> tuple[tuple[State, State], tuple[Flight, Flight]]:
    """Return the states of two balls of one kind after they have met and landed, and their flights.

    The normal (3,) points from the second ball to the first, as in :func:`carom.collide`. Balls that move apart stay as they are.
    """
    none = Flight(0.0, 0.0, 0.0)
    v1, v2 = states[0].velocity, states[1].velocity
    if float((v1 - v2) @ normal) > ROUNDING * float((np.abs(v1) + np.abs(v2)).sum()) * float(np.linalg.norm(normal)):
        return states, (none, none)
    found = collide(ball, states[0], ball, states[1], normal, surface).after
    one, two = (landed(ball, state, floor, gravity) for state in found)
    return (one[0], two[0]), (one[1], two[1])
