"""Stability of orbits: the exact derivative of a number of bounces, multipliers of periodic orbits, Lyapunov spectrum."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import arc_wall
from carom.billiards.intersections import FULL_CIRCLE, arcs_joined, displaced_on_arc, next_hit, wall_normal
from carom.billiards.loop import after_flight, after_impact, at_corner, duration
from carom.billiards.orbits import FIRST_BOUNCES, orbit_from_setup, require_integer
from carom.billiards.setup import OrbitSetup, orbit_setup
from carom.billiards.table_records import (
    ARC,
    CORNER,
    DONE,
    ENDING,
    ENDS,
    ESCAPED,
    FREE,
    GRAZED,
    PIECES,
    POSITION,
    TIME,
    VELOCITY,
    WORLD,
)
from carom.billiards.tables import Table
from carom.bodies import Ball, Surface
from carom.core.contact import LEAST, slip_velocity
from carom.core.geometry.curve import curve_wall
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel, prange
from carom.core.jit.threads import Pace
from carom.errors import CaromError, Fault
from carom.laws.callbacks import register_calls
from carom.laws.law import CALLED_WALL, ROLLING_WALL


@hot_kernel
def curvature_at(world: Any, pieces: Any, panels: Any, i: int, x: Vec) -> float:
    """Return the curvature k of the centre's curve: the normal turns by -k times the displacement along the wall."""
    found: float = 1.0 / pieces[i].r
    if i < world.windows:
        found = 0.0
    elif world.inside <= i < world.outside:
        found = -found
    elif world.outside <= i < world.ellipses:
        found = 1.0 / arc_wall(pieces[i], world.inset, x[0], x[1])[1]
    elif world.ellipses <= i < world.curves:
        p = pieces[i]
        kappa = curve_wall(panels, int(p.c), int(p.r), world.inset, p.n[0], p.n[1], x[0], x[1])[2]
        found = kappa / (1.0 - world.inset * kappa)
    return found


@kernel
def contact_derivative(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, dv: Vec, dw: Vec, dn: Vec
) -> tuple[Vec, Vec]:
    """Return the derivative of :func:`carom.core.contact.wall_contact`: changes of velocity and spin after the impact."""
    un, ut = slip_velocity(v, w, n, a)
    slip = math.sqrt(dot(ut, ut))
    pn = -(1.0 + e) * un
    hold = (1.0 + beta) * (kappa / (1.0 + kappa))
    # derivative of slip_velocity
    dun = dot(dv, n) + dot(v, dn)
    p, q = cross(dw, n), cross(w, dn)
    dut = (
        dv[0] - dun * n[0] - un * dn[0] - a * (p[0] + q[0]),
        dv[1] - dun * n[1] - un * dn[1] - a * (p[1] + q[1]),
        dv[2] - dun * n[2] - un * dn[2] - a * (p[2] + q[2]),
    )
    dpn = -(1.0 + e) * dun
    c = -hold
    f = (c * ut[0], c * ut[1], c * ut[2])
    df = (c * dut[0], c * dut[1], c * dut[2])
    if hold * slip > mu * pn and pn > LEAST * slip:
        # sliding: f = -mu pn ut/|ut|
        c = -mu * pn / slip
        f = (c * ut[0], c * ut[1], c * ut[2])
        dc = -mu * dpn / slip - c * dot(ut, dut) / (slip * slip)
        df = (c * dut[0] + dc * ut[0], c * dut[1] + dc * ut[1], c * dut[2] + dc * ut[2])
    # dv = pn n + f, dw = -n x f/(kappa a)
    p, q = cross(dn, f), cross(n, df)
    c = 1.0 / (kappa * a)
    return (
        (
            dv[0] + dpn * n[0] + pn * dn[0] + df[0],
            dv[1] + dpn * n[1] + pn * dn[1] + df[1],
            dv[2] + dpn * n[2] + pn * dn[2] + df[2],
        ),
        (dw[0] - (p[0] + q[0]) * c, dw[1] - (p[1] + q[1]) * c, dw[2] - (p[2] + q[2]) * c),
    )


@kernel
def rolling_derivative(v: Vec, w: Vec, n: Vec, a: float, kappa: float, dv: Vec, dw: Vec, dn: Vec) -> tuple[Vec, Vec]:
    """Return the derivative of :func:`carom.laws.conventional.conventional_reflection`."""
    k = 1.0 / (1.0 + 2.0 * kappa)
    x, y = v[0] * n[0] + v[1] * n[1], v[1] * n[0] - v[0] * n[1]
    dx = dv[0] * n[0] + dv[1] * n[1] + v[0] * dn[0] + v[1] * dn[1]
    dy = dv[1] * n[0] - dv[0] * n[1] + v[1] * dn[0] - v[0] * dn[1]
    # (22)
    y1, dy1 = (y + 2.0 * kappa * a * w[2]) * k, (dy + 2.0 * kappa * a * dw[2]) * k
    dz = (2.0 * (1.0 + kappa) * dy / a - dw[2]) * k
    du = -dx * n[0] - x * dn[0] - dy1 * n[1] - y1 * dn[1]
    dq = -dx * n[1] - x * dn[1] + dy1 * n[0] + y1 * dn[0]
    # (18): the horizontal spin follows from the velocity
    return (du, dq, 0.0), (-dq / a, du / a, dz)


@kernel
def tangent_step(
    world: Any, n: Vec, k: float, sphere: bool, t: float, v: Vec, w: Vec, dx: Vec, dv: Vec, dw: Vec
) -> tuple[Vec, Vec, Vec]:
    """Propagate a displacement from just after one bounce to just after the next: a flight up to t later, with v, w just before it.

    n and k are the wall's normal and curvature; ``sphere``: it is curved in z as well.
    """
    g0, g1, g2 = world.acceleration[0], world.acceleration[1], world.acceleration[2]
    # position of the neighbour at the same time, and how much later it meets the wall
    if world.flight == ARC:
        p, dv = displaced_on_arc(world.magnetic_field, dx, dv, t)
        g0, g1, g2 = -world.magnetic_field * v[1], world.magnetic_field * v[0], 0.0
    else:
        p = (dx[0] + t * dv[0], dx[1] + t * dv[1], dx[2] + t * dv[2])
    late = -dot(n, p) / dot(n, v)
    dx = (p[0] + v[0] * late, p[1] + v[1] * late, p[2] + v[2] * late)
    dv = (dv[0] + g0 * late, dv[1] + g1 * late, dv[2] + g2 * late)
    dn = (-k * dx[0], -k * dx[1], -k * dx[2] if sphere else 0.0)
    if world.law == ROLLING_WALL:
        dv, dw = rolling_derivative(v, w, n, world.a, world.kappa, dv, dw, dn)
    else:
        dv, dw = contact_derivative(v, w, n, world.a, world.kappa, world.e, world.mu, world.beta, dv, dw, dn)
    return dx, dv, dw


def follow_tangents(
    world: Any,
    pieces: Any,
    panels: Any,
    x: Vec,
    v: Vec,
    w: Vec,
    bounces: int,
    vectors: Any,
    sums: Any,
    every: int,
    last: Any,
) -> tuple[int, int, int]:
    """Follow a ball from just after a bounce, and its displacements; return why it ended, the bounces made, the last piece.

    ``vectors`` (K, 9): displacements of position, velocity and spin, overwritten by their images. With ``every`` > 0 they are
    orthonormalised after every so many bounces (Gram-Schmidt, twice) and the logarithms of their lengths are added to ``sums``
    (K); the first vector keeps its direction. ``last`` (10): time, position, velocity and spin at the end; the time is added to.
    """
    t = last[0]
    k = 0
    met = -1
    ended = DONE
    while k < bounces:
        # a flight through windows of the periodic cell is one flight
        flight = 0.0
        i = -1
        u = v
        while True:
            dt, i = next_hit(world, pieces, panels, x, u)
            if i < 0 or not dt < math.inf:
                ended = FREE if world.flight == ARC else ESCAPED
                break
            x, u = after_flight(world, x, u, dt)
            flight = arcs_joined(flight, dt) if world.flight == ARC else flight + dt
            if i < world.faces or i >= world.windows:
                break
            p = pieces[i]
            x = (x[0] + p.r * p.n[0], x[1] + p.r * p.n[1], x[2])
            if world.flight == ARC and flight > FULL_CIRCLE:
                ended = FREE
                break
        if ended != DONE:
            break
        if (i < world.faces or world.arc_corners != 0) and world.corners and at_corner(world, pieces, panels, i, x):
            ended = CORNER
            break
        n = wall_normal(world, pieces, panels, i, x)
        b = curvature_at(world, pieces, panels, i, x)
        for m in range(len(vectors)):
            q = vectors[m]
            dx, dv, dw = tangent_step(
                world, n, b, i >= world.curves, flight, u, w,
                (q[0], q[1], q[2]), (q[3], q[4], q[5]), (q[6], q[7], q[8]),
            )  # fmt: skip
            for j in range(3):
                q[j], q[3 + j], q[6 + j] = dx[j], dv[j], dw[j]
        v, w = after_impact(world, world.law, world.a, world.kappa, u, w, n)
        if not dot(v, n) > 0.0:
            ended = GRAZED
            break
        t += duration(world, flight)
        met = i
        k += 1
        if every > 0 and k % every == 0:
            orthonormalise(vectors, sums)
    last[0] = t
    for j in range(3):
        last[1 + j], last[4 + j], last[7 + j] = x[j], v[j], w[j]
    return ended, k, met


@kernel
def orthonormalise(vectors: Any, sums: Any) -> None:
    """Orthonormalise by Gram-Schmidt, each vector twice against those before it; add the logarithms of the lengths to sums."""
    for m in range(len(vectors)):
        q = vectors[m]
        for _ in range(2):
            for j in range(m):
                p = vectors[j]
                d = 0.0
                for c in range(9):
                    d += p[c] * q[c]
                for c in range(9):
                    q[c] -= d * p[c]
        size = 0.0
        for c in range(9):
            size += q[c] * q[c]
        size = math.sqrt(size)
        sums[m] += math.log(size)
        for c in range(9):
            q[c] /= size


_follow_tangents: Any = follow_tangents


def follow_tangents_many(
    worlds: Any,
    pieces: Any,
    panels: Any,
    starts: Any,
    bounces: int,
    vectors: Any,
    sums: Any,
    every: int,
    last: Any,
    ends: Any,
) -> None:
    """Apply :func:`follow_tangents` to every row of ``starts`` (N, 9), ``vectors`` (N, K, 9), ``sums`` (N, K) that goes on."""
    for m in prange(len(starts)):
        if ends[m].reason != DONE:
            continue
        s = starts[m]
        ended, count, met = _follow_tangents(
            worlds[0], pieces, panels, (s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]), bounces,
            vectors[m], sums[m], every, last[m],
        )  # fmt: skip
        ends[m].reason, ends[m].bounces, ends[m].piece = ended, count, met


@functools.cache
def compiled_tangent_loop() -> Any:
    """Compile :func:`follow_tangents_many`, or load it from the cache."""
    global _follow_tangents  # noqa: PLW0603
    needs = (register_calls,)
    pieces, row, table, vec = array_of(PIECES), array_of(float), array_of(float, 2), (float, float, float)
    one = signature((int, int, int), WORLD, pieces, table, vec, vec, vec, int, table, row, int, row)
    _follow_tangents = njit(follow_tangents, one, needs, _nrt=False)
    many = signature(
        None, array_of(WORLD), pieces, table, table, int, array_of(float, 3), table, int, table, array_of(ENDING)
    )
    return njit(follow_tangents_many, many, needs, parallel=True)


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


@dataclass(frozen=True, eq=False)
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
    if setup.response == CALLED_WALL:
        raise CaromError(
            Fault("lyapunov", "law", "one with a known derivative (no-slip, mirror, contact, rolling)", f"{setup.law}")
        )
    begin = orbit_from_setup(setup, start, 1)
    if (np.asarray(begin.count) != 1).any():
        raise CaromError(Fault("lyapunov", "start", "orbits with at least one bounce", "one without"))
    states = begin.last.reshape(-1, 10)[:, 1:].copy()
    normals = setup.shape.normals(begin.piece[..., 0].reshape(-1), states[:, :3] if not setup.planar else states[:, :2])
    states[:, :3] = setup.shape.folded(states[:, :3])
    return states, np.shape(begin.count), normals


def _follow(
    setup: OrbitSetup,
    states: Array,
    bounces: int,
    vectors: Array,
    sums: Array,
    every: int,
    last: Array,
    ends: NDArray[np.void],
) -> None:
    """Run the compiled loop in slices, each from where the one before has ended (``every``: 0 or 1)."""
    loop, pace, done = compiled_tangent_loop(), Pace(FIRST_BOUNCES), 0
    if len(states) < FEW_ORBITS:  # (to wake threads takes longer than to follow a few)
        loop, ends = follow_tangents_many, ends.view(np.recarray)
    last[:, TIME] = 0.0
    while done < bounces and (ends["reason"] == DONE).any():
        share = min(max(pace.begin() // len(states), 1), bounces - done)
        loop(setup.world, setup.pieces, setup.panels, states, share, vectors, sums, every, last, ends)
        states = np.where((ends["reason"] == DONE)[:, None], last[:, 1:], states)
        pace.done(share * len(states))
        done += share


def tangents_of_bounces(
    setup: OrbitSetup, states: Array, n: Array, bounces: int
) -> tuple[Array, Array, NDArray[np.void], Array]:
    """Follow the displacements along all coordinates through a number of bounces, from states (N, 9) just after one at normals n.

    Return the displacements (N, K, 9) after the last bounce, the states there (N, 10), why each ended, and the normals (N, 3).
    """
    vectors = _displacements(setup, n, states[:, 3:6])
    last, ends = np.empty((len(states), 10)), np.zeros(len(states), ENDING)
    _follow(setup, states, bounces, vectors, np.zeros(vectors.shape[:2]), 0, last, ends)
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

    Flight and impact are differentiated in closed form.

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
        An orbit that ends before, a law without a known derivative.

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
    bounces = require_integer("bounces", bounces)
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
    setup = orbit_setup(table, ball, law, surface, "end")
    bounces, blocks = require_integer("bounces", bounces, 2), require_integer("blocks", blocks, 2)
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
        _follow(setup, states, share, vectors, sums, 1, last, ends)
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
