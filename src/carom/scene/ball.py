"""A ball of a scene: its properties and its initial state."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import AfterValidator, BeforeValidator, model_validator

from carom.bodies import INERTIAS, Ball, State
from carom.core.jit.kernel import kernel
from carom.errors import MIN_MAGNITUDE, CaromError, Fault, shown, suggestion
from carom.laws.strike import DEFAULT_CUE, Cue, Strike, strike
from carom.scene.ruled import FaultText, Ruled, put_fault
from carom.scene.schema import (
    Angle,
    Components,
    Flag,
    Friction,
    Length,
    Mass,
    Model,
    Number,
    Share,
    Size,
    Speed,
    Spin,
    Vector,
    raise_faults,
    refused,
)

__all__ = ["KAPPA", "CueStrike", "Inertia", "SceneBall", "SceneCue"]

KAPPA = Number("'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3]", least=0, most=2 / 3 * (1 + 1e-12), above=True)


def _inertia(value: Any) -> str | float:
    if not isinstance(value, str):
        return KAPPA(value)
    if value not in INERTIAS:
        raise refused(KAPPA.what, shown(value), suggestion(value, list(INERTIAS)))
    return value


Inertia = Annotated[str | float, BeforeValidator(_inertia)]


def _three(value: tuple[float, ...]) -> Vector:
    return (value[0], value[1], value[2] if len(value) == 3 else 0.0)


class SceneCue(Model):
    """A cue in a scene: the numbers of :class:`carom.Cue`."""

    mass: Mass = float(DEFAULT_CUE.mass)
    end_mass: Mass = float(DEFAULT_CUE.end_mass)
    friction: Friction = float(DEFAULT_CUE.friction)
    restitution: Share = float(DEFAULT_CUE.restitution)


def _on_the_ball(value: tuple[float, float]) -> tuple[float, float]:
    if not math.hypot(*value) < 1:
        raise refused(_OFFSET.what, shown(list(value)), "the tip would miss the ball")
    return value


_OFFSET = Components("2 numbers, to the player's right and up in radii, less than 1 from the centre", (2,))


_Radii = Annotated[float, BeforeValidator(Number("a number in radii of the ball, such as 0.3"))]


class CueStrike(Model):
    """How a cue strikes a ball that is at rest: the arguments of :func:`carom.strike`.

    Parameters
    ----------
    speed : m/s, > 0, of the cue
    azimuth : degrees, counterclockwise from +x as seen from above; default: 0
    elevation : degrees, 0 to 90: how far the butt is raised; default: 0
    offset : 2 numbers, in radii: to the player's right, and up; default: the centre
    cue : SceneCue; default: an ordinary one

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0), strike={"speed": 2, "azimuth": 90, "offset": [0.2, 0]})
    >>> [round(float(v), 3) for v in ball.state.velocity]
    [-0.032, 2.364, 0.0]
    """

    speed: Annotated[float, BeforeValidator(Number("a speed in m/s, > 0", "m/s", least=0, above=True))]
    azimuth: Angle = 0.0
    elevation: Annotated[float, BeforeValidator(Number("an angle in degrees, 0 to 90", "degree", least=0, most=90))] = (
        0.0
    )
    offset: Annotated[tuple[_Radii, _Radii], BeforeValidator(_OFFSET), AfterValidator(_on_the_ball)] = (
        0.0,
        0.0,
    )
    cue: SceneCue = SceneCue()

    def on(self, ball: Ball) -> Strike:
        """Return its effect on a ball."""
        return strike(ball, Cue(**dict(self.cue)), self.speed, self.azimuth, self.elevation, self.offset)


@kernel
def _ball_rules(p: Any, out: Any) -> int:
    """Report motions that exclude each other; p: rolling, velocity after its length, spin (NaN: none), spin_z."""
    count, i = int(p[1]), 0
    largest = 0.0
    for k in range(2, len(p)):
        largest = max(largest, abs(p[k]))
    if p[0] != 0 and p[2 + count] == p[2 + count]:
        i = put_fault(0, 0.0, 0.0, 0.0, i, out)
    if p[0] != 0 and count == 3 and p[4] != 0:
        i = put_fault(1, p[4], 0.0, 0.0, i, out)
    if p[0] == 0 and p[5 + count] == p[5 + count]:
        i = put_fault(2, 0.0, 0.0, 0.0, i, out)
    return put_fault(3, MIN_MAGNITUDE, largest, 0.0, i, out) if 0 < largest < MIN_MAGNITUDE else i


class SceneBall(Ruled):
    """A ball and its initial state.

    Parameters
    ----------
    radius, mass : m and kg
    inertia : "solid", "hollow", or kappa = I/(m a^2); default: "solid"
    position : 2 or 3 lengths, m: the centre; two: on the floor (z = radius), or in the plane z = 0 of a scene without a floor
    velocity : 2 or 3 speeds, m/s; default: at rest
    rolling : whether it rolls on the floor: its spin follows from its velocity, except for ``spin_z``
    spin : 3 numbers, rad/s: angular velocity of a ball that does not roll; default: none
    spin_z : rad/s: sidespin of a ball that rolls; default: 0
    strike : how a cue strikes it, in place of velocity and spin: speed, azimuth, elevation, offset, cue (:class:`CueStrike`)
    name : its name in tables; default: its number

    Every number with a unit may also be a text such as "61.5 mm". Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius="30.75 mm", mass=0.21, position=(1.0, 0.5), velocity=(-2, 1), rolling=True)
    >>> [round(float(w), 3) for w in ball.state.spin]
    [-32.52, -65.041, 0.0]
    """

    rules: ClassVar = _ball_rules
    ruled: ClassVar = ("rolling", "velocity", "spin", "spin_z")
    fault_texts: ClassVar = (
        FaultText(
            "spin", "no spin with rolling = true", "{spin}",
            "the spin of a ball that rolls follows from its velocity, except for spin_z; leave out rolling, or spin",
        ),
        FaultText("velocity[2]", "no speed along z with rolling = true", "{a}"),
        FaultText("spin_z", "no spin_z without rolling = true", "{spin_z}", "give spin = [x, y, z]"),
        FaultText("velocity", "a ball at rest, or a component of velocity or spin of at least {a:g}", "{b}"),
    )  # fmt: skip

    radius: Size
    mass: Mass
    inertia: Inertia = "solid"
    position: Annotated[
        tuple[Length, ...], BeforeValidator(Components("2 or 3 lengths in m: x, y and z, of the centre", (2, 3)))
    ]
    velocity: Annotated[
        tuple[Speed, ...],
        BeforeValidator(Components("2 or 3 speeds in m/s: along x, y and z", (2, 3))),
        AfterValidator(_three),
    ] = (0.0, 0.0, 0.0)
    rolling: Flag = False
    spin: (
        Annotated[tuple[Spin, Spin, Spin], BeforeValidator(Components("3 spins in rad/s: about x, y and z", (3,)))]
        | None
    ) = None
    spin_z: Spin | None = None
    strike: CueStrike | None = None
    name: str | None = None

    @model_validator(mode="after")
    def _struck_at_rest(self) -> SceneBall:
        if self.strike is not None and (self.rolling or self.spin is not None or any(self.velocity)):
            advice = "a ball is struck at rest; leave out velocity, spin and rolling, or strike"
            raise_faults([Fault("", "strike", "no velocity and no spin with strike", "both", advice)])
        return self

    @classmethod
    def of(cls, ball: Ball, state: State, name: str | None = None) -> SceneBall:
        """Return the scene's ball for a carom.Ball and a carom.State with a position. CaromError for arrays and for discs."""
        where = "SceneBall.of"
        if ball.planar:
            raise CaromError(f"{where}: ball: expected a ball, got a disc")
        if state.position is None:
            raise CaromError(f"{where}: state: expected one with a position, got None; State(velocity, spin, position)")
        shape = np.broadcast_shapes(state.shape, state.position.shape[:-1], np.shape(ball.radius), np.shape(ball.mass))
        if shape:
            raise CaromError(Fault(f"{where}", "state", "one ball", f"shape {shape}", "make one SceneBall of each"))
        return cls(
            radius=float(ball.radius),
            mass=float(ball.mass),
            inertia=float(ball.kappa),
            position=tuple(state.position.tolist()),
            velocity=tuple(state.velocity.tolist()),
            spin=tuple(state.spin.tolist()),
            name=name,
        )

    @property
    def ball(self) -> Ball:
        """Return the ball without its state."""
        return Ball(self.radius, self.mass, self.inertia)

    @property
    def center(self) -> Vector:
        """Return its centre (3,), m; of two numbers, with z = radius."""
        x, y, *z = self.position
        return (x, y, z[0] if z else self.radius)

    @property
    def state(self) -> State:
        """Return the initial velocity, spin and position."""
        if self.strike is not None:
            struck = self.strike.on(self.ball).state
            return State(velocity=struck.velocity, spin=struck.spin, position=self.center)
        x, y, z = self.velocity
        spin = self.spin or (0.0, 0.0, 0.0)
        if self.rolling:  # (27)
            spin = (-y / self.radius, x / self.radius, self.spin_z or 0.0)
        return State(velocity=(x, y, z), spin=spin, position=self.center)
