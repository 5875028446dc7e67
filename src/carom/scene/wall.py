"""Fields of every wall (surface, law, name), and methods of every shape."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import PlainSerializer, PlainValidator
from pydantic_core.core_schema import ValidationInfo

from carom.core.motion.restitution import CONSTANT
from carom.errors import CaromError, shown, suggestion
from carom.laws.law import CONTACT_WALL, LIKE_SOLIDS, Law
from carom.laws.registry import law_for_pairs, laws, laws_of_pairs
from carom.laws.user import FORBIDDEN, find_law
from carom.public.own_laws import OwnLaw
from carom.scene.feature_builders import Feature, Flat
from carom.scene.restitution import Bounce, Constant, Restitution
from carom.scene.schema import Friction, Model, PositiveNumber, Spring, Vector, refused, runs_own_laws

__all__ = [
    "ContactParameters",
    "LawChoice",
    "PairLawChoice",
    "Pocket",
    "WallShape",
    "contact",
    "format_vector",
    "law_name",
    "permitted_law",
]

Outline = list[NDArray[np.float64]]


class Pocket(NamedTuple):
    """A pocket of a table: its name, and its edge, a circle as seen from above (m)."""

    name: str
    center: Flat
    radius: float


class ContactParameters(NamedTuple):
    """A surface as numbers: form of the restitution and its three numbers, friction, tangential restitution."""

    form: int
    p: Vector
    mu: float
    beta: float

    def under(self, law: Law, stiffness_ratio: float) -> ContactParameters:
        """Return the numbers that a law's kernel takes: with those that it holds fixed, and its last one in the place of beta."""
        p = law.pinned if law.response == CONTACT_WALL else {}
        form, e = (CONSTANT, (p["restitution"], 0.0, 0.0)) if "restitution" in p else (self.form, self.p)
        beta = stiffness_ratio if law.last == "stiffness_ratio" else p.get("tangential_restitution", self.beta)
        return ContactParameters(form, e, p.get("friction", self.mu), beta)


def contact(
    restitution: Restitution | None, friction: float | None, tangential_restitution: float
) -> ContactParameters:
    """Return a surface as numbers. Defaults as in carom.Surface: restitution 1, infinite friction."""
    form, p = (CONSTANT, (1.0, 0.0, 0.0)) if restitution is None else (restitution.code, restitution.p)
    return ContactParameters(form, p, math.inf if friction is None else friction, tangential_restitution)


def _known_law(value: Any, info: ValidationInfo) -> str | Law:
    """Validate the law of a wall."""
    return _one_of([law.name for law in laws().values() if law.kernel is not None], value, info)


def _law_of_pairs(value: Any, info: ValidationInfo) -> str | Law:
    """Validate the law by which two balls meet."""
    found = _one_of(laws_of_pairs(), value, info)
    if isinstance(found, Law):
        try:
            law_for_pairs(found)
        except CaromError as error:
            raise refused(error.records[0].expected, error.records[0].got) from None
    return found


def _one_of(known: list[str], value: Any, info: ValidationInfo) -> str | Law:
    """Validate a law that is one of those known, or a custom one."""
    expected = f"one of {', '.join(known)}, or file.py:name"
    if isinstance(value, Law):
        if value.kernel is None:
            raise refused("a law with a kernel", f"{value.name!r} without one")
        return value
    if not isinstance(value, str):
        raise refused(expected, shown(value), "carom.wall_law(card, function) makes a law of a function")
    if value not in known:
        if ".py" not in value:
            raise refused(expected, shown(value), suggestion(value, known))
        return permitted_law(value, info)
    return value


def permitted_law(name: str, info: ValidationInfo) -> OwnLaw:
    """Return the name of a custom law that may be run; a fault where nobody has typed or allowed it, and where it is no law."""
    if runs_own_laws(info):
        name = OwnLaw(name)
    if not isinstance(name, OwnLaw):
        expected, advice = FORBIDDEN
        # (its name alone: a long path would be cut off before it)
        raise refused(expected, shown(Path(name).name), advice)
    try:
        find_law(name)
    except CaromError as error:
        said = replace(error.records[0], where="", field="")  # (after the file's name)
        raise refused("a law in a Python file", f"{name!r}: {said}") from None
    return name


def law_name(law: str | Law) -> str:
    """Return the name of a law."""
    return law.name if isinstance(law, Law) else law


# (no validator of pydantic's after it: one of texts would take an OwnLaw's mark off)
LawChoice = Annotated[str | Law, PlainValidator(_known_law), PlainSerializer(law_name)]
PairLawChoice = Annotated[str | Law, PlainValidator(_law_of_pairs), PlainSerializer(law_name)]


def format_vector(v: tuple[float, ...]) -> str:
    """Format a point or a direction; rounding errors are shown as zero."""
    return f"({', '.join(f'{x if abs(x) > 1e-12 else 0:.6g}' for x in v)})"


class WallShape(Model):
    """A wall: its surface, law and name. Which parameters of the surface are needed depends on the law.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed
    friction : number >= 0, or inf
    tangential_restitution : number from -1 to 1
    stiffness_ratio : number > 0: tangential over normal stiffness of the contact; default: 14/17 (same material)
    law : str or carom.Law, optional
        Law of this wall; default: the run's.
    name : str, optional
        Its name in tables; default: its shape and its number.
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
        """Return the name of its shape."""
        return str(getattr(self, self.tag))

    @property
    def contact(self) -> ContactParameters:
        """Return its surface as numbers."""
        return contact(self.restitution, self.friction, self.tangential_restitution)

    def contact_of(self, law: Law) -> ContactParameters:
        """Return its surface as numbers under a law, with the law's defaults for what it does not give."""
        e = self.restitution
        if e is None and "restitution" in law.defaults:
            e = Constant(value=law.defaults["restitution"])
        mu = law.defaults.get("friction") if self.friction is None else self.friction
        return contact(e, mu, self.tangential_restitution).under(law, self.stiffness_ratio)

    @property
    def encloses(self) -> bool:
        """Return whether it surrounds the balls, so that the run of a ball that clears it ends."""
        return False

    @property
    def bounded(self) -> bool:
        """Return whether it is finite as seen from above, so that its outline counts for the extent of a figure."""
        return True

    @property
    def room(self) -> float:
        """Return the upper bound of the radius of a ball inside, m."""
        return math.inf

    @property
    def pockets(self) -> tuple[Pocket, ...]:
        """Return its pockets, in the order of their numbers."""
        return ()

    @property
    def bed(self) -> NDArray[np.float64] | None:
        """Return the outline (n, 2) of what balls lie on, where :meth:`outline` is not closed around it."""
        return None

    @abstractmethod
    def features(self) -> list[Feature]:
        """Return the features that a ball can touch, and the gates above."""

    @abstractmethod
    def outline(self) -> Outline:
        """Return polylines (n, 2), m, as seen from above; an infinite line is 2 km long."""

    @abstractmethod
    def describe(self) -> str:
        """Return a description of a few words."""

    def blocked(self, x: Vector) -> bool:
        """Return whether no ball's centre can be at a point: behind a plane, in a block, outside a container."""
        return False

    def vertical(self, z: float) -> bool:
        """Return whether it is vertical where a ball with its centre at height z meets it."""
        return True
