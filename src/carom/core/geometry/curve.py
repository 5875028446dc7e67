"""A smooth curve as a wall: when a point on a straight line or a parabola meets it, its normal, its curvature.

The wall E is cut into panels. Over its chord, of length 2 h, each is a graph eta = f(xi) with xi = h (1 + w), -1 <= w <= 1, and f a
polynomial in w (:mod:`carom.core.geometry.curve` makes them). The interior lies on the left. The centre of a ball of radius a is
bounded by the parallel curve

    P(w) = E(w) + a n(w),    P' = E' (1 - a kappa),

so that one table of polynomials serves all radii, and nothing special happens where 1 - a kappa is small.

**Straight lines.** With c = v x (P - x), a point leaves the interior where c rises through zero along the curve, and enters it
where c falls through zero; so a start from the wall needs no tolerance. c' is |P'| v x T. On an *arc*, on which 1 - a kappa > 0,
the tangent T turns one way and by less than pi, v x T changes its sign once at most: c rises on one stretch at most. Bisection of
the nodes between panels finds the end of that stretch, and the panel in which c changes its sign; Newton's method within a bracket
finds the root. No root is missed, except of a graze that is no deeper than rounding.

**Parabolas.** Over the panel's chord the parallel curve is a graph as well, eta = F(xi), with F' = f' at the foot of the normal and
F'' = kappa/(1 - a kappa) (1 + F'^2)^(3/2). On a parabola G(s) = eta(s) - F(xi(s)) has a bounded second derivative. Where G is
positive at both ends of a stretch of time and the chord less this bound stays positive, nothing is met; where G falls throughout,
it has one root; every other stretch is halved (:mod:`carom.core.geometry.curve`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from carom.core.jit.kernel import hot_kernel, kernel
from carom.core.roots import searches

NEVER = math.inf
DEGREE = 13
# Columns of a row of the table: node and tangent where the panel begins, on the parallel curve; the chord's beginning and
# direction; half its length; w where the panel begins and ends; xi of the parallel curve there; bounds of F, |F'| and |F''|; the
# coefficients. The last row of an arc is its last node alone.
X, TX, OX, CX, HALF, W0, W1, FIRST_XI, LAST_XI, LOW, HIGH, SLOPE, BEND, COEFFICIENTS = (
    0,
    2,
    4,
    6,
    8,
    9,
    10,
    11,
    12,
    13,
    14,
    15,
    16,
    17,
)
Y, TY, OY, CY = X + 1, TX + 1, OX + 1, CX + 1
ROW = COEFFICIENTS + DEGREE + 1
PAIRS = (DEGREE + 1) // 2
NEAR, TINY = 2e-5, 1e-15  # a step in w after which the second order gives the root, and so much of it is rounding
CLOSE = 1e-8  # Newton's step in w after which the tangent gives the root: what is left out is of second order


@hot_kernel
def curve_graph(panels: Any, j: int, w: float) -> tuple[float, float, float]:
    """Return f, f' and f'' (by xi) of a panel: even and odd powers apart, whose sums do not wait for each other."""
    z = w * w
    even, odd, even1, odd1, even2, odd2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for m in range(PAIRS):
        k = DEGREE - 1 - 2 * m
        p, q = panels[j, COEFFICIENTS + k], panels[j, COEFFICIENTS + k + 1]
        even, odd = even * z + p, odd * z + q
        odd1 = odd1 * z + (k + 1.0) * q
        if k > 0:
            even1 = even1 * z + k * p
            even2 = even2 * z + k * (k - 1.0) * p
            odd2 = odd2 * z + (k + 1.0) * k * q
    r = 1.0 / panels[j, HALF]
    return even + w * odd, (odd1 + w * even1) * r, (even2 + w * odd2) * (r * r)


@hot_kernel
def offset_point(panels: Any, j: int, a: float, w: float) -> tuple[float, float, float, float]:
    """Return xi and eta of the parallel curve at w, its slope, and the rate of xi: P' = rate (1, slope)."""
    f, f1, f2 = curve_graph(panels, j, w)
    h = panels[j, HALF]
    if a == 0.0:
        return h * (1.0 + w), f, f1, h
    q = 1.0 / math.sqrt(1.0 + f1 * f1)
    return h * (1.0 + w) - a * f1 * q, f + a * q, f1, h * (1.0 - a * f2 * (q * q * q))


@kernel
def panel_where_slope_is(panels: Any, j: int, u: float, v: float) -> float:
    """Return w where the panel's tangent has the direction (u, v) of the chord's frame; there is one on the panel."""
    low: float = panels[j, W0]
    high: float = panels[j, W1]
    g0 = u * curve_graph(panels, j, low)[1] - v
    w = 0.5 * (low + high)
    for _ in range(100):
        _f, f1, f2 = curve_graph(panels, j, w)
        g = u * f1 - v
        if (g > 0.0) == (g0 > 0.0):
            low = w
        else:
            high = w
        rate = u * f2 * panels[j, HALF]
        new = w - g / rate if rate != 0.0 else NEVER
        if not low <= new <= high:
            new = 0.5 * (low + high)
        step = abs(new - w)
        w = new
        if step <= CLOSE:
            break
    return w


@kernel
def panel_crossing(
    panels: Any, j: int, a: float, x: float, y: float, u: float, v: float, low: float, high: float, w: float
) -> float:
    """Return v.(P - x) where c rises through zero between low and high, in the chord's frame; Newton's method begins at w."""
    h = panels[j, HALF]
    for _ in range(200 if a == 0.0 else 0):
        f, f1, f2 = curve_graph(panels, j, w)
        dx, dy = h * (1.0 + w) - x, f - y
        c = u * dy - v * dx
        if c < 0.0:
            low = w
        else:
            high = w
        d = h * (u * f1 - v)
        step = -c / d if d > 0.0 else NEVER
        new = w + step
        if not low <= new <= high:
            new = 0.5 * (low + high)
        elif abs(step) <= NEAR:
            # the step of second order; the third is below rounding
            bend = u * f2 * (h * h) * step / d
            if bend * bend * abs(step) <= TINY:
                step = step - 0.5 * bend * step
                path: float = u * dx + v * dy + step * h * (u + v * f1) + 0.5 * (step * step) * (h * h) * (v * f2)
                return path
        if new == w:
            path = u * dx + v * dy
            return path
        w = new
    for _ in range(200):
        px, py, slope, rate = offset_point(panels, j, a, w)
        dx, dy = px - x, py - y
        c = u * dy - v * dx
        if c < 0.0:
            low = w
        else:
            high = w
        d = rate * (u * slope - v)
        new = w - c / d if d > 0.0 else NEVER
        if not low <= new <= high:
            new = 0.5 * (low + high)
        step = new - w
        if abs(step) <= CLOSE:
            along: float = u * dx + v * dy + step * rate * (u + v * slope)
            return along
        w = new
    return NEVER


@hot_kernel
def _turning(table: Any, j: int, last: int, u: float, v: float) -> int:
    """Return the panel, of those from j to the last one, in which v x T, above zero before it, changes its sign."""
    count = last - j + 1
    while count > 1:
        half = count // 2
        j = j + (half if u * table[j + half, TY] - v * table[j + half, TX] > 0.0 else 0)
        count = count - half
    return j


def line_times(side: Callable[..., float], guess: Callable[..., float], beyond: float) -> Callable[..., float]:
    """Return the kernel of when a straight line leaves an arc.

    ``side(table, k, a, x, y, u, v)``: c at a node; ``guess(table, j, low, high, c0, c1, u, v)``: roughly w of the root of c, which
    is c0 < 0 and c1 >= 0 at two places of a panel. ``beyond``, of w: so much beyond its ends still belongs to a panel.
    """

    @kernel
    def line_time(
        table: Any, j0: int, w0: float, j1: int, w1: float, begins: bool, ends: bool, first: float, last: float, a: float,
        near: float, x: float, y: float, u: float, v: float,
    ) -> float:  # fmt: skip
        """Return the time at which a point on a line leaves through an arc, possibly negative; infinity where it does not.

        From w0 of the panel j0 to w1 of j1; at these ends c is ``first`` and ``last``, and rises or not (``begins``, ``ends``). A
        graze whose depth is below ``near`` (m) counts where the curve bends towards the line from both sides, as it does at the
        start of a flight along the wall.
        """
        if begins:
            if first >= 0.0 or (ends and last < 0.0):
                return NEVER
        elif not ends or last < 0.0:
            return NEVER
        # c rises from low to high; where it does not rise throughout, from or to the panel in which v x T changes its sign
        low, high, part = j0, j1, 0
        if begins != ends:
            turn = _turning(table, j0, j1, u, v) if begins else _turning(table, j0, j1, -u, -v)
            if begins and turn > j0 and side(table, turn, a, x, y, u, v) >= 0.0:
                high = turn - 1
            elif ends and turn < j1 and side(table, turn + 1, a, x, y, u, v) < 0.0:
                low = turn + 1
            else:
                low, high = turn, turn
                if begins:
                    part = 0 if (last if turn == j1 else side(table, turn + 1, a, x, y, u, v)) >= 0.0 else -1
                else:
                    part = 0 if (first if turn == j0 else side(table, turn, a, x, y, u, v)) < 0.0 else 1
        j, count = low, high - low + 1
        while count > 1:
            half = count // 2
            # (a choice between numbers, for which the processor need not guess)
            j = j + (half if side(table, j + half, a, x, y, u, v) < 0.0 else 0)
            count = count - half
        # in the chord's frame
        ex, ey = table[j, CX], table[j, CY]
        dx, dy = x - table[j, OX], y - table[j, OY]
        x1, y1, u1, v1 = ex * dx + ey * dy, ex * dy - ey * dx, ex * u + ey * v, ex * v - ey * u
        squared = u * u + v * v
        left, right = w0 if j == j0 else table[j, W0], w1 if j == j1 else table[j, W1]
        if part == 0:
            c0 = first if j == j0 else side(table, j, a, x, y, u, v)
            c1 = last if j == j1 else side(table, j + 1, a, x, y, u, v)
            w = guess(table, j, left, right, c0, c1, u, v)
        else:
            m = min(max(panel_where_slope_is(table, j, u1, v1), left), right)
            px, py, _slope, _rate = offset_point(table, j, a, m)
            c = u1 * (py - y1) - v1 * (px - x1)
            if part < 0:
                if c < 0.0:
                    return NEVER
                right = m
                w = 0.5 * (left + right)
            else:
                if c >= 0.0:
                    if c > near * math.sqrt(squared):
                        return NEVER
                    along: float = u1 * (px - x1) + v1 * (py - y1)
                    return along / squared
                left = m
                w = right
        # (a root at a node may lie beyond it by rounding)
        time: float = panel_crossing(table, j, a, x1, y1, u1, v1, left - beyond, right + beyond, w) / squared
        return time

    return line_time


@hot_kernel
def _at_node(panels: Any, j: int, _a: float, x: float, y: float, u: float, v: float) -> float:
    """Return c at a node."""
    c: float = u * (panels[j, Y] - y) - v * (panels[j, X] - x)
    return c


@hot_kernel
def _guess(panels: Any, j: int, low: float, high: float, c0: float, c1: float, u: float, v: float) -> float:
    """Return roughly w of the root of c in a panel: xi as a cubic in c, by its values and slopes at the nodes."""
    tx0, ty0, tx1, ty1 = panels[j, TX], panels[j, TY], panels[j + 1, TX], panels[j + 1, TY]
    ex, ey = panels[j, CX], panels[j, CY]
    rise, length = c1 - c0, panels[j, LAST_XI] - panels[j, FIRST_XI]
    z = -c0 / rise
    # d xi/d c = T.e/(v x T)
    p = rise * (tx0 * ex + ty0 * ey) / (length * (u * ty0 - v * tx0))
    q = rise * (tx1 * ex + ty1 * ey) / (length * (u * ty1 - v * tx1))
    share = z
    if 0.0 < p < 2.0 and 0.0 < q < 2.0:
        share = z * ((1.0 - z) * ((1.0 - z) * p - z * q) + z * (3.0 - 2.0 * z))
    w: float = low + (high - low) * share
    return w


_line_time = line_times(_at_node, _guess, 0.0)


@kernel
def curve_line(
    panels: Any, first: int, last: int, a: float, near: float, x: float, y: float, u: float, v: float
) -> float:
    """Return when a point on a line leaves through the arc between the nodes of two rows: see :func:`line_times`."""
    begins = u * panels[first, TY] - v * panels[first, TX] > 0.0
    ends = u * panels[last, TY] - v * panels[last, TX] > 0.0
    if not begins and not ends:
        return NEVER
    return _line_time(
        panels, first, panels[first, W0], last - 1, panels[last - 1, W1], begins, ends, _at_node(panels, first, a, x, y, u, v),
        _at_node(panels, last, a, x, y, u, v), a, near, x, y, u, v,
    )  # fmt: skip


# --- a place on the curve -----------------------------------------------------------------------------------------------------


@kernel
def _foot(panels: Any, j: int, a: float, x: float, y: float, w: float) -> float:
    """Return w of the foot of the normal through a place of the chord's frame near the parallel curve; Newton from w."""
    h = panels[j, HALF]
    for _ in range(8):
        f, f1, f2 = curve_graph(panels, j, w)
        dx, dy = x - h * (1.0 + w), y - f
        rate = 1.0 + f1 * f1 - f2 * dy
        step = (dx + f1 * dy) / (h * rate)
        w = w + step
        if abs(step) <= CLOSE:
            return w
    return w


@kernel
def curve_wall(
    panels: Any, first: int, last: int, a: float, dx: float, dy: float, x: float, y: float
) -> tuple[float, float, float]:
    """Return the normal towards the ball, and the wall's curvature, for a centre at (x, y) on an arc.

    (dx, dy): a direction with which all tangents of the arc make an angle below pi/2.
    """
    # positions along that direction grow along the arc
    place = dx * x + dy * y
    count = last - first
    while count > 1:
        half = count // 2
        first = first + (half if dx * panels[first + half, X] + dy * panels[first + half, Y] <= place else 0)
        count = count - half
    ex, ey, h = panels[first, CX], panels[first, CY], panels[first, HALF]
    px, py = x - panels[first, OX], y - panels[first, OY]
    xi, eta = ex * px + ey * py, ex * py - ey * px
    w = xi / h - 1.0
    if a > 0.0:
        w = _foot(panels, first, a, xi, eta, w)
    _f, f1, f2 = curve_graph(panels, first, w)
    q = 1.0 / math.sqrt(1.0 + f1 * f1)
    nx, ny = -f1 * q, q
    return nx * ex - ny * ey, nx * ey + ny * ex, f2 * (q * q * q)


# ----------------------------------------------------------------------------------------------------
# Cut a smooth curve into panels: graphs over their chords, polynomials whose second derivative has the curve's exact curvature.


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
    """Return the curvature (N) at parameters (N); positive where the curve turns to the left, NaN or infinite at a cusp."""
    _x, d, dd = at(t)
    with np.errstate(divide="ignore", invalid="ignore"):
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


# ----------------------------------------------------------------------------------------------------
# When a point on a parabola meets a smooth curve: the panels of :mod:`carom.core.geometry.curve` one by one.
#
# Over a panel's chord the parallel curve is a graph eta = F(xi). The times at which the point is above or below the panel follow
# from quadratics; in each such stretch the gap G(s) = eta(s) - F(xi(s)) has |G''| <= pull = |eta''| + |F'| |xi''| + |F''| xi'^2.


OVERLAP = 1e-13  # of a panel's length: so much beyond its ends still belongs to it
ROUNDING = 32.0  # times a gap that is rounding: by so much may the nodes' function be wrong
SLOW = 1e-14  # approach that counts as rounding, relative to the speed


@kernel
def graph_at(panels: Any, j: int, a: float, xi: float) -> tuple[float, float]:
    """Return F and F' of a panel's parallel curve at xi."""
    h = panels[j, HALF]
    w = xi / h - 1.0
    if a == 0.0:
        _xi, eta, slope, _rate = offset_point(panels, j, a, w)
        return eta, slope
    low, high = panels[j, W0], panels[j, W1]
    x0, x1 = panels[j, FIRST_XI], panels[j, LAST_XI]
    w = low + (high - low) * ((xi - x0) / (x1 - x0))
    margin = 1e-9 * (high - low)
    low, high = low - margin, high + margin
    px, eta, slope, rate = xi, 0.0, 0.0, 1.0
    for _ in range(100):
        px, eta, slope, rate = offset_point(panels, j, a, w)
        off = px - xi
        if off > 0.0:
            high = w
        else:
            low = w
        new = w - off / rate if rate > 0.0 else NEVER
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - w) <= CLOSE:
            return eta - off * slope, slope
        w = new
    return eta, slope


@kernel
def _gap(path: Any, s: float) -> tuple[float, float]:
    """Return the gap at a time s, and its rate, in the chord's frame; (g, h): the acceleration."""
    panels, j, a, x, y, u, v, g, h = path
    eta, slope = graph_at(panels, j, a, x + (u + 0.5 * g * s) * s)
    return y + (v + 0.5 * h * s) * s - eta, v + h * s - slope * (u + g * s)


_fall, _leave = searches(_gap)


@kernel
def _first_fall(
    panels: Any, j: int, a: float, near: float, tiny: float, slow: float,
    x: float, y: float, u: float, v: float, g: float, h: float, s0: float, end: float,
) -> float:  # fmt: skip
    """Return the first time between s0 and the end at which the gap falls through zero, or infinity."""
    path = (panels, j, a, x, y, u, v, g, h)
    g0, u0 = _gap(path, s0)
    if g0 < -near:
        return NEVER  # behind the wall: it has left the interior before, or is in another part of it
    if g0 <= near and u0 < -slow:
        return s0
    fast = max(abs(u + g * s0), abs(u + g * end))
    pull = abs(h) + panels[j, SLOPE] * abs(g) + panels[j, BEND] * fast * fast
    # G >= g0 + u0 t - pull t^2/2, which is least at one of the ends
    rest = end - s0
    if g0 + (u0 - 0.5 * pull * rest) * rest > near:
        return NEVER
    if g0 <= near:
        # it touches: on to where the gap is more than rounding
        s0, g0, u0, out = _leave(path, s0, end, max(tiny, u0 / pull) if pull > 0.0 else tiny, near, 1.0)
        if not out:
            return s0
    return _fall(path, s0, g0, u0, end, end, pull, pull, tiny)


@hot_kernel
def _reaches(d: float, u: float, h: float, after_turn: bool) -> float:
    """Return when d + u s + h s^2 is zero before its turn (or where it has none ahead), or after it; infinity where it is not."""
    inside = u * u - 4.0 * h * d
    if inside < 0.0:
        return NEVER
    root = math.sqrt(inside)
    q = -0.5 * (u + root) if u > 0.0 or (u == 0.0 and h > 0.0) else -0.5 * (u - root)
    if after_turn:
        return q / h
    return d / q if q != 0.0 else NEVER


@kernel
def _in_panel(
    panels: Any, j: int, a: float, near: float, tiny: float, slow: float,
    x: float, y: float, u: float, v: float, g: float, h: float, most: float,
) -> float:  # fmt: skip
    """Return the first time within ``most`` at which a point, in the chord's frame, meets a panel from above; or infinity."""
    high, low = panels[j, HIGH] + near, panels[j, LOW] - near
    if y > high and v >= 0.0 and h >= 0.0:
        return NEVER
    first, last = panels[j, FIRST_XI], panels[j, LAST_XI]
    margin = OVERLAP * (last - first)
    first, last = first - margin, last + margin
    g2, h2 = 0.5 * g, 0.5 * h
    turns = u * g < 0.0
    way = u if u != 0.0 else g
    begin, stop = 0.0, -u / g if turns else NEVER
    for part in range(2):
        if part == 1:
            if not turns:
                return NEVER
            begin, stop, way = stop, NEVER, -way
        if begin >= most:
            return NEVER
        xi = x + (u + g2 * begin) * begin
        far, close = (last, first) if way > 0.0 else (first, last)
        into = begin
        if (xi < first and way > 0.0) or (xi > last and way < 0.0):
            into = max(_reaches(x - close, u, g2, part == 1), begin)
        elif not first <= xi <= last:
            continue
        out = min(stop, most)
        if way != 0.0:
            out = min(out, max(_reaches(x - far, u, g2, part == 1), begin))
        if into >= out:
            continue
        # the heights in between
        eta, eta1 = y + (v + h2 * into) * into, y + (v + h2 * out) * out
        least = min(eta, eta1)
        rate = v + h * into
        if h > 0.0 and rate < 0.0 and v + h * out > 0.0:
            least = y - v * v / (2.0 * h)
        if eta < low or least > high:
            continue
        # below all of the panel it has met it
        if h < 0.0 or v < 0.0:
            down = _reaches(y - low, v, h2, v > 0.0)
            if into < down < out:
                out = down
        t = _first_fall(panels, j, a, near, tiny, slow, x, y, u, v, g, h, into, out)
        if t < NEVER:
            return t
    return NEVER


@kernel
def _leaves(size: float, x: float, u: float, g: float) -> float:
    """Return a time after which x + u s + g s^2/2 stays beyond -size and size, or beyond one of them for the first time."""
    g2, far = 0.5 * g, 1.001 * size
    up = u > 0.0 or (u == 0.0 and g > 0.0)
    if u == 0.0 and g == 0.0:
        return NEVER
    side = far if up else -far
    time = _reaches(x - side, u, g2, False)
    if time < NEVER or u * g >= 0.0:
        return max(time, 0.0)
    # it turns before, and leaves on the other side
    return max(_reaches(x + side, u, g2, True), 0.0)


@kernel
def flight_end(size: float, x: float, y: float, u: float, v: float, gx: float, gy: float) -> float:
    """Return a time after which a point on a parabola is outside a table of that size; infinity where it stays at rest."""
    return min(_leaves(size, x, u, gx), _leaves(size, y, v, gy))


@kernel
def curve_parabola(
    panels: Any, first: int, last: int, a: float, size: float, near: float,
    x: float, y: float, u: float, v: float, gx: float, gy: float, most: float,
) -> float:  # fmt: skip
    """Return the time within ``most`` at which a point on a parabola leaves through an arc; infinity where it does not.

    ``size``: of the table, m; ``near``: a gap that is rounding, m.

    A point d = v s + g s^2/2 from the start has v x g s = d x g, so that on the whole parabola, before the start and after it,
    F = 2 (v x g) (v x d) - (d x g)^2 is zero. Along the chord of two nodes F is concave; a panel lies as near to it as its bounds
    say. Where F has one sign at both nodes and is further from zero than that, the parabola does not meet the panel.
    """
    speed, pull = math.sqrt(u * u + v * v), math.sqrt(gx * gx + gy * gy)
    if most == NEVER:
        return NEVER
    tiny = near / (speed + pull * most)
    # without an acceleration F = v x d
    side = 2.0 * (u * gy - v * gx) if pull > 0.0 else 1.0
    turn = abs(side) * speed
    noise = ROUNDING * near * (pull * (speed * speed + pull * size) if pull > 0.0 else speed)
    best = NEVER
    dx, dy = panels[first, X] - x, panels[first, X + 1] - y
    across = dx * gy - dy * gx
    before = side * (u * dy - v * dx) - across * across
    for j in range(first, last):
        dx, dy = panels[j + 1, X] - x, panels[j + 1, X + 1] - y
        passed = pull * abs(across)
        across = dx * gy - dy * gx
        after = side * (u * dy - v * dx) - across * across
        f0, f1 = before, after
        before = after
        if f0 * f1 > 0.0:
            deep = panels[j, HIGH] - panels[j, LOW]
            width = pull * (panels[j, LAST_XI] - panels[j, FIRST_XI] + deep)
            if min(abs(f0), abs(f1)) > deep * (turn + 2.0 * (passed + pull * width)) + 0.25 * width * width + noise:
                continue
        ex, ey = panels[j, CX], panels[j, CX + 1]
        dx, dy = x - panels[j, OX], y - panels[j, OX + 1]
        t = _in_panel(
            panels, j, a, near, tiny, SLOW * speed, ex * dx + ey * dy, ex * dy - ey * dx, ex * u + ey * v, ex * v - ey * u,
            ex * gx + ey * gy, ex * gy - ey * gx, min(best, most),
        )  # fmt: skip
        best = min(best, t)
    return best
