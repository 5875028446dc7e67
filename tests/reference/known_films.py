"""Films whose truth is known, made without the engine: falls through air with bounces, smooth paths without any contact, noise that
is correlated from frame to frame, and cameras that are turned.

Paths are integrated in small steps (Runge and Kutta), bounces found by bisection; nothing of ``carom`` but :class:`Track` is used.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.tracks import Track

Array = NDArray[np.float64]
GRAVITY, STEP = 9.80665, 1e-3
MIN_SPEED = 0.02  # m/s: a ball that leaves the floor more slowly stays there


@dataclass(frozen=True)
class Fall:
    """A ball that falls, bounces and is filmed from the side."""

    restitution: float = 0.8
    height: float = 0.8
    """m, from which it falls at t = 0."""
    speed: float = 0.5
    """m/s, level."""
    drag: float = 0.0
    """1/m: the air slows a ball of speed v down by drag v^2."""
    friction: float = 0.1
    first: float = 0.0
    last: float = 1.5
    """s, of the first and the last frame."""
    rate: float = 120.0
    noise: float = 5e-4
    correlation: float = 0.0
    """Of the noise, from frame to frame."""
    pixel: float = 0.0
    """m; 0: positions are not rounded."""
    roll: float = 0.0
    """degrees by which the camera is turned clockwise."""


@dataclass(frozen=True)
class Bounce:
    """The truth of one bounce."""

    t: float
    v_n_in: float
    v_n_out: float
    v_t_lost: float = 0.0
    """By how much v_t has changed, m/s."""


def noise(rng: np.random.Generator, shape: tuple[int, int], size: float, correlation: float = 0.0) -> Array:
    """Noise of standard deviation ``size`` with the correlation r^k between frames k apart."""
    found = rng.normal(0, size, shape)
    for i in range(1, len(found)):
        found[i] = correlation * found[i - 1] + np.sqrt(1 - correlation**2) * found[i]
    return found


def _stepped(rate: Callable[[Array], Array], state: Array, h: float) -> Array:
    """A state after a step h of the fourth order."""
    a = rate(state)
    b = rate(state + h / 2 * a)
    c = rate(state + h / 2 * b)
    d = rate(state + h * c)
    return np.asarray(state + h / 6 * (a + 2 * b + 2 * c + d))


def integrated(rate: Callable[[Array], Array], start: Array, times: Array) -> Array:
    """States (n, m) at times that grow, from a start at t = 0, in steps of at most STEP."""
    found, state, t = [], start, 0.0
    for end in times.tolist():
        count = max(int(np.ceil((end - t) / STEP)), 1)
        for _ in range(count):
            state = _stepped(rate, state, (end - t) / count)
        t = end
        found.append(state)
    return np.array(found)


def fallen(fall: Fall, seed: int) -> tuple[Track, list[Bounce]]:
    """The track of a fall, and all its bounces, also those before the first frame and after the last."""
    rng = np.random.default_rng(seed)

    def rate(state: Array) -> Array:
        v = state[2:]
        return np.concatenate([v, np.array([0.0, -GRAVITY]) - fall.drag * np.hypot(*v) * v])

    begin = fall.first + rng.uniform(0, 1 / fall.rate)
    times = begin + np.arange(int((fall.last - begin) * fall.rate) + 1) / fall.rate
    state, t, bounces, places = np.array([0.0, fall.height, fall.speed, 0.0]), 0.0, list[Bounce](), []
    rests = False
    for end in times.tolist():
        while t < end and not rests:
            h = min(STEP, end - t)
            then = _stepped(rate, state, h)
            if then[1] >= 0:
                state, t = then, t + h
                continue
            low, high = 0.0, h
            for _ in range(40):
                middle = (low + high) / 2
                low, high = (middle, high) if _stepped(rate, state, middle)[1] > 0 else (low, middle)
            state, t = _stepped(rate, state, high), t + high
            v = -state[3]
            level = state[2]
            lost = min(fall.friction * (1 + fall.restitution) * v, abs(state[2]) * 2 / 7)
            state = np.array([state[0], 0.0, state[2] - np.sign(state[2]) * lost, fall.restitution * v])
            bounces.append(Bounce(t, v, fall.restitution * v, state[2] - level))
            rests = fall.restitution * v < MIN_SPEED
        if rests:
            state, t = state + np.array([state[2] * (end - t), 0.0, 0.0, 0.0]), end
        places.append(state[:2].copy())
    x = rotated(np.array(places), fall.roll) + noise(rng, (len(times), 2), fall.noise, fall.correlation)
    if fall.pixel:
        x = np.round(x / fall.pixel) * fall.pixel
    return Track("ball", times, x), bounces


def drawn_fall(rng: np.random.Generator, drag: float = 0.0, **given: float) -> Fall:
    """Some fall; the film begins and ends anywhere, also in mid-bounce."""
    made = {
        "restitution": rng.uniform(0.3, 0.92), "height": rng.uniform(0.1, 1.2), "speed": rng.uniform(0, 1.0), "drag": drag,
        "rate": float(rng.choice([30.0, 60.0, 120.0, 240.0])), "noise": float(rng.choice([3e-4, 1e-3, 2e-3])),
        "first": rng.uniform(0, 0.15), "last": rng.uniform(0.5, 1.8),
    }  # fmt: skip
    return Fall(**(made | given))


# Smooth paths without a contact: the height of a rail over its lowest point, with its first two derivatives
Rail = Callable[[float], tuple[float, float, float]]


def parabola(radius: float) -> Rail:
    """A rail y = x^2 / (2 R), of radius R at its lowest point, m."""
    return lambda x: (x * x / (2 * radius), x / radius, 1 / radius)


def cosine(radius: float) -> Rail:
    """A rail between two hills, y = R (1 - cos(x / R))."""
    return lambda x: (radius * (1 - np.cos(x / radius)), float(np.sin(x / radius)), float(np.cos(x / radius) / radius))


def quartic(radius: float) -> Rail:
    """A flat bottom between steep sides, y = x^4 / (4 R^3)."""
    return lambda x: (x**4 / (4 * radius**3), x**3 / radius**3, 3 * x * x / radius**3)


def rolled_on_rail(rail: Rail, start: float, times: Array, kappa: float = 0.4, damping: float = 0.05) -> Array:
    """Places (n, 2) of a ball that rolls on a rail from rest at x = start; the rail is the path of its centre."""

    def rate(state: Array) -> Array:
        x, v = state
        _y, slope, bend = rail(float(x))
        return np.array(
            [v, -(GRAVITY * slope / (1 + kappa) + slope * bend * v * v) / (1 + slope * slope) - damping * v]
        )

    x = integrated(rate, np.array([start, 0.0]), times)[:, 0]
    return np.stack([x, [rail(one)[0] for one in x.tolist()]], axis=-1)


def swung(length: float, angle: float, times: Array, kappa: float = 0.0, damping: float = 0.05) -> Array:
    """Places (n, 2) of a pendulum, or with ``kappa`` of a ball that rolls in a round valley of radius ``length``, from rest at an
    angle, rad; its lowest point is the origin."""

    def rate(state: Array) -> Array:
        return np.array([state[1], -GRAVITY / length / (1 + kappa) * np.sin(state[0]) - damping * state[1]])

    at = integrated(rate, np.array([angle, 0.0]), times)[:, 0]
    return length * np.stack([np.sin(at), 1 - np.cos(at)], axis=-1)


def drawn_curve(rng: np.random.Generator) -> tuple[str, Track]:
    """A smooth path without a contact, from the side, perhaps mirrored or rotated by some degrees; and its kind."""
    kind = str(rng.choice(["pendulum", "valley", "parabola", "cosine", "quartic"]))
    rate, size = float(rng.choice([30.0, 60.0, 100.0, 240.0])), rng.uniform(0.15, 1.5)
    times = rng.uniform(0, 1 / rate) + np.arange(0, rng.uniform(1.0, 6.0), 1 / rate)
    angle = rng.uniform(0.25, 1.1)
    if kind in ("pendulum", "valley"):
        x = swung(size, angle, times, kappa=0.0 if kind == "pendulum" else 0.4)
    else:
        rail = {"parabola": parabola, "cosine": cosine, "quartic": quartic}[kind](size)
        x = rolled_on_rail(rail, angle * size, times)
    x = x * [rng.choice([-1.0, 1.0]), 1.0]
    x = rotated(x, rng.uniform(-10, 10)) + noise(rng, x.shape, float(rng.choice([2e-4, 5e-4, 1e-3])))
    return kind, Track("ball", times, x)


def rotated(x: Array, degrees: float) -> Array:
    """Places as a camera sees them that is turned clockwise."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.asarray(x @ np.array([[c, s], [-s, c]]))
