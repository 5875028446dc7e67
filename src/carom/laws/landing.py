"""From the wall to rolling: the flight, the landings, and whether the ball rolls before it meets the wall again.

Every impulse of the floor acts at the floor's contact point, so the angular momentum about that point (more precisely its
two components (37) along the floor, and omega_z) is conserved. However the ball lands, bounces and slides, its final rolling
state is (39) of the state in which it left the wall. It remains to determine whether the ball reaches it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, Numbers, State, Surface, holds_arrays, kinetic_energy
from carom.core.contact import GRAZE, REGIMES, slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, prange
from carom.core.motion.phases import ROUNDING, UP, rolls_at_last
from carom.errors import FaultList, checked_number
from carom.formatting import format_length, format_number, format_time
from carom.laws.arrays import answer_rows, unit_normal
from carom.public.defaults import GRAVITY

Array = NDArray[np.float64]
Names = str | NDArray[np.str_]  # one text, or an array of them
FloorContact = Literal["with", "after"]
"""Order of the contacts of a ball that the wall presses on the floor: both at once, or the wall first and then the floor."""

PAPER_WALL = Surface(restitution=1.0, friction=math.inf)
PAPER_FLOOR = Surface(restitution=0.0, friction=math.inf)

# Regimes of an impact by code; the last three occur only with wall and floor at once.
REGIME_NAMES = np.array([*REGIMES, "jam", "stall", "undefined"])
# Why a ball does not come to roll, by the codes of carom.laws.landing; empty where it rolls.
WHY = (
    "",
    "without gravity the ball does not return to the floor",
    "the floor has no friction, so the ball slides for ever",
    "the floor has restitution 1, so the ball bounces for ever",
    "the ball meets the wall again in flight, before it lands",
    "the ball meets the wall again before it rolls, because its spin turns it round",
    "undecided after a million bounces",
    "no law with tangential restitution covers wall and floor at once",
    "the ball is locked between wall and floor, and the integration stopped",
    "its spin turns the ball round: it rolls back to the wall and meets it again",
)
REASONS = np.array([*WHY])


def name_codes(code: Any, names: NDArray[np.str_]) -> Names:
    """Return the names of integer codes (...): a string for one, an array of strings for many."""
    found = names[code]
    return str(found) if found.ndim == 0 else found


def as_column(x: Any) -> Any:
    """Return a number unchanged and an array (...) as (..., 1), to multiply vectors by it."""
    return x if type(x) is float or np.ndim(x) == 0 else np.asarray(x)[..., None]


def times_mass(impulse: Array, mass: Any) -> Array:
    """Return impulses (..., 3) per unit of mass, times the mass: in place where it is a number, without new memory."""
    if type(mass) is float:
        impulse *= mass
        return impulse
    found: Array = impulse * as_column(mass)
    return found


@dataclass(frozen=True, eq=False, repr=False)
class Impact:
    """One impact: the states before and after, impulse, required friction and regime. Shapes as in the state.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> hit = carom.impact(ball, carom.rolling(ball, (-1.0, 1.0)), surface=carom.Surface(friction=0.1))
    >>> hit.regime, round(float(hit.required_friction), 4), round(hit.energy_lost, 4)
    ('slide', 0.202, 0.0299)
    """

    ball: Ball
    before: State
    after: State
    impulse: Array
    """(..., 3), N s, on the ball."""
    required_friction: Numbers
    """(...): the least friction with which the contact sticks (if the floor acts too: the friction that was mobilised)."""
    code: int | NDArray[np.int8]
    """(...): the regime as an integer."""

    def __repr__(self) -> str:
        """Return one line: regime, impulse and required friction of one impact; of many their shape."""
        if np.ndim(self.code):
            return f"<Impact of shape {np.shape(self.code)}>"
        impulse = ", ".join(format_number(float(x)) for x in self.impulse)
        return f"<Impact: {self.regime}, impulse ({impulse}) N s, required friction {format_number(float(self.required_friction))}>"

    @property
    def regime(self) -> Names:
        """ "stick", "slide", "graze" (no impulse) or "jam" (wedged between wall and floor): a string or an array (...)."""
        return name_codes(self.code, REGIME_NAMES)

    @property
    def energy_lost(self) -> Numbers:
        """Kinetic energy lost, (...), J."""
        return kinetic_energy(self.ball, self.before) - kinetic_energy(self.ball, self.after)


@holds_arrays
@dataclass(frozen=True)
class Flight:
    """Flight between wall and floor; zeros where the ball does not leave the floor.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> flight = carom.two_step(ball, carom.rolling(ball, (-1.0, 1.0))).flight
    >>> round(1000 * flight.height, 2)
    4.16
    """

    duration: Numbers
    """(...), s."""
    height: Numbers
    """(...), m: largest height of the centre above its position when the ball rests on the floor."""
    distance: Numbers
    """(...), m, along the floor."""


@dataclass(frozen=True, eq=False)
class Settled:
    """Flight, landing and final rolling of a ball that leaves a wall. Shapes as in the state.

    Examples
    --------
    >>> import carom
    >>> found = carom.settle(carom.Ball(), carom.State((0.5, 0.5, 0.2), (0.0, 0.0, 0.0)))
    >>> bool(found.rolls), round(found.reflection_angle, 4)
    (True, 0.7854)
    """

    normal: Array
    """(..., 3), of the wall, unit length."""
    flight: Flight
    after_floor: State
    """After the first landing; the state itself where the ball was not lifted."""
    floor: Impact
    """The first landing."""
    rolling: State
    """The state once the ball rolls again; NaN where ``rolls`` is False."""
    rolls: bool | NDArray[np.bool_]
    """(...): whether the ball comes to roll before it meets the wall again."""
    why_code: int | NDArray[np.int8]
    """(...): why it does not, as an integer; 0 where it rolls."""

    @property
    def why(self) -> Names:
        """Why the ball does not come to roll, a text or an array (...) of them; empty where it rolls."""
        return name_codes(self.why_code, REASONS)

    @property
    def reflection_angle(self) -> Numbers:
        """Angle (...) between the final velocity and the wall's normal, both projected on the floor, rad."""
        return angle_from(self.normal, self.rolling)


@dataclass(frozen=True, eq=False, repr=False)
class TwoStep(Settled):
    """Prediction of the two-step law, step by step. Shapes as in the state.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> steps = carom.two_step(ball, carom.rolling(ball, (-1.0, 1.0)))
    >>> steps.wall.regime, steps.floor.regime, bool(steps.rolls)
    ('stick', 'stick', True)
    """

    after_wall: State
    """Velocity and spin just after the wall; where a pressed ball moves down here, it lands at once (:attr:`after_floor`)."""
    wall: Impact
    """The contact with the wall."""
    floor_impulse: Array
    """(..., 3), N s: impulse of the floor during the wall contact (for a ball that the wall presses down)."""

    def __repr__(self) -> str:
        """Return one line: final angle, flight, and what the contacts did; of many balls their shape."""
        if self.after_wall.shape:
            return f"<TwoStep of shape {self.after_wall.shape}>"
        flight = f"flight {format_time(float(self.flight.duration))}, {format_length(float(self.flight.height))} high"
        end = (
            f"reflected at {format_number(math.degrees(self.reflection_angle), 4)} degrees"
            if self.rolls
            else str(self.why)
        )
        return f"<TwoStep: {end}, {flight}, wall {self.wall.regime}, floor {self.floor.regime}>"


def angle_from(normal: Array, state: State, *, incoming: bool = False) -> Numbers:
    """Angle (...) of a velocity along the floor from the normal, rad: 0 normal, pi/2 along the wall, more towards it.

    NaN where the normal is vertical.
    """
    with np.errstate(invalid="ignore"):
        level = normal[..., :2] / np.sqrt((normal[..., :2] ** 2).sum(axis=-1, keepdims=True))
    x, y = state.velocity[..., 0], state.velocity[..., 1]
    along = np.abs(level[..., 0] * y - level[..., 1] * x)
    out = level[..., 0] * x + level[..., 1] * y
    angle = np.arctan2(along, -out if incoming else out)
    return float(angle) if angle.ndim == 0 else angle


# ----------------------------------------------------------------------------------------------------
# From the wall to rolling: the flight, the landings, and whether the ball rolls before it meets the wall again.


# Whether a ball that left the wall comes to roll, or why not; the texts are WHY[code] of carom.laws.landing.
ROLLS, NO_GRAVITY, NO_FRICTION, BOUNCES, IN_FLIGHT = 0, 1, 2, 3, 4
BEFORE_ROLLING, TOO_MANY, NO_LAW, LOST, ROLLS_BACK = 5, 6, 7, 8, 9

MOST_BOUNCES = 1_000_000


@kernel
def fall_time(h: float, vz: float, g: float) -> float:
    """Time of flight from height h with vertical velocity vz back to the floor (g > 0 is assumed)."""
    if h == 0:
        return 2 * vz / g if vz > 0 else h
    return (vz + math.sqrt(vz * vz + 2 * g * h)) / g


@kernel
def _falls_below_zero(c: float, u: float, b: float, t: float, path: float) -> bool:
    """Whether the distance c + u s + b s^2/2 falls below zero for an s in (0, t], by more than rounding on the path."""
    rounding = -ROUNDING * path
    if b > 0 and u < 0 and -u < b * t:
        return c - u * u / (2 * b) < rounding
    return c + u * t + b * t * t / 2 < rounding


@kernel
def _meets_wall(  # noqa: PLR0911  (one return per outcome)
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, g: float, h: float
) -> int:
    """Follow flight, bounces and sliding; return ROLLS, or how the ball meets the wall first. c: distance from the wall."""
    t = fall_time(h, v[2], g)
    speed = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))
    path = speed * t
    if _falls_below_zero(0 * t, dot(v, n), -g * n[2], t, path):
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
        if _falls_below_zero(c, dot(v, n), -g * n[2], t, path):
            return BEFORE_ROLLING
        c += (v[0] * n[0] + v[1] * n[1]) * t
        v = (v[0], v[1], -v[2])
    else:
        return TOO_MANY
    _vz, s = slip_velocity((v[0], v[1], 0 * t), w, UP, a)
    slip = math.sqrt(s[0] * s[0] + s[1] * s[1])
    if slip > ROUNDING * (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))) and mu < math.inf:
        # Coulomb: the slip decreases at the rate mu g (1 + 1/kappa); with infinite friction it vanishes at once
        rate = mu * g * (1 + 1 / kappa)
        if not rate > 0:
            return NO_FRICTION
        t = slip / rate
        b = -mu * g * (s[0] * n[0] + s[1] * n[1]) / slip
        path += speed * t
        if _falls_below_zero(c, v[0] * n[0] + v[1] * n[1], b, t, path):
            return BEFORE_ROLLING
        c += (v[0] * n[0] + v[1] * n[1]) * t + b * t * t / 2
    # On the floor and without slip: it rolls, away from the wall or back into it.
    last, _w = rolls_at_last(v, w, a, kappa)
    if last[0] * n[0] + last[1] * n[1] < -ROUNDING * speed:
        return BEFORE_ROLLING if c <= ROUNDING * path else ROLLS_BACK
    return ROLLS


@kernel
def _general_outcome(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, g: float, h: float
) -> int:
    """:func:`outcome_after_wall` in the general case."""
    if not g > 0 and h == 0 and v[2] < 0:  # pressed into the floor: it lands at once and never again
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
def outcome_after_wall(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, g: float, h: float
) -> int:
    """Return whether a ball that leaves the wall (normal n) with (v, w) at height h comes to roll: ROLLS, or why not.

    e, mu, beta are the floor's. The ball touches the wall: its distance from the wall starts at zero.
    """
    # The simple case: a vertical wall and a floor with friction, e < 1 and beta <= 0. Then the velocity away from the wall
    # changes monotonically from its first value to its last: if both are positive, the ball only moves away.
    if n[2] == 0 and mu > 0 and e < 1 and beta <= 0 and g > 0:
        last, _w = rolls_at_last(v, w, a, kappa)
        if v[0] * n[0] + v[1] * n[1] > 0 and last[0] * n[0] + last[1] * n[1] > 0:
            return ROLLS
    return _general_outcome(v, w, n, a, kappa, e, mu, beta, g, h)


@kernel
def second_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, ef: float, muf: float, betaf: float, g: float, h: float
) -> tuple[float, float, float, Vec, Vec, Vec, float, int, Vec, Vec, int]:
    """Compute flight, landing and rolling of a ball that leaves a wall (normal n) with (v, w) at height h.

    Returns flight (duration, height, distance), landing (velocity, spin, impulse per mass, required friction, regime),
    rolling state (velocity, spin; NaN if the ball does not roll) and the code of the reason.
    """
    zero = v[0] - v[0]
    none = (zero, zero, zero)
    x = math.nan
    missing = (x, x, x)
    if v[0] != v[0]:
        return x, x, x, missing, missing, missing, x, GRAZE, missing, missing, LOST
    if h == 0 and abs(v[2]) <= ROUNDING * (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))):
        v = (v[0], v[1], zero)  # a vertical velocity of the size of rounding does not lift the ball
    why = outcome_after_wall(v, w, n, a, kappa, ef, muf, betaf, g, h)
    v3, w3 = rolls_at_last(v, w, a, kappa) if why == ROLLS else (missing, missing)
    if not (h > 0 or v[2] != 0):  # it never left the floor
        return zero, zero, zero, v, w, none, zero, GRAZE, v3, w3, why
    if why == IN_FLIGHT:
        return x, x, x, missing, missing, missing, x, GRAZE, v3, w3, why
    if why == NO_GRAVITY and not (h == 0 and v[2] < 0):
        return math.inf, math.inf, math.inf, missing, missing, missing, x, GRAZE, v3, w3, why
    t = fall_time(h, v[2], g)
    rise = h + v[2] * v[2] / (2 * g) if v[2] > 0 else h + zero
    far = t * math.sqrt(v[0] * v[0] + v[1] * v[1])
    down = -abs(v[2]) if h == 0 else v[2] - g * t
    v2, w2, j, required, regime = wall_contact((v[0], v[1], down), w, UP, a, kappa, ef, muf, betaf)
    return t, rise, far, v2, w2, j, required, regime, v3, w3, why


@hot_kernel
def rolling_after(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, ef: float, muf: float, betaf: float, g: float, h: float
) -> tuple[Vec, Vec, int]:
    """Rolling state (NaN if there is none) of a ball that leaves the wall (normal n) with (v, w), and the reason's code."""
    why = outcome_after_wall(v, w, n, a, kappa, ef, muf, betaf, g, h)
    if why == ROLLS:
        # (39)
        v3, w3 = rolls_at_last(v, w, a, kappa)
        return v3, w3, why
    x = math.nan
    return (x, x, x), (x, x, x), why


def second_rows(
    v: Array, w: Array, n: Array, p: Array,
    t: Array, rise: Array, far: Array, v2: Array, w2: Array, j: Array, required: Array, regime: Any,
    v3: Array, w3: Array, why: Any,
) -> None:  # fmt: skip
    """Compute flight, landing and rolling per row; parameters a, kappa, the floor's e, mu, beta, gravity, height."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k, q = i * sn, i * sp
        t[i], rise[i], far[i], x, y, z, required[i], regime[i], r, s, why[i] = second_impact(
            (v[i, 0], v[i, 1], v[i, 2]),
            (w[i, 0], w[i, 1], w[i, 2]),
            (n[k, 0], n[k, 1], n[k, 2]),
            p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4], p[q, 5], p[q, 6],
        )  # fmt: skip
        v2[i, 0], v2[i, 1], v2[i, 2] = x
        w2[i, 0], w2[i, 1], w2[i, 2] = y
        j[i, 0], j[i, 1], j[i, 2] = z
        v3[i, 0], v3[i, 1], v3[i, 2] = r
        w3[i, 0], w3[i, 1], w3[i, 2] = s


def landing_settings(
    gravity: float, height: ArrayLike, floor_contact: str, where: str = "two_step"
) -> tuple[float, Any, bool]:
    """Validate gravity, height and floor_contact; return the numbers, and whether wall and floor act at once."""
    faults = FaultList(where)
    g = checked_number(faults, "gravity", gravity, "a number >= 0 in m/s^2", lambda x: x >= 0)
    h = checked_number(faults, "height", height, "a length >= 0 in m", lambda x: x >= 0)
    if floor_contact not in ("with", "after"):
        expected = "'with' (wall and floor at once) or 'after' (first the wall, then the floor)"
        faults.add("floor_contact", expected, repr(floor_contact))
    faults.raise_if_any()
    return g, h, floor_contact == "with"


def settle(
    ball: Ball,
    state: State,
    floor: Surface = PAPER_FLOOR,
    normal: ArrayLike = (1.0, 0.0, 0.0),
    gravity: float = GRAVITY,
    height: ArrayLike = 0.0,
) -> Settled:
    """Compute flight, first landing and the final rolling state of a ball that leaves a wall.

    Source: the paper, section 3.3, (32)-(39).

    Parameters
    ----------
    ball : Ball
        Radius (m), mass (kg) and moment of inertia.
    state : State
        Velocity (m/s) and spin (rad/s) just after the wall, shape (...).
    floor : Surface
        Default: the paper's, e = 0, sticking.
    normal : array (..., 3)
        Of the wall, to determine whether the ball meets it again before it rolls.
    gravity : float
        m/s^2.
    height : float or array (...)
        Of the centre above its position when the ball rests on the floor, m.

    Returns
    -------
    Settled
        Flight, landing and rolling state, of shape (...).

    Raises
    ------
    CaromError
        For a negative gravity or height, and for shapes that do not broadcast.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> lifted = carom.State((0.5, 0.5, 0.2), (0.0, 0.0, 0.0))
    >>> found = carom.settle(ball, lifted)
    >>> round(float(found.flight.duration), 4), bool(found.rolls)
    (0.0408, True)
    """
    g, h, _together = landing_settings(gravity, height, "with")
    return settle_checked(ball, state, floor, unit_normal(normal), g, h)


def settle_checked(ball: Ball, state: State, floor: Surface, n: Array, g: float, h: Any) -> Settled:
    """:func:`settle` with validated arguments."""
    parameters = (ball.radius, ball.kappa, floor.restitution, floor.friction, floor.tangential_restitution, g, h)
    t, rise, far, v2, w2, j, required, code, v3, w3, why = answer_rows(
        second_impact, second_rows, "xxxvvvxcvvc", (state.velocity, state.spin, n), parameters
    )
    after = State.of(v2, w2)
    landing = state
    # the state just before the landing: spin unchanged, vertical velocity from the flight
    if v2.ndim > 1:
        landing = State.of(v2 - j, np.broadcast_to(state.spin, v2.shape))
    elif code:
        landing = State.of(v2 - j, state.spin)
    return Settled(
        normal=n,
        flight=Flight(t, rise, far),
        after_floor=after,
        floor=Impact(ball, landing, after, times_mass(j, ball.mass), required, code),
        rolling=State.of(v3, w3),
        rolls=why == ROLLS,
        why_code=why,
    )
