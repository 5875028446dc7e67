"""Cut a smooth curve into panels: graphs over their chords, polynomials whose second derivative has the curve's exact curvature."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from carom.core.geometry.curve import COEFFICIENTS, CX, DEGREE, HALF, OX, ROW, W0, W1

__all__ = ["At", "Panels", "curvature", "cut_into_panels"]

Array = NDArray[np.float64]
At = Callable[[Array], tuple[Array, Array, Array]]
"""Places and two derivatives, each (N, 2), of parameters (N)."""

NODES = DEGREE - 1  # of f'', which is integrated twice
ROUGH = 2e-14  # last coefficients of f'', relative to the greatest: a panel with larger ones is halved
LONGEST_TURN = 0.4  # rad, of a panel
MOST_PANELS = 4000
SCAN = 4096  # parameters at which inflections are sought
FLAT = 1e-12  # curvature times size below which a curve is straight


class Panels(NamedTuple):
    """Panels in the order in which they follow each other."""

    rows: Array
    """(P, ROW): chord, half length, w from -1 to 1, coefficients; the other columns are zero."""
    t: Array
    """(P, 2): parameters at their ends."""
    sign: NDArray[np.int64]
    """(P): of the curvature."""
    turn: Array
    """(P): angle by which the tangent turns, rad."""


def _matrices() -> tuple[Array, Any, Any]:
    """Return the nodes in w; what makes Chebyshev coefficients of f'' of its values there; what makes f in powers of w of these."""
    k = np.arange(NODES)
    w = np.cos(np.pi * (k + 0.5) / NODES)
    values = np.linalg.inv(chebyshev.chebvander(w, NODES - 1))
    twice = np.zeros((DEGREE + 1, NODES))
    for m in range(NODES):
        c = chebyshev.chebint(np.eye(NODES)[m], 2)
        power = chebyshev.cheb2poly(c)
        twice[: len(power), m] = power
    # f vanishes at both ends
    ends = np.stack([np.power(-1.0, np.arange(DEGREE + 1)), np.ones(DEGREE + 1)]) @ twice
    twice[0] -= (ends[0] + ends[1]) / 2
    twice[1] -= (ends[1] - ends[0]) / 2
    return w, values, twice


W_NODES, CHEBYSHEV, POWERS = _matrices()
SLOPES = np.array([(k + 1) * W_NODES**k for k in range(DEGREE)])  # f' at the nodes, by powers of w


def _across(one: Array, other: Array) -> Array:
    found: Array = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return found


def curvature(at: At, t: Array) -> Array:
    """Return the curvature (N) at parameters (N); positive where the curve turns to the left."""
    _x, d, dd = at(t)
    found: Array = _across(d, dd) / np.hypot(d[..., 0], d[..., 1]) ** 3
    return found


def inflections(at: At, t0: float, t1: float, size: float) -> Array:
    """Return the parameters at which the curvature changes its sign."""
    t = np.linspace(t0, t1, SCAN + 1)
    t = (t + np.sin(np.arange(SCAN + 1)) * (t1 - t0) * 0.2 / SCAN).clip(
        t0, t1
    )  # (an inflection in a node is no place for a sign)
    k = curvature(at, t)
    k[np.abs(k) * size < FLAT] = 0.0
    here = np.flatnonzero(k[:-1] * k[1:] < 0)
    low, high, below = t[here], t[here + 1], k[here] < 0
    for _ in range(60):
        middle = (low + high) / 2
        left = (curvature(at, middle) < 0) == below
        low, high = np.where(left, middle, low), np.where(left, high, middle)
    return (low + high) / 2


def _fit(at: At, t0: Array, t1: Array) -> tuple[Array, NDArray[np.bool_], Array]:
    """Return rows (M, ROW) of panels between parameters (M), whether each is fine enough, and the angle by which it turns."""
    (x0, d0, _), (x1, d1, _) = at(t0), at(t1)
    chord = x1 - x0
    length = np.hypot(chord[:, 0], chord[:, 1])
    e = chord / length[:, None]
    # parameters at the nodes, by Newton's method: xi grows with t on a panel that is fine enough
    xi = length[:, None] / 2 * (1 + W_NODES)
    t = t0[:, None] + (t1 - t0)[:, None] * (1 + W_NODES) / 2
    for _ in range(8):
        x, d, dd = (one.reshape(*t.shape, 2) for one in at(t.ravel()))
        along, rate = (np.einsum("nki,ni->nk", one, e) for one in (x - x0[:, None], d))
        t = np.clip(t - (along - xi) / rate, t0[:, None], t1[:, None])
    x, d, dd = (one.reshape(*t.shape, 2) for one in at(t.ravel()))
    rate = np.einsum("nki,ni->nk", d, e)
    # f'' = kappa (1 + f'^2)^(3/2), which is d x dd over the cube of the rate of xi
    second = _across(d, dd) / rate**3
    turn = np.arctan2(_across(d0, d1), (d0 * d1).sum(-1))
    coefficients = second @ CHEBYSHEV.T
    largest = np.abs(second).max(axis=1)
    fine = (np.abs(coefficients[:, -2:]).max(axis=1) <= ROUGH * largest + FLAT * 1e-3 / length) & (
        np.abs(turn) < LONGEST_TURN
    )
    fine &= (rate > 0).all(axis=1)
    rows = np.zeros((len(t0), ROW))
    rows[:, OX : OX + 2], rows[:, CX : CX + 2], rows[:, HALF] = x0, e, length / 2
    rows[:, W0], rows[:, W1] = -1.0, 1.0
    rows[:, COEFFICIENTS:] = (coefficients @ POWERS.T) * (length / 2)[:, None] ** 2
    # the chord's direction has the rounding of its ends over its length: f' is that of the tangents, which have not
    slope = np.einsum("nk,kj->nj", rows[:, COEFFICIENTS + 1 :], SLOPES) / rows[:, [HALF]]
    exact = (e[:, :1] * d[..., 1] - e[:, 1:] * d[..., 0]) / rate
    rows[:, COEFFICIENTS + 1] += (exact - slope).mean(axis=1) * rows[:, HALF]
    return rows, fine, turn


def cut_into_panels(at: At, t0: float, t1: float, size: float, cuts: Array | None = None) -> Panels:
    """Return the panels of a curve from a parameter to a larger one; ``cuts``: parameters at which panels have to end.

    Raises ValueError where the curve is not smooth enough: it has no tangent somewhere, or its curvature jumps.
    """
    bends = inflections(at, t0, t1, size)
    ends = np.unique(np.concatenate([np.linspace(t0, t1, 9), bends, [] if cuts is None else cuts]))
    ends = ends[np.concatenate([[True], np.diff(ends) > 1e-9 * (t1 - t0)])]
    ends[-1] = t1
    todo = np.stack([ends[:-1], ends[1:]], axis=1)
    done: list[tuple[Array, Array, Array]] = []
    count = 0
    while len(todo):
        with np.errstate(all="ignore"):
            rows, fine, turn = _fit(at, todo[:, 0], todo[:, 1])
        short = todo[:, 1] - todo[:, 0] < 1e-9 * (t1 - t0)
        if (short & ~fine).any() or count + len(todo) > MOST_PANELS:
            bad = todo[~fine]
            raise ValueError(float(bad.mean()))
        done.append((rows[fine], todo[fine], turn[fine]))
        count += int(fine.sum())
        rest = todo[~fine]
        middle = rest.mean(axis=1)
        todo = np.concatenate([np.stack([rest[:, 0], middle], axis=1), np.stack([middle, rest[:, 1]], axis=1)])
    rows, t, turn = (np.concatenate([one[k] for one in done]) for k in range(3))
    order = np.argsort(t[:, 0])
    rows, t, turn = rows[order], t[order], turn[order]
    k = curvature(at, t.mean(axis=1))
    sign = np.where(np.abs(k) * size < FLAT, 0, np.sign(k)).astype(np.int64)
    return Panels(rows, t, sign, turn)
