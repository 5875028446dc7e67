"""When orbits leave a table: one that is open, or one with holes in its wall."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, ConnectedWall
from carom.billiards.orbits import Orbit, orbit_from_setup, require_integer
from carom.billiards.setup import orbit_setup
from carom.billiards.table_records import DONE, ESCAPED, POSITION, SPIN, TIME, VELOCITY
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault, float_array

__all__ = ["Escape", "escape"]

Array = NDArray[np.float64]
MAX_BOUNCES_AT_ONCE = 20_000_000


@dataclass(frozen=True, eq=False)
class Escape:
    """When orbits leave a table.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.escape(billiards.circle(), ((0.0, 0.0), (1.0, 0.0), 0.0), holes=[(0.0, 0.1)], law="mirror")
    >>> bool(found.escaped), float(found.t), int(found.bounces)
    (True, 1.0, 1)
    """

    t: Array
    """(...): time at which the orbit enters a hole, or of its last bounce before it leaves an open table; NaN where it stays."""
    bounces: NDArray[np.int64]
    """(...): number of bounces until then; where it stays, those made."""
    escaped: NDArray[np.bool_]
    """(...): whether it left."""


def escape(
    table: Table, start: Any, bounces: int = 10_000, *, holes: Sequence[Sequence[float]] = (), ball: Ball | None = None,
    law: Any = "no-slip", surface: Surface | None = None,
) -> Escape:  # fmt: skip
    """Find when orbits leave an open table (a wedge) for good, or a closed table through holes in its wall.

    Parameters
    ----------
    table, start, ball, law, surface
        As for :func:`orbit`.
    bounces : int
        Greatest number of bounces.
    holes : sequence of (from, to), m
        Intervals of arc length (``Orbit.arc``), from < to; a ball that would bounce there has left. On a closed wall an interval
        may reach over the place where arc length begins: (-0.1, 0.1), or (L - 0.1, L + 0.1) for a perimeter L. Several walls
        follow each other in arc length (``table.wall().connected()``), and each hole lies in one of them. The walls of a strip
        share one coordinate, and a hole is in both. Lids of a cylinder have none.

    Returns
    -------
    Escape

    Raises
    ------
    CaromError
        One line per problem: holes that are no intervals, longer than their wall, beyond it, or across two walls; holes in a
        sphere.

    Examples
    --------
    A wedge of 60 degrees, elastic and smooth, releases every ball after at most three bounces:

    >>> import math
    >>> from carom import billiards
    >>> found = billiards.escape(billiards.wedge(math.pi / 3), ((1.0, 0.0), (-1.0, 0.2), 0.0), law="mirror")
    >>> bool(found.escaped), int(found.bounces)
    (True, 3)
    """
    setup = orbit_setup(table, ball, law, surface, "end")
    bounces = require_integer("bounces", bounces)
    gaps = _holes(setup.shape, holes)
    first = orbit_from_setup(setup, start, 1)  # validates the starts
    shape = np.shape(first.count)
    n = int(np.prod(shape))
    t, count, gone = np.full(n, np.nan), np.full(n, bounces), np.zeros(n, bool)
    block = max(1, min(bounces, MAX_BOUNCES_AT_ONCE // max(n, 1)))
    now = first.start
    d = table.dimension
    left = np.arange(n)
    clock = np.zeros(n)
    x, v = (np.asarray(a).reshape(n, d) for a in (now.position, now.velocity))
    w = np.asarray(now.spin).reshape(n, *(() if setup.planar else (3,)))
    done = 0
    while done < bounces and len(left):
        share = min(block, bounces - done)
        run = orbit_from_setup(setup, (x, v, w), share)
        through = _through(gaps, setup.shape, run)
        hit = np.asarray(through.any(1))
        k = np.asarray(np.where(hit, np.argmax(through, 1), run.count))
        off = ~hit & (np.asarray(run.ending) == ESCAPED)
        out = hit | off
        row = np.arange(len(left))
        at = np.where(hit, run.t[row, np.minimum(k, share - 1)], run.last[:, TIME])
        t[left[out]] = clock[left[out]] + at[out]
        count[left[out]] = done + k[out] + hit[out]
        gone[left[out]] = True
        stuck: NDArray[np.bool_] = ~out & (np.asarray(run.ending) != DONE)
        count[left[stuck]] = done + np.asarray(run.count)[stuck]
        on = ~out & ~stuck
        clock[left] += run.last[:, TIME]
        left = left[on]
        x, v = run.last[on, POSITION][:, :d], run.last[on, VELOCITY][:, :d]
        w = run.last[on, SPIN][:, 2] if setup.planar else run.last[on, SPIN]
        done += share
    return Escape(t.reshape(shape), count.reshape(shape), gone.reshape(shape))


# --- holes ------------------------------------------------------------------------------------------------------------


class _Hole(NamedTuple):
    wall: int
    low: float
    high: float
    wraps: bool
    """Whether it goes over the beginning of its wall: from ``low`` to the end, and from the beginning to ``high``."""


def _holes(shape: Boundary, given: Any) -> list[_Hole]:
    """Return holes in their walls. CaromError, one line for each that is none."""
    try:
        intervals = float_array(given)
    except (TypeError, ValueError):
        intervals = np.empty((0, 1))
    if not intervals.size and np.ndim(intervals) == 1:
        return []
    if intervals.shape == (2,):
        intervals = intervals[None, :]
    expected = "intervals (from, to) of arc length in m with from < to"
    if intervals.ndim != 2 or intervals.shape[1] != 2:
        raise CaromError(Fault("escape", "holes", expected, f"{' '.join(repr(given).split()):.80}"))
    walls = shape.connected()
    if not walls:
        raise CaromError(Fault("escape", "holes", "a table whose wall has an arc length", "a sphere", "give no holes"))
    faults, found = [], []
    for k, (low, high) in enumerate(intervals.tolist()):
        got = f"({low:.9g}, {high:.9g})"
        where = "escape: holes" if len(intervals) == 1 else f"escape: holes[{k}]"
        if not low < high:
            faults.append(f"{where}: expected {expected}, got {got}")
            continue
        hole = _hole(walls, low, high)
        if isinstance(hole, str):
            faults.append(f"{where}: expected {hole}, got {got}")
        else:
            found.append(hole)
    if faults:
        raise CaromError(*faults)
    return found


def _hole(walls: list[ConnectedWall], low: float, high: float) -> _Hole | str:
    """Return a hole; or, of an interval that is none, what was expected."""
    touched = [k for k, wall in enumerate(walls) if low < wall.last and high > wall.first]
    if not touched:
        return f"a hole in the wall, whose arc length is from {walls[0].first:.9g} to {walls[-1].last:.9g} m"
    if len(touched) > 1:
        parts = ", ".join(f"{walls[k].first:.9g} to {walls[k].last:.9g}" for k in touched)
        return f"a hole in one of the walls that it touches ({parts} m), one hole for each"
    wall = walls[touched[0]]
    size = wall.last - wall.first
    if wall.first <= low and high <= wall.last:
        return _Hole(touched[0], low, high, wraps=False)
    if high - low > size or not wall.closed:
        what = "closed" if wall.closed else "not closed"
        return f"a hole within its wall, which is {what}, from {wall.first:.9g} to {wall.last:.9g} m"
    low, high = (low + size, high) if low < wall.first else (low, high - size)
    return _Hole(touched[0], low, high, wraps=True)


def _through(holes: list[_Hole], shape: Boundary, run: Orbit) -> NDArray[np.bool_]:
    """Return which bounces (..., B) of orbits lie in a hole."""
    found = np.zeros(run.piece.shape, bool)
    if holes:
        s, wall = run.arc, shape.wall_numbers(run.piece)
        for hole in holes:
            above, below = s >= hole.low, s <= hole.high
            found |= (wall == hole.wall) & (above | below if hole.wraps else above & below)
    return found
