"""Validity of a verdict: whether the best law describes the data, and which contacts the data cover.

The best law is tested in two ways. If error bars are given, by the probability of its chi^2. And by the dependence of its
residuals on incidence, speed, spin or slip: with the rows sorted by one of these, von Neumann's ratio of the ranks of their
residuals (Bartels, J. Am. Stat. Assoc. 77, 40 (1982)) is 2 if neighbours are independent, and smaller if they are correlated. The
second test needs no error bars, so that it can reject a law whose scatter was estimated. Its probability is corrected for the
number of orders tested. It leaves out rows whose spin before the wall was not measured: their residuals depend on that spin.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.evidence import UNLIKELY
from carom.fitting.model import feels_spins
from carom.fitting.result import Fit
from carom.formatting import json_value

__all__ = ["Adequacy", "Coverage", "adequacy", "coverage", "nothing_along_the_wall"]

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

    def in_words(self) -> str:
        """Return the tests that the law passes, in words."""
        chi2 = f"its chi^2 is as expected (p = {self.chi2_probability:.2g})"
        if self.chi2_probability < SELDOM:
            chi2 = f"its chi^2 is large, but not large enough to reject it (p = {self.chi2_probability:.2g})"
        if not math.isnan(self.chi2_probability):
            return chi2
        why = "with heavy tails" if self.heavy else "with a fitted scatter" if self.scattered else "without error bars"
        if math.isnan(self.pattern_probability):
            return f"its goodness of fit cannot be tested {why}"
        return (
            f"its residuals show no pattern (p = {self.pattern_probability:.2g}); {why} no other test of it is possible"
        )


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
    found = []
    for m, name in enumerate(OUTPUTS):
        for of, (order, sign) in orders.items():
            rows = np.isfinite(gap[:, m]) & np.isfinite(order) & ~apart
            if rows.sum() >= LEAST_ROWS and len(np.unique(order[rows])) >= LEAST_ROWS:
                residuals = gap[rows, m] * (sign[rows] if m > 0 else 1.0)
                found.append(
                    (_serial_probability(residuals[np.argsort(order[rows], kind="stable")]), f"{name} on {of}")
                )
    if not found:
        return math.nan, ""
    probability, words = min(found)
    return min(1.0, probability * len(found)), words


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
