"""Distance to and hits of a rim, the circle in which a round wall ends. A ball of radius a touches it at a distance a.

With r the centre from the circle's, h what of it is along the axis, rho what is across, that is

    (|r|^2 + R^2 - a^2)^2 = 4 R^2 rho^2,

the product of the gaps to the nearest and to the farthest point of the circle: of degree 8 in flight. On the axis the nearest
and the farthest are one, and the product touches zero without a change of sign; there (|r|^2 + R^2 - a^2) itself is followed.

Few scenes have rims, and their roots would take a quarter of the engine's compiling: the engine calls :func:`call_rim`
through an address (:func:`rim_address`), compiled for the first scene that has one.
"""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.calls import address_of, answer_at, python_address
from carom.core.jit.kernel import Vec, cross, dot, kernel
from carom.core.roots import hit4, hit8, next_hit8, two_prod

# As for the other features (carom.core.geometry.features): over its ends; in touch or not; a touch that is none.
SEAM, BEHIND, GRAZE = 1e-9, 1e-3, 1e-12
# Nearer to the axis than these shares of R the nearest and the farthest point are met one right after the other: from afar
# their roots come together, and rounding moves them, or takes both; and at last they are met at once.
BESIDE, CENTRED, ALL = 0.1, 1e-4, 1e-10
TOGETHER = 1e-6
# From far away the polynomials know little of a small circle: a hit that may be off by this share of the ball's radius is polished.
ROUNDING, BLURRED = 1.1e-16, 1e-11
CLEAR = 1e-9
NUMBERS = 23


@kernel
def _across(d: Vec, r: Vec) -> tuple[Vec, float, float]:
    """Components of r across the axis d (and their size) and along it."""
    h = dot(r, d)
    q = (r[0] - h * d[0], r[1] - h * d[1], r[2] - h * d[2])
    return q, math.sqrt(dot(q, q)), h


@kernel
def rim_gap(p: Vec, d: Vec, radius: float, x: Vec) -> float:
    """Distance of x from the nearest point of a circle around p."""
    _q, rho, h = _across(d, (x[0] - p[0], x[1] - p[1], x[2] - p[2]))
    return math.sqrt((rho - radius) * (rho - radius) + h * h)


@kernel
def rim_normal(p: Vec, d: Vec, radius: float, x: Vec, v: Vec) -> Vec:
    """Unit vector to x from the nearest point of a circle.

    On the axis all are as near: of a ball that comes along it they push together, of another the one that it moves towards.
    """
    q, rho, h = _across(d, (x[0] - p[0], x[1] - p[1], x[2] - p[2]))
    if not rho > ALL * radius:
        q, rho, along = _across(d, v)
        if not radius * rho > TOGETHER * abs(h * along):
            return d if h >= 0 else (-d[0], -d[1], -d[2])
        near = math.sqrt(radius * radius + h * h)
        c, s = -radius / (rho * near), h / near
    else:
        near = math.sqrt((rho - radius) * (rho - radius) + h * h)
        if not near > 0:
            return d
        c, s = (rho - radius) / (rho * near), h / near
    return (c * q[0] + s * d[0], c * q[1] + s * d[1], c * q[2] + s * d[2])


@kernel
def rim_gap_derivatives(p: Vec, d: Vec, radius: float, x: Vec, v: Vec, acc: Vec) -> tuple[float, float]:
    """First and second derivative of the distance from a circle."""
    q, rho, h = _across(d, (x[0] - p[0], x[1] - p[1], x[2] - p[2]))
    n = rim_normal(p, d, radius, x, v)
    near = math.sqrt((rho - radius) * (rho - radius) + h * h)
    rate = dot(n, v)
    if not rho > ALL * radius:
        return rate, dot(n, acc) + (dot(v, v) - rate * rate) / near
    # the distance bends by 1/near in the plane through the axis, and along the circle by the share of n across, over rho
    turn = cross(d, q)
    along = dot(turn, v) / rho
    rest = max(dot(v, v) - rate * rate - along * along, 0 * near)
    return rate, dot(n, acc) + rest / near + along * along * (rho - radius) / (rho * near)


@kernel
def _never_closes(c: tuple[float, ...], until: float, tol: float) -> bool:
    """Whether the gap c[0] + c[1] s + ... of a ball in touch never closes faster than tol up to s = until."""
    least, power = c[1], 1 + 0 * until
    for i in range(2, len(c)):
        power = power * until
        if c[i] < 0:
            least += i * c[i] * power
    return bool(least >= -tol)


@kernel
def _on_arc(d: Vec, u: Vec, cosine: float, r: Vec) -> bool:
    """Whether the nearest point of the circle is on the arc around u."""
    q, rho, _h = _across(d, r)
    return bool(cosine <= -1 or dot(q, u) >= (cosine - SEAM) * rho)


@kernel
def _motion_after(r: Vec, v: Vec, acc: Vec, s: float) -> tuple[Vec, Vec]:
    """Place and velocity a time s later."""
    h = s * s / 2
    return (
        (r[0] + v[0] * s + acc[0] * h, r[1] + v[1] * s + acc[1] * h, r[2] + v[2] * s + acc[2] * h),
        (v[0] + acc[0] * s, v[1] + acc[1] * s, v[2] + acc[2] * s),
    )


@kernel
def _passes(q: Vec, v: Vec, b: Vec, reach: float, until: float) -> bool:
    """Whether a straight way, seen along the axis, leads past a circle of radius ``reach``: most rims, cheaply.

    Straight are the ways of balls that fly or roll; of a ball that rolls, b is along v but for its rounding.
    """
    along, speed2, off2 = dot(q, v), dot(v, v), dot(q, q)
    clear = reach * reach * (1 + CLEAR)
    turn = cross(v, b)
    if dot(b, b) == 0:
        if along >= 0:
            return bool(off2 > clear)
    elif not math.sqrt(dot(turn, turn)) * until * until <= CLEAR * CLEAR * reach * math.sqrt(speed2):
        return False
    return bool(off2 * speed2 - along * along > clear * speed2 + CLEAR * off2 * speed2)


@kernel
def _centred(d: Vec, radius: float, a: float, r: Vec, v: Vec, acc: Vec, until: float, slow: float) -> float:
    """When a ball larger than the circle comes down on all of it at once, or nearly; infinite where it does not."""
    far2 = radius * radius - a * a
    if not far2 < 0:
        return math.inf
    tol = 2 * math.sqrt(-far2) * slow
    c = (dot(r, r) + far2, 2 * dot(r, v), dot(v, v) + dot(r, acc), dot(v, acc), dot(acc, acc) / 4)
    if c[0] <= 2 * math.sqrt(-far2) * SEAM * a and _never_closes(c, until, tol):
        return math.inf
    s = hit4(c[0], c[1], c[2], c[3], c[4], until, tol)
    if not s <= until:
        return math.inf
    y, _vy = _motion_after(r, v, acc, s)
    _q, rho, _h = _across(d, y)
    if not rho <= CENTRED * radius:
        return math.inf
    return s


@kernel
def _polished(d: Vec, radius: float, a: float, r: Vec, v: Vec, acc: Vec, s: float, until: float) -> float:
    """A hit near the axis or from afar, where the polynomials say little of the gap: by Newton's steps on the gap itself."""
    zero = (0 * a, 0 * a, 0 * a)
    last = math.inf
    for _ in range(20):
        y, w = _motion_after(r, v, acc, s)
        gap = rim_gap(zero, d, radius, y) - a
        rate, _bend = rim_gap_derivatives(zero, d, radius, y, w, acc)
        step = gap / rate if rate < 0 else 0 * gap
        if not abs(step) < last / 2 or not 0 <= s - step <= until:
            break
        s -= step
        last = abs(step)
    return s


@kernel
def rim_hit(
    p: Vec, d: Vec, radius: float, u: Vec, cosine: float, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float
) -> float:
    """Time in [0, until] at which a ball touches the arc of a circle around u, or infinity."""
    r = (x[0] - p[0], x[1] - p[1], x[2] - p[2])
    zero = (0 * a, 0 * a, 0 * a)
    q, rho, h = _across(d, r)
    qv, _size, h1 = _across(d, v)
    qb, _size, _h2 = _across(d, acc)
    rr = radius * radius
    if _passes(q, qv, qb, radius + a, until):
        return math.inf
    near = math.sqrt((rho - radius) * (rho - radius) + h * h)
    gap = (near - a) * (near + a)
    far = gap + 4 * radius * rho
    # |r|^2 + R^2 - a^2, and rho^2
    a0, a1, a2, a3, a4 = gap + 2 * radius * rho, 2 * dot(r, v), dot(v, v) + dot(r, acc), dot(v, acc), dot(acc, acc) / 4
    b1, b2, b3, b4 = 2 * dot(q, qv), dot(qv, qv) + dot(q, qb), dot(qv, qb), dot(qb, qb) / 4
    # the first two as products, which keep their digits in touch
    c0, c1 = gap * far, 2 * a0 * a1 - 4 * rr * b1
    if rho > 0:
        out = dot(q, qv) / rho
        c1 = 2 * ((rho - radius) * out + h * h1) * far + 2 * ((rho + radius) * out + h * h1) * gap
    c = (
        c0,
        c1,
        2 * a0 * a2 + a1 * a1 - 4 * rr * b2,
        2 * (a0 * a3 + a1 * a2) - 4 * rr * b3,
        2 * (a0 * a4 + a1 * a3) + a2 * a2 - 4 * rr * b4,
        2 * (a1 * a4 + a2 * a3),
        2 * a2 * a4 + a3 * a3,
        2 * a3 * a4,
        a4 * a4,
    )
    tol = 2 * a * abs(far) * slow
    s = found = math.inf
    if near < (1 - BEHIND) * a:  # beyond the ends of an arc
        s = next_hit8(c, 0 * a, until)
    elif near - a > SEAM * a or not _never_closes(c, until, tol):
        s = hit8(c, until, tol)
    for _ in range(4):
        if not s <= until:
            break
        y, w = _motion_after(r, v, acc, s)
        # (not where the farthest point is a radius away: that is in reach of no ball that the nearest keeps out)
        if rim_gap(zero, d, radius, y) >= (1 - BEHIND) * a and _on_arc(d, u, cosine, y):
            rate, bend = rim_gap_derivatives(zero, d, radius, y, w, acc)
            # (a gap that has not opened by more than rounding when it turns down has there a rate of rounding)
            comes = rate < 0 or (rate <= slow and bend < 0)
            if comes and not rate * rate <= 2 * bend * GRAZE * a:
                found = s
                break
        s = next_hit8(c, s, until)
    s = _centred(d, radius, a, r, v, acc, min(until, found), slow)
    if s < found:
        y, _w = _motion_after(r, v, acc, s)
        if _on_arc(d, u, cosine, y):
            found = s
    if found > 0 and found <= until:
        y, _w = _motion_after(r, v, acc, found)
        _q, rho, _h = _across(d, y)
        # what rounding of coefficients of the size |r|^4 makes of the gap; its factor is 2 a times 4 R rho in touch
        blurred = dot(r, r) * dot(r, r) * ROUNDING > BLURRED * a * (8 * a * radius * rho)
        if (radius < a and rho < BESIDE * radius) or blurred:
            return _polished(d, radius, a, r, v, acc, found, until)
    return found


@kernel
def call_rim(
    address: int, p: Vec, d: Vec, radius: float, u: Vec, cosine: float, a: float, x: Vec, v: Vec, acc: Vec, until: float,
    slow: float,
) -> float:  # fmt: skip
    """:func:`rim_hit` through its address."""
    numbers = (
        p[0], p[1], p[2], d[0], d[1], d[2], radius, u[0], u[1], u[2], cosine, a,
        x[0], x[1], x[2], v[0], v[1], v[2], acc[0], acc[1], acc[2], until, slow,
    )  # fmt: skip
    return answer_at(address, numbers)[0]


def rim_entry(
    px: float, py: float, pz: float, dx: float, dy: float, dz: float, radius: float, ux: float, uy: float, uz: float,
    cosine: float, a: float, x: float, y: float, z: float, vx: float, vy: float, vz: float, bx: float, by: float,
    bz: float, until: float, slow: float, out: Any,
) -> None:  # fmt: skip
    """:func:`rim_hit` as it is called by its address: :data:`NUMBERS` numbers, and a place to write to."""
    p, d, u = (px, py, pz), (dx, dy, dz), (ux, uy, uz)
    out[0] = rim_hit(p, d, radius, u, cosine, a, (x, y, z), (vx, vy, vz), (bx, by, bz), until, slow)


@functools.cache
def rim_address(compiled: bool = True) -> int:
    """Return the address of :func:`rim_hit`, compiled (some seconds, once) or loaded; or one that only Python knows."""
    return address_of(rim_entry, NUMBERS, keep=True) if compiled else python_address(rim_entry)


# ----------------------------------------------------------------------------------------------------
# Cosine and sine of an angle in degrees, and the angle of a tangent, with the same bits on every machine.
#
# math.cos, math.sin and math.atan come from the platform's libm, and differ in the last digit; a wall at an angle would stand
# elsewhere in a browser. Here there are + - * / and an exact remainder only, and multiples of 90 degrees are exact.
#
# The polynomials are fdlibm's __kernel_sin and __kernel_cos, for |x| <= pi/4, and its atan, with errors below 1 in the last digit.


# pi/180, in two parts
DEGREE, DEGREE_REST = 0.017453292519943295, 2.9486522708701687e-19
S1, S2, S3 = -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04
S4, S5, S6 = 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10
C1, C2, C3 = 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05
C4, C5, C6 = -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11
# fdlibm's atan: of 1/2 and 1 in two parts each, and the polynomial
ATAN_HALF, ATAN_HALF_REST = 4.63647609000806093515e-01, 2.26987774529616870924e-17
ATAN_ONE, ATAN_ONE_REST = 7.85398163397448278999e-01, 3.06161699786838301793e-17
A0, A1, A2 = 3.33333333333329318027e-01, -1.99999999998764832476e-01, 1.42857142725034663711e-01
A3, A4, A5 = -1.11111104054623557880e-01, 9.09088713343650656196e-02, -7.69187620504482999495e-02
A6, A7, A8 = 6.66107313738753120669e-02, -5.83357013379057348645e-02, 4.97687799461593236017e-02
A9, A10 = -3.65315727442169155270e-02, 1.62858201153657823623e-02


@kernel
def _whole_turns_less(degrees: float) -> float:
    """Return the remainder of degrees by 360, exact and with its sign, as ``math.fmod`` (which Numba does not have)."""
    rest, step = abs(degrees), 360.0
    while 2 * step <= rest:
        step = 2 * step
    while step >= 360:
        if rest >= step:
            rest = rest - step
        step = step / 2
    return rest if degrees >= 0 else -rest


@kernel
def _cosine_and_sine(rest: Any) -> tuple[Any, Any]:
    """Return both of -45 to 45 degrees."""
    x, y = two_prod(rest, DEGREE)
    y += rest * DEGREE_REST
    z = x * x
    w = z * z
    v = z * x
    r = S2 + z * (S3 + z * S4) + z * w * (S5 + z * S6)
    s = x - ((z * (0.5 * y - v * r) - y) - v * S1)
    r = z * (C1 + z * (C2 + z * C3)) + w * w * (C4 + z * (C5 + z * C6))
    half = 0.5 * z
    w = 1.0 - half
    return w + (((1.0 - w) - half) + (z * r - x * y)), s


@kernel
def direction(degrees: float) -> tuple[float, float]:
    """Return (cos, sin) of an angle in degrees.

    >>> direction(90.0), direction(-180.0), direction(30.0)[1]
    ((0.0, 1.0), (-1.0, 0.0), 0.5)
    """
    turn = _whole_turns_less(degrees)
    quarters = math.floor(turn / 90 + 0.5)
    c, s = _cosine_and_sine(turn - 90 * quarters)
    k = quarters % 4
    if k == 0:
        return (c, s)
    if k == 1:
        return (0.0 - s, c)
    return (0.0 - c, 0.0 - s) if k == 2 else (s, 0.0 - c)


def directions(degrees: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (cos, sin), (N, 2), of angles (N,) in degrees, with the bits of :func:`direction`.

    >>> directions(np.array([90.0, -180.0]))
    array([[ 0.,  1.],
           [-1.,  0.]])
    """
    turn = np.fmod(degrees + 0.0, 360.0)  # (of -0 as of 0)
    quarters = np.floor(turn / 90 + 0.5)
    c, s = _cosine_and_sine(turn - 90 * quarters)
    k = quarters.astype(int) % 4
    return np.stack([np.choose(k, (c, 0.0 - s, 0.0 - c, s)), np.choose(k, (s, c, 0.0 - s, 0.0 - c))], axis=-1)


@kernel
def angle_of_tangent(x: float) -> float:
    """Return the angle in radians, from 0 to pi/4, whose tangent is x, from 0 to 1.

    >>> angle_of_tangent(1.0) == math.pi / 4, angle_of_tangent(1e-300)
    (True, 1e-300)
    """
    whole, rest = 0.0, 0.0
    if x >= 0.6875:
        whole, rest, x = ATAN_ONE, ATAN_ONE_REST, (x - 1.0) / (x + 1.0)
    elif x >= 0.4375:
        whole, rest, x = ATAN_HALF, ATAN_HALF_REST, (2.0 * x - 1.0) / (2.0 + x)
    z = x * x
    w = z * z
    even = z * (A0 + w * (A2 + w * (A4 + w * (A6 + w * (A8 + w * A10)))))
    odd = w * (A1 + w * (A3 + w * (A5 + w * (A7 + w * A9))))
    return whole - ((x * (even + odd) - rest) - x)
