"""Doménech's two-step description of ball against ball: the contact, and then each ball comes to roll."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import Ball, Numbers, State, Surface, rolling
from carom.core.motion.phases import rolls_at_last
from carom.errors import CaromError, broadcast_shape
from carom.laws.landing import Names, name_codes
from carom.laws.law import Card
from carom.laws.pair import Collision, collide

CARD = Card(
    name="domenech",
    summary="A ball strikes one at rest: gross slip or slip-stick at the contact, then both balls come to roll.",
    assumptions=(
        "one contact with restitution e and friction mu; if it sticks it ends without slip",
        "the floor's friction is neglected while the balls are in contact",
        "after that the floor brings each ball to roll, by (39), wherever it lands",
    ),
    valid="Ball against ball on a table, any masses, inertias and spins (carom.domenech; carom.collide for the contact alone).",
    equations="the two regimes of impact; (39) for the transition to rolling",
    citation="A. Doménech, Non-smooth modelling of billiard- and superbilliard-ball collisions, Int. J. Mech. Sci. 50,"
    " 752-763 (2008).",
    doi="10.1016/j.ijmecsci.2007.11.006",
)


@dataclass(frozen=True, eq=False)
class Scattering:
    """Scattering of two balls after Doménech: just after the impact, and after the transition to rolling. Shapes (...).

    Examples
    --------
    >>> import carom
    >>> found = carom.domenech(carom.Ball(), impact_angle=0.5)
    >>> [round(angle, 4) for angle in found.post_transition_angles]
    [-0.6014, 0.4696]
    """

    collision: Collision
    """The contact of the two balls."""
    rolling: tuple[State, State]
    """Both balls once they roll (on a floor with friction; independent of gravity)."""

    @property
    def regime(self) -> Names:
        """ "gross slip" or "slip-stick" ("graze" if there is no impulse): a string or an array (...)."""
        return name_codes(self.collision.code, np.array(["graze", "slip-stick", "gross slip"]))

    @property
    def post_collision_angles(self) -> tuple[Numbers, Numbers]:
        """Angles (...) between both paths just after the impact and the first ball's incoming path, on the floor, rad."""
        return self._angles(self.collision.after)

    @property
    def post_transition_angles(self) -> tuple[Numbers, Numbers]:
        """The same angles once both balls roll, rad."""
        return self._angles(self.rolling)

    def _angles(self, states: tuple[State, State]) -> tuple[Any, Any]:
        u = self.collision.before[0].velocity
        found = []
        for state in states:
            x, y = state.velocity[..., 0], state.velocity[..., 1]
            angle = np.arctan2(u[..., 0] * y - u[..., 1] * x, u[..., 0] * x + u[..., 1] * y)
            found.append(float(angle) if angle.ndim == 0 else angle)
        return found[0], found[1]


def domenech(
    ball: Ball,
    state: State | None = None,
    other: Ball | None = None,
    impact_angle: ArrayLike = 0.5,
    surface: Surface = Surface(restitution=0.95, friction=0.06),  # noqa: B008
) -> Scattering:
    """Compute how a ball scatters from one at rest, just after the impact and once both roll.

    The floor's friction is neglected while the balls are in contact; after that each ball comes to roll, with (39) of its
    state after the impact. Source: A. Doménech, Int. J. Mech. Sci. 50, 752 (2008), doi 10.1016/j.ijmecsci.2007.11.006.

    Parameters
    ----------
    ball : Ball
        The striking ball.
    state : State
        Of the striking ball, shape (...), on the floor. Default: rolling at 1 m/s along +x.
    other : Ball
        The ball at rest. Default: like the striking one.
    impact_angle : float or array (...)
        From the incoming path to the line of centres, rad; positive if the other ball lies to the left.
    surface : Surface
        Restitution and friction between the balls; a contact that sticks ends without slip (tangential restitution 0).

    Returns
    -------
    Scattering

    Raises
    ------
    CaromError
        For a tangential restitution other than 0, an angle not between -pi/2 and pi/2, or a striking ball at rest.

    Examples
    --------
    >>> import carom
    >>> found = carom.domenech(carom.Ball(), impact_angle=0.5)
    >>> found.regime, [round(angle, 4) for angle in found.post_collision_angles]
    ('gross slip', [-1.0226, 0.4712])
    """
    other = other or ball
    state = state or rolling(ball, (1.0, 0.0))
    if np.any(np.asarray(surface.tangential_restitution) != 0):
        raise CaromError(
            "domenech: surface: expected tangential_restitution 0 (slip-stick ends without slip); use carom.collide"
        )
    angle = np.asarray(impact_angle, dtype=float)
    if not np.all(np.abs(angle) < np.pi / 2):
        raise CaromError(f"domenech: impact_angle: expected an angle between -pi/2 and pi/2 rad, got {impact_angle!r}")
    broadcast_shape(state.shape, angle.shape, np.shape(ball.radius), np.shape(other.radius))
    x, y = state.velocity[..., 0], state.velocity[..., 1]
    speed = np.hypot(x, y)
    if np.any(speed == 0):
        raise CaromError("domenech: state: expected a striking ball that moves along the floor, got one at rest")
    c, s = np.cos(angle), np.sin(angle)
    line = np.stack(np.broadcast_arrays((c * x - s * y) / speed, (s * x + c * y) / speed, 0 * c), axis=-1)
    rest = State.of(np.zeros(3), np.zeros(3))
    hit = collide(ball, state, other, rest, -line, surface)
    return Scattering(hit, (_roll(ball, hit.after[0]), _roll(other, hit.after[1])))


def _roll(ball: Ball, state: State) -> State:
    """(39) for arrays."""
    v, w = np.moveaxis(state.velocity, -1, 0), np.moveaxis(state.spin, -1, 0)
    numbers: Any = (ball.radius, ball.kappa)  # (the kernel takes arrays too)
    v3, w3 = rolls_at_last(tuple(v), tuple(w), *numbers)
    return State.of(np.stack(v3, axis=-1), np.stack(w3, axis=-1))
