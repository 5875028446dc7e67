"""The state after a wall under a law given by a kernel; an error with the reason where the law does not apply."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import Ball, State, Surface
from carom.errors import CaromError
from carom.laws.arrays import bad_row, require_approach, unit_normal
from carom.laws.law import Law, Meeting, holds_everywhere, respond

__all__ = ["reflect"]


def reflect(law: Law, ball: Ball, state: State, normal: ArrayLike, surface: Surface) -> State:
    """Return the state (...) after the wall by a law's kernel; CaromError, one line per condition that fails."""
    meeting = Meeting(ball, state, unit_normal(normal), surface)
    require_approach(meeting.ball, meeting.state, meeting.normal)
    faults = [
        f"{law.name}: expected {expected}, got another state{bad_row(~np.asarray(holds))}"
        for holds, expected, *_field in law.conditions(meeting)
        if not holds_everywhere(holds)
    ]
    if faults:
        raise CaromError(*faults)
    assert law.kernel is not None  # all laws that are called here have one
    return respond(law.kernel, meeting)
