"""The blind time: for how long before and after a contact the frames do not show free motion.

A wall that gives way affects the frames of the contact itself, a tracker that smooths some frames after it. There the residuals
across the wall are large. Their start and end are a change point: bins next to the contact in which half of the residuals exceed a
threshold, beyond them as many as far away. If there is one, it is the mean of those of greatest likelihood in contacts drawn
with replacement, because residuals of one contact are not independent, each draw weighted by the prior that long blind times are
rare. Few contacts often have a second maximum far out, which so moves their mean little.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.tracks.contact import TrackContact

__all__ = ["BlindTime", "estimate_blind_time"]

Array = NDArray[np.float64]
BINS = 40  # of half a frame
FAR_FRAMES, MIN_FAR = 5.0, 50  # residuals beyond so many frames show the usual scatter; so many are needed
USUAL_QUANTILE, EXCEEDS = 0.8, 1.8  # a residual is large if it exceeds this quantile of the usual ones so many times
# (of a few contacts, large residuals may come from a floor unlike the literature's)
MIN_CONTACTS = 10
LARGE_SHARE = 0.5  # of the residuals within the blind time
MIN_SHARE = 0.02  # of large residuals far away, at least
DECISIVE = 6.0  # log likelihood ratio from which a blind time is taken to exist
DRAWS = 200
USUAL_BINS = 8.0  # four frames: mean of the exponential prior of the blind time


class BlindTime(NamedTuple):
    """Time before and after a contact, s, with standard deviations."""

    before: float = 0.0
    after: float = 0.0
    before_error: float = 0.0
    after_error: float = 0.0


def estimate_blind_time(contacts: Sequence[TrackContact], interval: float) -> BlindTime:
    """Estimate the blind time from the residuals of fits to all frames; ``interval``: between frames, s."""
    parts = [(one.fit.time - one.fit["t"], np.abs(one.fit.residuals[:, 0])) for one in contacts if one.fit is not None]
    if len(parts) < MIN_CONTACTS:
        return BlindTime()
    far = np.concatenate([size[np.abs(t) > FAR_FRAMES * interval] for t, size in parts])
    if len(far) < MIN_FAR:
        return BlindTime()
    limit = EXCEEDS * float(np.quantile(far, USUAL_QUANTILE))
    usual = min(max(float((far > limit).mean()), MIN_SHARE), LARGE_SHARE / 2)
    gains = np.log(LARGE_SHARE / usual), np.log((1 - LARGE_SHARE) / (1 - usual))
    weights = np.random.default_rng(0).multinomial(len(parts), np.full(len(parts), 1 / len(parts)), DRAWS)
    found, errors = [], []
    for sign in (-1, 1):
        # (contacts, BINS) by how much the likelihood of each bin's residuals is greater within the blind time
        gain = np.zeros((len(parts), BINS))
        for row, (t, size) in zip(gain, parts, strict=True):
            k = np.floor(2 * sign * t / interval).astype(int)
            here = (sign * t >= 0) & (k < BINS)
            np.add.at(row, k[here], np.where(size[here] > limit, *gains))
        exists = _change_point(gain.sum(axis=0)) > 0
        drawn = np.array([_change_point(row, -np.inf if exists else DECISIVE) for row in weights @ gain])
        prior = np.exp(-drawn / USUAL_BINS)
        middle = float(np.average(drawn, weights=prior)) if exists else 0.0
        found.append(middle / 2 * interval)
        errors.append(float(np.average((drawn - middle) ** 2, weights=prior)) ** 0.5 / 2 * interval)
    return BlindTime(*found, *errors)


def _change_point(gain: Array, decisive: float = DECISIVE) -> int:
    """Return how many bins belong to the blind time; 0 unless the log likelihood gains more than ``decisive``."""
    total = np.concatenate([[0.0], np.cumsum(gain)])
    best = int(np.argmax(total))
    return best if total[best] > decisive else 0
