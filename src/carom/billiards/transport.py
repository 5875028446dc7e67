"""Transport: mean free path and time, free corridors, diffusion in periodic cells, recurrence to a part of the wall."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, ConnectedWall
from carom.billiards.intersections import DONE, ESCAPED, POSITION, SPIN, STRAIGHT, TIME, VELOCITY
from carom.billiards.orbits import Orbit, free_area, orbit_from_setup, starts
from carom.billiards.setup import needs_surface, orbit_setup
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault, float_array, require_count

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

    >>> from carom import billiards
    >>> found = billiards.escape(billiards.wedge(60), ((1.0, 0.0), (-1.0, 0.2), 0.0), law="mirror")
    >>> bool(found.escaped), int(found.bounces)
    (True, 3)
    """
    setup = orbit_setup(table, ball, law, surface, "end")
    bounces = require_count("orbit", "bounces", bounces)
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


# ----------------------------------------------------------------------------------------------------
# Transport: mean free path and time, free corridors, diffusion in periodic cells, recurrence to a part of the wall.


SPHERE_OVER_BALL = {2: math.pi, 3: 4.0, 6: 15 * math.pi / 8}  # surface in D dimensions over volume in D - 1, radius 1
FLIGHTS_PER_WINDOW = 30.0  # of time, after which the velocities of a chaotic orbit are forgotten


class MeanFlight(NamedTuple):
    """Means over the invariant measure of one flight between two bounces."""

    path: float
    """m."""
    time: float
    """s."""


def mean_flight(table: Table, *, ball: Ball | None = None, law: Any = "no-slip", speed: float = 1.0) -> MeanFlight:
    """Compute the mean free path and the mean time between bounces, over all states of one energy: exact.

    In the plane the path is pi A/L, with the area A open to the centre and the length L of its boundary; in space 4 V/S. With D
    components of the velocity and of the spin among which the energy is shared, the time is V/S times the surface of the unit
    sphere over the volume of the unit ball in one dimension less, over the speed: pi A/(L v) for a ball whose spin the law leaves
    alone, 4 A/(L v) for a disc that exchanges velocity and spin. Source: Chernov, J. Stat. Phys. 88, 1 (1997).

    Parameters
    ----------
    table : Table
        Closed, periodic, a strip, plates, or a cylinder.
    ball, law : optional
        As for :func:`orbit`.
    speed : float
        sqrt(2 energy / m), m/s.

    Returns
    -------
    MeanFlight

    Raises
    ------
    CaromError
        An open table, a table under a force across its walls.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.mean_flight(billiards.circle(), law="mirror")
    MeanFlight(path=1.57079..., time=1.57079...)
    >>> billiards.mean_flight(billiards.circle(), law="no-slip")
    MeanFlight(path=1.57079..., time=2.0)
    """
    setup = orbit_setup(table, ball, law, Surface() if needs_surface(law) else None, "end")
    if setup.world["flight"][0] != STRAIGHT or table.name == "wedge":
        raise CaromError(
            Fault("mean_flight", "table", "walls of finite length without a force across them", f"{table}")
        )
    if not 0 < speed < math.inf:
        raise CaromError(Fault("mean_flight", "speed", "a number > 0", repr(speed)))
    ratio = _volume_over_surface(setup.shape)
    if not ratio > 0:
        raise CaromError(
            Fault("mean_flight", "table", "a table from which no ball escapes, without a force", f"{table}")
        )
    spins = 0 if setup.keeps_spin else 1 if setup.planar else 3
    d = table.dimension + spins
    rolls = math.sqrt(1.0 + float(setup.ball.kappa)) if setup.rolls else 1.0
    path = math.pi * ratio if table.dimension == 2 else 4.0 * ratio
    return MeanFlight(path, ratio * SPHERE_OVER_BALL[d] * rolls / speed)


def _volume_over_surface(shape: Boundary) -> float:
    """Return the area open to the centre over the length of its boundary; in space its volume over its surface."""
    if shape.sphere is not None:
        return shape.sphere / 3.0
    lids = [one for one in shape.faces if one.is_lid]
    side = shape.without_lids()
    if side.faces and not np.isfinite(side.lengths).any():  # (two parallel walls)
        area, length = -sum(one.offset for one in side.faces), 2.0
    else:
        area, length = free_area(side)
    if not lids:
        return area / length
    height = -2.0 * lids[0].offset
    return area * height / (length * height + 2.0 * area)


# --- corridors --------------------------------------------------------------------------------------------------------


class Corridor(NamedTuple):
    """A straight corridor without obstacles in a periodic cell."""

    cells: tuple[int, int]
    """Its direction: cells passed in x and in y."""
    width: float
    """m, for the ball's centre."""


def corridors(table: Table, *, ball: Ball | None = None) -> list[Corridor]:
    """Return the free corridors of a periodic cell, the widest first: none if its horizon is finite.

    Where there is one, flights have no bound and the mean square of displacements grows as t ln t.

    Parameters
    ----------
    table : Table
        A periodic cell.
    ball : Ball, optional
        Its radius counts where the table bounds the surface.

    Returns
    -------
    list of Corridor

    Raises
    ------
    CaromError
        A table that is not periodic.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.corridors(billiards.sinai(0.4))
    [Corridor(cells=(0, 1), width=0.2000000...), Corridor(cells=(1, 0), width=0.2000000...)]
    """
    setup = orbit_setup(table, ball, "no-slip", None, "end")
    return _corridors(setup.shape, table)


def _corridors(shape: Boundary, table: Table) -> list[Corridor]:
    if shape.cell is None:
        raise CaromError(Fault("corridors", "table", "a periodic cell", f"{table}"))
    circles = [(x, y, r) for x, y, r, *_ in shape.outside]
    w, h = shape.cell
    if math.isinf(h):
        # between two mirrors: the cell and its mirror image are one cell of twice the width
        h = -2.0 * sum(one.offset for one in shape.faces)
        circles = [(x, y - h / 4, r) for x, y, r in circles] + [(x, h / 4 - y, r) for x, y, r in circles]
    largest = max(r for _x, _y, r in circles)
    # parallel lines of lattice points in the direction (p w, q h) have the spacing w h/|(p w, q h)|
    reach = w * h / (2 * largest)
    found = []
    for p in range(int(reach / w) + 1):
        for q in range(-int(reach / h), int(reach / h) + 1):
            if math.gcd(p, q) != 1 or (p == 0 and q < 0) or math.hypot(p * w, q * h) >= reach:
                continue
            n = np.array([-q * h, p * w]) / math.hypot(p * w, q * h)
            spacing = w * h / math.hypot(p * w, q * h)
            ends = sorted(((float(n @ (x, y)) - r) % spacing, 2 * r) for x, y, r in circles)
            top = max(begin + size - spacing for begin, size in ends)  # (of obstacles around the end of the period)
            for begin, size in ends:
                if begin - top > 1e-12 * spacing:
                    found.append(Corridor((p, q), begin - top))
                top = max(top, begin + size)
    return sorted(found, key=lambda one: (-round(one.width, 12), one.cells))


# --- diffusion --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Diffusion:
    """Diffusion in a periodic cell, with errors from the scatter between independent orbits.

    Examples
    --------
    >>> from carom import billiards
    >>> cell = billiards.torus((2.2, 2.2 * 3**0.5), [(-0.55, -0.9526, 1.0), (0.55, 0.9526, 1.0)])
    >>> billiards.diffusion(cell, orbits=50, bounces=500, law="mirror").describe()
    'D = 0.1... ± 0.0... m²/s; mean squares grow as t^...; no free corridor'
    """

    tensor: Array
    """(d, d): half the rate at which mean products of displacements grow, m^2/s; d is 1 where the cell is periodic in x alone."""
    tensor_error: Array
    """(d, d): standard errors."""
    coefficient: float
    """Mean of the tensor's diagonal, m^2/s."""
    error: float
    """Its standard error."""
    exponent: float
    """Of the time with which mean squares grow, between one window of time and two: 1 for diffusion, 2 for ballistic motion."""
    exponent_error: float
    window: float
    """s: displacements are taken over windows of this length, and of twice this length."""
    orbits: int
    corridors: tuple[Corridor, ...]
    """Free corridors: with one the horizon is infinite, and the coefficient grows with the logarithm of the window."""

    def describe(self) -> str:
        """Return one line."""
        free = "no free corridor"
        if self.corridors:
            free = f"free corridors, the widest of {self.corridors[0].width:.4g} m: D grows as ln t"
        return (
            f"D = {self.coefficient:.4g} ± {self.error:.2g} m²/s; "
            f"mean squares grow as t^{self.exponent:.3f} ± {self.exponent_error:.3f}; {free}"
        )


def diffusion(
    table: Table,
    orbits: int = 400,
    bounces: int = 2000,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    speed: float = 1.0,
    window: float | None = None,
    seed: int = 0,
) -> Diffusion:
    """Measure the diffusion coefficient of orbits in a periodic cell.

    Displacements are taken over consecutive windows of time and over pairs of them; half the difference of their mean squares over
    the window is the coefficient, without the ballistic beginning. Each orbit gives one value, and their scatter the error.

    Parameters
    ----------
    table : Table
        A periodic cell.
    orbits, bounces : int
        Number of orbits, drawn from the invariant measure, and of bounces of each.
    ball, law, surface
        As for :func:`orbit`; a law that keeps the energy.
    speed : float
        sqrt(2 energy / m), m/s; where the law leaves the spin alone all energy is in the velocity.
    window : float, optional
        s; default: 30 mean flights.
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Diffusion

    Raises
    ------
    CaromError
        A table that is not periodic, a force, a law that loses energy, fewer than two windows in the bounces, one orbit.

    Examples
    --------
    Sinai's billiard has a free corridor along each axis:

    >>> from carom import billiards
    >>> found = billiards.diffusion(billiards.sinai(0.4), orbits=20, bounces=400)
    >>> [one.cells for one in found.corridors]
    [(0, 1), (1, 0)]
    """
    setup = orbit_setup(table, ball, law, surface, "end")
    free = tuple(_corridors(setup.shape, table))
    if table.has_force or not setup.conservative:
        raise CaromError(
            Fault("diffusion", "table, law", "no force, and a law that keeps the energy", f"{table}, {setup.law}")
        )
    require_count("diffusion", "orbits", orbits, 2, advice="their scatter gives the error")
    flight = mean_flight(table, ball=ball, law=law, speed=speed).time
    tau = FLIGHTS_PER_WINDOW * flight if window is None else float(window)
    if not 0 < tau < math.inf:
        raise CaromError(Fault("diffusion", "window", "a time > 0 s", repr(window)))
    start = starts(table, orbits, seed, ball=ball, law=law, speed=speed, spins=not setup.keeps_spin)
    found = orbit_from_setup(setup, start, bounces)
    axes = [k for k, side in enumerate(setup.shape.cell or ()) if math.isfinite(side)]
    one, two = _mean_products(found, axes, tau)
    tensors = (two - one) / (2 * tau)  # (N, d, d)
    each = np.trace(tensors, axis1=1, axis2=2) / len(axes)
    squares = np.stack([np.trace(one, axis1=1, axis2=2), np.trace(two, axis1=1, axis2=2)])
    means, count = squares.mean(1), len(each)
    scatter = np.log2(means[1] / means[0]) + (squares[1] / means[1] - squares[0] / means[0]) / math.log(2)
    return Diffusion(
        tensors.mean(0), tensors.std(0, ddof=1) / math.sqrt(count), float(each.mean()),
        float(each.std(ddof=1) / math.sqrt(count)), float(np.log2(means[1] / means[0])),
        float(scatter.std(ddof=1) / math.sqrt(count)), tau, count, free,
    )  # fmt: skip


def _mean_products(found: Orbit, axes: list[int], tau: float) -> tuple[Array, Array]:
    """Return the mean products (N, d, d) of displacements over windows of time and over pairs of them, of each orbit."""
    whole = np.flatnonzero(found.ending == DONE)
    pairs = int(found.t[whole, -1].min() // (2 * tau)) if len(whole) > 1 else 0
    if pairs < 1:
        expected = f"bounces for two windows of {tau:.6g} s, of two orbits or more"
        raise CaromError(
            Fault("diffusion", "bounces", expected, f"{found.t.shape[-1]}", "make more, or give a shorter window")
        )
    marks = np.arange(2 * pairs + 1) * tau
    origin = np.broadcast_to(found.start.position, (*found.count.shape, 2))
    place = np.empty((len(whole), len(marks), len(axes)))
    for row, k in enumerate(whole):
        t = np.append(0.0, found.t[k])
        for column, axis in enumerate(axes):
            place[row, :, column] = np.interp(marks, t, np.append(origin[k, axis], found.position[k, :, axis]))
    step = np.diff(place, axis=1)
    double = step[:, 0::2] + step[:, 1::2]
    return tuple(np.einsum("nka,nkb->nab", one, one) / one.shape[1] for one in (step, double))


# --- recurrence -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Recurrence:
    """How long orbits take to come back to a set.

    Examples
    --------
    Kac's lemma: to a tenth of a stadium's wall an orbit comes back after ten bounces on average.

    >>> from carom import billiards
    >>> table = billiards.stadium()
    >>> found = billiards.orbit(table, billiards.starts(table, 50, seed=1), 2000)
    >>> back = billiards.recurrence(found, [(0.0, table.wall().lengths.sum() / 10)])
    >>> abs(back.mean - 10) < 5 * back.error
    True
    """

    bounces: NDArray[np.int64]
    """(M): bounces between two visits that follow each other, of all orbits."""
    time: Array
    """(M): s."""
    orbit: NDArray[np.int64]
    """(M): index of the orbit."""
    mean: float
    """Bounces made over visits: the mean number of bounces between visits; infinite without a visit."""
    error: float
    """Its standard error, from the scatter between orbits; NaN for one orbit or without a visit."""

    def survival(self, bounces: Any) -> tuple[Array, Array]:
        """Return the share (...) of returns that take more than some bounces (...), and its counting error."""
        asked = np.asarray(bounces, dtype=float)
        share = (self.bounces > asked[..., None]).mean(-1) if len(self.bounces) else np.full(asked.shape, np.nan)
        with np.errstate(divide="ignore", invalid="ignore"):
            return share, np.sqrt(share * (1 - share) / len(self.bounces))


def recurrence(found: Orbit, visits: Sequence[Sequence[float]] | NDArray[np.bool_]) -> Recurrence:
    """Measure the recurrence of orbits to a part of the wall, or to any set of states.

    Parameters
    ----------
    found : Orbit
        One or many, over all their bounces.
    visits : sequence of (from, to), m; or boolean array (..., B)
        Intervals of arc length, as the holes of :func:`escape`; or which bounces lie in the set.

    Returns
    -------
    Recurrence

    Raises
    ------
    CaromError
        Intervals that are none, an array of another shape, orbits that ended early.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.orbit(billiards.circle(), ((0.0, 0.5), (1.0, 0.0), 0.0), bounces=30, law="mirror")
    >>> set(billiards.recurrence(found, [(0.0, 1.0)]).bounces.tolist())
    {3}
    """
    inside = np.asarray(visits)
    if inside.dtype != bool:
        inside = in_holes(holes_in(found.setup.shape, visits, "recurrence", "visits"), found.setup.shape, found)
    if inside.shape != found.t.shape:
        raise CaromError(Fault("recurrence", "visits", f"an array {found.t.shape}", f"{inside.shape}"))
    if (np.asarray(found.ending) != DONE).any():
        raise CaromError(Fault("recurrence", "orbit", "one that made all its bounces", "one that ended early"))
    inside, t = inside.reshape(-1, inside.shape[-1]), found.t.reshape(-1, inside.shape[-1])
    who, k = np.nonzero(inside)
    same = who[1:] == who[:-1]
    counts = inside.sum(1)
    rate, n = counts.mean() / inside.shape[-1], len(counts)
    error = counts.std(ddof=1) / math.sqrt(n) / inside.shape[-1] if n > 1 else math.nan
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = float(np.divide(1.0, rate))
        spread = float(error / rate**2) if rate else math.nan
    return Recurrence(np.diff(k)[same], np.diff(t[who, k])[same], who[1:][same], mean, spread)
