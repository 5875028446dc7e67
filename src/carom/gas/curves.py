"""Curves averaged over the samples of a gas: distributions of velocity and spin, displacements, pair correlations."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

__all__ = ["Displacement", "Distribution", "Outflow", "PairCorrelation"]

Array = NDArray[np.float64]
FIT_STEPS, LARGEST_LOG = 50, 30.0  # of the fit of g at contact
MAX_LOG_ERROR = 0.25  # of log g at contact: with fewer pairs it is not given


@dataclass(frozen=True, eq=False)
class Distribution:
    """Distribution of the velocity or spin components of a species, in units of their standard deviation at each time."""

    center: Array
    """Middles of the bins, (B,), in standard deviations."""
    density: Array
    """Probability density, (B,)."""
    error: Array
    """Statistical error of the density, from the counts, (B,)."""
    a2: float
    """The fourth cumulant of d components, d <c^4> / ((d + 2) <c^2>^2) - 1: 0 for a Maxwellian."""

    @property
    def maxwell(self) -> Array:
        """Return the Maxwellian of the same width, (B,)."""
        density: Array = np.exp(-(self.center**2) / 2) / math.sqrt(2 * math.pi)
        return density


@dataclass(frozen=True, eq=False)
class Displacement:
    """Mean square displacement as a function of the lag time, averaged over starting times."""

    lag: Array
    square: Array
    dimensions: int

    @property
    def diffusion(self) -> float:
        """Diffusion coefficient in d dimensions: slope of the later two thirds over 2 d (Einstein); nan with too few lags."""
        late = self.lag >= self.lag.max(initial=0.0) / 3
        if late.sum() < 3 or not (self.square[late] > 0).all():
            return math.nan
        # the error of a mean square is proportional to it
        line = Polynomial.fit(self.lag[late], self.square[late], 1, w=1 / self.square[late]).convert()
        return float(line.coef[1] / (2 * self.dimensions))


@dataclass(frozen=True)
class Outflow:
    """Balls that left a gas through a periodic border along gravity, and came in again on the other side."""

    axis: str
    """Along which they fall: "x", "y" or "z"."""
    balls: int
    """How many more went with gravity than against it."""
    time: float
    """In which they did (s)."""

    @property
    def rate(self) -> float:
        """Balls per unit time (1/s)."""
        return self.balls / self.time if self.time > 0 else math.nan

    def to_dict(self) -> dict[str, str | float]:
        """Return axis, balls, time and rate."""
        return {"axis": self.axis, "balls": self.balls, "time": self.time, "rate": self.rate}


@dataclass(frozen=True, eq=False)
class PairCorrelation:
    """Pair correlation function g(r) of two species."""

    distance: Array
    """Distances of the centres, (B,): the middles of the bins."""
    g: Array
    error: Array
    """Statistical error of g, from the counts, (B,)."""
    contact_distance: float
    """Distance of the centres in contact."""

    one_pair: Array
    """g of one counted pair, (B,)."""

    @property
    def contact(self) -> float:
        """g at contact: a parabola for log g up to 1.25 contact distances, of greatest likelihood; nan with too few pairs."""
        return self._at_contact()[0]

    @property
    def contact_error(self) -> float:
        """Standard error of :attr:`contact`, from the counts; nan with too few pairs."""
        return self._at_contact()[1]

    def _at_contact(self) -> tuple[float, float]:
        """Return g at contact and its standard error.

        The counts are those of Poisson's distribution, each pair counted twice. Weights follow from the fitted curve: those of the
        counts themselves would prefer bins that have more than their share.
        """
        near = self.distance < 1.25 * self.contact_distance
        g, unit = self.g[near], self.one_pair[near]
        if (g > 0).sum() < 4:
            return math.nan, math.nan
        powers = np.vander(self.distance[near] / self.contact_distance - 1, 3, increasing=True)
        log, rows, factors = np.full(len(g), math.log(g.mean())), powers, np.zeros(3)
        for _ in range(FIT_STEPS):  # Newton's
            weight = np.sqrt(np.exp(log) / (2 * unit))
            rows = powers * weight[:, None]
            factors = np.linalg.lstsq(rows, weight * (log + g * np.exp(-log) - 1), rcond=None)[0]
            log, before = np.clip(powers @ factors, -LARGEST_LOG, LARGEST_LOG), log
            if np.abs(log - before).max() < 1e-12:
                break
        value, error = math.exp(factors[0]), math.sqrt(np.linalg.inv(rows.T @ rows)[0, 0])
        # (an exponential of so uncertain a logarithm is biased, and far from normally distributed)
        return (value, value * error) if error < MAX_LOG_ERROR else (math.nan, math.nan)
