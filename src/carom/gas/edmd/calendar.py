"""Calendar queue: the event queue of the engine, a doubly linked list of balls per bin of time.

A binary heap costs log N steps through memory per event; a bin holds one or two balls, so the earliest event is found by
comparing them (G. Paul, J. Comput. Phys. 221, 615 (2007), has the idea). One cycle of the calendar is a
few events per ball; with each cycle all times are shifted to start at zero (:func:`start_cycle`), so they stay small and keep their
digits however long the run.

Only the bins of the current page and of the next exist: a few cache lines. A later event is entered in its page's unsorted
list, which is moved into bins when that page is next; events after the cycle are on one last page. To enter a ball is to append its
index, and to remove it is to leave the entry, which is stale once the ball's plan says otherwise. So nothing far away in
memory is read before an event is due.

A page's entries are in blocks of one cache line each; the first number of a block is where the block before ends. ``page_ends``
holds where the entries of each page end (0: it has none), then the first free block, then how many are free.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve import HALF, X
from carom.core.geometry.curve_arcs import COUNT
from carom.core.jit.kernel import hot_kernel, kernel
from carom.core.roots import two_sum
from carom.gas.edmd.gas_records import CURVE, INDEX_BITS, INSIDE, NO_BALL, PLANE

# An unsigned index needs no test whether it counts from the end; sums are done with signed integers (a signed and an unsigned
# one together become a float).
U64: Any = np.uint64
I64: Any = np.int64

PAGE_BITS = 5
PAGE = 1 << PAGE_BITS  # bins of a page
RING = 2 * PAGE  # bins that exist
BLOCK_LENGTH = 16  # numbers of a block
PENDING = 1 << 31  # flag of a plan's bin: the ball is not in the bin yet, only on its page
SPARE_BLOCKS = 4  # no more blocks than this are begun in one event


def calendar_sizes(balls: int, bins: int) -> tuple[int, int, int]:
    """Return the lengths of the three arrays of a Calendar: room for twice as many entries as balls."""
    pages = -(-bins // PAGE) + 1
    return RING, pages + 2, BLOCK_LENGTH * (pages + 2 * balls // (BLOCK_LENGTH - 1) + 2 + SPARE_BLOCKS)


@hot_kernel
def page_of(bin_: int) -> int:
    """Return the page of a bin."""
    return bin_ >> PAGE_BITS


@hot_kernel
def is_pending(plan: Any, page: int) -> bool:
    """Return whether a ball's entry on a page is valid and the ball is not in its bin yet."""
    return I64(plan.bin) >> PAGE_BITS == (page | PENDING >> PAGE_BITS)  # type: ignore[no-any-return]


@hot_kernel
def _push_to_bin(plans: Any, heads: Any, i: int, b: int) -> None:
    """Put ball i at the head of a bin's list."""
    plan = plans[U64(i)]
    k = b & (RING - 1)
    after = heads[U64(k)]
    plan.bin, plan.next, plan.previous = b, after, NO_BALL
    if after != NO_BALL:
        plans[U64(after)].previous = i
    heads[U64(k)] = i


@hot_kernel
def _append(calendar: Any, i: int, page: int) -> None:
    """Enter ball i on a page."""
    page_ends, blocks = calendar.page_ends, calendar.blocks
    end = I64(page_ends[U64(page)]) + 1
    if end & (BLOCK_LENGTH - 1) <= 1:  # its block is full, or it has none
        first = page_ends.shape[0] - 2
        block = I64(page_ends[U64(first)])
        page_ends[U64(first)] = blocks[U64(block)]
        page_ends[U64(first + 1)] -= np.uint32(1)
        blocks[U64(block)] = end - 1
        end = block + 1
    blocks[U64(end)] = i
    page_ends[U64(page)] = end


@hot_kernel
def schedule(plans: Any, calendar: Any, i: int, width: float, bins: int, current: int) -> None:
    """Put ball i into the bin of its next event, or on its page."""
    place = plans[U64(i)].event_time / width
    # (events after the cycle, and those that never happen, are on the last page)
    last = (calendar.page_ends.shape[0] - 3) * PAGE
    b = last if not place < bins else max(I64(place), current)
    page = page_of(b)
    if page <= page_of(current) + 1:
        _push_to_bin(plans, calendar.heads, i, b)
    else:
        plans[U64(i)].bin = b | PENDING
        _append(calendar, i, page)


@hot_kernel
def unschedule(plans: Any, calendar: Any, i: int) -> None:
    """Take ball i out of its bin; an entry on a page stays, and is stale once the ball is planned anew."""
    plan = plans[U64(i)]
    if plan.bin >= PENDING:
        return
    after, before = plan.next, plan.previous
    if after != NO_BALL:
        plans[U64(after)].previous = before
    if before != NO_BALL:
        plans[U64(before)].next = after
    else:
        calendar.heads[U64(plan.bin & (RING - 1))] = after


@kernel
def load_page(plans: Any, calendar: Any, page: int) -> None:
    """Move the balls entered on a page into their bins, and free its blocks."""
    page_ends, blocks = calendar.page_ends, calendar.blocks
    free = page_ends.shape[0] - 2
    end = I64(page_ends[U64(page)])
    page_ends[U64(page)] = 0
    while end != 0:
        while end & (BLOCK_LENGTH - 1) != 0:
            i = blocks[U64(end)]
            if is_pending(plans[U64(i)], page):
                _push_to_bin(plans, calendar.heads, I64(i), I64(plans[U64(i)].bin) - PENDING)
            end -= 1
        before = I64(blocks[U64(end)])
        blocks[U64(end)] = page_ends[U64(free)]
        page_ends[U64(free)] = end
        page_ends[U64(free + 1)] += np.uint32(1)
        end = before


@hot_kernel
def nearly_full(calendar: Any) -> bool:
    """Return whether so few blocks are free that stale entries have to go: :func:`rebuild`."""
    return calendar.page_ends[U64(calendar.page_ends.shape[0] - 1)] < SPARE_BLOCKS  # type: ignore[no-any-return]


@kernel
def rebuild(plans: Any, calendar: Any, width: float, bins: int, current: int) -> None:
    """Put all balls, and the thermostat, into their bins or on their pages; the current bin is the first."""
    heads, page_ends, blocks = calendar.heads, calendar.page_ends, calendar.blocks
    pages = page_ends.shape[0] - 2
    for k in range(RING):
        heads[U64(k)] = NO_BALL
    for k in range(pages):
        page_ends[U64(k)] = 0
    # (block 0 is unused: a page that ends there has no entries)
    count = blocks.shape[0] // BLOCK_LENGTH
    for k in range(count):
        blocks[U64(k * BLOCK_LENGTH)] = (k + 1) * BLOCK_LENGTH
    page_ends[U64(pages)] = BLOCK_LENGTH
    page_ends[U64(pages + 1)] = count - 1
    for i in range(plans.shape[0]):
        schedule(plans, calendar, i, width, bins, current)


@kernel
def start_cycle(system: Any, balls: Any, faces: Any) -> None:
    """Begin a new cycle: shift every time, and set the width of the bins by the number of events of the last cycle."""
    motions, plans, bodies = balls.motions, balls.plans, balls.bodies
    start = system.bin_width * system.bins
    base, rest = two_sum(system.base, start)
    system.base, system.rest = two_sum(base, system.rest + rest)
    system.now -= start
    system.cycles += 1
    system.bin = 0
    for i in range(motions.shape[0]):
        motions[i].time -= start
        plans[i].event_time -= start
        plans[i].collision_time -= start
        bodies[i].last_contact -= start
    plans[motions.shape[0]].event_time -= start
    system.scale += system.growth * start
    for k in range(faces.shape[0]):
        face = faces[k]
        face.start -= start
        face.since -= start
        if face.amplitude != 0.0:
            # the oscillation that now belongs to
            face.start += math.floor((system.now - face.start) / (2.0 * face.half_period)) * 2.0 * face.half_period
    # one event per bin; at most a factor of two at once
    ratio = system.bins / max(system.events, 1)
    system.bin_width *= min(max(ratio, 0.5), 2.0)
    system.events = 0


# ----------------------------------------------------------------------------------------------------
# Cell list: which balls are near one, and which walls. A cell is at least one diameter wide, so neighbours are in adjacent cells.
#
# A cell has two slots for indices of balls, the first with a code in its upper bits: how many balls there are, 3 for more than
# two. Those form a chain that begins at the second ball, one link per ball; there are few of them. Both slots are copied whether
# they are filled or not, and the code alone decides what of it stays: no branch for a processor to mispredict. Beyond a wall lies
# a layer of cells that stays empty. Neighbours across a periodic border are entered with the code of the nearest image, so a box
# need be only three cells wide.
#
# Which walls a ball can touch while its centre is in a cell is found once for each gas, with NumPy (:func:`walls_of_cells`).


SLOTS = 2  # of a cell
INDEX_MASK = (1 << INDEX_BITS) - 1
# Cells lie in memory along Morton's curve, so that those near each other in space are near there too. By dimension: the axis
# along which the curve steps with each bit of a cell's index, within a tile of 8 x 8 x 8 cells, 4 kB, of discs 16 x 16; tiles
# follow row by row. A cache line is a block of 2 x 2 x 2 cells, of discs 4 x 2, and the cells around one are on eight lines, or
# four.
MORTON_AXES = {3: (0, 1, 2) * 3, 2: (0, 0, 1, 1, 0, 1, 0, 1)}
OVERFULL = 3  # the code of a cell with more balls than slots
ROUNDING = 1e-9  # of a cell: a ball may be this far outside the cell that it is in


class Block(NamedTuple):
    """A cell, and a range of the three cells (before, at, after) along each axis around it: 0 <= x0 < x1 <= 3."""

    x: int
    y: int
    z: int
    x0: int
    x1: int
    y0: int
    y1: int
    z0: int
    z1: int


# --- set-up --------------------------------------------------------------------------------------------------------


def morton_offsets(system: Any) -> tuple[list[NDArray[np.int64]], int]:
    """Return, by axis, what each cell index adds to the offset of a cell's slots; and the number of slots in all."""
    # (beyond a wall lies a layer of empty cells)
    counts = [int(n) + (0 if periodic else 1) for n, periodic in zip(system["cells"], system["periodic"], strict=True)]
    offsets = [np.zeros(count, np.int64) for count in counts]
    bits, slots = [0, 0, 0], SLOTS
    for axis in MORTON_AXES[int(system["dimensions"])]:
        if 1 << bits[axis] < counts[axis]:
            offsets[axis] += (np.arange(counts[axis]) >> bits[axis] & 1) * slots
            bits[axis] += 1
            slots *= 2
    for axis, count in enumerate(counts):
        offsets[axis] += (np.arange(count) >> bits[axis]) * slots
        slots *= (count - 1 >> bits[axis]) + 1
    return offsets, slots


def neighbour_tables(system: Any) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return ``offsets`` and ``shifts`` of the Cells of a system: (axis, cell, 3) each."""
    most, along = int(system["cells"].max()), morton_offsets(system)[0]
    offsets = np.zeros((3, most, 3), np.int64)
    shifts = np.zeros((3, most, 3))
    for axis in range(3):
        n, side = int(system["cells"][axis]), float(system["side"][axis])
        for index in range(n):
            for k in range(3):
                neighbour = index + k - 1
                if system["periodic"][axis]:
                    # the ball is shifted instead of its neighbours
                    shifts[axis, index, k] = side if neighbour < 0 else (-side if neighbour >= n else 0.0)
                    neighbour %= n
                elif neighbour < 0:
                    neighbour = n  # the empty layer
                offsets[axis, index, k] = along[axis][neighbour]
    return offsets, shifts


# --- balls ---------------------------------------------------------------------------------------------------------


@hot_kernel
def cell_index(grid: Any, axis: int, x: float) -> Any:
    """Return the index of the cell that holds x along an axis."""
    return max(I64(0), min(I64(x / grid.cell_size[U64(axis)]), grid.cells[U64(axis)] - 1))


@hot_kernel
def _first_slot(offsets: Any, plan: Any) -> int:
    """Return the first slot of a ball's cell."""
    x, y, z = U64(plan.cx), U64(plan.cy), U64(plan.cz)
    return I64(  # type: ignore[no-any-return]
        offsets[U64(0), x, U64(1)] + offsets[U64(1), y, U64(1)] + offsets[U64(2), z, U64(1)]
    )


@kernel
def insert_ball(cells: Any, plan: Any, i: int) -> None:
    """Enter ball i in its cell."""
    slots, links = cells.slots, cells.links
    first = _first_slot(cells.offsets, plan)
    front, second = I64(slots[U64(first)]), I64(slots[U64(first + 1)])
    code = front >> INDEX_BITS
    if code == 0:
        front = I64(i)
    if code <= 1:
        slots[U64(first + 1)] = i
    else:
        links[U64(i)] = NO_BALL if code == 2 else links[U64(second)]
        links[U64(second)] = i
    slots[U64(first)] = (front & INDEX_MASK) | (min(code + 1, OVERFULL) << INDEX_BITS)


@kernel
def remove_ball(cells: Any, plan: Any, i: int) -> None:
    """Remove ball i from its cell; the first one of the chain takes its place, or the second of two."""
    slots, links = cells.slots, cells.links
    first = _first_slot(cells.offsets, plan)
    front, second = I64(slots[U64(first)]), I64(slots[U64(first + 1)])
    code, one = front >> INDEX_BITS, front & INDEX_MASK
    if code < OVERFULL:
        # (an empty slot names a ball that is near, or the first of all: it may be prefetched in vain)
        one = 0 if code == 1 else (second if one == i else one)
        slots[U64(first)], slots[U64(first + 1)] = one | ((code - 1) << INDEX_BITS), one
        return
    third = I64(links[U64(second)])
    rest = I64(links[U64(third)])
    code = 2 if rest == NO_BALL else OVERFULL
    # the third ball is unlinked, and replaces i unless it is i
    links[U64(second)] = rest
    if one == i:
        one = third
    elif second == i:
        links[U64(third)] = rest
        slots[U64(first + 1)] = third
    elif third != i:
        before = second
        while I64(links[U64(before)]) != i:
            before = I64(links[U64(before)])
        links[U64(third)] = links[U64(i)]
        links[U64(before)] = third
    slots[U64(first)] = one | (code << INDEX_BITS)


@kernel
def _copy_chain(links: Any, found: Any, second: int, n: int, image: Any) -> int:
    """Append the chained balls of a cell to those found; there are seldom any."""
    k = links[U64(second)]
    while k != NO_BALL:
        found[U64(n)] = k | image
        n += 1
        k = links[U64(k)]
    return n


@hot_kernel
def copy_cell(slots: Any, links: Any, found: Any, first: int, n: int, code: int) -> int:
    """Append the balls of a cell to the n found so far; return how many there are now."""
    image = np.uint32(code << INDEX_BITS)
    # (both are read before the first is written, so that they are one load and one store)
    front, second = slots[U64(first)], slots[U64(first + 1)]
    found[U64(n)], found[U64(n + 1)] = (front & np.uint32(INDEX_MASK)) | image, second | image
    count = I64(front >> np.uint32(INDEX_BITS))
    if count == OVERFULL:
        return _copy_chain(links, found, second, n + 2, image)
    return n + count  # type: ignore[no-any-return]


@hot_kernel
def block_around(flat: bool, plan: Any) -> Block:
    """Return the block of cells around a ball's cell."""
    return Block(I64(plan.cx), I64(plan.cy), I64(plan.cz), 0, 3, 0, 3, 1 if flat else 0, 2 if flat else 3)


@hot_kernel
def gather_neighbours(cells: Any, found: Any, block: Block) -> int:
    """Write the indices of the balls in a block of cells, with the codes of their images, to ``found``; return how many."""
    slots, links, offsets = cells.slots, cells.links, cells.offsets
    n, x = 0, U64(block.x)
    left, middle, right = offsets[U64(0), x, U64(0)], offsets[U64(0), x, U64(1)], offsets[U64(0), x, U64(2)]
    ahead = right if block.x0 == 2 else left
    for c in range(block.z0, block.z1):
        third = offsets[U64(2), U64(block.z), U64(c)]
        for b in range(block.y0, block.y1):
            first = third + offsets[U64(1), U64(block.y), U64(b)]
            code = (b << 2) | (c << 4)
            if block.x1 - block.x0 == 3:
                n = copy_cell(slots, links, found, first + left, n, code)
                n = copy_cell(slots, links, found, first + middle, n, code | 1)
                n = copy_cell(slots, links, found, first + right, n, code | 2)
            else:
                n = copy_cell(slots, links, found, first + ahead, n, code | block.x0)
    return n


@hot_kernel
def set_images(shifts: Any, images: Any, block: Block, x: float, y: float, z: float) -> None:
    """Write the position (x, y, z) as seen from the three cells along each axis to ``images``, (12,)."""
    for k in range(3):
        images[U64(k)] = x + shifts[U64(0), U64(block.x), U64(k)]
        images[U64(4 + k)] = y + shifts[U64(1), U64(block.y), U64(k)]
        images[U64(8 + k)] = z + shifts[U64(2), U64(block.z), U64(k)]


# --- walls ---------------------------------------------------------------------------------------------------------


def _cell_spans(system: Any, axis: int) -> tuple[Any, Any]:
    """Return where the cells along an axis begin and end."""
    n, size = int(system["cells"][axis]), float(system["cell_size"][axis])
    index = np.arange(n)
    low, high = (index - ROUNDING) * size, (index + 1 + ROUNDING) * size
    return low, high


def _reached_cells(system: Any, face: Any, distance: float, curves: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which cells (z, y, x) a face reaches into, given its largest d (INSIDE: least d) of all species."""
    if face["form"] == CURVE:
        return _cells_along(system, face, distance, curves)
    least: Any = 0.0
    most: Any = 0.0
    along_low: Any = 0.0
    along_high: Any = 0.0
    for axis, name in enumerate("xyz"):
        low, high = _cell_spans(system, axis)
        n, m, a = float(face["n" + name]), float(face["m" + name]), float(face["a" + name])
        near, far = n * (low - m), n * (high - m)
        if face["form"] == PLANE:
            part = np.minimum(near, far)
        elif face["form"] == INSIDE:
            part = -np.maximum(near * near, far * far)
        else:
            part = np.where((near < 0) != (far < 0), 0.0, np.minimum(near * near, far * far))
        shape = [1, 1, 1]
        shape[2 - axis] = -1
        least = least + part.reshape(shape)
        most = most + np.maximum(near, far).reshape(shape)
        along_low = along_low + np.minimum(a * low, a * high).reshape(shape)
        along_high = along_high + np.maximum(a * low, a * high).reshape(shape)
    if face["form"] == PLANE:
        reached = (least <= distance + face["amplitude"]) | (face["mass"] > 0)
    elif face["form"] == INSIDE:
        reached = least + distance * distance <= 0
    else:
        reached = least <= distance * distance
    if face["bounded"]:
        reached = reached & (along_low <= face["high"]) & (along_high >= face["low"])
        if face["form"] == PLANE:
            reached = reached & (most >= -face["depth"])
    return np.asarray(reached)


def _cells_along(system: Any, face: Any, distance: float, curves: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which cells (z, y, x) are as near as the distance to an arc, by the boxes of its panels."""
    base = int(face["depth"])
    rows = curves[base + 1 : base + 2 + int(curves[base, COUNT])]
    wide = distance + rows[:-1, HALF] / 2  # (a panel turns by less than 0.4 rad, and stays that near to its chord)
    found: Any = False
    for axis, name in enumerate("xy"):
        low, high = _cell_spans(system, axis)
        ends = np.stack([rows[:-1, X + axis], rows[1:, X + axis]]) + float(face["m" + name])
        over = (low <= (ends.max(axis=0) + wide)[:, None]) & (high >= (ends.min(axis=0) - wide)[:, None])
        found = over[:, None, :] if axis == 0 else found & over[:, :, None]
    return np.broadcast_to(found.any(axis=0), tuple(int(n) for n in system["cells"][::-1])).copy()


def _interior(walled: NDArray[np.bool_]) -> list[int]:
    """Return first and last indices, along x, y and z, of a block of cells without walls: the outer layers with most go first."""
    low, high = [0, 0, 0], list(walled.shape)
    while all(low[k] < high[k] for k in range(3)):
        block = walled[tuple(slice(low[k], high[k]) for k in range(3))]
        if not block.any():
            return [v for k in (2, 1, 0) for v in (low[k], high[k] - 1)]
        _, k, last = max((float(np.take(block, end, axis=k).mean()), k, end) for k in range(3) for end in (0, -1))
        low[k], high[k] = (low[k], high[k] - 1) if last else (low[k] + 1, high[k])
    return [1, 0] * 3


def walls_of_cells(
    system: Any, faces: Any, contacts: Any, curves: NDArray[np.float64]
) -> tuple[list[int], NDArray[np.int32], NDArray[np.int32]]:
    """Return the interior of the grid, and ``cell_sets`` and ``sets`` of the WallRecords of a system."""
    shape = tuple(int(n) for n in system["cells"][::-1])
    if len(faces) == 0:
        return [v for n in shape[::-1] for v in (0, n - 1)], np.zeros(1, np.int32), np.zeros(1, np.int32)
    species = int(system["species"])
    # each cell's set by its number among the different ones so far
    number = np.zeros(shape, np.int64)
    members: list[tuple[int, ...]] = [()]
    for w, face in enumerate(faces):
        distances = contacts["distance"][w * species : (w + 1) * species]
        distance = float(distances.min() if face["form"] == INSIDE else distances.max())
        reached = _reached_cells(system, face, distance, curves)
        known, number = np.unique(2 * number + reached, return_inverse=True)
        number = number.reshape(shape)
        members = [(*members[k // 2], w) if k % 2 else members[k // 2] for k in known.tolist()]
    sets: list[int] = []
    starts: list[int] = []
    for those in members:
        starts.append(len(sets))
        sets += [len(those), *those]
    walled = np.array([len(those) > 0 for those in members])[number]
    return _interior(walled), np.array(starts, np.int32)[number].ravel(), np.array(sets, np.int32)
