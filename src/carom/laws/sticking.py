"""Sticking: one contact that always ends without slip, with unlimited friction: the paper's wall."""

from __future__ import annotations

import math

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
    name="sticking",
    summary="One contact that ends without slip, with unlimited friction.",
    assumptions=("one impact with restitution e", "friction mu infinite, tangential restitution beta = 0"),
    valid="Very rough walls, small angles of incidence. The contact law with mu = inf and beta = 0; the paper's wall.",
    equations="(31)",
    citation=f"{PAPER}, section 3.1.",
)


@kernel
def sticking_kernel(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall."""
    return contact_kernel(v, w, n, a, kappa, e, math.inf, 0 * beta)


LAW = wall_law(
    CARD,
    sticking_kernel,
    objections=Objections(DRIVES_INTO_FLOOR),
    reads=("restitution", *ON_FLOOR),
    response=CONTACT_WALL,
    pinned={"friction": math.inf, "tangential_restitution": 0.0},
    needs=("restitution",),
    in_flight=True,
    variant_of="contact",
    fits=(
        FitSpec("planar", "sticking (the paper's wall)", nested_in=("sliding", "contact", "maw", "stronge")),
        FitSpec("table", same_as="two-step-paper"),
    ),
    order=72,
)
