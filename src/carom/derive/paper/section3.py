"""Section 3 of the paper: the first impact: equations (27) to (33)."""

from __future__ import annotations

from dataclasses import replace
from string import ascii_lowercase
from typing import Any

import sympy as sp

from carom.derive.paper import ledger as k
from carom.derive.paper.ledger import (
    ATTITUDE,
    Branch,
    Entry,
    I,
    Step,
    a,
    dphi,
    dpsi,
    dtheta,
    dx,
    dy,
    dz,
    e,
    eq,
    m,
    mu,
    psi,
    theta,
    u0,
    v0,
)
from carom.derive.system import Expr, is_zero, solve_linear, tidy

COMING = {k.x0: -k.u0}  # the ball comes to the wall: x' < 0
SMOOTH = "at a wall without friction"


def parts(
    number: str, title: str, printed: Any, derived: Any, *more: Any, noted: int = -1, **named: Any
) -> list[Entry]:
    """An equation of several lines as a whole and line by line: "31", "31a", "31b"...; line ``noted`` has the note, too."""
    whole = Entry(number, title, tuple(printed), tuple(derived), *more, **named)
    found = [whole]
    for i, (p, q) in enumerate(zip(printed, derived, strict=True)):
        note = whole.note if i == noted else ""
        name, about = number + ascii_lowercase[i], f"{title}: line {i + 1}"
        found.append(replace(whole, id=name, title=about, printed=(p,), derived=(q,), note=note))
    return found


def wall() -> list[Entry]:
    """(27) to (31): the first impact."""
    facts = k.first_facts()
    before = {q: facts[q] for q in (k.z0, k.wx0, k.wy0)}
    motion, jump = k.first_impact()
    push = sp.Matrix([k.Rx, k.Ry, k.Rz])
    _, columns = motion.acting("stick")
    change = solve_linear(motion.mass, columns * push)
    rolled = sp.Matrix(k.BEFORE).subs(k.z0, 0)  # it was on the floor
    free = dict(zip(k.FIRST, rolled + change, strict=True))
    moments = [
        eq(m * (k.x1 - k.x0), k.Rx),
        eq(m * (k.y1 - k.y0), k.Ry),
        eq(m * k.z1, k.Rz),
        eq(I * (k.wx1 - k.wx0), sp.S.Zero),
        eq(I * (k.wy1 - k.wy0), a * k.Rz),
        eq(I * (k.wz1 - k.wz0), -a * k.Ry),
    ]
    cone = sp.sqrt(k.Ry**2 + k.Rz**2)
    need = sp.sqrt(tidy((facts[k.Ry] ** 2 + facts[k.Rz] ** 2).subs(COMING))) / tidy(facts[k.Rx].subs(COMING))
    spare = sp.Symbol("spare", positive=True)
    stuck = {q: v.subs(COMING) for q, v in facts.items()}
    least = need.subs({k.wz0: 0, k.y0: 0, e: 1, I: k.SOLID})
    slide = k.sliding_facts()
    cases = (Branch(k.INSIDE, facts), Branch(k.OUTSIDE, slide))
    lower = I + m * a**2
    answer = [
        eq(k.x1, -e * k.x0),
        eq(k.y1, a * (I * k.wz0 + m * a * k.y0) / lower),
        eq(k.z1, -I * k.x0 / lower),
        eq(k.wx1, -k.y0 / a),
        eq(k.wy1, k.x0 * I / (a * lower)),
        eq(k.wz1, (I * k.wz0 + m * a * k.y0) / lower),
        eq(k.Rx, -m * k.x0 * (1 + e)),
        eq(k.Ry, m * I * (a * k.wz0 - k.y0) / lower),
        eq(k.Rz, -m * k.x0 * I / lower),
    ]
    other = motion.solve(method="virtual")
    agree = all(is_zero(other.after[u] - jump.after[u]) for u in jump.after)
    smooth = {q.lhs: sp.limit(facts[q.lhs], I, 0) for q in answer}
    vb = [
        tidy(w.subs(dict(zip((dx, dy, dz, k.wx, k.wy, k.wz), k.FIRST, strict=True))).subs(facts))
        for w in k.WALL.values()
    ]
    solve = (
        Step("Impulse and momentum, u1 = u0 + M^-1 R:", None),
        *(Step("", eq(q, free[q])) for q in k.FIRST),
        Step("Closing: x1' = -e x0', and B at rest along the wall (30).", None),
        Step(f"Solved with multipliers; by virtual displacements the same: {agree}.", None),
    )
    return [
        Entry(
            "27",
            "rolling before the impact",
            (eq(k.x0 - a * k.wy0, sp.S.Zero), eq(k.y0 + a * k.wx0, sp.S.Zero)),
            (eq(k.wy0, before[k.wy0]), eq(k.wx0, before[k.wx0])),
            steps=(Step("(2) in spins.", None),),
            note="The scan reads omega_v0 for omega_y0; taken as the scan's slip.",
        ),
        *parts(
            "28",
            "impulse and momentum at the wall",
            moments,
            [eq(q, free[q]) for q in k.FIRST],
            k.one(free),
            steps=(
                Step("The wall's impulse acts at B; M (u1 - u0) = C^T R:", None),
                *(Step("", eq(q, free[q])) for q in k.FIRST),
            ),
        ),
        Entry(
            "29",
            "the impulse within the friction cone",
            (sp.Lt(cone, mu * k.Rx),),
            (sp.Gt(mu, need),),
            (Branch("for any friction", stuck),),
            (Branch(f"for mu > {need} (x0' = -u_0)", {**stuck, mu: need + spare}),),
            steps=(Step("Ratio of the impulses in (31).", need),),
            note=f"An assumption of the model. A solid ball that comes square at e = 1 needs mu > {least}; more "
            "side slip needs more.",
        ),
        Entry(
            "30",
            "B at rest along the wall afterwards",
            (eq(k.y1 - a * k.wz1, sp.S.Zero), eq(k.z1 + a * k.wy1, sp.S.Zero)),
            (eq(k.y1, facts[k.y1]), eq(k.z1, facts[k.z1])),
            cases,
            steps=(
                Step(
                    "After an impact that slides throughout, y1' - a omega_z1 is", tidy((k.y1 - a * k.wz1).subs(slide))
                ),
            ),
        ),
        *parts(
            "31",
            "state and impulses after the first impact",
            answer,
            [eq(q.lhs, facts[q.lhs]) for q in answer],
            cases,
            steps=solve,
            note=f"Of its lines only x1', omega_x1 and R_x hold on the cone too. As I -> 0: y1' = {smooth[k.y1]}, "
            f"z1' = {smooth[k.z1]}, "
            "R_y = R_z = 0: the smooth mirror.",
        ),
        Entry(
            "s3-1",
            "'V_B1 = (0, 0, 0)' after the impact",
            tuple(eq(sp.Symbol(f"V_B{n}1"), sp.S.Zero) for n in "xyz"),
            tuple(eq(sp.Symbol(f"V_B{n}1"), v) for n, v in zip("xyz", vb, strict=True)),
            (Branch("for any e", {sp.Symbol(f"V_B{n}1"): v for n, v in zip("xyz", vb, strict=True)}),),
            (Branch("for e = 0", {sp.Symbol(f"V_B{n}1"): v.subs(e, 0) for n, v in zip("xyz", vb, strict=True)}),),
            steps=(Step("(31) in V_B = V_C + omega x CB.", sp.Matrix(vb)),),
            note="Only the tangential part of V_B vanishes; its normal part is -e x0'.",
        ),
        *lifting(facts),
    ]


def lifting(facts: dict[Expr, Expr]) -> list[Entry]:
    """The sentences on the vertical impulse and the floor's friction."""
    _, free = k.first_impact(rolls=False)
    any_z = tidy(free.impulses["B.t2"])
    any_rise = tidy(free.after[k.Z.diff(k.TIME)])
    back = {k.wy0: k.u0 / a, k.z0: sp.S.Zero}  # rolling as if it came from the other side
    skid = {k.wy0: sp.S.Zero, k.z0: sp.S.Zero}
    rolls = {q: v.subs(COMING) for q, v in facts.items()}
    along = sp.Symbol("u_y", real=True)  # the slip along the wall, y0' - a omega_z0
    slid = tidy(k.sliding_facts()[k.z1].subs(COMING).subs(k.wz0, (k.y0 - along) / a))
    speed = k.z0 + a * k.wy0
    step = Step("For any state before, R_z is", any_z)
    # a cushion that touches above the centre has a normal (n_x, 0, -n_z): it pushes the ball down even without friction
    push, down = sp.symbols("R_n n_z", positive=True)
    note = f"R_z = {any_z} is positive only while z0' + a omega_y0 < 0: the point B must be moving down."
    return [
        Entry(
            "s3-2",
            "'the impulse of the wall at B always has a positive vertical component'",
            (sp.Gt(k.Rz, 0),),
            (eq(k.Rz, any_z),),
            (
                Branch("for a rolling ball at a vertical wall with friction", {k.Rz: rolls[k.Rz]}),
                Branch("for a sliding ball without spin", {k.Rz: any_z.subs(skid)}),
                Branch("for backspin", {k.Rz: any_z.subs(back)}),
                Branch("for a smooth cushion that touches above the centre", {k.Rz: -down * push}),
            ),
            steps=(step, Step("velocity of B along z", speed)),
            note=note,
        ),
        Entry(
            "s3-3",
            "'the forces of friction of the floor have no influence' (the floor is left at once)",
            (sp.Gt(k.z1, 0),),
            (eq(k.z1, any_rise),),
            (
                Branch("for a rolling ball and a wall with friction", {k.z1: rolls[k.z1]}),
                Branch("for a sliding ball without spin", {k.z1: any_rise.subs(skid)}),
                Branch("for backspin", {k.z1: any_rise.subs(back).subs(COMING)}),
            ),
            steps=(step, Step("so z1' is", any_rise)),
            note="Where the wall does not lift the ball, floor and wall act together and the floor's friction "
            "takes part.",
        ),
        Entry(
            "s3-4",
            "the ball leaves the floor, z1' > 0 for x0' < 0",
            (sp.Gt(k.z1, 0),),
            (eq(k.z1, facts[k.z1]),),
            (
                Branch(k.INSIDE, {k.z1: rolls[k.z1]}),
                Branch(k.OUTSIDE, {k.z1: slid}),
                Branch(SMOOTH, {k.z1: slid.subs(mu, 0)}),
            ),
            steps=(Step("(31) with x0' = -u_0.", eq(k.z1, rolls[k.z1])), Step("On the cone it is", slid)),
        ),
    ]


def energies() -> list[Entry]:
    """(32), (33) and the loss."""
    motion, _ = k.first_impact()
    facts = k.first_facts()
    case = {e: sp.S.One, k.wz0: sp.S.Zero}
    t0 = tidy(motion.energy(motion.u0).subs(case))
    t1, t1_slide = (
        tidy(motion.energy(sp.Matrix([state[q] for q in k.FIRST])).subs(case)) for state in (facts, k.sliding_facts())
    )
    loss = tidy(t0 - t1)
    spare = sp.Symbol("spare", positive=True)
    need = sp.sqrt(k.u0**2 + k.y0**2) * I / (2 * k.u0 * (I + m * a**2))  # (29) for e = 1 without side spin
    energies_of = {
        k.INSIDE: t1.subs(COMING),
        k.OUTSIDE: tidy(t1_slide.subs(COMING).subs(mu, need / (1 + spare))),
        SMOOTH: tidy(t1_slide.subs(COMING).subs(mu, 0)),
    }
    spring = k.first_impact(tangential=k.beta)[1].energy_change
    no_slip = tidy(spring.subs({**case, k.beta: 1}).subs(COMING))
    dead = tidy(spring.subs({**case, k.beta: 0}).subs(COMING))
    lower = I + m * a**2
    with_t1 = (
        m * k.x0**2 / 2
        + m**2 * a**2 * k.y0**2 / (2 * lower)
        + I * k.y0**2 / (2 * a**2)
        + I**2 * k.x0**2 / (2 * a**2 * lower)
    )
    with_t0 = m * k.x0**2 / 2 + m * k.y0**2 / 2 + I * k.y0**2 / (2 * a**2) + I * k.x0**2 / (2 * a**2)
    step = Step("T0 - T1 is", loss)
    return [
        Entry(
            "32",
            "energy before (e = 1, no side spin)",
            (eq(k.T0, with_t0),),
            (eq(k.T0, t0),),
            steps=(Step("m v^2 / 2 + I omega^2 / 2 with (27).", t0),),
        ),
        Entry(
            "33",
            "energy after (e = 1, no side spin)",
            (eq(k.T1, with_t1),),
            (eq(k.T1, t1),),
            (Branch(k.INSIDE, {k.T1: t1}), Branch(k.OUTSIDE, {k.T1: t1_slide})),
            steps=(Step("The same with (31).", t1), step),
            note=f"The loss is then {loss}.",
        ),
        Entry(
            "s3-5",
            "'it is clear that T1 < T0'",
            (sp.Lt(k.T1, k.T0),),
            (eq(k.T0 - k.T1, loss),),
            tuple(Branch(name, {k.T0: t0.subs(COMING), k.T1: value}) for name, value in energies_of.items()),
            steps=(step,),
            note="A ball that rolls into the wall slips at B, so any friction there takes energy.",
        ),
        Entry(
            "s3-6",
            "friction that reverses the slip at B is contradictory",
            (sp.Lt(k.T1 - k.T0, 0),),
            (eq(k.T1 - k.T0, no_slip),),
            (
                Branch("for a contact that only resists slip (beta = 0): energy is lost", {k.T1: k.T0 + dead}),
                Branch("for an elastic rough contact (beta = 1, a superball): none is lost", {k.T1: k.T0 + no_slip}),
            ),
            steps=(Step("Energy change with tangential restitution beta, any e.", spring),),
            note="Dry friction on rigid bodies cannot reverse a slip; a contact that stores tangential strain "
            "can, and neither "
            "creates energy. So the conventional reversal is a statement on the material, not a contradiction.",
        ),
    ]


def flight() -> list[Entry]:
    """The flight in between: the ball comes down as it went up."""
    t = sp.Symbol("t", positive=True)
    rise = sp.Symbol("zdot1", positive=True)
    landing = sp.solve(sp.Eq(rise * t - k.g * t**2 / 2, 0), t)[0]
    down = tidy((rise - k.g * t).subs(t, landing))
    z_land = sp.Symbol("zdot_land", real=True)
    return [
        Entry(
            "s3-7",
            "the ball comes back with (x1', y1', -z1') and the same spin",
            (eq(z_land, -rise),),
            (eq(z_land, down),),
            steps=(Step("z - a = z1' t - g t^2 / 2 vanishes at t =", landing), Step("when z' is", down)),
            note="Without air, and onto a floor of the same height, before the ball meets another wall.",
        )
    ]


# ----------------------------------------------------------------------------------------------------
# Section 3 of the paper, the second impact: equations (34) to (39).


def floor() -> list[Entry]:
    """(34) to (39): the second impact."""
    energy = tidy(k.angle_energy())
    roll = k.rolling()
    p = sp.symbols("p_theta p_varphi p_psi")
    chain = [
        tidy(sp.diff(energy, w) + sum((sp.diff(energy, q) * sp.diff(roll[q], w) for q in (dx, dy)), sp.S.Zero))
        for w in (dtheta, dphi, dpsi)
    ]
    printed35 = [
        eq(p[0], I * dtheta + m * a * sp.sin(psi) * dx - m * a * sp.cos(psi) * dy),
        eq(
            p[1],
            I * (dphi + sp.cos(theta) * dpsi)
            - m * a * sp.sin(theta) * sp.cos(psi) * dx
            - m * a * sp.sin(theta) * sp.sin(psi) * dy,
        ),
        eq(p[2], I * (dpsi + sp.cos(theta) * dphi)),
    ]
    # the floor's impulse does no work along a rolling displacement: S^T A^T Lambda
    rows = [sp.Matrix([[sp.diff(w, v) for v in (dx, dy, dz, dtheta, dphi, dpsi)]]) for w in k.floor_rows().values()]
    shape = sp.Matrix([[sp.diff(roll[q], w) for w in (dtheta, dphi, dpsi)] for q in (dx, dy, dz)]).col_join(sp.eye(3))
    pushes = sp.Matrix(sp.symbols("Lambda_1:4"))
    work = (shape.T * sp.Matrix.vstack(*rows).T * pushes).applyfunc(tidy)
    p1, p2 = (sp.symbols(f"p_theta{n} p_varphi{n} p_psi{n}") for n in (1, 2))
    facts = k.second_facts()
    momenta = [
        eq(I * k.wx2 - m * a * k.y2, I * k.wx1 - m * a * k.y1),
        eq(I * k.wy2 + m * a * k.x2, I * k.wy1 + m * a * k.x1),
        eq(I * k.wz2, I * k.wz2),
    ]
    at = {v: w.subs(ATTITUDE) for v, w in zip((k.wx, k.wy, k.wz), k.spin(), strict=True)}
    up = sp.solve([eq(v, w) for v, w in at.items()], [dtheta, dphi, dpsi], dict=True)[0]
    spun = [q.subs(ATTITUDE).subs(up) for q in chain]
    derived37 = [
        eq(
            w.subs(dict(zip((dx, dy, k.wx, k.wy, k.wz), (k.x2, k.y2, k.wx2, k.wy2, k.wz2), strict=True))),
            w.subs(dict(zip((dx, dy, k.wx, k.wy, k.wz), (k.x1, k.y1, k.wx1, k.wy1, k.wz1), strict=True))),
        )
        for w in (spun[0], -spun[1], spun[2])
    ]
    lower = I + m * a**2
    answer = [
        eq(k.x2, a * (I * k.wy1 + m * a * k.x1) / lower),
        eq(k.y2, a * (m * a * k.y1 - I * k.wx1) / lower),
        eq(k.z2, sp.S.Zero),
        eq(k.wx2, (I * k.wx1 - m * a * k.y1) / lower),
        eq(k.wy2, (I * k.wy1 + m * a * k.x1) / lower),
        eq(k.wz2, k.wz1),
    ]
    rolling2 = [eq(k.x2, a * k.wy2), eq(k.y2, -a * k.wx2), eq(k.z2, sp.S.Zero)]
    motion, jump = k.second_impact()
    other = motion.solve(method="virtual")
    agree = all(is_zero(other.after[u] - jump.after[u]) for u in jump.after)
    lines = tuple(Step("", q) for q in derived37)
    third = "The third line has omega_z2 on both sides, whether by the press or by the scan; (39) shows what is meant"
    landing = "enters" if any(v.has(k.z1) for v in facts.values()) else "does not enter"
    return [
        Entry(
            "34",
            "kinetic energy in the air",
            (
                eq(
                    k.T,
                    m * (dx**2 + dy**2 + dz**2) / 2
                    + I * (dtheta**2 + dphi**2 + dpsi**2 + 2 * dphi * dpsi * sp.cos(theta)) / 2,
                ),
            ),
            (eq(k.T, energy),),
            steps=(Step("m v^2 / 2 + I omega^2 / 2 with (1).", energy),),
        ),
        *parts(
            "35",
            "momenta along rolling displacements",
            printed35,
            [eq(q, v) for q, v in zip(p, chain, strict=True)],
            k.one(dict(zip(p, chain, strict=True))),
            steps=(Step("Chain rule with (2).", sp.Matrix(chain)),),
        ),
        Entry(
            "36",
            "they do not jump",
            tuple(eq(q, r) for q, r in zip(p1, p2, strict=True)),
            tuple(eq(q, r) for q, r in zip(p1, p2, strict=True)),
            k.one(dict(zip(p2, [q + w for q, w in zip(p1, work, strict=True)], strict=True))),
            steps=(Step("The work of the floor's impulse along rolling displacements.", work),),
        ),
        *parts(
            "37",
            "the same in spins",
            momenta,
            derived37,
            k.one(facts),
            steps=(Step("(35) at varphi = psi = 0, theta = pi/2, (36):", None), *lines),
            note=third,
            noted=2,
        ),
        *parts(
            "38",
            "rolling after the second impact",
            rolling2,
            rolling2,
            k.one(facts),
            steps=(Step("(2) in spins.", None),),
            note="The scan reads y^2 for the subscripts y2; taken as the scan's slip.",
        ),
        *parts(
            "39",
            "state after the second impact",
            answer,
            [eq(q.lhs, facts[q.lhs]) for q in answer],
            k.one(facts),
            steps=(
                Step("M (u2 - u1) = A^T Lambda with (38).", None),
                *(Step("", eq(q.lhs, facts[q.lhs])) for q in answer),
                Step(f"By virtual displacements the same: {agree}.", None),
            ),
            note=f"z1' {landing} it: angular momentum about the floor contact gives it, whether the ball sticks, "
            "slides or "
            "bounces there, as long as nothing else acts and every impulse passes through that contact.",
        ),
    ]


# ----------------------------------------------------------------------------------------------------
# Sections 4, 5 and 1 of the paper: equations (40) and (41), the angles, and the sentences around them.


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
    return [
        Entry(
            "s4-1",
            "'no vertical spin, which means omega_z1 = 0'",
            (eq(k.wz1, sp.S.Zero),),
            (eq(k.wz0, sp.S.Zero),),
            k.one({k.wz1: facts[k.wz1]}),
            steps=(Step("After the first impact omega_z1 is", facts[k.wz1]),),
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
            cases,
            steps=step41,
            note=slip,
            noted=4,
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
