"""Find the next piece of the boundary that a flying ball meets, and the wall's normal there.

A single ball needs no event queue: its next event is the nearest of the table's pieces. All pieces bound the ball's centre.

Where no force acts across the walls, the flight is met as a straight line: linear for a face, quadratic for a circle, a sphere, an
ellipse. Under a force across walls it is a parabola; its roots, of degree 2 (faces) or 4 (curved pieces), are those of
:mod:`carom.core.roots`, which find the first of them, and a crossing outside the ends of a piece is skipped for the next
one. Smooth curves, with a table of ``panels``, are in :mod:`carom.core.geometry.curve`. In a magnetic field flights are arcs of
circles, in quarters of which u = tan(angle/2) goes from 0 to 1.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.core.geometry.circles import angle_of_tangent
from carom.core.geometry.curve import (
    BEND,
    CX,
    FIRST_XI,
    HIGH,
    LAST_XI,
    LOW,
    OX,
    SLOPE,
    curve_line,
    curve_parabola,
    curve_wall,
    flight_end,
    graph_at,
)
from carom.core.jit.kernel import Vec, hot_kernel, kernel
from carom.core.roots import hit2, hit4, next_hit4, searches

# A piece of the boundary of the region open to the ball's CENTRE; fields of other kinds are zero.
PIECES = np.dtype(
    [
        # the normal of a face or a window, towards the ball; a direction along an arc of a smooth curve
        ("n", "f8", (3,)),
        # A face is at n.x = offset, from ``begin`` to ``end`` along the tangent (ny, -nx): the ball is on its left. ``low`` and
        # ``high`` are the ends that are corners, infinite where the boundary goes on smoothly.
        *((name, "f8") for name in ("offset", "begin", "end", "low", "high")),
        ("separation", "f8"),  # of a window from its twin
        # a circle or a sphere; of a circle only the half left (-1) or right (1) of the centre, or all of it (0)
        ("center", "f8", (2,)),
        *((name, "f8") for name in ("radius", "curvature", "half")),
        ("half_axes", "f8", (2,)),  # of an ellipse
        # of an arc: rows of its first and last nodes in the table of panels (:mod:`carom.core.geometry.curve`), and whether these
        # are corners
        *((name, "i8") for name in ("first", "last", "begins_in_corner", "ends_in_corner")),
    ]
)

# The table, the ball and the law. The pieces are sorted by kind: faces, windows (through which a ball passes into the next
# periodic cell), circles seen from inside, circles seen from outside, ellipses, smooth curves, spheres; each of the first seven
# fields is the index at which its kind ends.
BILLIARD = np.dtype(
    [
        *((name, "i8") for name in ("faces", "windows", "inside", "outside", "ellipses", "curves", "spheres")),
        ("finite_faces", "i8"),  # 1: hits beyond the ends of a face are ignored (a stadium, a table that is not convex)
        ("arc_corners", "i8"),  # 1: the centre's curve in an ellipse or a smooth curve has corners
        ("planar", "i8"),  # 1: the table lies in the plane
        ("corners", "i8"),  # 1: an orbit ends at a corner
        ("conservative", "i8"),  # 1: the law conserves the energy
        ("law", "i8"),
        ("user", "i8"),
        ("flight", "i8"),  # as which flights meet the walls: STRAIGHT, PARABOLA or ARC
        ("acceleration", "f8", (3,)),  # m/s^2
        ("magnetic_field", "f8"),  # angular velocity at which the velocity turns, rad/s
        ("a", "f8"),  # radius, m
        ("kappa", "f8"),  # I/(m a^2)
        ("e", "f8"),  # restitution
        ("mu", "f8"),  # friction
        ("beta", "f8"),  # tangential restitution
        ("corner_tolerance", "f8"),  # m: nearer than this to a corner, the corner is hit
        ("inset", "f8"),  # m: distance of the centre's curve from the ellipse or the smooth curve
        ("extent", "f8"),  # m: of the table
    ]
)

# A force along all walls leaves them the straight flights: it changes where they lead, not when they meet a wall.
STRAIGHT, PARABOLA, ARC = 0, 1, 2

# Why an orbit ended: an index into ENDS.
DONE, ESCAPED, CORNER, GRAZED, FREE = 0, 1, 2, 3, 4
# Why and where an orbit ended; ``piece`` (of the tangent map only) is the last one met, -1 for none.
ENDING = np.dtype([("reason", "i8"), ("bounces", "i8"), ("piece", "i8")])
# A ball whose numbers have derivatives.
BODY = np.dtype([(name, "f8", (3,)) for name in ("x", "v", "w")])
# Columns of a row of ten numbers that holds the time and the state of a ball.
TIME, POSITION, VELOCITY, SPIN = 0, slice(1, 4), slice(4, 7), slice(7, 10)
ENDS = (
    "bounces",
    "escaped",
    "corner",
    "grazed",
    "free",
)  # free: no bounce ahead in a periodic cell, or on a closed circle
MAX_EMPTY_CELLS = 1_000_000  # a flight through this many periodic cells counts as free


# ----------------------------------------------------------------------------------------------------
# Find the next piece of the boundary that a flying ball meets, and the wall's normal there.


NEVER = math.inf
FULL_CIRCLE = 4.0 + 1e-9  # quarters of a circle, and a margin for rounding
OVERLAP = 1e-13  # of a panel's length: so much beyond its ends still belongs to it
SLOW = 1e-14  # approach that counts as rounding, relative to the speed
NOISE = 2e-15  # of the table's size: so much of a distance from a smooth curve is rounding (a start on the wall is off by 7e-16)
CIRCLE_NOISE = 1e-14  # of the Larmor radius: rounding of distances from the circle's middle
BEHIND = 1e3  # times a distance that is rounding: so far beyond a wall a ball has not just met it
ON_THE_CIRCLE, ALONG_THE_CIRCLE = 1e-14, 1e-8  # squares, relative: a ball on a circle, and nearly tangent to it


# --- the path -------------------------------------------------------------------------------------------------------


@kernel
def _quarters(v: Vec, count: int, way: float) -> Vec:
    """Return a velocity after a number of quarters of the circle."""
    k = count % 4
    if k == 0:
        return v
    if k == 2:
        return (-v[0], -v[1], v[2])
    c = way if k == 1 else -way
    return (-c * v[1], c * v[0], v[2])


@kernel
def on_arc(field: float, x: Vec, v: Vec, s: float) -> tuple[Vec, Vec]:
    """Return position and velocity after a flight up to s."""
    way = 1.0 if field > 0.0 else -1.0
    size = abs(field)
    whole = math.floor(s)
    u = s - whole
    q = _quarters(v, int(whole), way)
    # whole quarters: x + K (v - q)/|W|
    x0, x1 = x[0] - way * (v[1] - q[1]) / size, x[1] + way * (v[0] - q[0]) / size
    d = 1.0 / (1.0 + u * u)
    f = 2.0 * u * d
    k0, k1 = -way * q[1], way * q[0]
    f0, f1 = f * (k0 - u * q[0]), f * (k1 - u * q[1])
    f = f / size
    return (x0 + f * (q[0] + u * k0), x1 + f * (q[1] + u * k1), x[2]), (q[0] + f0, q[1] + f1, v[2])


@kernel
def arc_duration(field: float, s: float) -> float:
    """Return the time of a flight up to s."""
    whole = math.floor(s)
    return (whole * (0.5 * math.pi) + 2.0 * angle_of_tangent(s - whole)) / abs(field)


@kernel
def arcs_joined(s: float, more: float) -> float:
    """Return the place on a flight that goes on with another."""
    m, n = math.floor(s), math.floor(more)
    u, w = s - m, more - n
    top, bottom = u + w, 1.0 - u * w
    if top < bottom:
        return m + n + top / bottom
    # the tangent of half the angle beyond a quarter
    return m + n + 1.0 + (top - bottom) / (top + bottom)


# --- pieces with a closed form -----------------------------------------------------------------------------------------


@kernel
def _falls_through_zero(c0: float, c1: float, c2: float, near: float) -> float:
    """Return u within the quarter at which c0 + c1 u + c2 u^2 falls through zero; from below -near, only after it has risen."""
    if c0 >= -near:
        return hit2(c0, c1, c2, 1.0, 0.0)
    inside = c1 * c1 - 4.0 * c2 * c0
    if c1 <= 0.0 or c2 >= 0.0 or inside <= 0.0:
        return NEVER
    u = (c1 + math.sqrt(inside)) / (-2.0 * c2)
    return u if u <= 1.0 else NEVER


@kernel
def _face(p: Any, near: float, x: Vec, v: Vec, k: Vec) -> float:
    """Return u at which a face is met: v and k, velocity and its quarter turn, are over |W|/2."""
    d = p.n[0] * x[0] + p.n[1] * x[1] - p.offset
    return _falls_through_zero(d, p.n[0] * v[0] + p.n[1] * v[1], d + p.n[0] * k[0] + p.n[1] * k[1], near)


@kernel
def _depth(x: float, y: float, v: Vec, k: Vec, r: float) -> tuple[float, float, float]:
    """Return (1 + u^2) (r^2 - |x(u)|^2) as coefficients of a polynomial in u, for a circle about the origin."""
    c0 = r * r - (x * x + y * y)
    c1 = -2.0 * (x * v[0] + y * v[1])
    c2 = c0 - 2.0 * (x * k[0] + y * k[1]) - (v[0] * v[0] + v[1] * v[1])
    if abs(c0) < ON_THE_CIRCLE * (r * r) and c1 * c1 < ALONG_THE_CIRCLE * (v[0] * v[0] + v[1] * v[1]) * (r * r):
        c0 = 0.0
    return c0, c1, c2


@kernel
def _ellipse(p: Any, x: Vec, v: Vec, k: Vec) -> float:
    """Return u at which an ellipse is left."""
    # (1 + u^2) x(u), over the half axes
    a, b = p.half_axes[0], p.half_axes[1]
    x0, x1, x2 = x[0] / a, v[0] / a, (x[0] + k[0]) / a
    y0, y1, y2 = x[1] / b, v[1] / b, (x[1] + k[1]) / b
    return hit4(
        1.0 - (x0 * x0 + y0 * y0),
        -2.0 * (x0 * x1 + y0 * y1),
        2.0 - (x1 * x1 + y1 * y1) - 2.0 * (x0 * x2 + y0 * y2),
        -2.0 * (x1 * x2 + y1 * y2),
        1.0 - (x2 * x2 + y2 * y2),
        1.0,
        0.0,
    )


# --- pieces whose gap has a bounded second derivative ---------------------------------------------------------------------


@kernel
def _gap(path: Any, u: float) -> tuple[float, float]:
    """Return the gap to a panel at u and its rate, in the chord's frame."""
    panels, j, a, x, v, k = path
    d = 1.0 / (1.0 + u * u)
    f, g = u * d, d * d
    px, py = x[0] + f * (v[0] + u * k[0]), x[1] + f * (v[1] + u * k[1])
    even, odd = g * (1.0 - u * u), g * (2.0 * u)
    eta, slope = graph_at(panels, j, a, px)
    return py - eta, (even * v[1] + odd * k[1]) - slope * (even * v[0] + odd * k[0])


_fall, _leave = searches(_gap)


@kernel
def _first_fall(
    panels: Any, j: int, a: float, near: float, pull: float, x: Vec, v: Vec, k: Vec, u0: float, end: float
) -> float:
    """Return the first u between u0 and the end at which the gap falls through zero, or infinity; pull: an upper bound of G''."""
    path = (panels, j, a, x, v, k)
    speed = math.sqrt(v[0] * v[0] + v[1] * v[1])
    tiny = near / speed
    g0, rate0 = _gap(path, u0)
    if g0 < -BEHIND * near:
        return NEVER  # behind the wall: it has left the interior before, or is in another part of it
    if g0 <= near:
        if rate0 < -SLOW * speed:
            return u0
        # it touches: on to where the gap is more than rounding, which is at least rate0 u - pull u^2/2
        u0, g0, rate0, out = _leave(path, u0, end, max(tiny, rate0 / pull), near, 1.0)
        if not out:
            return u0
    return _fall(path, u0, g0, rate0, end, end, pull, NEVER, tiny)


@kernel
def _next_zero(c0: float, c1: float, c2: float, after: float) -> float:
    """Return the first zero of c0 + c1 u + c2 u^2 beyond a place, or infinity."""
    inside = c1 * c1 - 4.0 * c2 * c0
    if inside < 0.0:
        return NEVER
    root = math.sqrt(inside)
    b = -0.5 * (c1 + root) if c1 > 0.0 else -0.5 * (c1 - root)
    one, other = b / c2 if c2 != 0.0 else NEVER, c0 / b if b != 0.0 else NEVER
    low, high = min(one, other), max(one, other)
    return low if low > after else high if high > after else NEVER


@kernel
def _panel(panels: Any, j: int, a: float, near: float, x: Vec, v: Vec, k: Vec, most: float) -> float:
    """Return the first u within ``most`` at which a quarter meets a panel from above; x, v, k in its chord's frame."""
    first, last = panels[j, FIRST_XI], panels[j, LAST_XI]
    margin = OVERLAP * (last - first)
    first, last = first - margin, last + margin
    size = math.sqrt(v[0] * v[0] + v[1] * v[1])
    # x(u) = x + u/(1 + u^2) (v + u k) has |x'| <= |v| and |x''| <= 2 |v|
    pull = (2.0 + 2.0 * panels[j, SLOPE] + panels[j, BEND] * size) * size
    u = 0.0
    while u < most:
        # to the next place at which xi enters the panel or leaves it
        out = min(
            most,
            _next_zero(x[0] - first, v[0], x[0] - first + k[0], u),
            _next_zero(x[0] - last, v[0], x[0] - last + k[0], u),
        )
        m = 0.5 * (u + out)
        middle = x[0] + m / (1.0 + m * m) * (v[0] + m * k[0])
        if first <= middle <= last:
            found = _first_fall(panels, j, a, near, pull, x, v, k, u, out)
            if found < NEVER:
                return found
        u = out
    return NEVER


@kernel
def _curve(panels: Any, first: int, last: int, a: float, near: float, x: Vec, v: Vec, k: Vec, most: float) -> float:
    """Return the first u within ``most`` at which a quarter leaves through an arc of a smooth curve; infinity where it does not."""
    best = most
    found = NEVER
    radius = 0.5 * math.sqrt(v[0] * v[0] + v[1] * v[1])
    # of a circle much larger than the table, too, whose middle is rounded
    near_circle = near + CIRCLE_NOISE * radius
    mx, my = x[0] + 0.5 * k[0], x[1] + 0.5 * k[1]
    for j in range(first, last):
        ex, ey = panels[j, CX], panels[j, CX + 1]
        dx, dy = mx - panels[j, OX], my - panels[j, OX + 1]
        # the panel's rectangle, and the circle's middle, in the chord's frame
        begin, end, low, high = panels[j, FIRST_XI], panels[j, LAST_XI], panels[j, LOW] - near, panels[j, HIGH] + near
        cx, cy = ex * dx + ey * dy, ex * dy - ey * dx
        wide, tall = max(begin - cx, cx - end, 0.0), max(low - cy, cy - high, 0.0)
        if wide * wide + tall * tall > (radius + near_circle) * (radius + near_circle):
            continue
        wide, tall = max(cx - begin, end - cx), max(cy - low, high - cy)
        inner = radius - near_circle
        if inner > 0.0 and wide * wide + tall * tall < inner * inner:
            continue
        dx, dy = x[0] - panels[j, OX], x[1] - panels[j, OX + 1]
        u = _panel(
            panels, j, a, near, (ex * dx + ey * dy, ex * dy - ey * dx, 0.0), (ex * v[0] + ey * v[1], ex * v[1] - ey * v[0], 0.0),
            (ex * k[0] + ey * k[1], ex * k[1] - ey * k[0], 0.0), best,
        )  # fmt: skip
        if u < NEVER:
            best, found = u, u
    return found


# --- all pieces -----------------------------------------------------------------------------------------------------------


@kernel
def _at(x: Vec, v: Vec, k: Vec, u: float) -> tuple[float, float]:
    """Return the place at u."""
    f = u / (1.0 + u * u)
    return x[0] + f * (v[0] + u * k[0]), x[1] + f * (v[1] + u * k[1])


@kernel
def _hit_in_quarter(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec, k: Vec) -> tuple[float, int]:
    """Return u at the next piece within a quarter of the circle, and its index; infinity and -1 where none is met."""
    best = NEVER
    which = -1
    near = world.corner_tolerance
    for i in range(world.windows):
        p = pieces[i]
        part = world.finite_faces and i < world.faces
        u = _face(p, near if part else NEVER, x, v, k)
        if u < best:
            if part:
                px, py = _at(x, v, k, u)
                s = p.n[1] * px - p.n[0] * py
                if s < p.begin - near or s > p.end + near:
                    continue
            best, which = u, i
    for i in range(world.windows, world.inside):
        p = pieces[i]
        c0, c1, c2 = _depth(x[0] - p.center[0], x[1] - p.center[1], v, k, p.radius)
        u = _falls_through_zero(c0, c1, c2, 2.0 * p.radius * near if p.half != 0.0 else NEVER)
        if u < best and (p.half == 0.0 or p.half * (_at(x, v, k, u)[0] - p.center[0]) >= -near):
            best, which = u, i
    for i in range(world.inside, world.outside):
        p = pieces[i]
        c0, c1, c2 = _depth(x[0] - p.center[0], x[1] - p.center[1], v, k, p.radius)
        u = hit2(-c0, -c1, -c2, 1.0, 0.0)
        if u < best:
            best, which = u, i
    if world.outside < world.ellipses:
        u = _ellipse(pieces[world.outside], x, v, k)
        if u < best:
            best, which = u, world.outside
    for i in range(world.ellipses, world.curves):
        p = pieces[i]
        u = _curve(panels, p.first, p.last, world.inset, NOISE * world.extent, x, v, k, min(best, 1.0))
        if u < best:
            best, which = u, i
    return best, which


@kernel
def larmor_hit(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """Return the place s on the flight at which it meets the next piece, and its index; infinity and -1 for a closed circle."""
    field = world.magnetic_field
    way = 1.0 if field > 0.0 else -1.0
    scale = 2.0 / abs(field)
    for count in range(4):
        y, w = on_arc(field, x, v, float(count))
        u, i = _hit_in_quarter(
            world, pieces, panels, y, (scale * w[0], scale * w[1], 0.0), (-way * scale * w[1], way * scale * w[0], 0.0)
        )
        if i >= 0:
            return count + u, i
    return NEVER, -1


# --- straight lines and parabolas ------------------------------------------------------------------------------------------


@hot_kernel
def circle_exit(x: float, y: float, u: float, v: float, r: float) -> float:
    """Return the time at which a point (x, y) with velocity (u, v) leaves a circle of radius r about the origin."""
    b = x * u + y * v
    speed = u * u + v * v
    # the half chord from the line's distance to the centre, which avoids the cancellation in b^2 - |v|^2 (|x|^2 - r^2)
    across = x * v - y * u
    inside = speed * (r * r) - across * across
    depth = r * r - (x * x + y * y)
    if depth < -1e-12 * r * r and (inside <= 0.0 or b >= 0.0):
        return NEVER  # outside it (of a table with other pieces), on a line that does not cross it
    return _chord_end(b, inside, depth, speed, r)


@hot_kernel
def _chord_end(b: float, inside: float, depth: float, speed: float, r: float) -> float:
    """Return the time to the end of a chord of a circle or sphere: b = x.v, speed = v.v, inside = the half chord's square times
    speed, depth = r^2 - x.x."""
    root = math.sqrt(inside) if inside > 0.0 else 0.0
    if b < 0.0:
        # on the circle and nearly tangent to it the root is lost in rounding; by symmetry the chord has equal halves
        if b * b < 1e-8 * speed * (r * r) and abs(depth) < 1e-14 * (r * r):
            return -2.0 * b / speed
        return (root - b) / speed
    # past the middle of the chord: the other form of the same root
    return depth / (root + b) if root + b > 0.0 else NEVER


@hot_kernel
def circle_entry(x: float, y: float, u: float, v: float, r: float) -> float:
    """Return the time at which a point outside a circle about the origin enters it; infinity where it does not."""
    b = x * u + y * v
    across = x * v - y * u
    inside = (u * u + v * v) * r * r - across * across
    if b >= 0.0 or inside <= 0.0:
        return NEVER
    return (x * x + y * y - r * r) / (math.sqrt(inside) - b)


@hot_kernel
def sphere_exit(x: Vec, v: Vec, r: float) -> float:
    """Return the time at which a point within a sphere about the origin leaves it."""
    b = x[0] * v[0] + x[1] * v[1] + x[2] * v[2]
    speed = v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
    p, q, s = x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]
    inside = speed * r * r - (p * p + q * q + s * s)
    return _chord_end(b, inside, r * r - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), speed, r)


@hot_kernel
def straight_hit(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """Return the time to the next piece on a straight flight, and its index; infinity and -1 where none lies ahead."""
    best = NEVER
    which = -1
    for i in range(world.faces):
        p = pieces[i]
        u = p.n[0] * v[0] + p.n[1] * v[1] + p.n[2] * v[2]
        if u < 0.0:
            d = p.n[0] * x[0] + p.n[1] * x[1] + p.n[2] * x[2] - p.offset
            t = -d / u
            if t < best:
                if world.finite_faces:
                    # behind the face, or beyond its ends
                    s = p.n[1] * (x[0] + t * v[0]) - p.n[0] * (x[1] + t * v[1])
                    if (
                        d < -world.corner_tolerance
                        or s < p.begin - world.corner_tolerance
                        or s > p.end + world.corner_tolerance
                    ):
                        continue
                best = t
                which = i
    for i in range(world.faces, world.windows):
        p = pieces[i]
        u = p.n[0] * v[0] + p.n[1] * v[1]
        if u < 0.0:
            t = (p.offset - p.n[0] * x[0] - p.n[1] * x[1]) / u
            if t < best:
                best = t
                which = i
    for i in range(world.windows, world.inside):
        p = pieces[i]
        t = circle_exit(x[0] - p.center[0], x[1] - p.center[1], v[0], v[1], p.radius)
        if t < best and (p.half == 0.0 or p.half * (x[0] + t * v[0] - p.center[0]) >= -world.corner_tolerance):
            best = t
            which = i
    for i in range(world.inside, world.outside):
        p = pieces[i]
        t = circle_entry(x[0] - p.center[0], x[1] - p.center[1], v[0], v[1], p.radius)
        if t < best:
            best = t
            which = i
    for i in range(world.outside, world.ellipses):
        p = pieces[i]
        a, b = p.half_axes[0], p.half_axes[1]
        t = circle_exit(x[0] / a, x[1] / b, v[0] / a, v[1] / b, 1.0)
        if t < best:
            best = t
            which = i
    if world.ellipses < world.curves:
        near, squared = world.corner_tolerance * world.corner_tolerance, v[0] * v[0] + v[1] * v[1]
        for i in range(world.ellipses, world.curves):
            p = pieces[i]
            t = curve_line(panels, p.first, p.last, world.inset, NOISE * world.extent, x[0], x[1], v[0], v[1])
            if t < best and (t >= 0.0 or t * t * squared < near):
                best = t
                which = i
    for i in range(world.curves, world.spheres):
        t = sphere_exit(x, v, pieces[i].radius)
        if t < best:
            best = t
            which = i
    # a ball that rounding put just behind a wall is on it
    return (best if best > 0.0 else 0.0), which


@hot_kernel
def wall_normal(world: Any, pieces: Any, panels: Any, i: int, x: Vec) -> Vec:
    """Return the normal of piece i, towards the ball, for a centre at x."""
    p = pieces[i]
    if i < world.windows:
        return (p.n[0], p.n[1], p.n[2])
    if i < world.outside:
        dx, dy = x[0] - p.center[0], x[1] - p.center[1]
        w = p.curvature
        if i < world.inside:
            return (-dx * w, -dy * w, 0.0)
        return (dx * w, dy * w, 0.0)
    if i < world.ellipses:
        nx, ny = x[0] / (p.half_axes[0] * p.half_axes[0]), x[1] / (p.half_axes[1] * p.half_axes[1])
        w = 1.0 / math.sqrt(nx * nx + ny * ny)
        return (-nx * w, -ny * w, 0.0)
    if i < world.curves:
        nx, ny, _kappa = curve_wall(panels, p.first, p.last, world.inset, p.n[0], p.n[1], x[0], x[1])
        return (nx, ny, 0.0)
    w = (1.5 - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) * (0.5 * p.curvature * p.curvature)) * p.curvature
    return (-x[0] * w, -x[1] * w, -x[2] * w)


@kernel
def _face_hit(d: float, u: float, h: float, near: float) -> float:
    """Return when d + u t + h t^2 falls through zero; from behind the wall, only after it has come in front of it."""
    if d >= -near:
        return hit2(d, u, h, NEVER, 0.0)
    inside = u * u - 4.0 * h * d
    if u <= 0.0 or h >= 0.0 or inside <= 0.0:
        return NEVER
    return (u + math.sqrt(inside)) / (-2.0 * h)


@kernel
def _depth_polynomial(
    x: float, y: float, u: float, v: float, g: float, h: float, r: float
) -> tuple[float, float, float, float, float]:
    """Return r^2 - |x(t)|^2 of a point that falls near a circle about the origin, as coefficients of a polynomial in t."""
    return (
        r * r - (x * x + y * y),
        -2.0 * (x * u + y * v),
        -(u * u + v * v + x * g + y * h),
        -(u * g + v * h),
        -(g * g + h * h) / 4.0,
    )


@kernel
def _parabolic_circle_exit(p: Any, near: float, x: float, y: float, u: float, v: float, g: float, h: float) -> float:
    """Return the time at which a falling point leaves a circle, or a half of one."""
    dx, dy = x - p.center[0], y - p.center[1]
    c = _depth_polynomial(dx, dy, u, v, g, h, p.radius)
    t = hit4(c[0], c[1], c[2], c[3], c[4], NEVER, 0.0)
    if p.half != 0.0:
        while t < NEVER and p.half * (dx + (u + 0.5 * g * t) * t) < -near:
            t = next_hit4(c[0], c[1], c[2], c[3], c[4], t, NEVER)
    return t


@kernel
def parabolic_hit(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """Return the time to the next piece on a parabolic flight, and its index; infinity and -1 where none lies ahead."""
    best = NEVER
    which = -1
    g = world.acceleration
    g0, g1, g2 = g[0], g[1], g[2]
    for i in range(world.windows):
        p = pieces[i]
        n0, n1, n2 = p.n[0], p.n[1], p.n[2]
        d = n0 * x[0] + n1 * x[1] + n2 * x[2] - p.offset
        u = n0 * v[0] + n1 * v[1] + n2 * v[2]
        part = world.finite_faces and i < world.faces
        t = _face_hit(d, u, 0.5 * (n0 * g0 + n1 * g1 + n2 * g2), world.corner_tolerance if part else NEVER)
        if t < best:
            if part:
                s = n1 * (x[0] + (v[0] + 0.5 * g0 * t) * t) - n0 * (x[1] + (v[1] + 0.5 * g1 * t) * t)
                if s < p.begin - world.corner_tolerance or s > p.end + world.corner_tolerance:
                    continue
            best, which = t, i
    for i in range(world.windows, world.inside):
        t = _parabolic_circle_exit(pieces[i], world.corner_tolerance, x[0], x[1], v[0], v[1], g0, g1)
        if t < best:
            best, which = t, i
    for i in range(world.inside, world.outside):
        p = pieces[i]
        c = _depth_polynomial(x[0] - p.center[0], x[1] - p.center[1], v[0], v[1], g0, g1, p.radius)
        t = hit4(-c[0], -c[1], -c[2], -c[3], -c[4], NEVER, 0.0)
        if t < best:
            best, which = t, i
    if world.outside < world.ellipses:
        p = pieces[world.outside]
        a, b = p.half_axes[0], p.half_axes[1]
        c = _depth_polynomial(x[0] / a, x[1] / b, v[0] / a, v[1] / b, g0 / a, g1 / b, 1.0)
        t = hit4(c[0], c[1], c[2], c[3], c[4], NEVER, 0.0)
        if t < best:
            best, which = t, world.outside
    if world.ellipses < world.curves:
        size, near = world.extent, NOISE * world.extent
        end = flight_end(size, x[0], x[1], v[0], v[1], g0, g1)
        for i in range(world.ellipses, world.curves):
            p = pieces[i]
            most = min(best, end)
            t = curve_parabola(panels, p.first, p.last, world.inset, size, near, x[0], x[1], v[0], v[1], g0, g1, most)
            if t < best:
                best, which = t, i
    for i in range(world.curves, world.spheres):
        r = pieces[i].radius
        t = hit4(
            r * r - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]),
            -2.0 * (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]),
            -(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + x[0] * g0 + x[1] * g1 + x[2] * g2),
            -(v[0] * g0 + v[1] * g1 + v[2] * g2), -(g0 * g0 + g1 * g1 + g2 * g2) / 4.0, NEVER, 0.0,
        )  # fmt: skip
        if t < best:
            best, which = t, i
    return best, which


@hot_kernel
def next_hit(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """Return how far the next piece is and its index; infinity and -1 where none lies ahead.

    The distance along the flight is its time, or on an arc the number of :mod:`carom.billiards.intersections`.
    """
    if world.flight != STRAIGHT:
        if world.flight == ARC:
            return larmor_hit(world, pieces, panels, x, v)
        return parabolic_hit(world, pieces, panels, x, v)
    return straight_hit(world, pieces, panels, x, v)
