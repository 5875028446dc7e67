"""The loop of many balls compiled, and its arrays made: from plain arrays of numbers to records, and on from there."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.engine import swarm
from carom.engine.cells import SLOTS, along_curve, tables
from carom.engine.queue import calendar
from carom.engine.swarm_arrays import BODY, MOTION, OVAL, PLAN, PLANE
from carom.engine.swarm_lists import walls_of_cells
from carom.engine.swarm_prefetch import register_prefetch

__all__ = ["STATE", "Arrays", "advance", "balls_at", "make", "restore", "saved"]

BINS = 4  # of the calendar, a ball
LINE = 64  # bytes of a cache line


class Arrays(NamedTuple):
    """All of a swarm. The first nine are its state, to be saved; the rest follows from them."""

    swarm: NDArray[np.void]
    motions: NDArray[np.void]
    plans: NDArray[np.void]
    bodies: NDArray[np.void]
    numbers: NDArray[np.uint32]
    """Which ball it is whose records lie at a place."""
    species: NDArray[np.void]
    pairs: NDArray[np.void]
    walls: NDArray[np.void]
    faces: NDArray[np.void]
    heads: NDArray[np.uint32]
    tails: NDArray[np.uint32]
    leaves: NDArray[np.uint32]
    spare: tuple[NDArray[Any], ...]
    """Room for one more motion, plan, body and number."""
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


def _memory(one: Any, species: Any) -> dict[str, NDArray[Any]]:
    """Zeros for all large arrays, in one piece: for one that is large NumPy asks for large pages, which saves looking them up.

    Each begins on a cache line, so that no record of 64 bytes lies on two.
    """
    count = int(one["count"])
    number, ball = np.dtype("f8"), np.dtype("u4")
    heads, tails, leaves = calendar(count, int(one["bins"]))
    # (both slots of the last cell are written, and whole blocks of eight)
    room = _most_around(one, species) + SLOTS + 8 & -8
    # (the last plan is the thermostat's)
    wanted = {
        "motions": (count, MOTION), "plans": (count + 1, PLAN), "bodies": (count, BODY), "numbers": (count, ball),
        "heads": (heads, ball), "tails": (tails, ball), "leaves": (leaves, ball), "cells": (along_curve(one)[1], ball),
        "links": (count, ball), "found": (room, ball), "work": (4 * room, number),
    }  # fmt: skip
    sizes = [-(-n * kind.itemsize // LINE) * LINE for n, kind in wanted.values()]
    raw = np.zeros(sum(sizes) + LINE, np.uint8)
    at, found = -raw.ctypes.data % LINE, {}
    for (name, (n, kind)), size in zip(wanted.items(), sizes, strict=True):
        found[name] = raw[at : at + n * kind.itemsize].view(kind)
        at += size
    return found


def _most_around(one: Any, species: Any) -> int:
    """No more balls than this have their centres in a cell and those around it: as many as their volume has room for."""
    axes, radius = int(one["axes"]), species["radius"]
    region = math.prod(3 * float(one["size"][k]) + 2 * float(radius.max()) for k in range(axes))
    small = float(radius.min()) * min(float(one["scale"]), 1.0)
    return min(
        int(one["count"]), int(1.01 * region / (math.pi * small**2 if axes == 2 else 4 / 3 * math.pi * small**3))
    )


def _whole(state: tuple[Any, ...], memory: dict[str, NDArray[Any]]) -> Arrays:
    """All arrays of a swarm of this state, with calendar and cells empty."""
    named = dict(zip(STATE, state, strict=True))
    one = named["swarm"][0]
    calm, lists, sets = walls_of_cells(named["swarm"], named["faces"], named["walls"])
    offsets, shifts = tables(one)
    work = memory["work"].reshape(4, -1)
    rest = {name: memory[name] for name in ("heads", "tails", "leaves", "cells", "links", "found")}
    return Arrays(
        **named,
        **rest,
        spare=tuple(np.zeros(1, kind) for kind in (MOTION, PLAN, BODY, np.uint32)),
        box=np.concatenate([one["side"], one["size"], one["pull"]]),
        grid=np.concatenate([one["cells"], one["periodic"], calm]),
        lists=lists,
        sets=sets,
        offsets=offsets,
        shifts=shifts,
        near=np.zeros(12),
        work=work,
        whole=work.view(np.int64),
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
    memory = _memory(world[0], species)
    motions, plans, bodies = (memory[name] for name in ("motions", "plans", "bodies"))
    turns = np.where(world["periodic"][0] == 1, np.floor(x / world["side"][0]), 0)
    x = x - turns * world["side"][0]
    for k, axis in enumerate("xyz"):
        motions[axis], motions["v" + axis], bodies["w" + axis] = x[:, k], v[:, k], w[:, k]
    motions["kind"] = kinds
    bodies["met"], plans["image"][:count] = -math.inf, turns
    plans[count]["at"], plans[count]["hit_at"] = math.inf, -math.inf
    numbers = memory["numbers"]
    numbers[:] = np.arange(count)
    state = (world, motions, plans, bodies, numbers, species, pairs, walls, faces)
    arrays = _whole(state, memory)
    _compiled().place(
        world[0], arrays.box, arrays.grid, motions, plans, species, arrays.cells, arrays.links, arrays.offsets
    )
    return arrays


def restore(state: tuple[Any, ...]) -> Arrays:
    """A swarm from its saved state (the first nine arrays): it goes on with the same bits."""
    named = dict(zip(STATE, state, strict=True))
    memory = _memory(named["swarm"][0], named["species"])
    copies = []
    for name, array in named.items():
        copies.append(memory.get(name, np.empty_like(array)))
        copies[-1][:] = array
    arrays = _whole(tuple(copies), memory)
    _compiled().refill(
        arrays.swarm[0], arrays.motions, arrays.plans, arrays.heads, arrays.tails, arrays.leaves, arrays.cells, arrays.links,
        arrays.offsets,
    )  # fmt: skip
    return arrays


def saved(arrays: Arrays) -> dict[str, NDArray[Any]]:
    """The state, copied: without the places in the calendar, which another run would fill in another order."""
    state = {name: getattr(arrays, name).copy() for name in STATE}
    for name in ("bin", "next", "previous"):
        state["plans"][name] = 0
    return state


def _more(arrays: Arrays) -> tuple[int, int | None] | None:
    """None where there are only planes at rest; a pair for the loop that can do more, whose compiling takes twice as long.

    The pair is (1, 1) where a wall is an ellipse that bounds surfaces, else (1, None): that takes some seconds more.
    """
    one, faces = arrays.swarm[0], arrays.faces
    moves = (faces["form"] != PLANE) | (faces["bounded"] != 0) | (faces["swing"] != 0) | (faces["warm"] >= 0)
    if not (moves.any() or one["growth"] != 0 or one["rate"] != 0):
        return None
    return 1, 1 if (faces["form"] == OVAL).any() else None


def advance(arrays: Arrays, until: float, most: int) -> None:
    """Go on to a time, or by so many collisions; ``swarm["status"]`` says which."""
    _compiled().run(arrays.swarm[0], *arrays[1:], until, most, _more(arrays))


def balls_at(arrays: Arrays, time: float) -> tuple[NDArray[np.void], NDArray[np.void], NDArray[np.int32]]:
    """Copies of motions and bodies, brought to a time not before the last event, and images, all by the balls' numbers."""
    world, motions = arrays.swarm.copy(), arrays.motions.copy()
    world["now"] = max(world[0]["now"], (time - world[0]["base"]) - world[0]["rest"])
    _compiled().bring_to_now(world[0], arrays.box, motions)
    place = np.empty_like(arrays.numbers)
    place[arrays.numbers] = np.arange(len(place))
    return motions[place], arrays.bodies[place], arrays.plans["image"][place]
