"""Contact points with restitution and friction, and the virtual displacements that constraints allow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from carom.derive.linear import Expr, Matrix, is_zero, null_basis, reduce_trig, tidy
from carom.errors import CaromError

__all__ = ["Contact", "contact_at", "displacement_basis", "displacement_limit"]


@dataclass(frozen=True)
class Contact:
    """A contact point: its velocity in the surface's frame, and the laws that close its impact.

    Attributes
    ----------
    name : str
        Prefix of its impulses: ``name.n``, ``name.t1``, ``name.t2``.
    normal : Expr
        Velocity of the contact point along the surface's normal, positive when it separates; linear in the speeds.
    tangents : tuple of Expr
        Its one (in the plane) or two (in space) velocities along orthonormal tangents.
    restitution : Expr
        Coefficient of restitution e, 0 to 1; number or symbol.
    friction : Expr
        Coulomb's mu: 0 is smooth, ``sympy.oo`` never slips; number or symbol.
    tangential_restitution : Expr
        beta, -1 to 1: a sticking contact returns -beta times its tangential velocity.
    hypothesis : str
        What e relates: "newton" (velocities), "poisson" (impulses) or "stronge" (work).

    Raises
    ------
    CaromError
        A value outside its range, more than two tangents, an unknown hypothesis; one line for each.

    Examples
    --------
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import Contact
    >>> y = dynamicsymbols("y")
    >>> Contact("floor", y.diff(), restitution=1, friction=0).restitution
    1
    >>> Contact("floor", y.diff(), restitution=2)
    Traceback (most recent call last):
        ...
    carom.errors.CaromError: contact floor: restitution: expected a value from 0 to 1, got 2
    """

    name: str
    normal: Expr
    tangents: tuple[Expr, ...] = ()
    restitution: Expr = sp.S.Zero
    friction: Expr = sp.oo
    tangential_restitution: Expr = sp.S.Zero
    hypothesis: str = "newton"

    def __post_init__(self) -> None:
        """Validate the ranges."""
        faults = []
        if self.hypothesis not in ("newton", "poisson", "stronge"):
            faults.append(
                f"contact {self.name}: hypothesis: expected 'newton', 'poisson' or 'stronge', got {self.hypothesis!r}"
            )
        if len(self.tangents) > 2:
            faults.append(f"contact {self.name}: tangents: expected at most two, got {len(self.tangents)}")
        for what, value, low, high in (
            ("restitution", self.restitution, 0, 1),
            ("friction", self.friction, 0, sp.oo),
            ("tangential_restitution", self.tangential_restitution, -1, 1),
        ):
            number = sp.sympify(value)
            object.__setattr__(self, what, number)
            if number.is_number and not (number.is_extended_real and low <= number <= high):
                faults.append(f"contact {self.name}: {what}: expected a value from {low} to {high}, got {value}")
        if faults:
            raise CaromError(*faults)


def contact_at(name: str, point: Any, frame: Any, axes: Sequence[Any], **surface: Any) -> Contact:
    """Return the contact at a ``Point`` of SymPy's mechanics, whose velocity is known in ``frame``.

    Parameters
    ----------
    name : str
        The contact's name.
    point : sympy.physics.mechanics.Point
        ``point.vel(frame)`` must be defined.
    frame : sympy.physics.mechanics.ReferenceFrame
        The frame in which the surface is at rest.
    axes : sequence
        Unit vectors of ``sympy.physics.vector``: the surface's normal, then one or two tangents.
    **surface
        restitution, friction, tangential_restitution, hypothesis, as in :class:`Contact`.

    Returns
    -------
    Contact

    Raises
    ------
    CaromError
        For another number of axes, or axes that are not orthonormal.

    Examples
    --------
    >>> from sympy.physics.mechanics import Point, ReferenceFrame, dynamicsymbols
    >>> from carom.derive import contact_at
    >>> x, y = dynamicsymbols("x y")
    >>> frame, point = ReferenceFrame("N"), Point("P")
    >>> point.set_vel(frame, x.diff() * frame.x + y.diff() * frame.y)
    >>> contact = contact_at("floor", point, frame, (frame.y, frame.x), restitution=1)
    >>> contact.normal, contact.tangents
    (Derivative(y(t), t), (Derivative(x(t), t),))
    """
    if not 2 <= len(axes) <= 3:
        raise CaromError(f"contact {name}: axes: expected the normal and one or two tangents, got {len(axes)} axes")
    for i, first in enumerate(axes):
        for j, second in enumerate(axes[: i + 1]):
            if sp.simplify(first.dot(second) - (1 if i == j else 0)) != 0:
                raise CaromError(
                    f"contact {name}: axes: expected orthonormal ones, but axes {j + 1} and {i + 1} are not orthonormal"
                )
    velocity = point.vel(frame)
    normal, *tangents = (sp.expand(velocity.dot(axis)) for axis in axes)
    return Contact(name, normal, tuple(tangents), **surface)


def displacement_basis(names: Sequence[Expr], columns: Matrix, independent: Sequence[Expr] | None) -> Matrix:
    """Return columns that span the orthogonal complement of ``columns`` (a row per speed), parametrised by ``independent``."""
    if independent is None:
        return null_basis(columns.T, None)
    for u in independent:
        if u not in names:
            raise CaromError(f"independent speeds: {u} is not a speed; expected some of {list(names)}")
    try:
        return null_basis(columns.T, [names.index(u) for u in independent])
    except CaromError as error:
        found = null_basis(columns.T)
        can = [
            str(u)
            for i, u in enumerate(names)
            if found.cols == len(independent)
            and not is_zero(sum((found[i, k] ** 2 for k in range(found.cols)), sp.S.Zero))
        ]
        asked = ", ".join(str(u) for u in independent)
        raise CaromError(
            f"independent speeds: {asked} cannot parametrise the {found.cols} virtual displacement(s) at this "
            f"configuration (a chart that fails here); speeds that move: {', '.join(can) or 'none'}"
        ) from error


def displacement_limit(column: Matrix, towards: Mapping[Expr, Expr]) -> Matrix:
    """Return the direction of a displacement at a pole of its components: times their common denominator it has a limit."""
    together = [sp.fraction(reduce_trig(x)) for x in column]
    common = sp.S.One
    for _, below in together:
        common = sp.lcm(common, below)
    cleared = [tidy(above * common / below) for above, below in together]
    found = sp.Matrix([tidy(x.xreplace(dict(towards))) for x in cleared])
    if all(is_zero(x) for x in found):
        raise CaromError(
            "displacement limit: independent: expected a speed with a limit there, but every component vanishes; take another"
        )
    return found
