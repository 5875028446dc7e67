"""Periodic orbits of a table in the plane: Newton's method from many starts, and which of its solutions are the same."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.coded_orbits import (
    EQUAL,
    NULL,
    EnergyShell,
    bounce_sequences,
    cells_passed,
    code_numbers,
    congruent,
    energy_shell,
    family_key,
    least_period,
    letters_of,
    orbits_with_code,
    periods_of,
    piece_symmetries,
    run_orbits,
    solve_periodic,
    windings,
)
from carom.billiards.orbits import Orbit, orbit_from_setup
from carom.billiards.orbits import starts as sampled_starts
from carom.billiards.setup import Start, start_rows
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault, require_count
from carom.formatting import counted
from carom.public.defaults import PERIODIC_STARTS
from carom.public.progress import Progress


@dataclass(frozen=True, eq=False)
class PeriodicOrbit:
    """One periodic orbit with its stability.

    Besides the multiplier 1 of the energy the map of one period has three, since bounces keep the measure |v.n| ds dv_t dspin:
    lambda, 1/lambda and 1 or -1.

    Examples
    --------
    >>> from carom import billiards
    >>> long, short = billiards.periodic_orbits(billiards.ellipse(2.0, 1.0), 2, law="mirror")[::-1]
    >>> round(long.duration, 9), long.stability, round(short.duration, 9), short.stability
    (8.0, 'hyperbolic', 4.0, 'elliptic')
    """

    orbit: Orbit
    """One period: p bounces, the last of which leads back to the start."""
    period: int
    """Least number of bounces p after which the state returns (in a periodic cell: up to whole cells)."""
    duration: float
    """s: of one period."""
    trace: float
    """lambda + 1/lambda of the pair of multipliers."""
    third: float
    """The third multiplier, 1 or -1: with the mirror law, of the spin."""
    stability: str
    """"elliptic" (|trace| < 2), "hyperbolic" (> 2) or "parabolic"."""
    winding: int | None
    """Turns of one period around the boundary, in the direction that has fewer (in a magnetic field counterclockwise); None if the
    boundary is not one closed curve."""
    cells: tuple[int, int] | None
    """Cells passed in x and y during one period; None in a table that is not periodic."""
    family: int
    """Number of directions in which there are neighbouring periodic orbits of the same energy; 0: it is isolated."""
    error: float
    """Estimated error of the first state, relative to the table's size and the ball's speed: residual and rounding, through the
    inverse of Newton's matrix; where that is singular although the orbit is isolated, some 1e-5."""
    energy: float
    """Twice the energy per mass, m^2/s^2."""
    found: int
    """Number of starts that led to this orbit, to a congruent one or to its family."""

    @property
    def multipliers(self) -> NDArray[np.complex128]:
        """(3): lambda, 1/lambda and the third; from the trace, so that they are exact to rounding for parabolic orbits too."""
        half = self.trace / 2
        root = np.sqrt(complex(half * half - 1))
        far = half + root if half >= 0 else half - root
        return np.array([far, 1 / far, self.third])

    @property
    def rotation_number(self) -> float | None:
        """Of the neighbours of an elliptic orbit: the angle of the multipliers over 2 pi, from 0 to 1/2; None for others."""
        return math.acos(self.trace / 2) / math.tau if self.stability == "elliptic" else None

    @property
    def multiple(self) -> bool:
        """Whether it is a multiple root of its equations: parabolic and isolated, so that it is known less well (``error``)."""
        return self.stability == "parabolic" and not self.family

    @property
    def pieces(self) -> tuple[int, ...]:
        """(p): index of the piece of the boundary at each bounce, as :attr:`Orbit.piece`."""
        return tuple(int(k) for k in self.orbit.piece)

    @property
    def itinerary(self) -> str:
        """The walls that it meets as letters (:func:`itinerary`), from where the text comes first in the alphabet."""
        walls = self.orbit.setup.shape.wall_parts(self.orbit.piece).tolist()
        return letters_of(min(walls[k:] + walls[:k] for k in range(self.period)))

    def to_dict(self) -> dict[str, Any]:
        """Return the orbit as plain numbers, for JSON: its multipliers as [real, imaginary], its bounces one after the other."""
        names = (
            "period", "duration", "stability", "trace", "rotation_number", "winding", "cells", "itinerary", "family", "error",
            "found",
        )  # fmt: skip
        run = self.orbit
        return {name: getattr(self, name) for name in names} | {
            "multipliers": [[one.real, one.imag] for one in self.multipliers.tolist()],
            "position": run.position.tolist(), "velocity": run.velocity.tolist(), "spin": run.spin.tolist(),
            "piece": list(self.pieces),
        }  # fmt: skip

    def __repr__(self) -> str:
        """Return one line."""
        return f"<PeriodicOrbit: {self.orbit.setup.table}: {self.describe()}>"

    def describe(self) -> str:
        """Return one line: period, duration, stability and what else is known."""
        said = [f"period {self.period}", f"duration {self.duration:.9g} s", self.stability]
        if self.rotation_number is not None:
            said.append(f"rotation number {self.rotation_number:.6f}")
        else:
            said.append(f"multiplier {self.multipliers[0].real:.9g}")
        if self.winding is not None:
            said.append(f"winds {self.winding} of {self.period}")
        if self.cells is not None:
            said.append(f"passes {self.cells[0]}, {self.cells[1]} cells")
        if self.family:
            said.append(f"one of a family with {self.family} parameter{'s' if self.family > 1 else ''}")
        return ", ".join(said)


@dataclass(frozen=True, eq=False)
class PeriodicOrbits(Sequence[PeriodicOrbit]):
    """The periodic orbits that were found, by period and duration, each once up to congruence.

    Orbits that differ by a rotation, a reflection or the direction of time are congruent; in a magnetic field by a rotation, or
    by a reflection and the direction of time. Of each continuous family one is listed.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.periodic_orbits(billiards.circle(), (2, 3, 4), law="mirror", starts=200)
    >>> [(one.period, one.winding, round(one.duration, 9)) for one in found]
    [(2, 1, 4.0), (3, 1, 5.196152423), (4, 1, 5.656854249)]
    """

    orbits: tuple[PeriodicOrbit, ...]
    starts: int
    """Number of starts for each period."""
    corners: bool = False
    """Whether the table has corners, at which orbits end."""

    def __len__(self) -> int:
        """Return the number of orbits."""
        return len(self.orbits)

    def __getitem__(self, which: Any) -> Any:
        """Return one orbit, or a tuple of them."""
        return self.orbits[which]

    def __iter__(self) -> Iterator[PeriodicOrbit]:
        """Iterate over the orbits."""
        return iter(self.orbits)

    @property
    def unseen(self) -> float:
        """Estimated chance that one more start that closes shows a new orbit: the share of orbits found once (Good 1953)."""
        closed = sum(one.found for one in self.orbits)
        return sum(one.found == 1 for one in self.orbits) / closed if closed else 1.0

    def __repr__(self) -> str:
        """Return one line."""
        return f"<PeriodicOrbits: {len(self)} from {self.starts:,} starts>"

    @property
    def completeness(self) -> str:
        """How many starts closed, whether orbits were found once only, and whether corners leave some out: one line."""
        closed, once = sum(one.found for one in self.orbits), sum(one.found == 1 for one in self.orbits)
        left_out = (
            " The map is not smooth at the table's corners: orbits that meet one are left out." if self.corners else ""
        )
        if not closed:
            return f"No periodic orbit: none of {self.starts:,} starts for each period closed.{left_out}"
        end = (
            f"{counted(once, 'orbit')} found once: more starts may show more"
            if once
            else "every orbit was found twice or more"
        )
        return f"{counted(closed, 'start')} closed, of {self.starts:,} for each period; {end}.{left_out}"

    def describe(self) -> str:
        """Return a line for each orbit, and how complete the list is likely to be."""
        return "\n".join([*(f"{one.describe()}, found {one.found} times" for one in self.orbits), self.completeness])


# ----------------------------------------------------------------------------------------------------
# Periodic orbits of a table in the plane: Newton's method from many starts, and which of its solutions are the same.


Array = NDArray[np.float64]
DEGENERATE = 1e-5  # flights and velocities across the wall below it, relative to the table's size and the ball's speed
PARABOLIC = 1e-7  # distance of the trace from 2 or -2, relative to the size of the tangent map
MOVE = 1e-3  # length of the step that shows whether orbits form a family


def periodic_orbits(
    table: Table,
    period: int | str | Iterable[int] | None = None,
    *,
    itinerary: str | Iterable[str] | None = None,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    starts: int = PERIODIC_STARTS,
    seed: int = 0,
    speed: float = 1.0,
    progress: Progress | None = None,
) -> PeriodicOrbits:
    """Find the periodic orbits of a table in the plane: Newton's method with the exact tangent map, from many starts.

    Starts are drawn from the invariant measure. Each is moved by Newton's steps until it closes after the given number of
    bounces; a step that does not bring it nearer is shortened. Nothing proves that a list is complete: it says how often each
    orbit was found.

    Parameters
    ----------
    table : Table
        In the plane, with a closed boundary or obstacles in a periodic cell.
    period : int, several, or text such as "2-6" or "3,5"
        Least number of bounces.
    itinerary : str or several, in place of ``period``
        Walls that the orbit meets, such as "ABC" (:func:`itinerary`, :func:`codes`): the orbits with this code are sought, each
        code for itself, with the mirror law from polygons of extremal length.
    ball, law, surface
        As for :func:`orbit`; a law that keeps the energy, and volumes of velocities: a custom law may.
    starts : int
        Number of starts for each period.
    seed : int
        Seed of the random numbers.
    speed : float
        sqrt(2 energy / m), m/s; under a force, the speed of a ball at the origin.
    progress : callable(done, total, text), optional
        Called with the number of periods done, and of all.

    Returns
    -------
    PeriodicOrbits

    Raises
    ------
    CaromError
        A law that loses energy, a table without a closed boundary or in space.

    Examples
    --------
    Across a stadium the orbits of period two are a family; along it there is one.

    >>> from carom import billiards
    >>> found = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), 2, law="mirror")
    >>> [(round(one.duration, 9), one.stability, one.family) for one in found]
    [(4.0, 'parabolic', 1), (8.0, 'hyperbolic', 0)]
    """
    shell = energy_shell(table, ball, law, surface, speed)
    count, seed = require_count("orbit", "starts", starts), require_count("orbit", "seed", seed, 0)
    if (period is None) == (itinerary is None):
        got = "neither" if period is None else "both"
        raise CaromError(Fault("periodic_orbits", "period, itinerary", "one of the two", got))
    words = [itinerary] if isinstance(itinerary, str) else list(itinerary or ())
    wanted = [code_numbers(shell.setup.shape, one) for one in words]
    periods = [len(one) for one in wanted] or periods_of(period)
    report = progress
    rng = sampled_starts(table, count, seed, ball=ball, law=law, speed=speed)
    first = first_coordinates(shell, rng)
    found: list[PeriodicOrbit] = []
    for k, p in enumerate(periods):
        y = orbits_with_code(shell, wanted[k], first, count) if wanted else solve_periodic(shell, first, p)
        found += _distinct(shell, y, p)
        if report is not None:
            report(k + 1, len(periods), "periods")
    return PeriodicOrbits(
        tuple(sorted(found, key=lambda one: (one.period, one.duration))), count, shell.setup.has_corners
    )


def refine_orbit(
    table: Table,
    start: Any,
    period: int,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
) -> PeriodicOrbit:
    """Compute the periodic orbit near a state, by Newton's method: it has the energy of the state.

    Parameters
    ----------
    table, ball, law, surface
        As for :func:`periodic_orbits`.
    start : Start, or (position, velocity, spin)
        One state near the orbit.
    period : int
        Number of bounces after which it closes; it may be a multiple of the least one.

    Returns
    -------
    PeriodicOrbit

    Raises
    ------
    CaromError
        Newton's method does not lead to an orbit that closes.

    Examples
    --------
    >>> from carom import billiards
    >>> one = billiards.refine_orbit(billiards.sinai(0.4), ((0.5, 0.0), (1.0, 0.0), 0.0), 2)
    >>> one.stability, abs(one.orbit.folded[:, 0]).round(9).tolist(), round(one.trace, 9)
    ('elliptic', [0.4, 0.4], -0.222222222)
    """
    rough = energy_shell(table, ball, law, surface, 1.0)
    rows, shape = start_rows(rough.setup, start)
    if shape:
        raise CaromError(Fault("refine_orbit", "start", "one state", f"{len(rows)}"))
    begin = first_coordinates(rough, Start(rows[:, :2], rows[:, 3:5], rows[:, 8]))
    if not len(begin):
        raise CaromError(Fault("refine_orbit", "start", "a state that leads to a wall", "one that meets none"))
    energy = float(rough.excess(rough.rows(begin)[0], begin)[0][0] + rough.energy)
    shell = replace(rough, energy=energy)
    solved = solve_periodic(shell, begin, periods_of(period)[0])
    if not len(solved):
        raise CaromError(
            Fault(
                "refine_orbit",
                "start",
                f"a state near an orbit of period {period}",
                "one from which Newton's method leads to none",
            )
        )
    return describe_periodic(shell, solved[0], period)


def first_coordinates(shell: EnergyShell, start: Start) -> Array:
    """Return the coordinates (N, 4) after the first bounces of starts; those without a bounce are left out."""
    position, velocity = np.atleast_2d(start.position), np.atleast_2d(start.velocity)
    begun = orbit_from_setup(shell.setup, Start(position, velocity, np.atleast_1d(start.spin)), 1)
    ok = begun.count == 1
    y = shell.coordinates(begun.piece[ok, 0], begun.folded[ok, 0], begun.velocity[ok, 0], begun.spin[ok, 0])
    if shell.free.stop < 4:
        # the law leaves the spin alone: without it, all energy is in the velocity
        y[:, 1:3] *= np.sqrt(1 + y[:, 3] ** 2 / (y[:, 1] ** 2 + y[:, 2] ** 2))[:, None]
        y[:, 3] = 0.0
    return y


def _distinct(shell: EnergyShell, y: Array, p: int) -> list[PeriodicOrbit]:
    """Return the orbits of least period p among solutions (N, 4), each once up to congruence and within a family."""
    run = run_orbits(shell, y, p)
    closed = np.flatnonzero(run.count == p)
    if not len(closed):
        return []
    bounces, reverse = bounce_sequences(shell, run)
    # (a bounce that grazes, and flights in the utmost point of a corner, close for every start)
    short, slow = bounces[..., 0].min(1), bounces[..., 1].min(1)
    proper = (short > DEGENERATE * shell.size / shell.speed) & (slow > DEGENERATE * shell.speed)
    walls, cells = windings(shell, run), cells_passed(shell, run)
    symmetries, magnetic = piece_symmetries(shell.setup.shape), shell.setup.table.magnetic_field != 0.0
    kept: list[tuple[PeriodicOrbit, int, Any]] = []
    # of a family the member is shown that meets the walls most nearly head-on; of several, that with the longest flights
    for k in closed[np.lexsort((-short[closed], -slow[closed].round(6)))]:
        if not proper[k] or least_period(shell, run.folded[k], bounces[k]) != p:
            continue
        key = family_key(shell.setup.shape.wall_parts(run.piece[k]).tolist(), symmetries, walls[k], cells[k], magnetic)
        described: PeriodicOrbit | None = None
        for place, (one, shown, family) in enumerate(kept):
            if (one.family and key == family) or congruent(bounces[shown], bounces[k], reverse[k], EQUAL, magnetic):
                kept[place] = (replace(one, found=one.found + 1), shown, family)
                break
            # a multiple root of the equations is found to some cube root of rounding only, and no other is within MOVE of it
            if one.multiple and congruent(bounces[shown], bounces[k], reverse[k], MOVE, magnetic):
                described = described or describe_periodic(shell, y[k], p)
                if described.multiple:
                    kept[place] = (
                        replace(min(one, described, key=lambda each: each.error), found=one.found + 1),
                        shown,
                        family,
                    )
                    break
        else:
            described = described or describe_periodic(shell, y[k], p)
            # an orbit that is known badly may be one of fewer bounces, or may only seem to close, beside a joint of two pieces
            fewer = described.multiple and least_period(shell, run.folded[k], bounces[k], equal=MOVE) != p
            if not fewer and not _near_joint(shell, run.piece[k], run.folded[k], described.error):
                kept.append((described, int(k), key))
    return [one for one, _shown, _family in kept]


def _near_joint(shell: EnergyShell, piece: NDArray[np.int64], x: Array, error: float) -> bool:
    """Return whether normal or curvature jump within the error of one of the bounces, on pieces (p) at positions (p, 2)."""
    shape, reach = shell.setup.shape, error * shell.size
    s = shape.coordinate(piece, x)
    sides = [shape.place(s + way * reach) for way in (-1.0, 1.0)]
    (bend, n), (other, m) = ((np.abs(shape.curvatures(k, at)), n[:, :2]) for k, at, n in sides)
    # a smooth wall turns by its curvature times the length, and its curvature changes little
    jump = np.abs(bend - other) > (bend + other) / 10 + 100 * error / shell.size
    corner = np.linalg.norm(n - m, axis=1) > 3 * reach * np.maximum(bend, other) + 1e-9
    return bool((jump | corner).any())


def third_and_trace(shell: EnergyShell, matrix: Array) -> tuple[float, float]:
    """Return the third multiplier, 1 or -1, and the sum of the pair, from the map (4, 4) of a period; one is 1 (the energy)."""
    third = 1.0 if shell.free.stop < 4 else float(np.sign(np.linalg.det(matrix)))
    return third, float(np.trace(matrix)) - 1.0 - third


def describe_periodic(shell: EnergyShell, y: Array, p: int) -> PeriodicOrbit:
    """Return the periodic orbit that begins at coordinates (4), with its stability, family and error."""
    f, df, matrices = shell.equations(y[None], p)
    matrix, derivative = matrices[0], df[0][:, shell.free]
    third, trace = third_and_trace(shell, matrix)
    flat = abs(abs(trace) - 2.0) <= PARABOLIC * (1 + np.abs(matrix).max())
    many = run_orbits(shell, y[None], p)
    start = Start(*(np.asarray(one)[0] for one in (many.start.position, many.start.velocity, many.start.spin)))
    run = orbit_from_setup(shell.setup, start, p)
    winding = windings(shell, many)[0]
    sizes = np.linalg.svd(derivative, compute_uv=False)
    rounding = np.finfo(float).eps * p * (1 + np.abs(matrix).max())
    family = _family(shell, y, p, derivative)
    # along a family the equations are singular; another singular value that is small, at a multiple root, bounds the error
    least = max(sizes[len(sizes) - 1 - family], rounding / MOVE) if family < len(sizes) else sizes[0]
    stability = "parabolic" if flat else "elliptic" if abs(trace) < 2 else "hyperbolic"
    cells = None if shell.setup.shape.cell is None else cells_passed(shell, many)[0]
    return PeriodicOrbit(
        run, p, float(run.t[-1]), math.copysign(2.0, trace) if flat else trace, third, stability,
        None if winding < 0 else winding if shell.setup.table.magnetic_field else min(winding, p - winding), cells, family,
        float((np.linalg.norm(f[0]) + rounding) / least), shell.energy, 1,
    )  # fmt: skip


def _family(shell: EnergyShell, y: Array, p: int, derivative: Array) -> int:
    """Return in how many null directions of the equations a short step leads to another orbit that closes."""
    _u, sizes, directions = np.linalg.svd(derivative)
    count = 0
    for size, direction in zip(sizes, directions, strict=True):
        if size > NULL * sizes[0]:
            continue
        moved = y.copy()
        moved[shell.free] += MOVE * direction
        solved = solve_periodic(shell, moved[None], p)
        if len(solved) and abs((solved[0] - y)[shell.free] @ direction) > MOVE / 2:
            count += 1
    return count
