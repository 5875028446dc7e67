"""Noise of positions that is correlated from frame to frame: how much, and what it does to a fit.

Trackers follow a spot, a shadow or a blurred edge, and are off by nearly the same in neighbouring frames. The correlation between
frames k apart is taken to be c r^k: c = 1 for noise that fades by the factor r from frame to frame (AR(1)), less if part of it is
independent. Both are estimated from the residuals of fits by restricted likelihood (Patterson and Thompson, Biometrika 58, 545
(1971)), which allows for the share of the noise that each fit absorbs. Fits then weight their frames by the inverse of the
covariance, where a correlation is certain. Few frames show it poorly: the error bars are means over all correlations, each with its
probability, of which one half is that of independent noise before the frames are seen.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "WHITE",
    "Correlation",
    "FittedFrames",
    "FrameGroups",
    "LikelyCorrelation",
    "averaged_frames",
    "averaging_error",
    "estimate_correlation",
    "nearest_frames",
    "weigh_correlations",
    "whitening",
]

Array = NDArray[np.float64]
FADES, SHARES = (0.3, 0.5, 0.65, 0.8, 0.87, 0.92, 0.95, 0.98), (1.0, 0.85, 0.7, 0.5, 0.3)
SIGNIFICANT = (
    14.0  # of twice the difference of log likelihoods, for two more parameters: by chance in one film of 1,000
)
MAX_FITS, MAX_FRAMES = 12, 200  # of a film, and of a fit: more would only take longer
# If a side of a contact has more frames than this, they are averaged in this number of groups, except for those next to it.
MAX_SINGLE_FRAMES, GROUPS, NEAR_FRAMES = 160, 56, 8
CERTAIN_FRAMES = 400  # so many whose neighbours differ as independent ones do leave no doubt
LEAST_PROBABILITY = 1e-4  # of a correlation that counts


class Correlation(NamedTuple):
    """The correlation between frames k apart: ``share`` times ``fades``^k."""

    fades: float = 0.0
    share: float = 0.0

    @property
    def neighbours(self) -> float:
        """Between two neighbouring frames."""
        return self.fades * self.share


WHITE = Correlation()
GRID = (WHITE, *(Correlation(fades, share) for fades in FADES for share in SHARES))
# Of independent noise one half; the other half alike for all others, whose times of fading are about evenly spaced in the logarithm
PRIOR = np.append(0.5, np.full(len(GRID) - 1, 0.5 / (len(GRID) - 1)))


class LikelyCorrelation(NamedTuple):
    """A correlation that the residuals of a film allow."""

    probability: float
    correlation: Correlation
    variance: float
    """Of one coordinate of one frame, in units of the square of the noise assumed in the fits."""


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
    """(n, c): measured less fitted, m, of the coordinates that were measured: two, or the height alone."""
    slope: Array
    """(n, c, p): derivatives of the fitted positions."""
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


def averaged_frames(t: Array, x: Array, middle: float) -> tuple[Array, Array, FrameGroups]:
    """Average neighbouring frames if a side of the contact has more than MAX_SINGLE_FRAMES: times, positions, and which they are.

    The frames next to the contact are kept. Over a few ms the path of a ball is straight to some micrometres, so a mean is as
    good as its frames; and if their errors are not independent (pixels without noise), the means show it: they scatter more
    than independent errors would.
    """
    times, places, ends = [], [], []
    for side in (t < middle, t >= middle):
        s, y = t[side], x[side]
        size = max(1, (len(s) - NEAR_FRAMES) // GROUPS) if len(s) > MAX_SINGLE_FRAMES else 1
        order = slice(None) if s[0] >= middle else slice(None, None, -1)  # counted from the contact
        group = np.maximum((np.arange(len(s)) - NEAR_FRAMES) // size, -1)[order]
        group = np.where(group < 0, np.arange(len(s))[order] - NEAR_FRAMES, group)
        group -= group.min()
        count = np.bincount(group)
        keep = count > 0
        means = [np.bincount(group, one)[keep] / count[keep] for one in (s, y[:, 0], y[:, 1])]
        rows = np.argsort(means[0])
        times.append(means[0][rows])
        places.append(np.stack(means[1:], axis=-1)[rows])
        last = np.append(np.flatnonzero(np.diff(group)), len(s) - 1)  # of each group, in order of time
        ends.append(FrameGroups(s[np.append(0, last[:-1] + 1)], s[last], count[keep][rows].astype(float)))
    return np.concatenate(times), np.concatenate(places), FrameGroups(*map(np.concatenate, zip(*ends, strict=True)))


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
    some = _some(fits)
    if not some or not interval > 0 or _neighbours_differ(some):
        return WHITE
    deviance, _variance = _deviances(some, interval)
    best = int(np.argmin(deviance))
    return GRID[best] if deviance[0] - deviance[best] > SIGNIFICANT else WHITE


def weigh_correlations(fits: Sequence[tuple[Hashable, FittedFrames]], interval: float) -> tuple[LikelyCorrelation, ...]:
    """Return the correlations that the residuals of a film allow, with their probabilities; none where only WHITE is left.

    Each fit comes with the name of its ball, whose flight between two contacts belongs to the fits of both and counts once.

    Examples
    --------
    Ten frames whose residuals look independent leave some doubt; 300 do not:

    >>> import numpy as np
    >>> from carom.tracks.correlation import FittedFrames, weigh_correlations
    >>> noise = np.random.default_rng(1).normal(size=(300, 2))
    >>> for n in (10, 300):
    ...     fit = FittedFrames(np.arange(n) / 100, noise[:n], np.ones((n, 2, 1)), np.zeros((0, 1)), 1.0)
    ...     found = weigh_correlations([("ball", fit)], 0.01)
    ...     round(found[0].probability, 1), found[0].correlation.neighbours
    (0.8, 0.0)
    (1.0, 0.0)
    """
    some = _some([fit for _ball, fit in fits])
    distinct = len({(ball, t) for ball, fit in fits for t in fit.time.tolist()})
    if not some or not interval > 0 or (distinct > CERTAIN_FRAMES and _neighbours_differ(some)):
        return ()
    deviance, variance = _deviances(some, interval)
    once = distinct / sum(len(fit.time) for _ball, fit in fits)
    weight = PRIOR * np.exp(-once / 2 * (deviance - deviance.min()))
    weight = np.where(weight > LEAST_PROBABILITY * weight.sum(), weight, 0.0)
    return tuple(map(LikelyCorrelation, (weight / weight.sum()).tolist(), GRID, variance.tolist()))


def averaging_error(
    fit: FittedFrames, used: Correlation, likely: Sequence[LikelyCorrelation], interval: float
) -> Array:
    """Return the part of the covariance (p, p) of fitted parameters that comes from the unknown correlation.

    The mean over all correlations, less the covariance for the one that was ``used`` as the weights of the frames.
    """
    time, _residuals, slope, known, noise = fit
    n, c, p = slope.shape
    frames = FrameGroups(time, time, np.ones(n))
    assumed = _covariance(frames, used, interval)
    size = next(one.variance for one in likely if one.correlation == used)
    lacking = -assumed
    for one in likely:
        if one.probability:
            lacking += one.probability * one.variance / size * _covariance(frames, one.correlation, interval)
    slope = slope / noise
    weighted = np.linalg.solve(assumed, slope.reshape(n, c * p)).reshape(n, c, p)
    inverse = np.linalg.pinv(np.einsum("ncp,ncq->pq", slope, weighted) + known.T @ known, rcond=1e-14, hermitian=True)
    gain = np.einsum("pq,ncq->cpn", inverse, weighted)
    return np.asarray(np.einsum("cpn,nm,cqm->pq", gain, lacking, gain, optimize=True))


def _some(fits: Sequence[FittedFrames]) -> list[FittedFrames]:
    """Return as many fits of a film as serve the estimate."""
    return list(fits[:: len(fits) // MAX_FITS + 1])


def _neighbours_differ(fits: Sequence[FittedFrames]) -> bool:
    """Return whether neighbouring residuals are as different as independent ones: a quick look, which saves the likelihood."""
    products = sum(float((one.residuals[1:] * one.residuals[:-1]).sum()) for one in fits)
    squares = sum(float((one.residuals**2).sum()) for one in fits)
    return not products > squares / np.sqrt(sum(one.residuals.size for one in fits))


def _deviances(fits: Sequence[FittedFrames], interval: float) -> tuple[Array, Array]:
    """Return minus twice the log of the restricted likelihood (g,) for GRID, at the best variance of the noise, and that (g,)."""
    total, squares, free = np.zeros(len(GRID)), np.zeros(len(GRID)), 0
    for time, residuals, slope, known, noise in fits:
        n, c, p = slope.shape
        white, spread = _whitened(np.concatenate([slope.reshape(n, c * p), residuals], axis=1), time, interval)
        knowns = np.broadcast_to(known, (len(GRID), *known.shape))
        columns = np.concatenate([white[..., : c * p].reshape(len(GRID), c * n, p) / noise, knowns], axis=1)
        r = np.concatenate([white[..., c * p :].reshape(len(GRID), c * n) / noise, np.zeros(knowns.shape[:2])], axis=1)
        size = np.sqrt((columns[0] ** 2).sum(axis=0)) + 1e-300  # (its constant is the same for every correlation)
        q, upper = np.linalg.qr(columns / size)
        r = r - np.einsum("grp,gp->gr", q, np.einsum("grp,gr->gp", q, r))
        squares += (r * r).sum(axis=1)
        free += r.shape[1] - p
        total += 2 * np.log(np.maximum(np.abs(np.diagonal(upper, axis1=1, axis2=2)), 1e-150)).sum(axis=1)
        total += c * spread
    variance = np.maximum(squares, 1e-300) / max(free, 1)
    return total + free * np.log(variance), variance


def _whitened(columns: Array, time: Array, interval: float) -> tuple[Array, Array]:
    """Return columns (n, m) of frames with independent errors (g, n, m) for GRID, and the log determinant of their covariance (g,).

    The part of the noise that fades is followed from frame to frame (Kalman's filter), in as many steps as there are frames.
    """
    fades, share = np.array(GRID).T
    kept = fades[:, None] ** (np.diff(time, prepend=time[:1]) / interval)
    expected, variance = np.zeros((len(GRID), columns.shape[1])), share.copy()
    white, log_det = np.empty((len(GRID), *columns.shape)), np.zeros(len(GRID))
    for i, row in enumerate(columns):
        if i:
            g = kept[:, i]
            expected, variance = g[:, None] * expected, g * g * variance + share * (1 - g * g)
        whole = np.maximum(variance + 1 - share, 1e-12)
        gap = row - expected
        white[:, i] = gap / np.sqrt(whole)[:, None]
        log_det += np.log(whole)
        gain = variance / whole
        expected, variance = expected + gain[:, None] * gap, variance * (1 - gain)
    return white, log_det
