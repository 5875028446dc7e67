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

from carom.core.contact import one_contact, slip_velocity
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, root_of, steepest, without_slopes

UP: Vec = (0.0, 0.0, 1.0)  # normal of the floor


@hot_kernel
def rolls_at_last(v: Vec, w: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """Return velocity and spin of the rolling that a ball in the state (v, w) comes to, if it comes to roll.

    Friction at the floor's contact point conserves the angular momentum about that point and omega_z.
    """
    # (37), (38), solved for velocity and spin: (39), with I = kappa m a^2
    c, d = 1 / (1 + kappa), 1 / a
    x = (v[0] + kappa * a * w[1]) * c
    y = (v[1] - kappa * a * w[0]) * c
    return (x, y, x - x), (-y * d, x * d, w[2])


# ----------------------------------------------------------------------------------------------------
# Restitution as a function of the normal speed: constant, or one of a few published forms.
#
# A form is a code and three numbers. Every form is held in [0, 1] and is monotone in the speed as far as it is meant to go.


CONSTANT, POLYNOMIAL, POWER, VISCOELASTIC, EXPONENTIAL = range(5)
FORMS = ("constant", "polynomial", "power", "viscoelastic", "exponential")


@hot_kernel
def restitution(form: int, p: Vec, speed: float) -> float:
    """Return e at a normal speed of approach (m/s, >= 0)."""
    return p[0] if form == CONSTANT else _of_speed(form, p, speed)


@kernel
def _of_speed(form: int, p: Vec, speed: float) -> float:
    zero = 0 * speed
    if form == POLYNOMIAL:
        # Han, J. Mech. Sci. Technol. 19, 976 (2005), eq. 26, a carom cushion: 0.39 + 0.257 v - 0.044 v^2. Beyond its vertex,
        # where nothing was measured, it stays what it is there
        v = speed
        if p[2] != 0 and p[1] * p[2] < 0:
            v = min(speed, -p[1] / (2 * p[2]))
        e = p[0] + p[1] * v + p[2] * v * v
    elif form == POWER:
        # Johnson, Contact Mechanics (1985), 11.5: plastic impact, e = p0 (v / p1)^-p2, p2 = 1/4; p0 below the speed p1
        e = p[0] * math.exp(-p[2] * math.log(speed / p[1])) if speed > p[1] else p[0] + zero
    elif form == VISCOELASTIC:
        # Ramirez, Poschel, Brilliantov & Schwager, Phys. Rev. E 60, 4465 (1999): 1 - C v^1/5 + 3/5 C^2 v^2/5 - ...; as the
        # Pade form that stays positive: 1 / (1 + C v^1/5 + 2/5 C^2 v^2/5)
        c = p[0] * math.exp(math.log(speed) / 5) if speed > 0 else zero
        e = 1 / (1 + c + 2 * c * c / 5)
    else:
        # EXPONENTIAL, a convenience for fits: from p0 at rest to p1 at great speed, over the speed p2
        e = p[1] + (p[0] - p[1]) * math.exp(-speed / p[2])
    return min(max(e, zero), 1 + zero)


# ----------------------------------------------------------------------------------------------------
# Sum infinitely many bounces in a finite time (Zeno), to the last bit.
#
# A ball on a floor of restitution e < 1 bounces ever lower: its bounces last 2 v_z/g, 2 e v_z/g, ... and end after
# 2 v_z/(g (1 - e)). Each landing rubs, so velocity and spin change with every one, from slip to stick and, with tangential
# restitution, perhaps back. The series is followed hop by hop, without events, until what is left is below the rounding of
# the sums, and that is added as a geometric series: nothing is cut off, and e may depend on the speed (its limit closes the
# series).


# Hops below this share of the first are closed by the geometric series: their sums are below rounding.
LAST_HOP = 1e-18
# Where e is so near 1 that the hops do not shrink to that: the geometric series of what is left.
MOST_HOPS = 10_000_000


@kernel
def series_lasts(vz: float, g: float, form: int, p: Vec) -> float:
    """Return an upper bound of the time for which a ball that leaves the floor with v_z bounces; infinite if it has no end."""
    # every form is monotone: the largest e on the way is at one of the ends
    e = restitution(form, p, vz)
    most = max(e, restitution(form, p, 0 * vz))
    if most < 1:
        return 2 * vz / (g * (1 - most))
    # e tends to 1 as the ball comes to rest, and yet the hops end where 1 - e falls no faster than v^1/5: the sum of the
    # speeds is at most the integral of dv / (1 - e), and one hop more
    return 2 * (vz + 5 * vz / (4 * (1 - e))) / g if form == VISCOELASTIC and e < 1 else math.inf


@kernel
def bounces(
    x: Vec, v: Vec, w: Vec, a: float, kappa: float, g: float, form: int, p: Vec, mu: float, beta: float, until: float
) -> tuple[Vec, Vec, Vec, float]:
    """Follow a ball that leaves the floor (its lowest point there, v_z > 0) for a time ``until``, or to its last bounce.

    Returns position, velocity, spin and the time that passed: ``until``, or the time at which it stays on the floor.
    """
    t = 0 * g
    first = v[2]
    for _ in range(MOST_HOPS):
        hop = 2 * v[2] / g
        if t + hop > until:
            s = until - t
            return (
                (x[0] + v[0] * s, x[1] + v[1] * s, x[2] + v[2] * s - g * s * s / 2),
                (v[0], v[1], v[2] - g * s),
                w,
                until,
            )
        if v[2] <= LAST_HOP * first:
            break
        t += hop
        x = (x[0] + v[0] * hop, x[1] + v[1] * hop, x[2])
        e = restitution(form, p, v[2])
        v, w, _j, _required, _regime = one_contact((v[0], v[1], -v[2]), w, UP, a, kappa, e, mu, beta)
    if v[2] > 0:
        e = restitution(form, p, v[2])
        rest = 2 * v[2] / (g * (1 - e))
        t += rest
        x = (x[0] + v[0] * rest, x[1] + v[1] * rest, x[2])
    return x, (v[0], v[1], 0 * g), w, t


# ----------------------------------------------------------------------------------------------------
# Motion whose acceleration decays exponentially: its integrals, and the times at which they reach a value, to rounding.
#
# A resistance that grows with the speed, v' = -(A + B v), makes the acceleration decay as exp(-B s); a torque that grows with the
# spin does the same to the angular acceleration. All is + - * / alone, so that Python, compiled code and the page have the same
# bits.


LARGEST_SERIES = 0.5  # of k s: beyond, the integrals of a half are doubled
TERMS = 14  # of the series: the next one is below 1e-18
FADED = 700.0  # of k s: nothing is left
MOST_STEPS = 200


@kernel
def decay_integrals(k: float, s: float) -> tuple[float, float, float]:
    """Return exp(-k s), its integral from 0 to s, and the integral of that; 1, s and s^2/2 where k = 0."""
    z = k * s
    if not z <= FADED:
        return 0 * k, 1 / k, (s - 1 / k) / k
    halvings = 0
    while z > LARGEST_SERIES:
        z, s, halvings = z / 2, s / 2, halvings + 1
    # (exp(-z) - 1 + z) / z^2 = 1/2 (1 - z/3 (1 - z/4 (1 - ...)))
    p = 1 - z / (TERMS + 3)
    for i in range(TERMS):
        p = 1 - z * p / (TERMS + 2 - i)
    p = p / 2
    once = 1 - z * p
    rest, once, twice = 1 - z * once, s * once, s * s * p
    for _ in range(halvings):
        # over 2 s, from s on all is exp(-k s) of what it was: the terms are positive, and nothing cancels
        twice = twice + once * s + rest * twice
        once = once + rest * once
        rest, s = rest * rest, 2 * s
    return rest, once, twice


@kernel
def time_of_integral(k: float, y: float) -> float:
    """Return the time at which the integral of exp(-k s) is y >= 0, where a speed that falls so is gone; or infinity."""
    rate, value = without_slopes(k), without_slopes(y)
    if not rate * value < 1:
        return math.inf + 0 * y
    # the integral is concave: Newton's steps from the left stay there
    s = value
    for _ in range(MOST_STEPS):
        rest, once, _twice = decay_integrals(rate, s)
        step = (value - once) / rest
        if not step > 1e-16 * s:
            break
        s = s + step
    rest, once, _twice = decay_integrals(k, s + 0 * y)
    found: float = root_of(s, once - y, rest)
    return found


@kernel
def time_of_path(k: float, c: float, path: float, until: float) -> float:
    """Return the time in [0, until] at which a ball has come as far as it would in the time ``path`` with its first speed.

    Its speed is 1 - c (integral of exp(-k s)) of the first one: c is its first deceleration over that. At most ``until``.
    """
    s = path
    for _ in range(MOST_STEPS):
        _rest, once, twice = decay_integrals(k, s)
        speed = 1 - c * once
        if not speed > 0:
            return until
        step = (path - (s - c * twice)) / speed
        if not step > 1e-16 * s:
            break
        s = s + step
        if not s < until:
            return until
    return min(s, until)


# ----------------------------------------------------------------------------------------------------
# Motion of a ball between two events: every phase has an acceleration that is constant or decays exponentially: a closed form.


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
