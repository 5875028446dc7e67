"""Stability: the tangent map of so many bounces, and the Lyapunov spectrum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.errors import CaromError
from carom.orbits.arrays import DONE, ENDS
from carom.orbits.setup import Setup, setup_of
from carom.orbits.tables import Table
from carom.orbits.tangent import compiled_tangent
from carom.orbits.verbs import follow, whole
from carom.surface import Surface

__all__ = ["Lyapunov", "TangentMap", "lyapunov", "tangent_map"]

Array = NDArray[np.float64]
PLANAR = ("s", "v_t", "v_n", "spin")
SPATIAL = ("s", "b", "v_t", "v_b", "v_n", "spin_t", "spin_b", "spin_n")


@dataclass(frozen=True, eq=False)
class TangentMap:
    """The derivative of so many bounces, from just after one to just after another.

    In the frame (t, b, n) of the wall at each end: t along it, n towards the ball, b = n x t in space. Spins are multiplied
    by sqrt(kappa) a, so that all velocities count alike in the energy.
    """

    matrix: Array
    """(..., 4, 4), in space (..., 8, 8): rows are what changes after, columns what was changed before."""
    coordinates: tuple[str, ...]
    """Of rows and columns: "s", "v_t", "v_n", "spin", and in space "s", "b", "v_t" ... "spin_n"."""
    across: Array
    """(..., 2): velocity away from the wall, before and after: |det(matrix)| = across[0]/across[1] where the measure is kept."""
    gap: Array
    """(...): how far the state at the end is from that at the beginning (lengths and velocities alike): 0 if periodic."""

    @property
    def eigenvalues(self) -> Array:
        """(..., 4) or (..., 8), complex: of a periodic orbit its multipliers; 1 is always among them (the energy)."""
        return np.linalg.eigvals(self.matrix)  # type: ignore[return-value]


@dataclass(frozen=True, eq=False)
class Lyapunov:
    """A Lyapunov spectrum, greatest first."""

    per_bounce: Array
    """(..., 4), in space (..., 8)."""
    per_time: Array
    """The same by the mean time between bounces, 1/s."""
    error: Array
    """Standard error of ``per_bounce``, from its scatter over the blocks of the run."""
    history: Array
    """(blocks, ..., 4): ``per_bounce`` up to the end of each block."""
    bounces: int
    ended: Any
    """(...): as :attr:`Orbit.ended`; where it is not "bounces" the exponents are NaN."""


def _frame(n: Array) -> tuple[Array, Array]:
    """Unit vectors t, b (N, 3) along walls with normals n (N, 3)."""
    t = np.stack([n[:, 1], -n[:, 0], np.zeros(len(n))], axis=1)
    flat = np.linalg.norm(t[:, :2], axis=1) < 1e-9
    t[flat] = [1.0, 0.0, 0.0]
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    return t, np.cross(n, t)


def _axes(setup: Setup, n: Array, v: Array) -> Array:
    """(N, K, 9): the displacements that the coordinates stand for, at walls with normals n."""
    t, b = _frame(n)
    ball = setup.ball
    size = np.sqrt(ball.kappa) * ball.radius
    zero = np.zeros_like(n)
    up = np.broadcast_to([0.0, 0.0, 1.0], n.shape)

    def follows(dv: Array) -> Array:
        """A rolling ball's spin follows its velocity, (18)."""
        return np.cross(up, dv) / ball.radius if setup.law == "rolling" else zero

    if setup.planar:
        rows = [(t, zero, zero), (zero, t, follows(t)), (zero, n, follows(n)), (zero, zero, up / size)]
    else:
        rows = [(t, zero, zero), (b, zero, zero)] + [(zero, e, zero) for e in (t, b, n)]
        rows += [(zero, zero, e / size) for e in (t, b, n)]
    return np.stack([np.concatenate(row, axis=1) for row in rows], axis=1)


def _measured(setup: Setup, vectors: Array, n: Array) -> Array:
    """(N, K, K): coordinates (columns of the result: of each vector) of displacements (N, K, 9)."""
    t, b = _frame(n)
    dx, dv, dw = vectors[..., :3], vectors[..., 3:6], vectors[..., 6:]
    size = np.sqrt(setup.ball.kappa) * setup.ball.radius

    def on(d: Array, e: Array) -> Array:
        found: Array = np.einsum("nkj,nj->nk", d, e)
        return found

    if setup.planar:
        rows = [on(dx, t), on(dv, t), on(dv, n), size * dw[..., 2]]
    else:
        rows = [on(dx, t), on(dx, b), *(on(dv, e) for e in (t, b, n)), *(size * on(dw, e) for e in (t, b, n))]
    return np.stack(rows, axis=1)


def _first(setup: Setup, start: Any) -> tuple[Array, tuple[int, ...], Array]:
    """The states (N, 9) just after the first bounce, the shape, the normals there."""
    if setup.law not in ("no-slip", "mirror", "contact", "rolling"):
        raise CaromError(
            f"lyapunov: law: expected one whose derivative carom knows (no-slip, mirror, contact, rolling), got {setup.law}"
        )
    begin = follow(setup, start, 1)
    if (np.asarray(begin.count) != 1).any():
        raise CaromError("lyapunov: start: expected orbits that meet the wall at least once, got one that does not")
    states = begin.last.reshape(-1, 10)[:, 1:].copy()
    normals = setup.shape.normals(begin.piece[..., 0].reshape(-1), states[:, :3] if not setup.planar else states[:, :2])
    states[:, :3] = setup.shape.folded(states[:, :3])
    return states, np.shape(begin.count), normals


def tangent_map(
    table: Table,
    start: Any,
    bounces: int = 1,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
) -> TangentMap:
    """The exact derivative of so many bounces, counted from the first one that the start comes to.

    Flight and impact in closed form, no finite differences. Arguments as :func:`carom.orbits.orbit`.
    """
    setup = setup_of(table, ball, law, surface, "end")
    bounces = whole("bounces", bounces)
    states, shape, n = _first(setup, start)
    vectors = _axes(setup, n, states[:, 3:6])
    k = vectors.shape[1]
    last, ends = np.empty((len(states), 10)), np.zeros((len(states), 3), np.int64)
    sums = np.zeros((len(states), k))
    compiled_tangent()(setup.world, setup.pieces, states, bounces, vectors, sums, 0, last, ends)
    if (ends[:, 0] != DONE).any():
        raise CaromError(
            f"tangent_map: start: expected {bounces} bounces more, got an orbit that {ENDS[int(ends[:, 0].max())]}"
        )
    after = setup.shape.normals(ends[:, 2], last[:, 1 : 1 + table.dimension])
    across = np.stack([(states[:, 3:6] * n).sum(1), (last[:, 4:7] * after).sum(1)], axis=1)
    gap = np.abs(setup.shape.folded(last[:, 1:4] - states[:, :3])).max(1) + np.abs(last[:, 4:] - states[:, 3:]).max(1)
    matrix = _measured(setup, vectors, after)
    names = PLANAR if setup.planar else SPATIAL
    return TangentMap(matrix.reshape(*shape, k, k), names, across.reshape(*shape, 2), gap.reshape(shape))


def lyapunov(
    table: Table,
    start: Any,
    bounces: int = 10_000,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
    blocks: int = 20,
) -> Lyapunov:
    """The Lyapunov spectrum: how fast neighbours of an orbit part, from the exact tangent map, made orthogonal every bounce.

    In the plane four exponents (two coordinates of the boundary map, the spin, the energy), in space eight. One is always
    zero, for the energy scales all; with a law that keeps the measure their sum is zero. Arguments as
    :func:`carom.orbits.orbit`; ``blocks`` parts of the run give the error. Many starts run on all cores.
    """
    setup = setup_of(table, ball, law, surface, "end")
    bounces, blocks = whole("bounces", bounces, 2), whole("blocks", blocks, 2)
    blocks = min(blocks, bounces)
    states, shape, n = _first(setup, start)
    vectors = _axes(setup, n, states[:, 3:6])
    # any basis will do: turned at random, none of them is special
    rng = np.random.default_rng(1)
    k = vectors.shape[1]
    vectors = np.einsum("ij,njc->nic", np.linalg.qr(rng.normal(size=(k, k)))[0], vectors)
    last, ends = np.empty((len(states), 10)), np.zeros((len(states), 3), np.int64)
    sums, time = np.zeros((len(states), k)), np.zeros(len(states))
    parts, history, done, bad = [], [], 0, np.zeros(len(states), np.int64)
    for block in range(blocks):
        share = bounces * (block + 1) // blocks - done
        before = sums.copy()
        compiled_tangent()(setup.world, setup.pieces, states, share, vectors, sums, 1, last, ends)
        bad = np.where(bad != 0, bad, ends[:, 0])
        states = np.where((bad == DONE)[:, None], last[:, 1:], states)
        time += last[:, 0]
        done += share
        parts.append((sums - before) / share)
        history.append(sums / done)
    found = np.where((bad == DONE)[:, None], sums / bounces, np.nan)
    order = np.argsort(-found, axis=1)
    found = np.take_along_axis(found, order, 1)
    scatter = np.std(parts, axis=0, ddof=1) / np.sqrt(blocks)
    error = np.take_along_axis(scatter, order, 1)
    run = np.stack([np.take_along_axis(one, order, 1) for one in history])
    return Lyapunov(
        found.reshape(*shape, k), (found * (bounces / time)[:, None]).reshape(*shape, k), error.reshape(*shape, k),
        run.reshape(blocks, *shape, k), bounces, np.array(ENDS)[bad].reshape(shape),
    )  # fmt: skip
