"""An independent reference for the laws of impact: contacts that are springs.

Nothing here knows the library's laws; a ball of mass 1 and radius 1 touches a wall (unit normal n, any direction)
and the floor (normal k = (0, 0, 1)). Speeds may be in any unit; a spin is then speed over radius. The overlaps are
small against the radius, so the geometry is frozen, and gravity is small against the forces of contact.

``spring_contact`` gives both contacts springs (wall stiffness 1, floor stiffness r) and integrates Newton's equations in
time by Radau's method of order 5; ``rigid_floor.py`` has the limit of r to infinity.

Each spring is Walton & Braun's (J. Rheology 30, 1986, 949): loaded along N = k d, unloaded along a line e^-2 times as
steep, loaded again along that line up to the greatest overlap so far. So a share e^2 of the work done on it comes
back, whatever the ball's other contact does meanwhile: energetic restitution, without being put in as a rule.
"""

import functools
import math
from dataclasses import dataclass

import numpy as np
from reference.compiling import part

from carom.core.jit.compile import njit

FLOOR = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Outcome:
    """The ball as it leaves the wall."""

    velocity: np.ndarray
    spin: np.ndarray
    lifted: bool  # the floor does not press as the ball leaves the wall
    jammed: bool  # the wall's spring was never released
    duration: float  # of the wall's contact, in units of sqrt(mass / wall stiffness)
    touchdowns: tuple[float, ...]  # when the ball, once lifted, came down during the wall's contact
    after_floor: np.ndarray | None = None  # velocity and spin once it leaves the floor too

    @property
    def state(self):
        return np.concatenate([self.velocity, self.spin])


class Spring:
    """A contact that gives back the share e^2 of the work done on it; or with a dashpot at a share of critical damping.

    It pushes and never pulls. The compiled equations read ``numbers``: stiffness, constant of the dashpot, whether the spring
    is loaded, its greatest overlap so far, and the overlap at which it is free.
    """

    def __init__(self, stiffness, e=None, damping=None):
        self.e, self.damped = e, damping is not None
        self.numbers = np.array([stiffness, 2 * damping * math.sqrt(stiffness) if self.damped else 0.0, 1.0, 0.0, 0.0])

    @property
    def loading(self):
        return self.numbers[2] == 1.0

    @property
    def greatest(self):
        return float(self.numbers[3])

    @property
    def rest(self):
        return float(self.numbers[4])

    def load(self):
        """From here on it is loaded."""
        self.numbers[2] = 1.0

    @property
    def away(self):
        return self.numbers[2] == 2.0

    def leave(self):
        """From here on it is out of touch."""
        self.numbers[2] = 2.0

    def turn(self, d):
        """From here on it is unloaded; where nothing comes back it is free at once."""
        self.numbers[2:] = 0.0, d, d * (1.0 - self.e**2)

    def force(self, d, speed):
        return push_of(self.numbers, d, speed)[0]


# ------------------------------------------------------------------------------- Newton's equations


def contact_maps(kappa, m):
    """For a contact of normal m: the slip of the ball's point there, of (v, w); the rates of (v, w), of a push there."""
    skew = np.array([[0.0, -m[2], m[1]], [m[2], 0.0, -m[0]], [-m[1], m[0], 0.0]])
    slip = (np.eye(3) - np.outer(m, m)) @ np.hstack([np.eye(3), skew])  # v + w x (-m)
    return slip, np.vstack([np.eye(3), -skew / kappa])  # (-m) x F: only friction turns the ball


@part
def push_of(spring, d, speed):
    """The push of a contact whose overlap d changes at -speed, and its derivatives by both."""
    stiffness, dashpot, loaded, greatest, rest = spring[0], spring[1], spring[2], spring[3], spring[4]
    if loaded == 1.0:
        push = stiffness * d - dashpot * speed
        return (push, stiffness, -dashpot) if d > 0.0 and push > 0.0 else (0.0, 0.0, 0.0)
    if loaded == 2.0 or d <= rest:
        return 0.0, 0.0, 0.0
    slope = stiffness * greatest / (greatest - rest)
    return slope * (d - rest), slope, 0.0


@part
def equations(y, ball, rates, jacobian, with_jacobian):
    """Newton's equations of y = (v, w, overlap at the wall, at the floor); by hand also their derivatives by y.

    (Differences cannot resolve a velocity scale as small as ``creep``.)
    """
    normals, slips, pulls, springs, frictions, creep = ball
    rates[:] = 0.0
    if with_jacobian:
        jacobian[:] = 0.0
    for c in range(2):
        at, m, slip, pull = 6 + c, normals[c], slips[c], pulls[c]
        speed = m[0] * y[0] + m[1] * y[1] + m[2] * y[2]
        push, by_overlap, by_speed = push_of(springs[c], y[at], speed)
        ux = uy = uz = 0.0
        for k in range(6):
            ux, uy, uz = ux + slip[0, k] * y[k], uy + slip[1, k] * y[k], uz + slip[2, k] * y[k]
        s = math.sqrt(ux * ux + uy * uy + uz * uz + creep * creep)
        ux, uy, uz = ux / s, uy / s, uz / s
        rub = frictions[c]
        rates[at] = -speed
        for i in range(6):
            force = pull[i, 0] * (m[0] - rub * ux) + pull[i, 1] * (m[1] - rub * uy) + pull[i, 2] * (m[2] - rub * uz)
            rates[i] += push * force
            if with_jacobian:
                jacobian[i, at] += force * by_overlap
                for k in range(3):
                    jacobian[i, k] += force * by_speed * m[k]
        if with_jacobian:
            rub *= push / s
            for k in range(6):  # d(u/s)/dy = (slip - u (u . slip)/s^2)/s
                along = ux * slip[0, k] + uy * slip[1, k] + uz * slip[2, k]
                tx, ty, tz = slip[0, k] - ux * along, slip[1, k] - uy * along, slip[2, k] - uz * along
                for i in range(6):
                    jacobian[i, k] -= rub * (pull[i, 0] * tx + pull[i, 1] * ty + pull[i, 2] * tz)
            for k in range(3):
                jacobian[at, k] = -m[k]


# ------------------------------------------------------------------------------- Radau's method (Hairer & Wanner II, IV.8)

ROOT = math.sqrt(6.0)
STAGES = np.array(
    [
        [(88 - 7 * ROOT) / 360, (296 - 169 * ROOT) / 1800, (-2 + 3 * ROOT) / 225],
        [(296 + 169 * ROOT) / 1800, (88 + 7 * ROOT) / 360, (-2 - 3 * ROOT) / 225],
        [(16 - ROOT) / 36, (16 + ROOT) / 36, 1 / 9],
    ]
)
ERROR = np.array([-13 - 7 * ROOT, -13 + 7 * ROOT, -1.0]) / 3  # weights of the embedded estimate
REAL = 3 + 3 ** (2 / 3) - 3 ** (1 / 3)  # the real eigenvalue of STAGES^-1
TURNS = 10  # of Newton's method, at most
MOST_STEPS = 100_000  # of one integration, which takes some hundred


@part
def _factor(a, order, n):
    """Replace a by its triangular factors, of rows that are exchanged in an order."""
    for j in range(n):
        best = j
        for i in range(j + 1, n):
            if abs(a[i, j]) > abs(a[best, j]):
                best = i
        order[j] = best
        if best != j:
            for k in range(n):
                a[j, k], a[best, k] = a[best, k], a[j, k]
        for i in range(j + 1, n):
            if a[i, j] != 0.0:
                a[i, j] /= a[j, j]
                for k in range(j + 1, n):
                    a[i, k] -= a[i, j] * a[j, k]


@part
def _solve(a, order, b, n):
    """Replace b by the solution x of a x = b, of the factors of a."""
    for j in range(n):
        b[j], b[order[j]] = b[order[j]], b[j]
    for i in range(1, n):
        for k in range(i):
            b[i] -= a[i, k] * b[k]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]


@part
def _stages_of(y, h, ball, jacobian, rtol, atol, z, work):
    """Solve z = h STAGES f(y + z) by Newton's method with the derivatives at y; return after how many turns, 0 if it fails."""
    n = len(y)
    wide, order, rest, place, rates, unused = work
    for i in range(3):
        for j in range(3):
            for k in range(n):
                for m in range(n):
                    wide[n * i + k, n * j + m] = -h * STAGES[i, j] * jacobian[k, m]
    for k in range(3 * n):
        wide[k, k] += 1.0
    _factor(wide, order, 3 * n)
    z[:] = 0.0
    before = 0.0
    for turn in range(1, TURNS + 1):
        for i in range(3):
            for k in range(n):
                place[k] = y[k] + z[i, k]
            equations(place, ball, rates[i], unused, False)
        for i in range(3):
            for k in range(n):
                change = STAGES[i, 0] * rates[0, k] + STAGES[i, 1] * rates[1, k] + STAGES[i, 2] * rates[2, k]
                rest[n * i + k] = h * change - z[i, k]
        _solve(wide, order, rest, 3 * n)
        size = 0.0
        for i in range(3):
            for k in range(n):
                z[i, k] += rest[n * i + k]
                size += (rest[n * i + k] / (atol + rtol * abs(y[k]))) ** 2
        size = math.sqrt(size / (3 * n))
        share = size / before if turn > 1 else 1.0
        if size == 0.0 or (share < 1.0 and share / (1.0 - share) * size < min(0.03, math.sqrt(rtol))):
            return turn
        if not size < 1e100 or (turn > 1 and share >= 1.0):
            return 0
        before = size
    return 0


@part
def _error_of(y, h, ball, rates, jacobian, rtol, atol, z, work):
    """The embedded estimate of a step's error, in units of what is allowed."""
    n = len(y)
    a, order, error, place, unused = work
    for i in range(n):
        for k in range(n):
            a[i, k] = -jacobian[i, k]
        a[i, i] += REAL / h
    _factor(a, order, n)
    size = 0.0
    for again in range(2):
        if again:  # what is stiff, filtered a second time
            for k in range(n):
                error[k] += y[k]
            equations(error, ball, place, unused, False)
        for k in range(n):
            error[k] = (place[k] if again else rates[k]) + (
                ERROR[0] * z[0, k] + ERROR[1] * z[1, k] + ERROR[2] * z[2, k]
            ) / h
        _solve(a, order, error, n)
        size = 0.0
        for k in range(n):
            size += (error[k] / (atol + rtol * max(abs(y[k]), abs(y[k] + z[2, k])))) ** 2
        size = math.sqrt(size / n)
        if size < 1.0:
            break
    return size


@part
def _greatest(events, values, watched, y, z):
    """Evaluate the events at the end of a step; return the greatest of those that are watched."""
    n, found = len(y), -math.inf
    for k in range(len(events)):
        values[k] = events[k, n]
        for i in range(n):
            values[k] += events[k, i] * (y[i] + z[2, i])
        if watched[k]:
            found = max(found, values[k])
    return found


def _advance(y, t, until, events, watched, ball, rtol, atol, work):
    """Integrate until a time, or to the first zero of an event; y is changed.

    Return the time, NaN where no step succeeds, or too many are needed.

    An event is a row of 8 factors of y and an offset: it happens where its value, negative at the beginning of a step, comes to 0.
    ``watched`` says at the end which have happened.
    """
    n, h = len(y), 1e-6
    rates, jacobian, z, best, values, inner, outer = work
    steps = 0
    while t < until:
        steps += 1
        if steps > MOST_STEPS:
            return math.nan
        for k in range(len(events)):
            watched[k] = True
        z[:] = 0.0
        low, below = 0.0, _greatest(events, values, watched, y, z)
        for k in range(len(events)):
            watched[k] = values[k] < 0.0
        equations(y, ball, rates, jacobian, True)
        high, above, side, free = math.inf, 0.0, 0, h
        while True:
            h = min(h, until - t)
            if not t + h > t:
                return math.nan
            turns = _stages_of(y, h, ball, jacobian, rtol, atol, z, inner)
            if turns == 0:
                if high < math.inf:
                    return math.nan
                h *= 0.5
                continue
            if high == math.inf:
                wrong = _error_of(y, h, ball, rates, jacobian, rtol, atol, z, outer)
                factor = 0.9 * (2 * TURNS + 1) / (2 * TURNS + turns) * max(wrong, 1e-8) ** -0.25
                if wrong >= 1.0:
                    h *= max(0.2, factor)
                    continue
                free = h * min(8.0, factor)
            passed = _greatest(events, values, watched, y, z)
            near = False
            if passed >= 0.0:
                if side == 1:
                    below *= 0.5
                high, above, side, near = h, passed, 1, passed <= 1e-4 * atol
                for k in range(n):
                    best[k] = z[2, k]
            elif high == math.inf:
                break
            else:
                if side == -1:
                    above *= 0.5
                low, below, side = h, passed, -1
            # the shortest step at whose end an event has happened: false position, halved where one end stays (Illinois)
            h = (low * above - high * below) / (above - below)
            if not low < h < high:
                h = 0.5 * (low + high)
            if near or not low < h < high:
                for k in range(n):
                    z[2, k] = best[k]
                _greatest(events, values, watched, y, z)
                for k in range(len(events)):
                    watched[k] = watched[k] and values[k] >= 0.0
                for k in range(n):
                    y[k] += best[k]
                return t + high
        for k in range(n):
            y[k] += z[2, k]
        t, h = t + h, free
    for k in range(len(events)):
        watched[k] = False
    return t


@functools.cache
def _compiled():
    return njit(_advance, _nrt=False)


def advance(y, t, until, events, ball, rtol, atol):
    """Integrate ``equations`` until a time or the first zero of an event; y is changed. Return the time, and what has happened."""
    table, order, row = np.empty((24, 24)), np.empty(24, np.int64), np.empty(24)
    inner = table, order, row, np.empty(8), np.empty((3, 8)), np.empty((8, 8))
    outer = np.empty((8, 8)), np.empty(8, np.int64), np.empty(8), np.empty(8), np.empty((8, 8))
    room = np.empty(8), np.empty((8, 8)), np.empty((3, 8)), np.empty(8), np.empty(len(events)), inner, outer
    happened = np.zeros(len(events), dtype=bool)
    t = _compiled()(y, t, float(until), np.array(events), happened, ball, rtol, atol, room)
    if math.isnan(t):
        raise RuntimeError("the integration stopped: no step is short enough, or too many are")
    return t, happened


# ------------------------------------------------------------------------------- both contacts are springs


def overlap(contact, at, sign=1.0):
    """The event that the overlap of contact 0 (wall) or 1 (floor) grows to a value; falls to it for sign -1."""
    row = np.zeros(9)
    row[6 + contact], row[8] = sign, -sign * at
    return row


def speed(m, sign=1.0):
    """The event that the velocity along m turns positive; negative for sign -1."""
    return sign * np.array([*m, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])


def ball_between(kappa, n, wall, floor, wall_mu, floor_mu, creep):
    """What ``equations`` read of a ball between two springs."""
    maps = [contact_maps(kappa, m) for m in (n, FLOOR)]
    springs = np.array([wall.numbers, floor.numbers])
    return (
        np.array([n, FLOOR]),
        *map(np.array, zip(*maps, strict=True)),
        springs,
        np.array([wall_mu, floor_mu]),
        creep,
    )


def spring_contact(
    kappa,
    velocity,
    spin,
    normal,
    *,
    wall_e,
    wall_mu,
    floor_mu,
    ratio,
    floor_e=None,
    floor_damping=None,
    creep=1e-7,
    rtol=1e-8,
    atol=1e-11,
    longest=40.0,
    follow_floor=False,
):
    """Integrate both contacts in time; the ball starts on the floor and touching the wall.

    Friction is mu N against the slip u, as mu N u / sqrt(u^2 + creep^2): a sticking contact creeps at about `creep`,
    so the result is off by O(creep). The floor is Walton-Braun's with ``floor_e``, or a spring and dashpot with
    ``floor_damping``. Radau, because a sticking contact is as stiff as mu N / creep; each change of a spring between
    loading and unloading is an event, and the integration starts anew there.
    """
    n = tuple(float(c) for c in normal)
    damped = floor_damping is not None
    wall, floor = Spring(1.0, wall_e), Spring(float(ratio), floor_e, floor_damping)

    def ball():
        return ball_between(kappa, n, wall, floor, wall_mu, floor_mu, creep)

    def wall_events():
        if wall.loading:
            return {"wall turns": speed(n)}
        return {"wall leaves": overlap(0, wall.rest, -1.0), "wall reloads": overlap(0, wall.greatest)}

    def floor_events():
        down = {"floor meets": overlap(1, 0.0)}
        if damped:  # its push jumps where they meet
            return down if floor.away else {"floor parts": overlap(1, 0.0, -1.0)}
        if not floor.loading:
            return {"floor leaves": overlap(1, floor.rest, -1.0), "floor reloads": overlap(1, floor.greatest)}
        # watch for one sign of v_z at a time: each integration starts at the zero that ended the last one
        return {**down, **({"floor turns": speed(FLOOR)} if falling else {"floor falls": speed(FLOOR, -1.0)})}

    y = np.array([*velocity, *spin, 0.0, 0.0], dtype=float)
    rates = np.empty(8)
    equations(np.array([*y[:6], 1e-9, 0.0]), ball(), rates, rates, False)
    falling = rates[2] < 0.0  # or does the wall's first push lift the ball?
    if damped and not falling:
        floor.leave()
    t, touchdowns, left = 0.0, [], None
    while t < longest:
        events = floor_events() if left else {**wall_events(), **floor_events()}
        t, happened = advance(y, t, longest, list(events.values()), ball(), rtol, atol)
        hits = [what for what, has in zip(events, happened, strict=True) if has]
        if "floor meets" in hits:
            touchdowns.append(t)
            floor.load()
        if "floor parts" in hits:
            floor.leave()
        if "wall turns" in hits:
            wall.turn(y[6])
        if "wall reloads" in hits:
            wall.load()
        if "floor turns" in hits and y[7] > 0.0:
            floor.turn(y[7])
        if "floor leaves" in hits:
            y[7] = 0.0  # the next touch is with a floor that has healed
        if "floor leaves" in hits or "floor reloads" in hits:
            floor.load()
        falling = (falling or "floor falls" in hits or "floor reloads" in hits) and not (
            "floor turns" in hits or "floor leaves" in hits
        )
        if "wall leaves" in hits or ("wall turns" in hits and wall_e == 0.0):
            left = (y[:6].copy(), floor.force(y[7], y[2]) <= 0.0, t)
            wall.turn(0.0)
            y[6] = -1.0  # away for good
        if left and (not follow_floor or "floor leaves" in hits or (left[1] and y[2] >= 0.0)):
            break
    state, lifted, duration = left or (y[:6], floor.force(y[7], y[2]) <= 0.0, t)
    after = y[:6] if follow_floor and y[2] >= 0.0 else None
    return Outcome(state[:3], state[3:], lifted, left is None, duration, tuple(touchdowns), after)


def stiff_limit(*args, ratios=(1e4, 1e6), order=1.0, **kwargs):
    """``spring_contact`` extrapolated to an infinite floor stiffness, the error falling as ratio^-order."""
    a, b = (spring_contact(*args, ratio=r, **kwargs).state for r in ratios)
    weight = (ratios[1] / ratios[0]) ** order
    return (weight * b - a) / (weight - 1.0)
