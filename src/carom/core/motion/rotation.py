"""Orientation of a ball while its spin changes: unit quaternions (w, x, y, z), from the body frame to the fixed frame.

Where the spin keeps its direction the result is exact: one rotation by the integral of its magnitude. Where the direction changes
(sliding, and rolling while the side spin fades) the spin is linear in time, and steps of Magnus' series of order 6
(Blanes, Casas, Oteo & Ros, Phys. Rep. 470, 151 (2009), eq. 253) keep the error of a whole phase below 1e-10 rad.
"""

from __future__ import annotations

import math

from carom.core.contact import one_contact
from carom.core.jit.kernel import Vec, cross, dot, kernel
from carom.core.motion.phases import LAST_HOP, UP, advance_decaying, restitution, time_of_integral, time_of_path
from carom.core.motion.tilt import Lean, advance_on_slope

Quaternion = tuple[float, float, float, float]
# Phase, velocity, radius, kappa, lean (carom.core.motion.tilt)
Slope = tuple[int, Vec, float, float, Lean]
# Largest turn of one step, rad: a local error of some 1e-14.
STEP = 0.05
# Nodes of Gauss in a step, as shares of it from its middle
NODE = math.sqrt(15) / 10


@kernel
def rotation(r: Vec) -> Quaternion:
    """Return the rotation by |r| about r."""
    angle = math.sqrt(dot(r, r))
    # sin(angle/2)/angle, by its series where the division would lose it
    c = math.sin(angle / 2) / angle if angle > 1e-8 else 1 / 2 - angle * angle / 48
    return (math.cos(angle / 2), c * r[0], c * r[1], c * r[2])


@kernel
def compose(p: Quaternion, q: Quaternion) -> Quaternion:
    """Return the rotation q followed by p."""
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


@kernel
def _orientation_after_linear_spin(q: Quaternion, w: Vec, turn: Vec, s: float) -> Quaternion:
    """Return the orientation after a time s with the spin w + turn t."""
    b = cross(w, turn)
    most = math.sqrt(dot(w, w)) + math.sqrt(dot(turn, turn)) * s
    if math.sqrt(dot(b, b)) * s <= 1e-15 * most:  # one direction
        return compose(
            rotation((w[0] * s + turn[0] * s * s / 2, w[1] * s + turn[1] * s * s / 2, w[2] * s + turn[2] * s * s / 2)),
            q,
        )
    steps = 1 + int(most * s / STEP)
    h = s / steps
    for k in range(steps):
        t = (k + 1 / 2) * h
        # at the middle of the step, and the change over the step
        a1 = ((w[0] + turn[0] * t) * h, (w[1] + turn[1] * t) * h, (w[2] + turn[2] * t) * h)
        a2 = (turn[0] * h * h, turn[1] * h * h, turn[2] * h * h)
        c1 = cross(a1, a2)
        c2 = cross(a1, c1)
        left = (-20 * a1[0] + c1[0], -20 * a1[1] + c1[1], -20 * a1[2] + c1[2])
        right = (a2[0] - c2[0] / 60, a2[1] - c2[1] / 60, a2[2] - c2[2] / 60)
        d = cross(left, right)
        q = compose(rotation((a1[0] + d[0] / 240, a1[1] + d[1] / 240, a1[2] + d[2] / 240)), q)
    return q


@kernel
def orientation_after(q: Quaternion, w: Vec, turn: Vec, s: float) -> Quaternion:
    """Return the orientation a time s later in a phase with the angular acceleration ``turn``; sidespin stays zero once it is."""
    if turn[2] * w[2] < 0 and abs(turn[2]) * s > abs(w[2]):
        ends = -w[2] / turn[2]
        q = _orientation_after_linear_spin(q, w, turn, ends)
        w = (w[0] + turn[0] * ends, w[1] + turn[1] * ends, 0 * s)
        turn, s = (turn[0], turn[1], 0 * s), s - ends
    q = _orientation_after_linear_spin(q, w, turn, s)
    size = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    return (q[0] / size, q[1] / size, q[2] / size, q[3] / size)


@kernel
def _spin_at(w: Vec, turn: Vec, fade: float, spin_fade: float, gain: float, slope: Slope, s: float) -> Vec:
    zero = (0 * s, 0 * s, 0 * s)
    spin = advance_decaying(zero, zero, w, zero, turn, fade, spin_fade, gain, s)[2]
    phase, v, a, kappa, lean = slope
    if lean[3] > 0:
        turned = advance_on_slope(phase, zero, v, w, a, kappa, lean, s)[2]
        return (turned[0], turned[1], spin[2])
    return spin


@kernel
def magnus_step(q: Quaternion, low: Vec, mid: Vec, high: Vec, h: float) -> Quaternion:
    """Return the orientation after a step h of Magnus' series, from the spins at its nodes of Gauss."""
    c = 10 * NODE / 3 * h
    a1 = (mid[0] * h, mid[1] * h, mid[2] * h)
    a2 = (c * (high[0] - low[0]), c * (high[1] - low[1]), c * (high[2] - low[2]))
    c = 10 / 3 * h
    a3 = (
        c * (high[0] - 2 * mid[0] + low[0]), c * (high[1] - 2 * mid[1] + low[1]), c * (high[2] - 2 * mid[2] + low[2]),
    )  # fmt: skip
    c1 = cross(a1, a2)
    b = (2 * a3[0] + c1[0], 2 * a3[1] + c1[1], 2 * a3[2] + c1[2])
    c2 = cross(a1, b)
    left = (-20 * a1[0] - a3[0] + c1[0], -20 * a1[1] - a3[1] + c1[1], -20 * a1[2] - a3[2] + c1[2])
    d = cross(left, (a2[0] - c2[0] / 60, a2[1] - c2[1] / 60, a2[2] - c2[2] / 60))
    r = (
        a1[0] + a3[0] / 12 + d[0] / 240, a1[1] + a3[1] / 12 + d[1] / 240, a1[2] + a3[2] / 12 + d[2] / 240,
    )  # fmt: skip
    return compose(rotation(r), q)


@kernel
def _orientation_in_steps(
    q: Quaternion, w: Vec, turn: Vec, fade: float, spin_fade: float, gain: float, slope: Slope, begin: float, end: float
) -> Quaternion:
    """Return the orientation at a time, from that at another: Magnus' series of order 6 at three nodes of Gauss a step."""
    last = _spin_at(w, turn, fade, spin_fade, gain, slope, end)
    most = math.sqrt(max(dot(w, w), dot(last, last))) * (end - begin)
    steps = 1 + int(most / STEP)
    h = (end - begin) / steps
    for k in range(steps):
        t = begin + (k + 1 / 2) * h
        low = _spin_at(w, turn, fade, spin_fade, gain, slope, t - NODE * h)
        mid = _spin_at(w, turn, fade, spin_fade, gain, slope, t)
        high = _spin_at(w, turn, fade, spin_fade, gain, slope, t + NODE * h)
        q = magnus_step(q, low, mid, high, h)
    return q


@kernel
def orientation_after_decay(
    q: Quaternion, w: Vec, turn: Vec, fade: float, spin_fade: float, gain: float, slope: Slope, s: float
) -> Quaternion:
    """:func:`orientation_after` where the angular acceleration changes: as it decays (:func:`carom.core.motion.phases.decays`), or
    as a tilted floor turns the ball: ``slope`` has its phase, velocity, radius, kappa and lean (:mod:`carom.core.motion.tilt`).
    """
    ends = s
    if turn[2] * w[2] < 0:  # the step ends where the sidespin does
        path = -w[2] / turn[2]
        ends = time_of_integral(spin_fade, path) if gain == 0 else time_of_path(fade, abs(gain / turn[2]), path, s)
        ends = min(ends, s)
    q = _orientation_in_steps(q, w, turn, fade, spin_fade, gain, slope, 0 * s, ends)
    if ends < s:
        q = _orientation_in_steps(q, w, turn, fade, spin_fade, gain, slope, ends, s)
    size = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    return (q[0] / size, q[1] / size, q[2] / size, q[3] / size)


@kernel
def orientation_after_bounces(
    q: Quaternion, v: Vec, w: Vec, a: float, kappa: float, g: float, form: int, p: Vec, mu: float, beta: float, s: float
) -> Quaternion:
    """Return the orientation of a bouncing ball a time s later: the spin is constant during each bounce."""
    first = v[2]
    while s > 0 and v[2] > LAST_HOP * first:
        hop = min(2 * v[2] / g, s)
        q = compose(rotation((w[0] * hop, w[1] * hop, w[2] * hop)), q)
        s -= hop
        e = restitution(form, p, v[2])
        v, w, _j, _required, _regime = one_contact((v[0], v[1], -v[2]), w, UP, a, kappa, e, mu, beta)
    return q
