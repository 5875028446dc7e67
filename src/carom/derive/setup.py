"""From what a user hands over to matrices: kinetic energy, constraint rows, and one clear fault for each bad input."""

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
class Row:
    """One constraint that is linear in the speeds: ``coefficients . u + drift = 0``.

    ``closing`` says what the instant leaves of it: a number or expression e for Newton's rule (e = 0: the constraint
    holds afterwards), or None where the user closes the equations himself.
    """

    name: str
    coefficients: Matrix
    drift: Expr
    closing: Expr | None = sp.S.Zero
    expression: Expr = None


@dataclass(frozen=True)
class Speeds:
    """The speeds of a problem and the plain symbols that stand for them just before (0) and just after (1)."""

    names: tuple[Expr, ...]
    before: tuple[Expr, ...]
    after: tuple[Expr, ...]
    dummies: tuple[Expr, ...]

    @property
    def count(self) -> int:
        """How many speeds."""
        return len(self.names)

    def plain(self, expr: Expr) -> Expr:
        """``expr`` with every speed replaced by a plain dummy, so that derivatives and degrees can be taken."""
        return sp.sympify(expr).xreplace(dict(zip(self.names, self.dummies, strict=True)))

    def at(self, expr: Expr, moment: int) -> Expr:
        """``expr`` with the speeds just before (``moment`` 0) or just after (1) the instant."""
        return sp.sympify(expr).xreplace(dict(zip(self.names, self.after if moment else self.before, strict=True)))


def _base_name(speed: Expr) -> str:
    if isinstance(speed, sp.Derivative):
        return f"{speed.expr.func.__name__}dot"
    return speed.func.__name__ if isinstance(speed, AppliedUndef) else str(speed)


def make_speeds(coordinates: Sequence[Expr], speeds: Sequence[Expr] | None) -> Speeds:
    """Speeds from coordinates (their time derivatives) or from the quasi-velocities the user names."""
    for q in coordinates:
        if not isinstance(q, AppliedUndef):
            raise CaromError(f"coordinates: expected functions of time such as dynamicsymbols('x'), got {q}")
    if len(set(coordinates)) != len(coordinates):
        raise CaromError("coordinates: the same one is given twice")
    names = tuple(speeds) if speeds is not None else tuple(q.diff(TIME) for q in coordinates)
    if not names:
        raise CaromError("coordinates: at least one is needed")
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
    """Refuse a function of time, or a derivative, that is neither a coordinate nor a speed of the problem."""
    rest = speeds.plain(expr)
    if rest.has(sp.zoo, sp.nan, sp.oo):
        raise CaromError(f"{where}: is not finite: {expr}")
    strangers = set(rest.atoms(sp.Derivative)) | (rest.atoms(AppliedUndef) - set(coordinates))
    inside = {f for d in rest.atoms(sp.Derivative) for f in d.atoms(AppliedUndef)}
    strangers -= {f for f in inside if f in coordinates}
    if strangers:
        listed = ", ".join(sorted(str(s) for s in strangers))
        raise CaromError(
            f"{where}: unknown {listed}; expected only the coordinates {list(coordinates)} and their speeds"
        )


def mass_matrix(
    lagrangian: Expr, coordinates: Sequence[Expr], speeds: Speeds, at: Mapping[Expr, Expr]
) -> tuple[Matrix, Matrix]:
    """Mass matrix M and the part b of the momenta that the speeds do not change: p = M u + b.

    Raises CaromError where the Lagrangian is not quadratic in the speeds or M is singular; the latter names the motion
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
) -> Row:
    """A row from an expression that must vanish: of the speeds (Pfaffian) or of the coordinates alone
    (differentiated)."""
    if isinstance(expr, sp.Equality):
        expr = expr.lhs - expr.rhs
    expr = sp.sympify(expr)
    check_known(expr, coordinates, speeds, f"constraint {name}")
    plain = speeds.plain(expr)
    if not plain.has(*speeds.dummies):
        if any(not isinstance(u, sp.Derivative) for u in speeds.names):
            raise CaromError(
                f"constraint {name}: holonomic, but the speeds are quasi-velocities: give its velocity form"
            )
        plain = speeds.plain(sp.diff(expr, TIME))
        if not plain.has(*speeds.dummies):
            raise CaromError(f"constraint {name}: {expr} = 0 says nothing about the coordinates or the speeds")
    coefficients = []
    for u, dummy in zip(speeds.names, speeds.dummies, strict=True):
        c = sp.diff(plain, dummy)
        if c.has(*speeds.dummies) and tidy(c).has(*speeds.dummies):
            raise CaromError(f"constraint {name}: not linear in the speed {u}: {expr}")
        coefficients.append(tidy(c.xreplace(dict(at))))
    drift = tidy(plain.xreplace(dict.fromkeys(speeds.dummies, sp.S.Zero)).xreplace(dict(at)))
    return Row(name, sp.Matrix([coefficients]), drift, closing, expr)


def named(constraints: Mapping[str, Any] | Iterable[Any] | None, prefix: str) -> dict[str, Any]:
    """Constraints under names: the user's own, or ``prefix`` and a count."""
    if constraints is None:
        return {}
    if isinstance(constraints, Mapping):
        return {str(k): v for k, v in constraints.items()}
    if isinstance(constraints, sp.Basic) and not isinstance(constraints, sp.Tuple):
        constraints = [constraints]
    return {f"{prefix} {i + 1}": c for i, c in enumerate(constraints)}
