"""Periodic orbits of a table in the plane: Newton's method from many starts, and which of its solutions are the same."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.coded_orbits import orbits_with_code
from carom.billiards.energy_shell import NULL, EnergyShell, energy_shell, solve_periodic
from carom.billiards.orbits import orbit_from_setup, require_integer
from carom.billiards.periodic_records import PeriodicOrbit, PeriodicOrbits
from carom.billiards.same_orbits import (
    EQUAL,
    bounce_sequences,
    cells_passed,
    congruent,
    family_key,
    least_period,
    periods_of,
    piece_symmetries,
    run_orbits,
    windings,
)  # fmt: skip
from carom.billiards.sampling import starts as sampled_starts
from carom.billiards.setup import Start, start_rows
from carom.billiards.symbols import code_numbers
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault
from carom.public.defaults import PERIODIC_STARTS
from carom.public.progress import Progress

__all__ = ["describe_periodic", "first_coordinates", "periodic_orbits", "refine_orbit", "third_and_trace"]

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
        As for :func:`orbit`; a law that keeps the energy.
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
        A law that loses energy, a custom law (its derivative is not known), a table without a closed boundary or in space.

    Examples
    --------
    Across a stadium the orbits of period two are a family; along it there is one.

    >>> from carom import billiards
    >>> found = billiards.periodic_orbits(billiards.stadium(2.0, 1.0), 2, law="mirror")
    >>> [(round(one.duration, 9), one.stability, one.family) for one in found]
    [(4.0, 'parabolic', 1), (8.0, 'hyperbolic', 0)]
    """
    shell = energy_shell(table, ball, law, surface, speed)
    count, seed = require_integer("starts", starts), require_integer("seed", seed, 0)
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
            if not (described.multiple and least_period(shell, run.folded[k], bounces[k], equal=MOVE) != p):
                kept.append((described, int(k), key))
    return [one for one, _shown, _family in kept]


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
