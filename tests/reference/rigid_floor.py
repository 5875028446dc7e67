"""An independent reference for the laws of impact: a wall that is a spring, and a floor that is rigid.

It is what contacts of finite stiffness (``stiff_springs.py``) tend to as the floor grows stiffer: the floor gives just the push
that keeps the ball out of it, found step by step by projection; slow, first order in the step, and made to be obviously right.
The wall's spring, the units and the names are as there. Nothing here knows the library's laws.
"""

import functools
import math

import numpy as np
from reference.compiling import part
from reference.stiff_springs import Outcome

from carom.core.jit.compile import njit


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
    touchdowns = np.empty(1000)
    lifted, jammed, t, landings = _compiled()(
        v, w, n, float(kappa), float(wall_e), float(wall_mu), float(floor_mu), float(floor_e), int(steps), float(power), floor,
        again == "gap", again == "velocity", float(longest), np.array([0.0, 0.0, 1.0]), touchdowns, np.zeros((4, 3)),
    )  # fmt: skip
    return Outcome(v, w, bool(lifted), jammed, t, tuple(touchdowns[:landings].tolist()))


@functools.cache
def _compiled():
    """The loop, compiled, for it takes some 10^7 steps of the projection."""
    return njit(_follow_rigid, _nrt=False)


def _follow_rigid(
    v, w, n, kappa, wall_e, wall_mu, floor_mu, floor_e, steps, power, floor, lands_by_gap, lands_by_velocity,
    longest, up, touchdowns, room,
):  # fmt: skip
    """Follow the push; v and w are changed. Return whether the floor does not press at the end, whether jammed, time, landings."""
    loading, greatest, rest = True, 0.0, 0.0
    dt = math.pi / 2 / steps  # `steps` steps up to the greatest compression by a wall alone with N = d
    d, t, gap, touching = 0.0, 0.0, 0.0, floor
    landings = 0
    # frictions of wall and floor, and the floor's push, per push of the wall: where the next step's projection begins
    guess_w, guess_f, guess_n, pw, pf = room[0], room[1], 0.0, room[2], room[3]
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
        _push(v, w, kappa, dp * n[0], dp * n[1], dp * n[2], n)
        guess_n = _settle(v, w, kappa, n, up, dp, wall_mu, floor_mu, touching, guess_w, guess_f, guess_n, pw, pf)
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
    return floor and (not touching or v[2] > 1e-12), t >= longest, t, landings


@part
def _settle(v, w, kappa, n, up, dp, wall_mu, floor_mu, touching, guess_w, guess_f, guess_n, pw, pf):
    """Add the frictions and the floor's push of one step, given the wall's push dp; change the guesses, which are per dp.

    They are such that the velocities at the END of the step obey Coulomb's law at each contact and v_z >= 0 at the
    floor: projected Gauss-Seidel, from what they were in the last step, until nothing changes any more.
    """
    share = dp if touching else 0.0
    pn = guess_n * share
    for i in range(3):
        pw[i], pf[i] = guess_w[i] * dp, guess_f[i] * share
    _push(v, w, kappa, pw[0], pw[1], pw[2], n)
    _push(v, w, kappa, pf[0], pf[1], pn, up)
    for _ in range(2000):
        change = _rub(v, w, kappa, pw, n, wall_mu * dp)
        if touching:
            better = max(0.0, pn - v[2])
            _push(v, w, kappa, 0.0, 0.0, better - pn, up)
            change, pn = max(change, abs(better - pn)), better
            change = max(change, _rub(v, w, kappa, pf, up, floor_mu * pn))
            pf[2] = 0.0
        if change < 1e-10 * dp:
            break
    for i in range(3):
        guess_w[i], guess_f[i] = pw[i] / dp, pf[i] / dp
    return pn / dp


@part
def _dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


@part
def _slip(v, w, n):
    """Tangential velocity of the ball's point that touches the surface of normal n."""
    x = v[0] + (n[1] * w[2] - n[2] * w[1])  # = v + w x (-n)
    y = v[1] + (n[2] * w[0] - n[0] * w[2])
    z = v[2] + (n[0] * w[1] - n[1] * w[0])
    along = x * n[0] + y * n[1] + z * n[2]
    return x - along * n[0], y - along * n[1], z - along * n[2]


@part
def _push(v, w, kappa, x, y, z, m):
    """Give the ball an impulse at its contact with the surface of normal m."""
    v[0], v[1], v[2] = v[0] + x, v[1] + y, v[2] + z
    w[0] += (y * m[2] - z * m[1]) / kappa
    w[1] += (z * m[0] - x * m[2]) / kappa
    w[2] += (x * m[1] - y * m[0]) / kappa


@part
def _rub(v, w, kappa, p, m, cap):
    """Change the friction impulse p at contact m so that slip stops, but to no more than cap; return by how much."""
    u, share = _slip(v, w, m), 1.0 + 1.0 / kappa
    x, y, z = p[0] - u[0] / share, p[1] - u[1] / share, p[2] - u[2] / share
    size = math.sqrt(x * x + y * y + z * z)
    if size > cap:
        x, y, z = x * cap / size, y * cap / size, z * cap / size
    dx, dy, dz = x - p[0], y - p[1], z - p[2]
    _push(v, w, kappa, dx, dy, dz, m)
    p[0], p[1], p[2] = x, y, z
    return max(abs(dx), abs(dy), abs(dz))


@part
def _land(v, w, kappa, e, mu, up):
    """Change the ball's velocities by one blow from the floor, over before the wall's push has changed."""
    u = _slip(v, w, up)
    pn = -(1.0 + e) * v[2]
    slip = math.sqrt(u[0] ** 2 + u[1] ** 2)
    stop = slip / (1.0 + 1.0 / kappa)
    share = min(mu * pn, stop) / slip if slip > 0.0 else 0.0
    _push(v, w, kappa, -share * u[0], -share * u[1], pn, up)


def rigid_limit(*args, steps=2000, **kwargs):
    """``rigid_floor`` extrapolated to a step of zero, with how much the last halving moved the extrapolation."""
    a, b, c = (rigid_floor(*args, steps=s, **kwargs).state for s in (steps, 2 * steps, 4 * steps))
    return 2 * c - b, float(np.max(np.abs((2 * c - b) - (2 * b - a))))
