"""Motion of a ball between two events: every phase has an acceleration that is constant or decays exponentially: a closed form.

In flight the force is constant. On the floor, with gravity along its normal: a sliding ball's slip keeps its direction and
shrinks at the rate mu g (1 + 1/kappa), so the friction is constant until the slip ends; a rolling ball is slowed at the
rate (c + d v) g, c the rolling resistance and d its rise with the speed, along its path; spin about the vertical fades at the
rate spin_friction g / (kappa a) + spin_damping |omega_z|, and while the ball rolls spin_drag v more.

Sources: G. G. Coriolis, Théorie mathématique des effets du jeu de billard (1835), for sliding and the parabola; W. C.
Marlow, The Physics of Pocket Billiards (1995), for rolling resistance and pivoting; T. Pöschel, T. Schwager & N. V.
Brilliantov, Eur. Phys. J. B 10, 169 (1999), for a rolling resistance of a viscous surface that is proportional to the speed.
"""

from __future__ import annotations

import math

from carom.core.contact import slip_velocity
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, steepest
from carom.core.motion.decay import decay_integrals, time_of_integral
from carom.core.motion.rolling import UP, rolls_at_last

__all__ = [
    "BOUNCING", "FLIGHT", "HELD", "LEFT", "ON_FLOOR", "PHASES", "PIVOTING", "POCKETED", "REST", "ROLLING", "SLIDING",
    "accelerations", "acts", "advance", "advance_decaying", "decays", "grounded", "next_phase", "rolling_friction",
    "sliding_friction",
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
def acts(x: float) -> bool:
    """Return whether a number that is zero by default is another one, or has derivatives."""
    return bool(x > 0 or steepest(x) > 0)


@hot_kernel
def rolling_friction(v: Vec, g: float, resistance: float, drag: float) -> tuple[float, float, float]:
    """Return the acceleration of a rolling ball, by rolling resistance against its velocity, and the time until it stops."""
    speed = math.sqrt(v[0] * v[0] + v[1] * v[1])
    c = (resistance + drag * speed) * g / speed if speed > 0 else v[0] - v[0]
    lasts = speed / (resistance * g) if resistance > 0 else math.inf
    if resistance > 0 and acts(drag):
        lasts = time_of_integral(drag * g, speed / ((resistance + drag * speed) * g))
    return -c * v[0], -c * v[1], lasts


@hot_kernel
def accelerations(
    phase: int, v: Vec, w: Vec, a: float, kappa: float,
    force: Vec, g: float, mu: float, resistance: float, spin_friction: float,
    drag: float = 0.0, spin_damping: float = 0.0, spin_drag: float = 0.0,
) -> tuple[Vec, Vec, float]:  # fmt: skip
    """Return acceleration, angular acceleration (how they change: :func:`decays`), and the duration of the phase.

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
    if acts(spin_damping):
        fade = fade + spin_damping * abs(w[2])
    if phase == ROLLING and acts(spin_drag):
        fade = fade + spin_drag * math.sqrt(v[0] * v[0] + v[1] * v[1])
    turn = -fade if w[2] > 0 else (fade if w[2] < 0 else zero)
    if phase == SLIDING:
        if mu == math.inf:  # an infinitely rough floor ends the slip at once (next_phase)
            return nothing, nothing, zero
        x, y, lasts = sliding_friction(v, w, a, kappa, g, mu)
        # m dv/dt = F, I dw/dt = (-a z) x F
        return (x, y, zero), (y / (kappa * a), -x / (kappa * a), turn), lasts
    if phase == ROLLING:
        x, y, lasts = rolling_friction(v, g, resistance, drag)
        # it continues to roll: w = z x v / a
        return (x, y, zero), (-y / a, x / a, turn), lasts
    lasts = abs(w[2]) / fade if fade > 0 else math.inf
    if acts(spin_damping):
        lasts = time_of_integral(spin_damping, lasts) if spin_friction > 0 else math.inf + zero
    return nothing, (zero, zero, turn), lasts


@kernel
def decays(
    phase: int, v: Vec, w: Vec, acc: Vec, g: float, drag: float, spin_damping: float, spin_drag: float
) -> tuple[float, float, float]:
    """Return how accelerations change in a phase: rates, 1/s, of decay of that of the centre and that of omega_z, and a gain.

    The gain, rad/s^3, is what the decay of a rolling ball's speed takes from the deceleration of omega_z; at most one of it and the
    rate of omega_z is not zero.
    """
    zero = v[0] - v[0]
    fade = spin_fade = gain = zero
    if g > 0 and SLIDING <= phase <= PIVOTING:
        spin_fade = spin_damping + zero
        if phase == ROLLING:
            fade = drag * g + zero
            rise = spin_drag * math.sqrt(dot(acc, acc))
            gain = rise if w[2] > 0 else (-rise if w[2] < 0 else zero)
    return fade, spin_fade, gain


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
def advance_decaying(
    x: Vec, v: Vec, w: Vec, acc: Vec, turn: Vec, fade: float, spin_fade: float, gain: float, s: float
) -> tuple[Vec, Vec, Vec]:
    """:func:`advance` where the accelerations change (:func:`decays`)."""
    _rest, once, twice = decay_integrals(fade, s)
    _rest, spins, _twice = decay_integrals(spin_fade, s)
    spin = w[2] + turn[2] * spins + gain * twice
    if turn[2] * w[2] < 0 and spin * w[2] < 0:
        spin = 0 * s
    return (
        (x[0] + v[0] * s + acc[0] * twice, x[1] + v[1] * s + acc[1] * twice, x[2] + v[2] * s + acc[2] * twice),
        (v[0] + acc[0] * once, v[1] + acc[1] * once, v[2] + acc[2] * once),
        (w[0] + turn[0] * once, w[1] + turn[1] * once, spin),
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
