"""Exact means over time: of energies and momentum fluxes of each species, and of density and flow in layers of the container.

Nothing is sampled. Between events every ball moves along a parabola, so all that is averaged is a polynomial of time with jumps at
the events, and its integral follows from the jumps alone. With the jumps D_k of a quantity Q at the times t_k of a cycle that ends
at T,

    int_0^T Q dt = Q(T) T - sum D_k t_k - int_0^T t Q' dt,

by partial integration. Without a force Q' = 0 between events. Under gravity the momentum P of n balls of mass m has P' = n m g,
its flux F_ab = sum m v_a v_b has F_ab' = g_a P_b + g_b P_a, the potential energy H has H' = -g P; so sums of D_k t_k^2 (and of
D_k t_k^3 for layers, where n changes) suffice. The sums begin anew in every cycle of the calendar, at whose end Q(T) is
summed over all balls: so rounding does not accumulate.

In a gas that is sheared (:mod:`carom.gas.edmd.collisions`) the flux is of velocities relative to the flow. Along a flight these are
linear in time, so the flux is integrated flight by flight (:func:`note_flight`), and not from its jumps.

Layers are the layers of cells along one axis: a ball leaves one in an event, when it crosses the border of its cell. So the
fluxes of energy and momentum through the planes between layers are sums over events: over the balls that cross a plane, with
what they carry, and over the collisions of balls on either side of it, with what these pass on.
"""

from __future__ import annotations

from typing import Any

from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel
from carom.gas.edmd.calendar import I64, U64


@hot_kernel
def layer_of(axis: int, plan: Any) -> int:
    """Return the layer of a ball: its cell along an axis."""
    return I64(plan.cx if axis == 0 else (plan.cy if axis == 1 else plan.cz))  # type: ignore[no-any-return]


@hot_kernel
def _note_flux(flow: Any, j: Vec, s: Vec, spin: float, t: float) -> None:
    """Note the jump of the momentum flux, j s + s j, and of twice the energy of the spins."""
    x, y = j[0] * t, j[1] * t
    flow.xx += 2.0 * x * s[0]
    flow.yy += 2.0 * y * s[1]
    flow.xy += x * s[1] + y * s[0]
    flow.ww += spin * t
    if (j[2] != 0.0) | (s[2] != 0.0):  # (no disc)
        z = j[2] * t
        flow.zz += 2.0 * z * s[2]
        flow.xz += x * s[2] + z * s[0]
        flow.yz += y * s[2] + z * s[1]


@hot_kernel
def _note_momentum(flow: Any, j: Vec, t2: float) -> None:
    """Note an impulse for the integral of the momentum times time."""
    flow.x2 += j[0] * t2
    flow.y2 += j[1] * t2
    flow.z2 += j[2] * t2


@hot_kernel
def _note_layer(layer: Any, g: Vec, j: Vec, s: Vec, spin: float, t: float) -> None:
    """Note an impulse on a ball in a layer."""
    layer.px += j[0] * t
    layer.py += j[1] * t
    layer.pz += j[2] * t
    layer.p2 += dot(g, j) * (t * t)
    layer.vv += 2.0 * dot(j, s) * t
    layer.ww += spin * t


@hot_kernel
def _gravity(grid: Any) -> Vec:
    return (grid.gravity[U64(0)], grid.gravity[U64(1)], grid.gravity[U64(2)])


@hot_kernel
def _falls(g: Vec) -> bool:
    return (g[0] != 0.0) | (g[1] != 0.0) | (g[2] != 0.0)


@hot_kernel
def note_change(averages: Any, grid: Any, plan: Any, kind: int, j: Vec, s: Vec, spin: float, t: float) -> None:
    """Note an impulse j on a ball of a species.

    ``s`` is the mean of its velocities before and after; ``spin`` the change of twice the energy of its spin.
    """
    flow, layers, g = averages.flows[U64(kind)], averages.layers, _gravity(grid)
    _note_flux(flow, j, s, spin, t)
    if _falls(g):
        _note_momentum(flow, j, t * t)
    if layers.shape[0] > 0:
        row = layer_of(averages.whole[0].axis, plan) * averages.flows.shape[0] + kind
        _note_layer(layers[U64(row)], g, j, s, spin, t)


@hot_kernel
def note_pair(
    averages: Any, grid: Any, plan1: Any, plan2: Any, one: Any, two: Any, j: Vec, v1: Vec, v2: Vec, spin1: float, spin2: float,
    n: Vec, distance: float, t: float,
) -> None:  # fmt: skip
    """Note the impulse j on the first of two balls, which had v1 and v2, and its opposite on the second, at a distance along n."""
    whole, kind1, kind2 = averages.whole[0], I64(one.species), I64(two.species)
    s1 = ((v1[0] + one.vx) / 2.0, (v1[1] + one.vy) / 2.0, (v1[2] + one.vz) / 2.0)
    s2 = ((v2[0] + two.vx) / 2.0, (v2[1] + two.vy) / 2.0, (v2[2] + two.vz) / 2.0)
    x, y, z = n[0] * distance, n[1] * distance, n[2] * distance
    whole.xx += x * j[0]
    whole.xy += x * j[1]
    whole.yx += y * j[0]
    whole.yy += y * j[1]
    if (j[2] != 0.0) | (z != 0.0):  # (no discs)
        whole.xz += x * j[2]
        whole.yz += y * j[2]
        whole.zx += z * j[0]
        whole.zy += z * j[1]
        whole.zz += z * j[2]
    if kind1 == kind2 and averages.layers.shape[0] == 0:
        # (of one species momentum is conserved, and the two jumps are one)
        s = (s1[0] - s2[0], s1[1] - s2[1], s1[2] - s2[2])
        _note_flux(averages.flows[U64(kind1)], j, s, spin1 + spin2, t)
    else:
        note_change(averages, grid, plan1, kind1, j, s1, spin1, t)
        note_change(averages, grid, plan2, kind2, (-j[0], -j[1], -j[2]), s2, spin2, t)
        if averages.layers.shape[0] > 0:
            above, below = layer_of(whole.axis, plan1), layer_of(whole.axis, plan2)
            # (of what both lose each has its half)
            e, sign = dot(j, s1) + dot(j, s2) + (spin1 - spin2) / 2.0, 1.0 if above > below else -1.0
            if above - below == 1 or below - above == 1:
                _note_upwards(averages, min(above, below), kind1, sign, e, 0.0, j)


@hot_kernel
def _note_passage(layer: Any, sign: float, p: Vec, vv: float, ww: float, t: float) -> None:
    """Note a ball of momentum p that enters a layer (sign 1), or leaves it (sign -1)."""
    layer.n1 += sign * t
    layer.px += p[0] * (sign * t)
    layer.py += p[1] * (sign * t)
    layer.pz += p[2] * (sign * t)
    layer.vv += vv * (sign * t)
    layer.ww += ww * (sign * t)


@hot_kernel
def _note_fall(layer: Any, sign: float, pull: float, t: float) -> None:
    """Note how gravity on a ball that enters or leaves a layer changes its momentum; ``pull``: momentum times gravity."""
    t2 = sign * t * t
    layer.n2 += t2
    layer.n3 += t2 * t
    layer.p2 += pull * t2


@hot_kernel
def _note_upwards(averages: Any, layer: int, kind: int, sign: float, e: float, w: float, p: Vec) -> None:
    """Note what goes through the upper edge of a layer: twice an energy without and of spins, and a momentum."""
    edge = averages.layers[U64(layer * averages.flows.shape[0] + kind)]
    edge.up_e += sign * e
    edge.up_w += sign * w
    edge.up_x += sign * p[0]
    edge.up_y += sign * p[1]
    edge.up_z += sign * p[2]


@hot_kernel
def note_crossing(
    averages: Any, grid: Any, species: Any, ball: Any, body: Any, before: int, after: int, t: float
) -> None:
    """Note a ball that goes from one layer to another."""
    kind, g = I64(ball.species), _gravity(grid)
    one, count = species[U64(kind)], averages.flows.shape[0]
    left, entered = averages.layers[U64(before * count + kind)], averages.layers[U64(after * count + kind)]
    m = one.mass
    p = (m * ball.vx, m * ball.vy, m * ball.vz)
    vv = p[0] * ball.vx + p[1] * ball.vy + p[2] * ball.vz
    ww = one.kappa * m * one.radius * one.radius * (body.wx * body.wx + body.wy * body.wy + body.wz * body.wz)
    _note_passage(left, -1.0, p, vv, ww, t)
    _note_passage(entered, 1.0, p, vv, ww, t)
    if after == before + 1:  # (across a periodic border the layers are far from each other)
        _note_upwards(averages, before, kind, 1.0, vv, ww, p)
    elif after == before - 1:
        _note_upwards(averages, after, kind, -1.0, vv, ww, p)
    if _falls(g):
        _note_fall(left, -1.0, dot(g, p), t)
        _note_fall(entered, 1.0, dot(g, p), t)


# --- sheared gases -------------------------------------------------------------------------------------------------


@hot_kernel
def _flow(shear: Any, grid: Any, y: float) -> float:
    """Return the velocity of the flow along x at a height; 0 in a gas that is not sheared."""
    if shear is None:
        return 0.0
    return shear[0].rate * (y - grid.side[U64(1)] / 2.0)  # type: ignore[no-any-return]


@kernel
def note_flight(shear: Any, grid: Any, averages: Any, species: Any, ball: Any, now: float) -> None:
    """Integrate the flux of momentum relative to the flow over the flight of a ball since its last event."""
    if shear is None:
        return
    flow, m, s = averages.flows[U64(ball.species)], species[U64(ball.species)].mass, now - ball.time
    # the velocity along x relative to the flow is a + b t
    a, b = ball.vx - _flow(shear, grid, ball.y), -shear[0].rate * ball.vy
    mean = m * (a + b * s / 2.0) * s
    flow.time_xx += m * (a * a + (a + b * s / 3.0) * b * s) * s
    flow.time_xy += mean * ball.vy
    flow.time_xz += mean * ball.vz
    flow.time_yy += m * ball.vy * ball.vy * s
    flow.time_zz += m * ball.vz * ball.vz * s
    flow.time_yz += m * ball.vy * ball.vz * s


# --- heat current --------------------------------------------------------------------------------------------------


@kernel
def note_carried_heat(heat: Any, species: Any, ball: Any, body: Any, now: float) -> None:
    """Add the energy of a ball times its way since its last event, without a force."""
    if heat is None:
        return
    one, sums = species[U64(ball.species)], heat[0]
    v, w = (ball.vx, ball.vy, ball.vz), (body.wx, body.wy, body.wz)
    energy = one.mass / 2.0 * (dot(v, v) + sums.spins * one.kappa * one.radius * one.radius * dot(w, w))
    way = energy * (now - ball.time)
    sums.carried_x += way * v[0]
    sums.carried_y += way * v[1]
    sums.carried_z += way * v[2]


@kernel
def note_turning(turned: Any, number: int, ball: Any, body: Any, now: float) -> None:
    """Add the spin of a ball times the time since its last event."""
    if turned is None:
        return
    s, i = now - ball.time, U64(number)
    turned[i, U64(0)] += body.wx * s
    turned[i, U64(1)] += body.wy * s
    turned[i, U64(2)] += body.wz * s


@kernel
def note_passed_heat(
    heat: Any, one: Any, two: Any, j: Vec, v1: Vec, v2: Vec, spin1: float, spin2: float, n: Vec, distance: float
) -> None:
    """Add the energy that the first of two balls gains from the second (half of the difference of their gains) times the distance.

    The arguments are as for :func:`note_pair`.
    """
    if heat is None:
        return
    gain1 = j[0] * (v1[0] + one.vx) + j[1] * (v1[1] + one.vy) + j[2] * (v1[2] + one.vz) + spin1
    gain2 = spin2 - (j[0] * (v2[0] + two.vx) + j[1] * (v2[1] + two.vy) + j[2] * (v2[2] + two.vz))
    passed, sums = distance * (gain1 - gain2) / 4.0, heat[0]
    sums.passed_x += passed * n[0]
    sums.passed_y += passed * n[1]
    sums.passed_z += passed * n[2]


# --- the end of a cycle --------------------------------------------------------------------------------------------


@kernel
def _sum_balls(
    grid: Any, balls: Any, species: Any, averages: Any, now: float, shear: Any, whole_flights: bool
) -> float:
    """Sum what is averaged over all balls, which are as at ``now``; return twice their translational energy."""
    motions, bodies, plans = balls.motions, balls.bodies, balls.plans
    flows, layers, total = averages.flows, averages.layers, 0.0
    gx, gy, gz = grid.gravity[0], grid.gravity[1], grid.gravity[2]
    for k in range(flows.shape[0]):
        flow = flows[k]
        flow.n = flow.pxt = flow.pyt = flow.pzt = flow.ht = flow.wwt = 0.0
        flow.xxt = flow.yyt = flow.zzt = flow.xyt = flow.xzt = flow.yzt = 0.0
    for k in range(layers.shape[0]):
        layer = layers[k]
        layer.n = layer.pxt = layer.pyt = layer.pzt = layer.vvt = layer.wwt = 0.0
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        one, flow = species[ball.species], flows[ball.species]
        s = now - ball.time
        m = one.mass
        ux, vy, vz = ball.vx + gx * s, ball.vy + gy * s, ball.vz + gz * s
        vx = ux - _flow(shear, grid, ball.y + ball.vy * s)
        if not whole_flights:
            note_flight(shear, grid, averages, species, ball, now)
        wx, wy, wz = body.wx, body.wy, body.wz
        vv = m * (vx * vx + vy * vy + vz * vz)
        ww = m * one.kappa * one.radius * one.radius * (wx * wx + wy * wy + wz * wz)
        total += vv
        flow.n += 1.0
        flow.xxt += m * vx * vx
        flow.yyt += m * vy * vy
        flow.zzt += m * vz * vz
        flow.xyt += m * vx * vy
        flow.xzt += m * vx * vz
        flow.yzt += m * vy * vz
        flow.wwt += ww
        if gx != 0.0 or gy != 0.0 or gz != 0.0:
            plan, h = plans[i], s / 2.0
            flow.pxt += m * vx
            flow.pyt += m * vy
            flow.pzt += m * vz
            x = ball.x + (ball.vx + gx * h) * s + plan.image[0] * grid.side[0]
            y = ball.y + (ball.vy + gy * h) * s + plan.image[1] * grid.side[1]
            z = ball.z + (ball.vz + gz * h) * s + plan.image[2] * grid.side[2]
            flow.ht -= m * (gx * x + gy * y + gz * z)
        if layers.shape[0] > 0:
            layer = layers[layer_of(averages.whole[0].axis, plans[i]) * flows.shape[0] + ball.species]
            layer.n += 1.0
            layer.pxt += m * ux
            layer.pyt += m * vy
            layer.pzt += m * vz
            layer.vvt += m * (ux * ux + vy * vy + vz * vz)
            layer.wwt += ww
    return total


@kernel
def close_cycle(
    grid: Any, balls: Any, species: Any, averages: Any, end: float, shear: Any, whole_flights: bool
) -> float:
    """Add the integrals over a cycle that ends at a time; return twice the translational energy then.

    Of a sheared gas flights that are not over are left out (``whole_flights``), or added until then.
    """
    flows, layers = averages.flows, averages.layers
    total = _sum_balls(grid, balls, species, averages, end, shear, whole_flights)
    g = (grid.gravity[0], grid.gravity[1], grid.gravity[2])
    t2, t3 = end * end / 2.0, end * end * end
    for k in range(flows.shape[0]):
        flow = flows[k]
        c = flow.n * species[k].mass * t3 / 6.0
        # int t P dt
        ax = flow.pxt * t2 - flow.x2 / 2.0 - c * g[0]
        ay = flow.pyt * t2 - flow.y2 / 2.0 - c * g[1]
        az = flow.pzt * t2 - flow.z2 / 2.0 - c * g[2]
        if shear is None:
            flow.time_xx += flow.xxt * end - flow.xx - 2.0 * g[0] * ax
            flow.time_yy += flow.yyt * end - flow.yy - 2.0 * g[1] * ay
            flow.time_zz += flow.zzt * end - flow.zz - 2.0 * g[2] * az
            flow.time_xy += flow.xyt * end - flow.xy - g[0] * ay - g[1] * ax
            flow.time_xz += flow.xzt * end - flow.xz - g[0] * az - g[2] * ax
            flow.time_yz += flow.yzt * end - flow.yz - g[1] * az - g[2] * ay
        flow.time_ww += flow.wwt * end - flow.ww
        flow.time_h += flow.ht * end + g[0] * ax + g[1] * ay + g[2] * az
        flow.xx = flow.yy = flow.zz = flow.xy = flow.xz = flow.yz = flow.ww = 0.0
        flow.x2 = flow.y2 = flow.z2 = 0.0
    for k in range(layers.shape[0]):
        layer, m = layers[k], species[k % flows.shape[0]].mass
        # int t n dt, int t^2 n dt
        n1, n2 = layer.n * t2 - layer.n2 / 2.0, (layer.n * t3 - layer.n3) / 3.0
        fall = dot(g, (layer.pxt, layer.pyt, layer.pzt)) * t2 - layer.p2 / 2.0 - dot(g, g) * m * n2 / 2.0
        layer.time_n += layer.n * end - layer.n1
        layer.time_px += layer.pxt * end - layer.px - g[0] * m * n1
        layer.time_py += layer.pyt * end - layer.py - g[1] * m * n1
        layer.time_pz += layer.pzt * end - layer.pz - g[2] * m * n1
        layer.time_vv += layer.vvt * end - layer.vv - 2.0 * fall
        layer.time_ww += layer.wwt * end - layer.ww
        layer.n1 = layer.n2 = layer.n3 = layer.px = layer.py = layer.pz = layer.p2 = layer.vv = layer.ww = 0.0
    return total
