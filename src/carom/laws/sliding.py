"""Coulomb sliding: one contact in which friction opposes the slip and at most stops it (beta = 0)."""

from __future__ import annotations

from carom.core.jit.kernel import Vec, kernel
from carom.laws.law import (
    CONTACT_WALL,
    DRIVES_INTO_FLOOR,
    ON_FLOOR,
    PAPER,
    Card,
    FitSpec,
    Objections,
    contact_kernel,
    wall_law,
)

CARD = Card(
    name="sliding",
    summary="One contact with restitution and Coulomb friction: it slides throughout, or friction stops the slip.",
    assumptions=("one impact with restitution e and Coulomb friction mu", "tangential restitution beta = 0"),
    valid="Balls without tangential rebound: billiard balls on cushions, hard spheres at grazing incidence. The contact law"
    " with beta = 0.",
    equations="(19), (28)-(31)",
    citation=f"{PAPER}, section 3.1; O. R. Walton & R. L. Braun, J. Rheol. 30, 949-980 (1986), for the contact.",
    doi="10.1122/1.549893",
)


@kernel
def sliding_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall."""
    return contact_kernel(v, w, n, a, kappa, e, mu, 0 * beta)


LAW = wall_law(
    CARD,
    sliding_kernel,
    objections=Objections(DRIVES_INTO_FLOOR),
    reads=("restitution", "friction", *ON_FLOOR),
    response=CONTACT_WALL,
    pinned={"tangential_restitution": 0.0},
    needs=("restitution", "friction"),
    in_flight=True,
    variant_of="contact",
    fits=(
        FitSpec("planar", "sliding (Coulomb), slip stopped at most", nested_in=("contact",)),
        FitSpec("table", same_as="two-step-after"),
    ),
    aliases=("coulomb",),
    order=71,
)
