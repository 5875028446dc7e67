"""The deviance of a rebound whose spin before the wall nobody measured: averaged over what it may have been.

The spin is sigma v/a, v the ball's speed, with a prior density of sigma: normal about mean v_t/v with a width, or uniform
within a width of it. The row's deviance is

    -2 log of the integral of exp(-c(sigma)/2) (S_nn / det S(sigma))^(1/2) rho(sigma) d sigma,

c and S as in :mod:`carom.fitting.terms`, but for a constant that no law knows. Of what is known before the wall a density's root of
det S would pull numbers off, so the normal part S_nn has none; along the wall the unknown spin takes up what is measured, and there
it would be c without the root that pulls (by 30 in chi^2 for 100 rows, which made a tangential restitution of what is none). J in
S is taken along the mean of the prior: the spin goes with v_t.

The law is asked at places of sigma that do not depend on any number that is fitted, once more between two where they
matter, at the bend if there is one, and in the middle of each stretch; those whose middle is not where a parabola through
its neighbours has it are halved. In a stretch what the law says is a parabola, and S the same: a piece of a bell, a little
bent, whose moments are Gauss sums over the part of it that is not nothing. For slopes it is the straight line at its mass.
All slopes of c and of log rho are parabolas then, so that scores and Louis's curvature (J. R. Stat. Soc. B 44, 226 (1982))
need these moments and nothing else. The law's slopes in its own numbers are asked only
where the row's spin may have been.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.terms import COVARIANCE, NO_ANSWER, SPIN_MEAN, SPIN_WIDTH, ask, how_many, precision
from carom.kernel import kernel

__all__ = ["COLUMNS", "SMALL", "Spins", "places_of_sigma", "unmeasured_row"]

HOPELESS = 27.0  # a deviance so far above the least has no share: exp(-13.5)
SHARE = 1e-4  # of a row's integral: stretches with less do not ask for slopes
WIDER = 4.0  # no law magnifies an error in speed by more than its root
FINE = 0.01  # error bars: what a parabola says may be so far off,
FITS = 10.0  # in a row with no more than this c; far off the fit nobody needs it as well
STRAIGHT = 0.001  # error bars: a stretch is left as it is
DEEPEST = 10  # halvings
NEWTON = 3  # steps
WITHIN = 0.4  # of a stretch, from its middle: where a bend may be
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
# of a stretch: its two places, the least of its exponent (4), its moments (3 by 5, from 5); in its middle what the law says and
# slopes in v_n and v_t (last 9)
COLUMNS = 29
SMALL = 13  # scratch arrays
PIECES = np.array(
    [-math.inf, -80.0, -20.0, -6.0, -2.0, 2.0, 6.0, 20.0, 80.0, math.inf]
)  # of Student's t, in its widths


class Spins(NamedTuple):
    """What is assumed of spins that nobody measured."""

    places: NDArray[np.float64]
    """(M,) of sigma, at which the law is asked."""
    uniform: bool


def places_of_sigma(count: int = 41, furthest: float = 12.0, dense: float = 0.6) -> NDArray[np.float64]:
    """Places close to each other about zero, where slips change sign, and far where friction has no more to give."""
    far = math.asinh(furthest / dense)
    return dense * np.sinh(np.linspace(-far, far, count))


@kernel
def _least(c2: float, c1: float, c0: float, low: float, high: float) -> float:
    """The least of c2 t^2 + 2 c1 t + c0 from low to high, c2 not negative."""
    t = -c1 / c2 if c2 > 0 else 0 * c2
    t = min(max(t, low), high)
    if not abs(t) < math.inf:
        return c0
    return (c2 * t + 2 * c1) * t + c0


@kernel
def _curved(b2: float, b1: float, b0: float, t: float) -> float:
    """What c has beside its parabola where what the law says is one: c of r0 + r1 t - 4 t (1 - t) g, b2 = g' S^-1 g, b1 = g' S^-1
    r1, b0 = g' S^-1 r0."""
    w = 4 * t * (1 - t)
    return w * (w * b2 - 2 * (b1 * t + b0))


@kernel
def _lowest(q2: float, q1: float, q0: float, b2: float, b1: float, b0: float, low: float, high: float) -> float:
    """The least of q2 t^2 + 2 q1 t + q0 and what is curved, from low to high: Gauss and Newton's, from that of the parabola."""
    if b2 == 0:
        return _least(q2, q1, q0, low, high)
    t = min(max(-q1 / q2 if q2 > 0 else 0 * q2, low), high)
    least = (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t)
    for _ in range(NEWTON):
        w, slope = 4 * t * (1 - t), 4 - 8 * t
        steep = q2 - 2 * slope * b1 + slope * slope * b2
        if not steep > 0:
            break
        t -= (q2 * t + q1 - slope * (b1 * t + b0 - w * b2) - w * b1) / steep
        t = min(max(t, low), high)
        least = min(least, (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t))
    return least


@kernel
def _moments(
    c2: float, c1: float, c0: float, b2: float, b1: float, b0: float, z0: float, z1: float, low: float, high: float, nu: float,
    d: int, row: Any,
) -> None:  # fmt: skip
    """The least of c(t) + (z0 + z1 t)^2 from low to high in row[4], and from there on the integrals of t^n tau^m exp(..) over
    exp of that least, n 0 to 4, m 0 to 2, where tau is the weight that Student's t gives c."""
    q2, q1, q0 = c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0
    base = _lowest(q2, q1, q0, b2, b1, b0, low, high)
    row[4] = base
    for n in range(5, 20):
        row[n] = 0
    if nu == 0:
        if q2 > 0:
            top, far = -q1 / q2, math.sqrt(base + HOPELESS) + math.sqrt(b2)
            far = math.sqrt(max(far * far - (q0 - q1 * q1 / q2), 0.0) / q2)
            low, high = max(low, top - far), min(high, top + far)
        for n in range(
            NODES.shape[0] if b2 != 0 else 0
        ):  # far off the fit the least that was sought may not be the least
            t = (low + high + (high - low) * NODES[n]) / 2
            base = min(base, (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t))
        row[4] = base
        for n in range(NODES.shape[0]):
            t = (low + high + (high - low) * NODES[n]) / 2
            c = (q2 * t + 2 * q1) * t + q0 + _curved(b2, b1, b0, t)
            w = WEIGHTS[n] * math.exp((base - c) / 2) * (high - low) / 2
            for m in range(5):
                row[5 + m] += w
                w *= t
        for m in range(5):
            row[10 + m] = row[15 + m] = row[5 + m]
        return
    # heavy tails: pieces about the place where c is least, as far as the prior goes
    if z1 != 0:
        top, far = -z0 / z1, math.sqrt(HOPELESS) / abs(z1)
        nearest = min(max(top, low), high)
        far = math.sqrt(far * far + (nearest - top) * (nearest - top))
        low, high = max(low, top - far), min(high, top + far)
    top = min(max(-c1 / c2, low), high) if c2 > 0 else low
    wide = 1 / math.sqrt(max(c2, 1e-12))
    c = max((c2 * top + 2 * c1) * top + c0 + _curved(b2, b1, b0, top), 0.0)
    base = (nu + d) * math.log(1 + c / nu) + (z0 + z1 * top) * (z0 + z1 * top)
    near = min(max(-z0 / z1, low), high) if z1 != 0 else top
    c = max((c2 * near + 2 * c1) * near + c0 + _curved(b2, b1, b0, near), 0.0)
    base = min(base, (nu + d) * math.log(1 + c / nu) + (z0 + z1 * near) * (z0 + z1 * near))
    row[4] = base
    for piece in range(PIECES.shape[0] - 1):
        left, right = max(low, top + wide * PIECES[piece]), min(high, top + wide * PIECES[piece + 1])
        if not left < right:
            continue
        for n in range(NODES.shape[0]):
            t = (left + right + (right - left) * NODES[n]) / 2
            c, z = max((c2 * t + 2 * c1) * t + c0 + _curved(b2, b1, b0, t), 0.0), z0 + z1 * t
            w = WEIGHTS[n] * math.exp((base - (nu + d) * math.log(1 + c / nu) - z * z) / 2) * (right - left) / 2
            tau = (nu + d) / (nu + c)
            for m in range(5):
                row[5 + m] += w
                row[10 + m] += w * tau
                row[15 + m] += w * tau * tau
                w *= t


@kernel
def _bend(y: Any, vy: Any, i: int, places: Any, said: Any, n: int, count: int) -> float:
    """Where between places n and n + 1, as a share of the way, to ask again: where the lines from both sides meet, which is the
    middle of a curve that is smooth, and the bend of one that has one."""
    if n == 0 or n + 2 >= count:
        return 0.5
    here = places[n + 1] - places[n]
    before, after = here / (places[n] - places[n - 1]), here / (places[n + 2] - places[n + 1])
    top = bottom = 0 * places[0]
    for m in range(3):
        if y[i, m] == y[i, m]:
            left = (said[n, m] - said[n - 1, m]) * before
            right = (said[n + 2, m] - said[n + 1, m]) * after
            gap, turn = said[n, m] - said[n + 1, m] + right, left - right
            top -= gap * turn / vy[i, m]
            bottom += turn * turn / vy[i, m]
    if not bottom > 0:  # (nor so where the law has no answer)
        return 0.5
    off = top / bottom - 0.5
    # lines that meet outside show no bend here; as they come to be parallel the place comes to the middle, from either side
    return float(0.5 + (off if abs(off) <= WITHIN else WITHIN * WITHIN / off))


@kernel
def _line(y: Any, i: int, said: Any, one: int, two: int, r: Any) -> None:
    """What y misses at the first place, and how that changes to the second, in r[0] and r[1]."""
    for m in range(3):
        seen = y[i, m] == y[i, m]
        r[0, m] = y[i, m] - said[one, m] if seen else 0.0
        r[1, m] = said[one, m] - said[two, m] if seen else 0.0


@kernel
def _bulge(y: Any, i: int, said: Any, row: Any, r: Any) -> None:
    """How far what the law says in the middle of a stretch is off the straight line, in r[2]."""
    one, two = int(row[0]), int(row[1])
    for m in range(3):
        off = row[COLUMNS - 9 + m] - (said[one, m] + said[two, m]) / 2
        r[2, m] = off if y[i, m] == y[i, m] and abs(off) < math.inf else 0.0


@kernel
def _range(spins: Any, places: Any, one: int, two: int, mean: float, width: float) -> tuple[float, float]:
    """From where to where a stretch goes, as shares of it: the first and the last have no end, and a uniform prior has two."""
    low = -math.inf if one == 0 else 0.0
    high = math.inf if two == spins.places.shape[0] - 1 else 1.0
    if spins.uniform:
        far = places[two] - places[one]
        low, high = max(low, (mean - width - places[one]) / far), min(high, (mean + width - places[one]) / far)
    return low, high


@kernel
def _together(i: int, vx: Any, vy: Any) -> tuple[float, float]:
    """By how much errors before and after that go together make S larger, and smaller, at most."""
    more, less = 1 + 0 * vx[i, 0], 1 + 0 * vx[i, 0]
    for o in range(2):
        if vx[i, COVARIANCE + o] != 0:
            square = vx[i, COVARIANCE + o] * vx[i, COVARIANCE + o] / (vx[i, o] * vy[i, o])
            more, less = max(more, 1 + math.sqrt(square)), min(less, 1 - square)
    return more, less


@kernel
def _reach(
    spins: Any, y: Any, vx: Any, vy: Any, i: int, nu: float, places: Any, said: Any, mean: float, width: float, r: Any, row: Any
) -> None:  # fmt: skip
    """Of a stretch the least possible exponent in row[4], infinite where it has no part, and one that it surely is not above in
    row[2], as far as the law is straight."""
    one, two = int(row[0]), int(row[1])
    row[2] = row[4] = math.inf
    low, high = _range(spins, places, one, two, mean, width)
    _line(y, i, said, one, two, r)
    if not (low < high and abs(r[0, 0] + r[0, 1] + r[1, 0] + r[1, 1]) < math.inf):
        return
    bell = 0.0 if spins.uniform else 1 / width
    z0, z1 = (places[one] - mean) * bell, (places[two] - places[one]) * bell
    q2, q1, q0 = z1 * z1, z0 * z1, z0 * z0
    l2, l1, l0 = q2, q1, q0
    wide = WIDER * (vx[i, 0] + vx[i, 1])
    more, less = _together(i, vx, vy)
    for m in range(3 if nu == 0 else 0):  # heavy tails rule nothing out; the prior alone does
        if y[i, m] != y[i, m]:
            continue
        t = 1 / (less * vy[i, m])
        q2, q1, q0 = q2 + t * r[1, m] * r[1, m], q1 + t * r[0, m] * r[1, m], q0 + t * r[0, m] * r[0, m]
        if m < 2:
            t = 1 / (more * (vy[i, m] + wide))
            l2, l1, l0 = l2 + t * r[1, m] * r[1, m], l1 + t * r[0, m] * r[1, m], l0 + t * r[0, m] * r[0, m]
    row[4] = _least(l2, l1, l0, low, high)
    row[2] = _least(q2, q1, q0, low, high)


@kernel
def _parts(places: Any, said: Any, at: int, row: Any, other: Any) -> None:
    """A stretch becomes the first of its two parts, the other the second: from place ``at`` on. What a parabola through all three
    places says in the middle of each stands in columns 5 to 7."""
    one, two = int(row[0]), int(row[1])
    row[1], other[0], other[1] = at, at, two
    row[3] = other[3] = 0
    other[4] = row[4]
    here, there, far = places[at] - places[one], places[two] - places[at], places[two] - places[one]
    for m in range(3):
        turn = ((said[two, m] - said[at, m]) / there - (said[at, m] - said[one, m]) / here) / far
        row[5 + m] = (said[one, m] + said[at, m] - turn * here * here / 2) / 2
        other[5 + m] = (said[at, m] + said[two, m] - turn * there * there / 2) / 2


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
        mid[0, m] = row[COLUMNS - 6 + m]
        mid[1, m] = row[COLUMNS - 3 + m] + turned * (said[two, m] - said[one, m])


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
def unmeasured_row(  # noqa: PLR0915  (one row, from the law's answers to its integral)
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any,
    fitted: Any, u: Any, h: Any, desk: Any,
) -> tuple[float, float]:  # fmt: skip
    """A row's deviance, scores and information as :func:`carom.fitting.terms.known_row` gives them; and the least of c + z^2, z the
    distance from the prior's mean in its widths (of a uniform prior 0)."""
    places, said, stretches, small, inner = desk
    free, _steps, moved, further = fitted
    k, count = free.shape[0], spins.places.shape[0]
    u[:] = 0
    h[:] = 0
    d = how_many(y, i)
    if d == 0:
        return 0 * a, 0 * a
    s, q, mid, r = small[0], small[1], small[2], small[3]
    v_n, v_t = x[i, 0], x[i, 1]
    size = math.sqrt(v_n * v_n + v_t * v_t)
    along, unit = v_t / size, size / a
    width, mean = p[SPIN_WIDTH], p[SPIN_MEAN] * along
    bell = 0.0 if spins.uniform else 1 / width
    blurred = vx[i, 0] > 0 or vx[i, 1] > 0
    for n in range(count):
        places[n] = spins.places[n]
        ask(law, code, form, stage, i, a, (v_n, v_t, places[n] * unit), size, vx, p, fitted, 2, 1, 0, 1, inner)
        for m in range(3):
            said[n, m] = inner[0, m]

    _more, less = _together(i, vx, vy)
    # Which stretches matter: those whose least possible exponent is not far above the least that is sure
    sure = math.inf
    for n in range(count - 1):
        stretches[n, 0], stretches[n, 1] = n, n + 1
        _reach(spins, y, vx, vy, i, nu, places, said, mean, width, r, stretches[n])
        sure = min(sure, stretches[n, 2])
    used, made = count, count - 1
    for n in range(count - 1):
        if not stretches[n, 4] < sure + HOPELESS:
            stretches[n, 4] = math.inf
            continue
        t, off = _bend(y, vy, i, places, said, n, count), 0 * a
        places[used] = places[n] + t * (places[n + 1] - places[n])
        ask(law, code, form, stage, i, a, (v_n, v_t, places[used] * unit), size, vx, p, fitted, 2, 1, 0, 1, inner)
        for m in range(3):
            said[used, m] = inner[0, m]
            stretches[n, COLUMNS - 9 + m] = (said[n, m] + said[n + 1, m]) / 2
            gap = inner[0, m] - (1 - t) * said[n, m] - t * said[n + 1, m]
            off += gap * gap / vy[i, m] if y[i, m] == y[i, m] else 0.0
        if off < STRAIGHT * STRAIGHT:
            stretches[n, 3] = 2
            continue
        _parts(places, said, used, stretches[n], stretches[made])
        used += 1
        made += 1
    # and are finer where a parabola does not tell what the law says in their middle
    for turn in range(DEEPEST):
        sure = math.inf  # (what a straight line had below the law is not so sure)
        for e in range(made):
            if stretches[e, 4] < math.inf and stretches[e, 3] == 0:
                _reach(spins, y, vx, vy, i, nu, places, said, mean, width, r, stretches[e])
            if stretches[e, 4] < math.inf:
                sure = min(sure, stretches[e, 2])
        last = made
        fine = less * FINE * FINE * max(1.0, less * sure / FITS) ** 2
        for e in range(last):
            row = stretches[e]
            if not (row[4] < sure + HOPELESS and row[3] == 0):
                continue
            row[3] = 1
            one, two = int(row[0]), int(row[1])
            spin = (places[one] + places[two]) / 2 * unit
            ask(law, code, form, stage, i, a, (v_n, v_t, spin), size, vx, p, fitted, 2, 1, 0, 1, inner)
            off = 0 * a
            for m in range(3):
                row[COLUMNS - 9 + m] = inner[0, m]
                if y[i, m] == y[i, m]:
                    off += (inner[0, m] - row[5 + m]) * (inner[0, m] - row[5 + m]) / vy[i, m]
            room = turn + 1 < DEEPEST and used < places.shape[0] and made < stretches.shape[0]
            if room and off > fine * math.exp(max(row[4] - sure, 0.0)):
                places[used] = (places[one] + places[two]) / 2
                for m in range(3):
                    said[used, m] = inner[0, m]
                _parts(places, said, used, row, stretches[made])
                used += 1
                made += 1

    # so that deviances are of the size of chi^2: the variances that a mirror would leave along the wall
    side = 1 + 0 * a
    for m in range(1, 3):
        if y[i, m] == y[i, m]:
            side *= vy[i, m] + vx[i, m]

    # Each stretch's integral
    least, best = math.inf, math.inf
    for e in range(made):
        row = stretches[e]
        one, two = int(row[0]), int(row[1])
        if not row[4] < sure + HOPELESS:
            row[4] = math.inf
            continue
        row[4] = math.inf
        far = places[two] - places[one]
        low, high = _range(spins, places, one, two, mean, width)
        _line(y, i, said, one, two, r)
        if not (low < high and abs(r[0, 0] + r[0, 1] + r[1, 0] + r[1, 1]) < math.inf):
            continue
        for m in range(COLUMNS - 6, COLUMNS):
            row[m] = 0
        if blurred:
            spin = (places[one] + places[two]) / 2 * unit
            for m in range(3):
                inner[0, m] = row[COLUMNS - 9 + m]
            known = 0 if row[3] == 2 else 1  # what it says there was asked before, but for those left as they are
            ask(law, code, form, stage, i, a, (v_n, v_t, spin), size, vx, p, fitted, 2, 1, known, 3, inner)
            for m in range(9):
                row[COLUMNS - 9 + m] = inner[m // 3, m % 3]
        _slopes(row, said, one, two, p[SPIN_MEAN] / ((places[two] - places[one]) * size), mid)
        precision(i, y, vx, vy, mid, 0, 2, s, q)
        share = side * s[0, 0] / _determinant(s) if blurred else 1 + 0 * a
        row[2] = math.sqrt(share) if 0 < share < math.inf else 1 + 0 * a
        c2, c1, c0 = _form(q, r[1], r[1]), _form(q, r[0], r[1]), _form(q, r[0], r[0])
        z0, z1 = (places[one] - mean) * bell, far * bell
        b2 = b1 = b0 = 0 * a
        if one > 0 and two != count - 1:
            _bulge(y, i, said, row, r)
            b2, b1, b0 = _form(q, r[2], r[2]), _form(q, r[2], r[1]), _form(q, r[2], r[0])
        base = _lowest(c2 + z1 * z1, c1 + z0 * z1, c0 + z0 * z0, b2, b1, b0, low, high)
        best = min(best, base)
        if nu == 0 and not base < best + HOPELESS:
            continue
        _moments(c2, c1, c0, b2, b1, b0, z0, z1, low, high, nu, d, row)
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
    if not (total > 0 and least < NO_ANSWER):
        return NO_ANSWER, NO_ANSWER

    # Slopes: of each number its score is a parabola in t, in score[j]; what the law says moves by g[j, 0] + g[j, 1] t
    # (of the law, and of the prior, whose mean goes with v_t/v: by pull for each number)
    score, curve, outer, prior, pull = small[4], small[5], small[6], small[11], small[12, 0]
    curve[:] = 0
    outer[:] = 0
    for j in range(k):
        pull[j] = along if free[j] == SPIN_MEAN else 0.0
        z = free[j] - further.shape[1]
        if z >= 0 and not spins.uniform:
            pull[j] = p[SPIN_MEAN] * v_n * (v_n * moved[z, i, 1] - v_t * moved[z, i, 0]) / (size * size * size)
    for e in range(made if k > 0 else 0):
        row = stretches[e]
        if not (row[4] < math.inf and row[5] > SHARE * total):
            continue
        one, two = int(row[0]), int(row[1])
        _line(y, i, said, one, two, r)
        _slopes(row, said, one, two, p[SPIN_MEAN] / ((places[two] - places[one]) * size), mid)
        precision(i, y, vx, vy, mid, 0, 2, s, q)
        if one > 0 and two != count - 1:
            # curved: the straight line that has its mean and its slope where the stretch has its mass
            _bulge(y, i, said, row, r)
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
                inner[m // 3, m % 3] = row[COLUMNS - 9 + m]
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
    return least - 2 * math.log(total), best
