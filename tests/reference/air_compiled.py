"""DOP853 for balls in air, compiled: SciPy's coefficients and error estimate, with steps that end at the times asked for.

The equations are written down anew, without a line of carom's. A law of drag or lift is (c0 + c1 S)/(1 + c2 S) of the spin ratio S.
An end of a motion (a small slip, a spin that ends) is found by bisection of the step that passes it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit
from scipy.integrate._ivp.dop853_coefficients import E3, E5, N_STAGES, A, B, C

A, B, C, E3, E5 = (np.ascontiguousarray(one) for one in (A[:N_STAGES, :N_STAGES], B, C, E3, E5))

# Of the array of numbers: half rho area / mass, radius, decay, wind, pull; laws of drag and lift; and of the floor
K, RADIUS, DECAY, WIND, PULL, DRAG, LIFT, KAPPA, MU, ROLL, SPIN, SENSE = 0, 1, 2, 3, 6, 9, 12, 15, 16, 17, 18, 19
SIZE = 20
FLIGHT, SLIDES, ROLLS, SLIDE_ENDS, ROLL_ENDS = range(5)
NEAR, LAST = (
    1e-3,
    1e-15,
)  # m/s: sizes of a slip, or of a velocity, from which their logarithm counts, and at which nothing is left


@njit(cache=True)
def air(p: Any, y: Any, i: int, out: Any) -> None:
    """Acceleration with gravity, and angular acceleration by the air, of velocity y[i:i+3] and spin y[i+3:i+6], into ``out``."""
    u0, u1, u2 = y[i] - p[WIND], y[i + 1] - p[WIND + 1], y[i + 2] - p[WIND + 2]
    w0, w1, w2 = y[i + 3], y[i + 4], y[i + 5]
    s, size = math.sqrt(u0 * u0 + u1 * u1 + u2 * u2), math.sqrt(w0 * w0 + w1 * w1 + w2 * w2)
    for k in range(3):
        out[k], out[3 + k] = p[PULL + k], -p[DECAY] * s / p[RADIUS] * y[i + 3 + k]
    if s > 0:
        ratio = p[RADIUS] * size / s
        drag = p[K] * s * (p[DRAG] + p[DRAG + 1] * ratio) / (1 + p[DRAG + 2] * ratio)
        out[0] -= drag * u0
        out[1] -= drag * u1
        out[2] -= drag * u2
        if size > 0:
            lift = p[K] * s * (p[LIFT] + p[LIFT + 1] * ratio) / (1 + p[LIFT + 2] * ratio) / size
            out[0] += lift * (w1 * u2 - w2 * u1)
            out[1] += lift * (w2 * u0 - w0 * u2)
            out[2] += lift * (w0 * u1 - w1 * u0)


@njit(cache=True)
def floor(p: Any, y: Any, i: int, slides: bool, x: float, z: float, out: Any) -> None:
    """The same on the floor, where friction acts against the direction (x, z)."""
    air(p, y, i, out)
    a, kappa, load = p[RADIUS], p[KAPPA], -out[2]
    out[5] -= p[SENSE] * p[SPIN] * load / (kappa * a)
    out[2] = 0.0
    if slides:
        f, g = -p[MU] * load * x, -p[MU] * load * z
        out[0] += f
        out[1] += g
        out[3] += g / (kappa * a)
        out[4] -= f / (kappa * a)
    else:
        # torque about the point of contact, over its moment of inertia
        b = (out[0] + kappa * a * out[4]) / (1 + kappa) - p[ROLL] * load * x
        c = (out[1] - kappa * a * out[3]) / (1 + kappa) - p[ROLL] * load * z
        out[0], out[1], out[3], out[4] = b, c, -c / a, b / a


@njit(cache=True)
def slip(p: Any, y: Any, i: int, slides: bool) -> Any:
    """What friction acts against."""
    if slides:
        return y[i] - p[RADIUS] * y[i + 4], y[i + 1] + p[RADIUS] * y[i + 3]
    return y[i], y[i + 1]


@njit(cache=True)
def spiral_state(p: Any, mode: int, t: float, y: Any, out: Any) -> Any:
    """Velocity and spin at a logarithm t, of a state x, y, time, direction, v_x, v_y, spin about the vertical; the direction."""
    size, c, s = NEAR * math.exp(-t), math.cos(y[3]), math.sin(y[3])
    if mode == SLIDE_ENDS:
        out[0], out[1] = y[4], y[5]
        out[3], out[4] = (size * s - y[5]) / p[RADIUS], (y[4] - size * c) / p[RADIUS]
    else:
        out[0], out[1] = size * c, size * s
        out[3], out[4] = -out[1] / p[RADIUS], out[0] / p[RADIUS]
    out[2], out[5] = 0.0, y[6]
    return size, c, s


@njit(cache=True)
def rates(p: Any, mode: int, t: float, y: Any, out: Any) -> None:
    """Rates of position, velocity and spin in time; of :func:`spiral_state` over the logarithm of a size that falls to zero."""
    if mode == FLIGHT:
        out[0], out[1], out[2] = y[3], y[4], y[5]
        air(p, y, 3, out[3:])
        return
    if mode in (SLIDES, ROLLS):
        x, z = slip(p, y, 3, mode == SLIDES)
        size = math.sqrt(x * x + z * z)
        out[0], out[1], out[2] = y[3], y[4], y[5]
        floor(p, y, 3, mode == SLIDES, x / size, z / size, out[3:])
        return
    state, b = np.empty(6), np.empty(6)
    size, c, s = spiral_state(p, mode, t, y, state)
    floor(p, state, 0, mode == SLIDE_ENDS, c, s, b)
    x, z = slip(p, b, 0, mode == SLIDE_ENDS)
    per = -size / (x * c + z * s)
    out[0], out[1], out[2], out[3] = per * state[0], per * state[1], per, per * (z * c - x * s) / size
    out[4], out[5], out[6] = per * b[0], per * b[1], per * b[5]


@njit(cache=True)
def step(p: Any, mode: int, t: float, y: Any, h: float, stages: Any, new: Any) -> None:
    """One step; stages[0] holds the rates at its beginning, the last one will hold those at its end."""
    for s in range(1, N_STAGES):
        for i in range(len(y)):
            total = 0.0
            for k in range(s):
                total += A[s, k] * stages[k, i]
            new[i] = y[i] + h * total
        rates(p, mode, t + C[s] * h, new, stages[s])
    for i in range(len(y)):
        total = 0.0
        for k in range(N_STAGES):
            total += B[k] * stages[k, i]
        new[i] = y[i] + h * total
    rates(p, mode, t + h, new, stages[N_STAGES])


@njit(cache=True)
def ended(p: Any, mode: int, y: Any) -> int:
    """1 where a slip (a velocity) is near zero, 2 where the spin about the vertical has ended."""
    if mode in (SLIDES, ROLLS):
        x, z = slip(p, y, 3, mode == SLIDES)
        if math.sqrt(x * x + z * z) <= NEAR:
            return 1
    spin = y[6] if mode in (SLIDE_ENDS, ROLL_ENDS) else y[8]
    return 2 if mode != FLIGHT and p[SENSE] != 0 and p[SENSE] * spin <= 0 else 0


@njit(cache=True)
def dop853(p: Any, mode: int, t: float, y: Any, times: Any, states: Any, rtol: float, atol: float) -> Any:
    """Go on from (t, y) through the times; ``states`` is filled as far as it comes. Return the time, state and what has ended."""
    n = len(y)
    stages, new, y = np.empty((N_STAGES + 1, n)), np.empty(n), y.copy()
    h = (times[-1] - t) / 16
    for k in range(len(times)):
        while t < times[k]:
            rates(p, mode, t, y, stages[0])
            now = min(h, times[k] - t)
            step(p, mode, t, y, now, stages, new)
            err5, err3 = 0.0, 0.0
            for i in range(n):
                scale = atol + rtol * max(abs(y[i]), abs(new[i]))
                five, three = 0.0, 0.0
                for s in range(N_STAGES + 1):
                    five += E5[s] * stages[s, i]
                    three += E3[s] * stages[s, i]
                err5 += (five / scale) ** 2
                err3 += (three / scale) ** 2
            error = now * err5 / math.sqrt((err5 + 0.01 * err3) * n) if err5 > 0 else 0.0
            factor = min(10.0, 0.9 * error**-0.125) if error > 0 else 10.0
            if not error < 1 and now > 1e-9 * max(t, 1e-6):
                h = now * max(0.2, factor) if error >= 1 else now / 10
                continue
            if ended(p, mode, new):
                low, high = 0.0, now
                for _ in range(70):
                    middle = (low + high) / 2
                    step(p, mode, t, y, middle, stages, new)
                    if ended(p, mode, new):
                        high = middle
                    else:
                        low = middle
                step(p, mode, t, y, high, stages, new)
                return t + high, new, ended(p, mode, new)
            if now == h or factor < 1:
                h = now * max(factor, 0.2)
            t = times[k] if now == times[k] - t else t + now
            y[:] = new
        states[k] = y
    return t, y, 0


def floor_path(p: Any, slides: bool, start: Any, times: Any, ends: bool) -> tuple[Any, Any]:
    """Return the states (rows of position, velocity, spin) at times before the phase ends; and when and how, if ``ends``."""
    times = np.append(times[1:], 2 * times[-1])
    states = np.full((len(times), 9), np.nan)
    t, y, left = 0.0, np.asarray(start, float), 2
    if math.hypot(*slip(p, y, 3, slides)) > NEAR:
        while left == 2:
            some = times > t
            part = states[some]
            t, y, left = dop853(p, SLIDES if slides else ROLLS, t, y, times[some], part, 3e-14, 1e-16)
            states[some] = part
            if left == 2:
                y[8] = p[SENSE] = 0.0
    states = np.vstack([start, states[:-1]]).T  # (nor are there any of a ball that is NEAR)
    if left == 0 or not ends:
        return states, None
    x, z = slip(p, y, 3, slides)
    size, z0 = math.hypot(x, z), float(y[2])
    log, end = math.log(NEAR / size), np.array([math.log(NEAR / LAST)])
    y, mode, left = (
        np.array([y[0], y[1], t, math.atan2(z, x), y[3], y[4], y[8]]),
        SLIDE_ENDS if slides else ROLL_ENDS,
        2,
    )
    while left == 2:
        log, y, left = dop853(p, mode, log, y, end, np.empty((1, 7)), 3e-14, 1e-17)
        if left == 2:
            y[6] = p[SENSE] = 0.0
    v = np.array([y[4], y[5], 0.0]) if slides else np.zeros(3)
    w = np.array([-v[1] / p[RADIUS], v[0] / p[RADIUS], y[6]])
    return states, (float(y[2]), np.array([y[0], y[1], z0]), v, w)


@njit(cache=True)
def hops(p: Any, e: float, y: Any) -> Any:
    """Return time and state after infinitely many hops; the later ones, of 1e-9 m, are parabolas."""
    t, y, a, kappa, b = 0.0, y.copy(), p[RADIUS], p[KAPPA], np.empty(6)
    z, state, at = y[2], np.empty((1, 9)), np.empty(1)
    for count in range(5000):
        if y[5] < 1e-17:
            break
        air(p, y, 3, b)
        s = -2 * y[5] / b[2]
        if count < 12:  # to the landing by Newton's steps
            y[2] = 0.0
            for n in range(4):
                at[0] = s
                _t, end, _left = dop853(p, FLIGHT, 0.0, y, at, state, 3e-14, 1e-20)
                if n < 3:
                    s -= end[2] / end[5]
            y = end
        else:
            for k in range(3):
                y[k] += y[3 + k] * s + b[k] * s * s / 2
                y[3 + k] += b[k] * s
                y[6 + k] += b[3 + k] * s
        t += s
        x, q = slip(p, y, 3, True)
        size, normal = math.sqrt(x * x + q * q), -(1 + e) * y[5]
        j = min(kappa / (1 + kappa), p[MU] * normal / size) if size > 0 else 0.0
        y[3], y[4], y[5] = y[3] - j * x, y[4] - j * q, -e * y[5]
        y[6] -= j * q / (kappa * a)
        y[7] += j * x / (kappa * a)
    y[2], y[5] = z, 0.0
    return t, y
