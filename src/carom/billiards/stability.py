"""Stability of orbits: the exact derivative of a number of bounces, multipliers of periodic orbits, Lyapunov spectrum."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.intersections import (
    ARC,
    BILLIARD,
    BODY,
    DONE,
    ENDING,
    ENDS,
    GRAZED,
    PIECES,
    POSITION,
    TIME,
    VELOCITY,
    wall_normal,
)
from carom.billiards.loop import after_flight, after_impact, duration, fly_to_wall
from carom.billiards.orbits import FIRST_BOUNCES, orbit_from_setup
from carom.billiards.setup import OrbitSetup, orbit_setup
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.core.geometry.curve import curve_wall
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.dual import LANES, dual_records, register_records, value_of, with_value
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, only_slopes, prange, vector
from carom.core.jit.threads import Pace
from carom.errors import CaromError, Fault, require_count
from carom.laws.callbacks import dual_law_address, register_duals
from carom.laws.law import CALLED_WALL


@hot_kernel
def curvature_at(world: Any, pieces: Any, panels: Any, i: int, x: Vec) -> float:
    """Return the curvature k of the centre's curve: the normal turns by -k times the displacement along the wall."""
    if i < world.windows:
        return 0.0
    found: float = 1.0 / pieces[i].radius if pieces[i].radius > 0.0 else 0.0
    if world.inside <= i < world.outside:
        found = -found
    elif world.outside <= i < world.ellipses:
        p = pieces[i]
        a, b = p.half_axes[0], p.half_axes[1]
        nx, ny = x[0] / (a * a), x[1] / (b * b)
        size = math.sqrt(nx * nx + ny * ny)
        found = 1.0 / ((a * b) * (a * b) * (size * size * size))
    elif world.ellipses <= i < world.curves:
        p = pieces[i]
        kappa = curve_wall(panels, p.first, p.last, world.inset, p.n[0], p.n[1], x[0], x[1])[2]
        found = kappa / (1.0 - world.inset * kappa)
    return found


@kernel
def _slopes_of(x: Any) -> Any:
    """Return three dual numbers of the value zero."""
    return (only_slopes(x[0]), only_slopes(x[1]), only_slopes(x[2]))


@kernel
def _with_values(x: Any, values: Vec) -> Any:
    """Return three dual numbers with other values."""
    return (with_value(x[0], values[0]), with_value(x[1], values[1]), with_value(x[2], values[2]))


@kernel
def _after_bounce(
    world: Any, body: Any, x: Vec, v: Vec, n: Vec, k: float, sphere: bool, along: float
) -> tuple[Vec, Vec]:
    """Bring a ball with its displacements from just after one bounce to just after the next; return velocity and spin there.

    It comes to x with the velocity v, ``along`` on its flight; n and k are the wall's normal and curvature; ``sphere``: it is
    curved in z as well.
    """
    # the neighbour's place and velocity at the same time, and how much later it meets the wall
    p, dv = after_flight(world, (body.x[0], body.x[1], body.x[2]), (body.v[0], body.v[1], body.v[2]), along)
    p, u, g = _slopes_of(p), _with_values(dv, v), vector(world.acceleration)
    if world.flight == ARC:
        g = (-world.magnetic_field * v[1], world.magnetic_field * v[0], 0.0)
    late = -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / dot(n, v)
    p = (p[0] + v[0] * late, p[1] + v[1] * late, p[2] + v[2] * late)
    u = (u[0] + g[0] * late, u[1] + g[1] * late, u[2] + g[2] * late)
    m = (n[0] - k * p[0], n[1] - k * p[1], n[2] - (k * p[2] if sphere else 0.0 * p[2]))
    v1, w1 = after_impact(world, world.law, world.a, world.kappa, u, (body.w[0], body.w[1], body.w[2]), m)
    p = _with_values(p, x)
    for j in range(3):
        body.x[j], body.v[j], body.w[j] = p[j], v1[j], w1[j]
    return (value_of(v1[0]), value_of(v1[1]), value_of(v1[2])), (value_of(w1[0]), value_of(w1[1]), value_of(w1[2]))


def iterate_tangents(
    world: Any, pieces: Any, panels: Any, bodies: Any, slopes: Any, row: int, bounces: int, sums: Any, every: int, last: Any
) -> tuple[int, int, int]:  # fmt: skip
    """Follow a ball from just after a bounce, and its displacements; return why it ended, the bounces made, the last piece.

    ``bodies`` (N,) of BODY and ``slopes`` (1, N, 9, LANES): of row number ``row`` the ball, and its displacements of position,
    velocity and spin, both overwritten by their images. With ``every`` > 0 the displacements are orthonormalised after every so
    many bounces (Gram-Schmidt, twice) and the logarithms of their lengths are added to ``sums`` (K); the first keeps its direction.
    ``last`` (10): time, position, velocity and spin at the end; the time is added to.
    """
    t, k, met, ended = last[0], 0, -1, DONE
    body = dual_records(bodies, slopes, 0)[row]
    one = bodies[row]
    x, v, w = vector(one.x), vector(one.v), vector(one.w)
    while k < bounces:
        ended, i, x, v, _t, along, _ax, _ay = fly_to_wall(world, pieces, panels, x, v, 0.0, 0.0, 0.0)
        if ended != DONE:
            break
        n, bend = wall_normal(world, pieces, panels, i, x), curvature_at(world, pieces, panels, i, x)
        v, w = _after_bounce(world, body, x, v, n, bend, i >= world.curves, along)
        if not dot(v, n) > 0.0:
            ended = GRAZED
            break
        t += duration(world, along)
        met = i
        k += 1
        if every > 0 and k % every == 0:
            orthonormalise(slopes, row, sums)
    last[0] = t
    for j in range(3):
        last[1 + j], last[4 + j], last[7 + j] = x[j], v[j], w[j]
    return ended, k, met


@kernel
def orthonormalise(slopes: Any, row: int, sums: Any) -> None:
    """Orthonormalise by Gram-Schmidt, each vector twice against those before it; add the logarithms of the lengths to sums."""
    for m in range(len(sums)):
        for _ in range(2):
            for j in range(m):
                d = 0.0
                for c in range(9):
                    d += slopes[0, row, c, j] * slopes[0, row, c, m]
                for c in range(9):
                    slopes[0, row, c, m] -= d * slopes[0, row, c, j]
        size = 0.0
        for c in range(9):
            size += slopes[0, row, c, m] * slopes[0, row, c, m]
        size = math.sqrt(size)
        sums[m] += math.log(size)
        for c in range(9):
            slopes[0, row, c, m] /= size


_iterate_tangents: Any = iterate_tangents


def iterate_tangents_many(
    worlds: Any, pieces: Any, panels: Any, bodies: Any, slopes: Any, bounces: int, sums: Any, every: int, last: Any, ends: Any
) -> None:  # fmt: skip
    """Apply :func:`iterate_tangents` to every row that goes on; ``sums`` (N, K)."""
    for m in prange(len(bodies)):
        if ends[m].reason != DONE:
            continue
        ended, count, met = _iterate_tangents(
            worlds[0], pieces, panels, bodies, slopes, m, bounces, sums[m], every, last[m]
        )
        ends[m].reason, ends[m].bounces, ends[m].piece = ended, count, met


def register_tangents() -> None:
    """Tell the compiler what the loop calls."""
    register_duals()
    register_records()


@functools.cache
def compiled_tangent_loop() -> Any:
    """Compile :func:`iterate_tangents_many`, or load it from the cache."""
    global _iterate_tangents  # noqa: PLW0603
    needs = (register_tangents,)
    pieces, row, table, bodies, slopes = (
        array_of(PIECES), array_of(float), array_of(float, 2), array_of(BODY), array_of(float, 4)
    )  # fmt: skip
    one = signature((int, int, int), BILLIARD, pieces, table, bodies, slopes, int, int, row, int, row)
    _iterate_tangents = njit(iterate_tangents, one, needs, _nrt=False)
    many = signature(None, array_of(BILLIARD), pieces, table, bodies, slopes, int, table, int, table, array_of(ENDING))
    return njit(iterate_tangents_many, many, needs, parallel=True)


# ----------------------------------------------------------------------------------------------------
# Stability of orbits: the exact derivative of a number of bounces, multipliers of periodic orbits, Lyapunov spectrum.


Array = NDArray[np.float64]
FEW_ORBITS = 8
PLANAR = ("s", "v_t", "v_n", "spin")
SPATIAL = ("s", "b", "v_t", "v_b", "v_n", "spin_t", "spin_b", "spin_n")


@dataclass(frozen=True, eq=False)
class TangentMap:
    """The derivative of a number of bounces, from just after one bounce to just after another.

    Coordinates refer to the frame (t, b, n) of the wall at each end: t along it, n towards the ball, b = n x t in space. Spins
    are multiplied by sqrt(kappa) a, so that all velocities contribute equally to the energy.

    Examples
    --------
    >>> import numpy as np
    >>> from carom import billiards
    >>> found = billiards.tangent_map(billiards.circle(), ((0.0, 0.0), (1.0, 0.0), 0.0), bounces=2, law="mirror")
    >>> found.coordinates, bool(found.gap < 1e-12)
    (('s', 'v_t', 'v_n', 'spin'), True)
    >>> np.allclose(np.abs(found.eigenvalues), 1.0)  # the diameter of a circle is neutral
    True
    """

    matrix: Array
    """(..., 4, 4), in space (..., 8, 8): element [i, j] is the derivative of coordinate i after by coordinate j before."""
    coordinates: tuple[str, ...]
    """Names of rows and columns: "s", "v_t", "v_n", "spin"; in space "s", "b", "v_t", ..., "spin_n"."""
    across: Array
    """(..., 2): velocity away from the wall before and after; |det(matrix)| is their ratio where the measure is invariant."""
    gap: Array
    """(...): distance of the final state from the initial one (positions plus velocities): 0 for a periodic orbit."""

    @property
    def eigenvalues(self) -> Array:
        """(..., 4) or (..., 8), complex: the multipliers of a periodic orbit, one of which is always 1 (the energy)."""
        return np.linalg.eigvals(self.matrix)  # type: ignore[return-value]


@dataclass(frozen=True, eq=False, repr=False)
class Lyapunov:
    """A Lyapunov spectrum, in descending order.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.lyapunov(billiards.sinai(), ((0.4, 0.4), (0.8, 0.3), 0.5), bounces=500, law="mirror")
    >>> found.per_bounce.shape, found.history.shape
    ((4,), (20, 4))
    """

    per_bounce: Array
    """(..., 4), in space (..., 8): exponents per bounce."""
    per_time: Array
    """The same per unit time: divided by the mean time between bounces, 1/s."""
    error: Array
    """Error of ``per_bounce``: its scatter between the blocks of the run, or its change since half of the run if that is more.

    The change bounds the bias of a finite run: of a regular orbit the exponents fall to 0 as log(n)/n."""
    history: Array
    """(blocks, ..., 4): ``per_bounce`` up to the end of each block."""
    bounces: int
    """Number of bounces."""
    ended: str | NDArray[np.str_]
    """(...): as :attr:`Orbit.ended`; other than "bounces", the exponents are NaN."""

    def __repr__(self) -> str:
        """Return one line: the largest exponent, or the range of those of several orbits."""
        largest, error = np.ravel(self.per_bounce[..., 0]), np.ravel(self.error[..., 0])
        known = largest[np.isfinite(largest)]
        said = (
            f"largest {largest[0]:.4g} ± {error[0]:.2g} a bounce" if len(largest) == 1 else f"{len(largest):,} orbits"
        )
        if len(largest) > 1 and len(known):
            said += f", largest {known.min():.4g} to {known.max():.4g} a bounce"
        return f"<Lyapunov: {said}; {self.bounces:,} bounces>"


def _frame(n: Array) -> tuple[Array, Array]:
    """Return unit vectors t, b (N, 3) along walls with normals n (N, 3)."""
    t = np.stack([n[:, 1], -n[:, 0], np.zeros(len(n))], axis=1)
    flat = np.linalg.norm(t[:, :2], axis=1) < 1e-9
    t[flat] = [1.0, 0.0, 0.0]
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    return t, np.cross(n, t)


def _displacements(setup: OrbitSetup, n: Array, v: Array) -> Array:
    """Return the displacements (N, K, 9) along the K coordinates, at walls with normals n."""
    t, b = _frame(n)
    ball = setup.ball
    size = np.sqrt(ball.kappa) * ball.radius
    zero = np.zeros_like(n)
    up = np.broadcast_to([0.0, 0.0, 1.0], n.shape)

    def follows(dv: Array) -> Array:
        """Return the change of spin of a rolling ball, whose velocity determines it: (18)."""
        return np.cross(up, dv) / ball.radius if setup.rolls else zero

    if setup.planar:
        rows = [(t, zero, zero), (zero, t, follows(t)), (zero, n, follows(n)), (zero, zero, up / size)]
    else:
        rows = [(t, zero, zero), (b, zero, zero)] + [(zero, e, zero) for e in (t, b, n)]
        rows += [(zero, zero, e / size) for e in (t, b, n)]
    return np.stack([np.concatenate(row, axis=1) for row in rows], axis=1)


def end_coordinates(setup: OrbitSetup, vectors: Array, n: Array) -> Array:
    """Return the coordinates (N, K, K) of displacements (N, K, 9): a column for each displacement."""
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


def _after_first_bounce(setup: OrbitSetup, start: Any) -> tuple[Array, tuple[int, ...], Array]:
    """Return the states (N, 9) just after the first bounce, the shape of the starts, the normals there."""
    begin = orbit_from_setup(setup, start, 1)
    if (np.asarray(begin.count) != 1).any():
        raise CaromError(Fault("lyapunov", "start", "orbits with at least one bounce", "one without"))
    states = begin.last.reshape(-1, 10)[:, 1:].copy()
    normals = setup.shape.normals(begin.piece[..., 0].reshape(-1), states[:, :3] if not setup.planar else states[:, :2])
    states[:, :3] = setup.shape.folded(states[:, :3])
    return states, np.shape(begin.count), normals


def _advance(
    setup: OrbitSetup, states: Array, bounces: int, vectors: Array, sums: Array, every: int, last: Array,
    ends: NDArray[np.void],
) -> None:  # fmt: skip
    """Follow displacements (N, K, 9) of states (N, 9), in slices, each from where the one before has ended (``every``: 0 or 1)."""
    loop, pace, done = compiled_tangent_loop(), Pace(FIRST_BOUNCES), 0
    world, bodies, slopes = setup.world, np.zeros(len(states), BODY), np.zeros((1, len(states), 9, LANES))
    bodies["x"], bodies["v"], bodies["w"] = states[:, :3], states[:, 3:6], states[:, 6:]
    slopes[0, :, :, : vectors.shape[1]] = vectors.transpose(0, 2, 1)
    if setup.response == CALLED_WALL:
        world = world.copy()
        world["user"] = dual_law_address(setup.kernel)
    if len(states) < FEW_ORBITS:  # (to wake threads takes longer than to follow a few)
        loop, ends = iterate_tangents_many, ends.view(np.recarray)
    last[:, TIME] = 0.0
    while done < bounces and (ends["reason"] == DONE).any():
        share = min(max(pace.begin() // len(states), 1), bounces - done)
        loop(world, setup.pieces, setup.panels, bodies, slopes, share, sums, every, last, ends)
        pace.done(share * len(states))
        done += share
    vectors[:] = slopes[0, :, :, : vectors.shape[1]].transpose(0, 2, 1)


def tangents_of_bounces(
    setup: OrbitSetup, states: Array, n: Array, bounces: int
) -> tuple[Array, Array, NDArray[np.void], Array]:
    """Follow the displacements along all coordinates through a number of bounces, from states (N, 9) just after one at normals n.

    Return the displacements (N, K, 9) after the last bounce, the states there (N, 10), why each ended, and the normals (N, 3).
    """
    vectors = _displacements(setup, n, states[:, 3:6])
    last, ends = np.empty((len(states), 10)), np.zeros(len(states), ENDING)
    _advance(setup, states, bounces, vectors, np.zeros(vectors.shape[:2]), 0, last, ends)
    return vectors, last, ends, setup.shape.normals(ends["piece"], last[:, 1 : 1 + setup.table.dimension])


def tangent_map(
    table: Table,
    start: Any,
    bounces: int = 1,
    *,
    ball: Ball | None = None,
    law: Any = "no-slip",
    surface: Surface | None = None,
) -> TangentMap:
    """Compute the exact derivative of a number of bounces, counted from the first bounce of the orbit.

    The flight is differentiated in closed form, the law's kernel by dual numbers: a custom law as well.

    Parameters
    ----------
    table, start, ball, law, surface
        As for :func:`orbit`.
    bounces : int
        Number of bounces.

    Returns
    -------
    TangentMap
        The matrix in the frames of the two walls.

    Raises
    ------
    CaromError
        An orbit that ends before.

    Examples
    --------
    The bouncing-ball orbit of a stadium is parabolic: its multipliers are 1 (in the plane, mirror law).

    >>> import numpy as np
    >>> from carom import billiards
    >>> found = billiards.tangent_map(billiards.stadium(), ((0.1, 0.0), (0.0, 1.0), 0.0), bounces=2, law="mirror")
    >>> np.round(found.matrix[:2, :2], 12)
    array([[1., 4.],
           [0., 1.]])
    """
    setup = orbit_setup(table, ball, law, surface, "end")
    bounces = require_count("orbit", "bounces", bounces)
    states, shape, n = _after_first_bounce(setup, start)
    vectors, last, ends, after = tangents_of_bounces(setup, states, n, bounces)
    k = vectors.shape[1]
    if (ends["reason"] != DONE).any():
        raise CaromError(
            Fault(
                "tangent_map",
                "start",
                f"{bounces} more bounces",
                f"an orbit that ended: {ENDS[int(ends['reason'].max())]}",
            )
        )
    across = np.stack([(states[:, 3:6] * n).sum(1), (last[:, VELOCITY] * after).sum(1)], axis=1)
    gap = np.abs(setup.shape.folded(last[:, POSITION] - states[:, :3])).max(1) + np.abs(
        last[:, 4:] - states[:, 3:]
    ).max(1)
    matrix = end_coordinates(setup, vectors, after)
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
    """Compute the Lyapunov spectrum from the exact tangent map, orthonormalised after every bounce (Benettin et al. 1980).

    There are four exponents in the plane (two coordinates of the boundary map, the spin, the energy), eight in space. One is
    always zero, because the equations are invariant under scaling of the energy; where the measure is invariant their sum is
    zero. Other arguments as for :func:`orbit`; many starts run on all cores.

    Parameters
    ----------
    bounces : int
        Number of bounces, after the first.
    blocks : int
        The run is divided into this many parts, whose scatter gives the standard error, or its change since half of the run.

    Returns
    -------
    Lyapunov
        Exponents per bounce and per unit time, with standard errors.

    Examples
    --------
    >>> from carom import billiards
    >>> found = billiards.lyapunov(billiards.sinai(), ((0.4, 0.4), (0.8, 0.3), 0.5), bounces=500, law="mirror")
    >>> bool(found.per_bounce[0] > 0.3), bool(abs(found.per_bounce.sum()) < 0.01)
    (True, True)
    """
    return spectrum_of(orbit_setup(table, ball, law, surface, "end"), start, bounces, blocks)


def spectrum_of(setup: OrbitSetup, start: Any, bounces: int, blocks: int = 20) -> Lyapunov:
    """Return the Lyapunov spectrum of a table, a ball and a law that are set up; orbits end at corners."""
    if not setup.world[0]["corners"]:
        setup = replace(setup, world=setup.world.copy())
        setup.world["corners"] = True
    bounces, blocks = require_count("orbit", "bounces", bounces, 2), require_count("orbit", "blocks", blocks, 2)
    blocks = min(blocks, bounces)
    states, shape, n = _after_first_bounce(setup, start)
    vectors = _displacements(setup, n, states[:, 3:6])
    # a random basis: no direction is special
    rng = np.random.default_rng(1)
    k = vectors.shape[1]
    vectors = np.einsum("ij,njc->nic", np.linalg.qr(rng.normal(size=(k, k)))[0], vectors)
    last, ends = np.empty((len(states), 10)), np.zeros(len(states), ENDING)
    sums, time = np.zeros((len(states), k)), np.zeros(len(states))
    parts, history, done, bad = [], [], 0, np.zeros(len(states), np.int64)
    for block in range(blocks):
        share = bounces * (block + 1) // blocks - done
        before = sums.copy()
        ends = np.zeros(len(states), ENDING)
        _advance(setup, states, share, vectors, sums, 1, last, ends)
        bad = np.where(bad != 0, bad, ends["reason"])
        states = np.where((bad == DONE)[:, None], last[:, 1:], states)
        time += last[:, TIME]
        done += share
        parts.append((sums - before) / share)
        history.append(sums / done)
    found = np.where((bad == DONE)[:, None], sums / bounces, np.nan)
    order = np.argsort(-found, axis=1)
    found = np.take_along_axis(found, order, 1)
    scatter = np.std(parts, axis=0, ddof=1) / np.sqrt(blocks)
    scatter = np.maximum(scatter, np.abs(history[-1] - history[blocks // 2 - 1]))
    error = np.take_along_axis(scatter, order, 1)
    run = np.stack([np.take_along_axis(one, order, 1) for one in history])
    return Lyapunov(
        found.reshape(*shape, k), (found * (bounces / time)[:, None]).reshape(*shape, k), error.reshape(*shape, k),
        run.reshape(blocks, *shape, k), bounces, np.array(ENDS)[bad].reshape(shape),
    )  # fmt: skip
