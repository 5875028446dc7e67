"""Contacts of a gas: which species has which, as the engine's records; restitution and friction as numbers, or as functions.

Restitution may depend on the speed, as in scenes, or be a random number for each contact.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import AfterValidator, BeforeValidator, Field, PlainSerializer, model_validator

from carom.bodies import Surface
from carom.errors import FaultList, suggestion
from carom.gas.containers import WALLS, Container, wall_name
from carom.gas.edmd.gas_records import CONTACT_FORM, PAIR, RANDOM_NORMAL, RANDOM_UNIFORM, WALL_CONTACT
from carom.gas.faces import ContainerFace
from carom.scene.ball_contact import FallingFriction, Rubbing
from carom.scene.restitution import Constant, Exponential, Han2005, Polynomial, Power, Restitution, Viscoelastic
from carom.scene.schema import Model, Number, Share, Spring, Vector, refused

__all__ = [
    "ANY", "Contacts", "GasSurface", "NormalRestitution", "UniformRestitution", "best_contact", "contact_numbers",
    "contact_records", "contacts_by_names",
]  # fmt: skip

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
