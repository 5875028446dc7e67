"""Noise of positions that is correlated from frame to frame: how much, and what it does to a fit.

Trackers follow a spot, a shadow or a blurred edge, and are off by nearly the same in neighbouring frames. The correlation between
frames k apart is taken to be c r^k: c = 1 for noise that fades by the factor r from frame to frame (AR(1)), less if part of it is
independent. Both are estimated from the residuals of fits by restricted likelihood (Patterson and Thompson, Biometrika 58, 545
(1971)), which allows for the share of the noise that each fit absorbs. Fits then weight their frames by the inverse of the
covariance.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["WHITE", "Correlation", "FittedFrames", "FrameGroups", "estimate_correlation", "nearest_frames", "whitening"]

Array = NDArray[np.float64]
FADES, SHARES = (0.3, 0.5, 0.65, 0.8, 0.87, 0.92, 0.95, 0.98), (1.0, 0.85, 0.7, 0.5, 0.3)
SIGNIFICANT = (
    14.0  # of twice the difference of log likelihoods, for two more parameters: by chance in one film of 1,000
)
MAX_FITS, MAX_FRAMES = 12, 200  # of a film, and of a fit: more would only take longer


class Correlation(NamedTuple):
    """The correlation between frames k apart: ``share`` times ``fades``^k."""

    fades: float = 0.0
    share: float = 0.0

    @property
    def neighbours(self) -> float:
        """Between two neighbouring frames."""
        return self.fades * self.share


WHITE = Correlation()


class FrameGroups(NamedTuple):
    """FrameGroups of a fit, some of them means of several: (n,) the first and last time of each, s, and how many they are."""

    first: Array
    last: Array
    number: Array


class FittedFrames(NamedTuple):
    """Data for the estimate from a fit with p parameters: n single frames."""

    time: Array
    """(n,) s."""
    residuals: Array
    """(n, 2): measured less fitted, m."""
    slope: Array
    """(n, 2, p): derivatives of the fitted positions."""
    known: Array
    """(k, p): rows of prior knowledge, per standard deviation."""
    noise: float
    """Standard deviation that prior knowledge is weighed against, m."""


def whitening(frames: FrameGroups, correlation: Correlation, interval: float) -> Array:
    """Return the matrix (n, n) that makes the errors of frames independent, each of the standard deviation of one frame.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks.correlation import Correlation, FrameGroups, whitening
    >>> t = np.arange(3) / 100
    >>> whitening(FrameGroups(t, t, np.ones(3)), Correlation(0.6, 1.0), 0.01).round(3) + 0.0
    array([[ 1.  ,  0.  ,  0.  ],
           [-0.75,  1.25,  0.  ],
           [ 0.  , -0.75,  1.25]])
    """
    lower = np.linalg.cholesky(_covariance(frames, correlation, interval))
    return np.asarray(np.linalg.solve(lower, np.eye(len(lower))))


def _covariance(frames: FrameGroups, correlation: Correlation, interval: float) -> Array:
    """Return the covariance (n, n) of the errors of frames, in units of the variance of one."""
    first, last, m = frames
    fades, share = correlation
    step = np.where(m > 1, (last - first) / np.maximum(m - 1, 1) / interval, 1.0)
    g = fades**step
    mean = np.where(m > 1, (1 - g**m) / (m * (1 - g)), 1.0)  # of g^k over a group, k from its edge
    apart = np.maximum(first[None, :] - last[:, None], 0.0) / interval
    upper = np.triu(share * mean[:, None] * fades**apart * mean[None, :], 1)
    own = np.where(m > 1, ((1 + g) / (1 - g) - 2 * g * (1 - g**m) / (m * (1 - g) ** 2)) / m, 1.0)
    return np.asarray(upper + upper.T + np.diag((1 - share) / m + share * own))


def nearest_frames(time: Array, near: float) -> NDArray[np.intp]:
    """Return the rows of the frames of a fit, nearest to its contact, that serve the estimate."""
    return np.sort(np.argsort(np.abs(time - near), kind="stable")[:MAX_FRAMES])


def estimate_correlation(fits: Sequence[FittedFrames], interval: float) -> Correlation:
    """Return the correlation of the noise of a film, or WHITE if its residuals do not show any.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks.correlation import FittedFrames, estimate_correlation
    >>> t, noise = np.arange(200) / 100, np.random.default_rng(1).normal(size=(200, 2))
    >>> slope, known = np.ones((200, 2, 1)), np.zeros((0, 1))
    >>> tuple(estimate_correlation([FittedFrames(t, noise, slope, known, 1.0)], 0.01))
    (0.0, 0.0)
    >>> for i in range(1, 200):
    ...     noise[i] += 0.9 * noise[i - 1]
    >>> tuple(estimate_correlation([FittedFrames(t, noise, slope, known, 1.0)], 0.01))
    (0.87, 1.0)
    """
    some = list(fits[:: len(fits) // MAX_FITS + 1])
    if not some or not interval > 0 or _neighbours_differ(some):
        return WHITE
    best, least = WHITE, _deviance(some, WHITE, interval)
    white = least
    for fades in FADES:
        for share in SHARES:
            one = Correlation(fades, share)
            deviance = _deviance(some, one, interval)
            if deviance < least:
                best, least = one, deviance
    return best if white - least > SIGNIFICANT else WHITE


def _neighbours_differ(fits: Sequence[FittedFrames]) -> bool:
    """Return whether neighbouring residuals are as different as independent ones: a quick look, which saves the likelihood."""
    products = sum(float((one.residuals[1:] * one.residuals[:-1]).sum()) for one in fits)
    squares = sum(float((one.residuals**2).sum()) for one in fits)
    return not products > squares / np.sqrt(sum(one.residuals.size for one in fits))


def _deviance(fits: Sequence[FittedFrames], correlation: Correlation, interval: float) -> float:
    """Return minus twice the logarithm of the restricted likelihood, at the best size of the noise."""
    from scipy.linalg import solve_triangular

    total = squares = 0.0
    free = 0
    for time, residuals, slope, known, noise in fits:
        n, p = len(residuals), slope.shape[2]
        lower = np.linalg.cholesky(_covariance(FrameGroups(time, time, np.ones(n)), correlation, interval))
        white = solve_triangular(lower, np.concatenate([slope.reshape(n, 2 * p), residuals], axis=1), lower=True)
        columns = np.concatenate([white[:, : 2 * p].reshape(2 * n, p) / noise, known])
        r = np.concatenate([white[:, 2 * p :].ravel() / noise, np.zeros(len(known))])
        size = np.sqrt((columns * columns).sum(axis=0)) + 1e-300  # the same for every correlation but for a constant
        q, upper = np.linalg.qr(columns / size)
        r = r - q @ (q.T @ r)
        squares += float(r @ r)
        free += len(r) - p
        total += 2 * float(np.log(np.maximum(np.abs(np.diag(upper)), 1e-150)).sum() + np.log(size).sum())
        total += 4 * float(np.log(np.diag(lower)).sum())
    return total + free * float(np.log(max(squares, 1e-300) / max(free, 1)))
