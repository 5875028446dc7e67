"""The deviance of a rebound whose spin before the wall nobody measured: averaged over what it may have been.

The spin is sigma v/a, v the ball's speed, with a prior density of sigma: normal about mean v_t/v with a width, or uniform
within a width of it. The row's deviance is

    -2 log of the integral of exp(-c(sigma)/2) (S_nn / det S(sigma))^(1/2) rho(sigma) d sigma,

c and S as in :mod:`carom.fitting.terms`, but for a constant that no law knows. Of what is known before the wall a density's root of
det S would pull numbers off, so the normal part S_nn has none; along the wall the unknown spin takes up what is measured, and there
it would be c without the root that pulls (by 30 in chi^2 for 100 rows, which made a tangential restitution of what is none). J in
S is taken along the mean of the prior: the spin goes with v_t.

Between places of sigma (:mod:`carom.fitting.stretches`) the integral is a sum of pieces of bells, a little bent
(:mod:`carom.fitting.bells`). For slopes what the law says is the straight line where a stretch has its mass: all slopes of c and of
log rho are parabolas then, so that scores and Louis's curvature (J. R. Stat. Soc. B 44, 226 (1982)) need the moments and nothing
else. The law's slopes in its own numbers are asked only where the row's spin may have been.
"""

from __future__ import annotations

import math
from typing import Any

from carom.fitting.bells import COLUMNS, HOPELESS, MIDDLE, lowest_bent, moments
from carom.fitting.stretches import bulge, cut, line, span
from carom.fitting.terms import COVARIANCE, NO_ANSWER, SPIN_MEAN, SPIN_WIDTH, ask, how_many, precision
from carom.kernel import kernel

__all__ = ["SMALL", "unmeasured_row"]

SHARE = 1e-4  # of a row's integral: stretches with less do not ask for slopes
SMALL = 13  # scratch arrays


@kernel
def _form(q: Any, r: Any, s: Any) -> float:
    """r' q s."""
    t = 0 * r[0]
    for m in range(3):
        t += r[m] * (q[m, 0] * s[0] + q[m, 1] * s[1] + q[m, 2] * s[2])
    return float(t)


@kernel
def _determinant(s: Any) -> float:
    """Of a symmetric matrix, 3 by 3."""
    return float(
        s[0, 0] * (s[1, 1] * s[2, 2] - s[1, 2] * s[1, 2])
        - s[0, 1] * (s[0, 1] * s[2, 2] - s[1, 2] * s[0, 2])
        + s[0, 2] * (s[0, 1] * s[1, 2] - s[1, 1] * s[0, 2])
    )


@kernel
def _slopes(row: Any, said: Any, one: int, two: int, turned: float, mid: Any) -> None:
    """The law's slopes in v_n and v_t, in a stretch, where the spin goes with v_t as the mean of its prior does."""
    for m in range(3):
        mid[0, m] = row[MIDDLE + 3 + m]
        mid[1, m] = row[MIDDLE + 6 + m] + turned * (said[two, m] - said[one, m])


@kernel
def _root_slope(i: int, vx: Any, mid: Any, inner: Any, at: int, s: Any, q: Any) -> float:
    """The slope of log (S_nn / det S)^(1/2) in a number, by which the law's slopes in v_n and v_t change as inner[at:] say."""
    t = -vx[i, COVARIANCE] * inner[at, 0] / s[0, 0]
    for o in range(2):
        t += vx[i, o] * mid[o, 0] * inner[at + o, 0] / s[0, 0]
        for m in range(3):
            t -= vx[i, o] * inner[at + o, m] * (q[m, 0] * mid[o, 0] + q[m, 1] * mid[o, 1] + q[m, 2] * mid[o, 2])
            t += vx[i, COVARIANCE + o] * inner[at + o, m] * q[m, o]
    return float(t)


@kernel
def _integrals(  # noqa: PLR0915  (from what a law says to what it is worth)
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any,
    fitted: Any, desk: Any, made: int, sure: float,
) -> tuple[float, float, float]:  # fmt: skip
    """The sum of all stretches' integrals over exp of the least exponent, that least, and the least of c + z^2. Their moments stand
    in the desk, weighed."""
    places, said, stretches, small, inner = desk
    count, d = spins.places.shape[0], how_many(y, i)
    s, q, mid, r = small[0], small[1], small[2], small[3]
    v_n, v_t = x[i, 0], x[i, 1]
    size = math.sqrt(v_n * v_n + v_t * v_t)
    unit = size / a
    width, mean = p[SPIN_WIDTH], p[SPIN_MEAN] * (v_t / size)
    bell = 0.0 if spins.uniform else 1 / width
    blurred = vx[i, 0] > 0 or vx[i, 1] > 0
    # so that deviances are of the size of chi^2: the variances that a mirror would leave along the wall
    side = 1 + 0 * a
    for m in range(1, 3):
        if y[i, m] == y[i, m]:
            side *= vy[i, m] + vx[i, m]

    least, best = math.inf, math.inf
    for e in range(made):
        row = stretches[e]
        one, two = int(row[0]), int(row[1])
        if not row[4] < sure + HOPELESS:
            row[4] = math.inf
            continue
        row[4] = math.inf
        far = places[two] - places[one]
        low, high = span(spins, places, one, two, mean, width)
        line(y, i, said, one, two, r)
        if not (low < high and abs(r[0, 0] + r[0, 1] + r[1, 0] + r[1, 1]) < math.inf):
            continue
        for m in range(MIDDLE + 3, COLUMNS):
            row[m] = 0
        if blurred:
            spin = (places[one] + places[two]) / 2 * unit
            for m in range(3):
                inner[0, m] = row[MIDDLE + m]
            known = 0 if row[3] == 2 else 1  # what it says there was asked before, but for those left as they are
            ask(law, code, form, stage, i, a, (v_n, v_t, spin), size, vx, p, fitted, 2, 1, known, 3, inner)
            for m in range(9):
                row[MIDDLE + m] = inner[m // 3, m % 3]
        _slopes(row, said, one, two, p[SPIN_MEAN] / ((places[two] - places[one]) * size), mid)
        precision(i, y, vx, vy, mid, 0, 2, s, q)
        share = side * s[0, 0] / _determinant(s) if blurred else 1 + 0 * a
        row[2] = math.sqrt(share) if 0 < share < math.inf else 1 + 0 * a
        c2, c1, c0 = _form(q, r[1], r[1]), _form(q, r[0], r[1]), _form(q, r[0], r[0])
        z0, z1 = (places[one] - mean) * bell, far * bell
        b2 = b1 = b0 = 0 * a
        if one > 0 and two != count - 1:
            bulge(y, i, said, row, r)
            b2, b1, b0 = _form(q, r[2], r[2]), _form(q, r[2], r[1]), _form(q, r[2], r[0])
        base = lowest_bent(c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0, b2, b1, b0, low, high)
        best = min(best, base)
        if nu == 0 and not base < best + HOPELESS:
            continue
        moments(c2, c1, c0, b2, b1, b0, z0, z1, low, high, nu, d, row)
        least = min(least, row[4])
    norm = 1 / (2 * width) if spins.uniform else 1 / (width * math.sqrt(2 * math.pi))
    total = 0 * a
    for e in range(made):
        row = stretches[e]
        if row[4] < math.inf:
            w = row[2] * norm * (places[int(row[1])] - places[int(row[0])]) * math.exp((least - row[4]) / 2)
            for n in range(5, 20):
                row[n] *= w
            total += row[5]
    return total, least, best


@kernel
def _scores(  # noqa: PLR0915  (of all numbers, from the same moments)
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, p: Any, fitted: Any,
    u: Any, h: Any, desk: Any, made: int, total: float,
) -> None:  # fmt: skip
    """Scores and information, from the stretches' moments."""
    places, said, stretches, small, inner = desk
    free, _steps, moved, further = fitted
    k, count = free.shape[0], spins.places.shape[0]
    s, q, mid, r = small[0], small[1], small[2], small[3]
    v_n, v_t = x[i, 0], x[i, 1]
    size = math.sqrt(v_n * v_n + v_t * v_t)
    along, unit = v_t / size, size / a
    width, mean = p[SPIN_WIDTH], p[SPIN_MEAN] * along
    bell = 0.0 if spins.uniform else 1 / width
    blurred = vx[i, 0] > 0 or vx[i, 1] > 0
    # Of each number its score is a parabola in t, in score[j]; what the law says moves by g[j, 0] + g[j, 1] t
    # (of the law, and of the prior, whose mean goes with v_t/v: by pull for each number)
    score, curve, outer, prior, pull = small[4], small[5], small[6], small[11], small[12, 0]
    curve[:] = 0
    outer[:] = 0
    for j in range(k):
        pull[j] = along if free[j] == SPIN_MEAN else 0.0
        z = free[j] - further.shape[1]
        if z >= 0 and not spins.uniform:
            pull[j] = p[SPIN_MEAN] * v_n * (v_n * moved[z, i, 1] - v_t * moved[z, i, 0]) / (size * size * size)
    for e in range(made):
        row = stretches[e]
        if not (row[4] < math.inf and row[5] > SHARE * total):
            continue
        one, two = int(row[0]), int(row[1])
        line(y, i, said, one, two, r)
        _slopes(row, said, one, two, p[SPIN_MEAN] / ((places[two] - places[one]) * size), mid)
        precision(i, y, vx, vy, mid, 0, 2, s, q)
        if one > 0 and two != count - 1:
            # curved: the straight line that has its mean and its slope where the stretch has its mass
            bulge(y, i, said, row, r)
            t = row[6] / row[5]
            slope_there, there = 4 - 8 * t, 4 * (t - row[7] / row[5])
            for m in range(3):
                r[0, m] -= (there - slope_there * t) * r[2, m]
                r[1, m] -= slope_there * r[2, m]
        z0, z1 = (places[one] - mean) * bell, (places[two] - places[one]) * bell
        qr, move = small[7], small[8]
        for n in range(2):
            for m in range(3):
                qr[n, m] = q[m, 0] * r[n, 0] + q[m, 1] * r[n, 1] + q[m, 2] * r[n, 2]
            for o in range(2):
                move[n, o] = vx[i, o] * (mid[o, 0] * qr[n, 0] + mid[o, 1] * qr[n, 1] + mid[o, 2] * qr[n, 2])
                move[n, o] -= vx[i, COVARIANCE + o] * qr[n, o]
        # the slopes in the law's numbers a quarter and three quarters of the way: at its ends they may jump
        start, slope = small[9], small[10]
        for end in range(2):
            t = 0.25 + 0.5 * end
            spin = ((1 - t) * places[one] + t * places[two]) * unit
            ask(law, code, form, stage, i, a, (v_n, v_t, spin), size, vx, p, fitted, 2, 1, 0, 1, inner)
            ask(law, code, form, stage, i, a, (v_n, v_t, spin), size, vx, p, fitted, 2, 1, 3, 3 + k, inner)
            for j in range(k):
                for m in range(3):
                    slope[j, m] = 2 * (inner[3 + j, m] - start[j, m]) if end == 1 else 0.0
                    start[j, m] = start[j, m] - slope[j, m] / 4 if end == 1 else inner[3 + j, m]
        if blurred:
            spin = (places[one] + places[two]) / 2 * unit
            for m in range(9):
                inner[m // 3, m % 3] = row[MIDDLE + m]
            ask(law, code, form, stage, i, a, (v_n, v_t, spin), size, vx, p, fitted, 2, 3, 3, 3 + 3 * k, inner)
            far = (places[two] - places[one]) * size
            for j in range(k):
                for m in range(3):
                    inner[5 + 3 * j, m] += p[SPIN_MEAN] * slope[j, m] / far
                    if free[j] == SPIN_MEAN:
                        inner[5 + 3 * j, m] = (said[two, m] - said[one, m]) / far
        for j in range(k):
            t = pull[j] / width
            prior[j, 0], prior[j, 1], prior[j, 2] = t * z0, t * z1, 0.0
            if free[j] == SPIN_WIDTH:
                prior[j, 0], prior[j, 1], prior[j, 2] = (z0 * z0 - 1) / width, 2 * z0 * z1 / width, z1 * z1 / width
            for o in range(2 if blurred else 0):
                for m in range(3):
                    start[j, m] += inner[4 + 3 * j + o, m] * move[0, o]
                    slope[j, m] += inner[4 + 3 * j + o, m] * move[1, o]
            if blurred:  # (no weight of Student's has a part in this)
                prior[j, 0] += _root_slope(i, vx, mid, inner, 4 + 3 * j, s, q)
            score[j, 0] = score[j, 1] = score[j, 2] = 0
            for m in range(3):
                score[j, 0] += start[j, m] * qr[0, m]
                score[j, 1] += start[j, m] * qr[1, m] + slope[j, m] * qr[0, m]
                score[j, 2] += slope[j, m] * qr[1, m]
        for j in range(k):
            for n in range(3):
                u[j] += prior[j, n] * row[5 + n] + score[j, n] * row[10 + n]
            for m in range(j + 1):
                for n in range(3):
                    for o in range(3):
                        outer[j, m] += (
                            prior[j, n] * prior[m, o] * row[5 + n + o] + score[j, n] * score[m, o] * row[15 + n + o]
                        )
                        outer[j, m] += (prior[j, n] * score[m, o] + score[j, n] * prior[m, o]) * row[10 + n + o]
                curve[j, m] += _form(q, start[j], start[m]) * row[10]
                curve[j, m] += (_form(q, start[j], slope[m]) + _form(q, slope[j], start[m])) * row[11]
                curve[j, m] += _form(q, slope[j], slope[m]) * row[12]
                t = 1 / (width * width)
                if free[j] == SPIN_WIDTH and free[m] == SPIN_WIDTH:
                    curve[j, m] += t * ((3 * z0 * z0 - 1) * row[5] + 6 * z0 * z1 * row[6] + 3 * z1 * z1 * row[7])
                elif free[j] == SPIN_WIDTH or free[m] == SPIN_WIDTH:
                    curve[j, m] += 2 * (pull[j] + pull[m]) * t * (z0 * row[5] + z1 * row[6])
                else:
                    curve[j, m] += pull[j] * pull[m] * t * row[5]
    for j in range(k):
        u[j] /= total
    for j in range(k):
        for m in range(j + 1):
            h[j, m] = h[m, j] = (curve[j, m] - outer[j, m]) / total + u[j] * u[m]


@kernel
def unmeasured_row(
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any,
    fitted: Any, u: Any, h: Any, desk: Any,
) -> tuple[float, float]:  # fmt: skip
    """A row's deviance, scores and information as :func:`carom.fitting.terms.known_row` gives them; and the least of c + z^2, z the
    distance from the prior's mean in its widths (of a uniform prior 0)."""
    u[:] = 0
    h[:] = 0
    if how_many(y, i) == 0:
        return 0 * a, 0 * a
    made, sure = cut(law, code, form, stage, i, a, spins, x, vx, y, vy, nu, p, fitted, desk)
    total, least, best = _integrals(law, code, form, stage, i, a, spins, x, vx, y, vy, nu, p, fitted, desk, made, sure)
    if not (total > 0 and least < NO_ANSWER):
        return NO_ANSWER, NO_ANSWER
    if fitted[0].shape[0] > 0:
        _scores(law, code, form, stage, i, a, spins, x, vx, y, vy, p, fitted, u, h, desk, made, total)
    return least - 2 * math.log(total), best
