"""Whether the floor of a film from above has friction: decided from all contacts, as hops are.

A ball that rolls into a wall leaves it sliding, and the friction of the floor slows it down and turns it. On an air table, ice or
wet glass it goes straight on at constant speed. Each contact is fitted in both ways (:mod:`carom.tracks.contact_models`), and the
differences of chi2 add up to a verdict; in doubt the velocities are means of both, and their error bars contain the difference.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.tracks.contact import TrackContact
from carom.tracks.floor import DECISIVE, averaged
from carom.tracks.plausibility import restitutions_in_words


def on_either_floor(
    sliding: Sequence[TrackContact], straight: Sequence[TrackContact], excess: float
) -> tuple[list[TrackContact], list[str]]:
    """Return contacts that are fitted with and without friction of the floor, as its verdict has them, and a note on it.

    ``excess``: by how much all of them together are fitted worse with friction, which is not certain.
    """
    straight = [replace(one, friction_excess=its.friction_excess) for one, its in zip(straight, sliding, strict=True)]
    if excess >= DECISIVE:
        return straight, [
            "the floor has no friction, as of an air table: the ball goes straight on at constant speed where friction would"
            " slow it down after a wall; its spin is unknown (`floor_friction` gives one)"
        ]
    likelier, other = (straight, sliding) if excess > 0 else (sliding, straight)
    share = 1 / (1 + float(np.exp(abs(excess) / 2)))
    mixed = [
        replace(one, fit=averaged(one.fit, its.fit, share)) if one.fit is not None and its.fit is not None else one
        for one, its in zip(likelier, other, strict=True)
    ]
    told = [f"{restitutions_in_words(some)} {how} friction" for some, how in ((sliding, "with"), (straight, "without"))]
    return mixed, [
        f"the frames do not show whether the floor has friction: out/in is {told[0]}, {told[1]}; the velocities after the contacts"
        " are means of both, and their error bars contain the difference (`floor_friction` 0, as of an air table, or 0.2 decides)"
    ]
