"""Draw initial states of orbits from the invariant measure of a billiard."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, Face
from carom.billiards.orbits import MAX_KEPT_BYTES, require_integer
from carom.billiards.setup import Start, needs_surface, orbit_setup
from carom.billiards.table_records import PARABOLA
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.core.sums import added
from carom.errors import CaromError, Fault
from carom.files import require_memory

Array = NDArray[np.float64]
BYTES_PER_START = 400  # of memory, while a start is drawn and followed
COVERED = 1e-9  # radii within the image of an obstacle: rounding
OUTLINE_POINTS = 20_000  # of an outline whose length and area are found
LATTICE_POINTS = 1000  # along each side of a cell whose free area is found
ENERGY_SCAN_POINTS = 20_000  # points of a wall at which the greatest kinetic energy is sought


def starts(
    table: Table,
    count: int,
    seed: int = 0,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    speed: float = 1.0,
    spins: bool = True,
) -> Start:
    """Draw states just after a bounce from the invariant measure ``|v.n|`` ds d(velocities and spins of one energy).

    Positions are uniform along the wall. The velocities along the wall and the spins, each times the square root of its inertia,
    are uniform in the unit ball, so that the velocity across the wall has the density ``|v.n|``. Under a force across walls,
    positions are weighted by the kinetic energy left there: in the plane by its first power, in space by its power 5/2.

    Along an axis in which the table is invariant, starts lie in one place: of a cylinder at z = 0, of a strip at x = 0, of
    plates at x = z = 0; in a periodic cell they lie in the first. A wedge has such a measure only under a force that brings back
    every ball: its walls then count as far as a ball of that energy gets.

    Parameters
    ----------
    table : Table
        The table.
    count : int
        Number of starts.
    seed : int
        Seed of the random numbers.
    ball, law
        As for :func:`orbit`.
    speed : float
        sqrt(2 energy / m), m/s; under a force across walls, the speed of a ball at the origin.
    spins : bool
        Whether velocities and spins share the energy. Without, no ball spins and all have one speed, in the directions of the same
        measure: the point particle of textbooks, for laws that leave the spin alone.

    Returns
    -------
    Start
        Arrays (count, ...).

    Raises
    ------
    CaromError
        A wedge without such a force, an energy with which no ball reaches a wall, too many starts.

    Examples
    --------
    >>> from carom import billiards
    >>> start = billiards.starts(billiards.stadium(), 1000, seed=1)
    >>> start.position.shape, start.spin.shape
    ((1000, 2), (1000,))
    """
    setup = orbit_setup(table, ball, law, Surface() if needs_surface(law) else None, "end")
    count, seed = require_integer("count", count), require_integer("seed", seed, 0)
    require_memory("starts", "count", count, BYTES_PER_START, "draw them in parts", MAX_KEPT_BYTES)
    rng = np.random.default_rng(seed)
    radius, kappa = float(setup.ball.radius), float(setup.ball.kappa)
    planar = setup.planar
    # dimension of the unit ball of all components except the one across: 2 in the plane, 5 in space
    free = 2 if planar else 5
    if setup.world["flight"][0] == PARABOLA:
        x, n, pace = _weighted_by_energy(table, setup.shape, count, rng, speed, 1.0 if planar else 2.5)
    else:
        x, n = _on_the_wall(_cut_at_energy(table, setup.shape, speed), count, rng)
        pace = np.full((count, 1), float(speed))
    u = rng.normal(size=(count, free))
    u *= (rng.uniform(size=count) ** (1 / free) / np.linalg.norm(u, axis=1))[:, None]
    across = np.sqrt(1 - (u * u).sum(1))
    if not spins:
        moves = 1 if planar else 2  # components of the velocity along the wall; the others are spins
        u[:, moves:] = 0.0
        share = np.sqrt(across**2 + (u * u).sum(1))
        across, u = across / share, u / share[:, None]
    t = np.cross(n, np.where(np.abs(n[:, 2:]) < 0.9, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]))
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    rolls = math.sqrt(1 + kappa) if setup.rolls else 1.0
    v = pace * (across[:, None] * n + u[:, :1] * t) / rolls
    inertia = math.sqrt(kappa) * radius
    if planar:
        return Start(x[:, :2], v[:, :2], pace[:, 0] * u[:, 1] / inertia)
    v += pace * u[:, 1:2] * np.cross(n, t)
    return Start(x, v, pace * u[:, 2:] / inertia)


def _weighted_by_energy(
    table: Table, shape: Boundary, count: int, rng: np.random.Generator, speed: float, power: float
) -> tuple[Array, Array, Array]:
    """Draw points (count, 3) of the wall weighted by a power of the kinetic energy there.

    Return them with the normals (count, 3) and sqrt(2 kinetic energy / m) (count, 1).
    """
    acceleration, shape = np.array(table.acceleration), _cut_at_energy(table, shape, speed)
    x, n = np.empty((0, 3)), np.empty((0, 3))
    # upper bound of the energy: the greatest of many points, and a margin for those between them
    some = _on_the_wall(shape, ENERGY_SCAN_POINTS, np.random.default_rng(0))[0] @ acceleration
    most = speed**2 + 2 * (some.max() + 0.02 * np.ptp(some))
    if not most > 0 or not np.isfinite(speed):
        raise CaromError(Fault("starts", "speed", "one at the origin with which a ball reaches a wall", repr(speed)))
    while len(x) < count:
        y, m = _on_the_wall(shape, 2 * count + 100, rng)
        left = np.maximum(speed**2 + 2 * y @ acceleration, 0)
        on = rng.uniform(size=len(y)) < (left / most) ** power
        x, n = np.concatenate([x, y[on]]), np.concatenate([n, m[on]])
    x, n = x[:count], n[:count]
    return x, n, np.sqrt(speed**2 + 2 * x @ acceleration)[:, None]


def _cut_at_energy(table: Table, shape: Boundary, speed: float) -> Boundary:
    """Return the boundary with half-infinite walls cut off where a ball of that energy gets no further."""
    faces: list[Face] = []
    for (nx, ny, nz), c, r, begin, end, low, high in shape.faces:
        cut = begin, end
        if not nz and math.isinf(begin) != math.isinf(end):
            # speed^2 + 2 g.x is twice the energy per mass that is left: at the corner, and its rate along the wall
            t, corner = np.array([ny, -nx]), begin if math.isfinite(begin) else end
            left = speed**2 + 2 * np.dot(table.acceleration[:2], np.multiply((nx, ny), c) + corner * t)
            rate = 2 * float(np.dot(table.acceleration[:2], t)) * (1 if corner == begin else -1)
            if not rate < 0:
                raise CaromError(
                    Fault(
                        "starts",
                        "table",
                        "a force that brings back every ball",
                        f"a {table.name}, whose walls are infinite",
                        "give an acceleration towards the vertex (of a wedge such as -9.81,0), or `position` and `velocity`",
                    )
                )
            reach = max(left, 0.0) / -rate
            cut = (begin, begin + reach) if corner == begin else (end - reach, end)
        faces.append(Face((nx, ny, nz), c, r, *cut, low, high))
    return replace(shape, faces=faces)


def _on_infinite_walls(
    sides: list[Face], lids: list[Face], count: int, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Draw points (count, 3) at x = 0 of infinite walls and of the lids between them; return them with the normals."""
    x, n = np.zeros((count, 3)), np.zeros((count, 3))
    which = rng.integers(len(sides), size=count)
    n[:, :2] = np.array([normal[:2] for normal, *_ in sides])[which]
    x[:, :2] = n[:, :2] * np.array([c for _n, c, *_ in sides])[which, None]
    if lids:
        high, width = -float(lids[0].offset), -float(added(c for _n, c, *_ in sides))
        x[:, 2] = rng.uniform(-high, high, count)
        on = rng.uniform(size=count) < width / (width + 2 * high)
        up = np.where(rng.uniform(size=count) < 0.5, 1.0, -1.0)
        x[on, 1], x[on, 2] = rng.uniform(-width / 2, width / 2, on.sum()), high * up[on]
        n[on] = np.stack([np.zeros(on.sum()), np.zeros(on.sum()), -up[on]], axis=1)
    return x, n


def _on_the_wall(shape: Boundary, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Draw points (count, 3) uniformly on the wall; return them with the normals."""
    if shape.sphere is not None:
        out = rng.normal(size=(count, 3))
        out /= np.linalg.norm(out, axis=1, keepdims=True)
        return shape.sphere * out, -out
    lids = [f for f in shape.faces if f.is_lid]
    # (without lids the pieces have other numbers; starts are drawn in the order of these)
    side = replace(shape, faces=[f for f in shape.faces if not f.is_lid], order=None if lids else shape.order)
    if side.faces and not np.isfinite(side.lengths).any():
        return _on_infinite_walls(side.faces, lids, count, rng)
    around = float(side.lengths.sum())
    if not around > 0:
        raise CaromError(Fault("starts", "speed", "one at the origin with which a ball reaches a wall", "less"))
    x2, n2 = _exposed(side, around, count, rng)
    x, n = (np.concatenate([p, np.zeros((count, 1))], axis=1) for p in (x2, n2))
    if lids:
        high = -float(lids[0].offset)
        x[:, 2] = rng.uniform(-high, high, count)
        # the share on the lids is the share of their area
        area, length, low, size = _cross_section(side, around)
        on = np.flatnonzero(rng.uniform(size=count) < area / (area + length * high))
        left = on
        while len(left):
            x[left, :2] = low + rng.uniform(size=(len(left), 2)) * size
            left = left[side.gap(x[left, :2]) < 0]
        up = np.where(rng.uniform(size=len(on)) < 0.5, 1.0, -1.0)
        x[on, 2], n[on] = high * up, np.stack([np.zeros(len(on)), np.zeros(len(on)), -up], axis=1)
    return x, n


def _exposed(side: Boundary, around: float, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Draw points (count, 2) uniformly on a wall's outline; return them with the normals.

    Points of an obstacle that its periodic images cover are drawn again.
    """
    _k, x, n = side.place(rng.uniform(0, around, count))
    left = np.flatnonzero(_covered(side, x))
    while len(left):
        _k, x[left], n[left] = side.place(rng.uniform(0, around, len(left)))
        left = left[_covered(side, x[left])]
    return x, n


def _covered(side: Boundary, x: Array) -> NDArray[np.bool_]:
    """Return whether points (N, 2) of an outline lie within the image of an obstacle in a neighbouring cell."""
    if not side.images:
        return np.zeros(len(x), bool)
    covered: NDArray[np.bool_] = side.gap(x) < -COVERED * max(one[2] for one in side.images)
    return covered


def free_area(side: Boundary) -> tuple[float, float]:
    """Return the area within a boundary in the plane and the length of the boundary that a ball can touch, m^2 and m."""
    around = float(side.lengths.sum())
    if side.cell is None:
        # the integral of -x.n/2 along the boundary, n the normal inwards
        nodes, weights = np.polynomial.legendre.leggauss(16)
        ends = np.unique(np.concatenate([side.starts, side.starts + side.lengths]))
        cuts = np.concatenate([np.linspace(a, b, 65)[:-1] for a, b in pairwise(ends)] + [ends[-1:]])
        half = np.diff(cuts)[:, None] / 2
        _k, x, n = side.place((cuts[:-1, None] + half + half * nodes).ravel())
        return float(-((x * n).sum(-1).reshape(-1, 16) * half * weights).sum() / 2), around
    circles = [(x, y, r) for x, y, r, *_ in [*side.outside, *side.images]]
    apart = all(math.hypot(a - c, b - d) >= r + s for (a, b, r), (c, d, s) in combinations(circles, 2))
    if not apart or any(abs(y) + r > -one.offset for _x, y, r in circles for one in side.faces):
        area, around, *_ = _cross_section(side, around)
        return area, around
    w, h = side.cell
    whole = w * (-sum(one.offset for one in side.faces) if side.faces else h)
    return whole - math.pi * math.fsum(r * r for _x, _y, r, *_ in side.outside), around


def _cross_section(side: Boundary, around: float) -> tuple[float, float, Array, Array]:
    """Return the area within an outline, its length, and the corner and the sides of a rectangle around it."""
    curve = side.place(np.linspace(0, around, OUTLINE_POINTS + 1)[:-1])[1]
    if side.cell is None:
        a, b = curve, np.roll(curve, -1, axis=0)
        return float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2), around, curve.min(0), np.ptp(curve, axis=0)
    # of a periodic cell what obstacles leave free, on a lattice
    size = np.array(side.cell)
    places = (np.arange(LATTICE_POINTS) + 0.5) / LATTICE_POINTS - 0.5
    lattice = np.stack(np.meshgrid(places * size[0], places * size[1]), axis=-1)
    area = float((side.gap(lattice) > 0).mean() * size.prod())
    return area, around * float(1 - _covered(side, curve).mean()), -size / 2, size
