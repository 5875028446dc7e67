"""Predict the next event of a ball: the earliest of the end of its phase, a wall, the floor, another ball.

Of events at the same time the first in this order is taken: walls in the scene's order, the floor, balls by number, the end of
the phase.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import FALLS, OVER, SEAM, feature_hit, is_out_of_reach, never_closes
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, vector
from carom.core.motion.bounces import bounces
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, REST, SLIDING, accelerations, advance
from carom.core.roots.first_root import hit2, hit4
from carom.simulation.records import BALL, FLOOR, LEFT_EVENT, NOTHING, PHASE, POCKETED_EVENT, SETTLED, WALL

__all__ = [
    "accelerations_of",
    "begin_phase",
    "is_on_floor",
    "move_by",
    "predict",
    "state_after",
    "state_at",
    "write_vector",
]

STILL = 1e-12  # of the radius: a ball that moved by less is where it was


@hot_kernel
def write_vector(row: Any, value: Vec) -> None:
    """Write three numbers into an array."""
    row[0], row[1], row[2] = value[0], value[1], value[2]


@kernel
def state_at(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin of a ball a time s after its clock, in its present phase."""
    return advance(vector(ball.x), vector(ball.v), vector(ball.w), vector(ball.acc), vector(ball.turn), s)


@kernel
def state_after(world: Any, ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin of a ball a time s after its clock, also of one that bounces infinitely often."""
    if ball.phase == BOUNCING:
        x, v, w, _time = bounces(
            vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
            world.g, world.floor_form, vector(world.floor_p), world.floor_mu, world.floor_beta, s,
        )  # fmt: skip
    else:
        x, v, w = state_at(ball, s)
    return x, v, w


@kernel
def move_by(world: Any, ball: Any, s: float, t: float) -> None:
    """Advance a ball by s, to the time t."""
    v = vector(ball.v)
    x, v1, w = state_after(world, ball, s)
    write_vector(ball.x, x)
    write_vector(ball.v, v1)
    write_vector(ball.w, w)
    ball.repeats = ball.repeats + 1 if s * math.sqrt(dot(v, v)) <= STILL * ball.radius else 0
    ball.clock = t


@kernel
def accelerations_of(world: Any, ball: Any) -> tuple[Vec, Vec, float]:
    """Return acceleration, angular acceleration and duration of the phase that a ball is in."""
    return accelerations(
        ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
        vector(world.force), world.g, world.floor_mu, world.resistance, world.spin_friction,
    )  # fmt: skip


@kernel
def is_on_floor(world: Any, ball: Any) -> bool:
    """Return whether a ball is on the floor: by its phase, or, where nothing presses it, by its position and velocity."""
    if ball.phase == FLIGHT:
        return bool(world.floor != 0 and not world.g > 0 and ball.v[2] == 0 and ball.x[2] == ball.radius)
    return bool(SLIDING <= ball.phase <= REST)


@kernel
def begin_phase(world: Any, ball: Any) -> None:
    """Set the accelerations and the duration of the phase that a ball has entered."""
    acc, turn, lasts = accelerations_of(world, ball)
    write_vector(ball.acc, acc)
    write_vector(ball.turn, turn)
    if ball.phase != BOUNCING:  # whose end was set when its bounces were found to be clear of everything else
        ball.lasts = lasts


@kernel
def _pair_hit(ball: Any, other: Any, now: float, until: float, slow: float) -> float:
    """Return the time from ``now``, in [0, until], at which two balls touch, or infinity."""
    x, v, _w = state_at(ball, now - ball.clock)
    y, u, _w = state_at(other, now - other.clock)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    v = (v[0] - u[0], v[1] - u[1], v[2] - u[2])
    b = (ball.acc[0] - other.acc[0], ball.acc[1] - other.acc[1], ball.acc[2] - other.acc[2])
    reach = ball.radius + other.radius
    far = math.sqrt(dot(r, r))
    # |r + v s + b s^2/2|^2 - reach^2
    c0, c1, tol = (far - reach) * (far + reach), 2 * dot(r, v), 2 * reach * slow
    c2, c3, c4 = dot(v, v) + dot(r, b), dot(v, b), dot(b, b) / 4
    if c0 <= 2 * reach * SEAM * min(ball.radius, other.radius) and never_closes(c1, c2, c3, c4, until, tol):
        return math.inf
    return hit4(c0, c1, c2, c3, c4, until, tol)


@kernel
def _lands_first(world: Any, features: Any, ball: Any, slow: float) -> bool:
    """Return whether a ball in flight comes down on the floor before it has come as far as any wall; most hops do."""
    if ball.phase != FLIGHT or world.floor == 0:
        return False
    x, v, acc, a = vector(ball.x), vector(ball.v), vector(ball.acc), ball.radius
    s = hit2(x[2] - a, v[2], acc[2] / 2, math.inf, slow)
    way = (math.sqrt(dot(v, v)) + math.sqrt(dot(acc, acc)) * s / 2) * s
    if not way < math.inf:
        return False
    for f in range(features.shape[0]):  # noqa: SIM110  (a kernel makes no generator)
        if not is_out_of_reach(features[f], a, x, way):
            return False
    return True


@kernel
def _kind_of(f: Any) -> int:
    """Return the kind of event at a feature: a wall is met; at a gate a ball falls into a pocket, or clears a wall."""
    if f.kind != OVER:
        return WALL
    return POCKETED_EVENT if f.ends == FALLS else LEFT_EVENT


@kernel
def predict(world: Any, features: Any, balls: Any, i: int, slow: float) -> None:
    """Predict the next event of ball i and store it, for the other ball too where two will meet."""
    ball = balls[i]
    phase, a = ball.phase, ball.radius
    best, kind, who = math.inf, NOTHING, -1
    if phase < REST or phase == BOUNCING:
        best = ball.lasts
    if phase < REST:
        x, v, acc = vector(ball.x), vector(ball.v), vector(ball.acc)
        for f in range(0 if _lands_first(world, features, ball, slow) else features.shape[0]):
            s = feature_hit(features[f], a, x, v, acc, best, slow)
            if s < best or (s == best and kind == NOTHING and s < math.inf):
                best, kind, who = s, _kind_of(features[f]), f
        if phase == FLIGHT and world.floor != 0:
            s = hit2(x[2] - a, v[2], acc[2] / 2, best, slow)
            if s < best or (s == best and kind == NOTHING and s < math.inf):
                best, kind, who = s, FLOOR, -1
    if phase < HELD:
        for k in range(balls.shape[0]):
            other = balls[k]
            if k == i or other.phase >= HELD or (phase == REST and other.phase == REST):
                continue
            if BOUNCING in (phase, other.phase):  # clear of each other, or it would not be bouncing (resting_contact)
                continue
            # the other ball stays on its path up to its next event, after which the pair is predicted anew
            now = max(ball.clock, other.clock)
            until = min(best - (now - ball.clock), other.next_at - now)
            if until >= 0:
                s = _pair_hit(ball, other, now, until, slow) + (now - ball.clock)
                if s < best or (s == best and kind == NOTHING and s < math.inf):
                    best, kind, who = s, BALL, k
    if kind == NOTHING and best < math.inf:
        kind = SETTLED if phase == BOUNCING else PHASE
    ball.next_in, ball.next_at, ball.next_kind, ball.next_who = best, ball.clock + best, kind, who
    if kind == BALL:
        other = balls[who]
        ball.next_at = max(ball.next_at, other.clock)  # not before the other's last event, by rounding
        other.next_kind, other.next_who, other.next_at = BALL, i, ball.next_at
        other.next_in = ball.next_at - other.clock
