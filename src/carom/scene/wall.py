"""What every wall has: a surface, a law, a name; and what every shape tells of itself."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainSerializer

from carom.checks import nearest
from carom.errors import CaromError
from carom.law import LAWS, Law
from carom.laws.maw import LIKE_SOLIDS
from carom.motion.restitution import CONSTANT
from carom.own_law import find_law
from carom.scene.faults import Fault, Model, Words
from carom.scene.parts import Feature
from carom.scene.quantities import Friction, PositiveNumber, Spring, Vector
from carom.scene.restitution import Bounce, Restitution

__all__ = ["BUILT_IN", "LAW_NAMES", "Contact", "LawChoice", "Wall", "contact", "law_name", "spelled"]

Outline = list[NDArray[np.float64]]
# What the event loop has compiled in, in its order; and those besides that walls know by name, which it calls by their address.
BUILT_IN = ("two-step", "conventional", "no-slip", "mirror")
LAW_NAMES = (*BUILT_IN, *(name for name, law in LAWS.items() if law.compliant))


class Contact(NamedTuple):
    """A surface as numbers: a form of restitution and its three numbers, friction, tangential restitution."""

    form: int
    p: Vector
    mu: float
    beta: float


def contact(restitution: Restitution | None, friction: float | None, tangential_restitution: float) -> Contact:
    """A surface as numbers. What is left out is carom.Surface's: restitution 1, infinite friction."""
    form, p = (CONSTANT, (1.0, 0.0, 0.0)) if restitution is None else (restitution.code, restitution.p)
    return Contact(form, p, math.inf if friction is None else friction, tangential_restitution)


def _known_law(value: Any) -> str | Law:
    """A law that a wall can have; its fault where there is none."""
    expected = f"one of {', '.join(LAW_NAMES)}, or file.py:name"
    if isinstance(value, Law):
        if value.kernel is None:
            raise Fault("a law with a kernel", Words(f"{value.name!r} without one")).error()
        return value
    if not isinstance(value, str):
        raise Fault(expected, value, "carom.wall_law(card, function) makes a law of a function").error()
    if value not in LAW_NAMES:
        if ".py" not in value:
            raise Fault(expected, value, nearest(value, list(LAW_NAMES))).error()
        try:
            find_law(value)
        except CaromError as error:
            said = error.faults[0].removeprefix("--law ")
            raise Fault(expected, Words(f"{value!r}, and {said}")).error() from None
    return value


def law_name(law: str | Law) -> str:
    """The name of a law."""
    return law.name if isinstance(law, Law) else law


LawChoice = Annotated[str | Law, BeforeValidator(_known_law), PlainSerializer(law_name)]


def spelled(v: tuple[float, ...]) -> str:
    """A point or a direction in words; rounding's leftovers are zero."""
    return f"({', '.join(f'{x if abs(x) > 1e-12 else 0:.6g}' for x in v)})"


class Wall(Model):
    """A wall. Which of the surface's numbers it needs is its law's affair: two-step reads restitution and friction, maw and
    stronge the stiffness ratio as well.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed
    friction : number >= 0, or inf
    tangential_restitution : number from -1 to 1
    stiffness_ratio : number > 0: how stiff the contact is along the surface, over normally; left out: of like solids, 14/17
    law : str or carom.Law, optional
        What this wall does; left out: the run's law.
    name : str, optional
        What tables call it; left out: its shape and its number.
    """

    tag: ClassVar[str] = "shape"
    restitution: Bounce | None = None
    friction: Friction | None = None
    tangential_restitution: Spring = 0.0
    stiffness_ratio: PositiveNumber = LIKE_SOLIDS
    law: LawChoice | None = None
    name: str | None = None

    @property
    def kind(self) -> str:
        """The name of its shape."""
        return str(getattr(self, self.tag))

    @property
    def contact(self) -> Contact:
        """Its surface as numbers."""
        return contact(self.restitution, self.friction, self.tangential_restitution)

    @property
    def encloses(self) -> bool:
        """Whether a ball that clears it is gone for good: it stands all around."""
        return False

    @property
    def bounded(self) -> bool:
        """Whether it ends somewhere, as seen from above; if not, its outline says nothing of how large a picture is."""
        return True

    @property
    def room(self) -> float:
        """Radius that a ball inside must be smaller than, m."""
        return math.inf

    @abstractmethod
    def features(self) -> list[Feature]:
        """What a ball can touch, and the gates above."""

    @abstractmethod
    def outline(self) -> Outline:
        """Polylines (n, 2), m, as seen from above; a line without end is 2 km long."""

    @abstractmethod
    def describe(self) -> str:
        """One phrase."""

    def blocked(self, x: Vector) -> bool:
        """Whether a point is where no ball's centre can be: behind a plane, in a block, out of a container."""
        return False

    def vertical(self, z: float) -> bool:
        """Whether it is vertical wherever it is met by a ball whose centre is at height z."""
        return True
