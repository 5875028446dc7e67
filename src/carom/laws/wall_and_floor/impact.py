"""The impact at wall and floor at once: velocity and spin after it, and their derivatives.

The values are integrated in steps that are as long as the values permit. Derivatives need other steps. A slip that goes straight to
zero, as that of a ball that rolls without sidespin, is followed exactly in a few steps of any length; but a change *across* it
decays as a power of the slip that is left, by any factor within one step, and long steps magnify it without bound. So derivatives
come from an integration of their own (:func:`impact_slopes`): dual numbers, the same equations and modes, and steps that are as
short as their derivatives require. The lengths of steps have no derivatives; the impulses at which events occur have them:

* a slip ends at an impulse that changes with its size (what has changed across it has decayed by then);
* the contact ends where the wall has returned its energy, or for e = 0 where the approach ends;
* at the end of compression, where friction begins or ceases to hold, and where the floor is unloaded, the rates are continuous, so
  that a change of the impulse at which it happens has no effect.

These are the saltation matrices of the flow (Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004,
section 7.1). The result depends on at most twelve numbers: four slips and the vertical velocity, the normal, the ball's moment of
inertia, and the numbers of both surfaces. Their Jacobian does not depend on the parameters that somebody asks for.
"""

from __future__ import annotations

import math

from carom.core.contact import GRAZE, SLIDE
from carom.core.jit.dual.numbers import lane_of, seeded
from carom.core.jit.kernel import Vec, carries_slopes, derived_by, kernel, only_slopes, steepest, without_slopes
from carom.laws.wall_and_floor.both_sliding import integrate_sliding
from carom.laws.wall_and_floor.frame import from_wall_frame, to_wall_frame
from carom.laws.wall_and_floor.integrator import without_slopes_of
from carom.laws.wall_and_floor.rates import ENDLESS, FLOOR_SLIP, Couplings, Slips, norm
from carom.laws.wall_and_floor.solver import (
    AGAIN,
    GRAZING,
    LEAST_SLIP,
    append_mode,
    error_allowed,
    greatest_slip_at_rest,
    integrate_impact,
    slides_at_both,
)

__all__ = ["impact_and_way", "impact_slopes", "wall_and_floor"]

LEAST_CHANGE = 1e-9  # of the changes of velocity and spin: a slip that changes less does not change
SAME = 1e-6  # of the speeds: two integrations that differ by more have gone different ways
LEAST_SLIP_AND_SLOPES = 1e-7  # of the speeds: LEAST_SLIP where derivatives are followed
# A value, and its derivatives in eight directions.
Slopes = tuple[float, float, float, float, float, float, float, float, float]


@kernel
def _impact_solution(
    before: Slips, up: float, q: Couplings, e: float, kappa: float, ef: float, muf: float, betaf: float, speed: float,
    scale: float,
) -> tuple[Slips, float, float, int, int]:  # fmt: skip
    """Return the slips after an impact, the vertical velocity, the wall's impulse, the regime, and the sequence of modes."""
    zero, way = 0 * q[3], 0
    slides, after, dw, df = slides_at_both(before, up, q, scale)
    p, compressing, peak, regime = zero, True, zero, AGAIN
    if not (slides and speed > GRAZING * scale):
        after, up, p, regime, compressing, peak, dw, df, way = integrate_impact(
            before, up, q, e, kappa, ef, muf, betaf, speed, scale, p, compressing, peak, False, way
        )
    while regime == AGAIN:
        # (derivatives of a slip that vanishes are followed to its end by go_on)
        least = (LEAST_SLIP_AND_SLOPES if carries_slopes(up) else LEAST_SLIP) * scale
        came, up, way = p, zero, append_mode(way, 4 * SLIDE + FLOOR_SLIP)
        y = (after[0], after[1], after[2], after[3], after[4], p)
        y, compressing, peak, ends = integrate_sliding(
            y, dw, df, compressing, peak, error_allowed(speed, scale), speed, least, q, e
        )
        after, p, regime = (y[0], y[1], y[2], y[3], y[4]), y[5], SLIDE
        if not ends:  # on its own to where both slide again, or to the end
            after, up, p, regime, compressing, peak, dw, df, way = integrate_impact(
                after, up, q, e, kappa, ef, muf, betaf, speed, scale, p, compressing, peak, p > came, way
            )
    return after, up, p, regime, way


@kernel
def _with_slopes(x: float) -> Slopes:
    """Return a value with its derivatives as plain numbers."""
    return (
        without_slopes(x), lane_of(x, 0), lane_of(x, 1), lane_of(x, 2), lane_of(x, 3), lane_of(x, 4), lane_of(x, 5),
        lane_of(x, 6), lane_of(x, 7),
    )  # fmt: skip


@kernel
def impact_slopes(
    slips: Slips, rise: float, m: float, kappa: float, e: float, muw: float, ef: float, muf: float,
    betaf: float, speed: float, scale: float, others: bool,
) -> tuple[Slopes, Slopes, Slopes, Slopes, Slopes, Slopes, int]:  # fmt: skip
    """Return the slips after an impact, vertical velocity and impulse of the wall, each with derivatives, and the regime.

    The derivatives are with respect to the four slips and, times 1 / scale, to m (the normal's vertical component), e and both
    frictions; with ``others`` to the vertical velocity and, times 1 / scale, to kappa, ef and betaf.
    """
    one, unit = 1.0, 1 / scale
    slip, other = (0.0, unit) if others else (one, 0.0)
    y = (
        seeded(slips[0], 0, slip), seeded(slips[1], 1, slip), seeded(slips[2], 2, slip), seeded(slips[3], 3, slip),
        seeded(0.0, 0, 0.0),
    )  # fmt: skip
    up = seeded(rise, 0, one - slip)
    c = unit - other
    m1, e1 = seeded(m, 4, c), seeded(e, 5, c)
    mu1, mu2 = seeded(min(muw, ENDLESS), 6, c), seeded(min(muf, ENDLESS), 7, c)
    kappa1, ef1, betaf1 = seeded(kappa, 1, other), seeded(ef, 2, other), seeded(betaf, 3, other)
    muf1 = seeded(muf, 7, c)
    c1, i = math.sqrt(1 - m1 * m1), 1 / kappa1
    q = (c1, m1, m1 * m1 + i, 1 + i, 1 + m1 * i, m1 + i, 1 + 0 * m1, mu1, mu2, 1 + 0 * m1)
    after, up, p, regime, _way = _impact_solution(y, up, q, e1, kappa1, ef1, muf1, betaf1, speed, scale)
    return (
        _with_slopes(after[0]), _with_slopes(after[1]), _with_slopes(after[2]), _with_slopes(after[3]), _with_slopes(up),
        _with_slopes(p), regime,
    )  # fmt: skip


@kernel
def _with_slopes_of(
    value: float, x: Slopes, by: tuple[float, float, float, float, float, float, float, float], x2: Slopes,
    by2: tuple[float, float, float, float], both: bool,
) -> float:  # fmt: skip
    """Return a value with the derivatives of ``x``, and with ``both`` of ``x2``, times dual numbers of value zero."""
    y = value + (
        x[1] * by[0] + x[2] * by[1] + x[3] * by[2] + x[4] * by[3] + x[5] * by[4] + x[6] * by[5] + x[7] * by[6] + x[8] * by[7]
    )  # fmt: skip
    return y + (x2[1] * by2[0] + x2[2] * by2[1] + x2[3] * by2[2] + x2[4] * by2[3]) if both else y


@kernel
def _plain(q: Couplings) -> Couplings:
    return (
        without_slopes(q[0]), without_slopes(q[1]), without_slopes(q[2]), without_slopes(q[3]), without_slopes(q[4]),
        without_slopes(q[5]), without_slopes(q[6]), without_slopes(q[7]), without_slopes(q[8]), without_slopes(q[9]),
    )  # fmt: skip


@kernel
def _steepest(x: Vec) -> float:
    return max(steepest(x[0]), steepest(x[1]), steepest(x[2]))


@kernel
def _starts_from_rest(before: Slips, v: Vec, s: Vec, turns: float, muw: float, muf: float, tiny: float) -> bool:
    """Return whether a contact does not slip when the wall is met, and would with other parameters: in any direction."""
    changes = LEAST_CHANGE * max(_steepest(v), _steepest(s), turns)
    wall = muw > 0 and norm(before[0], before[1]) <= tiny and max(steepest(before[0]), steepest(before[1])) > changes
    floor = muf > 0 and norm(before[2], before[3]) <= tiny and max(steepest(before[2]), steepest(before[3])) > changes
    return wall or floor


@kernel
def _of_duals(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, muw: float, ef: float, muf: float, betaf: float
) -> tuple[Vec, Vec, Vec, Vec, int, int]:
    """:func:`impact_and_way` of dual numbers; NaN where there is no derivative, or where it has not been found."""
    met = to_wall_frame(v, w, n, a, kappa, muw, ef, muf, betaf)
    v1, s1, j, _frame, q, before, approach, sizes = met
    zero = 0 * a
    if not approach > 0:
        return v1, (s1[0] / a, s1[1] / a, s1[2] / a), (zero, zero, zero), j, GRAZE, 0
    speed, scale = without_slopes(approach), without_slopes(sizes)
    y, plain, up = without_slopes_of(before), _plain(q), without_slopes(v1[2])
    kappa0, e0, muw0 = without_slopes(kappa), without_slopes(e), without_slopes(muw)
    ef0, muf0, betaf0 = without_slopes(ef), without_slopes(muf), without_slopes(betaf)
    end, top, p, regime, way = _impact_solution(y, up, plain, e0, kappa0, ef0, muf0, betaf0, speed, scale)
    found = impact_slopes(y, up, plain[1], kappa0, e0, muw0, ef0, muf0, betaf0, speed, scale, False)
    more, both = found, max(steepest(v1[2]), steepest(kappa), steepest(ef), steepest(betaf)) > 0
    if both:
        more = impact_slopes(y, up, plain[1], kappa0, e0, muw0, ef0, muf0, betaf0, speed, scale, True)
    # (a run in other steps that ends elsewhere has gone another way: at a border)
    apart = max(abs(end[0] - found[0][0]), abs(end[1] - found[1][0]), abs(p - found[5][0]))
    apart = max(apart, abs(end[2] - found[2][0]), abs(end[3] - found[3][0]))
    same = regime == found[6] and apart <= SAME * scale
    known = same and not _starts_from_rest(
        before, v1, s1, _steepest(n) * scale, muw0, muf0, greatest_slip_at_rest(scale)
    )
    one = 1.0 if known else math.nan
    by = (
        one * only_slopes(before[0]), one * only_slopes(before[1]), one * only_slopes(before[2]), one * only_slopes(before[3]),
        only_slopes(q[1]) * scale, only_slopes(e) * scale, only_slopes(muw) * scale, only_slopes(muf) * scale,
    )  # fmt: skip
    by2 = (only_slopes(v1[2]), only_slopes(kappa) * scale, only_slopes(ef) * scale, only_slopes(betaf) * scale)
    after = (
        _with_slopes_of(end[0], found[0], by, more[0], by2, both), _with_slopes_of(end[1], found[1], by, more[1], by2, both),
        _with_slopes_of(end[2], found[2], by, more[2], by2, both), _with_slopes_of(end[3], found[3], by, more[3], by2, both), zero,
    )  # fmt: skip
    rise = _with_slopes_of(top, found[4], by, more[4], by2, both)
    v2, w2, wall, floor = from_wall_frame(
        v, w, a, kappa, met, after, rise, _with_slopes_of(p, found[5], by, more[5], by2, both)
    )
    return v2, w2, wall, floor, regime, way


@derived_by(_of_duals)
def impact_and_way(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, muw: float, ef: float, muf: float, betaf: float
) -> tuple[Vec, Vec, Vec, Vec, int, int]:
    """Velocity, spin, impulses (per unit mass) of wall and floor, regime of the wall contact (or JAM, STALL), and modes."""
    met = to_wall_frame(v, w, n, a, kappa, muw, ef, muf, betaf)
    v1, s1, j, _frame, q, before, speed, scale = met
    if not speed > 0:
        zero = 0 * a
        return v1, (s1[0] / a, s1[1] / a, s1[2] / a), (zero, zero, zero), j, GRAZE, 0
    after, up, p, regime, way = _impact_solution(before, v1[2], q, e, kappa, ef, muf, betaf, speed, scale)
    v2, w2, wall, floor = from_wall_frame(v, w, a, kappa, met, after, up, p)
    return v2, w2, wall, floor, regime, way


@kernel
def wall_and_floor(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, muw: float, ef: float, muf: float, betaf: float
) -> tuple[Vec, Vec, Vec, Vec, int]:
    """Velocity, spin, impulses (per unit mass) of wall and floor, and regime of the wall contact (or JAM, STALL)."""
    v2, w2, wall, floor, regime, _way = impact_and_way(v, w, n, a, kappa, e, muw, ef, muf, betaf)
    return v2, w2, wall, floor, regime
