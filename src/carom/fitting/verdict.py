"""Conditions of a verdict: what was assumed, what the rows say of it, and numbers of the best law that forbid a decision."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.evidence import DECIDED, LEANS, UNLIKELY
from carom.fitting.fit import STUDENT_NU, fit_law, place_near
from carom.fitting.laws import ALONG
from carom.fitting.model import feels_spins, model_of, predict_law, predictions_beside
from carom.fitting.result import Fit, rows_of_fit
from carom.fitting.rows import Problem
from carom.formatting import json_value

GAIN = 6.0  # of AICc: odds of 20 to 1
MOST_WORK, MOST_ESTIMATED = (
    2e4,
    400,
)  # law evaluations (carom.fitting.rows.Problem.work) and rows up to which e(v) is tried
KINKED_SIGMA, KINKED_SHARE = 0.3, 0.06  # of an error bar by which the prediction deviates from linear; of the rows
NO_BALL = {"spin_mean": 1.5, "spin_width": 2.0}  # v_t/a and v/a: larger ones of unmeasured spins are not believed
# Of simulated tables whose true law is among those fitted (campaigns/verdict_coverage.py): rows, decisions at 20 to 1, wrong ones
COUNTED = ((8, 249, 6), (30, 541, 7), (200, 251, 0))


def unsettled(best: Fit) -> str:
    """Return why the numbers of the best law forbid a decision for it: one is at a bound, or none is identifiable; else "".

    A width of 0 of the unmeasured spins forbids none: balls that are thrown without spin have it.
    """
    bound = [
        f"{name} is {estimate.note}" for name, estimate in best.estimates.items()
        if estimate.value is not None and estimate.stderr is None and estimate.note
        and not (name == "spin_width" and estimate.value <= model_of(best.law, best.problem).parameters[name].low)
    ]  # fmt: skip
    for name, most in NO_BALL.items():
        if name in best.estimates and abs(value := best.estimates[name].value or 0.0) > most:
            bound.append(f"{name} is {value:.3g}, which no ball has")
    if bound:
        return f"its {' and its '.join(bound)}"
    if best.names and all(estimate.value is None for estimate in best.estimates.values()):
        return "none of its parameters is identifiable"
    return ""


def may_have_forms(fit: Fit, problem: Problem) -> bool:
    """Return whether straight lines in place of constants are tried: where that is quick."""
    few = not problem.estimated.any() or len(problem.x) <= MOST_ESTIMATED
    return few and fit.problem.work(fit.law.search_code is not None) <= MOST_WORK


def gain_of_forms(fit: Fit, problem: Problem) -> dict[str, float]:
    """Return by how much AICc falls as constants of a law, one after the other, become straight lines: v_out = slope v + offset;
    friction and the law's last number in the slip.

    Only what the rows support, by 20 to 1 and more, is kept. Empty where no constant is free, and where this would take long.
    ``problem``: the rows, without a scatter between contacts.
    """
    found: dict[str, float] = {}
    setting, least = fit.problem.setting, fit.aicc
    if not may_have_forms(fit, problem):
        return found
    for name in ("restitution", *ALONG):
        if name not in fit.names or getattr(setting, name) != "constant":
            continue
        change: dict[str, Any] = {name: "line" if name == "restitution" else "linear"}
        tried = replace(setting, **change)
        if problem.estimated.any():
            aicc = fit_law(fit.law, replace(problem, setting=tried)).aicc
        else:
            model = model_of(fit.law, replace(fit.problem, setting=tried))
            value = float(model.minimize(model.like(fit.numbers)).value[0])
            aicc = value + fit.determinants + fit.aicc - fit.deviance + 2 * (len(found) + 1)
        if aicc < least - GAIN:
            found[name], least, setting = least - aicc, aicc, tried
    return found


def decided_by_few(best: Fit, rival: Fit, enlarge: float) -> str:
    """Return that few rows decide, in words, where the odds fall below those of a lean without one row in a hundred; else ""."""
    ahead = _deviance_by_row(rival) - _deviance_by_row(best)
    few = np.argsort(-ahead, kind="stable")[: max(1, len(ahead) // 100)]
    others = rival.deviance - best.deviance - float(ahead[few].sum())
    if others / enlarge**2 + (rival.aicc - rival.deviance) - (best.aicc - best.deviance) >= 2 * math.log(LEANS):
        return ""
    first = (best.problem.rebounds.rows or [f"row {i + 1}" for i in range(len(ahead))])[few[0]]
    return f"{first} alone decides" if len(few) == 1 else f"{len(few)} of {len(ahead)} rows decide, {first} first"


def _deviance_by_row(fit: Fit) -> Array:
    problem = fit.problem
    logs = np.log(np.where(np.isfinite(problem.y) & (problem.vy > 0), problem.vy, 1.0)).sum(axis=1)
    return np.asarray(rows_of_fit(fit, problem, fit.numbers)[0] + logs)


def assumptions_in_words(best: Fit, gains: dict[str, float]) -> str:
    """Return the assumptions under which the laws were compared: parameters that are constants or not, spins, errors."""
    setting, problem = best.problem.setting, best.problem
    said = []
    if "restitution" in best.law.free:
        form = setting.restitution
        said.append("a constant restitution" if form == "constant" else f"a restitution of form {form}")
        if "restitution" in gains:
            said[-1] += (
                f" (a straight line in the speed would lower AICc by {gains['restitution']:.3g}: `restitution` line)"
            )
    if problem.spins is not None:
        shape = "mixture" if problem.mixture is not None else setting.spin_prior
        said.append(f"a {shape} distribution of unmeasured spins")
    if problem.nu:
        said.append("errors with heavy tails")
    return f"; assumed: {', '.join(said)}" if said else ""


def odds_note(rows: int, odds: float) -> list[str]:
    """Return a note on what odds mean, with the share of wrong decisions counted for simulated tables of about so many rows."""
    count, decided, wrong = min(COUNTED, key=lambda one: abs(math.log(one[0] / max(rows, 1))))
    if not math.exp(GAIN / 2) <= odds < math.inf:
        return []
    # (of none in n, a share of 3/n or more would be seen with 95 % probability: exp(-3) = 0.05)
    share = (
        f"{wrong} were wrong ({100 * wrong / decided:.1f} %)"
        if wrong
        else f"none was wrong (below {300 / decided:.1f} %)"
    )
    return [
        f"odds are a ratio of evidence, not an error rate: of {decided} decisions at 20 to 1 or more on simulated tables of {count}"
        f" rows, whose true law was among those fitted, {share}"
    ]


def kinked_rows_warning(fit: Fit) -> str:
    """Return a warning if the law is not linear within the error bars before the wall in many rows; else an empty text.

    The information of a row is computed from the law's derivatives at the measured state. If the contact sticks one error bar to
    one side and slides to the other, these do not represent how well the row determines a parameter. The same holds for profiles
    and the bootstrap.
    """
    problem, p = fit.problem, fit.numbers
    if problem.estimated.any() or not problem.vx.any():
        return ""
    here = fit.predicted()
    wide, turn = problem.vy.copy(), np.zeros(problem.y.shape)
    for up, down in predictions_beside(fit.law, problem, p, np.sqrt(problem.vx)):
        wide += np.square((up - down) / 2)
        turn = np.maximum(turn, np.abs(up + down - 2 * here))
    seen = np.isfinite(problem.y)
    share = np.where(seen, turn / np.sqrt(np.where(seen, wide, 1.0)), 0.0).max(axis=1, initial=0.0)
    many = int((share > KINKED_SIGMA).sum())
    if many < KINKED_SHARE * len(share):
        return ""
    return (
        f"error bars before the wall: in {many} of {len(share)} rows they reach from sticking to sliding under {fit.law.name};"
        " nominal 95 % intervals then cover some 80 to 85 %, as do bootstrap and profiles; measure more precisely before the wall"
    )


# ----------------------------------------------------------------------------------------------------
# Validity of a verdict: whether the best law describes the data, and which contacts the data cover.
#
# The best law is tested in two ways. If error bars are given, by the probability of its chi^2. And by the dependence of its
# residuals on incidence, speed, spin or slip: with the rows sorted by one of these, von Neumann's ratio of the ranks of their
# residuals (Bartels, J. Am. Stat. Assoc. 77, 40 (1982)) is 2 if neighbours are independent, and smaller if they are correlated.
# The second test needs no error bars, so that it can reject a law whose scatter was estimated. Its probability is corrected for
# the number of orders tested. It leaves out rows whose spin before the wall was not measured: their residuals depend on that
# spin.


Array = NDArray[np.float64]
SELDOM = 0.05  # probability of a chi^2 below which it is called large
LEAST_ROWS = 10  # for the test of residuals
OUTPUTS = ("v_n", "v_t", "spin")
# With fewer rows, or a smaller range, odds do not apply to other contacts
NARROW_ROWS, NARROW_ANGLE, NARROW_SPEED = 20, 15.0, 1.5  # rows; degrees; ratio of fastest to slowest


@dataclass(frozen=True)
class Adequacy:
    """Tests of whether a fitted law describes the data."""

    chi2_probability: float
    """Probability of a chi^2 at least as large by chance; NaN if scatter was estimated, or errors have heavy tails."""
    pattern_probability: float
    """Probability of residuals at least as dependent by chance; NaN if there are too few rows."""
    pattern: str
    """The residuals with the strongest dependence, and the quantity on which they depend."""
    scattered: bool
    """Whether scatter between contacts was fitted in addition to the error bars."""
    enlarge: float
    """Factor on the error bars for which chi^2 equals the degrees of freedom; 1 if chi^2 is likely."""
    heavy: bool = False
    """Whether errors have heavy tails, so that chi^2 has no known distribution."""

    @property
    def chi2_likely(self) -> bool:
        """Whether chi^2 is as expected by chance, or not known."""
        return not self.chi2_probability <= UNLIKELY

    @property
    def fits(self) -> bool:
        """Whether neither test rejects the law."""
        return self.chi2_likely and not self.pattern_probability <= UNLIKELY

    def as_dict(self) -> dict[str, object]:
        """Return the tests for JSON."""
        return {
            "chi2_probability": json_value(self.chi2_probability),
            "residual_pattern_probability": json_value(self.pattern_probability),
            "residual_pattern": self.pattern or None,
        }

    def in_words(self, law: str) -> str:
        """Return the tests that a law passes, in words, or fails by less than rejects it."""
        poor, chi2, pattern = f"{law} fits poorly", self.chi2_probability, self.pattern_probability
        if chi2 < SELDOM:
            return f"{poor}: its chi^2 is large (p = {chi2:.2g})"
        if pattern < SELDOM:
            return f"{poor}: its residuals depend on what came before ({self.pattern}, p = {pattern:.2g})"
        if not math.isnan(chi2):
            return f"its chi^2 is as expected (p = {chi2:.2g})"
        why = "with heavy tails" if self.heavy else "with a fitted scatter" if self.scattered else "without error bars"
        if math.isnan(pattern):
            return f"its goodness of fit cannot be tested {why}"
        return f"its residuals show no pattern (p = {pattern:.2g}); {why} no other test of it is possible"


@dataclass(frozen=True)
class Coverage:
    """The contacts on which a verdict is based."""

    rows: int
    angle_deg: tuple[float, float]
    """Incidence from the normal, least and largest, whatever the side."""
    speed: tuple[float, float]
    """m/s"""
    spin: tuple[float, float] | None
    """v/a, positive where it runs along v_t; None: not measured."""

    @property
    def narrow(self) -> str:
        """Quantities of which the range is small, in words; empty if there are none."""
        found = []
        if self.rows < NARROW_ROWS:
            found.append(f"{self.rows} rows are few")
        if self.angle_deg[1] - self.angle_deg[0] < NARROW_ANGLE:
            found.append("they cover a small range of incidence")
        if self.speed[1] < NARROW_SPEED * self.speed[0]:
            found.append("they cover a small range of speed")
        return " and ".join(found)

    def in_words(self) -> str:
        """Return rows and ranges."""
        spin = "spin not measured"
        if self.spin is not None:
            low, high = (round(end, 2) + 0.0 for end in self.spin)
            spin = f"spin {low:g} v/a" if low == high else f"spin {low:g} to {high:g} v/a"
        return f"{self.rows} rows, incidence {_range(*self.angle_deg, '°')}, {_range(*self.speed, ' m/s')}, {spin}"

    def as_dict(self) -> dict[str, object]:
        """Return the coverage for JSON."""
        return {
            "rows": self.rows, "incidence_deg": list(self.angle_deg), "speed": list(self.speed),
            "spin": None if self.spin is None else list(self.spin), "narrow": self.narrow or None,
        }  # fmt: skip


def _range(low: float, high: float, unit: str) -> str:
    one, two = f"{low:.3g}", f"{high:.3g}"
    return f"{one}{unit}" if one == two else f"{one} to {two}{unit}"


def coverage(problem: Problem) -> Coverage:
    """Return rows and ranges of incidence, speed and spin; of rows in which something was measured after the wall."""
    x = problem.x[np.isfinite(problem.y).any(axis=1)]
    angle, speed = np.degrees(np.arctan2(np.abs(x[:, 1]), x[:, 0])), np.hypot(x[:, 0], x[:, 1])
    spin = (np.where(x[:, 1] < 0, -1.0, 1.0) * x[:, 2] * problem.setting.radius / speed)[np.isfinite(x[:, 2])]
    ends = None if not len(spin) else (float(spin.min()), float(spin.max()))
    return Coverage(len(x), (float(angle.min()), float(angle.max())), (float(speed.min()), float(speed.max())), ends)


def nothing_along_the_wall(problem: Problem) -> bool:
    """Return whether a ball in flight has no velocity along the wall and no spin within error bars, before and after, in all rows.

    All laws predict the same then: a ball that is dropped straight down says nothing about friction. The test is the chi^2 of
    all these numbers about 0. A ball that rolls on a table slips vertically at the wall, so this is never so there. A number
    other than 0 without an error bar is taken as exact before the wall, and cannot be judged after it.
    """
    from scipy.special import chdtrc

    if problem.rebounds.kind == "table":
        return False
    value = np.concatenate([problem.x[:, 1:], problem.y[:, 1:]], axis=1)
    variance = np.concatenate([problem.vx[:, 1:], np.where(problem.estimated[1:], 0.0, problem.vy[:, 1:])], axis=1)
    value, variance = value[np.isfinite(value)], variance[np.isfinite(value)]
    if (value[variance == 0] != 0).any():
        return False
    value, variance = value[variance > 0], variance[variance > 0]
    return not len(value) or float(chdtrc(len(value), (value**2 / variance).sum())) > UNLIKELY


def adequacy(fit: Fit) -> Adequacy:
    """Test a fitted law by itself: its chi^2, and whether its residuals depend on incidence, speed, spin or slip."""
    from scipy.special import chdtrc

    probability, enlarge = math.nan, 1.0
    if fit.dof > 0 and not fit.scatter and not fit.problem.nu:
        probability = float(chdtrc(fit.dof, fit.chi2))
        enlarge = max(math.sqrt(fit.chi2 / fit.dof), 1.0) if probability <= UNLIKELY else 1.0
    least, words = _pattern(fit)
    return Adequacy(probability, least, words, fit.contact_scatter is not None, enlarge, fit.problem.nu > 0)


def _pattern(fit: Fit) -> tuple[float, str]:
    """Return the probability of the strongest dependence of residuals, corrected for the number of tests, and its name."""
    problem = fit.problem
    v_n, v_t, spin = problem.x.T
    speed, slip = np.hypot(v_n, v_t), v_t - problem.setting.radius * spin
    gap = (problem.y - fit.predicted()) / np.sqrt(np.where(problem.vy > 0, problem.vy, 1.0))
    # contacts from both sides are equivalent by reflection
    side, slips = (np.where(along < 0, -1.0, 1.0) for along in (v_t, slip))
    # the effect of an unmeasured spin depends on the incidence, and is no error of the law
    apart = problem.unknown & feels_spins(fit.law, problem)
    orders = {
        "incidence": (np.abs(v_t) / v_n, side), "speed": (speed, side), "spin": (side * spin / speed, side),
        "slip": (np.abs(slip) / v_n, slips),
    }  # fmt: skip
    found, drifts = [], []
    for m, name in enumerate(OUTPUTS):
        rows = np.isfinite(gap[:, m]) & ((m == 0) | ~apart)
        if rows.sum() >= LEAST_ROWS:
            drifts.append((_serial_probability(gap[rows, m]), f"{name} on the order of the rows"))
        for of, (order, sign) in orders.items():
            rows = np.isfinite(gap[:, m]) & np.isfinite(order) & ~apart
            if rows.sum() >= LEAST_ROWS and len(np.unique(order[rows])) >= LEAST_ROWS:
                residuals = gap[rows, m] * (sign[rows] if m > 0 else 1.0)
                found.append(
                    (_serial_probability(residuals[np.argsort(order[rows], kind="stable")]), f"{name} on {of}")
                )
    # (each kind of order by itself, so that what is found in one does not depend on how many are tried in the other)
    return min(
        ((min(1.0, p * len(tests)), words) for tests in (found, drifts) for p, words in tests), default=(math.nan, "")
    )


def _serial_probability(residuals: Array) -> float:
    """Return the probability that successive ranks are as close by chance (Bartels 1982, normal approximation)."""
    from scipy.special import ndtr

    n, (_values, place, times) = len(residuals), np.unique(residuals, return_inverse=True, return_counts=True)
    ranks = (np.cumsum(times) - (times - 1) / 2)[place]  # (equal ones share theirs)
    spread = float(np.square(ranks - ranks.mean()).sum())
    if not spread > 0:
        return 1.0
    ratio = float(np.square(np.diff(ranks)).sum()) / spread
    variance = 4 * (n - 2) * (5 * n * n - 2 * n - 9) / (5 * n * (n + 1) * (n - 1) ** 2)
    return float(ndtr((ratio - 2) / math.sqrt(variance)))


# ----------------------------------------------------------------------------------------------------
# Outliers: rows that a law does not explain, found by a robust fit that they do not bias.


FALSE_ALARM = 0.05  # probability of an outlier by chance among all rows
STEADY_ROWS = 150  # of many, to which the robust fit is made
LEAST_ROWS_OF_OUTLIERS = 8  # for the search of outliers
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
    apart: bool = False
    """Whether the outliers are few, and the law fits the others, or nearly so and the outliers have changed its parameters."""


def outliers_of(fit: Fit) -> OutlierSearch:
    """Return the rows whose chi^2 occurs by chance in fewer than one of twenty such tables.

    chi^2 is computed with the parameters of a robust fit (Student's t): an ordinary fit is biased by the outliers, and finds none
    if a single row determines a parameter. If the robust fit has other parameters, a note lists them.
    """
    from scipy.special import chdtrc, chdtri

    problem = fit.problem
    d = np.isfinite(problem.y).sum(axis=1)
    if len(d) < LEAST_ROWS_OF_OUTLIERS or not d.any():
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
    moved, fits = tuple(_moved(fit, steady, rows)), rest[1] > 0 and chdtrc(rest[1], rest[0]) > UNLIKELY
    seldom = len(found) <= max(1, MOST_OUTLIERS * len(d))
    wide = rest[0] < STUDENT_NU / (STUDENT_NU - 2) * rest[1]  # (the variance of Student's t)
    return OutlierSearch(tuple(rows), moved, bool(seldom and (fits or (moved and wide))))


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
