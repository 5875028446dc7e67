"""Section 2 of the paper, its kinematics: equations (1) to (11)."""

from __future__ import annotations

from typing import Any

import sympy as sp

from carom.derive.corners import frobenius
from carom.derive.paper import ledger as k
from carom.derive.paper.ledger import (
    ATTITUDE,
    Branch,
    Entry,
    I,
    Step,
    a,
    c,
    d,
    dphi,
    dpsi,
    dtheta,
    dx,
    dy,
    dz,
    eq,
    m,
    phi,
    psi,
    theta,
)
from carom.derive.system import Expr, tidy

SIN, COS = sp.sin, sp.cos


def kinematics() -> list[Entry]:
    """(1) to (4), the attitude at the collision, and which of (2) are nonholonomic."""
    spin, energy = k.spin(), k.angle_energy()
    roll = k.rolling()
    names = (k.wx, k.wy, k.wz)
    euler = [
        eq(k.wx, dtheta * COS(psi) + dphi * SIN(theta) * SIN(psi)),
        eq(k.wy, dtheta * SIN(psi) - dphi * SIN(theta) * COS(psi)),
        eq(k.wz, dphi * COS(theta) + dpsi),
    ]
    entries = [
        Entry(
            "1",
            "angular velocity in Euler angles",
            tuple(euler),
            tuple(eq(n, w) for n, w in zip(names, spin, strict=True)),
            steps=(
                Step(
                    "The attitude is R = R_z(psi) R_x(theta) R_z(varphi).",
                    eq(sp.Symbol("R"), k.rotation().xreplace(k.PLACES)),
                ),
                Step("The spin in the fixed frame is the skew part of R' R^T.", sp.Matrix(spin)),
            ),
            note="psi is the precession about the vertical and varphi the spin about the body's axis (often "
            "named the other way).",
        ),
        Entry(
            "s2-1",
            "spin at the moment of collision, varphi = psi = 0, theta = pi/2",
            (eq(k.wx, dtheta), eq(k.wy, -dphi), eq(k.wz, dpsi)),
            tuple(eq(n, w.subs(ATTITUDE)) for n, w in zip(names, spin, strict=True)),
            steps=(Step("Put theta = pi/2, psi = 0 into (1).", sp.Matrix(spin).subs(ATTITUDE)),),
        ),
        Entry(
            "2",
            "rolling on the floor",
            (
                eq(dx, a * (dtheta * SIN(psi) - dphi * SIN(theta) * COS(psi))),
                eq(dy, -a * (dtheta * COS(psi) + dphi * SIN(theta) * SIN(psi))),
                eq(dz, sp.S.Zero),
            ),
            tuple(eq(q, roll[q]) for q in (dx, dy, dz)),
            steps=(
                Step(
                    "Velocity of the ball's lowest point A: d/dt (C + R s), s fixed in the body.",
                    k.point_velocity((0, 0, -a)),
                ),
                Step("It is at rest; solve for the centre's velocity.", sp.Matrix([roll[q] for q in (dx, dy, dz)])),
            ),
        ),
    ]
    floor = frobenius(
        [w.xreplace(k.LIFTED) for w in list(k.floor_rows().values())[:2]], [k.X, k.Y, k.THETA, k.PHI, k.PSI]
    )
    rank, closed = sp.symbols("r_D r_closure")
    entries.append(
        Entry(
            "s2-2",
            "the first two of (2) are nonholonomic",
            (sp.Lt(rank, closed),),
            (eq(rank, floor.growth[0]), eq(closed, floor.growth[-1])),
            steps=(
                Step("Velocities that rolling allows, as vector fields on (x, y, theta, varphi, psi).", floor.fields),
                Step(f"Frobenius: {floor.sentence()}."),
            ),
            note=f"Frobenius' test: {floor.sentence()}. r_D is the rank of the allowed velocities, r_closure with "
            "their brackets.",
        )
    )
    lagrange = tidy(energy.subs(roll))
    entries.append(
        Entry(
            "3",
            "kinetic energy of the rolling ball",
            (
                eq(
                    k.T,
                    (m * a**2 + I) * dtheta**2 / 2
                    + (m * a**2 * SIN(theta) ** 2 + I) * dphi**2 / 2
                    + I * (dpsi**2 + 2 * dphi * dpsi * COS(theta)) / 2,
                ),
            ),
            (eq(k.T, lagrange),),
            steps=(Step("T = m v^2 / 2 + I omega^2 / 2 with (1).", energy), Step("Put (2) in.", lagrange)),
        )
    )
    b_velocity = k.point_velocity((-a, 0, 0))
    vb = sp.symbols("V_Bx V_By V_Bz", real=True)
    turned = sp.Matrix([dx, dy, dz]) + sp.Matrix(names).cross(sp.Matrix([-a, 0, 0]))
    rank_all = k.conventional().redundancy()
    entries.append(
        Entry(
            "4",
            "velocity of the wall's contact point B",
            tuple(eq(v, w) for v, w in zip(vb, turned, strict=True)),
            tuple(eq(v, w) for v, w in zip(vb, b_velocity, strict=True)),
            k.one(dict(zip(vb, b_velocity, strict=True)) | dict(zip(names, spin, strict=True))),
            steps=(
                Step("V_C + omega x CB with CB = (-a, 0, 0).", turned),
                Step("The same from d/dt (C + R s).", b_velocity),
                Step(f"With (2) these are six rows of rank {6 - len(rank_all)}; redundant: {_said(rank_all)}."),
            ),
            note=f"With (2), six constraints of rank {6 - len(rank_all)}: {_said(rank_all)}. The impulses of wall "
            "and floor are "
            "therefore determined only up to one parameter.",
        )
    )
    return entries


def _said(redundant: dict[str, dict[str, Expr]]) -> str:
    return "; ".join(f"[{n}] = " + " + ".join(f"({c})[{o}]" for o, c in how.items()) for n, how in redundant.items())


def integration() -> list[Entry]:
    """(5) to (11): the two constraints in Euler angles and their integrals."""
    free = k.freedom()
    rates = {dtheta: free[dtheta] * dphi, dpsi: free[dpsi] * dphi}
    slope = tidy(free[dpsi] / free[dtheta])  # dpsi/dtheta
    turn = tidy(1 / free[dtheta])  # dvarphi/dtheta
    pole = {theta: ATTITUDE[theta], psi: ATTITUDE[psi]}
    first = -dphi * (SIN(theta) / SIN(psi) + COS(theta))
    second = dphi * SIN(theta) * sp.cot(psi)
    null = Step(
        "The one motion that (2) and (4) allow, per unit varphi', from the null space of all six rows.",
        sp.Matrix([free[dtheta], 1, free[dpsi]]),
    )
    limit = k.both_contacts().displacement_limit(k.PHI.diff(k.TIME), {k.THETA: sp.pi / 2, k.PSI: sp.S.Zero})
    chart = (
        "At the paper's own attitude psi = 0 the allowed motion has varphi' = 0 (its direction there, in "
        f"theta', varphi', psi', is {tuple(limit[3:])}), so varphi' cannot be the independent speed; theta' or "
        "psi' can."
    )
    slope_of, turn_of = sp.Symbol("dpsi/dtheta"), sp.Symbol("dvarphi/dtheta")
    entries = [
        Entry(
            "5",
            "V_B = 0 with rolling, in Euler angles",
            (
                eq(dtheta * SIN(psi) - dphi * SIN(theta) * COS(psi), sp.S.Zero),
                eq(dtheta * COS(psi) + dphi * (SIN(theta) * SIN(psi) + COS(theta)) + dpsi, sp.S.Zero),
            ),
            (eq(dtheta, rates[dtheta]), eq(dpsi, rates[dpsi])),
            steps=(null,),
            note="They say omega_y = 0 and omega_x + omega_z = 0: the ball can only turn about the line through "
            "A and B.",
        ),
        Entry(
            "6",
            "varphi' as independent velocity",
            (eq(dpsi, first), eq(dtheta, second)),
            (eq(dpsi, rates[dpsi]), eq(dtheta, rates[dtheta])),
            attitude=pole,
            steps=(null, Step(chart)),
            note=chart,
        ),
        Entry(
            "7",
            "psi as a function of theta",
            (
                eq(slope_of, -(SIN(theta) / SIN(psi) + COS(theta)) / (SIN(theta) * sp.cot(psi))),
                eq(slope_of, -(1 + sp.cot(theta) * SIN(psi)) / COS(psi)),
            ),
            (eq(slope_of, slope),),
            attitude=pole,
            steps=(null, Step("Divide.", eq(slope_of, slope))),
            note="The first form is 0/0 at psi = 0 but has the limit of the second.",
        ),
    ]
    # (8): with s = sin(psi) the equation is linear, s' + s cot(theta) = -1
    s = sp.Function("s")
    linear = sp.simplify((slope * COS(psi)).subs(SIN(psi), s(theta)))
    constant = sp.Symbol("C1")
    solved = sp.dsolve(sp.Eq(s(theta).diff(theta), sp.expand(linear)), s(theta), hint="1st_linear").rhs
    solved = sp.expand(sp.simplify(solved)).subs(constant, c)
    residual = sp.simplify(solved.diff(theta) - linear.subs(s(theta), solved))
    start = sp.solve(solved.subs(theta, sp.pi / 2) - SIN(ATTITUDE[psi]), c)[0]
    path = sp.simplify(solved.subs(c, start))
    ode = (
        Step("With s = sin psi, (7) is linear.", eq(sp.Derivative(s(theta), theta), linear)),
        Step("Its general solution; put back, the residual is", eq(s(theta), solved)),
        Step("residual", residual),
    )
    entries += [
        Entry(
            "8",
            "the integral of (7)",
            (eq(SIN(psi), (COS(theta) + c) / SIN(theta)),),
            (eq(SIN(psi), solved),),
            steps=ode,
            note="sin(theta) sin(psi) - cos(theta) is the body axis' component along AB, which a turn about AB keeps.",
        ),
        Entry(
            "s2-3",
            "the constant of (8)",
            (eq(c, sp.S.Zero),),
            (eq(c, start),),
            steps=(Step("psi = 0 at theta = pi/2.", eq(c, start)),),
        ),
        Entry(
            "9",
            "psi at the collision",
            (eq(SIN(psi), COS(theta) / SIN(theta)), eq(SIN(psi), sp.cot(theta))),
            (eq(SIN(psi), path),),
            steps=(*ode, Step("With c = 0.", eq(SIN(psi), path))),
        ),
        Entry(
            "10",
            "varphi as a function of theta",
            (eq(turn_of, 1 / (SIN(theta) * sp.cot(psi))),),
            (eq(turn_of, turn),),
            attitude=pole,
            steps=(null, Step("Invert.", eq(turn_of, turn))),
        ),
    ]
    # between (10) and (11); the root is the one with cos(psi) > 0, where psi = 0 lies
    along = turn.subs(psi, sp.asin(path))
    root = sp.sqrt(2 * SIN(theta) ** 2 - 1)
    entries.append(
        Entry(
            "s2-4",
            "d varphi between (10) and (11)",
            (
                eq(turn_of, COS(theta) / (SIN(theta) * root)),
                eq(turn_of, sp.Derivative(SIN(theta), theta) / (SIN(theta) * root)),
            ),
            (eq(turn_of, along),),
            steps=(Step("Put (9) into (10), cos psi > 0.", eq(turn_of, along)),),
            note="The positive root is the branch cos(psi) > 0, where psi = 0 lies.",
        )
    )
    r, u = sp.symbols("r s", positive=True)
    # r = sqrt(2 s^2 - 1), s = sin(theta): dvarphi = ds/(s r) = (ds/dr) dr/(s r)
    s_of_r = sp.sqrt((1 + r**2) / 2)
    integrand = sp.simplify(sp.diff(s_of_r, r) / (s_of_r * r))
    integral = sp.integrate(integrand, r)
    angle = integral.subs(r, root)
    slack = sp.solve(sp.Eq(sp.tan(-u) + 1, 0), u)[0]  # (11) at varphi = 0, theta = pi/2
    steps = (
        Step("With r = sqrt(2 sin^2 theta - 1) the integrand is", integrand),
        Step("so that varphi = atan r + constant.", eq(phi, angle + d - sp.pi / 2)),
        Step("tan(atan r - pi/2) = -1/r.", eq(sp.tan(angle - sp.pi / 2), sp.simplify(sp.tan(angle - sp.pi / 2)))),
    )
    entries += [
        Entry(
            "11",
            "the integral of (10)",
            (eq(sp.tan(phi - d) + 1 / root, sp.S.Zero),),
            (eq(phi, angle + d - sp.pi / 2),),
            steps=steps,
            note="varphi has its extreme value at theta = pi/2, where varphi' = 0: (11) is even in theta - pi/2.",
        ),
        Entry(
            "s2-5",
            "the constant of (11)",
            (eq(d, sp.pi / 4),),
            (eq(d, slack),),
            steps=(Step("varphi = 0 at theta = pi/2: tan(-d) + 1 = 0.", eq(d, slack)),),
            note="Modulo pi.",
        ),
        _integrable(),
    ]
    return entries


def _integrable() -> Entry:
    """The claim that the constraints are integrable, in the paper's case and where fewer velocities are tied."""
    both = frobenius(
        [w.xreplace(k.LIFTED) for w in (*k.floor_rows().values(), *k.wall_rows().values())],
        [k.X, k.Y, k.Z, k.THETA, k.PHI, k.PSI],
    )
    wall = frobenius([w.xreplace(k.LIFTED) for w in k.wall_rows().values()], [k.X, k.Y, k.Z, k.THETA, k.PHI, k.PSI])
    rank, closed = sp.symbols("r_D r_closure")

    def facts(test: Any) -> dict[Expr, Expr]:
        return {rank: sp.Integer(test.growth[0]), closed: sp.Integer(test.growth[-1])}

    return Entry(
        "s2-6",
        "the instantaneous constraints are integrable",
        (eq(closed, rank),),
        (eq(rank, both.growth[0]), eq(closed, both.growth[-1])),
        (
            Branch("with rolling at the floor and the wall at once (one freedom is left)", facts(both)),
            Branch("with rolling at one contact alone, as in the paper's own two-step model", facts(wall)),
        ),
        steps=(Step(f"Floor and wall: {both.sentence()}."), Step(f"Wall alone: {wall.sentence()}.")),
        note=f"Floor and wall: {both.sentence()}. So it rests on counting freedoms, not on these constraints. "
        f"Wall alone: {wall.sentence()}.",
    )


# ----------------------------------------------------------------------------------------------------
# Section 2 of the paper, the conventional impact: equations (12) to (26).


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
    printed14 = [
        eq(t_by, slope[1] - slope[2] * (SIN(theta) / SIN(psi) + COS(theta)) + slope[0] * SIN(theta) * sp.cot(psi)),
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
    left, rolling_left = sp.Integer(motion.virtual_displacements().cols), sp.Integer(6 - len(motion.pre_relations))
    return [
        Entry(
            "12",
            "virtual displacements",
            (eq(ds, -dp * (SIN(theta) / SIN(psi) + COS(theta))), eq(dt, dp * SIN(theta) * sp.cot(psi))),
            (eq(ds, moved[ds]), eq(dt, moved[dt])),
            attitude=pole,
            steps=(Step("The null space of all six rows, per unit delta varphi.", direction),),
        ),
        Entry(
            "13",
            "the momentum along the virtual displacement does not jump",
            (eq(p1, p0),),
            (eq(p1, start),),
            k.one({p0: start, p1: start + work}),
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
            steps=(
                Step("Angular momentum about the line AB.", eq(law, sp.S.Zero)),
                Step("with y' = -a omega_x.", eq(k.wz1, tidy(spins))),
            ),
        ),
        Entry(
            "s2-7",
            "(17) alone does not determine the state afterwards",
            (sp.Lt(given, unknown),),
            (eq(given, left), eq(unknown, rolling_left)),
            steps=(
                Step("Freedoms of the two contacts together.", left),
                Step("Freedoms of the rolling ball.", rolling_left),
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
    returned = poisson.after[k.X.diff(k.TIME)]
    t_i = sp.Symbol("T_i")
    spin_form = tidy(k.angle_energy().subs(dz, 0))
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
            k.one(rolls),
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
            (eq(k.x1, returned),),
            steps=(
                Step("Poisson's rule: (1 + e) times the normal impulse of compression.", poisson.impulses["B.n"]),
                Step("gives the same, since a ball's normal impulse makes no spin.", eq(k.x1, returned)),
            ),
            note="For a ball the rules of Newton, Poisson and Stronge agree, so that the hypothesis is one on "
            "the material alone.",
        ),
        Entry(
            "20",
            "kinetic energy",
            (eq(t_i, m * (dx**2 + dy**2) / 2 + I * (k.wx**2 + k.wy**2 + k.wz**2) / 2),),
            (eq(t_i, spin_form),),
            k.one({t_i: spin_form} | dict(zip((k.wx, k.wy, k.wz), k.spin(), strict=True))),
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
    numbers = {k.y0: 1, k.wz0: 0, k.x0: -1, a: 1, m: 1, I: sp.Rational(2, 5), k.e: half}
    real = [r for root in roots if (r := root.subs(numbers)).is_real]
    broken = [tidy(r) for r in sp.solve(square.subs({k.x0: -k.u0, k.e: half}), delta)]
    roots_text = ", ".join(str(sp.N(r, 6)) for r in real)
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
    kappa = sp.Symbol("kappa", positive=True)
    limits = [sp.limit(reversed_[q].subs(I, kappa * m * a**2), kappa, 0) for q in (k.y1, k.wz1)]
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
            (Branch("in general", {k.e: half if real else forced}),),
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
            k.one(before),
            steps=(Step("(2) in spins.", None),),
        ),
        Entry(
            "24",
            "velocity of B before",
            (eq(vb0[0], k.x0), eq(vb0[1], k.y0), eq(vb0[2], k.x0)),
            tuple(eq(q, v) for q, v in plain.items()),
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
