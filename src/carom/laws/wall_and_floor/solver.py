"""Wall and floor at once: a ball on a rigid floor that the wall pushes down.

The impact is followed in the impulse P that the wall has given along its normal (Darboux 1880; Keller, J. Appl. Mech. 53,
1 (1986)), with Coulomb friction at both contacts, stick and slip each followed exactly, and Stronge's energetic
restitution at the wall (Proc. R. Soc. A 431, 169 (1990)): it ends when the wall has given back e^2 of the work that it
took. The rigid floor holds z' = 0 for as long as it has to push; where it would have to pull, the ball lifts off, and it
comes down again while the wall still acts if the gap closes before the wall lets go. The gap needs a clock: the wall is a
linear spring that unloads e^2 times as stiffly (Walton & Braun), whose stiffness drops out of the answer.

Units here: mass 1, and s = a omega in place of the spin, so that every state is a velocity and every impulse too.
"""

from __future__ import annotations

import math

from carom.core.contact import GRAZE, SLIDE, STICK, contact, slip_velocity
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel
from carom.laws.wall_and_floor.frame import meet, part
from carom.laws.wall_and_floor.integrator import creep, hop, stride
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
    rates,
    size,
)
from carom.laws.wall_and_floor.spring import gap_growth, remaining, touch_down

__all__ = [
    "AGAIN", "AT_REST", "JAM", "STALL", "error_allowed", "go_on", "pressed_down", "wall_and_floor"
]  # fmt: skip

JAM, STALL, AGAIN = 3, 4, 6  # (5 is two_step.UNDEFINED)
LEAST_FIRM = 1e3  # half of this: where a friction that was used can only have been an infinite one
ROUNDING = 1e-15  # of the speeds: where a velocity of approach has ended
TINY = 1e-12
AT_REST = 1e-10  # of the speeds: a slip below this has ended
STEP_ERROR = 1e-10  # of the speed of approach: error of one step
ESTIMATE = 30  # by so much, and more, an explicit step is better than the estimate of its error
NEARLY = 1e-5  # of the speeds: a slip that dies within so little is followed straight to its end
# From here on friction turns a slip too fast for an explicit step: one of some size, and one that starts from nothing.
STIFF, STARTS = 60, 4
LONG = 500  # steps: a course that takes more is stiff somewhere, and creeps from then on
MOST_STEPS = 100_000
HUMS = 10_000  # a ball that lands more often than that under one push is pressed on the floor


@hot_kernel
def pressed_down(v: Vec, w: Vec, n: Vec, a: float, mu: float, h: float) -> bool:
    """Whether a wall pushes a ball that lies on the floor down, at any time while it acts."""
    if h > 0 or v[2] > 0:
        return False
    if v[2] < 0 or n[2] < 0:
        return True
    _un, ut = slip_velocity(v, w, n, a)
    if not ut[2] > 0:  # friction lifts, or is level
        return False
    if n[2] == 0:
        return mu > 0
    # the sliding wall's impulse per unit of normal impulse has the vertical part n_z - mu u_z/|u_t|
    return mu * ut[2] > n[2] * math.sqrt(dot(ut, ut))


@hot_kernel
def error_allowed(speed: float, scale: float) -> float:
    """The error of one step."""
    return STEP_ERROR * (speed if speed > scale / 100 else scale / 100)


@kernel
def _speed_of_approach(y: Slips, vz: float, q: Couplings) -> float:
    """Normal velocity u_n at the wall, from the slips: the two contact points are on one rigid body."""
    return q[0] / (1 - q[1]) * (y[0] + y[2] - q[0] * vz) + q[1] * vz


@kernel
def _lands(y: Slips, vz: float, q: Couplings, kappa: float, ef: float, muf: float, betaf: float) -> tuple[Slips, float]:
    """One blow from the floor: slips and vertical velocity after it."""
    zero = 0 * vz
    jn, g, _required, _regime = contact(vz, (y[2], y[3], zero), 1, kappa / (1 + kappa), ef, muf, betaf)
    c, _m, _b, k, d, e, _drive, _muw, _muf, _heed = q
    return (y[0] - e * g[0] + c * jn, y[1] + d * g[1], y[2] + k * g[0], y[3] + k * g[1], y[4]), vz + jn


@kernel
def _fading(ux: float, uy: float, rx: float, ry: float) -> tuple[float, float, float]:
    """Of a slip u with rate r: its size, the rate at which it fades, and how fast it is turned, r across u."""
    slip = size(ux, uy)
    if slip > 0:
        return slip, -(ux * rx + uy * ry) / slip, abs(ux * ry - uy * rx) / slip
    return slip, -size(rx, ry), 0 * slip


@kernel
def _pressed_step(  # noqa: PLR0915  (one step and what may stop it)
    y: Slips, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, patience: int,
    compressing: bool, peak: float, pace: float, speed: float, scale: float,
) -> tuple[Slips, float, float, bool, bool]:  # fmt: skip
    """A step of a pressed ball, its length, the next one's, whether the mode has come to its end, and whether it went."""
    c, m, _b, _k, _d, _e, _drive, muw, muf, heed = q
    zero = 0 * c
    tiny, allowed = AT_REST * scale, error_allowed(speed, scale)
    k1, spare = rates(y, q, wall, floor, dw, df, zero)
    un, along = _speed_of_approach(y, zero, q), c / (1 - m) * (k1[0] + k1[2])
    goal = math.inf
    if heed > 0 and (floor != FLOOR_JUMP or compressing):
        goal = remaining(un, along, y[4], peak, compressing)
    slips_w, slips_f = wall == SLIDE and muw > 0, floor != FLOOR_STICK and muf > 0
    uw, fading_w, turns_w = _fading(y[0], y[1], k1[0], k1[1])
    uf, fading_f, turns_f = _fading(y[2], y[3], k1[2], k1[3])
    dies_w = uw / fading_w if slips_w and floor != FLOOR_JUMP and uw > 0 and fading_w > 0 else math.inf
    dies_f = uf / fading_f if slips_f and uf > 0 and fading_f > 0 else math.inf
    dies = min(dies_w, dies_f)
    if floor == FLOOR_JUMP:  # straight too where it does not turn the wall's slip: the floor's push stays as it is
        straight = fading_w < 0 and turns_w <= 1e-9 * -fading_w
    else:  # all in one plane
        straight = y[1] == 0 and y[3] == 0 and k1[1] == 0 and k1[3] == 0
    if straight:
        if heed > 0:
            goal = remaining(un, along, y[4], peak, compressing)
        ends = dies <= goal
    else:
        ends = dies <= goal and dies * (size(k1[0], k1[1]) + size(k1[2], k1[3])) < NEARLY * scale
        # what is left of the slip turns by too little to matter, and so does the other contact's
        ends = ends and dies * (turns_w if dies_w <= dies_f else turns_f) <= allowed
        other, turn = (uf, turns_f) if dies_w <= dies_f else (uw, turns_w)
        ends = ends and dies * dies * turn * (muw + muf) <= allowed * other
        if not ends:
            goal = min(goal, 0.99 * dies)
            far = min(goal, 10 * speed)  # what is stiff is not a step but the way
            turn = math.inf  # the way on which a slip turns by 1, or fades
            if slips_w:
                turn = uw / size(k1[0], k1[1])
            if slips_f:
                turn = min(turn, uf / size(k1[2], k1[3]))
            goes, order = True, 8
            if _creeps(y, q, wall, floor, dw, df, far, fading_w, fading_f, patience):
                order = 6
                h = min(far, pace)
                new, error, goes = creep(y, h, q, wall, floor, dw, df, zero)
            else:
                h = min(far, pace, turn / 4) if pace == math.inf and turn > 0 else min(far, pace)
                if h < turn / 100:
                    new, error = hop(y, k1, h, q, wall, floor, dw, df, zero), zero
                else:
                    new, error = stride(y, k1, h, q, wall, floor, dw, df, zero)
                    # (and of a small slip the direction has to be right)
                    slip = size(new[0], new[1]) if slips_w else math.inf
                    slip = min(slip, size(new[2], new[3])) if slips_f else slip
                    error = max(error / ESTIMATE, error * 30 * allowed / slip) if slip > 0 else math.inf
            grow = 0.85 * (allowed / error) ** (1 / order) if error > 0 else 4 + zero
            if not (goes and error <= allowed):
                return y, zero, h * (max(0.1, grow) if goes and error < math.inf else 0.25), False, False
            _there, spare1 = rates(new, q, wall, floor, dw, df, zero)
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
            # (a step too short to move anything: this mode has come to its end)
            still = h * (size(k1[0], k1[1]) + size(k1[2], k1[3])) < 1e-13 * scale
            if share < 1 and not still:
                return y, zero, h * share, False, False
            over = still or spare1 < 0 or (slips_w and fading_w > 0 and size(new[0], new[1]) <= tiny)
            over = over or (slips_f and fading_f > 0 and size(new[2], new[3]) <= tiny)
            # (a slip that fades leaves so much less room for the next step)
            if slips_w and uw > 0:
                grow = min(grow, grow * size(new[0], new[1]) / uw)
            if slips_f and uf > 0:
                grow = min(grow, grow * size(new[2], new[3]) / uf)
            grow = h * min(grow, 4 + zero)
            return new, h, max(grow, pace) if h < pace < math.inf else grow, over, True
    h = min(goal, dies)
    work = y[4] - heed * h * (un + along * h / 2)
    new = (y[0] + h * k1[0], y[1] + h * k1[1], y[2] + h * k1[2], y[3] + h * k1[3], work)
    if ends and dies_w <= dies_f:
        new = (zero, zero, new[2], new[3], work)
    if ends and dies_f <= dies_w:
        new = (new[0], new[1], zero, zero, work)
    ends = ends or (fading_w > 0 and size(new[0], new[1]) <= tiny) or (fading_f > 0 and size(new[2], new[3]) <= tiny)
    return new, h, math.inf, ends, h < math.inf


@kernel
def _taken(y: Slips, vz: float, q: Couplings, apart: bool, un: float) -> tuple[Slips, float, bool]:
    """An infinitely rough wall takes the slip of a ball that the floor does not hold; whether it lands on the way.

    Only a ball that is just leaving the floor (not ``apart``) can: no time passes. What little does counts: from the wall's
    first touch on the impulse grows as the square of the time, and later in proportion to it.
    """
    c, _m, _b, k, d, e, _drive, _muw, _muf, heed = q
    zero = 0 * c
    slip = size(y[0], y[1])
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
def _creeps(
    y: Slips, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, far: float, fading_w: float, fading_f: float,
    patience: int,
) -> bool:  # fmt: skip
    """Whether friction turns a slip many times faster than the way to go, ``far``, is long."""
    c, m, b, k, _d, e, drive, muw, muf, _heed = q
    zero = 0 * c
    if floor == FLOOR_JUMP:
        return False
    slip_w, slip_f = size(y[0], y[1]), size(y[2], y[3])
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
def go_on(  # noqa: PLR0915  (one loop over events; its parts stand above)
    y: Slips, vz: float, q: Couplings, e: float, kappa: float, ef: float, muf: float, betaf: float, speed: float, scale: float,
    p: float, compressing: bool, peak: float, waits: bool,
) -> tuple[Slips, float, float, int, bool, float, Pair, Pair]:  # fmt: skip
    """Slips, vertical velocity, the wall's normal impulse and its regime when the wall lets go.

    It begins at the wall's impulse p, in compression or not, with so much energy to give back at first (``peak``). Who
    ``waits`` is told where a contact that rested slips and both do (AGAIN); then the last four are what holds there.
    """
    c, m, b, k, d, ee, _drive, muw, _muf, _heed = q
    zero = 0 * vz
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
            if muw > 0 and size(y[0], y[1]) <= tiny:
                y = (zero, zero, y[2], y[3], y[4])
            if muf > 0 and size(y[2], y[3]) <= tiny:
                y = (y[0], y[1], zero, zero, y[4])
            wall, floor, level, dw, df = decide_mode(y, q, rough_wall, rough_floor, touching, tiny)
            decide, pace = False, math.inf
            if wall == STICK and floor == FLOOR_STICK:
                regime = JAM
                break
            rank = level + (2 if floor == FLOOR_JUMP else 0)
            if rank < grade:  # what was stored on a faster clock is nothing on this one
                y, grade, compressing = (y[0], y[1], y[2], y[3], zero), rank, True
            elif y[4] == 0 and compressing:
                grade = rank
            drive, mu, heed = 1 - level + zero, 1 + zero if level else muw, 1 + zero if rank == grade else zero
            law = (c, m, b, k, d, ee, drive, mu, q[8], heed)
        un = _speed_of_approach(y, vz, q)
        if rank == grade:
            if compressing and un >= -max(1e-12 * speed, ROUNDING * scale):
                # Stronge: the wall gives back e^2 of what it took
                compressing, peak = False, e * e * y[4]
                y = (y[0], y[1], y[2], y[3], peak)
            elif not compressing and e > 0 and un < -max(1e-12 * speed, ROUNDING * scale) and y[4] >= peak * (1 - TINY):
                # Walton & Braun: back along the line of unloading, and from the greatest compression so far along the first
                compressing = True
                y = (y[0], y[1], y[2], y[3], y[4] / (e * e))
            if not compressing and y[4] <= TINY * peak:
                regime = STICK if size(y[0], y[1]) <= tiny else SLIDE
                break
        if floor == OFF and level == 1:  # an infinitely rough wall takes the slip, and may lift the ball with it
            y, vz, hit = _taken(y, vz, law, touching or gap > 0, un)
            touching, decide = touching and vz <= tiny, True
            if hit:
                y, vz = _lands(y, vz, q, kappa, ef, muf, betaf)
                landings += 1
                touching = vz <= 1e-9 * scale or landings > HUMS
            continue
        if waits and wall == SLIDE and floor == FLOOR_SLIP and (size(y[0], y[1]) == 0 or size(y[2], y[3]) == 0):
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
        # Straight lines: any length will do, up to where the gap closes.
        slip = size(y[0], y[1])
        ft, fy = zero, zero
        h = remaining(un, 1, y[4], peak, compressing)
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
            h, dies = touch_down(un, vz, rise, y[4], h, e, compressing, gap), False
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
            y, vz = _lands(y, vz, q, kappa, ef, muf, betaf)
            landings += 1
            touching = vz <= 1e-9 * scale or landings > HUMS
    return y, zero if touching else vz, p, regime, compressing, peak, dw, df


@kernel
def wall_and_floor(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, muw: float, ef: float, muf: float, betaf: float
) -> tuple[Vec, Vec, Vec, Vec, int]:
    """Velocity, spin, impulse (per mass) of the wall, of the floor, regime of the wall contact (or JAM, STALL)."""
    met = meet(v, w, n, a, kappa, muw, ef, muf, betaf)
    v1, s1, j, _frame, q, before, speed, scale = met
    if not speed > 0:
        zero = 0 * a
        return v1, (s1[0] / a, s1[1] / a, s1[2] / a), (zero, zero, zero), j, GRAZE
    after, up, p, regime, _compressing, _peak, _dw, _df = go_on(
        before, v1[2], q, e, kappa, ef, muf, betaf, speed, scale, 0 * a, True, 0 * a, False
    )
    v2, w2, wall, floor = part(v, w, a, kappa, met, after, up, p)
    return v2, w2, wall, floor, regime
