"""Evidence for and against laws: Akaike weights, odds against the strongest rival, and the verdict in words.

The same rule holds for rebounds and whole tracks. The rival of the best law is the best law that does not contain it as a special
case: a law that contains it fits no worse by construction, and is named separately. Odds are exp of half the difference of AICc. If
no law fits, the odds are computed with error bars enlarged until the best law does.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from carom.fitting.laws import FittedLaw

DECIDED, LEANS = 20.0, 3.0  # odds
UNLIKELY = 1e-3  # probability of a chi^2 below which a law does not fit
MOST_LOG_ODDS = 700.0
NO_GAINS: Mapping[str, float] = MappingProxyType({})


def akaike(deviance: float, k: float, n: int, *, corrected: bool = True) -> float:
    """Return Akaike's criterion of k numbers fitted to n, with the correction for few data (Hurvich & Tsai, Biometrika 76, 297
    (1989)), which known errors do not need; infinite where there are too few data."""
    if n <= k + 1:
        return math.inf
    return deviance + 2 * k + (2 * k * (k + 1) / (n - k - 1) if corrected else 0.0)


class FittedModel(Protocol):
    """A fit whose law is compared: to rebounds, or to whole tracks."""

    @property
    def law(self) -> FittedLaw:
        """The law."""

    @property
    def aicc(self) -> float:
        """Akaike's criterion, corrected for few data."""

    @property
    def deviance(self) -> float:
        """-2 log likelihood, up to a constant of the data."""

    @property
    def degenerate(self) -> tuple[str, ...]:
        """Numbers that the data identify in combination only."""

    @property
    def untold(self) -> tuple[str, ...]:
        """Numbers that the data do not identify."""

    def as_dict(self) -> dict[str, Any]:
        """Return the fit for JSON."""


OneFit = TypeVar("OneFit", bound=FittedModel)


@dataclass(frozen=True, eq=False)
class Ranked(Generic[OneFit]):
    """A law's fit with its weight and score in a ranking.

    Examples
    --------
    ``fit_laws(...).ranked[0]`` is that of the best law:

    >>> from carom.fitting import Ranked
    >>> list(Ranked.__dataclass_fields__)
    ['fit', 'weight', 'score']
    """

    fit: OneFit
    """The fit of the law."""
    weight: float
    """Akaike weight among all laws that were fitted."""
    score: float = math.nan
    """Log likelihood per row of rows that it was not fitted to (cross-validation); NaN where there is none, and a note says so.
    Whole tracks have none."""


@dataclass(frozen=True, eq=False)
class RankedLaws(Generic[OneFit]):
    """All laws, best first, and the verdict: what rankings of fits to rebounds and to whole tracks have in common."""

    ranked: tuple[Ranked[OneFit], ...]
    verdict: str
    """Which law, by what odds, whether it fits, and for which contacts, in words."""
    odds: float
    """Of the best law against the best that does not contain it; infinite where there is no other, NaN where odds mean nothing:
    rows without error bars are too few, or have no velocity along the wall and no spin, or no law follows the tracks."""
    against: str
    """Name of that other law."""
    notes: tuple[str, ...]

    def __repr__(self) -> str:
        """Return one line: the laws, best first, and how far each law's AICc is above the lowest."""
        others = [f"{one.fit.law.name} {one.fit.aicc - self.best.aicc:+.1f}" for one in self.ranked[1:]]
        return f"<{type(self).__name__}: AICc {', '.join([f'{self.best.law.name} {self.best.aicc:.1f}', *others])}>"

    @property
    def best(self) -> OneFit:
        """The best fit."""
        return self.ranked[0].fit

    @property
    def sentence(self) -> str:
        """The first sentence of the verdict: which law, by what odds, and what is to be said against it."""
        return re.split(r"(?<=\.) (?=[A-Z])", self.verdict, maxsplit=1)[0]

    @property
    def degenerate(self) -> list[str]:
        """Sentences on parameters that are not identifiable, for all laws."""
        return [sentence for one in self.ranked for sentence in one.fit.degenerate]

    @property
    def aicc_note(self) -> str:
        """The reference of the differences of AICc in tables and reports."""
        return f"ΔAICc: AICc above that of {self.best.law.name}, {self.best.aicc:.1f}."

    def as_dict(self) -> dict[str, Any]:
        """Return the ranking for JSON: numbers in full precision, None where there is none."""
        return {
            "ranking": [one.fit.as_dict() | {"weight": one.weight} for one in self.ranked],
            "degenerate": [
                {"law": one.fit.law.name, "parameters": list(one.fit.untold), "what": sentence}
                for one in self.ranked
                for sentence in one.fit.degenerate
            ],
            "verdict": self.verdict,
            "sentence": self.sentence,
            "odds": float(self.odds) if math.isfinite(self.odds) else None,
            "against": self.against or None,
            "notes": list(self.notes),
        }


@dataclass(frozen=True, eq=False)
class Evidence:
    """Comparison of fits in the order of AICc."""

    weights: NDArray[np.float64]
    """Akaike weights."""
    odds: float
    """Odds of the best law against its rival; infinite if there is none, NaN if they are meaningless."""
    rival: Any
    containing: tuple[str, ...]
    """Laws that contain the best one and fit about as well."""
    close: tuple[str, ...]
    """Laws between which the data do not decide."""


def weigh(fits: Sequence[FittedModel], enlarge: float = 1.0, gains: Mapping[str, float] = NO_GAINS) -> Evidence:
    """Compare fits in the order of AICc, with error bars ``enlarge`` times as large; ``gains``: what the AICc of each law falls by
    with its own best forms."""

    def criterion(fit: FittedModel) -> float:
        return (fit.deviance - gains.get(fit.law.name, 0.0)) / enlarge**2 + fit.aicc - fit.deviance

    best = fits[0]
    aicc = np.array([fit.aicc for fit in fits])
    weights = np.exp(-(aicc - aicc[0]) / 2)
    containing = [fit for fit in fits[1:] if fit.law.name in best.law.within]
    others = [fit for fit in fits[1:] if fit.law.name not in best.law.within]
    rival = min(others, key=criterion, default=None)
    log_odds = math.inf if rival is None else (criterion(rival) - criterion(best)) / 2
    near = [fit.law.name for fit in fits if fit.aicc < aicc[0] + 2 * math.log(LEANS) * enlarge**2]
    near += [rival.law.name] if rival is not None and rival.law.name not in near else []
    return Evidence(
        weights / weights.sum(), math.inf if rival is None else math.exp(min(log_odds, MOST_LOG_ODDS)), rival,
        tuple(fit.law.name for fit in containing if fit.aicc < aicc[0] + 2 * math.log(DECIDED)), tuple(near),
    )  # fmt: skip


def widened(
    evidence: Evidence, fits: Sequence[FittedModel], others: Sequence[FittedModel], enlarge: float = 1.0
) -> Evidence:
    """Return the evidence with odds no larger than under other assumptions: ``others`` are fits of the same laws."""
    if evidence.rival is None or not others:
        return evidence
    under = {fit.law.name: fit for fit in others}
    if any(fit.law.name not in under for fit in (fits[0], evidence.rival)):
        return evidence
    best, rival = under[fits[0].law.name], under[evidence.rival.law.name]
    ahead = (rival.deviance - best.deviance) / enlarge**2 + (rival.aicc - rival.deviance) - (best.aicc - best.deviance)
    odds = math.exp(min(ahead / 2, MOST_LOG_ODDS))
    return replace(evidence, odds=min(evidence.odds, odds))


def verdict_words(
    called: str, evidence: Evidence, subject: str, support: float, reason: str, *, nearest: bool = False, narrow: str = ""
) -> str:  # fmt: skip
    """Return the verdict in words: ``subject`` (the data, the tracks) favour a law, weakly favour it, or do not decide.

    ``support``: odds, or a number on their scale; ``reason``: the lead of the best law, in words. ``nearest``: no law fits, and
    the best is only the nearest one; ``narrow``: why the data cover too little to decide.
    """
    more, these = "", subject.replace("the ", "these ")
    if evidence.containing:
        s = "s" if len(evidence.containing) == 1 else ""
        more = f"; {', '.join(evidence.containing)}, which contain{s} it, fit{s} no better"
    if evidence.rival is None:
        only = f"{called} is the only law that was compared{f': {reason}' if reason else ''}"
        fits = f"{subject} are described by {called}; there was no other law to compare it with"
        return f"{only if reason or nearest else fits}{more}"
    if nearest and support >= LEANS:
        return f"{called} is nearest to {subject}, {reason}{more}"
    if support >= DECIDED and narrow:
        return f"{subject} lean to {called}, {reason}{more}, but {narrow}: film other contacts before you decide"
    if support >= DECIDED:
        return f"{subject} prefer {called}, {reason}{more}"
    if support >= LEANS:
        return f"{subject} lean to {called}, {reason}: not enough to decide{more}; carom design says which shot to film next"
    near = evidence.close
    return f"{these} cannot decide between {', '.join(near[:-1])} and {near[-1]}; carom design says which shot to film next"


def odds_in_words(odds: float) -> str:
    """Return odds as N to 1."""
    if odds > 1e6:
        return "more than a million to 1"
    return f"{odds:,.0f} to 1" if odds >= 10 else f"{odds:.1f} to 1"
