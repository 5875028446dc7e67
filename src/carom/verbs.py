"""What people call: `impact`, `two_step`, `conventional`, `mirror`, `no_slip`, `collide`; one state or many.

Each checks what it is handed, lets the kernel of the law answer for every row (in Python for a few, compiled for many,
with the same bits), and packs the answer. Shapes (...) are those of the states, normals and numbers broadcast together.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.ball import Ball
from carom.checks import Faults, expect, first_index, number
from carom.errors import CaromError
from carom.laws.contact import REGIMES, wall_contact
from carom.laws.landing import ROLLS, WHY
from carom.laws.two_step import UNDEFINED, first_impact, second_impact
from carom.loops import contact_final, contact_full, first_rows, loop_for, second_rows, two_step_final_rows
from carom.rows import Rows, require_approach, rows_of, unit_normal
from carom.state import State, kinetic_energy
from carom.surface import Surface

__all__ = [
    "FLOOR",
    "GRAVITY",
    "WALL",
    "Flight",
    "Impact",
    "Settled",
    "TwoStep",
    "angle_from",
    "answer_rows",
    "impact",
    "impact_into",
    "settle",
    "two_step",
    "two_step_into",
]

Array = NDArray[np.float64]
FloorContact = Literal["with", "after"]

GRAVITY = 9.80665  # m/s^2
WALL = Surface(restitution=1.0, friction=math.inf)  # the paper's wall: e = 1, sticks
FLOOR = Surface(restitution=0.0, friction=math.inf)  # the paper's floor: e = 0, sticks

# Regimes of an impact by code; the last three belong to wall and floor at once.
NAMES = np.array([*REGIMES, "jam", "stall", "undefined"])
REASONS = np.array([*WHY])


def named(code: Any, names: NDArray[np.str_]) -> Any:
    """The names of codes: a string for one, an array of them for many."""
    found = names[code]
    return str(found) if found.ndim == 0 else found


@dataclass(frozen=True, eq=False)
class Impact:
    """One impact: the states before and after, and how it came about. Shapes as the states'."""

    ball: Ball
    before: State
    after: State
    impulse: Array
    """(..., 3), N s, on the ball."""
    required_friction: Any
    """(...): the friction from which on the contact holds (with the floor's help: the one that was used)."""
    code: Any

    @property
    def regime(self) -> Any:
        """ "stick", "slide", "graze" (nothing pressed), "jam" (wedged between wall and floor): a string or an array."""
        return named(self.code, NAMES)

    @property
    def energy_lost(self) -> Any:
        """(...), J."""
        return kinetic_energy(self.ball, self.before) - kinetic_energy(self.ball, self.after)


@dataclass(frozen=True)
class Flight:
    """Between wall and floor; zeros where the ball does not fly."""

    duration: Any
    """(...), s."""
    height: Any
    """(...), m: how far the centre rises above its place on the floor."""
    distance: Any
    """(...), m, along the floor."""


@dataclass(frozen=True, eq=False)
class Settled:
    """What the floor makes of a ball that leaves a wall. Shapes as the states'."""

    normal: Array
    flight: Flight
    after_floor: State
    """After the first landing; the state itself where the ball was not lifted."""
    floor: Impact
    rolling: State
    """The state once the ball rolls again; NaN where ``rolls`` is False."""
    rolls: Any
    why: Any
    """Why it never rolls, or meets the wall first; empty where it rolls."""

    @property
    def reflection_angle(self) -> Any:
        """(...), rad, of the rolling ball's velocity, from the wall's normal (its part along the floor)."""
        return angle_from(self.normal, self.rolling)


@dataclass(frozen=True, eq=False)
class TwoStep(Settled):
    """The two-step law's answer, step by step. Shapes as the states'."""

    after_wall: State
    wall: Impact
    floor_impulse: Array
    """(..., 3), N s: what the floor gave while the wall acted (a ball that the wall presses down)."""


def angle_from(normal: Array, state: State, *, incoming: bool = False) -> Any:
    """Angle (...) of a velocity along the floor from the normal, rad: 0 square, pi/2 along the wall, more towards it."""
    level = normal[..., :2] / np.sqrt((normal[..., :2] ** 2).sum(axis=-1, keepdims=True))
    x, y = state.velocity[..., 0], state.velocity[..., 1]
    along = np.abs(level[..., 0] * y - level[..., 1] * x)
    out = level[..., 0] * x + level[..., 1] * y
    angle = np.arctan2(along, -out if incoming else out)
    return float(angle) if angle.ndim == 0 else angle


def answer_rows(
    kernel: Callable[..., Any], loop: Callable[..., None], rows: Rows, widths: str, *more: Any
) -> list[Any]:
    """What a kernel returns for every row, in its order: "v" a vector (..., 3), "x" a number, "c" a code.

    One row goes straight through the kernel, as Python numbers; many go through the loop.
    """
    if rows.shape == ():
        found = kernel(
            *(tuple(x[0].tolist()) for x in (rows.velocity, rows.spin, rows.normal)),
            *rows.parameters[0].tolist(),
            *more,
        )
        return [np.array(x) if kind == "v" else x for x, kind in zip(found, widths, strict=True)]
    n = rows.count
    out: list[NDArray[Any]] = [
        np.empty((n, 3)) if kind == "v" else np.empty(n, dtype=float if kind == "x" else np.int8) for kind in widths
    ]
    loop_for(loop, n)(rows.velocity, rows.spin, rows.normal, rows.parameters, *more, *out)
    return [x.reshape(*rows.shape, *x.shape[1:]) for x in out]


def impact(ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), surface: Surface = WALL) -> Impact:
    """One contact of a ball with a surface: it sticks, slides or rebounds tangentially.

    Parameters
    ----------
    ball : Ball
    state : State
        Shape (...). It must move towards the surface, or along it.
    normal : array (..., 3)
        From the surface to the ball; any length.
    surface : Surface
        Restitution e, friction mu, tangential restitution beta.

    Returns
    -------
    Impact. Source: the paper, (19), (28)-(31); Walton & Braun, J. Rheol. 30, 949 (1986).

    Raises
    ------
    CaromError where a ball moves away, or a normal has no length.
    """
    expect("impact", "surface", surface, Surface)
    n = unit_normal(normal)
    require_approach(ball, state, n)
    rows = rows_of(
        state, n, ball.radius, ball.kappa, surface.restitution, surface.friction, surface.tangential_restitution
    )
    v1, w1, j, required, code = answer_rows(wall_contact, contact_full, rows, "vvvxc")
    return Impact(ball, state, State.of(v1, w1, state.position), j * _column(ball.mass), required, code)


def _column(x: Any) -> Any:
    """A number, or an array (...) as (..., 1), to multiply vectors with."""
    return x if np.ndim(x) == 0 else np.asarray(x)[..., None]


def impact_into(
    out: State, ball: Ball, state: State, normal: ArrayLike = (1.0, 0.0, 0.0), surface: Surface = WALL
) -> None:
    """:func:`impact`, only the state after, into arrays (N, 3) that exist: one normal, one ball, one surface for all.

    Nothing is checked and nothing allocated: this runs at the speed of memory. Balls that move away are left as they are.
    """
    parameters = (ball.radius, ball.kappa, surface.restitution, surface.friction, surface.tangential_restitution)
    v, w, v1, w1 = _flat(state, out)
    loop_for(contact_final, len(state.velocity))(v, w, unit_normal(normal), np.array(parameters), v1, w1)


def _flat(state: State, out: State) -> list[Array]:
    """Velocities and spins of both states, (3 N,); what is written into must be contiguous, or a copy would be."""
    for name, array in (("velocity", out.velocity), ("spin", out.spin)):
        if not array.flags.c_contiguous or array.shape != state.velocity.shape:
            raise CaromError(
                f"out: {name}: expected a contiguous array of shape {state.velocity.shape}, got"
                f" {'shape ' + str(array.shape) if array.shape != state.velocity.shape else 'one that is not contiguous'}"
            )
    return [x.reshape(-1) for x in (state.velocity, state.spin, out.velocity, out.spin)]


def _settings(gravity: float, height: ArrayLike, floor_contact: str) -> tuple[float, Any, bool]:
    faults = Faults("two_step")
    g = number(faults, "gravity", gravity, "a number >= 0 in m/s^2", lambda x: x >= 0)
    h = number(faults, "height", height, "a length >= 0 in m", lambda x: x >= 0)
    if floor_contact not in ("with", "after"):
        expected = "'with' (wall and floor at once) or 'after' (the wall alone, then the floor)"
        faults.add("floor_contact", expected, repr(floor_contact))
    faults.done()
    return g, h, floor_contact == "with"


def two_step(
    ball: Ball,
    state: State,
    wall: Surface = WALL,
    floor: Surface = FLOOR,
    normal: ArrayLike = (1.0, 0.0, 0.0),
    gravity: float = GRAVITY,
    height: ArrayLike = 0.0,
    floor_contact: FloorContact = "with",
) -> TwoStep:
    """The two-step law: the wall, the flight, the floor, and rolling again.

    Parameters
    ----------
    ball : Ball
    state : State
        Shape (...): rolling, sliding or, at ``height`` > 0, flying towards the wall.
    wall, floor : Surface
        By default the paper's: wall e = 1, floor e = 0, both sticking.
    normal : array (..., 3)
        From the wall to the ball. With a vertical part below zero the wall touches above the centre, as cushions do.
    gravity : float
        m/s^2.
    height : float or array (...)
        Of the centre above its place on the floor when the ball meets the wall, m.
    floor_contact : "with" or "after"
        A ball on the floor that the wall pushes down: wall and floor at once (a rigid floor), or the wall alone and then
        the floor.

    Returns
    -------
    TwoStep. Source: the paper, (27)-(41); for the pressed ball :mod:`carom.laws.simultaneous`.

    Raises
    ------
    CaromError where a ball moves away from the wall, moves down through the floor, or where a wall with tangential
    restitution presses a ball on the floor (no law for both contacts at once: say ``floor_contact="after"``).
    """
    expect("two_step", "wall", wall, Surface)
    expect("two_step", "floor", floor, Surface)
    n = unit_normal(normal)
    require_approach(ball, state, n)
    g, h, together = _settings(gravity, height, floor_contact)
    if ball.planar:
        raise CaromError(
            "two_step: ball: expected a ball, got a disc in the plane, which has no floor; use carom.impact"
        )
    rows = rows_of(
        state, n, ball.radius, ball.kappa, wall.restitution, wall.friction, wall.tangential_restitution,
        floor.restitution, floor.friction, floor.tangential_restitution, h,
    )  # fmt: skip
    v1, w1, j, jf, required, code = answer_rows(first_impact, first_rows, rows, "vvvvxc", together)
    require_defined(code == UNDEFINED)
    after, mass = State.of(v1, w1, state.position), _column(ball.mass)
    hit = Impact(ball, state, after, j * mass, required, code)
    then = _settle(ball, after, floor, n, g, h)
    return TwoStep(**vars(then), after_wall=after, wall=hit, floor_impulse=jf * mass)


def settle(
    ball: Ball,
    state: State,
    floor: Surface = FLOOR,
    normal: ArrayLike = (1.0, 0.0, 0.0),
    gravity: float = GRAVITY,
    height: ArrayLike = 0.0,
) -> Settled:
    """What the floor makes of a ball that leaves a wall: flight, first landing, and the state in which it rolls again.

    ``state`` (...) is the state just after the wall, ``height`` the centre's above its place on the floor; the wall
    (``normal``) is needed to say where the ball meets it again before it rolls. Source: the paper, section 3.3.
    """
    g, h, _together = _settings(gravity, height, "with")
    return _settle(ball, state, floor, unit_normal(normal), g, h)


def _settle(ball: Ball, state: State, floor: Surface, n: Array, g: float, h: Any) -> Settled:
    rows = rows_of(
        state, n, ball.radius, ball.kappa, floor.restitution, floor.friction, floor.tangential_restitution, g, h
    )
    t, rise, far, v2, w2, j, required, code, v3, w3, why = answer_rows(second_impact, second_rows, rows, "xxxvvvxcvvc")
    after = State.of(v2, w2)
    landing = state
    if rows.shape != () or code:  # it landed: with the spin it had, and the velocity that the impulse then changed
        landing = State.of(v2 - j, np.broadcast_to(state.spin, v2.shape))
    return Settled(
        normal=n,
        flight=Flight(t, rise, far),
        after_floor=after,
        floor=Impact(ball, landing, after, j * _column(ball.mass), required, code),
        rolling=State.of(v3, w3),
        rolls=why == ROLLS,
        why=WHY[why] if rows.shape == () else REASONS[why],
    )


def require_defined(undefined: Any) -> None:
    """CaromError where a wall with tangential restitution presses a ball on the floor."""
    undefined = np.asarray(undefined)
    if undefined.any():
        raise CaromError(
            "two_step: wall: expected tangential_restitution 0 where the wall presses the ball on the floor (wall and floor"
            f" at once have no law with tangential restitution), got another{first_index(undefined)};"
            " say floor_contact='after'"
        )


def two_step_into(
    out: State, why: NDArray[np.int8], ball: Ball, state: State, wall: Surface = WALL, floor: Surface = FLOOR,
    normal: ArrayLike = (1.0, 0.0, 0.0), gravity: float = GRAVITY, height: float = 0.0, floor_contact: FloorContact = "with",
) -> None:  # fmt: skip
    """:func:`two_step`, only the rolling state, into arrays (N, 3) that exist; ``why`` (N,) int8 takes the reasons.

    One normal, one ball, one wall and floor for all; nothing is checked. ``why`` is 0 where the ball rolls; elsewhere the
    state is NaN, and ``carom.verbs.REASONS[why]`` says why.
    """
    g, h, together = _settings(gravity, height, floor_contact)
    parameters = (
        ball.radius, ball.kappa, wall.restitution, wall.friction, wall.tangential_restitution,
        floor.restitution, floor.friction, floor.tangential_restitution, g, h,
    )  # fmt: skip
    v, w, v3, w3 = _flat(state, out)
    loop = loop_for(two_step_final_rows, len(state.velocity))
    loop(v, w, unit_normal(normal), np.array(parameters), together, v3, w3, why)
