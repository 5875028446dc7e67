"""Deviance of a rebound whose spin before the wall was not measured: the likelihood, integrated over the spin's prior.

The spin is sigma v/a, v the ball's speed, with a prior density of sigma: normal about mean v_t/v with a width, or uniform within a
width of it. The row's deviance is, up to a constant that is the same for all laws,

    -2 log of the integral of exp(-c(sigma)/2) (S_nn / det S(sigma))^(1/2) rho(sigma) d sigma,

c and S as in :mod:`carom.fitting.deviance`. For measured inputs, the factor det S^(-1/2) of a density would bias the estimates, so
the normal part S_nn is divided out; along the wall the unknown spin absorbs the measurement, and there it is the omission of the
factor that would bias (by 30 in chi^2 for 100 rows, which suggested a spurious tangential restitution). J in S is taken along the
mean of the prior: the spin changes with v_t.

Scores and Louis's information (J. R. Stat. Soc. B 44, 226 (1982)) need only the moments of the intervals of
:mod:`carom.fitting.spin_quadrature`: derivatives of the prediction are taken as linear within an interval, which makes those of c
and of log rho parabolas in t. They are evaluated only where the weight of the row's spin is not negligible.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import kernel
from carom.fitting.deviance import (
    SPIN_MEAN,
    SPIN_WIDTH,
    UNDEFINED_DEVIANCE,
    measured_outputs,
    predict_with_derivatives,
    residual_precision,
)
from carom.fitting.parameters import NUMBERS
from carom.fitting.spin_quadrature import (
    LINEAR,
    NEGLIGIBLE,
    integrate_interval,
    interval_limits,
    midpoint_bulge,
    quartic_minimum,
    residual_line,
    spin_prior,
    subdivide,
)

__all__ = ["row_deviance_over_spins"]

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
