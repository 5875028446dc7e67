"""The conventional law: the ball keeps rolling, the normal velocity is reversed, the energy is conserved.

The paper, section 2, (16)-(26), which names Treschev & Zubelevich (the copy at hand lacks its list of references); the rolling
reflection of nonholonomic billiards (Borisov, Kilin & Mamaev). With y along the wall, (17) and (21) leave two roots:

* a omega_z and y unchanged: no change along the wall (a rolling ball reflected at the mirror angle, without friction);
* the slip y - a omega_z at the wall is reversed, (26): the root of the paper, (22).

The second is taken, as in the paper: only with it does the constraint (4), imposed at the instant of impact, exert an
impulse where there is slip; with the first root that constraint has no effect. The first is the solution of Clark and Bloch's
corner conditions for nonholonomic impacts (IEEE CDC 2019, arXiv:1909.11192; `carom.derive.corner_jump`), which hold the
floor's constraints alone.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import Ball, State
from carom.core.jit.kernel import Vec, kernel
from carom.errors import CaromError
from carom.laws.landing import PAPER_WALL
from carom.laws.law import (
    PAPER,
    ROLLING_WALL,
    UP,
    Answer,
    Card,
    Case,
    Conditions,
    FitSpec,
    Law,
    Meeting,
    Objections,
    Predicted,
    Rule,
    Said,
    case_of,
    holds_everywhere,
    reflect,
    respond,
    slips,
    slips_at_wall,
)

CARD = Card(
    name="conventional",
    summary="The ball keeps rolling, its normal velocity and its slip at the wall are reversed, and the energy is conserved.",
    assumptions=(
        "1: the ball rolls without sliding before and after",
        "2: the normal velocity is reversed (19), with e = 1",
        "3: the energy is conserved (21)",
        "wall and floor act on the ball at once, with impulses that need not be compatible with friction",
    ),
    valid="The rolling reflection of nonholonomic billiards; a mathematical model. It requires that the wall pull the ball"
    " down and that the floor have a friction above 1, so no real ball follows it. Without a constraint at the wall the same ball"
    " is mirrored (corner conditions: Clark and Bloch 2019, arXiv:1909.11192).",
    equations="(16)-(26)",
    citation=f"{PAPER}, section 2.",
)


@kernel
def _tangential(v: Vec, n: Vec) -> float:
    """Velocity along the wall, in the direction k x n (+y for the wall of the examples)."""
    return v[1] * n[0] - v[0] * n[1]


@kernel
def _rolling(x: float, y: float, wz: float, n: Vec, a: float) -> tuple[Vec, Vec]:
    """State of a ball rolling with velocity x along n and y along k x n."""
    vx, vy = x * n[0] - y * n[1], x * n[1] + y * n[0]
    # (18): x' = a omega_y, y' = -a omega_x, z' = 0
    return (vx, vy, x - x), (-vy / a, vx / a, wz)


@kernel
def conventional_reflection(v: Vec, w: Vec, n: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """Velocity and spin of a rolling ball after a vertical wall with (horizontal, unit) normal n."""
    x, y, wz = v[0] * n[0] + v[1] * n[1], _tangential(v, n), w[2]
    # (22), with I = kappa m a^2: divide by m a^2 / 2
    y1 = (y + 2 * kappa * a * wz) / (1 + 2 * kappa)
    wz1 = (2 * (1 + kappa) * y / a - wz) / (1 + 2 * kappa)
    # (19) with e = 1
    return _rolling(-x, y1, wz1, n, a)


@kernel
def mirror_root(v: Vec, w: Vec, n: Vec, a: float, kappa: float) -> tuple[Vec, Vec]:
    """The other root of (17) and (21): the motion along the wall is unchanged, the ball rolls off at the mirror angle."""
    return _rolling(-(v[0] * n[0] + v[1] * n[1]), _tangential(v, n), w[2], n, a)


@kernel
def conventional_kernel(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, mu: float, beta: float
) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall, with the signature of every wall law."""
    return conventional_reflection(v, w, n, a, kappa)


def conventional(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), restitution: Any = 1.0) -> State:
    """Return the state after a vertical wall under the conventional law, in which the ball rolls at once.

    Source: the paper, (16)-(26). The hypotheses admit two roots; this is the one that reverses the slip at the wall. The
    other is the rolling mirror (:func:`carom.laws.conventional.mirror_root`).

    Parameters
    ----------
    ball : Ball
        Radius (m), mass (kg) and moment of inertia.
    state : State
        Velocity (m/s) and spin (rad/s) of a ball that rolls on the floor towards the wall, shape (...).
    normal : array (..., 3)
        Horizontal, from the wall to the ball; any length.
    restitution : float
        Must be 1. With e < 1 the energy could be conserved only if the normal motion passed its loss to the motion along
        the wall, and a ball that arrives along the normal without spin would have no preferred side.

    Returns
    -------
    State
        The rolling state after the wall, shape (...).

    Raises
    ------
    CaromError
        If a hypothesis fails: the ball slips on the floor, the wall is not vertical, or ``restitution`` is not 1.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> carom.conventional(ball, carom.rolling(ball, (-1.0, 1.0))).velocity.round(4).tolist()
    [1.0, 0.5556, 0.0]
    """
    if not holds_everywhere(restitution == 1 if type(restitution) is float else np.asarray(restitution) == 1):
        raise CaromError(
            f"conventional: restitution: expected 1 (hypothesis 3, the energy is conserved), got {restitution!r};"
            " carom.two_step takes any"
        )
    return reflect(LAW, ball, state, normal, PAPER_WALL)


@kernel
def _rolls(c: Case) -> Said:
    still = slips(c.v, c.w, UP, c.a) == 0
    return (c.v[2] == 0) & (c.height == 0) & still, 0.0, 0.0


@kernel
def _vertical(c: Case) -> Said:
    return abs(c.n[2]) < 1e-12, 0.0, 0.0


@kernel
def _elastic(c: Case) -> Said:
    return c.e == 1, 0.0, 0.0


@kernel
def _on_floor(c: Case) -> Said:
    return c.planar == 0, 0.0, 0.0


CONDITIONS = Conditions(
    Rule(_rolls, "hypothesis 1: a ball that rolls on the floor without sliding", "floor"),
    Rule(_vertical, "hypothesis 1: a vertical wall (any other lifts the ball or presses it down)", "shape"),
    Rule(_elastic, "hypothesis 3: a wall of restitution 1 (with less, energy would have to be created)", "restitution"),
    Rule(_on_floor, "a ball on a floor, not a disc in the plane"),
)


def _answer(meeting: Meeting) -> Answer:
    after = respond(conventional_kernel, meeting)
    none = np.full(after.shape, "")
    slipping = slips_at_wall(case_of(meeting))
    # Wall and floor share one unknown: S_z, the impulse by which the floor pushes up and the wall pulls down. As S_z grows, the
    # friction required of the floor falls towards 1 but stays above it, so no friction up to 1 suffices. The wall's tends to 1.
    needed = np.where(slipping, 1.0, 0.0)
    return Answer(after, after, needed, needed, none)


@kernel
def _reverses_slip(c: Case, r: Predicted) -> Said:
    return r.required_floor > 0, 0.0, 0.0


LAW = Law(
    CARD,
    _answer,
    CONDITIONS,
    Objections(
        Rule(
            _reverses_slip,
            "it reverses the slip at the wall, whereas friction can only stop it: the wall would have to pull the ball down"
            " and the floor would need a friction above 1, whatever the impulses",
        )
    ),
    conventional_kernel,
    reads=("restitution",),  # which must be 1
    response=ROLLING_WALL,
    pinned={"restitution": 1.0},
    fits=(
        FitSpec("planar", absent="it describes a ball that rolls on a floor, and these are bounces in the plane"),
        FitSpec("table", "conventional rolling reflection", free=(), upright=True, rolling_only=True),
    ),
    aliases=("rolling",),
    line=("#D55E00", (0, (6, 2))),
    order=20,
)
