"""Polygons and ellipses as outlines: depth of points inside, validation. For many points at once, with NumPy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import kernel
from carom.core.roots.first_root import hit4, least_of_chord, newton_or_half

Array = NDArray[np.float64]
NEAR = 1e-9  # of a polygon's longest side: what lies so close is in one place
MOST = 8  # problems of an outline that are reported


def polygon_depth(vertices: Array, x: Array) -> Array:
    """Distance (...) of points x (..., 2 or more) to a polygon with vertices (N, 2) in order: positive inside, else negative."""
    nearest: Any = np.inf
    odd = np.zeros(x.shape[:-1], bool)
    for (px, py), (qx, qy) in zip(vertices.tolist(), np.roll(vertices, -1, axis=0).tolist(), strict=True):
        rx, ry, ex, ey = x[..., 0] - px, x[..., 1] - py, qx - px, qy - py
        u = np.clip((rx * ex + ry * ey) / (ex * ex + ey * ey), 0, 1)
        nearest = np.minimum(nearest, np.hypot(rx - u * ex, ry - u * ey))
        if ey != 0:  # sides cut by the level line to the right of the point
            odd ^= ((py > x[..., 1]) != (qy > x[..., 1])) & (x[..., 0] < px + ry * ex / ey)
    found: Array = np.where(odd, nearest, -nearest)
    return found


def outline_faults(corners: Array) -> list[tuple[str, str]]:
    """Faults of points (N, 2), N >= 3, as the corners of a polygon in order: pairs of expectation and finding.

    Corners in one place, sides that run back along the one before (a slit or a spike of no width), that lie on each other, that
    cross, corners on other sides. What is closer than 1e-9 of the longest side is in one place. Corners are counted from 1; where
    there are many, the first are reported.
    """
    every = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    near = NEAR * float(every.max())
    # one of corners that follow each other in one place is enough for all that comes after
    keep = np.flatnonzero(np.roll(every, 1) > near)
    found = [
        (
            "each corner once",
            f"corners {_which(k, n)} both at {_at(corners[k])}; "
            + ("the last side closes by itself: leave the last corner out" if k == n - 1 else "leave one out"),
        )
        for n in [len(corners)]
        for k in np.flatnonzero(every <= near).tolist()
    ]
    p = corners[keep]
    if len(p) < 3 or np.linalg.svd(p - p[0], compute_uv=False)[-1] <= near:
        return [*found[:MOST], ("corners around some area", "corners that are all on one line")]
    found += _meetings(p, keep, near)
    more = len(found) - MOST
    return found if more <= 0 else [*found[:MOST], ("an outline without faults", f"{more} more of these")]


def _at(x: Array) -> str:
    return f"({x[0]:.6g}, {x[1]:.6g})"


def _which(k: int, n: int) -> str:
    """A corner and the next one."""
    return f"{k + 1} and {(k + 1) % n + 1}" if k < n - 1 else f"1 and {n}"


def _meetings(p: Array, number: NDArray[np.int64], near: float) -> list[tuple[str, str]]:
    """Where sides of an outline p (N, 2) meet that should not; ``number`` (N) says which corner each was."""
    n = len(p)
    q, after = np.roll(p, -1, axis=0), np.roll(np.arange(n), -1)
    d = q - p
    length = np.linalg.norm(d, axis=1)
    t = d / length[:, None]
    name = [f"{number[k] + 1} to {number[after[k]] + 1}" for k in range(n)]
    turn = np.arctan2(t[:, 0] * t[after, 1] - t[:, 1] * t[after, 0], (t * t[after]).sum(1))
    if ((turn > 0).all() or (turn < 0).all()) and np.abs(turn).max() < 3 and abs(turn.sum()) < 7:
        return []  # convex, and once around
    # run back: the side after it lies on it
    back = (t * t[after]).sum(1) < 0
    back &= np.abs(t[:, 0] * d[after, 1] - t[:, 1] * d[after, 0]) <= near
    reported = {(int(k), int(after[k])) for k in np.flatnonzero(back)}
    found = [
        (
            "sides that do not run back along the one before",
            f"the side from corner {name[after[k]]} back along that from {name[k]}: it encloses no width;"
            f" give it one, or leave corner {number[after[k]] + 1} out",
        )
        for k in np.flatnonzero(back).tolist()
    ]
    touches: list[tuple[int, int]] = []
    for i in range(n):
        # of all corners: how far along side i, and how far off its line
        along, off = (p - p[i]) @ t[i], t[i, 0] * (p[:, 1] - p[i, 1]) - t[i, 1] * (p[:, 0] - p[i, 0])
        on = (np.abs(off) <= near) & (along >= -near) & (along <= length[i] + near)
        touches += [(k, i) for k in np.flatnonzero(on).tolist() if k not in (i, after[i])]
        later = np.arange(i + 2, n - (i == 0))
        if not len(later):
            continue
        one, two = along[later], along[after[later]]
        flat = (np.abs(off[later]) <= near) & (np.abs(off[after[later]]) <= near)
        low, high = np.minimum(one, two), np.maximum(one, two)
        for j in later[flat & (np.minimum(high, length[i]) - np.maximum(low, 0) > near)].tolist():
            reported.add((i, j))
            found.append(
                ("sides that do not lie on each other", f"those from corner {name[i]} and from corner {name[j]}")
            )
        # the ends of each well on either side of the other
        x, y = p[i] - p[later], q[i] - p[later]
        left, right = (t[later, 0] * z[:, 1] - t[later, 1] * z[:, 0] for z in (x, y))
        a, b = off[later], off[after[later]]
        for j in np.flatnonzero(
            (np.minimum(a, b) < -near) & (np.maximum(a, b) > near)
            & (np.minimum(left, right) < -near) & (np.maximum(left, right) > near)
        ).tolist():  # fmt: skip
            where = p[later[j]] + (p[after[later[j]]] - p[later[j]]) * (a[j] / (a[j] - b[j]))
            found.append(
                (
                    "sides that do not cross",
                    f"those from corner {name[i]} and from corner {name[later[j]]}, which meet at {_at(where)}",
                )
            )
    for k, i in touches:
        end = next((m for m in (i, int(after[i])) if np.linalg.norm(p[k] - p[m]) <= near), None)
        sides = {i} if end is None else {(end - 1) % n, end}
        if any({(one, two), (two, one)} & reported for one in ((k - 1) % n, k) for two in sides):
            continue  # (it is said above)
        if end is None:
            got = f"corner {number[k] + 1}, {_at(p[k])}, on the side from corner {name[i]}"
        elif k < end == i:  # (each pair once)
            got = f"corners {number[k] + 1} and {number[end] + 1} both at {_at(p[k])}"
        else:
            continue
        found.append(("an outline that does not touch itself", got))
    return found


def ellipse_depth(p: float, q: float, x: Array) -> Array:
    """Distance (...) of points x (..., 2 or more) to the ellipse (p cos u, q sin u): positive inside, else negative.

    For arrays; :func:`carom.core.geometry.outlines.oval_depth` has the equation.
    """
    (p, u), (q, v) = sorted([(p, np.abs(x[..., 0])), (q, np.abs(x[..., 1]))], key=lambda pair: -pair[0])
    e = (p - q) * (p + q)
    t = np.maximum(q * v, p * u - e)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(100):
            a, b = p * u / (t + e), q * v / t
            step = 0.5 * (a * a + b * b - 1.0) / (a * a / (t + e) + b * b / t)
            t = t + np.where(t > 0, step, 0.0)
            if not (step > 1e-15 * t).any():
                break
        off_axis = (q * q - t) * np.hypot(u / (t + e), v / t)
        # on the long axis, between the centres of curvature of its ends: two points are nearest
        c = p * u / e if e > 0 else np.zeros_like(u)
        on_axis = q * np.sqrt(np.maximum((1.0 - c) * (1.0 + c), 0.0) + (c * q / p) ** 2)
    found: Array = np.where(t > 0, off_axis, on_axis)
    return found


# ----------------------------------------------------------------------------------------------------
# Find when a ball inside an ellipse touches it: the curve that bounds its centre is at the distance of the radius.
#
# That curve has no simple equation, but its distance from a point has what is needed. Within a convex curve the distance D from
# it is concave, and its gradient the unit normal there. So on a parabola with the acceleration g
#
# G(s) = D(x(s)) - d,    G'' <= |g|,
#
# and where G is positive at both ends of a stretch of time L, it is at least the chord less |g| t (L - t)/2: a bound that says
# at once that nothing is met. Where G changes its sign and G' + |g| L < 0 at the beginning, it falls throughout and has one root.
# Every other stretch is halved; so the first root is not missed, and a ball may be larger than the smallest circle of curvature.
#
# Two ellipses tell where to look at all, both by their support functions; that of the curve of the centres is at most h(N) - d,
# where h(N) = sqrt(p^2 Nx^2 + q^2 Ny^2) and p >= q. The outer one has the half axes p - d and q - d: its support function is at
# least h - d, by the triangle inequality; when a ball leaves it, it has met the wall. The inner one, which it can only leave
# first, has sqrt((q - d)(p^2/q - d)) and q - d: the square of its support function is (h - d)^2 less d (h - q)^2/q.


SMALL = 1e-16  # of the half axis: so short a way is none
NOISE = 4e-16  # of the half axes: so much of a gap is rounding
BEYOND = 1.0 + 1e-9  # so much is surely more than what rounding does


@kernel
def oval_depth(p: float, q: float, x: float, y: float) -> tuple[float, float, float, float]:
    """Distance to the ellipse (p cos u, q sin u), positive within; the normal towards the inside; the radius of curvature there."""
    swap = p < q
    if swap:
        p, q, x, y = q, p, y, x
    # The nearest point is (p^2 x/(t + e), q^2 y/t), where (p x/(t + e))^2 + (q y/t)^2 = 1, e = p^2 - q^2. The left side falls
    # and is convex in t > 0: Newton's steps come from the left and never pass the root.
    e = (p - q) * (p + q)
    u, v = abs(x), abs(y)
    t = max(q * v, p * u - e)
    if t > 0.0:
        for _ in range(100):
            a, b = p * u / (t + e), q * v / t
            f = a * a + b * b - 1.0
            step = 0.5 * f / (a * a / (t + e) + b * b / t)
            t = t + step
            if step <= 1e-15 * t:  # (so much is rounding)
                break
        fx, fy = x / (t + e), y / t
        size = math.sqrt(fx * fx + fy * fy)
        depth = (q * q - t) * size
        nx, ny = -fx / size, -fy / size
    else:
        # on the long axis, between the centres of curvature of its ends: two points are nearest
        c = p * u / e if e > 0.0 else 0.0
        b = math.sqrt((1.0 - c) * (1.0 + c))
        depth = q * math.sqrt(b * b + (c * q / p) * (c * q / p))
        nx, ny = -(c * q * q / p) / depth, -q * b / depth
        if x < 0.0:
            nx = -nx
    h = math.sqrt(p * p * nx * nx + q * q * ny * ny)
    rho = p * p * q * q / (h * h * h)
    if swap:
        return depth, ny, nx, rho
    return depth, nx, ny, rho


@kernel
def inner_axes(p: float, q: float, d: float) -> tuple[float, float]:
    """Half axes of an ellipse within the curve at the distance d inside the ellipse of the half axes p and q."""
    if p >= q:
        return math.sqrt((q - d) * (p * p / q - d)), q - d
    return p - d, math.sqrt((p - d) * (q * q / p - d))


@kernel
def _parabola_exit(
    p: float, q: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float, most: float
) -> float:
    """When a parabola leaves the ellipse of the half axes p and q; 0 if it is not in it."""
    x, y, vx, vy, gx, gy = x / p, y / q, vx / p, vy / q, gx / p, gy / q
    c0 = 1.0 - (x * x + y * y)
    if c0 <= 0.0:
        return 0.0
    return hit4(
        c0, -2.0 * (x * vx + y * vy), -(vx * vx + vy * vy + x * gx + y * gy), -(vx * gx + vy * gy), -(gx * gx + gy * gy) / 4.0,
        most, 0.0,
    )  # fmt: skip


@kernel
def _gap_and_rate(
    p: float, q: float, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float, s: float
) -> tuple[float, float]:
    """The gap at a time s, and its rate."""
    h = s / 2.0
    depth, nx, ny, _rho = oval_depth(p, q, x + (vx + gx * h) * s, y + (vy + gy * h) * s)
    return depth - (d + dd * s), nx * (vx + gx * s) + ny * (vy + gy * s) - dd


@kernel
def _gap_root(
    p: float, q: float, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    low: float, high: float, g: float, u: float,
) -> float:  # fmt: skip
    """The one root between low, where the gap is not negative, and high, where it is g and falls with u: Newton, or halving."""
    s = high
    for _ in range(200):
        new = newton_or_half(s, g, u, low, high)
        if abs(new - s) <= 4e-16 * high or not low < new < high:
            return new
        s = new
        g, u = _gap_and_rate(p, q, d, dd, x, y, vx, vy, gx, gy, s)
        if g > 0.0:
            low = s
        else:
            high = s
    return s


@kernel
def _first_gap_root(
    p: float, q: float, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    s0: float, g0: float, u0: float, right: float, end: float, pull: float, tiny: float,
) -> float:  # fmt: skip
    """The first root from s0, where the gap is g0 > 0 and its rate u0, to the end, first up to right; or infinity."""
    if g0 <= 0.0:  # (by rounding)
        return s0
    while s0 < end:
        g1, u1 = _gap_and_rate(p, q, d, dd, x, y, vx, vy, gx, gy, right)
        length = right - s0
        short = length <= max(tiny, 4e-16 * right)
        if g1 > 0.0:
            if short or least_of_chord(g0, g1, length, pull) >= 0.0:
                s0, g0, u0 = right, g1, u1
                right = min(right + 2.0 * max(length, tiny, 4e-16 * right), end)
                continue
        elif u0 + pull * length < 0.0 or pull == 0.0:
            return _gap_root(p, q, d, dd, x, y, vx, vy, gx, gy, s0, right, g1, u1)
        elif short:
            return right
        right = s0 + length / 2.0
    return math.inf


@kernel
def _gap_acceleration(p: float, q: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float) -> float:
    """The gap's second derivative."""
    depth, nx, ny, rho = oval_depth(p, q, x, y)
    along = vx * ny - vy * nx
    return nx * gx + ny * gy - along * along / max(rho - depth, SMALL * q)


@kernel
def _leave_contact(
    p: float, q: float, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    end: float, near: float, tiny: float,
) -> tuple[float, float, float, bool]:  # fmt: skip
    """From a touch on: when the gap is more than rounding, gap and rate then, and True; or when it comes down before, and False.

    The rate is known better than the gap, which at first is nothing but rounding.
    """
    s, step = 0.0, tiny
    while s < end:
        s = min(s + step, end)
        g, u = _gap_and_rate(p, q, d, dd, x, y, vx, vy, gx, gy, s)
        if g > near:
            return s, g, u, True
        if u < 0.0:
            return s, g, u, False
        step = step + step
    return math.inf, 0.0, 0.0, False


@kernel
def oval_hit(
    p: float, q: float, d: float, dd: float, last: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    most: float, slow: float,
) -> float:  # fmt: skip
    """Return the time within ``most`` at which a ball's centre comes nearer to the ellipse than d + dd s, or infinity.

    ``last`` is the largest d + dd s. As in :mod:`carom.core.roots.first_root`, a ball that is already nearer hits now if it
    approaches faster than slow, and not at all while it recedes.
    """
    pull = math.sqrt(gx * gx + gy * gy)
    speed = math.sqrt(vx * vx + vy * vy)
    if speed == 0.0 and pull == 0.0 and dd == 0.0:
        return math.inf
    g, u = _gap_and_rate(p, q, d, dd, x, y, vx, vy, gx, gy, 0.0)
    s, near, bend = 0.0, NOISE * (p + q), 0.0
    touches = g <= near
    if touches:
        bend = _gap_acceleration(p, q, x, y, vx, vy, gx, gy)
        if u < -slow or (u <= 0.0 and bend < 0.0):
            return 0.0
    # outside of this one it has met the wall, which it has too when nothing is left for its centre
    end = min(most, _parabola_exit((p - d) * BEYOND, (q - d) * BEYOND, x, y, vx, vy, gx, gy, most))
    if dd > 0.0:
        end = min(end, (min(p, q) - d) / dd)
    tiny = SMALL * q / (speed + pull * end + abs(dd))
    right = end
    if touches:
        hop = -3.0 * u / bend if bend < 0.0 else math.inf
        s, g, u, off = _leave_contact(p, q, d, dd, x, y, vx, vy, gx, gy, end, near, tiny)
        if not off:
            return s
        right = min(end, s + hop)
    else:
        a, b = inner_axes(p, q, last)
        s = _parabola_exit(a, b, x, y, vx, vy, gx, gy, most)
        if s >= most:
            return math.inf
        if s > 0.0:
            g, u = _gap_and_rate(p, q, d, dd, x, y, vx, vy, gx, gy, s)
    return _first_gap_root(p, q, d, dd, x, y, vx, vy, gx, gy, s, g, u, right, end, pull, tiny)
