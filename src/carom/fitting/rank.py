"""Which law the data prefer, by how much, and whether any fits at all."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.checks import expect
from carom.errors import CaromError
from carom.fitting.data import Setting, make_problem, require_settings
from carom.fitting.fit import Fit, fit_law, refit, rows_of_fit
from carom.fitting.kernels import TOGETHER
from carom.fitting.laws import laws_named
from carom.fitting.outliers import Outlier, outliers_of
from carom.fitting.profile import with_bootstrap, with_profiles
from carom.fitting.told import bent
from carom.fitting.ways import STEPS
from carom.rebounds import Rebounds

__all__ = ["Outlier", "Ranked", "Ranking", "fit_laws"]

Array = NDArray[np.float64]
DECIDED, LEANS = 20.0, 3.0  # odds
ENOUGH = 4  # measured numbers for each that is fitted, where the scatter is estimated
UNLIKELY = 1e-3  # a chi^2 that chance gives so rarely is a law that does not fit
# Looks at rows (carom.fitting.data.Problem.work) up to which these are done unasked
PROFILED, PROFILED_AVERAGED, DRAWN, FOLDED, DRAWS = 3e3, 5e3, 3e3, 4e5, 200
FOLDS, MOST_FOLDED, FEW_STEPS = 10, 20_000, 6
Say = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Ranked:
    """A law's fit and its place."""

    fit: Fit
    weight: float
    """Akaike's: its share among all laws that were fitted."""
    score: float
    """Log likelihood of rows that it was not fitted to, a row (cross-validation); NaN where that was left out."""


@dataclass(frozen=True, eq=False)
class Ranking:
    """All laws, best first, and what follows."""

    ranked: tuple[Ranked, ...]
    verdict: str
    """A plain sentence."""
    odds: float
    """Of the best law against the best that does not contain it; infinite where there is no other, NaN where rows without error
    bars are too few."""
    against: str
    fits: bool
    """Whether the best law fits: chi^2 as chance would have it (always so where the scatter was estimated)."""
    enlarge: float
    """By so much all error bars would have to be multiplied for the best law to fit; 1 where it does."""
    outliers: tuple[Outlier, ...]
    notes: tuple[str, ...]
    swayed: bool = False
    """Whether outliers have moved the best law's numbers by several error bars."""

    @property
    def best(self) -> Fit:
        """The first."""
        return self.ranked[0].fit

    @property
    def degenerate(self) -> list[str]:
        """What the data cannot tell, of all laws."""
        return [sentence for one in self.ranked for sentence in one.fit.degenerate]

    def as_dict(self) -> dict[str, object]:
        """For JSON: numbers in full, None where there is none."""
        from carom.fitting.output import as_dict

        return as_dict(self)


def fit_laws(
    rebounds: Rebounds,
    setting: Setting,
    laws: Sequence[str] | None = None,
    *,
    profiles: bool | None = None,
    bootstrap: int | None = None,
    seed: int = 0,
    say: Say | None = None,
) -> Ranking:
    """Fit laws to rebounds and rank them.

    ``laws``: names, all by default. ``profiles`` and ``bootstrap`` (draws): by default where they are cheap. ``say`` is told
    what is being done and how much of all is done, 0 to 1. Raises CaromError for tables and settings that cannot be fitted.
    """
    expect("fit_laws", "rebounds", rebounds, Rebounds)
    expect("fit_laws", "setting", setting, Setting)
    if isinstance(laws, str):
        raise CaromError(f"fit_laws: laws: expected a sequence of names, got {laws!r}; write [{laws!r}]")
    if seed < 0:
        raise CaromError(f"fit_laws: seed: expected a whole number >= 0, got {seed}")
    require_settings(setting)
    if bootstrap is not None and (bootstrap < 0 or bootstrap == 1):
        raise CaromError(f"bootstrap: expected 0 (none) or a number of draws, 2 or more, got {bootstrap}")
    chosen, notes = laws_named(list(laws) if laws else None, rebounds.kind, setting.contact_height == 1.0)
    problem, remarks = make_problem(rebounds, setting)
    notes = [*rebounds.notes, *notes, *remarks]
    notes = [note for note in notes if not note.startswith("no sigma_ columns")]
    tell = say or (lambda _what, _done: None)
    fits = []
    for i, law in enumerate(chosen):
        tell(f"fit {law.name}", i / len(chosen) * 0.6)
        fit = fit_law(law, problem)
        if not math.isfinite(fit.aicc):
            notes.append(f"{law.name}: left out, {fit.k} numbers for {problem.count} measured ones; film more")
            continue
        fits.append(fit)
    if not fits:
        raise CaromError(*(f"{rebounds.source}: {note}" for note in notes))
    fits.sort(key=lambda fit: fit.aicc)
    aicc = np.array([fit.aicc for fit in fits])
    weights = np.exp(-(aicc - aicc[0]) / 2)
    weights /= weights.sum()
    ranked = []
    for i, (fit, weight) in enumerate(zip(fits, weights.tolist(), strict=True)):
        tell(f"error bars of {fit.law.name}", 0.6 + 0.4 * i / len(fits))
        ranked.append(Ranked(_with_error_bars(fit, profiles, bootstrap, seed, i == 0), weight, _score(fit)))
    best = ranked[0].fit
    fits_well, enlarge = _goodness(best)
    odds, rival = _odds(fits, 1.0 if fits_well else enlarge)
    few = rival is not None and any(_too_few(fit) for fit in (best, rival))
    odds = math.nan if few else odds
    tell("outliers", 1.0)
    outliers, said = outliers_of(best)
    verdict = _verdict(fits, odds, rival, fits_well, enlarge)
    swayed = bool(said)
    if swayed:
        which = f"{outliers[0].row} alone sways" if len(outliers) == 1 else f"{len(outliers)} outliers sway"
        verdict = f"{verdict[:-1]}; {which} this: leave out what was no such bounce, or fit with --robust."
    said += [warning for warning in (bent(best),) if warning]
    return Ranking(
        tuple(ranked), verdict, odds, rival.law.name if rival else "",
        fits_well, enlarge, tuple(outliers), tuple(dict.fromkeys([*notes, *said])), swayed,
    )  # fmt: skip


def _heavy(fit: Fit) -> bool:
    return fit.law.code == TOGETHER


def _with_error_bars(fit: Fit, profiles: bool | None, draws: int | None, seed: int, best: bool) -> Fit:
    work = fit.problem.work(_heavy(fit))
    averaged = fit.problem.spins is not None
    if profiles or (profiles is None and work < PROFILED and not averaged):
        fit = with_profiles(fit)
    elif profiles is None and averaged and best and work < PROFILED_AVERAGED:
        # A profile takes as long as the fit; but next to a crease a number may go ten times as far to one side as to the other.
        fit = with_profiles(fit, [name for name in fit.names if not name.startswith("spin_")])
    if draws is None:
        draws = DRAWS if work < DRAWN and not averaged else 0
    return with_bootstrap(fit, draws, seed) if draws and fit.names else fit


def _score(fit: Fit) -> float:
    """Mean log likelihood of a row that was left out, ten folds of every tenth row; but for a constant that all laws share."""
    problem = fit.problem
    n = len(problem.x)
    if problem.work(_heavy(fit)) > FOLDED:
        if n > MOST_FOLDED and not _heavy(fit) and problem.spins is None:
            problem = problem.select(np.linspace(0, n - 1, MOST_FOLDED).astype(int))
            n = len(problem.x)
        else:
            return math.nan
    folds = min(FOLDS, n)
    # neighbours, which tables often have in order of angle or speed, go to different folds
    fold = np.arange(n) % folds
    weights = (fold[None, :] != np.arange(folds)[:, None]).astype(float)
    # a fold is near the whole; where spins are averaged over looks are dear, and few do
    numbers, _cost = refit(fit, problem, weights, most=STEPS if problem.spins is None else FEW_STEPS)
    total = 0.0
    for one in range(folds):
        part = problem.select(np.flatnonzero(fold == one))
        deviance, _least = rows_of_fit(fit, part, numbers[one])
        total -= float(deviance.sum()) / 2
    logs = np.log(problem.vy[0, problem.estimated]) * np.isfinite(problem.y[:, problem.estimated]).sum(axis=0) / 2
    return (total - float(logs.sum())) / n


def _goodness(fit: Fit) -> tuple[bool, float]:
    from scipy.stats import chi2 as distribution

    if fit.dof <= 0 or fit.scatter or fit.problem.nu:
        return True, 1.0
    return bool(distribution.sf(fit.chi2, fit.dof) > UNLIKELY), max(math.sqrt(fit.chi2 / fit.dof), 1.0)


def _too_few(fit: Fit) -> bool:
    """Whether the measured numbers are too few for AICc to mean anything: its correction is derived for errors whose scatter is
    estimated from many more (Hurvich & Tsai 1989 go down to some three a number). Where error bars are given there is none."""
    return bool(fit.scatter) and fit.problem.count < ENOUGH * fit.k


def _contains(law: Fit, other: Fit) -> bool:
    """Whether the other law contains this one."""
    return other.law.name in law.law.within


def _odds(fits: list[Fit], enlarge: float) -> tuple[float, Fit | None]:
    """Of the first against the best that does not contain it, with error bars so much larger."""
    best = fits[0]
    others = [fit for fit in fits[1:] if not _contains(best, fit)]
    if not others:
        return math.inf, None

    def criterion(fit: Fit) -> float:
        return fit.deviance / enlarge**2 + fit.aicc - fit.deviance

    rival = min(others, key=criterion)
    return math.exp(min((criterion(rival) - criterion(best)) / 2, 700.0)), rival


def _verdict(fits: list[Fit], odds: float, rival: Fit | None, fits_well: bool, enlarge: float) -> str:
    best = fits[0]
    first = ""
    if not fits_well:
        first = (
            f"No law fits: the best, {best.law.called}, has chi^2 {best.chi2:.4g} for {best.dof} degrees of"
            f" freedom; error bars would have to be {enlarge:.2g} times as large. With such error bars, "
        )
    bigger = [fit.law.name for fit in fits[1:] if _contains(best, fit) and fit.aicc < best.aicc + 2 * math.log(DECIDED)]
    more = (
        f"; {', '.join(bigger)}, which contain{'s' if len(bigger) == 1 else ''} it, fit{'s' if len(bigger) == 1 else ''} no better"
        if bigger
        else ""
    )
    if math.isnan(odds):
        most = max(fit.k for fit in fits if fit in (best, rival))
        said = (
            f"these data cannot decide: too few rows, {best.problem.count} measured numbers for up to {most} fitted ones, scatter"
            " among them; film more, or give error bars (--sigma-v, --sigma-spin)"
        )
    elif rival is None:
        said = f"the data are described by {best.law.called}; there was no other law to set against it{more}"
    elif odds >= DECIDED:
        said = f"the data prefer {best.law.called}, {to_one(odds)} over {rival.law.name}{more}"
    elif odds >= LEANS:
        said = (
            f"the data lean to {best.law.called}, {to_one(odds)} over {rival.law.name}: not enough to"
            f" decide{more}; carom design says which shot to film next"
        )
    else:
        near = [fit.law.name for fit in fits if fit.aicc < fits[0].aicc + 2 * math.log(LEANS) * enlarge**2]
        if rival.law.name not in near:
            near.append(rival.law.name)
        said = f"these data cannot decide between {', '.join(near[:-1])} and {near[-1]}; carom design says which shot to film next"
    said = first + said if first else said[0].upper() + said[1:]
    return said + "."


def to_one(odds: float) -> str:
    """Odds in words."""
    if odds > 1e6:
        return "more than a million to 1"
    return f"{odds:,.0f} to 1" if odds >= 10 else f"{odds:.1f} to 1"
