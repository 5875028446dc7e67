"""A scene: gravity, floor, walls, balls, and how it is run. The same from Python and from TOML, with the same words."""

from __future__ import annotations

import functools
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, field_validator, model_validator
from pydantic_core.core_schema import ValidationInfo

from carom.law import Law
from carom.own_law import find_law
from carom.scene.balls import SceneBall
from carom.scene.check import scene_faults
from carom.scene.faults import Fault, Model, Words, refuse
from carom.scene.features import FEATURES
from carom.scene.quantities import Acceleration, Components, Friction, NotNegative, Number, Spring, Time
from carom.scene.restitution import Bounce, Constant
from carom.scene.wall import BUILT_IN, Contact, LawChoice, contact, law_name
from carom.scene.walls import AnyWall
from carom.units import of_time

__all__ = ["BallContact", "Floor", "Run", "Scene"]


class Floor(Model):
    """The plane z = 0, under the balls.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; left out: 0
    friction : >= 0, or inf: of impacts and of sliding
    tangential_restitution : -1 to 1; left out: 0
    rolling_resistance : deceleration / g while rolling; left out: 0
    spin_friction : |d omega_z / dt| = spin_friction g / (kappa a); left out: 0
    """

    restitution: Bounce = Constant(value=0.0)
    friction: Friction
    tangential_restitution: Spring = 0.0
    rolling_resistance: NotNegative = 0.0
    spin_friction: NotNegative = 0.0

    @property
    def contact(self) -> Contact:
        """Its surface as numbers."""
        return contact(self.restitution, self.friction, self.tangential_restitution)


class BallContact(Model):
    """What two balls do that meet; left out: smooth and elastic."""

    restitution: Bounce = Constant(value=1.0)
    friction: Friction = 0.0
    tangential_restitution: Spring = 0.0

    @property
    def contact(self) -> Contact:
        """The contact as numbers."""
        return contact(self.restitution, self.friction, self.tangential_restitution)


def _count(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
        raise Fault("a whole number >= 1", value).error()
    return int(value)


class Run(Model):
    """How it is run.

    Parameters
    ----------
    law : what the walls do: "two-step", "conventional", "no-slip", "mirror", "maw", "stronge", "file.py:name", or a carom.Law
    duration : s, optional
    max_events : optional
    floor_contact : "with": wall and floor act at once on a ball that the wall presses on the floor; "after": one by one
    """

    law: LawChoice = "two-step"
    duration: Time | None = None
    max_events: Annotated[int, BeforeValidator(_count)] | None = None
    floor_contact: Literal["with", "after"] = "with"


_GRAVITY = Number("an acceleration in m/s^2, or 3 of them", "m/s^2")
_VECTOR = Components(_GRAVITY.what, (3,))


def _gravity(value: Any) -> tuple[Any, ...]:
    several = isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)
    return _VECTOR(value) if several else (0.0, 0.0, -_GRAVITY(value))


class Scene(Model):
    """Gravity, floor, walls, balls, and how they are run.

    Parameters
    ----------
    gravity : m/s^2: a number, downwards, or a vector
    floor : Floor, optional
    walls : walls of any shape
    balls : SceneBalls, at least one
    ball_contact : BallContact
    run : Run

    A scene is checked as a whole when it is made: what overlaps, what a law lacks. Raises CaromError, one line a fault.
    """

    gravity: Annotated[tuple[Acceleration, Acceleration, Acceleration], BeforeValidator(_gravity)] = (
        0.0,
        0.0,
        -9.80665,
    )
    floor: Floor | None = None
    walls: tuple[AnyWall, ...] = ()
    balls: Annotated[tuple[SceneBall, ...], Field(validate_default=True)] = ()
    ball_contact: BallContact = BallContact()
    run: Run = Run()

    @field_validator("balls")
    @classmethod
    def _placed(cls, balls: tuple[SceneBall, ...], info: ValidationInfo) -> tuple[SceneBall, ...]:
        """Balls with three numbers for a position: on the floor, or in the plane z = 0."""
        if not balls:
            raise Fault("at least one ball", Words("none"), "a file has a table [[balls]] for each").error()
        floor = info.data.get("floor")
        return tuple(
            ball
            if len(ball.position) == 3
            else ball.model_copy(update={"position": (*ball.position, ball.radius if floor else 0.0)})
            for ball in balls
        )

    @model_validator(mode="after")
    def _sound(self) -> Scene:
        refuse(scene_faults(self))
        return self

    @functools.cached_property
    def own_laws(self) -> tuple[Law, ...]:
        """The laws that the event loop calls by their address, the user's own too: each once, in the order of the walls."""
        own = dict.fromkeys(law for law in self.wall_laws if law not in BUILT_IN)
        return tuple(law if isinstance(law, Law) else find_law(law) for law in own)

    @property
    def wall_laws(self) -> tuple[str | Law, ...]:
        """What each wall does: its own law, or the run's."""
        return tuple(wall.law or self.run.law for wall in self.walls)

    def features(self) -> NDArray[np.void]:
        """All that a ball can touch, (F,) of :data:`carom.scene.features.FEATURES`: the walls' features in their order.

        ``law`` is the number of a built-in law, in the order of BUILT_IN; from there on, of ``own_laws``. A law with springs in
        the place of the tangential restitution has their stiffness ratio there.
        """
        laws = [*BUILT_IN, *dict.fromkeys(law for law in self.wall_laws if law not in BUILT_IN)]
        rows = []
        for i, (wall, law) in enumerate(zip(self.walls, self.wall_laws, strict=True)):
            number, contact = laws.index(law), wall.contact
            if number >= len(BUILT_IN) and self.own_laws[number - len(BUILT_IN)].compliant:
                contact = contact._replace(beta=wall.stiffness_ratio)
            surface = (*contact, number, wall.encloses, 0)
            rows += [(*feature, i, *surface) for feature in wall.features()]
        return np.array(rows, dtype=FEATURES)

    @property
    def wall_names(self) -> tuple[str, ...]:
        """The walls' names; where one has none, its shape and its number."""
        return tuple(wall.name or f"{wall.kind} {i}" for i, wall in enumerate(self.walls))

    @property
    def ball_names(self) -> tuple[str, ...]:
        """The balls' names; where one has none, its number."""
        return tuple(ball.name or f"ball {i}" for i, ball in enumerate(self.balls))

    def describe(self) -> str:
        """One line: floor, walls, balls, law, how long."""
        words = [wall.describe() for wall in self.walls]
        shown = words if len(words) <= 3 else [*words[:2], f"{len(words) - 2} more walls"]
        floor = [] if self.floor is None else ["a floor"]
        balls = f"{len(self.balls)} ball{'s' if len(self.balls) > 1 else ''}"
        laws = dict.fromkeys(map(law_name, self.wall_laws)) or {law_name(self.run.law): None}
        law = f"law{'s' if len(laws) > 1 else ''} {' and '.join(laws)}"
        run = [] if self.run.duration is None else [of_time(self.run.duration)]
        run += [] if self.run.max_events is None else [f"at most {self.run.max_events:,} events"]
        return ", ".join([*floor, *shown, balls, law, *run])
