"""Balls of pooltool 0.6.0 stay on the table; balls of its main branch fly if asked (``is_3d``)."""

from __future__ import annotations

from typing import Any

import numpy as np
from pooltool import constants
from pooltool.objects.ball.datatypes import BallState

from carom.bodies import State


def needed(is_3d: bool) -> Any:
    """Return the answer to main's question to a model: in which of its simulations it may act. 0.6.0 does not ask."""
    from pooltool.physics.dimensionality import Dim

    return Dim.THREE if is_3d else Dim.TWO


def leave(ball: Any, state: State, is_3d: bool) -> None:
    """Give a ball of pooltool's its velocity and spin after a contact, and the motion that follows."""
    rvw = np.array([ball.state.rvw[0], state.velocity, state.spin])
    motion = constants.sliding
    if is_3d and (rvw[1, 2] != 0 or rvw[0, 2] > ball.params.R):
        motion = constants.airborne
    elif not is_3d:
        rvw[1, 2] = 0.0  # (of the size of rounding)
    ball.state = BallState(rvw, motion)
