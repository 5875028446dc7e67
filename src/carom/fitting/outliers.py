"""Outliers: rows that a law does not explain, found by a robust fit that they do not bias."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.evidence import DECIDED, UNLIKELY
from carom.fitting.fit import fit_law, place_near
from carom.fitting.model import predict_law
from carom.fitting.result import Fit, rows_of_fit

__all__ = ["Outlier", "OutlierSearch", "heavy_tails", "outliers_of"]

Array = NDArray[np.float64]
FALSE_ALARM = 0.05  # probability of an outlier by chance among all rows
STEADY_ROWS = 150  # of many, to which the robust fit is made
LEAST_ROWS = 8  # for the search of outliers
MOST_OUTLIERS = 0.1  # of the rows: with more, errors are not those of a law that fits but for a few rows
NEARLY = (
    0.85  # of the limit of chi^2: a row above it is judged by the fit itself, and not by the place of a shorter search
)
MOVED_SIGMA = 3.0  # shift of a parameter, in error bars, that is reported


@dataclass(frozen=True)
class Outlier:
    """A row that the best law does not explain.

    Examples
    --------
    >>> from carom.fitting import Outlier
    >>> Outlier("line 7", 31.2, "v_n after the wall is off by 0.3").row
    'line 7'
    """

    row: str
    """Label of the row."""
    chi2: float
    """chi^2 of the row."""
    why: str
    """Which measurement is off, and by how much."""


@dataclass(frozen=True)
class OutlierSearch:
    """The outliers of a fit, worst first."""

    rows: tuple[Outlier, ...] = ()
    notes: tuple[str, ...] = ()
    """On parameters that the outliers have changed."""
    rest_fits: bool = False
    """Whether the outliers are few, and the law fits the other rows."""


def outliers_of(fit: Fit) -> OutlierSearch:
    """Return the rows whose chi^2 occurs by chance in fewer than one of twenty such tables.

    chi^2 is computed with the parameters of a robust fit (Student's t): an ordinary fit is biased by the outliers, and finds none
    if a single row determines a parameter. If the robust fit has other parameters, a note lists them.
    """
    from scipy.special import chdtrc, chdtri

    problem = fit.problem
    d = np.isfinite(problem.y).sum(axis=1)
    if len(d) < LEAST_ROWS or not d.any():
        return OutlierSearch()

    def judged(p: Array, share: float = 1.0) -> tuple[Array, list[int]]:
        """Return chi^2 of the rows with numbers p, and the rows where it is above a share of the limit, worst first."""
        chi2 = rows_of_fit(fit, problem, p)[1]
        # if no law fits, a row is an outlier relative to the others, since the error bars are too small for all rows
        scale = max(float(np.median(chi2[d > 0] / chdtri(d[d > 0], 0.5))), 1.0)
        limit = share * scale * chdtri(np.maximum(d, 1), FALSE_ALARM / len(d))
        return chi2, sorted(np.flatnonzero((d > 0) & (chi2 > limit)).tolist(), key=lambda i: -chi2[i])

    steady = fit
    if not problem.estimated.any() and not problem.nu and fit.names:
        # (the scatter between contacts, if it was fitted, is in the error bars; of many rows some tell the parameters well enough)
        few = problem.some(STEADY_ROWS)
        robust = replace(few, setting=replace(problem.setting, robust=True, scatter=""))
        if problem.spins is not None and not judged(place_near(fit.law, robust, fit.numbers), NEARLY)[1]:
            return OutlierSearch()
        steady = fit_law(fit.law, robust)
    chi2, found = judged(steady.numbers)
    gap = problem.y - predict_law(fit.law, problem, steady.numbers)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # (an error bar's square may be 0)
        size = np.abs(gap) / np.sqrt(problem.vy)
    names = problem.rebounds.rows or tuple(f"row {i + 1}" for i in range(len(d)))
    what = ("v_n", "v_t", "spin")
    rows = []
    for i in found:
        worst = int(np.nanargmax(size[i]))
        why = (
            "with any likely spin"
            if problem.unknown[i]
            else f"{what[worst]} after the wall is off by {gap[i][worst]:.3g}"
        )
        rows.append(Outlier(names[i], float(chi2[i]), why))
    if not found:
        return OutlierSearch()
    rest = float(np.delete(chi2, found).sum()), int(np.delete(d, found).sum()) - len(fit.names)
    fits = len(found) <= max(1, MOST_OUTLIERS * len(d)) and rest[1] > 0 and chdtrc(rest[1], rest[0]) > UNLIKELY
    return OutlierSearch(tuple(rows), tuple(_moved(fit, steady, rows)), bool(fits))


def heavy_tails(fit: Fit, problem: Problem) -> bool:
    """Return whether Student's t describes the errors better than a normal distribution by odds of 20 to 1, under the fit's law.

    ``problem``: the rows, with error bars. The constants of the two densities are included, which deviances omit.
    """
    if problem.nu or problem.estimated.any() or problem.setting.scatter:
        return False
    rows = replace(problem, mixture=fit.problem.mixture, setting=replace(problem.setting, robust=True))
    steady, nu = fit_law(fit.law, rows), rows.nu
    d = np.isfinite(problem.y).sum(axis=1)
    constants = sum(
        d_i * math.log(nu / 2) - 2 * (math.lgamma((nu + d_i) / 2) - math.lgamma(nu / 2)) for d_i in d.tolist()
    )
    return bool(steady.deviance + constants < fit.deviance - 2 * math.log(DECIDED))


def _moved(fit: Fit, steady: Fit, rows: list[Outlier]) -> list[str]:
    """Return a note if the outliers have changed a parameter by several error bars."""
    moved = []
    for name, one in steady.estimates.items():
        was = fit.estimates[name].value
        if one.value is None or not one.stderr:
            continue
        if was is None or abs(was - one.value) > MOVED_SIGMA * one.stderr:
            moved.append(
                f"{name} {one.value:.3g} ± {one.stderr:.2g} in place of {'none' if was is None else f'{was:.3g}'}"
            )
    if not moved:
        return []
    which = f"{rows[0].row} alone" if len(rows) == 1 else f"{len(rows)} outliers, {rows[0].row} first,"
    decide = "decides" if len(rows) == 1 else "decide"
    return [
        f"{which} {decide} the parameters of {fit.law.name}: {', '.join(moved)} by a robust fit (heavy tails); check these rows,"
        " remove those that are not such bounces, or fit with `robust`"
    ]
