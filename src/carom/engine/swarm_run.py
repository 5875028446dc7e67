"""The loop of many balls compiled, and its arrays made: from plain arrays of numbers to records, and on from there."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.engine import swarm
from carom.engine.cells import tables
from carom.engine.swarm_arrays import BODY, DONE, FULL, MOTION, PLAN, PLANE, ROOM
from carom.engine.swarm_lists import walls_of_cells
from carom.engine.swarm_prefetch import register_prefetch

__all__ = ["STATE", "Arrays", "advance", "balls_at", "make", "restore"]

SLOTS = 8  # of a cell at first: its count, and room for 7 balls
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


def _cells(state: tuple[Any, ...], slots: int) -> tuple[Any, ...]:
    """The cells, empty, with so many slots each, and what is looked up and written while they are searched."""
    one, (calm, lists, sets) = (
        state[0][0],
        walls_of_cells(*(state[Arrays._fields.index(k)] for k in ("swarm", "faces", "walls"))),
    )
    # beyond a wall lies a layer of cells without balls
    shape = [int(n) + (0 if periodic else 1) for n, periodic in zip(one["cells"], one["periodic"], strict=True)]
    one["stride"] = (slots, slots * shape[0], slots * shape[0] * shape[1])
    offsets, shifts = tables(one)
    cells = _aligned(slots * math.prod(shape), np.dtype("u4"))
    room = 27 * max(slots, ROOM) + 8 & -8
    work = _aligned(4 * room, np.dtype("f8")).reshape(4, room)
    box = np.concatenate([one["side"], one["size"], one["pull"]])
    grid = np.concatenate([one["cells"], one["stride"], one["periodic"], calm])
    return (
        box,
        grid,
        lists,
        sets,
        cells,
        offsets,
        shifts,
        np.zeros(room, np.uint32),
        np.zeros(12),
        work,
        work.view(np.int64),
    )


def _fill(state: tuple[Any, ...], fill: Callable[[Any], Any], slots: int) -> Arrays:
    while True:
        arrays = Arrays(*state, *_cells(state, slots))
        if fill(arrays) == DONE:
            return arrays
        slots *= 2


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
    return _fill(
        state, lambda a: _compiled().place(a.swarm[0], a.box, a.grid, a.motions, a.plans, a.species, a.cells), SLOTS
    )


def restore(state: tuple[Any, ...]) -> Arrays:
    """A swarm from its saved state (the first nine arrays): it goes on with the same bits."""
    slots = max(int(state[0]["stride"][0, 0]), SLOTS)
    copies = []
    for array in state:
        copies.append(_aligned(len(array), array.dtype))
        copies[-1][:] = array
    return _fill(tuple(copies), lambda a: _compiled().refill(a.grid, a.motions, a.plans, a.cells), slots)


def _more(arrays: Arrays) -> int | None:
    """None where there are only planes at rest; 1 for the loop that can do more, whose compiling takes twice as long."""
    one, faces = arrays.swarm[0], arrays.faces
    moves = (faces["form"] != PLANE) | (faces["bounded"] != 0) | (faces["swing"] != 0) | (faces["warm"] >= 0)
    return 1 if moves.any() or one["growth"] != 0 or one["rate"] != 0 else None


def advance(arrays: Arrays, until: float, most: int) -> Arrays:
    """Go on to a time, or by so many collisions; ``swarm["status"]`` says which. The arrays, new ones if cells grew."""
    more = _more(arrays)
    target = int(arrays.swarm[0]["pair_hits"] + arrays.swarm[0]["wall_hits"]) + most
    while True:
        one = arrays.swarm[0]
        # (it may be so from an interrupted call)
        if one["status"] == FULL:
            slots = 2 * int(one["stride"][0])
            arrays = _fill(
                arrays[: len(STATE)], lambda a: _compiled().refill(a.grid, a.motions, a.plans, a.cells), slots
            )
            one = arrays.swarm[0]
            one["status"] = DONE
        left = target - int(one["pair_hits"] + one["wall_hits"])
        if left <= 0 or _compiled().run(one, *arrays[1:], until, left, more) != FULL:
            return arrays


def balls_at(arrays: Arrays, time: float) -> tuple[NDArray[np.void], NDArray[np.void]]:
    """Copies of motions and bodies, brought to a time not before the last event."""
    world, motions = arrays.swarm.copy(), arrays.motions.copy()
    world["now"] = max(world[0]["now"], (time - world[0]["base"]) - world[0]["rest"])
    _compiled().bring_to_now(world[0], arrays.box, motions)
    return motions, arrays.bodies.copy()
