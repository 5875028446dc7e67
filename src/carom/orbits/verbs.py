"""The verbs: follow orbits, start them, reverse them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.errors import CaromError
from carom.orbits.arrays import DONE
from carom.orbits.loop import compiled
from carom.orbits.result import Orbit
from carom.orbits.setup import Setup, Start, prepare, setup_of
from carom.orbits.shape import Shape
from carom.orbits.tables import Table
from carom.surface import Surface

__all__ = ["final", "follow", "orbit", "reverse", "starts", "whole"]

Array = NDArray[np.float64]
MOST = 4e9  # bytes of bounces that are kept
ROW = 400  # bytes a start needs while it is drawn and followed
TRIED = 20_000  # places of a wall, for the greatest energy on it
SHARE = 10_000_000  # bounces between two reports of progress


def orbit(
    table: Table,
    start: Any,
    bounces: int = 1000,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    corners: str = "end",
    progress: Callable[[int, int], None] | None = None,
) -> Orbit:
    """Follow one ball, or many at once on all cores, for so many bounces; the same bits for any number of threads.

    Parameters
    ----------
    table : Table
        As :func:`carom.orbits.circle` and the others make it.
    start : Start, or (position, velocity, spin)
        Shapes (..., d), (..., d) and (...) (in space (..., 3)), broadcast; each orbit by itself.
    bounces : int
        How many.
    ball : Ball, optional
        In the plane a :func:`carom.Disc`, or a Ball with its axis upright; left out: kappa 1/2 (in space 2/5), mass 1, radius
        1, or 1/10 where the table bounds the surface.
    law : str or kernel
        "no-slip" (Broomhead & Gutkin), "mirror", "contact" (reads ``surface``: restitution, friction, tangential restitution),
        "rolling" (the nonholonomic reflection of a ball that rolls on the table's floor), "my_law.py:law", or a kernel
        (v, w, n, a, kappa, e, mu, beta) -> (v, w).
    corners : "end" or "pass"
        At a corner (within 1e-12 of the table's size) the map is not defined: the orbit ends. "pass": the ball meets the two
        sides one after the other, the one with the lower number first.
    progress : callable, optional
        Called with how many bounces of how many are done.

    Raises CaromError, one line a fault.
    """
    return follow(setup_of(table, ball, law, surface, corners), start, bounces, progress)


def follow(setup: Setup, start: Any, bounces: int, progress: Callable[[int, int], None] | None = None) -> Orbit:
    """:func:`orbit` of a table, a ball and a law that go together already."""
    rows, shape = prepare(setup, start)
    bounces = whole("bounces", bounces)
    d = setup.table.dimension
    width = 6 if setup.planar else 10
    if len(rows) * bounces * (8 * width + 4) > MOST:
        raise CaromError(
            f"orbit: bounces: expected no more than {int(MOST / (8 * width + 4)):,} in all, which are kept, got {len(rows)} x"
            f" {bounces:,}; final() keeps none"
        )
    kept = np.full((len(rows), bounces, width), np.nan)
    piece = np.full((len(rows), bounces), -1, np.int32)
    last, ends = _loop(setup, rows, bounces, kept, piece, progress)
    kept = kept.reshape(*shape, bounces, width)
    return Orbit(
        setup=setup,
        start=_state(setup, rows, shape),
        t=kept[..., 0],
        position=kept[..., 1 : 1 + d],
        velocity=kept[..., 1 + d : 1 + 2 * d],
        spin=kept[..., 5] if setup.planar else kept[..., 7:],
        piece=piece.reshape(*shape, bounces),
        count=ends[:, 1].reshape(shape),
        ending=ends[:, 0].reshape(shape),
        last=last.reshape(*shape, 10),
    )


def _state(setup: Setup, rows: Array, shape: tuple[int, ...]) -> Start:
    """Rows (N, 9) of position, velocity and spin, as a Start."""
    d = setup.table.dimension
    rows = rows.reshape(*shape, 9)
    return Start(rows[..., :d], rows[..., 3 : 3 + d], rows[..., 8] if setup.planar else rows[..., 6:])


def final(
    table: Table,
    start: Any,
    bounces: int,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    corners: str = "end",
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Start, Array, Any, Any]:
    """As :func:`orbit`, keeping nothing on the way: the states at the end, their times, how many bounces, how it ended."""
    setup = setup_of(table, ball, law, surface, corners)
    rows, shape = prepare(setup, start)
    bounces = whole("bounces", bounces)
    width = 6 if setup.planar else 10
    nothing, none = np.empty((len(rows), 0, width)), np.empty((len(rows), 0), np.int32)
    last, ends = _loop(setup, rows, bounces, nothing, none, progress)
    return (
        _state(setup, last[:, 1:], shape),
        last[:, 0].reshape(shape),
        ends[:, 1].reshape(shape),
        ends[:, 0].reshape(shape),
    )


def whole(field: str, value: Any, least: int = 1) -> int:
    """A whole number, or a CaromError."""
    if isinstance(value, int | np.integer) and not isinstance(value, bool) and least <= value < 2**60:
        return int(value)
    raise CaromError(f"orbit: {field}: expected a whole number >= {least}, got {value!r}")


def _loop(
    setup: Setup, rows: Array, bounces: int, kept: Any, piece: Any, progress: Callable[[int, int], None] | None
) -> tuple[Array, NDArray[np.int64]]:
    """Run the compiled loop, in shares that let progress be told."""
    # in a periodic cell every orbit begins in the first
    shift = rows[:, :3] - setup.shape.folded(rows[:, :3])
    rows = rows - np.concatenate([shift, np.zeros((len(rows), 6))], axis=1)
    last, ends = np.empty((len(rows), 10)), np.zeros((len(rows), 2), np.int64)
    share = max(1, len(rows) if progress is None else min(len(rows), SHARE // bounces))
    for k in range(0, len(rows), share):
        here = slice(k, k + share)
        compiled().many(setup.world, setup.pieces, rows[here], bounces, kept[here], piece[here], last[here], ends[here])
        if progress is not None:
            progress(min(k + share, len(rows)) * bounces, len(rows) * bounces)
    if shift.any():
        d = setup.table.dimension
        kept[..., 1 : 1 + d] += shift[:, None, :d]
        last[:, 1:4] += shift
    return last, ends


def starts(
    table: Table, count: int, seed: int = 0, *, ball: Ball | None = None, law: Any = "no-slip", speed: float = 1.0
) -> Start:
    """Starts just after a bounce, drawn from the invariant measure: ``|v.n|`` ds d(velocities of one energy).

    Evenly along the wall (of a cylinder: at z = 0); the velocities along the wall and the spins, each times the root of its
    inertia, evenly in the unit ball, so that what is left to the velocity across has the density ``|v.n|``. ``speed`` is
    sqrt(2 energy / m). Under a force across walls it is that of a ball at the origin (or of one that would get there), and places
    count by the kinetic energy left there: in the plane by it, in space by its power 5/2. Closed tables only: a strip and a wedge
    have no end.
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
        x, n = _on_the_wall(table, setup.shape, count, rng)
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
    pull = np.array(table.pull)
    x, n = np.empty((0, 3)), np.empty((0, 3))
    # no place of the wall has more than the highest of so many, and the way between two of them
    some = _on_the_wall(table, shape, TRIED, np.random.default_rng(0))[0] @ pull
    most = speed**2 + 2 * (some.max() + 0.02 * np.ptp(some))
    if not most > 0 or not np.isfinite(speed):
        raise CaromError(f"starts: speed: expected one at the origin with which a ball gets to a wall, got {speed!r}")
    while len(x) < count:
        y, m = _on_the_wall(table, shape, 2 * count + 100, rng)
        left = np.maximum(speed**2 + 2 * y @ pull, 0)
        on = rng.uniform(size=len(y)) < (left / most) ** power
        x, n = np.concatenate([x, y[on]]), np.concatenate([n, m[on]])
    x, n = x[:count], n[:count]
    return x, n, np.sqrt(speed**2 + 2 * x @ pull)[:, None]


def _on_the_wall(table: Table, shape: Shape, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Points (count, 3) evenly on the wall, with the normals there."""
    if shape.sphere is not None:
        out = rng.normal(size=(count, 3))
        out /= np.linalg.norm(out, axis=1, keepdims=True)
        return shape.sphere * out, -out
    lids = [f for f in shape.faces if f[0][2]]
    side = replace(shape, faces=[f for f in shape.faces if not f[0][2]])
    if not np.isfinite(side.lengths).all():
        raise CaromError(
            f"starts: table: expected one with a wall of some length, got {table.name}; give starts of your own"
        )
    around = float(side.lengths.sum())
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


def reverse(found: Orbit) -> tuple[Orbit, Array]:
    """Run an orbit backwards from its last bounce; the orbit, and (..., B) how far each bounce lies from where it was.

    The no-slip, mirror and rolling reflections undo themselves, so it goes back through all its bounces, until chaos has
    multiplied what rounding took. Of orbits that made all their bounces.
    """
    setup = found.setup
    if not setup.keeps:
        raise CaromError(f"reverse: law: expected one that undoes itself (no-slip, mirror, rolling), got {setup.law}")
    if (np.asarray(found.ending) != DONE).any():
        raise CaromError("reverse: orbit: expected one that made all its bounces, got one that ended before")
    spin = found.spin[..., -1] if setup.planar else found.spin[..., -1, :]
    back = follow(setup, Start(found.position[..., -1, :], -found.velocity[..., -1, :], -spin), found.t.shape[-1])
    error = np.linalg.norm(back.position - np.flip(found.position, axis=found.t.ndim - 1), axis=-1)
    return back, error
