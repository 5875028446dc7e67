"""The parallel curve of an ellipse: what bounds the centre of a ball whose surface an ellipse bounds. It is of degree eight.

A convex curve is parametrised by its normal N: the ellipse has the point (p^2 Nx, q^2 Ny)/h, h = sqrt(p^2 Nx^2 + q^2 Ny^2), and
the ball's centre is then at P(N) = (p^2 Nx, q^2 Ny)/h - a N, where its curve has the radius of curvature rho = p^2 q^2/h^3 - a.

A ball that is smaller than the ellipse's smallest radius of curvature touches it everywhere, and rho > 0. A larger one (up to the
smaller half axis) does not reach the ends of the long axis: the parallel curve crosses itself on that axis, where the ball touches
both sides at once, and the part beyond is unreachable. The centre's curve then has two arcs, with corners where they meet. With
p > q, N is there (Nx, +-Ny) with h = q^2/a, so Ny^2 = (p^2 - q^4/a^2)/(p^2 - q^2), at x = +-a Nx (p^2 - q^2)/q^2.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.ellipse import oval_depth
from carom.core.jit.kernel import Vec, kernel

__all__ = [
    "EllipticArc",
    "arc_along",
    "arc_exit",
    "arc_length",
    "arc_normals",
    "arc_place",
    "arc_wall",
    "arcs",
    "ellipse_arc_length",
    "inset_exit",
]  # fmt: skip

Array = NDArray[np.float64]
NEVER = math.inf
# A ball touches the whole ellipse if its radius is smaller than the smallest radius of curvature by this fraction.
CURVATURE_MARGIN = 1e-9


class EllipticArc(NamedTuple):
    """A part of the parallel curve, or all of it, counterclockwise; the points of contact are (p cos u, q sin u)."""

    half: float
    """Side of the long axis: 1 or -1; 0: the whole curve."""
    begin: float
    """u at its beginning."""
    end: float
    """u at its end."""
    reach: float
    """Distance of its corners from the middle, along the long axis."""
    corner: tuple[float, float]
    """Outward normal at the corners, both components positive."""


def arcs(p: float, q: float, a: float) -> list[EllipticArc]:
    """Return the arcs of the curve at the distance a within the ellipse (x/p)^2 + (y/q)^2 = 1."""
    long, short = max(p, q), min(p, q)
    if a < (1 - CURVATURE_MARGIN) * short**2 / long:
        return [EllipticArc(0.0, 0.0, math.tau, math.inf, (0.0, 0.0))]
    e = (long - short) * (long + short)
    across = math.sqrt(max((long - short**2 / a) * (long + short**2 / a), 0.0) / e)
    along = math.sqrt((1 - across) * (1 + across))
    # the point of contact has (p cos u, q sin u) = (p^2 Nx, q^2 Ny)/h
    u = math.atan2(short * across, long * along)
    reach = a * along * e / short**2
    if p > q:
        return [
            EllipticArc(half, (half < 0) * math.pi + u, (2 - (half > 0)) * math.pi - u, reach, (along, across))
            for half in (1, -1)
        ]
    u = math.pi / 2 - u
    return [
        EllipticArc(half, (half < 0) * math.pi - u, (half < 0) * math.pi + u, reach, (across, along))
        for half in (1, -1)
    ]


# --- kernels ------------------------------------------------------------------------------------------------


@kernel
def inset_exit(
    x: float, y: float, u: float, v: float, p: float, q: float, a: float, low: float, high: float
) -> tuple[float, float, float, float]:
    """Return when a ball of radius a within the ellipse (x/p)^2 + (y/q)^2 = 1 touches it: time, normal, radius of curvature.

    The line x + v t leaves the curve where v x (P(N) - x) = 0 on the half of the normals with N.v > 0; there that function grows
    with the normal's angle, at the rate rho cos(angle from v). So its only root lies in a known interval, and Newton's method,
    safeguarded by bisection, finds it. No trigonometry is needed: N = ((1 - k^2) e + 2 k f)/(1 + k^2), low < k < high, e along v
    and f across it; -1 and 1 are the ends of that half.
    """
    speed = math.sqrt(u * u + v * v)
    eu, ev = u / speed, v / speed
    k = 0.0 if low < 0.0 < high else 0.5 * (low + high)
    nx, ny = eu, ev
    rho = a
    px, py = x, y
    for _ in range(100):
        w = 1.0 / (1.0 + k * k)
        cos, sin = (1.0 - k * k) * w, 2.0 * k * w
        nx, ny = cos * eu - sin * ev, cos * ev + sin * eu
        h = math.sqrt(p * p * nx * nx + q * q * ny * ny)
        px, py = (p * p / h - a) * nx, (q * q / h - a) * ny
        rho = p * p * q * q / (h * h * h) - a
        g = eu * (py - y) - ev * (px - x)
        if g < 0.0:
            low = k
        else:
            high = k
        # d(angle) = 2 dk/(1 + k^2)
        step = g / (2.0 * rho * cos * w) if cos > 0.0 and rho > 0.0 else NEVER
        new = k - step
        if not (low < new < high):
            new = 0.5 * (low + high)
            step = k - new
        if abs(step) < 2e-16 * (1.0 + abs(k)) or g == 0.0:
            break
        k = new
    return (eu * (px - x) + ev * (py - y)) / speed, nx, ny, rho


@kernel
def arc_exit(x: float, y: float, u: float, v: float, piece: Any, a: float) -> float:
    """Return the time at which a ball's centre meets an arc, extended by its tangents beyond the corners; or infinity.

    A line that leaves between those tangents and not through the arc has left through the other arc before.
    """
    p, q, half = piece.c, piece.r, piece.begin
    speed = math.sqrt(u * u + v * v)
    if speed == 0.0:
        return NEVER
    if half == 0.0:
        return inset_exit(x, y, u, v, p, q, a, -1.0, 1.0)[0]
    # reflect so that the long axis is that of x, and the arc the upper one
    nx, ny, reach = piece.n[0], piece.n[1], piece.end
    if p < q:
        p, q, x, y, u, v, nx, ny = q, p, y, x, v, u, ny, nx
    y, v = half * y, half * v
    eu, ev = u / speed, v / speed
    right, left = eu * nx + ev * ny, ev * ny - eu * nx
    if right <= 0.0 and left <= 0.0:
        return NEVER
    # the arc begins on the right and ends on the left: g of :func:`inset_exit` must change its sign in between
    low, high = -1.0, 1.0
    if right > 0.0:
        if -eu * y - ev * (reach - x) > 0.0:
            off: float = (nx * (reach - x) - ny * y) / (right * speed)
            return off
        low = (eu * ny - ev * nx) / (1.0 + right)
    if left > 0.0:
        if -eu * y + ev * (reach + x) < 0.0:
            off = (nx * (reach + x) - ny * y) / (left * speed)
            return off
        high = (eu * ny + ev * nx) / (1.0 + left)
    return inset_exit(x, y, u, v, p, q, a, low, high)[0]


@kernel
def arc_wall(piece: Any, a: float, x: float, y: float) -> tuple[Vec, float]:
    """Return the normal towards the ball, and the radius of curvature, for a centre at (x, y) on an arc."""
    p, q, half = piece.c, piece.r, piece.begin
    if a == 0.0:
        nx, ny = x / (p * p), y / (q * q)
        size = math.sqrt(nx * nx + ny * ny)
        nx, ny = nx / size, ny / size
        h = math.sqrt(p * p * nx * nx + q * q * ny * ny)
        return (-nx, -ny, 0.0), p * p * q * q / (h * h * h)
    # a centre that rounding put just across the long axis is on it
    if half == 0.0:
        _depth, nx, ny, rho = oval_depth(p, q, x, y)
    elif p > q:
        _depth, nx, ny, rho = oval_depth(p, q, x, max(half * y, 0.0))
        ny = half * ny
    else:
        _depth, nx, ny, rho = oval_depth(p, q, max(half * x, 0.0), y)
        nx = half * nx
    return (nx, ny, 0.0), rho - a


# --- arc length, of many points at once ------------------------------------------------------------------------------


def ellipse_arc_length(p: float, q: float, angle: Any) -> Any:
    """Return the arc length of the ellipse (p cos u, q sin u) from u = 0 to each angle, by Gauss-Legendre rules on 64 pieces."""
    nodes, weights, step, whole = _complete_pieces(p, q)
    angle = np.asarray(angle, float)
    turns = np.floor(angle / math.tau)
    angle = angle - turns * math.tau
    k = np.clip((angle // step).astype(int), 0, 63)
    rest = angle - k * step
    inner = k[..., None] * step + rest[..., None] * (nodes + 1) / 2
    return turns * whole[-1] + whole[k] + (_rate(p, q, inner) @ weights) * rest / 2


@functools.lru_cache(maxsize=64)
def _complete_pieces(p: float, q: float) -> tuple[Array, Array, float, Array]:
    """Return the rule, and the arc lengths from u = 0 to the ends of the 64 pieces."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    step = math.tau / 64
    middle = (np.arange(64)[:, None] + 0.5 + nodes / 2) * step
    return nodes, weights, step, np.concatenate([[0.0], np.cumsum((_rate(p, q, middle) @ weights) * step / 2)])


@functools.lru_cache(maxsize=64)
def _lengths_along(p: float, q: float, a: float, arc: EllipticArc) -> tuple[Array, Array]:
    """Return angles u along an arc, and the arc lengths there: where Newton's method for a point begins."""
    u = np.linspace(arc.begin, arc.end, 4001)
    first, turned = ellipse_arc_length(p, q, arc.begin), _turned(p, q, arc.begin)
    return ellipse_arc_length(p, q, u) - first - a * (_turned(p, q, u) - turned), u


def _rate(p: float, q: float, u: Any) -> Any:
    return np.sqrt((p * np.sin(u)) ** 2 + (q * np.cos(u)) ** 2)


def arc_length(p: float, q: float, a: float, arc: EllipticArc) -> float:
    """Return the length of an arc: the ellipse's minus a times the angle by which the normal turns."""
    turned = _turned(p, q, arc.end) - _turned(p, q, arc.begin)
    return float(ellipse_arc_length(p, q, arc.end) - ellipse_arc_length(p, q, arc.begin) - a * turned)


def _turned(p: float, q: float, u: Any) -> Any:
    """Return the angle of the outward normal at (p cos u, q sin u), continuous in u."""
    turns = np.round(np.asarray(u) / math.tau)
    return np.arctan2(p * np.sin(u), q * np.cos(u)) + math.tau * turns


def arc_along(p: float, q: float, a: float, arc: EllipticArc, x: Array) -> Array:
    """Return the arc length (N) from the beginning of an arc to points x (N, 2) on it."""
    n = arc_normals(p, q, arc, x)
    u = np.arctan2(-q * n[:, 1], -p * n[:, 0])
    middle = (arc.begin + arc.end) / 2
    u = np.clip(middle + (u - middle + math.pi) % math.tau - math.pi, arc.begin, arc.end)
    along = ellipse_arc_length(p, q, u) - ellipse_arc_length(p, q, arc.begin)
    found: Array = along - a * (_turned(p, q, u) - _turned(p, q, arc.begin))
    return found


def arc_place(p: float, q: float, a: float, arc: EllipticArc, s: Array) -> tuple[Array, Array]:
    """Return points (N, 2) and normals towards the ball (N, 2) at arc lengths (N) from the beginning of an arc."""
    first, turned = ellipse_arc_length(p, q, arc.begin), _turned(p, q, arc.begin)
    u = np.interp(s, *_lengths_along(p, q, a, arc))
    for _ in range(4):  # Newton; ds/du = rho dN: |E'| - a d(normal's angle)/du
        along = _rate(p, q, u)
        # (it is zero at the ends of an ellipse that is as sharp as the ball: there a step is rounding over rounding)
        rate = np.maximum(along - a * p * q / along**2, 1e-9 * along)
        step = ellipse_arc_length(p, q, u) - first - a * (_turned(p, q, u) - turned) - s
        u = np.clip(u - step / rate, arc.begin, arc.end)
    out = np.stack([q * np.cos(u), p * np.sin(u)], axis=-1)
    out /= np.linalg.norm(out, axis=-1, keepdims=True)
    return np.stack([p * np.cos(u), q * np.sin(u)], axis=-1) - a * out, -out


def arc_normals(p: float, q: float, arc: EllipticArc, x: Array) -> Array:
    """Return normals (N, 2) towards the ball at points (N, 2 or more) on an arc: :func:`arc_wall` for arrays."""
    # as in :func:`carom.core.geometry.ellipse.oval_depth`, along the long axis and across it
    swap = p < q
    (along, across), (long, short) = (x[:, ::-1][:, -2:] if swap else x[:, :2]).T, ((q, p) if swap else (p, q))
    if arc.half:
        across = arc.half * np.maximum(arc.half * across, 0.0)
    e = (long - short) * (long + short)
    t = np.maximum(np.maximum(short * np.abs(across), long * np.abs(along) - e), 1e-300)
    for _ in range(40):
        f, g, before = long * along / (t + e), short * across / t, t
        t = t + np.maximum(0.5 * (f * f + g * g - 1) / (f * f / (t + e) + g * g / t), 0.0)
        if (t == before).all():
            break
    n = np.stack([-along / (t + e), -across / t], axis=-1)
    # on the axis itself: the corner's
    at = arc.half * across <= 0
    if arc.half:
        side = np.array(arc.corner[::-1] if swap else arc.corner)
        n[at] = -np.stack([np.copysign(side[0], along[at]), np.full(at.sum(), arc.half * side[1])], axis=-1)
    found: Array = np.array(n[:, ::-1] if swap else n)
    found /= np.linalg.norm(found, axis=-1, keepdims=True)
    return found
