"""Laws compared by shots: in how many one is nearer, and by what chance. Frames of a shot are not independent, shots are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.evidence import DECIDED, LEANS, OneFit, RankedLaws

__all__ = ["NearerShots", "RankedByShots", "nearer_shots"]

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
        """What this counts on the scale of odds."""
        if self.chance > HINT or self.closer[0] <= self.closer[1] / 2:
            return 0.0
        return LEANS if self.chance > SURE else DECIDED


def nearer_shots(near: NDArray[np.float64], far: NDArray[np.float64]) -> NearerShots:
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
