"""The loop of many balls compiled, and its arrays made: from plain arrays of numbers to records, and on from there."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.engine import swarm
from carom.engine.cells import SLOTS, tables
from carom.engine.swarm_arrays import BODY, MOTION, PLAN, PLANE
from carom.engine.swarm_lists import walls_of_cells
from carom.engine.swarm_prefetch import register_prefetch

__all__ = ["STATE", "Arrays", "advance", "balls_at", "make", "restore"]

BINS = 4  # of the calendar, a ball
LINE = 64  # bytes of a cache line


class Arrays(NamedTuple):
    """All of a swarm. The first nine are its state, to be saved; the rest follows from them."""

    swarm: NDArray[np.void]
    motions: NDArray[np.void]
    plans: NDArray[np.void]
    bodies: NDArray[np.void]
    species: NDArray[np.void]
    pairs: NDArray[np.void]
    walls: NDArray[np.void]
    faces: NDArray[np.void]
    heads: NDArray[np.uint32]
    box: NDArray[np.float64]
    grid: NDArray[np.int64]
    lists: NDArray[np.int32]
    sets: NDArray[np.int32]
    cells: NDArray[np.uint32]
    links: NDArray[np.uint32]
    offsets: NDArray[np.int64]
    shifts: NDArray[np.float64]
    found: NDArray[np.uint32]
    near: NDArray[np.float64]
    work: NDArray[np.float64]
    whole: NDArray[np.int64]


STATE = Arrays._fields[:9]


class _Compiled(NamedTuple):
    place: Callable[..., Any]
    refill: Callable[..., Any]
    run: Callable[..., Any]
    bring_to_now: Callable[..., Any]


@functools.cache
def _compiled() -> _Compiled:
    from carom.compiled import njit

    register_prefetch()
    # Without counting who holds an array: nothing is made in the loop, and the counters were half of its time.

    return _Compiled(*(njit(getattr(swarm, name), _nrt=False) for name in _Compiled._fields))


def _aligned(count: int, kind: np.dtype[Any]) -> NDArray[Any]:
    """Zeros that begin on a cache line, so that no record of 64 bytes lies on two."""
    raw = np.zeros(count * kind.itemsize + LINE, np.uint8)
    skip = -raw.ctypes.data % LINE
    return raw[skip : skip + count * kind.itemsize].view(kind)


def _most_around(one: Any, species: Any) -> int:
    """No more balls than this have their centres in a cell and those around it: as many as their volume has room for."""
    axes, radius = int(one["axes"]), species["radius"]
    region = math.prod(3 * float(one["size"][k]) + 2 * float(radius.max()) for k in range(axes))
    small = float(radius.min()) * min(float(one["scale"]), 1.0)
    return min(
        int(one["count"]), int(1.01 * region / (math.pi * small**2 if axes == 2 else 4 / 3 * math.pi * small**3))
    )


def _cells(state: tuple[Any, ...]) -> tuple[Any, ...]:
    """The cells, empty, and what is looked up and written while they are searched."""
    one, (calm, lists, sets) = (
        state[0][0],
        walls_of_cells(*(state[Arrays._fields.index(k)] for k in ("swarm", "faces", "walls"))),
    )
    # beyond a wall lies a layer of cells without balls
    shape = [int(n) + (0 if periodic else 1) for n, periodic in zip(one["cells"], one["periodic"], strict=True)]
    one["stride"] = (SLOTS, SLOTS * shape[0], SLOTS * shape[0] * shape[1])
    offsets, shifts = tables(one)
    cells, links = _aligned(SLOTS * math.prod(shape), np.dtype("u4")), _aligned(int(one["count"]), np.dtype("u4"))
    # (both slots of the last cell are written, and whole blocks of eight)
    room = _most_around(one, state[Arrays._fields.index("species")]) + SLOTS + 8 & -8
    work = _aligned(4 * room, np.dtype("f8")).reshape(4, room)
    box = np.concatenate([one["side"], one["size"], one["pull"]])
    grid = np.concatenate([one["cells"], one["stride"], one["periodic"], calm])
    return (
        box,
        grid,
        lists,
        sets,
        cells,
        links,
        offsets,
        shifts,
        np.zeros(room, np.uint32),
        np.zeros(12),
        work,
        work.view(np.int64),
    )


def _free(one: Any, faces: Any, walls: Any) -> NDArray[np.int64]:
    """The axes along which nothing changes the momentum of all balls: periodic, no force, no wall that stops or holds."""
    free = (one["periodic"] == 1) & (one["pull"] == 0)
    for axis, name in enumerate("xyz"):
        free[axis] &= not (faces["n" + name].any() or faces["a" + name].any())
    smooth = (walls["mu"] == 0) | (walls["beta"] == -1)
    still = one["rate"] == 0 and one["growth"] == 0 and smooth.all() and (faces["warm"] < 0).all()
    return np.asarray(free & still, np.int64)


def make(world: Any, species: Any, pairs: Any, walls: Any, faces: Any, kinds: Any, x: Any, v: Any, w: Any) -> Arrays:
    """A swarm at its start. Positions are brought into a periodic box."""
    count = len(x)
    world[0]["free"] = _free(world[0], faces, walls)
    world["count"], world["kinds"], world["bins"] = count, len(species), BINS * count
    motions, plans, bodies = _aligned(count, MOTION), _aligned(count + 1, PLAN), _aligned(count, BODY)
    turns = np.where(world["periodic"][0] == 1, np.floor(x / world["side"][0]), 0)
    x = x - turns * world["side"][0]
    for k, axis in enumerate("xyz"):
        motions[axis], motions["v" + axis], bodies["w" + axis] = x[:, k], v[:, k], w[:, k]
    motions["kind"] = kinds
    bodies["met"], plans["image"][:count] = -math.inf, turns
    # (the last plan is the thermostat's)
    plans[count]["at"], plans[count]["hit_at"] = math.inf, -math.inf
    heads = _aligned(BINS * count + 1, np.dtype("u4"))
    state = (world, motions, plans, bodies, species, pairs, walls, faces, heads)
    arrays = Arrays(*state, *_cells(state))
    _compiled().place(world[0], arrays.box, arrays.grid, motions, plans, species, arrays.cells, arrays.links)
    return arrays


def restore(state: tuple[Any, ...]) -> Arrays:
    """A swarm from its saved state (the first nine arrays): it goes on with the same bits."""
    copies = []
    for array in state:
        copies.append(_aligned(len(array), array.dtype))
        copies[-1][:] = array
    arrays = Arrays(*copies, *_cells(tuple(copies)))
    _compiled().refill(arrays.grid, arrays.motions, arrays.plans, arrays.cells, arrays.links)
    return arrays


def _more(arrays: Arrays) -> int | None:
    """None where there are only planes at rest; 1 for the loop that can do more, whose compiling takes twice as long."""
    one, faces = arrays.swarm[0], arrays.faces
    moves = (faces["form"] != PLANE) | (faces["bounded"] != 0) | (faces["swing"] != 0) | (faces["warm"] >= 0)
    return 1 if moves.any() or one["growth"] != 0 or one["rate"] != 0 else None


def advance(arrays: Arrays, until: float, most: int) -> None:
    """Go on to a time, or by so many collisions; ``swarm["status"]`` says which."""
    _compiled().run(arrays.swarm[0], *arrays[1:], until, most, _more(arrays))


def balls_at(arrays: Arrays, time: float) -> tuple[NDArray[np.void], NDArray[np.void]]:
    """Copies of motions and bodies, brought to a time not before the last event."""
    world, motions = arrays.swarm.copy(), arrays.motions.copy()
    world["now"] = max(world[0]["now"], (time - world[0]["base"]) - world[0]["rest"])
    _compiled().bring_to_now(world[0], arrays.box, motions)
    return motions, arrays.bodies.copy()
