"""Rank laws by rebounds: scores of rows left out, groups of rows that differ, the verdict, and fits by surface.

The cross-validated score says how well a law predicts rows that it was not fitted to. Ten folds of every tenth row; rows of one
film, sheet, shot or chain of contacts are left out together. Each fold's parameters are fitted anew to the other rows; where a
descent in each fold would take too long, they are one Newton step from the fit to all rows (Beirami et al., NIPS 2017), which
needs two evaluations of the likelihood for all folds together. A tenth of the rows moves a parameter by a third of an error bar,
so that the step ends close to the fold's own minimum: of 60 rows with unmeasured spins the score differs by 0.001 (a test says so).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Surface
from carom.data.rebounds import Rebounds
from carom.data.where import Where, is_of_words
from carom.errors import CaromError, FaultList, noting, require_type, shortened_list, suggestion
from carom.files import require_library
from carom.fitting.evidence import (
    DECIDED,
    UNLIKELY,
    Evidence,
    Ranked,
    RankedLaws,
    odds_in_words,
    verdict_words,
    weigh,
    widened,
)
from carom.fitting.fit import fit_law, none_above, own_information
from carom.fitting.forms import FormChoice, choose_forms, may_mix, with_flexible_prior
from carom.fitting.identify import with_bootstrap, with_estimate, with_profiles, with_shared
from carom.fitting.laws import FORMS, NUMBERS, FittedLaw, laws_named
from carom.fitting.model import SETTING_NUMBERS, STEPS, model_of, predict_law, prior_parameters
from carom.fitting.result import Estimate, Fit, refit, rows_of_fit, scaled, with_error_bar
from carom.fitting.rows import (
    Problem,
    Setting,
    make_problem,
    require_settings,
    rows_that_meet,
    second_rows,
    usable_rows,
)
from carom.fitting.spin_chains import bounded_step
from carom.fitting.varying import Prediction
from carom.fitting.verdict import (
    Adequacy,
    Coverage,
    Outlier,
    adequacy,
    assumptions_in_words,
    coverage,
    decided_by_few,
    gain_of_forms,
    heavy_tails,
    kinked_rows_warning,
    may_have_forms,
    nothing_along_the_wall,
    odds_note,
    outliers_of,
    unsettled,
)
from carom.formatting import json_value
from carom.laws.registry import one_or_several
from carom.public.progress import Progress, loop_callback
from carom.scene import Scene

Array = NDArray[np.float64]
# Law evaluations (carom.fitting.rows.Problem.work) up to which each fold descends on its own. Beyond, each gets one Newton step:
# with 89 rows two-step's score was off by 0.05 a row, with 300 by 0.0004.
CROSS_VALIDATION_WORK = 4e6
FOLDS, MAX_FOLDED_ROWS, FEW_STEPS, LAW_STEPS = 10, 20_000, 6, 2
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
        if fit.tabulated is not None:  # (beside its table; from there by the law itself)
            numbers = model_of(fit.law, problem).minimize(numbers, LAW_STEPS, 1 - left_out).p
    parts = [problem.select(np.flatnonzero(fold == one)) for one in range(folds)]
    total = -sum(float(rows_of_fit(fit, part, p)[0].sum()) for part, p in zip(parts, numbers, strict=True)) / 2
    logs = np.log(problem.vy[0, problem.estimated]) * np.isfinite(problem.y[:, problem.estimated]).sum(axis=0) / 2
    return (total - float(logs.sum()) - fit.determinants * n / len(fit.problem.x) / 2) / n


def one_step_without(fit: Fit, problem: Problem, left_out: Array) -> Array:
    """Return numbers (B, K) without the rows that are left out, weights (B, N): one Newton step from the fit to all rows."""
    model = model_of(fit.law, problem)
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
            f"CV score: none for {', '.join(missing)}: under it a row that was left out is impossible; the verdict rests on AICc"
        )
    if rival and rows * (scores[rival] - scores[best]) > LEAST_GAIN:
        notes.append(
            f"CV score: {rival} predicts rows that were left out better than {best} ({scores[rival]:.4g} and"
            f" {scores[best]:.4g} per row): the two criteria disagree, do not rely on the verdict"
        )
    return notes


# ----------------------------------------------------------------------------------------------------
# Groups of rows whose numbers differ: means of the groups, with the scatter between them.


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
ONE_SIDE = 0.8413  # probability up to one error bar
MOST_WORK = 4e5  # law evaluations for all groups
STAGE = "stage"
LEAST_STRENGTH = 1e-9  # of the information in a direction, each number's own being 1: below it rounding decides


def with_group_scatter(fit: Fit) -> tuple[Fit, list[str], str]:
    """Return the fit with numbers that are means of groups of rows, where these differ, notes, and a contradiction between stages.

    Groups are the values of columns of words and of those called ball, camera, cushion, film, racket, surface or wall, and the two
    stages at which balls on a table were measured, whose parameters must agree. Where one number differs between groups, a fit of
    common ones is biased in all: each is then the mean of the groups' own, whose error bar includes the scatter between them.
    """
    from scipy.special import stdtrit

    notes, contradiction, wide = [], "", dict[str, tuple[float, float, int]]()
    heavy = fit.law.search_code is not None
    for column, labels, groups in _groupings(fit):
        if not fit.names or fit.problem.work(heavy) * len(groups) > MOST_WORK:
            continue
        values, variances = _by_group(fit, groups)
        told = [name for name in fit.names if fit.estimates[name].value is not None and fit.estimates[name].stderr]
        means, differ = {}, []
        for name in told:
            i = fit.names.index(name)
            good = np.isfinite(variances[:, i]) & (variances[:, i] > 0)
            if not good.any():
                continue
            chance, tau2, mean, stderr = _scatter(values[good, i], variances[good, i])
            means[name] = mean, stderr, 0
            if good.sum() < 2 or chance > UNLIKELY / len(told):
                continue
            # (of few groups the scatter is hardly known: its error bars are those of Student's t)
            means[name] = mean, stderr * float(stdtrit(good.sum() - 1, ONE_SIDE)), int(good.sum() - 1)
            each = [
                f"{labels[j]} {values[j, i]:.4g} ± {variances[j, i] ** 0.5:.1g}"
                for j in np.flatnonzero(good)[:4].tolist()
            ]
            differ.append(f"{name} {', '.join(each)}{', ...' if good.sum() > 4 else ''} (scatter {tau2**0.5:.2g})")
        if differ and column == STAGE:
            contradiction = f"rows of the two stages contradict each other under it: {'; '.join(differ)}"
        elif differ:
            notes.append(
                f"{column}: under {fit.law.name} the {len(groups)} kinds of rows differ by more than their error bars:"
                f" {'; '.join(differ)}; the numbers are means of the kinds"
            )
            wide |= {name: one for name, one in means.items() if one[1] > wide.get(name, (0.0, 0.0))[1]}
    model = model_of(fit.law, fit.problem)
    for name, (mean, stderr, dof) in wide.items():
        fit = scaled(fit, name, stderr / (fit.estimates[name].stderr or stderr))
        one, two = stderr, stderr * float(stdtrit(dof, 0.975) / stdtrit(dof, ONE_SIDE)) if dof else math.nan
        low, high = float(model.low[model.places[name]]), float(model.high[model.places[name]])
        ends = [(max(mean - far, low), min(mean + far, high)) if dof else None for far in (one, two)]
        fit = with_estimate(fit, name, Estimate(mean, stderr, interval_68=ends[0], interval_95=ends[1]))
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
    """Return the parameters (G, k) fitted to each group alone, and their variances; an estimated scatter is that within groups."""
    problem = fit.problem
    numbers, _deviance = refit(fit, problem, groups)
    if problem.estimated.any():
        each = np.stack([problem.y - predict_law(fit.law, problem, one) for one in numbers])
        seen = np.isfinite(problem.y) * groups.sum(axis=0)[:, None]
        within = np.einsum("gn,gnj->j", groups, np.square(np.nan_to_num(each))) / np.maximum(seen.sum(axis=0), 1)
        within *= problem.count / max(problem.count - len(groups) * len(fit.names), 1)
        problem = replace(problem, vy=np.where(problem.estimated & (within > 0), within, problem.vy))
        numbers, _deviance = refit(fit, problem, groups)
    model = model_of(fit.law, problem)
    seen = model.evaluate(numbers, groups)
    places = [model.places[name] for name in fit.names]
    low, high = model.low[places], model.high[places]
    variances = np.full((len(groups), len(places)), np.nan)
    for g, information in enumerate(seen.information):
        own = own_information(
            information + np.diag((model.free >= len(fit.numbers) - len(fit.problem.shared)) * 1.0), len(places)
        )
        variances[g] = _variances(own, high - low)
    values = numbers[:, places]
    variances[(values <= low) | (values >= high)] = np.nan
    return values, variances


def _variances(information: Array, width: Array) -> Array:
    """Return the variances (k,) of numbers that lie in ranges (k,) by the information on them (k, k); NaN where there is none."""
    found = np.full(len(width), np.nan)
    # (else the whole range is within one error bar)
    known = np.flatnonzero(np.diag(information) * np.square(width) > 1)
    size = np.sqrt(np.diag(information)[known])
    strength, direction = np.linalg.eigh(information[np.ix_(known, known)] / np.outer(size, size))
    if len(known) and strength.min() > LEAST_STRENGTH:
        found[known] = (np.square(direction) / strength).sum(axis=1) / np.square(size)
    return found


def _scatter(values: Array, variances: Array) -> tuple[float, float, float, float]:
    """Return the probability of such differences by chance, the variance between groups, and their mean with its error bar."""
    from scipy.special import chdtrc

    weight = 1 / variances
    mean = (weight * values).sum() / weight.sum()
    q, n = float((weight * np.square(values - mean)).sum()), len(values)
    # (the sum of weights less that of their squares over it, by products: the difference is 0 where one group is far more exact)
    pairs = 2 * float(np.triu(np.outer(weight, weight), 1).sum())
    tau2 = max(q - (n - 1), 0.0) * float(weight.sum()) / pairs if n > 1 else 0.0
    own = 1 / (variances + tau2)
    return float(chdtrc(n - 1, q)), tau2, float((own * values).sum() / own.sum()), float(own.sum() ** -0.5)


# ----------------------------------------------------------------------------------------------------
# Fit all laws to rebounds and rank them: which law the data favour, by what odds, and whether any law fits.


LEAST_DATA = 4  # measured numbers for each fitted one, where the scatter is estimated
# Law evaluations (carom.fitting.rows.Problem.work) up to which these are done by default
PROFILE_WORK, MARGINAL_PROFILE_WORK, BOOTSTRAP_WORK = 3e3, 5e3, 3e3
DRAWS = 200
LEAST_OF_STAGE, CONTRADICTION = 5, 4.0  # rows; error bars between the stages of a film
FIT_SHARE = 0.6  # of the progress bar
RESTITUTIONS = tuple(dict.fromkeys(p.name for form in FORMS.values() for p in form.parameters))
IN_WORDS = (*RESTITUTIONS, "friction")
Say = Callable[[str, float], None]


def step_callback(progress: Progress | None) -> Say:
    """Return the callback of a fit, which takes the current step and the fraction done."""
    tell: Say = loop_callback(progress, lambda now: lambda text, done: now(done, 1.0, text)) or (
        lambda _what, _done: None
    )
    return tell


@dataclass(frozen=True, eq=False, repr=False)
class Ranking(RankedLaws[Fit]):
    """All laws, best first, and the verdict; made by :func:`fit_laws`.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, fit_laws
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18],
    ...            "v_t_out": [0.71, 1.43, 2.15, 2.85], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> ranking = fit_laws(make_rebounds("planar", columns), Setting(radius=0.02), ["sticking", "mirror"], bootstrap=0)
    >>> [one.fit.law.name for one in ranking.ranked], ranking.against
    (['sticking', 'mirror'], 'mirror')
    """

    adequacy: Adequacy
    """Whether the best law describes the data at all, by tests of it alone."""
    coverage: Coverage
    """The contacts from which the verdict comes, and to which it is limited."""
    outliers: tuple[Outlier, ...]
    swayed: bool = False
    """Whether outliers have moved the best law's parameters by several error bars."""
    forms: tuple[FormChoice, ...] = ()
    """Functions of the impact for the parameters of the best law, and of ``contact``, best first; where they were asked for."""
    held_back: str = ""
    """Why the best law's numbers forbid a decision for it, in words: one is at a bound, or none is identifiable, or the stages of
    one film contradict each other under it."""

    @property
    def fits(self) -> bool:
        """Whether the best law fits: chi^2 is as expected by chance (where it is known), and residuals show no pattern."""
        return self.adequacy.fits

    @property
    def enlarge(self) -> float:
        """Factor by which all error bars would have to be enlarged for the best law to fit; 1 where chi^2 is likely."""
        return self.adequacy.enlarge

    @property
    def decisive(self) -> bool:
        """Whether the data decide for a law that fits, whatever the outliers, and not only for a small range of contacts."""
        held_back = self.swayed or self.coverage.narrow or self.held_back
        return self.fits and self.odds >= DECIDED and not held_back

    def predict(self, before: Any) -> Prediction:
        """Return the predictions of the best law (:meth:`carom.fitting.Fit.predict`), with the chosen functions, if any."""
        return (self.forms[0] if self.forms else self.best).predict(before)

    def with_forms(self, progress: Progress | None = None) -> Ranking:
        """Return the ranking with functions of the impact for the parameters, chosen by held-out rows."""
        if self.best.problem.spins is not None:
            said = "`forms`: spins before the wall were not measured in all rows, so functions of the impact were not tried"
            return replace(self, notes=(*self.notes, said))
        laws = dict.fromkeys([self.best, *(one.fit for one in self.ranked if one.fit.law.name == "contact")])
        found = [choose_forms(fit, progress=progress) for fit in laws]
        return replace(self, forms=tuple(sorted(found, key=lambda one: -one.best.score)))

    def to_surface(self, before: Any = None) -> Surface:
        """Return the best law's surface (:meth:`carom.fitting.Fit.to_surface`)."""
        return self.best.to_surface(before)

    def to_scene(self) -> Scene:
        """Return a scene with the best law (:meth:`carom.fitting.Fit.to_scene`)."""
        return self.best.to_scene()

    def with_shared_errors(self, shifted: Sequence[tuple[str, Rebounds]]) -> Ranking:
        """Return the ranking with standard errors from systematic errors; ``shifted``: name of each error, and the shifted rows."""
        if not shifted:
            return self
        note = f"systematic errors common to all rows ({', '.join(words for words, _rows in shifted)}) are the second error bar"
        ranked = tuple(replace(one, fit=with_shared(one.fit, shifted)) for one in self.ranked)
        before, now = (_numbers(fit, IN_WORDS) for fit in (self.best, ranked[0].fit))
        return replace(self, ranked=ranked, verdict=self.verdict.replace(before, now), notes=(*self.notes, note))

    def as_dict(self) -> dict[str, Any]:
        """Return the ranking for JSON: numbers in full precision, None where there is none."""
        problem, found = self.best.problem, super().as_dict()
        for one, said in zip(self.ranked, found["ranking"], strict=True):
            said["cross_validated_log_score"] = json_value(one.score)
        return found | {
            "fits": self.fits,
            "enlarge_error_bars": self.enlarge,
            "adequacy": self.adequacy.as_dict(),
            "coverage": self.coverage.as_dict(),
            "decisive": self.decisive,
            "outliers": [vars(outlier) for outlier in self.outliers],
            "swayed_by_outliers": self.swayed,
            "held_back": self.held_back or None,
            "rows": len(problem.x),
            "forms": [one.as_dict() for one in self.forms],
            "setting": {name: getattr(problem.setting, name) for name in ("radius", *SETTING_NUMBERS)},
        }


def fit_laws(
    rebounds: Rebounds,
    setting: Setting,
    laws: str | Sequence[str] | None = None,
    *,
    where: Where = (),
    sigma_v: float | None = None,
    sigma_spin: float | None = None,
    spin: float | str | None = None,
    every_contact: bool = False,
    shifted: Sequence[tuple[str, Rebounds]] = (),
    profiles: bool | None = None,
    bootstrap: int | None = None,
    seed: int = 0,
    progress: Progress | None = None,
) -> Ranking:
    """Fit laws to the rebounds that may be used for it, and rank them.

    Parameters
    ----------
    rebounds : Rebounds
        Measured before and after a wall (:func:`carom.data.read_rebounds`).
    setting : Setting
        The ball, the wall's height, what to fit.
    laws : str or sequence of str, optional
        Names. Default: all laws for this kind of rebound.
    where, sigma_v, sigma_spin, spin, every_contact
        Which rows are used, and default error bars and spins, as for :func:`carom.fitting.rows`: unmeasured spins of later
        contacts follow from the contacts before.
    shifted : sequence of (str, Rebounds)
        Systematic errors common to all rows: a description of each, and the rebounds shifted by one standard deviation
        (:class:`carom.data.Published` has them). They are a second error bar of the parameters.
    profiles : bool, optional
        Whether to compute intervals by profile likelihood. Default: if this is fast.
    bootstrap : int, optional
        Number of draws. Default: 200 if this is fast, else none.
    seed : int
        Of the bootstrap.
    progress : callable(done, total, text), optional
        Called with the fraction done, 1, and the current step.

    Returns
    -------
    Ranking
        All laws, best first, with a verdict; its notes say which rows were left out, and what was assumed.

    Raises
    ------
    CaromError
        For tables and settings that cannot be fitted, one line per problem.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, fit_laws
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18],
    ...            "v_t_out": [0.71, 1.43, 2.15, 2.85], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> ranking = fit_laws(make_rebounds("planar", columns), Setting(radius=0.02), ["sticking", "mirror"], bootstrap=0)
    >>> ranking.best.law.name, ranking.fits
    ('sticking', True)
    """
    require_library("scipy", "fit")
    require_type("fit_laws", "rebounds", rebounds, Rebounds)
    require_type("fit_laws", "setting", setting, Setting)
    if seed < 0:
        raise CaromError(f"fit_laws: seed: expected a whole number >= 0, got {seed}")
    require_settings(setting)
    if bootstrap is not None and (bootstrap < 0 or bootstrap == 1):
        raise CaromError(f"bootstrap: expected 0 (none) or a number of draws, 2 or more, got {bootstrap}")
    choice: Any = {
        "where": where,
        "sigma_v": sigma_v,
        "sigma_spin": sigma_spin,
        "spin": spin,
        "every_contact": every_contact,
    }
    others = [(words, usable_rows(rows, setting, **choice)[0]) for words, rows in shifted]
    every, plain = rebounds, setting
    rebounds, setting = usable_rows(every, setting, **choice)
    every = rows_that_meet(every, where)
    later = second_rows(every)
    with noting(rebounds.notes):
        ranking = _fit_rows(rebounds, setting, laws, profiles, bootstrap, seed, step_callback(progress))
        if later.any():  # (both stages of a film: the second is compared)
            ranking = _with_other_stage(ranking, usable_rows(every.select(later), plain, **choice)[0])
    return ranking.with_shared_errors(others)


def _with_other_stage(ranking: Ranking, rows: Rebounds) -> Ranking:
    """Return the ranking, held back where the best law's numbers from the rows of the other stage contradict it."""
    if len(rows) < LEAST_OF_STAGE:
        return ranking
    best = ranking.best
    other = fit_law(best.law, make_problem(rows, best.problem.setting)[0])
    apart = []
    for name, one in best.estimates.items():
        two = other.estimates[name]
        if one.value is None or two.value is None or not (one.stderr and two.stderr) or name.startswith("spin_"):
            continue
        if abs(one.value - two.value) > CONTRADICTION * math.hypot(one.stderr, two.stderr):
            apart.append(
                f"{name} {with_error_bar(one)} as balls leave the wall and {with_error_bar(two)} once they roll"
            )
    if not apart:
        return ranking
    said = f"the two stages of the film contradict each other under {best.law.name} ({'; '.join(apart)}): do not rely on it"
    return replace(ranking, verdict=f"{ranking.verdict} But {said}.", held_back=said)


def _fits_of(
    chosen: Sequence[FittedLaw], problem: Problem, notes: Sequence[str], tell: Say
) -> tuple[list[Fit], list[str]]:
    """Return the fits of laws, best first, and notes on laws for which the measured numbers are too few."""
    fits: list[Fit] = []
    needed: dict[str, int] = {}
    said: list[str] = []
    for i, law in enumerate(chosen):
        tell(f"fit {law.name}", i / len(chosen) * FIT_SHARE)
        own = int((model_of(law, problem).free < NUMBERS).sum() + problem.estimated.sum())
        k, fit = own + prior_parameters(law, problem), None
        if problem.count > k + 1:  # (AICc divides by count - k - 1)
            fit = fit_law(law, problem)
            k = fit.k
        if fit is None or not math.isfinite(fit.aicc):
            needed[law.name] = k + 2
            said.append(f"{law.name}: left out, {k} parameters for {problem.count} measured numbers; measure more")
        else:
            fits.append(fit)
    if not fits and needed:
        name, rows = min(needed, key=needed.__getitem__), problem.rebounds
        straight = ", ".join(f"{e:.3f}" for e in rows["v_n_out"] / rows["v_n_in"] if not rows["v_t_in"].any())
        raise CaromError(
            f"{rows.source}: expected {needed[name]} measured numbers or more, which {name} needs, got {problem.count};"
            f" measure more{f' (restitution of each row: {straight})' if straight else ''}"
        )
    if not fits:
        raise CaromError(*(f"{problem.rebounds.source}: {note}" for note in (*notes, *said)))
    by_name = none_above({fit.law.name: fit for fit in fits}, lambda fit: fit,
                         lambda fit, inner: fit_law(fit.law, problem, [inner]))  # fmt: skip
    return sorted(by_name.values(), key=lambda fit: fit.aicc), said


def _fit_rows(
    rebounds: Rebounds,
    setting: Setting,
    laws: str | Sequence[str] | None,
    profiles: bool | None,
    bootstrap: int | None,
    seed: int,
    tell: Say,
    before: Sequence[str] = (),
) -> Ranking:
    """Fit laws to all rows of a table, and rank them; ``before``: notes."""
    chosen, notes = laws_named(
        one_or_several("fit_laws", laws) if laws else None, rebounds.kind, setting.contact_height == 1.0
    )
    problem, remarks = make_problem(rebounds, setting)
    notes = [*before, *rebounds.notes, *notes, *remarks]
    notes = [note for note in notes if not note.startswith("no sigma_ columns")]
    fits, few_numbers = _fits_of(chosen, problem, notes, tell)
    notes += few_numbers
    found, covers, others = adequacy(fits[0]), coverage(problem), list[Fit]()
    if may_mix(setting, problem):
        fits, others, said = with_flexible_prior(
            fits, problem, found.enlarge, lambda law: tell(f"shape of the spins, {law}", FIT_SHARE)
        )
        found, notes = (adequacy(fits[0]), [*notes, *said]) if said else (found, notes)
    best, searched = fits[0], outliers_of(fits[0])
    if searched.apart and heavy_tails(best, problem):
        notes = [
            f"{len(searched.rows)} of {len(problem.x)} rows ({searched.rows[0].row} first) are outliers of {best.law.name}: all"
            " laws are fitted with errors of heavy tails (`robust`), in which such rows count little"
        ]
        return _fit_rows(rebounds, replace(setting, robust=True), laws, profiles, bootstrap, seed, tell, notes)
    evidence = weigh(fits, found.enlarge)
    odds = evidence.odds
    if best.problem.mixture is None:  # (else the normal prior is refuted)
        evidence = widened(evidence, fits, others, found.enlarge)
    ranked = []
    for i, (fit, weight) in enumerate(zip(fits, evidence.weights.tolist(), strict=True)):
        tell(f"error bars of {fit.law.name}", FIT_SHARE + (1 - FIT_SHARE) * i / len(fits))
        ranked.append(
            Ranked(_with_error_bars(fit, profiles, bootstrap, seed, i == 0), weight, cross_validated_score(fit))
        )
    best, rival = ranked[0].fit, evidence.rival
    scores = {one.fit.law.name: one.score for one in ranked}
    if evidence.odds < min(odds, DECIDED):
        notes.append(
            f"unmeasured spins: with a prior of another shape (a mixture) the odds over {evidence.rival.law.name} are"
            f" {odds_in_words(evidence.odds)} instead of {odds_in_words(odds)}: the assumed shape decides, and the smaller odds"
            " are given"
        )
    few = rival is not None and any(_too_few(fit) for fit in (best, rival))
    tell("assumptions", 1.0)
    fit, different, contradiction = with_group_scatter(best)
    ranked[0], best = replace(ranked[0], fit=fit), fit
    notes += different
    straight = nothing_along_the_wall(problem)
    gains, few_rows = gain_of_forms(best, problem), ""
    if rival is not None and not (few or straight) and evidence.odds >= DECIDED:
        few_rows = decided_by_few(best, rival, found.enlarge)
        evidence, said = _under_forms(fits, evidence, {best.law.name: gains}, problem, found.enlarge)
        rival, notes = evidence.rival, [*notes, *said]
    held_back = "; ".join(filter(None, (unsettled(best), contradiction, few_rows)))
    said, outliers = list(searched.notes), searched.rows
    verdict = (
        _straight_verdict(best, found, covers) if straight else _verdict(best, evidence, few, found, covers, held_back)
    )
    verdict = f"{verdict[:-1]}{assumptions_in_words(best, gains)}."
    notes += [] if few or straight else odds_note(len(problem.x), evidence.odds)
    swayed = bool(said)
    if swayed:
        which = f"{outliers[0].row} alone sways" if len(outliers) == 1 else f"{len(outliers)} outliers sway"
        verdict = f"{verdict} {which[0].upper() + which[1:]} this: remove rows that are not such bounces, or fit with `robust`."
    if not straight:
        said += score_warnings(best.law.name, scores, rival.law.name if rival else "", len(problem.x))
        said += [warning for warning in (kinked_rows_warning(best),) if warning]
    return Ranking(
        tuple(ranked), verdict, math.nan if few or straight else evidence.odds, rival.law.name if rival else "",
        tuple(dict.fromkeys([*notes, *said])), found, covers, tuple(outliers), swayed, held_back=held_back,
    )  # fmt: skip


def _under_forms(
    fits: Sequence[Fit], evidence: Evidence, gains: dict[str, dict[str, float]], problem: Problem, enlarge: float
) -> tuple[Evidence, list[str]]:
    """Return the evidence with each law's own best forms, with a note, where it would not decide; else that of constants."""
    if not may_have_forms(fits[0], problem):
        return evidence, []
    gains = gains | {fit.law.name: gain_of_forms(fit, problem) for fit in fits[1:]}
    formed = weigh(fits, enlarge, {name: sum(each.values()) for name, each in gains.items()})
    if not formed.odds < DECIDED:
        return evidence, []
    lines = "; ".join(f"{name} {' and '.join(each)}" for name, each in gains.items() if each)
    behind = "ahead of" if formed.odds >= 1 else "behind"
    said = (
        f"the verdict depends on the form: with constants {fits[0].law.name} is ahead of {evidence.rival.law.name} by"
        f" {odds_in_words(evidence.odds)}, with straight lines where the rows support them ({lines}) it is {behind}"
        f" {formed.rival.law.name} by {odds_in_words(max(formed.odds, 1 / formed.odds))}"
    )
    return replace(formed, weights=evidence.weights), [said]


def _with_error_bars(fit: Fit, profiles: bool | None, draws: int | None, seed: int, best: bool) -> Fit:
    """Add profiles and bootstrap, if requested or fast."""
    work = fit.problem.work(fit.law.search_code is not None)
    marginal = fit.problem.spins is not None
    if profiles or (profiles is None and work < PROFILE_WORK and not marginal):
        fit = with_profiles(fit)
    elif profiles is None and marginal and best and work < MARGINAL_PROFILE_WORK:
        # A profile takes as long as the fit, but next to a kink an interval may be ten times as long on one side as on the other.
        fit = with_profiles(fit, [name for name in fit.names if not name.startswith("spin_")])
    if draws is None:
        draws = DRAWS if work < BOOTSTRAP_WORK and not marginal else 0
    return with_bootstrap(fit, draws, seed) if draws and fit.names else fit


def _too_few(fit: Fit) -> bool:
    """Whether the measured numbers are too few for AICc to mean anything: its correction is derived for errors whose scatter is
    estimated from many more (Hurvich & Tsai 1989 go down to some three a parameter). Where error bars are given there is none."""
    return bool(fit.scatter) and fit.problem.count < LEAST_DATA * fit.k


def _misfit(best: Fit, found: Adequacy) -> str:
    """Return why no law fits, as the beginning of the verdict; empty if the best one fits."""
    if not found.chi2_likely:
        return (
            f"No law fits: the best, {best.law.called}, has chi^2 {best.chi2:.4g} for {best.dof} degrees of freedom; error bars"
            f" would have to be {found.enlarge:.2g} times as large (`scatter` fits what contacts scatter beyond them). With such"
            " error bars, "
        )
    if not found.fits:
        return (
            f"No law fits: the residuals of the best, {best.law.called}, depend on what came before ({found.pattern}, p ="
            f" {found.pattern_probability:.1g}). Of laws that are all approximations, "
        )
    return ""


def _numbers(best: Fit, names: Sequence[str]) -> str:
    """Return those estimates of a law that are identifiable, with their error bars, in words."""
    of_names = {name: best.estimates[name] for name in names if name in best.estimates}
    return ", ".join(f"{name} {with_error_bar(one)}" for name, one in of_names.items() if one.stderr is not None)


def _straight_verdict(best: Fit, found: Adequacy, covers: Coverage) -> str:
    """Return the verdict on balls that have no velocity along the wall and no spin: the restitution, and no law."""
    numbers = _numbers(best, RESTITUTIONS)
    why = "within the error bars the ball has no velocity along the wall and no spin, so all laws predict the same"
    more = "Throw the ball at an angle to the wall to measure friction"
    if best.problem.rebounds["v_t_in"].any():
        why, more = (
            "what lies along the wall depends on spins that were not measured",
            "Give spins, or error bars, to measure friction",
        )
    said = f"only the restitution is measured: {numbers}. " if numbers else ""
    said += f"{'T' if said else 't'}he rebounds say nothing about friction or which law holds: {why}. {more}"
    first = _misfit(best, found)
    return f"{first + said if first else said[0].upper() + said[1:]}. This is for contacts like these: {covers.in_words()}."


def _verdict(best: Fit, evidence: Evidence, few: bool, found: Adequacy, covers: Coverage, held_back: str) -> str:
    """Return the verdict in one sentence: which law, by what odds, how well it fits, and for which contacts."""
    numbers, first = _numbers(best, IN_WORDS), _misfit(best, found)
    name = f"{best.law.called} ({numbers})" if numbers else best.law.called
    if few:
        said = (
            f"these data cannot decide: too few rows, {best.problem.count} measured numbers for up to"
            f" {max(best.k, evidence.rival.k)} fitted ones, scatter among them; measure more, or give error bars (`sigma_v`,"
            " `sigma_spin`)"
        )
    else:
        reason = f"{odds_in_words(evidence.odds)} over {evidence.rival.law.name}" if evidence.rival else ""
        said = verdict_words(
            name, evidence, "the data", evidence.odds, reason, nearest=not found.fits,
            narrow=" and ".join(filter(None, (covers.narrow, held_back))),
        )  # fmt: skip
        said += f"; {held_back}" if held_back and held_back not in said else ""
        said += "" if first else f"; {found.in_words(best.law.name)}"
    if numbers and name not in said:
        said += f"; under {best.law.name}: {numbers}"
    said = first + said if first else said[0].upper() + said[1:]
    return f"{said}. This is for contacts like these: {covers.in_words()}."


# ----------------------------------------------------------------------------------------------------
# Laws fitted to the rows of each surface, ball or racket of one table by itself: ``carom.fit(by=...)``.


class RankingsBy(dict[str, Ranking]):
    """The ranking of laws for each value of a column, in the order of the table.

    Examples
    --------
    >>> from carom.fitting import RankingsBy
    >>> RankingsBy("surface").as_dict()
    {'by': 'surface', 'fits': {}, 'left_out': []}
    """

    def __init__(self, column: str) -> None:
        super().__init__()
        self.column = column
        self.left_out: list[str] = []
        """Values whose rows cannot be fitted, with the reason."""

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes of all fits, each with the value."""
        own = [f"{value}: {note}" for value, ranking in self.items() for note in ranking.notes]
        return (*(f"left out: {text}" for text in self.left_out), *own)

    def as_dict(self) -> dict[str, Any]:
        """Return the rankings for JSON."""
        fits = {value: ranking.as_dict() for value, ranking in self.items()}
        return {"by": self.column, "fits": fits, "left_out": self.left_out}


def fit_by(
    rebounds: Rebounds, setting: Setting, laws: Any, column: str, *, forms: bool = False, **options: Any
) -> RankingsBy:
    """Fit laws to the rows of each value of a column; ``options`` as for :func:`carom.fitting.fit_laws`.

    ``forms``: whether functions of the impact are chosen for the parameters. Rows with an empty cell are a group of their own.

    Raises CaromError where the table has no such column, and where no value has rows that can be fitted.
    """
    if column not in rebounds.extra:
        known = list(rebounds.extra)
        hint = suggestion(column, known) if known else "there is none"
        faults = FaultList()
        faults.add("`by`", "an additional column of the table", repr(column), hint)
        faults.raise_if_any()
    cells = np.array([str(cell).strip() or f"(no {column})" for cell in rebounds.extra[column].tolist()])
    found = RankingsBy(column)
    for value in dict.fromkeys(cells.tolist()):
        try:
            ranking = fit_laws(rebounds.select(cells == value), setting, laws, **options)
            found[value] = ranking.with_forms() if forms else ranking
        except CaromError as error:
            found.left_out.append(f"{column} {value}: {shortened_list(list(map(str, error.faults)), 2)}")
    if not found:
        raise CaromError(*found.left_out)
    return found
