"""Ball against ball: `collide`, and Doménech's two-step description of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.ball import Ball
from carom.checks import expect, first_index, require_shapes
from carom.errors import CaromError
from carom.laws.card import Card
from carom.laws.landing import rolls_at_last
from carom.loops import loop_for, pair_rows
from carom.rows import unit_normal
from carom.state import State, kinetic_energy, rolling
from carom.surface import Surface
from carom.verbs import NAMES, named

__all__ = ["DOMENECH", "Collision", "Scattering", "collide", "domenech"]

Array = NDArray[np.float64]

DOMENECH = Card(
    name="domenech",
    summary="A ball strikes a resting one: gross slip or slip-stick at the contact, then each ball comes to roll.",
    assumptions=(
        "one contact with restitution e and friction mu; where it holds it ends without slip",
        "the floor's friction is left out while the balls touch",
        "after that the floor brings each ball to roll, by (39), wherever it lands",
    ),
    valid="Ball against ball on a table, any masses, inertias and spins (carom.domenech; carom.collide for the contact alone).",
    equations="the two regimes of impact; (39) for the transition to rolling",
    citation="A. Doménech, Non-smooth modelling of billiard- and superbilliard-ball collisions, Int. J. Mech. Sci. 50,"
    " 752-763 (2008).",
    doi="10.1016/j.ijmecsci.2007.11.006",
)


@dataclass(frozen=True, eq=False)
class Collision:
    """Two balls after their contact. Shapes (...) as the states'."""

    balls: tuple[Ball, Ball]
    before: tuple[State, State]
    after: tuple[State, State]
    impulse: Array
    """(..., 3), N s, on the first ball; the second has its opposite."""
    required_friction: Any
    code: Any

    @property
    def regime(self) -> Any:
        """ "stick", "slide" or "graze": a string or an array."""
        return named(self.code, NAMES)

    @property
    def energy_lost(self) -> Any:
        """(...), J."""
        pairs = zip(self.balls, self.before, self.after, strict=True)
        return sum(kinetic_energy(ball, old) - kinetic_energy(ball, new) for ball, old, new in pairs)


def collide(
    ball: Ball, state: State, other: Ball, other_state: State, normal: ArrayLike = (-1.0, 0.0, 0.0),
    surface: Surface = Surface(),  # noqa: B008
) -> Collision:  # fmt: skip
    """Contact of two balls: the same law as ball and wall, with the pair's masses.

    Parameters
    ----------
    ball, state, other, other_state : the first and the second ball, states (...)
    normal : array (..., 3)
        From the centre of the second ball to that of the first; any length.
    surface : Surface
        Restitution, friction and tangential restitution between the two.

    Returns
    -------
    Collision. Raises CaromError where the balls move apart.
    """
    for field, value, kind in (("ball", ball, Ball), ("state", state, State), ("other", other, Ball),
                               ("other_state", other_state, State), ("surface", surface, Surface)):  # fmt: skip
        expect("collide", field, value, kind)
    n = unit_normal(normal)
    balls = (ball, other)
    numbers = [x for b in balls for x in (b.radius, b.mass, b.kappa)]
    numbers += [surface.restitution, surface.friction, surface.tangential_restitution]
    shape = require_shapes(state.shape, other_state.shape, n.shape[:-1], *(np.shape(x) for x in numbers))
    v1, w1, v2, w2, normals = (
        np.broadcast_to(x, (*shape, 3)).reshape(-1, 3)
        for x in (state.velocity, state.spin, other_state.velocity, other_state.spin, n)
    )
    apart = (((v1 - v2) * normals).sum(axis=-1) > 0).reshape(shape)
    if apart.any():
        raise CaromError(
            f"collide: expected two balls that approach, got two that move apart{first_index(apart)};"
            " the normal points from the second ball to the first"
        )
    count = len(v1)
    p = np.stack([np.broadcast_to(x, shape).reshape(count) for x in numbers], axis=-1)
    out, required, code = np.empty((count, 15)), np.empty(count), np.empty(count, dtype=np.int8)
    args = (np.ascontiguousarray(x) for x in (v1, w1, v2, w2, normals, p))
    loop_for(pair_rows, count)(*args, out, required, code)
    part = [out[:, 3 * i : 3 * i + 3].reshape(*shape, 3) for i in range(5)]
    after = (State.of(part[0], part[1]), State.of(part[2], part[3]))
    scalars = [x[0].item() if shape == () else x.reshape(shape) for x in (required, code)]
    return Collision(balls, (state, other_state), after, part[4], *scalars)


@dataclass(frozen=True, eq=False)
class Scattering:
    """Doménech's description: just after the impact, and after the transition to rolling. Shapes (...)."""

    collision: Collision
    rolling: tuple[State, State]
    """Both balls once they roll (on a floor with friction, no gravity needed to say it)."""

    @property
    def regime(self) -> Any:
        """ "gross slip" or "slip-stick" ("graze" where nothing pressed)."""
        return named(self.collision.code, np.array(["graze", "slip-stick", "gross slip"]))

    @property
    def post_collision_angles(self) -> tuple[Any, Any]:
        """Angles (...) of both balls' paths along the floor from the first ball's incoming path, rad, just after impact."""
        return self._angles(self.collision.after)

    @property
    def post_transition_angles(self) -> tuple[Any, Any]:
        """The same angles once both balls roll."""
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
    """A ball strikes a resting one: gross slip or slip-stick, scattering just after the impact and once both roll.

    Parameters
    ----------
    ball : Ball
        The striking ball; ``other`` (by default the same) rests.
    state : State
        Of the striking ball, (...), on the floor; by default it rolls at 1 m/s along +x.
    impact_angle : float or array (...)
        From the incoming path to the line of centres, rad; positive: the other ball lies to the left.
    surface : Surface
        Restitution and friction between the balls; a contact that holds loses its slip (tangential restitution 0).

    Returns
    -------
    Scattering. Source: A. Doménech, Int. J. Mech. Sci. 50, 752 (2008), doi 10.1016/j.ijmecsci.2007.11.006. The floor's
    friction is left out while the balls touch; after that each ball comes to roll with (39) of the state it was left in.
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
    require_shapes(state.shape, angle.shape, np.shape(ball.radius), np.shape(other.radius))
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
    v3, w3 = rolls_at_last(tuple(v), tuple(w), ball.radius, ball.kappa)
    return State.of(np.stack(v3, axis=-1), np.stack(w3, axis=-1))
