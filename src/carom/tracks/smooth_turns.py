"""Contacts that are none: where a ball turns in a smooth curve, as on a curved rail or at the end of a string."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.tracks.contact import TrackContact
from carom.tracks.free_motion import VelocityJump

__all__ = ["SMOOTH_TURN", "certainly_sharp", "turns_smoothly", "without_smooth_turns"]

SMOOTH_TURN = (
    "the ball turns over several frames there, as on a curved rail or at the end of a string; at a wall it turns between two"
    " frames: not used"
)


def without_smooth_turns(contacts: Sequence[TrackContact], scatter: float) -> list[TrackContact]:
    """Return the contacts without those at which the ball turns smoothly, which are none.

    A turn that is neither certainly smooth nor certainly sharp is none either if the frames scatter about the fit by more than
    ``scatter``, m; where the turns at a wall are smooth on the whole, only sharp ones that scatter less remain.
    """
    smooth = {name for name in {one.wall.name for one in contacts} if _smooth_on_the_whole(contacts, name)}
    found = []
    for one in contacts:
        jump = one.jump
        good = jump is None or jump.sharp, one.scatter < scatter
        none = jump is not None and (jump.smooth or not (all(good) if one.wall.name in smooth else any(good)))
        found.append(replace(one, fit=None, why=SMOOTH_TURN) if none and one.fit is not None else one)
    return found


def _smooth_on_the_whole(contacts: Sequence[TrackContact], wall: str) -> bool:
    """Return whether most turns at a wall are smooth, or all of them together."""
    jumps = [one.jump for one in contacts if one.wall.name == wall and one.jump is not None]
    weights = np.array([one.error**-2 for one in jumps])
    if not weights.sum() > 0:
        return False
    share = float(weights @ np.array([one.share if one.error < np.inf else 0.0 for one in jumps]) / weights.sum())
    together = VelocityJump(share, float(weights.sum() ** -0.5))
    return together.smooth or sum(one.smooth for one in jumps) > sum(one.sharp for one in jumps)


def certainly_sharp(contacts: Sequence[TrackContact]) -> bool:
    """Return whether the velocity certainly jumps in most of the measured contacts."""
    jumps = [one.jump for one in contacts if one.fit is not None and one.jump is not None]
    return 2 * sum(one.sharp for one in jumps) > len(jumps)


def turns_smoothly(contacts: Sequence[TrackContact]) -> bool:
    """Return whether some contacts were left out because the ball turns smoothly there."""
    return any(one.why == SMOOTH_TURN for one in contacts)
