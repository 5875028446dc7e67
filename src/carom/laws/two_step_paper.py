"""The two-step law with the paper's own surfaces: wall of restitution 1, floor of restitution 0, both sticking."""

from __future__ import annotations

import math
from dataclasses import replace

from carom.core.jit.kernel import Vec, kernel
from carom.laws.landing import PAPER_FLOOR, PAPER_WALL
from carom.laws.law import (
    CONTACT_WALL,
    PAPER,
    Answer,
    Card,
    FitSpec,
    Law,
    Meeting,
    Objections,
    approaches,
    contact_kernel,
)
from carom.laws.two_step import answer_two_step

CARD = Card(
    name="two-step-paper",
    summary="The two-step law with the paper's surfaces: both stick; restitution 1 at the wall, 0 at the floor.",
    assumptions=("wall: e = 1, mu infinite, beta = 0", "floor: e = 0, mu infinite, beta = 0"),
    valid="The paper's own example, without free parameters: 51.52 degrees for an angle of incidence of 45. Real cushions"
    " have a lower restitution, and balls slide on them.",
    equations="(27)-(41)",
    citation=f"{PAPER}, section 3.",
)


@kernel
def paper_wall_kernel(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall."""
    return contact_kernel(v, w, n, a, kappa, 1 + 0 * e, math.inf, 0 * beta)


def _answer(meeting: Meeting) -> Answer:
    return answer_two_step(replace(meeting, wall=PAPER_WALL, floor=PAPER_FLOOR))


LAW = Law(
    CARD,
    _answer,
    approaches,
    Objections(),
    paper_wall_kernel,
    reads=(),
    response=CONTACT_WALL,
    pinned={"restitution": 1.0, "friction": math.inf, "tangential_restitution": 0.0},
    variant_of="two-step",
    fits=(
        FitSpec("planar", absent="it needs a floor; its wall is the law sticking"),
        FitSpec(
            "table",
            "two-step with the paper's surfaces",
            pinned={"floor_friction": math.inf},
            upright=True,
            rolling_only=True,
        ),
    ),
    order=42,
)
