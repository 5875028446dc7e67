"""The frictionless mirror: the wall reverses the normal velocity; there is no friction at the wall or on the floor."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import Ball, State, Surface
from carom.core.contact import contact, slip_velocity
from carom.core.jit.kernel import Vec, kernel
from carom.laws.landing import PAPER_WALL
from carom.laws.law import (
    DRIVES_INTO_FLOOR,
    MIRROR_WALL,
    PAPER,
    UP,
    Answer,
    Card,
    Case,
    FitSpec,
    Law,
    Meeting,
    Objections,
    Predicted,
    Rule,
    Said,
    approaches,
    has_friction,
    reflect,
    respond,
    slips,
    slips_at_wall,
)

CARD = Card(
    name="mirror",
    summary="No friction anywhere: the normal velocity is reversed times e, tangential velocity and spin are unchanged.",
    assumptions=("no friction at the wall, so the spin has no effect", "no friction on the floor, before or after"),
    valid="Point billiards, ice, a first estimate. On a rough floor the spin of a real ball bends its path after the wall.",
    equations="(19)",
    citation=f"The law of reflection, as in {PAPER}, section 5: true only in a frictionless world.",
)


@kernel
def mirror_reflection(v: Vec, w: Vec, n: Vec, a: float, e: float) -> tuple[Vec, Vec, Vec]:
    """Velocity, spin and impulse per unit mass of one contact with mu = 0."""
    un, ut = slip_velocity(v, w, n, a)
    pn, _f, _required, _regime = contact(un, ut, 1, 1, e, 0, 0)
    j = (pn * n[0], pn * n[1], pn * n[2])
    return (v[0] + j[0], v[1] + j[1], v[2] + j[2]), w, j


@kernel
def mirror_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall."""
    v1, w1, _j = mirror_reflection(v, w, n, a, e)
    return v1, w1


def mirror(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), surface: Surface = PAPER_WALL) -> State:
    """Return the state after a frictionless wall: the normal velocity is multiplied by -e, nothing else changes.

    Parameters
    ----------
    ball : Ball
        Radius (m), mass (kg) and moment of inertia; none of them affects the result.
    state : State
        Velocity (m/s) and spin (rad/s) before the wall, shape (...).
    normal : array (..., 3)
        From the wall to the ball; any length.
    surface : Surface
        Only its restitution e is used.

    Returns
    -------
    State
        After the wall, shape (...).

    Raises
    ------
    CaromError
        If a ball moves away from the wall, or a normal has zero length.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> carom.mirror(ball, carom.rolling(ball, (-1.0, 1.0))).velocity.tolist()
    [1.0, 1.0, 0.0]
    """
    return reflect(LAW, ball, state, normal, surface)


def _answer(meeting: Meeting) -> Answer:
    after = respond(mirror_kernel, meeting)
    nothing = np.zeros(after.shape)
    return Answer(after, after, nothing, nothing, np.full(after.shape, ""))


@kernel
def _rubs(c: Case, r: Predicted) -> Said:
    return slips_at_wall(c) and has_friction(c.mu, c.beta), 0.0, 0.0


@kernel
def _slides_after(c: Case, r: Predicted) -> Said:
    slides = slips(r.v, r.w, UP, c.a)
    return c.planar == 0 and has_friction(c.floor_mu, c.floor_beta) and slides, 0.0, 0.0


LAW = Law(
    CARD,
    _answer,
    approaches,
    Objections(
        DRIVES_INTO_FLOOR,
        Rule(_rubs, "the ball slips on the wall, and this wall has friction: the tangential impulse is ignored"),
        Rule(_slides_after, "the ball leaves the wall sliding on a floor with friction, which bends its path"),
    ),
    mirror_kernel,
    reads=("restitution",),
    response=MIRROR_WALL,
    pinned={"friction": 0.0, "tangential_restitution": -1.0},
    aliases=("specular",),
    fits=(
        FitSpec("planar", "no friction (mirror)", nested_in=("sliding", "contact", "maw", "stronge")),
        FitSpec("table", "no friction (mirror)", upright=True),
    ),
    line=("#8a8a8a", (0, (1, 1.6))),
    order=10,
)
