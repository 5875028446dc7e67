"""The deviance of rebounds under a law, its slope and its curvature: what compiled loops ask of a row.

Of one row: inputs x and outputs y, measured with variances. The law f(x, p), straight near x, makes the deviance

    c = r' S^-1 r,   r = y - f(x, p),   S = var(y) + J var(x) J',   J = df/dx,

which is the least that x and y have to be moved, in their own error bars (Fuller, Measurement Error Models (1987), 1.3).
Its slope in p is -2 G' S^-1 r with G = df/dp taken where the best x lies, x + var(x) J' S^-1 r; a logarithm of det S has
no place in it, and would pull the numbers off. A spin that nobody measured is s = width (v/a) z with a density of z, and
the row's deviance is -2 log of the mean of exp(-c/2) over it: the law is asked at nodes of z and taken for straight between
them (there G is that at x). Its curvature is Louis's (J. R. Stat. Soc. B 44, 226 (1982)). With nu > 0 errors are Student's t
with nu degrees of freedom: (nu + d) log(1 + c/nu).
"""

from __future__ import annotations

import math
from typing import Any

from carom.fitting.kernels import rebound
from carom.kernel import Vec, kernel

__all__ = ["NO_ANSWER", "ROOM", "SPIN_WIDTH", "STEP", "row_terms"]

NO_ANSWER = 1e8  # the deviance of a row to which a law has no answer
STEP = 1e-4  # of a derivative, in the parameter's own size
ROOM = 20  # scratch arrays of a row
SPIN_WIDTH = 10
HOPELESS = 60.0  # a deviance so far above the least has no share: exp(-30)
WIDER = 4.0  # no law magnifies an error in speed by more than its root
CLOSE = 0.7  # error bars between two places of z that are weighed


@kernel
def _ask(
    code: int, form: int, stages: Any, i: int, a: float, x: Vec, size: float, z: float, unknown: bool,
    y: Any, vx: Any, vy: Any, p: Any, free: Any, steps: Any, least: float, slopes: bool, f: Any, jac: Any, grad: Any, bend: Any,
) -> bool:  # fmt: skip
    """The law at x in f[0], its slopes in x and in the free parameters; False where it is plainly out of the question.

    One place calls the law, so that it is compiled once: as it is, moved along each input, moved along each parameter.
    """
    k = free.shape[0]
    each = 3 if unknown else 1
    for turn in range(4 + (each * k if slopes else 0)):
        at0, at1, at2, h, j, m = x[0], x[1], x[2], 0 * a, -1, (turn - 4) // each
        # which input is moved; where a spin is unknown, with each parameter too: how jac changes
        moved = turn if turn < 4 else (turn - 4) % each
        if moved > 0:
            if not vx[i, moved - 1] > 0 or (moved == 3 and unknown):
                for n in range(3):
                    if turn < 4:
                        jac[n, moved - 1] = 0
                    else:
                        bend[moved - 1, m, n] = 0
                continue
            h = STEP * (size if moved < 3 else size / a)
            at0 += h if moved == 1 else 0
            at1 += h if moved == 2 else 0
            at2 += h if moved == 3 else 0
        was, step = 0 * a, 0 * a
        if turn > 3:
            j = free[m]
            was, step = p[j], steps[j]
            p[j] = was + step
            if unknown and j == SPIN_WIDTH:
                at2 += step * size / a * z
        g = rebound(code, form, stages, i, (at0, at1, at2), a, p)
        if turn > 3:
            p[j] = was
        for n in range(3):
            if turn == 0:
                f[0, n] = g[n]
            elif turn < 4:
                jac[n, turn - 1] = (g[n] - f[0, n]) / h
            elif moved == 0:
                grad[m, n] = (g[n] - f[0, n]) / step
            else:
                bend[moved - 1, m, n] = ((g[n] - f[0, n]) / step - grad[m, n]) / h - jac[n, moved - 1] / step
        if turn == 0:
            c = 0 * a
            wide = WIDER * (vx[i, 0] + vx[i, 1])
            for m in range(2):
                if y[i, m] == y[i, m]:
                    c += (y[i, m] - g[m]) * (y[i, m] - g[m]) / (vy[i, m] + wide)
            if not c < least + HOPELESS:
                return False
    return True


@kernel
def _weigh(
    i: int,
    k: int,
    y: Any,
    vx: Any,
    vy: Any,
    f: Any,
    jac: Any,
    grad: Any,
    s: Any,
    q: Any,
    move: Any,
    scores: Any,
    curve: Any,
) -> float:
    """c of what the law says, G' S^-1 r in ``scores``, G' S^-1 G in ``curve``, and how x has to move for it."""
    for m in range(3):
        for n in range(3):
            s[m, n] = vy[i, m] if m == n else 0.0
            for o in range(3):
                if vx[i, o] > 0:
                    s[m, n] += jac[m, o] * vx[i, o] * jac[n, o]
        move[m] = y[i, m] - f[0, m]
    for m in range(3):
        if y[i, m] != y[i, m]:  # not measured
            for n in range(3):
                s[m, n] = s[n, m] = 0
            s[m, m] = 1
            move[m] = 0
    r0, r1, r2 = move[0], move[1], move[2]
    d00, d01, d02, d11, d12, d22 = s[0, 0], s[0, 1], s[0, 2], s[1, 1], s[1, 2], s[2, 2]
    m0, m1, m2 = d11 * d22 - d12 * d12, d02 * d12 - d01 * d22, d01 * d12 - d02 * d11
    t = 1 / (d00 * m0 + d01 * m1 + d02 * m2)
    q[0, 0], q[0, 1], q[0, 2] = m0 * t, m1 * t, m2 * t
    q[1, 0], q[1, 1], q[1, 2] = m1 * t, (d00 * d22 - d02 * d02) * t, (d01 * d02 - d00 * d12) * t
    q[2, 0], q[2, 1], q[2, 2] = m2 * t, (d01 * d02 - d00 * d12) * t, (d00 * d11 - d01 * d01) * t
    q0 = q[0, 0] * r0 + q[0, 1] * r1 + q[0, 2] * r2
    q1 = q[1, 0] * r0 + q[1, 1] * r1 + q[1, 2] * r2
    q2 = q[2, 0] * r0 + q[2, 1] * r1 + q[2, 2] * r2
    for o in range(3):
        move[o] = vx[i, o] * (jac[0, o] * q0 + jac[1, o] * q1 + jac[2, o] * q2)
    for j in range(k):
        g0 = grad[j, 0] if y[i, 0] == y[i, 0] else 0.0
        g1 = grad[j, 1] if y[i, 1] == y[i, 1] else 0.0
        g2 = grad[j, 2] if y[i, 2] == y[i, 2] else 0.0
        scores[j] = g0 * q0 + g1 * q1 + g2 * q2
        w0 = q[0, 0] * g0 + q[0, 1] * g1 + q[0, 2] * g2
        w1 = q[1, 0] * g0 + q[1, 1] * g1 + q[1, 2] * g2
        w2 = q[2, 0] * g0 + q[2, 1] * g1 + q[2, 2] * g2
        for m in range(k):
            curve[j, m] = 0
            for n in range(3):
                if y[i, n] == y[i, n]:
                    curve[j, m] += grad[m, n] * (w0 if n == 0 else w1 if n == 1 else w2)
    return float(r0 * q0 + r1 * q1 + r2 * q2)


@kernel
def row_terms(  # noqa: PLR0915  (one row, known or not)
    code: int, form: int, stages: Any, i: int, a: float, nodes: Any,
    x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any, free: Any, steps: Any, u: Any, h: Any, room: Any,
) -> tuple[float, float]:  # fmt: skip
    """A row's deviance, its scores (-1/2 of its slope) in u and its curvature (information) in h; and the least c of it.

    ``nodes`` (M, 2): z, evenly, and its density, of mean 1 over the intervals' sum; ``nu`` 0: normal errors; ``room`` is scratch.
    """
    k = free.shape[0]
    scores, curve, more, s, q, move = room[0, 0], room[1], room[2], room[3], room[4], room[0, 1]
    f, jac, grad, bend = room[5], room[6], room[7], room[14:16]
    u[:] = 0
    h[:] = 0
    d = 0
    for m in range(3):
        if y[i, m] == y[i, m]:
            d += 1
    if d == 0:
        return 0 * a, 0 * a
    unknown = x[i, 2] != x[i, 2]
    size = math.sqrt(x[i, 0] * x[i, 0] + x[i, 1] * x[i, 1])
    scale = p[SPIN_WIDTH] * size / a
    x0, x1, x2 = x[i, 0], x[i, 1], x[i, 2] if not unknown else 0 * a
    least, total, best = math.inf, 0 * a, math.inf
    had = False
    more[:] = 0
    # Known: as measured, then where the best x lies. Unknown: node by node; between two, what the law says is straight.
    for node in range(nodes.shape[0] if unknown else 2):
        z = nodes[node, 0] if unknown else 0 * a
        bar = least if unknown and nu == 0 else math.inf
        has = _ask(
            code, form, stages, i, a, (x0, x1, scale * z if unknown else x2), size, z, unknown, y, vx, vy, p, free, steps, bar,
            unknown or node == 1, f, jac, grad, bend,
        )  # fmt: skip
        if not unknown:
            if node == 0:
                best = _weigh(i, 0, y, vx, vy, f, jac, grad, s, q, move, scores, curve)
                x0, x1, x2 = max(x0 + move[0], x0 / 2), x1 + move[1], x2 + move[2]
                for m in range(3):  # S and r are those at x; only G is taken there
                    room[8, 0, m] = f[0, m]
                    for n in range(3):
                        room[9, m, n] = jac[m, n]
                continue
            _weigh(i, k, y, vx, vy, room[8], room[9], grad, s, q, move, u, h)
            if not best < NO_ANSWER:
                u[:] = 0
                h[:] = 0
                return NO_ANSWER, NO_ANSWER
            if nu > 0:
                t = (nu + d) / (nu + best)
                for j in range(k):
                    u[j] *= t
                    for m in range(k):
                        h[j, m] *= t
                return (nu + d) * math.log(1 + best / nu), best
            return best, best
        if not (f[0, 0] == f[0, 0] and f[0, 1] == f[0, 1]):
            has = False
        # the node before: f in room[8], jac in room[9], grad in room[10]
        if node > 0 and (has or had) and room[8, 0, 0] == room[8, 0, 0] and f[0, 0] == f[0, 0]:
            for m in range(3):
                for n in range(3):
                    if not had:
                        room[9, m, n] = jac[m, n]
                    elif not has:
                        jac[m, n] = room[9, m, n]
                for j in range(k):
                    if not had:
                        room[10, j, m] = grad[j, m]
                        room[16, j, m], room[17, j, m] = bend[0, j, m], bend[1, j, m]
                    elif not has:
                        grad[j, m] = room[10, j, m]
                        bend[0, j, m], bend[1, j, m] = room[16, j, m], room[17, j, m]
            # where the law misses by r error bars, exp(-c/2) changes by exp(-r) within one: the places stand closer
            far = miss = 0 * a
            for m in range(3):
                if y[i, m] == y[i, m]:
                    bar = math.sqrt(vy[i, m])
                    far = max(far, abs(f[0, m] - room[8, 0, m]) / bar)
                    miss = max(miss, min(abs(y[i, m] - f[0, m]), abs(y[i, m] - room[8, 0, m])) / bar)
            parts = int(min(far / CLOSE * (1 + min(miss, 30.0)), 300.0)) + 1
            for part in range(parts):
                t = (part + 0.5) / parts
                for m in range(3):
                    room[11, 0, m] = (1 - t) * room[8, 0, m] + t * f[0, m]
                c = _between(i, k, t, y, vx, vy, room, jac, grad, bend, s, q, move, scores, curve)
                if not c < NO_ANSWER:
                    continue
                best = min(best, c)
                w = ((1 - t) * nodes[node - 1, 1] + t * nodes[node, 1]) / parts
                t = 1 + 0 * a
                if nu > 0:
                    t = (nu + d) / (nu + c)
                    c = (nu + d) * math.log(1 + c / nu)
                if c < least:
                    shrink = math.exp((c - least) / 2) if least < math.inf else 0 * a
                    total *= shrink
                    for j in range(k):
                        u[j] *= shrink
                        for m in range(k):
                            h[j, m] *= shrink
                            more[j, m] *= shrink
                    least = c
                w *= math.exp((least - c) / 2)
                total += w
                for j in range(k):
                    u[j] += w * t * scores[j]
                    for m in range(k):
                        h[j, m] += w * t * curve[j, m]
                        more[j, m] += w * t * t * scores[j] * scores[m]
        had = has
        for m in range(3):
            room[8, 0, m] = f[0, m]
            for n in range(3):
                room[9, m, n] = jac[m, n]
            for j in range(k):
                room[10, j, m] = grad[j, m]
                room[16, j, m], room[17, j, m] = bend[0, j, m], bend[1, j, m]
    if not total > 0:
        u[:] = 0
        h[:] = 0
        return NO_ANSWER, NO_ANSWER
    for j in range(k):
        u[j] /= total
    for j in range(k):
        for m in range(k):
            h[j, m] = (h[j, m] - more[j, m]) / total + u[j] * u[m]
    return least - 2 * math.log(total), best


@kernel
def _between(
    i: int, k: int, t: float, y: Any, vx: Any, vy: Any, room: Any, jac: Any, grad: Any, bend: Any,
    s: Any, q: Any, move: Any, scores: Any, curve: Any,
) -> float:  # fmt: skip
    """:func:`_weigh` a share t of the way from the node before to this one; the slopes mixed, in room[12] and room[13].

    G where the best x lies is G + (dJ/dp) times the way there.
    """
    for m in range(3):
        for n in range(3):
            room[12, m, n] = (1 - t) * room[9, m, n] + t * jac[m, n]
    c = _weigh(i, 0, y, vx, vy, room[11], room[12], room[13], s, q, move, scores, curve)
    for m in range(3):
        for j in range(k):
            there = (1 - t) * room[10, j, m] + t * grad[j, m]
            for o in range(2):
                there += move[o] * ((1 - t) * room[16 + o, j, m] + t * bend[o, j, m])
            room[13, j, m] = there
    _weigh(i, k, y, vx, vy, room[11], room[12], room[13], s, q, move, scores, curve)
    return c
