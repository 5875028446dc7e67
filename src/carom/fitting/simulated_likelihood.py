"""How likely numbers are by simulations: the mean of simulated features as a function of the numbers, and their scatter about it.

Simulations are few, so the means are polynomials of the numbers, fitted to all simulations. The scatter of whole simulations about
them has the noise of one path with all its correlations; it is larger or smaller by a factor that depends exponentially on the
numbers. Measured features then have the distribution of one more simulation: Student's, in several dimensions, since means and
scatter are known from so many simulations only (Box & Tiao, Bayesian Inference in Statistical Analysis, Wiley 1973, ch. 8; such a
likelihood of features is that of Wood, Nature 466, 1102 (2010), doi:10.1038/nature09319). Numbers that are implausible under the
simulations of one round are not simulated in the next.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations_with_replacement
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Deviance", "Simulated", "interval", "likelihood_of", "plausible"]

Array = NDArray[np.float64]
Deviance = Callable[[Array], Array]
DEGREES = (1, 2, 3)  # of the polynomials
LEAST_FREE = 5  # degrees of freedom of the scatter
SAME = 1e-6  # of the largest variation of the features: those that vary less are combinations of the others
REWEIGHTED, STIFF = (
    2,
    4.0,
)  # times that weights are made; the slopes of the scatter's logarithm are as if known to be 0 ± 1/2
DRAWS, FEWEST = 10_000, 100  # numbers drawn at once, and those to go on with
ZOOMS, MARGIN = 5, 0.05  # boxes one in another; of a box
IMPLAUSIBLE = 20.0  # deviance above the smallest


class Simulated(NamedTuple):
    """Means of F features, and their scatter, as functions of P numbers, from simulations."""

    degree: int
    centre: Array
    reach: Array
    target: Array
    """Measured features (F,), each in the units of ``coefficients``."""
    coefficients: Array
    inverse: Array
    """Of the normal equations: the variance of the means, in the scatter's."""
    precision: Array
    """The inverse of the sum of squares of the scatter (F, F)."""
    slope: Array
    """Of the logarithm of the variance (P,), about ``middle``."""
    middle: Array
    free: int
    """Degrees of freedom of the scatter."""
    left_out: float
    """The logarithm of the scatter about means from all other simulations."""

    def distance(self, numbers: Array) -> tuple[Array, Array]:
        """Return chi^2 of the measured features at numbers (N, P), and the logarithm of the scatter's determinant."""
        u = (numbers - self.centre) / self.reach
        x = _powers(u, self.degree)
        spread = np.exp((u - self.middle) @ self.slope) + _squares(x, self.inverse)
        off = x @ self.coefficients - self.target
        return self.free * _squares(off, self.precision) / spread, len(self.target) * np.log(spread)

    def deviance(self, numbers: Array) -> Array:
        """Return -2 times the logarithm of the likelihood of numbers (N, P), but for a constant (N,)."""
        chi2, volume = self.distance(numbers)
        found: Array = (self.free + len(self.target)) * np.log1p(chi2 / self.free) + volume
        return found

    def probability(self, numbers: Array) -> tuple[float, int, float]:
        """Return the smallest chi^2 at numbers (N, P), its degrees of freedom, and the probability of one as large."""
        from scipy.stats import f as distribution

        chi2, free = float(self.distance(numbers)[0].min()), len(self.target) - numbers.shape[1]
        return chi2, free, float(distribution.sf(chi2 / free, free, self.free)) if free > 0 else 1.0


def likelihood_of(inputs: Array, outputs: Array, target: Array) -> Simulated | None:
    """Return what simulations with numbers (N, P) and features (N, F) say of measured features (F,); None if they are too few.

    The degree of the polynomials is that which predicts simulations best that are left out.
    """
    scale = np.maximum(outputs.std(axis=0), 1e-9)
    middle = outputs.mean(axis=0)
    _left, size, basis = np.linalg.svd((outputs - middle) / scale, full_matrices=False)
    independent = basis[size > SAME * size[0]].T
    y, wanted = (outputs - middle) / scale @ independent, (target - middle) / scale @ independent
    low, high = inputs.min(axis=0), inputs.max(axis=0)
    centre, reach = (high + low) / 2, (high - low) / 2 + 1e-300
    u = (inputs - centre) / reach
    found = [_of_degree(degree, u, y, wanted, centre, reach) for degree in DEGREES]
    return min((one for one in found if one is not None), key=lambda one: one.left_out, default=None)


def _of_degree(degree: int, u: Array, y: Array, wanted: Array, centre: Array, reach: Array) -> Simulated | None:
    x, features = _powers(u, degree), y.shape[1]
    free = len(x) - x.shape[1] - features + 1
    if free < LEAST_FREE:
        return None
    middle = u.mean(axis=0)
    slope: Array = np.zeros(u.shape[1])
    for again in range(REWEIGHTED + 1):
        root = np.exp(-(u - middle) @ slope / 2)[:, None]
        xw, yw = root * x, root * y
        inverse = np.linalg.pinv(xw.T @ xw, hermitian=True)
        coefficients = inverse @ (xw.T @ yw)
        # each simulation beside means from all others
        alone = (yw - xw @ coefficients) / np.maximum(1 - _squares(xw, inverse), 1e-3)[:, None]
        if again < REWEIGHTED:
            each, v = np.log(_squares(alone, np.linalg.pinv(alone.T @ alone, hermitian=True)) + 1e-12), u - middle
            slope = slope + np.linalg.solve(v.T @ v + STIFF * np.eye(len(slope)), v.T @ (each - each.mean()))
    scatter = yw - xw @ coefficients
    precision = np.linalg.pinv(scatter.T @ scatter, hermitian=True)
    left_out = float(np.linalg.slogdet(alone.T @ alone)[1])
    return Simulated(degree, centre, reach, wanted, coefficients, inverse, precision, slope, middle, free, left_out)


def _squares(rows: Array, form: Array) -> Array:
    """Return the quadratic form (N,) of each row (N, M)."""
    found: Array = ((rows @ form) * rows).sum(axis=1)
    return found


def _powers(u: Array, degree: int) -> Array:
    """Return 1, the numbers (N, P), and their products of up to ``degree``, by columns."""
    columns = [np.ones(len(u))]
    for size in range(1, degree + 1):
        columns += [u[:, list(which)].prod(axis=1) for which in combinations_with_replacement(range(u.shape[1]), size)]
    return np.column_stack(columns)


def plausible(
    deviances: Sequence[Deviance], begin: Array, end: Array, rng: np.random.Generator
) -> tuple[Array, Deviance]:
    """Return numbers (N, P), drawn from a box, that are plausible under the simulations of every round so far, and the deviance
    under those of the last, infinite where numbers are implausible.
    """
    low, high, lowest = begin, end, np.full(len(deviances), np.inf)
    kept: Array = (begin + end)[None] / 2
    for _ in range(ZOOMS):
        drawn = low + (high - low) * rng.random((DRAWS, len(begin)))
        rises, good = np.zeros(len(drawn)), np.ones(len(drawn), dtype=bool)
        for k, deviance in enumerate(deviances):
            value = deviance(drawn)
            lowest[k] = min(lowest[k], value[good].min() if good.any() else np.inf)
            rises = np.maximum(rises, value - lowest[k])
            good &= value < lowest[k] + IMPLAUSIBLE
        kept = drawn[good] if good.sum() >= FEWEST else drawn[np.argsort(rises)[:FEWEST]]
        low, high = _box_about(kept, begin, end)

    def last(numbers: Array) -> Array:
        """Return the deviance (N,) of numbers (N, P)."""
        found = deviances[-1](numbers)
        for deviance, least in zip(deviances, lowest, strict=True):
            found = np.where(deviance(numbers) < least + IMPLAUSIBLE, found, np.inf)
        return found

    return kept, last


def interval(deviance: Deviance, near: Array, begin: Array, end: Array, rise: float, rng: np.random.Generator) -> Array:
    """Return the ends (2, P) between which each number, with the best others, has a deviance less than ``rise`` above the smallest.

    ``near`` are plausible numbers (N, P). An end that is as near to the box's as a hundredth of the interval is the box's.
    """
    low, high = _box_about(near, begin, end)
    kept, lowest = near, np.inf
    for _ in range(ZOOMS):
        drawn = np.concatenate([kept, low + (high - low) * rng.random((DRAWS, len(begin)))])
        value = deviance(drawn)
        lowest = min(lowest, float(value.min()))
        kept = drawn[value < lowest + rise]
        low, high = _box_about(kept, begin, end)
    ends = np.stack([kept.min(axis=0), kept.max(axis=0)])
    close = 1e-2 * (ends[1] - ends[0])
    return np.stack([np.where(ends[0] - begin < close, begin, ends[0]), np.where(end - ends[1] < close, end, ends[1])])


def _box_about(kept: Array, begin: Array, end: Array) -> tuple[Array, Array]:
    low, high = kept.min(axis=0), kept.max(axis=0)
    margin = MARGIN * (high - low) + 1e-9 * (end - begin)
    return np.maximum(low - margin, begin), np.minimum(high + margin, end)
