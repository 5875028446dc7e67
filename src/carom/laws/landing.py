"""From the wall to rolling: the flight, the landings, and whether the ball rolls before it meets the wall again.

Every impulse that the floor gives acts at the floor's contact point, so the angular momentum about that point (more
exactly, the two components (37) along the floor, and omega_z) cannot change: however the ball lands, bounces and slides,
if it rolls at last it rolls with (39) of the state in which it left the wall. What has to be found out is only whether.
"""

from __future__ import annotations

import math

from carom.kernel import Vec, dot, hot_kernel, kernel
from carom.laws.contact import slip_velocity, wall_contact

__all__ = [
    "IN_FLIGHT",
    "LOST",
    "NO_GRAVITY",
    "NO_LAW",
    "ROLLS",
    "ROUNDING",
    "UP",
    "WHY",
    "fall",
    "fate",
    "rolls_at_last",
]

# What becomes of a ball that left the wall; what people see is WHY[code].
ROLLS, NO_GRAVITY, NO_FRICTION, BOUNCES, IN_FLIGHT = 0, 1, 2, 3, 4
BEFORE_ROLLING, TOO_MANY, NO_LAW, LOST, ROLLS_BACK = 5, 6, 7, 8, 9
WHY = (
    "",
    "there is no gravity to bring it back to the floor",
    "the floor has no friction, so it slides on for ever",
    "the floor returns everything, so it bounces for ever",
    "it meets the wall again in flight, before it lands",
    "it meets the wall again before it rolls: its spin turns it round",
    "undecided after a million bounces",
    "wall and floor at once have no law with tangential restitution",
    "wall and floor lock each other: not followed to its end",
    "its spin turns it round: it rolls back into the wall and meets it again",
)

UP: Vec = (0.0, 0.0, 1.0)
MOST_BOUNCES = 1_000_000
# Below this share of the speeds a slip is the rounding of a rolling ball.
ROUNDING = 1e-12


@hot_kernel
def rolls_at_last(v: Vec, w: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """Velocity and spin with which a ball that leaves the wall in (v, w) rolls, if it comes to roll."""
    # (39), with I = kappa m a^2
    c, d = 1 / (1 + kappa), 1 / a
    x = (v[0] + kappa * a * w[1]) * c
    y = (v[1] - kappa * a * w[0]) * c
    return (x, y, x - x), (-y * d, x * d, w[2])


@kernel
def fall(h: float, vz: float, g: float) -> float:
    """Time of flight from height h with vertical velocity vz back to the floor (g > 0 wherever it flies)."""
    if h == 0:
        return 2 * vz / g if vz > 0 else h
    return (vz + math.sqrt(vz * vz + 2 * g * h)) / g


@kernel
def _dips(c: float, u: float, b: float, t: float, path: float) -> bool:
    """Whether the distance c + u s + b s^2/2 falls below zero for an s in (0, t], by more than rounding on the path."""
    rounding = -ROUNDING * path
    if b > 0 and u < 0 and -u < b * t:
        return c - u * u / (2 * b) < rounding
    return c + u * t + b * t * t / 2 < rounding


@kernel
def _meets_wall(  # noqa: PLR0911  (one return a fate)
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, g: float, h: float
) -> int:
    """Follow flight, bounces and sliding: ROLLS, or how the ball meets the wall first. c is its distance from it."""
    t = fall(h, v[2], g)
    speed = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))
    path = speed * t
    if _dips(0 * t, dot(v, n), -g * n[2], t, path):
        return IN_FLIGHT
    c = (v[0] * n[0] + v[1] * n[1]) * t - h * n[2]
    v = (v[0], v[1], v[2] - g * t)
    still = -v[2] * 1e-15
    for _ in range(MOST_BOUNCES):
        if not v[2] < 0:
            break
        v, w, _j, _required, _regime = wall_contact(v, w, UP, a, kappa, e, mu, beta)
        if v[2] <= still:
            break
        t = 2 * v[2] / g
        path += speed * t
        if _dips(c, dot(v, n), -g * n[2], t, path):
            return BEFORE_ROLLING
        c += (v[0] * n[0] + v[1] * n[1]) * t
        v = (v[0], v[1], -v[2])
    else:
        return TOO_MANY
    _vz, s = slip_velocity((v[0], v[1], 0 * t), w, UP, a)
    slip = math.sqrt(s[0] * s[0] + s[1] * s[1])
    if slip > ROUNDING * (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))) and mu < math.inf:
        # Coulomb: the slip dies at the rate mu g (1 + 1/kappa); an infinite friction takes no time for it
        rate = mu * g * (1 + 1 / kappa)
        if not rate > 0:
            return NO_FRICTION
        t = slip / rate
        b = -mu * g * (s[0] * n[0] + s[1] * n[1]) / slip
        path += speed * t
        if _dips(c, v[0] * n[0] + v[1] * n[1], b, t, path):
            return BEFORE_ROLLING
        c += (v[0] * n[0] + v[1] * n[1]) * t + b * t * t / 2
    # On the floor and without slip: it rolls, away from the wall or back into it.
    last, _w = rolls_at_last(v, w, a, kappa)
    if last[0] * n[0] + last[1] * n[1] < -ROUNDING * speed:
        return BEFORE_ROLLING if c <= ROUNDING * path else ROLLS_BACK
    return ROLLS


@kernel
def _fate(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, g: float, h: float) -> int:
    """:func:`fate` where it is not plain."""
    if not g > 0 and h == 0 and v[2] < 0:  # pressed into the floor: it lands here and now, and only now
        v, w, _j, _required, _regime = wall_contact(v, w, UP, a, kappa, e, mu, beta)
    flies = h > 0 or v[2] != 0
    if flies and not g > 0:
        return NO_GRAVITY
    _vz, s = slip_velocity(v, w, UP, a)
    slips = math.sqrt(dot(s, s)) > ROUNDING * (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w)))
    if flies and e == 1:
        return BOUNCES
    if slips and mu == 0:
        return NO_FRICTION
    if slips and not g > 0:
        return NO_GRAVITY
    if not flies and not slips:
        speed = math.sqrt(dot(v, v))
        return BEFORE_ROLLING if v[0] * n[0] + v[1] * n[1] < -ROUNDING * speed else ROLLS
    return _meets_wall(v, w, n, a, kappa, e, mu, beta, g, h)


@hot_kernel
def fate(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, g: float, h: float) -> int:
    """Whether a ball that leaves the wall (normal n) in (v, w) at height h comes to roll: ROLLS, or why not.

    e, mu, beta are the floor's. The ball touches the wall: its distance from it starts at zero.
    """
    # The plain case: a vertical wall, a floor that rubs and does not return everything, and never overshoots. Then the
    # velocity away from the wall goes straight from its first value to its last: while both are positive the ball only
    # gets farther.
    if n[2] == 0 and mu > 0 and e < 1 and beta <= 0 and g > 0:
        last, _w = rolls_at_last(v, w, a, kappa)
        if v[0] * n[0] + v[1] * n[1] > 0 and last[0] * n[0] + last[1] * n[1] > 0:
            return ROLLS
    return _fate(v, w, n, a, kappa, e, mu, beta, g, h)
