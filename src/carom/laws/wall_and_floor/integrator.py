"""Integration steps for two simultaneous contacts: explicit, and implicit for stiff (creeping) slips.

Between events the flow is smooth, and steps of order 8 can be long. The flow is stiff where a slip is small compared with
the friction that turns it: a slip that vanishes slowly, or one that starts where friction just fails to hold the contact.
Its direction then adjusts at once to the motion of the ball, which explicit steps resolve only if they are very short.
"""

from __future__ import annotations

import math

from carom.core.contact import SLIDE, STICK
from carom.core.jit.kernel import kernel, steepest, without_slopes
from carom.laws.wall_and_floor.dormand_prince import A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, E3, E5, B
from carom.laws.wall_and_floor.rates import FLOOR_SLIP, Couplings, Pair, Slips, norm, pressed_rates

__all__ = [
    "combination", "dormand_prince_step", "extrapolated_euler_step", "runge_kutta_step", "steepest_of", "without_slopes_of",
]  # fmt: skip

ORDER = 6  # of the extrapolation in `extrapolated_euler_step`


@kernel
def combination(y: Slips, h: float, a: float, p: Slips, b: float, q: Slips, c: float, r: Slips) -> Slips:
    """y + h (a p + b q + c r)."""
    return (
        y[0] + h * (a * p[0] + b * q[0] + c * r[0]),
        y[1] + h * (a * p[1] + b * q[1] + c * r[1]),
        y[2] + h * (a * p[2] + b * q[2] + c * r[2]),
        y[3] + h * (a * p[3] + b * q[3] + c * r[3]),
        y[4] + h * (a * p[4] + b * q[4] + c * r[4]),
    )


@kernel
def runge_kutta_step(
    y: Slips, k1: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float
) -> Slips:
    """Take a short step by the classical Runge-Kutta method of order 4."""
    k2, _spare = pressed_rates(combination(y, h, 1 / 2, k1, 0, k1, 0, k1), q, wall, floor, dw, df, tiny)
    k3, _spare = pressed_rates(combination(y, h, 1 / 2, k2, 0, k1, 0, k1), q, wall, floor, dw, df, tiny)
    k4, _spare = pressed_rates(combination(y, h, 1, k3, 0, k1, 0, k1), q, wall, floor, dw, df, tiny)
    return combination(combination(y, h, 1 / 6, k1, 1 / 3, k2, 1 / 3, k3), h, 1 / 6, k4, 0, k1, 0, k1)


@kernel
def dormand_prince_step(
    y: Slips, k1: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float
) -> tuple[Slips, float, float]:
    """Take one step of Dormand & Prince 8(5,3) (Hairer, Norsett & Wanner, Solving ODEs I, II.5) from y with rates k1.

    Returns its error, and the error of its derivatives (of order 5).
    """
    x = combination(y, h, A2[1], k1, 0, k1, 0, k1)
    k2, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A3[1], k1, A3[2], k2, 0, k1)
    k3, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A4[1], k1, A4[3], k3, 0, k1)
    k4, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A5[1], k1, A5[3], k3, A5[4], k4)
    k5, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A6[1], k1, A6[4], k4, A6[5], k5)
    k6, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A7[1], k1, A7[4], k4, A7[5], k5)
    x = combination(x, h, A7[6], k6, 0, k6, 0, k6)
    k7, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A8[1], k1, A8[4], k4, A8[5], k5)
    x = combination(x, h, A8[6], k6, A8[7], k7, 0, k6)
    k8, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A9[1], k1, A9[4], k4, A9[5], k5)
    x = combination(x, h, A9[6], k6, A9[7], k7, A9[8], k8)
    k9, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A10[1], k1, A10[4], k4, A10[5], k5)
    x = combination(x, h, A10[6], k6, A10[7], k7, A10[8], k8)
    x = combination(x, h, A10[9], k9, 0, k9, 0, k9)
    k10, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A11[1], k1, A11[4], k4, A11[5], k5)
    x = combination(x, h, A11[6], k6, A11[7], k7, A11[8], k8)
    x = combination(x, h, A11[9], k9, A11[10], k10, 0, k9)
    k11, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, A12[1], k1, A12[4], k4, A12[5], k5)
    x = combination(x, h, A12[6], k6, A12[7], k7, A12[8], k8)
    x = combination(x, h, A12[9], k9, A12[10], k10, A12[11], k11)
    k12, _spare = pressed_rates(x, q, wall, floor, dw, df, tiny)
    x = combination(y, h, B[1], k1, B[6], k6, B[7], k7)
    x = combination(x, h, B[8], k8, B[9], k9, B[10], k10)
    x = combination(x, h, B[11], k11, B[12], k12, 0, k11)
    zero = 0 * h
    nought = (zero, zero, zero, zero, zero)
    fifth = combination(nought, h, E5[1], k1, E5[6], k6, E5[7], k7)
    fifth = combination(fifth, h, E5[8], k8, E5[9], k9, E5[10], k10)
    fifth = combination(fifth, h, E5[11], k11, E5[12], k12, 0, k11)
    third = combination(nought, h, E3[1], k1, B[6], k6, B[7], k7)
    third = combination(third, h, B[8], k8, E3[9], k9, B[10], k10)
    third = combination(third, h, B[11], k11, E3[12], k12, 0, k11)
    e5 = norm(norm(fifth[0], fifth[1]), norm(fifth[2], fifth[3]))
    e3 = norm(norm(third[0], third[1]), norm(third[2], third[3]))
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
def _rates_by_direction(q: Couplings, wall: int, floor: int, push: float, dw: Pair, df: Pair, at_wall: bool) -> Slips:
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
def _implicit_euler_step(
    y: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair
) -> tuple[Slips, Pair, Pair, bool]:
    """Take an implicit Euler step, solved by Newton's method for the directions of the slips."""
    c, m, b, k, _d, e, drive, muw, muf, heed = q
    one = 1 + 0 * h
    new, found = y, False
    for _ in range(20):
        now, _spare = pressed_rates(y, q, wall, floor, dw, df, math.inf)
        new = (y[0] + h * now[0], y[1] + h * now[1], y[2] + h * now[2], y[3] + h * now[3], y[4])
        if found:
            break
        push = -(m * drive - c * muw * dw[0]) if wall == SLIDE else -m * drive * k / (b - e * muf * c * df[0])
        r1 = r2 = a12 = a21 = 0 * h
        a11 = a22 = one
        if wall == SLIDE:
            r1 = dw[0] * new[1] - dw[1] * new[0]
            a = _rates_by_direction(q, wall, floor, push, dw, df, True)
            a11 = h * (dw[0] * a[1] - dw[1] * a[0]) - dw[0] * new[0] - dw[1] * new[1]
            if floor == FLOOR_SLIP:
                a21 = h * (df[0] * a[3] - df[1] * a[2])
        if floor == FLOOR_SLIP:
            r2 = df[0] * new[3] - df[1] * new[2]
            a = _rates_by_direction(q, wall, floor, push, dw, df, False)
            a22 = h * (df[0] * a[3] - df[1] * a[2]) - df[0] * new[2] - df[1] * new[3]
            if wall == SLIDE:
                a12 = h * (dw[0] * a[1] - dw[1] * a[0])
        det = a11 * a22 - a12 * a21
        if det == 0:
            break
        t1 = max(-one, min(one, (a12 * r2 - a22 * r1) / det))
        t2 = max(-one, min(one, (a21 * r1 - a11 * r2) / det))
        long = norm(one, t1)
        dw = ((dw[0] - t1 * dw[1]) / long, (dw[1] + t1 * dw[0]) / long)
        long = norm(one, t2)
        df = ((df[0] - t2 * df[1]) / long, (df[1] + t2 * df[0]) / long)
        found = abs(t1) + abs(t2) < 1e-14
    # the energy changes with u_n at the end of the step
    new = (new[0], new[1], new[2], new[3], y[4] - h * heed * c / (1 - m) * (new[0] + new[2]))
    ahead = (wall != SLIDE or dw[0] * new[0] + dw[1] * new[1] > 0) and (
        floor != FLOOR_SLIP or df[0] * new[2] + df[1] * new[3] > 0
    )
    return new, dw, df, found and ahead


@kernel
def extrapolated_euler_step(
    y: Slips, h: float, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float
) -> tuple[Slips, float, float, bool]:
    """Take an implicit Euler step extrapolated from 1 to 6 substeps; return its error, the error of its derivatives, and False if
    it does not converge.

    dw and df are the directions in which a slip starts from zero.
    """
    zero = 0 * h
    slip = norm(y[0], y[1])
    if slip > tiny:
        dw = (y[0] / slip, y[1] / slip)
    slip = norm(y[2], y[3])
    if slip > tiny:
        df = (y[2] / slip, y[3] / slip)
    sums = less = (zero, zero, zero, zero, zero)
    for j in range(1, ORDER + 1):
        new, a, b = y, dw, df
        for _ in range(j):
            new, a, b, goes = _implicit_euler_step(new, h / j, q, wall, floor, a, b)
            if not goes:
                return y, math.inf, 0.0, False
        weight = 1 + zero
        for i in range(2, ORDER + 1):
            if i != j:
                weight = weight * j / (j - i)
        if j > 1:
            less = combination(less, weight, 1, new, 0, new, 0, new)
            weight = weight * j / (j - 1)
        else:
            weight = 1 + zero
            for i in range(2, ORDER + 1):
                weight = weight / (1 - i)
        sums = combination(sums, weight, 1, new, 0, new, 0, new)
    wrong = (sums[0] - less[0], sums[1] - less[1], sums[2] - less[2], sums[3] - less[3], sums[4] - less[4])
    return sums, norm(norm(wrong[0], wrong[1]), norm(wrong[2], wrong[3])), steepest_of(wrong), True
