"""Periodic orbits by their itinerary: closed polygons of extremal length, with the mirror law; Newton's method from these."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary
from carom.billiards.energy_shell import EnergyShell, residual, solve_periodic
from carom.billiards.orbits import require_integer
from carom.billiards.same_orbits import run_orbits
from carom.billiards.setup import orbit_setup
from carom.billiards.symbols import letters_of
from carom.billiards.tables import Table
from carom.errors import CaromError, Fault

__all__ = ["codes", "orbits_with_code"]

Array = NDArray[np.float64]
ITERATIONS = 60  # of Newton's method for the polygons
LONGEST_STEP = 0.1  # of the wall
SHORTEST_SHARE = 1e-4  # of Newton's step
ROUNDING = 1e-13  # of the tangent map: so nearly must a polygon's state come back
SOFT = 1e-9  # second derivatives below it, 1/m, are those of a family: its members are extremal, too
MOST_CODES = 1_000_000


def codes(table: Table, period: int) -> list[str]:
    """Return the codes of a length that periodic orbits may have, each once up to where it begins.

    A flat wall or a round obstacle cannot follow itself, but for an obstacle and its image in a periodic cell; codes of obstacles
    alone do not repeat themselves. Which of the codes have an orbit, :func:`periodic_orbits` shows: the others are pruned.

    Parameters
    ----------
    table : Table
        In the plane, with at most 52 walls.
    period : int
        Number of bounces, 2 or more.

    Returns
    -------
    list of str

    Raises
    ------
    CaromError
        More than a million words to go through.

    Examples
    --------
    >>> from carom import billiards
    >>> [len(billiards.codes(billiards.discs(), p)) for p in range(2, 8)]
    [3, 2, 3, 6, 9, 18]
    """
    p = require_integer("period", period, 2)
    shape = orbit_setup(table, None, "mirror", None, "end").shape
    count = int(shape.parts.max(initial=-1)) + 1
    again, around = _meets_itself(shape)
    if not 0 < count <= 52 or count**p > MOST_CODES:
        expected = f"walls and a period with at most {MOST_CODES:,} words, and at most 52 walls"
        raise CaromError(Fault("codes", "period", expected, f"{count} walls and {p}"))
    found = set()
    for word in itertools.product(range(count), repeat=p):
        turns = [word[k:] + word[:k] for k in range(p)]
        once = len(set(turns)) == p or not all(around[k] for k in word)
        if word == min(turns) and once and all(a != b or again[a] for a, b in zip(word, turns[1], strict=True)):
            found.add(word)
    return [letters_of(word) for word in sorted(found)]


def _meets_itself(shape: Boundary) -> tuple[list[bool], list[bool]]:
    """Return which walls can be met twice in turn, and which are round obstacles: by part."""
    flat, outside = len(shape.faces), len(shape.faces) + len(shape.inside)
    first = [int(np.flatnonzero(shape.parts == part)[0]) for part in range(int(shape.parts.max()) + 1)]
    around = [outside <= k < outside + len(shape.outside) for k in first]
    return [k >= flat and (not one or bool(shape.images)) for k, one in zip(first, around, strict=True)], around


def orbits_with_code(shell: EnergyShell, code: list[int], first: Array, count: int) -> Array:
    """Return coordinates (M, 4) of the orbits with a code.

    They are found by Newton's method from ``count`` polygons with corners on these walls, and from the states ``first`` (N, 4).
    """
    p, shape = len(code), shell.setup.shape
    begin = _polygons(shell, code, count)
    if shell.free.stop == 4:
        y = solve_periodic(shell, np.concatenate([begin, first]), p)
    else:
        # (Newton's steps over a whole period are less exact than the polygons where multipliers are large)
        f, _df, matrix = shell.equations(begin, p)
        y = begin[residual(f) <= ROUNDING * (1 + np.abs(matrix).max(axis=(1, 2)))]
    if not len(y):
        return y
    met = shape.wall_parts(run_orbits(shell, y, p).piece)
    turns = {tuple(code[k:] + code[:k]) for k in range(p)}
    return y[[tuple(row.tolist()) in turns for row in met]]


def _polygons(shell: EnergyShell, code: list[int], count: int) -> Array:
    """Return coordinates (M, 4) of states that fly along closed polygons, which are of extremal length without spin and force."""
    shape = shell.setup.shape
    begins, sizes = shape.starts, shape.lengths
    rng = np.random.default_rng(0)
    s = np.empty((count, len(code)))
    for k, part in enumerate(code):
        pieces = np.flatnonzero(shape.parts == part)
        which = rng.choice(pieces, count, p=sizes[pieces] / sizes[pieces].sum())
        s[:, k] = begins[which] + rng.uniform(size=count) * sizes[which]
    # corners stay on their walls
    low, size = np.empty(len(code)), np.empty(len(code))
    for wall in shape.connected:
        on = [
            k
            for k, part in enumerate(code)
            if shape.parts[wall.pieces[0]] <= part and part in shape.parts[list(wall.pieces)]
        ]
        low[on], size[on] = wall.first, wall.last - wall.first
    if shell.free.stop < 4 and not shell.setup.table.has_force:
        s = _extremal(shape, s, low, size)
    _slope, _bend, _flight, u, t, n = _length_derivatives(shape, s)
    y = np.zeros((count, 4))
    y[:, 0] = s[:, 0] / shell.size
    rolls = np.sqrt(1.0 + float(shell.setup.ball.kappa)) if shell.setup.rolls else 1.0
    y[:, 1], y[:, 2] = (shell.speed / rolls * (u[:, 0] * one[:, 0]).sum(-1) for one in (t, n))
    return y[np.isfinite(y).all(1) & (y[:, 2] > 0)]


def _extremal(shape: Boundary, s: Array, low: Array, size: Array) -> Array:
    """Return polygons (N, p) of extremal length to which Newton's method leads; a step that makes one worse is shortened.

    Half of them go to the next extremum, half to the next minimum: around obstacles it is the only one that a ball can follow.
    """
    shortest = np.arange(len(s)) >= len(s) // 2
    share = np.ones(len(s))
    slope, bend, flight, *_rest = _length_derivatives(shape, s)
    worth = np.where(shortest, flight.sum(1), (slope**2).sum(1))
    for _ in range(ITERATIONS):
        sizes, axes = np.linalg.eigh(bend)
        sizes[shortest] = np.abs(sizes[shortest])
        sizes = np.where(np.abs(sizes) < SOFT, SOFT, sizes)
        step = -np.einsum("nij,nj,nkj,nk->ni", axes, 1 / sizes, axes, slope, optimize=True)
        most = np.abs(step / size).max(1)
        step *= (share * np.minimum(1.0, LONGEST_STEP / np.maximum(most, 1e-300)))[:, None]
        trial = low + (s + step - low) % size
        slope2, bend2, flight2, *_rest = _length_derivatives(shape, trial)
        worth2 = np.where(shortest, flight2.sum(1), (slope2**2).sum(1))
        # (at the extremum itself lengths differ by rounding)
        better = (worth2 < worth) | ((slope2**2).sum(1) < (slope**2).sum(1)) & (worth2 < worth + 1e-13 * np.abs(worth))
        s, slope = np.where(better[:, None], trial, s), np.where(better[:, None], slope2, slope)
        bend, worth = np.where(better[:, None, None], bend2, bend), np.where(better, worth2, worth)
        share = np.where(better, np.minimum(1.0, 2 * share), share / 4)
        share = np.where(share < SHORTEST_SHARE, 1.0, share)
    return s


def _length_derivatives(shape: Boundary, s: Array) -> tuple[Array, Array, Array, Array, Array, Array]:
    """Return slopes (N, p) and second derivatives (N, p, p) of the lengths of polygons by their corners' arc lengths (N, p).

    And the lengths (N, p) of their sides, the directions (N, p, 2) of these, and the tangents and normals at their corners.
    """
    count, p = s.shape
    piece, x, n = shape.place(s)
    t = np.stack([n[..., 1], -n[..., 0]], axis=-1)
    k = shape.curvatures(piece.ravel(), x.reshape(-1, 2)).reshape(s.shape)
    side = shape.folded(np.roll(x, -1, axis=1) - x)
    flight = np.maximum(np.linalg.norm(side, axis=-1), 1e-9 * shape.size)
    u = side / flight[..., None]
    before = np.roll(u, 1, axis=1)
    slope = (t * (before - u)).sum(-1)
    # tangents turn by k ds n; sides by their component across
    across, across_before = (1 - (t * one).sum(-1) ** 2 for one in (u, before))
    bend = np.zeros((count, p, p))
    i = np.arange(p)
    bend[:, i, i] = k * (n * (before - u)).sum(-1) + across / flight + across_before / np.roll(flight, 1, axis=1)
    next_t = np.roll(t, -1, axis=1)
    mixed = -((t * next_t).sum(-1) - (t * u).sum(-1) * (next_t * u).sum(-1)) / flight
    for one in range(p):
        bend[:, one, (one + 1) % p] += mixed[:, one]
        bend[:, (one + 1) % p, one] += mixed[:, one]
    return slope, bend, flight, u, t, n
