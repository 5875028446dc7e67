"""Features of walls that a ball can touch (faces, lines, points, rims), each with the polynomial of its gap.

Every wall is made of features. A feature is a core (a plane, a line, a point) and a distance R from it: a box has faces
(planes), edges (lines, R = 0) and corners (points, R = 0); a cylinder is a line with R > 0, a sphere a point with R > 0,
and a ball may be outside (side +1) or inside (side -1). A ball of radius a touches where its centre is R + side a from
the core. Between events its centre moves on x + v s + acc s^2/2, so the gap is a polynomial in s: of degree 2 for a plane,
and, as the square of the distance, of degree 4 for lines and points. A rim is a circle of radius R, in touch with balls whose
centres are a from it; its gap is of degree 8 (:mod:`carom.core.geometry.circles`).

A thin wall is two faces back to back. The faces of a wall end at its edges, which are features of their own: the centre of
a ball comes in over exactly one of them, and over both, with one normal, where they join.

"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.core.geometry.circles import call_rim, rim_gap, rim_gap_derivatives, rim_normal
from carom.core.geometry.curve_arcs import curve_bend, curve_depth, curve_gap, curve_hit, curve_is_far, curve_normal
from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel, vector
from carom.core.roots import hit2, hit4, next_hit4

# Kinds. OVER is no wall: it is the upward continuation of a low one, and a ball whose centre passes it has cleared it; of a
# round one, with R > 0. Faces come before what is round, so that one comparison tells them apart. CURVE is an upright arc of a
# smooth curve (carom.core.geometry.curve_arcs): p is its origin, u its x axis; d and R are a circle around the arc.
FACE, OVER, LINE, POINT, RIM, CURVE = range(6)
# What becomes of a ball whose centre passes a gate, an OVER: it goes on; it has left, and is followed no further; or the gate is
# the edge of a pocket, into which it falls.
GOES_ON, LEAVES, FALLS = range(3)

FEATURES = np.dtype(
    [
        ("kind", "i8"),
        ("p", "f8", (3,)),  # a point of the core
        ("d", "f8", (3,)),  # the unit normal of a face (towards its balls), the unit direction of a line
        ("R", "f8"),  # of a face: where it is a disc
        ("side", "f8"),  # +1 outside, -1 inside (faces: +1)
        ("u", "f8", (3,)),  # unit, perpendicular to d: the first direction along a face; the middle of an arc
        ("lo1", "f8"),  # extent of a face along u; of an arc, lo1 is the cosine of half its angle (-1: all round)
        ("hi1", "f8"),
        ("lo2", "f8"),  # extent of a face along d x u, of a line along d
        ("hi2", "f8"),
        # the wall it belongs to, with its surface and its law (carom.simulation.records)
        ("wall", "i8"),
        ("form", "i8"),
        ("e", "f8", (3,)),
        ("mu", "f8"),
        ("beta", "f8"),
        ("contact_time", "f8"),  # s
        ("yield_time", "f8"),  # s: how deep the ball turns, over its speed of approach (carom.core.geometry.features)
        ("law", "i8"),
        ("ends", "i8"),  # GOES_ON, LEAVES or FALLS
        (
            "at",
            "i8",
        ),  # of a rim, and of a curve: the address of their kernels; of a pocket: its number in the scene
    ]
)
# Seams: a feature reaches this share of the ball's radius over its ends, so that no ball slips in between two.
SEAM = 1e-9
# A gap more negative than this share of the radius is none: the ball is behind a face, or past the end of a line.
BEHIND = 1e-3
# An edge or a corner ends a face, and a ball that moves along the face passes it without touching it; what rounding makes
# of that is a graze, no deeper than this share of the radius.
GRAZE = 1e-12
# Below this share of its size an acceleration along a wall is the rounding of one that only moves along it.
LEVEL = 1e-15


@kernel
def _within(f: Any, x: Vec, a: float, error: float = 0.0) -> bool:
    """Whether the contact of a ball centred at x, or within ``error`` of it, lies on the feature and not beyond its ends."""
    if f.kind == POINT:
        return True
    p, d, u = vector(f.p), vector(f.d), vector(f.u)
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    seam = SEAM * a + error
    along = dot(r, d)
    if f.kind >= LINE or (f.kind == OVER and f.R > 0):
        if f.kind != RIM and not f.lo2 - seam <= along <= f.hi2 + seam:
            return False
        cosine = f.lo1
        if cosine <= -1:
            return True
        across = (r[0] - along * d[0], r[1] - along * d[1], r[2] - along * d[2])
        return bool(dot(across, u) >= (cosine - SEAM) * math.sqrt(dot(across, across)) - error)
    first, second = dot(r, u), dot(r, cross(d, u))
    if f.R > 0:
        return bool(first * first + second * second <= (f.R + seam) * (f.R + seam))
    return bool(f.lo1 - seam <= first <= f.hi1 + seam and f.lo2 - seam <= second <= f.hi2 + seam)


@hot_kernel
def _component(d: Vec, acc: Vec) -> float:
    """d . acc, without what is only rounding: the sign of that must not press a ball on a wall that it rolls along."""
    c = dot(d, acc)
    return c if c * c > LEVEL * LEVEL * (dot(acc, acc) * dot(d, d)) else 0 * c


@hot_kernel
def never_closes(c1: float, c2: float, c3: float, c4: float, until: float, tol: float) -> bool:
    """Whether the gap c1 s + ... + c4 s^4 never closes faster than tol up to s = until: of one in touch, no approach."""
    s = until
    least = c1 + (2 * c2 * s if c2 < 0 else 0 * c1)
    least += (3 * c3 * s * s if c3 < 0 else 0 * c1) + (4 * c4 * s * s * s if c4 < 0 else 0 * c1)
    return bool(least >= -tol)


@hot_kernel
def _place_after(x: Vec, v: Vec, acc: Vec, s: float) -> Vec:
    h = s * s / 2
    return (x[0] + v[0] * s + acc[0] * h, x[1] + v[1] * s + acc[1] * h, x[2] + v[2] * s + acc[2] * h)


@kernel
def _face_hit(f: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float, error: float) -> float:
    p, d = vector(f.p), vector(f.d)
    reach = (a if f.kind == FACE else 0 * a) + error  # what has been cleared is cleared by the centre
    c0 = d[0] * (x[0] - p[0]) + d[1] * (x[1] - p[1]) + d[2] * (x[2] - p[2]) - reach
    c1, c2 = dot(d, v), _component(d, acc) / 2
    if c0 <= SEAM * a and never_closes(c1, c2, 0 * a, 0 * a, until, slow):
        return math.inf
    if c0 < -BEHIND * a and not c1 > 0:
        return math.inf
    s = hit2(c0, c1, c2, until, slow)
    if not s <= until or c0 + (c1 + c2 * s) * s < -BEHIND * a:
        return math.inf
    if f.kind == OVER and s == 0:  # it stands in the gate, having just come through
        return math.inf
    return s if _within(f, _place_after(x, v, acc, s), a, error) else math.inf


@kernel
def _round_hit(f: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float, error: float) -> float:
    p, side = vector(f.p), f.side
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    if f.kind != POINT:  # only what is across the line counts
        d = vector(f.d)
        c = dot(r, d)
        r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
        c = dot(v, d)
        v1 = (v[0] - c * d[0], v[1] - c * d[1], v[2] - c * d[2])
        c = dot(acc, d)
        b = (acc[0] - c * d[0], acc[1] - c * d[1], acc[2] - c * d[2])
    else:
        v1, b = v, acc
    reach = f.R + side * (a + error) if f.kind != OVER else f.R + side * error
    far = math.sqrt(dot(r, r))
    # |r + v s + b s^2/2|^2 - reach^2, outside; the other way round inside
    c0, c1 = side * (far - reach) * (far + reach), side * 2 * dot(r, v1)
    c2, c3, c4 = side * (dot(v1, v1) + _component(r, b)), side * dot(v1, b), side * dot(b, b) / 4
    deep = -BEHIND * a * 2 * reach
    if c0 <= 2 * reach * SEAM * a and never_closes(c1, c2, c3, c4, until, 2 * reach * slow):
        return math.inf
    if c0 < deep and c1 <= 0:  # noqa: SIM108  (two long calls)
        s = next_hit4(c0, c1, c2, c3, c4, 0 * a, until)
    else:
        s = hit4(c0, c1, c2, c3, c4, until, 2 * reach * slow)
    if f.kind == OVER and s == 0 and f.ends != FALLS:  # it stands in the gate, having just come through
        s = next_hit4(c0, c1, c2, c3, c4, 0 * a, until)
    for _ in range(2):
        if s == math.inf or not s <= until:  # (where until is infinite too, a later hit would be sought)
            break
        on = c0 + (c1 + (c2 + (c3 + c4 * s) * s) * s) * s >= deep
        if on and _within(f, _place_after(x, v, acc, s), a, error):
            # the gap falls at the rate u, and what is across turns it round: how deep it would come
            u = c1 + (2 * c2 + (3 * c3 + 4 * c4 * s) * s) * s
            bend = 2 * c2 + (6 * c3 + 12 * c4 * s) * s
            if f.R > 0 or not u * u <= 2 * bend * (2 * reach * GRAZE * a):
                return s
        s = next_hit4(c0, c1, c2, c3, c4, s, until)
    return math.inf


@kernel
def time_to_end(f: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float) -> float:
    """Time in [0, until] at which a ball that moves along a line, or a face with straight edges, is past its end, or infinity."""
    p, d, u, first = vector(f.p), vector(f.d), vector(f.u), math.inf + 0 * a
    for k in range(4):
        e = d if f.kind == LINE else u if k < 2 else cross(d, u)
        low, high = (f.lo1, f.hi1) if f.kind == FACE and k < 2 else (f.lo2, f.hi2)
        side = 1 if k in (0, 2) else -1
        room = 2 * SEAM * a + (dot(x, e) - dot(p, e) - low if side > 0 else high - dot(x, e) + dot(p, e))
        if room < math.inf:
            first = min(first, hit2(room, side * dot(v, e), side * dot(acc, e) / 2, until, 0 * a))
    return first


@hot_kernel
def feature_hit(f: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float, error: float = 0.0) -> float:
    """Time in [0, until] at which a ball touches feature f, or infinity.

    ``slow`` is the speed of approach below which a ball in touch is not coming in: the rounding of one that moves along. With an
    ``error``, the distance by which its path may differ from the parabola, no contact is later than the time found.
    """
    kind = f.kind
    if kind == RIM:
        return call_rim(f.at, vector(f.p), vector(f.d), f.R, vector(f.u), f.lo1, a + error, x, v, acc, until, slow)
    if kind == CURVE:
        return curve_hit(f, a + error, x, v, acc, until, slow)
    if kind >= LINE or (kind == OVER and f.R > 0):
        return _round_hit(f, a, x, v, acc, until, slow, error)
    return _face_hit(f, a, x, v, acc, until, slow, error)


@kernel
def contact_normal(f: Any, x: Vec, v: Vec) -> Vec:
    """Unit normal of feature f, towards the ball, where one centred at x, that moves with v, touches it."""
    kind = f.kind
    d = vector(f.d)
    if kind < LINE:
        return d
    if kind == RIM:
        return rim_normal(vector(f.p), d, f.R, x, v)
    if kind == CURVE:
        return curve_normal(f, x)
    p, side = vector(f.p), f.side
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    if kind == LINE:
        c = dot(r, d)
        r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
    size = math.sqrt(dot(r, r))
    if not size > 0:
        return vector(f.u)
    c = side / size
    return (c * r[0], c * r[1], c * r[2])


@kernel
def feature_normal(f: Any, x: Vec) -> Vec:
    """Unit normal of feature f at a ball that does not move (:func:`contact_normal`)."""
    zero = 0 * x[0]
    return contact_normal(f, x, (zero, zero, zero))


@kernel
def gap_to_feature(f: Any, a: float, x: Vec) -> float:
    """Gap between feature f and a ball at x; negative where it overlaps, infinite where it is past the ends.

    Below -a it is behind a face, or outside of a hollow: what it would touch there is another feature.
    """
    kind = f.kind
    p, d, side = vector(f.p), vector(f.d), f.side
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    if kind == OVER:
        return math.inf
    if kind == CURVE:
        return curve_gap(f, a, x)
    if kind == FACE:
        gap = dot(r, d) - a
    elif kind == RIM:
        gap = rim_gap(p, d, f.R, x) - a
    else:
        if kind == LINE:
            c = dot(r, d)
            r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
        gap = side * (math.sqrt(dot(r, r)) - f.R) - a
    return gap if _within(f, x, a) else math.inf


@kernel
def is_out_of_reach(f: Any, a: float, x: Vec, way: float) -> bool:
    """Whether a ball at x that comes no further than ``way`` cannot touch feature f, wherever that ends: a quick test."""
    p, d = vector(f.p), vector(f.d)
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    way = way + SEAM * (way + a)
    if f.kind == FACE:
        gap = dot(r, d) - a
        return bool(gap > way or gap < -BEHIND * a - way)
    if f.kind == RIM:
        return bool(rim_gap(p, d, f.R, x) - a > way)
    if f.kind == CURVE:
        return curve_is_far(f, a, x, way)
    c = dot(r, d) if f.kind != POINT else 0 * a
    far = math.sqrt(max(dot(r, r) - c * c, 0 * a))
    if f.kind == OVER:
        return bool(f.R > 0 and abs(far - f.R) > way)
    return bool(f.side * (far - f.R) - a > way)


@kernel
def pocket_distance(f: Any, x: Vec) -> float:
    """Distance of the centre x of a ball from the edge of pocket f, as seen from above; negative over it."""
    p = vector(f.p)
    far = math.sqrt((x[0] - p[0]) * (x[0] - p[0]) + (x[1] - p[1]) * (x[1] - p[1]))
    return float(far - f.R)


@kernel
def gap_derivatives(f: Any, x: Vec, v: Vec, acc: Vec) -> tuple[float, float]:
    """First and second derivative of the gap of a ball in touch with feature f."""
    if f.kind == RIM:
        return rim_gap_derivatives(vector(f.p), vector(f.d), f.R, x, v, acc)
    n = contact_normal(f, x, v)
    speed = dot(v, n)
    bend = _component(n, acc)
    kind = f.kind
    if kind == CURVE:
        bend += curve_bend(f, x, v)
    elif kind >= LINE:
        p, side = vector(f.p), f.side
        r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
        t = (v[0] - speed * n[0], v[1] - speed * n[1], v[2] - speed * n[2])
        if kind == LINE:
            d = vector(f.d)
            c = dot(r, d)
            r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
            c = dot(t, d)
            t = (t[0] - c * d[0], t[1] - c * d[1], t[2] - c * d[2])
        bend += side * dot(t, t) / math.sqrt(dot(r, r))
    return speed, bend


# ----------------------------------------------------------------------------------------------------
# The gap between a ball and the object that it meets, as a kernel: its derivative gives the derivative of the event's time.
#
# A wall may yield: contact, an impact at one instant, is where the ball is deeper than the wall's place by the yield time c times
# the speed of approach. A linear spring with a dashpot, which a ball touches for the time T and leaves with the share e of its
# speed, takes and returns it as if it had turned at once at the depth c v_n, c = e T / (1 + e): there the lines before and after
# meet.


MOST_ROUNDS = 7  # of Newton's steps, of second order
DEEPEST = 0.5  # of the radius: a ball gets no deeper into a wall that yields


@kernel
def feature_gap(f: Any, a: float, x: Vec) -> float:
    """Return the gap between feature f, continued over its ends, and a ball of radius a at x; of a gate, of its centre."""
    p, d = vector(f.p), vector(f.d)
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    if f.kind == RIM:
        return rim_gap(p, d, f.R, x) - a
    if f.kind == CURVE:
        return curve_depth(f, x) - a
    if f.kind < LINE and not (f.kind == OVER and f.R > 0):
        return dot(r, d) - (0.0 if f.kind == OVER else a)
    if f.kind != POINT:
        c = dot(r, d)
        r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
    return f.side * (math.sqrt(dot(r, r)) - f.R) - (0.0 if f.kind == OVER else a)  # type: ignore[no-any-return]


@kernel
def feature_gap_rate(f: Any, x: Vec, v: Vec) -> float:
    """Return the rate at which that gap changes."""
    if f.kind == OVER and f.R > 0:
        p, d = vector(f.p), vector(f.d)
        r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
        c = dot(r, d)
        r = (r[0] - c * d[0], r[1] - c * d[1], r[2] - c * d[2])
        return f.side * dot(r, v) / math.sqrt(dot(r, r))  # type: ignore[no-any-return]
    return dot(contact_normal(f, x, v), v)


@kernel
def contact_gap(f: Any, a: float, gap: float, rate: float) -> float:
    """Return how far a ball is from the contact with a feature that yields, by its gap and the rate at which that changes."""
    return float(gap + min(f.yield_time * max(-rate, 0 * rate), DEEPEST * a))


@kernel
def contact_gap_rate(f: Any, a: float, rate: float, bend: float) -> float:
    """Return the rate at which that changes, by the first and second derivative of the gap."""
    c = f.yield_time if rate < 0 and -f.yield_time * rate < DEEPEST * a else 0 * a
    return float(rate - c * bend)


@kernel
def least_gap(f: Any, a: float) -> float:
    """Return the least gap at which a ball is in front of a feature: a ball in a wall that yields is."""
    return -(BEHIND + DEEPEST) * a if f.yield_time > 0 else -BEHIND * a


@kernel
def impact_normal(f: Any, a: float, x: Vec, v: Vec) -> Vec:
    """Return the unit normal at which a ball of radius a at x strikes feature f.

    A wall that yields moves along the floor with the ball, so that they touch as they did at first: over a nose the normal is that
    of a ball moved back, level, to where it touches.
    """
    n = contact_normal(f, x, v)
    if f.yield_time > 0:
        for _ in range(MOST_ROUNDS):
            level = n[0] * n[0] + n[1] * n[1]
            if not level > 0:
                break
            c = -feature_gap(f, a, x) / level
            x = (x[0] + c * n[0], x[1] + c * n[1], x[2])
            n = contact_normal(f, x, v)
    return n


@kernel
def pair_gap(x: Vec, y: Vec, reach: float) -> float:
    """Return the gap between two balls whose radii add up to ``reach``."""
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    return math.sqrt(dot(r, r)) - reach
