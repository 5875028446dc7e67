"""A contact: a point of a body that meets a surface, with its frame, restitution and friction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from carom.derive.linear import Expr
from carom.errors import CaromError

__all__ = ["Contact", "contact_at"]


@dataclass(frozen=True)
class Contact:
    """A contact point's velocity in its own frame, and what closes its impact.

    Attributes:
        name: how its impulses are called: ``name.n``, ``name.t1``, ``name.t2``.
        normal: velocity of the contact point along the surface's normal, positive when it separates; linear in speeds.
        tangents: its one (plane) or two (space) velocities along orthonormal tangents.
        restitution: e, 0 to 1, number or symbol.
        friction: Coulomb's mu; 0 smooth, ``sympy.oo`` never slips; number or symbol.
        tangential_restitution: beta, -1 to 1: a sticking contact returns -beta of its tangential velocity.
        hypothesis: what e means: "newton" (velocities), "poisson" (impulses) or "stronge" (work).
    """

    name: str
    normal: Expr
    tangents: tuple[Expr, ...] = ()
    restitution: Expr = sp.S.Zero
    friction: Expr = sp.oo
    tangential_restitution: Expr = sp.S.Zero
    hypothesis: str = "newton"

    def __post_init__(self) -> None:
        """Refuse what no surface has."""
        faults = []
        if self.hypothesis not in ("newton", "poisson", "stronge"):
            faults.append(f"contact {self.name}: hypothesis must be newton, poisson or stronge, got {self.hypothesis}")
        if len(self.tangents) > 2:
            faults.append(f"contact {self.name}: at most two tangents, got {len(self.tangents)}")
        for what, value, low, high in (
            ("restitution", self.restitution, 0, 1),
            ("friction", self.friction, 0, sp.oo),
            ("tangential_restitution", self.tangential_restitution, -1, 1),
        ):
            number = sp.sympify(value)
            object.__setattr__(self, what, number)
            if number.is_number and not (number.is_extended_real and low <= number <= high):
                faults.append(f"contact {self.name}: {what} must lie between {low} and {high}, got {value}")
        if faults:
            raise CaromError(*faults)


def contact_at(name: str, point: Any, frame: Any, axes: Sequence[Any], **surface: Any) -> Contact:
    """A contact from SymPy's mechanics: a ``Point`` whose velocity is known in ``frame``.

    Args:
        name: the contact's name.
        point: a ``sympy.physics.mechanics.Point``; ``point.vel(frame)`` must be defined.
        frame: the ``ReferenceFrame`` the surface rests in.
        axes: unit vectors of ``sympy.physics.vector``: the surface's normal, then one or two tangents.
        **surface: restitution, friction, tangential_restitution, hypothesis, as in `Contact`.
    """
    if not 2 <= len(axes) <= 3:
        raise CaromError(f"contact {name}: expected the normal and one or two tangents, got {len(axes)} axes")
    for i, first in enumerate(axes):
        for j, second in enumerate(axes[: i + 1]):
            if sp.simplify(first.dot(second) - (1 if i == j else 0)) != 0:
                raise CaromError(f"contact {name}: axes {j + 1} and {i + 1} are not orthonormal")
    velocity = point.vel(frame)
    normal, *tangents = (sp.expand(velocity.dot(axis)) for axis in axes)
    return Contact(name, normal, tuple(tangents), **surface)
