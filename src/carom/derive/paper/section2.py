"""Section 2 of the paper, its kinematics: equations (1) to (11)."""

from __future__ import annotations

from typing import Any

import sympy as sp

from carom.derive.integrability import frobenius
from carom.derive.linear import Expr, tidy
from carom.derive.paper import model as k
from carom.derive.paper.ledger import Branch, Entry, Step
from carom.derive.paper.model import ATTITUDE, I, a, c, d, dphi, dpsi, dtheta, dx, dy, dz, eq, m, phi, psi, theta

SIN, COS = sp.sin, sp.cos


def one(facts: dict[Expr, Expr]) -> tuple[Branch, ...]:
    """A single case without a name."""
    return (Branch("", facts),)


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
            one(dict(zip(names, spin, strict=True))),
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
            one({n: w.subs(ATTITUDE) for n, w in zip(names, spin, strict=True)}),
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
            one(roll),
            steps=(
                Step(
                    "Velocity of the ball's lowest point A: d/dt (C + R s), s fixed in the body.",
                    k.point_velocity((0, 0, -a)),
                ),
                Step("It is at rest; solve for the centre's velocity.", sp.Matrix([roll[q] for q in (dx, dy, dz)])),
            ),
        ),
    ]
    floor = frobenius([w.xreplace(_up()) for w in list(k.floor_rows().values())[:2]], [k.X, k.Y, k.THETA, k.PHI, k.PSI])
    rank, closed = sp.symbols("r_D r_closure")
    entries.append(
        Entry(
            "s2-2",
            "the first two of (2) are nonholonomic",
            (sp.Lt(rank, closed),),
            (eq(rank, floor.growth[0]), eq(closed, floor.growth[-1])),
            one({rank: sp.Integer(floor.growth[0]), closed: sp.Integer(floor.growth[-1])}),
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
            one({k.T: lagrange}),
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
            one(dict(zip(vb, b_velocity, strict=True)) | dict(zip(names, spin, strict=True))),
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


def _up() -> dict[Expr, Expr]:
    back = {v: q for q, v in k.RATES.items()} | {v: q for q, v in k.PLACES.items()}
    return back | {dx: k.X.diff(k.TIME), dy: k.Y.diff(k.TIME), dz: k.Z.diff(k.TIME)}


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
            one(rates),
            steps=(null,),
            note="They say omega_y = 0 and omega_x + omega_z = 0: the ball can only turn about the line through "
            "A and B.",
        ),
        Entry(
            "6",
            "varphi' as independent velocity",
            (eq(dpsi, first), eq(dtheta, second)),
            (eq(dpsi, rates[dpsi]), eq(dtheta, rates[dtheta])),
            one(rates),
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
            one({slope_of: slope}),
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
            one({psi: sp.asin(solved)}),
            steps=ode,
            note="sin(theta) sin(psi) - cos(theta) is the body axis' component along AB, which a turn about AB keeps.",
        ),
        Entry(
            "s2-3",
            "the constant of (8)",
            (eq(c, sp.S.Zero),),
            (eq(c, start),),
            one({c: start}),
            steps=(Step("psi = 0 at theta = pi/2.", eq(c, start)),),
        ),
        Entry(
            "9",
            "psi at the collision",
            (eq(SIN(psi), COS(theta) / SIN(theta)), eq(SIN(psi), sp.cot(theta))),
            (eq(SIN(psi), path),),
            one({psi: sp.asin(path)}),
            steps=(*ode, Step("With c = 0.", eq(SIN(psi), path))),
        ),
        Entry(
            "10",
            "varphi as a function of theta",
            (eq(turn_of, 1 / (SIN(theta) * sp.cot(psi))),),
            (eq(turn_of, turn),),
            one({turn_of: turn}),
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
            one({turn_of: along}),
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
            one({phi: angle + d - sp.pi / 2}),
            steps=steps,
            note="varphi has its extreme value at theta = pi/2, where varphi' = 0: (11) is even in theta - pi/2.",
        ),
        Entry(
            "s2-5",
            "the constant of (11)",
            (eq(d, sp.pi / 4),),
            (eq(d, slack),),
            one({d: slack}),
            steps=(Step("varphi = 0 at theta = pi/2: tan(-d) + 1 = 0.", eq(d, slack)),),
            note="Modulo pi.",
        ),
        _integrable(),
    ]
    return entries


def _integrable() -> Entry:
    """The claim that the constraints are integrable, in the paper's case and where fewer velocities are tied."""
    up = _up()
    both = frobenius(
        [w.xreplace(up) for w in (*k.floor_rows().values(), *k.wall_rows().values())],
        [k.X, k.Y, k.Z, k.THETA, k.PHI, k.PSI],
    )
    wall = frobenius([w.xreplace(up) for w in k.wall_rows().values()], [k.X, k.Y, k.Z, k.THETA, k.PHI, k.PSI])
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
