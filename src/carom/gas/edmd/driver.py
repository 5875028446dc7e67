"""Driver of the event engine: make, save, restore and advance the arrays of a gas."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve import ROW
from carom.core.jit.threads import Pace, block_slices
from carom.gas.edmd import loop
from carom.gas.edmd.calendar import SLOTS, calendar_sizes, morton_offsets, neighbour_tables, walls_of_cells
from carom.gas.edmd.collisions import MOST_IMAGES
from carom.gas.edmd.gas_records import (
    BODY,
    CONTACT_FORM,
    CURVE,
    FLOW,
    HEAT,
    LAYER,
    LIMIT,
    MOTION,
    PAIR,
    PLAN,
    PLANE,
    SHEAR,
    SPECIES,
    SYSTEM,
    WALL_CONTACT,
    WALL_FACE,
    WHOLE,
    Averages,
    Balls,
    Calendar,
    Cells,
    Features,
    Grid,
    Materials,
    Neighbours,
    Scratch,
    WallRecords,
)

BINS_PER_BALL = 4  # of the calendar
FIRST_LOOKS = 1 << 20  # at other balls, in the first call of the compiled loop; a step may look at all of them
MOST_LOOKS = (
    1 << 27
)  # in any call of a sheared gas: a step looks at one image, or at all images of a whole row of balls
CACHE_LINE = 64  # bytes
BLOCK = 1 << 16  # balls that are copied at once: of ten million, a copy of all takes as much memory as the gas

# The arrays from which all others follow: the state of a gas, as it is saved, and the type of each one's elements.
STATE = {
    "system": SYSTEM,
    "motions": MOTION,
    "plans": PLAN,
    "bodies": BODY,
    "numbers": np.dtype("u4"),
    "species": SPECIES,
    "pairs": PAIR,
    "pair_forms": CONTACT_FORM,
    "contacts": WALL_CONTACT,
    "contact_forms": CONTACT_FORM,
    "faces": WALL_FACE,
    "whole": WHOLE,
    "flows": FLOW,
    "layers": LAYER,
    "curves": np.dtype("f8"),
    "shear": SHEAR,
}


class SystemRecords(NamedTuple):
    """A gas without its balls: the system, species, contacts of pairs, contacts with walls, faces of walls, means over time."""

    system: NDArray[np.void]
    species: NDArray[np.void]
    pairs: NDArray[np.void]
    pair_forms: NDArray[np.void]
    contacts: NDArray[np.void]
    contact_forms: NDArray[np.void]
    faces: NDArray[np.void]
    curves: NDArray[np.float64]
    shear: NDArray[np.void]
    """One record, or none."""
    whole: NDArray[np.void]
    flows: NDArray[np.void]
    layers: NDArray[np.void]


class GasArrays(NamedTuple):
    """All arrays of a gas, grouped as the loop takes them."""

    system: NDArray[np.void]
    balls: Balls
    materials: Materials
    walls: WallRecords
    averages: Averages
    calendar: Calendar
    cells: Cells
    grid: Grid
    near: Neighbours
    scratch: Scratch
    shear: NDArray[np.void]
    heat: NDArray[np.void]
    """One HEAT while the heat current is measured, else none; no part of the state."""
    turned: NDArray[np.float64]
    """(N, 3) while the heat current is measured, else (0, 3)."""


class _CompiledLoop(NamedTuple):
    fill_cells: Callable[..., Any]
    run: Callable[..., Any]
    synchronize: Callable[..., Any]
    close_cycle: Callable[..., Any]


@functools.cache
def compiled_loops() -> _CompiledLoop:
    """Return the compiled functions of the loop."""
    return _CompiledLoop(*map(_compiled, _CompiledLoop._fields))


@functools.cache
def _compiled(name: str) -> Callable[..., Any]:
    from carom.core.jit.calls import register_prefetch
    from carom.core.jit.compile import njit

    # Without reference counts of arrays (_nrt): nothing is allocated in the loop, and counting took half of its time.
    # Without Python's lock (nogil): the gases of an ensemble run at once.
    return njit(getattr(loop, name), needs=(register_prefetch,), _nrt=False, nogil=True)


def loop_is_cached() -> bool:
    """Return whether some variant of the loop has been compiled before, by this version of the sources."""
    from carom.core.jit.compile import is_cached

    return is_cached(loop.run)


def _allocate(one: Any, species: Any) -> dict[str, NDArray[Any]]:
    """Return zeros for all large arrays, in one piece: NumPy gets large memory pages for it, which saves address look-ups.

    Each array begins on a cache line, so that no record of 64 bytes lies on two.
    """
    count = int(one["balls"])
    number, ball = np.dtype("f8"), np.dtype("u4")
    heads, page_ends, blocks = calendar_sizes(count, int(one["bins"]))
    # (both slots of the last cell are written, and whole groups of eight)
    room = _max_neighbours(one, species) + SLOTS + 8 & -8
    # (the last plan is the thermostat's)
    wanted = {
        "motions": (count, MOTION), "plans": (count + 1, PLAN), "bodies": (count, BODY), "numbers": (count, ball),
        "heads": (heads, ball), "page_ends": (page_ends, ball), "blocks": (blocks, ball),
        "slots": (morton_offsets(one)[1], ball), "links": (count, ball), "found": (room, ball), "b": (room, number),
        "u2": (room, number), "c": (room, number), "times": (room, number),
    }  # fmt: skip
    sizes = [-(-n * kind.itemsize // CACHE_LINE) * CACHE_LINE for n, kind in wanted.values()]
    raw = np.zeros(sum(sizes) + CACHE_LINE, np.uint8)
    at, arrays = -raw.ctypes.data % CACHE_LINE, {}
    for (name, (n, kind)), size in zip(wanted.items(), sizes, strict=True):
        arrays[name] = raw[at : at + n * kind.itemsize].view(kind)
        at += size
    return arrays


def _max_neighbours(one: Any, species: Any) -> int:
    """Return an upper bound of the number of balls with centres in a cell and those around it: what their volume has room for."""
    axes, radius = int(one["dimensions"]), species["radius"]
    region = math.prod(3 * float(one["cell_size"][k]) + 2 * float(radius.max()) for k in range(axes))
    small = float(radius.min()) * min(float(one["scale"]), 1.0)
    return min(
        int(one["balls"]), int(1.01 * region / (math.pi * small**2 if axes == 2 else 4 / 3 * math.pi * small**3))
    )


def _assemble(state: dict[str, Any], memory: dict[str, NDArray[Any]]) -> GasArrays:
    """Return all arrays of a gas in this state, with calendar and cells empty."""
    one = state["system"][0]
    curves = state["curves"].reshape(-1, ROW)
    interior, cell_sets, sets = walls_of_cells(one, state["faces"], state["contacts"], curves)
    offsets, shifts = neighbour_tables(one)
    return GasArrays(
        system=state["system"],
        balls=Balls(*(state[name] for name in Balls._fields)),
        materials=Materials(*(state[name] for name in Materials._fields)),
        walls=WallRecords(state["faces"], state["contacts"], state["contact_forms"], cell_sets, sets, curves),
        averages=Averages(*(state[name] for name in Averages._fields)),
        calendar=Calendar(*(memory[name] for name in Calendar._fields)),
        cells=Cells(memory["slots"], memory["links"], offsets, shifts),
        grid=Grid(
            one["side"].copy(), one["cell_size"].copy(), one["gravity"].copy(), one["cells"].copy(), one["periodic"].copy(),
            np.array(interior, np.int64),
        ),
        near=Neighbours(
            memory["found"], np.zeros(12), memory["b"], memory["u2"], memory["c"], memory["times"],
            memory["times"].view(np.int64),
        ),
        scratch=Scratch(*(np.zeros(1, kind) for kind in (MOTION, PLAN, BODY, np.uint32))),
        shear=state["shear"],
        heat=np.zeros(0, HEAT),
        turned=np.zeros((0, 3)),
    )  # fmt: skip


def _free_axes(one: Any, faces: Any, contacts: Any) -> NDArray[np.int64]:
    """Return the axes along which momentum is conserved: periodic, no force, no wall that stops or holds balls."""
    free = (one["periodic"] == 1) & (one["gravity"] == 0)
    for axis, name in enumerate("xyz"):
        free[axis] &= not (faces["n" + name].any() or faces["a" + name].any())
    smooth = (contacts["mu"] == 0) | (contacts["beta"] == -1)
    isolated = one["rate"] == 0 and one["growth"] == 0 and smooth.all() and (faces["temperature"] < 0).all()
    return np.asarray(free & isolated, np.int64)


def put_in_place(records: SystemRecords, kinds: Any, x: Any) -> dict[str, NDArray[Any]]:
    """Allocate the memory of a gas, and put the balls there: species (N,) and positions (N, 3), wrapped into a periodic box.

    Position by position, so that no more than the gas itself is in memory: nor need ``x`` be there any more after this.
    """
    one, count = records.system[0], len(x)
    # (relative to a flow there is no other frame)
    one["free"] = 0 if len(records.shear) else _free_axes(one, records.faces, records.contacts)
    one["balls"], one["species"], one["bins"] = count, len(records.species), BINS_PER_BALL * count
    memory = _allocate(one, records.species)
    motions = memory["motions"]
    for rows in block_slices(count, BLOCK):
        turns = np.where(one["periodic"] == 1, np.floor(x[rows] / one["side"]), 0)
        for k, axis in enumerate("xyz"):
            motions[axis][rows] = x[rows, k] - turns[:, k] * one["side"][k]
        if turns.any():
            memory["plans"]["image"][rows] = turns
    motions["species"] = kinds
    memory["numbers"][:] = np.arange(count, dtype=np.uint32)
    return memory


def arrays_at_start(records: SystemRecords, memory: dict[str, NDArray[Any]], v: Any = None, w: Any = None) -> GasArrays:
    """Return the arrays of a gas at its start, whose balls are in place; velocities and spins (N, 3), if not there yet."""
    one = records.system[0]
    plans, bodies = memory["plans"], memory["bodies"]
    for k, axis in enumerate("xyz"):
        if v is not None:
            memory["motions"]["v" + axis] = v[:, k]
        if w is not None:
            bodies["w" + axis] = w[:, k]
    bodies["last_contact"] = -math.inf
    plans[-1]["event_time"], plans[-1]["collision_time"] = math.inf, -math.inf
    state = {name: memory[name] for name in Balls._fields} | records._asdict()
    arrays = _assemble(state, memory)
    compiled_loops().fill_cells(one, arrays.grid, arrays.balls, arrays.materials, arrays.cells)
    return arrays


def restore(state: Mapping[str, NDArray[Any]]) -> GasArrays:
    """Return the arrays of a gas from its saved state, from which it continues with the same bits."""
    memory = _allocate(state["system"][0], state["species"])
    copies = {}
    for name in STATE:
        given = state[name]
        copies[name] = memory[name] if name in memory else np.empty_like(given)
        copies[name][:] = given
        del given  # (a state read from a file has one array in memory at a time)
    arrays = _assemble(copies, memory)
    _compiled("restore_lists")(arrays.system[0], arrays.balls, arrays.calendar, arrays.cells)
    return arrays


def saved_blocks(arrays: GasArrays, name: str) -> tuple[int, Iterator[NDArray[Any]]]:
    """Return the length of an array of the state, and copies of it block by block (one block at least).

    The places in the calendar are left out: another run would fill it in another order.
    """
    parts = (arrays.balls, arrays.materials, arrays.walls, arrays.averages)
    found = {name: one for part in parts for name, one in part._asdict().items()}
    found |= {"system": arrays.system, "shear": arrays.shear}
    array: NDArray[Any] = found[name].ravel() if name == "curves" else found[name]

    def blocks() -> Iterator[NDArray[Any]]:
        for rows in block_slices(max(len(array), 1), BLOCK):
            block = array[rows].copy()
            for field in ("bin", "next", "previous") if name == "plans" else ():
                block[field] = 0
            yield block

    return len(array), blocks()


def _features(arrays: GasArrays) -> Features | None:
    """Return None where all walls are fixed planes, else what the general loop needs, which takes twice as long to compile."""
    one, faces = arrays.system[0], arrays.walls.faces
    special = (faces["form"] != PLANE) | (faces["bounded"] != 0) | (faces["temperature"] >= 0)
    special |= (faces["amplitude"] != 0) | (faces["mass"] > 0) | (faces["is_belt"] != 0)
    if not (special.any() or one["growth"] != 0 or one["rate"] != 0 or len(arrays.shear) or len(arrays.heat)):
        return None
    curved = (faces["form"] == CURVE).any()
    shear, heat = (part if len(part) else None for part in (arrays.shear, arrays.heat))
    turned = arrays.turned if len(arrays.turned) else None
    return Features(arrays.walls.curves if curved else None, shear, heat, turned)


def advance(arrays: GasArrays, until: float, max_collisions: int, stop: Callable[[], bool] = lambda: False) -> None:
    """Advance to a time, or by so many collisions; ``system["status"]`` says which came first, unless ``stop`` returns True.

    That is asked some times a second, however rare collisions are.
    """
    run, one, features = compiled_loops().run, arrays.system[0], _features(arrays)
    last, pace = _collisions(one) + max_collisions, Pace(max(FIRST_LOOKS // len(arrays.balls.motions), 1))
    row = (
        3 * len(arrays.balls.motions) / math.prod(one["cells"][1:].tolist())
    )  # balls, on average, across a sheared border
    most = max(int(MOST_LOOKS / (row * MOST_IMAGES)), 1) if len(arrays.shear) else 1 << 62
    while True:
        steps = min(pace.begin(), most)
        status = run(one, *arrays[1:-3], until, last - _collisions(one), steps, features)
        if status != LIMIT or _collisions(one) >= last or stop():
            return
        pace.done(steps)


def _collisions(one: Any) -> int:
    return int(one["pair_collisions"] + one["wall_collisions"])


def averages_until(arrays: GasArrays, time: float) -> Averages:
    """Return the sums for means over time, with the integrals until a time not before the last event, as copies."""
    one, found = arrays.system[0], Averages(*(part.copy() for part in arrays.averages))
    now = (time - one["base"]) - one["rest"]
    shear = arrays.shear if len(arrays.shear) else None
    compiled_loops().close_cycle(arrays.grid, arrays.balls, arrays.materials.species, found, now, shear, False)
    return found


def heat_until(arrays: GasArrays, time: float) -> NDArray[np.float64]:
    """Return the integral over time of the heat current of a gas without walls and forces, until not before the last event."""
    one, motions, bodies = arrays.system[0], arrays.balls.motions, arrays.balls.bodies
    kinds, sums = arrays.materials.species[motions["species"]], arrays.heat[0]
    v = np.stack([motions[f"v{axis}"] for axis in "xyz"], axis=1)
    w = np.stack([bodies[f"w{axis}"] for axis in "xyz"], axis=1)
    turning = sums["spins"] * kinds["kappa"] * kinds["radius"] ** 2 * (w * w).sum(axis=1)
    energy = kinds["mass"] / 2 * ((v * v).sum(axis=1) + turning)
    way = energy * ((time - one["base"]) - one["rest"] - motions["time"])
    found: NDArray[np.float64] = (
        np.array([sums["carried_" + axis] + sums["passed_" + axis] for axis in "xyz"]) + way @ v
    )
    return found[: int(one["dimensions"])]


def turned_until(arrays: GasArrays, time: float) -> NDArray[np.float64]:
    """Return the integrals over time of the spins of all balls, by their numbers, (N, 3), until not before the last event."""
    one, motions, bodies, numbers = arrays.system[0], arrays.balls.motions, arrays.balls.bodies, arrays.balls.numbers
    found, s = arrays.turned.copy(), ((time - one["base"]) - one["rest"]) - motions["time"]
    for k, name in enumerate(("wx", "wy", "wz")):
        found[numbers, k] += bodies[name] * s
    return found


def total_bytes(arrays: Any) -> int:
    """Return the memory of arrays in nested tuples."""
    return arrays.nbytes if isinstance(arrays, np.ndarray) else sum(map(total_bytes, arrays))


def time_of_last_event(arrays: GasArrays) -> float:
    """Return the time of the last event."""
    one = arrays.system[0]
    return float(one["base"] + (one["rest"] + one["now"]))


def synchronized_blocks(
    arrays: GasArrays, time: float
) -> Iterator[tuple[slice, NDArray[np.void], NDArray[np.void], NDArray[np.int32]]]:
    """Yield copies of motions, bodies and images at a time not before the last event, block by block in the order of numbers."""
    system, balls = arrays.system.copy(), arrays.balls
    system["now"] = max(system[0]["now"], (time - system[0]["base"]) - system[0]["rest"])
    place = np.empty_like(balls.numbers)
    place[balls.numbers] = np.arange(len(place), dtype=place.dtype)
    for rows in block_slices(len(place), BLOCK):
        motions = balls.motions[place[rows]]
        compiled_loops().synchronize(system[0], arrays.grid, motions)
        yield rows, motions, balls.bodies[place[rows]], balls.plans["image"][place[rows]]


def synchronized(arrays: GasArrays, time: float) -> tuple[NDArray[np.void], NDArray[np.void], NDArray[np.int32]]:
    """Return the blocks of :func:`synchronized_blocks`, in one piece."""
    count = len(arrays.balls.motions)
    motions, bodies, images = np.empty(count, MOTION), np.empty(count, BODY), np.empty((count, 3), np.int32)
    for rows, *parts in synchronized_blocks(arrays, time):
        motions[rows], bodies[rows], images[rows] = parts
    return motions, bodies, images
