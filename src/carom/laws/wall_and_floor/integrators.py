"""The coefficients of Dormand & Prince's step of order 8(5,3), which has twelve stages.

Source: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I (1993), II.5 and II.10: the program DOP853, rounded
to floats. Place j of each row is the weight of the rate k_j at stage j; place 0 is not used.
"""

from __future__ import annotations

import math

from carom.core.contact import SLIDE, STICK
from carom.core.jit.kernel import carries_slopes, hot_kernel, kernel, steepest, without_slopes
from carom.laws.wall_and_floor.rates import FLOOR_SLIP, LEVEL, Couplings, Pair, Slips, norm, pressed_rates

# Where in a step each stage lies
C = (
    0.0, 0.0, 0.05260015195876773, 0.0789002279381516, 0.1183503419072274, 0.2816496580927726, 0.3333333333333333, 0.25,
    0.3076923076923077, 0.6512820512820513, 0.6, 0.8571428571428571,
)  # fmt: skip

# The weights with which the rates so far lead to stage 2 ... 12
A2 = (0.0, 0.05260015195876773)
A3 = (0.0, 0.0197250569845379, 0.0591751709536137)
A4 = (0.0, 0.02958758547680685, 0.0, 0.08876275643042054)
A5 = (0.0, 0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792)
A6 = (0.0, 0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242)
A7 = (0.0, 0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125)
A8 = (
    0.0, 0.03709200011850479, 0.0, 0.0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023,
)  # fmt: skip
A9 = (
    0.0, 0.6241109587160757, 0.0, 0.0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894,
    -43.48988418106996,
)  # fmt: skip
A10 = (
    0.0, 0.47766253643826434, 0.0, 0.0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423,
    -33.28821096898486, -0.020331201708508627,
)  # fmt: skip
A11 = (
    0.0, -0.9371424300859873, 0.0, 0.0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696,
    22.739487099350505, 2.4936055526796523, -3.0467644718982196,
)  # fmt: skip
A12 = (
    0.0, 2.273310147516538, 0.0, 0.0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996,
    -2.8589982771350235, -8.87285693353063, 12.360567175794303, 0.6433927460157636,
)  # fmt: skip

# The weights with which they lead to the end of the step
B = (
    0.0, 0.054293734116568765, 0.0, 0.0, 0.0, 0.0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
    0.3111643669578199, -0.1521609496625161, 0.20136540080403034, 0.04471061572777259,
)  # fmt: skip

# The weights of the two estimates of the error: of order 5, and of order 3
E5 = (
    0.0, 0.01312004499419488, 0.0, 0.0, 0.0, 0.0, -1.2251564463762044, -0.4957589496572502, 1.6643771824549864,
    -0.35032884874997366, 0.3341791187130175, 0.08192320648511571, -0.022355307863886294,
)  # fmt: skip
E3 = (
    0.0, -0.18980075407240762, 0.0, 0.0, 0.0, 0.0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
    -0.4226823213237919, -0.1521609496625161, 0.20136540080403034, 0.02265179219836082,
)  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# Integration steps for two simultaneous contacts: explicit, and implicit for stiff (creeping) slips.
#
# Between events the flow is smooth, and steps of order 8 can be long. The flow is stiff where a slip is small compared with
# the friction that turns it: a slip that vanishes slowly, or one that starts where friction just fails to hold the contact.
# Its direction then adjusts at once to the motion of the ball, which explicit steps resolve only if they are very short.


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


# ----------------------------------------------------------------------------------------------------
# Branch-free integrator for simultaneous sliding at wall and floor, the usual case of a pressed ball.
#
# The slips u at the wall and f at the floor change at rates that depend on their directions only, so the smoothness of the flow
# in the wall's impulse P depends on their lengths: it has branch points where u.u or f.f vanish, at complex P at most |u|/|u'|
# away. In the variable s with dP = ds / (A/|u| + B/|f|) these are farther away (a slip that passes zero at a distance b on a
# straight line is b cosh s), and a step of order 8 can be several times as long. The ends are reached exactly by a change of the
# independent variable in the last step (Henon, Physica D 5, 412 (1982)): to u_n in compression, which ends at 0; in restitution
# to w, with w^2 / 2 the energy returned. Both can be used from the start, so a ball whose slips turn little takes three steps in
# all.
#
# A slip that is about to vanish takes steps of another variable, :func:`vanishing_slip_step`: there s would grow without end.
#
# Other cases are left to :mod:`carom.laws.wall_and_floor.solver`: a slip that vanishes, a floor that is no longer loaded, and
# steps that have to be short. :mod:`carom.laws.two_step_batch` integrates many balls together.


# The slips u_t, u_y, f_x, f_y, the energy in the wall's spring, the wall's impulse.
Glide = tuple[float, float, float, float, float, float]
By = tuple[float, float, float, float, float]  # coefficients of ds/dP: see _flow
GOES, DONE, LEAVES = 0, 1, 2
REACH = 0.9  # in s: the first step and the longest; the singularities lie at about i pi/2
# Of |u|^(1/2), in a step of a slip that vanishes: at first, and bounds; below the last (over the speed) it is straight to its end.
FIRST_SHARE, LEAST_SHARE, MOST_SHARE, NEARLY = 0.45, 0.05, 0.75, 1e-5
BASE = 0.2  # in s: distance to the end if no slip turns
GROWS = 0.8  # weight of a growing slip relative to a decreasing one
# The last step is taken within this fraction of the reach; the step before it stops short of the end by this fraction.
LAST, NEAR = 0.6, 0.85
FIRST = 1e-3  # of the unloading of the wall's spring: close to its start w is dominated by rounding
SAFE, FADE_SAFE = 0.8, 0.85  # of the step that the error would allow
# The error estimate is the one of order 5, an upper bound: the true error is 10 to 10,000 times smaller. (Hairer's combination with
# the one of order 3 is closer on average, but passes zero in one of some hundred steps, and is then 1e5 times too small.)
ESTIMATE = 30_000
SLOPE_ERROR = 1e-10  # of the derivatives, for a change of the slips by 1
NEVER_ZERO = 1e-250  # added to what is divided by
SHORT = 0.02  # in s: balls that need shorter steps are left to the solver


@hot_kernel
def _plus_one(y: Glide, a: float, p: Glide) -> Glide:
    return y[0] + a * p[0], y[1] + a * p[1], y[2] + a * p[2], y[3] + a * p[3], y[4] + a * p[4], y[5] + a * p[5]


@hot_kernel
def _plus_two(y: Glide, a: float, p: Glide, b: float, q: Glide) -> Glide:
    return (
        y[0] + (a * p[0] + b * q[0]),
        y[1] + (a * p[1] + b * q[1]),
        y[2] + (a * p[2] + b * q[2]),
        y[3] + (a * p[3] + b * q[3]),
        y[4] + (a * p[4] + b * q[4]),
        y[5] + (a * p[5] + b * q[5]),
    )


@hot_kernel
def _plus_three(y: Glide, a: float, p: Glide, b: float, q: Glide, c: float, r: Glide) -> Glide:
    return (
        y[0] + (a * p[0] + b * q[0] + c * r[0]),
        y[1] + (a * p[1] + b * q[1] + c * r[1]),
        y[2] + (a * p[2] + b * q[2] + c * r[2]),
        y[3] + (a * p[3] + b * q[3] + c * r[3]),
        y[4] + (a * p[4] + b * q[4] + c * r[4]),
        y[5] + (a * p[5] + b * q[5] + c * r[5]),
    )


@hot_kernel
def _sliding_rates(y: Glide, pw: Pair, pf: Pair, q: Couplings) -> tuple[float, float, float, float, float]:
    """Rates of the slips per P, and the floor's push, from the directions of slip: see :mod:`carom.laws.wall_and_floor.rates`."""
    c, m, b, k, d, e, _drive, muw, muf, _heed = q
    ft, fy = -muw * pw[0], -muw * pw[1]
    push = -(m + c * ft)
    gx, gy = -muf * push * pf[0], -muf * push * pf[1]
    return b * ft - e * gx - m * c, k * fy + d * gy, c - e * ft + k * gx, d * fy + k * gy, push


@hot_kernel
def _changes(y: Glide, h: float, q: Couplings, by: By, fades: bool) -> Glide:
    """Return the changes in a step h of s, where dP = ds / (a/|u| + b/|f| + base + x (u_t' + f_x') + z u_n).

    The rates of :func:`_sliding_rates` are multiplied by |u| |f|, so that there is a single division.
    ``fades``: |u|^(1/2) in place of |u|.
    """
    c, m, b, k, d, e, _drive, muw, muf, _heed = q
    u, f = math.sqrt(y[0] * y[0] + y[1] * y[1]), math.sqrt(y[2] * y[2] + y[3] * y[3])
    uf, px, py = u * f, y[0] * f, y[1] * f
    push = (muf * m) * u - (muf * c * muw) * y[0]
    gx, gy = push * y[2], push * y[3]
    r0, r1 = -(b * muw) * px - e * gx - (m * c) * uf, d * gy - (k * muw) * py
    r2, r3 = c * uf + (e * muw) * px + k * gx, k * gy - (d * muw) * py
    un = c / (1 - m) * (y[0] + y[2])
    root = math.sqrt(u) if fades else 1 + 0 * h
    g = h / (NEVER_ZERO + by[0] * root * f + by[1] * u + (by[2] + by[4] * un) * uf + by[3] * (r0 + r2))
    p = g * uf
    return g * r0, g * r1, g * r2, g * r3, -p * un, p


@hot_kernel
def _steepest(y: Glide) -> float:
    return max(steepest(y[0]), steepest(y[1]), steepest(y[2]), steepest(y[3]), steepest(y[4]), steepest(y[5]))


@hot_kernel
def _dormand_prince_step(
    y: Glide, k1: Glide, h: float, w: float, dw: float, q: Couplings, by: By, long: float, fades: bool
) -> tuple[Glide, float, float]:
    """Take one step of Dormand & Prince 8(5,3) (Hairer, Norsett & Wanner, Solving ODEs I, II.5); return its error of order 5.
    The last result is the error of its derivatives.

    k1 is h times the rates at y; the rates are multiplied by a w that grows linearly by dw. For slips shorter than ``long``
    the error is weighted by the square root of the error in direction.
    """
    k2 = _changes(_plus_one(y, A2[1], k1), h * (w + C[2] * dw), q, by, fades)
    k3 = _changes(_plus_two(y, A3[1], k1, A3[2], k2), h * (w + C[3] * dw), q, by, fades)
    k4 = _changes(_plus_two(y, A4[1], k1, A4[3], k3), h * (w + C[4] * dw), q, by, fades)
    x = _plus_three(y, A5[1], k1, A5[3], k3, A5[4], k4)
    k5 = _changes(x, h * (w + C[5] * dw), q, by, fades)
    x = _plus_three(y, A6[1], k1, A6[4], k4, A6[5], k5)
    k6 = _changes(x, h * (w + C[6] * dw), q, by, fades)
    x = _plus_three(y, A7[1], k1, A7[4], k4, A7[5], k5)
    k7 = _changes(_plus_one(x, A7[6], k6), h * (w + C[7] * dw), q, by, fades)
    x = _plus_three(y, A8[1], k1, A8[4], k4, A8[5], k5)
    k8 = _changes(_plus_two(x, A8[6], k6, A8[7], k7), h * (w + C[8] * dw), q, by, fades)
    x = _plus_three(y, A9[1], k1, A9[4], k4, A9[5], k5)
    x = _plus_three(x, A9[6], k6, A9[7], k7, A9[8], k8)
    k9 = _changes(x, h * (w + C[9] * dw), q, by, fades)
    x = _plus_three(y, A10[1], k1, A10[4], k4, A10[5], k5)
    x = _plus_three(x, A10[6], k6, A10[7], k7, A10[8], k8)
    k10 = _changes(_plus_one(x, A10[9], k9), h * (w + C[10] * dw), q, by, fades)
    x = _plus_three(y, A11[1], k1, A11[4], k4, A11[5], k5)
    x = _plus_three(x, A11[6], k6, A11[7], k7, A11[8], k8)
    k11 = _changes(_plus_two(x, A11[9], k9, A11[10], k10), h * (w + C[11] * dw), q, by, fades)
    x = _plus_three(y, A12[1], k1, A12[4], k4, A12[5], k5)
    x = _plus_three(x, A12[6], k6, A12[7], k7, A12[8], k8)
    k12 = _changes(_plus_three(x, A12[9], k9, A12[10], k10, A12[11], k11), h * (w + dw), q, by, fades)
    zero = 0 * h
    nought = (zero, zero, zero, zero, zero, zero)
    x = _plus_three(nought, B[1], k1, B[6], k6, B[7], k7)
    x = _plus_three(x, B[8], k8, B[9], k9, B[10], k10)
    x = _plus_two(x, B[11], k11, B[12], k12)
    fifth = _plus_three(nought, E5[1], k1, E5[6], k6, E5[7], k7)
    fifth = _plus_three(fifth, E5[8], k8, E5[9], k9, E5[10], k10)
    fifth = _plus_two(fifth, E5[11], k11, E5[12], k12)
    x = _plus_one(y, 1 + zero, x)
    u, f = math.sqrt(x[0] * x[0] + x[1] * x[1]), math.sqrt(x[2] * x[2] + x[3] * x[3])
    u, f = long / (u + NEVER_ZERO), long / (f + NEVER_ZERO)
    u, f = (u if u > 1 else 1 + zero), (f if f > 1 else 1 + zero)
    return x, math.sqrt(_weighted_squares(fifth, u, f) + fifth[4] * fifth[4] / (long * long)), _steepest(fifth)


@kernel
def vanishing_slip_step(
    y: Glide, compressing: bool, share: float, allowed: float, long: float, q: Couplings
) -> tuple[Glide, float, int]:
    """Take a step of a slip u that vanishes before the phase ends; return state, share of the next step, and DONE at its end.

    In the variable |u|^(1/2) a slip that goes straight to zero is a polynomial of degree 2, and the energy one of degree 4, which
    a step follows exactly, its error estimate too; ``share`` is how much of that variable a step takes away. LEAVES where
    nothing vanishes, or where a step of :func:`sliding_step` is as good.
    """
    zero, one = 0 * share, 1 + 0 * share
    u, f = math.sqrt(y[0] * y[0] + y[1] * y[1]), math.sqrt(y[2] * y[2] + y[3] * y[3])
    if not (u > 0 and f > 0):
        return y, share, LEAVES
    px, py, qx, qy = y[0] / u, y[1] / u, y[2] / f, y[3] / f
    r0, r1, r2, r3, push = _sliding_rates(y, (px, py), (qx, qy), q)
    lever = q[0] / (1 - q[1])
    un, along = lever * (y[0] + y[2]), lever * (r0 + r2)
    fades, turns = -(px * r0 + py * r1), abs(px * r1 - py * r0)
    lasts = un < 0 if compressing else (un >= 0 and y[4] > 0)
    if not (fades > 2 * turns and along > 0 and push > LEVEL * (1 + q[7]) and lasts):
        return y, share, LEAVES
    goal = -un / along if compressing else 2 * y[4] / (un + math.sqrt(un * un + 2 * along * y[4]))
    if u > goal * fades:
        return y, share, LEAVES
    turn = (px * r1 - py * r0) / fades  # per e-fold
    if u < NEARLY * long and u * turn * turn < allowed and u * u < allowed * f:
        # straight to the end, in the slip's mean direction: the one that it has an e-fold later
        size = math.sqrt(1 + turn * turn)
        px, py = (px - turn * py) / size, (py + turn * px) / size
        r0, r1, r2, r3, _push = _sliding_rates(y, (px, py), (qx, qy), q)
        p = -u / (px * r0 + py * r1)
        return (zero, zero, y[2] + p * r2, y[3] + p * r3, y[4] - p * un, y[5] + p), share, DONE
    rho = math.sqrt(u)
    h = share * rho
    g = h * 2 * rho / fades
    by = (fades / 2, zero, zero, zero, zero)
    new, error, _wrong = _dormand_prince_step(
        y, (g * r0, g * r1, g * r2, g * r3, -g * un, g), h, one, zero, q, by, long, True
    )
    error = error / ESTIMATE
    un1 = lever * (new[0] + new[2])
    ahead = (px * new[0] + py * new[1] > 0) & (qx * new[2] + qy * new[3] > 0)
    within = (un1 < 0) if compressing else (new[4] > 0)
    kept = error <= allowed and ahead and within
    # (error ~ share^8, and ~ |u|^(1/2), by the weight of the direction)
    expected = error * (1 - share) if kept else error
    grow = FADE_SAFE * math.sqrt(math.sqrt(math.sqrt(allowed / expected))) if expected > 0 else 2 * one
    if not kept:
        share = share * (max(grow, 0.2 * one) if error > allowed else 0.5 * one)
        return y, share, LEAVES if share < LEAST_SHARE else GOES
    return new, min(share * min(grow, 2 * one), MOST_SHARE * one), GOES


@hot_kernel
def _weighted_squares(x: Glide, u: float, f: float) -> float:
    return u * (x[0] * x[0] + x[1] * x[1]) + f * (x[2] * x[2] + x[3] * x[3]) + x[5] * x[5]


@hot_kernel
def _turning_rate(turn: float, fade: float) -> float:
    """Return how fast a slip loses its direction, by turning or by decreasing; a growing slip moves away from the singularity."""
    return turn + (fade if fade > 0 else -GROWS * fade)


@hot_kernel
def sliding_step(  # noqa: PLR0915  (one step for all balls, without branches)
    y: Glide,
    dw: Pair,
    df: Pair,
    compressing: bool,
    peak: float,
    reach: float,
    allowed: float,
    long: float,
    least: float,
    q: Couplings,
    e: float,
) -> tuple[Glide, bool, float, float, int]:
    """Take a step; return state, whether still in compression, energy to return, reach of the next step, continuation code.

    dw and df are the directions in which a slip starts from zero. A step is rejected if its error is above ``allowed``;
    slips below ``least`` are left to the solver.
    """
    zero, one = 0 * reach, 1 + 0 * reach
    u, f = math.sqrt(y[0] * y[0] + y[1] * y[1]), math.sqrt(y[2] * y[2] + y[3] * y[3])
    starts_w, starts_f = u == 0, f == 0
    iu, jf = 1 / (one if starts_w else u), 1 / (one if starts_f else f)
    px, py = (dw[0] if starts_w else y[0] * iu), (dw[1] if starts_w else y[1] * iu)
    qx, qy = (df[0] if starts_f else y[2] * jf), (df[1] if starts_f else y[3] * jf)
    r0, r1, r2, r3, push = _sliding_rates(y, (px, py), (qx, qy), q)
    lever = q[0] / (1 - q[1])
    un, along = lever * (y[0] + y[2]), lever * (r0 + r2)
    # (a, b, base): the rate at which the slips lose their directions, per P
    a = without_slopes(zero if starts_w else _turning_rate(abs(px * r1 - py * r0), -(px * r0 + py * r1)))
    b = without_slopes(zero if starts_f else _turning_rate(abs(qx * r3 - qy * r2), -(qx * r2 + qy * r3)))
    # (where the wall does not push the ball back, or a phase is over, the answer is LEAVES; until then nothing is divided by zero)
    pushed = along if along > 0 else one
    root = un + math.sqrt(un * un + 2 * pushed * y[4])
    goal = -un / pushed if compressing else 2 * y[4] / (root if root > 0 else one)
    lasting = (along > 0) & (goal > 0) & (compressing | (un > 0) | (y[4] >= peak))
    goal = goal if lasting else one
    loses = goal * (a * iu + b * jf)
    need, base = loses + BASE, BASE / goal
    rate = need / goal
    # w = sqrt(2 (peak - E)), w dw = u_n dP
    whole, w = math.sqrt(2 * peak), math.sqrt(2 * max(peak - y[4], zero))
    fresh = y[4] >= peak
    last = (loses <= LAST * reach) & (compressing | fresh | (w > FIRST * whole))
    back = last & (not compressing)
    h = without_slopes(min(reach, NEAR * need if need <= reach else need / 2))
    base = without_slopes(base)
    if carries_slopes(y[0]):  # (the same function of the slips as in the step's other stages)
        rate = a * iu + b * jf + base
    by = (
        zero if last else a, zero if last else b, zero if last else base,
        lever if last & compressing else zero, one if back else zero,
    )  # fmt: skip
    step = (-un if compressing else whole - w) if last else h
    per = (pushed if compressing else (math.sqrt(pushed) if fresh else un / w)) if last else rate
    per = per if lasting else one
    g = step / per
    new, error, wrong = _dormand_prince_step(
        y,
        (g * r0, g * r1, g * r2, g * r3, -g * un, g),
        step,
        w if back else one,
        step if back else zero,
        q,
        by,
        long,
        False,
    )
    error = error / ESTIMATE
    if carries_slopes(y[0]):
        error = max(error, wrong / ESTIMATE * (allowed / (SLOPE_ERROR * max(1.0, _steepest(y)))))
    u1, f1 = math.sqrt(new[0] * new[0] + new[1] * new[1]), math.sqrt(new[2] * new[2] + new[3] * new[3])
    un1 = lever * (new[0] + new[2])
    ahead = (px * new[0] + py * new[1] > 0) & (qx * new[2] + qy * new[3] > 0)
    within = last | ((un1 < 0) if compressing else (new[4] > 0))
    good = (error <= allowed) & ahead & within
    lasts = (u1 > least) & (f1 > least)
    pushes = q[0] * q[7] * new[0] - q[1] * u1 > LEVEL * (1 + q[7]) * u1
    # (error ~ h^6; the more conservative root)
    grow = SAFE * math.sqrt(math.sqrt(math.sqrt(allowed / error))) if error > 0 else 2 * one
    grow = min(max(grow, 0.2 * one), 2 * one)
    took = min(need, reach) if last else h
    wider = min(took * grow if took >= reach else max(reach, took * grow), REACH * one)
    if_bad = took * (grow if error > allowed else 0.5 * one)
    fine = lasting & (push > LEVEL * (1 + q[7]))
    keeps = good & pushes & lasts & fine
    ends = keeps & last & compressing
    over = keeps & last & (not compressing)
    peak1 = e * e * new[4] if ends else peak
    out = over | (ends & (peak1 <= 0))
    stuck = (not fine) | (good & (not (pushes & lasts))) | ((not good) & (if_bad < SHORT))
    status = DONE if out else (LEAVES if stuck else GOES)
    y = (
        new[0] if keeps else y[0], new[1] if keeps else y[1], new[2] if keeps else y[2],
        new[3] if keeps else y[3], (peak1 if ends else new[4]) if keeps else y[4], new[5] if keeps else y[5],
    )  # fmt: skip
    return y, (compressing & (not ends)), peak1, (wider if keeps else if_bad), status


@kernel
def integrate_sliding(
    y: Glide,
    dw: Pair,
    df: Pair,
    compressing: bool,
    peak: float,
    allowed: float,
    long: float,
    least: float,
    q: Couplings,
    e: float,
) -> tuple[Glide, bool, float, bool]:
    """Integrate while both contacts slide; return state, phase, energy to return, and whether the impact has ended."""
    zero = 0 * long
    reach, share, status = REACH + zero, FIRST_SHARE + zero, GOES
    while status == GOES:
        # (the steps of a slip that vanishes see nothing of what its derivatives across it do)
        fading = LEAVES if carries_slopes(y[0]) else GOES
        while fading == GOES:
            y, share, fading = vanishing_slip_step(y, compressing, share, allowed, long, q)
        if fading == DONE:  # the wall's slip has vanished
            break
        y, compressing, peak, reach, status = sliding_step(
            y, dw, df, compressing, peak, reach, allowed, long, least, q, e
        )
    return y, compressing, peak, status == DONE
