"""Virtual displacements in the speeds that one asks for, and what becomes of them where these fail."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy as sp

from carom.derive.linear import Expr, Matrix, is_zero, null_basis, reduce_trig, tidy
from carom.errors import CaromError

__all__ = ["basis", "limit"]


def basis(names: Sequence[Expr], columns: Matrix, independent: Sequence[Expr] | None) -> Matrix:
    """Columns that span what is perpendicular to ``columns`` (one row a speed), with ``independent`` speeds as parameters."""
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


def limit(column: Matrix, towards: Mapping[Expr, Expr]) -> Matrix:
    """Direction of a displacement where its components have poles: cleared of its denominators it has a limit."""
    together = [sp.fraction(reduce_trig(x)) for x in column]
    common = sp.S.One
    for _, below in together:
        common = sp.lcm(common, below)
    cleared = [tidy(above * common / below) for above, below in together]
    found = sp.Matrix([tidy(x.xreplace(dict(towards))) for x in cleared])
    if all(is_zero(x) for x in found):
        raise CaromError("displacement limit: every component vanishes there; take another independent speed")
    return found
