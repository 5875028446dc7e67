"""Results of impacts: one contact, the flight and landing that follow, the two-step law step by step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, State, Surface, kinetic_energy
from carom.core.contact import REGIMES

__all__ = [
    "GRAVITY", "PAPER_FLOOR", "PAPER_WALL", "REGIME_NAMES", "Flight", "FloorContact", "Impact", "Settled", "TwoStep",
    "angle_from", "as_column", "name_codes",
]  # fmt: skip

Array = NDArray[np.float64]
FloorContact = Literal["with", "after"]
"""A ball on the floor that the wall pushes down: wall and floor at once, or the wall alone and then the floor."""

GRAVITY = 9.80665  # m/s^2
PAPER_WALL = Surface(restitution=1.0, friction=math.inf)
PAPER_FLOOR = Surface(restitution=0.0, friction=math.inf)

# Regimes of an impact by code; the last three belong to wall and floor at once.
REGIME_NAMES = np.array([*REGIMES, "jam", "stall", "undefined"])


def name_codes(code: Any, names: NDArray[np.str_]) -> Any:
    """Return the names of integer codes (...): a string for one, an array of strings for many."""
    found = names[code]
    return str(found) if found.ndim == 0 else found


def as_column(x: Any) -> Any:
    """Return a number as it is, an array (...) as (..., 1), to multiply vectors with."""
    return x if np.ndim(x) == 0 else np.asarray(x)[..., None]


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
        return name_codes(self.code, REGIME_NAMES)

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
