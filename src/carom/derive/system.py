"""Lagrangians and constraints as matrices: mass matrix, speeds, constraint rows; linear algebra with sines and cosines."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

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


# ----------------------------------------------------------------------------------------------------
# Linear algebra over trigonometric expressions: zero test, independent rows, null space, linear solver.
#
# SymPy's own elimination treats ``sin(q)`` and ``cos(q)`` as independent, so a pivot such as ``sin(q)**2 + cos(q)**2 -
# 1`` would be accepted as a divisor. Every pivot here is checked with `is_zero` first.

Expr = Any
Matrix = Any

# Numerators of generic rationals at which an expression is evaluated: one that does not vanish there is certainly not zero.
_PRIMES = (101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193, 197, 199, 211)


def atoms_of(expr: Expr) -> list[Expr]:
    """Return the symbols, unknown functions and derivatives in ``expr``, in a fixed order; time only where it occurs by itself."""
    derivatives = expr.atoms(sp.Derivative)
    rest = expr.xreplace(dict.fromkeys(derivatives, sp.S.One))
    functions = rest.atoms(AppliedUndef)
    rest = rest.xreplace(dict.fromkeys(functions, sp.S.One))
    found = derivatives | functions | rest.free_symbols
    return sorted(found, key=lambda a: (not isinstance(a, sp.Derivative), not isinstance(a, AppliedUndef), str(a)))


def probe(expr: Expr, turn: int = 0) -> Expr:
    """Evaluate ``expr`` to 30 digits at a fixed generic point; ``turn`` selects the point."""
    names = atoms_of(expr)
    values = {
        name: sp.Rational(_PRIMES[(i * 5 + 3 * turn + 1) % len(_PRIMES)] + 7 * (i // len(_PRIMES)), 211 + 16 * turn + i)
        for i, name in enumerate(names)
    }
    return expr.xreplace(values).evalf(30, chop=False)


def is_zero(expr: Expr) -> bool:
    """Return whether ``expr`` is identically zero, trigonometric identities included.

    A nonzero value at one of three generic points disproves it. Rational functions of symbols, sines and cosines are then
    decided exactly; with roots or inverse functions, zero to 20 digits at the three points counts as zero.
    """
    expr = sp.sympify(expr)
    return bool(expr == 0) if expr.is_Number else _vanishes(expr)


@lru_cache(maxsize=4096)
def _vanishes(expr: Expr) -> bool:
    for turn in (0, 1, 2):
        value = probe(expr, turn)
        if value.is_number and value.is_finite and abs(value) > sp.Float("1e-20", 30):
            return False
    if expr.atoms(sp.Function) - expr.atoms(sp.sin, sp.cos, sp.tan, sp.cot, AppliedUndef):
        return True
    if any(not w.exp.is_Integer for w in expr.atoms(sp.Pow)):
        return True
    return bool(reduce_trig(expr) == 0)


def _without_squares(c: Expr, s: Expr, n: Expr) -> Expr:
    """Return ``c**n`` for an integer n with c^2 written as 1 - s^2."""
    half, odd = divmod(abs(int(n)), 2)
    return ((1 - s**2) ** half * c**odd) ** sp.sign(n)


@cache
def _letter(i: int, **kind: bool) -> Expr:
    """Return the symbol that stands for the i-th sine or cosine, root or sign while an expression is reduced."""
    return sp.Dummy(**kind)


def reduce_trig(expr: Expr, keep: str = "sin") -> Expr:
    """Return ``expr`` over one denominator, with even powers of cosines written in sines (or the reverse): nearly a normal form.

    Tangents, cotangents and multiple angles are expanded first, so that cos^2 + sin^2 = 1 is the only relation left.
    """
    expr = sp.sympify(expr)
    return expr if expr.is_Atom else _reduced(expr, keep)


@lru_cache(maxsize=4096)
def _reduced(expr: Expr, keep: str) -> Expr:
    if expr.atoms(sp.tan, sp.cot, sp.sec, sp.csc):
        expr = expr.replace(sp.tan, lambda q: sp.sin(q) / sp.cos(q)).replace(sp.cot, lambda q: sp.cos(q) / sp.sin(q))
        expr = expr.replace(sp.sec, lambda q: 1 / sp.cos(q)).replace(sp.csc, lambda q: 1 / sp.sin(q))
    angles = {f.args[0] for f in expr.atoms(sp.sin, sp.cos)}
    if any(not q.is_Symbol and not isinstance(q, AppliedUndef) for q in angles):
        expr = sp.expand_trig(expr)
        angles = {f.args[0] for f in expr.atoms(sp.sin, sp.cos)}
    if not angles:
        return sp.cancel(expr)
    # a root, sign or modulus of an angle is replaced by a dummy until the end
    odd = {w for w in expr.atoms(sp.Pow) if w.exp.is_Rational and w.exp.q == 2 and w.has(*angles)}
    others = {w for w in expr.atoms(sp.sign, sp.Abs) if w.has(*angles)}
    roots = sorted({w.base for w in odd}, key=str)
    back = {_letter(i, positive=True): sp.sqrt(base) for i, base in enumerate(roots)}
    back |= {_letter(i, real=True): w for i, w in enumerate(sorted(others, key=str))}
    forth = {w: d for d, w in back.items()}
    expr = expr.xreplace({w: forth[sp.sqrt(w.base)] ** (2 * w.exp) for w in odd} | {w: forth[w] for w in others})
    waves = [f(q) for q in sorted(angles, key=str) for f in (sp.sin, sp.cos)]
    names = {wave: _letter(i) for i, wave in enumerate(waves)}
    first, second = (sp.sin, sp.cos) if keep == "sin" else (sp.cos, sp.sin)
    sine_of = {names[second(q)]: names[first(q)] for q in angles}
    value = sp.cancel(expr.xreplace(names))
    for _ in range(2):  # a cancellation after the first pass may free another square
        # (what has been cancelled is expanded: powers of a cosine stand by themselves)
        powers = {w: w.exp for w in value.atoms(sp.Pow) if w.base in sine_of and abs(w.exp) > 1}
        if not powers:
            break
        value = sp.cancel(value.xreplace({w: _without_squares(w.base, sine_of[w.base], n) for w, n in powers.items()}))
    return value.xreplace(back).xreplace({v: k for k, v in names.items()})


def tidy(expr: Expr) -> Expr:
    """Return a short form of ``expr``: factored where it is rational, with sines and cosines reduced and collected."""
    expr = sp.sympify(expr)
    return expr if expr.is_Atom or expr.is_Matrix else _tidied(expr)


@lru_cache(maxsize=4096)
def _tidied(expr: Expr) -> Expr:
    if not expr.atoms(sp.sin, sp.cos, sp.tan, sp.cot):
        return sp.factor(sp.cancel(expr))
    forms = dict.fromkeys(reduce_trig(expr, keep) for keep in ("sin", "cos"))
    return min((sp.factor(form) for form in forms), key=sp.count_ops)


def independent_rows(rows: Matrix) -> tuple[list[int], dict[int, dict[int, Expr]]]:
    """Return the indices of a maximal set of independent rows, and each other row as a combination of them.

    The result is ``(kept, dependent)`` with ``dependent[i] = {j: c_j}`` meaning row i = sum of c_j times row j, j in kept.
    """
    kept: list[int] = []
    dependent: dict[int, dict[int, Expr]] = {}
    reduced: list[tuple[int, list[Expr], dict[int, Expr]]] = []  # (pivot column, row, its combination of kept rows)
    for i in range(rows.rows):
        row = [sp.sympify(x) for x in rows.row(i)]
        combination: dict[int, Expr] = {}
        for column, base, how in reduced:
            factor = row[column]
            if factor == 0:
                continue
            row = [reduce_trig(x - factor * b) for x, b in zip(row, base, strict=True)]
            row[column] = sp.S.Zero
            for j, c in how.items():
                combination[j] = combination.get(j, sp.S.Zero) + factor * c
        pivot = next((k for k, x in enumerate(row) if not is_zero(x)), None)
        if pivot is None:
            dependent[i] = {j: tidy(c) for j, c in combination.items() if not is_zero(c)}
            continue
        scale = row[pivot]
        row = [reduce_trig(x / scale) for x in row]
        how_new = {j: -c / scale for j, c in combination.items()}
        how_new[i] = 1 / scale
        reduced.append((pivot, row, how_new))
        kept.append(i)
    return kept, dependent


def solve_linear(matrix: Matrix, right: Matrix, what: str = "linear equations") -> Matrix:
    """Solve ``matrix x = right`` by elimination with a symbolic zero test on every pivot.

    ``right`` may have several columns. Raises CaromError, naming ``what``, when the square matrix is singular.
    """
    size = matrix.rows
    table = [[sp.sympify(x) for x in list(matrix.row(i)) + list(right.row(i))] for i in range(size)]
    for k in range(size):
        choices = [i for i in range(k, size) if not is_zero(table[i][k])]
        if not choices:
            raise CaromError(f"{what}: singular (no pivot in column {k + 1} of {size})")
        best = min(choices, key=lambda i: sp.count_ops(table[i][k]))
        table[k], table[best] = table[best], table[k]
        pivot = table[k][k]
        table[k] = [reduce_trig(x / pivot) for x in table[k]]
        for i in range(size):
            factor = table[i][k]
            if i == k or factor == 0:
                continue
            table[i] = [reduce_trig(x - factor * y) for x, y in zip(table[i], table[k], strict=True)]
            table[i][k] = sp.S.Zero
    return sp.Matrix([[tidy(x) for x in row[size:]] for row in table])


def null_basis(rows: Matrix, free: Sequence[int] | None = None) -> Matrix:
    """Return columns that span the null space of ``rows``; ``free`` selects the columns to keep as parameters.

    Raises CaromError where the selected columns cannot parametrise the null space.
    """
    kept, _ = independent_rows(rows)
    system = rows.extract(kept, list(range(rows.cols))) if kept else sp.zeros(0, rows.cols)
    wanted = rows.cols - len(kept)
    bound = bound_columns(system, free or ())
    loose = [j for j in range(rows.cols) if j not in bound]
    if free is not None and set(loose) != set(free):
        raise CaromError(
            f"independent speeds: columns {sorted(free)} leave the constraints singular; possible: {loose}"
        )
    basis = sp.zeros(rows.cols, wanted)
    if kept:
        part = solve_linear(
            system.extract(list(range(len(kept))), bound), -system.extract(list(range(len(kept))), loose)
        )
        for i, j in enumerate(bound):
            basis[j, :] = part[i, :]
    for k, j in enumerate(loose):
        basis[j, k] = sp.S.One
    return basis


def bound_columns(system: Matrix, avoid: Sequence[int] = ()) -> list[int]:
    """Return the columns that independent rows determine in terms of the others: those outside ``avoid`` first, the last first."""
    if not system.rows:
        return []
    order = sorted(range(system.cols), key=lambda j: (j in avoid, -j))
    kept, _ = independent_rows(system.extract(list(range(system.rows)), order).T)
    return sorted(order[i] for i in kept)
