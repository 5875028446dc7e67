"""When orbits leave a table: one that is open, or one with holes in its wall; survival, escape rates."""

from __future__ import annotations

import math
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

__all__ = ["Escape", "EscapeDecay", "escape", "holes_in", "in_holes"]

Array = NDArray[np.float64]
MAX_BOUNCES_AT_ONCE = 20_000_000
LIKELIER = 20.0  # so many times as likely must a law of decay be as the other


class EscapeDecay(NamedTuple):
    """How the number of orbits in a table falls: fits by maximum likelihood, with counting errors."""

    kind: str
    """"exponential" or "power law", whichever is 20 times as likely as the other; "undecided" in between."""
    rate: float
    """Of exp(-rate t): escapes over the time that orbits spent in the table, 1/s; or over their bounces."""
    rate_error: float
    """The rate over the square root of the number of escapes."""
    exponent: float
    """Of t^-exponent."""
    exponent_error: float
    log_odds: float
    """Natural logarithm of the ratio of likelihoods, exponential over power law."""
    after: float
    """Time, s, or number of bounces: only later escapes count."""
    until: float
    """Time or number of bounces up to which all orbits that stay were followed: only earlier escapes count."""
    escapes: int
    """Number of escapes in between."""


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
    until: Array
    """(...): time up to which the orbit was followed: until it left, or its last bounce."""

    def survival(self, at: Any, by: str = "time") -> tuple[Array, Array]:
        """Return the share (...) of orbits that are in the table at times (...), s, or after bounces (...), and its counting error.

        NaN beyond the time, or number of bounces, up to which all orbits that stay were followed. ``by``: "time" or "bounces".
        """
        when, end = self._ends(by)
        asked = np.asarray(at, float)
        share = np.where(asked <= end, (when > asked[..., None]).mean(-1), np.nan)
        return share, np.sqrt(share * (1.0 - share) / len(when))

    def decay(self, after: float | None = None, by: str = "time") -> EscapeDecay:
        """Fit an exponential and a power law to the escapes later than some time; orbits that stay count as such.

        Parameters
        ----------
        after : float, > 0
            Time, s, or number of bounces. Default: at which half of the escapes have happened.
        by : "time" or "bounces"
            Orbits make so many bounces in times of their own. By time, nothing counts after the time up to which all of those that
            stay were followed, which is short where some bounces follow each other quickly; and escapes must come evenly in time:
            where all flights are about as long, as among distant discs, compare the survival at two times many flights apart.

        Returns
        -------
        EscapeDecay. Raises CaromError for fewer than two escapes in between.

        Examples
        --------
        Through a small hole h of a chaotic table of area A the escape rate is h v/(pi A) to first order:

        >>> import math
        >>> from carom import billiards
        >>> table = billiards.stadium(1.0, 1.0)
        >>> start = billiards.starts(table, 2000, seed=1, law="mirror", spins=False)
        >>> found = billiards.escape(table, start, 500, holes=[(2.0, 2.1)], law="mirror")
        >>> fitted, first = found.decay(after=1.0), 0.1 / (math.pi * (2 + math.pi))
        >>> abs(fitted.rate - first) < 4 * fitted.rate_error
        True
        """
        when, end = self._ends(by)
        gone = when[when <= end]
        if after is None and gone.size:
            after = float(np.median(gone))
        if not (isinstance(after, int | float | np.number) and 0 < after < math.inf) or (gone > after).sum() < 2:
            expected = "a number > 0 with two escapes or more between it and the end"
            raise CaromError(Fault("decay", "after", expected, f"{after!r}, with {gone.size} escapes up to {end:.6g}"))
        count = int((gone > after).sum())
        stretch = np.minimum(when[when > after], end)
        rate = count / float((stretch - after).sum())
        exponent = count / float(np.log(stretch / after).sum())
        # the log likelihoods: n ln(rate) - n, and n ln(exponent) - n - sum ln t
        odds = count * math.log(rate / exponent) + float(np.log(gone[gone > after]).sum())
        sure = math.log(LIKELIER)
        kind = "exponential" if odds > sure else "power law" if odds < -sure else "undecided"
        error, root = rate / math.sqrt(count), math.sqrt(count)
        if by == "bounces":
            # the share that leaves at each bounce, and the rate that it means
            error *= math.sqrt(1.0 - rate) / (1.0 - rate) if rate < 1.0 else math.inf
            rate = -math.log1p(-rate) if rate < 1.0 else math.inf
        return EscapeDecay(kind, rate, error, exponent, exponent / root, odds, float(after), end, count)

    def _ends(self, by: str) -> tuple[Array, float]:
        """Return when orbits (N) left, infinite for those that stay, and up to when all of these were followed."""
        if by not in ("time", "bounces"):
            raise CaromError(Fault("escape", "by", '"time" or "bounces"', repr(by)))
        followed = np.asarray(self.until if by == "time" else self.bounces, float).ravel()
        stays = ~np.ravel(self.escaped)
        end = float(followed[stays].min()) if stays.any() else math.inf
        return np.where(stays, math.inf, followed), end if math.isfinite(end) else float(followed.max(initial=0.0))


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
        follow each other in arc length (``table.wall().connected``), and each hole lies in one of them. The walls of a strip
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
    gaps = holes_in(setup.shape, holes)
    first = orbit_from_setup(setup, start, 1)  # validates the starts
    shape = np.shape(first.count)
    n = int(np.prod(shape))
    t, until, count, gone = np.full(n, np.nan), np.zeros(n), np.full(n, bounces), np.zeros(n, bool)
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
        through = in_holes(gaps, setup.shape, run)
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
        until[left] = np.where(out, t[left], clock[left])
        left = left[on]
        x, v = run.last[on, POSITION][:, :d], run.last[on, VELOCITY][:, :d]
        w = run.last[on, SPIN][:, 2] if setup.planar else run.last[on, SPIN]
        done += share
    return Escape(t.reshape(shape), count.reshape(shape), gone.reshape(shape), until.reshape(shape))


# --- holes ------------------------------------------------------------------------------------------------------------


class Hole(NamedTuple):
    """A hole in a wall: the stretch from ``low`` to ``high``, in shares of the wall's length."""

    wall: int
    low: float
    high: float
    wraps: bool
    """Whether it goes over the beginning of its wall: from ``low`` to the end, and from the beginning to ``high``."""


def holes_in(shape: Boundary, given: Any, where: str = "escape", field: str = "holes") -> list[Hole]:
    """Return intervals of arc length, each in its wall. CaromError, one line for each that is none."""
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
        raise CaromError(Fault(where, field, expected, f"{' '.join(repr(given).split()):.80}"))
    walls = shape.connected
    if not walls:
        raise CaromError(Fault(where, field, "a table whose wall has an arc length", "a sphere", f"give no {field}"))
    faults, found = [], []
    for k, (low, high) in enumerate(intervals.tolist()):
        got = f"({low:.9g}, {high:.9g})"
        place = f"{where}: {field}" if len(intervals) == 1 else f"{where}: {field}[{k}]"
        if not low < high:
            faults.append(f"{place}: expected {expected}, got {got}")
            continue
        hole = _hole(walls, low, high)
        if isinstance(hole, str):
            faults.append(f"{place}: expected {hole}, got {got}")
        else:
            found.append(hole)
    if faults:
        raise CaromError(*faults)
    return found


def _hole(walls: list[ConnectedWall], low: float, high: float) -> Hole | str:
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
        return Hole(touched[0], low, high, wraps=False)
    if high - low > size or not wall.closed:
        what = "closed" if wall.closed else "not closed"
        return f"a hole within its wall, which is {what}, from {wall.first:.9g} to {wall.last:.9g} m"
    low, high = (low + size, high) if low < wall.first else (low, high - size)
    return Hole(touched[0], low, high, wraps=True)


def in_holes(holes: list[Hole], shape: Boundary, run: Orbit) -> NDArray[np.bool_]:
    """Return which bounces (..., B) of orbits lie in a hole."""
    found = np.zeros(run.piece.shape, bool)
    if holes:
        s, wall = run.arc, shape.wall_numbers(run.piece)
        for hole in holes:
            above, below = s >= hole.low, s <= hole.high
            found |= (wall == hole.wall) & (above | below if hole.wraps else above & below)
    return found
