"""Convert a Lagrangian and its constraints to matrices: mass matrix, generalised speeds, constraint rows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

from carom.derive.linear import Expr, Matrix, independent_rows, is_zero, null_basis, tidy
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
    expression: Expr = None


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

    def at(self, expr: Expr, moment: int) -> Expr:
        """Return ``expr`` with the speeds just before (``moment`` 0) or just after (1) the instant."""
        return sp.sympify(expr).xreplace(dict(zip(self.names, self.after if moment else self.before, strict=True)))


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


def mass_matrix(
    lagrangian: Expr, coordinates: Sequence[Expr], speeds: Speeds, at: Mapping[Expr, Expr]
) -> tuple[Matrix, Matrix]:
    """Return the mass matrix M and the part b of the momenta that does not depend on the speeds: p = M u + b.

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
    rest = sp.Matrix([p.xreplace(dict.fromkeys(speeds.dummies, sp.S.Zero)) for p in momenta])
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
    return mass, rest


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
    return ConstraintRow(name, sp.Matrix([coefficients]), drift, closing, expr)


def named_constraints(constraints: Mapping[str, Any] | Iterable[Any] | None, prefix: str) -> dict[str, Any]:
    """Return the constraints by name: the given names, or ``prefix`` and a count."""
    if constraints is None:
        return {}
    if isinstance(constraints, Mapping):
        return {str(k): v for k, v in constraints.items()}
    if isinstance(constraints, sp.Basic) and not isinstance(constraints, sp.Tuple):
        constraints = [constraints]
    return {f"{prefix} {i + 1}": c for i, c in enumerate(constraints)}
