"""Wall and floor at once: a ball that the wall presses on a rigid floor.

The impact is integrated over the normal impulse P of the wall (Darboux 1880; Keller, J. Appl. Mech. 53, 1 (1986)), with
Coulomb friction at both contacts, exact transitions between stick and slip, and Stronge's energetic restitution at the wall
(Proc. R. Soc. A 431, 169 (1990)): the contact ends when the wall has returned e^2 of the work done on it. The rigid floor
keeps z' = 0 as long as its normal force is positive; where it would have to pull, the ball lifts off, and it lands again
during the wall contact if the gap closes in time. The gap depends on time: the wall is a linear spring that unloads with 1/e^2
times its stiffness (Walton & Braun), and the value of the stiffness cancels.

Units here: mass 1, and s = a omega in place of the spin, so that every state is a velocity and every impulse too.
"""

from __future__ import annotations

import math

from carom.core.contact import GRAZE, SLIDE, STICK, contact, slip_velocity
from carom.core.jit.dual import lane_of, seeded
from carom.core.jit.kernel import (
    Vec,
    carries_slopes,
    derived_by,
    dot,
    hot_kernel,
    kernel,
    only_slopes,
    steepest,
    without_slopes,
)
from carom.laws.wall_and_floor.integrators import (
    SLOPE_ERROR,
    dormand_prince_step,
    extrapolated_euler_step,
    integrate_sliding,
    runge_kutta_step,
    steepest_of,
    without_slopes_of,
)
from carom.laws.wall_and_floor.rates import (
    ENDLESS,
    FLOOR_JUMP,
    FLOOR_SLIP,
    FLOOR_STICK,
    LEVEL,
    OFF,
    Couplings,
    Pair,
    Slips,
    decide_mode,
    from_wall_frame,
    gap_growth,
    norm,
    pressed_rates,
    remaining_impulse,
    to_wall_frame,
    touch_down_impulse,
)

JAM, STALL, AGAIN = 3, 4, 6  # (5 is two_step.UNDEFINED)
# Both contacts slide by long steps up to this friction, and above this slip (over the speeds).
FIRM, LEAST_SLIP = 3, 1e-10
GRAZING = 1e-6  # of the speeds: at a lower speed of approach slips hardly change; phases are too short for long steps
LEAST_FIRM = 1e3  # a mobilised friction above half of this is regarded as infinite
ROUNDING = 1e-15  # of the speeds: a velocity of approach below this is zero
TINY = 1e-12
AT_REST = 1e-10  # of the speeds: a slip below this is zero
STEP_ERROR = 1e-10  # of the speed of approach: error of one step
ESTIMATE = 30  # the error of an explicit step is smaller than its estimate by at least this factor
NEARLY = 1e-5  # of the speeds: a slip that vanishes within this distance is integrated in one step to its end
# Of derivatives, where they are followed: by how much the error estimate of an explicit step is too large at least; the share of a
# slip that a step may take away; and the distance, over the speeds, within which a slip is integrated in one step to its end.
SLOPE_ESTIMATE, MOST_FADING, NEARLY_SLOPES = 100, 0.7, 3e-8
# Above these rates friction turns a slip too fast for an explicit step: a slip of some size, and one that starts from zero.
STIFF, STARTS = 60, 4
LONG = 500  # steps: an impact that takes more is stiff somewhere, and uses implicit steps from then on
MOST_STEPS = 100_000
# What a sequence of modes has beside 4 wall + floor: the ball lands; the wall is compressed once more. All are below MOST_WAYS.
LANDS, AGAIN_IN, MOST_WAYS = 15, 14, 1 << 52
HUMS = 10_000  # a ball that lands more often than this during one contact is taken to be pressed on the floor


@hot_kernel
def pressed_down(v: Vec, w: Vec, n: Vec, a: float, mu: float, h: float) -> bool:
    """Return whether a wall presses a ball on the floor down at any time during the contact."""
    if h > 0 or v[2] > 0:
        return False
    if v[2] < 0 or n[2] < 0:
        return True
    _un, ut = slip_velocity(v, w, n, a)
    if not ut[2] > 0:  # friction lifts the ball, or is horizontal
        return False
    if n[2] == 0:
        return mu > 0
    # during sliding the wall's impulse per unit of normal impulse has the vertical component n_z - mu u_z/|u_t|
    return mu * ut[2] > n[2] * math.sqrt(dot(ut, ut))


@hot_kernel
def error_allowed(speed: float, scale: float) -> float:
    """Return the error allowed in one step."""
    return STEP_ERROR * (speed if speed > scale / 100 else scale / 100)


@kernel
def append_mode(way: int, mode: int) -> int:
    """Append a mode to a sequence of them, of which the last thirteen are kept, unless it is the last one's again."""
    return way if way % 16 == mode else (16 * way + mode) % MOST_WAYS


@hot_kernel
def greatest_slip_at_rest(scale: float) -> float:
    """Return the slip below which a contact does not slip."""
    return AT_REST * scale


@kernel
def _speed_of_approach(y: Slips, vz: float, q: Couplings) -> float:
    """Normal velocity u_n at the wall, from the slips: the two contact points are on one rigid body."""
    return q[0] / (1 - q[1]) * (y[0] + y[2] - q[0] * vz) + q[1] * vz


@kernel
def _floor_impulse(
    y: Slips, vz: float, q: Couplings, kappa: float, ef: float, muf: float, betaf: float
) -> tuple[Slips, float]:
    """Apply one impulse of the floor; return slips and vertical velocity after it."""
    zero = 0 * vz
    jn, g, _required, _regime = contact(vz, (y[2], y[3], zero), 1, kappa / (1 + kappa), ef, muf, betaf)
    c, _m, _b, k, d, e, _drive, _muw, _muf, _heed = q
    return (y[0] - e * g[0] + c * jn, y[1] + d * g[1], y[2] + k * g[0], y[3] + k * g[1], y[4]), vz + jn


@kernel
def _slip_decay(ux: float, uy: float, rx: float, ry: float) -> tuple[float, float, float]:
    """Return the size of a slip u with rate r, the rate at which it decreases, and the component of r across u."""
    slip = norm(ux, uy)
    if slip > 0:
        return slip, -(ux * rx + uy * ry) / slip, abs(ux * ry - uy * rx) / slip
    return slip, -norm(rx, ry), 0 * slip


@kernel
def _pressed_step(  # noqa: PLR0915  (one step and what may stop it)
    y: Slips, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, patience: int,
    compressing: bool, peak: float, pace: float, speed: float, scale: float,
) -> tuple[Slips, float, float, bool, bool]:  # fmt: skip
    """Take a step of a pressed ball; return its length, the next one's, whether the mode has ended, and whether it succeeded."""
    c, m, _b, _k, _d, _e, _drive, muw, muf, heed = q
    zero, follows = 0 * c, carries_slopes(c)
    tiny, allowed = AT_REST * scale, error_allowed(speed, scale)
    k1, spare = pressed_rates(y, q, wall, floor, dw, df, zero)
    un, along = _speed_of_approach(y, zero, q), c / (1 - m) * (k1[0] + k1[2])
    goal = math.inf
    if heed > 0 and (floor != FLOOR_JUMP or compressing):
        goal = remaining_impulse(un, along, y[4], peak, compressing)
    slips_w, slips_f = wall == SLIDE and muw > 0, floor != FLOOR_STICK and muf > 0
    uw, fading_w, turns_w = _slip_decay(y[0], y[1], k1[0], k1[1])
    uf, fading_f, turns_f = _slip_decay(y[2], y[3], k1[2], k1[3])
    dies_w = uw / fading_w if slips_w and floor != FLOOR_JUMP and uw > 0 and fading_w > 0 else math.inf
    dies_f = uf / fading_f if slips_f and uf > 0 and fading_f > 0 else math.inf
    dies = min(dies_w, dies_f)
    if floor == FLOOR_JUMP:  # also straight if it does not turn the wall's slip: the floor's normal force is constant
        straight = fading_w < 0 and turns_w <= 1e-9 * -fading_w
    else:  # all in one plane
        straight = y[1] == 0 and y[3] == 0 and k1[1] == 0 and k1[3] == 0
    straight = straight and not follows  # (what is straight for the values is not for their derivatives across)
    if straight:
        if heed > 0:
            goal = remaining_impulse(un, along, y[4], peak, compressing)
        ends = dies <= goal
    else:
        ends = dies <= goal and dies * (norm(k1[0], k1[1]) + norm(k1[2], k1[3])) < NEARLY * scale
        # the rest of the slip turns by a negligible angle, and so does the slip of the other contact
        ends = ends and dies * (turns_w if dies_w <= dies_f else turns_f) <= allowed
        other, turn = (uf, turns_f) if dies_w <= dies_f else (uw, turns_w)
        ends = ends and dies * dies * turn * (muw + muf) <= allowed * other
        if follows:  # (the direction of the rest of the slip has derivatives of its own)
            # (with a floor that sticks the approach ends where the slip does: whichever comes first by a rounding)
            ends = dies < math.inf and (dies <= goal or compressing)
            if ends and not (uw if dies_w <= dies_f else uf) <= 100 * tiny:
                ends = dies * (norm(k1[0], k1[1]) + norm(k1[2], k1[3])) < NEARLY_SLOPES * scale
        if not ends:
            goal = min(goal, (MOST_FADING if follows else 0.99) * dies)
            far = min(goal, 10 * speed)  # stiffness is measured over the remaining path, not over one step
            turn = math.inf  # the impulse over which a slip turns by 1, or vanishes
            if slips_w:
                turn = uw / norm(k1[0], k1[1])
            if slips_f:
                turn = min(turn, uf / norm(k1[2], k1[3]))
            goes, order, wrong = True, 8, 0.0
            if _is_stiff(y, q, wall, floor, dw, df, far, fading_w, fading_f, patience):
                order = 6
                h = without_slopes(min(far, pace))
                new, error, wrong, goes = extrapolated_euler_step(y, h, q, wall, floor, dw, df, zero)
            else:
                h = without_slopes(min(far, pace, turn / 4) if pace == math.inf and turn > 0 else min(far, pace))
                if h < turn / 100:
                    new, error = runge_kutta_step(y, k1, h, q, wall, floor, dw, df, zero), zero
                else:
                    new, error, wrong = dormand_prince_step(y, k1, h, q, wall, floor, dw, df, zero)
                    # (the direction of a small slip has to be accurate, too)
                    slip = norm(new[0], new[1]) if slips_w else math.inf
                    slip = min(slip, norm(new[2], new[3])) if slips_f else slip
                    wrong = wrong / SLOPE_ESTIMATE
                    error = max(error / ESTIMATE, error * 30 * allowed / slip) if slip > 0 else math.inf
            if follows:
                error = max(error, wrong * (allowed / (SLOPE_ERROR * max(1.0, steepest_of(y)))))
            grow = 0.85 * (allowed / error) ** (1 / order) if error > 0 else 4 + zero
            if not (goes and error <= allowed):
                return y, zero, h * (max(0.1, grow) if goes and error < math.inf else 0.25), False, False
            _there, spare1 = pressed_rates(new, q, wall, floor, dw, df, zero)
            share = 1 + zero
            un1 = _speed_of_approach(new, zero, q)
            if heed > 0 and compressing and un1 > max(1e-12 * speed, ROUNDING * scale):
                share = max(0.02, un / (un - un1))
            if heed > 0 and not compressing and new[4] < -TINY * peak:
                share = max(0.02, y[4] / (y[4] - new[4]))
            if spare1 < -LEVEL:
                share = min(share, max(0.02, min(0.95, spare / (spare - spare1))))
            if slips_w and uw > 0 and new[0] * y[0] + new[1] * y[1] < 0:
                share = min(share, 0.5)
            if slips_f and uf > 0 and new[2] * y[2] + new[3] * y[3] < 0:
                share = min(share, 0.5)
            # (the step is too short to change anything: this mode has ended)
            still = h * (norm(k1[0], k1[1]) + norm(k1[2], k1[3])) < 1e-13 * scale
            if share < 1 and not still:
                return y, zero, h * share, False, False
            over = still or spare1 < 0 or (slips_w and fading_w > 0 and norm(new[0], new[1]) <= tiny)
            over = over or (slips_f and fading_f > 0 and norm(new[2], new[3]) <= tiny)
            # (a decreasing slip shortens the next step accordingly)
            if slips_w and uw > 0:
                grow = min(grow, grow * norm(new[0], new[1]) / uw)
            if slips_f and uf > 0:
                grow = min(grow, grow * norm(new[2], new[3]) / uf)
            grow = h * min(grow, 4 + zero)
            if follows and floor == FLOOR_JUMP and spare1 < 0:
                new = _moved_release(new, q, spare1, dw, df)
            return new, h, max(grow, pace) if h < pace < math.inf else grow, over, True
    h = min(goal, dies)
    if follows and ends:
        # (along the flow the slip ends at the same impulse; a change across it decays with the slip: only its size matters)
        h = uw / without_slopes(fading_w) if dies_w <= dies_f else uf / without_slopes(fading_f)
        k1 = without_slopes_of(k1)
    work = y[4] - heed * h * (un + along * h / 2)
    new = (y[0] + h * k1[0], y[1] + h * k1[1], y[2] + h * k1[2], y[3] + h * k1[3], work)
    if ends and dies_w <= dies_f:
        new = (zero, zero, new[2], new[3], work)
    if ends and dies_f <= dies_w:
        new = (new[0], new[1], zero, zero, work)
    ends = ends or (fading_w > 0 and norm(new[0], new[1]) <= tiny) or (fading_f > 0 and norm(new[2], new[3]) <= tiny)
    return new, h, math.inf, ends, h < math.inf


@kernel
def _moved_release(y: Slips, q: Couplings, spare: float, dw: Pair, df: Pair) -> Slips:
    """Move the end of a jump of the floor's slip, where the wall no longer presses, by its derivatives; the values stay.

    (In the other modes the rates do not change where a load or a cone is at its bound.)
    """
    c, muw, slip = q[0], q[7], norm(y[0], y[1])
    k1, _spare = pressed_rates(y, q, SLIDE, FLOOR_JUMP, dw, df, 0 * c)
    rate = without_slopes(c * muw / (1 + muw) * y[1] * (k1[0] * y[1] - k1[1] * y[0]) / (slip * slip * slip))
    h = only_slopes(spare) / -rate if rate < 0 else only_slopes(c) * 0
    return y[0] + h * k1[0], y[1] + h * k1[1], y[2] + h * k1[2], y[3] + h * k1[3], y[4] + h * k1[4]


@kernel
def _moved_end(
    y: Slips, vz: float, p: float, un: float, e: float, law: Couplings, wall: int, floor: int, dw: Pair, df: Pair,
    touching: bool,
) -> tuple[Slips, float, float]:  # fmt: skip
    """Move the end of the wall contact by what the derivatives of its condition ask for; the values stay.

    The condition is that no energy is left, or for e = 0 that the approach has ended.
    """
    c, m, _b, k, d, ee, _drive, muw, _muf, _heed = law
    zero, rise = 0 * c, 0 * c
    if floor == OFF:
        slip = norm(y[0], y[1])
        slides = wall == SLIDE and slip > 0
        fx, fy = (-muw * y[0] / slip, -muw * y[1] / slip) if slides else (zero, zero)
        k1 = (k * fx, k * fy, c - ee * fx, d * fy, -un)
        rise = zero if touching else m + c * fx
    else:
        k1, _spare = pressed_rates(y, law, wall, floor, dw, df, zero)
    if e > 0:
        h = -y[4] / k1[4] if k1[4] < 0 else zero
    else:  # (the impulse returned is e (2 E u_n')^(1/2) / u_n')
        along = c / (1 - m) * (k1[0] + k1[2] - c * rise) + m * rise
        h = (-un + e * math.sqrt(2 * y[4] * along)) / along if along > 0 else zero
    h = h - without_slopes(h)
    y = (y[0] + h * k1[0], y[1] + h * k1[1], y[2] + h * k1[2], y[3] + h * k1[3], y[4])
    return y, vz + h * rise, p + h if law[6] > 0 and floor != FLOOR_JUMP else p


@kernel
def _without_wall_slip(y: Slips, vz: float, q: Couplings, apart: bool, un: float) -> tuple[Slips, float, bool]:
    """Remove the slip of a ball off the floor at an infinitely rough wall; return whether the ball lands meanwhile.

    It can land only if it is just leaving the floor (not ``apart``), since the time is infinitesimal. Its order matters: at
    the beginning of the contact the impulse grows as the square of the time, and later in proportion to it.
    """
    c, _m, _b, k, d, e, _drive, _muw, _muf, heed = q
    zero = 0 * c
    slip = norm(y[0], y[1])
    f, down = slip / k, c * y[0] / slip
    ends = y[4] / un if heed > 0 and un > 0 else math.inf
    closes = math.inf
    if down > 0 and not apart:
        closes = 2 * vz / down
        if heed > 0 and un != 0:  # (the wall's force q: gap = 0 is a square in it)
            q0 = math.sqrt(2 * y[4])
            square = 9 * q0 * q0 - 24 * un * vz / down
            q1 = (math.sqrt(square) - q0) / 2 if square >= q0 * q0 else zero
            closes = (q0 - q1) * (q0 + q1) / (2 * un)
    hit = closes < min(f, ends)
    over = ends <= f and not hit
    f = closes if hit else min(f, ends)
    ft, fy = -f * y[0] / slip, -f * y[1] / slip
    work = y[4] - heed * un * f
    if over:
        work = zero
    if hit or over:
        return (y[0] + k * ft, y[1] + k * fy, y[2] - e * ft, y[3] + d * fy, work), vz + c * ft, hit
    return (zero, zero, y[2] - e * ft, y[3] + d * fy, work), vz + c * ft, hit


@kernel
def _is_stiff(
    y: Slips, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, far: float, fading_w: float, fading_f: float,
    patience: int,
) -> bool:  # fmt: skip
    """Return whether friction turns a slip within an impulse much shorter than the remaining ``far`` (stiffness)."""
    c, m, b, k, _d, e, drive, muw, muf, _heed = q
    zero = 0 * c
    if floor == FLOOR_JUMP:
        return False
    slip_w, slip_f = norm(y[0], y[1]), norm(y[2], y[3])
    if wall == SLIDE:
        turn = muw * k * (1 + (muf * c if floor == FLOOR_SLIP else zero))
        if turn * far > patience * slip_w + STARTS * max(-fading_w, zero) * far:
            return True
        push = c * muw * (y[0] / slip_w if slip_w > 0 else dw[0]) - m * drive
        turn = muf * push * k
    else:
        apart = b - e * muf * c * (y[2] / slip_f if slip_f > 0 else df[0])
        turn = -muf * m * drive * k / apart * k * (1 + e * muf * c / apart)
    return floor == FLOOR_SLIP and turn * far > patience * slip_f + STARTS * max(-fading_f, zero) * far


@kernel
def integrate_impact(  # noqa: PLR0915  (one loop over events; its parts stand above)
    y: Slips, vz: float, q: Couplings, e: float, kappa: float, ef: float, muf: float, betaf: float, speed: float, scale: float,
    p: float, compressing: bool, peak: float, waits: bool, way: int,
) -> tuple[Slips, float, float, int, bool, float, Pair, Pair, int]:  # fmt: skip
    """Integrate to the end of the wall contact; return slips, vertical velocity, the wall's normal impulse and regime.

    The integration begins at the wall's impulse p, in compression or not, with the energy ``peak`` to return. With ``waits``
    it stops where a contact at rest begins to slip and both then slip (AGAIN); the next four results describe that state. The last
    one is the sequence of modes, appended to ``way``.
    """
    c, m, b, k, d, ee, _drive, muw, _muf, _heed = q
    zero, follows = 0 * vz, carries_slopes(vz)
    rough_wall, rough_floor = muw >= ENDLESS, q[8] >= ENDLESS
    tiny = AT_REST * scale
    touching, decide = vz <= tiny, True
    wall, floor, level, regime, grade, rank = SLIDE, OFF, 0, STALL, 0, 0
    dw = df = (1 + zero, zero)
    law = q
    gap, pace, landings = zero, math.inf, 0
    for i in range(MOST_STEPS):
        if touching and vz != 0:
            y, vz = (y[0] - c * vz, y[1], y[2], y[3], y[4]), zero
        if decide:
            if muw > 0 and norm(y[0], y[1]) <= tiny:
                y = (zero, zero, y[2], y[3], y[4])
            if muf > 0 and norm(y[2], y[3]) <= tiny:
                y = (y[0], y[1], zero, zero, y[4])
            wall, floor, level, dw, df = decide_mode(y, q, rough_wall, rough_floor, touching, tiny)
            decide, pace = False, math.inf
            way = append_mode(way, 4 * wall + floor)
            if wall == STICK and floor == FLOOR_STICK:
                regime = JAM
                break
            rank = level + (2 if floor == FLOOR_JUMP else 0)
            if rank < grade:  # energy stored at the faster time scale is negligible on this one
                y, grade, compressing = (y[0], y[1], y[2], y[3], zero), rank, True
            elif y[4] == 0 and compressing:
                grade = rank
            drive, mu, heed = 1 - level + zero, 1 + zero if level else muw, 1 + zero if rank == grade else zero
            law = (c, m, b, k, d, ee, drive, mu, q[8], heed)
        un = _speed_of_approach(y, vz, q)
        if rank == grade:
            if compressing and un >= -max(1e-12 * speed, ROUNDING * scale):
                # Stronge: the wall returns e^2 of the work done on it
                if follows and e == 0:
                    y, vz, p = _moved_end(y, vz, p, un, e, law, wall, floor, dw, df, touching)
                compressing, peak = False, e * e * y[4]
                y = (y[0], y[1], y[2], y[3], peak)
            elif not compressing and e > 0 and un < -max(1e-12 * speed, ROUNDING * scale) and y[4] >= peak * (1 - TINY):
                # Walton & Braun: reloading follows the unloading line, and beyond the previous maximum the loading line
                compressing, way = True, append_mode(way, AGAIN_IN)
                y = (y[0], y[1], y[2], y[3], y[4] / (e * e))
            if not compressing and y[4] <= TINY * peak:
                if follows and e > 0:
                    y, vz, p = _moved_end(y, vz, p, un, e, law, wall, floor, dw, df, touching)
                regime = STICK if norm(y[0], y[1]) <= tiny else SLIDE
                break
        if floor == OFF and level == 1:  # an infinitely rough wall removes the slip, and may lift the ball
            y, vz, hit = _without_wall_slip(y, vz, law, touching or gap > 0, un)
            touching, decide = touching and vz <= tiny, True
            if hit:
                y, vz = _floor_impulse(y, vz, q, kappa, ef, muf, betaf)
                landings, way = landings + 1, append_mode(way, LANDS)
                touching = vz <= 1e-9 * scale or landings > HUMS
            continue
        if waits and wall == SLIDE and floor == FLOOR_SLIP and (norm(y[0], y[1]) == 0 or norm(y[2], y[3]) == 0):
            regime = AGAIN
            break
        if floor != OFF:
            y, h, pace, decide, went = _pressed_step(
                y, law, wall, floor, dw, df, STIFF if i < LONG else STARTS, compressing, peak, pace, speed, scale
            )
            if level == 0 and floor != FLOOR_JUMP:
                p += h
            if not (went or pace > 0):
                break
            continue
        # Straight lines: the step may have any length, up to where the gap closes.
        slip = norm(y[0], y[1])
        ft, fy = zero, zero
        h = remaining_impulse(un, 1, y[4], peak, compressing)
        dies = False
        if wall == SLIDE and muw > 0:
            ft, fy = -muw * y[0] / slip, -muw * y[1] / slip
            dies = slip <= h * k * muw
            h = slip / (k * muw) if dies else h
        rise = m + c * ft
        touching = touching and abs(rise) <= 2 * LEVEL * (1 + (muw if wall == SLIDE else 0))
        rise = zero if touching else rise
        grown = gap + gap_growth(un, vz, rise, y[4], h, e, compressing)
        hit = grown <= 0 and vz + h * rise < 0
        if hit:
            h, dies = touch_down_impulse(un, vz, rise, y[4], h, e, compressing, gap), False
        gap = zero if hit else max(grown, zero)
        y = (
            y[0] + h * k * ft,
            y[1] + h * k * fy,
            y[2] + h * (c - ee * ft),
            y[3] + h * d * fy,
            y[4] - un * h - h * h / 2,
        )
        if dies:
            y = (zero, zero, y[2], y[3], y[4])
        vz, p, decide = vz + h * rise, p + h, True
        if hit:
            y, vz = _floor_impulse(y, vz, q, kappa, ef, muf, betaf)
            landings, way = landings + 1, append_mode(way, LANDS)
            touching = vz <= 1e-9 * scale or landings > HUMS
    return y, zero if touching else vz, p, regime, compressing, peak, dw, df, way


@kernel
def slides_at_both(y: Slips, vz: float, q: Couplings, scale: float) -> tuple[bool, Slips, Pair, Pair]:
    """Return whether both contacts slide, not in one plane (straight paths), the slips, and the directions in which they start."""
    c, _m, _b, _k, _d, _e, _drive, muw, muf, _heed = q
    zero, tiny = 0 * vz, AT_REST * scale
    y = (y[0] - c * vz, y[1], y[2], y[3], y[4])
    straight = y[1] == 0 and y[3] == 0
    if straight or vz > tiny or not max(muw, muf) <= FIRM or not norm(y[0], y[1]) > LEAST_SLIP * scale:
        return False, y, (1 + zero, zero), (1 + zero, zero)
    if muf > 0 and norm(y[2], y[3]) <= tiny:
        y = (y[0], y[1], zero, zero, y[4])
    wall, floor, level, dw, df = decide_mode(y, q, False, False, True, tiny)
    slips = y[2] != 0 or y[3] != 0 or muf > 0
    return wall == SLIDE and floor == FLOOR_SLIP and level == 0 and slips, y, dw, df


# ----------------------------------------------------------------------------------------------------
# The impact at wall and floor at once: velocity and spin after it, and their derivatives.
#
# The values are integrated in steps that are as long as the values permit. Derivatives need other steps. A slip that goes
# straight to zero, as that of a ball that rolls without sidespin, is followed exactly in a few steps of any length; but a change
# *across* it decays as a power of the slip that is left, by any factor within one step, and long steps magnify it without bound.
# So derivatives come from an integration of their own (:func:`impact_slopes`): dual numbers, the same equations and modes, and
# steps that are as short as their derivatives require. The lengths of steps have no derivatives; the impulses at which events
# occur have them:
#
# * a slip ends at an impulse that changes with its size (what has changed across it has decayed by then);
# * the contact ends where the wall has returned its energy, or for e = 0 where the approach ends;
# * at the end of compression, where friction begins or ceases to hold, and where the floor is unloaded, the rates are continuous,
# so
# that a change of the impulse at which it happens has no effect.
#
# These are the saltation matrices of the flow (Leine & Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
# 2004, section 7.1). The result depends on at most twelve numbers: four slips and the vertical velocity, the normal, the ball's
# moment of inertia, and the numbers of both surfaces. Their Jacobian does not depend on the parameters that somebody asks for.


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
