"""Films in closed form: pucks on a floor without friction, dead balls that are dropped, bounces whose frames are missing, and balls
that bounce toward the camera.

Straight lines and parabolas; nothing of ``carom`` but :class:`Track` makes them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.tracks import Track, measure, usable_stages

Array = NDArray[np.float64]
GRAVITY = 9.80665
MIN_FLIGHT_S, MIN_FLIGHT_FRAMES = 0.12, 7  # before and after a bounce that has to be found


@dataclass(frozen=True)
class Bounce:
    """The truth of one bounce."""

    time: float
    restitution: float
    visible: bool = True
    """Whether the flights on both sides are long enough to be seen."""


@dataclass(frozen=True, eq=False)
class PlainFilm:
    """A film and its truth."""

    track: Track
    view: Literal["above", "side"]
    bounces: tuple[Bounce, ...]


def _seen(times: Array, place: Array, noise: float, rng: np.random.Generator) -> Track:
    return Track("ball", times, place + rng.normal(0, noise, place.shape))


def puck(rng: np.random.Generator, size: Literal["small", "large"] = "small") -> PlainFilm:
    """A puck between two walls, one to three bounces; a large one on an air-hockey table, a small one on glass."""
    radius, length = (0.015, rng.uniform(0.4, 1.0)) if size == "small" else (0.05, rng.uniform(1.0, 2.2))
    rate, noise = float(rng.choice([60.0, 120.0, 240.0])), float(rng.choice([1e-4, 3e-4, 1e-3]))
    e, friction = rng.uniform(0.5, 0.95), rng.uniform(0.0, 0.3)
    width, x = length - 2 * radius, rng.uniform(0.3, 0.7) * (length - 2 * radius)
    vx, vy = -rng.uniform(0.4, 2.5), rng.uniform(-1.0, 1.0)
    t, y, corners, bounces = 0.0, 0.5, [(0.0, x, 0.5)], []
    for _ in range(int(rng.integers(1, 4))):
        reach = x if vx < 0 else width - x
        t, y, x = t + reach / abs(vx), y + vy * reach / abs(vx), 0.0 if vx < 0 else width
        corners.append((t, x, y))
        bounces.append(Bounce(t, e))
        vy -= np.sign(vy) * min(friction * (1 + e) * abs(vx), abs(vy) / 3)
        vx *= -e
    end = t + rng.uniform(0.3, 0.8) * width / abs(vx)
    corners.append((end, x + vx * (end - t), y + vy * (end - t)))
    times = np.arange(rng.uniform(0, 1 / rate), end, 1 / rate)
    knots = np.array(corners).T
    place = np.stack([np.interp(times, knots[0], knots[1]) + radius, np.interp(times, knots[0], knots[2])], axis=-1)
    return PlainFilm(_seen(times, place, noise, rng), "above", tuple(bounces))


def dropped(
    rng: np.random.Generator, low: float = 0.2, high: float = 0.6, step: float = 0.0, rate: float = 0.0
) -> PlainFilm:
    """A ball that is held, falls, bounces until it lies still, and lies there; each bounce ``step`` m lower than the one before."""
    rate = rate or float(rng.choice([30.0, 60.0, 120.0, 240.0]))
    noise, usual = float(rng.choice([5e-5, 3e-4, 1e-3])), rng.uniform(low, high)
    height, level, t = rng.uniform(0.2, 1.2), 0.0, rng.uniform(0.0, 0.5)
    pieces, bounces = [(t, height, 0.0)], []
    flight = (2 * height / GRAVITY) ** 0.5
    t, v, before = t + flight, GRAVITY * flight, flight
    while v > 0.05 and len(bounces) < 12:
        e = float(np.clip(usual * rng.uniform(0.95, 1.05), 0.1, 0.97))
        up = e * v
        pieces.append((t, level, up))
        level -= step
        v = (up**2 + 2 * GRAVITY * step) ** 0.5
        flight = (up + v) / GRAVITY
        least = max(MIN_FLIGHT_S, MIN_FLIGHT_FRAMES / rate)
        bounces.append(Bounce(t, e, min(before, flight) > least))
        t, before = t + flight, flight
        if step and flight < 2 * least:
            break
    rests = not step and v <= 0.05
    end = t + (rng.uniform(0.0, 1.5) if rests else 0.0)
    times = np.arange(rng.uniform(0, 1 / rate), end, 1 / rate)
    y = np.full(len(times), height)
    for since, begin, up in pieces:
        s = times - since
        y = np.where(s >= 0, begin + up * s - GRAVITY / 2 * s * s, y)
    if rests:
        y = np.where(times >= t, level, y)
    along = rng.uniform(-0.3, 0.3) + rng.uniform(-0.3, 0.3) * np.maximum(times - pieces[0][0], 0.0)
    place = np.stack([along, y - rng.uniform(0.0, 0.5)], axis=-1)
    return PlainFilm(_seen(times, place, noise, rng), "side", tuple(bounces))


def with_lost_frames(film: PlainFilm, each_side: int) -> PlainFilm:
    """The same film, in which the tracker has lost the ball in so many frames before and after each visible bounce."""
    t = film.track.time
    kept = np.ones(len(t), bool)
    for bounce in film.bounces:
        if bounce.visible:
            i = int(np.searchsorted(t, bounce.time))
            kept[max(i - each_side, 0) : i + each_side] = False
    return replace(film, track=film.track.select(kept))


# Kinds of films by name, each drawn from a generator
KINDS: dict[str, Callable[[np.random.Generator], PlainFilm]] = {
    "pucks, small": lambda rng: puck(rng, "small"),
    "pucks, large": lambda rng: puck(rng, "large"),
    "dead balls dropped": dropped,
    "lively balls dropped": lambda rng: dropped(rng, 0.6, 0.9),
    "2 frames lost on either side of each bounce": lambda rng: with_lost_frames(dropped(rng, 0.6, 0.9), 2),
    "4 frames lost, 120 per second": lambda rng: with_lost_frames(dropped(rng, 0.7, 0.9, rate=120.0), 4),
    "toward the camera": lambda rng: dropped(rng, 0.6, 0.9, step=10 ** rng.uniform(-3, -1.5)),
    "away from the camera": lambda rng: dropped(rng, 0.6, 0.9, step=-(10 ** rng.uniform(-3, -2.3))),
}


class Measurement(NamedTuple):
    """What ``carom.tracks`` makes of a film."""

    view: bool
    """Whether the view is right."""
    said: bool
    """Whether a note has the other view's numbers."""
    pulls: list[float]
    """(Measured less true) / error of the restitution of each measured contact; infinite where no bounce was."""
    unlisted: int
    """Visible bounces in no count: no contact, measured or not, and no turn of the notes is there."""


def measured(film: PlainFilm) -> Measurement:
    """Measure a film and compare with its truth."""
    found = measure([film.track])
    near = max(float(np.diff(film.track.time).max()), 2 * found.interval)
    turns = [(one.low + one.high) / 2 for some in found.events.values() for one in some if one.kind == "turn"]
    times = [one.time for one in found.contacts] + turns
    pulls = []
    for one in found.measured:
        if one.fit is None or not usable_stages(one, "best", True)[0]:
            continue
        bounce = min(film.bounces, key=lambda bounce: abs(bounce.time - one.time))
        e, error = one.fit.restitution
        pulls.append((e - bounce.restitution) / error if abs(bounce.time - one.time) < near else np.inf)
    unlisted = [one for one in film.bounces if one.visible and not any(abs(t - one.time) < near for t in times)]
    said = any("do not show for sure" in note for note in found.notes)
    return Measurement(found.view == film.view, said, pulls, len(unlisted))
