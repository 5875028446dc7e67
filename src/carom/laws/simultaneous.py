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

from carom.kernel import Vec, dot, hot_kernel, kernel
from carom.laws.card import Card
from carom.laws.contact import GRAZE, SLIDE, STICK, slip_velocity, wall_contact
from carom.laws.two_contacts import (
    AT_REST,
    FLOOR_SLIP,
    FLOOR_STICK,
    LEVEL,
    OFF,
    STARTING,
    TINY,
    UP,
    Flow,
    add,
    decide_mode,
    rates,
    start_direction,
    step,
    unit,
)

__all__ = ["CARD", "JAM", "STALL", "pressed_down", "wall_and_floor"]

CARD = Card(
    name="wall-and-floor",
    summary="A ball on the floor that the wall pushes down: both contacts at once, followed in the wall's normal impulse.",
    assumptions=(
        "the floor is rigid: far stiffer than the wall, which is what cloth on slate is to a rubber cushion",
        "Coulomb friction at both contacts, stick and slip followed; tangential restitution 0",
        "the wall returns e^2 of the work it took (Stronge); its force grows in proportion to its compression",
        "the floor's restitution matters only if the ball is lifted and lands again while the wall acts",
    ),
    valid="Backspin, sliding, every cushion that touches above the centre. It is the first step of two-step, by default;"
    " floor_contact='after' is the other limit, a floor softer than the wall. Frictions of 10 and more can lock the ball"
    " in ways that are not followed to their end: the answer then says so.",
    equations="carom.laws.simultaneous",
    citation="J. B. Keller, J. Appl. Mech. 53, 1-4 (1986); W. J. Stronge, Proc. R. Soc. A 431, 169-181 (1990);"
    " G. Darboux, Bull. Sci. Math. 4, 126-160 (1880).",
    doi="10.1115/1.3171712",
)

JAM, STALL = 3, 4
# Stands for an infinite friction: the slip is gone within 1e-8 of the impulse. Where the equations are then too stiff (a
# few pressed balls in a thousand, with infinite friction at the floor), the next smaller one.
FIRM, FIRM_ENOUGH, LEAST_FIRM = 1e8, 1e5, 1e3
ROUNDING = 4e-16  # of the speeds: where a velocity of approach has ended
# The same for where a slip counts as ended: a slip that fades while its direction turns fast is as stiff.
LOOSE, LOOSEST = 1e-7, 3e-6
STEP_ERROR = 1e-10  # of the speed of approach: error of one step
NEARLY_AT_REST = 1e-7  # of the speeds: where a ball that both contacts can hold is held
MOST_STEPS = 10_000


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


@kernel
def _remaining(un: float, rate: float, stored: float, peak: float, compressing: bool) -> float:
    """Impulse until the compression, or the restitution, ends at the present rate of u_n; infinite if it does not.

    A restitution also ends where the ball comes in again and has given back to the wall all that it had returned
    (``peak``): what follows is compression that the wall has not seen yet.
    """
    if compressing:
        return -un / rate if rate > 0 else math.inf
    if un < 0 and stored < peak:
        left = un * un - 2 * rate * (peak - stored)
        if left > 0:
            return 2 * (peak - stored) / (math.sqrt(left) - un)
    left = un * un + 2 * rate * stored
    if left < 0:
        return math.inf
    left = un + math.sqrt(left)
    return 2 * stored / left if left > 0 else math.inf


@kernel
def _gap_growth(un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool) -> float:
    """How the gap under a lifted ball grows (v_z changes at the rate c) while the wall gives the impulse p."""
    # The wall's spring in its own time: q' = -u_n/k, u_n' = q/k with q^2/2 the stored energy, k = 1 or, unloading, e;
    # (u_n, q) turns on a circle. Differences of nearly equal numbers are written out: c may be as large as FIRM.
    k = 1 + 0 * e if compressing else e
    q0 = math.sqrt(2 * stored)
    left = stored - un * p - p * p / 2
    q1 = math.sqrt(2 * left) if left > 0 else 0 * e
    if not q0 + q1 > 0:
        return 0 * e
    fall = p * (2 * un + p) / (q0 + q1)  # q0 - q1
    turn = math.atan2(p * q0 + un * fall, q0 * q1 + un * (un + p))
    return k * (vz * turn + c * (fall - un * turn))


@kernel
def _touch_down(
    un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool, gap: float
) -> float:
    """Impulse in (0, p] at which the gap closes: bisection between its largest value and p, where it is below zero."""
    low = -vz / c if vz > 0 else 0 * p
    high = p
    for _ in range(200):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        if gap + _gap_growth(un, vz, c, stored, middle, e, compressing) > 0:
            low = middle
        else:
            high = middle
    return high


@kernel
def _slip(y: Flow, n: Vec) -> float:
    """Size of the slip at the contact with normal n."""
    u = slip_velocity(y[0], y[1], n, 1)[1]
    return math.sqrt(dot(u, u))


@kernel
def _until_event(y: Flow, k: Flow, n: Vec, wall: int, floor: int, peak: float, compressing: bool, tiny: float) -> float:
    """Impulse until the compression, the restitution or a slip ends, if all goes on at the rates k."""
    un, uw = slip_velocity(y[0], y[1], n, 1)
    _vz, uf = slip_velocity(y[0], y[1], UP, 1)
    h = _remaining(un, dot(k[0], n), y[3], peak, compressing)
    size = math.sqrt(dot(uw, uw))
    if wall == SLIDE and size > tiny:
        fading = -dot(slip_velocity(k[0], k[1], n, 1)[1], uw)
        if fading > 0:
            h = min(h, size * size / fading)
    size = math.sqrt(dot(uf, uf))
    if floor == FLOOR_SLIP and size > tiny:
        fading = -dot(slip_velocity(k[0], k[1], UP, 1)[1], uf)
        if fading > 0:
            h = min(h, size * size / fading)
    return h


@kernel
def _shorter(
    y: Flow, new: Flow, n: Vec, wall: int, floor: int, compressing: bool, tiny: float, speed: float, peak: float
) -> float:
    """A step that ran past an event is taken again, by this share of its length; 1 where it did not."""
    un, uw = slip_velocity(y[0], y[1], n, 1)
    _vz, uf = slip_velocity(y[0], y[1], UP, 1)
    un1, uw1 = slip_velocity(new[0], new[1], n, 1)
    _vz, uf1 = slip_velocity(new[0], new[1], UP, 1)
    share = 1 + 0 * speed
    size = math.sqrt(dot(uw, uw))
    if wall == SLIDE and size > tiny and dot(uw1, uw) < -tiny * size:
        share = 1 / 2 * share
    size = math.sqrt(dot(uf, uf))
    if floor == FLOOR_SLIP and size > tiny and dot(uf1, uf) < -tiny * size:
        share = 1 / 2 * share
    if compressing and un1 > 1e-9 * speed:
        share = min(share, max(0.1, un / (un - un1)))
    if not compressing and new[3] < -TINY * peak:
        share = min(share, max(0.1, y[3] / (y[3] - new[3])))
    return share


@kernel
def _ended(old: Flow, new: Flow, n: Vec, wall: int, floor: int, tiny: float) -> bool:
    """Whether a sliding contact came to rest."""
    for contact in (0, 1):
        d = n if contact == 0 else UP
        if (wall != SLIDE) if contact == 0 else (floor != FLOOR_SLIP):
            continue
        before = slip_velocity(old[0], old[1], d, 1)[1]
        after = slip_velocity(new[0], new[1], d, 1)[1]
        if dot(before, before) > tiny * tiny and dot(after, after) <= tiny * tiny:
            return True
    return False


@kernel
def _follow(  # noqa: PLR0912, PLR0915  (one loop over events; its parts stand above)
    v: Vec,
    w: Vec,
    n: Vec,
    a: float,
    kappa: float,
    e: float,
    muw: float,
    ef: float,
    muf: float,
    betaf: float,
    firm: float,
    rest: float,
) -> tuple[Vec, Vec, Vec, Vec, int]:
    """:func:`wall_and_floor` with ``firm`` for the largest friction, and slips below ``rest`` of the speeds ended."""
    zero = 0 * a
    v0 = v
    s = (a * w[0], a * w[1], a * w[2])
    j = (zero, zero, zero)
    if v[2] < 0:  # a rigid floor answers first, and may send the ball away from the wall
        v, s, j, _required, _regime = wall_contact(v, s, UP, 1, kappa, ef, muf, betaf)
    if not dot(v, n) < 0:
        return v, (s[0] / a, s[1] / a, s[2] / a), (zero, zero, zero), j, GRAZE
    speed = -dot(v, n)
    scale = math.sqrt(dot(v, v)) + math.sqrt(dot(s, s))
    tiny = rest * scale
    allowed = max(STEP_ERROR * speed, STEP_ERROR * scale / 1000)
    muw, muf = min(muw, firm), min(muf, firm)
    y = (v, s, (zero, zero, zero), zero)
    dw = df = (zero, zero, zero)
    compressing, touching, decide = True, v[2] <= tiny, True
    wall, floor, regime = SLIDE, OFF, STALL
    p, gap, pace, peak = zero, zero, math.inf, zero
    starts_wall = starts_floor = False
    for _ in range(MOST_STEPS):
        if touching:
            y = ((y[0][0], y[0][1], zero), y[1], y[2], y[3])
        if decide:
            wall, floor, dw, df = decide_mode(y, n, kappa, muw, muf, touching, dw, df, tiny)
            decide, pace = False, math.inf
            starts_wall = wall == SLIDE and _slip(y, n) <= tiny
            starts_floor = floor == FLOOR_SLIP and _slip(y, UP) <= tiny
        starts_wall = starts_wall and _slip(y, n) < STARTING * scale
        starts_floor = starts_floor and _slip(y, UP) < STARTING * scale
        # (a wide margin: within one step the direction must not switch from one rule to the other)
        small = 10 * STARTING * scale if starts_wall or starts_floor else tiny
        if not starts_wall:
            dw, _size = unit(slip_velocity(y[0], y[1], n, 1)[1], dw, tiny)
        if not starts_floor:
            df, _size = unit(slip_velocity(y[0], y[1], UP, 1)[1], df, tiny)
        if touching and max(abs(dot(y[0], n)), _slip(y, n), _slip(y, UP)) < max(NEARLY_AT_REST, 30 * rest) * scale:
            _k, spare = rates(y, n, kappa, muw, muf, STICK, FLOOR_STICK, dw, df, math.inf)
            if spare > 0:
                regime = JAM  # at rest on both contacts, and both cones hold it there
                break
        k, spare = rates(y, n, kappa, muw, muf, wall, floor, dw, df, small)
        if floor == FLOOR_STICK and wall == STICK and not dot(k[0], n) > TINY:
            regime = JAM  # rolling on both contacts: the ball can only turn about the line through them
            break
        h = _until_event(y, k, n, wall, floor, peak, compressing, tiny)
        hit = False
        if floor == OFF:  # straight lines: any length will do, up to where the gap closes
            un, vz, c = dot(y[0], n), y[0][2], k[0][2]
            touching = touching and abs(c) <= LEVEL * (1 + math.sqrt(dot(k[2], k[2])))
            c = zero if touching else c
            grown = gap + _gap_growth(un, vz, c, y[3], h, e, compressing)
            if grown <= 0 and vz + h * c < 0:
                h, hit = _touch_down(un, vz, c, y[3], h, e, compressing, gap), True
            gap = zero if hit else max(grown, zero)
            v, s, f, stored = add(y, h, k)
            new = (v, s, f, stored - h * h / 2)
        else:
            h = min(h, pace, 10 * speed)
            if starts_wall or starts_floor:
                # A slip that grows from nothing turns at once to where its rate points: the direction at mid-step.
                h = min(h, speed / 2000)
                new, error, spare1 = step(y, k, h / 2, n, kappa, muw, muf, wall, floor, dw, df, small)
                if starts_wall:
                    dw, _starts = start_direction(new, n, kappa, muw, muf, wall, floor, dw, df, True)
                if starts_floor:
                    df, _starts = start_direction(new, n, kappa, muw, muf, wall, floor, dw, df, False)
                k, _spare = rates(y, n, kappa, muw, muf, wall, floor, dw, df, small)
            new, error, spare1 = step(y, k, h, n, kappa, muw, muf, wall, floor, dw, df, small)
            if error > allowed:
                pace = h * max(0.2, 0.9 * (allowed / error) ** 0.2)
                continue
            share = _shorter(y, new, n, wall, floor, compressing, tiny, speed, peak)
            if spare1 < 0 and spare > LEVEL:
                share = min(share, 0.9, max(0.1, spare / (spare - spare1)))
            elif spare1 < -LEVEL:
                share = 1 / 2 * share
            still = h * math.sqrt(dot(k[0], k[0]) + dot(k[1], k[1])) < 1e-13 * scale
            if share < 1 and not still:
                pace = h * share
                continue
            decide = spare1 <= LEVEL or still  # a step too short to move anything: this mode has come to its end
            pace = 4 * h if error < allowed / 1024 else h * 0.9 * (allowed / error) ** 0.2
        decide = decide or hit or _ended(y, new, n, wall, floor, tiny)
        y = new
        p += h
        if hit:
            v, s, _j, _required, _regime = wall_contact(y[0], y[1], UP, 1, kappa, ef, muf, betaf)
            y = (v, s, y[2], y[3])
            touching = v[2] <= 1e-9 * scale
        if compressing and dot(y[0], n) >= -max(1e-13 * speed, ROUNDING * scale):
            # Stronge: the wall gives back e^2 of what it took
            compressing, peak = False, e * e * y[3]
            y = (y[0], y[1], y[2], peak)
            decide = True
        elif not compressing and e > 0 and dot(y[0], n) < 0 and y[3] >= peak * (1 - TINY):
            # Walton & Braun: back along the line of unloading, and from the greatest compression so far along the first
            compressing = True
            y = (y[0], y[1], y[2], y[3] / (e * e))
        if not compressing and y[3] <= 1e-14 * peak:
            uw = slip_velocity(y[0], y[1], n, 1)[1]
            regime = STICK if dot(uw, uw) <= tiny * tiny else SLIDE
            break
    v, s, f, _stored = y
    if touching:
        v = (v[0], v[1], zero)
    wall_impulse = (p * n[0] + f[0], p * n[1] + f[1], p * n[2] + f[2])
    floor_impulse = (
        v[0] - v0[0] - wall_impulse[0],
        v[1] - v0[1] - wall_impulse[1],
        v[2] - v0[2] - wall_impulse[2],
    )
    return v, (s[0] / a, s[1] / a, s[2] / a), wall_impulse, floor_impulse, regime


@kernel
def wall_and_floor(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, muw: float, ef: float, muf: float, betaf: float
) -> tuple[Vec, Vec, Vec, Vec, int]:
    """Velocity, spin, impulse (per mass) of the wall, of the floor, regime of the wall contact (or JAM, STALL)."""
    answer = _follow(v, w, n, a, kappa, e, muw, ef, muf, betaf, FIRM, AT_REST)
    if answer[4] == STALL:
        answer = _follow(v, w, n, a, kappa, e, muw, ef, muf, betaf, FIRM_ENOUGH, AT_REST)
    if answer[4] == STALL:
        answer = _follow(v, w, n, a, kappa, e, muw, ef, muf, betaf, FIRM_ENOUGH, LOOSE)
    if answer[4] == STALL:
        answer = _follow(v, w, n, a, kappa, e, muw, ef, muf, betaf, LEAST_FIRM, LOOSEST)
    return answer
