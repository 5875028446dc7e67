"""What a contact of a whole system feels: its inverse mass, the friction that jams it, the energy Newton's rule
creates."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import sympy as sp

from carom.derive.cautions import FrictionJam
from carom.derive.derivations import split_rows, value_of
from carom.derive.linear import Expr, Matrix, is_zero, solve_linear, tidy
from carom.derive.percussion import Percussion, follow
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.derive.contact import Contact
    from carom.derive.impulsive import ImpulsiveMotion

__all__ = ["conditions", "delassus", "jam_friction", "newton_minors", "percussion", "slide_gain"]


def delassus(motion: ImpulsiveMotion, name: str) -> Matrix:
    """Inverse mass seen by a contact, with the permanent and imposed constraints held: du = G dp.

    Rows and columns: normal, then tangents; symmetric, kg^-1 for velocities in m/s.
    """
    _, rows = motion.contact(name)
    n = motion.speeds.count
    own = sp.Matrix.vstack(*[r.coefficients for r in rows])
    held = [*motion.permanent, *motion.imposed]
    kept, _ = split_rows(held)
    table = sp.zeros(n + len(kept), n + len(kept))
    table[:n, :n] = motion.mass
    if kept:
        block = sp.Matrix.vstack(*[held[i].coefficients for i in kept])
        table[n:, :n] = block
        table[:n, n:] = block.T
    right = sp.zeros(n + len(kept), own.rows)
    right[:n, :] = own.T
    return (own * solve_linear(table, right, f"contact {name}")[:n, :]).applyfunc(tidy)


def slide_gain(motion: ImpulsiveMotion, name: str) -> Expr:
    """d u_n / d p while the contact slides: where it is not positive, pushing brings the bodies closer (Painlevé)."""
    contact, _ = motion.contact(name)
    g = delassus(motion, name)
    return tidy(g[0, 0] - contact.friction * sum((g[0, i + 1] * s for i, s in enumerate(motion.slip(name))), sp.S.Zero))


def conditions(motion: ImpulsiveMotion, contact: Contact, impulses: dict[str, Expr], mode: str) -> dict[str, Expr]:
    """Relations that must hold for the contact's mode; where it slides, ``impulses`` gets its tangential ones."""
    if mode == "open":
        return {}
    name, push = contact.name, impulses[f"{contact.name}.n"]
    found = {f"{name} approaches": sp.Lt(value_of(motion.contact_rows[name][0], motion.u0), 0)}
    found[f"{name} pushes"] = sp.Ge(push, 0)
    if mode == "stick" and contact.friction != sp.oo:
        drag = tidy(sum((impulses[f"{name}.t{i + 1}"] ** 2 for i in range(len(contact.tangents))), sp.S.Zero))
        found[f"{name} cone"] = sp.Le(drag, tidy(contact.friction**2 * push**2))  # (29)
    if mode == "slide":
        for i, s in enumerate(motion.slip(name)):
            impulses[f"{name}.t{i + 1}"] = tidy(-contact.friction * s * push)
        gain = slide_gain(motion, name)
        found[f"{name} does not jam"] = sp.Gt(gain, 0)
        if gain.is_nonpositive:
            warnings.warn(
                f"contact {name}: friction {contact.friction} jams the slip (d u_n / d p = {gain}); "
                "follow it with percussion(...)",
                FrictionJam,
                stacklevel=4,
            )
    return found


def jam_friction(motion: ImpulsiveMotion, name: str) -> Expr:
    """Friction above which some slip of this contact jams (Painlevé): G_nn / |G_nt|; oo where none does."""
    g = delassus(motion, name)
    if all(is_zero(g[0, i]) for i in range(1, g.cols)):
        return sp.oo
    cross = sp.Abs(g[0, 1]) if g.cols == 2 else sp.sqrt(sum((g[0, i] ** 2 for i in range(1, g.cols)), sp.S.Zero))
    return g[0, 0] / cross


def newton_minors(motion: ImpulsiveMotion, name: str) -> list[Expr]:
    """Leading minors of the energy that Newton's rule takes from a sticking contact, as a form in its velocity.

    With u the contact's velocity before, the loss is u^T Q u / 2, Q the symmetric part of (1 + E) G^-1 (1 - E),
    E = diag(e, beta, beta). If a minor is negative, some velocities gain energy (Kane and Levinson's observation).
    """
    contact, _ = motion.contact(name)
    g = delassus(motion, name)
    e = sp.diag(contact.restitution, *[contact.tangential_restitution] * len(contact.tangents))
    one = sp.eye(g.rows)
    loss = (one + e) * solve_linear(g, one, f"contact {name}") * (one - e)
    loss = (loss + loss.T) / 2
    return [tidy(loss[:k, :k].det()) for k in range(1, g.rows + 1)]


def percussion(
    motion: ImpulsiveMotion, name: str, values: Mapping[Expr, Any], hypothesis: str | None = None
) -> Percussion:
    """Follow one contact through its impact at given numbers: slip, reversal, stick, jam (`percussion.follow`).

    ``values`` gives every symbol and coordinate a number (rationals stay exact); ``hypothesis`` may replace the
    contact's own. Raises CaromError where a number is missing.
    """
    contact, rows = motion.contact(name)

    def number(expr: Expr) -> Expr:
        value = sp.sympify(expr).subs(values)
        if value.free_symbols or not value.is_number:
            missing = ", ".join(sorted(str(s) for s in value.free_symbols)) or str(value)
            raise CaromError(f"percussion: no number is given for {missing}")
        return value

    g = delassus(motion, name).applyfunc(number)
    start = [number(value_of(r, motion.u0)) for r in rows]
    return follow(g, start, number(contact.restitution), number(contact.friction), hypothesis or contact.hypothesis)
