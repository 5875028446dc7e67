"""Lees-Edwards boundaries: a gas that is sheared without walls.

A. W. Lees & S. F. Edwards, J. Phys. C 5, 1921 (1972). The images of the box beyond its border across y move along x, those above at
the speed of the images U = rate L_y, those below at -U; so the mean flow is rate (y - L_y / 2) along x. A ball that
crosses that border comes back at the place of its image, slower or faster by U. All velocities of the records are those of the
frame at rest; what is averaged is relative to the flow (peculiar).

Beyond that border cells slide along each other. A ball in the first or last row of cells is compared with all balls of the row on
the other side: then nothing has to be predicted again as the rows slide, and the work grows no faster than the number of balls.
Of each of those, the images along x come by one after the other, and the first that is hit counts.

``shear`` is None where a gas is not sheared, else its SHEAR record: the choice is made when the loop is compiled.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import Vec, kernel
from carom.gas.edmd.averages import note_change
from carom.gas.edmd.calendar import I64, U64
from carom.gas.edmd.cell_lists import INDEX_MASK, Block, cell_index, copy_cell
from carom.gas.edmd.gas_records import NO_BALL

__all__ = ["cross_sheared_border", "earliest_across", "sheared_image", "slide_images", "with_flow", "within_border"]

MOST_IMAGES = 256  # of one ball along x that come by before another event


@kernel
def slide_images(shear: Any, grid: Any, t: float) -> None:
    """Let the images slide on, as a cycle of the calendar of this length ends."""
    if shear is None:
        return
    one, side = shear[0], grid.side[U64(0)]
    offset = one.offset + one.speed * t
    one.offset = offset - math.floor(offset / side) * side


@kernel
def with_flow(shear: Any, grid: Any, y: float, v: Vec) -> Vec:
    """Return a velocity relative to the flow as one in the frame at rest."""
    if shear is None:
        return v
    return (v[0] + shear[0].rate * (y - grid.side[U64(1)] / 2.0), v[1], v[2])


@kernel
def within_border(shear: Any, grid: Any, block: Block) -> Block:
    """Return a block of cells without those beyond the border across y."""
    if shear is None:
        return block
    low = 1 if block.y == 0 and block.y0 == 0 else block.y0
    high = 2 if block.y + 1 == grid.cells[U64(1)] and block.y1 == 3 else block.y1
    return Block(block.x, block.y, block.z, block.x0, block.x1, low, high, block.z0, block.z1)


@kernel
def cross_sheared_border(
    shear: Any, grid: Any, averages: Any, species: Any, ball: Any, plan: Any, turns: int, now: float
) -> None:
    """Give a ball that crosses the border across y, upwards (turns 1) or downwards (-1), its image's place and velocity along x."""
    if shear is None or turns == 0:
        return
    one, side = shear[0], grid.side[U64(0)]
    m, faster = species[U64(ball.species)].mass, -turns * one.speed
    s = (ball.vx + faster / 2.0, ball.vy, ball.vz)
    note_change(averages, grid, plan, I64(ball.species), (m * faster, 0.0, 0.0), s, 0.0, now)
    ball.vx += faster
    x = ball.x - turns * (one.offset + one.speed * now)
    around = math.floor(x / side)
    ball.x = x - around * side
    plan.image[0] += I64(around)
    plan.cx = cell_index(grid, 0, ball.x)


@kernel
def sheared_image(shear: Any, grid: Any, x: float, y: float, rx: float, now: float) -> tuple[float, float]:
    """Return how far a ball is from the nearest image of another along x, and how much faster the image is than that ball.

    (x, y) is the difference of their places, ``rx`` what it is along x where nothing is sheared.
    """
    if shear is None:
        return rx, 0.0
    one, side, half = shear[0], grid.side[U64(0)], grid.side[U64(1)] / 2.0
    m = 1.0 if y > half else (-1.0 if y < -half else 0.0)
    x -= m * (one.offset + one.speed * now)
    return x - math.floor(x / side + 0.5) * side, m * one.speed


@kernel
def _time_to_image(r: Vec, u: Vec, distance_squared: float, side: float, threshold: float, most: float) -> float:
    """Return when a ball at r, with the velocity u, both relative to another, hits the first of its images along x, up to a time.

    ``r`` is from the nearest image.
    """
    reach = math.sqrt(distance_squared)
    ry, rz, uy, uz = r[1], r[2], u[1], u[2]
    u2, square = u[0] * u[0] + uy * uy + uz * uz, ry * ry + rz * rz
    x, step = r[0], (-side if u[0] > 0.0 else side)
    for _ in range(MOST_IMAGES):
        b, c = x * u[0] + ry * uy + rz * uz, x * x + square - distance_squared
        inside = b * b - u2 * c
        if b < -threshold and inside > 0.0:
            return max(c, 0.0) / (math.sqrt(inside) - b)
        x += step
        if u[0] == 0.0:
            return math.inf
        # the next image comes within reach along x: it is too late if it is then out of reach across, for ever
        s = (abs(x) - reach) / abs(u[0])
        y, z = ry + uy * s, rz + uz * s
        if s > most or (abs(y) > reach and y * uy >= 0.0) or (abs(z) > reach and z * uz >= 0.0):
            return math.inf
    return math.inf


@kernel
def earliest_across(
    shear: Any, grid: Any, system: Any, motions: Any, pairs: Any, cells: Any, near: Any, block: Block, i: int, now: float,
    hit: float, partner: int,
) -> tuple[float, int]:  # fmt: skip
    """Return the earliest collision of ball i, given that with the balls within the border: also with those across it."""
    if shear is None:
        return hit, partner
    last = block.y + 1 == grid.cells[U64(1)]
    # (a ball that crosses a border of a cell along x has looked at the whole row before)
    if block.x1 - block.x0 < 3 or not ((block.y == 0 and block.y0 == 0) or (last and block.y1 == 3)):
        return hit, partner
    k, up = (2, 1.0) if last else (0, -1.0)
    one, side, ball, found = shear[0], grid.side[U64(0)], motions[U64(i)], near.found
    far, speed = ball.x - up * (one.offset + one.speed * now), up * one.speed
    y, row = near.images[U64(4 + k)], I64(ball.species) * system.species
    for c in range(block.z0, block.z1):
        z = near.images[U64(8 + c)]
        beyond = cells.offsets[U64(1), U64(block.y), U64(k)] + cells.offsets[U64(2), U64(block.z), U64(c)]
        for a in range(grid.cells[U64(0)]):
            n = copy_cell(cells.slots, cells.links, found, beyond + cells.offsets[U64(0), U64(a), U64(1)], 0, 0)
            for index in range(n):
                j = I64(found[U64(index)]) & INDEX_MASK
                other = motions[U64(j)]
                s = now - other.time
                x = far - (other.x + other.vx * s)
                r = (x - math.floor(x / side + 0.5) * side, y - (other.y + other.vy * s), z - (other.z + other.vz * s))
                u = (ball.vx - (other.vx + speed), ball.vy - other.vy, ball.vz - other.vz)
                pair = pairs[U64(row + other.species)]
                t = now + _time_to_image(r, u, pair.distance_squared, side, system.threshold, hit - now)
                if t < hit or (t == hit and t < math.inf and (partner == NO_BALL or j < partner)):
                    hit, partner = t, j
    return hit, partner
