"""Scores and information of a row whose spin nobody measured, from the moments of its stretches.

For slopes what the law says is the straight line where a stretch has its mass. All slopes of c and of log rho are parabolas then in
t, the share of the way through the stretch, so that scores and Louis's curvature (J. R. Stat. Soc. B 44, 226 (1982)) need the
moments (:mod:`carom.fitting.bells`) and nothing else. The law's slopes in its own numbers are asked only where the row's spin may
have been: what it says moves with number j by start[j] + slope[j] t, -c/2 and log rho by the parabolas score[j] and prior[j].
"""

from __future__ import annotations

import math
from typing import Any

from carom.fitting.bells import MIDDLE
from carom.fitting.stretches import bulge, line, prior_of
from carom.fitting.terms import COVARIANCE, SPIN_MEAN, SPIN_WIDTH, ask, precision
from carom.kernel import kernel

__all__ = ["SMALL", "add_scores", "precision_of", "product"]

SHARE = 1e-4  # of a row's integral: stretches with less do not ask for slopes
# Scratch arrays of a row: S, its inverse q, the law's slopes in v_n and v_t (mid), what y misses (r); score, curvatures, products
# of scores; q r, to the best v_n and v_t (move), start, slope, prior, and how the prior's mean moves (pull).
SMALL = 13


@kernel
def product(q: Any, r: Any, s: Any) -> float:
    """r' q s."""
    t = 0 * r[0]
    for m in range(3):
        t += r[m] * (q[m, 0] * s[0] + q[m, 1] * s[1] + q[m, 2] * s[2])
    return float(t)


@kernel
def precision_of(
    i: int, y: Any, vx: Any, vy: Any, p: Any, size: float, places: Any, said: Any, row: Any, mid: Any, s: Any, q: Any
) -> None:
    """S of a stretch, and its inverse; in mid the law's slopes in v_n and v_t: the spin goes with v_t as the mean of its prior."""
    one, two = int(row[0]), int(row[1])
    turned = p[SPIN_MEAN] / ((places[two] - places[one]) * size)
    for m in range(3):
        mid[0, m] = row[MIDDLE + 3 + m]
        mid[1, m] = row[MIDDLE + 6 + m] + turned * (said[two, m] - said[one, m])
    precision(i, y, vx, vy, mid, 0, 2, s, q)


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
def _straight(y: Any, i: int, said: Any, row: Any, count: int, r: Any) -> None:
    """What y misses, r[0] + r[1] t; of a curved stretch the line that has its mean and its slope where the stretch has its mass."""
    one, two = int(row[0]), int(row[1])
    line(y, i, said, one, two, r)
    if one > 0 and two != count - 1:
        bulge(y, i, said, row, r)
        t = row[6] / row[5]
        slope, there = 4 - 8 * t, 4 * (t - row[7] / row[5])
        for m in range(3):
            r[0, m] -= (there - slope * t) * r[2, m]
            r[1, m] -= slope * r[2, m]


@kernel
def _pulls(i: int, x: Any, p: Any, fitted: Any, uniform: bool, pull: Any) -> None:
    """How the mean of sigma's prior moves with each number: it goes with v_t/v."""
    free, _steps, moved, further = fitted
    size, along, _mean, _width = prior_of(i, x, p)
    v_n, v_t = x[i, 0], x[i, 1]
    for j in range(free.shape[0]):
        pull[j] = along if free[j] == SPIN_MEAN else 0.0
        z = free[j] - further.shape[1]
        if z >= 0 and not uniform:
            pull[j] = p[SPIN_MEAN] * v_n * (v_n * moved[z, i, 1] - v_t * moved[z, i, 0]) / (size * size * size)


@kernel
def _slopes(
    law: Any, code: int, form: int, stage: int, i: int, a: float, v: Any, size: float, vx: Any, p: Any, fitted: Any, desk: Any,
    row: Any, blurred: bool,
) -> None:  # fmt: skip
    """start and slope; where blurred, how the law's slopes in v_n and v_t change with number j, in inner[4 + 3 j] and the next."""
    places, said, _stretches, small, inner = desk
    start, slope = small[9], small[10]
    free, one, two = fitted[0], int(row[0]), int(row[1])
    k, unit = free.shape[0], size / a
    # a quarter and three quarters of the way: at its ends they may jump
    for end in range(2):
        t = 0.25 + 0.5 * end
        spin = ((1 - t) * places[one] + t * places[two]) * unit
        ask(law, code, form, stage, i, a, (v[0], v[1], spin), size, vx, p, fitted, 2, 1, 0, 1, inner)
        ask(law, code, form, stage, i, a, (v[0], v[1], spin), size, vx, p, fitted, 2, 1, 3, 3 + k, inner)
        for j in range(k):
            for m in range(3):
                slope[j, m] = 2 * (inner[3 + j, m] - start[j, m]) if end == 1 else 0.0
                start[j, m] = start[j, m] - slope[j, m] / 4 if end == 1 else inner[3 + j, m]
    if not blurred:
        return
    spin = (places[one] + places[two]) / 2 * unit
    for m in range(9):
        inner[m // 3, m % 3] = row[MIDDLE + m]
    ask(law, code, form, stage, i, a, (v[0], v[1], spin), size, vx, p, fitted, 2, 3, 3, 3 + 3 * k, inner)
    far = (places[two] - places[one]) * size
    for j in range(k):
        for m in range(3):
            inner[5 + 3 * j, m] += p[SPIN_MEAN] * slope[j, m] / far
            if free[j] == SPIN_MEAN:
                inner[5 + 3 * j, m] = (said[two, m] - said[one, m]) / far


@kernel
def _parabolas(i: int, vx: Any, width: float, free: Any, desk: Any, z0: float, z1: float, blurred: bool) -> None:
    """score and prior of each number: three coefficients in t."""
    small, inner = desk[3], desk[4]
    s, q, mid, r = small[0], small[1], small[2], small[3]
    score, qr, move, start, slope, prior, pull = (
        small[4],
        small[7],
        small[8],
        small[9],
        small[10],
        small[11],
        small[12, 0],
    )
    for n in range(2):
        for m in range(3):
            qr[n, m] = q[m, 0] * r[n, 0] + q[m, 1] * r[n, 1] + q[m, 2] * r[n, 2]
        for o in range(2):  # to where the best v_n and v_t lie
            move[n, o] = vx[i, o] * (mid[o, 0] * qr[n, 0] + mid[o, 1] * qr[n, 1] + mid[o, 2] * qr[n, 2])
            move[n, o] -= vx[i, COVARIANCE + o] * qr[n, o]
    for j in range(free.shape[0]):
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


@kernel
def _sums(free: Any, width: float, small: Any, z0: float, z1: float, row: Any, u: Any) -> None:
    """What a stretch adds to scores, in u, and in lower halves to their products, in small[6], and to curvatures, in small[5]."""
    q, score, curve, outer, start, slope, prior, pull = (
        small[1], small[4], small[5], small[6], small[9], small[10], small[11], small[12, 0],
    )  # fmt: skip
    for j in range(free.shape[0]):
        for n in range(3):
            u[j] += prior[j, n] * row[5 + n] + score[j, n] * row[10 + n]
        for m in range(j + 1):
            for n in range(3):
                for o in range(3):
                    outer[j, m] += (
                        prior[j, n] * prior[m, o] * row[5 + n + o] + score[j, n] * score[m, o] * row[15 + n + o]
                    )
                    outer[j, m] += (prior[j, n] * score[m, o] + score[j, n] * prior[m, o]) * row[10 + n + o]
            curve[j, m] += product(q, start[j], start[m]) * row[10]
            curve[j, m] += (product(q, start[j], slope[m]) + product(q, slope[j], start[m])) * row[11]
            curve[j, m] += product(q, slope[j], slope[m]) * row[12]
            t = 1 / (width * width)
            if free[j] == SPIN_WIDTH and free[m] == SPIN_WIDTH:
                curve[j, m] += t * ((3 * z0 * z0 - 1) * row[5] + 6 * z0 * z1 * row[6] + 3 * z1 * z1 * row[7])
            elif free[j] == SPIN_WIDTH or free[m] == SPIN_WIDTH:
                curve[j, m] += 2 * (pull[j] + pull[m]) * t * (z0 * row[5] + z1 * row[6])
            else:
                curve[j, m] += pull[j] * pull[m] * t * row[5]


@kernel
def add_scores(
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, p: Any, fitted: Any,
    u: Any, h: Any, desk: Any, made: int, total: float,
) -> None:  # fmt: skip
    """Scores in u and information in h; ``total``: the sum of the stretches' integrals."""
    places, said, stretches, small, _inner = desk
    free = fitted[0]
    k, count = free.shape[0], spins.places.shape[0]
    s, q, mid, r, curve, outer = small[0], small[1], small[2], small[3], small[5], small[6]
    size, _along, mean, width = prior_of(i, x, p)
    bell = 0.0 if spins.uniform else 1 / width
    blurred = vx[i, 0] > 0 or vx[i, 1] > 0
    curve[:] = 0
    outer[:] = 0
    _pulls(i, x, p, fitted, spins.uniform, small[12, 0])
    for e in range(made):
        row = stretches[e]
        if not (row[4] < math.inf and row[5] > SHARE * total):
            continue
        one, two = int(row[0]), int(row[1])
        z0, z1 = (places[one] - mean) * bell, (places[two] - places[one]) * bell
        _straight(y, i, said, row, count, r)
        precision_of(i, y, vx, vy, p, size, places, said, row, mid, s, q)
        _slopes(law, code, form, stage, i, a, (x[i, 0], x[i, 1]), size, vx, p, fitted, desk, row, blurred)
        _parabolas(i, vx, width, free, desk, z0, z1, blurred)
        _sums(free, width, small, z0, z1, row, u)
    for j in range(k):
        u[j] /= total
    for j in range(k):
        for m in range(j + 1):
            h[j, m] = h[m, j] = (curve[j, m] - outer[j, m]) / total + u[j] * u[m]
