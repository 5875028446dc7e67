"""The no-slip law: the velocity of the contact point is reversed, normal and tangential, and the energy is conserved.

Broomhead & Gutkin, Physica D 67, 188 (1993), for discs in the plane; Garwin, Am. J. Phys. 37, 88 (1969), for the
superball; Cox & Feres, "No-slip billiards in dimension two" (2016), for the proof that it and the mirror are the only two.
It is one contact with e = 1, mu infinite, beta = 1; for a disc v_z stays 0 and omega stays along z.
"""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from carom.bodies import Ball, State
from carom.core.contact import slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, cross, hot_kernel, kernel
from carom.laws.landing import PAPER_WALL
from carom.laws.law import (
    DRIVES_INTO_FLOOR,
    NO_SLIP_WALL,
    ON_FLOOR,
    Card,
    Case,
    FitSpec,
    Objections,
    Predicted,
    Rule,
    Said,
    reflect,
    slips_at_wall,
    wall_law,
)

CARD = Card(
    name="no-slip",
    summary="The velocity of the contact point is reversed, normal and tangential, and the energy is conserved.",
    assumptions=("e = 1", "tangential restitution beta = 1", "unlimited friction"),
    valid="No-slip billiards and gases of rough balls; superballs, approximately. The contact of a billiard ball stops the"
    " slip rather than reversing it.",
    equations="one contact with e = 1, mu = inf, beta = 1",
    citation="D. S. Broomhead & E. Gutkin, The dynamics of billiards with no-slip collisions, Physica D 67, 188-197 (1993);"
    " R. L. Garwin, Am. J. Phys. 37, 88-92 (1969).",
    doi="10.1016/0167-2789(93)90205-F",
)


@kernel
def no_slip_reflection(v: Vec, w: Vec, n: Vec, a: float, kappa: float) -> tuple[Vec, Vec, Vec, float]:
    """Velocity, spin, impulse per unit mass, and the required friction of the wall."""
    v1, w1, j, required, _regime = wall_contact(v, w, n, a, kappa, 1, math.inf, 1)
    return v1, w1, j, required


@hot_kernel
def no_slip_bounce(v: Vec, w: Vec, n: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """Velocity and spin of an approaching ball, bitwise identical to :func:`no_slip_reflection` (tested).

    With infinite friction there is no friction cone to check, so the square root and the division of the contact kernel are
    not needed; they take two thirds of the time of a loop of bounces.
    """
    un, ut = slip_velocity(v, w, n, a)
    # (19) with e = 1; (29) with beta = 1
    pn = -2 * un
    hold = 2 * (kappa / (1 + kappa))
    f = (-hold * ut[0], -hold * ut[1], -hold * ut[2])
    t = cross(n, f)
    c = 1 / (kappa * a)
    return (
        (v[0] + (pn * n[0] + f[0]), v[1] + (pn * n[1] + f[1]), v[2] + (pn * n[2] + f[2])),
        (w[0] - t[0] * c, w[1] - t[1] * c, w[2] - t[2] * c),
    )


@kernel
def no_slip_kernel(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall, with the signature of every wall law."""
    v1, w1, _j, _required = no_slip_reflection(v, w, n, a, kappa)
    return v1, w1


def no_slip(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0)) -> State:
    """Return the state after a no-slip wall: the velocity of the contact point is reversed, the energy conserved.

    Source: Broomhead & Gutkin, Physica D 67, 188 (1993), doi 10.1016/0167-2789(93)90205-F, for discs (:func:`carom.Disc`);
    Garwin, Am. J. Phys. 37, 88 (1969), in space.

    Parameters
    ----------
    ball : Ball
        Radius (m), mass (kg) and moment of inertia.
    state : State
        Velocity (m/s) and spin (rad/s) before the wall, shape (...).
    normal : array (..., 3)
        From the wall to the ball; any length.

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
    >>> disc = carom.Disc(radius=1.0, mass=1.0)
    >>> after = carom.no_slip(disc, carom.State((-1.0, 1.0, 0.0), (0.0, 0.0, 0.0)))
    >>> after.velocity.round(4).tolist(), after.spin.round(4).tolist()
    ([1.0, 0.3333, 0.0], [0.0, 0.0, 1.3333])
    """
    return reflect(LAW, ball, state, normal, PAPER_WALL)


@kernel
def _loses(c: Case, r: Predicted) -> Said:
    return c.e != 1, c.e, 0.0


@kernel
def _stops_slip(c: Case, r: Predicted) -> Said:
    return slips_at_wall(c) and c.beta < 1, c.beta, 0.0


@kernel
def _yields(c: Case, r: Predicted) -> Said:
    return slips_at_wall(c) and r.required_wall > c.mu, r.required_wall, c.mu


OBJECTIONS = Objections(
    Rule(_loses, "it assumes restitution 1; this wall has {a:g}"),
    Rule(_stops_slip, "it assumes tangential restitution 1, which reverses the slip; this wall has {a:g}"),
    Rule(_yields, "it requires a wall friction of {a:.3g}; this wall has {b:g}"),
    DRIVES_INTO_FLOOR,
)

LAW = wall_law(
    CARD,
    no_slip_kernel,
    objections=OBJECTIONS,
    reads=ON_FLOOR,
    response=NO_SLIP_WALL,
    pinned={"restitution": 1.0, "friction": math.inf, "tangential_restitution": 1.0},
    fits=(
        FitSpec("planar", "no-slip, all slip returned", free=("restitution",), nested_in=("contact", "maw", "stronge")),
        FitSpec("table", "no-slip wall, then the floor", free=("restitution",), nested_in=("contact",), upright=True),
    ),
    line=("#009E73", (0, (4, 1.5, 1, 1.5))),
    order=30,
)
