"""Initial states of a gas: where the balls are, and how they move."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.engine.swarm_arrays import PLANE
from carom.errors import CaromError
from carom.gas.container import Container, room_of

__all__ = ["lattice", "scattered", "thermal"]

Array = NDArray[np.float64]
LARGER = 200  # lattices are tried, each a twentieth finer
PROPOSALS = 300  # a ball, after which a density counts as too high to be reached by chance


def lattice(count: int, side: Sequence[float] | Container, radius: float = 0.0) -> Array:
    """Centres (count, 3) on a face-centred cubic lattice, or in 2-D (a side of two numbers) on a centred square one.

    In a box of these sides, ``radius`` from each of them, it is stretched to fill the box; in a container it keeps balls of that
    radius off the walls, and is as wide as leaves room for all. Of its places ``count`` are taken, spread evenly.
    """
    if not isinstance(side, Container):
        return _stretched(count, side, [radius] * len(side))
    if side.shape in {"periodic", "box"} and all(wall.form == PLANE for wall in side.walls):
        # (a wall that bounds the centres needs no margin)
        margin = radius if all(wall.thick for wall in side.walls) else 0.0
        return _stretched(count, side.size, [0.0 if closed else margin for closed in side.periodic])
    # as many places in the whole box as leave enough within the walls
    most = count
    for _ in range(LARGER):
        x = _stretched(most, side.size, [0.0] * len(side.size))
        x = x[side.clearance(radius, x) >= 0]
        if len(x) >= count:
            return x[(np.arange(count) * len(x)) // count]
        most += max(most // 20, 1)
    raise CaromError(
        f"lattice: expected a container with room for balls of radius {radius:g}, got one of size {side.size}"
    )


def _stretched(count: int, side: Sequence[float], margins: Sequence[float]) -> Array:
    inner = np.array(side, dtype=float) - 2 * np.array(margins)
    basis = [(0, 0, 0), (1, 1, 0), (1, 0, 1), (0, 1, 1)] if len(inner) == 3 else [(0, 0), (1, 1)]
    # as many steps an axis as make the cells nearly cubic and the places enough
    step = (inner.prod() * len(basis) / count) ** (1 / len(inner))
    steps = np.maximum(np.round(inner / step), 1).astype(int)
    while steps.prod() * len(basis) < count:
        steps[np.argmax(inner / steps)] += 1
    corners = np.stack(np.meshgrid(*(np.arange(n) for n in steps), indexing="ij"), axis=-1).reshape(-1, 1, len(inner))
    places = ((corners + (np.array(basis) + 0.5) / 2) / steps).reshape(-1, len(inner))
    taken = places[(np.arange(count) * len(places)) // count]
    centres = np.zeros((count, 3))
    centres[:, : len(inner)] = np.array(margins) + taken * inner
    return centres


def thermal(mass: Array, axes: tuple[int, ...], temperature: float, rng: np.random.Generator) -> Array:
    """Vectors (N, 3) with normal components along ``axes``, no sum of mass times vector, and mean m v^2 / 2 of T / 2 an axis."""
    found = np.zeros((len(mass), 3))
    if temperature == 0 or len(mass) == 0:
        return found
    v = rng.normal(size=(len(mass), len(axes))) / np.sqrt(mass)[:, None]
    if len(mass) > 1:
        v -= (mass[:, None] * v).sum(axis=0) / mass.sum()
    found[:, axes] = v * math.sqrt(temperature * len(mass) * len(axes) / (mass[:, None] * v * v).sum())
    return found


def scattered(
    radius: ArrayLike, side: Sequence[float] | Container, periodic: Any = True, rng: np.random.Generator | None = None
) -> Array:
    """Centres (N, 3) at random, none overlapping: one ball after the other is put where it has room, the largest first.

    ``side`` and ``periodic`` are those of :class:`carom.gas.Gas`. Random sequential addition: it reaches 38 % of the volume
    (55 % of the area), and slows down well before; :func:`carom.gas.dense` goes further. CaromError where there is no room.
    """
    room, rng = room_of(side, periodic), np.random.default_rng(0) if rng is None else rng
    axes = len(room.size)
    size = np.ones(3)
    size[:axes] = room.size
    around = np.ones(3, bool)
    around[:axes] = room.periodic
    thick = all(wall.thick for wall in room.walls)
    radii = np.array(radius, dtype=float)
    order = np.argsort(-radii, kind="stable")
    cells = np.maximum((size / (2 * radii.max())).astype(np.int64), 1)
    cells[axes:] = 1
    first, after = np.full(cells.prod(), -1, np.int64), np.full(len(radii), -1, np.int64)
    x, placed, tried = np.zeros((len(radii), 3)), 0, 0
    while placed < len(radii):
        if tried > PROPOSALS * len(radii):
            raise CaromError(
                f"scattered: expected a density that chance can reach, got {placed} of {len(radii)} balls in;"
                " start from a lattice, or with carom.gas.dense"
            )
        batch = rng.random((2 * (len(radii) - placed) + 100, 3)) * size
        tried += len(batch)
        batch[:, axes:] = 0
        free = room.clearance(0.0, batch)
        placed = _compiled()(
            x, radii[order], placed, batch, free if thick else np.where(free >= 0, math.inf, -1.0), size, around, cells, first,
            after, axes,
        )  # fmt: skip
    found = np.zeros_like(x)
    found[order] = x
    return found


@functools.cache
def _compiled() -> Callable[..., int]:
    from carom.compiled import njit

    return njit(_scatter)


def _scatter(
    x: Any, radii: Any, placed: int, batch: Any, room: Any, size: Any, around: Any, cells: Any, first: Any, after: Any,
    axes: int,
) -> int:  # fmt: skip
    """Put in as many balls as a batch of places, each with room for a ball within the walls, has room for; how many are in."""
    place, there = np.zeros(3, np.int64), np.zeros(3, np.int64)
    for k in range(batch.shape[0]):
        if placed == x.shape[0]:
            break
        a = radii[placed]
        if room[k] < a:
            continue
        for axis in range(3):
            x[placed, axis] = batch[k, axis]
            place[axis] = min(int(x[placed, axis] / size[axis] * cells[axis]), cells[axis] - 1)
        free = True
        for step in range(27 if axes == 3 else 9):
            rest, inside = step, True
            for axis in range(3):
                there[axis] = place[axis] + (rest % 3 - 1 if axis < axes else 0)
                rest //= 3
                if around[axis]:
                    there[axis] %= cells[axis]
                elif there[axis] < 0 or there[axis] >= cells[axis]:
                    inside = False
            if not inside:
                continue
            other = first[(there[2] * cells[1] + there[1]) * cells[0] + there[0]]
            while other >= 0:
                square = 0.0
                for axis in range(axes):
                    r = abs(x[placed, axis] - x[other, axis])
                    r = min(r, size[axis] - r) if around[axis] else r
                    square += r * r
                if square < (a + radii[other]) * (a + radii[other]):
                    free = False
                other = after[other]
        if free:
            cell = (place[2] * cells[1] + place[1]) * cells[0] + place[0]
            after[placed] = first[cell]
            first[cell] = placed
            placed += 1
    return placed
