"""Species of a gas and contacts, as they are declared, and the records of the event engine that they become."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, BeforeValidator, Field, PlainSerializer, WrapValidator, model_validator

from carom.bodies import DISC_INERTIAS, INERTIAS, Ball, Surface
from carom.errors import Fault, FaultList, require_type, shown, suggestion
from carom.formatting import format_number
from carom.gas.containers import BOXES, WALLS, Container, ContainerFace
from carom.gas.drives import Drive, Thermostat, face_records
from carom.gas.edmd.driver import SystemRecords
from carom.gas.edmd.gas_records import (
    CONTACT_FORM,
    FLOW,
    LAYER,
    PAIR,
    RANDOM_NORMAL,
    RANDOM_UNIFORM,
    SHEAR,
    SPECIES,
    SYSTEM,
    WALL_CONTACT,
    WHOLE,
)
from carom.gas.results import layer_axis
from carom.scene.ball import FallingFriction, Rubbing
from carom.scene.restitution import Constant, Exponential, Han2005, Polynomial, Power, Restitution, Viscoelastic
from carom.scene.schema import (
    Components,
    Count,
    CountOrZero,
    Mass,
    Model,
    Number,
    Share,
    Size,
    Spring,
    Vector,
    refused,
)

LONGEST_SIDE = 1e9  # of the smallest radius: beyond it rounding of a position is no longer small beside a ball
BYTES_PER_BALL = 220.0  # of memory: all arrays of a gas, and those of its start
CELLS_PER_BALL = 8  # at most: empty cells cost memory, and save nothing


def cells_at_most(numbers: Sequence[float], balls: int) -> list[int]:
    """Return numbers of cells along each axis, the largest ones reduced so that there are not many more cells than balls.

    >>> cells_at_most([4.7, 3.2, 3.0], 20), cells_at_most([1e16, 3.0, 3.0], 20)
    ([4, 3, 3], [20, 3, 3])
    """
    left, found = float(27 + CELLS_PER_BALL * balls), [1] * len(numbers)
    order = sorted(range(len(numbers)), key=numbers.__getitem__)
    for rank, axis in enumerate(order):
        share = left ** (1 / (len(numbers) - rank))
        found[axis] = max(int(min(numbers[axis], share * (1 + 1e-12))), 1)
        left /= found[axis]
    return found


def lattice_steps(sides: Sequence[float], count: int, sites: int) -> list[float]:
    """Return numbers of steps, not rounded, that divide a box into nearly cubic cells with so many sites each, ``count`` in all.

    Along a side that is too short for a step it is 1.

    >>> lattice_steps([4.0, 4.0, 2.0], 128, 4), lattice_steps([1e6, 1.0, 1.0], 40, 4)
    ([4.0, 4.0, 2.0], [10.0, 1.0, 1.0])
    """
    found, free = [1.0] * len(sides), list(range(len(sides)))
    while free:
        volume = 1.0
        for axis in free:
            volume *= sides[axis]
        step = (volume * sites / count) ** (1 / len(free))
        short = [axis for axis in free if sides[axis] / step < 0.5]
        if not short:
            for axis in free:
                found[axis] = sides[axis] / step
            break
        free = [axis for axis in free if axis not in short]
    return found


# ----------------------------------------------------------------------------------------------------
# Contacts of a gas: which species has which, as the engine's records; restitution and friction as numbers, or as functions.
#
# Restitution may depend on the speed, as in scenes, or be a random number for each contact.


ANY = "*"  # in contacts: every species and wall
NO_TOTALS = (0, 0.0, 0.0, 0.0)  # of a contact that has not happened yet
UNKNOWN = 0.5  # in the place of a restitution that is no number
NO_FORM = (0, 0.0, 0.0, 0.0)
_DEVIATION = Number("a standard deviation from 0 to 1", least=0, most=1)


class UniformRestitution(Restitution):
    """A random restitution for each contact: uniformly distributed from ``low`` to ``high``."""

    form: Literal["uniform"] = "uniform"
    low: Share
    high: Share
    code: ClassVar[int] = RANDOM_UNIFORM

    @model_validator(mode="after")
    def _ordered(self) -> UniformRestitution:
        if self.high < self.low:
            raise refused(f"at least low = {self.low:g}", f"{self.high:g}", field="high")
        return self

    @property
    def p(self) -> Vector:
        """Return the lowest value and the width."""
        return (self.low, self.high - self.low, 0.0)

    def at(self, speed: float) -> float:
        """Return the mean, at every speed."""
        return (self.low + self.high) / 2 + 0 * speed


class NormalRestitution(Restitution):
    """A random restitution for each contact: normally distributed, held in [0, 1]."""

    form: Literal["normal"] = "normal"
    mean: Share
    deviation: Annotated[float, BeforeValidator(_DEVIATION)]
    code: ClassVar[int] = RANDOM_NORMAL

    @property
    def p(self) -> Vector:
        """Return mean and standard deviation."""
        return (self.mean, self.deviation, 0.0)

    def at(self, speed: float) -> float:
        """Return the mean of the normal distribution, at every speed."""
        return self.mean + 0 * speed


_NUMBER = Number("a number from 0 to 1, or a table { form = ... }", least=0, most=1)


class _NumberOrForm:
    what = _NUMBER.what

    def __call__(self, value: Any) -> Any:
        return value if isinstance(value, (dict, Restitution)) else Constant(value=_NUMBER(value))


def _as_number(value: Restitution) -> float | Restitution:
    return value.value if isinstance(value, Constant) else value


def _as_written(restitution: float | Restitution) -> Any:
    return restitution.model_dump() if isinstance(restitution, Restitution) else restitution


if TYPE_CHECKING:
    GasBounce = float | Restitution
else:
    GasBounce = Annotated[
        Annotated[
            Constant | Polynomial | Han2005 | Power | Viscoelastic | Exponential | UniformRestitution | NormalRestitution,
            Field(discriminator="form"),
        ],
        BeforeValidator(_NumberOrForm()), AfterValidator(_as_number), PlainSerializer(_as_written),
    ]  # fmt: skip


class GasSurface(Model):
    """The contact of two balls of a gas, or of a ball and a wall, with a restitution that may depend on the speed or on chance.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed of approach as in scenes ("viscoelastic" with c, "power",
        "polynomial", "exponential"), or of a random number for each contact: "uniform" with low and high, "normal" with mean and
        deviation
    friction : >= 0, or inf, or a table of at_rest, at_speed, speed: friction that falls with the slip
    tangential_restitution : -1 (smooth) to 1; default: 0

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.gas import GasSurface
    >>> steel = GasSurface(restitution={"form": "viscoelastic", "c": 0.2}, friction=0.1)
    >>> round(steel.restitution.at(1.0), 3)
    0.822
    """

    absent: ClassVar = {"law": "a gas takes no custom law: its contacts have the numbers above"}
    restitution: GasBounce
    friction: Rubbing
    tangential_restitution: Spring = 0.0

    def restitution_at(self, speed: float) -> float:
        """Return the restitution at a normal speed of approach, its mean if it is random."""
        return self.restitution.at(speed) if isinstance(self.restitution, Restitution) else self.restitution

    @property
    def is_smooth(self) -> bool:
        """Whether the contact leaves spins as they are."""
        rubs = self.friction.at_rest if isinstance(self.friction, FallingFriction) else self.friction
        return rubs == 0 or self.tangential_restitution == -1

    @property
    def is_elastic(self) -> bool:
        """Whether the contact conserves energy: restitution 1, smooth or perfectly rough."""
        rough = self.friction == math.inf and self.tangential_restitution == 1
        return self.restitution == 1 and (self.is_smooth or rough)


def contact_numbers(surface: GasSurface) -> tuple[tuple[float, float, float], tuple[float, ...], bool]:
    """Return restitution, friction and tangential restitution; the form of what is no number (code 0: all are); and smoothness."""
    bounce, rub, beta = surface.restitution, surface.friction, surface.tangential_restitution
    form = (bounce.code, *bounce.p) if isinstance(bounce, Restitution) else NO_FORM
    falls = rub.parameters if isinstance(rub, FallingFriction) else (rub, 0.0, 0.0)
    number = UNKNOWN if isinstance(bounce, Restitution) else bounce
    return (number, falls[0], beta), (*form, *falls[1:]), surface.is_smooth


# --- between species ----------------------------------------------------------------------------------------------


class GasContact(GasSurface):
    """The contact of two species, or of a species and a wall.

    Parameters
    ----------
    between : two names: of species; "wall" for all walls, or a wall's own name; "*" for every species and wall that no other
        contact names
    restitution, friction, tangential_restitution : as of :class:`carom.gas.GasSurface`
    """

    between: Annotated[tuple[str, str], BeforeValidator(Components("two names, such as ['a', 'wall']", (2,)))]


Contacts = Surface | GasSurface | Mapping[tuple[str, str], Surface | GasSurface]


def _each(value: Any) -> Any:
    """Return one surface for all pairs, or one for each pair of names, as a list of contacts."""
    if isinstance(value, Surface | GasSurface) and not isinstance(value, GasContact):
        value = {(ANY, ANY): value}
    if isinstance(value, list | tuple) or (isinstance(value, dict) and all(isinstance(name, str) for name in value)):
        return value  # (of a file)
    expected = "a carom.Surface (no custom law), or one for each pair of names, {('a', 'wall'): Surface(...)}"
    if not isinstance(value, Mapping):
        raise refused(expected, shown(value))
    for pair, surface in value.items():
        named = isinstance(pair, tuple) and len(pair) == 2 and all(isinstance(name, str) for name in pair)
        if not named or not isinstance(surface, Surface | GasSurface):
            raise refused(expected, f"{pair!r:.40}: {surface!r:.40}")
    names = ("restitution", "friction", "tangential_restitution")
    return [{"between": pair} | {name: getattr(one, name) for name in names} for pair, one in value.items()]


AnyContacts = Annotated[tuple[GasContact, ...], BeforeValidator(_each)]


def best_contact(keys: Iterable[tuple[str, str]], one: str, others: Sequence[str]) -> tuple[str, str] | None:
    """Return which of some pairs of names says most about a species and the first of others: "*" stands for every name."""
    found: dict[tuple[int, int, int], tuple[str, str]] = {}
    for order, key in enumerate(keys):
        for first, second in (key, key[::-1]):
            if first in {one, ANY} and second in {*others, ANY}:
                rank = len(others) if second == ANY else list(others).index(second)
                found.setdefault(((first, second).count(ANY), rank, order), key)
    return found[min(found)] if found else None


def contact_records(
    species: Sequence[Kind], faces: Sequence[ContainerFace], contacts: Sequence[GasContact]
) -> list[NDArray[np.void]]:
    """Return the records of contacts of pairs and with walls, each with their forms."""
    count, surfaces = len(species), {one.between: contact_numbers(one) for one in contacts}

    def between(one: str, *others: str) -> tuple[tuple[float, float, float], tuple[float, ...], bool]:
        key = best_contact(surfaces, one, others)
        assert key is not None  # (as the scene's check says)
        return surfaces[key]

    sizes = (count**2, count**2, len(faces) * count, len(faces) * count)
    kinds = (PAIR, CONTACT_FORM, WALL_CONTACT, CONTACT_FORM)
    found = [np.zeros(size, kind) for size, kind in zip(sizes, kinds, strict=True)]
    for i, one in enumerate(species):
        for j, other in enumerate(species):
            numbers, form, smooth = between(one.name, other.name)
            distance = one.radius + other.radius
            found[0][i * count + j] = (distance, distance * distance, *numbers, smooth, *NO_TOTALS)
            found[1][i * count + j] = form
        for k, face in enumerate(faces):
            numbers, form, _smooth = between(one.name, face.name, "wall")
            found[2][k * count + i] = (*face.offset(one.radius), *numbers, *NO_TOTALS)
            found[3][k * count + i] = form
    return found


# ----------------------------------------------------------------------------------------------------
# Radii by a lognormal distribution, or given; and the classes in which the engine has them.
#
# A gas of N balls has N radii, drawn with a seed. The engine knows species, not radii of single balls: a species whose radii
# differ
# is divided into classes, each with the mean of its radii. Up to :data:`CLASSES` different radii are exact.


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


def size_classes(radii: Array) -> tuple[Array, NDArray[np.int64]]:
    """Return the radii of classes of balls, and the class of each ball, of radii (count,).

    Classes have equal numbers of balls, and the mean of their radii.

    >>> size_classes(np.array([2.0, 1.0, 1.0, 3.0]))
    (array([1., 2., 3.]), array([1, 0, 0, 2]))
    """
    values, place = np.unique(radii, return_inverse=True)
    if len(values) > CLASSES:
        order = np.argsort(radii, kind="stable")
        place = np.empty(len(radii), np.int64)
        place[order] = np.arange(len(radii)) * CLASSES // len(radii)
        values = np.bincount(place, radii) / np.bincount(place)
    return values, place


# ----------------------------------------------------------------------------------------------------
# Species of a gas, and the records that the event engine has of a gas without its balls.


FASTEST_FLOW = (
    1e6  # thermal speeds, of a shear flow across the box: faster, images go by so fast that hardly a ball meets another
)
MOST_KICKS = 1e6  # of a thermostat, on a ball's way of one radius
BALLS_PER_CELL = 0.5  # where the balls are small compared with their distances
_KAPPA = Number("kappa = I/(m a^2) in (0, 1], or one of 'solid', 'hollow', 'disc', 'ring'", least=0, most=1, above=True)
_TEMPERATURE = Number("a temperature k_B T >= 0", "J", least=0)
DENSITIES = {
    axes: Number("a density > 0 in kg/m^3 (discs: kg/m^2)", unit, least=0, above=True)
    for axes, unit in ((2, "kg/m^2"), (3, "kg/m^3"))
}
# (a text is read where the container tells whether the balls are discs)
_DENSITY = BeforeValidator(lambda one: one if isinstance(one, str) else DENSITIES[3](one))


def _inertia(value: Any) -> str | float:
    if not isinstance(value, str):
        return _KAPPA(value)
    names = {**INERTIAS, **DISC_INERTIAS}
    if value not in names:
        raise refused(_KAPPA.what, shown(value), suggestion(value, list(names)))
    return value


def volume_of_balls(radius: Any, dimensions: int) -> Any:
    """Return the volume of balls of a radius; in two dimensions the area of discs."""
    return math.pi * radius**2 if dimensions == 2 else 4 / 3 * math.pi * radius**3


def _radii(value: Any) -> tuple[float, ...]:
    radii = np.array(value, dtype=float)
    if radii.ndim != 1 or not ((radii > 0) & (radii < math.inf)).all():
        raise refused("a length in m, > 0, of each ball", shown(value, 60))
    return tuple(radii.tolist())


def _name(value: Any) -> str:
    reserved = ("wall", *WALLS, ANY)
    if not isinstance(value, str) or not value or value in reserved:
        raise refused(f"a name other than {', '.join(reserved)}", shown(value))
    return value


class Species(Model):
    """Balls of one kind: of a :class:`carom.Ball` or a Disc, or by their radius, mass and inertia.

    Parameters
    ----------
    ball : Ball or Disc, in place of radius, mass and inertia
    count : number of balls
    name : what contacts and tables call it; default: "a"
    radius : of all balls; or a distribution: a table of ``distribution`` ("lognormal"), ``median``, ``sigma``, and the ``seed`` of
        the drawn radii
    mass : of a ball, default: 1; of radii by distribution, of one with the median, and the others have the same density
    density : instead of a mass (kg/m^3; of discs kg/m^2), a number or a text with its unit
    inertia : kappa = I/(m a^2), or "solid", "hollow" (balls), "disc", "ring" (discs); default: solid, disc
    temperature : k_B T at the start, the mean of m v^2 along an axis (J, if masses and speeds are in SI units); default: 1
    temperature_rotational : mean of I w^2 about an axis; default: the same; 0 starts without spin
    radii : of each ball (m), where they differ; the ball, or radius and mass, then give the material: mass grows with the
        volume (of discs the area). More than 48 different radii are divided into 48 classes of equal numbers of balls, each with
        their mean radius.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import Ball
    >>> from carom.gas import Species
    >>> Species(Ball(0.5, 1.0), 1000, "steel", temperature=2.0).count
    1000
    >>> Species(count=1000, radius=0.5, mass=1.0, inertia="hollow").name
    'a'
    """

    name: Annotated[str, BeforeValidator(_name)] = "a"
    count: Count
    radius: SpeciesRadius
    mass: Mass | None = None
    density: Annotated[float | str, _DENSITY] | None = None
    inertia: Annotated[str | float, BeforeValidator(_inertia)] | None = None
    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)] = 1.0
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None
    radii: Annotated[tuple[float, ...], BeforeValidator(_radii)] | None = None
    planar: ClassVar[bool | None] = None
    """Whether it was made of a Disc, or of a Ball; None: the container tells."""

    def __init__(self, *unnamed: Any, **fields: Any) -> None:
        order = ("ball", "count", "name", "temperature", "temperature_rotational", "radii")
        fields |= dict(zip(order, unnamed, strict=False))
        ball = fields.pop("ball", None)
        if ball is not None:
            require_type("Species", "ball", ball, Ball)
            fields |= {"radius": ball.radius, "mass": ball.mass, "inertia": ball.kappa}
        super().__init__(**fields)
        if ball is not None:
            object.__setattr__(self, "planar", ball.planar)

    # (as of Model: inside a scene pydantic makes it itself)
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    @model_validator(mode="after")
    def _one_of_mass_and_density(self) -> Species:
        if self.density is not None and self.mass is not None:
            raise refused("a mass or a density", "both", "omit one of them", field="density")
        if self.density is None and self.mass is None:
            object.__setattr__(self, "mass", 1.0)
        if self.radii is not None and len(self.radii) != self.count:
            raise refused(f"{self.count} radii > 0 of {self.name!r}", f"shape ({len(self.radii)},)", field="radii")
        return self

    def kappa(self, dimensions: int) -> float:
        """Return I/(m a^2)."""
        if self.inertia is None:
            return DISC_INERTIAS["disc"] if dimensions == 2 else INERTIAS["solid"]
        return {**INERTIAS, **DISC_INERTIAS}[self.inertia] if isinstance(self.inertia, str) else self.inertia

    @property
    def nominal(self) -> float:
        """The radius of a ball with the mass."""
        return self.radius.median if isinstance(self.radius, LognormalRadii) else self.radius

    def nominal_mass(self, dimensions: int) -> float:
        """Return the mass of a ball with the nominal radius; a density with the unit of other dimensions is refused."""
        volume = volume_of_balls(self.nominal, dimensions)
        return self.mass if self.mass is not None else float(DENSITIES[dimensions](self.density) * volume)

    @functools.cached_property
    def sizes(self) -> tuple[Array, NDArray[np.int64]]:
        """The radii of the classes of balls, and the class of each ball, (count,)."""
        if self.radii is not None:
            return size_classes(np.array(self.radii))
        if isinstance(self.radius, LognormalRadii):
            return size_classes(self.radius.radii(self.count))
        return np.array([self.radius]), np.broadcast_to(np.int64(0), self.count)  # (which takes no memory)

    @property
    def all_radii(self) -> Array:
        """The radii of all balls (m), (count,), of those of a class their mean."""
        values, which = self.sizes
        return values[which]

    def mass_of(self, radius: float, dimensions: int) -> float:
        """Return the mass of a ball of another radius than the nominal one: of the same material."""
        power = 2 if self.planar or (self.planar is None and dimensions == 2) else 3
        return self.nominal_mass(dimensions) * (radius / self.nominal) ** power

    def total_mass(self, dimensions: int) -> float:
        """Return the mass of all balls."""
        if self.radii is None and not isinstance(self.radius, LognormalRadii):
            return self.count * self.nominal_mass(dimensions)
        return self.nominal_mass(dimensions) * float(((self.all_radii / self.nominal) ** dimensions).sum())

    @property
    def size_note(self) -> str:
        """One line on radii by distribution: mean, standard deviation, skewness, classes; empty for balls of one radius."""
        if not isinstance(self.radius, LognormalRadii):
            return ""
        drawn, kept = self.radius.radii(self.count), self.all_radii
        mean, deviation, skewness = size_moments(kept)
        of = f"mean {mean:.5g}, standard deviation {deviation:.4g} ({100 * deviation / mean:.3g} %), skewness {skewness:.3g}"
        said = f"species {self.name!r}: radii {drawn.min():.4g} to {drawn.max():.4g}, {of}"
        classes = len(self.sizes[0])
        if classes < len(np.unique(drawn)):
            said += f"; in {classes} classes, with {deviation / size_moments(drawn)[1]:.4f} of the drawn deviation"
        return said


@dataclass(frozen=True)
class Kind:
    """Balls of one species and one radius, as the engine has them."""

    name: str
    count: int
    radius: float
    mass: float
    kappa: float
    temperature: float = 1.0
    temperature_rotational: float = 1.0


class SizeClasses(NamedTuple):
    """The kinds of balls that the engine simulates: one for each class of radii of each species."""

    kinds: list[Kind]
    groups: NDArray[np.int64]
    """The species of each kind."""
    which: NDArray[np.uint32]
    """The kind of each ball, in the order of the species and of their radii."""

    @classmethod
    def of(cls, species: Sequence[Species], axes: int) -> SizeClasses:
        """Return the classes of some species in a plane, or in space."""
        kinds: list[Kind] = []
        groups, parts = [], []
        for number, one in enumerate(species):
            radii, place = one.sizes
            kappa, spins = one.kappa(axes), one.temperature_rotational
            warm = one.temperature, one.temperature if spins is None else spins
            parts.append(place + len(kinds))
            for radius, count in zip(radii.tolist(), np.bincount(place, minlength=len(radii)).tolist(), strict=True):
                kinds.append(Kind(one.name, count, radius, one.mass_of(radius, axes), kappa, *warm))
            groups += [number] * len(radii)
        return cls(kinds, np.array(groups, np.int64), np.concatenate(parts).astype(np.uint32))


def side_faults(container: Container, widest: float, smallest: float) -> list[Fault]:
    """Return the faults of sides that are too short, or too long, for balls of these largest and smallest radii."""
    found, longest = FaultList(), LONGEST_SIDE * smallest
    for axis, (length, around) in enumerate(zip(container.size, container.periodic, strict=True)):
        where, width = f"container.size[{axis}]", ""
        if container.shape not in BOXES:  # (a figure has sizes of its own)
            where, width = ("container.height", "") if axis == 2 else ("container", f"a width along {'xy'[axis]} of ")
            if found and where == "container":  # (one width is enough)
                continue
        if length < (6 if around else 2) * widest:
            least = "3 diameters of the largest ball" if around else "the diameter of the largest ball"
            why = "in a shorter periodic box a ball could meet another and its image" if around else ""
            expected = f"{width}at least {least}, {format_number((6 if around else 2) * widest, 6)}"
            found.add(where, expected, shown(length), why)
        elif length > longest:
            expected = f"{width}at most {LONGEST_SIDE:g} radii of the smallest ball, {format_number(longest, 6)}"
            why = "positions would be rounded by more than such a ball can be off"
            found.add(where, expected, shown(length), why)
    return found


def _set_cells(one: Any, container: Container, diameter: float, count: int) -> None:
    """Divide the box into cells of at least a diameter, not many more of them than balls."""
    size, axes = np.array(container.size), len(container.size)
    width = max(diameter, (BALLS_PER_CELL * size.prod() / count) ** (1 / axes))
    wanted = [max(int(length / width), min(3, int(length / diameter))) for length in size.tolist()]
    for axis, n in enumerate(cells_at_most(wanted, count)):
        one["cells"][axis], one["cell_size"][axis] = n, size[axis] / max(n, 1)


def system_records(
    kinds: Sequence[Kind],
    container: Container,
    contacts: Sequence[GasContact],
    gravity: Sequence[float],
    contact_time: float = 0.0,
    drives: Mapping[str, Drive] | None = None,
    thermostat: Thermostat | None = None,
    seed: int = 0,
    shear_rate: float = 0.0,
) -> SystemRecords:
    """Return the records of a gas without its balls, of what :class:`carom.gas.GasScene` has checked."""
    axes, drives = len(container.size), drives or {}
    count = sum(one.count for one in kinds)
    system = np.zeros(1, SYSTEM)
    one = system[0]
    one["dimensions"], one["side"], one["periodic"], one["cells"], one["cell_size"] = axes, 1.0, 1, 1, 1.0
    one["side"][:axes], one["periodic"][:axes], one["volume"] = container.size, container.periodic, container.volume
    one["gravity"][: len(gravity)] = gravity
    one["contact_time"], one["scale"] = contact_time, 1.0
    # the engine's random numbers are a stream of their own; consecutive seeds give independent streams
    one["key"] = np.random.SeedSequence(seed).generate_state(2).astype(np.int64)
    if thermostat is not None:
        rotational = thermostat.temperature_rotational
        one["rate"], one["temperature"] = thermostat.rate * count, thermostat.temperature
        one["spin_temperature"] = thermostat.temperature if rotational is None else rotational
    widest = max(one.radius for one in kinds)
    _set_cells(one, container, 2 * widest, count)
    faces = face_records(container, drives, widest)
    shear = np.array([(shear_rate, shear_rate * container.size[1], 0.0)] if shear_rate != 0 else [], SHEAR)
    pairs, pair_forms, with_walls, wall_forms = contact_records(kinds, container.faces, contacts)
    if pairs["smooth"].all() and not ((with_walls["mu"] != 0) & (with_walls["beta"] != -1)).any():
        # nothing couples to the spins: energy that a wall gives to them would only be carried from wall to wall
        for record, face in zip(faces, container.faces, strict=True):
            if face.name in drives and drives[face.name].temperature_rotational is None:
                record["spin_temperature"] = 0.0
    whole, axis = np.zeros(1, WHOLE), layer_axis(container, one["gravity"].tolist(), drives, shear_rate != 0)
    whole["axis"] = axis
    layers = np.zeros(0 if axis < 0 else int(one["cells"][axis]) * len(kinds), LAYER)
    rows = np.array([(kind.radius, kind.mass, kind.kappa) for kind in kinds], SPECIES)
    flows = np.zeros(len(kinds), FLOW)
    return SystemRecords(
        system, rows, pairs, pair_forms, with_walls, wall_forms, faces, container.curves, shear, whole, flows, layers
    )


def thermostat_faults(thermostat: Thermostat, mass: float, radius: float) -> list[Fault]:
    """Return the fault of a rate with which balls of the least mass and radius hardly move."""
    most = MOST_KICKS * math.sqrt(thermostat.temperature / mass) / radius
    if not thermostat.rate > most > 0:
        return []
    expected = f"at most {MOST_KICKS:g} thermal speeds per radius of the smallest ball, {most:.3g}"
    advice = "lower it: kicked so often, hardly a ball meets another"
    return [Fault("", "thermostat.rate", expected, f"{thermostat.rate:g}", advice)]


def shear_faults(container: Container, gravity: Any, rate: float, thermal_speed: float) -> list[Fault]:
    """Return the faults of a shear rate in a container, of a gas with a thermal speed along an axis (0: at rest)."""
    found = FaultList()
    if container.faces or not all(container.periodic):
        got = f"walls {', '.join(container.names)}"
        found.add(
            "shear_rate", "a box that is periodic along all axes, without walls", got, "omit the rate or the walls"
        )
    if any(gravity):
        found.add(
            "shear_rate", "no gravity, under which a gas without walls falls for ever", "gravity", "omit one of them"
        )
    most = FASTEST_FLOW * thermal_speed / container.size[1]
    if not found and abs(rate) > most > 0:
        expected = f"at most {FASTEST_FLOW:g} thermal speeds across the box, {most:.3g}"
        found.add("shear_rate", expected, f"{rate:g}", "lower the rate, or raise the temperature")
    return found
