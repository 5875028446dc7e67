"""What the laws of tangential compliance share: numbers that they read, and when they may not apply."""

from __future__ import annotations

import numpy as np

from carom.laws.law import ON_FLOOR, Answer, Meeting, drives_into_floor

__all__ = ["COMPLIANT_READS", "compliant_objections"]

COMPLIANT_READS = ("restitution", "friction", "stiffness_ratio", *ON_FLOOR)


def compliant_objections(meeting: Meeting, answer: Answer) -> list[str]:
    """Object where a law of tangential compliance leaves something out."""
    found = drives_into_floor(meeting, answer)
    beta = float(np.max(np.abs(meeting.wall.tangential_restitution)))
    if beta > 0:
        found.append("it has springs in the place of this wall's tangential restitution, which it does not read")
    return found
