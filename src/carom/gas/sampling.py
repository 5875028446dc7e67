"""When samples of a gas are taken: where walls oscillate, at all phases of their oscillations.

Equally spaced samples of a wall with 50 Hz, 0.04 s apart, would all be of one phase, and so would all that is averaged over them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.random import uniform

__all__ = ["spread_time"]

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
