"""Starts drawn from the invariant measure: where on the wall, by the energy that is left there, and how they move."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.errors import CaromError
from carom.orbits.setup import Start, setup_of
from carom.orbits.shape import Shape
from carom.orbits.tables import Table
from carom.orbits.verbs import MOST, whole
from carom.surface import Surface

__all__ = ["starts"]

Array = NDArray[np.float64]
ROW = 400  # bytes a start needs while it is drawn and followed
TRIED = 20_000  # places of a wall, for the greatest energy on it


def starts(
    table: Table, count: int, seed: int = 0, *, ball: Ball | None = None, law: Any = "no-slip", speed: float = 1.0
) -> Start:
    """Starts just after a bounce, drawn from the invariant measure: ``|v.n|`` ds d(velocities of one energy).

    Evenly along the wall; the velocities along the wall and the spins, each times the root of its inertia, evenly in the unit
    ball, so that what is left to the velocity across has the density ``|v.n|``. ``speed`` is sqrt(2 energy / m). Under a force
    across walls it is that of a ball at the origin (or of one that would get there), and places count by the kinetic energy left
    there: in the plane by it, in space by its power 5/2.

    Along an axis on which the table is everywhere the same, starts lie in one place: of a cylinder at z = 0, of a strip at x = 0,
    of plates at x = z = 0; in a periodic cell they lie in the first. A wedge has such a measure under a force that brings back
    every ball: its walls count as far as one of that energy gets. Without such a force CaromError says so.
    """
    setup = setup_of(table, ball, law, Surface() if law == "contact" else None, "end")
    count, seed = whole("count", count), whole("seed", seed, 0)
    if count * ROW > MOST:
        raise CaromError(
            f"starts: count: expected no more than {int(MOST / ROW):,}, got {count:,}; draw a share at a time"
        )
    rng = np.random.default_rng(seed)
    radius, kappa = float(setup.ball.radius), float(setup.ball.kappa)
    planar = setup.planar
    # a point of the unit ball of all components but the one across: 2 in the plane, 5 in space
    free = 2 if planar else 5
    if setup.world["falls"][0]:
        x, n, pace = _by_energy(table, setup.shape, count, rng, speed, 1.0 if planar else 2.5)
    else:
        x, n = _on_the_wall(_held(table, setup.shape, speed), count, rng)
        pace = np.full((count, 1), float(speed))
    u = rng.normal(size=(count, free))
    u *= (rng.uniform(size=count) ** (1 / free) / np.linalg.norm(u, axis=1))[:, None]
    across = np.sqrt(1 - (u * u).sum(1))
    t = np.cross(n, np.where(np.abs(n[:, 2:]) < 0.9, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]))
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    rolls = math.sqrt(1 + kappa) if setup.law == "rolling" else 1.0
    v = pace * (across[:, None] * n + u[:, :1] * t) / rolls
    inertia = math.sqrt(kappa) * radius
    if planar:
        return Start(x[:, :2], v[:, :2], pace[:, 0] * u[:, 1] / inertia)
    v += pace * u[:, 1:2] * np.cross(n, t)
    return Start(x, v, pace * u[:, 2:] / inertia)


def _by_energy(
    table: Table, shape: Shape, count: int, rng: np.random.Generator, speed: float, power: float
) -> tuple[Array, Array, Array]:
    """Points (count, 3) of the wall by a power of the kinetic energy there, the normals, sqrt(2 kinetic energy / m) (count, 1)."""
    pull, shape = np.array(table.pull), _held(table, shape, speed)
    x, n = np.empty((0, 3)), np.empty((0, 3))
    # no place of the wall has more than the highest of so many, and the way between two of them
    some = _on_the_wall(shape, TRIED, np.random.default_rng(0))[0] @ pull
    most = speed**2 + 2 * (some.max() + 0.02 * np.ptp(some))
    if not most > 0 or not np.isfinite(speed):
        raise CaromError(f"starts: speed: expected one at the origin with which a ball gets to a wall, got {speed!r}")
    while len(x) < count:
        y, m = _on_the_wall(shape, 2 * count + 100, rng)
        left = np.maximum(speed**2 + 2 * y @ pull, 0)
        on = rng.uniform(size=len(y)) < (left / most) ** power
        x, n = np.concatenate([x, y[on]]), np.concatenate([n, m[on]])
    x, n = x[:count], n[:count]
    return x, n, np.sqrt(speed**2 + 2 * x @ pull)[:, None]


def _held(table: Table, shape: Shape, speed: float) -> Shape:
    """The shape with walls that have no end cut off where a ball of that energy gets no further."""
    faces: list[Any] = []
    for (nx, ny, nz), c, r, begin, end, low, high in shape.faces:
        cut = begin, end
        if not nz and math.isinf(begin) != math.isinf(end):
            # v^2 + (kappa spin's) = speed^2 + 2 g.x: what is left at the corner, and how it goes down from there
            t, corner = np.array([ny, -nx]), begin if math.isfinite(begin) else end
            left = speed**2 + 2 * np.dot(table.pull[:2], np.multiply((nx, ny), c) + corner * t)
            rate = 2 * float(np.dot(table.pull[:2], t)) * (1 if corner == begin else -1)
            if not rate < 0:
                raise CaromError(
                    f"starts: table: expected a force that brings back every ball, got {table}: along a wall they go out for ever;"
                    " give a force towards the vertex, or starts of your own"
                )
            reach = max(left, 0.0) / -rate
            cut = (begin, begin + reach) if corner == begin else (end - reach, end)
        faces.append(((nx, ny, nz), c, r, *cut, low, high))
    return replace(shape, faces=faces)


def _across(sides: list[Any], lids: list[Any], count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Points (count, 3) at x = 0 of walls without beginning and end, and of lids between them; the normals there."""
    x, n = np.zeros((count, 3)), np.zeros((count, 3))
    which = rng.integers(len(sides), size=count)
    n[:, :2] = np.array([normal[:2] for normal, *_ in sides])[which]
    x[:, :2] = n[:, :2] * np.array([c for _n, c, *_ in sides])[which, None]
    if lids:
        high, width = -float(lids[0][1]), -float(sum(c for _n, c, *_ in sides))
        x[:, 2] = rng.uniform(-high, high, count)
        on = rng.uniform(size=count) < width / (width + 2 * high)
        up = np.where(rng.uniform(size=count) < 0.5, 1.0, -1.0)
        x[on, 1], x[on, 2] = rng.uniform(-width / 2, width / 2, on.sum()), high * up[on]
        n[on] = np.stack([np.zeros(on.sum()), np.zeros(on.sum()), -up[on]], axis=1)
    return x, n


def _on_the_wall(shape: Shape, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Points (count, 3) evenly on the wall, with the normals there."""
    if shape.sphere is not None:
        out = rng.normal(size=(count, 3))
        out /= np.linalg.norm(out, axis=1, keepdims=True)
        return shape.sphere * out, -out
    lids = [f for f in shape.faces if f[0][2]]
    side = replace(shape, faces=[f for f in shape.faces if not f[0][2]])
    if side.faces and not np.isfinite(side.lengths).any():
        return _across(side.faces, lids, count, rng)
    around = float(side.lengths.sum())
    if not around > 0:
        raise CaromError("starts: speed: expected one at the origin with which a ball gets to a wall, got less")
    _k, x2, n2 = side.place(rng.uniform(0, around, count))
    x, n = (np.concatenate([p, np.zeros((count, 1))], axis=1) for p in (x2, n2))
    if lids:
        high = -float(lids[0][1])
        x[:, 2] = rng.uniform(-high, high, count)
        # how many lie on the lids: by area
        curve = side.place(np.linspace(0, around, 20_001)[:-1])[1]
        a, b = curve, np.roll(curve, -1, axis=0)
        area = float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)
        on = np.flatnonzero(rng.uniform(size=count) < area / (area + around * high))
        low, size = curve.min(0), np.ptp(curve, axis=0)
        left = on
        while len(left):
            x[left, :2] = low + rng.uniform(size=(len(left), 2)) * size
            left = left[side.gap(x[left, :2]) < 0]
        up = np.where(rng.uniform(size=len(on)) < 0.5, 1.0, -1.0)
        x[on, 2], n[on] = high * up, np.stack([np.zeros(len(on)), np.zeros(len(on)), -up], axis=1)
    return x, n
