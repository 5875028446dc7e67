"""Smooth curves and their first crossings with lines and parabolas by brute force; places, normals, curvatures to 40 digits.

Independent of carom: curves r(theta) as sums of cosines with derivatives by hand, many nodes, false position in the parameter.
(Carom's cache keeps the compiled search, which calls nothing but NumPy.)
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import numpy as np
from mpmath import mp, mpf
from scipy.spatial import cKDTree

from carom.core.jit.compile import njit

__all__ = ["CURVES", "PolarSum", "bounces_in", "depth", "first_crossings", "on_parallel", "precise_frame", "random_sum"]

Array = Any


@dataclass(frozen=True)
class PolarSum:
    """r = 1 + sum of c cos(k theta + phase), stretched by ``tall`` in y; counterclockwise."""

    terms: tuple[tuple[int, float, float], ...]
    tall: float = 1.0

    def span(self) -> tuple[float, float]:
        return 0.0, 2 * np.pi

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        t = np.asarray(t, float)
        r, d, dd = np.ones_like(t), np.zeros_like(t), np.zeros_like(t)
        for k, c, phase in self.terms:
            r, d, dd = (
                r + c * np.cos(k * t + phase),
                d - k * c * np.sin(k * t + phase),
                dd - k * k * c * np.cos(k * t + phase),
            )
        u, n = np.stack([np.cos(t), np.sin(t)], -1), np.stack([-np.sin(t), np.cos(t)], -1)
        tall = np.array([1.0, self.tall])
        x, y, z = r[..., None] * u, d[..., None] * u + r[..., None] * n, (dd - r)[..., None] * u + 2 * d[..., None] * n
        return x * tall, y * tall, z * tall

    def holds(self, x: Array) -> Array:
        """Return whether points (N, 2) are within the curve."""
        y = x / np.array([1.0, self.tall])
        t = np.arctan2(y[:, 1], y[:, 0])
        return (y * y).sum(-1) < (1 + sum(c * np.cos(k * t + phase) for k, c, phase in self.terms)) ** 2


def random_sum(seed: int) -> PolarSum:
    """Return a random curve with inflections."""
    rng = np.random.default_rng(seed)
    return PolarSum(tuple((k, float(0.35 * rng.normal() / k**1.7), float(rng.uniform(0, 7))) for k in range(2, 8)))


CURVES = {
    "ellipse": (PolarSum((), 0.8), 0.0), "inset ellipse": (PolarSum((), 0.8), 0.3), "swallowtail": (PolarSum((), 0.4), 0.25),
    "limacon": (PolarSum(((1, 0.3, 0.0),)), 0.0), "oval": (PolarSum(((2, 0.1, 0.0),)), 0.1),
    "flower": (PolarSum(((5, 0.3, 0.0),)), 0.0),
    **{f"random {k}": (random_sum(k), a) for k, a in ((1, 0.0), (2, 0.02), (3, 0.0), (5, 0.03))},
}  # fmt: skip


def on_parallel(curve: Any, a: float, t: Array) -> Array:
    """Return the centres (N, 2) of balls of radius a that touch the curve at parameters (N)."""
    x, d, _dd = curve.at(t)
    n = np.stack([-d[..., 1], d[..., 0]], -1) / np.linalg.norm(d, axis=-1, keepdims=True)
    return x + a * n


def depth(curve: Any, x: Array, nodes: int = 2048) -> Array:
    """Return distances (N) of points (N, 2) from the curve, without a sign: from the nearest node by Newton's method."""
    t = np.linspace(0, 2 * np.pi, nodes + 1)[:-1]
    u = t[cKDTree(curve.at(t)[0]).query(x)[1]]
    for _ in range(8):
        q, d, dd = curve.at(u)
        rate = (d * d).sum(-1) + ((q - x) * dd).sum(-1)
        step = np.clip(((q - x) * d).sum(-1) / np.where(rate > 0, rate, np.inf), -3 / nodes, 3 / nodes)
        u = u - step
        if len(u) == 0 or np.abs(step).max() < 1e-9:
            break
    return np.linalg.norm(curve.at(u)[0] - x, axis=-1)


def first_crossings(
    curve: Any, a: float, x: Array, v: Array, g: Array, until: Array, nodes: int = 4096, after: float = 1e-6
) -> Array:
    """Return times (N) at which points on parabolas first cross the parallel curve outwards between two times; infinity for none.

    Crossings are seen as a change of sign between nodes of the curve, and found by false position (Illinois) in its parameter.
    """
    best = np.full(len(x), np.inf)
    t = np.linspace(0, 2 * np.pi, nodes + 1)
    p = on_parallel(curve, a, t)
    pull = float(np.linalg.norm(g))
    for first in range(0, len(x), 20_000):
        here = slice(first, first + 20_000)
        k, i, sign = _compiled()(p, x[here], v[here], g, pull, after, until[here] + 1e-5)
        y, w = x[here][k], v[here][k]
        low, high = t[i], t[i + 1]
        c0, c1 = _gap(p[i], y, w, g, sign)[0], _gap(p[i + 1], y, w, g, sign)[0]
        side = np.zeros(len(k))
        for _ in range(14):
            with np.errstate(all="ignore"):
                middle = np.where(c1 != c0, (low * c1 - high * c0) / (c1 - c0), high)
            c = _gap(on_parallel(curve, a, middle), y, w, g, sign)[0]
            left = (c < 0) == (c0 < 0)
            # the end that stays for the second time counts half
            c1 = np.where(left & (side == 1), c1 / 2, c1)
            c0 = np.where(~left & (side == -1), c0 / 2, c0)
            side = np.where(left, 1, -1)
            low, c0 = np.where(left, middle, low), np.where(left, c, c0)
            high, c1 = np.where(left, high, middle), np.where(left, c1, c)
        q = on_parallel(curve, a, middle)
        s = _gap(q, y, w, g, sign)[1]
        d = curve.at(middle)[1]
        out = (w[:, 0] + s * g[0]) * -d[:, 1] + (w[:, 1] + s * g[1]) * d[:, 0] < 0
        on = np.abs(q - (y + s[:, None] * w + s[:, None] ** 2 / 2 * g)).max(-1) < 1e-9
        on &= out & (s > after) & (s < until[here][k])
        k, q, s = k[on], q[on], s[on]
        if a > 0:  # what is nearer to another part of the curve is no wall
            clear = depth(curve, q) > a - 1e-8
            k, s = k[clear], s[clear]
        np.minimum.at(best, first + k, s)
    return best


@functools.cache
def _compiled() -> Any:
    return njit(_changes)


def _changes(
    p: Array, x: Array, v: Array, g: Array, pull: float, after: float, until: Array
) -> tuple[Array, Array, Array]:
    """Return launches, nodes and signs of the root of the time where the function of :func:`_gap` changes its sign."""
    launch, node, which = [0 for _ in range(0)], [0 for _ in range(0)], [0.0 for _ in range(0)]
    px, py = p[:, 0].copy(), p[:, 1].copy()
    c, s = np.empty((2, len(p))), np.empty((2, len(p)))
    ex, ey = (g[0] / pull, g[1] / pull) if pull > 0 else (0.0, 0.0)
    for k in range(len(x)):
        fall, side = v[k, 0] * ex + v[k, 1] * ey, v[k, 1] * ex - v[k, 0] * ey
        if pull == 0.0:
            squared = v[k, 0] ** 2 + v[k, 1] ** 2
            for i in range(len(px)):
                dx, dy = px[i] - x[k, 0], py[i] - x[k, 1]
                c[0, i] = v[k, 0] * dy - v[k, 1] * dx
                s[0, i] = (dx * v[k, 0] + dy * v[k, 1]) / squared
        else:
            for i in range(len(px)):
                dx, dy = px[i] - x[k, 0], py[i] - x[k, 1]
                root = np.sqrt(fall * fall + 2 * pull * (dx * ex + dy * ey))
                across = dy * ex - dx * ey
                s[0, i], s[1, i] = (root - fall) / pull, (-root - fall) / pull
                c[0, i], c[1, i] = across - side * s[0, i], across - side * s[1, i]
        for m in range(1 if pull == 0.0 else 2):
            for i in range(len(px) - 1):
                # (zero counts as above; where the path does not come level with a node there is no number)
                if c[m, i] * c[m, i + 1] <= 0.0 and (c[m, i] < 0.0) != (c[m, i + 1] < 0.0):
                    s0, s1 = s[m, i], s[m, i + 1]
                    if min(s0, s1) < until[k] and max(s0, s1) > after:
                        launch.append(k), node.append(i), which.append(1.0 - 2.0 * m)
    return np.array(launch), np.array(node), np.array(which)


def _gap(q: Array, x: Array, v: Array, g: Array, sign: Any) -> tuple[Array, Array]:
    """Return a function of the curve's points that is zero on the path, and the time at which the path is level with them."""
    d = q - x
    pull = np.linalg.norm(g)
    if pull == 0:
        c = v[..., 0] * d[..., 1] - v[..., 1] * d[..., 0]
        return c, (d * v).sum(-1) / (v * v).sum(-1)
    # along g the height is fall s + pull s^2/2, of which one root is asked; across it motion is uniform
    e = g / pull
    f = np.array([-e[1], e[0]])
    fall, side = v @ e, v @ f
    inside = fall * fall + 2 * pull * (d @ e)
    s = (-fall + sign * np.sqrt(np.maximum(inside, 0))) / pull
    return np.where(inside >= 0, d @ f - side * s, np.nan), s


def precise_frame(curve: PolarSum, t: Any, a: Any) -> tuple[Any, Any, Any, Any, Any]:
    """Return x, y of the parallel curve, the inward normal and the wall's curvature at t to mp.dps digits."""
    t = mpf(t)
    r = 1 + sum(mpf(c) * mp.cos(k * t + mpf(p)) for k, c, p in curve.terms)
    d = -sum(k * mpf(c) * mp.sin(k * t + mpf(p)) for k, c, p in curve.terms)
    e = -sum(k * k * mpf(c) * mp.cos(k * t + mpf(p)) for k, c, p in curve.terms)
    c, s, h = mp.cos(t), mp.sin(t), mpf(curve.tall)
    x, y, dx, dy = r * c, h * r * s, d * c - r * s, h * (d * s + r * c)
    ddx, ddy = (e - r) * c - 2 * d * s, h * ((e - r) * s + 2 * d * c)
    size = mp.sqrt(dx * dx + dy * dy)
    nx, ny = -dy / size, dx / size
    return x + mpf(a) * nx, y + mpf(a) * ny, nx, ny, (dx * ddy - dy * ddx) / size**3


def bounces_in(curve: PolarSum, state: Any, count: int) -> Any:
    """Return the state (x, y, vx, vy) after so many mirror bounces of a point, to mp.dps digits, from the formula of the curve."""
    x, y, vx, vy = map(mpf, state)
    for _ in range(count):

        def off(t: Any, x: Any = x, y: Any = y, vx: Any = vx, vy: Any = vy) -> Any:
            px, py, *_rest = precise_frame(curve, t, 0)
            return vx * (py - y) - vy * (px - x)

        nodes = np.linspace(0, 2 * np.pi, 721)
        p = curve.at(nodes)[0]
        c = float(vx) * (p[:, 1] - float(y)) - float(vy) * (p[:, 0] - float(x))
        hits = []
        for i in np.flatnonzero((c[:-1] < 0) & (c[1:] >= 0)):
            t = mp.findroot(off, (nodes[i], nodes[i + 1]), solver="anderson", tol=mpf(10) ** (-2 * mp.dps + 10))
            px, py, nx, ny, _k = precise_frame(curve, t, 0)
            time = ((px - x) * vx + (py - y) * vy) / (vx * vx + vy * vy)
            if time > mpf(10) ** (-10):
                hits.append((time, px, py, nx, ny))
        _time, x, y, nx, ny = min(hits)
        across = vx * nx + vy * ny
        vx, vy = vx - 2 * across * nx, vy - 2 * across * ny
    return x, y, vx, vy
