"""The contact law: a single contact that sticks, slides or rebounds tangentially; the floor is ignored.

The kernel is :func:`carom.core.contact.wall_contact`, equations (19), (28)-(31).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, State, Surface
from carom.core.contact import wall_contact
from carom.core.jit.kernel import Vec, kernel, prange
from carom.errors import require_type
from carom.laws.arrays import answer_rows, loop_for, one_normal, require_approach, state_arrays, unit_normal
from carom.laws.landing import PAPER_WALL, Impact, times_mass
from carom.laws.law import (
    CONTACT_WALL,
    ON_WALL,
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
    contact_kernel,
    required_friction,
    respond,
    slips,
)

Array = NDArray[np.float64]

CARD = Card(
    name="contact",
    summary="A single contact, which sticks, slides or rebounds tangentially; the floor is ignored.",
    assumptions=(
        "one impact with restitution e, Coulomb friction mu and tangential restitution beta",
        "the ball touches nothing else, before or after",
    ),
    valid="A ball in flight against any surface: dropped on glass, or hit by a racket. If the contact sticks and reverses"
    " part of the slip, no single beta fits all angles: that is tangential compliance, which this law does not include.",
    equations="(19), (28)-(31)",
    citation="O. R. Walton & R. L. Braun, Viscosity, granular-temperature, and stress calculations for shearing"
    " assemblies of inelastic, frictional disks, J. Rheol. 30, 949-980 (1986).",
    doi="10.1122/1.549893",
)


def impact(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), surface: Surface = PAPER_WALL) -> Impact:
    """Compute a single contact of a ball with a surface, which sticks, slides or rebounds tangentially.

    Source: the paper, (19), (28)-(31); Walton & Braun, J. Rheol. 30, 949 (1986), doi 10.1122/1.549893.

    Parameters
    ----------
    ball : Ball
        Radius (m), mass (kg) and moment of inertia.
    state : State
        Velocity (m/s) and spin (rad/s) before the contact, shape (...). The ball must move towards the surface or along it.
    normal : array (..., 3)
        From the surface to the ball; any length.
    surface : Surface
        Restitution e, friction mu, tangential restitution beta.

    Returns
    -------
    Impact
        State after the contact, impulse (N s), required friction and regime, of shape (...).

    Raises
    ------
    CaromError
        If a ball moves away from the surface, or a normal has zero length.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> hit = carom.impact(ball, carom.rolling(ball, (-1.0, 1.0)), surface=carom.Surface(restitution=0.9, friction=0.1))
    >>> hit.regime, hit.after.velocity.round(4).tolist()
    ('slide', [0.9, 0.8656, 0.1344])
    """
    require_type("impact", "surface", surface, Surface)
    n = unit_normal(normal)
    require_approach(ball, state, n)
    parameters = (ball.radius, ball.kappa, surface.restitution, surface.friction, surface.tangential_restitution)
    v1, w1, j, required, code = answer_rows(
        wall_contact, contact_rows, "vvvxc", (state.velocity, state.spin, n), parameters
    )
    return Impact(ball, state, State.of(v1, w1, state.position), times_mass(j, ball.mass), required, code)


def impact_into(
    out: State, ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), surface: Surface = PAPER_WALL
) -> None:
    """Write the states after :func:`impact` into existing arrays; one normal, ball and surface for all N balls.

    The input is not validated and nothing is allocated, so the speed is limited by memory bandwidth.

    Parameters
    ----------
    out : State
        Receives velocities (m/s) and spins (rad/s) after the contact, contiguous arrays of shape (N, 3); ``state`` itself is
        written over. Begin with zeros: a State is not made of what ``np.empty`` leaves, which need not be a finite number.
    ball : Ball
        The same for all; its numbers are scalars.
    state : State
        Velocities and spins before the contact, shape (N, 3). Balls that move away are copied unchanged.
    normal : array (3,)
        From the surface to the ball; any length.
    surface : Surface
        The same for all; its numbers are scalars.

    Returns
    -------
    None
        The result is in ``out``.

    Raises
    ------
    CaromError
        If an array of ``out`` has another shape or is not contiguous, for several normals, or one of zero length.

    Examples
    --------
    >>> import carom, numpy as np
    >>> before = carom.State(np.tile([-1.0, 0.5, 0.0], (3, 1)), np.zeros((3, 3)))
    >>> after = carom.State(np.zeros((3, 3)), np.zeros((3, 3)))
    >>> carom.impact_into(after, carom.Ball(), before, surface=carom.Surface(restitution=0.9, friction=0.1))
    >>> after.velocity[0].round(4).tolist()
    [0.9, 0.3571, 0.0]
    """
    parameters = (ball.radius, ball.kappa, surface.restitution, surface.friction, surface.tangential_restitution)
    v, w, v1, w1 = state_arrays(state, out)
    loop_for(contact_final_rows, len(v) // 3)(v, w, one_normal(normal), np.array(parameters), v1, w1)


def contact_rows(
    v: Array, w: Array, n: Array, p: Array, v1: Array, w1: Array, j: Array, required: Array, regime: Any
) -> None:
    """Compute all results of one contact per row; parameters a, kappa, e, mu, beta; impulses per unit mass."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k, q = i * sn, i * sp
        x, y, z, required[i], regime[i] = wall_contact(
            (v[i, 0], v[i, 1], v[i, 2]),
            (w[i, 0], w[i, 1], w[i, 2]),
            (n[k, 0], n[k, 1], n[k, 2]),
            p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4],
        )  # fmt: skip
        v1[i, 0], v1[i, 1], v1[i, 2] = x
        w1[i, 0], w1[i, 1], w1[i, 2] = y
        j[i, 0], j[i, 1], j[i, 2] = z


# The two loops limited by memory bandwidth: one wall, ball and floor for all, flat arrays (3 N,), processed in blocks.
# A block is a separate function whose stride is a compile-time constant, so that it is vectorised (four balls at once).
BLOCK = 1024


@kernel
def _contact_block(
    v: Array, w: Array, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float, v1: Array, w1: Array
) -> None:
    for i in range(v.shape[0] // 3):
        k = 3 * i
        x, y, _j, _required, _regime = wall_contact(
            (v[k], v[k + 1], v[k + 2]), (w[k], w[k + 1], w[k + 2]), n, a, kappa, e, mu, beta
        )
        v1[k], v1[k + 1], v1[k + 2] = x[0], x[1], x[2]
        w1[k], w1[k + 1], w1[k + 2] = y[0], y[1], y[2]


def contact_final_rows(v: Array, w: Array, n: Array, p: Array, v1: Array, w1: Array) -> None:
    """Compute velocity and spin after one contact: one normal (3,) and one row of parameters a, kappa, e, mu, beta for all."""
    normal, count = (n[0], n[1], n[2]), v.shape[0]
    a, kappa, e, mu, beta = p[0], p[1], p[2], p[3], p[4]
    for block in prange((count + 3 * BLOCK - 1) // (3 * BLOCK)):
        i = 3 * BLOCK * block
        k = min(i + 3 * BLOCK, count)
        _contact_block(v[i:k], w[i:k], normal, a, kappa, e, mu, beta, v1[i:k], w1[i:k])


def _answer(meeting: Meeting) -> Answer:
    after = respond(contact_kernel, meeting)
    needed = required_friction(meeting.ball, meeting.state, after, meeting.normal)
    return Answer(after, after, needed, np.zeros(after.shape), np.full(after.shape, ""))


@kernel
def _rests_on_floor(c: Case, r: Predicted) -> Said:
    moved = r.v[2] != 0 or slips(r.v, r.w, UP, c.a)
    return c.planar == 0 and c.height == 0 and c.v[2] == 0 and moved, 0.0, 0.0


LAW = Law(
    CARD,
    _answer,
    approaches,
    Objections(Rule(_rests_on_floor, "it ignores the floor on which this ball rests")),
    contact_kernel,
    reads=ON_WALL,
    response=CONTACT_WALL,
    needs=("restitution", "friction"),
    in_flight=True,
    ignores_floor=True,
    fits=(
        FitSpec("planar", "sliding with tangential restitution"),
        FitSpec("table", "wall with tangential restitution, then the floor"),
    ),
    line=("#56B4E9", (0, (2.5, 1.5))),
    order=70,
)
