"""Fields of every wall (surface, law, name), and methods of every shape."""

from __future__ import annotations

import functools
import math
from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, PlainSerializer, PlainValidator, model_validator
from pydantic_core.core_schema import ValidationInfo

from carom.core.jit.kernel import kernel
from carom.core.motion.phases import CONSTANT
from carom.errors import CaromError, did_you_mean, shown
from carom.laws.law import CONTACT_WALL, Law
from carom.laws.registry import FORBIDDEN, find_law, law_for_pairs, laws, laws_of_pairs
from carom.public.defaults import LIKE_SOLIDS
from carom.public.own_laws import OwnLaw
from carom.scene.feature_builders import Feature, Flat, built
from carom.scene.restitution import Bounce, Constant, Restitution
from carom.scene.ruled import KEPT, FaultText, Ruled, about, filled, no_faults
from carom.scene.schema import (
    ContactTime,
    Friction,
    PositiveNumber,
    Spring,
    Vector,
    YieldTime,
    raise_faults,
    refused,
    runs_own_laws,
)

# Contact times, s: estimates. No measurement of a cushion's was found.
HARD, CUSHION = 3e-4, 3e-3

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
    """Validate a known law, or a custom one."""
    expected = f"one of {', '.join(known)}, or file.py:name"
    if isinstance(value, Law):
        if value.kernel is None:
            raise refused("a law with a kernel", f"{value.name!r} without one")
        return value
    if not isinstance(value, str):
        raise refused(expected, shown(value), "carom.wall_law(card, function) makes a law of a function")
    if value not in known:
        if ".py" not in value:
            raise refused(expected, shown(value), did_you_mean(value, known))
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


# --- shapes -------------------------------------------------------------------------------------------------------


@kernel
def nowhere(p: Sequence[float], x: Vector) -> bool:
    """Return False at any place."""
    return False


@kernel
def always(p: Sequence[float], z: float) -> bool:
    """Return True at any height."""
    return True


@kernel
def never(p: Sequence[float]) -> bool:
    """Return False."""
    return False


@kernel
def unbounded(p: Sequence[float]) -> float:
    """Return infinity."""
    return math.inf


class ShapeKernels(NamedTuple):
    """The kernels of a shape: what a scene and the explorer's module know of it. p are the wall's ``numbers``."""

    features: Callable[[Any, Any], int]
    """(p, rows): write the features that a ball can touch, and the gates above; return their number."""
    blocked: Callable[[Any, Vector], bool] = nowhere
    """(p, x): whether no ball's centre can be at a point."""
    vertical: Callable[[Any, float], bool] = always
    """(p, z): whether it is vertical where a ball with its centre at height z meets it."""
    encloses: Callable[[Any], bool] = never
    """(p): whether it surrounds the balls."""
    room: Callable[[Any], float] = unbounded
    """(p): upper bound of the radius of a ball inside, m."""
    faults: Callable[[Any, Any], int] = no_faults
    """(p, rows): write codes of faults with three numbers each; return their number."""


@functools.lru_cache(KEPT)
def _features(build: Callable[[Any, Any], int], numbers: tuple[float, ...]) -> tuple[Feature, ...]:
    return tuple(built(build, numbers))


VANISHES = FaultText(
    "",
    "a wall near the origin, compared with its size",
    "sides that vanish in the rounding of their places",
    "move it nearer",
)
"""The fault of a wall whose features cannot be computed."""


class WallShape(Ruled):
    """A wall: its surface, law and name. Which parameters of the surface are needed depends on the law.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed
    friction : number >= 0, or inf
    tangential_restitution : number from -1 to 1
    stiffness_ratio : number > 0: tangential over normal stiffness of the contact; default: 14/17 (same material)
    contact_time : s, from 0 to 1: how long a ball alone touches the wall; default: 0.3 ms, of a hard wall, and of a table 3 ms, of
        rubber (estimates). It matters only where the ball touches something else meanwhile, another ball or another wall
    yield_time : s, from 0 to 0.1: the wall yields, and a ball turns deeper by ``yield_time`` times its speed along the normal;
        default: 0. Of a spring that a ball touches for the time T it is e T / (1 + e). No ball turns deeper than half its radius
    law : str or carom.Law, optional
        Law of this wall; default: the run's.
    name : str, optional
        Its name in tables; default: its shape and its number.
    """

    model_config = ConfigDict(defer_build=True)  # (:class:`carom.scene.schema.OneOf`)
    tag: ClassVar[str] = "shape"
    in_page: ClassVar[bool] = True
    """Whether the explorer's page knows its fields; other walls are outlines there."""
    kernels: ClassVar[ShapeKernels]
    pocket_places: ClassVar[tuple[str, ...]] = ()
    """Names of the places at which it may have a pocket, by the numbers that ``kernels.features`` gives them."""

    restitution: Bounce | None = None
    friction: Friction | None = None
    tangential_restitution: Spring = 0.0
    stiffness_ratio: PositiveNumber = LIKE_SOLIDS
    contact_time: ContactTime = HARD
    yield_time: YieldTime = 0.0
    law: LawChoice | None = None
    name: str | None = None

    @classmethod
    def ruled_fields(cls) -> tuple[str, ...]:
        """Return the names of the fields of its shape."""
        return tuple(name for name in cls.model_fields if name not in WallShape.model_fields)

    @classmethod
    def fault_rules(cls) -> Callable[[Any, Any], int]:
        """Return the kernel of its faults."""
        return cls.kernels.faults

    @model_validator(mode="after")
    def _is_built(self) -> WallShape:
        try:
            about(_features, self.kernels.features, self.numbers)
        except ZeroDivisionError:
            raise_faults([filled(VANISHES, {})])
        return self

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
    def own_surfaces(self) -> dict[str, WallShape]:
        """Return walls with the surfaces of the parts that differ from it, by their paths in it."""
        return {}

    def contacts_of(self, law: Law) -> tuple[ContactParameters, ...]:
        """Return the surfaces of its cushions as numbers under a law, by their numbers, and last that of all else."""
        return (self.contact_of(law),)

    @property
    def encloses(self) -> bool:
        """Return whether it surrounds the balls, so that the run of a ball that clears it ends."""
        return bool(self.kernels.encloses(self.numbers))

    @property
    def bounded(self) -> bool:
        """Return whether it is finite as seen from above, so that its outline counts for the extent of a figure."""
        return True

    @property
    def room(self) -> float:
        """Return the upper bound of the radius of a ball inside, m."""
        return self.kernels.room(self.numbers)

    @property
    def pockets(self) -> tuple[Pocket, ...]:
        """Return its pockets, in the order of their numbers."""
        edges = [f for f in self.features() if f.pocket >= 0] if self.pocket_places else []
        return tuple(Pocket(self.pocket_places[f.pocket], (f.p[0], f.p[1]), f.R) for f in edges)

    @property
    def bed(self) -> NDArray[np.float64] | None:
        """Return the outline (n, 2) of what balls lie on, where :meth:`outline` is not closed around it."""
        return None

    def features(self) -> tuple[Feature, ...]:
        """Return the features that a ball can touch, and the gates above."""
        found: tuple[Feature, ...] = about(_features, self.kernels.features, self.numbers)
        return found

    @abstractmethod
    def outline(self) -> Outline:
        """Return polylines (n, 2), m, as seen from above; an infinite line is 2 km long."""

    @abstractmethod
    def describe(self) -> str:
        """Return a description of a few words."""

    def blocked(self, x: Vector) -> bool:
        """Return whether no ball's centre can be at a point: behind a plane, in a block, outside a container."""
        return bool(self.kernels.blocked(self.numbers, x))

    def vertical(self, z: float) -> bool:
        """Return whether it is vertical where a ball with its centre at height z meets it."""
        return bool(self.kernels.vertical(self.numbers, z))
