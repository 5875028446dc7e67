"""Which periodic orbits are the same: up to first bounce, direction of time, rotation and reflection, and within families."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary
from carom.billiards.energy_shell import EnergyShell
from carom.billiards.orbits import Orbit, moved_in_flight, orbit_from_setup, require_integer
from carom.billiards.setup import Start
from carom.errors import CaromError, Fault

__all__ = [
    "EQUAL", "bounce_sequences", "cells_passed", "congruent", "family_key", "least_period", "periods_of", "piece_symmetries",
    "run_orbits", "windings",
]  # fmt: skip

Array = NDArray[np.float64]
EQUAL = 1e-6  # relative: difference of flight times, velocities and spins of two orbits that are congruent
MAX_PERIOD = 1000
SYMMETRY_POINTS = 720  # of a boundary, by which its symmetries are found


def run_orbits(shell: EnergyShell, y: Array, p: int) -> Orbit:
    """Follow orbits from coordinates (N, 4) for a number of bounces."""
    begin = shell.rows(y)[0]
    return orbit_from_setup(shell.setup, Start(begin[:, :2], begin[:, 3:5], begin[:, 8]), p)


def bounce_sequences(shell: EnergyShell, run: Orbit) -> tuple[Array, Array]:
    """Return flight time, v_n, v_t, q (N, p, 4) of the bounces of closed orbits, and those of the orbits run backwards."""
    dt = np.diff(run.t, axis=1, prepend=0.0)  # before each bounce
    n = run.normal
    q = math.sqrt(shell.setup.ball.kappa) * shell.setup.ball.radius * run.spin
    before = moved_in_flight(shell.setup.table, np.roll(run.position, 1, axis=1), np.roll(run.velocity, 1, axis=1), dt)[
        1
    ]

    def split(u: Array) -> list[Array]:
        return [(u * n).sum(-1), n[..., 1] * u[..., 0] - n[..., 0] * u[..., 1]]

    ahead = np.stack([np.roll(dt, -1, axis=1), *split(run.velocity), q], axis=-1)
    back = np.stack([dt, *split(-before), -np.roll(q, 1, axis=1)], axis=-1)[:, ::-1]
    return ahead, back


def periods_of(period: Any) -> list[int]:
    """Return the periods that a number, several numbers, or a text of numbers and ranges mean, in ascending order."""
    if isinstance(period, str):
        parts = [[part.strip() for part in one.split("-")] for one in period.split(",")]
        if not all(len(ends) <= 2 and all(end.isdecimal() and len(end) < 9 for end in ends) for ends in parts):
            raise CaromError(Fault("orbit", "periodic", "numbers of bounces, such as 4, 2-6 or 3,5", repr(period)))
        ends = [(_period(int(one[0])), _period(int(one[-1]))) for one in parts]
        if turned := next((f"{first}-{last}" for first, last in ends if first > last), ""):
            raise CaromError(
                Fault("orbit", "periodic", "ranges from the smaller number to the larger, such as 2-6", repr(turned))
            )
        return sorted({p for first, last in ends for p in range(first, last + 1)})
    return sorted({_period(p) for p in (period if isinstance(period, Iterable) else (period,))})


def _period(period: Any) -> int:
    p: int = require_integer("periodic", period)
    if p > MAX_PERIOD:
        raise CaromError(Fault("orbit", "periodic", f"at most {MAX_PERIOD} bounces", f"{p}"))
    return p


def least_period(shell: EnergyShell, positions: Array, bounces: Array, equal: float = EQUAL) -> int:
    """Return the least number of bounces after which positions (p, 2) and bounces (p, 4) repeat."""
    p, shape = len(bounces), shell.setup.shape
    for d in range(1, p):
        if p % d == 0:
            moved = shape.folded(np.roll(positions, -d, axis=0) - positions)
            turned = np.roll(bounces, -d, axis=0) - bounces
            if max(np.abs(moved).max() / shell.size, np.abs(turned).max()) < equal:
                return d
    return p


def congruent(one: Array, other: Array, reversed_other: Array, equal: float = EQUAL, magnetic: bool = False) -> bool:
    """Whether the bounces (p, 4) of two orbits agree up to where they begin, a reflection and the direction of time.

    A magnetic field is turned round by either of the two, so there they count together only.
    """
    if abs(one[:, 0].sum() - other[:, 0].sum()) > equal * len(one):
        return False
    ways = [(other, 1.0), (reversed_other, -1.0)]
    ways += [] if magnetic else [(other, -1.0), (reversed_other, 1.0)]
    for variant, sign in ways:
        shown = variant * np.array([1.0, 1.0, sign, sign])
        if any(np.abs(np.roll(shown, k, axis=0) - one).max() < equal for k in range(len(one))):
            return True
    return False


def piece_symmetries(shape: Boundary) -> list[list[int]]:
    """Return how the rotations and reflections of a closed boundary about its middle permute its pieces; the identity first.

    The middles of the pieces and their ends are mapped on one another; a map is one of the table if all points of a sample stay on
    the boundary. Arcs of a smooth curve count as one piece between its corners.
    """
    total = float(shape.lengths.sum())
    met, x, _n = shape.place((np.arange(SYMMETRY_POINTS) + 0.5) * total / SYMMETRY_POINTS)
    pieces = shape.wall_parts(met)
    middles, lengths = shape.place(shape.starts + shape.lengths / 2)[1], shape.lengths
    if shape.curve is not None:
        first = np.unique(shape.parts, return_index=True)[1]
        lengths = np.bincount(shape.parts, lengths).astype(float)
        middles = shape.place(shape.starts[first] + lengths / 2)[1]
    origin = (
        np.zeros(2) if shape.cell is not None else (x.max(0) + x.min(0)) / 2 if len(middles) < 3 else middles.mean(0)
    )
    # (pieces of unequal length: their middles, weighted by length, have the table's own centre)
    if shape.cell is None and len(middles) >= 3:
        origin = (middles * lengths[:, None]).sum(0) / total
    angles = np.arctan2(*(middles - origin).T[::-1])
    found = [list(range(int(pieces.max()) + 1))]
    for sign in (1, -1):
        for angle in angles:
            turn = angle - sign * angles[0]
            image = (x - origin) * (1, sign) @ np.array(
                [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
            ) + origin
            distance = np.linalg.norm(shape.folded(image[:, None] - x), axis=-1)
            nearest = distance.argmin(1)
            if distance.min(1).max() > total / SYMMETRY_POINTS:
                continue
            permuted = list(found[0])
            for k in set(pieces.tolist()):
                permuted[k] = int(np.bincount(pieces[nearest[pieces == k]]).argmax())
            if permuted not in found:
                found.append(permuted)
    return found


def family_key(
    pieces: list[int], symmetries: list[list[int]], winding: int, cells: tuple[int, int], magnetic: bool = False
) -> Any:
    """Return the itinerary up to where it begins, its direction and the table's symmetries, the winding and the cells passed.

    In a magnetic field orbits that wind one way and the other are different ones.
    """
    p = len(pieces)
    ways = []
    for permuted in symmetries:
        named = [permuted[k] for k in pieces]
        for way in (named, named[::-1]):
            ways += [way[k:] + way[:k] for k in range(p)]
    return min(ways), winding if magnetic else min(winding, p - winding), tuple(sorted(map(abs, cells)))


def windings(shell: EnergyShell, run: Orbit) -> list[int]:
    """Return how often each orbit runs around the boundary; -1 where this is not one closed curve."""
    shape = shell.setup.shape
    walls = shape.connected
    if len(walls) != 1 or not walls[0].closed or shape.cell is not None:
        return [-1] * len(run.t)
    length = float(shape.lengths.sum())
    forward = (np.roll(run.arc, -1, axis=1) - run.arc) % length
    return [round(turns) if math.isfinite(turns) else -1 for turns in forward.sum(1) / length]


def cells_passed(shell: EnergyShell, run: Orbit) -> list[tuple[int, int]]:
    """Return the cells that each orbit passes in x and y; zeros in a table that is not periodic."""
    cell = shell.setup.shape.cell
    if cell is None:
        return [(0, 0)] * len(run.t)
    sides = np.where(np.isfinite(cell), cell, np.inf)
    moved = np.nan_to_num((run.position[:, -1] - np.asarray(run.start.position)) / sides).round().astype(int)
    return [(int(x), int(y)) for x, y in moved]
