"""Rows that a law does not expect, found by a fit that they cannot pull."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from carom.fitting.fit import Fit, fit_law, predict_law, rows_of_fit

__all__ = ["Outlier", "outliers_of"]

ODD = 0.05  # an outlier's chance, among all rows
FEWEST = 8  # rows: among fewer none is odd
MOVED = 3.0  # error bars


@dataclass(frozen=True)
class Outlier:
    """A row that the best law does not expect."""

    row: str
    chi2: float
    why: str


def outliers_of(fit: Fit) -> tuple[list[Outlier], list[str]]:
    """Rows whose chi^2 chance would not give to one of all rows in twenty such tables, worst first; and what there is to say.

    chi^2 is that under numbers of a fit with heavy tails (Student's t): an ordinary one bends to what it should find odd, where one
    row alone can tell a number, and then finds nothing. Where that fit has other numbers, a note says which.
    """
    from scipy.stats import chi2 as distribution

    problem = fit.problem
    d = np.isfinite(problem.y).sum(axis=1)
    if len(d) < FEWEST or not d.any():
        return [], []
    steady = fit
    if not fit.scatter and not problem.nu and fit.names:
        steady = fit_law(fit.law, replace(problem, setting=replace(problem.setting, robust=True)))
    chi2 = rows_of_fit(fit, problem, steady.numbers)[1]
    # where no law fits, a row is odd against the others, not against error bars that are wrong for all
    scale = max(float(np.median(chi2[d > 0] / distribution.median(d[d > 0]))), 1.0)
    limit = distribution.isf(ODD / len(d), np.maximum(d, 1))
    found = [int(i) for i in np.flatnonzero((d > 0) & (chi2 > limit * scale))]
    found.sort(key=lambda i: -chi2[i])
    gap = problem.y - predict_law(fit.law, problem, steady.numbers)
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
    return rows, _moved(fit, steady, rows) if found else []


def _moved(fit: Fit, steady: Fit, rows: list[Outlier]) -> list[str]:
    """A note where the outliers have moved a number by several error bars."""
    moved = []
    for name, one in steady.estimates.items():
        was = fit.estimates[name].value
        if one.value is None or not one.stderr:
            continue
        if was is None or abs(was - one.value) > MOVED * one.stderr:
            moved.append(
                f"{name} {one.value:.3g} ± {one.stderr:.2g} in place of {'none' if was is None else f'{was:.3g}'}"
            )
    if not moved:
        return []
    which = f"{rows[0].row} alone" if len(rows) == 1 else f"{len(rows)} outliers, {rows[0].row} first,"
    decide = "decides" if len(rows) == 1 else "decide"
    return [
        f"{which} {decide} what {fit.law.name} says: {', '.join(moved)} by a fit with heavy tails; look what happened there, leave"
        " it out if it was no such bounce, or fit with --robust"
    ]
