"""Films of discs in a box by an event search that shares nothing with carom: all pairs and walls, one event after another."""

from __future__ import annotations

import math

import numpy as np

from carom.gas import GasScene

RADIUS = 0.4
KAPPA = 0.5  # of a disc


def _next_event(x, v, side, around):
    """Time to the next event, and its balls (i, j), or ball and wall (i, axis - 2)."""
    r, u = x[:, None] - x[None], v[:, None] - v[None]
    if around:
        r -= side * np.round(r / side)
    b, uu, rr = (r * u).sum(-1), (u * u).sum(-1), (r * r).sum(-1)
    with np.errstate(all="ignore"):
        root = b * b - uu * (rr - 4 * RADIUS**2)
        t = np.where((b < 0) & (root > 0), (-b - np.sqrt(root)) / uu, np.inf)
    np.fill_diagonal(t, np.inf)
    i, j = np.unravel_index(int(np.argmin(t)), t.shape)
    best = (max(float(t[i, j]), 0.0), int(i), int(j))
    if around:  # (images move: a pair farther than half a side apart is looked at again)
        fastest = 2 * float(np.abs(v).max())
        step = (side / 2 - 2 * RADIUS) / fastest / 2
        return best if best[0] < step else (step, -1, -1)
    with np.errstate(all="ignore"):
        wall = np.where(v > 0, (side - RADIUS - x) / v, np.where(v < 0, (RADIUS - x) / v, np.inf))
    k, axis = np.unravel_index(int(np.argmin(wall)), wall.shape)
    return min(best, (max(float(wall[k, axis]), 0.0), int(k), int(axis) - 2))


def _collide(x, v, w, i, j, side, around, contact):
    """Change velocities and spins of two discs that touch; equal masses."""
    e, mu, beta = contact
    r = x[i] - x[j]
    if around:
        r = r - side * np.round(r / side)
    n = r / np.hypot(*r)
    t = np.array([-n[1], n[0]])
    u = v[i] - v[j]
    slip = float(u @ t) - RADIUS * (w[i] + w[j])
    normal = -(1 + e) * float(u @ n) / 2  # impulse over mass
    rub = -(1 + beta) * KAPPA / (1 + KAPPA) * slip / 2
    rub = math.copysign(min(abs(rub), mu * normal), rub)
    v[i] += normal * n + rub * t
    v[j] -= normal * n + rub * t
    w[[i, j]] -= rub / (KAPPA * RADIUS)


def film(contact, rate, duration, noise, *, count=30, side=16.0, around=False, decimals=None, seed=0):
    """Return columns of tracks with noise (m; of spins noise / radius * 10 per s), and how many collisions there were."""
    rng = np.random.default_rng(seed)
    cells = math.ceil(math.sqrt(count))
    grid = (np.stack(np.meshgrid(*[np.arange(cells)] * 2), -1).reshape(-1, 2)[:count] + 0.5) * side / cells
    x = grid + rng.uniform(-1, 1, grid.shape) * (side / cells / 2 - RADIUS) * 0.9
    v, w = rng.normal(size=(count, 2)), rng.normal(scale=2.0, size=count)
    now, hits, rows = 0.0, 0, []
    for frame in np.arange(0, duration, 1 / rate):
        while True:
            t, i, j = _next_event(x, v, side, around)
            if now + t > frame:
                break
            x, now = x + t * v, now + t
            if j >= 0:
                _collide(x, v, w, i, j, side, around, contact)
                hits += 1
            elif i >= 0:
                v[i, j + 2] *= -1
        x, now = x + (frame - now) * v, frame
        rows.append(np.column_stack([np.full(count, frame), np.arange(count), x % side if around else x, w]))
    table = np.concatenate(rows)
    table[:, 2:4] += noise * rng.standard_normal((len(table), 2))
    table[:, 4] += 10 * noise / RADIUS * rng.standard_normal(len(table))
    if decimals is not None:
        table[:, 0] = np.round(table[:, 0], decimals)
    return dict(zip(("t", "ball", "x", "y", "wz"), table.T, strict=True)), hits


def scene(around=False, **settings):
    """Return the gas of such films, with other contacts."""
    walls = [] if around else [{"between": ("a", "wall"), "restitution": 1, "friction": 0}]
    return GasScene(
        container={"shape": "periodic" if around else "box", "size": (16, 16)}, run={"max_events": 10},
        species=[{"count": 30, "radius": RADIUS}], **settings,
        contacts=[{"between": ("a", "a"), "restitution": 0.5, "friction": 0.5}, *walls],
    )  # fmt: skip
