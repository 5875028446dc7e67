"""Section 2 of the paper, the conventional impact: equations (12) to (26)."""

from __future__ import annotations

from typing import Any

import sympy as sp

from carom.derive.linear import Expr, tidy
from carom.derive.paper import model as k
from carom.derive.paper.ledger import Branch, Entry, Step
from carom.derive.paper.model import ATTITUDE, I, a, dphi, dpsi, dtheta, dx, dy, dz, eq, m, psi, theta
from carom.derive.paper.section2 import COS, SIN, one


def momentum() -> list[Entry]:
    """(12) to (17): virtual displacements, and the one momentum that does not jump."""
    free = k.freedom()
    pole = {theta: ATTITUDE[theta], psi: ATTITUDE[psi]}
    dt, dp, ds = sp.symbols("delta_theta delta_varphi delta_psi", real=True)
    moved = {dt: free[dtheta] * dp, ds: free[dpsi] * dp}
    rolling = k.angle_energy().subs(k.rolling())
    rates = (dtheta, dphi, dpsi)
    direction = sp.Matrix([free[dtheta], 1, free[dpsi]])
    slope = sp.Matrix([sp.diff(rolling, w) for w in rates])
    derivative = tidy((direction.T * slope)[0])
    # every impulse of the six rows, along the allowed displacement: the work that would make (13) fail
    rows, columns = k.both_contacts().acting(None)
    pushes = sp.Matrix(sp.symbols(f"Lambda_1:{len(rows) + 1}", real=True))
    column = k.both_contacts().virtual_displacements([k.PHI.diff(k.TIME)])
    work = tidy(k.flat((column.T * columns * pushes)[0]))
    p0, p1 = sp.symbols("p_0 p_1")
    start = derivative.subs({dtheta: k.dtheta0, dphi: k.dphi0, dpsi: k.dpsi0})
    t_by = sp.Symbol("dT/dvarphidot")
    mixed = sp.Matrix([sp.diff(rolling, w) for w in rates])
    printed14 = [
        eq(t_by, mixed[1] - mixed[2] * (SIN(theta) / SIN(psi) + COS(theta)) + mixed[0] * SIN(theta) * sp.cot(psi)),
        eq(
            t_by,
            (m * a**2 + I) * SIN(theta) * sp.cot(psi) * dtheta
            - I * SIN(theta) / SIN(psi) * dpsi
            + (m * a**2 * SIN(theta) ** 2 + I * SIN(theta) ** 2 - I * SIN(theta) * COS(theta) / SIN(psi)) * dphi,
        ),
    ]
    jumps = sp.symbols("Delta_thetadot Delta_varphidot Delta_psidot", real=True)
    cleared = tidy(derivative * SIN(psi) / SIN(theta)).subs(dict(zip(rates, jumps, strict=True)))
    end = sp.solve(cleared, jumps[2])[0]
    motion = k.conventional()
    law = motion.jump_equations()[0].lhs.subs(dict.fromkeys((k.x1,), 0))
    rolled = {k.y1: -a * k.wx1, k.y0: -a * k.wx0}
    spins = sp.solve(law.subs(rolled), k.wz1)[0]
    angles = dict(zip((k.wx0, k.wz0, k.wx1, k.wz1), (k.dtheta0, k.dpsi0, k.dtheta1, k.dpsi1), strict=True))
    work_step = Step("The work of the six impulses along it: S^T A^T Lambda =", work)
    unknown, given = sp.symbols("N_unknowns N_equations")
    return [
        Entry(
            "12",
            "virtual displacements",
            (eq(ds, -dp * (SIN(theta) / SIN(psi) + COS(theta))), eq(dt, dp * SIN(theta) * sp.cot(psi))),
            (eq(ds, moved[ds]), eq(dt, moved[dt])),
            one(moved),
            attitude=pole,
            steps=(Step("The null space of all six rows, per unit delta varphi.", direction),),
        ),
        Entry(
            "13",
            "the momentum along the virtual displacement does not jump",
            (eq(p1, p0),),
            (eq(p1, start),),
            one({p0: start, p1: start + work}),
            attitude=pole,
            steps=(
                Step("Displacement per unit delta varphi.", direction),
                work_step,
                Step("so p_1 = p_0 with p = dT/dvarphi'.", derivative),
            ),
            note="Both contacts must stick, and both impulses be ideal: the floor's too.",
        ),
        Entry(
            "14",
            "dT/dvarphi' with the other rates put in",
            tuple(printed14),
            (eq(t_by, derivative),),
            one({t_by: derivative}),
            attitude=pole,
            steps=(Step("Gradient of (3).", slope), Step("Along the displacement.", eq(t_by, derivative))),
        ),
        Entry(
            "15",
            "the jump, cleared of sin psi",
            (
                eq(
                    (m * a**2 + I) * COS(psi) * jumps[0]
                    - I * jumps[2]
                    + (m * a**2 * SIN(theta) * SIN(psi) + I * SIN(theta) * SIN(psi) - I * COS(theta)) * jumps[1],
                    sp.S.Zero,
                ),
            ),
            (eq(jumps[2], end),),
            one({jumps[2]: end}),
            attitude=pole,
            steps=(Step("(14) times sin psi / sin theta, on the jumps.", eq(cleared, sp.S.Zero)),),
            note="The factor clears the pole of (6): the direction of the motion has a limit at psi = 0 though "
            "its parameter has none.",
        ),
        Entry(
            "16",
            "the jump at the collision",
            (eq((m * a**2 + I) * (k.dtheta1 - k.dtheta0) - I * (k.dpsi1 - k.dpsi0), sp.S.Zero),),
            (eq(k.dpsi1, tidy(spins.subs(angles))),),
            one({k.dpsi1: spins.subs(angles)}),
            steps=(
                Step(
                    "Momentum along the turn about AB, from the six-row problem at this attitude.", eq(law, sp.S.Zero)
                ),
                Step("with y' = -a omega_x and the rates of s2-1.", eq(k.dpsi1, tidy(spins.subs(angles)))),
            ),
        ),
        Entry(
            "17",
            "the jump in spins",
            (eq((m * a**2 + I) * (k.wx1 - k.wx0) - I * (k.wz1 - k.wz0), sp.S.Zero),),
            (eq(k.wz1, tidy(spins)),),
            one({k.wz1: spins}),
            steps=(
                Step("Angular momentum about the line AB.", eq(law, sp.S.Zero)),
                Step("with y' = -a omega_x.", eq(k.wz1, tidy(spins))),
            ),
        ),
        Entry(
            "s2-7",
            "(17) alone does not determine the state afterwards",
            (sp.Lt(given, unknown),),
            (eq(given, 1), eq(unknown, 3)),
            one(
                {
                    given: sp.Integer(motion.virtual_displacements().cols),
                    unknown: sp.Integer(6 - len(motion.pre_relations)),
                }
            ),
            steps=(
                Step("Freedoms of the two contacts together.", sp.Integer(motion.virtual_displacements().cols)),
                Step("Freedoms of the rolling ball.", sp.Integer(6 - len(motion.pre_relations))),
            ),
            note="Two more equations are needed, which is what the hypotheses give; two roots are left even so.",
        ),
    ]


def closing() -> list[Entry]:
    """(18) to (22): hypotheses, energy, the answer."""
    return [*_hypotheses(), *_energy_and_answer()]


def _hypotheses() -> list[Entry]:
    conventional, first = k.reversed_root(), k.first_facts()
    stick = k.conventional_roots()[-1][2]
    lam = stick.free_impulses[0]
    sides = {k.x0: -k.u0}
    push = tidy(stick.impulses["floor z"].subs(sides))
    drag = tidy((stick.impulses["floor x"]).subs(sides))
    s_z = sp.Symbol("S_z", positive=True)
    ratio = tidy((-drag).subs(lam, sp.solve(push - s_z, lam)[0]) / s_z)
    rolls = {q: v for q, v in first.items() if q in (k.z0, k.wx0, k.wy0)}
    lift = tidy(stick.impulses["wall z"].subs(lam, sp.solve(push - s_z, lam)[0]))

    def rolling(x: Expr, y: Expr, z: Expr, w: Expr, v: Expr) -> tuple[Any, ...]:
        return eq(x, a * v), eq(y, -a * w), eq(z, sp.S.Zero)

    before, after = rolling(k.x0, k.y0, k.z0, k.wx0, k.wy0), rolling(k.x1, k.y1, k.z1, k.wx1, k.wy1)
    held = (
        f"The wall must then push the ball down (R_z = {lift}) and the floor's friction must exceed 1: its impulses "
        f"have the ratio {ratio} when it pushes with S_z"
    )
    names = ("while the floor holds the ball through the impact", "when the wall alone acts, as in section 3")
    _, poisson = k.first_impact("poisson")
    ball, w, t_i = sp.symbols("v w T_i")
    del ball, w
    energy = k.angle_energy().subs(dict(zip((dx, dy, dz), (dx, dy, sp.S.Zero), strict=True)))
    spin_form = tidy(energy)
    return [
        Entry(
            "18",
            "Hypothesis 1: rolling before and after",
            before + after,
            after,
            (Branch(names[0], {**conventional, **rolls}), Branch(names[1], {**first, **rolls})),
            steps=(Step("Impulses of the floor when both contacts act.", sp.Matrix([drag, push])), Step(held)),
            note=held + ".",
        ),
        Entry(
            "18a",
            "rolling before (i = 0)",
            before,
            before,
            one(rolls),
            steps=(Step("The constraints (2) in spins.", None),),
        ),
        Entry(
            "18b",
            "rolling after (i = 1)",
            after,
            after,
            (Branch(names[0], conventional), Branch(names[1], first)),
            steps=(Step("After the wall alone, z' is", eq(k.z1, first[k.z1])),),
            note=held + ".",
        ),
        Entry(
            "19",
            "Hypothesis 2: Newton's restitution",
            (eq(k.x1, -k.e * k.x0),),
            (eq(k.x1, poisson.after[k.X.diff(k.TIME)]),),
            one({k.x1: poisson.after[k.X.diff(k.TIME)]}),
            steps=(
                Step("Poisson's rule: (1 + e) times the normal impulse of compression.", poisson.impulses["B.n"]),
                Step(
                    "gives the same, since a ball's normal impulse makes no spin.",
                    eq(k.x1, poisson.after[k.X.diff(k.TIME)]),
                ),
            ),
            note="For a ball the rules of Newton, Poisson and Stronge agree, so that the hypothesis is one on "
            "the material alone.",
        ),
        Entry(
            "20",
            "kinetic energy",
            (eq(t_i, m * (dx**2 + dy**2) / 2 + I * (k.wx**2 + k.wy**2 + k.wz**2) / 2),),
            (eq(t_i, spin_form),),
            one({t_i: spin_form} | dict(zip((k.wx, k.wy, k.wz), k.spin(), strict=True))),
            steps=(Step("From (1), with z' = 0.", spin_form),),
        ),
    ]


def _energy_and_answer() -> list[Entry]:
    motion = k.conventional()
    delta = sp.Symbol("Delta", real=True)
    # the one-parameter family left by (17), (18), (19): y1 = y0 + Delta
    law = motion.jump_equations()
    given = [q for q in law if isinstance(q, sp.Equality)] + [eq(k.x1, -k.e * k.x0), eq(k.y1, k.y0 + delta)]
    family = sp.solve([q.lhs - q.rhs for q in given], list(motion.speeds.after), dict=True)[0]
    u1 = sp.Matrix([family[u] for u in motion.speeds.after])
    gain = tidy(motion.energy(u1) - motion.energy(motion.u0))
    roots = sp.solve(gain, delta)
    square = gain.subs({k.y0: 0, k.wz0: 0})
    still = gain.subs(delta, 0)
    forced = sp.solve(sp.Eq(still.subs(k.x0, -k.u0), 0), k.e)[0]
    half = sp.Rational(1, 2)
    numbers = {
        k.y0: sp.S.One,
        k.wz0: sp.S.Zero,
        k.x0: -sp.S.One,
        a: sp.S.One,
        m: sp.S.One,
        I: sp.Rational(2, 5),
        k.e: half,
    }
    shown = [r.subs(numbers) for r in roots]
    real = [r for r in shown if r.is_real]
    broken = [tidy(r) for r in sp.solve(square.subs({k.x0: -k.u0, k.e: half}), delta)]
    roots_text = ", ".join(str(sp.N(r, 6)) for r in real)
    in_general = {k.e: half} if real else {k.e: forced}
    names = k.conventional_roots()
    energies = [motion.energy(sp.Matrix([f[q] for q in k.FIRST])) for _, f, _ in names]
    t0 = motion.energy(motion.u0)
    reversed_ = k.reversed_root()
    with_e = {**reversed_, k.x1: -k.e * k.x0, k.wy1: -k.e * k.x0 / a}
    t_e = motion.energy(sp.Matrix([with_e[q] for q in k.FIRST]))
    big = I + m * a**2 / 2
    printed22 = (
        eq(k.y1, m * a**2 / (2 * big) * k.y0 + I * a / big * k.wz0),
        eq(k.wz1, (I + m * a**2) / (big * a) * k.y0 - m * a**2 / (2 * big) * k.wz0),
    )
    branches = tuple(Branch(n, f) for n, f, _ in names)
    limits = tuple(
        sp.limit(
            reversed_[q].subs(I, sp.Symbol("kappa", positive=True) * m * a**2), sp.Symbol("kappa", positive=True), 0
        )
        for q in (k.y1, k.wz1)
    )
    derived22 = tuple(eq(q, reversed_[q]) for q in (k.y1, k.wz1))
    two = f"The hypotheses leave the roots Delta y' = {' and '.join(str(tidy(r.subs(k.e, 1))) for r in roots)} "
    "(in the order solved)"
    step = Step("Energy gained on the family y1' = y0' + Delta that (17) to (19) leave.", gain)
    note22 = (
        f"The mirror root, y1' = y0', meets all three hypotheses too; the paper takes the other. As I -> 0 it tends to "
        f"y1' = {limits[0]}, a omega_z1 = {tidy(limits[1] * a)}."
    )
    return [
        Entry(
            "s2-8",
            "'for the energy is conserved, e must be 1'",
            (eq(k.e, sp.S.One),),
            (eq(k.e, forced),),
            (Branch("in general", in_general),),
            (
                Branch(
                    "if the tangential state does not change (the mirror root, or a square hit that stays square)",
                    {k.e: forced},
                ),
            ),
            steps=(
                step,
                Step("Its roots in Delta.", sp.Matrix(roots)),
                Step("If Delta = 0, energy asks for e =", forced),
            ),
            note="With e = 1/2 (m = a = 1, I = 2/5, x0' = -1, y0' = 1, no side spin) energy is conserved by "
            f"Delta = {roots_text}: "
            "the friction then turns lost normal energy into tangential motion. For a square hit Delta = "
            f"{' or '.join(map(str, broken))}, which breaks its mirror symmetry. So e = 1 is forced only where "
            "Delta = 0.",
        ),
        Entry(
            "21",
            "Hypothesis 3: energy",
            (eq(k.T0, k.T1),),
            (eq(k.T1 - k.T0, tidy(t_e - t0)),),
            (Branch("for any e", {k.T0: t0, k.T1: t_e}),),
            (Branch("for e = 1", {k.T0: t0, k.T1: energies[-1]}),),
            steps=(step, Step("With the state (22) and x1' = -e x0'.", eq(k.T1 - k.T0, tidy(t_e - t0)))),
        ),
        Entry(
            "22",
            "the conventional answer",
            printed22,
            derived22,
            branches,
            steps=(step, Step(two), *(Step("so", q) for q in derived22)),
            note=note22,
        ),
        Entry(
            "22a", "the lateral velocity", printed22[:1], derived22[:1], branches, steps=(step, Step(two)), note=note22
        ),
        Entry("22b", "the vertical spin", printed22[1:], derived22[1:], branches, steps=(step, Step(two)), note=note22),
    ]


def slip() -> list[Entry]:
    """(23) to (26): the slip at B before and after."""
    rolls = {**k.first_facts(), k.wz0: sp.S.Zero}
    before = {q: rolls[q] for q in (k.z0, k.wx0, k.wy0, k.wz0)}
    names = k.conventional_roots()
    vb0, vb1 = sp.symbols("V_Bx0 V_By0 V_Bz0", real=True), sp.symbols("V_Bx1 V_By1 V_Bz1", real=True)

    def at_b(symbols: tuple[Expr, ...]) -> list[Expr]:
        swap = dict(zip((dx, dy, dz, k.wx, k.wy, k.wz), symbols, strict=True))
        return [w.subs(swap) for w in k.WALL.values()]

    start = dict(zip(vb0, [tidy(w.subs(k.conventional().pre_relations)) for w in at_b(k.BEFORE)], strict=True))
    plain = {q: v.subs(k.wz0, 0) for q, v in start.items()}
    ends = [dict(zip(vb1, [tidy(w.subs(f)) for w in at_b(k.FIRST)], strict=True)) for _, f, _ in names]
    branch25 = tuple(
        Branch(n, {q: v.subs(k.wz0, 0) for q, v in end.items()}) for (n, _, _), end in zip(names, ends, strict=True)
    )
    branch26 = tuple(Branch(n, {**start, **end}) for (n, _, _), end in zip(names, ends, strict=True))
    step = Step("V_B = V_C + omega x CB before.", sp.Matrix(list(start.values())))
    # a disc in the plane under the no-slip law, 2 kappa'/(1 + kappa') of the slip, gives the same lateral velocity for
    kappa, other = sp.symbols("kappa kappa_disc", positive=True)
    share = tidy(((k.reversed_root()[k.y1] - k.y0) / (a * k.wz0 - k.y0)).subs(I, kappa * m * a**2))
    disc = tidy(sp.solve(sp.Eq(2 * other / (1 + other), share), other)[0])
    return [
        Entry(
            "23",
            "rolling without side spin",
            (eq(k.x0 - a * k.wy0, sp.S.Zero), eq(k.y0 + a * k.wx0, sp.S.Zero), eq(k.wz0, sp.S.Zero)),
            (eq(k.wy0, before[k.wy0]), eq(k.wx0, before[k.wx0])),
            one(before),
            steps=(Step("(2) in spins.", None),),
        ),
        Entry(
            "24",
            "velocity of B before",
            (eq(vb0[0], k.x0), eq(vb0[1], k.y0), eq(vb0[2], k.x0)),
            tuple(eq(q, v) for q, v in plain.items()),
            one(plain),
            steps=(step,),
        ),
        Entry(
            "25",
            "velocity of B after",
            (eq(vb1[0], -k.x0), eq(vb1[1], -k.y0), eq(vb1[2], -k.x0)),
            tuple(eq(q, v) for q, v in branch25[-1].facts.items()),
            branch25,
            steps=(step, *(Step(f"after, {b.name}.", sp.Matrix(list(b.facts.values()))) for b in branch25)),
        ),
        Entry(
            "26",
            "the slip at B is reversed",
            tuple(eq(q, -p) for q, p in zip(vb1, vb0, strict=True)),
            tuple(eq(q, ends[-1][q]) for q in vb1),
            branch26,
            steps=(step, *(Step(f"after, {b.name}.", sp.Matrix([b.facts[q] for q in vb1])) for b in branch26)),
            note="True with side spin too. In the plane it is Broomhead and Gutkin's no-slip law (e = 1, beta = "
            "1, mu infinite) of a "
            f"disc with kappa' = {disc}: while it rolls, the ball is as heavy as m + I/a^2; the mirror root is "
            "beta = -1.",
        ),
    ]
