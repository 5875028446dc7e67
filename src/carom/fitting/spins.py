"""Quadrature over an unmeasured spin: intervals of sigma on which the prediction is nearly linear, and their moments.

The spin before the wall is sigma v/a. The law is evaluated on a fixed grid of sigma (it does not depend on any fitted parameter),
once more between two grid points that matter, at the kink if there is one, and in the middle of each interval; intervals whose
middle deviates from the parabola through its neighbours are halved. Within an interval, t from 0 to 1, the residual is linear or
quadratic, so that the exponent (c and the log prior) is a parabola plus a quartic correction, and its moments are Gauss-Legendre
sums over the part that is not negligible.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import kernel
from carom.fitting.deviance import (
    SPIN_MEAN,
    SPIN_WIDTH,
    UNDEFINED_DEVIANCE,
    measured_outputs,
    predict_with_derivatives,
    residual_precision,
)
from carom.fitting.laws import NUMBERS

INTERVAL = np.dtype(
    [
        ("first", "i8"),  # grid points at its ends
        ("second", "i8"),
        ("state", "i8"),  # NEW, EXAMINED or LINEAR
        ("bound", "f8"),  # its least exponent is certainly not above this
        ("least", "f8"),  # its least exponent
        ("root", "f8"),  # (S_nn / det S)^(1/2), scaled
        ("expected", "f8", (3,)),  # the prediction in its middle by a parabola through its neighbours
        ("moments", "f8", (3, 5)),  # integrals of tau^m t^n exp(...), tau the weight that Student's t gives c
        ("middle", "f8", (3, 3)),  # in its middle: the prediction, its derivatives in v_n and v_t
    ]
)
NEW, EXAMINED, LINEAR = range(3)
NEGLIGIBLE = 27.0  # a deviance this far above the least has a weight of exp(-13.5)
JACOBIAN_BOUND = 4.0  # no law magnifies an error in speed by more than the square root of this
CURVATURE_TOLERANCE = 0.01  # error bars: largest deviation from the parabola,
REFINED_C = 10.0  # in a row with c up to this; far from the fit less precision is needed
LINEAR_TOLERANCE = 0.001  # error bars: an interval that is straight to this is not divided
MAX_HALVINGS = 10
KINK_REACH = 0.4  # of an interval, from its middle: where a kink may lie
NEWTON_STEPS = 3
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
FEW_NODES, FEW_WEIGHTS = np.polynomial.legendre.leggauss(8)
SHORT = 6.0  # change of the exponent across an interval for which these are enough
TAIL_EDGES = np.array(  # of Student's t, in its widths
    [-math.inf, -80.0, -20.0, -6.0, -2.0, 2.0, 6.0, 20.0, 80.0, math.inf]
)


class SpinGrid(NamedTuple):
    """Assumptions about the spins that were not measured."""

    sigma: NDArray[np.float64]
    """(M,) spins at which the law is evaluated, in v/a."""
    uniform: bool
    """Whether the prior is uniform; else normal."""


def sigma_grid(count: int = 41, furthest: float = 12.0, dense: float = 0.6) -> NDArray[np.float64]:
    """Return a grid that is dense about zero, where slips change sign, and coarse where friction is saturated."""
    far = math.asinh(furthest / dense)
    return dense * np.sinh(np.linspace(-far, far, count))


@kernel
def spin_prior(rows: Any, trial: Any, i: int) -> tuple[float, float, float, float]:
    """Return the ball's speed, v_t/v, and mean and width of the prior of sigma."""
    v_n, v_t = rows.x[i, 0], rows.x[i, 1]
    speed = math.sqrt(v_n * v_n + v_t * v_t)
    along = v_t / speed
    return speed, along, trial.numbers[0].spin_mean * along, trial.numbers[0].spin_width


@kernel
def parabola_minimum(c2: float, c1: float, c0: float, low: float, high: float) -> float:
    """Return the least value of c2 t^2 + 2 c1 t + c0 between low and high, c2 not negative."""
    t = -c1 / c2 if c2 > 0 else 0 * c2
    t = min(max(t, low), high)
    if not abs(t) < math.inf:
        return c0
    return (c2 * t + 2 * c1) * t + c0


@kernel
def _quartic(b2: float, b1: float, b0: float, t: float) -> float:
    """Return the contribution of a quadratic residual to the parabola: c of r0 + r1 t - 4 t (1 - t) g, with b2 = g' S^-1 g,
    b1 = g' S^-1 r1 and b0 = g' S^-1 r0."""
    w = 4 * t * (1 - t)
    return w * (w * b2 - 2 * (b1 * t + b0))


@kernel
def quartic_minimum(q2: float, q1: float, q0: float, b2: float, b1: float, b0: float, low: float, high: float) -> float:
    """Return the least value of q2 t^2 + 2 q1 t + q0 plus the quartic, by Gauss-Newton steps from the parabola's minimum."""
    if b2 == 0:
        return parabola_minimum(q2, q1, q0, low, high)
    t = min(max(-q1 / q2 if q2 > 0 else 0 * q2, low), high)
    least = (q2 * t + 2 * q1) * t + q0 + _quartic(b2, b1, b0, t)
    for _ in range(NEWTON_STEPS):
        w, slope = 4 * t * (1 - t), 4 - 8 * t
        steep = q2 - 2 * slope * b1 + slope * slope * b2
        if not steep > 0:
            break
        t -= (q2 * t + q1 - slope * (b1 * t + b0 - w * b2) - w * b1) / steep
        t = min(max(t, low), high)
        least = min(least, (q2 * t + 2 * q1) * t + q0 + _quartic(b2, b1, b0, t))
    return least


@kernel
def integrate_interval(
    c2: float, c1: float, c0: float, b2: float, b1: float, b0: float, z0: float, z1: float, low: float, high: float, nu: float,
    d: int, interval: Any,
) -> None:  # fmt: skip
    """Compute the least value of c(t) + (z0 + z1 t)^2 from low to high, and the moments relative to exp of it."""
    q2, q1, q0 = c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0
    base = quartic_minimum(q2, q1, q0, b2, b1, b0, low, high)
    moments = interval.moments
    for m in range(3):
        for n in range(5):
            moments[m, n] = 0
    if nu == 0:
        if q2 > 0:
            top, far = -q1 / q2, math.sqrt(base + NEGLIGIBLE) + math.sqrt(b2)
            far = math.sqrt(max(far * far - (q0 - q1 * q1 / q2), 0.0) / q2)
            low, high = max(low, top - far), min(high, top + far)
        # far from the fit the minimum found by Newton's steps may not be the least
        for n in range(NODES.shape[0] if b2 != 0 else 0):
            t = (low + high + (high - low) * NODES[n]) / 2
            base = min(base, (q2 * t + 2 * q1) * t + q0 + _quartic(b2, b1, b0, t))
        interval.least = base
        # (8 nodes are precise to 1e-6 where the exponent changes little)
        ends = max((q2 * low + 2 * q1) * low, (q2 * high + 2 * q1) * high) + q0
        few = b2 < 1 and ends - base < SHORT
        for n in range(FEW_NODES.shape[0] if few else NODES.shape[0]):
            t = (low + high + (high - low) * (FEW_NODES[n] if few else NODES[n])) / 2
            c = (q2 * t + 2 * q1) * t + q0 + _quartic(b2, b1, b0, t)
            w = (FEW_WEIGHTS[n] if few else WEIGHTS[n]) * math.exp((base - c) / 2) * (high - low) / 2
            for m in range(5):
                moments[0, m] += w
                w *= t
        for m in range(5):
            moments[1, m] = moments[2, m] = moments[0, m]
        return
    # heavy tails: pieces about the minimum of c, within the range of the prior
    if z1 != 0:
        top, far = -z0 / z1, math.sqrt(NEGLIGIBLE) / abs(z1)
        nearest = min(max(top, low), high)
        far = math.sqrt(far * far + (nearest - top) * (nearest - top))
        low, high = max(low, top - far), min(high, top + far)
    top = min(max(-c1 / c2, low), high) if c2 > 0 else low
    wide = 1 / math.sqrt(max(c2, 1e-12))
    c = max((c2 * top + 2 * c1) * top + c0 + _quartic(b2, b1, b0, top), 0.0)
    base = (nu + d) * math.log(1 + c / nu) + (z0 + z1 * top) * (z0 + z1 * top)
    near = min(max(-z0 / z1, low), high) if z1 != 0 else top
    c = max((c2 * near + 2 * c1) * near + c0 + _quartic(b2, b1, b0, near), 0.0)
    base = min(base, (nu + d) * math.log(1 + c / nu) + (z0 + z1 * near) * (z0 + z1 * near))
    interval.least = base
    for piece in range(TAIL_EDGES.shape[0] - 1):
        left, right = max(low, top + wide * TAIL_EDGES[piece]), min(high, top + wide * TAIL_EDGES[piece + 1])
        if not left < right:
            continue
        for n in range(NODES.shape[0]):
            t = (left + right + (right - left) * NODES[n]) / 2
            c, z = max((c2 * t + 2 * c1) * t + c0 + _quartic(b2, b1, b0, t), 0.0), z0 + z1 * t
            w = WEIGHTS[n] * math.exp((base - (nu + d) * math.log(1 + c / nu) - z * z) / 2) * (right - left) / 2
            tau = (nu + d) / (nu + c)
            for m in range(5):
                moments[0, m] += w
                moments[1, m] += w * tau
                moments[2, m] += w * tau * tau
                w *= t


@kernel
def kink_position(y: Any, vy: Any, i: int, sigma: Any, predicted: Any, n: int, count: int) -> float:
    """Return where between grid points n and n + 1, as a fraction, to evaluate again: where the lines from both sides meet, which
    is the middle of a smooth curve, and the kink of one that has one."""
    if n == 0 or n + 2 >= count:
        return 0.5
    here = sigma[n + 1] - sigma[n]
    before, after = here / (sigma[n] - sigma[n - 1]), here / (sigma[n + 2] - sigma[n + 1])
    top = bottom = 0 * sigma[0]
    for m in range(3):
        if y[i, m] == y[i, m]:
            left = (predicted[n, m] - predicted[n - 1, m]) * before
            right = (predicted[n + 2, m] - predicted[n + 1, m]) * after
            gap, turn = predicted[n, m] - predicted[n + 1, m] + right, left - right
            top -= gap * turn / vy[i, m]
            bottom += turn * turn / vy[i, m]
    if not bottom > 0:  # (nor so where the law has no prediction)
        return 0.5
    off = top / bottom - 0.5
    # lines that meet outside show no kink here; as they become parallel, the position tends to the middle from both sides
    return float(0.5 + (off if abs(off) <= KINK_REACH else KINK_REACH * KINK_REACH / off))


@kernel
def residual_line(y: Any, i: int, predicted: Any, one: int, two: int, r: Any) -> None:
    """Compute the residual at the first grid point, r[0], and its change to the second, r[1]."""
    for m in range(3):
        seen = y[i, m] == y[i, m]
        r[0, m] = y[i, m] - predicted[one, m] if seen else 0.0
        r[1, m] = predicted[one, m] - predicted[two, m] if seen else 0.0


@kernel
def midpoint_bulge(y: Any, i: int, predicted: Any, interval: Any, r: Any) -> None:
    """Compute the deviation of the prediction in the middle of an interval from the straight line, r[2]."""
    for m in range(3):
        off = interval.middle[0, m] - (predicted[interval.first, m] + predicted[interval.second, m]) / 2
        r[2, m] = off if y[i, m] == y[i, m] and abs(off) < math.inf else 0.0


@kernel
def interval_limits(spins: Any, sigma: Any, one: int, two: int, mean: float, width: float) -> tuple[float, float]:
    """Return the range of t: the first and the last interval are unbounded, and a uniform prior cuts at both ends."""
    low = -math.inf if one == 0 else 0.0
    high = math.inf if two == spins.sigma.shape[0] - 1 else 1.0
    if spins.uniform:
        far = sigma[two] - sigma[one]
        low, high = max(low, (mean - width - sigma[one]) / far), min(high, (mean + width - sigma[one]) / far)
    return low, high


@kernel
def _covariance_range(rows: Any, i: int) -> tuple[float, float]:
    """Return the largest factors by which correlated errors before and after increase and decrease S."""
    more, less = 1 + 0 * rows.vx[i, 0], 1 + 0 * rows.vx[i, 0]
    for o in range(2):
        if rows.covariance[i, o] != 0:
            square = rows.covariance[i, o] * rows.covariance[i, o] / (rows.vx[i, o] * rows.vy[i, o])
            more, less = max(more, 1 + math.sqrt(square)), min(less, 1 - square)
    return more, less


@kernel
def _bound_exponent(rows: Any, i: int, mean: float, width: float, work: Any, interval: Any) -> None:
    """Bound an interval's least exponent, as far as the law is straight: ``least`` from below, infinite where it has no part in the
    integral, and ``bound`` from above."""
    sigma, r, y, one, two = work.sigma, work.r, rows.y, interval.first, interval.second
    interval.bound = interval.least = math.inf
    low, high = interval_limits(rows.spins, sigma, one, two, mean, width)
    residual_line(y, i, work.predicted, one, two, r)
    if not (low < high and abs(r[0, 0] + r[0, 1] + r[1, 0] + r[1, 1]) < math.inf):
        return
    normal = 0.0 if rows.spins.uniform else 1 / width
    z0, z1 = (sigma[one] - mean) * normal, (sigma[two] - sigma[one]) * normal
    q2, q1, q0 = z1 * z1, z0 * z1, z0 * z0
    l2, l1, l0 = q2, q1, q0
    wide = JACOBIAN_BOUND * (rows.vx[i, 0] + rows.vx[i, 1])
    more, less = _covariance_range(rows, i)
    for m in range(3 if rows.nu == 0 else 0):  # heavy tails rule nothing out; only the prior does
        if y[i, m] != y[i, m]:
            continue
        t = 1 / (less * rows.vy[i, m])
        q2, q1, q0 = q2 + t * r[1, m] * r[1, m], q1 + t * r[0, m] * r[1, m], q0 + t * r[0, m] * r[0, m]
        if m < 2:
            t = 1 / (more * (rows.vy[i, m] + wide))
            l2, l1, l0 = l2 + t * r[1, m] * r[1, m], l1 + t * r[0, m] * r[1, m], l0 + t * r[0, m] * r[0, m]
    interval.least = parabola_minimum(l2, l1, l0, low, high)
    interval.bound = parabola_minimum(q2, q1, q0, low, high)


@kernel
def _split_interval(sigma: Any, predicted: Any, at: int, interval: Any, other: Any) -> None:
    """Split an interval at grid point ``at``: it becomes the first part, ``other`` the second; ``expected`` is what the parabola
    through all three points predicts in the middle of each."""
    one, two = interval.first, interval.second
    interval.second = other.first = at
    other.second = two
    interval.state = other.state = NEW
    other.least = interval.least
    here, there, far = sigma[at] - sigma[one], sigma[two] - sigma[at], sigma[two] - sigma[one]
    for m in range(3):
        turn = ((predicted[two, m] - predicted[at, m]) / there - (predicted[at, m] - predicted[one, m]) / here) / far
        interval.expected[m] = (predicted[one, m] + predicted[at, m] - turn * here * here / 2) / 2
        other.expected[m] = (predicted[at, m] + predicted[two, m] - turn * there * there / 2) / 2


@kernel
def _evaluate(law: Any, rows: Any, trial: Any, i: int, speed: float, sigma: float, asked: Any) -> None:
    """Evaluate the law at the spin sigma v/a, into asked[0]."""
    spin = sigma * (speed / rows.radius)
    predict_with_derivatives(law, rows, trial, i, (rows.x[i, 0], rows.x[i, 1], spin), speed, 2, 1, 0, 1, asked)


@kernel
def _squared_deviation(rows: Any, i: int, predicted: Any, one: int, two: int, t: float, there: Any) -> float:
    """Return the squared deviation, in error bars, of a prediction at fraction t between two grid points from the straight line."""
    off = 0.0
    for m in range(3):
        gap = there[m] - (1 - t) * predicted[one, m] - t * predicted[two, m]
        off += gap * gap / rows.vy[i, m] if rows.y[i, m] == rows.y[i, m] else 0.0
    return off


@kernel
def _has_part_near(sigma: Any, first: int, last: int, count: int, mean: float, reach: float) -> bool:
    """Return whether a part of the grid from one point to another lies within reach of a mean; its ends are infinitely far."""
    return (first <= 0 or sigma[first] < mean + reach) and (last >= count - 1 or sigma[last] > mean - reach)


@kernel
def _initial_intervals(law: Any, rows: Any, trial: Any, i: int, work: Any) -> tuple[int, int]:
    """Set up the intervals between grid points, divided at their kink where they matter. Return how many points and intervals."""
    sigma, predicted, intervals, asked = work.sigma, work.predicted, work.intervals, work.asked
    count = rows.spins.sigma.shape[0]
    speed, _along, mean, width = spin_prior(rows, trial, i)
    for n in range(count):
        sigma[n] = rows.spins.sigma[n]
        interval = intervals[n]
        interval.first, interval.second = n, n + 1
        interval.state = NEW
        interval.bound = interval.least = math.inf
    # Intervals matter whose lower bound is not far above the least upper bound: the law is evaluated where the prior alone does not
    # exclude them, first for a bound of 0, then for the least one, and at a point more on both sides
    certain, reach = 0 * width, -math.inf
    for _turn in range(2):
        near, reach = reach, width if rows.spins.uniform else width * math.sqrt(NEGLIGIBLE + certain)
        for n in range(count):
            if _has_part_near(sigma, n - 2, n + 2, count, mean, near) or not _has_part_near(
                sigma, n - 2, n + 2, count, mean, reach
            ):
                continue
            _evaluate(law, rows, trial, i, speed, sigma[n], asked)
            for m in range(3):
                predicted[n, m] = asked[0, m]
        certain = math.inf
        for n in range(count - 1):
            interval = intervals[n]
            if _has_part_near(sigma, n, n + 1, count, mean, reach) and interval.bound == math.inf:
                _bound_exponent(rows, i, mean, width, work, interval)
            certain = min(certain, interval.bound)
    used, made = count, count - 1
    for n in range(count - 1):
        interval = intervals[n]
        if not interval.least < certain + NEGLIGIBLE:
            interval.least = math.inf
            continue
        t = kink_position(rows.y, rows.vy, i, sigma, predicted, n, count)
        sigma[used] = sigma[n] + t * (sigma[n + 1] - sigma[n])
        _evaluate(law, rows, trial, i, speed, sigma[used], asked)
        for m in range(3):
            predicted[used, m] = asked[0, m]
            interval.middle[0, m] = (predicted[n, m] + predicted[n + 1, m]) / 2
        if _squared_deviation(rows, i, predicted, n, n + 1, t, asked[0]) < LINEAR_TOLERANCE * LINEAR_TOLERANCE:
            interval.state = LINEAR
            continue
        _split_interval(sigma, predicted, used, interval, intervals[made])
        used += 1
        made += 1
    return used, made


@kernel
def subdivide(law: Any, rows: Any, trial: Any, i: int, work: Any) -> tuple[int, float]:
    """Divide the range of sigma into intervals. Return their number, and an upper bound of the row's least exponent."""
    sigma, predicted, intervals, asked = work.sigma, work.predicted, work.intervals, work.asked
    speed, _along, mean, width = spin_prior(rows, trial, i)
    _more, less = _covariance_range(rows, i)
    used, made = _initial_intervals(law, rows, trial, i, work)
    certain = math.inf
    for turn in range(MAX_HALVINGS):
        certain = math.inf  # (the bound of a straight line may have been below the law)
        for e in range(made):
            interval = intervals[e]
            if interval.least < math.inf and interval.state == NEW:
                _bound_exponent(rows, i, mean, width, work, interval)
            if interval.least < math.inf:
                certain = min(certain, interval.bound)
        last = made
        fine = less * CURVATURE_TOLERANCE * CURVATURE_TOLERANCE * max(1.0, less * certain / REFINED_C) ** 2
        for e in range(last):
            interval = intervals[e]
            if not (interval.least < certain + NEGLIGIBLE and interval.state == NEW):
                continue
            interval.state = EXAMINED
            middle = (sigma[interval.first] + sigma[interval.second]) / 2
            _evaluate(law, rows, trial, i, speed, middle, asked)
            off = 0 * speed
            for m in range(3):
                interval.middle[0, m] = asked[0, m]
                if rows.y[i, m] == rows.y[i, m]:
                    off += (asked[0, m] - interval.expected[m]) * (asked[0, m] - interval.expected[m]) / rows.vy[i, m]
            # halve where a parabola does not describe the prediction
            room = turn + 1 < MAX_HALVINGS and used < sigma.shape[0] and made < intervals.shape[0]
            if room and off > fine * math.exp(max(interval.least - certain, 0.0)):
                sigma[used] = middle
                for m in range(3):
                    predicted[used, m] = asked[0, m]
                _split_interval(sigma, predicted, used, interval, intervals[made])
                used += 1
                made += 1
    return made, certain


# ----------------------------------------------------------------------------------------------------
# Deviance of a rebound whose spin before the wall was not measured: the likelihood, integrated over the spin's prior.
#
# The spin is sigma v/a, v the ball's speed, with a prior density of sigma: normal about mean v_t/v with a width, or uniform
# within a width of it. The row's deviance is, up to a constant that is the same for all laws,
#
# -2 log of the integral of exp(-c(sigma)/2) (S_nn / det S(sigma))^(1/2) rho(sigma) d sigma,
#
# c and S as in :mod:`carom.fitting.deviance`. For measured inputs, the factor det S^(-1/2) of a density would bias the estimates,
# so the normal part S_nn is divided out; along the wall the unknown spin absorbs the measurement, and there it is the omission of
# the factor that would bias (by 30 in chi^2 for 100 rows, which suggested a spurious tangential restitution). J in S is taken
# along the mean of the prior: the spin changes with v_t.
#
# Scores and Louis's information (J. R. Stat. Soc. B 44, 226 (1982)) need only the moments of the intervals of
# :mod:`carom.fitting.spins`: derivatives of the prediction are taken as linear within an interval, which makes those of c and of
# log rho parabolas in t. They are evaluated only where the weight of the row's spin is not negligible.


LEAST_WEIGHT = 1e-4  # of a row's integral: intervals with less need no derivatives


@kernel
def _product(q: Any, r: Any, s: Any) -> float:
    """Return r' q s."""
    t = 0 * r[0]
    for m in range(3):
        t += r[m] * (q[m, 0] * s[0] + q[m, 1] * s[1] + q[m, 2] * s[2])
    return float(t)


@kernel
def _determinant(s: Any) -> float:
    """Return the determinant of a symmetric matrix, 3 by 3."""
    return float(
        s[0, 0] * (s[1, 1] * s[2, 2] - s[1, 2] * s[1, 2])
        - s[0, 1] * (s[0, 1] * s[2, 2] - s[1, 2] * s[0, 2])
        + s[0, 2] * (s[0, 1] * s[1, 2] - s[1, 1] * s[0, 2])
    )


@kernel
def _mirror_variance(rows: Any, i: int) -> float:
    """Return the product of variances along the wall under a mirror law, by which det S is divided to keep deviances like chi^2."""
    side = 1.0
    for m in range(1, 3):
        if rows.y[i, m] == rows.y[i, m]:
            side *= rows.vy[i, m] + rows.vx[i, m]
    return side


@kernel
def _precision(rows: Any, trial: Any, i: int, speed: float, work: Any, interval: Any) -> None:
    """Compute S of an interval, its inverse, and the derivatives in v_n and v_t, with the spin changing like the prior's mean."""
    one, two = interval.first, interval.second
    turned = trial.numbers[0].spin_mean / ((work.sigma[two] - work.sigma[one]) * speed)
    for m in range(3):
        work.slopes[0, m] = interval.middle[1, m]
        work.slopes[1, m] = interval.middle[2, m] + turned * (work.predicted[two, m] - work.predicted[one, m])
    residual_precision(rows, i, work.slopes, 0, 2, work.s, work.q)


@kernel
def _middle_slopes(law: Any, rows: Any, trial: Any, i: int, speed: float, work: Any, interval: Any) -> None:
    """Compute the derivatives in v_n and v_t in the middle of an interval."""
    asked = work.asked
    for m in range(3):
        asked[0, m] = interval.middle[0, m]
    known = (
        0 if interval.state == LINEAR else 1
    )  # the prediction there is known, except of intervals that were not examined
    spin = (work.sigma[interval.first] + work.sigma[interval.second]) / 2 * (speed / rows.radius)
    predict_with_derivatives(law, rows, trial, i, (rows.x[i, 0], rows.x[i, 1], spin), speed, 2, 1, known, 3, asked)
    for o in range(3):
        for m in range(3):
            interval.middle[o, m] = asked[o, m]


@kernel
def _integrate(
    law: Any, rows: Any, trial: Any, i: int, work: Any, made: int, certain: float
) -> tuple[float, float, float]:
    """Integrate over all intervals. Return the sum relative to exp of the least exponent, that exponent, and the least c + z^2."""
    sigma, intervals, q, r, nu = work.sigma, work.intervals, work.q, work.r, rows.nu
    count, d, side = rows.spins.sigma.shape[0], measured_outputs(rows.y, i), _mirror_variance(rows, i)
    speed, _along, mean, width = spin_prior(rows, trial, i)
    normal = 0.0 if rows.spins.uniform else 1 / width
    blurred = rows.vx[i, 0] > 0 or rows.vx[i, 1] > 0

    least, best = math.inf, math.inf
    for e in range(made):
        interval = intervals[e]
        one, two = interval.first, interval.second
        hopeless = not interval.least < certain + NEGLIGIBLE
        interval.least = math.inf
        if hopeless:
            continue
        low, high = interval_limits(rows.spins, sigma, one, two, mean, width)
        residual_line(rows.y, i, work.predicted, one, two, r)
        if not (low < high and abs(r[0, 0] + r[0, 1] + r[1, 0] + r[1, 1]) < math.inf):
            continue
        for m in range(3):
            interval.middle[1, m] = interval.middle[2, m] = 0
        if blurred:
            _middle_slopes(law, rows, trial, i, speed, work, interval)
        _precision(rows, trial, i, speed, work, interval)
        share = side * work.s[0, 0] / _determinant(work.s) if blurred else 1 + 0 * width
        interval.root = math.sqrt(share) if 0 < share < math.inf else 1 + 0 * width
        c2, c1, c0 = _product(q, r[1], r[1]), _product(q, r[0], r[1]), _product(q, r[0], r[0])
        z0, z1 = (sigma[one] - mean) * normal, (sigma[two] - sigma[one]) * normal
        b2 = b1 = b0 = 0 * width
        if one > 0 and two != count - 1:
            midpoint_bulge(rows.y, i, work.predicted, interval, r)
            b2, b1, b0 = _product(q, r[2], r[2]), _product(q, r[2], r[1]), _product(q, r[2], r[0])
        base = quartic_minimum(c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0, b2, b1, b0, low, high)
        best = min(best, base)
        if nu == 0 and not base < best + NEGLIGIBLE:
            continue
        integrate_interval(c2, c1, c0, b2, b1, b0, z0, z1, low, high, nu, d, interval)
        least = min(least, interval.least)
    norm = 1 / (2 * width) if rows.spins.uniform else 1 / (width * math.sqrt(2 * math.pi))
    total = 0.0
    for e in range(made):  # moments relative to the least exponent of all
        interval = intervals[e]
        if interval.least < math.inf:
            far = sigma[interval.second] - sigma[interval.first]
            w = interval.root * norm * far * math.exp((least - interval.least) / 2)
            for m in range(3):
                for n in range(5):
                    interval.moments[m, n] *= w
            total += interval.moments[0, 0]
    return total, least, best


@kernel
def row_deviance_over_spins(law: Any, rows: Any, trial: Any, i: int, u: Any, h: Any, work: Any) -> tuple[float, float]:
    """Return a row's deviance, and the least of c + z^2, z the distance from the prior's mean in its widths (0: uniform prior);
    write scores and information as :func:`carom.fitting.deviance.row_deviance` does."""
    u[:] = 0
    h[:] = 0
    if measured_outputs(rows.y, i) == 0:
        return 0 * rows.radius, 0 * rows.radius
    made, certain = subdivide(law, rows, trial, i, work)
    total, least, best = _integrate(law, rows, trial, i, work, made, certain)
    if not (total > 0 and least < UNDEFINED_DEVIANCE):
        return UNDEFINED_DEVIANCE, UNDEFINED_DEVIANCE
    if trial.free.shape[0] > 0:
        _add_scores(law, rows, trial, i, u, h, work, made, total)
    return least - 2 * math.log(total), best


@kernel
def _root_slope(rows: Any, i: int, work: Any, at: int) -> float:
    """Return the derivative of log (S_nn / det S)^(1/2) in a parameter, with mixed derivatives in asked[at:]."""
    s, q, slopes, asked, vx = work.s, work.q, work.slopes, work.asked, rows.vx
    t = -rows.covariance[i, 0] * asked[at, 0] / s[0, 0]
    for o in range(2):
        t += vx[i, o] * slopes[o, 0] * asked[at + o, 0] / s[0, 0]
        for m in range(3):
            t -= (
                vx[i, o] * asked[at + o, m] * (q[m, 0] * slopes[o, 0] + q[m, 1] * slopes[o, 1] + q[m, 2] * slopes[o, 2])
            )
            t += rows.covariance[i, o] * asked[at + o, m] * q[m, o]
    return float(t)


@kernel
def _straightened(rows: Any, i: int, work: Any, interval: Any, count: int) -> None:
    """Compute the residual r[0] + r[1] t; of a curved interval the line with its mean and slope where its weight lies."""
    r = work.r
    residual_line(rows.y, i, work.predicted, interval.first, interval.second, r)
    if interval.first > 0 and interval.second != count - 1:
        midpoint_bulge(rows.y, i, work.predicted, interval, r)
        t = interval.moments[0, 1] / interval.moments[0, 0]
        slope, there = 4 - 8 * t, 4 * (t - interval.moments[0, 2] / interval.moments[0, 0])
        for m in range(3):
            r[0, m] -= (there - slope * t) * r[2, m]
            r[1, m] -= slope * r[2, m]


@kernel
def _mean_shifts(rows: Any, trial: Any, i: int, shift: Any) -> None:
    """Compute the derivative of the prior's mean in each parameter: it is proportional to v_t/v."""
    speed, along, _mean, _width = spin_prior(rows, trial, i)
    v_n, v_t = rows.x[i, 0], rows.x[i, 1]
    for j in range(trial.free.shape[0]):
        shift[j] = along if trial.free[j] == SPIN_MEAN else 0.0
        z = trial.free[j] - NUMBERS
        if z >= 0 and not rows.spins.uniform:
            turn = v_n * trial.moved[z, i, 1] - v_t * trial.moved[z, i, 0]
            shift[j] = trial.numbers[0].spin_mean * v_n * turn / (speed * speed * speed)


@kernel
def _derivatives(
    law: Any, rows: Any, trial: Any, i: int, speed: float, work: Any, interval: Any, blurred: bool
) -> None:
    """Compute ``start`` and ``slope``; where blurred, mixed derivatives with v_n and v_t in asked[4 + 3 j] and the next."""
    sigma, predicted, asked, start, slope = work.sigma, work.predicted, work.asked, work.start, work.slope
    free, one, two = trial.free, interval.first, interval.second
    k, unit = free.shape[0], speed / rows.radius
    v_n, v_t = rows.x[i, 0], rows.x[i, 1]
    # at a quarter and three quarters: at its ends they may jump
    for end in range(2):
        t = 0.25 + 0.5 * end
        spin = ((1 - t) * sigma[one] + t * sigma[two]) * unit
        predict_with_derivatives(law, rows, trial, i, (v_n, v_t, spin), speed, 2, 1, 0, 1, asked)
        predict_with_derivatives(law, rows, trial, i, (v_n, v_t, spin), speed, 2, 1, 3, 3 + k, asked)
        for j in range(k):
            for m in range(3):
                slope[j, m] = 2 * (asked[3 + j, m] - start[j, m]) if end == 1 else 0.0
                start[j, m] = start[j, m] - slope[j, m] / 4 if end == 1 else asked[3 + j, m]
    if not blurred:
        return
    spin = (sigma[one] + sigma[two]) / 2 * unit
    for o in range(3):
        for m in range(3):
            asked[o, m] = interval.middle[o, m]
    predict_with_derivatives(law, rows, trial, i, (v_n, v_t, spin), speed, 2, 3, 3, 3 + 3 * k, asked)
    far = (sigma[two] - sigma[one]) * speed
    for j in range(k):
        for m in range(3):
            asked[5 + 3 * j, m] += trial.numbers[0].spin_mean * slope[j, m] / far
            if free[j] == SPIN_MEAN:
                asked[5 + 3 * j, m] = (predicted[two, m] - predicted[one, m]) / far


@kernel
def _score_polynomials(
    rows: Any, trial: Any, i: int, width: float, work: Any, z0: float, z1: float, blurred: bool
) -> None:
    """Compute the coefficients in t of the scores of c and of the log prior, for each parameter."""
    q, r, qr, slopes, asked, vx = work.q, work.r, work.qr, work.slopes, work.asked, rows.vx
    start, slope, prior, score = work.start, work.slope, work.prior, work.score
    for n in range(2):
        for m in range(3):
            qr[n, m] = q[m, 0] * r[n, 0] + q[m, 1] * r[n, 1] + q[m, 2] * r[n, 2]
    for j in range(trial.free.shape[0]):
        t = work.mean_shift[j] / width
        prior[j, 0], prior[j, 1], prior[j, 2] = t * z0, t * z1, 0.0
        if trial.free[j] == SPIN_WIDTH:
            prior[j, 0], prior[j, 1], prior[j, 2] = (z0 * z0 - 1) / width, 2 * z0 * z1 / width, z1 * z1 / width
        for o in range(2 if blurred else 0):
            # change of the most likely v_n and v_t
            move0 = vx[i, o] * (slopes[o, 0] * qr[0, 0] + slopes[o, 1] * qr[0, 1] + slopes[o, 2] * qr[0, 2])
            move0 -= rows.covariance[i, o] * qr[0, o]
            move1 = vx[i, o] * (slopes[o, 0] * qr[1, 0] + slopes[o, 1] * qr[1, 1] + slopes[o, 2] * qr[1, 2])
            move1 -= rows.covariance[i, o] * qr[1, o]
            for m in range(3):
                start[j, m] += asked[4 + 3 * j + o, m] * move0
                slope[j, m] += asked[4 + 3 * j + o, m] * move1
        if blurred:  # (Student's weight does not enter here)
            prior[j, 0] += _root_slope(rows, i, work, 4 + 3 * j)
        score[j, 0] = score[j, 1] = score[j, 2] = 0
        for m in range(3):
            score[j, 0] += start[j, m] * qr[0, m]
            score[j, 1] += start[j, m] * qr[1, m] + slope[j, m] * qr[0, m]
            score[j, 2] += slope[j, m] * qr[1, m]


@kernel
def _accumulate(free: Any, width: float, work: Any, z0: float, z1: float, moments: Any, u: Any) -> None:
    """Add an interval's part to the scores u and, in lower triangles, to their products and to the curvature."""
    q, score, prior, start, slope = work.q, work.score, work.prior, work.start, work.slope
    curvature, outer, shift = work.curvature, work.outer, work.mean_shift
    # of one parameter, with the moments: its part in the products with prior and score, and with start and slope
    by_prior, by_score, by_start, by_slope = work.r[0], work.r[1], work.qr[0], work.qr[1]
    t = 1 / (width * width)
    for m in range(free.shape[0]):
        for n in range(3):
            by_prior[n] = by_score[n] = 0
            for o in range(3):
                by_prior[n] += prior[m, o] * moments[0, n + o] + score[m, o] * moments[1, n + o]
                by_score[n] += prior[m, o] * moments[1, n + o] + score[m, o] * moments[2, n + o]
            one = q[n, 0] * start[m, 0] + q[n, 1] * start[m, 1] + q[n, 2] * start[m, 2]
            two = q[n, 0] * slope[m, 0] + q[n, 1] * slope[m, 1] + q[n, 2] * slope[m, 2]
            by_start[n] = one * moments[1, 0] + two * moments[1, 1]
            by_slope[n] = one * moments[1, 1] + two * moments[1, 2]
        u[m] += by_prior[0]
        for j in range(m, free.shape[0]):
            for n in range(3):
                outer[j, m] += prior[j, n] * by_prior[n] + score[j, n] * by_score[n]
                curvature[j, m] += start[j, n] * by_start[n] + slope[j, n] * by_slope[n]
            if free[j] == SPIN_WIDTH and free[m] == SPIN_WIDTH:
                spread = (3 * z0 * z0 - 1) * moments[0, 0] + 6 * z0 * z1 * moments[0, 1] + 3 * z1 * z1 * moments[0, 2]
                curvature[j, m] += t * spread
            elif free[j] == SPIN_WIDTH or free[m] == SPIN_WIDTH:
                curvature[j, m] += 2 * (shift[j] + shift[m]) * t * (z0 * moments[0, 0] + z1 * moments[0, 1])
            else:
                curvature[j, m] += shift[j] * shift[m] * t * moments[0, 0]


@kernel
def _add_scores(law: Any, rows: Any, trial: Any, i: int, u: Any, h: Any, work: Any, made: int, total: float) -> None:
    """Compute scores and information; ``total``: the sum of the intervals' integrals."""
    free, sigma, intervals, curvature, outer = trial.free, work.sigma, work.intervals, work.curvature, work.outer
    k, count = free.shape[0], rows.spins.sigma.shape[0]
    speed, _along, mean, width = spin_prior(rows, trial, i)
    normal = 0.0 if rows.spins.uniform else 1 / width
    blurred = rows.vx[i, 0] > 0 or rows.vx[i, 1] > 0
    curvature[:] = 0
    outer[:] = 0
    _mean_shifts(rows, trial, i, work.mean_shift)
    for e in range(made):
        interval = intervals[e]
        if not (interval.least < math.inf and interval.moments[0, 0] > LEAST_WEIGHT * total):
            continue
        one, two = interval.first, interval.second
        z0, z1 = (sigma[one] - mean) * normal, (sigma[two] - sigma[one]) * normal
        _straightened(rows, i, work, interval, count)
        _precision(rows, trial, i, speed, work, interval)
        _derivatives(law, rows, trial, i, speed, work, interval, blurred)
        _score_polynomials(rows, trial, i, width, work, z0, z1, blurred)
        _accumulate(free, width, work, z0, z1, interval.moments, u)
    for j in range(k):
        u[j] /= total
    for j in range(k):
        for m in range(j + 1):
            h[j, m] = h[m, j] = (curvature[j, m] - outer[j, m]) / total + u[j] * u[m]
