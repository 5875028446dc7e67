"""Whether a ball on a table hops off a wall: decided from all contacts with it.

A wall that a ball touches at its centre lifts a ball that rolls into it, by its friction; the nose of a cushion, above the centre,
presses the ball down. The frames of one contact seldom show which, but the hop that a wall at the centre would cause follows from
the spin after the contact, which the fit determines: contacts that are fitted better with this hop than without it, or worse, add
up to a verdict. After hops the velocities after the wall come from a fit with a hop of any length; in doubt they are the mean
of both, weighted with the odds, and their error bars contain the difference.

Between these heights, up to about 1.15 radii above the floor, a wall causes shorter hops. Frames do not distinguish them from none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.tracks.contact import HopVerdict, TrackContact
from carom.tracks.least_squares import ContactFit

__all__ = ["DECISIVE", "averaged", "hop_excess", "hop_notes", "with_hops"]

DECISIVE = 9.2  # sum of the differences of chi2: odds of 100 to 1
MOST = 9.2  # the share of one contact in the sum: it may be mistracked


def with_hops(contacts: Sequence[TrackContact], known: bool | None = None, doubtful: bool = True) -> list[TrackContact]:
    """Return the contacts with the verdict on hops, and with a hop where balls hop; means of both where it is ``doubtful``.

    ``known``: whether balls hop, if that is known.
    """
    walls: dict[str, float] = {}
    for one in contacts:
        walls[one.wall.name] = walls.get(one.wall.name, 0.0) + hop_excess(one)
    together = sum(walls.values())  # walls that do not decide by themselves are taken to be like the others
    if known is not None:
        walls, together = dict.fromkeys(walls, 0.0), -np.inf if known else np.inf
    return [_with_hop(one, walls[one.wall.name], together, doubtful) for one in contacts]


def hop_excess(one: TrackContact) -> float:
    """Return a contact's part of the sum for all: the rise of chi2 by a hop, within MOST."""
    return 0.0 if one.fit is None else float(np.clip(one.fit.hop_chi2, -MOST, MOST))


def _with_hop(one: TrackContact, excess: float, together: float, doubtful: bool) -> TrackContact:
    """Return a contact as it is with a hop, as far as the excess of chi2 of a wall, or of all of them, does not exclude it."""
    excess = excess if abs(excess) >= DECISIVE else together
    hopping = one.fit.hopping if one.fit is not None else None
    if one.fit is None or hopping is None or excess >= DECISIVE:
        return one
    verdict: HopVerdict = "seen" if excess <= -DECISIVE else "possible"
    if verdict == "possible" and not doubtful:
        return one
    share = 1.0 if verdict == "seen" else 1 / (1 + float(np.exp(excess / 2)))
    fit = averaged(one.fit, hopping, share)
    return replace(one, fit=fit, scatter=fit.noise * float(np.sqrt(fit.chi2 / max(fit.dof, 1))), hop=verdict)


def averaged(one: ContactFit, other: ContactFit, share: float) -> ContactFit:
    """Return the mean of two fits with the probability ``share`` of the second; its errors contain the difference between them."""
    gap = np.nan_to_num(other.value - one.value)  # (what one of them does not have stays as it is)
    covariance = one.covariance + share * (other.covariance - one.covariance)
    return replace(
        one if share < 0.5 else other, value=one.value + share * gap,
        covariance=covariance + share * (1 - share) * np.outer(gap, gap), hop_chi2=one.hop_chi2,
    )  # fmt: skip


def hop_notes(contacts: Sequence[TrackContact]) -> list[str]:
    """Return a note for each wall off which balls hop, or may hop."""
    notes = []
    for name in dict.fromkeys(one.wall.name for one in contacts):
        verdicts = {one.hop for one in contacts if one.fit is not None and one.wall.name == name}
        if "seen" in verdicts:
            notes.append(
                f"wall {name}: the ball hops off it; the rebounds are of balls that roll again (`stage` after_wall: as they"
                " leave the wall)"
            )
        elif "possible" in verdicts:
            notes.append(
                f"wall {name}: the frames do not show whether the ball hops off it, as off a wall that it touches at its centre, or"
                " stays down, as under the nose of a cushion: the error bars of the velocity after the wall include both, and the"
                " rebounds are of balls that roll again, which a hop does not affect"
            )
    return notes
