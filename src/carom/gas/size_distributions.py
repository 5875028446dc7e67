"""Radii by distribution: lognormal, normal, uniform, or given values with shares; and the classes in which the engine has them.

A gas of N balls has N radii, drawn with a seed. The engine knows species, not radii of single balls: a species whose radii differ
is divided into classes, each with the mean of its radii. Up to :data:`CLASSES` different radii are exact.
"""

from __future__ import annotations

import functools
import math
from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, model_validator

from carom.bodies import Ball
from carom.errors import CaromError, Fault, shown
from carom.gas.species import Species
from carom.scene.schema import Components, CountOrZero, Model, Number, Size, refused

__all__ = [
    "CLASSES", "LognormalRadii", "NormalRadii", "RadiiDistribution", "SizeClasses", "SpeciesRadius", "UniformRadii", "ValueRadii",
    "in_classes", "size_classes", "size_moments",
]  # fmt: skip

Array = NDArray[np.float64]
CLASSES = 48  # of the radii of a species, at most
_SIGMA = Number("a standard deviation of ln r, > 0 and at most 1", least=0, most=1, above=True)
_RADIUS = Number(
    "a length in m, > 0, or a table { distribution = 'lognormal', 'normal', 'uniform' or 'values', ... }", "m", least=0, above=True
)  # fmt: skip
_SHARE = Number("a share > 0", least=0, above=True)
_VALUES = Components("one or more radii", tuple(range(1, CLASSES + 1)))


class RadiiDistribution(Model):
    """A distribution of radii; ``seed`` is that of the drawn radii, the same for all gases of an ensemble."""

    tag: ClassVar[str] = "distribution"
    seed: CountOrZero = 0

    @property
    @abstractmethod
    def nominal(self) -> float:
        """The radius of a ball with the species' ``mass``."""

    @abstractmethod
    def _draw(self, rng: np.random.Generator, count: int) -> Array:
        """Draw radii (count,), m."""

    def radii(self, count: int) -> Array:
        """Draw radii (count,), m: the same for the same seed."""
        return self._draw(np.random.default_rng([self.seed, 0x5175]), count)


class LognormalRadii(RadiiDistribution):
    """ln r is normally distributed about ln ``median``, with the standard deviation ``sigma``."""

    distribution: Literal["lognormal"] = "lognormal"
    median: Size
    sigma: Annotated[float, BeforeValidator(_SIGMA)]

    @property
    def nominal(self) -> float:
        """The median."""
        return self.median

    def _draw(self, rng: np.random.Generator, count: int) -> Array:
        return rng.lognormal(math.log(self.median), self.sigma, count)


class NormalRadii(RadiiDistribution):
    """Normally distributed, cut off at ``low`` and ``high``; default: three standard deviations from the mean, and above 0."""

    distribution: Literal["normal"] = "normal"
    mean: Size
    deviation: Size
    low: Size | None = None
    high: Size | None = None

    @model_validator(mode="after")
    def _ordered(self) -> NormalRadii:
        if self.low is None and self.mean <= 3 * self.deviation:
            advice = "give low, the smallest radius"
            raise refused(
                f"less than a third of mean = {self.mean:g}", f"{self.deviation:g}", advice, field="deviation"
            )
        low, high = self.bounds
        if not low < self.mean < high:
            name, side = ("low", "below") if low >= self.mean else ("high", "above")
            raise refused(f"a radius {side} mean = {self.mean:g}", f"{low if name == 'low' else high:g}", field=name)
        return self

    @property
    def bounds(self) -> tuple[float, float]:
        """The smallest and the largest radius."""
        low = self.mean - 3 * self.deviation if self.low is None else self.low
        return low, self.mean + 3 * self.deviation if self.high is None else self.high

    @property
    def nominal(self) -> float:
        """The mean of the distribution before it is cut off."""
        return self.mean

    def _draw(self, rng: np.random.Generator, count: int) -> Array:
        low, high = self.bounds
        found = rng.normal(self.mean, self.deviation, count)
        while (outside := (found < low) | (found > high)).any():
            found[outside] = rng.normal(self.mean, self.deviation, int(outside.sum()))
        return found


class UniformRadii(RadiiDistribution):
    """Uniformly distributed from ``low`` to ``high``."""

    distribution: Literal["uniform"] = "uniform"
    low: Size
    high: Size

    @model_validator(mode="after")
    def _ordered(self) -> UniformRadii:
        if not self.high > self.low:
            raise refused(f"a radius above low = {self.low:g}", f"{self.high:g}", field="high")
        return self

    @property
    def nominal(self) -> float:
        """The middle."""
        return (self.low + self.high) / 2

    def _draw(self, rng: np.random.Generator, count: int) -> Array:
        return rng.uniform(self.low, self.high, count)


class ValueRadii(RadiiDistribution):
    """The given ``values``, with ``shares`` of the number of balls (default: equal ones), to the nearest whole numbers."""

    distribution: Literal["values"] = "values"
    values: Annotated[tuple[Size, ...], BeforeValidator(_VALUES)]
    shares: Annotated[tuple[Annotated[float, BeforeValidator(_SHARE)], ...], BeforeValidator(_VALUES)] | None = None

    @model_validator(mode="after")
    def _matched(self) -> ValueRadii:
        if self.shares is not None and len(self.shares) != len(self.values):
            raise refused(f"{len(self.values)} numbers, one for each value", f"{len(self.shares)}", field="shares")
        return self

    @property
    def nominal(self) -> float:
        """The first value."""
        return self.values[0]

    def _draw(self, rng: np.random.Generator, count: int) -> Array:
        shares = np.array(self.shares or [1.0] * len(self.values))
        ends = np.rint(np.cumsum(shares) / shares.sum() * count).astype(int)
        return rng.permutation(np.repeat(self.values, np.diff(ends, prepend=0)))


_KINDS = ("lognormal", "normal", "uniform", "values")


def _radius(value: Any) -> Any:
    if isinstance(value, RadiiDistribution):
        return value
    if isinstance(value, dict):
        if (kind := value.get("distribution")) not in _KINDS:
            raise refused(
                f"one of {', '.join(_KINDS)}", "nothing" if kind is None else shown(kind), field="distribution"
            )
        return value
    return ValueRadii(values=(_RADIUS(value),))


def _one_radius(value: RadiiDistribution) -> float | RadiiDistribution:
    return value.values[0] if isinstance(value, ValueRadii) and len(value.values) == 1 else value


if TYPE_CHECKING:
    SpeciesRadius = float | RadiiDistribution
else:
    from pydantic import AfterValidator, PlainSerializer

    SpeciesRadius = Annotated[
        Annotated[LognormalRadii | NormalRadii | UniformRadii | ValueRadii, Field(discriminator="distribution")],
        BeforeValidator(_radius), AfterValidator(_one_radius),
        PlainSerializer(lambda one: one.model_dump(exclude_none=True) if isinstance(one, RadiiDistribution) else one),
    ]  # fmt: skip


def size_moments(radii: Array) -> tuple[float, float, float]:
    """Return mean (m), standard deviation (m) and skewness of radii (N,).

    >>> size_moments(np.array([1.0, 2.0, 3.0]))
    (2.0, 0.816496580927726, 0.0)
    """
    mean, deviation = float(radii.mean()), float(radii.std())
    return mean, deviation, float(((radii - mean) ** 3).mean() / deviation**3) if deviation > 0 else 0.0


class SizeClasses:
    """The species that the engine simulates: one for each class of radii of each species.

    Parameters
    ----------
    species : sequence of Species

    Attributes
    ----------
    kinds : list of Species
        One for each class, with the name of its species.
    groups : (kinds,) integers
        The species of each class.
    which : (N,) integers
        The class of each ball, in the order of the species and of their radii.
    """

    def __init__(self, species: Sequence[Species]) -> None:
        self.kinds: list[Species] = []
        groups: list[int] = []
        parts = []
        for number, one in enumerate(species):
            radii, place = size_classes(one)
            parts.append(place + len(self.kinds))
            counts = np.bincount(place, minlength=len(radii)).tolist()
            self.kinds += [
                one if one.radii is None else _of_class(one, radius, count)
                for radius, count in zip(radii, counts, strict=True)
            ]
            groups += [number] * len(radii)
        self.groups = np.array(groups, np.int64)
        self.which = np.concatenate(parts).astype(np.uint32) if parts else np.empty(0, np.uint32)


def _of_class(one: Species, radius: float, count: int) -> Species:
    """Return the balls of one class of a species: of the same material, so that mass grows with area or volume."""
    ball = one.ball
    mass = float(ball.mass) * (radius / float(ball.radius)) ** (2 if ball.planar else 3)
    return replace(one, ball=type(ball)(radius, mass, ball.kappa), count=count, radii=None)


@functools.lru_cache(maxsize=8)
def in_classes(distribution: RadiiDistribution, count: int) -> Array:
    """Return drawn radii (count,), each the mean of its class, m."""
    classes, which = size_classes(Species(Ball(1.0), count, radii=distribution.radii(count)))
    found = np.array(classes)[which]
    found.setflags(write=False)
    return found


def size_classes(one: Species) -> tuple[list[float], NDArray[np.int64]]:
    """Return the radii of a species' classes, and the class of each of its balls (count,).

    Classes have equal numbers of balls, and the mean of their radii.

    >>> from carom import Ball
    >>> size_classes(Species(Ball(1.0, 1.0), 4, radii=[2.0, 1.0, 1.0, 3.0]))
    ([1.0, 2.0, 3.0], array([1, 0, 0, 2]))
    """
    if one.radii is None:
        return [float(one.ball.radius)], np.zeros(max(one.count, 0), np.int64)
    radii = np.array(one.radii, dtype=float)
    if radii.shape != (one.count,) or not ((radii > 0) & (radii < math.inf)).all():
        raise CaromError(Fault("Gas", "species", f"{one.count} radii > 0 of {one.name!r}", f"shape {radii.shape}"))
    values, place = np.unique(radii, return_inverse=True)
    if len(values) > CLASSES:
        order = np.argsort(radii, kind="stable")
        place = np.empty(one.count, np.int64)
        place[order] = np.arange(one.count) * CLASSES // one.count
        values = np.bincount(place, radii) / np.bincount(place)
    return values.tolist(), place
