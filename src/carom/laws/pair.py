"""Ball against ball: one contact with the masses of the pair, and Doménech's two-step description of it.

Two balls meet as one ball meets a wall at rest: with their relative velocity, their reduced mass and radius. So every law of a
single contact (:attr:`carom.laws.law.Law.for_pairs`) is a law of pairs, with the same kernel.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, Numbers, State, Surface, kinetic_energy, rolling
from carom.core.contact import GRAZE, NO_REGIME, REGIMES, contact, friction_at_slip
from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel, prange
from carom.core.motion.phases import ROUNDING
from carom.core.motion.rolling import rolls_at_last
from carom.errors import CaromError, FaultList, broadcast_shape, checked_number, first_bad_index, require_type
from carom.laws.arrays import WallKernel, fresh_unless_own, loop_for, require_resolved, unit_normal
from carom.laws.law import LIKE_SOLIDS, ON_WALL, Card, Law, Meeting, approaches
from carom.laws.registry import law_for_pairs
from carom.laws.results import Names, name_codes
from carom.laws.user import find_law

__all__ = ["CARD", "Collision", "Scattering", "collide", "domenech"]

Array = NDArray[np.float64]

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


@hot_kernel
def pair_slip(v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec, a1: float, a2: float) -> tuple[float, Vec]:
    """Velocity of the point of ball 1 that touches ball 2, relative to that of ball 2: its normal part, and the slip."""
    # Ball 1 is touched at -a1 n, ball 2 at +a2 n
    r = cross((a1 * w1[0] + a2 * w2[0], a1 * w1[1] + a2 * w2[1], a1 * w1[2] + a2 * w2[2]), n)
    u = (v1[0] - v2[0] - r[0], v1[1] - v2[1] - r[1], v1[2] - v2[2] - r[2])
    un = dot(u, n)
    return un, (u[0] - un * n[0], u[1] - un * n[1], u[2] - un * n[2])


@kernel
def pair_contact(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float, e: float, mu: float, beta: float,
) -> tuple[Vec, Vec, Vec, Vec, Vec, float, int]:  # fmt: skip
    """Both velocities and spins after the contact, the impulse (N s) on ball 1, required friction, regime.

    n points from the centre of ball 2 to the centre of ball 1.
    """
    un, ut = pair_slip(v1, w1, v2, w2, n, a1, a2)
    mn = m1 * m2 / (m1 + m2)
    mt = 1 / ((1 + 1 / kappa1) / m1 + (1 + 1 / kappa2) / m2)
    pn, f, required, regime = contact(un, ut, mn, mt, e, mu, beta)
    j = (pn * n[0] + f[0], pn * n[1] + f[1], pn * n[2] + f[2])
    return *struck_pair(v1, w1, v2, w2, j, cross(n, f), a1, m1, kappa1, a2, m2, kappa2), j, required, regime


@hot_kernel
def struck_pair(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec, j: Vec, t: Vec,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float,
) -> tuple[Vec, Vec, Vec, Vec]:  # fmt: skip
    """Both velocities and spins after an impulse j (N s) on ball 1, and its opposite on ball 2; t is n x j."""
    c1, c2 = kappa1 * m1 * a1, kappa2 * m2 * a2
    return (
        (v1[0] + j[0] / m1, v1[1] + j[1] / m1, v1[2] + j[2] / m1),
        (w1[0] - t[0] / c1, w1[1] - t[1] / c1, w1[2] - t[2] / c1),
        (v2[0] - j[0] / m2, v2[1] - j[1] / m2, v2[2] - j[2] / m2),
        (w2[0] - t[0] / c2, w2[1] - t[1] / c2, w2[2] - t[2] / c2),
    )


@kernel
def pair_as_wall(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float,
) -> tuple[Vec, Vec, float, float, float]:  # fmt: skip
    """The one ball whose contact with a wall at rest is that of the pair: velocity, spin, radius, kappa, mass.

    It has the pair's relative velocity, reduced radius and reduced mass; its kappa gives it the pair's tangential mass.
    """
    a = a1 * a2 / (a1 + a2)
    c1, c2 = a1 / a, a2 / a
    kappa = (m1 + m2) / (m2 / kappa1 + m1 / kappa2)
    return (
        (v1[0] - v2[0], v1[1] - v2[1], v1[2] - v2[2]),
        (c1 * w1[0] + c2 * w2[0], c1 * w1[1] + c2 * w2[1], c1 * w1[2] + c2 * w2[2]),
        a,
        kappa,
        m1 * m2 / (m1 + m2),
    )


@kernel
def struck_as_wall(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec, before: Vec, after: Vec, m: float,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float,
) -> tuple[Vec, Vec, Vec, Vec, Vec]:  # fmt: skip
    """Both velocities and spins, and the impulse on ball 1, after a law has turned the velocity of :func:`pair_as_wall`.

    The impulse acts at the point of contact, so that momentum and angular momentum are kept whatever the law does to spins.
    """
    j = (m * (after[0] - before[0]), m * (after[1] - before[1]), m * (after[2] - before[2]))
    return *struck_pair(v1, w1, v2, w2, j, cross(n, j), a1, m1, kappa1, a2, m2, kappa2), j


def pair_rows(
    v1: Array, w1: Array, v2: Array, w2: Array, n: Array, p: Array, out: Array, required: Array, regime: Any
) -> None:
    """Evaluate ball-ball contacts; parameters a, m, kappa of both, e, mu, beta, drop and rate of mu with the slip.

    ``out`` (N, 15): both states, impulse.
    """
    for i in prange(v1.shape[0]):
        v, w = (v1[i, 0], v1[i, 1], v1[i, 2]), (w1[i, 0], w1[i, 1], w1[i, 2])
        u, r = (v2[i, 0], v2[i, 1], v2[i, 2]), (w2[i, 0], w2[i, 1], w2[i, 2])
        normal = (n[i, 0], n[i, 1], n[i, 2])
        _un, ut = pair_slip(v, w, u, r, normal, p[i, 0], p[i, 3])
        a, b, c, d, j, required[i], regime[i] = pair_contact(
            v, w, u, r, normal, p[i, 0], p[i, 1], p[i, 2], p[i, 3], p[i, 4], p[i, 5],
            p[i, 6], friction_at_slip(p[i, 7], p[i, 9], p[i, 10], math.sqrt(dot(ut, ut))), p[i, 8],
        )  # fmt: skip
        for k in range(3):
            out[i, k], out[i, 3 + k], out[i, 6 + k], out[i, 9 + k], out[i, 12 + k] = a[k], b[k], c[k], d[k], j[k]


@functools.cache
def pair_law_rows(law: WallKernel) -> Callable[..., None]:
    """Return the loop over ball-ball contacts by a law's own kernel: parameters a, m, kappa of both, e, mu, last number."""
    kernel(law)

    def rows(
        v1: Array, w1: Array, v2: Array, w2: Array, n: Array, p: Array, out: Array, required: Array, regime: Any
    ) -> None:
        for i in prange(v1.shape[0]):
            v, w = (v1[i, 0], v1[i, 1], v1[i, 2]), (w1[i, 0], w1[i, 1], w1[i, 2])
            u, r = (v2[i, 0], v2[i, 1], v2[i, 2]), (w2[i, 0], w2[i, 1], w2[i, 2])
            normal = (n[i, 0], n[i, 1], n[i, 2])
            before, spin, radius, kappa, m = pair_as_wall(
                v, w, u, r, p[i, 0], p[i, 1], p[i, 2], p[i, 3], p[i, 4], p[i, 5]
            )
            after, _spin = law(before, spin, normal, radius, kappa, p[i, 6], p[i, 7], p[i, 8])
            a, b, c, d, j = struck_as_wall(
                v, w, u, r, normal, before, after, m, p[i, 0], p[i, 1], p[i, 2], p[i, 3], p[i, 4], p[i, 5]
            )
            jn = dot(j, normal)
            f = (j[0] - jn * normal[0], j[1] - jn * normal[1], j[2] - jn * normal[2])
            required[i] = math.sqrt(dot(f, f)) / jn if jn > 0 else 0 * jn
            regime[i] = NO_REGIME if jn > 0 else GRAZE
            for k in range(3):
                out[i, k], out[i, 3 + k], out[i, 6 + k], out[i, 9 + k], out[i, 12 + k] = a[k], b[k], c[k], d[k], j[k]

    return fresh_unless_own(rows, law)


NAMES = np.array([*REGIMES, ""])  # (NO_REGIME is the last)
SMOOTH = Surface(restitution=1.0, friction=0.0)  # as balls of scenes are where a scene gives no numbers


@dataclass(frozen=True, eq=False)
class Collision:
    """Contact of two balls: states before and after, impulse and regime. Shapes (...) as in the states.

    Examples
    --------
    >>> import carom
    >>> ball, rest = carom.Ball(), carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    >>> hit = carom.collide(ball, carom.State((1.0, 0.0, 0.0), (0.0, 0.0, 0.0)), ball, rest)
    >>> hit.impulse.round(4).tolist(), hit.regime
    ([-0.1406, 0.0, 0.0], 'stick')
    """

    balls: tuple[Ball, Ball]
    before: tuple[State, State]
    after: tuple[State, State]
    impulse: Array
    """(..., 3), N s, on the first ball; the second receives the opposite impulse."""
    required_friction: Numbers
    """(...): the least friction with which the contact sticks; of a law of another kernel, tangential over normal impulse."""
    code: int | NDArray[np.int8]
    """(...): the regime as an integer."""

    @property
    def regime(self) -> Names:
        """ "stick", "slide" or "graze" (no impulse), "" where the law does not say: a string or an array (...)."""
        return name_codes(self.code, NAMES)

    @property
    def energy_lost(self) -> Numbers:
        """Kinetic energy lost by both balls together, (...), J."""
        pairs = zip(self.balls, self.before, self.after, strict=True)
        return sum(kinetic_energy(ball, old) - kinetic_energy(ball, new) for ball, old, new in pairs)


def collide(
    ball: Ball, state: State, other: Ball, other_state: State, normal: ArrayLike = (-1.0, 0.0, 0.0),
    surface: Surface = SMOOTH,
    law: str | Law = "contact", stiffness_ratio: ArrayLike = LIKE_SOLIDS,
) -> Collision:  # fmt: skip
    """Compute the contact of two balls: a law of ball and wall, by default (19), (28)-(31), with the reduced masses of the pair.

    Parameters
    ----------
    ball, other : Ball
        The first and the second ball.
    state, other_state : State
        Their velocities (m/s) and spins (rad/s) before the contact, shape (...).
    normal : array (..., 3)
        From the centre of the second ball to the centre of the first; any length.
    surface : Surface
        Restitution, friction and tangential restitution between the two. Default: elastic and without friction, as balls of scenes
        that give no numbers.
    law : str or Law
        A law of one contact: "contact", "sliding", "sticking", "alciatore" (friction that falls with the slip),
        "maw" and "stronge" (tangential compliance), or one of your own ("file.py:name").
    stiffness_ratio : float or array (...)
        Tangential over normal stiffness of the contact, for the laws that read it.

    Returns
    -------
    Collision

    Raises
    ------
    CaromError
        If the balls move apart, a normal has zero length, or the law is not one of a single contact.

    Examples
    --------
    >>> import carom
    >>> ball, rest = carom.Ball(), carom.State((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    >>> striking = carom.State((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    >>> hit = carom.collide(ball, striking, ball, rest, surface=carom.Surface(restitution=0.95, friction=0.06))
    >>> [after.velocity.round(4).tolist() for after in hit.after]
    [[0.025, 0.0, 0.0], [0.975, 0.0, 0.0]]
    >>> thrown = carom.collide(ball, striking, ball, rest, (-0.866, 0.5, 0.0), law="alciatore").after[1].velocity
    >>> thrown.round(4).tolist()
    [0.7814, -0.3785, 0.0]
    """
    for field, value, kind in (("ball", ball, Ball), ("state", state, State), ("other", other, Ball),
                               ("other_state", other_state, State), ("surface", surface, Surface)):  # fmt: skip
        require_type("collide", field, value, kind)
    require_resolved("collide: state", state)
    require_resolved("collide: other_state", other_state)
    n = unit_normal(normal)
    balls = (ball, other)
    numbers = [x for b in balls for x in (b.radius, b.mass, b.kappa)]
    if not isinstance(law, str | Law):
        raise CaromError(f"collide: law: expected a name, file.py:name or a carom.Law, got {law!r:.60}")
    law = law_for_pairs(law if isinstance(law, Law) else find_law(law))
    rows, given = _loop_of(law, surface, stiffness_ratio)
    numbers += given
    shape = broadcast_shape(state.shape, other_state.shape, n.shape[:-1], *(np.shape(x) for x in numbers))
    v1, w1, v2, w2, normals = (
        np.broadcast_to(x, (*shape, 3)).reshape(-1, 3)
        for x in (state.velocity, state.spin, other_state.velocity, other_state.spin, n)
    )
    # (by more than the rounding of a turned normal)
    limit = ROUNDING * (np.abs(v1) + np.abs(v2)).sum(axis=-1)
    apart = (((v1 - v2) * normals).sum(axis=-1) > limit).reshape(shape)
    if apart.any():
        raise CaromError(
            f"collide: expected two balls that approach, got two that move apart{first_bad_index(apart)};"
            " the normal points from the second ball to the first"
        )
    if law.conditions is not approaches:
        _require_conditions(law, balls, state, other_state, n, surface, stiffness_ratio)
    count = len(v1)
    p = np.stack([np.broadcast_to(x, shape).reshape(count) for x in numbers], axis=-1)
    out, required, code = np.empty((count, 15)), np.empty(count), np.empty(count, dtype=np.int8)
    args = (np.ascontiguousarray(x) for x in (v1, w1, v2, w2, normals, p))
    loop_for(rows, count)(*args, out, required, code)
    part = [out[:, 3 * i : 3 * i + 3].reshape(*shape, 3) for i in range(5)]
    after = (State.of(part[0], part[1]), State.of(part[2], part[3]))
    scalars: list[Any] = [x[0].item() if shape == () else x.reshape(shape) for x in (required, code)]
    return Collision(balls, (state, other_state), after, part[4], *scalars)


def _loop_of(law: Law, surface: Surface, stiffness_ratio: ArrayLike) -> tuple[Callable[..., None], list[Any]]:
    """Return the loop that evaluates a law, and the numbers of the contact that it reads, with those that the law holds fixed."""
    e, mu, last = (law.pinned.get(name, getattr(surface, name)) for name in ON_WALL)
    if law.one_contact:
        mu, drop, rate = law.slip_friction or (mu, 0.0, 0.0)
        return pair_rows, [e, mu, last, drop, rate]
    if law.last == "stiffness_ratio":
        faults = FaultList("collide")
        last = checked_number(faults, "stiffness_ratio", stiffness_ratio, "a number > 0", lambda x: x > 0)
        faults.raise_if_any()
    return pair_law_rows(law.kernel), [e, mu, last]


def _require_conditions(
    law: Law,
    balls: tuple[Ball, Ball],
    state: State,
    other: State,
    n: Array,
    surface: Surface,
    stiffness_ratio: ArrayLike,
) -> None:
    """Raise CaromError where a law of walls would not take the one ball that the two are to each other."""
    b, c = balls
    given: list[Any] = [np.moveaxis(x, -1, 0) for x in (state.velocity, state.spin, other.velocity, other.spin)]
    given += [b.radius, b.mass, b.kappa, c.radius, c.mass, c.kappa]
    v, w, a, kappa, m = pair_as_wall(*given)
    relative = State.of(np.stack(v, axis=-1), np.stack(np.broadcast_arrays(*w), axis=-1))
    meeting = Meeting(Ball(a, m, kappa), relative, n, surface, stiffness_ratio=np.asarray(stiffness_ratio, dtype=float))
    for holds, expected, *_field in law.conditions(meeting):
        if not np.all(holds):
            raise CaromError(f"collide: expected {expected}, for the law {law.name}")


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
