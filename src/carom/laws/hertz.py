"""Elastic contacts that take time: Hertz's force, Tsuji's damping, and how long a contact lasts.

Two spheres that overlap by d push each other apart with k d^(3/2), k = (4/3) E* sqrt(R*), R* = a1 a2 / (a1 + a2), and for balls of
one material E* = E / (2 (1 - nu^2)). The damping alpha sqrt(m k) d^(1/4) d' of a pair of reduced mass m takes energy, and with it
the restitution does not depend on the speed: with s = d^(5/4) the collision is a linear oscillator, damped by zeta =
alpha / sqrt(5), whose force must not pull.

Sources: K. L. Johnson, Contact Mechanics (1985), 4.2 and 11.4, for the force and the duration; Y. Tsuji, T. Tanaka & T. Ishida,
Powder Technol. 71, 239 (1992), for the damping; T. Schwager & T. Poschel, Granular Matter 9, 465 (2007), for e(zeta) of a force
that does not pull.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import kernel

__all__ = [
    "LEAST_RESTITUTION", "POISSON", "YOUNG", "contact_modulus", "contact_time", "damping", "fifth_root", "lasts_longer",
    "stiffness",
]  # fmt: skip

YOUNG, POISSON = 5.84e9, 0.34  # of phenolic resin, Pa: billiard balls
# A contact lasts so many times (5 m / (4 k))^(2/5) u^(-1/5): 2 integral_0^1 dx / sqrt(1 - x^(5/2)) (Johnson, 11.24)
HERTZ = 2.9432750577
# With no restitution the damping would be infinite: what is less is taken as this.
LEAST_RESTITUTION = 0.0025
# Of P, a least-squares fit in Chebyshev polynomials.
COEFFICIENTS = (
    1.1196849324153881, -0.13902538683193966, -3.1090936685820822, 14.863043708104325, -47.5275482786091,
    107.84581012267606, -170.29573382573017, 181.48228305157005, -123.94875213598415, 48.8624328960576,
    -8.441341868424027,
)  # fmt: skip


def contact_modulus(young: float, poisson: float) -> float:
    """Return E* of two balls of one material, Pa.

    >>> round(contact_modulus(5.84e9, 0.34) / 1e9, 3)
    3.302
    """
    return young / (2 * (1 - poisson * poisson))


@kernel
def stiffness(modulus: float, a1: float, a2: float) -> float:
    """Return k (N/m^(3/2)) of two balls of radii a1 and a2, whose E* is ``modulus``."""
    return 4 * modulus * math.sqrt(a1 * a2 / (a1 + a2)) / 3


@kernel
def fifth_root(y: float) -> float:
    """Return y^(1/5) of a positive number, by z = (y/z)^(1/4): each step leaves a quarter of the error of its logarithm."""
    z = math.sqrt(math.sqrt(y))
    for _ in range(30):
        z = math.sqrt(math.sqrt(y / z))
    return z


@kernel
def contact_time(m: float, k: float, speed: float) -> float:
    """Return how long two balls of reduced mass m touch without damping, s: 2.943 (5 m / (4 k))^(2/5) u^(-1/5).

    >>> k = stiffness(contact_modulus(5.84e9, 0.34), 0.028575, 0.028575)
    >>> round(1e6 * contact_time(0.085, k, 1.0))
    390
    """
    x = 5 * m / (4 * k)
    return HERTZ * fifth_root(x * x / speed)


@kernel
def lasts_longer(m: float, k: float, speed: float, time: float) -> bool:
    """Return whether such a contact lasts longer than a time (s): no root is taken."""
    x, t = 5 * m / (4 * k), time / HERTZ
    square = t * t
    return bool(square * square * t * speed <= x * x)


@kernel
def damping(e: float) -> float:
    """Return Tsuji's alpha of a restitution: with it two balls have e, within 2e-6, from 0.0025 to 1; below, that of 0.0025.

    A polynomial (1 - e) P(sqrt(e)) / sqrt(e) through the roots of e(zeta), which has no inverse in closed form.

    >>> [round(damping(e), 4) for e in (1.0, 0.95, 0.5, 0.1)]
    [0.0, 0.0369, 0.5708, 2.7799]
    """
    r = math.sqrt(max(e, LEAST_RESTITUTION + 0 * e))
    p = COEFFICIENTS[10] + 0 * r
    for j in range(9, -1, -1):
        p = COEFFICIENTS[j] + r * p
    return (1 - r * r) * p / r
