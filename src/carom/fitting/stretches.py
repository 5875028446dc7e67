"""Where a law is asked about a spin that nobody measured: places of sigma, and the stretches between them.

The places do not depend on any number that is fitted. The law is asked there, once more between two where they matter, at the bend
if there is one, and in the middle of each stretch; those whose middle is not where a parabola through its neighbours has it are
halved. In a stretch what the law says is straight or a parabola (:mod:`carom.fitting.bells` has what its columns are).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.bells import HOPELESS, MIDDLE, lowest
from carom.fitting.terms import COVARIANCE, SPIN_MEAN, SPIN_WIDTH, ask
from carom.kernel import kernel

__all__ = ["FITS", "Spins", "bend", "bulge", "cut", "line", "places_of_sigma", "prior_of", "span"]

WIDER = 4.0  # no law magnifies an error in speed by more than its root
FINE = 0.01  # error bars: what a parabola says may be so far off,
FITS = 10.0  # in a row with no more than this c; far off the fit nobody needs it as well
STRAIGHT = 0.001  # error bars: a stretch is left as it is
DEEPEST = 10  # halvings
WITHIN = 0.4  # of a stretch, from its middle: where a bend may be


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
def bend(y: Any, vy: Any, i: int, places: Any, said: Any, n: int, count: int) -> float:
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
def line(y: Any, i: int, said: Any, one: int, two: int, r: Any) -> None:
    """What y misses at the first place, and how that changes to the second, in r[0] and r[1]."""
    for m in range(3):
        seen = y[i, m] == y[i, m]
        r[0, m] = y[i, m] - said[one, m] if seen else 0.0
        r[1, m] = said[one, m] - said[two, m] if seen else 0.0


@kernel
def bulge(y: Any, i: int, said: Any, row: Any, r: Any) -> None:
    """How far what the law says in the middle of a stretch is off the straight line, in r[2]."""
    one, two = int(row[0]), int(row[1])
    for m in range(3):
        off = row[MIDDLE + m] - (said[one, m] + said[two, m]) / 2
        r[2, m] = off if y[i, m] == y[i, m] and abs(off) < math.inf else 0.0


@kernel
def span(spins: Any, places: Any, one: int, two: int, mean: float, width: float) -> tuple[float, float]:
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
    low, high = span(spins, places, one, two, mean, width)
    line(y, i, said, one, two, r)
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
    row[4] = lowest(l2, l1, l0, low, high)
    row[2] = lowest(q2, q1, q0, low, high)


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
def prior_of(i: int, x: Any, p: Any) -> tuple[float, float, float, float]:
    """The ball's speed, v_t/v, and of sigma the mean and the width."""
    size = math.sqrt(x[i, 0] * x[i, 0] + x[i, 1] * x[i, 1])
    along = x[i, 1] / size
    return size, along, p[SPIN_MEAN] * along, p[SPIN_WIDTH]


@kernel
def _at(
    law: Any, code: int, form: int, stage: int, i: int, a: float, x: Any, size: float, vx: Any, p: Any, fitted: Any, sigma: float,
    inner: Any,
) -> None:  # fmt: skip
    """What the law says where the spin is sigma v/a, in inner[0]."""
    v = (x[i, 0], x[i, 1], sigma * (size / a))
    ask(law, code, form, stage, i, a, v, size, vx, p, fitted, 2, 1, 0, 1, inner)


@kernel
def _off_line(y: Any, vy: Any, i: int, said: Any, one: int, two: int, t: float, there: Any) -> float:
    """By how many squared error bars what the law says a share t of the way from one place to another is off the straight line."""
    off = 0.0
    for m in range(3):
        gap = there[m] - (1 - t) * said[one, m] - t * said[two, m]
        off += gap * gap / vy[i, m] if y[i, m] == y[i, m] else 0.0
    return off


@kernel
def _first(
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any,
    fitted: Any, desk: Any,
) -> tuple[int, int]:  # fmt: skip
    """The stretches between the places; those that matter are parted where they bend. How many places and stretches there are."""
    places, said, stretches, small, inner = desk
    count = spins.places.shape[0]
    size, _along, mean, width = prior_of(i, x, p)
    for n in range(count):
        places[n] = spins.places[n]
        _at(law, code, form, stage, i, a, x, size, vx, p, fitted, places[n], inner)
        for m in range(3):
            said[n, m] = inner[0, m]
    # Which stretches matter: those whose least possible exponent is not far above the least that is sure
    sure = math.inf
    for n in range(count - 1):
        stretches[n, 0], stretches[n, 1] = n, n + 1
        _reach(spins, y, vx, vy, i, nu, places, said, mean, width, small[3], stretches[n])
        sure = min(sure, stretches[n, 2])
    used, made = count, count - 1
    for n in range(count - 1):
        if not stretches[n, 4] < sure + HOPELESS:
            stretches[n, 4] = math.inf
            continue
        t = bend(y, vy, i, places, said, n, count)
        places[used] = places[n] + t * (places[n + 1] - places[n])
        _at(law, code, form, stage, i, a, x, size, vx, p, fitted, places[used], inner)
        for m in range(3):
            said[used, m] = inner[0, m]
            stretches[n, MIDDLE + m] = (said[n, m] + said[n + 1, m]) / 2
        if _off_line(y, vy, i, said, n, n + 1, t, inner[0]) < STRAIGHT * STRAIGHT:
            stretches[n, 3] = 2
            continue
        _parts(places, said, used, stretches[n], stretches[made])
        used += 1
        made += 1
    return used, made


@kernel
def cut(
    law: Any, code: int, form: int, stage: int, i: int, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float, p: Any,
    fitted: Any, desk: Any,
) -> tuple[int, float]:  # fmt: skip
    """How many stretches a row has, in the desk, and a deviance that its least is surely not above, as far as they tell."""
    places, said, stretches, small, inner = desk
    size, _along, mean, width = prior_of(i, x, p)
    _more, less = _together(i, vx, vy)
    used, made = _first(law, code, form, stage, i, a, spins, x, vx, y, vy, nu, p, fitted, desk)
    sure = math.inf
    for turn in range(DEEPEST):
        sure = math.inf  # (what a straight line had below the law is not so sure)
        for e in range(made):
            if stretches[e, 4] < math.inf and stretches[e, 3] == 0:
                _reach(spins, y, vx, vy, i, nu, places, said, mean, width, small[3], stretches[e])
            if stretches[e, 4] < math.inf:
                sure = min(sure, stretches[e, 2])
        last = made
        fine = less * FINE * FINE * max(1.0, less * sure / FITS) ** 2
        for e in range(last):
            row = stretches[e]
            if not (row[4] < sure + HOPELESS and row[3] == 0):
                continue
            row[3] = 1
            middle = (places[int(row[0])] + places[int(row[1])]) / 2
            _at(law, code, form, stage, i, a, x, size, vx, p, fitted, middle, inner)
            off = 0 * a
            for m in range(3):
                row[MIDDLE + m] = inner[0, m]
                if y[i, m] == y[i, m]:
                    off += (inner[0, m] - row[5 + m]) * (inner[0, m] - row[5 + m]) / vy[i, m]
            # finer where a parabola does not tell what the law says
            room = turn + 1 < DEEPEST and used < places.shape[0] and made < stretches.shape[0]
            if room and off > fine * math.exp(max(row[4] - sure, 0.0)):
                places[used] = middle
                for m in range(3):
                    said[used, m] = inner[0, m]
                _parts(places, said, used, row, stretches[made])
                used += 1
                made += 1
    return made, sure
