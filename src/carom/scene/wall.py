"""Fields of every wall (surface, law, name), and methods of every shape."""

from __future__ import annotations

import functools
import math
from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, ClassVar, NamedTuple, Union, get_args, get_origin

import numpy as np
from numpy.typing import NDArray
from pydantic import PlainSerializer, PlainValidator, model_validator
from pydantic_core.core_schema import ValidationInfo

from carom.core.jit.kernel import kernel
from carom.core.motion.restitution import CONSTANT
from carom.errors import CaromError, Fault, shown, suggestion
from carom.formatting import format_length
from carom.laws.law import CONTACT_WALL, LIKE_SOLIDS, Law
from carom.laws.registry import law_for_pairs, laws, laws_of_pairs
from carom.laws.user import FORBIDDEN, find_law
from carom.public.own_laws import OwnLaw
from carom.scene.feature_builders import Feature, Flat, built
from carom.scene.restitution import Bounce, Constant, Restitution
from carom.scene.schema import (
    Components,
    ContactTime,
    Friction,
    Model,
    PositiveNumber,
    Spring,
    Vector,
    YieldTime,
    raise_faults,
    refused,
    runs_own_laws,
)

__all__ = [
    "CUSHION",
    "ContactParameters",
    "LawChoice",
    "PairLawChoice",
    "Pocket",
    "ShapeFault",
    "ShapeKernels",
    "WallShape",
    "always",
    "contact",
    "format_vector",
    "law_name",
    "number_fields",
    "permitted_law",
    "put_fault",
]

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


# --- shapes -------------------------------------------------------------------------------------------------------


@kernel
def no_faults(p: Sequence[float], out: Any) -> int:
    """Report no fault."""
    return 0


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


@kernel
def put_fault(code: int, a: float, b: float, c: float, i: int, out: Any) -> int:
    """Write fault number i, its code and three numbers that its text may show; return the number of the next one."""
    if i < out.shape[0]:
        out[i, 0], out[i, 1], out[i, 2], out[i, 3] = code, a, b, c
    return i + 1


MOST_FAULTS, FAULT_COLUMNS = 64, 4


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


class ShapeFault(NamedTuple):
    """The text of a fault that a shape's kernel reports.

    Names in braces are fields of the wall, and a, b, c the fault's numbers: ``{low}`` as in files, ``{low:g}`` as a number,
    ``{low:m}`` as a length, ``{a:pocket}`` as the name of the pocket at a place.
    """

    field: str
    expected: str
    got: str
    advice: str = ""


class _Shown:
    """A value of a fault's text, by the specifications of :class:`ShapeFault`."""

    def __init__(self, value: Any, places: tuple[str, ...]) -> None:
        self._value, self._places = value, places

    def __getattr__(self, name: str) -> _Shown:
        return _Shown(getattr(self._value, name), self._places)

    def __format__(self, how: str) -> str:
        value: Any = list(self._value) if isinstance(self._value, tuple) else self._value
        if how == "pocket":
            return self._places[int(value)]
        return shown(value) if how == "" else format_length(value) if how == "m" else format(value, how)


@functools.cache
def number_fields(model: type[Model]) -> dict[str, int | tuple[str, ...]]:
    """Return how many numbers each field of a shape takes in its ``numbers``; 0: a list, which its length precedes.

    Of a part, such as the pockets of a table, the names of its fields, a number each. Texts and choices are no numbers.
    """
    own = {name: info for name, info in model.model_fields.items() if name not in WallShape.model_fields}
    counts = {name: _count(info.annotation, list(info.metadata)) for name, info in own.items()}
    return {name: count for name, count in counts.items() if count is not None}


def _count(annotation: Any, metadata: list[Any]) -> int | tuple[str, ...] | None:
    """Return how many numbers a field takes, by its type, or their names; None for a text."""
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    if get_origin(annotation) in (Union, UnionType):
        return _count(next(one for one in get_args(annotation) if one is not type(None)), metadata)
    for one in metadata:
        if isinstance(one := getattr(one, "func", None), Components):
            return one.counts[0] if len(one.counts) == 1 else 0
    if isinstance(annotation, type) and issubclass(annotation, Model):
        return tuple(annotation.model_fields)
    return 1 if annotation in (float, int, bool) else None


def _flattened(value: Any, count: int | tuple[str, ...]) -> list[float]:
    if value is None:
        return [math.nan] * (len(count) if isinstance(count, tuple) else count)
    if isinstance(value, Model):
        return [x for _name, x in value]
    if not isinstance(value, tuple):
        return [float(value)]
    items = [x for one in value for x in (one if isinstance(one, tuple) else (one,))]
    return items if count else [float(len(value)), *items]


# A scene is made again with another friction or ball, and its walls stay as they are: answers about some walls are kept, unless
# their outlines are long.
KEPT, LONG = 1024, 200


@functools.lru_cache(KEPT)
def _features(build: Callable[[Any, Any], int], numbers: tuple[float, ...]) -> tuple[Feature, ...]:
    return tuple(built(build, numbers))


@functools.lru_cache(KEPT)
def _faults(report: Callable[[Any, Any], int], numbers: tuple[float, ...]) -> list[list[float]]:
    rows = np.empty((MOST_FAULTS, FAULT_COLUMNS))
    found: list[list[float]] = rows[: report(numbers, rows)].tolist()
    return found


def _about(asked: Any, function: Any, numbers: tuple[float, ...]) -> Any:
    return asked(function, numbers) if len(numbers) < LONG else asked.__wrapped__(function, numbers)


class WallShape(Model):
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

    tag: ClassVar[str] = "shape"
    in_page: ClassVar[bool] = True
    """Whether the explorer's page knows its fields; other walls are outlines there."""
    kernels: ClassVar[ShapeKernels]
    shape_faults: ClassVar[tuple[ShapeFault, ...]] = ()
    """Texts of the faults that ``kernels.faults`` reports, by their codes."""
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

    @model_validator(mode="after")
    def _sound(self) -> WallShape:
        found = []
        for code, *numbers in _about(_faults, self.kernels.faults, self.numbers):
            given = {
                **{name: getattr(self, name) for name in type(self).model_fields},
                **dict(zip("abc", numbers, strict=True)),
            }
            values = {name: _Shown(value, self.pocket_places) for name, value in given.items()}
            found.append(Fault("", *(text.format_map(values) for text in self.shape_faults[int(code)])))
        if not found:
            try:
                _about(_features, self.kernels.features, self.numbers)
            except ZeroDivisionError:
                got = "sides that vanish in the rounding of their places"
                found.append(Fault("", "", "a wall near the origin, compared with its size", got, "move it nearer"))
        raise_faults(found)
        return self

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return the fields of its shape as numbers, in their order: what the shape's kernels take.

        A flag is 0 or 1; of what is not given, NaN; a list of any length is preceded by its length.
        """
        fields = number_fields(type(self)).items()
        return tuple(x for name, count in fields for x in _flattened(getattr(self, name), count))

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
        found: tuple[Feature, ...] = _about(_features, self.kernels.features, self.numbers)
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
