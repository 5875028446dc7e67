"""The contact of two balls of a scene: its surface, and the material that says how long it lasts."""

from __future__ import annotations

from carom.laws.hertz import POISSON, YOUNG, contact_modulus
from carom.scene.restitution import Bounce, Constant
from carom.scene.schema import Flag, Friction, Model, Modulus, PoissonRatio, Spring
from carom.scene.wall import ContactParameters, contact

__all__ = ["BallContact"]


class BallContact(Model):
    """The surface of the balls for impacts of two of them; default: elastic, without friction.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; default: 1
    friction : >= 0, or inf; default: 0
    tangential_restitution : -1 to 1; default: 0. Where contacts overlap in time, contacts that stick end without slip.
    young : Young's modulus of the balls, > 0 Pa; default: 5.84e9, phenolic resin. It says how long contacts last, and so which of
        them overlap in time, as in a rack
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
    friction: Friction = 0.0
    tangential_restitution: Spring = 0.0
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
        return contact(self.restitution, self.friction, self.tangential_restitution)
