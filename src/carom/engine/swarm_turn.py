"""Many balls, once a turn of the calendar: the sums over time, the drift that is taken out, whether anything is left to come."""

from __future__ import annotations

import math
from typing import Any

from carom.engine.swarm_arrays import DONE, FAINT, LIMIT, PULL
from carom.engine.swarm_predict import drift
from carom.kernel import hot_kernel, kernel

__all__ = ["left_to_come", "sample", "set_slow", "settle"]

# An approach slower than this share of the speeds is none: it is the rounding of two balls that move along each other or,
# after an impact without rebound, together.
SLOW = 1e-14
# A drift with more than this share of the energy is taken out.
DRIFT = 1e-12
# Of a mean square speed: below, squares of what is small beside it leave the range of double precision.
LEAST = 1e-280


@hot_kernel
def set_slow(swarm: Any, species: Any, energy: float) -> None:
    """What counts as no approach, by twice the translational energy."""
    lightest, widest = math.inf, 0.0
    for k in range(species.shape[0]):
        lightest, widest = min(lightest, species[k].mass), max(widest, species[k].radius)
    swarm.slow = SLOW * widest * math.sqrt(energy / (lightest * swarm.count))


@hot_kernel
def sample(swarm: Any, box: Any, motions: Any, bodies: Any, species: Any, now: float) -> None:
    """Add twice the translational and the rotational energy of now to the sums, for as long as the turn was."""
    translational, rotational = 0.0, 0.0
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        one = species[ball.kind]
        s = now - ball.clock
        vx, vy, vz = ball.vx + box[PULL] * s, ball.vy + box[PULL + 1] * s, ball.vz + box[PULL + 2] * s
        wx, wy, wz = body.wx, body.wy, body.wz
        translational += one.mass * (vx * vx + vy * vy + vz * vz)
        rotational += one.mass * one.kappa * one.radius * one.radius * (wx * wx + wy * wy + wz * wz)
    # (turns have as many events each, not as much time: a mean over turns would dwell on when much happens)
    turn = swarm.width * swarm.bins
    swarm.translational += translational * turn
    swarm.rotational += rotational * turn
    swarm.sampled += turn
    set_slow(swarm, species, translational)


@kernel
def settle(swarm: Any, box: Any, motions: Any, species: Any) -> bool:
    """Take the drift along free axes out, if it is worth it; whether it was: all has to be planned anew, then.

    What nothing but the balls changes they do not change: at the start this finds what they were given, and remembers it
    (``frame``); later, what rounding has made of nothing, which is forgotten.
    """
    mass, p, energy = 0.0, (0.0, 0.0, 0.0), 0.0
    fx, fy, fz = swarm.free[0], swarm.free[1], swarm.free[2]
    for i in range(motions.shape[0]):
        ball = motions[i]
        m, s = species[ball.kind].mass, swarm.now - ball.clock
        x, y, z = ball.vx + box[PULL] * s, ball.vy + box[PULL + 1] * s, ball.vz + box[PULL + 2] * s
        mass += m
        p = (p[0] + m * x, p[1] + m * y, p[2] + m * z)
        energy += m * (x * x + y * y + z * z)
    x, y, z = p[0] / mass * fx, p[1] / mass * fy, p[2] / mass * fz
    if not mass * (x * x + y * y + z * z) > DRIFT * energy:
        return False
    for i in range(motions.shape[0]):
        ball = motions[i]
        drift(box, ball, swarm.now)
        ball.vx, ball.vy, ball.vz = ball.vx - x, ball.vy - y, ball.vz - z
    if swarm.turns == 0:
        swarm.frame[0] += x
        swarm.frame[1] += y
        swarm.frame[2] += z
    return True


@kernel
def left_to_come(swarm: Any, motions: Any, plans: Any, species: Any, popped: int) -> int:
    """Whether it makes sense to go on: LIMIT. Or DONE, nothing will ever happen; or FAINT, all is too slow for its numbers."""
    if popped == 0:
        waits = False
        for i in range(plans.shape[0]):
            waits = waits or plans[i].at < math.inf
        if not waits:
            return DONE
    mass, energy = 0.0, 0.0
    for i in range(motions.shape[0]):
        ball = motions[i]
        m = species[ball.kind].mass
        mass += m
        energy += m * (ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz)
    return FAINT if 0.0 < energy < LEAST * mass else LIMIT
