"""The two-step law: the wall, the flight, the floor.

The paper, section 3, (27)-(41), for any ball, any wall, any state, with the friction and restitution that wall and floor
really have. Step one is the wall's contact (31), or wall and floor at once where the wall presses the ball down. Step two
is the flight and the landing (39), or the sliding of a ball that was not lifted. What follows, further bounces and
sliding until the ball rolls, cannot change the rolling state: see :mod:`carom.laws.landing`.
"""

from __future__ import annotations

import math

from carom.kernel import Vec, dot, hot_kernel, kernel
from carom.laws.card import Card
from carom.laws.contact import GRAZE, slip_velocity, wall_contact
from carom.laws.landing import IN_FLIGHT, LOST, NO_GRAVITY, NO_LAW, ROLLS, ROUNDING, UP, fall, fate, rolls_at_last
from carom.laws.simultaneous import LEAST_FIRM, STALL, pressed_down, wall_and_floor

__all__ = ["CARD", "UNDEFINED", "first_impact", "rolling_after", "second_impact", "two_step_final", "two_step_plain"]

CARD = Card(
    name="two-step",
    summary="The wall's friction lifts the ball off the floor; it flies, lands, slides and rolls, contact by contact.",
    assumptions=(
        "each contact is one impact with restitution e, Coulomb friction mu and tangential restitution beta",
        "a ball that the wall presses on the floor meets both at once, the floor rigid (or, by name, one after the other)",
        "the floor's friction acts only at its contact point: no pivoting friction, no rolling resistance",
    ),
    valid="Any ball, wall and state; the default. With e = 1 at the wall, e = 0 at the floor and both sticking it is the"
    " paper's law.",
    equations="(27)-(41)",
    citation="The paper, section 3; O. R. Walton & R. L. Braun, J. Rheol. 30, 949-980 (1986), for the contact.",
    doi="10.1122/1.549893",
)

# The wall presses the ball down and rebounds tangentially: there is no such law for two contacts at once.
UNDEFINED = 5

Impulsive = tuple[Vec, Vec, Vec, Vec, float, int]


@kernel
def _pressed(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float,
) -> Impulsive:  # fmt: skip
    """:func:`first_impact` of a ball that the wall presses on the floor."""
    smooth = beta == -1 or mu == 0
    if not smooth and beta != 0:
        x = math.nan
        return (x, x, x), (x, x, x), (x, x, x), (x, x, x), x, UNDEFINED
    v1, w1, j, jf, regime = wall_and_floor(v, w, n, a, kappa, e, 0 * mu if smooth else mu, ef, muf, betaf)
    if regime == STALL:
        x = math.nan
        return (x, x, x), (x, x, x), j, jf, x, regime
    # With the floor's help there is no one friction that would just have held: what was used stands for it.
    jn = dot(j, n)
    ft = (j[0] - jn * n[0], j[1] - jn * n[1], j[2] - jn * n[2])
    rubbed = math.sqrt(dot(ft, ft))
    if rubbed > 0 and not rubbed < LEAST_FIRM / 2 * jn:  # an infinite friction that had to be one
        return v1, w1, j, jf, math.inf, regime
    return v1, w1, j, jf, rubbed / jn if rubbed > 0 else rubbed, regime


@hot_kernel
def first_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, h: float, together: bool,
) -> Impulsive:  # fmt: skip
    """Velocity and spin after the wall, impulse (per mass) of the wall and of the floor, required friction, regime."""
    if together and pressed_down(v, w, n, a, mu, h):
        return _pressed(v, w, n, a, kappa, e, mu, beta, ef, muf, betaf)
    zero = v[0] - v[0]
    v1, w1, j, required, regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    return v1, w1, j, (zero, zero, zero), required, regime


@kernel
def second_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, ef: float, muf: float, betaf: float, g: float, h: float
) -> tuple[float, float, float, Vec, Vec, Vec, float, int, Vec, Vec, int]:
    """What the floor makes of a ball that leaves a wall (normal n) in (v, w) at height h.

    Flight (duration, height, distance), landing (velocity, spin, impulse per mass, required friction, regime), rolling
    state (velocity, spin; NaN where there is none) and why there is none.
    """
    zero = v[0] - v[0]
    none = (zero, zero, zero)
    x = math.nan
    missing = (x, x, x)
    if v[0] != v[0]:
        return x, x, x, missing, missing, missing, x, GRAZE, missing, missing, LOST
    if h == 0 and abs(v[2]) <= ROUNDING * (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))):
        v = (v[0], v[1], zero)  # rounding is no hop
    why = fate(v, w, n, a, kappa, ef, muf, betaf, g, h)
    v3, w3 = rolls_at_last(v, w, a, kappa) if why == ROLLS else (missing, missing)
    if not (h > 0 or v[2] != 0):  # it never left the floor
        return zero, zero, zero, v, w, none, zero, GRAZE, v3, w3, why
    if why == IN_FLIGHT:
        return x, x, x, missing, missing, missing, x, GRAZE, v3, w3, why
    if why == NO_GRAVITY and not (h == 0 and v[2] < 0):
        return math.inf, math.inf, math.inf, missing, missing, missing, x, GRAZE, v3, w3, why
    t = fall(h, v[2], g)
    rise = h + v[2] * v[2] / (2 * g) if v[2] > 0 else h + zero
    far = t * math.sqrt(v[0] * v[0] + v[1] * v[1])
    down = -abs(v[2]) if h == 0 else v[2] - g * t
    v2, w2, j, required, regime = wall_contact((v[0], v[1], down), w, UP, a, kappa, ef, muf, betaf)
    return t, rise, far, v2, w2, j, required, regime, v3, w3, why


@hot_kernel
def two_step_plain(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, together: bool,
) -> tuple[Vec, Vec, bool]:  # fmt: skip
    """:func:`two_step_final` of a ball that is plainly not pressed down and plainly comes to roll; else False.

    It has no branches, so that a compiled loop answers four balls at once; what it leaves open is asked again in full.
    """
    _un, ut = slip_velocity(v, w, n, a)
    v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    # (39)
    v3, w3 = rolls_at_last(v1, w1, a, kappa)
    floor_is_plain = (n[2] == 0) & (muf > 0) & (ef < 1) & (betaf <= 0) & (g > 0)
    lifted = (not together) | ((v[2] >= 0) & (ut[2] <= 0))
    leaves = (v1[0] * n[0] + v1[1] * n[1] > 0) & (v3[0] * n[0] + v3[1] * n[1] > 0)
    return v3, w3, floor_is_plain & lifted & leaves


@hot_kernel
def two_step_final(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, h: float, together: bool,
) -> tuple[Vec, Vec, int]:  # fmt: skip
    """Velocity and spin of the ball once it rolls again, and why it does not (then they are NaN)."""
    v1, w1, _j, _jf, _required, regime = first_impact(v, w, n, a, kappa, e, mu, beta, ef, muf, betaf, h, together)
    if regime == UNDEFINED:
        x = math.nan
        return (x, x, x), (x, x, x), NO_LAW
    if regime == STALL:
        x = math.nan
        return (x, x, x), (x, x, x), LOST
    return rolling_after(v1, w1, n, a, kappa, ef, muf, betaf, g, h)


@hot_kernel
def rolling_after(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, ef: float, muf: float, betaf: float, g: float, h: float
) -> tuple[Vec, Vec, int]:
    """The rolling state of a ball that leaves the wall (normal n) in (v, w), and why there is none (then it is NaN)."""
    why = fate(v, w, n, a, kappa, ef, muf, betaf, g, h)
    if why == ROLLS:
        # (39)
        v3, w3 = rolls_at_last(v, w, a, kappa)
        return v3, w3, why
    x = math.nan
    return (x, x, x), (x, x, x), why
