"""Prefetching: the records of a million balls lie far from the processor, and what comes next is known.

Memory is fetched page by page of the calendar, some hundred events ahead, an entry or two at a time: first the balls entered on a
page; a page later, when these have arrived, the cells around them and their partners; another page later, the balls in those
cells. It goes into the second-level cache; the first is too small for all that.
"""

from __future__ import annotations

from typing import Any

from carom.core.jit.kernel import hot_kernel
from carom.core.jit.prefetch import prefetch
from carom.gas.edmd.calendar import BLOCK_LENGTH, I64, PAGE, U64, is_pending
from carom.gas.edmd.cell_lists import INDEX_MASK, Block, block_around

__all__ = ["page_ends_ahead", "prefetch_ahead"]

PLANS, CELLS, BALLS = range(3)  # the stages
ENTRIES = 2  # per call
CELL_FACES = 6  # the least ``boundary`` that is no cell crossing


@hot_kernel
def _wrapped_index(index: int, n: int) -> int:
    return index - n if index >= n else (index + n if index < 0 else index)


@hot_kernel
def _searched_block(flat: bool, grid: Any, plan: Any) -> Block:
    """Return the cells that will be searched at a ball's next event."""
    block = block_around(flat, plan)
    which = I64(plan.boundary)
    if plan.collision_time == plan.event_time or which >= CELL_FACES:
        return block
    # the ball crosses over to the next cell, and the cells beyond are searched
    x, y, z, x0, x1, y0, y1, z0, z1 = block
    up = which & 1
    step, first = 2 * up - 1, 2 * up
    if which < 2:
        return Block(_wrapped_index(x + step, grid.cells[U64(0)]), y, z, first, first + 1, y0, y1, z0, z1)
    if which < 4:
        return Block(x, _wrapped_index(y + step, grid.cells[U64(1)]), z, x0, x1, first, first + 1, z0, z1)
    return Block(x, y, _wrapped_index(z + step, grid.cells[U64(2)]), x0, x1, y0, y1, first, first + 1)


@hot_kernel
def _prefetch_cells(slots: Any, offsets: Any, block: Block) -> None:
    """Prefetch cells: those in the corners are on all the cache lines that there are."""
    x, y, z, x0, x1, y0, y1, z0, z1 = block
    left, right = offsets[U64(0), U64(x), U64(x0)], offsets[U64(0), U64(x), U64(x1 - 1)]
    front, back = offsets[U64(1), U64(y), U64(y0)], offsets[U64(1), U64(y), U64(y1 - 1)]
    for c in range(2):
        third = offsets[U64(2), U64(z), U64(z1 - 1 if c else z0)]
        prefetch(slots, U64(third + front + left))
        prefetch(slots, U64(third + front + right))
        prefetch(slots, U64(third + back + left))
        prefetch(slots, U64(third + back + right))


@hot_kernel
def _prefetch_cell_balls(motions: Any, slots: Any, first: int) -> None:
    """Prefetch the first two balls of a cell."""
    prefetch(motions, U64(slots[U64(first)] & INDEX_MASK))
    prefetch(motions, U64(slots[U64(first + 1)] & INDEX_MASK))


@hot_kernel
def _prefetch_balls(motions: Any, slots: Any, offsets: Any, block: Block) -> None:
    """Prefetch the first two balls of each cell."""
    x, y, z, x0, x1, y0, y1, z0, z1 = block
    left, middle, right = (
        offsets[U64(0), U64(x), U64(0)],
        offsets[U64(0), U64(x), U64(1)],
        offsets[U64(0), U64(x), U64(2)],
    )
    ahead = right if x0 == 2 else left
    for c in range(z0, z1):
        third = offsets[U64(2), U64(z), U64(c)]
        for b in range(y0, y1):
            second = third + offsets[U64(1), U64(y), U64(b)]
            if x1 - x0 == 3:
                _prefetch_cell_balls(motions, slots, second + left)
                _prefetch_cell_balls(motions, slots, second + middle)
                _prefetch_cell_balls(motions, slots, second + right)
            else:
                _prefetch_cell_balls(motions, slots, second + ahead)


@hot_kernel
def _prefetch_entries(
    stage: int, flat: bool, spins: bool, grid: Any, balls: Any, cells: Any, blocks: Any, page: int, end: int
) -> int:
    """Prefetch for the next entries of a page, of which those up to ``end`` are left; return the new end."""
    motions, plans, bodies, slots, offsets = balls.motions, balls.plans, balls.bodies, cells.slots, cells.offsets
    for _ in range(ENTRIES):
        if end & (BLOCK_LENGTH - 1) == 0:
            end = I64(blocks[U64(end)]) if end != 0 else 0
            if end == 0:
                return 0
        i = blocks[U64(end)]
        end -= 1
        if stage == PLANS:
            prefetch(plans, U64(i))
            prefetch(motions, U64(i))
            continue
        plan = plans[U64(i)]
        if not is_pending(plan, page):
            continue
        j, collides = plan.partner, plan.collision_time == plan.event_time
        if stage == BALLS:
            _prefetch_balls(motions, slots, offsets, _searched_block(flat, grid, plan))
            if collides and motions[U64(j)].collisions == plan.partner_collisions:
                _prefetch_balls(motions, slots, offsets, block_around(flat, plans[U64(j)]))
            continue
        _prefetch_cells(slots, offsets, _searched_block(flat, grid, plan))
        if collides:
            prefetch(plans, U64(j))
            prefetch(motions, U64(j))
            if spins:
                prefetch(bodies, U64(i))
                prefetch(bodies, U64(j))
    return end


@hot_kernel
def page_ends_ahead(page_ends: Any, page: int, bins: int) -> tuple[int, int, int]:
    """Return where the entries of the three pages end that are prefetched during this one; 0 where the cycle has no more pages.

    (Events that never happen are on the last page of all, which is not prefetched.)
    """
    if (page + 4) * PAGE >= bins:
        return 0, 0, 0
    return I64(page_ends[U64(page + 2)]), I64(page_ends[U64(page + 3)]), I64(page_ends[U64(page + 4)])


@hot_kernel
def prefetch_ahead(
    flat: bool, spins: bool, grid: Any, balls: Any, cells: Any, blocks: Any, page: int, ends: tuple[int, int, int]
) -> tuple[int, int, int]:
    """Prefetch for some balls of the next pages; return where the entries end that are left. Called once per bin."""
    third = _prefetch_entries(PLANS, flat, spins, grid, balls, cells, blocks, page + 4, ends[2])
    second = _prefetch_entries(CELLS, flat, spins, grid, balls, cells, blocks, page + 3, ends[1])
    return _prefetch_entries(BALLS, flat, spins, grid, balls, cells, blocks, page + 2, ends[0]), second, third
