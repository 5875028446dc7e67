"""Two independent references for the laws of impact: contacts that are springs, and a floor that is rigid.

Nothing here knows the library's laws; a ball of mass 1 and radius 1 touches a wall (unit normal n, any direction)
and the floor (normal k = (0, 0, 1)). Speeds may be in any unit; a spin is then speed over radius. The overlaps are
small against the radius, so the geometry is frozen, and gravity is small against the forces of contact.

``spring_contact`` gives both contacts springs (wall stiffness 1, floor stiffness r) and integrates Newton's
equations in time with SciPy. ``rigid_floor`` takes r to infinity: the floor gives just the push that keeps the ball
out of it, found step by step by projection; slow, first order in the step, and made to be obviously right.

Each spring is Walton & Braun's (J. Rheology 30, 1986, 949): loaded along N = k d, unloaded along a line e^-2 times as
steep, loaded again along that line up to the greatest overlap so far. So a share e^2 of the work done on it comes
back, whatever the ball's other contact does meanwhile: energetic restitution, without being put in as a rule.
"""

import functools
import math
from dataclasses import dataclass

import numba
import numpy as np
from scipy.integrate import solve_ivp

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
    """A contact that gives back the share e^2 of the work done on it."""

    def __init__(self, stiffness, e, power=1.0):
        self.stiffness, self.e, self.power = stiffness, e, power
        self.loading, self.greatest, self.rest = True, 0.0, 0.0

    def force(self, d):
        if self.loading:
            return self.stiffness * max(0.0, d) ** self.power
        if d <= self.rest:
            return 0.0
        back = (d - self.rest) / (self.greatest - self.rest)
        return self.stiffness * self.greatest**self.power * back**self.power

    def slope(self, d):
        """Return dN/dd, for power 1."""
        if self.loading:
            return self.stiffness if d > 0.0 else 0.0
        return self.stiffness / self.e**2 if d > self.rest else 0.0

    def turn(self, d):
        """From here on it is unloaded; where nothing comes back it is free at once."""
        self.loading, self.greatest, self.rest = False, d, d * (1.0 - self.e**2)


class Dashpot:
    """A spring with a dashpot at the given share of critical damping; it pushes and never pulls."""

    def __init__(self, stiffness, damping):
        self.stiffness, self.c = stiffness, 2.0 * damping * math.sqrt(stiffness)

    def force(self, d, speed):
        return max(0.0, self.stiffness * d - self.c * speed) if d > 0.0 else 0.0


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


def slip_velocity(v, w, n):
    """Normal and tangential velocity of the ball's point that touches the surface of normal n."""
    s = cross(n, w)  # = w x (-n)
    u = (v[0] + s[0], v[1] + s[1], v[2] + s[2])
    un = u[0] * n[0] + u[1] * n[1] + u[2] * n[2]
    return un, (u[0] - un * n[0], u[1] - un * n[1], u[2] - un * n[2])


# ------------------------------------------------------------------------------- both contacts are springs


def equations(kappa, n, wall, floor, wall_mu, floor_mu, creep):
    """Newton's equations of the ball on two springs, y = (v, w, wall overlap, floor overlap), and their Jacobian."""
    c2 = creep * creep
    damped = isinstance(floor, Dashpot)

    def floor_force(d, vz):
        return floor.force(d, vz) if damped else floor.force(d)

    def rates(_t, y):
        y = y.tolist()  # plain floats are quicker than array elements
        v, w = y[0:3], y[3:6]
        vn, tw = slip_velocity(v, w, n)
        vz, tf = slip_velocity(v, w, FLOOR)
        nw, nf = wall.force(y[6]), floor_force(y[7], vz)
        fw = -wall_mu * nw / math.sqrt(tw[0] ** 2 + tw[1] ** 2 + tw[2] ** 2 + c2)
        ff = -floor_mu * nf / math.sqrt(tf[0] ** 2 + tf[1] ** 2 + c2)
        tw = (fw * tw[0], fw * tw[1], fw * tw[2])
        tf = (ff * tf[0], ff * tf[1], 0.0)
        qw, qf = cross(tw, n), cross(tf, FLOOR)  # (-n) x F: only friction turns the ball
        return [
            nw * n[0] + tw[0] + tf[0],
            nw * n[1] + tw[1] + tf[1],
            nw * n[2] + tw[2] + nf,
            (qw[0] + qf[0]) / kappa,
            (qw[1] + qf[1]) / kappa,
            (qw[2] + qf[2]) / kappa,
            -vn,
            -vz,
        ]

    maps = []
    for m in (n, FLOOR):
        skew = np.array([[0.0, -m[2], m[1]], [m[2], 0.0, -m[0]], [-m[1], m[0], 0.0]])
        slip = (np.eye(3) - np.outer(m, m)) @ np.hstack([np.eye(3), skew])
        maps.append((slip, np.vstack([np.eye(3), -skew / kappa]), np.array(m)))

    def jacobian(_t, y):
        # by hand: differences cannot resolve a velocity scale as small as `creep`
        nf = floor_force(y[7], y[2])
        pressed = damped and nf > 0.0
        floor_slope = (floor.stiffness if pressed else 0.0) if damped else floor.slope(y[7])
        contacts = ((6, wall_mu, wall.force(y[6]), wall.slope(y[6])), (7, floor_mu, nf, floor_slope))
        jac = np.zeros((8, 8))
        for (slip, pull, m), (at, mu, force, slope) in zip(maps, contacts, strict=True):
            u = slip @ y[:6]
            s = math.sqrt(u @ u + c2)
            per_push = pull @ (m - (mu / s) * u)
            jac[:6, :6] -= pull @ (mu * force * (np.eye(3) / s - np.outer(u, u) / s**3)) @ slip
            jac[:6, at] += per_push * slope
            jac[at, :3] = -m
            if at == 7 and pressed:
                jac[:6, 2] -= per_push * floor.c
        return jac

    return rates, jacobian, floor_force


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
    wall = Spring(1.0, wall_e)
    floor = Dashpot(float(ratio), floor_damping) if damped else Spring(float(ratio), floor_e)
    rates, jacobian, floor_force = equations(kappa, n, wall, floor, wall_mu, floor_mu, creep)

    def event(f, direction, terminal=True):
        f.direction, f.terminal = direction, terminal
        return f

    def wall_events():
        if wall.loading:
            return {"wall turns": event(lambda t, y: y[0] * n[0] + y[1] * n[1] + y[2] * n[2], 1)}
        return {
            "wall leaves": event(lambda t, y: y[6] - wall.rest, -1),
            "wall reloads": event(lambda t, y: y[6] - wall.greatest, 1),
        }

    def floor_events():
        down = {"floor meets": event(lambda t, y: y[7], 1, terminal=False)}
        if damped:
            return down
        if not floor.loading:
            return {
                "floor leaves": event(lambda t, y: y[7] - floor.rest, -1),
                "floor reloads": event(lambda t, y: y[7] - floor.greatest, 1),
            }
        # watch for one sign of v_z at a time: each integration starts at the zero that ended the last one
        name, sign = ("floor turns", 1) if falling else ("floor falls", -1)
        return {**down, name: event(lambda t, y: y[2], sign)}

    y = np.array([*velocity, *spin, 0.0, 0.0], dtype=float)
    falling = rates(0.0, np.array([*y[:6], 1e-9, 0.0]))[2] < 0.0  # or does the wall's first push lift the ball?
    t, touchdowns, left = 0.0, [], None
    while t < longest:
        events = floor_events() if left else {**wall_events(), **floor_events()}
        out = solve_ivp(
            rates, (t, longest), y, "Radau", jac=jacobian, events=list(events.values()), rtol=rtol, atol=atol
        )
        if out.status == -1:
            raise RuntimeError(f"the integration stopped: {out.message}")
        t, y = float(out.t[-1]), out.y[:, -1].copy()
        times = dict(zip(events, out.t_events, strict=True))
        touchdowns += [float(s) for s in times.get("floor meets", ()) if s > 0.0]
        hits = [what for what, s in times.items() if s.size and s[-1] == t]
        if "wall turns" in hits:
            wall.turn(y[6])
        if "wall reloads" in hits:
            wall.loading = True
        if "floor turns" in hits and y[7] > 0.0:
            floor.turn(y[7])
        if "floor leaves" in hits:
            y[7] = 0.0  # the next touch is with a floor that has healed
        if "floor leaves" in hits or "floor reloads" in hits:
            floor.loading = True
        falling = (falling or "floor falls" in hits or "floor reloads" in hits) and not (
            "floor turns" in hits or "floor leaves" in hits
        )
        if "wall leaves" in hits or ("wall turns" in hits and wall_e == 0.0):
            left = (y[:6].copy(), floor_force(y[7], y[2]) <= 0.0, t)
            wall.turn(0.0)
            y[6] = -1.0  # away for good
        if left and (not follow_floor or "floor leaves" in hits or (left[1] and y[2] >= 0.0)):
            break
    state, lifted, duration = left or (y[:6], floor_force(y[7], y[2]) <= 0.0, t)
    after = y[:6] if follow_floor and y[2] >= 0.0 else None
    return Outcome(state[:3], state[3:], lifted, left is None, duration, tuple(touchdowns), after)


# ------------------------------------------------------------------------------- the floor is rigid


def rigid_floor(
    kappa,
    velocity,
    spin,
    normal,
    *,
    wall_e,
    wall_mu,
    floor_mu,
    floor_e=0.0,
    steps=2000,
    power=1.0,
    floor=True,
    again="gap",
    longest=40.0,
):
    """Follow the wall's push in small equal steps of time, the floor rigid (or absent); first order in the step.

    The wall's spring may be N = d^power: as long as the ball does not come down again during the contact, the
    outcome must not depend on it. A lifted ball that is pressed down meets the floor ``again`` when the "gap" has
    closed, with a blow in which the floor's restitution matters (that is the limit of spring contacts); for
    comparison with laws that know impulse and no time, already when its "velocity" has come back to zero, or "never".
    """
    v, w, n = (np.array(vector, dtype=float) for vector in (velocity, spin, normal))
    lifted, jammed, t, touchdowns = _compiled()(
        v, w, n, float(kappa), float(wall_e), float(wall_mu), float(floor_mu), float(floor_e), int(steps), float(power), floor,
        again == "gap", again == "velocity", float(longest),
    )  # fmt: skip
    return Outcome(v, w, bool(lifted), jammed, t, tuple(touchdowns.tolist()))


@functools.cache
def _compiled():
    """The loop, compiled, for it takes some 10^7 steps of the projection."""
    return njit(_follow_rigid)


def _follow_rigid(
    v, w, n, kappa, wall_e, wall_mu, floor_mu, floor_e, steps, power, floor, lands_by_gap, lands_by_velocity, longest
):
    """Follow the push; v and w are changed. Return whether the floor does not press at the end, whether jammed, time, landings."""
    up = (0.0, 0.0, 1.0)
    loading, greatest, rest = True, 0.0, 0.0
    dt = math.pi / 2 / steps  # `steps` steps up to the greatest compression by a wall alone with N = d
    d, t, gap, touching = 0.0, 0.0, 0.0, floor
    touchdowns, landings = np.empty(1000), 0
    # frictions of wall and floor, and the floor's push, per push of the wall: where the next step's projection begins
    guess_w, guess_f, guess_n = np.zeros(3), np.zeros(3), 0.0
    while t < longest:
        half = d - 0.5 * dt * _dot(v, n)  # the overlap in the middle of the step
        loading = loading or half > greatest
        if loading:
            force = max(0.0, half) ** power
        elif half <= rest:
            force = 0.0
        else:
            force = greatest**power * ((half - rest) / (greatest - rest)) ** power
        if force <= 0.0 and t > 0.0:
            break
        dp = force * dt
        _push(v, w, kappa, (dp * n[0], dp * n[1], dp * n[2]), n)
        guess_n = _settle(v, w, kappa, n, up, dp, wall_mu, floor_mu, touching, guess_w, guess_f, guess_n)
        d, t = half - 0.5 * dt * _dot(v, n), t + dt
        if loading and _dot(v, n) > 0.0:
            loading, greatest, rest = False, d, d * (1.0 - wall_e**2)
        if touching and v[2] > 1e-4 * dp and not lands_by_velocity:  # more than the projection's own residue
            touching = False
        if floor and not touching and lands_by_gap:
            gap += dt * v[2]
            if gap <= 0.0 and v[2] < 0.0:
                touchdowns[landings] = t
                landings += 1
                touching = floor_e * abs(v[2]) < dp  # the next step's push would end such a rebound: no more bounces
                _land(v, w, kappa, 0.0 if touching else floor_e, floor_mu, up)
                gap = 0.0
    return floor and (not touching or v[2] > 1e-12), t >= longest, t, touchdowns[:landings]


@numba.njit
def _settle(v, w, kappa, n, up, dp, wall_mu, floor_mu, touching, guess_w, guess_f, guess_n):
    """Add the frictions and the floor's push of one step, given the wall's push dp; change the guesses, which are per dp.

    They are such that the velocities at the END of the step obey Coulomb's law at each contact and v_z >= 0 at the
    floor: projected Gauss-Seidel, from what they were in the last step, until nothing changes any more.
    """
    pw, pf, pn = np.empty(3), np.zeros(3), 0.0
    for i in range(3):
        pw[i] = guess_w[i] * dp
    if touching:
        pf[0], pf[1], pn = guess_f[0] * dp, guess_f[1] * dp, guess_n * dp
    _push(v, w, kappa, pw, n)
    _push(v, w, kappa, (pf[0], pf[1], pn), up)
    for _ in range(2000):
        change = _rub(v, w, kappa, pw, n, wall_mu * dp)
        if touching:
            better = max(0.0, pn - v[2])
            _push(v, w, kappa, (0.0, 0.0, better - pn), up)
            change, pn = max(change, abs(better - pn)), better
            change = max(change, _rub(v, w, kappa, pf, up, floor_mu * pn))
            pf[2] = 0.0
        if change < 1e-10 * dp:
            break
    for i in range(3):
        guess_w[i], guess_f[i] = pw[i] / dp, pf[i] / dp
    return pn / dp


@numba.njit
def _dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


@numba.njit
def _slip(v, w, n):
    """Tangential velocity of the ball's point that touches the surface of normal n."""
    x = v[0] + (n[1] * w[2] - n[2] * w[1])  # = v + w x (-n)
    y = v[1] + (n[2] * w[0] - n[0] * w[2])
    z = v[2] + (n[0] * w[1] - n[1] * w[0])
    along = x * n[0] + y * n[1] + z * n[2]
    return x - along * n[0], y - along * n[1], z - along * n[2]


@numba.njit
def _push(v, w, kappa, p, m):
    """Give the ball the impulse p at its contact with the surface of normal m."""
    for i in range(3):
        v[i] += p[i]
    w[0] += (p[1] * m[2] - p[2] * m[1]) / kappa
    w[1] += (p[2] * m[0] - p[0] * m[2]) / kappa
    w[2] += (p[0] * m[1] - p[1] * m[0]) / kappa


@numba.njit
def _rub(v, w, kappa, p, m, cap):
    """Change the friction impulse p at contact m so that slip stops, but to no more than cap; return by how much."""
    u, share = _slip(v, w, m), 1.0 + 1.0 / kappa
    x, y, z = p[0] - u[0] / share, p[1] - u[1] / share, p[2] - u[2] / share
    size = math.sqrt(x * x + y * y + z * z)
    if size > cap:
        x, y, z = x * cap / size, y * cap / size, z * cap / size
    change = (x - p[0], y - p[1], z - p[2])
    _push(v, w, kappa, change, m)
    p[0], p[1], p[2] = x, y, z
    return max(abs(change[0]), abs(change[1]), abs(change[2]))


@numba.njit
def _land(v, w, kappa, e, mu, up):
    """Change the ball's velocities by one blow from the floor, over before the wall's push has changed."""
    u = _slip(v, w, up)
    pn = -(1.0 + e) * v[2]
    slip = math.sqrt(u[0] ** 2 + u[1] ** 2)
    stop = slip / (1.0 + 1.0 / kappa)
    share = min(mu * pn, stop) / slip if slip > 0.0 else 0.0
    _push(v, w, kappa, (-share * u[0], -share * u[1], pn), up)


def rigid_limit(*args, steps=2000, **kwargs):
    """``rigid_floor`` extrapolated to a step of zero, with how much the last halving moved the extrapolation."""
    a, b, c = (rigid_floor(*args, steps=s, **kwargs).state for s in (steps, 2 * steps, 4 * steps))
    return 2 * c - b, float(np.max(np.abs((2 * c - b) - (2 * b - a))))


def stiff_limit(*args, ratios=(1e4, 1e6), order=1.0, **kwargs):
    """``spring_contact`` extrapolated to an infinite floor stiffness, the error falling as ratio^-order."""
    a, b = (spring_contact(*args, ratio=r, **kwargs).state for r in ratios)
    weight = (ratios[1] / ratios[0]) ** order
    return (weight * b - a) / (weight - 1.0)
