"""Impacts as corners of a path: the conditions of Weierstrass and Erdmann, with nonholonomic constraints.

A path that meets the surface h(q, t) = 0 has a corner there. By the principle of Lagrange and d'Alembert the variations of the
corner's place respect the constraints A(q) u = 0 and stay on the surface, those of its time shift it along the path, so that

    p1 - p0 = lambda dh + mu A             the momentum jumps within the span of the surface's and the constraints' forms   (C1)
    E1 - E0 = -lambda dh/dt                the energy is kept, up to the work of a surface that moves                       (C2)
    A u1 = 0                               the constraints go on                                                           (C3)

(W. Clark and A. Bloch, "The bouncing penny and nonholonomic impacts", IEEE Conference on Decision and Control 2019,
arXiv:1909.11192; derived here from the principle). Besides lambda = 0, a path that goes on through the surface, they leave
one solution: the velocity that the constraints allow is mirrored, in the metric of the kinetic energy, on the surface's tangent.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from carom.derive.impulsive import ImpulsiveMotion
from carom.derive.percussion import Jump, delassus
from carom.derive.system import (
    ConstraintRow,
    Expr,
    Matrix,
    constraint_row,
    independent_rows,
    is_zero,
    make_speeds,
    named_constraints,
    null_basis,
    reduce_trig,
    tidy,
)
from carom.errors import CaromError, Fault


def corner_conditions(motion: ImpulsiveMotion) -> list[Any]:
    """Return the conditions (C1) to (C3) of a corner of the path, without their multipliers.

    Parameters
    ----------
    motion : ImpulsiveMotion
        Its ``instant`` constraint is the surface: an expression of the coordinates (and the time) that vanishes there. More of
        them at the same instant, such as a contact that does not slip, widen the span in (C1); the conditions are then too few.

    Returns
    -------
    list of Eq
        In the symbols ``motion.speeds.after`` and ``motion.speeds.before``: the momenta along the virtual displacements, the
        constraints that go on, the energy.

    Raises
    ------
    CaromError
        No instant constraint, or several of which one moves.

    Examples
    --------
    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import ImpulsiveMotion, corner_conditions
    >>> m = sp.Symbol("m", positive=True)
    >>> x, y = dynamicsymbols("x y")
    >>> motion = ImpulsiveMotion(m * (x.diff() ** 2 + y.diff() ** 2) / 2, [x, y], instant={"wall": x - 1})
    >>> for equation in corner_conditions(motion):
    ...     print(equation.lhs)
    -m*(ydot0 - ydot1)
    -m*(xdot0**2 - xdot1**2 + ydot0**2 - ydot1**2)/2
    """
    walls = _walls(motion)
    gain = motion.energy(motion.u1) - motion.energy(motion.u0)
    if any(not is_zero(wall.drift) for wall in walls):
        wall = _only(walls)
        gain += wall.drift * (wall.coefficients * (motion.u1 - motion.u0))[0] / _yield(motion, wall)
    return [e for e in motion.jump_equations() if isinstance(e, sp.Equality)] + [sp.Eq(tidy(sp.expand(gain)), 0)]


def corner_jump(motion: ImpulsiveMotion) -> Jump:
    """Return the jump at a corner of the path: the solution of :func:`corner_conditions` in which the surface pushes.

    Parameters
    ----------
    motion : ImpulsiveMotion
        With one ``instant`` constraint, the surface.

    Returns
    -------
    Jump

    Raises
    ------
    CaromError
        Another number of instant constraints, or constraints that allow no motion across the surface.

    Examples
    --------
    A sledge on a blade that meets a wall at an angle: the blade holds, so it goes back the way it came.

    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import ImpulsiveMotion, corner_jump
    >>> m, phi = sp.symbols("m phi", positive=True)
    >>> x, y = dynamicsymbols("x y")
    >>> blade = {"blade": x.diff() * sp.sin(phi) - y.diff() * sp.cos(phi)}
    >>> energy = m * (x.diff() ** 2 + y.diff() ** 2) / 2
    >>> jump = corner_jump(ImpulsiveMotion(energy, [x, y], nonhol_coneqs=blade, instant={"wall": x}))
    >>> jump.after[x.diff()], jump.energy_change
    (-xdot0, 0)
    """
    wall = _only(_walls(motion))
    _yield(motion, wall)
    # (C2) with (C1) and (C3) is lambda (h1' + h0') = 0: with lambda, the gap opens as fast as it closed, as with e = 1
    bounced = copy.copy(motion)
    bounced.imposed = [replace(row, closing=sp.S.One) if row is wall else row for row in motion.imposed]
    return bounced.solve()


def _walls(motion: ImpulsiveMotion) -> list[ConstraintRow]:
    found = [row for row in motion.imposed if row.closing is None]
    if not found:
        raise CaromError(
            Fault(
                "corner", "instant", "the surface that the path meets, as instant={'wall': h}", "no instant constraint"
            )
        )
    return found


def _only(walls: list[ConstraintRow]) -> ConstraintRow:
    if len(walls) > 1:
        raise CaromError(
            Fault(
                "corner", "instant", "one surface", f"{len(walls)}: {', '.join(w.name for w in walls)}",
                "the conditions leave a family of solutions then; close it with ImpulsiveMotion.close(...)",
            )
        )  # fmt: skip
    return walls[0]


def _yield(motion: ImpulsiveMotion, wall: ConstraintRow) -> Expr:
    """Return a . w, the velocity across the surface that a unit impulse along a = dh gives while the constraints hold."""
    found = delassus(motion.mass, [wall], motion.permanent, f"surface {wall.name}")[0, 0]
    if is_zero(found):
        raise CaromError(
            Fault("corner", "instant", "a surface that the constraints let the body approach", f"{wall.name}")
        )
    return found


# ----------------------------------------------------------------------------------------------------
# Test by Frobenius' theorem whether velocity constraints integrate to constraints on the coordinates.
#
# Pfaffian rows A(q) dq = 0 define a distribution D, the velocities that they allow. D is integrable (the constraints are
# holonomic) exactly when it is closed under the Lie bracket. Where it is not, brackets are added until it is: the successive
# ranks are its growth vector, and the number of coordinates minus the last rank is the number of holonomic constraints that the
# rows imply.


@dataclass(frozen=True)
class Integrability:
    """Result of Frobenius' test.

    Attributes
    ----------
    coordinates : tuple
        The coordinates, in order.
    rows : Matrix
        Independent constraint rows A.
    fields : Matrix
        Columns that span D, the velocities that the constraints allow.
    growth : tuple of int
        Rank of D, of D with its brackets, and so on until it stops growing.
    witness : tuple or None
        A pair of columns of ``fields`` whose bracket leaves D, and the row values A [X, Y]; None if there is none.
    closure : Matrix
        Columns that span the smallest integrable distribution that contains D.
    """

    coordinates: tuple[Expr, ...]
    rows: Matrix
    fields: Matrix
    growth: tuple[int, ...]
    witness: tuple[int, int, Matrix] | None
    closure: Matrix

    @property
    def rank(self) -> int:
        """Degrees of freedom that the constraints leave: the rank of D."""
        return self.growth[0]

    @property
    def integrable(self) -> bool:
        """Whether all the constraints are holonomic."""
        return len(self.growth) == 1

    @property
    def holonomic(self) -> int:
        """Number of independent holonomic constraints that follow."""
        return len(self.coordinates) - self.growth[-1]

    @property
    def trivial(self) -> bool:
        """Whether D is integrable whatever the constraints are, because its rank is 0 or 1."""
        return self.rank <= 1

    def sentence(self) -> str:
        """Return the result as a sentence."""
        n, k = len(self.coordinates), self.rank
        if self.trivial:
            why = (
                "one degree of freedom is left, and every distribution of rank 1 is integrable"
                if k
                else "no freedom is left"
            )
            return f"integrable, trivially: {why} ({n - k} constraints on {n} coordinates)"
        if self.integrable:
            return f"integrable: rank {k} of {n} and closed under brackets, {self.holonomic} holonomic constraints"
        return (
            f"not integrable: the ranks grow {' -> '.join(map(str, self.growth))} on {n} coordinates; "
            f"{self.holonomic} of {n - k} constraints are holonomic"
        )


def lie_bracket(x: Matrix, y: Matrix, coordinates: Sequence[Expr]) -> Matrix:
    """Return the Lie bracket [X, Y] of two vector fields given as columns over ``coordinates`` (plain symbols)."""
    return (y.jacobian(list(coordinates)) * x - x.jacobian(list(coordinates)) * y).applyfunc(reduce_trig)


def frobenius(constraints: Mapping[str, Expr] | Iterable[Expr], coordinates: Sequence[Expr]) -> Integrability:
    """Apply Frobenius' test to constraints that are linear in the speeds, for the given coordinates (``dynamicsymbols``).

    The ranks are those at a generic configuration. Raises CaromError for a constraint that is not linear and homogeneous in the
    speeds (with a term free of speeds, make time a coordinate first), or where no constraint is given.
    """
    speeds = make_speeds(coordinates, None)
    rows = [
        constraint_row(n, c, tuple(coordinates), speeds, {})
        for n, c in named_constraints(constraints, "constraint").items()
    ]
    if not rows:
        raise CaromError("frobenius: constraints: expected at least one, got no constraint")
    for row in rows:
        if not is_zero(row.drift):
            raise CaromError(f"constraint {row.name}: has the term {row.drift} free of speeds; make time a coordinate")
    plain = {q: sp.Symbol(q.func.__name__, real=True) for q in coordinates}
    symbols = [plain[q] for q in coordinates]
    table = sp.Matrix.vstack(*[r.coefficients for r in rows]).xreplace(plain)
    kept, _ = independent_rows(table)
    table = table.extract(kept, list(range(table.cols)))
    fields = null_basis(table)
    growth = [fields.cols]
    closure, layer = fields, fields
    witness: tuple[int, int, Matrix] | None = None
    while layer.cols and closure.cols < len(symbols):
        news = []
        for i in range(fields.cols):
            for j in range(layer.cols):
                if layer is fields and j <= i:
                    continue
                bracket = lie_bracket(fields[:, i], layer[:, j], symbols)
                leaves = (table * bracket).applyfunc(tidy)
                if layer is fields and witness is None and any(not is_zero(v) for v in leaves):
                    witness = (i, j, leaves)
                news.append(bracket)
        if not news:
            break
        wide = sp.Matrix.hstack(closure, *news)
        independent, _ = independent_rows(wide.T)
        fresh = [k for k in independent if k >= closure.cols]
        if not fresh:
            break
        layer = wide.extract(list(range(wide.rows)), fresh)
        closure = sp.Matrix.hstack(closure, layer)
        growth.append(closure.cols)
    return Integrability(tuple(symbols), table, fields, tuple(growth), witness, closure)


def _library(coordinates: Sequence[Expr], degree: int) -> list[Expr]:
    """Return products of coordinates, sines and cosines up to a degree, at most one factor per coordinate."""
    factors = [[sp.S.One, q, sp.sin(q), sp.cos(q)] for q in coordinates]
    terms = {sp.S.One}
    for choices in factors:
        terms |= {t * f for t in terms for f in choices[1:] if _degree(t) < degree}
    return sorted(terms - {sp.S.One}, key=lambda t: (_degree(t), sp.count_ops(t), str(t)))


def _degree(term: Expr) -> int:
    return 0 if term == 1 else len(sp.Mul.make_args(term))


def first_integrals(test: Integrability, degree: int = 2) -> list[Expr]:
    """Return functions of the coordinates that are constant along every velocity that the constraints allow.

    The search covers linear combinations of products of coordinates, sines and cosines up to ``degree``. Each one found is
    verified: its derivative along the closure of D is identically zero. At most ``test.holonomic`` functionally independent ones
    exist; fewer may be found, since the search space is finite.
    """
    terms = _library(test.coordinates, degree)
    rows = []
    for k in range(test.closure.cols):
        field = test.closure[:, k]
        common = sp.lcm_list([sp.fraction(reduce_trig(x))[1] for x in field])
        cleared = [reduce_trig(x * common) for x in field]
        rates = [
            reduce_trig(sum((sp.diff(t, q) * c for q, c in zip(test.coordinates, cleared, strict=True)), sp.S.Zero))
            for t in terms
        ]
        rows += _coefficient_rows(rates)
    if not rows:
        return list(test.coordinates)[: test.holonomic]
    space = sp.Matrix(rows).nullspace()
    found: list[Expr] = []
    jacobian = sp.zeros(0, len(test.coordinates))
    for vector in space:
        candidate = sum((c * t for c, t in zip(vector, terms, strict=True)), sp.S.Zero)
        gradient = sp.Matrix([[sp.diff(candidate, q) for q in test.coordinates]])
        if not all(is_zero(x) for x in (gradient * test.closure)):
            continue
        wide = sp.Matrix.vstack(jacobian, gradient)
        if len(independent_rows(wide)[0]) == wide.rows:
            jacobian = wide
            found.append(candidate)
        if len(found) == test.holonomic:
            break
    return found


def _coefficient_rows(rates: Sequence[Expr]) -> list[list[Expr]]:
    """Return the linear conditions on the coefficients c_i: every monomial of the sum of c_i rates_i must vanish."""
    common = sp.lcm_list([sp.fraction(sp.together(r))[1] for r in rates])
    numerators = [sp.expand(sp.cancel(r * common)) for r in rates]
    table: dict[Expr, dict[int, Expr]] = {}
    gens = sorted({g for n in numerators for g in (n.atoms(sp.sin, sp.cos) | n.free_symbols)}, key=str)
    for i, n in enumerate(numerators):
        if n == 0:
            continue
        variable = [g for g in gens if not (g.is_Symbol and g.is_positive)]  # parameters are positive symbols
        poly = sp.Poly(n, *variable)
        for monomial, coefficient in poly.terms():
            table.setdefault(monomial, {})[i] = coefficient
    return [[row.get(i, sp.S.Zero) for i in range(len(rates))] for row in table.values()]
