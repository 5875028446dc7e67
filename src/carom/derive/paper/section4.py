"""Sections 4, 5 and 1 of the paper: equations (40) and (41), the angles, and the sentences around them."""

from __future__ import annotations

import sympy as sp

from carom.derive.linear import Expr, tidy
from carom.derive.paper import model as k
from carom.derive.paper.ledger import Branch, Entry, Step
from carom.derive.paper.model import I, a, e, eq, m, u0, v0
from carom.derive.paper.section3 import SMOOTH, one, parts

R = sp.Rational


def example() -> list[Entry]:
    """(40), (41) and the printed initial condition."""
    facts = k.example_facts()
    cases = (Branch(k.INSIDE, facts), Branch(k.OUTSIDE, k.example_facts(slides=True)))
    lower = I + m * a**2
    printed40 = [
        (eq(k.x1, u0),),
        (eq(k.y1, m * a**2 / lower * v0), eq(k.y1, R(5, 7) * v0)),
        (eq(k.z1, I * u0 / lower), eq(k.z1, R(2, 7) * u0)),
        (eq(k.wx1, -v0 / a),),
        (eq(k.wy1, -u0 * I / (a * lower)), eq(k.wy1, -R(2, 7) * u0 / a)),
        (eq(k.wz1, m * a * v0 / lower), eq(k.wz1, R(5, 7) * v0 / a)),
    ]
    printed41 = [
        eq(k.x2, R(31, 49) * u0),
        eq(k.y2, R(39, 49) * v0),
        eq(k.z2, sp.S.Zero),
        eq(k.wx2, -R(39, 49) * v0 / a),
        eq(k.wy2, R(25, 49) * u0 / a),
        eq(k.wz2, R(5, 7) * v0 / a),
    ]
    derived40 = [eq(q[0].lhs, facts[q[0].lhs]) for q in printed40]
    derived41 = [eq(q.lhs, facts[q.lhs]) for q in printed41]
    put = Step("(31) with x0' = -u_0, y0' = v_0, omega_z0 = 0, e = 1, I = 2 m a^2 / 5.", None)
    step41 = (put, *(Step("", q) for q in derived40), Step("Then (39).", None), *(Step("", q) for q in derived41))
    rolling = tidy((k.x2 - a * k.wy2).subs({k.x2: printed41[0].rhs, k.wy2: printed41[4].rhs}))
    slip = f"With the printed omega_y2 the ball would not roll: x2' - a omega_y2 would be {rolling}, against (38)"
    flat40 = tuple(q for line in printed40 for q in line)
    spin = facts[k.wz1]
    tables = {k.wz0: sp.S.Zero}
    return [
        Entry(
            "s4-1",
            "'no vertical spin, which means omega_z1 = 0'",
            (eq(k.wz1, sp.S.Zero),),
            (eq(k.wz0, tables[k.wz0]),),
            one({k.wz1: spin}),
            steps=(Step("After the first impact omega_z1 is", spin),),
            note="The spin before the impact is omega_z0; (40) itself prints omega_z1 = 5 v_0 / (7 a).",
        ),
        Entry(
            "40",
            "state after the first impact",
            flat40,
            tuple(derived40),
            cases,
            steps=(put, *(Step("", q) for q in derived40)),
        ),
        *(
            Entry(
                f"40{letter}",
                f"state after the first impact: line {i + 1}",
                lines,
                (derived40[i],),
                cases,
                steps=(put, Step("", derived40[i])),
            )
            for i, (letter, lines) in enumerate(zip("abcdef", printed40, strict=True))
        ),
        *parts(
            "41",
            "state after the second impact",
            printed41,
            derived41,
            facts,
            branches=cases,
            steps=step41,
            note=slip,
            line_notes={4: slip},
        ),
    ]


def angles() -> list[Entry]:
    """The angles of section 4, by both models."""
    facts, slid = k.example_facts(), k.example_facts(slides=True)
    given = {k.x0: -u0, k.y0: v0, k.wz0: sp.S.Zero, e: sp.S.One, I: k.SOLID}
    conventional = {q: tidy(v.subs(given)) for q, v in k.reversed_root().items()}
    tan_i, tan_r, deg = sp.symbols("tan_tau_i tan_tau_r tau_r_deg", real=True)
    incoming = tidy(given[k.y0] / -given[k.x0])
    outgoing, on_cone = (tidy(state[k.y2] / state[k.x2]) for state in (facts, slid))
    two, old = (sp.deg(sp.atan(t.subs(v0, u0))) for t in (outgoing, tidy(conventional[k.y1] / conventional[k.x1])))

    smooth = sp.deg(sp.atan(on_cone.subs({v0: u0, k.mu: 0})))

    def rounded(name: str, value: Expr, printed: Expr, *others: Branch) -> Entry:
        """A figure printed to one decimal, in the paper's case and in others that its words admit."""
        return Entry(
            name,
            f"the angle of reflection is about {printed} degrees",
            (sp.Le(sp.Abs(deg - printed), R(1, 20)),),
            (eq(deg, sp.N(value, 6)),),
            (Branch(k.INSIDE if others else "", {deg: sp.N(value, 20)}), *others),
            steps=(Step("In degrees, for u_0 = v_0.", eq(value, sp.N(value, 8))),),
            note=f"{sp.N(value, 8)} degrees.",
        )

    return [
        Entry(
            "s4-2",
            "the angles from the normal",
            (eq(tan_i, v0 / u0), eq(tan_r, R(39, 31) * v0 / u0)),
            (eq(tan_i, incoming), eq(tan_r, outgoing)),
            (
                Branch(k.INSIDE, {tan_i: incoming, tan_r: outgoing}),
                Branch(k.OUTSIDE, {tan_i: incoming, tan_r: on_cone}),
            ),
            steps=(Step("y2' / x2' by (41).", outgoing), Step("On the cone it is", on_cone)),
        ),
        rounded(
            "s4-3",
            two,
            R(515, 10),
            Branch(f"{SMOOTH} ({sp.N(smooth, 3)} degrees)", {deg: sp.N(smooth, 20)}),
        ),
        Entry(
            "s4-4",
            "the conventional answer",
            (eq(k.x1, u0), eq(k.y1, R(5, 9) * v0), eq(k.wz1, R(14, 9) * v0 / a)),
            tuple(eq(q, conventional[q]) for q in (k.x1, k.y1, k.wz1)),
            one(conventional),
            steps=(Step("(22) with x0' = -u_0, y0' = v_0, omega_z0 = 0, I = 2 m a^2 / 5.", None),),
        ),
        rounded("s4-5", old, R(291, 10)),
    ]


def conclusions() -> list[Entry]:
    """Section 5: the angles of incidence and reflection."""
    kappa = sp.Symbol("kappa", positive=True)
    spin = sp.Symbol("omega_z0", real=True)
    given = {k.x0: -u0, k.y0: v0, e: sp.S.One, I: kappa * m * a**2}
    first = {q: w.subs(given) for q, w in k.first_facts().items()}
    last = {q: tidy(w.subs(first).subs(given)) for q, w in k.second_facts().items()}
    tan_i, tan_r = sp.symbols("tan_tau_i tan_tau_r", real=True)
    plain = tidy((last[k.y2] / last[k.x2]).subs(spin, 0))
    excess = tidy(plain - v0 / u0)
    sphere = {kappa: R(2, 5)}
    equal_spin = tidy(sp.solve(sp.Eq(last[k.y2] / last[k.x2], v0 / u0).subs(sphere), spin)[0])
    less = {spin: 2 * equal_spin, **sphere}
    names = k.conventional_roots()
    mirror = next(f for n, f, _ in names if "mirror" in n)
    incoming = {tan_i: v0 / u0}
    return [
        Entry(
            "s5-1",
            "'the final reflection angle is greater than the incidence angle'",
            (sp.Gt(tan_r, tan_i),),
            (eq(tan_r - tan_i, excess),),
            (
                Branch("for a solid ball without side spin, e = 1", {tan_r: plain.subs(sphere), **incoming}),
                Branch(
                    f"for enough side spin against it (here omega_z0 = {less[spin]})",
                    {tan_r: tidy((last[k.y2] / last[k.x2]).subs(less)), **incoming},
                ),
            ),
            steps=(
                Step("tan tau_r - tan tau_i for any kappa, no side spin.", excess),
                Step("The angles are equal for omega_z0 =", equal_spin),
            ),
        ),
        Entry(
            "s5-2",
            "'angle of incidence equals angle of reflection' only without friction",
            (sp.Ne(tan_r, tan_i),),
            (eq(spin, equal_spin),),
            (
                Branch("for a sticking wall without side spin", {tan_r: plain.subs(sphere), **incoming}),
                Branch(
                    f"for a sticking wall and omega_z0 = {equal_spin}",
                    {tan_r: tidy((last[k.y2] / last[k.x2]).subs({spin: equal_spin, **sphere})), **incoming},
                ),
                Branch(
                    "on the conventional law's mirror root",
                    {tan_r: tidy((mirror[k.y1] / mirror[k.x1]).subs(given)), **incoming},
                ),
            ),
            steps=(Step("The angles are equal for omega_z0 =", equal_spin),),
        ),
    ]


def introduction() -> list[Entry]:
    """Statements of section 1 on friction and energy."""
    t_change = sp.Symbol("Delta_T", real=True)
    case = {k.x0: -u0, k.y0: v0, e: sp.S.One}
    change = tidy(k.first_impact()[1].energy_change.subs(case))
    no_slip = tidy(k.first_impact(tangential=sp.S.One)[1].energy_change.subs(case))
    return [
        Entry(
            "s1-1",
            "energy cannot be conserved while friction acts",
            (sp.Lt(t_change, 0),),
            (eq(t_change, change),),
            (
                Branch("for friction that stops the slip (31)", {t_change: change.subs(k.wz0, 0)}),
                Branch(
                    "for the no-slip law of Broomhead and Gutkin, which keeps energy with friction", {t_change: no_slip}
                ),
            ),
            steps=(Step("Energy change at a sticking wall, e = 1.", change), Step("With beta = 1.", no_slip)),
        ),
    ]
