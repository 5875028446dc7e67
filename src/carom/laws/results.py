"""Results of impacts: one contact, the flight and landing that follow, and the steps of the two-step law."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, Numbers, State, Surface, holds_arrays, kinetic_energy
from carom.core.contact import REGIMES
from carom.formatting import format_length, format_number, format_time
from carom.public.defaults import GRAVITY

__all__ = [
    "GRAVITY", "PAPER_FLOOR", "PAPER_WALL", "REASONS", "REGIME_NAMES", "WHY", "Flight", "FloorContact", "Impact", "Settled",
    "TwoStep", "angle_from", "as_column", "name_codes", "times_mass",
]  # fmt: skip

Array = NDArray[np.float64]
Names = str | NDArray[np.str_]  # one text, or an array of them
FloorContact = Literal["with", "after"]
"""Order of the contacts of a ball that the wall presses on the floor: both at once, or the wall first and then the floor."""

PAPER_WALL = Surface(restitution=1.0, friction=math.inf)
PAPER_FLOOR = Surface(restitution=0.0, friction=math.inf)

# Regimes of an impact by code; the last three occur only with wall and floor at once.
REGIME_NAMES = np.array([*REGIMES, "jam", "stall", "undefined"])
# Why a ball does not come to roll, by the codes of carom.laws.landing; empty where it rolls.
WHY = (
    "",
    "without gravity the ball does not return to the floor",
    "the floor has no friction, so the ball slides for ever",
    "the floor has restitution 1, so the ball bounces for ever",
    "the ball meets the wall again in flight, before it lands",
    "the ball meets the wall again before it rolls, because its spin turns it round",
    "undecided after a million bounces",
    "no law with tangential restitution covers wall and floor at once",
    "the ball is locked between wall and floor, and the integration stopped",
    "its spin turns the ball round: it rolls back to the wall and meets it again",
)
REASONS = np.array([*WHY])


def name_codes(code: Any, names: NDArray[np.str_]) -> Names:
    """Return the names of integer codes (...): a string for one, an array of strings for many."""
    found = names[code]
    return str(found) if found.ndim == 0 else found


def as_column(x: Any) -> Any:
    """Return a number unchanged and an array (...) as (..., 1), to multiply vectors by it."""
    return x if type(x) is float or np.ndim(x) == 0 else np.asarray(x)[..., None]


def times_mass(impulse: Array, mass: Any) -> Array:
    """Return impulses (..., 3) per unit of mass, times the mass: in place where it is a number, without new memory."""
    if type(mass) is float:
        impulse *= mass
        return impulse
    found: Array = impulse * as_column(mass)
    return found


@dataclass(frozen=True, eq=False, repr=False)
class Impact:
    """One impact: the states before and after, impulse, required friction and regime. Shapes as in the state.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> hit = carom.impact(ball, carom.rolling(ball, (-1.0, 1.0)), surface=carom.Surface(friction=0.1))
    >>> hit.regime, round(float(hit.required_friction), 4), round(hit.energy_lost, 4)
    ('slide', 0.202, 0.0299)
    """

    ball: Ball
    before: State
    after: State
    impulse: Array
    """(..., 3), N s, on the ball."""
    required_friction: Numbers
    """(...): the least friction with which the contact sticks (if the floor acts too: the friction that was mobilised)."""
    code: int | NDArray[np.int8]
    """(...): the regime as an integer."""

    def __repr__(self) -> str:
        """Return one line: regime, impulse and required friction of one impact; of many their shape."""
        if np.ndim(self.code):
            return f"<Impact of shape {np.shape(self.code)}>"
        impulse = ", ".join(format_number(float(x)) for x in self.impulse)
        return f"<Impact: {self.regime}, impulse ({impulse}) N s, required friction {format_number(float(self.required_friction))}>"

    @property
    def regime(self) -> Names:
        """ "stick", "slide", "graze" (no impulse) or "jam" (wedged between wall and floor): a string or an array (...)."""
        return name_codes(self.code, REGIME_NAMES)

    @property
    def energy_lost(self) -> Numbers:
        """Kinetic energy lost, (...), J."""
        return kinetic_energy(self.ball, self.before) - kinetic_energy(self.ball, self.after)


@holds_arrays
@dataclass(frozen=True)
class Flight:
    """Flight between wall and floor; zeros where the ball does not leave the floor.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> flight = carom.two_step(ball, carom.rolling(ball, (-1.0, 1.0))).flight
    >>> round(1000 * flight.height, 2)
    4.16
    """

    duration: Numbers
    """(...), s."""
    height: Numbers
    """(...), m: largest height of the centre above its position when the ball rests on the floor."""
    distance: Numbers
    """(...), m, along the floor."""


@dataclass(frozen=True, eq=False)
class Settled:
    """Flight, landing and final rolling of a ball that leaves a wall. Shapes as in the state.

    Examples
    --------
    >>> import carom
    >>> found = carom.settle(carom.Ball(), carom.State((0.5, 0.5, 0.2), (0.0, 0.0, 0.0)))
    >>> bool(found.rolls), round(found.reflection_angle, 4)
    (True, 0.7854)
    """

    normal: Array
    """(..., 3), of the wall, unit length."""
    flight: Flight
    after_floor: State
    """After the first landing; the state itself where the ball was not lifted."""
    floor: Impact
    """The first landing."""
    rolling: State
    """The state once the ball rolls again; NaN where ``rolls`` is False."""
    rolls: bool | NDArray[np.bool_]
    """(...): whether the ball comes to roll before it meets the wall again."""
    why_code: int | NDArray[np.int8]
    """(...): why it does not, as an integer; 0 where it rolls."""

    @property
    def why(self) -> Names:
        """Why the ball does not come to roll, a text or an array (...) of them; empty where it rolls."""
        return name_codes(self.why_code, REASONS)

    @property
    def reflection_angle(self) -> Numbers:
        """Angle (...) between the final velocity and the wall's normal, both projected on the floor, rad."""
        return angle_from(self.normal, self.rolling)


@dataclass(frozen=True, eq=False, repr=False)
class TwoStep(Settled):
    """Prediction of the two-step law, step by step. Shapes as in the state.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Ball()
    >>> steps = carom.two_step(ball, carom.rolling(ball, (-1.0, 1.0)))
    >>> steps.wall.regime, steps.floor.regime, bool(steps.rolls)
    ('stick', 'stick', True)
    """

    after_wall: State
    """Velocity and spin just after the wall."""
    wall: Impact
    """The contact with the wall."""
    floor_impulse: Array
    """(..., 3), N s: impulse of the floor during the wall contact (for a ball that the wall presses down)."""

    def __repr__(self) -> str:
        """Return one line: final angle, flight, and what the contacts did; of many balls their shape."""
        if self.after_wall.shape:
            return f"<TwoStep of shape {self.after_wall.shape}>"
        flight = f"flight {format_time(float(self.flight.duration))}, {format_length(float(self.flight.height))} high"
        end = (
            f"reflected at {format_number(math.degrees(self.reflection_angle), 4)} degrees"
            if self.rolls
            else str(self.why)
        )
        return f"<TwoStep: {end}, {flight}, wall {self.wall.regime}, floor {self.floor.regime}>"


def angle_from(normal: Array, state: State, *, incoming: bool = False) -> Numbers:
    """Angle (...) of a velocity along the floor from the normal, rad: 0 normal, pi/2 along the wall, more towards it.

    NaN where the normal is vertical.
    """
    with np.errstate(invalid="ignore"):
        level = normal[..., :2] / np.sqrt((normal[..., :2] ** 2).sum(axis=-1, keepdims=True))
    x, y = state.velocity[..., 0], state.velocity[..., 1]
    along = np.abs(level[..., 0] * y - level[..., 1] * x)
    out = level[..., 0] * x + level[..., 1] * y
    angle = np.arctan2(along, -out if incoming else out)
    return float(angle) if angle.ndim == 0 else angle
