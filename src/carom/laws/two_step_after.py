"""The two-step law with a floor softer than the wall: the wall contact first, and then the floor."""

from __future__ import annotations

from functools import partial

from carom.laws.law import (
    CONTACT_WALL,
    ON_FLOOR,
    ON_WALL,
    PAPER,
    Card,
    FitSpec,
    Law,
    Objections,
    approaches,
    contact_kernel,
)
from carom.laws.two_step import answer_two_step

CARD = Card(
    name="two-step-after",
    summary="The two-step law in which a ball that the wall presses down completes the wall contact before that with the floor.",
    assumptions=(
        "each contact is one impact with restitution e, Coulomb friction mu and tangential restitution beta",
        "the contact with the floor comes after that with the wall, even where the wall presses the ball on the floor",
    ),
    valid="The limit of a floor much softer than the wall. It is two-step with floor_contact='after'; the two differ only"
    " where the wall presses the ball down (backspin, sliding, a cushion that touches above the centre).",
    equations="(27)-(41)",
    citation=f"{PAPER}, section 3; O. R. Walton & R. L. Braun, J. Rheol. 30, 949-980 (1986), for the contact.",
    doi="10.1122/1.549893",
)


LAW = Law(
    CARD,
    partial(answer_two_step, order="after"),
    approaches,
    Objections(),
    contact_kernel,
    reads=(*ON_WALL, *ON_FLOOR),
    response=CONTACT_WALL,
    needs=("restitution", "friction"),
    variant_of="two-step",
    fits=(
        FitSpec("planar", same_as="sliding"),
        FitSpec(
            "table",
            "two-step, the wall and then the floor",
            free=("restitution", "friction"),
            nested_in=("contact",),
            redundant_upright=True,
        ),
    ),
    order=41,
)
