"""Hops without number: a ball on the floor hops ever lower.

The rest of the series is summed (carom.motion.bounces) once the hops are too low to see and nothing else can come near.
"""

from __future__ import annotations

import math
from typing import Any

from carom.kernel import dot, kernel, vector
from carom.motion.bounces import bounces, series_lasts
from carom.motion.phases import BOUNCING, HELD
from carom.scene.features import OVER, distance

__all__ = ["free_for", "hop"]

# Hops lower than this share of the radius are no longer events of their own where they can be summed ...
SUMMED = 1e-6
# ... and where they cannot (the ball moves in touch with a wall, say), those below this are not made any more: it lies.
NO_HOP = 1e-12


@kernel
def free_for(features: Any, balls: Any, i: int, time: float) -> bool:
    """Whether ball i can touch nothing but the floor for a time, wherever its bounces send it."""
    ball = balls[i]
    a, x, v, w = ball.radius, vector(ball.x), vector(ball.v), vector(ball.w)
    # a rubbing floor cannot make it faster than this
    reach = (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))) * time
    for f in range(features.shape[0]):
        # (a gap below -a: the ball is behind a face, or outside of a hollow, and comes in over another feature)
        if features[f].kind != OVER and -a <= distance(features[f], a, x) <= reach:
            return False
    for k in range(balls.shape[0]):
        other = balls[k]
        if k != i and other.phase < HELD:
            s = ball.clock - other.clock + time
            u, b, w = vector(other.v), vector(other.acc), vector(other.w)
            # how far it has come since its own clock, and can come while this one bounces
            far = (math.sqrt(dot(u, u)) + other.radius * math.sqrt(dot(w, w))) * s + math.sqrt(dot(b, b)) * s * s / 2
            r = (x[0] - other.x[0], x[1] - other.x[1], x[2] - other.x[2])
            if math.sqrt(dot(r, r)) - a - other.radius <= reach + far:
                return False
    return True


@kernel
def hop(world: Any, features: Any, balls: Any, i: int) -> bool:
    """Sum the hops of a ball that has just left the floor, where they are low; True where it is simply to lie there."""
    ball = balls[i]
    height = ball.v[2] * ball.v[2] / (2 * world.g)
    if height >= SUMMED * ball.radius:
        return False
    time = series_lasts(ball.v[2], world.g, world.floor_form, vector(world.floor_p))
    if time < math.inf and free_for(features, balls, i, time):
        _x, _v, _w, ball.lasts = bounces(
            vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa, world.g,
            world.floor_form, vector(world.floor_p), world.floor_mu, world.floor_beta, math.inf,
        )  # fmt: skip
        ball.phase = BOUNCING
        return False
    return bool(height < NO_HOP * ball.radius)
