"""The cue strike: the tip of a cue meets a ball at rest, grips it or slips (a miscue), and sets it in motion.

The axis of the cue is c, from the cue to the ball. The tip touches at the fraction s of the radius from the axis through the ball's
centre, towards the unit vector q; k = sqrt(1 - s^2), so that the normal into the ball is n = k c - s q. Along c the cue has its
mass M; across, in the short time of the contact, only its effective end mass m_e.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball, Numbers, State, holds_arrays
from carom.core.jit.kernel import kernel, prange
from carom.errors import (
    CaromError,
    FaultList,
    broadcast_shape,
    checked_number,
    first_bad_index,
    float_array,
    require_type,
)
from carom.laws.arrays import loop_for
from carom.laws.law import Card

Array = NDArray[np.float64]

CARD = Card(
    name="cue-strike",
    summary="A cue's tip grips the ball or slips; its end mass makes the ball squirt aside; restitution acts along the cue.",
    assumptions=(
        "contact at one point, with Coulomb friction between tip and ball",
        "the ball is at rest, and meets nothing else while the tip touches it (about 1 ms)",
        "across its axis the cue answers with an effective end mass, along it with its whole mass; the hand adds nothing",
    ),
    valid=(
        "Speed and squirt of a chalked tip up to the miscue limit, about half a radius. The slate answers a cue that points down "
        "after the tip has left: a scene's floor does it at once."
    ),
    equations="Kim (2022), sections II and III; Alciatore, TP A.30, TP A.31, TP 2.1; Shepard (2001)",
    citation=(
        "H.-C. Kim, Motions of a billiard ball after a cue stroke, New Phys. Sae Mulli 72, 208 (2022), arXiv 2104.11232; "
        "D. G. Alciatore, technical proofs TP A.30 (speed and spin), TP A.31 (squirt), TP 2.1 (miscue), billiards.colostate.edu"
        " (undated); "
        "R. Shepard, Everything you always wanted to know about cue ball squirt, preprint (2001)."
    ),
    doi="10.3938/NPSM.72.208",
)


@kernel
def tip_impulse(
    s: float, a: float, m: float, kappa: float, cue_mass: float, end_mass: float, e: float, mu: float
) -> tuple[float, float, float, float, int]:
    """Impulse along c and q, per speed of the cue; spin about q x c, per speed; required friction; 1 where the tip slips.

    ``s`` is the offset in radii. Relative velocity W J of tip and ball that an impulse J takes away: W = W_ball + c c/M + q q/m_e.
    """
    k = math.sqrt(1 - s * s)
    wcc = (1 + s * s / kappa) / m + 1 / cue_mass
    wcq = k * s / kappa / m
    wqq = (1 + k * k / kappa) / m + 1 / end_mass
    # TP A.31: the tip grips, so that tip and ball end with one velocity across the cue; tan of the squirt
    tan_squirt = wcq / wqq
    # TP A.30, Kim (2022): restitution along the cue
    jc = (1 + e) / (wcc - wcq * tan_squirt)
    jq = -tan_squirt * jc
    # TP 2.1 with squirt: the angle of the impulse from the normal
    jn = k * jc - s * jq
    jt = s * jc + k * jq
    required = jt / jn
    slips = 0
    if required > mu:  # Coulomb: the tip slides along t = s c + k q
        slips = 1
        wnn = 1 / m + k * k / cue_mass + s * s / end_mass
        wnt = k * s * (1 / cue_mass - 1 / end_mass)
        jn = (1 + e) * k / (wnn + mu * wnt)
        jt = mu * jn
        jc = k * jn + s * jt
        jq = -s * jn + k * jt
    return jc, jq, jt / (kappa * m * a), required, slips


def _tip_rows(p: Array, out: Array) -> None:
    for i in prange(p.shape[0]):
        out[i, 0], out[i, 1], out[i, 2], out[i, 3], out[i, 4] = tip_impulse(
            p[i, 0], p[i, 1], p[i, 2], p[i, 3], p[i, 4], p[i, 5], p[i, 6], p[i, 7]
        )


@holds_arrays
@dataclass(frozen=True, init=False)
class Cue:
    """A cue: its mass, its effective end mass across the axis, and its tip.

    Parameters
    ----------
    mass : kg, > 0
        Default: 0.54 (19 oz).
    end_mass : kg, > 0
        What of the shaft moves aside with the tip during the contact. Default: 0.006, an estimate: a squirt of 2 degrees at half a
        radius; a low-squirt shaft has about 0.004, a heavy one 0.009.
    friction : >= 0
        Of the chalked tip. Default: 0.6 (TP 2.1 has 0.577 to 0.659, miscues at 0.5 to 0.55 radii).
    restitution : 0 to 1
        Default: 0.73, a leather tip of medium hardness (Alciatore: 0.71 to 0.75, phenolic tips 0.81 to 0.87).

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> round(carom.Cue(friction=0.6).miscue_offset(carom.Ball(0.028575, 0.17)), 3)
    0.546
    """

    mass: Numbers
    end_mass: Numbers
    friction: Numbers
    restitution: Numbers

    def __init__(
        self,
        mass: ArrayLike = 0.54,
        end_mass: ArrayLike = 0.006,
        friction: ArrayLike = 0.6,
        restitution: ArrayLike = 0.73,
    ) -> None:
        faults = FaultList("Cue")

        values = {
            "mass": checked_number(faults, "mass", mass, "a mass in kg, > 0", lambda x: x > 0),
            "end_mass": checked_number(faults, "end_mass", end_mass, "a mass in kg, > 0", lambda x: x > 0),
            "friction": checked_number(
                faults, "friction", friction, "a number >= 0 (inf: never slips)", lambda x: x >= 0, infinite=True
            ),
            "restitution": checked_number(
                faults, "restitution", restitution, "a number from 0 to 1", lambda x: (x >= 0) & (x <= 1)
            ),
        }
        faults.raise_if_any()
        for key, value in values.items():
            object.__setattr__(self, key, value)

    def miscue_offset(self, ball: Ball) -> float:
        """Return the largest offset in radii at which the tip still grips a ball, by bisection. CaromError for arrays."""
        numbers = (ball.radius, ball.mass, ball.kappa, self.mass, self.end_mass, self.restitution, self.friction)
        if any(np.ndim(x) for x in numbers):
            raise CaromError("miscue_offset: expected one ball and one cue, got arrays")
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = (low + high) / 2
            slips = tip_impulse(middle, *map(float, numbers))[4]
            low, high = (low, middle) if slips else (middle, high)
        return low


DEFAULT_CUE = Cue()


@dataclass(frozen=True, eq=False)
class Strike:
    """Result of a cue strike; shapes (...) as in its arguments.

    Examples
    --------
    >>> import carom
    >>> shot = carom.strike(carom.Ball(0.028575, 0.17), speed=3.0, offset=(0.4, 0.0))
    >>> round(float(shot.squirt_deg), 2), bool(shot.miscue), round(float(shot.required_friction), 3)
    (1.67, False, 0.402)
    """

    ball: Ball
    cue: Cue
    state: State
    """The ball just after the tip: velocity (..., 3) m/s, downwards where the cue points down, and spin (..., 3) rad/s."""
    impulse: Array
    """(..., 3), N s, on the ball."""
    cue_velocity: Array
    """(...), m/s: the cue along its axis, after the contact."""
    squirt_deg: Numbers
    """(...): between the cue's axis and the way the ball goes."""
    required_friction: Numbers
    """(...): what the tip needs so as not to slip."""
    miscue: bool | NDArray[np.bool_]
    """(...): whether it slips."""


def strike(
    ball: Ball,
    cue: Cue = DEFAULT_CUE,
    speed: ArrayLike = 2.0,
    azimuth_deg: ArrayLike = 0.0,
    elevation_deg: ArrayLike = 0.0,
    offset: ArrayLike = (0.0, 0.0),
) -> Strike:
    """Strike a ball at rest with a cue.

    Parameters
    ----------
    ball : Ball
    cue : Cue
    speed : array (...)
        Of the cue before the contact, m/s, > 0.
    azimuth_deg : array (...)
        Where the cue points, degrees, counterclockwise from +x as seen from above.
    elevation_deg : array (...)
        How far its butt is raised, degrees, 0 to 90: with 90 it points straight down.
    offset : array (..., 2)
        Where the tip touches, in radii from the cue's axis through the centre: to the player's right, and up. Shorter than 1.

    Returns
    -------
    Strike
        The state of the ball, the impulse, squirt, and whether the tip slips. Jump shots and masse need nothing else:
        a ball that is struck downwards meets the floor of a scene at once, and curves as it slides.

    Raises
    ------
    CaromError
        One line per problem, as for a tip that misses the ball.

    Notes
    -----
    Kim, New Phys. Sae Mulli 72, 208 (2022), arXiv 2104.11232; Alciatore, TP A.30 and TP A.31; see ``carom laws cue-strike``.

    Examples
    --------
    Struck 0.4 radii above its centre a ball nearly rolls at once; a central hit slides.

    >>> import carom
    >>> ball = carom.Ball(radius=0.028575, mass=0.17)
    >>> for up in (0.0, 0.4):
    ...     after = carom.strike(ball, speed=2.0, offset=(0.0, up)).state
    ...     print(round(float(after.velocity[0]), 3), round(float(after.spin[1] * ball.radius), 3))
    2.632 0.0
    2.05 1.913
    """
    require_type("strike", "ball", ball, Ball)
    require_type("strike", "cue", cue, Cue)
    faults = FaultList("strike")
    v0 = checked_number(faults, "speed", speed, "a speed in m/s, > 0", lambda x: x > 0)
    turn = checked_number(faults, "azimuth_deg", azimuth_deg, "an angle in degrees", np.isfinite)
    raised = checked_number(
        faults, "elevation_deg", elevation_deg, "an angle in degrees, 0 to 90", lambda x: (x >= 0) & (x <= 90)
    )
    right, up = _offset(faults, offset)
    faults.raise_if_any()
    s = np.hypot(right, up)
    parameters = (s, ball.radius, ball.mass, ball.kappa, cue.mass, cue.end_mass, cue.restitution, cue.friction)
    shape = broadcast_shape(*(np.shape(x) for x in (v0, turn, raised, *parameters)))
    rows = np.stack([np.broadcast_to(x, shape).reshape(-1) for x in parameters], axis=-1)
    found = np.empty((len(rows), 5))
    loop_for(_tip_rows, len(rows))(np.ascontiguousarray(rows, dtype=float), found)
    jc, jq, spin, required, slips = (x.reshape(shape) for x in found.T)

    c, q, across = _axes(np.broadcast_to(turn, shape), np.broadcast_to(raised, shape), right, up, s)
    impulse = np.asarray(v0)[..., None] * (jc[..., None] * c + jq[..., None] * q) + 0.0  # (no -0.0)
    state = State(velocity=impulse / np.asarray(ball.mass)[..., None], spin=np.asarray(v0 * spin)[..., None] * across)
    squirt = np.degrees(np.arctan2(-jq, jc))
    return Strike(ball, cue, state, impulse, v0 * (1 - jc / cue.mass), squirt[()], required[()], (slips > 0)[()])


def _offset(faults: FaultList, offset: ArrayLike) -> tuple[Array, Array]:
    """Return how far to the right and up the tip touches, in radii."""
    expected = "2 numbers, or an array (..., 2): to the right and up, in radii"
    try:
        found = float_array(offset)
    except (TypeError, ValueError):
        faults.add("offset", expected, repr(offset))
        return np.zeros(()), np.zeros(())
    if found.ndim == 0 or found.shape[-1] != 2:
        faults.add("offset", expected, f"shape {found.shape}")
        return np.zeros(()), np.zeros(())
    right, up = found[..., 0], found[..., 1]
    off = ~(np.hypot(right, up) < 1)
    if off.any():
        got = f"{found[off][0].tolist() if off.ndim else found.tolist()}{first_bad_index(off)}; the tip would miss the ball"
        faults.add("offset", "a point on the ball, less than 1 radius from its centre", got)
    return right, up


def _axes(turn: Array, raised: Array, right: Array, up: Array, s: Array) -> tuple[Array, Array, Array]:
    """Return c, q and q x c (..., 3): the cue's axis, the direction of the offset, and the axis of the spin."""
    (ca, sa), (ce, se) = ((np.cos(x), np.sin(x)) for x in (np.radians(turn), np.radians(raised)))
    c = np.stack([ce * ca, ce * sa, -se], axis=-1)
    to_right = np.stack([sa, -ca, np.zeros_like(sa)], axis=-1)
    upwards = np.stack([se * ca, se * sa, ce], axis=-1)
    far = np.where(s > 0, s, 1.0)
    x, y = (right / far)[..., None], (up / far)[..., None]
    return c, x * to_right + y * upwards, x * upwards - y * to_right
