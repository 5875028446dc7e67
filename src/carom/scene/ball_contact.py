"""The contact of two balls of a scene: its surface and law, and the material that says how long it lasts."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import PlainSerializer, PlainValidator

from carom.core.contact import friction_at_slip
from carom.core.jit.kernel import kernel
from carom.laws.hertz import POISSON, YOUNG, contact_modulus
from carom.laws.law import Law
from carom.scene.restitution import Bounce, Constant, FasterThanNothing
from carom.scene.ruled import FaultText, Ruled, put_fault
from carom.scene.schema import (
    Flag,
    Model,
    Modulus,
    NotNegative,
    Number,
    PoissonRatio,
    PositiveNumber,
    Spring,
    Vector,
    checked_part,
)
from carom.scene.wall import ContactParameters, PairLawChoice, contact

__all__ = ["RUBBING", "YOUNG", "BallContact", "FallingFriction"]


@kernel
def _falls(p: Any, out: Any) -> int:
    """Report a friction that rises; p: at_rest, at_speed."""
    return put_fault(0, 0.0, 0.0, 0.0, 0, out) if p[0] < p[1] else 0


class FallingFriction(Ruled):
    """Friction of two balls that falls with their slip u: at_speed + (at_rest - at_speed) exp(-u / speed).

    Parameters
    ----------
    at_rest, at_speed : >= 0: the coefficients without slip and at great slip, at_rest the larger one
    speed : > 0 m/s, over which it falls

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> pair = carom.BallContact(friction={"at_rest": 0.118, "at_speed": 0.01, "speed": 0.92})
    >>> round(pair.friction.at(1.0), 4)
    0.0464
    """

    rules: ClassVar = _falls
    ruled: ClassVar = ("at_rest", "at_speed")
    fault_texts: ClassVar = (FaultText("at_rest", "at least at_speed = {at_speed:g}", "{at_rest:g}"),)

    at_rest: NotNegative
    at_speed: NotNegative
    speed: FasterThanNothing

    @property
    def parameters(self) -> Vector:
        """Return mu, drop, rate of mu + drop exp(-rate u)."""
        return (self.at_speed, self.at_rest - self.at_speed, 1 / self.speed)

    def at(self, slip: float) -> float:
        """Return the coefficient at a slip (m/s)."""
        return float(friction_at_slip(*self.parameters, slip))


RUBBING = Number("a number >= 0 (inf: never slips), or a table { at_rest, at_speed, speed }", least=0, infinite=True)


class _NumberOrTable:
    what = RUBBING.what

    def __call__(self, value: Any) -> float | FallingFriction:
        falls = isinstance(value, dict | FallingFriction)
        return checked_part(FallingFriction, value) if falls else RUBBING(value)


def _as_written(friction: float | FallingFriction) -> Any:
    return friction.model_dump() if isinstance(friction, FallingFriction) else friction


Rubbing = Annotated[float | FallingFriction, PlainValidator(_NumberOrTable()), PlainSerializer(_as_written)]


class BallContact(Model):
    """The surface of the balls for impacts of two of them, and their law; default: elastic, without friction.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; default: 1
    friction : >= 0, or inf, or a table of at_rest, at_speed, speed (m/s): friction that falls with the slip u, at_speed +
        (at_rest - at_speed) exp(-u / speed); default: 0
    tangential_restitution : -1 to 1; default: 0
    law : str or carom.Law: a law of one contact, such as "contact", "alciatore" (friction that falls with the slip), "maw"
        (tangential compliance), or one of your own; default: "contact". Where contacts overlap in time, friction is Coulomb's,
        whatever the law, and contacts that stick end without slip.
    stiffness_ratio : > 0, tangential over normal stiffness, which laws of tangential compliance read; default: 2 (1 - nu)/(2 - nu)
        of Poisson's ratio nu
    young : Young's modulus of the balls, > 0 Pa; default: 5.84e9, phenolic resin. It says how long contacts last, and so which of
        them overlap in time, as in a rack; in scenes of sizes and masses for which the default is too soft, overlap is False
    poisson : Poisson's ratio of the balls, 0 to 0.5; default: 0.34
    overlap : whether contacts that overlap in time are resolved together, or one pair after the other as if contacts took no time;
        default: True

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.BallContact(restitution=0.95, friction=0.06).friction
    0.06
    """

    restitution: Bounce = Constant(value=1.0)
    friction: Rubbing = 0.0
    tangential_restitution: Spring = 0.0
    law: PairLawChoice = "contact"
    stiffness_ratio: PositiveNumber | None = None
    young: Modulus = YOUNG
    poisson: PoissonRatio = POISSON
    overlap: Flag = True

    @property
    def modulus(self) -> float:
        """Return E* of the contacts, E / (2 (1 - nu^2)), Pa; 0 where they are resolved one pair after the other."""
        return contact_modulus(self.young, self.poisson) if self.overlap else 0.0

    @property
    def contact(self) -> ContactParameters:
        """Return the parameters of the contact as numbers."""
        mu = self.friction.at_speed if isinstance(self.friction, FallingFriction) else self.friction
        return contact(self.restitution, mu, self.tangential_restitution)

    @property
    def tangential_stiffness(self) -> float:
        """Return the tangential over the normal stiffness of the contact: as given, or of its Poisson's ratio (Mindlin)."""
        found = 2 * (1 - self.poisson) / (2 - self.poisson) if self.stiffness_ratio is None else self.stiffness_ratio
        return float(found)

    def contact_of(self, law: Law) -> ContactParameters:
        """Return the parameters of the contact as a law's kernel takes them."""
        return self.contact.under(law, self.tangential_stiffness)

    def friction_of(self, law: Law) -> Vector:
        """Return mu, drop, rate of the friction mu + drop exp(-rate u) under a law."""
        if law.slip_friction is not None:
            return law.slip_friction
        if isinstance(self.friction, FallingFriction) and "friction" not in law.pinned:
            return self.friction.parameters
        return (self.contact_of(law).mu, 0.0, 0.0)
