"""Radii by a lognormal distribution, or given; and the classes in which the engine has them.

A gas of N balls has N radii, drawn with a seed. The engine knows species, not radii of single balls: a species whose radii differ
is divided into classes, each with the mean of its radii. Up to :data:`CLASSES` different radii are exact.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, PlainSerializer, WrapValidator

from carom.bodies import Ball
from carom.errors import CaromError, Fault
from carom.gas.species import Species
from carom.scene.schema import CountOrZero, Model, Number, Size

Array = NDArray[np.float64]
CLASSES = 48  # of the radii of a species, at most
_SIGMA = Number("a standard deviation of ln r, > 0 and at most 1", least=0, most=1, above=True)
_RADIUS = Number(
    "a length in m, > 0, or a table { distribution = 'lognormal', median = ..., sigma = ... }", "m", least=0, above=True
)


class LognormalRadii(Model):
    """ln r is normally distributed about ln ``median``, with the standard deviation ``sigma``.

    ``seed`` is that of the drawn radii, the same for all gases of an ensemble.
    """

    distribution: Literal["lognormal"] = "lognormal"
    median: Size
    sigma: Annotated[float, BeforeValidator(_SIGMA)]
    seed: CountOrZero = 0

    def radii(self, count: int) -> Array:
        """Draw radii (count,), m: the same for the same seed."""
        return np.random.default_rng([self.seed, 0x5175]).lognormal(math.log(self.median), self.sigma, count)


if TYPE_CHECKING:
    SpeciesRadius = float | LognormalRadii
else:
    SpeciesRadius = Annotated[
        LognormalRadii,
        WrapValidator(lambda one, read: read(one) if isinstance(one, dict | LognormalRadii) else _RADIUS(one)),
        PlainSerializer(lambda one: one.model_dump() if isinstance(one, LognormalRadii) else one),
    ]


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
def in_classes(distribution: LognormalRadii, count: int) -> Array:
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
