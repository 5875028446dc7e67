"""Convert a Lagrangian and its constraints to matrices: mass matrix, generalised speeds, constraint rows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

from carom.derive.linear import Expr, Matrix, independent_rows, is_zero, null_basis, reduce_trig, tidy
from carom.errors import CaromError

TIME = dynamicsymbols._t


@dataclass(frozen=True)
class ConstraintRow:
    """One constraint that is linear in the speeds: ``coefficients . u + drift = 0``.

    ``closing`` is Newton's coefficient of restitution e, a number or an expression (e = 0: the constraint holds afterwards), or
    None where the user gives closing equations.
    """

    name: str
    coefficients: Matrix
    drift: Expr
    closing: Expr | None = sp.S.Zero


@dataclass(frozen=True)
class Speeds:
    """The generalised speeds, and the symbols that denote them just before (0) and just after (1) the instant."""

    names: tuple[Expr, ...]
    before: tuple[Expr, ...]
    after: tuple[Expr, ...]
    dummies: tuple[Expr, ...]

    @property
    def count(self) -> int:
        """Number of speeds."""
        return len(self.names)

    def plain(self, expr: Expr) -> Expr:
        """Return ``expr`` with every speed replaced by a dummy symbol, so that it can be differentiated with respect to it."""
        return sp.sympify(expr).xreplace(dict(zip(self.names, self.dummies, strict=True)))


def _base_name(speed: Expr) -> str:
    if isinstance(speed, sp.Derivative):
        return f"{speed.expr.func.__name__}dot"
    return speed.func.__name__ if isinstance(speed, AppliedUndef) else str(speed)


def make_speeds(coordinates: Sequence[Expr], speeds: Sequence[Expr] | None) -> Speeds:
    """Return the speeds: the given quasi-velocities, or the time derivatives of the coordinates."""
    for q in coordinates:
        if not isinstance(q, AppliedUndef):
            raise CaromError(f"coordinates: expected functions of time such as dynamicsymbols('x'), got {q}")
    if len(set(coordinates)) != len(coordinates):
        raise CaromError(f"coordinates: expected each one once, got {list(coordinates)}")
    names = tuple(speeds) if speeds is not None else tuple(q.diff(TIME) for q in coordinates)
    if not names:
        raise CaromError("coordinates: expected at least one, got none")
    for u in names:
        if not isinstance(u, AppliedUndef | sp.Derivative):
            raise CaromError(f"speeds: expected functions of time or their derivatives, got {u}")
    return Speeds(
        names,
        tuple(sp.Symbol(f"{_base_name(u)}0", real=True) for u in names),
        tuple(sp.Symbol(f"{_base_name(u)}1", real=True) for u in names),
        tuple(sp.Dummy(_base_name(u), real=True) for u in names),
    )


def check_known(expr: Expr, coordinates: Sequence[Expr], speeds: Speeds, where: str) -> None:
    """Raise CaromError for a function of time, or a derivative, that is neither a coordinate nor a speed of the system."""
    rest = speeds.plain(expr)
    if rest.has(sp.zoo, sp.nan, sp.oo):
        raise CaromError(f"{where}: expected a finite expression, got {expr}")
    unknown = set(rest.atoms(sp.Derivative)) | (rest.atoms(AppliedUndef) - set(coordinates))
    inside = {f for d in rest.atoms(sp.Derivative) for f in d.atoms(AppliedUndef)}
    unknown -= {f for f in inside if f in coordinates}
    if unknown:
        listed = ", ".join(sorted(str(s) for s in unknown))
        raise CaromError(
            f"{where}: unknown {listed}; expected only the coordinates {list(coordinates)} and their speeds"
        )


def mass_matrix(lagrangian: Expr, coordinates: Sequence[Expr], speeds: Speeds, at: Mapping[Expr, Expr]) -> Matrix:
    """Return the mass matrix M: the momenta are M u, and a part that does not depend on the speeds and so does not jump.

    Raises CaromError where the Lagrangian is not quadratic in the speeds, or M is singular; the message then names the motion
    that carries no kinetic energy.
    """
    check_known(lagrangian, coordinates, speeds, "Lagrangian")
    plain = speeds.plain(lagrangian)
    momenta = [sp.diff(plain, u) for u in speeds.dummies]
    mass = sp.Matrix([[sp.diff(p, u) for u in speeds.dummies] for p in momenta])
    for i, u in enumerate(speeds.names):
        if any(mass[i, j].has(*speeds.dummies) for j in range(speeds.count)):
            raise CaromError(
                f"Lagrangian: not quadratic in the speed {u}; impulsive motion needs a momentum linear in it"
            )
    mass = mass.xreplace(dict(at)).applyfunc(tidy)
    kept, _ = independent_rows(mass)
    if len(kept) < speeds.count:
        idle = null_basis(mass)
        parts = [f"{tidy(idle[i, 0])}*{u}" for i, u in enumerate(speeds.names) if not is_zero(idle[i, 0])]
        raise CaromError(
            f"mass matrix: singular; the motion {' + '.join(parts)} carries no kinetic energy "
            "(a massless coordinate, or an attitude where the angles themselves fail: take other angles or "
            "quasi-velocities)"
        )
    return mass


def constraint_row(
    name: str,
    expr: Expr,
    coordinates: Sequence[Expr],
    speeds: Speeds,
    at: Mapping[Expr, Expr],
    closing: Expr | None = sp.S.Zero,
) -> ConstraintRow:
    """Return the row of an expression that must vanish: of the speeds (Pfaffian), or of the coordinates alone (differentiated)."""
    if isinstance(expr, sp.Equality):
        expr = expr.lhs - expr.rhs
    expr = sp.sympify(expr)
    check_known(expr, coordinates, speeds, f"constraint {name}")
    plain = speeds.plain(expr)
    if not plain.has(*speeds.dummies):
        if any(not isinstance(u, sp.Derivative) for u in speeds.names):
            raise CaromError(
                f"constraint {name}: holonomic, but the speeds are quasi-velocities; give its velocity form"
            )
        plain = speeds.plain(sp.diff(expr, TIME))
        if not plain.has(*speeds.dummies):
            raise CaromError(f"constraint {name}: expected an expression of the coordinates or the speeds, got {expr}")
    coefficients = []
    for u, dummy in zip(speeds.names, speeds.dummies, strict=True):
        c = sp.diff(plain, dummy)
        if c.has(*speeds.dummies) and tidy(c).has(*speeds.dummies):
            raise CaromError(f"constraint {name}: not linear in the speed {u}: {expr}")
        coefficients.append(tidy(c.xreplace(dict(at))))
    drift = tidy(plain.xreplace(dict.fromkeys(speeds.dummies, sp.S.Zero)).xreplace(dict(at)))
    return ConstraintRow(name, sp.Matrix([coefficients]), drift, closing)


def named_constraints(constraints: Mapping[str, Any] | Iterable[Any] | None, prefix: str) -> dict[str, Any]:
    """Return the constraints by name: the given names, or ``prefix`` and a count."""
    if constraints is None:
        return {}
    if isinstance(constraints, Mapping):
        return {str(k): v for k, v in constraints.items()}
    if isinstance(constraints, sp.Basic) and not isinstance(constraints, sp.Tuple):
        constraints = [constraints]
    return {f"{prefix} {i + 1}": c for i, c in enumerate(constraints)}


# ----------------------------------------------------------------------------------------------------
# Contact points with restitution and friction, and the virtual displacements that constraints allow.


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
    common = sp.lcm_list([below for _, below in together])
    cleared = [tidy(above * common / below) for above, below in together]
    found = sp.Matrix([tidy(x.xreplace(dict(towards))) for x in cleared])
    if all(is_zero(x) for x in found):
        raise CaromError(
            "displacement limit: independent: expected a speed with a limit there, but every component vanishes; take another"
        )
    return found
