"""The deviance of a rebound under a law, its slope and its curvature: what compiled loops ask of a row.

Inputs x and outputs y, measured with variances. The law f(x, p), straight near x, makes the deviance

    c = r' S^-1 r,   r = y - f(x, p),   S = var(y) + J var(x) J' - J C - C' J',   J = df/dx,   C = cov(x, y),

which is the least that x and y have to be moved, in their own error bars (Fuller, Measurement Error Models (1987), 1.3).
Its slope in p is -2 G' S^-1 r with G = df/dp taken where the best x lies, x + (var(x) J' - C) S^-1 r; a logarithm of det S has
no place in it, and would pull the numbers off. With nu > 0 errors are Student's t with nu degrees of freedom:
(nu + d) log(1 + c/nu). A row whose spin nobody measured is in :mod:`carom.fitting.unmeasured`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.kernel import Vec, kernel

__all__ = [
    "COVARIANCE",
    "NO_ANSWER",
    "ROOM",
    "SPIN_MEAN",
    "SPIN_WIDTH",
    "STEP",
    "ask",
    "how_many",
    "known_row",
    "precision",
]

NO_ANSWER = 1e8  # the deviance of a row to which a law has no answer
STEP = 1e-4  # of a derivative, in the parameter's own size
SPIN_WIDTH, SPIN_MEAN = 10, 12  # among a law's numbers; the law does not know them
ROOM = 4  # scratch arrays of a row
COVARIANCE = 3  # in vx, behind the variances: of v_n before with v_n after, and of v_t


@kernel
def ask(
    law: Any, code: int, form: int, stage: int, i: int, a: float, x: Vec, size: float, vx: Any, p: Any, fitted: Any,
    inputs: int, each: int, first: int, last: int, said: Any,
) -> None:  # fmt: skip
    """The law at x, turn by turn, in said[turn]: 0 what it says; up to ``inputs`` its slope in each input; then of each free
    number its slope and, where ``each`` is above 1, how the slopes in the inputs change with it. ``law`` is a function of
    :mod:`carom.fitting.kernels`; ``fitted``: places of the free numbers, steps of their slopes, by how much errors that all rows
    share move these, and the law's numbers a step of each such error on.

    The slope in a shared error is that of what the law says less what was measured. (It moves a row by so little that the slopes
    in the inputs stay; a spin that is so many v/a goes on being that.)
    """
    free, steps, moved, further = fitted
    for turn in range(first, last):
        j, to = -1, turn
        if turn > inputs:
            j, to = free[(turn - inputs - 1) // each], (turn - inputs - 1) % each
        z = j - further.shape[1]
        if (to > 0 and (z >= 0 or not vx[i, to - 1] > 0)) or j in (SPIN_WIDTH, SPIN_MEAN):
            for n in range(3):
                said[turn, n] = 0
            continue
        h = STEP * (size if to < 3 else size / a)
        at0 = x[0] + h if to == 1 else x[0]
        at1 = x[1] + h if to == 2 else x[1]
        at2 = x[2] + h if to == 3 else x[2]
        step = steps[j] if j >= 0 else 0 * a
        if z >= 0:
            at0, at1, at2 = at0 + step * moved[z, i, 0], at1 + step * moved[z, i, 1], at2 + step * moved[z, i, 2]
            if inputs == 2:
                at2 *= math.sqrt(at0 * at0 + at1 * at1) / size
            g = law(code, form, stage, (at0, at1, at2), a, further[z])
            for n in range(3):
                said[turn, n] = (g[n] - said[0, n]) / step - moved[z, i, 3 + n]
            continue
        was = p[j] if j >= 0 else 0 * a
        if j >= 0:
            p[j] = was + step
        g = law(code, form, stage, (at0, at1, at2), a, p)
        if j >= 0:
            p[j] = was
        for n in range(3):
            if turn == 0:
                said[0, n] = g[n]
            elif j < 0:
                said[turn, n] = (g[n] - said[0, n]) / h
            elif to == 0:
                said[turn, n] = (g[n] - said[0, n]) / step
            else:  # d/dp of the slope in the input
                said[turn, n] = ((g[n] - said[0, n]) / step - said[turn - to, n]) / h - said[to, n] / step


@kernel
def precision(i: int, y: Any, vx: Any, vy: Any, jac: Any, first: int, inputs: int, s: Any, q: Any) -> None:
    """S^-1 in q, with zeros where nothing was measured; the slopes in input o stand in jac[first + o]."""
    for m in range(3):
        for n in range(3):
            s[m, n] = vy[i, m] if m == n else 0.0
            for o in range(inputs):
                if vx[i, o] > 0:
                    s[m, n] += jac[first + o, m] * vx[i, o] * jac[first + o, n]
        for o in range(2):  # each velocity with itself, before and after
            s[m, o] -= jac[first + o, m] * vx[i, COVARIANCE + o]
            s[o, m] -= jac[first + o, m] * vx[i, COVARIANCE + o]
    for m in range(3):
        if y[i, m] != y[i, m]:  # not measured
            for n in range(3):
                s[m, n] = s[n, m] = 0
            s[m, m] = 1
    d00, d01, d02, d11, d12, d22 = s[0, 0], s[0, 1], s[0, 2], s[1, 1], s[1, 2], s[2, 2]
    m0, m1, m2 = d11 * d22 - d12 * d12, d02 * d12 - d01 * d22, d01 * d12 - d02 * d11
    t = 1 / (d00 * m0 + d01 * m1 + d02 * m2)
    q[0, 0], q[0, 1], q[0, 2] = m0 * t, m1 * t, m2 * t
    q[1, 0], q[1, 1], q[1, 2] = m1 * t, (d00 * d22 - d02 * d02) * t, (d01 * d02 - d00 * d12) * t
    q[2, 0], q[2, 1], q[2, 2] = m2 * t, (d01 * d02 - d00 * d12) * t, (d00 * d11 - d01 * d01) * t
    for m in range(3):
        if y[i, m] != y[i, m]:
            q[m, m] = 0


@kernel
def how_many(y: Any, i: int) -> int:
    """How much was measured of a row after the wall."""
    d = 0
    for m in range(3):
        if y[i, m] == y[i, m]:
            d += 1
    return d


@kernel
def known_row(
    law: Any, code: int, form: int, stage: int, i: int, a: float, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any, fitted: Any,
    u: Any, h: Any, room: Any,
) -> tuple[float, float]:  # fmt: skip
    """A row's deviance, its scores (-1/2 of its slope) in u and its curvature (information) in h; and its c."""
    k = fitted[0].shape[0]
    s, q, said, work = room[0], room[1], room[2], room[3]
    u[:] = 0
    h[:] = 0
    d = how_many(y, i)
    if d == 0:
        return 0 * a, 0 * a
    x0, x1, x2 = x[i, 0], x[i, 1], x[i, 2]
    size = math.sqrt(x0 * x0 + x1 * x1)
    ask(law, code, form, stage, i, a, (x0, x1, x2), size, vx, p, fitted, 3, 1, 0, 4, said)
    precision(i, y, vx, vy, said, 1, 3, s, q)
    r, qr = work[0], work[1]
    for m in range(3):
        r[m] = y[i, m] - said[0, m] if y[i, m] == y[i, m] else 0.0
    c = 0 * a
    for m in range(3):
        qr[m] = q[m, 0] * r[0] + q[m, 1] * r[1] + q[m, 2] * r[2]
        c += r[m] * qr[m]
    if not c < NO_ANSWER:
        return NO_ANSWER, NO_ANSWER
    if k > 0:
        # where the best x lies
        off = vx[i, 0] * (said[1, 0] * qr[0] + said[1, 1] * qr[1] + said[1, 2] * qr[2]) - vx[i, COVARIANCE] * qr[0]
        x0 = max(x0 + off, x0 / 2)
        x1 += vx[i, 1] * (said[2, 0] * qr[0] + said[2, 1] * qr[1] + said[2, 2] * qr[2]) - vx[i, COVARIANCE + 1] * qr[1]
        x2 += vx[i, 2] * (said[3, 0] * qr[0] + said[3, 1] * qr[1] + said[3, 2] * qr[2])
        ask(law, code, form, stage, i, a, (x0, x1, x2), size, vx, p, fitted, 3, 1, 0, 1, said)
        ask(law, code, form, stage, i, a, (x0, x1, x2), size, vx, p, fitted, 3, 1, 4, 4 + k, said)
    t = (nu + d) / (nu + c) if nu > 0 else 1 + 0 * a
    for j in range(k):
        g = said[4 + j]
        u[j] = t * (g[0] * qr[0] + g[1] * qr[1] + g[2] * qr[2])
        for m in range(3):
            work[2, m] = q[m, 0] * g[0] + q[m, 1] * g[1] + q[m, 2] * g[2]
        for m in range(k):
            other = said[4 + m]
            h[j, m] = t * (other[0] * work[2, 0] + other[1] * work[2, 1] + other[2] * work[2, 2])
    if nu > 0:
        return (nu + d) * math.log(1 + c / nu), c
    return c, c
