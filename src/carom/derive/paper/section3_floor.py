"""Section 3 of the paper, the second impact: equations (34) to (39)."""

from __future__ import annotations

import sympy as sp

from carom.derive.linear import is_zero, tidy
from carom.derive.paper import model as k
from carom.derive.paper.ledger import Entry, Step
from carom.derive.paper.model import ATTITUDE, I, a, dphi, dpsi, dtheta, dx, dy, dz, eq, m, psi, theta
from carom.derive.paper.section3 import one, parts


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
    depends = any(v.has(k.z1) for v in facts.values())
    lines = tuple(Step("", q) for q in derived37)
    third = "The third line has omega_z2 on both sides, whether by the press or by the scan; (39) shows what is meant"
    landing = "enters" if depends else "does not enter"
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
            one({k.T: energy}),
            steps=(Step("m v^2 / 2 + I omega^2 / 2 with (1).", energy),),
        ),
        *parts(
            "35",
            "momenta along rolling displacements",
            printed35,
            [eq(q, v) for q, v in zip(p, chain, strict=True)],
            dict(zip(p, chain, strict=True)),
            steps=(Step("Chain rule with (2).", sp.Matrix(chain)),),
        ),
        Entry(
            "36",
            "they do not jump",
            tuple(eq(q, r) for q, r in zip(p1, p2, strict=True)),
            tuple(eq(q, r) for q, r in zip(p1, p2, strict=True)),
            one(dict(zip(p2, [q + w for q, w in zip(p1, work, strict=True)], strict=True))),
            steps=(Step("The work of the floor's impulse along rolling displacements.", work),),
        ),
        *parts(
            "37",
            "the same in spins",
            momenta,
            derived37,
            facts,
            steps=(Step("(35) at varphi = psi = 0, theta = pi/2, (36):", None), *lines),
            note=third,
            line_notes={2: third},
        ),
        *parts(
            "38",
            "rolling after the second impact",
            rolling2,
            rolling2,
            facts,
            steps=(Step("(2) in spins.", None),),
            note="The scan reads y^2 for the subscripts y2; taken as the scan's slip.",
        ),
        *parts(
            "39",
            "state after the second impact",
            answer,
            [eq(q.lhs, facts[q.lhs]) for q in answer],
            facts,
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
