"""Polygons and ellipses as outlines: how far within them points lie, whether their sides cross. NumPy, many points at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["crosses", "ellipse_depth", "polygon_depth"]

Array = NDArray[np.float64]


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


def crosses(vertices: Array) -> bool:
    """Whether two sides of a polygon meet that are no neighbours, or neighbours lie on each other."""
    p, q = vertices, np.roll(vertices, -1, axis=0)
    for i in range(len(p)):
        d, after = q[i] - p[i], q[(i + 1) % len(p)] - q[i]
        if d[0] * after[1] == d[1] * after[0] and d @ after < 0:
            return True
        for j in range(i + 2, len(p) - (i == 0)):
            e, f = q[j] - p[j], p[j] - p[i]
            det = d[0] * e[1] - d[1] * e[0]
            if det and 0 <= (f[0] * e[1] - f[1] * e[0]) / det <= 1 and 0 <= (f[0] * d[1] - f[1] * d[0]) / det <= 1:
                return True
    return False


def ellipse_depth(p: float, q: float, x: Array) -> Array:
    """Distance (...) of points x (..., 2 or more) to the ellipse (p cos u, q sin u): positive inside, else negative."""
    (p, u), (q, v) = sorted([(p, np.abs(x[..., 0])), (q, np.abs(x[..., 1]))], key=lambda pair: -pair[0])
    # the nearest point is (p^2 u/(p^2 + m), q^2 v/(q^2 + m)), where (p u/(p^2 + m))^2 + (q v/(q^2 + m))^2 = 1 and m > -q^2
    low, high = np.full(u.shape, -q * q), p * u + q * v
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(60):
            m = (low + high) / 2
            beyond = (p * u / (p * p + m)) ** 2 + (q * v / (q * q + m)) ** 2 > 1
            low, high = np.where(beyond, m, low), np.where(beyond, high, m)
        eu = np.minimum(p * p * u / (p * p + high), p) if p > q else p * u / np.maximum(np.hypot(u, v), 1e-300)
    ev = q * np.sqrt(np.maximum(1 - (eu / p) ** 2, 0))
    distance = np.hypot(eu - u, ev - v)
    found: Array = np.where((u / p) ** 2 + (v / q) ** 2 < 1, distance, -distance)
    return found
