"""Integration steps for two simultaneous contacts: explicit, and implicit for stiff (creeping) slips.

Between events the flow is smooth, and steps of order 8 can be long. The flow is stiff where a slip is small compared with
the friction that turns it: a slip that vanishes slowly, or one that starts where friction just fails to hold the contact.
Its direction then adjusts at once to the motion of the ball, which explicit steps resolve only if they are very short.
"""

from __future__ import annotations

import math

from carom.core.contact import SLIDE, STICK
from carom.core.jit.kernel import kernel, steepest, without_slopes
from carom.laws.wall_and_floor.rates import FLOOR_SLIP, Couplings, Pair, Slips, rates, size

__all__ = ["creep", "hop", "mix", "steepest_of", "stride", "without_slopes_of"]

ORDER = 6  # of the extrapolation in `creep`


@kernel
def mix(y: Slips, h: float, a: float, p: Slips, b: float, q: Slips, c: float, r: Slips) -> Slips:
    """y + h (a p + b q + c r)."""
    return (
        y[0] + h * (a * p[0] + b * q[0] + c * r[0]),
        y[1] + h * (a * p[1] + b * q[1] + c * r[1]),
        y[2] + h * (a * p[2] + b * q[2] + c * r[2]),
        y[3] + h * (a * p[3] + b * q[3] + c * r[3]),
        y[4] + h * (a * p[4] + b * q[4] + c * r[4]),
    )


@kernel
def hop(y: Slips, k1: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float) -> Slips:
    """Take a short step by the classical Runge-Kutta method of order 4."""
    k2, _spare = rates(mix(y, h, 1 / 2, k1, 0, k1, 0, k1), q, wall, floor, dw, df, tiny)
    k3, _spare = rates(mix(y, h, 1 / 2, k2, 0, k1, 0, k1), q, wall, floor, dw, df, tiny)
    k4, _spare = rates(mix(y, h, 1, k3, 0, k1, 0, k1), q, wall, floor, dw, df, tiny)
    return mix(mix(y, h, 1 / 6, k1, 1 / 3, k2, 1 / 3, k3), h, 1 / 6, k4, 0, k1, 0, k1)


@kernel
def stride(
    y: Slips, k1: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float
) -> tuple[Slips, float, float]:
    """Take one step of Dormand & Prince 8(5,3) (Hairer, Norsett & Wanner, Solving ODEs I, II.5) from y with rates k1.

    Returns its error, and that of its derivatives (of order 5).
    """
    x = mix(y, h, 0.05260015195876773, k1, 0, k1, 0, k1)
    k2, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.0197250569845379, k1, 0.0591751709536137, k2, 0, k1)
    k3, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.02958758547680685, k1, 0.08876275643042054, k3, 0, k1)
    k4, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.2413651341592667, k1, -0.8845494793282861, k3, 0.924834003261792, k4)
    k5, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.037037037037037035, k1, 0.17082860872947386, k4, 0.12546768756682242, k5)
    k6, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.037109375, k1, 0.17025221101954405, k4, 0.06021653898045596, k5)
    x = mix(x, h, -0.017578125, k6, 0, k6, 0, k6)
    k7, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.03709200011850479, k1, 0.17038392571223998, k4, 0.10726203044637328, k5)
    x = mix(x, h, -0.015319437748624402, k6, 0.008273789163814023, k7, 0, k6)
    k8, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.6241109587160757, k1, -3.3608926294469414, k4, -0.868219346841726, k5)
    x = mix(x, h, 27.59209969944671, k6, 20.154067550477894, k7, -43.48988418106996, k8)
    k9, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.47766253643826434, k1, -2.4881146199716677, k4, -0.590290826836843, k5)
    x = mix(x, h, 21.230051448181193, k6, 15.279233632882423, k7, -33.28821096898486, k8)
    x = mix(x, h, -0.020331201708508627, k9, 0, k9, 0, k9)
    k10, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, -0.9371424300859873, k1, 5.186372428844064, k4, 1.0914373489967295, k5)
    x = mix(x, h, -8.149787010746927, k6, -18.52006565999696, k7, 22.739487099350505, k8)
    x = mix(x, h, 2.4936055526796523, k9, -3.0467644718982196, k10, 0, k9)
    k11, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 2.273310147516538, k1, -10.53449546673725, k4, -2.0008720582248625, k5)
    x = mix(x, h, -17.9589318631188, k6, 27.94888452941996, k7, -2.8589982771350235, k8)
    x = mix(x, h, -8.87285693353063, k9, 12.360567175794303, k10, 0.6433927460157636, k11)
    k12, _spare = rates(x, q, wall, floor, dw, df, tiny)
    x = mix(y, h, 0.054293734116568765, k1, 4.450312892752409, k6, 1.8915178993145003, k7)
    x = mix(x, h, -5.801203960010585, k8, 0.3111643669578199, k9, -0.1521609496625161, k10)
    x = mix(x, h, 0.20136540080403034, k11, 0.04471061572777259, k12, 0, k11)
    zero = 0 * h
    nought = (zero, zero, zero, zero, zero)
    fifth = mix(nought, h, 0.01312004499419488, k1, -1.2251564463762044, k6, -0.4957589496572502, k7)
    fifth = mix(fifth, h, 1.6643771824549864, k8, -0.35032884874997366, k9, 0.3341791187130175, k10)
    fifth = mix(fifth, h, 0.08192320648511571, k11, -0.022355307863886294, k12, 0, k11)
    third = mix(nought, h, -0.18980075407240762, k1, 4.450312892752409, k6, 1.8915178993145003, k7)
    third = mix(third, h, -5.801203960010585, k8, -0.4226823213237919, k9, -0.1521609496625161, k10)
    third = mix(third, h, 0.20136540080403034, k11, 0.02265179219836082, k12, 0, k11)
    e5 = size(size(fifth[0], fifth[1]), size(fifth[2], fifth[3]))
    e3 = size(size(third[0], third[1]), size(third[2], third[3]))
    whole = math.sqrt(e5 * e5 + e3 * e3 / 100)
    return x, e5 * e5 / whole if whole > 0 else zero, steepest_of(fifth)


@kernel
def steepest_of(y: Slips) -> float:
    """Return the largest derivative of slips and energy; 0 of plain numbers."""
    return max(steepest(y[0]), steepest(y[1]), steepest(y[2]), steepest(y[3]), steepest(y[4]))


@kernel
def without_slopes_of(y: Slips) -> Slips:
    """Return the values of slips and energy, or of their rates."""
    return without_slopes(y[0]), without_slopes(y[1]), without_slopes(y[2]), without_slopes(y[3]), without_slopes(y[4])


@kernel
def _turned(q: Couplings, wall: int, floor: int, push: float, dw: Pair, df: Pair, at_wall: bool) -> Slips:
    """Derivative of the rates with respect to the direction of one slip."""
    c, _m, b, k, d, e, _drive, muw, muf, _heed = q
    zero = 0 * c
    if at_wall:
        ft, fy = muw * dw[1], -muw * dw[0]
        gx, gy = e * ft / k, -d / k * fy
        if floor == FLOOR_SLIP:
            gx, gy = muf * c * ft * df[0], muf * c * ft * df[1]
    else:
        gx, gy = muf * push * df[1], -muf * push * df[0]
        ft, fy = zero, zero
        if wall == STICK:
            more = -e * muf * c * df[1] * push / (b - e * muf * c * df[0])
            gx, gy = gx - muf * more * df[0], gy - muf * more * df[1]
            ft, fy = e * gx / b, -d / k * gy
    return b * ft - e * gx, k * fy + d * gy, k * gx - e * ft, d * fy + k * gy, zero


@kernel
def _implicit(
    y: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair
) -> tuple[Slips, Pair, Pair, bool]:
    """Take an implicit Euler step, solved by Newton's method for the directions of the slips."""
    c, m, b, k, _d, e, drive, muw, muf, heed = q
    one = 1 + 0 * h
    new, found = y, False
    for _ in range(20):
        now, _spare = rates(y, q, wall, floor, dw, df, math.inf)
        new = (y[0] + h * now[0], y[1] + h * now[1], y[2] + h * now[2], y[3] + h * now[3], y[4])
        if found:
            break
        push = -(m * drive - c * muw * dw[0]) if wall == SLIDE else -m * drive * k / (b - e * muf * c * df[0])
        r1 = r2 = a12 = a21 = 0 * h
        a11 = a22 = one
        if wall == SLIDE:
            r1 = dw[0] * new[1] - dw[1] * new[0]
            a = _turned(q, wall, floor, push, dw, df, True)
            a11 = h * (dw[0] * a[1] - dw[1] * a[0]) - dw[0] * new[0] - dw[1] * new[1]
            if floor == FLOOR_SLIP:
                a21 = h * (df[0] * a[3] - df[1] * a[2])
        if floor == FLOOR_SLIP:
            r2 = df[0] * new[3] - df[1] * new[2]
            a = _turned(q, wall, floor, push, dw, df, False)
            a22 = h * (df[0] * a[3] - df[1] * a[2]) - df[0] * new[2] - df[1] * new[3]
            if wall == SLIDE:
                a12 = h * (dw[0] * a[1] - dw[1] * a[0])
        det = a11 * a22 - a12 * a21
        if det == 0:
            break
        t1 = max(-one, min(one, (a12 * r2 - a22 * r1) / det))
        t2 = max(-one, min(one, (a21 * r1 - a11 * r2) / det))
        long = size(one, t1)
        dw = ((dw[0] - t1 * dw[1]) / long, (dw[1] + t1 * dw[0]) / long)
        long = size(one, t2)
        df = ((df[0] - t2 * df[1]) / long, (df[1] + t2 * df[0]) / long)
        found = abs(t1) + abs(t2) < 1e-14
    # the energy changes with u_n at the end of the step
    new = (new[0], new[1], new[2], new[3], y[4] - h * heed * c / (1 - m) * (new[0] + new[2]))
    ahead = (wall != SLIDE or dw[0] * new[0] + dw[1] * new[1] > 0) and (
        floor != FLOOR_SLIP or df[0] * new[2] + df[1] * new[3] > 0
    )
    return new, dw, df, found and ahead


@kernel
def creep(
    y: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float
) -> tuple[Slips, float, float, bool]:
    """Take an implicit Euler step extrapolated from 1 to 6 substeps; return its error, that of its derivatives, and False if
    it does not converge.

    dw and df are the directions in which a slip starts from zero.
    """
    zero = 0 * h
    slip = size(y[0], y[1])
    if slip > tiny:
        dw = (y[0] / slip, y[1] / slip)
    slip = size(y[2], y[3])
    if slip > tiny:
        df = (y[2] / slip, y[3] / slip)
    sums = less = (zero, zero, zero, zero, zero)
    for j in range(1, ORDER + 1):
        new, a, b = y, dw, df
        for _ in range(j):
            new, a, b, goes = _implicit(new, h / j, q, wall, floor, a, b)
            if not goes:
                return y, math.inf, 0.0, False
        weight = 1 + zero
        for i in range(2, ORDER + 1):
            if i != j:
                weight = weight * j / (j - i)
        if j > 1:
            less = mix(less, weight, 1, new, 0, new, 0, new)
            weight = weight * j / (j - 1)
        else:
            weight = 1 + zero
            for i in range(2, ORDER + 1):
                weight = weight / (1 - i)
        sums = mix(sums, weight, 1, new, 0, new, 0, new)
    wrong = (sums[0] - less[0], sums[1] - less[1], sums[2] - less[2], sums[3] - less[3], sums[4] - less[4])
    return sums, size(size(wrong[0], wrong[1]), size(wrong[2], wrong[3])), steepest_of(wrong), True
