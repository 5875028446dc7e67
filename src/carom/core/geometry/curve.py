"""A smooth curve as a wall: when a point on a straight line or a parabola meets it, its normal, its curvature.

The wall E is cut into panels. Over its chord, of length 2 h, each is a graph eta = f(xi) with xi = h (1 + w), -1 <= w <= 1, and f a
polynomial in w (:mod:`carom.core.geometry.panels` makes them). The interior lies on the left. The centre of a ball of radius a is
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
it has one root; every other stretch is halved (:mod:`carom.core.geometry.curve_parabola`).
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import hot_kernel, kernel

__all__ = [
    "BEND", "COEFFICIENTS", "CX", "DEGREE", "FIRST_XI", "HALF", "HIGH", "LAST_XI", "LOW", "OX", "ROW", "SLOPE", "TX", "W0", "W1",
    "X", "curve_graph", "curve_line", "curve_wall", "offset_point", "panel_crossing", "panel_where_slope_is",
]  # fmt: skip

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
def _at_node(panels: Any, j: int, x: float, y: float, u: float, v: float) -> float:
    """Return c at a node."""
    c: float = u * (panels[j, Y] - y) - v * (panels[j, X] - x)
    return c


@hot_kernel
def _rising_between(panels: Any, first: int, last: int, x: float, y: float, u: float, v: float) -> int:
    """Return the panel in which c rises through zero, between nodes where it is negative and where it is not."""
    count = last - first
    while count > 1:
        half = count // 2
        # (a choice between numbers, for which the processor need not guess)
        first = first + (half if _at_node(panels, first + half, x, y, u, v) < 0.0 else 0)
        count = count - half
    return first


@hot_kernel
def _turn_between(panels: Any, first: int, last: int, u: float, v: float, sign: float) -> int:
    """Return the panel in which v x T changes its sign, between nodes where ``sign`` times it is above zero and where it is not."""
    u, v = sign * u, sign * v
    count = last - first
    while count > 1:
        half = count // 2
        first = first + (half if u * panels[first + half, TY] - v * panels[first + half, TX] > 0.0 else 0)
        count = count - half
    return first


@hot_kernel
def _guess(panels: Any, j: int, c0: float, c1: float, u: float, v: float) -> float:
    """Return roughly w of the root of c in a panel: xi as a cubic in c, by its values and slopes at the nodes."""
    low, high = panels[j, W0], panels[j, W1]
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


@kernel
def curve_line(  # noqa: PLR0911  (one return per outcome)
    panels: Any, first: int, last: int, a: float, near: float, x: float, y: float, u: float, v: float
) -> float:
    """Return the time at which a point on a straight line leaves through an arc, possibly negative; infinity where it does not.

    ``first`` and ``last``: rows of the arc's first and last nodes. A graze whose depth is below ``near`` (m) counts where the curve
    bends towards the line from both sides, as it does at the start of a flight along the wall.
    """
    begins = u * panels[first, TY] - v * panels[first, TX] > 0.0
    ends = u * panels[last, TY] - v * panels[last, TX] > 0.0
    if not begins and not ends:
        return NEVER
    j, part = -1, 0
    if begins and ends:
        if _at_node(panels, first, x, y, u, v) < 0.0 <= _at_node(panels, last, x, y, u, v):
            j = _rising_between(panels, first, last, x, y, u, v)
    elif ends:
        # c falls to its least value in the panel k, and rises from there
        if _at_node(panels, last, x, y, u, v) < 0.0:
            return NEVER
        k = _turn_between(panels, first, last, u, v, -1.0)
        if _at_node(panels, k + 1, x, y, u, v) < 0.0:
            j = _rising_between(panels, k + 1, last, x, y, u, v)
        else:
            j, part = k, 0 if _at_node(panels, k, x, y, u, v) < 0.0 else 1
    else:
        # c rises to its greatest value in the panel k, and falls from there
        if _at_node(panels, first, x, y, u, v) >= 0.0:
            return NEVER
        k = _turn_between(panels, first, last, u, v, 1.0)
        if _at_node(panels, k, x, y, u, v) >= 0.0:
            j = _rising_between(panels, first, k, x, y, u, v)
        else:
            j, part = k, 0 if _at_node(panels, k + 1, x, y, u, v) >= 0.0 else -1
    if j < 0:
        return NEVER
    # in the chord's frame
    ex, ey = panels[j, CX], panels[j, CY]
    dx, dy = x - panels[j, OX], y - panels[j, OY]
    x1, y1, u1, v1 = ex * dx + ey * dy, ex * dy - ey * dx, ex * u + ey * v, ex * v - ey * u
    squared = u * u + v * v
    low, high = panels[j, W0], panels[j, W1]
    if part != 0:
        m = panel_where_slope_is(panels, j, u1, v1)
        px, py, _slope, _rate = offset_point(panels, j, a, m)
        c = u1 * (py - y1) - v1 * (px - x1)
        if part < 0:
            if c < 0.0:
                return NEVER
            high = m
            w = 0.5 * (low + high)
        else:
            if c >= 0.0:
                if c > near * math.sqrt(squared):
                    return NEVER
                along: float = u1 * (px - x1) + v1 * (py - y1)
                return along / squared
            low = m
            w = high
    else:
        w = _guess(panels, j, _at_node(panels, j, x, y, u, v), _at_node(panels, j + 1, x, y, u, v), u, v)
    time: float = panel_crossing(panels, j, a, x1, y1, u1, v1, low, high, w) / squared
    return time


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
