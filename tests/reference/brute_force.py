"""After the wall, by brute force: flight, bounces and sliding in small steps of time, written without carom.

The ball goes on through the wall as if it were not there, so that one run says how deep it would have gone. Its compiled
code is kept as carom's is: all that it calls stands in this file, whose changes the cache sees.
"""

import functools
import math

import numpy as np
from reference.compiling import part

from carom.core.jit.compile import njit

STEP = 5e-6  # s


@part
def bounce(v, w, a, kappa, e, mu, beta):
    """One landing: normal velocity back e times; friction caps the impulse that turns the slip into -beta slips."""
    sx, sy = v[0] - a * w[1], v[1] + a * w[0]
    s = math.hypot(sx, sy)
    pn = -(1 + e) * v[2]
    v[2] = -e * v[2]
    if s == 0:
        return
    p = min((1 + beta) * kappa / (1 + kappa) * s, mu * pn)
    px, py = -p * sx / s, -p * sy / s
    v[0] += px
    v[1] += py
    # torque of (px, py, 0) at -a k: -a k x p = a (py, -px, 0)
    w[0] += py / (kappa * a)
    w[1] -= px / (kappa * a)


@part
def follow(v, w, n, a, kappa, e, mu, beta, g, h, longest):
    """Whether it rolls within `longest`; the deepest place behind the wall before that, and before it first lands; the

    nearest approach to the wall once it has been 1e-5 m away. Velocity and spin in the end are left in v and w.
    """
    z, c, t = h, 0.0, 0.0
    deepest, deepest_in_flight, nearest = 0.0, 0.0, 1e300
    flying, far = h > 0 or v[2] > 0, False
    landed = not flying
    if landed and v[2] < 0:
        bounce(v, w, a, kappa, e, mu, beta)
        flying = v[2] > 0
    while t < longest:
        if flying:
            dt = STEP
            fall = z + v[2] * dt - g * dt * dt / 2
            if fall <= 0 and v[2] - g * dt < 0:  # the time of landing, exactly
                dt = (v[2] + math.sqrt(v[2] * v[2] + 2 * g * z)) / g
                c += (v[0] * n[0] + v[1] * n[1] + v[2] * n[2]) * dt - g * n[2] * dt * dt / 2
                v[2] -= g * dt
                z = 0.0
                bounce(v, w, a, kappa, e, mu, beta)
                if not landed:
                    landed = True
                    deepest_in_flight = min(deepest_in_flight, c)
                if v[2] < 2 * g * STEP:  # hops of some steps of time
                    v[2] = 0.0
                    flying = False
            else:
                c += (v[0] * n[0] + v[1] * n[1] + v[2] * n[2]) * dt - g * n[2] * dt * dt / 2
                z = fall
                v[2] -= g * dt
            t += dt
        else:
            sx, sy = v[0] - a * w[1], v[1] + a * w[0]
            s = math.hypot(sx, sy)
            dt = STEP
            dp = mu * g * dt
            stop = s * kappa / (1 + kappa)
            last = stop <= dp
            if last:
                dp = stop
                dt = dp / (mu * g)
            if s > 0:
                px, py = -dp * sx / s, -dp * sy / s
                c += (v[0] * n[0] + v[1] * n[1]) * dt + (px * n[0] + py * n[1]) * dt / 2
                v[0] += px
                v[1] += py
                w[0] += py / (kappa * a)
                w[1] -= px / (kappa * a)
            t += dt
            if last:
                return True, min(deepest, c), deepest_in_flight, min(nearest, c if far else nearest)
        deepest = min(deepest, c)
        if not landed:
            deepest_in_flight = min(deepest_in_flight, c)
        if c > 1e-5:
            far = True
        if far:
            nearest = min(nearest, c)
    return False, deepest, deepest_in_flight, nearest


def follow_all(v, w, n, p, rolls, found):
    """`follow` for rows; parameters a, kappa, e, mu, beta, g, h of the floor; found: deepest, in flight, nearest."""
    for i in range(len(v)):
        a, kappa, e, mu, beta, g, h = p[i]
        rolls[i], found[i, 0], found[i, 1], found[i, 2] = follow(v[i], w[i], n[i], a, kappa, e, mu, beta, g, h, 30.0)


@functools.cache
def compiled():
    return njit(follow_all, _nrt=False)


def run(v, w, n, parameters):
    v, w, n = (np.ascontiguousarray(x, dtype=float).copy() for x in (v, w, n))
    rolls, found = np.zeros(len(v), dtype=bool), np.zeros((len(v), 3))
    compiled()(v, w, n, np.stack(parameters, axis=-1), rolls, found)
    return rolls, found, v, w
