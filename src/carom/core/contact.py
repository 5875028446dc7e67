"""One contact: it sticks, slides or rebounds tangentially. The one kernel that every law with friction is made of.

The impulse P_n = -(1+e) m_n u_n stops and returns the normal velocity u_n < 0 of the contact point. The tangential
impulse that would turn the slip u_t into -beta u_t has the size (1+beta) m_t |u_t|; friction caps it at mu P_n, and it
points against the slip. m_n and m_t are the masses that the contact feels: m and m kappa/(1+kappa) for a ball on a wall,
the pair's for ball against ball.

Sources: the paper, (19), (28)-(31), for beta = 0 inside the friction cone; Walton & Braun, J. Rheol. 30, 949 (1986), for
the three-parameter form (e, mu, beta); Garwin, Am. J. Phys. 37, 88 (1969) and Broomhead & Gutkin, Physica D 67, 188
(1993), for beta = 1.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel

# What a contact did; the names that people see are REGIMES[code].
GRAZE, STICK, SLIDE = 0, 1, 2
REGIMES = ("graze", "stick", "slide")
NO_REGIME = -1  # a law does not say
# An approach slower than this share of the slip is none: it is the rounding of a ball that moves along the wall, whose sign
# must not decide whether an infinitely rough wall takes hold of it.
LEAST = 1e-15


@hot_kernel
def slip_velocity(v: Vec, w: Vec, n: Vec, a: float) -> tuple[float, Vec]:
    """Velocity u of the contact point -a n of a ball: its normal part u_n and its tangential part u_t, the slip."""
    # (24): V_B = V_C + omega x CB, here with CB = -a n
    un = dot(v, n)
    s = cross(w, n)
    return un, (v[0] - un * n[0] - a * s[0], v[1] - un * n[1] - a * s[1], v[2] - un * n[2] - a * s[2])


@hot_kernel
def inside_friction_cone(tangential: float, mu: float, normal: float) -> bool:
    """Return whether Coulomb's friction can supply a tangential impulse: whether it lies within the cone about the normal one."""
    # (29): inside the friction cone the contact holds (a bare product: mu may be infinite)
    return tangential <= mu * normal


@kernel
def friction_at_slip(mu: float, drop: float, rate: float, slip: float) -> float:
    """Return the friction coefficient of a contact that slips with so many m/s: mu, or mu + drop exp(-rate slip) where drop > 0."""
    return mu + drop * math.exp(-rate * slip) if drop > 0 else mu + 0 * drop


@hot_kernel
def contact(
    un: float, ut: Vec, mn: float, mt: float, e: float, mu: float, beta: float
) -> tuple[float, Vec, float, int]:
    """Impulse of one contact: normal size, tangential vector, the friction it requires to hold, and its regime."""
    # (19): the normal velocity is turned into -e times itself
    pn = -(1 + e) * mn * un
    slip = math.sqrt(dot(ut, ut))
    hold = (1 + beta) * mt
    # One way out for all cases and no branch that a processor would have to guess: c is the tangential impulse per slip.
    cap = mu * pn / slip if slip > 0 else mu
    # (30), for beta = 0: the contact point is left without slip. On the cone the impulse is mu P_n against the slip.
    holds = inside_friction_cone(hold * slip, mu, pn)
    # (a smooth contact without slip: no impulse either way, but its derivative is the frictionless one)
    c = -hold if holds and mu > 0 else -cap
    regime = STICK if holds else SLIDE
    presses = -(1 + e) * un > LEAST * slip  # (velocities: balls of 1e-18 kg press too)
    if not presses:  # nothing approaches, or too slowly to count: no normal impulse and so no friction, whatever mu
        pn = c = un - un
        regime = GRAZE
    required = hold * slip / pn if presses else un - un
    return pn, (c * ut[0], c * ut[1], c * ut[2]), required, regime


@kernel
def struck_along(v: Vec, w: Vec, n: Vec, a: float, kappa: float, pn: float, f: float, ut: Vec) -> tuple[Vec, Vec]:
    """Velocity and spin of a ball after the impulse pn n + f ut of a unit of mass, ut its slip."""
    j = (pn * n[0] + f * ut[0], pn * n[1] + f * ut[1], pn * n[2] + f * ut[2])
    # (28), as below
    t = cross(n, (f * ut[0], f * ut[1], f * ut[2]))
    c = 1 / (kappa * a)
    return (v[0] + j[0], v[1] + j[1], v[2] + j[2]), (w[0] - t[0] * c, w[1] - t[1] * c, w[2] - t[2] * c)


@hot_kernel
def wall_contact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec, Vec, float, int]:
    """One ball, one surface with normal n: velocity, spin, impulse per mass, required friction, regime.

    The surface may be a wall, a floor, a cushion nose: whatever touches the ball at -a n.
    """
    un, ut = slip_velocity(v, w, n, a)
    pn, f, required, regime = contact(un, ut, 1, kappa / (1 + kappa), e, mu, beta)
    j = (pn * n[0] + f[0], pn * n[1] + f[1], pn * n[2] + f[2])
    # (28): m dv = R, I d(omega) = CB x R = -a n x R, of which only the tangential part counts
    # (31) is the result for mu infinite and beta = 0
    t = cross(n, f)
    c = 1 / (kappa * a)
    return (
        (v[0] + j[0], v[1] + j[1], v[2] + j[2]),
        (w[0] - t[0] * c, w[1] - t[1] * c, w[2] - t[2] * c),
        j,
        required,
        regime,
    )


@kernel
def one_contact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec, Vec, float, int]:
    """:func:`wall_contact` compiled once and called, for code that would otherwise hold many copies of it."""
    return wall_contact(v, w, n, a, kappa, e, mu, beta)
