"""Filmed shots as the independent data: laws compared by shots, in how many one is nearer and by what chance, and error bars by
the scatter of shots. (Frames of a shot are not independent.)"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.evidence import DECIDED, LEANS, Evidence, OneFit, Ranked, RankedLaws
from carom.formatting import format_length

__all__ = ["ComparedByShots", "NearerShots", "RankedByShots", "compared_by_shots", "covariance_by_shot", "nearer_shots"]

Array = NDArray[np.float64]
NOTHING_LEFT = 1e-9  # share of the information that the other shots have
# Probabilities of such a difference between laws that are equally good (Wilcoxon's signed ranks)
SURE, HINT = 0.01, 0.1


class NearerShots(NamedTuple):
    """A law against another, shot by shot."""

    closer: tuple[int, int]
    """Shots in which it is nearer, and shots in all."""
    chance: float
    """Probability of such a difference between equally good laws."""

    @property
    def support(self) -> float:
        """Weight of this difference on the scale of odds."""
        if self.chance > HINT or self.closer[0] <= self.closer[1] / 2:
            return 0.0
        return LEANS if self.chance > SURE else DECIDED


def nearer_shots(near: Array, far: Array) -> NearerShots:
    """Compare the distances (N,) of a law and of another in the same shots, by Wilcoxon's signed-rank test on their ratios."""
    from scipy.stats import wilcoxon

    ratio = np.log(np.maximum(far, 1e-12) / np.maximum(near, 1e-12))
    chance = float(wilcoxon(ratio).pvalue) if len(ratio) > 1 and np.any(ratio != 0) else 1.0
    return NearerShots((int((ratio > 0).sum()), len(ratio)), chance)


@dataclass(frozen=True, eq=False, repr=False)
class RankedByShots(RankedLaws[OneFit]):
    """All laws fitted to filmed shots, best first, and the verdict: what rankings of whole tracks and whole shots share."""

    closer: tuple[int, int] | None
    """Shots in which the best law is nearer than that one, and shots in all."""
    chance: float
    """Probability of such a difference between equally good laws (Wilcoxon's signed-rank test on the distances of shots)."""
    decisive: bool = False
    """Whether the verdict is a decision."""


class ComparedByShots(NamedTuple):
    """Laws compared by shots."""

    fields: dict[str, Any]
    """Of :class:`RankedByShots`: ranked, against, closer, chance."""
    support: float
    """For the best law, on the scale of odds."""
    reason: str
    """In words; empty without a rival."""


def compared_by_shots(
    fits: Sequence[OneFit], evidence: Evidence, distances: Callable[[OneFit], Array]
) -> ComparedByShots:
    """Compare the best of fits with its rival; ``distances``: of a fit to each shot (N,), m."""
    rival = evidence.rival
    fields: dict[str, Any] = {
        "ranked": tuple(map(Ranked, fits, evidence.weights.tolist())), "against": "", "closer": None, "chance": math.nan
    }  # fmt: skip
    if rival is None:
        return ComparedByShots(fields, evidence.odds, "")
    near, far = distances(fits[0]), distances(rival)
    found, medians = nearer_shots(near, far), [format_length(float(np.median(one))) for one in (near, far)]
    reason = f"nearer than {rival.law.name} in {found.closer[0]} of {found.closer[1]} shots"
    return ComparedByShots(
        fields | found._asdict() | {"against": rival.law.name}, found.support, f"{reason} (median {' against '.join(medians)})"
    )  # fmt: skip


def covariance_by_shot(information: Array, scores: Array, by_shot: Array) -> Array:
    """Return the covariance (P, P) from the scatter of shots: their scores (N, P) and information (N, P, P), whose sum is given.

    Each score is corrected for how much of the information is the shot's own (CR2 of Bell & McCaffrey 2002).
    """
    root = np.linalg.inv(np.linalg.cholesky(information))
    moved = []
    for score, own in zip(scores, by_shot, strict=True):
        share, along = np.linalg.eigh(root @ own @ root.T)
        left = 1 - np.clip(share, 0.0, 1.0)
        # (a wall that only this shot meets: nothing is left, and the score of the other shots is zero)
        factor = np.divide(1.0, np.sqrt(left), out=np.zeros_like(left), where=left > NOTHING_LEFT)
        moved.append(root.T @ (along @ (factor * (along.T @ (root @ score)))))
    return np.asarray(np.array(moved).T @ np.array(moved))
