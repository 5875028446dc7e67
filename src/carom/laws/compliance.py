"""Shared by the laws of tangential compliance: the parameters that they read, and when they may not apply."""

from __future__ import annotations

import numpy as np

from carom.laws.law import ON_FLOOR, Answer, Meeting, drives_into_floor

__all__ = ["COMPLIANT_READS", "compliant_objections"]

COMPLIANT_READS = ("restitution", "friction", "stiffness_ratio", *ON_FLOOR)


def compliant_objections(meeting: Meeting, answer: Answer) -> list[str]:
    """Return why a law of tangential compliance may not apply."""
    found = drives_into_floor(meeting, answer)
    beta = float(np.max(np.abs(meeting.wall.tangential_restitution)))
    if beta > 0:
        found.append("it models the tangential rebound by springs and ignores this wall's tangential restitution")
    return found
