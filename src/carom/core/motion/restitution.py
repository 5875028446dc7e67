"""Restitution as a function of the normal speed: constant, or one of a few published forms.

A form is a code and three numbers. Every form is held in [0, 1] and is monotone in the speed as far as it is meant to go.
"""

from __future__ import annotations

import math

from carom.core.jit.kernel import Vec, hot_kernel, kernel

__all__ = ["CONSTANT", "EXPONENTIAL", "FORMS", "POLYNOMIAL", "POWER", "VISCOELASTIC", "restitution"]

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
