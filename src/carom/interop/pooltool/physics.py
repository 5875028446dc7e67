"""Impacts of a ball on a cushion of pooltool's, and of two balls, in numbers alone: pooltool is not imported here.

pooltool 0.6 has no gravity: a ball that a cushion lifts would rise for ever, and its own laws of cushions set the vertical velocity
to zero. Here the ball lands at once, with the impulse that the floor gives it at the end of its flight, and the flight is reported.
pooltool's main branch lets balls fly (``is_3d``): there the ball leaves with its vertical velocity, and ``off_floor`` lands it.
"""

from __future__ import annotations

import importlib.util
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, State, Surface
from carom.core.motion.phases import ROUNDING
from carom.errors import CaromError, MissingLibraryError
from carom.laws.contact import impact
from carom.laws.landing import Flight
from carom.laws.law import Answer, Law, Meeting
from carom.laws.pair import collide

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
    answer = _answer(law, ball, state, normal, wall, floor, gravity)
    if answer.steps is not None and np.isfinite(answer.steps.after_floor.velocity).all():
        return answer.steps.after_floor, answer.steps.flight
    return landed(ball, _after_wall(law, answer, state, normal), floor, gravity)


def off_cushion(
    law: Law, ball: Ball, state: State, normal: Array, wall: Surface, floor: Surface, gravity: float
) -> State:
    """Return the state with which a ball leaves a cushion, for a simulation in which balls fly.

    Of the two-step law it is :attr:`carom.TwoStep.after_wall`. A ball that another law drives into the floor meets it at once.

    Raises CaromError as :func:`after_cushion`.
    """
    answer = _answer(law, ball, state, normal, wall, floor, gravity)
    return off_floor(ball, _after_wall(law, answer, state, normal), floor)


def off_floor(ball: Ball, state: State, floor: Surface) -> State:
    """Return the state after the floor of a ball that touches it: a new one if it moves down, else the same."""
    return impact(ball, state, UP, floor).after if state.velocity[2] < 0 else state


def _answer(law: Law, ball: Ball, state: State, normal: Array, wall: Surface, floor: Surface, gravity: float) -> Answer:
    meeting = Meeting(ball, state, normal, wall, floor, gravity)
    for condition in law.conditions(meeting):
        if not np.all(condition.holds):
            raise CaromError(
                f"pooltool: cushion: expected {condition.expected}, which the law {law.name} needs, got velocity"
                f" {state.velocity.tolist()}, spin {state.spin.tolist()}, normal {normal.tolist()}; two-step needs no such thing"
            )
    return law.answer(meeting)


def _after_wall(law: Law, answer: Answer, state: State, normal: Array) -> State:
    if not np.isfinite(answer.after_wall.velocity).all():
        raise CaromError(
            f"pooltool: cushion: expected an answer of the law {law.name}, got none for velocity {state.velocity.tolist()},"
            f" spin {state.spin.tolist()}, normal {normal.tolist()}; use another law for this shot"
        )
    return answer.after_wall


def after_collision(
    ball: Ball, states: tuple[State, State], normal: Array, surface: Surface, floor: Surface, gravity: float
) -> tuple[tuple[State, State], tuple[Flight, Flight]]:
    """Return the states of two balls of one kind after they have met and landed, and their flights.

    The normal (3,) points from the second ball to the first, as in :func:`carom.collide`. Balls that move apart stay as they are.
    """
    none = Flight(0.0, 0.0, 0.0)
    if apart(states, normal):
        return states, (none, none)
    found = collide(ball, states[0], ball, states[1], normal, surface).after
    one, two = (landed(ball, state, floor, gravity) for state in found)
    return (one[0], two[0]), (one[1], two[1])


def apart(states: tuple[State, State], normal: Array) -> bool:
    """Return whether two balls move apart; the normal (3,) points from the second to the first."""
    v1, v2 = states[0].velocity, states[1].velocity
    size = float((np.abs(v1) + np.abs(v2)).sum()) * float(np.linalg.norm(normal))
    return float((v1 - v2) @ normal) > ROUNDING * size


# ----------------------------------------------------------------------------------------------------
# Which pooltool is installed. The main branch calls itself 0.6.0, as the release does; only main has an engine with ``is_3d``.


VERSION = "0.6"
MAIN_MODULE = "pooltool.evolution.engine"


def require_pooltool(needed_by: str) -> Any:
    """Return pooltool. MissingLibraryError, one line, where it is not installed; CaromError where it is of another version."""
    if importlib.util.find_spec("pooltool") is None:
        raise MissingLibraryError(
            f"{needed_by}: needs pooltool {VERSION}, which is not installed; carom's page 'From pooltool to carom' has two"
            " commands that install it"
        )
    try:
        import pooltool
    except ImportError as error:
        raise MissingLibraryError(
            f"{needed_by}: cannot import pooltool: {error}; install what it names with pip"
        ) from None
    found = str(getattr(pooltool, "__version__", "unknown"))
    if not found.startswith(f"{VERSION}."):
        raise CaromError(
            f"{needed_by}: expected pooltool {VERSION}, got {found}; pip install --no-deps pooltool-billiards==0.6.0"
        )
    return pooltool


def has_flights() -> bool:
    """Return whether the pooltool that is installed lets balls fly, as its main branch does."""
    return importlib.util.find_spec(MAIN_MODULE) is not None
