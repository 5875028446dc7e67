"""The exact tangent map of flight and impact, and the sums of logarithms from which the Lyapunov spectrum follows.

A neighbouring ball, displaced by (dx, dv, dw) just after one bounce, meets the same wall slightly later or earlier. Its
displacement just after the next bounce is a linear function of (dx, dv, dw). dx is measured from bounce to bounce, so it lies along
the wall. Every line is the derivative of a line of the flight or of the law; no finite differences are used.
"""

from __future__ import annotations

import functools
import math
from typing import Any

from carom.billiards.circling import FULL_CIRCLE, arcs_joined, displaced_on_arc
from carom.billiards.elliptic_boundary import arc_wall
from carom.billiards.intersections import next_hit, wall_normal
from carom.billiards.loop import after_flight, after_impact, at_corner, duration
from carom.billiards.table_records import ARC, CORNER, DONE, ENDING, ESCAPED, FREE, GRAZED, PIECES, WORLD
from carom.core.contact import LEAST, slip_velocity
from carom.core.geometry.curve import curve_wall
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel, prange
from carom.laws.callbacks import register_calls
from carom.laws.law import ROLLING_WALL

__all__ = ["compiled_tangent_loop", "follow_tangents", "follow_tangents_many", "tangent_step"]


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
