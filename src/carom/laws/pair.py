"""Ball against ball: one contact with the masses of the pair.

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

from carom.bodies import Ball, Numbers, State, Surface, kinetic_energy
from carom.core.contact import GRAZE, NO_REGIME, REGIMES, contact, friction_at_slip
from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel, prange, vector
from carom.core.motion.phases import ROUNDING
from carom.errors import CaromError, FaultList, broadcast_shape, checked_number, require_type
from carom.laws.arrays import WallKernel, answer_rows, bad_row, fresh_unless_own, require_resolved, unit_normal
from carom.laws.landing import Names, name_codes
from carom.laws.law import ON_WALL, Law, Meeting, approaches
from carom.laws.registry import find_law, law_for_pairs
from carom.public.defaults import LIKE_SOLIDS

Array = NDArray[np.float64]


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


@kernel
def contact_answer(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float,
    e: float, mu: float, beta: float, drop: float, rate: float,
) -> tuple[Vec, Vec, Vec, Vec, Vec, float, int]:  # fmt: skip
    """:func:`pair_contact` with a friction that falls with the slip, by ``drop`` and ``rate``."""
    _un, ut = pair_slip(v1, w1, v2, w2, n, a1, a2)
    mu = friction_at_slip(mu, drop, rate, math.sqrt(dot(ut, ut)))
    return pair_contact(v1, w1, v2, w2, n, a1, m1, kappa1, a2, m2, kappa2, e, mu, beta)


@kernel
def law_answer(
    v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec, before: Vec, after: Vec, m: float,
    a1: float, m1: float, kappa1: float, a2: float, m2: float, kappa2: float,
) -> tuple[Vec, Vec, Vec, Vec, Vec, float, int]:  # fmt: skip
    """:func:`struck_as_wall`, with tangential over normal impulse and a regime as :func:`contact_answer` has them."""
    a, b, c, d, j = struck_as_wall(v1, w1, v2, w2, n, before, after, m, a1, m1, kappa1, a2, m2, kappa2)
    jn = dot(j, n)
    f = (j[0] - jn * n[0], j[1] - jn * n[1], j[2] - jn * n[2])
    required = math.sqrt(dot(f, f)) / jn if jn > 0 else 0 * jn
    return a, b, c, d, j, required, NO_REGIME if jn > 0 else GRAZE


@hot_kernel
def _row(x: Any, i: int) -> Vec:
    return x[i, 0], x[i, 1], x[i, 2]


@hot_kernel
def _put(x: Any, i: int, to: Vec) -> None:
    x[i, 0], x[i, 1], x[i, 2] = to


def pair_rows(
    v1: Array, w1: Array, v2: Array, w2: Array, n: Array, p: Array,
    v3: Array, w3: Array, v4: Array, w4: Array, j: Array, required: Array, regime: Any,
) -> None:  # fmt: skip
    """Evaluate ball-ball contacts; parameters a, m, kappa of both, e, mu, beta, drop and rate of mu with the slip."""
    sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
    for i in prange(v1.shape[0]):
        k = i * sp
        a, b, c, d, f, required[i], regime[i] = contact_answer(
            _row(v1, i), _row(w1, i), _row(v2, i), _row(w2, i), _row(n, i * sn),
            p[k, 0], p[k, 1], p[k, 2], p[k, 3], p[k, 4], p[k, 5], p[k, 6], p[k, 7], p[k, 8], p[k, 9], p[k, 10],
        )  # fmt: skip
        _put(v3, i, a), _put(w3, i, b), _put(v4, i, c), _put(w4, i, d), _put(j, i, f)


@functools.cache
def pair_law(law: WallKernel) -> tuple[Callable[..., Any], Callable[..., None]]:
    """Return a law's own kernel as a function of two balls, and the loop over rows: parameters a, m, kappa of both, e, mu, last."""
    kernel(law)

    def answer(v1: Vec, w1: Vec, v2: Vec, w2: Vec, n: Vec, *p: float) -> Any:
        before, spin, radius, kappa, m = pair_as_wall(v1, w1, v2, w2, *p[:6])
        return law_answer(v1, w1, v2, w2, n, before, law(before, spin, n, radius, kappa, *p[6:])[0], m, *p[:6])

    def rows(
        v1: Array, w1: Array, v2: Array, w2: Array, n: Array, p: Array,
        v3: Array, w3: Array, v4: Array, w4: Array, j: Array, required: Array, regime: Any,
    ) -> None:  # fmt: skip
        sn, sp = min(n.shape[0] - 1, 1), min(p.shape[0] - 1, 1)
        for i in prange(v1.shape[0]):
            k, normal = i * sp, _row(n, i * sn)
            v, w, u, r = _row(v1, i), _row(w1, i), _row(v2, i), _row(w2, i)
            before, spin, radius, kappa, m = pair_as_wall(
                v, w, u, r, p[k, 0], p[k, 1], p[k, 2], p[k, 3], p[k, 4], p[k, 5]
            )
            after, _spin = law(before, spin, normal, radius, kappa, p[k, 6], p[k, 7], p[k, 8])
            a, b, c, d, f, required[i], regime[i] = law_answer(
                v, w, u, r, normal, before, after, m, p[k, 0], p[k, 1], p[k, 2], p[k, 3], p[k, 4], p[k, 5]
            )
            _put(v3, i, a), _put(w3, i, b), _put(v4, i, c), _put(w4, i, d), _put(j, i, f)

    return answer, fresh_unless_own(rows, law)


@kernel
def move_apart(v1: Vec, v2: Vec, n: Vec) -> bool:
    """Return whether two balls move apart, by more than the rounding of a turned normal; of numbers or of arrays."""
    speeds = (abs(v1[0]) + abs(v2[0])) + (abs(v1[1]) + abs(v2[1])) + (abs(v1[2]) + abs(v2[2]))
    return dot((v1[0] - v2[0], v1[1] - v2[1], v1[2] - v2[2]), n) > ROUNDING * speeds


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
    answer, rows, given = _loop_of(law, surface, stiffness_ratio)
    vectors = (state.velocity, state.spin, other_state.velocity, other_state.spin, n)
    one = max(x.ndim for x in vectors) == 1
    if not one:
        broadcast_shape(*(x.shape[:-1] for x in vectors))
    apart: Any = move_apart(
        *(vector(x.tolist() if one else np.moveaxis(x, -1, 0)) for x in (state.velocity, other_state.velocity, n))
    )
    if apart is not False and np.any(apart):
        shape = broadcast_shape(np.shape(apart), *map(np.shape, (*numbers, *given)))
        raise CaromError(
            f"collide: expected two balls that approach, got two that move apart"
            f"{bad_row(np.broadcast_to(apart, shape))}; the normal points from the second ball to the first"
        )
    if law.conditions is not approaches:
        _require_conditions(law, balls, state, other_state, n, surface, stiffness_ratio)
    v3, w3, v4, w4, j, required, code = answer_rows(answer, rows, "vvvvvxc", vectors, [*numbers, *given])
    after = (State.of(v3, w3), State.of(v4, w4))
    return Collision(balls, (state, other_state), after, j, required, code)


def _loop_of(law: Law, surface: Surface, stiffness_ratio: ArrayLike) -> tuple[Any, Any, list[Any]]:
    """Return the functions that evaluate a law for one pair and for rows, and the contact's numbers, fixed ones included."""
    e, mu, last = (law.pinned.get(name, getattr(surface, name)) for name in ON_WALL)
    if law.one_contact:
        mu, drop, rate = law.slip_friction or (mu, 0.0, 0.0)
        return contact_answer, pair_rows, [e, mu, last, drop, rate]
    if law.last == "stiffness_ratio":
        faults = FaultList("collide")
        last = checked_number(faults, "stiffness_ratio", stiffness_ratio, "a number > 0", lambda x: x > 0)
        faults.raise_if_any()
    return *pair_law(law.kernel), [e, mu, last]


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


# ----------------------------------------------------------------------------------------------------
# Elastic contacts that take time: Hertz's force, Tsuji's damping, and how long a contact lasts.
#
# Two spheres that overlap by d push each other apart with k d^(3/2), k = (4/3) E* sqrt(R*), R* = a1 a2 / (a1 + a2), and for balls
# of one material E* = E / (2 (1 - nu^2)). The damping alpha sqrt(m k) d^(1/4) d' of a pair of reduced mass m takes energy, and
# with it the restitution does not depend on the speed: with s = d^(5/4) the collision is a linear oscillator, damped by zeta =
# alpha / sqrt(5), whose force must not pull.
#
# Sources: K. L. Johnson, Contact Mechanics (1985), 4.2 and 11.4, for the force and the duration; Y. Tsuji, T. Tanaka & T. Ishida,
# Powder Technol. 71, 239 (1992), for the damping; T. Schwager & T. Poschel, Granular Matter 9, 465 (2007), for e(zeta) of a force
# that does not pull.


YOUNG, POISSON = 5.84e9, 0.34  # of phenolic resin, Pa: billiard balls
# A contact lasts so many times (5 m / (4 k))^(2/5) u^(-1/5): 2 integral_0^1 dx / sqrt(1 - x^(5/2)) (Johnson, 11.24)
HERTZ = 2.9432750577
# With no restitution the damping would be infinite: what is less is taken as this.
LEAST_RESTITUTION = 0.0025
# Of P, a least-squares fit in Chebyshev polynomials.
COEFFICIENTS = (
    1.1196849324153881, -0.13902538683193966, -3.1090936685820822, 14.863043708104325, -47.5275482786091,
    107.84581012267606, -170.29573382573017, 181.48228305157005, -123.94875213598415, 48.8624328960576,
    -8.441341868424027,
)  # fmt: skip


def contact_modulus(young: float, poisson: float) -> float:
    """Return E* of two balls of one material, Pa.

    >>> round(contact_modulus(5.84e9, 0.34) / 1e9, 3)
    3.302
    """
    return young / (2 * (1 - poisson * poisson))


@kernel
def stiffness(modulus: float, a1: float, a2: float) -> float:
    """Return k (N/m^(3/2)) of two balls of radii a1 and a2, whose E* is ``modulus``."""
    return 4 * modulus * math.sqrt(a1 * a2 / (a1 + a2)) / 3


@kernel
def fifth_root(y: float) -> float:
    """Return y^(1/5) of a positive number, by z = (y/z)^(1/4): each step leaves a quarter of the error of its logarithm."""
    z = math.sqrt(math.sqrt(y))
    for _ in range(30):
        z = math.sqrt(math.sqrt(y / z))
    return z


@kernel
def contact_time(m: float, k: float, speed: float) -> float:
    """Return how long two balls of reduced mass m touch without damping, s: 2.943 (5 m / (4 k))^(2/5) u^(-1/5).

    >>> k = stiffness(contact_modulus(5.84e9, 0.34), 0.028575, 0.028575)
    >>> round(1e6 * contact_time(0.085, k, 1.0))
    390
    """
    x = 5 * m / (4 * k)
    return HERTZ * fifth_root(x * x / speed)


@kernel
def lasts_longer(m: float, k: float, speed: float, time: float) -> bool:
    """Return whether such a contact lasts longer than a time (s): no root is taken."""
    x, t = 5 * m / (4 * k), time / HERTZ
    square = t * t
    return bool(square * square * t * speed <= x * x)


@kernel
def damping(e: float) -> float:
    """Return Tsuji's alpha of a restitution: with it two balls have e, within 2e-6, from 0.0025 to 1; below, that of 0.0025.

    A polynomial (1 - e) P(sqrt(e)) / sqrt(e) through the roots of e(zeta), which has no inverse in closed form.

    >>> [round(damping(e), 4) for e in (1.0, 0.95, 0.5, 0.1)]
    [0.0, 0.0369, 0.5708, 2.7799]
    """
    r = math.sqrt(max(e, LEAST_RESTITUTION + 0 * e))
    p = COEFFICIENTS[10] + 0 * r
    for j in range(9, -1, -1):
        p = COEFFICIENTS[j] + r * p
    return (1 - r * r) * p / r
