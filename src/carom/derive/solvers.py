"""Solve for a jump by two independent methods: virtual displacements, and impulse and momentum with Lagrange multipliers.

Both take the mass matrix, the speeds just before, the acting constraint rows and the directions of their impulses. They share
no intermediate result, and the tests compare them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from carom.derive.linear import Expr, Matrix, bound_columns, independent_rows, is_zero, null_basis, solve_linear, tidy
from carom.derive.system import ConstraintRow
from carom.errors import CaromError

Redundant = dict[str, dict[str, Expr]]


@dataclass(frozen=True)
class Instant:
    """The impulsive problem: mass matrix, speeds just before, acting rows, directions of their impulses, known impulse."""

    mass: Matrix
    u0: Matrix
    rows: list[ConstraintRow]
    columns: Matrix
    impulse: Matrix

    def value(self, row: ConstraintRow) -> Expr:
        """Return the velocity of a row just before."""
        return value_of(row, self.u0)


def value_of(row: ConstraintRow, speeds: Matrix) -> Expr:
    """Return the velocity that a constraint row measures, for given speeds."""
    return tidy((row.coefficients * speeds)[0] + row.drift)


def split_rows(rows: Sequence[ConstraintRow]) -> tuple[list[int], Redundant]:
    """Return the indices of independent rows, and each redundant row's name with the combination that implies it.

    Raises CaromError where a row depends on others but asks for another value.
    """
    if not rows:
        return [], {}
    kept, dependent = independent_rows(sp.Matrix.vstack(*[r.coefficients for r in rows]))
    redundant = {}
    for i, how in dependent.items():
        said = {rows[j].name: c for j, c in how.items()}
        gap = rows[i].drift - sum((c * rows[j].drift for j, c in how.items()), sp.S.Zero)
        if not is_zero(gap):
            raise CaromError(f"constraints: {rows[i].name} contradicts {', '.join(said) or '0 = 0'}")
        redundant[rows[i].name] = said
    return kept, redundant


def targets(at: Instant, kept: list[int], redundant: Mapping[str, Mapping[str, Expr]]) -> dict[int, Expr]:
    """Return the velocity along each kept row just after; redundant rows must ask for the same."""
    rows = at.rows
    wants = {
        i: -r.drift if r.closing == 0 else -r.drift - r.closing * at.value(r)
        for i, r in enumerate(rows)
        if r.closing is not None
    }
    by_name = {r.name: i for i, r in enumerate(rows)}
    for name, how in redundant.items():
        i = by_name[name]
        if i not in wants or any(by_name[n] not in wants for n in how):
            continue
        gap = wants[i] - sum((c * wants[by_name[n]] for n, c in how.items()), sp.S.Zero)
        if not is_zero(gap):
            raise CaromError(
                f"constraints: {name} follows from {', '.join(how)}, but their restitution asks for another velocity "
                f"afterwards (they differ by {tidy(gap)})"
            )
    return {i: wants[i] for i in kept if i in wants}


def solve_by_displacements(at: Instant) -> Matrix:
    """Return the speeds just after: momenta along virtual displacements are conserved, and restitution closes the rest."""
    rows = at.rows
    kept, redundant = split_rows(rows)
    wanted = targets(at, kept, redundant)
    basis = null_basis(at.columns.T)
    left = [basis.T * at.mass] + [rows[i].coefficients for i in sorted(wanted)]
    right = [basis.T * (at.mass * at.u0 + at.impulse)] + [sp.Matrix([wanted[i]]) for i in sorted(wanted)]
    matrix = sp.Matrix.vstack(*left)
    if matrix.rows != matrix.cols:
        loose = [rows[i].name for i in kept if i not in wanted]
        raise CaromError(
            f"jump: expected a closing equation for every acting constraint, got none for {', '.join(loose)}; give "
            "its restitution or call close(...)"
        )
    return solve_linear(matrix, sp.Matrix.vstack(*right), "jump equations")


def solve_by_multipliers(at: Instant) -> tuple[Matrix, dict[str, Expr]]:
    """Return the speeds just after and the impulses: M (u1 - u0) = sum of impulses, with restitution as closing equations."""
    rows = at.rows
    kept, redundant = split_rows(rows)
    wanted = targets(at, kept, redundant)
    if len(wanted) < len(kept):
        loose = [rows[i].name for i in kept if i not in wanted]
        raise CaromError(
            f"jump: expected a closing equation for every acting constraint, got none for {', '.join(loose)}; give "
            "its restitution or call close(...)"
        )
    n, r = at.mass.rows, len(kept)
    push = at.columns.extract(list(range(n)), kept)
    table = sp.zeros(n + r, n + r)
    table[:n, :n] = at.mass
    right = sp.zeros(n + r, 1)
    right[:n, 0] = at.mass * at.u0 + at.impulse
    if r:
        table[:n, n:] = -push
        table[n:, :n] = sp.Matrix.vstack(*[rows[i].coefficients for i in kept])
        right[n:, 0] = sp.Matrix([wanted[i] for i in kept])
    found = solve_linear(table, right, "impulse and momentum")
    return found[:n, :], {rows[i].name: found[n + k] for k, i in enumerate(kept)}


def impulses_of(at: Instant, kept: list[int], u1: Matrix) -> dict[str, Expr]:
    """Return the impulses of a known jump: the multipliers whose sum is the change of momentum."""
    if not kept:
        return {}
    rows = at.rows
    push = at.columns.extract(list(range(at.mass.rows)), kept)
    change = at.mass * (u1 - at.u0) - at.impulse
    pick, _ = independent_rows(push)
    found = solve_linear(push.extract(pick, list(range(len(kept)))), change.extract(pick, [0]), "impulses")
    for gap in push * found - change:
        if not is_zero(gap):
            raise CaromError(
                "jump: the speeds afterwards require an impulse along a displacement that no constraint resists"
            )
    return {rows[i].name: found[k] for k, i in enumerate(kept)}


def relations_before(held: Sequence[ConstraintRow], before: Sequence[Expr]) -> dict[Expr, Expr]:
    """Return the speeds just before that the constraints held until then determine, in terms of the other speeds."""
    if not held:
        return {}
    rows = sp.Matrix.vstack(*[r.coefficients for r in held])
    kept, dependent = independent_rows(rows)
    for i, how in dependent.items():
        gap = held[i].drift - sum((c * held[j].drift for j, c in how.items()), sp.S.Zero)
        if not is_zero(gap):
            raise CaromError(
                f"constraints: {held[i].name} contradicts {', '.join(held[j].name for j in how) or 'itself'}"
            )
    system = rows.extract(kept, list(range(rows.cols)))
    bound = bound_columns(system)
    loose = [j for j in range(rows.cols) if j not in bound]
    right = -sp.Matrix([held[i].drift for i in kept])
    if loose:
        right -= system.extract(list(range(len(kept))), loose) * sp.Matrix([before[j] for j in loose])
    found = solve_linear(system.extract(list(range(len(kept))), bound), right, "constraints before the instant")
    return {before[j]: found[i] for i, j in enumerate(bound)}


def prescribe_poisson_impulses(
    at: Instant, restitution: Mapping[str, Expr], contacts: set[str]
) -> tuple[Instant, dict[str, Expr]]:
    """Apply Poisson's rule: solve compression, then prescribe (1 + e) times its normal impulses as known impulses.

    ``restitution`` maps the normal rows to e; the rows of all ``contacts`` are held during compression. Return the remaining
    problem and the prescribed impulses.
    """
    ends = [replace(r, closing=sp.S.Zero) if r.name.split(".")[0] in contacts else r for r in at.rows]
    _, squeeze = solve_by_multipliers(replace(at, rows=ends))
    impulse, known, keep = at.impulse, dict[str, Expr](), []
    for i, row in enumerate(at.rows):
        if row.name in restitution:
            if row.name not in squeeze:
                raise CaromError(f"contact {row.name}: redundant, so Poisson's rule does not determine its impulse")
            known[row.name] = tidy((1 + restitution[row.name]) * squeeze[row.name])
            impulse = impulse + at.columns[:, i] * known[row.name]
        else:
            keep.append(i)
    columns = at.columns.extract(list(range(at.mass.rows)), keep)
    return replace(at, rows=[at.rows[i] for i in keep], columns=columns, impulse=impulse), known
