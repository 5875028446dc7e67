"""Cross-validated score of a fit: how well a law predicts rows that it was not fitted to.

Ten folds of every tenth row; rows of one film, sheet, shot or chain of contacts are left out together. Each fold's parameters are
fitted anew to the other rows; where a descent in each fold would take too long, they are one Newton step from the fit to all rows
(Beirami et al., NIPS 2017), which needs two evaluations of the likelihood for all folds together. A tenth of the rows moves a
parameter by a third of an error bar, so that the step ends close to the fold's own minimum: of 60 rows with unmeasured spins the
score differs by 0.001 (a test says so).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from carom.fitting.laws import NUMBERS
from carom.fitting.model import STEPS
from carom.fitting.result import Fit, refit, rows_of_fit, working_model
from carom.fitting.rows import Problem
from carom.fitting.spin_chains import bounded_step

Array = NDArray[np.float64]
# Law evaluations (carom.fitting.rows.Problem.work) up to which each fold descends on its own
CROSS_VALIDATION_WORK = 4e5
FOLDS, MAX_FOLDED_ROWS, FEW_STEPS = 10, 20_000, 6
LARGEST_STEP = 3.0  # error bars by which one Newton step may move a parameter
LEAST_GAIN = 0.5  # of the log likelihood of all rows, left out in turn: a smaller difference speaks against no law


def cross_validated_score(fit: Fit) -> float:
    """Return the mean log likelihood of a row that was left out, up to a constant that all laws share; NaN where a fold's rows
    have no likelihood."""
    problem, costly = fit.problem, fit.law.search_code is not None
    problem = problem.some(MAX_FOLDED_ROWS)
    n = len(problem.x)
    folds = min(FOLDS, int(problem.units.max()) + 1)
    if folds < 2:
        return math.nan
    # neighbours, which tables often have in order of angle or speed, go to different folds
    fold = problem.units % folds
    left_out = (fold[None, :] == np.arange(folds)[:, None]).astype(float)
    if problem.work(costly) > CROSS_VALIDATION_WORK:
        numbers = one_step_without(fit, problem, left_out)
    else:
        # a fold's minimum is near the minimum of all; where spins are integrated over evaluations are costly, and few suffice
        numbers, _cost = refit(fit, problem, 1 - left_out, steps=STEPS if problem.spins is None else FEW_STEPS)
    total = 0.0
    for one in range(folds):
        part = problem.select(np.flatnonzero(fold == one))
        total -= float(rows_of_fit(fit, part, numbers[one])[0].sum()) / 2
    logs = np.log(problem.vy[0, problem.estimated]) * np.isfinite(problem.y[:, problem.estimated]).sum(axis=0) / 2
    return (total - float(logs.sum()) - fit.determinants * n / len(fit.problem.x) / 2) / n


def one_step_without(fit: Fit, problem: Problem, left_out: Array) -> Array:
    """Return numbers (B, K) without the rows that are left out, weights (B, N): one Newton step from the fit to all rows."""
    model = working_model(fit, problem)
    free, p = model.free, np.tile(fit.numbers, (len(left_out), 1))
    if not len(free):
        return p
    own = model.evaluate(p, left_out)
    shared = free >= NUMBERS
    score, information = own.scores.sum(axis=0), own.information.sum(axis=0) + np.diag(shared.astype(float))
    score[shared] -= fit.numbers[free[shared]]
    strength = np.linalg.eigvalsh(information)
    if not strength[-1] > 0:
        return p
    score, information = score - own.scores, information - own.information
    here, low, high = p[:, free], model.low[free], model.high[free]
    most = LARGEST_STEP * np.sqrt(np.maximum(np.diag(np.linalg.pinv(own.information.sum(axis=0), hermitian=True)), 0.0))
    step, _damping = bounded_step(
        information, score, np.maximum(low - here, -most), np.minimum(high - here, most), np.full(len(p), 1e-9)
    )
    p[:, free] = np.clip(here + step, low, high)
    return p


def score_warnings(best: str, scores: dict[str, float], rival: str, rows: int) -> list[str]:
    """Return notes on scores (by law, per row) that are missing, and on one that speaks against the best law."""
    missing = [name for name, score in scores.items() if not math.isfinite(score)]
    notes = []
    if missing:
        notes.append(
            f"CV score: none for {', '.join(missing)}: rows that were left out have no likelihood there; the verdict rests on AICc"
        )
    if rival and rows * (scores[rival] - scores[best]) > LEAST_GAIN:
        notes.append(
            f"CV score: {rival} predicts rows that were left out better than {best} ({scores[rival]:.4g} and"
            f" {scores[best]:.4g} per row): the two criteria disagree, do not rely on the verdict"
        )
    return notes
