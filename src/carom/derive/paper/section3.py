"""Section 3 of the paper: the first impact: equations (27) to (33)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sympy as sp

from carom.derive.linear import Expr, is_zero, solve_linear, tidy
from carom.derive.paper import model as k
from carom.derive.paper.ledger import Branch, Entry, Step
from carom.derive.paper.model import I, a, dx, dy, dz, e, eq, m, mu

LETTERS = "abcdefghijklmnopqrstuvwxyz"
COMING = {k.x0: -k.u0}  # the ball comes to the wall: x' < 0
SMOOTH = "at a wall without friction"


def one(facts: dict[Expr, Expr]) -> tuple[Branch, ...]:
    """A single case without a name."""
    return (Branch("", facts),)


def parts(
    number: str, title: str, printed: Sequence[Any], derived: Sequence[Any], facts: dict[Expr, Expr], **more: Any
) -> list[Entry]:
    """An equation of several lines as a whole and line by line: "31", "31a", "31b"..."""
    branches = more.pop("branches", one(facts))
    notes = more.pop("line_notes", {})
    whole = Entry(number, title, tuple(printed), tuple(derived), branches, **more)
    more.pop("note", None)
    lines = []
    for i, (p, q) in enumerate(zip(printed, derived, strict=True)):
        lines.append(
            Entry(
                f"{number}{LETTERS[i]}", f"{title}: line {i + 1}", (p,), (q,), branches, note=notes.get(i, ""), **more
            )
        )
    return [whole, *lines]


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
            one(before),
            steps=(Step("(2) in spins.", None),),
            note="The scan reads omega_v0 for omega_y0; taken as the scan's slip.",
        ),
        *parts(
            "28",
            "impulse and momentum at the wall",
            moments,
            [eq(q, free[q]) for q in k.FIRST],
            free,
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
            facts,
            branches=cases,
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
    coming = {k.x0: -k.u0}
    spare = sp.Symbol("spare", positive=True)
    need = sp.sqrt(k.u0**2 + k.y0**2) * I / (2 * k.u0 * (I + m * a**2))  # (29) for e = 1 without side spin
    energies_of = {
        k.INSIDE: t1.subs(coming),
        k.OUTSIDE: tidy(t1_slide.subs(coming).subs(mu, need / (1 + spare))),
        SMOOTH: tidy(t1_slide.subs(coming).subs(mu, 0)),
    }
    spring = k.first_impact(tangential=k.beta)[1].energy_change
    no_slip = tidy(spring.subs({**case, k.beta: 1}).subs(coming))
    dead = tidy(spring.subs({**case, k.beta: 0}).subs(coming))
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
            one({k.T0: t0}),
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
            tuple(Branch(name, {k.T0: t0.subs(coming), k.T1: value}) for name, value in energies_of.items()),
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
            one({z_land: down}),
            steps=(Step("z - a = z1' t - g t^2 / 2 vanishes at t =", landing), Step("when z' is", down)),
            note="Without air, and onto a floor of the same height, before the ball meets another wall.",
        )
    ]
