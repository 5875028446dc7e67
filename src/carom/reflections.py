"""The laws that answer at once: `conventional`, `mirror`, `no_slip`; each refuses, with the reason, what it cannot say."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.ball import Ball
from carom.checks import first_index
from carom.errors import CaromError
from carom.law import LAWS, Law, Meeting, respond
from carom.rows import require_approach, unit_normal
from carom.state import State
from carom.surface import Surface
from carom.verbs import WALL

__all__ = ["conventional", "mirror", "no_slip", "reflect"]


def reflect(law: Law, meeting: Meeting) -> State:
    """The state (...) after the wall by a law's kernel; CaromError, a line for each condition that a state does not meet."""
    require_approach(meeting.ball, meeting.state, meeting.normal)
    faults = [
        f"{law.name}: expected {expected}, got another state{first_index(~np.asarray(holds))}"
        for holds, expected in law.conditions(meeting)
        if not np.all(holds)
    ]
    if faults:
        raise CaromError(*faults)
    assert law.kernel is not None  # every built-in law has one
    return respond(law.kernel, meeting)


def conventional(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), restitution: Any = 1.0) -> State:
    """The state (...) after a vertical wall under the conventional law: rolling, at once.

    Source: the paper, (16)-(26). Of the two roots that the hypotheses leave, the one that reverses the slip at the wall;
    the other is the rolling mirror (:func:`carom.laws.conventional.mirror_root`).

    Raises CaromError where a hypothesis fails: the ball must roll on the floor, the wall be vertical, and the
    ``restitution`` be 1. With e < 1 the energy could only be kept if what the normal motion loses went into the motion
    along the wall, from which a ball that comes in square and without spin would have to choose a side.
    """
    if np.any(np.asarray(restitution) != 1):
        raise CaromError(
            f"conventional: restitution: expected 1 (hypothesis 3, the energy is conserved), got {restitution!r};"
            " carom.two_step takes any"
        )
    return reflect(LAWS["conventional"], Meeting(ball, state, unit_normal(normal)))


def mirror(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), surface: Surface = WALL) -> State:
    """The state (...) after a frictionless wall: the normal velocity comes back e times, all else goes on."""
    return reflect(LAWS["mirror"], Meeting(ball, state, unit_normal(normal), surface))


def no_slip(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0)) -> State:
    """The state (...) after a no-slip wall: the contact point's velocity is reversed, the energy conserved.

    Source: Broomhead & Gutkin, Physica D 67, 188 (1993), doi 10.1016/0167-2789(93)90205-F, for discs (:func:`carom.Disc`);
    Garwin, Am. J. Phys. 37, 88 (1969), in space.
    """
    return reflect(LAWS["no-slip"], Meeting(ball, state, unit_normal(normal)))
