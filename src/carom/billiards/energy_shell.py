"""Equations of periodic orbits on one energy shell, with exact derivatives, and Newton's method for them.

An orbit of period p is a fixed point of p bounces. Its unknowns are the state just after one bounce: arc length s, velocities v_t
and v_n along and across the wall, spin q = sqrt(kappa) a omega. The equations: p bounces lead back, and the energy is the given
one. There is one equation more than unknowns, since bounces keep the energy; the step of least length solves them, also where
orbits form a continuous family.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import ConnectedWall
from carom.billiards.setup import OrbitSetup, orbit_setup
from carom.billiards.stability import end_coordinates, tangents_of_bounces
from carom.billiards.table_records import DONE, POSITION, TIME, VELOCITY
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault

__all__ = ["LARGEST_RESIDUAL", "NULL", "EnergyShell", "energy_shell", "newton_steps", "residual", "solve_periodic"]

Array = NDArray[np.float64]
ITERATIONS = 60  # of Newton's method, steps that are shortened among them
LONGEST_STEP = 0.2  # relative to the table's size and the ball's speed
SHORTEST_SHARE = 1 / 64  # of Newton's step: where no larger share brings the orbit nearer to closing, the search ends
CLOSED = 1e-12  # residual at which an orbit counts as closed, relative to its tangent map; two more steps follow
LARGEST_RESIDUAL = 1e-8  # where rounding, enlarged by the map, exceeds it, nothing shows that an orbit is there
NULL = 1e-7  # singular values of the equations, relative to the largest, that count as zero


@dataclass(frozen=True, eq=False)
class EnergyShell:
    """Coordinates of states just after a bounce, on one energy shell, and the map of bounces in them.

    States are rows (N, 4) of s over the table's size, v_t, v_n and q. ``free``: the coordinates that are unknowns; q is none where
    the law leaves the spin alone.
    """

    setup: OrbitSetup
    energy: float
    """Twice the energy per mass, m^2/s^2."""

    @property
    def free(self) -> slice:
        """The unknowns among the coordinates."""
        return slice(0, 3 if self.setup.keeps_spin else 4)

    @property
    def speed(self) -> float:
        """Of a ball that does not spin, m/s."""
        return math.sqrt(self.energy)

    @property
    def size(self) -> float:
        """Of the table, m."""
        return float(self.setup.shape.size)

    def rows(self, y: Array) -> tuple[Array, Array, NDArray[np.int64]]:
        """Return the states (N, 9) of coordinates (N, 4), the normals (N, 3) and the pieces (N) of the boundary there."""
        ball = self.setup.ball
        piece, x, n = self.setup.shape.place(y[:, 0] * self.size)
        rows, normal = np.zeros((len(y), 9)), np.zeros((len(y), 3))
        rows[:, :2], normal[:, :2] = x, n
        t = np.stack([n[:, 1], -n[:, 0]], axis=1)
        rows[:, 3:5] = y[:, 1:2] * t + y[:, 2:3] * n
        rows[:, 8] = y[:, 3] / (math.sqrt(ball.kappa) * ball.radius)
        if self.setup.rolls:
            # as start_rows has it
            rows[:, 6], rows[:, 7] = -rows[:, 4] / ball.radius, rows[:, 3] / ball.radius
        return rows, normal, piece

    def coordinates(self, piece: Any, x: Array, v: Array, spin: Array) -> Array:
        """Return the coordinates (..., 4) of states: pieces (...), positions and velocities (..., 2), spins (...)."""
        n = self.setup.shape.normals(piece, x)
        s = self.setup.shape.coordinate(piece, x)
        ball = self.setup.ball
        along, across = n[..., 1] * v[..., 0] - n[..., 0] * v[..., 1], (n[..., :2] * v).sum(-1)
        return np.stack([s / self.size, along, across, math.sqrt(ball.kappa) * ball.radius * spin], axis=-1)

    def excess(self, rows: Array, y: Array) -> tuple[Array, Array]:
        """Return twice the energy per mass beyond the given one (N), and its derivative (N, 4) by the coordinates."""
        rolls = 1.0 + self.setup.ball.kappa if self.setup.rolls else 1.0
        g = np.array(self.setup.table.acceleration)
        # (where no force acts, the energy does not depend on the place; to find this on a curve takes as long as a bounce)
        n = self.setup.shape.place(y[:, 0] * self.size)[2] if g.any() else np.zeros((len(y), 2))
        value = rolls * (y[:, 1] ** 2 + y[:, 2] ** 2) + y[:, 3] ** 2 - 2 * rows[:, :3] @ g - self.energy
        slope = np.stack(
            [-2 * self.size * (n[:, 1] * g[0] - n[:, 0] * g[1]), 2 * rolls * y[:, 1], 2 * rolls * y[:, 2], 2 * y[:, 3]],
            axis=1,
        )
        return value, slope

    def equations(self, y: Array, bounces: int) -> tuple[Array, Array, Array]:
        """Return the residuals (N, 5) of p bounces and of the energy, their derivatives (N, 5, 4), and the tangent maps (N, 4, 4).

        Residuals are infinite where the orbit ends before.
        """
        rows, n, piece = self.rows(y)
        f, df = np.full((len(y), 5), np.inf), np.full((len(y), 5, 4), np.nan)
        vectors, last, ends, after = tangents_of_bounces(self.setup, rows, n, bounces)
        ok = (ends["reason"] == DONE) & (y[:, 2] > 0)
        f[:, 4], df[:, 4] = self.excess(rows, y)
        new = self.coordinates(ends["piece"], last[:, POSITION][:, :2], last[:, VELOCITY][:, :2], last[:, 9])
        f[ok, :4] = (new - y)[ok]
        f[ok, 0] = self._around(ends["piece"], new[:, 0], y[:, 0])[ok]
        # the map's own coordinates keep the directions of velocities; here v_t and v_n turn with the wall
        turned, back = self._turn(ends["piece"], last[:, POSITION], new), self._turn(piece, rows[:, :3], y)
        matrix = turned @ end_coordinates(self.setup, vectors, after) @ (2 * np.eye(4) - back)
        scale = np.array([self.size, 1.0, 1.0, 1.0])
        matrix *= scale / scale[:, None]
        df[:, :4] = matrix - np.eye(4)
        f[~ok] = np.inf
        return f, df, matrix

    def duration(self, y: Array, bounces: int) -> float:
        """Return the time of a number of bounces from coordinates (4), s."""
        rows, n, _piece = self.rows(y[None])
        return float(tangents_of_bounces(self.setup, rows, n, bounces)[1][0, TIME])

    def _turn(self, piece: Any, x: Array, y: Array) -> Array:
        """Return the derivatives (N, 4, 4) of (s, v_t, v_n, q) by displacements along a wall of curvature k with velocities held.

        The normal turns by -k ds t, the tangent by k ds n.
        """
        k = self.setup.shape.curvatures(piece, x)
        found = np.tile(np.eye(4), (len(y), 1, 1))
        found[:, 1, 0], found[:, 2, 0] = k * y[:, 2], -k * y[:, 1]
        return found

    @cached_property
    def _walls(self) -> tuple[list[ConnectedWall], NDArray[np.int64]]:
        """The connected walls, and the number of the wall of each piece; the first entry is for none, as those of windows."""
        shape = self.setup.shape
        found = np.full(1 + len(self.setup.pieces), -1)
        first = len(shape.faces)
        met = np.array([k for k in range(len(found) - 1) if not first <= k < first + len(shape.windows)], int)
        found[1 + met] = shape.wall_numbers(met)
        return shape.connected, found

    def _around(self, piece: Any, new: Array, old: Array) -> Array:
        """Return differences of arc lengths (over the size), the shorter way around a closed wall if both are on it."""
        shape = self.setup.shape
        begin = old % (shape.lengths.sum() / self.size)
        d: Array = new - begin
        walls, table = self._walls
        numbers = table[np.asarray(piece, int) + 1]
        for k, wall in enumerate(walls):
            length = (wall.last - wall.first) / self.size
            here = (numbers == k) & wall.closed & (begin >= wall.first / self.size) & (begin < wall.last / self.size)
            d[here] -= length * np.round(d[here] / length)
        return d


def energy_shell(table: Table, ball: Ball | None, law: Any, surface: Surface | None, speed: float) -> EnergyShell:
    """Return the energy shell of a table, a ball and a law; CaromError where periodic orbits cannot be found there."""
    setup = orbit_setup(table, ball, law, surface, "end")
    if not setup.conservative:
        raise CaromError(
            Fault("periodic_orbits", "law", "one that keeps the energy (no-slip, mirror, rolling)", f"{setup.law}")
        )
    if not setup.planar:
        raise CaromError(Fault("periodic_orbits", "table", "a table in the plane", f"{table}"))
    lengths = setup.shape.lengths
    if not len(lengths) or not np.isfinite(lengths).all():
        raise CaromError(Fault("periodic_orbits", "table", "a closed boundary", f"{table}, whose walls have no end"))
    if not (isinstance(speed, int | float | np.number) and 0 < speed < math.inf):
        raise CaromError(Fault("periodic_orbits", "speed", "a positive number", repr(speed)))
    return EnergyShell(setup, float(speed) ** 2)


def solve_periodic(shell: EnergyShell, y: Array, p: int) -> Array:
    """Return the coordinates (M, 4) of the orbits of p bounces to which Newton's method leads from coordinates (N, 4)."""
    free, closed = shell.free, []
    f, df, matrix = shell.equations(y, p)
    size, share = residual(f), np.ones(len(y))
    for _ in range(ITERATIONS):
        on = np.isfinite(size) & (share >= SHORTEST_SHARE)
        y, f, df, matrix, size, share = (one[on] for one in (y, f, df, matrix, size, share))
        if not len(y):
            break
        done = size <= np.minimum(CLOSED * (1 + np.abs(matrix).max(axis=(1, 2))), LARGEST_RESIDUAL)
        closed.append(y[done])
        y, f, df, matrix, size, share = (one[~done] for one in (y, f, df, matrix, size, share))
        step = newton_steps(f, df[..., free])
        length = np.linalg.norm(step, axis=1)
        step *= np.minimum(1.0, LONGEST_STEP / np.maximum(length, 1e-300))[:, None] * share[:, None]
        trial = y.copy()
        trial[:, free] += step
        f2, df2, matrix2 = shell.equations(trial, p)
        size2 = residual(f2)
        better = size2 < size
        y, f, df, matrix = (
            np.where(_like(better, a), b, a) for a, b in ((y, trial), (f, f2), (df, df2), (matrix, matrix2))
        )
        size, share = np.where(better, size2, size), np.where(better, np.minimum(1.0, 2 * share), share / 4)
    return _polished(shell, np.concatenate([np.empty((0, 4)), *closed]), p)


def newton_steps(f: Array, df: Array) -> Array:
    """Return the steps (N, K) of least length that solve the linearised equations (N, 5) in the least-squares sense."""
    inverse = np.linalg.pinv(np.where(np.isfinite(df), df, 0.0), rcond=NULL)
    found: Array = -np.einsum("nij,nj->ni", inverse, f)
    return found


def _like(condition: Any, array: Array) -> Any:
    return condition.reshape(condition.shape + (1,) * (array.ndim - 1))


def residual(f: Array) -> Array:
    """Return the size (N) of residuals (N, 5); infinite where an orbit ends."""
    with np.errstate(invalid="ignore"):
        found: Array = np.linalg.norm(f, axis=1)
    return found


def _polished(shell: EnergyShell, y: Array, p: int) -> Array:
    """Return solutions after two more steps, each where it does not enlarge the residual."""
    for _ in range(2):
        if not len(y):
            break
        f, df, _matrix = shell.equations(y, p)
        trial = y.copy()
        trial[:, shell.free] += newton_steps(f, df[..., shell.free])
        better = residual(shell.equations(trial, p)[0]) < residual(f)
        y = np.where(better[:, None], trial, y)
    return y
