"""The deviance of a rebound whose spin before the wall nobody measured: averaged over what it may have been.

The spin is sigma v/a, v the ball's speed, with a prior density of sigma: normal about mean v_t/v with a width, or uniform
within a width of it. The row's deviance is

    -2 log of the integral of exp(-c(sigma)/2) (S_nn / det S(sigma))^(1/2) rho(sigma) d sigma,

c and S as in :mod:`carom.fitting.terms`, but for a constant that no law knows. Of what is known before the wall a density's root of
det S would pull numbers off, so the normal part S_nn has none; along the wall the unknown spin takes up what is measured, and there
it would be c without the root that pulls (by 30 in chi^2 for 100 rows, which made a tangential restitution of what is none). J in
S is taken along the mean of the prior: the spin goes with v_t.

Between places of sigma (:mod:`carom.fitting.stretches`) the integral is a sum of pieces of bells, a little bent
(:mod:`carom.fitting.bells`); slopes are in :mod:`carom.fitting.scores`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.fitting.bells import COLUMNS, HOPELESS, MIDDLE, lowest_bent, moments
from carom.fitting.scores import add_scores, precision_of, product
from carom.fitting.stretches import bulge, cut, line, prior_of, span
from carom.fitting.terms import NO_ANSWER, ask, how_many
from carom.kernel import kernel

__all__ = ["unmeasured_row"]


@kernel
def _determinant(s: Any) -> float:
    """Of a symmetric matrix, 3 by 3."""
    return float(
        s[0, 0] * (s[1, 1] * s[2, 2] - s[1, 2] * s[1, 2])
        - s[0, 1] * (s[0, 1] * s[2, 2] - s[1, 2] * s[0, 2])
        + s[0, 2] * (s[0, 1] * s[1, 2] - s[1, 1] * s[0, 2])
    )


@kernel
def _mirror(i: int, vx: Any, y: Any, vy: Any) -> float:
    """The variances along the wall that a mirror would leave, by which det S is divided: deviances are of the size of chi^2."""
    side = 1.0
    for m in range(1, 3):
        if y[i, m] == y[i, m]:
            side *= vy[i, m] + vx[i, m]
    return side


@kernel
def _middle(
    law: Any, code: int, form: int, stage: int, i: int, a: float, x: Any, size: float, vx: Any, p: Any, fitted: Any, desk: Any,
    row: Any,
) -> None:  # fmt: skip
    """The law's slopes in v_n and v_t in the middle of a stretch."""
    places, inner = desk[0], desk[4]
    for m in range(3):
        inner[0, m] = row[MIDDLE + m]
    known = 0 if row[3] == 2 else 1  # what it says there was asked before, but for those left as they are
    spin = (places[int(row[0])] + places[int(row[1])]) / 2 * (size / a)
    ask(law, code, form, stage, i, a, (x[i, 0], x[i, 1], spin), size, vx, p, fitted, 2, 1, known, 3, inner)
    for m in range(9):
        row[MIDDLE + m] = inner[m // 3, m % 3]


@kernel
def _integrals(
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any,
    fitted: Any, desk: Any, made: int, sure: float,
) -> tuple[float, float, float]:  # fmt: skip
    """The sum of all stretches' integrals over exp of the least exponent, that least, and the least of c + z^2. Their moments stand
    in the desk, weighed."""
    places, said, stretches, small, _inner = desk
    count, d, side = spins.places.shape[0], how_many(y, i), _mirror(i, vx, y, vy)
    s, q, mid, r = small[0], small[1], small[2], small[3]
    size, _along, mean, width = prior_of(i, x, p)
    bell = 0.0 if spins.uniform else 1 / width
    blurred = vx[i, 0] > 0 or vx[i, 1] > 0

    least, best = math.inf, math.inf
    for e in range(made):
        row = stretches[e]
        one, two = int(row[0]), int(row[1])
        hopeless = not row[4] < sure + HOPELESS
        row[4] = math.inf
        if hopeless:
            continue
        low, high = span(spins, places, one, two, mean, width)
        line(y, i, said, one, two, r)
        if not (low < high and abs(r[0, 0] + r[0, 1] + r[1, 0] + r[1, 1]) < math.inf):
            continue
        for m in range(MIDDLE + 3, COLUMNS):
            row[m] = 0
        if blurred:
            _middle(law, code, form, stage, i, a, x, size, vx, p, fitted, desk, row)
        precision_of(i, y, vx, vy, p, size, places, said, row, mid, s, q)
        share = side * s[0, 0] / _determinant(s) if blurred else 1 + 0 * a
        row[2] = math.sqrt(share) if 0 < share < math.inf else 1 + 0 * a
        c2, c1, c0 = product(q, r[1], r[1]), product(q, r[0], r[1]), product(q, r[0], r[0])
        z0, z1 = (places[one] - mean) * bell, (places[two] - places[one]) * bell
        b2 = b1 = b0 = 0 * a
        if one > 0 and two != count - 1:
            bulge(y, i, said, row, r)
            b2, b1, b0 = product(q, r[2], r[2]), product(q, r[2], r[1]), product(q, r[2], r[0])
        base = lowest_bent(c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0, b2, b1, b0, low, high)
        best = min(best, base)
        if nu == 0 and not base < best + HOPELESS:
            continue
        moments(c2, c1, c0, b2, b1, b0, z0, z1, low, high, nu, d, row)
        least = min(least, row[4])
    norm = 1 / (2 * width) if spins.uniform else 1 / (width * math.sqrt(2 * math.pi))
    return _weigh(places, stretches, made, norm, least), least, best


@kernel
def _weigh(places: Any, stretches: Any, made: int, norm: float, least: float) -> float:
    """Moments become parts of the whole integral over exp of its least exponent; their sum."""
    total = 0.0
    for e in range(made):
        row = stretches[e]
        if row[4] < math.inf:
            w = row[2] * norm * (places[int(row[1])] - places[int(row[0])]) * math.exp((least - row[4]) / 2)
            for n in range(5, 20):
                row[n] *= w
            total += row[5]
    return total


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
        add_scores(law, code, form, stage, i, a, spins, x, vx, y, vy, p, fitted, u, h, desk, made, total)
    return least - 2 * math.log(total), best
