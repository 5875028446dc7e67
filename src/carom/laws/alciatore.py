"""Friction of pool balls that falls with the slip, as Marlow measured it: one contact."""

from __future__ import annotations

import math

from carom.core.contact import friction_at_slip, slip_velocity
from carom.core.jit.kernel import Vec, dot, kernel
from carom.laws.law import ON_FLOOR, Card, contact_kernel, wall_law

CARD = Card(
    name="alciatore",
    summary="One contact of two balls whose friction falls with the slip: 0.118 at rest, 0.046 at 1 m/s, 0.010 at high speed.",
    assumptions=(
        "friction mu = 0.009951 + 0.108 exp(-1.088 s/m u), u the slip before the contact; the surface's own is not read",
        "in all else the contact law",
    ),
    valid="Pool balls that meet: throw falls with speed. A curve through three frictions that Marlow gives, 0.11, 0.06 and 0.01 of"
    " balls that meet at 45 degrees with 0.1, 1 and 10 m/s.",
    equations="mu(v) of TP A.14; (19), (28)-(31)",
    citation="D. G. Alciatore, Object ball throw, technical proof TP A.14 (undated), billiards.colostate.edu, from table 10 of"
    " W. C. Marlow, The Physics of Pocket Billiards (1995).",
)
FALLS = (0.009951, 0.108, 1.088)  # mu + drop exp(-rate slip)


@kernel
def alciatore_contact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """Velocity and spin after one contact with the friction of its slip."""
    _un, u = slip_velocity(v, w, n, a)
    mu = friction_at_slip(FALLS[0], FALLS[1], FALLS[2], math.sqrt(dot(u, u)))
    return contact_kernel(v, w, n, a, kappa, e, mu, beta)


LAW = wall_law(
    CARD,
    alciatore_contact,
    reads=("restitution", "tangential_restitution", *ON_FLOOR),
    slip_friction=FALLS,
    needs=("restitution",),
    in_flight=True,
    variant_of="contact",
    fits=(),
    aliases=("marlow",),
    order=73,
)
