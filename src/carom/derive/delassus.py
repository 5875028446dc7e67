"""The inverse mass that a contact feels (Delassus operator), and what follows from it.

That is: the gain of normal velocity while the contact slides, the friction coefficient above which it jams, the energy that
Newton's rule takes from a sticking contact, and the conditions under which a contact's assumed mode is valid.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence

import sympy as sp

from carom.derive.constraints import Contact
from carom.derive.jump import FrictionJam
from carom.derive.linear import Expr, Matrix, is_zero, solve_linear, tidy
from carom.derive.solvers import split_rows
from carom.derive.system import ConstraintRow

__all__ = ["contact_conditions", "delassus", "jam_friction", "newton_minors", "slide_gain"]


def delassus(mass: Matrix, contact: Sequence[ConstraintRow], held: Sequence[ConstraintRow], where: str) -> Matrix:
    """Return the inverse mass G of a contact while the ``held`` constraints stay satisfied: du = G dp.

    Rows and columns: normal, then tangents; symmetric, kg^-1 for velocities in m/s. ``where`` names the contact in errors.
    """
    n = mass.rows
    own = sp.Matrix.vstack(*[r.coefficients for r in contact])
    kept, _ = split_rows(held)
    table = sp.zeros(n + len(kept), n + len(kept))
    table[:n, :n] = mass
    if kept:
        block = sp.Matrix.vstack(*[held[i].coefficients for i in kept])
        table[n:, :n] = block
        table[:n, n:] = block.T
    right = sp.zeros(n + len(kept), own.rows)
    right[:n, :] = own.T
    return (own * solve_linear(table, right, where)[:n, :]).applyfunc(tidy)


def slide_gain(inverse_mass: Matrix, friction: Expr, slip: Sequence[Expr]) -> Expr:
    """Return d u_n / d p of a contact that slides along ``slip``; where it is not positive the contact jams (Painlevé)."""
    g = inverse_mass
    return tidy(g[0, 0] - friction * sum((g[0, i + 1] * s for i, s in enumerate(slip)), sp.S.Zero))


def contact_conditions(
    contact: Contact, mode: str, approach: Expr, impulses: dict[str, Expr], slip: Sequence[Expr], gain: Expr | None
) -> dict[str, Expr]:
    """Return the relations under which a contact's mode ("stick", "slide", "smooth", "open") is valid.

    ``approach`` is the normal velocity just before. For a sliding contact ``slip`` is the unit direction of its slip, ``gain``
    its :func:`slide_gain`, and its tangential impulses are added to ``impulses``.
    """
    if mode == "open":
        return {}
    name, push = contact.name, impulses[f"{contact.name}.n"]
    found = {f"{name} approaches": sp.Lt(approach, 0)}
    found[f"{name} pushes"] = sp.Ge(push, 0)
    if mode == "stick" and contact.friction != sp.oo:
        drag = tidy(sum((impulses[f"{name}.t{i + 1}"] ** 2 for i in range(len(contact.tangents))), sp.S.Zero))
        found[f"{name} cone"] = sp.Le(drag, tidy(contact.friction**2 * push**2))  # (29)
    if gain is not None:
        for i, s in enumerate(slip):
            impulses[f"{name}.t{i + 1}"] = tidy(-contact.friction * s * push)
        found[f"{name} does not jam"] = sp.Gt(gain, 0)
        if gain.is_nonpositive:
            warnings.warn(
                f"contact {name}: friction {contact.friction} jams the slip (d u_n / d p = {gain}); "
                "follow it with percussion(...)",
                FrictionJam,
                stacklevel=4,
            )
    return found


def jam_friction(inverse_mass: Matrix) -> Expr:
    """Return the friction coefficient above which some slip jams (Painlevé), G_nn / |G_nt|; oo where none does."""
    g = inverse_mass
    if all(is_zero(g[0, i]) for i in range(1, g.cols)):
        return sp.oo
    cross = sp.Abs(g[0, 1]) if g.cols == 2 else sp.sqrt(sum((g[0, i] ** 2 for i in range(1, g.cols)), sp.S.Zero))
    return g[0, 0] / cross


def newton_minors(inverse_mass: Matrix, contact: Contact) -> list[Expr]:
    """Return the leading minors of the energy loss of a sticking contact under Newton's rule, as a quadratic form.

    With u the contact's velocity before, the loss is u^T Q u / 2, Q the symmetric part of (1 + E) G^-1 (1 - E),
    E = diag(e, beta, beta). If a minor is negative, some velocities gain energy (Kane and Levinson's observation).
    """
    g = inverse_mass
    e = sp.diag(contact.restitution, *[contact.tangential_restitution] * len(contact.tangents))
    one = sp.eye(g.rows)
    loss = (one + e) * solve_linear(g, one, f"contact {contact.name}") * (one - e)
    loss = (loss + loss.T) / 2
    return [tidy(loss[:k, :k].det()) for k in range(1, g.rows + 1)]
