"""Rows of several walls, balls, films or stages in one table: whether the best law's numbers differ between them, and by how much.

A fit to rows of several walls takes their parameters as equal. If they scatter, its error bars are too small by any factor, since
they fall with the number of rows and not with that of the walls. The fit to each group of rows gives parameters and error bars;
their scatter beyond the error bars is that of the groups, tau^2 (DerSimonian & Laird, Control. Clin. Trials 7, 177 (1986)), and the
error bar of the common value is that of a mean of values with variances stderr^2 + tau^2.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from carom.data.where import is_of_words
from carom.fitting.evidence import UNLIKELY
from carom.fitting.fit import own_information
from carom.fitting.model import model_of
from carom.fitting.result import Fit, refit, scaled

__all__ = ["with_group_scatter"]

Array = NDArray[np.float64]
NAMED = (
    "ball",
    "camera",
    "cushion",
    "film",
    "racket",
    "surface",
    "wall",
)  # columns whose values name kinds, even if they are numbers
LEAST_ROWS, MOST_GROUPS = 5, 40
MOST_WORK = 4e5  # law evaluations for all groups
STAGE = "stage"


def with_group_scatter(fit: Fit) -> tuple[Fit, list[str], str]:
    """Return the fit with error bars that include the scatter between groups of rows, notes, and a contradiction between stages.

    Groups are the values of columns of words and of those called ball, camera, cushion, film, racket, surface or wall, and the two
    stages at which balls on a table were measured, whose parameters must agree.
    """
    notes, contradiction = [], ""
    heavy = fit.law.search_code is not None
    for column, labels, groups in _groupings(fit):
        if not fit.names or fit.problem.work(heavy) * len(groups) > MOST_WORK:
            continue
        values, variances = _by_group(fit, groups)
        told = [
            i
            for i, name in enumerate(fit.names)
            if fit.estimates[name].value is not None and fit.estimates[name].stderr
        ]
        differ = []
        for i in told:
            good = np.isfinite(variances[:, i]) & (variances[:, i] > 0)
            if good.sum() < 2:
                continue
            chance, tau2, stderr = _scatter(values[good, i], variances[good, i])
            if chance > UNLIKELY / len(told):
                continue
            name, own = fit.names[i], fit.estimates[fit.names[i]].stderr or stderr
            each = [
                f"{labels[j]} {values[j, i]:.4g} ± {variances[j, i] ** 0.5:.1g}"
                for j in np.flatnonzero(good)[:4].tolist()
            ]
            differ.append(f"{name} {', '.join(each)}{', ...' if good.sum() > 4 else ''}")
            if column != STAGE and stderr > own:
                fit = scaled(fit, name, stderr / own)
                differ[-1] += f" (scatter {tau2**0.5:.2g}, error bar {stderr / own:.2g} times as large)"
        if differ and column == STAGE:
            contradiction = f"rows of the two stages contradict each other under it: {'; '.join(differ)}"
        elif differ:
            notes.append(
                f"{column}: under {fit.law.name} the {len(groups)} kinds of rows differ by more than their error bars:"
                f" {'; '.join(differ)}"
            )
    return fit, notes, contradiction


def _groupings(fit: Fit) -> Iterator[tuple[str, list[str], Array]]:
    """Yield columns that divide the rows into groups, the groups' names, and their rows as weights (G, N)."""
    rebounds = fit.problem.rebounds
    columns = dict(rebounds.extra) | ({} if rebounds.stage is None else {STAGE: rebounds.stage})
    for name, column in columns.items():
        cells = np.array([str(cell) for cell in column.tolist()])
        labels, count = np.unique(cells, return_counts=True)
        if not (name in (*NAMED, STAGE) or is_of_words(labels.tolist())):
            continue
        if not 2 <= len(labels) <= min(MOST_GROUPS, len(cells) // LEAST_ROWS):
            continue
        several = [
            str(label) for label, n in zip(labels.tolist(), count.tolist(), strict=True) if label and n >= LEAST_ROWS
        ]
        if len(several) >= 2:
            yield name, several, np.array([cells == label for label in several], float)


def _by_group(fit: Fit, groups: Array) -> tuple[Array, Array]:
    """Return the parameters (G, k) fitted to each group alone, and their variances."""
    model = model_of(fit.law, fit.problem)
    numbers, _deviance = refit(fit, fit.problem, groups)
    seen = model.evaluate(numbers, groups)
    places = [model.places[name] for name in fit.names]
    variances = np.full((len(groups), len(places)), np.nan)
    for g, information in enumerate(seen.information):
        own = own_information(
            information + np.diag((model.free >= len(fit.numbers) - len(fit.problem.shared)) * 1.0), len(places)
        )
        inverse = np.linalg.pinv(own, hermitian=True)
        variances[g] = np.diag(inverse)
    low, high = model.low[places], model.high[places]
    values = numbers[:, places]
    variances[(values <= low) | (values >= high)] = np.nan
    return values, variances


def _scatter(values: Array, variances: Array) -> tuple[float, float, float]:
    """Return the probability of such differences by chance, the variance between groups, and the error bar of the common value."""
    from scipy.special import chdtrc

    weight = 1 / variances
    mean = (weight * values).sum() / weight.sum()
    q, n = float((weight * np.square(values - mean)).sum()), len(values)
    # (the sum of weights less that of their squares over it, by products: the difference is 0 where one group is far more exact)
    tau2 = max(q - (n - 1), 0.0) * float(weight.sum() / (2 * np.triu(np.outer(weight, weight), 1).sum()))
    return float(chdtrc(n - 1, q)), tau2, float((1 / (variances + tau2)).sum() ** -0.5)
