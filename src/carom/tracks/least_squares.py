"""Least squares for one contact: the motions before and after it are fitted together and meet at the wall.

Vectors are in the frame of the wall: the first component is the distance from the wall along its normal, the second runs
along the wall, counter-clockwise from the normal. The time of the contact is a parameter and lies between frames. The
minimisers are SciPy's (the extra ``carom[fit]``); error bars are computed from the Jacobian at the solution, with the noise as
given or as estimated from the residuals.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FADES, SHARES = (0.3, 0.5, 0.65, 0.8, 0.87, 0.92, 0.95, 0.98), (1.0, 0.85, 0.7, 0.5, 0.3)
# Of twice the difference of log likelihoods, for two more parameters: by chance in one film of 1,000
SIGNIFICANT = 14.0
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
    >>> from carom.tracks.least_squares import Correlation, FrameGroups, whitening
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
    >>> from carom.tracks.least_squares import FittedFrames, estimate_correlation
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
    >>> from carom.tracks.least_squares import FittedFrames, weigh_correlations
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


# ----------------------------------------------------------------------------------------------------
# Least squares for one contact: the motions before and after it are fitted together and meet at the wall.


Model = Callable[[Array], Array]

# The quantities of a contact, in the order of ``ContactFit.value``. Velocities (v) and slips (u) have a component away from the
# wall (n) and one along it (t); in: before the contact, out: after it, roll: once the ball rolls again.
OUTPUTS = (
    "t", "away", "along", "vn_in", "vt_in", "vn_out", "vt_out", "vn_roll", "vt_roll",
    "un_in", "ut_in", "un_out", "ut_out", "mu_g", "c_g", "slides", "hop",
)  # fmt: skip
# Of these, time, place and velocities of the contact itself, which every fit has.
AT_CONTACT = slice(OUTPUTS.index("t"), OUTPUTS.index("vt_out") + 1)
START_IN, START_OUT = slice(3, 5), slice(5, 7)  # velocities of :func:`starting_values`


@dataclass(frozen=True)
class Prior:
    """Prior knowledge of the floor: decelerations in m/s^2, each with its standard deviation."""

    mu_g: float = 2.0
    """While the ball slides: friction times gravity."""
    mu_g_error: float = 0.8
    c_g: float = 0.08
    """While it rolls: rolling resistance times gravity."""
    c_g_error: float = 0.06
    k: float = 2 / 7
    """kappa / (1 + kappa)."""
    mu_g_between: float | None = None
    """Variance of mu_g between contacts; None for a contact that has no weight in the estimate of the floor."""
    c_g_between: float | None = None


class NamedValues:
    """Fitted values with their covariances, each by its name."""

    NAMES: ClassVar[tuple[str, ...]]
    value: Array
    covariance: Array

    def __getitem__(self, name: str) -> float:
        """Return a value by its name."""
        return float(self.value[self.NAMES.index(name)])

    def error(self, name: str) -> float:
        """Return the standard deviation of a value."""
        i = self.NAMES.index(name)
        return float(np.sqrt(max(self.covariance[i, i], 0.0)))

    def covariance_of(self, name: str, other: str) -> float:
        """Return the covariance of two values."""
        return float(self.covariance[self.NAMES.index(name), self.NAMES.index(other)])


@dataclass(frozen=True, eq=False)
class ContactFit(NamedValues):
    """A fitted contact: values, covariances and residuals.

    ``fit["vn_in"]`` is a value by its name in OUTPUTS: ``t`` (s); the place ``away`` from the wall's line and ``along`` it (m);
    velocities ``vn_in``, ``vt_in`` before the contact, ``vn_out``, ``vt_out`` after it, ``vn_roll``, ``vt_roll`` once the ball
    rolls again (m/s; n away from the wall, t along it); slips ``un_in`` ... ``ut_out`` on the floor (m/s); decelerations ``mu_g``
    while sliding and ``c_g`` while rolling (m/s^2; in flight the components of gravity); ``slides``, the time after the contact
    until the ball rolls, and ``hop``, how long of that it flies (s). NaN for what does not apply.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 200
    >>> y = np.where(t < 0.1, 2 * (0.1 - t), 1.6 * (t - 0.1)) - 9.81 / 2 * (t - 0.1) ** 2  # a bounce at t = 0.1 s
    >>> ball = Track("ball", t, np.stack([0.5 * t, y], axis=-1))
    >>> fit = measure([ball], Settings(view="side", noise=1e-4)).contacts[0].fit
    >>> round(fit["t"], 6), round(-fit["vn_in"], 3), round(fit["vn_out"], 3)
    (0.1, 2.0, 1.6)
    >>> fit.error("vn_out") < 0.01
    True
    """

    NAMES = OUTPUTS
    value: Array
    """(17,): the quantities of OUTPUTS."""
    covariance: Array
    """(17, 17), for the noise ``noise``."""
    noise: float
    """Standard deviation of one coordinate of one frame that was assumed, m."""
    chi2: float
    dof: float
    """Degrees of freedom: measured numbers, less the effective number of parameters that they determine without priors."""
    residuals: Array
    """(n, 2) m: measured less fitted; for a mean of m frames, times sqrt(m)."""
    time: Array
    """(n,) s: the frames of the fit."""
    slid_before: bool
    """Whether the track shows that the ball still slid at the first frame before the contact."""
    position: Callable[[Array], Array]
    """Times (m,) in s to fitted positions (m, 2) in the wall's frame, m."""
    slid_until_contact: bool = False
    """Whether it slid until the contact, so that no frame shows how much slip was left."""
    theta: Array = field(default_factory=lambda: np.zeros(0))
    """The parameters of the fit, from which another one can start."""
    hopping: ContactFit | None = None
    """The same contact, of a ball that hops off the wall; None if it cannot, or if this is such a fit."""
    hop_chi2: float = 0.0
    """By how much chi2 is higher if the ball hops for as long as off a wall that it touches at its centre."""
    rate: Array | None = None
    """(17, p): derivatives of the values by the parameters of ``fitted``."""
    fitted: FittedFrames | None = None
    """Data for the estimate of the noise's correlation."""
    shifts: Mapping[str, Array] = field(default_factory=dict)
    """By how much the values (17,) change with one standard deviation more of a quantity that all contacts of a film share: the
    air's ``drag``, the camera's ``roll``. Part of the covariance."""

    @property
    def restitution(self) -> tuple[float, float]:
        """The ratio of the speeds away from the wall and toward it, and its standard deviation."""
        before, after = -self["vn_in"], self["vn_out"]
        ratio, v, w = after / before, self.error("vn_in") / before, self.error("vn_out") / after
        # (v_n before the contact is negative)
        shared = 2 * self.covariance_of("vn_in", "vn_out") / (before * after)
        return ratio, abs(ratio) * float(np.sqrt(max(v**2 + w**2 + shared, 0.0)))

    def resolved(self, name: str) -> bool:
        """Return whether the frames determine a value.

        They do not determine the slip of a ball that slides until the contact, or until its last frames.
        """
        if name in ("un_in", "ut_in"):
            return not self.slid_until_contact
        if name in ("un_out", "ut_out", "vn_roll", "vt_roll", "slides"):
            left = float(self.time[-1]) - self["t"] - self["slides"]
            return left > 0 and left > unresolved_time(self["mu_g"], self.noise, self.time)
        return bool(np.isfinite(self[name]))

    def scaled(self, noise: float) -> ContactFit:
        """Return the same fit with its covariance scaled to another noise.

        The prior's share is scaled as well; the next round of fits corrects that. Errors that the film shares are no noise.
        """
        shared = sum((np.outer(shift, shift) for shift in self.shifts.values()), np.zeros_like(self.covariance))
        return replace(self, covariance=(self.covariance - shared) * (noise / self.noise) ** 2 + shared, noise=noise)


def unresolved_time(mu_g: float, noise: float, time: Array) -> float:
    """Return for how long (s) rolling can pass for sliding, or sliding for rolling, before frames at times (n,) show it.

    The path bends by mu g / 2 t^2, which has to reach a few times the noise at one of the frames.
    """
    return float(np.sqrt(5 * noise / mu_g) + np.median(np.diff(time)))


def central_differences(f: Model, theta: Array, step: Array, which: NDArray[np.bool_] | None = None) -> Array:
    """Return the derivatives (rows, parameters) of a function by central differences; by ``which`` parameters, default: all."""
    columns = []
    for j in range(len(step)) if which is None else np.flatnonzero(which):
        h = step[j]
        up, down = theta.copy(), theta.copy()
        up[j] += h
        down[j] -= h
        columns.append((f(up) - f(down)) / (2 * h))
    return np.stack(columns, axis=-1)


def solve(
    residual: Model, slope: Model, theta: Array, scale: Array, bounds: tuple[Array, Array] | None = None,
    tolerance: float = 1e-9,
) -> tuple[Array, float]:  # fmt: skip
    """Minimise a sum of squares: return the parameters and the minimum.

    MINPACK's Levenberg-Marquardt first, which is several times faster but knows no bounds; if it ends beyond one,
    SciPy's trust-region reflective method.
    """
    from scipy.optimize import least_squares, leastsq

    low, high = bounds if bounds is not None else (np.full(len(theta), -np.inf), np.full(len(theta), np.inf))
    start = np.clip(theta, low + 1e-12, high - 1e-12)
    beyond = np.full(len(residual(start)), 1e3)

    def within(part: Array) -> Array:
        return residual(part) if (part >= low).all() and (part <= high).all() else beyond

    best, _cov, info, _message, status = leastsq(
        within, start, Dfun=slope, diag=1 / scale, ftol=tolerance, xtol=tolerance, gtol=0.0, maxfev=60, full_output=True
    )
    if status in (1, 2, 3, 4) and (best > low).all() and (best < high).all():
        return np.asarray(best), float(info["fvec"] @ info["fvec"])
    found = least_squares(
        residual, start, jac=slope, x_scale=scale, bounds=(low, high), method="trf",
        xtol=tolerance, ftol=tolerance, gtol=tolerance, max_nfev=60,
    )  # fmt: skip
    return found.x, float(2 * found.cost)


def solve_free(
    residual: Model, slope: Callable[[Array, NDArray[np.bool_]], Array], start: Array, free: NDArray[np.bool_], scale: Array,
    bounds: tuple[Array, Array], tolerance: float,
) -> tuple[Array, float]:  # fmt: skip
    """Minimise over the free parameters from a start (p,): all parameters, and the minimum. ``slope`` has those columns alone."""

    def filled(part: Array) -> Array:
        theta = start.copy()
        theta[free] = part
        return theta

    found, cost = solve(
        lambda part: residual(filled(part)), lambda part: slope(filled(part), free), start[free], scale[free],
        (bounds[0][free], bounds[1][free]), tolerance,
    )  # fmt: skip
    return filled(found), cost


def propagated(
    best: Array, free: NDArray[np.bool_], residual: Model, slope: Array, outputs: Model, scale: Array, rows: int
) -> dict[str, Any]:
    """Propagate the errors of the fitted parameters (p,) to the outputs, by derivatives at the solution.

    ``free``: which were fitted; ``slope``: derivatives of the residuals (rows and prior knowledge, p); ``scale``: typical sizes of
    the parameters. Return value, covariance, chi2, dof, and the outputs' derivatives, rate.
    """
    slope = slope[:, free]
    inverse = np.linalg.pinv(slope.T @ slope, rcond=1e-14, hermitian=True)
    spent = float(np.einsum("ij,jk,ik->", slope[:rows], inverse, slope[:rows]))
    rate = central_differences(outputs, best, 1e-4 * scale)[:, free]
    r = residual(best)[:rows]
    return {
        "value": outputs(best),
        "covariance": rate @ inverse @ rate.T,
        "chi2": float(r @ r),
        "dof": rows - spent,
        "rate": rate,
    }


def starting_values(
    time: Array, position: Array, before: NDArray[np.bool_], after: NDArray[np.bool_], near_time: float
) -> Array:
    """Return starting values (7,) from straight lines through the frames next to the contact: time, place, velocities."""
    near, then = np.flatnonzero(before)[-8:], np.flatnonzero(after)[:6]
    theta = np.zeros(7)
    lines = [np.polyfit(time[rows] - near_time, position[rows], 1) for rows in (near, then)]
    (v0, x0), (v1, x1) = lines
    rate = v0[0] - v1[0]
    t = (x1[0] - x0[0]) / rate if abs(rate) > 1e-9 else 0.0
    t = float(np.clip(t, time[near[-1]] - near_time, time[then[0]] - near_time))
    theta[0] = near_time + t
    theta[1:3] = (x0 + v0 * t + x1 + v1 * t) / 2
    theta[START_IN], theta[START_OUT] = v0, v1
    return theta
