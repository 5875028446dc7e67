"""Motion of a ball between two events: every phase has a constant acceleration, and so a closed form.

In flight the force is constant. On the floor, with gravity along its normal: a sliding ball's slip keeps its direction and
shrinks at the rate mu g (1 + 1/kappa), so the friction is constant until the slip ends; a rolling ball is slowed at the
rate c g, c the rolling resistance, along its path; spin about the vertical fades at the rate spin_friction g / (kappa a).

Sources: G. G. Coriolis, Théorie mathématique des effets du jeu de billard (1835), for sliding and the parabola; W. C.
Marlow, The Physics of Pocket Billiards (1995), for rolling resistance and pivoting.
"""

from __future__ import annotations

import math

from carom.core.contact import slip_velocity
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel
from carom.core.motion.rolling import UP, rolls_at_last

__all__ = [
    "BOUNCING", "FLIGHT", "HELD", "LEFT", "ON_FLOOR", "PHASES", "PIVOTING", "POCKETED", "REST", "ROLLING", "SLIDING",
    "accelerations", "advance", "grounded", "next_phase", "rolling_friction", "sliding_friction",
]  # fmt: skip

# The phases; what people see is PHASES[code]. A bouncing ball hops infinitely often in a finite time (motion.bounces); one
# that is held presses on a wall or a ball, one that left has left the table, one that is pocketed lies in a pocket: none of them
# is followed any further.
FLIGHT, SLIDING, ROLLING, PIVOTING, REST, BOUNCING, HELD, LEFT, POCKETED = range(9)
PHASES = ("flight", "sliding", "rolling", "pivoting", "rest", "bouncing", "held", "left", "pocketed")
ON_FLOOR = (False, True, True, True, True, False, False, False, False)

# Below this share of the speeds a slip is the rounding of a rolling ball.
ROUNDING = 1e-12


@hot_kernel
def sliding_friction(v: Vec, w: Vec, a: float, kappa: float, g: float, mu: float) -> tuple[float, float, float]:
    """Return the acceleration of a sliding ball, mu g against its slip, and the time until it rolls."""
    _un, u = slip_velocity(v, w, UP, a)
    slip = math.sqrt(u[0] * u[0] + u[1] * u[1])
    c = mu * g / slip if slip > 0 else v[0] - v[0]
    return -c * u[0], -c * u[1], slip / (mu * g * (1 + 1 / kappa)) if mu > 0 else math.inf


@hot_kernel
def rolling_friction(v: Vec, g: float, resistance: float) -> tuple[float, float, float]:
    """Return the acceleration of a rolling ball, by rolling resistance against its velocity, and the time until it stops."""
    speed = math.sqrt(v[0] * v[0] + v[1] * v[1])
    c = resistance * g / speed if speed > 0 else v[0] - v[0]
    return -c * v[0], -c * v[1], speed / (resistance * g) if resistance > 0 else math.inf


@hot_kernel
def accelerations(
    phase: int, v: Vec, w: Vec, a: float, kappa: float,
    force: Vec, g: float, mu: float, resistance: float, spin_friction: float,
) -> tuple[Vec, Vec, float]:  # fmt: skip
    """Return acceleration, angular acceleration, and the duration of the phase.

    ``force`` is the acceleration in flight; g presses the ball on the floor. The vertical part of the angular
    acceleration ends where that spin is gone (:func:`advance`), which changes nothing else.
    """
    zero = v[0] - v[0]
    nothing = (zero, zero, zero)
    if phase == FLIGHT:
        return force, nothing, math.inf
    if phase > PIVOTING or not g > 0:
        return nothing, nothing, math.inf
    fade = spin_friction * g / (kappa * a)
    turn = -fade if w[2] > 0 else (fade if w[2] < 0 else zero)
    if phase == SLIDING:
        if mu == math.inf:  # an infinitely rough floor ends the slip at once (next_phase)
            return nothing, nothing, zero
        x, y, lasts = sliding_friction(v, w, a, kappa, g, mu)
        # m dv/dt = F, I dw/dt = (-a z) x F
        return (x, y, zero), (y / (kappa * a), -x / (kappa * a), turn), lasts
    if phase == ROLLING:
        x, y, lasts = rolling_friction(v, g, resistance)
        # it continues to roll: w = z x v / a
        return (x, y, zero), (-y / a, x / a, turn), lasts
    return nothing, (zero, zero, turn), abs(w[2]) / fade if fade > 0 else math.inf


@hot_kernel
def advance(x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin a time s later in the same phase."""
    h = s * s / 2
    spin = w[2] + turn[2] * s
    if turn[2] * w[2] < 0 and spin * w[2] < 0:  # the spin about the vertical ended on the way
        spin = 0 * s
    return (
        (x[0] + v[0] * s + acc[0] * h, x[1] + v[1] * s + acc[1] * h, x[2] + v[2] * s + acc[2] * h),
        (v[0] + acc[0] * s, v[1] + acc[1] * s, v[2] + acc[2] * s),
        (w[0] + turn[0] * s, w[1] + turn[1] * s, spin),
    )


@kernel
def grounded(v: Vec, w: Vec, a: float, kappa: float, g: float, mu: float) -> tuple[int, Vec, Vec]:
    """Return the phase of a ball on the floor, and its velocity and spin without rounding errors."""
    zero = v[0] - v[0]
    v = (v[0], v[1], zero)
    if not g > 0:  # nothing presses it on the floor: it moves as if there were none
        return FLIGHT, v, w
    _un, u = slip_velocity(v, w, UP, a)
    slip = math.sqrt(u[0] * u[0] + u[1] * u[1])
    if slip > ROUNDING * (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))):
        return SLIDING, v, w
    if mu > 0:
        v, w = rolls_at_last(v, w, a, kappa)
    if v[0] != 0 or v[1] != 0:
        return ROLLING, v, w
    return (PIVOTING if w[2] != 0 else REST), (zero, zero, zero), (zero, zero, w[2])


@kernel
def next_phase(phase: int, v: Vec, w: Vec, a: float, kappa: float) -> tuple[int, Vec, Vec]:
    """Return the phase after one that has ended: after sliding, rolling; after rolling, pivoting or rest; after pivoting, rest."""
    zero = v[0] - v[0]
    if phase == SLIDING:
        v, w = rolls_at_last(v, w, a, kappa)
        if v[0] != 0 or v[1] != 0:
            return ROLLING, v, w
    if phase != PIVOTING and w[2] != 0:
        return PIVOTING, (zero, zero, zero), (zero, zero, w[2])
    return REST, (zero, zero, zero), (zero, zero, zero)
