"""The result of an impulsive problem, and the warnings that an impact law may raise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp

from carom.derive.linear import Expr, tidy

__all__ = ["EnergyGain", "FrictionJam", "ImpactWarning", "Jump"]


class ImpactWarning(UserWarning):
    """The closing hypothesis of an impact leads to a result that no pair of bodies shows.

    Base class of the warnings of this package; ``warnings.simplefilter("error", ImpactWarning)`` turns them into errors.

    Examples
    --------
    >>> from carom.derive import EnergyGain, ImpactWarning
    >>> issubclass(EnergyGain, ImpactWarning)
    True
    """


class EnergyGain(ImpactWarning):
    """Newton's restitution together with friction creates kinetic energy (Kane and Levinson, *Dynamics*, 1985).

    Examples
    --------
    >>> import warnings
    >>> from carom.derive import EnergyGain
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     warnings.warn("the jump gains energy", EnergyGain)
    >>> caught[0].category.__name__
    'EnergyGain'
    """


class FrictionJam(ImpactWarning):
    """Friction reverses the effect of the normal impulse: the sliding contact jams (Painlevé 1895).

    Examples
    --------
    >>> from carom.derive import FrictionJam, ImpactWarning
    >>> issubclass(FrictionJam, ImpactWarning)
    True
    """


@dataclass(frozen=True)
class Jump:
    """The change of all speeds at an instant: the result of :meth:`ImpulsiveMotion.solve`.

    Attributes
    ----------
    after : dict
        Each speed and its value just after the instant, in terms of the speeds just before.
    impulses : dict
        Each constraint's name and its impulse (Lagrange multiplier), positive along that constraint's velocity.
    energy_change : Expr
        Kinetic energy after the instant minus that before.
    redundant : dict
        Each redundant constraint's name and the linear combination of the other constraints that implies it.
    free_impulses : tuple
        Symbols of the impulses that rigid bodies leave undetermined, one for each redundant constraint.
    conditions : dict
        Relations under which the result is valid, by name, e.g. Coulomb's friction cone.
    notes : tuple of str
        Sentences on choices and limits.

    Examples
    --------
    A particle of mass m that meets a wall with Newton's restitution e:

    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import Contact, ImpulsiveMotion
    >>> m, e = sp.symbols("m e", positive=True)
    >>> x = dynamicsymbols("x")
    >>> wall = Contact("wall", x.diff(), restitution=e, friction=0)
    >>> jump = ImpulsiveMotion(m * x.diff() ** 2 / 2, [x], contacts=[wall]).solve()
    >>> jump.after[x.diff()], jump.impulses["wall.n"]
    (-e*xdot0, -m*xdot0*(e + 1))
    >>> jump.subs({e: 1}).energy_change
    0
    """

    after: dict[Expr, Expr]
    impulses: dict[str, Expr]
    energy_change: Expr
    redundant: dict[str, dict[str, Expr]] = field(default_factory=dict)
    free_impulses: tuple[Expr, ...] = ()
    conditions: dict[str, Expr] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def subs(self, values: Mapping[Expr, Expr]) -> Jump:
        """Return the same jump with values substituted for symbols."""

        def put(table: Mapping[Any, Expr]) -> dict[Any, Expr]:
            return {k: sp.sympify(v).subs(values) for k, v in table.items()}

        return replace(
            self,
            after=put(self.after),
            impulses=put(self.impulses),
            conditions=put(self.conditions),
            energy_change=tidy(sp.sympify(self.energy_change).subs(values)),
        )
