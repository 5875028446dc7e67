"""The two-step law: the wall, the flight, the floor.

The paper, section 3, (27)-(41), for any ball, wall and state, and with any friction and restitution of wall and floor.
Step one is the contact with the wall (31), or wall and floor at once where the wall presses the ball down. Step two is the
flight and the landing (39), or the sliding of a ball that was not lifted. Further bounces and sliding until the ball rolls
cannot change the rolling state: see :mod:`carom.laws.landing`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, State, Surface
from carom.core.contact import slip_velocity, wall_contact
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, prange
from carom.core.motion.phases import rolls_at_last
from carom.errors import CaromError, require_type
from carom.laws.arrays import answer_rows, bad_row, require_approach, unit_normal
from carom.laws.landing import (
    LOST,
    NO_LAW,
    PAPER_FLOOR,
    PAPER_WALL,
    FloorContact,
    Impact,
    TwoStep,
    landing_settings,
    rolling_after,
    settle_checked,
    times_mass,
)
from carom.laws.law import (
    ON_FLOOR,
    ON_WALL,
    PAPER,
    TWO_STEP_WALL,
    Answer,
    Card,
    Case,
    Conditions,
    FitSpec,
    Law,
    Meeting,
    Objections,
    Rule,
    Said,
    contact_kernel,
    required_friction,
    respond,
)
from carom.laws.wall_and_floor.solver import LEAST_FIRM, STALL, impact_and_way, pressed_down
from carom.public.defaults import GRAVITY

Array = NDArray[np.float64]

CARD = Card(
    name="two-step",
    summary="The wall's friction lifts the ball off the floor; it flies, lands, slides and rolls, contact by contact.",
    assumptions=(
        "each contact is one impact with restitution e, Coulomb friction mu and tangential restitution beta",
        "a ball that the wall presses on the rigid floor is in contact with both at once (optionally one after the other)",
        "the floor's friction acts only at its contact point: no pivoting friction, no rolling resistance",
    ),
    valid="Any ball, wall and state; the default. With e = 1 at the wall, e = 0 at the floor and both sticking it is the"
    " paper's law.",
    equations="(27)-(41)",
    citation=f"{PAPER}, section 3; O. R. Walton & R. L. Braun, J. Rheol. 30, 949-980 (1986), for the contact.",
    doi="10.1122/1.549893",
)

WALL_AND_FLOOR = Card(
    name="wall-and-floor",
    summary="A ball that the wall presses on the floor: both contacts at once, integrated over the wall's normal impulse.",
    assumptions=(
        "the floor is rigid, that is far stiffer than the wall, as cloth on slate is in comparison with a rubber cushion",
        "Coulomb friction at both contacts, with transitions between stick and slip; tangential restitution 0",
        "the wall returns e^2 of the work done on it (Stronge); its force is proportional to its compression",
        "the floor's restitution matters only if the ball is lifted and lands again during the wall contact",
    ),
    valid="Backspin, sliding, every cushion that touches above the centre. It is the first step of two-step by default;"
    " floor_contact='after' is the other limit, a floor softer than the wall. Any friction, including infinite; if large"
    " frictions lock the ball between wall and floor, the result states it.",
    equations="carom.laws.wall_and_floor.solver",
    citation="J. B. Keller, J. Appl. Mech. 53, 1-4 (1986); W. J. Stronge, Proc. R. Soc. A 431, 169-181 (1990);"
    " G. Darboux, Bull. Sci. Math. 4, 126-160 (1880).",
    doi="10.1115/1.3171712",
)

# The wall presses the ball down and has a tangential restitution: no law for two simultaneous contacts covers this.
UNDEFINED = 5

Impulsive = tuple[Vec, Vec, Vec, Vec, float, int]


@kernel
def _pressed(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float,
) -> tuple[Vec, Vec, Vec, Vec, float, int, int]:  # fmt: skip
    """:func:`first_impact_and_way` of a ball that the wall presses on the floor."""
    smooth = beta == -1 or mu == 0
    if not smooth and beta != 0:
        x = math.nan
        return (x, x, x), (x, x, x), (x, x, x), (x, x, x), x, UNDEFINED, 0
    v1, w1, j, jf, regime, way = impact_and_way(v, w, n, a, kappa, e, 0 * e if smooth else mu, ef, muf, betaf)
    if regime == STALL:
        x = math.nan
        return (x, x, x), (x, x, x), j, jf, x, regime, way
    # If the floor acts too, no single friction is the least one that sticks: the friction that was mobilised is returned.
    jn = dot(j, n)
    ft = (j[0] - jn * n[0], j[1] - jn * n[1], j[2] - jn * n[2])
    rubbed = math.sqrt(dot(ft, ft))
    if rubbed > 0 and not rubbed < LEAST_FIRM / 2 * jn:  # only an infinite friction suffices
        return v1, w1, j, jf, math.inf, regime, way
    return v1, w1, j, jf, rubbed / jn if rubbed > 0 else rubbed, regime, way


@hot_kernel
def first_impact_and_way(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, h: float, together: bool,
) -> tuple[Vec, Vec, Vec, Vec, float, int, int]:  # fmt: skip
    """:func:`first_impact`, and which sequence of sticking and slipping led to it: a number that only two of them may share."""
    if together and pressed_down(v, w, n, a, mu, h):
        return _pressed(v, w, n, a, kappa, e, mu, beta, ef, muf, betaf)
    zero = v[0] - v[0]
    v1, w1, j, required, regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    return v1, w1, j, (zero, zero, zero), required, regime, -1 - regime


@hot_kernel
def first_impact(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, h: float, together: bool,
) -> Impulsive:  # fmt: skip
    """Velocity and spin after the wall, impulse (per mass) of the wall and of the floor, required friction, regime."""
    v1, w1, j, jf, required, regime, _way = first_impact_and_way(
        v, w, n, a, kappa, e, mu, beta, ef, muf, betaf, h, together
    )
    return v1, w1, j, jf, required, regime


@hot_kernel
def two_step_plain(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, together: bool,
) -> tuple[Vec, Vec, bool]:  # fmt: skip
    """:func:`two_step_final` of a ball that is certainly not pressed down and certainly comes to roll; else False.

    It has no branches, so that a compiled loop is vectorised (four balls at once); undecided balls are computed in full.
    """
    _un, ut = slip_velocity(v, w, n, a)
    v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, e, mu, beta)
    # (39)
    v3, w3 = rolls_at_last(v1, w1, a, kappa)
    floor_is_plain = (n[2] == 0) & (muf > 0) & (ef < 1) & (betaf <= 0) & (g > 0)
    lifted = (not together) | ((v[2] >= 0) & (ut[2] <= 0))
    leaves = (v1[0] * n[0] + v1[1] * n[1] > 0) & (v3[0] * n[0] + v3[1] * n[1] > 0)
    return v3, w3, floor_is_plain & lifted & leaves


@hot_kernel
def two_step_final(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float,
    e: float, mu: float, beta: float, ef: float, muf: float, betaf: float, g: float, h: float, together: bool,
) -> tuple[Vec, Vec, int]:  # fmt: skip
    """Velocity and spin of the ball once it rolls again (NaN if it does not), and the code of the reason."""
    v1, w1, _j, _jf, _required, regime = first_impact(v, w, n, a, kappa, e, mu, beta, ef, muf, betaf, h, together)
    if regime == UNDEFINED:
        x = math.nan
        return (x, x, x), (x, x, x), NO_LAW
    if regime == STALL:
        x = math.nan
        return (x, x, x), (x, x, x), LOST
    return rolling_after(v1, w1, n, a, kappa, ef, muf, betaf, g, h)


def _is_pressed(
    v: Vec, w: Vec, n: Vec, a: float, _kappa: float,
    _e: float, mu: float, _beta: float, _ef: float, _muf: float, _betaf: float, h: float, together: bool,
) -> bool:  # fmt: skip
    return together and pressed_down(v, w, n, a, mu, h)


def first_rows(
    v: Array, w: Array, n: Array, p: Array, together: bool,
    v1: Array, w1: Array, j: Array, jf: Array, required: Array, regime: Any,
) -> None:  # fmt: skip
    """Compute the first impact per row; parameters a, kappa, e, mu, beta, the floor's e, mu, beta, height."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v.shape[0]):
        k, q = i * sn, i * sp
        x, y, z, f, required[i], regime[i] = first_impact(
            (v[i, 0], v[i, 1], v[i, 2]),
            (w[i, 0], w[i, 1], w[i, 2]),
            (n[k, 0], n[k, 1], n[k, 2]),
            p[q, 0], p[q, 1], p[q, 2], p[q, 3], p[q, 4], p[q, 5], p[q, 6], p[q, 7], p[q, 8], together,
        )  # fmt: skip
        v1[i, 0], v1[i, 1], v1[i, 2] = x
        w1[i, 0], w1[i, 1], w1[i, 2] = y
        j[i, 0], j[i, 1], j[i, 2] = z
        jf[i, 0], jf[i, 1], jf[i, 2] = f


def two_step(
    ball: Ball,
    state: State,
    wall: Surface = PAPER_WALL,
    floor: Surface = PAPER_FLOOR,
    normal: ArrayLike = (1.0, 0.0, 0.0),
    gravity: float = GRAVITY,
    height: ArrayLike = 0.0,
    floor_contact: FloorContact = "with",
) -> TwoStep:
    """Compute the two-step law: contact with the wall, flight, landing, and final rolling.

    Source: the paper, (27)-(41); for a ball pressed on the floor see :mod:`carom.laws.wall_and_floor.solver`.

    Parameters
    ----------
    ball : Ball
        Radius (m), mass (kg) and moment of inertia.
    state : State
        Velocity (m/s) and spin (rad/s), shape (...): rolling, sliding or, at ``height`` > 0, flying towards the wall.
    wall, floor : Surface
        Default: the paper's, wall e = 1, floor e = 0, both sticking.
    normal : array (..., 3)
        From the wall to the ball. If its vertical component is negative, the wall touches above the centre, as cushions do.
    gravity : float
        m/s^2.
    height : float or array (...)
        Of the centre above its position when the ball rests on the floor, at the contact with the wall, m.
    floor_contact : "with" or "after"
        For a ball that the wall presses on the floor: wall and floor at once (rigid floor), or the wall first and then the
        floor.

    Returns
    -------
    TwoStep
        Wall contact, flight, landing and rolling state, of shape (...).

    Raises
    ------
    CaromError
        If a ball moves away from the wall or down through the floor, or if a wall with tangential restitution presses a
        ball on the floor (no law covers both contacts at once; use ``floor_contact="after"``).

    Examples
    --------
    >>> import carom, math
    >>> ball = carom.Ball()
    >>> found = carom.two_step(ball, carom.rolling(ball, (-1.0, 1.0)))
    >>> round(math.degrees(found.reflection_angle), 2), round(1000 * found.flight.height, 2)
    (51.52, 4.16)
    """
    require_type("two_step", "wall", wall, Surface)
    require_type("two_step", "floor", floor, Surface)
    n = unit_normal(normal)
    require_approach(ball, state, n)
    g, h, together = landing_settings(gravity, height, floor_contact)
    if ball.planar:
        raise CaromError(
            "two_step: ball: expected a ball, got a disc in the plane, which has no floor; use carom.impact"
        )
    parameters = (
        ball.radius, ball.kappa, wall.restitution, wall.friction, wall.tangential_restitution,
        floor.restitution, floor.friction, floor.tangential_restitution, h,
    )  # fmt: skip
    v1, w1, j, jf, required, code = answer_rows(
        first_impact,
        first_rows,
        "vvvvxc",
        (state.velocity, state.spin, n),
        parameters,
        together,
        integrated=_is_pressed,
    )
    require_defined(code == UNDEFINED)
    after = State.of(v1, w1, state.position)
    hit = Impact(ball, state, after, times_mass(j, ball.mass), required, code)
    then = settle_checked(ball, after, floor, n, g, h)
    return TwoStep(**vars(then), after_wall=after, wall=hit, floor_impulse=times_mass(jf, ball.mass))


def require_defined(undefined: Any) -> None:
    """Raise CaromError if a wall with tangential restitution presses a ball on the floor."""
    if undefined is False:  # one state
        return
    undefined = np.asarray(undefined)
    if undefined.any():
        raise CaromError(
            "two_step: wall: expected tangential_restitution 0 where the wall presses the ball on the floor (no law with"
            f" tangential restitution covers wall and floor at once), got another{bad_row(undefined)};"
            " use floor_contact='after'"
        )


def answer_two_step(meeting: Meeting, order: FloorContact | None = None) -> Answer:
    """Return the two-step law's answer, with its steps; ``order`` of wall and floor: by default as in the meeting."""
    m = meeting
    if m.ball.planar:  # no floor: a single contact
        after = respond(contact_kernel, m)
        nothing = np.zeros(after.shape)
        return Answer(
            after, after, required_friction(m.ball, m.state, after, m.normal), nothing, np.full(after.shape, "")
        )
    two = two_step(m.ball, m.state, m.wall, m.floor, m.normal, m.gravity, m.height, order or m.floor_contact)
    # Friction required of the floor: for sticking at the landing, or mobilised while the wall pressed the ball on it.
    jf = two.floor_impulse
    with np.errstate(invalid="ignore", divide="ignore"):
        used = np.where(jf[..., 2] > 0, np.hypot(jf[..., 0], jf[..., 1]) / jf[..., 2], 0.0)
    used = np.where(used >= LEAST_FIRM / 2, np.inf, used)  # only an infinite friction suffices
    needed = np.fmax(two.floor.required_friction, used)
    return Answer(two.after_wall, two.rolling, two.wall.required_friction, needed, two.why, two)


@kernel
def _not_pressed(c: Case) -> Said:
    """Whether no wall with tangential restitution presses the ball on the floor while both act."""
    _un, u = slip_velocity(c.v, c.w, c.n, c.a)
    # (friction lifts the slip down the wall: mu u_z/|u| > n_z, in squares)
    up = (c.mu * u[2]) * (c.mu * u[2]) > (c.n[2] * c.n[2]) * dot(u, u)
    down = (c.n[2] < 0) | ((u[2] > 0) & up)
    on_floor = (c.planar == 0) & (c.together != 0) & (c.height == 0) & (c.v[2] <= 0)
    pressed = on_floor & (down | (c.v[2] < 0)) & (c.beta != 0) & (c.beta != -1)
    return pressed == 0, 0.0, 0.0


two_step_conditions = Conditions(
    Rule(_not_pressed, "tangential restitution 0 where the wall presses the ball on the floor")
)


LAW = Law(
    CARD,
    answer_two_step,
    two_step_conditions,
    Objections(),
    contact_kernel,
    reads=(*ON_WALL, *ON_FLOOR),
    response=TWO_STEP_WALL,
    needs=("restitution", "friction"),
    fits=(
        FitSpec("planar", same_as="sliding"),
        FitSpec("table", "two-step, wall and floor at once", free=("restitution", "friction")),
    ),
    line=("#0072B2", "solid"),
    order=40,
)
