"""Species of a gas, contacts and cells: checked, and written as the records of the event engine."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import AfterValidator, BeforeValidator, Field, PlainSerializer, WrapValidator, model_validator

from carom.bodies import Ball, Surface
from carom.errors import CaromError, Fault, FaultList, require_type, suggestion
from carom.gas.containers import JOINT_OVERLAP, WALLS, Container, ContainerFace, wall_name
from carom.gas.drives import Drive, Thermostat, face_records
from carom.gas.edmd.driver import SystemRecords
from carom.gas.edmd.gas_records import (
    CONTACT_FORM,
    FLOW,
    LAYER,
    MAX_BALLS,
    PAIR,
    RANDOM_NORMAL,
    RANDOM_UNIFORM,
    SHEAR,
    SPECIES,
    SYSTEM,
    WALL_CONTACT,
    WHOLE,
)
from carom.gas.profiles import layer_axis
from carom.scene.ball import FallingFriction, Rubbing
from carom.scene.restitution import Constant, Exponential, Han2005, Polynomial, Power, Restitution, Viscoelastic
from carom.scene.schema import CountOrZero, Model, Number, Share, Size, Spring, Vector, refused

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
NO_FORM = (0, 0.0, 0.0, 0.0, 0.0, 0.0)
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

    restitution: GasBounce
    friction: Rubbing
    tangential_restitution: Spring = 0.0

    def restitution_at(self, speed: float) -> float:
        """Return the restitution at a normal speed of approach, its mean if it is random."""
        return self.restitution.at(speed) if isinstance(self.restitution, Restitution) else self.restitution

    @property
    def surface(self) -> Surface | GasSurface:
        """The contact as a :class:`carom.Surface` where it has only numbers."""
        if isinstance(self.restitution, Restitution) or isinstance(self.friction, FallingFriction):
            return self
        return Surface(self.restitution, self.friction, self.tangential_restitution)

    @property
    def is_smooth(self) -> bool:
        """Whether the contact leaves spins as they are."""
        rubs = self.friction.at_rest if isinstance(self.friction, FallingFriction) else self.friction
        return rubs == 0 or self.tangential_restitution == -1


def contact_numbers(surface: Surface | GasSurface) -> tuple[tuple[float, float, float], tuple[float, ...], bool]:
    """Return restitution, friction and tangential restitution; the form of what is no number (code 0: all are); and smoothness."""
    if not isinstance(surface, GasSurface):
        e, mu, beta = (float(x) for x in (surface.restitution, surface.friction, surface.tangential_restitution))
        return (e, mu, beta), NO_FORM, mu == 0 or beta == -1
    bounce, rub, beta = surface.restitution, surface.friction, surface.tangential_restitution
    form = (bounce.code, *bounce.p) if isinstance(bounce, Restitution) else NO_FORM[:4]
    falls = rub.parameters if isinstance(rub, FallingFriction) else (rub, 0.0, 0.0)
    number = UNKNOWN if isinstance(bounce, Restitution) else bounce
    return (number, falls[0], beta), (*form, *falls[1:]), surface.is_smooth


# --- between species ----------------------------------------------------------------------------------------------


Contacts = Surface | GasSurface | Mapping[tuple[str, str], Surface | GasSurface]


def contacts_by_names(faults: FaultList, contacts: Contacts, names: Sequence[str], container: Container) -> Contacts:
    """Return contacts under the container's own names of walls; add the faults of contacts: no surface, or unknown names."""
    if (wrong := _wrong_contacts(contacts)) is not None:
        faults.add("contacts", "a carom.Surface, or one for each pair of names, {('a', 'wall'): Surface(...)}", wrong)
    elif not isinstance(contacts, Surface | GasSurface):
        sides = [wall_name(name, len(container.size)) for name in WALLS[: 2 * len(container.size)]]
        known = [ANY, *names, "wall", *dict.fromkeys((*sides, *container.names))]
        for name in sorted({name for key in contacts for name in key} - set(known)):
            faults.add("contacts", "names of species or walls", f"{name!r}; {suggestion(name, known)}")
    return contacts


def _wrong_contacts(contacts: Any) -> str | None:
    """Return the first entry that is no surface, or not under a pair of names; None if all are valid."""
    if isinstance(contacts, Surface | GasSurface):
        return None
    if not isinstance(contacts, Mapping):
        return f"{contacts!r:.60}"
    for pair, surface in contacts.items():
        named = isinstance(pair, tuple) and len(pair) == 2 and all(isinstance(name, str) for name in pair)
        if not named or not isinstance(surface, Surface | GasSurface):
            return f"{pair!r:.40}: {surface!r:.40}"
    return None


def best_contact(keys: Iterable[tuple[str, str]], one: str, others: Sequence[str]) -> tuple[str, str] | None:
    """Return which of some pairs of names says most about a species and the first of others: "*" stands for every name."""
    found: dict[tuple[int, int, int], tuple[str, str]] = {}
    for order, key in enumerate(keys):
        for first, second in (key, key[::-1]):
            if first in {one, ANY} and second in {*others, ANY}:
                rank = len(others) if second == ANY else list(others).index(second)
                found.setdefault(((first, second).count(ANY), rank, order), key)
    return found[min(found)] if found else None


def _surface(faults: FaultList, contacts: Contacts, one: str, others: Sequence[str]) -> Surface | GasSurface:
    """Return the surface between a species and the first of others for which one is given."""
    if isinstance(contacts, Surface | GasSurface):
        return contacts
    key = best_contact(contacts, one, others)
    if key is not None:
        return contacts[key]
    faults.add("contacts", f"a Surface for ({one!r}, {others[-1]!r})", f"keys {sorted(contacts)}")
    return Surface()


def contact_records(
    faults: FaultList, species: Sequence[tuple[str, float]], faces: Sequence[ContainerFace], contacts: Contacts
) -> list[NDArray[np.void]]:
    """Return the records of contacts of pairs and with walls, each with their forms; ``species``: names and radii (m)."""
    count = len(species)
    sizes = (count**2, count**2, len(faces) * count, len(faces) * count)
    kinds = (PAIR, CONTACT_FORM, WALL_CONTACT, CONTACT_FORM)
    found = [np.zeros(size, kind) for size, kind in zip(sizes, kinds, strict=True)]
    for i, (name, radius) in enumerate(species):
        for j, (other, its_radius) in enumerate(species):
            numbers, form, smooth = contact_numbers(_surface(faults, contacts, name, [other]))
            distance = radius + its_radius
            found[0][i * count + j] = (distance, distance * distance, *numbers, smooth, *NO_TOTALS)
            found[1][i * count + j] = form
        for k, face in enumerate(faces):
            numbers, form, _smooth = contact_numbers(_surface(faults, contacts, name, [face.name, "wall"]))
            found[2][k * count + i] = (*face.offset(radius), *numbers, *NO_TOTALS)
            found[3][k * count + i] = form
    return found


# ----------------------------------------------------------------------------------------------------
# Species of a gas, contacts and cells: checked, and written as the records of the event engine.


FASTEST_FLOW = (
    1e6  # thermal speeds, of a shear flow across the box: faster, images go by so fast that hardly a ball meets another
)
MOST_KICKS = 1e6  # of a thermostat, on a ball's way of one radius
BALLS_PER_CELL = 0.5  # where the balls are small compared with their distances


@dataclass(frozen=True)
class Species:
    """Balls of one kind.

    Parameters
    ----------
    ball : Ball or Disc
        Radius, mass and moment of inertia.
    count : int
        Number of balls.
    name : str
        What contacts and tables call it.
    temperature : float
        k_B T at the start (J, if masses and speeds are in SI units): the mean of m v^2 along each axis.
    temperature_rotational : float, optional
        Mean of I w^2 about each axis of spin; default: the same; 0 starts without spin.
    radii : (count,) array, optional
        Radius of each ball (m), where they differ; ``ball`` then gives the material: mass grows with the volume (of discs the
        area). More than 48 different radii are divided into 48 classes of equal numbers of balls, each with their mean radius.

    Examples
    --------
    >>> from carom import Ball
    >>> from carom.gas import Species
    >>> Species(Ball(0.5, 1.0), 1000, "steel", temperature=2.0).count
    1000
    """

    ball: Ball
    count: int
    name: str = "a"
    temperature: float = 1.0
    temperature_rotational: float | None = None
    radii: ArrayLike | None = field(default=None, compare=False)


def _set_cells(faults: FaultList, one: Any, container: Container, widest: float, longest: float, count: int) -> None:
    """Divide the box into cells of at least a diameter, not many more of them than balls."""
    if max(container.size) > longest:
        expected = f"at most {LONGEST_SIDE:g} radii of the smallest ball ({longest:g})"
        faults.add("side", expected, f"{max(container.size):g}")
    size, axes = np.array(container.size), len(container.size)
    width = max(widest, (BALLS_PER_CELL * size.prod() / count) ** (1 / axes))
    wanted = [max(int(length / width), min(3, int(length / widest))) for length in size.tolist()]
    for axis, n in enumerate(cells_at_most(wanted, count)):
        if wanted[axis] < (3 if container.periodic[axis] else 1):
            least = "three diameters" if container.periodic[axis] else "one diameter"
            faults.add(
                "side", f"at least {least} of the largest ball ({widest:g})", f"{size[axis]:g} along axis {axis}"
            )
        one["cells"][axis], one["cell_size"][axis] = n, size[axis] / max(n, 1)


def _check_discs(faults: FaultList, species: Sequence[Species], axes: int) -> None:
    discs = [one for one in species if one.ball.planar]
    if discs and axes == 3:
        flat = ", ".join(one.name for one in discs)
        faults.add("species", "carom.Ball in three dimensions", f"a Disc, which spins about z only: {flat}")
    if wide := [one.name for one in discs if one.ball.kappa > 1]:
        faults.add(
            "species",
            "kappa of at most 1 for discs that meet each other, as weights beyond the rims would meet first",
            f"more: {', '.join(wide)}",
        )


def system_records(
    species: Sequence[Species],
    container: Container,
    contacts: Contacts,
    gravity: Any,
    contact_time: float,
    drives: Mapping[str, Drive],
    thermostat: Thermostat | None,
    seed: int,
    groups: Sequence[int] | None = None,
    shear_rate: float = 0.0,
) -> SystemRecords:
    """Return the records of a gas without its balls; CaromError with every fault.

    ``groups`` numbers the species of which the given ones are classes of radii, which may then have one name.
    """
    faults, axes = FaultList("Gas"), len(container.size)
    for one in species:
        require_type("Gas", "species", one, Species)
    names = [one.name for one in species]
    count = sum(one.count for one in species)
    if not names or min(one.count for one in species) < 0 or not 0 < count <= MAX_BALLS:
        faults.add("species", f"1 to {MAX_BALLS} balls in total", f"{[one.count for one in species]}")
    if len(set(names)) < (len(names) if groups is None else len(set(groups))):
        faults.add("species", "a different name for each", f"{names}")
    _check_discs(faults, species, axes)
    pull = np.array(gravity, dtype=float)
    if pull.shape not in {(3,), (axes,)} or not np.isfinite(pull).all():
        faults.add("gravity", f"{axes} numbers", f"{gravity!r}")
    elif axes == 2 and pull[2:].any():
        faults.add("gravity", "no component along z for discs", f"{gravity!r}")
    if not 0 <= contact_time < math.inf:
        faults.add("contact_time", "a time >= 0", f"{contact_time!r}")
    by_names = contacts_by_names(faults, contacts, names, container)
    faults.raise_if_any()
    system = np.zeros(1, SYSTEM)
    one = system[0]
    one["dimensions"], one["side"], one["periodic"], one["cells"], one["cell_size"] = axes, 1.0, 1, 1, 1.0
    one["side"][:axes], one["periodic"][:axes], one["volume"] = container.size, container.periodic, container.volume
    one["gravity"][: len(pull)] = pull
    one["contact_time"], one["scale"] = contact_time, 1.0
    # the engine's random numbers are a stream of their own; consecutive seeds give independent streams
    one["key"] = np.random.SeedSequence(seed).generate_state(2).astype(np.int64)
    _set_thermostat(faults, one, thermostat, species)
    widest = max(float(one.ball.radius) for one in species)
    longest = LONGEST_SIDE * min(float(one.ball.radius) for one in species)
    _set_cells(faults, system[0], container, 2 * widest, longest, count)
    if (most := container.widest_radius) * (1 - JOINT_OVERLAP) <= widest:
        faults.add("species", f"radii below {most:g}, the ellipse's smaller half axis", f"{widest:g}")
    faces = face_records(faults, container, drives, widest)
    fastest = max(math.sqrt(one.temperature / one.ball.mass) for one in species)
    shear = _shear_record(faults, container, pull, shear_rate, fastest)
    kinds = np.array([(kind.ball.radius, kind.ball.mass, kind.ball.kappa) for kind in species], SPECIES)
    radii = [(kind.name, float(kind.ball.radius)) for kind in species]
    pairs, pair_forms, with_walls, wall_forms = contact_records(faults, radii, container.faces, by_names)
    faults.raise_if_any()
    if pairs["smooth"].all() and not ((with_walls["mu"] != 0) & (with_walls["beta"] != -1)).any():
        # nothing couples to the spins: energy that a wall gives to them would only be carried from wall to wall
        for record, face in zip(faces, container.faces, strict=True):
            if face.name in drives and drives[face.name].temperature_rotational is None:
                record["spin_temperature"] = 0.0
    whole, axis = np.zeros(1, WHOLE), layer_axis(container, one["gravity"].tolist(), drives, shear_rate != 0)
    whole["axis"] = axis
    layers = np.zeros(0 if axis < 0 else int(one["cells"][axis]) * len(species), LAYER)
    curves, flows = container.curves, np.zeros(len(species), FLOW)
    return SystemRecords(
        system, kinds, pairs, pair_forms, with_walls, wall_forms, faces, curves, shear, whole, flows, layers
    )


def _set_thermostat(faults: FaultList, one: Any, thermostat: Thermostat | None, species: Sequence[Species]) -> None:
    """Set the thermostat's rate and temperatures; add the fault of a rate with which balls hardly move."""
    if thermostat is None:
        return
    radius = min(float(kind.ball.radius) for kind in species)
    most = MOST_KICKS * max(math.sqrt(thermostat.temperature / kind.ball.mass) for kind in species) / radius
    if thermostat.rate > most > 0:
        expected = f"at most {MOST_KICKS:g} thermal speeds per radius of the smallest ball, {most:.3g}"
        faults.add(
            "thermostat.rate",
            expected,
            f"{thermostat.rate:g}",
            "lower it: kicked so often, hardly a ball meets another",
        )
    rotational = thermostat.temperature_rotational
    one["rate"], one["temperature"] = thermostat.rate * sum(kind.count for kind in species), thermostat.temperature
    one["spin_temperature"] = thermostat.temperature if rotational is None else rotational


def _shear_record(
    faults: FaultList, container: Container, gravity: Any, rate: float, thermal_speed: float
) -> NDArray[np.void]:
    """Return the record of a shear rate, or none."""
    if not math.isfinite(rate):
        faults.add("shear_rate", "a finite rate", f"{rate!r}")
    elif rate != 0:
        faults += [
            replace(fault, where=faults.where) for fault in shear_faults(container, gravity, rate, thermal_speed)
        ]
        return np.array([(rate, rate * container.size[1], 0.0)], SHEAR)
    return np.zeros(0, SHEAR)


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
