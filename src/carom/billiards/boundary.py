"""The boundary of the region open to a ball's centre, as pieces: their records, arc length, normals, distance to it."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.curved_wall import CurvedRegion
from carom.billiards.table_records import PIECES, WORLD
from carom.bodies import holds_arrays
from carom.core.geometry.outlines import ellipse_depth, oval_depth, polygon_depth
from carom.core.jit.kernel import Vec, kernel

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
    # as in :func:`carom.core.geometry.outlines.oval_depth`, along the long axis and across it
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


# ----------------------------------------------------------------------------------------------------
# The boundary of the region open to a ball's centre, as pieces: their records, arc length, normals, distance to it.


INF = math.inf


class Face(NamedTuple):
    """A straight wall, or a plane one in space; its fields are named as in :data:`carom.billiards.table_records.PIECES`."""

    normal: tuple[float, float, float]
    """Towards the ball."""
    offset: float
    """The face is n.x = offset, the ball at n.x > offset."""
    separation: float
    """Distance of a window of a periodic cell from the opposite one."""
    begin: float
    """Where it begins, along the tangent (ny, -nx)."""
    end: float
    low: float
    """Its beginning if that is a corner, else -infinity."""
    high: float
    """Its end if that is a corner, else infinity."""

    @property
    def is_lid(self) -> bool:
        """Whether it closes a cylinder: its normal lies along z."""
        return self.normal[2] != 0

    @property
    def length(self) -> float:
        """Its length, m."""
        return self.end - self.begin


class RoundWall(NamedTuple):
    """A circle seen from inside, or a half of one."""

    x: float
    y: float
    radius: float
    half: float
    """-1 or 1: only the half to the left or to the right of the centre; 0: the whole circle."""


class Obstacle(NamedTuple):
    """A circle seen from outside, and the arc of it that a ball can meet."""

    x: float
    y: float
    radius: float
    first: float
    """Angle at which the arc begins; it runs clockwise."""
    span: float
    """Angle of the arc."""


class ObstacleImage(NamedTuple):
    """An obstacle in a neighbouring periodic cell."""

    x: float
    y: float
    radius: float
    of: int
    """Index of the obstacle."""


class InsetEllipse(NamedTuple):
    """The parallel curve of an ellipse."""

    p: float
    """Half axis in x."""
    q: float
    """Half axis in y."""
    inset: float
    """Distance of the parallel curve from the ellipse, inwards."""


class ConnectedWall(NamedTuple):
    """Pieces of a boundary that follow each other without a gap."""

    pieces: tuple[int, ...]
    """Their indices, without windows."""
    first: float
    """Arc length at its beginning, m; -infinity for a wall without an end."""
    last: float
    """Arc length at its end, m."""
    closed: bool
    """Whether its end is its beginning."""


NO_ELLIPSE = InsetEllipse(1.0, 1.0, 0.0)


def face(
    nx: float,
    ny: float,
    c: float,
    begin: float = -INF,
    end: float = INF,
    *,
    low: float | None = None,
    high: float | None = None,
    nz: float = 0.0,
) -> Face:
    """Return the face n.x = c with the ball at n.x > c; its ends are corners unless ``low`` or ``high`` is infinite."""
    return Face((nx, ny, nz), c, 0.0, begin, end, begin if low is None else low, end if high is None else high)


@holds_arrays
@dataclass
class Boundary:
    """The pieces of the boundary by kind, and how they follow each other; once it is measured it is not changed."""

    faces: list[Face] = field(default_factory=list)
    windows: list[Face] = field(default_factory=list)
    """Sides of a periodic cell, through which a ball passes to the opposite one."""
    inside: list[RoundWall] = field(default_factory=list)
    outside: list[Obstacle] = field(default_factory=list)
    images: list[ObstacleImage] = field(default_factory=list)
    order: list[int] | None = None
    """Indices of the pieces in the order in which they follow each other along the boundary; None: by index."""
    ellipse: InsetEllipse | None = None
    curve: CurvedRegion | None = None
    """Arcs of a smooth curve."""
    sphere: float | None = None
    """Radius of a sphere about the origin."""
    finite_faces: bool = False
    """Whether hits beyond the ends of a face are ignored (a stadium, a table that is not convex)."""
    size: float = 1.0
    """Length that sets the tolerances, m."""
    vertices: Array | None = None
    """Vertices of the wall, of a polygon that is not convex: they decide what lies within."""
    clearance: float = 0.0
    """Distance that the centre keeps from that polygon."""
    cell: tuple[float, float] | None = None
    """Sides of the periodic cell about the origin; infinite where it is not periodic."""

    def arrays(self) -> tuple[Any, NDArray[np.void]]:
        """Return the WORLD record, still without ball and law, and the array of PIECES."""
        rows: list[tuple[Any, ...]] = [*self.faces]
        world = np.zeros(1, WORLD)
        world["faces"] = len(rows)
        rows += self.windows
        world["windows"] = len(rows)
        rows += [((x, y, 0.0), 1 / r, r, half, 0.0, -INF, INF) for x, y, r, half in self.inside]
        world["inside"] = len(rows)
        rows += [((x, y, 0.0), 1 / r, r, 0.0, 0.0, -INF, INF) for x, y, r, *_ in [*self.outside, *self.images]]
        world["outside"] = len(rows)
        if self.ellipse is not None:
            p, q, world["inset"] = self.ellipse
            rows += [((*arc.corner, 0.0), p, q, arc.half, arc.reach, -INF, INF) for arc in self.arcs]
        world["arc_corners"], world["ellipses"] = len(self.arcs) > 1, len(rows)
        if self.curve is not None:
            world["inset"], world["arc_corners"] = self.curve.inset, any(max(arc[3:]) for arc in self.curve.arcs)
            rows += self.curve.pieces()
        world["curves"] = len(rows)
        if self.sphere is not None:
            rows.append(((0.0, 0.0, 0.0), 1 / self.sphere, self.sphere, 0.0, 0.0, -INF, INF))
        world["spheres"] = len(rows)
        world["finite_faces"], world["corner_tolerance"] = self.finite_faces, 1e-12 * self.size
        world["extent"] = self.size
        return world, np.array(rows, PIECES)

    def crossed_by(self, acceleration: Sequence[float]) -> bool:
        """Return whether an acceleration has a component across a wall or a window."""
        flat = bool(acceleration[0] or acceleration[1])
        if any(
            n[0] * acceleration[0] + n[1] * acceleration[1] + n[2] * acceleration[2]
            for n, *_ in [*self.faces, *self.windows]
        ):
            return True
        round_in_plane = self.inside or self.outside or self.ellipse or self.curve
        return flat if round_in_plane else self.sphere is not None and any(acceleration)

    @property
    def arcs(self) -> list[EllipticArc]:
        """Arcs of the centre's curve in an ellipse."""
        return [] if self.ellipse is None else arcs(*self.ellipse)

    @property
    def _last_arcs(self) -> int:
        """How many arcs of ellipses and smooth curves there are."""
        return len(self.arcs) + (0 if self.curve is None else len(self.curve.arcs))

    @property
    def parts(self) -> NDArray[np.int64]:
        """Number of the smooth part of each piece, without windows and images: arcs of a smooth curve between corners are one."""
        pieces = np.arange(len(self.lengths))
        if self.curve is not None:
            first = len(pieces) - len(self.curve.arcs)
            pieces[first:] = first + self.curve.parts
        return pieces

    def wall_parts(self, met: Any) -> NDArray[np.int64]:
        """Return the smooth parts of pieces (...) that are met, without windows and with images as their obstacles; -1 for none."""
        found: NDArray[np.int64] = np.append(self.parts, -1)[self._number(np.asarray(met, np.int64))]
        return found

    def without_lids(self) -> Boundary:
        """Return the boundary of the section of a prism: its pieces but the lids, which follow the other faces."""
        sides, faces = sum(not f.is_lid for f in self.faces), len(self.faces)
        order = self.order and [k - (faces - sides) * (k >= faces) for k in self.order if not sides <= k < faces]
        return replace(self, faces=self.faces[:sides], order=order)

    # --- arc length ---------------------------------------------------------------------------------------------------

    @functools.cached_property
    def lengths(self) -> Array:
        """Length of each piece, without windows and images; infinite for a strip and a wedge."""
        found = [f.length for f in self.faces]
        found += [(math.pi if half else math.tau) * r for _x, _y, r, half in self.inside]
        found += [span * r for _x, _y, r, _first, span in self.outside]
        found += [arc_length(*(self.ellipse or NO_ELLIPSE), arc) for arc in self.arcs]
        return np.array(found + ([] if self.curve is None else self.curve.lengths))

    @functools.cached_property
    def starts(self) -> Array:
        """Arc length at which each piece begins."""
        lengths = np.where(np.isfinite(self.lengths), self.lengths, 0.0)
        order = list(range(len(lengths))) if self.order is None else self.order
        starts = np.empty(len(lengths))
        starts[order] = np.concatenate([[0.0], np.cumsum(lengths[order])[:-1]])
        return starts

    def _number(self, piece: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the indices of pieces as they are without windows, and with an image counted as its obstacle."""
        faces, circles = len(self.faces), len(self.inside) + len(self.outside)
        table = np.arange(-1, faces + len(self.windows) + circles + len(self.images) + max(1, self._last_arcs))
        # entry 0 is for piece -1, none
        table[1 + faces + len(self.windows) :] -= len(self.windows)
        first = 1 + faces + len(self.windows) + circles
        table[first : first + len(self.images)] = [faces + len(self.inside) + of for *_, of in self.images]
        table[first + len(self.images) :] -= len(self.images)
        return table[piece + 1]

    def coordinate(self, met: Any, x: Any) -> Array:
        """Return the arc length s (...) of points (..., 2 or 3) on pieces (...); it grows with the ball on the left."""
        number = self._number(np.asarray(met, int))
        x = self.folded(np.asarray(x, float))
        starts = self.starts
        s = np.full(number.shape, np.nan)
        k = 0
        for n, _c, _r, begin, _end, _low, _high in self.faces:
            here = number == k
            along = n[1] * x[here][:, 0] - n[0] * x[here][:, 1]
            s[here] = starts[k] + along - (begin if math.isfinite(begin) else 0.0)
            k += 1
        for cx, cy, r, half in self.inside:
            here = number == k
            angle = np.arctan2(x[here][:, 1] - cy, x[here][:, 0] - cx)
            s[here] = starts[k] + r * ((angle + half * math.pi / 2) % math.tau)
            k += 1
        for cx, cy, r, first, _span in self.outside:
            here = number == k
            d = self.folded(x[here][:, :2] - (cx, cy))
            s[here] = starts[k] + r * ((first - np.arctan2(d[:, 1], d[:, 0])) % math.tau)
            k += 1
        for arc in self.arcs:
            here = number == k
            s[here] = starts[k] + arc_along(*(self.ellipse or NO_ELLIPSE), arc, x[here])
            k += 1
        if self.curve is not None:
            for m in range(len(self.curve.arcs)):
                here = number == k + m
                s[here] = starts[k + m] + self.curve.along(m, x[here][:, :2])
        return s

    def place(self, s: Any) -> tuple[NDArray[np.int64], Array, Array]:
        """Return the piece, the point (..., 2) and the normal (..., 2) at an arc length (...) of a closed boundary."""
        lengths, starts = self.lengths, self.starts
        order = np.argsort(starts, kind="stable")
        s = np.asarray(s, float) % lengths.sum()
        k = order[np.clip(np.searchsorted(starts[order], s, side="right") - 1, 0, len(order) - 1)]
        along = s - starts[k]
        x, n = np.empty((*s.shape, 2)), np.empty((*s.shape, 2))
        for m in range(len(lengths)):
            here = k == m
            x[here], n[here] = self._place_on(m, along[here])
        piece = np.where(k >= len(self.faces), k + len(self.windows), k)
        return (
            np.where(k >= len(self.faces) + len(self.inside) + len(self.outside), piece + len(self.images), piece),
            x,
            n,
        )

    def _place_on(self, k: int, along: Array) -> tuple[Array, Array]:
        """Return points and normals (N, 2) of a piece, by its index without windows, at lengths (N,) from its beginning."""
        if k < len(self.faces):
            normal, c, _r, begin, *_ends = self.faces[k]
            t = np.array([normal[1], -normal[0]])
            return np.multiply(normal[:2], c) + np.multiply.outer(along + begin, t), np.tile(
                normal[:2], (len(along), 1)
            )
        k -= len(self.faces)
        if k < len(self.inside):
            cx, cy, r, half = self.inside[k]
            angle = along / r - half * math.pi / 2
            n = -np.stack([np.cos(angle), np.sin(angle)], axis=-1)
            return np.array([cx, cy]) - r * n, n
        k -= len(self.inside)
        if k < len(self.outside):
            cx, cy, r, first, _span = self.outside[k]
            angle = first - along / r
            n = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
            return np.array([cx, cy]) + r * n, n
        if self.curve is not None:
            return self.curve.place(k - len(self.outside), along)
        return arc_place(*(self.ellipse or NO_ELLIPSE), self.arcs[k - len(self.outside)], along)

    @functools.cached_property
    def connected(self) -> list[ConnectedWall]:
        """Return the walls whose pieces follow each other without a gap, in the order of their arc lengths; no lids.

        Walls without an end share one coordinate, and are one.
        """
        lengths, starts = self.lengths, self.starts
        endless = [k for k, one in enumerate(self.faces) if math.isinf(one.length) and not one.is_lid]
        found = [ConnectedWall(tuple(endless), -INF, INF, False)] if endless else []
        order = range(len(lengths)) if self.order is None else self.order
        pieces: list[int] = []
        ends: dict[int, Array] = {}
        for k in [k for k in order if math.isfinite(lengths[k])]:
            ends[k] = self._place_on(k, np.array([0.0, lengths[k]]))[0]
            if pieces and not self._together(ends[pieces[-1]][1], ends[k][0]):
                found.append(self._wall_of(pieces, ends, starts, lengths))
                pieces = []
            pieces.append(k)
        return [*found, self._wall_of(pieces, ends, starts, lengths)] if pieces else found

    def _wall_of(self, pieces: list[int], ends: dict[int, Array], starts: Array, lengths: Array) -> ConnectedWall:
        first, last = pieces[0], pieces[-1]
        closed = self._together(ends[last][1], ends[first][0])
        return ConnectedWall(tuple(pieces), float(starts[first]), float(starts[last] + lengths[last]), closed)

    def _together(self, x: Array, y: Array) -> bool:
        """Return whether two points (2,) are the same one, or images of it."""
        return bool(np.abs(self.folded(x - y)).max() < 1e-9 * self.size)

    def wall_numbers(self, met: Any) -> NDArray[np.int64]:
        """Return which of the connected walls pieces (...) belong to; -1 for lids, spheres and none."""
        pieces = np.full(len(self.lengths) + 2, -1)  # (beyond them a sphere; the last entry is for piece -1, none)
        for number, wall in enumerate(self.connected):
            pieces[list(wall.pieces)] = number
        found: NDArray[np.int64] = pieces[self._number(np.asarray(met, int))]
        return found

    def normals(self, met: Any, x: Any) -> Array:
        """Return normals (..., 3) towards the ball at points (..., 2 or 3) on pieces (...); NaN where the piece is -1."""
        number = self._number(np.asarray(met, int))
        x = np.asarray(x, float)
        n = np.full((*number.shape, 3), np.nan)
        k = 0
        for normal, *_ in self.faces:
            n[number == k] = normal
            k += 1
        for sign, circles in ((-1, self.inside), (1, self.outside)):
            for cx, cy, r, *_ in circles:
                here = number == k
                d = self.folded(x[here][:, :2] - (cx, cy)) / r
                n[here] = np.concatenate([sign * d, np.zeros((len(d), 1))], axis=-1)
                k += 1
        for arc in self.arcs:
            here = number == k
            n[here, :2], n[here, 2] = arc_normals(*(self.ellipse or NO_ELLIPSE)[:2], arc, x[here]), 0.0
            k += 1
        if self.curve is not None:
            for m in range(len(self.curve.arcs)):
                here = number == k + m
                n[here, :2], n[here, 2] = self.curve.normals(m, x[here][:, :2]), 0.0
        if self.sphere is not None:
            here = number == k
            n[here] = -x[here] / self.sphere
        return n

    def curvatures(self, met: Any, x: Any) -> Array:
        """Return curvatures (N) of the centre's curve at points (N, 2 or more) on pieces (N): 1/r in a circle, -1/r around one."""
        number, x = self._number(np.asarray(met, int)), np.asarray(x, float)
        radii = [math.inf for _ in self.faces] + [one[2] for one in self.inside] + [-one[2] for one in self.outside]
        found: Array = 1.0 / np.array([*radii, *(math.inf for _ in range(self._last_arcs)), math.inf])[number]
        p, q, inset = self.ellipse or NO_ELLIPSE
        for k, arc in enumerate(self.arcs, start=len(radii)):
            here = number == k
            n = arc_normals(p, q, arc, x[here])
            found[here] = 1.0 / (p * p * q * q / np.hypot(p * n[:, 0], q * n[:, 1]) ** 3 - inset)
        if self.curve is not None:
            for k in range(len(self.curve.arcs)):
                here = number == len(radii) + k
                found[here] = self.curve.curvatures(k, x[here][:, :2])
        return found

    def folded(self, x: Array) -> Array:
        """Return points translated into the periodic cell, whose centre is the origin."""
        if self.cell is None:
            return x
        x = x.copy()
        for j, side in enumerate(self.cell):
            if math.isfinite(side):
                x[..., j] -= side * np.round(x[..., j] / side)
        return x

    # --- distance to the boundary ---------------------------------------------------------------------------------------------

    def gap(self, x: Any) -> Array:
        """Return a lower bound (...) of the distance of centres (..., 2 or 3) to the boundary; negative outside."""
        x = self.folded(np.asarray(x, float))
        x = np.concatenate([x, np.zeros((*x.shape[:-1], 3 - x.shape[-1]))], axis=-1)
        gap: Array = np.full(x.shape[:-1], INF)
        if self.vertices is not None:
            gap = polygon_depth(self.vertices, x) - self.clearance
        elif self.faces:
            for n, c, *_ in self.faces:
                gap = np.minimum(gap, x @ np.array(n) - c)
        if any(half for *_, half in self.inside):
            (right, _y, r, _h) = max(self.inside)
            d = np.hypot(np.maximum(np.abs(x[..., 0]) - right, 0), x[..., 1])
            gap = np.minimum(gap, r - d)
        else:
            for cx, cy, r, _half in self.inside:
                gap = np.minimum(gap, r - np.hypot(x[..., 0] - cx, x[..., 1] - cy))
        for cx, cy, r, *_ in [*self.outside, *self.images]:
            gap = np.minimum(gap, np.hypot(x[..., 0] - cx, x[..., 1] - cy) - r)
        if self.ellipse is not None:
            p, q, inset = self.ellipse
            gap = np.minimum(gap, ellipse_depth(p, q, x) - inset)
        if self.curve is not None:
            depth = self.curve.wall.depth(x[..., :2].reshape(-1, 2)).reshape(gap.shape)
            gap = np.minimum(gap, depth - self.curve.inset)
        if self.sphere is not None:
            gap = np.minimum(gap, self.sphere - np.linalg.norm(x, axis=-1))
        return gap
