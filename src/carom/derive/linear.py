"""Linear algebra over trigonometric expressions: zero test, independent rows, null space, linear solver.

SymPy's own elimination treats ``sin(q)`` and ``cos(q)`` as independent, so a pivot such as ``sin(q)**2 + cos(q)**2 -
1`` would be accepted as a divisor. Every pivot here is checked with `is_zero` first.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from carom.errors import CaromError

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
