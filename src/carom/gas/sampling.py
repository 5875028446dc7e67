"""When samples of a gas and its snapshots are taken: where walls oscillate, samples at all phases of their oscillations.

Equally spaced samples of a wall with 50 Hz, 0.04 s apart, would all be of one phase, and so would all that is averaged over them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.random import uniform

__all__ = ["Every", "LogTimes", "next_due", "spread_time"]

SAME = 1e-9  # of an interval: times that differ by less are the same, but for rounding


@dataclass(frozen=True)
class LogTimes:
    """Times at equal ratios, such as snapshots of a gas that cools: ``first``, then so many for each factor of ten.

    Examples
    --------
    >>> from carom.gas.sampling import LogTimes
    >>> [round(LogTimes(0.5, 2).after(t), 3) for t in (0.0, 0.5, 1.0, 2.0)]
    [0.5, 1.581, 1.581, 5.0]
    """

    first: float
    per_decade: float

    def after(self, passed: float) -> float:
        """Return the next time after one that has passed."""
        if passed < self.first * (1 - SAME):
            return self.first
        k = math.floor(self.per_decade * math.log10(passed / self.first) + SAME) + 1
        return float(self.first * 10 ** (k / self.per_decade))

    def count(self, duration: float) -> float:
        """Return how many of them are within a duration."""
        return self.per_decade * math.log10(duration / self.first) + 1 if duration >= self.first else 0.0


Every = int | float | LogTimes
"""Between two snapshots: a number of collisions (an int), a time (a float), or equal ratios of time."""


def next_due(every: Every, passed: float) -> float:
    """Return the collisions, or the time, since the measurement began after which the next snapshot is due."""
    if isinstance(every, LogTimes):
        return every.after(passed)
    return (math.floor(passed / every + SAME) + 1) * every


# Shares of an interval at which a sample may be taken. Equal steps could fall on one phase of a fast wall, irregular ones cannot.
SHARES = np.array([uniform(0, 0, n) for n in range(256)])


def spread_time(end: float, width: float, frequencies: ArrayLike, earlier: ArrayLike, stride: int = 1) -> float:
    """Return the time within the interval before ``end`` whose phases of all oscillations are farthest from those at earlier times.

    Every ``stride``-th of the samples counts more for each other: they are to be spread by themselves, too.

    What is least is the sum of x^2 - x over the differences x of phases, in periods, on which the mean square of the discrepancy
    depends; so the phases are filled as evenly as by van der Corput's sequence. Without oscillations, or an interval: ``end``.

    Examples
    --------
    >>> from carom.gas.sampling import spread_time
    >>> times = [0.04]
    >>> for k in range(2, 9):
    ...     times.append(spread_time(0.04 * k, 0.04, [50.0], times))
    >>> sorted(round(t * 50 % 1 * 8) % 8 for t in times)
    [0, 1, 2, 3, 4, 5, 6, 7]
    """
    rates, before = np.asarray(frequencies, dtype=float), np.asarray(earlier, dtype=float)
    if len(rates) == 0 or len(before) == 0 or not width > 0:
        return end
    times: NDArray[np.float64] = end - width * SHARES
    weight = np.ones(len(before))
    weight[len(before) % stride :: stride] = stride
    apart = np.mod((times[:, None, None] - before[:, None]) * rates, 1.0)
    return float(times[np.argmin((apart * (apart - 1)).sum(axis=2) @ weight)])
