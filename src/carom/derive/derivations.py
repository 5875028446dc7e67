"""The two derivations of a jump: along virtual displacements, and by impulse and momentum with multipliers.

Both take the mass matrix, the speeds just before, the acting rows and the directions of their impulses, and nothing of
each other; the tests hold one against the other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from carom.derive.linear import Expr, Matrix, independent_rows, is_zero, null_basis, solve_linear, tidy
from carom.derive.setup import Row
from carom.errors import CaromError

Redundant = dict[str, dict[str, Expr]]


@dataclass(frozen=True)
class Instant:
    """The instant's problem: mass matrix, speeds just before, acting rows, their impulses' directions, known
    impulse."""

    mass: Matrix
    u0: Matrix
    rows: list[Row]
    columns: Matrix
    impulse: Matrix

    def value(self, row: Row) -> Expr:
        """Velocity of a row just before."""
        return value_of(row, self.u0)


def value_of(row: Row, speeds: Matrix) -> Expr:
    """Velocity that a row measures, for given speeds."""
    return tidy((row.coefficients * speeds)[0] + row.drift)


def split_rows(rows: list[Row]) -> tuple[list[int], Redundant]:
    """Indices of independent rows, and each other row's name with the combination that says the same.

    Raises CaromError where a row says the same as others but wants another value.
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
    """Velocity along each kept row just after; redundant rows must want the same."""
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


def by_virtual(at: Instant) -> Matrix:
    """Speeds just after: momenta along virtual displacements do not jump, and the closing equations."""
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
            f"jump: {matrix.cols - matrix.rows} closing equation(s) are missing, for {', '.join(loose)}; give "
            "their restitution or call close(...)"
        )
    return solve_linear(matrix, sp.Matrix.vstack(*right), "jump equations")


def by_multipliers(at: Instant) -> tuple[Matrix, dict[str, Expr]]:
    """Speeds just after and impulses: M (u1 - u0) = sum of impulses, and the closing equations."""
    rows = at.rows
    kept, redundant = split_rows(rows)
    wanted = targets(at, kept, redundant)
    if len(wanted) < len(kept):
        loose = [rows[i].name for i in kept if i not in wanted]
        raise CaromError(f"jump: closing equations are missing for {', '.join(loose)}")
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
    """Impulses from a known jump: the multipliers that make up the change of momentum."""
    if not kept:
        return {}
    rows = at.rows
    push = at.columns.extract(list(range(at.mass.rows)), kept)
    change = at.mass * (u1 - at.u0) - at.impulse
    pick, _ = independent_rows(push)
    found = solve_linear(push.extract(pick, list(range(len(kept)))), change.extract(pick, [0]), "impulses")
    for gap in push * found - change:
        if not is_zero(gap):
            raise CaromError("jump: the speeds afterwards ask for an impulse along a displacement that is free")
    return {rows[i].name: found[k] for k, i in enumerate(kept)}
