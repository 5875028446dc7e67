"""Predictions of the laws for a rebound: kernels that map (v_n, v_t, spin) before the wall to the same after it.

The wall is x = 0 with the ball at x > 0; v_n is positive toward the wall before and away from it after, v_t runs along
it (y), spin is about z. A ball on a table rolls before the contact, or has a fraction ``roll`` of rolling. ``p`` is a record of
:data:`carom.fitting.parameters.LAW_NUMBERS`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, dot, kernel
from carom.core.motion.phases import ROUNDING
from carom.core.motion.restitution import restitution
from carom.core.motion.rolling import UP, rolls_at_last
from carom.fitting.parameters import ALONG_FORMS, LINE, RESTITUTION_FORMS
from carom.laws.callbacks import call_user
from carom.laws.conventional import conventional_reflection
from carom.laws.two_step import UNDEFINED, first_impact
from carom.laws.wall_and_floor.solver import STALL

__all__ = [
    "AFTER_WALL", "CONTACT", "CONVENTIONAL", "DENSE", "DIRECTION", "LEAST_STIFFNESS", "PLANES", "ROLLING", "SMOOTH", "TABLE_HEAD",
    "TABULATED", "TOGETHER", "TURN", "of_impact", "planar_law", "planar_rebound", "speed_restitution", "table_law",
    "table_rebound",
]  # fmt: skip

# Contact models that are compiled in. SMOOTH: wall and floor without friction; TURN: the wall and then the floor; TOGETHER: both
# at once. Any other code is the address of a law's kernel (carom.laws.callbacks); with a minus sign where the last number that
# the kernel takes is the stiffness ratio in place of the tangential restitution.
CONTACT, SMOOTH, CONVENTIONAL, TURN, TOGETHER = range(5)
TABULATED = 5  # both at once, from a table (carom.fitting.tabulated)
LEAST_STIFFNESS = 0.1  # of a stiffness ratio that depends on the impact
# Stages at which the outgoing ball was measured
AFTER_WALL, ROLLING = 0, 1
DIRECTION = 2  # in place of a stage: v_t in units of the speed after, where only that was measured


@kernel
def speed_restitution(form: int, p: Vec, speed: float) -> float:
    """Return e at a speed of approach: a form of :mod:`carom.core.motion.restitution`, or the line v_out = p0 v + p1."""
    if form == LINE:
        e = p[0] + p[1] / speed
        return max(e, 0 * e)  # above 1 at speeds below offset / (1 - slope)
    return restitution(form, p, speed)


@kernel
def of_impact(code: int, p: Vec, v: Vec, w: Vec, n: Vec, a: float) -> float:
    """Return a parameter along the wall: constant, or by its form (:data:`carom.fitting.parameters.ALONG`)."""
    if code == 0:
        return p[0]
    un, ut = slip_velocity(v, w, n, a)
    slip, variable = math.sqrt(dot(ut, ut)), code // 4
    s = -un if variable == 0 else slip if variable == 1 else slip / -un if variable == 2 else math.sqrt(dot(v, v))
    return p[0] + p[1] * s if code % 4 == 1 else p[1] + (p[0] - p[1]) * math.exp(-s / p[2])


@kernel
def _along_wall(code: int, form: int, p: Any, v: Vec, w: Vec, n: Vec, a: float) -> tuple[float, float]:
    """Return the friction at an impact, and the last number of the law: tangential restitution or stiffness ratio."""
    stiff = code < 0
    last = p.stiffness_ratio if stiff else p.tangential_restitution
    mu = p.friction
    along = form // RESTITUTION_FORMS
    if along > 0:
        zero = 0 * a
        mu = max(of_impact(along % ALONG_FORMS, (mu, p.friction_1, p.friction_2), v, w, n, a), zero)
        last = of_impact(along // ALONG_FORMS, (last, p.last_1, p.last_2), v, w, n, a)
        last = max(last, zero + LEAST_STIFFNESS) if stiff else min(max(last, zero - 1), zero + 1)
    return mu, last


@kernel
def planar_rebound(code: int, form: int, stage: int, x: Vec, a: float, p: Any) -> Vec:
    """Return v_n, v_t and spin of a planar bounce after the wall; v_t in units of the speed where only the angle was measured."""
    zero = 0 * x[0]
    e = speed_restitution(form % RESTITUTION_FORMS, (p.restitution, p.restitution_1, p.restitution_2), x[0])
    v, w, n = (-x[0], x[1], zero), (zero, zero, x[2]), (1 + zero, zero, zero)
    mu, last = _along_wall(code, form, p, v, w, n, a)
    if code < 0 or code > TOGETHER:
        v1, w1 = call_user(abs(code), v, w, n, a, p.kappa, e, mu, last)
    else:
        v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, p.kappa, e, mu, last)
    if stage == DIRECTION:
        speed = math.sqrt(v1[0] * v1[0] + v1[1] * v1[1])
        return v1[0], v1[1] / speed if speed > 0 else zero, w1[2]
    return v1[0], v1[1], w1[2]


@kernel
def table_rebound(code: int, form: int, stage: int, x: Vec, a: float, p: Any) -> Vec:
    """Return v_n, v_t and vertical spin of a ball on a table, after the wall or once it rolls again; NaN: undefined."""
    zero = 0 * x[0]
    up = 1 - p.contact_height
    n = (math.sqrt(1 - up * up), zero, up)
    v = (-x[0], x[1], zero)
    # (18), times the fraction of rolling
    w = (-p.roll * x[1] / a, -p.roll * x[0] / a, x[2])
    if code == CONVENTIONAL:
        v1, w1 = conventional_reflection(v, (-x[1] / a, -x[0] / a, x[2]), (1 + zero, zero, zero), a, p.kappa)
        return v1[0], v1[1], w1[2]
    e = speed_restitution(form % RESTITUTION_FORMS, (p.restitution, p.restitution_1, p.restitution_2), x[0] * n[0])
    if code == SMOOTH:
        return e * x[0], x[1], x[2]
    mu, last = _along_wall(code, form, p, v, w, n, a)
    if code < 0 or code > TOGETHER:
        v1, w1 = call_user(abs(code), v, w, n, a, p.kappa, e, mu, last)
    else:
        v1, w1, _j, _jf, _required, regime = first_impact(
            v,
            w,
            n,
            a,
            p.kappa,
            e,
            mu,
            last,
            p.floor_restitution,
            p.floor_friction,
            zero,
            zero,
            code == TOGETHER,
        )
        if regime in (UNDEFINED, STALL):
            return math.nan, math.nan, math.nan
    if stage == ROLLING:
        # (39)
        v1, w1 = rolls_at_last(v1, w1, a, p.kappa)
    elif v1[2] < -ROUNDING * x[0]:  # pushed onto the floor: it bounces off the floor at once
        v1, w1, _j, _required, _regime = wall_contact(
            v1, w1, UP, a, p.kappa, p.floor_restitution, p.floor_friction, zero
        )
    return v1[0], v1[1], w1[2]


# A table of a law at some restitution, wall friction and floor friction: its head, these three first, then for each stage,
# direction and spin the velocities, and a times the spin, of a ball that came with speed 1; then the same of their derivatives in
# the three, one after the other.
TABLE_HEAD = 10
_DIRECTION, _DIRECTIONS, _SPIN, _SPINS, _STAGES = 3, 5, 6, 8, 9
PLANES = 4
DENSE = 0.6  # v/a: spins below this are evenly spaced, and in proportion to their size beyond


@kernel
def _lagrange_weights(t: float) -> tuple[float, float, float, float]:
    """Return Lagrange's weights of four values at 0, 1, 2 and 3."""
    a, b, c = t - 1, t - 2, t - 3
    return -a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6


@kernel
def _between_four(known: Any, at: int, u: tuple[float, float, float, float]) -> Vec:
    """Return the sum of four entries of a table, from a place on, with their weights."""
    u0, u1, u2, u3 = u
    return (
        u0 * known[at] + u1 * known[at + 3] + u2 * known[at + 6] + u3 * known[at + 9],
        u0 * known[at + 1] + u1 * known[at + 4] + u2 * known[at + 7] + u3 * known[at + 10],
        u0 * known[at + 2] + u1 * known[at + 5] + u2 * known[at + 8] + u3 * known[at + 11],
    )


@kernel
def look_up(stage: int, x: Vec, a: float, p: Any, known: Any) -> Vec:
    """Return a table's prediction: cubic in direction and spin, linear in the difference of the parameters from the table's.

    What comes from the other side is mirrored. The law is homogeneous in the speeds.
    """
    side = 1 + 0 * x[0] if x[1] >= 0 else -1 + 0 * x[0]
    along = side * x[1]
    speed = math.sqrt(x[0] * x[0] + along * along)
    sigma = side * x[2] * a / speed / DENSE
    root = math.sqrt(sigma * sigma + 1)
    place = math.log(sigma + root) if sigma >= 0 else -math.log(root - sigma)
    directions, spins = int(known[_DIRECTIONS]), int(known[_SPINS])
    one = (along / (x[0] + along) - known[_DIRECTION]) * known[_DIRECTION + 1]
    two = (place - known[_SPIN]) * known[_SPIN + 1]
    i = min(max(int(one) - 1, 0), directions - 4)
    j = min(max(int(two) - 1, 0), spins - 4)
    w0, w1, w2, w3 = _lagrange_weights(one - i)
    u0, u1, u2, u3 = _lagrange_weights(two - j)
    first = (int(min(stage, known[_STAGES] - 1)) * directions + i) * spins + j
    size = int(known[_STAGES]) * directions * spins * 3
    at, row, u = TABLE_HEAD + 3 * first, 3 * spins, (u0, u1, u2, u3)
    f0 = f1 = f2 = 0 * speed
    for plane in range(PLANES):
        off = 1 + 0 * speed if plane == 0 else p.restitution - known[0] if plane == 1 else p.friction - known[1]
        off = p.floor_friction - known[2] if plane == 3 else off
        if off != 0:
            r0, r1 = _between_four(known, at, u), _between_four(known, at + row, u)
            r2, r3 = _between_four(known, at + 2 * row, u), _between_four(known, at + 3 * row, u)
            f0 += off * (w0 * r0[0] + w1 * r1[0] + w2 * r2[0] + w3 * r3[0])
            f1 += off * (w0 * r0[1] + w1 * r1[1] + w2 * r2[1] + w3 * r3[1])
            f2 += off * (w0 * r0[2] + w1 * r1[2] + w2 * r2[2] + w3 * r3[2])
        at += size
    return speed * f0, side * speed * f1, side * speed * f2 / a


@kernel
def planar_law(code: int, form: int, stage: int, x: Vec, a: float, p: Any, _known: Any) -> Vec:
    """Return :func:`planar_rebound`, which no table replaces."""
    return planar_rebound(code, form, stage, x, a, p)


@kernel
def table_law(code: int, form: int, stage: int, x: Vec, a: float, p: Any, known: Any) -> Vec:
    """Return :func:`table_rebound`, or what a table of it says."""
    if code == TABULATED:
        return look_up(stage, x, a, p, known)
    return table_rebound(code, form, stage, x, a, p)
