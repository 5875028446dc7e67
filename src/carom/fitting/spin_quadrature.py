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
from carom.fitting.deviance import predict_with_derivatives

__all__ = [
    "INTERVAL", "NEGLIGIBLE", "REFINED_C", "SpinGrid", "integrate_interval", "interval_limits", "kink_position", "midpoint_bulge",
    "quartic_minimum", "residual_line", "sigma_grid", "spin_prior", "subdivide",
]  # fmt: skip

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
